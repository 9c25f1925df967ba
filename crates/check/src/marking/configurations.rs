//! All configurations for a pose, in numbers: what a document says of the joints is held against those that a rubric knows.
//!
//! A configuration is read out of a line or lines with a value for each joint, `θ1 = 75°, θ2 = -105°, …`, a list behind a name of the
//! joints, `q = (75°, -105°, …)`, or a row of a table with a column for each joint; in degrees or radians, within rounding. It is called
//! wrong only beside another that is right, by itself and not in a sentence: else it may be no answer, and is marked by hand. So is one
//! below the heading of another pose than that which it is right for.

use super::flat::{Flat, Unit, Value};
use super::{Asked, Rubric, touch};
use crate::outcome::{Checked, Skipped, Unjudged};
use crate::plan::kind_of_tables;
use crate::values_asked::{Answered, ValueSlip};
use denavit::description::table::grids;
use denavit::description::{Description, JointKind};
use denavit::robot::Robot;
use denavit_reading::document::Format;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Angles (radians) and slides (metres) agree within this, and this share of them.
const LEAST: [f64; 2] = [5e-4, 1e-4];
const SHARE: f64 = 1e-3;
/// What a rounded last digit may make of turns (radians) and slides (metres): what is rounded more is marked by hand.
const ROUNDED: [f64; 2] = [0.02, 0.005];
/// Positions (metres) nearer than this are those of one pose.
const SAME: f64 = 1e-6;
/// Values further apart than these characters are not of one configuration.
const APART: usize = 60;
/// No more of a text is shown as a name.
const SHOWN: usize = 60;

/// Values for all joints, in their order.
struct Told {
    span: Range<usize>,
    values: Vec<Value>,
    /// A name or a unit says that they are of joints.
    is_of_joints: bool,
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
        let (mut told, singles) = told(text, format, &kinds);
        let asked = &item.configurations;
        let goals = coordinates(&robot, asked);
        let source = |span: &Range<usize>| text.get(span.clone()).unwrap_or_default();
        told.retain(|t| t.is_of_joints || !is_place(&t.values, &goals));
        let find = |t: &Told, is_rounded| asked.iter().position(|a| is_it(t, a, &kinds, is_rounded));
        let matched: Vec<Option<usize>> = told.iter().map(|t| find(t, false)).collect();
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
        let poses = poses(&robot, asked);
        let is_apart = elsewhere(text, &told, &matched, &poses, &goals);
        let mut taken: Vec<bool> = (0..asked.len()).map(|k| matched.contains(&Some(k))).collect();
        let is_there = |k: usize| matched.iter().zip(&is_apart).any(|(m, apart)| *m == Some(k) && !apart);
        // How many that are asked for nobody has told.
        let mut missing = (0..asked.len()).filter(|&k| !is_there(k)).count();
        let mut is_told = vec![false; asked.len()];
        let mut found = vec![];
        for ((t, own), apart) in told.iter().zip(&matched).zip(&is_apart) {
            let rounded = own.is_none().then(|| find(t, true)).flatten();
            let is_open = *apart
                || own.is_none() && (rounded.is_some() || !t.is_of_joints || is_in_sentence(text, &t.span));
            let (k, slip) = match own.or(rounded) {
                Some(k) => (k, None),
                None => {
                    let (k, slip) = nearest(t, asked, &taken, &kinds);
                    taken[k] |= !is_open;
                    (k, Some(slip).filter(|_| !is_open))
                }
            };
            // What is said twice counts once, and what may be an answer if one is missing.
            let is_new = match is_open {
                true => missing > 0,
                false => slip.is_some() || !std::mem::replace(&mut is_told[k], true),
            };
            missing -= usize::from((is_open || slip.is_some()) && missing > 0);
            let name = source(&t.span).split_whitespace().collect::<Vec<_>>().join(" ");
            found.push(Answered {
                of: [at, item.answers.len() + k],
                span: t.span.clone(),
                name: name.chars().take(SHOWN).collect(),
                slip,
                right: shown(&asked[k].q, &kinds),
                counts: if is_new { kinds.len() } else { 0 },
                by_hand: is_open,
            });
        }
        // Values of one joint, all of them in some configuration.
        let in_some = |single: &Single| {
            let is = |v: &Value| asked.iter().any(|a| agrees(v, single.joint, a, &kinds, None, false));
            single.values.iter().all(is)
        };
        let mut spans: Vec<Range<usize>> = found.iter().map(|a| a.span.clone()).collect();
        spans.extend(singles.iter().filter(|s| in_some(s)).map(|s| s.span.clone()));
        let is_goal = |span: &Range<usize>| is_goal(text.get(span.clone()).unwrap_or_default(), &goals);
        checked.unjudged.retain(|u| !spans.iter().any(|s| touch(s, &u.span)) && !is_goal(&u.span));
        let gone: Vec<bool> =
            checked.claims.iter().map(|c| spans.iter().any(|s| touch(s, &c.span))).collect();
        checked.leave_out(&gone);
        checked.answered.extend(found);
    }
}

/// Parts of a text that are taken, apart from each other.
#[derive(Default)]
struct Taken(BTreeMap<usize, usize>);

impl Taken {
    fn touches(&self, span: &Range<usize>) -> bool {
        self.0.range(..span.end).next_back().is_some_and(|(_, end)| *end > span.start)
    }

    fn add(&mut self, span: &Range<usize>) {
        let mut span = span.clone();
        while let Some((start, end)) = self.0.range(..span.end).next_back().map(|(s, e)| (*s, *e)) {
            if end <= span.start {
                break;
            }
            self.0.remove(&start);
            span = span.start.min(start)..span.end.max(end);
        }
        self.0.insert(span.start, span.end);
    }
}

/// The configurations of a text, and values of single joints.
fn told(text: &str, format: Format, kinds: &[JointKind]) -> (Vec<Told>, Vec<Single>) {
    let flat = Flat::of(text);
    let mut found = tables(text, format, kinds);
    let mut taken = Taken::default();
    found.iter().for_each(|t| taken.add(&t.span));
    for at in 0..flat.chars.len() {
        if let Some((values, end)) = flat.tuple(at, kinds.len())
            && let Some((start, is_of_joints)) = named(&flat, at, &values)
        {
            let span = flat.span(&(start..end));
            if !taken.touches(&span) {
                taken.add(&span);
                found.push(Told { span, values, is_of_joints });
            }
        }
    }
    let singles: Vec<Single> =
        singles(&flat, kinds).into_iter().filter(|s| !taken.touches(&s.span)).collect();
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
        let values = group.iter().map(|s| s.values[0]).collect();
        found.push(Told { span, values, is_of_joints: true });
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
        let (values, end) = flat.result(sign + 1);
        if !values.is_empty() {
            found.push(Single { joint: joint - 1, span: flat.span(&(at..end)), values, place: at..end });
        }
    }
    found
}

pub(super) fn is_slide(kinds: &[JointKind], number: usize) -> bool {
    kinds.get(number - 1) == Some(&JointKind::Prismatic)
}

/// Where a list of values begins that may be of the joints, and whether its name or its units say so; nothing of other lists.
fn named(flat: &Flat, at: usize, values: &[Value]) -> Option<(usize, bool)> {
    // No name is longer.
    let near = at.saturating_sub(APART);
    let line = flat.chars[near..at].iter().rposition(|c| *c == '\n').map_or(near, |k| near + k + 1);
    let before: String = flat.chars[line..at].iter().collect();
    let has_angle = values.iter().any(|v| matches!(v.unit, Unit::Degrees | Unit::Radians));
    let Some(left) = before.trim_end().strip_suffix('=') else {
        let has_letters = before.chars().any(char::is_alphabetic);
        return (has_angle || !has_letters).then_some((at, has_angle));
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
    (is_joints || (has_angle && !bare.starts_with(['p', 'P', 'T']))).then_some((line + characters, true))
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
                found.push(Told { span: start.min(end)..end, values, is_of_joints: true });
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
/// With `is_rounded` all that its last digit leaves open, else no more than [`ROUNDED`].
fn agrees(
    v: &Value,
    joint: usize,
    asked: &Asked,
    kinds: &[JointKind],
    sense: Option<[f64; 2]>,
    is_rounded: bool,
) -> bool {
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
            // Nobody counts several turns in radians.
            if v.unit == Unit::None && *factor == 1.0 && !is_slide && v.number.abs() > 1.01 * TAU {
                return false;
            }
            let off = v.number * factor - x;
            let off = if is_slide { off } else { off - TAU * (off / TAU).round() };
            let least = LEAST[usize::from(is_slide)];
            let digit = 0.6 * v.digit * factor;
            let digit = if is_rounded { digit } else { digit.min(ROUNDED[usize::from(is_slide)]) };
            off.abs() <= within + least + SHARE * x.abs() + digit
        })
}

/// Whether a configuration is one that is asked for.
fn is_it(told: &Told, asked: &Asked, kinds: &[JointKind], is_rounded: bool) -> bool {
    let all =
        |sense| told.values.iter().enumerate().all(|(k, v)| agrees(v, k, asked, kinds, sense, is_rounded));
    SENSES.iter().any(|sense| all(Some(*sense)))
}

/// How many joints agree.
fn agreeing(told: &Told, asked: &Asked, kinds: &[JointKind], sense: [f64; 2]) -> usize {
    let values = told.values.iter().enumerate();
    values.filter(|(k, v)| agrees(v, *k, asked, kinds, Some(sense), false)).count()
}

/// The configuration that one that is wrong is nearest to, one that nobody has yet if there is one, and how it differs.
fn nearest(told: &Told, asked: &[Asked], taken: &[bool], kinds: &[JointKind]) -> (usize, ValueSlip) {
    let all = (0..asked.len()).flat_map(|k| SENSES.iter().map(move |s| (k, *s)));
    let best = all.max_by_key(|&(k, sense)| (!taken[k], agreeing(told, &asked[k], kinds, sense)));
    let (k, sense) = best.unwrap_or((0, SENSES[0]));
    let is_sign = told.values.iter().enumerate().all(|(joint, v)| {
        let opposite = Value { number: -v.number, ..*v };
        [*v, opposite].iter().any(|v| agrees(v, joint, &asked[k], kinds, Some(sense), false))
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
    let is_named = ["p", "P", "x", "y", "z"].iter().any(|w| left.starts_with(w));
    let at = flat.skip_blanks(equal + 1);
    let values = (2..=3).find_map(|n| flat.tuple(at, n)).map(|t| t.0);
    let values = values.unwrap_or_else(|| flat.values(at).0);
    is_named && is_place(&values, goals)
}

/// Whether all of some values are coordinates of a goal.
fn is_place(values: &[Value], goals: &[f64]) -> bool {
    let is_one = |v: &Value| {
        let factor = if v.unit == Unit::Millimetres { 1e-3 } else { 1.0 };
        let room = (0.6 * v.digit * factor).min(ROUNDED[1]);
        goals.iter().any(|x| (v.number * factor - x).abs() <= room + 1e-9)
    };
    let is_length = |v: &Value| !matches!(v.unit, Unit::Degrees | Unit::Radians);
    !values.is_empty() && values.iter().all(|v| is_length(v) && is_one(v))
}

/// The number of the pose of each configuration, in the order in which they are asked for.
fn poses(robot: &Description, asked: &[Asked]) -> Vec<usize> {
    let Ok(robot) = Robot::numeric(robot) else { return vec![0; asked.len()] };
    let mut places: Vec<[f64; 3]> = vec![];
    let number = |a: &Asked| {
        let place = robot.pose(&a.q).translation.0;
        let known = places.iter().position(|p| p.iter().zip(place).all(|(x, y)| (x - y).abs() < SAME));
        known.unwrap_or_else(|| {
            places.push(place);
            places.len() - 1
        })
    };
    asked.iter().map(number).collect()
}

/// For each configuration that is told, whether nothing says that it is meant for the pose that it is right for: the heading or the goal
/// before it is of another one, or there is none and the poses do not come one after the other.
fn elsewhere(
    text: &str,
    told: &[Told],
    matched: &[Option<usize>],
    poses: &[usize],
    goals: &[f64],
) -> Vec<bool> {
    const WORDS: [&str; 10] =
        ["position", "pose", "point", "goal", "target", "punkt", "ziel", "lage", "posici", "punto"];
    let count = poses.iter().max().map_or(0, |k| k + 1);
    let of: Vec<Option<usize>> = matched.iter().map(|m| m.map(|k| poses[k])).collect();
    if count < 2 {
        return vec![false; told.len()];
    }
    let mut labels: Vec<(usize, usize)> = vec![];
    let lower = text.to_ascii_lowercase();
    for (at, word) in WORDS.iter().flat_map(|w| lower.match_indices(w)) {
        let rest = lower[at + word.len()..].trim_start_matches(char::is_alphabetic);
        let rest = rest.trim_start_matches([' ', '$', '_', '(', '#', '~']);
        let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        let is_number =
            !rest[end..].starts_with('.') || !rest[end + 1..].starts_with(|c: char| c.is_ascii_digit());
        let number: Option<usize> = rest[..end].parse().ok();
        labels.extend(number.filter(|&k| is_number && k >= 1 && k <= count).map(|k| (at, k - 1)));
    }
    // The coordinates of one pose and of no other.
    let flat = Flat::of(text);
    let of_pose = |k: usize| -> Vec<f64> {
        let own = poses.iter().position(|p| *p == k).unwrap_or(0);
        goals.get(3 * own..3 * own + 3).unwrap_or_default().to_vec()
    };
    for at in (0..flat.chars.len()).filter(|&k| matches!(flat.get(k), '(' | '[')) {
        let Some((values, end)) = (2..=3).find_map(|n| flat.tuple(at, n)) else { continue };
        let mut own = (0..count).filter(|&k| is_place(&values, &of_pose(k)));
        if let (Some(k), None) = (own.next(), own.next()) {
            labels.push((flat.span(&(at..end)).start, k));
        }
    }
    labels.sort_unstable();
    if labels.is_empty() {
        let met: Vec<usize> = of.iter().flatten().copied().collect();
        let is_in_order = met.first() == Some(&0) && met.windows(2).all(|w| w[1] == w[0] || w[1] == w[0] + 1);
        return of.iter().map(|k| k.is_some() && !is_in_order).collect();
    }
    let is_other = |(t, own): (&Told, &Option<usize>)| {
        let label = labels[..labels.partition_point(|l| l.0 < t.span.start)].last();
        own.is_some_and(|k| label.is_none_or(|l| l.1 != k))
    };
    told.iter().zip(&of).map(is_other).collect()
}

/// Whether words stand around values in their line, which may say anything of them.
fn is_in_sentence(text: &str, span: &Range<usize>) -> bool {
    const MANY: usize = 3;
    // In bytes.
    const FAR: usize = 200;
    let near = (span.start.saturating_sub(FAR)..span.start).find(|&k| text.is_char_boundary(k));
    let far = (span.end..text.len().min(span.end + FAR)).rev().find(|&k| text.is_char_boundary(k));
    let before = &text[near.unwrap_or(span.start)..span.start];
    let behind = &text[span.end..far.unwrap_or(span.end)];
    let around =
        [before.rsplit('\n').next().unwrap_or_default(), behind.split('\n').next().unwrap_or_default()];
    let words = around.iter().flat_map(|part| part.split(|c: char| !c.is_alphanumeric()));
    words.filter(|w| w.chars().count() >= 3 && w.chars().all(char::is_alphabetic)).take(MANY).count() == MANY
}
