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
        ExerciseKind::Transforms => "link transforms",
        ExerciseKind::Position => "inverse position problem",
        ExerciseKind::Statics => "statics",
        ExerciseKind::Torques => "equations of motion",
        ExerciseKind::Path => "timing of a motion",
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

    fn positions_title(&self) -> String {
        "The joints for a position".into()
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

    fn coefficients(&self) -> String {
        "The coefficients of the powers of t".into()
    }

    fn largest_of(&self, title: &str) -> String {
        format!(
            "{title}: the number N of configurations, and that with the largest first joint (of several the largest second joint, and so on)"
        )
    }

    fn made_up_arm(&self, joints: &str, seed: u64) -> String {
        format!("{joints} arm {seed}")
    }

    fn ask_transforms(&self) -> String {
        "Give the transform of each link, A1, A2, …, as formulas, and in numbers at the configuration below, to four decimals.".into()
    }

    fn ask_positions(&self, count: usize) -> String {
        let position = if count == 1 { "the position" } else { "each of the positions" };
        format!(
            "Give all configurations of the joints for {position} of the tool below: how they are found, and in numbers."
        )
    }

    fn given_position_title(&self, number: usize) -> String {
        format!("Position {number}")
    }

    fn solved_position_title(&self, number: usize) -> String {
        format!("Inverse kinematics for position {number}")
    }

    fn position_given(&self) -> String {
        "The tool is to reach the point ".into()
    }

    fn torque_formulas_title(&self) -> String {
        "The joint torques".into()
    }

    fn torque_numbers_title(&self) -> String {
        "The joint torques in numbers".into()
    }

    fn ask_statics(&self, force: Vec<Math>) -> Line {
        Line::new("The tool presses on its surroundings with a force that has the components ")
            .list(force)
            .text(" along the axes of the base. Give the torques of the joints (forces of slides) that are needed for it at rest, as formulas; the arm has no weight.")
    }

    fn ask_torque_numbers(&self, count: usize) -> String {
        let where_ = if count == 1 { "at the configuration" } else { "at each of the configurations" };
        format!("Give them in numbers {where_} below, to four decimals.")
    }

    fn force_given(&self) -> String {
        "The force is ".into()
    }

    fn statics_step(&self) -> String {
        "The linear rows of the Jacobian of the tool, along the axes of the base; their columns, multiplied by the force, are the torques.".into()
    }

    fn point_masses(&self) -> String {
        "Each link has its mass as a point at its end, the origin of its frame; there is no friction.".into()
    }

    fn gravity_in_base(&self, components: [Math; 3]) -> Line {
        Line::new("The acceleration of gravity in the base is (").list(components).text(").")
    }

    fn motion_parts_title(&self) -> String {
        "The parts of the equations of motion".into()
    }

    fn ask_motion_parts(&self) -> String {
        "Give the inertia matrix M, the torques V of centrifugal and Coriolis forces and the torques G of gravity.".into()
    }

    fn ask_motion(&self) -> String {
        "Give the torque of each joint as a formula in the angles, rates and accelerations.".into()
    }

    fn inertia_step(&self) -> String {
        "The inertia matrix, from the kinetic energy:".into()
    }

    fn velocity_torques_step(&self) -> String {
        "The torques of centrifugal and Coriolis forces, from its derivatives:".into()
    }

    fn gravity_step(&self) -> String {
        "The torques of gravity, from the potential energy:".into()
    }

    fn motion_step(&self) -> String {
        "The rows of M times the accelerations, and V and G, add up to the torques.".into()
    }

    fn accelerations_given(&self) -> String {
        "They accelerate with ".into()
    }

    fn motion_title(&self) -> String {
        "The motion".into()
    }

    fn motion_begins(&self, configuration: Line) -> Line {
        let mut line = Line::new("It begins at rest at ");
        line.0.extend(configuration.0);
        line.text(".")
    }

    fn motion_ends(&self, configuration: Line) -> Line {
        let mut line = Line::new("It ends at rest at ");
        line.0.extend(configuration.0);
        line.text(".")
    }

    fn cubic_title(&self) -> String {
        "Cubic polynomials".into()
    }

    fn ask_cubic(&self, seconds: Math) -> Line {
        Line::new("Give each joint variable as a cubic polynomial in the time t (in seconds; angles in degrees, slides in metres) for a motion that takes ")
            .math(seconds)
            .text(".")
    }

    fn cubic_step(&self, formula: Math) -> Line {
        Line::new("At rest at both ends a joint that moves by D in the time f follows ")
            .math(formula)
            .text(".")
    }

    fn peaks_title(&self) -> String {
        "The greatest speeds".into()
    }

    fn ask_peaks(&self, names: Vec<Math>) -> Line {
        Line::new("Give the greatest speed of each joint on the way: ").list(names).text(".")
    }

    fn peaks_step(&self, formula: Math) -> Line {
        Line::new("A joint is fastest half way, with ").math(formula).text(".")
    }

    fn trapezoid_title(&self) -> String {
        "The shortest times".into()
    }

    fn ask_trapezoid(&self, names: Vec<Math>, whole: Math) -> Line {
        Line::new("Now the speeds have trapezoidal profiles within the limits below. Give the shortest time of each joint by itself, ")
            .list(names)
            .text(", and that of all joints together, ")
            .math(whole)
            .text(", in seconds to four decimals.")
    }

    fn joint_limits(&self, joint: Math, speed: &str, acceleration: &str) -> Line {
        Line::new("Joint ")
            .math(joint)
            .text(format!(" moves with at most {speed} and accelerates with at most {acceleration}."))
    }

    fn trapezoid_step(&self, joint: Math, formula: Math) -> Line {
        Line::new("Joint ")
            .math(joint)
            .text(" reaches its greatest speed v: it takes ")
            .math(formula)
            .text(".")
    }

    fn triangle_step(&self, joint: Math, formula: Math) -> Line {
        Line::new("Joint ")
            .math(joint)
            .text(" does not reach its greatest speed: it takes ")
            .math(formula)
            .text(".")
    }

    fn slowest_step(&self, whole: Math) -> Line {
        Line::new("The slowest joint says how long all take: ").math(whole)
    }
}
