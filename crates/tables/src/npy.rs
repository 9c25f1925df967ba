//! Arrays of NumPy's: one in an NPY file, several in an NPZ. The first axis is the row; what is behind it becomes columns with
//! numbers.

use crate::zip::files;
use crate::{Column, MAX_COLUMNS, MAX_NUMBERS, Table, TableError};

/// A field of a row.
struct Field {
    name: String,
    kind: u8,
    size: usize,
    is_big: bool,
    /// How many of them a row has.
    count: usize,
    /// Whether they are a list, whose members have numbers.
    is_list: bool,
}

const HINT: &str = "floats, whole numbers and truth values are read, plain or as fields of a record";

/// Reads an NPY file.
pub fn read(bytes: &[u8]) -> Result<Table, TableError> {
    let (columns, said) = array(bytes, "column")?;
    Ok(Table { columns, first_row: 1, remarks: vec![said] })
}

/// Reads an NPZ file: arrays with as many rows as most have.
pub fn read_all(bytes: &[u8]) -> Result<Table, TableError> {
    let mut arrays: Vec<(String, Vec<Column>)> = vec![];
    let mut remarks = vec![];
    for (file, content) in files(bytes)? {
        let name = file.strip_suffix(".npy").unwrap_or(&file).to_string();
        match array(&content, &name) {
            Ok((columns, _)) => arrays.push((name, columns)),
            Err(e) => remarks.push(format!("{name} is left out: {}", e.what)),
        }
    }
    let length = |a: &(String, Vec<Column>)| a.1.first().map_or(0, |c| c.values.len());
    let wide = |rows: usize| arrays.iter().filter(|a| length(a) == rows).map(|a| a.1.len()).sum::<usize>();
    let rows = arrays.iter().map(length).max_by_key(|&r| (wide(r), r)).unwrap_or(0);
    let mut columns = vec![];
    for (name, own) in arrays {
        let found = own.first().map_or(0, |c| c.values.len());
        if found == rows {
            columns.extend(own);
        } else {
            remarks.push(format!("{name} is left out: it has {found} rows, others {rows}"));
        }
    }
    if columns.len() > MAX_COLUMNS {
        return Err(TableError::new(
            format!("{} columns", columns.len()),
            format!("at most {MAX_COLUMNS} can be read"),
        ));
    }
    remarks.insert(0, "read as arrays of NumPy, a row for each entry of their first axis".into());
    Ok(Table { columns, first_row: 1, remarks })
}

/// The columns of an array.
fn array(b: &[u8], name: &str) -> Result<(Vec<Column>, String), TableError> {
    let broken =
        |what: &str| TableError::new(format!("the array is broken: {what}"), "was the file copied whole?");
    if !b.starts_with(b"\x93NUMPY") || b.len() < 12 {
        return Err(broken("it does not begin as one"));
    }
    let (start, length): (usize, usize) = match b[6] {
        1 => (10, usize::from(u16::from_le_bytes([b[8], b[9]]))),
        _ => (12, u32::from_le_bytes([b[8], b[9], b[10], b[11]]) as usize),
    };
    let head = b.get(start..start.saturating_add(length)).ok_or_else(|| broken("its head is cut off"))?;
    let head = String::from_utf8_lossy(head).into_owned();
    let data = &b[start + length..];
    let behind = |key: &str| {
        let at = head.find(&format!("'{key}'")).or_else(|| head.find(&format!("\"{key}\"")))?;
        Some(head[at + key.len() + 2..].trim_start().strip_prefix(':')?.trim_start())
    };
    let is_columns =
        behind("fortran_order").ok_or_else(|| broken("its head has no order"))?.starts_with("True");
    let shape = behind("shape").and_then(|s| s.strip_prefix('(')).and_then(|s| s.split_once(')'));
    let shape = shape.ok_or_else(|| broken("its head has no shape"))?.0;
    let shape: Option<Vec<usize>> =
        shape.split(',').map(str::trim).filter(|s| !s.is_empty()).map(|s| s.parse().ok()).collect();
    let shape = shape.ok_or_else(|| broken("its shape is none"))?;
    let (rows, rest) = match &shape[..] {
        [] => (1, &[][..]),
        [rows, rest @ ..] => (*rows, rest),
    };
    let each = rest.iter().try_fold(1_usize, |a, n| a.checked_mul(*n)).unwrap_or(usize::MAX);
    let fields =
        fields(behind("descr").ok_or_else(|| broken("its head has no type"))?, name, each, !rest.is_empty())?;
    let width: usize = fields.iter().map(|f| f.count).fold(0, usize::saturating_add);
    if width > MAX_COLUMNS || width == 0 || rows.saturating_mul(width) > MAX_NUMBERS {
        return Err(TableError::new(
            format!("an array of {rows} rows and {width} columns"),
            format!("at most {MAX_COLUMNS} columns and {MAX_NUMBERS} numbers can be read"),
        ));
    }
    let size: usize = fields.iter().map(|f| f.count * f.size).sum();
    if data.len() < rows.saturating_mul(size) {
        return Err(broken(&format!("it holds {} of {} bytes", data.len(), rows.saturating_mul(size))));
    }
    let mut columns = vec![];
    let mut offset = 0;
    for field in &fields {
        for k in 0..field.count {
            let at = |r: usize| match is_columns && fields.len() == 1 {
                // Column by column; what is behind the second axis runs the other way round.
                true => (fortran(k, rest) * rows + r) * field.size,
                false => r * size + offset + k * field.size,
            };
            let values = (0..rows).map(|r| field.value(&data[at(r)..])).collect();
            let name = if field.is_list { format!("{}[{k}]", field.name) } else { field.name.clone() };
            columns.push(Column { name, unit: None, values });
        }
        offset += field.count * field.size;
    }
    Ok((columns, format!("read as an array of NumPy, {rows} rows of {width}")))
}

/// The place of a member among those behind the first axis, in Fortran's order, for its place in C's.
fn fortran(mut k: usize, shape: &[usize]) -> usize {
    let mut index = vec![0; shape.len()];
    for (i, n) in shape.iter().enumerate().rev() {
        (index[i], k) = (k % n, k / n);
    }
    let (mut place, mut step) = (0, 1);
    for (i, n) in index.iter().zip(shape) {
        (place, step) = (place + i * step, step * n);
    }
    place
}

/// The fields of a type: one, or those of a record.
fn fields(descr: &str, name: &str, each: usize, is_list: bool) -> Result<Vec<Field>, TableError> {
    let unknown = |what: &str| TableError::new(format!("numbers of the type {what} are not read"), HINT);
    let texts =
        |s: &str| -> Vec<String> { s.split(['\'', '"']).skip(1).step_by(2).map(String::from).collect() };
    if !descr.starts_with('[') {
        let first = texts(descr).first().cloned().unwrap_or_default();
        let (kind, size, is_big) = of(&first).ok_or_else(|| unknown(&first))?;
        return Ok(vec![Field { name: name.into(), kind, size, is_big, count: each, is_list }]);
    }
    let list = &descr[..descr.find(']').unwrap_or(descr.len())];
    let mut all = vec![];
    for part in list.split('(').collect::<Vec<_>>().join("\u{1}").split("\u{1}'").skip(1) {
        let part = format!("'{part}");
        let words = texts(&part);
        let [field, kind, ..] = &words[..] else { return Err(unknown("a record")) };
        let (kind, size, is_big) = of(kind).ok_or_else(|| unknown(kind))?;
        let shape = part.split('\u{1}').nth(1).and_then(|s| s.split(')').next());
        let shape = shape.map(|s| {
            s.split(',').filter_map(|n| n.trim().parse::<usize>().ok()).fold(1, usize::saturating_mul)
        });
        all.push(Field {
            name: field.clone(),
            kind,
            size,
            is_big,
            count: shape.unwrap_or(1),
            is_list: shape.is_some(),
        });
    }
    if all.is_empty() { Err(unknown("a record")) } else { Ok(all) }
}

/// The kind, size and order of a type such as `<f8`.
fn of(text: &str) -> Option<(u8, usize, bool)> {
    let (order, rest) = text.split_at_checked(1)?;
    let (kind, size) = rest.split_at_checked(1)?;
    let (kind, size) = (kind.as_bytes()[0], size.parse().ok()?);
    let is_known = match kind {
        b'f' => [4, 8].contains(&size),
        b'i' | b'u' => [1, 2, 4, 8].contains(&size),
        b'b' => size == 1,
        _ => false,
    };
    is_known.then_some((kind, size, order == ">"))
}

impl Field {
    fn value(&self, b: &[u8]) -> f64 {
        let mut raw = [0; 8];
        let own = &b[..self.size];
        for (k, byte) in own.iter().enumerate() {
            raw[if self.is_big { self.size - 1 - k } else { k }] = *byte;
        }
        let whole = u64::from_le_bytes(raw);
        match (self.kind, self.size) {
            (b'f', 8) => f64::from_le_bytes(raw),
            (b'f', _) => f64::from(f32::from_le_bytes([raw[0], raw[1], raw[2], raw[3]])),
            (b'i', size) => {
                let shift = 64 - 8 * size as u32;
                ((whole << shift) as i64 >> shift) as f64
            }
            _ => whole as f64,
        }
    }
}
