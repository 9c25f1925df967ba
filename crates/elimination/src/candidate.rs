//! What may be a configuration of the arm at the pose, and what is one.

use crate::{
    arm::{Arm, Joint},
    extract::UNKNOWNS,
    lanes::Lanes,
    remaining::Value,
};

/// Largest distance to the pose that is accepted.
pub(crate) const ACCEPTED: f64 = 1e-10;
/// Configurations closer than this are one.
const SAME: f64 = 1e-6;

/// A value of the hidden joint with a null vector.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub hidden: [f64; 2],
    pub x: [f64; UNKNOWNS],
}

/// An accepted configuration: cosines and sines, or slides (scaled) and zeros, in the arm's order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub values: [[f64; 2]; 6],
    pub residual: f64,
}

/// Eight records as lanes; where there are fewer, the last one fills up.
#[inline(always)]
pub(crate) fn gather<T, const N: usize>(records: &[T], get: impl Fn(&T) -> [f64; N]) -> [Lanes; N] {
    let mut out = [Lanes::ZERO; N];
    for l in 0..8 {
        let Some(record) = records.get(l).or(records.last()) else { break };
        let numbers = get(record);
        for (lanes, x) in out.iter_mut().zip(numbers) {
            lanes.0[l] = x;
        }
    }
    out
}

/// One lane of the values of all joints.
#[inline]
pub(crate) fn lane(values: &[Value; 6], l: usize) -> [[f64; 2]; 6] {
    let mut out = [[0.0; 2]; 6];
    for (out, value) in out.iter_mut().zip(values) {
        *out = [value[0].0[l], value[1].0[l]];
    }
    out
}

/// Adds a configuration unless it is there.
pub(crate) fn add(arm: &Arm, found: &mut Vec<Found>, new: Found) {
    for known in found.iter_mut() {
        let mut apart = 0.0f64;
        for i in 0..6 {
            let (a, b) = (known.values[i], new.values[i]);
            let scale = match arm.joints[i] {
                Joint::Revolute => 1.0,
                Joint::Prismatic => 1.0 + a[0].abs(),
            };
            let away = ((a[0] - b[0]).abs() + (a[1] - b[1]).abs()) / scale;
            apart = if away > apart { away } else { apart };
        }
        if apart < SAME {
            return;
        }
    }
    found.push(new);
}
