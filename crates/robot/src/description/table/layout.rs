//! A grid whose columns are known.

use super::columns::{Column, Role, column, lone_unit};
use super::find::{Grid, GridCell};
use std::ops::Range;

/// A Denavit–Hartenberg table, not yet read.
pub(super) struct Layout {
    pub columns: Vec<Column>,
    /// The heads, for messages.
    pub heads: Vec<GridCell>,
    pub rows: Vec<Vec<GridCell>>,
    pub span: Range<usize>,
    pub decimal_comma: bool,
}

impl Layout {
    /// The columns of a grid, if it is a Denavit–Hartenberg table; rows and columns may be swapped.
    pub fn of(grid: &Grid) -> Option<Self> {
        let upright = || (0..grid.rows.len().min(2)).find_map(|skip| Self::upright(&grid.rows[skip..], grid));
        upright().or_else(|| {
            let swapped = swap(&grid.rows)?;
            Self::upright(&swapped, grid)
        })
    }

    fn upright(rows: &[Vec<GridCell>], grid: &Grid) -> Option<Self> {
        let (heads, mut rows) = rows.split_first()?;
        let mut columns: Vec<Column> = heads.iter().map(|h| column(&h.text)).collect();
        let letters: Vec<Role> = columns.iter().map(|c| c.role).filter(|r| r.is_letter()).collect();
        if letters.len() < 3 || !letters.contains(&Role::Alpha) && !letters.contains(&Role::Theta) {
            return None;
        }
        // a row of units below the header
        if let Some((units, rest)) = rows.split_first()
            && units.iter().any(|c| lone_unit(&c.text).is_some())
            && units.iter().all(|c| c.text.is_empty() || lone_unit(&c.text).is_some())
        {
            for (column, cell) in columns.iter_mut().zip(units) {
                column.unit = column.unit.or(lone_unit(&cell.text));
            }
            rows = rest;
        }
        Self::with_rows(columns, heads.clone(), rows, grid)
    }

    /// A grid without a header, its columns told from left to right; a number of the row may stand before them.
    pub fn without_header(grid: &Grid, letters: &str) -> Option<Self> {
        let mut columns: Vec<Column> = vec![];
        for letter in letters.split_whitespace() {
            columns.push(Column { role: Role::of_letter(letter)?, previous: false, unit: None });
        }
        let width = grid.rows.iter().map(Vec::len).max()?;
        if width == columns.len() + 1 {
            columns.insert(0, Column { role: Role::Index, previous: false, unit: None });
        }
        if width != columns.len() || columns.len() < 3 {
            return None;
        }
        let heads = columns
            .iter()
            .map(|c| GridCell { text: c.role.letter().into(), span: grid.span.clone() })
            .collect();
        Self::with_rows(columns, heads, &grid.rows, grid)
    }

    fn with_rows(
        columns: Vec<Column>,
        heads: Vec<GridCell>,
        rows: &[Vec<GridCell>],
        grid: &Grid,
    ) -> Option<Self> {
        let rows: Vec<Vec<GridCell>> =
            rows.iter().filter(|r| r.iter().any(|c| !c.text.is_empty())).cloned().collect();
        let layout =
            Layout { columns, heads, rows, span: grid.span.clone(), decimal_comma: grid.decimal_comma };
        let pattern = |row: &Vec<GridCell>| {
            let index = layout.cell(row, Role::Index).map_or("", |c| c.text.trim_matches(['$', ' ', '*']));
            matches!(index, "..." | "…" | "n" | "N" | "⋮" | "\\vdots" | "\\ldots" | "\\dots" | "i")
        };
        let general = layout.rows.is_empty() || layout.rows.iter().any(pattern);
        (!general).then_some(layout)
    }

    /// The column with a role.
    pub fn find(&self, role: Role) -> Option<usize> {
        self.columns.iter().position(|c| c.role == role)
    }

    /// A row's cell in the column with a role.
    pub fn cell<'a>(&self, row: &'a [GridCell], role: Role) -> Option<&'a GridCell> {
        row.get(self.find(role)?)
    }

    /// The number that a row gives itself.
    pub fn number(&self, row: &[GridCell]) -> Option<usize> {
        let text = &self.cell(row, Role::Index)?.text;
        let text = text.trim_end_matches(['$', '*', ' ', '}', '.', ')']);
        let digits = text.len() - text.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        text[text.len() - digits..].parse().ok().filter(|n| *n <= 10_000)
    }

    /// True if the rows of `next` go on counting where these end, under the same heads.
    pub fn continues_in(&self, next: &Layout) -> bool {
        let roles = |l: &Layout| l.columns.iter().map(|c| (c.role, c.previous)).collect::<Vec<_>>();
        let last = self.rows.last().and_then(|r| self.number(r));
        let first = next.rows.first().and_then(|r| next.number(r));
        roles(self) == roles(next) && last.is_some() && last.map(|n| n + 1) == first
    }
}

/// Rows for columns, if all rows are equally long.
fn swap(rows: &[Vec<GridCell>]) -> Option<Vec<Vec<GridCell>>> {
    let width = rows.first()?.len();
    if rows.iter().any(|r| r.len() != width) || rows.len() > 40 {
        return None;
    }
    Some((0..width).map(|j| rows.iter().map(|r| r[j].clone()).collect()).collect())
}
