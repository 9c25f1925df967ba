//! Null vectors of the [wider matrix](crate::wide), and the products of powers among them.

use crate::{
    eigen::{SHARED, null_vector, real_eigenvalues},
    extract::gauss_jordan,
    wide::{EQUATIONS, MONOMIALS},
};

/// The vectors that all equations take to zero, or almost.
#[derive(Default)]
pub struct NullSpace {
    basis: [[f64; MONOMIALS]; SHARED],
    /// Their dimension, at most [`SHARED`].
    pub count: usize,
    /// The last pivot, compared to the first: zero where there are null vectors.
    pub least: f64,
}

impl NullSpace {
    /// By elimination with complete pivoting; pivots below `small`, compared to the first, count as zeros.
    pub fn find(&mut self, mut m: [[f64; MONOMIALS]; EQUATIONS], small: f64) {
        let (order, sizes) = eliminated(&mut m);
        self.least = sizes[MONOMIALS - 1] / sizes[0];
        let rank = sizes.iter().take_while(|size| **size > small * sizes[0]).count();
        let rank = if rank < MONOMIALS - SHARED { MONOMIALS - SHARED } else { rank };
        self.count = MONOMIALS - rank;
        for (j, vector) in self.basis.iter_mut().enumerate().take(self.count) {
            let mut y = [0.0; MONOMIALS];
            y[rank + j] = 1.0;
            for k in (0..rank).rev() {
                let sum: f64 = (k + 1..MONOMIALS).map(|c| m[k][c] * y[c]).sum();
                y[k] = if m[k][k] == 0.0 { 0.0 } else { -sum / m[k][k] };
            }
            let norm = y.iter().map(|x| x * x).sum::<f64>().sqrt();
            for (place, y) in order.iter().zip(y) {
                vector[*place] = y / norm;
            }
        }
    }

    /// The products `(u³ … v³) ⊗ (u'³ … v'³)` among the null vectors that are real up to a tolerance: how many there are; nothing
    /// if that cannot be told.
    ///
    /// On products, the shift from one power of `v` to the next is a number, `v/u`. With a basis of the null space, both
    /// shifts become small matrices with the products as eigenvectors: those of a mixture of the two are taken.
    pub fn products(&self, tolerance: f64, out: &mut [[f64; MONOMIALS]; SHARED]) -> Option<usize> {
        if self.count < 2 {
            out[0] = self.basis[0];
            return Some(self.count);
        }
        let mut x = [[0.0; SHARED]; SHARED];
        if !self.shift(4, 1.0, &mut x) || !self.shift(1, 0.618_033_988_749_894_9, &mut x) {
            return None;
        }
        let mut values = [0.0; SHARED];
        let real = real_eigenvalues(&x, self.count, tolerance, &mut values);
        for (&value, out) in values[..real].iter().zip(out.iter_mut()) {
            let mut shifted = x;
            for (i, row) in shifted.iter_mut().enumerate().take(self.count) {
                row[i] -= value;
            }
            let g = null_vector(&mut shifted, self.count);
            *out = [0.0; MONOMIALS];
            for (basis, &g) in self.basis.iter().zip(&g).take(self.count) {
                for (entry, b) in out.iter_mut().zip(basis) {
                    *entry += g * b;
                }
            }
        }
        Some(real)
    }

    /// Adds `factor` times the matrix of the shift by `stride` entries; false if it is singular.
    ///
    /// The pair is turned by a fixed angle first, so that no solution has `u = 0` but by accident.
    fn shift(&self, stride: usize, factor: f64, sum: &mut [[f64; SHARED]; SHARED]) -> bool {
        let (tc, ts) = (0.540_302_305_868_139_8, 0.841_470_984_807_896_5);
        let (mut top, mut bottom) = ([[0.0; 12]; SHARED], [[0.0; 12]; SHARED]);
        for j in 0..self.count {
            for (k, i) in (0..MONOMIALS).filter(|i| i / stride % 4 < 3).enumerate() {
                let (a, b) = (self.basis[j][i], self.basis[j][i + stride]);
                top[j][k] = tc * a + ts * b;
                bottom[j][k] = tc * b - ts * a;
            }
        }
        // (topᵀ top) X = topᵀ bottom
        let mut system = [[0.0; 2 * SHARED]; SHARED];
        for i in 0..self.count {
            for j in 0..self.count {
                system[i][j] = product(&top[i], &top[j]);
                system[i][self.count + j] = product(&top[i], &bottom[j]);
            }
        }
        if !gauss_jordan(&mut system, self.count) {
            return false;
        }
        for i in 0..self.count {
            for j in 0..self.count {
                sum[i][j] += factor * system[i][self.count + j];
            }
        }
        true
    }
}

/// Eliminates with complete pivoting: which column stands where, and the sizes of the pivots.
fn eliminated(m: &mut [[f64; MONOMIALS]; EQUATIONS]) -> ([usize; MONOMIALS], [f64; MONOMIALS]) {
    let mut order: [usize; MONOMIALS] = std::array::from_fn(|k| k);
    let mut sizes = [0.0; MONOMIALS];
    for k in 0..MONOMIALS {
        let (mut best, mut row, mut column) = (0.0, k, k);
        for (r, entries) in m.iter().enumerate().skip(k) {
            for (c, entry) in entries.iter().enumerate().skip(k) {
                if entry.abs() > best {
                    (best, row, column) = (entry.abs(), r, c);
                }
            }
        }
        if best == 0.0 {
            break;
        }
        sizes[k] = best;
        m.swap(k, row);
        for entries in m.iter_mut() {
            entries.swap(k, column);
        }
        order.swap(k, column);
        let pivot = m[k];
        for entries in m.iter_mut().skip(k + 1) {
            let factor = entries[k] / pivot[k];
            for (entry, pivot) in entries.iter_mut().zip(&pivot).skip(k) {
                *entry -= factor * pivot;
            }
        }
    }
    (order, sizes)
}

fn product(a: &[f64; 12], b: &[f64; 12]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
