//! A text with the marks of LaTeX and Markdown left aside, in which values of joints are looked for: each character with its place.

use denavit_symbolic::greek;
use denavit_symbolic::parse::subscript;
use std::f64::consts::PI;
use std::ops::Range;

/// Commands, and what they are here.
const COMMANDS: [(&str, &str); 24] = [
    ("begin{cases}", " "),
    ("circ", "°"),
    ("degree", "°"),
    ("pi", "π"),
    ("pm", "±"),
    ("in", "∈"),
    ("approx", "="),
    ("left", ""),
    ("right", ""),
    ("text", ""),
    ("mathrm", ""),
    ("mathbf", ""),
    ("operatorname", ""),
    ("mathbb", ""),
    ("quad", " "),
    ("qquad", " "),
    ("lor", " or "),
    ("vee", " or "),
    ("cdot", "*"),
    ("ldots", "…"),
    ("dots", "…"),
    ("frac", "\u{1}"),
    ("tfrac", "\u{1}"),
    ("dfrac", "\u{1}"),
];

/// What the longest words between two values are.
const BETWEEN: [&str; 9] = ["or", "and", "oder", "und", "ou", "et", "o", "y", "/"];

/// A text without marks.
pub(super) struct Flat {
    pub chars: Vec<char>,
    /// Where each of them stands, and the end of the text.
    places: Vec<usize>,
}

/// A value as it is printed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Value {
    pub number: f64,
    /// A unit of the last digit; nothing of what is exact.
    pub digit: f64,
    pub unit: Unit,
    /// A multiple of a whole turn of which it is one of, `k π`: its step.
    pub step: Option<f64>,
}

/// A unit of a value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Unit {
    None,
    Degrees,
    Radians,
    Metres,
    Centimetres,
    Millimetres,
}

impl Flat {
    pub(super) fn of(text: &str) -> Self {
        let mut flat = Flat { chars: vec![], places: vec![] };
        let mut at = 0;
        while let Some(c) = text[at..].chars().next() {
            let rest = &text[at + c.len_utf8()..];
            let (shown, length): (String, usize) = match c {
                '\\' => command(rest),
                // Braces of LaTeX group; indices stand behind their letters.
                '$' | '{' | '}' | '_' | '`' => (String::new(), 0),
                '*' if rest.starts_with('*') => (String::new(), 1),
                '^' if rest.trim_start_matches(['{', '\\', ' ']).starts_with(['T', 't']) => {
                    (String::new(), rest.find(['T', 't']).map_or(0, |k| transposed(rest, k)))
                }
                '^' if rest.trim_start_matches(['{', '\\']).starts_with("circ") => (String::new(), 0),
                '^' if numbered(rest).is_some() => (String::new(), numbered(rest).unwrap_or(0)),
                '−' | '–' => ("-".into(), 0),
                '≈' => ("=".into(), 0),
                'ϑ' => ("θ".into(), 0),
                '\u{200b}' => (String::new(), 0),
                '\u{a0}' | '~' | '\t' => (" ".into(), 0),
                '&' => (",".into(), 0),
                c => (subscript(c).unwrap_or(c).to_string(), 0),
            };
            for c in shown.chars() {
                flat.chars.push(c);
                flat.places.push(at);
            }
            at += c.len_utf8() + length;
        }
        flat.places.push(text.len());
        flat
    }

    /// The place in the text of so many characters.
    pub(super) fn span(&self, range: &Range<usize>) -> Range<usize> {
        self.places[range.start]..self.places[range.end.min(self.places.len() - 1)]
    }

    pub(super) fn get(&self, at: usize) -> char {
        self.chars.get(at).copied().unwrap_or('\n')
    }

    pub(super) fn skip_blanks(&self, mut at: usize) -> usize {
        while self.get(at) == ' ' {
            at += 1;
        }
        at
    }

    fn has(&self, at: usize, word: &str) -> Option<usize> {
        let all: Vec<char> = word.chars().collect();
        (self.chars.get(at..at + all.len())? == all.as_slice()).then(|| at + all.len())
    }

    /// The number of the joint that a name at a place is that of, and where the name ends.
    pub(super) fn joint(&self, at: usize, is_slide: impl Fn(usize) -> bool) -> Option<(usize, usize)> {
        if at > 0 && (self.get(at - 1).is_alphanumeric() || matches!(self.get(at - 1), '\\' | '\'')) {
            return None;
        }
        let words = ["θ", "theta", "th", "q", "d", "r"];
        let (word, end) = words.iter().find_map(|w| Some((*w, self.has(at, w)?)))?;
        let end = self.skip_blanks_of_index(end);
        let number = self.get(end).to_digit(10)? as usize;
        // A letter that counts solutions: `q1a`, `q1b`.
        let end = end + usize::from(matches!(self.get(end + 1), 'a'..='d'));
        if self.get(end + 1).is_alphanumeric() || number == 0 {
            return None;
        }
        let is_known = !matches!(word, "d" | "r") || is_slide(number);
        is_known.then_some((number, end + 1))
    }

    /// Blanks behind a command, as in `\theta 1`.
    fn skip_blanks_of_index(&self, at: usize) -> usize {
        if self.get(at) == ' ' && self.get(at.saturating_sub(1)) == 'θ' { at + 1 } else { at }
    }

    /// A value at a place with its unit, and where it ends; nothing of what goes on as a formula. A comma before a digit may be a decimal one.
    pub(super) fn value(&self, at: usize, has_commas: bool) -> Option<(Value, usize)> {
        let mut at = self.skip_blanks(at);
        let mut sign = 1.0;
        if matches!(self.get(at), '-' | '+') {
            sign = if self.get(at) == '-' { -1.0 } else { 1.0 };
            at = self.skip_blanks(at + 1);
        }
        let start = at;
        // \frac{π}{2} has lost its braces.
        let is_fraction = self.get(at) == '\u{1}';
        at += usize::from(is_fraction);
        let (mut number, mut digit, mut is_any) = (1.0, 0.0, false);
        if let Some((x, of_digit, end)) = self.decimal(at, has_commas) {
            (number, digit, at, is_any) = (x, of_digit, end, true);
        }
        let mut step = false;
        let after = self.skip_blanks(at);
        let after = if self.get(after) == '*' { self.skip_blanks(after + 1) } else { after };
        // A whole number before π has a letter.
        let is_letter = |c: char| matches!(c, 'k' | 'n' | 'm' | 'j' | 'l');
        let before_pi = self.skip_blanks(after + 1);
        let before_pi = if self.get(before_pi) == '*' { self.skip_blanks(before_pi + 1) } else { before_pi };
        let pi = |at: usize| (self.get(at) == 'π').then_some(at + 1).or_else(|| self.has(at, "pi"));
        let mut has_pi = false;
        if let Some(end) = pi(after) {
            (at, has_pi) = (end, true);
        } else if let Some(end) = pi(before_pi).filter(|_| is_letter(self.get(after))) {
            (at, has_pi, step) = (end, true, true);
        }
        if has_pi {
            (number, digit) = (number * PI, 0.0);
            let slash = self.skip_blanks(at);
            let divisor = if is_fraction { Some(at) } else { None };
            let divisor = divisor.or_else(|| (self.get(slash) == '/').then(|| self.skip_blanks(slash + 1)));
            if let Some((x, _, end)) =
                divisor.and_then(|d| self.decimal(d, has_commas)).filter(|d| d.0 != 0.0)
            {
                number /= x;
                at = end;
            }
        } else if !is_any || is_fraction {
            return None;
        }
        if at == start {
            return None;
        }
        let mut unit = if has_pi { Unit::Radians } else { Unit::None };
        let behind = self.skip_blanks(at);
        let units = [
            ("°", Unit::Degrees),
            ("degrees", Unit::Degrees),
            ("deg", Unit::Degrees),
            ("rad", Unit::Radians),
            ("mm", Unit::Millimetres),
            ("cm", Unit::Centimetres),
            ("m", Unit::Metres),
        ];
        if let Some((end, of)) = units.iter().find_map(|(w, u)| Some((self.has(behind, w)?, *u)))
            && !self.get(end).is_alphanumeric()
        {
            (unit, at) = (of, end);
        }
        // What goes on is no value by itself.
        let next = self.skip_blanks(at);
        if matches!(self.get(next), '+' | '*' | '^' | '=' | '(' | '±' | '\\' | '\u{1}')
            || self.get(at).is_alphanumeric()
        {
            return None;
        }
        if self.get(next) == '-' && self.get(next + 1) != '-' && next > at {
            return None;
        }
        Some((Value { number: sign * number, digit, unit, step: step.then_some(number) }, at))
    }

    /// Values behind a sign of equality: those behind the last one of a chain, `= acos(0) = 90°`.
    pub(super) fn result(&self, at: usize) -> (Vec<Value>, usize) {
        const LONGEST: usize = 80;
        let (values, end) = self.values(at);
        if !values.is_empty() {
            return (values, end);
        }
        let (mut depth, mut last) = (0_i32, None);
        for k in at..self.chars.len().min(at + LONGEST) {
            match self.get(k) {
                '(' | '[' => depth += 1,
                ')' | ']' => depth -= 1,
                '=' => last = Some(k + 1),
                ',' | ';' if depth == 0 => break,
                '\n' => break,
                _ => {}
            }
        }
        last.map_or((vec![], at), |last| self.values(last))
    }

    /// A decimal number, a unit of its last digit, and where it ends.
    fn decimal(&self, at: usize, has_commas: bool) -> Option<(f64, f64, usize)> {
        let mut end = at;
        let (mut text, mut places) = (String::new(), None);
        loop {
            let c = self.get(end);
            let is_mark = c == '.' || (c == ',' && has_commas);
            let is_point = is_mark && places.is_none() && self.get(end + 1).is_ascii_digit();
            if c.is_ascii_digit() {
                text.push(c);
                places = places.map(|n| n + 1);
            } else if is_point && !text.is_empty() {
                text.push('.');
                places = Some(0);
            } else {
                break;
            }
            end += 1;
        }
        let x: f64 = text.parse().ok()?;
        Some((x, 10f64.powi(-places.unwrap_or(0)), end))
    }

    /// So many values in brackets, of which the first is at a place, and where these end.
    pub(super) fn tuple(&self, at: usize, count: usize) -> Option<(Vec<Value>, usize)> {
        if !matches!(self.get(at), '(' | '[') {
            return None;
        }
        // A comma parts values where that gives so many, or else is a decimal one.
        [false, true].into_iter().find_map(|has_commas| {
            let (mut found, mut at) = (vec![], at + 1);
            loop {
                while matches!(self.get(at), ' ' | ',' | ';' | '\n') && at < self.chars.len() {
                    at += 1;
                }
                if matches!(self.get(at), ')' | ']') {
                    return (found.len() == count).then_some((found, at + 1));
                }
                let (value, end) = self.value(at, has_commas).filter(|_| found.len() < count)?;
                found.push(value);
                at = end;
            }
        })
    }

    /// Values one behind the other, and where they end: `75°, -105°`, `0 or π`.
    pub(super) fn values(&self, at: usize) -> (Vec<Value>, usize) {
        let (mut found, mut end) = (vec![], at);
        let mut at = self.skip_blanks(at);
        let is_set = matches!(self.get(at), '[' | '(');
        at += usize::from(is_set);
        if self.get(self.skip_blanks(at)) == '±'
            && let Some((v, next)) = self.value(self.skip_blanks(at) + 1, !is_set)
        {
            return (vec![v, Value { number: -v.number, ..v }], next);
        }
        while let Some((value, next)) = self.value(at, !is_set) {
            found.push(value);
            end = next;
            let mut next = self.skip_blanks(next);
            let is_comma = matches!(self.get(next), ',' | ';');
            next = self.skip_blanks(next + usize::from(is_comma));
            let word = BETWEEN.iter().find_map(|w| self.has(next, w).filter(|e| self.get(*e) == ' '));
            match word {
                Some(behind) => at = behind,
                None if is_comma => at = next,
                None => break,
            }
        }
        if is_set && matches!(self.get(self.skip_blanks(end)), ']' | ')') {
            end = self.skip_blanks(end) + 1;
        }
        (found, end)
    }
}

/// What a command is, and how many bytes of the rest belong to it.
fn command(rest: &str) -> (String, usize) {
    match rest.chars().next() {
        Some('{') => return ("[".into(), 1),
        Some('}') => return ("]".into(), 1),
        Some('\\') => return (",\n".into(), 1),
        Some(',' | ';' | '!' | ':' | ' ') => return (" ".into(), 1),
        _ => {}
    }
    let length = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
    let word = &rest[..length];
    if word == "begin" || word == "end" {
        let inner = rest[length..].find('}').map_or(0, |k| k + 1);
        let is_matrix = rest[length..length + inner].contains("matrix");
        let shown = match (is_matrix, word) {
            (true, "begin") => "(",
            (true, _) => ")",
            _ => " ",
        };
        return (shown.into(), length + inner);
    }
    if let Some((_, shown)) = COMMANDS.iter().find(|(w, _)| *w == word) {
        return ((*shown).into(), length);
    }
    let letter = match word {
        "vartheta" => Some('θ'),
        _ => ('α'..='ω').find(|c| greek::name(*c) == Some(word)),
    };
    match letter {
        Some(letter) => (letter.to_string(), length),
        None => ("\\".into(), 0),
    }
}

/// How many bytes of `{(2)}` tell which solution it is.
fn numbered(rest: &str) -> Option<usize> {
    let open = rest.strip_prefix('{').unwrap_or(rest);
    let inner = open.strip_prefix('(')?;
    let end = inner.find(|c: char| !c.is_ascii_alphanumeric()).filter(|k| (1..=2).contains(k))?;
    let closed = inner[end..].strip_prefix(')')?;
    let closed = closed.strip_prefix('}').unwrap_or(closed);
    Some(rest.len() - closed.len())
}

/// How many bytes of `T}` or `\top}` belong to a sign of transposition.
fn transposed(rest: &str, at: usize) -> usize {
    let behind = rest[at..].find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len() - at);
    at + behind
}
