//! Poses one after the other: solutions within the limits, next to the last one or said to be a jump.

use crate::common::{Random, case, robot, share};
use denavit::Description;
use denavit::geometry::{Transform, Vector};
use denavit::inverse::{Course, InverseKinematics, InverseOptions, JointSpace, Tracked};
use std::f64::consts::PI;

/// Steps of a path; no joint of the configurations that it is made of moves by more than a 200th of 2π a step.
const STEPS: usize = 200;

fn solver(d: &Description) -> InverseKinematics {
    InverseKinematics::new(d, &InverseOptions::default()).unwrap_or_else(|e| panic!("{}: {e}", d.name))
}

/// A configuration well within the limits.
fn inside(space: &JointSpace, random: &mut Random) -> Vec<f64> {
    let value = |limits: &Option<[f64; 2]>| {
        let [low, high] = limits.unwrap_or([-PI, PI]);
        let (middle, half) = (f64::midpoint(low, high), 0.45 * (high - low));
        middle + half.min(PI) * (2.0 * random.unit() - 1.0)
    };
    space.limits.iter().map(value).collect()
}

/// The arms of seven joints.
fn arms() -> Vec<Description> {
    let of_catalogue = denavit::catalogue::names().into_iter().map(robot);
    let seven = of_catalogue.filter(|d| d.variables().len() == 7 && solver(d).method() == "self-motion");
    seven.chain(["gen3_7", "iiwa14urdf"].map(case)).collect()
}

/// The path of an arm's hand on the way between two configurations, tracked from the first; how many steps were jumps.
fn track(d: &Description, solver: &InverseKinematics, random: &mut Random) -> usize {
    let [from, to] = [(); 2].map(|()| inside(&solver.space, random));
    let mut last = from.clone();
    let mut jumps = 0;
    for k in 1..=STEPS {
        let part = k as f64 / STEPS as f64;
        let q: Vec<f64> = from.iter().zip(&to).map(|(x, y)| x + part * (y - x)).collect();
        let pose = solver.robot.pose(&q);
        let found = solver.track(&pose, &last).unwrap_or_else(|| panic!("{}: nothing at step {k}", d.name));
        judge(d, solver, &pose, &last, &found);
        jumps += usize::from(found.course == Course::Jumped);
        last = found.q;
    }
    jumps
}

fn judge(d: &Description, solver: &InverseKinematics, pose: &Transform<f64>, last: &[f64], found: &Tracked) {
    let have = solver.robot.pose(&found.q);
    let rows = have.matrix().into_iter().flatten().zip(pose.matrix().into_iter().flatten());
    let miss = rows.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    assert!(miss <= 1e-9, "{}: misses the pose by {miss:e}: {found:?}", d.name);
    // The pose is that of a configuration within the limits.
    assert_ne!(found.course, Course::BeyondLimits, "{}: {found:?}", d.name);
    for (j, limits) in solver.space.limits.iter().enumerate() {
        let Some([low, high]) = *limits else { continue };
        let x = found.q[j];
        assert!(low - 1e-8 <= x && x <= high + 1e-8, "{}: joint {} at {x}: {found:?}", d.name, j + 1);
        let beside = (x - low).min(high - x) <= 1e-9;
        assert!(
            !beside || found.at_limit.contains(&j),
            "{}: joint {} at its limit: {found:?}",
            d.name,
            j + 1
        );
    }
    let change = |j: usize| (found.q[j] - last[j]).abs() / solver.space.unit(j);
    let moved = (0..last.len()).map(change).fold(0.0, f64::max);
    assert!((moved - found.distance).abs() <= 1e-12, "{}: {moved} and {found:?}", d.name);
    let is_near = found.course == Course::Followed;
    assert!(!is_near || moved <= 0.5, "{}: a gap of {moved}: {found:?}", d.name);
}

#[test]
fn arms_with_seven_joints_follow_random_paths_within_their_limits() {
    let arms = arms();
    assert!(arms.len() >= 8, "only {} arms", arms.len());
    let mut random = Random(11);
    let (mut steps, mut jumps) = (0, 0);
    for d in &arms {
        let solver = solver(d);
        for _ in 0..share(40, 1) {
            jumps += track(d, &solver, &mut random);
            steps += STEPS;
        }
    }
    // Random paths lead into limits, where the arm has to go over to another branch.
    assert!(50 * jumps <= steps, "{jumps} jumps in {steps} steps");
}

#[test]
fn what_follows_is_the_nearest_of_all() {
    let mut random = Random(3);
    for name in ["franka-panda", "kuka-iiwa-14"] {
        let d = robot(name);
        let solver = solver(&d);
        let mut compared = 0;
        for _ in 0..share(40, 4) {
            let q = inside(&solver.space, &mut random);
            let next: Vec<f64> = q.iter().map(|x| x + 0.01 * (random.unit() - 0.5)).collect();
            let pose = solver.robot.pose(&next);
            let found = solver.track(&pose, &q).expect("it is reachable");
            let answer = solver.solve(&pose, &[]);
            let all = solver.nearest(&pose, &answer, &q).expect("it is reachable");
            // Both are least sums of squares.
            let square = |x: &[f64]| x.iter().zip(&q).map(|(x, y)| (x - y).powi(2)).sum::<f64>();
            assert!(square(&found.q) <= square(&all.q) * (1.0 + 1e-4) + 1e-12, "{name}: {found:?} {all:?}");
            compared += usize::from(found.course == Course::Followed);
        }
        assert!(compared > 0, "{name}: nothing was followed");
    }
}

#[test]
fn far_poses_are_jumps_and_poses_out_of_reach_are_none() {
    let solver = solver(&robot("franka-panda"));
    let mut random = Random(5);
    let [from, to] = [(); 2].map(|()| inside(&solver.space, &mut random));
    let far = solver.track(&solver.robot.pose(&to), &from).expect("it is reachable");
    assert_eq!(far.course, Course::Jumped, "{far:?}");
    let here = solver.robot.pose(&from);
    let away = here.translation + Vector([10.0, 0.0, 0.0]);
    let pose = Transform::from_rotation_translation(here.rotation, away);
    assert_eq!(solver.track(&pose, &from), None);
}

#[test]
fn arms_without_a_joint_to_spare_are_tracked_too() {
    let d = robot("ur5");
    let solver = solver(&d);
    let mut random = Random(7);
    let mut jumps = 0;
    for _ in 0..share(40, 4) {
        jumps += track(&d, &solver, &mut random);
    }
    assert!(jumps <= share(40, 4), "{jumps} jumps");
}
