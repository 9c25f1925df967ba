//! Answers one behind the other, in arrays: as they are found, so that an answer's own memory is used again for the next one.

use crate::arrays::matrix;
use denavit::geometry::Transform;
use denavit::inverse::{Answer, Branch, Family, InverseKinematics};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString};
use std::num::NonZero;
use std::thread;

/// Answers.
#[derive(Default)]
pub struct Packed {
    /// Solutions, all joints of one behind those of another.
    q: Vec<f64>,
    residuals: Vec<f64>,
    multiplicities: Vec<i64>,
    within_limits: Vec<bool>,
    /// The branch of each solution, by its number among the branches that occur.
    branches: Vec<usize>,
    known: Vec<Branch>,
    /// Where the search for the next branch begins: in many answers they come in the same order.
    next: usize,
    /// How many solutions each answer has.
    pub counts: Vec<i64>,
    /// Whether they are all, answer by answer.
    pub complete: Vec<bool>,
    /// What came of each pose.
    pub status: Vec<&'static str>,
    /// How many solutions and families of each the limits exclude, where that was asked for.
    pub left_out: Vec<usize>,
    /// The families of those answers that have some, by their numbers.
    pub families: Vec<(usize, Vec<Family>)>,
}

impl Packed {
    /// All solutions of poses, without what the limits exclude if it is so wished.
    pub fn solve(
        solver: &InverseKinematics,
        poses: &[Transform<f64>],
        given: &[f64],
        limits: bool,
        threads: NonZero<usize>,
    ) -> Self {
        let share = poses.len().div_ceil(threads.get()).max(1);
        let work = |poses: &[Transform<f64>]| {
            let mut packed = Packed::default();
            for pose in poses {
                let mut answer = solver.solve(pose, given);
                let left_out = limits.then(|| answer.leave_out(&solver.space));
                packed.add(&answer, left_out);
            }
            packed
        };
        let Some((own, others)) = poses.split_at_checked(share) else { return work(poses) };
        thread::scope(|scope| {
            let others: Vec<_> = others.chunks(share).map(|part| scope.spawn(move || work(part))).collect();
            let mut all = work(own);
            for part in others {
                all.append(part.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
            }
            all
        })
    }

    /// One more answer.
    pub fn add(&mut self, answer: &Answer, left_out: Option<usize>) {
        for s in &answer.solutions {
            self.q.extend_from_slice(&s.q);
            self.residuals.push(s.residual);
            self.multiplicities.push(i64::from(s.multiplicity));
            self.within_limits.push(s.within_limits);
            let branch = self.number(&s.branch);
            self.branches.push(branch);
        }
        if !answer.families.is_empty() {
            self.families.push((self.counts.len(), answer.families.clone()));
        }
        self.counts.push(i64::try_from(answer.solutions.len()).unwrap_or(i64::MAX));
        self.complete.push(answer.is_complete());
        self.status.push(denavit_wire::inverse::status_within(answer, left_out));
        self.left_out.push(left_out.unwrap_or_default());
    }

    /// The number of a branch.
    fn number(&mut self, branch: &Branch) -> usize {
        let known = &self.known;
        let found = (self.next..known.len()).chain(0..self.next).find(|&k| known[k] == *branch);
        let found = found.unwrap_or_else(|| {
            self.known.push(branch.clone());
            self.known.len() - 1
        });
        self.next = if found + 1 < self.known.len() { found + 1 } else { 0 };
        found
    }

    /// Further answers behind these.
    fn append(&mut self, mut other: Packed) {
        let numbers: Vec<usize> = other.known.iter().map(|branch| self.number(branch)).collect();
        self.branches.extend(other.branches.iter().map(|&k| numbers[k]));
        self.q.append(&mut other.q);
        self.residuals.append(&mut other.residuals);
        self.multiplicities.append(&mut other.multiplicities);
        self.within_limits.append(&mut other.within_limits);
        let before = self.counts.len();
        self.families.extend(other.families.into_iter().map(|(number, all)| (before + number, all)));
        self.counts.append(&mut other.counts);
        self.complete.append(&mut other.complete);
        self.status.append(&mut other.status);
        self.left_out.append(&mut other.left_out);
    }

    /// Puts the solutions, of an arm with so many joints, into a dictionary.
    ///
    /// # Errors
    /// If they do not go into arrays.
    pub fn list(&mut self, py: Python<'_>, dict: &Bound<'_, PyDict>, joints: usize) -> PyResult<()> {
        let words: Vec<_> = self.known.iter().map(|branch| PyString::new(py, &branch.to_string())).collect();
        let branches = PyList::new(py, self.branches.iter().map(|&k| &words[k]))?;
        let count = self.residuals.len();
        dict.set_item("solutions", matrix(py, std::mem::take(&mut self.q), count, joints)?)?;
        dict.set_item("residuals", std::mem::take(&mut self.residuals).into_pyarray(py))?;
        dict.set_item("branches", branches)?;
        dict.set_item("multiplicities", std::mem::take(&mut self.multiplicities).into_pyarray(py))?;
        dict.set_item("within_limits", PyArray1::from_slice(py, &self.within_limits))
    }
}
