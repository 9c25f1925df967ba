//! Where an arm is singular: values of joints, sets of them and factors that are 0, held against the zeros that a rubric knows.

use super::configurations::is_slide;
use super::flat::{Flat, Unit, Value};
use super::{Rubric, plain, touch};
use crate::facts::About;
use crate::outcome::{Checked, Standing};
use crate::values_asked::{Answered, ValueSlip};
use denavit::description::{Description, JointKind};
use denavit_symbolic::Symbol;
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::ops::Range;

/// Values of joints agree within this; 3.14 is π.
const AGREE: f64 = 2e-3;

/// A value of a joint (from 0) at which the arm is singular.
struct Zero {
    joint: usize,
    value: f64,
}

/// Holds what a text says of singular configurations against the zeros of the items. What is not right by them is left to the check.
pub(super) fn answer(rubric: &Rubric, text: &str, checked: &mut Checked) {
    let Some(robot) = checked.robots.first().cloned() else { return };
    let kinds: Vec<JointKind> = robot.variables().iter().map(|v| v.kind).collect();
    for (at, item) in rubric.items.iter().enumerate() {
        let zero = |(joint, value): &(usize, String)| {
            let value = parse(value, &Vocabulary::new()).ok()?.eval(|_| None).ok()?;
            (1..=kinds.len()).contains(joint).then(|| Zero { joint: joint - 1, value })
        };
        let Some(zeros) = item.zeros.iter().map(zero).collect::<Option<Vec<Zero>>>() else { continue };
        if zeros.is_empty() {
            continue;
        }
        // What is said, and the zeros that it has.
        let mut said: Vec<Said> = spoken(text, &kinds, &zeros);
        for claim in &checked.claims {
            let is_right = claim.about == About::Singularity && claim.standing() == Standing::Equal;
            if is_right && !said.iter().any(|s| touch(&s.span, &claim.span)) {
                let of = covered(&claim.name, &robot, &zeros);
                if !of.is_empty() {
                    said.push(Said {
                        span: claim.span.clone(),
                        of,
                        is_sure: !is_denied(text, &claim.span),
                        slip: None,
                    });
                }
            }
        }
        said.sort_by_key(|s| s.span.start);
        let sure = || said.iter().filter(|s| s.is_sure).flat_map(|s| &s.of);
        let mut missing = zeros.len().saturating_sub(sure().collect::<BTreeSet<_>>().len());
        let mut done: BTreeSet<usize> = BTreeSet::new();
        for Said { span, of, is_sure, slip } in &said {
            let counts = match (is_sure, slip) {
                (true, None) => of.difference(&done).count(),
                (true, Some(_)) => 1,
                // It may be what is missing.
                (false, _) => of.len().max(1).min(missing),
            };
            match is_sure {
                true => done.extend(of),
                false => missing -= counts,
            }
            checked.answered.push(Answered {
                of: [at, item.answers.len()],
                span: span.clone(),
                name: text.get(span.clone()).unwrap_or_default().trim().to_string(),
                slip: *slip,
                right: if slip.is_some() { all(&item.zeros) } else { String::new() },
                counts,
                by_hand: !is_sure,
            });
        }
        let is_said = |span: &Range<usize>| said.iter().any(|s| touch(&s.span, span));
        checked.unjudged.retain(|u| !is_said(&u.span));
        let of_zeros = |c: &crate::outcome::Claim| {
            matches!(c.about, About::Singularity | About::Equation | About::Joint | About::Configuration)
        };
        let gone: Vec<bool> = checked.claims.iter().map(|c| of_zeros(c) && is_said(&c.span)).collect();
        checked.leave_out(&gone);
    }
}

/// What is said of where an arm is singular.
struct Said {
    span: Range<usize>,
    of: BTreeSet<usize>,
    /// Else a teacher looks at it.
    is_sure: bool,
    slip: Option<ValueSlip>,
}

/// Words that turn into its opposite what is said of a configuration.
const DENIED: [&str; 27] = [
    "not",
    "no",
    "never",
    "nor",
    "neither",
    "cannot",
    "isn",
    "doesn",
    "without",
    "regular",
    "nonsingular",
    "except",
    "unless",
    "nicht",
    "nie",
    "kein",
    "keine",
    "regulär",
    "ohne",
    "außer",
    "pas",
    "jamais",
    "régulier",
    "nunca",
    "non",
    "mai",
    "não",
];
/// Sentences are not looked through further, in bytes.
const LONGEST: usize = 400;

/// The sentence around a part of a text.
fn sentence(text: &str, span: &Range<usize>) -> Range<usize> {
    let marks = [". ", ".\n", "? ", "! ", "\n\n"];
    let near = (span.start.saturating_sub(LONGEST)..span.start).find(|&k| text.is_char_boundary(k));
    let far = (span.end..text.len().min(span.end + LONGEST)).rev().find(|&k| text.is_char_boundary(k));
    let (near, far) = (near.unwrap_or(span.start), far.unwrap_or(span.end));
    let start =
        marks.iter().filter_map(|m| text[near..span.start].rfind(m).map(|k| near + k + m.len())).max();
    let end = marks.iter().filter_map(|m| text[span.end..far].find(m).map(|k| span.end + k)).min();
    start.unwrap_or(near)..end.unwrap_or(far)
}

/// Whether the sentence around a part of a text may deny what it says.
fn is_denied(text: &str, span: &Range<usize>) -> bool {
    let lower = text[sentence(text, span)].to_lowercase();
    let mut words = lower.split(|c: char| !c.is_alphanumeric());
    words.any(|w| DENIED.contains(&w)) || ["≠", "\\ne", "!=", "<>"].iter().any(|m| lower.contains(m))
}

/// Whether the sentence around a part of a text speaks of singularities.
fn is_of_singularities(text: &str, span: &Range<usize>) -> bool {
    let lower = text[sentence(text, span)].to_lowercase();
    ["singul", "singol"].iter().any(|w| lower.contains(w))
}

/// The values at which an arm is singular, as people write them.
fn all(zeros: &[(usize, String)]) -> String {
    zeros.iter().map(|(joint, value)| format!("q{joint} = {value}")).collect::<Vec<_>>().join(", ")
}

/// Values that a text gives to joints, if the arm is singular at all of them; in a sentence about singularities others, too.
fn spoken(text: &str, kinds: &[JointKind], zeros: &[Zero]) -> Vec<Said> {
    let flat = Flat::of(text);
    let mut found: Vec<Said> = vec![];
    for at in 0..flat.chars.len() {
        let Some((joint, end)) = flat.joint(at, |k| is_slide(kinds, k)).filter(|j| j.0 <= kinds.len()) else {
            continue;
        };
        let sign = flat.skip_blanks(end);
        if !matches!(flat.get(sign), '=' | '∈') {
            continue;
        }
        let (values, end) = flat.values(sign + 1);
        let kind = kinds[joint - 1];
        let of: Option<Vec<Vec<usize>>> =
            values.iter().map(|v| zeros_of(v, joint - 1, kind, zeros)).collect();
        let span = flat.span(&(at..end));
        if let Some(of) = of.filter(|of| !of.is_empty()) {
            let is_sure = !is_denied(text, &span);
            found.push(Said { span, of: of.into_iter().flatten().collect(), is_sure, slip: None });
        } else if !values.is_empty() && is_of_singularities(text, &span) {
            // Of a joint at whose values the arm is singular another one is wrong, if that is all that is said.
            let is_known = zeros.iter().any(|z| z.joint == joint - 1);
            let slip = (is_known && !is_denied(text, &span)).then_some(ValueSlip::Other);
            found.push(Said { span, of: BTreeSet::new(), is_sure: slip.is_some(), slip });
        }
    }
    // Beside a right value of the same sentence it may be anything.
    let right = found.iter().filter(|s| s.slip.is_none());
    let right: Vec<usize> = right.map(|s| sentence(text, &s.span).start).collect();
    for said in found.iter_mut().filter(|s| s.slip.is_some()) {
        if right.contains(&sentence(text, &said.span).start) {
            (said.slip, said.is_sure) = (None, false);
        }
    }
    found
}

/// The zeros that a value of a joint is; nothing if the arm is not singular there.
fn zeros_of(v: &Value, joint: usize, kind: JointKind, zeros: &[Zero]) -> Option<Vec<usize>> {
    let is_slide = kind == JointKind::Prismatic;
    let at = |x: f64| {
        zeros.iter().position(|zero| {
            let off = x - zero.value;
            let off = if is_slide { off } else { off - TAU * (off / TAU).round() };
            zero.joint == joint && off.abs() < AGREE
        })
    };
    if let Some(step) = v.step {
        // All multiples of a part of a turn.
        let count = (TAU / step.abs()).round();
        if is_slide || !(1.0..=12.0).contains(&count) || (TAU / step.abs() - count).abs() > 1e-9 {
            return None;
        }
        return (0..count as usize).map(|k| at(k as f64 * step)).collect();
    }
    let in_degrees = v.unit == Unit::Degrees || (v.unit == Unit::None && v.number.abs() > TAU);
    let x = if in_degrees && !is_slide { v.number.to_radians() } else { v.number };
    at(x).map(|k| vec![k])
}

/// The zeros at which a factor vanishes, whatever the other joints are.
fn covered(factor: &str, robot: &Description, zeros: &[Zero]) -> BTreeSet<usize> {
    let Ok(value) = parse(factor, &robot.vocabulary().open(true)) else { return BTreeSet::new() };
    let variables = robot.variables();
    let joint = |s: Symbol| {
        let own = variables.iter().position(|v| v.symbol == s);
        own.or_else(|| {
            let name = plain(&s.name());
            let number = name.trim_start_matches(char::is_alphabetic);
            let is_joint = ["q", "theta", "th", "θ"].contains(&&name[..name.len() - number.len()]);
            let k: usize = number.parse().ok()?;
            (is_joint && (1..=variables.len()).contains(&k)).then(|| k - 1)
        })
    };
    let vanishes = |zero: &Zero| {
        (1..=3).all(|n| {
            let at = |s: Symbol| match joint(s) {
                Some(k) if k == zero.joint => Some(zero.value),
                Some(k) => Some(0.37 * n as f64 + 0.59 * k as f64 + 0.21),
                None => robot.value(s),
            };
            value.eval(at).is_ok_and(|x| x.abs() < 1e-9)
        })
    };
    (0..zeros.len()).filter(|&k| vanishes(&zeros[k])).collect()
}
