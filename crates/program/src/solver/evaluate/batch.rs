//! Many sets of variables side by side, one branch after the other; all cores.

use super::lanes::{ALIVE, State, Tapes, different, is_finite, is_near, is_possible, root};
use super::{Shape, SolverFunction, SolverScalar};
use crate::evaluate::block::{self, Lanes};
use crate::evaluate::machine::{Arithmetic, Instructions, Isa, Work};
use crate::evaluate::rows;
use crate::solver::roots::power;
use crate::solver::{CANDIDATE, TOLERANCE};
use std::num::NonZero;
use std::sync::Arc;

/// Rows in a block.
const N: usize = 32;
/// Rows below which a second thread does not pay.
const ROWS_PER_THREAD: usize = 2_000;

/// The solutions of many rows of variables, in memory that is used again.
///
/// Row i has `counts[i]` solutions. Its k-th one is at `residuals[i·most + k]` and at
/// `outputs[(i·most + k)·width ..][..width]`; what lies behind the last one means nothing.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Solutions {
    width: usize,
    most: usize,
    counts: Vec<u32>,
    is_regular: Vec<bool>,
    outputs: Vec<f64>,
    residuals: Vec<f64>,
}

impl Solutions {
    /// How many outputs a solution has.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The largest number of solutions of a row.
    pub fn most(&self) -> usize {
        self.most
    }

    /// How many solutions each row has, candidates included
    /// ([`Leaf::residual`](crate::solver::Leaf::residual)).
    pub fn counts(&self) -> &[u32] {
        &self.counts
    }

    /// For each row whether all its solutions are plain: nothing free, nothing double, no candidate. Other rows are
    /// worth a look at their [`Leaves`](crate::solver::Leaves), one by one.
    pub fn is_regular(&self) -> &[bool] {
        &self.is_regular
    }

    /// All outputs: rows × most × width.
    pub fn outputs(&self) -> &[f64] {
        &self.outputs
    }

    /// All residuals: rows × most.
    pub fn residuals(&self) -> &[f64] {
        &self.residuals
    }

    /// The outputs and the residual of each solution of a row.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, number: usize) -> impl ExactSizeIterator<Item = (&[f64], f64)> {
        let count = self.counts[number] as usize;
        (0..count).map(move |k| {
            let place = number * self.most + k;
            (&self.outputs[place * self.width..(place + 1) * self.width], self.residuals[place])
        })
    }

    fn resize(&mut self, shape: &Shape, rows: usize) {
        (self.width, self.most) = (shape.outputs.len(), shape.most);
        self.counts.resize(rows, 0);
        self.is_regular.resize(rows, false);
        self.residuals.resize(rows * self.most, 0.0);
        self.outputs.resize(rows * self.most * self.width, 0.0);
    }

    fn parts(&mut self) -> Part<'_> {
        Part {
            counts: &mut self.counts,
            is_regular: &mut self.is_regular,
            outputs: &mut self.outputs,
            residuals: &mut self.residuals,
        }
    }
}

/// Consecutive rows.
struct Part<'a> {
    counts: &'a mut [u32],
    is_regular: &'a mut [bool],
    outputs: &'a mut [f64],
    residuals: &'a mut [f64],
}

impl<'a> Part<'a> {
    /// The first rows, and the rest.
    fn split(self, rows: usize, most: usize, width: usize) -> (Part<'a>, Part<'a>) {
        let (counts, later_counts) = self.counts.split_at_mut(rows);
        let (is_regular, later_regular) = self.is_regular.split_at_mut(rows);
        let (outputs, later_outputs) = self.outputs.split_at_mut(rows * most * width);
        let (residuals, later_residuals) = self.residuals.split_at_mut(rows * most);
        let later = Part {
            counts: later_counts,
            is_regular: later_regular,
            outputs: later_outputs,
            residuals: later_residuals,
        };
        (Part { counts, is_regular, outputs, residuals }, later)
    }
}

/// Runs a [`SolverFunction`] for any number of sets of variables, one a row. What is found for a row does not depend on
/// how many others there are, or on the threads: it is what [`SolverScalar::solve`] finds.
#[derive(Clone, Debug)]
pub struct SolverBatch {
    shape: Arc<Shape>,
    isa: Isa,
    arithmetic: Arithmetic,
    fast: Option<Fast>,
    careful: SolverScalar,
}

#[derive(Clone, Debug)]
struct Fast {
    tapes: Tapes,
    file: Vec<Lanes<f64, N>>,
    /// sizeᵈ for each degree d.
    scales: Vec<Lanes<f64, N>>,
    /// Before each node, and behind the last one.
    states: Vec<State<N>>,
    /// For each branch a number that differs between solutions.
    marks: Vec<Lanes<f64, N>>,
}

impl SolverBatch {
    pub(crate) fn new(solver: &SolverFunction) -> Self {
        let shape = solver.shape.clone();
        let (isa, arithmetic) = solver.target();
        let fast = is_possible(&shape).then(|| {
            let tapes = Tapes::new(solver);
            let degrees = shape.steps.iter().map(|s| usize::from(s.degree) + 1).max().unwrap_or(1);
            Fast {
                file: tapes.file(),
                tapes,
                scales: vec![Lanes([1.0; N]); degrees],
                states: vec![State::START; shape.steps.len() + 1],
                marks: vec![Lanes([f64::NAN; N]); shape.most],
            }
        });
        SolverBatch { shape, isa, arithmetic, fast, careful: solver.scalar() }
    }

    /// The solutions of each row of variables, on this thread; `variables` is row-major, N × (number of variables).
    ///
    /// # Panics
    /// If the length is not a multiple of the number of variables, or there is no variable.
    pub fn run(&mut self, variables: &[f64], solutions: &mut Solutions) {
        solutions.resize(&self.shape, self.rows(variables));
        self.part(variables, solutions.parts());
    }

    /// The same on all cores, or on as many threads as `threads` says.
    ///
    /// # Panics
    /// As [`SolverBatch::run`].
    pub fn run_parallel(
        &self,
        threads: Option<NonZero<usize>>,
        variables: &[f64],
        solutions: &mut Solutions,
    ) {
        let rows = self.rows(variables);
        let cores = || std::thread::available_parallelism().map_or(1, NonZero::get);
        let threads = threads.map_or_else(|| cores().min(rows / ROWS_PER_THREAD), NonZero::get).max(1);
        let share = rows.div_ceil(threads).next_multiple_of(N);
        solutions.resize(&self.shape, rows);
        let (most, width, v) = (solutions.most, solutions.width, self.shape.variables);
        let (mut variables, mut parts) = (variables, solutions.parts());
        std::thread::scope(|scope| {
            while parts.counts.len() > share {
                let (own, later) = parts.split(share, most, width);
                let (rows, rest) = variables.split_at(share * v);
                (parts, variables) = (later, rest);
                let mut batch = self.clone();
                scope.spawn(move || batch.part(rows, own));
            }
            self.clone().part(variables, parts);
        });
    }

    fn rows(&self, variables: &[f64]) -> usize {
        let v = self.shape.variables;
        assert!(v > 0 && variables.len().is_multiple_of(v), "whole rows of variables");
        variables.len() / v
    }

    fn part(&mut self, variables: &[f64], mut part: Part<'_>) {
        let SolverBatch { shape, isa, arithmetic, fast, careful } = self;
        match fast {
            Some(fast) => isa.run(*arithmetic, Rows { shape, fast, careful, variables, part }),
            None => {
                for (k, row) in variables.chunks(shape.variables).enumerate() {
                    one(shape, careful, row, k, &mut part);
                }
            }
        }
    }
}

/// Row k, carefully.
#[cold]
#[inline(never)]
fn one(shape: &Shape, careful: &mut SolverScalar, variables: &[f64], k: usize, part: &mut Part<'_>) {
    let leaves = careful.solve_carefully(variables, &[]);
    part.counts[k] = leaves.len() as u32;
    part.is_regular[k] = leaves.is_regular();
    let (first, width) = (k * shape.most, shape.outputs.len());
    part.outputs[first * width..][..leaves.outputs().len()].copy_from_slice(leaves.outputs());
    for (place, leaf) in part.residuals[first..].iter_mut().zip(leaves.iter()) {
        *place = leaf.residual;
    }
}

/// Block by block.
struct Rows<'a> {
    shape: &'a Shape,
    fast: &'a mut Fast,
    careful: &'a mut SolverScalar,
    variables: &'a [f64],
    part: Part<'a>,
}

impl Work for Rows<'_> {
    #[inline(always)]
    fn run<I: Instructions, const FUSED: bool>(self) {
        let Rows { shape, fast, careful, variables, mut part } = self;
        let v = shape.variables;
        for (block, variables) in variables.chunks(N * v).enumerate() {
            let first = block * N;
            let unclear = fast.block::<I, FUSED>(shape, variables, first, &mut part);
            for (lane, row) in variables.chunks_exact(v).enumerate() {
                if unclear[lane] != 0.0 {
                    one(shape, careful, row, first + lane, &mut part);
                }
            }
        }
    }
}

impl Fast {
    /// The solutions of up to N rows; 1 for each row that is not clear, else 0.
    #[inline(always)]
    fn block<I: Instructions, const FUSED: bool>(
        &mut self,
        shape: &Shape,
        variables: &[f64],
        first: usize,
        part: &mut Part<'_>,
    ) -> [f64; N] {
        let Fast { tapes, file, scales, states, marks } = self;
        let rows = variables.len() / shape.variables;
        rows::read(variables, &mut file[..shape.variables]);
        let (before, levels) = tapes.levels.split_first().expect("there is a level more than nodes");
        block::run::<I, f64, FUSED, N>(before, file);
        let size = file[shape.size as usize].0;
        for (degree, scale) in scales.iter_mut().enumerate() {
            (0..N).for_each(|i| scale.0[i] = power(size[i].abs(), degree as u8));
        }
        let mut unclear = [0.0; N];
        let mut counts = [0_usize; N];
        let mut worst = [0.0; N];
        let last = shape.steps.len();
        for (number, mark) in marks.iter_mut().enumerate() {
            // The last node varies first: what comes before the first one with another root stays as it is.
            let mut below = shape.most;
            for (i, (step, level)) in shape.steps.iter().zip(levels).enumerate() {
                below /= step.root.branches();
                if !number.is_multiple_of(below) {
                    continue;
                }
                let k = if (number / below).is_multiple_of(step.root.branches()) { 1.0 } else { -1.0 };
                let mut state = states[i];
                let scale = &scales[usize::from(step.degree)].0;
                root(i, step, file, scale, &[k; N], &mut state);
                states[i + 1] = state;
                block::run::<I, f64, FUSED, N>(level, file);
            }
            let State { ended, unclear: marked, .. } = &states[last];
            let residual = &file[shape.residual as usize].0;
            let mark = &mut mark.0;
            different(shape, file, mark);
            let mut is_kept = [0.0; N];
            for i in 0..N {
                let is_alive = ended[i] == ALIVE;
                let is_leaf = is_alive & (residual[i] <= CANDIDATE);
                let is_odd = is_alive & !is_finite(residual[i]) | is_leaf & !is_finite(mark[i]);
                unclear[i] = if is_odd { 1.0 } else { f64::max(unclear[i], marked[i]) };
                worst[i] = if is_leaf & (residual[i] > worst[i]) { residual[i] } else { worst[i] };
                mark[i] = if is_leaf { mark[i] } else { f64::NAN };
                is_kept[i] = if is_leaf { 1.0 } else { 0.0 };
            }
            let width = shape.outputs.len();
            for i in 0..rows {
                // A place that is not kept is written again, or lies behind the last one.
                let place = (first + i) * shape.most + counts[i];
                if let Some(own) = part.outputs.get_mut(place * width..(place + 1) * width) {
                    for (x, &r) in own.iter_mut().zip(&shape.outputs) {
                        *x = file[r as usize].0[i];
                    }
                    part.residuals[place] = residual[i];
                }
                counts[i] += is_kept[i] as usize;
            }
        }
        for (k, a) in marks.iter().enumerate() {
            for b in &marks[k + 1..] {
                for (unclear, (a, b)) in unclear.iter_mut().zip(a.0.iter().zip(&b.0)) {
                    *unclear = if is_near(*a, *b) { 1.0 } else { *unclear };
                }
            }
        }
        for i in 0..rows {
            part.counts[first + i] = counts[i] as u32;
            part.is_regular[first + i] = worst[i] <= TOLERANCE;
        }
        unclear
    }
}
