//! Polynomials taken apart by the powers of an atom; square roots of polynomials.

use super::algebra::Algebra;
use denavit_symbolic::Rational;
use denavit_symbolic::poly::{Atom, Monomial, Poly};

/// The atom that became known last, of those the first.
pub fn outermost(p: &Poly, rank: impl Fn(Atom) -> usize) -> Option<Atom> {
    let atoms = p.terms().iter().flat_map(|t| t.0.factors().iter().map(|f| f.0));
    atoms.max_by_key(|&a| (rank(a), std::cmp::Reverse(a)))
}

/// p = atom·inside + rest.
pub fn split(p: &Poly, atom: Atom) -> (Poly, Poly) {
    p.split(atom)
}

/// The polynomial whose square this is, if there is one.
pub(super) fn square_root(a: &Algebra, p: &Poly) -> Option<Poly> {
    let leading = |p: &Poly| p.terms().iter().max_by(|x, y| lexical(&x.0, &y.0)).cloned();
    if p.is_zero() {
        return Some(Poly::zero());
    }
    let (m, r) = leading(p)?;
    if m.factors().iter().any(|f| f.1 % 2 == 1) {
        return None;
    }
    let half = m.factors().iter().fold(Monomial::one(), |h, f| h.times(&Monomial::power(f.0, f.1 / 2)));
    let first = (half, r.sqrt()?);
    let mut root = Poly::term(first.0.clone(), first.1.clone());
    for _ in 0..40 {
        let rest = p.minus(&a.square(&root));
        let Some((m, r)) = leading(&rest) else { return Some(root) };
        if first.0.factors().iter().any(|f| m.exponent(f.0) < f.1) {
            return None;
        }
        let next = Poly::term(m.over(&first.0), &r / &(&first.1 * &Rational::from(2)));
        root = root.plus(&next);
    }
    None
}

/// Lexical order: the larger power of the first atom in which they differ.
fn lexical(x: &Monomial, y: &Monomial) -> std::cmp::Ordering {
    let mut atoms: Vec<Atom> = x.factors().iter().chain(y.factors()).map(|f| f.0).collect();
    atoms.sort_unstable();
    atoms
        .iter()
        .map(|&a| x.exponent(a).cmp(&y.exponent(a)))
        .find(|o| o.is_ne())
        .unwrap_or(std::cmp::Ordering::Equal)
}
