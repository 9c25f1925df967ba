//! One damped step within limits.
//!
//! A step δ minimises |r − Cδ|² + λ|δ|² (Levenberg 1944). Joints that it would carry beyond a limit go as far as the
//! limit; the others take over what these leave, by the same minimum over them alone.

use super::limits::Limits;
use super::linear::{Factored, solve6};
use super::motion::Point;

/// Computes steps; keeps its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Stepper {
    /// The last step, in units of the joints.
    pub delta: Vec<f64>,
    free: Vec<bool>,
    rest: Vec<[f64; 6]>,
    gram: Vec<f64>,
    right: Vec<f64>,
    factored: Factored,
}

impl Stepper {
    /// The step from a point, left in `delta`.
    pub fn step(&mut self, point: &Point, damping: f64, limits: &Limits, units: &[f64]) {
        let n = units.len();
        self.delta.clear();
        self.delta.resize(n, 0.0);
        self.free.clear();
        self.free.resize(n, true);
        self.rest.clone_from(&point.r);
        loop {
            match (&self.rest[..], n) {
                ([r], 0..6) => few_joints(&point.c, r, &self.free, damping, &mut self.delta),
                ([r], _) => one_task(&point.c, r, &self.free, damping, &mut self.delta),
                _ => self.several_tasks(&point.c, n, damping),
            }
            let mut all_within = true;
            for (j, unit) in units.iter().enumerate() {
                if !self.free[j] {
                    continue;
                }
                let to = point.q[j] + unit * self.delta[j];
                let bound = if to > limits.high[j] {
                    limits.high[j]
                } else if to < limits.low[j] {
                    limits.low[j]
                } else {
                    continue;
                };
                let moved = (bound - point.q[j]) / unit;
                self.free[j] = false;
                self.delta[j] = moved;
                all_within = false;
                for (rest, c) in self.rest.iter_mut().zip(point.c[j..].iter().step_by(n)) {
                    rest.iter_mut().zip(c).for_each(|(r, c)| *r -= c * moved);
                }
            }
            if all_within {
                return;
            }
        }
    }

    /// By the smaller of (C Cᵀ + λ)y = r, δ = Cᵀy and (CᵀC + λ)δ = Cᵀr.
    fn several_tasks(&mut self, c: &[[f64; 6]], n: usize, damping: f64) {
        let tasks = self.rest.len();
        let rows = 6 * tasks;
        let free: Vec<usize> = (0..n).filter(|&j| self.free[j]).collect();
        if free.is_empty() {
            return;
        }
        if rows <= free.len() {
            self.gram.clear();
            self.gram.resize(rows * rows, 0.0);
            for &j in &free {
                for a in 0..tasks {
                    for (i, x) in c[a * n + j].iter().enumerate().filter(|e| *e.1 != 0.0) {
                        let row = &mut self.gram[(6 * a + i) * rows..][..6 * (a + 1)];
                        for (b, part) in row.chunks_exact_mut(6).enumerate() {
                            part.iter_mut().zip(&c[b * n + j]).for_each(|(g, y)| *g += x * y);
                        }
                    }
                }
            }
            self.gram.iter_mut().step_by(rows + 1).for_each(|d| *d += damping);
            self.factored.factor(&self.gram, rows);
            self.right.clear();
            self.right.extend(self.rest.iter().flatten());
            self.factored.solve(&mut self.right);
            for &j in &free {
                let parts = self.right.chunks_exact(6).enumerate();
                self.delta[j] =
                    parts.map(|(a, y)| y.iter().zip(&c[a * n + j]).map(|(y, c)| y * c).sum::<f64>()).sum();
            }
        } else {
            let size = free.len();
            self.gram.clear();
            self.right.clear();
            for (k, &j) in free.iter().enumerate() {
                let mut right = 0.0;
                for (a, r) in self.rest.iter().enumerate() {
                    right += dot6(r, &c[a * n + j]);
                }
                self.right.push(right);
                for (l, &i) in free.iter().enumerate() {
                    let entry: f64 = match l <= k {
                        true => (0..tasks).map(|a| dot6(&c[a * n + j], &c[a * n + i])).sum(),
                        false => 0.0,
                    };
                    self.gram.push(if l == k { entry + damping } else { entry });
                }
            }
            self.factored.factor(&self.gram, size);
            self.factored.solve(&mut self.right);
            free.iter().zip(&self.right).for_each(|(&j, x)| self.delta[j] = *x);
        }
    }
}

fn dot6(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5]
}

/// (C Cᵀ + λ) y = r, δ = Cᵀ y
#[inline]
fn one_task(c: &[[f64; 6]], r: &[f64; 6], free: &[bool], damping: f64, delta: &mut [f64]) {
    let mut gram = [[0.0; 6]; 6];
    for c in c.iter().zip(free).filter(|f| *f.1).map(|f| f.0) {
        for (row, x) in gram.iter_mut().zip(c) {
            for (g, y) in row.iter_mut().zip(c) {
                *g += x * y;
            }
        }
    }
    for (i, row) in gram.iter_mut().enumerate() {
        row[i] += damping;
    }
    let y = solve6(&mut gram, r);
    for ((d, c), _) in delta.iter_mut().zip(c).zip(free).filter(|f| *f.1) {
        *d = dot6(c, &y);
    }
}

/// (CᵀC + λ) δ = Cᵀ r, for fewer than six joints
fn few_joints(c: &[[f64; 6]], r: &[f64; 6], free: &[bool], damping: f64, delta: &mut [f64]) {
    let (mut gram, mut right) = ([[0.0; 6]; 6], [0.0; 6]);
    for (k, a) in c.iter().enumerate().filter(|(k, _)| free[*k]) {
        right[k] = dot6(a, r);
        for (l, b) in c.iter().enumerate().take(k + 1).filter(|(l, _)| free[*l]) {
            gram[k][l] = dot6(a, b);
        }
        gram[k][k] += damping;
    }
    let x = solve6(&mut gram, &right);
    for ((d, x), _) in delta.iter_mut().zip(x).zip(free).filter(|f| *f.1) {
        *d = x;
    }
}
