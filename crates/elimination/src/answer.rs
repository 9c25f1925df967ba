//! What the solver returns, and the memory that it works in.

use crate::{
    certificate::Marks, eliminate::Eliminated, extract::UNKNOWNS, fourier::Trigonometric, lanes::Lanes,
    remaining::Value, roots::Roots, wide::Wide,
};

/// One configuration of the arm at the pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Joint values: angles in (−π, π] (rad), slides in the arm's unit.
    pub q: [f64; 6],
    /// Distance of its pose from the one asked for: shift divided by the arm's size, and turn (rad), as one length.
    pub residual: f64,
    /// The smallest singular value of the geometric Jacobian there, lengths divided by the arm's size.
    pub singular: f64,
    /// 2 where two configurations meet, else 1.
    pub multiplicity: u32,
}

/// What is known about the completeness of an answer. Numerical: error bounds hold for the noise that was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Certificate {
    /// All configurations are found, each of them isolated.
    Complete,
    /// Two configurations meet, or are about to, or miss each other by less than rounding tells; or the arm can move
    /// without moving its tool.
    NearDoubleRoot,
    /// There may be more configurations.
    #[default]
    Undecided,
}

/// All configurations at a pose, and memory that is used again at the next one.
#[derive(Clone, Debug, Default)]
pub struct Answer {
    /// The configurations, in the order in which they were found.
    pub solutions: Vec<Solution>,
    /// Whether these are all.
    pub certificate: Certificate,
    /// How many splits of the loop were solved; one counts again if its wider matrix was needed.
    pub splits: u32,
    /// Working memory.
    pub(crate) work: Work,
}

/// Working memory of the solver.
#[derive(Clone, Debug, Default)]
pub(crate) struct Work {
    pub eliminated: Eliminated,
    pub polynomial: Trigonometric,
    pub roots: Roots<2>,
    pub wide: Roots<3>,
    pub matrix: Wide,
    /// Charts and candidates of the last way to solve.
    pub effort: usize,
    pub marks: Marks,
    pub candidates: Vec<Candidate>,
    pub found: Vec<Found>,
}

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
#[inline(always)]
pub(crate) fn lane(values: &[Value; 6], l: usize) -> [[f64; 2]; 6] {
    let mut out = [[0.0; 2]; 6];
    for (out, value) in out.iter_mut().zip(values) {
        *out = [value[0].0[l], value[1].0[l]];
    }
    out
}
