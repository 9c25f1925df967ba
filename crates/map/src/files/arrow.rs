//! Arrow's own files, batch by batch.

use super::broken::{broken, unreadable, unwritable};
use super::pipeline::{Encoded, Encoder, Sink};
use super::temporary::Temporary;
use super::{Load, Loads, PART_ROWS, Source};
use crate::{Counts, MapError};
use arrow_array::RecordBatch;
use arrow_ipc::reader::FileReader;
use arrow_ipc::root_as_footer;
use arrow_ipc::writer::FileWriter;
use arrow_schema::SchemaRef;
use std::collections::VecDeque;
use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Bytes of the largest batch that is read.
const BATCH: i64 = 128 << 20;

/// A file of Arrow's that is read.
pub struct Reading {
    path: PathBuf,
    reader: FileReader<BufReader<File>>,
    schema: SchemaRef,
    width: usize,
}

impl Reading {
    /// Opens one.
    ///
    /// # Errors
    /// If it is none, is cut off, or its batches are too large.
    pub fn open(path: &Path, mut file: File) -> Result<Self, MapError> {
        let largest = largest(&mut file).map_err(|why| broken(path, &why))?;
        if largest > BATCH {
            return Err(MapError::new(
                format!("{}: a batch has {} MB", path.display(), largest >> 20),
                format!("batches are read whole, up to {} MB: write smaller ones, or Parquet", BATCH >> 20),
            ));
        }
        file.seek(SeekFrom::Start(0)).map_err(|why| unreadable(path, &why))?;
        let reader = FileReader::try_new(BufReader::with_capacity(1 << 20, file), None)
            .map_err(|why| broken(path, &why))?;
        let schema = reader.schema();
        let width = schema.fields().iter().map(|f| f.data_type().primitive_width().unwrap_or(64)).sum();
        Ok(Reading { path: path.into(), reader, schema, width })
    }
}

/// Bytes of the largest batch, as the end of the file says.
fn largest(file: &mut File) -> Result<i64, String> {
    let said = |e: std::io::Error| e.to_string();
    let length = file.seek(SeekFrom::End(0)).map_err(said)?;
    let start = length.checked_sub(10).ok_or("it is no file of Arrow's, or cut off")?;
    file.seek(SeekFrom::Start(start)).map_err(said)?;
    let mut tail = [0; 10];
    file.read_exact(&mut tail).map_err(said)?;
    if &tail[4..] != b"ARROW1" {
        return Err("it does not end as Arrow's files do".into());
    }
    let footer = u64::from(u32::from_le_bytes([tail[0], tail[1], tail[2], tail[3]]));
    let place = start.checked_sub(footer).filter(|_| footer <= 32 << 20).ok_or("its end is broken")?;
    file.seek(SeekFrom::Start(place)).map_err(said)?;
    let mut bytes = vec![0; usize::try_from(footer).unwrap_or(0)];
    file.read_exact(&mut bytes).map_err(said)?;
    let footer = root_as_footer(&bytes).map_err(|why| why.to_string())?;
    let batches = footer.recordBatches().into_iter().flatten();
    let most = i64::try_from(length).unwrap_or(i64::MAX);
    let mut largest = 0;
    for block in batches {
        let end = block.offset().checked_add(block.bodyLength());
        if block.offset() < 0 || block.bodyLength() < 0 || end.is_none_or(|end| end > most) {
            return Err("a batch lies outside of it".into());
        }
        largest = largest.max(block.bodyLength());
    }
    Ok(largest)
}

impl Source for Reading {
    fn schema(&self) -> SchemaRef {
        self.schema.clone()
    }

    fn rows(&self) -> Option<u64> {
        None
    }

    fn width(&self, _: &[usize]) -> usize {
        self.width
    }

    fn loads(self: Box<Self>, columns: Vec<usize>, rows: usize) -> Result<Loads, MapError> {
        let Reading { path, mut reader, .. } = *self;
        let rows = rows.min(PART_ROWS);
        let mut open: VecDeque<RecordBatch> = VecDeque::new();
        Ok(Box::new(std::iter::from_fn(move || {
            while open.is_empty() {
                let batch = match reader.next()? {
                    Ok(batch) => batch,
                    Err(why) => return Some(Err(broken(&path, &why))),
                };
                let batch = match batch.project(&columns) {
                    Ok(batch) => batch,
                    Err(why) => return Some(Err(broken(&path, &why))),
                };
                let all = batch.num_rows();
                open.extend((0..all).step_by(rows).map(|k| batch.slice(k, rows.min(all - k))));
            }
            let batch = open.pop_front()?;
            let load: Load = Box::new(move || Ok(batch));
            Some(Ok(load))
        })))
    }
}

/// A file of Arrow's that is written.
pub struct Writing {
    path: PathBuf,
    temporary: Temporary,
    file: File,
    writer: FileWriter<BufWriter<File>>,
}

impl Writing {
    /// Begins a file.
    ///
    /// # Errors
    /// If it cannot be made.
    pub fn new(path: &Path, schema: &SchemaRef) -> Result<Self, MapError> {
        let (temporary, file) = Temporary::new(path)?;
        let own = file.try_clone().map_err(|why| unwritable(path, &why))?;
        let writer = FileWriter::try_new(BufWriter::with_capacity(1 << 20, own), schema)
            .map_err(|why| unwritable(path, &why))?;
        Ok(Writing { path: path.into(), temporary, file, writer })
    }
}

impl Sink for Writing {
    fn encoder(&self) -> Arc<Encoder> {
        Arc::new(|_, batch: &RecordBatch, _: &Counts| Ok(Encoded::Batch(batch.clone())))
    }

    fn write(&mut self, part: Encoded) -> Result<(), MapError> {
        let Encoded::Batch(batch) = part else { return Ok(()) };
        self.writer.write(&batch).map_err(|why| unwritable(&self.path, &why))
    }

    fn finish(mut self: Box<Self>) -> Result<(), MapError> {
        self.writer.finish().map_err(|why| unwritable(&self.path, &why))?;
        let file = self.writer.into_inner().map_err(|why| unwritable(&self.path, &why))?;
        file.into_inner().map_err(|why| unwritable(&self.path, &why))?;
        self.temporary.keep(&self.file)
    }
}
