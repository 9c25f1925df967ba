//! Closed loops of a tree of bodies: places on two of them that are held together.

use super::{Mechanism, moved};
use crate::description::JointKind;
use crate::geometry::{Transform, Vector};
use denavit_symbolic::{Expr, readable};
use std::ops::Range;

/// Two places that a closed loop holds together.
#[derive(Clone, Debug)]
pub struct Hold {
    /// What people call it.
    pub name: Option<String>,
    /// The bodies.
    pub bodies: [usize; 2],
    /// The places in their frames.
    pub places: [Transform<Expr>; 2],
    /// What of the places is one.
    pub keeps: Keeps,
    /// Its place in the text that it was read from.
    pub span: Range<usize>,
}

/// What two places that are held together have in common.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Keeps {
    /// Their points.
    Point,
    /// Their points and z axes.
    Axis,
    /// All.
    Frame,
}

impl Mechanism {
    /// The bodies in the root's frame at values of the joints, by number; 0, or what follows from it, for joints without one.
    pub(in crate::description) fn placed(
        &self,
        value: impl Fn(usize) -> Option<Expr>,
    ) -> Vec<Transform<Expr>> {
        let mut poses = vec![Transform::identity(); self.bodies.len()];
        for (j, joint) in self.joints.iter().enumerate() {
            let rest = joint.follows.as_ref().map_or(Expr::int(0), |f| f.offset);
            let mut pose = poses[joint.parent] * joint.origin;
            if let Some(kind) = joint.kind {
                pose = pose * moved(joint, kind, value(j).unwrap_or(rest));
            }
            poses[joint.child] = pose.map(readable::settled);
        }
        poses
    }

    /// The joints that move between two bodies.
    pub(in crate::description) fn between_bodies(&self, [a, b]: [usize; 2]) -> Vec<usize> {
        let to = self.joints_to();
        let [up, down] = [a, b].map(|body| self.to_root(body, &to));
        let moves = |&j: &usize| {
            let joint = &self.joints[j];
            joint.kind.is_some() && joint.follows.as_ref().is_none_or(|f| !f.factor.is_zero())
        };
        let beside = |own: &[usize], other: &[usize]| -> Vec<usize> {
            own.iter().copied().filter(|j| !other.contains(j)).filter(moves).collect()
        };
        let mut all = beside(&up, &down);
        all.extend(beside(&down, &up).into_iter().rev());
        all
    }

    /// The direction, in the root's frame with all joints at 0, about which everything between two bodies turns: nothing where they do
    /// not move in one plane.
    pub(in crate::description) fn plane_between(
        &self,
        bodies: [usize; 2],
        poses: &[Transform<Expr>],
    ) -> Option<Vector<Expr>> {
        let between = self.between_bodies(bodies);
        let direction = |&j: &usize| {
            let joint = &self.joints[j];
            (joint.kind, (poses[joint.parent] * joint.origin).act_on_vector(joint.axis))
        };
        let all: Vec<_> = between.iter().map(direction).collect();
        let normal = all.iter().find(|d| d.0 == Some(JointKind::Revolute))?.1;
        let is_zero = |e: Expr| readable::settled(e).is_zero();
        let is_in_plane = |(kind, v): &(Option<JointKind>, Vector<Expr>)| match kind {
            Some(JointKind::Prismatic) => is_zero(normal.dot(*v)),
            _ => normal.cross(*v).0.into_iter().all(is_zero),
        };
        all.iter().all(is_in_plane).then_some(normal)
    }

    /// The joints that are driven: those that are said to be, and those that are on no closed loop. Where none on a loop is said to be,
    /// the first ones are, as many as the loops leave free with all joints at 0 (`closure::findings` says where that is not their mobility).
    pub(in crate::description) fn drives(&self) -> Vec<usize> {
        let mut on_loop = vec![false; self.joints.len()];
        let own = |j: usize| self.joints[j].follows.as_ref().map_or(j, |f| f.joint);
        for hold in &self.holds {
            self.between_bodies(hold.bodies).into_iter().for_each(|j| on_loop[own(j)] = true);
        }
        let variables = self.variables();
        // What drives a joint that follows drives the one that it follows.
        let driven: Vec<usize> = self.driven.iter().map(|&j| own(j)).collect();
        if variables.iter().any(|j| on_loop[*j] && driven.contains(j)) {
            return variables.into_iter().filter(|j| !on_loop[*j] || driven.contains(j)).collect();
        }
        let passive = self.determined(&variables, &on_loop);
        variables.into_iter().filter(|j| !passive.contains(j)).collect()
    }

    /// The last joints on loops whose rates follow from those of the others, with all joints at 0.
    fn determined(&self, variables: &[usize], on_loop: &[bool]) -> Vec<usize> {
        let poses = self.placed(|_| None);
        let number = |x: &Transform<Expr>| x.map(|e| e.eval(|_| None).unwrap_or(0.0));
        let numbers: Vec<Transform<f64>> = poses.iter().map(number).collect();
        let mut columns: Vec<(usize, Vec<f64>)> = vec![];
        for &variable in variables.iter().rev().filter(|j| on_loop[**j]) {
            let mut column = vec![];
            for hold in &self.holds {
                let between = self.between_bodies(hold.bodies);
                let place = numbers[hold.bodies[0]] * number(&hold.places[0]);
                let (mut turn, mut shift) = (Vector([0.0; 3]), Vector([0.0; 3]));
                for &j in &between {
                    let joint = &self.joints[j];
                    let factor = match &joint.follows {
                        Some(f) if f.joint == variable => f.factor.to_f64(),
                        None if j == variable => 1.0,
                        _ => continue,
                    };
                    // What moves the one side one way moves it against the other.
                    let is_up = self.carries(joint.child, hold.bodies[0]);
                    let factor = if is_up { factor } else { -factor };
                    let at = numbers[joint.parent] * number(&joint.origin);
                    let axis = Vector(joint.axis.0.map(|e| e.eval(|_| None).unwrap_or(0.0)));
                    let z = at.act_on_vector(axis).scale(factor / axis.norm());
                    if joint.kind == Some(JointKind::Prismatic) {
                        shift = shift + z;
                    } else {
                        turn = turn + z;
                        shift = shift + z.cross(place.translation - at.translation);
                    }
                }
                column.extend(shift.0);
                match hold.keeps {
                    Keeps::Point => {}
                    Keeps::Frame => column.extend(turn.0),
                    Keeps::Axis => {
                        let z = place.rotation.z();
                        column.extend((turn - z.scale(z.dot(turn))).0);
                    }
                }
            }
            columns.push((variable, column));
        }
        // Gram–Schmidt, in this order.
        let mut basis: Vec<Vec<f64>> = vec![];
        let mut found = vec![];
        for (variable, column) in columns {
            let size = norm(&column);
            let mut left = column;
            for b in &basis {
                let along: f64 = left.iter().zip(b).map(|(x, y)| x * y).sum();
                left.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
            }
            let rest = norm(&left);
            if rest > 1e-9 * size.max(f64::MIN_POSITIVE) {
                basis.push(left.iter().map(|x| x / rest).collect());
                found.push(variable);
            }
        }
        found
    }

    /// Whether a body is another, or carries it.
    fn carries(&self, body: usize, other: usize) -> bool {
        let to = self.joints_to();
        body == other || self.to_root(other, &to).iter().any(|&j| self.joints[j].parent == body)
    }
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
