//! Programs made shorter by what holds in every ring.
//!
//! Sums and products that nobody else reads are taken into those that read them. Then, as long as operations are saved: shared sums
//! are written out where less is left of them (`(a + b) − b`), a factor is taken out of a sum (`x·y + x·z`), and two terms that
//! several sums have in common, or two factors that several products have, become a value of their own. What saves most comes
//! first. Every value that stays is what it was, so that it keeps its name; roundings are others.

mod moves;
mod net;

use crate::graph::{Op, Stage, Value};
use crate::program::Program;
use crate::rebuild::{Rebuild, apply, signed};
use denavit_symbolic::Rational;
use moves::Moves;
use net::{Net, Part};
use rustc_hash::FxHashSet;

/// Operations beyond which a program is left as it is.
const LARGEST: usize = 20_000;

impl Program {
    /// The same results with fewer operations ([`crate::Count::cost`]), or the program itself. What saves equally much is taken in
    /// order at first, then in so many orders at random; the shortest of all is the one.
    #[must_use]
    pub fn shortened(&self, orders: u64) -> Program {
        if self.ops().len() > LARGEST {
            return self.clone();
        }
        let cost = |p: &Program| (p.count().cost(), p.count().multiplications);
        let all = (0..=orders).map(|order| rebuilt(self, &shortest(self, order)));
        let best = all.min_by_key(cost).filter(|best| cost(best) < cost(self));
        best.unwrap_or_else(|| self.clone())
    }
}

fn shortest(program: &Program, order: u64) -> Net {
    let mut net = Net::new(program);
    let mut moves = Moves::default();
    // Every step saves an operation.
    for step in 0..program.ops().len() as u64 {
        net.settle();
        moves.refresh(&mut net);
        // An order at random is a number for each step (Vigna's splitmix64).
        let mut mixed = (order << 32 | step).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let Some(best) = moves.best(if order == 0 { 0 } else { mixed ^ (mixed >> 31) }) else { break };
        moves.apply(best, &mut net);
    }
    net.settle();
    net
}

/// The program of what is left, in the order of the results.
fn rebuilt(program: &Program, net: &Net) -> Program {
    let mut work = Rebuild::new(program, program.variables(), FxHashSet::default());
    let mut at: Vec<Option<Value>> = vec![None; net.parts.len()];
    let mut pending: Vec<(u32, bool)> = program.outputs().iter().rev().map(|o| (o.1.node, false)).collect();
    while let Some((id, operands_done)) = pending.pop() {
        if at[id as usize].is_some() {
            continue;
        }
        if !operands_done {
            pending.push((id, true));
            pending.extend(net.operands(id).into_iter().rev().map(|o| (o, false)));
            continue;
        }
        let value = |id: u32| at[id as usize].expect("operands come first");
        let graph = &mut work.graph;
        let found = match &net.parts[id as usize] {
            Part::Kept => apply(graph, &program.ops()[id as usize].0, value),
            Part::Number(r) => graph.number(r),
            Part::Sum(terms) => {
                // What parameters add is one number.
                let mut sums = [graph.number(&Rational::ZERO); 2];
                for t in terms {
                    let sum = &mut sums[usize::from(net.stage(t.id) == Stage::Variable)];
                    *sum = graph.add(*sum, signed(value(t.id), t.negative));
                }
                graph.add(sums[1], sums[0])
            }
            Part::Product(factors) => {
                let mut products = [graph.number(&Rational::ONE); 2];
                for &f in factors {
                    let product = &mut products[usize::from(net.stage(f) == Stage::Variable)];
                    *product = graph.mul(*product, value(f));
                }
                let two = graph.number(&Rational::from(2));
                match products {
                    // An addition, which may stand in a sum.
                    [constant, x] if constant == two => graph.add(x, x),
                    [constant, x] => graph.mul(constant, x),
                }
            }
            Part::Gone => unreachable!("what is read is there"),
        };
        at[id as usize] = Some(found);
        if (id as usize) < program.ops().len() && !matches!(program.ops()[id as usize].0, Op::Number(_)) {
            work.keep_name(program, id, found);
        }
    }
    let value = |v: Value| signed(at[v.node as usize].expect("built"), v.negative);
    let outputs: Vec<(String, Value)> =
        program.outputs().iter().map(|(name, v)| (name.clone(), value(*v))).collect();
    work.finish(&outputs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use denavit_symbolic::Symbol;

    /// x₀ e₀ + x₀ e₁ + …, and (((e₀ + x₁) e₁ + x₁) e₂ + x₁) …, whose parts several sums have in common.
    fn visits(count: usize) -> usize {
        let symbols: Vec<Symbol> = (0..count).map(|k| Symbol::new(&format!("x{k}"))).collect();
        let mut graph = Graph::new(&symbols, &[]);
        let inputs: Vec<Value> = symbols.iter().map(|&s| graph.input(s)).collect();
        let (mut sum, mut chain) = (inputs[1], inputs[0]);
        let mut outputs = vec![];
        for (k, &e) in inputs.iter().enumerate() {
            let part = graph.mul(e, inputs[0]);
            sum = graph.add(sum, part);
            chain = graph.mul(chain, e);
            chain = graph.add(chain, inputs[1]);
            let three = graph.add(e, inputs[k / 2]);
            let three = graph.add(three, inputs[1]);
            outputs.push((format!("h{k}"), three));
        }
        outputs.extend([("f".to_string(), sum), ("g".to_string(), chain)]);
        let program = Program::new(&graph, &outputs, |_| None, &FxHashSet::default());
        shortest(&program, 1).visits
    }

    /// What is looked at grows as the program does.
    #[test]
    fn work_is_in_proportion() {
        let [few, many] = [visits(400), visits(1600)];
        assert!(many < 6 * few && many > few, "{few} {many}");
    }
}
