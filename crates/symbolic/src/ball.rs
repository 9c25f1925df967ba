//! Values with an error bound: a double and a radius that holds the true value.
//!
//! Only for disproof: if the ball of a difference excludes 0, the two sides differ.

use crate::expr::{Expr, Node, Symbol};
use rustc_hash::FxHashMap;

/// The true value lies within `radius` of `mid`; an infinite radius says nothing.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// The centre.
    pub mid: f64,
    /// The bound on the distance of the true value.
    pub radius: f64,
}

/// Relative error granted to each rounded operation: 4 ulp, above that of `+ − × ÷ √` and of every libm's sine,
/// cosine and arctangent.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

impl Ball {
    fn new(mid: f64, spread: f64) -> Self {
        let radius = spread * (1.0 + ROUNDING) + mid.abs() * ROUNDING + f64::MIN_POSITIVE;
        if mid.is_finite() && radius.is_finite() { Ball { mid, radius } } else { Ball::unknown() }
    }

    fn unknown() -> Self {
        Ball { mid: 0.0, radius: f64::INFINITY }
    }

    /// True if the value is certainly not 0.
    pub(crate) fn excludes_zero(self) -> bool {
        self.mid.abs() > self.radius
    }

    fn over(self, o: Ball) -> Ball {
        if !o.excludes_zero() {
            return Ball::unknown();
        }
        let least = o.mid.abs() - o.radius;
        let mid = self.mid / o.mid;
        Ball::new(mid, (self.radius + mid.abs() * o.radius) / least)
    }

    fn times(self, o: Ball) -> Ball {
        let spread = self.mid.abs() * o.radius + o.mid.abs() * self.radius + self.radius * o.radius;
        Ball::new(self.mid * o.mid, spread)
    }
}

/// The value of an expression at exact doubles; `leaf` gives the symbols theirs (0 where it has none).
pub fn evaluate(e: Expr, leaf: impl Fn(Symbol) -> Option<f64>) -> Ball {
    let mut value: FxHashMap<Expr, Ball> = FxHashMap::default();
    for part in Expr::postorder(&[e]) {
        let ball = match part.node() {
            Node::Number(r) => Ball::new(r.to_f64(), 0.0),
            Node::Pi => Ball::new(std::f64::consts::PI, 0.0),
            Node::Symbol(s) => Ball { mid: leaf(s).unwrap_or(0.0), radius: 0.0 },
            Node::Neg(a) => Ball { mid: -value[&a].mid, ..value[&a] },
            Node::Add(a, b) => Ball::new(value[&a].mid + value[&b].mid, value[&a].radius + value[&b].radius),
            Node::Sub(a, b) => Ball::new(value[&a].mid - value[&b].mid, value[&a].radius + value[&b].radius),
            Node::Mul(a, b) => value[&a].times(value[&b]),
            Node::Div(a, b) => value[&a].over(value[&b]),
            Node::Pow(a, n) => {
                let one = Ball { mid: 1.0, radius: 0.0 };
                let steps = n.unsigned_abs().min(64);
                let power = (0..steps).fold(one, |x, _| x.times(value[&a]));
                match (steps == n.unsigned_abs(), n < 0) {
                    (false, _) => Ball::unknown(),
                    (true, true) => one.over(power),
                    (true, false) => power,
                }
            }
            Node::Sign(a) => match value[&a] {
                x if x.mid.abs() <= x.radius => Ball::unknown(),
                x => Ball { mid: x.mid.signum(), radius: 0.0 },
            },
            Node::Sqrt(a) => match value[&a] {
                x if x.mid - x.radius <= 0.0 => Ball::unknown(),
                // |√x − √y| ≤ |x − y| / √(least)
                x => Ball::new(x.mid.sqrt(), x.radius / (x.mid - x.radius).sqrt()),
            },
            Node::Sin(a) => Ball::new(value[&a].mid.sin(), value[&a].radius),
            Node::Cos(a) => Ball::new(value[&a].mid.cos(), value[&a].radius),
            Node::Atan2(a, b) => {
                let (y, x) = (value[&a], value[&b]);
                let least = x.mid.hypot(y.mid) - x.radius - y.radius;
                let crosses_cut = x.mid <= x.radius && y.mid.abs() <= y.radius;
                if least.is_finite() && least > 0.0 && !crosses_cut {
                    // the angle between two vectors is below π/2 times their distance over the shorter one
                    Ball::new(y.mid.atan2(x.mid), 1.6 * (x.radius + y.radius) / least)
                } else {
                    Ball::unknown()
                }
            }
        };
        value.insert(part, ball);
    }
    value[&e]
}
