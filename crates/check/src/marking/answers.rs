//! Answers that a rubric knows by their values: numbers, and functions of the time, which say nothing of the robot by themselves.
//!
//! A statement whose left side is an answer's name is held against it, if its right side is made of the same letters: in any
//! equivalent form, in degrees or radians, within a unit of the last printed digit. What is made of other letters is left
//! to the check of the robot.

use super::{Item, Rubric, fits, plain};
use crate::outcome::{Checked, Finding};
use crate::respelling;
use crate::values_asked::{Answer, Answered, ValueSlip};
use denavit_reading::document::{Document, Format, Side, Statement, read};
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};
use std::collections::BTreeSet;
use std::ops::Range;

/// Where functions of a letter are compared.
const SAMPLES: [f64; 6] = [0.0, 0.37, 0.81, 1.13, 1.69, 2.3];
/// Coefficients of functions and computed values agree within this share.
const AGREE: f64 = 2e-3;
/// What is behind a number and may be its unit, bytes.
const BEHIND: usize = 24;

/// A right side that could be read.
struct Given {
    value: Expr,
    unit: Option<&'static Unit>,
    /// A unit of the last printed digit, of a plain number.
    digit: Option<f64>,
}

/// A unit, and its size in the first of its kind.
struct Unit {
    names: &'static [&'static str],
    kind: char,
    size: f64,
}

const fn unit(names: &'static [&'static str], kind: char, size: f64) -> Unit {
    Unit { names, kind, size }
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Longer names first: a unit is the first that fits.
static UNITS: [Unit; 24] = [
    unit(&["rad/s^2", "rad/s²", "rad/s2", "rads^-2"], 'c', 1.0),
    unit(&["°/s^2", "°/s²", "°/s2", "deg/s^2", "deg/s²"], 'c', DEGREE),
    unit(&["rad/s", "rads^-1"], 'w', 1.0),
    unit(&["°/s", "deg/s"], 'w', DEGREE),
    unit(&["m/s^2", "m/s²"], 'e', 1.0),
    unit(&["cm/s"], 'v', 0.01),
    unit(&["mm/s"], 'v', 0.001),
    unit(&["m/s"], 'v', 1.0),
    unit(&["kNm", "kN·m"], 't', 1000.0),
    unit(&["Nm", "N·m", "N.m", "N*m", "N⋅m", "N-m"], 't', 1.0),
    unit(&["kN"], 'f', 1000.0),
    unit(&["N"], 'f', 1.0),
    unit(&["rad"], 'a', 1.0),
    unit(&["°", "deg", "degrees", "degrés"], 'a', DEGREE),
    unit(&["mm"], 'l', 0.001),
    unit(&["cm"], 'l', 0.01),
    unit(&["ms"], 's', 0.001),
    unit(&["min"], 's', 60.0),
    unit(&["m"], 'l', 1.0),
    unit(&["sec", "seconds", "secondes"], 's', 1.0),
    unit(&["s"], 's', 1.0),
    unit(&["kg"], 'k', 1.0),
    unit(&["W"], 'p', 1.0),
    unit(&["J"], 'j', 1.0),
];

/// The unit that a text begins with, marks of LaTeX left aside.
fn unit_of(text: &str) -> Option<&'static Unit> {
    let mut bare = text.to_string();
    for (mark, is) in [
        ("\\text", ""),
        ("\\mathrm", ""),
        ("\\rm", ""),
        ("\\,", ""),
        ("\\;", ""),
        ("\\ ", ""),
        ("\\cdot", "·"),
        ("^{\\circ}", "°"),
        ("^\\circ", "°"),
        ("\\circ", "°"),
        ("\\degree", "°"),
    ] {
        bare = bare.replace(mark, is);
    }
    bare.retain(|c| !matches!(c, '{' | '}' | '$' | '[' | '('));
    UNITS.iter().find(|u| u.names.iter().any(|name| begins_with(&bare, name)))
}

/// Whether a text begins with a unit, which may have blanks in it and ends there.
fn begins_with(text: &str, unit: &str) -> bool {
    let is_blank = |c: &char| c.is_whitespace() || *c == '~';
    let mut rest = text.chars().peekable();
    for wanted in unit.chars() {
        while rest.next_if(is_blank).is_some() {}
        if rest.next() != Some(wanted) {
            return false;
        }
    }
    !rest.peek().is_some_and(|c| c.is_alphanumeric() || *c == '/')
}

/// Holds the statements of a text against the answers of a rubric, and takes what was judged so out of what is said otherwise.
pub fn answer(rubric: &Rubric, text: &str, format: Format, checked: &mut Checked) {
    if rubric.items.iter().all(|item| item.answers.is_empty()) {
        return;
    }
    let text = &*respelling::with_points(text);
    let document = read(text, format);
    let mut found: Vec<Answered> = vec![];
    // A formula and its value in one line: the formula is left to the check of the robot.
    let mut alone: Vec<Range<usize>> = vec![];
    for (k, item) in rubric.items.iter().enumerate() {
        let mut done: Vec<bool> = vec![false; item.answers.len()];
        for (j, of) in item.answers.iter().enumerate() {
            if done[j] {
                continue;
            }
            // Answers of one name: those of several configurations, in their order.
            let alike: Vec<usize> =
                (j..item.answers.len()).filter(|&i| item.answers[i].names == of.names).collect();
            alike.iter().for_each(|&i| done[i] = true);
            for (answered, is_alone) in judged(k, &alike, item, text, &document) {
                alone.extend(is_alone.then(|| answered.span.clone()));
                found.push(answered);
            }
        }
    }
    found.sort_by_key(|a| (a.span.start, a.of));
    let touches = |span: &Range<usize>| alone.iter().any(|a| a.start < span.end && span.start < a.end);
    checked.unjudged.retain(|line| !touches(&line.span));
    let gone: Vec<bool> = checked.claims.iter().map(|c| touches(&c.span)).collect();
    checked.leave_out(&gone);
    checked.answered = found;
}

/// What statements say of answers of one name.
fn judged(
    item_at: usize,
    alike: &[usize],
    item: &Item,
    text: &str,
    document: &Document,
) -> Vec<(Answered, bool)> {
    let names: Vec<String> = item.answers[alike[0]].names.iter().map(|n| plain(n)).collect();
    let wanted: Vec<(usize, Expr, &Answer)> =
        alike.iter().filter_map(|&i| Some((i, formula(&item.answers[i].value)?, &item.answers[i]))).collect();
    let Some(first) = wanted.first() else { return vec![] };
    let letters: BTreeSet<Symbol> = first.1.symbols().into_iter().collect();
    let said: Vec<(&Statement, String, Given)> = document
        .statements
        .iter()
        .filter_map(|s| {
            let (name, given) = said(s, text, &names, &letters)?;
            Some((s, name, given))
        })
        .collect();
    let in_order = said.len() == wanted.len();
    let mut taken = vec![false; wanted.len()];
    let mut out = vec![];
    for (n, (statement, name, given)) in said.into_iter().enumerate() {
        let fits = |k: usize| slip(&wanted[k].1, &wanted[k].2.unit, &given).is_none();
        let k = match in_order {
            true => n,
            false => (0..wanted.len())
                .find(|&k| !taken[k] && fits(k))
                .or_else(|| (0..wanted.len()).find(|&k| fits(k)))
                .unwrap_or_else(|| taken.iter().position(|t| !t).unwrap_or(wanted.len() - 1)),
        };
        let slip = slip(&wanted[k].1, &wanted[k].2.unit, &given);
        taken[k] |= slip.is_none() || in_order;
        let right = format!("{} {}", wanted[k].2.value, wanted[k].2.unit).trim().to_string();
        let answered = Answered {
            of: [item_at, wanted[k].0],
            span: statement.span.clone(),
            name,
            slip,
            right,
            counts: 1,
            by_hand: false,
        };
        out.push((answered, statement.sides.len() == 2));
    }
    out
}

fn formula(text: &str) -> Option<Expr> {
    parse(text, &Vocabulary::new().open(true)).ok()
}

/// The name and the value of a statement about an answer with these names, if it is made of these letters.
fn said(
    statement: &Statement,
    text: &str,
    names: &[String],
    letters: &BTreeSet<Symbol>,
) -> Option<(String, Given)> {
    let source = |side: &Side| text.get(side.span.clone()).unwrap_or_default();
    let name = source(statement.sides.first()?);
    let bare = plain(&unwrapped(name));
    if statement.sides.len() < 2 || !names.iter().any(|pattern| fits(pattern, &bare)) {
        return None;
    }
    let last = statement.sides.last()?;
    let behind: String = text
        .get(last.span.end..)
        .unwrap_or_default()
        .chars()
        .take_while(|c| *c != '\n')
        .take(BEHIND)
        .collect();
    let given = given(source(last), &behind, letters)?;
    Some((name.trim().to_string(), given))
}

/// A left side without what says that it is a rate or a size: `|v_1|`.
fn unwrapped(name: &str) -> String {
    ["\\left", "\\right", "\\lvert", "\\rvert", "\\mathrm", "\\text", "\\max"]
        .iter()
        .fold(name.to_string(), |name, mark| name.replace(mark, if *mark == "\\max" { "max" } else { "" }))
}

/// A right side with the unit that stands in it or behind it.
fn given(source: &str, behind: &str, letters: &BTreeSet<Symbol>) -> Option<Given> {
    let source = source.trim().trim_end_matches(['.', ',', ';', ' ']);
    let (number, rest) = plain_number(source);
    if let Some((value, digit)) = number.filter(|_| rest.trim().is_empty() || unit_of(rest).is_some()) {
        if !letters.is_empty() {
            return None;
        }
        let unit = unit_of(rest).or_else(|| unit_of(behind));
        return Some(Given { value, unit, digit: Some(digit) });
    }
    // Where a formula ends and its unit begins: the longest formula that can be read.
    let cuts = source.char_indices().map(|(at, _)| at).chain([source.len()]).collect::<Vec<_>>();
    for &at in cuts.iter().rev().filter(|&&at| at > 0) {
        let (formula_text, rest) = source.split_at(at);
        let own = unit_of(rest);
        if !rest.trim().is_empty() && own.is_none() {
            continue;
        }
        let Some(value) = formula(formula_text) else { continue };
        let own_letters: BTreeSet<Symbol> = value.symbols().into_iter().collect();
        if own_letters == *letters {
            let unit = own.or_else(|| unit_of(behind));
            return Some(Given { value, unit, digit: None });
        }
    }
    None
}

/// A decimal number at the beginning of a text, with a unit of its last digit, and what stands behind it.
fn plain_number(text: &str) -> (Option<(Expr, f64)>, &str) {
    let bare = text.trim_start();
    let sign = bare.strip_prefix(['-', '−', '+']).unwrap_or(bare).trim_start();
    let is_negative = bare.starts_with(['-', '−']);
    let end = sign.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | ','))).unwrap_or(sign.len());
    let (digits, rest) = sign.split_at(end);
    // A comma of a list ends a number, one between digits is a decimal comma.
    let digits = digits.trim_end_matches([',', '.']);
    let decimal = digits.replace(',', ".");
    let Ok(size) = decimal.parse::<f64>() else { return (None, text) };
    let places = decimal.split_once('.').map_or(0, |(_, behind)| behind.len());
    let Some(value) = formula(&decimal) else { return (None, text) };
    let digit = 10f64.powi(-(places as i32));
    let value = if is_negative { -value } else { value };
    (size.is_finite().then_some((value, digit)), rest)
}

fn at(e: Expr, t: f64) -> Option<f64> {
    e.eval(|_| Some(t)).ok().filter(|x| x.is_finite())
}

/// What is wrong with what is given.
fn slip(wanted: &Expr, unit: &str, given: &Given) -> Option<ValueSlip> {
    let expected = unit_of(unit);
    let turns = |u: Option<&Unit>| u.is_some_and(|u| matches!(u.kind, 'a' | 'w' | 'c'));
    // A number without unit is in the unit that is asked for; of an angle it may be in radians.
    let scale = match (expected, given.unit) {
        (Some(e), Some(g)) if e.kind == g.kind => g.size / e.size,
        // A function of the time in seconds that says degrees alone.
        _ => 1.0,
    };
    let samples: &[f64] = if wanted.symbols().is_empty() { &SAMPLES[..1] } else { &SAMPLES };
    let values: Option<Vec<[f64; 2]>> =
        samples.iter().map(|&t| Some([at(*wanted, t)?, at(given.value, t)? * scale])).collect();
    let Some(values) = values else { return Some(ValueSlip::Other) };
    let size = values.iter().map(|[w, _]| w.abs()).fold(0.0, f64::max);
    let room = given.digit.map_or(0.0, |d| d * scale * 1.001).max(AGREE * 0.5 * size).max(1e-9);
    let agree =
        |factor: f64| values.iter().all(|[w, g]| (w - g * factor).abs() <= room * factor.abs().max(1.0));
    // From the other unit of angles into that which is asked for.
    let other = if expected.is_some_and(|u| u.size < 1.0) { 1.0 / DEGREE } else { DEGREE };
    let is_free = given.unit.is_none() && turns(expected) && size > 1e-6;
    if agree(1.0) || (is_free && agree(other)) {
        return None;
    }
    if agree(-1.0) {
        return Some(ValueSlip::Sign);
    }
    if turns(expected) && (agree(DEGREE) || agree(1.0 / DEGREE)) {
        return Some(ValueSlip::AngleUnit);
    }
    if [10.0, 100.0, 1000.0].iter().any(|f| agree(*f) || agree(1.0 / f)) {
        return Some(ValueSlip::PowerOfTen);
    }
    if [2.0, 3.0, 1.5, 4.0].iter().any(|f| agree(*f) || agree(-f) || agree(1.0 / f) || agree(-1.0 / f)) {
        return Some(ValueSlip::Factor);
    }
    Some(term(&values, samples, room).map_or(ValueSlip::Other, ValueSlip::Term))
}

/// The power of the letter in the one term that differs.
fn term(values: &[[f64; 2]], samples: &[f64], room: f64) -> Option<usize> {
    if samples.len() < 2 {
        return None;
    }
    let off: Vec<f64> = values.iter().map(|[w, g]| g - w).collect();
    (0..samples.len()).find(|&n| {
        let basis: Vec<f64> = samples.iter().map(|t| t.powi(n as i32)).collect();
        let by = off[3] / basis[3];
        off.iter().zip(&basis).all(|(o, b)| (o - by * b).abs() <= room)
    })
}

impl Checked {
    /// Takes claims out; those on which others rest as the cause of an error stay.
    pub(super) fn leave_out(&mut self, gone: &[bool]) {
        let mut causes: BTreeSet<usize> = BTreeSet::new();
        for (claim, gone) in self.claims.iter().zip(gone) {
            for entry in claim.entries.iter().filter(|_| !gone) {
                if let Finding::Carried { by, .. } = &entry.finding {
                    causes.insert(*by);
                }
            }
        }
        let stays: Vec<bool> = gone.iter().enumerate().map(|(k, g)| !g || causes.contains(&k)).collect();
        let place: Vec<usize> = stays
            .iter()
            .scan(0, |next, s| {
                let at = *next;
                *next += usize::from(*s);
                Some(at)
            })
            .collect();
        let mut keep = stays.iter();
        self.claims.retain(|_| keep.next().copied().unwrap_or(true));
        for entry in self.claims.iter_mut().flat_map(|c| &mut c.entries) {
            if let Finding::Carried { by, .. } = &mut entry.finding {
                *by = place.get(*by).copied().unwrap_or(*by);
            }
        }
        for cause in &mut self.causes {
            for list in [&mut cause.turns_right, &mut cause.turns_wrong, &mut cause.stays_wrong] {
                list.retain(|at| stays.get(at.0).copied().unwrap_or(true));
                list.iter_mut().for_each(|at| at.0 = place.get(at.0).copied().unwrap_or(at.0));
            }
        }
    }
}
