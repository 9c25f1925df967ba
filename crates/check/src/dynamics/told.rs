//! What sentences say of a document's dynamics: where gravity pulls, about which points inertias are, and what the links are.

use super::described::{CENTRES, Described, INERTIA, described};
use super::words::Role;
use crate::facts::Spoken;
use crate::leeway::HELD;
use crate::tools::edge;
use denavit_symbolic::Symbol;
use std::collections::BTreeMap;

/// The point about which the inertias of links are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Point {
    Centre,
    Joint,
}

/// What the words of a document say.
#[derive(Clone, Default, Debug)]
pub(super) struct Told {
    /// The axis along which gravity acts, and whether against it.
    pub gravity: Option<(usize, bool)>,
    /// Whether the arm is said to move in a horizontal plane, and nothing of the direction of gravity.
    pub is_level: bool,
    pub inertia: Option<Point>,
    /// What is said of the links.
    pub links: Described,
    /// Whether there are words about rotors or motors.
    pub has_rotors: bool,
    /// Whether the links are said to have no mass: a mass without a number is that of what the hand carries.
    pub is_massless: bool,
    /// Letters without a number for places of centres of mass: `centre of mass b behind the tip`.
    pub lengths: Vec<char>,
}

impl Told {
    /// What is said of bodies in one way alone.
    pub fn only(&self, of: Spoken) -> Told {
        let mut links = self.links.clone();
        if of != Spoken::Shape {
            (links.shape, links.place) = (None, None);
        }
        if of != Spoken::Centres {
            links.from.clear();
        }
        if of != Spoken::LeftOut {
            links.inertias.clear();
        }
        if of != Spoken::Links {
            links.links.clear();
        }
        let inertia = self.inertia.filter(|_| of == Spoken::Inertias);
        Told { inertia, links, ..Told::default() }
    }
}

pub(super) fn told(text: &str) -> Told {
    let lower = text.to_lowercase();
    let gravity = gravity(&lower);
    let has_rotors = ["rotor", "motor", "moteur", "läufer", "antrieb"].iter().any(|w| lower.contains(w));
    let is_level = gravity.is_none() && is_level(&lower);
    let is_massless = is_massless(&lower);
    Told {
        gravity,
        is_level,
        inertia: inertia(&lower),
        links: described(&lower),
        has_rotors,
        is_massless,
        lengths: lengths(text),
    }
}

/// The letters that sentences about centres of mass have, but for those that lengths have anyway.
fn lengths(text: &str) -> Vec<char> {
    const LETTERS: [char; 9] = ['b', 'c', 'f', 'h', 'k', 'p', 's', 'w', 'e'];
    // Words of a letter, in the languages that are read.
    let is_word = |c: char, before: &str| c == 'e' && !before.ends_with(['$', '`', '*']);
    let lower = text.to_ascii_lowercase();
    let mut found = vec![];
    for sentence in sentences(&lower, &CENTRES) {
        let start = sentence.as_ptr() as usize - lower.as_ptr() as usize;
        let own = &text[start..start + sentence.len()];
        for (at, c) in own.char_indices().filter(|(_, c)| LETTERS.contains(c)) {
            let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '\\' | '{' | '^' | '\'');
            let (before, behind) = (&own[..at], &own[at + 1..]);
            let is_lone = !before.ends_with(is_part) && !behind.starts_with(is_part);
            if is_lone && !is_word(c, before) && !found.contains(&c) {
                found.push(c);
            }
        }
    }
    found
}

/// Whether a sentence says that the links have no mass.
fn is_massless(lower: &str) -> bool {
    const WITHOUT: [&str; 22] = [
        "massless",
        "without mass",
        "no mass",
        "negligible mass",
        "mass is neglected",
        "masses are neglected",
        "mass of the links is neglected",
        "masses of the links are neglected",
        "masses of the links are negligible",
        "neglect the mass",
        "masselos",
        "massenlos",
        "masse vernachlässig",
        "massen vernachlässig",
        "sans masse",
        "masse négligeable",
        "masses négligeables",
        "sin masa",
        "masa despreciable",
        "sem massa",
        "massa trascurabile",
        "privi di massa",
    ];
    const LINKS: [&str; 14] = [
        "link", "arm", "rod", "bar", "glied", "stäbe", "segment", "bras", "corps", "eslab", "elo", "bracci",
        "membr", "barra",
    ];
    // Where each link has a mass at its end, a lone letter is that, and no load.
    const NOT: [&str; 21] = [
        "not massless",
        "motor",
        "cable",
        "spring",
        "rope",
        "each",
        "every",
        "both",
        "equal mass",
        "ends",
        "masses at",
        "joints",
        "jede",
        "beide",
        "enden",
        "chaque",
        "chacun",
        "extrémités",
        "cada",
        "ogni",
        "ciascun",
    ];
    let has_link =
        |s: &str| s.split(|c: char| !c.is_alphabetic()).any(|w| LINKS.iter().any(|link| w.starts_with(link)));
    let says = |s: &str| has_link(s) && !NOT.iter().any(|w| s.contains(w));
    sentences(lower, &WITHOUT).any(says)
}

/// No sentence is longer that says something.
const LONGEST: usize = 300;
/// So often a word is looked at.
const OFTEN: usize = 50;

/// The sentences with a word in them.
pub(super) fn sentences<'t>(lower: &'t str, words: &'t [&'t str]) -> impl Iterator<Item = &'t str> {
    words.iter().flat_map(move |word| lower.match_indices(word).take(OFTEN)).map(move |(at, _)| {
        let first = edge(lower, at.saturating_sub(LONGEST));
        let is_end = |text: &str, k: usize| {
            // The point in `I_1. The` ends a sentence, that in `0.5` does not.
            text.as_bytes()[k] == b'\n' || text.as_bytes().get(k + 1).is_none_or(u8::is_ascii_whitespace)
        };
        let before = &lower[first..at];
        let start = before.rmatch_indices(['.', '\n']).find(|(k, _)| is_end(before, *k));
        let start = start.map_or(first, |(k, _)| first + k + 1);
        let last = edge(lower, at + LONGEST);
        let behind = &lower[at..last];
        let end = behind.match_indices(['.', '\n']).find(|(k, _)| is_end(behind, *k));
        &lower[start..end.map_or(last, |(k, _)| at + k)]
    })
}

/// The direction in which a sentence says that gravity acts.
fn gravity(lower: &str) -> Option<(usize, bool)> {
    const WORDS: [&str; 9] = [
        "gravit",
        "schwerkraft",
        "schwerebeschl",
        "erdbeschl",
        "pesanteur",
        "gravedad",
        "gravidade",
        "gravità",
        "weight",
    ];
    let mut found: Option<(usize, bool)> = None;
    for sentence in sentences(lower, &WORDS) {
        let sentence: String =
            sentence.chars().filter(|c| !matches!(c, '$' | '{' | '}' | '\\' | '_')).collect();
        let sentence = ["hat", "vec", "mathbf"].iter().fold(sentence, |s, look| s.replace(look, ""));
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            for (sign, is_down) in [("-", true), ("−", true), ("–", true), ("+", false)] {
                for (k, _) in sentence.match_indices(&format!("{sign}{letter}")) {
                    let behind = sentence[k + sign.len() + 1..].chars().next();
                    // What stands between two names is a sum.
                    let before = sentence[..k].chars().next_back();
                    let is_sum = !is_down && before.is_some_and(char::is_alphanumeric);
                    if behind.is_some_and(char::is_alphanumeric) || is_sum {
                        continue;
                    }
                    match found {
                        Some(other) if other != (axis, is_down) => return None,
                        _ => found = Some((axis, is_down)),
                    }
                }
            }
        }
    }
    found
}

/// Whether the words say that the arm moves in a horizontal plane.
fn is_level(lower: &str) -> bool {
    const WORDS: [&str; 8] = [
        "horizontal plane",
        "horizontale ebene",
        "horizontalen ebene",
        "waagerechten ebene",
        "plan horizontal",
        "plano horizontal",
        "piano orizzontale",
        "horizontally in a plane",
    ];
    WORDS.iter().any(|word| lower.contains(word)) && !lower.contains("vertical plane")
}

/// The point about which a sentence says that inertias are.
fn inertia(lower: &str) -> Option<Point> {
    const JOINTS: [&str; 13] = [
        "joint",
        "axis of rotation",
        "rotation axis",
        "pivot",
        "drehachse",
        "drehpunkt",
        "gelenk",
        "axe de rotation",
        "articulation",
        "articulación",
        "articulação",
        "asse di rotazione",
        "eje de giro",
    ];
    const ABOUT: [&str; 18] = [
        "through",
        "passing by",
        " durch ",
        "passant par",
        "passante per",
        "about",
        "around",
        "respect to",
        "relative to",
        " um ",
        "bezüglich",
        "bezogen auf",
        "autour",
        "par rapport",
        "alrededor",
        "respecto",
        "rispetto",
        "em torno",
    ];
    let mut found: Option<Point> = None;
    for sentence in sentences(lower, &INERTIA) {
        for (names, point) in [(&CENTRES[..], Point::Centre), (&JOINTS[..], Point::Joint)] {
            for (at, _) in names.iter().flat_map(|name| sentence.match_indices(name)) {
                let first = edge(sentence, at.saturating_sub(30));
                // `about the centre`, with nothing between that is another point.
                let before = &sentence[first..at];
                let about = ABOUT.iter().filter_map(|w| before.rfind(w)).max();
                let is_about = about.is_some_and(|k| {
                    !before[k..].contains([',', ';'])
                        && !CENTRES.iter().chain(&JOINTS).any(|other| before[k..].contains(other))
                });
                match found {
                    _ if !is_about => {}
                    Some(other) if other != point => return None,
                    _ => found = Some(point),
                }
            }
        }
    }
    found
}

/// True for words that may be about one configuration: `with θ1 = 0`, `for the stretched arm`.
pub(super) fn is_case(words: &str) -> bool {
    const WORDS: [&str; 24] = [
        "for", "at", "with", "when", "where", "if", "case", "here", "then", "bei", "für", "mit", "wenn",
        "falls", "pour", "avec", "si", "quand", "para", "con", "cuando", "per", "quando", "se",
    ];
    let lower = words.to_lowercase();
    lower.contains('=') || lower.split(|c: char| !c.is_alphabetic()).any(|w| WORDS.contains(&w))
}

/// True for words before a formula, or behind it on its line, that say that it is one of a special case: a joint held, slow motion, small
/// angles, terms left out, values of joints.
pub(super) fn is_special_case(words: &str) -> bool {
    const WORDS: [&str; 32] = [
        "lock",
        "brake",
        "clamp",
        "standstill",
        "neglect",
        "ignor",
        "without the",
        "small angle",
        "slow",
        "special case",
        "if only",
        "gebremst",
        "stillstand",
        "in ruhe",
        "vernachläss",
        "kleine winkel",
        "langsam",
        "sonderf",
        "waagerecht gelegt",
        "frein",
        "immobil",
        "au repos",
        "néglig",
        "petits angles",
        "lente",
        "freno",
        "fermo",
        "trascur",
        "piccoli angoli",
        "en reposo",
        "despreci",
        "travad",
    ];
    let lower = words.to_lowercase();
    let plain: String = lower.chars().filter(|c| !c.is_whitespace()).collect();
    // `(\dot r = 0)`, `for θ2 = 90°`
    let has_value = plain.match_indices('=').any(|(at, _)| {
        let before: String =
            plain[..at].chars().rev().take(14).collect::<Vec<_>>().into_iter().rev().collect();
        let is_joint = ["θ", "theta", "q", "dot", "phi", "φ"].iter().any(|name| before.contains(name));
        let behind = plain[at + 1..].trim_start_matches(['-', '−', '\\', '$']);
        let digits = behind.chars().take_while(|c| c.is_ascii_digit() || matches!(c, '.' | ',')).count();
        let rest = &behind[digits..];
        let is_value = behind.starts_with("pi")
            || behind.starts_with('π')
            || digits > 0 && !rest.starts_with(['k', 'm', 'n']);
        is_joint && is_value
    });
    has_value || HELD.iter().chain(&WORDS).any(|w| lower.contains(w))
}

/// What names stand for as words say it: of other links than their numbers say, and inertias that no formula has.
pub(super) fn as_told(roles: &BTreeMap<Symbol, Role>, told: &Told, n: usize) -> BTreeMap<Symbol, Role> {
    let mut all = roles.clone();
    for (name, &link) in told.links.links.iter().filter(|(_, link)| **link < n) {
        if let Some(role) = all.get_mut(&Symbol::new(name)) {
            *role = match *role {
                Role::Length(Some(_)) => Role::Length(Some(link)),
                Role::Inertia(Some(_)) => Role::Inertia(Some(link)),
                Role::About(_, axis) => Role::About(link, axis),
                other => other,
            };
        }
    }
    for (name, link) in &told.links.inertias {
        let links = link.map_or(0..n, |k| k..(k + 1).min(n));
        all.extend(links.map(|k| (numbered(name, k), Role::Inertia(Some(k)))));
    }
    all
}

/// `I_i` of link 1, from 0, is `I_2`.
fn numbered(name: &str, link: usize) -> Symbol {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit() || matches!(c, 'i' | 'j' | 'k'));
    Symbol::new(&format!("{letters}{}", link + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn special_cases_are_told() {
        for words in [
            "With joint 2 locked",
            "Schubgelenk gebremst ($\\dot r = 0$):",
            "For $\\theta_2 = 45°$",
            "pour de petits angles",
            "at q2 = pi/2",
            "Neglecting the Coriolis terms",
        ] {
            assert!(is_special_case(words), "{words}");
        }
        for words in [
            "The torques are",
            "with l_1 = 0.5 m and m_2 = 3 kg",
            "Gravity acts along −y.",
            "Hence, with g = 9.81 m/s^2,",
        ] {
            assert!(!is_special_case(words), "{words}");
        }
    }

    #[test]
    fn sentences_say_where_gravity_pulls_and_about_what_inertias_are() {
        for (text, gravity, inertia) in [
            ("Gravity acts along −y.", Some((1, true)), None),
            ("The inertias $I_1$, $I_2$ are those about the centres of mass.", None, Some(Point::Centre)),
            ("I_1 is the moment of inertia about joint 1.", None, Some(Point::Joint)),
            (
                "Trägheitsmomente um die Gelenkachsen; die Schwerkraft wirkt entlang -z",
                Some((2, true)),
                Some(Point::Joint),
            ),
            ("I_i: moments d'inertie par rapport au centre de masse", None, Some(Point::Centre)),
            ("Its inertia is I and its centre of mass is at 0.5 l from the joint.", None, None),
            (
                "Inertias about the joints in a), about the centres of mass in b) (inertias again).",
                None,
                None,
            ),
            ("g along -x. The gravity acts along -y", Some((1, true)), None),
            ("gravity along -x or gravity along -y", None, None),
        ] {
            let found = told(text);
            assert_eq!((found.gravity, found.inertia), (gravity, inertia), "{text}");
        }
    }
}
