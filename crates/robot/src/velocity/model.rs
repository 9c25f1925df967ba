//! The Jacobian as formulas, its algorithm, and the proof that it is the derivative of the forward model.

use super::geometric::{Jacobian, Viewpoint, geometric};
use super::program::entry_name;
use crate::description::Description;
use crate::forward::{Proof, Reference, prove, symbol_order};
use crate::geometry::{Axis, Transform, Vector};
use crate::mechanism::{Robot, Walk};
use denavit_program::{Function, Graph, MissingValue, Program, Value};
use denavit_symbolic::{Expr, Refusal, Symbol, readable};
use rustc_hash::{FxHashMap, FxHashSet};

/// A Jacobian as formulas.
#[derive(Clone, Debug)]
pub struct JacobianModel {
    /// Whose velocity, where, along which axes.
    pub view: Viewpoint<Expr>,
    /// The matrix, each entry as short as it was found; or why it was not expanded.
    pub matrix: Result<Jacobian<Expr>, Refusal>,
    /// A program whose results are the entries, row by row: `j11` … `j6n`.
    pub algorithm: Program,
    /// Whether the program is proved equal to the derivative of the product of the link transforms.
    pub proof: Proof,
}

impl JacobianModel {
    /// The algorithm compiled for the lengths of a robot: joint variables in, the entries of the matrix row by row out.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn function(&self, description: &Description) -> Result<Function, MissingValue> {
        self.algorithm.compile_with(|s| description.value(s))
    }

    /// The Jacobian at a viewpoint.
    pub fn derive(description: &Description, view: Viewpoint<Expr>) -> Self {
        Self::with(description, view, &mut Shortener::new(description))
    }

    fn with(description: &Description, view: Viewpoint<Expr>, shortener: &mut Shortener) -> Self {
        let plain = geometric(&Robot::symbolic(description), &variables(description), &view);
        match shortener.matrix(&plain) {
            Ok(matrix) => Self::of(description, view, matrix),
            Err(why) => JacobianModel { matrix: Err(why), ..Self::of(description, view, plain) },
        }
    }

    /// The model with a matrix from elsewhere, as it stands. Whether it is the Jacobian, its proof tells:
    ///
    /// ```
    /// use denavit::forward::{Proof, Reference};
    /// use denavit::velocity::{JacobianModel, Viewpoint};
    ///
    /// let arm = denavit::catalogue::robot("puma560").expect("it is in the catalogue");
    /// let view = Viewpoint::of(Reference::Tool, Reference::Base);
    /// let mut matrix = JacobianModel::derive(&arm, view).matrix.expect("it is short");
    /// assert_eq!(JacobianModel::of(&arm, view, matrix.clone()).proof, Proof::Proved);
    /// matrix.columns[0][1] = -matrix.columns[0][1];
    /// assert_eq!(JacobianModel::of(&arm, view, matrix).proof, Proof::Failed);
    /// ```
    pub fn of(description: &Description, view: Viewpoint<Expr>, matrix: Jacobian<Expr>) -> Self {
        let algorithm = traced(description, &matrix);
        let proof = proof(description, &Robot::symbolic(description), &view, &algorithm);
        JacobianModel { view, matrix: Ok(matrix), algorithm, proof }
    }

    /// The Jacobian of a body in the frame, and at the origin of the frame, in which it is shortest: the fewest symbols in
    /// all entries. The twist in any other frame and at any other point of the body follows from
    /// it by a rotation and a lever arm.
    pub fn shortest(description: &Description, body: Reference) -> Self {
        let frames = Robot::symbolic(description).rows_before(body);
        let points: Vec<Reference> = (0..=frames).rev().map(Reference::Frame).collect();
        Self::shortest_of(description, body, &points)
    }

    /// The same at the body's own origin.
    pub fn shortest_at_origin(description: &Description, body: Reference) -> Self {
        Self::shortest_of(description, body, &[body])
    }

    /// The shortest along the axes of any frame at one of these origins.
    fn shortest_of(description: &Description, body: Reference, points: &[Reference]) -> Self {
        let robot = Robot::symbolic(description);
        let q = variables(description);
        let n = robot.rows_before(body);
        let mut shortener = Shortener::new(description);
        // From the middle of the chain formulas are shortest; what comes later is soon known to be longer.
        let mut middle_first: Vec<usize> = (0..=n).collect();
        middle_first.sort_by_key(|&i| (2 * i).abs_diff(n));
        let mut best: Option<(u64, Viewpoint<Expr>)> = None;
        for &axes in &middle_first {
            for &at in points {
                let axes = Reference::Frame(axes);
                let view = Viewpoint { axes, body, at, offset: Vector::zero() };
                let bound = best.as_ref().map_or(u64::MAX, |b| b.0);
                let enough = if best.is_some() { ENOUGH } else { PATIENCE };
                if shortener.written > enough {
                    break;
                }
                if let Some(length) = shortener.length(&geometric(&robot, &q, &view), bound) {
                    best = Some((length, view));
                }
            }
        }
        let view = best.map_or(Viewpoint::of(body, Reference::Base), |b| b.1);
        Self::with(description, view, &mut shortener)
    }
}

/// Symbols written after which no more viewpoints are tried.
const ENOUGH: u64 = 4_000;
/// The same where none was short enough yet.
const PATIENCE: u64 = 10_000;
/// What an entry counts that is too long to be written.
const REFUSED: u64 = 500;

/// Symbols printed; 0 and ±1 cost nothing.
fn weight(e: Expr) -> u64 {
    if e.as_number().is_some() { 0 } else { readable::literals(e) }
}

/// The joint variables as formulas.
pub(super) fn variables(description: &Description) -> Vec<Expr> {
    description.variables().iter().map(|v| v.symbol.into()).collect()
}

/// Writes entries as short as it can, each once.
struct Shortener {
    order: Vec<Symbol>,
    known: FxHashMap<Expr, Result<Expr, Refusal>>,
    /// The symbols of all entries written so far.
    written: u64,
}

impl Shortener {
    fn new(description: &Description) -> Self {
        Shortener { order: symbol_order(description), known: FxHashMap::default(), written: 0 }
    }

    fn entry(&mut self, e: Expr) -> Result<Expr, Refusal> {
        if let Some(known) = self.known.get(&e) {
            return *known;
        }
        let shorter = readable::simplify(e, &self.order).map(|form| form.expr);
        // What is refused was worked at as well.
        self.written += shorter.map_or(REFUSED, weight);
        self.known.insert(e, shorter);
        shorter
    }

    fn matrix(&mut self, plain: &Jacobian<Expr>) -> Result<Jacobian<Expr>, Refusal> {
        let mut columns = plain.columns.clone();
        for e in columns.iter_mut().flatten() {
            *e = self.entry(*e)?;
        }
        Ok(Jacobian { columns })
    }

    /// The symbols of all entries, if they are fewer than `bound`; entries with the fewest joints first.
    fn length(&mut self, plain: &Jacobian<Expr>, bound: u64) -> Option<u64> {
        let mut entries: Vec<Expr> = plain.columns.iter().flatten().copied().collect();
        entries.retain(|e| e.as_number().is_none());
        if entries.iter().any(|e| matches!(self.known.get(e), Some(Err(_)))) {
            return None;
        }
        entries.sort_by_cached_key(|&e| readable::literals(e));
        let mut length = 0;
        for e in entries {
            length += weight(self.entry(e).ok()?);
            if length >= bound {
                return None;
            }
        }
        Some(length)
    }
}

/// The entries as they stand, common parts shared.
fn traced(description: &Description, matrix: &Jacobian<Expr>) -> Program {
    let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
    let parameters: Vec<Symbol> = description.parameters.iter().map(|p| p.symbol).collect();
    let taken: FxHashSet<String> =
        variables.iter().chain(&parameters).map(|s| s.name().to_string()).collect();
    let mut graph = Graph::new(&variables, &parameters);
    let n = matrix.columns.len();
    let mut results: Vec<(String, Value)> = vec![];
    for r in 0..6 {
        for (c, column) in matrix.columns.iter().enumerate() {
            results.push((entry_name(r, c, n), graph.trace(column[r])));
        }
    }
    Program::new(&graph, &results, |_| None, &taken)
}

/// Holds the entries against the derivative of the definition, the plain product of the link transforms:
/// R·v = ∂p/∂q + ω × (c − p) and (R·ω) × each column of the body's rotation = that column's derivative, where R is the
/// frame of the components, p the body's origin and c the point, all in the base.
fn proof(
    description: &Description,
    robot: &Robot<Expr>,
    view: &Viewpoint<Expr>,
    algorithm: &Program,
) -> Proof {
    let q = variables(description);
    let seen = Walk::seen_from(robot, &q, Reference::Base);
    let body = seen.place(view.body);
    let derivatives = differentiated(description, &body);
    let axes = seen.place(view.axes).rotation;
    let point = seen.place(view.at).act_on_point(view.offset);
    let n = q.len();
    let entries = algorithm.formulas();
    let (mut have, mut wanted) = (vec![], vec![]);
    for (j, derivative) in derivatives.iter().enumerate() {
        let entry = |r: usize| entries[r * n + j];
        let linear = axes * Vector([entry(0), entry(1), entry(2)]);
        let angular = axes * Vector([entry(3), entry(4), entry(5)]);
        let shift = angular.cross(point - body.translation);
        let turned = Axis::ALL.map(|a| angular.cross(body.rotation.column(a)));
        for i in 0..3 {
            have.push(linear[i] - shift[i]);
            wanted.push(derivative[3][i]);
            for (column, of) in turned.iter().zip(derivative) {
                have.push(column[i]);
                wanted.push(of[i]);
            }
        }
    }
    let parts = have.into_iter().zip(wanted).map(|(a, b)| a - b);
    prove_zero(description, parts.collect())
}

fn prove_zero(description: &Description, differences: Vec<Expr>) -> Proof {
    let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
    let parameters: Vec<Symbol> = description.parameters.iter().map(|p| p.symbol).collect();
    let mut graph = Graph::new(&variables, &parameters);
    let zero = vec![Expr::int(0); differences.len()];
    let results: Vec<_> =
        differences.iter().enumerate().map(|(i, &e)| (format!("e{i}"), graph.trace(e))).collect();
    let program = Program::new(&graph, &results, |_| None, &FxHashSet::default());
    prove(description, &program, &zero)
}

/// The derivatives of a transform's x, y, z and origin by each joint.
fn differentiated(description: &Description, x: &Transform<Expr>) -> Vec<[Vector<Expr>; 4]> {
    let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
    let parameters: Vec<Symbol> = description.parameters.iter().map(|p| p.symbol).collect();
    let mut graph = Graph::new(&variables, &parameters);
    let parts = [x.rotation.x(), x.rotation.y(), x.rotation.z(), x.translation];
    let entries = parts.iter().flat_map(|v| v.0).enumerate();
    let results: Vec<_> = entries.map(|(i, e)| (format!("x{i}"), graph.trace(e))).collect();
    let formulas = Program::new(&graph, &results, |_| None, &FxHashSet::default()).jacobian().formulas();
    let n = variables.len();
    let of = |j: usize, part: usize| Vector([0, 1, 2].map(|i| formulas[(3 * part + i) * n + j]));
    (0..n).map(|j| [0, 1, 2, 3].map(|part| of(j, part))).collect()
}
