//! To the bottom: from where a descent gave up to a point from which no small motion within the limits leads nearer.
//!
//! Newton's method on half the sum of the squares. The Gauss–Newton matrix is no good there: of an arm stretched towards
//! a target that it cannot reach it is singular, and what bends the cost are the second derivatives. Those are
//! differences of gradients; the gradients are exact.

use super::descent::Problem;
use super::linear::Factored;
use super::motion::Point;
use super::task::Place;

/// Steps of a polish; ten are usual.
const STEPS: usize = 80;
/// Half the distance at which gradients are compared: radians and lengths of the arm. Second derivatives are then good
/// to about 1e-8.
const APART: f64 = 1e-4;
/// The longest step of a joint, radians or lengths of the arm.
const LONGEST: f64 = 0.5;
/// A gradient that is none, beside a residual of 1.
const FLAT: f64 = 1e-13;
/// A gradient below which a point counts as stationary.
const STATIONARY: f64 = 1e-8;

/// Leads a point to where the cost is stationary; true if it is there.
pub(super) fn polish(problem: &mut Problem, targets: &[Place], point: &mut Point) -> bool {
    let n = problem.motion.joints;
    problem.evaluate(targets, point);
    let mut next = point.clone();
    let mut factored = Factored::default();
    let mut shift = 0.0;
    let mut slope = problem.slope(point);
    for _ in 0..STEPS {
        let free: Vec<usize> = (0..n).filter(|&j| problem.is_free(point, j)).collect();
        if slope <= FLAT || free.is_empty() {
            break;
        }
        let hessian = problem.hessian(targets, point, &free, &mut next);
        let gradient = problem.gradient(point);
        let mut accepted = false;
        while shift < 1e6 {
            let mut matrix = hessian.clone();
            matrix.iter_mut().step_by(free.len() + 1).for_each(|d| *d += shift);
            if !factored.factor(&matrix, free.len()) {
                shift = f64::max(4.0 * shift, 1e-9);
                continue;
            }
            let mut delta: Vec<f64> = free.iter().map(|&j| -gradient[j]).collect();
            factored.solve(&mut delta);
            let longest = delta.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let k = if longest > LONGEST { LONGEST / longest } else { 1.0 };
            next.q.clone_from(&point.q);
            for (&j, d) in free.iter().zip(&delta) {
                let to = point.q[j] + k * problem.motion.units[j] * d;
                next.q[j] = to.max(problem.limits.low[j]).min(problem.limits.high[j]);
            }
            problem.evaluate(targets, &mut next);
            let next_slope = problem.slope(&next);
            // Where the cost is flat to rounding, the gradient tells.
            let is_level = next.cost <= point.cost * (1.0 + 1e-14) && next_slope <= 0.5 * slope;
            if next.cost < point.cost * (1.0 - 1e-14) || is_level {
                std::mem::swap(point, &mut next);
                (slope, accepted) = (next_slope, true);
                shift = if shift < 1e-12 { 0.0 } else { 0.1 * shift };
                break;
            }
            shift = f64::max(8.0 * shift, 1e-9);
        }
        if !accepted {
            break;
        }
    }
    slope <= STATIONARY * (1.0 + point.cost.sqrt())
}

impl Problem {
    /// The gradient of half the cost, by units of the joints.
    fn gradient(&self, point: &Point) -> Vec<f64> {
        (0..self.motion.joints).map(|j| self.derivative(point, j)).collect()
    }

    fn derivative(&self, point: &Point, j: usize) -> f64 {
        let columns = point.c[j..].iter().step_by(self.motion.joints);
        -columns.zip(&point.r).flat_map(|(c, r)| c.iter().zip(r)).map(|(c, r)| c * r).sum::<f64>()
    }

    /// False for a joint that is held by a limit.
    fn is_free(&self, point: &Point, j: usize) -> bool {
        let slope = self.derivative(point, j);
        let held =
            if slope < 0.0 { point.q[j] >= self.limits.high[j] } else { point.q[j] <= self.limits.low[j] };
        !held
    }

    /// The largest derivative by a joint that can move.
    fn slope(&self, point: &Point) -> f64 {
        let free = (0..self.motion.joints).filter(|&j| self.is_free(point, j));
        free.map(|j| self.derivative(point, j).abs()).fold(0.0, f64::max)
    }

    /// Second derivatives of half the cost by the joints that are free.
    fn hessian(&mut self, targets: &[Place], point: &Point, free: &[usize], work: &mut Point) -> Vec<f64> {
        let size = free.len();
        let mut rows = vec![0.0; size * size];
        work.q.clone_from(&point.q);
        for (row, &j) in rows.chunks_exact_mut(size.max(1)).zip(free) {
            for sign in [1.0, -1.0] {
                work.q[j] = point.q[j] + sign * APART * self.motion.units[j];
                self.evaluate(targets, work);
                for (x, &i) in row.iter_mut().zip(free) {
                    *x += sign * self.derivative(work, i) / (2.0 * APART);
                }
            }
            work.q[j] = point.q[j];
        }
        let at = |i: usize, j: usize| rows[i * size + j];
        (0..size * size).map(|k| 0.5 * (at(k / size, k % size) + at(k % size, k / size))).collect()
    }
}
