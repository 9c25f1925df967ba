//! What is measured and what is estimated, and how far numbers are usually off.

use crate::measurement::Reading;
use crate::model::{Parameter, Problem, State};

/// How far a turn and a shift of a link are usually off at most: radians, metres. Where the arm stands and what it holds may be
/// off by ten times as much, a gain by 2 %.
pub const PRIOR: [f64; 2] = [0.017_453_292_519_943_295, 0.01];
const FRAMES: f64 = 10.0;
const GAIN: f64 = 0.02;
/// A thing beside the arm: radians, metres.
const FIXTURE: f64 = 1.0;
/// What was measured.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// The joints of each row, radians and metres.
    pub joints: Vec<Vec<f64>>,
    /// What was measured in it.
    pub readings: Vec<Reading>,
    /// Rows of one number are held out together.
    pub episodes: Vec<usize>,
}

/// How it is estimated.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CalibrateOptions {
    /// Deviations of a turn (radians) and a shift (metres), if they are known; the residual says them otherwise.
    pub noise: Option<[f64; 2]>,
    /// Whether rows may be grossly wrong.
    pub is_robust: bool,
    /// In how many parts the rows are held out one after another; none below two.
    pub folds: usize,
}

impl Default for CalibrateOptions {
    fn default() -> Self {
        CalibrateOptions { noise: None, is_robust: false, folds: 5 }
    }
}

/// Why nothing is estimated.
#[derive(Clone, PartialEq, Debug)]
pub enum CalibrateError {
    /// Too few numbers: how many there are, how many are needed.
    Rows(usize, usize),
    /// The steps do not end: these measurements are not of this arm as it is said.
    NoEnd(Off),
    /// Rows do not have one number for each joint.
    Joints,
}

impl std::fmt::Display for CalibrateError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            CalibrateError::Rows(found, needed) => {
                write!(f, "{found} measured numbers are too few: at least {needed} are needed")
            }
            CalibrateError::NoEnd(off) => write!(
                f,
                "the measurements do not follow from these joints: {:.3}° and {:.1} mm are left over",
                off.turn.to_degrees(),
                1e3 * off.shift
            ),
            CalibrateError::Joints => f.write_str("a row does not have one number for each joint"),
        }
    }
}

impl std::error::Error for CalibrateError {}

/// Root mean squares of what is left: how far in all, turn and shift.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Off {
    /// Radians.
    pub turn: f64,
    /// Metres.
    pub shift: f64,
}

/// A number that was estimated.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Estimate {
    /// Which one.
    pub parameter: Parameter,
    /// Its value and standard deviation; nothing where these data do not show it by itself.
    pub value: Option<[f64; 2]>,
}

/// What was estimated.
#[derive(Clone, Debug)]
pub struct Calibrated {
    /// The values of all parameters.
    pub state: State,
    /// The kept ones.
    pub estimates: Vec<Estimate>,
    /// Their covariance, that of combinations that are not seen left out.
    pub covariance: Vec<Vec<f64>>,
    /// Combinations that these data do not show, each by its members; they are held.
    pub unseen: Vec<Vec<(Parameter, f64)>>,
    /// The deviation of a turn and a shift, as told or as estimated.
    pub noise: [f64; 2],
    /// The residual in units of it.
    pub ratio: f64,
    /// How far off the measurements are before and behind.
    pub before: Off,
    /// Behind.
    pub after: Off,
    /// Before and behind on rows that were held out.
    pub held_out: Option<[Off; 2]>,
    /// The residual of each row: how far in all, turn and shift.
    pub residuals: Vec<Off>,
    /// Rows that are grossly wrong.
    pub aside: Vec<usize>,
    /// Whether what is left is rounding: the measurements were computed.
    pub is_computed: bool,
}

/// What is usual for a parameter.
pub fn prior(problem: &Problem, parameter: Parameter) -> f64 {
    let frame = |k: usize| if k == 0 || k == problem.last() { FRAMES } else { 1.0 };
    match parameter {
        Parameter::Turn(k, _) => PRIOR[0] * frame(k),
        Parameter::Shift(k, _) => PRIOR[1] * frame(k),
        Parameter::Gain(_) => GAIN,
        Parameter::Fixture(..) => FIXTURE,
    }
}
