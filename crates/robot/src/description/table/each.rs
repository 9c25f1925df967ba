//! All tables of a text, each with the robot that it makes of those before it.

use super::find;
use super::layout::Layout;
use super::lines::{Around, Lines};
use super::{TableKind, TableOptions, layouts, read};
use crate::description::diagnostic::{Diagnostic, Diagnostics};
use crate::description::{Description, MAX_BYTES, MAX_ROWS};
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
}

/// The tables of a text in their order. A table whose rows are numbered from k > 1 on goes on where the last table
/// that has a row k − 1 stands, and replaces the rows that one has from k on.
pub fn tables(text: &str, kind: TableKind, options: &TableOptions) -> Vec<PrintedTable> {
    if text.len() > MAX_BYTES {
        return vec![];
    }
    let lines = Lines::of(text);
    let layouts = layouts(&find::grids(text, kind), &lines, options, &mut Diagnostics::default());
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
        found.push(PrintedTable { span: layout.span.clone(), first, robot, variables, letters, previous });
        chains.push(chain);
    }
    found
}
