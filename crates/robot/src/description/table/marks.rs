//! Marks in cells that are none of their formulas: stars for what moves, indices of programs.

use std::ops::Range;

/// Longer cells hold no such index.
const LONGEST: usize = 200;

/// A cell with `q1` for the `q[0]` of programs that count from 0, and for the `q(1)` of those that count from 1; `h` for the `self.h`
/// of their objects.
pub(super) fn with_numbers(cell: &str) -> String {
    if cell.len() > LONGEST {
        return cell.into();
    }
    let cell = &without_object(cell);
    let mut text = String::with_capacity(cell.len());
    let mut rest: &str = cell;
    while let Some(at) = rest.find(['[', '(']) {
        let (before, bracket) = rest.split_at(at);
        let letters = before.len() - before.trim_end_matches(|c: char| c.is_ascii_alphabetic()).len();
        let is_apart = !before[..before.len() - letters].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let (open, close) = if bracket.starts_with('[') { ('[', ']') } else { ('(', ')') };
        let digit = bracket.strip_prefix(open).and_then(|b| b.split_once(close)).map(|b| b.0.parse::<u8>());
        text.push_str(before);
        match digit {
            Some(Ok(digit)) if digit < 20 && (1..=2).contains(&letters) && is_apart => {
                text.push_str(&(digit + u8::from(open == '[')).to_string());
                rest = &bracket[bracket.find(close).map_or(bracket.len(), |i| i + 1)..];
            }
            _ => {
                text.push(open);
                rest = &bracket[1..];
            }
        }
    }
    text.push_str(rest);
    text
}

/// A cell without `self.`.
fn without_object(cell: &str) -> String {
    const OBJECT: &str = "self.";
    let mut parts = cell.split(OBJECT);
    let mut text = parts.next().unwrap_or_default().to_string();
    for part in parts {
        if text.ends_with(|c: char| c.is_alphanumeric() || c == '_') || !part.starts_with(char::is_alphabetic)
        {
            text.push_str(OBJECT);
        }
        text.push_str(part);
    }
    text
}

/// A cell with its stars blanked out, and whether there were any: `^*` anywhere, `*` at the end or before a sign.
pub(super) fn without_stars(cell: &str) -> (String, bool) {
    let mut text = cell.to_string();
    for star in ["^{*}", "^{\\ast}", "^{\\star}", "^\\ast", "^\\star", "^*", "^{∗}", "^∗"] {
        text = text.replace(star, &" ".repeat(star.len()));
    }
    let bare = |(at, star): (usize, &str)| {
        let behind = text[at + star.len()..].trim_start_matches(['$', ' ', '}']);
        let name = text[..at].trim_end_matches(['$', ' ', '}']);
        let word =
            name.rsplit(|c: char| !c.is_alphanumeric() && !matches!(c, '_' | '{')).next().unwrap_or("");
        let named = word.contains(char::is_alphabetic);
        let marks = behind.is_empty() || named && behind.starts_with(['+', '-', '−', ')']);
        marks.then_some(at..at + star.len())
    };
    let bare: Vec<Range<usize>> = text.match_indices(['*', '∗']).filter_map(bare).collect();
    for range in bare {
        text.replace_range(range.clone(), &" ".repeat(range.len()));
    }
    let star = text != cell;
    (text, star)
}

#[cfg(test)]
mod tests {
    use super::with_numbers;

    #[test]
    fn indices_of_programs() {
        for (cell, expected) in [
            ("q[0]", "q1"),
            ("q[1] + pi/2", "q2 + pi/2"),
            ("L(3)", "L3"),
            ("cos(1)", "cos(1)"),
            ("2*(3)", "2*(3)"),
            ("d_a[2]", "d_a[2]"),
            ("(q(1)", "(q1"),
            ("self.h + self.q[0]", "h + q1"),
            ("myself.h", "myself.h"),
        ] {
            assert_eq!(with_numbers(cell), expected, "{cell}");
        }
    }
}
