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
}

impl ExerciseKind {
    /// All of them.
    pub const ALL: [ExerciseKind; 5] = [
        ExerciseKind::Forward,
        ExerciseKind::Table,
        ExerciseKind::Inverse,
        ExerciseKind::Jacobian,
        ExerciseKind::Singularities,
    ];

    /// Its name: `fk`, `dh`, `ik`, `jacobian`, `singularities`.
    pub fn name(self) -> &'static str {
        match self {
            ExerciseKind::Forward => "fk",
            ExerciseKind::Table => "dh",
            ExerciseKind::Inverse => "ik",
            ExerciseKind::Jacobian => "jacobian",
            ExerciseKind::Singularities => "singularities",
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
}
