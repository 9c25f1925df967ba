//! The part of YAML that files beside robot descriptions have: maps and lists, by indentation or in brackets, and scalars, exactly.
//!
//! Scalars are what YAML 1.1 takes them for; `!degrees`, `!radians`, `!meters`, `!millimeters`, `!foot` and `!inches` are an
//! expression and its unit. Anchors, other tags, texts over several lines and several documents are refused, with their place.

use super::expression::{Asked, evaluate};
use super::value::{Fault, Val, arithmetic};
use crate::description::xml::shown;
use denavit_symbolic::{Expr, Rational};
use std::ops::Range;
use std::rc::Rc;

/// How deep values may stand in each other, and how many there may be.
const MAX_DEPTH: usize = 60;
const MAX_VALUES: usize = 100_000;

/// A line, or what of one is not read yet.
struct Line<'t> {
    indent: usize,
    text: &'t str,
}

/// A text being read.
struct Reader<'t> {
    whole: &'t str,
    /// Where the text begins in all that is read.
    start: usize,
    lines: Vec<Line<'t>>,
    next: usize,
    values: usize,
}

/// What a text holds that begins at byte `start` of all that is read.
pub(super) fn read(text: &str, start: usize) -> Result<Val, Fault> {
    let mut reader = Reader { whole: text, start, lines: vec![], next: 0, values: 0 };
    reader.split()?;
    if reader.lines.is_empty() {
        return Ok(nothing());
    }
    let value = reader.block(0, 0)?;
    match reader.lines.get(reader.next) {
        None => Ok(value),
        Some(line) => Err(reader.fault("this stands further left than what it belongs to", line.text)),
    }
}

fn nothing() -> Val {
    Val::Text("None".into())
}

impl<'t> Reader<'t> {
    fn fault(&self, message: impl Into<String>, at: &str) -> Fault {
        Fault::new(message).at(self.place(at))
    }

    /// Where a part of the text stands.
    fn place(&self, part: &str) -> Range<usize> {
        let from = self.start + (part.as_ptr() as usize - self.whole.as_ptr() as usize);
        from..from + part.len()
    }

    /// The lines that say something.
    fn split(&mut self) -> Result<(), Fault> {
        for line in self.whole.lines() {
            let text = without_comment(line).trim_end();
            let inner = text.trim_start_matches(' ');
            if inner.trim().is_empty() {
                continue;
            }
            if inner.starts_with('\t') {
                return Err(self.fault("a tab where the line begins", inner).hint("indent with blanks"));
            }
            match text {
                "---" if self.lines.is_empty() => continue,
                "---" => return Err(self.fault("a second document is not read", inner)),
                "..." => break,
                _ if text.starts_with('%') => continue,
                _ => self.lines.push(Line { indent: text.len() - inner.len(), text: inner }),
            }
        }
        Ok(())
    }

    fn count(&mut self, depth: usize, at: &str) -> Result<(), Fault> {
        self.values += 1;
        if self.values > MAX_VALUES {
            return Err(self.fault(format!("more than {MAX_VALUES} values"), at));
        }
        if depth > MAX_DEPTH {
            return Err(self.fault(format!("values stand in values more than {MAX_DEPTH} deep"), at));
        }
        Ok(())
    }

    /// What stands from the next line on, at its indentation; nothing if that is less than `least`.
    fn block(&mut self, least: usize, depth: usize) -> Result<Val, Fault> {
        let Some(&Line { indent, text }) = self.lines.get(self.next).filter(|l| l.indent >= least) else {
            return Ok(nothing());
        };
        self.count(depth, text)?;
        if item(text).is_some() {
            return self.list(indent, depth);
        }
        if key(text).is_some() {
            return self.map(indent, depth);
        }
        self.next += 1;
        self.scalar_or_flow(text, depth)
    }

    fn list(&mut self, indent: usize, depth: usize) -> Result<Val, Fault> {
        let mut all = vec![];
        while let Some(line) = self.lines.get(self.next).filter(|l| l.indent == indent) {
            let Some(rest) = item(line.text) else { break };
            if rest.is_empty() {
                self.next += 1;
                all.push(self.block(indent + 1, depth + 1)?);
            } else {
                // What stands behind the dash begins a block of its own.
                let moved = indent + line.text.len() - rest.len();
                self.lines[self.next] = Line { indent: moved, text: rest };
                all.push(self.block(moved, depth + 1)?);
            }
            self.ends(indent)?;
        }
        Ok(Val::List(Rc::new(all)))
    }

    fn map(&mut self, indent: usize, depth: usize) -> Result<Val, Fault> {
        let mut all: Vec<(String, Val)> = vec![];
        while let Some(&Line { indent: at, text }) = self.lines.get(self.next) {
            let Some((name, rest)) = key(text).filter(|_| at == indent && item(text).is_none()) else {
                break;
            };
            self.next += 1;
            let name = match self.scalar(name)? {
                Val::Text(name) => name,
                other => other.show(),
            };
            let value = if rest.is_empty() {
                // A list may stand as far left as its name.
                let is_list =
                    self.lines.get(self.next).is_some_and(|l| l.indent == indent && item(l.text).is_some());
                self.block(if is_list { indent } else { indent + 1 }, depth + 1)?
            } else {
                self.count(depth + 1, rest)?;
                self.scalar_or_flow(rest, depth + 1)?
            };
            // The last one of a name counts.
            all.retain(|e| e.0 != name);
            all.push((name, value));
            self.ends(indent)?;
        }
        Ok(Val::Map(Rc::new(all)))
    }

    /// What follows an entry stands no further right than its entry began.
    fn ends(&self, indent: usize) -> Result<(), Fault> {
        match self.lines.get(self.next).filter(|l| l.indent > indent) {
            None => Ok(()),
            Some(line) => Err(self
                .fault("this belongs to nothing above it", line.text)
                .hint("values over several lines are not read; write each on one line")),
        }
    }

    /// A value on its line; one in brackets may go on on the next ones.
    fn scalar_or_flow(&mut self, text: &'t str, depth: usize) -> Result<Val, Fault> {
        if !text.starts_with(['[', '{']) {
            return self.scalar(text);
        }
        let mut rest = text;
        let value = self.flow(&mut rest, depth)?;
        match rest.is_empty() {
            true => Ok(value),
            false => Err(self.fault("this stands behind a closed bracket", rest)),
        }
    }

    /// Goes on on the next line where this one ends, in the bracket that opens `from`.
    fn more(&mut self, rest: &mut &'t str, from: &str) -> Result<(), Fault> {
        *rest = rest.trim_start();
        if rest.is_empty() {
            let line = self.lines.get(self.next);
            *rest = line.ok_or_else(|| self.fault("a bracket that is not closed", &from[..1]))?.text;
            self.next += 1;
        }
        Ok(())
    }

    /// `[a, b]`, `{a: b}` or a scalar between commas.
    fn flow(&mut self, rest: &mut &'t str, depth: usize) -> Result<Val, Fault> {
        self.count(depth, rest)?;
        let from = *rest;
        if let Some(inner) = rest.strip_prefix('[') {
            *rest = inner;
            let mut all = vec![];
            loop {
                self.more(rest, from)?;
                if let Some(behind) = rest.strip_prefix(']') {
                    *rest = behind.trim_start();
                    return Ok(Val::List(Rc::new(all)));
                }
                all.push(self.flow(rest, depth + 1)?);
                self.comma(rest, ']', from)?;
            }
        }
        if let Some(inner) = rest.strip_prefix('{') {
            *rest = inner;
            let mut all: Vec<(String, Val)> = vec![];
            loop {
                self.more(rest, from)?;
                if let Some(behind) = rest.strip_prefix('}') {
                    *rest = behind.trim_start();
                    return Ok(Val::Map(Rc::new(all)));
                }
                let at = *rest;
                let name = self.scalar(flow_scalar(rest, true))?.show();
                self.more(rest, from)?;
                *rest = rest.strip_prefix(':').ok_or_else(|| self.fault("`:` is missing", at))?;
                self.more(rest, from)?;
                let value = self.flow(rest, depth + 1)?;
                all.retain(|e| e.0 != name);
                all.push((name, value));
                self.comma(rest, '}', from)?;
            }
        }
        let scalar = flow_scalar(rest, false);
        if scalar.is_empty() {
            return Err(self.fault("a value is missing", rest));
        }
        self.scalar(scalar)
    }

    fn comma(&mut self, rest: &mut &'t str, close: char, from: &str) -> Result<(), Fault> {
        self.more(rest, from)?;
        match rest.strip_prefix(',') {
            Some(behind) => *rest = behind,
            None if rest.starts_with(close) => {}
            None => return Err(self.fault("a comma is missing", rest)),
        }
        Ok(())
    }

    fn scalar(&self, text: &str) -> Result<Val, Fault> {
        let text = text.trim();
        if let Some(tagged) = text.strip_prefix('!') {
            let (tag, value) = tagged.split_once(char::is_whitespace).unwrap_or((tagged, ""));
            return self.with_unit(tag, unquoted(value.trim()).as_deref().unwrap_or(value), text);
        }
        if text.starts_with(['&', '*', '|', '>', '@', '`']) {
            return Err(self
                .fault(format!("`{}` is not read", shown(&text[..1])), text)
                .hint("anchors and texts over several lines are not read"));
        }
        if text.starts_with(['\'', '"']) {
            let inner = unquoted(text).ok_or_else(|| self.fault("a quote that is not closed", text))?;
            return Ok(Val::Text(inner));
        }
        Ok(match text {
            "" | "~" | "null" | "Null" | "NULL" => nothing(),
            "true" | "True" | "TRUE" | "yes" | "Yes" | "YES" | "on" | "On" | "ON" => Val::Truth(true),
            "false" | "False" | "FALSE" | "no" | "No" | "NO" | "off" | "Off" | "OFF" => Val::Truth(false),
            _ => number(text).map_or_else(|| Val::Text(text.into()), |x| Val::Number(x.into())),
        })
    }

    /// An expression in a unit.
    fn with_unit(&self, tag: &str, text: &str, at: &str) -> Result<Val, Fault> {
        let unit = match tag {
            "radians" | "meters" => Expr::int(1),
            "degrees" => Expr::pi() * Expr::from(Rational::new(1, 180)),
            "millimeters" => Rational::new(1, 1000).into(),
            "foot" => Rational::new(3048, 10_000).into(),
            "inches" => Rational::new(254, 10_000).into(),
            other => return Err(self.fault(format!("the tag `!{}` is not read", shown(other)), at)),
        };
        let value = evaluate(text, &mut |asked| match asked {
            Asked::Name("pi") => Ok(Val::Number(Expr::pi())),
            Asked::Name(name) => Err(Fault::new(format!("`{}` is not defined", shown(name)))),
            _ => Err(Fault::new("this is not read here")),
        });
        let value = value.and_then(|v| arithmetic("*", &v, &Val::Number(unit)));
        value.map_err(|fault| fault.at(self.place(at)))
    }
}

/// What stands behind the dash of an entry of a list.
fn item(text: &str) -> Option<&str> {
    let rest = text.strip_prefix('-')?;
    (rest.is_empty() || rest.starts_with([' ', '\t'])).then(|| rest.trim_start())
}

/// The name that a line begins with, and what stands behind its colon.
fn key(text: &str) -> Option<(&str, &str)> {
    let mut quote = None;
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (Some(q), c) if q == c => quote = None,
            (Some(_), _) => {}
            (None, '\'' | '"') if at == 0 => quote = Some(c),
            (None, '[' | '{') if at == 0 => return None,
            (None, ':') => {
                let rest = &text[at + 1..];
                if rest.is_empty() || rest.starts_with([' ', '\t']) {
                    return Some((&text[..at], rest.trim_start()));
                }
            }
            _ => {}
        }
    }
    None
}

/// The scalar that a text between brackets begins with, which is taken off.
fn flow_scalar<'t>(rest: &mut &'t str, is_name: bool) -> &'t str {
    let mut quote = None;
    let mut end = rest.len();
    for (at, c) in rest.char_indices() {
        match (quote, c) {
            (Some(q), c) if q == c => quote = None,
            (Some(_), _) => {}
            (None, '\'' | '"') if rest[..at].trim().is_empty() => quote = Some(c),
            (None, ',' | ']' | '}' | '[' | '{') => end = at,
            (None, ':') if is_name => end = at,
            _ => {}
        }
        if end == at {
            break;
        }
    }
    let (scalar, behind) = rest.split_at(end);
    *rest = behind;
    scalar
}

/// The text between quotes: `''` in single ones is one, and a backslash in double ones says what follows it.
fn unquoted(text: &str) -> Option<String> {
    if let Some(inner) = text.strip_prefix('\'').and_then(|t| t.strip_suffix('\'')) {
        return Some(inner.replace("''", "'"));
    }
    let inner = text.strip_prefix('"').and_then(|t| t.strip_suffix('"'))?;
    let mut plain = String::new();
    let mut letters = inner.chars();
    while let Some(c) = letters.next() {
        plain.push(match c {
            '\\' => match letters.next()? {
                'n' => '\n',
                't' => '\t',
                other => other,
            },
            c => c,
        });
    }
    Some(plain)
}

/// A line up to the `#` of a comment, which stands behind a blank and in no quotes.
fn without_comment(line: &str) -> &str {
    let (mut quote, mut before) = (None, ' ');
    for (at, c) in line.char_indices() {
        match (quote, c) {
            (Some(q), c) if q == c => quote = None,
            (Some(_), _) => {}
            (None, '#') if before.is_whitespace() => return &line[..at],
            (None, '\'' | '"') if matches!(before, ' ' | '\t' | ',' | '[' | '{' | ':') => quote = Some(c),
            _ => {}
        }
        before = c;
    }
    line
}

/// A number as YAML 1.1 has them: decimals, `0x1f`, and octal numbers behind a zero; `1_000` has a line between its digits.
fn number(text: &str) -> Option<Rational> {
    let (sign, digits) = match text.strip_prefix(['-', '+']) {
        Some(rest) => (if text.starts_with('-') { -1 } else { 1 }, rest),
        None => (1, text),
    };
    if !digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return None;
    }
    let plain = digits.replace('_', "");
    let in_base = |digits: &str, base: u32| {
        let value = i64::from_str_radix(digits, base).ok()?;
        Some(Rational::from(sign * value))
    };
    if let Some(hex) = plain.strip_prefix("0x") {
        return in_base(hex, 16);
    }
    if plain.len() > 1 && plain.starts_with('0') && plain.bytes().all(|b| b.is_ascii_digit()) {
        return in_base(&plain[1..], 8);
    }
    let x = Rational::from_decimal(&plain)?;
    Some(if sign < 0 { -x } else { x })
}
