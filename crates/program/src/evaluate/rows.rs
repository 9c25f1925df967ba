//! Between rows (one configuration after another, as callers have them) and registers (one array per value).

use crate::evaluate::block::Lanes;
use crate::evaluate::real::Real;

/// Values that are moved together; four doubles are what a vector register of 256 bits holds.
const QUAD: usize = 4;

/// Spreads rows of `file.len()` values over the registers; lanes without a row repeat the last one.
#[inline(always)]
pub(crate) fn read<T: Real, const N: usize>(rows: &[T], file: &mut [Lanes<T, N>]) {
    // With the width known to the compiler, the loop over the rows becomes vector code.
    match file.len() {
        0 => {}
        2 => fixed::<T, N, 2>(rows, file),
        3 => fixed::<T, N, 3>(rows, file),
        4 => fixed::<T, N, 4>(rows, file),
        5 => fixed::<T, N, 5>(rows, file),
        6 => fixed::<T, N, 6>(rows, file),
        7 => fixed::<T, N, 7>(rows, file),
        8 => fixed::<T, N, 8>(rows, file),
        width => {
            for (i, row) in rows.chunks_exact(width).enumerate() {
                file.iter_mut().zip(row).for_each(|(register, x)| register.0[i] = *x);
            }
            repeat_last(rows.len() / width, file);
        }
    }
}

#[inline(always)]
fn fixed<T: Real, const N: usize, const WIDTH: usize>(rows: &[T], file: &mut [Lanes<T, N>]) {
    let Some(file) = file.first_chunk_mut::<WIDTH>() else { return };
    let rows = rows.as_chunks::<WIDTH>().0;
    match rows.first_chunk::<N>() {
        Some(rows) => {
            for (i, row) in rows.iter().enumerate() {
                (0..WIDTH).for_each(|j| file[j].0[i] = row[j]);
            }
        }
        None => {
            for (i, row) in rows.iter().enumerate() {
                (0..WIDTH).for_each(|j| file[j].0[i] = row[j]);
            }
            repeat_last(rows.len(), file);
        }
    }
}

fn repeat_last<T: Real, const N: usize>(given: usize, file: &mut [Lanes<T, N>]) {
    for register in file {
        let last = register.0[given - 1];
        register.0[given..].fill(last);
    }
}

/// Gathers rows of `file.len()` values from the registers.
#[inline(always)]
pub(crate) fn write<T: Real, const N: usize>(file: &[Lanes<T, N>], rows: &mut [T]) {
    let width = file.len();
    let (quads, rest) = file.as_chunks::<QUAD>();
    let mut quad = Lanes([[T::default(); QUAD]; N]);
    for (k, [a, b, c, d]) in quads.iter().enumerate() {
        for i in 0..N {
            quad.0[i] = [a.0[i], b.0[i], c.0[i], d.0[i]];
        }
        for (row, quad) in rows.chunks_exact_mut(width).zip(&quad.0) {
            if let Some((_, place)) = row.split_at_mut_checked(k * QUAD)
                && let Some(place) = place.first_chunk_mut::<QUAD>()
            {
                *place = *quad;
            }
        }
    }
    let done = quads.len() * QUAD;
    for (k, register) in rest.iter().enumerate() {
        for (row, x) in rows.chunks_exact_mut(width).zip(&register.0) {
            row[done + k] = *x;
        }
    }
}
