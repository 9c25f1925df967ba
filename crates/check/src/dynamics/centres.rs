//! From where sentences say that the centres of mass of links are measured.

use super::described::{CENTRES, Number, Start, is_to_centre, number_behind, pieces};
use super::told::sentences;
use crate::tools::edge;
use std::collections::BTreeMap;

/// Points stand no farther behind the word that speaks of them.
const NEAR: usize = 40;
const ENDS: [&str; 32] = [
    "far end",
    "distal end",
    "outer end",
    "other end",
    "free end",
    "tip",
    "ends of the link",
    "end of the link",
    "end of each link",
    "end of link",
    "end of its link",
    "link's end",
    "link end",
    "links' ends",
    "next joint",
    "following joint",
    "distalen ende",
    "äußeren ende",
    "ende des glied",
    "spitze",
    "nächsten gelenk",
    "folgenden gelenk",
    "bout",
    "extrémité",
    "articulation suivante",
    "extremo",
    "extremidad",
    "articulación siguiente",
    "estremità",
    "giunto successivo",
    "giunto seguente",
    "extremidade",
];
const JOINT_POINTS: [&str; 19] = [
    "proximal end",
    "inner end",
    "near end",
    "joint",
    "pivot",
    "pin",
    "hinge",
    "axis of rotation",
    "rotation axis",
    "axis",
    "drehachse",
    "drehpunkt",
    "gelenk",
    "achse",
    "articulation",
    "articulación",
    "articulação",
    "giunto",
    "axe",
];
pub(super) const FROM: [&str; 15] = [
    "from ",
    "between ",
    "to ",
    "vom ",
    "von ",
    "zum ",
    "zwischen ",
    "depuis ",
    "entre ",
    "jusqu",
    "de l",
    "desde ",
    "dal",
    "fra ",
    "tra ",
];
const DISTANCES: [&str; 8] =
    ["distance", "distanc", "distanz", "abstand", "entfern", "measured", "gemessen", "located"];
/// The first point that a piece of text names: the centre of mass is none.
fn first_point(piece: &str, own: &[(String, Option<usize>)]) -> Option<Start> {
    // `about` is no end of anything.
    let find = |name: &str| {
        piece.match_indices(name).map(|m| m.0).find(|at| !piece[..*at].ends_with(char::is_alphabetic))
    };
    let first = |names: &[&str]| names.iter().filter_map(|n| Some((find(n)?, n.len()))).min();
    let (centre, end, joint) = (first(&CENTRES), first(&ENDS), first(&JOINT_POINTS));
    let before = |a: Option<(usize, usize)>, b: Option<(usize, usize)>| match (a, b) {
        (Some(a), Some(b)) => a.0 <= b.0,
        (a, _) => a.is_some(),
    };
    if before(centre, end) && before(centre, joint) {
        return None;
    }
    let of = match own {
        [(_, Some(of))] => Some(*of),
        _ => None,
    };
    if before(end, joint) {
        let (at, length) = end?;
        // The end of the link before is at the joint.
        return match (number_behind(&piece[at + length..]), of) {
            (Some(Number::Is(k)), Some(of)) if k + 1 == of => Some(Start::Joint),
            (Some(Number::Is(k)), Some(of)) if k != of => None,
            _ => Some(Start::End),
        };
    }
    let (at, length) = joint?;
    match (number_behind(piece[at + length..].trim_start_matches('s')), of) {
        (Some(Number::Letter(true)), _) => Some(Start::End),
        (Some(Number::Is(k)), Some(of)) if k == of + 1 => Some(Start::End),
        (Some(Number::Is(k)), Some(of)) if k != of => None,
        _ => Some(Start::Joint),
    }
}

/// From where centres of mass are measured, of names that are said to be of `links`.
pub(super) fn from(lower: &str, links: &BTreeMap<String, usize>) -> BTreeMap<Option<usize>, Option<Start>> {
    let mut found: BTreeMap<Option<usize>, Option<Start>> = BTreeMap::new();
    let marks: Vec<&'static str> = CENTRES.to_vec();
    for sentence in sentences(lower, &marks).chain(sentences(lower, &["l_c", "l_{c", "lc", "r_{c", "a_{c"])) {
        // Each name begins a piece, names side by side the same.
        for (mut names, piece) in pieces(sentence, &is_to_centre) {
            for (name, link) in &mut names {
                *link = links.get(name).copied().or(*link);
            }
            let is_distance = DISTANCES.iter().any(|w| sentence.contains(w));
            let mut here: Option<Start> = None;
            let mut is_open = false;
            for word in FROM {
                if matches!(word, "to " | "between " | "entre " | "zum " | "zwischen ") && !is_distance {
                    continue;
                }
                for (at, _) in piece.match_indices(word) {
                    // `into `
                    if piece[..at].ends_with(char::is_alphanumeric) {
                        continue;
                    }
                    let behind = &piece[at + word.len()..];
                    let near = &behind[..edge(behind, NEAR.min(behind.len()))];
                    // Between the centre and another point.
                    let other = match matches!(word, "between " | "entre " | "zwischen " | "fra " | "tra ") {
                        true => CENTRES.iter().fold(near.to_string(), |text, c| text.replace(c, "")),
                        false => near.to_string(),
                    };
                    match (first_point(&other, &names), here) {
                        (None, _) => {}
                        (Some(point), Some(known)) if point != known => is_open = true,
                        (point, _) => here = point,
                    }
                }
            }
            let Some(point) = here else { continue };
            let of: Vec<Option<usize>> = match names.is_empty() {
                true => vec![None],
                false => names.iter().map(|n| n.1).collect(),
            };
            for link in of {
                let known = found.entry(link).or_insert(Some(point));
                if is_open || *known != Some(point) {
                    *known = None;
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::described::{Start, described};

    #[test]
    fn centres_are_measured_from_where_it_is_said() {
        use Start::{End, Joint};
        for (text, first, second) in [
            (
                "$l_{c1}$, $l_{c2}$ are the distances of the centres of mass from the joints.",
                Some(Joint),
                Some(Joint),
            ),
            (
                "$l_{c1}$ is the distance of the centre of mass of link 1 from its far end (joint 2), $l_{c2}$ that of link 2 from the tip.",
                Some(End),
                Some(End),
            ),
            (
                "The lengths $l_{ci}$ are measured from the distal end of each link to its centre of mass.",
                Some(End),
                Some(End),
            ),
            ("l_{ci}: distance from joint i to the centre of mass of link i", Some(Joint), Some(Joint)),
            ("l_{ci}: distance from joint $i+1$ to the centre of mass of link i", Some(End), Some(End)),
            (
                "$l_{c1}$ is the distance from joint 1 to the centre of mass, $l_{c2}$ from the tip to it",
                Some(Joint),
                Some(End),
            ),
            ("$l_{c1}$: distance between the centre of mass and joint 2", Some(End), None),
            (
                "The centre of mass of each link is at the distance $l_{ci}$ from its joint.",
                Some(Joint),
                Some(Joint),
            ),
            ("$l_{c1}$ Abstand des Schwerpunkts vom Gelenk 1", Some(Joint), None),
            (
                "the distance between joint 1 and the mass centre of link 1 is $l_{c1}$, between the tip and that of link 2 $l_{c2}$",
                Some(Joint),
                Some(End),
            ),
            ("the centre of mass is in the middle", None, None),
        ] {
            let found = described(&text.to_lowercase());
            assert_eq!((found.from(0), found.from(1)), (first, second), "{text}");
        }
    }
}
