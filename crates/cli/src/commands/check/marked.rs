//! A printed formula with its slip marked.

use denavit_check::Patch;
use std::ops::Range;

/// A part of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    /// As printed.
    Plain(String),
    /// What should not stand there, and what should.
    Changed {
        /// As printed; empty where something is missing.
        was: String,
        /// What should stand there; empty where something is too much.
        now: String,
    },
}

/// The formula at `span`, cut where patches change it.
pub fn pieces(text: &str, span: &Range<usize>, patches: &[Patch]) -> Vec<Piece> {
    let mut patches: Vec<&Patch> = patches.iter().collect();
    patches.sort_by_key(|p| (p.span.start, p.span.end));
    let blank = |range: Range<usize>| {
        let part = text.get(range).unwrap_or_default();
        let words: Vec<&str> = part.split_whitespace().collect();
        let ends = |c: Option<char>| if c.is_some_and(char::is_whitespace) { " " } else { "" };
        if words.is_empty() {
            return ends(part.chars().next()).to_string();
        }
        format!("{}{}{}", ends(part.chars().next()), words.join(" "), ends(part.chars().last()))
    };
    let mut found = vec![];
    let mut at = span.start;
    for patch in patches {
        if patch.span.start < at || patch.span.end > span.end {
            continue;
        }
        let before = blank(at..patch.span.start);
        if !before.is_empty() {
            found.push(Piece::Plain(before));
        }
        found.push(Piece::Changed { was: blank(patch.span.clone()), now: patch.now.clone() });
        at = patch.span.end;
    }
    let rest = blank(at..span.end);
    if !rest.is_empty() {
        found.push(Piece::Plain(rest));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_is_cut_at_its_slips() {
        let text = "x = c2.D7 +  c2.r7";
        let patch = |span, now: &str| Patch { span, now: now.into() };
        let plain = |s: &str| Piece::Plain(s.into());
        let changed = |was: &str, now: &str| Piece::Changed { was: was.into(), now: now.into() };
        assert_eq!(
            pieces(text, &(4..18), &[patch(13..15, "s2"), patch(10..11, "-")]),
            [plain("c2.D7 "), changed("+", "-"), plain(" "), changed("c2", "s2"), plain(".r7")]
        );
        assert_eq!(pieces(text, &(4..9), &[patch(9..9, " + a2")]), [plain("c2.D7"), changed("", " + a2")]);
    }
}
