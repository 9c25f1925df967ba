//! Jacobians by elimination of vertices (Griewank and Reese 1991).
//!
//! In the graph of the partial derivatives an edge a → v carries ∂v/∂a. Taking out a vertex v that stands between variables and
//! results puts ∂w/∂v ∂v/∂a on a → w for each edge that came in and each that went out. What is left in the end, edges from variables
//! to results, is the Jacobian. Taken out first in order of evaluation that is forward mode, from the end reverse mode; here the
//! vertex is next that leaves the fewest edges, and of equal ones any.

use super::{Nodes, accumulate, named_jacobian};
use crate::graph::{Stage, Value};
use crate::program::{Program, names_of};
use crate::rebuild::{Rebuild, signed};
use denavit_symbolic::{Rational, Symbol};
use std::collections::{BTreeMap, BTreeSet};

/// Operations of a program beyond which no order is sought.
const LARGEST: usize = 4_000;
/// Products on edges, for each operation of what another mode costs, beyond which an order is given up.
const WORTH: usize = 4;

impl Program {
    /// What [`Program::jacobian_by`] gives, with fewer operations where elimination of vertices has fewer in one of so many orders.
    pub fn jacobian_in_orders(&self, variables: &[Symbol], orders: u64) -> Program {
        let plain = self.jacobian_by(variables);
        if self.ops().len() > LARGEST {
            return plain;
        }
        let most = WORTH * plain.count().cost() as usize;
        let found = (0..orders).filter_map(|order| eliminated(self, variables, order, most));
        // The first of those that cost the least.
        std::iter::once(plain.clone()).chain(found).min_by_key(|p| p.count().cost()).unwrap_or(plain)
    }
}

/// The Jacobian in an order; nothing if more products than `most` were needed.
fn eliminated(program: &Program, variables: &[Symbol], order: u64, most: usize) -> Option<Program> {
    let mut work = Rebuild::new(program, program.variables(), names_of(program));
    let at = work.copy(program);
    let results: Vec<Value> =
        program.outputs().iter().map(|o| signed(at[o.1.node as usize], o.1.negative)).collect();
    let names = named_jacobian(program, variables, &mut work);
    let nodes = Nodes::new(&mut work.graph, &results);
    let sources: Vec<u32> = variables.iter().map(|s| work.graph.input(*s).node).collect();
    let mut edges = Edges::new(&nodes, &sources, &results, order, &mut work);
    let mut products = 0;
    while let Some(vertex) = edges.next() {
        products += edges.into[vertex].len() * edges.out[vertex].len();
        if products > most {
            return None;
        }
        edges.eliminate(vertex, &mut work);
    }
    let zero = work.graph.number(&Rational::ZERO);
    let entry = |row: usize, source: u32| {
        let place = edges.place.get(source as usize).copied().flatten();
        place.and_then(|p| edges.into[edges.inner + row].get(&p).copied()).unwrap_or(zero)
    };
    let entries = (0..results.len()).flat_map(|row| sources.iter().map(move |&s| (row, s)));
    let outputs: Vec<(String, Value)> = names.into_iter().zip(entries.map(|(r, s)| entry(r, s))).collect();
    Some(work.finish(&outputs))
}

/// What is left of the graph: the nodes that vary with the variables, by their places, then the results.
struct Edges {
    /// Which of equal vertices comes first.
    order: u64,
    /// By the numbers of nodes.
    place: Vec<Option<usize>>,
    /// How many are no results.
    inner: usize,
    /// From where edges come to a vertex, and what they carry.
    into: Vec<BTreeMap<usize, Value>>,
    out: Vec<BTreeSet<usize>>,
    /// The vertices that are to be taken out, the next one first, and where each stands among them.
    queue: BTreeSet<(i64, u64, usize)>,
    ranks: Vec<Option<(i64, u64, usize)>>,
}

impl Edges {
    fn new(nodes: &Nodes, sources: &[u32], results: &[Value], order: u64, work: &mut Rebuild) -> Self {
        let mut place: Vec<Option<usize>> = vec![None; nodes.size];
        let mut into: Vec<BTreeMap<usize, Value>> = vec![];
        let mut is_source = vec![];
        for (node, op, partials) in &nodes.list {
            let mut edges: BTreeMap<usize, Option<Value>> = BTreeMap::new();
            for (operand, partial) in op.operands().zip(partials) {
                let varies = work.graph.stage(operand.node) == Stage::Variable;
                if let Some(from) = place[operand.node as usize].filter(|_| varies) {
                    let slot = edges.entry(from).or_default();
                    accumulate(&mut work.graph, slot, signed(*partial, operand.negative));
                }
            }
            let edges: BTreeMap<usize, Value> =
                edges.into_iter().filter_map(|(k, v)| Some((k, v?))).collect();
            let own = sources.contains(node);
            if own || !edges.is_empty() {
                place[*node as usize] = Some(into.len());
                into.push(edges);
                is_source.push(own);
            }
        }
        let inner = into.len();
        let one = work.graph.number(&Rational::ONE);
        for result in results {
            let from = place.get(result.node as usize).copied().flatten();
            into.push(from.map(|p| (p, signed(one, result.negative))).into_iter().collect());
        }
        let mut out = vec![BTreeSet::new(); into.len()];
        for (to, edges) in into.iter().enumerate() {
            for &from in edges.keys() {
                out[from].insert(to);
            }
        }
        let (queue, ranks) = (BTreeSet::new(), vec![None; inner]);
        let mut edges = Edges { order, place, inner, into, out, queue, ranks };
        (0..inner).filter(|&v| !is_source[v]).for_each(|v| edges.rank(v));
        edges
    }

    /// The vertex that is to be taken out next.
    fn next(&self) -> Option<usize> {
        self.queue.first().map(|rank| rank.2)
    }

    /// Finds the place of a vertex among those that are to be taken out.
    fn rank(&mut self, vertex: usize) {
        if let Some(old) = self.ranks[vertex].take() {
            self.queue.remove(&old);
        }
        let (into, out) = (&self.into[vertex], &self.out[vertex]);
        let is_new = |from: &&usize, to: usize| !self.into[to].contains_key(*from);
        let new: usize = out.iter().map(|&to| into.keys().filter(|from| is_new(from, to)).count()).sum();
        let more = new as i64 - (into.len() + out.len()) as i64;
        let rank = (more, mixed(self.order, vertex), vertex);
        self.ranks[vertex] = Some(rank);
        self.queue.insert(rank);
    }

    fn eliminate(&mut self, vertex: usize, work: &mut Rebuild) {
        if let Some(rank) = self.ranks[vertex].take() {
            self.queue.remove(&rank);
        }
        let into = std::mem::take(&mut self.into[vertex]);
        let out = std::mem::take(&mut self.out[vertex]);
        // Those whose place may be another now.
        let mut stale: BTreeSet<usize> = into.keys().copied().chain(out.iter().copied()).collect();
        for from in into.keys() {
            self.out[*from].remove(&vertex);
        }
        for &to in &out {
            let Some(on) = self.into[to].remove(&vertex) else { continue };
            for (&from, &before) in &into {
                let term = work.graph.mul(on, before);
                let mut edge = self.into[to].remove(&from);
                let was = edge.is_some();
                accumulate(&mut work.graph, &mut edge, term);
                if let Some(value) = edge {
                    self.into[to].insert(from, value);
                }
                if was != edge.is_some() {
                    if was {
                        self.out[from].remove(&to);
                    } else {
                        self.out[from].insert(to);
                    }
                    stale.extend(self.out[from].iter().filter(|&v| self.into[to].contains_key(v)));
                }
            }
        }
        for v in stale {
            if self.ranks.get(v).is_some_and(|rank| rank.is_some()) {
                self.rank(v);
            }
        }
    }
}

/// A number for each vertex in each order (Vigna's splitmix64).
fn mixed(order: u64, vertex: usize) -> u64 {
    let mixed = (order << 32 | vertex as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}
