//! Inverse kinematics, prepared; and what it answers.

use crate::functions::threads;
use crate::robot;
use crate::trouble::{Trouble, text};
use crate::types::{Doubt, Goal, Pose, Status};
use denavit::description::Description;
use denavit::geometry::{NotRigid, Transform};
use denavit::inverse::{self, InverseKinematics, InverseOptions, Unprepared};
use denavit_report::words::Tongue;
use denavit_symbolic::Expr;
use std::ffi::CString;
use std::sync::Arc;
use std::thread;

/// A solver, with what stands for joints that are given.
#[derive(Debug)]
pub struct Core {
    pub kinematics: InverseKinematics,
    pub method: CString,
    /// Values of given joints that nobody gives: 0, or the middle of limits that exclude it.
    usual: Vec<f64>,
}

/// All that was found for a pose.
#[derive(Debug)]
pub struct Found {
    pub solver: Arc<Core>,
    pub pose: Transform<f64>,
    pub answer: inverse::Answer,
    /// How many solutions and families the limits exclude, where they were left out.
    pub left_out: Option<usize>,
    /// The branches of solutions, then those of families.
    pub branches: Vec<CString>,
    /// What is free in each family.
    pub free: Vec<CString>,
    /// Why there is none.
    pub obstacle: Option<CString>,
}

/// A pose that is one.
pub fn rigid(pose: &Pose) -> Result<Transform<f64>, Trouble> {
    Transform::from_matrix(pose.matrix).map_err(|why| {
        let status = match why {
            NotRigid::NotFinite { .. } => Status::NotFinite,
            _ => Status::NotARotation,
        };
        Trouble::new(status, format!("pose: {why}"))
    })
}

/// The pose of a transform.
pub fn pose(of: &[f64]) -> Pose {
    Pose { matrix: std::array::from_fn(|r| std::array::from_fn(|c| of[4 * r + c])) }
}

/// Nothing but numbers.
pub fn finite(values: &[f64], name: &str) -> Result<(), Trouble> {
    match values.iter().position(|x| !x.is_finite()) {
        Some(i) => Err(Trouble::new(Status::NotFinite, format!("{name}[{i}] is {}", values[i]))),
        None => Ok(()),
    }
}

fn prepared(d: &Description, goal: Goal, given: &[usize]) -> Result<Core, Trouble> {
    let goal = match goal {
        Goal::Pose => inverse::Goal::Pose,
        Goal::Position => inverse::Goal::Position,
    };
    let options = InverseOptions { goal, given: (!given.is_empty()).then(|| given.to_vec()) };
    let kinematics = InverseKinematics::new(d, &options).map_err(|why| match &why {
        Unprepared::Missing(missing) => Trouble::missing(missing),
        Unprepared::Lengths(_) => Trouble::new(Status::Unsupported, why.to_string()),
        Unprepared::Given(why) => Trouble::new(Status::BadArgument, format!("given: {why}")),
    })?;
    let limits: Vec<_> = d.rows.iter().filter(|r| r.variable.is_some()).map(|r| r.limits).collect();
    let usual = kinematics.given.iter().map(|&j| {
        let number = |e: Expr| e.eval(|s| d.value(s)).ok();
        match limits[j].and_then(|[a, b]| Some([number(a)?, number(b)?])) {
            Some([low, high]) if !(low..=high).contains(&0.0) => f64::midpoint(low, high),
            _ => 0.0,
        }
    });
    Ok(Core { usual: usual.collect(), method: text(kinematics.method()), kinematics })
}

impl Core {
    /// For a robot.
    pub fn new(robot: &robot::Core, goal: Goal, given: &[usize]) -> Result<Self, Trouble> {
        let n = robot.joints();
        if let Some(j) = given.iter().find(|j| **j >= n) {
            let why = format!("given: there is no joint {j}; the robot has {n}, counted from 0");
            return Err(Trouble::new(Status::BadArgument, why));
        }
        robot.derive(|d| prepared(d, goal, given))
    }

    /// How many joints the robot has.
    pub fn joints(&self) -> usize {
        self.kinematics.robot.joints
    }

    /// Values of given joints: those of the caller, or what is usual.
    pub fn given<'a>(&'a self, values: &'a [f64]) -> Result<&'a [f64], Trouble> {
        if values.is_empty() {
            return Ok(&self.usual);
        }
        if values.len() != self.usual.len() {
            return Err(Trouble::length("given", values.len(), self.usual.len()));
        }
        finite(values, "given")?;
        Ok(values)
    }

    /// All solutions of a pose, without those that the limits exclude if it is so wished.
    pub fn solve(
        &self,
        pose: &Transform<f64>,
        given: &[f64],
        within_limits: bool,
    ) -> (inverse::Answer, Option<usize>) {
        let mut answer = self.kinematics.solve(pose, given);
        let left_out = within_limits.then(|| answer.leave_out(&self.kinematics.space));
        (answer, left_out)
    }

    /// Everything about a pose.
    pub fn all(self: &Arc<Self>, pose: &Pose, given: &[f64], within_limits: bool) -> Result<Found, Trouble> {
        let pose = rigid(pose)?;
        let (answer, left_out) = self.solve(&pose, self.given(given)?, within_limits);
        let families = answer.families.iter().map(|f| &f.representative);
        let branches = answer.solutions.iter().chain(families).map(|s| text(&s.branch.to_string())).collect();
        let is_excluded = left_out.is_some_and(|n| n > 0);
        let obstacle = answer.obstacle.as_ref().filter(|_| !answer.is_reachable() && !is_excluded);
        let obstacle = obstacle.map(|o| text(&Tongue::English.words().obstacle(o)));
        let free = answer.families.iter().map(|f| text(&f.free.join(", "))).collect();
        Ok(Found { solver: self.clone(), pose, answer, left_out, branches, free, obstacle })
    }
}

/// What came of a pose.
pub fn status(answer: &inverse::Answer, left_out: Option<usize>) -> Status {
    match (answer.is_reachable(), answer.is_complete()) {
        (true, true) if answer.families.is_empty() => Status::Ok,
        (true, true) => Status::Family,
        (true, false) => Status::Undecided,
        (false, _) if left_out.is_some_and(|n| n > 0) => Status::OutsideLimits,
        (false, true) => Status::Unreachable,
        (false, false) => Status::NotFound,
    }
}

/// Why there may be more solutions.
pub fn doubt(answer: &inverse::Answer) -> Doubt {
    match answer.doubt {
        None => Doubt::None,
        Some(inverse::Doubt::Sampled) => Doubt::Sampled,
        Some(inverse::Doubt::DoubleRoot) => Doubt::DoubleRoot,
        Some(inverse::Doubt::Uncounted) => Doubt::Uncounted,
        Some(inverse::Doubt::Searched) => Doubt::Searched,
        Some(inverse::Doubt::OneAsked) => Doubt::OneAsked,
        Some(inverse::Doubt::Copies) => Doubt::Copies,
        Some(inverse::Doubt::Digits) => Doubt::Digits,
    }
}

/// Room for the solutions of one pose.
struct Row<'a> {
    q: &'a mut [f64],
    count: &'a mut usize,
    status: &'a mut i32,
    residuals: Option<&'a mut [f64]>,
}

/// Room for the solutions of many poses: `most` a pose.
pub struct Rows<'a> {
    pub most: usize,
    pub q: &'a mut [f64],
    pub counts: &'a mut [usize],
    pub statuses: &'a mut [i32],
    pub residuals: Option<&'a mut [f64]>,
}

impl Core {
    fn fill(&self, pose: &Pose, given: &[f64], within_limits: bool, row: Row<'_>) {
        let Row { q, count, status: came, mut residuals } = row;
        q.fill(f64::NAN);
        if let Some(residuals) = &mut residuals {
            residuals.fill(f64::NAN);
        }
        *count = 0;
        let pose = match rigid(pose) {
            Ok(pose) => pose,
            Err(why) => {
                *came = why.status as i32;
                return;
            }
        };
        let (answer, left_out) = self.solve(&pose, given, within_limits);
        let families = answer.families.iter().map(|f| &f.representative);
        let n = self.joints();
        for s in answer.solutions.iter().chain(families) {
            let first = *count * n;
            if let Some(place) = q.get_mut(first..first + n).filter(|p| !p.is_empty()) {
                place.copy_from_slice(&s.q);
            }
            if let Some(place) = residuals.as_mut().and_then(|r| r.get_mut(*count)) {
                *place = s.residual;
            }
            *count += 1;
        }
        *came = status(&answer, left_out) as i32;
    }

    /// All solutions of many poses, by as many threads; the same whatever their number.
    pub fn many(&self, poses: &[Pose], given: &[f64], within_limits: bool, rows: Rows<'_>, asked: usize) {
        let Rows { most, q, counts, statuses, residuals } = rows;
        let share = poses.len().div_ceil(threads(asked)).max(1);
        let (width, n) = (most * self.joints(), poses.len());
        let mut q = Parts(q, width);
        let mut residuals = residuals.map(|r| Parts(r, most));
        let mut all: Vec<Row<'_>> = Vec::with_capacity(n);
        for (count, status) in counts.iter_mut().zip(statuses) {
            all.push(Row { q: q.part(), count, status, residuals: residuals.as_mut().map(Parts::part) });
        }
        thread::scope(|scope| {
            let mut shares = Vec::new();
            let mut left = all;
            for part in poses.chunks(share) {
                let rest = left.split_off(part.len());
                shares.push((part, std::mem::replace(&mut left, rest)));
            }
            let work = |(part, rows): (&[Pose], Vec<Row<'_>>)| {
                part.iter().zip(rows).for_each(|(pose, row)| self.fill(pose, given, within_limits, row));
            };
            let own = shares.pop();
            for part in shares {
                scope.spawn(move || work(part));
            }
            if let Some(own) = own {
                work(own);
            }
        });
    }
}

/// What is left of an array of which equal parts are taken.
struct Parts<'a>(&'a mut [f64], usize);

impl<'a> Parts<'a> {
    fn part(&mut self) -> &'a mut [f64] {
        let (part, rest) = std::mem::take(&mut self.0).split_at_mut(self.1);
        self.0 = rest;
        part
    }
}
