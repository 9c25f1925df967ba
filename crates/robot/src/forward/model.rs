//! The forward model of a robot: any ⁱTⱼ in readable form, with its algorithm, proved.

use crate::description::Description;
use crate::forward::algorithm::{self, Outputs, Proof, entry_name};
use crate::forward::chain::Chain;
use crate::geometry::Transform;
use crate::mechanism::{Reference, Robot};
use denavit_program::{Function, Graph, MissingValue, Program};
use denavit_symbolic::{Expr, Refusal, Ring, Symbol, readable};
use rustc_hash::FxHashSet;

/// A transform between two frames as formulas.
#[derive(Clone, Debug)]
pub struct ForwardModel {
    /// The frame in which the result is given.
    pub from: Reference,
    /// The frame whose pose it is.
    pub to: Reference,
    /// The homogeneous matrix, row-major, each entry simplified and proved equal to the product of the link
    /// transforms; or why it was not expanded.
    pub matrix: Result<[[Expr; 4]; 4], Refusal>,
    /// The shortest program found for the outputs asked for.
    pub algorithm: Program,
    /// Whether the program is proved equal to the product of the link transforms.
    pub proof: Proof,
}

impl ForwardModel {
    /// The algorithm compiled for the lengths of a robot: joint variables in, the outputs of the algorithm out.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn function(&self, description: &Description) -> Result<Function, MissingValue> {
        self.algorithm.compile_with(|s| description.value(s))
    }

    /// The model of the pose of `to` in `from`; the algorithm computes `outputs` of it.
    pub fn derive(description: &Description, from: Reference, to: Reference, outputs: Outputs) -> Self {
        let place = |r: Reference| match r {
            Reference::Base => (0, false),
            Reference::Frame(i) => (i.min(description.rows.len()), true),
            Reference::Tool => (description.rows.len(), true),
        };
        let order = |r: Reference| (place(r), r == Reference::Tool);
        let (first, last) = if order(from) <= order(to) { (from, to) } else { (to, from) };
        let inverted = first != from;
        let (base, tool) = (
            first == Reference::Base && last != Reference::Base,
            last == Reference::Tool && first != Reference::Tool,
        );
        let chain = Chain::new(description, place(first).0, place(last).0, base, tool);

        // The definition: the plain product of the table's own link transforms.
        let robot = Robot::symbolic(description);
        let q: Vec<Expr> = description.variables().iter().map(|v| v.symbol.into()).collect();
        let mut definition = if base { robot.base } else { Transform::identity() };
        for link in &robot.links[place(first).0..place(last).0] {
            definition = definition * link.transform(&q);
        }
        if tool {
            definition = definition * robot.tool;
        }
        let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
        let parameters: Vec<Symbol> = description.parameters.iter().map(|p| p.symbol).collect();
        let taken: FxHashSet<String> =
            parameters.iter().chain(&variables).map(|s| s.name().to_string()).collect();
        let (wanted, chain_result) = if inverted {
            (definition.inverse(), chain.transform().inverse())
        } else {
            (definition, chain.transform())
        };

        let all: Vec<Expr> = wanted.matrix().into_iter().chain(chain_result.matrix()).flatten().collect();
        let mut ring = Ring::with_basis(&chain.angles, &all, &symbol_order(description));
        let matrix = simplified(&mut ring, &wanted);
        let algorithm = if inverted {
            traced(
                matrix.as_ref().unwrap_or(&chain_result.matrix()),
                &variables,
                &parameters,
                outputs,
                &taken,
            )
        } else {
            algorithm::shortest(&chain, &variables, &parameters, outputs, &taken)
        };
        let entries = wanted.matrix();
        let places = outputs.places().into_iter().map(|(row, column)| entries[row][column]);
        let proof = identical(&mut ring, algorithm.formulas().into_iter().zip(places));
        ForwardModel { from, to, matrix, algorithm, proof }
    }

    /// The pose of the tool in the base.
    pub fn of_tool(description: &Description, outputs: Outputs) -> Self {
        Self::derive(description, Reference::Base, Reference::Tool, outputs)
    }
}

/// ⁱ⁻¹Tᵢ for each row, as a person would write them.
pub fn link_transforms(description: &Description) -> Vec<[[Expr; 4]; 4]> {
    let robot = Robot::symbolic(description);
    let q: Vec<Expr> = description.variables().iter().map(|v| v.symbol.into()).collect();
    let order = symbol_order(description);
    let show = |x: &Transform<Expr>| {
        let entries: Vec<Expr> = x.matrix().into_iter().flatten().collect();
        simplified(&mut Ring::new(&entries, &order), x).unwrap_or(x.matrix())
    };
    robot.links.iter().map(|link| show(&link.transform(&q))).collect()
}

/// Parameters in the order of the file, then joint variables.
pub fn symbol_order(description: &Description) -> Vec<Symbol> {
    let parameters = description.parameters.iter().map(|p| p.symbol);
    parameters.chain(description.variables().iter().map(|v| v.symbol)).collect()
}

fn simplified(ring: &mut Ring, x: &Transform<Expr>) -> Result<[[Expr; 4]; 4], Refusal> {
    let mut rows = x.matrix();
    for e in rows.iter_mut().flatten() {
        *e = readable::simplify_in(ring, *e)?.expr;
    }
    Ok(rows)
}

/// Whether the results of a program are these formulas of the robot, one each.
///
/// # Panics
/// If there is not one formula per result.
pub fn prove(description: &Description, program: &Program, wanted: &[Expr]) -> Proof {
    let formulas = program.formulas();
    assert_eq!(formulas.len(), wanted.len(), "one formula per result");
    let chain = Chain::new(description, 0, description.rows.len(), true, true);
    let all: Vec<Expr> = formulas.iter().chain(wanted).copied().collect();
    let mut ring = Ring::with_basis(&chain.angles, &all, &symbol_order(description));
    identical(&mut ring, formulas.into_iter().zip(wanted.iter().copied()))
}

/// Whether the canonical forms of each two formulas are the same.
fn identical(ring: &mut Ring, pairs: impl Iterator<Item = (Expr, Expr)>) -> Proof {
    for (formula, wanted) in pairs {
        match ring.normal(formula - wanted) {
            Ok(difference) if difference.num.is_zero() => {}
            Ok(_) => return Proof::Failed,
            Err(why) => return Proof::Undecided(why),
        }
    }
    Proof::Proved
}

/// The entries as they stand, common parts shared.
fn traced(
    rows: &[[Expr; 4]; 4],
    variables: &[Symbol],
    parameters: &[Symbol],
    outputs: Outputs,
    taken: &FxHashSet<String>,
) -> Program {
    let mut graph = Graph::new(variables, parameters);
    let places = outputs.places().into_iter();
    let results: Vec<_> = places.map(|(r, c)| (entry_name((r, c)), graph.trace(rows[r][c]))).collect();
    Program::new(&graph, &results, |_| None, taken)
}
