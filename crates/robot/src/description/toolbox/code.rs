//! The words of a program: names, numbers, texts, signs, ends of lines; comments are left out.

use std::ops::Range;

/// Whose language a program is in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Language {
    /// MATLAB or Octave.
    Matlab,
    /// Python.
    Python,
}

/// What a word of a program is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    Name,
    Number,
    /// In quotes, which `span` has.
    Text,
    /// A text with values in it.
    Filled,
    Sign,
    /// The end of a line or `;` in no bracket; a row's end in MATLAB's brackets.
    Line,
    /// A block of Python begins, ends.
    Indent,
    Dedent,
    End,
}

/// A word of a program.
#[derive(Clone, Debug)]
pub(super) struct Token {
    pub kind: Kind,
    pub span: Range<usize>,
    /// Blanks stand before it.
    pub apart: bool,
}

/// Signs of more than one letter, the longest first.
const SIGNS: [&str; 24] = [
    "**=", "//=", "**", "//", "==", "~=", "!=", "<=", ">=", "&&", "||", ".*", "./", ".^", ".'", "+=", "-=",
    "*=", "/=", "->", ":=", "<<", ">>", "@=",
];

/// The words of a program, `End` last.
pub(super) fn tokens(text: &str, language: Language) -> Vec<Token> {
    let mut lexer =
        Lexer { text, language, at: 0, found: vec![], open: vec![], indents: vec![0], begins: true };
    lexer.all();
    lexer.found
}

struct Lexer<'t> {
    text: &'t str,
    language: Language,
    at: usize,
    found: Vec<Token>,
    /// Brackets under way.
    open: Vec<u8>,
    indents: Vec<usize>,
    /// Nothing of the line stands before this place.
    begins: bool,
}

impl Lexer<'_> {
    fn push(&mut self, kind: Kind, length: usize, apart: bool) {
        self.found.push(Token { kind, span: self.at..self.at + length, apart });
        self.at += length;
    }

    fn all(&mut self) {
        let bytes = self.text.as_bytes();
        let is_python = self.language == Language::Python;
        let mut apart = false;
        while self.at < bytes.len() {
            let rest = &bytes[self.at..];
            let first = rest[0];
            if self.begins && (self.open.is_empty() || !is_python) {
                self.begins = false;
                if is_python {
                    self.indent();
                } else if let Some(length) = block_comment(&self.text[self.at..]) {
                    self.at += length;
                    self.begins = true;
                }
                continue;
            }
            // To the end of the line, looked for only where it is needed: a text may be one long line.
            let line = || rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
            match first {
                b'\n' => {
                    self.begins = self.open.is_empty() || !is_python;
                    let is_row = !is_python && matches!(self.open.last(), Some(b'[' | b'{'));
                    if self.open.is_empty() || is_row {
                        self.push(Kind::Line, 1, apart);
                    } else {
                        self.at += 1;
                    }
                    apart = true;
                    continue;
                }
                b' ' | b'\t' | b'\r' => {
                    self.at += 1;
                    apart = true;
                    continue;
                }
                b'#' => self.at += line(),
                b'%' if !is_python => self.at += line(),
                b'.' if !is_python && rest.starts_with(b"...") => self.at += (line() + 1).min(rest.len()),
                b'\\' if is_python && rest[..rest.len().min(3)].contains(&b'\n') => {
                    self.at += line() + 1;
                }
                _ => {
                    let c = self.text[self.at..].chars().next().unwrap_or(' ');
                    if c.is_whitespace() || c == '\u{feff}' {
                        self.at += c.len_utf8();
                        apart = true;
                    } else {
                        self.word(apart);
                        apart = false;
                    }
                    continue;
                }
            }
            apart = true;
        }
        self.at = bytes.len();
        self.push(Kind::Line, 0, true);
        for _ in 1..self.indents.len() {
            self.push(Kind::Dedent, 0, true);
        }
        self.push(Kind::End, 0, true);
    }

    /// How far a line of Python is moved in begins or ends blocks.
    fn indent(&mut self) {
        let rest = &self.text[self.at..];
        let blanks = rest.bytes().take_while(|b| matches!(b, b' ' | b'\t' | b'\r')).count();
        // Lines without words do not count.
        if rest[blanks..].starts_with(['\n', '#']) || rest.len() == blanks {
            return;
        }
        self.at += blanks;
        let last = self.indents.last().copied().unwrap_or(0);
        if blanks > last {
            self.indents.push(blanks);
            self.push(Kind::Indent, 0, true);
        }
        while self.indents.last().is_some_and(|&i| i > blanks) {
            self.indents.pop();
            self.push(Kind::Dedent, 0, true);
        }
    }

    fn word(&mut self, apart: bool) {
        let rest = &self.text[self.at..];
        let first = rest.as_bytes()[0];
        let is_digit = |b: Option<&u8>| b.is_some_and(u8::is_ascii_digit);
        if first.is_ascii_digit() || first == b'.' && is_digit(rest.as_bytes().get(1)) {
            return self.push(Kind::Number, number(rest), apart);
        }
        if let Some(quote) = self.quote(apart) {
            let prefix = rest.bytes().position(|b| b == quote).unwrap_or(0);
            let is_filled = rest[..prefix].contains(['f', 'F']);
            let kind = if is_filled { Kind::Filled } else { Kind::Text };
            return self.push(kind, prefix + quoted_length(&rest[prefix..], self.language), apart);
        }
        let c = rest.chars().next().unwrap_or(' ');
        if c.is_alphabetic() || c == '_' {
            let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
            return self.push(Kind::Name, length, apart);
        }
        match first {
            b'(' | b'[' | b'{' => self.open.push(first),
            b')' | b']' | b'}' => drop(self.open.pop()),
            b';' => return self.push(Kind::Line, 1, apart),
            _ => {}
        }
        let known = SIGNS.iter().find(|s| rest.starts_with(**s));
        self.push(Kind::Sign, known.map_or(c.len_utf8(), |s| s.len()), apart);
    }

    /// The quote that begins here, if one does: behind a value it is MATLAB's transpose.
    fn quote(&self, apart: bool) -> Option<u8> {
        let bytes = &self.text.as_bytes()[self.at..];
        if self.language == Language::Python {
            let prefix = bytes.iter().take(2).take_while(|b| b"rbfuRBFU".contains(b)).count();
            return bytes.get(prefix).copied().filter(|q| matches!(q, b'\'' | b'"'));
        }
        let behind_value = self.found.last().is_some_and(|t| match t.kind {
            Kind::Name | Kind::Number => true,
            Kind::Sign => [")", "]", "}", "'", ".'"].contains(&&self.text[t.span.clone()]),
            _ => false,
        });
        let in_row = matches!(self.open.last(), Some(b'[' | b'{'));
        match bytes[0] {
            b'"' => Some(b'"'),
            b'\'' if !behind_value || (apart && in_row) => Some(b'\''),
            _ => None,
        }
    }
}

/// The length of `%{ … %}` where it begins a line, blocks in it counted.
fn block_comment(text: &str) -> Option<usize> {
    let is = |line: &str, marks: [&str; 2]| marks.contains(&line.trim());
    let mut depth = 0_usize;
    let mut length = 0;
    for line in text.split_inclusive('\n') {
        length += line.len();
        if is(line, ["%{", "#{"]) {
            depth += 1;
        } else if depth > 0 && is(line, ["%}", "#}"]) {
            depth -= 1;
        }
        if depth == 0 {
            return (length > line.len()).then_some(length);
        }
    }
    Some(length)
}

/// The length of a number: `1`, `.5`, `1_000`, `1e-3`; `1.*x` has no fraction.
fn number(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'_').count();
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.')
        && !matches!(bytes.get(length + 1), Some(b'*' | b'/' | b'^' | b'\'' | b'.'))
    {
        length += 1 + digits(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = bytes.get(length + 1 + sign).map_or(0, |_| digits(length + 1 + sign));
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    length
}

/// The length of a text in quotes; one without end ends with its line.
fn quoted_length(text: &str, language: Language) -> usize {
    let bytes = text.as_bytes();
    let quote = bytes[0];
    let triple = [quote; 3];
    if language == Language::Python && bytes.starts_with(&triple) {
        let end = bytes[3..].windows(3).position(|w| w == triple);
        return end.map_or(bytes.len(), |e| e + 6);
    }
    let mut at = 1;
    while at < bytes.len() && bytes[at] != b'\n' {
        if bytes[at] == quote {
            if language == Language::Matlab && bytes.get(at + 1) == Some(&quote) {
                at += 2;
                continue;
            }
            return at + 1;
        }
        let escapes = language == Language::Python && bytes[at] == b'\\';
        at += if escapes {
            1 + usize::from(bytes.get(at + 1).is_some_and(|b| b.is_ascii() && *b != b'\n'))
        } else {
            1
        };
    }
    at
}

/// The text between quotes.
pub(super) fn quoted(text: &str) -> Option<&str> {
    let open = text.find(['\'', '"'])?;
    let text = &text[open..];
    let inner = |q: &str| text.strip_prefix(q)?.strip_suffix(q);
    inner("\"\"\"").or_else(|| inner("'''")).or_else(|| inner("'")).or_else(|| inner("\""))
}
