//! YAML beside robot descriptions: maps, lists and scalars, exactly.
//!
//! Scalars are what YAML 1.1 takes them for; `!degrees`, `!radians`, `!meters`, `!millimeters`, `!foot` and `!inches` are an
//! expression and its unit. Other tags than YAML's own, and several documents, are refused, with their place.

use super::expression::{Asked, evaluate};
use super::value::{Fault, Val, arithmetic};
use crate::description::xml::shown;
use denavit_symbolic::{Expr, Rational};
use saphyr_parser::{Event, Marker, Parser, ScalarStyle, Span, Tag};
use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

/// How deep values may stand in each other, and how many there may be, what anchors repeat included.
const MAX_DEPTH: usize = 60;
const MAX_VALUES: usize = 100_000;

/// The name under which a map takes over the entries of others.
const MERGE: &str = "<<";

/// A text being read.
struct Reader<'t> {
    whole: &'t str,
    /// Where the text begins in all that is read.
    start: usize,
    values: usize,
    /// The values with anchors, and of how many each consists.
    anchors: HashMap<usize, (Val, usize)>,
    open: Vec<Open>,
}

/// A list or map being read.
struct Open {
    kind: Kind,
    anchor: usize,
    /// How many values were read before it.
    before: usize,
}

enum Kind {
    List(Vec<Val>),
    Map(Entries, Option<String>),
}

/// The entries of a map: the last one of a name counts, and any one before those that are taken over.
#[derive(Default)]
struct Entries {
    all: Vec<(String, Val)>,
    places: HashMap<String, usize>,
    merged: Vec<Rc<Vec<(String, Val)>>>,
}

/// What a text holds that begins at byte `start` of all that is read.
pub(super) fn read(text: &str, start: usize) -> Result<Val, Fault> {
    let mut reader = Reader { whole: text, start, values: 0, anchors: HashMap::new(), open: vec![] };
    let mut whole = None;
    let mut documents = 0;
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|why| {
            let at = reader.byte(why.marker());
            Fault::new(format!("not YAML: {}", why.info())).at(at..at)
        })?;
        if matches!(event, Event::DocumentStart(_)) {
            documents += 1;
            if documents > 1 {
                return Err(reader.fault("a second document is not read", &span));
            }
        }
        if let Some(value) = reader.event(event, &span)? {
            whole = Some(value);
        }
    }
    Ok(whole.unwrap_or_else(nothing))
}

fn nothing() -> Val {
    Val::Text("None".into())
}

impl Reader<'_> {
    fn fault(&self, message: impl Into<String>, span: &Span) -> Fault {
        Fault::new(message).at(self.place(span))
    }

    fn byte(&self, marker: &Marker) -> usize {
        self.start + self.whole.char_indices().nth(marker.index()).map_or(self.whole.len(), |c| c.0)
    }

    fn place(&self, span: &Span) -> Range<usize> {
        self.byte(&span.start)..self.byte(&span.end)
    }

    fn count(&mut self, values: usize, span: &Span) -> Result<(), Fault> {
        self.values += values;
        if self.values > MAX_VALUES {
            return Err(self.fault(format!("more than {MAX_VALUES} values"), span));
        }
        if self.open.len() > MAX_DEPTH {
            return Err(self.fault(format!("values stand in values more than {MAX_DEPTH} deep"), span));
        }
        Ok(())
    }

    /// What an event ends that stands in nothing else.
    fn event(&mut self, event: Event, span: &Span) -> Result<Option<Val>, Fault> {
        let (value, anchor, before) = match event {
            Event::Scalar(text, style, anchor, tag) => {
                let before = self.values;
                self.count(1, span)?;
                let is_name = matches!(self.open.last(), Some(Open { kind: Kind::Map(_, None), .. }));
                let value = match is_name && style == ScalarStyle::Plain && text == MERGE {
                    true => Val::Text(text.into()),
                    false => self.scalar(&text, style, tag.as_deref(), span)?,
                };
                (value, anchor, before)
            }
            Event::Alias(anchor) => {
                let unknown = || self.fault("this anchor stands for what it stands in", span);
                let (value, size) = self.anchors.get(&anchor).cloned().ok_or_else(unknown)?;
                self.count(size, span)?;
                (value, 0, 0)
            }
            Event::SequenceStart(anchor, tag) => {
                return self.opens(Kind::List(vec![]), anchor, tag.as_deref(), span);
            }
            Event::MappingStart(anchor, tag) => {
                return self.opens(Kind::Map(Entries::default(), None), anchor, tag.as_deref(), span);
            }
            Event::SequenceEnd | Event::MappingEnd => {
                let Some(Open { kind, anchor, before }) = self.open.pop() else { return Ok(None) };
                let value = match kind {
                    Kind::List(all) => Val::List(Rc::new(all)),
                    Kind::Map(entries, _) => Val::Map(Rc::new(entries.closed())),
                };
                (value, anchor, before)
            }
            Event::Nothing
            | Event::StreamStart
            | Event::StreamEnd
            | Event::DocumentStart(_)
            | Event::DocumentEnd => return Ok(None),
        };
        if anchor > 0 {
            self.anchors.insert(anchor, (value.clone(), self.values - before));
        }
        self.give(value, span)
    }

    fn opens(
        &mut self,
        kind: Kind,
        anchor: usize,
        tag: Option<&Tag>,
        span: &Span,
    ) -> Result<Option<Val>, Fault> {
        if let Some(tag) = tag.filter(|t| !t.is_yaml_core_schema()) {
            return Err(self.unknown_tag(tag, span));
        }
        self.open.push(Open { kind, anchor, before: self.values });
        self.count(1, span)?;
        Ok(None)
    }

    /// Puts a value where it belongs.
    fn give(&mut self, value: Val, span: &Span) -> Result<Option<Val>, Fault> {
        let unfit = match self.open.last_mut().map(|o| &mut o.kind) {
            None => return Ok(Some(value)),
            Some(Kind::List(all)) => {
                all.push(value);
                return Ok(None);
            }
            Some(Kind::Map(_, name @ None)) if !matches!(value, Val::List(_) | Val::Map(_)) => {
                *name = Some(value.show());
                return Ok(None);
            }
            Some(Kind::Map(_, None)) => "a name that is a list or a map is not read",
            Some(Kind::Map(entries, name)) => match name.take() {
                Some(name) if name == MERGE => match entries.merge(&value) {
                    true => return Ok(None),
                    false => "`<<` takes a map, or a list of maps",
                },
                name => {
                    entries.set(name.unwrap_or_default(), value);
                    return Ok(None);
                }
            },
        };
        Err(self.fault(unfit, span))
    }

    fn unknown_tag(&self, tag: &Tag, span: &Span) -> Fault {
        let name = format!("{}{}", tag.handle, tag.suffix);
        self.fault(format!("the tag `{}` is not read", shown(&name)), span)
    }

    fn scalar(&self, text: &str, style: ScalarStyle, tag: Option<&Tag>, span: &Span) -> Result<Val, Fault> {
        match tag {
            None if style == ScalarStyle::Plain => Ok(plain(text)),
            None => Ok(Val::Text(text.into())),
            Some(tag) if tag.is_yaml_core_schema() && tag.suffix == "str" => Ok(Val::Text(text.into())),
            Some(tag) if tag.is_yaml_core_schema() => Ok(plain(text)),
            Some(tag) if tag.handle == "!" && tag.suffix.is_empty() => Ok(Val::Text(text.into())),
            Some(tag) => self.with_unit(tag, text, span),
        }
    }

    /// An expression in a unit.
    fn with_unit(&self, tag: &Tag, text: &str, span: &Span) -> Result<Val, Fault> {
        let unit = match tag.suffix.as_str() {
            _ if tag.handle != "!" => return Err(self.unknown_tag(tag, span)),
            "radians" | "meters" => Expr::int(1),
            "degrees" => Expr::pi() * Expr::from(Rational::new(1, 180)),
            "millimeters" => Rational::new(1, 1000).into(),
            "foot" => Rational::new(3048, 10_000).into(),
            "inches" => Rational::new(254, 10_000).into(),
            _ => return Err(self.unknown_tag(tag, span)),
        };
        let value = evaluate(text, &mut |asked| match asked {
            Asked::Name("pi") => Ok(Val::Number(Expr::pi())),
            Asked::Name(name) => Err(Fault::new(format!("`{}` is not defined", shown(name)))),
            _ => Err(Fault::new("this is not read here")),
        });
        let value = value.and_then(|v| arithmetic("*", &v, &Val::Number(unit)));
        value.map_err(|fault| fault.at(self.place(span)))
    }
}

impl Entries {
    fn set(&mut self, name: String, value: Val) {
        match self.places.get(&name) {
            Some(&at) => self.all[at].1 = value,
            None => {
                self.places.insert(name.clone(), self.all.len());
                self.all.push((name, value));
            }
        }
    }

    /// Keeps the entries that are taken over; false for what has none.
    fn merge(&mut self, value: &Val) -> bool {
        match value {
            Val::Map(entries) => self.merged.push(entries.clone()),
            Val::List(maps) => {
                for map in maps.iter() {
                    let Val::Map(entries) = map else { return false };
                    self.merged.push(entries.clone());
                }
            }
            _ => return false,
        }
        true
    }

    /// All entries: what stands in the map itself counts, then what was taken over first.
    fn closed(mut self) -> Vec<(String, Val)> {
        for entries in std::mem::take(&mut self.merged) {
            for (name, value) in entries.iter() {
                if !self.places.contains_key(name) {
                    self.set(name.clone(), value.clone());
                }
            }
        }
        self.all
    }
}

/// A scalar without quotes.
fn plain(text: &str) -> Val {
    match text {
        "" | "~" | "null" | "Null" | "NULL" => nothing(),
        "true" | "True" | "TRUE" | "yes" | "Yes" | "YES" | "on" | "On" | "ON" => Val::Truth(true),
        "false" | "False" | "FALSE" | "no" | "No" | "NO" | "off" | "Off" | "OFF" => Val::Truth(false),
        _ => number(text).map_or_else(|| Val::Text(text.into()), |x| Val::Number(x.into())),
    }
}

/// A number as YAML 1.1 has them: decimals, `0x1f`, octal numbers behind a zero, and `1:30` to the base of 60; `1_000` has a line
/// between its digits.
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
    let x = match plain.contains(':') {
        true => sixties(&plain)?,
        false => Rational::from_decimal(&plain)?,
    };
    Some(if sign < 0 { -x } else { x })
}

/// `1:30` is 90, `1:30.5` is 90.5.
fn sixties(text: &str) -> Option<Rational> {
    let mut parts = text.split(':');
    let first = parts.next().filter(|p| !p.is_empty() && p.bytes().all(|b| b.is_ascii_digit()))?;
    let mut sum = Rational::from_decimal(first)?;
    let mut parts = parts.peekable();
    while let Some(part) = parts.next() {
        let (whole, fraction) = part.split_once('.').unwrap_or((part, ""));
        let is_last = parts.peek().is_none();
        let is_digits = |t: &str| t.bytes().all(|b| b.is_ascii_digit());
        let fits = (1..=2).contains(&whole.len()) && is_digits(whole) && is_digits(fraction);
        if !fits || whole.len() == 2 && whole > "59" || part.contains('.') && !is_last {
            return None;
        }
        sum = sum * Rational::from(60) + Rational::from_decimal(part.trim_end_matches('.'))?;
    }
    Some(sum)
}
