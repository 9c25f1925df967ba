//! The real roots of a polynomial whose coefficients lie between bounds, counted for sure.
//!
//! Where a derivative has one sign on an interval and the polynomial another sign at each end, there is one root and no other.

use crate::interval::Interval;

/// The narrowest interval that is divided.
const NARROWEST: f64 = 1e-11;
/// How many intervals are looked at.
const MOST: usize = 20_000;

/// Intervals with one root each, and those of which it is not known.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Roots {
    /// Each holds one root.
    pub isolated: Vec<Interval>,
    /// All other roots lie in these.
    pub doubtful: Vec<Interval>,
}

/// Horner's rule.
pub fn value(coefficients: &[Interval], x: Interval) -> Interval {
    coefficients.iter().rev().fold(Interval::ZERO, |sum, &c| sum * x + c)
}

/// The derivative.
fn derivative(coefficients: &[Interval]) -> Vec<Interval> {
    coefficients.iter().enumerate().skip(1).map(|(k, &c)| Interval::point(k as f64) * c).collect()
}

/// The roots between two numbers of the polynomial with these coefficients, the constant first.
pub fn isolate(coefficients: &[Interval], from: f64, to: f64) -> Roots {
    let slope = derivative(coefficients);
    let sign = |x: f64| {
        let y = value(coefficients, Interval::point(x));
        if y.holds_zero() {
            0
        } else if y.lo > 0.0 {
            1
        } else {
            -1
        }
    };
    let mut roots = Roots::default();
    let mut open = vec![Interval { lo: from, hi: to }];
    let mut seen = 0;
    while let Some(x) = open.pop() {
        seen += 1;
        if !value(coefficients, x).holds_zero() {
            continue;
        }
        if !value(&slope, x).holds_zero() {
            match sign(x.lo) * sign(x.hi) {
                1 => continue,
                -1 => {
                    roots.isolated.push(narrowed(coefficients, x));
                    continue;
                }
                _ => {}
            }
        }
        if x.hi - x.lo < NARROWEST || seen > MOST {
            roots.doubtful.push(x);
            continue;
        }
        // Not in the middle, where roots of round numbers lie.
        let at = x.lo + 0.487_31 * (x.hi - x.lo);
        open.extend([Interval { lo: at, hi: x.hi }, Interval { lo: x.lo, hi: at }]);
    }
    roots
}

/// The same root in an interval as narrow as signs are certain.
fn narrowed(coefficients: &[Interval], mut x: Interval) -> Interval {
    let rises = value(coefficients, Interval::point(x.hi)).lo > 0.0;
    for _ in 0..80 {
        let at = 0.5 * (x.lo + x.hi);
        let y = value(coefficients, Interval::point(at));
        if y.holds_zero() || at <= x.lo || at >= x.hi {
            break;
        }
        if (y.lo > 0.0) == rises { x.hi = at } else { x.lo = at }
    }
    x
}
