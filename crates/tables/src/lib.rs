//! Tables of numbers out of the bytes of files: CSV in its dialects, JSON and JSON Lines, NumPy's NPY and NPZ, and Parquet with the
//! feature `parquet`.
//!
//! What was taken for what is said in [`Table::remarks`]; what is no number is none in the column, with its place. A broken file is
//! an error with its place and a hint. Nothing here panics on what it reads, or takes more memory than a few times its size.

mod csv;
mod json;
mod npy;
#[cfg(feature = "parquet")]
mod parquet;
mod zip;

pub use crate::csv::written;
use std::fmt;

/// The most columns that a table may have.
pub const MAX_COLUMNS: usize = 4096;
/// The most numbers that a table may have.
pub const MAX_NUMBERS: usize = 200_000_000;

/// A table of numbers.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Table {
    /// Its columns, all of one length.
    pub columns: Vec<Column>,
    /// The number of the first row in the file, as one counts there: a line of a text, 1 elsewhere.
    pub first_row: usize,
    /// How the file was read, and what in it is no number.
    pub remarks: Vec<String>,
}

/// A column.
#[derive(Clone, PartialEq, Debug)]
pub struct Column {
    /// Its name, without its unit.
    pub name: String,
    /// The unit behind or in its name, as it stands there.
    pub unit: Option<String>,
    /// Its numbers; not a number where there is none.
    pub values: Vec<f64>,
}

/// What kind of file bytes are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Values with commas, semicolons, tabs or blanks between them.
    Csv,
    /// A value of JSON a line, or one value of columns or rows.
    Json,
    /// An array of NumPy's.
    Npy,
    /// Several of them.
    Npz,
    /// Columns in Parquet.
    Parquet,
}

impl Kind {
    /// By the ending of a file's name.
    pub fn of(name: &str) -> Option<Self> {
        let ending = name.rsplit_once('.')?.1.to_lowercase();
        Some(match ending.as_str() {
            "csv" | "tsv" | "dat" | "log" => Kind::Csv,
            "json" | "jsonl" | "ndjson" => Kind::Json,
            "npy" => Kind::Npy,
            "npz" => Kind::Npz,
            "parquet" => Kind::Parquet,
            _ => return None,
        })
    }
}

/// Why bytes are no table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TableError {
    /// What is the matter, with its place.
    pub what: String,
    /// What to do.
    pub hint: String,
    /// Whether they may be another kind of text: nothing in them is a number.
    pub is_other: bool,
}

impl TableError {
    /// With a hint.
    pub(crate) fn new(what: impl Into<String>, hint: impl Into<String>) -> Self {
        TableError { what: what.into(), hint: hint.into(), is_other: false }
    }
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n  = hint: {}", self.what, self.hint)
    }
}

impl std::error::Error for TableError {}

/// Reads a table.
///
/// # Errors
/// If the bytes are no table of this kind.
pub fn read(bytes: &[u8], kind: Kind) -> Result<Table, TableError> {
    let mut table = match kind {
        Kind::Csv => csv::read(bytes)?,
        Kind::Json => json::read(bytes)?,
        Kind::Npy => npy::read(bytes)?,
        Kind::Npz => npy::read_all(bytes)?,
        #[cfg(feature = "parquet")]
        Kind::Parquet => parquet::read(bytes)?,
        #[cfg(not(feature = "parquet"))]
        Kind::Parquet => {
            let hint = "build with the feature `parquet`, or convert the file to CSV";
            return Err(TableError::new("files in Parquet are not read by this build", hint));
        }
    };
    table.split_units();
    if table.columns.is_empty() {
        let hint = "a recording has a column for each joint";
        let why = TableError::new("there is no column of numbers", hint);
        return Err(TableError { is_other: kind == Kind::Csv, ..why });
    }
    Ok(table)
}

impl Table {
    /// Takes units out of the names of columns.
    pub fn split_units(&mut self) {
        for column in self.columns.iter_mut().filter(|c| c.unit.is_none()) {
            (column.name, column.unit) = with_unit(&column.name);
        }
    }

    /// Puts the rows of another table behind its own; a column that one of them has not is not a number there.
    ///
    /// # Errors
    /// If both together are too large.
    pub fn append(&mut self, other: Table) -> Result<(), TableError> {
        let rows = |t: &Table| t.columns.first().map_or(0, |c| c.values.len());
        let (own, more) = (rows(self), rows(&other));
        for column in other.columns {
            match self.columns.iter_mut().find(|c| c.name == column.name) {
                Some(c) => c.values.extend(column.values),
                None => {
                    let mut values = vec![f64::NAN; own];
                    values.extend(column.values);
                    self.columns.push(Column { values, ..column });
                }
            }
        }
        self.columns.iter_mut().for_each(|c| c.values.resize(own + more, f64::NAN));
        if self.columns.len() > MAX_COLUMNS || (own + more) * self.columns.len() > MAX_NUMBERS {
            let hint = format!("at most {MAX_COLUMNS} columns and {MAX_NUMBERS} numbers can be read");
            return Err(TableError::new(
                format!("{} rows of {} columns", own + more, self.columns.len()),
                hint,
            ));
        }
        for remark in other.remarks {
            if !self.remarks.contains(&remark) {
                self.remarks.push(remark);
            }
        }
        Ok(())
    }
}

/// A name and its unit: in brackets, or behind the last underscore.
fn with_unit(name: &str) -> (String, Option<String>) {
    let name = name.trim();
    for (open, close) in [('[', ']'), ('(', ')'), ('{', '}')] {
        if let Some(inner) = name.strip_suffix(close)
            && let Some((before, unit)) = inner.rsplit_once(open)
            && !before.trim().is_empty()
            && !unit.is_empty()
            && !unit.chars().all(|c| c.is_ascii_digit() || c == ',' || c == ' ')
        {
            return (before.trim().into(), Some(unit.trim().into()));
        }
    }
    for unit in ["deg", "rad", "mm", "cm", "ms", "us", "ns", "sec"] {
        if let Some(before) = name.strip_suffix(unit).and_then(|n| n.strip_suffix(['_', '.', ' ', '-']))
            && !before.is_empty()
        {
            return (before.into(), Some(unit.into()));
        }
    }
    (name.into(), None)
}

/// The first few of many places, in words.
pub(crate) fn some(places: &[String], many: usize) -> String {
    let shown: Vec<&str> = places.iter().take(5).map(String::as_str).collect();
    let more = if many > shown.len() { format!(", and {} more", many - shown.len()) } else { String::new() };
    format!("{}{more}", shown.join(", "))
}
