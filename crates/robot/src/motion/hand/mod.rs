//! Paths of the hand: lines, arcs, splines.
//!
//! The parameter s runs from 0 to 1 along the whole path. Poses are of the tool in the base, metres.

mod arc;
mod line;
mod spline;
mod turn;

pub use arc::{Arc, ArcError};
pub use line::{Line, Orientation};
pub use spline::PoseSpline;

use crate::geometry::Transform;

/// What a part of a path is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stretch {
    /// A straight line.
    Line,
    /// An arc of a circle.
    Arc,
    /// A smooth curve through so many poses.
    Spline(usize),
}

/// A path of the hand.
pub trait HandPath {
    /// The pose at s in [0, 1].
    fn pose(&self, s: f64) -> Transform<f64>;

    /// What it consists of.
    fn stretches(&self) -> Vec<Stretch>;

    /// Where the direction of the motion may jump, increasing, the ends not among them.
    fn corners(&self) -> Vec<f64> {
        vec![]
    }

    /// The length of the way of the tool's origin, metres.
    fn length(&self) -> f64 {
        let points: Vec<_> = (0..=256).map(|k| self.pose(f64::from(k) / 256.0).translation).collect();
        points.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
    }

    /// The twist by s, linear first, along the axes of the base: the velocity of the tool's origin and the angular
    /// velocity if s grew by 1 a second; by differences to one side of `s` where the path ends or has a corner.
    fn twist(&self, s: f64) -> [f64; 6] {
        let step = 1e-6;
        let cut = |x: f64| x.clamp(0.0, 1.0);
        let is_corner = self.corners().iter().any(|c| (c - s).abs() < 2.0 * step);
        let (a, b) = if is_corner { (s, cut(s + step)) } else { (cut(s - step), cut(s + step)) };
        let (before, after) = (self.pose(a), self.pose(b));
        let v = (after.translation - before.translation).scale(1.0 / (b - a));
        let w = turn::vector(&(after.rotation * before.rotation.inverse())).scale(1.0 / (b - a));
        [v[0], v[1], v[2], w[0], w[1], w[2]]
    }
}

/// Paths one after another, each from where the one before ends; s is shared out by their lengths.
pub struct HandChain {
    parts: Vec<Box<dyn HandPath + Send + Sync>>,
    /// s at the end of each.
    ends: Vec<f64>,
}

impl HandChain {
    /// Of parts, at least one.
    pub fn new(parts: Vec<Box<dyn HandPath + Send + Sync>>) -> Self {
        // A part that turns on the spot counts by its angle, half a metre a radian.
        let size = |p: &(dyn HandPath + Send + Sync)| {
            let turned = turn::vector(&(p.pose(0.0).rotation.inverse() * p.pose(1.0).rotation)).norm();
            p.length().max(0.5 * turned).max(1e-9)
        };
        let sizes: Vec<f64> = parts.iter().map(|p| size(&**p)).collect();
        let total: f64 = sizes.iter().sum();
        let mut at = 0.0;
        let ends = sizes.iter().map(|s| {
            at += s / total;
            at
        });
        HandChain { ends: ends.collect(), parts }
    }
}

impl HandPath for HandChain {
    fn stretches(&self) -> Vec<Stretch> {
        self.parts.iter().flat_map(|p| p.stretches()).collect()
    }

    fn pose(&self, s: f64) -> Transform<f64> {
        let last = self.parts.len() - 1;
        let k = self.ends.partition_point(|e| *e <= s).min(last);
        let from = if k == 0 { 0.0 } else { self.ends[k - 1] };
        self.parts[k].pose(((s - from) / (self.ends[k] - from)).clamp(0.0, 1.0))
    }

    fn corners(&self) -> Vec<f64> {
        let mut found = vec![];
        for (k, part) in self.parts.iter().enumerate() {
            let from = if k == 0 { 0.0 } else { self.ends[k - 1] };
            found.extend(part.corners().iter().map(|c| from + c * (self.ends[k] - from)));
            if k + 1 < self.parts.len() {
                found.push(self.ends[k]);
            }
        }
        found
    }
}
