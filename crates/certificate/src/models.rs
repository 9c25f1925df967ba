//! What is claimed of forward models, Jacobians and their determinants.

use crate::arm::{Frame, View};
use crate::claims::{Certificate, Quantity};
use crate::field::Obstacle;
use denavit::description::Description;
use denavit::forward::{ForwardModel, Outputs};
use denavit::velocity::{JacobianModel, Minor, Viewpoint};
use denavit_program::Program;
use denavit_symbolic::{Expr, Symbol};

/// Claims that the matrix and the program of a forward model are the product of the links.
pub fn forward(description: &Description, model: &ForwardModel, outputs: Outputs) -> Certificate {
    let mut formulas: Vec<Expr> = model.matrix.iter().flatten().flatten().copied().collect();
    formulas.extend(model.algorithm.formulas());
    let mut certificate = Certificate::new(description, &formulas);
    let entry = |place| Quantity::Frame { from: model.from.into(), to: model.to.into(), place };
    match &model.matrix {
        Ok(matrix) => {
            for (i, row) in matrix.iter().enumerate().take(3) {
                for (k, &e) in row.iter().enumerate() {
                    let name = format!("matrix {} {}", i + 1, k + 1);
                    certificate.claim(name, entry((i, k)), Quantity::Formula(e));
                }
            }
        }
        Err(_) => certificate.missing.push(("matrix".into(), Obstacle::TooLarge)),
    }
    let lefts = outputs.places().into_iter().map(entry).collect();
    algorithm(&mut certificate, &model.algorithm, lefts);
    certificate
}

/// Claims that the results of a program, computed step by step, are these.
fn algorithm(certificate: &mut Certificate, program: &Program, wanted: Vec<Quantity>) {
    let results = steps(certificate, program);
    for ((name, _), left) in program.outputs().iter().zip(wanted) {
        let right = Expr::symbol(name);
        if results.contains(name) {
            certificate.claim(format!("algorithm {name}"), left, Quantity::Formula(right));
        }
    }
}

/// Defines the steps of a program; the names of those that are.
fn steps(certificate: &mut Certificate, program: &Program) -> Vec<String> {
    let mut defined = vec![];
    for step in program.steps() {
        match certificate.define(Symbol::new(&step.name), Quantity::Formula(step.value)) {
            Ok(()) => defined.push(step.name),
            Err(why) => certificate.missing.push((format!("algorithm {}", step.name), why)),
        }
    }
    defined
}

/// Claims that the entries of a Jacobian are what joints do to a body, and these minors its determinants.
pub fn jacobian(description: &Description, model: &JacobianModel, minors: &[Minor]) -> Certificate {
    let matrix = model.matrix.as_ref();
    let mut formulas: Vec<Expr> = matrix.iter().flat_map(|m| &m.columns).flatten().copied().collect();
    formulas.extend(minors.iter().map(|m| m.determinant.to_expr()));
    formulas.extend(model.algorithm.formulas());
    let mut certificate = Certificate::new(description, &formulas);
    let view = view(&model.view);
    match &model.matrix {
        Ok(matrix) => {
            for (joint, column) in matrix.columns.iter().enumerate() {
                for (row, &e) in column.iter().enumerate() {
                    let name = format!("jacobian {} {}", row + 1, joint + 1);
                    let left = Quantity::Jacobian { view: view.clone(), row, joint };
                    certificate.claim(name, left, Quantity::Formula(e));
                }
            }
        }
        Err(_) => certificate.missing.push(("jacobian".into(), Obstacle::TooLarge)),
    }
    for minor in minors {
        let number = |all: &[usize]| all.iter().map(|k| (k + 1).to_string()).collect::<String>();
        let name = format!("determinant {} {}", number(&minor.rows), number(&minor.joints));
        certificate.determinant(&name, &view, &minor.rows, &minor.joints, minor.determinant.to_expr());
    }
    let n = certificate.variables.len();
    let entry = |k: usize| Quantity::Jacobian { view: view.clone(), row: k / n, joint: k % n };
    let lefts = (0..6 * n).map(entry).collect();
    algorithm(&mut certificate, &model.algorithm, lefts);
    certificate
}

fn view(view: &Viewpoint<Expr>) -> View {
    let frame = |f| Frame::from(f);
    View { body: frame(view.body), axes: frame(view.axes), at: frame(view.at), offset: view.offset.0 }
}
