//! Tables in programs in which nothing moves: `[0.0, d1, 0.0, pi/2]` beside `d1 = 0.15`, to whose θ the joints are added.

use std::collections::BTreeSet;

/// Longer lines give nothing.
const LONGEST: usize = 400;

/// The rows of a table in a program in which nothing moves, as it gives a number to each name in them, with the joints to whose θ these
/// are added. Nothing where a row moves, or the words speak of joints that slide.
pub(super) fn turned(rows: &[[String; 4]], text: &str) -> Option<Vec<[String; 4]>> {
    const SLIDES: [&str; 7] =
        ["prismatic", "slid", "linear axis", "linear joint", "telescop", "sigma", "schub"];
    let lower = text.to_lowercase();
    if SLIDES.iter().any(|w| lower.contains(w)) {
        return None;
    }
    let given = numbers_in_code(text);
    let is_still = |cell: &String| {
        let mut names = cell
            .split(|c: char| !(c.is_alphanumeric() || c == '_'))
            .filter(|w| w.starts_with(|c: char| c.is_alphabetic() || c == '_'));
        names.all(|w| {
            matches!(w, "pi" | "np" | "math" | "numpy" | "deg" | "radians" | "deg2rad") || given.contains(w)
        })
    };
    // A θ with a name in it may be the joint's own value.
    let is_told = |row: &[String; 4]| {
        let names = row[0].split(|c: char| !(c.is_alphanumeric() || c == '_'));
        names.into_iter().any(|w| given.contains(w))
    };
    if rows.iter().any(is_told) {
        return None;
    }
    let has_name = |row: &[String; 4]| row[1].contains(|c: char| c.is_alphabetic());
    if !rows.iter().flatten().all(is_still) || !rows.iter().any(has_name) {
        return None;
    }
    let turned = |(k, mut row): (usize, [String; 4])| {
        let is_zero = row[0].trim().parse::<f64>() == Ok(0.0);
        row[0] = if is_zero { format!("q{}", k + 1) } else { format!("q{} + {}", k + 1, row[0].trim()) };
        row
    };
    Some(rows.iter().cloned().enumerate().map(turned).collect())
}

/// The names to which lines of a program give numbers: `d1 = 0.15`, `a2, a3 = 0.4, 0.35`.
fn numbers_in_code(text: &str) -> BTreeSet<&str> {
    let mut found = BTreeSet::new();
    let lines = text.lines().filter(|l| l.len() < LONGEST);
    for part in lines.flat_map(|l| l.split(['#', '%']).next().unwrap_or_default().split(';')) {
        let Some((names, values)) = part.split_once('=') else { continue };
        let names: Vec<&str> = names.split(',').map(str::trim).collect();
        let values: Vec<&str> = values.split(',').map(str::trim).collect();
        let is_name = |n: &&str| {
            n.starts_with(char::is_alphabetic) && n.chars().all(|c| c.is_alphanumeric() || c == '_')
        };
        let is_number = |v: &&str| v.parse::<f64>().is_ok();
        if names.len() == values.len() && names.iter().all(is_name) && values.iter().all(is_number) {
            found.extend(names);
        }
    }
    found
}
