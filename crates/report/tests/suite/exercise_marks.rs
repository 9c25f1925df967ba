//! Exercises at random: their solutions earn all points, in other forms, too; what is made wrong in them does not.
//!
//! `DENAVIT_SOAK=1` makes a thousand of each kind, another number so many.

use crate::exercise::{Earned, earned};
use denavit::description::JointKind;
use denavit::random::Random;
use denavit_reading::document::Format;
use denavit_report::words::Tongue;
use denavit_report::{
    ArmOptions, Difficulty, Exercise, ExerciseKind, ExerciseOptions, exercise_of_arm, render,
};
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;
use std::ops::Range;

fn share(of: u64, usual: u64) -> u64 {
    match std::env::var("DENAVIT_SOAK") {
        Err(_) => usual,
        Ok(number) => number.parse().ok().filter(|n| *n > 1).unwrap_or(of),
    }
}

fn made(kind: ExerciseKind, seed: u64) -> Exercise {
    let difficulties = [Difficulty::Easy, Difficulty::Medium, Difficulty::Hard];
    let arm = ArmOptions { difficulty: difficulties[seed as usize % 3], series: seed / 3 };
    let options = ExerciseOptions { kind, seed, count: 1 + seed as usize % 2, language: Tongue::English };
    exercise_of_arm(&arm, &options).unwrap_or_else(|why| panic!("{kind:?}, {seed}: {why}"))
}

/// A text with `C_{12}` and `S_{12}` replaced, by their letters and the numbers of their joints.
fn sums_replaced(text: &str, write: impl Fn(char, &[&str]) -> String) -> String {
    let (mut out, mut rest) = (String::new(), text);
    while let Some(at) = rest.find(['C', 'S']) {
        let letter = rest[at..].chars().next().unwrap_or_default();
        let numbers = rest[at + 1..].strip_prefix("_{").and_then(|r| r.split_once('}')).map(|(n, _)| n);
        let is_name = rest[..at].chars().next_back().is_none_or(|c| !c.is_alphabetic() && c != '\\');
        match numbers.filter(|n| is_name && !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit())) {
            Some(numbers) => {
                let joints: Vec<&str> = (0..numbers.len()).map(|k| &numbers[k..=k]).collect();
                out += &rest[..at];
                out += &write(letter, &joints);
                rest = &rest[at + 1 + "_{}".len() + numbers.len()..];
            }
            None => {
                out += &rest[..at + 1];
                rest = &rest[at + 1..];
            }
        }
    }
    out + rest
}

/// `\cos(q_{1} + q_{2})`
fn written_out(text: &str) -> String {
    sums_replaced(text, |letter, joints| {
        let sum: Vec<String> = joints.iter().map(|j| format!("q_{{{j}}}")).collect();
        format!("\\{}\\left({}\\right)", if letter == 'C' { "cos" } else { "sin" }, sum.join(" + "))
    })
}

/// `(C_{1} C_{2} - S_{1} S_{2})`
fn expanded(text: &str) -> String {
    fn sum(letter: char, joints: &[&str]) -> String {
        let [first, rest @ ..] = joints else { return String::new() };
        if rest.is_empty() {
            return format!("{letter}_{{{first}}}");
        }
        let [c, s] = ['C', 'S'].map(|l| sum(l, rest));
        match letter {
            'C' => format!("\\left(C_{{{first}}} {c} - S_{{{first}}} {s}\\right)"),
            _ => format!("\\left(S_{{{first}}} {c} + C_{{{first}}} {s}\\right)"),
        }
    }
    // Where a power stands behind, the sum is raised as a whole.
    sums_replaced(text, sum)
}

/// `\theta_{1}` for a joint that turns, `d_{2}` for one that slides and whose row has no length of that name.
fn other_letters(e: &Exercise, text: &str) -> String {
    let taken = |name: &str| e.robot.parameters.iter().any(|p| *p.symbol.name() == *name);
    (1..).zip(e.robot.variables()).fold(text.to_string(), |text, (k, variable)| {
        let letter = match variable.kind {
            JointKind::Revolute => "\\theta",
            JointKind::Prismatic if taken(&format!("d{k}")) => "q",
            JointKind::Prismatic => "d",
        };
        text.replace(&format!("q_{{{k}}}"), &format!("{letter}_{{{k}}}"))
            .replace(&format!("{{q}}_{{{k}}}"), &format!("{{{letter}}}_{{{k}}}"))
    })
}

/// Angles in radians: `75^{\circ}` is `1.30899694`.
fn in_radians(text: &str) -> String {
    let mut parts = text.split("^{\\circ}");
    let mut out = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let start = out.rfind(|c: char| !(c.is_ascii_digit() || c == '.')).map_or(0, |at| at + 1);
        let number: f64 = out[start..].parse().unwrap_or_default();
        out.truncate(start);
        out += &format!("{:.8} \\text{{ rad}}{part}", number.to_radians());
    }
    out
}

/// Forms in which somebody else writes the same.
fn equivalents(e: &Exercise) -> Vec<(&'static str, String, Format)> {
    let markdown = render::markdown(&e.solution, "figures").text;
    let mut all = vec![
        ("sums written out", written_out(&markdown), Format::Markdown),
        ("sums expanded", expanded(&markdown), Format::Markdown),
        ("θ and d for q", other_letters(e, &markdown), Format::Markdown),
    ];
    // Tables of LaTeX and Typst are none that is read.
    if e.options.kind != ExerciseKind::Table {
        all.push(("LaTeX", render::latex_fragment(&e.solution), Format::Latex));
        // Polynomials in the time are asked for in degrees.
        if e.options.kind != ExerciseKind::Path {
            all.push(("radians", in_radians(&markdown), Format::Markdown));
        }
    }
    all
}

/// Cells of matrices and right sides, below the headings of what earns points.
fn cells(text: &str) -> Vec<Range<usize>> {
    let mut found = vec![];
    let mut at = 0;
    for block in text.split("$$") {
        let here = at..at + block.len();
        at = here.end + "$$".len();
        let Some(equal) = block.find(" = ") else { continue };
        if !block.starts_with('\n') || block.starts_with("\n\n") {
            continue;
        }
        let body = here.start + equal + " = ".len()..here.end;
        let mut start = body.start;
        let marks = ["\\begin{bmatrix}", "\\end{bmatrix}", " & ", " \\\\ ", "\\quad"];
        while start < body.end {
            let next = marks.iter().filter_map(|m| Some((text[start..body.end].find(m)?, m.len()))).min();
            let (end, skip) = next.map_or((body.end, 0), |(found, len)| (start + found, len));
            if !text[start..end].trim().is_empty() {
                found.push(start..end);
            }
            start = end + skip.max(1);
        }
    }
    found
}

/// Values in sentences: `$\tau_{1} = 2.3205 \text{ N m}$`.
fn values(text: &str) -> Vec<Range<usize>> {
    let mut found = vec![];
    for line in text.lines() {
        let at = line.as_ptr() as usize - text.as_ptr() as usize;
        let name = line.split(" = ").next().unwrap_or_default();
        let is_alone = line.matches('$').count() == 2 && line.starts_with('$');
        let is_answer =
            ["$\\tau_", "$v_", "$T", "$v_{x}", "$v_{y}", "$v_{z}"].iter().any(|l| name.starts_with(l));
        // A joint of a solution: the first of its line.
        if name.starts_with("Solution ") && name.contains(": $q_") {
            let start = line.find(" = ").map_or(0, |e| e + 3);
            let end = line[start..].find('$').map_or(line.len(), |e| start + e);
            found.push(at + start..at + end);
        }
        if is_alone && is_answer {
            let start = line.find(" = ").map_or(0, |e| e + 3);
            found.push(at + start..at + line.len() - 1);
        }
    }
    found
}

/// A slip in a formula: what was done, and the formula with it.
fn slipped(cell: &str, random: &mut Random) -> Option<(&'static str, String)> {
    let mut pick = |text: &str, what: &str| -> Option<usize> {
        let all: Vec<usize> = text.match_indices(what).map(|(at, _)| at).collect();
        (!all.is_empty()).then(|| all[(random.unit() * all.len() as f64) as usize])
    };
    let replaced =
        |at: usize, was: &str, now: &str| format!("{}{now}{}", &cell[..at], &cell[at + was.len()..]);
    let kind = (cell.len() + pick(cell, "_").unwrap_or(0)) % 4;
    for turn in 0..4 {
        let found = match (kind + turn) % 4 {
            0 => pick(cell, " - ").map(|at| ("a sign", replaced(at, " - ", " + "))),
            1 => pick(cell, "C_{").map(|at| ("a sine for a cosine", replaced(at, "C_{", "S_{"))),
            2 => pick(cell, " + ").and_then(|at| {
                // The last term of a sum without brackets behind it.
                let rest = &cell[at + 3..];
                (!rest.contains(['+', '(', ')']) && !rest.contains(" - "))
                    .then(|| ("a lost term", cell[..at].to_string()))
            }),
            _ => Some((
                "a sign",
                match cell.trim_start().strip_prefix('-') {
                    Some(rest) if !cell.contains(" + ") && !cell.contains(" - ") => rest.to_string(),
                    None if !cell.contains(" + ") && !cell.contains(" - ") => {
                        format!("-{}", cell.trim_start())
                    }
                    _ => return None,
                },
            )),
        };
        if found.is_some() {
            return found;
        }
    }
    None
}

/// A length along x that is twice as long: one along z may be that to another zero of a slide.
fn other_length(e: &Exercise, text: &str) -> Option<(Range<usize>, &'static str, String)> {
    let lengths = e.robot.parameters.iter().map(|p| p.symbol.name().to_string());
    let length = lengths.into_iter().find(|name| name.starts_with('a'))?;
    let printed = format!("${}_{{{}}}$", &length[..1], &length[1..]);
    let at = text.find(&format!("| {printed}"))? + 2;
    Some((at..at + printed.len(), "a length", format!("$2 {}", &printed[1..])))
}

/// Whether two formulas have different values, as far as they can be read.
fn differ(a: &str, b: &str) -> bool {
    let open = Vocabulary::new().open(true);
    let (Ok(a), Ok(b)) = (parse(a, &open), parse(b, &open)) else { return false };
    let value = |e: denavit_symbolic::Expr| {
        e.eval(|s| {
            let mut random = Random(s.name().bytes().fold(7, |h, b| h * 31 + u64::from(b)));
            Some(0.3 + random.unit())
        })
    };
    match (value(a), value(b)) {
        (Ok(a), Ok(b)) => (a - b).abs() > 0.01,
        _ => false,
    }
}

/// A number of a value, off by a tenth and more.
fn number_slipped(cell: &str) -> Option<String> {
    let start = cell.find(|c: char| c.is_ascii_digit())?;
    let end =
        cell[start..].find(|c: char| !(c.is_ascii_digit() || c == '.')).map_or(cell.len(), |e| start + e);
    let number: f64 = cell[start..end].parse().ok()?;
    Some(format!("{}{:.4}{}", &cell[..start], number * 1.2 + 0.3, &cell[end..]))
}

#[derive(Default, Debug)]
struct Count {
    sheets: u64,
    forms: u64,
    slips: u64,
    /// Slips for which a teacher is asked.
    by_hand: u64,
    /// Slips that are named, of those that are called wrong.
    named: u64,
    wrong: Vec<String>,
}

fn judge(kind: ExerciseKind, seeds: Range<u64>) -> Count {
    let mut count = Count::default();
    for seed in seeds {
        denavit::symbolic::scoped(|| {
            let e = made(kind, seed);
            let of = e.rubric.points();
            let markdown = render::markdown(&e.solution, "figures").text;
            count.sheets += 1;
            let plain = [("as it is", markdown.clone(), Format::Markdown)];
            for (form, text, format) in plain.into_iter().chain(equivalents(&e)) {
                count.forms += 1;
                let found: Earned = earned(&e, &text, format);
                if (found.points - of).abs() > 0.05 {
                    count.wrong.push(format!(
                        "{} {seed}, {form}: {} + {}? of {of}",
                        kind.name(),
                        found.points,
                        found.open
                    ));
                }
            }
            let mut random = Random(seed ^ 0x5eed);
            let mut places: Vec<(Range<usize>, &str, String)> = vec![];
            let formulas = if kind == ExerciseKind::Inverse || kind == ExerciseKind::Position {
                vec![]
            } else {
                cells(&markdown)
            };
            for cell in formulas {
                if let Some((what, now)) = slipped(&markdown[cell.clone()], &mut random)
                    && differ(&markdown[cell.clone()], &now)
                {
                    places.push((cell, what, now));
                }
            }
            if kind == ExerciseKind::Table {
                places.extend(other_length(&e, &markdown));
            }
            for value in values(&markdown) {
                if let Some(now) = number_slipped(&markdown[value.clone()]) {
                    places.push((value, "a number", now));
                }
            }
            for _ in 0..places.len().min(3) {
                let (at, what, now) = &places[(random.unit() * places.len() as f64) as usize];
                let text = format!("{}{now}{}", &markdown[..at.start], &markdown[at.end..]);
                let found = earned(&e, &text, Format::Markdown);
                count.slips += 1;
                count.by_hand += u64::from(found.open > 0.0);
                count.named += u64::from(found.named);
                // What belongs to no item earns nothing, right or wrong: a step.
                if found.points > of - 0.01 && !found.accused {
                    count.wrong.push(format!(
                        "{} {seed}, {what}: {} is {now}",
                        kind.name(),
                        &markdown[at.clone()]
                    ));
                }
            }
        });
    }
    count
}

fn expect_right_marks(kind: ExerciseKind) {
    let count = judge(kind, 0..share(1000, 3));
    println!(
        "{}: {} sheets, {} forms, {} slips, {} named, {} by hand, {} wrong marks",
        kind.name(),
        count.sheets,
        count.forms,
        count.slips,
        count.named,
        count.by_hand,
        count.wrong.len()
    );
    assert!(count.slips > 0, "{kind:?}: nothing was made wrong");
    assert!(count.wrong.is_empty(), "{} wrong marks\n{}", count.wrong.len(), count.wrong.join("\n"));
}

#[test]
fn poses_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Forward);
}

#[test]
fn tables_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Table);
}

#[test]
fn inverse_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Inverse);
}

#[test]
fn jacobians_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Jacobian);
}

#[test]
fn singularities_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Singularities);
}

#[test]
fn transforms_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Transforms);
}

#[test]
fn positions_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Position);
}

#[test]
fn statics_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Statics);
}

#[test]
fn torques_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Torques);
}

#[test]
fn paths_at_random_are_marked_right() {
    expect_right_marks(ExerciseKind::Path);
}
