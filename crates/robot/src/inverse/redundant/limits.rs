//! The limits of a joint as a distance: negative inside, positive outside.

use crate::space::{JointSpace, within};

/// What a joint may be beyond its limit, for rounding (radians or metres).
pub(super) const SLACK: f64 = 1e-9;

/// The values that a joint may have, whole turns left aside.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Range {
    pub middle: f64,
    /// Infinite without limits, and if the joint may have any place.
    pub half: f64,
    /// What brings the joint back; infinite for one that slides.
    pub period: f64,
}

impl Range {
    /// That of a joint.
    pub fn of(space: &JointSpace, joint: usize) -> Self {
        let period = space.turning.periods[joint];
        match space.limits[joint] {
            Some([low, high]) if high - low < period => {
                Range { middle: (low + high) / 2.0, half: (high - low) / 2.0, period }
            }
            _ => Range { middle: 0.0, half: f64::INFINITY, period },
        }
    }

    /// That of all joints.
    pub fn all(space: &JointSpace) -> Vec<Self> {
        (0..space.limits.len()).map(|j| Range::of(space, j)).collect()
    }

    /// How far a value is beyond the nearer limit; continuous all round.
    #[inline]
    pub fn excess(&self, x: f64) -> f64 {
        within(x - self.middle, self.period).abs() - self.half
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
