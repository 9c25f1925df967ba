//! What can be wrong with a motion, in plain words.

use std::fmt;

/// Why there is no path, no profile or no timing.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionError {
    /// A number is NaN or infinite; says which input.
    NotFinite(&'static str),
    /// A number must be greater than zero; says which input.
    NotPositive(&'static str, f64),
    /// Two inputs disagree about the number of joints.
    Joints {
        /// The input with another number.
        what: &'static str,
        /// The number of joints elsewhere.
        expected: usize,
        /// The number of joints here.
        found: usize,
    },
    /// A path needs at least two way-points.
    TooFewWayPoints(usize),
    /// Way-point `index` (from 0) is the same as the one before it.
    RepeatedWayPoint(usize),
    /// Value `index` (from 0) of a list is not greater than the one before it; says which list.
    NotIncreasing(&'static str, usize),
    /// The path stays where it is: there is nothing to time.
    ZeroLength,
    /// The limits of a joint (from 0) are not an interval that contains zero; says of which quantity.
    Limits(&'static str, usize),
    /// Limits of the jerk are needed here.
    NoJerkLimits,
    /// More than [`crate::motion::MAX_SAMPLES`] samples or grid points are asked for.
    TooMany(&'static str, f64),
    /// A profile with these end velocities would have to turn round, or needs more than this distance.
    TooShort {
        /// Shortest distance with these end velocities.
        needed: f64,
        /// The distance to go, counted in the direction of motion.
        found: f64,
    },
    /// No speed at the parameter `s` of the path leads to its end within the limits.
    NotControllable {
        /// Parameter of the path.
        s: f64,
    },
    /// The speed ṡ at the start or at the end is outside the speeds that the limits allow there.
    EndSpeed {
        /// Parameter of the path: 0 at the start.
        s: f64,
        /// The speed asked for.
        speed: f64,
        /// The lowest and the highest possible speed.
        possible: [f64; 2],
    },
    /// At the parameter `s` a joint (from 0) cannot carry the arm at rest within its torque limits.
    Torque {
        /// The joint.
        joint: usize,
        /// Parameter of the path.
        s: f64,
    },
    /// The limits let the path not move at all behind the parameter `s`.
    Stuck {
        /// Parameter of the path.
        s: f64,
    },
    /// The path has a corner, or its curvature jumps: jerk limits cannot hold there without a stop.
    Kink {
        /// Parameter of the path.
        s: f64,
    },
    /// The path does not know its third derivative.
    NoThirdDerivative,
    /// A state at an end of the motion violates the limits, or must violate them.
    State(StateError),
    /// The method found no answer, though there may be one.
    NoAnswer(Failure),
}

/// What is wrong with a state at an end of a motion. Joints are counted from 0; shown from 1.
#[derive(Clone, Debug, PartialEq)]
pub enum StateError {
    /// Its velocity or its acceleration is outside of the limits.
    OutsideLimits(End, usize),
    /// While its acceleration goes to zero the velocity exceeds the limit.
    ExceedsVelocity(End, usize),
    /// Its velocity is above the limit.
    AboveLimit,
    /// Its velocity is against the direction of motion.
    AgainstMotion,
    /// What the solver of time-optimal moves says.
    Refused(String),
}

/// An end of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Where it begins.
    Start,
    /// Where it ends.
    End,
}

/// Where a method ended without an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The motion that was found violates its limits or its goal.
    Unsound,
    /// No profile was found.
    NoProfile,
    /// What the solver of time-optimal moves says.
    Refused(String),
}

impl fmt::Display for StateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |end: &End| if *end == End::Start { "start" } else { "end" };
        match self {
            Self::OutsideLimits(end, joint) => {
                write!(f, "the {} of joint {} is outside its limits", name(end), joint + 1)
            }
            Self::ExceedsVelocity(end, joint) => write!(
                f,
                "with the acceleration at the {} joint {} exceeds its velocity limit",
                name(end),
                joint + 1
            ),
            Self::AboveLimit => f.write_str("an end velocity is above its limit"),
            Self::AgainstMotion => f.write_str("an end velocity is against the direction of motion"),
            Self::Refused(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for StateError {}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unsound => "the motion found violates its limits or its goal",
            Self::NoProfile => "no profile",
            Self::Refused(why) => why,
        })
    }
}

impl std::error::Error for Failure {}

impl fmt::Display for MotionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite(what) => write!(f, "{what}: a number is not finite"),
            Self::NotPositive(what, value) => write!(f, "{what}: {value} is not greater than zero"),
            Self::Joints { what, expected, found } => {
                write!(f, "{what}: {found} joints where there are {expected}")
            }
            Self::TooFewWayPoints(found) => write!(f, "a path needs two way-points, and there are {found}"),
            Self::RepeatedWayPoint(index) => {
                write!(f, "way-point {index} (counted from 0) repeats the one before it: leave it out")
            }
            Self::NotIncreasing(what, index) => {
                write!(f, "{what}: value {index} (counted from 0) is not greater than the one before it")
            }
            Self::ZeroLength => write!(f, "the path has no length"),
            Self::Limits(what, joint) => {
                write!(f, "{what} limits of joint {}: not an interval around zero", joint + 1)
            }
            Self::NoJerkLimits => write!(f, "the limits say nothing about the jerk, and it is needed here"),
            Self::TooMany(what, count) => write!(f, "{what}: {count:.0} are too many"),
            Self::TooShort { needed, found } => write!(
                f,
                "the end velocities need a distance of at least {needed}, and it is {found}: \
                 the motion would have to turn round"
            ),
            Self::NotControllable { s } => {
                write!(f, "at s = {s} no speed leads to the end of the path within the limits")
            }
            Self::EndSpeed { s, speed, possible: [low, high] } => {
                write!(f, "the speed {speed} at s = {s} is not possible: the limits allow {low} to {high}")
            }
            Self::Torque { joint, s } => write!(
                f,
                "at s = {s} joint {} cannot carry the arm at rest within its torque limits; motions that swing past are not looked for",
                joint + 1
            ),
            Self::Stuck { s } => write!(f, "the limits forbid every motion behind s = {s}"),
            Self::Kink { s } => {
                write!(
                    f,
                    "at s = {s} the path has a corner or its curvature jumps: no jerk limit holds there"
                )
            }
            Self::NoThirdDerivative => write!(f, "the path does not know its third derivative"),
            Self::State(why) => write!(f, "{why}"),
            Self::NoAnswer(why) => write!(f, "{why}"),
        }
    }
}

impl std::error::Error for MotionError {}

/// Refuses numbers that are NaN or infinite.
pub(super) fn finite(what: &'static str, values: &[f64]) -> Result<(), MotionError> {
    if values.iter().all(|v| v.is_finite()) { Ok(()) } else { Err(MotionError::NotFinite(what)) }
}

/// Refuses everything but finite numbers greater than zero.
pub(super) fn positive(what: &'static str, values: &[f64]) -> Result<(), MotionError> {
    finite(what, values)?;
    match values.iter().find(|v| **v <= 0.0) {
        Some(v) => Err(MotionError::NotPositive(what, *v)),
        None => Ok(()),
    }
}

/// Refuses a list that has not one entry a joint, or numbers that are not finite.
pub(super) fn joints(what: &'static str, expected: usize, values: &[f64]) -> Result<(), MotionError> {
    if values.len() != expected {
        return Err(MotionError::Joints { what, expected, found: values.len() });
    }
    finite(what, values)
}
