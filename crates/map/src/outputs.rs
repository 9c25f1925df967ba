//! Columns that are written.

use crate::unit::{Quantity, Scale, Units};
use arrow_array::{ArrayRef, Float64Array};
use arrow_buffer::{NullBuffer, ScalarBuffer};
use arrow_schema::{DataType, Field};
use std::collections::HashMap;
use std::sync::Arc;

/// A column of numbers that is written.
#[derive(Clone, PartialEq, Debug)]
pub struct Output {
    /// Its name, without prefix.
    pub name: String,
    /// What it holds.
    pub quantity: Quantity,
}

impl Output {
    /// A column.
    pub fn new(name: impl Into<String>, quantity: Quantity) -> Self {
        Output { name: name.into(), quantity }
    }

    /// How it is declared.
    pub fn field(&self, prefix: &str, units: Units) -> Field {
        numbers_field(format!("{prefix}{}", self.name), DataType::Float64, self.quantity.unit(units))
    }
}

/// A column that may have nulls, with its unit.
pub fn numbers_field(name: String, kind: DataType, unit: Option<&str>) -> Field {
    let unit = unit.map(|u| ("unit".to_string(), u.to_string()));
    Field::new(name, kind, true).with_metadata(unit.into_iter().collect::<HashMap<_, _>>())
}

/// The numbers as a column: in its unit, a zero without sign, 0 below a null.
pub fn column(mut values: Vec<f64>, scale: Scale, nulls: Option<&NullBuffer>) -> ArrayRef {
    match scale {
        Scale::One => values.iter_mut().for_each(|x| *x += 0.0),
        scale => values.iter_mut().for_each(|x| *x = scale.undo(*x) + 0.0),
    }
    if let Some(nulls) = nulls {
        for (x, is_there) in values.iter_mut().zip(nulls.iter()) {
            if !is_there {
                *x = 0.0;
            }
        }
    }
    Arc::new(Float64Array::new(ScalarBuffer::from(values), nulls.cloned()))
}
