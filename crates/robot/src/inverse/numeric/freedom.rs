//! What hard tasks leave free, used for soft ones: tasks, postures, the middle of the limits.
//!
//! A step minimises a quadratic model of the soft cost among the motions that keep the hard tasks, to first order, and
//! the limits that have been met; it ends where the next limit is met. What it spoils of the hard tasks to second order is put right by undamped steps before it is judged.
//! So every configuration on the way meets the hard tasks.

use super::descent::Problem;
use super::limits::Limits;
use super::linear::Factored;
use super::motion::{Motion, Point};
use super::task::{Place, Preference, Shape};

/// Steps; ten are usual.
const STEPS: usize = 100;
/// The longest step of a joint, radians or lengths of the arm.
const LONGEST: f64 = 0.5;
/// A part of the soft cost that is not worth another step.
const SMALL: f64 = 1e-13;
/// What the model's matrix gets on its diagonal beside its largest entry there, so that every joint has one.
const FLOOR: f64 = 1e-7;
/// Half the distance at which gradients are compared: radians and lengths of the arm.
const APART: f64 = 1e-4;
/// A joint this near to a limit is at it, radians or lengths of the arm.
const AT_LIMIT: f64 = 1e-7;
/// ρ beside the largest second derivative.
const ACROSS: f64 = 100.0;

/// Soft tasks and preferences.
#[derive(Clone, Debug)]
pub(super) struct Wishes {
    pub motion: Motion,
    pub shapes: Vec<Shape>,
    pub preferences: Vec<Preference>,
}

/// A term of the soft cost in one joint: `weight·((q − at)/by)²/2`.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Pull {
    joint: usize,
    at: f64,
    by: f64,
    weight: f64,
}

impl Wishes {
    /// True if nothing is wished for.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty() && self.preferences.is_empty()
    }

    fn pulls(&self, limits: &Limits) -> Vec<Pull> {
        let mut pulls = vec![];
        for preference in &self.preferences {
            match preference {
                Preference::Posture { near, weight } => {
                    let pairs = near.iter().zip(&self.motion.units).enumerate();
                    pulls.extend(pairs.map(|(joint, (&at, &by))| Pull { joint, at, by, weight: *weight }));
                }
                Preference::MiddleOfLimits { weight } => {
                    let middles = (0..self.motion.joints).filter_map(|j| Some((j, limits.middle(j)?)));
                    pulls.extend(middles.map(|(joint, [at, by])| Pull { joint, at, by, weight: *weight }));
                }
            }
        }
        pulls
    }

    fn cost(&mut self, targets: &[Place], pulls: &[Pull], point: &mut Point) -> f64 {
        self.motion.evaluate(&self.shapes, targets, point);
        let pulled: f64 = pulls.iter().map(|p| p.weight * ((point.q[p.joint] - p.at) / p.by).powi(2)).sum();
        0.5 * (point.cost + pulled)
    }

    /// The gradient of the soft cost and a positive matrix near its second derivatives, by units of the joints.
    fn model(&self, pulls: &[Pull], point: &Point) -> (Vec<f64>, Vec<f64>) {
        let n = self.motion.joints;
        let mut gradient = vec![0.0; n];
        let mut matrix = vec![0.0; n * n];
        for (r, c) in point.r.iter().zip(point.c.chunks_exact(n.max(1))) {
            for (i, a) in c.iter().enumerate() {
                gradient[i] -= a.iter().zip(r).map(|(a, r)| a * r).sum::<f64>();
                for (m, b) in matrix[i * n..].iter_mut().zip(c) {
                    *m += a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
                }
            }
        }
        for p in pulls {
            let rate = self.motion.units[p.joint] / p.by;
            gradient[p.joint] += p.weight * rate * (point.q[p.joint] - p.at) / p.by;
            matrix[p.joint * (n + 1)] += p.weight * rate * rate;
        }
        let largest = matrix.iter().step_by(n + 1).fold(0.0_f64, |m, d| m.max(*d));
        matrix.iter_mut().step_by(n + 1).for_each(|d| *d += FLOOR * largest + f64::MIN_POSITIVE);
        (gradient, matrix)
    }

    /// Moves a configuration that meets the hard tasks of `problem` to where the soft cost is least nearby.
    pub fn follow(&mut self, problem: &mut Problem, hard: &[Place], soft: &[Place], q: &mut Vec<f64>) {
        let mut pair = Pair {
            pulls: self.pulls(&problem.limits),
            targets: [hard, soft],
            hard: Point { q: q.clone(), ..Point::default() },
            soft: Point { q: q.clone(), ..Point::default() },
            cost: f64::INFINITY,
        };
        problem.evaluate(hard, &mut pair.hard);
        pair.cost = self.cost(soft, &pair.pulls, &mut pair.soft);
        for _ in 0..STEPS {
            let (gradient, rough) = self.model(&pair.pulls, &pair.soft);
            let (delta, multipliers) = constrained(problem, &pair.hard, &gradient, &rough);
            let exact = self.curvature(problem, &pair, &multipliers);
            let better = exact.map(|matrix| constrained(problem, &pair.hard, &gradient, &matrix).0);
            if !better.is_some_and(|d| self.go(problem, &mut pair, &d))
                && !self.go(problem, &mut pair, &delta)
            {
                break;
            }
        }
        *q = pair.hard.q;
    }

    /// Goes as far along a step as the soft cost falls; false if it falls nowhere.
    fn go(&mut self, problem: &mut Problem, pair: &mut Pair<'_>, delta: &[f64]) -> bool {
        // No further than to where the first joint meets a limit.
        let mut k: f64 = 1.0;
        for (j, d) in delta.iter().enumerate().filter(|d| d.1.abs() > AT_LIMIT) {
            let bound = if *d > 0.0 { problem.limits.high[j] } else { problem.limits.low[j] };
            k = k.min(LONGEST / d.abs()).min((bound - pair.hard.q[j]) / (problem.motion.units[j] * d));
        }
        let mut next = pair.hard.clone();
        let mut wished = pair.soft.clone();
        for _ in 0..8 {
            for (j, (x, d)) in next.q.iter_mut().zip(delta).enumerate() {
                let to = pair.hard.q[j] + k * problem.motion.units[j] * d;
                *x = to.max(problem.limits.low[j]).min(problem.limits.high[j]);
            }
            if problem.restore(pair.targets[0], &mut next) {
                wished.q.clone_from(&next.q);
                let cost = self.cost(pair.targets[1], &pair.pulls, &mut wished);
                if cost < pair.cost * (1.0 - SMALL) {
                    (pair.hard, pair.soft, pair.cost) = (next, wished, cost);
                    return true;
                }
            }
            k *= 0.4;
        }
        false
    }

    /// Second derivatives of the soft cost along the hard tasks: those of the soft cost and `multipliers` times the
    /// hard residuals, by differences of gradients, made positive across the hard tasks; nothing if they are not
    /// positive along them.
    fn curvature(&mut self, problem: &mut Problem, pair: &Pair<'_>, multipliers: &[f64]) -> Option<Vec<f64>> {
        let n = problem.motion.joints;
        let mut rows = vec![0.0; n * n];
        let (mut hard, mut soft) = (pair.hard.clone(), pair.soft.clone());
        for (j, row) in rows.chunks_exact_mut(n.max(1)).enumerate() {
            for sign in [1.0, -1.0] {
                let x = pair.hard.q[j] + sign * APART * problem.motion.units[j];
                (hard.q[j], soft.q[j]) = (x, x);
                problem.evaluate(pair.targets[0], &mut hard);
                self.motion.evaluate(&self.shapes, pair.targets[1], &mut soft);
                let gradient = self.model(&pair.pulls, &soft).0;
                for (i, (entry, g)) in row.iter_mut().zip(gradient).enumerate() {
                    let columns = hard.c[i..].iter().step_by(n).flatten();
                    let held: f64 = columns.zip(multipliers).map(|(c, y)| c * y).sum();
                    *entry += sign * (g - held) / (2.0 * APART);
                }
            }
            (hard.q[j], soft.q[j]) = (pair.hard.q[j], pair.soft.q[j]);
        }
        // ρ CᵀC changes nothing along the hard tasks.
        let largest = rows.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let across = |i: usize, j: usize| -> f64 {
            let columns = pair.hard.c[i..].iter().step_by(n).zip(pair.hard.c[j..].iter().step_by(n));
            columns.flat_map(|(a, b)| a.iter().zip(b)).map(|(a, b)| a * b).sum()
        };
        let entry =
            |i: usize, j: usize| 0.5 * (rows[i * n + j] + rows[j * n + i]) + ACROSS * largest * across(i, j);
        let matrix: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        Factored::default().factor(&matrix, n).then_some(matrix)
    }
}

/// A configuration as hard and soft tasks see it.
struct Pair<'a> {
    pulls: Vec<Pull>,
    /// Of the hard and of the soft tasks.
    targets: [&'a [Place]; 2],
    hard: Point,
    soft: Point,
    /// Of the soft ones.
    cost: f64,
}

impl Problem {
    /// Undamped steps back to the hard tasks; true if they are met.
    fn restore(&mut self, targets: &[Place], point: &mut Point) -> bool {
        self.evaluate(targets, point);
        for _ in 0..6 {
            if point.cost <= 1e-25 {
                break;
            }
            self.advance(targets, point);
        }
        let q = std::mem::take(&mut point.q);
        let is_met = self.is_met(targets, &q);
        point.q = q;
        is_met
    }
}

/// δ that minimises gᵀδ + δᵀMδ/2 with Cδ = r; joints that are at a limit and would go beyond it stay there.
/// With it the multipliers of the hard residuals.
fn constrained(problem: &Problem, at: &Point, gradient: &[f64], matrix: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (n, rows) = (gradient.len(), 6 * at.r.len());
    let mut delta = vec![0.0; n];
    let mut is_free = vec![true; n];
    let (mut m, mut s) = (Factored::default(), Factored::default());
    loop {
        let free: Vec<usize> = (0..n).filter(|&j| is_free[j]).collect();
        let held: Vec<usize> = (0..n).filter(|&j| !is_free[j]).collect();
        let size = free.len();
        if size == 0 {
            return (delta, vec![0.0; rows]);
        }
        let part: Vec<f64> =
            free.iter().flat_map(|&i| free.iter().map(move |&j| matrix[i * n + j])).collect();
        m.factor(&part, size);
        let entry = |row: usize, j: usize| at.c[row / 6 * n + j][row % 6];
        // u = M⁻¹(g + M δ_held), Y = M⁻¹Cᵀ, S = C Y
        let mut u: Vec<f64> = free
            .iter()
            .map(|&i| gradient[i] + held.iter().map(|&j| matrix[i * n + j] * delta[j]).sum::<f64>())
            .collect();
        m.solve(&mut u);
        let y: Vec<Vec<f64>> = (0..rows)
            .map(|row| {
                let mut x: Vec<f64> = free.iter().map(|&j| entry(row, j)).collect();
                m.solve(&mut x);
                x
            })
            .collect();
        let along = |row: usize, x: &[f64]| free.iter().zip(x).map(|(&j, x)| entry(row, j) * x).sum::<f64>();
        let mut square: Vec<f64> = (0..rows * rows).map(|k| along(k / rows, &y[k % rows])).collect();
        let largest = square.iter().step_by(rows + 1).fold(0.0_f64, |m, d| m.max(*d));
        square.iter_mut().step_by(rows + 1).for_each(|d| *d += 1e-12 * largest);
        s.factor(&square, rows);
        // S λ = r − C δ_held + C u, δ = Y λ − u
        let mut multipliers: Vec<f64> = (0..rows)
            .map(|row| {
                let taken: f64 = held.iter().map(|&j| entry(row, j) * delta[j]).sum();
                at.r[row / 6][row % 6] - taken + along(row, &u)
            })
            .collect();
        s.solve(&mut multipliers);
        for (k, &j) in free.iter().enumerate() {
            delta[j] = y.iter().zip(&multipliers).map(|(y, l)| y[k] * l).sum::<f64>() - u[k];
        }
        let mut all_within = true;
        for &j in &free {
            let unit = problem.motion.units[j];
            let to = at.q[j] + unit * delta[j];
            let bound = to.max(problem.limits.low[j]).min(problem.limits.high[j]);
            let left = (bound - at.q[j]) / unit;
            if bound != to && left.abs() <= AT_LIMIT {
                delta[j] = left;
                (is_free[j], all_within) = (false, false);
            }
        }
        if all_within {
            return (delta, multipliers);
        }
    }
}
