//! What is met on the way.

use crate::velocity::Place;
use denavit_symbolic::Expr;

/// Something on the way, at a parameter of the path.
#[derive(Clone, PartialEq, Debug)]
pub struct Event {
    /// Where.
    pub s: f64,
    /// The configuration there.
    pub q: Vec<f64>,
    /// What.
    pub kind: EventKind,
}

/// What can be met.
#[derive(Clone, PartialEq, Debug)]
pub enum EventKind {
    /// A singular configuration is passed or touched.
    Singular {
        /// The factor of the determinant that is 0, if it is one of those that are known.
        factor: Option<Expr>,
        /// How the axes lie.
        place: Option<Place>,
        /// Whether the factor changes its sign; otherwise it is touched, or nearly.
        crossed: bool,
    },
    /// A joint leaves its limits.
    Limit {
        /// The joint, from 0.
        joint: usize,
        /// The limit.
        limit: f64,
    },
    /// From here on the joints enter their limits again.
    WithinLimits {
        /// The joint, from 0.
        joint: usize,
    },
    /// The branch ends: behind this there is no solution near the last one.
    End {
        /// Whether the hand can be there at all, on another branch.
        reachable: bool,
        /// The factor of the determinant that is 0 here, if it is one of those that are known.
        factor: Option<Expr>,
        /// How the axes lie.
        place: Option<Place>,
    },
}

impl EventKind {
    /// True if the path cannot be followed beyond.
    pub fn is_end(&self) -> bool {
        matches!(self, EventKind::End { .. })
    }
}
