//! Parallel axes, read off the exact constant rotation between them: a turn there and back is found, and 89.99° is not.

use super::Rotation;
use denavit_symbolic::{Expr, Node, Rational, equal};

/// If z stays parallel to itself: whether it is reversed.
pub(crate) fn reversed(r: &Rotation<Expr>) -> Option<bool> {
    let z = r.z();
    (z[0].is_zero() && z[1].is_zero()).then(|| z[2].as_number()).flatten().map(|z| z.is_negative())
}

/// If the rotation is Rz(γ) or Rz(γ)·Rx(π): γ, and whether z is reversed.
pub(crate) fn parallel(r: &Rotation<Expr>) -> Option<(Expr, bool)> {
    let flipped = reversed(r)?;
    let x = r.x();
    Some((constant_angle(x[1], x[0])?, flipped))
}

/// Rx(π) if z is reversed.
pub(crate) fn flip(flipped: bool) -> Rotation<Expr> {
    if flipped { Rotation::about_x(Expr::pi()) } else { Rotation::identity() }
}

/// The constant angle with this sine and cosine, if it is a multiple of π/60 or stands there as a symbol.
fn constant_angle(s: Expr, c: Expr) -> Option<Expr> {
    if let Node::Cos(a) = c.node()
        && let Some(angle) = [a, -a].into_iter().find(|x| x.sin() == s)
    {
        return Some(angle);
    }
    let numeric = s.eval(|_| None).ok()?.atan2(c.eval(|_| None).ok()?);
    let sixtieths = (numeric / std::f64::consts::PI * 60.0).round();
    let gamma = Expr::from(Rational::new(sixtieths as i64, 60)) * Expr::pi();
    let (exact_s, exact_c) = gamma.sin_cos();
    (equal(exact_s, s).is_equal() && equal(exact_c, c).is_equal()).then_some(gamma)
}
