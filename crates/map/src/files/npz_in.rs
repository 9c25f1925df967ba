//! NPZ: arrays of NumPy's in a ZIP archive, all with a row for each entry of their first axis, read side by side.

use super::at::At;
use super::broken::{broken, unreadable};
use super::{Load, Loads, MAX_COLUMNS, Source};
use crate::MapError;
use arrow_array::{ArrayRef, BooleanArray, FixedSizeListArray, Float64Array, Int64Array, RecordBatch};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use flate2::read::DeflateDecoder;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Bytes of a head at most.
const HEAD: usize = 1 << 16;
/// Bytes of a directory at most.
const DIRECTORY: u64 = 16 << 20;

/// An archive.
pub struct Npz {
    path: PathBuf,
    at: At,
    arrays: Vec<Stored>,
    schema: SchemaRef,
    rows: u64,
}

/// An array in the archive.
#[derive(Clone)]
struct Stored {
    entry: Entry,
    kind: Kind,
    is_big: bool,
    size: usize,
    /// Numbers of a row.
    each: usize,
    /// Bytes of the head.
    head: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Float,
    Whole,
    Unsigned,
    Truth,
}

/// A file in the archive.
#[derive(Clone)]
struct Entry {
    name: String,
    is_packed: bool,
    packed: u64,
    place: u64,
}

fn number(b: &[u8], at: usize, count: usize) -> Option<u64> {
    let bytes = b.get(at..at.checked_add(count)?)?;
    Some(bytes.iter().rev().fold(0, |x, b| x << 8 | u64::from(*b)))
}

/// The files of an archive.
fn entries(at: &At) -> Result<Vec<Entry>, String> {
    const EARLY: &str = "it ends too early";
    let length = at.length();
    let from = length.saturating_sub((1 << 16) + 22 + 20);
    let tail = at.exactly(from, usize::try_from(length - from).unwrap_or(0)).map_err(|e| e.to_string())?;
    let end = (0..tail.len().saturating_sub(21)).rev().find(|&k| tail[k..].starts_with(b"PK\x05\x06"));
    let end = end.ok_or("it has no directory")?;
    let get = |x: Option<u64>| x.ok_or_else(|| EARLY.to_string());
    let mut count = get(number(&tail, end + 10, 2))?;
    let mut size = get(number(&tail, end + 12, 4))?;
    let mut place = get(number(&tail, end + 16, 4))?;
    // Where it is large another end stands in front of this one.
    let locator = end.checked_sub(20).filter(|&k| tail[k..].starts_with(b"PK\x06\x07"));
    if let Some(k) = locator {
        let far = at.exactly(get(number(&tail, k + 8, 8))?, 56).map_err(|e| e.to_string())?;
        (count, size, place) =
            (get(number(&far, 32, 8))?, get(number(&far, 40, 8))?, get(number(&far, 48, 8))?);
    }
    if size > DIRECTORY || count > MAX_COLUMNS as u64 {
        return Err(format!("{count} arrays; at most {MAX_COLUMNS} are read"));
    }
    let b = at.exactly(place, usize::try_from(size).unwrap_or(0)).map_err(|e| e.to_string())?;
    let (mut all, mut k) = (vec![], 0);
    for _ in 0..count {
        if !b.get(k..).is_some_and(|b| b.starts_with(b"PK\x01\x02")) {
            return Err("an entry of its directory is none".into());
        }
        let method = get(number(&b, k + 10, 2))?;
        let (mut packed, mut size) = (get(number(&b, k + 20, 4))?, get(number(&b, k + 24, 4))?);
        let mut lengths = [0; 3];
        for (j, own) in lengths.iter_mut().enumerate() {
            *own = usize::try_from(get(number(&b, k + 28 + 2 * j, 2))?).unwrap_or(0);
        }
        let mut local = get(number(&b, k + 42, 4))?;
        let name = b.get(k + 46..k + 46 + lengths[0]).ok_or(EARLY)?;
        let name = String::from_utf8_lossy(name).into_owned();
        // Sizes beyond 32 bits stand in an extra field.
        let (mut extra, extra_end) = (k + 46 + lengths[0], k + 46 + lengths[0] + lengths[1]);
        while extra + 4 <= extra_end {
            let (id, long) = (get(number(&b, extra, 2))?, get(number(&b, extra + 2, 2))?);
            if id == 1 {
                let mut field = extra + 4;
                for value in [&mut size, &mut packed, &mut local] {
                    if *value == u64::from(u32::MAX) {
                        *value = get(number(&b, field, 8))?;
                        field += 8;
                    }
                }
            }
            extra += 4 + usize::try_from(long).unwrap_or(0);
        }
        let head = at.exactly(local, 30).map_err(|_| format!("{name} is cut off"))?;
        let behind = get(number(&head, 26, 2))? + get(number(&head, 28, 2))?;
        let place = local + 30 + behind;
        if place.checked_add(packed).is_none_or(|end| end > length) {
            return Err(format!("{name} is cut off"));
        }
        if method != 0 && method != 8 {
            return Err(format!(
                "{name} is packed in an unknown way: numpy.savez and savez_compressed are read"
            ));
        }
        all.push(Entry { name, is_packed: method == 8, packed, place });
        k += 46 + lengths.iter().sum::<usize>();
    }
    Ok(all)
}

impl Entry {
    fn open(&self, at: &At) -> Box<dyn Read + Send> {
        let plain = BufReader::with_capacity(1 << 18, at.from(self.place)).take(self.packed);
        if self.is_packed { Box::new(DeflateDecoder::new(plain)) } else { Box::new(plain) }
    }
}

/// What stands behind a key of a head.
fn behind<'a>(head: &'a str, key: &str) -> Option<&'a str> {
    let at = head.find(&format!("'{key}'"))?;
    Some(head[at + key.len() + 2..].trim_start().strip_prefix(':')?.trim_start())
}

/// The head of an array, and how many rows it has.
fn array(entry: &Entry, at: &At) -> Result<(Stored, u64), String> {
    let mut reader = entry.open(at);
    let mut start = [0; 12];
    reader.read_exact(&mut start[..10]).map_err(|_| "it ends too early")?;
    if &start[..6] != b"\x93NUMPY" {
        return Err("it is no array of NumPy's".into());
    }
    let (first, length) = if start[6] == 1 {
        (10, usize::from(u16::from_le_bytes([start[8], start[9]])))
    } else {
        reader.read_exact(&mut start[10..]).map_err(|_| "it ends too early")?;
        (12, u32::from_le_bytes([start[8], start[9], start[10], start[11]]) as usize)
    };
    if length > HEAD {
        return Err("its head is too long".into());
    }
    let mut head = vec![0; length];
    reader.read_exact(&mut head).map_err(|_| "its head is cut off")?;
    let head = String::from_utf8_lossy(&head).into_owned();
    let shape = behind(&head, "shape").and_then(|s| s.strip_prefix('(')?.split_once(')'));
    let shape = shape.ok_or("its head has no shape")?.0;
    let shape: Option<Vec<u64>> =
        shape.split(',').map(str::trim).filter(|s| !s.is_empty()).map(|s| s.parse().ok()).collect();
    let shape = shape.ok_or("its shape is none")?;
    let Some((&rows, rest)) = shape.split_first() else { return Err("it is one number".into()) };
    let each = rest.iter().try_fold(1_u64, |a, n| a.checked_mul(*n)).unwrap_or(u64::MAX);
    if each == 0 || each > MAX_COLUMNS as u64 {
        return Err(format!("a row of it has {each} numbers; 1 to {MAX_COLUMNS} are read"));
    }
    if behind(&head, "fortran_order").is_some_and(|f| f.starts_with("True")) && each > 1 {
        return Err("it is stored column by column: write numpy.ascontiguousarray of it".into());
    }
    let descr = behind(&head, "descr").and_then(|d| d.strip_prefix('\'')?.split_once('\''));
    let descr = descr.ok_or("it holds records: write a plain array for each field")?.0;
    let unknown = || format!("numbers of the type {descr} are not read");
    let (order, kind) = descr.split_at_checked(1).ok_or_else(unknown)?;
    let (kind, size) = match kind {
        "f8" => (Kind::Float, 8),
        "f4" => (Kind::Float, 4),
        "i8" => (Kind::Whole, 8),
        "i4" => (Kind::Whole, 4),
        "i2" => (Kind::Whole, 2),
        "i1" => (Kind::Whole, 1),
        "u4" => (Kind::Unsigned, 4),
        "u2" => (Kind::Unsigned, 2),
        "u1" => (Kind::Unsigned, 1),
        "b1" => (Kind::Truth, 1),
        _ => return Err(unknown()),
    };
    let each = usize::try_from(each).unwrap_or(usize::MAX);
    let bytes = rows.checked_mul((each * size) as u64).and_then(|b| b.checked_add((first + length) as u64));
    if bytes.is_none() || !entry.is_packed && bytes > Some(entry.packed) {
        return Err("it is cut off".into());
    }
    Ok((Stored { entry: entry.clone(), kind, is_big: order == ">", size, each, head: first + length }, rows))
}

impl Npz {
    /// Opens an archive.
    ///
    /// # Errors
    /// If it is broken, or its arrays have no common number of rows.
    pub fn open(path: &Path, file: File) -> Result<Self, MapError> {
        let at = At::new(file).map_err(|why| unreadable(path, &why))?;
        let entries = entries(&at).map_err(|why| broken(path, &why))?;
        let (mut arrays, mut fields, mut common) = (vec![], vec![], None);
        for entry in entries {
            let name = entry.name.strip_suffix(".npy").unwrap_or(&entry.name).to_string();
            let (stored, rows) = array(&entry, &at).map_err(|why| broken(path, &format!("{name}: {why}")))?;
            if *common.get_or_insert(rows) != rows {
                let first = common.unwrap_or(0);
                let what = format!("{}: `{name}` has {rows} rows, and others have {first}", path.display());
                return Err(MapError::new(
                    what,
                    "all arrays have a row for each moment: write others elsewhere",
                ));
            }
            let kind = match stored.kind {
                Kind::Float => DataType::Float64,
                Kind::Whole | Kind::Unsigned => DataType::Int64,
                Kind::Truth => DataType::Boolean,
            };
            let kind = match i32::try_from(stored.each) {
                Ok(n) if n > 1 => DataType::FixedSizeList(Arc::new(Field::new("item", kind, true)), n),
                _ => kind,
            };
            fields.push(Field::new(name, kind, true));
            arrays.push(stored);
        }
        let rows = common.unwrap_or(0);
        Ok(Npz { path: path.into(), at, arrays, schema: Arc::new(Schema::new(fields)), rows })
    }
}

impl Source for Npz {
    fn schema(&self) -> SchemaRef {
        self.schema.clone()
    }

    fn rows(&self) -> Option<u64> {
        Some(self.rows)
    }

    fn width(&self, columns: &[usize]) -> usize {
        columns.iter().map(|&k| 16 * self.arrays[k].each).sum()
    }

    fn loads(self: Box<Self>, columns: Vec<usize>, rows: usize) -> Result<Loads, MapError> {
        let mut open = vec![];
        for &k in &columns {
            let stored = &self.arrays[k];
            let mut reader = stored.entry.open(&self.at);
            let mut head = vec![0; stored.head];
            reader.read_exact(&mut head).map_err(|why| broken(&self.path, &why))?;
            open.push((stored.clone(), reader));
        }
        let fields: Vec<_> = columns.iter().map(|&k| self.schema.fields()[k].clone()).collect();
        let (schema, mut left) = (Arc::new(Schema::new(fields)), self.rows);
        Ok(Box::new(std::iter::from_fn(move || {
            let count = usize::try_from(left.min(rows as u64)).unwrap_or(rows);
            if count == 0 {
                return None;
            }
            left -= count as u64;
            let mut parts = vec![];
            for (stored, reader) in &mut open {
                let mut bytes = vec![0; count * stored.each * stored.size];
                if reader.read_exact(&mut bytes).is_err() {
                    return Some(Err(broken(&self.path, &format!("{} is cut off", stored.entry.name))));
                }
                parts.push((stored.clone(), bytes));
            }
            let (schema, path) = (schema.clone(), self.path.clone());
            let load: Load = Box::new(move || {
                let arrays =
                    schema.fields().iter().zip(&parts).map(|(f, (stored, bytes))| stored.column(f, bytes));
                RecordBatch::try_new(schema.clone(), arrays.collect()).map_err(|why| broken(&path, &why))
            });
            Some(Ok(load))
        })))
    }
}

impl Stored {
    fn column(&self, field: &Field, bytes: &[u8]) -> ArrayRef {
        let raw = |own: &[u8]| {
            let mut raw = [0; 8];
            for (k, byte) in own.iter().enumerate() {
                raw[if self.is_big { self.size - 1 - k } else { k }] = *byte;
            }
            raw
        };
        let all = || bytes.chunks_exact(self.size).map(raw);
        let shift = 64 - 8 * self.size as u32;
        let numbers: ArrayRef = match (self.kind, self.size) {
            (Kind::Float, 8) => Arc::new(Float64Array::from_iter_values(all().map(f64::from_le_bytes))),
            (Kind::Float, _) => {
                let wide = |b: [u8; 8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
                Arc::new(Float64Array::from_iter_values(all().map(wide)))
            }
            (Kind::Whole, _) => {
                let signed = |b: [u8; 8]| (u64::from_le_bytes(b) << shift) as i64 >> shift;
                Arc::new(Int64Array::from_iter_values(all().map(signed)))
            }
            (Kind::Unsigned, _) => Arc::new(Int64Array::from_iter_values(all().map(i64::from_le_bytes))),
            (Kind::Truth, _) => Arc::new(BooleanArray::from_iter(all().map(|b| Some(b[0] != 0)))),
        };
        match field.data_type() {
            DataType::FixedSizeList(item, n) => {
                Arc::new(FixedSizeListArray::new(item.clone(), *n, numbers, None))
            }
            _ => numbers,
        }
    }
}
