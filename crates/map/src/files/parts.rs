//! Parts as files of their own, so that what was computed is not computed again.
//!
//! Beside `out.parquet` a folder `out.parquet.parts` holds `plan.json`, which says what the parts are parts of, and `part-N.parquet`,
//! each of which takes its name when it is whole. When all are there their row groups are copied, as they are, into one file, and the
//! folder is removed.

use super::at::At;
use super::broken::{broken, unreadable, unwritable};
use super::parquet_in::Parquet;
use super::parquet_out::{begin, properties};
use super::pipeline::{Encoded, Encoder, Sink};
use super::temporary::Temporary;
use super::{Compression, Job};
use crate::{Counts, MapError};
use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;
use parquet::arrow::ArrowWriter;
use parquet::column::writer::ColumnCloseResult;
use parquet::file::metadata::{KeyValue, ParquetMetaDataReader};
use serde_json::{Value, json};
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::UNIX_EPOCH;

/// The counts of a part, in its metadata.
const COUNTS: &str = "denavit.counts";

/// A folder of parts, and the file that they become.
pub struct Parts {
    output: PathBuf,
    folder: PathBuf,
    /// Held until the folder is done with: one program at a time.
    _lock: File,
    schema: SchemaRef,
    compression: Compression,
    /// How many parts there are.
    count: usize,
}

impl Parts {
    /// Opens the folder, or makes it; and the counts of those parts that are there.
    ///
    /// # Errors
    /// If what is there belongs to something else, or cannot be read or written.
    pub fn open(
        job: &Job,
        schema: &SchemaRef,
        what: &str,
        total: u64,
        rows: usize,
    ) -> Result<(Self, Vec<Option<Counts>>), MapError> {
        let mut name = job.output.file_name().map(ToOwned::to_owned).unwrap_or_default();
        name.push(".parts");
        let folder = job.output.with_file_name(name);
        let unwritable = |why: std::io::Error| unwritable(&folder, &why);
        fs::create_dir_all(&folder).map_err(unwritable)?;
        let lock = File::create(folder.join("lock")).map_err(unwritable)?;
        if let Err(why) = lock.try_lock() {
            let TryLockError::WouldBlock = why else { return Err(unwritable(why.into())) };
            let what = format!("{} is being written by another program", folder.display());
            return Err(MapError::new(what, "wait for it, or write to another file"));
        }
        let plan = plan(job, schema, what, total, rows)?;
        let count = usize::try_from(plan["parts"].as_u64().unwrap_or(0)).unwrap_or(0);
        let path = folder.join("plan.json");
        match fs::read(&path) {
            Ok(bytes) => {
                let old: Value = serde_json::from_slice(&bytes).map_err(|why| broken(&path, &why))?;
                if let Some(other) = difference(&old, &plan) {
                    return Err(MapError::new(
                        format!("{} was begun with another {other}", folder.display()),
                        "remove the folder, or leave --resume away",
                    ));
                }
            }
            Err(_) => {
                let (temporary, file) = Temporary::new(&path)?;
                serde_json::to_writer_pretty(&file, &plan).map_err(|why| broken(&path, &why))?;
                temporary.keep(&file)?;
            }
        }
        let there = (0..count).map(|k| counts(&part(&folder, k))).collect();
        let compression = job.compression;
        Ok((
            Parts {
                output: job.output.clone(),
                folder,
                _lock: lock,
                schema: schema.clone(),
                compression,
                count,
            },
            there,
        ))
    }
}

fn part(folder: &Path, number: usize) -> PathBuf {
    folder.join(format!("part-{number:06}.parquet"))
}

/// What the parts are parts of.
fn plan(job: &Job, schema: &SchemaRef, what: &str, total: u64, rows: usize) -> Result<Value, MapError> {
    let input = File::open(&job.input).map_err(|why| unreadable(&job.input, &why))?;
    let metadata = input.metadata().map_err(|why| unreadable(&job.input, &why))?;
    let changed = metadata.modified().ok().and_then(|t| t.duration_since(UNIX_EPOCH).ok());
    let changed = changed.map_or(0, |t| u64::try_from(t.as_nanos()).unwrap_or(0));
    let named = job.input.canonicalize().unwrap_or_else(|_| job.input.clone());
    let source = Parquet::open(&job.input, input)?;
    let columns: Vec<String> =
        schema.fields().iter().map(|f| format!("{} {}", f.name(), f.data_type())).collect();
    Ok(json!({
        "version": env!("CARGO_PKG_VERSION"),
        "request": what,
        "input": { "path": named.to_string_lossy(), "bytes": metadata.len(), "changed": changed },
        "columns": columns,
        "compression": format!("{:?}", job.compression),
        "rows": total,
        "rows of a part": rows,
        "parts": source.part_count(rows),
    }))
}

/// What is not the same.
fn difference(old: &Value, new: &Value) -> Option<String> {
    let keys = new.as_object()?.keys();
    let mut other = keys.filter(|key| old.get(key) != new.get(key));
    other.next().map(|key| if key == "version" { "version of denavit".into() } else { key.clone() })
}

/// The counts of a part that is there and whole.
fn counts(path: &Path) -> Option<Counts> {
    let file = File::open(path).ok()?;
    let metadata = ParquetMetaDataReader::new().parse_and_finish(&At::new(file).ok()?).ok()?;
    let pairs = metadata.file_metadata().key_value_metadata()?;
    let text = pairs.iter().find(|p| p.key == COUNTS)?.value.clone()?;
    let numbers: Vec<Option<u64>> = serde_json::from_str(&text).ok()?;
    let &[Some(rows), Some(nulls), Some(not_finite), Some(no_pose), Some(more_solutions), first_fault] =
        &numbers[..]
    else {
        return None;
    };
    let is_whole = u64::try_from(metadata.file_metadata().num_rows()) == Ok(rows);
    is_whole.then_some(Counts { rows, nulls, not_finite, no_pose, more_solutions, first_fault })
}

impl Sink for Parts {
    fn encoder(&self) -> Arc<Encoder> {
        let (folder, schema, compression) = (self.folder.clone(), self.schema.clone(), self.compression);
        Arc::new(move |k, batch: &RecordBatch, c: &Counts| {
            let path = part(&folder, k);
            let (temporary, file) = Temporary::new(&path)?;
            let own = file.try_clone().map_err(|why| unwritable(&path, &why))?;
            let write = || -> parquet::errors::Result<()> {
                let mut writer =
                    ArrowWriter::try_new(own, schema.clone(), Some(properties(&schema, compression)))?;
                writer.write(batch)?;
                let said = json!([c.rows, c.nulls, c.not_finite, c.no_pose, c.more_solutions, c.first_fault]);
                writer.append_key_value_metadata(KeyValue::new(COUNTS.into(), said.to_string()));
                writer.close().map(drop)
            };
            write().map_err(|why| unwritable(&path, &why))?;
            temporary.keep(&file)?;
            Ok(Encoded::File)
        })
    }

    fn write(&mut self, _: Encoded) -> Result<(), MapError> {
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), MapError> {
        let (temporary, file) = Temporary::new(&self.output)?;
        let own = file.try_clone().map_err(|why| unwritable(&self.output, &why))?;
        let join = || -> parquet::errors::Result<()> {
            let (mut writer, _) = begin(own, &self.schema, self.compression)?;
            for k in 0..self.count {
                let at = At::new(File::open(part(&self.folder, k))?)?;
                let metadata = ParquetMetaDataReader::new().parse_and_finish(&at)?;
                for group in metadata.row_groups() {
                    let mut into = writer.next_row_group()?;
                    for column in group.columns() {
                        let closed = ColumnCloseResult {
                            bytes_written: u64::try_from(column.compressed_size()).unwrap_or(0),
                            rows_written: u64::try_from(group.num_rows()).unwrap_or(0),
                            metadata: column.clone(),
                            bloom_filter: None,
                            column_index: None,
                            offset_index: None,
                        };
                        into.append_column(&at, closed)?;
                    }
                    into.close()?;
                }
            }
            writer.close().map(drop)
        };
        join().map_err(|why| unwritable(&self.output, &why))?;
        temporary.keep(&file)?;
        fs::remove_dir_all(&self.folder).map_err(|why| unwritable(&self.folder, &why))
    }
}
