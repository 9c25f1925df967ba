//! The vocabulary as the parser asks it: spellings of Greek letters, names in backquotes, the nearest known name.

use super::ParseError;
use super::functions::is_function_name;
use super::normalise::{greek_name, greek_prefix};
use crate::expr::Expr;
use crate::vocabulary::{Vocabulary, plain_name};
use std::ops::Range;

/// Among more names the nearest is not looked for.
const MAX_NEAR: usize = 1_000;

/// A vocabulary, prepared for one text.
pub(super) struct Names<'a> {
    pub vocabulary: &'a Vocabulary,
    /// Declared names that are more than one word: `d(O2,O3)`.
    pub with_brackets: &'a [Vec<char>],
    /// No known name has more letters.
    pub longest: usize,
}

impl<'a> Names<'a> {
    pub fn new(vocabulary: &'a Vocabulary) -> Self {
        Names {
            vocabulary,
            with_brackets: vocabulary.bracketed(),
            longest: vocabulary.longest().max(16) + 16,
        }
    }

    pub fn is_open(&self) -> bool {
        self.vocabulary.is_open()
    }

    /// True if the word itself is declared.
    pub fn is_declared(&self, word: &str) -> bool {
        self.vocabulary.is_declared(word)
    }

    /// The meaning of a whole word; Greek letters may be spelled out.
    pub fn known(&self, word: &str) -> Option<Expr> {
        let lookup = |w: &str| self.vocabulary.lookup(w);
        if let Some(e) = lookup(word) {
            return Some(e);
        }
        if word == "π" || word == "pi" {
            return Some(Expr::pi());
        }
        let first = word.chars().next()?;
        if let Some(name) = greek_name(first) {
            return lookup(&format!("{name}{}", &word[first.len_utf8()..]));
        }
        let (name, letter) = greek_prefix(word)?;
        lookup(&format!("{letter}{}", &word[name.len()..]))
    }

    /// The meaning of a name in backquotes.
    pub fn quoted(&self, name: &str, span: &Range<usize>) -> Result<Expr, ParseError> {
        match self.vocabulary.lookup(name) {
            Some(e) => Ok(e),
            None if self.is_open() && !name.is_empty() => Ok(Expr::symbol(name)),
            None => Err(self.unknown(&plain_name(name), false, span.clone())),
        }
    }

    /// The error for a word that means nothing.
    pub fn unknown(&self, word: &str, is_function: bool, span: Range<usize>) -> ParseError {
        if is_function_name(word) {
            let e = ParseError::new(span, format!("`{word}` takes its argument in brackets"));
            return e;
        }
        if let Some(e) = self.length_as_angle(word, &span) {
            return e;
        }
        let nearest = self.nearest(word);
        if is_function && nearest.is_none() && word.chars().count() > 1 {
            let e = ParseError::new(span, format!("unknown function `{word}`"));
            return e.hint("the functions are sin, cos, tan, sqrt, atan2, arcsin, arccos and arctan");
        }
        let e = ParseError::new(span, format!("unknown `{word}`"));
        match nearest {
            Some(name) => e.hint(format!("did you mean `{name}`?")),
            None => e,
        }
    }

    /// `θ3` where variable 3 is a length.
    fn length_as_angle(&self, word: &str, span: &Range<usize>) -> Option<ParseError> {
        let digits = ["θ", "theta", "th", "t"].iter().find_map(|name| word.strip_prefix(name))?;
        let n = digits.parse().ok().filter(|&n| self.vocabulary.is_sliding(n))?;
        Some(ParseError::new(span.clone(), format!("variable {n} is a length, not an angle")))
    }

    fn nearest(&self, word: &str) -> Option<String> {
        let letters = word.chars().count();
        if letters > 40 {
            return None;
        }
        let limit = (letters / 2).max(1);
        let words = self.vocabulary.words();
        if words.len() > MAX_NEAR {
            return None;
        }
        let distances = words.into_iter().map(|w| (distance(word, &w), w));
        let found = distances.filter(|(d, w)| *d <= limit && *d < letters.max(w.chars().count()));
        found.min_by_key(|(d, _)| *d).map(|(_, w)| w)
    }
}

/// The letters to insert and delete between two words; another case counts as one.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, &y) in b.iter().enumerate() {
            let change = match () {
                () if x == y => 0,
                () if x.eq_ignore_ascii_case(&y) => 1,
                () => 2,
            };
            let shortest = (diagonal + change).min(row[j] + 1).min(row[j + 1] + 1);
            diagonal = std::mem::replace(&mut row[j + 1], shortest);
        }
    }
    row[b.len()]
}
