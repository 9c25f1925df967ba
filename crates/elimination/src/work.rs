//! The memory that the solver works in.

use crate::{
    candidate::{Candidate, Found},
    certificate::Marks,
    eliminate::Eliminated,
    fourier::Trigonometric,
    roots::Roots,
    wide::Wide,
};

/// What is found at a pose, and what it is found from; used again at the next one.
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
