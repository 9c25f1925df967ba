//! Columns of a recording as measurements: which numbers are what, where base, tool, planes and centres stand at first.
//!
//! A full pose is looked at by `denavit_recording::hold` before: what has a slip is refused, but for frames, a zero or a length
//! that are off, which calibration is for. Other measurements are held against the arm in closed form.

use crate::estimate::Measured;
use crate::measurement::{Bar, Measurement, Reading};
use crate::model::Problem;
use crate::refused::MOST_GROUPS;
pub use crate::refused::NoMeasurements;
use crate::starts::{base_of_points, fixtures, format_of, framed, turned_frames};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit_recording::{
    Arm, Column, Finding, Form, Format, Held, HoldError, HoldOptions, Recipe, Recording, Roles, Said, Slip,
    fixed, hold,
};

/// The most rows that are used, evenly spread.
const MOST: usize = 3000;
/// The fewest rows that are whole.
const LEAST: usize = 6;
/// The most rows in which the format of an orientation is looked for.
const OF_FORMAT: usize = 200;

/// What is measured, and which columns beside those of the recording's roles hold it.
#[derive(Clone, Debug)]
pub struct What {
    /// The kind.
    pub measurement: Measurement,
    /// The point of the tool, in its frame.
    pub point: Vector<f64>,
    /// Whether joints have gains.
    pub gains: bool,
    /// The column of a distance.
    pub distance: Option<usize>,
    /// The column that tells planes or centres apart.
    pub group: Option<usize>,
    /// The length of a bar that is always the same, metres.
    pub length: Option<f64>,
    /// A recipe that makes the columns the model's.
    pub recipe: Option<Recipe>,
    /// Whether the columns are taken as they are said, without a search for slips.
    pub is_unchecked: bool,
    /// Whether rows may be grossly wrong: the estimate weighs them.
    pub is_robust: bool,
}

/// Measurements, and what they are measurements of.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The arm with base, tool and things beside it where they stand at first.
    pub problem: Problem,
    /// The rows.
    pub measured: Measured,
    /// Their numbers among those of the recording.
    pub rows: Vec<usize>,
    /// How many rows have a number missing, or are left out.
    pub left: usize,
    /// Of the others each so many-th is used.
    pub every: usize,
    /// The robot's base in what is measured.
    pub base: Transform<f64>,
    /// The measured frame in the robot's tool.
    pub tool: Transform<f64>,
    /// How the orientation is written.
    pub format: Option<Format>,
    /// What the search for slips says, where there was one.
    pub held: Option<Box<Held>>,
}

/// Slips that leave the measurements what they are: frames, numbers of the arm itself, rows that are left out or weighed.
fn is_let_pass(slip: &Slip, what: &What) -> bool {
    match slip {
        Slip::Base(_) | Slip::Tool(_) | Slip::Zero(..) | Slip::Length(_) => true,
        Slip::Spikes(_) | Slip::Missing(_) | Slip::TimeBack(_) | Slip::Gaps(_) => true,
        Slip::Apart(..) => what.is_robust,
        Slip::GainBy(..) => what.gains,
        _ => false,
    }
}

/// Frames before the arm and behind it.
fn is_frame(slip: &Slip) -> bool {
    matches!(slip, Slip::Base(_) | Slip::Tool(_))
}

/// The slips of a recording that calibration cannot pass.
pub fn slips<'a>(held: &'a Held, what: &What) -> Vec<&'a Finding> {
    // A zero at an end is a turn of base or tool.
    let passes = |f: &Finding| is_let_pass(&f.slip, what) || f.same.iter().any(is_frame);
    held.findings.iter().filter(|f| !passes(f)).collect()
}

/// Reads columns as measurements.
///
/// # Errors
/// If they are none, or not of this arm.
pub fn prepare(
    arm: &Arm,
    recording: &Recording,
    roles: &Roles,
    what: &What,
) -> Result<Prepared, NoMeasurements> {
    let columns = Columns::new(arm, recording, roles, what)?;
    if what.measurement == Measurement::Pose {
        return poses(arm, &columns, what);
    }
    if what.recipe.is_some() {
        return Err(NoMeasurements::Recipe);
    }
    let mut needed = roles.joints.clone();
    match what.measurement {
        Measurement::Position => needed.extend(&roles.position),
        Measurement::Orientation => needed.extend(&roles.rotation),
        Measurement::Distance(Bar::Measured | Bar::Offset) => {
            needed.push(what.distance.ok_or(NoMeasurements::Column("distance"))?);
        }
        _ => {}
    }
    needed.extend(what.group);
    let whole = columns.whole(&needed)?;
    let every = whole.len().div_ceil(MOST);
    let used: Vec<usize> = whole.iter().copied().step_by(every).collect();
    let joints = columns.joints(&used);
    let number = |c: usize, r: usize| columns.number(c, r);
    let groups = Groups::new(what.group.map(|c| used.iter().map(|&r| number(c, r)).collect()), used.len());
    if groups.count > MOST_GROUPS {
        return Err(NoMeasurements::Groups(groups.count));
    }
    let blank = Reading { turn: Rotation::identity(), at: Vector::zero(), distance: 0.0, group: 0 };
    let mut readings: Vec<Reading> = groups.of.iter().map(|&group| Reading { group, ..blank }).collect();
    let mut problem = Problem::new(arm, what.measurement, what.point, what.gains, vec![]);
    let (mut base, mut tool) = (Transform::identity(), Transform::identity());
    let mut format = None;
    match what.measurement {
        Measurement::Position => {
            for (reading, &r) in readings.iter_mut().zip(&used) {
                reading.at = Vector(std::array::from_fn(|k| number(roles.position[k], r)));
            }
            base = base_of_points(&problem, &joints, &readings)?;
        }
        Measurement::Orientation => {
            let (found, turns) = columns.format(&problem, &used)?;
            format = Some(found);
            readings.iter_mut().zip(turns).for_each(|(reading, turn)| reading.turn = turn);
            (base, tool) = turned_frames(&problem, &joints, &readings)?;
        }
        _ => {
            if let Some(c) = what.distance {
                readings.iter_mut().zip(&used).for_each(|(reading, &r)| reading.distance = number(c, r));
            }
            problem.fixtures = fixtures(&problem, &joints, &readings, groups.count, what.length)?;
        }
    }
    place(&mut problem, &base, &tool);
    if what.measurement.is_on_surface() {
        problem.near = joints.iter().cloned().zip(groups.of.iter().copied()).collect();
    }
    let episodes = used.iter().map(|&r| columns.episode(r)).collect();
    let measured = Measured { joints, readings, episodes };
    let left = columns.rows - whole.len();
    Ok(Prepared { problem, measured, left, every, rows: used, base, tool, format, held: None })
}

/// The columns of a recording that are what the measurement needs.
struct Columns<'a> {
    recording: &'a Recording,
    roles: &'a Roles,
    rows: usize,
}

impl<'a> Columns<'a> {
    /// If there are as many as are needed, all of one length.
    fn new(
        arm: &Arm,
        recording: &'a Recording,
        roles: &'a Roles,
        what: &What,
    ) -> Result<Self, NoMeasurements> {
        let rows = recording.columns.first().map_or(0, |c| c.values.len());
        if recording.columns.iter().any(|c| c.values.len() != rows) {
            return Err(NoMeasurements::Hold(HoldError::Lengths));
        }
        let has_position = matches!(what.measurement, Measurement::Position | Measurement::Pose);
        if has_position && roles.position.len() != 3 {
            return Err(NoMeasurements::Hold(HoldError::Position(roles.position.len())));
        }
        // A column that is no joint's may stand among them, where slips are searched for or a recipe says which are.
        let may_have_more =
            what.measurement == Measurement::Pose && (what.recipe.is_some() || !what.is_unchecked);
        let (found, needed) = (roles.joints.len(), arm.joints());
        if found != needed && !may_have_more {
            return Err(NoMeasurements::Hold(HoldError::Joints { found, needed }));
        }
        Ok(Columns { recording, roles, rows })
    }

    /// A number in SI.
    fn number(&self, c: usize, r: usize) -> f64 {
        let column = &self.recording.columns[c];
        column.values[r] * column.said.map_or(1.0, Said::si)
    }

    /// The rows in which all of these are numbers.
    fn whole(&self, needed: &[usize]) -> Result<Vec<usize>, NoMeasurements> {
        let is_number = |c: &usize, r: usize| self.recording.columns[*c].values[r].is_finite();
        let whole: Vec<usize> = (0..self.rows).filter(|&r| needed.iter().all(|c| is_number(c, r))).collect();
        if whole.len() < LEAST { Err(NoMeasurements::Rows(whole.len(), self.rows)) } else { Ok(whole) }
    }

    fn joints(&self, rows: &[usize]) -> Vec<Vec<f64>> {
        rows.iter().map(|&r| self.roles.joints.iter().map(|&c| self.number(c, r)).collect()).collect()
    }

    /// How the orientation is written, and the orientations of these rows.
    fn format(
        &self,
        problem: &Problem,
        rows: &[usize],
    ) -> Result<(Format, Vec<Rotation<f64>>), NoMeasurements> {
        let rotation = &self.roles.rotation;
        let as_it_stands =
            |&r: &usize| rotation.iter().map(|&c| self.recording.columns[c].values[r]).collect();
        let raw: Vec<Vec<f64>> = rows.iter().map(as_it_stands).collect();
        let known = rotation.first().and_then(|&c| self.recording.columns[c].said);
        format_of(problem, &self.joints(rows), &raw, known)
    }

    fn episode(&self, r: usize) -> usize {
        self.roles.episode.map_or(0, |c| self.recording.columns[c].values[r].max(0.0) as usize)
    }
}

/// Full poses.
fn poses(arm: &Arm, of: &Columns, what: &What) -> Result<Prepared, NoMeasurements> {
    let Columns { recording, roles, rows: all } = *of;
    let mut held = None;
    let plain = Recipe::plain(recording, roles, arm);
    let recipe = match (&what.recipe, what.is_unchecked) {
        (Some(recipe), _) => recipe.clone(),
        (None, true) => {
            let whole = of.whole(&[&roles.joints[..], &roles.position, &roles.rotation].concat())?;
            let some: Vec<usize> = whole.iter().copied().step_by(whole.len().div_ceil(OF_FORMAT)).collect();
            let problem = Problem::new(arm, Measurement::Pose, Vector::zero(), false, vec![]);
            Recipe { format: of.format(&problem, &some)?.0, ..plain }
        }
        (None, false) => {
            let found = hold(arm, recording, roles, &HoldOptions::default()).map_err(NoMeasurements::Hold)?;
            if !found.is_understood
                || !slips(&found, what).is_empty()
                || !found.recipe.joints.iter().all(|j| j.turn.is_none())
            {
                return Err(NoMeasurements::Slips(Box::new(found)));
            }
            let own = &found.recipe;
            let recipe = Recipe { format: own.format, scale: own.scale, rows: own.rows.clone(), ..plain };
            let has_frames = found.findings.iter().any(|f| is_frame(&f.slip) || f.same.iter().any(is_frame));
            let recipe = if has_frames { framed(arm, recording, roles, recipe) } else { recipe };
            held = Some(Box::new(found));
            recipe
        }
    };
    let (base, tool) = (recipe.base, recipe.tool);
    let format = Some(recipe.format);
    let bare = Recipe { base: Transform::identity(), tool: Transform::identity(), ..recipe };
    let (columns, left) = fixed(recording, roles, &bare, arm);
    let kept: Vec<usize> = (0..all).filter(|r| left.binary_search(r).is_err()).collect();
    if kept.len() < LEAST {
        return Err(NoMeasurements::Rows(kept.len(), all));
    }
    let first = usize::from(roles.time.is_some()) + usize::from(roles.episode.is_some());
    let n = arm.joints();
    let at = |c: &Column, k: usize| c.values[k];
    let quaternion = Format { form: Form::QuaternionXyzw, degrees: false };
    let every = kept.len().div_ceil(MOST);
    let picked: Vec<usize> = (0..kept.len()).step_by(every).collect();
    let mut measured = Measured::default();
    for &k in &picked {
        let columns = &columns.columns[first..];
        measured.joints.push(columns[..n].iter().map(|c| at(c, k)).collect());
        let x: [f64; 3] = std::array::from_fn(|i| at(&columns[n + i], k));
        let turn: Vec<f64> = columns[n + 3..n + 7].iter().map(|c| at(c, k)).collect();
        let turn = quaternion.read(&turn).ok_or(NoMeasurements::NoOrientation)?;
        measured.readings.push(Reading { turn, at: Vector(x), distance: 0.0, group: 0 });
        measured.episodes.push(of.episode(kept[k]));
    }
    let mut problem = Problem::new(arm, Measurement::Pose, Vector::zero(), what.gains, vec![]);
    place(&mut problem, &base, &tool);
    let rows = picked.iter().map(|&k| kept[k]).collect();
    Ok(Prepared { problem, measured, rows, left: left.len(), every, base, tool, format, held })
}

/// Puts frames before the first constant and behind the last.
fn place(problem: &mut Problem, base: &Transform<f64>, tool: &Transform<f64>) {
    problem.constants[0] = *base * problem.constants[0];
    let last = problem.last();
    problem.constants[last] = problem.constants[last] * *tool;
}

/// Which rows belong to one plane or centre.
struct Groups {
    of: Vec<usize>,
    count: usize,
}

impl Groups {
    fn new(values: Option<Vec<f64>>, rows: usize) -> Self {
        let Some(values) = values else { return Groups { of: vec![0; rows], count: 1 } };
        let mut known: Vec<f64> = vec![];
        let of = values
            .into_iter()
            .map(|x| {
                known.iter().position(|k| *k == x).unwrap_or_else(|| {
                    known.push(x);
                    known.len() - 1
                })
            })
            .collect();
        Groups { of, count: known.len() }
    }
}
