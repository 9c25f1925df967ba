//! NPZ: an array of NumPy's a column, stored as it is; not a number, 0 or nothing where there is a null.
//!
//! Columns stand in files of their own until all rows are there, for an archive holds one after the other.

use super::broken::unwritable;
use super::pipeline::{Encoded, Encoder, Sink};
use super::temporary::Temporary;
use crate::{Counts, MapError};
use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type};
use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, SchemaRef};
use flate2::Crc;
use std::fs::File;
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Each array has a file of its own while it is written, and processes may have about a thousand.
const MAX_ARRAYS: usize = 500;

/// Characters of a text.
const TEXT: usize = 20;

/// An archive that is written.
pub struct Writing {
    path: PathBuf,
    temporary: Temporary,
    file: File,
    columns: Vec<Column>,
    rows: u64,
}

struct Column {
    name: String,
    kind: &'static str,
    /// Numbers of a row, where it is a list.
    each: Option<usize>,
    /// Bytes of a row.
    size: usize,
    file: BufWriter<File>,
    // Removed with it.
    _temporary: Temporary,
}

/// The type of a column, and the bytes of a number; nothing where an array has no place for it.
fn kind(of: &DataType, name: &str) -> Option<(&'static str, usize)> {
    Some(match of {
        DataType::Float64 => ("<f8", 8),
        DataType::Float32 => ("<f4", 4),
        DataType::Int8 => ("|i1", 1),
        DataType::Int16 => ("<i2", 2),
        DataType::Int32 => ("<i4", 4),
        DataType::Int64 => ("<i8", 8),
        DataType::Boolean => ("|b1", 1),
        // A few words of ours; others may have any length.
        DataType::Utf8 if name.ends_with("ik_status") => ("|S20", TEXT),
        _ => return None,
    })
}

impl Writing {
    /// Begins an archive.
    ///
    /// # Errors
    /// If it cannot be made, or a column is no array.
    pub fn new(path: &Path, schema: &SchemaRef) -> Result<Self, MapError> {
        if schema.fields().len() > MAX_ARRAYS {
            let what = format!(
                "{}: {} columns; an NPZ is written with at most {MAX_ARRAYS}",
                path.display(),
                schema.fields().len()
            );
            return Err(MapError::new(what, "--keep fewer columns, or write Parquet"));
        }
        let (temporary, file) = Temporary::new(path)?;
        let mut columns = vec![];
        for field in schema.fields() {
            let name = field.name();
            let (found, each) = match field.data_type() {
                DataType::FixedSizeList(item, n) => (kind(item.data_type(), ""), usize::try_from(*n).ok()),
                of => (kind(of, name), None),
            };
            let (kind, size) = found.ok_or_else(|| {
                MapError::new(
                    format!("column `{name}` holds {}, and NPZ has no such arrays", field.data_type()),
                    "--keep columns without it, --slots N for solutions, or write Parquet",
                )
            })?;
            // A name becomes the name of a file in the archive, and of one beside it.
            let number = columns.len();
            let own = path.with_file_name(format!(
                "{}.{number}",
                path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
            ));
            let (own, file) = Temporary::new(&own)?;
            columns.push(Column {
                name: name.clone(),
                kind,
                each,
                size: size * each.unwrap_or(1),
                file: BufWriter::with_capacity(1 << 18, file),
                _temporary: own,
            });
        }
        Ok(Writing { path: path.into(), temporary, file, columns, rows: 0 })
    }
}

/// The bytes of a column.
fn bytes(column: &dyn Array) -> Vec<u8> {
    macro_rules! plain {
        ($kind:ty, $null:expr) => {{
            let own = column.as_primitive::<$kind>();
            own.iter().flat_map(|x| x.unwrap_or($null).to_le_bytes()).collect()
        }};
    }
    match column.data_type() {
        DataType::Float64 => plain!(Float64Type, f64::NAN),
        DataType::Float32 => plain!(Float32Type, f32::NAN),
        DataType::Int8 => plain!(Int8Type, 0),
        DataType::Int16 => plain!(Int16Type, 0),
        DataType::Int32 => plain!(Int32Type, 0),
        DataType::Int64 => plain!(Int64Type, 0),
        DataType::Boolean => column.as_boolean().iter().map(|x| u8::from(x == Some(true))).collect(),
        DataType::FixedSizeList(..) => bytes(column.as_fixed_size_list().values().as_ref()),
        // `new` lets no other type pass.
        _ => {
            let mut all = vec![];
            for text in column.as_string::<i32>() {
                let own = text.unwrap_or_default().as_bytes();
                let own = &own[..own.len().min(TEXT)];
                all.extend_from_slice(own);
                all.resize(all.len() + TEXT - own.len(), 0);
            }
            all
        }
    }
}

impl Column {
    /// The head of the array.
    fn head(&self, rows: u64) -> Vec<u8> {
        let shape = self.each.map_or_else(|| format!("({rows},)"), |n| format!("({rows}, {n})"));
        let mut text = format!("{{'descr': '{}', 'fortran_order': False, 'shape': {shape}, }}", self.kind);
        // Numbers begin at a multiple of 64.
        let length = (10 + text.len() + 1).next_multiple_of(64) - 10;
        text += &" ".repeat(length - text.len() - 1);
        text.push('\n');
        let mut head = b"\x93NUMPY\x01\x00".to_vec();
        head.extend(u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes());
        head.extend(text.into_bytes());
        head
    }
}

impl Sink for Writing {
    fn encoder(&self) -> Arc<Encoder> {
        Arc::new(|_, batch: &RecordBatch, _: &Counts| {
            Ok(Encoded::Columns(batch.columns().iter().map(|c| bytes(c.as_ref())).collect()))
        })
    }

    fn write(&mut self, part: Encoded) -> Result<(), MapError> {
        let Encoded::Columns(columns) = part else { return Ok(()) };
        if let (Some(column), Some(bytes)) = (self.columns.first(), columns.first()) {
            self.rows += (bytes.len() / column.size.max(1)) as u64;
        }
        for (column, bytes) in self.columns.iter_mut().zip(&columns) {
            column.file.write_all(bytes).map_err(|why| unwritable(&self.path, &why))?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), MapError> {
        let Writing { path, temporary, file, columns, rows } = *self;
        archive(&file, columns, rows).map_err(|why| unwritable(&path, &why))?;
        temporary.keep(&file)
    }
}

/// Puts the columns into an archive, sizes in 64 bits.
fn archive(file: &File, columns: Vec<Column>, rows: u64) -> std::io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 20, file);
    let (mut place, mut directory, count) = (0_u64, vec![], columns.len() as u64);
    for column in columns {
        let head = column.head(rows);
        let mut own = column.file.into_inner().map_err(std::io::IntoInnerError::into_error)?;
        own.seek(SeekFrom::Start(0))?;
        let length = own.metadata()?.len() + head.len() as u64;
        let mut crc = Crc::new();
        crc.update(&head);
        let mut buffer = vec![0; 1 << 20];
        loop {
            let n = own.read(&mut buffer)?;
            if n == 0 {
                break;
            }
            crc.update(&buffer[..n]);
        }
        own.seek(SeekFrom::Start(0))?;
        let name = format!("{}.npy", column.name);
        let sum = crc.sum();
        // Version, flags (names in UTF-8), method, time, date, sum, sizes, lengths of name and extra field.
        let common = |long: u16| {
            let mut b = vec![];
            for x in [45_u16, 0x800, 0, 0, 0x21] {
                b.extend(x.to_le_bytes());
            }
            b.extend(sum.to_le_bytes());
            b.extend([0xff; 8]);
            b.extend(u16::try_from(name.len()).unwrap_or(u16::MAX).to_le_bytes());
            b.extend(long.to_le_bytes());
            b
        };
        let sizes = [length.to_le_bytes(), length.to_le_bytes()].concat();
        let mut local = b"PK\x03\x04".to_vec();
        local.extend(common(20));
        local.extend(name.as_bytes());
        local.extend([1, 0, 16, 0]);
        local.extend(&sizes);
        directory.extend(b"PK\x01\x02");
        directory.extend(45_u16.to_le_bytes());
        directory.extend(common(28));
        // Length of a comment, disk, attributes, place.
        directory.extend([0; 10]);
        directory.extend([0xff; 4]);
        directory.extend(name.as_bytes());
        directory.extend([1, 0, 24, 0]);
        directory.extend(&sizes);
        directory.extend(place.to_le_bytes());
        out.write_all(&local)?;
        out.write_all(&head)?;
        std::io::copy(&mut own, &mut out)?;
        place += local.len() as u64 + length;
    }
    out.write_all(&directory)?;
    // The end in 64 bits, where it stands, and the end that all readers look for.
    let size = directory.len() as u64;
    let mut end = b"PK\x06\x06".to_vec();
    end.extend(44_u64.to_le_bytes());
    end.extend([45, 0, 45, 0]);
    end.extend([0; 8]);
    for x in [count, count, size, place] {
        end.extend(x.to_le_bytes());
    }
    end.extend(b"PK\x06\x07");
    end.extend([0; 4]);
    end.extend((place + size).to_le_bytes());
    end.extend(1_u32.to_le_bytes());
    end.extend(b"PK\x05\x06");
    end.extend([0; 4]);
    end.extend([0xff; 12]);
    end.extend([0; 2]);
    out.write_all(&end)?;
    out.flush()
}
