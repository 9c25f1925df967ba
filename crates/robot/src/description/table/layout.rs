//! A grid whose columns are known.

use super::columns::{Column, Role, column, lone_unit, plain};
use super::find::{Grid, GridCell, Separator};
use crate::description::units::Unit;
use std::ops::Range;

/// Heads of the angles of the joints, in words.
const ANGLES: [&str; 14] = [
    "angle",
    "rotation",
    "winkel",
    "drehwinkel",
    "gelenkwinkel",
    "angolo",
    "angolodigiunto",
    "ángulo",
    "angulo",
    "ângulo",
    "angledejoint",
    "hoek",
    "угол",
    "açı",
];

/// A Denavit–Hartenberg table, not yet read.
#[derive(Clone)]
pub(super) struct Layout {
    pub columns: Vec<Column>,
    /// The heads, for messages.
    pub heads: Vec<GridCell>,
    pub rows: Vec<Vec<GridCell>>,
    pub span: Range<usize>,
    pub separator: Separator,
    /// The letters of the columns are told, not read from a header.
    pub told: bool,
    /// Rows and columns are swapped.
    swapped: bool,
}

impl Layout {
    /// The columns of a grid, if it is a Denavit–Hartenberg table; rows and columns may be swapped.
    pub fn of(grid: &Grid) -> Option<Self> {
        let upright = || (0..grid.rows.len().min(2)).find_map(|skip| Self::upright(&grid.rows[skip..], grid));
        upright().or_else(|| {
            let layout = Self::upright(&swap(&grid.rows)?, grid)?;
            Some(Layout { swapped: true, ..layout })
        })
    }

    fn upright(rows: &[Vec<GridCell>], grid: &Grid) -> Option<Self> {
        let (heads, rows) = rows.split_first()?;
        let mut columns: Vec<Column> = heads.iter().map(|h| column(&h.text)).collect();
        let letters: Vec<Role> = columns.iter().map(|c| c.role).filter(|r| r.is_letter()).collect();
        if letters.len() < 3 || !letters.contains(&Role::Alpha) && !letters.contains(&Role::Theta) {
            return None;
        }
        // Angeles calls the length along z b; beside γ or another one it is Khalil's.
        if letters.contains(&Role::B) && ![Role::D, Role::R, Role::Gamma].iter().any(|r| letters.contains(r))
        {
            columns.iter_mut().filter(|c| c.role == Role::B).for_each(|c| c.role = Role::D);
        }
        // Some call the angles of the joints φ.
        if !letters.contains(&Role::Theta)
            && letters.len() == 3
            && let Some(k) = heads.iter().position(|h| {
                matches!(plain(&h.text).as_str(), "phi" | "phii" | "phij" | "varphi" | "varphii")
            })
        {
            columns[k].role = Role::Theta;
        }
        // Or call them by a word.
        if columns.iter().all(|c| !matches!(c.role, Role::Theta | Role::Variable))
            && letters.len() == 3
            && let Some(k) = heads.iter().position(|h| ANGLES.contains(&plain(&h.text).as_str()))
        {
            columns[k].role = Role::Theta;
        }
        let rows = below_units(&mut columns, rows);
        // Words of any language above the numbers of the rows.
        let counts =
            |k: usize, row: &Vec<GridCell>| row.first().and_then(|c| number_in(&c.text)) == Some(k + 1);
        if let Some(first) = columns.first_mut().filter(|c| c.role == Role::Other)
            && letters.len() >= 4
            && rows.iter().enumerate().all(|(k, row)| counts(k, row))
        {
            first.role = Role::Index;
        }
        let layout = Self::with_rows(columns, heads.clone(), rows, grid)?;
        Some(layout.with_angles_of_variables())
    }

    /// A table without a column θ whose variables stand in one of their own: those that no length holds are the angles.
    fn with_angles_of_variables(mut self) -> Self {
        let Some(at) = self.find(Role::Variable).filter(|_| self.find(Role::Theta).is_none()) else {
            return self;
        };
        let z: Vec<usize> = [Role::D, Role::R].into_iter().filter_map(|r| self.find(r)).collect();
        let Some(head) = self.heads.get(at).cloned() else { return self };
        for row in &mut self.rows {
            let Some(variable) = row.get(at).cloned() else { continue };
            let name = plain(&variable.text);
            let holds =
                |k: &usize| row.get(*k).is_some_and(|c| !name.is_empty() && plain(&c.text).contains(&name));
            let is_length = z.iter().any(holds);
            let text = if is_length { "0".to_string() } else { variable.text };
            row.push(GridCell { text, span: variable.span });
        }
        self.columns.push(Column { role: Role::Theta, previous: false, unit: None });
        self.heads.push(head);
        self
    }

    /// A grid whose columns are told from left to right; a number of the row may stand before them. A first row
    /// that holds no values is a header, of which the units count.
    pub fn told(grid: &Grid, letters: &[Role]) -> Option<Self> {
        let mut rows = grid.rows.as_slice();
        let first = rows.first()?;
        let numbered = first.len() == letters.len() + 1;
        if letters.len() < 3 || !numbered && first.len() != letters.len() {
            return None;
        }
        let roles = numbered.then_some(Role::Index).into_iter().chain(letters.iter().copied());
        let mut columns: Vec<Column> =
            roles.map(|role| Column { role, previous: false, unit: None }).collect();
        let is_header = |row: &[GridCell]| match numbered {
            true => number_in(&row[0].text).is_none(),
            false => {
                !row.iter().any(|c| plain(&c.text).replace("i-1", "").contains(|d: char| d.is_ascii_digit()))
            }
        };
        let place = |text: &str| GridCell { text: text.into(), span: grid.span.start..grid.span.start };
        let mut heads: Vec<GridCell> = columns.iter().map(|c| place(c.role.letter())).collect();
        if grid.ruled || is_header(first) {
            for (told, head) in columns.iter_mut().zip(first).filter(|c| c.0.role.is_letter()) {
                *told = Column { role: told.role, ..column(&head.text) };
            }
            heads = first.clone();
            rows = &rows[1..];
        }
        let rows = below_units(&mut columns, rows);
        if numbered && rows.iter().all(|r| number_in(&r[0].text).is_none()) {
            return None;
        }
        Some(Layout { told: true, ..Self::with_rows(columns, heads, rows, grid)? })
    }

    fn with_rows(
        columns: Vec<Column>,
        heads: Vec<GridCell>,
        rows: &[Vec<GridCell>],
        grid: &Grid,
    ) -> Option<Self> {
        let rows: Vec<Vec<GridCell>> =
            rows.iter().filter(|r| r.iter().any(|c| !c.text.is_empty())).cloned().collect();
        let (span, separator) = (grid.span.clone(), grid.separator);
        let layout = Layout { columns, heads, rows, span, separator, told: false, swapped: false };
        let pattern = |row: &Vec<GridCell>| {
            let index = layout.cell(row, Role::Index).map_or("", |c| c.text.trim_matches(['$', ' ', '*']));
            matches!(index, "..." | "…" | "n" | "N" | "⋮" | "\\vdots" | "\\ldots" | "\\dots" | "i")
        };
        let general = layout.rows.is_empty() || layout.rows.iter().any(pattern);
        (!general).then_some(layout)
    }

    /// The place of the header.
    pub fn head(&self) -> Range<usize> {
        let start = self.heads.first().map_or(0, |h| h.span.start);
        let end = self.heads.last().map_or(0, |h| h.span.end);
        start.min(end)..end
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
        number_in(&self.cell(row, Role::Index)?.text)
    }

    /// The number of the last row.
    fn last_number(&self) -> Option<usize> {
        self.rows.last().and_then(|r| self.number(r))
    }

    /// True if a grid begins with the number behind the last row's.
    pub(crate) fn counts_on(&self, grid: &Grid) -> bool {
        let next = grid.rows.first().and_then(|r| self.number(r));
        next.is_some() && next == self.last_number().map(|n| n + 1)
    }

    /// Takes rows without a header that stand below this table as its own: as wide as its rows, or numbered on.
    pub fn takes(&mut self, grid: &Grid) -> bool {
        let Some(first) = grid.rows.first().filter(|_| !self.swapped && !grid.ruled) else { return false };
        let wide = first.len() == self.columns.len();
        let belongs = match (self.find(Role::Index), self.number(first)) {
            _ if grid.separator == Separator::Latex => wide && self.counts_on(grid), // else it may be a matrix
            (None, _) => wide && first.iter().any(|c| c.text.contains(|d: char| d.is_ascii_digit())),
            (Some(_), Some(number)) => wide || self.last_number().is_some_and(|last| number > last),
            (Some(_), None) => false,
        };
        if self.separator != grid.separator || !belongs {
            return false;
        }
        self.rows.extend(grid.rows.iter().cloned());
        self.span.end = grid.span.end;
        true
    }

    /// True if the rows of `next` go on counting where these end, under the same heads.
    pub(crate) fn continues_in(&self, next: &Layout) -> bool {
        let roles = |l: &Layout| l.columns.iter().map(|c| (c.role, c.previous)).collect::<Vec<_>>();
        let (last, first) = (self.last_number(), next.rows.first().and_then(|r| next.number(r)));
        roles(self) == roles(next) && last.is_some() && last.map(|n| n + 1) == first
    }
}

/// The number before a word: `1 swing`, `2. boom`.
pub(super) fn number_before(text: &str) -> Option<usize> {
    let (number, word) = text.trim().split_once([' ', '~'])?;
    let is_word =
        word.len() > 1 && word.chars().all(|c| c.is_alphabetic() || matches!(c, ' ' | '-' | '(' | ')'));
    number.trim_end_matches(['.', ')', ':']).parse().ok().filter(|n| is_word && *n <= 10_000)
}

/// The number at the end of a text: `3`, `Link 3`, `$J_{3}$`, or before a word; not that of a formula.
fn number_in(text: &str) -> Option<usize> {
    if let Some(number) = number_before(text) {
        return Some(number);
    }
    let text = text.trim_end_matches(['$', '*', ' ', '}', '.', ')']);
    let digits = text.len() - text.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let before = &text[..text.len() - digits];
    if before.contains(|c: char| matches!(c, '+' | '−' | '=') || c.is_ascii_digit())
        || before.trim_start().starts_with('-')
    {
        return None;
    }
    text[text.len() - digits..].parse().ok().filter(|n| *n <= 10_000)
}

/// The rows below a header without a row of units, which the columns take.
fn below_units<'a>(columns: &mut [Column], rows: &'a [Vec<GridCell>]) -> &'a [Vec<GridCell>] {
    let Some((cells, rest)) = rows.split_first() else { return rows };
    let units: Vec<Option<Unit>> = cells.iter().map(|c| lone_unit(&c.text)).collect();
    let all = cells.iter().zip(&units).all(|(c, u)| c.text.is_empty() || u.is_some());
    if !all || units.iter().all(Option::is_none) {
        return rows;
    }
    columns.iter_mut().zip(units).for_each(|(column, unit)| column.unit = column.unit.or(unit));
    rest
}

/// Rows for columns, if all rows are equally long.
fn swap(rows: &[Vec<GridCell>]) -> Option<Vec<Vec<GridCell>>> {
    let width = rows.first()?.len();
    if rows.iter().any(|r| r.len() != width) || rows.len() > 40 {
        return None;
    }
    Some((0..width).map(|j| rows.iter().map(|r| r[j].clone()).collect()).collect())
}
