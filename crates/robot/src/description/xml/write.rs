//! Numbers and names as XML has them.

use crate::description::cell::decimal;
use crate::description::tree::{Joint, Mechanism};
use denavit_symbolic::{Expr, Rational};
use std::collections::HashSet;

/// A decimal, or the 17 digits of the nearest double.
pub(in crate::description) fn number(e: Expr) -> String {
    let short = |r: &Rational| Some(decimal(r)).filter(|t| !t.contains('/') && t.len() <= 25);
    let exact = e.as_number().as_ref().and_then(short);
    exact.unwrap_or_else(|| format!("{}", e.eval(|_| None).unwrap_or(f64::NAN) + 0.0))
}

/// The names of joints as they are written, each its own.
pub(in crate::description) fn joint_names(tree: &Mechanism) -> Vec<String> {
    let mut taken: HashSet<String> = HashSet::new();
    let one = |joint: &Joint| {
        let name = escaped(&joint.name);
        let numbered = (2..).map(|k| format!("{name}_{k}"));
        let own = std::iter::once(name.clone()).chain(numbered).find(|n| !taken.contains(n));
        let own = own.unwrap_or(name);
        taken.insert(own.clone());
        own
    };
    tree.joints.iter().map(one).collect()
}

/// A text on one line, for the value of an attribute in double quotes.
pub(in crate::description) fn escaped(text: &str) -> String {
    let plain = text.replace(|c: char| c.is_control(), " ");
    plain.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
