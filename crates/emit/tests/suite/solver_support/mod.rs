//! Solvers to emit, and their solutions from other sources.

pub mod mixed;
pub mod ur5;

use denavit_emit::{
    Certificate, KnownSolution, Library, Parameter, Precision, Routine, SolverRoutine, SolverVector, Vector,
};
use denavit_program::solver::Solver;
use denavit_program::{Graph, Program};
use denavit_symbolic::{Expr, Symbol};

/// What a library is made of, so that its solver outlives it.
pub struct Sample {
    pub name: &'static str,
    pub function: &'static str,
    pub argument: &'static str,
    pub result: &'static str,
    pub shape: Vec<usize>,
    pub parameters: Vec<(&'static str, f64)>,
    pub solver: Solver,
    /// A function of one variable beside the solver.
    pub program: Option<Program>,
    pub vectors: Vec<SolverVector>,
    pub words: &'static str,
}

impl Sample {
    pub fn library(&self) -> Library<'_> {
        let parameters = self.parameters.iter().map(|(name, x)| Parameter {
            symbol: Symbol::new(name),
            about: self.words.into(),
            default: Some(*x),
        });
        Library {
            title: format!("Sample {}", self.words),
            name: self.name.into(),
            header: vec!["A table:".into(), self.words.into()],
            variables: self.program.iter().map(|_| (Symbol::new("q1"), self.words.into())).collect(),
            parameters: parameters.collect(),
            routines: self.program.iter().map(turn).collect(),
            solvers: vec![SolverRoutine {
                name: self.function.into(),
                about: vec!["All solutions.".into(), self.words.into()],
                solver: &self.solver,
                usual: vec![],
                argument: self.argument.into(),
                shape: self.shape.clone(),
                result: self.result.into(),
                vectors: self.vectors.clone(),
            }],
            attachments: vec![],
            precision: Precision::Double,
        }
    }
}

fn turn(program: &Program) -> Routine<'_> {
    let at = |q: f64| Vector { variables: vec![q], parameters: vec![], results: vec![q.sin(), q.cos()] };
    Routine {
        name: "turn".into(),
        about: vec!["Sine and cosine.".into()],
        program,
        result: "point".into(),
        shape: vec![2],
        vectors: vec![at(0.5), at(-2.0)],
        scales: vec![1.0; 2],
    }
}

/// The sine and cosine of q1.
fn program() -> Program {
    let q = Expr::symbol("q1");
    let mut graph = Graph::new(&[Symbol::new("q1")], &[]);
    let outputs = [("y".to_string(), graph.trace(q.sin())), ("x".to_string(), graph.trace(q.cos()))];
    Program::new(&graph, &outputs, |_| None, &["q1".to_string()].into_iter().collect())
}

const HOSTILE: &str = "*/ int main() { \" \\ ??/\n#error \u{202e} ``` [x] '''\"\"\" @ts";

/// What is emitted in the tests: numbers, parameters and hostile words, and every other kind of root.
pub fn samples() -> Vec<Sample> {
    vec![plain(), hostile(), mixed(true), mixed(false)]
}

fn known((results, multiplicity, free): (Vec<f64>, u32, u32)) -> KnownSolution {
    KnownSolution { results, multiplicity, free }
}

/// What is to be said of solutions: where an unknown is free, there may be more.
pub fn certificate(solutions: &[KnownSolution]) -> Certificate {
    if solutions.iter().any(|s| s.free != 0) { Certificate::Singular } else { Certificate::Complete }
}

/// Configurations of six angles: in general position, with two and no solutions, elbow and wrist straight.
fn ur5_vectors(parameters: &[f64]) -> Vec<SolverVector> {
    let configurations: [([f64; 6], f64); 6] = [
        ([0.3, -1.1, 1.7, -0.4, 0.9, 2.2], 1e-11),
        ([-2.5, -0.6, -1.2, 2.9, -1.4, -0.7], 1e-11),
        ([1.0, -1.3, 0.4, 0.2, 2.5, 3.0], 1e-11),
        ([0.5, -1.0, 0.0, 0.7, 1.1, -0.3], 3e-7),
        ([0.5, -1.0, 1.2, -0.2, 0.0, 0.0], 1e-8),
        ([0.1, 0.2, 2.9, -1.0, 4e-4, 1.0], 1e-7),
    ];
    let vector = |variables: Vec<f64>, tolerance| {
        let solutions: Vec<_> = ur5::inverse(ur5::LENGTHS, &variables).into_iter().map(known).collect();
        let parameters = parameters.to_vec();
        SolverVector { certificate: certificate(&solutions), solutions, variables, parameters, tolerance }
    };
    let mut list: Vec<SolverVector> =
        configurations.iter().map(|(q, t)| vector(ur5::forward(ur5::LENGTHS, q), *t)).collect();
    let mut far = ur5::forward(ur5::LENGTHS, &[0.3; 6]);
    far[3] = 2.0;
    list.push(vector(far, 1e-9));
    list
}

fn plain() -> Sample {
    Sample {
        name: "ur5",
        function: "ik",
        argument: "pose",
        result: "q",
        shape: vec![3, 4],
        parameters: vec![],
        solver: ur5::solver(false),
        program: Some(program()),
        vectors: ur5_vectors(&[]),
        words: "plain",
    }
}

/// The same with parameters, all words hostile.
fn hostile() -> Sample {
    Sample {
        name: "int\"; */",
        function: "sincos_roots",
        argument: "roots",
        result: "free",
        shape: vec![12],
        parameters: ur5::PARAMETERS.into_iter().zip(ur5::LENGTHS).collect(),
        solver: ur5::solver(true),
        program: None,
        vectors: ur5_vectors(&ur5::LENGTHS),
        words: HOSTILE,
    }
}

fn mixed(has_quartic: bool) -> Sample {
    Sample {
        name: "mixed",
        function: "all",
        argument: "given",
        result: "x",
        shape: vec![9],
        parameters: vec![],
        solver: mixed::solver(has_quartic),
        program: None,
        vectors: mixed::vectors(has_quartic),
        words: "plain",
    }
}
