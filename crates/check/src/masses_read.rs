//! What is read of a document's masses and gravity, and what its words say of them: facts that verdicts rest on.

use super::formula::Formula;

/// How a document's masses and its gravity are read. Links and joints count from 0.
#[derive(Clone, PartialEq, Debug)]
pub enum ReadWith {
    /// Where the mass of a link is.
    Mass {
        /// What it is called.
        mass: Formula,
        /// Of which link.
        link: usize,
        /// Where its centre is.
        at: Whereabouts,
    },
    /// A link has its mass in one point.
    Point {
        /// Which.
        link: usize,
    },
    /// A link is a thin rod.
    Rod {
        /// Which.
        link: usize,
    },
    /// About which point an inertia is.
    Inertia {
        /// What it is called.
        inertia: Formula,
        /// Of which link.
        link: usize,
        /// Whether it is about the joint, and not about the centre of mass.
        is_at_joint: bool,
    },
    /// An inertia is that of the rotor of a joint.
    Rotor {
        /// What it is called.
        inertia: Formula,
        /// Of which joint.
        joint: usize,
    },
    /// The acceleration of gravity along the axes of the base.
    Gravity([Formula; 3]),
}

/// Where the centre of mass of a link is.
#[derive(Clone, PartialEq, Debug)]
pub enum Whereabouts {
    /// On its joint.
    Joint,
    /// Where it ends.
    End,
    /// Halfway from its joint to its end.
    Middle,
    /// So far from its joint, towards its end.
    FromJoint(Formula),
    /// So far from its end, towards its joint.
    FromEnd(Formula),
    /// At a point of the frame of its row.
    At([Formula; 3]),
}

/// What the words of a document say of masses and gravity.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Spoken {
    /// Where gravity pulls, or that the arm lies flat.
    Gravity,
    /// That the links are points or rods, or that their masses are at their ends.
    Shape,
    /// From where centres of mass are measured.
    Centres,
    /// About which points inertias are.
    Inertias,
    /// That links have inertias, which formulas leave out.
    LeftOut,
    /// Of which link a name is.
    Links,
}
