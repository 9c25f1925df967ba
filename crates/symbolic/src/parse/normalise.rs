//! Text to marks: the many spellings of one character (Unicode, LaTeX) become one, and keep their place.

use super::ParseError;
use crate::greek;
use std::ops::Range;

/// One character of the plain spelling, and the bytes of the text that it came from.
#[derive(Clone, Debug)]
pub(super) struct Mark {
    pub glyph: Glyph,
    pub span: Range<usize>,
}

/// A plain character, or what has none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Glyph {
    Char(char),
    /// `\frac`: two groups in braces follow.
    Fraction,
    /// A name in backquotes.
    Quoted(String),
}

impl Mark {
    /// The character, if it is one.
    pub fn char(&self) -> Option<char> {
        match self.glyph {
            Glyph::Char(c) => Some(c),
            Glyph::Fraction | Glyph::Quoted(_) => None,
        }
    }

    /// True for blank space.
    pub fn is_space(&self) -> bool {
        self.char() == Some(' ')
    }
}

/// LaTeX commands that stand for one character, besides those of [`greek::LETTERS`].
const COMMANDS: &[(&str, char)] = &[
    ("varepsilon", 'ε'),
    ("vartheta", 'θ'),
    ("pi", 'π'),
    ("varphi", 'φ'),
    ("Pi", 'Π'),
    ("sqrt", '√'),
    ("cdot", '*'),
    ("times", '*'),
    ("ast", '*'),
    ("div", '/'),
    ("circ", '°'),
    ("degree", '°'),
    ("quad", ' '),
    ("qquad", ' '),
    ("pm", '±'),
    ("mp", '∓'),
    ("ell", 'l'),
];

/// LaTeX commands for a word of several letters.
const WORDS: &[&str] = &[
    "cos", "sin", "sen", "tan", "tg", "arccos", "arcsin", "arcsen", "arctan", "arctg", "acos", "asin",
    "atan", "deg", "rad", "mm", "cm",
];

/// LaTeX commands that only change the looks, with an argument in braces, and without one.
const WRAPPERS: &[&str] = &[
    "mathsf",
    "mathbf",
    "mathrm",
    "mathit",
    "mathnormal",
    "boldsymbol",
    "text",
    "textrm",
    "textit",
    "operatorname",
    "mathtt",
    "bm",
    "textbf",
    "textsf",
    "rm",
    "bf",
    "overline",
    "bar",
    "hat",
];
const IGNORED: &[&str] = &[
    "left",
    "right",
    "big",
    "Big",
    "bigl",
    "bigr",
    "Bigl",
    "Bigr",
    "bigg",
    "biggl",
    "biggr",
    "displaystyle",
    "textstyle",
    "limits",
];

/// The character that a LaTeX command stands for.
fn command(name: &str) -> Option<char> {
    greek::LETTERS.iter().chain(COMMANDS).find(|(n, _)| *n == name).map(|(_, c)| *c)
}

/// The Greek letter whose name `word` begins with, the longest one.
pub(super) fn greek_prefix(word: &str) -> Option<(&'static str, char)> {
    let variants = COMMANDS.iter().filter(|(_, c)| is_greek(*c));
    let names = greek::LETTERS.iter().chain(variants).filter(|(n, _)| word.starts_with(n));
    names.max_by_key(|(n, _)| n.len()).copied()
}

/// The name of a Greek letter.
pub fn greek_name(letter: char) -> Option<&'static str> {
    if letter == 'π' { Some("pi") } else { greek::name(letter) }
}

/// True for the Greek letters.
pub(super) fn is_greek(c: char) -> bool {
    matches!(c, 'Α'..='Ω' | 'α'..='ω' | 'ϑ' | 'ϕ' | 'ϵ')
}

/// The plain spelling of `text`.
pub(super) fn normalise(text: &str) -> (Vec<Mark>, Vec<ParseError>) {
    let mut n = Normaliser { text, at: 0, marks: vec![], errors: vec![], is_wrapper: vec![] };
    while let Some(c) = n.peek() {
        n.step(c);
    }
    (n.marks, n.errors)
}

struct Normaliser<'a> {
    text: &'a str,
    at: usize,
    marks: Vec<Mark>,
    errors: Vec<ParseError>,
    /// For each open brace whether it belongs to a wrapper, and is dropped.
    is_wrapper: Vec<bool>,
}

impl Normaliser<'_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn push(&mut self, c: char, span: Range<usize>) {
        self.marks.push(Mark { glyph: Glyph::Char(c), span });
    }

    fn step(&mut self, c: char) {
        let start = self.at;
        if c == '\\' {
            return self.command();
        }
        if c == '`' {
            return self.quoted();
        }
        if let Some(first) = small(c) {
            return self.small_run(first.0);
        }
        self.at += c.len_utf8();
        let span = start..self.at;
        match c {
            '{' => {
                self.is_wrapper.push(false);
                self.push(c, span);
            }
            '}' => match self.is_wrapper.pop() {
                Some(true) if self.peek().is_some_and(|c| c.is_alphabetic() || c == '\\') => {
                    self.push(' ', span)
                }
                Some(true) => {}
                _ => self.push(c, span),
            },
            '\u{307}' => self.dotted("dot"),
            '\u{308}' => self.dotted("ddot"),
            '½' | '⅓' | '¼' => {
                let fraction = match c {
                    '½' => "(1/2)",
                    '⅓' => "(1/3)",
                    _ => "(1/4)",
                };
                fraction.chars().for_each(|c| self.push(c, span.clone()));
            }
            '\u{ad}'
            | '\u{200b}'..='\u{200f}'
            | '\u{202a}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{feff}' => {
                let message = format!("invisible character U+{:04X}", c as u32);
                self.errors.push(ParseError::new(span, message).hint("delete it"));
            }
            '&' if self.is_beside_sign() => self.push(' ', span),
            _ => self.push(plain(c), span),
        }
    }

    /// True if a sign, or an end of the text, is before or behind this place: a line is broken or aligned there.
    fn is_beside_sign(&self) -> bool {
        const SIGNS: [&str; 4] = [r"\pm", r"\mp", r"\\", r"\cdot"];
        let is_sign = |c: char| matches!(plain(c), '+' | '-' | '±' | '∓' | '=' | '*' | '/' | '&');
        let rest = self.text[self.at..].trim_start();
        let before = || self.marks.iter().rev().find(|m| !m.is_space());
        rest.chars().next().is_none_or(is_sign)
            || SIGNS.iter().any(|s| rest.starts_with(s))
            || before().is_none_or(|m| m.char().is_some_and(is_sign))
    }

    /// A run of Unicode subscripts or superscripts, as a group in braces.
    fn small_run(&mut self, opening: char) {
        let start = self.at;
        let first = self.peek().map_or(0, char::len_utf8);
        self.push(opening, start..if opening == '^' { start + first } else { start });
        self.push('{', start..start);
        while let Some((kind, c)) = self.peek().and_then(small)
            && kind == opening
        {
            let from = self.at;
            self.at += self.peek().map_or(0, char::len_utf8);
            self.push(c, from..self.at);
        }
        self.push('}', self.at..self.at);
    }

    fn command(&mut self) {
        let start = self.at;
        let rest = &self.text[start + 1..];
        let length = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let name = &rest[..length];
        self.at = start + 1 + length;
        let span = start..self.at;
        if name.is_empty() {
            let Some(c) = self.peek() else {
                return self.errors.push(ParseError::new(span, "a `\\` without a command"));
            };
            self.at += c.len_utf8();
            let span = start..self.at;
            match c {
                ',' | ';' | ':' | '!' | '>' | ' ' | '(' | ')' | '[' | ']' | '*' => self.push(' ', span),
                '{' | '}' | '_' => self.push(c, span),
                '\\' if self.is_beside_sign() => self.push(' ', span),
                _ => self.errors.push(ParseError::new(span, format!("unknown command `\\{c}`"))),
            }
        } else if let Some(c) = command(name) {
            if name == "sqrt" && self.text[self.at..].trim_start().starts_with('[') {
                self.errors.push(ParseError::new(span.clone(), "only square roots are read"));
            }
            self.push(c, span);
        } else if WORDS.contains(&name) {
            self.push(' ', start..start);
            name.chars().for_each(|c| self.push(c, span.clone()));
        } else if matches!(name, "frac" | "dfrac" | "tfrac" | "cfrac") {
            self.marks.push(Mark { glyph: Glyph::Fraction, span });
            self.digits_of_fraction();
        } else if WRAPPERS.contains(&name) {
            match self.upright_function() {
                Some((word, length)) => {
                    self.push(' ', start..start);
                    let span = start..self.at + length;
                    word.chars().for_each(|c| self.push(c, span.clone()));
                    self.at += length;
                }
                None => {
                    self.push(' ', span);
                    self.wrapper();
                }
            }
        } else if matches!(name, "dot" | "ddot") {
            // The rate of a name is a name: `\dot{q}_1` is `dotq1`.
            self.push(' ', start..start);
            name.chars().for_each(|c| self.push(c, span.clone()));
            self.at += self.text[self.at..].len() - self.text[self.at..].trim_start().len();
            self.wrapper();
        } else if !IGNORED.contains(&name) {
            self.errors.push(ParseError::new(span, format!("unknown command `\\{name}`")));
        } else if matches!(name, "left" | "right") {
            // `\left.` is a bracket that is not seen.
            let rest = self.text[self.at..].trim_start();
            if let Some(behind) = rest.strip_prefix('.') {
                self.at = self.text.len() - behind.len();
            }
        }
    }

    /// `\frac12`: a digit without braces is the whole of what is above, and one behind it of what is below.
    fn digits_of_fraction(&mut self) {
        for _ in 0..2 {
            let rest = &self.text[self.at..];
            let blank = rest.len() - rest.trim_start().len();
            let Some(digit) = rest[blank..].chars().next().filter(char::is_ascii_digit) else { return };
            let start = self.at + blank;
            self.push('{', start..start);
            self.push(digit, start..start + 1);
            self.push('}', start + 1..start + 1);
            self.at = start + 1;
        }
    }

    /// `{s}` behind a command for upright letters and before a Greek letter is the sine, also where a name is s,
    /// which is in italics: `s\,\mathrm{c}\theta_2`. The function, and the length of the braces.
    fn upright_function(&self) -> Option<(&'static str, usize)> {
        let rest = &self.text[self.at..];
        let word = match rest.get(..3)? {
            "{s}" => "sin",
            "{c}" => "cos",
            _ => return None,
        };
        let behind = rest[3..].trim_start().strip_prefix('\\')?;
        greek_prefix(behind).map(|_| (word, 3))
    }

    /// Goes into the braces of a command whose braces are not part of the formula.
    fn wrapper(&mut self) {
        let rest = &self.text[self.at..];
        let blank = rest.len() - rest.trim_start().len();
        if rest[blank..].starts_with('{') {
            self.at += blank + 1;
            self.is_wrapper.push(true);
        }
    }

    /// `q̇`, `q̈`: the dots stand behind their letter.
    fn dotted(&mut self, dots: &str) {
        let Some(letter) = self.marks.pop_if(|m| m.char().is_some_and(char::is_alphabetic)) else { return };
        dots.chars().for_each(|c| self.push(c, letter.span.clone()));
        self.marks.push(letter);
    }

    fn quoted(&mut self) {
        let start = self.at;
        let mut name = String::new();
        let mut chars = self.text[start + 1..].char_indices();
        while let Some((i, c)) = chars.next() {
            let c = match c {
                '`' => {
                    self.at = start + 1 + i + 1;
                    return self.marks.push(Mark { glyph: Glyph::Quoted(name), span: start..self.at });
                }
                '\\' => chars.next().map_or('\\', |(_, c)| c),
                _ => c,
            };
            name.push(c);
        }
        self.at = self.text.len();
        self.errors.push(ParseError::new(start..self.at, "a name in backquotes without its end"));
    }
}

/// One spelling for a character.
fn plain(c: char) -> char {
    match c {
        '−' | '–' | '—' | '‐' | '‑' | '‒' | '﹣' | '－' => '-',
        '·' | '×' | '∗' | '⋅' | '∙' | '•' | '✕' | '⨯' => '*',
        '÷' | '∕' | '⁄' => '/',
        '＋' => '+',
        '＝' => '=',
        '（' => '(',
        '）' => ')',
        '，' => ',',
        'º' | '˚' => '°',
        'µ' => 'μ',
        'ℓ' => 'l',
        'ϑ' => 'θ',
        '\u{2126}' => 'Ω',
        '~' | '$' => ' ',
        c if c.is_whitespace() => ' ',
        c => c,
    }
}

/// The plain character of a subscript one: `₁` is 1.
pub fn subscript(c: char) -> Option<char> {
    small(c).filter(|s| s.0 == '_').map(|s| s.1)
}

/// Sub- and superscripts of Unicode: `_` or `^`, and the character.
fn small(c: char) -> Option<(char, char)> {
    const SUBSCRIPTS: &str = "₀0₁1₂2₃3₄4₅5₆6₇7₈8₉9₊+₋-ₐaₑeₕhᵢiⱼjₖkₗlₘmₙnₒoₚpᵣrₛsₜtᵤuᵥvₓx";
    const SUPERSCRIPTS: &str = "⁰0¹1²2³3⁴4⁵5⁶6⁷7⁸8⁹9⁻-";
    let find = |table: &str, kind| {
        let mut chars = table.chars();
        chars.find(|x| *x == c).and_then(|_| chars.next()).map(|plain| (kind, plain))
    };
    if c.is_ascii() { None } else { find(SUBSCRIPTS, '_').or_else(|| find(SUPERSCRIPTS, '^')) }
}
