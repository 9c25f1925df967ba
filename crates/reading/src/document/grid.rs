//! The rows and cells of matrices: ruled by `&` and `\\`, or plain with commas, semicolons, blanks and lines.

use super::lexer::{Bracket, Gap, Kind};
use super::tree::{Node, NodeKind};
use super::{cut, words};
use std::ops::Range;

pub(super) type Row = Vec<Range<usize>>;

/// Rows that end in `\\` with cells that end in `&`; `end` is where the last one ends.
///
/// Markdown makes `\` of `\\`: without any `\\`, a `\` before a blank ends a row if all rows are then equally long.
pub(super) fn ruled_rows(text: &str, nodes: &[Node], end: usize) -> Vec<Row> {
    let rows = rows_ended_by(text, nodes, end, |n| n.is(Kind::Row));
    let single =
        |n: &Node| n.is(Kind::Quad) && !cut(text, &n.span).contains(|c: char| c.is_ascii_alphabetic());
    if rows.len() == 1 && nodes.iter().any(single) {
        let others = rows_ended_by(text, nodes, end, single);
        let columns = others.first().map_or(0, Vec::len);
        if columns > 1 && others.iter().all(|r| r.len() == columns) {
            return others;
        }
    }
    rows
}

fn rows_ended_by(text: &str, nodes: &[Node], end: usize, ends: impl Fn(&Node) -> bool) -> Vec<Row> {
    let mut rows = vec![];
    let mut row: Row = vec![];
    let mut first = 0;
    for (i, node) in nodes.iter().enumerate() {
        let broken = ends(node);
        if node.is(Kind::Amp) || broken {
            row.push(cell(text, nodes.get(first..i).unwrap_or(&[]), node.span.start));
            first = i + 1;
        }
        if broken {
            rows.push(std::mem::take(&mut row));
        }
    }
    let last = nodes.get(first..).unwrap_or(&[]);
    // What follows the last `\\` is a row only if something stands there.
    if !row.is_empty() || !last.is_empty() {
        row.push(cell(text, last, end));
        rows.push(row);
    }
    while rows.len() > 1 && rows.last().is_some_and(|r| r.len() == 1 && r.iter().all(Range::is_empty)) {
        rows.pop();
    }
    rows
}

/// The span of a cell's nodes, without what is not shown at its ends; an empty one at `end`.
fn cell(text: &str, nodes: &[Node], end: usize) -> Range<usize> {
    let idle = |n: &&Node| {
        matches!(n.token(), Some(Kind::Quad | Kind::Comma | Kind::Semicolon | Kind::Row | Kind::Amp))
    };
    let first = nodes.iter().find(|n| !idle(n));
    let last = nodes.iter().rev().find(|n| !idle(n));
    match (first, last) {
        (Some(first), Some(last)) => trimmed_end(text, first.span.start..last.span.end),
        _ => end..end,
    }
}

/// Without a full stop behind a cell of several characters.
fn trimmed_end(text: &str, span: Range<usize>) -> Range<usize> {
    let shown = cut(text, &span);
    match shown.strip_suffix('.') {
        Some(rest) if !rest.trim_end().is_empty() && !rest.ends_with('.') => {
            span.start..span.start + rest.trim_end().len()
        }
        _ => span,
    }
}

/// `[…]` whose inside can only be a matrix: rows in brackets, several rows, or cells that are ruled.
pub(super) fn certain_rows(text: &str, nodes: &[Node], end: usize, lines: bool) -> Option<Vec<Row>> {
    if let Some(rows) = nested_rows(text, nodes, Bracket::Square) {
        return Some(rows);
    }
    if nodes.iter().any(|n| n.is(Kind::Amp) || n.is(Kind::Row)) {
        return Some(ruled_rows(text, nodes, end));
    }
    let semicolons = nodes.iter().any(|n| n.is(Kind::Semicolon));
    let rows = plain_rows(nodes, lines);
    if !(semicolons || rows.len() > 1) {
        return None;
    }
    Some(blank_rows(text, &rows, end))
}

/// `[[a, b], [c, d]]` and `{{a, b}, {c, d}}`.
pub(super) fn nested_rows(text: &str, nodes: &[Node], kind: Bracket) -> Option<Vec<Row>> {
    let mut rows = vec![];
    let mut commas = false;
    for node in nodes {
        match &node.kind {
            NodeKind::Token(Kind::Comma | Kind::Semicolon) => {}
            NodeKind::Group { bracket, inner, close, .. } if *bracket == kind => {
                commas |= inner.iter().any(|n| n.is(Kind::Comma));
                rows.push(row_of(text, inner, *close));
            }
            _ => return None,
        }
    }
    // `{{x}}` groups in LaTeX.
    if rows.is_empty() || (kind == Bracket::Brace && !(commas && rows.len() > 1)) { None } else { Some(rows) }
}

/// `[a, b, c]`, `[a \quad b]` or `[a b c]`; one of these, or nothing.
pub(super) fn single_row(text: &str, nodes: &[Node], end: usize) -> Option<Row> {
    let row = row_of(text, nodes, end);
    (row.len() > 1).then_some(row)
}

fn row_of(text: &str, nodes: &[Node], end: usize) -> Row {
    blank_rows(text, &[nodes], end).pop().unwrap_or_default()
}

/// Rows that end in `;`, or at the end of a line that does not go on.
fn plain_rows(nodes: &[Node], lines: bool) -> Vec<&[Node]> {
    let mut rows = vec![];
    let mut first = 0;
    for (i, node) in nodes.iter().enumerate() {
        let before = i.checked_sub(1).and_then(|i| nodes.get(i));
        let line = lines
            && node.gap == Gap::Line
            && i > first
            && !before
                .is_some_and(|n| matches!(n.token(), Some(Kind::Comma | Kind::Operator | Kind::Semicolon)))
            && !node.is(Kind::Comma);
        if line {
            rows.push(nodes.get(first..i).unwrap_or(&[]));
            first = i;
        }
        if node.is(Kind::Semicolon) {
            rows.push(nodes.get(first..i).unwrap_or(&[]));
            first = i + 1;
        }
    }
    rows.push(nodes.get(first..).unwrap_or(&[]));
    rows.retain(|r| !r.is_empty());
    rows
}

/// The cells of plain rows: by `&`, by commas, by written spaces or by blanks.
pub(super) fn blank_rows(text: &str, rows: &[&[Node]], end: usize) -> Vec<Row> {
    let has = |kind| rows.iter().any(|r| r.iter().any(|n| n.is(kind)));
    if has(Kind::Amp) || has(Kind::Comma) {
        let mark = if has(Kind::Amp) { Kind::Amp } else { Kind::Comma };
        return rows.iter().map(|r| split(text, r, end, |n| n.is(mark))).collect();
    }
    if has(Kind::Quad) {
        return rows.iter().map(|r| spaced(text, r)).collect();
    }
    // Columns that are set apart by two blanks everywhere leave single blanks to the cells.
    let wide: Vec<Row> = rows.iter().map(|r| by_gaps(text, r, |_, n| n.gap >= Gap::Wide)).collect();
    let columns = wide.first().map_or(0, Vec::len);
    if columns > 1 && rows.len() > 1 && wide.iter().all(|r| r.len() == columns) {
        return wide;
    }
    let by =
        |alone: bool| rows.iter().map(|r| by_gaps(text, r, |a, b| begins_cell(text, a, b, alone))).collect();
    let (as_operators, as_cells): (Vec<Row>, Vec<Row>) = (by(false), by(true));
    let pairs = || as_operators.iter().zip(&as_cells);
    // A lonely `*`, `.` or `-` is a cell that was left out where the columns of the other rows say so.
    let columns = pairs().filter(|(a, b)| a.len() == b.len()).map(|(a, _)| a.len()).max();
    let found: Vec<Row> = pairs()
        .map(|(operators, cells)| match columns {
            Some(n) if operators.len() != n && cells.len() == n => cells.clone(),
            _ => operators.clone(),
        })
        .collect();
    let least = found.iter().map(Vec::len).min().unwrap_or(0);
    found.into_iter().map(|row| with_products(text, row, least)).collect()
}

/// A row with more cells than others, `c23  -s23   0   a2 c2`: what one blank parts is a product where that makes it as long.
fn with_products(text: &str, row: Row, columns: usize) -> Row {
    let is_product = |pair: &[Range<usize>]| {
        let is_signed = cut(text, &pair[1]).starts_with(['-', '−', '+', '±', '\\']);
        cut(text, &(pair[0].end..pair[1].start)) == " " && !is_signed
    };
    if columns < 2 || row.len() - row.windows(2).filter(|p| is_product(p)).count() != columns {
        return row;
    }
    let mut merged: Row = vec![];
    for cell in row {
        match merged.last_mut() {
            Some(last) if is_product(&[last.clone(), cell.clone()]) => last.end = cell.end,
            _ => merged.push(cell),
        }
    }
    merged
}

fn split(text: &str, nodes: &[Node], end: usize, separates: impl Fn(&Node) -> bool) -> Row {
    let mut row = vec![];
    let mut first = 0;
    for (i, node) in nodes.iter().enumerate().filter(|(_, n)| separates(n)) {
        row.push(cell(text, nodes.get(first..i).unwrap_or(&[]), node.span.start));
        first = i + 1;
    }
    let last = nodes.get(first..).unwrap_or(&[]);
    if !last.is_empty() || row.is_empty() {
        row.push(cell(text, last, end));
    }
    row
}

/// Cells set apart by `\quad`; dots are a cell of their own.
fn spaced(text: &str, nodes: &[Node]) -> Row {
    let mut row = vec![];
    for part in nodes.split(|n| n.is(Kind::Quad)).filter(|p| !p.is_empty()) {
        let mut first = 0;
        for (i, dots) in part.iter().enumerate().filter(|(_, n)| n.is(Kind::Dots)) {
            if i > first {
                row.push(cell(text, part.get(first..i).unwrap_or(&[]), dots.span.start));
            }
            row.push(dots.span.clone());
            first = i + 1;
        }
        if let Some(rest) = part.get(first..).filter(|r| !r.is_empty()) {
            row.push(cell(text, rest, rest.first().map_or(0, |n| n.span.start)));
        }
    }
    row
}

fn by_gaps(text: &str, nodes: &[Node], begins: impl Fn(&[Node], &Node) -> bool) -> Row {
    let mut row = vec![];
    let mut first = 0;
    for (i, node) in nodes.iter().enumerate() {
        if i > first && begins(nodes.get(..i).unwrap_or(&[]), node) {
            row.push(cell(text, nodes.get(first..i).unwrap_or(&[]), node.span.start));
            first = i;
        }
    }
    if let Some(rest) = nodes.get(first..).filter(|r| !r.is_empty()) {
        row.push(cell(text, rest, rest.first().map_or(0, |n| n.span.start)));
    }
    row
}

/// Whether a blank before `node` parts two cells: `a -b` and `a b` do, `a - b` and `sin b` do not. With `alone`, an
/// operator between two blanks is a cell.
fn begins_cell(text: &str, before: &[Node], node: &Node, alone: bool) -> bool {
    let [.., previous] = before else { return false };
    if node.gap == Gap::None {
        return false;
    }
    let shown = cut(text, &node.span);
    let after = |n: &Node| text.get(n.span.end..).and_then(|t| t.chars().next());
    let blank_after = |n: &Node| after(n).is_none_or(|c| super::lexer::is_blank(c) || ";]\\&".contains(c));
    if node.is(Kind::Operator) {
        return (matches!(shown, "+" | "-" | "−" | "±" | "\\pm") && !blank_after(node))
            || (alone && blank_after(node));
    }
    if matches!(node.token(), Some(Kind::Script | Kind::Relation(_) | Kind::Other)) {
        return false;
    }
    if previous.is(Kind::Operator) {
        return alone && previous.gap != Gap::None;
    }
    if matches!(previous.token(), Some(Kind::Script | Kind::Relation(_) | Kind::Other)) {
        return false;
    }
    // `sin (x)`, `\cos \theta`
    let word = cut(text, &previous.span);
    !(previous.token().is_some() && words::is_function(word))
}
