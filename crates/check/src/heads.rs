//! What the columns of a table of configurations hold, by their heads.

use super::subject::Subject;
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Angle, Expr};

/// What a column holds.
pub(super) enum Column {
    /// A joint, with the unit of its head.
    Joint(usize, Option<f64>),
    /// A quantity of the pose, with the unit of its head; angles are the same a turn further.
    Pose(Expr, Option<f64>, bool),
    /// The number of the row, or words.
    Number,
    Other,
}

/// A head: a joint, or an entry of the pose, with its unit.
pub(super) fn column(head: &str, subject: &Subject, names: &Vocabulary, places_first: bool) -> Column {
    let found = column_of(head, subject, names, places_first);
    // `x berechnet`, `y measured`.
    match head.split_once(' ').filter(|_| matches!(found, Column::Other)) {
        Some((name, rest)) if rest.chars().all(|c| c.is_alphabetic() || c == ' ') => {
            column_of(name, subject, names, places_first)
        }
        _ => found,
    }
}

/// A head without further words.
fn column_of(head: &str, subject: &Subject, names: &Vocabulary, places_first: bool) -> Column {
    let plain = plain_name(&head.replace(['$', '*'], "").replace("^\\circ", "°").replace("\\circ", "°"));
    let cut = plain.find(['(', '[', '/', ',']).unwrap_or(plain.len());
    let (name, unit) = plain.split_at(cut);
    let name = name.trim_end_matches('°').replace("mathrm", "");
    let unit = match unit.trim_matches(['(', ')', '[', ']', '/', ',', ' ']) {
        "deg" | "°" | "degree" | "degrees" | "Grad" | "grad" => Some(1_f64.to_radians()),
        "rad" | "m" => Some(1.0),
        "mm" => Some(0.001),
        "cm" => Some(0.01),
        _ if plain[..cut].ends_with('°') => Some(1_f64.to_radians()),
        _ => None,
    };
    let found = names.lookup(&name).or_else(|| names.lookup(&super::custom::plain(&name)));
    let joint = found.and_then(|e| subject.joints().iter().position(|q| *q == e));
    let axis = |c: &str| ["x", "y", "z"].iter().position(|a| *a == c.to_lowercase());
    let place = name.strip_prefix('p').or(name.strip_prefix('P')).and_then(axis).or_else(|| axis(&name));
    match (joint, place) {
        (Some(joint), None) => Column::Joint(joint, unit),
        (Some(joint), Some(_)) if !places_first => Column::Joint(joint, unit),
        (_, Some(r)) => Column::Pose(subject.pose().translation.0[r], unit, false),
        // What the document gives a formula, or what the pose is known by.
        (None, None) => match found.filter(|e| depends(*e, subject)) {
            Some(e) => {
                let is_angle = Angle::of(e).terms.iter().all(|t| subject.joints().contains(&t.0));
                Column::Pose(e, unit, is_angle)
            }
            None if is_number_of_row(&name) => Column::Number,
            None => Column::Other,
        },
    }
}

/// True if a joint occurs.
fn depends(e: Expr, subject: &Subject) -> bool {
    e.symbols().iter().any(|s| subject.joints().contains(&(*s).into()))
}

/// True for the head of a column that counts rows.
fn is_number_of_row(head: &str) -> bool {
    const HEADS: [&str; 16] = [
        "", "i", "j", "k", "n", "#", "no", "no.", "nr", "nr.", "case", "pose", "row", "solution", "sol",
        "test",
    ];
    HEADS.contains(&head.to_lowercase().as_str())
}
