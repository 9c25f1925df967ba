//! Places that a frame cannot come to, whatever the joints do.
//!
//! Between the axes of its joints an arm is rigid. The origin of a frame lies at the end of a chain of such pieces that
//! starts on the first axis; it is no further from there than they are long together, and no nearer than the longest is
//! longer than the others together.

use super::limits::Limits;
use super::task::{Frame, Place, dot, sub};
use crate::geometry::Transform;
use crate::robot::Robot;

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
        let rows = match frame {
            Frame::Tool => robot.links.len(),
            Frame::Link(i) => i.min(robot.links.len()),
        };
        let still = vec![0.0; robot.joints];
        let mut x = robot.base;
        let mut centre = None;
        let mut pieces: Vec<[f64; 2]> = vec![];
        let mut end = |x: &mut Transform<f64>, pieces: &mut Vec<[f64; 2]>| {
            match centre {
                None => centre = Some(x.translation.0),
                Some(_) => pieces.push([x.translation.norm(); 2]),
            }
            *x = Transform::identity();
        };
        for link in &robot.links[..rows] {
            let turns = !link.theta.terms.is_empty();
            let slides = !link.d.terms.is_empty();
            if !turns && !slides {
                x = x * link.transform(&still);
                continue;
            }
            // Rz(θ)·Tz(d) = Tz(d)·Rz(θ): a constant d belongs to what is before the axis.
            x = x * link.before;
            if !slides {
                x = x * Transform::translation_z(link.d.offset);
            }
            end(&mut x, &mut pieces);
            if slides {
                let mut range = [link.d.offset; 2];
                for &(j, k) in &link.d.terms {
                    let [a, b] = [k * limits.low[j], k * limits.high[j]];
                    range = [range[0] + a.min(b), range[1] + a.max(b)];
                }
                let longest = range[0].abs().max(range[1].abs());
                let shortest =
                    if range[0] * range[1] <= 0.0 { 0.0 } else { range[0].abs().min(range[1].abs()) };
                pieces.push([shortest, longest]);
            }
            x = link.after;
        }
        if frame == Frame::Tool {
            x = x * robot.tool;
        }
        let behind = x.inverse().translation.0;
        let length = x.translation.norm();
        match centre {
            // Nothing moves.
            None => Reach { centre: x.translation.0, behind: [0.0; 3], wrist: [0.0; 2], frame: [0.0; 2] },
            Some(centre) => {
                let wrist = shell(&pieces);
                pieces.push([length; 2]);
                Reach { centre, behind, wrist, frame: shell(&pieces) }
            }
        }
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

/// The distances that the end of a chain of pieces can have from its start.
fn shell(pieces: &[[f64; 2]]) -> [f64; 2] {
    let most: f64 = pieces.iter().map(|p| p[1]).sum();
    let least = pieces.iter().map(|p| p[0] - (most - p[1])).fold(0.0, f64::max);
    [if least.is_nan() { 0.0 } else { least }, most]
}
