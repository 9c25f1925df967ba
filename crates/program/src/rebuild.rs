//! A program taken back into a graph, to be carried further there.

use crate::graph::{Graph, Op, Value};
use crate::program::Program;
use denavit_symbolic::Symbol;
use rustc_hash::{FxHashMap, FxHashSet};

/// A graph under construction from a program, and the names that are taken.
pub(crate) struct Rebuild {
    pub graph: Graph,
    /// Names for shared values, by node of the graph.
    pub names: FxHashMap<u32, String>,
    used: FxHashSet<String>,
}

impl Rebuild {
    /// An empty graph with other variables; `used` starts with all names of the program.
    pub fn new(program: &Program, variables: &[Symbol], used: FxHashSet<String>) -> Self {
        Rebuild::over(variables, program.parameters(), used)
    }

    /// An empty graph over inputs, with names that are taken.
    pub fn over(variables: &[Symbol], parameters: &[Symbol], used: FxHashSet<String>) -> Self {
        let graph = Graph::new(variables, parameters);
        Rebuild { graph, names: FxHashMap::default(), used }
    }

    /// Adds the operations of the program; the result says where each of them is.
    pub fn copy(&mut self, program: &Program) -> Vec<Value> {
        let mut at: Vec<Value> = Vec::with_capacity(program.ops().len());
        for (i, (op, _)) in program.ops().iter().enumerate() {
            let v = apply(&mut self.graph, op, |n| at[n as usize]);
            self.keep_name(program, i as u32, v);
            at.push(v);
        }
        at
    }

    /// Carries the name of an operation over to its new place.
    pub fn keep_name(&mut self, program: &Program, node: u32, v: Value) {
        if let Some(name) = program.name(node) {
            self.names.entry(v.node).or_insert_with(|| name.to_string());
        }
    }

    /// The name itself, or with a number behind it if it is taken.
    pub fn unique(&mut self, name: &str) -> String {
        unique(name, &mut self.used)
    }

    /// The part of the graph that the outputs need.
    pub fn finish(&self, outputs: &[(String, Value)]) -> Program {
        let inputs = self.graph.variables().iter().chain(self.graph.parameters());
        let taken: FxHashSet<String> = inputs.map(|s| s.name().to_string()).collect();
        Program::new(&self.graph, outputs, |n| self.names.get(&n).cloned(), &taken)
    }
}

/// The name itself, or with `_2`, `_3`, … behind it, whatever is first not used.
pub(crate) fn unique(name: &str, used: &mut FxHashSet<String>) -> String {
    if used.insert(name.to_string()) {
        return name.to_string();
    }
    let mut number = 2;
    loop {
        let further = format!("{name}_{number}");
        if used.insert(further.clone()) {
            return further;
        }
        number += 1;
    }
}

/// A value with its sign turned if `negative`.
pub(crate) fn signed(v: Value, negative: bool) -> Value {
    if negative { -v } else { v }
}

/// An operation on values that are elsewhere in `graph`.
pub(crate) fn apply(graph: &mut Graph, op: &Op, at: impl Fn(u32) -> Value) -> Value {
    let moved = |v: &Value| signed(at(v.node), v.negative);
    match op {
        Op::Number(r) => graph.number(r),
        Op::Pi => graph.intern(Op::Pi),
        Op::Input(s) => graph.input(*s),
        Op::Add(a, b) => graph.add(at(*a), at(*b)),
        Op::Sub(a, b) => graph.sub(at(*a), at(*b)),
        Op::Mul(a, b) => graph.mul(at(*a), at(*b)),
        Op::Div(a, b) => graph.div(at(*a), at(*b)),
        Op::Sqrt(a) => graph.sqrt(moved(a)),
        Op::Sin(a) => graph.sin(at(*a)),
        Op::Cos(a) => graph.cos(at(*a)),
        Op::Atan2(a, b) => graph.atan2(moved(a), moved(b)),
        Op::Sign(a) => graph.sign(at(*a)),
    }
}
