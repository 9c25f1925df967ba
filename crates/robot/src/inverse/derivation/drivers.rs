//! Axes that follow others: which axes stand for the joint variables, and how the rest goes with them.
//!
//! A chain with couplings can have more axes than joint variables: the plate of a palletiser turns by −q3. As many axes as
//! there are variables *drive*: their angles and displacements determine the variables, and every other axis turns by a
//! sum of whole multiples of their angles, so that sines and cosines of those determine its own. Where no choice of axes
//! does that (an axis that turns by half of another's angle, of which the angle's sine and cosine say nothing definite),
//! there is no normal form.

use denavit_symbolic::Rational;

/// How the axes of a chain go with those that drive.
#[derive(Clone, PartialEq, Debug)]
pub struct Drivers {
    /// The axes that drive, base first.
    pub axes: Vec<usize>,
    /// For each axis its factors of those, in their order; whole ones for a turn.
    pub factors: Vec<Vec<Rational>>,
    /// For each joint variable the axes it is computed from, with factors.
    pub inverse: Vec<Vec<(usize, Rational)>>,
}

impl Drivers {
    /// Of axes by their factors of `n` joint variables and whether they turn: the first axes that will do, from the base.
    pub fn of(rows: &[Vec<Rational>], turning: &[bool], n: usize) -> Option<Self> {
        let mut chosen = vec![];
        chosen_from(rows, n, &mut chosen, &mut |chosen| {
            let inverse = inverse(rows, chosen, n)?;
            // What computes an angle are angles, what computes a displacement are displacements.
            let of_a_kind =
                |r: &Vec<(usize, Rational)>| r.windows(2).all(|w| turning[w[0].0] == turning[w[1].0]);
            let factors: Vec<Vec<Rational>> = rows.iter().map(|row| factors(row, chosen, &inverse)).collect();
            let follows = |(k, f): (usize, &Vec<Rational>)| {
                let own = f.iter().zip(chosen).filter(|(x, _)| !x.is_zero());
                own.fold(true, |fits, (x, &d)| {
                    fits && turning[d] == turning[k] && (!turning[k] || is_followed(x))
                })
            };
            let fits = inverse.iter().all(of_a_kind) && factors.iter().enumerate().all(follows);
            fits.then(|| Drivers { axes: chosen.to_vec(), factors, inverse })
        })
    }

    /// Whether an axis drives.
    pub fn drives(&self, axis: usize) -> bool {
        self.axes.contains(&axis)
    }

    /// Puts in the values of the axes that follow.
    pub fn follow(&self, values: &mut [f64]) {
        for k in (0..values.len()).filter(|&k| !self.drives(k)) {
            values[k] = self.axes.iter().zip(&self.factors[k]).map(|(&d, x)| x.to_f64() * values[d]).sum();
        }
    }
}

/// More turns of an axis by one of another are not written out as sines and cosines of sums.
const MOST_TURNS: i64 = 16;

/// Whether an angle times this is one that sines and cosines of the angle determine in a few steps.
fn is_followed(factor: &Rational) -> bool {
    factor.is_integer() && factor.to_integer().is_some_and(|n| n.unsigned_abs() <= MOST_TURNS.unsigned_abs())
}

/// Tries sets of `n` independent rows, the first ones first, until something comes of one.
fn chosen_from<T>(
    rows: &[Vec<Rational>],
    n: usize,
    chosen: &mut Vec<usize>,
    of: &mut impl FnMut(&[usize]) -> Option<T>,
) -> Option<T> {
    if chosen.len() == n {
        return of(chosen);
    }
    let first = chosen.last().map_or(0, |k| k + 1);
    for k in first..rows.len() {
        chosen.push(k);
        let found = chosen_from(rows, n, chosen, of);
        if found.is_some() {
            return found;
        }
        chosen.pop();
    }
    None
}

/// For each joint variable the chosen axes it is computed from; nothing if they do not determine it.
fn inverse(rows: &[Vec<Rational>], chosen: &[usize], n: usize) -> Option<Vec<Vec<(usize, Rational)>>> {
    let mut matrix: Vec<Vec<Rational>> = vec![];
    for (i, &k) in chosen.iter().enumerate() {
        let mut row = rows[k].clone();
        row.resize(2 * n, Rational::ZERO);
        row[n + i] = Rational::ONE;
        matrix.push(row);
    }
    for j in 0..n {
        let pivot = (j..n).find(|&i| !matrix[i][j].is_zero())?;
        matrix.swap(j, pivot);
        let inverse = matrix[j][j].recip()?;
        matrix[j].iter_mut().for_each(|x| *x = &*x * &inverse);
        for i in (0..n).filter(|&i| i != j) {
            let factor = matrix[i][j].clone();
            let pivot = matrix[j].clone();
            for (x, y) in matrix[i].iter_mut().zip(&pivot) {
                *x = &*x - &(&factor * y);
            }
        }
    }
    let row = |r: &Vec<Rational>| {
        (0..n).filter(|&i| !r[n + i].is_zero()).map(|i| (chosen[i], r[n + i].clone())).collect()
    };
    Some(matrix.iter().map(row).collect())
}

/// A row as a sum of the chosen ones.
fn factors(row: &[Rational], chosen: &[usize], inverse: &[Vec<(usize, Rational)>]) -> Vec<Rational> {
    let of = |d: &usize| {
        row.iter().zip(inverse).fold(Rational::ZERO, |sum, (x, by)| {
            by.iter().filter(|b| b.0 == *d).fold(sum, |sum, (_, y)| &sum + &(x * y))
        })
    };
    chosen.iter().map(of).collect()
}

/// Sums of whole multiples of some integer vectors, each with how it is made of what was added.
#[derive(Clone, Debug, Default)]
pub struct Lattice {
    /// In echelon form: where a vector begins, the vector, and its factors of what was added.
    rows: Vec<(usize, Vec<i64>, Vec<i64>)>,
    added: usize,
}

impl Lattice {
    /// The factors of what was added that make a vector; nothing if no whole ones do.
    pub fn made(&self, of: &[i64]) -> Option<Vec<i64>> {
        let (mut rest, mut made) = (of.to_vec(), vec![0; self.added]);
        for (pivot, row, by) in &self.rows {
            if rest[*pivot] % row[*pivot] == 0 {
                let factor = rest[*pivot] / row[*pivot];
                subtract(&mut rest, factor, row);
                subtract(&mut made, -factor, by);
            }
        }
        rest.iter().all(|x| *x == 0).then_some(made)
    }

    /// How many of them are independent.
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// The vector is one of them from here on.
    pub fn add(&mut self, vector: &[i64]) {
        let mut by = vec![0; self.added];
        by.push(1);
        self.added += 1;
        self.rows.iter_mut().for_each(|r| r.2.push(0));
        let mut rest = (vector.to_vec(), by);
        while let Some(pivot) = rest.0.iter().position(|x| *x != 0) {
            let Some((_, row, made)) = self.rows.iter_mut().find(|r| r.0 == pivot) else {
                self.rows.push((pivot, rest.0, rest.1));
                self.rows.sort_by_key(|r| r.0);
                return;
            };
            // Euclid's algorithm in the column where both begin.
            while rest.0[pivot] != 0 {
                let factor = row[pivot] / rest.0[pivot];
                subtract(row, factor, &rest.0);
                subtract(made, factor, &rest.1);
                std::mem::swap(row, &mut rest.0);
                std::mem::swap(made, &mut rest.1);
            }
        }
    }
}

/// x − factor·y.
fn subtract(x: &mut [i64], factor: i64, y: &[i64]) {
    x.iter_mut().zip(y).for_each(|(x, y)| *x -= factor * y);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drivers(rows: &[&[i64]], over: i64) -> Option<Drivers> {
        let rows: Vec<Vec<Rational>> =
            rows.iter().map(|r| r.iter().map(|&x| Rational::new(x, over)).collect()).collect();
        let n = rows[0].len();
        Drivers::of(&rows, &vec![true; rows.len()], n)
    }

    #[test]
    fn the_first_axes_drive_of_which_the_rest_are_whole_multiples() {
        // A palletiser's arm: q2, q3 − q2, −q3.
        let found = drivers(&[&[1, 0], &[-1, 1], &[0, -1]], 1).expect("two drive");
        assert_eq!(found.axes, [0, 1]);
        assert_eq!(found.factors[2], [Rational::from(-1), Rational::from(-1)]);
        let mut values = [0.3, -0.5, 0.0];
        found.follow(&mut values);
        assert!((values[2] - 0.2).abs() < 1e-15);
        // Twice an angle follows the angle; the angle does not follow twice itself.
        assert_eq!(drivers(&[&[2], &[1]], 1).expect("one drives").axes, [1]);
        assert!(drivers(&[&[2], &[3]], 1).is_none());
        assert_eq!(drivers(&[&[2], &[1]], 2).expect("one drives").axes, [1]);
    }

    #[test]
    fn a_lattice_has_whole_multiples_alone() {
        let mut lattice = Lattice::default();
        lattice.add(&[2, 0, 4]);
        assert_eq!(lattice.made(&[1, 0, 2]), None);
        assert_eq!(lattice.made(&[-4, 0, -8]), Some(vec![-2]));
        lattice.add(&[3, 0, 6]);
        assert_eq!(lattice.made(&[1, 0, 2]), Some(vec![-1, 1]));
        lattice.add(&[0, 5, 0]);
        assert_eq!(lattice.made(&[1, 5, 2]), Some(vec![-1, 1, 1]));
        assert_eq!(lattice.made(&[1, 4, 2]), None);
    }

    #[test]
    fn what_a_lattice_says_makes_the_vector() {
        let mut random = crate::random::Random(7);
        for _ in 0..2_000 {
            let mut drawn = || (0..3).map(|_| (random.unit() * 9.0) as i64 - 4).collect::<Vec<i64>>();
            let all: Vec<Vec<i64>> = (0..4).map(|_| drawn()).collect();
            let mut lattice = Lattice::default();
            all.iter().for_each(|v| lattice.add(v));
            let factors = drawn();
            let target: Vec<i64> =
                (0..3).map(|i| factors.iter().zip(&all).map(|(f, v)| f * v[i]).sum()).collect();
            let made = lattice.made(&target).expect("it is made of them");
            let again: Vec<i64> =
                (0..3).map(|i| made.iter().zip(&all).map(|(f, v)| f * v[i]).sum()).collect();
            assert_eq!(again, target);
        }
    }
}
