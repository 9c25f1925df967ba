//! The values of a TOML table, with their places.

use super::closures::Loops;
use super::tree::Branches;
use super::{Cell, Value};
use crate::description::cell::{Place, Style, read_cell};
use crate::description::diagnostic::{Diagnostics, nearest};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// A text being read, and what was found in it.
pub(super) struct Reader<'t> {
    pub text: &'t str,
    pub out: Diagnostics,
    /// What makes the rows a tree, if they are one.
    pub branches: Option<Branches>,
    /// The loops of the tree, if it has some.
    pub loops: Option<Loops>,
}

/// The entries of a table in the order of the text.
pub(super) struct Fields<'a> {
    pub entries: Vec<(&'a str, &'a Spanned<DeValue<'a>>)>,
    keys: Vec<Range<usize>>,
    /// The table's place.
    pub span: Range<usize>,
}

impl<'a> Fields<'a> {
    pub fn new(table: &'a DeTable<'a>, span: Range<usize>) -> Self {
        let mut all: Vec<_> = table.iter().map(|(k, v)| (k.span(), k.get_ref().as_ref(), v)).collect();
        all.sort_by_key(|e| e.0.start);
        let keys = all.iter().map(|e| e.0.clone()).collect();
        Fields { entries: all.into_iter().map(|(_, k, v)| (k, v)).collect(), keys, span }
    }

    pub fn get(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.entries.iter().find(|e| e.0 == key).map(|e| e.1)
    }

    /// The keys and their places.
    pub fn keys(&self) -> impl Iterator<Item = (&'a str, Range<usize>)> {
        self.entries.iter().map(|e| e.0).zip(self.keys.iter().cloned())
    }
}

/// A range of bytes that can be cut out of `text`.
pub(super) fn clamp(text: &str, span: Range<usize>) -> Range<usize> {
    let fit = |mut at: usize| {
        at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let start = fit(span.start);
    start..fit(span.end).max(start)
}

impl Reader<'_> {
    /// Reports the keys that are not among `known`; `hint` knows better than the nearest word.
    pub(crate) fn unknown_keys(
        &mut self,
        fields: &Fields,
        known: &[&str],
        hint: impl Fn(&str) -> Option<String>,
    ) {
        for (key, span) in fields.keys().filter(|(key, _)| !known.contains(key)) {
            let shown: String = key.chars().take(40).collect();
            let hint = hint(key).unwrap_or_else(|| match nearest(key, known.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("known keys: {}", known.join(", ")),
            });
            self.out.error(span, format!("unknown key `{}`", shown.escape_debug())).hint(hint);
        }
    }

    fn wrong_type(&mut self, value: &Spanned<DeValue>, wanted: &str) {
        let found = match value.get_ref() {
            DeValue::String(_) => "text",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "true or false",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        self.out.error(value.span(), format!("{wanted} is expected here, not {found}"));
    }

    pub fn string(&mut self, value: Option<&Spanned<DeValue>>) -> Option<String> {
        let value = value?;
        // Names and sources are single lines wherever they are shown.
        let plain = |text: &str| text.replace(|c: char| c.is_control(), " ");
        let text = value.get_ref().as_str().map(plain);
        if text.is_none() {
            self.wrong_type(value, "text in quotes");
        }
        text
    }

    pub fn table<'a>(&mut self, value: &'a Spanned<DeValue<'a>>, what: &str) -> Option<Fields<'a>> {
        match value.get_ref() {
            DeValue::Table(table) => Some(Fields::new(table, value.span())),
            _ => {
                self.wrong_type(value, &format!("a table [{what}]"));
                None
            }
        }
    }

    pub fn array<'a>(&mut self, value: &'a Spanned<DeValue<'a>>, what: &str) -> Option<&'a DeArray<'a>> {
        match value.get_ref() {
            DeValue::Array(array) => Some(array),
            _ => {
                self.wrong_type(value, &format!("a list for {what}"));
                None
            }
        }
    }

    /// A list of cells, with the length checked.
    pub fn list(
        &mut self,
        value: &Spanned<DeValue>,
        style: &Style,
        what: &str,
        length: usize,
    ) -> Option<Vec<Cell>> {
        let values = self.array(value, what)?;
        if values.len() != length {
            self.out.error(value.span(), format!("{what} has {length} values, not {}", values.len()));
            return None;
        }
        let cells: Vec<Cell> = values.iter().filter_map(|v| self.cell(v, style)).collect();
        (cells.len() == length).then_some(cells)
    }

    /// A cell: a number, or a string with units and formulas.
    pub fn cell(&mut self, value: &Spanned<DeValue>, style: &Style) -> Option<Cell> {
        let read = self.value(value, style)?;
        self.bare_numbers(&read, style.quantity);
        Some(Cell { expr: read.expr, span: value.span(), symbols: read.symbols })
    }

    /// As [`Reader::cell`], with all that is known of it.
    pub fn value(&mut self, value: &Spanned<DeValue>, style: &Style) -> Option<Value> {
        let whole = Place { span: value.span(), start: None };
        match value.get_ref() {
            DeValue::String(text) => {
                let place = Place { start: self.start_of(text, &value.span()), ..whole };
                read_cell(text, &place, style, &mut self.out)
            }
            DeValue::Integer(n) if n.radix() == 10 => read_cell(n.as_str(), &whole, style, &mut self.out),
            DeValue::Integer(n) => match i64::from_str_radix(n.as_str(), n.radix()) {
                Ok(n) => read_cell(&n.to_string(), &whole, style, &mut self.out),
                Err(_) => {
                    self.out.error(value.span(), "the number is too large");
                    None
                }
            },
            DeValue::Float(x) => read_cell(x.as_str(), &whole, style, &mut self.out),
            _ => {
                self.wrong_type(value, "a number or a formula in quotes");
                None
            }
        }
    }

    /// Where the text of a quoted string begins, if it stands in the file as it is.
    fn start_of(&self, string: &str, span: &Range<usize>) -> Option<usize> {
        let raw = self.text.get(span.clone())?;
        let inside = |quote: usize| raw.get(quote..raw.len().saturating_sub(quote).max(quote));
        [1, 3].into_iter().find(|&quote| inside(quote) == Some(string)).map(|quote| span.start + quote)
    }
}
