//! Magnified arcs of the circle: where roots crowd, the determinant is sampled again with most of its nodes there.
//!
//! The chart around `θ₀` with the magnification `1/κ` has the angle `θ'`, `tan((θ − θ₀)/2) = κ tan(θ'/2)`. This is a Möbius
//! map of the circle to itself, so a trigonometric polynomial `p(θ)` of degree n times `w(θ')ⁿ`,
//! `w = cos²(θ'/2) + κ² sin²(θ'/2)`, is one of degree n in `θ'` again. The weight hides what is far from `θ₀`, and with it
//! the rounding errors there; near a crowd of roots, where all values are small, the errors of the determinant are small
//! as well.

use crate::{
    fourier::Trigonometric,
    instructions::{Compute, Instructions, part},
    lanes::{Lanes, WIDTH},
};

/// A chart, and the part of the circle that it answers for.
#[derive(Clone, Copy, Debug)]
pub struct Chart {
    /// Cosine and sine of the centre `θ₀`.
    pub centre: [f64; 2],
    /// `κ`: 1 shows the whole circle as it is.
    pub kappa: f64,
    /// How often a part of a part was taken.
    pub depth: u32,
}

impl Chart {
    /// The whole circle.
    pub const WHOLE: Chart = Chart { centre: [1.0, 0.0], kappa: 1.0, depth: 0 };

    /// The arc around an angle, seen so that it covers half of the circle.
    pub fn around(angle: f64, half_width: f64, depth: u32) -> Chart {
        let (s, c) = angle.sin_cos();
        Chart { centre: [c, s], kappa: (half_width / 2.0).tan(), depth }
    }

    /// The arc around the angle `θ'` as a chart of its own.
    pub fn part(&self, centre: f64, half_width: f64) -> Chart {
        let outside = |angle: f64| {
            let (s, c) = angle.sin_cos();
            let [c, s] = self.outside([c, s]);
            s.atan2(c)
        };
        let (low, high) = (outside(centre - half_width), outside(centre + half_width));
        let half = (high - low).rem_euclid(std::f64::consts::TAU) / 2.0;
        Chart::around(low + half, if half < WIDEST { half } else { WIDEST }, self.depth + 1)
    }

    /// Cosines and sines of `θ` at those of `θ'`, and the weight `w(θ')`.
    #[inline(always)]
    pub fn nodes<I: Instructions>(&self, c: Lanes, s: Lanes) -> [Lanes; 3] {
        let square = self.kappa * self.kappa;
        let (near, far) = (Lanes::ONE.plus(c), Lanes::ONE.minus(c).scale(square));
        let (sum, inverse) = (near.plus(far), Lanes::ONE.over(near.plus(far)));
        let (c, s) = (near.minus(far).times(inverse), s.scale(2.0 * self.kappa).times(inverse));
        let [c0, s0] = self.centre;
        [s.scale_add::<I>(-s0, c.scale(c0)), c.scale_add::<I>(s0, s.scale(c0)), sum.scale(0.5)]
    }

    /// Cosine and sine of `θ` at those of `θ'`.
    #[inline]
    pub fn outside(&self, [c, s]: [f64; 2]) -> [f64; 2] {
        let [c, s] = stretched(self.kappa, c, s);
        let [c0, s0] = self.centre;
        [c * c0 - s * s0, s * c0 + c * s0]
    }

    /// Cosine and sine of `θ'` at those of `θ`.
    #[inline]
    pub fn inside(&self, [c, s]: [f64; 2]) -> [f64; 2] {
        let [c0, s0] = self.centre;
        stretched(1.0 / self.kappa, c * c0 + s * s0, s * c0 - c * s0)
    }

    /// Whether the chart answers for the angle `θ'` with this cosine.
    #[inline]
    pub fn answers_for(&self, cosine: f64) -> bool {
        self.depth == 0 || cosine >= 0.0
    }
}

/// `2 atan(κ tan(φ/2))` by cosine and sine.
#[inline]
fn stretched(kappa: f64, c: f64, s: f64) -> [f64; 2] {
    let (near, far) = (1.0 + c, kappa * kappa * (1.0 - c));
    let sum = near + far;
    if sum > 0.0 { [(near - far) / sum, 2.0 * kappa * s / sum] } else { [-1.0, 0.0] }
}

/// Largest half width of a part (rad).
const WIDEST: f64 = 2.8;

part! {
    /// The arcs in which there may be roots that are not where they seem to be, as `(centre, half width)`; their number.
    ///
    /// `angles` are sorted, those to be looked at are marked. Around each of them the polynomial may vanish as far as it is
    /// below its `noise`: the arc ends on either side where it is certainly not zero.
    pub fn crowds<I>(
        angles: &[f64],
        marked: &[bool],
        polynomial: &Trigonometric,
        noise: f64,
        out: &mut [(f64, f64); 8],
    ) -> usize {
        let mut found = 0;
        for (&angle, &marked) in angles.iter().zip(marked) {
            let known = |&(centre, half_width): &(f64, f64)| {
                let away = (angle - centre).rem_euclid(std::f64::consts::TAU);
                away < half_width || std::f64::consts::TAU - away < half_width
            };
            if !marked || out[..found].iter().any(known) {
                continue;
            }
            if found == out.len() {
                return 0;
            }
            let mut ends = [0.0; 2];
            for (end, side) in ends.iter_mut().zip([-1.0, 1.0]) {
                *end = clear::<I>(polynomial, angle, side, noise);
            }
            let [low, high] = ends;
            out[found] = ((low + high) / 2.0, (high - low) / 2.0);
            found += 1;
        }
        found
    }
}

/// The first of steps from an angle to one side at which the polynomial is clear of its noise.
#[inline(always)]
fn clear<I: Instructions>(polynomial: &Trigonometric, from: f64, side: f64, noise: f64) -> f64 {
    let mut at = from;
    let mut step = side * LEAST;
    for _ in 0..3 {
        let (mut steps, mut c, mut s) = ([0.0; WIDTH], Lanes::ZERO, Lanes::ZERO);
        for l in 0..WIDTH {
            at += step;
            step *= GROWTH;
            steps[l] = at;
            (s.0[l], c.0[l]) = at.sin_cos();
        }
        let values = polynomial.values::<I>(c, s).magnitude();
        for l in 0..WIDTH {
            if values.0[l] > noise {
                return steps[l];
            }
        }
    }
    at
}

/// The first step (rad),
const LEAST: f64 = 5e-4;
/// and how it grows.
const GROWTH: f64 = 1.3;
