//! Where a factor is 0, solved for one angle, where that is exact and simple.

use crate::expr::{Angle, Expr, natural_order};
use crate::poly::{Atom, Monomial, Poly};
use crate::rational::Rational;
use crate::readable::{show, simplify};
use crate::ring::Ring;

/// All zeros of a factor in one angle, the other quantities given.
#[derive(Clone, Debug, PartialEq)]
pub enum Zero {
    /// `sin φ = 0`: φ is 0 or π.
    Sine {
        /// φ
        angle: Expr,
    },
    /// `cos φ = 0`: φ is π/2 or −π/2.
    Cosine {
        /// φ
        angle: Expr,
    },
    /// `1 ± cos φ = 0` or `1 ± sin φ = 0`, a double zero at a single place of the circle.
    Touching {
        /// φ
        angle: Expr,
        /// Its value there, in (−π, π].
        at: Expr,
    },
    /// `A·cos φ + B·sin φ = 0`: φ is `atan2(−A, B)`, or half a turn from there. Where A and B are both 0,
    /// every φ is a zero.
    Ratio {
        /// φ
        angle: Expr,
        /// A, free of φ.
        cosine: Expr,
        /// B, free of φ.
        sine: Expr,
    },
}

/// More copies of a zero are not listed.
const MOST_COPIES: i64 = 4;

impl Zero {
    /// The angle that the zeros are solved for.
    pub fn angle(&self) -> Expr {
        match *self {
            Zero::Sine { angle }
            | Zero::Cosine { angle }
            | Zero::Touching { angle, .. }
            | Zero::Ratio { angle, .. } => angle,
        }
    }

    /// The zeros in one turn.
    pub fn values(&self) -> Vec<Expr> {
        let quarter = Expr::pi() / Expr::int(2);
        match *self {
            Zero::Sine { .. } => vec![Expr::int(0), Expr::pi()],
            Zero::Cosine { .. } => vec![quarter, -quarter],
            Zero::Touching { at, .. } => vec![at],
            Zero::Ratio { cosine, sine, .. } => {
                let first = short(-cosine).atan2(sine);
                vec![first, first + Expr::pi()]
            }
        }
    }

    /// The same, where the angle is a multiple of one symbol and a constant, for that symbol: all values within its period, in
    /// whole turns as far as they go. Of sin(q/2) = 0 that are 0 and 2π, of sin(2q) = 0 four values.
    pub fn solved(&self) -> (Expr, Vec<Expr>) {
        let own = (self.angle(), self.values());
        let sum = Angle::of(own.0);
        let [(x, k)] = &sum.terms[..] else { return own };
        let Some((times, parts)) = k.abs().to_parts() else { return own };
        if x.as_symbol().is_none() || times > MOST_COPIES || x == &own.0 {
            return own;
        }
        let constant = Angle { terms: vec![], ..sum.clone() };
        let by = k.recip().unwrap_or(Rational::ONE);
        let turns = |n: i64| Angle { turns: Rational::from(2 * n), ..Angle::default() };
        let value = |copy: i64, v: Expr| {
            let q = Angle::of(v).plus(&constant.scaled(&-Rational::ONE)).plus(&turns(copy)).scaled(&by);
            let Ok(number) = q.to_expr().eval(|_| None) else { return q.to_expr() };
            // All copies are within so many turns: to (−half, half] of them.
            let wide = std::f64::consts::TAU * parts as f64;
            let times = (number / wide - 0.5 - 1e-12).ceil() as i64;
            q.plus(&turns(-times * parts)).to_expr()
        };
        let values = (0..times).flat_map(|copy| own.1.iter().map(move |v| value(copy, *v))).collect();
        (*x, values)
    }

    /// True if what the zeros are made of is free of other angles.
    fn is_free(&self) -> bool {
        match self {
            Zero::Ratio { cosine, sine, .. } => angles(&[*cosine, *sine]).is_empty(),
            _ => true,
        }
    }
}

/// The zeros of a factor, solved for each angle in turn for which that is simple: a whole angle sum if nothing else
/// varies, then single angles, those first whose values depend on no other angle.
///
/// ```
/// use denavit_symbolic::{Expr, factor::{Zero, zeros}};
/// let q3 = Expr::symbol("q3");
/// let (d4, a3) = (Expr::symbol("d4"), Expr::symbol("a3"));
/// let found = zeros(d4 * q3.cos() + a3 * q3.sin());
/// assert_eq!(found, [Zero::Ratio { angle: q3, cosine: d4, sine: a3 }]);
/// assert_eq!(found[0].values()[0], (-d4).atan2(a3));
/// ```
pub fn zeros(factor: Expr) -> Vec<Zero> {
    let sums = angles(&[factor]);
    let mut singles: Vec<Expr> =
        sums.iter().flat_map(|a| a.terms.iter().map(|t| t.0)).filter(|x| x.as_symbol().is_some()).collect();
    let name = |x: &Expr| x.as_symbol().map(|s| s.name());
    singles.sort_by(|a, b| natural_order(&name(a).unwrap_or_default(), &name(b).unwrap_or_default()));
    singles.dedup();
    if let [sum] = &sums[..]
        && let Some(zero) = zero_in(factor, sum.to_expr())
    {
        return vec![zero];
    }
    let mut found: Vec<Zero> = singles.into_iter().filter_map(|angle| zero_in(factor, angle)).collect();
    found.sort_by_key(|zero| !zero.is_free());
    found
}

/// The zeros of a factor solved for `angle`, a symbol or a sum of symbols, if the factor is one of the forms of
/// [`Zero`] in it.
pub fn zero_in(factor: Expr, angle: Expr) -> Option<Zero> {
    let own = Angle::of(angle);
    let varies = |e: &Expr| own.terms.iter().any(|t| t.0 == *e);
    let mut ring = Ring::with_basis(&basis_around(&own, factor), &[factor], &[]);
    if ring.basis().first() != Some(&own) {
        return None;
    }
    let p = ring.polynomial(factor).ok()?;
    let (cos, sin) = ring.pairs().next()?;
    let [rest, a, b] = parts(&p, cos, sin)?;
    let negative = b.terms().iter().filter(|t| t.1.is_negative()).count();
    let sign = if 2 * negative > b.terms().len() { -Rational::ONE } else { Rational::ONE };
    let [rest, a, b] = [rest, a, b].map(|part| part.scaled(&sign));
    // What multiplies the angle must not hold it under another name.
    let [held, cosine, sine] = [&rest, &a, &b].map(|part| show(&ring, part));
    if Expr::postorder(&[held, cosine, sine]).iter().any(varies) {
        return None;
    }
    let number = |p: &Poly| p.as_constant();
    match (rest.is_zero(), number(&a), number(&b)) {
        (true, Some(a), Some(b)) if a.is_zero() && !b.is_zero() => Some(Zero::Sine { angle }),
        (true, Some(a), Some(b)) if b.is_zero() && !a.is_zero() => Some(Zero::Cosine { angle }),
        (true, ..) if !a.is_zero() && !b.is_zero() => {
            Some(Zero::Ratio { angle, cosine: short(cosine), sine: short(sine) })
        }
        (false, Some(a), Some(b)) => touching(&number(&rest)?, &a, &b).map(|at| Zero::Touching { angle, at }),
        _ => None,
    }
}

/// The angle, then the other angles of a formula one by one.
fn basis_around(own: &Angle, formula: Expr) -> Vec<Angle> {
    let mut basis = vec![own.clone()];
    for (x, _) in angles(&[formula]).iter().flat_map(|sum| &sum.terms) {
        let single = Angle::of(*x);
        if !own.terms.iter().any(|t| t.0 == *x) && !basis.contains(&single) {
            basis.push(single);
        }
    }
    basis
}

/// The readable form.
fn short(e: Expr) -> Expr {
    simplify(e, &[]).map_or(e, |form| form.expr)
}

/// The zero of `r + a·cos φ + b·sin φ` where |r| is the amplitude of one of the two and the other is missing.
fn touching(r: &Rational, a: &Rational, b: &Rational) -> Option<Expr> {
    let (amplitude, first) = match (a.is_zero(), b.is_zero()) {
        (false, true) => (a, Rational::ZERO),
        (true, false) => (b, Rational::new(1, 2)),
        _ => return None,
    };
    let turns = match (r.abs() == amplitude.abs(), *r == *amplitude) {
        (false, _) => return None,
        (true, false) => first,
        (true, true) if first.is_zero() => Rational::ONE,
        (true, true) => -first,
    };
    Some(Expr::from(turns) * Expr::pi())
}

/// `p = R + A·C + B·S`, if it is of this form.
fn parts(p: &Poly, cos: Atom, sin: Atom) -> Option<[Poly; 3]> {
    let mut parts: [Vec<(Monomial, Rational)>; 3] = Default::default();
    for (m, r) in p.terms() {
        let at = match (m.exponent(cos), m.exponent(sin)) {
            (0, 0) => 0,
            (1, 0) => 1,
            (0, 1) => 2,
            _ => return None,
        };
        parts[at].push((m.without(cos).without(sin), r.clone()));
    }
    Some(parts.map(Poly::from_terms))
}

/// The angles whose sines and cosines occur, each once.
fn angles(formulas: &[Expr]) -> Vec<Angle> {
    use crate::expr::Node;
    let mut found: Vec<Angle> = vec![];
    for e in Expr::postorder(formulas) {
        if let Node::Sin(a) | Node::Cos(a) = e.node() {
            let angle = Angle::of(a);
            if !angle.is_constant() && !found.contains(&angle) {
                found.push(angle);
            }
        }
    }
    found
}
