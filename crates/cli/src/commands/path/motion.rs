//! The motion: options to what the planner takes, its refusals to what a person reads.

use crate::arguments::PathArguments;
use crate::commands::ik::unprepared;
use crate::failure::Failure;
use crate::terminal::words;
use denavit::Robot;
use denavit::description::Description;
use denavit::motion::plan::{KnownLimits, PlanError, PlanOptions, Planned, Verdict, Wish};

/// Follows and times.
///
/// # Errors
/// If there is no start, or the timing finds no answer.
pub fn plan(
    description: &Description,
    robot: &Robot<f64>,
    wish: Wish,
    limits: &KnownLimits,
    arguments: &PathArguments,
) -> Result<Planned, Failure> {
    let usual = PlanOptions::default();
    let options = PlanOptions {
        blend: arguments.blend,
        law: arguments.law.map(Into::into),
        duration: arguments.duration,
        speed: arguments.speed,
        max_deviation: arguments.max_deviation.unwrap_or(usual.max_deviation),
        alternatives: arguments.alternatives,
    };
    Planned::new(description, robot, wish, limits, &options).map_err(|why| match &why {
        PlanError::Unprepared(why) => unprepared(description, &arguments.robot.robot, why),
        PlanError::Limits(_) => Failure::Usage(why.to_string()),
        PlanError::NeededForTorque | PlanError::LawWithTorque => Failure::Usage(format!("--torque: {why}")),
        PlanError::NeededForJerk => Failure::Usage(format!("--jerk: {why}")),
        PlanError::LawJumps(_) => Failure::Usage(format!(
            "--law: {why}; `--law jerk-limited` and `--law quintic` keep --jerk, or leave it away"
        )),
        PlanError::NeededForLaw => Failure::Usage(format!("--law: {why}")),
        PlanError::TooFast { asked, .. } | PlanError::TooShort { asked, .. } => {
            Failure::No(format!("--duration {asked}: {why}"))
        }
        PlanError::SlowTorque { .. } => Failure::No(format!("--duration: {why}")),
        PlanError::Motion(_) | PlanError::OutOfReach | PlanError::OutsideLimits { .. } => {
            Failure::No(why.to_string())
        }
    })
}

/// Whether the path is followed to its end within the limits.
pub fn verdict(planned: &Planned) -> Result<(), Failure> {
    match planned.verdict() {
        Verdict::Whole => Ok(()),
        no => Err(Failure::No(words().verdict(no))),
    }
}
