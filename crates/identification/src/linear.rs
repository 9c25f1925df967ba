//! Symmetric matrices in doubles, row by row: Cholesky's factors, eigenvalues by Jacobi's rotations.

/// A square matrix.
#[derive(Clone, PartialEq, Debug)]
pub struct Square {
    /// How many rows there are.
    pub n: usize,
    /// The entries, row by row.
    pub entries: Vec<f64>,
}

impl Square {
    /// Of zeros.
    pub fn zero(n: usize) -> Self {
        Square { n, entries: vec![0.0; n * n] }
    }

    /// An entry.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.n + j]
    }

    /// An entry to change.
    pub fn at_mut(&mut self, i: usize, j: usize) -> &mut f64 {
        &mut self.entries[i * self.n + j]
    }

    /// Adds w·x xᵀ.
    pub fn add_square_of(&mut self, x: &[f64], w: f64) {
        for (row, &a) in self.entries.chunks_exact_mut(self.n).zip(x).filter(|(_, a)| **a != 0.0) {
            row.iter_mut().zip(x).for_each(|(e, &b)| *e += w * a * b);
        }
    }

    /// Adds a multiple of another.
    pub fn add(&mut self, other: &Square, w: f64) {
        self.entries.iter_mut().zip(&other.entries).for_each(|(e, x)| *e += w * x);
    }

    /// The product with a vector.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        self.entries.chunks_exact(self.n.max(1)).map(|row| dot(row, x)).collect()
    }

    /// xᵀ A x
    pub fn between(&self, x: &[f64]) -> f64 {
        dot(&self.times(x), x)
    }

    /// The rows and columns with these numbers.
    pub fn of(&self, which: &[usize]) -> Self {
        let entries = which.iter().flat_map(|&i| which.iter().map(move |&j| self.at(i, j))).collect();
        Square { n: which.len(), entries }
    }

    /// L with A = L Lᵀ, if A is positive definite.
    pub fn cholesky(&self) -> Option<Self> {
        let n = self.n;
        let mut l = Square::zero(n);
        for i in 0..n {
            for j in 0..=i {
                let (a, b) = (&l.entries[i * n..i * n + j], &l.entries[j * n..j * n + j]);
                let left = self.at(i, j) - dot(a, b);
                if i == j {
                    if !(left.is_finite() && left > 0.0) {
                        return None;
                    }
                    *l.at_mut(i, i) = left.sqrt();
                } else {
                    *l.at_mut(i, j) = left / l.at(j, j);
                }
            }
        }
        Some(l)
    }

    /// The solution of L Lᵀ x = b for these factors.
    pub fn solved(&self, b: &[f64]) -> Vec<f64> {
        let n = self.n;
        let mut x = b.to_vec();
        for i in 0..n {
            x[i] = (x[i] - dot(&self.entries[i * n..i * n + i], &x[..i])) / self.at(i, i);
        }
        for i in (0..n).rev() {
            let later: f64 = (i + 1..n).map(|k| self.at(k, i) * x[k]).sum();
            x[i] = (x[i] - later) / self.at(i, i);
        }
        x
    }

    /// Twice the sum of the logarithms of the factor's diagonal: ln det A.
    pub fn log_det(&self) -> f64 {
        (0..self.n).map(|i| 2.0 * self.at(i, i).ln()).sum()
    }

    /// The eigenvalues of a symmetric matrix, descending, and its eigenvectors.
    pub fn eigen(&self) -> Vec<(f64, Vec<f64>)> {
        let n = self.n;
        let (mut a, mut v) = (self.clone(), Square::zero(n));
        (0..n).for_each(|i| *v.at_mut(i, i) = 1.0);
        for _ in 0..40 {
            let mut is_changed = false;
            for i in 0..n {
                for j in i + 1..n {
                    let off = a.at(i, j);
                    if off.abs() <= 1e-16 * (a.at(i, i) * a.at(j, j)).abs().sqrt() || off == 0.0 {
                        continue;
                    }
                    is_changed = true;
                    let zeta = (a.at(j, j) - a.at(i, i)) / (2.0 * off);
                    let t = if zeta >= 0.0 { 1.0 } else { -1.0 } / (zeta.abs() + zeta.hypot(1.0));
                    let c = 1.0 / t.hypot(1.0);
                    let s = c * t;
                    for k in 0..n {
                        let (x, y) = (a.at(k, i), a.at(k, j));
                        (*a.at_mut(k, i), *a.at_mut(k, j)) = (c * x - s * y, s * x + c * y);
                        let (x, y) = (v.at(k, i), v.at(k, j));
                        (*v.at_mut(k, i), *v.at_mut(k, j)) = (c * x - s * y, s * x + c * y);
                    }
                    for k in 0..n {
                        let (x, y) = (a.at(i, k), a.at(j, k));
                        (*a.at_mut(i, k), *a.at_mut(j, k)) = (c * x - s * y, s * x + c * y);
                    }
                }
            }
            if !is_changed {
                break;
            }
        }
        let of = |k: usize| (a.at(k, k), (0..n).map(|i| v.at(i, k)).collect());
        let mut all: Vec<(f64, Vec<f64>)> = (0..n).map(of).collect();
        all.sort_by(|x, y| y.0.total_cmp(&x.0));
        all
    }
}

/// The sum of the products.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The root of the mean of the squares; 0 of none.
pub fn rms<'a>(all: impl IntoIterator<Item = &'a f64>) -> f64 {
    let (sum, count) = all.into_iter().fold((0.0, 0_usize), |(s, n), x| (s + x * x, n + 1));
    if count == 0 { 0.0 } else { (sum / count as f64).sqrt() }
}
