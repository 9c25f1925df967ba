//! Angles in files that know decimals only: the multiple of π/12 that was meant by its digits.
//!
//! In a robot file a person can write `90 deg`; in a URDF nobody can, and files hold 1.5708, 1.57079 (cut off), 1.57079632679
//! and doubles. A decimal with `k` places is read as a multiple where it is one up to its last place; the fewer places, the
//! fewer multiples, so that an ordinary decimal is taken for one in 2·10⁻ᵏ·12/π of all cases at most. It is never done silently.

use denavit_symbolic::Rational;
use std::f64::consts::PI;

/// How decimals of angles are read.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Decimals {
    /// As the multiple of π/12 that their digits print, where they do.
    #[default]
    Meant,
    /// As they are.
    AsWritten,
}

/// What an angle was found to be.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Meant {
    /// The multiple of π/12.
    pub twelfths: i64,
    /// How far the decimal is off, radians.
    pub off: f64,
    /// True if it has so few digits that something else may have been meant.
    pub is_doubtful: bool,
}

impl Meant {
    /// How far the decimal is off, in words: `off by 3.3e-6 rad`.
    pub fn distance(&self) -> String {
        distance(self.off, " rad")
    }
}

/// How far a decimal is off what it is read as; one that is the nearest double of it says so.
pub(super) fn distance(off: f64, unit: &str) -> String {
    if off == 0.0 { "to the last digit of a double".into() } else { format!("off by {off:.1e}{unit}") }
}

/// An angle that is a multiple of π/12, or not, or nearly.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Found {
    Multiple(Meant),
    /// Off by less than 1e-3 of a multiple other than 0, or by less than 1e-4 of 0.
    Nearly(Meant),
    Plain,
}

/// The number of places behind the point, exponent included; the text is a decimal.
pub(super) fn places(text: &str) -> i64 {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let behind = mantissa.split_once('.').map_or(0, |(_, behind)| behind.len() as i64);
    behind - exponent.parse::<i64>().unwrap_or(0)
}

/// What is meant by an angle of radians that is printed with so many places.
pub(super) fn recognise(x: &Rational, places: i64) -> Found {
    let twelfth = PI / 12.0;
    let (number, zero) = (x.to_f64(), Rational::ZERO);
    let m = (number / twelfth).round();
    if *x == zero || m.abs() > 48.0 {
        return Found::Plain;
    }
    let twelfths = m as i64;
    let multiple = m * PI / 12.0;
    let off = (number - multiple).abs();
    let found = |is_doubtful| Found::Multiple(Meant { twelfths, off, is_doubtful });
    let nearly = |least: f64| match off < least {
        true => Found::Nearly(Meant { twelfths, off, is_doubtful: true }),
        false => Found::Plain,
    };
    if twelfths == 0 {
        return if off <= 1e-14 { found(false) } else { nearly(1e-4) };
    }
    if off <= 4e-15 * m.abs() / 12.0 {
        return found(false);
    }
    let unit = 10_f64.powi(-places.clamp(-400, 400) as i32);
    if places >= 7 && (f64::from(multiple as f32) - number).abs() <= unit.max(1e-15) {
        return found(false);
    }
    let is_printed = off <= unit * (1.0 + 1e-7);
    match places {
        4.. if is_printed => found(false),
        3 if is_printed && (twelfths % 2 == 0 || twelfths % 3 == 0) => found(true),
        2 if is_printed && twelfths % 6 == 0 => found(true),
        _ => nearly(1e-3),
    }
}

/// `3π/4`
pub(super) fn name(twelfths: i64) -> String {
    super::cell::multiple_name(&Rational::new(twelfths, 12))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The multiple of π/12 that a text means; nothing for one that stays as it is.
    fn meant(text: &str) -> Option<i64> {
        match recognise(&Rational::from_decimal(text).unwrap(), places(text)) {
            Found::Multiple(m) => Some(m.twelfths),
            _ => None,
        }
    }

    /// Files have these; both sides of each bound.
    #[test]
    fn decimals_mean_multiples_by_their_digits() {
        for (text, multiple) in [
            // doubles, off by a few units of the last place, and noise of products
            ("1.5707963267948966", Some(6)),
            ("1.5707963267948961", Some(6)),
            ("-1.5707963267948968", Some(-6)),
            ("1.570796326794893", None),
            ("6.12323e-17", Some(0)),
            ("-1.11e-16", Some(0)),
            ("1e-14", Some(0)),
            ("1.1e-14", None),
            // single precision
            ("-0.5235988", Some(-2)),
            ("1.5707964", Some(6)),
            ("1.57079637050628662109375", Some(6)),
            // rounded or cut off, four places and more
            ("1.5708", Some(6)),
            ("1.5707", Some(6)),
            ("1.5706", None),
            ("3.1415", Some(12)),
            ("3.1416", Some(12)),
            ("3.1418", None),
            ("1.57079", Some(6)),
            ("1.57075", None),
            ("1.570796", Some(6)),
            ("1.570795", None),
            ("1.57079632679", Some(6)),
            ("1.5707963259", None),
            ("1.57079632679489", Some(6)),
            ("0.2618", Some(1)),
            ("15707.963e-4", Some(6)),
            ("-7.8540", Some(-30)),
            // three places: multiples of 30 and 45 degrees
            ("1.571", Some(6)),
            ("0.785", Some(3)),
            ("0.524", Some(2)),
            ("1.309", None),
            // two places: right angles
            ("1.57", Some(6)),
            ("3.14", Some(12)),
            ("-1.57", Some(-6)),
            ("0.26", None),
            ("0.79", None),
            // one and none
            ("1.6", None),
            ("0.5", None),
            ("3", None),
            ("0", None),
            ("7.45e-09", None),
            // more than two turns
            ("12.5664", Some(48)),
            ("13.8230", None),
        ] {
            assert_eq!(meant(text), multiple, "{text}");
        }
    }

    #[test]
    fn what_is_nearly_a_multiple_is_known() {
        for (text, is_near) in
            [("1.57075", true), ("1.5706", true), ("0.5", false), ("5e-5", true), ("2e-4", false)]
        {
            let found = recognise(&Rational::from_decimal(text).unwrap(), places(text));
            assert_eq!(matches!(found, Found::Nearly(_)), is_near, "{text}");
        }
    }
}
