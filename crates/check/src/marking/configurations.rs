//! All configurations for a pose, in numbers: what a document says of the joints is held against those that a rubric knows.
//!
//! A configuration is read out of a line or lines with a value for each joint, `θ1 = 75°, θ2 = -105°, …`, a list behind a name of the
//! joints, `q = (75°, -105°, …)`, or a row of a table with a column for each joint; in degrees or radians, within rounding. It is called
//! wrong only beside another that is right: else it may be no answer, and is marked by hand.

use super::flat::{Flat, Unit, Value};
use super::{Asked, Rubric};
use crate::outcome::{Checked, Skipped, Unjudged};
use crate::plan::kind_of_tables;
use crate::values_asked::{Answered, ValueSlip};
use denavit::description::table::grids;
use denavit::description::{Description, JointKind};
use denavit::robot::Robot;
use denavit_reading::document::Format;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Angles (radians) and slides (metres) agree within this, and this share of them.
const LEAST: [f64; 2] = [5e-4, 1e-4];
const SHARE: f64 = 1e-3;
/// Values further apart than these characters are not of one configuration.
const APART: usize = 60;
/// No more of a text is shown as a name.
const SHOWN: usize = 60;

/// Values for all joints, in their order.
struct Told {
    span: Range<usize>,
    values: Vec<Value>,
}

/// Values that one joint is said to have.
struct Single {
    joint: usize,
    span: Range<usize>,
    values: Vec<Value>,
    /// Characters.
    place: Range<usize>,
}

/// Holds the configurations of a text against those of the items.
pub(super) fn answer(rubric: &Rubric, text: &str, format: Format, checked: &mut Checked) {
    let Some(robot) = checked.robots.first().cloned() else { return };
    let kinds: Vec<JointKind> = robot.variables().iter().map(|v| v.kind).collect();
    for (at, item) in rubric.items.iter().enumerate() {
        let fits = |asked: &Asked| asked.q.len() == kinds.len() && asked.within.len() == kinds.len();
        if item.configurations.is_empty() || !item.configurations.iter().all(fits) {
            continue;
        }
        let (told, singles) = told(text, format, &kinds);
        let asked = &item.configurations;
        let matched: Vec<Option<usize>> =
            told.iter().map(|t| asked.iter().position(|a| is_it(t, a, &kinds))).collect();
        if matched.iter().all(Option::is_none) {
            // None of them may be meant as an answer.
            let is_said = |span: &Range<usize>| {
                let spans = checked.claims.iter().map(|c| &c.span);
                let mut spans = spans.chain(checked.unjudged.iter().map(|u| &u.span));
                spans.any(|s| touch(s, span))
            };
            let open: Vec<Unjudged> = told
                .iter()
                .filter(|t| !is_said(&t.span))
                .map(|t| Unjudged { span: t.span.clone(), why: Skipped::SaysNothing })
                .collect();
            checked.unjudged.extend(open);
            checked.unjudged.sort_by_key(|u| (u.span.start, u.span.end));
            continue;
        }
        let mut taken: Vec<bool> = (0..asked.len()).map(|k| matched.contains(&Some(k))).collect();
        let mut is_told = vec![false; asked.len()];
        let mut found = vec![];
        for (t, own) in told.iter().zip(&matched) {
            let (k, slip) = match own {
                Some(k) => (*k, None),
                None => {
                    let (k, slip) = nearest(t, asked, &taken, &kinds);
                    taken[k] = true;
                    (k, Some(slip))
                }
            };
            // What is said twice counts once.
            let is_new = slip.is_some() || !std::mem::replace(&mut is_told[k], true);
            let source = text.get(t.span.clone()).unwrap_or_default();
            found.push(Answered {
                of: [at, item.answers.len() + k],
                span: t.span.clone(),
                name: source.split_whitespace().collect::<Vec<_>>().join(" ").chars().take(SHOWN).collect(),
                slip,
                right: shown(&asked[k].q, &kinds),
                counts: if is_new { kinds.len() } else { 0 },
            });
        }
        // Values of one joint, all of them in some configuration.
        let in_some = |single: &Single| {
            let is = |v: &Value| asked.iter().any(|a| agrees(v, single.joint, a, &kinds, None));
            single.values.iter().all(is)
        };
        let mut spans: Vec<Range<usize>> = found.iter().map(|a| a.span.clone()).collect();
        spans.extend(singles.iter().filter(|s| in_some(s)).map(|s| s.span.clone()));
        let goals = coordinates(&robot, asked);
        let is_goal = |span: &Range<usize>| is_goal(text.get(span.clone()).unwrap_or_default(), &goals);
        checked.unjudged.retain(|u| !spans.iter().any(|s| touch(s, &u.span)) && !is_goal(&u.span));
        let gone: Vec<bool> =
            checked.claims.iter().map(|c| spans.iter().any(|s| touch(s, &c.span))).collect();
        checked.leave_out(&gone);
        checked.answered.extend(found);
    }
}

fn touch(a: &Range<usize>, b: &Range<usize>) -> bool {
    a.start < b.end && b.start < a.end
}

/// The configurations of a text, and values of single joints.
fn told(text: &str, format: Format, kinds: &[JointKind]) -> (Vec<Told>, Vec<Single>) {
    let flat = Flat::of(text);
    let mut found = tables(text, format, kinds);
    let is_free = |span: &Range<usize>, found: &[Told]| !found.iter().any(|t| touch(&t.span, span));
    for at in 0..flat.chars.len() {
        if let Some((values, end)) = flat.tuple(at, kinds.len())
            && let Some(start) = named(&flat, at, &values)
        {
            let span = flat.span(&(start..end));
            if is_free(&span, &found) {
                found.push(Told { span, values });
            }
        }
    }
    let singles: Vec<Single> =
        singles(&flat, kinds).into_iter().filter(|s| is_free(&s.span, &found)).collect();
    let mut group: Vec<&Single> = vec![];
    let mut grouped: Vec<Vec<&Single>> = vec![];
    for single in &singles {
        let goes_on = group.last().is_some_and(|last| {
            let between = flat.chars.get(last.place.end..single.place.start).unwrap_or_default();
            between.len() < APART && between.iter().filter(|c| **c == '\n').count() <= 2
        });
        if !goes_on || group.len() == kinds.len() || group.iter().any(|s| s.joint == single.joint) {
            grouped.push(std::mem::take(&mut group));
        }
        if single.values.len() == 1 {
            group.push(single);
        }
    }
    grouped.push(group);
    for mut group in grouped.into_iter().filter(|g| g.len() == kinds.len()) {
        let span = group[0].span.start..group[group.len() - 1].span.end;
        group.sort_by_key(|s| s.joint);
        found.push(Told { span, values: group.iter().map(|s| s.values[0]).collect() });
    }
    found.sort_by_key(|t| t.span.start);
    (found, singles)
}

/// Statements about one joint each.
fn singles(flat: &Flat, kinds: &[JointKind]) -> Vec<Single> {
    let mut found = vec![];
    for at in 0..flat.chars.len() {
        let Some((joint, end)) = flat.joint(at, |k| is_slide(kinds, k)).filter(|j| j.0 <= kinds.len()) else {
            continue;
        };
        let sign = flat.skip_blanks(end);
        if !matches!(flat.get(sign), '=' | '∈' | ':') {
            continue;
        }
        let (values, end) = flat.values(sign + 1);
        if !values.is_empty() {
            found.push(Single { joint: joint - 1, span: flat.span(&(at..end)), values, place: at..end });
        }
    }
    found
}

pub(super) fn is_slide(kinds: &[JointKind], number: usize) -> bool {
    kinds.get(number - 1) == Some(&JointKind::Prismatic)
}

/// Where a list of values begins that says it is of the joints: its name, or brackets with angles; nothing of other lists.
fn named(flat: &Flat, at: usize, values: &[Value]) -> Option<usize> {
    let line = flat.chars[..at].iter().rposition(|c| *c == '\n').map_or(0, |k| k + 1);
    let before: String = flat.chars[line..at].iter().collect();
    let has_angle = values.iter().any(|v| matches!(v.unit, Unit::Degrees | Unit::Radians));
    let Some(left) = before.trim_end().strip_suffix('=') else {
        let has_letters = before.chars().any(char::is_alphabetic);
        return (has_angle || !has_letters).then_some(at);
    };
    let left = left.trim_end();
    let start = match left.strip_suffix([')', ']']) {
        Some(inner) => inner.rfind(['(', '[']).unwrap_or(0),
        None => left.rfind([' ', ',', ';', ':', '>']).map_or(0, |k| k + 1),
    };
    let mut bare = left[start..].trim_start_matches(['(', '[']);
    for mark in ["\\vec", "\\boldsymbol", "\\bm", "\\underline", "\\bar", "\\"] {
        bare = bare.strip_prefix(mark).unwrap_or(bare).trim_start();
    }
    let is_joints = ["q", "Q", "θ", "Θ", "Theta", "theta"].iter().any(|w| bare.starts_with(w));
    let characters = left[..start].chars().count();
    (is_joints || (has_angle && !bare.starts_with(['p', 'P', 'T']))).then_some(line + characters)
}

/// The rows of tables, or their columns, with a value for each joint.
fn tables(text: &str, format: Format, kinds: &[JointKind]) -> Vec<Told> {
    let mut found = vec![];
    for grid in grids(text, kind_of_tables(format)) {
        let width = grid.first().map_or(0, Vec::len);
        let is_even = grid.iter().all(|row| row.len() == width);
        let side = || (0..width).map(|c| grid.iter().map(|row| row[c].clone()).collect()).collect();
        let sides: Vec<Vec<_>> = if is_even { vec![side()] } else { vec![] };
        for grid in std::iter::once(grid.clone()).chain(sides) {
            let Some((heads, rows)) = grid.split_first() else { continue };
            let column = |k: usize| {
                let mut all = heads.iter().enumerate().filter_map(|(c, head)| {
                    let flat = Flat::of(&head.0);
                    let at = flat.skip_blanks(0);
                    let (joint, end) = flat.joint(at, |k| is_slide(kinds, k))?;
                    let rest: String = flat.chars[end..].iter().collect();
                    (joint == k + 1).then(|| (c, unit(&rest)))
                });
                all.next()
            };
            let Some(columns) = (0..kinds.len()).map(column).collect::<Option<Vec<_>>>() else { continue };
            for row in rows {
                let value = |(c, unit): &(usize, Unit)| {
                    let flat = Flat::of(&row.get(*c)?.0);
                    let (value, end) = flat.value(0, true)?;
                    let own = if value.unit == Unit::None { *unit } else { value.unit };
                    (flat.skip_blanks(end) >= flat.chars.len()).then_some(Value { unit: own, ..value })
                };
                let Some(values) = columns.iter().map(value).collect::<Option<Vec<_>>>() else { continue };
                let places = row.iter().map(|c| &c.1).filter(|p| !p.is_empty());
                let (start, end) = places.fold((usize::MAX, 0), |(s, e), p| (s.min(p.start), e.max(p.end)));
                found.push(Told { span: start.min(end)..end, values });
            }
        }
    }
    found
}

/// The unit that stands behind a name in the head of a table.
fn unit(rest: &str) -> Unit {
    let units = [
        ("°", Unit::Degrees),
        ("deg", Unit::Degrees),
        ("rad", Unit::Radians),
        ("mm", Unit::Millimetres),
        ("cm", Unit::Centimetres),
        ("m", Unit::Metres),
    ];
    units.iter().find(|(w, _)| rest.contains(w)).map_or(Unit::None, |u| u.1)
}

/// Factors to radians or metres, for all joints of a configuration together; of values that say their unit there is but one.
const SENSES: [[f64; 2]; 4] = [[PI / 180.0, 1.0], [1.0, 1.0], [PI / 180.0, 1e-3], [1.0, 1e-3]];

/// Whether a value is that of a joint in a configuration, in one sense of numbers without unit, or in any.
fn agrees(v: &Value, joint: usize, asked: &Asked, kinds: &[JointKind], sense: Option<[f64; 2]>) -> bool {
    let is_slide = kinds[joint] == JointKind::Prismatic;
    let factors: Vec<f64> = match (v.unit, sense) {
        (Unit::Degrees, _) => vec![PI / 180.0],
        (Unit::Radians | Unit::Metres, _) => vec![1.0],
        (Unit::Centimetres, _) => vec![1e-2],
        (Unit::Millimetres, _) => vec![1e-3],
        (Unit::None, Some(sense)) => vec![sense[usize::from(is_slide)]],
        (Unit::None, None) => SENSES.iter().map(|s| s[usize::from(is_slide)]).collect(),
    };
    let is_of_kind = match v.unit {
        Unit::None => true,
        Unit::Degrees | Unit::Radians => !is_slide,
        _ => is_slide,
    };
    let (x, within) = (asked.q[joint], asked.within[joint]);
    is_of_kind
        && factors.iter().any(|factor| {
            let off = v.number * factor - x;
            let off = if is_slide { off } else { off - TAU * (off / TAU).round() };
            let least = LEAST[usize::from(is_slide)];
            off.abs() <= within + least + SHARE * x.abs() + 0.6 * v.digit * factor
        })
}

/// Whether a configuration is one that is asked for.
fn is_it(told: &Told, asked: &Asked, kinds: &[JointKind]) -> bool {
    SENSES.iter().any(|sense| agreeing(told, asked, kinds, *sense) == kinds.len())
}

/// How many joints agree.
fn agreeing(told: &Told, asked: &Asked, kinds: &[JointKind], sense: [f64; 2]) -> usize {
    let values = told.values.iter().enumerate();
    values.filter(|(k, v)| agrees(v, *k, asked, kinds, Some(sense))).count()
}

/// The configuration that one that is wrong is nearest to, one that nobody has yet if there is one, and how it differs.
fn nearest(told: &Told, asked: &[Asked], taken: &[bool], kinds: &[JointKind]) -> (usize, ValueSlip) {
    let all = (0..asked.len()).flat_map(|k| SENSES.iter().map(move |s| (k, *s)));
    let best = all.max_by_key(|&(k, sense)| (!taken[k], agreeing(told, &asked[k], kinds, sense)));
    let (k, sense) = best.unwrap_or((0, SENSES[0]));
    let is_sign = told.values.iter().enumerate().all(|(joint, v)| {
        let opposite = Value { number: -v.number, ..*v };
        [*v, opposite].iter().any(|v| agrees(v, joint, &asked[k], kinds, Some(sense)))
    });
    (k, if is_sign { ValueSlip::Sign } else { ValueSlip::Other })
}

/// A configuration in degrees and metres.
fn shown(q: &[f64], kinds: &[JointKind]) -> String {
    let value = |(x, kind): (&f64, &JointKind)| match kind {
        JointKind::Revolute => format!("{}°", crate::decimal((x.to_degrees() * 100.0).round() / 100.0)),
        JointKind::Prismatic => format!("{} m", crate::decimal((x * 1e4).round() / 1e4)),
    };
    format!("({})", q.iter().zip(kinds).map(value).collect::<Vec<_>>().join(", "))
}

/// The coordinates of the tool at the configurations.
fn coordinates(robot: &Description, asked: &[Asked]) -> Vec<f64> {
    let Ok(robot) = Robot::numeric(robot) else { return vec![] };
    asked.iter().flat_map(|a| robot.pose(&a.q).translation.0).collect()
}

/// Whether a line says nothing but coordinates of the goal.
fn is_goal(line: &str, goals: &[f64]) -> bool {
    let flat = Flat::of(line);
    let Some(equal) = flat.chars.iter().position(|c| *c == '=') else { return false };
    let left: String = flat.chars[..equal].iter().filter(|c| c.is_alphanumeric()).collect();
    let is_place = ["p", "P", "x", "y", "z"].iter().any(|w| left.starts_with(w));
    let at = flat.skip_blanks(equal + 1);
    let values = (2..=3).find_map(|n| flat.tuple(at, n)).map(|t| t.0);
    let values = values.unwrap_or_else(|| flat.values(at).0);
    let is_one = |v: &Value| {
        let factor = if v.unit == Unit::Millimetres { 1e-3 } else { 1.0 };
        goals.iter().any(|x| (v.number * factor - x).abs() <= 0.6 * v.digit * factor + 1e-9)
    };
    is_place && !values.is_empty() && values.iter().all(is_one)
}
