//! Paths and their timing under velocity and acceleration limits: splines interpolate, blends keep their deviation,
//! timings are as fast as those of toppra, keep the limits at all times, and refuse what cannot be.

use crate::common::{Random, numbers, share};
use denavit::motion::path::{
    Blend, Ends, PathPoint, PiecewisePath, QuinticEnds, Side, blended, chord_lengths, cubic_spline,
    cubic_spline_at, quintic_spline,
};
use denavit::motion::timing::{Grid, Scheme, TimedPath};
use denavit::motion::{JointPath, Limits, MotionError, Range, TimeOptimal, Trajectory};
use serde_json::Value;

/// The Panda's limits as its manufacturer states them (Franka Control Interface documentation), rad/s and rad/s².
const PANDA: ([f64; 7], [f64; 7]) =
    ([2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61], [15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0]);

fn panda() -> Limits {
    Limits::symmetric(&PANDA.0, &PANDA.1).unwrap()
}

#[track_caller]
fn near(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b}");
}

fn way_points(random: &mut Random, n: usize, dof: usize) -> Vec<Vec<f64>> {
    (0..n).map(|_| (0..dof).map(|_| 4.0 * random.unit() - 2.0).collect()).collect()
}

/// The greatest shares of velocity and acceleration limits, at many times and on both sides of each grid point.
fn shares<P: JointPath>(timed: &TimedPath<P>, limits: &Limits) -> [f64; 2] {
    let even = (0..=10_000).map(|k| timed.duration() * f64::from(k) / 10_000.0);
    let grid = timed.times().iter().flat_map(|t| [t - 1e-9, t + 1e-9]);
    let mut most = [0.0f64; 2];
    for t in even.chain(grid) {
        let state = timed.eval(t);
        for j in 0..limits.dof() {
            most[0] = most[0].max(limits.velocity()[j].share(state.qd[j]));
            most[1] = most[1].max(limits.acceleration()[j].share(state.qdd[j]));
        }
    }
    most
}

/// All derivatives of a path are slopes of the one before.
fn derivatives_agree(path: &PiecewisePath) {
    for piece in path.breaks().windows(2) {
        let (middle, h) = ((piece[0] + piece[1]) / 2.0, 1e-3 * (piece[1] - piece[0]));
        let [a, m, b] = [middle - h, middle, middle + h].map(|s| path.eval(s));
        let size = |list: &[f64]| list.iter().fold(1.0f64, |m, x| m.max(x.abs()));
        for j in 0..path.dof() {
            for (low, high, slope) in [(&a.q, &b.q, &m.dq), (&a.dq, &b.dq, &m.ddq), (&a.ddq, &b.ddq, &m.dddq)]
            {
                let tolerance = 1e-4 * size(slope) + 1e-13 * size(high) / h;
                near((high[j] - low[j]) / (2.0 * h), slope[j], tolerance);
            }
        }
    }
}

/// The greatest jump of each derivative at a knot, relative to its greatest value on the path.
fn jumps(path: &PiecewisePath) -> [f64; 4] {
    let mut greatest = [1.0f64; 4];
    let mut jump = [0.0f64; 4];
    for &s in path.knots() {
        let (mut a, mut b) = (PathPoint::zeros(path.dof()), PathPoint::zeros(path.dof()));
        path.eval_into(s, Side::Before, &mut a);
        path.eval_into(s, Side::Behind, &mut b);
        for (k, (a, b)) in
            [(&a.q, &b.q), (&a.dq, &b.dq), (&a.ddq, &b.ddq), (&a.dddq, &b.dddq)].into_iter().enumerate()
        {
            for (a, b) in a.iter().zip(b) {
                greatest[k] = greatest[k].max(a.abs());
                jump[k] = jump[k].max((a - b).abs());
            }
        }
    }
    std::array::from_fn(|k| jump[k] / greatest[k])
}

#[test]
fn splines_pass_their_way_points_smoothly() {
    let mut random = Random(11);
    for n in [2, 3, 4, 9, 30] {
        let w = way_points(&mut random, n, 3);
        let s = chord_lengths(&w).unwrap();
        let (t0, t1) = (vec![0.3, -0.2, 0.1], vec![0.0, 0.5, -0.7]);
        let natural = cubic_spline(&w, &Ends::Natural).unwrap();
        let clamped = cubic_spline(&w, &Ends::Clamped(t0.clone(), t1.clone())).unwrap();
        let smooth = quintic_spline(&w, &QuinticEnds::Natural).unwrap();
        let ends = QuinticEnds::Clamped([t0.clone(), t1.clone()], [t1.clone(), t0.clone()]);
        let held = quintic_spline(&w, &ends).unwrap();
        for path in [&natural, &clamped, &smooth, &held] {
            for (s, q) in s.iter().zip(&w) {
                for (found, wanted) in path.eval(*s).q.iter().zip(q) {
                    near(*found, *wanted, 1e-9);
                }
            }
            derivatives_agree(path);
        }
        for path in [&natural, &clamped] {
            assert!(jumps(path)[..3].iter().all(|j| *j < 1e-9), "{:?}", jumps(path));
        }
        for path in [&smooth, &held] {
            assert!(jumps(path).iter().all(|j| *j < 1e-7), "{:?}", jumps(path));
        }
        for (found, wanted) in [
            (&natural.eval(0.0).ddq, &vec![0.0; 3]),
            (&natural.eval(natural.end()).ddq, &vec![0.0; 3]),
            (&clamped.eval(0.0).dq, &t0),
            (&clamped.eval(clamped.end()).dq, &t1),
            (&held.eval(0.0).dq, &t0),
            (&held.eval(0.0).ddq, &t1),
            (&held.eval(held.end()).dq, &t1),
            (&held.eval(held.end()).ddq, &t0),
            (&smooth.eval(0.0).dddq, &vec![0.0; 3]),
        ] {
            for (found, wanted) in found.iter().zip(wanted) {
                near(*found, *wanted, 1e-8);
            }
        }
    }
}

#[test]
fn a_spline_reproduces_its_polynomial() {
    // A clamped cubic spline through points of a cubic is that cubic; a quintic spline likewise.
    let cubic = |s: f64| [1.0 + s * (2.0 + s * (-3.0 + s)), 2.0 - 6.0 * s + 3.0 * s * s];
    let s = [0.0, 0.4, 1.1, 2.0, 2.3];
    let w: Vec<Vec<f64>> = s.iter().map(|s| vec![cubic(*s)[0]]).collect();
    let ends = Ends::Clamped(vec![cubic(0.0)[1]], vec![cubic(2.3)[1]]);
    let path = cubic_spline_at(&s, &w, &ends).unwrap();
    let quintic = |s: f64| [s.powi(5) - s * s, 5.0 * s.powi(4) - 2.0 * s, 20.0 * s.powi(3) - 2.0];
    let w: Vec<Vec<f64>> = s.iter().map(|s| vec![quintic(*s)[0]]).collect();
    let end = |s| [vec![quintic(s)[1]], vec![quintic(s)[2]]];
    let smooth =
        denavit::motion::path::quintic_spline_at(&s, &w, &QuinticEnds::Clamped(end(0.0), end(2.3))).unwrap();
    for k in 0..=100 {
        let s = 2.3 * f64::from(k) / 100.0;
        near(path.eval(s).q[0], cubic(s)[0], 1e-12);
        near(smooth.eval(s).q[0], quintic(s)[0], 1e-10);
    }
}

#[test]
fn blends_pass_at_the_deviation_stated() {
    let mut random = Random(12);
    for blend in [Blend::Parabolic, Blend::Quintic] {
        for _ in 0..50 {
            let w = way_points(&mut random, 6, 3);
            let wished: Vec<f64> = (0..4).map(|_| 0.05 * random.unit()).collect();
            let path = blended(&w, &wished, blend).unwrap();
            derivatives_agree(&path);
            let smooth = jumps(&path);
            assert!(smooth[0].max(smooth[1]) < 1e-9);
            assert_eq!(smooth[2] < 1e-6, blend == Blend::Quintic, "{smooth:?}");
            let distance = |s: f64, q: &[f64]| {
                path.eval(s).q.iter().zip(q).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
            };
            let lengths = chord_lengths(&w).unwrap();
            for (i, wished) in wished.iter().enumerate() {
                // The middle of the blend is nearest, at the parameter of the corner.
                let (s, q) = (lengths[i + 1], &w[i + 1]);
                let [before, behind] = [i, i + 1].map(|k| lengths[k + 1] - lengths[k]);
                let bend: f64 = (0..3)
                    .map(|j| (w[i + 2][j] - q[j]) / behind - (q[j] - w[i][j]) / before)
                    .map(|x| x * x)
                    .sum::<f64>()
                    .sqrt();
                let depth = if blend == Blend::Parabolic { 0.25 } else { 0.1875 };
                near(distance(s, q), wished.min(depth * bend * before.min(behind) / 2.0), 1e-9);
                for off in [-0.3, -0.1, 0.1, 0.3] {
                    assert!(distance(s + off * wished, q) >= distance(s, q) - 1e-9);
                }
            }
            near(distance(0.0, &w[0]), 0.0, 1e-12);
            near(distance(path.end(), &w[5]), 0.0, 1e-9);
        }
        // A blend takes at most half of a line: here the deviation is 1/4 (3/16) of half the diagonal √2 / 2 · 2.
        let w = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]].map(Vec::from);
        let path = blended(&w, &[9.0], blend).unwrap();
        let depth = if blend == Blend::Parabolic { 0.25 } else { 0.1875 };
        let q = path.eval(1.0).q;
        near((q[0] - 1.0).hypot(q[1]), 0.5 * depth * 2.0f64.sqrt(), 1e-12);
        // Lines that go on in the same direction are one line.
        let straight = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]].map(Vec::from);
        assert!(jumps(&blended(&straight, &[0.1], blend).unwrap())[1] < 1e-12);
    }
}

#[test]
fn one_joint_on_a_line_is_bang_bang() {
    for (d, v, a) in [(1.0f64, 100.0f64, 4.0f64), (0.3, 0.7, 2.0), (2.0, 1.0, 50.0)] {
        // T = 2 √(d/a), or d/v + v/a where the velocity is reached (here at d > v²/a).
        let best = if d > v * v / a { d / v + v / a } else { 2.0 * (d / a).sqrt() };
        let limits = Limits::symmetric(&[v], &[a]).unwrap();
        let path = cubic_spline(&[vec![0.2], vec![0.2 - d]], &Ends::Natural).unwrap();
        for scheme in [Scheme::Collocation, Scheme::Interpolation, Scheme::Throughout] {
            let timing = TimeOptimal { scheme, grid: Grid::Uniform(1000), ..TimeOptimal::default() };
            let timed = timing.time(&path, &limits).unwrap();
            near(timed.duration(), best, 1e-4 * best);
            assert!(timed.duration() >= best * (1.0 - 1e-9));
        }
    }
}

#[test]
fn different_limits_in_the_two_directions() {
    // Up to speed with 1, down with 4: T = √(2d (1/1 + 1/4)); backwards the same with the limits changed over.
    let limits = Limits::new(vec![Range::symmetric(100.0)], vec![Range { lower: -4.0, upper: 1.0 }]).unwrap();
    let best = 2.5f64.sqrt();
    for (from, to) in [(0.0, 1.0), (1.0, 0.0)] {
        let path = cubic_spline(&[vec![from], vec![to]], &Ends::Natural).unwrap();
        let timed =
            TimeOptimal { grid: Grid::Uniform(2000), ..TimeOptimal::default() }.time(path, &limits).unwrap();
        near(timed.duration(), best, 1e-3);
        let middle = timed.eval(timed.duration() / 2.0).qdd[0];
        near(middle, 1.0, 1e-6); // braking takes the last fifth of the time in both directions
    }
}

#[test]
fn as_fast_as_toppra() {
    let peer: Value = serde_json::from_str(include_str!("../peers/toppra.json")).unwrap();
    let cases = peer["cases"].as_array().unwrap();
    assert!(cases.len() >= 10);
    for case in cases {
        let lists = |name: &str| case[name].as_array().unwrap().iter().map(numbers).collect::<Vec<_>>();
        let ranges = |name: &str| lists(name).iter().map(|r| Range { lower: r[0], upper: r[1] }).collect();
        let w = lists("way_points");
        let ends = match case["ends"].as_str().unwrap() {
            "clamped" => Ends::Clamped(vec![0.0; w[0].len()], vec![0.0; w[0].len()]),
            _ => Ends::Natural,
        };
        let path = cubic_spline_at(&numbers(&case["parameters"]), &w, &ends).unwrap();
        let limits = Limits::new(ranges("velocity"), ranges("acceleration")).unwrap();
        let n = case["intervals"].as_u64().unwrap() as u32;
        let [start_speed, end_speed] = numbers(&case["speeds"])[..] else { panic!("two speeds") };
        let timing = TimeOptimal {
            grid: Grid::Points((0..=n).map(|i| f64::from(i) / f64::from(n)).collect()),
            scheme: match case["scheme"].as_str().unwrap() {
                "collocation" => Scheme::Collocation,
                _ => Scheme::Interpolation,
            },
            start_speed,
            end_speed,
        };
        let timed = timing.time(&path, &limits).unwrap();
        let wanted = case["duration"].as_f64().unwrap();
        near(timed.duration(), wanted, 3e-4 * wanted);
        let stored = numbers(&case["speed_samples"]);
        for (speed, wanted) in timed.speeds().iter().step_by(25).zip(&stored) {
            // At collocation zero-inertia points speeds jitter, and depend on the last digits.
            near(
                *speed,
                *wanted,
                if timing.scheme == Scheme::Collocation { 0.02 } else { 5e-4 } * (wanted + 0.01),
            );
        }
        // With the limits held throughout it takes a little longer.
        let timing = TimeOptimal { scheme: Scheme::Throughout, grid: Grid::Uniform(n as usize), ..timing };
        let timed = timing.time(&path, &limits).unwrap();
        near(timed.duration(), wanted, 0.01 * wanted);
        let [v, a] = shares(&timed, &limits);
        assert!(v.max(a) <= 1.0 + 1e-7, "{} {v} {a}", case["kind"]);
    }
}

#[test]
fn limits_hold_at_all_times() {
    let mut random = Random(13);
    for round in 0..share(400, 16) {
        let dof = 1 + round % 7;
        let n = 3 + (30.0 * random.unit()) as usize;
        let w = way_points(&mut random, n, dof);
        let mut ranges = |scale: f64| -> Vec<Range> {
            let mut bound = || scale * (0.1 + random.unit());
            (0..dof).map(|_| Range { lower: -bound(), upper: bound() }).collect()
        };
        let limits = Limits::new(ranges(3.0), ranges(20.0)).unwrap();
        let deviations = vec![0.02; n - 2];
        let paths = [
            cubic_spline(&w, &Ends::Natural).unwrap(),
            cubic_spline(&w, &Ends::Clamped(vec![0.0; dof], vec![0.0; dof])).unwrap(),
            quintic_spline(&w, &QuinticEnds::Natural).unwrap(),
            blended(&w, &deviations, Blend::Parabolic).unwrap(),
            blended(&w, &deviations, Blend::Quintic).unwrap(),
        ];
        for (k, path) in paths.iter().enumerate() {
            let timed = TimeOptimal::default().time(path, &limits).unwrap();
            let [v, a] = shares(&timed, &limits);
            // Accelerations are parabolas between grid points where q'' is linear, else nearly so.
            let tolerance = if matches!(k, 2 | 4) { 3e-5 } else { 1e-6 };
            assert!(v.max(a) <= 1.0 + tolerance, "round {round}, path {k}: {v} {a}");
            // With speeds at the ends nothing can be slowed down as a whole: limits are tightened where need be.
            let (start_speed, end_speed) = (1e-3 * path.end(), 1e-3 * path.end());
            let moving = TimeOptimal { start_speed, end_speed, ..TimeOptimal::default() };
            let moving = moving.time(path, &limits).unwrap();
            let [v, a] = shares(&moving, &limits);
            assert!(v.max(a) <= 1.0 + 2.0 * tolerance, "round {round}, path {k}, moving: {v} {a}");
            assert!(moving.duration() < timed.duration());
            let [v, a] = shares(&timed, &limits);
            // Something is always at its limit, or it would not be the fastest.
            assert!(v.max(a) > 0.999);
            let (start, end) = (timed.eval(0.0), timed.eval(timed.duration()));
            for (j, (first, last)) in w[0].iter().zip(&w[n - 1]).enumerate() {
                near(start.q[j], *first, 1e-12);
                near(end.q[j], *last, 1e-9);
                assert_eq!((start.qd[j], end.qd[j]), (0.0, 0.0));
            }
        }
    }
}

#[test]
fn a_timing_is_continuous_and_its_velocity_is_a_slope() {
    let w = way_points(&mut Random(14), 8, 4);
    let limits = Limits::symmetric(&[1.0; 4], &[3.0; 4]).unwrap();
    let timed = TimeOptimal::default().time(cubic_spline(&w, &Ends::Natural).unwrap(), &limits).unwrap();
    let samples = timed.resample(1e-3).unwrap();
    near(samples.last().unwrap().0, timed.duration(), 0.0);
    for pair in samples.windows(2) {
        let ((t0, a), (t1, b)) = (&pair[0], &pair[1]);
        let dt = t1 - t0;
        assert!(dt > 0.0 && dt <= 1e-3 * (1.0 + 1e-6));
        for j in 0..4 {
            // The velocity changes by no more than 3 dt, and the mean of both ends is the slope to that order.
            assert!((b.qd[j] - a.qd[j]).abs() <= 3.0 * dt * (1.0 + 1e-6));
            near(b.q[j] - a.q[j], (a.qd[j] + b.qd[j]) / 2.0 * dt, 3.0 * dt * dt / 4.0 + 1e-12);
        }
    }
}

#[test]
fn the_way_back_takes_as_long() {
    let mut random = Random(15);
    for _ in 0..20 {
        let w = way_points(&mut random, 10, 7);
        let limits = panda();
        let back: Vec<Vec<f64>> = w.iter().rev().cloned().collect();
        let paths = |w: &[Vec<f64>]| {
            [cubic_spline(w, &Ends::Natural).unwrap(), blended(w, &[0.05; 8], Blend::Parabolic).unwrap()]
        };
        for (there, back) in paths(&w).into_iter().zip(paths(&back)) {
            for scheme in [Scheme::Interpolation, Scheme::Throughout] {
                let timing = TimeOptimal { scheme, ..TimeOptimal::default() };
                let there = timing.time(&there, &limits).unwrap().duration();
                let back = timing.time(&back, &limits).unwrap().duration();
                // At zero-inertia points (Pham & Pham 2018, §IV) the passes are not quite symmetric on a grid.
                near(back, there, 2e-3 * there);
            }
        }
    }
}

#[test]
fn it_stops_at_corners_and_turns_round() {
    // Three lines without blends: three motions from rest to rest.
    let w = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [2.0, 0.5]].map(Vec::from);
    let limits = Limits::symmetric(&[9.0; 2], &[4.0; 2]).unwrap();
    let path = blended(&w, &[0.0; 2], Blend::Parabolic).unwrap();
    let timed = TimeOptimal::default().time(path, &limits).unwrap();
    let best = 2.0 * (0.5 + 0.125f64.sqrt() + 0.5);
    near(timed.duration(), best, 1e-3 * best);
    // There and back on one line with a blend at the turn, where q' = 0 in the middle of it.
    let back = [vec![0.0], vec![1.0], vec![0.0]];
    let limits = Limits::symmetric(&[9.0], &[4.0]).unwrap();
    let path = blended(&back, &[0.1], Blend::Quintic).unwrap();
    let timed =
        TimeOptimal { grid: Grid::Uniform(2000), ..TimeOptimal::default() }.time(path, &limits).unwrap();
    // It turns at 0.9: full speed up, full braking over the turn, full braking at the end: 4 √(0.9/4) = 2 · 0.9487.
    near(timed.duration(), 4.0 * (0.9f64 / 4.0).sqrt(), 1e-2);
    let [v, a] = shares(&timed, &limits);
    assert!(v.max(a) < 1.0 + 1e-6);
}

#[test]
fn speeds_at_the_ends() {
    let path = cubic_spline(&[vec![0.0], vec![1.0]], &Ends::Natural).unwrap(); // s is the position
    let limits = Limits::symmetric(&[2.0], &[1.0]).unwrap();
    let timing = |start_speed, end_speed| TimeOptimal { start_speed, end_speed, ..TimeOptimal::default() };
    // From 1 to 1 at an acceleration of 1: v² = 1 + 2 · 1/2 in the middle, T = 2 (√2 − 1).
    let timed = timing(1.0, 1.0).time(&path, &limits).unwrap();
    near(timed.duration(), 2.0 * (2.0f64.sqrt() - 1.0), 1e-4);
    near(timed.eval(0.0).qd[0], 1.0, 1e-12);
    near(timed.eval(9.0).qd[0], 1.0, 1e-12);
    // √2 is what can be stopped in a distance of 1.
    assert!(timing(1.41, 0.0).time(&path, &limits).is_ok());
    match timing(1.5, 0.0).time(&path, &limits) {
        Err(MotionError::EndSpeed { s: 0.0, speed: 1.5, possible: [low, high] }) => {
            near(low, 0.0, 0.0);
            near(high, 2.0f64.sqrt(), 1e-9);
        }
        other => panic!("{other:?}"),
    }
    assert!(matches!(timing(0.0, 3.0).time(&path, &limits), Err(MotionError::EndSpeed { s: 1.0, .. })));
    assert!(matches!(timing(-1.0, 0.0).time(&path, &limits), Err(MotionError::EndSpeed { .. })));
    assert_eq!(timing(f64::NAN, 0.0).time(&path, &limits), Err(MotionError::NotFinite("speeds at the ends")));
}

/// An arc with q'' so great behind s = 0.6 that a speed given at the end cannot be held or reached.
#[test]
fn what_cannot_be_controlled_is_refused_with_its_place() {
    let w = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]].map(Vec::from);
    let path = blended(&w, &[0.01], Blend::Parabolic).unwrap();
    let limits = Limits::symmetric(&[100.0; 2], &[1.0; 2]).unwrap();
    // At most √(2 · 1) can be reached behind the corner, and the corner allows less.
    let timing = TimeOptimal { end_speed: 1.5, ..TimeOptimal::default() };
    match timing.time(&path, &limits) {
        Err(MotionError::NotControllable { s }) => assert!((0.9..1.2).contains(&s), "{s}"),
        other => panic!("{other:?}"),
    }
    // A joint that may only go forward on a path that needs it to go back.
    let one_way =
        Limits::new(vec![Range { lower: 0.0, upper: 1.0 }; 2], vec![Range::symmetric(1.0); 2]).unwrap();
    let there = cubic_spline(&w, &Ends::Clamped(vec![1.0, 0.0], vec![0.0, 1.0])).unwrap();
    let back = cubic_spline(&[vec![1.0, 0.0], vec![0.0, 0.0]], &Ends::Natural).unwrap();
    assert!(matches!(TimeOptimal::default().time(back, &one_way), Err(MotionError::Stuck { s: 0.0 })));
    let found = TimeOptimal::default().time(there, &one_way);
    assert!(found.is_ok() || matches!(found, Err(MotionError::Stuck { .. })));
}

#[test]
fn what_is_refused() {
    let q = |x: f64| vec![x, 0.0];
    assert_eq!(cubic_spline(&[], &Ends::Natural), Err(MotionError::TooFewWayPoints(0)));
    assert_eq!(cubic_spline(&[q(1.0)], &Ends::Natural), Err(MotionError::TooFewWayPoints(1)));
    assert_eq!(
        cubic_spline(&[q(1.0), q(2.0), q(2.0), q(3.0)], &Ends::Natural),
        Err(MotionError::RepeatedWayPoint(2))
    );
    assert_eq!(blended(&[q(1.0), q(1.0)], &[], Blend::Quintic), Err(MotionError::RepeatedWayPoint(1)));
    assert_eq!(
        quintic_spline(&[q(1.0), q(f64::NAN)], &QuinticEnds::Natural),
        Err(MotionError::NotFinite("way-points"))
    );
    assert!(cubic_spline(&[q(1.0), q(f64::INFINITY)], &Ends::Natural).is_err());
    assert!(matches!(cubic_spline(&[q(1.0), vec![1.0]], &Ends::Natural), Err(MotionError::Joints { .. })));
    assert!(cubic_spline(&[vec![], vec![]], &Ends::Natural).is_err());
    assert_eq!(
        cubic_spline_at(&[0.0, 1.0, 1.0], &[q(0.0), q(1.0), q(2.0)], &Ends::Natural),
        Err(MotionError::NotIncreasing("parameters of way-points", 2))
    );
    assert!(blended(&[q(0.0), q(1.0), q(2.0)], &[-0.1], Blend::Parabolic).is_err());
    assert!(blended(&[q(0.0), q(1.0), q(2.0)], &[], Blend::Parabolic).is_err());

    let path = cubic_spline(&[q(0.0), q(1.0)], &Ends::Natural).unwrap();
    assert!(matches!(TimeOptimal::default().time(&path, &panda()), Err(MotionError::Joints { .. })));
    let limits = Limits::symmetric(&[1.0; 2], &[1.0; 2]).unwrap();
    for points in [vec![], vec![0.0, 0.5], vec![0.0, 0.5, 0.5, 1.0], vec![0.0, f64::NAN, 1.0], vec![0.1, 1.0]]
    {
        let timing = TimeOptimal { grid: Grid::Points(points), ..TimeOptimal::default() };
        assert!(timing.time(&path, &limits).is_err());
    }
    let huge = TimeOptimal { grid: Grid::Uniform(usize::MAX), ..TimeOptimal::default() };
    assert!(matches!(huge.time(&path, &limits), Err(MotionError::TooMany(..))));
    // Both way-points are the same, at parameters that are not.
    let still = cubic_spline_at(&[0.0, 1.0], &[q(1.0), q(1.0)], &Ends::Natural).unwrap();
    assert_eq!(TimeOptimal::default().time(still, &limits).unwrap_err(), MotionError::ZeroLength);
    let timed = TimeOptimal::default().time(&path, &limits).unwrap();
    for dt in [0.0, -1.0, f64::NAN, 1e-300] {
        assert!(timed.resample(dt).is_err());
    }
    assert_eq!(
        cubic_spline(&[q(1.0), q(1.0)], &Ends::Natural).unwrap_err().to_string(),
        "way-point 1 (counted from 0) repeats the one before it: leave it out"
    );
}

/// Joints that stand still for a while, way-points that nearly repeat, lengths and limits of very different sizes.
#[test]
fn degenerate_paths_are_timed() {
    let mut random = Random(16);
    for round in 0..share(600, 26) {
        let size = 10f64.powi(round as i32 % 13 - 6);
        let mut w = way_points(&mut random, 6, 3);
        for q in &mut w[2..4] {
            q[1] = 0.25; // a joint that does not move
        }
        w[4] = w[3].iter().map(|x| x + 1e-7 * random.unit()).collect();
        for q in w.iter_mut().flatten() {
            *q *= size;
        }
        let limits = Limits::symmetric(&[1.0, 1e-2, 1e2], &[1e-3, 10.0, 1e3]).unwrap();
        for path in [
            cubic_spline(&w, &Ends::Natural).unwrap(),
            blended(&w, &[1e-3 * size; 4], Blend::Parabolic).unwrap(),
            blended(&w, &[0.0; 4], Blend::Quintic).unwrap(),
        ] {
            for scheme in [Scheme::Collocation, Scheme::Interpolation, Scheme::Throughout] {
                let timing = TimeOptimal { scheme, ..TimeOptimal::default() };
                let timed = timing.time(&path, &limits).unwrap();
                assert!(timed.duration().is_finite() && timed.duration() > 0.0);
                if scheme == Scheme::Throughout {
                    let [v, a] = shares(&timed, &limits);
                    assert!(v.max(a) <= 1.0 + 1e-5, "round {round}: {v} {a}");
                }
            }
        }
    }
}

/// A Lissajous figure: no polynomial, and nobody knows its third derivative.
#[derive(Debug, Default)]
struct Lissajous(Vec<f64>);

impl JointPath for Lissajous {
    fn dof(&self) -> usize {
        2
    }

    fn end(&self) -> f64 {
        2.0
    }

    fn eval_into(&self, s: f64, _: Side, point: &mut PathPoint) {
        for (j, (w, phase)) in [(6.0, 0.0), (5.0, 1.0)].into_iter().enumerate() {
            let (sin, cos) = f64::sin_cos(w * s + phase);
            (point.q[j], point.dq[j], point.ddq[j]) = (sin, w * cos, -w * w * sin);
        }
    }

    fn knots(&self) -> &[f64] {
        &self.0
    }

    fn has_third_derivative(&self) -> bool {
        false
    }
}

#[test]
fn limits_hold_on_coarse_grids() {
    for (v, a) in [(1.0, 100.0), (1.0, 4.0), (9.0, 1.0)] {
        let limits = Limits::symmetric(&[v; 2], &[a; 2]).unwrap();
        for (n, tolerance) in [(24, 1e-2), (60, 5e-4), (500, 1e-5)] {
            let timing = TimeOptimal { grid: Grid::Uniform(n), ..TimeOptimal::default() };
            let timed = timing.time(Lissajous::default(), &limits).unwrap();
            let most = shares(&timed, &limits);
            assert!(most.iter().all(|share| *share <= 1.0 + tolerance), "{n}: {most:?}");
        }
    }
}

#[test]
fn knots_out_of_order_are_refused() {
    let limits = Limits::symmetric(&[1.0; 2], &[1.0; 2]).unwrap();
    for knots in [
        vec![0.5, 0.3],
        vec![0.0],
        vec![-1.0],
        vec![2.0],
        vec![3.0],
        vec![1e300],
        vec![f64::NAN],
        vec![0.5, 0.5],
    ] {
        let found = TimeOptimal::default().time(Lissajous(knots), &limits);
        assert!(matches!(found, Err(MotionError::NotIncreasing("knots of the path", _))));
    }
    assert!(TimeOptimal::default().time(Lissajous(vec![0.3, 0.5]), &limits).is_ok());
}
