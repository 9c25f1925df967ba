//! What holds a wrench that the tool exerts: Jᵀ w, with the Jacobian of the tool in the base.

use super::held::same;
use super::{inputs, named};
use crate::description::Description;
use crate::dynamics::expansion::are_equal;
use crate::dynamics::lagrange::{EXPANDED, Ground, program};
use crate::dynamics::model::Formulas;
use crate::geometry::{Rotation, Transform, Vector};
use crate::velocity::{Viewpoint, jacobian_program};
use denavit_program::{Composer, Program, Value};
use denavit_symbolic::{Expr, Symbol};

/// Khalil and Dombre's letters for the force and the moment.
const LETTERS: [&str; 6] = ["FX", "FY", "FZ", "CX", "CY", "CZ"];

/// Names for the components.
pub(super) fn names(formulas: &Formulas, state: &[Vec<Symbol>; 4]) -> Vec<Symbol> {
    let known = |s: Symbol| {
        formulas.parameters.iter().any(|p| p.symbol == s) || state.iter().flatten().any(|k| *k == s)
    };
    let named = |letters: &str| {
        let mut name = letters.to_string();
        while known(Symbol::new(&name)) {
            name.push('_');
        }
        Symbol::new(&name)
    };
    LETTERS.into_iter().map(named).collect()
}

/// The torques of a program with those that hold the wrench, and on what it rests that these are Jᵀ w by the derivative of the product
/// of the transforms.
pub(super) fn added(
    d: &Description,
    formulas: &Formulas,
    torques: &Program,
    wrench: &[Symbol],
) -> (Program, Ground) {
    let short = held(&jacobian_program(d, &Viewpoint::tool()), formulas, wrench).shortened(super::ORDERS);
    let wanted = definition(formulas, wrench);
    let ground = match are_equal(formulas, &short, &wanted) {
        true => Ground::Proved,
        false => same(&short, &wanted, formulas.q.len() <= EXPANDED),
    };
    let (short, ground) = match ground {
        Ground::Failed => (wanted, Ground::Proved),
        _ => (short, ground),
    };
    let mut parameters: Vec<Symbol> = torques.parameters().to_vec();
    let more: Vec<Symbol> = short.parameters().iter().copied().filter(|s| !parameters.contains(s)).collect();
    parameters.extend(more);
    parameters.sort_by_key(|s| formulas.parameters.iter().position(|p| p.symbol == *s).unwrap_or(usize::MAX));
    let mut all = Composer::new(&[torques.variables(), wrench].concat(), &parameters);
    let moving = all.copy(torques, |_| None);
    let holding = all.copy(&short, |_| None);
    let graph = all.graph();
    let both: Vec<Value> = moving.into_iter().zip(holding).map(|(t, h)| graph.add(t, h)).collect();
    (all.finish(&named("t", both)), ground)
}

/// Jᵀ w by a program of J, row by row.
fn held(jacobian: &Program, formulas: &Formulas, wrench: &[Symbol]) -> Program {
    let n = formulas.q.len();
    let read: Vec<Symbol> = inputs(jacobian).collect();
    let parameters: Vec<Symbol> =
        jacobian.parameters().iter().copied().filter(|s| read.contains(s)).collect();
    let mut all = Composer::new(&[&formulas.q[..], wrench].concat(), &parameters);
    let entries = all.copy(jacobian, |_| None);
    let graph = all.graph();
    let w: Vec<Value> = wrench.iter().map(|&s| graph.input(s)).collect();
    let mut held = vec![];
    for j in 0..n {
        let parts: Vec<Value> = (0..6).map(|r| graph.mul(entries[n * r + j], w[r])).collect();
        held.push(parts.into_iter().reduce(|a, b| graph.add(a, b)).expect("six of them"));
    }
    all.finish(&named("t", held))
}

/// The power of the wrench by each rate: f·∂p/∂q + m·ω with ω^ = ∂R/∂q Rᵀ.
fn definition(formulas: &Formulas, wrench: &[Symbol]) -> Program {
    let [q, _, _] = formulas.state();
    let arm = &formulas.dynamics;
    let x = arm.links.iter().fold(Transform::identity(), |x, link| x * link.place(&q)) * arm.tool;
    let entries: Vec<Expr> =
        x.rotation.rows().as_flattened().iter().chain(&x.translation.0).copied().collect();
    let slopes = program(&formulas.q, &entries).jacobian().formulas();
    let n = q.len();
    let [force, moment] = [0, 3].map(|first| Vector([0, 1, 2].map(|i| Expr::from(wrench[first + i]))));
    let torque = |j: usize| {
        let by = |entry: usize| slopes[n * entry + j];
        let turned = Rotation::from_rows([0, 1, 2].map(|i| [0, 1, 2].map(|k| by(3 * i + k))));
        let spin = (turned * x.rotation.inverse()).rows();
        let turning = Vector([spin[2][1], spin[0][2], spin[1][0]]);
        force.dot(Vector([by(9), by(10), by(11)])) + moment.dot(turning)
    };
    let torques: Vec<Expr> = (0..n).map(torque).collect();
    program(&[&formulas.q[..], wrench].concat(), &torques)
}
