//! A straight-line program: the nodes that some outputs need, in order, the shared ones named.

use crate::domain::Domain;
use crate::graph::{Count, Graph, Op, Stage, Value};
use denavit_symbolic::{Expr, Node, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// A straight-line program.
#[derive(Clone, Debug)]
pub struct Program {
    variables: Vec<Symbol>,
    parameters: Vec<Symbol>,
    /// Operations in order; operands are positions in this list.
    ops: Vec<(Op, Stage)>,
    outputs: Vec<(String, Value)>,
    /// A name for each operation that more than one other reads.
    names: Vec<Option<String>>,
}

/// A line of the program as a person reads it.
#[derive(Clone, PartialEq, Debug)]
pub struct Step {
    /// What is computed.
    pub name: String,
    /// From what; the names of earlier steps are symbols in it.
    pub value: Expr,
    /// When it is known.
    pub stage: Stage,
    /// True for a result, false for an intermediate.
    pub is_output: bool,
}

impl Program {
    /// The part of a graph that `outputs` need. `hint` proposes names for shared values; names in `taken` and those of
    /// inputs are avoided, and values without a proposal are numbered `m1`, `m2`, …. A result whose name is taken gets
    /// underscores behind it.
    pub fn new(
        graph: &Graph,
        outputs: &[(String, Value)],
        hint: impl Fn(u32) -> Option<String>,
        taken: &FxHashSet<String>,
    ) -> Self {
        let values: Vec<Value> = outputs.iter().map(|o| o.1).collect();
        let nodes = graph.reach(&values);
        let place: FxHashMap<u32, u32> = nodes.iter().enumerate().map(|(i, &n)| (n, i as u32)).collect();
        let at = |n: u32| place[&n];
        let moved = |v: Value| Value { node: place[&v.node], negative: v.negative };
        let mut ops: Vec<(Op, Stage)> =
            nodes.iter().map(|&n| (graph.op(n).renumbered(at), graph.stage(n))).collect();
        let mut outputs: Vec<(String, Value)> =
            outputs.iter().map(|(name, v)| (name.clone(), moved(*v))).collect();

        let mut uses = vec![0_u32; ops.len()];
        for (op, _) in &ops {
            op.nodes().for_each(|o| uses[o as usize] += 1);
        }
        outputs.iter().for_each(|o| uses[o.1.node as usize] += 1);
        // A result −(a − b) is b − a.
        for (_, v) in &mut outputs {
            let node = v.node as usize;
            if let (1, true, Op::Sub(a, b)) = (uses[node], v.negative, &ops[node].0) {
                ops[node].0 = Op::Sub(*b, *a);
                v.negative = false;
            }
        }
        let inputs = graph.variables().iter().chain(graph.parameters());
        let mut used: FxHashSet<String> = inputs.map(|s| s.name().to_string()).collect();
        used.extend(taken.iter().cloned());
        // A result that is called like an input gets another name.
        for (name, _) in &mut outputs {
            while !name.is_empty() && !used.insert(name.clone()) {
                name.push('_');
            }
        }
        let in_angles = only_in_angles(&ops, &outputs);
        let plain_sums = plain_sums(&ops);
        let mut last: FxHashMap<&str, u32> = FxHashMap::default();
        let mut names = vec![None; ops.len()];
        for (i, (op, stage)) in ops.iter().enumerate() {
            let is_leaf = matches!(op, Op::Number(_) | Op::Pi | Op::Input(_));
            if uses[i] < 2 || *stage == Stage::Constant || is_leaf || in_angles[i] {
                continue;
            }
            // A sine or cosine of a sum of inputs has a short name of its own.
            let prefix = match op {
                Op::Sin(a) | Op::Cos(a) if plain_sums[*a as usize] => continue,
                Op::Sin(_) => "sa",
                Op::Cos(_) => "ca",
                _ => "m",
            };
            let proposed = hint(nodes[i]).filter(|name| used.insert(name.clone()));
            names[i] = Some(
                proposed.unwrap_or_else(|| numbered(prefix, last.entry(prefix).or_default(), &mut used)),
            );
        }
        Program {
            variables: graph.variables().to_vec(),
            parameters: graph.parameters().to_vec(),
            ops,
            outputs,
            names,
        }
    }

    /// The same with other names for the values and results that are called like one of `others`; inputs keep theirs. A value with a number
    /// gets another number, a result underscores behind it.
    #[must_use]
    pub fn named_apart(mut self, others: &FxHashSet<String>) -> Self {
        let mut used = names_of(&self);
        used.extend(others.iter().cloned());
        for (name, _) in self.outputs.iter_mut().filter(|o| others.contains(&o.0)) {
            while !used.insert(name.clone()) {
                name.push('_');
            }
        }
        for name in self.names.iter_mut().flatten().filter(|name| others.contains(*name)) {
            let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
            *name = numbered(letters, &mut 0, &mut used);
        }
        self
    }

    /// A program whose operations are given as they are; an input that is not a variable is a parameter.
    pub(crate) fn from_parts(
        variables: Vec<Symbol>,
        parameters: Vec<Symbol>,
        list: impl Iterator<Item = Op>,
        outputs: Vec<(String, Value)>,
        names: Vec<Option<String>>,
    ) -> Self {
        let known: FxHashSet<Symbol> = variables.iter().copied().collect();
        let mut ops: Vec<(Op, Stage)> = vec![];
        for op in list {
            let stage = match &op {
                Op::Input(s) if known.contains(s) => Stage::Variable,
                Op::Input(_) => Stage::Parameter,
                _ => op.nodes().map(|n| ops[n as usize].1).max().unwrap_or(Stage::Constant),
            };
            ops.push((op, stage));
        }
        Program { variables, parameters, ops, outputs, names }
    }

    /// Results and where they come from.
    pub fn outputs(&self) -> &[(String, Value)] {
        &self.outputs
    }

    /// The inputs that are known at every evaluation only, in the order of the arguments of evaluators.
    pub fn variables(&self) -> &[Symbol] {
        &self.variables
    }

    /// The inputs that are known before, in the order of the arguments of evaluators.
    pub fn parameters(&self) -> &[Symbol] {
        &self.parameters
    }

    /// The operations in order, with when they are known; operands are positions in this list.
    pub fn ops(&self) -> &[(Op, Stage)] {
        &self.ops
    }

    /// The name of an operation that more than one other reads.
    pub fn name(&self, node: u32) -> Option<&str> {
        self.names[node as usize].as_deref()
    }

    /// Its operations.
    pub fn count(&self) -> Count {
        let (mut count, mut angles) = (Count::default(), vec![]);
        let look = |n: u32| (&self.ops[n as usize].0, self.ops[n as usize].1);
        (0..self.ops.len() as u32).for_each(|n| count.include(n, look, &mut angles));
        count
    }

    /// The longest chain of operations from an input to an output.
    pub fn depth(&self) -> usize {
        let mut depths = vec![0_usize; self.ops.len()];
        for (i, (op, stage)) in self.ops.iter().enumerate() {
            let before = op.nodes().map(|n| depths[n as usize]).max();
            let costs = *stage == Stage::Variable;
            depths[i] = before.map_or(0, |d| d + usize::from(costs));
        }
        self.outputs.iter().map(|o| depths[o.1.node as usize]).max().unwrap_or(0)
    }

    /// Cycles that one evaluation takes in a batch, by estimate ([`Op::cycles`]).
    pub fn cycles(&self) -> f64 {
        self.ops.iter().filter(|o| o.1 == Stage::Variable).map(|o| o.0.cycles()).sum()
    }

    /// The outputs over some kind of number; `input` gives the inputs. This is the definition that the evaluators
    /// follow; they are what to use where speed matters.
    ///
    /// # Errors
    /// The first input without a value.
    pub fn eval<D: Domain>(&self, input: impl Fn(Symbol) -> Option<D>) -> Result<Vec<D>, Symbol> {
        let mut values: Vec<D> = Vec::with_capacity(self.ops.len());
        for (op, _) in &self.ops {
            let given = match op {
                Op::Input(s) => Some(input(*s).ok_or(*s)?),
                _ => None,
            };
            let value = op.value(|_| given.expect("looked up above"), |n| values[n as usize].clone());
            values.push(value);
        }
        let signed = |v: &Value| {
            let value = &values[v.node as usize];
            if v.negative { value.neg() } else { value.clone() }
        };
        Ok(self.outputs.iter().map(|o| signed(&o.1)).collect())
    }

    /// The outputs as formulas in the inputs, nothing abbreviated (shared parts are shared nodes).
    pub fn formulas(&self) -> Vec<Expr> {
        let values = self.expressions(&vec![None; self.ops.len()]);
        self.outputs.iter().map(|o| signed(values[o.1.node as usize], o.1.negative)).collect()
    }

    /// What it divides by that depends on parameters alone: where one of these is 0 the results are no numbers.
    pub fn divisors(&self) -> Vec<Expr> {
        let values = self.expressions(&vec![None; self.ops.len()]);
        let mut found: Vec<Expr> = vec![];
        for (op, _) in &self.ops {
            if let Op::Div(_, below) = op
                && self.ops[*below as usize].1 == Stage::Parameter
                && !found.contains(&values[*below as usize])
            {
                found.push(values[*below as usize]);
            }
        }
        found
    }

    /// The program line by line: what depends on parameters alone, then the intermediates, then the results in
    /// the order in which they become known. Sines and cosines of angle sums stand in the formulas.
    pub fn steps(&self) -> Vec<Step> {
        // A shared value that is a result as well goes by the name of the result.
        let mut names: Vec<Option<Expr>> =
            self.names.iter().map(|n| n.as_deref().map(Expr::symbol)).collect();
        for (name, v) in self.outputs.iter().rev() {
            let slot = &mut names[v.node as usize];
            if slot.is_some() {
                *slot = Some(signed(Expr::symbol(name), v.negative));
            }
        }
        let values = self.expressions(&names);
        let mut steps = vec![];
        for (i, (_, stage)) in self.ops.iter().enumerate() {
            let results: Vec<&(String, Value)> =
                self.outputs.iter().filter(|o| o.1.node as usize == i).collect();
            let value = values[i];
            match (&names[i], &results[..]) {
                (Some(_), [first, rest @ ..]) => {
                    let own = signed(value, first.1.negative);
                    steps.push(Step { name: first.0.clone(), value: own, stage: *stage, is_output: true });
                    for other in rest {
                        let alias = signed(Expr::symbol(&first.0), other.1.negative != first.1.negative);
                        steps.push(Step {
                            name: other.0.clone(),
                            value: alias,
                            stage: *stage,
                            is_output: true,
                        });
                    }
                }
                (Some(name), []) => {
                    let name = name.as_symbol().map(|s| s.name().to_string()).unwrap_or_default();
                    steps.push(Step { name, value, stage: *stage, is_output: false });
                }
                (None, results) => {
                    for (name, v) in results {
                        let value = signed(value, v.negative);
                        steps.push(Step { name: name.clone(), value, stage: *stage, is_output: true });
                    }
                }
            }
        }
        steps.iter_mut().for_each(|s| s.value = tidy(s.value));
        steps.sort_by_key(|s| match s.stage {
            Stage::Parameter => 0,
            Stage::Variable => 1,
            Stage::Constant => 2,
        });
        steps
    }

    /// The sines and cosines that are taken at every evaluation, in order of first use.
    pub fn sines_and_cosines(&self) -> Vec<Expr> {
        let values = self.expressions(&vec![None; self.ops.len()]);
        let taken = |op: &Op, stage: Stage| matches!(op, Op::Sin(_) | Op::Cos(_)) && stage == Stage::Variable;
        let of_variables = self.ops.iter().zip(values).filter(|((op, stage), _)| taken(op, *stage));
        of_variables.map(|(_, value)| value).collect()
    }

    /// Each operation as a formula in which the operations with a name are that name.
    fn expressions(&self, names: &[Option<Expr>]) -> Vec<Expr> {
        let mut own: Vec<Expr> = Vec::with_capacity(self.ops.len());
        for (op, _) in &self.ops {
            let at = |n: &u32| names[*n as usize].unwrap_or(own[*n as usize]);
            let value = |v: &Value| signed(at(&v.node), v.negative);
            let e = match op {
                Op::Number(r) => r.clone().into(),
                Op::Pi => Expr::pi(),
                Op::Input(s) => (*s).into(),
                Op::Add(a, b) => at(a) + at(b),
                Op::Sub(a, b) => at(a) - at(b),
                Op::Mul(a, b) if self.rank(*b) < self.rank(*a) => at(b) * at(a),
                Op::Mul(a, b) => at(a) * at(b),
                Op::Div(a, b) => at(a) / at(b),
                Op::Sqrt(a) => value(a).sqrt(),
                Op::Sin(a) => at(a).sin(),
                Op::Cos(a) => at(a).cos(),
                Op::Atan2(a, b) => value(a).atan2(value(b)),
                Op::Sign(a) => at(a).sign(),
            };
            own.push(e);
        }
        own
    }

    /// The order of factors in a product: constants, then inputs, sines and cosines, then what is computed.
    fn rank(&self, n: u32) -> (Stage, u8) {
        let (op, stage) = &self.ops[n as usize];
        let kind = match op {
            Op::Number(_) | Op::Pi => 0,
            Op::Input(_) => 1,
            Op::Sin(_) | Op::Cos(_) => 2,
            Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..) => 3,
            Op::Sqrt(_) | Op::Atan2(..) | Op::Sign(_) => 3,
        };
        (*stage, kind)
    }
}

/// A sum with its positive terms first, for reading: −(a·b − c) becomes c − a·b.
fn tidy(e: Expr) -> Expr {
    let mut terms: Vec<(bool, Expr)> = vec![];
    let mut pending = vec![(false, e)];
    while let Some((negative, part)) = pending.pop() {
        match part.node() {
            Node::Neg(a) => pending.push((!negative, a)),
            Node::Add(a, b) => pending.extend([(negative, b), (negative, a)]),
            Node::Sub(a, b) => pending.extend([(!negative, b), (negative, a)]),
            _ => terms.push((negative, part)),
        }
    }
    let plain = terms.iter().filter(|t| !t.0).map(|t| t.1).reduce(|a, b| a + b);
    let negated = terms.iter().filter(|t| t.0).map(|t| t.1);
    match plain {
        Some(plain) => negated.fold(plain, |sum, term| sum - term),
        None => negated.reduce(|a, b| a + b).map_or(e, |sum| -sum),
    }
}

/// The first name `prefix1`, `prefix2`, … behind the last that is not used.
fn numbered(prefix: &str, last: &mut u32, used: &mut FxHashSet<String>) -> String {
    loop {
        *last += 1;
        let name = format!("{prefix}{last}");
        if used.insert(name.clone()) {
            return name;
        }
    }
}

/// For each operation, whether it is an input, a sum of inputs, or a difference of two.
fn plain_sums(ops: &[(Op, Stage)]) -> Vec<bool> {
    let is_input = |n: u32| matches!(ops[n as usize].0, Op::Input(_));
    let mut plain = vec![false; ops.len()];
    for (i, (op, _)) in ops.iter().enumerate() {
        plain[i] = match op {
            Op::Input(_) => true,
            Op::Add(a, b) => plain[*a as usize] && plain[*b as usize],
            Op::Sub(a, b) => is_input(*a) && is_input(*b),
            Op::Number(_) | Op::Pi | Op::Mul(..) | Op::Div(..) => false,
            Op::Sqrt(_) | Op::Sin(_) | Op::Cos(_) | Op::Atan2(..) | Op::Sign(_) => false,
        };
    }
    plain
}

/// For each operation, whether it is read by sines and cosines alone, or by sums that are.
fn only_in_angles(ops: &[(Op, Stage)], outputs: &[(String, Value)]) -> Vec<bool> {
    let mut only = vec![true; ops.len()];
    outputs.iter().for_each(|o| only[o.1.node as usize] = false);
    for (i, (op, _)) in ops.iter().enumerate().rev() {
        let passes_on = match op {
            Op::Sin(_) | Op::Cos(_) => true,
            Op::Add(..) | Op::Sub(..) => only[i],
            _ => false,
        };
        if !passes_on {
            op.nodes().for_each(|o| only[o as usize] = false);
        }
    }
    only
}

fn signed(e: Expr, negative: bool) -> Expr {
    if negative { -e } else { e }
}

/// The names of a program: inputs, shared values, results.
pub(crate) fn names_of(program: &Program) -> FxHashSet<String> {
    let inputs = program.variables().iter().chain(program.parameters());
    let mut names: FxHashSet<String> = inputs.map(|s| s.name().to_string()).collect();
    names.extend((0..program.ops().len() as u32).filter_map(|n| program.name(n).map(str::to_string)));
    names.extend(program.outputs().iter().map(|o| o.0.clone()));
    names
}
