//! Multiples of π/12 behind decimals.

use denavit_symbolic::Rational;
use std::f64::consts::PI;

/// What a number of radians is.
pub(super) enum Angle {
    /// This multiple of π: the decimal is its nearest double.
    Exactly(Rational),
    /// Not quite this multiple of π; how far from it.
    Nearly(Rational, f64),
    /// Nothing special.
    Plain,
}

/// How near a multiple of π/12 is "nearly": a multiple given with three digits is meant.
const NEAR: f64 = 1e-3;
/// Below this an angle is nearly 0.
const NEAR_ZERO: f64 = 1e-4;

/// Looks for a multiple of π/12. `digits`: how many significant digits the decimal shows.
pub(super) fn recognise(radians: &Rational, digits: usize) -> Angle {
    let x = radians.to_f64();
    if radians.is_zero() || x.abs() > 100.0 {
        return Angle::Plain;
    }
    let twelfths = (x / (PI / 12.0)).round();
    let multiple = Rational::new(twelfths as i64, 12);
    let (n, d) = multiple.to_parts().unwrap_or((0, 1));
    let nearest = n as f64 * PI / d as f64;
    let off = (x - nearest).abs();
    if twelfths == 0.0 {
        return if off < NEAR_ZERO { Angle::Nearly(multiple, off) } else { Angle::Plain };
    }
    // One product and one quotient round: three spacings of doubles at most. 16 digits pin a double down to two.
    let exact = x == nearest || digits >= 16 && off <= 5e-16 * nearest.abs();
    match off {
        _ if exact => Angle::Exactly(multiple),
        off if off < NEAR => Angle::Nearly(multiple, off),
        _ => Angle::Plain,
    }
}

/// `3π/4`
pub(in crate::description) fn name(multiple: &Rational) -> String {
    let (n, d) = multiple.to_parts().unwrap_or((0, 1));
    let top = match n {
        0 => return "0".into(),
        1 => "π".to_string(),
        -1 => "−π".to_string(),
        n => format!("{n}π"),
    };
    if d == 1 { top } else { format!("{top}/{d}") }
}
