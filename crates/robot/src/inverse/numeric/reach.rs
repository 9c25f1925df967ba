//! Places that a frame cannot come to, whatever the joints do.
//!
//! Between the axes of its joints an arm is rigid. The origin of a frame lies at the end of a chain of such pieces that
//! starts on the first axis; it is no further from there than they are long together, and no nearer than the longest is
//! longer than the others together.

use super::limits::Limits;
use super::task::{Frame, Place, dot, sub};
use crate::description::JointKind;
use crate::mechanism::{Affine, Lengths, MovingAxes, Robot};

/// What of space a frame can come to.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Reach {
    /// From here distances count, metres in the base.
    centre: [f64; 3],
    /// The place behind the last axis, in the frame.
    behind: [f64; 3],
    /// The distances of the place behind the last axis from the centre.
    wrist: [f64; 2],
    /// Those of the frame itself.
    frame: [f64; 2],
}

impl Reach {
    /// That of a frame.
    pub fn new(robot: &Robot<f64>, limits: &Limits, frame: Frame) -> Self {
        // A constant length along an axis belongs to what is before it, so that the pieces end on axes.
        let chain = robot.up_to(frame.reference(robot.links.len()));
        let axes = MovingAxes::new(&chain, Lengths::Before);
        let (last, before) = axes.constants.split_last().expect("a constant stands behind the last axis");
        let mut pieces: Vec<[f64; 2]> = vec![];
        for (k, (axis, constant)) in axes.moving.iter().zip(before).enumerate() {
            if k > 0 {
                pieces.push([constant.translation.norm(); 2]);
            }
            if axis.kind == JointKind::Prismatic {
                pieces.push(travel(&axis.value, limits));
            }
        }
        let Some(first) = before.first() else {
            // Nothing moves: the frame is where it is.
            let centre = last.translation.0;
            return Reach { centre, behind: [0.0; 3], wrist: [0.0; 2], frame: [0.0; 2] };
        };
        let wrist = shell(&pieces);
        pieces.push([last.translation.norm(); 2]);
        let behind = last.inverse().translation.0;
        Reach { centre: first.translation.0, behind, wrist, frame: shell(&pieces) }
    }

    /// How far, in metres, a target is beyond what the frame can come to; with its orientation to be met, how far the
    /// place behind the last axis is.
    pub fn beyond(&self, target: &Place, with_orientation: bool) -> f64 {
        let outside = |p: [f64; 3], [least, most]: [f64; 2]| {
            let d = sub(p, self.centre);
            let distance = dot(d, d).sqrt();
            (distance - most).max(least - distance)
        };
        let own = outside(target.p, self.frame);
        if !with_orientation {
            return own;
        }
        let lever = super::task::apply(&target.r, self.behind);
        let at = [target.p[0] + lever[0], target.p[1] + lever[1], target.p[2] + lever[2]];
        own.max(outside(at, self.wrist))
    }
}

/// The shortest and the longest displacement of a slide within the limits.
fn travel(d: &Affine<f64>, limits: &Limits) -> [f64; 2] {
    let mut range = [d.offset; 2];
    for &(j, k) in &d.terms {
        let [a, b] = [k * limits.low[j], k * limits.high[j]];
        range = [range[0] + a.min(b), range[1] + a.max(b)];
    }
    let [a, b] = range.map(f64::abs);
    [if range[0] * range[1] <= 0.0 { 0.0 } else { a.min(b) }, a.max(b)]
}

/// The distances that the end of a chain of pieces can have from its start.
fn shell(pieces: &[[f64; 2]]) -> [f64; 2] {
    let most: f64 = pieces.iter().map(|p| p[1]).sum();
    let least = pieces.iter().map(|p| p[0] - (most - p[1])).fold(0.0, f64::max);
    [if least.is_nan() { 0.0 } else { least }, most]
}
