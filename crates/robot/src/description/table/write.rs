//! A description as a table for documents: Markdown, LaTeX, CSV. Base and tool are rows without joint; lines beside the table say
//! the convention and the values of names. What is written reads back to the same robot.

use super::TableKind;
use crate::description::branches::{RowTree, with_frames_as_rows};
use crate::description::cell::{decimal, write_cell};
use crate::description::lines::NotNamed;
use crate::description::units::Quantity;
use crate::description::{Cell, Convention, Description, JointKind, Row};
use denavit_symbolic::print::{Style, print, print_symbol};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Angle, Expr, Rational};
use std::fmt::Write;

/// The table of a robot in its convention, with base and tool as rows, in the dress of a document.
///
/// # Errors
/// If base or tool have names on which more than lengths depend, without values.
pub fn write_table(d: &Description, kind: TableKind) -> Result<String, NotNamed> {
    Ok(Table::of(&d.with_ends_in_rows()?, kind).written(kind))
}

/// The table of a whole tree of rows, with a column for the row that each stands on; its frames are rows with their names, and so is
/// its base. With it come the names of the frames on which nothing stands, and what they are called in the table.
///
/// # Errors
/// If base or frames have names on which more than lengths depend, without values.
pub fn write_tree_table(
    tree: &RowTree,
    kind: TableKind,
) -> Result<(String, Vec<(String, String)>), NotNamed> {
    let (mut all, _, moved) = with_frames_as_rows(tree)?;
    let has_names = all.rows.iter().any(|r| r.name.is_some());
    // A row without a name is called by its number, which may be another one here.
    let is_moved = moved.iter().enumerate().any(|(k, &row)| k != row);
    for (k, &row) in moved.iter().enumerate().filter(|_| has_names || is_moved) {
        all.rows[row].name = Some(tree.frame_name(k));
    }
    let mut table = Table::of(&all.all_rows(), kind);
    let head = if kind == TableKind::Latex { "$a(j)$" } else { "a(j)" };
    table.head.insert(1, head.into());
    for (row, after) in table.rows.iter_mut().zip(&all.after) {
        row.insert(1, after.map_or(0, |a| a + 1).to_string());
    }
    let ends = tree.tips().into_iter().map(|name| (name.clone(), name.replace('|', "/")));
    Ok((table.written(kind), ends.collect()))
}

/// A table in words.
struct Table {
    name: String,
    convention: Convention,
    head: Vec<String>,
    rows: Vec<Vec<String>>,
    /// Names and values.
    values: Vec<(String, String)>,
}

impl Table {
    fn of(d: &Description, kind: TableKind) -> Self {
        let columns = d.columns();
        let index = if d.convention == Convention::Khalil { "j" } else { "i" };
        let is_latex = kind == TableKind::Latex;
        let letter = |c: &Cell| {
            let letter =
                if is_latex { latex_letter(*c, d.convention) } else { c.letter(d.convention).into() };
            let head = match (d.convention, c) {
                (Convention::Craig, Cell::Alpha | Cell::A) => format!("{letter}_{{i-1}}"),
                _ if is_latex => format!("{letter}_{index}"),
                _ => letter,
            };
            if is_latex { format!("${head}$") } else { head }
        };
        let mut head = vec![if is_latex { format!("${index}$") } else { index.to_string() }, "type".into()];
        head.extend(columns.iter().map(letter));
        let has_limits = d.rows.iter().any(|r| r.limits.is_some());
        let has_names = d.rows.iter().any(|r| r.name.is_some());
        head.extend(["min", "max"].into_iter().filter(|_| has_limits).map(str::to_string));
        head.extend(["name"].into_iter().filter(|_| has_names).map(str::to_string));
        let text = |e: Expr, quantity| if is_latex { latex_cell(e, quantity) } else { cell(e, quantity) };
        let row = |(i, row): (usize, &Row)| {
            let kind = row.variable.map(|v| v.kind);
            let joint = kind.map_or("F", |k| if k == JointKind::Revolute { "R" } else { "P" });
            let mut cells = vec![(i + 1).to_string(), joint.to_string()];
            let quantity = |c: &Cell| if c.turns() { Quantity::Angle } else { Quantity::Length };
            cells.extend(columns.iter().map(|c| text(c.of(row), quantity(c))));
            if has_limits {
                let turns = kind != Some(JointKind::Prismatic);
                let quantity = if turns { Quantity::Angle } else { Quantity::Length };
                let both = row.limits.map(|l| l.map(|e| text(e, quantity)));
                cells.extend(both.unwrap_or_default());
            }
            if has_names {
                cells.push(row.name.clone().unwrap_or_default());
            }
            cells
        };
        let value = |p: &crate::description::Parameter| {
            Some((p.symbol.name().to_string(), text(p.value?, d.measure(p.symbol).into())))
        };
        Table {
            name: d.name.replace(|c: char| c.is_control(), " "),
            convention: d.convention,
            head,
            rows: d.rows.iter().enumerate().map(row).collect(),
            values: d.parameters.iter().filter_map(value).collect(),
        }
    }

    fn written(&self, kind: TableKind) -> String {
        match kind {
            TableKind::Markdown => self.markdown(),
            TableKind::Csv => self.csv(),
            TableKind::Latex => self.latex(),
        }
    }

    fn markdown(&self) -> String {
        let mut out = format!("# {}\n\nconvention: {}\n\n", self.name, self.convention);
        let plain = |text: &String| text.replace('|', "/");
        let all: Vec<Vec<String>> =
            [&self.head].into_iter().chain(&self.rows).map(|r| r.iter().map(plain).collect()).collect();
        let widths: Vec<usize> = (0..self.head.len())
            .map(|c| all.iter().map(|r| r[c].chars().count()).max().unwrap_or(0).max(3))
            .collect();
        for (i, row) in all.iter().enumerate() {
            for (cell, width) in row.iter().zip(&widths) {
                let _ = write!(out, "| {cell}{} ", " ".repeat(width - cell.chars().count()));
            }
            out.push_str("|\n");
            if i == 0 {
                widths.iter().for_each(|w| out.push_str(&format!("|{}", "-".repeat(w + 2))));
                out.push_str("|\n");
            }
        }
        if !self.values.is_empty() {
            out.push('\n');
        }
        for (name, value) in &self.values {
            let _ = writeln!(out, "- {name} = {value}");
        }
        out
    }

    fn csv(&self) -> String {
        let mut out = format!("# name: {}\n# convention: {}\n", self.name, self.convention);
        for (name, value) in &self.values {
            let _ = writeln!(out, "# {name} = {value}");
        }
        let quoted = |text: &String| match text.contains([',', '"', ';']) {
            true => format!("\"{}\"", text.replace('"', "\"\"")),
            false => text.clone(),
        };
        for row in [&self.head].into_iter().chain(&self.rows) {
            let cells: Vec<String> = row.iter().map(quoted).collect();
            let _ = writeln!(out, "{}", cells.join(","));
        }
        out
    }

    fn latex(&self) -> String {
        let mut out = format!("% name: {}\n% convention: {}\n", self.name, self.convention);
        let _ = writeln!(out, "\\begin{{tabular}}{{{}}}\n  \\hline", "c".repeat(self.head.len()));
        let is_name = |c: usize| self.head[c] == "name";
        for (i, row) in [&self.head].into_iter().chain(&self.rows).enumerate() {
            let text = |(c, text): (usize, &String)| if is_name(c) { escaped(text) } else { text.clone() };
            let cells: Vec<String> = row.iter().enumerate().map(text).collect();
            let _ = writeln!(out, "  {} \\\\", cells.join(" & "));
            if i == 0 {
                out.push_str("  \\hline\n");
            }
        }
        out.push_str("  \\hline\n\\end{tabular}\n");
        if !self.values.is_empty() {
            out.push('\n');
        }
        for (name, value) in &self.values {
            let value = value.trim_matches('$');
            let _ = writeln!(out, "${} = {value}$\n", print_symbol(name, Style::Latex));
        }
        out
    }
}

fn cell(e: Expr, quantity: Quantity) -> String {
    if e.is_zero() { "0".into() } else { write_cell(e, quantity) }
}

fn latex_letter(cell: Cell, convention: Convention) -> String {
    match cell {
        Cell::Gamma | Cell::Alpha | Cell::Theta => format!("\\{}", cell.key(convention)),
        Cell::B | Cell::A | Cell::D => cell.key(convention).into(),
    }
}

/// A text that LaTeX sets as it is.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if matches!(c, '_' | '&' | '%' | '#' | '$' | '{' | '}') {
            out.push('\\');
        }
        out.push(if c == '\\' || c == '~' || c == '^' { ' ' } else { c });
    }
    out
}

/// A cell as LaTeX sets it: formulas, then degrees, metres or radians.
fn latex_cell(e: Expr, quantity: Quantity) -> String {
    let mut angle = Angle::of(e);
    let (turns, number) = match quantity {
        Quantity::Angle => (std::mem::take(&mut angle.turns), std::mem::take(&mut angle.radians)),
        _ => (Rational::ZERO, std::mem::take(&mut angle.radians)),
    };
    let names = Vocabulary::new();
    let mut out = String::new();
    let symbolic = angle.to_expr();
    if !symbolic.is_zero() {
        out += &print(symbolic, &names, Style::Latex);
    }
    let unit = if quantity == Quantity::Angle { "\\,\\mathrm{rad}" } else { "\\,\\mathrm{m}" };
    for (constant, unit) in [(&turns * &Rational::from(180), "^{\\circ}"), (number, unit)] {
        if constant.is_zero() {
            continue;
        }
        out += match (out.is_empty(), constant.is_negative()) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        let size = decimal(&constant.abs());
        out += &match size.split_once('/') {
            Some((n, d)) => format!("\\frac{{{n}}}{{{d}}}{unit}"),
            None => format!("{size}{unit}"),
        };
    }
    if out.is_empty() { "0".into() } else { format!("${out}$") }
}
