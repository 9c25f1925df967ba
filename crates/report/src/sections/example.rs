//! Numbers at a configuration, held against the product of the link transforms.

use super::setting::Setting;
use crate::cell::decimals;
use crate::document::{Factor, Line, Math, Part, Section, Table};
use crate::words::{Caption, Column, Heading, Wording};
use denavit::description::JointKind;
use denavit::geometry::Transform;
use denavit::geometry::orientation::{EulerSet, OrientationSet, extract};
use denavit_symbolic::{Expr, Symbol};

/// The steps of the algorithm in numbers, and the pose; nothing if the robot is not one in numbers.
pub fn section(s: &Setting) -> Option<Section> {
    let (robot, _) = s.robot()?;
    let model = s.forward();
    let steps = model.algorithm.steps();
    let names = steps.iter().fold(s.description.vocabulary(), |v, step| v.symbol(&step.name));
    let mut section = Section::new(names);
    section.heading(2, Line::new(s.words().heading(Heading::Example)));
    if let Some(assumed) = s.assumed() {
        section.paragraph(assumed);
    }
    section.paragraph(s.words().example(s.configuration(&s.q)));

    let variables = s.description.variables();
    let mut values: Vec<(Symbol, f64)> =
        variables.iter().map(|v| v.symbol).zip(s.q.iter().copied()).collect();
    values.extend(s.valued.known_values());
    let value =
        |e: Expr, values: &[(Symbol, f64)]| e.eval(|x| values.iter().rev().find(|v| v.0 == x).map(|v| v.1));
    let mut rows: Vec<[Line; 2]> = vec![];
    for step in steps.iter().filter(|s| s.value.as_number().is_none()) {
        let x = value(step.value, &values).ok()?;
        let symbol = Expr::symbol(&step.name);
        values.extend(symbol.as_symbol().map(|symbol| (symbol, x)));
        rows.push([Line::default().math(symbol), Line::new(s.words().written(decimals(x, 6)))]);
    }
    section.push(Part::Table(side_by_side(
        &rows,
        [Column::Step, Column::Value].map(|c| Line::new(s.words().column(c))),
        Line::new(s.words().caption(Caption::Steps)),
    )));

    let pose = robot.pose(&s.q);
    section.paragraph(Line::new(s.words().example_pose()));
    section.formula(numbers(&pose));
    let angles = |set: OrientationSet| -> String {
        let values = extract(&pose.rotation, set).values;
        let written = |x: &f64| s.words().written(format!("{}°", decimals(x.to_degrees(), 2)));
        values.iter().map(written).collect::<Vec<_>>().join(s.words().between())
    };
    let (rpy, zyz) = (angles(OrientationSet::Rpy), angles(OrientationSet::Euler(EulerSet::ZYZ)));
    section.paragraph(Line::new(s.words().orientation(&rpy, &zyz)));
    let by_steps = |x: &str| values.iter().rev().find(|v| *v.0.name() == *x).map(|v| v.1);
    let entries = pose.matrix();
    let far = (0..3).flat_map(|r| (0..4).map(move |c| (r, c))).filter_map(|(r, c)| {
        let name = denavit::forward::entry_name((r, c));
        Some((by_steps(&name)? - entries[r][c]).abs())
    });
    let far = far.fold(0.0, f64::max);
    section.paragraph(Line::new(s.words().difference(&s.words().written(power(far)))));
    Some(section)
}

/// A table of pairs, several beside each other so that it is not long.
fn side_by_side(pairs: &[[Line; 2]], head: [Line; 2], caption: Line) -> Table {
    let across = if pairs.len() > 8 { 3 } else { 1 };
    let down = pairs.len().div_ceil(across);
    let row = |r: usize| -> Vec<Line> {
        (0..across).flat_map(|c| pairs.get(c * down + r).cloned().unwrap_or_default()).collect()
    };
    Table {
        caption,
        head: (0..across).flat_map(|_| head.clone()).collect(),
        rows: (0..down).map(row).collect(),
    }
}

/// A pose in numbers with four decimals.
pub fn numbers(pose: &Transform<f64>) -> Math {
    let entry = |x: &f64| {
        let text = format!("{x:.4}");
        // What is 0 by rounding has no sign, and what is 0 or 1 by its place no decimals.
        let text = if text == "-0.0000" { "0.0000".into() } else { text };
        let is_whole = (x - x.round()).abs() < 1e-12 && x.abs() < 1.5;
        if is_whole { format!("{:.0}", x.round() + 0.0) } else { text }
    };
    let rows = pose.matrix().iter().map(|row| row.iter().map(entry).collect()).collect();
    Math::Numbers(Factor::named("T"), rows)
}

/// A small number with a power of ten: 4.4·10⁻¹⁶.
fn power(x: f64) -> String {
    let text = format!("{x:.1e}");
    let Some((digits, exponent)) = text.split_once('e').filter(|_| x != 0.0) else { return "0".into() };
    let raised = exponent.chars().map(|c| match c.to_digit(10) {
        Some(n) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][n as usize],
        None => '⁻',
    });
    format!("{digits}·10{}", raised.collect::<String>())
}

/// A joint's value in a table: degrees or metres, without unit.
pub fn plain(x: f64, kind: JointKind, words: &dyn Wording) -> String {
    words.written(match kind {
        JointKind::Revolute => decimals(x.to_degrees(), 2),
        JointKind::Prismatic => decimals(x, 4),
    })
}
