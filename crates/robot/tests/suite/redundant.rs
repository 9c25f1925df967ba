//! Redundant arms: the manifold of a pose is complete and exact, limits cut it exactly, and one configuration within the
//! limits is found whenever there is one. Self-motions: curves are closed, and agree with closed forms.

use crate::common::{Random, robot, share};
use denavit::geometry::{Transform, Vector};
use denavit::inverse::{
    Component, Criterion, CurveEnd, Goal, JointSpace, Manifold, NotSolved, RedundantSolver, SelfMotion,
    self_motion,
};
use denavit::{Description, Robot, description};
use std::f64::consts::{PI, TAU};

fn solver(d: &Description) -> RedundantSolver {
    RedundantSolver::new(d, Goal::Pose).unwrap_or_else(|e| panic!("{}: {e}", d.name))
}

/// A spherical shoulder and wrist with an offset elbow, in another convention, with a base, a tool, offsets of joint
/// zeros, joints counted the other way, lengths moved between rows, and a constant row.
const SKEWED: &str = r#"
name = "Skewed SRS"
convention = "craig"
[[joints]]
alpha = "20 deg"
a = "0.05 m"
theta = "-q1 + 0.3 rad"
d = "0.31 m"
limits = ["-2.5 rad", "2.7 rad"]
[[joints]]
alpha = "90 deg"
theta = "q2 - 0.2 rad"
limits = ["-2.1 rad", "1.9 rad"]
[[joints]]
alpha = "-90 deg"
theta = "q3 + 30 deg"
d = "0.42 m"
limits = ["-2.9 rad", "2.9 rad"]
[[joints]]
alpha = "90 deg"
a = "0.06 m"
theta = "q4 + 90 deg"
d = "0.02 m"
limits = ["-2.2 rad", "2.2 rad"]
[[joints]]
alpha = "-90 deg"
a = "-0.04 m"
theta = "q5 - 15 deg"
d = "0.4 m"
limits = ["-2.6 rad", "2.8 rad"]
[[joints]]
alpha = "90 deg"
theta = "-q6"
limits = ["-1.9 rad", "2.0 rad"]
[[joints]]
alpha = "-90 deg"
theta = "q7 + 1 rad"
limits = ["-3.0 rad", "2.5 rad"]
[[joints]]
alpha = "35 deg"
a = "0.03 m"
d = "0.1 m"
[base]
xyz = ["0.1 m", "-0.2 m", "0.5 m"]
rpy = ["10 deg", "20 deg", "30 deg"]
[tool]
xyz = ["0.01 m", "0.02 m", "0.15 m"]
rpy = ["0", "45 deg", "5 deg"]
"#;

fn skewed() -> Description {
    description::read_toml(SKEWED).expect("a robot").0
}

fn oblique() -> Description {
    // Twists of 70° and 80° instead of right angles: not every direction can be reached.
    let text = SKEWED.replacen("\"90 deg\"", "\"70 deg\"", 1).replacen("\"-90 deg\"", "\"-80 deg\"", 1);
    description::read_toml(&text).expect("a robot").0
}

/// A random configuration within the limits.
fn within(space: &JointSpace, random: &mut Random) -> Vec<f64> {
    let value = |limits: &Option<[f64; 2]>, random: &mut Random| {
        let [low, high] = limits.unwrap_or([-PI, PI]);
        low + (high - low) * random.unit()
    };
    space.limits.iter().map(|limits| value(limits, random)).collect()
}

/// How far the worst joint is beyond its limits, whole turns left aside.
fn beyond(space: &JointSpace, q: &[f64]) -> f64 {
    let of = |(x, limits): (&f64, &Option<[f64; 2]>)| {
        let Some([low, high]) = *limits else { return f64::NEG_INFINITY };
        if high - low >= TAU {
            return f64::NEG_INFINITY;
        }
        let away = x - (low + high) / 2.0;
        (away - TAU * (away / TAU).round()).abs() - (high - low) / 2.0
    };
    q.iter().zip(&space.limits).map(of).fold(f64::NEG_INFINITY, f64::max)
}

fn error(robot: &Robot<f64>, pose: &Transform<f64>, q: &[f64]) -> f64 {
    let (a, b) = (robot.pose(q).matrix(), pose.matrix());
    a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// The distance of a configuration from a polyline (the worst joint).
fn off(space: &JointSpace, curve: &[Vec<f64>], q: &[f64]) -> f64 {
    let of = |w: &[Vec<f64>]| {
        let (to, chord) = (space.moved(&w[0], q), space.moved(&w[0], &w[1]));
        let square: f64 = chord.iter().map(|x| x * x).sum();
        let along: f64 = to.iter().zip(&chord).map(|(x, y)| x * y).sum();
        let part = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
        to.iter().zip(&chord).map(|(x, c)| (x - part * c).abs()).fold(0.0, f64::max)
    };
    curve.windows(2).map(of).fold(f64::INFINITY, f64::min)
}

/// True if a member of the manifold is the configuration; for curves, if it is near their samples.
fn is_on(s: &RedundantSolver, pose: &Transform<f64>, m: &Manifold, q: &[f64]) -> bool {
    let space = s.space.clone();
    m.components.iter().any(|c| match s.parameter_at(q) {
        Some(x) => s.member(pose, c, x).is_some_and(|member| {
            let tolerance = 1e-7 + 1e-13 / (member.guard * member.guard);
            space.distance(&member.q, q) <= tolerance
        }),
        None => off(&space, &c.curve, q) <= 5e-3,
    })
}

#[test]
fn all_branches_of_the_arm_angle_hold_the_pose() {
    for d in [robot("kuka-iiwa-7"), robot("kuka-lwr4"), skewed()] {
        let s = solver(&d);
        assert_eq!(s.parameter(), "ψ", "{}", d.name);
        let mut random = Random(1);
        for _ in 0..share(500, 25) {
            let q = within(&s.space, &mut random);
            let pose = s.robot.pose(&q);
            let m = s.manifold(&pose);
            assert_eq!(m.doubt, None);
            assert_eq!(m.components.len(), 8, "{}: {q:?}", d.name);
            assert!(is_on(&s, &pose, &m, &q), "{}: {q:?}", d.name);
            assert!(m.is_feasible());
            for c in &m.components {
                assert!(c.is_closed && c.domain == [-PI, PI]);
                assert!(error(&s.robot, &pose, &c.representative.q) <= 1e-12);
                for k in 0..12 {
                    let x = s.member(&pose, c, -PI + TAU * k as f64 / 12.0).expect("a member all round");
                    assert!(error(&s.robot, &pose, &x.q) <= 1e-12, "{}: {:?}", d.name, x.q);
                }
                check_curve(&s, &pose, c);
            }
        }
    }
}

/// Members have the pose and are next to each other.
fn check_curve(s: &RedundantSolver, pose: &Transform<f64>, c: &Component) {
    for w in c.curve.windows(2) {
        assert!(error(&s.robot, pose, &w[0]) <= 1e-9);
        let step = w[0].iter().zip(&w[1]).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(step <= 0.3, "{}: {step} at {:?}", c.branch, w[0]);
    }
}

#[test]
fn oblique_twists_leave_arcs() {
    let s = solver(&oblique());
    assert_eq!(s.parameter(), "ψ");
    let mut random = Random(2);
    let mut arcs = 0;
    for _ in 0..share(500, 25) {
        let q = within(&s.space, &mut random);
        let pose = s.robot.pose(&q);
        let m = s.manifold(&pose);
        assert!(is_on(&s, &pose, &m, &q), "{q:?}");
        for c in &m.components {
            assert!(error(&s.robot, &pose, &c.representative.q) <= 1e-12);
            arcs += usize::from(!c.is_closed);
            if !c.is_closed {
                let outside = c.domain[1] + 1e-3 * (TAU - (c.domain[1] - c.domain[0]));
                assert!(s.member(&pose, c, outside).is_none(), "{} ends at {:?}", c.branch, c.domain);
            }
        }
        check_feasible(&s, &pose, &m, 1e-9);
    }
    assert!(arcs > 0);
}

/// Feasible intervals hold all samples that the limits allow and no other; at their ends a joint is at a limit, or the
/// branch ends.
fn check_feasible(s: &RedundantSolver, pose: &Transform<f64>, m: &Manifold, exact: f64) {
    for c in &m.components {
        let [low, high] = c.domain;
        let inside = |x: f64, margin: f64| {
            let holds = |i: &[f64; 2], x: f64| x >= i[0] - margin && x <= i[1] + margin;
            c.feasible.iter().any(|i| holds(i, x) || holds(i, x + TAU) || holds(i, x - TAU))
        };
        for k in 0..=200 {
            let x = low + (high - low) * f64::from(k) / 200.0;
            let Some(member) = s.member(pose, c, x) else { continue };
            let excess = beyond(&s.space, &member.q);
            if excess > 1e-7 {
                assert!(!inside(x, -1e-9), "{}: {excess} beyond at {x} in {:?}", c.branch, c.feasible);
            }
            if excess < -1e-7 {
                assert!(inside(x, 1e-9), "{}: {excess} at {x} not in {:?}", c.branch, c.feasible);
            }
        }
        if c.is_closed && c.feasible == [c.domain] {
            continue;
        }
        for x in c.feasible.iter().flatten() {
            let is_end = (x - low).abs() < 1e-9 || (x - high).abs() < 1e-9;
            let Some(member) = s.member(pose, c, *x) else {
                assert!(is_end);
                continue;
            };
            let excess = beyond(&s.space, &member.q).abs();
            // Where joints move fast the parameter's last digits count.
            assert!(is_end || excess <= exact / member.guard.min(1.0), "{}: {excess} at {x}", c.branch);
        }
    }
}

#[test]
fn feasible_intervals_are_exact() {
    let cases = [
        (robot("kuka-iiwa-7"), 40),
        (robot("kuka-iiwa-14"), 10),
        (skewed(), 40),
        (robot("franka-panda"), 6),
        (robot("kinova-gen3"), 3),
        (robot("ufactory-xarm7"), 3),
    ];
    for (d, count) in cases {
        let s = solver(&d);
        let mut random = Random(3);
        for _ in 0..share(20 * count, count) {
            let q = within(&s.space, &mut random);
            let pose = s.robot.pose(&q);
            let m = s.manifold(&pose);
            assert!(is_on(&s, &pose, &m, &q), "{}: {q:?}", d.name);
            assert!(m.is_feasible(), "{}: {q:?}", d.name);
            check_feasible(&s, &pose, &m, 1e-9);
        }
    }
}

#[test]
fn reachable_targets_are_all_solved_within_the_limits() {
    let skew = skewed();
    let skew_oblique = oblique();
    let named = ["kuka-iiwa-7", "kuka-iiwa-14", "kuka-lwr4", "franka-panda", "kinova-gen3", "ufactory-xarm7"]
        .map(robot);
    for d in named.into_iter().chain([skew, skew_oblique]) {
        let s = solver(&d);
        let mut random = Random(4);
        for _ in 0..share(10_000, 2_000) {
            let q = within(&s.space, &mut random);
            let pose = s.robot.pose(&q);
            let x = s.within_limits(&pose, None).unwrap_or_else(|| panic!("{}: nothing at {q:?}", d.name));
            assert!(x.within_limits && beyond(&s.space, &x.q) <= 2e-9, "{}: {:?}", d.name, x.q);
            assert!(error(&s.robot, &pose, &x.q) <= 1e-11, "{}: {:?}", d.name, x.q);
        }
    }
}

#[test]
fn the_parameter_of_the_seed_is_tried_first() {
    for d in [robot("kuka-iiwa-7"), skewed(), robot("franka-panda")] {
        let s = solver(&d);
        let mut random = Random(5);
        let mut same = 0;
        for _ in 0..100 {
            let q = within(&s.space, &mut random);
            let pose = s.robot.pose(&q);
            let x = s.within_limits(&pose, Some(&q)).expect("reachable");
            same += usize::from(s.space.distance(&x.q, &q) <= 1e-6);
        }
        assert_eq!(same, 100, "{}", d.name);
    }
}

#[test]
fn poses_out_of_reach_have_no_manifold() {
    for name in ["kuka-iiwa-7", "franka-panda"] {
        let s = solver(&robot(name));
        let near = s.robot.pose(&[0.3, 0.4, 0.5, -1.0, 0.6, 0.7, 0.8]);
        let shift = near.translation + Vector([30.0, 0.0, 0.0]);
        let pose = Transform::from_rotation_translation(near.rotation, shift);
        assert!(s.manifold(&pose).is_empty());
        assert_eq!(s.within_limits(&pose, None), None);
        assert_eq!(s.best(&pose, &Criterion::FarthestFromLimits), None);
    }
}

/// What a criterion makes larger; the guard of a member is its smallest singular value.
fn quality(s: &RedundantSolver, criterion: &Criterion, q: &[f64], guard: f64) -> f64 {
    match criterion {
        Criterion::Nearest(to) => {
            let copy = s.space.nearest_copy(q, to);
            -copy.iter().zip(to).map(|(x, y)| (x - y).powi(2)).sum::<f64>()
        }
        Criterion::FarthestFromLimits => {
            let of = |j: usize| {
                let [low, high] = s.space.limits[j].unwrap_or([-1e3, 1e3]);
                let middle = (low + high) / 2.0;
                let copy = q[j] - TAU * ((q[j] - middle) / TAU).round();
                1.0 - (copy - middle).abs() / ((high - low) / 2.0)
            };
            (0..q.len()).map(of).fold(f64::INFINITY, f64::min)
        }
        Criterion::FarthestFromSingularity => guard,
    }
}

#[test]
fn the_best_is_no_worse_than_any_sample() {
    for d in [robot("kuka-iiwa-7"), skewed(), robot("franka-panda")] {
        let s = solver(&d);
        let mut random = Random(6);
        for _ in 0..share(50, 3) {
            let q = within(&s.space, &mut random);
            let pose = s.robot.pose(&q);
            let m = s.manifold(&pose);
            for criterion in [
                Criterion::Nearest(within(&s.space, &mut random)),
                Criterion::FarthestFromLimits,
                Criterion::FarthestFromSingularity,
            ] {
                let best = s.best(&pose, &criterion).expect("reachable");
                assert!(best.within_limits && error(&s.robot, &pose, &best.q) <= 1e-11);
                let reached = quality(&s, &criterion, &best.q, best.guard);
                for c in &m.components {
                    for [low, high] in &c.feasible {
                        for k in 0..=300 {
                            let x = low + (high - low) * f64::from(k) / 300.0;
                            let Some(member) = s.member(&pose, c, x) else { continue };
                            let value = quality(&s, &criterion, &member.q, member.guard);
                            assert!(value <= reached + 1e-6, "{} {criterion:?}: {value} > {reached}", d.name);
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn curves_close_and_agree_with_closed_forms() {
    for d in [robot("franka-panda"), robot("kuka-iiwa-7"), skewed()] {
        let s = solver(&d);
        let mut random = Random(7);
        let mut closed = 0;
        for _ in 0..share(100, 6) {
            let q = within(&s.space, &mut random);
            let pose = s.robot.pose(&q);
            let m = s.manifold(&pose);
            let followed: SelfMotion = self_motion::follow(&s.robot, &s.space, Goal::Pose, &pose, &q);
            closed += usize::from(followed.is_closed());
            assert!(!followed.is_affine);
            for w in followed.curve.windows(2) {
                assert!(error(&s.robot, &pose, &w[0]) <= 1e-11);
                assert!(w[0].iter().zip(&w[1]).all(|(x, y)| (x - y).abs() <= 0.11));
            }
            for x in followed.curve.iter().step_by(7) {
                assert!(is_on(&s, &pose, &m, x), "{}: {x:?} of the curve through {q:?}", d.name);
            }
            if followed.is_closed() {
                let (first, last) = (&followed.curve[0], &followed.curve[followed.curve.len() - 1]);
                assert!(s.space.distance(first, last) <= 1e-9);
            }
        }
        assert!(closed >= 5, "{}: {closed}", d.name);
    }
}

fn space_of(d: &Description) -> (Robot<f64>, JointSpace) {
    let robot = Robot::numeric(d).expect("all parameters have values");
    let space = JointSpace::new(d, &robot);
    (robot, space)
}

#[test]
fn the_wrist_of_a_ur5_moves_by_itself_and_a_stretched_elbow_does_not() {
    let (robot, space) = space_of(&robot("ur5"));
    // Axes 2, 3, 4 and 6 are parallel at q5 = 0: four joints move the hand in a plane and turn it, one too many.
    let parallel = [0.3, -1.1, 1.4, 0.5, 0.0, 0.7];
    let direction =
        self_motion::is_self_motion(&robot, &space, Goal::Pose, &parallel).expect("a self-motion");
    assert!(direction[0].abs() < 1e-9 && direction[4].abs() < 1e-9);
    let curve = self_motion::follow(&robot, &space, Goal::Pose, &robot.pose(&parallel), &parallel);
    assert!(curve.curve.len() > 10);
    for q in &curve.curve {
        assert!(error(&robot, &robot.pose(&parallel), q) <= 1e-11 && q[4].abs() < 1e-9);
    }
    // With the elbow stretched two solutions coincide; the arm cannot move.
    let stretched = [0.3, -1.1, 0.0, 0.5, 0.9, 0.7];
    assert_eq!(self_motion::is_self_motion(&robot, &space, Goal::Pose, &stretched), None);
    let generic = [0.3, -1.1, 1.4, 0.5, 0.9, 0.7];
    assert_eq!(self_motion::is_self_motion(&robot, &space, Goal::Pose, &generic), None);
}

#[test]
fn a_straight_wrist_is_an_affine_family() {
    let (robot, space) = space_of(&robot("puma560"));
    let q = [0.3, -0.4, 0.9, 0.5, 0.0, 0.7];
    let pose = robot.pose(&q);
    let direction = self_motion::is_self_motion(&robot, &space, Goal::Pose, &q).expect("a self-motion");
    for (x, wanted) in direction.iter().zip([0.0, 0.0, 0.0, 0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt()]) {
        assert!((x.abs() - wanted).abs() < 1e-9, "{direction:?}");
    }
    let curve = self_motion::follow(&robot, &space, Goal::Pose, &pose, &q);
    assert!(curve.is_affine && curve.ends == [CurveEnd::Closed; 2], "{:?}", curve.ends);
}

#[test]
fn arms_without_surplus_are_refused() {
    let refused = |name: &str| RedundantSolver::new(&robot(name), Goal::Pose).err();
    assert_eq!(refused("ur5"), Some(NotSolved::NotRedundant));
    assert_eq!(refused("scara"), Some(NotSolved::NotRedundant));
}

#[test]
fn slides_and_two_surplus_joints_are_served() {
    for name in ["rail-puma", "smart5-six-rail", "anthropomorphic-8r"] {
        let d = robot(name);
        let Ok(s) = RedundantSolver::new(&d, Goal::Pose) else { panic!("{name} is refused") };
        let mut random = Random(8);
        for _ in 0..5 {
            let q: Vec<f64> =
                s.space.is_angle.iter().map(|&a| (random.unit() - 0.5) * if a { TAU } else { 0.4 }).collect();
            let pose = s.robot.pose(&q);
            let x = s.within_limits(&pose, None).unwrap_or_else(|| panic!("{name}: {q:?}"));
            assert!(error(&s.robot, &pose, &x.q) <= 1e-10);
        }
    }
}

#[test]
fn arms_without_closed_form_are_served_by_curves() {
    for name in ["rethink-baxter-left", "rethink-sawyer"] {
        let d = robot(name);
        let s = solver(&d);
        assert_eq!(s.parameter(), "s");
        let mut random = Random(9);
        for _ in 0..share(50, 2) {
            let q = within(&s.space, &mut random);
            let pose = s.robot.pose(&q);
            let x = s.within_limits(&pose, None).unwrap_or_else(|| panic!("{name}: {q:?}"));
            assert!(error(&s.robot, &pose, &x.q) <= 1e-10);
            let m = s.manifold(&pose);
            assert!(is_on(&s, &pose, &m, &q), "{name}: {q:?} is on none of {} curves", m.components.len());
            for c in &m.components {
                check_curve(&s, &pose, c);
            }
        }
    }
}
