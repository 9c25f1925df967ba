//! Solvers whose levels are machine code.

use crate::{code::MachineCode, error::Error};
use denavit_program::solver::{Leaves, SolverFunction, Walk};

/// A [`SolverFunction`] as machine code between the roots of its equations: one branch after the other, with the bits of
/// [`SolverScalar`](denavit_program::solver::SolverScalar), which is faster where all branches are wanted and fit into
/// vectors.
#[derive(Clone, Debug)]
pub struct MachineSolver {
    function: SolverFunction,
    levels: Vec<MachineCode>,
    walk: Walk,
    /// What a level reads and writes, gathered.
    variables: Vec<f64>,
    results: Vec<f64>,
}

impl MachineSolver {
    /// Translates the levels of a solver.
    ///
    /// # Errors
    /// If Cranelift has no code for this processor, or a level is too large for it.
    pub fn compile(function: &SolverFunction) -> Result<Self, Error> {
        let levels: Result<Vec<MachineCode>, Error> =
            function.levels().iter().map(MachineCode::compile).collect();
        let levels = levels?;
        let most = |count: fn(&MachineCode) -> usize| levels.iter().map(count).max().unwrap_or(0);
        Ok(MachineSolver {
            variables: vec![0.0; most(|l| l.function().code().variables)],
            results: vec![0.0; most(|l| l.function().code().outputs.len())],
            walk: Walk::new(function),
            levels,
            function: function.clone(),
        })
    }

    /// The same with other values for its parameters; nothing is compiled again.
    ///
    /// # Panics
    /// If there is not one value per parameter.
    #[must_use]
    pub fn with_parameters(&self, parameters: &[f64]) -> Self {
        let levels = self.levels.iter().map(|l| l.with_parameters(parameters)).collect();
        MachineSolver { function: self.function.with_parameters(parameters), levels, ..self.clone() }
    }

    /// All solutions for one set of variables, as
    /// [`SolverScalar::solve`](denavit_program::solver::SolverScalar::solve) gives them. Nothing is allocated.
    ///
    /// # Panics
    /// If there is not one value per variable.
    pub fn solve(&mut self, variables: &[f64], given: &[Option<[f64; 2]>]) -> &Leaves {
        let MachineSolver { function, levels, walk, variables: gathered, results } = self;
        walk.solve(variables, given, |level, registers| {
            let (reads, writes) = (function.reads(level), function.writes(level));
            let (gathered, results) = (&mut gathered[..reads.len()], &mut results[..writes.len()]);
            for (x, &r) in gathered.iter_mut().zip(reads) {
                *x = registers[r as usize];
            }
            levels[level].eval(gathered, results);
            for (x, &r) in results.iter().zip(writes) {
                registers[r as usize] = *x;
            }
        })
    }
}
