//! Recorded columns made into motion: even times, whole turns undone, filtered without delay, with rates and accelerations.

use crate::signal::{EDGE, LowPass, band, derivative, median, noise, noise_of_rates, second_derivative};
use std::f64::consts::TAU;

/// Columns in SI, a row a time; each list has an entry per joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    /// Seconds.
    pub time: Vec<f64>,
    /// Rows at which something new begins: another episode, another file.
    pub starts: Vec<usize>,
    /// Joint variables.
    pub q: Vec<Vec<f64>>,
    /// Their rates, if they are recorded.
    pub qd: Option<Vec<Vec<f64>>>,
    /// Their accelerations, if they are recorded.
    pub qdd: Option<Vec<Vec<f64>>>,
    /// Torques.
    pub tau: Vec<Vec<f64>>,
}

/// How columns are filtered.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Cutoff {
    /// Where the motion of the joints is as small as its noise, twice that.
    #[default]
    Found,
    /// At a frequency, Hz.
    At(f64),
    /// Not at all: all rows count as they are.
    None,
}

/// An even stretch of motion.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// The first row of the recording in it.
    pub row: usize,
    /// Its first time.
    pub start: f64,
    /// Joint by joint.
    pub q: Vec<Vec<f64>>,
    /// Rates.
    pub qd: Vec<Vec<f64>>,
    /// Accelerations.
    pub qdd: Vec<Vec<f64>>,
    /// The signs of the rates, under the same filters as the torques.
    pub signs: Vec<Vec<f64>>,
    /// Torques.
    pub tau: Vec<Vec<f64>>,
}

/// Motion to identify from.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Even stretches, the ends that filters spoil left out.
    pub stretches: Vec<Stretch>,
    /// Seconds between rows.
    pub step: f64,
    /// The frequency of the filter of the positions, Hz.
    pub cutoff: Option<f64>,
    /// The frequency of the filter under which torques and their regressor go alike, and how many rows are taken as one.
    pub parallel: Option<(f64, usize)>,
    /// The noise of the rates, joint by joint.
    pub rate_noise: Vec<f64>,
    /// What was done.
    pub remarks: Vec<Remark>,
}

/// What is worth saying of a recording.
#[derive(Clone, PartialEq, Debug)]
pub enum Remark {
    /// Rows in which a number is missing.
    Missing(usize),
    /// Rows at which the time goes back or stands still.
    Back(usize),
    /// Places where time is missing.
    Gaps(usize),
    /// Times are uneven, by this part of a step: even ones are taken between them.
    Uneven(f64),
    /// Whole turns were undone in this joint's column.
    Turns(usize),
    /// Stretches too short for the filter.
    Short(usize),
    /// Columns of the joints without unit hold degrees; so many times larger is what is left over where they are taken for
    /// radians, or they are no motion then.
    Degrees(Option<f64>),
}

/// Why columns are no motion.
#[derive(Clone, PartialEq, Debug)]
pub enum NoMotion {
    /// Too few rows are whole.
    Rows {
        /// How many are.
        whole: usize,
        /// How many rows there are.
        all: usize,
    },
    /// Time does not go on.
    Time,
    /// Too few rows follow one another for the filter.
    Short {
        /// The longest stretch, rows.
        longest: usize,
        /// So many are needed.
        needed: usize,
    },
    /// A frequency that is beyond half the rate of rows, Hz.
    Cutoff(f64, f64),
    /// The recorded rates of a joint are so many times those of its positions.
    Rates(usize, f64),
    /// The recorded accelerations of a joint are so many times those of its rates.
    Accelerations(usize, f64),
}

/// The fewest rows.
const LEAST: usize = 32;
/// Steps longer than so many are gaps.
const GAP: f64 = 1.6;
/// Above this part of a step times are uneven.
const UNEVEN: f64 = 0.02;
/// The filter's frequency by the highest of the motion, and at most by the rate of rows.
const BEYOND: f64 = 2.0;
const HIGHEST: f64 = 0.2;
/// The parallel filter's frequency by the filter's, and rows by that.
const PARALLEL: f64 = 0.7;
const ROWS: f64 = 2.5;
/// Rows a second by the filter's frequency: more of them tell nothing.
const DENSE: f64 = 16.0;

impl Motion {
    /// Of columns.
    ///
    /// # Errors
    /// If they are none.
    pub fn of(columns: &Columns, turns: &[bool], cutoff: Cutoff) -> Result<Self, NoMotion> {
        let mut remarks = vec![];
        let (pieces, step) = even(columns, turns, &mut remarks)?;
        let rate = 1.0 / step;
        let n = columns.q.len();
        let column_noise = |j: usize| median(pieces.iter().map(|p| noise(&p.q[j])).collect());
        let noises: Vec<f64> = (0..n).map(column_noise).collect();
        let found = || {
            let of =
                |j: usize| pieces.iter().filter_map(move |p| Some((j, band(&p.q[j], noises_of(&p.q[j]))?)));
            let highest = (0..n).flat_map(of).map(|(_, f)| f).fold(0.0, f64::max);
            if highest > 0.0 { (BEYOND * highest).min(HIGHEST) * rate } else { HIGHEST * rate }
        };
        let cutoff = match cutoff {
            Cutoff::None => None,
            Cutoff::Found => Some(found()),
            Cutoff::At(f) if f < 0.45 * rate => Some(f),
            Cutoff::At(f) => return Err(NoMotion::Cutoff(f, rate)),
        };
        let pass = cutoff.map(|f| LowPass::new(f / rate));
        let every = cutoff.map_or(1, |f| ((rate / (DENSE * f)) as usize).max(1));
        let parallel = cutoff.map(|f| {
            let f = PARALLEL * f;
            (f, ((rate / every as f64 / (ROWS * f)) as usize).max(1))
        });
        // What was recorded is not differenced again: its own noise is all that it has.
        let has_rates = columns.qd.is_some();
        let edge =
            pass.as_ref().map_or(0, |p| 3 * p.settles / 2) + if columns.qdd.is_some() { 0 } else { EDGE };
        // The ends that the second filter spoils, and two rows between them.
        let second = parallel.map_or(0, |(f, _)| ((2.0 + 2.0 / ROWS) * rate / f) as usize);
        let needed = (2 * edge + 8).max(LEAST).saturating_add(second);
        let longest = pieces.iter().map(|p| p.q[0].len()).max().unwrap_or(0);
        if longest < needed {
            return Err(NoMotion::Short { longest, needed });
        }
        let short = pieces.iter().filter(|p| p.q[0].len() < needed).count();
        if short > 0 {
            remarks.push(Remark::Short(short));
        }
        let mut stretches = vec![];
        for piece in pieces.into_iter().filter(|p| p.q[0].len() >= needed) {
            let smooth = |all: &[Vec<f64>]| -> Vec<Vec<f64>> {
                all.iter().map(|x| pass.as_ref().map_or_else(|| x.clone(), |p| p.applied(x))).collect()
            };
            let q = smooth(&piece.q);
            let qd = match &piece.qd {
                Some(qd) => smooth(qd),
                None => q.iter().map(|x| derivative(x, step)).collect(),
            };
            let qdd = match (&piece.qdd, has_rates) {
                (Some(qdd), _) => smooth(qdd),
                (None, true) => qd.iter().map(|x| derivative(x, step)).collect(),
                (None, false) => q.iter().map(|x| second_derivative(x, step)).collect(),
            };
            consistent(&q, &qd, &qdd, step, edge.max(EDGE))?;
            // Far above what the parallel filter lets through; so that fewer rows show the same.
            let wide = cutoff.filter(|_| every > 1).map(|f| LowPass::new((4.0 * f / rate).min(0.45)));
            let thinned = |all: Vec<Vec<f64>>| match &wide {
                Some(wide) => all.iter().map(|x| wide.applied(x)).collect(),
                None => all,
            };
            // A joint turns round between rows: the mean of the sign over the time of a row.
            let part = if cutoff.is_some() { step } else { 0.0 };
            let sign = |(v, a): (&f64, &f64)| match 0.5 * part * a.abs() {
                _ if *v == 0.0 => 0.0,
                half if half > v.abs() => v / half,
                _ => v.signum(),
            };
            let signs = qd.iter().zip(&qdd).map(|(v, a)| v.iter().zip(a).map(sign).collect()).collect();
            let (signs, tau) = (thinned(signs), thinned(piece.tau));
            let rows = q[0].len();
            let kept = |all: &[Vec<f64>]| -> Vec<Vec<f64>> {
                all.iter().map(|x| x[edge..rows - edge].iter().step_by(every).copied().collect()).collect()
            };
            stretches.push(Stretch {
                row: piece.row + edge,
                start: piece.start + edge as f64 * step,
                q: kept(&q),
                qd: kept(&qd),
                qdd: kept(&qdd),
                signs: kept(&signs),
                tau: kept(&tau),
            });
        }
        let rates_of = |x: f64| cutoff.map_or(0.0, |f| noise_of_rates(x, f, rate));
        let rate_noise = match &columns.qd {
            Some(qd) => qd.iter().map(|x| noise(x)).collect(),
            None => noises.iter().map(|&x| rates_of(x)).collect(),
        };
        Ok(Motion { stretches, step: step * every as f64, cutoff, parallel, rate_noise, remarks })
    }

    /// The seconds of all stretches.
    pub fn seconds(&self) -> f64 {
        self.stretches.iter().map(|s| s.q[0].len() as f64 * self.step).sum()
    }
}

fn noises_of(x: &[f64]) -> f64 {
    // Rounding is noise, too.
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    noise(x).max(1e-12 * largest)
}

struct Piece {
    row: usize,
    start: f64,
    q: Vec<Vec<f64>>,
    qd: Option<Vec<Vec<f64>>>,
    qdd: Option<Vec<Vec<f64>>>,
    tau: Vec<Vec<f64>>,
}

/// Stretches with even times.
fn even(columns: &Columns, turns: &[bool], remarks: &mut Vec<Remark>) -> Result<(Vec<Piece>, f64), NoMotion> {
    let rows = columns.time.len();
    let all = || {
        let more = columns.qd.iter().chain(&columns.qdd).flatten();
        columns.q.iter().chain(&columns.tau).chain(more)
    };
    let is_whole = |r: usize| columns.time[r].is_finite() && all().all(|c| c[r].is_finite());
    let whole: Vec<usize> = (0..rows).filter(|&r| is_whole(r)).collect();
    if whole.len() < LEAST {
        return Err(NoMotion::Rows { whole: whole.len(), all: rows });
    }
    if whole.len() < rows {
        remarks.push(Remark::Missing(rows - whole.len()));
    }
    let t = &columns.time;
    let is_start = |w: &[usize]| columns.starts.iter().any(|&s| s > w[0] && s <= w[1]);
    let steps: Vec<f64> =
        whole.windows(2).filter(|w| !is_start(w)).map(|w| t[w[1]] - t[w[0]]).filter(|d| *d > 0.0).collect();
    let step = median(steps.clone());
    if step <= 0.0 {
        return Err(NoMotion::Time);
    }
    let near: Vec<f64> = steps.iter().filter(|d| **d < GAP * step).map(|d| (d - step).abs()).collect();
    let uneven = near.iter().sum::<f64>() / near.len().max(1) as f64 / step;
    // Over many rows even small differences add up: the step is what fits all.
    let mean: f64 = steps.iter().filter(|d| **d < GAP * step).sum::<f64>() / near.len().max(1) as f64;
    let step = if uneven < UNEVEN { mean } else { step };
    let (mut back, mut gaps) = (0, 0);
    let mut pieces: Vec<Vec<usize>> = vec![vec![whole[0]]];
    for w in whole.windows(2) {
        let d = t[w[1]] - t[w[0]];
        let is_new = is_start(w);
        if !is_new && d <= 0.0 {
            back += 1;
        } else if !is_new && d >= GAP * step {
            gaps += 1;
        }
        if is_new || d <= 0.0 || d >= GAP * step {
            pieces.push(vec![]);
        }
        if let Some(piece) = pieces.last_mut() {
            piece.push(w[1]);
        }
    }
    remarks.extend((back > 0).then_some(Remark::Back(back)));
    remarks.extend((gaps > 0).then_some(Remark::Gaps(gaps)));
    let mut turned = vec![false; columns.q.len()];
    let mut found = vec![];
    for piece in &pieces {
        let of = |c: &Vec<f64>| -> Vec<f64> { piece.iter().map(|&r| c[r]).collect() };
        let mut q: Vec<Vec<f64>> = columns.q.iter().map(of).collect();
        for (j, x) in q.iter_mut().enumerate().filter(|(j, _)| turns[*j]) {
            turned[j] |= unwrapped(x);
        }
        let times: Vec<f64> = piece.iter().map(|&r| t[r]).collect();
        let evened = |x: Vec<f64>| if uneven < UNEVEN { x } else { resampled(&times, &x, step) };
        let many = |all: &Vec<Vec<f64>>| all.iter().map(|c| evened(of(c))).collect::<Vec<_>>();
        found.push(Piece {
            row: piece[0],
            start: times[0],
            q: q.into_iter().map(evened).collect(),
            qd: columns.qd.as_ref().map(many),
            qdd: columns.qdd.as_ref().map(many),
            tau: many(&columns.tau),
        });
    }
    remarks.extend((uneven >= UNEVEN).then_some(Remark::Uneven(uneven)));
    remarks.extend(turned.iter().enumerate().filter(|t| *t.1).map(|(j, _)| Remark::Turns(j)));
    Ok((found, step))
}

/// Undoes jumps by whole turns; whether there were any.
fn unwrapped(x: &mut [f64]) -> bool {
    let (mut turns, mut is_any, mut before) = (0.0, false, x.first().copied().unwrap_or(0.0));
    for v in x {
        let d = *v - before;
        before = *v;
        if (d.abs() - TAU).abs() < 0.06 * TAU {
            turns -= d.signum();
            is_any = true;
        }
        *v += TAU * turns;
    }
    is_any
}

/// Values at even times, by the cubic through the four nearest.
fn resampled(t: &[f64], x: &[f64], step: f64) -> Vec<f64> {
    let n = t.len();
    if n < 4 {
        return x.to_vec();
    }
    let count = ((t[n - 1] - t[0]) / step) as usize + 1;
    let mut k = 0;
    (0..count)
        .map(|i| {
            let at = t[0] + i as f64 * step;
            while k + 1 < n && t[k + 1] <= at {
                k += 1;
            }
            let first = k.saturating_sub(1).min(n - 4);
            let weight = |a: usize| {
                let others = (first..first + 4).filter(|&b| b != a);
                others.map(|b| (at - t[b]) / (t[a] - t[b])).product::<f64>()
            };
            (first..first + 4).map(|a| weight(a) * x[a]).sum()
        })
        .collect()
}

/// Rates that differ by less from those of the positions are these, where a joint moves by a stroke, radians or metres; of one that
/// hardly moves, and of accelerations, which are noise more than motion, by less than this.
const SAME: f64 = 0.03;
const STROKE: f64 = 0.1;
const LIKE: f64 = 0.4;

/// Whether recorded rates are those of the positions, and accelerations those of the rates.
fn consistent(
    q: &[Vec<f64>],
    qd: &[Vec<f64>],
    qdd: &[Vec<f64>],
    step: f64,
    edge: usize,
) -> Result<(), NoMotion> {
    let ratio = |of: &[f64], recorded: &[f64]| -> Option<[f64; 2]> {
        let own = derivative(of, step);
        let rows = edge..own.len().saturating_sub(edge);
        let sum = |a: &[f64], b: &[f64]| rows.clone().map(|r| a[r] * b[r]).sum::<f64>();
        let (dd, dr, rr) = (sum(&own, &own), sum(&own, recorded), sum(recorded, recorded));
        // What they have in common says how large one is by the other, where it is most of both: between these two, whichever of
        // them has the noise.
        (dr * dr > 0.5 * dd * rr && dd > 0.0).then(|| [dr / dd, rr / dr])
    };
    let off = |[one, other]: [f64; 2], same: f64| {
        let (low, high) = (one.min(other), one.max(other));
        (low > 1.0 + same || high < 1.0 - same).then(|| if low > 0.0 { (low * high).sqrt() } else { one })
    };
    for j in 0..q.len() {
        let edges = q[j].iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
        let moves = edges[1] - edges[0] > STROKE;
        if let Some(k) = ratio(&q[j], &qd[j]).and_then(|k| off(k, if moves { SAME } else { LIKE })) {
            return Err(NoMotion::Rates(j, k));
        }
        if let Some(k) = ratio(&qd[j], &qdd[j]).and_then(|k| off(k, LIKE)) {
            return Err(NoMotion::Accelerations(j, k));
        }
    }
    Ok(())
}
