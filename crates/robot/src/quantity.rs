//! Numbers as a person reads them.

use crate::description::JointKind;

/// A number with at most so many digits behind the point, none of them a zero at the end.
pub fn decimals(x: f64, digits: usize) -> String {
    if x.abs() >= 1e9 {
        return format!("{x:e}").replace('-', "−");
    }
    let text = format!("{x:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.replace('-', "−") }
}

/// A value of a joint (rad or m) with its unit, degrees where it turns.
pub fn reading(x: f64, kind: JointKind) -> String {
    match kind {
        JointKind::Revolute => format!("{}°", decimals(x.to_degrees(), 4)),
        JointKind::Prismatic => format!("{} m", decimals(x, 6)),
    }
}

/// A velocity of a joint (rad/s or m/s) with its unit, degrees a second where it turns.
pub fn rate(x: f64, kind: JointKind) -> String {
    match kind {
        JointKind::Revolute => format!("{}°/s", decimals(x.to_degrees(), 4)),
        JointKind::Prismatic => format!("{} m/s", decimals(x, 6)),
    }
}

/// The unit of what drives a joint.
pub fn torque_unit(kind: JointKind) -> &'static str {
    if kind == JointKind::Revolute { "N m" } else { "N" }
}
