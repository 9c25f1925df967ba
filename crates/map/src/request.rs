//! What is to be computed of each row.

use crate::unit::Units;
use denavit::forward::Reference;
use denavit::geometry::Transform;
use denavit::geometry::orientation::OrientationSet;
use std::fmt;
use std::str::FromStr;

/// What is to be computed, from which columns, and how it is written.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Frames whose poses are wanted.
    pub poses: Vec<Frame>,
    /// The frame whose Jacobian is wanted, along the axes of the base.
    pub jacobian: Option<Frame>,
    /// Whether the tool's manipulability is wanted.
    pub manipulability: bool,
    /// Whether torques are wanted.
    pub torque: bool,
    /// Whether joints for poses are wanted, and which.
    pub inverse: Option<Inverse>,
    /// How orientations are written and read.
    pub orientation: Orientation,
    /// Units of columns.
    pub units: Units,
    /// Columns that are read.
    pub names: Names,
    /// What stands in front of the names of columns that are written.
    pub prefix: String,
    /// Which columns go through.
    pub keep: Keep,
}

/// A frame of the arm.
#[derive(Clone, Debug)]
pub struct Frame {
    /// What stands in front of its columns where there are several.
    pub label: String,
    /// The table's frame on which it stands.
    pub on: Reference,
    /// Where it stands there, if it is another.
    pub offset: Option<Transform<f64>>,
}

impl Frame {
    /// The tool.
    pub fn tool() -> Self {
        Frame { label: "tool".into(), on: Reference::Tool, offset: None }
    }
}

/// How joints for poses are wanted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Inverse {
    /// Which of them.
    pub solutions: Solutions,
    /// Whether what the limits exclude is left out.
    pub limits: bool,
}

/// Which solutions.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Solutions {
    /// All, as one list a row.
    Lists,
    /// All, in so many places of their own.
    Slots(usize),
    /// The one nearest to joints that a column gives.
    Nearest,
}

/// A way to write an orientation in columns.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Orientation {
    /// One of the robot's sets.
    Set(OrientationSet),
    /// The axis times the angle.
    Vector,
}

/// Which columns hold what; by their usual names otherwise.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Names {
    /// Joint variables.
    pub joints: Option<String>,
    /// Their velocities.
    pub velocities: Option<String>,
    /// Their accelerations.
    pub accelerations: Option<String>,
    /// The position of a pose.
    pub position: Option<String>,
    /// The orientation of a pose.
    pub rotation: Option<String>,
    /// The joints to which a solution is to be near.
    pub near: Option<String>,
}

/// Which columns go through to the result.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub enum Keep {
    /// All.
    #[default]
    All,
    /// These.
    Some(Vec<String>),
}

impl Default for Orientation {
    fn default() -> Self {
        Orientation::Set(OrientationSet::Matrix)
    }
}

impl Orientation {
    /// The names of its columns.
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Orientation::Vector => &["rx", "ry", "rz"],
            // Beside a position and joints their own names would mean two things.
            Orientation::Set(OrientationSet::Quaternion) => &["qx", "qy", "qz", "qw"],
            Orientation::Set(OrientationSet::AxisAngle) => &["ax", "ay", "az", "angle"],
            Orientation::Set(set) => set.names(),
        }
    }

    /// Whether the column of this number is an angle.
    pub(crate) fn is_angle(self, number: usize) -> bool {
        match self {
            Orientation::Vector | Orientation::Set(OrientationSet::Rpy | OrientationSet::Euler(_)) => true,
            Orientation::Set(OrientationSet::AxisAngle) => number == 3,
            Orientation::Set(OrientationSet::Matrix | OrientationSet::Quaternion) => false,
        }
    }
}

impl FromStr for Orientation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if ["rotation-vector", "rotvec"].iter().any(|name| text.eq_ignore_ascii_case(name)) {
            return Ok(Orientation::Vector);
        }
        text.parse().map(Orientation::Set).map_err(|why| format!("{why}, rotation-vector"))
    }
}

impl fmt::Display for Orientation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Orientation::Set(set) => set.fmt(f),
            Orientation::Vector => f.write_str("rotation-vector"),
        }
    }
}
