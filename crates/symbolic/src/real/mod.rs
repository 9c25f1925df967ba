//! Real constants to compute a geometry with: exact in Q(√2, √3), in which the sines of all multiples of π/12 lie, and with
//! 256 binary places outside of it.
//!
//! What is exact is decided exactly. Of other numbers those below 2⁻²⁰⁰ (6e-61) count as 0.

mod fixed;
mod surd;

use crate::expr::{Expr, Node};
use crate::rational::Rational;
use fixed::Fixed;
use rustc_hash::FxHashMap;
use std::ops::{Add, Mul, Neg, Sub};
use surd::Surd;

/// A real constant.
///
/// ```
/// use denavit_symbolic::real::Real;
/// let half_turn_over_12 = Real::from(2).sqrt().unwrap(); // √2
/// assert!((half_turn_over_12.clone() * half_turn_over_12 - Real::from(2)).is_zero());
/// ```
#[derive(Clone, Debug)]
pub struct Real(Repr);

#[derive(Clone, Debug)]
enum Repr {
    Exact(Surd),
    Fixed(Fixed),
}

use Repr::{Exact, Fixed as Rounded};

impl Real {
    fn exact(x: Surd) -> Self {
        if x.is_short() { Real(Exact(x)) } else { Real(Rounded(round(&x))) }
    }

    fn rounded(x: Fixed) -> Self {
        Real(Rounded(x))
    }

    fn fixed(&self) -> Fixed {
        match &self.0 {
            Exact(x) => round(x),
            Rounded(x) => x.clone(),
        }
    }

    /// True if nothing of it is rounded.
    pub fn is_exact(&self) -> bool {
        matches!(self.0, Exact(_))
    }

    /// True for 0; a rounded number is 0 below 2⁻²⁰⁰.
    pub fn is_zero(&self) -> bool {
        match &self.0 {
            Exact(x) => x.is_zero(),
            Rounded(x) => x.is_zero(),
        }
    }

    /// True below 0.
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Exact(x) => x.as_rational().map_or_else(|| round(x).is_negative(), Rational::is_negative),
            Rounded(x) => !x.is_zero() && x.is_negative(),
        }
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.is_negative() { -self.clone() } else { self.clone() }
    }

    /// `1/self`, or nothing for 0.
    pub fn recip(&self) -> Option<Self> {
        match &self.0 {
            Exact(x) => x.inverse().map(Real::exact),
            Rounded(x) => Fixed::of(&Rational::ONE).over(x).map(Real::rounded),
        }
    }

    /// The square root, or nothing below 0.
    pub fn sqrt(&self) -> Option<Self> {
        if self.is_negative() {
            return None;
        }
        if let Exact(x) = &self.0
            && let Some(root) = x.sqrt()
        {
            return Some(Real::exact(root).abs());
        }
        self.fixed().sqrt().map(Real::rounded)
    }

    /// The angle of the point (x, y) in (−π, π], radians, rounded.
    pub fn atan2(&self, x: &Real) -> Self {
        Real::rounded(self.fixed().atan2(&x.fixed()))
    }

    /// The rational number, if it is known to be one.
    pub fn as_rational(&self) -> Option<&Rational> {
        match &self.0 {
            Exact(x) => x.as_rational(),
            Rounded(_) => None,
        }
    }

    /// The nearest double.
    pub fn to_f64(&self) -> f64 {
        match self.as_rational() {
            Some(x) => x.to_f64(),
            None => self.fixed().to_rational().to_f64(),
        }
    }

    /// The nearest decimal with so many places.
    pub fn to_decimal(&self, places: u32) -> Rational {
        let x = self.as_rational().cloned().unwrap_or_else(|| self.fixed().to_rational());
        let scale = (0..places).fold(Rational::ONE, |s, _| s * Rational::from(10));
        (x * scale.clone() + Rational::new(1, 2)).floor() / scale
    }

    /// As a formula, if it is exact: a sum of roots.
    pub fn to_expr(&self) -> Option<Expr> {
        let Exact(Surd(x)) = &self.0 else { return None };
        let parts = x.iter().zip([1, 2, 3, 6]).filter(|p| !p.0.is_zero());
        let sum = parts.map(|(k, n)| Expr::from(k.clone()) * Expr::int(n).sqrt());
        Some(sum.reduce(|a, b| a + b).unwrap_or(Expr::int(0)))
    }

    /// As an angle in (−π, π], of which this is the sine: a multiple of a millionth of a degree, or a decimal of radians beside
    /// whole quarter turns, if it is one (up to 2⁻²⁰⁰, where numbers are rounded); else a decimal with 18 places.
    pub fn angle(&self, cos: &Real) -> Expr {
        let pi = Real::rounded(fixed::pi());
        let sine_of = |e: Expr| {
            let (s, c) = e.sin_cos();
            Some((Values::default().of(s)?, Values::default().of(c)?))
        };
        let is_it = |e: Expr| {
            sine_of(e).is_some_and(|(s, c)| (s - self.clone()).is_zero() && (c - cos.clone()).is_zero())
        };
        let turns = |n: i64, d: i64| Expr::from(Rational::new(n, d)) * Expr::pi();
        let x = self.to_f64().atan2(cos.to_f64()) / std::f64::consts::PI;
        for d in [12, 180_000_000] {
            let n = (x * d as f64).round() as i64;
            let angle = if n == -d { Expr::pi() } else { turns(n, d) };
            if (x * d as f64 - n as f64).abs() < 1e-6 && is_it(angle) {
                return angle;
            }
        }
        let angle = self.atan2(cos);
        for quarters in [0, 1, -1, 2, -2] {
            let quarter = pi.clone() * Real::from(Rational::new(quarters, 2));
            let rest = angle.clone() - quarter;
            let decimal = rest.to_decimal(PLACES);
            if (rest - Real::from(decimal.clone())).is_zero() {
                return turns(quarters, 2) + Expr::from(decimal);
            }
        }
        // What the rounding of the numbers before it has left beside a quarter turn is none.
        let near = |q: &i64| {
            let quarter = pi.clone() * Real::from(Rational::new(*q, 2));
            (angle.clone() - quarter).to_decimal(PLACES).abs() <= leftover()
        };
        match [0, 1, -1, 2, -2].into_iter().find(near) {
            Some(-2) => turns(1, 1),
            Some(quarters) => turns(quarters, 2),
            None => angle.to_decimal(PLACES).into(),
        }
    }

    /// As a formula that has this value again: exactly where it is exact, else a multiple of π, of which nothing that is computed is
    /// taken for exact.
    pub fn formula(&self) -> Expr {
        self.to_expr().unwrap_or_else(|| {
            let part = self.fixed().over(&fixed::pi()).map_or(Rational::ZERO, |x| x.to_rational());
            let part = if part.is_zero() { Fixed::smallest().to_rational() } else { part };
            Expr::from(part) * Expr::pi()
        })
    }

    /// As a formula: exactly where it is exact, else a decimal with 18 places; 0 where those hold only what rounding leaves.
    pub fn settled(&self) -> Expr {
        self.to_expr().unwrap_or_else(|| {
            let decimal = self.to_decimal(PLACES);
            if decimal.abs() <= leftover() { Expr::int(0) } else { decimal.into() }
        })
    }
}

/// The decimals that are kept of what is not exact.
const PLACES: u32 = 18;

/// What numbers leave of nothing that are made of some that were rounded to the decimals that are kept, at most.
fn leftover() -> Rational {
    Rational::new(4, 1_000_000_000_000_000_000)
}

fn round(x: &Surd) -> Fixed {
    let parts = x.0.iter().zip([1, 2, 3, 6]).filter(|p| !p.0.is_zero());
    parts.fold(Fixed::of(&Rational::ZERO), |sum, (k, n)| {
        let k = Fixed::of(k);
        let root = Fixed::of(&Rational::from(n)).sqrt().unwrap_or_else(|| Fixed::of(&Rational::ZERO));
        sum.plus(&if n == 1 { k } else { k.times(&root) })
    })
}

impl From<Rational> for Real {
    fn from(x: Rational) -> Self {
        Real::exact(Surd::rational(x))
    }
}

impl From<i64> for Real {
    fn from(n: i64) -> Self {
        Rational::from(n).into()
    }
}

impl Add for Real {
    type Output = Real;
    fn add(self, o: Real) -> Real {
        match (&self.0, &o.0) {
            (Exact(x), Exact(y)) => Real::exact(x.plus(y)),
            _ => Real::rounded(self.fixed().plus(&o.fixed())),
        }
    }
}

impl Sub for Real {
    type Output = Real;
    fn sub(self, o: Real) -> Real {
        self + -o
    }
}

impl Mul for Real {
    type Output = Real;
    fn mul(self, o: Real) -> Real {
        match (&self.0, &o.0) {
            (Exact(x), Exact(y)) => Real::exact(x.times(y)),
            // Nothing times what is rounded is exactly nothing.
            (Exact(x), _) | (_, Exact(x)) if x.is_zero() => Real::from(0),
            _ => Real::rounded(self.fixed().times(&o.fixed())),
        }
    }
}

impl Neg for Real {
    type Output = Real;
    fn neg(self) -> Real {
        match &self.0 {
            Exact(x) => Real(Exact(x.negated())),
            Rounded(x) => Real(Rounded(x.negated())),
        }
    }
}

/// Values of formulas without symbols; what formulas share is computed once.
#[derive(Default, Debug)]
pub struct Values {
    known: FxHashMap<Expr, Option<Real>>,
    /// Sines and cosines of angles.
    turns: FxHashMap<Expr, (Fixed, Fixed)>,
}

impl Values {
    /// The value; nothing where a symbol occurs, or a formula has none.
    pub fn of(&mut self, e: Expr) -> Option<Real> {
        if let Some(known) = self.known.get(&e) {
            return known.clone();
        }
        for part in Expr::postorder_of_new(&[e], |e| self.known.contains_key(&e)) {
            let value = self.value(part);
            self.known.insert(part, value);
        }
        self.known.get(&e).cloned().flatten()
    }

    /// Sine and cosine of an angle that is known.
    fn sin_cos(&mut self, angle: Expr) -> Option<&(Fixed, Fixed)> {
        let value = self.known.get(&angle)?.as_ref()?.fixed();
        Some(self.turns.entry(angle).or_insert_with(|| value.sin_cos()))
    }

    fn value(&mut self, e: Expr) -> Option<Real> {
        match e.node() {
            Node::Sin(a) => return Some(Real::rounded(self.sin_cos(a)?.0.clone())),
            Node::Cos(a) => return Some(Real::rounded(self.sin_cos(a)?.1.clone())),
            _ => {}
        }
        let of = |e: Expr| self.known.get(&e).cloned().flatten();
        Some(match e.node() {
            Node::Number(x) => Real::from(x),
            Node::Pi => Real::rounded(fixed::pi()),
            Node::Symbol(_) => return None,
            Node::Neg(a) => -of(a)?,
            Node::Add(a, b) => of(a)? + of(b)?,
            Node::Sub(a, b) => of(a)? - of(b)?,
            Node::Mul(a, b) => of(a)? * of(b)?,
            Node::Div(a, b) => of(a)? * of(b)?.recip()?,
            Node::Pow(a, n) => {
                let a = of(a)?;
                let power = (0..n.unsigned_abs().min(64)).fold(Real::from(1), |x, _| x * a.clone());
                if n.unsigned_abs() > 64 {
                    return None;
                }
                if n < 0 { power.recip()? } else { power }
            }
            Node::Sqrt(a) => of(a)?.sqrt()?,
            Node::Atan2(a, b) => of(a)?.atan2(&of(b)?),
            // Whether a rounded number is 0 is not known here.
            Node::Sign(_) | Node::Sin(_) | Node::Cos(_) => return None,
        })
    }
}
