//! Where a function along a curve is at most 0: the parts of a curve that the limits allow.
//!
//! The function is known at points that follow its turns; between them its zeros are bracketed and closed in on, and
//! where a lowest or a highest point may reach beyond 0, it is looked for.

/// A place along the curve, and how far the worst joint is beyond its limit there.
pub(super) type Point = (f64, f64);

/// A value that counts as 0 where it was computed as one: at a cut.
const ZERO: f64 = 1e-11;
/// How near places are closed in on (radians or metres).
const NEAR: f64 = 1e-13;

/// The parts in which the function is at most 0, between the first and the last of `points` (sorted).
pub(super) fn intervals(points: &[Point], mut f: impl FnMut(f64) -> Option<f64>) -> Vec<[f64; 2]> {
    let mut all: Vec<Point> = vec![];
    for k in 0..points.len() {
        all.push(points[k]);
        if k == 0 || k + 1 == points.len() {
            continue;
        }
        let [a, b, c] = [points[k - 1], points[k], points[k + 1]];
        let turns = (b.1 > ZERO && b.1 <= a.1 && b.1 <= c.1) || (b.1 < 0.0 && b.1 >= a.1 && b.1 >= c.1);
        // A curve does not turn much more sharply between points than it does from one to the next.
        if turns && b.1.abs() <= 2.0 * (a.1 - b.1).abs().max((c.1 - b.1).abs()) {
            let sign = if b.1 > 0.0 { 1.0 } else { -1.0 };
            if let Some(found) = beyond(a.0, b, c.0, sign, &mut f) {
                let place = if found.0 < b.0 { all.len() - 1 } else { all.len() };
                all.insert(place, found);
            }
        }
    }
    let mut parts: Vec<[f64; 2]> = vec![];
    let mut add = |low: f64, high: f64| match parts.last_mut() {
        Some(part) if part[1] == low => part[1] = high,
        _ if high - low > NEAR => parts.push([low, high]),
        _ => {}
    };
    for pair in all.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        match (a.1 <= ZERO, b.1 <= ZERO) {
            (true, true) => add(a.0, b.0),
            (true, false) => add(a.0, zero(a, b, &mut f)),
            (false, true) => add(zero(b, a, &mut f), b.0),
            (false, false) => {}
        }
    }
    parts
}

/// A place between `low` and `high` where the function, which has its least size at `middle`, has the other sign.
fn beyond(
    low: f64,
    middle: Point,
    high: f64,
    sign: f64,
    f: &mut impl FnMut(f64) -> Option<f64>,
) -> Option<Point> {
    let (mut low, mut high) = (low, high);
    let mut best = middle;
    for _ in 0..40 {
        // The larger side is divided.
        let is_left = best.0 - low > high - best.0;
        let x = if is_left { best.0 - 0.38 * (best.0 - low) } else { best.0 + 0.38 * (high - best.0) };
        let y = f(x)?;
        if sign * y <= 0.0 {
            return (y.abs() > ZERO).then_some((x, y));
        }
        match (sign * y < sign * best.1, is_left) {
            (true, true) => (high, best) = (best.0, (x, y)),
            (true, false) => (low, best) = (best.0, (x, y)),
            (false, true) => low = x,
            (false, false) => high = x,
        }
        if high - low < 1e-9 {
            break;
        }
    }
    None
}

/// The place where the function becomes positive between one where it is not and one where it is: false position with
/// halved weights (the Illinois method), every third step a bisection. The place returned is on the side of `inside`.
pub(super) fn zero(inside: Point, outside: Point, f: &mut impl FnMut(f64) -> Option<f64>) -> f64 {
    let ((mut a, mut fa), (mut b, mut fb)) = (inside, outside);
    if fa >= -ZERO && fa.abs() <= ZERO && fb > 0.0 && f(a + 1e-3 * (b - a)).is_some_and(|y| y > 0.0) {
        return a;
    }
    for step in 0..90 {
        if (b - a).abs() <= NEAR {
            break;
        }
        let part = fa / (fa - fb);
        let middle = step % 3 == 2 || !(0.0..=1.0).contains(&part);
        let mut x = if middle { (a + b) / 2.0 } else { a + part * (b - a) };
        // Not nearer to an end than the precision that is asked for, so that the other end comes near too.
        let margin = NEAR / 2.0 * (b - a).signum();
        if (x - a).abs() < NEAR / 2.0 {
            x = a + margin;
        } else if (b - x).abs() < NEAR / 2.0 {
            x = b - margin;
        }
        match f(x) {
            Some(y) if y <= 0.0 => {
                (a, fa) = (x, y);
                fb *= 0.5;
            }
            Some(y) => {
                (b, fb) = (x, y);
                fa *= 0.5;
            }
            None => b = x,
        }
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(f: impl Fn(f64) -> f64, n: usize) -> Vec<Point> {
        (0..=n).map(|k| k as f64 / n as f64).map(|x| (x, f(x))).collect()
    }

    #[test]
    fn zeros_are_exact_and_narrow_parts_are_found() {
        let check = |f: fn(f64) -> f64, wanted: &[[f64; 2]]| {
            let found = intervals(&points(f, 10), |x| Some(f(x)));
            assert_eq!(found.len(), wanted.len(), "{found:?}");
            for (a, b) in found.iter().zip(wanted) {
                assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12, "{found:?}");
            }
        };
        check(|x| x * x - 0.25, &[[0.0, 0.5]]);
        check(|x| (x - 0.537).powi(2) - 1e-6, &[[0.536, 0.538]]);
        check(|x| 1e-6 - (x - 0.537).powi(2), &[[0.0, 0.536], [0.538, 1.0]]);
        check(|x| (x - 0.537).powi(2) + 1e-6, &[]);
        check(|_| -1.0, &[[0.0, 1.0]]);
    }
}
