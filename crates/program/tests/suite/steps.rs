//! Programs from a graph: what is shared, what is free, and what the steps are called.

use denavit_program::{Graph, Program};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashSet;

#[test]
fn shared_parts_are_computed_once_and_signs_are_free() {
    let [a, b, x] = ["a", "b", "x"].map(Expr::symbol);
    let [variables, parameters] = [&[x][..], &[a, b]]
        .map(|list| list.iter().map(|e| e.as_symbol().expect("a symbol")).collect::<Vec<_>>());
    let mut graph = Graph::new(&variables, &parameters);
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
