//! How the joints of a table are counted by their names.

use denavit::description::{JointKind, Variable};

/// The numbers of the joints where the table's names count otherwise than its rows: q0, q1, …, or θ4, θ5, θ6 of a wrist; θ1, θ2 beside
/// a slide without a number.
pub(super) fn numbers(names: &[Option<String>], variables: &[Variable]) -> Option<Vec<Option<usize>>> {
    let number = |name: &str| -> Option<usize> {
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        name[stem.len()..].parse().ok().filter(|n| !stem.is_empty() && *n < 10)
    };
    if names.len() < 2 {
        return None;
    }
    let all: Vec<Option<usize>> = names.iter().map(|v| v.as_deref().and_then(number)).collect();
    let first = all.first().copied().flatten().filter(|n| *n != 1);
    if first.is_some_and(|f| (f..).zip(&all).all(|(k, n)| *n == Some(k))) {
        return Some(all);
    }
    let turns = || variables.iter().zip(&all).filter(|(v, _)| v.kind == JointKind::Revolute).map(|(_, n)| *n);
    let is_own = all.iter().enumerate().all(|(k, n)| n.is_none_or(|n| n == k + 1));
    let is_counted = turns().count() > 1 && (1..).zip(turns()).all(|(k, n)| n == Some(k));
    (is_counted && !is_own).then_some(all)
}
