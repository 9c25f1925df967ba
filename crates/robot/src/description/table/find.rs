//! Where a text has something with rows and columns.

use super::{TableKind, latex};
use std::ops::Range;

/// A cell of a grid: its text and place, without the space around it.
#[derive(Clone, Debug)]
pub(super) struct GridCell {
    pub text: String,
    pub span: Range<usize>,
}

impl GridCell {
    /// The part of `text` in `span`, trimmed.
    pub fn of(text: &str, span: Range<usize>) -> Self {
        let raw = &text[span.clone()];
        let start = span.start + (raw.len() - raw.trim_start().len());
        GridCell { text: raw.trim().to_string(), span: start..start + raw.trim().len() }
    }
}

/// Rows of cells.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub rows: Vec<Vec<GridCell>>,
    pub span: Range<usize>,
    /// Fields are separated by semicolons, so a comma may stand in a number.
    pub decimal_comma: bool,
}

/// The longest row that is looked at, and the most rows.
const MAX_COLUMNS: usize = 600;

/// All grids of a text in their order.
pub(super) fn grids(text: &str, kind: TableKind) -> Vec<Grid> {
    let mut found = match kind {
        TableKind::Markdown => {
            let mut grids = blocks(text, split_pipes, false);
            grids.extend(blocks(text, |t, s| split_fields(t, s, '\t'), false));
            grids.extend(latex::grids(text));
            grids
        }
        TableKind::Csv => {
            let count = |d: char| {
                blocks(text, |t, s| split_fields(t, s, d), true).iter().map(|g| g.rows.len()).sum::<usize>()
            };
            let delimiter = ['\t', ';', ','].into_iter().rev().max_by_key(|&d| count(d)).unwrap_or(',');
            let mut grids = blocks(text, |t, s| split_fields(t, s, delimiter), true);
            grids.iter_mut().for_each(|g| g.decimal_comma = delimiter == ';');
            grids
        }
        TableKind::Latex => latex::grids(text),
    };
    found.retain(|g| g.rows.iter().all(|r| r.len() <= MAX_COLUMNS));
    found.sort_by_key(|g| g.span.start);
    found
}

/// The lines of a text with their places, without the line ends.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    text.split_inclusive('\n').map(move |line| {
        let span = start..start + line.trim_end_matches(['\n', '\r']).len();
        start += line.len();
        span
    })
}

/// Runs of lines that `split` takes for rows of at least three cells; with `loose`, blank lines and comments
/// do not end a run.
fn blocks(text: &str, split: impl Fn(&str, Range<usize>) -> Option<Vec<GridCell>>, loose: bool) -> Vec<Grid> {
    let mut grids: Vec<Grid> = vec![];
    let mut open = false;
    for span in lines(text) {
        let line = text[span.clone()].trim();
        if loose && (line.is_empty() || line.starts_with('#')) {
            continue;
        }
        match split(text, span.clone()) {
            Some(cells) => {
                if !open {
                    grids.push(Grid { rows: vec![], span: span.clone(), decimal_comma: false });
                }
                open = true;
                if let Some(grid) = grids.last_mut() {
                    grid.span.end = span.end;
                    if !cells.iter().all(is_rule) {
                        grid.rows.push(cells);
                    }
                }
            }
            None => open = false,
        }
    }
    grids
}

/// `---`, `:--:`
fn is_rule(cell: &GridCell) -> bool {
    !cell.text.is_empty()
        && cell.text.chars().all(|c| matches!(c, '-' | ':' | '=' | '+'))
        && cell.text.len() > 1
}

/// The cells of a line with `|` between them.
fn split_pipes(text: &str, span: Range<usize>) -> Option<Vec<GridCell>> {
    let line = &text[span.clone()];
    let mut cuts = vec![];
    let mut escaped = false;
    for (i, c) in line.char_indices() {
        if c == '|' && !escaped {
            cuts.push(span.start + i);
        }
        escaped = c == '\\';
    }
    if cuts.len() < 2 {
        return None;
    }
    let mut cells = cells_between(text, span, &cuts);
    if cells.first().is_some_and(|c| c.text.is_empty()) && line.trim_start().starts_with('|') {
        cells.remove(0);
    }
    if cells.last().is_some_and(|c| c.text.is_empty()) && line.trim_end().ends_with('|') {
        cells.pop();
    }
    (cells.len() >= 3).then_some(cells)
}

/// The fields of a line; a field in quotes may hold the delimiter.
fn split_fields(text: &str, span: Range<usize>, delimiter: char) -> Option<Vec<GridCell>> {
    let line = &text[span.clone()];
    let mut cuts = vec![];
    let mut quoted = false;
    for (i, c) in line.char_indices() {
        match c {
            '"' if delimiter != '\t' => quoted = !quoted,
            c if c == delimiter && !quoted => cuts.push(span.start + i),
            _ => {}
        }
    }
    if cuts.len() < 2 {
        return None;
    }
    let mut cells = cells_between(text, span, &cuts);
    for cell in &mut cells {
        if cell.text.len() >= 2 && cell.text.starts_with('"') && cell.text.ends_with('"') {
            *cell = GridCell::of(text, cell.span.start + 1..cell.span.end - 1);
        }
    }
    Some(cells)
}

/// The pieces of `span` between one-byte separators.
pub(super) fn cells_between(text: &str, span: Range<usize>, cuts: &[usize]) -> Vec<GridCell> {
    let starts = std::iter::once(span.start).chain(cuts.iter().map(|c| c + 1));
    let ends = cuts.iter().copied().chain([span.end]);
    starts.zip(ends).map(|(start, end)| GridCell::of(text, start..end)).collect()
}
