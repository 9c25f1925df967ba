//! CSV: a head of names, a row a line; each number with as many digits as it needs, nothing where there is a null.

use super::broken::unwritable;
use super::pipeline::{Encoded, Encoder, Sink};
use super::temporary::Temporary;
use crate::{Counts, MapError};
use arrow_array::cast::AsArray;
use arrow_array::types::{
    Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type, UInt32Type,
    UInt64Type,
};
use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, SchemaRef};
use csv::Writer;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A text that is written.
pub struct Writing {
    path: PathBuf,
    temporary: Temporary,
    file: BufWriter<File>,
    between: u8,
}

/// A value as text.
type Cell<'a> = Box<dyn Fn(usize, &mut Vec<u8>) + 'a>;

impl Writing {
    /// Begins a file with its head.
    ///
    /// # Errors
    /// If it cannot be made, or a column has no place in a text.
    pub fn new(path: &Path, schema: &SchemaRef) -> Result<Self, MapError> {
        for field in schema.fields() {
            let kind = field.data_type();
            let is_known = kind.is_integer()
                || matches!(
                    kind,
                    DataType::Float32
                        | DataType::Float64
                        | DataType::Boolean
                        | DataType::Utf8
                        | DataType::LargeUtf8
                        | DataType::Utf8View
                );
            if !is_known {
                return Err(MapError::new(
                    format!("column `{}` holds {kind}, for which CSV has no place", field.name()),
                    "--keep columns without it, --slots N for solutions, or write Parquet",
                ));
            }
        }
        let is_tabs = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("tsv"));
        let between = if is_tabs { b'\t' } else { b',' };
        let (temporary, file) = Temporary::new(path)?;
        let mut file = BufWriter::with_capacity(1 << 20, file);
        let mut head = csv::WriterBuilder::new().delimiter(between).from_writer(vec![]);
        let names: Vec<&String> = schema.fields().iter().map(|f| f.name()).collect();
        head.write_record(names).map_err(|why| unwritable(path, &why))?;
        let head = head.into_inner().map_err(|why| unwritable(path, &why))?;
        file.write_all(&head).map_err(|why| unwritable(path, &why))?;
        Ok(Writing { path: path.into(), temporary, file, between })
    }
}

/// What writes the values of a column.
fn cells(column: &dyn Array) -> Cell<'_> {
    macro_rules! plain {
        ($kind:ty) => {{
            let own = column.as_primitive::<$kind>();
            Box::new(move |row, text: &mut Vec<u8>| {
                // A text in memory takes all.
                let _ = write!(text, "{}", own.value(row));
            })
        }};
    }
    match column.data_type() {
        // As short as it can be and be read as the same number: exponents where there are many zeros.
        DataType::Float64 => {
            let own = column.as_primitive::<Float64Type>();
            Box::new(move |row, text| {
                let x = own.value(row);
                let is_long = x != 0.0 && !(1e-5..1e16).contains(&x.abs()) && x.is_finite();
                let _ = if is_long { write!(text, "{x:e}") } else { write!(text, "{x}") };
            })
        }
        DataType::Float32 => plain!(Float32Type),
        DataType::Int8 => plain!(Int8Type),
        DataType::Int16 => plain!(Int16Type),
        DataType::Int32 => plain!(Int32Type),
        DataType::Int64 => plain!(Int64Type),
        DataType::UInt8 => plain!(UInt8Type),
        DataType::UInt16 => plain!(UInt16Type),
        DataType::UInt32 => plain!(UInt32Type),
        DataType::UInt64 => plain!(UInt64Type),
        DataType::Boolean => {
            let own = column.as_boolean();
            Box::new(move |row, text| text.extend(if own.value(row) { &b"true"[..] } else { b"false" }))
        }
        DataType::Utf8View => {
            let own = column.as_string_view();
            Box::new(move |row, text| text.extend(own.value(row).as_bytes()))
        }
        DataType::LargeUtf8 => {
            let own = column.as_string::<i64>();
            Box::new(move |row, text| text.extend(own.value(row).as_bytes()))
        }
        // `new` lets no other type pass.
        _ => {
            let own = column.as_string::<i32>();
            Box::new(move |row, text| text.extend(own.value(row).as_bytes()))
        }
    }
}

impl Sink for Writing {
    fn encoder(&self) -> Arc<Encoder> {
        let (between, path) = (self.between, self.path.clone());
        Arc::new(move |_, batch: &RecordBatch, _: &Counts| {
            let columns: Vec<(&dyn Array, Cell<'_>)> =
                batch.columns().iter().map(|c| (c.as_ref(), cells(c.as_ref()))).collect();
            let mut lines: Writer<Vec<u8>> =
                csv::WriterBuilder::new().delimiter(between).from_writer(Vec::with_capacity(1 << 20));
            let mut cell = vec![];
            let mut write = || -> csv::Result<()> {
                for row in 0..batch.num_rows() {
                    for (column, write) in &columns {
                        cell.clear();
                        if column.is_valid(row) {
                            write(row, &mut cell);
                        }
                        lines.write_field(&cell)?;
                    }
                    lines.write_record(None::<&[u8]>)?;
                }
                Ok(())
            };
            write().map_err(|why| unwritable(&path, &why))?;
            lines.into_inner().map(Encoded::Text).map_err(|why| unwritable(&path, &why))
        })
    }

    fn write(&mut self, part: Encoded) -> Result<(), MapError> {
        let Encoded::Text(text) = part else { return Ok(()) };
        self.file.write_all(&text).map_err(|why| unwritable(&self.path, &why))
    }

    fn finish(self: Box<Self>) -> Result<(), MapError> {
        let file = self.file.into_inner().map_err(|why| unwritable(&self.path, &why))?;
        self.temporary.keep(&file)
    }
}
