//! A column that may not go back.

use crate::MapError;
use arrow_array::RecordBatch;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int32Type, Int64Type};
use arrow_schema::{DataType, Schema};

/// The number of a column of times.
pub fn find(schema: &Schema, name: &str) -> Result<usize, MapError> {
    let found = schema.fields().iter().position(|f| f.name() == name);
    let hint = "name a column of numbers or times";
    let k = found.ok_or_else(|| MapError::new(format!("--ordered {name}: there is no such column"), hint))?;
    match schema.field(k).data_type() {
        DataType::Float64
        | DataType::Float32
        | DataType::Int32
        | DataType::Int64
        | DataType::Timestamp(..)
        | DataType::Duration(_) => Ok(k),
        kind => Err(MapError::new(format!("--ordered {name}: it holds {kind}"), hint)),
    }
}

/// Times of a part, first and last.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    pub first: Time,
    pub last: Time,
}

/// A time, exactly as it stands.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub enum Time {
    Whole(i64),
    Real(f64),
}

/// The first and the last time of a part; nothing if it has none.
///
/// # Errors
/// If one is less than the one before, or missing: with its row, from `before` on.
pub fn check(batch: &RecordBatch, k: usize, before: u64) -> Result<Option<Span>, MapError> {
    let column = batch.column(k).as_ref();
    let name = batch.schema_ref().field(k).name().clone();
    let missing = |row: usize| {
        MapError::new(
            format!("row {}: `{name}` has no value", before + row as u64 + 1),
            "with --ordered each row has its time",
        )
    };
    if let Some(nulls) = column.nulls().filter(|n| n.null_count() > 0) {
        return Err(missing(nulls.iter().position(|x| !x).unwrap_or(0)));
    }
    let times: Vec<Time> = match column.data_type() {
        DataType::Float64 => {
            column.as_primitive::<Float64Type>().values().iter().map(|&x| Time::Real(x)).collect()
        }
        DataType::Float32 => {
            column.as_primitive::<Float32Type>().values().iter().map(|&x| Time::Real(f64::from(x))).collect()
        }
        DataType::Int32 => {
            column.as_primitive::<Int32Type>().values().iter().map(|&x| Time::Whole(i64::from(x))).collect()
        }
        DataType::Int64 => {
            column.as_primitive::<Int64Type>().values().iter().map(|&x| Time::Whole(x)).collect()
        }
        // Times are whole numbers of their unit.
        _ => {
            let data = column.to_data();
            let whole: &[i64] = data.buffer(0);
            whole[..column.len()].iter().map(|&x| Time::Whole(x)).collect()
        }
    };
    if let Some(row) = times.iter().position(|t| matches!(t, Time::Real(x) if x.is_nan())) {
        return Err(missing(row));
    }
    if let Some(row) = times.windows(2).position(|pair| pair[1] < pair[0]) {
        return Err(back(&name, before + row as u64 + 2));
    }
    Ok(times.first().zip(times.last()).map(|(&first, &last)| Span { first, last }))
}

/// A time is less than the one before.
pub fn back(name: &str, row: u64) -> MapError {
    MapError::new(
        format!("row {row}: `{name}` is less than in the row before"),
        "sort the rows by it first, or leave --ordered away",
    )
}
