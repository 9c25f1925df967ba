//! Whether a printed formula is true: the entries of the pose are replaced by the product of the chain's matrices, and
//! what is left must vanish identically.

use super::reading::Reading;
use crate::document::Proof;
use denavit::random::Random;
use denavit_symbolic::{Equality, Expr, Symbol, equal};
use rustc_hash::FxHashMap;

/// The forward model, to be put in for the entries of the pose.
pub struct Prover {
    forward: FxHashMap<Symbol, Expr>,
    names: Vec<(Symbol, Expr)>,
}

/// Configurations at which a formula is checked that is too large to decide.
const SAMPLES: usize = 16;

impl Prover {
    /// With the meanings of names.
    pub fn new(reading: &Reading, names: &[(Expr, Expr)]) -> Self {
        let chain = reading.chain;
        let mut forward = FxHashMap::default();
        if let Some((r, p)) = chain.products_from(0).last() {
            for k in 0..12 {
                let (i, j) = (k / 4, k % 4);
                let entry = if j == 3 { &p[i] } else { &r[i][j] };
                forward.insert(chain.pose[k], reading.plain(entry));
            }
        }
        let names = names.iter().filter_map(|(n, e)| Some((n.as_symbol()?, *e))).collect();
        Prover { forward, names }
    }

    /// A formula in the joint variables and parameters alone.
    pub fn in_joints(&self, e: Expr) -> Expr {
        let named = |s: Symbol| self.names.iter().rev().find(|n| n.0 == s).map(|n| n.1);
        let mut e = e;
        while e.symbols().into_iter().any(|s| named(s).is_some()) {
            e = e.substitute(named);
        }
        e.substitute(|s| self.forward.get(&s).copied())
    }

    /// Whether left = right at every configuration.
    pub fn equation(&self, left: Expr, right: Expr) -> Proof {
        let (left, right) = (self.in_joints(left), self.in_joints(right));
        identity(left, right)
    }
}

/// Whether two formulas are equal as functions of their symbols.
pub fn identity(left: Expr, right: Expr) -> Proof {
    match equal(left, right) {
        Equality::Equal { .. } => Proof::Proved,
        Equality::Different { .. } => Proof::Wrong,
        Equality::Undecided(_) => sampled(left - right),
    }
}

fn sampled(zero: Expr) -> Proof {
    let symbols = zero.symbols();
    let mut random = Random(0x5EED);
    for _ in 0..SAMPLES {
        let values: Vec<f64> = symbols.iter().map(|_| 0.2 + 2.0 * random.unit()).collect();
        let of = |s: Symbol| symbols.iter().position(|&t| t == s).map(|k| values[k]);
        if !zero.eval(of).is_ok_and(|x| x.abs() <= 1e-8) {
            return Proof::Wrong;
        }
    }
    Proof::Sampled
}
