//! Determinants of square parts of a Jacobian, in factors.

use crate::velocity::geometric::Jacobian;
use denavit_symbolic::factor::{Factored, factored};
use denavit_symbolic::poly::Poly;
use denavit_symbolic::{Expr, Refusal, Ring, Symbol};
use rustc_hash::FxHashMap;

/// The determinant of a square part.
#[derive(Clone, Debug)]
pub struct Minor {
    /// Which rows it has, from 0.
    pub rows: Vec<usize>,
    /// Which joints it has, from 0.
    pub joints: Vec<usize>,
    /// The determinant in factors.
    pub determinant: Factored,
}

/// Terms of a determinant beyond which nobody reads its factors.
const MOST_TERMS: usize = 1_000;

/// The largest square parts of some rows whose determinants are not identically 0, those with one row and one joint less where
/// the largest are all 0; none if these are, too. Joints that do not move the body at all are left out.
pub fn all(matrix: &Jacobian<Expr>, allowed: &[usize], order: &[Symbol]) -> Result<Vec<Minor>, Refusal> {
    let moving = moving(matrix, allowed);
    let n = moving.len();
    let most = n.min(allowed.len());
    let entries: Vec<Expr> = matrix.columns.iter().flatten().copied().collect();
    let mut ring = Ring::new(&entries, order);
    let mut rows: Vec<Vec<Poly>> = vec![];
    for row in matrix.rows() {
        rows.push(row.into_iter().map(|e| ring.polynomial(e)).collect::<Result<_, _>>()?);
    }
    for size in (most.saturating_sub(1).max(1)..=most).rev() {
        let minors = of_size(&mut ring, &rows, (allowed, &moving), size, order)?;
        if !minors.is_empty() {
            return Ok(minors);
        }
    }
    Ok(vec![])
}

/// The square parts with so many rows and joints whose determinants are not identically 0.
fn of_size(
    ring: &mut Ring,
    rows: &[Vec<Poly>],
    (allowed, moving): (&[usize], &[usize]),
    size: usize,
    order: &[Symbol],
) -> Result<Vec<Minor>, Refusal> {
    let mut minors = vec![];
    for chosen in subsets(allowed.len(), size) {
        let chosen: Vec<usize> = chosen.into_iter().map(|r| allowed[r]).collect();
        for joints in subsets(moving.len(), size) {
            let joints: Vec<usize> = joints.into_iter().map(|j| moving[j]).collect();
            let part: Vec<Vec<&Poly>> =
                chosen.iter().map(|&r| joints.iter().map(|&j| &rows[r][j]).collect()).collect();
            let p = determinant(ring, part)?;
            if p.terms().len() > MOST_TERMS {
                return Err(Refusal::TooLarge);
            }
            if !p.is_zero() {
                let determinant = factored(ring.poly_expr(&p), order)?;
                minors.push(Minor { rows: chosen.clone(), joints, determinant });
            }
        }
    }
    Ok(minors)
}

/// The joints that move the body in some of these rows.
fn moving(matrix: &Jacobian<Expr>, allowed: &[usize]) -> Vec<usize> {
    let moves = |j: &usize| allowed.iter().any(|&r| !matrix.columns[*j][r].is_zero());
    (0..matrix.columns.len()).filter(moves).collect()
}

/// The number of rows, or of joints that move the body, if that is less.
pub fn rank(matrix: &Jacobian<Expr>, allowed: &[usize]) -> usize {
    moving(matrix, allowed).len().min(allowed.len())
}

/// All ways to choose `k` of `0 … n−1`, in order.
fn subsets(n: usize, k: usize) -> Vec<Vec<usize>> {
    let of = |mask: u32| (0..n).filter(|i| mask >> i & 1 == 1).collect::<Vec<usize>>();
    let mut all: Vec<Vec<usize>> = (0..1_u32 << n).filter(|m| m.count_ones() as usize == k).map(of).collect();
    all.sort();
    all
}

/// By Laplace's rule, rows with many zeros first; what is left over of the columns is expanded once.
fn determinant(ring: &mut Ring, mut rows: Vec<Vec<&Poly>>) -> Result<Poly, Refusal> {
    let n = rows.len();
    // Exchanging rows changes the sign.
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by_key(|&r| rows[r].iter().filter(|p| !p.is_zero()).count());
    let inversions =
        (0..n).flat_map(|i| (0..i).map(move |j| (j, i))).filter(|&(j, i)| order[j] > order[i]).count();
    rows = order.iter().map(|&r| rows[r].clone()).collect();
    let mut known = FxHashMap::default();
    let p = expanded(ring, &rows, 0, (1 << n) - 1, &mut known)?;
    Ok(if inversions % 2 == 1 { Poly::zero().minus(&p) } else { p })
}

/// The determinant of the rows from `row` on, over the columns of a mask.
fn expanded(
    ring: &mut Ring,
    rows: &[Vec<&Poly>],
    row: usize,
    mask: u32,
    known: &mut FxHashMap<u32, Poly>,
) -> Result<Poly, Refusal> {
    if row == rows.len() {
        return Ok(Poly::one());
    }
    if let Some(p) = known.get(&mask) {
        return Ok(p.clone());
    }
    let mut sum = Poly::zero();
    let mut is_minus = false;
    for c in (0..rows.len()).filter(|c| mask >> c & 1 == 1) {
        if !rows[row][c].is_zero() {
            let rest = expanded(ring, rows, row + 1, mask & !(1 << c), known)?;
            let part = ring.times(rows[row][c], &rest)?;
            sum = if is_minus { sum.minus(&part) } else { sum.plus(&part) };
        }
        is_minus = !is_minus;
    }
    known.insert(mask, sum.clone());
    Ok(sum)
}
