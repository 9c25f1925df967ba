//! Matrices that are drawn over several lines: `⎡ ⎢ ⎣`, `| a b |`, and brackets on every line.

use super::grid::blank_rows;
use super::lexer::{Gap, is_blank, lex};
use super::lines::{line, trimmed};
use super::statements::{Manner, Reader};
use super::tree::{Node, NodeKind, build};
use super::{Fence, Grid, cut};
use std::ops::Range;

const OPENING: &str = "⎡⎢⎣⎛⎜⎝┌└";
const CLOSING: &str = "⎤⎥⎦⎞⎟⎠┐┘";
const EITHER: &str = "│┃|";
const MOST_LINES: usize = 60;
const LONGEST_LINE: usize = 4000;

/// A row of a drawn matrix: its column, its inside with the bars.
struct Piece {
    column: usize,
    span: Range<usize>,
    inner: Range<usize>,
    fence: Fence,
}

/// The rows on one line; none if the line is not drawn.
fn pieces(text: &str, line: &Range<usize>) -> Vec<Piece> {
    let shown = cut(text, line);
    if shown.len() > LONGEST_LINE {
        return vec![];
    }
    let mut out = vec![];
    let mut open: Option<(usize, usize, char)> = None;
    for (column, (at, c)) in shown.char_indices().enumerate() {
        match open {
            Some((start, from, mark)) => {
                let closes = match mark {
                    '[' => c == ']',
                    _ => {
                        CLOSING.contains(c)
                            || (EITHER.contains(c) && !OPENING.contains(mark))
                            || "│┃".contains(c)
                    }
                };
                if mark == '[' && matches!(c, '[' | ';') {
                    return vec![];
                }
                if closes {
                    let fence = match mark {
                        '[' | '⎡' | '⎢' | '⎣' | '┌' | '└' => Fence::Square,
                        '⎛' | '⎜' | '⎝' => Fence::Round,
                        _ => Fence::Bars,
                    };
                    let inner = line.start + from + mark.len_utf8()..line.start + at;
                    let span = line.start + from..line.start + at + c.len_utf8();
                    out.push(Piece { column: start, span, inner, fence });
                    open = None;
                }
            }
            None if OPENING.contains(c) || EITHER.contains(c) || c == '[' => open = Some((column, at, c)),
            None if c == ']' || CLOSING.contains(c) => return vec![],
            None => {}
        }
    }
    if open.is_some() { vec![] } else { out }
}

/// Whether a matrix is drawn on this line and the next one.
pub(super) fn begins(text: &str, first: &Range<usize>, next: &Range<usize>) -> bool {
    let (a, b) = (pieces(text, first), pieces(text, next));
    match (a.first(), b.first()) {
        (Some(x), Some(y)) => {
            let is_apart = relates(text, first, &a) && relates(text, next, &b);
            x.column == y.column && a.len() == b.len() && !ruled(text, next) && !is_apart
        }
        _ => false,
    }
}

/// True for a line with a relation beside its rows: of two such each has a matrix of its own, `p = [a, b]`, `o = [c, d]`.
fn relates(text: &str, line: &Range<usize>, pieces: &[Piece]) -> bool {
    between(text, line, pieces).iter().any(|(_, span)| cut(text, span).contains('='))
}

/// `|---|---|`
fn ruled(text: &str, line: &Range<usize>) -> bool {
    let shown = cut(text, line);
    shown.contains("--") && shown.chars().all(|c| "|-: \r\t".contains(c))
}

/// Reads the drawing that begins at `at`; where the line behind it begins.
pub(super) fn read(reader: &mut Reader, at: usize, limit: usize, manner: Manner) -> usize {
    let text = reader.text;
    let mut rows: Vec<(Range<usize>, Vec<Piece>)> = vec![];
    let mut end = at;
    while end < limit && rows.len() < MOST_LINES {
        let (span, next) = line(text, end, limit);
        let found = pieces(text, &span);
        let is_next = relates(text, &span, &found) && rows.iter().any(|(span, p)| relates(text, span, p));
        let fits = !is_next
            && match (rows.first(), found.first()) {
                (None, Some(_)) => true,
                (Some((_, first)), Some(piece)) => first.first().is_some_and(|f| f.column == piece.column),
                _ => false,
            };
        if !fits {
            break;
        }
        rows.push((span, found));
        end = next;
    }
    let outside: Vec<Vec<(usize, Range<usize>)>> =
        rows.iter().map(|(span, p)| between(text, span, p)).collect();
    if outside.iter().filter(|o| !o.is_empty()).count() > 1 {
        let span = at..rows.last().map_or(at, |r| r.0.end);
        if outside.iter().flatten().any(|(_, s)| cut(text, s).contains('=')) {
            let hint = "write names and operators on one line only, and `T` or `-1` with a `^`";
            reader.note(span, "several lines beside a drawn matrix have text", hint);
        }
        return end.max(at + 1);
    }
    // Bars are drawn for brackets, unless words or unit vectors say that it is a determinant.
    let is_determinant = outside.iter().flatten().any(|(_, s)| {
        let words = cut(text, s).to_lowercase();
        words.contains("det") || words.contains('Δ') || words.contains('×')
    }) || rows
        .first()
        .and_then(|r| r.1.first())
        .is_some_and(|piece| cut(text, &piece.inner).split_whitespace().eq(["i", "j", "k"]));
    let mut items: Vec<(usize, Vec<Node>)> = vec![];
    for (column, span) in outside.into_iter().flatten() {
        items.push((column, build(text, lex(text, &span), false).nodes));
    }
    let columns: Vec<usize> = rows.first().map_or(vec![], |r| r.1.iter().map(|p| p.column).collect());
    for (k, column) in columns.into_iter().enumerate() {
        let pieces: Vec<&Piece> = rows.iter().filter_map(|(_, p)| p.get(k)).collect();
        let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { continue };
        let span = first.span.start..last.span.end;
        let trees: Vec<Vec<Node>> =
            pieces.iter().map(|p| build(text, lex(text, &p.inner), false).nodes).collect();
        let cells: Vec<&[Node]> = trees.iter().map(Vec::as_slice).filter(|t| !t.is_empty()).collect();
        let rows = blank_rows(text, &cells, last.inner.end);
        let fence = match first.fence {
            Fence::Bars if !is_determinant => Fence::Square,
            fence => fence,
        };
        let kind = NodeKind::Grid(Box::new(Grid::new(span.clone(), fence, rows)));
        items.push((column, vec![Node { kind, span, gap: Gap::Blank }]));
    }
    items.sort_by_key(|i| i.0);
    let nodes: Vec<Node> = items.into_iter().flat_map(|i| i.1).collect();
    let related = nodes.iter().any(|n| n.relation().is_some());
    if related || reader.waits(at) {
        reader.nodes(&nodes, vec![], &[], manner);
    }
    end.max(at + 1)
}

/// What stands before, between and behind the rows of a line, with its column.
fn between(text: &str, line: &Range<usize>, pieces: &[Piece]) -> Vec<(usize, Range<usize>)> {
    let mut out = vec![];
    let mut from = line.start;
    let ends = pieces.iter().map(|p| (p.span.start, p.span.end)).chain([(line.end, line.end)]);
    for (start, next) in ends {
        let span = trimmed(text, &(from..start));
        let shown = cut(text, &span);
        if shown.chars().any(|c| !is_blank(c)) {
            out.push((cut(text, &(line.start..span.start)).chars().count(), span));
        }
        from = next;
    }
    out
}

/// A Markdown table: reads it as a matrix if the last statement waits for one. Where the line behind it begins.
pub(super) fn table(reader: &mut Reader, at: usize, limit: usize, manner: Manner) -> usize {
    let text = reader.text;
    let waits = reader.waits(at);
    let mut rows: Vec<Vec<Range<usize>>> = vec![];
    let mut end = at;
    let mut last = at;
    while end < limit {
        let (span, next) = line(text, end, limit);
        if !cut(text, &span).contains('|') {
            break;
        }
        if waits && !ruled(text, &span) && rows.len() < MOST_LINES {
            rows.push(cells(text, &trimmed(text, &span)));
        }
        (end, last) = (next, span.end);
    }
    if rows.len() > 1 && rows.first().is_some_and(|r| r.iter().all(Range::is_empty)) {
        rows.remove(0);
    }
    if waits && !rows.is_empty() {
        let span = trimmed(text, &(at..last));
        let grid = Grid::new(span.clone(), Fence::Square, rows);
        let node = Node { kind: NodeKind::Grid(Box::new(grid)), span, gap: Gap::Line };
        reader.nodes(&[node], vec![], &[], manner);
    }
    end.max(at + 1)
}

fn cells(text: &str, row: &Range<usize>) -> Vec<Range<usize>> {
    let shown = cut(text, row);
    let mut ends: Vec<usize> = vec![];
    let mut escaped = false;
    for (i, byte) in shown.bytes().enumerate() {
        if byte == b'|' && !escaped {
            ends.push(i);
        }
        escaped = byte == b'\\' && !escaped;
    }
    if !shown.ends_with('|') {
        ends.push(shown.len());
    }
    let mut from = 0;
    let mut out = vec![];
    for (i, end) in ends.into_iter().enumerate() {
        let leading = i == 0 && end == 0;
        if !leading {
            let tokens = lex(text, &(row.start + from..row.start + end));
            let place = row.start + end..row.start + end;
            out.push(tokens.first().zip(tokens.last()).map_or(place, |(a, b)| a.span.start..b.span.end));
        }
        from = end + 1;
    }
    out
}
