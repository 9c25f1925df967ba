//! Statements in TOML: `key = "formula"`, `key = [["a", "b"], ["c", "d"]]`, and tables that claim something.

use super::lexer::{Relation, lex};
use super::lines::trimmed;
use super::statements::Reader;
use super::tree::build;
use super::{Directive, Fence, Grid, Part, Place, Side, Statement, cut};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// The longest file that is read, in bytes.
const MAX_BYTES: usize = 1 << 20;

pub(super) fn read(reader: &mut Reader) {
    let text = reader.text;
    if text.len() > MAX_BYTES {
        let message = format!("the file has {} bytes; {MAX_BYTES} are read of TOML", text.len());
        return reader.note(0..0, message, "divide the file");
    }
    let (table, errors) = DeTable::parse_recoverable(text);
    for error in errors.iter().take(20) {
        let span = error.span().filter(|s| text.get(s.clone()).is_some()).unwrap_or(0..0);
        reader.note(span, format!("not TOML: {}", error.message()), "correct the file before it is checked");
    }
    table_of(reader, table.get_ref());
}

fn table_of(reader: &mut Reader, table: &DeTable) {
    let mut entries: Vec<_> = table.iter().map(|(k, v)| (k.span(), k.get_ref().as_ref(), v)).collect();
    entries.sort_by_key(|e| e.0.start);
    let claim = entries.iter().find(|e| e.1 == "claim" && matches!(e.2.get_ref(), DeValue::String(_)));
    if let Some((_, _, claim)) = claim {
        claimed(reader, &entries, claim);
        return;
    }
    for (key, _, value) in entries {
        let inner = inside_quotes(reader.text, &key);
        match value.get_ref() {
            DeValue::Table(table) => {
                let outer = reader.heading.replace(inner);
                table_of(reader, table);
                reader.heading = outer;
            }
            DeValue::Array(array) if array.iter().any(|v| matches!(v.get_ref(), DeValue::Table(_))) => {
                let outer = reader.heading.replace(inner);
                for value in array {
                    if let DeValue::Table(table) = value.get_ref() {
                        table_of(reader, table);
                    }
                }
                reader.heading = outer;
            }
            _ => {
                if let Some(sides) = value_sides(reader, value) {
                    push(reader, inner, sides, vec![]);
                }
            }
        }
    }
}

/// `claim = "T06"` with a matrix or a formula; every other entry is a directive.
fn claimed(
    reader: &mut Reader,
    entries: &[(Range<usize>, &str, &Spanned<DeValue>)],
    claim: &Spanned<DeValue>,
) {
    let text = reader.text;
    let mut directives = vec![];
    let mut stated = vec![];
    for &(_, name, value) in entries {
        if matches!(name, "matrix" | "formula" | "entry") {
            stated.push(value);
            continue;
        }
        let span = inside_quotes(text, &value.span());
        let words = match value.get_ref() {
            DeValue::Table(_) => continue,
            DeValue::Array(array) => {
                let words = array.iter().map(|v| cut(text, &inside_quotes(text, &v.span())));
                format!("{name} {}", words.collect::<Vec<_>>().join(" "))
            }
            _ => format!("{name} {}", cut(text, &span)),
        };
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        let directive = Directive { span, words };
        if name == "claim" { directives.insert(0, directive) } else { directives.push(directive) }
    }
    if stated.is_empty() {
        reader.note(claim.span(), "the claim states nothing", "add `matrix = [[…]]` or `formula = '…'`");
    }
    for value in stated {
        if let Some(sides) = value_sides(reader, value) {
            push(reader, inside_quotes(text, &claim.span()), sides, directives.clone());
        }
    }
}

/// `name = sides[0] = …`
fn push(
    reader: &mut Reader,
    name: Range<usize>,
    sides: (Vec<Side>, Vec<Relation>),
    directives: Vec<Directive>,
) {
    if reader.full() {
        return;
    }
    let start = Side { span: name.clone(), parts: vec![Part::Text(name.clone())] };
    let all: Vec<Side> = std::iter::once(start).chain(sides.0).collect();
    let end = all.iter().map(|s| s.span.end).max().unwrap_or(name.end);
    reader.statements.push(Statement {
        span: name.start..end.max(name.end),
        sides: all,
        relations: std::iter::once(Relation::Equal).chain(sides.1).collect(),
        directives,
        heading: reader.heading.clone(),
        prose: None,
        label: None,
        link: None,
        aside: None,
        place: Place::Key,
        juxtaposed: false,
    });
}

/// What a value says: a formula, a chain of them, or a matrix.
fn value_sides(reader: &mut Reader, value: &Spanned<DeValue>) -> Option<(Vec<Side>, Vec<Relation>)> {
    let text = reader.text;
    match value.get_ref() {
        DeValue::String(content) => {
            let span = content_span(reader, value, content)?;
            let tree = build(text, lex(text, &span), true);
            for note in tree.notes {
                reader.note(note.span, note.message, note.hint);
            }
            (!tree.nodes.is_empty()).then(|| reader.sides_of(&tree.nodes))
        }
        DeValue::Integer(_) | DeValue::Float(_) => {
            let side = Side { span: value.span(), parts: vec![Part::Text(value.span())] };
            Some((vec![side], vec![]))
        }
        DeValue::Array(array) => {
            let rows = rows(reader, array)?;
            let grid = Grid::new(value.span(), Fence::Square, rows);
            Some((vec![Side { span: value.span(), parts: vec![Part::Matrix(grid)] }], vec![]))
        }
        _ => None,
    }
}

/// A list of lists by rows, a list as a column.
fn rows(reader: &mut Reader, array: &DeArray) -> Option<Vec<Vec<Range<usize>>>> {
    let mut rows = vec![];
    for value in array {
        let row = match value.get_ref() {
            DeValue::Array(row) => row.iter().map(|v| cell(reader, v)).collect::<Option<Vec<_>>>()?,
            _ => vec![cell(reader, value)?],
        };
        rows.push(row);
    }
    (!rows.is_empty()).then_some(rows)
}

fn cell(reader: &mut Reader, value: &Spanned<DeValue>) -> Option<Range<usize>> {
    match value.get_ref() {
        DeValue::String(content) => content_span(reader, value, content),
        DeValue::Integer(_) | DeValue::Float(_) => Some(value.span()),
        _ => None,
    }
}

/// The place of a string's content, if it is written as it is meant.
fn content_span(reader: &mut Reader, value: &Spanned<DeValue>, content: &str) -> Option<Range<usize>> {
    let span = inside_quotes(reader.text, &value.span());
    if cut(reader.text, &span).replace("\r\n", "\n") != content.replace("\r\n", "\n") {
        let hint = "write it in single quotes: '\\frac{a}{b}'";
        reader.note(value.span(), "a formula with escaped characters is not read", hint);
        return None;
    }
    Some(trimmed(reader.text, &span))
}

/// Without the quotes of a string or key.
fn inside_quotes(text: &str, span: &Range<usize>) -> Range<usize> {
    let shown = cut(text, span);
    for quote in ["\"\"\"", "'''", "\"", "'"] {
        let Some(inner) = shown.strip_prefix(quote).and_then(|s| s.strip_suffix(quote)) else { continue };
        let start = span.start + quote.len();
        let line = match () {
            () if quote.len() == 1 => 0,
            () if inner.starts_with("\r\n") => 2,
            () => usize::from(inner.starts_with('\n')),
        };
        return start + line..start + inner.len();
    }
    span.clone()
}
