//! The rows of τ = Wβ of a motion, both sides under the same filter (Gautier 1997), thinned out to what it lets through.

use crate::linear::{Square, dot, rms};
use crate::model::{Model, What};
use crate::motion::Motion;
use crate::signal::{LowPass, density};

/// Stretches that are held out in turn.
pub const FOLDS: usize = 5;
/// A joint stands still below this part of its greatest rate, and below so many deviations of its noise.
const STANDS: f64 = 1e-3;
const NOISE: f64 = 4.0;
/// More of this part of a row at rest is at rest.
const AT_REST: f64 = 0.3;

/// Rows, one a joint and time.
#[derive(Clone, Debug)]
pub struct Observations {
    /// How many joints there are.
    pub joints: usize,
    /// How many parameters.
    pub width: usize,
    /// The rows.
    pub rows: Vec<Row>,
    /// Rows of each joint that are left out, as it stands still and Coulomb's friction is not known there.
    pub at_rest: Vec<usize>,
    /// Root mean squares of the rates of the joints.
    pub rates: Vec<f64>,
    /// By how much noise in the rows is denser within the filter's band than its variance says.
    pub density: f64,
    /// Configurations of the motion, some of them.
    pub configurations: Vec<Vec<f64>>,
    /// How many times there are.
    pub times: usize,
}

/// A row.
#[derive(Clone, Debug)]
pub struct Row {
    /// The joint.
    pub joint: usize,
    /// The number of its time.
    pub time: usize,
    /// Whether the row of the joint before it in the list is that of the time before.
    pub follows: bool,
    /// What multiplies the parameters.
    pub entries: Vec<f64>,
    /// The torque.
    pub torque: f64,
}

impl Row {
    /// The torque less what parameters give.
    pub fn left(&self, parameters: &[f64]) -> f64 {
        self.torque - dot(&self.entries, parameters)
    }
}

impl Observations {
    /// Of a motion.
    pub fn of(model: &Model, motion: &Motion) -> Self {
        let (n, width) = (model.joints(), model.parameters.len());
        let greatest =
            |j: usize| motion.stretches.iter().flat_map(|s| &s.qd[j]).fold(0.0_f64, |m, v| m.max(v.abs()));
        let slow: Vec<f64> =
            (0..n).map(|j| (STANDS * greatest(j)).max(NOISE * motion.rate_noise[j]).max(1e-9)).collect();
        let has_coulomb = model.parameters.iter().any(|p| matches!(p.what, What::Coulomb(_)));
        let rates: Vec<f64> = (0..n).map(|j| rms(motion.stretches.iter().flat_map(|s| &s.qd[j]))).collect();
        let rate = 1.0 / motion.step;
        let mut all = Observations {
            joints: n,
            width,
            rows: vec![],
            at_rest: vec![0; n],
            rates,
            density: motion.parallel.map_or(1.0, |(f, every)| density(f, rate / every as f64)),
            configurations: vec![],
            times: 0,
        };
        for stretch in &motion.stretches {
            let rows = stretch.q[0].len();
            let at = |columns: &[Vec<f64>], r: usize| -> Vec<f64> { columns.iter().map(|c| c[r]).collect() };
            let mut seen: Vec<Vec<f64>> = Vec::with_capacity(rows * n);
            for r in 0..rows {
                let [q, qd, qdd] = [&stretch.q, &stretch.qd, &stretch.qdd].map(|c| at(c, r));
                model.observe(&q, &qd, &qdd, &mut seen);
                if r % (rows / 24).max(1) == 0 {
                    all.configurations.push(q);
                }
            }
            let pass = motion.parallel.map(|(f, _)| LowPass::new(f / rate));
            let every = motion.parallel.map_or(1, |p| p.1);
            let edge = pass.as_ref().map_or(0, |p| p.settles);
            let kept: Vec<usize> = (edge..rows.saturating_sub(edge)).step_by(every).collect();
            let filtered = |x: Vec<f64>| -> Vec<f64> {
                let is_nothing = x.iter().all(|&v| v == 0.0);
                let x = pass.as_ref().filter(|_| !is_nothing).map_or_else(|| x.clone(), |p| p.applied(&x));
                kept.iter().map(|&r| x[r]).collect()
            };
            for j in 0..n {
                let column = |k: usize| match model.parameters[k].what {
                    What::Coulomb(of) if of == j => stretch.signs[j].clone(),
                    _ => (0..rows).map(|r| seen[r * n + j][k]).collect(),
                };
                let columns: Vec<Vec<f64>> = (0..width).map(|k| filtered(column(k))).collect();
                let torques = filtered(stretch.tau[j].clone());
                let rests =
                    filtered(stretch.qd[j].iter().map(|v| f64::from(u8::from(v.abs() < slow[j]))).collect());
                let mut before = None;
                for (i, torque) in torques.into_iter().enumerate() {
                    if has_coulomb && rests[i] > AT_REST {
                        all.at_rest[j] += 1;
                        continue;
                    }
                    all.rows.push(Row {
                        joint: j,
                        time: all.times + i,
                        follows: before.is_some_and(|b: usize| b + 1 == i),
                        entries: columns.iter().map(|c| c[i]).collect(),
                        torque,
                    });
                    before = Some(i);
                }
            }
            all.times += kept.len();
        }
        all
    }

    /// The held-out stretch in which a row is.
    pub fn fold(&self, row: &Row) -> usize {
        row.time * FOLDS / self.times.max(1)
    }

    /// The rows of a joint.
    pub fn of_joint(&self, joint: usize) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |r| r.joint == joint)
    }
}

/// WᵀW, Wᵀτ and τᵀτ of some rows.
#[derive(Clone, Debug)]
pub struct Normal {
    /// WᵀW
    pub square: Square,
    /// Wᵀτ
    pub right: Vec<f64>,
    /// τᵀτ
    pub torques: f64,
    /// How many rows there are.
    pub rows: usize,
}

impl Normal {
    /// Of no rows.
    pub fn none(width: usize) -> Self {
        Normal { square: Square::zero(width), right: vec![0.0; width], torques: 0.0, rows: 0 }
    }

    /// Adds a row with a weight.
    pub fn take(&mut self, row: &Row, weight: f64) {
        self.square.add_square_of(&row.entries, weight);
        self.right.iter_mut().zip(&row.entries).for_each(|(r, x)| *r += weight * x * row.torque);
        self.torques += weight * row.torque * row.torque;
        self.rows += 1;
    }

    /// Adds a multiple of another.
    pub fn add(&mut self, other: &Normal, weight: f64) {
        self.square.add(&other.square, weight);
        self.right.iter_mut().zip(&other.right).for_each(|(r, x)| *r += weight * x);
        self.torques += weight * other.torques;
        self.rows += other.rows;
    }

    /// The sum of the squares that these parameters leave.
    pub fn left(&self, parameters: &[f64]) -> f64 {
        let explained = 2.0 * dot(&self.right, parameters) - self.square.between(parameters);
        (self.torques - explained).max(0.0)
    }
}
