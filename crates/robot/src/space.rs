//! The space of the joints: which of them turn, how configurations differ, what the limits allow.

use std::f64::consts::{PI, TAU};

/// Solutions this near (radians, and lengths by the reach) are the same: two roots that coincide differ by as much.
const SAME: f64 = 2e-6;
/// What a joint may be beyond its limit, for rounding (radians or metres).
const SLACK: f64 = 1e-9;

/// The space of the joint variables of a robot with numbers.
#[derive(Clone, PartialEq, Debug)]
pub struct JointSpace {
    /// Whether a joint turns (radians) or slides (metres).
    pub is_angle: Vec<bool>,
    /// The lowest and the highest value of a joint, where they are known.
    pub limits: Vec<Option<[f64; 2]>>,
    /// A length that slides are compared with: the sum of the robot's lengths, metres.
    pub reach: f64,
}

impl JointSpace {
    /// The space of the joints that are not held.
    pub fn held(&self, held: &[usize]) -> Self {
        let left = |j: &usize| !held.contains(j);
        let joints: Vec<usize> = (0..self.is_angle.len()).filter(left).collect();
        JointSpace {
            is_angle: joints.iter().map(|&j| self.is_angle[j]).collect(),
            limits: joints.iter().map(|&j| self.limits[j]).collect(),
            reach: self.reach,
        }
    }

    /// How the joints differ, angles by the shorter way.
    pub fn moved(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        let pairs = from.iter().zip(to).zip(&self.is_angle);
        pairs.map(|((x, y), &is_angle)| if is_angle { wrapped(y - x) } else { y - x }).collect()
    }

    /// The largest difference of a joint, lengths by the reach.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let differences = self.moved(a, b);
        let by =
            |(d, &is_angle): (&f64, &bool)| if is_angle { d.abs() } else { d.abs() / self.reach.max(1e-3) };
        differences.iter().zip(&self.is_angle).map(by).fold(0.0, f64::max)
    }

    /// True if two configurations are one, but for rounding and whole turns.
    pub fn is_same(&self, a: &[f64], b: &[f64]) -> bool {
        self.distance(a, b) <= SAME
    }

    /// The middle of the limits; 0 where there are none.
    pub fn middle(&self) -> Vec<f64> {
        self.limits.iter().map(|l| l.map_or(0.0, |[low, high]| f64::midpoint(low, high))).collect()
    }

    /// Brings angles to (−π, π].
    pub fn wrap(&self, q: &mut [f64]) {
        for (x, _) in q.iter_mut().zip(&self.is_angle).filter(|p| *p.1) {
            *x = wrapped(*x);
        }
    }

    /// How many whole turns joint `j` may be moved by from `x` within its limits: the fewest and the most; nothing if
    /// the limits exclude all. A joint without limits, and one that slides, stays where it is.
    pub fn turns(&self, j: usize, x: f64) -> Option<[i32; 2]> {
        let Some([low, high]) = self.limits[j] else { return Some([0, 0]) };
        if !self.is_angle[j] {
            return (low - SLACK..=high + SLACK).contains(&x).then_some([0, 0]);
        }
        let fewest = ((low - SLACK - x) / TAU).ceil() as i32;
        let most = ((high + SLACK - x) / TAU).floor() as i32;
        (fewest <= most).then_some([fewest, most])
    }

    /// True if the limits allow a configuration, or a copy of it whole turns away.
    pub fn within(&self, q: &[f64]) -> bool {
        (0..q.len()).all(|j| self.turns(j, q[j]).is_some())
    }

    /// The copy of a configuration, joints moved by whole turns, that the limits allow and that is nearest to another;
    /// a joint for which they allow none goes to the nearest copy.
    pub fn nearest_copy(&self, q: &[f64], to: &[f64]) -> Vec<f64> {
        let pairs = q.iter().zip(to).enumerate();
        pairs
            .map(|(j, (&x, &y))| {
                if !self.is_angle[j] {
                    return x;
                }
                let turns = ((y - x) / TAU).round();
                match (self.limits[j], self.turns(j, x)) {
                    (Some(_), Some([fewest, most])) => x + TAU * turns.clamp(fewest.into(), most.into()),
                    _ => x + TAU * turns,
                }
            })
            .collect()
    }
}

/// The angle in (−π, π].
pub(crate) fn wrapped(x: f64) -> f64 {
    let y = x - TAU * (x / TAU).round();
    if y <= -PI { y + TAU } else { y }
}

pub(crate) fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
