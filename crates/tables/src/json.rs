//! JSON Lines (an object a line), an array of objects, or an object of arrays. What is nested gets a name with a point, what is in a
//! list one with its number.

use crate::{Column, MAX_COLUMNS, MAX_NUMBERS, Table, TableError, some};
use serde_json::Value;
use std::collections::HashMap;

/// How deep values may be nested.
const DEPTH: usize = 8;

/// Columns as they grow.
#[derive(Default)]
struct Growing {
    columns: Vec<Column>,
    by_name: HashMap<String, usize>,
    rows: usize,
    texts: Vec<String>,
    /// The length of each list, and rows in which it was another.
    lists: HashMap<String, usize>,
    uneven: Vec<String>,
    uneven_count: usize,
}

impl Growing {
    fn put(&mut self, name: &str, x: f64) -> Result<(), TableError> {
        let k = match self.by_name.get(name) {
            Some(&k) => k,
            None => {
                if self.columns.len() >= MAX_COLUMNS {
                    let what = format!("more than {MAX_COLUMNS} columns in row {}", self.rows + 1);
                    return Err(TableError::new(what, "is it one object a moment?"));
                }
                self.columns.push(Column {
                    name: name.into(),
                    unit: None,
                    values: vec![f64::NAN; self.rows],
                });
                self.by_name.insert(name.into(), self.columns.len() - 1);
                self.columns.len() - 1
            }
        };
        if self.columns[k].values.len() == self.rows {
            self.columns[k].values.push(x);
        }
        Ok(())
    }

    fn add(&mut self, name: &str, value: &Value, depth: usize) -> Result<(), TableError> {
        if depth > DEPTH {
            return Ok(());
        }
        let joined = |k: &str| if name.is_empty() { k.to_string() } else { format!("{name}.{k}") };
        match value {
            Value::Null => Ok(()),
            Value::Bool(b) => self.put(name, f64::from(u8::from(*b))),
            Value::Number(x) => self.put(name, x.as_f64().unwrap_or(f64::NAN)),
            Value::String(_) => {
                if !self.texts.iter().any(|t| t == name) && self.texts.len() < 100 {
                    self.texts.push(name.into());
                }
                Ok(())
            }
            Value::Array(list) => {
                let known = *self.lists.entry(name.into()).or_insert(list.len());
                if known != list.len() {
                    self.uneven_count += 1;
                    if self.uneven.len() < 5 {
                        self.uneven.push(format!(
                            "`{name}` has {} in row {}, {known} before",
                            list.len(),
                            self.rows + 1
                        ));
                    }
                }
                list.iter()
                    .take(known.max(1))
                    .enumerate()
                    .try_for_each(|(i, v)| self.add(&format!("{name}[{i}]"), v, depth + 1))
            }
            Value::Object(map) => map.iter().try_for_each(|(k, v)| self.add(&joined(k), v, depth + 1)),
        }
    }

    fn end_row(&mut self) -> Result<(), TableError> {
        self.rows += 1;
        for c in &mut self.columns {
            c.values.resize(self.rows, f64::NAN);
        }
        if self.rows * self.columns.len() > MAX_NUMBERS {
            return Err(TableError::new(
                format!("more than {MAX_NUMBERS} numbers"),
                "take a part of the file",
            ));
        }
        Ok(())
    }

    fn table(self, said: &str) -> Table {
        let mut remarks = vec![said.to_string()];
        if !self.texts.is_empty() {
            remarks.push(format!("left out, for they are texts: {}", some(&self.texts, self.texts.len())));
        }
        if self.uneven_count > 0 {
            remarks.push(format!("lists of changing length: {}", some(&self.uneven, self.uneven_count)));
        }
        Table { columns: self.columns, first_row: 1, remarks }
    }
}

/// Reads a text.
pub fn read(bytes: &[u8]) -> Result<Table, TableError> {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    if text.trim().is_empty() {
        return Err(TableError::new("the file is empty", "a recording has a row for each moment"));
    }
    if let Ok(value) = serde_json::from_str::<Value>(text) {
        return whole(&value);
    }
    let mut growing = Growing::default();
    let last = text.lines().count();
    for (k, line) in text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty()) {
        let value: Value = match serde_json::from_str(line) {
            Ok(value) => value,
            // A line that was cut off while it was written.
            Err(e) if e.is_eof() && k + 1 == last && growing.rows > 0 => {
                growing.uneven_count += 1;
                growing.uneven.push(format!("line {} is cut off and left out", k + 1));
                break;
            }
            Err(e) => {
                let what = format!("line {}, column {}: no JSON ({e})", k + 1, e.column());
                return Err(TableError::new(
                    what,
                    "a line holds one object, as in {\"q\": [0, 0.1], \"x\": 0.4}",
                ));
            }
        };
        match value {
            Value::Object(_) => growing.add("", &value, 0)?,
            Value::Array(_) => growing.add("column ", &value, 0)?,
            _ => {
                let what = format!("line {}: neither an object nor a list", k + 1);
                return Err(TableError::new(
                    what,
                    "a line holds one object, as in {\"q\": [0, 0.1], \"x\": 0.4}",
                ));
            }
        }
        growing.end_row()?;
    }
    Ok(growing.table("read as JSON Lines, a row a line"))
}

/// A whole text that is one value.
fn whole(value: &Value) -> Result<Table, TableError> {
    let mut growing = Growing::default();
    match value {
        Value::Array(rows) => {
            for row in rows {
                growing.add(if row.is_array() { "column " } else { "" }, row, 0)?;
                growing.end_row()?;
            }
            Ok(growing.table("read as a list of rows"))
        }
        Value::Object(map) => {
            let length = map.values().find_map(Value::as_array).map_or(0, Vec::len);
            let is_columns =
                length > 1 && map.values().filter_map(Value::as_array).all(|a| a.len() == length);
            if !is_columns {
                growing.add("", value, 0)?;
                growing.end_row()?;
                return Ok(growing.table("read as JSON Lines, a row a line"));
            }
            for r in 0..length {
                for (name, values) in map {
                    if let Some(v) = values.as_array().and_then(|a| a.get(r)) {
                        growing.add(name, v, 1)?;
                    }
                }
                growing.end_row()?;
            }
            Ok(growing.table("read as an object of columns"))
        }
        _ => Err(TableError::new(
            "neither objects nor lists",
            "a line holds one object, as in {\"q\": [0, 0.1], \"x\": 0.4}",
        )),
    }
}
