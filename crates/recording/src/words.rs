//! What was found, in English.
//!
//! Never "wrong": the recording is other than the model, and the model may be the one that is off.

use crate::arm::Arm;
use crate::data::Direction;
use crate::decode::{Form, Format};
use crate::finding::{Finding, Fitted, Off, Rival, Slip, Unseen};
use crate::hold::Held;
use crate::turns::log;
use denavit::geometry::{Axis, Transform, Vector};
use std::f64::consts::FRAC_PI_2;

/// What things are called.
pub struct Names<'a> {
    /// The robot.
    pub arm: &'a Arm,
    /// The names of the columns that are taken for joints.
    pub columns: Vec<&'a str>,
    /// The number of the first row in the file, where rows are counted from 1 and heads count.
    pub first_row: usize,
    /// What a row is called: `row`, or `line` of a text.
    pub row: &'static str,
}

/// The lines of a report: what the columns are, what was found, what cannot be seen, what is left over.
pub fn lines(held: &Held, names: &Names) -> Vec<String> {
    let mut all = vec![];
    if held.is_understood && held.unseen != [Unseen::Everything] {
        all.push(format!("{} is {}", columns(&held.recipe.rotation), format_of(held.recipe.format)));
    }
    all.extend(held.findings.iter().map(|f| finding(f, held, names)));
    all.extend(held.remarks.iter().map(|f| remark(f, held, names)));
    all.extend(held.rivals.iter().map(|r| rival(r, held, names)));
    all.extend(held.unseen.iter().map(|u| unseen(u, names)));
    all.push(left_over(held));
    all
}

/// A finding with its evidence.
pub fn finding(finding: &Finding, held: &Held, names: &Names) -> String {
    let mut text = slip(&finding.slip, held, names);
    for other in &finding.same {
        text += &format!(", or {}: the same function, no motion tells them apart", slip(other, held, names));
    }
    if let Some(without) = &finding.without {
        text += &format!(". The hand is off by {} as it stands, {} so", off(without), off(&held.left_over));
    }
    text
}

fn remark(finding: &Finding, held: &Held, names: &Names) -> String {
    let text = slip(&finding.slip, held, names);
    match finding.slip {
        Slip::Missing(_) | Slip::Gaps(_) | Slip::Spikes(_) | Slip::Apart(..) => text,
        _ => format!("small enough to be a matter of calibration: {text}"),
    }
}

/// A slip as a phrase.
pub fn slip(slip: &Slip, held: &Held, names: &Names) -> String {
    let column = |c: usize| names.columns.get(c).copied().unwrap_or("?").to_string();
    // The joint's name with its column, if they differ.
    let joint = |i: usize| {
        let name = names.arm.names.get(i).map_or_else(|| format!("joint {}", i + 1), Clone::clone);
        match held.recipe.joints.get(i) {
            Some(j) if j.column != name => format!("{} (joint {name})", j.column),
            _ => name,
        }
    };
    let turns = |i: usize| names.arm.turns.get(i).copied().unwrap_or(true);
    let row = |r: usize| r + names.first_row;
    match slip {
        Slip::Degrees => "the joints are in degrees".into(),
        Slip::Radians => "the joints are in radians, though degrees are said".into(),
        Slip::Hundred => "the joints are −100 to 100 of their ranges".into(),
        Slip::Dropped(c) => format!("{} takes no part in the motion of the hand: a gripper, or another axis", column(*c)),
        Slip::Reversed => "the joints stand in reversed order, the last one first".into(),
        Slip::Swap(i, j) => format!("joints {} and {} are exchanged", names.arm.names[*i], names.arm.names[*j]),
        Slip::Flip(i) => format!("{}: the sign is reversed", joint(*i)),
        Slip::Quarter(i, k) => format!("{}: its zero is {}° ahead of the model's", joint(*i), 90 * i32::from(*k)),
        Slip::Couple(i, s) => {
            let (other, sign) = (&names.arm.names[i - 1], if *s > 0 { "plus" } else { "minus" });
            format!("{}: holds the joint {sign} {other}", joint(*i))
        }
        Slip::DegreesOne(i) => format!("{}: in degrees, the other joints are not", joint(*i)),
        Slip::Gain(i, g) => format!("{}: counts {} of the joint", joint(*i), if *g > 0 { "twice the angle" } else { "half the angle" }),
        Slip::Inverse => "the pose is that of the base in the hand, not of the hand in the base".into(),
        Slip::Transposed => match held.recipe.format.form {
            Form::Matrix => "the nine numbers are the matrix by columns (or the orientation of the base in the hand)".into(),
            _ => "the orientation is that of the base in the hand; the position is that of the hand in the base".into(),
        },
        Slip::Unit(k) => format!("the position is in {}", unit(*k)),
        Slip::LeftHanded(axis) => format!("the pose is left-handed: its {axis} axis is mirrored"),
        Slip::OtherArm(name) => format!("the motion is that of {name}, not of {}", names.arm.name),
        Slip::Base(x) => format!("the robot's base stands elsewhere in the recording: {}", place(x)),
        Slip::Tool(x) => format!("the pose is not the robot's tool, but a frame {} in it", place(x)),
        Slip::Lag(by) => lag(by, held),
        Slip::Zero(i, by) => format!("{}: its zero is {} ahead of the model's", joint(*i), amount(turns(*i), by)),
        Slip::GainBy(i, by) => {
            format!("{}: the joint moves {:.4} ± {:.4} times what the column says", joint(*i), 1.0 + by.value, by.deviation)
        }
        Slip::CoupleBy(i, by) => {
            format!("{}: holds {:.4} ± {:.4} of {} as well", joint(*i), by.value, by.deviation, names.arm.names[i - 1])
        }
        Slip::Length(l) => format!(
            "the length along {} behind joint {} is {} in the model; this motion has {} ± {}",
            Axis::ALL[l.axis],
            l.constant,
            millimetres(l.model),
            millimetres(l.model + l.by.value),
            millimetres(l.by.deviation)
        ),
        Slip::Jump(c, r, count, turn) => {
            let times = if *count == 1 { "once".into() } else { format!("{count} times") };
            let turn = if *turn > 7.0 { "360" } else { "2π" };
            format!("{}: jumps by {turn}, {times}, first in {} {}", column(*c), names.row, row(*r))
        }
        Slip::Stuck(s) => {
            let did = s.meanwhile.map_or(String::new(), |[low, high]| {
                let unit = turns(s.joint);
                format!("; by the pose the joint went from {} to {}", number(unit, low), number(unit, high))
            });
            format!("{}: stands still in {}s {} to {} while the hand goes on{did}", joint(s.joint), names.row, row(s.from), row(s.to - 1))
        }
        Slip::Spikes(rows) => {
            format!("the pose jumps away and back in {}: {}", count(rows.len(), names.row), list(rows, names.first_row))
        }
        Slip::Apart(rows, of) => format!(
            "the hand is far off in {} of {of} that were looked at: {}",
            count(rows.len(), names.row),
            list(rows, names.first_row)
        ),
        Slip::Missing(rows) => {
            format!("a number is missing in {}: {}", count(rows.len(), names.row), list(rows, names.first_row))
        }
        Slip::TimeBack(rows) => format!(
            "the time does not go on in {}: {}; rows are taken as they stand, and no lag is seen across these",
            count(rows.len(), names.row),
            list(rows, names.first_row)
        ),
        Slip::Gaps(rows) => {
            format!("time is missing before {}: {}", count(rows.len(), names.row), list(rows, names.first_row))
        }
        Slip::Unlike(u) => {
            let does = if u.is_still { "does not move" } else { "does not follow the motion" };
            let [low, high] = u.needed;
            format!(
                "{}: {does}; with the other joints as they are the pose asks for {} to {}",
                joint(u.joint),
                number(turns(u.joint), low),
                number(turns(u.joint), high)
            )
        }
        Slip::NotUnderstood => {
            "not understood: no reading of these columns that was tried moves this model as the pose does".into()
        }
    }
}

fn lag(by: &Fitted, held: &Held) -> String {
    let rows = by.value.abs();
    let which =
        if by.value > 0.0 { "the pose is behind the joints" } else { "the joints are behind the pose" };
    let time = held.recipe.delay.1.map_or(String::new(), |s| format!("{:.0} ms, ", 1e3 * s.abs()));
    format!("{which} by {time}{rows:.2} ± {:.2} rows", by.deviation)
}

fn rival(rival: &Rival, held: &Held, names: &Names) -> String {
    let mut parts: Vec<String> = rival.slips.iter().map(|s| slip(s, held, names)).collect();
    if rival.format != held.recipe.format {
        parts.push(format!("the orientation is {}", format_of(rival.format)));
    }
    if parts.is_empty() {
        parts.push("the columns are what they are said to be".into());
    }
    format!("or, as well as far as this motion tells: {}", parts.join("; "))
}

fn unseen(unseen: &Unseen, names: &Names) -> String {
    let name = |i: usize| &names.arm.names[i];
    match unseen {
        Unseen::Everything => "not seen: anything, for no joint moves".into(),
        Unseen::Still(i) => format!("not seen: sign, zero and order of {}, which does not move", name(*i)),
        Unseen::Sign(i, moves, would) => format!(
            "not seen: the sign of {}, which moves by {:.2}°; {:.1}° would do",
            name(*i),
            moves.to_degrees(),
            would.to_degrees()
        ),
    }
}

/// What is left over, and whether that is what noise makes.
pub fn left_over(held: &Held) -> String {
    if held.unseen == [Unseen::Everything] {
        return "nothing to compare".into();
    }
    let rest = off(&held.left_over);
    if held.is_computed {
        return format!(
            "left over: {rest}, as near as rounding: the pose was computed from these joints with this table, not measured"
        );
    }
    if !held.is_understood {
        return format!("left over by the best reading: {rest}");
    }
    let (noise, is_noise) = match &held.noise {
        None => ("the rows are too far apart for the noise to be seen".into(), false),
        Some(noise) => {
            let is_noise = held.left_over.shift < 1.5 * noise.shift + 1e-9
                && held.left_over.turn < 1.5 * noise.turn + 1e-9;
            (format!("the noise of the columns alone is {}", off(noise)), is_noise)
        }
    };
    let is_clean = held.findings.is_empty() && held.remarks.is_empty() && held.rivals.is_empty();
    match (is_clean, is_noise) {
        (false, _) => format!("left over: {rest}; {noise}"),
        (true, false) if held.noise.is_none() => format!("no finding: {rest}; {noise}"),
        (true, true) => format!("nothing to remark: {rest}; {noise}"),
        (true, false) => {
            format!("nothing to remark but what an arm shows that was not calibrated: {rest}; {noise}")
        }
    }
}

/// A format in words.
pub fn format_of(format: Format) -> String {
    let unit = if format.degrees { "degrees" } else { "radians" };
    match format.form {
        Form::RotationVector => format!("a rotation vector in {unit}"),
        Form::Euler(_, true) => format!("angles about moving axes, {}, in {unit}", axes(format.form)),
        Form::Euler(_, false) => format!("angles about fixed axes, {}, in {unit}", axes(format.form)),
        Form::QuaternionXyzw => "a quaternion, w last".into(),
        Form::QuaternionWxyz => "a quaternion, w first".into(),
        Form::Rows => "the first two rows of the matrix".into(),
        Form::Columns => "the first two columns of the matrix".into(),
        Form::Matrix => "the matrix by rows".into(),
    }
}

/// The axes of a format in the order in which its numbers stand.
fn axes(form: Form) -> String {
    let text = form.to_string();
    let set = text.rsplit(' ').next().unwrap_or_default();
    let mut letters: Vec<char> = set.chars().collect();
    if matches!(form, Form::Euler(_, false)) {
        letters.reverse();
    }
    letters.into_iter().map(|c| c.to_ascii_lowercase().to_string()).collect::<Vec<_>>().join(", ")
}

/// How the pose is meant.
pub fn direction_of(direction: Direction) -> &'static str {
    match direction {
        Direction::Direct => "hand in base",
        Direction::Inverse => "base in hand",
        Direction::Transposed => "position of the hand, orientation of the base",
    }
}

/// Columns by their names: the first and the last.
fn columns(names: &[String]) -> String {
    match names {
        [] => "the orientation".into(),
        [one] => one.clone(),
        [first, .., last] => format!("{first} to {last}"),
    }
}

fn unit(k: f64) -> String {
    match k {
        1e3 => "millimetres".into(),
        1e2 => "centimetres".into(),
        1e-3 => "metres, though millimetres are said".into(),
        0.0254 => "inches".into(),
        1.0 => "metres".into(),
        k => format!("a unit of which {k} are a metre"),
    }
}

/// A turn and a shift.
pub fn off(off: &Off) -> String {
    format!("{} and {}", degrees(off.turn), millimetres(off.shift))
}

fn digits(x: f64) -> usize {
    match x.abs() {
        x if x >= 100.0 => 0,
        x if x >= 10.0 => 1,
        x if x >= 0.1 || x == 0.0 => 2,
        _ => 3,
    }
}

fn degrees(x: f64) -> String {
    let x = x.to_degrees();
    if x.abs() < 5e-4 && x != 0.0 { format!("{x:.0e}°") } else { format!("{x:.*}°", digits(x)) }
}

fn millimetres(x: f64) -> String {
    let x = 1e3 * x;
    if x.abs() < 5e-4 && x != 0.0 { format!("{x:.0e} mm") } else { format!("{x:.*} mm", digits(x)) }
}

fn number(turns: bool, x: f64) -> String {
    if turns { degrees(x) } else { millimetres(x) }
}

fn amount(turns: bool, by: &Fitted) -> String {
    format!("{} ± {}", number(turns, by.value), number(turns, by.deviation))
}

/// A frame by its turn and its shift.
fn place(x: &Transform<f64>) -> String {
    let mut parts = vec![];
    let w = log(&x.rotation);
    let angle = w.norm();
    if angle > 0.3_f64.to_radians() {
        let axis = w.scale(1.0 / angle);
        let quarter = (angle / FRAC_PI_2).round() * FRAC_PI_2;
        let shown = if (angle - quarter).abs() < 0.5_f64.to_radians() { quarter } else { angle };
        parts.push(format!("turned by {} about {}", degrees(shown), direction(axis)));
    }
    let t = x.translation;
    if t.norm() > 0.5e-3 {
        let along = direction(t.scale(1.0 / t.norm()));
        if along.starts_with('(') {
            let [x, y, z] = t.0.map(|x| format!("{:.1}", 1e3 * x));
            parts.push(format!("shifted by ({x}, {y}, {z}) mm"));
        } else {
            parts.push(format!("shifted by {} along {along}", millimetres(t.norm())));
        }
    }
    if parts.is_empty() { "the same within what is seen".into() } else { parts.join(" and ") }
}

/// A direction: an axis, if it is one nearly.
fn direction(v: Vector<f64>) -> String {
    for (k, axis) in ["x", "y", "z"].iter().enumerate() {
        if v[k].abs() > 0.9998 {
            return if v[k] > 0.0 { (*axis).into() } else { format!("−{axis}") };
        }
    }
    format!("({:.3}, {:.3}, {:.3})", v[0], v[1], v[2])
}

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// The first rows of a list.
fn list(rows: &[usize], first: usize) -> String {
    let shown: Vec<String> = rows.iter().take(8).map(|r| (r + first).to_string()).collect();
    let more = if rows.len() > 8 { ", …" } else { "" };
    format!("{}{more}", shown.join(", "))
}
