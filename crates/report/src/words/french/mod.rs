//! French, with the terms of courses in robotics.
//!
//! Sentences are written with ordinary blanks and apostrophes; `say!` and [`set`] put those of print.

/// A sentence as it is printed; formatted as by `format!`.
macro_rules! say {
    ($($text:tt)*) => {
        $crate::words::french::printed(&format!($($text)*))
    };
}

mod check;
mod dynamics;
mod exercise;
mod geometry;
mod inverse;
mod motion;
mod read_with;
mod report;
mod terms;
mod velocity;

use crate::tree::{Line, Piece};

/// French.
pub struct French;

/// `0 articulation`, `3 articulations`: none is singular, too.
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n < 2 { one } else { many })
}

/// The text with the blanks of print: none that breaks before `: ; ? !` and within `« »`; and its apostrophe.
fn printed(text: &str) -> String {
    let mut all: Vec<char> = text.chars().collect();
    for k in 0..all.len() {
        let before = k.checked_sub(1).map(|b| all[b]);
        let next = all.get(k + 1).copied();
        match all[k] {
            ' ' if before == Some('«') || matches!(next, Some(':' | ';' | '?' | '!' | '»')) => {
                all[k] = '\u{a0}';
            }
            '\'' if before.is_some_and(char::is_alphabetic) && next.is_none_or(char::is_alphanumeric) => {
                all[k] = '’';
            }
            _ => {}
        }
    }
    all.into_iter().collect()
}

/// The words of a line as they are printed.
fn set(mut line: Line) -> Line {
    for piece in &mut line.0 {
        if let Piece::Text(words) | Piece::Strong(words) = piece {
            *words = printed(words);
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::{counted, printed};

    #[test]
    fn blanks_and_apostrophes_of_print() {
        assert_eq!(printed("l'axe : « un » ; d'où"), "l’axe\u{a0}: «\u{a0}un\u{a0}»\u{a0}; d’où");
        assert_eq!(counted(0, "articulation", "articulations"), "0 articulation");
    }
}
