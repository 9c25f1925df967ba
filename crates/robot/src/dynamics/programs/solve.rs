//! Accelerations: A q̈ = τ − h by A = LDLᵀ, and derivatives of the solution.

use super::held::Held;
use super::{DynamicProgram, DynamicPrograms, NoProgram, named};
use crate::dynamics::base::inputs;
use crate::dynamics::lagrange::STATES;
use crate::random::Random;
use denavit_program::{Composer, Program, Residue, Value};
use denavit_symbolic::{Rational, Symbol};
use rustc_hash::FxHashMap;

/// What is asked of A q̈ = τ − h.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Solved {
    /// q̈.
    Accelerations,
    /// Its derivatives.
    Derivatives,
    /// Both, row by row.
    Both,
}

impl DynamicPrograms {
    /// q̈ = A⁻¹(τ − h), its derivatives, or both, with the matrix that makes it the shortest.
    pub(super) fn accelerations(&self, wanted: Solved) -> Result<DynamicProgram, NoProgram> {
        let solved = |matrix: &DynamicProgram| -> Result<DynamicProgram, NoProgram> {
            let program = self.solved(&matrix.program, wanted)?;
            let shortening = matrix.shortening.and(self.bias().shortening);
            Ok(DynamicProgram { program, shortening, ..matrix.clone() })
        };
        let all = self.inertias().iter().map(solved).collect::<Result<Vec<_>, _>>()?;
        Ok(self.shortened(all, 0, Held::AtStates))
    }

    fn solved(&self, matrix: &Program, wanted: Solved) -> Result<Program, NoProgram> {
        let [q, qd, qdd, tau] = &self.symbols;
        let n = q.len();
        let variables = [&q[..], qd, tau, &self.wrench].concat();
        let mut all = Composer::new(&variables, self.parameters());
        let matrix = all.copy(matrix, |_| None);
        let bias = all.copy(&self.bias().program, |_| None);
        let graph = all.graph();
        let rest: Vec<Value> = (0..n)
            .map(|j| {
                let drive = graph.input(tau[j]);
                graph.sub(drive, bias[j])
            })
            .collect();
        let factors = Factors::new(&matrix, n, &mut all).map_err(NoProgram::Singular)?;
        if let Some(lost) = always_zero(&all.finish(&named("d", factors.diagonal.clone()))) {
            return Err(NoProgram::Singular(n - 1 - lost));
        }
        let accelerations = factors.solve(rest, &mut all);
        if wanted == Solved::Accelerations {
            return Ok(all.finish(&named("qdd", accelerations)));
        }
        let at = |s: Symbol| qdd.iter().position(|k| *k == s).map(|k| accelerations[k]);
        let slopes = all.copy(self.by_state(), at);
        let [zero, one] = [Rational::ZERO, Rational::ONE].map(|r| all.graph().number(&r));
        let mut columns: Vec<Vec<Value>> = vec![];
        for c in 0..2 * n {
            let column = (0..n).map(|i| -slopes[2 * n * i + c]).collect();
            columns.push(factors.solve(column, &mut all));
        }
        for c in 0..n {
            let unit = (0..n).map(|i| if i == c { one } else { zero }).collect();
            columns.push(factors.solve(unit, &mut all));
        }
        // A⁻¹ is symmetric: what of it is below the diagonal is what is above.
        let entry = |i: usize, c: usize| match c.checked_sub(2 * n) {
            Some(j) if j > i => columns[2 * n + i][j],
            _ => columns[c][i],
        };
        let row = |i: usize| {
            let own = accelerations.get(i).copied().filter(|_| wanted == Solved::Both);
            own.into_iter().chain((0..3 * n).map(move |c| (i, c)).map(|(i, c)| entry(i, c)))
        };
        let entries = (0..n).flat_map(row).collect();
        Ok(all.finish(&named("d", entries)))
    }
}

/// The first result of a program that is 0 at random points modulo a prime, each time.
fn always_zero(program: &Program) -> Option<usize> {
    let mut random = Random(1984);
    let mut any = || (random.unit() * (1_u64 << 53) as f64) as u64;
    let mut is_zero = vec![true; program.outputs().len()];
    for _ in 0..STATES {
        let at: FxHashMap<Symbol, Residue> =
            inputs(program).map(|s| (s, Residue::input(any(), any()))).collect();
        let values = program.eval(|s| at.get(&s).cloned()).unwrap_or_default();
        let zero = values.iter().map(|v| v.get() == Some(0)).chain(std::iter::repeat(false));
        is_zero.iter_mut().zip(zero).for_each(|(all, one)| *all &= one);
    }
    is_zero.iter().position(|z| *z)
}

/// A = LDLᵀ in a graph, the joints from the tip to the base: what the last joint has to do with is known first, and is often constant.
struct Factors {
    lower: Vec<Vec<Value>>,
    /// D.
    diagonal: Vec<Value>,
    /// One over each entry of D.
    inverse: Vec<Value>,
}

impl Factors {
    /// The factors; the joint, from 0, whose pivot is 0, if there is one.
    fn new(matrix: &[Value], n: usize, all: &mut Composer) -> Result<Self, usize> {
        let graph = all.graph();
        let matrix: Vec<Value> = matrix.iter().rev().copied().collect();
        let [zero, one] = [Rational::ZERO, Rational::ONE].map(|r| graph.number(&r));
        let mut inverse = vec![];
        let (mut lower, mut diagonal) = (vec![vec![zero; n]; n], vec![zero; n]);
        for j in 0..n {
            // L D of the row, once for all entries below.
            let scaled: Vec<Value> = (0..j).map(|k| graph.mul(lower[j][k], diagonal[k])).collect();
            let mut pivot = matrix[n * j + j];
            for k in 0..j {
                let part = graph.mul(lower[j][k], scaled[k]);
                pivot = graph.sub(pivot, part);
            }
            if graph.as_number(pivot).is_some_and(|r| r.is_zero()) {
                return Err(n - 1 - j);
            }
            diagonal[j] = pivot;
            let over = graph.div(one, pivot);
            inverse.push(over);
            for i in j + 1..n {
                let mut entry = matrix[n * i + j];
                for k in 0..j {
                    let part = graph.mul(lower[i][k], scaled[k]);
                    entry = graph.sub(entry, part);
                }
                lower[i][j] = graph.mul(entry, over);
            }
        }
        Ok(Factors { lower, diagonal, inverse })
    }

    fn solve(&self, mut x: Vec<Value>, all: &mut Composer) -> Vec<Value> {
        let (graph, n) = (all.graph(), x.len());
        x.reverse();
        for i in 0..n {
            for k in 0..i {
                let part = graph.mul(self.lower[i][k], x[k]);
                x[i] = graph.sub(x[i], part);
            }
        }
        for (entry, d) in x.iter_mut().zip(&self.inverse) {
            *entry = graph.mul(*entry, *d);
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                let part = graph.mul(self.lower[k][i], x[k]);
                x[i] = graph.sub(x[i], part);
            }
        }
        x.reverse();
        x
    }
}
