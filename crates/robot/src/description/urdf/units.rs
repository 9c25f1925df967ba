//! Files that look as if they were in degrees or millimetres: the format knows radians and metres only.

use super::joints::Draft;
use crate::description::JointKind;
use crate::description::reader::Reader;
use std::f64::consts::TAU;
use std::ops::Range;

/// Limits of a revolute joint beyond this, radians, are four turns each way.
const TURNS: f64 = 4.0 * TAU;
/// Links longer than this, metres, are those of no arm.
const LONG: f64 = 50.0;

impl Reader {
    /// Warns once of each quantity that is far beyond those of arms.
    pub(super) fn say_units(&mut self, drafts: &[Draft]) {
        let size = |e: &denavit_symbolic::Expr| e.eval(|_| None).map_or(0.0, f64::abs);
        let mut limits: Vec<(f64, Range<usize>)> = vec![];
        let mut lengths: Vec<(f64, Range<usize>)> = vec![];
        for draft in drafts {
            let joint = &draft.joint;
            if let (Some(JointKind::Revolute), Some(ends)) = (joint.kind, &joint.limits) {
                limits.push((size(&ends[0]).max(size(&ends[1])), draft.span.clone()));
            }
            let p = joint.origin.translation;
            lengths.push(([0, 1, 2].iter().map(|&i| size(&p[i])).fold(0.0, f64::max), draft.span.clone()));
        }
        let first = |found: Vec<(f64, Range<usize>)>, least: f64| {
            let mut far = found.into_iter().filter(|f| f.0 > least);
            let first = far.next()?;
            Some((first, far.count() + 1))
        };
        if let Some(((x, span), count)) = first(limits, TURNS) {
            let message = format!("a limit of {x} rad is {:.0} turns{}", x / TAU, others(count));
            self.out.warning(span, message).hint("limits of a URDF are in radians");
        }
        if let Some(((x, span), count)) = first(lengths, LONG) {
            let message = format!("this joint is {x} m from the one before{}", others(count));
            self.out.warning(span, message).hint("lengths of a URDF are in metres");
        }
        let far = std::mem::take(&mut self.far_angles);
        if let Some(span) = far.first() {
            let message = format!("roll, pitch or yaw of more than a turn{}", others(far.len()));
            self.out.warning(span.clone(), message).hint("angles of a URDF are in radians");
        }
    }
}

/// How many more there are like the one that is shown.
fn others(count: usize) -> String {
    if count > 1 { format!(" (and {} more like it)", count - 1) } else { String::new() }
}
