//! Batches and files of tests.

use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch};
use arrow_schema::{Field, Schema};
use denavit::Description;
use denavit::catalogue;
use denavit::random::Random;
use denavit_map::files::{Compression, Job};
use denavit_map::{Frame, Mapping, Request};
use parquet::arrow::ArrowWriter;
use parquet::file::properties::WriterProperties;
use std::collections::HashMap;
use std::fs::File;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub fn ur5() -> Description {
    catalogue::robot("ur5").expect("a robot of the catalogue")
}

/// A request for poses of the tool.
pub fn fk() -> Request {
    Request { poses: vec![Frame::tool()], ..Request::default() }
}

pub fn mapping(request: &Request) -> Mapping {
    Mapping::new(&ur5(), request).expect("a mapping")
}

/// A batch of columns of numbers, with units where they are said.
pub fn batch(columns: &[(&str, Vec<f64>)]) -> RecordBatch {
    let field = |name: &str| {
        let (name, unit) = name.split_once('|').map_or((name, None), |(n, u)| (n, Some(u)));
        let unit = unit.map(|u| ("unit".to_string(), u.to_string()));
        Field::new(name, arrow_schema::DataType::Float64, true)
            .with_metadata(unit.into_iter().collect::<HashMap<_, _>>())
    };
    let fields: Vec<Field> = columns.iter().map(|c| field(c.0)).collect();
    let arrays = columns.iter().map(|c| Arc::new(Float64Array::from(c.1.clone())) as ArrayRef).collect();
    RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).expect("a batch")
}

/// Joints of so many rows, a column each.
pub fn joints(rows: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random(seed);
    (0..6).map(|_| (0..rows).map(|_| 6.0 * random.unit() - 3.0).collect()).collect()
}

/// The same as a batch `q1` … `q6`, with a time in front.
pub fn run(rows: usize, seed: u64) -> RecordBatch {
    let q = joints(rows, seed);
    let time = (0..rows).map(|k| k as f64 * 0.01).collect();
    let names: Vec<String> = (1..=6).map(|k| format!("q{k}")).collect();
    let named = names.iter().map(String::as_str).zip(q);
    batch(&std::iter::once(("time", time)).chain(named).collect::<Vec<_>>())
}

/// The numbers of a column.
pub fn numbers(batch: &RecordBatch, name: &str) -> Vec<Option<f64>> {
    let column = batch.column_by_name(name).unwrap_or_else(|| panic!("a column {name}"));
    let own = column.as_primitive::<Float64Type>();
    (0..own.len()).map(|k| own.is_valid(k).then(|| own.value(k))).collect()
}

/// A folder of its own, removed with it.
pub struct Folder(PathBuf);

impl Deref for Folder {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.0
    }
}

impl AsRef<Path> for Folder {
    fn as_ref(&self) -> &Path {
        &self.0
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A folder of its own.
pub fn folder(name: &str) -> Folder {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("map-{name}"));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder");
    Folder(path)
}

/// Writes batches as Parquet, with row groups of so many rows.
pub fn write(path: &Path, batches: &[RecordBatch], group: usize) {
    let properties = WriterProperties::builder().set_max_row_group_row_count(Some(group)).build();
    let file = File::create(path).expect("a file");
    let mut writer = ArrowWriter::try_new(file, batches[0].schema(), Some(properties)).expect("a writer");
    batches.iter().for_each(|b| writer.write(b).expect("written"));
    writer.close().expect("closed");
}

/// A whole file of Parquet.
pub fn read(path: &Path) -> RecordBatch {
    let file = File::open(path).expect("a file");
    let reader =
        parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder::try_new(file).expect("Parquet");
    let reader = reader.with_batch_size(1 << 24).build().expect("a reader");
    let batches: Vec<RecordBatch> = reader.map(|b| b.expect("a batch")).collect();
    arrow_select::concat::concat_batches(&batches[0].schema(), &batches).expect("one batch")
}

pub fn job(input: &Path, output: &Path) -> Job {
    Job {
        input: input.into(),
        output: output.into(),
        compression: Compression::default(),
        threads: 2,
        ordered: None,
        strict: false,
        resume: None,
    }
}
