//! What is said in the sections of a report.

use crate::tree::{Line, Math};
use denavit::description::Convention;
use denavit::forward::Proof;
use denavit::inverse::Refusal;
use denavit::structure::Structure;
use denavit::workspace::Section as Plane;
use denavit_program::Count;
use denavit_symbolic::{Expr, Refusal as Unexpanded};

/// A heading of a report.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Heading {
    /// The pictures of the arm.
    Arm,
    /// The pictures of several arms.
    Arms,
    /// The Denavit–Hartenberg table.
    Table,
    /// The link transforms.
    Links,
    /// The program of the forward model.
    Algorithm,
    /// Numbers at a configuration.
    Example,
    /// Inverse kinematics.
    Inverse,
    /// The solutions at the example.
    Solutions,
    /// The Jacobian and its singularities.
    Velocity,
    /// The dynamic model.
    Dynamics,
    /// What is reached.
    Workspace,
    /// Errors of a document.
    Errata,
    /// Where methods and numbers come from.
    References,
}

/// What stands in the summary.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Glance {
    /// Joints and how their axes lie.
    Structure,
    /// The convention of the table.
    Convention,
    /// Where the robot comes from.
    Source,
    /// The forward model.
    Forward,
    /// The inverse model.
    Inverse,
    /// Where it is singular.
    Singularities,
}

/// The heading of a column.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Column {
    /// Whether a joint turns or slides.
    Joint,
    /// What its file calls it.
    Name,
    /// The limits of a joint, or whether a solution is within them.
    Limits,
    /// The name of a branch.
    Branch,
    /// A step of an algorithm.
    Step,
    /// Its value.
    Value,
    /// A torque that holds.
    Torque,
    /// The inertia that a joint feels.
    Inertia,
}

/// The caption of a table or a picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Caption {
    /// Steps of the forward algorithm in numbers.
    Steps,
    /// Configurations with one pose.
    Configurations,
    /// The picture of a single one.
    Picture,
    /// Pictures of these configurations.
    Pictures,
    /// Pictures of singular configurations.
    Singular,
    /// The line diagram.
    Scheme,
    /// What holds the arm at rest, before the configuration.
    AtRest,
}

/// How many claims of a document are of each kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Standings {
    /// Proved equal.
    pub equal: usize,
    /// Refuted.
    pub wrong: usize,
    /// Equal where a condition holds.
    pub conditional: usize,
    /// Right but for a wrong one before.
    pub carried: usize,
    /// Neither proved nor refuted.
    pub undecided: usize,
    /// Not read.
    pub unreadable: usize,
    /// Lines that look like formulas and were not judged.
    pub unjudged: usize,
}

/// A list of errata.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum List {
    /// What is wrong.
    Wrong,
    /// What is right under a condition.
    Conditional,
    /// What is not decided or not read.
    Open,
    /// What looks like a formula and was not judged.
    Unjudged,
}

/// The singularities in a summary.
pub enum Factors {
    /// There are none.
    None,
    /// No factor is shared by all determinants.
    NotShared,
    /// The factors are long.
    Long,
    /// These are 0, and whether that is all.
    Shared(Vec<Math>, bool),
    /// The arm has fewer than six directions everywhere.
    Everywhere,
    /// The determinant is not known.
    TooLarge,
}

/// What the names of sines and cosines of an angle mean.
pub struct Names {
    /// The names.
    pub names: Vec<Math>,
    /// Whether the cosine is among them.
    pub has_cosine: bool,
    /// Whether the sine is.
    pub has_sine: bool,
    /// The angle.
    pub angle: Expr,
}

/// What is said in the sections of a report.
pub trait Report {
    /// The title.
    fn title(&self, robot: &str) -> String;

    /// What is said of the position alone, behind what is said of the pose.
    fn of_the_position(&self, said: &str) -> String;

    /// The title of a document about several robots.
    fn compared(&self, robots: &[&str]) -> String;

    /// The captions of the table and of the pictures in it, which have one scale or not.
    fn beside_each_other(&self, have_one_scale: bool) -> [&'static str; 2];

    /// A heading.
    fn heading(&self, heading: Heading) -> String;

    /// A label of the summary.
    fn glance(&self, glance: Glance) -> String;

    /// The heading of a column.
    fn column(&self, column: Column) -> String;

    /// The caption of a table or a picture.
    fn caption(&self, caption: Caption) -> String;

    /// The word before the number of a table.
    fn table(&self) -> &'static str;

    /// The word before the number of a figure.
    fn figure(&self) -> &'static str;

    /// The label of a list of sections.
    fn contents(&self) -> &'static str;

    /// What turns slides: back, and on.
    fn turning(&self) -> [&'static str; 2];

    /// What is read aloud before a formula.
    fn formula(&self) -> &'static str;

    /// A picture for those who do not see it: its own caption and that of all.
    fn picture(&self, own: &str, whole: &str) -> String;

    /// A picture of an arm with its joints (`RRR`), by itself.
    fn arm_picture(&self, is_scheme: bool, robot: &str, joints: &str) -> String;

    /// A picture of a section of the workspace with the ranges of both coordinates, by itself.
    fn workspace_picture(&self, plane: &Plane, ranges: [[String; 2]; 2]) -> String;

    /// A plot of lines, by itself.
    fn curves_picture(&self, title: &str, names: &[String]) -> String;

    /// Before the values that are taken for lengths without values.
    fn assumed_lengths(&self) -> String;

    /// Joints and how their axes lie.
    fn structure(&self, structure: &Structure) -> String;

    /// A convention with its transforms.
    fn convention(&self, convention: Convention) -> String;

    /// What a forward program costs, and whether it is proved.
    fn forward_cost(&self, count: &Count, proof: Proof) -> String;

    /// At most so many solutions, for each value of the given joints.
    fn closed_form(&self, solutions: usize, given: &[String]) -> String;

    /// Where there is no closed form: by elimination, or in numbers.
    fn no_closed_form(&self, by_elimination: bool) -> String;

    /// Where the arm is singular.
    fn factors(&self, factors: Factors) -> Line;

    /// The arm with its frames, at a configuration.
    fn arm_caption(&self, configuration: Line) -> Line;

    /// A table in another convention.
    fn converted(&self, convention: Convention) -> String;

    /// Whether two tables are proved to give the same pose.
    fn same_pose(&self, is_proved: bool) -> String;

    /// What an angle or a distance of a row is: about or along which axis of which frame.
    fn parameter(&self, is_angle: bool, axis: char, frame: &str) -> String;

    /// The caption of a table of parameters.
    fn parameters(&self, convention: Convention) -> String;

    /// Where frame 0 stands in the base.
    fn base_stands(&self) -> String;

    /// Where the tool stands in the last frame.
    fn tool_stands(&self) -> String;

    /// The name of the base's frame.
    fn base(&self) -> String;

    /// The name of the tool's frame.
    fn tool(&self) -> String;

    /// Before values of parameters.
    fn values(&self) -> String;

    /// Before the matrix of any row.
    fn row_transform(&self) -> String;

    /// Before the matrices of the rows.
    fn row_by_row(&self) -> String;

    /// Before the frames of a forward model.
    fn forward_title(&self) -> String;

    /// The heading of a point, or of a free vector, in another frame.
    fn image_title(&self, is_point: bool) -> String;

    /// Before its coordinates in one frame, what they are in the other; the frames by their names.
    fn image(&self, is_point: bool, of: [Math; 3], from: &str, to: &str) -> Line;

    /// That a matrix is not printed.
    fn long_matrix(&self) -> String;

    /// That a matrix is not expanded.
    fn no_matrix(&self, why: Unexpanded) -> String;

    /// Before a program.
    fn shortest_program(&self) -> String;

    /// What the names of sines and cosines mean.
    fn names(&self, all: Vec<Names>) -> Line;

    /// How operations are counted.
    fn counting_rule(&self) -> String;

    /// At a configuration, before the steps in numbers.
    fn example(&self, configuration: Line) -> Line;

    /// Before the pose in numbers.
    fn example_pose(&self) -> String;

    /// The orientation in angles.
    fn orientation(&self, rpy: &str, zyz: &str) -> String;

    /// By how much the product of the link transforms differs at most.
    fn difference(&self, by: &str) -> String;

    /// Why there is no closed form.
    fn refused(&self, why: &Refusal) -> String;

    /// That a formula is not printed.
    fn long_formula(&self) -> String;

    /// Before the pose at a configuration.
    fn pose_at(&self, configuration: Line) -> Line;

    /// Values that are given.
    fn given_values(&self, values: Line) -> Line;

    /// That no solution was found.
    fn no_solution(&self) -> String;

    /// Isolated solutions and families, and whether these are all.
    fn found(&self, isolated: usize, families: usize, is_complete: bool) -> String;

    /// That not all of them are shown.
    fn first_of_them(&self, shown: usize) -> String;

    /// Whether a solution is within the limits.
    fn within_limits(&self, is_within: bool) -> String;

    /// How far the tool point comes along two coordinates, and from the shoulder.
    fn reach(&self, first: (&str, &str), second: (&str, &str), from_shoulder: Option<&str>) -> String;

    /// That joints without limits turn fully.
    fn full_turns(&self) -> String;

    /// Before ranges that are assumed.
    fn assumed_travel(&self) -> String;

    /// Before joints that are held.
    fn held(&self) -> String;

    /// The picture of a section of the workspace with two coordinates, and whether it shows the arm.
    fn workspace(&self, plane: &Plane, symbols: [&str; 2], has_arm: bool) -> String;

    /// How many claims a document makes, and how many of each kind.
    fn claims(&self, name: &str, claims: usize, standings: Standings) -> String;

    /// What a change would turn right and wrong, and what would stay wrong.
    fn cause(&self, turns: [usize; 3]) -> String;

    /// The heading of a list.
    fn list(&self, list: List) -> String;

    /// That a list goes on.
    fn more(&self, number: usize) -> String;

    /// A formula as it is printed, in which line.
    fn printed(&self, line: usize, formula: &str) -> String;

    /// Before the right formula.
    fn right(&self) -> String;

    /// Before the source of a robot.
    fn robot(&self) -> String;

    /// By which version a document was made.
    fn made_by(&self, version: &str) -> String;
}
