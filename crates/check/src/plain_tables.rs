//! Tables of numbers that are set with blanks alone, below a line of names: `no.   q1   q2   x   y`, bars between groups of columns.

use super::lines::lines;
use denavit::description::table::PrintedGrid;
use std::ops::Range;

/// The longest line that is looked at, and the most rows.
const LONGEST: usize = 300;
const MAX_ROWS: usize = 200;

/// Cells between blanks, group by group between bars.
type Groups = Vec<Vec<(String, Range<usize>)>>;

/// The tables below lines that `is_head` takes for heads of columns.
pub(super) fn below(text: &str, is_head: &dyn Fn(&[String]) -> bool) -> Vec<PrintedGrid> {
    let bare = |l: Range<usize>| l.start..l.start + text[l].trim_end_matches(['\n', '\r']).len();
    let lines: Vec<Range<usize>> = lines(text).map(bare).collect();
    let mut found = vec![];
    let mut at = 0;
    while at < lines.len() {
        let line = &lines[at];
        at += 1;
        if line.len() > LONGEST {
            continue;
        }
        let head = groups(text, line);
        let names: Vec<String> = head.iter().flatten().map(|c| c.0.clone()).collect();
        if !(3..=20).contains(&names.len()) || !is_head(&names) {
            continue;
        }
        let mut rows: PrintedGrid = vec![head.concat()];
        let mut last: Groups = vec![];
        while at < lines.len() && rows.len() < MAX_ROWS {
            let shown = text[lines[at].clone()].trim();
            if is_rule(shown) {
                at += 1;
                continue;
            }
            let Some(row) = row(groups(text, &lines[at]), &head, &last) else { break };
            rows.push(row.concat());
            last = row;
            at += 1;
        }
        if rows.len() > 1 {
            found.push(rows);
        }
    }
    found
}

/// A row as wide as the heads; a group that is left empty is that of the row above.
fn row(own: Groups, head: &Groups, last: &Groups) -> Option<Groups> {
    if own.len() != head.len() {
        return None;
    }
    let mut found = vec![];
    for (k, (cells, heads)) in own.into_iter().zip(head).enumerate() {
        let has_digit = |c: &(String, Range<usize>)| c.0.contains(|x: char| x.is_ascii_digit());
        if cells.is_empty() && head.len() > 1 {
            // Said above, and not again.
            found.push(last.get(k)?.iter().map(|(text, span)| (text.clone(), span.end..span.end)).collect());
            continue;
        }
        // Names may stand before the numbers of a row: `elbow up`.
        let extra = cells.len().checked_sub(heads.len())?;
        let (words, rest) = cells.split_at(extra);
        if words.iter().any(has_digit) {
            return None;
        }
        let mut rest = rest.to_vec();
        if let (Some(first), Some(word)) = (rest.first_mut(), words.first()) {
            *first = (format!("{} {}", word.0, first.0), word.1.start..first.1.end);
        }
        found.push(rest);
    }
    // Among words a number makes no row.
    let cells = || found.iter().flatten().map(|c: &(String, Range<usize>)| c.0.as_str());
    let numbers = cells().filter(|c| is_number(c)).count();
    (numbers >= 2 && 2 * numbers >= cells().count()).then_some(found)
}

/// True for what begins as a number does, behind a name at the most: `3.5`, `-90°`, `$-1$`, `a 12`.
fn is_number(cell: &str) -> bool {
    let last = cell
        .rsplit(' ')
        .next()
        .unwrap_or(cell)
        .trim_start_matches(['$', '(', '[', '+', '-', '−', '~', '≈', '*']);
    let with_point = last.strip_prefix(['.', ',']).unwrap_or(last);
    with_point.starts_with(|c: char| c.is_ascii_digit()) || cell.starts_with(|c: char| c.is_ascii_digit())
}

/// The words of a line, group by group between bars; a unit behind a number is part of it.
fn groups(text: &str, line: &Range<usize>) -> Groups {
    let source = &text[line.clone()];
    let mut found: Groups = vec![];
    let mut start = line.start;
    for part in source.split('|') {
        let mut cells: Vec<(String, Range<usize>)> = vec![];
        let mut at = start;
        for word in part.split_inclusive(char::is_whitespace) {
            let bare = word.trim();
            if !bare.is_empty() {
                let from = at + (word.len() - word.trim_start().len());
                let is_unit = matches!(bare, "deg" | "°" | "rad" | "mm" | "cm" | "m");
                match cells.last_mut() {
                    Some(last) if is_unit && last.0.ends_with(|c: char| c.is_ascii_digit()) => {
                        *last = (
                            text[last.1.start..from + bare.len()].to_string(),
                            last.1.start..from + bare.len(),
                        );
                    }
                    _ => cells.push((bare.to_string(), from..from + bare.len())),
                }
            }
            at += word.len();
        }
        found.push(cells);
        start += part.len() + 1;
    }
    found
}

fn is_rule(line: &str) -> bool {
    line.len() > 2 && line.chars().all(|c| matches!(c, '-' | '=' | ' ' | '+' | '_' | '─' | '|'))
}

#[cfg(test)]
mod tests {
    use super::below;

    #[test]
    fn numbers_below_names() {
        let text = "  no.   q1    x  |  y\n ----\n  1    10   2  |  3\n             |  4.5 m\nwords\n";
        let tables = below(text, &|names| names.contains(&"q1".to_string()));
        let rows: Vec<Vec<&str>> =
            tables[0].iter().map(|row| row.iter().map(|c| c.0.as_str()).collect()).collect();
        assert_eq!(
            rows,
            [vec!["no.", "q1", "x", "y"], vec!["1", "10", "2", "3"], vec!["1", "10", "2", "4.5 m"]]
        );
    }
}
