//! Paths of the hand, and the joints that follow them: what is met, and how near the hand stays.

use crate::common::{Random, case, robot};
use denavit::geometry::{Transform, Vector};
use denavit::inverse::{InverseKinematics, InverseOptions};
use denavit::motion::follow::{Event, EventKind, FollowOptions, Followed, Follower};
use denavit::motion::hand::{Arc, ArcError, HandChain, HandPath, Line, Orientation, PoseSpline};
use denavit::motion::path::JointPath;
use denavit::motion::{Limits, TimeOptimal, Trajectory};
use denavit::velocity::{Place, Viewpoint, Whole, geometric};
use std::f64::consts::PI;

/// A line from the pose of a configuration by a displacement.
fn by(follower: &Follower, q: &[f64], d: [f64; 3]) -> Line {
    let from = follower.inverse.robot.pose(q);
    let to = Transform::from_rotation_translation(from.rotation, from.translation + Vector(d));
    Line { from, to, orientation: Orientation::Slerp }
}

fn follower(name: &str) -> Follower {
    Follower::new(&robot(name)).unwrap_or_else(|e| panic!("{name}: {e:?}"))
}

/// The hand is on its path between the samples too, as near as is said.
fn stays(follower: &Follower, path: &dyn HandPath, followed: &Followed) {
    let end = followed.joints.end();
    for k in 0..=1000 {
        let s = end * f64::from(k) / 1000.0;
        let away =
            follower.inverse.robot.pose(&followed.joints.eval(s).q).translation - path.pose(s).translation;
        assert!(away.norm() <= 1.2 * followed.deviation + 1e-9, "{s}: {}", away.norm());
    }
}

fn singular(events: &[Event]) -> Vec<&Event> {
    events.iter().filter(|e| matches!(e.kind, EventKind::Singular { .. })).collect()
}

/// In the plane of the arm the wrist of an RX-90 passes through its singular configuration, and the hand over axis 1.
#[test]
fn a_line_through_the_wrist_singularity() {
    let mut f = follower("staubli-rx90");
    let q = [0.0, -40.0, 100.0, 0.0, 30.0, 0.0].map(f64::to_radians);
    let path = by(&f, &q, [0.1, 0.0, -0.1]);
    let followed = f.follow(&path, &q, &FollowOptions::default());
    assert!(followed.reached >= 1.0);
    assert!(followed.certified);
    assert!(followed.deviation <= FollowOptions::default().max_deviation);
    stays(&f, &path, &followed);
    let met = singular(&followed.events);
    assert_eq!(met.len(), 2);
    let [wrist, shoulder] = met[..] else { panic!("two") };
    assert!(wrist.q[4].abs() < 1e-9);
    assert!(matches!(
        wrist.kind,
        EventKind::Singular { place: Some(Place::OneLine(3, 5)), crossed: true, .. }
    ));
    assert!(matches!(
        shoulder.kind,
        EventKind::Singular { place: Some(Place::CentreOnAxis { axis: 0, .. }), .. }
    ));
    // Joint 5 goes on through 0 instead of turning back.
    assert!(followed.joints.eval(1.0).q[4] < -0.1);
}

/// Beside the plane the line passes the singularity at a distance: joints 4 and 6 turn fast, nothing is crossed.
#[test]
fn a_line_beside_the_wrist_singularity() {
    let mut f = follower("staubli-rx90");
    let q = [0.0, -40.0, 100.0, 0.001, 30.0, 0.0].map(f64::to_radians);
    let path = by(&f, &q, [0.1, 0.003, -0.05]);
    let followed = f.follow(&path, &q, &FollowOptions::default());
    assert!(followed.reached >= 1.0);
    stays(&f, &path, &followed);
    let s5 = |e: &&&Event| matches!(e.kind, EventKind::Singular { place: Some(Place::OneLine(3, 5)), .. });
    assert_eq!(singular(&followed.events).iter().filter(s5).count(), 0);
    let turned = (followed.joints.eval(1.0).q[3] - q[3]).abs();
    assert!((turned - PI).abs() < 0.5, "{turned}");
}

/// The arm is stretched where the line leaves the workspace: D3 and RL4 lie on one line.
#[test]
fn a_line_out_of_the_workspace() {
    let mut f = follower("staubli-rx90");
    let q = [0.2, -40.0_f64.to_radians(), 2.0, 0.4, 0.9, 0.0];
    let path = by(&f, &q, [1.5, 0.2, 0.3]);
    let followed = f.follow(&path, &q, &FollowOptions::default());
    let Some(Event { s, kind: EventKind::End { reachable, place, factor }, .. }) = followed.events.last()
    else {
        panic!("it ends: {:?}", followed.events)
    };
    assert!(!reachable && factor.is_some() && *s == followed.reached);
    assert!(matches!(place, Some(Place::CentreInPlane { parallel: true, .. })), "{place:?}");
    // The wrist's centre is the origin of frame 6, and axis 1 meets axis 2 in the origin.
    let away = path.pose(*s).translation.norm();
    assert!((away - 0.9).abs() < 1e-6, "{away}");
    let inverse =
        InverseKinematics::new(&robot("staubli-rx90"), &InverseOptions::default()).expect("solvable");
    assert!(!inverse.solve(&path.pose(s + 1e-5), &[]).is_reachable());
    assert!(inverse.solve(&path.pose(s - 1e-5), &[]).is_reachable());
}

#[test]
fn a_limit_on_the_way_and_another_branch() {
    let mut f = follower("kuka-kr6-r900");
    let limits = f.inverse.space.limits.clone();
    let Some([low, high]) = limits[4] else { panic!("joint 5 has limits") };
    let q = [0.0, -1.4, 1.6, 0.3, high - 0.1, 0.2];
    let mut met = 0;
    for d in [[0.3, 0.0, 0.0], [-0.3, 0.0, 0.0], [0.0, 0.0, 0.3], [0.0, 0.0, -0.3]] {
        let path = by(&f, &q, d);
        let followed = f.follow(&path, &q, &FollowOptions::default());
        stays(&f, &path, &followed);
        for event in &followed.events {
            if let EventKind::Limit { joint, limit } = event.kind {
                met += 1;
                assert!((event.q[joint] - limit).abs() < 1e-6);
                assert!(!followed.is_clean());
            }
        }
        // What no event says stays within the limits.
        if followed.is_clean() {
            let inside = |q: &[f64]| {
                q.iter().zip(&limits).all(|(x, l)| l.is_none_or(|[a, b]| *x > a - 1e-8 && *x < b + 1e-8))
            };
            assert!((0..=500).all(|k| inside(&followed.joints.eval(f64::from(k) / 500.0).q)));
        }
        let all = f.alternatives(&path, None, &FollowOptions::default());
        assert!(all.iter().any(|a| f.inverse.space.is_same(&a.start, &q)), "the start is among them");
    }
    assert!(met > 0, "limits {low} {high}");
}

/// A joint to spare follows too, and keeps away from the limits.
#[test]
fn a_line_of_a_redundant_arm() {
    let mut f = follower("kuka-iiwa-14");
    let q = [0.0, 40.0, 0.0, -80.0, 0.0, 60.0, 0.0].map(f64::to_radians);
    let path = by(&f, &q, [0.0, 0.5, 0.0]);
    let followed = f.follow(&path, &q, &FollowOptions::default());
    assert!(followed.is_clean());
    stays(&f, &path, &followed);
}

/// A corner is met exactly, and the timing stops there.
#[test]
fn two_lines_with_a_corner() {
    let mut f = follower("ur5");
    let q = [0.0, -60.0, 90.0, -60.0, -90.0, 0.0].map(f64::to_radians);
    let first = by(&f, &q, [0.1, 0.0, 0.0]);
    let second = Line {
        from: first.to,
        to: Transform::from_rotation_translation(
            first.to.rotation,
            first.to.translation + Vector([0.0, 0.2, 0.0]),
        ),
        orientation: Orientation::Slerp,
    };
    let path = HandChain::new(vec![Box::new(first), Box::new(second)]);
    let [corner] = path.corners()[..] else { panic!("one corner") };
    assert!((corner - 1.0 / 3.0).abs() < 1e-9);
    let followed = f.follow(&path, &q, &FollowOptions::default());
    assert!(followed.reached >= 1.0 && followed.joints.parameters().contains(&corner));
    stays(&f, &path, &followed);
    let limits = Limits::symmetric(&[2.0; 6], &[8.0; 6]).expect("positive");
    let timed = TimeOptimal::default().time(followed.joints.clone(), &limits).expect("it can be timed");
    let at_corner = timed.resample(1e-3).expect("samples").into_iter().min_by(|a, b| {
        let away = |q: &[f64]| (f.inverse.robot.pose(q).translation - first.to.translation).norm();
        away(&a.1.q).total_cmp(&away(&b.1.q))
    });
    let (_, state) = at_corner.expect("a sample");
    assert!(state.qd.iter().all(|v| v.abs() < 0.05), "{:?}", state.qd);
}

#[test]
fn arcs_are_arcs() {
    let mut random = Random(3);
    for _ in 0..200 {
        let mut pose = || {
            let mut x = || 2.0 * random.unit() - 1.0;
            Transform::translation(x(), x(), x())
                * Transform::rotation_z(3.0 * x())
                * Transform::rotation_x(3.0 * x())
        };
        let (from, via, to) = (pose(), pose().translation, pose());
        let arc = Arc::new(from, via, to).expect("three points in general place");
        let points: Vec<_> = (0..=2000).map(|k| arc.pose(f64::from(k) / 2000.0).translation).collect();
        let nearest = points.iter().map(|p| (*p - via).norm()).fold(f64::INFINITY, f64::min);
        assert!(nearest < arc.length() / 2000.0, "through the point");
        for (have, wanted) in [(arc.pose(0.0), from), (arc.pose(1.0), to)] {
            let off = have
                .matrix()
                .concat()
                .iter()
                .zip(wanted.matrix().concat())
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max);
            assert!(off < 1e-9, "{off}");
        }
        let chords: f64 = points.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
        assert!((chords / arc.length() - 1.0).abs() < 1e-5);
    }
    let at = |x: f64| Transform::translation(x, 0.0, 0.0);
    assert_eq!(Arc::new(at(0.0), at(0.5).translation, at(1.0)), Err(ArcError::Straight));
    assert_eq!(Arc::new(at(0.0), at(0.0).translation, at(1.0)), Err(ArcError::SamePoint));
}

/// A screw has one twist along the tool's own axes; a line with SLERP goes straight.
#[test]
fn screws_and_lines() {
    let from = Transform::translation(0.3, -0.1, 0.5) * Transform::rotation_x(0.4);
    let to = Transform::translation(-0.2, 0.4, 0.6) * Transform::rotation_z(2.0) * Transform::rotation_y(0.7);
    let screw = Line { from, to, orientation: Orientation::Screw };
    let step = |s: f64| (screw.pose(s).inverse() * screw.pose(s + 0.1)).matrix().concat();
    for k in 0..9 {
        let same = step(0.0).iter().zip(step(f64::from(k) / 10.0)).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(same, "{k}");
    }
    assert!(
        screw.pose(1.0).matrix().concat().iter().zip(to.matrix().concat()).all(|(a, b)| (a - b).abs() < 1e-9)
    );
    let line = Line { from, to, orientation: Orientation::Slerp };
    let middle = line.pose(0.5).translation;
    assert!((middle - (from.translation + to.translation).scale(0.5)).norm() < 1e-12);
}

#[test]
fn splines_are_smooth() {
    let mut random = Random(5);
    for _ in 0..20 {
        let mut pose = || {
            let mut x = || 2.0 * random.unit() - 1.0;
            Transform::translation(x(), x(), x()) * Transform::rotation_z(x()) * Transform::rotation_x(x())
        };
        let poses: Vec<_> = (0..6).map(|_| pose()).collect();
        let spline = PoseSpline::new(poses.clone()).expect("different poses");
        for pose in &poses {
            let away = |k: i32| (spline.pose(f64::from(k) / 1e4).translation - pose.translation).norm();
            let nearest = (0..=10_000).map(away).fold(f64::INFINITY, f64::min);
            assert!(nearest < 2e-3, "{nearest}");
        }
        // The twist does not jump: differences shrink with the step.
        let twists: Vec<[f64; 6]> = (1..5000).map(|k| spline.twist(f64::from(k) / 5000.0)).collect();
        let largest = twists.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        for w in twists.windows(2) {
            let jump = w[0].iter().zip(&w[1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(jump < 0.02 * largest, "{jump} of {largest}");
        }
    }
    let here = Transform::identity();
    assert!(PoseSpline::new(vec![here]).is_none() && PoseSpline::new(vec![here, here]).is_none());
}

/// Of arms whose determinant is not to be had as a formula, the nearest singular configuration is named in numbers: nothing
/// on the way has a smaller singular value, and what is called certain has none that is 0.
#[test]
fn calibrated_arms_are_followed_with_their_clearance() {
    let mut random = Random(3);
    let mut certain = 0;
    for name in ["ur5cal", "g1off"] {
        let mut f = Follower::new(&case(name)).expect("numbers");
        for _ in 0..6 {
            let q: Vec<f64> = (0..6).map(|_| 2.0 * PI * random.unit() - PI).collect();
            let path = by(&f, &q, [0.05, 0.02, -0.03]);
            let followed = f.follow(&path, &q, &FollowOptions::default());
            let clearance = followed.clearance.as_ref().expect("no factors are known");
            let space = &f.inverse.space;
            let smallest = |q: &[f64]| {
                let jacobian = geometric(&f.inverse.robot, q, &Viewpoint::tool());
                let whole = Whole::new(&jacobian, &space.is_angle, space.length());
                whole.singular_values.last().copied().expect("six")
            };
            let least = (0..=3000)
                .map(|k| smallest(&followed.joints.eval(followed.joints.end() * f64::from(k) / 3000.0).q))
                .fold(f64::INFINITY, f64::min);
            assert!(clearance.smallest <= least + 1e-6, "{name}: {} and {least}", clearance.smallest);
            assert_eq!(followed.certified, clearance.is_certain);
            assert!(!clearance.is_certain || least > 1e-9, "{name}: {least}");
            certain += usize::from(clearance.is_certain);
        }
    }
    assert!(certain >= 6, "{certain} of 12");
}
