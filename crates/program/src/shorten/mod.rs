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
