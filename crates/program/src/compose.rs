//! Programs put together: one reads what another computes, or numbers in place of inputs.

use crate::graph::{Graph, Op, Value};
use crate::program::Program;
use crate::rebuild::{Rebuild, apply, signed};
use denavit_symbolic::Symbol;
use rustc_hash::FxHashSet;

/// A graph that programs are copied into. What they have in common is computed once.
pub struct Composer(Rebuild);

impl Composer {
    /// Nothing yet, over these inputs.
    pub fn new(variables: &[Symbol], parameters: &[Symbol]) -> Self {
        let used: FxHashSet<String> =
            variables.iter().chain(parameters).map(|s| s.name().to_string()).collect();
        Composer(Rebuild::over(variables, parameters, used))
    }

    /// The graph, for what is added by hand.
    pub fn graph(&mut self) -> &mut Graph {
        &mut self.0.graph
    }

    /// Adds a program. An input is the value that `instead` has for it, or else the input of that name. The results, in order.
    pub fn copy(&mut self, program: &Program, instead: impl Fn(Symbol) -> Option<Value>) -> Vec<Value> {
        let mut at: Vec<Value> = Vec::with_capacity(program.ops().len());
        for (i, (op, _)) in program.ops().iter().enumerate() {
            let known = match op {
                Op::Input(s) => instead(*s),
                _ => None,
            };
            let v = known.unwrap_or_else(|| apply(&mut self.0.graph, op, |n| at[n as usize]));
            self.0.keep_name(program, i as u32, v);
            at.push(v);
        }
        program.outputs().iter().map(|o| signed(at[o.1.node as usize], o.1.negative)).collect()
    }

    /// The program of some results.
    pub fn finish(&self, outputs: &[(String, Value)]) -> Program {
        self.0.finish(outputs)
    }
}

impl Program {
    /// Some of the results, by their numbers.
    #[must_use]
    pub fn only(&self, results: &[usize]) -> Program {
        let mut all = Composer::new(self.variables(), self.parameters());
        let values = all.copy(self, |_| None);
        let outputs: Vec<(String, Value)> =
            results.iter().map(|&k| (self.outputs()[k].0.clone(), values[k])).collect();
        all.finish(&outputs)
    }
}
