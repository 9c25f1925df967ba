//! Levels and roots over lanes, for the fast evaluators: a lane is a branch, or another set of variables.
//!
//! All levels run on one register file, so that nothing is moved between them: the registers of the solver, then what
//! does not vary, then scratch. A lane in which a case has to be told apart (a guard that vanished, a discriminant that
//! is 0 as far as one can tell, a number that is not finite) is marked, and left to the careful evaluator.

use super::{Shape, SolverFunction, Step};
use crate::evaluate::block::Lanes;
use crate::evaluate::tape::{Cells, Tape};
use crate::solver::roots::{direction, quadratic, relative, sincos, vanishes};
use crate::solver::{CLAMP, Root, SAME, may_hide};
use std::f64::consts::TAU;

/// Outputs up to which there are fast evaluators.
const MOST_OUTPUTS: usize = 32;

/// Whether every root has a version over lanes, and the branches are few enough.
pub(super) fn is_possible(shape: &Shape) -> bool {
    shape.most <= 64
        && shape.outputs.len() <= MOST_OUTPUTS
        && !shape.steps.iter().any(|s| matches!(s.root, Root::Quartic { .. }))
        && !may_hide(shape.steps.iter().map(|s| s.usual))
}

/// The levels of a solver as tapes over one register file.
#[derive(Clone, Debug)]
pub(super) struct Tapes {
    pub levels: Vec<Tape>,
    pub registers: usize,
    /// Registers that never change: number, value.
    fixed: Vec<(usize, f64)>,
}

impl Tapes {
    pub fn new(solver: &SolverFunction) -> Self {
        let shape = &solver.shape;
        // What does not vary, each value once.
        let mut uniforms: Vec<u64> = vec![];
        let mut fixed: Vec<(usize, f64)> = vec![];
        let mut scratch = 0;
        for f in &solver.levels {
            for x in f.uniforms().iter().map(|x| x.to_bits()) {
                if !uniforms.contains(&x) {
                    uniforms.push(x);
                }
            }
            let tape = f.tape();
            scratch = scratch.max(tape.registers - tape.variables - tape.outputs - tape.uniforms);
        }
        let first = shape.registers;
        let registers = first + uniforms.len() + scratch;
        fixed.extend(uniforms.iter().enumerate().map(|(k, &x)| (first + k, f64::from_bits(x))));
        let mut levels = vec![];
        for (f, places) in solver.levels.iter().zip(&shape.places) {
            let tape = f.tape();
            let uniform = |k: usize| {
                let bits = f.uniforms()[k].to_bits();
                first + uniforms.iter().position(|&x| x == bits).expect("every uniform has a place")
            };
            let (writes, constants) = (tape.variables, tape.variables + tape.outputs);
            let temporary = constants + tape.uniforms;
            let moved = |r: u32| {
                let r = r as usize;
                (match r {
                    _ if r < writes => places.reads[r] as usize,
                    _ if r < constants => places.writes[r - writes] as usize,
                    _ if r < temporary => uniform(r - constants),
                    _ => first + uniforms.len() + (r - temporary),
                }) as u32
            };
            for &(k, u) in &tape.constant_outputs {
                fixed.push((places.writes[k] as usize, f.uniforms()[u]));
            }
            let cells =
                tape.cells.iter().map(|c| Cells { reads: c.reads.map(moved), writes: c.writes.map(moved) });
            let cells = cells.collect();
            levels.push(Tape {
                registers,
                cells,
                runs: tape.runs.clone(),
                constant_outputs: vec![],
                ..*tape
            });
        }
        Tapes { levels, registers, fixed }
    }

    /// A register file, what does not vary in place.
    pub fn file<const N: usize>(&self) -> Vec<Lanes<f64, N>> {
        let mut file = vec![Lanes([0.0; N]); self.registers];
        for &(r, x) in &self.fixed {
            file[r].0 = [x; N];
        }
        file
    }
}

/// A branch that goes on.
pub(super) const ALIVE: f64 = -1.0;

/// Where each lane stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct State<const N: usize> {
    /// The node that ended the branch, or [`ALIVE`].
    pub ended: [f64; N],
    /// 1 if the careful evaluator is needed, else 0.
    pub unclear: [f64; N],
    /// The smallest guard so far.
    pub guard: [f64; N],
}

impl<const N: usize> State<N> {
    pub const START: Self = State { ended: [ALIVE; N], unclear: [0.0; N], guard: [f64::INFINITY; N] };

    #[inline(always)]
    fn mark(&mut self, i: usize, is_clear: bool) {
        let is_dead = self.ended[i] >= 0.0;
        self.unclear[i] = if is_clear | is_dead { self.unclear[i] } else { 1.0 };
    }

    /// Ends a lane without roots, and marks one of which that is not clear.
    #[inline(always)]
    fn branch(&mut self, number: f64, i: usize, d: f64, terms: f64) {
        let (is_root, is_none) = (d > 0.0, d < -CLAMP * terms);
        self.mark(i, (is_root | is_none) & is_finite(terms) & is_finite(d));
        let ends = is_none & (self.ended[i] < 0.0);
        self.ended[i] = if ends { number } else { self.ended[i] };
    }

    /// Marks lanes in which the guard of node `number` vanishes, and keeps the smallest up to where a branch ends.
    #[inline(always)]
    fn guard(&mut self, number: f64, guard: &[f64; N], divisor: &[f64; N], scale: &[f64; N], step: &Step) {
        for i in 0..N {
            let is_finite = is_finite(divisor[i]) & is_finite(guard[i]) & is_finite(scale[i]);
            self.mark(i, is_finite & !vanishes(guard[i], divisor[i], scale[i]));
        }
        for i in 0..N {
            // The scale of degree 0 is 1.
            let own = if step.degree == 0 { guard[i].abs() } else { relative(guard[i], scale[i]) };
            let own = if step.usual == 1.0 { own } else { own / step.usual };
            let counts = (self.ended[i] < 0.0) | (self.ended[i] == number);
            self.guard[i] = if counts & (own < self.guard[i]) { own } else { self.guard[i] };
        }
    }
}

/// As `f64::is_finite`, which the compiler does not turn into vector code.
#[inline(always)]
pub(super) fn is_finite(x: f64) -> bool {
    x * 0.0 == 0.0
}

/// A number for each lane that is nearly the same for leaves that are the same: a weighted sum of the outputs, of angles
/// as their distance from the nearest multiple of 2π.
#[inline(always)]
pub(super) fn different<const N: usize>(shape: &Shape, file: &[Lanes<f64, N>], mark: &mut [f64; N]) {
    // Adding and subtracting rounds to the nearest integer.
    const ROUND: f64 = 1.5 * (1_u64 << 52) as f64;
    *mark = [0.0; N];
    // Weights from 1/2 to 1 that no simple ratio relates: the fractions of multiples of the golden ratio.
    let mut weight: f64 = 0.0;
    for (&r, &is_angle) in shape.outputs.iter().zip(&shape.is_angle) {
        weight = (weight + 0.6180339887498949).fract();
        let w = 0.5 + 0.5 * weight;
        let x = &file[r as usize].0;
        for i in 0..N {
            let turns = (x[i] * (1.0 / TAU) + ROUND) - ROUND;
            let distance = (x[i] - turns * TAU).abs();
            mark[i] += w * if is_angle { distance } else { x[i] };
        }
    }
}

/// Whether two leaves with these marks may be the same.
#[inline(always)]
pub(super) fn is_near(a: f64, b: f64) -> bool {
    // No weight is above 1.
    (a - b).abs() <= MOST_OUTPUTS as f64 * SAME
}

/// The roots with signs k of node `number`, written to its registers.
#[inline(always)]
pub(super) fn root<const N: usize>(
    number: usize,
    step: &Step,
    file: &mut [Lanes<f64, N>],
    scale: &[f64; N],
    k: &[f64; N],
    state: &mut State<N>,
) {
    let number = number as f64;
    let (mut first, mut second, mut of) = ([0.0; N], [0.0; N], [0.0; N]);
    let at = |r: u32| &file[r as usize].0;
    match step.root {
        Root::Ratio { numerator, denominator } => {
            let (n, d) = (at(numerator), at(denominator));
            for i in 0..N {
                of[i] = d[i].abs();
                state.mark(i, is_finite(n[i]));
                first[i] = n[i] / d[i];
            }
        }
        Root::Direction { x, y, sign } => {
            let (x, y) = (at(x), at(y));
            let sign = sign.map_or([1.0; N], |s| *at(s));
            for i in 0..N {
                of[i] = (x[i] * x[i] + y[i] * y[i]).sqrt();
                state.mark(i, is_finite(sign[i]));
                [first[i], second[i]] = direction(x[i], y[i], sign[i]);
            }
        }
        Root::Line { x, y } => {
            let (x, y) = (at(x), at(y));
            for i in 0..N {
                of[i] = (x[i] * x[i] + y[i] * y[i]).sqrt();
                [first[i], second[i]] = direction(x[i], y[i], k[i]);
            }
        }
        Root::Length { x, y } => {
            let (x, y) = (at(x), at(y));
            for i in 0..N {
                of[i] = (x[i] * x[i] + y[i] * y[i]).sqrt();
                first[i] = k[i] * of[i];
            }
        }
        Root::Sincos { a, b, c, discriminant } => {
            let (a, b, c) = (at(a), at(b), at(c));
            let mut d = [0.0; N];
            match discriminant {
                Some(known) => d = *at(known),
                None => (0..N).for_each(|i| d[i] = (a[i] * a[i] + b[i] * b[i]) - c[i] * c[i]),
            }
            for i in 0..N {
                let n = a[i] * a[i] + b[i] * b[i];
                of[i] = n.sqrt();
                state.branch(number, i, d[i], n + c[i] * c[i]);
                let positive = if d[i] > 0.0 { d[i] } else { 0.0 };
                [first[i], second[i]] = sincos([a[i], b[i], c[i]], positive, k[i]);
            }
        }
        Root::Quadratic { a, b, c } => {
            let (a, b, c) = (at(a), at(b), at(c));
            for i in 0..N {
                of[i] = a[i].abs();
                let d = b[i] * b[i] - a[i] * c[i];
                state.branch(number, i, d, b[i] * b[i] + (a[i] * c[i]).abs());
                first[i] = quadratic([a[i], b[i], c[i]], if d > 0.0 { d } else { 0.0 }, k[i]);
            }
        }
        Root::Quartic { .. } => unreachable!("quartics have no lanes"),
    }
    let guard = step.guard.map_or(of, |r| *at(r));
    state.guard(number, &guard, &of, scale, step);
    let results = step.results.clone();
    file[results.start].0 = first;
    if step.root.is_angle() {
        file[results.start + 1].0 = second;
    }
    if step.root.branches() > 1 {
        file[results.end - 1].0 = *k;
    }
}
