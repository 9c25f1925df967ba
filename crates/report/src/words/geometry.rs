//! What is said of axes and tables.

use denavit::description::{Agreement, Chain, Mechanism, Moved, Part};
use denavit::idealise::Measured;
use denavit::structure::{NearlySpecial, Relation};

/// What is said of axes and tables.
pub trait Geometry {
    /// How two axes lie; behind them.
    fn relation(&self, relation: Relation) -> String;

    /// What two axes nearly are, and by how much they miss it.
    fn nearly(&self, near: &NearlySpecial) -> String;

    /// What is measured between two axes.
    fn measured(&self, what: Measured) -> String;

    /// What a conversion to another convention moved.
    fn moved(&self, all: &[Moved]) -> String;

    /// How a table is the chain of a file, or of a tree of rows.
    fn agreement(&self, agreement: Agreement, of: Whole) -> String;

    /// A chain of a mechanism: its ends and joints, how its table is it, and what the file gives beside the axes.
    fn chain(&self, chain: &Chain, mechanism: &Mechanism) -> String;

    /// By how many metres the reading of decimals moves the links, in configurations that were tried.
    fn read_apart(&self, metres: f64) -> String;

    /// What a part of a description is called where it has no place in a format.
    fn left_part(&self, part: Part) -> &'static str;
}

/// What a chain is a part of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Whole {
    /// A file of bodies and joints.
    File,
    /// A tree of rows.
    Tree,
}

/// What a file gives beside the axes of a chain.
pub(super) struct Given<'a> {
    /// The links at its ends.
    pub ends: [&'a str; 2],
    /// How many joints there are, and how many of them have limits.
    pub joints: usize,
    pub limited: usize,
    /// How many links of the file have inertias, of how many.
    pub heavy: usize,
    pub links: usize,
    /// A joint that follows one beside the way.
    pub follows: Option<&'a str>,
}

impl<'a> Given<'a> {
    pub fn of(chain: &Chain, mechanism: &'a Mechanism) -> Self {
        let joints = || chain.joints.iter().map(|&j| &mechanism.joints[j]);
        Given {
            ends: [chain.from, chain.to].map(|b| mechanism.bodies[b].name.as_str()),
            joints: chain.joints.len(),
            limited: joints().filter(|j| j.limits.is_some()).count(),
            heavy: mechanism.bodies.iter().filter(|b| b.mass.is_some()).count(),
            links: mechanism.bodies.len(),
            follows: joints().find(|j| j.follows.is_some()).map(|j| j.name.as_str()),
        }
    }
}
