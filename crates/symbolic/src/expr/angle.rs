//! Angles as linear forms: Σ kᵢ·xᵢ + r·π + t, with rational kᵢ, r, t.
//!
//! Sines and cosines are taken of these, so that θ2+θ3 is an angle of its own and equal angles look equal.

use super::{Expr, Node, natural_order};
use crate::rational::Rational;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A linear form in angles. Terms are sorted, without zero coefficients; `turns` counts multiples of π.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub struct Angle {
    /// Each angle (a symbol, or an expression that is not linear) and how often it counts.
    pub terms: Vec<(Expr, Rational)>,
    /// The multiple of π.
    pub turns: Rational,
    /// A constant in radians.
    pub radians: Rational,
}

impl Angle {
    /// The linear form of an expression; what is not linear becomes a term of its own.
    pub fn of(e: Expr) -> Self {
        let mut angle = Angle::default();
        if e.as_symbol().is_some() {
            angle.terms.push((e, Rational::ONE));
            return angle;
        }
        // A node is newer than its parts: each is met once, with all that it counts, however often it is shared.
        let mut pending = BTreeMap::from([(e, Rational::ONE)]);
        while let Some((e, k)) = pending.pop_last() {
            let mut add = |part: Expr, k: Rational| {
                let sum = pending.entry(part).or_insert(Rational::ZERO);
                *sum = &*sum + &k;
            };
            match e.node() {
                Node::Number(r) => angle.radians = &angle.radians + &(&r * &k),
                Node::Pi => angle.turns = &angle.turns + &k,
                Node::Neg(a) => add(a, -k),
                Node::Add(a, b) => {
                    add(a, k.clone());
                    add(b, k);
                }
                Node::Sub(a, b) => {
                    add(a, k.clone());
                    add(b, -k);
                }
                Node::Mul(a, b) => match a.as_number() {
                    Some(r) => add(b, &r * &k),
                    None => angle.terms.push((e, k)),
                },
                Node::Symbol(_)
                | Node::Div(..)
                | Node::Pow(..)
                | Node::Sqrt(_)
                | Node::Sin(_)
                | Node::Cos(_)
                | Node::Atan2(..)
                | Node::Sign(_) => angle.terms.push((e, k)),
            }
        }
        angle.terms.sort_by(|a, b| term_order(a.0, b.0));
        angle.terms.retain(|t| !t.1.is_zero());
        angle
    }

    /// The expression: terms in order, a positive one first, constants last.
    pub fn to_expr(&self) -> Expr {
        let first = self.terms.iter().position(|t| !t.1.is_negative()).unwrap_or(0);
        let terms = self.terms.iter().cycle().skip(first).take(self.terms.len());
        let sum = terms.fold(Expr::int(0), |s, (x, k)| s + Expr::with_number(k, *x));
        sum + Expr::with_number(&self.turns, Expr::pi()) + self.radians.clone().into()
    }

    /// Sine and cosine, with quarter turns and a leading sign taken out of the argument.
    pub(crate) fn sin_cos(mut self) -> (Expr, Expr) {
        let mut negative = self.leads_negative();
        if negative {
            self = self.scaled(&-Rational::ONE);
        }
        // turns = quarters/2 + rest, with the rest in [0, 1/2)
        let two = Rational::from(2);
        let quarters = (&self.turns * &two).floor();
        self.turns = &self.turns - &(&quarters / &two);
        let four = Rational::from(4);
        let mut turn = (&quarters - &(&(&quarters / &four).floor() * &four)).to_integer().unwrap_or(0);
        if self.is_constant() && self.leads_negative() {
            // Only radians are left, below 0: x + n·π/2 is −(−x − n·π/2).
            self = self.scaled(&-Rational::ONE);
            turn = (4 - turn) % 4;
            negative = !negative;
        }
        let (mut s, mut c) = match self.exact_sin_cos() {
            Some(exact) => exact,
            // Of two constants that add up to a right angle only the smaller one is used: cos 73° is sin 17°.
            None if self.is_constant() && self.radians.is_zero() && self.turns > Rational::new(1, 4) => {
                let rest = &Rational::new(1, 2) - &self.turns;
                let (s, c) = Angle { turns: rest, ..Angle::default() }.sin_cos();
                (c, s)
            }
            None => {
                let argument = self.to_expr();
                (Expr::trig_node(Node::Sin(argument)), Expr::trig_node(Node::Cos(argument)))
            }
        };
        for _ in 0..turn {
            (s, c) = (c, -s); // sin(x + π/2) = cos x, cos(x + π/2) = −sin x
        }
        (if negative { -s } else { s }, c)
    }

    /// Sine and cosine in radicals, for multiples of π/12 and π/10 in [0, π/2).
    fn exact_sin_cos(&self) -> Option<(Expr, Expr)> {
        if !self.is_constant() || !self.radians.is_zero() {
            return None;
        }
        let root = |n| Expr::int(n).sqrt();
        let over = |e: Expr, n| e / Expr::int(n);
        let (n, d) = self.turns.to_parts()?;
        Some(match (n, d) {
            (0, _) => (Expr::int(0), Expr::int(1)),
            (1, 12) => (over(root(6) - root(2), 4), over(root(6) + root(2), 4)),
            (1, 6) => (Rational::new(1, 2).into(), over(root(3), 2)),
            (1, 4) => (over(root(2), 2), over(root(2), 2)),
            (1, 3) => (over(root(3), 2), Rational::new(1, 2).into()),
            (5, 12) => (over(root(6) + root(2), 4), over(root(6) - root(2), 4)),
            (1, 10) | (1, 5) | (3, 10) | (2, 5) => {
                // σ = sin 36°; cos 36° = (1+√5)/4; sin 72° = 2σ cos 36°, so that σ is the only new root.
                let sigma = over((Expr::int(10) - Expr::int(2) * root(5)).sqrt(), 4);
                let (c36, s18) = (over(root(5) + Expr::int(1), 4), over(root(5) - Expr::int(1), 4));
                let s72 = Expr::int(2) * sigma * c36;
                match (n, d) {
                    (1, 10) => (s18, s72),
                    (1, 5) => (sigma, c36),
                    (3, 10) => (c36, sigma),
                    _ => (s72, s18),
                }
            }
            _ => return None,
        })
    }

    fn leads_negative(&self) -> bool {
        match self.terms.first() {
            Some((_, k)) => k.is_negative(),
            None if self.turns.is_zero() => self.radians.is_negative(),
            None => self.turns.is_negative(),
        }
    }

    /// The multiple `k` of the angle.
    pub fn scaled(&self, k: &Rational) -> Self {
        if k.is_zero() {
            return Angle::default();
        }
        Angle {
            terms: self.terms.iter().map(|(x, c)| (*x, c * k)).collect(),
            turns: &self.turns * k,
            radians: &self.radians * k,
        }
    }

    /// The sum of two angles.
    pub fn plus(&self, o: &Angle) -> Self {
        Angle::of(self.to_expr() + o.to_expr())
    }

    /// True if no symbol occurs.
    pub fn is_constant(&self) -> bool {
        self.terms.is_empty()
    }
}

/// Symbols by name, everything else behind them by age.
fn term_order(a: Expr, b: Expr) -> Ordering {
    match (a.as_symbol(), b.as_symbol()) {
        (Some(x), Some(y)) => natural_order(&x.name(), &y.name()),
        (Some(_), None) => Ordering::Less,
        (None, Some(_)) => Ordering::Greater,
        (None, None) => a.cmp(&b),
    }
}
