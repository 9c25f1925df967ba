//! What is said of axes and tables.

use denavit::description::Moved;
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
}
