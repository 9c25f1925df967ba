//! Descents: damped Gauss–Newton steps within limits, given up early where they do not pay.
//!
//! The damping falls with the square of the residual (Chan and Lawrence 1988), so that the last steps converge
//! quadratically. A step is taken without asking whether it helps: a descent that has not come down by much after a
//! few of them is left for another start, which costs less than to lead each one to its end.

use super::limits::Limits;
use super::motion::{Motion, Point};
use super::step::Stepper;
use super::task::{Place, Residual, Shape};

/// λ = `DAMPING`·Σ r², in radians and lengths of the arm. From 0.01 to 0.3 it makes little difference.
const DAMPING: f64 = 0.03;
/// The longest step of a joint, radians or lengths of the arm.
const LONGEST: f64 = 1.0;
/// By how much Σ r² must have come down when patience ends.
const PROGRESS: f64 = 0.25;
/// Residuals that are not worth another step.
const FINE: f64 = 1e-13;

/// How a descent ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Ended {
    /// All tasks are met.
    Met,
    /// It came down too slowly.
    Slow,
}

/// Tasks, the frames that they move, and the limits.
#[derive(Clone, Debug)]
pub(super) struct Problem {
    pub motion: Motion,
    pub shapes: Vec<Shape>,
    pub limits: Limits,
    /// The arm's size, metres.
    pub size: f64,
    /// What a task may be missed by: radians, and metres by the arm's size.
    pub tolerance: [f64; 2],
    pub stepper: Stepper,
}

impl Problem {
    /// What each task misses at a configuration.
    pub fn residuals(&mut self, targets: &[Place], q: &[f64]) -> Vec<Residual> {
        let places = self.motion.places(q);
        self.shapes.iter().zip(&places).zip(targets).map(|((s, at), t)| s.residual(at, t)).collect()
    }

    /// True if all tasks are met.
    pub fn is_met(&mut self, targets: &[Place], q: &[f64]) -> bool {
        let [angle, distance] = [self.tolerance[0], self.tolerance[1] * self.size];
        self.residuals(targets, q).iter().all(|r| r.angle <= angle && r.distance <= distance)
    }

    /// Residuals and derivatives at `point.q`.
    pub fn evaluate(&mut self, targets: &[Place], point: &mut Point) {
        self.motion.evaluate(&self.shapes, targets, point);
    }

    /// One step from a point, and what is there.
    pub fn advance(&mut self, targets: &[Place], point: &mut Point) {
        self.stepper.step(point, DAMPING * point.cost, &self.limits, &self.motion.units);
        let longest = self.stepper.delta.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let k = if longest > LONGEST { LONGEST / longest } else { 1.0 };
        let limits = self.limits.low.iter().zip(&self.limits.high);
        let steps = self.stepper.delta.iter().zip(&self.motion.units);
        for ((q, (d, unit)), (low, high)) in point.q.iter_mut().zip(steps).zip(limits) {
            *q = (*q + k * unit * d).max(*low).min(*high);
        }
        self.motion.evaluate(&self.shapes, targets, point);
    }

    /// Descends from `point.q`, as long as Σ r² falls fourfold in every `patience` steps; adds the steps to `steps`,
    /// which end at `most`.
    pub fn descend(
        &mut self,
        targets: &[Place],
        point: &mut Point,
        patience: usize,
        steps: &mut usize,
        most: usize,
    ) -> Ended {
        self.evaluate(targets, point);
        let good = self.good();
        let (mut reference, mut left) = (point.cost, patience);
        while *steps < most {
            if point.cost <= good {
                return self.finish(targets, point, steps);
            }
            self.advance(targets, point);
            *steps += 1;
            left -= 1;
            if left == 0 {
                if point.cost.is_nan() || point.cost > PROGRESS * reference {
                    break;
                }
                (reference, left) = (point.cost, patience);
            }
        }
        match point.cost <= good {
            true => self.finish(targets, point, steps),
            false => Ended::Slow,
        }
    }

    /// Σ r² below which all tasks are met: their weights are at least 1.
    fn good(&self) -> f64 {
        self.tolerance[0].min(self.tolerance[1]).powi(2)
    }

    /// The last steps, as far as rounding allows.
    fn finish(&mut self, targets: &[Place], point: &mut Point, steps: &mut usize) -> Ended {
        let mut best = (point.cost, point.q.clone());
        for _ in 0..4 {
            if best.0 <= FINE * FINE {
                break;
            }
            self.advance(targets, point);
            *steps += 1;
            if point.cost >= best.0 {
                break;
            }
            best.0 = point.cost;
            best.1.clone_from(&point.q);
        }
        if point.cost > best.0 {
            point.q.clone_from(&best.1);
            self.evaluate(targets, point);
        }
        let q = best.1;
        if self.is_met(targets, &q) { Ended::Met } else { Ended::Slow }
    }
}
