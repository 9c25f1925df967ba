//! What is said of inverse kinematics: its derivation step by step, and why there is none.

use crate::explained::{Case, Component, Consequence, Kind, Remark, Source};
use crate::tree::{Factor, Line, Math, Proof};
use denavit::inverse::derivation::{Elimination, NotGiven};
use denavit::inverse::{Doubt, Goal, Label, Obstacle, Refusal, Stuck, Task, Unsuitable};
use denavit_symbolic::Expr;

/// What is given and what is sought.
pub struct Given {
    /// What of the hand is given.
    pub goal: Goal,
    /// Joint variables that are given beside it.
    pub joints: Vec<Math>,
    /// Whether the derivation chose them.
    pub is_choice: bool,
    /// Joint variables that are sought.
    pub sought: Vec<Math>,
    /// Whether the chain is given as it is: nothing constant stands at its ends.
    pub is_whole: bool,
}

impl Given {
    /// U = T: the chain gives the pose itself.
    pub fn whole() -> Math {
        Math::Products(vec![Factor::named("U")], vec![Factor::named("T")])
    }
}

/// The coefficients of an equation.
pub enum Coefficients<'a> {
    /// In the sentence.
    Here(&'a [Math]),
    /// On lines of their own below it.
    Below,
}

/// What is said of inverse kinematics.
pub trait Inverse {
    /// The title of a derivation.
    fn inverse_title(&self, robot: &str) -> String;

    /// The heading of joints that follow from the steps.
    fn other_joints(&self) -> String;

    /// How many solutions there are at most, or that the derivation ended early; within a sentence.
    fn solutions_found(&self, solutions: Option<usize>) -> String;

    /// What is given, what is sought, and that the chain follows.
    fn given(&self, given: Given) -> Line;

    /// Which columns of U are given, where not the whole pose is: the position, or the direction of the z axis (`has_axis`) with it.
    fn given_columns(&self, has_axis: bool) -> &'static str;

    /// What the short names of the cosine and sine of `q` are, and of the cosine of a sum.
    fn short_names(&self, q: Expr, sum: Option<Expr>) -> Line;

    /// The title of a step that finds `unknown`.
    fn step_title(&self, number: usize, unknown: Line, values: usize, label: Option<Label>) -> Line;

    /// Where equations come from; they follow.
    fn source(&self, source: &Source) -> Line;

    /// Why few joints occur in an equation.
    fn component(&self, component: &Component) -> String;

    /// How an unknown is eliminated.
    fn elimination(&self, unknown: Expr, how: Elimination) -> Line;

    /// That names follow, which stand in equations before them or not.
    fn names_follow(&self, is_beside: bool) -> String;

    /// The type of an equation.
    fn kind(&self, kind: Kind) -> String;

    /// The type of an equation with its form and coefficients; the solution follows, or the coefficients and [`Inverse::so`].
    fn equation(&self, kind: Kind, is_squared: bool, form: &[Math], coefficients: &Coefficients) -> Line;

    /// Before a solution.
    fn so(&self) -> String;

    /// A case and what it means.
    fn case(&self, case: &Case) -> Line;

    /// What a case means.
    fn consequence(&self, consequence: Consequence) -> String;

    /// What is lost or added by a step.
    fn remark(&self, remark: Remark) -> String;

    /// The sign of a step and its branches, what is lost or added, which steps (from 1) use the result.
    fn step_remark(&self, sign: Option<(Expr, Option<Label>)>, remark: Remark, used_by: &[usize]) -> Line;

    /// The heading of what a pose must meet.
    fn conditions_title(&self) -> String;

    /// In how many directions the hand can move, and what it can be told; what a pose meets follows.
    fn conditions(&self, rank: usize, task: Option<Task>) -> String;

    /// What a hand can be told.
    fn task(&self, task: Task) -> String;

    /// The heading of the branches.
    fn solutions_title(&self, solutions: usize) -> String;

    /// The number of branches as a product of those of the steps; the branches follow.
    fn solutions_product(&self, product: &str) -> String;

    /// Why no solution is lost or added, and how types are numbered.
    fn solutions_remark(&self) -> String;

    /// The heading of a derivation that ended.
    fn ended_title(&self) -> String;

    /// What was not found.
    fn ended(&self, has_found: bool, missing: Vec<Math>) -> Line;

    /// What may help: for an arm with so many joints more than its hand can use.
    fn ended_remark(&self, surplus: usize) -> String;

    /// A solution in the tree of branches.
    fn solution(&self, number: usize) -> String;

    /// What the marks behind formulas mean.
    fn legend(&self, proof: Proof) -> String;

    /// Why there is no closed form.
    fn refusal(&self, why: &Refusal) -> String {
        match why {
            Refusal::Unsuitable(why) => self.unsuitable(why),
            Refusal::Given(why) => self.not_given(*why),
            Refusal::Stuck(stuck) => self.stuck(stuck),
        }
    }

    /// Why a robot has no normal form.
    fn unsuitable(&self, why: &Unsuitable) -> String;

    /// Why no values can be given for some joints.
    fn not_given(&self, why: NotGiven) -> String;

    /// What was found before a derivation ended, and what was not.
    fn stuck(&self, stuck: &Stuck) -> String;

    /// Why an answer may lack solutions.
    fn doubt(&self, doubt: Doubt) -> String;

    /// Why there is no solution.
    fn obstacle(&self, obstacle: &Obstacle) -> String;

    /// What a pose of an arm with fewer than six degrees of freedom meets, as formulas.
    fn violated(&self, conditions: &[&str]) -> String;
}
