//! Numbers for what a document has a formula for, `M_{11} = 0.995` at a configuration that the words before it state.
//!
//! They are held against the arm as the formulas are read. What agrees with its digits is right; what does not is wrong where the
//! configuration stands directly before it, and the author's own formula does not give it either.

use super::attempt::Attempt;
use super::kind;
use super::spoken_torques::{Reading, State, number, sentences, skip, state};
use super::statements::{formula_span, lone_name, word};
use crate::facts::{About, Unproved};
use crate::numbers::{decimal, half_unit};
use crate::outcome::{Claim, Entry, Finding, Wrong};
use crate::subject::Subject;
use denavit::description::JointKind;
use denavit_reading::document::Statement;
use std::ops::Range;

/// Judges the statements that give numbers.
pub(super) fn judged(
    text: &str,
    all: &[Statement],
    subject: &Subject,
    attempt: &Attempt,
    robot: usize,
) -> Vec<Claim> {
    let Some(reading) = Reading::new(text, subject, attempt).filter(|r| !r.is_open()) else { return vec![] };
    let Some(model) = attempt.model(subject, 0) else { return vec![] };
    let n = attempt.model.state.q.len();
    let kinds: Vec<JointKind> = subject.description.variables().iter().map(|v| v.kind).collect();
    let states: Vec<(Range<usize>, State)> = sentences(text)
        .into_iter()
        .map(|s| (s.clone(), state(&text[s], n, &kinds)))
        .filter(|(_, s)| (0..n).all(|j| s.values[0].contains_key(&j)))
        .collect();
    let name = |s: &Statement| Some(word(&lone_name(text, &formula_span(s.sides.first()?)?)?));
    let mut claims = vec![];
    for statement in all {
        let [left, right] = &statement.sides[..] else { continue };
        let (Some(own), Some(source)) = (name(statement), text.get(right.span.clone())) else { continue };
        let start = right.span.end - skip(source).len();
        let Some((value, length)) = number(&text[start..right.span.end]) else { continue };
        let digits = start..start + length;
        let is_lone = is_unit(&text[digits.end..right.span.end]);
        let printed = attempt.read.pieces.iter().find(|p| {
            p.place.is_none()
                && p.candidates.len() == 1
                && !p.value.symbols().is_empty()
                && all.get(p.statement).and_then(name).is_some_and(|w| w == own)
        });
        let Some(piece) = printed.filter(|_| is_lone) else { continue };
        let quantity = piece.candidates[0];
        let Some((sentence, at)) = states.iter().rev().find(|s| s.0.start <= left.span.start) else {
            continue;
        };
        if quantity.is_up_to_constant() {
            continue;
        }
        let Some(wanted) = model.value(quantity).and_then(|e| reading.number(e, at)) else { continue };
        let half = half_unit(&text[digits.clone()]);
        let near = |x: f64| (x - value).abs() <= 1.02 * half + 1e-9 * x.abs();
        let is_theirs = reading.number(piece.value, at).is_some_and(near);
        let between = text.get(sentence.end..statement.span.start);
        let is_told = statement.span.end <= sentence.end
            || between.is_some_and(|b| b.trim_matches([' ', '\n', '\r', '$', '&']).is_empty() || is_list(b))
                && text[sentence.clone()].trim_end().ends_with(':');
        let finding = match () {
            () if near(wanted) => Finding::Equal { unless_zero: vec![] },
            () if is_told && !is_theirs => {
                Finding::Wrong(Box::new(Wrong { correct: vec![decimal(wanted)], ..Wrong::default() }))
            }
            () => Finding::Undecided { why: Unproved::NoPose },
        };
        claims.push(Claim {
            span: statement.span.clone(),
            name: text.get(left.span.clone()).unwrap_or_default().trim().to_string(),
            about: About::Dynamics(kind(quantity)),
            entries: vec![Entry { place: None, span: right.span.clone(), finding, identities: vec![] }],
            instead: None,
            remarks: vec![],
            robot,
        });
    }
    claims
}

/// True for a unit alone, or nothing.
fn is_unit(behind: &str) -> bool {
    const LOOKS: [&str; 6] = ["\\mathrm", "\\text", "\\,", "\\;", "{", "}"];
    let bare = LOOKS.iter().fold(behind.to_string(), |b, look| b.replace(look, ""));
    let bare = bare.trim_matches([' ', '$', '~', ',', '.', ';']);
    bare.is_empty() || bare.starts_with(['N', 'k']) && !bare.contains(['/', '+', '-', '='])
}

/// True for a list of other numbers alone: names, signs and digits, and no words.
fn is_list(between: &str) -> bool {
    const LONGEST: usize = 400;
    let looks = ["qquad", "quad", "text", "mathrm", "dot", "tau", "theta", "Gamma"];
    let plain = looks.iter().fold(between.to_string(), |b, look| b.replace(look, " "));
    between.len() < LONGEST && plain.split(|c: char| !c.is_alphabetic()).all(|w| w.chars().count() <= 2)
}
