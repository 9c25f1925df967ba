//! The grid, and the derivatives of the path there.

use crate::motion::MAX_SAMPLES;
use crate::motion::error::{MotionError, finite};
use crate::motion::path::{JointPath, PathPoint, Side};
use std::f64::consts::{FRAC_PI_2, PI};

/// No span between knots is divided into fewer intervals than this.
pub const MIN_INTERVALS: usize = 8;
/// A point at which a joint turns round is not added so near to another, as a part of the interval.
const SHORT: f64 = 1e-3;
/// A change of q' at a knot is a corner if it is more than this part of its greatest entry.
const CORNER: f64 = 1e-6;

/// The parameters at which speeds are computed.
#[derive(Clone, Debug, PartialEq)]
pub enum Grid {
    /// About so many intervals: the spans between knots of the path are divided evenly, each into [`MIN_INTERVALS`] at
    /// least.
    Uniform(usize),
    /// The same, but smaller towards the ends, as the parameters of a motion are that starts and ends at rest.
    Graded(usize),
    /// These parameters, from 0 to the end of the path, increasing. Corners of the path must be among them.
    Points(Vec<f64>),
}

/// Derivatives of the path at the grid points, approached from both sides.
pub(super) struct Sampled {
    pub(super) dof: usize,
    /// Parameters.
    pub(super) s: Vec<f64>,
    /// q', q'' and q''' when approached from behind: entry `i * dof + joint`.
    pub(super) behind: [Vec<f64>; 3],
    /// The same from before.
    pub(super) before: [Vec<f64>; 3],
    /// Grid points at which q' jumps.
    pub(super) corners: Vec<usize>,
}

/// The path at the points of a grid, to which those are added at which one of the joints `turning` turns round; not to a grid of given
/// points.
pub(super) fn sample<P: JointPath>(path: &P, grid: &Grid, turning: &[bool]) -> Result<Sampled, MotionError> {
    let (dof, end) = (path.dof(), path.end());
    finite("the end of the path", &[end])?;
    if dof == 0 || end <= 0.0 {
        return Err(MotionError::ZeroLength);
    }
    let mut s = points(path, grid)?;
    if !matches!(grid, Grid::Points(_)) {
        add_turns(path, turning, &mut s);
    }
    let mut point = PathPoint::zeros(dof);
    let mut behind: [Vec<f64>; 3] = std::array::from_fn(|_| Vec::with_capacity(s.len() * dof));
    for &s in &s {
        path.eval_into(s, Side::Behind, &mut point);
        for (list, derivative) in behind.iter_mut().zip([&point.dq, &point.ddq, &point.dddq]) {
            list.extend_from_slice(derivative);
        }
    }
    let mut before = behind.clone();
    let mut corners = vec![];
    let mut knots = path.knots().iter().peekable();
    for (i, &s) in s.iter().enumerate() {
        while knots.next_if(|k| **k < s).is_some() {}
        if knots.peek().is_some_and(|k| **k == s) {
            path.eval_into(s, Side::Before, &mut point);
            let entries = i * dof..(i + 1) * dof;
            for (list, derivative) in before.iter_mut().zip([&point.dq, &point.ddq, &point.dddq]) {
                list[entries.clone()].copy_from_slice(derivative);
            }
            if is_corner(&point.dq, &behind[0][entries]) {
                corners.push(i);
            }
        }
    }
    for list in behind.iter().chain(&before) {
        finite("derivatives of the path", list)?;
    }
    let mut sampled = Sampled { dof, s, behind, before, corners };
    if !path.has_third_derivative() {
        sampled.estimate_third();
    }
    Ok(sampled)
}

/// Adds the parameters at which joints turn round, one an interval and joint, found by halving.
fn add_turns<P: JointPath>(path: &P, turning: &[bool], points: &mut Vec<f64>) {
    let joints: Vec<usize> = (0..path.dof()).filter(|&j| turning.get(j) == Some(&true)).collect();
    if joints.is_empty() {
        return;
    }
    let mut point = PathPoint::zeros(path.dof());
    let mut tangent = |s: f64, side: Side| -> Vec<f64> {
        path.eval_into(s, side, &mut point);
        joints.iter().map(|&j| point.dq[j]).collect()
    };
    let mut added = vec![];
    for pair in points.windows(2) {
        let (first, last) = (tangent(pair[0], Side::Behind), tangent(pair[1], Side::Before));
        for k in (0..joints.len()).filter(|&k| first[k] * last[k] < 0.0) {
            let [mut from, mut to] = [pair[0], pair[1]];
            for _ in 0..60 {
                let middle = f64::midpoint(from, to);
                if tangent(middle, Side::Behind)[k] * first[k] > 0.0 {
                    from = middle;
                } else {
                    to = middle;
                }
            }
            // No interval is much shorter than the others.
            let least = SHORT * (pair[1] - pair[0]);
            if pair.iter().all(|s| (s - to).abs() > least) {
                added.push(to);
            }
        }
    }
    points.extend(added);
    points.sort_by(f64::total_cmp);
    points.dedup();
}

impl Sampled {
    /// q''' of each interval as the slope of q''.
    fn estimate_third(&mut self) {
        for i in 0..self.s.len() - 1 {
            for here in i * self.dof..(i + 1) * self.dof {
                let there = here + self.dof;
                let slope = (self.before[1][there] - self.behind[1][here]) / (self.s[i + 1] - self.s[i]);
                (self.behind[2][here], self.before[2][there]) = (slope, slope);
            }
        }
    }
}

/// Whether a tangent jumps.
pub(in crate::motion) fn is_corner(before: &[f64], behind: &[f64]) -> bool {
    let greatest = before.iter().chain(behind).fold(0.0f64, |m, x| m.max(x.abs()));
    before.iter().zip(behind).any(|(a, b)| (a - b).abs() > CORNER * greatest)
}

fn points<P: JointPath>(path: &P, grid: &Grid) -> Result<Vec<f64>, MotionError> {
    let end = path.end();
    match grid {
        Grid::Uniform(n) | Grid::Graded(n) if *n > MAX_SAMPLES => {
            Err(MotionError::TooMany("grid points", *n as f64))
        }
        Grid::Uniform(n) => divided(path.knots(), end, *n),
        Grid::Graded(n) => divided(path.knots(), end, *n).map(|points| graded(points, path.knots())),
        Grid::Points(points) => {
            const WHAT: &str = "grid points";
            finite(WHAT, points)?;
            let wrong = points.windows(2).position(|p| p[1] <= p[0]).map(|i| i + 1);
            let ends = points.first() == Some(&0.0) && points.last() == Some(&end);
            match wrong.or_else(|| (!ends || points.len() < 2).then_some(0)) {
                Some(i) => Err(MotionError::NotIncreasing(WHAT, i)),
                None => Ok(points.clone()),
            }
        }
    }
}

/// Points of even spans, those of the first and of the last span drawn towards the ends: as the square of the time from rest.
fn graded(mut points: Vec<f64>, knots: &[f64]) -> Vec<f64> {
    let last = points.len() - 1;
    let end = points[last];
    let (first_knot, last_knot) = (knots.first().copied(), knots.last().copied());
    for s in &mut points[1..last] {
        let drawn = match (first_knot, last_knot) {
            (Some(to), _) if *s < to => to * (1.0 - (FRAC_PI_2 * *s / to).cos()),
            (_, Some(from)) if *s > from => {
                end - (end - from) * (1.0 - (FRAC_PI_2 * (end - *s) / (end - from)).cos())
            }
            (None, None) => end * (1.0 - (PI * *s / end).cos()) / 2.0,
            _ => *s,
        };
        *s = drawn;
    }
    points
}

/// From 0 to `end` in about `n` intervals: each span between knots is divided evenly, by [`MIN_INTERVALS`] at least.
/// Refuses knots that are not between the ends and increasing.
pub(in crate::motion) fn divided(knots: &[f64], end: f64, n: usize) -> Result<Vec<f64>, MotionError> {
    const WHAT: &str = "knots of the path";
    let mut points = vec![0.0];
    let mut from = 0.0;
    for (index, &to) in knots.iter().chain([&end]).enumerate() {
        if to.is_nan() || to <= from {
            return Err(MotionError::NotIncreasing(WHAT, index));
        }
        let m = (n as f64 * ((to - from) / end).min(1.0)).round() as usize;
        let m = m.max(MIN_INTERVALS);
        points.extend((1..m).map(|i| from + (to - from) * i as f64 / m as f64));
        points.push(to);
        from = to;
    }
    // Between knots that are next to each other as numbers there is nothing.
    match points.windows(2).position(|p| p[1] <= p[0]) {
        Some(i) => Err(MotionError::NotIncreasing(WHAT, knots.partition_point(|k| *k < points[i]))),
        None => Ok(points),
    }
}
