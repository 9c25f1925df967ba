//! All tables of a text, each with the robot that it makes of those before it.

use super::columns::Role;
use super::find;
use super::layout::Layout;
use super::lines::{Around, Lines};
use super::{TableKind, TableOptions, grids_of, layouts, read};
use crate::description::diagnostic::{Diagnostic, Diagnostics};
use crate::description::{Cell, Description, MAX_BYTES, MAX_ROWS};
use std::ops::Range;

/// The most tables of a text that are read.
const MAX_TABLES: usize = 100;

/// A table as it stands in a text.
#[derive(Clone, Debug)]
pub struct PrintedTable {
    /// Where it stands.
    pub span: Range<usize>,
    /// The number of its first row; above 1, the rows before it are those of tables further up.
    pub first: usize,
    /// The robot up to the last row of the table, with what is worth saying about it, or what is wrong.
    pub robot: Result<(Description, Vec<Diagnostic>), Vec<Diagnostic>>,
    /// The names of the joint variables in print.
    pub variables: Vec<Option<String>>,
    /// The letters in print for the lengths along x and z (`a`, `d` or `r`).
    pub letters: [Option<&'static str>; 2],
    /// The index of the length along x is that of the row before: `a_{i-1}`.
    pub previous: bool,
    /// The rows that stand in this table.
    pub rows: Vec<PrintedRow>,
}

/// A row of a table as it stands in a text.
#[derive(Clone, Debug)]
pub struct PrintedRow {
    /// Where it stands.
    pub span: Range<usize>,
    /// Its cells that describe the arm: which, the number of the column from 1, and where.
    pub cells: Vec<(Cell, usize, Range<usize>)>,
}

/// Rows of cells as they stand in a text, each cell with its place; the first row may be a head.
pub type PrintedGrid = Vec<Vec<(String, Range<usize>)>>;

/// Whatever a text sets in rows and columns, in its order.
pub fn grids(text: &str, kind: TableKind) -> Vec<PrintedGrid> {
    if text.len() > MAX_BYTES {
        return vec![];
    }
    let cells = |row: &Vec<find::GridCell>| row.iter().map(|c| (c.text.clone(), c.span.clone())).collect();
    find::grids(text, kind).iter().map(|grid| grid.rows.iter().map(cells).collect()).collect()
}

/// The tables of a text in their order. A table whose rows are numbered from k > 1 on goes on where the last table
/// that has a row k − 1 stands, and replaces the rows that one has from k on.
pub fn tables(text: &str, kind: TableKind, options: &TableOptions) -> Vec<PrintedTable> {
    if text.len() > MAX_BYTES {
        return vec![];
    }
    let lines = Lines::of(text);
    let layouts = layouts(&grids_of(text, kind), &lines, options, &mut Diagnostics::default());
    let numbers = |l: &Layout| l.rows.iter().filter_map(|r| l.number(r)).collect::<Vec<usize>>();
    let mut chains: Vec<Vec<Layout>> = vec![];
    let mut found = vec![];
    for layout in layouts.iter().take(MAX_TABLES) {
        let first = numbers(layout).first().copied().unwrap_or(1);
        let before = chains.iter().rev().filter(|_| first > 1).find_map(|chain| {
            let mut chain = chain.clone();
            chain.iter_mut().for_each(|l| {
                let keep: Vec<bool> = l.rows.iter().map(|r| l.number(r).is_some_and(|n| n < first)).collect();
                let mut keep = keep.into_iter();
                l.rows.retain(|_| keep.next().unwrap_or(false));
            });
            chain.retain(|l| !l.rows.is_empty());
            chain.last().is_some_and(|l| numbers(l).last() == Some(&(first - 1))).then_some(chain)
        });
        let mut chain = before.unwrap_or_default();
        chain.push(layout.clone());
        let parts: Vec<&Layout> = chain.iter().collect();
        let mut out = Diagnostics::default();
        let reading = if parts.iter().map(|l| l.rows.len()).sum::<usize>() > MAX_ROWS {
            out.error(layout.span.clone(), format!("more than {MAX_ROWS} rows"));
            None
        } else {
            let around = Around::of(&parts, &layouts, text.len());
            read::description(text, &parts, &lines, &around, options, &mut out)
        };
        let (variables, letters, previous) = match &reading {
            Some(r) => (r.variables.clone(), [r.along_x, r.along_z], r.previous),
            None => (vec![], [None, None], false),
        };
        let robot = out.finish(reading.map(|r| r.description));
        let rows = layout.rows.iter().map(|row| printed(layout, row, letters)).collect();
        found.push(PrintedTable {
            span: layout.span.clone(),
            first,
            robot,
            variables,
            letters,
            previous,
            rows,
        });
        chains.push(chain);
    }
    found
}

/// A row with what its cells are, by the letters of the lengths along x and z.
fn printed(layout: &Layout, row: &[find::GridCell], [along_x, along_z]: [Option<&str>; 2]) -> PrintedRow {
    let cell = |role: Role| match role {
        Role::Theta => Some(Cell::Theta),
        Role::Alpha => Some(Cell::Alpha),
        Role::Gamma => Some(Cell::Gamma),
        Role::B => Some(Cell::B),
        _ if role.is_letter() && along_x == Some(role.letter()) => Some(Cell::A),
        _ if role.is_letter() && along_z == Some(role.letter()) => Some(Cell::D),
        _ => None,
    };
    let columns = layout.columns.iter().zip(row).enumerate();
    let cells =
        columns.filter_map(|(k, (c, text))| Some((cell(c.role)?, k + 1, text.span.clone()))).collect();
    let (first, last) = (row.first(), row.last());
    let span = first.map_or(0, |c| c.span.start)..last.map_or(0, |c| c.span.end);
    PrintedRow { span, cells }
}
