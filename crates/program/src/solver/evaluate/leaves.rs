//! Where solutions are kept: memory that is made once and used again.

use crate::solver::{CANDIDATE, SAME};
use std::f64::consts::TAU;

/// A solution, or a branch that comes near one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Leaf<'a> {
    /// The outputs of the solver, in order; angles as the program gives them, in [−π, π] where they come out of atan2.
    pub outputs: &'a [f64],
    /// The residual of the equations: a solution up to [`TOLERANCE`](crate::solver::TOLERANCE), a candidate that the
    /// caller may improve up to [`CANDIDATE`].
    pub residual: f64,
    /// For each node the sign k of its root: ±1, 1 to 4 for a quartic, 0 for a node that does not branch.
    pub signs: &'a [i8],
    /// How many branches end here: 1, or more where roots coincide.
    pub multiplicity: u32,
    /// Bit i is set if the equation of node i does not determine its unknown here.
    pub free: u64,
    /// The smallest guard on the way, relative to sizeᵈᵉᵍʳᵉᵉ of its node.
    pub guard: f64,
}

/// Branches that end before the last node, because an equation has no root.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ended {
    /// The node whose equation it is.
    pub node: usize,
    /// How many times this node was reached and had no root.
    pub times: u32,
    /// The smallest of these [gaps](crate::solver::Roots::gap): how far the equation is from having a root.
    pub gap: f64,
}

#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Record {
    pub residual: f64,
    pub multiplicity: u32,
    pub free: u64,
    pub guard: f64,
}

/// What a solver found for one set of variables.
#[derive(Clone, PartialEq, Debug)]
pub struct Leaves {
    is_angle: Vec<bool>,
    outputs: Vec<f64>,
    signs: Vec<i8>,
    records: Vec<Record>,
    /// For each node how often it ended a branch, and the smallest gap.
    ends: Vec<(u32, f64)>,
    dropped: u32,
    /// The smallest guard of those that ended or were dropped.
    lost_guard: f64,
    met_free: u64,
}

/// Leaves for which there is room from the beginning.
const ROOM: usize = 64;

impl Leaves {
    pub(crate) fn new(is_angle: &[bool], nodes: usize, most: usize) -> Self {
        let room = most.min(ROOM);
        Leaves {
            is_angle: is_angle.to_vec(),
            outputs: Vec::with_capacity(room * is_angle.len()),
            signs: Vec::with_capacity(room * nodes),
            records: Vec::with_capacity(room),
            ends: vec![(0, f64::INFINITY); nodes],
            dropped: 0,
            lost_guard: f64::INFINITY,
            met_free: 0,
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// True if there is none.
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// The leaf with a number, in the order of the branches: the sign of the last node changes first, from + to −.
    ///
    /// # Panics
    /// If there are not that many.
    pub fn get(&self, number: usize) -> Leaf<'_> {
        let Record { residual, multiplicity, free, guard } = self.records[number];
        let (m, n) = (self.is_angle.len(), self.ends.len());
        let outputs = &self.outputs[number * m..(number + 1) * m];
        let signs = &self.signs[number * n..(number + 1) * n];
        Leaf { outputs, residual, signs, multiplicity, free, guard }
    }

    /// All of them.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Leaf<'_>> {
        (0..self.len()).map(|k| self.get(k))
    }

    /// The outputs of all leaves, one leaf after the other.
    pub fn outputs(&self) -> &[f64] {
        &self.outputs
    }

    /// How many branches reached the end with a residual above [`CANDIDATE`], or one that is no number.
    pub fn dropped(&self) -> u32 {
        self.dropped
    }

    /// The smallest guard on the way of a branch that ended or was dropped, relative to sizeᵈᵉᵍʳᵉᵉ, or the root of the gap at
    /// which it ended (how far from one another two roots would be that just meet): where it is small, it may have been
    /// rounding that ended the branch.
    pub fn lost_guard(&self) -> f64 {
        self.lost_guard
    }

    /// The nodes at which branches ended early.
    pub fn ended(&self) -> impl Iterator<Item = Ended> {
        let ends = self.ends.iter().enumerate().filter(|(_, e)| e.0 > 0);
        ends.map(|(node, &(times, gap))| Ended { node, times, gap })
    }

    /// Bit i is set if the equation of node i left its unknown free on some branch, whether or not that led to a leaf.
    pub fn met_free(&self) -> u64 {
        self.met_free
    }

    /// True if every leaf is a plain solution: nothing free, nothing double, no candidate.
    pub fn is_regular(&self) -> bool {
        let plain = |r: &Record| r.free == 0 && r.multiplicity == 1 && r.residual <= crate::solver::TOLERANCE;
        self.records.iter().all(plain)
    }

    pub(crate) fn clear(&mut self) {
        self.outputs.clear();
        self.signs.clear();
        self.records.clear();
        self.ends.fill((0, f64::INFINITY));
        self.dropped = 0;
        self.lost_guard = f64::INFINITY;
        self.met_free = 0;
    }

    pub(crate) fn meet_free(&mut self, node: usize) {
        self.met_free |= 1 << node;
    }

    /// A branch ends at a node; `guard` is the smallest on the way there.
    pub(crate) fn end(&mut self, node: usize, gap: f64, guard: f64) {
        let end = &mut self.ends[node];
        end.0 += 1;
        end.1 = end.1.min(gap);
        self.lost_guard = self.lost_guard.min(guard);
        self.miss(gap);
    }

    /// Two roots are not there by no more than this.
    pub(crate) fn miss(&mut self, gap: f64) {
        self.lost_guard = self.lost_guard.min(gap.max(0.0).sqrt());
    }

    pub(crate) fn drop_leaf(&mut self, guard: f64) {
        self.dropped += 1;
        self.lost_guard = self.lost_guard.min(guard);
    }

    /// Takes a leaf over, drops it, or joins it with one that is the same.
    pub(crate) fn add(&mut self, outputs: impl Iterator<Item = f64>, signs: &[i8], record: Record) {
        let (m, n) = (self.is_angle.len(), self.ends.len());
        let first = self.outputs.len();
        self.outputs.extend(outputs);
        let is_leaf = record.residual <= CANDIDATE && self.outputs[first..].iter().all(|x| x.is_finite());
        if !is_leaf {
            self.outputs.truncate(first);
            self.drop_leaf(record.guard);
            return;
        }
        let (known, new) = self.outputs.split_at(first);
        let is_angle = &self.is_angle;
        let same =
            (0..self.records.len()).find(|&k| (0..m).all(|i| is_same(known[k * m + i], new[i], is_angle[i])));
        let Some(k) = same else {
            self.signs.extend_from_slice(signs);
            self.records.push(record);
            return;
        };
        let together = self.records[k].multiplicity + record.multiplicity;
        if record.residual < self.records[k].residual {
            self.outputs.copy_within(first.., k * m);
            self.signs[k * n..(k + 1) * n].copy_from_slice(signs);
            self.records[k] = record;
        }
        self.outputs.truncate(first);
        self.records[k].multiplicity = together;
    }

    /// Takes a leaf over that is known to be one, and not the same as another.
    #[inline]
    pub(crate) fn push(&mut self, outputs: impl Iterator<Item = f64>, signs: &[i8], record: Record) {
        self.outputs.extend(outputs);
        self.signs.extend_from_slice(signs);
        self.records.push(record);
    }
}

/// Whether two values of an output are the same.
#[inline(always)]
pub(crate) fn is_same(a: f64, b: f64, is_angle: bool) -> bool {
    let distance = (a - b).abs();
    (distance <= SAME) | (is_angle & ((distance - TAU).abs() <= SAME))
}
