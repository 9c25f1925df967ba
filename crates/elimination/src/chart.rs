//! Magnified arcs of the circle: where roots crowd, the determinant is sampled again with most of its nodes there.
//!
//! The chart around `θ₀` with the magnification `1/κ` has the angle `θ'`, `tan((θ − θ₀)/2) = κ tan(θ'/2)`. This is a Möbius
//! map of the circle to itself, so a trigonometric polynomial `p(θ)` of degree n times `w(θ')ⁿ`,
//! `w = cos²(θ'/2) + κ² sin²(θ'/2)`, is one of degree n in `θ'` again. The weight hides what is far from `θ₀`, and with it
//! the rounding errors there; near a crowd of roots, where all values are small, the errors of the determinant are small
//! as well.

use crate::lanes::Lanes;

/// A chart, and the part of the circle that it answers for.
#[derive(Clone, Copy, Debug)]
pub struct Chart {
    /// Cosine and sine of the centre `θ₀`.
    pub centre: [f64; 2],
    /// `κ`: 1 shows the whole circle as it is.
    pub kappa: f64,
    /// How far from the centre (rad) its roots count.
    pub half_width: f64,
    /// How often a part of a part was taken.
    pub depth: u32,
}

impl Chart {
    /// The whole circle.
    pub const WHOLE: Chart = Chart { centre: [1.0, 0.0], kappa: 1.0, half_width: 4.0, depth: 0 };

    /// The arc around an angle, seen so that it covers half of the circle.
    #[inline(always)]
    pub fn around(angle: f64, half_width: f64, depth: u32) -> Chart {
        let (s, c) = angle.sin_cos();
        Chart { centre: [c, s], kappa: (half_width / 2.0).tan(), half_width, depth }
    }

    /// The arc around the angle `θ'` as a chart of its own.
    #[inline(always)]
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
    pub fn nodes<const FUSED: bool>(&self, c: Lanes, s: Lanes) -> [Lanes; 3] {
        let square = self.kappa * self.kappa;
        let (near, far) = (Lanes::ONE.plus(c), Lanes::ONE.minus(c).scale(square));
        let (sum, inverse) = (near.plus(far), Lanes::ONE.over(near.plus(far)));
        let (c, s) = (near.minus(far).times(inverse), s.scale(2.0 * self.kappa).times(inverse));
        let [c0, s0] = self.centre;
        [s.scale_add::<FUSED>(-s0, c.scale(c0)), c.scale_add::<FUSED>(s0, s.scale(c0)), sum.scale(0.5)]
    }

    /// Cosine and sine of `θ` at those of `θ'`.
    #[inline(always)]
    pub fn outside(&self, [c, s]: [f64; 2]) -> [f64; 2] {
        let [c, s] = stretched(self.kappa, c, s);
        let [c0, s0] = self.centre;
        [c * c0 - s * s0, s * c0 + c * s0]
    }

    /// Cosine and sine of `θ'` at those of `θ`.
    #[inline(always)]
    pub fn inside(&self, [c, s]: [f64; 2]) -> [f64; 2] {
        let [c0, s0] = self.centre;
        stretched(1.0 / self.kappa, c * c0 + s * s0, s * c0 - c * s0)
    }

    /// Whether the chart answers for the angle `θ'` with this cosine.
    #[inline(always)]
    pub fn answers_for(&self, cosine: f64) -> bool {
        self.depth == 0 || cosine >= 0.0
    }
}

/// `2 atan(κ tan(φ/2))` by cosine and sine.
#[inline(always)]
fn stretched(kappa: f64, c: f64, s: f64) -> [f64; 2] {
    let (near, far) = (1.0 + c, kappa * kappa * (1.0 - c));
    let sum = near + far;
    if sum > 0.0 { [(near - far) / sum, 2.0 * kappa * s / sum] } else { [-1.0, 0.0] }
}

/// Largest half width of a part (rad).
const WIDEST: f64 = 2.8;

/// A sorted list of angles on the circle (rad) with marks on some: the arcs around the marked ones that hold their close
/// neighbours as well and end half way to the next, as `(centre, half width)`; their number.
#[inline(always)]
pub fn crowds(angles: &[f64], marked: &[bool], reach: &[f64], out: &mut [(f64, f64); 8]) -> usize {
    let n = angles.len();
    let tau = std::f64::consts::TAU;
    // Angle number k counted on around the circle, as often as needed.
    let angle = |k: usize| angles[k % n] + tau * (k / n) as f64;
    let mut found = 0;
    let mut from = 0;
    while from < n && found < out.len() {
        if !marked[from] {
            from += 1;
            continue;
        }
        // Grow to both sides while the next one is near compared to what there is.
        let (mut low, mut high) = (from + n, from + n);
        while high - low + 1 < n {
            let span = angle(high) - angle(low);
            let (before, after) = (angle(low) - angle(low - 1), angle(high + 1) - angle(high));
            let near = if span < LEAST { LEAST } else { span * GROWTH };
            let (left, right) = (reach[low % n], reach[high % n]);
            let near = if near < left { left } else { near };
            let near = if near < right { right } else { near };
            if before <= near && before <= after {
                low -= 1;
            } else if after <= near {
                high += 1;
            } else if before <= near {
                low -= 1;
            } else {
                break;
            }
            if low == 0 {
                break;
            }
        }
        let span = angle(high) - angle(low);
        let (before, after) = if high - low + 1 < n {
            ((angle(low) - angle(low - 1)) / 2.0, (angle(high + 1) - angle(high)) / 2.0)
        } else {
            ((tau - span) / 2.0, (tau - span) / 2.0)
        };
        let margin = if span < LEAST { LEAST } else { span };
        let least = if before < after { before } else { after };
        let margin = if least < margin { least } else { margin };
        out[found] = (angle(low) + span / 2.0, span / 2.0 + margin);
        found += 1;
        from = if high >= n { high - n + 1 } else { from + 1 };
    }
    found
}

/// Least span of a crowd (rad).
const LEAST: f64 = 1e-3;
/// A neighbour within this part of the span belongs to the crowd.
const GROWTH: f64 = 0.5;
