//! English.

mod check;
mod dynamics;
mod exercise;
mod geometry;
mod inverse;
mod motion;
mod report;
mod terms;
mod velocity;

/// English.
pub struct English;

/// `1 joint`, `3 joints`
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}
