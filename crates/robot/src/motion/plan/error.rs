//! Why there is no motion, in plain words.

use crate::description::JointKind;
use crate::inverse::Unprepared;
use crate::motion::MotionError;
use crate::motion::profile::Law;
use crate::quantity::{decimals, rate};
use std::fmt;

/// Why a wish has no motion.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanError {
    /// The robot cannot be solved as it is given.
    Unprepared(Unprepared),
    /// The limits of the joints are none: a number that is not positive, or not one for each joint.
    Limits(MotionError),
    /// Jerk limits do not help without velocities and accelerations of all joints.
    NeededForJerk,
    /// Torque limits do not help without velocities of all joints.
    NeededForTorque,
    /// Torque limits are kept by timings of a path, and not by time laws.
    LawWithTorque,
    /// Over the duration asked for a torque is beyond its limit: friction that grows with the speed falls less than what helps
    /// against it.
    SlowTorque {
        /// The joint's variable.
        joint: String,
        /// When, seconds.
        t: f64,
        /// The part of the limit that is needed: more than 1.
        share: f64,
    },
    /// A time law is asked for, which needs velocities and accelerations of all joints.
    NeededForLaw,
    /// The law's acceleration jumps, which no jerk limit allows.
    LawJumps(Law),
    /// There is no such path, or no timing of it.
    Motion(MotionError),
    /// No configuration has the pose at the start.
    OutOfReach,
    /// A way-point is outside of the limits of a joint.
    OutsideLimits {
        /// Its variable.
        joint: String,
    },
    /// The duration asked for is too short for the velocity limit of a joint.
    TooFast {
        /// The duration asked for, seconds.
        asked: f64,
        /// The joint's variable.
        joint: String,
        /// Whether it turns or slides.
        kind: JointKind,
        /// Its largest velocity in that time, rad/s or m/s.
        velocity: f64,
        /// Its limit.
        limit: f64,
        /// The shortest duration, seconds.
        needed: f64,
    },
    /// The duration asked for is shorter than the limits allow.
    TooShort {
        /// The duration asked for, seconds.
        asked: f64,
        /// The shortest duration, seconds.
        needed: f64,
    },
}

impl From<MotionError> for PlanError {
    fn from(why: MotionError) -> Self {
        PlanError::Motion(why)
    }
}

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unprepared(why) => write!(f, "{why}"),
            Self::Limits(why) | Self::Motion(why) => write!(f, "{why}"),
            Self::NeededForJerk | Self::NeededForLaw => {
                write!(f, "velocities and accelerations of all joints are needed too")
            }
            Self::NeededForTorque => write!(f, "velocities of all joints are needed too"),
            Self::LawWithTorque => write!(f, "time laws do not go with torque limits"),
            Self::SlowTorque { joint, t, share } => write!(
                f,
                "so slowly {joint} needs {} % of its torque at {} s",
                decimals(100.0 * share, 2),
                decimals(*t, 4)
            ),
            Self::LawJumps(law) => {
                let law = if *law == Law::Cubic { "cubic" } else { "trapezoidal" };
                write!(f, "the acceleration of the {law} law jumps, and no jerk limit holds there")
            }
            Self::OutOfReach => write!(f, "the start of the path is out of reach"),
            Self::OutsideLimits { joint } => write!(f, "a way-point has {joint} outside of its limits"),
            Self::TooFast { joint, kind, velocity, limit, needed, .. } => write!(
                f,
                "{joint} would turn at {}, its limit is {}; {} s are needed",
                rate(*velocity, *kind),
                rate(*limit, *kind),
                decimals(*needed, 4)
            ),
            Self::TooShort { needed, .. } => {
                write!(f, "the limits allow no less than {} s", decimals(*needed, 4))
            }
        }
    }
}

impl std::error::Error for PlanError {}
