//! `denavit show`: the table, and what is special about the arm.

use crate::arguments::ShowArguments;
use crate::commands::fk::{configuration, linkage};
use crate::commands::parallel;
use crate::commands::report::put;
use crate::failure::{Failure, without_values};
use crate::load;
use crate::terminal::{Align, FAINT, HEADING, NAME, note, styled, table, words};
use denavit::closure::Loops;
use denavit::description::{
    Convention, Description, JointKind, Linkage, Measure, Row, write_linkage, write_toml,
};
use denavit::geometry::Transform;
use denavit::structure::{Relation, Structure};
use denavit_report::document::plain;
use denavit_report::figure::svg::{Palette, svg};
use denavit_report::figure::{self, Arm};
use denavit_report::words::Tongue;
use denavit_symbolic::Expr;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_wire::robot::{Robot, joints};
use std::io::Write;
use std::path::Path;

/// Shows a robot.
///
/// # Errors
/// If there is no such robot or nothing can be written.
pub fn run(arguments: &ShowArguments) -> Result<(), Failure> {
    if let Some((parallel, text)) = load::parallel(&arguments.robot)? {
        return parallel::show(arguments, &parallel, &text);
    }
    if let Some(closed) = load::without_chain(&arguments.robot)? {
        return without_chain(arguments, &closed);
    }
    let mut description = load::robot(&arguments.robot)?;
    if let Some(to) = arguments.to {
        let conversion = description.converted(to.into());
        note(&format!("note: {}", words().moved(&conversion.moved)));
        description = conversion.description;
    }
    let mut out = anstream::stdout();
    if let Some(file) = &arguments.figure {
        return figure(&description, arguments, file);
    }
    if arguments.toml {
        write!(out, "{}", write_toml(&description))?;
    } else if arguments.json {
        writeln!(out, "{}", denavit_wire::text(&Robot::of(&description)))?;
    } else {
        write!(out, "{}{}{}", title(&description), dh_table(&description), structure(&description))?;
        if let Some(closed) = load::linkage(&arguments.robot)? {
            let loops = Loops::new(&closed).ok();
            write!(out, "{}", linkage::about(&closed, loops.as_ref()))?;
        }
    }
    Ok(())
}

/// Shows closed loops that are no serial chain: the rows of their tree, and how they close.
fn without_chain(arguments: &ShowArguments, closed: &Linkage) -> Result<(), Failure> {
    let given = [
        (arguments.json, "--json"),
        (arguments.figure.is_some(), "--figure"),
        (arguments.to.is_some(), "--as"),
    ];
    if let Some((_, option)) = given.into_iter().find(|g| g.0) {
        return Err(Failure::Unsupported(format!("{option} for closed loops that are no serial chain")));
    }
    let mut out = anstream::stdout();
    if arguments.toml {
        write!(out, "{}", write_linkage(closed))?;
        return Ok(());
    }
    let d = closed.all_rows();
    let (driven, passive) = (closed.driven().len(), closed.passive().len());
    let loops = closed.closures.len();
    writeln!(
        out,
        "{}: {driven} driven and {passive} passive joints, {loops} closed loop{}",
        styled(&d.name, HEADING),
        if loops == 1 { "" } else { "s" }
    )?;
    if let Some(source) = &d.source {
        writeln!(out, "{}", styled(source, FAINT))?;
    }
    let rows = closed.tree.rows.iter().zip(&closed.tree.after).enumerate();
    let on = |a: Option<usize>| a.map_or("base".into(), |a| closed.tree.frame_name(a));
    let line = |name: String, after: String, row: &Row| {
        let cells = Convention::Khalil.order().iter().map(|c| cell(c.of(row), c.turns()));
        [vec![name, after], cells.collect()].concat()
    };
    let mut lines: Vec<Vec<String>> =
        rows.map(|(j, (row, after))| line(closed.tree.frame_name(j), on(*after), row)).collect();
    for (k, c) in closed.closures.iter().enumerate() {
        lines.push(line(format!("{} |", closed.loop_name(k)), on(c.left.after), &c.left.row));
        lines.push(line(format!("| {}", closed.loop_name(k)), on(c.right.after), &c.right.row));
    }
    let letters = Convention::Khalil.order().iter().map(|c| c.letter(Convention::Khalil));
    let header: Vec<&str> = ["frame", "on"].into_iter().chain(letters).collect();
    write!(out, "\n{}", table(&header, &vec![Align::Left; header.len()], &lines))?;
    write!(out, "{}", parameters(&d))?;
    let loops = Loops::new(closed).ok();
    write!(out, "{}", linkage::about(closed, loops.as_ref()))?;
    Ok(())
}

/// Draws the arm.
fn figure(description: &Description, arguments: &ShowArguments, file: &Path) -> Result<(), Failure> {
    let ending = file.extension().map(|e| e.to_string_lossy().to_lowercase());
    if ending.as_deref().is_some_and(|e| e != "svg") {
        return Err(Failure::Usage(format!(
            "--figure {}: figures are SVG, the file ends in .svg",
            file.display()
        )));
    }
    let arm = Arm::new(&description.filled())
        .map_err(|missing| without_values(description, &arguments.robot.robot, &missing))?;
    let arm = match &arguments.q {
        Some(text) => arm.at(&configuration(description, text)?),
        None => arm,
    };
    let options = figure::FigureOptions::main();
    let drawing =
        if arguments.scheme { figure::scheme(&arm, &options) } else { figure::isometric(&arm, &options) };
    put(file, svg(&drawing, Palette::File, "arm").as_bytes())
}

/// Name, joints, convention and source.
pub fn title(d: &Description) -> String {
    let count = d.variables().len();
    let mut text = format!(
        "{}: {} joint{} ({}), {} convention\n",
        styled(&d.name, HEADING),
        count,
        if count == 1 { "" } else { "s" },
        joints(d),
        d.convention
    );
    if let Some(source) = &d.source {
        text += &format!("{}\n", styled(source, FAINT));
    }
    text
}

/// A quantity as it stands in a table: angles in degrees, lengths as formulas in metres.
fn cell(e: Expr, is_angle: bool) -> String {
    plain(&denavit_report::cell(e, is_angle, Tongue::English.words()), &Vocabulary::new())
}

/// The table in its own letters, with base, tool and the values of the parameters.
pub fn dh_table(d: &Description) -> String {
    let columns = d.columns();
    let has_limits = d.rows.iter().any(|r| r.limits.is_some());
    let has_names = d.rows.iter().any(|r| r.name.is_some());
    let mut header: Vec<&str> = vec!["j", ""];
    header.extend(columns.iter().map(|c| c.letter(d.convention)));
    if has_limits {
        header.push("limits");
    }
    if has_names {
        header.push("name");
    }
    let rows: Vec<Vec<String>> = d
        .rows
        .iter()
        .enumerate()
        .map(|(i, row)| {
            let kind = match row.variable.map(|v| v.kind) {
                Some(JointKind::Revolute) => "R",
                Some(JointKind::Prismatic) => "P",
                None => "–",
            };
            let mut cells = vec![(i + 1).to_string(), kind.to_string()];
            cells.extend(columns.iter().map(|c| cell(c.of(row), c.turns())));
            if has_limits {
                let turns = row.variable.is_some_and(|v| v.kind == JointKind::Revolute);
                let unit = if turns { "" } else { " m" };
                let text = row.limits.map(|l| format!("{} … {}{unit}", cell(l[0], turns), cell(l[1], turns)));
                cells.push(text.unwrap_or_default());
            }
            if has_names {
                cells.push(row.name.clone().unwrap_or_default());
            }
            cells
        })
        .collect();
    let mut text = format!("\n{}", table(&header, &vec![Align::Left; header.len()], &rows));
    for (what, x) in [("base", &d.base), ("tool", &d.tool)] {
        text += &placement(what, x);
    }
    text + &parameters(d)
}

/// The values of the parameters.
fn parameters(d: &Description) -> String {
    let mut text = String::new();
    if !d.parameters.is_empty() {
        let values: Vec<String> = d
            .parameters
            .iter()
            .map(|p| {
                let value = match (p.value, d.measure(p.symbol)) {
                    (Some(v), Measure::Angle) => cell(v, true),
                    (Some(v), Measure::Length) => format!("{} m", cell(v, false)),
                    (Some(v), Measure::Other(unit)) => {
                        format!("{} {unit}", cell(v, false)).trim_end().to_string()
                    }
                    (None, _) => "?".into(),
                };
                format!("{} = {value}", styled(&cell(p.symbol.into(), false), NAME))
            })
            .collect();
        text += &format!("\n  {}\n", values.join(",  "));
    }
    text
}

fn placement(what: &str, x: &Transform<Expr>) -> String {
    if *x == Transform::identity() {
        return String::new();
    }
    let rows: Vec<Vec<String>> =
        x.matrix().iter().map(|row| row.iter().map(|&e| cell(e, false)).collect()).collect();
    format!("\n{}", crate::terminal::matrix(&format!("{what} = "), &rows, Align::Left))
}

fn structure(d: &Description) -> String {
    let s = Structure::of(d);
    let mut text = format!("\n{}\n  {}\n", styled("Structure", HEADING), s.schematic());
    let list = |joints: &[usize]| words().listed(&joints.iter().map(ToString::to_string).collect::<Vec<_>>());
    // Axes in a row, whether they turn or slide.
    let mut runs: Vec<Vec<usize>> = s.parallel.clone();
    for k in (0..s.relations.len()).filter(|&k| s.relations[k] == Relation::Parallel) {
        let (before, behind): (Vec<_>, Vec<_>) =
            runs.into_iter().partition(|run| run.contains(&(k + 1)) || run.contains(&(k + 2)));
        let mut joined = [before.concat(), vec![k + 1, k + 2]].concat();
        joined.sort_unstable();
        joined.dedup();
        runs = behind;
        runs.push(joined);
    }
    runs.sort();
    for run in &runs {
        text += &format!("  axes {} are parallel\n", list(run));
    }
    for (k, relation) in s.relations.iter().enumerate() {
        if *relation != Relation::Parallel {
            text += &format!("  axes {} and {} {}\n", k + 1, k + 2, words().relation(*relation));
        }
    }
    for &first in &s.spherical {
        let part = match first + 2 {
            last if last == s.joints.len() => "a spherical wrist",
            3 => "a spherical shoulder",
            _ => "a spherical joint",
        };
        let all = list(&[first, first + 1, first + 2]);
        text += &format!("  axes {all} meet in one point: {part}\n");
    }
    for near in &s.nearly {
        text += &format!("  {}; nothing is rounded\n", words().nearly(near));
    }
    for (name, q) in &d.poses {
        let variables = d.variables();
        let values: Vec<String> =
            q.iter().zip(variables).map(|(e, v)| cell(*e, v.kind == JointKind::Revolute)).collect();
        text += &format!("  pose {}: {}\n", styled(name, NAME), values.join(", "));
    }
    text
}
