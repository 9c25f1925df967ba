//! Redundant arms without a closed form: configurations by elimination at values of an end joint (or by Newton's method
//! from many starts, where that does not serve the arm), and from each the curve that it lies on.

use super::feasible::{self, Point};
use super::joint::radical;
use super::limits::{Range, SLACK, excess};
use super::locked::Locked;
use super::manifold::{Chart, Found, Piece};
use crate::geometry::Transform;
use crate::inverse::branch::Branch;
use crate::inverse::derivation::Goal;
use crate::inverse::newton;
use crate::inverse::self_motion::{CurveEnd, Tracker};
use crate::mechanism::Robot;
use crate::space::JointSpace;

/// Values of the joint that is held.
const VALUES: usize = 24;
/// Starts of Newton's method.
const STARTS: usize = 60;
const BASES: [usize; 10] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29];
/// A configuration is a solution up to this residual.
const SOLVED: f64 = 1e-10;
/// A configuration this near to a curve lies on it: members are up to 0.1 apart.
const ON: f64 = 0.02;

/// The solver by following curves.
#[derive(Clone, Debug)]
pub(super) struct ByCurve {
    robot: Robot<f64>,
    goal: Goal,
    space: JointSpace,
    ranges: Vec<Range>,
    locked: Option<Box<Locked>>,
}

impl ByCurve {
    pub fn new(robot: &Robot<f64>, goal: Goal, space: &JointSpace) -> Self {
        let locked = if goal == Goal::Pose { Locked::new(robot, space).map(Box::new) } else { None };
        ByCurve { robot: robot.clone(), goal, space: space.clone(), ranges: Range::all(space), locked }
    }

    /// True if configurations come from elimination.
    pub fn is_systematic(&self) -> bool {
        self.locked.is_some()
    }

    fn tracker<'a>(&'a self, pose: &'a Transform<f64>) -> Tracker<'a> {
        Tracker::new(&self.robot, &self.space, self.goal, pose)
    }

    /// The `number`th group of configurations of a pose; nothing after the last.
    fn starts(&self, pose: &Transform<f64>, number: usize) -> Option<Vec<Vec<f64>>> {
        if let Some(locked) = &self.locked {
            let [low, high] = locked.span(&self.space);
            let value = low + (high - low) * radical(number + 1, 2);
            return (number < VALUES).then(|| locked.configurations(pose, value).0);
        }
        if number >= STARTS {
            return None;
        }
        let q = self.somewhere(number);
        let size = self.space.size(pose);
        let found = newton::approach(&self.robot, self.goal, pose, &q, &[], size);
        Some(found.filter(|f| f.1 <= SOLVED).map(|f| f.0).into_iter().collect())
    }

    /// A configuration, within the limits where there are any; different ones all over the arm.
    fn somewhere(&self, number: usize) -> Vec<f64> {
        let value = |j: usize| {
            let far = self.space.half_range(j);
            let [low, high] = self.ranges[j].ends().unwrap_or([-far, far]);
            low + (high - low) * radical(number + 1, BASES[j % BASES.len()])
        };
        (0..self.robot.joints).map(value).collect()
    }

    /// One within the limits, the first that is met; with a seed, the nearest on its own curve.
    pub fn within(&self, pose: &Transform<f64>, seed: Option<&[f64]>) -> Option<Found> {
        if let Some(seed) = seed {
            let size = self.space.size(pose);
            let near = newton::approach(&self.robot, self.goal, pose, seed, &[], size);
            if let Some((q, residual)) = near
                && residual <= SOLVED
                && excess(&self.ranges, &q) <= SLACK
            {
                return Some(plain(q));
            }
        }
        let mut curves: Vec<Piece> = vec![];
        for number in 0.. {
            let Some(starts) = self.starts(pose, number) else { break };
            if let Some(q) = starts.iter().find(|q| excess(&self.ranges, q) <= SLACK) {
                return Some(plain(q.clone()));
            }
            // Elimination is cheaper than a curve: all values first.
            if self.is_systematic() {
                continue;
            }
            for q in starts {
                if self.is_on(&curves, &q) {
                    continue;
                }
                let c = self.piece(pose, &q);
                if let Some([low, high]) = c.feasible.first() {
                    return self.member(pose, &c.chart, (low + high) / 2.0).map(plain);
                }
                curves.push(c);
            }
        }
        if !self.is_systematic() {
            return None;
        }
        self.pieces(pose).iter().find_map(|c| {
            let [low, high] = c.feasible.first()?;
            self.member(pose, &c.chart, (low + high) / 2.0).map(plain)
        })
    }

    /// All curves that are met.
    pub fn pieces(&self, pose: &Transform<f64>) -> Vec<Piece> {
        let mut found: Vec<Piece> = vec![];
        for number in 0.. {
            let Some(starts) = self.starts(pose, number) else { break };
            for q in starts {
                if !self.is_on(&found, &q) {
                    found.push(self.piece(pose, &q));
                }
            }
        }
        found
    }

    /// True if a configuration lies on one of the curves.
    fn is_on(&self, curves: &[Piece], q: &[f64]) -> bool {
        let near = |members: &[Vec<f64>]| {
            members.windows(2).any(|w| {
                let moved = self.space.way(&w[0], q);
                let chord = self.space.way(&w[0], &w[1]);
                let square: f64 = chord.iter().map(|x| x * x).sum();
                let along: f64 = moved.iter().zip(&chord).map(|(x, y)| x * y).sum();
                let part = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
                moved.iter().zip(&chord).all(|(x, c)| (x - part * c).abs() <= ON)
            })
        };
        curves.iter().any(|c| matches!(&c.chart, Chart::Curve { members, .. } if near(members)))
    }

    /// The curve through a configuration.
    fn piece(&self, pose: &Transform<f64>, q: &[f64]) -> Piece {
        let tracker = self.tracker(pose);
        let curve = tracker.follow(q);
        let mut lengths = vec![0.0];
        for w in curve.curve.windows(2) {
            let step = (0..q.len()).map(|j| ((w[1][j] - w[0][j]) / tracker.frame.unit(j)).powi(2));
            lengths.push(lengths[lengths.len() - 1] + step.sum::<f64>().sqrt());
        }
        let whole = lengths[lengths.len() - 1];
        let points: Vec<Point> =
            lengths.iter().zip(&curve.curve).map(|(&s, q)| (s, excess(&self.ranges, q))).collect();
        let is_closed = curve.ends == [CurveEnd::Closed; 2];
        let chart = Chart::Curve { members: curve.curve, lengths };
        let mut parts = feasible::intervals(&points, |s| {
            let q = self.member(pose, &chart, s)?;
            Some(excess(&self.ranges, &q))
        });
        if is_closed && parts.len() > 1 && parts[0][0] == 0.0 && parts[parts.len() - 1][1] == whole {
            let [_, end] = parts.remove(0);
            if let Some(last) = parts.last_mut() {
                last[1] = whole + end;
            }
        }
        Piece {
            branch: Branch::default(),
            parameter: "s".into(),
            domain: [0.0, whole],
            feasible: parts,
            is_closed,
            chart,
        }
    }

    /// The member of a curve at a length along it.
    pub fn member(&self, pose: &Transform<f64>, chart: &Chart, s: f64) -> Option<Vec<f64>> {
        let Chart::Curve { members, lengths } = chart else { return None };
        let whole = *lengths.last()?;
        let s = if s > whole { s - whole } else { s };
        let k = lengths.partition_point(|&l| l <= s).clamp(1, lengths.len().max(2) - 1);
        let (before, after) = (members.get(k - 1)?, members.get(k)?);
        let part = (s - lengths[k - 1]) / (lengths[k] - lengths[k - 1]).max(f64::MIN_POSITIVE);
        let guess: Vec<f64> = before.iter().zip(after).map(|(x, y)| x + part * (y - x)).collect();
        let (q, missed) = self.tracker(pose).corrected(&guess, guess.len() - 1);
        (missed <= SOLVED).then_some(q)
    }
}

fn plain(q: Vec<f64>) -> Found {
    Found { q, guard: None, branch: Branch::default() }
}
