//! Between rows (one configuration after another, as callers have them) and registers (one array per value).

use crate::evaluate::block::Lanes;
use crate::evaluate::real::Real;

/// Side of the squares that are transposed at once.
const SIDE: usize = 4;

/// Spreads rows of `file.len()` values over the registers; lanes without a row repeat the last one.
#[inline(always)]
pub(crate) fn read<T: Real, const N: usize>(rows: &[T], file: &mut [Lanes<T, N>]) {
    let width = file.len();
    if width == 0 {
        return;
    }
    let given = rows.len() / width;
    for (i, row) in rows.chunks_exact(width).enumerate() {
        for (register, x) in file.iter_mut().zip(row) {
            register.0[i] = *x;
        }
    }
    for register in file {
        let last = register.0[given - 1];
        register.0[given..].fill(last);
    }
}

/// Gathers rows of `file.len()` values from the registers.
#[inline(always)]
pub(crate) fn write<T: Real, const N: usize>(file: &[Lanes<T, N>], rows: &mut [T]) {
    let width = file.len();
    if width == 0 {
        return;
    }
    let count = rows.len() / width;
    let (squares, whole) = (width / SIDE * SIDE, count / SIDE * SIDE);
    for i in (0..whole).step_by(SIDE) {
        let band = &mut rows[i * width..(i + SIDE) * width];
        for (k, columns) in file.chunks_exact(SIDE).enumerate() {
            square(columns, i, k * SIDE, width, band);
        }
        for (k, column) in file.iter().enumerate().skip(squares) {
            for r in 0..SIDE {
                band[r * width + k] = column.0[i + r];
            }
        }
    }
    for i in whole..count {
        for (k, column) in file.iter().enumerate() {
            rows[i * width + k] = column.0[i];
        }
    }
}

#[inline(always)]
fn square<T: Real, const N: usize>(
    columns: &[Lanes<T, N>],
    i: usize,
    at: usize,
    width: usize,
    band: &mut [T],
) {
    let column = |c: usize| -> [T; SIDE] { std::array::from_fn(|r| columns[c].0[i + r]) };
    let taken = [column(0), column(1), column(2), column(3)];
    for r in 0..SIDE {
        let row: [T; SIDE] = [taken[0][r], taken[1][r], taken[2][r], taken[3][r]];
        band[r * width + at..r * width + at + SIDE].copy_from_slice(&row);
    }
}
