//! Why columns are no measurements of an arm.

use denavit_recording::{Held, HoldError};

/// The most planes or centres.
pub const MOST_GROUPS: usize = 24;

/// Why columns are no measurements.
#[derive(Clone, Debug)]
pub enum NoMeasurements {
    /// The recording has a slip: these are in it.
    Slips(Box<Held>),
    /// The columns cannot be held against the arm.
    Hold(HoldError),
    /// A column is missing: what it is for.
    Column(&'static str),
    /// Too few rows are whole: how many, of how many.
    Rows(usize, usize),
    /// The measurements do not follow from these joints: what is left over in the best case, metres or radians, and what would
    /// mend it.
    Far(f64, bool, Option<&'static str>),
    /// The orientation is none in any format.
    NoOrientation,
    /// A recipe is for full poses.
    Recipe,
    /// So many planes or centres are too many.
    Groups(usize),
}

impl std::fmt::Display for NoMeasurements {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NoMeasurements::Slips(_) => f.write_str("the recording has a slip"),
            NoMeasurements::Hold(e) => write!(f, "{e}"),
            NoMeasurements::Column(what) => write!(f, "which column is the {what} has to be said"),
            NoMeasurements::Rows(whole, all) => {
                write!(
                    f,
                    "{whole} of {all} rows have a number in every column that is needed; at least 6 are"
                )
            }
            NoMeasurements::Far(by, is_turn, hint) => {
                let by = if *is_turn {
                    format!("{:.1}°", by.to_degrees())
                } else {
                    format!("{:.0} mm", 1e3 * by)
                };
                write!(f, "the measurements do not follow from these joints: {by} are left over")?;
                match hint {
                    Some(hint) => write!(f, "\n  = hint: they would if {hint}"),
                    None => Ok(()),
                }
            }
            NoMeasurements::NoOrientation => f.write_str("the orientation is none in any format"),
            NoMeasurements::Recipe => f.write_str("a recipe is for full poses"),
            NoMeasurements::Groups(count) => {
                write!(f, "{count} planes or centres are told apart, more than {MOST_GROUPS}")
            }
        }
    }
}

impl std::error::Error for NoMeasurements {}
