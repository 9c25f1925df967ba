//! Null vectors of the 12 × 12 matrix at known values of the hidden joint: eight at a time, or all of a shared one.

use crate::{
    arm::Joint,
    determinant::{Strip, core, reduce, strips},
    eigen::{SHARED, null_vector, real_eigenvalues},
    instructions::{Compute, Instructions, Strict, part},
    lanes::{Lanes, mul_add},
};

/// Unknowns `x` of the 12 × 12 matrix (see [`determinant`](crate::determinant)).
pub const UNKNOWNS: usize = 12;

part! {
    /// A null vector in each lane, and how small the second smallest pivot was compared to the first: where this is small
    /// too, several solutions share the value of the hidden joint, and the vector is any mixture of theirs.
    pub fn null_vectors<I>(
        rows: &[[f64; 27]; 6],
        multiplied: Joint,
        c: Lanes,
        s: Lanes,
        x: &mut [Lanes; UNKNOWNS],
    ) -> Lanes {
        let (mut upper, mut lower) = ([[Lanes::ZERO; 9]; 6], [[Lanes::ZERO; 9]; 6]);
        strips::<I>(rows, multiplied, c, s, &mut upper, &mut lower);
        reduce::<I, 9>(&mut upper, 3);
        reduce::<I, 9>(&mut lower, 3);
        let mut m = [[Lanes::ZERO; 6]; 6];
        core(&upper, &lower, &mut m);
        let mut order = [Lanes::ZERO; 6];
        for (k, place) in order.iter_mut().enumerate() {
            *place = Lanes::splat(k as f64);
        }

        // Complete pivoting: the largest entry of what is left goes to the diagonal.
        for k in 0..5 {
            let (mut best, mut row, mut column) = (Lanes::splat(-1.0), Lanes::ZERO, Lanes::ZERO);
            for r in k..6 {
                for c in k..6 {
                    let entry = m[r][c].magnitude();
                    row = best.where_less(entry, Lanes::splat(r as f64), row);
                    column = best.where_less(entry, Lanes::splat(c as f64), column);
                    best = best.larger(entry);
                }
            }
            for r in k + 1..6 {
                for c in k..6 {
                    let (a, b) = (m[k][c], m[r][c]);
                    m[k][c] = row.where_is(r as f64, b, a);
                    m[r][c] = row.where_is(r as f64, a, b);
                }
            }
            for c in k + 1..6 {
                for r in 0..6 {
                    let (a, b) = (m[r][k], m[r][c]);
                    m[r][k] = column.where_is(c as f64, b, a);
                    m[r][c] = column.where_is(c as f64, a, b);
                }
                let (a, b) = (order[k], order[c]);
                order[k] = column.where_is(c as f64, b, a);
                order[c] = column.where_is(c as f64, a, b);
            }
            let inverse = m[k][k].where_is(0.0, Lanes::ZERO, Lanes::ONE.over(m[k][k]));
            for r in k + 1..6 {
                let factor = m[r][k].times(inverse);
                for c in k + 1..6 {
                    m[r][c] = factor.mul_sub::<I>(m[k][c], m[r][c]);
                }
            }
        }
        let small = m[4][4].magnitude().over(m[0][0].magnitude());

        // Back substitution with the last unknown 1; then back to the order of the columns.
        let mut y = [Lanes::ZERO; 6];
        y[5] = Lanes::ONE;
        for k in (0..5).rev() {
            let mut sum = Lanes::ZERO;
            for c in k + 1..6 {
                sum = m[k][c].mul_sub::<I>(y[c], sum);
            }
            let pivot = m[k][k].where_is(0.0, Lanes::splat(1e-300), m[k][k]);
            y[k] = sum.over(pivot);
        }
        for c in 0..6 {
            let mut entry = Lanes::ZERO;
            for (place, y) in order.iter().zip(&y) {
                entry = place.where_is(c as f64, *y, entry);
            }
            x[3 + c] = entry;
        }
        let middle = [x[3], x[4], x[5], x[6], x[7], x[8]];
        let (a, b) = (outer::<I>(&upper, &middle), outer::<I>(&lower, &middle));
        x[..3].copy_from_slice(&a);
        x[9..].copy_from_slice(&b);
        small
    }
}

/// The three unknowns that a reduced strip has eliminated.
#[inline(always)]
fn outer<I: Instructions>(strip: &Strip, middle: &[Lanes; 6]) -> [Lanes; 3] {
    let mut out = [Lanes::ZERO; 3];
    for k in (0..3).rev() {
        let mut sum = Lanes::ZERO;
        for c in 0..6 {
            sum = strip[k][3 + c].mul_sub::<I>(middle[c], sum);
        }
        for c in k + 1..3 {
            sum = strip[k][c].mul_sub::<I>(out[c], sum);
        }
        let pivot = strip[k][k].where_is(0.0, Lanes::splat(1e-300), strip[k][k]);
        out[k] = sum.over(pivot);
    }
    out
}

/// Pivots smaller than this, compared to the first, count as zero where several solutions share the hidden joint.
pub const SMALL: f64 = 1e-5;

/// The null vectors of solutions that share the hidden joint's value `(c, s)`: how many were found, written to `out`.
///
/// With `V` a basis of the null space, `top` its rows without the last block and `bottom` those without the first,
/// a solution `x = V g` has `v top g = u bottom g`: the eigenvectors of a small pencil.
#[inline(never)]
pub fn shared(
    rows: &[[f64; 27]; 6],
    multiplied: Joint,
    c: f64,
    s: f64,
    out: &mut [[f64; UNKNOWNS]; SHARED],
) -> usize {
    let (mut upper, mut lower) = ([[Lanes::ZERO; 9]; 6], [[Lanes::ZERO; 9]; 6]);
    strips::<Strict>(rows, multiplied, Lanes::splat(c), Lanes::splat(s), &mut upper, &mut lower);
    let mut m = [[0.0; UNKNOWNS]; UNKNOWNS];
    for i in 0..6 {
        for k in 0..9 {
            m[i][k] = upper[i][k].0[0];
            m[6 + i][if k < 3 { 9 + k } else { k }] = lower[i][k].0[0];
        }
    }
    let mut basis = [[0.0; UNKNOWNS]; SHARED];
    let count = null_space(&mut m, &mut basis);
    if count < 2 {
        out[0] = basis[0];
        return count;
    }
    // Undo the weights of the Bernstein basis, then turn (u, v) by a fixed angle: no solution has u = 0 but by accident.
    let weight = if multiplied == Joint::Revolute { 1.0 / 3.0f64.sqrt() } else { 1.0 };
    let (tc, ts) = (0.540_302_305_868_139_8, 0.841_470_984_807_896_5);
    let mut top = [[0.0; 9]; SHARED];
    let mut bottom = [[0.0; 9]; SHARED];
    for j in 0..count {
        let plain = |k: usize| if (3..9).contains(&k) { basis[j][k] * weight } else { basis[j][k] };
        for i in 0..9 {
            let (a, b) = (plain(i), plain(i + 3));
            top[j][i] = tc * a + ts * b;
            bottom[j][i] = tc * b - ts * a;
        }
    }
    // (topᵀ top) X = topᵀ bottom
    let mut system = [[0.0; 2 * SHARED]; SHARED];
    for i in 0..count {
        for j in 0..count {
            system[i][j] = product(&top[i], &top[j]);
            system[i][count + j] = product(&top[i], &bottom[j]);
        }
    }
    if !gauss_jordan(&mut system, count) {
        return 0;
    }
    let mut x = [[0.0; SHARED]; SHARED];
    for i in 0..count {
        x[i][..count].copy_from_slice(&system[i][count..2 * count]);
    }
    let mut found = 0;
    let mut values = [0.0; SHARED];
    let real = real_eigenvalues(&x, count, ALMOST, &mut values);
    for &value in &values[..real] {
        let mut shifted = x;
        for (i, row) in shifted.iter_mut().enumerate().take(count) {
            row[i] -= value;
        }
        let g = null_vector(&mut shifted, count);
        let mut vector = [0.0; UNKNOWNS];
        for (basis, &g) in basis.iter().zip(&g).take(count) {
            for (entry, b) in vector.iter_mut().zip(basis) {
                *entry = mul_add::<Strict>(g, *b, *entry);
            }
        }
        out[found] = vector;
        found += 1;
    }
    found
}

/// Eigenvalues with a smaller relative imaginary part may be real: rounding makes pairs of double ones.
pub const ALMOST: f64 = 0.03;

fn product(a: &[f64; 9], b: &[f64; 9]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// A basis of the null space by elimination with complete pivoting; its dimension, from 1 to [`SHARED`].
fn null_space(m: &mut [[f64; UNKNOWNS]; UNKNOWNS], basis: &mut [[f64; UNKNOWNS]; SHARED]) -> usize {
    let mut order: [usize; UNKNOWNS] = std::array::from_fn(|k| k);
    let mut rank = 0;
    let mut first = 0.0;
    while rank < UNKNOWNS - 1 {
        let (mut best, mut row, mut column) = (0.0, rank, rank);
        for (r, entries) in m.iter().enumerate().skip(rank) {
            for (c, entry) in entries.iter().enumerate().skip(rank) {
                if entry.abs() > best {
                    (best, row, column) = (entry.abs(), r, c);
                }
            }
        }
        if rank == 0 {
            first = best;
        }
        if UNKNOWNS - rank <= SHARED && best <= SMALL * first || best == 0.0 {
            break;
        }
        m.swap(rank, row);
        for entries in m.iter_mut() {
            entries.swap(rank, column);
        }
        order.swap(rank, column);
        let pivot_row = m[rank];
        for entries in m.iter_mut().skip(rank + 1) {
            let factor = entries[rank] / pivot_row[rank];
            for (entry, pivot) in entries.iter_mut().zip(&pivot_row).skip(rank + 1) {
                *entry -= factor * pivot;
            }
        }
        rank += 1;
    }
    let count = (UNKNOWNS - rank).min(SHARED);
    for (j, vector) in basis.iter_mut().enumerate().take(count) {
        let mut y = [0.0; UNKNOWNS];
        y[rank + j] = 1.0;
        for k in (0..rank).rev() {
            let sum: f64 = (k + 1..UNKNOWNS).map(|c| m[k][c] * y[c]).sum();
            y[k] = -sum / m[k][k];
        }
        for (place, y) in order.iter().zip(y) {
            vector[*place] = y;
        }
        let norm = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        for x in vector.iter_mut() {
            *x /= norm;
        }
    }
    count
}

/// Solves `[A | B]` in place for square `A` of the given size; false if it is singular.
pub(crate) fn gauss_jordan(m: &mut [[f64; 2 * SHARED]; SHARED], size: usize) -> bool {
    for k in 0..size {
        let mut row = k;
        for r in k + 1..size {
            if m[r][k].abs() > m[row][k].abs() {
                row = r;
            }
        }
        m.swap(k, row);
        if m[k][k].abs() < 1e-14 {
            return false;
        }
        let pivot = m[k][k];
        for entry in &mut m[k][..2 * size] {
            *entry /= pivot;
        }
        let pivot_row = m[k];
        for (r, row) in m.iter_mut().enumerate().take(size) {
            if r != k {
                let factor = row[k];
                for (entry, pivot) in row.iter_mut().zip(&pivot_row).take(2 * size) {
                    *entry -= factor * pivot;
                }
            }
        }
    }
    true
}
