//! Exercise sheets.

use super::{English, counted};
use crate::tree::{Line, Math};
use crate::words::{Exercise, ExerciseKind};
use denavit::description::Convention;

/// What an exercise is about.
fn subject(kind: ExerciseKind) -> &'static str {
    match kind {
        ExerciseKind::Forward => "forward kinematics",
        ExerciseKind::Table => "Denavit–Hartenberg table",
        ExerciseKind::Inverse => "inverse kinematics",
        ExerciseKind::Jacobian => "Jacobian",
        ExerciseKind::Singularities => "singularities",
    }
}

impl Exercise for English {
    fn exercise_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Exercise: {} of the {robot}", subject(kind))
    }

    fn solution_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Solution: {} of the {robot}", subject(kind))
    }

    fn seed(&self, seed: u64) -> String {
        format!("Sheet number {seed}.")
    }

    fn tasks(&self) -> String {
        "Tasks".into()
    }

    fn points(&self, points: u32) -> String {
        format!("({})", counted(points as usize, "point", "points"))
    }

    fn configuration_title(&self, number: usize) -> String {
        format!("Configuration {number}")
    }

    fn given_pose_title(&self, number: usize) -> String {
        format!("Pose {number}")
    }

    fn solved_pose_title(&self, number: usize) -> String {
        format!("Inverse kinematics for pose {number}")
    }

    fn pose_title(&self) -> String {
        "The pose of the tool".into()
    }

    fn numbers_title(&self) -> String {
        "The pose in numbers".into()
    }

    fn ask_links(&self) -> String {
        "Give the transform of each link, A1, A2, … .".into()
    }

    fn ask_pose(&self) -> String {
        "Give the pose of the tool in the base as a formula, simplified.".into()
    }

    fn ask_numbers(&self, count: usize) -> String {
        let where_ = if count == 1 { "at the configuration" } else { "at each of the configurations" };
        format!("Give the pose T of the tool in numbers {where_} below, to four decimals.")
    }

    fn ask_table(&self, convention: Convention) -> String {
        format!(
            "Give the Denavit–Hartenberg table of the arm in the convention “{convention}”, its lengths by their names."
        )
    }

    fn axes_title(&self) -> String {
        "How the axes lie".into()
    }

    fn axes_lie(&self, configuration: Line) -> Line {
        let mut line = Line::new("The arm is put to ");
        line.0.extend(configuration.0);
        line.text(". The axes of its joints are then, in the base:")
    }

    fn axes_caption(&self) -> String {
        "A point on each axis and its direction; R turns, P slides.".into()
    }

    fn point(&self) -> String {
        "through".into()
    }

    fn direction(&self) -> String {
        "along".into()
    }

    fn tool_there(&self) -> String {
        "and the tool stands at".into()
    }

    fn configurations_title(&self) -> String {
        "The joints for a pose".into()
    }

    fn ask_configurations(&self, count: usize) -> String {
        let pose = if count == 1 { "the pose" } else { "each of the poses" };
        format!(
            "Give all configurations of the joints for {pose} T of the tool below: how they are found, and in numbers."
        )
    }

    fn formulas_title(&self) -> String {
        "Formulas".into()
    }

    fn numbered_solution(&self, number: usize) -> String {
        format!("Solution {number}: ")
    }

    fn jacobian_formula(&self) -> String {
        "The Jacobian".into()
    }

    fn ask_jacobian(&self) -> String {
        "Give the geometric Jacobian J as a formula, for the point and along the axes below, and in numbers to four decimals, along the axes of the base.".into()
    }

    fn rates_given(&self) -> String {
        "The joints move with ".into()
    }

    fn velocity_title(&self) -> String {
        "The velocity of the tool".into()
    }

    fn ask_velocity(&self) -> String {
        "Give the velocity of the origin of the tool in the first configuration, for the velocities of the joints below.".into()
    }

    fn ask_determinant(&self) -> String {
        "Give the determinant of the Jacobian, in factors.".into()
    }

    fn ask_singular(&self) -> String {
        "Say where the arm is singular.".into()
    }

    fn singular_where(&self, condition: Math) -> Line {
        Line::new("The arm is singular where ").math(condition).text(".")
    }
}
