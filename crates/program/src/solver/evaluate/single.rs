//! One set of variables, its branches side by side: eight lanes, in several passes if there are more branches.

use super::lanes::{State, Tapes, different, is_near, root};
use super::leaves::{Leaves, Record};
use super::{Shape, SolverFunction};
use crate::evaluate::block::{self, Lanes, Run};
use crate::evaluate::machine::{Arithmetic, Instructions, Isa, Work};
use crate::solver::CANDIDATE;
use crate::solver::roots::{power, roots};
use std::sync::Arc;

/// Branches in a pass.
const N: usize = 8;

/// The evaluator for what is clear.
#[derive(Clone, Debug)]
pub(super) struct Single {
    shape: Arc<Shape>,
    isa: Isa,
    arithmetic: Arithmetic,
    tapes: Tapes,
    file: Vec<Lanes<f64, N>>,
    passes: Vec<Pass>,
}

/// The branches of a pass.
#[derive(Clone, Debug)]
struct Pass {
    /// How many of the lanes are in use.
    lanes: usize,
    /// The sign of each node in each lane.
    k: Vec<Lanes<f64, N>>,
    /// The same, lane by lane, as leaves have them: 0 for a node that does not branch.
    signs: Vec<i8>,
    /// For each node the lanes that speak for all with the same earlier branches.
    first: Vec<[bool; N]>,
}

impl Pass {
    fn new(shape: &Shape, first_branch: usize) -> Self {
        let n = shape.steps.len();
        let lanes = N.min(shape.most - first_branch);
        let mut pass = Pass {
            lanes,
            k: vec![Lanes([1.0; N]); n],
            signs: vec![0; lanes * n],
            first: vec![[false; N]; n],
        };
        // The last node varies first.
        let mut below = 1;
        for (i, step) in shape.steps.iter().enumerate().rev() {
            let own = step.root.branches();
            for lane in 0..lanes {
                let branch = first_branch + lane;
                let k = if (branch / below).is_multiple_of(own) { 1 } else { -1 };
                pass.k[i].0[lane] = f64::from(k);
                pass.signs[lane * n + i] = if own > 1 { k } else { 0 };
                pass.first[i][lane] = branch.is_multiple_of(below * own);
            }
            below *= own;
        }
        pass
    }
}

impl Single {
    pub fn new(solver: &SolverFunction) -> Self {
        let shape = solver.shape.clone();
        let (isa, arithmetic) = solver.target();
        let tapes = Tapes::new(solver);
        let file = tapes.file();
        let passes = (0..shape.most).step_by(N).map(|first| Pass::new(&shape, first)).collect();
        Single { shape, isa, arithmetic, tapes, file, passes }
    }

    /// All leaves; false if the careful evaluator has to be asked.
    pub fn solve(&mut self, variables: &[f64], leaves: &mut Leaves) -> bool {
        let mut is_clear = true;
        let Single { shape, isa, arithmetic, tapes, file, passes } = self;
        let work = Solve { shape, tapes, file, passes, variables, leaves, is_clear: &mut is_clear };
        isa.run(*arithmetic, work);
        is_clear
    }
}

struct Solve<'a> {
    shape: &'a Shape,
    tapes: &'a Tapes,
    file: &'a mut [Lanes<f64, N>],
    passes: &'a [Pass],
    variables: &'a [f64],
    leaves: &'a mut Leaves,
    is_clear: &'a mut bool,
}

impl Work for Solve<'_> {
    #[inline(always)]
    fn run<I: Instructions, const FUSED: bool>(self) {
        let Solve { shape, tapes, file, passes, variables, leaves, is_clear } = self;
        leaves.clear();
        for (register, x) in file.iter_mut().zip(variables) {
            register.0 = [*x; N];
        }
        let (before, rest) = tapes.levels.split_first().expect("there is a level more than nodes");
        block::run::<I, f64, FUSED, N>(before, file);
        let size = file[shape.size as usize].0[0].abs();
        for pass in passes {
            let mut state = State::<N>::START;
            for (i, (step, level)) in shape.steps.iter().zip(rest).enumerate() {
                let scale = [power(size, step.degree); N];
                root(i, step, file, &scale, &pass.k[i].0, &mut state);
                // A part of this one: levels are short, and a call of each would be felt.
                Run(level, file).run::<I, FUSED>();
            }
            if !take(shape, file, pass, &state, passes.len() == 1, size, leaves) {
                *is_clear = false;
                return;
            }
        }
    }
}

/// The leaves of a pass; false if not everything is clear.
#[inline(always)]
fn take(
    shape: &Shape,
    file: &[Lanes<f64, N>],
    pass: &Pass,
    state: &State<N>,
    is_only: bool,
    size: f64,
    leaves: &mut Leaves,
) -> bool {
    let lanes = pass.lanes;
    if state.unclear[..lanes].iter().any(|&x| x != 0.0) {
        return false;
    }
    let residual = &file[shape.residual as usize].0;
    let mut is_kept = [false; N];
    let mut finite = 0.0;
    for lane in 0..lanes {
        if state.ended[lane] >= 0.0 {
            let i = state.ended[lane] as usize;
            if pass.first[i][lane] {
                let step = &shape.steps[i];
                let at = |r: u32| file[r as usize].0[lane];
                let scale = power(size, step.degree);
                let gap = roots(&step.root.map(at), step.guard.map(at), (scale, size), None).gap;
                leaves.end(i, gap, state.guard[lane]);
            }
        } else {
            finite += residual[lane] * 0.0;
            is_kept[lane] = residual[lane] <= CANDIDATE;
            if is_kept[lane] {
                finite += shape.outputs.iter().map(|&r| file[r as usize].0[lane] * 0.0).sum::<f64>();
            } else {
                leaves.drop_leaf(state.guard[lane]);
            }
        }
    }
    if finite != 0.0 {
        return false;
    }
    let is_plain = is_only && !any_same(shape, file, &is_kept);
    let n = shape.steps.len();
    for lane in (0..lanes).filter(|&l| is_kept[l]) {
        let record = Record { residual: residual[lane], multiplicity: 1, free: 0, guard: state.guard[lane] };
        let outputs = shape.outputs.iter().map(|&r| file[r as usize].0[lane]);
        let signs = &pass.signs[lane * n..(lane + 1) * n];
        if is_plain {
            leaves.push(outputs, signs, record);
        } else {
            leaves.add(outputs, signs, record);
        }
    }
    true
}

/// Whether two of the lanes that are kept may have the same outputs.
#[inline(always)]
fn any_same(shape: &Shape, file: &[Lanes<f64, N>], is_kept: &[bool; N]) -> bool {
    // Twice, so that lane i stands beside lane i + shift.
    let mut marks = [0.0; N];
    different(shape, file, &mut marks);
    let mut twice = [f64::NAN; 2 * N];
    for i in 0..N {
        let mark = if is_kept[i] { marks[i] } else { f64::NAN };
        (twice[i], twice[i + N]) = (mark, mark);
    }
    let mut near = [0.0; N];
    for shift in 1..=N / 2 {
        for i in 0..N {
            near[i] = if is_near(twice[i], twice[i + shift]) { 1.0 } else { near[i] };
        }
    }
    near.iter().fold(0.0, |sum, x| sum + x) != 0.0
}
