//! Text to tokens, for both languages: lines, indentation, brackets, and the quote that is a transpose.

use super::Dialect;
use super::tree::Span;
use denavit_symbolic::Rational;

#[derive(Clone, PartialEq, Debug)]
pub(super) enum Mark {
    /// A number; true for one without a point or an exponent.
    Number(Rational, bool),
    Name(String),
    Text(String),
    Op(&'static str),
    /// The end of a line that ends a statement.
    Newline,
    Indent,
    Dedent,
    /// What cannot be read, and why.
    Bad(String),
}

#[derive(Clone, Debug)]
pub(super) struct Token {
    pub mark: Mark,
    pub span: Span,
    /// True if a blank stands before it.
    pub is_apart: bool,
}

/// Longer ones first.
const PYTHON: &[&str] = &[
    "**=", "//=", ">>=", "<<=", "...", "**", "//", "->", ":=", "==", "!=", "<=", ">=", "+=", "-=", "*=",
    "/=", "@=", "%=", "|=", "&=", "^=", "<<", ">>", "+", "-", "*", "/", "%", "@", "&", "|", "^", "~", "<",
    ">", "(", ")", "[", "]", "{", "}", ",", ":", ".", ";", "=",
];
const MATLAB: &[&str] = &[
    ".*", "./", ".^", ".\\", ".'", "==", "~=", "!=", "<=", ">=", "&&", "||", "+=", "-=", "*=", "/=", "+",
    "-", "*", "/", "\\", "^", "~", "!", "<", ">", "(", ")", "[", "]", "{", "}", ",", ":", ".", ";", "=", "@",
    "&", "|",
];

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    end: usize,
    language: Dialect,
    /// The brackets that are open.
    open: Vec<&'static str>,
    indents: Vec<usize>,
    tokens: Vec<Token>,
    is_apart: bool,
}

/// The tokens of a part of a text; the last statement is ended by a `Newline`.
pub(super) fn tokens(text: &str, span: &Span, language: Dialect) -> Vec<Token> {
    let mut lexer = Lexer {
        text,
        at: span.start,
        end: span.end,
        language,
        open: vec![],
        indents: vec![],
        tokens: vec![],
        is_apart: false,
    };
    lexer.run();
    lexer.tokens
}

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..self.end).unwrap_or_default()
    }

    fn push(&mut self, mark: Mark, length: usize) {
        let span = self.at..self.at + length;
        self.tokens.push(Token { mark, span, is_apart: std::mem::take(&mut self.is_apart) });
        self.at += length;
    }

    fn run(&mut self) {
        match self.language {
            Dialect::Python | Dialect::C => self.indentation(),
            Dialect::Matlab => self.block_comment(),
        }
        while let Some(c) = self.rest().chars().next() {
            match (c, self.language) {
                ('\n', _) => self.newline(),
                ('\\', Dialect::Python) if self.is_continued() => self.skip_line(true),
                _ if c.is_whitespace() || c == '\u{feff}' => {
                    self.is_apart = true;
                    self.at += c.len_utf8();
                }
                ('#', _) => self.skip_line(false),
                ('%', Dialect::Matlab) => self.skip_line(false),
                ('.', Dialect::Matlab) if self.rest().starts_with("...") => self.skip_line(true),
                ('0'..='9', _) => self.number(),
                ('.', _) if self.rest()[1..].starts_with(|c: char| c.is_ascii_digit()) => self.number(),
                ('"' | '\'', Dialect::Python) => self.python_text(self.at),
                ('"', Dialect::Matlab) => self.matlab_text('"'),
                ('\'', Dialect::Matlab) if !self.is_transpose() => self.matlab_text('\''),
                ('\'', Dialect::Matlab) => self.push(Mark::Op("'"), 1),
                _ if c.is_alphabetic() || c == '_' => self.word(),
                _ => self.operator(c),
            }
        }
        self.push(Mark::Newline, 0);
        for _ in 1..self.indents.len() {
            self.push(Mark::Dedent, 0);
        }
    }

    fn is_continued(&self) -> bool {
        let rest = self.rest()[1..].trim_start_matches([' ', '\t', '\r']);
        rest.is_empty() || rest.starts_with('\n')
    }

    /// To the end of the line, and past it if it goes on below.
    fn skip_line(&mut self, goes_on: bool) {
        let rest = self.rest();
        let length = rest.find('\n').unwrap_or(rest.len());
        self.at += length;
        if goes_on && length < rest.len() {
            self.at += 1;
        }
        self.is_apart = true;
    }

    fn newline(&mut self) {
        match (self.open.last(), self.language) {
            (None, _) => {
                self.push(Mark::Newline, 1);
                match self.language {
                    Dialect::Python | Dialect::C => self.indentation(),
                    Dialect::Matlab => self.block_comment(),
                }
            }
            (Some(&("[" | "{")), Dialect::Matlab) => {
                self.push(Mark::Op(";"), 1);
            }
            _ => {
                self.is_apart = true;
                self.at += 1;
            }
        }
    }

    /// `%{` … `%}`, each on a line of its own.
    fn block_comment(&mut self) {
        let is_line = |line: &str, mark: char| {
            let mut chars = line.trim().chars();
            matches!(chars.next(), Some('%' | '#')) && chars.next() == Some(mark) && chars.next().is_none()
        };
        let mut depth = 0_usize;
        while let Some(line) = self.rest().split_inclusive('\n').next() {
            if is_line(line, '{') {
                depth += 1;
            } else if depth > 0 && is_line(line, '}') {
                depth -= 1;
            } else if depth == 0 {
                return;
            }
            self.at += line.len();
        }
    }

    /// At the beginning of a line: blank lines are passed over, and blocks begin and end.
    fn indentation(&mut self) {
        loop {
            let rest = self.rest();
            let blanks = rest.len() - rest.trim_start_matches([' ', '\t', '\r', '\u{c}', '\u{feff}']).len();
            let width = rest[..blanks].chars().fold(0, |w, c| match c {
                '\t' => (w / 8 + 1) * 8,
                ' ' => w + 1,
                _ => w,
            });
            let line = &rest[blanks..];
            if line.is_empty() {
                self.at += blanks;
                return;
            }
            if line.starts_with(['\n', '#']) {
                self.at += blanks;
                self.skip_line(true);
                continue;
            }
            self.at += blanks;
            if self.indents.is_empty() {
                self.indents.push(width);
            }
            if self.indents.last().is_some_and(|&top| width > top) {
                self.indents.push(width);
                self.push(Mark::Indent, 0);
                return;
            }
            while self.indents.len() > 1 && self.indents.last().is_some_and(|&top| width < top) {
                self.indents.pop();
                self.push(Mark::Dedent, 0);
            }
            if self.indents.last().is_some_and(|&top| width > top) {
                self.push(Mark::Bad("the line is not indented as any line above".to_string()), 0);
            }
            return;
        }
    }

    fn number(&mut self) {
        let bytes = self.rest().as_bytes();
        let digits = |mut at: usize| {
            while bytes.get(at).is_some_and(|b| b.is_ascii_digit() || *b == b'_') {
                at += 1;
            }
            at
        };
        let mut length = digits(0);
        let mut is_whole = true;
        // In MATLAB the point of `2.*x` belongs to the operator.
        let is_operator = |b: Option<&u8>| matches!(b, Some(b'*' | b'/' | b'^' | b'\\' | b'\''));
        if bytes.get(length) == Some(&b'.')
            && !(self.language == Dialect::Matlab && is_operator(bytes.get(length + 1)))
        {
            length = digits(length + 1);
            is_whole = false;
        }
        if matches!(bytes.get(length), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
            let end = digits(length + 1 + sign);
            if end > length + 1 + sign {
                length = end;
                is_whole = false;
            }
        }
        let written = self.rest()[..length].replace('_', "");
        let tail: String =
            self.rest()[length..].chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        if !tail.is_empty() {
            let message = format!("`{written}{tail}` is not a number that is read");
            return self.push(Mark::Bad(message), length + tail.len());
        }
        let mark = match Rational::from_decimal(&written) {
            Some(r) => Mark::Number(r, is_whole),
            None => Mark::Bad("a number of this size is not read".to_string()),
        };
        self.push(mark, length);
    }

    fn word(&mut self) {
        let rest = self.rest();
        let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let word = &rest[..length];
        if self.language == Dialect::Python
            && word.len() <= 2
            && word.chars().all(|c| "rRbBuUfF".contains(c))
            && rest[length..].starts_with(['"', '\''])
        {
            return self.python_text(self.at + length);
        }
        self.push(Mark::Name(word.to_string()), length);
    }

    /// A text whose quote is at `quote`, behind its prefix.
    fn python_text(&mut self, quote: usize) {
        let rest = self.text.get(quote..self.end).unwrap_or_default();
        let one = &rest[..1];
        let three = one.repeat(3);
        let mark = if rest.starts_with(&three) { three.as_str() } else { one };
        let mut at = mark.len();
        while let Some(c) = rest[at..].chars().next() {
            if rest[at..].starts_with(mark) {
                let inner = rest[mark.len()..at].to_string();
                return self.push(Mark::Text(inner), quote + at + mark.len() - self.at);
            }
            if c == '\n' && mark.len() == 1 {
                break;
            }
            at += c.len_utf8();
            if c == '\\' {
                at += rest[at..].chars().next().map_or(0, char::len_utf8);
            }
        }
        self.push(Mark::Bad("the text is not closed".to_string()), quote + at - self.at);
    }

    fn matlab_text(&mut self, quote: char) {
        let rest = self.rest();
        let mut inner = String::new();
        let mut at = 1;
        while let Some(c) = rest[at..].chars().next() {
            if c == '\n' {
                break;
            }
            at += c.len_utf8();
            if c == quote {
                if !rest[at..].starts_with(quote) {
                    return self.push(Mark::Text(inner), at);
                }
                at += 1;
            }
            inner.push(c);
        }
        self.push(Mark::Bad("the text is not closed".to_string()), at);
    }

    /// True if a quote at this place is an operator of what stands before it.
    fn is_transpose(&self) -> bool {
        let in_matrix = matches!(self.open.last(), Some(&("[" | "{")));
        let Some(last) = self.tokens.last().filter(|_| !(self.is_apart && in_matrix)) else { return false };
        match &last.mark {
            Mark::Name(_) | Mark::Number(..) | Mark::Text(_) => true,
            Mark::Op(op) => matches!(*op, ")" | "]" | "}" | "'" | ".'"),
            _ => false,
        }
    }

    fn operator(&mut self, c: char) {
        let all = if self.language == Dialect::Python { PYTHON } else { MATLAB };
        let Some(op) = all.iter().find(|op| self.rest().starts_with(**op)) else {
            return self.push(Mark::Bad(format!("`{c}` is not read here")), c.len_utf8());
        };
        match *op {
            "(" | "[" | "{" => self.open.push(op),
            ")" | "]" | "}" => {
                self.open.pop();
            }
            _ => {}
        }
        self.push(Mark::Op(op), op.len());
    }
}
