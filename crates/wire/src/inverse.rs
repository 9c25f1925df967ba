//! Configurations that bring the hand to a pose.

use crate::pose::Matrix;
use crate::{Schema, words};
use denavit::description::{Description, JointKind};
use denavit::idealise::{Ideal, Snap};
use denavit::inverse::{self, JointSpace};
use denavit::motion::follow;
use denavit_report::words::{Geometry as _, Inverse as _, Motion as _};
use serde::Serialize;
use std::collections::BTreeMap;

/// The most configurations that are listed of one solution.
pub const MOST_COPIES: usize = 1000;

/// All that was found for a pose.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Answer {
    /// The solution that is best by what was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub best: Option<Nearest>,
    /// Whether these are all.
    pub complete: bool,
    /// Why they may not be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// Where the arm can move with its hand still.
    pub families: Vec<Family>,
    /// Values of joints that are given beside the pose, by their names.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub given: BTreeMap<String, f64>,
    /// What was taken as special.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub idealised: Option<Idealised>,
    /// What the file calls the joints, where it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joints: Option<Vec<String>>,
    /// Where the pose before was followed and this one is not reached by going on: what changes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jump: Option<Jump>,
    /// Solutions and families that the limits exclude and that were left out, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out: Option<usize>,
    /// `closed form`, `elimination`, `self-motion` or `descent`.
    pub method: &'static str,
    /// The solution nearest to what was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest: Option<Nearest>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub obstacle: Option<Obstacle>,
    /// What was asked for: the tool in the base.
    pub pose: Matrix,
    /// The robot's name.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// The isolated ones.
    pub solutions: Vec<Solution>,
    /// `solved`, `unreachable` or `not found`.
    pub status: &'static str,
}

/// A configuration that has the pose.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Solution {
    /// `shoulder+ elbow−`.
    pub branch: String,
    /// The configurations within the limits that it stands for, each joint moved by whole turns; of one pose, and no more of a
    /// solution than [`MOST_COPIES`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copies: Option<Vec<Vec<f64>>>,
    /// How many these are, listed or not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copies_count: Option<u64>,
    /// How many branches coincide here.
    pub multiplicity: u32,
    /// The joint variables, angles in (−π, π].
    pub q: Vec<f64>,
    /// The distance from the pose: rotation, and position by the arm's size.
    pub residual: f64,
    /// For each joint the least and the greatest number of whole turns by which the limits allow to move it; null where they
    /// allow none of its copies.
    pub turns: Option<Vec<[i32; 2]>>,
    /// Whether the limits allow it, or a copy of it whole turns away.
    pub within_limits: bool,
}

impl Solution {
    /// A solution of an arm with these joints.
    pub fn of(s: &inverse::Solution, space: &JointSpace) -> Self {
        Solution {
            branch: s.branch.to_string(),
            copies: None,
            copies_count: None,
            multiplicity: s.multiplicity,
            q: s.q.clone(),
            residual: s.residual,
            turns: s.q.iter().enumerate().map(|(j, &x)| space.turns(j, x)).collect(),
            within_limits: s.within_limits,
        }
    }

    /// The same with its copies within the limits.
    #[must_use]
    pub fn with_copies(self, space: &JointSpace) -> Self {
        let (count, copies) = (space.copies_within(&self.q), space.listed_copies(&self.q, MOST_COPIES));
        Solution { copies: Some(copies), copies_count: Some(count), ..self }
    }
}

/// Configurations that have the pose and hang together: one of them as a [`Solution`] is, and how it goes on.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Family {
    /// Whether the joints move in these proportions everywhere.
    pub affine: bool,
    /// The branch of this one.
    pub branch: String,
    /// Members along it, where it was followed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub curve: Vec<Vec<f64>>,
    /// How many parameters it has.
    pub dimension: usize,
    /// How the joints move at this one, a unit vector.
    pub direction: Vec<f64>,
    /// The stretches of what is free within the limits, for redundant arms.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub feasible: Vec<[f64; 2]>,
    /// The unknowns that are free: `q4`, `q2 + q3 + q4`.
    pub free: Vec<String>,
    /// For one free unknown the values for which there is a solution.
    pub interval: Option<[f64; 2]>,
    /// How many branches coincide here.
    pub multiplicity: u32,
    /// The joint variables of one.
    pub q: Vec<f64>,
    /// Its distance from the pose.
    pub residual: f64,
    /// Its turns.
    pub turns: Option<Vec<[i32; 2]>>,
    /// Whether the limits allow it.
    pub within_limits: bool,
}

impl Family {
    /// A family of an arm with these joints.
    pub fn of(f: &inverse::Family, space: &JointSpace) -> Self {
        let one = Solution::of(&f.representative, space);
        Family {
            affine: f.is_affine,
            branch: one.branch,
            curve: f.curve.clone(),
            dimension: f.dimension,
            direction: f.direction.clone(),
            feasible: f.feasible.clone(),
            free: f.free.clone(),
            interval: f.interval,
            multiplicity: one.multiplicity,
            q: one.q,
            residual: one.residual,
            turns: one.turns,
            within_limits: one.within_limits,
        }
    }
}

/// The one of all solutions that was wanted.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Nearest {
    /// The largest difference of a joint from what was asked for, radians, lengths by the arm's size.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// The joint variables: whole turns from a solution, within the limits if anything is.
    pub q: Vec<f64>,
    /// Whether it is.
    pub within_limits: bool,
}

impl Nearest {
    /// The best, near to nothing.
    pub fn best(found: &inverse::Nearest) -> Self {
        Nearest { distance: None, q: found.q.clone(), within_limits: found.within_limits }
    }

    /// The nearest, with its distance.
    pub fn of(found: &inverse::Nearest) -> Self {
        Nearest { distance: Some(found.distance), ..Self::best(found) }
    }
}

/// That the joints do not go on from the solution of the pose before.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Jump {
    /// By how much that joint moves, radians or metres.
    pub by: f64,
    /// The joint that moves farthest from where it would go on to.
    pub joint: String,
    /// Whether it is the same branch, joints gone back by whole turns.
    pub same_branch: bool,
    /// What happens and why, in words.
    pub text: String,
    /// `limit`: a joint would pass it; `end`: the branch ends on the way; `nearer`: this solution is nearer.
    pub why: &'static str,
}

impl Jump {
    /// A jump of joints with these names.
    pub fn of(jump: &follow::Jump, joints: &[(String, JointKind)]) -> Self {
        Jump {
            by: jump.by,
            joint: joints[jump.joint].0.clone(),
            same_branch: jump.same_branch,
            text: words().jump(jump, joints),
            why: match jump.why {
                follow::Cause::Limit { .. } => "limit",
                follow::Cause::End(_) => "end",
                follow::Cause::Nearer => "nearer",
            },
        }
    }
}

/// What stands in the way of a pose.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Obstacle {
    /// The rotation that is missing at the nearest configuration.
    pub angle: f64,
    /// The displacement that is missing there.
    pub distance: f64,
    /// The joint variables of the nearest configuration that was found.
    pub nearest: Vec<f64>,
    /// The unknown for which no branch has a value.
    pub unknown: Option<String>,
    /// Conditions of the arm that the pose does not meet, the worst first.
    pub violated: Vec<Violated>,
}

/// A condition that is not met.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Violated {
    /// What is left instead of 0, metres or without unit.
    pub by: f64,
    /// The condition.
    pub condition: String,
}

impl From<&inverse::Obstacle> for Obstacle {
    fn from(found: &inverse::Obstacle) -> Self {
        let violated = found.violated.iter();
        Obstacle {
            angle: found.angle,
            distance: found.distance,
            nearest: found.q.clone(),
            unknown: found.unknown.clone(),
            violated: violated.map(|(c, by)| Violated { by: *by, condition: c.clone() }).collect(),
        }
    }
}

/// The special arm that was solved in place of one that is nearly special.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Idealised {
    /// What was made special.
    pub changes: Vec<Change>,
    /// By how much the hand's position differs at most over sample configurations.
    pub position_error: f64,
    /// By how much its orientation does.
    pub rotation_error: f64,
}

/// A number that was moved.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Change {
    /// The axes between which it stands.
    pub axes: [usize; 2],
    /// Its value, radians or metres.
    pub from: f64,
    /// The value taken instead.
    pub to: f64,
    /// What it is.
    pub what: String,
}

impl From<&Ideal> for Idealised {
    fn from(ideal: &Ideal) -> Self {
        let change =
            |s: &Snap| Change { axes: s.axes.into(), from: s.from, to: s.to, what: words().measured(s.what) };
        Idealised {
            changes: ideal.snaps.iter().map(change).collect(),
            position_error: ideal.position_error,
            rotation_error: ideal.rotation_error,
        }
    }
}

/// Why there may be more solutions.
pub fn doubt(answer: &inverse::Answer) -> Option<String> {
    answer.doubt.map(|doubt| words().doubt(doubt))
}

/// `solved`, `unreachable` where it is certain that there is no solution, or `not found`.
pub fn status(answer: &inverse::Answer) -> &'static str {
    match (answer.is_reachable(), answer.is_complete()) {
        (true, _) => "solved",
        (false, true) => "unreachable",
        (false, false) => "not found",
    }
}

/// The same of an answer from which so many solutions and families were left out: `outside the limits` where these were all.
pub fn status_within(answer: &inverse::Answer, left_out: Option<usize>) -> &'static str {
    let is_excluded = !answer.is_reachable() && left_out.is_some_and(|n| n > 0);
    if is_excluded { "outside the limits" } else { status(answer) }
}

/// A robot that cannot be solved in formulas.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Refused {
    /// No.
    pub complete: bool,
    /// None.
    pub families: [(); 0],
    /// Its name.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// None.
    pub solutions: [(); 0],
    /// `refused`.
    pub status: &'static str,
    /// Why.
    pub why: String,
}

impl Refused {
    /// A robot, and why.
    pub fn of(d: &Description, why: &str) -> Self {
        Refused {
            complete: false,
            families: [],
            robot: d.name.clone(),
            schema: Schema,
            solutions: [],
            status: "refused",
            why: why.into(),
        }
    }
}
