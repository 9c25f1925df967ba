//! Symmetric positive definite systems in which an unknown meets only its two neighbours on each side.

/// The lower half: entry `i` holds the diagonal, and the entries one and two columns before it.
pub(super) type Pentadiagonal = Vec<[f64; 3]>;

/// Replaces `right` by the solution of `matrix · x = right` (Cholesky's L D Lᵀ); `false` if the matrix is not positive
/// definite.
pub(super) fn solve(matrix: &mut Pentadiagonal, right: &mut [f64]) -> bool {
    let n = right.len();
    for i in 0..n {
        // Row i of L·D, then of L: l₂ = a₂ / d, l₁ = (a₁ − l₂ d l₁') / d'.
        let [mut d, mut one, mut two] = matrix[i];
        if i >= 2 {
            let l = two / matrix[i - 2][0];
            d -= two * l;
            one -= two * matrix[i - 1][1];
            two = l;
        }
        if i >= 1 {
            let l = one / matrix[i - 1][0];
            d -= one * l;
            one = l;
        }
        if d.is_nan() || d <= 0.0 {
            return false;
        }
        matrix[i] = [d, one, two];
    }
    for i in 0..n {
        if i >= 1 {
            right[i] -= matrix[i][1] * right[i - 1];
        }
        if i >= 2 {
            right[i] -= matrix[i][2] * right[i - 2];
        }
    }
    for i in (0..n).rev() {
        right[i] /= matrix[i][0];
        if i + 1 < n {
            right[i] -= matrix[i + 1][1] * right[i + 1];
        }
        if i + 2 < n {
            right[i] -= matrix[i + 2][2] * right[i + 2];
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_satisfies_the_system() {
        let n = 6;
        let full = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 7.0 + i as f64,
            1 => 1.5 - 0.3 * i.min(j) as f64,
            2 => -0.8 + 0.1 * i.min(j) as f64,
            _ => 0.0,
        };
        let mut matrix: Pentadiagonal =
            (0..n).map(|i| std::array::from_fn(|k| if k <= i { full(i, i - k) } else { 0.0 })).collect();
        let right: Vec<f64> = (0..n).map(|i| (i * i) as f64 - 3.0).collect();
        let mut x = right.clone();
        assert!(solve(&mut matrix, &mut x));
        for (i, right) in right.iter().enumerate() {
            let product: f64 = (0..n).map(|j| full(i, j) * x[j]).sum();
            assert!((product - right).abs() < 1e-12, "row {i}");
        }
    }
}
