//! The forward functions: their programs, words and vectors.

use super::Wanted;
use super::samples::Sample;
use crate::description::Description;
use crate::forward::{Proof, Reference, frames_program, pose_program, prove};
use crate::geometry::Transform;
use crate::robot::Robot;
use denavit_program::emit::{Routine, Vector};
use denavit_program::{Graph, Program};
use denavit_symbolic::{Expr, Node, Symbol};

/// A forward function.
pub(super) struct Forward {
    pub wanted: Wanted,
    pub program: Program,
    /// Whether it is the product of the link transforms.
    pub proof: Proof,
    /// That product, row by row.
    product: Vec<Expr>,
}

impl Forward {
    /// The function, if it is a forward one.
    pub fn new(d: &Description, wanted: Wanted) -> Option<Self> {
        let robot = Robot::symbolic(d);
        let q: Vec<Expr> = d.variables().iter().map(|v| v.symbol.into()).collect();
        let (program, poses) = match wanted {
            Wanted::Pose => (pose_program(d), vec![robot.pose(&q)]),
            Wanted::Frames => {
                let all: Vec<Reference> = (0..=d.rows.len()).map(Reference::Frame).collect();
                (frames_program(d, &all), robot.frames(&q))
            }
            Wanted::Inverse => return None,
        };
        let product: Vec<Expr> = poses.into_iter().flat_map(|x| x.matrix()).flatten().collect();
        let proof = prove(d, &program, &product);
        Some(Forward { wanted, program, proof, product })
    }

    /// With words and vectors.
    pub fn routine(&self, d: &Description, samples: &[Sample]) -> Routine<'_> {
        let rows = d.rows.len();
        let (result, shape, what) = match self.wanted {
            Wanted::Frames => {
                let what = format!(
                    "Forward kinematics of all link frames: the homogeneous matrices of frames 0 to {rows} in the base."
                );
                ("frames", vec![rows + 1, 4, 4], what)
            }
            Wanted::Pose | Wanted::Inverse => {
                let [to, from] = ends(d);
                ("pose", vec![4, 4], format!("Forward kinematics: the homogeneous matrix of {to} in {from}."))
            }
        };
        let about = vec![
            what,
            "Rotation in the first three rows and columns (no unit), position in the last column (m).".into(),
        ];
        let reference = traced(self.program.variables(), self.program.parameters(), &self.product);
        let vectors: Vec<Vector> = samples.iter().map(|s| s.vector(&reference)).collect();
        let reach = samples.iter().map(|s| s.reach).fold(f64::MIN_POSITIVE, f64::max);
        let rounding = rounding(d, &self.program, samples);
        let is_length = |k: usize| k % 4 == 3 && k % 16 != 15;
        let scale = |k| if is_length(k) { reach * rounding } else { rounding };
        let scales = (0..self.program.outputs().len()).map(scale).collect();
        Routine {
            name: self.wanted.name().into(),
            about,
            program: &self.program,
            result: result.into(),
            shape,
            vectors,
            scales,
        }
    }
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
