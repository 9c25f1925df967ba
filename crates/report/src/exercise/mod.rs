//! Exercises: a sheet of tasks about a robot with round numbers, the sheet of its solutions, and the points.
//!
//! Everything in a solution comes from the derivations of `denavit`. The names of a [`Rubric`]'s items are those that the
//! solution uses, so that [`denavit_check::check`] and [`Rubric::mark`] mark what students hand in.

mod arm;
mod chosen;
mod export;
mod forward;
mod inverse;
mod motion;
mod path;
mod sheet;
mod statics;
mod velocity;

pub use arm::{ArmOptions, Difficulty, exercise_of_arm};
pub use export::{moodle, notebook, prairielearn};

use crate::document::Document;
use crate::words::{ExerciseKind, Tongue};
use chosen::Chosen;
use denavit::description::Description;
use denavit::inverse::Unprepared;
use denavit::robot::MissingValue;
use denavit::velocity::Obstacle;
use denavit_check::marking::Rubric;
use sheet::{Asked, Question};
use std::fmt;

/// The most configurations or poses of a sheet.
pub const MAX_COUNT: usize = 20;

/// Which exercise.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ExerciseOptions {
    /// What it is about.
    pub kind: ExerciseKind,
    /// The same seed makes the same sheet.
    pub seed: u64,
    /// How many configurations or poses it has, 1 to [`MAX_COUNT`].
    pub count: usize,
    /// The language of the words.
    pub language: Tongue,
}

/// A sheet, its solution, and the points.
#[derive(Clone, Debug)]
pub struct Exercise {
    /// What it was made from.
    pub options: ExerciseOptions,
    /// The robot with names and values for all its lengths: answers are held against it.
    pub robot: Description,
    /// What students get.
    pub statement: Document,
    /// What it should come to.
    pub solution: Document,
    /// The points, item by item.
    pub rubric: Rubric,
    /// The tasks one by one, as other systems have them.
    questions: Vec<Question>,
}

/// Why there is no such exercise.
#[derive(Clone, Debug)]
pub enum NoExercise {
    /// The robot has no joint.
    Still,
    /// A parameter that is no length and no angle has no value.
    Values(MissingValue),
    /// The count is 0 or too large.
    Count(usize),
    /// Not so many regular configurations with round numbers were found.
    Configurations {
        /// How many were.
        found: usize,
        /// How many were to be.
        asked: usize,
    },
    /// The arm has joints too many: a pose has endless configurations.
    Redundant,
    /// The equations of motion are for fewer joints.
    ManyJoints,
    /// The arm has no masses, and none can be put at the ends of its links, or not all have values.
    Masses,
    /// The check cannot judge all of its solution.
    Unmarked,
    /// There can be no inverse kinematics.
    Unprepared(Unprepared),
    /// The formulas are too large to be printed.
    Large,
    /// The singularities are not had as formulas.
    Singular(Obstacle),
    /// There are none, or none that have the form of a formula.
    NeverSingular,
}

impl fmt::Display for NoExercise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoExercise::Still => write!(f, "the robot has no joint"),
            NoExercise::Values(missing) => missing.fmt(f),
            NoExercise::Count(n) => write!(f, "{n} configurations: a sheet has 1 to {MAX_COUNT}"),
            NoExercise::Configurations { found, asked } => {
                write!(
                    f,
                    "{found} regular configurations with round numbers were found, {asked} are asked for"
                )
            }
            NoExercise::Redundant => write!(f, "the arm has infinitely many configurations for a goal"),
            NoExercise::Unmarked => write!(f, "not all of its solution can be marked"),
            NoExercise::ManyJoints => write!(f, "equations of motion are for arms with at most three joints"),
            NoExercise::Masses => write!(
                f,
                "the arm has no masses with values; they are put at the ends of links in the standard convention alone, \
                 where no fixed row stands behind a joint"
            ),
            NoExercise::Unprepared(why) => why.fmt(f),
            NoExercise::Large => write!(f, "the formulas are too large to be printed"),
            NoExercise::Singular(why) => why.fmt(f),
            NoExercise::NeverSingular => {
                write!(f, "the arm is nowhere singular, or not where a formula says it")
            }
        }
    }
}

impl std::error::Error for NoExercise {}

/// Makes an exercise about a robot.
///
/// ```
/// use denavit_report::words::Tongue;
/// use denavit_report::{ExerciseKind, ExerciseOptions, exercise};
///
/// let arm = denavit::catalogue::robot("planar-2r").expect("it is in the catalogue");
/// let options =
///     ExerciseOptions { kind: ExerciseKind::Inverse, seed: 1, count: 1, language: Tongue::English };
/// let made = exercise(&arm, &options).expect("it has two joints");
/// assert_eq!(made.rubric.items.len(), 1);
/// ```
///
/// # Errors
/// If the robot lacks what such an exercise is about.
pub fn exercise(description: &Description, options: &ExerciseOptions) -> Result<Exercise, NoExercise> {
    if description.variables().is_empty() {
        return Err(NoExercise::Still);
    }
    if !(1..=MAX_COUNT).contains(&options.count) {
        return Err(NoExercise::Count(options.count));
    }
    let mut chosen = Chosen::new(options.seed);
    let weighted = match options.kind {
        ExerciseKind::Torques => Some(motion::weighted(description)?),
        _ => None,
    };
    let robot = chosen.with_values(&weighted.as_ref().unwrap_or(description).with_named_lengths());
    let make: fn(&sheet::Ground, &mut Chosen) -> Result<Asked, NoExercise> = match options.kind {
        ExerciseKind::Forward => forward::poses,
        ExerciseKind::Table => forward::table,
        ExerciseKind::Inverse => inverse::configurations,
        ExerciseKind::Jacobian => velocity::jacobian,
        ExerciseKind::Singularities => velocity::singularities,
        ExerciseKind::Transforms => forward::links,
        ExerciseKind::Position => inverse::positions,
        ExerciseKind::Statics => statics::torques,
        ExerciseKind::Torques => motion::equations,
        ExerciseKind::Path => path::timing,
    };
    let ground = sheet::Ground::new(&robot, options);
    let asked = make(&ground, &mut chosen)?;
    Ok(ground.exercise(asked))
}
