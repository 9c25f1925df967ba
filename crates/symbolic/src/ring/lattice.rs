//! Integer bases of angle sums.
//!
//! The angles of a formula span a lattice. A basis taken from the angles that occur (θ2, θ2+θ3, …) keeps a
//! polynomial short, where single angles would expand every merged sum.

use crate::expr::{Angle, Expr};
use crate::rational::Rational;

/// The coordinates of `angle` in `basis`, constants left aside: `angle = Σ nᵢ·basisᵢ + constant`.
/// `None` if they do not exist, or are not all integers.
pub(crate) fn coordinates(angle: &Angle, basis: &[Angle]) -> Option<Vec<i64>> {
    rational_coordinates(angle, basis)?.iter().map(Rational::to_integer).collect()
}

fn rational_coordinates(angle: &Angle, basis: &[Angle]) -> Option<Vec<Rational>> {
    // Gauss–Jordan on the system Σ nⱼ·basisⱼ = angle, one row for each symbol.
    let mut symbols: Vec<Expr> =
        basis.iter().chain([angle]).flat_map(|a| a.terms.iter().map(|t| t.0)).collect();
    symbols.sort_unstable();
    symbols.dedup();
    let entry =
        |a: &Angle, x: Expr| a.terms.iter().find(|t| t.0 == x).map_or(Rational::ZERO, |t| t.1.clone());
    let n = basis.len();
    let mut rows: Vec<Vec<Rational>> =
        symbols.iter().map(|&x| basis.iter().chain([angle]).map(|a| entry(a, x)).collect()).collect();
    let mut pivots = vec![];
    for column in 0..n {
        let done = pivots.len();
        let Some(at) = (done..rows.len()).find(|&r| !rows[r][column].is_zero()) else { continue };
        rows.swap(done, at);
        let scale = rows[done][column].recip()?;
        rows[done].iter_mut().for_each(|x| *x = &*x * &scale);
        let pivot = rows[done].clone();
        for (r, row) in rows.iter_mut().enumerate() {
            if r != done && !row[column].is_zero() {
                let k = row[column].clone();
                row.iter_mut().zip(&pivot).for_each(|(x, p)| *x = &*x - &(&k * p));
            }
        }
        pivots.push(column);
    }
    if rows[pivots.len()..].iter().any(|row| !row[n].is_zero()) {
        return None;
    }
    let mut solution = vec![Rational::ZERO; n];
    for (row, &column) in rows.iter().zip(&pivots) {
        solution[column] = row[n].clone();
    }
    Some(solution)
}

/// Extends `basis` to one in which every one of `angles` has integer coordinates, constants left aside. Angles that occur are
/// preferred, shorter sums first; if they do not suffice (2θ and 3θ), a basis is computed from scratch.
pub(crate) fn extend_basis(basis: Vec<Angle>, angles: &[Angle]) -> Vec<Angle> {
    let mut sorted: Vec<&Angle> = angles.iter().filter(|a| !a.is_constant()).collect();
    let has_constant = |a: &Angle| !(a.turns.is_zero() && a.radians.is_zero());
    sorted.sort_by_key(|a| (a.terms.len(), a.terms.iter().map(|t| t.1.abs()).max(), has_constant(a)));
    let mut extended = basis;
    for angle in &sorted {
        if rational_coordinates(angle, &extended).is_none() {
            extended.push((*angle).clone());
        }
    }
    if sorted.iter().all(|a| coordinates(a, &extended).is_some()) {
        return extended;
    }
    let all: Vec<&Angle> = extended.iter().chain(sorted).collect();
    hermite_basis(&all)
}

/// A basis of the lattice that `angles` span, by integer elimination.
fn hermite_basis(angles: &[&Angle]) -> Vec<Angle> {
    let mut symbols: Vec<Expr> = angles.iter().flat_map(|a| a.terms.iter().map(|t| t.0)).collect();
    symbols.sort_unstable();
    symbols.dedup();
    let mut rows: Vec<Angle> =
        angles.iter().map(|a| Angle { terms: a.terms.clone(), ..Angle::default() }).collect();
    let entry =
        |a: &Angle, x: Expr| a.terms.iter().find(|t| t.0 == x).map_or(Rational::ZERO, |t| t.1.clone());
    let mut basis = vec![];
    for x in symbols {
        // Euclid on the coefficients of x until one row holds it.
        loop {
            rows.retain(|r| !r.is_constant());
            let mut with: Vec<usize> = (0..rows.len()).filter(|&r| !entry(&rows[r], x).is_zero()).collect();
            with.sort_by_key(|&r| entry(&rows[r], x).abs());
            match with[..] {
                [] => break,
                [only] => {
                    basis.push(rows.swap_remove(only));
                    break;
                }
                [smallest, next, ..] => {
                    let quotient = (&entry(&rows[next], x) / &entry(&rows[smallest], x)).floor();
                    rows[next] = rows[next].plus(&rows[smallest].scaled(&-quotient));
                }
            }
        }
    }
    basis
}

#[cfg(test)]
mod tests {
    use super::*;

    fn angle(terms: &[(&str, i64, i64)]) -> Angle {
        Angle::of(
            terms
                .iter()
                .fold(Expr::int(0), |s, &(x, n, d)| s + Expr::from(Rational::new(n, d)) * Expr::symbol(x)),
        )
    }

    #[test]
    fn sums_that_occur_become_the_basis() {
        let (t2, t23, t234) = (
            angle(&[("q2", 1, 1)]),
            angle(&[("q2", 1, 1), ("q3", 1, 1)]),
            angle(&[("q2", 1, 1), ("q3", 1, 1), ("q4", 1, 1)]),
        );
        let basis = extend_basis(vec![], &[t234.clone(), t2.clone(), t23.clone()]);
        assert_eq!(basis, [t2, t23, t234]);
        assert_eq!(coordinates(&angle(&[("q3", 1, 1), ("q4", 1, 1)]), &basis), Some(vec![-1, 0, 1]));
        assert_eq!(coordinates(&angle(&[("q5", 1, 1)]), &basis), None);
        assert_eq!(coordinates(&angle(&[("q2", 1, 2)]), &basis), None);
    }

    #[test]
    fn multiples_and_halves_find_their_common_measure() {
        for angles in [
            vec![angle(&[("x", 2, 1)]), angle(&[("x", 3, 1)])],
            vec![angle(&[("x", 1, 2)]), angle(&[("x", 1, 3)])],
            vec![
                angle(&[("x", 1, 1), ("y", 1, 1)]),
                angle(&[("x", 1, 1), ("y", -1, 1)]),
                angle(&[("x", 1, 1)]),
            ],
        ] {
            let basis = extend_basis(vec![], &angles);
            assert!(angles.iter().all(|a| coordinates(a, &basis).is_some()), "{basis:?}");
        }
    }
}
