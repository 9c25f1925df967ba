//! Files of columns, mapped part by part: read, computed and encoded by several threads, in order and in bounded memory.
//!
//! A part is a stretch of rows, of at most so many bytes as [`PART`] says; where parts begin follows from the file alone, so that the
//! result has the same bytes whatever the number of threads is. What is written stands in a temporary file beside the result, which
//! takes its name when all is done. With [`Job::resume`] each part is a file of its own until then.

mod arrow;
mod at;
mod broken;
mod csv_in;
mod csv_out;
mod npz_in;
mod npz_out;
mod order;
mod parquet_in;
mod parquet_out;
mod parts;
mod pipeline;
mod temporary;

pub use pipeline::{Step, run_with};

use crate::{Counts, MapError, Mapping};
use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;
use broken::unreadable;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The most columns that a file may have.
pub const MAX_COLUMNS: usize = 4096;
/// Bytes of a part, read and computed together, as numbers.
pub const PART: usize = 12 << 20;
/// Rows of a part at most.
pub const PART_ROWS: usize = 1 << 17;
/// The most threads that work where nobody says how many.
pub const THREADS: usize = 8;

/// From which file to which, and how.
#[derive(Clone, Debug)]
pub struct Job {
    /// What is read.
    pub input: PathBuf,
    /// What is written.
    pub output: PathBuf,
    /// How Parquet is packed.
    pub compression: Compression,
    /// How many threads work.
    pub threads: usize,
    /// A column that may not go back: the time.
    pub ordered: Option<String>,
    /// Whether rows without numbers are refused.
    pub strict: bool,
    /// Whether parts are kept beside the result until all are there, and what says what they are parts of.
    pub resume: Option<String>,
}

/// How Parquet is packed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Compression {
    /// Quick.
    #[default]
    Snappy,
    /// Small.
    Gzip,
    /// Not at all.
    None,
}

/// What was done.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Summary {
    /// Rows.
    pub counts: Counts,
    /// Parts that were there already.
    pub resumed: usize,
    /// Parts.
    pub parts: usize,
}

/// A kind of file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Columns in row groups.
    Parquet,
    /// Arrow's own, also called Feather.
    Arrow,
    /// A text.
    Csv,
    /// Arrays of NumPy's.
    Npz,
}

impl Kind {
    /// By the ending of a name.
    ///
    /// # Errors
    /// If it is none of these.
    pub fn of(path: &Path) -> Result<Self, MapError> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("parquet" | "pq") => Ok(Kind::Parquet),
            Some("arrow" | "feather" | "ipc") => Ok(Kind::Arrow),
            Some("csv" | "tsv") => Ok(Kind::Csv),
            Some("npz") => Ok(Kind::Npz),
            _ => Err(MapError::new(
                format!("{}: no kind of table ends like this", path.display()),
                "map reads and writes .parquet, .arrow, .csv, .tsv and .npz",
            )),
        }
    }
}

/// Reads a part; on whichever thread calls it.
pub type Load = Box<dyn FnOnce() -> Result<RecordBatch, MapError> + Send>;
/// The parts of a file, in order.
pub type Loads = Box<dyn Iterator<Item = Result<Load, MapError>> + Send>;

/// A file that is read.
pub trait Source: Send {
    /// Its columns.
    fn schema(&self) -> SchemaRef;
    /// How many rows it has, where that is known.
    fn rows(&self) -> Option<u64>;
    /// About how many bytes a row of these columns takes.
    fn width(&self, columns: &[usize]) -> usize;
    /// These columns, in parts of so many rows at most.
    ///
    /// # Errors
    /// If the file cannot be read.
    fn loads(self: Box<Self>, columns: Vec<usize>, rows: usize) -> Result<Loads, MapError>;
}

/// Opens a file.
///
/// # Errors
/// If it cannot be read, or has no columns or too many.
pub fn open(path: &Path) -> Result<Box<dyn Source>, MapError> {
    let kind = Kind::of(path)?;
    let file = std::fs::File::open(path).map_err(|why| unreadable(path, &why))?;
    if file.metadata().is_ok_and(|m| m.is_dir()) {
        let hint = "map takes one file; of a folder of Parquet files each, one after the other";
        return Err(MapError::new(format!("{} is a folder", path.display()), hint));
    }
    let source: Box<dyn Source> = match kind {
        Kind::Parquet => Box::new(parquet_in::Parquet::open(path, file)?),
        Kind::Arrow => Box::new(arrow::Reading::open(path, file)?),
        Kind::Csv => Box::new(csv_in::Csv::open(path)?),
        Kind::Npz => Box::new(npz_in::Npz::open(path, file)?),
    };
    let count = source.schema().fields().len();
    if count == 0 || count > MAX_COLUMNS {
        return Err(MapError::new(
            format!("{}: {count} columns", path.display()),
            format!(
                "a table has a row for each moment, and 1 to {MAX_COLUMNS} columns: is it lying on its side?"
            ),
        ));
    }
    Ok(source)
}

/// Maps a file. `progress` hears how many rows are done, of how many where that is known.
///
/// # Errors
/// If something cannot be read, computed or written; then nothing stands where the result was to be, or what stood there before.
pub fn run(
    job: &Job,
    mapping: &Mapping,
    progress: &mut dyn FnMut(u64, Option<u64>),
) -> Result<Summary, MapError> {
    let same = |a: &Path, b: &Path| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if same(&job.input, &job.output) {
        let what = format!("{} is what is read and what is to be written", job.output.display());
        return Err(MapError::new(what, "write to another file"));
    }
    let source = open(&job.input)?;
    let of_input = |why: MapError| MapError { what: format!("{}: {}", job.input.display(), why.what), ..why };
    let bound = mapping.bind(&source.schema()).map_err(of_input)?;
    let (columns, schema) = (bound.needed(), bound.schema().clone());
    let mut columns = columns;
    let ordered = job.ordered.as_ref().map(|name| order::find(&source.schema(), name)).transpose();
    let ordered = ordered.map_err(of_input)?;
    // The time may be a column that does not go through.
    let with_order = ordered.filter(|k| !columns.contains(k));
    columns.extend(with_order);
    columns.sort_unstable();
    let place = |k: usize| columns.binary_search(&k).unwrap_or_default();
    let bound = bound.placed(place);
    let computed = schema.fields().len() - bound.kept();
    let width = source.width(&columns) + 8 * computed * bound.fanout();
    let rows = (PART / width.max(1)).clamp(1, PART_ROWS);
    let step: Arc<Step> = Arc::new(move |batch: &RecordBatch| bound.run(batch));
    let ordered = ordered.map(place);
    run_with(job, source, columns.clone(), rows, schema, step, ordered, progress)
}
