//! Turns in numbers: their logarithms and exponentials, the turn nearest to a matrix, small linear systems.
//!
//! Angles in radians. The nearest turn is Horn's (1987): a quaternion, the eigenvector of a symmetric 4×4 matrix, so that it is
//! never a mirror image.

use denavit::geometry::orientation::{OrientationSet, extract};
use denavit::geometry::{Rotation, Vector};

/// Beyond this angle the axis comes from the symmetric part of the matrix, radians.
const NEARLY_HALF: f64 = 3.0;

/// Twice the sine of the angle along the axis: the antisymmetric part.
fn vee(r: &Rotation<f64>) -> Vector<f64> {
    let [[_, xy, xz], [yx, _, yz], [zx, zy, _]] = r.rows();
    Vector([zy - yz, xz - zx, yx - xy])
}

/// The angle of a turn.
pub fn angle(r: &Rotation<f64>) -> f64 {
    let [[xx, ..], [_, yy, _], [.., zz]] = r.rows();
    // atan2, for the arc cosine is blind to small angles.
    (0.5 * vee(r).norm()).atan2(0.5 * (xx + yy + zz - 1.0))
}

/// ∠(aᵀ b)
pub fn between(a: &Rotation<f64>, b: &Rotation<f64>) -> f64 {
    angle(&(a.inverse() * *b))
}

/// The axis times the angle.
pub fn log(r: &Rotation<f64>) -> Vector<f64> {
    let (v, t) = (vee(r), angle(r));
    if t > NEARLY_HALF {
        let values = extract(r, OrientationSet::AxisAngle).values;
        return Vector([values[0], values[1], values[2]]).scale(values[3]);
    }
    let s = 0.5 * v.norm();
    v.scale(if s > 1e-9 { t / (2.0 * s) } else { 0.5 })
}

/// The turn about a vector by its length (Rodrigues).
pub fn exp(w: Vector<f64>) -> Rotation<f64> {
    let t = w.norm();
    let (a, b) = if t > 1e-6 {
        (t.sin() / t, (1.0 - t.cos()) / (t * t))
    } else {
        (1.0 - t * t / 6.0, 0.5 - t * t / 24.0)
    };
    let [x, y, z] = w.0;
    let diagonal = |p: f64, q: f64| 1.0 - b * (p * p + q * q);
    Rotation::from_rows([
        [diagonal(y, z), b * x * y - a * z, b * x * z + a * y],
        [b * x * y + a * z, diagonal(x, z), b * y * z - a * x],
        [b * x * z - a * y, b * y * z + a * x, diagonal(x, y)],
    ])
}

/// A sum of matrices 3×3.
#[derive(Clone, Copy, Default)]
pub struct Sum(pub [[f64; 3]; 3]);

impl Sum {
    /// Adds b aᵀ.
    pub fn outer(&mut self, b: Vector<f64>, a: Vector<f64>) {
        for (i, row) in self.0.iter_mut().enumerate() {
            for (j, x) in row.iter_mut().enumerate() {
                *x += b[i] * a[j];
            }
        }
    }

    /// Adds a matrix.
    pub fn add(&mut self, r: &Rotation<f64>) {
        for (row, other) in self.0.iter_mut().zip(r.rows()) {
            for (x, y) in row.iter_mut().zip(other) {
                *x += y;
            }
        }
    }

    /// The turn R with the largest tr(Rᵀ M): for M = Σ b aᵀ the one that brings the a nearest to the b.
    pub fn nearest(&self) -> Rotation<f64> {
        let m = self.0;
        // S = Mᵀ in Horn's letters.
        let s = |i: usize, j: usize| m[j][i];
        let (x, y, z) = (s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0));
        let (xx, yy, zz) = (s(0, 0), s(1, 1), s(2, 2));
        let (xy, xz, yz) = (s(0, 1) + s(1, 0), s(0, 2) + s(2, 0), s(1, 2) + s(2, 1));
        let (values, vectors) = eigen([
            [xx + yy + zz, x, y, z],
            [x, xx - yy - zz, xy, xz],
            [y, xy, yy - xx - zz, yz],
            [z, xz, yz, zz - xx - yy],
        ]);
        let best = (0..4).fold(0, |b, k| if values[k] > values[b] { k } else { b });
        let [w, x, y, z] = std::array::from_fn(|i| vectors[i][best]);
        let d = |a: f64, b: f64| 1.0 - 2.0 * (a * a + b * b);
        Rotation::from_rows([
            [d(y, z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
            [2.0 * (x * y + z * w), d(x, z), 2.0 * (y * z - x * w)],
            [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), d(x, y)],
        ])
    }
}

/// Eigenvalues of a symmetric matrix, and eigenvectors in columns (Jacobi).
pub fn eigen<const N: usize>(mut a: [[f64; N]; N]) -> ([f64; N], [[f64; N]; N]) {
    let mut v = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for _ in 0..30 {
        let off: f64 = (0..N).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| a[i][j].powi(2)).sum();
        let on: f64 = (0..N).map(|i| a[i][i].powi(2)).sum();
        if off.is_nan() || off <= 1e-30 * on {
            break;
        }
        for p in 0..N {
            for q in p + 1..N {
                if a[p][q] == 0.0 {
                    continue;
                }
                let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
                let c = 1.0 / t.hypot(1.0);
                let s = t * c;
                for row in &mut a {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                let (row_p, row_q) = (a[p], a[q]);
                a[p] = std::array::from_fn(|k| c * row_p[k] - s * row_q[k]);
                a[q] = std::array::from_fn(|k| s * row_p[k] + c * row_q[k]);
                for row in &mut v {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
            }
        }
    }
    (std::array::from_fn(|i| a[i][i]), v)
}

/// Solves a symmetric positive system (Cholesky), n×n by rows; what has no pivot stays 0.
pub fn solve(mut a: Vec<f64>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    let mut dead = vec![false; n];
    for j in 0..n {
        let d = a[j * n + j] - (0..j).map(|k| a[j * n + k].powi(2)).sum::<f64>();
        if d.is_nan() || d <= 0.0 {
            (dead[j], a[j * n + j]) = (true, 1.0);
            (j + 1..n).for_each(|i| a[i * n + j] = 0.0);
            continue;
        }
        let pivot = d.sqrt();
        a[j * n + j] = pivot;
        for i in j + 1..n {
            let s: f64 = (0..j).map(|k| a[i * n + k] * a[j * n + k]).sum();
            a[i * n + j] = (a[i * n + j] - s) / pivot;
        }
    }
    for i in 0..n {
        let s: f64 = (0..i).map(|k| a[i * n + k] * b[k]).sum();
        b[i] = if dead[i] { 0.0 } else { (b[i] - s) / a[i * n + i] };
    }
    for i in (0..n).rev() {
        let s: f64 = (i + 1..n).map(|k| a[k * n + i] * b[k]).sum();
        b[i] = if dead[i] { 0.0 } else { (b[i] - s) / a[i * n + i] };
    }
    b
}
