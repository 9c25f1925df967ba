//! Cutting a cell into numbers, names and signs.
//!
//! A name of a document (`$\theta_{1}$`, `θ₁`, `θ_1`) is brought to plain letters and digits (`theta1`); one of a
//! robot file is what it is, Greek letters aside.

use denavit_symbolic::Rational;
use std::ops::Range;

/// A piece of a cell.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Token {
    pub kind: Kind,
    pub span: Range<usize>,
    /// A `$` stands before it.
    pub after_dollar: bool,
}

/// What a piece is.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Kind {
    /// A decimal, and how many significant digits it shows.
    Number(Rational, usize),
    /// A name.
    Word(String),
    /// One of `+ - * / ^ ( ) ,`.
    Sign(char),
    /// `\frac`: two groups follow.
    Fraction,
    /// `\sqrt`: a group follows.
    Root,
    /// `^\circ`.
    Degree,
}

/// What is wrong with a cell, and where in it.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Fault {
    pub span: Range<usize>,
    pub message: String,
    pub hint: Option<String>,
}

impl Fault {
    pub fn new(span: Range<usize>, message: impl Into<String>) -> Self {
        Fault { span, message: message.into(), hint: None }
    }

    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

const GREEK: &[(char, &str)] = &[
    ('α', "alpha"),
    ('⍺', "alpha"),
    ('β', "beta"),
    ('γ', "gamma"),
    ('δ', "delta"),
    ('ε', "epsilon"),
    ('ζ', "zeta"),
    ('η', "eta"),
    ('θ', "theta"),
    ('ϑ', "theta"),
    ('Θ', "theta"),
    ('ι', "iota"),
    ('κ', "kappa"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('ν', "nu"),
    ('ξ', "xi"),
    ('π', "pi"),
    ('ρ', "rho"),
    ('σ', "sigma"),
    ('ς', "sigma"),
    ('τ', "tau"),
    ('φ', "phi"),
    ('ϕ', "phi"),
    ('χ', "chi"),
    ('ψ', "psi"),
    ('ω', "omega"),
    ('Γ', "Gamma"),
    ('Δ', "Delta"),
    ('Λ', "Lambda"),
    ('Φ', "Phi"),
    ('Ψ', "Psi"),
    ('Ω', "Omega"),
];

/// The plain name of a Greek letter.
pub(in crate::description) fn greek(c: char) -> Option<&'static str> {
    GREEK.iter().find(|g| g.0 == c).map(|g| g.1)
}

/// Commands of LaTeX that only change how their group looks.
const LOOKS: &[&str] = &[
    "mathrm",
    "text",
    "mathit",
    "mathbf",
    "mathsf",
    "mathtt",
    "boldsymbol",
    "bm",
    "textbf",
    "textit",
    "rm",
    "bf",
    "textrm",
    "overline",
    "bar",
    "hat",
    "operatorname",
];
/// Commands that are space, or brackets of some size.
const SPACE: &[&str] =
    &["left", "right", "quad", "qquad", "displaystyle", "textstyle", "limits", "big", "Big", "bigl", "bigr"];

/// The plain character of a subscript one: `₁` is 1.
pub(in crate::description) fn subscript(c: char) -> Option<char> {
    Some(match c {
        '₀'..='₉' => char::from(b'0' + u8::try_from(u32::from(c) - u32::from('₀')).ok()?),
        'ᵢ' => 'i',
        'ⱼ' => 'j',
        'ₖ' => 'k',
        'ₙ' => 'n',
        '₋' => '-',
        '₊' => '+',
        'ₐ' => 'a',
        'ₑ' => 'e',
        'ₓ' => 'x',
        _ => return None,
    })
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    document: bool,
    decimal_comma: bool,
    tokens: Vec<Token>,
    after_dollar: bool,
    /// For each open `{`, whether it stands in the formula as a bracket.
    braces: Vec<bool>,
}

/// The pieces of a cell. `document`: as it stands in a document; `decimal_comma`: `0,5` is a half.
pub(super) fn tokens(text: &str, document: bool, decimal_comma: bool) -> Result<Vec<Token>, Fault> {
    let mut lexer =
        Lexer { text, at: 0, document, decimal_comma, tokens: vec![], after_dollar: false, braces: vec![] };
    while let Some(c) = lexer.peek() {
        lexer.next_token(c)?;
    }
    Ok(lexer.tokens)
}

impl Lexer<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn peek_second(&self) -> Option<char> {
        self.rest().chars().nth(1)
    }

    /// Takes characters while `keep` holds.
    fn take_while(&mut self, keep: impl Fn(char) -> bool) -> String {
        let taken: String = self.rest().chars().take_while(|&c| keep(c)).collect();
        self.at += taken.len();
        taken
    }

    /// Takes `word` if it is next.
    fn take(&mut self, word: &str) -> bool {
        let found = self.rest().starts_with(word);
        if found {
            self.at += word.len();
        }
        found
    }

    fn push(&mut self, kind: Kind, start: usize) {
        let after_dollar = std::mem::take(&mut self.after_dollar);
        self.tokens.push(Token { kind, span: start..self.at, after_dollar });
    }

    fn next_token(&mut self, c: char) -> Result<(), Fault> {
        let start = self.at;
        match c {
            c if c.is_whitespace() || c == '\u{200b}' || c == '\u{feff}' => self.at += c.len_utf8(),
            '$' => {
                self.at += 1;
                self.after_dollar = true;
            }
            '0'..='9' => return self.number(start),
            '.' if self.peek_second().is_some_and(|d| d.is_ascii_digit()) => return self.number(start),
            '\\' if self.document => return self.command(start),
            '{' if self.document => {
                self.at += 1;
                self.braces.push(true);
                self.push(Kind::Sign('('), start);
            }
            '}' if self.document => {
                self.at += 1;
                match self.braces.pop() {
                    Some(true) => self.push(Kind::Sign(')'), start),
                    Some(false) => {}
                    None => return Err(Fault::new(start..self.at, "`}` without `{`")),
                }
            }
            '^' => {
                self.at += 1;
                let degree =
                    ["\\circ", "{\\circ}", "{ \\circ }", "{o}", "\\degree"].iter().any(|d| self.take(d));
                self.push(if degree { Kind::Degree } else { Kind::Sign('^') }, start);
            }
            '²' => {
                self.at += c.len_utf8();
                self.push(Kind::Sign('^'), start);
                self.push(Kind::Number(Rational::from(2), 1), start);
            }
            '°' | 'º' | '˚' => {
                self.at += c.len_utf8();
                self.push(Kind::Degree, start);
            }
            '+' | '*' | '/' | '(' | ')' | ',' => {
                self.at += 1;
                self.push(Kind::Sign(c), start);
            }
            '[' | ']' => {
                self.at += 1;
                self.push(Kind::Sign(if c == '[' { '(' } else { ')' }), start);
            }
            '-' | '−' | '–' | '‐' | '‑' | '—' | '﹣' => {
                self.at += c.len_utf8();
                self.push(Kind::Sign('-'), start);
            }
            '·' | '×' | '⋅' | '∙' => {
                self.at += c.len_utf8();
                self.push(Kind::Sign('*'), start);
            }
            '∞' => {
                self.at += c.len_utf8();
                self.push(Kind::Word("inf".into()), start);
            }
            c if c.is_alphabetic() || c == '_' => self.word(start),
            _ => {
                let end = start + c.len_utf8();
                return Err(Fault::new(start..end, format!("`{}` has no meaning here", c.escape_debug())));
            }
        }
        Ok(())
    }

    fn number(&mut self, start: usize) -> Result<(), Fault> {
        let mut digits = self.take_while(|c| c.is_ascii_digit() || c == '.');
        if self.decimal_comma
            && self.peek() == Some(',')
            && self.peek_second().is_some_and(|d| d.is_ascii_digit())
        {
            self.at += 1;
            digits = format!("{digits}.{}", self.take_while(|c| c.is_ascii_digit()));
        }
        let significant = digits.trim_start_matches(['0', '.']).chars().filter(|&c| c != '.').count();
        // 1e-3, but not the product 2·e1
        let tail = self.rest();
        if let Some(after) = tail.strip_prefix(['e', 'E']) {
            let sign = after.starts_with(['+', '-']);
            let count = after[usize::from(sign)..].bytes().take_while(u8::is_ascii_digit).count();
            let end = 1 + usize::from(sign) + count;
            let ended = !tail[end..].starts_with(|c: char| c.is_alphanumeric() || c == '_' || c == '.');
            if count > 0 && ended {
                digits.push_str(&tail[..end]);
                self.at += end;
            }
        }
        match Rational::from_decimal(&digits) {
            Some(value) => {
                self.push(Kind::Number(value, significant), start);
                Ok(())
            }
            None => Err(Fault::new(start..self.at, format!("`{digits}` is not a number"))),
        }
    }

    fn command(&mut self, start: usize) -> Result<(), Fault> {
        self.at += 1;
        let name = self.take_while(|c| c.is_ascii_alphabetic());
        match name.as_str() {
            "" => {
                // `\,` and its kin are space
                let Some(c) = self.peek() else { return Err(Fault::new(start..self.at, "a lone `\\`")) };
                self.at += c.len_utf8();
            }
            "cdot" | "times" => self.push(Kind::Sign('*'), start),
            "div" => self.push(Kind::Sign('/'), start),
            "frac" | "dfrac" | "tfrac" | "cfrac" => self.push(Kind::Fraction, start),
            "sqrt" => self.push(Kind::Root, start),
            "circ" | "degree" => self.push(Kind::Degree, start),
            n if SPACE.contains(&n) => {}
            n if LOOKS.contains(&n) => self.open_hidden_group(),
            "deg" | "rad" | "mm" | "cm" | "sin" | "cos" | "tan" | "pm" => self.push(Kind::Word(name), start),
            _ => {
                let base = name.strip_prefix("var").unwrap_or(&name);
                let letter =
                    GREEK.iter().find(|g| g.1 == base || g.1 == base.to_lowercase() && base == "Theta");
                let Some(letter) = letter else {
                    return Err(Fault::new(start..self.at, format!("`\\{name}` is not known in a table")));
                };
                self.named(letter.1.to_string(), start);
            }
        }
        Ok(())
    }

    fn open_hidden_group(&mut self) {
        self.take_while(char::is_whitespace);
        if self.take("{") {
            self.braces.push(false);
        }
    }

    fn word(&mut self, start: usize) {
        let first = self.peek().unwrap_or('_');
        if let Some(letter) = greek(first) {
            self.at += first.len_utf8();
            return self.named(letter.to_string(), start);
        }
        let document = self.document;
        let name = self.take_while(|c| {
            let plain = c.is_alphanumeric() && greek(c).is_none() && subscript(c).is_none();
            plain && c != '²' || c == '_' && !document
        });
        if name.is_empty() {
            // `_` without a letter before it
            self.at += first.len_utf8();
            return self.named(first.to_string(), start);
        }
        if document && name == "oldsymbol" {
            return self.open_hidden_group(); // the scan took `\b` for a control character
        }
        self.named(name, start);
    }

    /// A name with the subscripts that follow it.
    fn named(&mut self, mut name: String, start: usize) {
        let document = self.document;
        loop {
            let spaces = self.rest().chars().take_while(|&c| c == ' ').count();
            if document && self.rest()[spaces..].starts_with(|c| subscript(c).is_some()) {
                self.at += spaces; // a scan writes θ ₂
            }
            if document && self.peek() == Some('_') {
                self.at += 1;
                self.take_while(|c| c == ' ');
                if self.take("{") {
                    let mut depth = 1;
                    let mut inside = String::new();
                    while let Some(c) = self.peek().filter(|_| depth > 0) {
                        self.at += c.len_utf8();
                        depth += i32::from(c == '{') - i32::from(c == '}');
                        inside.push(c);
                    }
                    let plain = ["\\textsf", "\\text", "\\mathrm", "\\mathsf", " extsf", " ext"]; // `\t` lost as a tab
                    let plain = plain.iter().fold(inside, |s, look| s.replace(look, ""));
                    name.extend(plain.chars().filter(|c| c.is_alphanumeric()));
                } else {
                    name.push_str(&self.take_while(char::is_alphanumeric));
                }
            } else if let Some(c) = self.peek().filter(|&c| subscript(c).is_some_and(char::is_alphanumeric)) {
                self.at += c.len_utf8();
                name.extend(subscript(c));
            } else if self.peek().is_some_and(|c| c.is_ascii_digit() || !document && c == '_') {
                name.push_str(&self.take_while(|c| c.is_ascii_alphanumeric() || c == '_' && !document));
            } else {
                break;
            }
        }
        if let Some(index) = name.strip_prefix("heta").filter(|_| document)
            && index.chars().all(|c| c.is_ascii_digit())
        {
            name = format!("theta{index}"); // the scan took `\t` for a tab
        }
        self.push(Kind::Word(name), start);
    }
}
