//! Inverse kinematics by descent: every reachable target is reached within the limits; what cannot be reached is told
//! from what was not found; outcomes are the same to the bit however they are asked for.
//!
//! A solution is judged by the plain product of the table's link transforms, never by what the solver computes with.

use crate::common::{Random, share};
use denavit::description::{Description, read_toml};
use denavit::geometry::{Axis, Rotation, Transform, Vector};
use denavit::inverse::numeric::{Axes, Frame, NumericSolver, Outcome, Preference, Status, Task, TaskKind};
use denavit::inverse::{Goal, JointSpace};
use denavit::{Robot, catalogue};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;
use std::num::NonZero;

struct Case {
    description: Description,
    robot: Robot<f64>,
    space: JointSpace,
}

impl Case {
    fn of(mut description: Description) -> Self {
        // Robots given with symbols only get lengths that are not special.
        let mut next = 31;
        for p in description.parameters.iter_mut().filter(|p| p.value.is_none()) {
            p.value = Some(denavit_symbolic::Rational::new(next, 100).into());
            next += 7;
        }
        let robot = Robot::numeric(&description).expect("all parameters have values");
        let space = JointSpace::new(&description, &robot);
        Case { description, robot, space }
    }

    fn named(name: &str) -> Self {
        Self::of(catalogue::robot(name).expect("a robot of the catalogue"))
    }

    fn text(text: &str) -> Self {
        Self::of(read_toml(text).unwrap_or_else(|e| panic!("{e:?}")).0)
    }

    fn solver(&self, goal: Goal) -> NumericSolver {
        NumericSolver::new(&self.description, goal).expect("all parameters have values")
    }

    /// Within the limits; without, a turn or as much as the arm is long.
    fn random(&self, random: &mut Random) -> Vec<f64> {
        let joints = self.space.limits.iter().zip(&self.space.is_angle);
        joints
            .map(|(limits, &is_angle)| {
                let half = if is_angle { PI } else { 0.5 * self.space.reach.max(0.5) };
                let [l, h] = limits.unwrap_or([-half, half]);
                l + (h - l) * random.unit()
            })
            .collect()
    }

    fn is_within_limits(&self, q: &[f64]) -> bool {
        self.space.limits.iter().zip(q).all(|(l, x)| l.is_none_or(|[l, h]| (l..=h).contains(x)))
    }
}

/// The angle between two orientations or two axes, and the distance, of what the goal asks for.
fn missed(goal: Goal, a: &Transform<f64>, b: &Transform<f64>) -> (f64, f64) {
    let apart = |axis: Axis| (a.rotation.column(axis) - b.rotation.column(axis)).norm();
    let angle = match goal {
        Goal::Position => 0.0,
        Goal::PositionAndAxis => apart(Axis::Z),
        Goal::Pose => Axis::ALL.map(apart).into_iter().fold(0.0, f64::max),
    };
    (angle, (a.translation - b.translation).norm())
}

/// Reaches targets of random configurations, all of them.
fn check_reached(case: &Case, goal: Goal, targets: usize, with_seed: bool) {
    let solver = case.solver(goal);
    let mut random = Random(11);
    for i in 0..targets {
        let pose = case.robot.pose(&case.random(&mut random));
        let seed = with_seed.then(|| case.random(&mut random));
        let outcome = solver.solve(&pose, seed.as_deref());
        let label = format!("{} {goal:?}, target {i}: {outcome:?}", case.description.name);
        assert_eq!(outcome.status, Status::Solved, "{label}");
        let (angle, distance) = missed(goal, &case.robot.pose(&outcome.q), &pose);
        assert!(angle < 1e-9 && distance < 1e-9 * solver.size(), "{label}: {angle} {distance}");
        assert!(case.is_within_limits(&outcome.q), "{label}");
    }
}

#[test]
fn every_target_is_reached_ur5() {
    check_reached(&Case::named("ur5"), Goal::Pose, 2000, false);
    check_reached(&Case::named("ur5"), Goal::Pose, 2000, true);
}

#[test]
fn every_target_is_reached_panda() {
    check_reached(&Case::named("franka-panda"), Goal::Pose, 2000, false);
    check_reached(&Case::named("franka-panda"), Goal::Pose, 2000, true);
}

#[test]
fn every_target_is_reached_with_few_joints() {
    check_reached(&Case::named("adept-cobra-600"), Goal::Pose, 2000, false);
    check_reached(&Case::named("rhino-xr3"), Goal::PositionAndAxis, 2000, false);
    check_reached(&Case::named("planar-3r"), Goal::Position, 2000, true);
    // Joints that stand in two rows.
    check_reached(&Case::named("parallelogram-5r"), Goal::PositionAndAxis, 500, false);
}

#[test]
fn every_target_of_every_robot_is_reached() {
    for name in catalogue::names() {
        let case = Case::named(name);
        for goal in [Goal::Pose, Goal::Position, Goal::PositionAndAxis] {
            check_reached(&case, goal, share(1000, 20), false);
        }
    }
}

/// A chain whose axes are parallel, or stand across each other in turn.
fn chain(joints: usize, is_planar: bool) -> Case {
    let mut text = "name = \"chain\"\nconvention = \"standard\"\n".to_string();
    for i in 1..=joints {
        let twist = match i % 3 {
            _ if is_planar => 0,
            0 => 90,
            1 => -90,
            _ => 35,
        };
        write!(
            text,
            "[[joints]]\ntheta = \"q{i}\"\na = \"0.1 m\"\nalpha = \"{twist} deg\"\nlimits = [\"-120 deg\", \"120 deg\"]\n"
        )
        .expect("a string takes text");
    }
    Case::text(&text)
}

#[test]
fn long_chains_are_led_to_targets() {
    check_reached(&chain(30, true), Goal::PositionAndAxis, 50, false);
    check_reached(&chain(30, true), Goal::Pose, 50, true);
    check_reached(&chain(30, false), Goal::Pose, 100, true);
    check_reached(&chain(60, false), Goal::Pose, 30, false);
    check_reached(&chain(1, false), Goal::Pose, 20, false);
}

#[test]
fn beyond_reach_the_arm_stretches() {
    // Lengths 1, 0.8, 0.4: 2.2 m at most. A point at 3 m along a line is missed by 0.8 m, and the nearest
    // configuration is the stretched one.
    let case = Case::named("planar-3r");
    let solver = case.solver(Goal::Position);
    for (k, seed) in [None, Some([0.0; 3]), Some([PI, 0.0, 0.0]), Some([1.0, -2.0, 0.3])].iter().enumerate() {
        let direction = 0.3 + k as f64;
        let target = Transform::translation(3.0 * direction.cos(), 3.0 * direction.sin(), 0.0);
        let outcome = solver.nearest(&target, seed.as_ref().map(|s| &s[..]));
        assert_eq!(outcome.status, Status::Unreachable, "{outcome:?}");
        assert!((outcome.beyond_reach.expect("a proof") - 0.8).abs() < 1e-12, "{outcome:?}");
        assert!((outcome.residuals[0].distance - 0.8).abs() < 1e-12, "{outcome:?}");
        let q = [direction, 0.0, 0.0];
        assert!(case.space.distance(&outcome.q, &q) < 1e-6, "{outcome:?}");
    }
    // Above the plane: the point of the plane below it is nearest, and no length says that it is out of reach.
    let target = Transform::translation(0.9, 1.1, 0.25);
    let outcome = solver.solve(&target, None);
    assert_eq!((outcome.status, outcome.beyond_reach), (Status::Unreachable, None), "{outcome:?}");
    assert!((outcome.residuals[0].distance - 0.25).abs() < 1e-12, "{outcome:?}");
}

#[test]
fn a_hole_in_the_middle_is_proved() {
    // 1 m and 0.3 m: nothing nearer than 0.7 m.
    let arm = "name = \"arm\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\na = \"1 m\"\n[[joints]]\ntheta = \"q2\"\na = \"0.3 m\"\n";
    let outcome = Case::text(arm).solver(Goal::Position).solve(&Transform::translation(0.2, 0.1, 0.0), None);
    assert_eq!(outcome.status, Status::Unreachable);
    let gap = 0.7 - 0.05_f64.sqrt();
    assert!((outcome.beyond_reach.expect("a proof") - gap).abs() < 1e-12, "{outcome:?}");
    assert!((outcome.residuals[0].distance - gap).abs() < 1e-12, "{outcome:?}");
}

#[test]
fn a_slide_stops_at_its_limit() {
    // A slide of 0.1 to 0.5 m along z: a target at 0.8 m is missed by 0.3 m, one at 0.3 m is met.
    let slide = "name = \"slide\"\nconvention = \"standard\"\n[[joints]]\nd = \"q1\"\nlimits = [\"0.1 m\", \"0.5 m\"]\n";
    let solver = Case::text(slide).solver(Goal::Position);
    let outcome = solver.solve(&Transform::translation_z(0.8), None);
    assert_eq!(outcome.status, Status::Unreachable, "{outcome:?}");
    assert!(outcome.q == [0.5] && (outcome.residuals[0].distance - 0.3).abs() < 1e-15, "{outcome:?}");
    let outcome = solver.solve(&Transform::translation_z(0.3), Some(&[0.5]));
    assert!(outcome.is_solved() && (outcome.q[0] - 0.3).abs() < 1e-12, "{outcome:?}");
}

#[test]
fn a_local_minimum_is_told_from_unreachable() {
    // One joint from −170° to 170°, target at 160°: from −165° the way to it leads into the limit.
    let arm = "name = \"arm\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\na = \"1 m\"\nlimits = [\"-170 deg\", \"170 deg\"]\n";
    let case = Case::text(arm);
    let mut solver = case.solver(Goal::Position);
    let degrees = PI / 180.0;
    let target = case.robot.pose(&[160.0 * degrees]);
    solver.options.max_restarts = 0;
    let seed = [-165.0 * degrees];
    let stuck = solver.solve(&target, Some(&seed));
    assert_eq!(stuck.status, Status::LocalMinimum);
    assert!((stuck.q[0] + 170.0 * degrees).abs() < 1e-12, "{stuck:?}");
    // The chord of 30°.
    assert!((stuck.residuals[0].distance - 2.0 * (15.0 * degrees).sin()).abs() < 1e-12, "{stuck:?}");
    solver.options.max_restarts = 100;
    let found = solver.solve(&target, Some(&seed));
    assert!(found.is_solved() && found.restarts > 0, "{found:?}");
    // 180° is beyond both limits: two bottoms with one error.
    let outcome = solver.solve(&case.robot.pose(&[PI]), Some(&seed));
    assert_eq!((outcome.status, outcome.beyond_reach), (Status::Unreachable, None), "{outcome:?}");
    assert!((outcome.residuals[0].distance - 2.0 * (5.0 * degrees).sin()).abs() < 1e-12, "{outcome:?}");
}

fn bits(outcomes: &[Outcome]) -> Vec<u64> {
    let of = |o: &Outcome| {
        let counts = [o.restarts as u64, o.iterations as u64, o.status as u64];
        o.q.iter().map(|x| x.to_bits()).chain(counts).collect::<Vec<_>>()
    };
    outcomes.iter().flat_map(of).collect()
}

#[test]
fn outcomes_are_the_same_to_the_bit() {
    let case = Case::named("franka-panda");
    let mut random = Random(5);
    let mut poses: Vec<_> = (0..101).map(|_| case.robot.pose(&case.random(&mut random))).collect();
    poses[17] = Transform::translation(3.0, 0.0, 0.0) * poses[17];
    let solver = case.solver(Goal::Pose);
    let alone: Vec<Outcome> = poses.iter().map(|p| solver.solve(p, None)).collect();
    let wanted = bits(&alone);
    for threads in [1, 2, 3] {
        assert_eq!(bits(&solver.solve_batch(&poses, NonZero::new(threads))), wanted, "{threads} threads");
    }
    // Backwards, in a solver that has done other things.
    let backwards: Vec<Outcome> = poses.iter().rev().map(|p| solver.solve(p, None)).collect();
    assert_eq!(bits(&backwards.into_iter().rev().collect::<Vec<_>>()), wanted);
    assert_eq!(bits(&case.solver(Goal::Pose).solve_batch(&poses, None)), wanted);
}

fn posture_cost(q: &[f64], near: &[f64]) -> f64 {
    q.iter().zip(near).map(|(a, b)| (a - b).powi(2)).sum()
}

#[test]
fn a_posture_is_approached_with_the_hand_still() {
    let case = Case::named("franka-panda");
    let near = [0.0, -PI / 4.0, 0.0, -3.0 * PI / 4.0, 0.0, FRAC_PI_2, PI / 4.0];
    let task = [Task::hard(Frame::Tool, TaskKind::Pose)];
    let posture = [Preference::Posture { near: near.to_vec(), weight: 1.0 }];
    let wishing = NumericSolver::with_tasks(&case.description, &task, &posture).expect("it has numbers");
    let plain = case.solver(Goal::Pose);
    let mut random = Random(3);
    for _ in 0..200 {
        let pose = case.robot.pose(&case.random(&mut random));
        let (a, b) = (plain.solve(&pose, Some(&near)), wishing.solve(&pose, None));
        assert!(a.is_solved() && b.is_solved() && case.is_within_limits(&b.q));
        let (angle, distance) = missed(Goal::Pose, &case.robot.pose(&b.q), &pose);
        assert!(angle < 1e-9 && distance < 1e-9 * wishing.size());
        assert!(posture_cost(&b.q, &near) <= posture_cost(&a.q, &near) + 1e-12, "{a:?} {b:?}");
        // At the least distance, a small motion with the hand still leads no nearer: the solver's own answer as start
        // stays where it is.
        let again = wishing.solve(&pose, Some(&b.q));
        let [x, y] = [&again, &b].map(|o| posture_cost(&o.q, &near));
        assert!((x - y).abs() < 1e-9, "{x} {y} {again:?} {b:?}");
    }
    // A plane arm of three equal links with its end at a point: the posture that is nearest to (x, −x, …) is known
    // where the target is met by it.
    let middle = [Preference::MiddleOfLimits { weight: 1.0 }];
    let position = [Task::hard(Frame::Tool, TaskKind::Position)];
    let arm = chain(3, true);
    let solver = NumericSolver::with_tasks(&arm.description, &position, &middle).expect("it has numbers");
    let outcome = solver.solve(&Transform::translation_x(0.3 - 1e-9), None);
    assert!(outcome.is_solved() && outcome.q.iter().all(|x| x.abs() < 1e-3), "{outcome:?}");
}

#[test]
fn soft_tasks_yield_to_hard_ones() {
    // The end of a plane arm of 0.4 m at (0.2, 0); the second joint's end wants to be at (0.1, 0.1) and can be:
    // links of 0.1 m from there lead to the end.
    let arm = chain(4, true);
    let tasks =
        [Task::hard(Frame::Tool, TaskKind::Position), Task::soft(Frame::Link(2), TaskKind::Position, 1.0)];
    let solver = NumericSolver::with_tasks(&arm.description, &tasks, &[]).expect("it has numbers");
    let at = |x, y| Transform::translation(x, y, 0.0);
    let outcome = solver.solve_tasks(&[at(0.2, 0.0), at(0.1, 0.1)], None);
    assert!(outcome.is_solved());
    assert!(outcome.residuals[0].distance < 1e-9 && outcome.residuals[1].distance < 1e-6, "{outcome:?}");
    // From (0, 0.2) the end at (0.2, 0) is 0.283 m away, further than the 0.2 m of the last two links.
    let outcome = solver.solve_tasks(&[at(0.2, 0.0), at(0.0, 0.2)], None);
    assert!(outcome.is_solved() && outcome.residuals[0].distance < 1e-9);
    // Nearest then: links 1 and 2 end on the circle of 0.2 m about (0.2, 0) and within 0.2 m of the base.
    let nearest = 0.2 * 2.0_f64.sqrt() - 0.2;
    assert!((outcome.residuals[1].distance - nearest).abs() < 1e-6, "{outcome:?}");
}

#[test]
fn parts_of_poses_are_met_and_the_rest_is_free() {
    let case = Case::named("ur5");
    let mut random = Random(9);
    let all = [true; 3];
    let kinds = [
        ("axis z", [true, true, false], all, Axes::Own),
        ("axis y", [true, false, true], all, Axes::Own),
        ("heading free", [true, true, false], all, Axes::Base),
        ("one turn", [false, false, true], all, Axes::Base),
        ("one turn of the tool", [true, false, false], all, Axes::Own),
        ("on a line", all, [true, true, false], Axes::Own),
        ("on a level", all, [false, false, true], Axes::Base),
        ("orientation", all, [false; 3], Axes::Base),
    ];
    for (name, turns, shifts, axes) in kinds {
        let task = [Task::hard(Frame::Tool, TaskKind::Components { turns, shifts, axes })];
        let solver = NumericSolver::with_tasks(&case.description, &task, &[]).expect("it has numbers");
        for i in 0..100 {
            let target = case.robot.pose(&case.random(&mut random));
            let outcome = solver.solve(&target, None);
            assert!(outcome.is_solved(), "{name} {i}: {outcome:?}");
            let pose = case.robot.pose(&outcome.q);
            let d = pose.translation - target.translation;
            let shift = if axes == Axes::Base { d } else { target.rotation.inverse() * d };
            let left: Vec<f64> = (0..3).filter(|&k| shifts[k]).map(|k| shift[k].abs()).collect();
            assert!(left.iter().all(|x| *x < 1e-8), "{name} {i}: {left:?}");
            let turn = rotation_vector(&match axes {
                Axes::Own => pose.rotation.inverse() * target.rotation,
                Axes::Base => target.rotation * pose.rotation.inverse(),
            });
            for k in (0..3).filter(|&k| turns[k]) {
                assert!(turn[k].abs() < 1e-7, "{name} {i}: {turn:?}");
            }
        }
    }
}

/// The rotation vector of a rotation (Rodrigues), away from half a turn.
fn rotation_vector(r: &Rotation<f64>) -> [f64; 3] {
    let (x, y, z) = (r.x(), r.y(), r.z());
    let s = Vector::new(y[2] - z[1], z[0] - x[2], x[1] - y[0]).scale(0.5);
    let angle = s.norm().atan2(0.5 * (x[0] + y[1] + z[2] - 1.0));
    s.scale(if s.norm() > 1e-12 { angle / s.norm() } else { 1.0 }).0
}

#[test]
fn two_frames_of_a_long_arm_are_placed_at_once() {
    let case = chain(20, false);
    let tasks = [Task::hard(Frame::Tool, TaskKind::Pose), Task::hard(Frame::Link(10), TaskKind::Position)];
    let solver = NumericSolver::with_tasks(&case.description, &tasks, &[]).expect("it has numbers");
    let mut random = Random(2);
    for i in 0..50 {
        let q = case.random(&mut random);
        let targets = [case.robot.pose(&q), case.robot.frames(&q)[10]];
        let outcome = solver.solve_tasks(&targets, None);
        assert!(outcome.is_solved() && case.is_within_limits(&outcome.q), "{i}: {outcome:?}");
        let elbow = case.robot.frames(&outcome.q)[10].translation - targets[1].translation;
        assert!(elbow.norm() < 1e-9 * solver.size());
    }
}

#[test]
fn searches_can_be_stopped() {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;
    let case = Case::named("ur5");
    let mut solver = case.solver(Goal::Pose);
    solver.options.stop = Some(Arc::new(AtomicBool::new(true)));
    let pose = case.robot.pose(&[0.3; 6]);
    assert_eq!(solver.solve(&pose, None).status, Status::Stopped);
    solver.options.stop = None;
    assert!(solver.solve(&pose, None).is_solved());
}
