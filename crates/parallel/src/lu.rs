//! Linear equations with complex coefficients: elimination with partial pivoting.

use crate::complex::Complex;

/// A matrix in triangular factors.
pub struct Lu<const N: usize> {
    rows: [[Complex; N]; N],
    /// Which row stands where.
    order: [usize; N],
    /// The reciprocals of the diagonal.
    reciprocals: [Complex; N],
}

impl<const N: usize> Lu<N> {
    /// The factors of a matrix; none of one that is singular exactly, or not finite.
    pub fn of(mut rows: [[Complex; N]; N]) -> Option<Self> {
        let mut order = std::array::from_fn(|i| i);
        let mut reciprocals = [Complex::ZERO; N];
        for k in 0..N {
            let (mut best, mut size) = (k, -1.0);
            for (i, row) in rows.iter().enumerate().skip(k) {
                let here = row[k].norm2();
                if here > size {
                    (best, size) = (i, here);
                }
            }
            if !(size > 0.0 && size.is_finite()) {
                return None;
            }
            rows.swap(k, best);
            order.swap(k, best);
            reciprocals[k] = Complex::ONE / rows[k][k];
            let pivot = rows[k];
            for row in &mut rows[k + 1..] {
                let factor = row[k] * reciprocals[k];
                row[k] = factor;
                for j in k + 1..N {
                    row[j] -= factor * pivot[j];
                }
            }
        }
        Some(Lu { rows, order, reciprocals })
    }

    /// The solution of A x = b.
    pub fn solve(&self, b: &[Complex; N]) -> [Complex; N] {
        let mut x = self.order.map(|i| b[i]);
        for i in 0..N {
            for j in 0..i {
                let known = x[j];
                x[i] -= self.rows[i][j] * known;
            }
        }
        for i in (0..N).rev() {
            for j in i + 1..N {
                let known = x[j];
                x[i] -= self.rows[i][j] * known;
            }
            x[i] = x[i] * self.reciprocals[i];
        }
        x
    }

    /// A⁻¹, by rows.
    pub fn inverse(&self) -> [[Complex; N]; N] {
        let mut inverse = [[Complex::ZERO; N]; N];
        for j in 0..N {
            let unit = std::array::from_fn(|i| if i == j { Complex::ONE } else { Complex::ZERO });
            for (row, x) in inverse.iter_mut().zip(self.solve(&unit)) {
                row[j] = x;
            }
        }
        inverse
    }
}
