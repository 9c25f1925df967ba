//! Fewer variables: the products of powers of variables by which the terms of a polynomial differ.
//!
//! Of z₂₃² − z₂² only w = z₂₃/z₂ matters: w² − 1. The exponents' differences span a lattice of some rank; a
//! unimodular change of variables writes them in as many coordinates.

use super::field::Gauss;
use super::sparse::{Exponents, Sparse};

type Poly = Sparse<Gauss>;

/// How to come back from the new variables.
pub(super) struct Change {
    /// The exponents of each new variable in the old ones.
    rows: Vec<Vec<i64>>,
    variables: usize,
}

/// Exponents beyond which a change of variables is not worth it.
const MAX_EXPONENT: i64 = 60;

/// Entries beyond which the elimination is given up.
const MAX_ENTRY: i64 = 1 << 24;

/// The polynomial in as few variables as it has; `None` if these are all that occur.
pub(super) fn reduced(p: &Poly) -> Option<(Poly, Change)> {
    let n = p.variables();
    let first = &p.terms().first()?.0;
    let mut rows: Vec<Vec<i64>> = p.terms().iter().map(|t| difference(&t.0, first)).collect();
    let mut inverse: Vec<Vec<i64>> = (0..n).map(|i| (0..n).map(|j| i64::from(i == j)).collect()).collect();
    let mut rank = 0;
    for r in 0..rows.len() {
        // Euclid on the columns from `rank` on until one of them holds this row.
        loop {
            let mut with: Vec<usize> = (rank..n).filter(|&c| rows[r][c] != 0).collect();
            with.sort_by_key(|&c| rows[r][c].abs());
            match with[..] {
                [] => break,
                [only] => {
                    rows.iter_mut().for_each(|row| row.swap(only, rank));
                    inverse.swap(only, rank);
                    rank += 1;
                    break;
                }
                [smallest, next, ..] => {
                    let q = rows[r][next].div_euclid(rows[r][smallest]);
                    rows.iter_mut().for_each(|row| row[next] -= q * row[smallest]);
                    let added = inverse[next].clone();
                    inverse[smallest].iter_mut().zip(added).for_each(|(a, b)| *a += q * b);
                    if rows.iter().chain(&inverse).flatten().any(|e| e.abs() > MAX_ENTRY) {
                        return None;
                    }
                }
            }
        }
    }
    if rank >= p.used().len()
        || rows.iter().flatten().chain(inverse.iter().flatten()).any(|e| e.abs() > MAX_EXPONENT)
    {
        return None;
    }
    let low: Vec<i64> = (0..rank).map(|c| rows.iter().map(|row| row[c]).min().unwrap_or(0)).collect();
    let exponents = |row: &Vec<i64>| (0..rank).map(|c| (row[c] - low[c]) as u16).collect::<Exponents>();
    let terms = rows.iter().zip(p.terms()).map(|(row, t)| (exponents(row), t.1.clone()));
    inverse.truncate(rank);
    Some((Poly::from_terms(rank, terms), Change { rows: inverse, variables: n }))
}

fn difference(a: &Exponents, b: &Exponents) -> Vec<i64> {
    a.iter().zip(b).map(|(x, y)| i64::from(*x) - i64::from(*y)).collect()
}

impl Change {
    /// A polynomial in the old variables, divided by its monomial.
    pub fn undone(&self, p: &Poly) -> Poly {
        let old = |e: &Exponents| -> Vec<i64> {
            let entry = |c: usize| e.iter().zip(&self.rows).map(|(&n, row)| i64::from(n) * row[c]).sum();
            (0..self.variables).map(entry).collect()
        };
        let all: Vec<Vec<i64>> = p.terms().iter().map(|t| old(&t.0)).collect();
        let low: Vec<i64> =
            (0..self.variables).map(|c| all.iter().map(|row| row[c]).min().unwrap_or(0)).collect();
        let terms = all
            .iter()
            .zip(p.terms())
            .map(|(row, t)| (row.iter().zip(&low).map(|(e, m)| (e - m) as u16).collect(), t.1.clone()));
        Poly::from_terms(self.variables, terms)
    }
}
