//! Three joints whose axes meet, as a rotation: all angles for a rotation, and for rotations along a swivel the places
//! where a joint has a given value.
//!
//! R = Rz(t₁) M₁ Rz(t₂) M₂ Rz(t₃) with constant M = Rz(γ) Rx(α) Rz(β); the turns γ and β join the angles:
//! R = Rz(τ₁) Rx(α₁) Rz(τ₂) Rx(α₂) Rz(τ₃). Along a swivel R(ψ) = A sin ψ + B cos ψ + C.

use super::limits::{Range, SLACK};
use super::wrapped;
use crate::geometry::Rotation;

/// A 3×3 matrix, row-major.
pub(super) type Matrix = [[f64; 3]; 3];

/// The cosine of an angle may be beyond 1 by this, for rounding.
const CLAMP: f64 = 1e-12;
/// A cosine of a twist below this is that of a right angle.
const RIGHT: f64 = 1e-12;

/// A joint: number, sense of rotation, and what its variable's angle lacks to τ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    pub joint: usize,
    pub sense: f64,
    pub offset: f64,
}

/// The joints and the twists between their axes.
#[derive(Clone, Debug)]
pub(super) struct Spherical {
    pub turns: [Turn; 3],
    /// Cosine and sine of α₁ and α₂, the sines positive.
    twists: [[f64; 2]; 2],
    are_right: bool,
    ranges: [Range; 3],
}

/// R(ψ) = A sin ψ + B cos ψ + C.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swivel {
    pub a: Matrix,
    pub b: Matrix,
    pub c: Matrix,
}

impl Swivel {
    #[inline]
    pub fn at(&self, sin: f64, cos: f64) -> Matrix {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| self.c[i][j] + self.a[i][j] * sin + self.b[i][j] * cos)
        })
    }

    /// L·R(ψ)·M.
    pub fn between(&self, left: &Matrix, right: &Matrix) -> Swivel {
        let f = |m: &Matrix| product(&product(left, m), right);
        Swivel { a: f(&self.a), b: f(&self.b), c: f(&self.c) }
    }

    /// R(ψ)ᵀ.
    pub fn transposed(&self) -> Swivel {
        Swivel { a: transposed(&self.a), b: transposed(&self.b), c: transposed(&self.c) }
    }

    /// The ψ with xᵀR(ψ)y = value: a sin ψ + b cos ψ + c = value, at most two; those that touch count.
    fn where_product_is(&self, x: [f64; 3], y: [f64; 3], value: f64, found: &mut Vec<f64>) {
        let of = |m: &Matrix| -> f64 { (0..3).map(|i| x[i] * dot(m[i], y)).sum() };
        let (a, b, rest) = (of(&self.a), of(&self.b), value - of(&self.c));
        let length = a.hypot(b);
        if rest.abs() > length * (1.0 + CLAMP) || length < 1e-15 {
            return;
        }
        let middle = a.atan2(b);
        let away = ((length - rest) * (length + rest)).max(0.0).sqrt().atan2(rest);
        found.push(middle + away);
        found.push(middle - away);
    }
}

impl Spherical {
    /// The joints with the rotations between them; nothing if neighbouring axes are parallel.
    pub fn new(mut turns: [Turn; 3], between: [&Rotation<f64>; 2], ranges: [Range; 3]) -> Option<Self> {
        let mut twists = [[0.0; 2]; 2];
        for (i, m) in between.iter().enumerate() {
            // Column z: (sin γ sin α, −cos γ sin α, cos α); row z: (sin α sin β, sin α cos β, cos α).
            let (z, row) = (m.z(), m.inverse().z());
            let sine = z[0].hypot(z[1]);
            if sine < 1e-9 {
                return None;
            }
            turns[i].offset += z[0].atan2(-z[1]);
            turns[i + 1].offset += row[0].atan2(row[1]);
            twists[i] = [z[2], sine];
        }
        let are_right = twists.iter().all(|t| t[0].abs() <= RIGHT);
        Some(Spherical { turns, twists, are_right, ranges })
    }

    /// Rx(α) of a twist.
    pub fn twist(&self, number: usize) -> Matrix {
        let [c, s] = self.twists[number];
        [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]
    }

    /// The joint variables for a rotation, on the branch with this sign of sin τ₂; nothing if there are none.
    #[inline]
    pub fn solve(&self, r: &Matrix, sign: f64) -> Option<[f64; 3]> {
        let [[c1, s1], [c2, s2]] = self.twists;
        // R₃₃ = cos α₁ cos α₂ − sin α₁ sin α₂ cos τ₂
        let cosine = c1 * c2 - r[2][2];
        let (ct, st) = if self.are_right {
            let sine = r[0][2].hypot(r[1][2]);
            let length = cosine.hypot(sine);
            (cosine / length, sign * sine / length)
        } else {
            let scale = s1 * s2;
            let square = (scale - cosine) * (scale + cosine);
            if square < -CLAMP * scale {
                return None;
            }
            let sine = square.max(0.0).sqrt();
            let length = cosine.hypot(sine);
            (cosine / length, sign * sine / length)
        };
        // R e_z = Rz(τ₁) v with v = Rx(α₁) Rz(τ₂) Rx(α₂) e_z
        let (vx, vy) = (st * s2, -ct * s2 * c1 - c2 * s1);
        let (mut y, mut x) = (r[1][2] * vx - r[0][2] * vy, r[0][2] * vx + r[1][2] * vy);
        let length = x.hypot(y);
        if length > 1e-30 {
            (y, x) = (y / length, x / length);
        } else {
            (y, x) = (0.0, 1.0);
        }
        // The x and the y axis before the last turn; Rz(τ₃) is what the x axis of R is in them.
        let rotate = |p: [f64; 3]| {
            let (py, pz) = (p[1] * c1 - p[2] * s1, p[1] * s1 + p[2] * c1);
            [x * p[0] - y * py, y * p[0] + x * py, pz]
        };
        let axis_x = rotate([ct, st, 0.0]);
        let axis_y = rotate([-st * c2, ct * c2, s2]);
        let first = [r[0][0], r[1][0], r[2][0]];
        let tau = [y.atan2(x), st.atan2(ct), dot(axis_y, first).atan2(dot(axis_x, first))];
        Some(std::array::from_fn(|i| {
            let t = &self.turns[i];
            wrapped(t.sense * (tau[i] - t.offset))
        }))
    }

    /// |sin τ₂| for the second joint's variable: 0 where branches meet.
    #[inline]
    pub fn guard(&self, q: f64) -> f64 {
        (self.turns[1].sense * q + self.turns[1].offset).sin().abs()
    }

    /// How far the worst of the three is beyond its limit.
    #[inline]
    pub fn excess(&self, q: &[f64; 3]) -> f64 {
        self.ranges.iter().zip(q).map(|(r, &x)| r.excess(x)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// True if all three are within their limits.
    #[inline]
    pub fn is_within(&self, q: &[f64; 3]) -> bool {
        self.excess(q) <= SLACK
    }

    /// The ψ at which a joint is at a limit on some branch, or a branch ends.
    pub fn cuts(&self, swivel: &Swivel, found: &mut Vec<f64>) {
        let [[c1, s1], [c2, s2]] = self.twists;
        let z = [0.0, 0.0, 1.0];
        if !self.are_right {
            // cos τ₂ = ±1
            swivel.where_product_is(z, z, c1 * c2 - s1 * s2, found);
            swivel.where_product_is(z, z, c1 * c2 + s1 * s2, found);
        }
        for (i, range) in self.ranges.iter().enumerate() {
            for limit in range.ends().into_iter().flatten() {
                let tau = self.turns[i].sense * limit + self.turns[i].offset;
                let (sin, cos) = tau.sin_cos();
                match i {
                    // Axis 2, as τ₁ places it, and axis 3 enclose α₂.
                    0 => swivel.where_product_is([sin * s1, -cos * s1, c1], z, c2, found),
                    1 => swivel.where_product_is(z, z, c1 * c2 - s1 * s2 * cos, found),
                    // Axis 2, as τ₃ places it seen from behind, and axis 1 enclose α₁.
                    _ => swivel.where_product_is(z, [sin * s2, cos * s2, c2], c1, found),
                }
            }
        }
    }

    /// The ψ at which branches meet or end: cos τ₂ = ±1.
    pub fn ends(&self, swivel: &Swivel, found: &mut Vec<f64>) {
        let [[c1, s1], [c2, s2]] = self.twists;
        let z = [0.0, 0.0, 1.0];
        swivel.where_product_is(z, z, c1 * c2 - s1 * s2, found);
        swivel.where_product_is(z, z, c1 * c2 + s1 * s2, found);
    }
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let column = |j: usize| [b[0][j], b[1][j], b[2][j]];
    std::array::from_fn(|i| std::array::from_fn(|j| dot(a[i], column(j))))
}

pub(super) fn transposed(m: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

pub(super) fn act(m: &Matrix, v: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| dot(m[i], v))
}
