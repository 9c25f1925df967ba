//! Gathering a word: its letters, digits and subscripts, and the argument of a sine that stands without brackets.

use super::ParseError;
use super::lexer::{Kind, Lexer, Token};
use super::normalise::{Glyph, is_greek};
use super::words::{self, Letter, Next, Piece};
use crate::expr::Expr;

/// The longest word, in letters and digits.
const MAX_WORD: usize = 1_000;

impl Lexer<'_> {
    /// Reads a word and cuts it into pieces.
    pub(super) fn word(&mut self) {
        let start = self.at;
        let mut letters: Vec<Letter> = vec![];
        let mut power = None; // of `c^2_1`: read behind the subscript
        while let Some(c) = self.char(self.at) {
            let next = self.after_space(self.at);
            let next_char = self.char(next);
            if is_greek(c) && words::ends_in_inverse_name(&letters) {
                break;
            }
            if c.is_alphabetic()
                && let Some(length) = self.declared_with_brackets()
            {
                let declared = self.marks[self.at..self.at + length].iter();
                let plain = declared.filter_map(|m| Some((m.char()?, m.span.clone())));
                for (i, (c, span)) in plain.filter(|(c, _)| !matches!(c, ' ' | '_' | '{' | '}')).enumerate() {
                    letters.push(Letter { c, glued: i > 0, span });
                }
                if let Some(last) = letters.last_mut() {
                    last.span.end = self.marks[self.at + length - 1].span.end;
                }
                self.at += length;
            } else if c.is_alphabetic() || c.is_ascii_digit() {
                let span = self.marks[self.at].span.clone();
                letters.push(Letter { c, glued: c.is_ascii_digit(), span });
                self.at += 1;
            } else if c == '{'
                && letters.last().is_some_and(|l| l.c.is_alphabetic())
                && self.is_index_group(&letters)
            {
                self.subscript(self.at, &mut letters);
            } else if next_char == Some('_') {
                self.subscript(next + 1, &mut letters);
            } else if let Some((sign, end, digits)) = self.exponent(next) {
                if self.char(end) == Some('_') && power.is_none() {
                    power = Some((next, end));
                    self.subscript(end + 1, &mut letters);
                    continue;
                }
                let argument = self.after_space(end);
                if sign || !words::awaits_argument(&letters) || !self.joins(&letters, argument) {
                    break;
                }
                let span = self.span(next, end);
                for c in "^".chars().chain(digits.chars()) {
                    letters.push(Letter { c, glued: true, span: span.clone() });
                }
                self.at = argument;
            } else if c == ' ' && words::awaits_argument(&letters) && self.joins(&letters, next) {
                self.at = next;
            } else {
                break;
            }
        }
        if letters.len() > MAX_WORD {
            let span = self.span(start, self.at);
            self.error(
                ParseError::new(span.clone(), "the word is too long").hint("write `*` between factors"),
            );
            self.tokens.push(Token { kind: Kind::Atom(Expr::int(1)), span });
            return;
        }
        match words::split(&letters, self.next(), &self.names, self.text) {
            Ok(pieces) => self.tokens.extend(pieces.into_iter().map(|(piece, span)| match piece {
                Piece::Atom(e) => Token { kind: Kind::Atom(e), span },
                Piece::Function(f) => Token { kind: Kind::Function(f), span },
            })),
            Err(errors) => {
                errors.into_iter().for_each(|e| self.error(e));
                let span = letters[0].span.start..letters[letters.len() - 1].span.end;
                self.tokens.push(Token { kind: Kind::Atom(Expr::int(1)), span });
            }
        }
        if let Some((caret, end)) = power {
            let resume = std::mem::replace(&mut self.at, caret);
            self.run(end);
            self.at = resume;
        }
    }

    /// Reads a word that is not cut: letters, digits and subscripts, one Greek letter at most and at its beginning.
    pub(super) fn whole_word(&mut self) {
        let start = self.at;
        let (mut word, mut depth, mut ends_in_group) = (String::new(), 0_usize, false);
        while let Some(c) = self.char(self.at) {
            let is_subscript = |at: usize| self.char(self.after_space(at)) == Some('_');
            let begins_group = depth > 0 || self.at > start && self.char(self.at - 1) == Some('_');
            match c {
                '{' if begins_group => depth += 1,
                '}' if depth > 0 => {
                    depth -= 1;
                    ends_in_group = depth == 0;
                }
                _ if depth > 0 => word.extend(Some(c).filter(|c| c.is_alphanumeric())),
                '_' => word.extend(Some(c).filter(|_| !self.marks[self.at].span.is_empty())), // empty: of `₁`
                ' ' if word.ends_with('_') || is_subscript(self.at) => {}
                _ if c.is_ascii_digit() => word.push(c),
                _ if !c.is_alphanumeric() || ends_in_group => break,
                _ if !word.is_empty() && (is_greek(c) || word.chars().all(is_greek)) => break,
                _ => word.push(c),
            }
            self.at += 1;
        }
        let span = self.span(start, self.at);
        if word.trim_start_matches('_').starts_with(char::is_alphabetic) {
            self.tokens.push(Token { kind: Kind::Word(word), span });
        } else {
            self.gap(ParseError::new(span, "a subscript without a name before it"));
        }
    }

    /// True if a sine at the end of `letters` takes the letter at `next` as its argument without brackets.
    fn joins(&self, letters: &[Letter], next: usize) -> bool {
        let Some(c) = self.char(next) else { return false };
        let is_full = words::ends_in_full_name(letters);
        let is_symbol = |l: &Letter| self.names.known(&l.c.to_string()).is_some();
        c.is_alphabetic() && (is_full || is_greek(c) && c != 'π' && !letters.last().is_some_and(is_symbol))
    }

    /// What follows a word that ends here.
    fn next(&self) -> Next {
        let mut at = self.after_space(self.at);
        if let Some((_, end, _)) = self.exponent(at) {
            at = self.after_space(end);
        }
        match self.marks.get(at).map(|m| &m.glyph) {
            Some(Glyph::Char('(' | '[' | '{')) => Next::Bracket,
            Some(Glyph::Char('√' | '0'..='9') | Glyph::Fraction) => Next::Argument,
            Some(Glyph::Char(c)) if c.is_alphabetic() => Next::Letter,
            _ => Next::Other,
        }
    }

    /// A whole exponent at `at`: whether it has a sign, the place behind it, and its digits.
    fn exponent(&self, at: usize) -> Option<(bool, usize, String)> {
        let caret = match (self.char(at), self.char(at + 1)) {
            (Some('*'), Some('*')) => 2,
            (Some('^'), _) => 1,
            _ => return None,
        };
        let open = self.after_space(at + caret);
        let close = match self.char(open) {
            Some('{') => Some('}'),
            Some('(') => Some(')'),
            _ => None,
        };
        let sign = self.after_space(open + usize::from(close.is_some()));
        let is_signed = self.char(sign) == Some('-');
        let digits = self.after_space(sign + usize::from(is_signed));
        let end = self.after_digits(digits);
        let number: String = (digits..end).filter_map(|i| self.char(i)).collect();
        let end = match close {
            Some(c) => Some(self.after_space(end)).filter(|&i| self.char(i) == Some(c))? + 1,
            None => end,
        };
        (!number.is_empty()).then_some((is_signed, end, number))
    }

    /// True if a group of digits and commas in braces begins here (`C{23}`).
    fn is_index_group(&self, letters: &[Letter]) -> bool {
        let digits = (self.at + 1..).map_while(|i| self.char(i));
        let mut inner = digits.skip_while(|c| c.is_ascii_digit() || matches!(c, ',' | ' '));
        inner.next() == Some('}') && !words::ends_in_full_name(letters)
    }

    /// A subscript: one character, or a group in braces.
    fn subscript(&mut self, at: usize, letters: &mut Vec<Letter>) {
        let underscore = at.saturating_sub(1);
        self.at = self.after_space(at);
        let mut depth = 0_usize;
        while let Some(mark) = self.marks.get(self.at) {
            let span = mark.span.clone();
            match mark.char() {
                Some('{') => depth += 1,
                Some('}') if depth > 0 => depth -= 1,
                Some(' ' | '_') if depth > 0 => {}
                Some(c) if c.is_alphanumeric() || depth > 0 && matches!(c, ',' | '+' | '-') => {
                    letters.push(Letter { c, glued: true, span });
                }
                _ if depth > 0 => {
                    let hint = "indices are joined by commas or signs: `C_{2,10}`, `C_{2-3}`";
                    self.gap(ParseError::new(span, "unexpected in a subscript").hint(hint));
                }
                _ => break,
            }
            self.at += 1;
            if depth == 0 {
                return;
            }
        }
        let span = self.marks[underscore.min(self.marks.len() - 1)].span.clone();
        self.gap(ParseError::new(span, "a subscript without its end"));
    }

    /// The number of marks of a declared name such as `d(O_2,O_3)` that begins here.
    fn declared_with_brackets(&self) -> Option<usize> {
        let fits = |name: &&Vec<char>| {
            let mut at = self.at;
            for &c in *name {
                while at > self.at && matches!(self.char(at), Some(' ' | '_' | '{' | '}')) {
                    at += 1;
                }
                if self.char(at) != Some(c) {
                    return None;
                }
                at += 1;
            }
            Some(at - self.at)
        };
        self.names.with_brackets.iter().filter_map(|name| fits(&name)).max()
    }
}
