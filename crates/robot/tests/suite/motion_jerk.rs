//! Timings of paths under jerk limits: the limits hold at all times, the ends are at rest, and where the fastest motion
//! is known the duration is near it.

use crate::common::{Random, share};
use denavit::motion::jerk_limited::SmoothTimedPath;
use denavit::motion::path::{
    Blend, Ends, PathPoint, PiecewisePath, QuinticEnds, Side, blended, cubic_spline, quintic_spline,
};
use denavit::motion::profile::{Profile, double_s};
use denavit::motion::{JerkLimited, JointPath, Limits, MotionError, TimeOptimal, Trajectory};

#[track_caller]
fn near(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b}");
}

fn way_points(random: &mut Random, n: usize, dof: usize) -> Vec<Vec<f64>> {
    (0..n).map(|_| (0..dof).map(|_| 4.0 * random.unit() - 2.0).collect()).collect()
}

fn shares(timed: &SmoothTimedPath<&PiecewisePath>, limits: &Limits) -> [f64; 3] {
    let mut most = [0.0f64; 3];
    for k in 0..=10_000 {
        let t = timed.duration() * f64::from(k) / 10_000.0;
        let (state, jerk) = (timed.eval(t), timed.jerk(t));
        for (j, jerk) in jerk.iter().enumerate() {
            most[0] = most[0].max(limits.velocity()[j].share(state.qd[j]));
            most[1] = most[1].max(limits.acceleration()[j].share(state.qdd[j]));
            most[2] = most[2].max(jerk.abs() / limits.jerk().unwrap()[j]);
        }
    }
    most
}

#[test]
fn one_joint_on_a_line_is_nearly_double_s() {
    // The fastest motion is known (Biagiotti & Melchiorri 2008, §3.4): jerk alone, with acceleration, with velocity.
    let limits = Limits::symmetric(&[1.0], &[2.0]).unwrap().with_jerk(&[10.0]).unwrap();
    for d in [0.05, 0.5, 3.0] {
        let path = cubic_spline(&[vec![0.0], vec![d]], &Ends::Natural).unwrap();
        let timed = JerkLimited::default().time(&path, &limits).unwrap();
        let best = double_s([0.0, d], [0.0; 2], 1.0, 2.0, 10.0).unwrap().duration();
        assert!((1.0..1.003).contains(&(timed.duration() / best)), "{} {best}", timed.duration());
        assert!(shares(&timed, &limits).iter().all(|r| *r <= 1.0 + 1e-6));
    }
}

#[test]
fn limits_hold_at_all_times() {
    let mut random = Random(21);
    for round in 0..share(60, 8) {
        let (dof, n) = (1 + round % 7, 3 + round % 9);
        let w = way_points(&mut random, n, dof);
        let mut list = |low: f64, high: f64| -> Vec<f64> {
            (0..dof).map(|_| low + (high - low) * random.unit()).collect()
        };
        let limits = Limits::symmetric(&list(0.5, 3.0), &list(2.0, 20.0)).unwrap();
        let limits = limits.with_jerk(&list(20.0, 1000.0)).unwrap();
        for path in [
            cubic_spline(&w, &Ends::Natural).unwrap(),
            quintic_spline(&w, &QuinticEnds::Natural).unwrap(),
            blended(&w, &vec![0.1; n - 2], Blend::Quintic).unwrap(),
        ] {
            let timed = JerkLimited::default().time(&path, &limits).unwrap();
            let most = shares(&timed, &limits);
            assert!(most.iter().all(|r| *r <= 1.0 + 1e-4), "round {round}: {most:?}");
            assert!((1.0..1.01).contains(&timed.slowed()), "{}", timed.slowed());
            // Slower than without jerk limits (but for the grids), and not by much.
            let bound = TimeOptimal::default().time(&path, &limits).unwrap().duration();
            let ratio = timed.duration() / bound;
            assert!((0.99..1.6).contains(&ratio), "round {round}: {ratio}");
            for (t, q) in [(0.0, &w[0]), (timed.duration(), &w[n - 1])] {
                let state = timed.eval(t);
                for (j, q) in q.iter().enumerate() {
                    near(state.q[j], *q, 1e-9);
                    near(state.qd[j], 0.0, 1e-9);
                    near(state.qdd[j], 0.0, 1e-6);
                }
            }
        }
    }
}

#[test]
fn derivatives_are_slopes_and_accelerations_continuous() {
    let w = way_points(&mut Random(22), 6, 3);
    let limits = Limits::symmetric(&[1.0; 3], &[3.0; 3]).unwrap().with_jerk(&[40.0; 3]).unwrap();
    let path = cubic_spline(&w, &Ends::Natural).unwrap();
    let timed = JerkLimited::default().time(&path, &limits).unwrap();
    for pair in timed.resample(1e-3).unwrap().windows(2) {
        let ((t0, a), (t1, b)) = (&pair[0], &pair[1]);
        let dt = t1 - t0;
        for j in 0..3 {
            assert!((b.qdd[j] - a.qdd[j]).abs() <= 40.0 * dt * (1.0 + 1e-4) + 1e-9);
            near(b.qd[j] - a.qd[j], (a.qdd[j] + b.qdd[j]) / 2.0 * dt, 40.0 * dt * dt / 4.0 + 1e-10);
            near(b.q[j] - a.q[j], (a.qd[j] + b.qd[j]) / 2.0 * dt, 3.0 * dt * dt / 4.0 + 1e-10);
        }
    }
}

#[test]
fn great_jerks_are_no_limit() {
    let w = way_points(&mut Random(23), 5, 4);
    let limits = Limits::symmetric(&[1.0; 4], &[5.0; 4]).unwrap().with_jerk(&[1e5; 4]).unwrap();
    let path = cubic_spline(&w, &Ends::Natural).unwrap();
    let fastest = TimeOptimal::default().time(&path, &limits).unwrap().duration();
    let timed = JerkLimited { intervals: 600, gap: 1e-3 }.time(&path, &limits).unwrap();
    near(timed.duration(), fastest, 0.01 * fastest);
}

#[test]
fn the_way_back_takes_as_long() {
    let mut w = way_points(&mut Random(24), 7, 3);
    let limits = Limits::symmetric(&[1.0; 3], &[5.0; 3]).unwrap().with_jerk(&[60.0; 3]).unwrap();
    let mut time = |_: usize| {
        w.reverse();
        let path = cubic_spline(&w, &Ends::Natural).unwrap();
        JerkLimited::default().time(&path, &limits).unwrap().duration()
    };
    let [back, there] = [0, 1].map(&mut time);
    near(back, there, 2e-3 * there);
}

/// A line whose third derivative nobody knows.
#[derive(Debug)]
struct Unknown;

impl JointPath for Unknown {
    fn dof(&self) -> usize {
        1
    }

    fn end(&self) -> f64 {
        1.0
    }

    fn eval_into(&self, s: f64, _: Side, point: &mut PathPoint) {
        (point.q[0], point.dq[0]) = (s, 1.0);
    }

    fn has_third_derivative(&self) -> bool {
        false
    }
}

#[test]
fn what_is_refused() {
    let plain = Limits::symmetric(&[1.0], &[1.0]).unwrap();
    let limits = plain.clone().with_jerk(&[1.0]).unwrap();
    let path = cubic_spline(&[vec![0.0], vec![1.0]], &Ends::Natural).unwrap();
    let timing = JerkLimited::default();
    assert_eq!(timing.time(&path, &plain).unwrap_err(), MotionError::NoJerkLimits);
    assert_eq!(timing.time(Unknown, &limits).unwrap_err(), MotionError::NoThirdDerivative);
    // Without jerk limits it does not matter.
    near(TimeOptimal::default().time(Unknown, &limits).unwrap().duration(), 2.0, 1e-3);
    let turn = [vec![0.0], vec![1.0], vec![0.0]];
    for (deviation, blend) in [(0.1, Blend::Parabolic), (0.0, Blend::Quintic)] {
        let path = blended(&turn, &[deviation], blend).unwrap();
        assert!(matches!(timing.time(&path, &limits), Err(MotionError::Kink { s }) if (s - 1.0).abs() < 0.5));
    }
    let both = Limits::symmetric(&[1.0; 2], &[1.0; 2]).unwrap().with_jerk(&[1.0; 2]).unwrap();
    assert!(matches!(timing.time(&path, &both), Err(MotionError::Joints { .. })));
    let endless = JerkLimited { intervals: usize::MAX, ..timing.clone() };
    assert!(matches!(endless.time(&path, &limits), Err(MotionError::TooMany(..))));
    assert!(JerkLimited { gap: f64::NAN, ..timing }.time(&path, &limits).is_err());
}
