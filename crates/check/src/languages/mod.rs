//! Languages that are read as others: JavaScript as C, Julia as MATLAB, respelled byte for byte, so that each place stays where it is.

mod javascript;
mod julia;

pub(super) use javascript::as_c;
pub(super) use julia::as_matlab;

use std::collections::BTreeMap;

/// A text whose bytes are written over.
struct Respelled<'a> {
    text: &'a str,
    bytes: Vec<u8>,
}

impl<'a> Respelled<'a> {
    fn new(text: &'a str) -> Self {
        Respelled { text, bytes: text.as_bytes().to_vec() }
    }

    /// Blanks for everything but ends of lines.
    fn blank(&mut self, from: usize, to: usize) {
        self.bytes[from..to].iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
    }

    /// Other words in the place of these, with blanks behind; false if they are longer.
    fn write(&mut self, from: usize, to: usize, now: &str) -> bool {
        if now.len() > to - from {
            return false;
        }
        self.blank(from, to);
        self.bytes[from..from + now.len()].copy_from_slice(now.as_bytes());
        true
    }

    /// What has been written so far.
    fn now(&self) -> String {
        String::from_utf8_lossy(&self.bytes).into_owned()
    }

    fn finished(self) -> Option<String> {
        let is_changed = self.bytes != self.text.as_bytes();
        if is_changed { String::from_utf8(self.bytes).ok() } else { None }
    }
}

/// No list of arguments is longer, in bytes.
const LONGEST: usize = 4_000;

/// The brackets of a text, each with that which closes it.
struct Brackets(BTreeMap<usize, usize>);

impl Brackets {
    fn of(text: &str) -> Self {
        let (mut open, mut pairs) = (vec![], BTreeMap::new());
        for (i, b) in text.bytes().enumerate() {
            match b {
                b'(' | b'[' | b'{' => open.push(i),
                b')' | b']' | b'}' => pairs.extend(open.pop().map(|o| (o, i))),
                _ => {}
            }
        }
        Brackets(pairs)
    }

    /// The place of the bracket that closes the one at `open`.
    fn closing(&self, open: usize) -> Option<usize> {
        self.0.get(&open).copied()
    }

    /// The same, if not too much stands between them.
    fn near(&self, open: usize) -> Option<usize> {
        self.closing(open).filter(|close| close - open < LONGEST)
    }
}

/// The places of a character that stand in no bracket, within a part of a text.
fn outside(text: &str, from: usize, to: usize, wanted: char) -> Vec<usize> {
    let (mut depth, mut found) = (0_i32, vec![]);
    for (i, c) in text[from..to].char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            c if c == wanted && depth == 0 => found.push(from + i),
            _ => {}
        }
    }
    found
}

/// The word that ends at a place, and where it begins.
fn word_before(text: &str, end: usize) -> (usize, &str) {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let start = text[..end].trim_end_matches(is_part).len();
    (start, &text[start..end])
}
