//! Polynomials of a derivation as formulas that a person would write.

use crate::inverse::algebra::Kind;
use crate::inverse::chain::Chain;
use crate::inverse::compile::{outermost, split};
use crate::inverse::known::{Known, Unknown, axis_unknown};
use crate::inverse::plan::{Norm, Step};
use denavit_symbolic::poly::{Atom, Poly};
use denavit_symbolic::{Expr, Rational};

/// When each atom becomes known.
pub struct Reading<'a> {
    pub chain: &'a Chain,
    /// For each atom: 0 for constants, 1 for the pose, 2 for what is given, 3 + i for step i, more for what is unknown.
    pub ranks: Vec<usize>,
}

impl<'a> Reading<'a> {
    /// The ranks after some steps.
    pub fn new(chain: &'a Chain, given: &[usize], steps: &[Step]) -> Self {
        let axes: Vec<usize> = (0..chain.axes.len())
            .filter(|&k| chain.axes[k].form.terms.iter().all(|t| given.contains(&t.0)))
            .collect();
        let mut known = Known::new(chain, &axes);
        let mut ranks = vec![usize::MAX; chain.algebra.len()];
        for i in 0..=steps.len() {
            for (a, rank) in ranks.iter_mut().enumerate().filter(|r| *r.1 == usize::MAX) {
                *rank = match chain.algebra.kind(a as Atom) {
                    Kind::Constant(_) => 0,
                    Kind::Pose(_) => 1,
                    Kind::Cos(n) | Kind::Sin(n) if known.knows(Unknown::Angle(chain.differences[n])) => 2 + i,
                    Kind::Slide(k) if known.knows(axis_unknown(chain, k)) => 2 + i,
                    _ => continue,
                };
            }
            if let Some(step) = steps.get(i) {
                known.learn(step.unknown);
            }
        }
        Reading { chain, ranks }
    }

    /// When an atom is known.
    pub fn rank(&self, a: Atom) -> usize {
        self.ranks[usize::from(a)]
    }

    /// When all of a polynomial is known.
    pub fn rank_of(&self, p: &Poly) -> usize {
        p.atoms().into_iter().map(|a| self.rank(a)).max().unwrap_or(0)
    }

    /// The polynomial, the atom that becomes known last taken out first; `short` may have a name for a part.
    pub fn expr(&self, p: &Poly, short: &dyn Fn(&Poly) -> Option<Expr>) -> Expr {
        if let Some(r) = p.as_constant() {
            return r.into();
        }
        if let Some(name) = short(p) {
            return name;
        }
        let Some(atom) = outermost(p, |a| self.rank(a)) else { return Expr::int(0) };
        let (inside, rest) = split(p, atom);
        let atom = self.chain.algebra.expr(atom);
        let inside = self.expr(&inside, short);
        let product = match inside.as_number() {
            Some(_) => inside * atom,
            None => atom * inside,
        };
        if rest.is_zero() { product } else { product + self.expr(&rest, short) }
    }

    /// The same without names.
    pub fn plain(&self, p: &Poly) -> Expr {
        self.expr(p, &|_| None)
    }

    /// A sum with its squares left as they are.
    pub fn norm(&self, n: &Norm, short: &dyn Fn(&Poly) -> Option<Expr>) -> Expr {
        let square = |sum: Expr, p: &Poly| sum + self.expr(p, short).powi(2);
        let squares = n.squares.iter().fold(Expr::int(0), square);
        if n.plus.is_zero() { squares } else { squares + self.expr(&n.plus, short) }
    }
}

/// −p.
pub fn negated(p: &Poly) -> Poly {
    p.scaled(&-Rational::ONE)
}
