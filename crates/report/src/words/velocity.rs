//! What is said of Jacobians and singularities.

use crate::tree::{Line, Math};
use denavit::forward::{Proof, Reference};
use denavit::velocity::{Blocks, Obstacle, Place, Still};
use denavit_program::Count;
use denavit_symbolic::Refusal;

/// What is lost at a singularity.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Loss {
    /// The velocity along an axis of a frame.
    VelocityAlong(char, Reference),
    /// The rotation about an axis of a frame.
    RotationAbout(char, Reference),
    /// A velocity of the point, in one direction.
    Velocity,
    /// A rotation, about one direction.
    Rotation,
    /// A velocity and a rotation together.
    Screw,
}

/// What comes free at a singularity. Joints are counted from 0.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Gain {
    /// Two joints turn while the body stands still, in the same direction or against each other.
    Turns {
        /// The joints.
        joints: [usize; 2],
        /// Whether they turn in the same direction.
        is_same: bool,
    },
    /// Joints move at first with the body, or its point, at rest.
    Moves(Vec<usize>, Still),
}

/// What is said of Jacobians and singularities.
pub trait Velocity {
    /// The title of a Jacobian.
    fn jacobian_title(&self, robot: &str) -> String;

    /// Which point of which body moves, where it is (a displacement from an origin, if it is not there), along whose axes.
    fn viewpoint(&self, body: Reference, at: Reference, offset: Option<[Math; 3]>, axes: Reference) -> Line;

    /// Why the entries of a Jacobian are not there.
    fn no_entries(&self, why: Refusal) -> String;

    /// What a program costs, and whether its Jacobian is proved.
    fn jacobian_cost(&self, count: &Count, proof: Proof) -> String;

    /// That the matrix is shortest as it is shown.
    fn shortest(&self) -> String;

    /// The heading of the matrix where it is shortest, behind the one in the base.
    fn shortest_title(&self) -> String;

    /// The heading of determinants.
    fn determinant_title(&self) -> String;

    /// Why there are several determinants: the arm has more joints than directions, of which so many are asked for, or fewer.
    fn several_determinants(&self, has_surplus: bool, directions: usize) -> String;

    /// Before the determinant with some joints (from 0).
    fn minor_of_joints(&self, joints: &[usize]) -> String;

    /// That the rank is never more than this, of a hand or of its point alone, and what the determinants are that follow.
    fn always_singular(&self, rank: usize, is_point: bool) -> String;

    /// Before the determinant of some rows and joints (from 0).
    fn minor_of_both(&self, rows: &[&str], joints: &[usize]) -> String;

    /// Before the determinant of some rows.
    fn minor_of_rows(&self, rows: &[&str]) -> String;

    /// The heading of singularities.
    fn singularities_title(&self) -> String;

    /// That there are no singularities, by one determinant or by several, or none that all determinants share.
    fn no_singularity(&self, is_complete: bool, several: bool) -> String;

    /// That all determinants may be 0 at once besides.
    fn besides(&self) -> String;

    /// Before lists of what is 0 at once where all determinants are 0, too, and nowhere else.
    fn besides_where(&self) -> String;

    /// The heading of what is said of the body's origin alone.
    fn point_title(&self) -> String;

    /// Which point, along which axes, and that its three rows are looked at without the body's orientation.
    fn point_alone(&self, at: Reference, axes: Reference) -> Line;

    /// Where a factor is 0.
    fn zeros(&self, all: Vec<Math>) -> Line;

    /// That a factor was found 0 alone nowhere; with lengths that are assumed where the arm has none.
    fn no_example(&self, assumes: bool) -> String;

    /// How the axes lie at a singular configuration.
    fn place(&self, place: &Place) -> String;

    /// What is lost.
    fn lost(&self, loss: Loss) -> String;

    /// What comes free.
    fn gained(&self, gain: &Gain) -> String;

    /// The heading of joint velocities.
    fn rates_title(&self) -> String;

    /// How joint velocities follow from the blocks of the Jacobian.
    fn rates(&self, blocks: Blocks) -> String;

    /// What must not be 0.
    fn different(&self, all: Vec<Math>) -> Line;

    /// Why the singularities are not known as formulas.
    fn unknown_singularities(&self, why: &Obstacle) -> String;

    /// Before so many singular configurations that were found in numbers.
    fn found_singularities(&self, count: usize) -> String;
    /// Why nothing was looked for in numbers: these parameters have no value.
    fn values_missing(&self, parameters: Vec<Math>) -> Line;

    /// Velocities of the joints that leave the body, or its point, at rest.
    fn motion(&self, all: Vec<Math>) -> Line;
}
