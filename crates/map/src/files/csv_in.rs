//! CSV: a head of names, a row a line, values between commas, semicolons or tabs.
//!
//! The file is read twice: first for what its columns hold, whole numbers, numbers or texts, so that nothing is guessed from its
//! beginning; then for its rows.

use super::broken::{broken, unreadable};
use super::{Load, Loads, MAX_COLUMNS, Source};
use crate::MapError;
use arrow_array::builder::{PrimitiveBuilder, StringBuilder};
use arrow_array::types::{ArrowPrimitiveType, Float64Type, Int64Type};
use arrow_array::{ArrayRef, RecordBatch};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use csv::{ByteRecord, Reader, ReaderBuilder};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

/// A text of columns.
pub struct Csv {
    path: PathBuf,
    between: u8,
    schema: SchemaRef,
    rows: u64,
    bytes: u64,
}

/// Bytes of the longest line that is read, and of what is read ahead of it.
const LONGEST: usize = 16 << 20;
const AHEAD: usize = 1 << 18;
/// Bytes of text after which a part ends, however many rows it should have.
const TEXT: usize = 16 << 20;

/// A file of which a line has an end: what was read since the last one is counted.
struct Lines {
    file: File,
    since: usize,
}

impl Read for Lines {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        if self.since > LONGEST + AHEAD {
            return Err(std::io::Error::other("a line is too long"));
        }
        let count = self.file.read(into)?;
        self.since += count;
        Ok(count)
    }
}

/// What a column may hold still.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Holds {
    Nothing,
    Whole,
    Number,
    Text,
}

impl Csv {
    /// Opens a file, and reads what its columns hold.
    ///
    /// # Errors
    /// If it cannot be read, has no head, or lines of another length.
    pub fn open(path: &Path) -> Result<Self, MapError> {
        let file = File::open(path).map_err(|why| unreadable(path, &why))?;
        let about = file.metadata().map_err(|why| unreadable(path, &why))?;
        if !about.is_file() {
            let hint = "it is read twice: write what comes out of a pipe to a file first";
            return Err(MapError::new(format!("{} is no file", path.display()), hint));
        }
        let bytes = about.len();
        let mut head = vec![];
        file.take(1 << 16).read_to_end(&mut head).map_err(|why| unreadable(path, &why))?;
        if head.starts_with(&[0xff, 0xfe]) || head.starts_with(&[0xfe, 0xff]) || head.contains(&0) {
            let hint = "write it as UTF-8";
            return Err(MapError::new(format!("{}: this is no text in UTF-8", path.display()), hint));
        }
        let line = head.split(|b| *b == b'\n').next().unwrap_or_default();
        let count = |b: u8| line.iter().filter(|x| **x == b).count();
        let between = *b",;\t".iter().max_by_key(|&&b| (count(b), b == b',')).unwrap_or(&b',');
        let too_wide = || {
            let what = format!("{}: more than {MAX_COLUMNS} columns", path.display());
            MapError::new(what, "a table has a row for each moment: is it lying on its side?")
        };
        if count(between) + 1 > MAX_COLUMNS {
            return Err(too_wide());
        }
        let mut reader = reader(path, between)?;
        let names: Vec<String> = {
            let head = reader.byte_headers().map_err(|why| unread(&why, 1, path))?;
            head.iter()
                .map(|n| String::from_utf8_lossy(n).trim().trim_start_matches('\u{feff}').to_string())
                .collect()
        };
        if names.len() > MAX_COLUMNS {
            return Err(too_wide());
        }
        if names.iter().all(|n| n.is_empty()) {
            return Err(MapError::new(
                format!("{}: it is empty", path.display()),
                "a table has a head and rows",
            ));
        }
        if names.iter().all(|n| n.parse::<f64>().is_ok()) {
            let what = format!("{}: line 1 holds numbers, and no names", path.display());
            return Err(MapError::new(what, "put a line with the names of the columns in front"));
        }
        if let Some(name) = names.iter().enumerate().find(|(k, n)| names[..*k].contains(n)).map(|x| x.1) {
            let what = format!("{}: two columns are called `{name}`", path.display());
            return Err(MapError::new(what, "give each its own name in line 1"));
        }
        let mut holds = vec![Holds::Nothing; names.len()];
        let (mut record, mut rows) = (ByteRecord::new(), 0);
        while next(&mut reader, &mut record, path)? {
            rows += 1;
            for (own, cell) in holds.iter_mut().zip(&record) {
                if *own < Holds::Text {
                    *own = (*own).max(held(cell));
                }
            }
        }
        let field = |(name, holds): (String, Holds)| {
            let kind = match holds {
                Holds::Whole => DataType::Int64,
                Holds::Nothing | Holds::Number => DataType::Float64,
                Holds::Text => DataType::Utf8,
            };
            Field::new(name, kind, true)
        };
        let fields: Vec<Field> = names.into_iter().zip(holds).map(field).collect();
        Ok(Csv { path: path.into(), between, schema: Arc::new(Schema::new(fields)), rows, bytes })
    }
}

fn reader(path: &Path, between: u8) -> Result<Reader<Lines>, MapError> {
    let file = File::open(path).map_err(|why| unreadable(path, &why))?;
    Ok(ReaderBuilder::new().delimiter(between).buffer_capacity(AHEAD).from_reader(Lines { file, since: 0 }))
}

/// The next row; whether there is one.
fn next(reader: &mut Reader<Lines>, record: &mut ByteRecord, path: &Path) -> Result<bool, MapError> {
    reader.get_mut().since = 0;
    let start = reader.position().line();
    reader.read_byte_record(record).map_err(|why| unread(&why, start, path))
}

/// Why the line that begins as this one is none.
fn unread(why: &csv::Error, start: u64, path: &Path) -> MapError {
    match why.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            let what = format!(
                "{}: line {line} has {len} values, and the head {expected_len} names",
                path.display()
            );
            MapError::new(what, "was it copied whole? a comma in a text stands between quotes")
        }
        csv::ErrorKind::Io(why) if why.kind() == std::io::ErrorKind::Other => {
            let what = format!("{}: line {start} does not end within {} MB", path.display(), LONGEST >> 20);
            let hint = match start {
                1 => "a table has a row for each moment: is it lying on its side?",
                _ => "is a quote opened there, and never closed?",
            };
            MapError::new(what, hint)
        }
        _ => broken(path, why),
    }
}

/// A row in as many bytes as it has: a record keeps the room of the longest before it.
fn fitted(record: &ByteRecord) -> ByteRecord {
    let mut own = ByteRecord::with_capacity(record.as_slice().len(), record.len());
    own.extend(record);
    own.set_position(record.position().cloned());
    own
}

fn is_missing(cell: &[u8]) -> bool {
    cell.is_empty() || [&b"NA"[..], b"null", b"NULL"].contains(&cell)
}

fn held(cell: &[u8]) -> Holds {
    let cell = cell.trim_ascii();
    if is_missing(cell) {
        return Holds::Nothing;
    }
    let Ok(text) = str::from_utf8(cell) else { return Holds::Text };
    let digits = text.trim_start_matches('-');
    // `007` is a name, and would lose its zeros.
    let is_padded = digits.len() > 1 && digits.starts_with('0') && digits.as_bytes()[1].is_ascii_digit();
    // A number with more digits than are kept is a name, too.
    let is_long = digits.bytes().all(|b| b.is_ascii_digit()) && text.parse::<i64>().is_err();
    if !is_padded && text.parse::<i64>().is_ok() {
        Holds::Whole
    } else if !is_padded && !is_long && text.parse::<f64>().is_ok() {
        Holds::Number
    } else {
        Holds::Text
    }
}

impl Source for Csv {
    fn schema(&self) -> SchemaRef {
        self.schema.clone()
    }

    fn rows(&self) -> Option<u64> {
        Some(self.rows)
    }

    fn width(&self, _: &[usize]) -> usize {
        // The text and its records, and the numbers.
        let text = self.bytes / self.rows.max(1);
        usize::try_from(2 * text).unwrap_or(usize::MAX) + 32 * self.schema.fields().len()
    }

    fn loads(self: Box<Self>, columns: Vec<usize>, rows: usize) -> Result<Loads, MapError> {
        let mut reader = reader(&self.path, self.between)?;
        Ok(Box::new(std::iter::from_fn(move || {
            let mut records = Vec::with_capacity(rows.min(1 << 16));
            let (mut record, mut text) = (ByteRecord::new(), 0);
            while records.len() < rows && text < TEXT {
                match next(&mut reader, &mut record, &self.path) {
                    Ok(true) => {
                        text += record.as_slice().len();
                        records.push(fitted(&record));
                    }
                    Ok(false) => break,
                    Err(why) => return Some(Err(why)),
                }
            }
            if records.is_empty() {
                return None;
            }
            let (schema, columns, path) = (self.schema.clone(), columns.clone(), self.path.clone());
            let load: Load = Box::new(move || batch(&schema, &columns, &records, &path));
            Some(Ok(load))
        })))
    }
}

fn batch(
    schema: &SchemaRef,
    columns: &[usize],
    records: &[ByteRecord],
    path: &Path,
) -> Result<RecordBatch, MapError> {
    let one = |&k: &usize| -> Result<ArrayRef, MapError> {
        let cells = records.iter().map(|r| {
            (r.position().map_or(0, csv::Position::line), r.get(k).unwrap_or_default().trim_ascii())
        });
        // The file was another one when its columns were looked at.
        let changed = |line: u64, cell: &[u8]| {
            let what =
                format!("{}: line {line}: `{}` is no number", path.display(), String::from_utf8_lossy(cell));
            MapError::new(what, "is it still being written?")
        };
        Ok(match schema.field(k).data_type() {
            DataType::Int64 => numbers::<Int64Type>(cells, changed)?,
            DataType::Float64 => numbers::<Float64Type>(cells, changed)?,
            _ => {
                let mut built = StringBuilder::new();
                for r in records {
                    let cell = r.get(k).unwrap_or_default();
                    let text = str::from_utf8(cell).map_err(|_| {
                        let line = r.position().map_or(0, csv::Position::line);
                        MapError::new(
                            format!("{}: line {line} is no UTF-8", path.display()),
                            "write it as UTF-8",
                        )
                    })?;
                    built.append_value(text);
                }
                Arc::new(built.finish())
            }
        })
    };
    let arrays: Vec<ArrayRef> = columns.iter().map(one).collect::<Result<_, _>>()?;
    let fields: Vec<_> = columns.iter().map(|&k| schema.fields()[k].clone()).collect();
    RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).map_err(|why| broken(path, &why))
}

/// Cells as numbers, each with its line; what is missing is null.
fn numbers<'a, T: ArrowPrimitiveType<Native: FromStr>>(
    cells: impl Iterator<Item = (u64, &'a [u8])>,
    changed: impl Fn(u64, &[u8]) -> MapError,
) -> Result<ArrayRef, MapError> {
    let mut built = PrimitiveBuilder::<T>::with_capacity(cells.size_hint().0);
    for (line, cell) in cells {
        let x = str::from_utf8(cell).ok().and_then(|t| t.parse().ok());
        match x {
            _ if is_missing(cell) => built.append_null(),
            Some(x) => built.append_value(x),
            None => return Err(changed(line, cell)),
        }
    }
    Ok(Arc::new(built.finish()))
}
