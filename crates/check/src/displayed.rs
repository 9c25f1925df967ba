//! Matrices as interpreters show them: a name with `=` behind it, and rows of numbers below.

use super::lines::lines;
use std::ops::Range;

/// No more rows belong to one matrix.
const MOST_ROWS: usize = 12;

/// A text in which such matrices stand in brackets, byte for byte; nothing for other texts.
pub(super) fn bracketed(text: &str) -> Option<String> {
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    let lines: Vec<Range<usize>> = lines(text).collect();
    let shown = |k: usize| lines.get(k).map_or("", |l| text[l.clone()].trim());
    for k in 0..lines.len() {
        if !is_head(shown(k)) {
            continue;
        }
        let first = if shown(k + 1).is_empty() { k + 2 } else { k + 1 };
        let width = numbers(shown(first));
        let rows = (first..lines.len()).take_while(|r| width > 1 && numbers(shown(*r)) == width).count();
        if !(2..=MOST_ROWS).contains(&rows) {
            continue;
        }
        let (top, bottom) = (&lines[first], &lines[first + rows - 1]);
        let open = top.start + (text[top.clone()].len() - text[top.clone()].trim_start().len());
        // A blank before the first number and the end of the last line are free.
        let is_last = shown(first + rows).is_empty();
        if open == top.start || !is_last || !text[bottom.clone()].ends_with('\n') {
            continue;
        }
        bytes[open - 1] = b'[';
        bytes[bottom.end - 1] = b']';
        is_any = true;
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// `T =`, `J0 =`
fn is_head(line: &str) -> bool {
    let name = line.strip_suffix('=').map_or("", str::trim);
    name.starts_with(char::is_alphabetic)
        && name.len() <= 12
        && name.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// How many numbers a line has, and nothing else.
fn numbers(line: &str) -> usize {
    let words = line.split_whitespace();
    let is_number = |w: &str| w.parse::<f64>().is_ok_and(f64::is_finite);
    if words.clone().all(is_number) { words.count() } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::bracketed;

    #[test]
    fn rows_of_numbers_below_a_name() {
        let found = bracketed("T =\n   1.0  2.0\n   3.0  -4.0\n\nnext").unwrap_or_default();
        assert_eq!(found, "T =\n  [1.0  2.0\n   3.0  -4.0]\nnext");
        for other in [
            "T =\n  1.0\n  2.0\n\n",
            "T = 3\n  1 2\n  3 4\n",
            "so T =\n  1 2\n  3 4\n",
            "T =\n 1 2\n 3 4",
            "T =\n 1 2\n 3 4\n```\n",
        ] {
            assert_eq!(bracketed(other), None, "{other}");
        }
    }
}
