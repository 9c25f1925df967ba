//! Programs made shorter: the same values, exactly, and never more operations.

use crate::support::{program, symbols};
use denavit_program::{Count, Graph, Program, Residue, Value};
use denavit_symbolic::{Expr, Rational, Symbol};
use proptest::collection::vec;
use proptest::prelude::*;
use rustc_hash::FxHashSet;

/// The results at a point modulo a prime.
fn residues(p: &Program, seed: u64) -> Vec<Option<u64>> {
    let inputs: Vec<Symbol> = p.variables().iter().chain(p.parameters()).copied().collect();
    let at = |s: Symbol| {
        let k = inputs.iter().position(|i| *i == s)? as u64 + 1;
        Some(Residue::input(seed.wrapping_mul(0x9e37_79b9).wrapping_add(k * k * 7919), seed ^ (k << 20)))
    };
    p.eval(at).expect("all inputs have values").iter().map(Residue::get).collect()
}

#[track_caller]
fn check(formulas: &[(&str, Expr)], multiplications: u32, additions: u32) -> Program {
    let long = program(&["x", "y", "z", "u", "v", "w"], &["P", "Q"], formulas);
    let short = long.shortened(4);
    let Count { multiplications: m, additions: a, .. } = short.count();
    assert_eq!((m, a), (multiplications, additions), "{long}\n{short}");
    for seed in [3, 77] {
        assert_eq!(residues(&short, seed), residues(&long, seed), "{long}\n{short}");
    }
    short
}

#[test]
fn each_rule_saves() {
    let [x, y, z, u, v, w, p, q] = ["x", "y", "z", "u", "v", "w", "P", "Q"].map(Expr::symbol);
    // A factor of variables, of parameters, and one that stands there itself.
    check(&[("f", x * y + x * z)], 1, 1);
    check(&[("f", p * y - p * z + p * u)], 1, 2);
    check(&[("f", x * p + x * q + y)], 1, 1);
    check(&[("f", x + x * y + x * z)], 1, 2);
    check(&[("f", x * y * u - z * y * v * u)], 3, 1);
    // A shared sum written out: alone, and with another.
    let squares = x * x + y * y;
    check(&[("f", squares), ("g", squares - y * y)], 2, 1);
    check(&[("f", x - y), ("g", z + y), ("h", (x - y) + (z + y))], 0, 3);
    check(&[("f", (x + y) * u), ("g", (z - y) * v), ("h", ((x + y) + (z - y)) * w)], 3, 3);
    // Written out it is another sum, or the opposite of one.
    let (a, b) = (x + u, y + u);
    check(&[("f", a * v), ("g", b * w), ("h", (a - b) * z), ("k", (x - y) * q)], 4, 3);
    check(&[("f", a * v), ("g", b * w), ("h", (b - a) * z), ("k", (x - y) * q)], 4, 3);
    // What several sums or products have in common, up to the sign.
    check(&[("f", x + y + z), ("g", u - x - y)], 0, 3);
    check(&[("f", x * y * z), ("g", u * (x * y))], 3, 0);
    check(&[("f", x * y * z * z), ("g", z * (u * (x * z)))], 4, 0);
    // Twice is an addition.
    check(&[("f", (x + y) - (z - x))], 0, 3);
    check(&[("f", x * x)], 1, 0);
    // Everything cancels.
    check(&[("f", (x + y) - (y + x)), ("g", x - (x - y))], 0, 0);
}

#[test]
fn what_stays_keeps_its_name() {
    let [x, y, z, u] = ["x", "y", "z", "u"].map(Symbol::new);
    let mut graph = Graph::new(&[x, y, z, u], &[]);
    let [a, b, c, d] = [x, y, z, u].map(|s| graph.input(s));
    let (sum, ab, ac) = (graph.add(a, b), graph.mul(a, b), graph.mul(a, c));
    let both = graph.add(ab, ac);
    let results = [graph.mul(sum, d), graph.mul(sum, both)];
    let outputs: Vec<(String, Value)> = ["f", "g"].map(String::from).into_iter().zip(results).collect();
    let name = |n: u32| (n == sum.node).then(|| "both".to_string());
    let long = Program::new(&graph, &outputs, name, &FxHashSet::default());
    let short = long.shortened(0);
    assert!(short.count().cost() < long.count().cost());
    let names: Vec<&str> = (0..short.ops().len() as u32).filter_map(|n| short.name(n)).collect();
    assert_eq!(names, ["both"]);
}

/// Sums of thousands of terms and long chains: the factor that all terms have is taken out of them at once.
#[test]
fn large_programs_are_shortened() {
    let x: Vec<Expr> = (0..3000).map(|k| Expr::symbol(&format!("x{k}"))).collect();
    let names: Vec<String> = (0..3000).map(|k| format!("x{k}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let sum = x.iter().fold(Expr::int(0), |sum, &e| sum + e * x[0]);
    let chain = x.iter().fold(Expr::int(1), |all, &e| all * e + x[1]);
    let long = program(&names, &[], &[("f", sum), ("g", chain)]);
    let short = long.shortened(0);
    // x0 (x0 + … + x2999), and the chain as it is: a product and a sum a term, of which x0 + x1 is one already.
    let Count { multiplications, additions, .. } = short.count();
    assert_eq!((multiplications, additions), (1 + 2999, 2999 + 3000 - 1), "{}", long.count());
    assert_eq!(residues(&short, 5), residues(&long, 5));
}

proptest! {
    #[test]
    fn values_are_the_same_and_operations_no_more(
        steps in vec((0..4_u8, any::<u8>(), any::<u8>(), any::<bool>()), 1..60),
        orders in 0..3_u64,
    ) {
        let mut graph = Graph::new(&symbols(&["x", "y", "z"]), &symbols(&["a", "b"]));
        let mut values: Vec<Value> =
            ["x", "y", "z", "a", "b"].map(|n| graph.input(Symbol::new(n))).to_vec();
        values.extend([1, 2].map(|n| graph.number(&Rational::from(n))));
        for (op, a, b, negative) in steps {
            let [a, b] = [a, b].map(|n| values[values.len() - 1 - usize::from(n) % values.len().min(12)]);
            let b = if negative { -b } else { b };
            let v = match op {
                0 | 1 => graph.add(a, b),
                2 => graph.mul(a, b),
                _ => {
                    let s = graph.input(Symbol::new("x"));
                    let s = graph.sin(s);
                    graph.mul(s, b)
                }
            };
            values.push(v);
        }
        let last = &values[values.len().saturating_sub(5)..];
        let outputs: Vec<(String, Value)> =
            last.iter().enumerate().map(|(k, v)| (format!("f{k}"), *v)).collect();
        let long = Program::new(&graph, &outputs, |_| None, &FxHashSet::default());
        let short = long.shortened(orders);
        prop_assert_eq!(residues(&short, 9), residues(&long, 9), "{}\n{}", long, short);
        prop_assert_eq!(short.to_string(), long.shortened(orders).to_string());
    }
}
