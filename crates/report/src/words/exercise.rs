//! What stands on exercise sheets.

use crate::tree::{Line, Math};
use denavit::description::Convention;
use std::str::FromStr;

/// What an exercise is about.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ExerciseKind {
    /// The link transforms, the pose of the tool, and the pose in numbers.
    Forward,
    /// The Denavit–Hartenberg table of a drawing.
    Table,
    /// All configurations for a pose.
    Inverse,
    /// The Jacobian, as a formula and in numbers.
    Jacobian,
    /// Where the arm is singular.
    Singularities,
    /// The link transforms alone.
    Transforms,
    /// All configurations for a position of the hand.
    Position,
    /// The torques of the joints for a force at the hand.
    Statics,
    /// The equations of motion of an arm with masses.
    Torques,
    /// The timing of a motion between two configurations.
    Path,
}

impl ExerciseKind {
    /// All of them.
    pub const ALL: [ExerciseKind; 10] = [
        ExerciseKind::Forward,
        ExerciseKind::Table,
        ExerciseKind::Inverse,
        ExerciseKind::Jacobian,
        ExerciseKind::Singularities,
        ExerciseKind::Transforms,
        ExerciseKind::Position,
        ExerciseKind::Statics,
        ExerciseKind::Torques,
        ExerciseKind::Path,
    ];

    /// Its name: `fk`, `dh`, `ik`, `jacobian`, `singularities`, `transforms`, `position`, `statics`, `torques`, `path`.
    pub fn name(self) -> &'static str {
        match self {
            ExerciseKind::Forward => "fk",
            ExerciseKind::Table => "dh",
            ExerciseKind::Inverse => "ik",
            ExerciseKind::Jacobian => "jacobian",
            ExerciseKind::Singularities => "singularities",
            ExerciseKind::Transforms => "transforms",
            ExerciseKind::Position => "position",
            ExerciseKind::Statics => "statics",
            ExerciseKind::Torques => "torques",
            ExerciseKind::Path => "path",
        }
    }
}

impl FromStr for ExerciseKind {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let names = || ExerciseKind::ALL.map(ExerciseKind::name).join(", ");
        ExerciseKind::ALL
            .into_iter()
            .find(|kind| kind.name() == name)
            .ok_or_else(|| format!("there are no exercises of the kind `{name}`: {}", names()))
    }
}

/// What stands on exercise sheets.
pub trait Exercise {
    /// The title of a sheet.
    fn exercise_title(&self, kind: ExerciseKind, robot: &str) -> String;

    /// The title of its solution.
    fn solution_title(&self, kind: ExerciseKind, robot: &str) -> String;

    /// Which sheet of its kind it is.
    fn seed(&self, seed: u64) -> String;

    /// The heading of what is asked.
    fn tasks(&self) -> String;

    /// What a task is worth, in brackets.
    fn points(&self, points: u32) -> String;

    /// The heading of a configuration.
    fn configuration_title(&self, number: usize) -> String;

    /// The heading of a pose.
    fn given_pose_title(&self, number: usize) -> String;

    /// The heading of what solves a pose.
    fn solved_pose_title(&self, number: usize) -> String;

    /// The pose of the tool as a formula, as a heading.
    fn pose_title(&self) -> String;

    /// The pose of the tool in numbers, as a heading.
    fn numbers_title(&self) -> String;

    /// To give the link transforms.
    fn ask_links(&self) -> String;

    /// To give the pose of the tool.
    fn ask_pose(&self) -> String;

    /// To give it in numbers at so many configurations.
    fn ask_numbers(&self, count: usize) -> String;

    /// To give the table in a convention.
    fn ask_table(&self, convention: Convention) -> String;

    /// The heading of how the axes lie.
    fn axes_title(&self) -> String;

    /// Before the axes at a configuration.
    fn axes_lie(&self, configuration: Line) -> Line;

    /// The caption of the axes.
    fn axes_caption(&self) -> String;

    /// A point on an axis, as the heading of a column.
    fn point(&self) -> String;

    /// The direction of an axis, as the heading of a column.
    fn direction(&self) -> String;

    /// Before the pose of the tool there.
    fn tool_there(&self) -> String;

    /// All configurations, as a heading.
    fn configurations_title(&self) -> String;

    /// All configurations for a position, as a heading.
    fn positions_title(&self) -> String;

    /// To give all configurations for so many poses.
    fn ask_configurations(&self, count: usize) -> String;

    /// The heading of formulas.
    fn formulas_title(&self) -> String;

    /// Before the joints of a solution.
    fn numbered_solution(&self, number: usize) -> String;

    /// The Jacobian, as a heading.
    fn jacobian_formula(&self) -> String;

    /// To give the Jacobian as a formula and in numbers.
    fn ask_jacobian(&self) -> String;

    /// Before velocities of the joints.
    fn rates_given(&self) -> String;

    /// The velocity of the tool, as a heading.
    fn velocity_title(&self) -> String;

    /// To give the velocity of the tool at the first configuration.
    fn ask_velocity(&self) -> String;

    /// To give the determinant of the Jacobian.
    fn ask_determinant(&self) -> String;

    /// To say where the arm is singular.
    fn ask_singular(&self) -> String;

    /// That the arm is singular where something is so.
    fn singular_where(&self, condition: Math) -> Line;

    /// The coefficients of polynomials, as a heading.
    fn coefficients(&self) -> String;

    /// Of a pose with this title: the number N of configurations, and that with the largest first joint.
    fn largest_of(&self, title: &str) -> String;

    /// What an arm is called that is made up, by the letters of its joints.
    fn made_up_arm(&self, joints: &str, seed: u64) -> String;

    /// To give the link transforms as formulas and in numbers.
    fn ask_transforms(&self) -> String;

    /// To give all configurations for so many positions.
    fn ask_positions(&self, count: usize) -> String;

    /// The heading of a position.
    fn given_position_title(&self, number: usize) -> String;

    /// The heading of what solves a position.
    fn solved_position_title(&self, number: usize) -> String;

    /// Before the coordinates of the hand's position.
    fn position_given(&self) -> String;

    /// The torques as formulas, as a heading.
    fn torque_formulas_title(&self) -> String;

    /// The torques in numbers, as a heading.
    fn torque_numbers_title(&self) -> String;

    /// To give the torques for a force with these components.
    fn ask_statics(&self, force: Vec<Math>) -> Line;

    /// To give the torques in numbers at so many configurations.
    fn ask_torque_numbers(&self, count: usize) -> String;

    /// Before the components of the force in numbers.
    fn force_given(&self) -> String;

    /// That the torques come from the Jacobian of velocities.
    fn statics_step(&self) -> String;

    /// What masses the arm has: one at the end of each link.
    fn point_masses(&self) -> String;

    /// The direction of gravity, before its components.
    fn gravity_in_base(&self, components: [Math; 3]) -> Line;

    /// The parts of the equations of motion, as a heading.
    fn motion_parts_title(&self) -> String;

    /// To give inertia matrix, velocity torques and gravity torques.
    fn ask_motion_parts(&self) -> String;

    /// To give the torques of the joints from rates and accelerations.
    fn ask_motion(&self) -> String;

    /// Before the inertia matrix.
    fn inertia_step(&self) -> String;

    /// Before the velocity torques.
    fn velocity_torques_step(&self) -> String;

    /// Before the torques of gravity.
    fn gravity_step(&self) -> String;

    /// That the sum of the parts is the torque.
    fn motion_step(&self) -> String;

    /// Before accelerations of the joints.
    fn accelerations_given(&self) -> String;

    /// The heading of where a motion begins and ends.
    fn motion_title(&self) -> String;

    /// Where it begins.
    fn motion_begins(&self, configuration: Line) -> Line;

    /// Where it ends.
    fn motion_ends(&self, configuration: Line) -> Line;

    /// The cubic polynomials, as a heading.
    fn cubic_title(&self) -> String;

    /// To give the cubic polynomials for a duration, seconds.
    fn ask_cubic(&self, seconds: Math) -> Line;

    /// How a cubic polynomial follows.
    fn cubic_step(&self, formula: Math) -> Line;

    /// The greatest speeds, as a heading.
    fn peaks_title(&self) -> String;

    /// To give the greatest speed of each joint.
    fn ask_peaks(&self, names: Vec<Math>) -> Line;

    /// How it follows.
    fn peaks_step(&self, formula: Math) -> Line;

    /// The times of the fastest motion, as a heading.
    fn trapezoid_title(&self) -> String;

    /// To give the shortest time of each joint, and of all together.
    fn ask_trapezoid(&self, names: Vec<Math>, whole: Math) -> Line;

    /// Before the limits of a joint.
    fn joint_limits(&self, joint: Math, speed: &str, acceleration: &str) -> Line;

    /// A joint that reaches its speed, with its time.
    fn trapezoid_step(&self, joint: Math, formula: Math) -> Line;

    /// A joint that does not reach its speed, with its time.
    fn triangle_step(&self, joint: Math, formula: Math) -> Line;

    /// That the slowest joint says the time of all.
    fn slowest_step(&self, whole: Math) -> Line;
}
