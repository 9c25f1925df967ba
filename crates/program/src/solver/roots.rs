//! What each [`Root`] means over doubles. Every evaluator follows these rules, in these formulas, to the last bit.
//!
//! A guard g counts as vanished where |g| ≤ `GUARD`·sᵈ, with s the size and d the degree of the node, and where
//! what the root divides by is exactly 0. Without a guard of its own a root is guarded by what it divides by.
//!
//! | root | guard vanished | no root | one root, of multiplicity 2 |
//! |---|---|---|---|
//! | `Ratio` | free | – | – |
//! | `Direction` | free | – | – |
//! | `Line` | free | – | – |
//! | `Length` | one root, multiplicity 2 | – | guard vanished |
//! | `Sincos` | free if \|c\| ≤ `TOLERANCE`·sᵈ, else no root | D < −`CLAMP`(N + c²) | else D ≤ 0: (a, b)/√N, sign of c |
//! | `Quadratic` | r = −c/2b; if b vanishes too: free or no root, as above | D < −`CLAMP`(b² + \|ac\|) | else D ≤ 0: −b/a |
//! | `Quartic` | free | per pair of roots: \|f\| > `CLAMP`·(sum of the \|coefficients\|) where f is extremal | else: there |
//!
//! A free unknown takes the value that the caller gave, or (cos, sin) = (1, 0), r = 0, with the sign k = 1. An operand
//! that is not finite leaves no root.

use super::quartic::quartic;
use super::{CLAMP, GUARD, Root, TOLERANCE};

/// The roots of one equation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Roots {
    /// How many there are; the arrays hold as many.
    pub count: usize,
    /// The unknown: its cosine and sine, or its value and 0.
    pub values: [[f64; 2]; 4],
    /// The signs k, 0 for a root that does not branch.
    pub signs: [i8; 4],
    /// How often each counts.
    pub multiplicities: [u32; 4],
    /// What a relative error of the coefficients is magnified by at each: without bound where roots coincide.
    pub magnified: [f64; 4],
    /// True if the equation does not determine the unknown.
    pub is_free: bool,
    /// The guard, relative to sizeᵈᵉᵍʳᵉᵉ.
    pub guard: f64,
    /// How far the equation is from having a root, without dimension: |c|/√N − 1 for [`Root::Sincos`], −D/(b² + |ac| + a²·size²)
    /// for [`Root::Quadratic`], the smallest |f| by the sum of coefficients for [`Root::Quartic`]. 0 if there is one.
    pub gap: f64,
    /// How far it is from having two roots more, in the same measure: for [`Root::Quartic`].
    pub missed: f64,
}

impl Roots {
    pub(crate) const NONE: Roots = Roots {
        count: 0,
        values: [[0.0; 2]; 4],
        signs: [0; 4],
        multiplicities: [1; 4],
        magnified: [1.0; 4],
        is_free: false,
        guard: f64::INFINITY,
        gap: f64::INFINITY,
        missed: f64::INFINITY,
    };

    pub(crate) fn push(&mut self, value: [f64; 2], sign: i8, multiplicity: u32) {
        self.values[self.count] = value;
        self.signs[self.count] = sign;
        self.multiplicities[self.count] = multiplicity;
        self.magnified[self.count] = if multiplicity > 1 { f64::INFINITY } else { 1.0 };
        self.count += 1;
        self.gap = 0.0;
    }
}

/// sⁿ, rounded the same everywhere.
#[inline(always)]
pub(crate) fn power(size: f64, degree: u8) -> f64 {
    (0..degree).fold(1.0, |product, _| product * size)
}

/// `(x, y)/√(x² + y²)` with the sign of `sign`.
#[inline(always)]
pub(crate) fn direction(x: f64, y: f64, sign: f64) -> [f64; 2] {
    let inverse = 1.0 / (x * x + y * y).sqrt();
    let inverse = if sign < 0.0 { -inverse } else { inverse };
    [x * inverse, y * inverse]
}

/// The root of `a·cos + b·sin = c` with the sign k, from D > 0.
#[inline(always)]
pub(crate) fn sincos([a, b, c]: [f64; 3], discriminant: f64, k: f64) -> [f64; 2] {
    let r = k * discriminant.sqrt();
    let inverse = 1.0 / (a * a + b * b);
    [(a * c - b * r) * inverse, (b * c + a * r) * inverse]
}

/// The root of `a·r² + 2b·r + c = 0` with the sign k, from D > 0.
#[inline(always)]
pub(crate) fn quadratic([a, b, c]: [f64; 3], discriminant: f64, k: f64) -> f64 {
    // q = −(b ± √D) with the sign that does not cancel; the roots are q/a and c/q, and q/a is the one with that sign.
    let own = if b > 0.0 { -1.0 } else { 1.0 };
    let q = own * discriminant.sqrt() - b;
    if k == own { q / a } else { c / q }
}

/// A relative error of the roots of an equation whose coefficients have another: magnified, but no more than where roots
/// coincide, which are as many as the equation has.
pub(crate) fn magnified<T>(root: &Root<T>, error: f64, by: f64) -> f64 {
    let most = match root {
        Root::Sincos { .. } | Root::Quadratic { .. } => error.sqrt(),
        Root::Quartic { .. } => error.sqrt().sqrt(),
        _ => 1.0,
    };
    (error * by).min(most)
}

/// What a root divides by: its guard, if it has no other.
#[inline(always)]
pub(crate) fn divisor(root: &Root<f64>) -> f64 {
    match *root {
        Root::Ratio { denominator, .. } => denominator.abs(),
        Root::Direction { x, y, .. } | Root::Line { x, y } | Root::Length { x, y } => (x * x + y * y).sqrt(),
        Root::Sincos { a, b, .. } => (a * a + b * b).sqrt(),
        Root::Quadratic { a, .. } => a.abs(),
        Root::Quartic { cc, cs, c, s, one } => {
            [cs, c, s, one].iter().fold(cc.abs(), |most, x| most.max(x.abs()))
        }
    }
}

/// Whether a guard counts as vanished; `scale` is sizeᵈᵉᵍʳᵉᵉ.
#[inline(always)]
pub(crate) fn vanishes(guard: f64, divisor: f64, scale: f64) -> bool {
    (guard.abs() <= GUARD * scale) | (divisor == 0.0)
}

/// A guard relative to sizeᵈᵉᵍʳᵉᵉ.
#[inline(always)]
pub(crate) fn relative(guard: f64, scale: f64) -> f64 {
    if guard == 0.0 { 0.0 } else { guard.abs() / scale }
}

/// The roots of an equation.
///
/// `guard` is the value of [`Node::guard`](super::Node::guard) where the node has one; `scale` is sizeᵈᵉᵍʳᵉᵉ and `size` that
/// of the lengths; `given` is the value that the unknown takes if it is free: cosine and sine, or the value and anything.
pub fn roots(
    root: &Root<f64>,
    guard: Option<f64>,
    (scale, size): (f64, f64),
    given: Option<[f64; 2]>,
) -> Roots {
    let mut found = Roots::NONE;
    let divisor = divisor(root);
    let guard = guard.unwrap_or(divisor);
    let mut is_finite = guard.is_finite() & scale.is_finite();
    root.map(|x| is_finite &= x.is_finite());
    if !is_finite {
        return found;
    }
    found.guard = relative(guard, scale);
    let vanished = vanishes(guard, divisor, scale);
    let k = i8::from(root.branches() > 1);
    let free = |mut found: Roots| {
        let otherwise = if root.is_angle() { [1.0, 0.0] } else { [0.0, 0.0] };
        found.push(given.unwrap_or(otherwise), k, 1);
        found.is_free = true;
        found
    };
    match *root {
        Root::Ratio { .. } | Root::Direction { .. } | Root::Line { .. } if vanished => return free(found),
        Root::Ratio { numerator, denominator } => found.push([numerator / denominator, 0.0], k, 1),
        Root::Direction { x, y, sign } => found.push(direction(x, y, sign.unwrap_or(1.0)), k, 1),
        Root::Line { x, y } => {
            found.push(direction(x, y, 1.0), 1, 1);
            found.push(direction(x, y, -1.0), -1, 1);
        }
        Root::Length { .. } if vanished => found.push([divisor, 0.0], 1, 2),
        Root::Length { .. } => {
            found.push([divisor, 0.0], 1, 1);
            found.push([-divisor, 0.0], -1, 1);
        }
        Root::Sincos { c, .. } if vanished => {
            if c.abs() <= TOLERANCE * scale {
                return free(found);
            }
        }
        Root::Sincos { a, b, c, discriminant } => {
            let n = a * a + b * b;
            let d = discriminant.unwrap_or(n - c * c);
            if d > 0.0 {
                found.push(sincos([a, b, c], d, 1.0), 1, 1);
                found.push(sincos([a, b, c], d, -1.0), -1, 1);
                found.magnified[..2].fill((n / d).sqrt());
            } else if d < -CLAMP * (n + c * c) {
                found.gap = c.abs() / divisor - 1.0;
            } else {
                found.push(direction(a, b, c), 1, 2);
            }
        }
        Root::Quadratic { b, c, .. } if vanished => {
            if b.abs() > GUARD * scale {
                found.push([-c / (2.0 * b), 0.0], 1, 1);
            } else if c.abs() <= TOLERANCE * scale {
                return free(found);
            }
        }
        Root::Quadratic { a, b, c } => {
            let d = b * b - a * c;
            let terms = b * b + (a * c).abs();
            // Of roots near 0, what rounding leaves is seen beside the lengths.
            let lengths = terms + a * a * size * size;
            if d > 0.0 {
                found.push([quadratic([a, b, c], d, 1.0), 0.0], 1, 1);
                found.push([quadratic([a, b, c], d, -1.0), 0.0], -1, 1);
                found.magnified[..2].fill((lengths / d).sqrt());
            } else if d < -CLAMP * terms {
                found.gap = -d / lengths;
            } else {
                found.push([-b / a, 0.0], 1, 2);
            }
        }
        Root::Quartic { .. } if vanished => return free(found),
        Root::Quartic { cc, cs, c, s, one } => quartic([cc, cs, c, s, one], &mut found),
    }
    found
}
