//! What is wrong with an answer: judged by the forward model and by Newton's method from very many starts.

use super::poses::Asked;
use crate::common::Random;
use denavit::geometry::Transform;
use denavit::inverse::{Answer, InverseKinematics};
use denavit::robot::Robot;
use std::f64::consts::{PI, TAU};

/// What is wrong.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Fault {
    /// A solution does not reach the pose.
    Wrong,
    /// A residual is not that of the joints beside it.
    Residual,
    /// A pose that was made from a configuration is called unreachable.
    Unreachable,
    /// Nothing is found, honestly.
    Empty,
    /// `complete`, and the configuration that the pose was made from is not among the answers.
    Missing,
    /// `complete`, and Newton's method finds another solution.
    Another,
    /// Honestly incomplete, and the configuration is not there.
    Overlooked,
    /// Honestly incomplete, with everything that is known there.
    Doubted,
}

impl Fault {
    /// True if something was said that is not so.
    pub fn is_lie(self) -> bool {
        matches!(self, Fault::Wrong | Fault::Residual | Fault::Unreachable | Fault::Missing | Fault::Another)
    }
}

/// What a solution may miss a pose by.
const REACHED: f64 = 1e-8;
/// What rounding leaves of a pose, and how far apart configurations may be that only rounding tells apart.
const ROUNDING: f64 = 3e-14;
const BETWEEN: f64 = 0.1;
/// A regular configuration is known to this.
const SAME: f64 = 1e-5;

/// What lengths of an arm are compared with.
fn length(robot: &Robot<f64>) -> f64 {
    if robot.reach() > 0.0 { robot.reach() } else { 1.0 }
}

fn size(robot: &Robot<f64>, pose: &Transform<f64>) -> f64 {
    length(robot).hypot((pose.translation - robot.foot()).norm())
}

/// How far the hand is from a pose, lengths by the size.
pub fn miss(robot: &Robot<f64>, pose: &Transform<f64>, q: &[f64]) -> f64 {
    let have = robot.pose(q);
    let size = size(robot, pose);
    let away = (have.translation - pose.translation).norm() / size;
    let turned = have.rotation.rows().into_iter().flatten().zip(pose.rotation.rows().into_iter().flatten());
    turned.map(|(a, b)| (a - b).abs()).fold(away, f64::max)
}

/// The columns of the Jacobian, lengths and slides by the size, by differences of poses: nothing of the solver's.
fn columns(robot: &Robot<f64>, q: &[f64], size: f64, is_angle: &[bool]) -> Vec<[f64; 12]> {
    let entries = |q: &[f64]| -> [f64; 12] {
        let x = robot.pose(q);
        let (r, p) = (x.rotation.rows(), x.translation.scale(1.0 / size));
        std::array::from_fn(|k| if k < 9 { r[k / 3][k % 3] } else { p[k - 9] })
    };
    let mut at = q.to_vec();
    (0..q.len())
        .map(|j| {
            let step = 1e-6 * if is_angle[j] { 1.0 } else { size };
            at[j] = q[j] + step;
            let plus = entries(&at);
            at[j] = q[j] - step;
            let minus = entries(&at);
            at[j] = q[j];
            std::array::from_fn(|i| (plus[i] - minus[i]) / 2e-6)
        })
        .collect()
}

/// x with (JᵀJ + λ)x = Jᵀe, by Gauss's elimination.
fn least_squares(columns: &[[f64; 12]], e: &[f64; 12], damping: f64) -> Vec<f64> {
    let n = columns.len();
    let dot = |a: &[f64; 12], b: &[f64; 12]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut m: Vec<Vec<f64>> = (0..n)
        .map(|i| {
            let mut row: Vec<f64> = (0..n).map(|j| dot(&columns[i], &columns[j])).collect();
            row[i] += damping;
            row.push(dot(&columns[i], e));
            row
        })
        .collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| m[a][k].abs().total_cmp(&m[b][k].abs())).unwrap_or(k);
        m.swap(k, pivot);
        for i in (0..n).filter(|&i| i != k) {
            let factor = if m[k][k] == 0.0 { 0.0 } else { m[i][k] / m[k][k] };
            let row = m[k].clone();
            m[i].iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
        }
    }
    (0..n).map(|k| if m[k][k] == 0.0 { 0.0 } else { m[k][n] / m[k][k] }).collect()
}

/// The smallest singular value of as many as a configuration like any other has, roughly: the smallest pivot.
pub fn least_pivot(robot: &Robot<f64>, q: &[f64], is_angle: &[bool]) -> f64 {
    let size = length(robot);
    let mut left = columns(robot, q, size, is_angle);
    let square = |c: &[f64; 12]| c.iter().map(|x| x * x).sum::<f64>();
    let mut least = f64::INFINITY;
    for _ in 0..q.len().min(6) {
        let Some(k) = (0..left.len()).max_by(|&a, &b| square(&left[a]).total_cmp(&square(&left[b]))) else {
            break;
        };
        let pivot = left.swap_remove(k);
        let length = square(&pivot);
        least = least.min(length.sqrt());
        for c in &mut left {
            let along = c.iter().zip(&pivot).map(|(x, y)| x * y).sum::<f64>() / length.max(f64::MIN_POSITIVE);
            c.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= along * y);
        }
    }
    least
}

/// A configuration with the pose, by Newton's method from a start.
fn descend(robot: &Robot<f64>, pose: &Transform<f64>, start: &[f64], is_angle: &[bool]) -> Option<Vec<f64>> {
    let size = size(robot, pose);
    let mut at = start.to_vec();
    let (mut best, mut damping) = (miss(robot, pose, &at), 1e-2);
    for _ in 0..60 {
        if best <= 1e-13 {
            break;
        }
        let have = robot.pose(&at);
        let (r, s) = (pose.rotation.rows(), have.rotation.rows());
        let p = (pose.translation - have.translation).scale(1.0 / size);
        let e: [f64; 12] =
            std::array::from_fn(|k| if k < 9 { r[k / 3][k % 3] - s[k / 3][k % 3] } else { p[k - 9] });
        let step = least_squares(&columns(robot, &at, size, is_angle), &e, damping);
        let unit = |j: usize| if is_angle[j] { 1.0 } else { size };
        let next: Vec<f64> = (0..at.len()).map(|j| at[j] + step[j] * unit(j)).collect();
        let missed = miss(robot, pose, &next);
        if missed < best {
            (at, best) = (next, missed);
            damping = (damping * 0.1).max(1e-14);
        } else if damping > 1e3 {
            break;
        } else {
            damping *= 10.0;
        }
    }
    (best <= 1e-11).then_some(at)
}

/// Whether a configuration is among the solutions or lies on a family. `slack` is how exactly a solution is known there.
pub fn holds(
    solver: &InverseKinematics,
    pose: &Transform<f64>,
    answer: &Answer,
    q: &[f64],
    slack: f64,
) -> bool {
    let same = |p: &[f64]| {
        let away = solver.space.distance(p, q);
        // Or no pose of doubles can tell them apart: all between them have it.
        let between = |part: f64| -> Vec<f64> {
            p.iter().zip(solver.space.moved(p, q)).map(|(x, d)| x + part * d).collect()
        };
        away <= slack
            || away <= BETWEEN
                && [0.25, 0.5, 0.75].into_iter().all(|k| miss(&solver.robot, pose, &between(k)) <= ROUNDING)
    };
    answer.solutions.iter().any(|s| same(&s.q))
        || !answer.families.is_empty()
            && (answer.families.iter().any(|f| same(&f.representative.q))
                || solver.nearest(pose, answer, q).is_some_and(|n| same(&n.q)))
}

/// Whether a row of a list is this configuration, whole windows aside.
fn is_row(solver: &InverseKinematics, row: &[f64], q: &[f64]) -> bool {
    let space = &solver.space;
    (0..q.len()).all(|j| {
        let (way, window) = (row[j] - q[j], space.turning.windows[j]);
        let rest = if window.is_finite() { way - window * (way / window).round() } else { way };
        rest.abs() <= SAME * space.unit(j)
    })
}

/// What is wrong with the answer to a pose.
pub fn judge(
    solver: &InverseKinematics,
    asked: &Asked,
    answer: &Answer,
    starts: usize,
    random: &mut Random,
) -> Option<Fault> {
    let (robot, pose, q) = (&solver.robot, &asked.pose, &asked.q);
    let is_angle = &solver.space.is_angle;
    // A slide far beyond the arm has its rounding, and so has an arm far from the origin.
    let remote = 64.0 * f64::EPSILON * robot.foot().norm() / size(robot, pose);
    let rounding = |s: &[f64]| {
        let slides = s.iter().zip(is_angle).filter(|(_, is_angle)| !**is_angle);
        let far = slides.map(|(x, _)| x.abs()).fold(0.0, f64::max);
        remote + 64.0 * f64::EPSILON * far / size(robot, pose)
    };
    for s in answer.solutions.iter().chain(answer.families.iter().map(|f| &f.representative)) {
        let missed = miss(robot, pose, &s.q);
        if missed > REACHED + asked.noise + rounding(&s.q) {
            return Some(Fault::Wrong);
        }
        if missed > 10.0 * s.residual + 1e-12 + 10.0 * asked.noise + rounding(&s.q) {
            return Some(Fault::Residual);
        }
    }
    if !answer.is_reachable() {
        return Some(if answer.is_complete() { Fault::Unreachable } else { Fault::Empty });
    }
    let least = least_pivot(robot, q, is_angle);
    // Where the hand does not see a joint move, the joint is known to the root of what is known of the hand.
    let slack = if least > 1e-4 { SAME } else { 3e-3 };
    if !holds(solver, pose, answer, q, slack) {
        return Some(if answer.is_complete() { Fault::Missing } else { Fault::Overlooked });
    }
    if answer.is_complete() {
        // Copies of joints with gears are rows of their own.
        if least > 1e-4
            && answer.families.is_empty()
            && !answer.solutions.iter().any(|s| is_row(solver, &s.q, q))
        {
            return Some(Fault::Missing);
        }
        for _ in 0..starts {
            let start: Vec<f64> =
                is_angle
                    .iter()
                    .map(|&a| {
                        if a { TAU * random.unit() - PI } else { robot.reach() * (2.0 * random.unit() - 1.0) }
                    })
                    .collect();
            let Some(found) = descend(robot, pose, &start, is_angle) else { continue };
            if least_pivot(robot, &found, is_angle) > 1e-3 && !holds(solver, pose, answer, &found, 1e-4) {
                return Some(Fault::Another);
            }
        }
        return None;
    }
    Some(Fault::Doubted)
}
