//! What a search found.

use super::task::Residual;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// What a search found.
#[derive(Clone, PartialEq, Debug)]
pub struct Outcome {
    /// A solution, or else the configuration with the smallest error: radians and metres, within the limits.
    pub q: Vec<f64>,
    /// What each task misses there, in their order.
    pub residuals: Vec<Residual>,
    /// Whether it is a solution, and if not, what is known about one.
    pub status: Status,
    /// How far the target is beyond what the arm's lengths allow, metres: proof that there is no solution. With an
    /// orientation to be met, this may be the distance of the place behind the last axis.
    pub beyond_reach: Option<f64>,
    /// How many starts were given up before; starts are numbered, and the first that leads to a solution has it.
    pub restarts: usize,
    /// Steps of all descents together.
    pub iterations: usize,
    /// How many descents ended at the smallest error that was found, where there is no solution.
    pub agreeing: usize,
}

impl Outcome {
    /// True if all hard tasks are met.
    pub fn is_solved(&self) -> bool {
        self.status == Status::Solved
    }
}

/// What a search says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Status {
    /// All hard tasks are met, within the limits.
    Solved,
    /// No solution was found, and nothing says that there is none: the descents ended at different errors, or there
    /// were too few of them.
    LocalMinimum,
    /// There is no solution: proved, if the outcome says how far beyond reach the target is. Otherwise as far as starts
    /// tell: none of at least 64 led to a solution, and from at least three of them descents to the bottom ended
    /// at the same smallest error.
    Unreachable,
    /// The search was stopped before it knew.
    Stopped,
}

/// How long and how well to search.
#[derive(Clone, Debug)]
pub struct NumericOptions {
    /// What a hard task may be missed by, radians.
    pub angle: f64,
    /// What a hard task may be missed by, by the arm's size.
    pub distance: f64,
    /// Starts after the first.
    pub max_restarts: usize,
    /// Steps of all descents together.
    pub max_iterations: usize,
    /// A search looks at this before each start and ends if it is true.
    pub stop: Option<Arc<AtomicBool>>,
}

impl Default for NumericOptions {
    fn default() -> Self {
        NumericOptions { angle: 1e-9, distance: 1e-9, max_restarts: 255, max_iterations: 20_000, stop: None }
    }
}
