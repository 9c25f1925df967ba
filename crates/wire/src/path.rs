//! Paths: what was met on the way, and the motion in samples.

use crate::pose::Matrix;
use crate::{Schema, words};
use denavit::description::Description;
use denavit::motion::follow::{self, Alternative, EventKind};
use denavit::motion::plan::{self, Planned};
use denavit_report::words::{Motion as _, Velocity as _};
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use serde::Serialize;

/// A path.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Path {
    /// For a path of the hand: whether all singular configurations on the way are listed, by the signs of the determinant's
    /// factors or by the clearance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub certified: Option<bool>,
    /// How near the path comes to a singular configuration, where no factors tell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance: Option<Clearance>,
    /// How far the hand leaves its path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deviation: Option<Deviation>,
    /// Seconds.
    pub duration: f64,
    /// What a path of the hand meets, in order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub events: Option<Vec<Event>>,
    /// The greatest parts of their limits that the motion takes, where jerks or torques are limited along a path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held: Option<Held>,
    /// What path it is, in words.
    pub path: String,
    /// The part of the hand's path that could be followed, 1 if all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reached: Option<f64>,
    /// The robot's name.
    pub robot: String,
    /// The motion at regular times.
    pub samples: Vec<Sample>,
    /// The version.
    pub schema: Schema,
    /// Configurations in which a path of the hand can start.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub starts: Vec<Start>,
    /// How it was timed, in words.
    pub timing: String,
}

/// How near a path comes to a singular configuration.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Clearance {
    /// The joint variables there.
    pub q: Vec<f64>,
    /// Where it is nearest, from 0 to 1.
    pub s: f64,
    /// The smallest singular value of the Jacobian there, lengths by the reach.
    pub smallest: f64,
}

/// The greatest parts of their limits that a motion takes, 1 at the limit.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Held {
    /// Of accelerations, if they are limited.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<f64>,
    /// At so many instants it was looked at.
    pub instants: usize,
    /// Of jerks, if they are limited.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jerk: Option<f64>,
    /// Of torques, if they are limited.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque: Option<f64>,
    /// Of velocities.
    pub velocity: f64,
}

impl From<plan::Held> for Held {
    fn from(held: plan::Held) -> Self {
        let plan::Held { instants, velocity, acceleration, jerk, torque } = held;
        Held { acceleration, instants, jerk, torque, velocity }
    }
}

/// A moment of a motion.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Sample {
    /// Of the joints.
    pub acceleration: Vec<f64>,
    /// √det(J Jᵀ) of the tool, lengths by the arm's size.
    pub manipulability: f64,
    /// The tool in the base.
    pub pose: Matrix,
    /// The joint variables.
    pub q: Vec<f64>,
    /// Seconds.
    pub t: f64,
    /// Of the joints.
    pub velocity: Vec<f64>,
}

/// How far the hand leaves its path at most.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Deviation {
    /// The rotation.
    pub angle: f64,
    /// The displacement.
    pub position: f64,
}

/// Something that is met on the way.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Event {
    /// Whether the factor of a singular configuration changes its sign.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crossed: Option<bool>,
    /// The factor of the determinant that is 0, null if it is none that is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub factor: Option<Option<String>>,
    /// The joint that leaves its limits or enters them again.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<usize>,
    /// `singular`, `limit`, `within_limits` or `end`.
    pub kind: &'static str,
    /// The limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
    /// The joint variables there.
    pub q: Vec<f64>,
    /// Whether the hand can go on in another branch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reachable: Option<bool>,
    /// The part of the way, from 0 to 1.
    pub s: f64,
    /// How the axes lie, null if that is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<Option<String>>,
}

/// `singular`, `limit`, `within_limits` or `end`.
pub fn kind(of: &EventKind) -> &'static str {
    match of {
        EventKind::Singular { .. } => "singular",
        EventKind::Limit { .. } => "limit",
        EventKind::WithinLimits { .. } => "within_limits",
        EventKind::End { .. } => "end",
    }
}

impl Event {
    /// An event on a path of a robot.
    pub fn of(d: &Description, e: &follow::Event) -> Self {
        let text = |factor: &Option<Expr>| factor.map(|f| print(f, &d.vocabulary(), Style::Ascii));
        let why = |place: &Option<_>| place.as_ref().map(|p| words().place(p));
        let mut event = Event {
            crossed: None,
            factor: None,
            joint: None,
            kind: kind(&e.kind),
            limit: None,
            q: e.q.clone(),
            reachable: None,
            s: e.s,
            why: None,
        };
        match &e.kind {
            EventKind::Singular { factor, place, crossed } => {
                event.crossed = Some(*crossed);
                event.factor = Some(text(factor));
                event.why = Some(why(place));
            }
            EventKind::Limit { joint, limit } => {
                event.joint = Some(joint + 1);
                event.limit = Some(*limit);
            }
            EventKind::WithinLimits { joint } => event.joint = Some(joint + 1),
            EventKind::End { reachable, factor, place } => {
                event.reachable = Some(*reachable);
                event.factor = Some(text(factor));
                event.why = Some(why(place));
            }
        }
        event
    }
}

/// A configuration in which a path can start, and what comes of it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Start {
    /// `shoulder+ elbow−`.
    pub branch: String,
    /// The joint variables.
    pub q: Vec<f64>,
    /// The part of the path that it follows, 1 if all.
    pub reached: f64,
    /// Singular configurations on the way.
    pub singular: usize,
    /// Whether it stays within the limits.
    pub within_limits: bool,
}

impl From<&Alternative> for Start {
    fn from(a: &Alternative) -> Self {
        Start {
            branch: a.branch.to_string(),
            q: a.start.clone(),
            reached: a.reached,
            singular: a.singular,
            within_limits: a.within_limits,
        }
    }
}

impl Path {
    /// A plan with its samples.
    pub fn of(d: &Description, planned: &Planned, samples: Vec<Sample>) -> Self {
        let followed = planned.followed.as_ref();
        Path {
            certified: followed.map(|f| f.certified),
            clearance: followed.and_then(|f| f.clearance.as_ref()).map(|c| Clearance {
                q: c.q.clone(),
                s: c.s,
                smallest: c.smallest,
            }),
            deviation: followed.map(|f| Deviation { angle: f.turned, position: f.deviation }),
            duration: planned.trajectory.duration(),
            events: followed.map(|f| f.events.iter().map(|e| Event::of(d, e)).collect()),
            held: planned.timing.held.map(Held::from),
            path: words().course(&planned.course),
            reached: followed.map(|f| f.reached),
            robot: d.name.clone(),
            samples,
            schema: Schema,
            starts: planned.alternatives.iter().map(Start::from).collect(),
            timing: words().timing(&planned.timing, d),
        }
    }
}
