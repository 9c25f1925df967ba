//! Every arm is solved, whatever method serves it; nothing nearly special is rounded; many poses are solved in order, the
//! same on any number of threads.

use crate::common::{Random, robot, share};
use denavit::catalogue;
use denavit::description::{Description, read_toml};
use denavit::geometry::Transform;
use denavit::inverse::{Answer, Criterion, Doubt, Goal, InverseKinematics, InverseOptions};
use denavit::robot::Robot;
use std::f64::consts::{PI, TAU};
use std::num::NonZero;

/// A configuration within the limits.
fn configuration(random: &mut Random, solver: &InverseKinematics) -> Vec<f64> {
    let space = &solver.space;
    let far = |is_angle: bool| if is_angle { PI } else { 1.0 };
    let range = space.limits.iter().zip(&space.is_angle).map(|(l, &a)| l.unwrap_or([-far(a), far(a)]));
    range.map(|[low, high]| low + random.unit() * (high - low)).collect()
}

fn solver(description: &Description) -> InverseKinematics {
    InverseKinematics::new(description, &InverseOptions::default()).expect("a robot with numbers")
}

/// Whether a configuration is among the solutions, or in a family.
fn holds(solver: &InverseKinematics, pose: &Transform<f64>, answer: &Answer, q: &[f64]) -> bool {
    answer.solutions.iter().any(|s| solver.space.distance(&s.q, q) <= 1e-5)
        || !answer.families.is_empty()
            && solver.nearest(pose, answer, q).is_some_and(|n| solver.space.distance(&n.q, q) <= 1e-4)
}

/// Robots of the catalogue whose tables have a value for everything.
fn with_numbers() -> impl Iterator<Item = (&'static str, Description)> {
    let all = catalogue::names().into_iter().map(|name| (name, robot(name)));
    all.filter(|(_, d)| Robot::numeric(d).is_ok())
}

#[test]
fn every_robot_is_solved() {
    for (name, description) in with_numbers() {
        let solver = solver(&description);
        let mut random = Random(1);
        for _ in 0..share(20, 8) {
            let q = configuration(&mut random, &solver);
            let pose = solver.robot.pose(&q);
            let given: Vec<f64> = solver.given.iter().map(|&j| q[j]).collect();
            let answer = solver.solve(&pose, &given);
            assert!(
                holds(&solver, &pose, &answer, &q),
                "{name} ({}): {q:?} is not among {answer:#?}",
                solver.method()
            );
        }
    }
}

/// One solution within the limits, for every robot at every pose that it can take.
#[test]
fn one_is_within_the_limits() {
    for (name, description) in with_numbers() {
        let solver = solver(&description);
        let mut random = Random(2);
        for _ in 0..share(20, 8) {
            let q = configuration(&mut random, &solver);
            let pose = solver.robot.pose(&q);
            let given: Vec<f64> = solver.given.iter().map(|&j| q[j]).collect();
            let answer = solver.one(&pose, &given, None);
            assert_eq!(answer.solutions.len(), 1, "{name} at {q:?}");
            assert!(answer.solutions[0].within_limits, "{name} at {q:?}: {answer:?}");
            assert_eq!(answer.doubt, Some(Doubt::OneAsked));
        }
    }
}

/// The text of a robot file with numbers off by up to `by`, radians, and metres.
fn perturbed(name: &str, by: f64) -> Description {
    let mut random = Random(3);
    let description = robot(name);
    let robot = Robot::numeric(&description).expect("numbers");
    let mut text = format!("name = \"{name}, off\"\nconvention = \"standard\"\n");
    for (k, link) in robot.links.iter().enumerate() {
        let mut off = || by * (2.0 * random.unit() - 1.0);
        let (a, alpha) = (link.after.translation[0], link.after.rotation.rows());
        let alpha = alpha[2][1].atan2(alpha[1][1]);
        text += &format!(
            "[[joints]]\ntheta = \"q{} + {}\"\nd = {:.17}\na = {:.17}\nalpha = {:.17}\n",
            k + 1,
            off(),
            link.d.offset + off(),
            a + off(),
            alpha + off()
        );
    }
    read_toml(&text).unwrap_or_else(|e| panic!("{text}: {e:?}")).0
}

/// Arms whose axes are almost parallel or almost meet: solved as they are.
#[test]
fn nearly_special_arms_are_solved_as_they_are() {
    for name in ["ur5", "ur10e", "puma560", "abb-irb2400-10"] {
        for by in [1e-3, 1e-5, 1e-7, 1e-9] {
            let solver = solver(&perturbed(name, by));
            assert!(!solver.nearly.is_empty());
            let mut random = Random(4);
            let mut doubtful = 0;
            for _ in 0..100 {
                let q = configuration(&mut random, &solver);
                let pose = solver.robot.pose(&q);
                let answer = solver.solve(&pose, &[]);
                assert!(
                    holds(&solver, &pose, &answer, &q),
                    "{name} off by {by}: {q:?} is not among {answer:#?}"
                );
                assert!(answer.solutions.iter().all(|s| s.residual <= 1e-10));
                doubtful += usize::from(!answer.is_complete());
            }
            println!("{name} off by {by:e}: {doubtful} of 100 answers are not certified complete");
        }
    }
}

#[test]
fn unreachable_poses_say_how_near_the_arm_comes() {
    for name in ["fanuc-crx10ia-l", "kuka-iiwa-14", "ur5"] {
        let solver = solver(&robot(name));
        let q = configuration(&mut Random(5), &solver);
        let mut pose = solver.robot.pose(&q);
        let direction = pose.translation.scale(1.0 / pose.translation.norm());
        pose.translation = direction.scale(10.0);
        let answer = solver.solve(&pose, &[]);
        assert!(!answer.is_reachable());
        let obstacle = answer.obstacle.expect("what stands in the way");
        let there = solver.robot.pose(&obstacle.q);
        let gap = (there.translation - pose.translation).norm();
        assert!((gap - obstacle.distance).abs() < 1e-9, "{name}: {gap} and {}", obstacle.distance);
        // It stretches out there: ten metres less its reach.
        assert!(gap < 10.0 - 0.5 * solver.space.reach * 0.8, "{name}: {gap}");
    }
}

#[test]
fn many_poses_are_solved_in_order_on_any_number_of_threads() {
    for name in ["fanuc-crx10ia-l", "ur5", "franka-panda"] {
        let solver = solver(&robot(name));
        let mut random = Random(6);
        let poses: Vec<Transform<f64>> =
            (0..60).map(|_| solver.robot.pose(&configuration(&mut random, &solver))).collect();
        let by = |threads: usize| solver.solve_all(&poses, &[], NonZero::new(threads).expect("some"));
        let one = by(1);
        assert_eq!(one.len(), poses.len());
        for threads in [2, 3, 7] {
            assert_eq!(by(threads), one, "{name} on {threads} threads");
        }
    }
}

/// Whole turns within the limits are counted, and the nearest copy is taken.
#[test]
fn whole_turns_within_the_limits() {
    let solver = solver(&robot("ur5"));
    let q = [0.3, -1.2, 1.4, -0.7, 0.8, 2.9];
    let pose = solver.robot.pose(&q);
    let answer = solver.solve(&pose, &[]);
    assert_eq!(solver.space.turns(0, 0.3), Some([-1, 0]));
    assert_eq!(solver.space.turns(0, -0.3), Some([0, 1]));
    let far: Vec<f64> = q.iter().map(|x| x - TAU * x.signum()).collect();
    let nearest = solver.nearest(&pose, &answer, &far).expect("solutions");
    assert!(nearest.within_limits && nearest.distance < 1e-9, "{nearest:?}");
}

/// The best of an answer is at least as good as all that it lists.
#[test]
fn the_best_solution_by_a_criterion() {
    for name in ["ur5", "fanuc-crx10ia-l", "franka-panda"] {
        let solver = solver(&robot(name));
        let q = configuration(&mut Random(8), &solver);
        let pose = solver.robot.pose(&q);
        let answer = solver.solve(&pose, &[]);
        let margin = |solver: &InverseKinematics, q: &[f64]| {
            let of = |(x, l): (&f64, &Option<[f64; 2]>)| l.map(|[a, b]| (x - a).min(b - x) / (b - a));
            q.iter().zip(&solver.space.limits).filter_map(of).fold(f64::INFINITY, f64::min)
        };
        let best = solver.best(&pose, &answer, &Criterion::FarthestFromLimits).expect("solutions");
        let middle = solver.space.middle();
        for s in answer.solutions.iter().chain(answer.families.iter().map(|f| &f.representative)) {
            let copy = solver.space.nearest_copy(&s.q, &middle);
            assert!(margin(&solver, &copy) <= margin(&solver, &best.q) + 1e-6, "{name}");
        }
    }
}

/// Joints that are given may leave six without a closed form.
#[test]
fn given_joints_without_a_closed_form() {
    let options = InverseOptions { goal: Goal::Pose, given: Some(vec![2]) };
    let solver = InverseKinematics::new(&robot("rethink-sawyer"), &options).expect("numbers");
    assert_eq!((solver.method(), solver.given.as_slice()), ("elimination", [2].as_slice()));
    let mut random = Random(9);
    for _ in 0..5 {
        let q = configuration(&mut random, &solver);
        let pose = solver.robot.pose(&q);
        let answer = solver.solve(&pose, &[q[2]]);
        assert!(holds(&solver, &pose, &answer, &q), "{q:?} is not among {answer:#?}");
    }
}

/// Nothing is lost silently when a thread fails: its panic is the caller's.
#[test]
#[should_panic(expected = "one value per given joint")]
fn a_panic_of_a_thread_is_that_of_the_caller() {
    let d = robot("ur5");
    let solver = InverseKinematics::new(&d, &InverseOptions::default()).expect("a solver");
    let poses = vec![Transform::identity(); 8];
    let _ = solver.solve_all(&poses, &[0.0], NonZero::new(2).expect("some"));
}

/// A geared wrist, seven axes moved by six joints: elimination finds all, from each solution the same.
#[test]
fn a_geared_wrist_is_solved_by_elimination() {
    let wrist = include_str!("../cases/irb5400.toml");
    let (description, _) = read_toml(wrist).expect("a robot file");
    let solver = solver(&description);
    assert_eq!(solver.method(), "elimination");
    let mut random = Random(3);
    let (mut most, mut complete) = (0, 0);
    let poses = share(200, 20);
    for _ in 0..poses {
        let q = configuration(&mut random, &solver);
        let pose = solver.robot.pose(&q);
        let answer = solver.solve(&pose, &[]);
        assert!(holds(&solver, &pose, &answer, &q), "{q:?} is not among {answer:#?}");
        complete += usize::from(answer.is_complete());
        for s in &answer.solutions {
            let again = solver.solve(&solver.robot.pose(&s.q), &[]);
            assert_eq!(again.solutions.len(), answer.solutions.len(), "{q:?}");
        }
        most = most.max(answer.solutions.len());
    }
    assert_eq!(most, 8);
    assert!(100 * complete >= 95 * poses, "{complete} of {poses} are complete");
}

/// An arm that no closed form and no elimination serves, three axes moved in two ways: descents find its solutions.
#[test]
fn descents_find_all_solutions() {
    let wrist = include_str!("../cases/irb5400.toml").replace("theta = \"-q5\"", "theta = \"-q5 - q4/2\"");
    let (description, _) = read_toml(&wrist).expect("a robot file");
    let solver = solver(&description);
    assert_eq!(solver.method(), "descent");
    let mut random = Random(3);
    for _ in 0..share(100, 10) {
        let q = configuration(&mut random, &solver);
        let pose = solver.robot.pose(&q);
        let answer = solver.solve(&pose, &[]);
        assert!(holds(&solver, &pose, &answer, &q), "{q:?} is not among {answer:#?}");
        assert_eq!(answer.doubt, Some(Doubt::Searched));
    }
}

#[test]
fn joints_that_are_given_stay() {
    let rows: String = [37, -52, 71, 20, -64, 83, 41, -33]
        .iter()
        .enumerate()
        .map(|(i, alpha)| {
            let (theta, a, d) = (i + 1, 0.3 - 0.03 * i as f64, 0.1 + 0.02 * i as f64);
            format!("[[joints]]\ntheta = \"q{theta}\"\nalpha = \"{alpha} deg\"\na = {a}\nd = {d}\n")
        })
        .collect();
    let (description, _) =
        read_toml(&format!("name = \"skew\"\nconvention = \"standard\"\n{rows}")).expect("a robot file");
    for given in [vec![2], vec![0, 5]] {
        let options = InverseOptions { given: Some(given.clone()), ..InverseOptions::default() };
        let solver = InverseKinematics::new(&description, &options).expect("a robot with numbers");
        let q: Vec<f64> = (0..8).map(|j| 0.4 - 0.23 * j as f64).collect();
        let values: Vec<f64> = given.iter().map(|&j| q[j]).collect();
        let answer = solver.solve(&solver.robot.pose(&q), &values);
        assert!(answer.is_reachable(), "{given:?}");
        for s in &answer.solutions {
            assert!(given.iter().all(|&j| (s.q[j] - q[j]).abs() < 1e-12), "{given:?}: {:?}", s.q);
        }
    }
}
