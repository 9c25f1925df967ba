//! Quantities as they stand in tables.

use crate::document::Line;
use crate::words::Wording;
pub use denavit::quantity::decimals;
use denavit_symbolic::{Angle, Expr, Rational};

/// A length as a formula or in metres, an angle in degrees; what is no multiple of π in radians.
pub fn cell(e: Expr, is_angle: bool, words: &dyn Wording) -> Line {
    let written = |x: f64| words.written(decimals(x, 9));
    if let (false, Some(length)) = (is_angle, e.as_number()) {
        return Line::new(written(length.to_f64()));
    }
    if !is_angle {
        return Line::default().math(e);
    }
    let mut angle = Angle::of(e);
    let degrees = &std::mem::take(&mut angle.turns) * &Rational::from(180);
    let radians = std::mem::take(&mut angle.radians);
    let symbolic = angle.to_expr();
    let mut line = if symbolic.is_zero() { Line::default() } else { Line::default().math(symbolic) };
    for (constant, unit) in [(degrees, "°"), (radians, " rad")] {
        if constant.is_zero() {
            continue;
        }
        let is_first = line.0.is_empty();
        line = line.text(match (is_first, constant.is_negative()) {
            (true, true) => "−",
            (true, false) => "",
            (false, true) => " − ",
            (false, false) => " + ",
        });
        line = line.text(format!("{}{unit}", written(constant.abs().to_f64())));
    }
    if line.0.is_empty() { Line::new("0") } else { line }
}
