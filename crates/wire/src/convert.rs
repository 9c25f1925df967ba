//! What `convert` wrote, and how it is the robot.

use crate::Schema;
use serde::Serialize;

/// A robot in another format.
#[derive(Serialize)]
pub struct Converted<'a> {
    /// How many chains of what was written were compared with those of the robot.
    pub chains: usize,
    /// By how much poses of chains that are not proved the same differ at most (directions, and metres); null where there are none.
    pub difference: Option<f64>,
    /// What of the robot has no place in the format.
    pub left_out: Vec<&'static str>,
    /// How many more chains were not compared, as what was written does not read back or parameters have no values.
    pub not_compared: usize,
    /// How many of the chains that were compared have other joints.
    pub others: usize,
    /// How many chains are proved to be the same.
    pub proved: usize,
    /// The robot's name.
    pub robot: &'a str,
    /// The version of these names.
    pub schema: Schema,
    /// What was written.
    pub text: &'a str,
}
