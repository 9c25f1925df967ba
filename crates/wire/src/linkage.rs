//! Closed loops: the ways to assemble them, and how they move.

use crate::Schema;
use crate::pose::{Matrix, matrix};
use denavit::closure::{Assembly, ClosedAnswer, ClosedSolution};
use denavit::geometry::Transform;
use serde::Serialize;

/// All ways to close a linkage that were found where its driven joints are.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Assemblies<'a> {
    /// In the order of their modes.
    pub assemblies: Vec<Assembled>,
    /// The frame whose poses these are.
    pub frame: &'a str,
    /// The driven joints, q1 first, radians and metres.
    pub joints: &'a [f64],
    /// How many modes there are: those that were asked for, or all.
    pub modes: usize,
    /// Its name.
    pub robot: &'a str,
    /// The version.
    pub schema: Schema,
    /// How many modes were tried.
    pub tried: usize,
    /// Modes of those that are neither closed nor open: closed in infinitely many ways or not at all, or not found.
    pub undecided: Vec<String>,
}

/// One way to close a linkage.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Assembled {
    /// Loops, counted from 1, at which this mode meets another one.
    pub meets: Vec<usize>,
    /// Its signs.
    pub mode: String,
    /// Whether a part was found by Newton's method, so that there may be others.
    pub numeric: bool,
    /// The passive joints, p1 first, radians and metres.
    pub passive: Vec<f64>,
    /// The pose of the frame in the base.
    pub pose: Matrix,
    /// How far the frames of a closure are apart.
    pub residual: f64,
}

impl Assembled {
    /// One with the pose of a frame.
    pub fn of(a: &Assembly, pose: &Transform<f64>) -> Self {
        Assembled {
            meets: a.flat.iter().map(|k| k + 1).collect(),
            mode: a.mode.to_string(),
            numeric: a.is_numeric,
            passive: a.passive.clone(),
            pose: matrix(pose),
            residual: a.residual,
        }
    }
}

/// How the passive joints and a frame of a linkage move with its driven joints.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ClosedRates<'a> {
    /// The frame.
    pub frame: &'a str,
    /// How many motions passive joints have with the driven ones at rest.
    pub free: usize,
    /// J of the frame's origin along the axes of the base, 6 rows; null where passive motions are free.
    pub jacobian: Option<Vec<Vec<f64>>>,
    /// The driven joints, q1 first.
    pub joints: &'a [f64],
    /// The mode.
    pub mode: String,
    /// The passive joints, p1 first.
    pub passive: &'a [f64],
    /// G, by rows: how fast each passive joint moves with each driven one; null where passive motions are free.
    pub passive_rates: Option<Vec<Vec<f64>>>,
    /// The rank of J; null where there is none.
    pub rank: Option<usize>,
    /// Its name.
    pub robot: &'a str,
    /// The version.
    pub schema: Schema,
}

/// What was found of the inverse problem of a linkage.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Reached<'a> {
    /// Whether the solutions are by formulas alone.
    pub closed_form: bool,
    /// Whether these are all.
    pub complete: bool,
    /// The frame that is to be there.
    pub frame: &'a str,
    /// `pose` or `position`.
    pub goal: &'static str,
    /// Whether the pose is out of the plane in which the frame moves.
    pub out_of_plane: bool,
    /// The pose.
    pub pose: Matrix,
    /// Its name.
    pub robot: &'a str,
    /// The version.
    pub schema: Schema,
    /// The solutions.
    pub solutions: Vec<Reaching>,
}

/// A configuration of a linkage in which a frame is where it is wanted.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Reaching {
    /// The driven joints, q1 first, radians and metres.
    pub joints: Vec<f64>,
    /// The assembly mode; null where it was not told.
    pub mode: Option<String>,
    /// The passive joints, p1 first.
    pub passive: Vec<f64>,
    /// How far closures are open, and the frame is off.
    pub residual: f64,
    /// Whether it is not isolated: singular, or one of a family.
    pub singular: bool,
}

impl<'a> Reached<'a> {
    /// An answer for a frame of a linkage.
    pub fn of(
        robot: &'a str,
        frame: &'a str,
        goal: &'static str,
        pose: &Transform<f64>,
        answer: &ClosedAnswer,
    ) -> Self {
        let one = |s: &ClosedSolution| Reaching {
            joints: s.q.clone(),
            mode: s.mode.as_ref().map(ToString::to_string),
            passive: s.passive.clone(),
            residual: s.residual,
            singular: s.is_singular,
        };
        Reached {
            closed_form: answer.is_closed_form,
            complete: answer.is_complete,
            frame,
            goal,
            out_of_plane: answer.is_out_of_plane,
            pose: matrix(pose),
            robot,
            schema: Schema,
            solutions: answer.solutions.iter().map(one).collect(),
        }
    }
}
