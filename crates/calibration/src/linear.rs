//! Small dense linear algebra: singular values, eigenvalues of symmetric matrices, null vectors of small matrices.
//!
//! Singular values come from one-sided rotations of Jacobi on the triangle that Householder's reflections leave: small ones are
//! right to the last digits of the large ones.

/// Singular values, the largest first, and the right singular vectors that belong to them; matrices by their columns.
pub struct Singular {
    /// The values.
    pub values: Vec<f64>,
    /// The vectors.
    pub vectors: Vec<Vec<f64>>,
}

/// The singular values of a matrix by its columns, all of one length.
pub fn singular(columns: &[Vec<f64>]) -> Singular {
    let n = columns.len();
    let mut a = triangle(columns.to_vec());
    let mut v: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for _ in 0..60 {
        let mut worst = 0.0_f64;
        for p in 0..n {
            for q in p + 1..n {
                let (x, y, z) = (dot(&a[p], &a[p]), dot(&a[q], &a[q]), dot(&a[p], &a[q]));
                if z == 0.0 || x == 0.0 || y == 0.0 {
                    continue;
                }
                worst = worst.max(z.abs() / (x.sqrt() * y.sqrt()));
                if z.abs() <= 1e-16 * (x.sqrt() * y.sqrt()) {
                    continue;
                }
                let theta = (y - x) / (2.0 * z);
                let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
                let c = 1.0 / t.hypot(1.0);
                turn(&mut a, p, q, c, c * t);
                turn(&mut v, p, q, c, c * t);
            }
        }
        if worst < 1e-15 {
            break;
        }
    }
    let mut order: Vec<(f64, usize)> = a.iter().map(|c| dot(c, c).sqrt()).zip(0..).collect();
    order.sort_by(|x, y| y.0.total_cmp(&x.0));
    Singular {
        values: order.iter().map(|o| o.0).collect(),
        vectors: order.iter().map(|o| v[o.1].clone()).collect(),
    }
}

/// Columns p and q turned.
fn turn(a: &mut [Vec<f64>], p: usize, q: usize, c: f64, s: f64) {
    let (left, right) = a.split_at_mut(q);
    for (x, y) in left[p].iter_mut().zip(&mut right[0]) {
        (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
    }
}

/// The triangle R of A = Q R, by its columns (Householder); the matrix itself where it has fewer rows than columns.
fn triangle(mut a: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let n = a.len();
    let m = a.first().map_or(0, Vec::len);
    if m <= n {
        return a;
    }
    for k in 0..n {
        let norm = dot(&a[k][k..], &a[k][k..]).sqrt();
        if norm == 0.0 {
            continue;
        }
        let mut u = a[k][k..].to_vec();
        u[0] += if u[0] < 0.0 { -norm } else { norm };
        let size = dot(&u, &u);
        for column in &mut a[k..] {
            let by = 2.0 * dot(&u, &column[k..]) / size;
            column[k..].iter_mut().zip(&u).for_each(|(x, y)| *x -= by * y);
        }
    }
    a.into_iter()
        .enumerate()
        .map(|(k, mut c)| {
            c.truncate(n);
            c[k + 1..].fill(0.0);
            c
        })
        .collect()
}

/// The inner product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Eigenvalues of a symmetric matrix by rows, and its eigenvectors (Jacobi).
pub fn symmetric(mut a: Vec<Vec<f64>>) -> (Vec<f64>, Vec<Vec<f64>>) {
    let n = a.len();
    let mut v: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for _ in 0..60 {
        let mut worst = 0.0_f64;
        for p in 0..n {
            for q in p + 1..n {
                let size = (a[p][p] * a[q][q]).abs().sqrt();
                if a[p][q] == 0.0 || a[p][q].abs() <= 1e-17 * size {
                    continue;
                }
                worst = worst.max(a[p][q].abs() / size.max(1e-300));
                let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
                let c = 1.0 / t.hypot(1.0);
                let s = c * t;
                for row in &mut a {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                turn(&mut a, p, q, c, s);
                turn(&mut v, p, q, c, s);
            }
        }
        if worst < 1e-15 {
            break;
        }
    }
    ((0..n).map(|i| a[i][i]).collect(), v)
}

/// What of a matrix by its columns is zero: a basis of its null vectors, one for each column that is a sum of those before it,
/// with 1 there. Entries below the tolerance, of columns of length 1, are zero.
pub fn null_vectors(columns: &[Vec<f64>], tolerance: f64) -> Vec<Vec<f64>> {
    let m = columns.first().map_or(0, Vec::len);
    let sizes: Vec<f64> = columns.iter().map(|c| dot(c, c).sqrt()).collect();
    let unit = |k: usize| if sizes[k] > 1e-12 { 1.0 / sizes[k] } else { 0.0 };
    // Rows of the matrix with columns of length 1.
    let mut a: Vec<Vec<f64>> =
        (0..m).map(|r| columns.iter().enumerate().map(|(k, c)| c[r] * unit(k)).collect()).collect();
    let (mut pivots, mut free) = (vec![], vec![]);
    for k in 0..columns.len() {
        let from = pivots.len();
        let best = (from..m).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()));
        let Some(best) = best.filter(|&i| a[i][k].abs() > tolerance) else {
            free.push(k);
            continue;
        };
        a.swap(from, best);
        let by = a[from][k];
        a[from].iter_mut().for_each(|x| *x /= by);
        let pivot = a[from].clone();
        for (r, row) in a.iter_mut().enumerate() {
            let by = row[k];
            if r != from && by != 0.0 {
                row.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= by * y);
            }
        }
        pivots.push(k);
    }
    let vector = |&k: &usize| {
        let mut v = vec![0.0; columns.len()];
        v[k] = 1.0;
        let own = if sizes[k] > 1e-12 { sizes[k] } else { 1.0 };
        for (r, &p) in pivots.iter().enumerate() {
            let x = -a[r][k] * own * unit(p);
            v[p] = if x.abs() > tolerance { x } else { 0.0 };
        }
        v
    };
    free.iter().map(vector).collect()
}
