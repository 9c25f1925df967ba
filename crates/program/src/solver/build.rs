//! From a graph with roots in it to levels of programs.

use super::{Draft, Node, Root, Solver};
use crate::graph::{Graph, Op, Stage, Value};
use crate::program::Program;
use crate::rebuild::{apply, unique};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// The number of a register.
pub type Register = u32;

/// A program between two nodes.
#[derive(Clone, Debug)]
pub struct Level {
    /// What it computes; its variables are those of `reads`, its parameters those of the solver, in the solver's order.
    pub program: Program,
    /// The registers of the program's variables, in order.
    pub reads: Vec<Register>,
    /// The registers of the program's outputs, in order.
    pub writes: Vec<Register>,
}

/// A solver under construction: one graph, in which the results of each root are inputs.
///
/// A root may read what was computed from earlier roots only; the graph is shared by all, so that what two nodes have
/// in common is computed once, at the first level where it is known.
pub struct SolverBuilder {
    /// Where operands and outputs are computed.
    pub graph: Graph,
    variables: usize,
    nodes: Vec<Draft>,
    names: FxHashMap<u32, String>,
    defect: Option<Value>,
}

/// A result of a solver under construction.
#[derive(Clone, Debug)]
pub struct Output {
    /// Its name.
    pub name: String,
    /// Its value.
    pub value: Value,
    /// True if it is an angle, equal modulo 2π.
    pub is_angle: bool,
}

impl SolverBuilder {
    /// Nothing known but the variables; `results` are the names of all results that roots will have.
    pub fn new(variables: &[Symbol], parameters: &[Symbol], results: &[Symbol]) -> Self {
        let all: Vec<Symbol> = variables.iter().chain(results).copied().collect();
        let graph = Graph::new(&all, parameters);
        SolverBuilder {
            graph,
            variables: variables.len(),
            nodes: vec![],
            names: FxHashMap::default(),
            defect: None,
        }
    }

    /// Says how far the variables are from what they must be ([`Solver::defect`]): a number that is known at level 0.
    pub fn defect(&mut self, v: Value) {
        self.name(v, "defect");
        self.defect = Some(v);
    }

    /// Traces a formula.
    pub fn trace(&mut self, e: Expr) -> Value {
        self.graph.trace(e)
    }

    /// Proposes a name for a value that is computed.
    pub fn name(&mut self, v: Value, name: &str) {
        self.names.entry(v.node).or_insert_with(|| name.to_string());
    }

    /// The nodes of the graph that what was added so far needs.
    pub fn walk(&self) -> FxHashSet<u32> {
        let wanted: Vec<Value> =
            self.nodes.iter().flat_map(|n| n.root.operands().into_iter().chain(n.guard)).collect();
        self.graph.reach(&wanted).into_iter().collect()
    }

    /// Adds a node; its results are inputs of the graph from now on.
    ///
    /// # Panics
    /// If the node does not name as many results as its root has, or names one that was not announced.
    pub fn node(&mut self, node: Draft) {
        assert_eq!(node.results.len(), node.root.results(), "one name per result");
        let announced = &self.graph.variables()[self.variables..];
        assert!(node.results.iter().all(|s| announced.contains(s)), "results are announced");
        self.nodes.push(node);
    }

    /// The solver. `residual` is a number without dimension, `size` a length that is known at level 0.
    ///
    /// # Panics
    /// If a node reads a result of itself or of a later node.
    pub fn finish(self, outputs: &[Output], residual: Value, size: Value) -> Solver {
        let SolverBuilder { graph, variables, nodes, names, defect } = self;
        let last = nodes.len();
        let inputs = graph.variables()[..variables].to_vec();

        // Registers of inputs, and the level at which each is known.
        let mut register: FxHashMap<Symbol, (Register, usize)> = FxHashMap::default();
        for (i, s) in inputs.iter().enumerate() {
            register.insert(*s, (i as Register, 0));
        }
        for (i, node) in nodes.iter().enumerate() {
            for s in &node.results {
                register.insert(*s, (register.len() as Register, i + 1));
            }
        }
        let mut wanted: Vec<Vec<Value>> = vec![vec![]; last + 1];
        for (i, node) in nodes.iter().enumerate() {
            wanted[i] = node.root.operands();
            wanted[i].extend(node.guard);
        }
        wanted[last].extend(outputs.iter().map(|o| o.value));
        wanted[last].push(residual);
        wanted[0].push(size);
        wanted[0].extend(defect);

        let level = levels(&graph, &wanted, &register);
        for (i, values) in wanted.iter().enumerate() {
            let known = values.iter().all(|v| level.get(&v.node).is_none_or(|&l| l <= i));
            assert!(known, "node {i} reads what is not known yet");
        }

        // From the last level to the first: what a level needs of earlier ones is wanted there.
        let mut carried: Vec<Vec<u32>> = vec![vec![]; last + 1];
        for i in (0..=last).rev() {
            let mut roots: Vec<u32> = wanted[i].iter().map(|v| v.node).collect();
            roots.extend(&carried[i]);
            let mut seen = FxHashSet::default();
            while let Some(n) = roots.pop() {
                if !seen.insert(n) || graph.stage(n) != Stage::Variable || matches!(graph.op(n), Op::Input(_))
                {
                    continue;
                }
                match level[&n] {
                    l if l < i => {
                        if !carried[l].contains(&n) {
                            carried[l].push(n);
                        }
                    }
                    _ => roots.extend(graph.op(n).nodes()),
                }
            }
        }

        let mut used: FxHashSet<String> =
            graph.variables().iter().chain(graph.parameters()).map(|s| s.name().to_string()).collect();
        used.extend(outputs.iter().map(|o| o.name.clone()));
        let mut registers = register.len() as Register;
        let mut fresh = || {
            registers += 1;
            registers - 1
        };
        // Where values are: nodes that are carried, and signed values that roots read.
        let mut held: FxHashMap<u32, (Register, Symbol)> = FxHashMap::default();
        let mut early: FxHashSet<String> = FxHashSet::default();
        let mut built: Vec<Level> = vec![];
        let mut places: Vec<Vec<Register>> = vec![];
        for i in 0..=last {
            let mut write: Vec<(String, Value, Register)> = vec![];
            let mut place = vec![];
            for (k, v) in wanted[i].iter().enumerate() {
                let direct = match graph.op(v.node) {
                    Op::Input(s) if !v.negative => register.get(s).map(|r| r.0),
                    _ if !v.negative => held.get(&v.node).map(|h| h.0),
                    _ => None,
                };
                let known = direct.or_else(|| write.iter().find(|w| w.1 == *v).map(|w| w.2));
                place.push(known.unwrap_or_else(|| {
                    let r = fresh();
                    let name = match names.get(&v.node) {
                        Some(name) if !v.negative => name.clone(),
                        _ => operand_name(&nodes, outputs, i, last, k),
                    };
                    let is_output = i == last && k < outputs.len();
                    let name = if is_output { name } else { unique(&name, &mut used) };
                    write.push((name, *v, r));
                    r
                }));
            }
            for &n in &carried[i] {
                let v = Value { node: n, negative: false };
                if let Some(w) = write.iter().find(|w| w.1 == v) {
                    held.insert(n, (w.2, Symbol::new(&w.0)));
                } else {
                    let r = fresh();
                    // An output that is known early stands nowhere else.
                    let output = outputs.iter().find(|o| o.value == v).map(|o| o.name.clone());
                    let name = match output.filter(|name| early.insert(name.clone())) {
                        Some(name) => name,
                        None => {
                            let proposed = names.get(&n).cloned().unwrap_or_else(|| format!("w{r}"));
                            unique(&proposed, &mut used)
                        }
                    };
                    held.insert(n, (r, Symbol::new(&name)));
                    write.push((name, v, r));
                }
            }
            places.push(place);
            let known = Known { graph: &graph, level: &level, register: &register, held: &held };
            built.push(known.program(i, &write, &names, &used));
        }
        let mut compiled = vec![];
        for (i, node) in nodes.iter().enumerate() {
            let mut at = places[i].iter().copied();
            let root = node.root.map(|_| at.next().expect("a register per operand"));
            let guard = node.guard.map(|_| at.next().expect("a register for the guard"));
            compiled.push(Node {
                root,
                guard,
                degree: node.degree,
                results: node.results.clone(),
                label: node.label.clone(),
            });
        }
        let mut early = places[0].iter().rev().copied();
        let defect_place = defect.and_then(|_| early.next());
        let size_place = early.next().expect("the size is wanted at level 0");
        let ends = &places[last];
        Solver {
            variables: inputs,
            parameters: graph.parameters().to_vec(),
            outputs: outputs.iter().zip(ends).map(|(o, &r)| (o.name.clone(), r)).collect(),
            angles: outputs.iter().map(|o| o.is_angle).collect(),
            residual: ends[outputs.len()],
            size: size_place,
            defect: defect_place,
            levels: built,
            nodes: compiled,
            registers: registers as usize,
        }
    }
}

/// The name of an operand: what the root is called by, and which part of the equation it is.
fn operand_name(nodes: &[Draft], outputs: &[Output], i: usize, last: usize, k: usize) -> String {
    if i == last {
        return match outputs.get(k) {
            Some(o) => o.name.clone(),
            None if k == outputs.len() => "residual".into(),
            None => "size".into(),
        };
    }
    let node = &nodes[i];
    let parts: &[&str] = match node.root {
        Root::Ratio { .. } => &["num", "den"],
        Root::Direction { .. } => &["x", "y", "det"],
        Root::Line { .. } | Root::Length { .. } => &["x", "y"],
        Root::Sincos { .. } => &["a", "b", "c", "disc"],
        Root::Quadratic { .. } => &["a", "b", "c"],
        Root::Quartic { .. } => &["cc", "cs", "c", "s", "one"],
    };
    let operands = node.root.operands().len();
    let part = match k {
        k if k < operands => parts[k],
        k if k == operands && node.guard.is_some() => "guard",
        _ => return "size".into(),
    };
    format!("{part}_{}", node.results[0].name())
}

/// The level at which each node that varies is known.
fn levels(
    graph: &Graph,
    wanted: &[Vec<Value>],
    register: &FxHashMap<Symbol, (Register, usize)>,
) -> FxHashMap<u32, usize> {
    let all: Vec<Value> = wanted.iter().flatten().copied().collect();
    let mut level: FxHashMap<u32, usize> = FxHashMap::default();
    for n in graph.reach(&all) {
        let known = match graph.op(n) {
            Op::Input(s) => register.get(s).map_or(0, |r| r.1),
            op => op.nodes().map(|o| level[&o]).max().unwrap_or(0),
        };
        level.insert(n, known);
    }
    level
}

/// Where values are when a level begins.
struct Known<'a> {
    graph: &'a Graph,
    /// The level at which each node that varies is known.
    level: &'a FxHashMap<u32, usize>,
    /// Inputs: their register, and the level at which they are known.
    register: &'a FxHashMap<Symbol, (Register, usize)>,
    /// What earlier levels have computed for later ones.
    held: &'a FxHashMap<u32, (Register, Symbol)>,
}

impl Known<'_> {
    /// The program of level `now`, which writes some values to registers under names.
    fn program(
        &self,
        now: usize,
        write: &[(String, Value, Register)],
        names: &FxHashMap<u32, String>,
        used: &FxHashSet<String>,
    ) -> Level {
        let Known { graph, level, register, held } = *self;
        let earlier = |n: u32| {
            let computed = graph.stage(n) == Stage::Variable && !matches!(graph.op(n), Op::Input(_));
            held.get(&n).filter(|_| computed && level[&n] < now)
        };
        // Inputs in the order of first use.
        let mut reads: Vec<(Register, Symbol)> = vec![];
        let mut order: Vec<u32> = vec![];
        let mut seen = FxHashSet::default();
        let mut pending: Vec<(u32, bool)> = write.iter().rev().map(|w| (w.1.node, false)).collect();
        while let Some((n, done)) = pending.pop() {
            if done {
                order.push(n);
            } else if seen.insert(n) {
                match (earlier(n), graph.op(n)) {
                    (Some(h), _) => reads.push(*h),
                    (None, Op::Input(s)) => reads.extend(register.get(s).map(|r| (r.0, *s))),
                    _ => {}
                }
                pending.push((n, true));
                if earlier(n).is_none() {
                    let operands: Vec<u32> = graph.op(n).nodes().collect();
                    pending.extend(operands.iter().rev().map(|&o| (o, false)));
                }
            }
        }
        reads.sort_unstable_by_key(|r| r.0);
        reads.dedup_by_key(|r| r.0);
        let variables: Vec<Symbol> = reads.iter().map(|r| r.1).collect();
        let mut part = Graph::new(&variables, graph.parameters());
        let mut at: FxHashMap<u32, Value> = FxHashMap::default();
        let mut hints: FxHashMap<u32, String> = FxHashMap::default();
        for n in order {
            let v = match earlier(n) {
                Some(h) => part.input(h.1),
                None => apply(&mut part, graph.op(n), |o| at[&o]),
            };
            if let Some(name) = names.get(&n) {
                hints.entry(v.node).or_insert_with(|| name.clone());
            }
            at.insert(n, v);
        }
        let outputs: Vec<(String, Value)> = write
            .iter()
            .map(|w| {
                let v = at[&w.1.node];
                (w.0.clone(), if w.1.negative { -v } else { v })
            })
            .collect();
        let written: FxHashSet<&String> = outputs.iter().map(|o| &o.0).collect();
        let taken: FxHashSet<String> = used.iter().filter(|name| !written.contains(name)).cloned().collect();
        let program = Program::new(&part, &outputs, |n| hints.get(&n).cloned(), &taken);
        Level {
            program,
            reads: reads.iter().map(|r| r.0).collect(),
            writes: write.iter().map(|w| w.2).collect(),
        }
    }
}
