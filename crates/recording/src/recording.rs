//! Columns of numbers with names, and which of them are the time, the joints and the pose.

/// In what a column is said to be, by its header.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Said {
    /// Radians.
    Radians,
    /// Degrees.
    Degrees,
    /// Metres.
    Metres,
    /// Centimetres.
    Centimetres,
    /// Millimetres.
    Millimetres,
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
    /// Microseconds.
    Microseconds,
    /// Nanoseconds.
    Nanoseconds,
}

impl Said {
    /// What one is in radians, metres or seconds.
    pub fn si(self) -> f64 {
        match self {
            Said::Radians | Said::Metres | Said::Seconds => 1.0,
            Said::Degrees => 1_f64.to_radians(),
            Said::Centimetres => 1e-2,
            Said::Millimetres | Said::Milliseconds => 1e-3,
            Said::Microseconds => 1e-6,
            Said::Nanoseconds => 1e-9,
        }
    }

    /// Whether it is a unit of time.
    pub fn is_time(self) -> bool {
        matches!(self, Said::Seconds | Said::Milliseconds | Said::Microseconds | Said::Nanoseconds)
    }

    /// As a header says it.
    pub fn symbol(self) -> &'static str {
        match self {
            Said::Radians => "rad",
            Said::Degrees => "deg",
            Said::Metres => "m",
            Said::Centimetres => "cm",
            Said::Millimetres => "mm",
            Said::Seconds => "s",
            Said::Milliseconds => "ms",
            Said::Microseconds => "us",
            Said::Nanoseconds => "ns",
        }
    }

    /// By the text between the brackets of a header.
    pub fn named(text: &str) -> Option<Self> {
        Some(match text.trim().to_lowercase().as_str() {
            "rad" | "radian" | "radians" => Said::Radians,
            "deg" | "degree" | "degrees" | "°" => Said::Degrees,
            "m" | "meter" | "meters" | "metre" | "metres" => Said::Metres,
            "cm" => Said::Centimetres,
            "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => Said::Millimetres,
            "s" | "sec" | "second" | "seconds" => Said::Seconds,
            "ms" => Said::Milliseconds,
            "us" | "µs" | "μs" => Said::Microseconds,
            "ns" => Said::Nanoseconds,
            _ => return None,
        })
    }
}

/// A column.
#[derive(Clone, PartialEq, Debug)]
pub struct Column {
    /// Its name, without its unit.
    pub name: String,
    /// The unit that its header says.
    pub said: Option<Said>,
    /// Its numbers; not a number where one is missing.
    pub values: Vec<f64>,
}

impl Column {
    /// With what its header says of its unit; a unit that is none stays in the name.
    pub fn new(name: String, unit: Option<&str>, values: Vec<f64>) -> Self {
        let said = unit.and_then(Said::named);
        let name = match (unit, said) {
            (Some(unit), None) => format!("{name}[{unit}]"),
            _ => name,
        };
        Column { name, said, values }
    }
}

/// A recording: columns of one length.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Recording {
    /// Its columns.
    pub columns: Vec<Column>,
}

/// Which columns are what, by their numbers from 0.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Roles {
    /// The time.
    pub time: Option<usize>,
    /// The number of the episode.
    pub episode: Option<usize>,
    /// The joints, and what may stand among them.
    pub joints: Vec<usize>,
    /// The position of the hand: three.
    pub position: Vec<usize>,
    /// How it is turned: three, four, six or nine.
    pub rotation: Vec<usize>,
}

/// Why columns cannot be held against a robot.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum HoldError {
    /// Too few columns for the joints.
    Joints {
        /// How many there are.
        found: usize,
        /// How many joints the robot has.
        needed: usize,
    },
    /// Too many columns for the joints: which of them to leave out would have to be tried in too many ways.
    TooManyJoints {
        /// How many there are.
        found: usize,
        /// How many joints the robot has.
        needed: usize,
    },
    /// Not three columns of a position.
    Position(usize),
    /// Columns that are no orientation by their number.
    Rotation(usize),
    /// The columns of the orientation hold none in any format: the first row that is none.
    NoOrientation(usize),
    /// Too few rows in which everything is a number.
    Rows {
        /// How many there are.
        whole: usize,
        /// How many rows there are in all.
        all: usize,
    },
    /// A parameter of the robot has no value.
    Value(String),
    /// Columns of different lengths.
    Lengths,
}

impl std::fmt::Display for HoldError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            HoldError::Joints { found, needed } => {
                write!(f, "the robot has {needed} joints, and {found} columns are taken for joints")
            }
            HoldError::TooManyJoints { found, needed } => {
                write!(
                    f,
                    "{found} columns are taken for the {needed} joints of the robot: too many to try which are none"
                )
            }
            HoldError::Position(found) => write!(f, "a position is three columns, not {found}"),
            HoldError::Rotation(found) => write!(f, "an orientation is 3, 4, 6 or 9 columns, not {found}"),
            HoldError::NoOrientation(row) => {
                write!(f, "the columns of the orientation are none in any format, first in row {}", row + 1)
            }
            HoldError::Rows { whole, all } => {
                write!(
                    f,
                    "{whole} of {all} rows have a number in every column that is needed; at least {LEAST} are"
                )
            }
            HoldError::Value(text) => f.write_str(text),
            HoldError::Lengths => f.write_str("the columns have different lengths"),
        }
    }
}

impl std::error::Error for HoldError {}

/// How many rows are needed.
pub const LEAST: usize = 8;
