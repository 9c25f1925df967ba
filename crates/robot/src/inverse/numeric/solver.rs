//! The search: starts in order of promise, the first descent that meets the hard tasks wins; or the best bottom.

use super::descent::{Ended, Problem};
use super::freedom::Wishes;
use super::limits::Limits;
use super::motion::{Motion, Point};
use super::outcome::{NumericOptions, Outcome, Status};
use super::polish::polish;
use super::reach::Reach;
use super::step::Stepper;
use super::task::{Frame, Level, Place, Preference, Residual, Shape, Task};
use crate::description::Description;
use crate::geometry::Transform;
use crate::inverse::derivation::Goal;
use crate::mechanism::{MissingValue, Robot};
use crate::shared::{Lent, Shared};
use crate::space::JointSpace;
use std::num::NonZero;
use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// Starts whose frames are known, so that those near the target come first.
const KNOWN: usize = 256;
/// Steps after which a descent must have come down fourfold. A configuration that the caller gives is worth more
/// patience, and so are starts when many have failed.
const PATIENCE: usize = 4;
const PATIENCE_WITH_SEED: usize = 8;
const MOST_PATIENCE: usize = 12;
/// Starts after which patience grows by one.
const FAILURES: usize = 16;
/// Starts that a target which is proved to be out of reach gets, if the nearest configuration is not asked for.
const STARTS_BEYOND_REACH: usize = 32;
/// Descents that are led to the bottom when none solves, and by how many the lowest must be found.
const BOTTOMS: usize = 48;
const AGREEING: usize = 3;
/// Starts that it takes to call a target unreachable without proof.
const STARTS_FOR_UNREACHABLE: usize = 64;
/// Errors, radians and lengths of the arm, that are the same.
const SAME: f64 = 1e-6;

/// Finds joint variables by descent. What it finds does not depend on earlier calls.
#[derive(Clone, Debug)]
pub struct NumericSolver {
    /// How long and how well to search.
    pub options: NumericOptions,
    memory: Shared<Memory>,
    /// For each task whether it is hard.
    is_hard: Vec<bool>,
    reaches: Arc<[Reach]>,
    /// Configurations to start from, and the frames of the hard tasks there.
    starts: Arc<[(Vec<f64>, Vec<Place>)]>,
}

/// What descents work on, and in.
#[derive(Clone, Debug)]
struct Memory {
    hard: Problem,
    wishes: Wishes,
}

/// A solver at work on targets.
struct Search<'a> {
    solver: &'a NumericSolver,
    memory: Lent<'a, Memory>,
}

impl Deref for Search<'_> {
    type Target = NumericSolver;

    fn deref(&self) -> &NumericSolver {
        self.solver
    }
}

/// A configuration where a descent gave up.
struct Candidate {
    cost: f64,
    q: Vec<f64>,
}

impl NumericSolver {
    /// A solver for the pose of the tool, or of what `goal` says of it.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn new(description: &Description, goal: Goal) -> Result<Self, MissingValue> {
        Self::with_tasks(description, &[Task::hard(Frame::Tool, goal.into())], &[])
    }

    /// A solver for several tasks. If none is hard, all are.
    ///
    /// # Errors
    /// If a parameter has no value.
    ///
    /// # Panics
    /// If a posture has not one value per joint.
    pub fn with_tasks(
        description: &Description,
        tasks: &[Task],
        preferences: &[Preference],
    ) -> Result<Self, MissingValue> {
        let robot = Robot::numeric(description)?;
        let reach = robot.reach();
        let travel = |[l, h]: [f64; 2]| if (h - l).is_finite() { (h - l).max(0.0) } else { 0.0 };
        let space = JointSpace::new(description, &robot);
        let slides = space.limits.iter().zip(&space.is_angle).filter(|s| !s.1);
        let size = reach + slides.filter_map(|s| s.0.map(travel)).sum::<f64>();
        let space = JointSpace { reach: if size > 0.0 { size } else { 1.0 }, ..space };
        for preference in preferences {
            if let Preference::Posture { near, .. } = preference {
                assert_eq!(near.len(), robot.joints, "one value per joint");
            }
        }

        let none_hard = tasks.iter().all(|t| t.level == Level::Soft);
        let is_hard: Vec<bool> = tasks.iter().map(|t| none_hard || t.level == Level::Hard).collect();
        let part = |hard: bool| -> (Vec<Frame>, Vec<Shape>) {
            let chosen = || tasks.iter().zip(&is_hard).filter(|t| *t.1 == hard).map(|t| t.0);
            // Among hard tasks proportions matter; the smallest weight is 1, as tolerances have it.
            let least = chosen().map(|t| t.weight).filter(|w| *w > 0.0).fold(f64::INFINITY, f64::min);
            let unit = if hard && least.is_finite() { least } else { 1.0 };
            let scaled = |t: &Task| Task { weight: t.weight / unit, ..*t };
            chosen().map(|t| (t.frame, Shape::new(&scaled(t), space.reach))).unzip()
        };
        let ((frames, shapes), (soft_frames, soft_shapes)) = (part(true), part(false));
        let limits = Limits::new(&space);
        let mut motion = Motion::new(description, &robot, &space, &frames)?;
        let wishes = Wishes {
            motion: Motion::new(description, &robot, &space, &soft_frames)?,
            shapes: soft_shapes,
            preferences: preferences.to_vec(),
        };
        let start = |k: usize| {
            let mut q = vec![];
            limits.start(k as u64, &mut q);
            let places = motion.places(&q);
            (q, places)
        };
        let starts = (0..KNOWN).map(start).collect();
        let reaches = frames.iter().map(|&f| Reach::new(&robot, &limits, f)).collect();
        let options = NumericOptions::default();
        let tolerance = [options.angle, options.distance];
        let hard =
            Problem { motion, shapes, limits, size: space.reach, tolerance, stepper: Stepper::default() };
        let memory = Shared::new(Memory { hard, wishes });
        Ok(NumericSolver { options, memory, is_hard, reaches, starts })
    }

    /// A configuration for a pose: of all solutions the one that descents find first, from `seed` if there is one. If
    /// there is none, the configuration with the smallest error that was found.
    ///
    /// # Panics
    /// If there is not one task, or `seed` has not one value per joint.
    pub fn solve(&self, pose: &Transform<f64>, seed: Option<&[f64]>) -> Outcome {
        self.solve_tasks(std::slice::from_ref(pose), seed)
    }

    /// The configuration nearest to a pose, in the sense of the least sum of squares of the missing rotation (radians)
    /// and displacement (by the arm's size), as far as starts tell. A pose that can be reached is.
    ///
    /// # Panics
    /// As [`NumericSolver::solve`].
    pub fn nearest(&self, pose: &Transform<f64>, from: Option<&[f64]>) -> Outcome {
        self.search().run(std::slice::from_ref(pose), from, true)
    }

    /// A configuration for targets, one for each task.
    ///
    /// # Panics
    /// If there is not one target per task, or `seed` has not one value per joint.
    pub fn solve_tasks(&self, targets: &[Transform<f64>], seed: Option<&[f64]>) -> Outcome {
        self.search().run(targets, seed, false)
    }

    /// [`NumericSolver::solve`] for many poses, on all cores or as many threads as `threads` says. Each outcome is that
    /// of its pose alone.
    ///
    /// # Panics
    /// If there is not one task.
    pub fn solve_batch(&self, poses: &[Transform<f64>], threads: Option<NonZero<usize>>) -> Vec<Outcome> {
        let cores = || std::thread::available_parallelism().map_or(1, NonZero::get);
        let threads = threads.map_or_else(cores, NonZero::get).min(poses.len()).max(1);
        let share = poses.len().div_ceil(threads).max(1);
        let mut outcomes: Vec<Option<Outcome>> = vec![None; poses.len()];
        std::thread::scope(|scope| {
            for (poses, outcomes) in poses.chunks(share).zip(outcomes.chunks_mut(share)) {
                let work = move || {
                    for (pose, outcome) in poses.iter().zip(outcomes) {
                        *outcome = Some(self.solve(pose, None));
                    }
                };
                if threads == 1 {
                    work();
                } else {
                    scope.spawn(work);
                }
            }
        });
        outcomes.into_iter().flatten().collect()
    }

    /// The arm's size, by which distances are compared with angles, metres.
    pub fn size(&self) -> f64 {
        self.memory.first().hard.size
    }

    fn search(&self) -> Search<'_> {
        Search { solver: self, memory: self.memory.lend() }
    }
}

impl Search<'_> {
    fn run(&mut self, targets: &[Transform<f64>], seed: Option<&[f64]>, is_thorough: bool) -> Outcome {
        assert_eq!(targets.len(), self.is_hard.len(), "one target per task");
        assert!(seed.is_none_or(|q| q.len() == self.memory.hard.motion.joints), "one value per joint");
        self.memory.hard.tolerance = [self.solver.options.angle, self.solver.options.distance];
        let part = |hard: bool| -> Vec<Place> {
            targets.iter().zip(&self.is_hard).filter(|t| *t.1 == hard).map(|t| t.0.into()).collect()
        };
        let (targets, soft) = (part(true), part(false));
        let posture = self.memory.wishes.preferences.iter().find_map(|p| match p {
            Preference::Posture { near, .. } => Some(near.clone()),
            Preference::MiddleOfLimits { .. } => None,
        });
        let near: Option<Vec<f64>> = seed.map(<[f64]>::to_vec).or(posture);

        let beyond_reach = self.beyond_reach(&targets);
        let mut most_starts = self.options.max_restarts.saturating_add(1);
        if beyond_reach.is_some() && !is_thorough {
            most_starts = most_starts.min(STARTS_BEYOND_REACH);
        }
        let mut found = Found { candidates: vec![], starts: 0, steps: 0, stopped: false };
        let solution = self.descents(&targets, near.as_deref(), most_starts, &mut found);
        let (mut q, bottom) = match solution {
            Some(q) => (q, Bottom::Met),
            None => self.lowest(&targets, &mut found, if is_thorough { BOTTOMS } else { AGREEING }),
        };
        let is_solved = bottom == Bottom::Met;
        let agreeing = if let Bottom::Above(n) = bottom { n } else { 0 };
        self.memory.hard.limits.settle(&mut q, near.as_deref());
        if is_solved && !self.memory.wishes.is_empty() {
            let Memory { hard, wishes } = &mut *self.memory;
            wishes.follow(hard, &targets, &soft, &mut q);
            hard.limits.settle(&mut q, near.as_deref());
        }
        let status = if is_solved {
            Status::Solved
        } else if beyond_reach.is_some() {
            Status::Unreachable
        } else if found.stopped {
            Status::Stopped
        } else if found.starts >= STARTS_FOR_UNREACHABLE && agreeing >= AGREEING {
            Status::Unreachable
        } else {
            Status::LocalMinimum
        };
        let restarts = found.starts.saturating_sub(1);
        let residuals = self.residuals(&targets, &soft, &q);
        Outcome { q, residuals, status, beyond_reach, restarts, iterations: found.steps, agreeing }
    }

    /// Descents from start to start until one meets the hard tasks.
    fn descents(
        &mut self,
        targets: &[Place],
        seed: Option<&[f64]>,
        most_starts: usize,
        found: &mut Found,
    ) -> Option<Vec<f64>> {
        let mut point = Point::default();
        let mut order: Vec<(f64, usize)> = vec![];
        for number in 0..most_starts {
            if found.steps >= self.options.max_iterations {
                break;
            }
            if self.options.stop.as_ref().is_some_and(|s| s.load(Ordering::Relaxed)) {
                found.stopped = true;
                break;
            }
            let mut patience = (PATIENCE + number / FAILURES).min(MOST_PATIENCE);
            let after_seed = number - usize::from(seed.is_some() && number > 0);
            match seed {
                Some(q) if number == 0 => {
                    point.q.clear();
                    point.q.extend_from_slice(q);
                    self.memory.hard.limits.admit(&mut point.q);
                    patience = PATIENCE_WITH_SEED;
                }
                _ => self.start(targets, after_seed, &mut order, &mut point.q),
            }
            found.starts += 1;
            let most = self.options.max_iterations;
            if self.memory.hard.descend(targets, &mut point, patience, &mut found.steps, most) == Ended::Met {
                return Some(point.q);
            }
            found.candidates.push(Candidate { cost: point.cost, q: point.q.clone() });
        }
        None
    }

    /// Start `number` for these targets: those whose frames are known in order of their distance, then others.
    fn start(&self, targets: &[Place], number: usize, order: &mut Vec<(f64, usize)>, q: &mut Vec<f64>) {
        if number >= self.starts.len() {
            return self.memory.hard.limits.start(number as u64, q);
        }
        if order.is_empty() {
            let apart = |places: &[Place]| -> f64 {
                let tasks = self.memory.hard.shapes.iter().zip(places).zip(targets);
                tasks.map(|((shape, at), target)| shape.apart(at, target)).sum()
            };
            order.extend(self.starts.iter().enumerate().map(|(k, s)| (apart(&s.1), k)));
        }
        let rest = &mut order[number..];
        let nearest = rest.iter().enumerate().min_by(|a, b| a.1.0.total_cmp(&b.1.0)).map_or(0, |n| n.0);
        rest.swap(0, nearest);
        q.clone_from(&self.starts[rest[0].1].0);
    }

    /// The lowest of the bottoms below the candidates. The search ends when `confirm` of them led there.
    fn lowest(&mut self, targets: &[Place], found: &mut Found, confirm: usize) -> (Vec<f64>, Bottom) {
        found.candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let mut best: Option<Candidate> = None;
        let mut agreeing = 0;
        let mut point = Point::default();
        for candidate in found.candidates.iter().take(BOTTOMS) {
            point.q.clone_from(&candidate.q);
            let is_stationary = polish(&mut self.memory.hard, targets, &mut point);
            if self.memory.hard.is_met(targets, &point.q) {
                return (point.q, Bottom::Met);
            }
            let error = point.cost.sqrt();
            let lowest = best.as_ref().map_or(f64::INFINITY, |b| b.cost.sqrt());
            if (error - lowest).abs() <= SAME {
                agreeing += usize::from(is_stationary);
            } else if error < lowest {
                agreeing = 1;
            }
            if error < lowest {
                best = Some(Candidate { cost: point.cost, q: point.q.clone() });
            }
            let is_stopped = self.options.stop.as_ref().is_some_and(|s| s.load(Ordering::Relaxed));
            found.stopped |= is_stopped;
            if agreeing >= confirm || is_stopped {
                break;
            }
        }
        match best {
            Some(best) => (best.q, Bottom::Above(agreeing)),
            // No start at all, or nothing that could be computed.
            None => {
                let mut q = vec![];
                self.memory.hard.limits.start(0, &mut q);
                (q, Bottom::Above(0))
            }
        }
    }

    /// How far beyond reach the farthest target is, if one is.
    fn beyond_reach(&self, targets: &[Place]) -> Option<f64> {
        let tasks = self.reaches.iter().zip(&self.memory.hard.shapes).zip(targets);
        let beyond = tasks.filter_map(|((reach, shape), target)| {
            let [position, orientation] = shape.fixes();
            position.then(|| reach.beyond(target, orientation))
        });
        let worst = beyond.fold(0.0, f64::max);
        // Rounding stays far below a tolerance of 1e-9.
        (worst > self.memory.hard.size * (self.options.distance + self.options.angle)).then_some(worst)
    }

    fn residuals(&mut self, hard: &[Place], soft: &[Place], q: &[f64]) -> Vec<Residual> {
        let mut of_hard = self.memory.hard.residuals(hard, q).into_iter();
        let places = if soft.is_empty() { vec![] } else { self.memory.wishes.motion.places(q) };
        let soft = self.memory.wishes.shapes.iter().zip(&places).zip(soft);
        let mut of_soft = soft.map(|((s, at), target)| s.residual(at, target));
        let next = |&hard: &bool| if hard { of_hard.next() } else { of_soft.next() };
        self.is_hard.iter().filter_map(next).collect()
    }
}

/// What is below where descents gave up.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Bottom {
    /// The hard tasks are met there.
    Met,
    /// They are not, and that many descents ended at the same error.
    Above(usize),
}

/// What descents left.
struct Found {
    candidates: Vec<Candidate>,
    starts: usize,
    steps: usize,
    stopped: bool,
}
