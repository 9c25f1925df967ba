//! What is answered for a configuration, as JSON.

use crate::commands::fk::{Frame, Request, limits};
use denavit::description::{Description, Joint, Mechanism};
use denavit::forward::{Reference, frames_program};
use denavit::geometry::orientation::{OrientationSet, extract};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit_program::{Arithmetic, Function, Program};
use denavit_wire::Schema;
use denavit_wire::forward::{NamedPose, Placed, PlacedTree};
use denavit_wire::pose::{matrices, matrix, matrix_of};

/// Entries of a pose.
const POSE: usize = 16;

/// The poses of frames, sixteen results each, as one function that rounds the same on every machine.
///
/// `-q` and `--input` both use it, so that a configuration has one answer, to the last bit.
pub fn function(description: &Description, of: &[Reference]) -> Function {
    strict(description, &frames_program(description, of))
}

/// A program at the robot's own values, as one function that rounds the same on every machine.
pub fn strict(description: &Description, program: &Program) -> Function {
    // One without a value is in no formula: the robot over numbers exists.
    let values: Vec<f64> =
        program.parameters().iter().map(|s| description.value(*s).unwrap_or(f64::NAN)).collect();
    let function = program.compile(&values);
    function.on(function.target().0, Arithmetic::Strict)
}

/// The transforms that results stand for; a zero has no sign.
pub fn transforms(results: &[f64]) -> impl Iterator<Item = Transform<f64>> {
    results.chunks_exact(POSE).map(|m| {
        let row = |r: usize| [m[4 * r] + 0.0, m[4 * r + 1] + 0.0, m[4 * r + 2] + 0.0];
        let position = [3, 7, 11].map(|k| m[k] + 0.0);
        Transform::from_rotation_translation(Rotation::from_rows([0, 1, 2].map(row)), Vector(position))
    })
}

/// How to answer; it can be sent to other threads.
pub struct Answers {
    /// The poses: the frames asked for, then the tool.
    pub function: Function,
    /// How many joints there are.
    pub joints: usize,
    /// How many results a configuration has.
    pub results: usize,
    /// The robot's name.
    robot: String,
    /// For each joint; none if no joint has limits.
    limits: Vec<Option<[f64; 2]>>,
    orientation: Option<OrientationSet>,
    /// The frames that are asked for.
    frames: Vec<Frame>,
    /// The bodies and the joints of a tree, where all of it was asked for.
    tree: Option<Names>,
}

/// What the bodies and the joints of a tree are called.
struct Names {
    bodies: Vec<String>,
    joints: Vec<String>,
}

impl Answers {
    /// For these bodies of a tree.
    pub fn of_tree(m: &Mechanism, bodies: &[usize]) -> Self {
        let function = m.frames_program(bodies).compile(&[]);
        let joints: Vec<&Joint> = m.variables().into_iter().map(|j| &m.joints[j]).collect();
        let mut limits = m.variable_limits();
        if limits.iter().all(Option::is_none) {
            limits.clear();
        }
        let names = Names {
            bodies: bodies.iter().map(|&b| m.bodies[b].name.clone()).collect(),
            joints: joints.iter().map(|j| j.name.clone()).collect(),
        };
        Answers {
            function: function.on(function.target().0, Arithmetic::Strict),
            joints: joints.len(),
            results: POSE * bodies.len(),
            robot: m.name.clone(),
            limits,
            orientation: None,
            frames: vec![],
            tree: Some(names),
        }
    }

    /// For a robot whose parameters have values.
    pub fn new(description: &Description, request: &Request) -> Self {
        let frames = request.frames.iter().map(|f| Reference::Frame(f.on));
        let poses: Vec<Reference> = frames.chain([Reference::Tool]).collect();
        let mut limits: Vec<Option<[f64; 2]>> = limits(description).into_iter().map(|l| l.1).collect();
        let joints = limits.len();
        if limits.iter().all(Option::is_none) {
            limits.clear();
        }
        Answers {
            function: function(description, &poses),
            joints,
            results: POSE * poses.len(),
            robot: description.name.clone(),
            limits,
            orientation: request.orientation,
            frames: request.frames.clone(),
            tree: None,
        }
    }

    /// Writes the answer: an object on one line.
    pub fn write(&self, q: &[f64], results: &[f64], out: &mut Vec<u8>) {
        let within_limits =
            (!self.limits.is_empty()).then(|| self.limits.iter().zip(q).all(|l| is_inside(&l)));
        if let Some(names) = &self.tree {
            let frames = names.bodies.iter().zip(matrices(results));
            let frames: Vec<_> = frames.map(|(name, pose)| NamedPose { name, pose }).collect();
            let (joints, robot) = (&names.joints[..], self.robot.as_str());
            PlacedTree { frames: &frames, joints, q, robot, schema: Schema, within_limits }.write(out);
            return;
        }
        let (frames, pose) = results.split_at(self.results - POSE);
        let orientation = self.orientation.zip(transforms(pose).next());
        let placed: Vec<_> =
            self.frames.iter().zip(transforms(frames)).map(|(f, x)| matrix(&f.placed(x))).collect();
        let placed = Placed {
            frames: &placed,
            orientation: orientation.map(|(set, x)| extract(&x.rotation, set).into()),
            pose: matrix_of(pose),
            q,
            robot: &self.robot,
            schema: Schema,
            within_limits,
        };
        placed.write(out);
    }
}

/// Whether a joint is within its limits.
fn is_inside((limits, x): &(&Option<[f64; 2]>, &f64)) -> bool {
    limits.is_none_or(|[low, high]| (low..=high).contains(x))
}
