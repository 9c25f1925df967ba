//! Lines of the text around a table: what the table does not say, values of symbols, headings.

use super::find::{GridCell, lines};
use super::layout::Layout;
use crate::description::cell::name_of;
use crate::description::diagnostic::{Diagnostics, line_column};
use std::ops::Range;

const KEYS: &[&str] = &["convention", "columns", "angles", "lengths", "name"];

/// So many lines with several names are looked at.
const MAX_BESIDE: usize = 200;
/// The most names of a line that are kept.
const MAX_NAMES: usize = 20;

/// `key: value`
struct Directive {
    key: String,
    value: GridCell,
}

/// All that was found.
pub(super) struct Lines {
    directives: Vec<Directive>,
    /// `D3 = 450 mm`: the plain name and the text of the value.
    pub values: Vec<(String, GridCell)>,
    /// Names that one line gives values, or formulas.
    beside: Vec<Vec<String>>,
    headings: Vec<GridCell>,
}

/// Where the lines stand that speak of a table.
pub(super) struct Around {
    /// Directives: behind the table before it, and below it if it is the last one.
    pub directives: Range<usize>,
    /// The tables themselves, where rows may be told by names with values.
    pub tables: Vec<Range<usize>>,
    /// What no other table has next to it.
    pub own: Range<usize>,
    /// From the table before it to the table behind it.
    pub neighbours: Range<usize>,
}

impl Around {
    /// The surroundings of the chosen tables among all tables of a text of `length` bytes.
    pub fn of(chosen: &[&Layout], all: &[Layout], length: usize) -> Self {
        let start = chosen.iter().map(|l| l.span.start).min().unwrap_or(0);
        let end = chosen.iter().map(|l| l.span.end).max().unwrap_or(length);
        let before = all.iter().map(|l| l.span.end).filter(|&e| e <= start).max();
        let behind = all.iter().map(|l| l.span.start).filter(|&s| s >= end).min();
        let below = if behind.is_some() { end } else { length };
        Around {
            tables: chosen.iter().map(|l| l.span.clone()).collect(),
            directives: before.unwrap_or(0)..below,
            own: before.map_or(0, |_| start)..below,
            neighbours: before.unwrap_or(0)..behind.unwrap_or(length),
        }
    }
}

impl Lines {
    pub fn of(text: &str) -> Self {
        let mut found = Lines { directives: vec![], values: vec![], beside: vec![], headings: vec![] };
        for span in lines(text) {
            let line = &text[span.clone()];
            if line.len() > 1000 {
                continue;
            }
            found.directive(text, &span);
            found.heading(text, &span);
            if line.contains('=') && !line.contains('&') && !line.contains("\\begin") {
                found.equations(text, span);
            }
        }
        found
    }

    /// The value of a key: the last one before byte `at`, else the first.
    pub fn get(&self, key: &str, at: usize) -> Option<&GridCell> {
        let mut all = self.directives.iter().filter(|d| d.key == key);
        let before = all.clone().take_while(|d| d.value.span.start < at).last();
        before.or_else(|| all.next()).map(|d| &d.value)
    }

    /// Reports lines in `range` that tell a key two things; `settled` keys are told by an option.
    pub fn check(&self, text: &str, range: &Range<usize>, settled: &[&str], out: &mut Diagnostics) {
        for key in KEYS.iter().filter(|k| **k != "name" && !settled.contains(k)) {
            let mut said =
                self.directives.iter().filter(|d| d.key == *key && range.contains(&d.value.span.start));
            let Some(first) = said.next() else { continue };
            let plain = |d: &Directive| d.value.text.to_lowercase();
            if let Some(second) = said.find(|d| plain(d) != plain(first)) {
                let line = line_column(text, first.value.span.start).0;
                let shown = |d: &Directive| d.value.text.chars().take(40).collect::<String>();
                let message =
                    format!("`{key}: {}` here, but `{}` in line {line}", shown(second), shown(first));
                out.error(second.value.span.clone(), message).hint("leave one of the two");
            }
        }
    }

    /// Its text.
    pub fn value(&self, key: &str, at: usize) -> Option<&str> {
        self.get(key, at).map(|v| v.text.as_str())
    }

    /// The heading above byte `at`.
    pub fn heading(&mut self, text: &str, span: &Range<usize>) {
        let line = text[span.clone()].trim();
        let title = if line.starts_with('#') {
            Some(line.trim_matches(['#', ' ']))
        } else {
            ["\\section", "\\subsection", "\\caption", "\\title"].iter().find_map(|c| {
                line.strip_prefix(c)?.trim_start_matches('*').strip_prefix('{')?.split('}').next()
            })
        };
        if let Some(title) = title.map(str::trim).filter(|t| !t.is_empty() && directive(t).is_none()) {
            self.headings.push(GridCell { text: title.replace(['*', '`', '$'], ""), span: span.clone() });
        }
    }

    /// The nearest heading before byte `at`.
    pub fn title(&self, at: usize) -> Option<&str> {
        self.headings.iter().take_while(|h| h.span.start < at).last().map(|h| h.text.as_str())
    }

    fn directive(&mut self, text: &str, span: &Range<usize>) {
        if let Some((key, value)) = directive(&text[span.clone()]) {
            let offset = value.as_ptr() as usize - text.as_ptr() as usize;
            let value = GridCell::of(text, offset..offset + value.len());
            self.directives.push(Directive { key, value });
        }
    }

    /// True if a line gives two names values: `for p = 90°, t = 30° the point is …`.
    pub fn gives_both(&self, one: &str, other: &str) -> bool {
        let has = |line: &[String], name: &str| line.iter().any(|n| n == name);
        self.beside.iter().any(|line| has(line, one) && has(line, other))
    }

    /// `a2 = 0.43 m, a3 = 0.02 m`
    fn equations(&mut self, text: &str, span: Range<usize>) {
        let line = &text[span.clone()];
        if self.beside.len() < MAX_BESIDE && line.matches('=').take(2).count() > 1 {
            let names = line.split('=').filter_map(|left| {
                let word = left.trim_end().rsplit([' ', '(', ',', ';', '$', ':']).next()?;
                name_of(word, true)
            });
            self.beside.push(names.take(MAX_NAMES).collect());
        }
        let mut start = span.start;
        let cuts = line
            .match_indices([',', ';'])
            .filter(|(i, _)| line[i + 1..].split([',', ';']).next().is_some_and(|t| t.contains('=')))
            .map(|(i, _)| span.start + i);
        for end in cuts.chain([span.end]).collect::<Vec<_>>() {
            let part = &text[start..end];
            if let Some((name, _)) = part.split_once('=') {
                let plain = name.trim_matches(|c: char| {
                    c.is_whitespace() || matches!(c, '-' | '*' | '>' | '#' | '%' | '•')
                });
                if let Some(plain) = name_of(plain, true) {
                    let value = GridCell::of(text, start + name.len() + 1..end);
                    let trimmed = value.text.trim_end_matches(['.', ' ', '\\']).len();
                    let value = GridCell::of(text, value.span.start..value.span.start + trimmed);
                    self.values.push((plain, value));
                }
            }
            start = (end + 1).min(span.end);
        }
    }
}

/// Key and value of a line such as `<!-- convention: craig -->`.
pub(super) fn directive(line: &str) -> Option<(String, &str)> {
    let line = line.trim().trim_start_matches(['#', '%', '>', '-', '*', '/', '<', '!', '`', ' ']);
    let line = line.trim_end_matches("-->").trim_end_matches(['`', ' ', '*', '.']);
    let (key, value) = line.split_once([':', '='])?;
    let key = key.trim_matches(['*', '`', ' ']).to_lowercase();
    let value = value.trim().trim_matches(['"', '`', '*']);
    KEYS.contains(&key.as_str()).then_some((key, value))
}
