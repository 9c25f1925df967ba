//! The words and marks of a formula, LaTeX or plain, with their places.
//!
//! What sets a formula without meaning anything (`\,`, `\label{…}`, `\hline`, `$`, comments) is no token: it only
//! leaves a gap before the next one.

use super::cut;
use super::words;
use std::ops::Range;

/// What stands between a token and the one before it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Gap {
    None,
    Blank,
    /// Two blanks or more, or a tabulator.
    Wide,
    Line,
}

/// How two sides are said to be related.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Relation {
    /// `=`, `==`
    Equal,
    /// `:=`, `=:`, `\coloneqq`, `\triangleq`, `\doteq`, `≜`
    Define,
    /// `≡`, `\equiv`
    Identical,
    /// `≈`, `\approx`, `\simeq`, `\cong`
    Approximate,
}

/// The kinds of brackets. An opening and a closing bracket match if they are of one kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Bracket {
    Round,
    Square,
    /// `{`: groups in LaTeX, and is not shown.
    Brace,
    /// `\{`
    Curly,
    /// `\left` with the mark behind it.
    Left(char),
    /// `\right` with the mark behind it.
    Right(char),
}

/// How an environment of LaTeX is read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Environment {
    /// A matrix with its own bars; `' '` for none.
    Matrix(char),
    /// `array`: a matrix, a system of equations or a table.
    Array,
    /// `cases`.
    Cases,
    /// Its rows are statements.
    Display,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    /// A name or number.
    Word,
    /// `\name`
    Command,
    Operator,
    /// `_` or `^`
    Script,
    /// `\cdots`, `...`, `…`
    Dots,
    Comma,
    Semicolon,
    Colon,
    /// A wide space that is written: `\quad`, `\ `.
    Quad,
    Amp,
    /// `\\`, `\cr`
    Row,
    Open(Bracket),
    Close(Bracket),
    Begin(Environment),
    End,
    Relation(Relation),
    /// `<`, `\leq`, `\to`, `\in`: related otherwise.
    Other,
    /// `\Rightarrow`, `\implies`
    Arrow,
    /// `\text{…}` with words of prose.
    Prose,
    /// Any other character.
    Mark,
}

#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Token {
    pub kind: Kind,
    pub span: Range<usize>,
    pub gap: Gap,
}

/// The longest argument of `\label`, `\text` and the like.
const LONGEST_ARGUMENT: usize = 300;

/// The tokens of `span`.
pub(super) fn lex(text: &str, span: &Range<usize>) -> Vec<Token> {
    let source = cut(text, span);
    let mut lexer = Lexer { source, at: 0, gap: Gap::None, blanks: 0, out: vec![], offset: span.start };
    while lexer.at < source.len() {
        lexer.step();
    }
    lexer.out
}

struct Lexer<'t> {
    source: &'t str,
    at: usize,
    gap: Gap,
    blanks: usize,
    out: Vec<Token>,
    offset: usize,
}

impl<'t> Lexer<'t> {
    fn rest(&self) -> &'t str {
        self.source.get(self.at..).unwrap_or("")
    }

    fn push(&mut self, kind: Kind, bytes: usize) {
        let start = self.offset + self.at;
        self.out.push(Token { kind, span: start..start + bytes, gap: self.gap });
        self.at += bytes;
        (self.gap, self.blanks) = (Gap::None, 0);
    }

    fn skip(&mut self, bytes: usize) {
        self.at += bytes;
        self.gap = self.gap.max(Gap::Blank);
    }

    fn step(&mut self) {
        let rest = self.rest();
        let Some(c) = rest.chars().next() else { return };
        let size = c.len_utf8();
        let next = rest.get(size..).and_then(|r| r.chars().next());
        match c {
            '\n' => {
                self.at += 1;
                self.gap = Gap::Line;
            }
            '\t' => {
                self.at += 1;
                self.gap = self.gap.max(Gap::Wide);
            }
            _ if is_blank(c) => {
                self.at += size;
                self.blanks += 1;
                self.gap = self.gap.max(if self.blanks > 1 { Gap::Wide } else { Gap::Blank });
            }
            '$' | '`' | '~' if next != Some('=') => self.skip(size),
            // What says that a formula is proved.
            '✓' | '✔' | '∎' | '□' | '■' => self.skip(size),
            '%' | '#' => self.skip(line_length(rest)),
            '/' if next == Some('/') => self.skip(line_length(rest)),
            '\\' => self.command(next),
            '(' => self.push(Kind::Open(Bracket::Round), 1),
            ')' => self.push(Kind::Close(Bracket::Round), 1),
            '[' => self.push(Kind::Open(Bracket::Square), 1),
            ']' => self.push(Kind::Close(Bracket::Square), 1),
            '{' => self.push(Kind::Open(Bracket::Brace), 1),
            '}' => self.push(Kind::Close(Bracket::Brace), 1),
            '&' => self.push(Kind::Amp, 1),
            ',' | '\u{ff0c}' => self.push(Kind::Comma, size),
            ';' | '\u{ff1b}' => self.push(Kind::Semicolon, size),
            '_' | '^' => self.push(Kind::Script, 1),
            '=' => match next {
                Some('=') => self.push(Kind::Relation(Relation::Equal), 2),
                Some(':') => self.push(Kind::Relation(Relation::Define), 2),
                Some('>') => self.push(Kind::Arrow, 2),
                Some('<') => self.push(Kind::Other, 2),
                _ => self.push(Kind::Relation(Relation::Equal), 1),
            },
            ':' | '\u{ff1a}' if next == Some('=') => self.push(Kind::Relation(Relation::Define), size + 1),
            ':' | '\u{ff1a}' => self.push(Kind::Colon, size),
            '<' | '>' | '!' | '~' | '+' | '*' | '/' if next == Some('=') && c != '+' => {
                self.push(Kind::Other, 2)
            }
            '<' | '>' | '≤' | '≥' | '≠' | '∈' | '→' | '⟶' | '≪' | '≫' | '∉' | '⊂' | '∝' => {
                self.push(Kind::Other, size)
            }
            '⇒' | '⟹' | '⇔' | '⟺' => self.push(Kind::Arrow, size),
            '≜' | '≝' | '≔' => self.push(Kind::Relation(Relation::Define), size),
            '≡' => self.push(Kind::Relation(Relation::Identical), size),
            '≈' | '≃' | '≅' => self.push(Kind::Relation(Relation::Approximate), size),
            '…' | '⋯' | '⋮' | '⋱' => self.push(Kind::Dots, size),
            '.' if rest.starts_with("...") => self.push(Kind::Dots, 3),
            '.' if next.is_some_and(|n| n.is_ascii_digit()) && !self.touches_word() => self.word(),
            '+' | '-' | '*' | '/' | '·' | '×' | '⋅' | '∙' | '•' | '−' | '–' | '±' | '∓' | '÷' | '∘' | '⊗'
            | '⊙' | '.' => self.push(Kind::Operator, size),
            _ if is_word(c) => self.word(),
            _ => self.push(Kind::Mark, size),
        }
    }

    fn touches_word(&self) -> bool {
        self.gap == Gap::None
            && self.out.last().is_some_and(|t| matches!(t.kind, Kind::Word | Kind::Close(_) | Kind::Command))
    }

    /// A name (`c_234`, `θ₂`, `n_x`) or a number (`0.15`, `1e-3`).
    fn word(&mut self) {
        let rest = self.rest();
        let number = rest.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let mut chars = rest.char_indices().peekable();
        let mut end = 0;
        while let Some((at, c)) = chars.next() {
            let follows = chars.peek().map(|&(_, n)| n);
            let before = rest.get(..at).and_then(|r| r.chars().last());
            let inside = match c {
                _ if is_word(c) => true,
                '_' => follows.is_some_and(|n| n.is_alphanumeric()),
                '.' => number && follows.is_some_and(|n| n.is_ascii_digit()),
                '+' | '-' => {
                    number
                        && matches!(before, Some('e' | 'E'))
                        && follows.is_some_and(|n| n.is_ascii_digit())
                        && rest.get(..at.saturating_sub(1)).is_some_and(is_decimal)
                }
                _ => false,
            };
            if !inside {
                break;
            }
            end = at + c.len_utf8();
        }
        self.push(Kind::Word, end.max(1));
    }

    /// What begins with a backslash.
    fn command(&mut self, next: Option<char>) {
        let rest = self.rest();
        let Some(next) = next else { return self.push(Kind::Mark, 1) };
        if !next.is_ascii_alphabetic() {
            let size = 1 + next.len_utf8();
            return match next {
                '\\' => {
                    let after = rest.get(2..).unwrap_or("");
                    let star = usize::from(after.starts_with('*'));
                    self.push(Kind::Row, 2 + star + after.get(star..).map_or(0, row_space));
                }
                '{' => self.push(Kind::Open(Bracket::Curly), 2),
                '}' => self.push(Kind::Close(Bracket::Curly), 2),
                ' ' | '\n' | '\r' | '\t' => self.push(Kind::Quad, size),
                ',' | ';' | ':' | '!' | '[' | ']' | '(' | ')' | '>' | '$' | '/' => self.skip(size),
                _ => self.push(Kind::Mark, size),
            };
        }
        let letters = rest.bytes().skip(1).take_while(u8::is_ascii_alphabetic).count();
        let size = 1 + letters;
        let name = rest.get(1..size).unwrap_or("");
        let after = rest.get(size..).unwrap_or("");
        match name {
            "begin" | "end" => {
                let Some((inner, bytes)) = argument(after) else { return self.push(Kind::Command, size) };
                let Some(environment) = environment(inner.trim()) else { return self.skip(size + bytes) };
                if name == "end" {
                    return self.push(Kind::End, size + bytes);
                }
                let options = options(after.get(bytes..).unwrap_or(""), environment, inner.trim());
                self.push(Kind::Begin(environment), size + bytes + options);
            }
            "left" | "right" => {
                let blanks = after.len() - after.trim_start().len();
                let mark = after.trim_start();
                let (shown, bytes) = match mark.strip_prefix('\\') {
                    Some(escaped) if escaped.starts_with(['{', '}', '|']) => {
                        (escaped.chars().next().unwrap_or('.'), 2)
                    }
                    Some(escaped) => ('<', 1 + escaped.bytes().take_while(u8::is_ascii_alphabetic).count()),
                    None => mark.chars().next().map_or(('.', 0), |c| (c, c.len_utf8())),
                };
                let bracket = if name == "left" {
                    Kind::Open(Bracket::Left(shown))
                } else {
                    Kind::Close(Bracket::Right(shown))
                };
                self.push(bracket, size + blanks + bytes);
            }
            "label" | "tag" | "ref" | "eqref" | "cite" | "vspace" | "cline" | "phantom" | "color"
            | "footnote" => {
                self.skip(size + argument(after.strip_prefix('*').unwrap_or(after)).map_or(0, |a| a.1));
            }
            "hspace" => {
                let bytes = argument(after).map_or(0, |a| a.1);
                self.push(Kind::Quad, size + bytes);
            }
            "text" | "mbox" | "textrm" | "textbf" | "textit" | "intertext" | "textnormal" | "mathrm" => {
                let Some((inner, bytes)) = argument(after) else { return self.push(Kind::Command, size) };
                let prose = words::is_link(inner.trim())
                    || (name != "mathrm" && inner.trim().contains(' ') && !inner.contains('\\'));
                match prose {
                    true => self.push(Kind::Prose, size + bytes),
                    false => self.push(Kind::Command, size),
                }
            }
            "cdots" | "dots" | "ldots" | "vdots" | "ddots" | "dotsc" | "dotsb" => self.push(Kind::Dots, size),
            "quad" | "qquad" | "enspace" | "enskip" => self.push(Kind::Quad, size),
            "cr" | "newline" | "tabularnewline" => self.push(Kind::Row, size),
            "lbrack" => self.push(Kind::Open(Bracket::Square), size),
            "rbrack" => self.push(Kind::Close(Bracket::Square), size),
            "lbrace" => self.push(Kind::Open(Bracket::Curly), size),
            "rbrace" => self.push(Kind::Close(Bracket::Curly), size),
            _ => match command_kind(name) {
                Some(kind) => self.push(kind, size),
                None => self.skip(size),
            },
        }
    }
}

/// `None` for what only sets the formula.
fn command_kind(name: &str) -> Option<Kind> {
    Some(match name {
        "hline" | "nonumber" | "notag" | "displaystyle" | "textstyle" | "limits" | "nolimits"
        | "noindent" | "big" | "Big" | "bigg" | "Bigg" | "bigl" | "bigr" | "Bigl" | "Bigr" | "biggl"
        | "biggr" | "Biggl" | "Biggr" | "bigm" | "allowbreak" | "centering" | "medskip" | "smallskip"
        | "bigskip" | "small" | "checkmark" | "qed" | "qedsymbol" | "square" | "blacksquare" => {
            return None;
        }
        "equiv" => Kind::Relation(Relation::Identical),
        "approx" | "simeq" | "cong" => Kind::Relation(Relation::Approximate),
        "coloneqq" | "triangleq" | "doteq" | "eqqcolon" | "coloneq" => Kind::Relation(Relation::Define),
        "leq" | "geq" | "le" | "ge" | "lt" | "gt" | "neq" | "ne" | "in" | "notin" | "to" | "rightarrow"
        | "ll" | "gg" | "leqslant" | "geqslant" | "mapsto" | "propto" | "subset" | "sim" | "leftarrow"
        | "gets" | "perp" | "parallel" => Kind::Other,
        "Rightarrow" | "implies" | "Longrightarrow" | "longrightarrow" | "Leftrightarrow" | "iff"
        | "Leftarrow" | "therefore" => Kind::Arrow,
        "cdot" | "times" | "pm" | "mp" | "ast" | "div" | "circ" | "bullet" | "otimes" | "odot" | "star" => {
            Kind::Operator
        }
        _ => Kind::Command,
    })
}

fn environment(name: &str) -> Option<Environment> {
    Some(match name.trim_end_matches('*') {
        "bmatrix" => Environment::Matrix('['),
        "pmatrix" => Environment::Matrix('('),
        "vmatrix" | "Vmatrix" => Environment::Matrix('|'),
        "Bmatrix" => Environment::Matrix('{'),
        "matrix" | "smallmatrix" => Environment::Matrix(' '),
        "bsmallmatrix" => Environment::Matrix('['),
        "psmallmatrix" => Environment::Matrix('('),
        "array" => Environment::Array,
        "cases" | "dcases" | "rcases" => Environment::Cases,
        name if DISPLAYS.contains(&name) => Environment::Display,
        _ => return None,
    })
}

/// The environments whose rows are statements, without their stars.
pub(super) const DISPLAYS: [&str; 16] = [
    "equation",
    "align",
    "aligned",
    "alignat",
    "alignedat",
    "split",
    "gather",
    "gathered",
    "multline",
    "eqnarray",
    "flalign",
    "displaymath",
    "math",
    "dmath",
    "subequations",
    "dgroup",
];

/// The text in the braces that `text` begins with, and the bytes with them.
fn argument(text: &str) -> Option<(&str, usize)> {
    let blanks = text.len() - text.trim_start_matches([' ', '\t']).len();
    if text.as_bytes().get(blanks) != Some(&b'{') {
        return None;
    }
    let mut depth = 0;
    for (i, byte) in text.bytes().enumerate().skip(blanks).take(LONGEST_ARGUMENT) {
        match byte {
            b'{' => depth += 1,
            b'}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some((text.get(blanks + 1..i)?, i + 1));
        }
    }
    None
}

/// The bytes of `[t]`, `{cccc}` or `{2}` behind `\begin{…}`.
fn options(text: &str, environment: Environment, name: &str) -> usize {
    let mut bytes = 0;
    let starred_matrix = matches!(environment, Environment::Matrix(_)) && name.ends_with('*');
    if (environment != Environment::Cases && environment != Environment::Display && text.starts_with('['))
        && (environment == Environment::Array || starred_matrix)
    {
        bytes = text.bytes().take(8).position(|b| b == b']').map_or(0, |i| i + 1);
    }
    if environment == Environment::Array || name.starts_with("alignat") || name == "alignedat" {
        bytes += text.get(bytes..).and_then(argument).map_or(0, |a| a.1);
    }
    bytes
}

/// The bytes of a length such as `[4pt]`.
fn row_space(text: &str) -> usize {
    let Some(end) = text.bytes().take(20).position(|b| b == b']') else { return 0 };
    let Some(inner) = text.get(1..end).filter(|_| text.starts_with('[')) else { return 0 };
    let unit = inner.trim_start_matches(|c: char| c.is_ascii_digit() || "-. ".contains(c));
    let known = ["pt", "em", "ex", "mm", "cm", "in", "mu", "bp", "jot", "\\jot"];
    if unit.len() < inner.len() && known.contains(&unit.trim()) { end + 1 } else { 0 }
}

fn is_decimal(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit() || b == b'.')
}

/// Bytes up to the end of the line.
fn line_length(text: &str) -> usize {
    text.bytes().position(|b| b == b'\n').unwrap_or(text.len())
}

/// Blanks, control characters, and characters of no width.
pub(super) fn is_blank(c: char) -> bool {
    c.is_whitespace()
        || c.is_control()
        || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2060}'..='\u{2064}' | '\u{feff}' | '\u{ad}')
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric()
        || matches!(c, '\'' | '′' | '″' | '°' | '⁺' | '⁻' | '₊' | '₋' | '∞' | '∂' | '?')
        || ('\u{300}'..='\u{36f}').contains(&c)
}
