//! Names of matrices and vectors as people print them: `{}^0T_6`, `T_{06}`, `H_6^3`, `A_1^{-1}`, `⁰T₆`, `R0_3`.

use denavit_symbolic::greek::letter as greek_letter;
use denavit_symbolic::parse::subscript;
use std::ops::Range;

/// A name with what stands around it, brackets and commands that only change its looks left aside.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Name {
    /// The superscript before it.
    pub left: String,
    pub base: String,
    pub sub: String,
    /// The superscript behind it, without `-1` and `T`.
    pub sup: String,
    pub is_inverse: bool,
    pub is_transposed: bool,
    /// What stands in brackets behind it, cut at commas.
    pub arguments: Vec<String>,
    pub span: Range<usize>,
}

impl Name {
    /// The name as a key: without powers and arguments.
    pub fn key(&self) -> String {
        let Name { left, base, sub, sup, .. } = self;
        let mark = |m: &str, s: &str| if s.is_empty() { String::new() } else { format!("{m}{s}") };
        format!("{}{base}{}{}", mark("^", left), mark("_", sub), mark("^", sup))
    }

    /// True for the value with all joints at 0, `T(0)`.
    pub fn is_at_rest(&self) -> bool {
        matches!(&self.arguments[..], [zero] if zero.trim_matches(['{', '}', '\\', ' ']) == "0")
    }

    /// True for a base with nothing around it.
    pub fn is_bare(&self) -> bool {
        self.left.is_empty() && self.sub.is_empty() && self.sup.is_empty() && self.arguments.is_empty()
    }

    /// The name of the inverse, `{}^jT_i` for `{}^iT_j`.
    pub fn backwards(&self) -> Option<Name> {
        let (left, sub) = (self.sub.clone(), self.left.clone());
        (!left.is_empty() && !sub.is_empty()).then(|| Name { left, sub, ..self.clone() })
    }
}

/// A token of a product of matrices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token {
    Name(Name),
    Plus,
    Minus,
    /// `×`, the product of vectors or of matrices.
    Times,
    /// `·`, `*`, `.`
    Dot,
    Open,
    /// A closing bracket, with the power behind it.
    Close {
        is_inverse: bool,
        is_transposed: bool,
    },
    /// `^{-1}` or `^T` at the beginning of a text, behind a matrix.
    Power {
        is_inverse: bool,
        is_transposed: bool,
    },
}

/// Words that are one name, though longer than a letter.
const WORDS: &[&str] = &["Rot", "rot", "Trans", "trans", "RHS", "LHS", "det"];
/// Commands around a name that only change its looks.
const LOOKS: &[&str] = &[
    "mathbf",
    "mathrm",
    "mathit",
    "mathsf",
    "boldsymbol",
    "bm",
    "underline",
    "overline",
    "bar",
    "vec",
    "hat",
    "text",
    "textbf",
    "textrm",
    "operatorname",
    "mathcal",
    "pmb",
    "tilde",
];
/// Commands without meaning here.
const BLANK: &[&str] =
    &["left", "right", "quad", "qquad", "displaystyle", "limits", "big", "Big", "bigl", "bigr"];

/// The plain character of a superscript one.
fn superscript(c: char) -> Option<char> {
    const TABLE: &str = "⁰0¹1²2³3⁴4⁵5⁶6⁷7⁸8⁹9ⁱiʲjⁿnᵏk";
    let mut chars = TABLE.chars().skip_while(|x| *x != c || x.is_ascii());
    chars.next().and_then(|_| chars.next())
}

/// The longest text that is looked at as names.
const MAX_BYTES: usize = 4_000;

/// The tokens of `text[span]`, or `None` if it is no product or sum of names. `is_known` tells names of several
/// letters that the document has defined.
pub(super) fn tokens(text: &str, span: &Range<usize>, is_known: &dyn Fn(&str) -> bool) -> Option<Vec<Token>> {
    let source = text.get(span.clone())?;
    if source.len() > MAX_BYTES {
        return None;
    }
    let chars: Vec<(usize, char)> = source.char_indices().map(|(i, c)| (span.start + i, c)).collect();
    let mut reader = Reader { chars: &chars, end: span.end, at: 0, is_known };
    let mut found = vec![];
    while reader.at < chars.len() {
        reader.token(&mut found)?;
    }
    Some(found)
}

struct Reader<'a> {
    chars: &'a [(usize, char)],
    end: usize,
    at: usize,
    is_known: &'a dyn Fn(&str) -> bool,
}

/// The superscript behind a name, taken apart.
#[derive(Default)]
struct Power {
    rest: String,
    is_inverse: bool,
    is_transposed: bool,
}

impl Reader<'_> {
    fn peek(&self) -> Option<char> {
        self.char(self.at)
    }

    fn char(&self, at: usize) -> Option<char> {
        self.chars.get(at).map(|c| c.1)
    }

    fn place(&self, at: usize) -> usize {
        self.chars.get(at).map_or(self.end, |c| c.0)
    }

    /// The command at a `\`, without moving.
    fn command(&self) -> Option<String> {
        let name: String =
            (self.at + 1..).map_while(|i| self.char(i).filter(char::is_ascii_alphabetic)).collect();
        (self.peek() == Some('\\') && !name.is_empty()).then_some(name)
    }

    /// Moves over blanks and marks of layout.
    fn skip(&mut self) {
        loop {
            match self.peek() {
                Some(c) if c.is_whitespace() || matches!(c, '&' | '~' | '$') => self.at += 1,
                Some('\\') => match self.command() {
                    Some(name) if BLANK.contains(&name.as_str()) => self.at += 1 + name.len(),
                    None if matches!(self.char(self.at + 1), Some(',' | ';' | ':' | '!' | ' ' | '>')) => {
                        self.at += 2;
                    }
                    _ => return,
                },
                Some('{') if self.char(self.at + 1) == Some('}') => self.at += 2,
                _ => return,
            }
        }
    }

    fn token(&mut self, found: &mut Vec<Token>) -> Option<()> {
        self.skip();
        let Some(c) = self.peek() else { return Some(()) };
        let command = self.command();
        let operator = match (c, command.as_deref()) {
            ('+', _) => Some(Token::Plus),
            ('-' | '−' | '–', _) => Some(Token::Minus),
            ('×' | '✕' | '⨯', _) => Some(Token::Times),
            ('·' | '*' | '.' | '⋅' | '∙' | '•' | '∗', _) => Some(Token::Dot),
            ('(' | '[', _) => Some(Token::Open),
            (_, Some("times")) => Some(Token::Times),
            (_, Some("cdot" | "ast" | "bullet" | "circ")) => Some(Token::Dot),
            (_, Some("cdots" | "ldots" | "dots")) => return None,
            _ => None,
        };
        if let Some(token) = operator {
            self.at += command.map_or(1, |n| 1 + n.len());
            found.push(token);
            return Some(());
        }
        if matches!(c, ')' | ']') {
            self.at += 1;
            let Power { is_inverse, is_transposed, rest } = self.superscript()?;
            found.push(Token::Close { is_inverse, is_transposed });
            return rest.is_empty().then_some(());
        }
        if c == '^' && found.is_empty() {
            let start = self.at;
            let Power { is_inverse, is_transposed, rest } = self.superscript()?;
            if rest.is_empty() && (is_inverse || is_transposed) {
                found.push(Token::Power { is_inverse, is_transposed });
                return Some(());
            }
            self.at = start;
        }
        found.push(Token::Name(self.name()?));
        Some(())
    }

    fn name(&mut self) -> Option<Name> {
        let (left, before) = self.left()?;
        let mut name = Name { left, ..Name::default() };
        self.skip();
        let start = self.at;
        let has_brace = self.peek() == Some('{');
        if has_brace {
            // `{R_3^0}^{-1}`: a name in braces with a power behind it.
            self.at += 1;
            let inner = self.name()?;
            self.skip();
            if self.peek() != Some('}') {
                return None;
            }
            self.at += 1;
            name = Name { left: name.left + &inner.left, ..inner };
        } else {
            self.base(&mut name)?;
        }
        self.scripts(&mut name)?;
        if name.sub.is_empty() {
            name.sub = before;
        } else if !before.is_empty() {
            return None;
        }
        name.span = self.place(start)..self.place(self.at);
        Some(name)
    }

    /// The superscript and the subscript before a name: `{}^0T`, `^{j-1}T`, `⁰T`, `0T`, `{}^0_1T`, `{}_1^0T`.
    fn left(&mut self) -> Option<(String, String)> {
        let (mut left, mut below) = (String::new(), String::new());
        loop {
            self.skip();
            match self.peek() {
                Some('^') => {
                    self.at += 1;
                    left.push_str(&self.group()?);
                }
                Some('_') => {
                    self.at += 1;
                    below.push_str(&self.group()?);
                }
                Some(c) if !left.is_empty() && subscript(c).is_some() => {
                    below.extend(subscript(c));
                    self.at += 1;
                }
                Some(c) if superscript(c).is_some() => {
                    left.extend(superscript(c));
                    self.at += 1;
                }
                Some(c) if c.is_ascii_digit() && left.is_empty() => {
                    let digits: String =
                        (self.at..).map_while(|i| self.char(i).filter(char::is_ascii_digit)).collect();
                    let behind = self.char(self.at + digits.len());
                    if !behind.is_some_and(|c| matches!(c, 'T' | 'R' | 'A' | 'H' | 'P' | 'O' | 'M')) {
                        return None;
                    }
                    self.at += digits.len();
                    left = digits;
                }
                _ => return Some((left, below)),
            }
        }
    }

    fn base(&mut self, name: &mut Name) -> Option<()> {
        if let Some(command) = self.command() {
            self.at += 1 + command.len();
            if LOOKS.contains(&command.as_str()) {
                self.skip();
                if self.peek() == Some('{') {
                    let inner = self.group()?;
                    // scripts inside the braces belong to the name
                    let chars: Vec<(usize, char)> = inner.char_indices().collect();
                    let mut reader =
                        Reader { chars: &chars, end: inner.len(), at: 0, is_known: self.is_known };
                    let found = reader.name()?;
                    reader.skip();
                    if reader.at < chars.len() {
                        name.base = inner.chars().filter(|c| c.is_alphanumeric()).collect();
                        return (!name.base.is_empty()).then_some(());
                    }
                    let left = std::mem::take(&mut name.left) + &found.left;
                    *name = Name { left, ..found };
                    return Some(());
                }
                return self.base(name);
            }
            let letter = greek_letter(&command)?;
            name.base = letter.to_string();
            return Some(());
        }
        let first = self.peek().filter(|c| c.is_alphabetic())?;
        let run: String = (self.at..).map_while(|i| self.char(i).filter(|c| c.is_alphabetic())).collect();
        let known = (2..=run.chars().count())
            .rev()
            .map(|n| run.chars().take(n).collect::<String>())
            .find(|word| WORDS.contains(&word.as_str()) || (self.is_known)(word));
        name.base = known.unwrap_or_else(|| first.to_string());
        self.at += name.base.chars().count();
        // `Jv` is J_v.
        if let Some(part) = name.base.strip_prefix('J').filter(|p| p.chars().count() == 1) {
            (name.sub, name.base) = (part.to_string(), "J".to_string());
        }
        Some(())
    }

    /// Sub- and superscripts, digits and brackets behind a name.
    fn scripts(&mut self, name: &mut Name) -> Option<()> {
        loop {
            let before = self.at;
            self.skip_blanks();
            match self.peek() {
                Some('^') if !name.left.is_empty() && !self.is_power() => {
                    // `{}^0T_1^1T_2`: the superscript of the next name.
                    self.at = before;
                    return Some(());
                }
                Some('_') => {
                    self.at += 1;
                    let index = self.group()?;
                    let comma = if name.sub.is_empty() { "" } else { "," };
                    name.sub = format!("{}{comma}{index}", name.sub);
                }
                Some('^') => {
                    let power = self.superscript()?;
                    name.sup.push_str(&power.rest);
                    name.is_inverse ^= power.is_inverse;
                    name.is_transposed ^= power.is_transposed;
                }
                Some(c) if before == self.at && (c.is_ascii_digit() || subscript(c).is_some()) => {
                    name.sub.push(subscript(c).unwrap_or(c));
                    self.at += 1;
                }
                Some('⁻') => {
                    if self.char(self.at + 1) != Some('¹') {
                        return None;
                    }
                    name.is_inverse = !name.is_inverse;
                    self.at += 2;
                }
                Some('ᵀ') => {
                    name.is_transposed = !name.is_transposed;
                    self.at += 1;
                }
                Some('(') if self.takes_arguments(name) => {
                    self.at += 1;
                    name.arguments = self.arguments()?;
                    self.at += 1;
                }
                _ => {
                    self.at = before;
                    return Some(());
                }
            }
        }
    }

    /// True if a superscript begins here that is `-1` or `T`.
    fn is_power(&self) -> bool {
        let inner = (self.at + 1..).map_while(|i| self.char(i).filter(|c| !matches!(c, '}')));
        let plain: String = inner.filter(|c| !matches!(c, '{' | ' ' | '\\')).take(6).collect();
        ["-1", "−1"].iter().any(|p| plain.starts_with(p))
            || matches!(plain.as_str(), "T" | "t" | "top")
            || plain.starts_with('T') && !plain.contains('_')
    }

    /// True if brackets behind a name are its arguments: they hold no matrix and no sum of names.
    fn takes_arguments(&self, name: &Name) -> bool {
        if WORDS.contains(&name.base.as_str()) {
            return true;
        }
        let inner: Vec<char> =
            (self.at + 1..).map_while(|i| self.char(i).filter(|c| *c != ')')).take(41).collect();
        let inner: String = inner.into_iter().collect();
        let plain: String = inner.chars().filter(|c| c.is_alphanumeric() || *c == ',').collect();
        let is_place = plain.split(',').all(|p| p.parse::<usize>().is_ok()) && plain.contains(',');
        // `\Theta` is all joints, as `\theta` and `q` are.
        let plain = [
            "overline",
            "bar",
            "mathbf",
            "bm",
            "vartheta",
            "vec",
            "theta",
            "Theta",
            "boldsymbol",
            "underline",
        ]
        .iter()
        .fold(plain, |p, word| p.replace(word, ""));
        let is_joint = plain.split(',').all(|p| {
            let letters = p.trim_end_matches(|c: char| c.is_ascii_digit());
            matches!(letters, "q" | "Q" | "θ" | "ϑ" | "Θ" | "" | "qi" | "qj" | "qn")
        });
        inner.len() <= 40 && (is_place || is_joint)
    }

    /// The texts between commas up to the closing bracket.
    fn arguments(&mut self) -> Option<Vec<String>> {
        let mut found = vec![String::new()];
        let mut depth = 0_usize;
        loop {
            let c = self.peek()?;
            match c {
                ')' if depth == 0 => break,
                '(' | '{' | '[' => depth += 1,
                ')' | '}' | ']' => depth = depth.checked_sub(1)?,
                _ => {}
            }
            match found.last_mut() {
                Some(last) if c != ',' || depth > 0 => last.push(c),
                _ => found.push(String::new()),
            }
            self.at += 1;
        }
        Some(found.iter().map(|a| a.trim().to_string()).collect())
    }

    /// A superscript at `^`; none is empty.
    fn superscript(&mut self) -> Option<Power> {
        let mut power = Power::default();
        let before = self.at;
        self.skip();
        if self.peek() != Some('^') {
            if let (Some('⁻'), Some('¹')) = (self.peek(), self.char(self.at + 1)) {
                self.at += 2;
                return Some(Power { is_inverse: true, ..power });
            }
            self.at = before;
            return Some(power);
        }
        self.at += 1;
        let group = self.group()?;
        // `0^{-1}` is frame 0 of an inverse.
        let (rest, inner) = match group.split_once('^') {
            Some((rest, inner)) => (rest.to_string(), inner.to_string()),
            None if group == "-1" || matches!(group.as_str(), "T" | "t" | "top") => (String::new(), group),
            None => (group, String::new()),
        };
        power.is_inverse = inner == "-1";
        power.is_transposed = matches!(inner.as_str(), "T" | "t" | "top");
        if !inner.is_empty() && !power.is_inverse && !power.is_transposed {
            return None;
        }
        power.rest = rest;
        Some(power)
    }

    /// What follows `_` or `^`: one character, a command or a group, as plain characters; blanks and braces dropped.
    fn group(&mut self) -> Option<String> {
        self.skip_blanks();
        let mut depth = 0_usize;
        let mut out = String::new();
        loop {
            let c = self.peek()?;
            match c {
                '{' => depth += 1,
                '}' => depth = depth.checked_sub(1)?,
                '\\' => {
                    let name = self.command();
                    match name {
                        Some(name) => {
                            self.at += name.len();
                            match greek_letter(&name) {
                                Some(letter) => out.push(letter),
                                None if LOOKS.contains(&name.as_str()) && depth > 0 => {}
                                None if name == "top" => out.push('T'),
                                None if name == "ell" => out.push('l'),
                                None if BLANK.contains(&name.as_str()) => {}
                                None => return None,
                            }
                        }
                        None => self.at += 1,
                    }
                }
                c if c.is_whitespace() => {}
                '−' | '–' => out.push('-'),
                c => out.push(subscript(c).or(superscript(c)).unwrap_or(c)),
            }
            self.at += 1;
            if depth == 0 {
                return Some(out);
            }
        }
    }

    fn skip_blanks(&mut self) {
        while self.peek().is_some_and(char::is_whitespace) {
            self.at += 1;
        }
    }
}

/// The index of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Index {
    Number(usize),
    /// A letter such as j, and what is added to it: `j-1`.
    Letter(char, i32),
    /// The last frame, or the hand: `n`, `e`, `E`.
    End,
}

impl Index {
    /// True for a letter that stands for any frame.
    pub fn is_letter(&self) -> bool {
        matches!(self, Index::Letter(..))
    }
}

/// `0`, `j-1`, `n`.
pub(super) fn index(text: &str) -> Option<Index> {
    if let Ok(n) = text.parse::<usize>() {
        return (n <= 1_000).then_some(Index::Number(n));
    }
    let mut chars = text.chars();
    let letter = chars.next().filter(|c| c.is_alphabetic())?;
    let rest: &str = chars.as_str();
    match (letter, rest) {
        ('E' | 'e' | 'H' | 'h', "") | ('t', "ool") => Some(Index::End),
        (_, "") => Some(Index::Letter(letter, 0)),
        (_, offset) => {
            let offset: i32 = offset.trim_start_matches('+').parse().ok()?;
            (offset.abs() <= 9).then_some(Index::Letter(letter, offset))
        }
    }
}

/// Two indices that are written together: `06`, `0,6`, `0_6`.
pub(super) fn pair(text: &str) -> Option<(Index, Index)> {
    if let Some((a, b)) = text.split_once([',', '_', '/']) {
        return Some((index(a)?, index(b)?));
    }
    let chars: Vec<char> = text.chars().collect();
    match chars[..] {
        [a, b] if a.is_ascii_alphanumeric() && b.is_ascii_alphanumeric() => {
            Some((index(&a.to_string())?, index(&b.to_string())?))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests;
