//! Numbers and names as XML has them.

use crate::description::cell::decimal;
use denavit_symbolic::{Expr, Rational};

/// A decimal, or the 17 digits of the nearest double.
pub(in crate::description) fn number(e: Expr) -> String {
    let short = |r: &Rational| Some(decimal(r)).filter(|t| !t.contains('/') && t.len() <= 25);
    let exact = e.as_number().as_ref().and_then(short);
    exact.unwrap_or_else(|| format!("{}", e.eval(|_| None).unwrap_or(f64::NAN) + 0.0))
}

/// A text on one line, for the value of an attribute in double quotes.
pub(in crate::description) fn escaped(text: &str) -> String {
    let plain = text.replace(|c: char| c.is_control(), " ");
    plain.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
