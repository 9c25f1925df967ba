//! What was computed over the rows of a file.

use crate::Schema;
use serde::Serialize;

/// A file that was mapped.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Mapped<'a> {
    /// Rows with more solutions than places for them.
    pub more_solutions: u64,
    /// Rows whose pose is none.
    pub no_pose: u64,
    /// Rows with what is no finite number among their inputs.
    pub not_finite: u64,
    /// Rows with a null among their inputs.
    pub nulls: u64,
    /// What was written.
    pub output: &'a str,
    /// In how many parts.
    pub parts: usize,
    /// How many of them were there already.
    pub resumed: usize,
    /// The robot.
    pub robot: &'a str,
    /// How many rows there are.
    pub rows: u64,
    /// The version.
    pub schema: Schema,
}
