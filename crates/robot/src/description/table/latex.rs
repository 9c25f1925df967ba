//! Tables in LaTeX: `tabular` and its kin, `array`.

use super::find::{Grid, GridCell, Separator};
use std::ops::Range;

const ENVIRONMENTS: &[&str] =
    &["tabular", "tabular*", "tabularx", "tabulary", "array", "longtable", "NiceTabular"];
/// Commands that draw or space, and how many groups they take.
const DECORATION: &[(&str, usize)] = &[
    ("\\hline", 0),
    ("\\toprule", 0),
    ("\\midrule", 0),
    ("\\bottomrule", 0),
    ("\\centering", 0),
    ("\\endhead", 0),
    ("\\endfirsthead", 0),
    ("\\cline", 1),
    ("\\cmidrule", 1),
    ("\\vspace", 1),
    ("\\rule", 2),
    ("\\rowcolor", 1),
    ("\\label", 1),
    ("\\caption", 1),
];
/// Commands around a cell, and how many groups stand before its text.
const WRAPPERS: &[(&str, usize)] = &[("\\multicolumn", 2), ("\\multirow", 2)];

/// The longest group of a decoration: an unclosed one is not searched for through the whole text.
const MAX_GROUP: usize = 2000;

/// All tables of a text.
pub(super) fn grids(text: &str) -> Vec<Grid> {
    let mut grids = vec![];
    let mut unclosed: Vec<&str> = vec![]; // no further search for an end that is not there
    let mut at = 0;
    while let Some(found) = text[at..].find("\\begin{") {
        let name_start = at + found + "\\begin{".len();
        at = name_start;
        let rest = &text[name_start..];
        let Some(&name) = ENVIRONMENTS.iter().find(|e| rest.starts_with(&format!("{e}}}"))) else { continue };
        if unclosed.contains(&name) {
            continue;
        }
        let body = name_start + name.len() + 1;
        let Some(length) = text[body..].find(&format!("\\end{{{name}}}")) else {
            unclosed.push(name);
            continue;
        };
        grids.push(grid(text, body..body + length));
        at = body + length;
    }
    grids
}

fn grid(text: &str, body: Range<usize>) -> Grid {
    // Same bytes at the same places, with all that is no cell blanked out.
    let mut blanked = text.as_bytes()[body.clone()].to_vec();
    blank_comments(&mut blanked);
    let mut at = 0;
    while let Some(end) =
        group_end(&blanked, skip_space(&blanked, at)).filter(|_| blanked[at..].trim_ascii_start()[0] != b'(')
    {
        blank(&mut blanked, at..end); // the column specification and options
        at = end;
    }
    blank_decoration(&mut blanked);
    let blanked = String::from_utf8(blanked).unwrap_or_default();
    let mut rows = vec![];
    let mut start = 0;
    while start <= blanked.len() {
        let end = blanked[start..].find("\\\\").map_or(blanked.len(), |e| start + e);
        let row = cells(&blanked, start..end, body.start);
        // A cell that goes across all columns is a title or a remark.
        let is_across =
            row.len() == 1 && text[body.start + start..body.start + end].contains("\\multicolumn");
        if !is_across && row.iter().any(|c| !c.text.is_empty()) {
            rows.push(row);
        }
        start = end + 2;
        if blanked.get(start..).is_some_and(|rest| rest.starts_with('[')) {
            start += blanked[start..].find(']').map_or(0, |e| e + 1); // \\[2pt]
        }
    }
    Grid { rows, span: body, separator: Separator::Latex, ruled: false }
}

fn cells(blanked: &str, row: Range<usize>, offset: usize) -> Vec<GridCell> {
    let mut cuts = vec![];
    let mut escaped = false;
    for (i, c) in blanked[row.clone()].char_indices() {
        if c == '&' && !escaped {
            cuts.push(row.start + i);
        }
        escaped = c == '\\';
    }
    let mut cells = super::find::cells_between(blanked, row, &cuts);
    for cell in &mut cells {
        cell.span = cell.span.start + offset..cell.span.end + offset;
    }
    cells
}

fn blank(bytes: &mut [u8], range: Range<usize>) {
    bytes[range].iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
}

fn blank_comments(bytes: &mut [u8]) {
    let mut inside = false;
    for i in 0..bytes.len() {
        match bytes[i] {
            b'\n' => inside = false,
            b'%' if i == 0 || bytes[i - 1] != b'\\' => inside = true,
            _ => {}
        }
        if inside {
            bytes[i] = b' ';
        }
    }
}

fn blank_decoration(bytes: &mut [u8]) {
    let mut at = 0;
    while at < bytes.len() {
        let here = |c: &(&str, usize)| {
            let next = bytes.get(at + c.0.len()).copied().unwrap_or(b' ');
            bytes[at..].starts_with(c.0.as_bytes()) && !next.is_ascii_alphabetic()
        };
        let decoration = DECORATION.iter().find(|c| here(c));
        let wrapper = WRAPPERS.iter().find(|c| here(c));
        let Some(&(name, groups)) = decoration.or(wrapper) else {
            at += 1;
            continue;
        };
        let mut end = at + name.len();
        for _ in 0..groups {
            let open = skip_space(bytes, end);
            // an option such as \cmidrule(lr){2-3} or [2pt] stands before the group
            end = group_end(bytes, open).unwrap_or(end);
        }
        blank(bytes, at..end);
        if wrapper.is_some() {
            let open = skip_space(bytes, end);
            if let Some(close) = group_end(bytes, open) {
                blank(bytes, open..open + 1);
                blank(bytes, close - 1..close);
            }
        }
        at = end.max(at + 1);
    }
}

fn skip_space(bytes: &[u8], mut at: usize) -> usize {
    while bytes.get(at).is_some_and(u8::is_ascii_whitespace) {
        at += 1;
    }
    at
}

/// The end of the group `{…}`, `[…]` or `(…)` that begins at `at`.
fn group_end(bytes: &[u8], at: usize) -> Option<usize> {
    let (open, close) = match bytes.get(at)? {
        b'{' => (b'{', b'}'),
        b'[' => (b'[', b']'),
        b'(' => (b'(', b')'),
        _ => return None,
    };
    let mut depth = 0;
    for (i, &b) in bytes.iter().enumerate().skip(at).take(MAX_GROUP) {
        depth += i32::from(b == open) - i32::from(b == close);
        if depth == 0 {
            return Some(i + 1);
        }
    }
    None
}
