//! What the solver returns.

use crate::work::Work;

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
