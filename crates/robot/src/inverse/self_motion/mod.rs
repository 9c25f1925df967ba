//! Self-motions: curves in the space of the joints along which the hand stays where it is.
//!
//! A curve is followed by prediction along the null vector of the scaled Jacobian and correction by Newton's method
//! across it (Allgower and Georg, *Numerical Continuation Methods*, 1990, ch. 2). The correction leaves the smallest
//! singular direction alone, so that the same code serves arms with a joint too many and arms whose Jacobian is singular
//! all along a family of solutions.

mod continuum;
mod jacobian;

pub(in crate::inverse) use jacobian::Frame;

use super::derivation::Goal;
use super::newton;
use crate::geometry::Transform;
use crate::mechanism::Robot;
use crate::space::JointSpace;

/// The longest step, radians (slides: by the size of the arm), and the shortest.
const LONGEST: f64 = 0.08;
const SHORTEST: f64 = 1e-5;
/// How much the direction may turn within a step, radians.
const BEND: f64 = 0.2;
/// What rounding leaves of a miss.
const ROUNDING: f64 = 2e-15;
/// What the pose may be missed by.
const MISSED: f64 = 1e-12;
/// A second singular value below this: the null space has two dimensions.
const SINGULAR: f64 = 1e-4;
/// The most steps.
const STEPS: usize = 4000;
/// A curve whose direction stays within this is a straight line.
const STRAIGHT: f64 = 1e-7;

/// What a straight line may miss the pose by far from where it was followed.
const ON_LINE: f64 = 1e-9;

/// How a self-motion ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum CurveEnd {
    /// Back at its start, but for whole turns.
    Closed,
    /// A slide is at its limit, or further out than the arm is long.
    Range,
    /// At a point where the arm can move in two directions: curves meet there.
    Singular,
    /// No step leads on: the configuration was not on a curve, or the curve ends in rounding.
    Lost,
    /// The bound on steps was reached.
    Long,
}

/// A curve of configurations with the hand at one pose.
#[derive(Clone, PartialEq, Debug)]
pub struct SelfMotion {
    /// Members, neighbours next to each other (0.1 rad apart at most) and without jumps of whole turns; the first again
    /// at the end, but for whole turns, if it is closed.
    pub curve: Vec<Vec<f64>>,
    /// How it ends, backward and forward; twice the same if it is closed.
    pub ends: [CurveEnd; 2],
    /// The direction at the configuration that it was started from, a unit vector.
    pub direction: Vec<f64>,
    /// True if the joints move in these proportions everywhere.
    pub is_affine: bool,
}

impl SelfMotion {
    /// True if it comes back to its start.
    pub fn is_closed(&self) -> bool {
        self.ends == [CurveEnd::Closed; 2]
    }
}

/// The arm, and the pose that is held.
#[derive(Clone, Copy, Debug)]
pub(in crate::inverse) struct Tracker<'a> {
    pub frame: Frame<'a>,
    pub space: &'a JointSpace,
    pub pose: &'a Transform<f64>,
    /// What members may miss the pose by.
    pub missed: f64,
}

/// The self-motion through a configuration that has this pose (of the tool in the base).
///
/// # Panics
/// If there is not one entry per joint.
pub fn follow(
    robot: &Robot<f64>,
    space: &JointSpace,
    goal: Goal,
    pose: &Transform<f64>,
    q: &[f64],
) -> SelfMotion {
    Tracker::new(robot, space, goal, pose).follow(q)
}

/// The direction (radians and metres, a unit vector) in which the arm can move at a configuration with its hand still;
/// nothing if solutions are isolated there, even where several coincide.
///
/// # Panics
/// If there is not one entry per joint.
pub fn is_self_motion(robot: &Robot<f64>, space: &JointSpace, goal: Goal, q: &[f64]) -> Option<Vec<f64>> {
    let pose = robot.pose(q);
    let tracker = Tracker::new(robot, space, goal, &pose);
    let direction = continuum::direction(&tracker, q)?;
    Some(tracker.in_joints(&direction))
}

/// The self-motion through a configuration that has this pose; nothing if solutions are isolated there.
pub(super) fn self_motion(
    robot: &Robot<f64>,
    space: &JointSpace,
    goal: Goal,
    pose: &Transform<f64>,
    q: &[f64],
) -> Option<SelfMotion> {
    is_self_motion(robot, space, goal, q)?;
    Some(follow(robot, space, goal, pose, q))
}

/// The same as [`follow`] for members that miss the pose by up to `missed`: next to a singularity, what is a curve there is nearly one.
pub(super) fn follow_loosely(
    (robot, space, goal): (&Robot<f64>, &JointSpace, Goal),
    pose: &Transform<f64>,
    q: &[f64],
    missed: f64,
) -> SelfMotion {
    Tracker { missed, ..Tracker::new(robot, space, goal, pose) }.follow(q)
}

impl<'a> Tracker<'a> {
    pub fn new(robot: &'a Robot<f64>, space: &'a JointSpace, goal: Goal, pose: &'a Transform<f64>) -> Self {
        let size = space.length();
        Tracker { frame: Frame { robot, goal, is_angle: &space.is_angle, size }, space, pose, missed: MISSED }
    }

    /// A direction in radians and metres, normalised.
    fn in_joints(&self, direction: &[f64]) -> Vec<f64> {
        let v: Vec<f64> = direction.iter().enumerate().map(|(j, x)| x * self.frame.unit(j)).collect();
        let by = length(&v);
        v.iter().map(|x| x / by).collect()
    }

    /// The nearest configuration with the pose across the last n − `rank` singular directions, and what it misses.
    pub fn corrected(&self, q: &[f64], rank: usize) -> (Vec<f64>, f64) {
        let Frame { robot, goal, size, .. } = self.frame;
        let mut at = q.to_vec();
        let mut best = newton::distance(robot, goal, self.pose, &at, size);
        for _ in 0..12 {
            if best <= ROUNDING {
                break;
            }
            let step = self.frame.step(&at, &self.frame.error(self.pose, &at), rank);
            let next: Vec<f64> = (0..at.len()).map(|j| at[j] + step[j] * self.frame.unit(j)).collect();
            let missed = newton::distance(robot, goal, self.pose, &next, size);
            if missed.is_nan() || missed >= best {
                break;
            }
            (at, best) = (next, missed);
        }
        (at, best)
    }

    /// The self-motion through a configuration.
    pub fn follow(&self, q: &[f64]) -> SelfMotion {
        let n = q.len();
        let (start, _) = self.corrected(q, n - 1);
        let singular = self.frame.singular(&start);
        let tangent = singular.vectors.last().cloned().unwrap_or_default();
        let direction = self.in_joints(&tangent);
        let second = if n > 1 { singular.values[n - 2] } else { 1.0 };
        let (forward, end) = self.run(&start, &tangent, second);
        if end == CurveEnd::Closed {
            let is_affine = self.is_straight(&forward);
            return self.whole_line(SelfMotion { curve: forward, ends: [end; 2], direction, is_affine });
        }
        let back: Vec<f64> = tangent.iter().map(|x| -x).collect();
        let (mut curve, first) = self.run(&start, &back, second);
        curve.reverse();
        curve.extend(forward.into_iter().skip(1));
        let is_affine = self.is_straight(&curve);
        self.whole_line(SelfMotion { curve, ends: [first, end], direction, is_affine })
    }

    /// The pose is an analytic function along a line: where it is constant on a part, it is constant on all of the line, past
    /// the points where other curves meet it, once round.
    fn whole_line(&self, motion: SelfMotion) -> SelfMotion {
        let d = &motion.direction;
        let periods = &self.space.turning.periods;
        let moving: Vec<usize> = (0..d.len()).filter(|&j| d[j].abs() > STRAIGHT).collect();
        let turns_alone = moving.iter().all(|&j| periods[j].is_finite());
        let lead = moving.iter().copied().max_by(|&a, &b| d[a].abs().total_cmp(&d[b].abs()));
        let (Some(lead), true, true) = (lead, motion.is_affine, turns_alone) else { return motion };
        let start = &motion.curve[0];
        let line = |length: f64| -> Vec<Vec<f64>> {
            let parts = (length / LONGEST).ceil();
            let at =
                |k: f64| (0..d.len()).map(|j| start[j] + k / parts * length * d[j] / d[lead].abs()).collect();
            (0..=parts as usize).map(|k| at(k as f64)).collect()
        };
        let Frame { robot, goal, size, .. } = self.frame;
        let misses =
            |q: &Vec<f64>| newton::distance(robot, goal, self.pose, q, size) > self.missed.max(ON_LINE);
        // What is followed within rounding and leaves the pose further out is no line: of an arm that is nearly special, say.
        if line(periods[lead]).iter().any(misses) {
            return SelfMotion { is_affine: false, ..motion };
        }
        // All joints are back where they were after some turns of the one that moves most.
        let is_back = |k: &f64| {
            moving.iter().all(|&j| {
                let turns = k * periods[lead] * d[j] / (d[lead] * periods[j]);
                (turns - turns.round()).abs() < 1e-6
            })
        };
        let length = [1.0, 2.0, 3.0, 4.0, 6.0].iter().find(|k| is_back(k)).map(|k| k * periods[lead]);
        match length.map(line).filter(|curve| !motion.is_closed() && !curve.iter().any(misses)) {
            Some(curve) => SelfMotion { curve, ends: [CurveEnd::Closed; 2], ..motion },
            None => motion,
        }
    }

    /// The curve in one direction; `second` is the smallest singular value at its start but one.
    fn run(&self, start: &[f64], tangent: &[f64], mut second: f64) -> (Vec<Vec<f64>>, CurveEnd) {
        let n = start.len();
        let mut curve = vec![start.to_vec()];
        let (mut at, mut along) = (start.to_vec(), tangent.to_vec());
        let mut step = LONGEST / 4.0;
        let mut travelled = 0.0;
        for _ in 0..STEPS {
            if second <= SINGULAR {
                return (curve, CurveEnd::Singular);
            }
            // Toward a point where curves meet, the steps become shorter.
            step = step.min(LONGEST).min(2.0 * second).max(SHORTEST);
            let (next, turned, width) = loop {
                match self.stepped(&at, &along, step) {
                    Some(found) => break found,
                    None if step <= SHORTEST => return (curve, CurveEnd::Lost),
                    None => step = (step / 2.0).max(SHORTEST),
                }
            };
            if let Some(j) = (0..n).find(|&j| self.is_outside(j, next[j])) {
                self.end_at_limit(&mut curve, &at, &next, j);
                return (curve, CurveEnd::Range);
            }
            if travelled > 2.0 * step && self.passes(&at, &next, start, step) {
                let mut last = start.to_vec();
                for (j, way) in self.space.moved(&at, start).into_iter().enumerate() {
                    last[j] = at[j] + way;
                }
                curve.push(last);
                return (curve, CurveEnd::Closed);
            }
            travelled += step;
            step *= 1.5;
            curve.push(next.clone());
            (at, along, second) = (next, turned, width);
        }
        (curve, CurveEnd::Long)
    }

    /// A step along the curve, the direction there, and the smallest singular value but one.
    fn stepped(&self, at: &[f64], along: &[f64], step: f64) -> Option<(Vec<f64>, Vec<f64>, f64)> {
        let n = at.len();
        let predicted = continuum::stepped(&self.frame, at, along, step);
        let (next, missed) = self.corrected(&predicted, n - 1);
        let mut singular = self.frame.singular(&next);
        let mut turned = singular.vectors.pop()?;
        let second = if n > 1 { singular.values[n - 2] } else { 1.0 };
        let cosine: f64 = turned.iter().zip(along).map(|(x, y)| x * y).sum();
        if cosine < 0.0 {
            turned.iter_mut().for_each(|x| *x = -*x);
        }
        let moved = self.scaled(at, &next);
        let ahead: f64 = moved.iter().zip(along).map(|(x, y)| x * y).sum();
        let largest = moved.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let good =
            missed <= self.missed && cosine.abs() >= BEND.cos() && ahead > 0.5 * step && largest <= 0.1;
        good.then_some((next, turned, second))
    }

    /// The way between two configurations in the units of the frame, without whole turns.
    fn scaled(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        (0..from.len()).map(|j| (to[j] - from[j]) / self.frame.unit(j)).collect()
    }

    /// True if the start lies on the way between two neighbours, but for whole turns.
    fn passes(&self, at: &[f64], next: &[f64], start: &[f64], step: f64) -> bool {
        let chord = self.scaled(at, next);
        let moved = self.space.moved(at, start);
        let to_start: Vec<f64> = (0..at.len()).map(|j| moved[j] / self.frame.unit(j)).collect();
        let square: f64 = chord.iter().map(|x| x * x).sum();
        let part = chord.iter().zip(&to_start).map(|(x, y)| x * y).sum::<f64>() / square;
        if !(0.0..=1.0).contains(&part) {
            return false;
        }
        let off: Vec<f64> = to_start.iter().zip(&chord).map(|(x, c)| x - part * c).collect();
        // A chord is off its curve by an eighth of the angle that it bends by.
        length(&off) <= BEND * step
    }

    fn is_outside(&self, joint: usize, x: f64) -> bool {
        let [low, high] = self.slide(joint);
        !self.space.is_angle[joint] && !(low..=high).contains(&x)
    }

    fn slide(&self, joint: usize) -> [f64; 2] {
        let far = 2.0 * self.frame.size;
        self.space.limits[joint].unwrap_or([-far, far])
    }

    /// Adds the member between two at which a slide is at its limit.
    fn end_at_limit(&self, curve: &mut Vec<Vec<f64>>, at: &[f64], next: &[f64], joint: usize) {
        let [low, high] = self.slide(joint);
        let limit = if next[joint] > high { high } else { low };
        let mut last = at.to_vec();
        let mut step = next[joint] - at[joint];
        for _ in 0..20 {
            if step.abs() < f64::MIN_POSITIVE || (limit - last[joint]).abs() <= 1e-13 * self.frame.size {
                break;
            }
            let part = (limit - last[joint]) / step;
            let guess: Vec<f64> = (0..at.len()).map(|j| last[j] + part * (next[j] - at[j])).collect();
            let (found, missed) = self.corrected(&guess, at.len() - 1);
            if missed > self.missed {
                break;
            }
            step = next[joint] - at[joint];
            last = found;
        }
        curve.push(last);
    }

    /// True if the direction stays the same.
    fn is_straight(&self, curve: &[Vec<f64>]) -> bool {
        let Some((first, last)) = curve.first().zip(curve.last()) else { return false };
        let whole = self.scaled(first, last);
        let by = length(&whole);
        by > 0.1
            && curve.iter().all(|q| {
                let part = self.scaled(first, q);
                let along: f64 = part.iter().zip(&whole).map(|(x, y)| x * y).sum::<f64>() / by;
                let off = part.iter().zip(&whole).map(|(x, w)| (x - along * w / by).powi(2)).sum::<f64>();
                off.sqrt() <= STRAIGHT * by.max(1.0)
            })
    }
}

fn length(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
