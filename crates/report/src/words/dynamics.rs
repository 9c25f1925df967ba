//! What is said of dynamics.

use crate::tree::{Line, Math};
use denavit::dynamics::{Ground, Minimality};
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
}
