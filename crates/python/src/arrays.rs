//! Arrays in and out: any leading shape, double or single precision, computed in blocks while Python's other threads run.

use crate::trouble::{Kind, Trouble};
use denavit_program::{Function, Real};
use numpy::{
    Element, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;
use std::num::NonZero;

/// An array that lies in memory row by row.
pub enum Rows<'py> {
    /// In double precision.
    Double(PyReadonlyArrayDyn<'py, f64>),
    /// In single precision.
    Single(PyReadonlyArrayDyn<'py, f32>),
}

fn shape_error(message: String) -> PyErr {
    Trouble::new(Kind::Shape, message).into()
}

/// `(5, 6)`, as Python writes a shape.
fn written(shape: &[usize]) -> String {
    let all: Vec<String> = shape.iter().map(usize::to_string).collect();
    format!("({}{})", all.join(", "), if all.len() == 1 { "," } else { "" })
}

/// An object as an array; one that is in order in memory already is taken as it is.
///
/// # Errors
/// If it is no array of real numbers.
pub fn array<'py>(object: &Bound<'py, PyAny>, what: &str) -> PyResult<Rows<'py>> {
    let borrowed = |why: numpy::BorrowError| shape_error(format!("{what}: {why}"));
    if let Ok(a) = object.cast::<PyArrayDyn<f64>>()
        && a.is_c_contiguous()
    {
        return Ok(Rows::Double(a.try_readonly().map_err(borrowed)?));
    }
    if let Ok(a) = object.cast::<PyArrayDyn<f32>>()
        && a.is_c_contiguous()
    {
        return Ok(Rows::Single(a.try_readonly().map_err(borrowed)?));
    }
    let py = object.py();
    let numpy = py.import(intern!(py, "numpy"))?;
    let found = numpy.call_method1(intern!(py, "asarray"), (object,));
    let found = found.map_err(|why| shape_error(format!("{what} is no array: {}", why.value(py))))?;
    let untyped = found.cast::<PyUntypedArray>()?;
    let (kind, size) = (untyped.dtype().kind(), untyped.dtype().itemsize());
    if !matches!(kind, b'f' | b'i' | b'u' | b'b') {
        let dtype = untyped.dtype().str()?;
        return Err(PyTypeError::new_err(format!("{what} holds {dtype}: real numbers are needed")));
    }
    let dtype = if (kind, size) == (b'f', 4) { "float32" } else { "float64" };
    let ordered = numpy.call_method1(intern!(py, "asarray"), (found, dtype, "C"))?;
    if dtype == "float32" {
        return Ok(Rows::Single(ordered.cast::<PyArrayDyn<f32>>()?.try_readonly().map_err(borrowed)?));
    }
    Ok(Rows::Double(ordered.cast::<PyArrayDyn<f64>>()?.try_readonly().map_err(borrowed)?))
}

/// The leading shape of an array whose last axes are `tail`.
///
/// # Errors
/// If they are not.
pub fn leading(shape: &[usize], tail: &[usize], what: &str) -> PyResult<Vec<usize>> {
    match shape.strip_suffix(tail) {
        Some(leading) => Ok(leading.to_vec()),
        None => {
            let wanted: Vec<String> = tail.iter().map(usize::to_string).collect();
            let wanted = format!("(..., {})", wanted.join(", "));
            Err(shape_error(format!("{what} has the shape {}; {wanted} is needed", written(shape))))
        }
    }
}

/// The results of a program for all rows of an array `(..., variables)`: an array `(..., *tail)`.
pub struct Call<'a, 'py> {
    /// The program.
    pub function: &'a Function,
    /// How many variables a row has.
    pub variables: usize,
    /// The shape of the results of a row.
    pub tail: &'a [usize],
    /// What the array is called.
    pub what: &'a str,
    /// Where the results go.
    pub out: Option<&'a Bound<'py, PyAny>>,
    /// How many threads compute; as many as pay if it is not said.
    pub threads: Option<usize>,
}

impl<'py> Call<'_, 'py> {
    /// The results.
    ///
    /// # Errors
    /// If an array has the wrong shape or type.
    pub fn of(&self, rows: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let py = rows.py();
        match array(rows, self.what)? {
            Rows::Double(rows) => self.run(py, &rows, |inputs, outputs| {
                outputs.copy_from_slice(self.function.scalar().eval(inputs));
            }),
            Rows::Single(rows) => self.run(py, &rows, |inputs, outputs| {
                self.function.batch::<f32>().run(inputs, outputs);
            }),
        }
    }

    fn run<T: Real + Element>(
        &self,
        py: Python<'py>,
        rows: &PyReadonlyArrayDyn<'py, T>,
        one: impl Fn(&[T], &mut [T]),
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut shape = leading(rows.shape(), &[self.variables], self.what)?;
        shape.extend(self.tail);
        let results = match self.out {
            None => PyArrayDyn::<T>::zeros(py, shape, false),
            Some(out) => {
                let is_fit = |a: &Bound<'py, PyArrayDyn<T>>| a.shape() == shape && a.is_c_contiguous();
                let fit = out.cast::<PyArrayDyn<T>>().ok().filter(|a| is_fit(a));
                let needed = || {
                    let dtype = T::get_dtype(py);
                    shape_error(format!(
                        "out: an array of {dtype} is needed, {}, in C order",
                        written(&shape)
                    ))
                };
                fit.ok_or_else(needed)?.clone()
            }
        };
        let inputs = rows.as_slice().map_err(|why| shape_error(format!("{}: {why}", self.what)))?;
        {
            let borrowed = results.try_readwrite();
            let mut borrowed = borrowed.map_err(|why| shape_error(format!("out: {why}")))?;
            let outputs = borrowed.as_slice_mut().map_err(|why| shape_error(format!("out: {why}")))?;
            if inputs.len() == self.variables && self.variables > 0 {
                one(inputs, outputs);
            } else if !outputs.is_empty() {
                let threads = self.threads.and_then(NonZero::new);
                py.detach(|| self.function.batch::<T>().run_parallel(threads, inputs, outputs));
            }
        }
        Ok(results.into_any())
    }
}
