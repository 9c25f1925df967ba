//! The functions of the joints, poses and Jacobians: their programs, words and vectors.

use super::Wanted;
use super::samples::Sample;
use denavit::description::Description;
use denavit::forward::{Proof, Reference, frames_program, pose_program, prove};
use denavit::geometry::Transform;
use denavit::robot::Robot;
use denavit::velocity::{Viewpoint, jacobian_and_pose_program, jacobian_program};
use denavit_emit::{Routine, Vector};
use denavit_program::{Graph, Program};
use denavit_symbolic::{Expr, Node, Symbol};

/// A function of the joints.
pub(super) struct Forward {
    pub wanted: Wanted,
    pub program: Program,
    /// Whether it is what the table says.
    pub proof: Proof,
    /// What the table says: the product of its link transforms, or the derivative of that, row by row.
    definition: Vec<Expr>,
}

impl Forward {
    /// The function, if it is one of the joints.
    pub fn new(d: &Description, wanted: Wanted) -> Option<Self> {
        let robot = Robot::symbolic(d);
        let q: Vec<Expr> = d.variables().iter().map(|v| v.symbol.into()).collect();
        let tool = Viewpoint::tool();
        let (program, definition) = match wanted {
            Wanted::Pose => (pose_program(d), entries(&[robot.pose(&q)])),
            Wanted::Frames => {
                let all: Vec<Reference> = (0..=d.rows.len()).map(Reference::Frame).collect();
                (frames_program(d, &all), entries(&robot.frames(&q)))
            }
            Wanted::Jacobian => (jacobian_program(d, &tool), derivative(d, &robot.pose(&q))),
            Wanted::JacobianAndPose => {
                let pose = robot.pose(&q);
                (jacobian_and_pose_program(d, &tool), [derivative(d, &pose), entries(&[pose])].concat())
            }
            Wanted::Inverse | Wanted::Dynamic(_) => return None,
        };
        let proof = prove(d, &program, &definition);
        Some(Forward { wanted, program, proof, definition })
    }

    /// With words and vectors.
    pub fn routine(&self, d: &Description, samples: &[Sample]) -> Routine<'_> {
        let (variables, parameters) = (self.program.variables(), self.program.parameters());
        let definition = traced(variables, parameters, &self.definition);
        let (result, shape, about) = words(self.wanted, d);
        Routine {
            name: self.wanted.name().into(),
            about,
            program: &self.program,
            result: result.into(),
            shape,
            vectors: samples.iter().map(|s| s.vector(&definition)).collect::<Vec<Vector>>(),
            scales: self.scales(d, samples),
        }
    }

    /// What each result is worth where rounding is concerned.
    fn scales(&self, d: &Description, samples: &[Sample]) -> Vec<f64> {
        let reach = samples.iter().map(|s| s.reach).fold(f64::MIN_POSITIVE, f64::max);
        let rounding = rounding(d, &self.program, samples);
        let is_length = |k: usize| k % 4 == 3 && k % 16 != 15;
        let poses = |count| (0..count).map(move |k| if is_length(k) { reach } else { 1.0 });
        let columns = columns(d, reach);
        let jacobian = (0..6).flat_map(|r| columns.iter().map(move |c| c[usize::from(r > 2)]));
        let scales: Vec<f64> = match self.wanted {
            Wanted::Jacobian => jacobian.collect(),
            Wanted::JacobianAndPose => jacobian.chain(poses(16)).collect(),
            Wanted::Pose | Wanted::Frames | Wanted::Inverse | Wanted::Dynamic(_) => {
                poses(self.program.outputs().len()).collect()
            }
        };
        scales.into_iter().map(|s| s * rounding).collect()
    }
}

/// What the results are called, their shape, and what they are.
fn words(wanted: Wanted, d: &Description) -> (&'static str, Vec<usize>, Vec<String>) {
    let ([to, from], rows, joints) = (ends(d), d.rows.len(), d.variables().len());
    let matrix =
        "Rotation in the first three rows and columns (no unit), position in the last column (m).".into();
    let twist = format!(
        "Rows vx, vy, vz: the velocity of its origin (m/rad; no unit for a joint that slides). Rows wx, wy, wz: its \
         angular velocity (no unit). Both along the axes of {from}; a column a joint."
    );
    match wanted {
        Wanted::Frames => {
            let what = format!(
                "Forward kinematics of all link frames: the homogeneous matrices of frames 0 to {rows} in the base."
            );
            ("frames", vec![rows + 1, 4, 4], vec![what, matrix])
        }
        Wanted::Jacobian => {
            let what = format!(
                "Geometric Jacobian, 6 by {joints}: times the joint velocities it is the twist of {to} in {from}."
            );
            ("jacobian", vec![6, joints], vec![what, twist])
        }
        Wanted::JacobianAndPose => {
            let entries = 6 * joints;
            let what = format!(
                "Geometric Jacobian and forward kinematics in one pass, in one list: the {entries} entries of the \
                 6 by {joints} Jacobian of {to} in {from}, row by row, then the 16 entries of its homogeneous matrix, \
                 row by row."
            );
            ("jacobian_and_pose", vec![entries + 16], vec![what, twist, matrix])
        }
        Wanted::Pose | Wanted::Inverse | Wanted::Dynamic(_) => {
            let what = format!("Forward kinematics: the homogeneous matrix of {to} in {from}.");
            ("pose", vec![4, 4], vec![what, matrix])
        }
    }
}

/// All entries, matrix by matrix, row by row.
fn entries(poses: &[Transform<Expr>]) -> Vec<Expr> {
    poses.iter().flat_map(|x| x.matrix()).flatten().collect()
}

/// The Jacobian by its definition, row by row: the derivatives of the position, and ω from [ω]× = Ṙ Rᵀ.
fn derivative(d: &Description, pose: &Transform<Expr>) -> Vec<Expr> {
    let variables: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
    let parameters: Vec<Symbol> = d.parameters.iter().map(|p| p.symbol).collect();
    let rates = traced(&variables, &parameters, &entries(&[*pose])).jacobian().formulas();
    let (n, matrix) = (variables.len(), pose.matrix());
    let rate = |row: usize, column: usize, joint: usize| rates[(4 * row + column) * n + joint];
    let entry = |row: usize, joint: usize| match row {
        0..3 => rate(row, 3, joint),
        _ => {
            // ωx = (Ṙ Rᵀ)₃₂, ωy = (Ṙ Rᵀ)₁₃, ωz = (Ṙ Rᵀ)₂₁
            let (i, k) = [(2, 1), (0, 2), (1, 0)][row - 3];
            (0..3).map(|c| rate(i, c, joint) * matrix[k][c]).fold(Expr::int(0), |a, b| a + b)
        }
    };
    (0..6)
        .flat_map(|row| (0..n).map(move |joint| (row, joint)))
        .map(|(row, joint)| entry(row, joint))
        .collect()
}

/// How large the linear and the angular part of each column of a Jacobian can be: a lever is the difference of two
/// positions, each rounded.
fn columns(d: &Description, reach: f64) -> Vec<[f64; 2]> {
    let robot = Robot::symbolic(d);
    let sum = |terms: &[(usize, Expr)], joint: usize| -> f64 {
        let own = terms.iter().filter(|t| t.0 == joint);
        own.map(|t| t.1.eval(|_| None).map_or(1.0, f64::abs)).sum()
    };
    let column = |joint| {
        let turns: f64 = robot.links.iter().map(|l| sum(&l.theta.terms, joint)).sum();
        let slides: f64 = robot.links.iter().map(|l| sum(&l.d.terms, joint)).sum();
        [2.0 * turns * reach + slides, turns.max(1.0)]
    };
    (0..robot.joints).map(column).collect()
}

/// What the frame is called whose pose is meant, and the frame that it is given in.
pub(super) fn ends(d: &Description) -> [String; 2] {
    let is_plain = |x: Transform<Expr>| x == Transform::identity();
    let to = if is_plain(d.tool) { format!("frame {}", d.rows.len()) } else { "the tool".into() };
    let from = if is_plain(d.base) { "frame 0" } else { "the base" };
    [to, from.into()]
}

/// What the entries of a rotation are worth where rounding is concerned: 1, more for many rows, and more where an angle
/// is a sum, which is rounded at its own size before its sine is taken.
fn rounding(d: &Description, program: &Program, samples: &[Sample]) -> f64 {
    let mut scale = (d.rows.len() as f64 / 6.0).max(1.0);
    for e in program.sines_and_cosines() {
        let (Node::Sin(angle) | Node::Cos(angle)) = e.node() else { continue };
        if angle.as_symbol().is_none() {
            let sizes = samples.iter().map(|s| angle.eval(|x| s.value(program, x)).map_or(0.0, f64::abs));
            scale = sizes.map(|size| size / 4.0).fold(scale, f64::max);
        }
    }
    scale
}

/// Formulas as they stand, over some inputs.
pub(super) fn traced(variables: &[Symbol], parameters: &[Symbol], formulas: &[Expr]) -> Program {
    let mut graph = Graph::new(variables, parameters);
    let outputs: Vec<_> = formulas.iter().map(|e| (String::new(), graph.trace(*e))).collect();
    Program::new(&graph, &outputs, |_| None, &Default::default())
}
