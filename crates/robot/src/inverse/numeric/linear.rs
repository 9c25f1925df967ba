//! Small systems of linear equations with symmetric positive matrices.

/// A pivot below this part of its diagonal entry is none: what it would determine stays 0.
const RANK: f64 = 1e-14;

/// Adds c cᵀ to the lower triangle of a symmetric matrix.
#[inline]
pub(in crate::inverse) fn add_product(square: &mut [[f64; 6]; 6], c: &[f64; 6]) {
    for i in 0..6 {
        for k in 0..=i {
            square[i][k] += c[i] * c[k];
        }
    }
}

/// x with A x = b, by Cholesky's factors; `a` holds the lower triangle. Directions without a pivot stay 0.
#[inline]
pub(in crate::inverse) fn solve6(a: &mut [[f64; 6]; 6], b: &[f64; 6]) -> [f64; 6] {
    let mut inverse = [0.0; 6];
    let mut x = *b;
    for k in 0..6 {
        let mut pivot = a[k][k];
        let mut right = x[k];
        for i in 0..k {
            pivot -= a[k][i] * a[k][i];
            right -= a[k][i] * x[i];
        }
        inverse[k] = if pivot > RANK * a[k][k] { 1.0 / pivot.sqrt() } else { 0.0 };
        x[k] = right * inverse[k];
        for j in k + 1..6 {
            let done: f64 = (0..k).map(|i| a[j][i] * a[k][i]).sum();
            a[j][k] = (a[j][k] - done) * inverse[k];
        }
    }
    for k in (0..6).rev() {
        let mut right = x[k];
        for j in k + 1..6 {
            right -= a[j][k] * x[j];
        }
        x[k] = right * inverse[k];
    }
    x
}

/// A factored symmetric matrix of any size.
#[derive(Clone, Debug, Default)]
pub(super) struct Factored {
    size: usize,
    /// The lower triangle, in whole rows.
    l: Vec<f64>,
    inverse: Vec<f64>,
}

impl Factored {
    /// Cholesky's factors of a matrix given by rows, of which the lower triangle is read, and whether all pivots were
    /// positive; a direction without one is left aside.
    pub fn factor(&mut self, matrix: &[f64], size: usize) -> bool {
        self.size = size;
        self.l.clear();
        self.l.extend_from_slice(matrix);
        self.inverse.clear();
        let mut positive = true;
        for k in 0..size {
            for i in 0..=k {
                let dot: f64 = (0..i).map(|c| self.l[k * size + c] * self.l[i * size + c]).sum();
                let entry = self.l[k * size + i] - dot;
                if i < k {
                    self.l[k * size + i] = entry * self.inverse[i];
                } else {
                    let is_pivot = entry > RANK * self.l[k * size + k].abs();
                    positive &= is_pivot;
                    self.inverse.push(if is_pivot { 1.0 / entry.sqrt() } else { 0.0 });
                }
            }
        }
        positive
    }

    /// x with A x = b, in place.
    pub fn solve(&self, b: &mut [f64]) {
        let n = self.size;
        for k in 0..n {
            let dot: f64 = (0..k).map(|i| self.l[k * n + i] * b[i]).sum();
            b[k] = (b[k] - dot) * self.inverse[k];
        }
        for k in (0..n).rev() {
            let dot: f64 = (k + 1..n).map(|j| self.l[j * n + k] * b[j]).sum();
            b[k] = (b[k] - dot) * self.inverse[k];
        }
    }
}
