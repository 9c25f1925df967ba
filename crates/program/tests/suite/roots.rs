//! Each root against the equation itself: put in, sampled, at its limits.

use crate::support::solvers::Random;
use denavit_program::solver::{CLAMP, Root, Roots, roots};
use std::f64::consts::{PI, TAU};

/// The signs and the unknowns, angles as angles.
fn angles(found: &Roots) -> Vec<f64> {
    found.values[..found.count].iter().map(|[c, s]| s.atan2(*c)).collect()
}

fn solve(root: Root<f64>) -> Roots {
    let found = roots(&root, None, (1.0, 1.0), None);
    for &[c, s] in &found.values[..found.count] {
        assert!(c.is_finite() && s.is_finite(), "{root:?}: {found:?}");
        assert!(!root.is_angle() || (c.hypot(s) - 1.0).abs() < 1e-13, "{root:?}: {found:?}");
    }
    found
}

/// How often a function changes its sign on a circle, by sampling.
fn sign_changes(f: impl Fn(f64) -> f64) -> usize {
    const SAMPLES: usize = 2000;
    let at = |k: usize| f(TAU * (k as f64 + 0.123) / SAMPLES as f64) > 0.0;
    (0..SAMPLES).filter(|&k| at(k) != at(k + 1)).count()
}

#[test]
fn roots_of_first_degree() {
    let found = solve(Root::Ratio { numerator: 3.0, denominator: -2.0 });
    assert_eq!((found.count, found.values[0], found.signs[0], found.guard), (1, [-1.5, 0.0], 0, 2.0));
    let found = solve(Root::Ratio { numerator: 3.0, denominator: 1e-17 });
    assert_eq!((found.count, found.values[0], found.is_free), (1, [0.0, 0.0], true));
    for (sign, c) in [(None, 0.6), (Some(2.0), 0.6), (Some(-1e-9), -0.6)] {
        let found = solve(Root::Direction { x: 3.0, y: 4.0, sign });
        assert!((found.values[0][0] - c).abs() < 1e-15 && found.count == 1 && found.signs[0] == 0);
    }
    let found = roots(&Root::Direction { x: 1e-15, y: 0.0, sign: None }, None, (1.0, 1.0), Some([0.0, 1.0]));
    assert_eq!((found.count, found.values[0], found.is_free), (1, [0.0, 1.0], true));
    // A guard of its own decides, unless there is nothing to divide by.
    let small = Root::Direction { x: 1e-15, y: 0.0, sign: None };
    let found = roots(&small, Some(1e-3), (1.0, 1.0), None);
    assert_eq!((found.values[0], found.is_free, found.guard), ([1.0, 0.0], false, 1e-3));
    assert!(roots(&Root::Direction { x: 0.0, y: 0.0, sign: None }, Some(1.0), (1.0, 1.0), None).is_free);
    let found = solve(Root::Line { x: -3.0, y: 4.0 });
    assert_eq!((found.count, found.signs[0], found.signs[1]), (2, 1, -1));
    assert!((found.values[0][0] + 0.6).abs() < 1e-15 && (found.values[1][0] - 0.6).abs() < 1e-15);
    let found = solve(Root::Line { x: 0.0, y: 0.0 });
    assert_eq!((found.count, found.values[0], found.signs[0], found.is_free), (1, [1.0, 0.0], 1, true));
    let found = solve(Root::Length { x: -3.0, y: 4.0 });
    assert_eq!((found.count, found.values[0][0], found.values[1][0]), (2, 5.0, -5.0));
    let found = solve(Root::Length { x: 1e-20, y: 0.0 });
    assert_eq!((found.count, found.multiplicities[0], found.signs[0], found.is_free), (1, 2, 1, false));
}

#[test]
fn sine_and_cosine() {
    let mut random = Random(21);
    for _ in 0..5000 {
        let [a, b, c] = [(); 3].map(|()| random.number());
        let found = solve(Root::Sincos { a, b, c, discriminant: None });
        let f = |t: f64| a * t.cos() + b * t.sin() - c;
        let known = found.gap > 0.0 || (a * a + b * b) / (c * c) < 1.001;
        assert!(known || found.count == sign_changes(f), "{a} {b} {c}: {found:?}");
        for (k, angle) in angles(&found).into_iter().enumerate() {
            assert!(f(angle).abs() < 1e-14, "{a} {b} {c}: {found:?}");
            // The derivative is −kR.
            let slope = b * angle.cos() - a * angle.sin();
            assert!(slope * f64::from(found.signs[k]) < 0.0, "{a} {b} {c}: {found:?}");
        }
    }
    // Double, in reach as far as one can tell: the nearest point. Out of reach.
    for c in [1.0, 1.0 + 1e-13, 1.0 + 1e-7] {
        let found = solve(Root::Sincos { a: 0.6, b: 0.8, c: -c, discriminant: None });
        assert_eq!((found.count, found.multiplicities[0], found.signs[0]), (1, 2, 1), "{c}");
        assert!((found.values[0][0] + 0.6).abs() < 1e-15);
    }
    let found = solve(Root::Sincos { a: 0.6, b: 0.8, c: -1.5, discriminant: None });
    assert!(found.count == 0 && (found.gap - 0.5).abs() < 1e-15);
    // Nothing to divide by: free if the equation says 0 = 0.
    let zero = |c| solve(Root::Sincos { a: 0.0, b: 1e-16, c, discriminant: None });
    assert!(zero(1e-12).is_free && zero(1e-12).count == 1 && zero(1e-3).count == 0);
    assert_eq!(solve(Root::Sincos { a: f64::NAN, b: 1.0, c: 0.0, discriminant: None }).count, 0);
    // A discriminant in another form: 2·cos = 2 − 1e-20, sin² = 1e-20.
    let found = solve(Root::Sincos { a: 2.0, b: 0.0, c: 2.0, discriminant: Some(4e-20) });
    assert!(found.count == 2 && (found.values[0][1] - 1e-10).abs() < 1e-24, "{found:?}");
}

#[test]
fn quadratic() {
    let mut random = Random(22);
    for _ in 0..5000 {
        let [a, b, c] = [(); 3].map(|()| random.number());
        let scaled = (a + 0.1 * a.signum()) * 10_f64.powi(-((random.bits() % 12) as i32));
        let found = solve(Root::Quadratic { a: scaled, b, c });
        let d = b * b - scaled * c;
        assert_eq!(found.count, if d > 0.0 { 2 } else { 0 }, "{scaled} {b} {c}: {found:?}");
        for k in 0..found.count {
            let r = found.values[k][0];
            let terms = (scaled * r * r).abs() + (2.0 * b * r).abs() + c.abs();
            assert!(((scaled * r + 2.0 * b) * r + c).abs() <= 4e-15 * terms, "{scaled} {b} {c}: {found:?}");
            // a·r + b = k√D
            let k = f64::from(found.signs[k]);
            assert!(
                (scaled * r + b - k * d.sqrt()).abs() <= 1e-14 * (b.abs() + d.sqrt()),
                "{scaled} {b} {c}"
            );
        }
    }
    let found = solve(Root::Quadratic { a: 1.0, b: -3.0, c: 9.0 * (1.0 + 1e-9) });
    assert_eq!((found.count, found.values[0][0], found.multiplicities[0]), (1, 3.0, 2));
    let found = solve(Root::Quadratic { a: 1.0, b: 1.0, c: 3.0 });
    assert_eq!((found.count, found.gap), (0, 0.4));
    let found = solve(Root::Quadratic { a: 1e-17, b: 2.0, c: 3.0 });
    assert_eq!((found.count, found.values[0][0], found.signs[0], found.is_free), (1, -0.75, 1, false));
    assert!(solve(Root::Quadratic { a: 0.0, b: 0.0, c: 1e-12 }).is_free);
    assert_eq!(solve(Root::Quadratic { a: 0.0, b: 0.0, c: 1.0 }).count, 0);
}

fn wave([cc, cs, c, s, one]: [f64; 5], t: f64) -> f64 {
    let (y, x) = t.sin_cos();
    cc * x * x + cs * x * y + c * x + s * y + one
}

fn quartic(q: [f64; 5]) -> Roots {
    let [cc, cs, c, s, one] = q;
    let found = solve(Root::Quartic { cc, cs, c, s, one });
    let sorted = angles(&found);
    assert!(sorted.is_sorted(), "{q:?}: {sorted:?}");
    assert!((0..found.count).all(|k| usize::try_from(found.signs[k]) == Ok(k + 1)), "{q:?}: {found:?}");
    found
}

/// The coefficients of `(a + b cos(t − u))(c + d cos(t − v))`, two factors whose zeros are known.
fn product([a, b, u]: [f64; 3], [c, d, v]: [f64; 3]) -> [f64; 5] {
    let [[x, y], [z, w]] = [[b * u.cos(), b * u.sin()], [d * v.cos(), d * v.sin()]];
    [x * z - y * w, x * w + y * z, a * z + c * x, a * w + c * y, a * c + y * w]
}

#[test]
fn quartic_with_any_number_of_roots() {
    let mut random = Random(23);
    let mut seen = [0; 5];
    for round in 0..4000 {
        let mut q = [(); 5].map(|()| random.number());
        if round % 4 == 1 {
            // Nearly, or exactly, of degree 1.
            let small = if round % 8 == 1 { 0.0 } else { 10_f64.powi(-((random.bits() % 17) as i32)) };
            (q[0], q[1]) = (q[0] * small, q[1] * small);
        }
        let found = quartic(q);
        let sum: f64 = q.iter().map(|x| x.abs()).sum();
        let plain = (0..found.count).filter(|&k| found.multiplicities[k] == 1).count();
        for angle in angles(&found) {
            assert!(wave(q, angle).abs() <= CLAMP * sum, "{q:?}: {found:?}");
        }
        // Roots nearer to one another than the samples are not seen by these.
        let sorted = angles(&found);
        let is_close = |k: usize| {
            let next = sorted[(k + 1) % sorted.len()] + if k + 1 == sorted.len() { TAU } else { 0.0 };
            next - sorted[k] < 0.01
        };
        if sorted.len() < 2 || !(0..sorted.len()).any(is_close) {
            assert_eq!(plain, sign_changes(|t| wave(q, t)), "{q:?}: {found:?}");
            seen[plain] += 1;
        }
    }
    assert!([0, 2, 4].iter().all(|&k| seen[k] > 50), "{seen:?}");
}

#[test]
fn quartic_with_known_roots() {
    let mut random = Random(24);
    for round in 0..4000 {
        let [u, v, h, w] = [(); 4].map(|()| random.number() * PI);
        let (h, w) = (h.abs(), w.abs());
        let near = 10_f64.powi(-((random.bits() % 16) as i32));
        // Zeros at u ± h and v ± w.
        let (u, h) = match round % 6 {
            0 => (u, h),
            1 => (u, 0.0),
            2 => (u, near),
            3 => (PI, near),
            4 => (PI, 0.0),
            _ => (PI - h, h),
        };
        let v = if round % 12 > 8 { u + near } else { v };
        let q = product([-h.cos(), 1.0, u], [-w.cos(), 1.0, v]);
        let found = quartic(q);
        let total: u32 = found.multiplicities[..found.count].iter().sum();
        assert!(total <= 4, "{q:?}: {found:?}");
        let zeros = [u - h, u + h, v - w, v + w];
        for (k, zero) in zeros.into_iter().enumerate() {
            let away = |x: f64| ((x - zero) - TAU * ((x - zero) / TAU).round()).abs();
            let nearest = angles(&found).into_iter().map(away).fold(f64::INFINITY, f64::min);
            // Rounding moves a zero by ε/|f'|, a double one by √ε, one of order four by its fourth root.
            assert!(nearest < 2e-3, "{zero} is {nearest:e} away; {q:?}: {found:?}");
            let others = zeros.into_iter().enumerate().filter(|o| o.0 != k);
            let apart = others.map(|o| away(o.1)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-13 / apart.powi(3).max(1e-11), "{zero}: {nearest:e}; {q:?}: {found:?}");
        }
    }
}

#[test]
fn quartic_at_its_limits() {
    // cos² = 1, twice double; cos = −1, double at π; 1 + cos² has none.
    let found = quartic([1.0, 0.0, 0.0, 0.0, -1.0]);
    assert_eq!((found.count, found.multiplicities[0], found.multiplicities[1]), (2, 2, 2));
    let found = quartic([0.0, 0.0, 1.0, 0.0, 1.0]);
    assert_eq!((found.count, found.multiplicities[0], found.values[0][0]), (1, 2, -1.0));
    let found = quartic([1.0, 0.0, 0.0, 0.0, 1.0]);
    assert!(found.count == 0 && found.gap > 0.1);
    // A minimum just above 0 counts as touching; one that is well above does not.
    assert_eq!(quartic([1.0, 0.0, 0.0, 0.0, 1e-8]).count, 2);
    assert_eq!(quartic([1.0, 0.0, 0.0, 0.0, 1e-4]).count, 0);
    // (1 + cos)²: order four.
    let found = quartic([1.0, 0.0, 2.0, 0.0, 1.0]);
    assert!((1..=2).contains(&found.count), "{found:?}");
    assert!(angles(&found).iter().all(|t| PI - t.abs() < 1e-3), "{found:?}");
    let free = solve(Root::Quartic { cc: 0.0, cs: 1e-17, c: 0.0, s: 0.0, one: 0.0 });
    assert_eq!((free.count, free.is_free, free.signs[0]), (1, true, 1));
    // Sizes at which squares overflow or vanish.
    for size in [1e-300, 1e300] {
        let q = [1.0, 0.3, -0.2, 0.1, -0.4].map(|x| x * size);
        let [cc, cs, c, s, one] = q;
        let found = roots(&Root::Quartic { cc, cs, c, s, one }, None, (size, 1.0), None);
        assert_eq!(found.count, quartic([1.0, 0.3, -0.2, 0.1, -0.4]).count);
    }
}
