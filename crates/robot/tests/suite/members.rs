//! Members of the families that a pose's solutions form: each holds the pose, and neighbours are near.

use crate::common::{Random, robot};
use denavit::Robot;
use denavit::description::read_toml;
use denavit::geometry::Transform;
use denavit::inverse::{Family, InverseKinematics, InverseOptions, MAX_MEMBERS, Members};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A whole turn is divided into so many steps.
const TURN: usize = 72;
/// Twice what a solution may miss its pose by.
const MISSED: f64 = 2e-9;

/// How far two poses are apart: rotations by their entries, positions by the arm's reach.
fn distance(a: &Transform<f64>, b: &Transform<f64>, reach: f64) -> f64 {
    let entries = a.rotation.rows().concat().into_iter().zip(b.rotation.rows().concat());
    let turned: f64 = entries.map(|(x, y)| (x - y).powi(2)).sum();
    turned.sqrt().hypot((a.translation - b.translation).norm() / reach)
}

/// Members of every family of the pose at `q`, checked: they have the pose, neighbours are near, and those that are
/// closed come back.
#[track_caller]
fn members(name: &str, options: &InverseOptions, q: &[f64]) -> Vec<(Family, Members)> {
    let d = robot(name);
    let inverse = InverseKinematics::new(&d, options).expect("all parameters have values");
    let arm = Robot::numeric(&d).expect("all parameters have values");
    let pose = arm.pose(q);
    let given: Vec<f64> = inverse.given.iter().map(|&j| q[j]).collect();
    let families = inverse.solve(&pose, &given).families;
    let all = families.into_iter().map(|f| {
        let found = inverse.members(&pose, &f);
        assert!(!found.members.is_empty() && found.members.len() <= MAX_MEMBERS);
        for member in &found.members {
            let missed = distance(&arm.pose(member), &pose, arm.reach());
            assert!(missed <= MISSED, "{name}: {member:?} misses the pose by {missed}");
        }
        for pair in found.members.windows(2) {
            let far = pair[0].iter().zip(&pair[1]).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            assert!(far > 0.0 && far < 0.5, "{name}: {far} from a member to the next");
        }
        if found.is_closed {
            let (first, last) = (&found.members[0], &found.members[found.members.len() - 1]);
            assert!(inverse.space.is_same(first, last));
        }
        (f, found)
    });
    all.collect()
}

#[test]
fn a_straight_wrist_turns_all_round() {
    let q = [0.3, -0.4, 0.9, 0.5, 0.0, 0.7];
    let found = members("puma560", &InverseOptions::default(), &q);
    assert!(!found.is_empty());
    for (family, found) in found {
        assert!(family.is_affine && family.curve.is_empty() && found.is_closed, "{family:?}");
        assert_eq!(found.members.len(), TURN + 1);
        let start = &found.members[0];
        for q in &found.members {
            // Axes 4 and 6 lie on one line: q4 + q6 stays the same, nothing else moves.
            assert!((q[3] + q[5] - start[3] - start[5]).abs() < 1e-9);
            assert!((0..6).all(|j| j == 3 || j == 5 || (q[j] - start[j]).abs() < 1e-9));
        }
        let last = &found.members[TURN];
        assert!(((last[3] - start[3]).abs() - TAU).abs() < 1e-9);
    }
}

#[test]
fn four_parallel_axes_move_along_a_curve() {
    // Axes 2, 3, 4 and 6 of a UR5 are parallel at q5 = 0: a four-bar linkage.
    let found = members("ur5", &InverseOptions::default(), &[0.3, -1.1, 1.4, 0.5, 0.0, 0.7]);
    assert!(found.iter().any(|(f, m)| !f.is_affine && m.members.len() > 20), "{found:?}");
}

#[test]
fn a_redundant_arm_moves_its_elbow() {
    let q = [0.2, 0.5, -0.3, -1.6, 0.4, 1.3, 0.1];
    for name in ["kuka-iiwa-7", "franka-panda"] {
        let found = members(name, &InverseOptions::default(), &q);
        assert!(!found.is_empty() && found.iter().all(|(_, m)| m.members.len() > 20), "{name}");
    }
    let closed = members("kuka-iiwa-7", &InverseOptions::default(), &q);
    assert!(closed.iter().all(|(_, m)| m.is_closed), "the elbow goes all round");
}

#[test]
fn a_given_joint_stays() {
    // With joint 3 held the arm is one with six joints, its wrist straight at q6 = 0.
    let q = [0.2, 0.5, -0.3, -1.6, 0.4, 0.0, 0.1];
    let options = InverseOptions { given: Some(vec![2]), ..InverseOptions::default() };
    let found = members("kuka-iiwa-7", &options, &q);
    assert!(!found.is_empty());
    assert!(found.iter().all(|(_, m)| m.members.iter().all(|x| (x[2] - q[2]).abs() < 1e-9)));
}

/// A wrist that misses by a little nearly turns about one line; a motion "in these proportions everywhere" is a line all round.
#[test]
fn what_is_nearly_a_line_is_not_called_one() {
    let mut lines = 0;
    for offset in ["0", "1e-7", "1e-6", "1e-5", "1e-4"] {
        let text = format!(
            "name = \"wrist\"\nconvention = \"standard\"\n\
             [[joints]]\ntheta = \"q1\"\nalpha = \"90 deg\"\nd = 0.4\n[[joints]]\ntheta = \"q2\"\na = 0.4\n\
             [[joints]]\ntheta = \"q3\"\na = 0.02\nalpha = \"-90 deg\"\nd = 0.1\n\
             [[joints]]\ntheta = \"q4\"\nd = 0.35\nalpha = \"90 deg\"\n\
             [[joints]]\ntheta = \"q5\"\nalpha = \"-90 deg\"\na = {offset}\n[[joints]]\ntheta = \"q6\"\nd = 0.08\n"
        );
        let (d, _) = denavit::description::read_toml(&text).expect("a robot");
        let inverse = InverseKinematics::new(&d, &InverseOptions::default()).expect("numbers");
        let arm = Robot::numeric(&d).expect("numbers");
        for q in [
            [0.0, -0.25, 0.25, 0.0, 0.0, 0.0],
            [0.25, 0.25, -0.25, -0.25, 0.0, -0.25],
            [0.1, 0.2, 0.15, 0.3, 0.0, 0.1],
        ] {
            let pose = arm.pose(&q.map(|turns| turns * TAU));
            for family in inverse.solve(&pose, &[]).families.iter().filter(|f| f.is_affine) {
                lines += 1;
                let (start, along) = (&family.representative.q, &family.direction);
                let most = along.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                for k in -8..=8 {
                    let by = f64::from(k) / 16.0 * TAU / most;
                    let q: Vec<f64> = start.iter().zip(along).map(|(x, d)| x + by * d).collect();
                    let missed = distance(&arm.pose(&q), &pose, arm.reach());
                    assert!(missed <= MISSED, "offset {offset}: {missed} at {q:?}");
                }
            }
        }
    }
    assert!(lines > 0, "a straight wrist turns all round");
}

/// Six axes through the corners of a box move with their hand still where the roots of elimination cannot be counted: a
/// configuration that is known to have the pose is not lost, and the answer is not called complete.
#[test]
fn what_is_known_to_have_the_pose_is_in_the_answer() {
    let lengths = [0.3, 0.2, 0.6, 0.6, 0.2, 0.3];
    let row = |(k, a): (usize, &f64)| {
        let alpha = if k % 2 == 0 { 90 } else { -90 };
        format!("[[joints]]\na = {a}\nalpha = \"{alpha} deg\"\ntheta = \"q{}\"\n", k + 1)
    };
    let rows: String = lengths.iter().enumerate().map(row).collect();
    let (d, _) =
        read_toml(&format!("name = \"box\"\nconvention = \"standard\"\n{rows}")).expect("a robot file");
    let inverse = InverseKinematics::new(&d, &InverseOptions::default()).expect("all parameters have values");
    let mut random = Random(3);
    for _ in 0..20 {
        let q: Vec<f64> = (0..6).map(|_| FRAC_PI_2 * (4.0 * random.unit()).floor() - PI).collect();
        let pose = inverse.robot.pose(&q);
        let mut answer = inverse.solve(&pose, &[]);
        inverse.include(&pose, &mut answer, &q);
        let listed = answer.solutions.iter().any(|s| inverse.space.distance(&s.q, &q) <= 1e-3);
        assert!(listed || inverse.family_of(&pose, &answer, &q).is_some(), "{q:?}");
        let before = answer.clone();
        inverse.include(&pose, &mut answer, &q);
        assert_eq!(answer.solutions.len(), before.solutions.len(), "{q:?} is added twice");
    }
}
