//! Parallel robots: their geometry, poses, drives and singularities.

use crate::Schema;
use crate::pose::{Matrix, Orientation, matrix};
use denavit::description::parallel::{DeltaDrive, Family};
use denavit_parallel::rates::{Gained, Motion, Rates, Singular};
use denavit_parallel::{Assemblies, Known};
use serde::Serialize;

/// A robot as its file has it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Shown<'a> {
    /// What its drives are called.
    pub drives: Vec<String>,
    /// Metres and radians.
    pub geometry: Geometry,
    /// `gough-stewart`, `delta` or `planar-3rrr`.
    pub kind: &'static str,
    /// The least and the greatest value: of all drives, or of each; none where the file has none.
    pub limits: Vec<[f64; 2]>,
    /// The names of its poses.
    pub poses: Vec<&'a str>,
    /// Its name.
    pub robot: &'a str,
    /// The version.
    pub schema: Schema,
    /// Where its numbers come from.
    pub source: Option<&'a str>,
}

/// The geometry of a family, by the keys of its files.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(untagged)]
pub enum Geometry {
    /// A Stewart platform.
    Stewart {
        /// Six points.
        base: [[f64; 3]; 6],
        /// Six points.
        platform: [[f64; 3]; 6],
    },
    /// A delta.
    Delta {
        /// Around z.
        angles: [f64; 3],
        /// To the axes of the arms.
        base_radius: f64,
        /// The rods.
        lower_arm: f64,
        /// To the rods.
        platform_radius: f64,
        /// Of one that slides.
        #[serde(skip_serializing_if = "Option::is_none")]
        slope: Option<f64>,
        /// Of one that turns.
        #[serde(skip_serializing_if = "Option::is_none")]
        upper_arm: Option<f64>,
    },
    /// A planar 3-RRR robot.
    Planar {
        /// Three points.
        base: [[f64; 2]; 3],
        /// The links behind those that are driven.
        distal: [f64; 3],
        /// Three points.
        platform: [[f64; 2]; 3],
        /// The links that are driven.
        proximal: [f64; 3],
    },
}

impl From<&Family<f64>> for Geometry {
    fn from(family: &Family<f64>) -> Self {
        match *family {
            Family::Stewart { base, platform } => {
                Geometry::Stewart { base: base.map(|p| p.0), platform: platform.map(|p| p.0) }
            }
            Family::Delta { base_radius, platform_radius, lower_arm, angles, drive } => {
                let (upper_arm, slope) = match drive {
                    DeltaDrive::Turns(arm) => (Some(arm), None),
                    DeltaDrive::Slides(slope) => (None, Some(slope)),
                };
                Geometry::Delta { angles, base_radius, lower_arm, platform_radius, slope, upper_arm }
            }
            Family::Planar3Rrr { base, platform, proximal, distal } => {
                Geometry::Planar { base, distal, platform, proximal }
            }
        }
    }
}

/// All poses for drives that were found.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Placed<'a> {
    /// By their modes.
    pub assemblies: Vec<Assembled>,
    /// Whether there are no others, proved.
    pub complete: bool,
    /// The family.
    pub kind: &'static str,
    /// Of a Stewart platform: how many of forty paths ended in no solution that is proved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lost: Option<usize>,
    /// How many poses there can be.
    pub most: usize,
    /// The drives, metres or radians.
    pub q: &'a [f64],
    /// Its name.
    pub robot: &'a str,
    /// The version.
    pub schema: Schema,
    /// Of a Stewart platform: how many different solutions are proved, complex ones included.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solutions: Option<usize>,
    /// Whether the drives are within their limits, where there are some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within_limits: Option<bool>,
}

/// A pose.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Assembled {
    /// A number or a sign.
    pub mode: String,
    /// Where a set of values was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation: Option<Orientation>,
    /// In the base.
    pub pose: Matrix,
    /// Whether it is proved that there is a solution here, and no second one near it; null where a closed form has it.
    pub proved: Option<bool>,
    /// By how much a leg is open at most, metres.
    pub residual: f64,
}

impl<'a> Placed<'a> {
    /// What was found for drives.
    pub fn of(
        (robot, kind): (&'a str, &'static str),
        q: &'a [f64],
        (found, is_complete): (&Assemblies, bool),
        within_limits: Option<bool>,
        orientation: impl Fn(&denavit::geometry::Transform<f64>) -> Option<Orientation>,
    ) -> Self {
        let proves = !matches!(found.known, Known::ClosedForm | Known::OnALine);
        let (solutions, lost) = match found.known {
            Known::Paths { proved, lost, .. } => (Some(proved), Some(lost)),
            _ => (None, None),
        };
        let one = |a: &denavit_parallel::Assembly| Assembled {
            mode: a.mode.clone(),
            orientation: orientation(&a.pose),
            pose: matrix(&a.pose),
            proved: proves.then_some(a.is_proved),
            residual: a.residual,
        };
        Placed {
            assemblies: found.all.iter().map(one).collect(),
            complete: is_complete,
            kind,
            lost,
            most: found.most(),
            q,
            robot,
            schema: Schema,
            solutions,
            within_limits,
        }
    }
}

/// Drives for a pose.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Solved<'a> {
    /// The family.
    pub kind: &'static str,
    /// How many were left out by `--limits`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out: Option<usize>,
    /// The pose.
    pub pose: Matrix,
    /// Its name.
    pub robot: &'a str,
    /// The version.
    pub schema: Schema,
    /// All of them.
    pub solutions: Vec<Drives>,
    /// `solved`, `unreachable` or `outside the limits`.
    pub status: &'static str,
    /// The leg that does not reach.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unreached: Option<Unreached>,
}

/// One solution.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Drives {
    /// A sign for each leg.
    pub mode: String,
    /// Metres or radians.
    pub q: Vec<f64>,
    /// By how much a leg is open at most, metres.
    pub residual: f64,
    /// Where there are limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within_limits: Option<bool>,
}

/// A leg that does not reach.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Unreached {
    /// By how many metres it is too short or too long.
    pub by: f64,
    /// Counted from 1.
    pub leg: usize,
}

/// How the platform moves with its drives at a pose.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Moving<'a> {
    /// The largest singular value by the smallest; null where a motion is gained.
    pub condition: f64,
    /// Motions with all drives at rest.
    pub gained: Vec<Moved>,
    /// The diagonal of J_q.
    pub j_q: &'a [f64],
    /// J_x by rows, one a leg.
    pub j_x: &'a [Vec<f64>],
    /// J_x⁻¹ J_q by rows; null where a motion is gained.
    pub jacobian: Option<Vec<Vec<f64>>>,
    /// The family.
    pub kind: &'static str,
    /// By which moments are divided, metres; not there where the platform does not turn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// The assembly mode, or the name of the pose.
    pub mode: &'a str,
    /// The pose.
    pub pose: Matrix,
    /// The drives.
    pub q: &'a [f64],
    /// Its name.
    pub robot: &'a str,
    /// What the velocity of the platform is made of.
    pub rows: &'static [&'static str],
    /// The version.
    pub schema: Schema,
    /// Legs, counted from 1, whose drives move with the platform at rest.
    pub serial: Vec<usize>,
    /// Of J_x, descending.
    pub singular_values: Vec<f64>,
    /// The motion that the legs hold least.
    pub weakest: Moved,
}

/// A motion of the platform: a shift along `direction`, or a turn about the axis through `point`.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Moved {
    /// A unit vector.
    pub direction: [f64; 3],
    /// Metres a radian along the axis; not there where nothing turns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch: Option<f64>,
    /// The point of the axis nearest to the platform's origin; not there where nothing turns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<[f64; 3]>,
}

impl From<&Gained> for Moved {
    fn from(gained: &Gained) -> Self {
        match gained {
            Gained::Translation(v) => Moved { direction: v.0, pitch: None, point: None },
            Gained::Screw { axis, point, pitch } => {
                Moved { direction: axis.0, pitch: Some(*pitch), point: Some(point.0) }
            }
        }
    }
}

/// The names of the entries of a platform's velocity.
pub fn rows(motion: Motion) -> &'static [&'static str] {
    match motion {
        Motion::Space => &["vx", "vy", "vz", "wx", "wy", "wz"],
        Motion::Translation => &["vx", "vy", "vz"],
        Motion::Plane => &["vx", "vy", "wz"],
    }
}

impl<'a> Moving<'a> {
    /// What holds at a pose with these drives.
    pub fn of(
        (robot, kind, mode): (&'a str, &'static str, &'a str),
        pose: &denavit::geometry::Transform<f64>,
        q: &'a [f64],
        rates: &'a Rates,
        singular: &Singular,
    ) -> Self {
        Moving {
            condition: singular.condition(),
            gained: singular.gained.iter().map(Moved::from).collect(),
            j_q: &rates.drives,
            j_x: &rates.platform,
            jacobian: rates.forward(),
            kind,
            length: (rates.motion != Motion::Translation).then_some(rates.length),
            mode,
            pose: matrix(pose),
            q,
            robot,
            rows: rows(rates.motion),
            schema: Schema,
            serial: singular.serial.iter().map(|i| i + 1).collect(),
            singular_values: singular.values.clone(),
            weakest: Moved::from(&singular.weakest),
        }
    }
}
