//! Denavit–Hartenberg tables as they stand in documents: Markdown, CSV, LaTeX.
//!
//! A table is found by its header, which names at least three of θ, d, a, α, r; rows and columns may be swapped.
//! What a table does not say stands in [`TableOptions`], or in lines of the same text:
//!
//! ```text
//! convention: khalil              standard, craig or khalil
//! columns: theta alpha a d        its columns from left to right, where the table uses other letters
//! angles: deg                     the unit of angles without one: deg or rad
//! lengths: mm                     the unit of lengths without one: m, cm, mm, in, …
//! name: Stäubli RX-90
//! D3 = 450 mm                     the value of a symbol
//! ```
//!
//! **The convention is never guessed.** It is told, or it follows from the columns, and then a note says why:
//! `α_{i-1}` and `a_{i-1}` mean that the row begins with the x axis of the frame before (craig, or with `r`
//! khalil); γ and b occur with Khalil alone. Sentences tell it, too, in the languages of courses (`the table follows
//! Craig's convention`), where the text names one convention only; a note says where.
//!
//! **The joint.** A σ column decides (0 revolute, 1 prismatic); else a column q that names the variable; else a
//! star (`θ1*`); else the symbol: θᵢ, qᵢ or tᵢ in the θ cell of row i turns, dᵢ, rᵢ or qᵢ in the length along z
//! slides. A row without any is a fixed transform. Variables are renamed `q1`, `q2`, …; other symbols become
//! parameters.
//!
//! **Stars.** The star of a row is in the cell that moves. In a table with stars, a row without one turns if its θ
//! cell holds its own symbol (authors forget the star next to an offset); dᵢ without a star is a constant there.
//!
//! **Nothing is dropped in silence.** A row with too few or too many cells is an error, and so are rows below a
//! blank line or a line of text that do not go on counting; empty cells are 0, and a note says so.

mod after;
mod columns;
mod each;
mod find;
mod joint;
mod latex;
mod layout;
mod letters;
mod limits;
mod lines;
mod marks;
mod read;
mod said;
mod told;
mod values;
mod write;

pub use each::{PrintedGrid, PrintedRow, PrintedTable, grids, tables};
pub use said::{convention_said, millimetres_said};
pub use write::{write_table, write_tree_table};

use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::toolbox::{makes_robot, read_program};
use super::{Convention, Described, Description, MAX_BYTES, MAX_ROWS, RowTree};
use find::Grid;
use layout::Layout;
use lines::{Around, Lines};
use std::ops::Range;

/// How a text holds its table.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TableKind {
    /// Pipe tables, lines with tabs, and LaTeX tables among other text.
    Markdown,
    /// Fields between commas, semicolons (then `0,5` is a half) or tabs.
    Csv,
    /// `tabular`, `array`, `longtable` in a document or alone.
    Latex,
}

/// What a table may leave open. Options win over lines of the text.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct TableOptions {
    /// The convention.
    pub convention: Option<Convention>,
    /// Whether angles without unit are degrees (else radians).
    pub angles_in_degrees: Option<bool>,
    /// Whether lengths without unit are millimetres (else metres).
    pub lengths_in_millimetres: Option<bool>,
    /// Which table of the text to read, counted from 1; tables that continue each other's row numbers are one.
    pub table: Option<usize>,
    /// The convention's letters for the columns θ, d, a, α, r from left to right: `theta alpha a d`.
    pub columns: Option<String>,
}

/// Reads the table of a text; of a tree, which has a column a(j), the chain to the frame with the most joints on the way. With the
/// description come warnings and notes.
///
/// # Errors
/// All errors of the text (with the warnings and notes), in the order of the text.
pub fn read_table(
    text: &str,
    kind: TableKind,
    options: &TableOptions,
) -> Result<(Description, Vec<Diagnostic>), Vec<Diagnostic>> {
    read_table_robot(text, kind, options).and_then(|(read, findings)| read.chain(findings))
}

/// Reads the table of a text, which may be one of a tree. With what it describes come warnings and notes.
///
/// # Errors
/// All errors of the text (with the warnings and notes), in the order of the text.
pub fn read_table_robot(
    text: &str,
    kind: TableKind,
    options: &TableOptions,
) -> Result<(Described, Vec<Diagnostic>), Vec<Diagnostic>> {
    let mut out = Diagnostics::default();
    if text.len() > MAX_BYTES {
        out.error(0..0, format!("the text has {} bytes; {MAX_BYTES} are allowed", text.len()));
        return out.finish(None);
    }
    // A byte order mark is blanked out, so that all places stay where they are.
    let blanked = text.strip_prefix('\u{feff}').map(|rest| format!("   {rest}"));
    let text = blanked.as_deref().unwrap_or(text);
    let lines = Lines::of(text);
    let layouts = layouts(&grids_of(text, kind), &lines, options, &mut out);
    if layouts.is_empty()
        && kind == TableKind::Markdown
        && let Some(language) = makes_robot(text)
    {
        let (d, mut findings) = read_program(text, language, options.table)?;
        let said = options.convention.filter(|c| *c != d.convention);
        if let Some(said) = said {
            let message = format!(
                "the program's links are in the convention {}, not {}",
                d.convention.name(),
                said.name()
            );
            let finding = Diagnostic { severity: Severity::Error, span: 0..0, message, hint: None };
            findings.insert(0, finding);
            return Err(findings);
        }
        return Ok((Described::Chain(Box::new(d)), findings));
    }
    let chosen = choose(text, &layouts, options.table, &mut out);
    let description = match chosen.as_slice() {
        [] => None,
        chosen if chosen.iter().map(|l| l.rows.len()).sum::<usize>() > MAX_ROWS => {
            out.error(chosen[0].span.clone(), format!("more than {MAX_ROWS} rows"));
            None
        }
        chosen => {
            let around = Around::of(chosen, &layouts, text.len());
            read::description(text, chosen, &lines, &around, options, &mut out).map(|r| {
                let read::Reading { description: d, after, .. } = r;
                match after {
                    Some(after) => Described::Tree(Box::new(RowTree::of_rows(d, after))),
                    None => Described::Chain(Box::new(d)),
                }
            })
        }
    };
    out.finish(description)
}

/// What a text sets in rows and columns, or what it tells row by row where nothing of that is a table.
fn grids_of(text: &str, kind: TableKind) -> Vec<Grid> {
    let mut grids = find::grids(text, kind);
    if kind != TableKind::Csv && !grids.iter().any(|g| Layout::of(g).is_some()) {
        grids.extend(told::grids(text));
        grids.sort_by_key(|g| g.span.start);
    }
    grids
}

/// The tables of the grids: those with a header, or those that are as wide as the told columns.
fn layouts(grids: &[Grid], lines: &Lines, options: &TableOptions, out: &mut Diagnostics) -> Vec<Layout> {
    let gather = |read: &dyn Fn(&Grid) -> Option<Layout>, headless: bool| {
        let mut found: Vec<Layout> = vec![];
        for grid in grids {
            if headless && found.last_mut().is_some_and(|above| above.counts_on(grid) && above.takes(grid)) {
                continue;
            }
            match read(grid) {
                Some(layout) => found.push(layout),
                None => drop(found.last_mut().map(|above| above.takes(grid))),
            }
        }
        found
    };
    let headed = gather(&Layout::of, false);
    let mut findings = Diagnostics::default();
    let told = letters::told_letters(lines, 0, options, &mut findings);
    if headed.is_empty() {
        findings.list().iter().for_each(|f| out.add(f.clone()));
    }
    let Some(told) = told else { return headed };
    let letters = |l: &Layout| l.columns.iter().filter(|c| c.role.is_letter()).count();
    if headed.iter().any(|l| letters(l) == told.len()) {
        return headed;
    }
    let named = gather(&|grid| Layout::told(grid, &told), true);
    if named.is_empty() { headed } else { named }
}

/// The tables to read, in order.
fn choose<'a>(
    text: &str,
    layouts: &'a [Layout],
    table: Option<usize>,
    out: &mut Diagnostics,
) -> Vec<&'a Layout> {
    if layouts.is_empty() {
        out.error(0..0, "there is no Denavit-Hartenberg table in the text")
            .hint(
                "a table has a header with at least three of theta, d, a, alpha, r, and numbered rows; where it \
                 names them otherwise, say what its columns are from left to right: `columns: theta d a alpha`",
            );
        return vec![];
    }
    // Tables that continue each other are one.
    let mut groups: Vec<Range<usize>> = vec![];
    for (i, layout) in layouts.iter().enumerate() {
        match groups.last_mut() {
            Some(group) if layouts[i - 1].continues_in(layout) => group.end = i + 1,
            _ => groups.push(i..i + 1),
        }
    }
    let index = if groups.len() == 1 { table.unwrap_or(1) } else { table.unwrap_or(0) };
    if let Some(group) = index.checked_sub(1).and_then(|i| groups.get(i)) {
        return layouts[group.clone()].iter().collect();
    }
    let list: Vec<String> = groups
        .iter()
        .take(20)
        .enumerate()
        .map(|(i, group)| {
            let line = super::line_column(text, layouts[group.start].span.start).0;
            let rows: usize = layouts[group.clone()].iter().map(|l| l.rows.len()).sum();
            format!("{} (line {line}, {rows} row{})", i + 1, if rows == 1 { "" } else { "s" })
        })
        .collect();
    match table {
        Some(wrong) => out.error(0..0, format!("there is no table {wrong}")),
        None => {
            out.error(layouts[groups[1].start].span.clone(), format!("the text has {} tables", groups.len()))
        }
    }
    .hint(format!("choose one with --table: {}", list.join(", ")));
    vec![]
}
