//! Arrays in and out: any leading shape, double or single precision, computed in blocks while Python's other threads run.

use crate::ready::Ready;
use crate::trouble::{Kind, Trouble};
use denavit_program::Real;
use numpy::{
    Element, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt, PyList};
use std::num::NonZero;

/// Numbers that lie in memory row by row.
pub enum Values<'py, T: Element> {
    /// An array.
    Lent(PyReadonlyArrayDyn<'py, T>),
    /// Those of a list or of vectors side by side, with their shape.
    Own(Vec<usize>, Vec<T>),
}

impl<T: Element> Values<'_, T> {
    /// The shape.
    pub fn shape(&self) -> &[usize] {
        match self {
            Values::Lent(array) => array.shape(),
            Values::Own(shape, _) => shape,
        }
    }

    /// All of them.
    ///
    /// # Errors
    /// If the array is not in order.
    pub fn slice(&self) -> PyResult<&[T]> {
        match self {
            Values::Lent(array) => array.as_slice().map_err(|why| shape_error(why.to_string())),
            Values::Own(_, all) => Ok(all),
        }
    }
}

/// Numbers in one of both precisions.
pub enum Rows<'py> {
    /// In double precision.
    Double(Values<'py, f64>),
    /// In single precision.
    Single(Values<'py, f32>),
}

impl Rows<'_> {
    fn shape(&self) -> &[usize] {
        match self {
            Rows::Double(values) => values.shape(),
            Rows::Single(values) => values.shape(),
        }
    }
}

fn shape_error(message: String) -> PyErr {
    Trouble::new(Kind::Shape, message).into()
}

/// `(5, 6)`, as Python writes a shape.
fn written(shape: &[usize]) -> String {
    let all: Vec<String> = shape.iter().map(usize::to_string).collect();
    format!("({}{})", all.join(", "), if all.len() == 1 { "," } else { "" })
}

/// The numbers of a list that holds nothing else.
fn listed(object: &Bound<'_, PyAny>) -> Option<Vec<f64>> {
    let list = object.cast::<PyList>().ok()?;
    let number = |x: Bound<'_, PyAny>| {
        let is_plain = x.is_exact_instance_of::<PyFloat>() || x.is_exact_instance_of::<PyInt>();
        is_plain.then(|| x.extract().ok())?
    };
    list.iter().map(number).collect()
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
        return Ok(Rows::Double(Values::Lent(a.try_readonly().map_err(borrowed)?)));
    }
    if let Ok(a) = object.cast::<PyArrayDyn<f32>>()
        && a.is_c_contiguous()
    {
        return Ok(Rows::Single(Values::Lent(a.try_readonly().map_err(borrowed)?)));
    }
    if let Some(numbers) = listed(object) {
        return Ok(Rows::Double(Values::Own(vec![numbers.len()], numbers)));
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
    Ok(match dtype {
        "float32" => {
            Rows::Single(Values::Lent(ordered.cast::<PyArrayDyn<f32>>()?.try_readonly().map_err(borrowed)?))
        }
        _ => Rows::Double(Values::Lent(ordered.cast::<PyArrayDyn<f64>>()?.try_readonly().map_err(borrowed)?)),
    })
}

/// The leading shape of an array whose last axes are `tail`.
///
/// # Errors
/// If they are not.
pub fn leading<'a>(shape: &'a [usize], tail: &[usize], what: &str) -> PyResult<&'a [usize]> {
    shape.strip_suffix(tail).ok_or_else(|| {
        let wanted: Vec<String> = tail.iter().map(usize::to_string).collect();
        let wanted = format!("(..., {})", wanted.join(", "));
        shape_error(format!("{what} has the shape {}; {wanted} is needed", written(shape)))
    })
}

/// A vector that a function reads: what it is called, and its values `(..., n)`.
pub type Vector<'a, 'py> = (&'a str, &'a Bound<'py, PyAny>);

/// Vectors of `n` numbers side by side, broadcast against each other: `(..., k·n)`.
///
/// # Errors
/// If one has another shape, or the shapes do not go together.
fn side_by_side<'py>(vectors: &[Vector<'_, 'py>], n: usize) -> PyResult<Rows<'py>> {
    let found: Vec<Rows<'py>> = vectors.iter().map(|(what, v)| array(v, what)).collect::<PyResult<_>>()?;
    for ((what, _), rows) in vectors.iter().zip(&found) {
        leading(rows.shape(), &[n], what)?;
    }
    let is_single = found.iter().all(|rows| matches!(rows, Rows::Single(_)));
    if found.len() == 1 {
        return Ok(found.into_iter().next().expect("it is one"));
    }
    let shapes: Vec<&[usize]> = found.iter().map(|rows| &rows.shape()[..rows.shape().len() - 1]).collect();
    let shape = together(&shapes).ok_or_else(|| {
        let all = vectors.iter().zip(&found).map(|((what, _), r)| format!("{what} {}", written(r.shape())));
        shape_error(format!("the shapes do not go together: {}", all.collect::<Vec<_>>().join(", ")))
    })?;
    if is_single {
        let all: Vec<&[f32]> = found
            .iter()
            .map(|rows| match rows {
                Rows::Single(values) => values.slice(),
                Rows::Double(_) => Ok(&[][..]),
            })
            .collect::<PyResult<_>>()?;
        let (shape, values) = placed(&shape, &shapes, &all, n);
        return Ok(Rows::Single(Values::Own(shape, values)));
    }
    // What is in single precision stands beside what is in double.
    let wide: Vec<Vec<f64>> = found
        .iter()
        .map(|rows| match rows {
            Rows::Single(values) => Ok(values.slice()?.iter().map(|&x| f64::from(x)).collect()),
            Rows::Double(_) => Ok(vec![]),
        })
        .collect::<PyResult<_>>()?;
    let all: Vec<&[f64]> = found
        .iter()
        .zip(&wide)
        .map(|(rows, wide)| match rows {
            Rows::Double(values) => values.slice(),
            Rows::Single(_) => Ok(&wide[..]),
        })
        .collect::<PyResult<_>>()?;
    let (shape, values) = placed(&shape, &shapes, &all, n);
    Ok(Rows::Double(Values::Own(shape, values)))
}

/// The shape that shapes have in common by the rules of broadcasting.
fn together(shapes: &[&[usize]]) -> Option<Vec<usize>> {
    let axes = shapes.iter().map(|s| s.len()).max().unwrap_or(0);
    (0..axes)
        .map(|axis| {
            let sizes = shapes.iter().filter_map(|s| s.get((axis + s.len()).checked_sub(axes)?));
            let mut wider = sizes.copied().filter(|&size| size != 1);
            let first = wider.next().unwrap_or(1);
            wider.all(|size| size == first).then_some(first)
        })
        .collect()
}

/// Rows of `n` numbers of each array, side by side.
fn placed<T: Copy>(shape: &[usize], shapes: &[&[usize]], all: &[&[T]], n: usize) -> (Vec<usize>, Vec<T>) {
    let rows: usize = shape.iter().product();
    let mut values = Vec::with_capacity(rows * n * all.len());
    // How many rows one has to go on for a step along each axis.
    let steps = |own: &&[usize]| -> Vec<usize> {
        let missing = shape.len() - own.len();
        let mut step = 1;
        let mut steps = vec![0; shape.len()];
        for (axis, &size) in own.iter().enumerate().rev() {
            steps[missing + axis] = if size == 1 { 0 } else { step };
            step *= size;
        }
        steps
    };
    let steps: Vec<Vec<usize>> = shapes.iter().map(steps).collect();
    let mut at = vec![0; shape.len()];
    for _ in 0..rows {
        for (array, steps) in all.iter().zip(&steps) {
            let row: usize = at.iter().zip(steps).map(|(k, step)| k * step).sum();
            values.extend_from_slice(&array[row * n..][..n]);
        }
        for (k, &size) in at.iter_mut().zip(shape).rev() {
            *k += 1;
            if *k < size {
                break;
            }
            *k = 0;
        }
    }
    ([shape, &[n * all.len()]].concat(), values)
}

/// The results of a program for all rows of arrays `(..., n)`: an array `(..., *tail)`.
pub struct Call<'a, 'py> {
    /// The program.
    pub function: &'a Ready,
    /// How many numbers a row of each vector has.
    pub n: usize,
    /// The shape of the results of a row.
    pub tail: &'a [usize],
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
    pub fn of(&self, py: Python<'py>, vectors: &[Vector<'_, 'py>]) -> PyResult<Bound<'py, PyAny>> {
        let variables = self.n * vectors.len();
        match side_by_side(vectors, self.n)? {
            Rows::Double(rows) => self.run(py, variables, &rows, |inputs, outputs| {
                self.function.one(inputs, outputs);
            }),
            Rows::Single(rows) => self.run(py, variables, &rows, |inputs, outputs| {
                self.function.many().batch::<f32>().run(inputs, outputs);
            }),
        }
    }

    fn run<T: Real + Element>(
        &self,
        py: Python<'py>,
        variables: usize,
        rows: &Values<'py, T>,
        one: impl Fn(&[T], &mut [T]),
    ) -> PyResult<Bound<'py, PyAny>> {
        let leading = &rows.shape()[..rows.shape().len() - 1];
        let shape = [leading, self.tail].concat();
        let results = match self.out {
            None => PyArrayDyn::<T>::zeros(py, &shape[..], false),
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
        let inputs = rows.slice()?;
        {
            let borrowed = results.try_readwrite();
            let mut borrowed = borrowed.map_err(|why| shape_error(format!("out: {why}")))?;
            let outputs = borrowed.as_slice_mut().map_err(|why| shape_error(format!("out: {why}")))?;
            if inputs.len() == variables && variables > 0 {
                one(inputs, outputs);
            } else if !outputs.is_empty() {
                let threads = self.threads.and_then(NonZero::new);
                py.detach(|| self.function.many().batch::<T>().run_parallel(threads, inputs, outputs));
            }
        }
        Ok(results.into_any())
    }
}
