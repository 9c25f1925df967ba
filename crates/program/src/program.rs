//! A straight-line program: the nodes that some outputs need, in order, the shared ones named.

use crate::count::Count;
use crate::graph::{Graph, Op, Stage, Value};
use denavit_symbolic::{Expr, Node, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// A straight-line program.
#[derive(Clone, Debug)]
pub struct Program {
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
    /// The part of a graph that `outputs` need. `hint` proposes names for shared values; names in `taken` are
    /// avoided, and values without a proposal are numbered `m1`, `m2`, ….
    pub fn new<F: Fn(Symbol) -> Stage>(
        graph: &Graph<F>,
        outputs: &[(String, Value)],
        hint: impl Fn(u32) -> Option<String>,
        taken: &FxHashSet<String>,
    ) -> Self {
        let values: Vec<Value> = outputs.iter().map(|o| o.1).collect();
        let nodes = graph.reach(&values);
        let place: FxHashMap<u32, u32> = nodes.iter().enumerate().map(|(i, &n)| (n, i as u32)).collect();
        let at = |n: u32| place[&n];
        let moved = |v: Value| Value { node: place[&v.node], negative: v.negative };
        let ops: Vec<(Op, Stage)> = nodes
            .iter()
            .map(|&n| {
                let op = match graph.op(n).clone() {
                    op @ (Op::Number(_) | Op::Pi | Op::Input(_)) => op,
                    Op::Add(a, b) => Op::Add(at(a), at(b)),
                    Op::Sub(a, b) => Op::Sub(at(a), at(b)),
                    Op::Mul(a, b) => Op::Mul(at(a), at(b)),
                    Op::Div(a, b) => Op::Div(at(a), at(b)),
                    Op::Sqrt(a) => Op::Sqrt(moved(a)),
                    Op::Sin(a) => Op::Sin(at(a)),
                    Op::Cos(a) => Op::Cos(at(a)),
                    Op::Atan2(a, b) => Op::Atan2(moved(a), moved(b)),
                };
                (op, graph.stage(n))
            })
            .collect();
        let outputs: Vec<(String, Value)> =
            outputs.iter().map(|(name, v)| (name.clone(), moved(*v))).collect();

        let mut uses = vec![0_u32; ops.len()];
        for (op, _) in &ops {
            op.operands().for_each(|o| uses[o as usize] += 1);
        }
        outputs.iter().for_each(|o| uses[o.1.node as usize] += 1);
        let mut used: FxHashSet<String> = taken.clone();
        used.extend(outputs.iter().map(|o| o.0.clone()));
        let in_angles = only_in_angles(&ops, &outputs);
        let mut names = vec![None; ops.len()];
        for (i, (op, stage)) in ops.iter().enumerate() {
            let is_leaf = matches!(op, Op::Number(_) | Op::Pi | Op::Input(_));
            if uses[i] < 2 || *stage == Stage::Constant || is_leaf || in_angles[i] {
                continue;
            }
            // A sine or cosine of a sum of inputs has a short name of its own.
            let prefix = match op {
                Op::Sin(a) | Op::Cos(a) if is_plain_sum(&ops, *a) => continue,
                Op::Sin(_) => "sa",
                Op::Cos(_) => "ca",
                _ => "m",
            };
            let proposed = hint(nodes[i]).filter(|name| used.insert(name.clone()));
            names[i] = Some(proposed.unwrap_or_else(|| numbered(prefix, &mut used)));
        }
        Program { ops, outputs, names }
    }

    /// Results and where they come from.
    pub fn outputs(&self) -> &[(String, Value)] {
        &self.outputs
    }

    /// The inputs that are read, in order of first use.
    pub fn inputs(&self) -> Vec<Symbol> {
        self.ops.iter().filter_map(|(op, _)| if let Op::Input(s) = op { Some(*s) } else { None }).collect()
    }

    /// Its operations.
    pub fn count(&self) -> Count {
        let (mut count, mut angles) = (Count::default(), vec![]);
        let look = |n: u32| (&self.ops[n as usize].0, self.ops[n as usize].1);
        (0..self.ops.len() as u32).for_each(|n| count.include(n, look, &mut angles));
        count
    }

    /// The outputs in double precision; `input` gives the inputs.
    ///
    /// # Errors
    /// The first input without a value.
    pub fn eval(&self, input: impl Fn(Symbol) -> Option<f64>) -> Result<Vec<f64>, Symbol> {
        let mut values: Vec<f64> = Vec::with_capacity(self.ops.len());
        for (op, _) in &self.ops {
            let at = |n: &u32| values[*n as usize];
            let signed =
                |v: &Value| if v.negative { -values[v.node as usize] } else { values[v.node as usize] };
            let x = match op {
                Op::Number(r) => r.to_f64(),
                Op::Pi => std::f64::consts::PI,
                Op::Input(s) => input(*s).ok_or(*s)?,
                Op::Add(a, b) => at(a) + at(b),
                Op::Sub(a, b) => at(a) - at(b),
                Op::Mul(a, b) => at(a) * at(b),
                Op::Div(a, b) => at(a) / at(b),
                Op::Sqrt(a) => signed(a).sqrt(),
                Op::Sin(a) => at(a).sin(),
                Op::Cos(a) => at(a).cos(),
                Op::Atan2(a, b) => signed(a).atan2(signed(b)),
            };
            values.push(x);
        }
        let signed = |v: Value| if v.negative { -values[v.node as usize] } else { values[v.node as usize] };
        Ok(self.outputs.iter().map(|o| signed(o.1)).collect())
    }

    /// The outputs as formulas in the inputs, nothing abbreviated (shared parts are shared nodes).
    pub fn formulas(&self) -> Vec<Expr> {
        let values = self.expressions(&vec![None; self.ops.len()]);
        self.outputs.iter().map(|o| signed(values[o.1.node as usize], o.1.negative)).collect()
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
            Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..) | Op::Sqrt(_) | Op::Atan2(..) => 3,
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

/// The first of `prefix1`, `prefix2`, … that is not used.
fn numbered(prefix: &str, used: &mut FxHashSet<String>) -> String {
    let mut number = 1;
    loop {
        let name = format!("{prefix}{number}");
        if used.insert(name.clone()) {
            return name;
        }
        number += 1;
    }
}

/// True for an input, a sum of inputs, or a difference of two.
fn is_plain_sum(ops: &[(Op, Stage)], n: u32) -> bool {
    match &ops[n as usize].0 {
        Op::Input(_) => true,
        Op::Add(a, b) => is_plain_sum(ops, *a) && is_plain_sum(ops, *b),
        Op::Sub(a, b) => [a, b].iter().all(|n| matches!(ops[**n as usize].0, Op::Input(_))),
        _ => false,
    }
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
            op.operands().for_each(|o| only[o as usize] = false);
        }
    }
    only
}

fn signed(e: Expr, negative: bool) -> Expr {
    if negative { -e } else { e }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_parts_are_computed_once_and_signs_are_free() {
        let [a, b, x] = ["a", "b", "x"].map(Expr::symbol);
        let stage = |s: Symbol| if &*s.name() == "x" { Stage::Variable } else { Stage::Parameter };
        let mut graph = Graph::new(stage);
        let u = graph.trace((a + b) * x.cos());
        let v = graph.trace(-(x.cos() * (b + a)) + x.sin());
        let outputs = [("u".to_string(), u), ("v".to_string(), v)];
        let program = Program::new(&graph, &outputs, |_| None, &FxHashSet::default());
        let count = program.count();
        assert_eq!((count.multiplications, count.additions, count.sincos, count.hoisted), (1, 1, 1, 1));
        let value = |s: Symbol| match &*s.name() {
            "a" => Some(2.0),
            "b" => Some(3.0),
            "x" => Some(0.5),
            _ => None,
        };
        let (s, c) = 0.5_f64.sin_cos();
        assert_eq!(program.eval(value), Ok(vec![5.0 * c, s - 5.0 * c]));
        assert_eq!(program.formulas()[0].eval(value), Ok(5.0 * c));
        let steps: Vec<String> = program.steps().iter().map(|s| s.name.clone()).collect();
        assert_eq!(steps, ["u", "v"]);
        assert_eq!(
            program.steps()[1].value.eval(|s| if &*s.name() == "u" { Some(1.0) } else { value(s) }),
            Ok(s - 1.0)
        );
    }
}
