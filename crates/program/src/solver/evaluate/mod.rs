//! Evaluators of solvers.

mod batch;
mod lanes;
mod leaves;
mod single;
mod walk;

pub use batch::{Solutions, SolverBatch};
pub use leaves::{Ended, Leaf, Leaves};
pub use walk::{SolverScalar, Walk};

use super::{Register, Root, Solver};
use crate::evaluate::{Arithmetic, Function, Isa, MissingValue, values};
use denavit_symbolic::Symbol;
use std::ops::Range;
use std::sync::Arc;

/// A [`Solver`] ready to be evaluated, with values for its parameters. It can be sent to other threads.
#[derive(Clone, Debug)]
pub struct SolverFunction {
    shape: Arc<Shape>,
    levels: Vec<Function>,
}

/// What does not depend on parameters.
#[derive(Clone, Debug)]
struct Shape {
    variables: usize,
    registers: usize,
    most: usize,
    places: Vec<Places>,
    steps: Vec<Step>,
    outputs: Vec<Register>,
    is_angle: Vec<bool>,
    residual: Register,
    size: Register,
}

/// The registers of a level.
#[derive(Clone, Debug)]
struct Places {
    reads: Vec<Register>,
    writes: Vec<Register>,
}

/// A node without names.
#[derive(Clone, Debug)]
struct Step {
    root: Root<Register>,
    guard: Option<Register>,
    degree: u8,
    /// How large the guard is usually, relative to sizeᵈᵉᵍʳᵉᵉ; at most 1.
    usual: f64,
    results: Range<usize>,
}

impl Shape {
    fn leaves(&self) -> Leaves {
        Leaves::new(&self.is_angle, self.steps.len(), self.most)
    }
}

impl Solver {
    /// Compiles the solver, with one value per parameter ([`Solver::parameters`]).
    ///
    /// # Panics
    /// If there is not one value per parameter, or there are more than 64 nodes.
    pub fn compile(&self, parameters: &[f64]) -> SolverFunction {
        assert!(self.nodes.len() <= 64, "at most 64 nodes");
        let steps = self.nodes.iter().enumerate().map(|(i, node)| {
            let results = self.results(i);
            Step {
                root: node.root,
                guard: node.guard,
                degree: node.degree,
                usual: 1.0,
                results: results.start as usize..results.end as usize,
            }
        });
        let places = self.levels.iter().map(|l| Places { reads: l.reads.clone(), writes: l.writes.clone() });
        let shape = Shape {
            variables: self.variables.len(),
            registers: self.registers,
            most: self.max_solutions(),
            places: places.collect(),
            steps: steps.collect(),
            outputs: self.outputs.iter().map(|o| o.1).collect(),
            is_angle: self.angles.clone(),
            residual: self.residual,
            size: self.size,
        };
        let levels = self.levels.iter().map(|l| l.program.compile(parameters)).collect();
        SolverFunction { shape: shape.into(), levels }
    }

    /// Compiles the solver; `value` gives its parameters.
    ///
    /// # Errors
    /// If a parameter has no value.
    ///
    /// # Panics
    /// If there are more than 64 nodes.
    pub fn compile_with(
        &self,
        value: impl Fn(Symbol) -> Option<f64>,
    ) -> Result<SolverFunction, MissingValue> {
        Ok(self.compile(&values(&self.parameters, value)?))
    }
}

impl SolverFunction {
    /// The same with other values for its parameters; nothing is compiled again.
    ///
    /// # Panics
    /// If there is not one value per parameter.
    #[must_use]
    pub fn with_parameters(&self, parameters: &[f64]) -> SolverFunction {
        let levels = self.levels.iter().map(|f| f.with_parameters(parameters)).collect();
        SolverFunction { shape: self.shape.clone(), levels }
    }

    /// The same, with guards seen beside what is usual of them: a length that is small by nature does not make every
    /// branch look nearly undetermined. The largest guards at some sets of variables are what is usual.
    #[must_use]
    pub fn with_usual_guards<'a>(&self, variables: impl IntoIterator<Item = &'a [f64]>) -> SolverFunction {
        let mut scalar = self.scalar();
        let mut largest = vec![0.0_f64; self.shape.steps.len()];
        for one in variables {
            for (most, guard) in largest.iter_mut().zip(scalar.largest_guards(one)) {
                *most = most.max(guard);
            }
        }
        let mut shape = (*self.shape).clone();
        for (step, most) in shape.steps.iter_mut().zip(largest) {
            step.usual = if most > 0.0 { most.min(1.0) } else { 1.0 };
        }
        SolverFunction { shape: shape.into(), levels: self.levels.clone() }
    }

    /// For each node how large its guard is usually, relative to sizeᵈᵉᵍʳᵉᵉ; at most 1.
    pub fn usual_guards(&self) -> Vec<f64> {
        self.shape.steps.iter().map(|s| s.usual).collect()
    }

    /// The same on other instructions, or with routines that round the same on every machine.
    #[must_use]
    pub fn on(&self, isa: Isa, arithmetic: Arithmetic) -> SolverFunction {
        let levels = self.levels.iter().map(|f| f.on(isa, arithmetic)).collect();
        SolverFunction { shape: self.shape.clone(), levels }
    }

    /// Which vector instructions are used, and how routines round.
    pub fn target(&self) -> (Isa, Arithmetic) {
        self.levels[0].target()
    }

    /// How many variables there are.
    pub fn variables(&self) -> usize {
        self.shape.variables
    }

    /// How many outputs there are.
    pub fn outputs(&self) -> usize {
        self.shape.outputs.len()
    }

    /// The largest number of solutions.
    pub fn max_solutions(&self) -> usize {
        self.shape.most
    }

    /// The levels, one more than nodes, as functions.
    pub fn levels(&self) -> &[Function] {
        &self.levels
    }

    /// The registers that a level reads, in the order of its variables.
    ///
    /// # Panics
    /// If there is no such level.
    pub fn reads(&self, level: usize) -> &[Register] {
        &self.shape.places[level].reads
    }

    /// The registers that a level writes, in the order of its results.
    ///
    /// # Panics
    /// If there is no such level.
    pub fn writes(&self, level: usize) -> &[Register] {
        &self.shape.places[level].writes
    }

    /// An evaluator for one set of variables at a time.
    pub fn scalar(&self) -> SolverScalar {
        SolverScalar::new(self)
    }

    /// An evaluator for any number of sets of variables, one a row.
    pub fn batch(&self) -> SolverBatch {
        SolverBatch::new(self)
    }
}
