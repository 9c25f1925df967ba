//! Weighted least squares over base parameters: the noise of each joint is estimated and weighs its rows (Gautier 1997; Janot,
//! Vandanjon and Gautier 2014), again until both agree.
//!
//! Directions of the parameters in which the motion tells less than what an arm of this size could be are left at 0, and what has a part in
//! them is not given as a number.

use crate::linear::{Square, dot, rms};
use crate::model::{Model, What};
use crate::observations::{FOLDS, Normal, Observations, Row};
use crate::signal::median;

/// How to estimate.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Options {
    /// Rows far off count less (Huber).
    pub robust: bool,
    /// Parameters that are not told from 0 are left out, as far as an F-test allows it at 5 %.
    pub reduce: bool,
}

/// What is known of a parameter.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Known {
    /// A value and its standard deviation.
    Value(f64, f64),
    /// The motion does not tell: the deviation would be this.
    Unseen(f64),
    /// It was left out, as it is not told from 0: what it was, with its deviation.
    LeftOut(f64, f64),
}

/// A joint's torques and what is left of them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OfJoint {
    /// Rows.
    pub rows: usize,
    /// Rows at rest, left out.
    pub at_rest: usize,
    /// The root mean square of the torques.
    pub torque: f64,
    /// That of what is left.
    pub left: f64,
    /// That of what is left on stretches that were held out; none if they could not be.
    pub held_out: Option<f64>,
    /// The noise of a row.
    pub noise: f64,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// What is known of each parameter.
    pub known: Vec<Known>,
    /// The values with which torques are predicted: of what the motion does not tell those of least size.
    pub values: Vec<f64>,
    /// The covariance of what is seen; large where it is not.
    pub covariance: Square,
    /// The weighted WᵀW over what is seen: what the values are worth. Noise counts as no less than 1e-4 of the torques in it.
    pub information: Square,
    /// The covariance that belongs to it.
    pub worth: Square,
    /// The condition number of the weighted regressor, its columns of one size; what is left out aside.
    pub condition: f64,
    /// Joint by joint.
    pub joints: Vec<OfJoint>,
    /// Directions that the motion does not tell: parameters with a part in each.
    pub unseen: Vec<Vec<usize>>,
    /// Rows that count less than half in the robust fit.
    pub outliers: usize,
}

/// Rounds at most of what weighs and what is found.
const ROUNDS: usize = 30;
/// Huber's bound, in deviations.
const HUBER: f64 = 1.345;
/// Noise is no less than this part of the torques: rounding.
const ROUNDING: f64 = 1e-9;
/// Noise counts as no less where masses are sought: what is exact would drown what is chosen.
const FLOOR: f64 = 1e-4;
/// The least eigenvalue by the largest.
const RANK: f64 = 1e-14;
/// A deviation above this part of what an arm could have tells nothing.
const TOLD: f64 = 0.5;
/// Parts of a direction above this are said.
const PART: f64 = 0.15;
/// Steps up to which what is left may be correlated.
const LAGS: usize = 8;

/// Sizes that the parameters of an arm with these torques may have.
pub fn sizes(model: &Model, all: &Observations) -> Vec<f64> {
    let torque: Vec<f64> = (0..all.joints).map(|j| rms(all.of_joint(j).map(|r| &r.torque))).collect();
    let largest = torque.iter().fold(0.0_f64, |m, x| m.max(*x)).max(1e-12);
    let length = model.size();
    // The mass that gives such a torque by its weight, or by its acceleration.
    let gravity = model.arm.gravity.norm();
    let mass = largest / (length * if gravity > 0.1 { gravity } else { length });
    let mass = if mass.is_finite() && mass > 0.0 { mass } else { 1.0 };
    let of = |p: &crate::model::Parameter| match (p.what, p.unit) {
        (What::Viscous(j), _) => torque[j].max(1e-3 * largest) / all.rates[j].max(1e-3),
        (What::Coulomb(j) | What::Offset(j), _) => torque[j].max(1e-3 * largest),
        (_, "kg m²") => mass * length * length,
        (_, "kg m") => mass * length,
        _ => mass,
    };
    model.parameters.iter().map(of).collect()
}

/// A solution of weighted equations.
struct Solved {
    values: Vec<f64>,
    covariance: Square,
    /// WᵀW over the directions that are seen.
    information: Square,
    condition: f64,
    unseen: Vec<Vec<usize>>,
}

/// Solves for parameters of these sizes, the others at 0.
fn solved(normal: &Normal, sizes: &[f64], active: &[usize]) -> Solved {
    let mut scaled = normal.square.of(active);
    let size = |k: usize| sizes[active[k]];
    let n = active.len();
    for i in 0..n {
        for j in 0..n {
            *scaled.at_mut(i, j) *= size(i) * size(j);
        }
    }
    let eigen = scaled.eigen();
    let largest = eigen.first().map_or(0.0, |e| e.0);
    let right: Vec<f64> = active.iter().map(|&k| normal.right[k] * sizes[k]).collect();
    let (mut own, mut unseen) = (vec![0.0; n], vec![]);
    let (mut covariance, mut information) = (Square::zero(sizes.len()), Square::zero(sizes.len()));
    for (value, vector) in &eigen {
        let is_seen = *value >= 1.0 && *value > RANK * largest;
        if is_seen {
            let along = dot(vector, &right) / value;
            own.iter_mut().zip(vector).for_each(|(x, v)| *x += along * v);
            for i in 0..n {
                let x = value * vector[i] / size(i);
                for j in 0..n {
                    *information.at_mut(active[i], active[j]) += x * vector[j] / size(j);
                }
            }
        } else {
            let parts = (0..n).filter(|&k| vector[k].abs() > PART).map(|k| active[k]).collect();
            unseen.push(parts);
        }
        let value = value.max(RANK * largest).max(1e-300);
        for i in 0..n {
            let x = vector[i] / value * size(i);
            for j in 0..n {
                *covariance.at_mut(active[i], active[j]) += x * vector[j] * size(j);
            }
        }
    }
    let mut values = vec![0.0; sizes.len()];
    active.iter().enumerate().for_each(|(k, &a)| values[a] = own[k] * sizes[a]);
    Solved { values, covariance, information, condition: condition(&normal.square.of(active)), unseen }
}

/// The condition number of the regressor with columns of one size; columns of zeros make it infinite.
pub fn condition(square: &Square) -> f64 {
    let n = square.n;
    let mut one = square.clone();
    for i in 0..n {
        for j in 0..n {
            let size = (square.at(i, i) * square.at(j, j)).sqrt();
            *one.at_mut(i, j) = if size > 0.0 { square.at(i, j) / size } else { 0.0 };
        }
    }
    let eigen = one.eigen();
    match (eigen.first(), eigen.last()) {
        (Some(a), Some(b)) if b.0 > RANK * a.0 => (a.0 / b.0).sqrt(),
        (None, _) => 1.0,
        _ => f64::INFINITY,
    }
}

/// Estimates the parameters from the rows of a motion.
pub fn estimate(model: &Model, all: &Observations, options: &Options) -> Estimate {
    let sizes = sizes(model, all);
    let mut active: Vec<usize> = (0..all.width).collect();
    let mut found = weighted(all, &sizes, &active, options.robust);
    let mut left_out: Vec<(usize, f64, f64)> = vec![];
    if options.reduce {
        let (gone, first) = (reduced(&found, &sizes), &found);
        left_out = gone.iter().map(|&k| (k, first.values[k], first.covariance.at(k, k).sqrt())).collect();
        active.retain(|k| !gone.contains(k));
        found = weighted(all, &sizes, &active, options.robust);
    }
    let known = (0..all.width).map(|k| {
        let deviation = found.covariance.at(k, k).max(0.0).sqrt();
        match left_out.iter().find(|l| l.0 == k) {
            Some(&(_, value, deviation)) => Known::LeftOut(value, deviation),
            None if deviation > TOLD * sizes[k] || deviation == 0.0 => Known::Unseen(deviation),
            None => Known::Value(found.values[k], deviation),
        }
    });
    let known = known.collect();
    Estimate { known, ..found }
}

/// The fit with the noise of each joint.
fn weighted(all: &Observations, sizes: &[f64], active: &[usize], robust: bool) -> Estimate {
    let n = all.joints;
    let by_joint: Vec<Vec<&Row>> = (0..n).map(|j| all.of_joint(j).collect()).collect();
    let torque: Vec<f64> = by_joint.iter().map(|rows| rms(rows.iter().map(|r| &r.torque))).collect();
    let least = |j: usize| ROUNDING * torque[j].max(1e-6);
    let mut noise: Vec<f64> = (0..n).map(|j| torque[j].max(least(j))).collect();
    let mut plain: Vec<Vec<Normal>> = vec![];
    for rows in &by_joint {
        let mut folds = vec![Normal::none(all.width); FOLDS];
        rows.iter().for_each(|r| folds[all.fold(r)].take(r, 1.0));
        plain.push(folds);
    }
    let mut normals = plain.clone();
    let sum = |normals: &[Vec<Normal>], noise: &[f64], without: Option<usize>| {
        let mut whole = Normal::none(all.width);
        for (folds, s) in normals.iter().zip(noise) {
            let kept = folds.iter().enumerate().filter(|(f, _)| Some(*f) != without);
            kept.for_each(|(_, part)| whole.add(part, 1.0 / (s * s)));
        }
        whole
    };
    let mut found = solved(&sum(&normals, &noise, None), sizes, active);
    for _ in 0..ROUNDS {
        let before = noise.clone();
        for j in 0..n {
            let rows = &by_joint[j];
            if rows.is_empty() {
                continue;
            }
            let left: Vec<f64> = rows.iter().map(|r| r.left(&found.values)).collect();
            if robust {
                let middle = 1.4826 * median(left.iter().map(|x| x.abs()).collect());
                noise[j] = middle.max(least(j));
                let mut folds = vec![Normal::none(all.width); FOLDS];
                for (r, x) in rows.iter().zip(&left) {
                    folds[all.fold(r)].take(r, (HUBER * noise[j] / x.abs()).min(1.0));
                }
                normals[j] = folds;
            } else {
                // What the parameters take of the rows is not noise any more.
                let own: f64 = plain[j].iter().map(|f| trace(&f.square, &found, active)).sum::<f64>()
                    / (before[j] * before[j]);
                let free = (rows.len() as f64 - own).max(1.0);
                noise[j] = (dot(&left, &left) / free).sqrt().max(least(j));
            }
        }
        found = solved(&sum(&normals, &noise, None), sizes, active);
        if noise.iter().zip(&before).all(|(a, b)| (a - b).abs() <= 1e-6 * b) {
            break;
        }
    }
    let mut joints = vec![];
    let (mut outliers, mut spread) = (0, noise.clone());
    for (j, rows) in by_joint.iter().enumerate() {
        let left: Vec<f64> = rows.iter().map(|r| r.left(&found.values)).collect();
        let bound = HUBER * noise[j];
        if robust && !rows.is_empty() {
            // The variance of Huber's estimate: that of what counts, by how much of it is linear.
            outliers += left.iter().filter(|x| x.abs() > 2.0 * bound).count();
            let counted: f64 =
                left.iter().map(|x| x.abs().min(bound).powi(2)).sum::<f64>() / left.len() as f64;
            let linear = left.iter().filter(|x| x.abs() <= bound).count().max(1) as f64 / left.len() as f64;
            spread[j] = (counted.sqrt() / linear).max(least(j));
        }
        spread[j] *= correlated(rows, &left, all.density).sqrt();
        joints.push(OfJoint {
            rows: rows.len(),
            at_rest: all.at_rest[j],
            torque: torque[j],
            left: rms(&left),
            held_out: None,
            noise: noise[j],
        });
    }
    held_out(&mut joints, all, &by_joint, |f| solved(&sum(&normals, &noise, Some(f)), sizes, active).values);
    // What the values are worth, with what is left correlated as it is.
    let last = solved(&sum(&plain, &spread, None), sizes, active);
    let floored: Vec<f64> = spread.iter().zip(&torque).map(|(s, t)| s.max(FLOOR * t)).collect();
    let worth = solved(&sum(&plain, &floored, None), sizes, active);
    Estimate {
        known: vec![],
        values: found.values,
        covariance: last.covariance,
        information: worth.information,
        worth: worth.covariance,
        condition: last.condition,
        joints,
        unseen: last.unseen,
        outliers,
    }
}

/// tr(N C) over what is sought.
fn trace(square: &Square, found: &Solved, active: &[usize]) -> f64 {
    let of = |&i: &usize| active.iter().map(|&j| square.at(i, j) * found.covariance.at(j, i)).sum::<f64>();
    active.iter().map(of).sum()
}

/// What is left on each stretch of a fit on the others.
fn held_out(
    joints: &mut [OfJoint],
    all: &Observations,
    by_joint: &[Vec<&Row>],
    without: impl Fn(usize) -> Vec<f64>,
) {
    // A stretch held out leaves too little of a short recording.
    if all.times < 4 * FOLDS {
        return;
    }
    let values: Vec<Vec<f64>> = (0..FOLDS).map(without).collect();
    for (own, rows) in joints.iter_mut().zip(by_joint).filter(|(_, rows)| !rows.is_empty()) {
        let left: Vec<f64> = rows.iter().map(|r| r.left(&values[all.fold(r)])).collect();
        own.held_out = Some(rms(&left));
    }
}

/// By how much what is left is worth less than as many independent rows: what the filter says, or what is seen in it.
fn correlated(rows: &[&Row], left: &[f64], known: f64) -> f64 {
    let n = left.len();
    let variance = dot(left, left);
    if n < 4 * LAGS || variance <= 0.0 {
        return known;
    }
    let mut factor = 1.0;
    for lag in 1..=LAGS {
        let together = |k: &usize| (k + 1..=k + lag).all(|i| rows[i].follows);
        let sum: f64 = (0..n - lag).filter(together).map(|k| left[k] * left[k + lag]).sum();
        factor += 2.0 * (1.0 - lag as f64 / (LAGS + 1) as f64) * sum / variance;
    }
    let chance = 2.0 * 2.0 * (2.5 / n as f64).sqrt();
    if factor > known + chance { factor } else { known }
}

/// Parameters that are left out together: the least certain one after the other, while all of them at 0 are as likely as noise at 5 %.
fn reduced(found: &Estimate, sizes: &[f64]) -> Vec<usize> {
    let mut gone: Vec<usize> = vec![];
    let mut left: Vec<usize> =
        (0..sizes.len()).filter(|&k| found.covariance.at(k, k).sqrt() <= sizes[k]).collect();
    let (mut values, mut covariance) = (found.values.clone(), found.covariance.clone());
    let mut worse = 0.0;
    while left.len() > 1 {
        let ratio = |k: usize| values[k] * values[k] / covariance.at(k, k).max(1e-300);
        let Some(&next) = left.iter().min_by(|&&a, &&b| ratio(a).total_cmp(&ratio(b))) else { break };
        worse += ratio(next);
        if worse > chance(gone.len() + 1) {
            break;
        }
        // The others, given that it is 0.
        let own: Vec<f64> = (0..sizes.len()).map(|i| covariance.at(i, next)).collect();
        let (value, variance) = (values[next], covariance.at(next, next));
        for i in 0..sizes.len() {
            values[i] -= own[i] * value / variance;
            for j in 0..sizes.len() {
                *covariance.at_mut(i, j) -= own[i] * own[j] / variance;
            }
        }
        left.retain(|&k| k != next);
        gone.push(next);
    }
    gone
}

/// What so many squares of normal deviations exceed once in twenty times (Wilson and Hilferty): F with many rows.
fn chance(count: usize) -> f64 {
    let k = count as f64;
    let a = 2.0 / (9.0 * k);
    k * (1.0 - a + 1.6449 * a.sqrt()).powi(3)
}
