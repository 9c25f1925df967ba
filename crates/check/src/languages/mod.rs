//! Languages that are read as others: JavaScript as C, Julia as MATLAB, respelled byte for byte, so that each place stays where it is.

mod javascript;
mod julia;

pub(super) use javascript::as_c;
pub(super) use julia::as_matlab;

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

/// The place of the bracket that closes the one at `open`.
fn closing(text: &str, open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (i, c) in text[open..].char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(open + i);
                }
            }
            _ => {}
        }
    }
    None
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
