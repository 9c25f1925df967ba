//! The value that a joint must have had, from the pose and the other joints, in closed form.
//!
//! T = P Rz(x) Q: with D = Pᵀ M Qᵀ, y = P⁻¹ p and z the place of Q, x = atan2((D₂₁ − D₁₂)/σ² + 2 (y₂z₁ − y₁z₂)/τ²,
//! (D₁₁ + D₂₂)/σ² + 2 (y₁z₁ + y₂z₂)/τ²). The joint at fault is the one whose values mend orientation and position at once.

use crate::columns::median;
use crate::data::{Data, Direction};
use crate::finding::Unlike;
use crate::fit::{Scale, adjusted};
use crate::frames::Frames;
use crate::hypothesis::Map;
use crate::search::{Reading, Search};
use crate::turns::log;
use denavit::geometry::{Rotation, Transform, Vector};

/// Residuals below this are explained, and others are so many times larger.
const EXPLAINED: f64 = 1.6;
const CLEARLY: f64 = 3.0;

/// The value of a joint at a pose, and how far the pose is off then, in units of the scale.
fn value(
    around: &[Transform<f64>; 2],
    turns: bool,
    (turn, at): (Rotation<f64>, Vector<f64>),
    scale: &Scale,
) -> (f64, f64) {
    let [before, behind] = around;
    let back = before.inverse();
    let wanted = back.rotation * turn;
    let y = back.act_on_point(at);
    let z = behind.translation;
    let d = (wanted * behind.rotation.inverse()).rows();
    let (s2, t2) = (scale.turn.powi(2), scale.shift.powi(2));
    let (x, moved) = if turns {
        let sine = (d[1][0] - d[0][1]) / s2 + 2.0 * (y[1] * z[0] - y[0] * z[1]) / t2;
        let cosine = (d[0][0] + d[1][1]) / s2 + 2.0 * (y[0] * z[0] + y[1] * z[1]) / t2;
        let x = sine.atan2(cosine);
        (x, Transform::rotation_z(x) * *behind)
    } else {
        let x = y[2] - z[2];
        (x, Transform::translation_z(x) * *behind)
    };
    let e = log(&(moved.rotation.inverse() * wanted)).norm() / scale.turn;
    let p = (moved.translation - y).norm() / scale.shift;
    (x, ((e * e + p * p) / 6.0).sqrt())
}

/// The values of a joint at rows under frames, each with its residual; nothing of a joint that moves several axes.
fn values(
    data: &Data,
    reading: (&crate::arm::Arm, &Map, &Frames, &Scale),
    extras: &[(crate::fit::Extra, f64)],
    (format, direction, lag): (usize, Direction, f64),
    joint: usize,
    rows: &[usize],
) -> Option<Vec<(f64, f64)>> {
    let (arm, map, frames, scale) = reading;
    let (mut row, mut q) = (vec![], vec![]);
    let (base, tool) = (frames.base.inverse(), frames.tool.inverse());
    let mut all = vec![];
    for &r in rows {
        let Some(recorded) = data.recorded(format, r) else { continue };
        let (turn, at) = direction.read(recorded);
        let seen = base * Transform::from_rotation_translation(turn, at.scale(1.0 / frames.scale)) * tool;
        data.row(r, lag, &mut row);
        map.apply(&row, &mut q);
        adjusted(&mut q, extras);
        let around = arm.around(joint, &q)?;
        all.push(value(&around, arm.turns[joint], (seen.rotation, seen.translation), scale));
    }
    Some(all)
}

/// The values undone of whole turns.
fn unwrapped(values: &[(f64, f64)]) -> Vec<f64> {
    let mut all: Vec<f64> = vec![];
    for &(x, _) in values {
        let turn = std::f64::consts::TAU;
        let last = all.last().copied().unwrap_or(x);
        all.push(x + turn * ((last - x) / turn).round());
    }
    all
}

fn ends(values: &[f64]) -> [f64; 2] {
    [
        values.iter().copied().fold(f64::INFINITY, f64::min),
        values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
}

/// The least and the most that a joint had at rows, as the pose shows it.
pub fn range(search: &Search, best: &Reading, joint: usize, rows: &[usize]) -> Option<[f64; 2]> {
    let reading = (best.arm, &*best.map, &best.fit.frames, &best.scale);
    let all =
        values(search.data, reading, &best.fit.extras, (best.format, best.direction, best.lag), joint, rows)?;
    (!all.is_empty()).then(|| ends(&unwrapped(&all)))
}

/// The joint whose column alone does not follow the motion, base and tool taken for none.
pub fn at_fault(search: &Search, found: &[Reading]) -> Option<Unlike> {
    let data = search.data;
    let mut rows = data.held.clone();
    rows.sort_unstable();
    let mut all: Vec<(f64, usize, Vec<f64>, usize)> = vec![];
    let first = found.first()?;
    for base in search.bases().iter().take(2) {
        let map = base.map(data.width(), data.arm);
        for format in 0..data.decoded.len() {
            let scale = Scale { turn: data.decoded[format].noise.hypot(crate::search::TURN), ..first.scale };
            let frames = Frames::none();
            for joint in data.arm.turning() {
                let reading = (data.arm, &map, &frames, &scale);
                let Some(v) = values(data, reading, &[], (format, Direction::Direct, 0.0), joint, &rows)
                else {
                    continue;
                };
                let size = median(v.iter().map(|x| x.1).collect());
                all.push((size, joint, unwrapped(&v), map.pick[joint]));
            }
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (size, joint, trace, column) = all.first()?;
    let next = all.iter().find(|o| o.1 != *joint).map_or(f64::INFINITY, |o| o.0);
    if *size > EXPLAINED || next < CLEARLY * size.max(0.5) {
        return None;
    }
    let c = &data.columns.joints[*column];
    let is_still = ends(&rows.iter().map(|&r| c[r]).collect::<Vec<_>>()) == [c[rows[0]]; 2];
    Some(Unlike { joint: *joint, is_still, needed: ends(trace) })
}
