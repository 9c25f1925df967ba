//! Singular values of matrices with six rows.

/// J = Σ σᵢ uᵢ vᵢᵀ: the right singular vectors vᵢ, the longest image first, and their images σᵢuᵢ.
#[derive(Clone, Debug)]
pub struct Svd {
    /// Orthonormal, one for each column of the matrix.
    pub vectors: Vec<Vec<f64>>,
    /// What the matrix makes of them; orthogonal.
    pub images: Vec<[f64; 6]>,
    /// Their lengths, descending; beyond the sixth they are rounding errors.
    pub values: Vec<f64>,
}

impl Svd {
    /// The vector, in the span of the first `rank` vectors, whose image is nearest to `e`.
    pub fn solve(&self, e: &[f64; 6], rank: usize) -> Vec<f64> {
        let mut x = vec![0.0; self.vectors.len()];
        for ((v, w), sigma) in self.vectors.iter().zip(&self.images).zip(&self.values).take(rank) {
            if *sigma < f64::MIN_POSITIVE {
                continue;
            }
            let k = dot(w, e) / (sigma * sigma);
            x.iter_mut().zip(v).for_each(|(x, v)| *x += k * v);
        }
        x
    }
}

/// Singular values of a matrix given by its columns.
///
/// Jacobi's method from one side: columns are turned in pairs until all are orthogonal (Hestenes 1958).
pub fn svd(mut columns: Vec<[f64; 6]>) -> Svd {
    let n = columns.len();
    let mut v: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    let mut squares: Vec<f64> = columns.iter().map(|c| dot(c, c)).collect();
    let total: f64 = squares.iter().sum();
    for _ in 0..30 {
        let mut is_done = true;
        for i in 0..n {
            for j in i + 1..n {
                let (a, b) = (squares[i], squares[j]);
                let c = dot(&columns[i], &columns[j]);
                // A column of rounding errors has no direction.
                if c * c <= 1e-31 * a * b || a.min(b) <= 1e-31 * total {
                    continue;
                }
                is_done = false;
                let zeta = (b - a) / (2.0 * c);
                let t = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let cos = 1.0 / (1.0 + t * t).sqrt();
                let sin = cos * t;
                let (ci, cj) = (columns[i], columns[j]);
                for k in 0..6 {
                    columns[i][k] = cos * ci[k] - sin * cj[k];
                    columns[j][k] = sin * ci[k] + cos * cj[k];
                }
                (squares[i], squares[j]) = (dot(&columns[i], &columns[i]), dot(&columns[j], &columns[j]));
                let (left, right) = v.split_at_mut(j);
                for (x, y) in left[i].iter_mut().zip(&mut right[0]) {
                    (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y);
                }
            }
        }
        if is_done {
            break;
        }
    }
    let mut order: Vec<usize> = (0..n).collect();
    let length = |c: &[f64; 6]| dot(c, c).sqrt();
    order.sort_by(|&a, &b| length(&columns[b]).total_cmp(&length(&columns[a])));
    Svd {
        vectors: order.iter().map(|&k| v[k].clone()).collect(),
        images: order.iter().map(|&k| columns[k]).collect(),
        values: order.iter().map(|&k| length(&columns[k])).collect(),
    }
}

pub(crate) fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
