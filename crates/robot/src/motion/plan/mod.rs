//! From a wish to a timed motion: a path of the joints or of the hand, followed if it is one of the hand, and timed as
//! what is known of the joints allows.
//!
//! | known of all joints | timing |
//! |---|---|
//! | velocity, acceleration, jerk | fast, within all three |
//! | velocity, acceleration | time-optimal, or by the law that is asked for |
//! | velocity, torque | time-optimal within these, and accelerations where they are known; fast, with viscous friction |
//! | velocity, torque, jerk | fast, within these, and accelerations where they are known |
//! | less | a quintic law, slower where velocities are limited |

mod error;
mod hand;
mod held;
mod joints;
mod known;
mod sampled;
mod timed;

pub use error::PlanError;
pub use held::Held;
pub use known::KnownLimits;
pub use sampled::{Sample, Sampled};

use super::error::{joints as one_a_joint, positive};
use super::follow::{self, Alternative, Followed, Follower};
use super::hand::{HandPath, Stretch};
use super::profile::Law;
use super::trajectory::Trajectory;
use crate::description::Description;
use crate::mechanism::Robot;

/// What is to be moved along.
pub enum Wish {
    /// Configurations, radians and metres: a move between two, a path through more.
    Joints(Vec<Vec<f64>>),
    /// A path of the hand.
    Hand {
        /// Poses of the tool in the base.
        path: Box<dyn HandPath + Send + Sync>,
        /// The configuration at the start; the one whose branch goes furthest otherwise.
        start: Option<Vec<f64>>,
    },
}

/// How it is to be done.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlanOptions {
    /// Between several configurations go straight, and round each corner at this distance (Euclidean, radians and metres);
    /// a smooth curve through them otherwise.
    pub blend: Option<f64>,
    /// The time law of a move between two configurations; needs velocities and accelerations.
    pub law: Option<Law>,
    /// Seconds for the whole path, no less than the limits allow.
    pub duration: Option<f64>,
    /// The hand's speed on the average where no accelerations are known, m/s.
    pub speed: f64,
    /// How far the hand may leave its path between samples of the joints, metres.
    pub max_deviation: f64,
    /// What comes of every configuration in which the path can start is wanted, even if one is given.
    pub alternatives: bool,
}

impl Default for PlanOptions {
    /// A smooth curve at 0.25 m/s or as fast as the limits allow, within a hundredth of a millimetre.
    fn default() -> Self {
        let max_deviation = follow::FollowOptions::default().max_deviation;
        PlanOptions {
            blend: None,
            law: None,
            duration: None,
            speed: 0.25,
            max_deviation,
            alternatives: false,
        }
    }
}

/// A path with its timing.
pub struct Planned {
    /// The joints in time; at rest at the start if the path cannot be followed at all.
    pub trajectory: Box<dyn Trajectory>,
    /// What path it is.
    pub course: Course,
    /// How it was timed.
    pub timing: Timing,
    /// What was met on the way, for a path of the hand.
    pub followed: Option<Followed>,
    /// What comes of the configurations in which a path of the hand can start, where that was asked for or matters.
    pub alternatives: Vec<Alternative>,
}

/// What path is taken.
#[derive(Clone, PartialEq, Debug)]
pub enum Course {
    /// From one configuration to another.
    Move,
    /// Straight moves of the joints past so many way-points, with rounded corners.
    Straight(usize),
    /// A smooth curve of the joints through so many way-points.
    Spline(usize),
    /// A path of the hand, by its parts.
    Hand(Vec<Stretch>),
}

/// How a path was timed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Timing {
    /// The law.
    pub by: TimingLaw,
    /// The duration in seconds, if it is longer than the law needs because that was asked for.
    pub slowed_to: Option<f64>,
    /// What of the limits the motion takes, where jerks or torques are limited along a path.
    pub held: Option<Held>,
}

/// The law of a timing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum TimingLaw {
    /// None: the path cannot be followed at all.
    Still,
    /// The fastest along the path within velocity and acceleration limits.
    TimeOptimal,
    /// Along the path within velocity and torque limits.
    WithinTorques {
        /// Whether within acceleration limits, too.
        accelerations: bool,
        /// Whether it is the fastest of its grid: no joint has viscous friction, with which speeds are searched for.
        fastest: bool,
    },
    /// Fast along the path within velocity, acceleration and jerk limits.
    JerkLimited,
    /// Fast along the path within velocity, jerk and torque limits.
    WithinJerksAndTorques {
        /// Whether within acceleration limits, too.
        accelerations: bool,
    },
    /// The fastest between two configurations within velocity, acceleration and jerk limits.
    Fastest,
    /// A law for all joints together, within the limits.
    Together(Law),
    /// A quintic law; no limits are known.
    Quintic {
        /// Seconds.
        duration: f64,
        /// The joint (from 0) that becomes fastest, and its velocity, rad/s or m/s.
        fastest: Option<(usize, f64)>,
    },
    /// A quintic law within velocity limits; no accelerations are known.
    QuinticWithin {
        /// Seconds.
        duration: f64,
    },
}

/// Whether a motion does all that was wished.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Verdict {
    /// The whole path, within the limits.
    Whole,
    /// Up to this part of the path, from 0 to 1.
    Ends(f64),
    /// The whole path, but a joint leaves its limits on the way.
    BeyondLimits,
}

impl Planned {
    /// Follows and times.
    ///
    /// # Errors
    /// See [`PlanError`].
    pub fn new(
        description: &Description,
        robot: &Robot<f64>,
        wish: Wish,
        limits: &KnownLimits,
        options: &PlanOptions,
    ) -> Result<Self, PlanError> {
        Self::reusing(&mut None, description, robot, wish, limits, options)
    }

    /// The same with the follower of the same robot; one that is not there yet is made if it is needed, and kept.
    ///
    /// # Errors
    /// See [`PlanError`].
    pub(crate) fn reusing(
        follower: &mut Option<Follower>,
        description: &Description,
        robot: &Robot<f64>,
        wish: Wish,
        limits: &KnownLimits,
        options: &PlanOptions,
    ) -> Result<Self, PlanError> {
        let n = robot.joints;
        positive("the speed of the hand", &[options.speed])?;
        positive("the deviation", &[options.max_deviation])?;
        positive("the duration", options.duration.as_slice())?;
        let limits = limits.of_joints(n)?;
        match limits.torque {
            Some(_) if limits.velocity.is_none() => return Err(PlanError::NeededForTorque),
            Some(_) if options.law.is_some() => return Err(PlanError::LawWithTorque),
            _ => {}
        }
        if limits.all.is_none() {
            match (limits.jerk, options.law) {
                (Some(_), _) => return Err(PlanError::NeededForJerk),
                (None, Some(_)) => return Err(PlanError::NeededForLaw),
                (None, None) => {}
            }
        }
        match wish {
            Wish::Joints(points) => {
                points.iter().try_for_each(|p| one_a_joint("way-points", n, p))?;
                joints::plan(description, &points, &limits, options)
            }
            Wish::Hand { path, start } => {
                start.iter().try_for_each(|q| one_a_joint("the start", n, q))?;
                let follower = match follower {
                    Some(follower) => follower,
                    None => follower.insert(Follower::new(description).map_err(PlanError::Unprepared)?),
                };
                hand::plan(description, robot, follower, (&*path, start), &limits, options)
            }
        }
    }

    /// Whether the path is followed to its end within the limits.
    pub fn verdict(&self) -> Verdict {
        match &self.followed {
            Some(f) if f.reached < 1.0 => Verdict::Ends(f.reached),
            Some(f) if !f.is_clean() => Verdict::BeyondLimits,
            _ => Verdict::Whole,
        }
    }
}
