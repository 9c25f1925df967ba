//! Steps in an order in which few values wait: what waits stands in memory once the registers are taken, and loops over lanes, and
//! large functions, are held up by that more than by arithmetic.

use crate::compiled::{Function, Step, formulas};
use denavit_symbolic::Symbol;
use rustc_hash::FxHashMap;

/// With fewer steps all that waits is in registers.
const FEW: usize = 40;
/// With more steps one order is not sought step by step.
const MANY: usize = 4_000;

/// So large a function has no registers left for a second vector, nor, for one state, for all that waits.
const LARGE: u32 = 600;

/// Whether loops over the lanes of a function should take one vector at a time: its flags are as wide as its numbers then, of
/// narrower ones compilers make one vector beside two of numbers.
pub(crate) fn is_large(f: &Function) -> bool {
    f.routine.program.count().cost() >= LARGE
}

/// The steps of a function for one state: those of a large one in the order of blocks.
pub(crate) fn for_one(f: &Function) -> Vec<Step> {
    let body = if is_large(f) { for_blocks(f) } else { f.body.clone() };
    f.hoisted.iter().cloned().chain(body).collect()
}

/// The steps of a function's body for a block: as they are, or in another order if values wait a quarter less in it.
pub(crate) fn for_blocks(f: &Function) -> Vec<Step> {
    let body = &f.body;
    // Sines, cosines and angles stay in front, with what they read.
    let head =
        body.iter().rposition(|s| matches!(s, Step::Pairs(_) | Step::Atan2 { .. })).map_or(0, |k| k + 1);
    let steps: Vec<&Step> = body[head..].iter().filter(|s| !matches!(s, Step::Break)).collect();
    if steps.len() < FEW {
        return body.clone();
    }
    let order = Order::new(&steps);
    let columns = f.shape().last().copied().unwrap_or(1).max(1);
    let place = |k: usize| match steps[k] {
        Step::Result { place, .. } => ((place / columns) as i64, (place % columns) as i64),
        _ => (0, 0),
    };
    let own: Vec<usize> = (0..steps.len()).collect();
    let results: Vec<usize> =
        own.iter().copied().filter(|&k| matches!(steps[k], Step::Result { .. })).collect();
    let mut found = vec![];
    for (down, right, by_column) in (0..8).map(|k| (k & 1 == 0, k & 2 == 0, k & 4 == 0)) {
        let mut sorted = results.clone();
        sorted.sort_by_key(|&k| {
            let (row, column) = place(k);
            let (row, column) = (if down { row } else { -row }, if right { column } else { -column });
            if by_column { (column, row) } else { (row, column) }
        });
        found.push(order.in_depth(&sorted));
    }
    if steps.len() <= MANY {
        found.push(order.backwards());
    }
    let waiting = order.waiting(&own);
    let best = found.into_iter().map(|o| (order.waiting(&o), o)).min_by_key(|o| o.0);
    match best {
        Some((least, order)) if 4 * least < 3 * waiting => {
            body[..head].iter().chain(order.into_iter().map(|k| steps[k])).cloned().collect()
        }
        _ => body.clone(),
    }
}

/// Steps and the steps that each reads.
struct Order {
    reads: Vec<Vec<usize>>,
}

impl Order {
    fn new(steps: &[&Step]) -> Self {
        let mut of: FxHashMap<Symbol, usize> = FxHashMap::default();
        for (k, step) in steps.iter().enumerate() {
            if let Step::Let { name, .. } = step {
                of.insert(Symbol::new(name), k);
            }
        }
        let reads = steps.iter().map(|step| {
            let symbols = formulas(step).into_iter().flat_map(|e| e.symbols());
            let mut reads: Vec<usize> = symbols.filter_map(|s| of.get(&s).copied()).collect();
            reads.sort_unstable();
            reads.dedup();
            reads
        });
        Order { reads: reads.collect() }
    }

    /// How long values wait from where they are computed to where they are read last, added up.
    fn waiting(&self, order: &[usize]) -> usize {
        let mut last = vec![0; self.reads.len()];
        for (at, &k) in order.iter().enumerate() {
            self.reads[k].iter().for_each(|&r| last[r] = at);
        }
        order.iter().enumerate().map(|(at, &k)| last[k].saturating_sub(at)).sum()
    }

    /// Each result behind all that it reads and that is not there yet; what no result reads, at the end.
    fn in_depth(&self, results: &[usize]) -> Vec<usize> {
        let mut is_seen = vec![false; self.reads.len()];
        let mut order = vec![];
        for first in results.iter().copied().chain(0..self.reads.len()) {
            let mut open = vec![(first, false)];
            while let Some((k, is_ready)) = open.pop() {
                if is_ready {
                    order.push(k);
                } else if !is_seen[k] {
                    is_seen[k] = true;
                    open.push((k, true));
                    open.extend(self.reads[k].iter().map(|&r| (r, false)));
                }
            }
        }
        order
    }

    /// From the end: the step whose operands add the fewest to what waits.
    fn backwards(&self) -> Vec<usize> {
        let n = self.reads.len();
        let mut readers = vec![0_usize; n];
        self.reads.iter().flatten().for_each(|&r| readers[r] += 1);
        let mut ready: Vec<usize> = (0..n).filter(|&k| readers[k] == 0).collect();
        let mut waits = vec![false; n];
        let mut order = vec![];
        loop {
            let added = |k: usize| {
                let new = self.reads[k].iter().filter(|&&r| !waits[r]).count() as i64;
                new - i64::from(waits[k])
            };
            let Some(at) =
                (0..ready.len()).min_by_key(|&at| (added(ready[at]), std::cmp::Reverse(ready[at])))
            else {
                break;
            };
            let k = ready.swap_remove(at);
            order.push(k);
            waits[k] = false;
            for &r in &self.reads[k] {
                waits[r] = true;
                readers[r] -= 1;
                if readers[r] == 0 {
                    ready.push(r);
                }
            }
        }
        order.reverse();
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use denavit_symbolic::Expr;

    /// Every order holds each step once, behind what it reads, and the waiting of a known order is known.
    #[test]
    fn orders_are_orders() {
        let x = |k: usize| Expr::symbol(&format!("x{k}"));
        let mut random = 7_u64;
        let mut below = |n: usize| {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (random >> 33) as usize % n
        };
        let mut steps = vec![];
        for k in 0..300 {
            let value = if k == 0 { Expr::int(1) } else { x(below(k)) + x(below(k)) * x(below(k)) };
            steps.push(Step::Let { name: format!("x{k}"), value });
        }
        for place in 0..50 {
            steps.push(Step::Result { place, value: x(below(300)) });
        }
        let steps: Vec<&Step> = steps.iter().collect();
        let order = Order::new(&steps);
        let results: Vec<usize> = (300..350).rev().collect();
        for found in [order.in_depth(&results), order.backwards()] {
            let mut at = vec![usize::MAX; steps.len()];
            found.iter().enumerate().for_each(|(place, &k)| at[k] = place);
            assert!(found.len() == steps.len() && at.iter().all(|&a| a != usize::MAX));
            assert!((0..steps.len()).all(|k| order.reads[k].iter().all(|&r| at[r] < at[k])));
        }
        let three = [
            Step::Let { name: "a".into(), value: Expr::int(1) },
            Step::Let { name: "b".into(), value: Expr::int(2) },
            Step::Result { place: 0, value: Expr::symbol("a") + Expr::symbol("b") },
        ];
        let order = Order::new(&three.iter().collect::<Vec<_>>());
        assert_eq!(order.waiting(&[0, 1, 2]), 3);
    }
}
