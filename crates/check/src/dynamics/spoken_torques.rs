//! Torques that sentences give in numbers: `at θ1 = 0, θ2 = 90° the torques are 14.7 N m and 0 N m`.
//!
//! They are held against the arm as the document's formulas are read, with the numbers that the document gives for its symbols. What agrees
//! with its digits is right; what does not is wrong where the sentence itself says the state of all joints, and else open.

use super::attempt::Attempt;
use super::measures::measures;
use super::quantity::Quantity;
use super::words::Role;
use crate::facts::{About, Dynamic, Unproved};
use crate::numbers::half_unit;
use crate::outcome::{Claim, Entry, Finding, Wrong};
use crate::subject::Subject;
use crate::tools::edge;
use denavit::description::JointKind;
use denavit_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;
use std::ops::Range;

/// No more sentences are looked at.
const MAX_SENTENCES: usize = 200;
/// No sentence is longer that says something.
const LONGEST: usize = 500;

const TORQUES: [&str; 12] = [
    "torque",
    "moment",
    "couple",
    "drehmoment",
    "antriebsmoment",
    "gelenkmoment",
    "coppi",
    "coppia",
    "par ",
    "pares",
    "torsor",
    "binário",
];
/// With these words the numbers are those of something else: what drives can do, loads, parts of torques.
const OTHERWISE: [&str; 20] = [
    "limit",
    "at most",
    "maxim",
    "minim",
    "rated",
    "höchst",
    "payload",
    "disturb",
    "friction",
    "reibung",
    "frott",
    "of inertia",
    "d'inertie",
    "de inercia",
    "d'inerzia",
    "if we apply",
    "apply",
    "constant",
    "stall",
    "per ",
];

/// A number with half a unit of its last digit, and where it stands.
#[derive(Clone, Debug, PartialEq)]
struct Number {
    value: f64,
    half: f64,
    span: Range<usize>,
}

/// Torques that a sentence gives.
#[derive(Clone, Debug, PartialEq)]
struct Given {
    /// One joint's, from 0; those of all otherwise.
    joint: Option<usize>,
    /// In newtons, as slides have it.
    is_force: bool,
    numbers: Vec<Number>,
}

/// The state of the joints: of each of q, q̇, q̈ the values that are given.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct State {
    pub values: [BTreeMap<usize, f64>; 3],
}

/// Judges the torques that sentences give.
pub(super) fn judged(text: &str, subject: &Subject, attempt: &Attempt, robot: usize) -> Vec<Claim> {
    let n = attempt.model.state.q.len();
    let mut claims = vec![];
    let mut known: Option<State> = None;
    let reading = Reading::new(text, subject, attempt);
    let kinds: Vec<JointKind> = subject.description.variables().iter().map(|v| v.kind).collect();
    let slides: Vec<bool> = kinds.iter().map(|k| *k == JointKind::Prismatic).collect();
    for span in sentences(text).into_iter().take(MAX_SENTENCES) {
        let sentence = &text[span.clone()];
        let state = state(sentence, n, &kinds);
        let is_whole = (0..n).all(|j| state.values[0].contains_key(&j));
        if is_whole {
            known = Some(state.clone());
        }
        let lower = sentence.to_lowercase();
        if !TORQUES.iter().any(|w| lower.contains(w)) || OTHERWISE.iter().any(|w| lower.contains(w)) {
            continue;
        }
        let Some(at) = known.as_ref().filter(|_| is_whole || !state.is_partial()) else { continue };
        for given in given(sentence, n) {
            let fits = match given.joint {
                Some(j) => slides[j] == given.is_force,
                None => given.numbers.len() == n && slides.iter().all(|s| *s == given.is_force),
            };
            if let (Some(reading), true) = (&reading, fits) {
                claims.push(claim(text, &span, &given, reading, at, is_whole, robot));
            }
        }
    }
    claims
}

impl State {
    /// True for a state that says something of some joints alone.
    fn is_partial(&self) -> bool {
        !self.values[0].is_empty()
    }
}

/// The arm with numbers for its symbols.
pub(super) struct Reading {
    torques: Vec<Expr>,
    values: BTreeMap<Symbol, f64>,
    state: [Vec<Symbol>; 3],
    /// Nothing else in the document says how the arm is read.
    is_open: bool,
}

impl Reading {
    pub fn new(text: &str, subject: &Subject, attempt: &Attempt) -> Option<Self> {
        let model = attempt.model(subject, 0)?;
        let torques: Vec<Expr> =
            (0..model.state.q.len()).map(|j| model.value(Quantity::Torque(j))).collect::<Option<_>>()?;
        let mut values: BTreeMap<Symbol, f64> = BTreeMap::new();
        let names = subject.vocabulary();
        for (word, value) in measures(text) {
            let Ok(number) = value.eval(|_| None) else { continue };
            let own = names.lookup(&word).and_then(Expr::as_symbol);
            values.insert(own.unwrap_or_else(|| Symbol::new(&word)), number);
        }
        for (symbol, value) in subject.description.known_values() {
            values.entry(symbol).or_insert(value);
        }
        // What falls.
        for (symbol, _) in attempt.roles.iter().filter(|(_, r)| **r == Role::Gravity) {
            values.entry(*symbol).or_insert(9.81);
        }
        values.entry(Symbol::new("g")).or_insert(9.81);
        let state = [model.state.q.clone(), model.state.qd.clone(), model.state.qdd.clone()];
        let is_open = attempt.score() == 0 && !attempt.is_given || attempt.is_open();
        Some(Reading { torques, values, state, is_open })
    }

    /// True if nothing can be called wrong.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// A joint's torque in a state.
    fn torque(&self, joint: usize, at: &State) -> Option<f64> {
        self.number(*self.torques.get(joint)?, at)
    }

    /// What a formula is in a state; rates and accelerations that are not given are 0.
    pub fn number(&self, e: Expr, at: &State) -> Option<f64> {
        let value = |s: Symbol| {
            for (symbols, values) in self.state.iter().zip(&at.values) {
                if let Some(k) = symbols.iter().position(|x| *x == s) {
                    return Some(values.get(&k).copied().unwrap_or(0.0));
                }
            }
            self.values.get(&s).copied()
        };
        e.eval(value).ok().filter(|x| x.is_finite())
    }
}

fn claim(
    text: &str,
    sentence: &Range<usize>,
    given: &Given,
    reading: &Reading,
    at: &State,
    is_whole: bool,
    robot: usize,
) -> Claim {
    let moved = |span: &Range<usize>| sentence.start + span.start..sentence.start + span.end;
    let entry = |(k, number): (usize, &Number)| {
        let wanted = reading.torque(given.joint.unwrap_or(k), at).filter(|_| !reading.is_open);
        let finding = match wanted {
            Some(wanted) if (wanted - number.value).abs() <= 1.02 * number.half + 1e-9 * wanted.abs() => {
                Finding::Equal { unless_zero: vec![] }
            }
            // In another state, or under another load, it may be right.
            Some(wanted) if is_whole => Finding::Wrong(Box::new(Wrong {
                correct: vec![crate::numbers::decimal(wanted)],
                ..Wrong::default()
            })),
            Some(_) => Finding::Undecided { why: Unproved::NoPose },
            None => Finding::Undecided { why: Unproved::OpenReading },
        };
        let place = given.joint.is_none().then_some((k + 1, 1));
        Entry { place, span: moved(&number.span), finding, identities: vec![] }
    };
    let entries: Vec<Entry> = given.numbers.iter().enumerate().map(entry).collect();
    let (first, last) = (moved(&given.numbers[0].span), moved(&given.numbers[given.numbers.len() - 1].span));
    // From the name of it on.
    let before = &text[sentence.start..first.start];
    let named = before.trim_end_matches([' ', '(', '[', '$', '&', '{']);
    let start = match named.strip_suffix('=').filter(|_| given.joint.is_some()) {
        Some(name) => {
            let name = name.trim_end();
            let letters =
                name.chars().rev().take_while(|c| c.is_alphanumeric() || matches!(c, '_' | '{' | '}' | '\\'));
            sentence.start + name.len() - letters.map(char::len_utf8).sum::<usize>()
        }
        None => first.start,
    };
    let span = start..last.end;
    let name = text.get(span.clone()).unwrap_or_default().to_string();
    Claim {
        span,
        name,
        about: About::Dynamics(Dynamic::Torque),
        entries,
        instead: None,
        remarks: vec![],
        robot,
    }
}

/// The sentences of a text: a point within a number ends none.
pub(super) fn sentences(text: &str) -> Vec<Range<usize>> {
    let mut found = vec![];
    let mut start = 0;
    let bytes = text.as_bytes();
    for (at, c) in text.char_indices() {
        let ends = match c {
            '.' | '!' | '?' => bytes.get(at + 1).is_none_or(u8::is_ascii_whitespace),
            // A blank line.
            '\n' => bytes.get(at + 1).is_none_or(|b| *b == b'\n' || *b == b'\r'),
            _ => false,
        };
        if ends {
            found.push(start..at + 1);
            start = at + 1;
        }
    }
    found.push(start..text.len());
    found.retain(|s| s.len() < LONGEST && s.len() > 4);
    found
}

/// Marks of formulas that say nothing.
pub(super) fn skip(text: &str) -> &str {
    let mut text = text;
    loop {
        let before = text;
        text = text.trim_start_matches([' ', '$', '~', '{', '}', '&', '\n']);
        for mark in ["\\,", "\\;", "\\ ", "\\mathrm", "\\text", "\\rm", "\\left", "\\right"] {
            text = text.strip_prefix(mark).unwrap_or(text);
        }
        if text.len() == before.len() {
            return text;
        }
    }
}

/// A number at the beginning of a text, and its length.
pub(super) fn number(text: &str) -> Option<(f64, usize)> {
    let sign = text.chars().next().filter(|c| matches!(c, '-' | '−' | '–' | '+'));
    let start = sign.map_or(0, char::len_utf8);
    let rest = text[start..].trim_start();
    let start = text.len() - rest.len();
    let length = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
    let digits = rest[..length].trim_end_matches('.');
    let value: f64 = digits.parse().ok()?;
    let is_negative = sign.is_some_and(|c| c != '+');
    Some((if is_negative { -value } else { value }, start + digits.len()))
}

/// Whether a unit that begins a text is one of force and not of torque; nothing where none does.
fn is_force(text: &str) -> Option<bool> {
    let rest = skip(text).strip_prefix('N')?;
    let behind =
        ["·", "*", "\\cdot", "."].iter().fold(skip(rest), |t, mark| skip(t.strip_prefix(mark).unwrap_or(t)));
    let is_end = |t: &str| !t.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '/' | '^' | '²'));
    match behind.strip_prefix('m') {
        Some(rest) => is_end(rest).then_some(false),
        None => is_end(rest).then_some(true),
    }
}

/// The torques in a sentence: runs of numbers with a unit behind the last.
fn given(sentence: &str, n: usize) -> Vec<Given> {
    // All numbers, where they begin.
    let mut all: Vec<Number> = vec![];
    let mut at = 0;
    while at < sentence.len() {
        let here = &sentence[at..];
        let Some(c) = here.chars().next() else { break };
        let before = sentence[..at].trim_end_matches([' ', '$']).chars().next_back();
        let is_start = match c {
            '0'..='9' => !sentence[..at]
                .ends_with(|p: char| p.is_alphanumeric() || matches!(p, '_' | '.' | '^' | '{' | '₁' | '₂')),
            '-' | '−' | '–' => before.is_none_or(|p| !(p.is_alphanumeric() || matches!(p, ')' | '}'))),
            _ => false,
        };
        match number(here).filter(|_| is_start) {
            Some((value, length)) => {
                let span = at..at + length;
                all.push(Number { value, half: half_unit(&sentence[span.clone()]), span });
                at += length;
            }
            None => at += c.len_utf8(),
        }
    }
    let mut found: Vec<Given> = vec![];
    let mut used = 0;
    for k in 0..all.len() {
        let behind = sentence[all[k].span.end..].trim_start_matches([')', ']']);
        let Some(is_force) = is_force(behind) else { continue };
        // Numbers before it with nothing but signs of a list between.
        let mut first = k;
        while first > used && is_list(&sentence[all[first - 1].span.end..all[first].span.start]) {
            first -= 1;
        }
        used = k + 1;
        let numbers = all[first..=k].to_vec();
        let before = &sentence[..numbers[0].span.start];
        match named(before, n) {
            Some(joint) if numbers.len() == 1 || joint.is_none() => {
                found.push(Given { joint, is_force, numbers });
            }
            Some(_) => {}
            // `18.6 N m and 3.9 N m`
            None => match found.last_mut() {
                Some(Given { joint: None, is_force: same, numbers: known })
                    if *same == is_force
                        && known
                            .last()
                            .is_some_and(|l| is_list(&sentence[l.span.end..numbers[0].span.start])) =>
                {
                    known.extend(numbers);
                }
                _ => found.push(Given { joint: None, is_force, numbers }),
            },
        }
    }
    found
}

/// True for what stands between numbers of a list.
fn is_list(between: &str) -> bool {
    let plain = ["\\mathrm", "\\text", "\\,", "\\;", "$", "{", "}", "\\\\", "N m", "N·m", "Nm", "N\\,m"]
        .iter()
        .fold(between.to_string(), |t, mark| t.replace(mark, " "));
    plain
        .split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | '&'))
        .all(|w| matches!(w, "" | "and" | "und" | "et" | "y" | "e" | "respectively"))
}

/// The joint of a torque that is named before a text ends, `τ_1 =`: nothing of a vector.
fn named(before: &str, n: usize) -> Option<Option<usize>> {
    let before = before.trim_end_matches([' ', '$', '(', '[', '{', '&', '\\']);
    let before = before.strip_suffix("\\left").unwrap_or(before).trim_end_matches([' ', '(', '[']);
    let name = before.strip_suffix(['=', '≈']).or_else(|| before.strip_suffix("\\approx"))?;
    let name = name.trim_end_matches([' ', '$', '}', '&', '{']);
    let digits = name.chars().next_back()?;
    let joint = digits
        .to_digit(10)
        .or_else(|| denavit_symbolic::parse::subscript(digits).and_then(|c| c.to_digit(10)))
        .map(|d| d as usize);
    let letters = match joint {
        Some(_) => name[..name.len() - digits.len_utf8()].trim_end_matches(['_', '{', ' ']),
        None => name,
    };
    let is_torque =
        ["τ", "\\tau", "tau", "Γ", "\\Gamma", "Gamma", "M", "T", "F", "f", "Q", "u", "boldsymbol{\\tau"]
            .iter()
            .any(|t| letters.ends_with(t));
    match joint {
        _ if !is_torque => None,
        Some(k) if (1..=n).contains(&k) => Some(Some(k - 1)),
        Some(_) => None,
        None => Some(None),
    }
}

/// The state of the joints that a sentence says.
pub(super) fn state(sentence: &str, n: usize, kinds: &[JointKind]) -> State {
    let mut found = State::default();
    for (at, _) in sentence.match_indices('=') {
        let before = sentence[..at].trim_end_matches([' ', '$', '&', '}']);
        let Some((order, joint)) = variable(before, n) else { continue };
        let behind = skip(&sentence[at + 1..]);
        match joint {
            Some(j) => {
                if let Some(value) = quantity(behind, order, kinds[j]) {
                    found.values[order].insert(j, value.0);
                }
            }
            None => {
                let Some(inner) = behind.strip_prefix(['(', '[']) else { continue };
                let inner = inner.split([')', ']']).next().unwrap_or_default();
                let parts: Vec<&str> = inner.split([',', ';', '&']).collect();
                if parts.len() != n {
                    continue;
                }
                // One unit behind all.
                let is_shared = is_degrees(behind[1 + inner.len()..].trim_start_matches([')', ']']));
                let values: Option<Vec<f64>> = parts
                    .iter()
                    .zip(kinds)
                    .map(|(part, kind)| match number(skip(part)) {
                        Some((value, _)) if is_shared && *kind == JointKind::Revolute => {
                            Some(value.to_radians())
                        }
                        _ => quantity(skip(part), order, *kind).map(|q| q.0),
                    })
                    .collect();
                if let Some(values) = values {
                    found.values[order].extend(values.into_iter().enumerate());
                }
            }
        }
    }
    found
}

fn is_degrees(text: &str) -> bool {
    let text = skip(text);
    ["°", "deg", "\\degree", "^\\circ", "^{\\circ", "\\circ"].iter().any(|unit| text.starts_with(unit))
}

/// A joint variable that ends a text, its order (0 for q, 1 for q̇, 2 for q̈), and the joint; nothing of it for a vector.
fn variable(before: &str, n: usize) -> Option<(usize, Option<usize>)> {
    let last = before.chars().next_back()?;
    let joint = last
        .to_digit(10)
        .or_else(|| denavit_symbolic::parse::subscript(last).and_then(|c| c.to_digit(10)))
        .map(|d| d as usize);
    let name = match joint {
        Some(_) => before[..before.len() - last.len_utf8()].trim_end_matches(['_', '{', '}', ' ']),
        None => before,
    };
    let order = |name: &str| {
        let tail = &name[edge(name, name.len().saturating_sub(16))..];
        let tail = tail.rsplit([' ', '$', ',', ';', '(']).next().unwrap_or(tail);
        let is_double = tail.contains('\u{308}')
            || tail.contains("ddot")
            || tail.starts_with("dd")
            || tail.contains("qdd");
        let is_single =
            tail.contains('\u{307}') || tail.contains("dot") || tail.starts_with("dq") || tail.contains("qd");
        if is_double { 2 } else { usize::from(is_single) }
    };
    let plain = name.trim_end_matches(['\u{307}', '\u{308}', '}']);
    let is_variable = ["θ", "\\theta", "theta", "q", "ϑ", "φ", "\\varphi", "qd", "qdd", "d", "\\vartheta"]
        .iter()
        .any(|v| plain.ends_with(v));
    if !is_variable {
        return None;
    }
    match joint {
        Some(k) if (1..=n).contains(&k) => Some((order(name), Some(k - 1))),
        Some(_) => None,
        None => Some((order(name), None)),
    }
}

/// A value in radians or metres at the beginning of a text, and whether it has a unit.
fn quantity(text: &str, order: usize, kind: JointKind) -> Option<(f64, bool)> {
    let sign = text.chars().next().filter(|c| matches!(c, '-' | '−' | '–'));
    let rest = skip(sign.map_or(text, |c| &text[c.len_utf8()..]));
    let minus = if sign.is_some() { -1.0 } else { 1.0 };
    let (size, behind) = match number(rest) {
        Some((value, length)) => (value, &rest[length..]),
        None => (1.0, rest),
    };
    let is_pi = |t: &str| ["π", "\\pi", "pi"].into_iter().find(|p| t.starts_with(p));
    let behind = skip(behind);
    if let Some(pi) = is_pi(behind.trim_start_matches('*')) {
        let rest = skip(&behind.trim_start_matches('*')[pi.len()..]);
        let by = rest.strip_prefix('/').and_then(|r| number(skip(r))).map_or(1.0, |d| d.0);
        return Some((minus * size * std::f64::consts::PI / by, true));
    }
    number(rest)?;
    if kind == JointKind::Prismatic {
        let scale =
            [("mm", 1e-3), ("cm", 1e-2), ("m", 1.0)].into_iter().find(|(unit, _)| behind.starts_with(unit));
        return Some((minus * size * scale.map_or(1.0, |s| s.1), scale.is_some()));
    }
    if is_degrees(behind) {
        return Some((minus * size.to_radians(), true));
    }
    // Whole turns and more are no radians.
    let has_unit = behind.starts_with("rad");
    (order > 0 || has_unit || size.abs() < 6.5).then_some((minus * size, has_unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLANE: [JointKind; 2] = [JointKind::Revolute; 2];

    #[test]
    fn states_are_read() {
        use std::f64::consts::PI;
        for (text, q, qd) in [
            ("At q = (0, 0), at rest,", &[0.0, 0.0][..], &[][..]),
            ("For θ1 = 0, θ2 = 90° the torques", &[0.0, PI / 2.0], &[]),
            ("for $\\theta_1 = 30^\\circ$ and $\\theta_2 = -\\pi/2$", &[PI / 6.0, -PI / 2.0], &[]),
            ("with q = (30, 60)° and q̇ = (1, -2) rad/s", &[PI / 6.0, PI / 3.0], &[1.0, -2.0]),
            ("with $\\dot\\theta_1 = 1.5$ rad/s, $\\dot\\theta_2 = 0$", &[], &[1.5, 0.0]),
            ("l1 = 0.5 m, m2 = 1 kg", &[], &[]),
        ] {
            let found = state(text, 2, &PLANE);
            let values = |k: usize| found.values[k].values().copied().collect::<Vec<f64>>();
            let near = |a: &[f64], b: &[f64]| {
                a.len() == b.len() && a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9)
            };
            assert!(near(&values(0), q) && near(&values(1), qd), "{text}: {found:?}");
        }
    }

    #[test]
    fn torques_are_read() {
        for (text, expected) in [
            ("the torques are 18.639 N m and 3.924 N m", &[(None, &[18.639, 3.924][..])][..]),
            ("τ1 = 14.715 N m and τ2 = 0 N m", &[(Some(0), &[14.715]), (Some(1), &[0.0])]),
            ("are τ = (14.715, −0.5) N m", &[(None, &[14.715, -0.5])]),
            ("$\\tau_1 = 14.7\\,\\mathrm{N\\,m}$", &[(Some(0), &[14.7])]),
            ("a mass of 2 kg at 0.5 m", &[]),
            ("a force of 5 N/m", &[]),
        ] {
            let found: Vec<(Option<usize>, Vec<f64>)> = given(text, 2)
                .into_iter()
                .map(|g| (g.joint, g.numbers.iter().map(|x| x.value).collect()))
                .collect();
            let expected: Vec<(Option<usize>, Vec<f64>)> =
                expected.iter().map(|(j, all)| (*j, all.to_vec())).collect();
            assert_eq!(found, expected, "{text}");
        }
    }
}
