//! Parquet: columns of numbers, and lists of them, as data sets of robots have.

use crate::{Column, MAX_COLUMNS, MAX_NUMBERS, Table, TableError, some};
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::record::Field;
use bytes::Bytes;
use std::collections::HashMap;
use std::panic::catch_unwind;

/// Reads a file.
pub fn read(bytes: &[u8]) -> Result<Table, TableError> {
    // The reader takes what a file says of itself on trust here and there.
    let caught = catch_unwind(|| read_rows(bytes));
    caught.unwrap_or_else(|_| Err(TableError::new("the file is broken", "was it copied whole?")))
}

/// Whether the pages of all columns lie within the file.
fn is_within(reader: &SerializedFileReader<Bytes>, length: usize) -> bool {
    let most = i64::try_from(length).unwrap_or(i64::MAX);
    reader.metadata().row_groups().iter().flat_map(|g| g.columns()).all(|c| {
        let start = c.dictionary_page_offset().unwrap_or(c.data_page_offset());
        let size = c.compressed_size();
        let is_before = start.checked_add(size).is_some_and(|end| end <= most);
        start >= 0 && c.data_page_offset() >= 0 && size >= 0 && c.num_values() >= 0 && is_before
    })
}

fn read_rows(bytes: &[u8]) -> Result<Table, TableError> {
    let broken = |e: &dyn std::fmt::Display| {
        let what = e.to_string();
        // Compressions that need a library in C are not built in.
        let hint = match what.contains("feature") {
            true => "write it with compression `snappy`, `gzip` or none",
            false => "was it copied whole?",
        };
        TableError::new(format!("the file cannot be read: {what}"), hint)
    };
    let reader = SerializedFileReader::new(Bytes::copy_from_slice(bytes)).map_err(|e| broken(&e))?;
    if !is_within(&reader, bytes.len()) {
        return Err(broken(&"a column lies outside of it"));
    }
    let mut columns: Vec<Column> = vec![];
    let mut places: HashMap<String, usize> = HashMap::new();
    let (mut texts, mut uneven): (Vec<String>, Vec<String>) = (vec![], vec![]);
    let mut lengths: HashMap<String, usize> = HashMap::new();
    let mut rows = 0;
    for row in reader.get_row_iter(None).map_err(|e| broken(&e))? {
        let row = row.map_err(|e| broken(&format!("row {}: {e}", rows + 1)))?;
        for (name, field) in row.get_column_iter() {
            let mut put = |name: &str, x: f64| {
                let k = *places.entry(name.into()).or_insert_with(|| {
                    columns.push(Column { name: name.into(), unit: None, values: vec![f64::NAN; rows] });
                    columns.len() - 1
                });
                columns[k].values.push(x);
            };
            match field {
                Field::ListInternal(list) => {
                    let known = *lengths.entry(name.clone()).or_insert(list.len());
                    if known != list.len() && uneven.len() < 5 {
                        uneven.push(format!(
                            "`{name}` has {} in row {}, {known} before",
                            list.len(),
                            rows + 1
                        ));
                    }
                    for (i, x) in list.elements().iter().take(known.min(MAX_COLUMNS + 1)).enumerate() {
                        put(&format!("{name}[{i}]"), number(x).unwrap_or(f64::NAN));
                    }
                }
                field => match number(field) {
                    Some(x) => put(name, x),
                    None if matches!(field, Field::Null) || texts.contains(name) => {}
                    None => texts.push(name.clone()),
                },
            }
        }
        rows += 1;
        if columns.len() > MAX_COLUMNS || rows * columns.len() > MAX_NUMBERS {
            let what = format!("{} columns and {rows} rows or more", columns.len());
            let hint = format!("at most {MAX_COLUMNS} columns and {MAX_NUMBERS} numbers can be read");
            return Err(TableError::new(what, hint));
        }
        columns.iter_mut().for_each(|c| c.values.resize(rows, f64::NAN));
    }
    if rows == 0 {
        return Err(TableError::new("there is no row", "a recording has a row for each moment"));
    }
    let mut remarks = vec![];
    if !texts.is_empty() {
        remarks.push(format!("left out, for they are no numbers: {}", some(&texts, texts.len())));
    }
    if !uneven.is_empty() {
        remarks.push(format!("lists of changing length: {}", some(&uneven, uneven.len())));
    }
    Ok(Table { columns, first_row: 1, remarks })
}

fn number(field: &Field) -> Option<f64> {
    Some(match field {
        Field::Bool(x) => f64::from(u8::from(*x)),
        Field::Byte(x) => f64::from(*x),
        Field::Short(x) => f64::from(*x),
        Field::Int(x) => f64::from(*x),
        Field::Long(x) | Field::TimestampMillis(x) | Field::TimestampMicros(x) => *x as f64,
        Field::UByte(x) => f64::from(*x),
        Field::UShort(x) => f64::from(*x),
        Field::UInt(x) => f64::from(*x),
        Field::ULong(x) => *x as f64,
        Field::Float16(x) => f64::from(*x),
        Field::Float(x) => f64::from(*x),
        Field::Double(x) => *x,
        _ => return None,
    })
}
