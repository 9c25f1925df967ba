//! Equality of formulas, decided exactly.

use crate::ball;
use crate::expr::{Expr, Symbol};
use crate::poly::Poly;
use crate::ring::{Refusal, Ring};

/// The answer to "are these two formulas equal?".
#[derive(Clone, PartialEq, Debug)]
pub enum Equality {
    /// Proved equal wherever none of the recorded denominators vanishes.
    Equal {
        /// Expressions that must not be 0.
        conditions: Vec<Expr>,
    },
    /// Proved different.
    Different {
        /// A point at which the values differ by more than all rounding, if one was found.
        witness: Option<Vec<(Symbol, f64)>>,
    },
    /// Neither proved nor refuted.
    Undecided(Reason),
}

/// Why equality was not decided.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reason {
    /// No normal form was reached.
    Refused(Refusal),
    /// The normal forms differ, but their atoms (roots, constant angles) may be related in ways the ring does not
    /// know, and no point was found that separates the values.
    Dependent,
}

impl Equality {
    /// True if proved equal.
    pub fn is_equal(&self) -> bool {
        matches!(self, Equality::Equal { .. })
    }
}

/// Decides whether two formulas are equal as functions of their symbols.
pub fn equal(a: Expr, b: Expr) -> Equality {
    let difference = a - b;
    // A point that separates the values is found much sooner than two normal forms.
    if let Some(verdict) = refute(difference) {
        return verdict;
    }
    let mut ring = Ring::new(&[a, b, difference], &[]);
    let form = match ring.normal(difference) {
        Ok(form) => form,
        Err(why) => return Equality::Undecided(Reason::Refused(why)),
    };
    if form.num.is_zero() {
        let mut factors: Vec<Poly> = vec![];
        for side in [a, b] {
            if let Ok(f) = ring.normal(side) {
                factors.extend(f.den.iter().map(|d| d.0.clone()));
            }
        }
        factors.sort();
        factors.dedup();
        return Equality::Equal { conditions: factors.iter().map(|p| ring.poly_expr(p)).collect() };
    }
    match ring.is_independent(&form.num) && form.den.iter().all(|d| ring.is_independent(&d.0)) {
        true => Equality::Different { witness: None },
        false => Equality::Undecided(Reason::Dependent),
    }
}

/// Looks for a point at which a formula is certainly not 0.
fn refute(e: Expr) -> Option<Equality> {
    let symbols = e.symbols();
    let mut state = 0x9e37_79b9_7f4a_7c15_u64; // fixed seed: the same question has the same answer
    for _ in 0..8 {
        let point: Vec<(Symbol, f64)> = symbols
            .iter()
            .map(|&s| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (s, (state >> 43) as f64 / f64::from(1 << 20) + 0.25) // a multiple of 2⁻²⁰ in [0.25, 2.25)
            })
            .collect();
        let value = ball::evaluate(e, |s| point.iter().find(|p| p.0 == s).map(|p| p.1));
        if value.excludes_zero() {
            return Some(Equality::Different { witness: Some(point) });
        }
    }
    None
}
