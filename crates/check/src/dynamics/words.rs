//! The names in formulas of dynamics: rates and accelerations in all their spellings, masses, inertias, places of centres of mass.

use super::letters::{Letters, role_of};
use super::model::motion;
use crate::facts::Motion;
use crate::subject::{Subject, spellings as spelled};
use denavit::description::JointKind;
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Expr, Symbol, greek};
use std::collections::{BTreeMap, BTreeSet};

/// What a name of the document stands for, of a body counted from 0; nothing where it is for all bodies.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Role {
    Mass(Option<usize>),
    /// An inertia about some point of the body.
    Inertia(Option<usize>),
    /// A moment of inertia about an axis of the body's frame.
    About(usize, usize),
    /// A length to a centre of mass, or to an end that the table does not have.
    Length(Option<usize>),
    /// One of Khalil's ten numbers.
    Ten(usize, usize),
    /// The inertia of the rotor that turns a joint, as the joint feels it.
    Rotor(Option<usize>),
    /// The ratio of the gear before a rotor.
    Gear(Option<usize>),
    /// The mass of the motor on a joint.
    Motor(usize),
    /// The mass that the hand carries.
    Payload,
    Gravity,
}

/// The most names that are taken from a document.
const MAX_WORDS: usize = 400;
/// Bases of names of more than one letter.
const BASES: [&str; 34] = [
    "lc", "Lc", "rc", "ac", "dc", "lg", "LG", "lG", "Ic", "Jc", "IG", "JG", "Izz", "Ixx", "Iyy", "Jzz",
    "Jxx", "Jyy", "Iz", "Ix", "Iy", "Jz", "Jx", "Jy", "MX", "MY", "MZ", "XX", "YY", "ZZ", "XY", "XZ", "YZ",
    "IA",
];

/// Khalil's numbers of a body.
const TEN: [&str; 10] = ["XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M"];

/// The names of a text of formulas, marks of subscripts left aside.
pub(super) fn words(source: &str) -> BTreeSet<String> {
    let chars: Vec<char> = source.chars().collect();
    let mut found = BTreeSet::new();
    let mut at = 0;
    while at < chars.len() && found.len() < MAX_WORDS {
        let c = chars[at];
        let base = if c == '\\' {
            let name: String = chars[at + 1..].iter().take_while(|c| c.is_ascii_alphabetic()).collect();
            at += 1 + name.chars().count();
            match name.as_str() {
                "ell" => "l".to_string(),
                "mathit" | "mathrm" if chars.get(at) == Some(&'{') => {
                    // A name with a number in it is one: `\mathit{U2h}_{11}`.
                    let inner: String =
                        chars[at + 1..].iter().take_while(|c| c.is_alphanumeric()).take(12).collect();
                    if inner.contains(|c: char| c.is_ascii_digit()) {
                        at += 1 + inner.chars().count();
                        found.insert(format!("{inner}{}", script(&chars, &mut at)));
                    }
                    continue;
                }
                "begin" | "end" => {
                    // The name of an environment is none of the formula.
                    at += chars[at..].iter().take_while(|c| **c != '}').take(40).count();
                    continue;
                }
                _ => match greek::letter(&name) {
                    Some(letter) => letter.to_string(),
                    None => {
                        at += usize::from(name.is_empty());
                        continue;
                    }
                },
            }
        } else if c.is_alphabetic() {
            let run: String = chars[at..].iter().take_while(|c| c.is_alphabetic()).collect();
            at += run.chars().count();
            if ["sin", "cos", "sen", "tan"].iter().any(|f| run.ends_with(f)) {
                continue;
            }
            run
        } else {
            at += 1;
            continue;
        };
        let script = script(&chars, &mut at);
        let last: String = base.chars().rev().take(1).collect();
        let long = BASES.iter().find(|b| base.ends_with(**b)).map(|b| (*b).to_string());
        if script.is_empty() {
            // `Jz`, the one inertia that there is.
            if matches!(base.as_str(), "mL" | "ML" | "mp" | "Mp" | "mt") || BASES.contains(&&*base) {
                found.insert(base.clone());
            }
            // A product of names has few letters; `sigma`, `gamma` are one, and so is a word.
            if base.chars().count() <= 3 || !base.is_ascii() {
                found.extend(base.chars().map(|c| c.to_string()));
            }
            continue;
        }
        // `g l_1` with no blank between: of letters that are squeezed so, gravity's has no index ever; and `m a_2`, `m g_0`.
        if base.chars().count() <= 3 && base.starts_with('g') && base.len() > 1 {
            found.insert("g".to_string());
        }
        if matches!(base.as_str(), "ma" | "md" | "mg" | "mL" | "mr" | "mga" | "mgd" | "mgr") {
            found.insert("m".to_string());
        }
        for base in
            [Some(last), long, (base.chars().count() <= 4).then(|| base.clone())].into_iter().flatten()
        {
            found.insert(format!("{base}{script}"));
        }
    }
    found
}

/// The index behind a name: digits, small letters below the line, or what stands behind `_`.
fn script(chars: &[char], at: &mut usize) -> String {
    let mut script = String::new();
    // `\bar{I}_1`
    while chars.get(*at) == Some(&'}') && chars.get(*at + 1).is_some_and(|c| matches!(c, '_' | '}')) {
        *at += 1;
    }
    loop {
        match chars.get(*at) {
            Some(c) if c.is_ascii_digit() => {
                script.push(*c);
                *at += 1;
            }
            Some(&c) if denavit_symbolic::parse::subscript(c).is_some() => {
                script.extend(denavit_symbolic::parse::subscript(c));
                *at += 1;
            }
            Some('_') => {
                *at += 1;
                if chars.get(*at) == Some(&'{') {
                    let mut depth = 0_usize;
                    let mut inner = String::new();
                    for &c in chars[*at..].iter().take(40) {
                        *at += 1;
                        match c {
                            '{' => depth += 1,
                            '}' => depth -= 1,
                            c => inner.push(c),
                        }
                        if depth == 0 {
                            break;
                        }
                    }
                    script += &plain_name(&without_looks(&inner));
                } else if let Some(c) = chars.get(*at).filter(|c| c.is_alphanumeric()) {
                    script.push(*c);
                    *at += 1;
                    // `l_c1`
                    while c.is_alphabetic() && chars.get(*at).is_some_and(char::is_ascii_digit) {
                        script.push(chars[*at]);
                        *at += 1;
                    }
                }
            }
            _ => return script,
        }
    }
}

pub(super) fn without_looks(inner: &str) -> String {
    ["\\mathrm", "\\text", "\\rm", "\\ell", "\\,"]
        .iter()
        .fold(inner.to_string(), |s, look| s.replace(look, if *look == "\\ell" { "l" } else { "" }))
}

/// True for the letters of one of Khalil's numbers with others grouped into it: `ZZR_1`.
pub(super) fn is_grouped(word: &str) -> bool {
    word.strip_suffix('R').is_some_and(|own| own.len() == 2 && TEN.contains(&own))
}

/// What a name may stand for, in an arm of `n` bodies.
pub(super) fn role(word: &str, n: usize) -> Option<Role> {
    if word == "g0" {
        return Some(Role::Gravity);
    }
    let digits = word.chars().filter(char::is_ascii_digit).count();
    let index = word.chars().find(char::is_ascii_digit).and_then(|c| (c as usize).checked_sub('1' as usize));
    if digits > 1 || digits == 1 && index.is_none() {
        return None;
    }
    let index = match index {
        Some(k) if k < n => Some(k),
        // A further mass is that of the load.
        Some(k) if k == n => {
            return matches!(word.trim_end_matches(char::is_numeric), "m" | "M").then_some(Role::Payload);
        }
        Some(_) => return None,
        None => None,
    };
    let letters: String = word.chars().filter(|c| !c.is_ascii_digit() && *c != ',').collect();
    let letters = letters.as_str();
    if let (Some(k), Some(at)) = (index, TEN.iter().position(|t| *t == letters))
        && letters.len() == 2
    {
        return Some(Role::Ten(k, at));
    }
    if matches!(letters, "mp" | "mL" | "ML" | "Mp" | "mt" | "mload" | "mc" | "me") && index.is_none() {
        return Some(Role::Payload);
    }
    match letters {
        "m" | "M" | "ml" | "mG" => return Some(Role::Mass(index)),
        "mm" | "mM" | "mmot" | "mr" if index.is_some() => return index.map(Role::Motor),
        "N" | "n" | "kr" | "Kr" | "kg" | "Ng" | "ng" | "η" => return Some(Role::Gear(index)),
        "g" if index.is_none() => return Some(Role::Gravity),
        _ => {}
    }
    let mut marks = letters.chars();
    match marks.next()? {
        'I' | 'J' => {
            let rest: &str = marks.as_str();
            let axis = match rest {
                "xx" | "x" | "cxx" | "cx" => Some(0),
                "yy" | "y" | "cyy" | "cy" => Some(1),
                "zz" | "z" | "czz" | "cz" => Some(2),
                _ => None,
            };
            match (rest, axis, index) {
                (_, Some(axis), Some(k)) => Some(Role::About(k, axis)),
                ("" | "c" | "C" | "G" | "g" | "o" | "O" | "l" | "L" | "s" | "S" | "cm" | "zz" | "z", ..) => {
                    Some(Role::Inertia(index))
                }
                ("m" | "M" | "mot" | "motor" | "r" | "rot" | "rotor" | "a" | "A", ..) => {
                    Some(Role::Rotor(index))
                }
                _ => None,
            }
        }
        'l' | 'L' | 'r' | 'a' | 'd' | 'ρ' | 'λ' | 'R' => {
            let rest: &str = marks.as_str();
            matches!(rest, "" | "c" | "C" | "g" | "G" | "m" | "cm" | "s" | "S").then_some(Role::Length(index))
        }
        _ => None,
    }
}

/// The names of a document's dynamics.
pub(super) struct Names {
    pub vocabulary: Vocabulary,
    pub roles: BTreeMap<Symbol, Role>,
    /// Of each joint, whether it slides.
    pub slides: Vec<bool>,
    /// How many bodies there are, one behind each row that moves.
    pub bodies: usize,
    /// The bodies that letters stand for.
    pub letters: Letters,
    /// Formulas have numbers for what the document measures, gravity among it.
    pub is_measured: bool,
}

/// Names for an arm: `state` are the symbols of joints, rates and accelerations, `motion` names of a program for these, `rows` the rows that move. With `lengths` names
/// `l_1, l_2` of one letter that the table does not have are the lengths in its rows; `letters` are those
/// of bodies, `places` those without a number that words have for where a centre of mass is.
pub(super) fn names(
    subject: &Subject,
    (state, motion): (&super::model::State, &Motion),
    rows: &[usize],
    mentioned: &BTreeSet<String>,
    lengths: Option<char>,
    letters: &Letters,
    places: &[char],
) -> Names {
    let mut vocabulary = subject.vocabulary();
    let own = vocabulary.clone();
    let n = rows.len();
    let mut roles = BTreeMap::new();
    let mut spellings: Vec<(usize, String)> = vec![];
    let variables = subject.description.variables();
    for (k, v) in variables.iter().enumerate() {
        let letters: &[&str] = match v.kind {
            JointKind::Revolute => &["θ", "t", "th", "theta", "q", "φ", "phi"],
            JointKind::Prismatic => &["d", "r", "q", "l", "x", "s", "ρ"],
        };
        let is_own = |name: &str| own.lookup(name).is_some_and(|e| e.as_symbol() == Some(v.symbol));
        let number = v.symbol.name().trim_start_matches('q').to_string();
        let mut of: Vec<String> =
            letters.iter().map(|l| format!("{l}{number}")).filter(|s| is_own(s)).collect();
        of.push(v.symbol.name().to_string());
        of.extend(subject.variables.iter().flatten().filter(|p| is_own(p)).map(|p| plain_name(p)));
        of.extend(of.iter().flat_map(|s| spelled(s)).collect::<Vec<_>>());
        of.sort();
        of.dedup();
        spellings.extend(of.into_iter().map(|s| (k, s)));
    }
    let mut rate = |name: String, value: Expr| {
        if own.lookup(&name).is_none() {
            vocabulary = std::mem::take(&mut vocabulary).alias(&name, value);
        }
    };
    for (k, name) in &spellings {
        let cut = name.find(|c: char| c.is_ascii_digit()).unwrap_or(name.len());
        let (letters, number) = name.split_at(cut);
        let [qd, qdd] = [state.qd[*k], state.qdd[*k]].map(Expr::from);
        for (marks, value) in [("d", qd), ("dot", qd), ("dd", qdd), ("ddot", qdd)] {
            rate(format!("{marks}{name}"), value);
            rate(format!("{name}{marks}"), value);
            rate(format!("{letters}{marks}{number}"), value);
        }
        rate(format!("{name}p"), qd);
        rate(format!("{name}pp"), qdd);
        rate(format!("{letters}p{number}"), qd);
        rate(format!("{letters}pp{number}"), qdd);
    }
    // `\dot\theta_{12}`
    for from in 0..state.qd.len() {
        let mut digits = (from + 1).to_string();
        let mut sums = [state.qd[from], state.qdd[from]].map(Expr::from);
        for to in from + 1..state.qd.len() {
            digits += &(to + 1).to_string();
            sums = [sums[0] + Expr::from(state.qd[to]), sums[1] + Expr::from(state.qdd[to])];
            for letter in ["θ", "q"] {
                rate(format!("dot{letter}{digits}"), sums[0]);
                rate(format!("ddot{letter}{digits}"), sums[1]);
            }
        }
    }
    // Parameters of a function hide the lengths that `a1` would be in the table.
    let is_in_table = |w: &String| own.lookup(w).and_then(Expr::as_symbol).is_some_and(|s| *s.name() == **w);
    let is_motion = |w: &String| motion.contains_key(w) && !is_in_table(w);
    for (name, &(joint, order)) in motion {
        let all = if order == 1 { &state.qd } else { &state.qdd };
        if let Some(&symbol) = all.get(joint).filter(|_| is_motion(name)) {
            vocabulary = std::mem::take(&mut vocabulary).alias(name, symbol.into());
        }
    }
    let rotors: Vec<Option<usize>> = mentioned
        .iter()
        .filter_map(|w| match role_of(w, n, letters) {
            Some(Role::Rotor(of)) => Some(of),
            _ => None,
        })
        .collect();
    let has_rotor = |of: Option<usize>| match of {
        Some(_) => rotors.contains(&of) || rotors.contains(&None),
        None => !rotors.is_empty(),
    };
    // The `d1` of a rate `qd1` is no length.
    let is_of_rate = |word: &str| {
        let rates = mentioned.iter().filter_map(|w| w.strip_prefix('q'));
        word.starts_with('d')
            && own.lookup(word).is_none()
            && rates.into_iter().any(|w| w == word || word == "d" && w.starts_with('d'))
    };
    // Beside Khalil's M_1, or more of them than there are bodies, a name m_1 is another.
    let has_ten = mentioned.iter().any(|w| matches!(role_of(w, n, letters), Some(Role::Ten(..))));
    let number = |w: &str, letter: char| w.strip_prefix(letter)?.parse::<usize>().ok();
    let is_mass = |w: &String| number(w, 'M').is_some() || number(w, 'm').is_some_and(|k| k > n + 1);
    let has_others = has_ten && mentioned.iter().any(is_mass);
    let is_other = |word: &str| has_others && word.starts_with('m');
    for word in mentioned.iter().filter(|w| !is_of_rate(w) && !is_other(w) && !is_motion(w)) {
        // Beside `m g_0 l` the `g` of `g(q)` is no acceleration.
        if word == "g" && mentioned.contains("g0") {
            continue;
        }
        // A letter of which words say that it is where a centre of mass is.
        let is_place = || word.chars().count() == 1 && word.chars().all(|c| places.contains(&c));
        let Some(role) = role_of(word, n, letters).or_else(|| is_place().then_some(Role::Length(None)))
        else {
            continue;
        };
        if let Role::Gear(of) = role
            && !has_rotor(of)
        {
            continue;
        }
        let known = own.lookup(word);
        // `d_1`, a length that the table has not, may be that to a centre of mass.
        let is_free = match known {
            None => true,
            Some(e) => e.is_zero() && matches!(role, Role::Length(_)),
        };
        if !is_free {
            if let (Role::Gravity, Some(symbol)) = (role, known.and_then(Expr::as_symbol)) {
                roles.insert(symbol, role);
            }
            continue;
        }
        if let (Some(letter), Role::Length(Some(k))) = (lengths, role)
            && word.starts_with(letter)
            && word.chars().count() == 2
        {
            let row = length_of(subject, rows, k);
            if let Some(length) = row {
                vocabulary = std::mem::take(&mut vocabulary).alias(word, length);
                continue;
            }
        }
        vocabulary = std::mem::take(&mut vocabulary).symbol(word);
        roles.insert(Symbol::new(word), role);
    }
    let slides = variables.iter().map(|v| v.kind == JointKind::Prismatic).collect();
    Names { vocabulary, roles, slides, bodies: n, letters: letters.clone(), is_measured: false }
}

/// The length of a link, by the row that holds it.
pub(super) fn length_of(subject: &Subject, rows: &[usize], k: usize) -> Option<Expr> {
    let d = &subject.description;
    let row = d.rows.get(rows[k] + usize::from(!d.convention.begins_with_joint()))?;
    let is_slide = motion(d, row) == Some(JointKind::Prismatic);
    [row.a, row.d].into_iter().find(|e| !(e.is_zero() || is_slide && *e == row.d))
}
