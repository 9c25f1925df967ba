//! Derivatives of a program, as programs, by the variables; parameters are not differentiated.
//!
//! Forward mode carries rates from the inputs to the results: `dv = Σ ∂v/∂a · da` over the operands a of v.
//! Reverse mode carries weights from the results to the inputs: `w(a) = Σ ∂v/∂a · w(v)` over all v that read a.
//! Elimination of vertices is in between ([`Program::jacobian_in_orders`]).
//! All are traced into the graph of the program itself, so that what they have in common with it is computed once.

mod elimination;

use crate::graph::{Graph, Op, Stage, Value};
use crate::program::{Program, names_of};
use crate::rebuild::{Rebuild, signed};
use denavit_symbolic::{Rational, Symbol};

/// What is known about each node of the program: a rate, a weight. No entry stands for 0.
type Known = Vec<Option<Value>>;

impl Program {
    /// `∂result/∂variable`, row by row: all variables for the first result, then for the second, and so on.
    /// The outputs are named `d_<result>_<variable>`. The mode is the one that costs less ([`crate::Count::cost`]).
    pub fn jacobian(&self) -> Program {
        self.jacobian_by(self.variables())
    }

    /// The same by some of the variables.
    pub fn jacobian_by(&self, variables: &[Symbol]) -> Program {
        let mut work = Rebuild::new(self, self.variables(), names_of(self));
        let at = work.copy(self);
        let results: Vec<Value> =
            self.outputs().iter().map(|o| signed(at[o.1.node as usize], o.1.negative)).collect();
        let names = named_jacobian(self, variables, &mut work);
        let nodes = Nodes::new(&mut work.graph, &results);
        let by_rates = forward_jacobian(&mut work.graph, &nodes, variables, &results);
        let by_weights = reverse_jacobian(&mut work.graph, &nodes, variables, &results);
        let [forward, reverse] = [by_rates, by_weights].map(|values| {
            let outputs: Vec<(String, Value)> = names.iter().cloned().zip(values).collect();
            work.finish(&outputs)
        });
        if reverse.count().cost() < forward.count().cost() { reverse } else { forward }
    }

    /// The results and their rates, from the variables and their rates, in forward mode. The variables are the old
    /// ones followed by their rates `d<variable>`; the outputs are the results followed by their rates `d<result>`.
    pub fn tangent(&self) -> Program {
        let mut used = names_of(self);
        let rates: Vec<Symbol> =
            self.variables().iter().map(|s| fresh(&format!("d{}", s.name()), &mut used)).collect();
        let variables = [self.variables(), &rates].concat();
        let mut work = Rebuild::new(self, &variables, used);
        let at = work.copy(self);
        let mut outputs: Vec<(String, Value)> = self
            .outputs()
            .iter()
            .map(|(name, v)| (name.clone(), signed(at[v.node as usize], v.negative)))
            .collect();
        let results: Vec<Value> = outputs.iter().map(|o| o.1).collect();
        let nodes = Nodes::new(&mut work.graph, &results);
        let mut known: Known = vec![None; nodes.size];
        for (variable, rate) in self.variables().iter().zip(&rates) {
            let place = work.graph.input(*variable).node;
            let rate = work.graph.input(*rate);
            if let Some(slot) = known.get_mut(place as usize) {
                *slot = Some(rate);
            }
        }
        nodes.forward(&mut work.graph, &mut known);
        for ((name, _), result) in self.outputs().iter().zip(&results) {
            let rate = at_result(&mut work.graph, &known, *result);
            outputs.push((work.unique(&format!("d{name}")), rate));
        }
        work.finish(&outputs)
    }

    /// The gradient of the weighted sum of the results, in reverse mode. The variables are the old ones followed by
    /// one weight `w_<result>` for each result; the outputs are the derivatives by the old ones, `d_<variable>`.
    pub fn adjoint(&self) -> Program {
        let mut used = names_of(self);
        let weights: Vec<Symbol> =
            self.outputs().iter().map(|o| fresh(&format!("w_{}", o.0), &mut used)).collect();
        let variables = [self.variables(), &weights].concat();
        let mut work = Rebuild::new(self, &variables, used);
        let at = work.copy(self);
        let results: Vec<Value> =
            self.outputs().iter().map(|o| signed(at[o.1.node as usize], o.1.negative)).collect();
        let nodes = Nodes::new(&mut work.graph, &results);
        let mut known: Known = vec![None; nodes.size];
        for (weight, result) in weights.iter().zip(&results) {
            let weight = work.graph.input(*weight);
            accumulate(&mut work.graph, &mut known[result.node as usize], signed(weight, result.negative));
        }
        nodes.reverse(&mut work.graph, &mut known);
        let mut outputs = vec![];
        for variable in self.variables() {
            let input = work.graph.input(*variable);
            let gradient = at_result(&mut work.graph, &known, input);
            outputs.push((work.unique(&format!("d_{}", variable.name())), gradient));
        }
        work.finish(&outputs)
    }
}

/// Names for the derivatives of all results by some variables.
fn named_jacobian(program: &Program, variables: &[Symbol], work: &mut Rebuild) -> Vec<String> {
    let results = program.outputs().iter();
    let pairs = results.flat_map(|(result, _)| variables.iter().map(move |v| (result, v)));
    pairs.map(|(result, v)| work.unique(&format!("d_{result}_{}", v.name()))).collect()
}

/// The nodes that the results need and that vary, in order of evaluation, each with its partial derivatives.
struct Nodes {
    list: Vec<(u32, Op, Vec<Value>)>,
    /// One more than the largest node number among them.
    size: usize,
}

impl Nodes {
    fn new(graph: &mut Graph, results: &[Value]) -> Self {
        let reached = graph.reach(results);
        let size = reached.iter().max().map_or(0, |n| *n as usize + 1);
        let mut list = vec![];
        for node in reached {
            if graph.stage(node) == Stage::Variable {
                let op = graph.op(node).clone();
                let partials = op.partials(Value { node, negative: false }, graph);
                list.push((node, op, partials));
            }
        }
        Nodes { list, size }
    }

    /// `dv = Σ ∂v/∂a · da`; `rates` starts with those of the inputs.
    fn forward(&self, graph: &mut Graph, rates: &mut Known) {
        for (node, op, partials) in &self.list {
            for (operand, partial) in op.operands().zip(partials) {
                if let Some(rate) = rates[operand.node as usize] {
                    let term = graph.mul(*partial, signed(rate, operand.negative));
                    accumulate(graph, &mut rates[*node as usize], term);
                }
            }
        }
    }

    /// `w(a) = Σ ∂v/∂a · w(v)`; `weights` starts with those of the results.
    fn reverse(&self, graph: &mut Graph, weights: &mut Known) {
        for (node, op, partials) in self.list.iter().rev() {
            let Some(weight) = weights[*node as usize] else { continue };
            for (operand, partial) in op.operands().zip(partials) {
                if graph.stage(operand.node) == Stage::Variable {
                    let term = graph.mul(*partial, signed(weight, operand.negative));
                    accumulate(graph, &mut weights[operand.node as usize], term);
                }
            }
        }
    }
}

fn forward_jacobian(graph: &mut Graph, nodes: &Nodes, variables: &[Symbol], results: &[Value]) -> Vec<Value> {
    let mut columns = vec![];
    for variable in variables {
        let place = graph.input(*variable).node as usize;
        let mut rates: Known = vec![None; nodes.size];
        if place < nodes.size {
            rates[place] = Some(graph.number(&Rational::ONE));
        }
        nodes.forward(graph, &mut rates);
        columns.push(results.iter().map(|r| at_result(graph, &rates, *r)).collect::<Vec<_>>());
    }
    (0..results.len()).flat_map(|i| columns.iter().map(move |column| column[i])).collect()
}

fn reverse_jacobian(graph: &mut Graph, nodes: &Nodes, variables: &[Symbol], results: &[Value]) -> Vec<Value> {
    let mut values = vec![];
    for result in results {
        let mut weights: Known = vec![None; nodes.size];
        let one = graph.number(&Rational::ONE);
        weights[result.node as usize] = Some(signed(one, result.negative));
        nodes.reverse(graph, &mut weights);
        for variable in variables {
            let input = graph.input(*variable);
            values.push(at_result(graph, &weights, input));
        }
    }
    values
}

/// What is known about a value; 0 if nothing is.
fn at_result(graph: &mut Graph, known: &Known, v: Value) -> Value {
    match known.get(v.node as usize).copied().flatten() {
        Some(own) => signed(own, v.negative),
        None => graph.number(&Rational::ZERO),
    }
}

/// Adds to what is known; a sum that is 0 is no entry.
fn accumulate(graph: &mut Graph, slot: &mut Option<Value>, term: Value) {
    let sum = match *slot {
        Some(so_far) => graph.add(so_far, term),
        None => term,
    };
    let is_zero = graph.as_number(sum).is_some_and(|r| r.is_zero());
    *slot = (!is_zero).then_some(sum);
}

fn fresh(name: &str, used: &mut rustc_hash::FxHashSet<String>) -> Symbol {
    Symbol::new(&crate::rebuild::unique(name, used))
}
