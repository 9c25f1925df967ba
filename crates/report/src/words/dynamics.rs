//! What is said of dynamics.

use crate::tree::{Line, Math};
use denavit::dynamics::{Gives, Ground, Minimality};
use denavit::geometry::NoBody;
use denavit_program::Count;

/// What is said of dynamics.
pub trait Dynamics {
    /// The title of a dynamic model.
    fn dynamics_title(&self, robot: &str) -> String;

    /// What the letters of the links' parameters mean; whether the table has other frames than the axes.
    fn link_parameters(&self, has_other_frames: bool) -> String;

    /// Why numbers are those of no body.
    fn no_body(&self, why: NoBody) -> &'static str;

    /// The acceleration of gravity in the base.
    fn gravity_is(&self, components: [Math; 3]) -> Line;

    /// The heading of base parameters.
    fn base_title(&self) -> String;

    /// That of so many parameters of the links, grouped, so many remain, and whether they are the fewest.
    fn base_count(&self, all: usize, base: usize, minimality: Minimality) -> String;

    /// What was asked to stand for what is grouped with it.
    fn kept(&self, all: Vec<Math>) -> Line;

    /// What was asked not to stand for anything.
    fn dropped(&self, all: Vec<Math>) -> Line;

    /// Before the base parameters that are none but themselves.
    fn base_alone(&self, all: Vec<Math>) -> Line;

    /// Before the parameters on which no torque depends.
    fn without_effect(&self, all: Vec<Math>) -> Line;

    /// The heading of the torques.
    fn torques_title(&self) -> String;

    /// What a program costs, and on what it rests that it gives Lagrange's torques.
    fn torques_cost(&self, count: &Count, ground: Ground) -> String;

    /// That the torques of velocities have the friction in them.
    fn with_friction(&self) -> String;

    /// By what a program divides: it holds where that is not 0.
    fn divides_by(&self, all: Vec<Math>) -> Line;

    /// The heading of the inertia matrix.
    fn inertia_title(&self) -> String;

    /// The heading of the torques of velocities.
    fn velocity_torques_title(&self) -> String;

    /// The heading of the torques of gravity.
    fn gravity_torques_title(&self) -> String;

    /// The heading of the bodies.
    fn bodies_title(&self) -> String;

    /// What bodies are, before the transforms between their frames.
    fn bodies(&self) -> String;

    /// Why parameters are grouped.
    fn grouping(&self) -> String;

    /// What a link, from 1, gives to the one before.
    fn gives(&self, link: usize, gives: Gives) -> String;

    /// The heading of the recursion from the base to the tool.
    fn outward_title(&self) -> String;

    /// What it computes, and by which equations.
    fn outward(&self) -> String;

    /// The heading of a link, from 1.
    fn link(&self, link: usize) -> String;

    /// That a link of a tree moves with a joint, on another link or on the root.
    fn link_of_tree(&self, link: usize, joint: &str, parent: Option<usize>) -> String;

    /// On what it rests that velocities and accelerations of a link are these.
    fn motion_ground(&self, ground: Ground) -> String;

    /// The heading of the recursion back to the base.
    fn inward_title(&self) -> String;

    /// What it computes, and by which equations.
    fn inward(&self) -> String;

    /// What the recursion costs, and on what it rests that it gives Lagrange's torques.
    fn recursion_cost(&self, count: &Count, ground: Ground) -> String {
        self.torques_cost(count, ground)
    }

    /// The heading of the short program.
    fn short_title(&self) -> String;

    /// How the short program comes from the recursion.
    fn short(&self) -> String;
}
