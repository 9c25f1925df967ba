//! German, with the terms of courses in robotics.

mod check;
mod dynamics;
mod exercise;
mod geometry;
mod inverse;
mod motion;
mod read_with;
mod report;
mod terms;
mod velocity;

/// German.
pub struct German;

/// `1 Gelenk`, `3 Gelenke`
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}
