//! Motions that show the parameters: Fourier series (Swevers et al. 1997) within limits, from rest to rest, whose coefficients are searched
//! for the largest determinant of WᵀW or the least condition number of W.
//!
//! qⱼ(t) = cⱼ + sⱼ Σₗ (aₗ sin(ωlt) − bₗ cos(ωlt)) / (ωl) with Σ a = 0 and Σ l·b = 0: no rate and no acceleration at the ends. A series of
//! degree h that is at most m on M even points is nowhere larger than m / cos(πh/M): limits hold at all times.

use crate::estimate::condition;
use crate::linear::Square;
use crate::model::{Model, What};
use denavit::dynamics::{Dynamics, drive_torques};
use denavit::random::Random;
use std::f64::consts::{PI, TAU};

/// What the joints may do.
#[derive(Clone, Debug)]
pub struct Limits {
    /// The lowest and the highest value of each joint.
    pub position: Vec<[f64; 2]>,
    /// The greatest rate.
    pub velocity: Vec<f64>,
    /// The greatest acceleration.
    pub acceleration: Vec<f64>,
    /// The greatest torques, of an arm with masses.
    pub torque: Option<(Dynamics<f64>, Vec<f64>)>,
}

/// What is to be best.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Criterion {
    /// The determinant of WᵀW: the volume of what is not known.
    #[default]
    Determinant,
    /// The condition number of W, its columns of one size.
    Condition,
}

/// How a motion is searched.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Search {
    /// Seconds of a period.
    pub duration: f64,
    /// Harmonics; at least 3, as two conditions are met.
    pub harmonics: usize,
    /// Where the random numbers begin.
    pub seed: u64,
    /// How many motions are tried.
    pub trials: usize,
    /// What is to be best.
    pub criterion: Criterion,
}

/// A motion.
#[derive(Clone, PartialEq, Debug)]
pub struct Excitation {
    /// Seconds.
    pub duration: f64,
    /// Where each joint's series is about.
    pub centres: Vec<f64>,
    /// aₗ and bₗ of each joint, multiplied with sⱼ.
    pub series: Vec<[Vec<f64>; 2]>,
    /// The condition number of W, its columns of one size.
    pub condition: f64,
    /// ln det WᵀW, its columns of one size.
    pub log_det: f64,
    /// The greatest part of the torque limits at the times that were looked at.
    pub torque: Option<f64>,
    /// How many motions were tried.
    pub trials: usize,
}

/// Why there is no motion.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NoExcitation {
    /// Fewer than three harmonics.
    Harmonics,
    /// A joint has no room, or no rate, or no acceleration: its number, from 0.
    NoRoom(usize),
    /// No motion that was tried keeps the torques within their limits.
    Torques,
}

/// Motions at random before one is improved, as a part of all.
const FIRST: usize = 5;
/// Times at which W is looked at, by harmonics.
const TIMES: usize = 16;
/// Points on which a series is bounded, by harmonics.
const POINTS: usize = 40;
/// Steps of the search: the first, and the least.
const STEP: f64 = 0.5;
const LEAST_STEP: f64 = 1e-3;

impl Excitation {
    /// q, q̇, q̈ at a time.
    pub fn at(&self, t: f64) -> [Vec<f64>; 3] {
        let omega = TAU / self.duration;
        let mut all = [self.centres.clone(), vec![0.0; self.centres.len()], vec![0.0; self.centres.len()]];
        for (j, [a, b]) in self.series.iter().enumerate() {
            for (l, (a, b)) in a.iter().zip(b).enumerate() {
                let w = omega * (l + 1) as f64;
                let (s, c) = (w * t).sin_cos();
                all[0][j] += (a * s - b * c) / w;
                all[1][j] += a * c + b * s;
                all[2][j] += w * (b * c - a * s);
            }
        }
        all
    }
}

/// What is searched: the shape of each joint's series, and where in its room it stands, from 0 to 1.
#[derive(Clone)]
struct Candidate {
    shapes: Vec<[Vec<f64>; 2]>,
    places: Vec<f64>,
}

/// Searches a motion; `told` hears of each that is better, with how many were tried, and says whether to go on.
///
/// # Errors
/// If the limits leave no room.
pub fn excite(
    model: &Model,
    limits: &Limits,
    search: &Search,
    mut told: impl FnMut(&Excitation, usize) -> bool,
) -> Result<Excitation, NoExcitation> {
    let n = model.joints();
    if search.harmonics < 3 {
        return Err(NoExcitation::Harmonics);
    }
    let is_positive = |x: f64| x.is_finite() && x > 0.0;
    let has_room = |j: &usize| {
        let [low, high] = limits.position[*j];
        is_positive(high - low) && is_positive(limits.velocity[*j]) && is_positive(limits.acceleration[*j])
    };
    if let Some(j) = (0..n).find(|j| !has_room(j)) {
        return Err(NoExcitation::NoRoom(j));
    }
    let mut random = Random(search.seed ^ 0x5EED);
    let mut normal = move || {
        // Box and Muller's, one of two.
        let (u, v) = (random.unit().max(1e-300), random.unit());
        ((-2.0 * u.ln()).sqrt() * (TAU * v).cos(), random.unit())
    };
    let h = search.harmonics;
    let mut best: Option<(Candidate, Excitation, f64)> = None;
    let (mut step, mut tried) = (STEP, 0);
    for trial in 1..=search.trials.max(1) {
        tried = trial;
        let first = best.as_ref().filter(|_| trial * FIRST > search.trials);
        let next = match first {
            None => {
                let mut series = || (0..h).map(|_| normal().0).collect::<Vec<f64>>();
                let shapes = (0..n).map(|_| [series(), series()]).collect();
                Candidate { shapes, places: (0..n).map(|_| normal().1).collect() }
            }
            Some((from, ..)) => {
                let mut next = from.clone();
                // One joint, or all of them.
                let one = (normal().1 * 2.0 * n as f64) as usize;
                for j in (0..n).filter(|&j| one >= n || j == one) {
                    for x in next.shapes[j].iter_mut().flatten() {
                        *x += step * normal().0;
                    }
                    next.places[j] = (next.places[j] + 0.5 * step * normal().0).clamp(0.0, 1.0);
                }
                next
            }
        };
        let (next, motion) = within(next, limits, search);
        let (motion, worth) = judged(model, limits, search, motion);
        let is_better = best.as_ref().is_none_or(|b| worth > b.2);
        if first.is_some() {
            // One in five is to be better.
            step = if is_better { step * 1.5 } else { step * 0.9 }.clamp(LEAST_STEP, STEP);
        }
        if is_better {
            let goes_on = told(&motion, trial);
            best = Some((next, motion, worth));
            if !goes_on {
                break;
            }
        } else if let Some((_, motion, _)) = best.as_ref().filter(|_| trial % 16 == 0)
            && !told(motion, trial)
        {
            break;
        }
    }
    let (_, motion, _) = best.ok_or(NoExcitation::Harmonics)?;
    match motion.torque {
        Some(part) if part > 1.0 => Err(NoExcitation::Torques),
        _ => Ok(Excitation { trials: tried, ..motion }),
    }
}

/// The shape as large as the limits allow, with coefficients that begin and end at rest.
fn within(mut of: Candidate, limits: &Limits, search: &Search) -> (Candidate, Excitation) {
    let (h, omega) = (search.harmonics, TAU / search.duration);
    let points = (POINTS * h).max(240);
    let over = 1.0 / (PI * h as f64 / points as f64).cos();
    let (mut centres, mut series) = (vec![], vec![]);
    for (j, [a, b]) in of.shapes.iter_mut().enumerate() {
        let mean = a.iter().sum::<f64>() / h as f64;
        a.iter_mut().for_each(|x| *x -= mean);
        let number = |l: usize| (l + 1) as f64;
        let squares: f64 = (0..h).map(|l| number(l).powi(2)).sum();
        let along = b.iter().enumerate().map(|(l, x)| number(l) * x).sum::<f64>() / squares;
        b.iter_mut().enumerate().for_each(|(l, x)| *x -= number(l) * along);
        let size = a.iter().chain(b.iter()).fold(0.0_f64, |m, x| m.max(x.abs())).max(1e-300);
        a.iter_mut().chain(b.iter_mut()).for_each(|x| *x /= size);
        let one = Excitation {
            duration: search.duration,
            centres: vec![0.0],
            series: vec![[a.clone(), b.clone()]],
            condition: 0.0,
            log_det: 0.0,
            torque: None,
            trials: 0,
        };
        let (mut low, mut high, mut fast, mut pulled) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64, 0.0_f64);
        for k in 0..points {
            let [q, qd, qdd] = one.at(search.duration * k as f64 / points as f64);
            (low, high) = (low.min(q[0]), high.max(q[0]));
            (fast, pulled) = (fast.max(qd[0].abs()), pulled.max(qdd[0].abs()));
        }
        // The series about the middle of its range is bounded as the others are.
        let (middle, reach) = ((low + high) / 2.0, (high - low) / 2.0);
        let reach = reach + (over - 1.0) * (reach + middle.abs());
        let [bottom, top] = limits.position[j];
        let scale = (limits.velocity[j] / (over * fast))
            .min(limits.acceleration[j] / (over * pulled))
            .min((top - bottom) / (2.0 * reach));
        let slack = (top - bottom - 2.0 * scale * reach).max(0.0);
        centres.push(bottom + scale * reach - scale * middle + of.places[j] * slack);
        let scaled = |x: &[f64]| x.iter().map(|x| scale * x).collect::<Vec<f64>>();
        series.push([scaled(a), scaled(b)]);
        debug_assert!(omega > 0.0, "a period has a length");
    }
    let motion = Excitation {
        duration: search.duration,
        centres,
        series,
        condition: 0.0,
        log_det: 0.0,
        torque: None,
        trials: 0,
    };
    (of, motion)
}

/// What a motion is worth.
fn judged(model: &Model, limits: &Limits, search: &Search, mut motion: Excitation) -> (Excitation, f64) {
    let width = model.parameters.len();
    let times = (TIMES * search.harmonics).max(2 * width.div_ceil(model.joints()));
    let size = model.size();
    let sizes: Vec<f64> = model
        .parameters
        .iter()
        .map(|p| match (p.what, p.unit) {
            (What::Base(_) | What::Rotor(_), "kg m²") => size * size,
            (What::Base(_) | What::Rotor(_), "kg m") => size,
            _ => 1.0,
        })
        .collect();
    let mut square = Square::zero(width);
    let (mut rows, mut part) = (vec![], 0.0_f64);
    for k in 0..times {
        let [q, qd, qdd] = motion.at(search.duration * (k as f64 + 0.5) / times as f64);
        rows.clear();
        model.observe(&q, &qd, &qdd, &mut rows);
        for row in &mut rows {
            row.iter_mut().zip(&sizes).for_each(|(x, s)| *x *= s);
            square.add_square_of(row, 1.0 / times as f64);
        }
        if let Some((arm, most)) = &limits.torque {
            let needed = drive_torques(arm, &q, &qd, &qdd, None);
            part = needed.iter().zip(most).fold(part, |p, (t, m)| p.max(t.abs() / m));
        }
    }
    motion.condition = condition(&square);
    motion.log_det = square.cholesky().map_or(f64::NEG_INFINITY, |l| l.log_det());
    motion.torque = limits.torque.as_ref().map(|_| part);
    let worth = match search.criterion {
        Criterion::Determinant => motion.log_det,
        Criterion::Condition => -motion.condition,
    };
    // What asks too much is worse than all that do not, and the worse the more.
    let worth = if part > 1.0 { -1e12 * part } else { worth };
    (motion, if worth.is_nan() { f64::NEG_INFINITY } else { worth })
}
