//! Programs to test with.

pub mod solvers;

use denavit_program::{Graph, Program, Value};
use denavit_symbolic::{Expr, Rational, Symbol};
use proptest::collection::vec;
use proptest::prelude::*;

/// A program of formulas.
pub fn program(variables: &[&str], parameters: &[&str], formulas: &[(&str, Expr)]) -> Program {
    let [variables, parameters] = [variables, parameters].map(symbols);
    let mut graph = Graph::new(&variables, &parameters);
    let outputs: Vec<(String, Value)> =
        formulas.iter().map(|(name, e)| (name.to_string(), graph.trace(*e))).collect();
    finished(&graph, &outputs)
}

pub fn symbols(names: &[&str]) -> Vec<Symbol> {
    names.iter().map(|n| Symbol::new(n)).collect()
}

fn finished(graph: &Graph, outputs: &[(String, Value)]) -> Program {
    let inputs = graph.variables().iter().chain(graph.parameters());
    Program::new(graph, outputs, |_| None, &inputs.map(|s| s.name().to_string()).collect())
}

/// An operation of a random program, its operands, and signs for them.
pub type Step = (u8, u8, u8, bool, bool);

/// Steps of [`random`].
pub fn steps(most: usize) -> impl Strategy<Value = Vec<Step>> {
    vec((0..9_u8, any::<u8>(), any::<u8>(), any::<bool>(), any::<bool>()), 1..most)
}

/// A smooth program of variables x, y, z and a parameter a. If these are at most π in magnitude, all values are:
/// sums are halved, products quartered, and no divisor or root comes near 0.
pub fn random(steps: &[Step], outputs: usize) -> Program {
    let mut graph = Graph::new(&symbols(&["x", "y", "z"]), &symbols(&["a"]));
    let mut values: Vec<Value> = ["x", "y", "z", "a"].map(|n| graph.input(Symbol::new(n))).to_vec();
    values.push(graph.number(&Rational::new(3, 2)));
    values.push(graph.trace(Expr::pi()));
    let [one, half, quarter] = [1, 2, 4].map(|d| graph.number(&Rational::new(1, d)));
    for (op, a, b, a_negative, b_negative) in steps {
        let [a, b] = [(a, a_negative), (b, b_negative)].map(|(n, negative)| {
            let v = values[values.len() - 1 - usize::from(*n) % values.len()];
            if *negative { -v } else { v }
        });
        let square = graph.mul(b, b);
        let positive = graph.add(square, one);
        let v = match op {
            0 => {
                let sum = graph.add(a, b);
                graph.mul(sum, half)
            }
            1 => {
                let difference = graph.sub(a, b);
                graph.mul(difference, half)
            }
            2 => {
                let product = graph.mul(a, b);
                graph.mul(product, quarter)
            }
            3 => graph.div(a, positive),
            4 => {
                let root = graph.sqrt(positive);
                graph.mul(root, half)
            }
            5 => graph.sin(a),
            6 => graph.cos(a),
            7 => graph.atan2(a, positive),
            // in the left half plane, above the real axis
            _ => graph.atan2(positive, a),
        };
        values.push(v);
    }
    let last = values.len();
    let outputs: Vec<(String, Value)> =
        (0..outputs).map(|k| (format!("f{k}"), values[last - 1 - k.min(last - 1)])).collect();
    finished(&graph, &outputs)
}
