//! How the Jacobian itself changes: J̇, J̇q̇ and the Hessian, as programs.

use super::geometric::{ROWS, Viewpoint};
use super::program::jacobian_program;
use crate::description::Description;
use denavit_program::{Graph, Program, Value};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashSet;

/// The Hessian ∂J/∂q: 6·n·n results, `d_j11_<joint>` …, for each entry of the Jacobian, row by row, its derivative by
/// each joint.
///
/// # Panics
/// If the robot has no such frame.
pub fn hessian_program(description: &Description, view: &Viewpoint<Expr>) -> Program {
    jacobian_program(description, view).jacobian()
}

/// J̇ and J̇q̇ from the joints and their velocities `d<joint>`: 6·n results `dj11` … `dj6n`, row by row, then the six
/// components of J̇q̇, `avx` … `awz`: the acceleration that is there without joint accelerations.
///
/// # Panics
/// If the robot has no such frame.
pub fn rate_program(description: &Description, view: &Viewpoint<Expr>) -> Program {
    let jacobian = jacobian_program(description, view);
    let joints = jacobian.variables().len();
    let tangent = jacobian.tangent();
    let entries = 6 * joints;
    let rates: Vec<Expr> = tangent.formulas().split_off(entries);
    let velocities: Vec<Symbol> = tangent.variables()[joints..].to_vec();
    let mut graph = Graph::new(tangent.variables(), tangent.parameters());
    let mut results: Vec<(String, Value)> = vec![];
    let values: Vec<Value> = rates.iter().map(|&e| graph.trace(e)).collect();
    for ((name, _), &value) in tangent.outputs()[entries..].iter().zip(&values) {
        results.push((name.clone(), value));
    }
    for (row, name) in values.chunks(joints.max(1)).zip(ROWS) {
        let mut sum: Option<Value> = None;
        for (&entry, &velocity) in row.iter().zip(&velocities) {
            let velocity = graph.input(velocity);
            let part = graph.mul(entry, velocity);
            sum = Some(sum.map_or(part, |s| graph.add(s, part)));
        }
        let sum = sum.unwrap_or_else(|| graph.trace(Expr::int(0)));
        results.push((format!("a{name}"), sum));
    }
    let taken: FxHashSet<String> =
        tangent.variables().iter().chain(tangent.parameters()).map(|s| s.name().to_string()).collect();
    Program::new(&graph, &results, |_| None, &taken)
}
