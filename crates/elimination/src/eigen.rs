//! Real eigenvalues and null vectors of matrices of at most six rows.

/// Most rows: solutions that can share a value of the hidden joint and still be told apart.
pub const SHARED: usize = 6;

/// The eigenvalues of the leading `size × size` block that are real up to a relative tolerance; their number.
///
/// The characteristic polynomial by Faddeev and LeVerrier, its roots by Weierstrass' simultaneous iteration.
pub fn real_eigenvalues(
    m: &[[f64; SHARED]; SHARED],
    size: usize,
    tolerance: f64,
    out: &mut [f64; SHARED],
) -> usize {
    if size == 2 {
        let (half, difference) = ((m[0][0] + m[1][1]) / 2.0, (m[0][0] - m[1][1]) / 2.0);
        let under = difference * difference + m[0][1] * m[1][0];
        // A pair that is complex by a little is a double one.
        if under < -tolerance * tolerance * (half * half + difference * difference + 1e-12) {
            return 0;
        }
        let root = under.max(0.0).sqrt();
        out[0] = half + root;
        out[1] = half - root;
        return 2;
    }
    // M ← A (M + c I), c ← −tr(M)/k
    let mut c = [0.0; SHARED + 1];
    c[size] = 1.0;
    let mut product = [[0.0; SHARED]; SHARED];
    for k in 1..=size {
        let mut sum = product;
        for (i, row) in sum.iter_mut().enumerate().take(size) {
            row[i] += c[size + 1 - k];
        }
        for i in 0..size {
            for j in 0..size {
                product[i][j] = (0..size).map(|l| m[i][l] * sum[l][j]).sum();
            }
        }
        c[size - k] = -(0..size).map(|i| product[i][i]).sum::<f64>() / k as f64;
    }
    let radius = 1.0 + c[..size].iter().fold(0.0f64, |a, b| a.max(b.abs()));
    let mut z = [(0.0, 0.0); SHARED];
    for (k, z) in z.iter_mut().enumerate() {
        let (s, c) = (0.4 + 2.0 * std::f64::consts::PI * k as f64 / size as f64).sin_cos();
        *z = (radius.sqrt() * c, radius.sqrt() * s);
    }
    let times = |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    for _ in 0..60 {
        let mut largest = 0.0f64;
        for k in 0..size {
            let mut value = (1.0, 0.0);
            for j in (0..size).rev() {
                value = times(value, z[k]);
                value.0 += c[j];
            }
            let mut below = (1.0, 0.0);
            for j in 0..size {
                if j != k {
                    below = times(below, (z[k].0 - z[j].0, z[k].1 - z[j].1));
                }
            }
            let square = below.0 * below.0 + below.1 * below.1;
            if square == 0.0 {
                continue;
            }
            let step = times(value, (below.0 / square, -below.1 / square));
            z[k] = (z[k].0 - step.0, z[k].1 - step.1);
            largest = largest.max(step.0.abs() + step.1.abs());
        }
        if largest < 1e-13 {
            break;
        }
    }
    let mut found = 0;
    for z in &z[..size] {
        if z.1.abs() <= tolerance * (1.0 + z.0.abs()) {
            out[found] = z.0;
            found += 1;
        }
    }
    found
}

/// A vector that the leading block, singular or almost, takes to nearly zero.
pub fn null_vector(m: &mut [[f64; SHARED]; SHARED], size: usize) -> [f64; SHARED] {
    let mut order: [usize; SHARED] = std::array::from_fn(|k| k);
    for k in 0..size - 1 {
        let (mut best, mut row, mut column) = (-1.0, k, k);
        for (r, entries) in m.iter().enumerate().take(size).skip(k) {
            for (c, entry) in entries.iter().enumerate().take(size).skip(k) {
                if entry.abs() > best {
                    (best, row, column) = (entry.abs(), r, c);
                }
            }
        }
        m.swap(k, row);
        for entries in m.iter_mut() {
            entries.swap(k, column);
        }
        order.swap(k, column);
        let pivot_row = m[k];
        if pivot_row[k] == 0.0 {
            break;
        }
        for entries in m.iter_mut().take(size).skip(k + 1) {
            let factor = entries[k] / pivot_row[k];
            for (entry, pivot) in entries.iter_mut().zip(&pivot_row).skip(k) {
                *entry -= factor * pivot;
            }
        }
    }
    let mut y = [0.0; SHARED];
    y[size - 1] = 1.0;
    for k in (0..size - 1).rev() {
        let sum: f64 = (k + 1..size).map(|c| m[k][c] * y[c]).sum();
        y[k] = if m[k][k] == 0.0 { 0.0 } else { -sum / m[k][k] };
    }
    let mut out = [0.0; SHARED];
    for (place, y) in order.iter().zip(y) {
        out[*place] = y;
    }
    out
}
