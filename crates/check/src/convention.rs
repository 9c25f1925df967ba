//! Tables whose convention nothing says, in each of them; and lengths that are in millimetres throughout.

use denavit::description::table::{PrintedTable, tables};
use denavit::description::{Convention, TableKind, TableOptions};
use denavit_symbolic::Expr;
use std::ops::Range;

/// Where a text has a length in millimetres, if its only lengths with a unit are so: `d (mm)`, `80 mm`.
pub(super) fn only_in_millimetres(text: &str) -> Option<Range<usize>> {
    let places = |unit: &str| -> Vec<usize> {
        let is_unit = |at: &usize| {
            let (before, behind) = (&text[..*at], &text[at + unit.len()..]);
            let is_apart = before.ends_with(['(', '[', ' ', '~', ',', '{'])
                || before.ends_with(|c: char| c.is_ascii_digit());
            let number = before.trim_end_matches([' ', '~', ',', '\\', '{']);
            let is_number = number.ends_with(|c: char| c.is_ascii_digit());
            let ends = !behind.starts_with(|c: char| c.is_alphanumeric() || c == '_');
            let is_head = before.ends_with(['(', '[']) && behind.starts_with([')', ']']);
            is_apart && ends && (is_number || is_head)
        };
        text.match_indices(unit).map(|m| m.0).filter(is_unit).collect()
    };
    let found = places("mm");
    (found.len() > 1 && places("m").is_empty()).then(|| found[0]..found[0] + 2)
}

/// True for tables with lengths without a unit that no arm has in metres.
pub(super) fn has_long_rows(tables: &[PrintedTable]) -> bool {
    let rows = tables.iter().filter_map(|t| t.robot.as_ref().ok()).flat_map(|(d, _)| &d.rows);
    rows.flat_map(|r| [r.a, r.d, r.b]).filter_map(Expr::as_number).any(|x| x.to_f64().abs() > 20.0)
}

/// The tables that can be read, one whose convention nothing says in each of them; and whether it was tried.
pub(super) fn in_each(
    text: &str,
    kind: TableKind,
    reading: &TableOptions,
    printed: &[PrintedTable],
) -> Vec<(PrintedTable, bool)> {
    let is_open = |t: &PrintedTable| t.robot.is_err() && reading.convention.is_none();
    let tried: Vec<PrintedTable> = match printed.iter().take(MAX_TABLES).any(is_open) {
        false => vec![],
        true => Convention::ALL
            .into_iter()
            .flat_map(|c| tables(text, kind, &TableOptions { convention: Some(c), ..reading.clone() }))
            .collect(),
    };
    let of = |table: &PrintedTable| -> Vec<(PrintedTable, bool)> {
        if !is_open(table) {
            return vec![(table.clone(), false)];
        }
        tried.iter().filter(|t| t.span == table.span).map(|t| (t.clone(), true)).collect()
    };
    printed.iter().take(MAX_TABLES).flat_map(of).collect()
}

/// The most tables that are held against a robot.
const MAX_TABLES: usize = 12;
