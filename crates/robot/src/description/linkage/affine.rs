//! Parallelograms and kites: dyads of which a solution is affine in what is known.
//!
//! Where A·e₁ + B·e₂ = P has a solution whose directions are those of summands of P, the discriminant is a square, and the other
//! solution, its mirror image at P, is rational in sines and cosines as well. A candidate is taken where it is proved.

use super::order::Vectors;
use super::plane::Term;
use denavit_symbolic::{Angle, Expr, Rational, equal};

/// The angle of x + iy, up to half a turn.
fn argument(t: &Term) -> Expr {
    match (t.x.is_zero(), t.y.is_zero()) {
        (_, true) => Expr::int(0),
        (true, _) => Expr::pi() * Expr::from(Rational::new(1, 2)),
        _ => t.y.atan2(t.x),
    }
}

/// The solutions of A·e₁ + B·e₂ = P in which e₁ and e₂ have the directions of summands of P: the one in which both move before
/// others, as in a parallelogram.
pub(super) fn affine(a: &Vectors, b: &Vectors, p: &Vectors) -> Vec<[Angle; 2]> {
    let candidates = |of: &Vectors| {
        let [own] = &of.0[..] else { return vec![] };
        let half = [Expr::int(0), Expr::pi()];
        let angle = |t: &Term, half: Expr| {
            let angle = t.angle.to_expr() + argument(t) - own.angle.to_expr() - argument(own) + half;
            within_turn(&Angle::of(angle))
        };
        let mut all: Vec<Angle> = vec![];
        for candidate in p.0.iter().flat_map(|t| half.map(|h| angle(t, h))) {
            if !all.contains(&candidate) {
                all.push(candidate);
            }
        }
        all
    };
    let (first, second) = (candidates(a), candidates(b));
    let zero = Expr::int(0);
    let mut found: Vec<[Angle; 2]> = vec![];
    for one in &first {
        for two in &second {
            let turned = |v: &Vectors, by: &Angle| {
                let turn = |t: &Term| Term { angle: t.angle.plus(by), ..t.clone() };
                Vectors(v.0.iter().map(turn).collect()).formula()
            };
            let rest = turned(a, one) + turned(b, two) - p.formula();
            let closes = [rest.re, rest.im].iter().all(|&e| equal(e, zero).is_equal());
            if closes && found.len() < 2 {
                found.push([one.clone(), two.clone()]);
            }
        }
    }
    // Of a rhombus the parallelogram, in which the first rod keeps its direction, before the one that is folded.
    found.sort_by_key(|s| (s.iter().filter(|a| a.is_constant()).count(), !s[0].is_constant()));
    found
}

/// The angle with whole turns taken away.
pub(super) fn within_turn(angle: &Angle) -> Angle {
    // In (−1, 1] half turns.
    let two = Rational::from(2);
    let half = Rational::new(1, 2);
    let whole = -(&(&half - &(&angle.turns * &half)).floor());
    Angle { turns: &angle.turns - &(&whole * &two), ..angle.clone() }
}
