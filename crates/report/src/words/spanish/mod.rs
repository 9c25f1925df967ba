//! Spanish, with the terms of courses in robotics.

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

/// Spanish.
pub struct Spanish;

/// `1 articulación`, `3 articulaciones`
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// With *de*, which joins the article: `del sistema 3 en el sistema 2`.
fn genitive(noun: &str) -> String {
    match noun.strip_prefix("el ") {
        Some(rest) => format!("del {rest}"),
        None => format!("de {noun}"),
    }
}
