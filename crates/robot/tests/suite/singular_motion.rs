//! What is said of motions at singular configurations, held against the arm's motion at configurations of the test's own:
//! derivatives of the pose by differences, nothing of the library's velocities but their singular values.

use crate::attack::arms::{Kind, text};
use crate::common::{Random, robot, share};
use denavit::description::{Description, read_toml};
use denavit::forward::Reference;
use denavit::geometry::Vector;
use denavit::robot::Robot;
use denavit::velocity::{
    Example, Obstacle, Place, Singularities, Still, Viewpoint, geometric, singular_configuration, svd,
};
use denavit_symbolic::{Expr, Symbol};

/// The tool's motion by each joint, linear first, lengths by the arm's size.
fn motions(robot: &Robot<f64>, q: &[f64], size: f64) -> Vec<[f64; 6]> {
    const STEP: f64 = 1e-5;
    let by = |j: usize| {
        let at = |x: f64| {
            let mut q = q.to_vec();
            q[j] += x;
            robot.pose(&q)
        };
        let (behind, before) = (at(STEP), at(-STEP));
        let v = (behind.translation - before.translation).scale(0.5 / (STEP * size));
        // ω = ½ Σ rᵢ × ṙᵢ
        let here = at(0.0).rotation;
        let spin = |k: usize| {
            let rate = (behind.rotation.column(axis(k)) - before.rotation.column(axis(k))).scale(0.5 / STEP);
            here.column(axis(k)).cross(rate)
        };
        let w = (0..3).map(spin).fold(Vector([0.0; 3]), |sum, x| sum + x).scale(0.5);
        [v.0[0], v.0[1], v.0[2], w.0[0], w.0[1], w.0[2]]
    };
    (0..robot.joints).map(by).collect()
}

fn axis(k: usize) -> denavit::geometry::Axis {
    denavit::geometry::Axis::ALL[k]
}

/// The motions of some joints, all of the body or of the point alone, and the slowest motion that they have together.
fn slowest(motions: &[[f64; 6]], joints: &[usize], still: Still) -> (f64, Vec<f64>) {
    let shown = |c: &[f64; 6]| match still {
        Still::Body => *c,
        Still::Point => [c[0], c[1], c[2], 0.0, 0.0, 0.0],
    };
    let columns: Vec<[f64; 6]> = joints.iter().map(|&j| shown(&motions[j])).collect();
    let svd = svd(columns);
    // More joints than directions: one has no motion at all.
    (svd.values.last().copied().unwrap_or(0.0), svd.vectors.last().cloned().unwrap_or_default())
}

/// What is wrong with what is said at a configuration where the factor is 0.
fn fault(
    (robot, view): (&Robot<f64>, &Viewpoint<f64>),
    q: &[f64],
    size: f64,
    said: &Example,
) -> Option<String> {
    const STILL: f64 = 1e-5;
    let motions = motions(robot, q, size);
    let stands = |joints: &[usize], still: Still| slowest(&motions, joints, still).0 < STILL;
    if said.place == Place::Differs {
        return None;
    }
    for free in &said.free {
        let joints: Vec<usize> = (0..free.len()).filter(|&j| free[j] != 0.0).collect();
        if !stands(&joints, said.still) {
            return Some(format!("joints {joints:?} leave nothing at rest"));
        }
    }
    let is_right = match &said.place {
        Place::SelfMotion { joints, still } => stands(joints, *still),
        Place::OneLine(i, j) => stands(&[*i, *j], Still::Body),
        Place::OnePlane(all) | Place::Parallel(all) => stands(all, Still::Body),
        Place::PointOnAxis(j) => stands(&[*j], Still::Point),
        Place::PointInPlane { axes, .. } => stands(axes, Still::Point),
        // These are not motions.
        Place::CentreOnAxis { .. }
        | Place::CentreInPlane { .. }
        | Place::Line { .. }
        | Place::Lost
        | Place::Differs => true,
    };
    if !is_right {
        return Some(format!("{:?}", said.place));
    }
    // A velocity along an axis, or a rotation about it, that is lost: no joint has any.
    if let [w] = &said.lost[..] {
        let parts: Vec<usize> = (0..6).filter(|&k| w[k] != 0.0).collect();
        if let [k] = parts[..] {
            let unit = if k < 3 { size } else { 1.0 };
            let most =
                geometric(robot, q, view).columns.iter().map(|c| c[k].abs() / unit).fold(0.0, f64::max);
            if most > STILL {
                return Some(format!("component {k} is not lost: {most:e}"));
            }
        }
    }
    // Where only a point stands still, the body turns about it.
    if let ([free], Still::Point) = (&said.free[..], said.still) {
        let joints: Vec<usize> = (0..free.len()).filter(|&j| free[j] != 0.0).collect();
        let motion = slowest(&motions, &joints, Still::Point).1;
        let turned = |k: usize| joints.iter().zip(&motion).map(|(&j, x)| motions[j][k] * x).sum::<f64>();
        if (3..6).all(|k| turned(k).abs() < STILL) {
            return Some("the body stands still as well".into());
        }
    }
    None
}

/// A few arms of books and of the catalogue, then arms made at random.
fn arms(random: &mut Random) -> Vec<Description> {
    let named = ["articulated-3r", "spherical-rrp", "cylindrical-rpp", "planar-2r", "planar-3r", "scara"];
    let larger =
        ["al5d", "rhino-xr3", "staubli-rx90", "puma560", "stanford", "adept-one", "parallelogram-5r"];
    let mut all: Vec<Description> = named.into_iter().chain(larger).map(robot).collect();
    for k in 0..share(400, 24) {
        let kind = [Kind::Few, Kind::Few, Kind::Few, Kind::Geared][k % 4];
        let text = text(random, kind);
        all.push(read_toml(&text).unwrap_or_else(|e| panic!("{text}\n{e:?}")).0);
    }
    all.into_iter().map(|d| d.filled()).filter(|d| d.variables().len() <= 6).collect()
}

type Derive = fn(&Description, Reference) -> Result<Singularities, Obstacle>;

const DERIVATIONS: [(&str, Derive); 2] =
    [("body", Singularities::derive as Derive), ("point", Singularities::of_position as Derive)];

#[test]
fn what_is_said_of_motions_is_so() {
    let mut random = Random(5);
    let (mut looked_at, mut of_points) = (0, 0);
    for d in arms(&mut random) {
        let Ok(robot) = Robot::numeric(&d) else { continue };
        let size = robot.reach().max(1e-12);
        for (what, derive) in DERIVATIONS {
            let Ok(found) = derive(&d, Reference::Tool) else { continue };
            let factors: Vec<Expr> = found.common.iter().map(|s| s.factor).collect();
            for s in &found.common {
                let near: Vec<f64> = (0..robot.joints).map(|_| 6.0 * random.unit() - 3.0).collect();
                let own = singular_configuration(&d, s.factor, &factors, &near);
                let (Some(said), Some(q)) = (&s.example, own) else { continue };
                let seen = found.jacobian.view;
                let view =
                    Viewpoint { axes: seen.axes, body: seen.body, at: seen.at, offset: Vector([0.0; 3]) };
                let wrong = fault((&robot, &view), &q, size, said);
                assert!(wrong.is_none(), "{} {what} {}: {wrong:?} at {q:?}", d.name, s.factor);
                looked_at += usize::from(said.place != Place::Differs);
                of_points += usize::from(said.still == Still::Point);
            }
        }
    }
    assert!(looked_at > 24 && of_points > 8, "{looked_at} {of_points}");
}

/// The smallest singular value of the rows that count, walked down from a random configuration.
fn least(robot: &Robot<f64>, rows: &[usize], size: f64, random: &mut Random) -> (f64, Vec<f64>) {
    let value = |q: &[f64]| {
        let columns: Vec<[f64; 6]> = motions(robot, q, size)
            .iter()
            .map(|c| std::array::from_fn(|k| if rows.contains(&k) { c[k] } else { 0.0 }))
            .collect();
        svd(columns).values[rows.len().min(robot.joints) - 1]
    };
    let mut q: Vec<f64> = (0..robot.joints).map(|_| 6.0 * random.unit() - 3.0).collect();
    let (mut best, mut step) = (value(&q), 0.5);
    while step > 1e-9 {
        let before = best;
        for j in 0..q.len() {
            for by in [step, -step] {
                q[j] += by;
                let there = value(&q);
                if there < best {
                    best = there;
                } else {
                    q[j] -= by;
                }
            }
        }
        if best >= before {
            step *= 0.5;
        }
    }
    (best, q)
}

/// Where all singularities are said to be known, descent to singular configurations ends at none other.
#[test]
fn no_other_singularities_where_all_are_known() {
    let mut random = Random(6);
    let (mut never, mut known, mut by_sets) = (0, 0, 0);
    for d in arms(&mut random) {
        let Ok(robot) = Robot::numeric(&d) else { continue };
        let size = robot.reach().max(1e-12);
        for (what, derive) in DERIVATIONS {
            let Ok(found) = derive(&d, Reference::Tool) else { continue };
            // Joints that never move the body make it singular everywhere, and are left out.
            let is_whole = found.minors[0].joints.len() == robot.joints.min(found.rows.len());
            let Some(others) = &found.others else { continue };
            // A walk takes long: of arms with such lists a few.
            let is_enough = !others.is_empty() && by_sets >= 4;
            if found.minors.len() == 1 || !is_whole || found.deficient.is_some() || is_enough {
                continue;
            }
            known += 1;
            never += usize::from(found.common.is_empty() && others.is_empty());
            by_sets += usize::from(!others.is_empty());
            let values = d.known_values();
            for _ in 0..4 {
                let (sigma, q) = least(&robot, &found.rows, size, &mut random);
                let value = |s: Symbol| {
                    let joint = d.variables().iter().position(|v| v.symbol == s).map(|j| q[j]);
                    joint.or_else(|| values.iter().find(|v| v.0 == s).map(|v| v.1))
                };
                let least = found.common.iter().map(|s| s.factor.eval(value).map_or(1.0, f64::abs));
                let together = |set: &Vec<Expr>| {
                    set.iter().map(|f| f.eval(value).map_or(1.0, f64::abs)).fold(0.0, f64::max)
                };
                let is_listed = least.chain(others.iter().map(together)).fold(f64::INFINITY, f64::min)
                    < 1e-3 * size.min(1.0);
                assert!(sigma > 1e-6 || is_listed, "{} {what}: {sigma:e} at {q:?}", d.name);
            }
        }
    }
    assert!(known > 5 && never > 2 && by_sets > 0, "{known} {never} {by_sets}");
}

/// What is said of a hand's origin beside its body: of arms with three joints at the most, and only what is not said of the body.
/// There the three rows lose rank.
#[test]
fn the_point_is_looked_at_where_it_is_singular_elsewhere() {
    let mut random = Random(8);
    let mut looked_at = 0;
    for d in arms(&mut random) {
        let Ok(robot) = Robot::numeric(&d) else { continue };
        let Ok(whole) = Singularities::derive(&d, Reference::Tool) else { continue };
        let Some(point) = whole.of_its_point(&d) else { continue };
        assert!(robot.joints <= 3 && point.rows == [0, 1, 2], "{}", d.name);
        let size = robot.reach().max(1e-12);
        for example in point.common.iter().flat_map(|s| &s.example) {
            let linear: Vec<[f64; 6]> = motions(&robot, &example.q, size)
                .iter()
                .map(|c| std::array::from_fn(|k| if k < 3 { c[k] } else { 0.0 }))
                .collect();
            let moving = point.minors[0].joints.len();
            let rank = svd(linear).values.iter().filter(|x| **x > 1e-6).count();
            assert!(rank < moving, "{}: {rank} of {moving} at {:?}", d.name, example.q);
            looked_at += 1;
        }
        let factors = |s: &Singularities| s.common.iter().map(|s| s.factor).collect::<Vec<_>>();
        assert!(factors(&whole) != factors(&point) || whole.is_complete != point.is_complete, "{}", d.name);
    }
    assert!(looked_at > 5, "{looked_at}");
}

/// The anthropomorphic arm: the whole body is never held still by its three joints; its point is in three ways.
#[test]
fn the_anthropomorphic_arm() {
    let d = robot("articulated-3r");
    let whole = Singularities::derive(&d, Reference::Tool).expect("short");
    assert!(whole.common.is_empty() && whole.is_complete, "{whole:#?}");
    let point = Singularities::of_position(&d, Reference::Tool).expect("short");
    let places: Vec<&Place> = point.common.iter().flat_map(|s| &s.example).map(|e| &e.place).collect();
    let stretched = Place::PointInPlane { axes: [1, 2], parallel: true };
    assert_eq!(places, [&stretched, &Place::PointOnAxis(0)]);
}

/// An arm whose hand always lacks a direction: where its rank of five drops again, in numbers.
#[test]
fn an_arm_that_is_singular_everywhere() {
    let d = robot("prrrrp");
    let found = Singularities::derive(&d, Reference::Tool).expect("short");
    assert_eq!(found.deficient, Some(5));
    let robot = Robot::numeric(&d.filled()).expect("values");
    let rank = |q: &[f64]| {
        let columns = geometric(&robot, q, &Viewpoint::tool()).columns;
        svd(columns).values.iter().filter(|x| **x > 1e-7).count()
    };
    assert_eq!(rank(&[0.3, 0.4, 0.5, 0.6, 0.7, 0.2]), 5);
    let others = found.others.expect("few");
    let lists: Vec<Vec<String>> =
        others.iter().map(|set| set.iter().map(ToString::to_string).collect()).collect();
    assert_eq!(lists, [vec!["sin(q3)", "sin(q4)"], vec!["a2 + a3*cos(q3)", "sin(q3 + q4)"]]);
    // The arm straight: one of the places that the first list means.
    assert!(rank(&[0.3, 0.4, 0.0, 0.0, 0.7, 0.2]) < 5);
}

/// In a plane that stands upright: what is lost is the way along the stretched arm, not the way out of the plane, which is never had.
#[test]
fn what_is_never_had_is_not_lost() {
    let text = "convention = \"standard\"\n[parameters]\nl1 = 0.5\nl2 = 0.4\n[[joints]]\nalpha = \"90 deg\"\n\
                [[joints]]\ntheta = \"q1\"\na = \"l1\"\n[[joints]]\ntheta = \"q2\"\na = \"l2\"\n";
    let d = read_toml(text).expect("a robot").0;
    let found = Singularities::of_position(&d, Reference::Tool).expect("short");
    let [stretched] = &found.common[..] else { panic!("{found:#?}") };
    let said = stretched.example.as_ref().expect("an example");
    assert_eq!(said.lost, [[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]], "{said:?}");
    let robot = Robot::numeric(&d).expect("values");
    let view = found.jacobian.view;
    let view = Viewpoint { axes: view.axes, body: view.body, at: view.at, offset: Vector([0.0; 3]) };
    let along =
        |q: [f64; 2]| geometric(&robot, &q, &view).columns.iter().map(|c| c[0].abs()).fold(0.0, f64::max);
    assert!(along([0.4, 0.0]) < 1e-12 && along([0.4, 0.7]) > 0.1);
}

/// Seven joints, with the elbow stretched: axes 3 and 5 come to lie on one line, and the way along the arm is lost.
#[test]
fn axes_on_one_line_of_an_arm_with_a_joint_too_many() {
    let d = robot("kuka-iiwa-14");
    let found = Singularities::derive(&d, Reference::Tool).expect("short");
    let [stretched] = &found.common[..] else { panic!("{:?}", found.common) };
    let said = stretched.example.as_ref().expect("an example");
    assert_eq!(said.place, Place::OneLine(2, 4));
    let arm = Robot::numeric(&d).expect("values");
    let size = arm.reach();
    let near: Vec<f64> = vec![0.3, 0.7, 1.1, 0.2, 0.8, 0.9, 0.4];
    let q = singular_configuration(&d, stretched.factor, &[stretched.factor], &near).expect("stretched");
    let view = found.jacobian.view;
    let view = Viewpoint { axes: view.axes, body: view.body, at: view.at, offset: Vector([0.0; 3]) };
    assert_eq!(fault((&arm, &view), &q, size, said), None);
    let along = |q: &[f64]| svd(motions(&arm, q, size)).values.get(5).copied().unwrap_or(0.0);
    assert!(along(&q) < 1e-8 && along(&near) > 1e-4);
}
