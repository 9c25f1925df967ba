//! Parquet, read by stretches of rows.

use super::at::At;
use super::broken::{broken, unreadable};
use super::{Load, Loads, MAX_COLUMNS, Source};
use crate::MapError;
use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;
use arrow_select::concat::concat_batches;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{
    ArrowReaderMetadata, ArrowReaderOptions, ParquetRecordBatchReaderBuilder,
};
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData, RowGroupMetaData};
use std::fs::File;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

/// Bytes that the description of a file may take.
const FOOTER: u32 = 32 << 20;
/// Bytes of a row group's column beyond which nothing is believed.
const CHUNK: i64 = 1 << 40;

/// A file of Parquet.
pub struct Parquet {
    path: PathBuf,
    at: At,
    metadata: ArrowReaderMetadata,
}

/// Rows of row groups that are next to each other.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Stretch {
    groups: Vec<usize>,
    /// So many rows of these are left out in front.
    skipped: usize,
    rows: usize,
}

impl Parquet {
    /// Opens one.
    ///
    /// # Errors
    /// If it is none, is cut off, or has too many columns.
    pub fn open(path: &Path, file: File) -> Result<Self, MapError> {
        let at = At::new(file).map_err(|why| unreadable(path, &why))?;
        let tail = at.length().checked_sub(8).filter(|_| at.length() >= 12);
        let tail = tail.and_then(|place| at.exactly(place, 8).ok());
        let tail = tail.ok_or_else(|| broken(path, &"it is no Parquet, or cut off"))?;
        if &tail[4..] != b"PAR1" {
            return Err(broken(path, &"it does not end as Parquet does"));
        }
        let footer = u32::from_le_bytes([tail[0], tail[1], tail[2], tail[3]]);
        if footer > FOOTER {
            return Err(MapError::new(
                format!("{}: its description has {} MB", path.display(), footer >> 20),
                format!(
                    "it may have {}, as of {MAX_COLUMNS} columns or 100,000 row groups: write larger row groups, or a row for each moment",
                    FOOTER >> 20
                ),
            ));
        }
        // The reader takes what a file says of itself on trust here and there.
        let metadata = catch_unwind(std::panic::AssertUnwindSafe(|| {
            ArrowReaderMetadata::load(&at, ArrowReaderOptions::new())
        }));
        let metadata = metadata
            .map_err(|_| broken(path, &"its description is broken"))?
            .map_err(|why| broken(path, &why))?;
        if !is_within(metadata.metadata(), at.length()) {
            return Err(broken(path, &"a column lies outside of it"));
        }
        Ok(Parquet { path: path.into(), at, metadata })
    }

    /// How many parts of at most so many rows there are.
    pub fn part_count(&self, rows: usize) -> usize {
        self.stretches(rows).len()
    }

    /// The stretches of at most so many rows.
    fn stretches(&self, most: usize) -> Vec<Stretch> {
        let rows = |g: &RowGroupMetaData| usize::try_from(g.num_rows()).unwrap_or(0);
        stretches(self.metadata.metadata().row_groups().iter().map(rows), most)
    }
}

/// Row groups cut where they are larger, and put together where they are smaller.
pub fn stretches(groups: impl Iterator<Item = usize>, most: usize) -> Vec<Stretch> {
    let mut all: Vec<Stretch> = vec![];
    let mut open = Stretch { groups: vec![], skipped: 0, rows: 0 };
    for (k, rows) in groups.enumerate().filter(|g| g.1 > 0) {
        if open.rows + rows > most && open.rows > 0 {
            all.push(std::mem::replace(&mut open, Stretch { groups: vec![], skipped: 0, rows: 0 }));
        }
        if rows <= most {
            open.groups.push(k);
            open.rows += rows;
            continue;
        }
        // Pieces of one size, so that the last is not much smaller.
        let pieces = rows.div_ceil(most);
        let size = rows.div_ceil(pieces);
        for skipped in (0..rows).step_by(size.max(1)) {
            all.push(Stretch { groups: vec![k], skipped, rows: size.min(rows - skipped) });
        }
    }
    if open.rows > 0 {
        all.push(open);
    }
    all
}

/// Whether the pages of all columns lie within the file.
fn is_within(metadata: &ParquetMetaData, length: u64) -> bool {
    let most = i64::try_from(length).unwrap_or(i64::MAX);
    metadata.row_groups().iter().all(|g| {
        g.num_rows() >= 0
            && g.columns().iter().all(|c| {
                let start = c.dictionary_page_offset().unwrap_or(c.data_page_offset());
                let size = c.compressed_size();
                let is_before = start.checked_add(size).is_some_and(|end| end <= most);
                let is_sane = (0..=CHUNK).contains(&c.uncompressed_size()) && c.num_values() >= 0;
                start >= 0 && c.data_page_offset() >= 0 && size >= 0 && is_before && is_sane
            })
    })
}

impl Source for Parquet {
    fn schema(&self) -> SchemaRef {
        self.metadata.schema().clone()
    }

    fn rows(&self) -> Option<u64> {
        u64::try_from(self.metadata.metadata().file_metadata().num_rows()).ok()
    }

    fn width(&self, columns: &[usize]) -> usize {
        let metadata = self.metadata.metadata();
        let descriptor = metadata.file_metadata().schema_descr();
        let roots: Vec<usize> =
            (0..descriptor.num_columns()).map(|leaf| descriptor.get_column_root_idx(leaf)).collect();
        // The widest row group, so that no part is too large.
        let width = |g: &RowGroupMetaData| {
            let own = g.columns().iter().zip(&roots).filter(|(_, root)| columns.contains(root));
            // Texts that repeat are stored once, and read each time.
            let bytes = |c: &ColumnChunkMetaData| {
                let texts = c.unencoded_byte_array_data_bytes().unwrap_or(0);
                c.uncompressed_size().max(texts).max(8 * c.num_values())
            };
            let bytes: i64 = own.map(|(c, _)| bytes(c)).fold(0, i64::saturating_add);
            usize::try_from(bytes / g.num_rows().max(1)).unwrap_or(usize::MAX)
        };
        metadata.row_groups().iter().filter(|g| g.num_rows() > 0).map(width).max().unwrap_or(8)
    }

    fn loads(self: Box<Self>, columns: Vec<usize>, rows: usize) -> Result<Loads, MapError> {
        let stretches = self.stretches(rows);
        let descriptor = self.metadata.metadata().file_metadata().schema_descr();
        let mask = ProjectionMask::roots(descriptor, columns);
        let one = move |stretch: Stretch| -> Result<Load, MapError> {
            let Parquet { path, at, metadata } = &*self;
            let (path, at, metadata, mask) = (path.clone(), at.clone(), metadata.clone(), mask.clone());
            Ok(Box::new(move || read(&path, at, metadata, mask, stretch)))
        };
        Ok(Box::new(stretches.into_iter().map(one)))
    }
}

fn read(
    path: &Path,
    at: At,
    metadata: ArrowReaderMetadata,
    mask: ProjectionMask,
    stretch: Stretch,
) -> Result<RecordBatch, MapError> {
    let place = format!("rows {} … of row group {}", stretch.skipped + 1, stretch.groups[0] + 1);
    let broken = |why: &dyn std::fmt::Display| broken(path, &format!("{place}: {why}"));
    let rows = stretch.rows;
    let reader = ParquetRecordBatchReaderBuilder::new_with_metadata(at, metadata)
        .with_projection(mask)
        .with_row_groups(stretch.groups)
        .with_offset(stretch.skipped)
        .with_limit(rows)
        .with_batch_size(rows)
        .build()
        .map_err(|why| broken(&why))?;
    let schema = arrow_array::RecordBatchReader::schema(&reader);
    let batches: Vec<RecordBatch> = reader.collect::<Result<_, _>>().map_err(|why| broken(&why))?;
    let batch = match batches.len() {
        1 => batches.into_iter().next().ok_or_else(|| broken(&"it is empty"))?,
        _ => concat_batches(&schema, &batches).map_err(|why| broken(&why))?,
    };
    if batch.num_rows() == rows {
        Ok(batch)
    } else {
        Err(broken(&format!("{} rows of {rows} are there", batch.num_rows())))
    }
}
