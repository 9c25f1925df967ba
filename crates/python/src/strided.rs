//! Arrays whose rows do not lie one behind the other, and several side by side: read where they lie, some rows at a time.

use denavit_program::{Batch, Function, Real};
use numpy::ndarray::{ArrayView1, ArrayView2, ArrayViewD, Axis, Ix2};
use std::num::NonZero;
use std::thread;

/// Rows that are gathered at a time; they and their results stay in the cache.
const GATHERED: usize = 2048;
/// Rows below which a second thread does not pay.
const ROWS_PER_THREAD: usize = 10_000;

/// The results of a function for the rows of arrays side by side, all of one leading shape; a row has `results` of them.
///
/// # Panics
/// If there are not as many numbers in a row as the function has variables, or not a place for each result.
pub fn run<T: Real>(
    function: &Function,
    threads: Option<NonZero<usize>>,
    arrays: Vec<ArrayViewD<'_, T>>,
    results: usize,
    outputs: &mut [T],
) {
    let arrays: Vec<Side<'_, T>> = arrays.into_iter().map(Side::of).collect();
    let count = outputs.len() / results;
    let cores = || thread::available_parallelism().map_or(1, NonZero::get);
    let threads = threads.map_or_else(|| cores().min(count / ROWS_PER_THREAD), NonZero::get).max(1);
    let batch = function.batch::<T>();
    let share = count.div_ceil(threads).max(1);
    thread::scope(|scope| {
        let arrays = &arrays;
        let mut shares = outputs.chunks_mut(share * results).enumerate();
        // The first one is for this thread.
        let own = shares.next();
        for (k, out) in shares {
            let batch = batch.clone();
            scope.spawn(move || gathered(batch, arrays, k * share, results, out));
        }
        if let Some((_, out)) = own {
            gathered(batch.clone(), arrays, 0, results, out);
        }
    });
}

/// The results of rows from a number on.
fn gathered<T: Real>(
    mut batch: Batch<T>,
    arrays: &[Side<'_, T>],
    first: usize,
    results: usize,
    outputs: &mut [T],
) {
    let mut sides: Vec<_> = arrays.iter().map(|array| array.rows(first)).collect();
    let mut rows = vec![];
    for out in outputs.chunks_mut(GATHERED * results) {
        rows.clear();
        for _ in 0..out.len() / results {
            for row in sides.iter_mut().filter_map(Iterator::next) {
                match row.as_slice() {
                    Some(row) => rows.extend_from_slice(row),
                    None => rows.extend(row),
                }
            }
        }
        batch.run(&rows, out);
    }
}

/// An array `(..., n)` as its rows are reached.
enum Side<'a, T> {
    /// At equal distances.
    Even(ArrayView2<'a, T>),
    /// Along several axes.
    Any(ArrayViewD<'a, T>),
}

impl<'a, T> Side<'a, T> {
    fn of(mut array: ArrayViewD<'a, T>) -> Self {
        // Axes that are one in memory become one, and a row alone one of one.
        for axis in (0..array.ndim().saturating_sub(2)).rev() {
            if array.merge_axes(Axis(axis), Axis(axis + 1)) {
                array.index_axis_inplace(Axis(axis), 0);
            }
        }
        if array.ndim() == 1 {
            array = array.insert_axis(Axis(0));
        }
        match array.clone().into_dimensionality::<Ix2>() {
            Ok(even) => Side::Even(even),
            Err(_) => Side::Any(array),
        }
    }

    /// The rows from a number on.
    fn rows(&self, first: usize) -> Box<dyn Iterator<Item = ArrayView1<'_, T>> + '_> {
        match self {
            Side::Even(array) => Box::new(array.axis_iter(Axis(0)).split_at(first).1),
            Side::Any(array) => Box::new(array.rows().into_iter().skip(first)),
        }
    }
}
