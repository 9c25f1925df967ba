//! Newton's method on the pose.

use super::derivation::Goal;
pub(crate) use crate::geometry::nearest_rigid;
use crate::geometry::{Axis, Transform, Vector};
use crate::mechanism::Robot;
use crate::random::Random;
use crate::space::JointSpace;
use crate::velocity::{self, svd};

/// Steps of a polish; two or three are usual.
const STEPS: usize = 20;
/// Further steps where those did not reach the pose.
const FINE: usize = 8;
/// So many configurations tell what is usual.
const LOOKS: usize = 15;
/// How far a polish may lead: further away is another solution.
const FAR: f64 = 0.3;

/// The error of a pose as rotation vector and displacement by `size`, both in the base; zeros where the goal gives
/// nothing.
pub(super) fn error(goal: Goal, wanted: &Transform<f64>, have: &Transform<f64>, size: f64) -> [f64; 6] {
    let turn = rotation_error(goal, wanted, have);
    let d = wanted.translation - have.translation;
    [turn[0], turn[1], turn[2], d[0] / size, d[1] / size, d[2] / size]
}

/// The small rotation that brings `have` to `wanted`; for an axis, the one that brings the axis there.
fn rotation_error(goal: Goal, wanted: &Transform<f64>, have: &Transform<f64>) -> [f64; 3] {
    let half = |v: Vector<f64>, k: f64| [v[0] * k, v[1] * k, v[2] * k];
    match goal {
        Goal::Position => [0.0; 3],
        Goal::PositionAndAxis => half(have.rotation.z().cross(wanted.rotation.z()), 1.0),
        Goal::Pose => {
            let (a, b) = (&have.rotation, &wanted.rotation);
            let sum = a.x().cross(b.x()) + a.y().cross(b.y()) + a.z().cross(b.z());
            half(sum, 0.5)
        }
    }
}

/// How far the hand is from a pose: the columns of the rotation that the goal gives and the position by `size`.
pub fn distance(robot: &Robot<f64>, goal: Goal, wanted: &Transform<f64>, q: &[f64], size: f64) -> f64 {
    let have = robot.pose(q);
    let columns = match goal {
        Goal::Pose => &Axis::ALL[..],
        Goal::Position => &[],
        Goal::PositionAndAxis => &[Axis::Z],
    };
    let square = |v: Vector<f64>| v.dot(v);
    let turned: f64 =
        columns.iter().map(|&c| square(have.rotation.column(c) - wanted.rotation.column(c))).sum();
    let shift = square(have.translation - wanted.translation) / (size * size);
    (turned + shift).sqrt()
}

/// How far configurations are left along the motion that the hand hardly sees (radians, and lengths by the reach).
const ALONG: [f64; 5] = [0.02, 0.2, 0.8, 1.6, 3.0];

/// A configuration, and others along the motion of its joints that the hand sees least, in both directions; joints in
/// `given` stay.
pub fn along_hidden(
    robot: &Robot<f64>,
    goal: Goal,
    q: &[f64],
    given: &[usize],
    space: &JointSpace,
) -> Vec<Vec<f64>> {
    let columns = jacobian(robot, goal, q, given, space.length());
    let free: Vec<usize> = (0..q.len()).filter(|j| !given.contains(j)).collect();
    let svd = svd(free.iter().map(|&j| columns[j]).collect());
    let Some(hidden) = free.len().min(6).checked_sub(1).and_then(|last| svd.vectors.get(last)) else {
        return vec![];
    };
    let moved = |step: f64| {
        let mut q = q.to_vec();
        free.iter().zip(hidden).for_each(|(&j, v)| q[j] += step * v * space.unit(j));
        q
    };
    [0.0].into_iter().chain(ALONG.iter().flat_map(|x| [*x, -x])).map(moved).collect()
}

/// The angle and the displacement between the hand and a pose, radians and metres.
pub fn gap(robot: &Robot<f64>, goal: Goal, wanted: &Transform<f64>, q: &[f64]) -> (f64, f64) {
    let have = robot.pose(q);
    let angle = match goal {
        Goal::Position => 0.0,
        Goal::PositionAndAxis => {
            let (a, b) = (have.rotation.z(), wanted.rotation.z());
            a.cross(b).norm().atan2(a.dot(b))
        }
        Goal::Pose => {
            let turn = rotation_error(goal, wanted, &have);
            let sine = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
            let (a, b) = (have.rotation, wanted.rotation);
            let trace = a.x().dot(b.x()) + a.y().dot(b.y()) + a.z().dot(b.z());
            sine.atan2((trace - 1.0) / 2.0)
        }
    };
    (angle, (have.translation - wanted.translation).norm())
}

/// What each joint is measured in: radians, slides in lengths of `size`.
fn units(robot: &Robot<f64>, size: f64) -> Vec<f64> {
    let mut units = vec![size; robot.joints];
    robot.links.iter().flat_map(|l| &l.theta.terms).for_each(|t| units[t.0] = 1.0);
    units
}

/// The derivative of the error's parts by the joint variables (slides in lengths of `size`), one column a joint; that of
/// given joints is 0.
pub(super) fn jacobian(
    robot: &Robot<f64>,
    goal: Goal,
    q: &[f64],
    given: &[usize],
    size: f64,
) -> Vec<[f64; 6]> {
    let hand = robot.pose(q);
    let tool = hand.rotation.z();
    let by_size = |([x, y, z, a, b, c], unit): ([f64; 6], f64)| {
        let by = unit / size;
        [a * unit, b * unit, c * unit, x * by, y * by, z * by]
    };
    let motions = velocity::of_tool(robot, q, hand.translation).into_iter().zip(units(robot, size));
    let mut columns: Vec<[f64; 6]> = motions.map(by_size).collect();
    for (j, c) in columns.iter_mut().enumerate() {
        if given.contains(&j) {
            *c = [0.0; 6];
        }
        let turn = Vector([c[0], c[1], c[2]]);
        let seen = match goal {
            Goal::Pose => turn,
            Goal::Position => Vector([0.0; 3]),
            // Turning about the tool's axis does not move it.
            Goal::PositionAndAxis => turn - tool.scale(tool.dot(turn)),
        };
        c[..3].copy_from_slice(&seen.0);
    }
    columns
}

/// The solution next to `q`, and its distance; nothing if there is none.
pub fn polish(
    robot: &Robot<f64>,
    goal: Goal,
    wanted: &Transform<f64>,
    q: &[f64],
    given: &[usize],
    size: f64,
) -> Option<(Vec<f64>, f64)> {
    let (mut at, mut best) = approach(robot, goal, wanted, q, given, size)?;
    let units = units(robot, size);
    // Where the hand hardly sees the joints move in one direction, the equations must not be squared, and a step in that
    // direction leaves the others to be corrected.
    let rank = q.len().min(6);
    let stepped = |at: &[f64], rank: usize, part: f64| -> Vec<f64> {
        let e = error(goal, wanted, &robot.pose(at), size);
        let step = svd(jacobian(robot, goal, at, given, size)).solve(&e, rank);
        at.iter().zip(&step).zip(&units).map(|((x, d), unit)| x + part * d * unit).collect()
    };
    for _ in 0..FINE {
        if best <= 1e-14 {
            break;
        }
        let nearer = [1.0, 0.5, 0.25].into_iter().find_map(|part| {
            let mut next = stepped(&at, rank, part);
            for _ in 0..2 {
                next = stepped(&next, rank - 1, 1.0);
            }
            let moved = distance(robot, goal, wanted, &next, size);
            (moved < 0.9 * best).then_some((next, moved))
        });
        let Some(nearer) = nearer else { break };
        (at, best) = nearer;
    }
    let by = |((x, y), unit): ((&f64, &f64), f64)| (x - y).abs() / unit;
    let far = q.iter().zip(&at).zip(units).map(by).fold(0.0, f64::max);
    (far <= FAR).then_some((at, best))
}

/// As near as Newton's method comes to a pose from `q`, and how near that is.
pub fn approach(
    robot: &Robot<f64>,
    goal: Goal,
    wanted: &Transform<f64>,
    q: &[f64],
    given: &[usize],
    size: f64,
) -> Option<(Vec<f64>, f64)> {
    walk((robot, goal, wanted), q, given, size, (1e-12, STEPS))
}

/// The same from far away, with steps that are held back until they lead nearer (Levenberg and Marquardt).
pub fn descend(
    robot: &Robot<f64>,
    goal: Goal,
    wanted: &Transform<f64>,
    q: &[f64],
    given: &[usize],
    size: f64,
) -> Option<(Vec<f64>, f64)> {
    walk((robot, goal, wanted), q, given, size, (1e-2, 2 * STEPS))
}

/// Newton's method with a damping to begin with and a number of steps.
fn walk(
    (robot, goal, wanted): (&Robot<f64>, Goal, &Transform<f64>),
    q: &[f64],
    given: &[usize],
    size: f64,
    (mut damping, steps): (f64, usize),
) -> Option<(Vec<f64>, f64)> {
    let mut at = q.to_vec();
    let mut best = distance(robot, goal, wanted, &at, size);
    let units = units(robot, size);
    for _ in 0..steps {
        if best <= 1e-14 {
            break;
        }
        let e = error(goal, wanted, &robot.pose(&at), size);
        let columns = jacobian(robot, goal, &at, given, size);
        let step = damped(&columns, &e, damping);
        let next: Vec<f64> = at.iter().zip(&step).zip(&units).map(|((x, d), unit)| x + d * unit).collect();
        let moved = distance(robot, goal, wanted, &next, size);
        if moved < best {
            (at, best) = (next, moved);
            damping = (damping * 0.1).max(1e-15);
        } else if damping > 1.0 {
            break;
        } else {
            damping *= 100.0;
        }
    }
    best.is_finite().then_some((at, best))
}

/// How many independent directions of what the goal gives the joints can move, at a configuration like any other.
pub fn rank(robot: &Robot<f64>, goal: Goal) -> usize {
    let mut random = Random(1);
    let reach = robot.reach();
    let size = if reach > 0.0 { reach } else { 1.0 };
    let of = |q: &[f64]| {
        let pivots = pivots(jacobian(robot, goal, q, &[], size));
        let least = 1e-7 * pivots.first().copied().unwrap_or(0.0);
        pivots.iter().take_while(|p| **p > least).count()
    };
    (0..5)
        .map(|_| of(&(0..robot.joints).map(|_| 6.0 * random.unit() - 3.0).collect::<Vec<_>>()))
        .max()
        .unwrap_or(0)
}

/// The lengths of columns, the longest first, each without its part along those before it: roughly the singular values.
fn pivots(mut columns: Vec<[f64; 6]>) -> Vec<f64> {
    let square = |c: &[f64; 6]| c.iter().map(|x| x * x).sum::<f64>();
    let mut found = vec![];
    while let Some(k) =
        (0..columns.len()).max_by(|&a, &b| square(&columns[a]).total_cmp(&square(&columns[b])))
    {
        let pivot = columns.swap_remove(k);
        let length = square(&pivot);
        found.push(length.sqrt());
        for c in columns.iter_mut().filter(|_| length > 0.0) {
            let along: f64 = c.iter().zip(&pivot).map(|(x, y)| x * y).sum::<f64>() / length;
            c.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= along * y);
        }
    }
    found
}

/// How much of the motion of joints the hand sees at least: the smallest singular value, roughly, of the joints that are not
/// given, of as many as there can be.
pub fn least_seen(robot: &Robot<f64>, goal: Goal, q: &[f64], given: &[usize], size: f64) -> f64 {
    let mut columns = jacobian(robot, goal, q, given, size).into_iter().enumerate().collect::<Vec<_>>();
    columns.retain(|(j, _)| !given.contains(j));
    let pivots = pivots(columns.into_iter().map(|c| c.1).collect());
    pivots.get(..pivots.len().min(6)).and_then(<[f64]>::last).copied().unwrap_or(f64::INFINITY)
}

/// The median of [`least_seen`] over configurations from all over the arm.
pub fn usually_seen(robot: &Robot<f64>, goal: Goal, space: &JointSpace) -> f64 {
    let mut random = Random(1);
    let size = space.length();
    let mut seen =
        [(); LOOKS].map(|()| least_seen(robot, goal, &space.anywhere(&mut random, size), &[], size));
    seen.sort_by(f64::total_cmp);
    seen[LOOKS / 2]
}

/// Moves along the solutions of a pose from one of them to where they are nearest to a configuration: each step is the
/// part of the way there that the hand does not see, then corrected. `given` joints stay; `way` says how configurations
/// differ.
pub fn slide(
    robot: &Robot<f64>,
    goal: Goal,
    wanted: &Transform<f64>,
    q: &[f64],
    (given, way): (&[usize], impl Fn(&[f64]) -> Vec<f64>),
    size: f64,
) -> Vec<f64> {
    const MOST: usize = 60;
    // Next to a singularity a family is one up to what solutions may miss.
    const MISSED: f64 = 1e-9;
    let units = units(robot, size);
    let scaled = |q: &[f64]| way(q).iter().zip(&units).map(|(x, unit)| x / unit).collect::<Vec<f64>>();
    let away = |q: &[f64]| scaled(q).iter().map(|x| x * x).sum::<f64>();
    let mut at = q.to_vec();
    let mut length = 1.0;
    for _ in 0..MOST {
        let columns = jacobian(robot, goal, &at, given, size);
        let mut there = scaled(&at);
        given.iter().for_each(|&j| there[j] = 0.0);
        let seen: [f64; 6] = std::array::from_fn(|i| columns.iter().zip(&there).map(|(c, x)| c[i] * x).sum());
        let back = damped(&columns, &seen, 1e-11);
        let step: Vec<f64> = there.iter().zip(&back).map(|(x, y)| length * (x - y)).collect();
        if step.iter().all(|x| x.abs() < 1e-10) {
            break;
        }
        let next: Vec<f64> = at.iter().zip(&step).zip(&units).map(|((x, d), unit)| x + d * unit).collect();
        match polish(robot, goal, wanted, &next, given, size) {
            Some((next, residual)) if residual <= MISSED && away(&next) < away(&at) => {
                at = next;
                length = (2.0 * length).min(1.0);
            }
            _ if length > 1e-4 => length *= 0.5,
            _ => break,
        }
    }
    at
}

/// x with (JᵀJ + λ)x = Jᵀe, by Gauss's elimination.
fn damped(columns: &[[f64; 6]], e: &[f64; 6], damping: f64) -> Vec<f64> {
    let n = columns.len();
    let dot = |a: &[f64; 6], b: &[f64; 6]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
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
        if m[k][k].abs() < f64::MIN_POSITIVE {
            continue;
        }
        for i in (0..n).filter(|&i| i != k) {
            let factor = m[i][k] / m[k][k];
            let row = m[k].clone();
            m[i].iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
        }
    }
    (0..n).map(|k| if m[k][k].abs() < f64::MIN_POSITIVE { 0.0 } else { m[k][n] / m[k][k] }).collect()
}
