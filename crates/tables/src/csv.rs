//! Values with something between them: comma, semicolon, tab or blanks; decimal points or commas; with a head or without.

use crate::{Column, MAX_COLUMNS, MAX_NUMBERS, Table, TableError, some};

/// How much of a text the dialect is told by.
const HEAD: usize = 1 << 16;

/// How values stand in a text.
struct Dialect {
    between: Between,
    decimal_comma: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum Between {
    Byte(u8),
    Blanks,
}

/// The text of bytes: UTF-8, or UTF-16 where they begin with its mark.
fn decoded(bytes: &[u8]) -> Result<String, TableError> {
    let units = |big: bool| {
        let unit =
            |c: &[u8]| if big { u16::from_be_bytes([c[0], c[1]]) } else { u16::from_le_bytes([c[0], c[1]]) };
        String::from_utf16_lossy(&bytes[2..].chunks_exact(2).map(unit).collect::<Vec<u16>>())
    };
    match bytes {
        [0xff, 0xfe, ..] => Ok(units(false)),
        [0xfe, 0xff, ..] => Ok(units(true)),
        _ if bytes[..bytes.len().min(HEAD)].contains(&0) => Err(TableError::new(
            "this is no text",
            "a table in CSV is a text; other files are told by their ending",
        )),
        _ => {
            let text = String::from_utf8_lossy(bytes);
            Ok(text.strip_prefix('\u{feff}').unwrap_or(&text).to_string())
        }
    }
}

/// Reads a text.
pub fn read(bytes: &[u8]) -> Result<Table, TableError> {
    let text = decoded(bytes)?;
    let is_data = |l: &&str| !l.trim().is_empty() && !l.trim_start().starts_with(['#', '%']);
    let sample: Vec<&str> = text.lines().filter(is_data).take(50).collect();
    if sample.is_empty() {
        return Err(TableError::new("the file is empty", "a recording has a row for each moment"));
    }
    let dialect = sniffed(&sample);
    // A head may stand behind `#`, as NumPy writes it.
    let mut commented = match dialect.between {
        Between::Blanks => comment_head(&text, None),
        Between::Byte(byte) => comment_head(&text, Some(byte)),
    };
    let mut names: Option<Vec<String>> = None;
    let mut columns: Vec<Column> = vec![];
    let mut first_row = 0;
    let (mut bad, mut bad_count) = (vec![], 0);
    let (mut uneven, mut uneven_count) = (vec![], 0);
    let mut texts: Vec<usize> = vec![];
    let mut rows = 0;
    let mut each = |line: usize, cells: &[&str]| -> Result<(), TableError> {
        if cells.len() > MAX_COLUMNS {
            let what = format!("line {line} has {} columns", cells.len());
            return Err(TableError::new(
                what,
                format!("at most {MAX_COLUMNS} can be read: is it one row a moment?"),
            ));
        }
        let is_number = |c: &&&str| number(c, dialect.decimal_comma).is_some();
        if names.is_none() && columns.is_empty() {
            let said = commented.take().filter(|n: &Vec<String>| n.len() == cells.len());
            if cells.iter().filter(is_number).count() * 2 < cells.len() {
                names = Some(cells.iter().map(|c| (*c).trim().to_string()).collect());
                return Ok(());
            }
            names = Some(said.unwrap_or_else(|| (1..=cells.len()).map(|k| format!("column {k}")).collect()));
        }
        let names = names.get_or_insert_default();
        if columns.is_empty() {
            first_row = line;
            let column = |n: &String| Column { name: n.clone(), unit: None, values: vec![] };
            columns = names.iter().map(column).collect();
            texts = vec![0; columns.len()];
        }
        if rows * columns.len() > MAX_NUMBERS {
            return Err(TableError::new(
                format!("more than {MAX_NUMBERS} numbers"),
                "take a part of the file",
            ));
        }
        if cells.len() != columns.len() {
            uneven_count += 1;
            if uneven.len() < 5 {
                uneven.push(format!("line {line} has {}", cells.len()));
            }
        }
        rows += 1;
        for (k, column) in columns.iter_mut().enumerate() {
            let cell = cells.get(k).map_or("", |c| c.trim());
            let x = number(cell, dialect.decimal_comma);
            if x.is_none() && !is_missing(cell) {
                texts[k] += 1;
                bad_count += 1;
                if bad.len() < 40 {
                    bad.push((k, format!("`{}` in line {line}, column {}", short(cell), column.name)));
                }
            }
            column.values.push(x.unwrap_or(f64::NAN));
        }
        Ok(())
    };
    match dialect.between {
        Between::Blanks => {
            for (k, line) in text.lines().enumerate().filter(|(_, l)| is_data(l)) {
                each(k + 1, &line.split_whitespace().collect::<Vec<_>>())?;
            }
        }
        Between::Byte(byte) => {
            let mut reader = ::csv::ReaderBuilder::new()
                .has_headers(false)
                .flexible(true)
                .delimiter(byte)
                .comment(Some(b'#'))
                .from_reader(text.as_bytes());
            let mut record = ::csv::StringRecord::new();
            loop {
                let line = reader.position().line();
                match reader.read_record(&mut record) {
                    Ok(false) => break,
                    Ok(true) => {
                        let cells: Vec<&str> = record.iter().collect();
                        if cells.iter().all(|c| c.trim().is_empty()) {
                            continue;
                        }
                        let at = record.position().map_or(line, ::csv::Position::line);
                        each(usize::try_from(at).unwrap_or(0), &cells)?;
                    }
                    Err(e) => {
                        return Err(TableError::new(
                            format!("line {line}: {e}"),
                            "quote texts that hold quotes",
                        ));
                    }
                }
            }
        }
    }
    if rows == 0 {
        return Err(TableError::new("there is a head and no row", "a recording has a row for each moment"));
    }
    let mut remarks =
        vec![dialect.said(names.as_deref().is_some_and(|n| n.first().is_some_and(|n| n != "column 1")))];
    // A column of texts is left out.
    let is_text: Vec<bool> = texts.iter().map(|t| 2 * t > rows).collect();
    let left: Vec<String> = columns.iter().zip(&is_text).filter(|c| *c.1).map(|c| c.0.name.clone()).collect();
    if !left.is_empty() {
        remarks.push(format!("left out, for it holds texts: {}", some(&left, left.len())));
    }
    let of_texts: usize = texts.iter().zip(&is_text).filter(|t| *t.1).map(|t| t.0).sum();
    let bad: Vec<String> = bad.into_iter().filter(|(k, _)| !is_text[*k]).map(|b| b.1).collect();
    if bad_count > of_texts {
        remarks.push(format!("no numbers: {}", some(&bad, bad_count - of_texts)));
    }
    if uneven_count > 0 {
        remarks.push(format!("{} columns in the first row; {}", columns.len(), some(&uneven, uneven_count)));
    }
    let mut keep = is_text.iter();
    columns.retain(|_| !*keep.next().unwrap_or(&false));
    Ok(Table { columns, first_row, remarks })
}

/// The last comment before the first row, as names.
fn comment_head(text: &str, between: Option<u8>) -> Option<Vec<String>> {
    let lines = text.lines().take_while(|l| l.trim().is_empty() || l.trim_start().starts_with('#'));
    let last = lines.last()?.trim_start().trim_start_matches('#');
    let names: Vec<String> = match between {
        Some(byte) => last.split(char::from(byte)).map(|c| c.trim().to_string()).collect(),
        None => last.split_whitespace().map(String::from).collect(),
    };
    names.iter().all(|n| !n.is_empty()).then_some(names)
}

fn short(text: &str) -> String {
    let cut: String = text.chars().take(20).collect();
    if cut.len() < text.len() { format!("{cut}…") } else { cut }
}

/// Cells that say that there is no number.
fn is_missing(cell: &str) -> bool {
    ["", "nan", "na", "n/a", "null", "none", "-", "nil"].contains(&cell.to_lowercase().as_str())
}

/// A number with a decimal point or comma.
fn number(cell: &str, decimal_comma: bool) -> Option<f64> {
    let cell = cell.trim();
    let first = cell.chars().next()?;
    if !(first.is_ascii_digit() || "+-.,".contains(first)) {
        return match cell.to_lowercase().as_str() {
            "true" => Some(1.0),
            "false" => Some(0.0),
            _ => None,
        };
    }
    let x: f64 = if decimal_comma { cell.replace(',', ".").parse().ok()? } else { cell.parse().ok()? };
    x.is_finite().then_some(x)
}

/// The dialect in which most of the sample's cells are numbers and all rows are of one length.
fn sniffed(sample: &[&str]) -> Dialect {
    let mut best = (0.0, Dialect { between: Between::Byte(b','), decimal_comma: false });
    let between = [b',', b';', b'\t', b'|'].map(Between::Byte).into_iter().chain([Between::Blanks]);
    for between in between {
        for decimal_comma in [false, true] {
            if decimal_comma && between == Between::Byte(b',') {
                continue;
            }
            let cells = |line: &str| -> Vec<bool> {
                let is_number = |c: &str| number(c, decimal_comma).is_some();
                match between {
                    Between::Byte(b) => line.split(char::from(b)).map(is_number).collect(),
                    Between::Blanks => line.split_whitespace().map(is_number).collect(),
                }
            };
            let all: Vec<Vec<bool>> = sample.iter().map(|l| cells(l)).collect();
            // As many as most rows have.
            let rows_of = |w: usize| all.iter().filter(|r| r.len() == w).count();
            let width = all.iter().map(Vec::len).max_by_key(|&w| (rows_of(w), w)).unwrap_or(0);
            let even = all.iter().filter(|r| r.len() == width).count() as f64 / all.len() as f64;
            let numbers: usize = all.iter().flatten().filter(|n| **n).count();
            let whole: usize = all.iter().map(Vec::len).sum();
            let part = numbers as f64 / whole.max(1) as f64;
            // More columns of numbers, all rows alike.
            let worth =
                even * part * (width as f64).min(64.0).sqrt() * if decimal_comma { 0.99 } else { 1.0 };
            if worth > best.0 + 1e-9 {
                best = (worth, Dialect { between, decimal_comma });
            }
        }
    }
    best.1
}

impl Dialect {
    fn said(&self, has_head: bool) -> String {
        let between = match self.between {
            Between::Byte(b',') => "commas",
            Between::Byte(b';') => "semicolons",
            Between::Byte(b'\t') => "tabs",
            Between::Byte(_) => "bars",
            Between::Blanks => "blanks",
        };
        let decimal = if self.decimal_comma { "decimal commas" } else { "decimal points" };
        let head = if has_head { "a head with names" } else { "no head: columns by their numbers" };
        format!("read with {between} between the values, {decimal}, {head}")
    }
}

/// A table with commas and decimal points; units stand behind their names in brackets.
pub fn written(columns: &[Column]) -> String {
    let quoted = |text: String| {
        if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
    };
    let head = |c: &Column| quoted(c.unit.as_ref().map_or(c.name.clone(), |u| format!("{} [{u}]", c.name)));
    let mut text = columns.iter().map(head).collect::<Vec<_>>().join(",") + "\n";
    for r in 0..columns.first().map_or(0, |c| c.values.len()) {
        for (k, c) in columns.iter().enumerate() {
            if k > 0 {
                text.push(',');
            }
            if c.values[r].is_finite() {
                text += &c.values[r].to_string();
            }
        }
        text.push('\n');
    }
    text
}
