//! What is special about an arm: which axes are parallel, meet, or form a spherical wrist.
//!
//! Decided exactly, for whatever lengths and joint values: axes count as parallel or meeting only if they are so
//! by their formulas. Axes that are nearly so in numbers are reported apart.

use crate::description::{Description, JointKind};
use crate::geometry::Transform;
use crate::mechanism::{Lengths, MovingAxes, Robot};
use denavit_symbolic::{Expr, readable};

/// How an axis lies to the one before it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Relation {
    /// The same line.
    Coincident,
    /// Parallel, at a distance.
    Parallel,
    /// They meet at a right angle.
    MeetPerpendicular,
    /// They meet at another angle.
    Meet,
    /// At a right angle, at a distance.
    Perpendicular,
    /// Neither parallel nor meeting.
    Skew,
    /// At a right angle; one of the two slides, which has a direction but no place.
    PerpendicularDirections,
    /// Neither parallel nor perpendicular; one of the two slides.
    ObliqueDirections,
}

impl Relation {
    /// The sign used in a schematic: `∥`, `⟂`, `∠`, ….
    pub fn sign(self) -> &'static str {
        match self {
            Relation::Coincident => "≡",
            Relation::Parallel => "∥",
            Relation::MeetPerpendicular | Relation::Perpendicular | Relation::PerpendicularDirections => "⟂",
            Relation::Meet | Relation::Skew | Relation::ObliqueDirections => "∠",
        }
    }
}

/// What two axes can be, with nothing rounded.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Special {
    /// On one line.
    Coincident,
    /// Parallel.
    Parallel,
    /// At right angles.
    Perpendicular,
    /// In one plane, not parallel.
    Meeting,
}

impl Special {
    /// The word of the JSON form.
    pub fn name(self) -> &'static str {
        match self {
            Special::Coincident => "coincident",
            Special::Parallel => "parallel",
            Special::Perpendicular => "perpendicular",
            Special::Meeting => "meeting",
        }
    }
}

/// A pair of consecutive axes that is nearly special, in numbers.
#[derive(Clone, PartialEq, Debug)]
pub struct NearlySpecial {
    /// The joints, from 1.
    pub joints: (usize, usize),
    /// What they nearly are.
    pub nearly: Special,
    /// By how much they miss it (radians or metres).
    pub by: f64,
    /// True if `by` is an angle.
    pub is_angle: bool,
}

/// What is special about an arm.
#[derive(Clone, Debug)]
pub struct Structure {
    /// The kind of each joint.
    pub joints: Vec<JointKind>,
    /// The relation of axes k and k+1.
    pub relations: Vec<Relation>,
    /// Runs of two or more revolute joints whose axes stay parallel (joint numbers from 1).
    pub parallel: Vec<Vec<usize>>,
    /// Triples of consecutive revolute axes that meet in one point (number of the first joint).
    pub spherical: Vec<usize>,
    /// Pairs that are nearly special but not exactly.
    pub nearly: Vec<NearlySpecial>,
}

/// Angles and ratios of lengths below this, and not 0, are "nearly special".
const NEARLY: f64 = 1e-2;

impl Structure {
    /// Analyses a description.
    pub fn of(description: &Description) -> Self {
        let joints: Vec<JointKind> = description.variables().iter().map(|v| v.kind).collect();
        let between = between_joints(description);
        let mut relations = vec![];
        let mut meeting = vec![];
        for (k, x) in between.iter().enumerate() {
            let sliding = joints[k] == JointKind::Prismatic || joints[k + 1] == JointKind::Prismatic;
            let (relation, place) = relate(x, sliding);
            relations.push(relation);
            meeting.push(place);
        }
        let turns = |k: usize| joints[k] == JointKind::Revolute;
        let spherical = (0..between.len().saturating_sub(1))
            .filter(|&k| turns(k) && turns(k + 1) && turns(k + 2))
            .filter(|&k| match (&meeting[k], &meeting[k + 1]) {
                (Some((_, on_second)), Some((on_first, _))) => is_zero(*on_second - *on_first),
                _ => false,
            })
            .map(|k| k + 1)
            .collect();
        Structure {
            parallel: parallel_runs(&joints, &relations),
            nearly: nearly_special(description, &between, &relations),
            spherical,
            joints,
            relations,
        }
    }

    /// The arm in one line: `R1 ⟂ R2 ∥ R3 ⟂ R4 ⟂ R5 ⟂ R6`.
    pub fn schematic(&self) -> String {
        let mut line = String::new();
        for (k, kind) in self.joints.iter().enumerate() {
            let letter = if *kind == JointKind::Revolute { 'R' } else { 'P' };
            if k > 0 {
                line += &format!(" {} ", self.relations[k - 1].sign());
            }
            line += &format!("{letter}{}", k + 1);
        }
        line
    }
}

fn parallel_runs(joints: &[JointKind], relations: &[Relation]) -> Vec<Vec<usize>> {
    let mut runs: Vec<Vec<usize>> = vec![];
    let mut run: Vec<usize> = vec![];
    for (k, kind) in joints.iter().enumerate() {
        let continues = k > 0 && matches!(relations[k - 1], Relation::Parallel | Relation::Coincident);
        if !continues {
            runs.push(std::mem::take(&mut run));
        }
        if *kind == JointKind::Revolute {
            run.push(k + 1);
        }
    }
    runs.push(run);
    runs.retain(|r| r.len() > 1);
    runs
}

/// The transform from the frame behind joint k's motion to the frame before joint k+1's; axes between them that follow other joints
/// make it depend on these.
fn between_joints(description: &Description) -> Vec<Transform<Expr>> {
    let axes = MovingAxes::new(&Robot::symbolic(description), Lengths::Behind);
    let mut found: Vec<Transform<Expr>> = vec![];
    let mut current: Option<Transform<Expr>> = None;
    let q: Vec<Expr> = description.variables().iter().map(|v| v.symbol.into()).collect();
    for (axis, constant) in axes.moving.iter().zip(&axes.constants) {
        let before = current.map(|x| x * *constant);
        let is_own = description.rows[axis.row].variable.is_some_and(|v| v.kind == axis.kind);
        found.extend(before.filter(|_| is_own));
        // Its own motion leaves a joint's axis where it is.
        current = match is_own {
            true => Some(axis.at_rest()),
            false => before.map(|x| x * axis.at(&q)),
        };
    }
    found.iter().map(|x| x.map(readable::settled)).collect()
}

/// How the z axis of a frame lies to the z axis it is given from, and where the two meet: the coordinate of the
/// common point along the first and along the second.
fn relate(x: &Transform<Expr>, sliding: bool) -> (Relation, Option<(Expr, Expr)>) {
    let (z, p) = (x.rotation.z(), x.translation);
    if z[0].is_zero() && z[1].is_zero() {
        let same = p[0].is_zero() && p[1].is_zero();
        return (if same && !sliding { Relation::Coincident } else { Relation::Parallel }, None);
    }
    let perpendicular = z[2].is_zero();
    // The common normal has the length p·(e_z × z) / |e_z × z|.
    let meets = !sliding && is_zero(p[1] * z[0] - p[0] * z[1]);
    let relation = match (meets, perpendicular) {
        _ if sliding && perpendicular => Relation::PerpendicularDirections,
        _ if sliding => Relation::ObliqueDirections,
        (true, true) => Relation::MeetPerpendicular,
        (true, false) => Relation::Meet,
        (false, true) => Relation::Perpendicular,
        (false, false) => Relation::Skew,
    };
    let along_second = if z[0].is_zero() { -p[1] / z[1] } else { -p[0] / z[0] };
    (relation, meets.then(|| (p[2] + along_second * z[2], along_second)))
}

fn nearly_special(
    description: &Description,
    between: &[Transform<Expr>],
    relations: &[Relation],
) -> Vec<NearlySpecial> {
    let number = |e: Expr| e.eval(|s| description.value(s)).unwrap_or(f64::NAN);
    let reach = Robot::numeric(description).map_or(f64::NAN, |robot| robot.reach());
    let mut found = vec![];
    for (k, (x, relation)) in between.iter().zip(relations).enumerate() {
        let (z, p) = (x.rotation.z().map(number), x.translation.map(number));
        let across = z[0].hypot(z[1]);
        let mut report = |nearly, by: f64, scale: f64, is_angle| {
            if by != 0.0 && by.abs() < NEARLY * scale {
                found.push(NearlySpecial { joints: (k + 1, k + 2), nearly, by: by.abs(), is_angle });
            }
        };
        match relation {
            Relation::Coincident => {}
            Relation::Parallel => report(Special::Coincident, p[0].hypot(p[1]), reach, false),
            _ => {
                report(Special::Parallel, across, 1.0, true);
                report(Special::Perpendicular, z[2].asin(), 1.0, true);
                if matches!(relation, Relation::Perpendicular | Relation::Skew) && across > NEARLY {
                    report(Special::Meeting, (p[1] * z[0] - p[0] * z[1]) / across, reach, false);
                }
            }
        }
    }
    found
}

fn is_zero(e: Expr) -> bool {
    readable::settled(e).is_zero()
}
