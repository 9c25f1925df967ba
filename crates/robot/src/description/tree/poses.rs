//! Where the bodies of a mechanism are, in numbers.

use super::Mechanism;
use crate::description::JointKind;
use crate::geometry::{Rotation, Transform, Vector};
use crate::random::Random;
use denavit_symbolic::Expr;
use std::f64::consts::PI;

fn number(e: Expr) -> f64 {
    e.eval(|_| None).unwrap_or(f64::NAN)
}

/// A joint in numbers.
struct Numbers {
    kind: Option<JointKind>,
    parent: usize,
    child: usize,
    origin: Transform<f64>,
    axis: Vector<f64>,
    /// The variable that moves it, its factor and offset.
    moves: Option<(usize, f64, f64)>,
}

impl Mechanism {
    /// The frame of each body in that of the root, with these values of its [variables](Mechanism::variables).
    ///
    /// # Panics
    /// If there is not one value for each variable.
    pub fn poses(&self, q: &[f64]) -> Vec<Transform<f64>> {
        assert_eq!(q.len(), self.variables().len(), "one value for each variable");
        self.placed(&self.numbers(), q)
    }

    fn numbers(&self) -> Vec<Numbers> {
        let variables = self.variables();
        let index = |joint: usize| variables.iter().position(|&v| v == joint);
        let joints = self.joints.iter().enumerate().map(|(j, joint)| {
            let axis = joint.axis.map(number);
            let moves = match &joint.follows {
                Some(f) => index(f.joint).map(|v| (v, f.factor.to_f64(), number(f.offset))),
                None => index(j).map(|v| (v, 1.0, 0.0)),
            };
            let (kind, parent, child) = (joint.kind, joint.parent, joint.child);
            let (origin, axis) = (joint.origin.map(number), axis.scale(1.0 / axis.norm()));
            Numbers { kind, parent, child, origin, axis, moves }
        });
        joints.collect()
    }

    fn placed(&self, joints: &[Numbers], q: &[f64]) -> Vec<Transform<f64>> {
        let mut poses = vec![Transform::identity(); self.bodies.len()];
        for joint in joints {
            let value = joint.moves.map_or(0.0, |(v, factor, offset)| factor * q[v] + offset);
            let motion = match joint.kind {
                None => Transform::identity(),
                Some(JointKind::Revolute) => turn(joint.axis, value),
                Some(JointKind::Prismatic) => {
                    Transform::from_rotation_translation(Rotation::identity(), joint.axis.scale(value))
                }
            };
            poses[joint.child] = poses[joint.parent] * joint.origin * motion;
        }
        poses
    }

    /// By how much the bodies of two readings of one file lie apart at most, metres, over configurations that look random: no bound, but near to one.
    pub fn apart(&self, other: &Mechanism) -> f64 {
        const SAMPLES: usize = 256;
        let variables = self.variables();
        if self.bodies.len() != other.bodies.len() || variables != other.variables() {
            return f64::INFINITY;
        }
        let mut random = Random(20);
        let mut most = 0.0_f64;
        let (a, b) = (self.numbers(), other.numbers());
        for _ in 0..SAMPLES {
            let value = |&j: &usize| {
                let joint = &self.joints[j];
                let ends = joint
                    .limits
                    .and_then(|ends| Some([ends[0].eval(|_| None).ok()?, ends[1].eval(|_| None).ok()?]));
                let [low, high] = match (joint.kind, ends) {
                    (Some(JointKind::Revolute), _) => [-PI, PI],
                    (_, Some(ends)) => ends,
                    (_, None) => [-0.5, 0.5],
                };
                low + (high - low) * random.unit()
            };
            let q: Vec<f64> = variables.iter().map(value).collect();
            for (a, b) in self.placed(&a, &q).iter().zip(other.placed(&b, &q)) {
                most = most.max((a.translation - b.translation).norm());
            }
        }
        most
    }
}

/// The turn about an axis of length 1 (Rodrigues): 1 + sin θ·[z] + (1 − cos θ)·[z]².
fn turn(z: Vector<f64>, angle: f64) -> Transform<f64> {
    let (s, half) = (angle.sin(), (0.5 * angle).sin());
    let v = 2.0 * half * half;
    let [x, y, z] = z.0;
    let rows = [
        [1.0 - v * (y * y + z * z), v * x * y - s * z, v * x * z + s * y],
        [v * x * y + s * z, 1.0 - v * (x * x + z * z), v * y * z - s * x],
        [v * x * z - s * y, v * y * z + s * x, 1.0 - v * (x * x + y * y)],
    ];
    Transform::from_rotation_translation(Rotation::from_rows(rows), Vector::zero())
}
