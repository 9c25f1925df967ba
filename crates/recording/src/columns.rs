//! What columns say of themselves: missing numbers, jumps of a whole turn, runs of one value, spikes, noise.
//!
//! Nothing is corrected but whole turns; rows that are suspect are left out of the search, and judged once it is done.

use crate::recording::{HoldError, LEAST, Recording, Roles, Said};
use crate::times::seconds_by_step;
use denavit::geometry::Vector;
use std::f64::consts::TAU;

/// A run of one value this long is suspect in a column that seldom repeats.
const RUN: usize = 20;
/// What part of a column's steps may be 0 before it is one that often repeats.
const SELDOM: f64 = 0.4;
/// Steps this near to a whole turn are one, as part of it.
const NEAR: f64 = 0.06;
/// How many places the noise is taken from.
const PLACES: usize = 1500;

/// A run of one value in a joint's column: rows `from..to`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Run {
    /// The column, as a number among the joints' columns.
    pub column: usize,
    /// The first row.
    pub from: usize,
    /// Behind the last row.
    pub to: usize,
}

/// A jump of whole turns in a joint's column.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Jump {
    /// The column, as a number among the joints' columns.
    pub column: usize,
    /// The first row behind it.
    pub row: usize,
    /// How many jumps there are.
    pub count: usize,
    /// What a turn is in the column: 2π or 360.
    pub turn: f64,
}

/// Columns made ready: in SI as far as headers say units, whole turns undone.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The joints' columns.
    pub joints: Vec<Vec<f64>>,
    /// Whether a joint's column is said to be in degrees.
    pub said_degrees: Vec<bool>,
    /// The position.
    pub position: Vec<Vector<f64>>,
    /// Whether the position is said to be in some unit.
    pub said_length: Option<Said>,
    /// The columns of the orientation, as they stand; in radians if they are said to be degrees.
    pub rotation: Vec<Vec<f64>>,
    /// Whether the angles of the orientation are said to be degrees.
    pub rotation_degrees: bool,
    /// Seconds from row to row, where there is a time.
    pub step: Option<f64>,
    /// Whether a row follows the one before it: in time, and in its episode.
    pub follows: Vec<bool>,
    /// Rows to search in.
    pub good: Vec<usize>,
    /// Rows in which a number is missing.
    pub missing: Vec<usize>,
    /// Jumps that were undone.
    pub jumps: Vec<Jump>,
    /// Runs of one value.
    pub runs: Vec<Run>,
    /// Rows whose pose is far from both neighbours.
    pub spikes: Vec<usize>,
    /// Rows at which the time goes back or stands still.
    pub back: Vec<usize>,
    /// Rows before which time is missing.
    pub gaps: Vec<usize>,
}

/// Lagrange's cubic through rows −1, 0, 1, 2 at a place between 0 and 1: what each is multiplied with.
pub fn cubic(f: f64) -> [f64; 4] {
    [
        -f * (f - 1.0) * (f - 2.0) / 6.0,
        (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0,
        -(f + 1.0) * f * (f - 2.0) / 2.0,
        (f + 1.0) * f * (f - 1.0) / 6.0,
    ]
}

/// The middle of numbers; 0 of none.
pub fn median(mut x: Vec<f64>) -> f64 {
    x.retain(|x| x.is_finite());
    if x.is_empty() {
        return 0.0;
    }
    let at = x.len() / 2;
    *x.select_nth_unstable_by(at, f64::total_cmp).1
}

/// Makes columns ready.
///
/// # Errors
/// If too few rows are whole, or the columns do not fit one another.
pub fn prepare(recording: &Recording, roles: &Roles) -> Result<Prepared, HoldError> {
    let rows = recording.columns.first().map_or(0, |c| c.values.len());
    if recording.columns.iter().any(|c| c.values.len() != rows) {
        return Err(HoldError::Lengths);
    }
    let column = |c: usize| &recording.columns[c];
    let in_si = |c: usize| -> Vec<f64> {
        let k = column(c).said.map_or(1.0, Said::si);
        column(c).values.iter().map(|x| k * x).collect()
    };
    let degrees = |c: &usize| column(*c).said == Some(Said::Degrees);
    let mut joints: Vec<Vec<f64>> = roles.joints.iter().map(|&c| in_si(c)).collect();
    let position: Vec<Vec<f64>> = roles.position.iter().map(|&c| in_si(c)).collect();
    let position = (0..rows).map(|r| Vector(std::array::from_fn(|k| position[k][r]))).collect::<Vec<_>>();
    let rotation: Vec<Vec<f64>> = roles.rotation.iter().map(|&c| in_si(c)).collect();

    let is_whole = |r: usize| {
        let number = |c: &[f64]| c[r].is_finite();
        joints.iter().all(|c| number(c))
            && rotation.iter().all(|c| number(c))
            && position[r].0.iter().all(|x| x.is_finite())
    };
    let mut mask: Vec<bool> = (0..rows).map(is_whole).collect();
    let missing: Vec<usize> = (0..rows).filter(|&r| !mask[r]).collect();
    if rows - missing.len() < LEAST {
        return Err(HoldError::Rows { whole: rows - missing.len(), all: rows });
    }
    let (step, follows, back, gaps) = times(recording, roles, &mask);
    let (mut jumps, mut runs) = (vec![], vec![]);
    for (k, c) in joints.iter_mut().enumerate() {
        jumps.extend(unwrapped(c, k, &mask));
        runs.extend(repeated(c, k));
    }
    for run in &runs {
        mask[run.from.saturating_sub(1)..(run.to + 1).min(rows)].fill(false);
    }
    let spikes = spikes(&position, &mask);
    spikes.iter().for_each(|&r| mask[r] = false);
    Ok(Prepared {
        joints,
        said_degrees: roles.joints.iter().map(degrees).collect(),
        position,
        said_length: roles.position.first().and_then(|&c| column(c).said),
        rotation,
        rotation_degrees: roles.rotation.iter().any(degrees),
        step,
        follows,
        good: (0..rows).filter(|&r| mask[r]).collect(),
        missing,
        jumps,
        runs,
        spikes,
        back,
        gaps,
    })
}

type Times = (Option<f64>, Vec<bool>, Vec<usize>, Vec<usize>);

/// The step of time in seconds, which rows follow the one before, where time goes back, where some is missing.
fn times(recording: &Recording, roles: &Roles, mask: &[bool]) -> Times {
    let rows = mask.len();
    let episode = |r: usize| roles.episode.map(|c| recording.columns[c].values[r].to_bits());
    let mut follows: Vec<bool> =
        (0..rows).map(|r| r > 0 && mask[r] && mask[r - 1] && episode(r) == episode(r - 1)).collect();
    let Some(time) = roles.time.map(|c| &recording.columns[c]) else {
        return (None, follows, vec![], vec![]);
    };
    let difference = |r: usize| time.values[r] - time.values[r - 1];
    let steps: Vec<f64> = (1..rows).filter(|&r| follows[r]).map(difference).filter(|d| *d > 0.0).collect();
    let usual = median(steps);
    if usual <= 0.0 {
        return (None, follows, vec![], vec![]);
    }
    let unit = time.said.map_or_else(|| seconds_by_step(usual, &time.values), Said::si);
    let (mut back, mut gaps) = (vec![], vec![]);
    for (r, is_next) in follows.iter_mut().enumerate().filter(|f| *f.1) {
        let d = difference(r);
        if d <= 0.0 {
            back.push(r);
        } else if d > 5.0 * usual {
            gaps.push(r);
        }
        *is_next = d > 0.0 && d <= 5.0 * usual;
    }
    (Some(usual * unit), follows, back, gaps)
}

/// Undoes jumps by whole turns.
fn unwrapped(c: &mut [f64], column: usize, mask: &[bool]) -> Option<Jump> {
    let rows: Vec<usize> = (0..c.len()).filter(|&r| mask[r]).collect();
    let steps: Vec<f64> = rows.windows(2).map(|w| c[w[1]] - c[w[0]]).collect();
    let usual = median(steps.iter().map(|d| d.abs()).collect()) + 1e-12;
    let largest = rows.iter().map(|&r| c[r].abs()).fold(0.0, f64::max);
    for turn in [TAU, 360.0] {
        let times = |d: &f64| (d / turn).round();
        let is_jump = |d: &f64| times(d) != 0.0 && (d - times(d) * turn).abs() < NEAR * turn;
        let count = steps.iter().filter(|d| is_jump(d)).count();
        if count == 0 || count >= 20.max(steps.len() / 50) || usual >= 0.02 * turn || largest <= turn / 2.2 {
            continue;
        }
        let first = steps.iter().position(is_jump).map_or(0, |k| rows[k + 1]);
        let mut turns = 0.0;
        let mut at = 1;
        for (r, x) in c.iter_mut().enumerate().skip(rows[0] + 1) {
            if at < rows.len() && rows[at] == r {
                let d = steps[at - 1];
                if is_jump(&d) {
                    turns += times(&d);
                }
                at += 1;
            }
            *x -= turn * turns;
        }
        return Some(Jump { column, row: first, count, turn });
    }
    None
}

/// Runs of one exact value.
fn repeated(c: &[f64], column: usize) -> Vec<Run> {
    let still = c.windows(2).filter(|w| w[0] == w[1]).count();
    if still as f64 >= SELDOM * c.len() as f64 {
        return vec![];
    }
    let (mut runs, mut from) = (vec![], 0);
    for r in 1..=c.len() {
        if r == c.len() || c[r] != c[from] {
            if r - from > RUN {
                runs.push(Run { column, from, to: r });
            }
            from = r;
        }
    }
    runs
}

/// Rows whose position is far from both neighbours, while these are near each other.
fn spikes(position: &[Vector<f64>], mask: &[bool]) -> Vec<usize> {
    let far = |a: usize, b: usize| (position[b] - position[a]).norm();
    let steps: Vec<f64> =
        (1..position.len()).filter(|&r| mask[r] && mask[r - 1]).map(|r| far(r - 1, r)).collect();
    let most = 8.0 * median(steps) + 1e-9;
    let is_spike = |&r: &usize| {
        mask[r - 1]
            && mask[r]
            && mask[r + 1]
            && far(r - 1, r) > most
            && far(r, r + 1) > most
            && far(r - 1, r + 1) < most
    };
    (1..position.len().saturating_sub(1)).filter(is_spike).collect()
}

/// The noise of a column from third differences, at places spread over rows that follow one another.
pub fn noise(follows: &[bool], of: impl Fn(usize) -> f64) -> f64 {
    let places = places(follows);
    let third = |&r: &usize| (of(r + 3) - 3.0 * of(r + 2) + 3.0 * of(r + 1) - of(r)).abs();
    median(places.iter().map(third).collect()) / (0.6745 * 20_f64.sqrt())
}

/// Rows with three behind them that follow, spread over the recording.
pub fn places(follows: &[bool]) -> Vec<usize> {
    let rows = follows.len();
    let is_one = |r: &usize| follows[r + 1] && follows[r + 2] && follows[r + 3];
    let all: Vec<usize> = (0..rows.saturating_sub(3)).filter(is_one).collect();
    let every = all.len().div_ceil(PLACES).max(1);
    all.into_iter().step_by(every).collect()
}
