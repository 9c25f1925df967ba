//! Steps of Gauss–Newton, the noise that the residuals have, and the deviations that follow.

use crate::estimate::{CalibrateError, Estimate, Measured, Off, prior};
use crate::linear::{dot, null_vectors, symmetric};
use crate::model::{Parameter, Problem, State};
use crate::visible::Visible;

/// Where a row has no weight any more, in units of the scale, and before the first step.
const BIWEIGHT: f64 = 4.7;
const FIRST: f64 = 3.0;
/// Steps of Gauss–Newton, and rounds in which noise is estimated.
const STEPS: usize = 15;
const ROUNDS: usize = 12;
/// Below this noise is rounding: radians, metres.
const LEAST: f64 = 1e-12;
/// Rows with less weight are left aside.
pub const ASIDE: f64 = 0.05;

/// What steps need.
pub struct Work<'a> {
    problem: &'a Problem,
    visible: &'a Visible,
    measured: &'a Measured,
    is_robust: bool,
    /// What is usual for each kept parameter.
    prior: Vec<f64>,
}

/// A fit.
pub struct Fit {
    pub state: State,
    /// Of the rows, in their order among those that were fitted.
    pub weights: Vec<f64>,
    pub noise: [f64; 2],
    pub ratio: f64,
    /// By what the inverse of the information is to be multiplied.
    factor: f64,
}

/// Combinations, in units of what is usual: those that are seen with their information, and the others.
pub struct Split {
    seen: Vec<(f64, Vec<f64>)>,
    unseen: Vec<Vec<f64>>,
}

impl Split {
    pub fn new(information: &[Vec<f64>]) -> Self {
        let (values, vectors) = symmetric(information.to_vec());
        let largest = values.iter().copied().fold(0.0, f64::max);
        let mut split = Split { seen: vec![], unseen: vec![] };
        for (value, vector) in values.into_iter().zip(vectors) {
            // Its deviation is what is usual where the information is 1; rounding leaves 1e-16 of the largest.
            if value >= 1.0 && value > 1e-13 * largest {
                split.seen.push((value, vector));
            } else {
                split.unseen.push(vector);
            }
        }
        split
    }
}

impl<'a> Work<'a> {
    pub fn new(problem: &'a Problem, visible: &'a Visible, measured: &'a Measured, is_robust: bool) -> Self {
        let prior = visible.kept.iter().map(|&k| prior(problem, visible.parameters[k])).collect();
        Work { problem, visible, measured, is_robust, prior }
    }

    fn sigma(&self, noise: &[f64; 2], i: usize) -> f64 {
        noise[usize::from(i >= self.problem.measurement.turns())]
    }

    pub fn residuals(&self, state: &State, rows: &[usize]) -> Vec<[f64; 6]> {
        let constants = self.problem.constants_at(state);
        let one = |&r: &usize| {
            self.problem.residual(state, &constants, &self.measured.joints[r], &self.measured.readings[r])
        };
        rows.iter().map(one).collect()
    }

    pub fn row_off(&self, r: &[f64; 6]) -> Off {
        let (turns, width) = (self.problem.measurement.turns(), self.problem.measurement.width());
        let norm = |x: &[f64]| dot(x, x).sqrt();
        Off { turn: norm(&r[..turns]), shift: norm(&r[turns..width]) }
    }

    /// Root mean squares, rows with little weight left out.
    pub fn off(&self, residuals: &[[f64; 6]], weights: &[f64]) -> Off {
        let used: Vec<Off> = residuals
            .iter()
            .zip(weights)
            .filter(|(_, w)| **w >= ASIDE)
            .map(|(r, _)| self.row_off(r))
            .collect();
        let n = used.len().max(1) as f64;
        let mean = |of: &dyn Fn(&Off) -> f64| (used.iter().map(|o| of(o).powi(2)).sum::<f64>() / n).sqrt();
        Off { turn: mean(&|o| o.turn), shift: mean(&|o| o.shift) }
    }

    /// Derivatives of a row by the kept parameters, in units of what is usual, over the noise.
    pub fn rows(&self, state: &State, noise: &[f64; 2], r: usize) -> Vec<Vec<f64>> {
        let constants = self.problem.constants_at(state);
        self.rows_with(state, &constants, noise, r)
    }

    fn rows_with(
        &self,
        state: &State,
        constants: &[denavit::geometry::Transform<f64>],
        noise: &[f64; 2],
        r: usize,
    ) -> Vec<Vec<f64>> {
        let group = self.measured.readings[r].group;
        let (_, rows) = self.problem.derivatives(state, constants, &self.measured.joints[r], group);
        let scaled = |(i, row): (usize, Vec<f64>)| {
            let by = 1.0 / self.sigma(noise, i);
            self.visible.kept.iter().zip(&self.prior).map(|(&k, s)| row[k] * s * by).collect()
        };
        rows.into_iter().enumerate().map(scaled).collect()
    }

    /// JᵀWJ in units of what is usual.
    pub fn information(
        &self,
        state: &State,
        noise: &[f64; 2],
        rows: &[usize],
        weights: &[f64],
    ) -> Vec<Vec<f64>> {
        let n = self.prior.len();
        let mut a = vec![vec![0.0; n]; n];
        let constants = self.problem.constants_at(state);
        for (&r, &w) in rows.iter().zip(weights) {
            for row in self.rows_with(state, &constants, noise, r) {
                add(&mut a, &row, w);
            }
        }
        mirror(&mut a);
        a
    }

    /// How large rows are in units of the noise, and the weights of the biweight.
    fn weights(
        &self,
        residuals: &[[f64; 6]],
        noise: &[f64; 2],
        is_first: bool,
        free: usize,
    ) -> (Vec<f64>, f64) {
        let width = self.problem.measurement.width();
        let sizes: Vec<f64> = residuals
            .iter()
            .map(|r| {
                let squares = (0..width).map(|i| (r[i] / self.sigma(noise, i)).powi(2)).sum::<f64>();
                (squares / width as f64).sqrt()
            })
            .collect();
        if !self.is_robust {
            return (vec![1.0; residuals.len()], 1.0);
        }
        let mut sorted = sizes.clone();
        sorted.sort_by(f64::total_cmp);
        let median = sorted[sorted.len() / 2];
        // The median of a root of χ²/width, as it would be without noise that is grossly wrong.
        let usual = match width {
            6 => 0.9442,
            3 => 0.8881,
            _ => 0.6745,
        };
        let numbers = (width * residuals.len()) as f64;
        let left = (1.0 - free as f64 / numbers).max(0.05).sqrt();
        let scale = if is_first { FIRST * median } else { median / usual / left }.max(1e-300);
        let weight = |e: &f64| {
            let u = e / (BIWEIGHT * scale);
            if u < 1.0 { (1.0 - u * u).powi(2) } else { 0.0 }
        };
        (sizes.iter().map(weight).collect(), scale)
    }

    /// A fit on some rows.
    pub fn fitted(&self, rows: &[usize], known: Option<[f64; 2]>) -> Result<Fit, CalibrateError> {
        let mut noise = known.unwrap_or([1e-4, 1e-4]);
        let mut state = self.problem.nominal();
        let mut weights = vec![1.0; rows.len()];
        let mut ratio = 1.0;
        for round in 0..ROUNDS {
            let split = Split::new(&self.information(&state, &noise, rows, &weights));
            (state, weights) = self.solved(rows, &noise, &split)?;
            let (next, now) = self.spread(&state, rows, &weights, &noise, &split);
            ratio = now;
            let Some(next) = next.filter(|_| known.is_none()) else {
                if round > 0 {
                    break;
                }
                continue;
            };
            let change = (0..2).map(|i| (next[i] / noise[i]).ln().abs()).fold(0.0, f64::max);
            noise = next;
            if change < 1e-3 && round > 1 {
                break;
            }
        }
        let factor = self.factor(&state, rows, &noise, ratio);
        Ok(Fit { state, weights, noise, ratio, factor })
    }

    /// Gauss–Newton from the table along what is seen.
    fn solved(
        &self,
        rows: &[usize],
        noise: &[f64; 2],
        split: &Split,
    ) -> Result<(State, Vec<f64>), CalibrateError> {
        let n = self.prior.len();
        let mut state = self.problem.nominal();
        let seen: Vec<&Vec<f64>> = split.seen.iter().map(|s| &s.1).collect();
        let mut weights = vec![1.0; rows.len()];
        for step in 0..STEPS {
            let residuals = self.residuals(&state, rows);
            (weights, _) = self.weights(&residuals, noise, step == 0, seen.len());
            let constants = self.problem.constants_at(&state);
            let (mut a, mut b) = (vec![vec![0.0; n]; n], vec![0.0; n]);
            for ((&r, residual), &w) in rows.iter().zip(&residuals).zip(&weights) {
                if w == 0.0 {
                    continue;
                }
                for (i, row) in self.rows_with(&state, &constants, noise, r).iter().enumerate() {
                    add(&mut a, row, w);
                    let x = w * residual[i] / self.sigma(noise, i);
                    b.iter_mut().zip(row).for_each(|(b, j)| *b += x * j);
                }
            }
            mirror(&mut a);
            // In coordinates along what is seen.
            let along: Vec<Vec<f64>> =
                seen.iter().map(|v| a.iter().map(|row| dot(row, v)).collect()).collect();
            let small: Vec<f64> = seen.iter().flat_map(|v| along.iter().map(move |x| dot(v, x))).collect();
            let right: Vec<f64> = seen.iter().map(|v| dot(v, &b)).collect();
            let y = denavit_recording::turns::solve(small, right);
            let mut d = vec![0.0; n];
            for (y, v) in y.iter().zip(&seen) {
                d.iter_mut().zip(*v).for_each(|(d, v)| *d += y * v);
            }
            let largest = d.iter().map(|x| x.abs()).fold(0.0, f64::max);
            // A step of at most twenty times what is usual.
            let by = (20.0 / largest.max(1e-300)).min(1.0);
            let mut whole = vec![0.0; self.visible.parameters.len()];
            for ((&k, s), d) in self.visible.kept.iter().zip(&self.prior).zip(&d) {
                whole[k] = by * s * d;
            }
            state = self.problem.stepped(&state, &whole);
            if !largest.is_finite() || state.x.iter().any(|x| x.abs() > 2.0) {
                return Err(CalibrateError::NoEnd(self.off(&residuals, &vec![1.0; rows.len()])));
            }
            if largest < 1e-11 || (largest < 1e-6 && step > 8) {
                break;
            }
        }
        Ok((state, weights))
    }

    /// The noise of turns and shifts out of the residuals, each over the numbers that the fit leaves them; and the residual in
    /// units of what the noise is taken for. No noise where nothing is left.
    fn spread(
        &self,
        state: &State,
        rows: &[usize],
        weights: &[f64],
        noise: &[f64; 2],
        split: &Split,
    ) -> (Option<[f64; 2]>, f64) {
        let residuals = self.residuals(state, rows);
        let (mut squares, mut left) = ([0.0; 2], [0.0; 2]);
        let constants = self.problem.constants_at(state);
        for ((&r, residual), &w) in rows.iter().zip(&residuals).zip(weights) {
            if w == 0.0 {
                continue;
            }
            for (i, row) in self.rows_with(state, &constants, noise, r).iter().enumerate() {
                let kind = usize::from(i >= self.problem.measurement.turns());
                let taken: f64 =
                    split.seen.iter().map(|(value, v)| dot(row, v).powi(2) / value).sum::<f64>() * w;
                squares[kind] += w * (residual[i] / noise[kind]).powi(2);
                left[kind] += (w * (1.0 - taken)).max(0.0);
            }
        }
        let all = left[0] + left[1];
        if all < 1.0 {
            return (None, 1.0);
        }
        let ratio = ((squares[0] + squares[1]) / all).sqrt();
        let one = |k: usize| {
            let part = if left[k] > 0.5 { (squares[k] / left[k]).sqrt() } else { ratio };
            (noise[k] * part).max(LEAST)
        };
        (Some([one(0), one(1)]), ratio)
    }

    /// By what the inverse of the information is multiplied: the square of the residual, or of the biweight's influence.
    fn factor(&self, state: &State, rows: &[usize], noise: &[f64; 2], ratio: f64) -> f64 {
        if !self.is_robust {
            return ratio * ratio;
        }
        let residuals = self.residuals(state, rows);
        let free = self.prior.len();
        let (weights, scale) = self.weights(&residuals, noise, false, free);
        let width = self.problem.measurement.width();
        let (mut influence, mut slope, mut mean) = (0.0, 0.0, 0.0);
        for (r, w) in residuals.iter().zip(&weights) {
            let squares: f64 = (0..width).map(|i| (r[i] / self.sigma(noise, i)).powi(2)).sum();
            let u = squares / width as f64 / (BIWEIGHT * scale).powi(2);
            influence += w * w * squares;
            slope +=
                if u < 1.0 { width as f64 * (1.0 - u) * (1.0 - u * (1.0 + 4.0 / width as f64)) } else { 0.0 };
            mean += w * width as f64;
        }
        let numbers = (width * rows.len()) as f64;
        let left = (numbers - free as f64).max(1.0);
        // mean of ψ² over the square of the mean of ψ′, by the weights that the information has.
        (influence / numbers) / (slope / numbers).powi(2) * (mean / numbers) * numbers / left
    }

    /// Of the kept parameters, in their own units.
    pub fn covariance(&self, split: &Split, fit: &Fit) -> Vec<Vec<f64>> {
        let n = self.prior.len();
        let entry = |i: usize, j: usize| {
            let sum: f64 = split.seen.iter().map(|(value, v)| v[i] * v[j] / value).sum();
            sum * fit.factor * self.prior[i] * self.prior[j]
        };
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
    }

    pub fn estimates(&self, split: &Split, fit: &Fit, covariance: &[Vec<f64>]) -> Vec<Estimate> {
        let scaled = self.visible.scaled().map(|s| s.1).unwrap_or_default();
        let one = |(i, &k): (usize, &usize)| {
            let hidden: f64 = split.unseen.iter().map(|v| v[i] * v[i]).sum();
            let deviation = covariance[i][i].sqrt();
            // What is held may hide a part of what is usual: less than half a deviation is let pass.
            let is_seen = hidden.sqrt() * self.prior[i] <= 0.5 * deviation;
            let value = fit.state.x.get(k).copied();
            Estimate {
                parameter: self.visible.parameters[k],
                value: value.filter(|_| is_seen && !scaled.contains(&k)).map(|value| [value, deviation]),
            }
        };
        let is_of_arm = |e: &Estimate| !matches!(e.parameter, Parameter::Fixture(..));
        self.visible.kept.iter().enumerate().map(one).filter(is_of_arm).collect()
    }

    /// Combinations that are not seen, with few members each.
    pub fn unseen(&self, split: &Split) -> Vec<Vec<(Parameter, f64)>> {
        if split.unseen.is_empty() {
            return vec![];
        }
        let columns: Vec<Vec<f64>> =
            (0..self.prior.len()).map(|k| split.seen.iter().map(|s| s.1[k]).collect()).collect();
        let named = |v: Vec<f64>| {
            let largest = v.iter().map(|x| x.abs()).fold(0.0, f64::max);
            let members = v.iter().enumerate().filter(|(_, x)| x.abs() > 0.02 * largest);
            members.map(|(i, x)| (self.visible.parameters[self.visible.kept[i]], x * self.prior[i])).collect()
        };
        if split.seen.is_empty() {
            let alone = |i: usize| vec![(self.visible.parameters[self.visible.kept[i]], self.prior[i])];
            return (0..self.prior.len()).map(alone).collect();
        }
        null_vectors(&columns, 1e-6).into_iter().map(named).collect()
    }

    /// How far rows are off that were left out of the fit, before and behind.
    pub fn held_out(
        &self,
        folds: usize,
        episodes: &[usize],
        noise: [f64; 2],
        aside: &[usize],
        start: &[[f64; 6]],
    ) -> Option<[Off; 2]> {
        let count = self.measured.joints.len();
        if folds < 2 || count / 2 < folds {
            return None;
        }
        let mut known: Vec<usize> = episodes.to_vec();
        known.sort_unstable();
        known.dedup();
        // Rows of an episode are alike: whole episodes, where there are four.
        let fold = |r: usize| match known.len() {
            0..4 => r % folds,
            _ => known.iter().position(|e| *e == episodes[r]).unwrap_or(0) % folds,
        };
        let (mut before, mut behind) = (vec![], vec![]);
        for f in 0..folds {
            let rest: Vec<usize> = (0..count).filter(|&r| fold(r) != f).collect();
            let out: Vec<usize> = (0..count).filter(|&r| fold(r) == f && !aside.contains(&r)).collect();
            if out.is_empty() || rest.is_empty() {
                continue;
            }
            let fit = self.fitted(&rest, Some(noise)).ok()?;
            before.extend(out.iter().map(|&r| start[r]));
            behind.extend(self.residuals(&fit.state, &out));
        }
        let ones = vec![1.0; before.len()];
        Some([self.off(&before, &ones), self.off(&behind, &ones)])
    }
}

/// Adds w·rowᵀ·row to the lower half.
fn add(a: &mut [Vec<f64>], row: &[f64], w: f64) {
    for (i, line) in a.iter_mut().enumerate() {
        let x = w * row[i];
        if x != 0.0 {
            line[..=i].iter_mut().zip(row).for_each(|(a, y)| *a += x * y);
        }
    }
}

/// The upper half out of the lower one.
fn mirror(a: &mut [Vec<f64>]) {
    for i in 0..a.len() {
        let (above, below) = a.split_at_mut(i);
        above.iter_mut().zip(&below[0]).for_each(|(line, x)| line[i] = *x);
    }
}
