//! The values of formulas at random points modulo a prime.
//!
//! An angle in a sine has a point of the circle, and angle sums follow by the addition formulas; fixed angles are
//! exact. An angle outside of a sine is an independent number, as if it were another symbol. Two formulas that are
//! rational in sines, cosines and symbols and agree at all points are equal but for a probability below 10⁻⁴⁰. What is
//! drawn depends on the seed and on names, never on the order of questions.

use super::field::{self, K, Point, TURN, Value, mixed};
use denavit_symbolic::Angle;
use denavit_symbolic::expr::{Expr, Node};
use denavit_symbolic::rational::Rational;
use rustc_hash::FxHashMap;

/// An angle symbol's own point stands for this fraction of the angle, so that its halves and thirds have points too.
const PARTS: i64 = 60;
/// Radians are counted in these parts.
const RADIAN_PARTS: i64 = 1_000_000;
/// The most seeds that are tried for one point.
const MAX_DRAWS: u64 = 2_000;

/// Random points, and the values of formulas there.
#[derive(Clone, Debug)]
pub struct Points {
    seeds: [u64; K],
    known: FxHashMap<Expr, Option<Value>>,
}

impl Points {
    /// Points drawn from a seed.
    pub fn new(seed: u64) -> Self {
        let seeds = std::array::from_fn(|k| mixed(mixed(seed).wrapping_add(k as u64)));
        Points { seeds, known: FxHashMap::default() }
    }

    /// Points at which all the formulas have values: roots are taken of squares, and no divisor is 0. `None` if none
    /// were found.
    pub(crate) fn fitting(seed: u64, formulas: &[Expr]) -> Option<Self> {
        let has_values = |points: &mut Points| formulas.iter().all(|&e| points.value(e).is_some());
        let mut points = Points::new(seed);
        if has_values(&mut points) {
            return Some(points);
        }
        for k in 0..K {
            let mut draws = (0..MAX_DRAWS).map(|n| mixed(points.seeds[k].wrapping_add(n)));
            let drawn =
                draws.find(|&s| has_values(&mut Points { seeds: [s; K], known: FxHashMap::default() }));
            points.seeds[k] = drawn?;
        }
        points.known.clear();
        has_values(&mut points).then_some(points)
    }

    /// The values of a formula. `None` if it divides by 0 there or takes the root of a number that is no square, and
    /// for angles that have no exact point.
    pub fn value(&mut self, e: Expr) -> Option<Value> {
        if let Some(&known) = self.known.get(&e) {
            return known;
        }
        for part in Expr::postorder(&[e]) {
            if !self.known.contains_key(&part) {
                let value = self.of_node(part);
                self.known.insert(part, value);
            }
        }
        self.known.get(&e).copied().flatten()
    }

    /// The values of a formula that was asked for before.
    pub(super) fn known_value(&self, e: Expr) -> Option<Value> {
        self.known.get(&e).copied().flatten()
    }

    fn of_node(&self, e: Expr) -> Option<Value> {
        match e.node() {
            Node::Number(r) => Some([number(&r)?; K]),
            Node::Pi => Some(self.drawn("π", 0)),
            Node::Symbol(s) => Some(self.drawn(&s.name(), 1)),
            Node::Neg(a) => Some(field::opposite(&self.known_value(a)?)),
            Node::Add(a, b) => Some(field::sum(&self.known_value(a)?, &self.known_value(b)?)),
            Node::Sub(a, b) => Some(field::difference(&self.known_value(a)?, &self.known_value(b)?)),
            Node::Mul(a, b) => Some(field::product(&self.known_value(a)?, &self.known_value(b)?)),
            Node::Div(a, b) => {
                Some(field::product(&self.known_value(a)?, &field::reciprocal(&self.known_value(b)?)?))
            }
            Node::Pow(a, n) => field::raised(&self.known_value(a)?, n),
            Node::Sqrt(a) => roots(&self.known_value(a)?),
            Node::Sin(a) => Some(self.circle(a)?.map(|p| p.1)),
            Node::Cos(a) => Some(self.circle(a)?.map(|p| p.0)),
            Node::Atan2(y, x) => Some(arctangent(&self.known_value(y)?, &self.known_value(x)?)),
            Node::Sign(_) => None,
        }
    }

    /// Random numbers that belong to a name.
    fn drawn(&self, name: &str, kind: u64) -> Value {
        // Fowler, Noll, Vo: FNV-1a
        let hash = name
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3));
        self.seeds.map(|s| field::whole(mixed(mixed(hash ^ s).wrapping_add(kind))))
    }

    /// The points of the circle at an angle.
    fn circle(&self, argument: Expr) -> Option<[Point; K]> {
        let angle = Angle::of(argument);
        let (n, d) = (&angle.turns * &Rational::new(TURN / 2, 1)).to_parts()?;
        let mut at = [field::step(0); K];
        let mut turn = |by: [Point; K]| at = std::array::from_fn(|k| field::turned(at[k], by[k]));
        if d == 1 {
            turn([field::step(n); K]);
        } else {
            // Not a multiple of a step: the points of such angles are those of one that has the denominator.
            turn(self.arbitrary(&format!("turn/{d}")).map(|p| field::multiple(p, n)));
        }
        if !angle.radians.is_zero() {
            let (n, d) = (&angle.radians * &RADIAN_PARTS.into()).to_parts()?;
            turn(self.arbitrary(&format!("radian/{d}")).map(|p| field::multiple(p, n)));
        }
        for (term, factor) in &angle.terms {
            let base = match term.node() {
                Node::Symbol(s) => self.arbitrary(&s.name()),
                Node::Atan2(y, x) if factor.is_integer() => {
                    let (y, x) = (self.known_value(y)?, self.known_value(x)?);
                    let squares = field::sum(&field::product(&y, &y), &field::product(&x, &x));
                    let scale = field::reciprocal(&roots(&squares)?)?;
                    let n = factor.to_integer()?;
                    turn(std::array::from_fn(|k| {
                        let point = (field::times(x[k], scale[k]), field::times(y[k], scale[k]));
                        field::multiple(point, n)
                    }));
                    continue;
                }
                // Whatever else has an angle's value has the points of that value.
                _ => self.known_value(*term)?.map(|x| field::circle(field::whole(mixed(field::plain(x))))),
            };
            let (n, d) = (factor * &PARTS.into()).to_parts()?;
            if d != 1 {
                return None;
            }
            turn(base.map(|p| field::multiple(p, n)));
        }
        Some(at)
    }

    /// A point of the circle that belongs to a name.
    fn arbitrary(&self, name: &str) -> [Point; K] {
        self.drawn(name, 2).map(field::circle)
    }
}

fn number(r: &Rational) -> Option<u64> {
    let (n, d) = match r.to_parts() {
        Some((n, d)) => (field::signed(n), field::signed(d)),
        None => {
            let (n, d) = r.digits();
            let ten = field::whole(10);
            let read = |digits: &str| {
                digits
                    .bytes()
                    .fold(0, |x, b| field::plus(field::times(x, ten), field::whole((b - b'0').into())))
            };
            let n = read(&n);
            (if r.is_negative() { field::negative(n) } else { n }, read(&d))
        }
    };
    Some(field::times(n, field::inverse(d)?))
}

/// √a at every point.
pub(super) fn roots(a: &Value) -> Option<Value> {
    let mut result = field::ZERO;
    for k in 0..K {
        result[k] = field::root(a[k])?;
    }
    Some(result)
}

/// A number that belongs to the pair, as the arctangent does: equal for equal arguments.
pub(super) fn arctangent(y: &Value, x: &Value) -> Value {
    std::array::from_fn(|k| field::whole(mixed(mixed(field::plain(y[k])) ^ field::plain(x[k]))))
}
