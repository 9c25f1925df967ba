//! Programs of Jacobians for evaluators and generated code: one pass along the chain, parallel axes merged.

use super::geometric::Viewpoint;
use crate::description::Description;
use crate::geometry::Vector;
use crate::mechanism::{Reference, Robot, Twist, Walk};
use denavit_program::{Graph, Program, Value};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashSet;

/// The name of an entry, counted from 0, of a matrix with so many columns.
pub(super) fn entry_name(row: usize, column: usize, columns: usize) -> String {
    let between = if columns > 9 { "_" } else { "" };
    format!("j{}{between}{}", row + 1, column + 1)
}

/// The Jacobian, 6 × n, row by row: `j11` … `j6n`; rows as in [`super::ROWS`].
///
/// # Panics
/// If the robot has no such frame.
pub fn jacobian_program(description: &Description, view: &Viewpoint<Expr>) -> Program {
    Columns::new(description, view).program(&[])
}

/// The Jacobian, then the sixteen entries `t11` … `t44` of the body's pose in the base.
///
/// # Panics
/// If the robot has no such frame.
pub fn jacobian_and_pose_program(description: &Description, view: &Viewpoint<Expr>) -> Program {
    let columns = Columns::new(description, view);
    let pose = columns.walk.place(view.body).matrix();
    let entry = |r: usize, c: usize| (format!("t{}{}", r + 1, c + 1), pose[r][c]);
    let entries: Vec<(String, Expr)> = (0..16).map(|k| entry(k / 4, k % 4)).collect();
    columns.program(&entries)
}

/// The columns as products along the chain.
struct Columns {
    variables: Vec<Symbol>,
    parameters: Vec<Symbol>,
    walk: Walk<Expr>,
    columns: Vec<Twist<Expr>>,
}

impl Columns {
    fn new(description: &Description, view: &Viewpoint<Expr>) -> Self {
        let robot = Robot::symbolic(description);
        let walk = Walk::merged(description);
        let point = walk.place(view.at).act_on_point(view.offset);
        let mut columns = vec![[Vector::zero(); 2]; robot.joints];
        walk.twists(&robot, view.body, point, &mut columns);
        if view.axes != Reference::Base {
            let turn = walk.place(view.axes).rotation.inverse();
            columns.iter_mut().flatten().for_each(|v| *v = turn * *v);
        }
        let variables = description.variables().iter().map(|v| v.symbol).collect();
        let parameters = description.parameters.iter().map(|p| p.symbol).collect();
        Columns { variables, parameters, walk, columns }
    }

    /// The columns and more results as a program.
    fn program(&self, more: &[(String, Expr)]) -> Program {
        let taken: FxHashSet<String> =
            self.variables.iter().chain(&self.parameters).map(|s| s.name().to_string()).collect();
        let mut graph = Graph::new(&self.variables, &self.parameters);
        let n = self.columns.len();
        let mut results: Vec<(String, Value)> = vec![];
        for r in 0..6 {
            for (c, [linear, angular]) in self.columns.iter().enumerate() {
                let entry = if r < 3 { linear[r] } else { angular[r - 3] };
                results.push((entry_name(r, c, n), graph.trace(entry)));
            }
        }
        for (name, entry) in more {
            results.push((name.clone(), graph.trace(*entry)));
        }
        Program::new(&graph, &results, |_| None, &taken)
    }
}
