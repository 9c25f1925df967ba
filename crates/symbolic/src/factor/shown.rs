//! A factor as it is written, and its place among the others.

use super::laurent::{Harmonic, expression, is_number};
use crate::expr::{Angle, Expr, Symbol};
use crate::poly::{Atom, Poly};
use crate::rational::Rational;
use crate::readable::{literals, shortened, show};
use crate::ring::{AtomKind, Ring};

/// A factor and its place.
#[derive(Clone, Debug)]
pub(super) struct Shown {
    /// The factor.
    pub expr: Expr,
    /// What factors are sorted by.
    pub place: Place,
}

/// Numbers, symbols, sums of symbols, single sines and cosines, other sums; inside these shorter ones first.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Place {
    kind: Kind,
    size: usize,
    rank: Vec<Atom>,
    text: String,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Kind {
    Number,
    Symbol,
    Symbols,
    Wave,
    Waves,
}

impl Shown {
    /// An atom of the ring.
    pub fn atom(ring: &Ring, atom: Atom) -> Self {
        let expr = ring.atom_expr(atom);
        let (kind, size, rank) = match ring.kind(atom) {
            _ if is_number(ring, atom) => (Kind::Number, 1, vec![atom]),
            AtomKind::Cos(_) | AtomKind::Sin(_) => {
                return Shown::wave(ring, expr, ring.angle_of(atom));
            }
            _ => (Kind::Symbol, 1, vec![atom]),
        };
        Shown { expr, place: Place { kind, size, rank, text: String::new() } }
    }

    /// A single sine or cosine: by the number of angles added up, then by their symbols.
    fn wave(ring: &Ring, expr: Expr, angle: Option<&Angle>) -> Self {
        let terms = angle.map_or(&[][..], |a| &a.terms);
        let rank = terms.iter().filter_map(|t| ring.atom_of(t.0.as_symbol()?)).collect();
        let place = Place { kind: Kind::Wave, size: terms.len(), rank, text: expr.to_string() };
        Shown { expr, place }
    }

    /// A polynomial of the ring as it is.
    pub fn sum(ring: &Ring, p: &Poly) -> Self {
        let expr = legible(ring, p);
        let size = p.terms().len();
        Shown { expr, place: Place { kind: Kind::Waves, size, rank: p.atoms(), text: expr.to_string() } }
    }

    /// A sum of sines and cosines, over the angle sums in which it is shortest; `None` if it has no such form.
    pub fn harmonics(ring: &Ring, sum: &[Harmonic], symbols: &[Symbol]) -> Option<Self> {
        if let [only] = sum
            && only.symbols.is_empty()
            && only.cosine.is_zero() != only.sine.is_zero()
        {
            let angle = only.angle.to_expr();
            let expr = if only.sine.is_zero() { angle.cos() } else { angle.sin() };
            return Some(Shown::wave(ring, expr.split_number().1, Some(&only.angle)));
        }
        let formula = expression(ring, sum);
        let own = Ring::new(&[formula], symbols);
        let has_angles = !own.basis().is_empty();
        let (expr, size) = shortest(own, formula, sum, symbols, ring.basis())?;
        let kind = if has_angles { Kind::Waves } else { Kind::Symbols };
        let named = sum.iter().flat_map(|h| h.symbols.iter().map(|s| s.0)).filter(|&a| !is_number(ring, a));
        let rank = named.min().into_iter().collect();
        Some(Shown { expr, place: Place { kind, size, rank, text: expr.to_string() } })
    }
}

/// The form with the fewest literals over three bases of angles: those that occur, the symbols alone, and `given`.
fn shortest(
    own: Ring,
    formula: Expr,
    sum: &[Harmonic],
    symbols: &[Symbol],
    given: &[Angle],
) -> Option<(Expr, usize)> {
    let written = |ring: &mut Ring| {
        let p = primitive(&ring.polynomial(formula).ok()?);
        Some((legible(ring, &p), p.terms().len()))
    };
    let mut rings = vec![own];
    if !is_shortest(sum) {
        let mut singles: Vec<Expr> =
            rings[0].basis().iter().flat_map(|a| a.terms.iter().map(|t| t.0)).collect();
        singles.sort_by_key(|x| x.to_string());
        singles.dedup();
        let singles: Vec<Angle> = singles.into_iter().map(Angle::of).collect();
        let bases = [&singles[..], given];
        rings.extend(bases.map(|basis| Ring::with_basis(basis, &[formula], symbols)));
        let terms = |ring: &mut Ring| ring.polynomial(formula).map_or(usize::MAX, |p| p.terms().len());
        let counted = rings.into_iter().map(|mut ring| (terms(&mut ring), ring));
        rings = counted.min_by_key(|c| c.0).map(|c| c.1).into_iter().collect();
        if sum.len() <= MAX_SHORTENED {
            rings = rings.into_iter().filter_map(|ring| shortened(ring, formula, symbols).ok()).collect();
        }
    }
    rings.iter_mut().filter_map(written).min_by_key(|(expr, _)| literals(*expr))
}

/// Terms beyond which no shorter basis is sought, and beyond which a sum is written as it is.
const MAX_SHORTENED: usize = 60;
const MAX_TERMS: usize = 500;

/// The readable form of a polynomial that somebody would read.
fn legible(ring: &Ring, p: &Poly) -> Expr {
    if p.terms().len() > MAX_TERMS { ring.poly_expr(p) } else { show(ring, p) }
}

/// True if every product of symbols has one sine or cosine for its coefficient, of which no basis makes less.
fn is_shortest(sum: &[Harmonic]) -> bool {
    let alone = |h: &Harmonic| sum.iter().filter(|o| o.symbols == h.symbols).count() == 1;
    sum.iter().all(|h| alone(h) && (h.cosine.is_zero() || h.sine.is_zero()))
}

/// The multiple with coprime integers for coefficients, most of them positive.
fn primitive(p: &Poly) -> Poly {
    let up = p.terms().iter().fold(Rational::ONE, |d, (_, r)| {
        let (_, bottom) = (r * &d).digits();
        &d * &Rational::from_decimal(&bottom).unwrap_or(Rational::ONE)
    });
    let scaled = p.scaled(&up);
    let common = scaled.terms().iter().fold(Rational::ZERO, |g, (_, r)| gcd(g, r.abs()));
    let negative = scaled.terms().iter().filter(|t| t.1.is_negative()).count();
    let leads = scaled.terms().first().is_some_and(|t| t.1.is_negative());
    let turned = 2 * negative > scaled.terms().len() || (2 * negative == scaled.terms().len() && leads);
    let down = common.recip().unwrap_or(Rational::ONE);
    scaled.scaled(&if turned { -down } else { down })
}

/// The greatest common divisor of integers.
fn gcd(mut a: Rational, mut b: Rational) -> Rational {
    while !b.is_zero() {
        let rest = &a - &(&(&a / &b).floor() * &b);
        (a, b) = (b, rest);
    }
    a
}
