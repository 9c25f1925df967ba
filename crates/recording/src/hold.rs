//! Columns held against an arm.

use crate::arm::Arm;
use crate::columns::{Prepared, prepare};
use crate::data::{Data, Direction, spread};
use crate::decode::Format;
use crate::explain;
use crate::finding::{Finding, Fitted, Length, Off, Rival, Slip, Stuck, Unlike, Unseen};
use crate::fit::{Extra, Problem, sizes};
use crate::hypothesis::{Hypothesis, Move, Unit};
use crate::lag;
use crate::needed;
use crate::recipe::Recipe;
use crate::recording::{HoldError, Recording, Roles};
use crate::search::{Reading, Search};
use denavit::geometry::Transform;
use std::rc::Rc;

/// Above this the residual is not understood.
const UNDERSTOOD: f64 = 2.5;
/// Neither is one with more than this left over, whatever the noise.
const MOST_LEFT: Off = Off { turn: 0.35, shift: 0.35 };
/// Readings this near are not told apart, nats.
const TIED: f64 = 3.5;
/// A run is stuck if its rows are so many times farther off than others.
const APART: f64 = 4.0;
/// Fitted numbers below these are what calibration is for.
const SMALL: [f64; 5] = [0.0262, 0.02, 0.02, 0.006, 0.4];

/// How columns are held.
#[derive(Clone, Copy, Debug)]
pub struct HoldOptions {
    /// Whether other arms of the catalogue are tried.
    pub others: bool,
    /// The format of the orientation, if it is known.
    pub format: Option<Format>,
}

impl Default for HoldOptions {
    fn default() -> Self {
        HoldOptions { others: true, format: None }
    }
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Held {
    /// What the columns mean, to be applied.
    pub recipe: Recipe,
    /// In what the recording is other than the model.
    pub findings: Vec<Finding>,
    /// What is worth saying and no slip.
    pub remarks: Vec<Finding>,
    /// How far the hand is off once all of it is undone.
    pub left_over: Off,
    /// What of it is the noise of the columns, where that is seen.
    pub noise: Option<Off>,
    /// The residual in units of what is expected.
    pub rho: f64,
    /// Whether the recording is understood.
    pub is_understood: bool,
    /// Whether the pose was computed from these joints: the residual is that of rounding.
    pub is_computed: bool,
    /// What cannot be seen.
    pub unseen: Vec<Unseen>,
    /// Readings that are as good.
    pub rivals: Vec<Rival>,
    /// How many rows there are, and how many were looked at.
    pub rows: [usize; 2],
}

impl Held {
    /// The recipe of the columns as they stand: they are what they are said to be. In what the orientation is written is no slip, and
    /// is as it was found.
    pub fn as_columns_stand(&self, recording: &Recording, roles: &Roles, arm: &Arm) -> Recipe {
        Recipe { format: self.recipe.format, ..Recipe::plain(recording, roles, arm) }
    }
}

/// Holds a recording against an arm.
///
/// # Errors
/// If the columns cannot be what they are taken for.
pub fn hold(
    arm: &Arm,
    recording: &Recording,
    roles: &Roles,
    options: &HoldOptions,
) -> Result<Held, HoldError> {
    fits(arm, recording, roles)?;
    let columns = prepare(recording, roles)?;
    let data = Data::new(&columns, arm, options.format)?;
    let strokes: Vec<f64> = (0..data.width()).map(|k| stroke(&columns, k)).collect();
    if strokes.iter().all(|s| *s == 0.0) {
        return Ok(nothing_moves(arm, recording, roles, &columns));
    }
    if data.is_sparse {
        // The noise is not seen: the least with which the recording is understood.
        let mut last = None;
        for (turn, shift) in SUPPOSED {
            let mut data = Data::new(&columns, arm, options.format)?;
            data.suppose(turn, shift);
            let held = searched(arm, recording, roles, options, &data, &strokes);
            let is_understood = held.is_understood;
            last = Some(held);
            if is_understood {
                break;
            }
        }
        if let Some(mut held) = last {
            held.noise = None;
            return Ok(held);
        }
    }
    Ok(searched(arm, recording, roles, options, &data, &strokes))
}

/// Noise that is supposed where it is not seen: radians, metres.
const SUPPOSED: [(f64, f64); 3] = [(1e-3, 0.3e-3), (8e-3, 3e-3), (3e-2, 1e-2)];

/// The search, and what is said of it.
fn searched(
    arm: &Arm,
    recording: &Recording,
    roles: &Roles,
    options: &HoldOptions,
    data: &Data,
    strokes: &[f64],
) -> Held {
    let mut search = Search::new(data, 0.0);
    let mut found = search.readings();
    let mut best = explain::best(&search, &found, options.others && found[0].rho <= UNDERSTOOD);
    let behind =
        if best.rho > explain::GOOD && !data.is_sparse { lag::estimate(data, search.bases()) } else { 0.0 };
    let mut shifted = None;
    if behind.abs() > 0.3 {
        let mut later = Search::new(data, behind);
        let readings = later.readings();
        if let Some(first) = readings.first() {
            // The lag becomes a number to be fitted.
            let free = first.free;
            let start = Reading { lag: 0.0, ..first.clone() };
            let fitted = search.finish(&start, &[(Extra::Lag, behind)], free, 6);
            if fitted.score < best.score - 2.0 {
                best = fitted;
                shifted = Some(readings);
            }
        }
    }
    if let Some(readings) = shifted {
        found = readings;
        if best.rho > explain::GOOD {
            let more = explain::best(&search, std::slice::from_ref(&best), options.others);
            if more.score < best.score {
                best = more;
            }
        }
    } else if options.others && best.rho > UNDERSTOOD {
        let other = explain::best(&search, &found, true);
        if other.score < best.score {
            best = other;
        }
    }
    let best = plainest(&search, best);
    let best = settled(&search, best);
    said(arm, recording, roles, &search, &found, best, strokes)
}

/// The columns as they stand take part at the end, whatever the survey of angles thought of them: with few rows frames take
/// up what a zero of a joint would, and one of the two is nothing to accuse.
fn plainest<'a>(search: &Search<'a>, best: Reading<'a>) -> Reading<'a> {
    let cheapest = search.bases().iter().map(Hypothesis::cost).fold(f64::INFINITY, f64::min);
    let plain = search.bases().iter().filter(|h| h.cost() <= cheapest);
    let framed = plain.flat_map(|h| search.framed(&Rc::new(h.clone()), best.format, search.data.arm));
    let direct = framed.filter(|r| r.direction == Direction::Direct);
    let all = direct.flat_map(|r| search.nested(&r, &[], 8));
    // What is as good but for a nat or two is told by what is accused.
    let accused = |r: &Reading| slips(r, search.data.arm).0.len();
    let own = accused(&best);
    let is_better = |r: &Reading| {
        r.score < best.score || (r.score < best.score + TIED && r.rho <= UNDERSTOOD && accused(r) < own)
    };
    let found = all.filter(is_better).min_by(|a, b| a.score.total_cmp(&b.score));
    found.unwrap_or(best)
}

/// A reading in which a frame that is none is exactly none, if that explains as much.
fn settled<'a>(search: &Search<'a>, best: Reading<'a>) -> Reading<'a> {
    let free = [best.has_base, best.has_tool];
    if best.free == free || best.rho > UNDERSTOOD {
        return best;
    }
    let extras = best.fit.extras.clone();
    let z = search.finish(&best, &extras, free, 8);
    let is_as_good =
        z.rho < 1.3 * best.rho + 0.1 && (z.has_base, z.has_tool) == (best.has_base, best.has_tool);
    if is_as_good { z } else { best }
}

/// Whether the numbers of columns fit.
fn fits(arm: &Arm, recording: &Recording, roles: &Roles) -> Result<(), HoldError> {
    let (found, needed) = (roles.joints.len(), arm.joints());
    let all = roles
        .joints
        .iter()
        .chain(&roles.position)
        .chain(&roles.rotation)
        .chain(&roles.time)
        .chain(&roles.episode);
    if all.into_iter().any(|&c| c >= recording.columns.len()) {
        return Err(HoldError::Lengths);
    }
    match () {
        () if found < needed || needed == 0 => Err(HoldError::Joints { found, needed }),
        () if found > needed + 3 || found > 16 => Err(HoldError::TooManyJoints { found, needed }),
        () if roles.position.len() != 3 => Err(HoldError::Position(roles.position.len())),
        () if ![3, 4, 6, 9].contains(&roles.rotation.len()) => Err(HoldError::Rotation(roles.rotation.len())),
        () => Ok(()),
    }
}

/// How far a column goes among the good rows.
fn stroke(columns: &Prepared, k: usize) -> f64 {
    let c = &columns.joints[k];
    let values = columns.good.iter().map(|&r| c[r]);
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    high - low
}

/// The slips of a reading, the small ones of its numbers apart.
fn slips<'a>(reading: &Reading<'a>, own: &Arm) -> (Vec<Slip>, Vec<Slip>) {
    let (mut slips, mut small) = (vec![], vec![]);
    slips.extend(match reading.hypothesis.unit {
        Unit::AsSaid => None,
        Unit::Degrees => Some(Slip::Degrees),
        Unit::Radians => Some(Slip::Radians),
        Unit::Hundred => Some(Slip::Hundred),
    });
    slips.extend(reading.hypothesis.dropped.iter().map(|&c| Slip::Dropped(c)));
    if reading.hypothesis.reversed {
        slips.push(Slip::Reversed);
    }
    slips.extend(reading.hypothesis.moves.iter().map(|m| match *m {
        Move::Flip(i) => Slip::Flip(i),
        Move::Quarter(i, k) => Slip::Quarter(i, k),
        Move::Swap(i, j) => Slip::Swap(i, j),
        Move::Couple(i, s) => Slip::Couple(i, s),
        Move::Degrees(i) => Slip::DegreesOne(i),
        Move::Gain(i, g) => Slip::Gain(i, g),
    }));
    slips.extend(match reading.direction {
        Direction::Direct => None,
        Direction::Inverse => Some(Slip::Inverse),
        Direction::Transposed => Some(Slip::Transposed),
    });
    let scale = reading.fit.frames.scale;
    if scale.abs() != 1.0 {
        slips.push(Slip::Unit(scale.abs()));
    }
    slips.extend(reading.mirror.map(Slip::LeftHanded));
    let (base, tool) = reading.plain_frames();
    if reading.has_base {
        slips.push(Slip::Base(base));
    }
    if reading.has_tool {
        slips.push(Slip::Tool(tool));
    }
    if !std::ptr::eq(reading.arm, own) {
        slips.push(Slip::OtherArm(reading.arm.name.clone()));
    }
    for (k, &(extra, value)) in reading.fit.extras.iter().enumerate() {
        let by = Fitted { value, deviation: reading.fit.deviations[k] };
        let (slip, least) = match extra {
            Extra::Lag => (Slip::Lag(by), SMALL[4]),
            Extra::Zero(i) => (Slip::Zero(i, by), if reading.arm.turns[i] { SMALL[0] } else { SMALL[3] }),
            Extra::Gain(i) => (Slip::GainBy(i, by), SMALL[1]),
            Extra::Couple(i) => (Slip::CoupleBy(i, by), SMALL[2]),
            Extra::Length(constant, axis) => {
                let model = reading.arm.constants[constant].translation[axis];
                (Slip::Length(Length { constant, axis, model, by }), SMALL[3])
            }
        };
        if value.abs() < least { small.push(slip) } else { slips.push(slip) }
    }
    (slips, small)
}

/// How far the hand is off under a reading at rows, root mean squares of turn and shift, rows that are far off left out.
fn off(search: &Search, reading: &Reading, rows: &[usize]) -> Off {
    let residuals = residuals(search, reading, rows);
    let mut turns: Vec<f64> = vec![];
    let mut shifts: Vec<f64> = vec![];
    for r in residuals {
        turns.push(r[..3].iter().map(|x| x * x).sum::<f64>().sqrt() * reading.scale.turn);
        shifts.push(r[3..].iter().map(|x| x * x).sum::<f64>().sqrt() * reading.scale.shift);
    }
    let middle = |mut x: Vec<f64>| {
        let most = 3.0 * crate::columns::median(x.clone()) + 1e-300;
        x.iter_mut().for_each(|x| *x = x.min(most));
        (x.iter().map(|x| x * x).sum::<f64>() / x.len().max(1) as f64).sqrt()
    };
    Off { turn: middle(turns), shift: middle(shifts) }
}

/// Rows at which the hand is this much further off than at most of them, and by so many units of what is expected.
const FAR: f64 = 8.0;
const EXPECTED: f64 = 4.0;

/// The rows that are far off although others are not.
fn apart(search: &Search, reading: &Reading, rows: &[usize]) -> Vec<usize> {
    let recorded = |r: &usize| search.data.recorded(reading.format, *r).is_some();
    let rows: Vec<usize> = rows.iter().copied().filter(recorded).collect();
    let sizes = crate::fit::sizes(&residuals(search, reading, &rows));
    let limit = (FAR * crate::columns::median(sizes.clone())).max(EXPECTED);
    rows.into_iter().zip(sizes).filter(|(_, size)| *size > limit).map(|(r, _)| r).collect()
}

/// Residuals at rows.
fn residuals(search: &Search, reading: &Reading, rows: &[usize]) -> Vec<[f64; 6]> {
    let data = search.data;
    let rows: Vec<usize> =
        rows.iter().copied().filter(|&r| data.recorded(reading.format, r).is_some()).collect();
    let recorded = data.poses(reading.format, reading.direction, &rows);
    let joints = |r: usize, lag: f64, q: &mut Vec<f64>| {
        let mut row = vec![];
        data.row(r, lag, &mut row);
        reading.map.apply(&row, q);
    };
    let problem = Problem {
        arm: reading.arm,
        joints: &joints,
        rows: &rows,
        recorded: &recorded,
        scale: reading.scale,
        lag: reading.lag,
    };
    problem.residuals(&reading.fit.frames, &problem.model(&reading.fit.extras))
}

/// A reading in which one slip is left as it stands.
fn left_alone<'a>(search: &Search<'a>, reading: &Reading<'a>, slip: &Slip) -> Option<Reading<'a>> {
    let data = search.data;
    let mut other = reading.clone();
    let mut hypothesis: Hypothesis = (*reading.hypothesis).clone();
    let without = |m: Move, h: &mut Hypothesis| h.moves.retain(|x| *x != m);
    match *slip {
        Slip::Degrees | Slip::Radians | Slip::Hundred => hypothesis.unit = Unit::AsSaid,
        Slip::Reversed => hypothesis.reversed = false,
        Slip::Swap(i, j) => without(Move::Swap(i, j), &mut hypothesis),
        Slip::Flip(i) => without(Move::Flip(i), &mut hypothesis),
        Slip::Quarter(i, k) => without(Move::Quarter(i, k), &mut hypothesis),
        Slip::Couple(i, s) => without(Move::Couple(i, s), &mut hypothesis),
        Slip::DegreesOne(i) => without(Move::Degrees(i), &mut hypothesis),
        Slip::Gain(i, g) => without(Move::Gain(i, g), &mut hypothesis),
        Slip::Base(_) => {
            let m = reading.mirror.map_or_else(denavit::geometry::Rotation::identity, crate::arm::half_turn);
            other.fit.frames.base =
                Transform::from_rotation_translation(m, denavit::geometry::Vector::zero());
        }
        Slip::Tool(_) => {
            let m = reading.mirror.map_or_else(denavit::geometry::Rotation::identity, crate::arm::half_turn);
            other.fit.frames.tool =
                Transform::from_rotation_translation(m, denavit::geometry::Vector::zero());
        }
        Slip::Lag(_) => other.fit.extras.retain(|e| e.0 != Extra::Lag),
        Slip::Zero(i, _) => other.fit.extras.retain(|e| e.0 != Extra::Zero(i)),
        Slip::GainBy(i, _) => other.fit.extras.retain(|e| e.0 != Extra::Gain(i)),
        Slip::CoupleBy(i, _) => other.fit.extras.retain(|e| e.0 != Extra::Couple(i)),
        Slip::Length(l) => other.fit.extras.retain(|e| e.0 != Extra::Length(l.constant, l.axis)),
        _ => return None,
    }
    other.map = Rc::new(hypothesis.map(data.width(), reading.arm));
    other.hypothesis = Rc::new(hypothesis);
    Some(other)
}

/// Readings by other words that are the same function: the zero of the first joint is a turn of the base, that of the last one
/// of the tool.
fn same_function(slip: &Slip, arm: &Arm) -> Vec<Slip> {
    let last = arm.joints() - 1;
    let turn = |angle: f64| Transform::rotation_z(angle);
    let quarter = |k: i8| f64::from(k) * std::f64::consts::FRAC_PI_2;
    let angle = match slip {
        Slip::Quarter(i, k) if arm.turns[*i] => Some((*i, quarter(*k))),
        Slip::Zero(i, by) if arm.turns[*i] => Some((*i, by.value)),
        _ => None,
    };
    // B C₀ Rz(c − z) = B C₀ Rz(−z) C₀⁻¹ · C₀ Rz(c)
    let about = |c: &Transform<f64>, angle: f64| *c * turn(-angle) * c.inverse();
    let (first, behind) = (&arm.constants[0], &arm.constants[arm.constants.len() - 1]);
    match angle {
        Some((0, a)) => vec![Slip::Base(about(first, a))],
        Some((i, a)) if i == last => vec![Slip::Tool(behind.inverse() * turn(-a) * *behind)],
        _ => vec![],
    }
}

#[allow(clippy::too_many_arguments)]
fn said<'a>(
    arm: &Arm,
    recording: &Recording,
    roles: &Roles,
    search: &Search<'a>,
    found: &[Reading<'a>],
    best: Reading<'a>,
    strokes: &[f64],
) -> Held {
    let data = search.data;
    let columns = data.columns;
    let judged = spread(&columns.good, 1000);
    let left_over = off(search, &best, &judged);
    let is_understood =
        best.rho < UNDERSTOOD && left_over.turn < MOST_LEFT.turn && left_over.shift < MOST_LEFT.shift;
    let noise = Off {
        turn: 3_f64.sqrt() * data.decoded[best.format].noise,
        shift: 3_f64.sqrt() * data.noise_position / best.fit.frames.scale.abs(),
    };
    let (mut all, small) = slips(&best, arm);
    let mut findings = vec![];
    let mut remarks: Vec<Finding> = vec![];
    let bare = |slip: Slip| Finding { slip, without: None, same: vec![] };
    if is_understood {
        for slip in all.drain(..) {
            let without = left_alone(search, &best, &slip).map(|r| off(search, &r, &data.held));
            let same = same_function(&slip, best.arm);
            findings.push(Finding { slip, without, same });
        }
        remarks.extend(small.into_iter().map(bare));
    } else {
        findings.extend(needed::at_fault(search, found).map(|u: Unlike| bare(Slip::Unlike(u))));
        findings.push(bare(Slip::NotUnderstood));
    }
    findings.extend(columns.jumps.iter().map(|j| bare(Slip::Jump(j.column, j.row, j.count, j.turn))));
    if is_understood {
        findings.extend(stuck(search, &best).into_iter().map(|s| bare(Slip::Stuck(s))));
    }
    if is_understood {
        let apart = apart(search, &best, &judged);
        let is_known = |r: &usize| {
            columns.spikes.contains(r)
                || findings.iter().any(|f| matches!(&f.slip, Slip::Stuck(s) if (s.from..s.to).contains(r)))
        };
        let rows: Vec<usize> = apart.into_iter().filter(|r| !is_known(r)).collect();
        if rows.len() >= 2 {
            findings.push(bare(Slip::Apart(rows, judged.len())));
        }
    }
    if columns.spikes.len() >= 2 {
        findings.push(bare(Slip::Spikes(columns.spikes.clone())));
    } else if !columns.spikes.is_empty() {
        remarks.push(bare(Slip::Spikes(columns.spikes.clone())));
    }
    if !columns.back.is_empty() {
        findings.push(bare(Slip::TimeBack(columns.back.clone())));
    }
    for (rows, slip) in
        [(&columns.missing, Slip::Missing as fn(Vec<usize>) -> Slip), (&columns.gaps, Slip::Gaps)]
    {
        if !rows.is_empty() {
            remarks.push(bare(slip(rows.clone())));
        }
    }
    let rivals = if is_understood { rivals(data, found, &best, arm) } else { vec![] };
    let has_own_lengths = !best.fit.extras.iter().any(|e| matches!(e.0, Extra::Length(..)));
    let is_computed = is_understood
        && std::ptr::eq(best.arm, arm)
        && has_own_lengths
        && left_over.turn < 2e-6
        && left_over.shift < 2e-6;
    let unseen = if is_understood { unseen(search, &best, strokes) } else { vec![] };
    let recipe = Recipe::of(recording, roles, data, &best, &findings, left_over);
    Held {
        recipe,
        findings,
        remarks,
        left_over,
        noise: Some(noise),
        rho: best.rho,
        is_understood,
        is_computed,
        unseen,
        rivals,
        rows: [columns.position.len(), data.fit.len() + data.held.len() + 2 * data.pairs.len()],
    }
}

/// Readings that are within a few nats of the best.
fn rivals(data: &Data, found: &[Reading], best: &Reading, own: &Arm) -> Vec<Rival> {
    if !best.fit.extras.is_empty() {
        return vec![];
    }
    let is_it = |r: &Reading| {
        r.hypothesis.key() == best.hypothesis.key()
            && r.format == best.format
            && r.direction == best.direction
            && (r.has_base, r.has_tool) == (best.has_base, best.has_tool)
            && std::ptr::eq(r.arm, best.arm)
    };
    let mut rivals: Vec<Rival> = vec![];
    for r in found.iter().filter(|r| r.score < best.score + TIED && !is_it(r)) {
        let slips = slips(r, own).0;
        let format = data.decoded[r.format].format;
        // Base and tool apart, which differ in the last digits.
        let known = rivals.iter().any(|o| o.format == format && names(&o.slips) == names(&slips));
        if !known {
            rivals.push(Rival { slips, format, nats: r.score - best.score });
        }
    }
    rivals
}

/// The kinds of slips with their joints, without fitted numbers.
fn names(slips: &[Slip]) -> Vec<Slip> {
    let plain = |s: &Slip| match s {
        Slip::Base(_) => Slip::Base(Transform::identity()),
        Slip::Tool(_) => Slip::Tool(Transform::identity()),
        other => other.clone(),
    };
    slips.iter().map(plain).collect()
}

/// Runs of one value that the pose contradicts.
fn stuck(search: &Search, best: &Reading) -> Vec<Stuck> {
    let mut all = vec![];
    for run in &search.data.columns.runs {
        let rows: Vec<usize> = (run.from + 2..run.to.saturating_sub(1)).collect();
        if rows.len() < 5 {
            continue;
        }
        let sizes = sizes(&residuals(search, best, &spread(&rows, 300)));
        let Some(joint) = best.map.pick.iter().position(|&c| c == run.column) else { continue };
        if crate::columns::median(sizes) > APART * best.rho.max(0.3) {
            let meanwhile = needed::range(search, best, joint, &spread(&rows, 300));
            all.push(Stuck { joint, from: run.from, to: run.to, meanwhile });
        }
    }
    all
}

/// What no motion in the recording tells.
fn unseen(search: &Search, best: &Reading, strokes: &[f64]) -> Vec<Unseen> {
    let mut all = vec![];
    for joint in 0..best.arm.joints() {
        let column = best.map.pick[joint];
        let moved = strokes[column] * best.map.scale[joint].abs();
        if moved == 0.0 {
            all.push(Unseen::Still(joint));
            continue;
        }
        // A sign shows by two strokes; a joint that moves much is not looked at.
        if !best.arm.turns[joint] || moved > 0.5 {
            continue;
        }
        let flipped = Rc::new(best.hypothesis.plus(Move::Flip(joint)));
        let other = search.framed(&flipped, best.format, best.arm);
        let near = other
            .into_iter()
            .filter(|r| r.direction == best.direction)
            .map(|r| search.finish(&r, &[], [true; 2], 5).rho);
        let rho = near.fold(f64::INFINITY, f64::min);
        let nats = 60.0 * ((0.15 + rho) / (0.15 + best.rho)).ln();
        if nats < TIED {
            // ρ² grows by (2 q/σ)²/6 for deviations q of the joint from its mean; 8 nats are asked for.
            let wanted = (8.0_f64 / 60.0).exp() * (0.15 + best.rho) - 0.15;
            let grown = (wanted * wanted - best.rho * best.rho).max(1e-6);
            let deviation = best.scale.turn * (6.0 * grown).sqrt() / 2.0;
            all.push(Unseen::Sign(joint, moved, (2.0 * 2_f64.sqrt() * deviation).max(2.0 * moved)));
        }
    }
    all
}

/// What is said where no joint moves.
fn nothing_moves(arm: &Arm, recording: &Recording, roles: &Roles, columns: &Prepared) -> Held {
    let recipe = Recipe::plain(recording, roles, arm);
    Held {
        recipe,
        findings: vec![],
        remarks: vec![],
        left_over: Off::default(),
        noise: None,
        rho: 0.0,
        is_understood: true,
        is_computed: false,
        unseen: vec![Unseen::Everything],
        rivals: vec![],
        rows: [columns.position.len(), 0],
    }
}
