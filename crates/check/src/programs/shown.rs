//! What a program shows: numbers and formulas in the comments behind `print(x)` and `J = …`, and below the cells of a notebook.
//!
//! What is shown is held against what the formulas that are judged make of it: a value is looked at only if it rests on these.

use super::followed::{cause, entries_of, mended_by};
use super::stated::{Stated, in_radians};
use super::{Followed, Source, words};
use crate::facts::About;
use crate::lexis::Lexis;
use crate::listing::comment_mark;
use crate::numbers::{Answer, Configuration, half_unit, is_near};
use crate::subject::Subject;
use crate::walk::{Assertion, Pair, Piece};
use denavit_reading::code::{Asked, Code, Dialect, Reading, Value, read_blocks};
use denavit_symbolic::Expr;
use denavit_symbolic::parse::Syntax;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// So many lines below are looked at.
const MAX_LINES: usize = 10;
/// The most values that are compared.
const MAX_VALUES: usize = 64;
/// Words that stand around numbers.
const AROUND: [&str; 12] =
    ["Matrix", "array", "np", "ans", "rad", "deg", "m", "dtype", "Out", "sp", "ImmutableMatrix", "N"];

/// What outputs are held against.
pub(super) struct Showing<'a> {
    pub of: &'a Source<'a>,
    pub subject: &'a Subject,
    pub lexis: &'a Lexis,
    pub stated: &'a Stated,
    pub meaning: &'a dyn Fn(&str) -> Option<Expr>,
    pub judged: &'a [Assertion],
}

/// Something that is shown: the statement, the formula, and what it is.
struct Item<'a> {
    statement: Range<usize>,
    formula: Vec<Range<usize>>,
    name: String,
    author: Vec<&'a Value>,
    right: Vec<&'a Value>,
    /// It stands alone at the end of a block.
    is_last: bool,
}

/// A value in print.
enum Shown {
    Number(Range<usize>, f64, f64),
    Formula(Range<usize>, Expr, Option<Syntax>),
}

impl Showing<'_> {
    /// The claims of what is shown, and what of them follows from something wrong.
    pub fn outputs(&self, codes: &[Code], right: &[Code]) -> (Vec<Assertion>, Vec<Followed>) {
        let (mut found, mut followed) = (vec![], vec![]);
        let wrong: Vec<&Assertion> = self.judged.iter().filter(|a| mended_by(a).is_some()).collect();
        let mut taken: Vec<Range<usize>> = vec![];
        for (k, code) in codes.iter().enumerate() {
            let Some(other) = right.get(k) else { continue };
            let scripts = code.functions.iter().zip(&other.functions);
            for (script, other) in scripts.filter(|s| s.0.name.is_empty() && s.1.name.is_empty()) {
                for item in self.items(script, other, &self.of.blocks[k]) {
                    let Some((region, shown)) = self.shown(&item, k) else { continue };
                    if taken.iter().any(|t| t.start < region.end && region.start < t.end) {
                        continue;
                    }
                    if !item.formula.iter().all(|f| self.rests_on_judged(f, codes, &mut BTreeSet::new())) {
                        continue;
                    }
                    taken.push(region.clone());
                    let (assertion, follows) = self.assertion(&item, &region, shown);
                    let formula = item.formula.first().and_then(|f| self.of.source.get(f.clone()));
                    if let Some(by) = cause(&wrong, region.start, formula) {
                        followed.push(Followed { span: region, by: by.span.clone(), follows });
                    }
                    found.push(assertion);
                }
            }
        }
        (found, followed)
    }

    /// What a script shows, in the order of the text.
    fn items<'b>(&self, script: &'b Reading, right: &'b Reading, block: &Range<usize>) -> Vec<Item<'b>> {
        let mut items: Vec<Item<'b>> = vec![];
        let source = |span: &Range<usize>| self.of.source.get(span.clone()).unwrap_or_default();
        for (a, b) in script.shown.iter().zip(&right.shown) {
            if a.span != b.span || a.values.len() != b.values.len() {
                continue;
            }
            let name: Vec<&str> = a.values.iter().map(|v| source(&v.0)).collect();
            let rest = self.of.source.get(a.span.end..block.end).unwrap_or_default();
            items.push(Item {
                statement: a.span.clone(),
                formula: a.values.iter().map(|v| v.0.clone()).collect(),
                name: name.join(", "),
                author: a.values.iter().map(|v| &v.1).collect(),
                right: b.values.iter().map(|v| &v.1).collect(),
                is_last: rest.trim_matches([';', ')', '\n', ' ', '\r']).is_empty(),
            });
        }
        for (a, b) in script.assigned.iter().zip(&right.assigned) {
            if a.span != b.span || a.name != b.name {
                continue;
            }
            let rest = self.of.source.get(a.span.end..block.end).unwrap_or_default();
            items.push(Item {
                statement: a.span.clone(),
                formula: vec![a.span.clone()],
                name: a.name.clone(),
                author: vec![&a.value],
                right: vec![&b.value],
                is_last: self.of.language == Dialect::Matlab
                    && rest.trim_matches(['\n', ' ', '\r']).is_empty(),
            });
        }
        items.sort_by_key(|i| i.statement.start);
        items
    }

    /// True if a formula is made of names and functions that are judged, or of what is no matter of judgement.
    fn rests_on_judged(&self, formula: &Range<usize>, codes: &[Code], seen: &mut BTreeSet<usize>) -> bool {
        let touches = |a: &Assertion| a.span.start < formula.end && formula.start < a.span.end;
        if self.judged.iter().any(touches) || !seen.insert(formula.start) {
            return true;
        }
        let source = self.of.source.get(formula.clone()).unwrap_or_default();
        let functions = || codes.iter().flat_map(|c| &c.functions);
        let joints = self.subject.joints();
        for word in words(source) {
            if self.judged.iter().any(|a| a.name == word) {
                continue;
            }
            let assigned = functions()
                .filter(|f| f.name.is_empty())
                .flat_map(|f| &f.assigned)
                .rfind(|a| a.name == word && a.span.start < formula.start);
            let is_fine = match assigned {
                Some(a) if !moves(&a.value, joints) => true,
                Some(a) => self.rests_on_judged(&a.span, codes, seen),
                None => match functions().find(|f| f.name == word) {
                    Some(f) => {
                        let within = |a: &Assertion| f.span.start <= a.span.start && a.span.end <= f.span.end;
                        self.judged.iter().any(within)
                    }
                    // A joint by itself in a formula that is the author's own.
                    None => (self.meaning)(word).is_none_or(|e| !joints.contains(&e)) || !is_formula(source),
                },
            };
            if !is_fine {
                return false;
            }
        }
        true
    }

    /// The values in print that belong to something shown, and where they stand.
    fn shown(&self, item: &Item<'_>, block: usize) -> Option<(Range<usize>, Vec<Shown>)> {
        let count: usize = item.author.iter().map(|v| size(v)).sum();
        if count == 0 || count > MAX_VALUES {
            return None;
        }
        let text = self.of.text;
        let inside = &self.of.blocks[block];
        let comment = comment_mark(self.of.language);
        let end = item.statement.end;
        let line_end = text[end..].find('\n').map_or(text.len(), |i| end + i);
        let behind = text.get(end..line_end)?;
        let rest = behind.trim_start_matches([';', ' ', ')', ',', '\t']);
        let mut regions: Vec<Range<usize>> = vec![];
        if rest.starts_with(comment) {
            regions.push(line_end - rest.len()..line_end);
        } else if !rest.trim().is_empty() {
            return None;
        }
        // Comments below, line by line.
        let mut at = line_end + 1;
        let below = at;
        for _ in 0..MAX_LINES {
            let Some(line) = text.get(at..inside.end).and_then(|t| t.split_inclusive('\n').next()) else {
                break;
            };
            if !line.trim_start().starts_with(comment) {
                break;
            }
            let own = at..at + line.trim_end().len();
            at += line.len();
            regions.push(below..at.min(text.len()));
            // `# y = 0.42` among the comments of several names.
            let named = line.trim_start().trim_start_matches(comment).split_once('=');
            let is_place = matches!(item.name.as_str(), "x" | "y" | "z" | "px" | "py" | "pz");
            if is_place && named.is_some_and(|(name, _)| name.trim() == item.name) {
                regions.insert(0, own);
            }
        }
        for region in regions {
            if let Some(shown) = self.values(&region, count, item, Some(comment)) {
                return Some((trimmed(text, region), shown));
            }
        }
        if !item.is_last {
            return None;
        }
        self.below(block, count, item)
    }

    /// What stands below a block: a fence without a language, or indented lines.
    fn below(&self, block: usize, count: usize, item: &Item<'_>) -> Option<(Range<usize>, Vec<Shown>)> {
        let text = self.of.text;
        let region = self.of.outputs.get(block)?;
        let part = text.get(region.clone())?;
        let mut start = region.start;
        let mut open: Option<usize> = None;
        let mut is_own = false;
        for (n, line) in part.split_inclusive('\n').enumerate().take(40) {
            let here = start;
            start += line.len();
            let plain = line.trim();
            if let Some(from) = open {
                if plain.starts_with("```") {
                    return self
                        .values(&(from..here), count, item, None)
                        .map(|v| (trimmed(text, from..here), v));
                }
                continue;
            }
            // The fence that ends the block itself comes first.
            if plain.starts_with("```") {
                if !is_own && n < 2 {
                    is_own = true;
                    continue;
                }
                if plain.trim_matches('`').is_empty() || plain.ends_with("text") || plain.ends_with("output")
                {
                    open = Some(start);
                    continue;
                }
                return None;
            }
            let formula = plain.trim_matches('$');
            if plain.starts_with('$') && plain.ends_with('$') && !formula.contains(['=', '$']) && count == 1 {
                let from = here + line.find(formula)?;
                let span = from..from + formula.len();
                let syntax = self.lexis.formula(text, &span).ok()?;
                let value = syntax.value();
                return Some((span.clone(), vec![Shown::Formula(span, value, Some(syntax))]));
            }
            let is_indented = line.starts_with("    ") || plain.starts_with('`');
            if is_indented && let Some(v) = self.values(&(here..start), count, item, None) {
                return Some((trimmed(text, here..start), v));
            }
        }
        None
    }

    /// So many values in a part of the text.
    fn values(
        &self,
        region: &Range<usize>,
        count: usize,
        item: &Item<'_>,
        comment: Option<&str>,
    ) -> Option<Vec<Shown>> {
        let text = self.of.text.get(region.clone())?;
        // The same bytes without marks of comments, and without a name before.
        let mut bare: Vec<u8> = text.bytes().collect();
        let blank = |bytes: &mut [u8]| bytes.iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            if let Some(i) = comment.and_then(|c| line.find(c)) {
                let first = line[i..].chars().next();
                let marks = line[i..].chars().take_while(|c| Some(*c) == first).count();
                blank(&mut bare[start..start + i + marks]);
            }
            start += line.len();
        }
        let plain = String::from_utf8(bare.clone()).ok()?;
        let head = plain.find(['=', ':']).filter(|&i| {
            let before = plain[..i].trim();
            let is_name = |w: &str| {
                !w.is_empty()
                    && (item.name.split([',', ' ']).any(|n| n == w) || w == "ans" || w.starts_with("Out"))
            };
            is_name(before) || words(before).all(|w| item.name.contains(w)) && before.len() <= item.name.len()
        });
        if let Some(i) = head {
            blank(&mut bare[..=i]);
        }
        let plain = String::from_utf8(bare).ok()?;
        let arrow = plain.trim_start();
        let arrow = ["->", "=>", "→", ">>>", "≈", "~"].iter().find(|a| arrow.starts_with(**a));
        let plain = match arrow {
            Some(a) => plain.replacen(a, &" ".repeat(a.len()), 1),
            None => plain,
        };
        if let Some(numbers) = numbers(&plain, region.start) {
            return (numbers.len() == count).then_some(numbers);
        }
        let plain = plain.replace(';', " ");
        let copy = format!("{}{}", " ".repeat(region.start), plain);
        let none = |_: &str, _: &[Expr]| None;
        let (mended, joints) = (BTreeMap::new(), self.subject.joints());
        let asked =
            Asked { names: self.meaning, joints, stated: &none, mended: &mended, posed: None, own: None };
        let indent = plain.find(|c: char| !c.is_whitespace())?;
        let span = region.start + indent..region.end;
        let mut code = read_blocks(&copy, &[span], self.of.language, &asked);
        let code = code.pop().filter(|c| c.refusals.is_empty())?;
        let shown = code.functions.iter().flat_map(|f| &f.shown).filter(|s| !s.is_call);
        let cells: Vec<Shown> = shown
            .flat_map(|s| &s.values)
            .flat_map(|v| match &v.1 {
                Value::Scalar(cell) => vec![cell.clone()],
                Value::Matrix(rows) => rows.iter().flatten().cloned().collect(),
            })
            .map(|c| Shown::Formula(c.span, c.value, c.syntax))
            .collect();
        (cells.len() == count).then_some(cells)
    }

    fn assertion(&self, item: &Item<'_>, region: &Range<usize>, shown: Vec<Shown>) -> (Assertion, Vec<bool>) {
        let cells = |values: &[&Value]| -> Vec<(Option<(usize, usize)>, Expr)> {
            let mut all = vec![];
            for value in values {
                match value {
                    Value::Scalar(cell) => all.push((None, in_radians(cell.value))),
                    Value::Matrix(rows) => {
                        for (r, row) in rows.iter().enumerate() {
                            for (c, cell) in row.iter().enumerate() {
                                let place = (values.len() == 1).then_some((r + 1, c + 1));
                                all.push((place, in_radians(cell.value)));
                            }
                        }
                    }
                }
            }
            all
        };
        let (author, right) = (cells(&item.author), cells(&item.right));
        let d = &self.subject.description;
        let number = |e: Expr| self.stated.at_numbers(e).substitute(|s| d.exact_value(s));
        let (mut pieces, mut follows) = (vec![], vec![]);
        for ((shown, (place, wanted)), (_, own)) in shown.into_iter().zip(right).zip(author) {
            match shown {
                Shown::Number(span, printed, half) => {
                    let answer = |wanted: Expr| Answer {
                        printed,
                        half,
                        wanted: number(wanted),
                        at: Configuration::default(),
                        constant: None,
                    };
                    follows.push(is_near(&answer(own), self.subject));
                    pieces.push(Piece::Number { place, span, answer: answer(wanted) });
                }
                Shown::Formula(span, value, syntax) => {
                    follows.push(denavit_symbolic::equal(value, own).is_equal());
                    pieces.push(Piece::Pair(Pair {
                        place,
                        span,
                        printed: syntax,
                        value,
                        wanted,
                        also: vec![],
                    }));
                }
            }
        }
        let assertion = Assertion {
            span: region.clone(),
            name: item.name.chars().take(60).collect(),
            about: About::Equation,
            pieces,
            remarks: vec![],
            subject: self.of.number,
            whole: None,
            names: None,
            reference: None,
            spoken: None,
        };
        (assertion, follows)
    }
}

/// True if a joint occurs in a value.
fn moves(value: &Value, joints: &[Expr]) -> bool {
    let all = entries_of(value);
    all.into_iter().any(|e| e.symbols().iter().any(|s| joints.contains(&(*s).into())))
}

/// True for what computes with sines and products, not only with what has a name.
fn is_formula(source: &str) -> bool {
    ["sin", "cos", "atan", "arc"].iter().any(|f| source.contains(f))
}

fn size(value: &Value) -> usize {
    match value {
        Value::Scalar(_) => 1,
        Value::Matrix(rows) => rows.iter().map(Vec::len).sum(),
    }
}

/// Numbers alone, brackets, commas and a few words left aside.
fn numbers(text: &str, start: usize) -> Option<Vec<Shown>> {
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '+' | '−' | '_');
    let mut found: Vec<(Range<usize>, f64, f64)> = vec![];
    let mut at = 0;
    while let Some(i) = text[at..].find(is_part) {
        let from = at + i;
        if text[at..from].chars().any(|c| !c.is_whitespace() && !"[](),;|°`".contains(c)) {
            return None;
        }
        let end = text[from..].find(|c: char| !is_part(c)).map_or(text.len(), |j| from + j);
        at = end;
        let word = &text[from..end];
        if AROUND.contains(&word) {
            continue;
        }
        let value: f64 = word.replace('−', "-").parse().ok()?;
        if !word.contains(|c: char| c.is_ascii_digit()) {
            return None;
        }
        found.push((start + from..start + end, value, half_unit(word)));
    }
    if text[at..].chars().any(|c| !c.is_whitespace() && !"[](),;|°`.".contains(c)) {
        return None;
    }
    // A whole number beside others is as exact as these.
    let is_whole = |f: &(Range<usize>, f64, f64)| f.2 == 0.5 && f.1 == f.1.trunc();
    let others = found.iter().filter(|f| !is_whole(f)).map(|f| f.2).fold(0.0, f64::max);
    let half = |f: &(Range<usize>, f64, f64)| match is_whole(f) {
        true if others > 0.0 => others,
        true if f.1.abs() < 10.0 => 1e-6,
        _ => f.2,
    };
    Some(found.iter().map(|f| Shown::Number(f.0.clone(), f.1, half(f))).collect())
}

fn trimmed(text: &str, span: Range<usize>) -> Range<usize> {
    let shown = text.get(span.clone()).unwrap_or_default();
    let start = span.start + (shown.len() - shown.trim_start().len());
    start..start + shown.trim().len()
}
