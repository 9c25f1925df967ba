//! Arrays in and out: any leading shape, double or single precision, computed in blocks while Python's other threads run.

use crate::ready::Ready;
use crate::strided;
use crate::trouble::{Kind, Trouble};
use denavit_program::Real;
use numpy::ndarray::ArrayViewD;
use numpy::{
    Element, IntoPyArray, PyArray2, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn,
    PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt, PyList};
use std::borrow::Cow;
use std::num::NonZero;

/// Numbers of an array.
pub enum Values<'py, T: Element + Copy> {
    /// Where they lie.
    Lent(PyReadonlyArrayDyn<'py, T>),
    /// Those of a list or of another precision, row by row, with their shape.
    Own(Vec<usize>, Vec<T>),
}

impl<T: Element + Copy> Values<'_, T> {
    /// The shape.
    pub fn shape(&self) -> &[usize] {
        match self {
            Values::Lent(array) => array.shape(),
            Values::Own(shape, _) => shape,
        }
    }

    /// All of them, if they lie in memory row by row.
    pub fn slice(&self) -> Option<&[T]> {
        match self {
            Values::Lent(array) if !array.is_c_contiguous() => None,
            Values::Lent(array) => array.as_slice().ok(),
            Values::Own(_, all) => Some(all),
        }
    }

    /// All of them, wherever they lie.
    fn view(&self) -> ArrayViewD<'_, T> {
        match self {
            Values::Lent(array) => array.as_array(),
            Values::Own(shape, all) => {
                ArrayViewD::from_shape(&shape[..], all).expect("as many as the shape says")
            }
        }
    }

    /// All of them row by row.
    pub fn ordered(&self) -> Cow<'_, [T]> {
        let all = self.slice().map(Cow::Borrowed);
        all.unwrap_or_else(|| Cow::Owned(self.view().iter().copied().collect()))
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

/// Whether the numbers of an array can be read where they lie.
fn is_readable<T: Element>(array: &Bound<'_, PyArrayDyn<T>>) -> bool {
    // One by one where numbers are to lie; an array without any has distances that mean nothing.
    let size = size_of::<T>() as isize;
    let is_even = || !array.is_empty() && array.strides().iter().all(|step| step % size == 0);
    array.data().is_aligned() && (array.is_c_contiguous() || is_even())
}

/// An object as an array; one of doubles or singles is taken as it lies in memory.
///
/// # Errors
/// If it is no array of real numbers.
pub fn array<'py>(object: &Bound<'py, PyAny>, what: &str) -> PyResult<Rows<'py>> {
    let borrowed = |why: numpy::BorrowError| shape_error(format!("{what}: {why}"));
    if let Ok(a) = object.cast::<PyArrayDyn<f64>>()
        && is_readable(a)
    {
        return Ok(Rows::Double(Values::Lent(a.try_readonly().map_err(borrowed)?)));
    }
    if let Ok(a) = object.cast::<PyArrayDyn<f32>>()
        && is_readable(a)
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
    let ordered = numpy.call_method1(intern!(py, "require"), (found, dtype, "CA"))?;
    Ok(match dtype {
        "float32" => {
            Rows::Single(Values::Lent(ordered.cast::<PyArrayDyn<f32>>()?.try_readonly().map_err(borrowed)?))
        }
        _ => Rows::Double(Values::Lent(ordered.cast::<PyArrayDyn<f64>>()?.try_readonly().map_err(borrowed)?)),
    })
}

/// A matrix of entries that stand row by row.
///
/// # Errors
/// If there are not as many.
pub fn matrix<'py>(
    py: Python<'py>,
    entries: Vec<f64>,
    rows: usize,
    columns: usize,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    entries.into_pyarray(py).reshape([rows, columns])
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

/// Vectors of one precision with the leading shape that they have together.
struct Vectors<'py, T: Element + Copy> {
    leading: Vec<usize>,
    each: Vec<Values<'py, T>>,
}

/// Vectors in one of both precisions.
enum Together<'py> {
    Double(Vectors<'py, f64>),
    Single(Vectors<'py, f32>),
}

/// Vectors of `n` numbers, broadcast against each other.
///
/// # Errors
/// If one has another shape, or the shapes do not go together.
fn side_by_side<'py>(vectors: &[Vector<'_, 'py>], n: usize) -> PyResult<Together<'py>> {
    let found: Vec<Rows<'py>> = vectors.iter().map(|(what, v)| array(v, what)).collect::<PyResult<_>>()?;
    let mut shapes = Vec::with_capacity(found.len());
    for ((what, _), rows) in vectors.iter().zip(&found) {
        shapes.push(leading(rows.shape(), &[n], what)?);
    }
    let leading = together(&shapes).ok_or_else(|| {
        let all = vectors.iter().zip(&found).map(|((what, _), r)| format!("{what} {}", written(r.shape())));
        shape_error(format!("the shapes do not go together: {}", all.collect::<Vec<_>>().join(", ")))
    })?;
    if found.iter().any(|rows| matches!(rows, Rows::Double(_))) {
        // What is in single precision stands beside what is in double.
        let wide = |rows| match rows {
            Rows::Double(values) => values,
            Rows::Single(values) => {
                Values::Own(values.shape().to_vec(), values.ordered().iter().map(|&x| f64::from(x)).collect())
            }
        };
        return Ok(Together::Double(Vectors { leading, each: found.into_iter().map(wide).collect() }));
    }
    let single = |rows| match rows {
        Rows::Single(values) => Some(values),
        Rows::Double(_) => None,
    };
    Ok(Together::Single(Vectors { leading, each: found.into_iter().filter_map(single).collect() }))
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
    pub threads: Option<i64>,
}

/// How many threads are asked for.
///
/// # Errors
/// If that is none, or fewer.
pub fn count_of(threads: Option<i64>) -> Result<Option<NonZero<usize>>, Trouble> {
    let count = |n| usize::try_from(n).ok().and_then(NonZero::new);
    let checked = |n| {
        count(n).ok_or_else(|| Trouble::new(Kind::Usage, format!("threads is {n}: 1 or more are needed")))
    };
    threads.map(checked).transpose()
}

impl<'py> Call<'_, 'py> {
    /// The results.
    ///
    /// # Errors
    /// If an array has the wrong shape or type.
    pub fn of(&self, py: Python<'py>, vectors: &[Vector<'_, 'py>]) -> PyResult<Bound<'py, PyAny>> {
        match side_by_side(vectors, self.n)? {
            Together::Double(vectors) => self.run(py, &vectors, |inputs, outputs| {
                self.function.one(inputs, outputs);
            }),
            Together::Single(vectors) => self.run(py, &vectors, |inputs, outputs| {
                self.function.many().batch::<f32>().run(inputs, outputs);
            }),
        }
    }

    fn run<T: Real + Element>(
        &self,
        py: Python<'py>,
        vectors: &Vectors<'py, T>,
        one: impl Fn(&[T], &mut [T]),
    ) -> PyResult<Bound<'py, PyAny>> {
        let leading = &vectors.leading[..];
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
        {
            let borrowed = results.try_readwrite();
            let mut borrowed = borrowed.map_err(|why| shape_error(format!("out: {why}")))?;
            let outputs = borrowed.as_slice_mut().map_err(|why| shape_error(format!("out: {why}")))?;
            let threads = count_of(self.threads)?;
            let whole = match &vectors.each[..] {
                [only] => only.slice(),
                _ => None,
            };
            if outputs.is_empty() {
            } else if leading.iter().product::<usize>() == 1 && self.n > 0 {
                match whole {
                    Some(inputs) => one(inputs, outputs),
                    None => {
                        let all: Vec<T> =
                            vectors.each.iter().flat_map(|v| v.ordered().into_owned()).collect();
                        one(&all, outputs);
                    }
                }
            } else if let Some(inputs) = whole {
                py.detach(|| self.function.many().batch::<T>().run_parallel(threads, inputs, outputs));
            } else {
                let shape = [leading, &[self.n]].concat();
                let views: Vec<_> = vectors.each.iter().map(Values::view).collect();
                let views = views.iter().filter_map(|view| view.broadcast(&shape[..])).collect();
                let count = self.tail.iter().product();
                py.detach(|| strided::run(self.function.many(), threads, views, count, outputs));
            }
        }
        Ok(results.into_any())
    }
}
