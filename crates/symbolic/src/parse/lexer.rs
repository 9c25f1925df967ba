//! Marks to tokens: numbers, signs and brackets; runs of letters are gathered here and cut in `words`.

use super::functions::Function;
use super::names::Names;
use super::normalise::{Glyph, Mark};
use super::{MAX_ERRORS, ParseError};
use crate::expr::Expr;
use crate::rational::Rational;
use crate::vocabulary::{Vocabulary, plain_name};
use std::ops::Range;

/// What the grammar reads.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    Number(Rational),
    Atom(Expr),
    /// A whole word, whose meaning the grammar asks for.
    Word(String),
    Function(Function),
    Plus,
    Minus,
    PlusMinus,
    MinusPlus,
    Times,
    Divide,
    Caret,
    Root,
    Fraction,
    Degree,
    Radian,
    /// An opening bracket; the character is the one that closes it.
    Open(char),
    Close(char),
    Comma,
    Equals,
}

/// A token and the bytes of the text that it came from.
#[derive(Clone, Debug)]
pub(super) struct Token {
    pub kind: Kind,
    pub span: Range<usize>,
}

/// The length of the unit that a text begins with.
pub(super) type UnitAt<'a> = dyn Fn(&str) -> Option<usize> + 'a;

/// The tokens of `marks`, and whether they are all there: a word without meaning leaves a stand-in, other errors a gap.
pub(super) fn tokens(
    text: &str,
    marks: &[Mark],
    vocabulary: &Vocabulary,
    whole_words: Option<&UnitAt<'_>>,
    errors: &mut Vec<ParseError>,
) -> (Vec<Token>, bool) {
    let names = Names::new(vocabulary);
    let is_whole = errors.is_empty();
    let mut lexer = Lexer { text, marks, at: 0, names, whole_words, tokens: vec![], is_whole, errors };
    lexer.run(marks.len());
    (lexer.tokens, lexer.is_whole)
}

/// The name on the left of a definition, and its place.
pub(super) fn defined_name(
    text: &str,
    marks: &[Mark],
    vocabulary: &Vocabulary,
) -> Result<(String, Range<usize>), ParseError> {
    let first = marks.iter().position(|m| !m.is_space());
    let last = marks.iter().rposition(|m| !m.is_space());
    let (Some(first), Some(last)) = (first, last) else {
        return Err(ParseError::new(0..text.len(), "no name before `=`"));
    };
    let marks = &marks[first..=last];
    let span = marks[0].span.start..marks[marks.len() - 1].span.end;
    if let [Mark { glyph: Glyph::Quoted(name), .. }] = marks {
        return Ok((name.clone(), span));
    }
    let name: String = marks.iter().filter_map(Mark::char).collect();
    let plain = plain_name(&name);
    let is_word = plain.chars().all(|c| c.is_alphanumeric() || c == ',') && !has_outer_space(&name);
    let is_one = name.starts_with(char::is_alphabetic) && marks.iter().all(|m| m.char().is_some());
    if is_one && (is_word || Names::new(vocabulary).is_declared(&plain)) {
        return Ok((plain, span));
    }
    let message = format!("`{}` is not one name", &text[span.clone()]);
    Err(ParseError::new(span, message).hint("a definition is `name = formula`"))
}

/// True if a blank stands between letters outside of braces, as between two words.
fn has_outer_space(name: &str) -> bool {
    let mut depth = 0_i32;
    let mut words = name.split(' ').filter(|w| !w.is_empty());
    let mut count = |word: &str| {
        let is_outer = depth == 0;
        depth += word.matches('{').count() as i32 - word.matches('}').count() as i32;
        is_outer && word.starts_with(char::is_alphanumeric)
    };
    words.next().is_some_and(|first| {
        count(first);
        words.any(count)
    })
}

pub(super) struct Lexer<'a> {
    pub text: &'a str,
    pub marks: &'a [Mark],
    pub at: usize,
    pub names: Names<'a>,
    /// Words are not cut, and this finds units.
    pub whole_words: Option<&'a UnitAt<'a>>,
    pub tokens: Vec<Token>,
    pub is_whole: bool,
    pub errors: &'a mut Vec<ParseError>,
}

impl Lexer<'_> {
    pub fn char(&self, at: usize) -> Option<char> {
        self.marks.get(at).and_then(Mark::char)
    }

    /// The first place from `at` on that is not blank.
    pub fn after_space(&self, at: usize) -> usize {
        at + self.marks[at.min(self.marks.len())..].iter().take_while(|m| m.is_space()).count()
    }

    fn is_digit(&self, at: usize) -> bool {
        self.char(at).is_some_and(|c| c.is_ascii_digit())
    }

    /// The place behind the digits from `at` on.
    pub fn after_digits(&self, mut at: usize) -> usize {
        while self.is_digit(at) {
            at += 1;
        }
        at
    }

    /// The bytes of the marks `from..to`.
    pub fn span(&self, from: usize, to: usize) -> Range<usize> {
        self.marks[from].span.start..self.marks[to - 1].span.end
    }

    pub fn error(&mut self, e: ParseError) {
        if self.errors.len() < MAX_ERRORS {
            self.errors.push(e);
        }
    }

    /// An error that leaves a gap between the tokens.
    pub fn gap(&mut self, e: ParseError) {
        self.is_whole = false;
        self.error(e);
    }

    /// A token of the next `length` marks.
    fn push(&mut self, kind: Kind, length: usize) {
        let span = self.span(self.at, self.at + length);
        self.tokens.push(Token { kind, span });
        self.at += length;
    }

    pub fn run(&mut self, end: usize) {
        while self.at < end {
            if self.errors.len() >= MAX_ERRORS {
                self.is_whole = false;
                self.at = end;
                return;
            }
            let mark = &self.marks[self.at];
            match &mark.glyph {
                Glyph::Fraction => self.push(Kind::Fraction, 1),
                Glyph::Quoted(name) => {
                    let atom = self.names.quoted(name, &mark.span);
                    let kind = match atom {
                        Ok(e) => Kind::Atom(e),
                        Err(e) => {
                            self.error(e);
                            Kind::Atom(Expr::int(1))
                        }
                    };
                    self.push(kind, 1);
                }
                Glyph::Char(c) => self.character(*c),
            }
        }
    }

    fn character(&mut self, c: char) {
        match c {
            ' ' => self.at += 1,
            '0'..='9' => self.number(),
            '.' => self.point(),
            '+' => match self.plus_minus() {
                Some(length) => self.push(Kind::PlusMinus, length),
                None => self.push(Kind::Plus, 1),
            },
            '-' => self.push(Kind::Minus, 1),
            '±' => self.push(Kind::PlusMinus, 1),
            '∓' => self.push(Kind::MinusPlus, 1),
            '*' if self.char(self.at + 1) == Some('*') => self.push(Kind::Caret, 2),
            '*' => self.push(Kind::Times, 1),
            '/' => self.push(Kind::Divide, 1),
            '^' => self.caret(),
            '√' => self.push(Kind::Root, 1),
            '°' => self.push(Kind::Degree, 1),
            '(' => self.push(Kind::Open(')'), 1),
            '[' => self.push(Kind::Open(']'), 1),
            '{' => self.push(Kind::Open('}'), 1),
            ')' | ']' | '}' => self.push(Kind::Close(c), 1),
            ',' => self.push(Kind::Comma, 1),
            '=' => self.push(Kind::Equals, 1),
            _ if self.whole_words.is_some() && (c.is_alphabetic() || c == '_') => self.whole_word(),
            _ if c.is_alphabetic() => self.word(),
            _ => {
                let span = self.marks[self.at].span.clone();
                let e = match c {
                    '_' => ParseError::new(span, "a subscript without a name before it"),
                    ';' => ParseError::new(span, "unexpected `;`").hint("write one formula at a time"),
                    _ if c.is_control() || !(c.is_ascii_graphic() || c.is_alphanumeric()) => {
                        ParseError::new(span, format!("unexpected character U+{:04X}", c as u32))
                    }
                    _ => ParseError::new(span, format!("unexpected character `{c}`")),
                };
                self.gap(e);
                self.at += 1;
            }
        }
    }

    /// The length of `+/-`, or of `+-` before a root or an arc cosine: a sign of two values as keyboards have it.
    fn plus_minus(&self) -> Option<usize> {
        match (self.char(self.at + 1), self.char(self.at + 2)) {
            (Some('/'), Some('-')) => Some(3),
            (Some('-'), Some(_)) => {
                let next = self.after_space(self.at + 2);
                let word = self.word_at(next);
                let is_root = self.char(next) == Some('√')
                    || matches!(word.as_str(), "sqrt" | "acos" | "arccos" | "arcos");
                is_root.then_some(2)
            }
            _ => None,
        }
    }

    /// `^`, or the degree sign `^\circ`.
    fn caret(&mut self) {
        let next = self.after_space(self.at + 1);
        if self.char(next) == Some('°') {
            return self.push(Kind::Degree, next + 1 - self.at);
        }
        if self.char(next) == Some('{') {
            let sign = self.after_space(next + 1);
            let close = self.after_space(sign + 1);
            if self.char(sign) == Some('°') && self.char(close) == Some('}') {
                return self.push(Kind::Degree, close + 1 - self.at);
            }
        }
        self.push(Kind::Caret, 1);
    }

    /// The place behind `e-3`, if that stands at `end`.
    fn after_power_of_ten(&self, end: usize) -> usize {
        if !matches!(self.char(end), Some('e' | 'E')) {
            return end;
        }
        let sign = end + 1 + usize::from(matches!(self.char(end + 1), Some('+' | '-')));
        let after = self.after_digits(sign);
        let word: String = (end..after).filter_map(|i| self.char(i)).collect();
        // `1e-3rad`, but neither `2e-3x` nor `2e1a`.
        let has_unit = || {
            let word = self.word_at(after);
            self.whole_words.and_then(|unit_at| unit_at(&word)) == Some(word.len())
        };
        let is_number = after > sign && (!self.char(after).is_some_and(char::is_alphabetic) || has_unit());
        if is_number && self.names.known(&word).is_none() { after } else { end }
    }

    /// The letters and digits at `start`.
    fn word_at(&self, start: usize) -> String {
        (start..).map_while(|i| self.char(i).filter(|c| c.is_alphanumeric() || *c == '_')).collect()
    }

    fn number(&mut self) {
        let start = self.at;
        let mut end = self.after_digits(start);
        if self.char(end) == Some('.') && self.is_digit(end + 1) {
            end = self.after_digits(end + 1);
        } else if self.whole_words.is_some() && self.char(end) == Some('.') {
            end += 1;
        }
        end = self.after_power_of_ten(end);
        let digits: String = (start..end).filter_map(|i| self.char(i)).collect();
        let span = self.span(start, end);
        self.at = end;
        let value = Rational::from_decimal(&digits).unwrap_or_else(|| {
            self.error(ParseError::new(span.clone(), format!("`{digits}` is too long a number")));
            Rational::ONE
        });
        self.tokens.push(Token { kind: Kind::Number(value), span });
        self.unit();
    }

    /// `deg` or `rad` behind a number.
    fn unit(&mut self) {
        if self.whole_words.is_some() {
            return; // `2 deg/s`: the grammar finds units
        }
        let start = self.after_space(self.at);
        let word = self.word_at(start);
        let kind = match word.as_str() {
            "deg" => Kind::Degree,
            "rad" => Kind::Radian,
            _ => return,
        };
        if self.names.known(&word).is_none() {
            self.at = start;
            self.push(kind, 3);
        }
    }

    /// `.`: a product before a letter or a bracket, the start of a decimal before digits.
    fn point(&mut self) {
        let start = self.at;
        if self.is_digit(start + 1) {
            let end = self.after_power_of_ten(self.after_digits(start + 1));
            let before = self.tokens.last().cloned().filter(|t| {
                matches!(
                    t.kind,
                    Kind::Number(_) | Kind::Atom(_) | Kind::Close(_) | Kind::Degree | Kind::Radian
                )
            });
            let digits: String = (start..end).filter_map(|i| self.char(i)).collect();
            let span = self.span(start, end);
            self.at = end;
            let Some(before) = before else {
                let value = Rational::from_decimal(&digits).unwrap_or_else(|| {
                    self.error(ParseError::new(span.clone(), format!("`{digits}` is too long a number")));
                    Rational::ONE
                });
                self.tokens.push(Token { kind: Kind::Number(value), span });
                return self.unit();
            };
            let (start, left) = match before.kind {
                Kind::Close(_) => (span.start, "(…)"),
                _ => (before.span.start, self.text.get(before.span.clone()).unwrap_or_default()),
            };
            let both =
                format!("`{left}{digits}` reads as `{left}*{}` or as `{left}*0{digits}`", &digits[1..]);
            self.gap(ParseError::new(start..span.end, both).hint("write `*` for the product"));
            return;
        }
        let next = self.after_space(start + 1);
        let is_product = match self.marks.get(next).map(|m| &m.glyph) {
            Some(Glyph::Char(c)) => c.is_alphabetic() || matches!(c, '(' | '[' | '{' | '√'),
            Some(Glyph::Fraction | Glyph::Quoted(_)) => true,
            None => false,
        };
        if is_product {
            return self.push(Kind::Times, 1);
        }
        let span = self.span(start, start + 1);
        let hint = "a point stands inside a number, or as a product before a name or a bracket";
        self.gap(ParseError::new(span, "unexpected `.`").hint(hint));
        self.at += 1;
    }
}
