//! What the name of a function says of what it gives back.

use denavit_reading::code::Reading;

/// The coordinate of the hand that a function is called after: `fk_x`, `get_y`, `px`.
pub(super) fn axis_of(name: &str) -> Option<usize> {
    let lower = name.to_lowercase();
    let (rest, last) = lower.split_at(lower.len() - lower.chars().next_back()?.len_utf8());
    let axis = ["x", "y", "z"].iter().position(|a| *a == last)?;
    let of_hand =
        ["fk", "get", "p", "pos", "forward", "fwd", "tcp", "ee", "hand", "tip", "end", "calc", "compute", ""];
    let words: Vec<&str> = rest.split('_').filter(|w| !w.is_empty()).collect();
    words.iter().all(|w| of_hand.contains(w)).then_some(axis)
}

/// True for a function whose name says that it is about a part of the arm, not about the hand.
pub(super) fn is_of_part(function: &Reading) -> bool {
    const PARTS: [&str; 18] = [
        "wrist",
        "elbow",
        "shoulder",
        "knee",
        "ankle",
        "hip",
        "axis",
        "axes",
        "center",
        "centre",
        "poignet",
        "coude",
        "epaule",
        "handgelenk",
        "ellbogen",
        "schulter",
        "muneca",
        "codo",
    ];
    let name = function.name.to_lowercase();
    PARTS.iter().any(|part| name.contains(part))
}
