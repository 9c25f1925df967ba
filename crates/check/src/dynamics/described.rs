//! What sentences say of the links as bodies: whether they are points or rods, from where the centres of mass are measured, of which link
//! a name is, and whether they have inertias.

use super::centres::{FROM, from};
use super::told::sentences;
use super::words::{Role, role, words};
use crate::tools::edge;
use std::collections::BTreeMap;

/// What the mass of a link looks like.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Shape {
    /// All of it is in one point.
    Point,
    /// A thin rod, its centre of mass in the middle.
    Rod,
}

/// Where the centres of mass are said to be.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum At {
    End,
    Middle,
}

/// From where the centre of mass of a link is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Start {
    Joint,
    End,
}

/// What the words of a document say of its links.
#[derive(Clone, Default, PartialEq, Eq, Debug)]
pub(super) struct Described {
    pub shape: Option<Shape>,
    /// Where the masses are.
    pub place: Option<At>,
    /// From where centres of mass are measured; of all links where there is no number.
    pub from: BTreeMap<Option<usize>, Option<Start>>,
    /// The names of centres and inertias that are said to be of another link than their number says.
    pub links: BTreeMap<String, usize>,
    /// The inertias that are said to be there, as they are called, and their links.
    pub inertias: BTreeMap<String, Option<usize>>,
}

/// Arms have no more joints here than an index has digits.
const JOINTS: usize = 9;

/// What centres of mass are called.
pub(super) const CENTRES: [&str; 19] = [
    "centre of mass",
    "center of mass",
    "centres of mass",
    "centers of mass",
    "centre of gravity",
    "center of gravity",
    "centroid",
    "mass center",
    "mass centre",
    "schwerpunkt",
    "massenmittelpunkt",
    "centre de masse",
    "centres de masse",
    "centros de mas",
    "centri di massa",
    "centre de gravité",
    "centro de mas",
    "centro di massa",
    "baricent",
];

impl Described {
    /// From where the centre of mass of a link is measured, where that is said.
    pub fn from(&self, link: usize) -> Option<Start> {
        self.from.get(&Some(link)).or_else(|| self.from.get(&None)).copied().flatten()
    }

    /// Whether it is said of any link.
    pub fn has_from(&self) -> bool {
        self.from.values().any(Option::is_some)
    }
}

/// What a text in small letters says.
pub(super) fn described(lower: &str) -> Described {
    let inertias = inertias(lower);
    let (shape, place) = shape(lower, !inertias.is_empty() || speaks_of_inertia(lower));
    let links = links(lower);
    let from = from(lower, &links);
    Described { shape, place: place.or_else(|| middle(lower)), from, links, inertias }
}

/// Words with which inertias are no numbers of links, or none.
const OTHERWISE: [&str; 16] = [
    "inertia matri",
    "inertial",
    "generalized inertia",
    "generalised inertia",
    "mass matri",
    "trägheitsmatri",
    "matrice d'inertie",
    "matriz de inercia",
    "matriz de inércia",
    "matrice di inerzia",
    "matrice d'inerzia",
    "no inertia",
    "moment of inertia is neglected",
    "inertia term",
    "inertia forc",
    "trägheitskr",
];
/// What inertias are called.
pub(super) const INERTIA: [&str; 6] = ["inerti", "inerzi", "inerci", "inérci", "trägheit", "traegheit"];

/// Whether words speak of inertias of bodies, even to leave them out.
fn speaks_of_inertia(lower: &str) -> bool {
    let plain = OTHERWISE.iter().fold(lower.to_string(), |text, word| text.replace(word, ""));
    INERTIA.iter().any(|word| plain.contains(word))
}

/// Whether the centres of mass are said to be in the middle.
fn middle(lower: &str) -> Option<At> {
    const MIDDLE: [&str; 12] = [
        "in the middle",
        "at the middle",
        "midpoint",
        "halfway",
        "geometric cent",
        "in der mitte",
        "au milieu",
        "en el medio",
        "punto medio",
        "nel mezzo",
        "punto di mezzo",
        "no meio",
    ];
    let says = |s: &str| MIDDLE.iter().any(|w| s.contains(w)) && !s.contains("not ");
    sentences(lower, &CENTRES).any(says).then_some(At::Middle)
}

/// Whether the links are points or rods, and where they are.
fn shape(lower: &str, has_inertia: bool) -> (Option<Shape>, Option<At>) {
    const POINTS: [&str; 26] = [
        "point mass",
        "point-mass",
        "pointmass",
        "punktmasse",
        "massepunkt",
        "massenpunkt",
        "masses ponctuelles",
        "masse ponctuelle",
        "masas puntual",
        "masa puntual",
        "masse puntiform",
        "massa puntiform",
        "massas pontua",
        "massa pontual",
        "lumped mass",
        "concentrated mass",
        "is concentrated",
        "are concentrated",
        "mass is concentrated",
        "masses are concentrated",
        "mass concentrated",
        "masses concentrated",
        "masses concentrées",
        "masse concentrée",
        "masas concentradas",
        "massas concentradas",
    ];
    const RODS: [&str; 18] = [
        "uniform rod",
        "uniform thin rod",
        "thin uniform rod",
        "uniform slender rod",
        "slender uniform rod",
        "slender rod",
        "thin rod",
        "homogeneous rod",
        "uniform bar",
        "slender bar",
        "homogene stäbe",
        "homogener stab",
        "dünne stäbe",
        "dünner stab",
        "tiges homogènes",
        "barras homogéneas",
        "aste omogenee",
        "barras homogêneas",
    ];
    // What the hand carries, and motors, are other points.
    const OTHER: [&str; 20] = [
        "load", "carr", "gripper", "tool", "effector", "motor", "rotor", "last ", "nutzlast", "greifer",
        "charge", "pince", "carga", "pinza", "carico", "not ", "no ", "instead", "keine", "nicht",
    ];
    let says = |names: &[&'static str]| -> Vec<String> {
        let found = sentences(lower, names).filter(|s| !OTHER.iter().any(|w| s.contains(w)));
        found.map(str::to_string).collect()
    };
    let (points, rods) = (says(&POINTS), says(&RODS));
    let is_end = |s: &String| {
        const AT: [&str; 13] = [
            "at the end",
            "at the link end",
            "at the links' end",
            "at the tip",
            "at the distal end",
            "at the far end",
            "am ende",
            "an den enden",
            "aux extrémités",
            "à l'extrémité",
            "au bout",
            "en los extremos",
            "nas extremidades",
        ];
        AT.iter().any(|at| s.contains(at))
    };
    match (&points[..], &rods[..]) {
        ([_, ..], []) if !has_inertia => (Some(Shape::Point), points.iter().all(is_end).then_some(At::End)),
        ([], [_, ..]) => (Some(Shape::Rod), Some(At::Middle)),
        _ => (None, None),
    }
}

/// The number behind a word for a joint or a link, `2` and `i+1`: a digit, or how far it is from the letter.
pub(super) enum Number {
    Is(usize),
    /// `i`, or one more.
    Letter(bool),
}

pub(super) fn number_behind(text: &str) -> Option<Number> {
    let text = text.trim_start_matches([' ', '$', '(', '{', '\\', '_', '~']);
    let mut chars = text.chars();
    let first = chars.next()?;
    let rest = chars.as_str();
    let behind = rest.trim_start_matches([' ', '$']);
    match first {
        '1'..='9' => Some(Number::Is(first as usize - '1' as usize)),
        'i' | 'j' | 'k' if rest.starts_with(char::is_alphanumeric) => None,
        'i' | 'j' | 'k' => Some(Number::Letter(behind.trim_start_matches('+').trim_start().starts_with('1'))),
        _ => None,
    }
}

/// Names with the links that their numbers say, none where they are of all.
pub(super) type Links = Vec<(String, Option<usize>)>;

/// The names of centres or inertias in a piece of text, with their links: none of `l_{ci}`.
fn names_in(piece: &str, is_wanted: &dyn Fn(Role, &str) -> bool) -> Links {
    let mut found = vec![];
    for word in words(piece) {
        let general = word.strip_suffix(['i', 'j', 'k']).filter(|w| !w.is_empty());
        let (of, is_general) = match (role(&word, JOINTS), general) {
            (Some(r), _) => (Some(r), false),
            (None, Some(general)) => (role(&format!("{general}1"), JOINTS), true),
            (None, None) => (None, false),
        };
        let Some(of) = of.filter(|r| is_wanted(*r, &word)) else { continue };
        match of {
            Role::Length(Some(k)) | Role::Inertia(Some(k)) | Role::About(k, _) => {
                found.push((word, (!is_general).then_some(k)));
            }
            _ => {}
        }
    }
    found
}

/// True for a length to a centre by its mark, `l_{c1}`.
pub(super) fn is_to_centre(of: Role, word: &str) -> bool {
    matches!(of, Role::Length(_)) && word.chars().skip(1).any(|c| matches!(c, 'c' | 'g' | 'm' | 's'))
}

fn is_inertia(of: Role, _: &str) -> bool {
    matches!(of, Role::Inertia(_) | Role::About(..))
}

/// A sentence in pieces, each with the names that stand at its beginning: a sentence without names is one piece.
pub(super) fn pieces<'s>(sentence: &'s str, is_wanted: &dyn Fn(Role, &str) -> bool) -> Vec<(Links, &'s str)> {
    // Names stand between signs of formulas, or are words.
    let is_in = |c: char| c.is_alphanumeric() || matches!(c, '_' | '{' | '}' | '\\');
    let mut starts: Vec<(usize, usize)> = vec![];
    let mut at = 0;
    while let Some(c) = sentence[at..].chars().next() {
        if !is_in(c) {
            at += c.len_utf8();
            continue;
        }
        let length: usize = sentence[at..].chars().take_while(|c| is_in(*c)).map(char::len_utf8).sum();
        let word = &sentence[at..at + length];
        let is_name = word.contains(['_', '{']) || word.ends_with(|c: char| c.is_ascii_digit());
        if is_name && !names_in(word, is_wanted).is_empty() {
            starts.push((at, at + length));
        }
        at += length;
    }
    let Some(&(first, _)) = starts.first() else { return vec![(vec![], sentence)] };
    // `the distance from joint 1 to the centre is l_{c1}`: what stands before a name is its own.
    let before = sentence[..first].trim_end_matches([' ', '$', '`', '*']);
    let last = before.rsplit(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
    let is_behind =
        matches!(last, "is" | "ist" | "est" | "es" | "è" | "é" | "be" | "by" | "called" | "beträgt" | "vaut");
    // What stands before the first name belongs to it where nothing stands behind.
    let mut found: Vec<(Links, &str)> = vec![];
    let mut k = 0;
    while k < starts.len() {
        let mut names = names_in(&sentence[starts[k].0..starts[k].1], is_wanted);
        let mut last = k;
        // `l_{c1}, l_{c2}` and `l_{c1} and l_{c2}`
        while last + 1 < starts.len() {
            let between = &sentence[starts[last].1..starts[last + 1].0];
            let is_list = between.split(|c: char| !c.is_alphabetic()).all(|w| {
                matches!(w, "" | "and" | "und" | "et" | "y" | "e" | "bzw" | "or" | "ldots" | "dots")
            });
            if !is_list {
                break;
            }
            last += 1;
            names.extend(names_in(&sentence[starts[last].0..starts[last].1], is_wanted));
        }
        let end = starts.get(last + 1).map_or(sentence.len(), |s| s.0);
        let piece = match is_behind {
            true => &sentence[k.checked_sub(1).map_or(0, |before| starts[before].1)..starts[k].0],
            false => &sentence[starts[last].1..end],
        };
        found.push((names, piece));
        k = last + 1;
    }
    // `at the distance l_{c1} from the joint`, `the distance from the joint to the centre is l_{c1}`
    if let [(_, piece)] = &mut found[..]
        && !is_behind
        && !FROM.iter().any(|w| piece.contains(w))
    {
        *piece = &sentence[..first];
    }
    found
}

/// The names that are said to be of another link than their number says.
fn links(lower: &str) -> BTreeMap<String, usize> {
    const LINKS: [&str; 8] = [
        "of link ",
        "of the link ",
        "of body ",
        "von glied ",
        "des glieds ",
        "du segment ",
        "del eslabón ",
        "del braccio ",
    ];
    const ORDERED: [(&str, usize); 12] = [
        ("first link", 0),
        ("second link", 1),
        ("third link", 2),
        ("ersten glied", 0),
        ("zweiten glied", 1),
        ("dritten glied", 2),
        ("premier segment", 0),
        ("deuxième segment", 1),
        ("primer eslabón", 0),
        ("segundo eslabón", 1),
        ("primo braccio", 0),
        ("secondo braccio", 1),
    ];
    let mut found: BTreeMap<String, Option<usize>> = BTreeMap::new();
    let is_wanted = |of: Role, word: &str| is_to_centre(of, word) || is_inertia(of, word);
    let marks: Vec<&str> = LINKS.iter().copied().chain(ORDERED.iter().map(|o| o.0)).collect();
    for sentence in sentences(lower, &marks) {
        for (names, piece) in pieces(sentence, &is_wanted) {
            let [(name, Some(_))] = &names[..] else { continue };
            // The end of a link, and its joint, are no link.
            let is_point = |at: usize| {
                let before = &piece[edge(piece, at.saturating_sub(14))..at];
                before.split(|c: char| !c.is_alphabetic()).any(|w| {
                    matches!(
                        w,
                        "end"
                            | "tip"
                            | "joint"
                            | "ende"
                            | "endes"
                            | "spitze"
                            | "gelenk"
                            | "bout"
                            | "extrémité"
                    )
                })
            };
            let by_number =
                LINKS.iter().flat_map(|w| piece.match_indices(w)).filter_map(|(at, w)| match number_behind(
                    &piece[at + w.len()..],
                )
                .filter(|_| !is_point(at))?
                {
                    Number::Is(k) => Some(k),
                    Number::Letter(_) => None,
                });
            let by_order =
                ORDERED.iter().filter(|o| piece.find(o.0).is_some_and(|at| !is_point(at))).map(|o| o.1);
            let all: Vec<usize> = by_number.chain(by_order).collect();
            if let Some(&first) = all.first() {
                let link = all.iter().all(|k| *k == first).then_some(first);
                let known = found.entry(name.clone()).or_insert(link);
                if *known != link {
                    *known = None;
                }
            }
        }
    }
    let own = |name: &str| match role(name, JOINTS) {
        Some(Role::Length(of) | Role::Inertia(of)) => of,
        Some(Role::About(k, _)) => Some(k),
        _ => None,
    };
    found
        .into_iter()
        .filter_map(|(name, link)| Some((name, link?)))
        .filter(|(n, l)| own(n) != Some(*l))
        .collect()
}

/// The inertias of links of which words speak; none of those that they leave out.
fn inertias(lower: &str) -> BTreeMap<String, Option<usize>> {
    const WITHOUT: [&str; 20] = [
        "neglect",
        "ignor",
        "negligib",
        "without",
        "no inertia",
        "zero",
        "vanish",
        "vernachl",
        "ohne",
        "néglig",
        "sans ",
        "despreci",
        "sin ",
        "trascur",
        "senza",
        "desprez",
        "sem ",
        "= 0",
        "=0",
        "rotor",
    ];
    let mut found = BTreeMap::new();
    for sentence in sentences(lower, &INERTIA) {
        let plain = OTHERWISE.iter().fold(sentence.to_string(), |text, word| text.replace(word, ""));
        let is_said = INERTIA.iter().any(|w| plain.contains(w)) && !WITHOUT.iter().any(|w| plain.contains(w));
        if !is_said || plain.contains("motor") {
            continue;
        }
        // Small letters: `i_1`, `j_{zz1}`.
        let capitals: String = plain
            .split_inclusive(|c: char| !c.is_alphanumeric())
            .map(|w| match w.chars().next() {
                Some(first @ ('i' | 'j'))
                    if w.chars().nth(1).is_some_and(|c| c == '_' || c.is_ascii_digit()) =>
                {
                    format!("{}{}", first.to_ascii_uppercase(), &w[1..])
                }
                _ => w.to_string(),
            })
            .collect();
        found.extend(names_in(&capitals, &is_inertia));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_and_inertias_are_said() {
        use Shape::{Point, Rod};
        for (text, shape, is_at_ends, count) in [
            ("Point masses at the link ends, gravity acts along −y.", Some(Point), true, 0),
            (
                "The links are point masses at the distances l_{c1}, l_{c2} from the joints.",
                Some(Point),
                false,
                0,
            ),
            ("Point masses at the ends; $J_1$, $J_2$ are the rotors' inertias.", None, false, 0),
            ("The payload is a point mass at the tip.", None, false, 0),
            ("The links are thin rods.", Some(Rod), false, 0),
            ("Link $i$ has the mass $m_i$ and the inertia $I_i$ about its centre of mass.", None, false, 1),
            ("The moments of inertia $I_1$ and $I_2$ are about the joints.", None, false, 2),
            ("We neglect the inertias $I_1$ and $I_2$.", None, false, 0),
            ("The inertia matrix $M_1$ is symmetric.", None, false, 0),
        ] {
            let found = described(&text.to_lowercase());
            let all = (found.shape, found.place == Some(At::End), found.inertias.len());
            assert_eq!(all, (shape, is_at_ends, count), "{text}");
        }
    }

    #[test]
    fn names_may_be_said_to_be_of_other_links() {
        let of = |text: &str| described(&text.to_lowercase()).links;
        assert!(of("$l_{c1}$ is that of link 1, $l_{c2}$ that of link 2").is_empty());
        let swapped = of("$l_{c1}$ is the centre of mass of link 2, $l_{c2}$ that of link 1");
        assert_eq!(swapped, [("lc1".to_string(), 1), ("lc2".to_string(), 0)].into());
        assert!(
            of("between joint 1 and the mass centre of link 1 is $l_{c1}$, the distance between joint 2 and the mass centre of link 2 is $l_{c2}$")
                .is_empty()
        );
        assert!(of("$l_{c2}$ from joint 1 to the centre of the arm").is_empty());
    }
}
