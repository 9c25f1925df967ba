//! Least squares and ranks of small matrices, given by their columns.

/// A matrix as Q·R, its columns in the order of their pivots (Gram and Schmidt, each step twice).
pub struct Factors {
    /// Orthonormal columns.
    q: Vec<Vec<f64>>,
    /// Of each pivot the column that it was, and its coefficients in the columns of `q` up to its own.
    r: Vec<(usize, Vec<f64>)>,
    columns: usize,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

impl Factors {
    /// Those of a matrix; columns of which less is left than `tolerance` times the longest count as dependent.
    pub fn of(columns: &[Vec<f64>], tolerance: f64) -> Self {
        let mut left: Vec<Vec<f64>> = columns.to_vec();
        let mut coefficients: Vec<Vec<f64>> = vec![vec![]; columns.len()];
        let mut open: Vec<usize> = (0..columns.len()).collect();
        let mut q: Vec<Vec<f64>> = vec![];
        let mut r: Vec<(usize, Vec<f64>)> = vec![];
        let mut first = 0.0;
        loop {
            let length = |j: usize| dot(&left[j], &left[j]).sqrt();
            let longest = open.iter().copied().max_by(|&a, &b| length(a).total_cmp(&length(b)));
            let Some((j, pivot)) = longest.map(|j| (j, length(j))) else { break };
            if q.is_empty() {
                first = pivot;
            }
            if !pivot.is_finite() || pivot <= tolerance * first || pivot < f64::MIN_POSITIVE {
                break;
            }
            let unit: Vec<f64> = left[j].iter().map(|x| x / pivot).collect();
            open.retain(|&k| k != j);
            for &k in &open {
                let mut sum = 0.0;
                for _ in 0..2 {
                    let by = dot(&unit, &left[k]);
                    left[k].iter_mut().zip(&unit).for_each(|(x, u)| *x -= by * u);
                    sum += by;
                }
                coefficients[k].push(sum);
            }
            let mut own = std::mem::take(&mut coefficients[j]);
            own.push(pivot);
            q.push(unit);
            r.push((j, own));
        }
        Factors { q, r, columns: columns.len() }
    }

    /// How many columns are independent.
    pub fn rank(&self) -> usize {
        self.q.len()
    }

    /// The columns that were not taken: they depend on the others.
    pub fn dependent(&self) -> Vec<usize> {
        (0..self.columns).filter(|j| self.r.iter().all(|r| r.0 != *j)).collect()
    }

    /// The coefficients of the independent columns with which they are nearest to a vector; 0 for the others.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let along: Vec<f64> = self.q.iter().map(|q| dot(q, b)).collect();
        let mut x = vec![0.0; self.columns];
        for k in (0..self.r.len()).rev() {
            let behind: f64 = self.r[k + 1..].iter().map(|(j, c)| c[k] * x[*j]).sum();
            x[self.r[k].0] = (along[k] - behind) / self.r[k].1[k];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::Factors;

    #[test]
    fn what_is_solved_is_the_equation_and_what_depends_is_found() {
        let a = vec![vec![1.0, 2.0, 0.0], vec![2.0, 4.0, 0.0], vec![0.5, 0.0, 3.0]];
        let factors = Factors::of(&a, 1e-9);
        assert_eq!((factors.rank(), factors.dependent()), (2, vec![0]));
        let b = [2.5, 4.0, 3.0]; // the second column and the third, and half the first: 2.5 = 2 + 0.5, 4, 3
        let x = factors.solve(&b);
        let back: Vec<f64> = (0..3).map(|i| (0..3).map(|j| a[j][i] * x[j]).sum()).collect();
        assert!(back.iter().zip(b).all(|(p, q): (&f64, f64)| (p - q).abs() < 1e-14), "{back:?}");
    }
}
