//! Record batches that other packages lend through Arrow's C data interface, as capsules: the one place where pointers are taken.

#![allow(unsafe_code)]

use crate::trouble::{Kind, Trouble};
use arrow_array::ffi::{FFI_ArrowArray, FFI_ArrowSchema, from_ffi, to_ffi};
use arrow_array::{Array, RecordBatch, StructArray};
use arrow_schema::Schema;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use std::ffi::CStr;

const SCHEMA: &CStr = c"arrow_schema";
const ARRAY: &CStr = c"arrow_array";

fn capsule<'a, 'py>(object: &'a Bound<'py, PyAny>, name: &CStr) -> PyResult<&'a Bound<'py, PyCapsule>> {
    let capsule = object.cast::<PyCapsule>().map_err(|_| none("it gives no capsules"))?;
    if capsule.is_valid_checked(Some(name)) {
        Ok(capsule)
    } else {
        Err(none("its capsules have other names"))
    }
}

fn none(why: &str) -> PyErr {
    Trouble::new(Kind::Usage, format!("no record batch of Arrow's: {why}")).into()
}

/// The schema in a capsule.
///
/// # Errors
/// If it holds none.
pub fn schema(object: &Bound<'_, PyAny>) -> PyResult<Schema> {
    let pointer = capsule(object, SCHEMA)?.pointer_checked(Some(SCHEMA))?;
    // SAFETY: by the interface, a capsule of this name holds an `ArrowSchema` as long as it lives, and it outlives this call; it is
    // read, and not taken.
    let lent = unsafe { pointer.cast::<FFI_ArrowSchema>().as_ref() };
    Schema::try_from(lent).map_err(|why| none(&why.to_string()))
}

/// The batch in a pair of capsules; the array is taken out of its own, as the interface asks.
///
/// # Errors
/// If they hold none.
pub fn batch(of_schema: &Bound<'_, PyAny>, of_array: &Bound<'_, PyAny>) -> PyResult<RecordBatch> {
    let schema = schema(of_schema)?;
    let lent = capsule(of_schema, SCHEMA)?.pointer_checked(Some(SCHEMA))?;
    let pointer = capsule(of_array, ARRAY)?.pointer_checked(Some(ARRAY))?;
    // SAFETY: by the interface, a capsule of this name holds an `ArrowArray` that is its own; what is left in it is released already,
    // and a released one is an error below.
    let array = unsafe { FFI_ArrowArray::from_raw(pointer.cast::<FFI_ArrowArray>().as_ptr()) };
    if array.is_released() {
        return Err(none("it was given away before"));
    }
    // SAFETY: as in `schema`; that the array is one of this schema is the word of who made both.
    let data = unsafe { from_ffi(array, lent.cast::<FFI_ArrowSchema>().as_ref()) };
    let mut data = data.map_err(|why| none(&why.to_string()))?;
    // Others may lend bytes that stand anywhere.
    data.align_buffers();
    if data.null_count() > 0 {
        return Err(none("whole rows of it are null"));
    }
    let rows = data.len();
    let columns = StructArray::from(data).columns().to_vec();
    let options = arrow_array::RecordBatchOptions::new().with_row_count(Some(rows));
    RecordBatch::try_new_with_options(schema.into(), columns, &options).map_err(|why| none(&why.to_string()))
}

/// A schema in a capsule.
///
/// # Errors
/// If it has no place there.
pub fn lend_schema<'py>(py: Python<'py>, schema: &Schema) -> PyResult<Bound<'py, PyCapsule>> {
    let lent = FFI_ArrowSchema::try_from(schema).map_err(|why| none(&why.to_string()))?;
    PyCapsule::new_with_value(py, lent, SCHEMA)
}

/// A batch in a pair of capsules.
///
/// # Errors
/// If it has no place there.
pub fn lend<'py>(
    py: Python<'py>,
    batch: &RecordBatch,
) -> PyResult<(Bound<'py, PyCapsule>, Bound<'py, PyCapsule>)> {
    let whole = StructArray::from(batch.clone());
    let (array, _) = to_ffi(&whole.to_data()).map_err(|why| none(&why.to_string()))?;
    Ok((lend_schema(py, &batch.schema())?, PyCapsule::new_with_value(py, array, ARRAY)?))
}
