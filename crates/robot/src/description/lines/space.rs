//! Vectors and frames of exact constants.

use crate::geometry::Transform;
use denavit_symbolic::Expr;
use denavit_symbolic::real::{Real, Values};

/// Three coordinates.
pub(super) type V = [Real; 3];

/// A right-handed frame: its axes x and z, and its origin, in the base.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub x: V,
    pub z: V,
    pub origin: V,
}

pub(super) fn zero() -> V {
    [0, 0, 0].map(Real::from)
}

pub(super) fn dot(a: &V, b: &V) -> Real {
    a[0].clone() * b[0].clone() + a[1].clone() * b[1].clone() + a[2].clone() * b[2].clone()
}

pub(super) fn cross(a: &V, b: &V) -> V {
    let minor = |i: usize, j: usize| a[i].clone() * b[j].clone() - a[j].clone() * b[i].clone();
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

pub(super) fn plus(a: &V, b: &V) -> V {
    [0, 1, 2].map(|i| a[i].clone() + b[i].clone())
}

pub(super) fn minus(a: &V, b: &V) -> V {
    [0, 1, 2].map(|i| a[i].clone() - b[i].clone())
}

pub(super) fn scaled(a: &V, k: &Real) -> V {
    [0, 1, 2].map(|i| a[i].clone() * k.clone())
}

pub(super) fn is_zero(a: &V) -> bool {
    a.iter().all(Real::is_zero)
}

/// What is 0 but for rounding is 0.
pub(super) fn cleaned(a: V) -> V {
    a.map(|x| if x.is_zero() { Real::from(0) } else { x })
}

/// Its direction and its length; nothing for the vector 0.
pub(super) fn unit(a: &V) -> Option<(V, Real)> {
    let length = dot(a, a).sqrt()?;
    let over = length.recip()?;
    Some((scaled(a, &over), length))
}

impl Frame {
    pub fn y(&self) -> V {
        cross(&self.z, &self.x)
    }

    /// The columns of the rotation, and the origin.
    fn columns(&self) -> [V; 3] {
        [self.x.clone(), self.y(), self.z.clone()]
    }

    /// Another frame, given in the base, seen from this one.
    pub fn seen(&self, other: &Frame) -> Frame {
        let turned = |v: &V| self.columns().map(|axis| dot(&axis, v));
        let origin = turned(&minus(&other.origin, &self.origin));
        Frame { x: turned(&other.x), z: turned(&other.z), origin }
    }

    pub fn of(x: &Transform<Expr>, values: &mut Values) -> Option<Frame> {
        let mut three = |v: [Expr; 3]| {
            let [a, b, c] = v.map(|e| values.of(e));
            Some([a?, b?, c?])
        };
        let (rotation, origin) = (x.rotation, x.translation);
        Some(Frame { x: three(rotation.x().0)?, z: three(rotation.z().0)?, origin: three(origin.0)? })
    }

    /// As a transform of formulas; roll, pitch and yaw where they are short.
    pub fn settled(&self) -> Transform<Expr> {
        use crate::geometry::{Rotation, Vector};
        let [x, y, z] = self.columns();
        let place = Vector(self.origin.clone().map(|e| e.settled()));
        let exact: Option<Vec<[Expr; 3]>> =
            (0..3).map(|i| Some([x[i].to_expr()?, y[i].to_expr()?, z[i].to_expr()?])).collect();
        let rotation = match exact.as_deref() {
            Some([a, b, c]) => Rotation::from_rows([*a, *b, *c]),
            // Rz(yaw)·Ry(pitch)·Rx(roll): the first column is cos p (cos y, sin y), −sin p
            _ => {
                let level = dot(&x, &x) - x[2].clone() * x[2].clone();
                let level = cleaned([level, Real::from(0), Real::from(0)])[0].sqrt().unwrap_or(Real::from(0));
                let pitch = (-x[2].clone()).angle(&level);
                let (roll, yaw) = match level.recip() {
                    Some(over) => {
                        let part = |e: &Real| e.clone() * over.clone();
                        (part(&y[2]).angle(&part(&z[2])), part(&x[1]).angle(&part(&x[0])))
                    }
                    None => (Expr::int(0), (-y[0].clone()).angle(&y[1])),
                };
                Rotation::from_rpy(roll, pitch, yaw)
            }
        };
        Transform::from_rotation_translation(rotation, place)
    }
}
