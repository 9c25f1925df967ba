//! The geometry of an arm out of measurements: what is seen, what was found, the poses to measure at.

use crate::Schema;
use denavit_calibration as calibration;
use denavit_calibration::table::Cell;
use denavit_calibration::{
    Bar, Calibrated, Chosen, Measurement, Parameter, Place, Problem, TableSeen, Visible, words,
};
use serde::Serialize;

/// What a measurement shows of an arm.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Seen {
    /// How many cells the table has.
    pub cells: usize,
    /// Tilts of parallel axes that no cell has.
    pub lacking: usize,
    /// What is measured.
    pub measure: &'static str,
    /// A minimal set of what is seen.
    pub minimal: Vec<String>,
    /// Combinations that no configuration shows.
    pub null: Vec<NotSeen>,
    /// The rank in numbers.
    pub rank: usize,
    /// The robot.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// How many numbers are seen.
    pub seen: usize,
    /// Cells that are not told apart.
    pub tied: Vec<Vec<Member>>,
    /// The same where base and tool may be off as well.
    pub tied_with_frames: Vec<Vec<Member>>,
}

/// A combination that is not seen.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct NotSeen {
    /// Its members.
    pub members: Vec<Member>,
    /// Why, in words.
    pub why: String,
}

/// A member of a combination.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Member {
    /// Its factor.
    pub factor: f64,
    /// What it is.
    pub name: String,
}

/// What was found in measurements.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Found {
    /// How far off the measurements are behind.
    pub after: Off,
    /// Rows that are grossly wrong, counted from 0.
    pub aside: Vec<usize>,
    /// How far off they were before.
    pub before: Off,
    /// Whether what was measured was computed from these joints.
    pub computed: bool,
    /// One deviation of the hand in 100 configurations at random: the mean and the most, metres; null where something is not
    /// seen, for orientations, and with things beside the arm.
    pub deviation_of_hand: Option<[f64; 2]>,
    /// The errors.
    pub errors: Vec<Error>,
    /// Of the rows that are whole each so many-th was used.
    pub every: usize,
    /// The robot file.
    pub file: String,
    /// The same on rows that were held out, before and behind.
    pub held_out: Option<[Off; 2]>,
    /// What is measured.
    pub measure: &'static str,
    /// The noise of a turn and of a shift.
    pub noise: Off,
    /// The recording.
    pub recording: String,
    /// The robot.
    pub robot: String,
    /// How many rows were used.
    pub rows: usize,
    /// The version.
    pub schema: Schema,
    /// How many numbers the measurement shows.
    pub seen: usize,
    /// Combinations that these rows do not show.
    pub unseen: Vec<Vec<Member>>,
}

/// A turn and a shift, root mean squares or deviations; null where what is measured has none.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Off {
    /// Radians.
    pub angle: Option<f64>,
    /// Metres.
    pub distance: Option<f64>,
}

/// An error of the arm.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Error {
    /// One deviation; null where it is not seen by itself.
    pub deviation: Option<f64>,
    /// What it is.
    pub name: String,
    /// Radians, metres, or a part of a gain; null where it is not seen by itself.
    pub value: Option<f64>,
}

/// Configurations to measure at.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Poses {
    /// The joint variables, radians and metres.
    pub configurations: Vec<Vec<f64>>,
    /// One deviation of the hand with them: the mean and the most in 100 configurations at random, metres; null for orientations.
    pub deviation_of_hand: Option<[f64; 2]>,
    /// The same measured at as many at random.
    pub deviation_with_random: Option<[f64; 2]>,
    /// What is measured.
    pub measure: &'static str,
    /// The noise of a turn and of a shift that is counted with.
    pub noise: Off,
    /// The robot.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// How many combinations they do not show.
    pub unseen: usize,
}

/// What is measured, in a word.
pub fn measure(measurement: Measurement) -> &'static str {
    match measurement {
        Measurement::Pose => "pose",
        Measurement::Position => "position",
        Measurement::Orientation => "orientation",
        Measurement::Distance(Bar::Measured) => "distance",
        Measurement::Distance(Bar::Offset) => "distance with offset",
        Measurement::Distance(Bar::Fixed) => "fixed distance",
        Measurement::Distance(Bar::FixedUnknown) => "fixed unknown distance",
        Measurement::Plane => "plane",
    }
}

impl Off {
    fn of(measurement: Measurement, off: &calibration::Off) -> Self {
        Off {
            angle: measurement.has_turns().then_some(off.turn),
            distance: measurement.has_shifts().then_some(off.shift),
        }
    }

    /// Of the noise of a turn and of a shift.
    fn noise(measurement: Measurement, [turn, shift]: [f64; 2]) -> Self {
        Off::of(measurement, &calibration::Off { turn, shift })
    }
}

impl Seen {
    /// Of an arm.
    pub fn of(robot: &str, problem: &Problem, visible: &Visible, seen: &TableSeen) -> Self {
        let name = |p: Place| match p {
            Place::Row(row, cell) => format!("{}{}", letter(cell), row + 1),
            Place::Base(turns, axis) => format!("base {} {axis}", if turns { "turn" } else { "shift" }),
            Place::Tool(turns, axis) => format!("tool {} {axis}", if turns { "turn" } else { "shift" }),
        };
        let tied = |all: &[calibration::Tied]| {
            let one = |t: &calibration::Tied| {
                t.cells.iter().map(|c| Member { factor: c.1, name: name(c.0) }).collect()
            };
            all.iter().map(one).collect()
        };
        let last = problem.last();
        let null = |n: &calibration::Null| NotSeen {
            members: n
                .vector
                .iter()
                .zip(&visible.parameters)
                .filter(|(x, _)| **x != 0.0)
                .map(|(&factor, &p)| Member { factor, name: words::parameter(p, last) })
                .collect(),
            why: words::cause(n.cause, last),
        };
        Seen {
            cells: seen.cells,
            lacking: seen.lacking,
            measure: measure(problem.measurement),
            minimal: visible.kept.iter().map(|&k| words::parameter(visible.parameters[k], last)).collect(),
            null: visible.null.iter().map(null).collect(),
            rank: visible.rank,
            robot: robot.into(),
            schema: Schema,
            seen: visible.kept.len(),
            tied: tied(&seen.tied),
            tied_with_frames: tied(&seen.with_frames),
        }
    }
}

/// The letter of a cell, θ d a α whatever the convention.
fn letter(cell: Cell) -> &'static str {
    match cell {
        Cell::Theta => "theta",
        Cell::D => "d",
        Cell::A => "a",
        Cell::Alpha => "alpha",
        Cell::Beta => "beta",
    }
}

impl Found {
    /// Of an estimate; `rows` are the numbers of the rows in the recording, of which each so many-th was used.
    pub fn of(
        [recording, robot, file]: [&str; 3],
        problem: &Problem,
        visible: &Visible,
        found: &Calibrated,
        (rows, every): (&[usize], usize),
        hand: Option<[f64; 2]>,
    ) -> Self {
        let last = problem.last();
        let off = |o: &calibration::Off| Off::of(problem.measurement, o);
        let member = |m: &(Parameter, f64)| Member { factor: m.1, name: words::parameter(m.0, last) };
        let error = |e: &calibration::Estimate| Error {
            deviation: e.value.map(|v| v[1]),
            name: words::parameter(e.parameter, last),
            value: e.value.map(|v| v[0]),
        };
        Found {
            after: off(&found.after),
            aside: found.aside.iter().map(|&r| rows[r]).collect(),
            before: off(&found.before),
            computed: found.is_computed,
            deviation_of_hand: hand,
            errors: found.estimates.iter().map(error).collect(),
            every,
            file: file.into(),
            held_out: found.held_out.as_ref().map(|[a, b]| [off(a), off(b)]),
            measure: measure(problem.measurement),
            noise: Off::noise(problem.measurement, found.noise),
            recording: recording.into(),
            robot: robot.into(),
            rows: rows.len(),
            schema: Schema,
            seen: visible.kept.len(),
            unseen: found.unseen.iter().map(|u| u.iter().map(member).collect()).collect(),
        }
    }
}

impl Poses {
    /// Of a choice among candidates.
    pub fn of(
        robot: &str,
        measurement: Measurement,
        chosen: &Chosen,
        candidates: &[Vec<f64>],
        noise: [f64; 2],
    ) -> Self {
        Poses {
            configurations: chosen.chosen.iter().map(|&c| candidates[c].clone()).collect(),
            deviation_of_hand: chosen.deviation,
            deviation_with_random: chosen.random,
            measure: measure(measurement),
            noise: Off::noise(measurement, noise),
            robot: robot.into(),
            schema: Schema,
            unseen: chosen.unseen,
        }
    }
}
