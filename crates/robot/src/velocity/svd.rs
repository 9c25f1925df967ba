//! Singular values of matrices with six rows.

use crate::space::norm;

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

/// A matrix with more columns than this is brought to six first.
const MANY: usize = 12;

/// Singular values of a matrix given by its columns.
///
/// Jacobi's method from one side: columns are turned in pairs until all are orthogonal (Hestenes 1958). What has many columns
/// is brought to six by reflections of its rows before (Golub and Van Loan, *Matrix Computations*, ch. 5.4).
pub fn svd(columns: Vec<[f64; 6]>) -> Svd {
    if columns.len() <= MANY {
        return turned(columns);
    }
    let n = columns.len();
    let (six, mirrors) = reduced(columns);
    let Svd { mut vectors, mut images, mut values } = turned(six);
    vectors.iter_mut().for_each(|v| v.resize(n, 0.0));
    vectors.extend((6..n).map(|k| (0..n).map(|j| f64::from(u8::from(j == k))).collect()));
    for v in &mut vectors {
        mirrors.iter().rev().for_each(|mirror| reflect(v, mirror));
    }
    images.resize(n, [0.0; 6]);
    values.resize(n, 0.0);
    Svd { vectors, images, values }
}

/// The singular values alone, descending; beyond the sixth they are rounding errors.
pub fn singular_values(columns: Vec<[f64; 6]>) -> Vec<f64> {
    let n = columns.len();
    let mut values = turned(if n > MANY { reduced(columns).0 } else { columns }).values;
    values.resize(n, 0.0);
    values
}

/// The six columns to which reflections bring a matrix with more, and the unit normals of their mirrors, in order.
fn reduced(mut columns: Vec<[f64; 6]>) -> (Vec<[f64; 6]>, Vec<Vec<f64>>) {
    let mut mirrors = vec![];
    for k in 0..6 {
        let mut normal: Vec<f64> = columns.iter().map(|c| c[k]).collect();
        normal[..k].fill(0.0);
        let length = norm(&normal);
        normal[k] += length.copysign(normal[k]);
        let by = norm(&normal);
        if by == 0.0 {
            continue;
        }
        normal.iter_mut().for_each(|x| *x /= by);
        for i in k..6 {
            let mut row: Vec<f64> = columns.iter().map(|c| c[i]).collect();
            reflect(&mut row, &normal);
            columns.iter_mut().zip(row).for_each(|(c, x)| c[i] = x);
        }
        mirrors.push(normal);
    }
    columns.truncate(6);
    (columns, mirrors)
}

/// The image of a vector in a mirror with a unit normal.
fn reflect(v: &mut [f64], normal: &[f64]) {
    let along: f64 = v.iter().zip(normal).map(|(x, y)| x * y).sum();
    v.iter_mut().zip(normal).for_each(|(x, y)| *x -= 2.0 * along * y);
}

/// Columns turned until they are orthogonal.
fn turned(mut columns: Vec<[f64; 6]>) -> Svd {
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

#[cfg(test)]
mod tests {
    use super::{dot, singular_values, svd};
    use crate::random::Random;

    #[test]
    fn many_columns_are_decomposed_as_few_are() {
        let mut random = Random(5);
        for (n, rank) in [(1, 1), (6, 6), (12, 6), (13, 6), (13, 3), (40, 6), (40, 1), (200, 6), (200, 0)] {
            let basis: Vec<[f64; 6]> =
                (0..rank).map(|_| std::array::from_fn(|_| random.unit() - 0.5)).collect();
            let columns: Vec<[f64; 6]> = (0..n)
                .map(|_| {
                    let parts: Vec<f64> = basis.iter().map(|_| random.unit() - 0.5).collect();
                    std::array::from_fn(|i| basis.iter().zip(&parts).map(|(b, x)| b[i] * x).sum())
                })
                .collect();
            let found = svd(columns.clone());
            let near = |a: f64, b: f64| (a - b).abs() <= 1e-13 * (n as f64);
            for (i, v) in found.vectors.iter().enumerate() {
                let image: [f64; 6] =
                    std::array::from_fn(|k| columns.iter().zip(v).map(|(c, x)| c[k] * x).sum());
                assert!((0..6).all(|k| near(image[k], found.images[i][k])), "{n} {rank}");
                assert!(near(dot(&image, &image).sqrt(), found.values[i]));
                for (j, w) in found.vectors.iter().enumerate() {
                    let product: f64 = v.iter().zip(w).map(|(x, y)| x * y).sum();
                    assert!(near(product, f64::from(u8::from(i == j))), "{n} {rank}: {i} {j}");
                }
            }
            assert!(found.values.iter().skip(rank).all(|x| near(*x, 0.0)));
            assert!(found.values.iter().zip(singular_values(columns)).all(|(x, y)| near(*x, y)));
        }
    }
}
