//! A mechanism as a tree: bodies, and joints about axes between them, as robot descriptions such as URDF have it.
//!
//! `origin` is the joint's frame in its parent body at rest, and the child body's frame at that; the axis stands in it. A serial
//! chain through the tree is a [`Description`] like any other ([`Mechanism::chain`]).

mod chain;
mod compared;
mod holds;
mod limits;
mod masses;
mod of;
mod poses;
mod program;
mod written;

pub use chain::{Chain, NoChain};
pub(super) use chain::{moved, rest, turned};
pub use compared::{Alikeness, Likeness};
pub use holds::{Hold, Keeps};
pub use masses::Unweighed;
pub use poses::Placing;
pub(super) use written::{Solids, joint_names};

use super::JointKind;
use crate::geometry::{Transform, Vector};
use denavit_symbolic::{Expr, Rational};

/// A tree of bodies.
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// What people call it.
    pub name: String,
    /// The bodies.
    pub bodies: Vec<Body>,
    /// The joints: the joint to a body stands before those behind it.
    pub joints: Vec<Joint>,
    /// The body that the tree hangs on.
    pub root: usize,
    /// Configurations with names: values of the [variables](Mechanism::variables).
    pub poses: Vec<(String, Vec<Expr>)>,
    /// The acceleration of gravity in the root's frame, m/s², if it is given.
    pub gravity: Option<[Expr; 3]>,
    /// Closed loops. Chains through the tree are taken as if they were not there: [`Linkage::of_mechanism`](super::Linkage::of_mechanism)
    /// is the tree with them.
    pub holds: Vec<Hold>,
    /// The joints that are said to be driven.
    pub driven: Vec<usize>,
}

/// A body and its frame.
#[derive(Clone, Debug)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Its mass, if it is given.
    pub mass: Option<Mass>,
    /// True if it weighs something of which the mass is not known.
    pub is_unweighed: bool,
    /// What it looks like: it says nothing of how it moves.
    pub looks: Vec<Look>,
}

/// A part of what a body looks like, in doubles.
#[derive(Clone, PartialEq, Debug)]
pub struct Look {
    /// Its shape.
    pub shape: Shape,
    /// Where it stands in the body's frame.
    pub origin: Transform<f64>,
    /// Red, green, blue and how opaque, from 0 to 1, if it is given.
    pub colour: Option<[f64; 4]>,
}

/// A shape about its own origin.
#[derive(Clone, PartialEq, Debug)]
pub enum Shape {
    /// A box: its edges along x, y and z, metres.
    Box([f64; 3]),
    /// A cylinder about z, metres.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Its length.
        length: f64,
    },
    /// A cylinder about z with half a ball at each end, metres.
    Capsule {
        /// Its radius.
        radius: f64,
        /// The length of the cylinder.
        length: f64,
    },
    /// An ellipsoid: half its axes along x, y and z, metres.
    Ellipsoid([f64; 3]),
    /// A ball.
    Sphere {
        /// Its radius, metres.
        radius: f64,
    },
    /// What stands in another file.
    Mesh {
        /// The file as it is named: by a path, or in a package.
        file: String,
        /// What its lengths are multiplied by, along x, y and z.
        scale: [f64; 3],
    },
}

/// How a body's mass is distributed.
#[derive(Clone, Debug)]
pub struct Mass {
    /// kg
    pub mass: Expr,
    /// The centre of mass in the body's frame, metres.
    pub com: [Expr; 3],
    /// The inertia about the centre of mass, along the axes of the body's frame, xx xy xz yy yz zz, kg·m².
    pub inertia: [Expr; 6],
}

/// A joint between two bodies.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// How it moves; nothing for one that is fixed.
    pub kind: Option<JointKind>,
    /// The body that it stands on.
    pub parent: usize,
    /// The body that it moves.
    pub child: usize,
    /// Its frame in that of the parent.
    pub origin: Transform<Expr>,
    /// Its axis in its frame, of any length.
    pub axis: Vector<Expr>,
    /// The lowest and the highest value, radians or metres.
    pub limits: Option<[Expr; 2]>,
    /// The highest speed.
    pub velocity: Option<Expr>,
    /// The highest torque or force.
    pub effort: Option<Expr>,
    /// What is known of its drive.
    pub drive: JointDrive,
    /// What it follows, if it does not move by itself.
    pub follows: Option<Follows>,
}

/// What is known of a joint's drive.
#[derive(Clone, Copy, Default, PartialEq, Debug)]
pub struct JointDrive {
    /// The inertia of its rotor as the joint feels it, kg·m² (kg for a slide).
    pub rotor: Option<Expr>,
    /// Its viscous friction, N·m·s/rad (N·s/m for a slide).
    pub viscous: Option<Expr>,
    /// Its friction of Coulomb, N·m (N for a slide).
    pub coulomb: Option<Expr>,
}

impl JointDrive {
    /// What drives are together that a value moves, each so many times as fast: inertia and viscous friction as the square of that,
    /// friction of Coulomb as its size.
    pub(in crate::description) fn together<'d>(
        all: impl Iterator<Item = (&'d JointDrive, &'d Rational)>,
    ) -> Self {
        let add = |sum: &mut Option<Expr>, e: Option<Expr>, factor: Rational| {
            let Some(e) = e else { return };
            let e = if factor.is_one() { e } else { Expr::from(factor) * e };
            *sum = Some(sum.map_or(e, |s| s + e));
        };
        let mut sum = JointDrive::default();
        for (drive, ratio) in all {
            let square = ratio * ratio;
            add(&mut sum.rotor, drive.rotor, square.clone());
            add(&mut sum.viscous, drive.viscous, square);
            add(&mut sum.coulomb, drive.coulomb, ratio.abs());
        }
        sum
    }
}

/// A joint that moves as another does.
#[derive(Clone, PartialEq, Debug)]
pub struct Follows {
    /// The other, which moves by itself.
    pub joint: usize,
    /// What its value is multiplied by.
    pub factor: Rational,
    /// What is added.
    pub offset: Expr,
}

impl Mechanism {
    /// The joints that move by themselves, in order: their values are the variables of the mechanism.
    pub fn variables(&self) -> Vec<usize> {
        let moves = |&j: &usize| self.joints[j].kind.is_some() && self.joints[j].follows.is_none();
        (0..self.joints.len()).filter(moves).collect()
    }

    /// The value of a joint where the variables have these; 0 for one that does not move.
    pub fn value(&self, joint: usize, values: &[Expr]) -> Expr {
        self.value_of(joint, &self.variables(), values)
    }

    /// The same, where these are the variables.
    fn value_of(&self, joint: usize, variables: &[usize], values: &[Expr]) -> Expr {
        // Variables stand in the order of the joints.
        let of = |j: usize| variables.binary_search(&j).map_or(Expr::int(0), |v| values[v]);
        match &self.joints[joint].follows {
            Some(follows) => Expr::from(follows.factor.clone()) * of(follows.joint) + follows.offset,
            None => of(joint),
        }
    }

    /// The body with a name.
    pub fn body(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|b| b.name == name)
    }

    /// The joint that moves a body; none for the root.
    pub fn joint_to(&self, body: usize) -> Option<usize> {
        self.joints.iter().position(|j| j.child == body)
    }

    /// The joint that moves each body; none for the root.
    fn joints_to(&self) -> Vec<Option<usize>> {
        let mut to = vec![None; self.bodies.len()];
        for (j, joint) in self.joints.iter().enumerate() {
            to[joint.child] = Some(j);
        }
        to
    }

    /// The bodies on which nothing stands.
    pub fn leaves(&self) -> Vec<usize> {
        let mut is_leaf = vec![true; self.bodies.len()];
        self.joints.iter().for_each(|j| is_leaf[j.parent] = false);
        (0..self.bodies.len()).filter(|&b| is_leaf[b]).collect()
    }
}
