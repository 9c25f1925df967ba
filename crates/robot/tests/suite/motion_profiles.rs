//! Time laws: they meet their ends, keep their limits, are continuous, and are as fast as analysis says.

use crate::common::{Random, numbers, share};
use denavit::motion::profile::{
    Law, Phases, Polynomial, Profile, Sample, TimeLaw, double_s, synchronised, trapezoidal,
};
use denavit::motion::{JointState, Limits, MotionError, Range, Trajectory, move_within_limits};

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.unit()
}

#[track_caller]
fn near(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b}");
}

/// Samples of the whole profile, ends included, and just before and behind every multiple of 1/8 of it.
fn samples(profile: &impl Profile) -> impl Iterator<Item = Sample> + '_ {
    (0..=2000).map(|k| profile.at(profile.duration() * f64::from(k) / 2000.0))
}

fn greatest(profile: &impl Profile, of: impl Fn(Sample) -> f64) -> f64 {
    samples(profile).map(|s| of(s).abs()).fold(0.0, f64::max)
}

/// Each derivative is the slope of what it is the derivative of, wherever the slope is defined.
fn derivatives_agree(profile: &impl Profile) {
    let (n, h) = (997, 1e-5 * profile.duration());
    let jerk = greatest(profile, |s| s.jerk).max(1.0);
    let acceleration = greatest(profile, |s| s.acceleration).max(1.0);
    for k in 1..n {
        let t = profile.duration() * f64::from(k) / f64::from(n);
        let [a, m, b] = [t - h, t, t + h].map(|t| profile.at(t));
        near((b.position - a.position) / (2.0 * h), m.velocity, 2.0 * h * acceleration);
        // Across a jump of the acceleration the slope of the velocity is between both sides.
        if (b.acceleration - a.acceleration).abs() < 4.0 * h * jerk {
            near((b.velocity - a.velocity) / (2.0 * h), m.acceleration, 4.0 * h * jerk + 1e-8);
        }
    }
}

#[test]
fn cubic_and_quintic_meet_both_ends() {
    let mut random = Random(1);
    for _ in 0..200 {
        let mut x = || between(&mut random, -3.0, 3.0);
        let (p, v, a, t) = ([x(), x()], [x(), x()], [x(), x()], x().abs() + 0.1);
        let cubic = Polynomial::cubic(p, v, t).unwrap();
        let quintic = Polynomial::quintic([p[0], v[0], a[0]], [p[1], v[1], a[1]], t).unwrap();
        for (end, at) in [(0, 0.0), (1, t)] {
            let (c, q) = (cubic.at(at), quintic.at(at));
            for (found, given) in
                [(c.position, p), (c.velocity, v), (q.position, p), (q.velocity, v), (q.acceleration, a)]
            {
                near(found, given[end], 1e-9 * (1.0 + 1.0 / (t * t)));
            }
        }
        derivatives_agree(&quintic);
    }
}

#[test]
fn fastest_polynomials_reach_a_limit_and_exceed_none() {
    let mut random = Random(2);
    for _ in 0..200 {
        let mut x = |low, high| between(&mut random, low, high);
        let (from, to, v, a, j) = (x(-3.0, 3.0), x(-3.0, 3.0), x(0.2, 3.0), x(0.5, 20.0), x(1.0, 200.0));
        let cubic = Polynomial::fastest_cubic(from, to, v, a).unwrap();
        let quintic = Polynomial::fastest_quintic(from, to, v, a, Some(j)).unwrap();
        let shares = [
            greatest(&cubic, |s| s.velocity / v).max(greatest(&cubic, |s| s.acceleration / a)),
            greatest(&quintic, |s| s.velocity / v)
                .max(greatest(&quintic, |s| s.acceleration / a))
                .max(greatest(&quintic, |s| s.jerk / j)),
        ];
        for share in shares {
            assert!((1.0 - 1e-5..=1.0 + 1e-9).contains(&share), "{share}");
        }
    }
}

#[test]
fn trapezoids_are_as_fast_as_bang_bang() {
    // d = 1, a = 4: half the way in √(d/a), 2 √(1/4) = 1 s; with v = 1: d/v + v/a = 1.25 s.
    near(trapezoidal([0.0, 1.0], [0.0; 2], 9.0, 4.0).unwrap().duration(), 1.0, 1e-15);
    near(trapezoidal([3.0, 2.0], [0.0; 2], 1.0, 4.0).unwrap().duration(), 1.25, 1e-15);
    // From 1 m/s to rest in a distance of 0 with a = 1: 1 s to stop 0.5 further, and 2 √0.5 s back.
    near(trapezoidal([0.0, 0.0], [1.0, 0.0], 9.0, 1.0).unwrap().duration(), 1.0 + 2.0f64.sqrt(), 1e-15);
}

#[test]
fn trapezoids_with_end_velocities() {
    let mut random = Random(3);
    for _ in 0..1000 {
        let (v, a) = (between(&mut random, 0.2, 3.0), between(&mut random, 0.5, 20.0));
        let mut x = |bound: f64| between(&mut random, -bound, bound);
        let (p, ends) = ([x(2.0), x(2.0)], [x(v), x(v)]);
        let profile = trapezoidal(p, ends, v, a).unwrap();
        keeps(&profile, p, ends, [v, a, f64::INFINITY]);
        // Backwards in time: the same duration.
        let back = trapezoidal([p[1], p[0]], [-ends[1], -ends[0]], v, a).unwrap();
        near(back.duration(), profile.duration(), 1e-12 * (1.0 + profile.duration()));
    }
}

/// Ends, limits, continuity.
#[track_caller]
fn keeps(profile: &Phases, p: [f64; 2], v: [f64; 2], [max_v, max_a, max_j]: [f64; 3]) {
    let (start, end) = (profile.at(0.0), profile.end());
    near(start.position, p[0], 1e-12);
    near(start.velocity, v[0], 1e-12);
    near(end.position, p[1], 1e-9);
    near(end.velocity, v[1], 1e-9);
    assert!(greatest(profile, |s| s.velocity) <= max_v * (1.0 + 1e-9));
    assert!(greatest(profile, |s| s.acceleration) <= max_a * (1.0 + 1e-9));
    assert!(greatest(profile, |s| s.jerk) <= max_j * (1.0 + 1e-9));
    for phase in &profile.phases()[1..] {
        let before = profile.at(phase.start * (1.0 - 1e-15));
        near(before.position, phase.state.position, 1e-9);
        near(before.velocity, phase.state.velocity, 1e-9);
        if max_j.is_finite() {
            near(before.acceleration, phase.state.acceleration, 1e-7 * max_j.max(1.0));
        }
    }
}

#[test]
fn double_s_is_as_fast_as_analysis_says() {
    // Only jerk matters: d = 2 j (T/4)³, so T = ∛(32 d / j).
    let short = double_s([0.0, 0.01], [0.0; 2], 10.0, 10.0, 5.0).unwrap();
    near(short.duration(), (32.0f64 * 0.01 / 5.0).cbrt(), 1e-12);
    // All limits: d/v + v/a + a/j (Biagiotti & Melchiorri 2008, §3.4.3) = 3 + 1/2 + 2/10.
    near(double_s([0.0, 3.0], [0.0; 2], 1.0, 2.0, 10.0).unwrap().duration(), 3.7, 1e-12);
}

#[test]
fn double_s_keeps_limits_and_is_as_fast_as_ruckig() {
    let mut random = Random(4);
    let mut refused = 0;
    for _ in 0..2000 {
        let mut x = |low, high| between(&mut random, low, high);
        let (v, a, j) = (x(0.2, 3.0), x(0.5, 20.0), x(1.0, 500.0));
        let (p, ends) = ([x(-1.0, 1.0), x(-1.0, 1.0)], [x(0.0, v), x(0.0, v)]);
        let ends = if p[1] < p[0] { ends.map(|v| -v) } else { ends };
        match double_s(p, ends, v, a, j) {
            Ok(profile) => {
                keeps(&profile, p, ends, [v, a, j]);
                let limits = Limits::symmetric(&[v], &[a]).unwrap().with_jerk(&[j]).unwrap();
                let state = |i: usize| JointState { q: vec![p[i]], qd: vec![ends[i]], qdd: vec![0.0] };
                let peer = move_within_limits(&state(0), &state(1), &limits).unwrap();
                near(profile.duration(), peer.duration(), 1e-6 * (1.0 + peer.duration()));
            }
            Err(MotionError::TooShort { needed, found }) => {
                assert!(found < needed);
                refused += 1;
            }
            Err(other) => panic!("{other}"),
        }
    }
    assert!((100..1900).contains(&refused), "{refused}");
}

#[test]
fn joints_arrive_together() {
    let limits = Limits::new(
        vec![Range { lower: -1.0, upper: 2.0 }, Range::symmetric(1.0), Range::symmetric(3.0)],
        vec![Range { lower: -5.0, upper: 4.0 }, Range::symmetric(2.0), Range::symmetric(9.0)],
    )
    .unwrap()
    .with_jerk(&[20.0, 30.0, 50.0])
    .unwrap();
    let (from, to) = ([0.0, 1.0, 0.3], [-1.0, 1.5, 0.3]);
    for law in [Law::Cubic, Law::Quintic, Law::Trapezoidal, Law::DoubleS] {
        let found = synchronised(&from, &to, &limits, law).unwrap();
        let own = |from: f64, to: f64, joint: usize| {
            let l = Limits::new(vec![limits.velocity()[joint]], vec![limits.acceleration()[joint]]).unwrap();
            let l = l.with_jerk(&[limits.jerk().unwrap()[joint]]).unwrap();
            synchronised(&[from], &[to], &l, law).unwrap().duration()
        };
        let slowest = (0..3).map(|j| own(from[j], to[j], j)).fold(0.0, f64::max);
        near(found.duration(), slowest, 1e-12);
        for law in found.laws() {
            near(law.duration(), found.duration(), 1e-12);
        }
        for k in 0..=1000 {
            let t = found.duration() * f64::from(k) / 1000.0;
            let (state, jerk) = (found.eval(t), found.jerk(t));
            for (j, jerk) in jerk.iter().enumerate() {
                assert!(limits.velocity()[j].share(state.qd[j]) <= 1.0 + 1e-9);
                assert!(limits.acceleration()[j].share(state.qdd[j]) <= 1.0 + 1e-9);
                let limited = matches!(law, Law::Quintic | Law::DoubleS);
                assert!(!limited || jerk.abs() <= limits.jerk().unwrap()[j] * (1.0 + 1e-9));
            }
        }
        let end = found.eval(found.duration());
        for (j, to) in to.iter().enumerate() {
            near(end.q[j], *to, 1e-12);
            near(end.qd[j], 0.0, 1e-12);
        }
    }
    let still = synchronised(&from, &from, &limits, Law::DoubleS).unwrap();
    assert_eq!((still.duration(), still.eval(3.0).q), (0.0, from.to_vec()));
}

#[test]
fn what_is_refused() {
    let nan = f64::NAN;
    assert_eq!(Polynomial::cubic([0.0, nan], [0.0; 2], 1.0), Err(MotionError::NotFinite("end states")));
    assert_eq!(Polynomial::cubic([0.0; 2], [0.0; 2], 0.0), Err(MotionError::NotPositive("duration", 0.0)));
    assert!(trapezoidal([0.0, 1.0], [2.0, 0.0], 1.0, 1.0).is_err());
    assert!(trapezoidal([0.0, 1.0], [0.0; 2], f64::INFINITY, 1.0).is_err());
    assert!(matches!(double_s([0.0, 1.0], [-0.1, 0.0], 1.0, 1.0, 1.0), Err(MotionError::State(_))));
    let limits = Limits::symmetric(&[1.0], &[1.0]).unwrap();
    let (a, b) = (JointState::at_rest(&[0.0]), JointState::at_rest(&[1.0]));
    assert_eq!(move_within_limits(&a, &b, &limits), Err(MotionError::NoJerkLimits));
    assert_eq!(synchronised(&[0.0], &[1.0], &limits, Law::DoubleS), Err(MotionError::NoJerkLimits));
    assert!(matches!(synchronised(&[0.0; 2], &[1.0], &limits, Law::Cubic), Err(MotionError::Joints { .. })));
    assert!(Limits::symmetric(&[1.0], &[0.0]).is_err());
    assert!(Limits::symmetric(&[], &[]).is_err());
    assert!(Limits::new(vec![Range { lower: 0.1, upper: 1.0 }], vec![Range::symmetric(1.0)]).is_err());
    assert!(limits.clone().with_jerk(&[1.0, 1.0]).is_err());
    let limits = limits.with_jerk(&[1.0]).unwrap();
    let fast = JointState { qd: vec![1.5], ..a.clone() };
    assert!(matches!(move_within_limits(&fast, &b, &limits), Err(MotionError::State(_))));
    // With jerk −1 the acceleration is zero after 1 s, when the velocity is 0.9 + 0.5; backwards in time likewise.
    let rising = JointState { qd: vec![0.9], qdd: vec![1.0], ..a.clone() };
    assert!(matches!(move_within_limits(&rising, &b, &limits), Err(MotionError::State(_))));
    let falling = JointState { qd: vec![0.9], qdd: vec![-1.0], ..b.clone() };
    assert!(matches!(move_within_limits(&a, &falling, &limits), Err(MotionError::State(_))));
    assert!(move_within_limits(&a, &rising, &limits).is_ok());
    let unknown = JointState { q: vec![nan], ..a };
    assert_eq!(move_within_limits(&unknown, &b, &limits), Err(MotionError::NotFinite("positions")));
}

#[test]
fn any_state_to_any_state() {
    let mut random = Random(5);
    for round in 0..share(20_000, 2000) {
        let n = 1 + round % 7;
        let mut list = |low, high| (0..n).map(|_| between(&mut random, low, high)).collect::<Vec<f64>>();
        let (v, a, j) = (list(0.5, 3.0), list(1.0, 20.0), list(5.0, 1000.0));
        let limits = Limits::symmetric(&v, &a).unwrap().with_jerk(&j).unwrap();
        let mut state = || {
            let (q, qdd) = (list(-3.0, 3.0), list(-1.0, 1.0));
            let qdd: Vec<f64> = qdd.iter().zip(&a).map(|(x, a)| x * a * 0.9).collect();
            // Velocities that stay within the limit while the acceleration goes back to zero.
            let room = |i: usize| (v[i] - qdd[i] * qdd[i] / (2.0 * j[i])).max(0.0) * 0.99;
            let qd: Vec<f64> = list(-1.0, 1.0).iter().enumerate().map(|(i, x)| x * room(i)).collect();
            let qdd = (0..n).map(|i| if room(i) == 0.0 { 0.0 } else { qdd[i] }).collect();
            JointState { q, qd, qdd }
        };
        let (from, to) = (state(), state());
        let found = move_within_limits(&from, &to, &limits).unwrap();
        for (t, wanted) in [(0.0, &from), (found.duration(), &to)] {
            let at = found.eval(t);
            for i in 0..n {
                near(at.q[i], wanted.q[i], 1e-6);
                near(at.qd[i], wanted.qd[i], 1e-6);
                near(at.qdd[i], wanted.qdd[i], 1e-5);
            }
        }
        for k in 0..=200 {
            let t = found.duration() * f64::from(k) / 200.0;
            let (state, jerk) = (found.eval(t), found.jerk(t));
            for i in 0..n {
                assert!(state.qd[i].abs() <= v[i] * (1.0 + 1e-6));
                assert!(state.qdd[i].abs() <= a[i] * (1.0 + 1e-6));
                assert!(jerk[i].abs() <= j[i] * (1.0 + 1e-6));
            }
        }
        assert!(found.laws().iter().all(|law| matches!(law, TimeLaw::Phases(_))));
    }
}

#[test]
fn states_to_states_as_fast_as_the_original_ruckig() {
    let text = include_str!("../peers/ruckig.json");
    let peer: serde_json::Value = serde_json::from_str(text).unwrap();
    let cases = peer["cases"].as_array().unwrap();
    assert!(cases.len() >= 20);
    for case in cases {
        let list = |name: &str| numbers(&case[name]);
        let range = |low: &str, high: &str| {
            list(low).iter().zip(list(high)).map(|(&lower, upper)| Range { lower, upper }).collect()
        };
        let limits =
            Limits::new(range("min_velocity", "max_velocity"), range("min_acceleration", "max_acceleration"))
                .unwrap()
                .with_jerk(&list("max_jerk"))
                .unwrap();
        let state = |end: &str| JointState {
            q: list(&format!("{end}_position")),
            qd: list(&format!("{end}_velocity")),
            qdd: list(&format!("{end}_acceleration")),
        };
        let found = move_within_limits(&state("current"), &state("target"), &limits).unwrap();
        near(found.duration(), case["duration"].as_f64().unwrap(), 1e-8);
        for sample in case["samples"].as_array().unwrap() {
            let at = found.eval(sample["t"].as_f64().unwrap());
            for (q, wanted) in at.q.iter().zip(numbers(&sample["q"])) {
                near(*q, wanted, 1e-6);
            }
        }
    }
}
