//! Columns of a recording as measurements: which numbers are what, where base, tool, planes and centres stand at first.
//!
//! A full pose is looked at by `denavit_recording::hold` before: what has a slip is refused, but for frames, a zero or a length
//! that are off, which calibration is for. Other measurements are held against the arm in closed form: Kabsch's turn for
//! positions, a sphere or a plane through the points of the model.

use crate::estimate::Measured;
use crate::linear::symmetric;
use crate::measurement::{Bar, Fixture, Measurement, Reading};
use crate::model::{Problem, frame_along};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::random::Random;
use denavit_recording::turns::{Sum, between, log, solve};
use denavit_recording::{
    Arm, Column, Form, Format, Held, HoldError, HoldOptions, Recipe, Recording, Roles, Said, Slip, fixed,
    frames, hold,
};

/// More than this left over at first is not the arm that is said: metres, radians.
const FAR: [f64; 2] = [0.06, 0.2];
/// A base that is farther off than this is another one: metres, radians.
const OTHER_BASE: [f64; 2] = [0.008, 0.021];
/// The most rows that are used, evenly spread.
const MOST: usize = 3000;
/// The most planes or centres.
const MOST_GROUPS: usize = 24;

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
    /// The robot's base in what is measured.
    pub base: Transform<f64>,
    /// The measured frame in the robot's tool.
    pub tool: Transform<f64>,
    /// How the orientation is written.
    pub format: Option<Format>,
    /// What the search for slips says, where there was one.
    pub held: Option<Box<Held>>,
}

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

/// Slips that leave the measurements what they are: frames, numbers of the arm itself, rows that are left out or weighed.
fn is_let_pass(slip: &Slip, gains: bool) -> bool {
    match slip {
        Slip::Base(_) | Slip::Tool(_) | Slip::Zero(..) | Slip::Length(_) => true,
        Slip::Spikes(_) | Slip::Missing(_) | Slip::Apart(..) | Slip::TimeBack(_) | Slip::Gaps(_) => true,
        Slip::GainBy(..) => gains,
        _ => false,
    }
}

/// The slips of a recording that calibration cannot pass.
pub fn slips(held: &Held, gains: bool) -> Vec<&denavit_recording::Finding> {
    held.findings.iter().filter(|f| !is_let_pass(&f.slip, gains)).collect()
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
    if what.measurement == Measurement::Pose {
        return poses(arm, recording, roles, what);
    }
    if what.recipe.is_some() {
        return Err(NoMeasurements::Recipe);
    }
    let rows = recording.columns.first().map_or(0, |c| c.values.len());
    if recording.columns.iter().any(|c| c.values.len() != rows) {
        return Err(NoMeasurements::Hold(HoldError::Lengths));
    }
    if what.measurement == Measurement::Position && roles.position.len() != 3 {
        return Err(NoMeasurements::Hold(HoldError::Position(roles.position.len())));
    }
    let number = |c: usize, r: usize| {
        let column = &recording.columns[c];
        column.values[r] * column.said.map_or(1.0, Said::si)
    };
    if roles.joints.len() != arm.joints() {
        return Err(NoMeasurements::Hold(HoldError::Joints {
            found: roles.joints.len(),
            needed: arm.joints(),
        }));
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
    let whole: Vec<usize> =
        (0..rows).filter(|&r| needed.iter().all(|&c| recording.columns[c].values[r].is_finite())).collect();
    if whole.len() < 6 {
        return Err(NoMeasurements::Rows(whole.len(), rows));
    }
    let used: Vec<usize> = whole.iter().copied().step_by(whole.len().div_ceil(MOST).max(1)).collect();
    let joints: Vec<Vec<f64>> =
        used.iter().map(|&r| roles.joints.iter().map(|&c| number(c, r)).collect()).collect();
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
            let raw: Vec<Vec<f64>> = used
                .iter()
                .map(|&r| roles.rotation.iter().map(|&c| recording.columns[c].values[r]).collect())
                .collect();
            let known = roles.rotation.first().and_then(|&c| recording.columns[c].said);
            let (found, turns) = format_of(&problem, &joints, &raw, known)?;
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
    let episodes = used.iter().map(|&r| episode(recording, roles, r)).collect();
    let measured = Measured { joints, readings, episodes };
    Ok(Prepared { problem, measured, left: rows - whole.len(), rows: used, base, tool, format, held: None })
}

/// Full poses.
fn poses(arm: &Arm, recording: &Recording, roles: &Roles, what: &What) -> Result<Prepared, NoMeasurements> {
    let mut held = None;
    let plain = Recipe::plain(recording, roles, arm);
    let recipe = match (&what.recipe, what.is_unchecked) {
        (Some(recipe), _) => recipe.clone(),
        (None, true) => {
            let known = roles.rotation.first().and_then(|&c| recording.columns[c].said);
            let rows = recording.columns.first().map_or(0, |c| c.values.len());
            let number = |c: usize, r: usize| {
                recording.columns[c].values[r] * recording.columns[c].said.map_or(1.0, Said::si)
            };
            let is_whole = |r: &usize| {
                let columns = roles.joints.iter().chain(&roles.rotation);
                columns.into_iter().all(|&c| recording.columns[c].values[*r].is_finite())
            };
            let whole: Vec<usize> = (0..rows).filter(is_whole).collect();
            if whole.len() < 6 || roles.joints.len() != arm.joints() {
                return Err(NoMeasurements::Rows(whole.len(), rows));
            }
            let all: Vec<usize> = whole.iter().copied().step_by(whole.len().div_ceil(200)).collect();
            let joints: Vec<Vec<f64>> =
                all.iter().map(|&r| roles.joints.iter().map(|&c| number(c, r)).collect()).collect();
            let raw: Vec<Vec<f64>> = all
                .iter()
                .map(|&r| roles.rotation.iter().map(|&c| recording.columns[c].values[r]).collect())
                .collect();
            let problem = Problem::new(arm, Measurement::Pose, Vector::zero(), false, vec![]);
            Recipe { format: format_of(&problem, &joints, &raw, known)?.0, ..plain }
        }
        (None, false) => {
            let found = hold(arm, recording, roles, &HoldOptions::default()).map_err(NoMeasurements::Hold)?;
            if !found.is_understood
                || !slips(&found, what.gains).is_empty()
                || !found.recipe.joints.iter().all(|j| j.turn.is_none())
            {
                return Err(NoMeasurements::Slips(Box::new(found)));
            }
            let own = &found.recipe;
            let recipe = Recipe {
                format: own.format,
                scale: own.scale,
                base: own.base,
                tool: own.tool,
                rows: own.rows.clone(),
                ..plain
            };
            held = Some(Box::new(found));
            recipe
        }
    };
    let (base, tool) = (recipe.base, recipe.tool);
    let format = Some(recipe.format);
    let bare = Recipe { base: Transform::identity(), tool: Transform::identity(), ..recipe };
    let (columns, left) = fixed(recording, roles, &bare, arm);
    let all = recording.columns.first().map_or(0, |c| c.values.len());
    let kept: Vec<usize> = (0..all).filter(|r| left.binary_search(r).is_err()).collect();
    if kept.len() < 6 {
        return Err(NoMeasurements::Rows(kept.len(), all));
    }
    let first = usize::from(roles.time.is_some()) + usize::from(roles.episode.is_some());
    let n = arm.joints();
    let at = |c: &Column, k: usize| c.values[k];
    let quaternion = Format { form: Form::QuaternionXyzw, degrees: false };
    let picked: Vec<usize> = (0..kept.len()).step_by(kept.len().div_ceil(MOST).max(1)).collect();
    let mut measured = Measured::default();
    for &k in &picked {
        let columns = &columns.columns[first..];
        measured.joints.push(columns[..n].iter().map(|c| at(c, k)).collect());
        let x: [f64; 3] = std::array::from_fn(|i| at(&columns[n + i], k));
        let turn: Vec<f64> = columns[n + 3..n + 7].iter().map(|c| at(c, k)).collect();
        let turn = quaternion.read(&turn).ok_or(NoMeasurements::NoOrientation)?;
        measured.readings.push(Reading { turn, at: Vector(x), distance: 0.0, group: 0 });
        measured.episodes.push(episode(recording, roles, kept[k]));
    }
    let mut problem = Problem::new(arm, Measurement::Pose, Vector::zero(), what.gains, vec![]);
    place(&mut problem, &base, &tool);
    let rows = picked.iter().map(|&k| kept[k]).collect();
    Ok(Prepared { problem, measured, rows, left: left.len(), base, tool, format, held })
}

fn episode(recording: &Recording, roles: &Roles, r: usize) -> usize {
    roles.episode.map_or(0, |c| recording.columns[c].values[r].max(0.0) as usize)
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

fn hands(problem: &Problem, joints: &[Vec<f64>]) -> Vec<Transform<f64>> {
    joints.iter().map(|q| problem.arm.pose_with(&problem.constants, q)).collect()
}

fn mean(points: &[Vector<f64>]) -> Vector<f64> {
    points.iter().fold(Vector::zero(), |a, b| a + *b).scale(1.0 / points.len().max(1) as f64)
}

/// The turn and shift that bring points of the model to those that were measured, and what is left over (Kabsch).
fn kabsch(model: &[Vector<f64>], seen: &[Vector<f64>]) -> (Transform<f64>, f64) {
    let (from, to) = (mean(model), mean(seen));
    let mut sum = Sum::default();
    model.iter().zip(seen).for_each(|(a, b)| sum.outer(*b - to, *a - from));
    let turn = sum.nearest();
    let frame = Transform::from_rotation_translation(turn, to - turn * from);
    (frame, left_over(&frame, model, seen))
}

fn left_over(frame: &Transform<f64>, model: &[Vector<f64>], seen: &[Vector<f64>]) -> f64 {
    let squares: f64 =
        model.iter().zip(seen).map(|(a, b)| (frame.act_on_point(*a) - *b).norm().powi(2)).sum();
    (squares / model.len().max(1) as f64).sqrt()
}

/// Where the robot's base stands among positions: where it is said, unless that is far off.
fn base_of_points(
    problem: &Problem,
    joints: &[Vec<f64>],
    readings: &[Reading],
) -> Result<Transform<f64>, NoMeasurements> {
    let seen: Vec<Vector<f64>> = readings.iter().map(|r| r.at).collect();
    let points = |by: f64| -> Vec<Vector<f64>> {
        let turned = |q: &Vec<f64>| -> Vec<f64> {
            q.iter().zip(&problem.arm.turns).map(|(q, t)| if *t { by * q } else { *q }).collect()
        };
        let joints: Vec<Vec<f64>> = joints.iter().map(turned).collect();
        hands(problem, &joints).iter().map(|x| x.translation).collect()
    };
    let model = points(1.0);
    let (frame, left) = kabsch(&model, &seen);
    if left <= FAR[0] {
        let as_said = left_over(&Transform::identity(), &model, &seen);
        let is_near = frame.translation.norm() < OTHER_BASE[0] && log(&frame.rotation).norm() < OTHER_BASE[1];
        return Ok(if is_near || as_said < 1.5 * left { Transform::identity() } else { frame });
    }
    // What would mend it.
    let degrees = points(1_f64.to_radians());
    let metres: Vec<Vector<f64>> = seen.iter().map(|p| p.scale(1e-3)).collect();
    let hints: [(f64, &'static str); 3] = [
        (kabsch(&degrees, &seen).1, "the joints are in degrees: say it in the head, `q1 [deg]`"),
        (kabsch(&model, &metres).1, "the positions are in millimetres: say it in the head, `x [mm]`"),
        (
            kabsch(&degrees, &metres).1,
            "the joints are in degrees and the positions in millimetres: say it in the head, `q1 [deg]`, `x [mm]`",
        ),
    ];
    let best = hints.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).filter(|h| h.0 <= FAR[0]);
    Err(NoMeasurements::Far(left, false, best.map(|h| h.1)))
}

/// The format in which the angles between orientations are those of the model, and the orientations.
fn format_of(
    problem: &Problem,
    joints: &[Vec<f64>],
    raw: &[Vec<f64>],
    said: Option<Said>,
) -> Result<(Format, Vec<Rotation<f64>>), NoMeasurements> {
    let width = raw.first().map_or(0, Vec::len);
    let model: Vec<Rotation<f64>> = hands(problem, joints).iter().map(|x| x.rotation).collect();
    let mut random = Random(5);
    let n = raw.len();
    let mut any = || ((random.unit() * n as f64) as usize).min(n - 1);
    let pairs: Vec<(usize, usize)> = (0..120).map(|_| (any(), any())).collect();
    let units: &[bool] = match said {
        Some(Said::Degrees) => &[true],
        Some(Said::Radians) => &[false],
        _ => &[false, true],
    };
    let mut best: Option<(f64, Format, Vec<Rotation<f64>>)> = None;
    for form in Form::all().into_iter().filter(|f| f.width() == width) {
        for &degrees in if width == 3 { units } else { &[false] } {
            let format = Format { form, degrees };
            let Some(turns) = raw.iter().map(|x| format.read(x)).collect::<Option<Vec<_>>>() else {
                continue;
            };
            let off = |&(s, t): &(usize, usize)| {
                (between(&turns[s], &turns[t]) - between(&model[s], &model[t])).abs().min(0.5)
            };
            let score = pairs.iter().map(off).sum::<f64>() / pairs.len() as f64;
            if best.as_ref().is_none_or(|b| score < b.0) {
                best = Some((score, format, turns));
            }
        }
    }
    match best {
        None => Err(NoMeasurements::NoOrientation),
        Some((score, ..)) if score > FAR[1] => Err(NoMeasurements::Far(score, true, None)),
        Some((_, format, turns)) => Ok((format, turns)),
    }
}

/// How base and tool are turned, in closed form; not at all where that is as good.
fn turned_frames(
    problem: &Problem,
    joints: &[Vec<f64>],
    readings: &[Reading],
) -> Result<(Transform<f64>, Transform<f64>), NoMeasurements> {
    let model = hands(problem, joints);
    let recorded: Vec<_> = readings.iter().zip(&model).map(|(r, m)| (r.turn, m.translation)).collect();
    let n = model.len();
    let mut random = Random(6);
    let mut any = || ((random.unit() * n as f64) as usize).min(n - 1);
    let pairs: Vec<(usize, usize)> = (0..100).map(|_| (any(), any())).filter(|p| p.0 != p.1).collect();
    let left = |base: &Rotation<f64>, tool: &Rotation<f64>| {
        let squares: f64 = model
            .iter()
            .zip(readings)
            .map(|(m, r)| between(&(*base * m.rotation * *tool), &r.turn).powi(2))
            .sum();
        (squares / n as f64).sqrt()
    };
    let none = Rotation::identity();
    let as_said = left(&none, &none);
    let found = frames::closed(&model, &recorded, &pairs)
        .into_iter()
        .map(|f| (f.base.rotation, f.tool.rotation))
        .map(|(b, t)| (left(&b, &t), b, t))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let turn = |r: Rotation<f64>| Transform::from_rotation_translation(r, Vector::zero());
    match found {
        Some((best, b, t)) if best < 0.5 * as_said && as_said > OTHER_BASE[1] => {
            if best > FAR[1] {
                return Err(NoMeasurements::Far(best, true, None));
            }
            Ok((turn(b), turn(t)))
        }
        _ if as_said > FAR[1] => Err(NoMeasurements::Far(as_said, true, None)),
        _ => Ok((Transform::identity(), Transform::identity())),
    }
}

/// Planes or centres through the points of the model.
fn fixtures(
    problem: &Problem,
    joints: &[Vec<f64>],
    readings: &[Reading],
    count: usize,
    length: Option<f64>,
) -> Result<Vec<Fixture>, NoMeasurements> {
    let points: Vec<Vector<f64>> = hands(problem, joints).iter().map(|x| x.translation).collect();
    let mut all = vec![];
    for group in 0..count {
        let own: Vec<usize> = (0..points.len()).filter(|&r| readings[r].group == group).collect();
        let fixture = match problem.measurement {
            Measurement::Plane => plane(&own.iter().map(|&r| points[r]).collect::<Vec<_>>()),
            Measurement::Distance(bar) => {
                let rows: Vec<(Vector<f64>, f64)> =
                    own.iter().map(|&r| (points[r], readings[r].distance)).collect();
                centre(bar, &rows, length)
            }
            _ => continue,
        };
        let squares: f64 = own
            .iter()
            .map(|&r| (readings[r].distance - fixture.reading(problem.measurement, points[r])).powi(2))
            .sum();
        let left = (squares / own.len().max(1) as f64).sqrt();
        if left.is_nan() || left > FAR[0] {
            return Err(NoMeasurements::Far(left, false, None));
        }
        all.push(fixture);
    }
    Ok(all)
}

/// The plane nearest to points: its normal is the direction in which they are spread least.
fn plane(points: &[Vector<f64>]) -> Fixture {
    let at = mean(points);
    let mut spread = vec![vec![0.0; 3]; 3];
    for p in points {
        let d = *p - at;
        for (i, row) in spread.iter_mut().enumerate() {
            row.iter_mut().enumerate().for_each(|(j, x)| *x += d[i] * d[j]);
        }
    }
    let (values, vectors) = symmetric(spread);
    let least = (0..3).min_by(|&i, &j| values[i].total_cmp(&values[j])).unwrap_or(2);
    let v = &vectors[least];
    Fixture { frame: frame_along(Vector([v[0], v[1], v[2]]), at), length: 0.0 }
}

/// The centre of distances: |p|² − d² = 2 p·c + 2 d ℓ + (ℓ² − |c|²) is linear in c, ℓ and the constant.
fn centre(bar: Bar, rows: &[(Vector<f64>, f64)], length: Option<f64>) -> Fixture {
    let known = length.unwrap_or(0.0);
    let is_offset = bar == Bar::Offset;
    // The mean is taken away first: the numbers stay small.
    let at = mean(&rows.iter().map(|r| r.0).collect::<Vec<_>>());
    let n = if is_offset { 5 } else { 4 };
    let (mut a, mut b) = (vec![0.0; n * n], vec![0.0; n]);
    for (p, d) in rows {
        let p = *p - at;
        let d = if bar == Bar::Fixed { known } else { *d };
        let row = [2.0 * p[0], 2.0 * p[1], 2.0 * p[2], 1.0, 2.0 * d];
        let y = p.dot(p) - d * d;
        for i in 0..n {
            b[i] += row[i] * y;
            (0..n).for_each(|j| a[i * n + j] += row[i] * row[j]);
        }
    }
    (0..n).for_each(|i| a[i * n + i] += 1e-12);
    let x = solve(a, b);
    let c = Vector([x[0], x[1], x[2]]);
    let length = match bar {
        Bar::Measured => 0.0,
        Bar::Offset => x[4],
        Bar::Fixed => known,
        // The constant is ℓ² − |c|².
        Bar::FixedUnknown => (x[3] + c.dot(c)).max(0.0).sqrt(),
    };
    Fixture { frame: Transform::from_rotation_translation(Rotation::identity(), c + at), length }
}
