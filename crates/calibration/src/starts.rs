//! Where base, tool, planes and centres stand at first, in closed form, and how an orientation is written.
//!
//! Kabsch's turn for positions, Horn's for increments of orientations, a sphere or a plane through the points of the model.

use crate::linear::symmetric;
use crate::measurement::{Bar, Fixture, Measurement, Reading};
use crate::model::{Problem, frame_along};
use crate::refused::NoMeasurements;
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::random::Random;
use denavit_recording::turns::{Sum, between, log, solve};
use denavit_recording::{Arm, Form, Format, Recipe, Recording, Roles, Said, fixed, frames};

/// More than this left over at first is not the arm that is said: metres, radians.
const FAR: [f64; 2] = [0.06, 0.2];
/// A base that is farther off than this is another one: metres, radians.
const OTHER_BASE: [f64; 2] = [0.008, 0.021];

/// A recipe with base and tool in closed form, all else as it is.
pub fn framed(arm: &Arm, recording: &Recording, roles: &Roles, recipe: Recipe) -> Recipe {
    let (columns, left) = fixed(recording, roles, &recipe, arm);
    let first = usize::from(roles.time.is_some()) + usize::from(roles.episode.is_some());
    let columns = &columns.columns[first.min(columns.columns.len())..];
    let (n, all) = (arm.joints(), recording.columns.first().map_or(0, |c| c.values.len()));
    let quaternion = Format { form: Form::QuaternionXyzw, degrees: false };
    let (mut model, mut seen) = (vec![], vec![]);
    let count = all - left.len();
    for k in (0..count).step_by(count.div_ceil(300).max(1)) {
        let q: Vec<f64> = columns[..n].iter().map(|c| c.values[k]).collect();
        let turn: Vec<f64> = columns[n + 3..n + 7].iter().map(|c| c.values[k]).collect();
        let at = Vector(std::array::from_fn(|i| columns[n + i].values[k]));
        if let Some(turn) = quaternion.read(&turn) {
            model.push(arm.pose(&q));
            seen.push((turn, at));
        }
    }
    let rows = model.len();
    if rows < 6 {
        return recipe;
    }
    let mut random = Random(7);
    let mut any = || ((random.unit() * rows as f64) as usize).min(rows - 1);
    let pairs: Vec<(usize, usize)> = (0..120).map(|_| (any(), any())).filter(|p| p.0 != p.1).collect();
    let off = |base: &Transform<f64>, tool: &Transform<f64>| -> f64 {
        let one = |(m, s): (&Transform<f64>, &(Rotation<f64>, Vector<f64>))| {
            let x = *base * *m * *tool;
            (x.translation - s.1).norm().powi(2) + between(&x.rotation, &s.0).powi(2)
        };
        model.iter().zip(&seen).map(one).sum()
    };
    let none = Transform::identity();
    let found = frames::closed(&model, &seen, &pairs)
        .into_iter()
        .filter(|f| f.scale == 1.0)
        .map(|f| (off(&f.base, &f.tool), f.base, f.tool))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    match found {
        Some((by, base, tool)) if by < 0.5 * off(&none, &none) => Recipe { base, tool, ..recipe },
        _ => recipe,
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
///
/// # Errors
/// If the measurements are far from the arm in the best case.
pub fn base_of_points(
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
///
/// # Errors
/// If the measurements are far from the arm in the best case.
pub fn format_of(
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
    let mut all: Vec<(f64, Format, Vec<Rotation<f64>>)> = vec![];
    for form in Form::all().into_iter().filter(|f| f.width() == width) {
        for &degrees in if width == 3 { units } else { &[false] } {
            let format = Format { form, degrees };
            let Some(turns) = raw.iter().map(|x| format.read(x)).collect::<Option<Vec<_>>>() else {
                continue;
            };
            let off = |&(s, t): &(usize, usize)| {
                (between(&turns[s], &turns[t]) - between(&model[s], &model[t])).abs().min(0.5)
            };
            all.push((pairs.iter().map(off).sum::<f64>() / pairs.len() as f64, format, turns));
        }
    }
    let least = all.iter().map(|f| f.0).fold(f64::INFINITY, f64::min);
    if all.is_empty() {
        return Err(NoMeasurements::NoOrientation);
    }
    if least.is_nan() || least > FAR[1] {
        return Err(NoMeasurements::Far(least, true, None));
    }
    // Angles alone do not tell a quaternion from its inverse with its numbers in another order, nor axes that are renamed:
    // frames do, and those that are none are likelier.
    let cost = |turns: &[Rotation<f64>]| {
        let (as_said, found) = frames_of_turns(&model, turns);
        as_said.min(found.map_or(f64::INFINITY, |f| f.0 + 0.02))
    };
    let near = all.into_iter().filter(|f| f.0 <= 1.2 * least + 1e-3);
    let best = near.map(|f| (cost(&f.2), f.1, f.2)).min_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|f| (f.1, f.2)).ok_or(NoMeasurements::NoOrientation)
}

/// What is left over with a turn of the base and one of the tool, radians.
type Turned = (f64, Rotation<f64>, Rotation<f64>);

/// How far orientations are off as they are said, and with the best turns of base and tool.
fn frames_of_turns(model: &[Rotation<f64>], seen: &[Rotation<f64>]) -> (f64, Option<Turned>) {
    let n = model.len();
    let mut random = Random(6);
    let mut any = || ((random.unit() * n as f64) as usize).min(n - 1);
    let pairs: Vec<(usize, usize)> = (0..100).map(|_| (any(), any())).filter(|p| p.0 != p.1).collect();
    let left = |base: &Rotation<f64>, tool: &Rotation<f64>| {
        let squares: f64 =
            model.iter().zip(seen).map(|(m, r)| between(&(*base * *m * *tool), r).powi(2)).sum();
        (squares / n as f64).sqrt()
    };
    // Positions decide nothing here: any will do.
    let still = |r: &Rotation<f64>| Transform::from_rotation_translation(*r, r.x() + r.z().scale(0.5));
    let model_at: Vec<Transform<f64>> = model.iter().map(still).collect();
    let seen_at: Vec<_> = seen.iter().zip(&model_at).map(|(r, m)| (*r, m.translation)).collect();
    let found = frames::closed(&model_at, &seen_at, &pairs)
        .into_iter()
        .map(|f| (left(&f.base.rotation, &f.tool.rotation), f.base.rotation, f.tool.rotation))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    (left(&Rotation::identity(), &Rotation::identity()), found)
}

/// How base and tool are turned, in closed form; not at all where that is as good.
///
/// # Errors
/// If the measurements are far from the arm in the best case.
pub fn turned_frames(
    problem: &Problem,
    joints: &[Vec<f64>],
    readings: &[Reading],
) -> Result<(Transform<f64>, Transform<f64>), NoMeasurements> {
    let model: Vec<Rotation<f64>> = hands(problem, joints).iter().map(|x| x.rotation).collect();
    let seen: Vec<Rotation<f64>> = readings.iter().map(|r| r.turn).collect();
    let (as_said, found) = frames_of_turns(&model, &seen);
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
///
/// # Errors
/// If the measurements are far from the arm in the best case.
pub fn fixtures(
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
