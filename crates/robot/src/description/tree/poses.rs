//! Where the bodies of a mechanism are, in numbers.

use super::{Joint, Mechanism};
use crate::description::JointKind;
use crate::geometry::{Rotation, Transform, Vector};
use crate::random::Random;
use denavit_symbolic::Expr;
use rustc_hash::FxHashMap;
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

/// A tree in numbers: where its bodies are.
pub struct Placing {
    joints: Vec<Numbers>,
    bodies: usize,
    variables: usize,
}

impl Placing {
    /// The frame of each body in that of the root, with these values of the [variables](Mechanism::variables).
    ///
    /// # Panics
    /// If there is not one value for each variable.
    pub fn poses(&self, q: &[f64]) -> Vec<Transform<f64>> {
        assert_eq!(q.len(), self.variables, "one value for each variable");
        let mut poses = vec![Transform::identity(); self.bodies];
        for joint in &self.joints {
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
}

impl Mechanism {
    /// The frame of each body in that of the root, with these values of its [variables](Mechanism::variables).
    ///
    /// # Panics
    /// If there is not one value for each variable.
    pub fn poses(&self, q: &[f64]) -> Vec<Transform<f64>> {
        self.placing().poses(q)
    }

    /// The tree in numbers.
    pub fn placing(&self) -> Placing {
        // Variables stand in the order of the joints.
        let variables = self.variables();
        let index = |joint: usize| variables.binary_search(&joint).ok();
        // Most numbers of a tree are those of many of its joints.
        let mut known: FxHashMap<Expr, f64> = FxHashMap::default();
        let mut number = |e: Expr| *known.entry(e).or_insert_with(|| number(e));
        let joints = self.joints.iter().enumerate().map(|(j, joint)| {
            let axis = joint.axis.map(&mut number);
            let moves = match &joint.follows {
                Some(f) => index(f.joint).map(|v| (v, f.factor.to_f64(), number(f.offset))),
                None => index(j).map(|v| (v, 1.0, 0.0)),
            };
            let (kind, parent, child) = (joint.kind, joint.parent, joint.child);
            let (origin, axis) = (joint.origin.map(&mut number), axis.scale(1.0 / axis.norm()));
            Numbers { kind, parent, child, origin, axis, moves }
        });
        let joints = joints.collect();
        Placing { joints, bodies: self.bodies.len(), variables: variables.len() }
    }

    /// By how much the bodies of two readings of one file lie apart at most, metres, over configurations that look random: no bound, but near to one.
    pub fn apart(&self, other: &Mechanism) -> f64 {
        const SAMPLES: usize = 256;
        /// So many frames are compared at most, in fewer configurations where there are very many bodies.
        const WORK: usize = 1 << 19;
        let variables = self.variables();
        if self.bodies.len() != other.bodies.len() || variables != other.variables() {
            return f64::INFINITY;
        }
        let is_same = |(a, b): (&Joint, &Joint)| {
            (a.kind, a.origin, a.axis) == (b.kind, b.origin, b.axis) && a.follows == b.follows
        };
        if self.joints.iter().zip(&other.joints).all(is_same) {
            return 0.0;
        }
        let samples = (WORK / self.joints.len().max(1)).clamp(16, SAMPLES);
        let mut random = Random(20);
        let mut most = 0.0_f64;
        let (a, b) = (self.placing(), other.placing());
        for _ in 0..samples {
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
            for (a, b) in a.poses(&q).iter().zip(b.poses(&q)) {
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
