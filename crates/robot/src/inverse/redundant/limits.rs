//! The limits of a joint as a distance: negative inside, positive outside.

use super::wrapped;
use crate::space::JointSpace;
use std::f64::consts::PI;

/// What a joint may be beyond its limit, for rounding (radians or metres).
pub(super) const SLACK: f64 = 1e-9;

/// The values that a joint may have, whole turns left aside.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Range {
    pub middle: f64,
    /// Infinite without limits, and if an angle may have any value.
    pub half: f64,
    pub is_angle: bool,
}

impl Range {
    /// That of a joint.
    pub fn of(space: &JointSpace, joint: usize) -> Self {
        let is_angle = space.is_angle[joint];
        match space.limits[joint] {
            Some([low, high]) if !is_angle || high - low < 2.0 * PI => {
                Range { middle: (low + high) / 2.0, half: (high - low) / 2.0, is_angle }
            }
            _ => Range { middle: 0.0, half: f64::INFINITY, is_angle },
        }
    }

    /// That of all joints.
    pub fn all(space: &JointSpace) -> Vec<Self> {
        (0..space.limits.len()).map(|j| Range::of(space, j)).collect()
    }

    /// How far a value is beyond the nearer limit; continuous all round.
    #[inline]
    pub fn excess(&self, x: f64) -> f64 {
        let away = x - self.middle;
        let away = if self.is_angle { wrapped(away) } else { away };
        away.abs() - self.half
    }

    /// The limits, if there are any.
    pub fn ends(&self) -> Option<[f64; 2]> {
        self.half.is_finite().then_some([self.middle - self.half, self.middle + self.half])
    }
}

/// How far the worst joint is beyond its limit.
#[inline]
pub(super) fn excess(ranges: &[Range], q: &[f64]) -> f64 {
    ranges.iter().zip(q).map(|(r, &x)| r.excess(x)).fold(f64::NEG_INFINITY, f64::max)
}
