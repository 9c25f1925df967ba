//! Vectors and frames of exact constants.

use crate::geometry::{Axis, Rotation, Transform, Vector};
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

/// A frame that is got by going from frame to frame: all its axes are kept, as one that is made of the two others would double what
/// they are rounded by at each step.
#[derive(Clone, Debug)]
pub(in crate::description) struct Pose {
    axes: [V; 3],
    origin: V,
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

/// How numbers are those of another.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(in crate::description) enum Alike {
    /// Exactly.
    Exactly,
    /// Up to 60 digits.
    Rounded,
    /// They are others.
    No,
}

/// How all of these are 0.
fn nothing<'r>(all: impl IntoIterator<Item = &'r Real>) -> Alike {
    let one = |x: &Real| match (x.is_zero(), x.is_exact()) {
        (true, true) => Alike::Exactly,
        (true, false) => Alike::Rounded,
        (false, _) => Alike::No,
    };
    all.into_iter().map(one).max().unwrap_or(Alike::Exactly)
}

impl Pose {
    pub fn identity() -> Self {
        let axes = [0, 1, 2].map(|k| [0, 1, 2].map(|i| Real::from(i64::from(i == k))));
        Pose { axes, origin: zero() }
    }

    /// Nothing where a number has no value.
    pub fn of(x: &Transform<Expr>, values: &mut Values) -> Option<Pose> {
        let mut three = |v: [Expr; 3]| {
            let [a, b, c] = v.map(|e| values.of(e));
            Some([a?, b?, c?])
        };
        let r = x.rotation;
        let axes = [three(r.x().0)?, three(r.column(Axis::Y).0)?, three(r.z().0)?];
        Some(Pose { axes, origin: three(x.translation.0)? })
    }

    /// With these axes x and z.
    pub(super) fn with_axes(x: V, z: V, origin: V) -> Pose {
        let y = cross(&z, &x);
        Pose { axes: [x, y, z], origin }
    }

    fn frame(&self) -> Frame {
        let [x, _, z] = self.axes.clone();
        Frame { x, z, origin: self.origin.clone() }
    }

    pub(super) fn axes(&self) -> &[V; 3] {
        &self.axes
    }

    pub(super) fn origin(&self) -> &V {
        &self.origin
    }

    /// A frame that is given in this one, in the base. However many are behind each other, its numbers are no longer than those of
    /// two.
    pub fn times(&self, other: &Pose) -> Pose {
        let axes = [0, 1, 2].map(|k| self.turned(&other.axes[k]));
        Pose { axes, origin: plus(&self.origin, &self.turned(&other.origin)) }
    }

    /// A direction that is given in this frame, in the base.
    pub(super) fn turned(&self, v: &V) -> V {
        let [x, y, z] = &self.axes;
        plus(&plus(&scaled(x, &v[0]), &scaled(y, &v[1])), &scaled(z, &v[2]))
    }

    /// Another frame, given in the base, seen from this one.
    pub fn seen(&self, other: &Pose) -> Pose {
        let turned = |v: &V| [0, 1, 2].map(|k| dot(&self.axes[k], v));
        let axes = [0, 1, 2].map(|k| turned(&other.axes[k]));
        Pose { axes, origin: turned(&minus(&other.origin, &self.origin)) }
    }

    /// The base, seen from this frame.
    pub fn inverse(&self) -> Pose {
        self.seen(&Pose::identity())
    }

    /// How this frame is another.
    pub fn alike(&self, other: &Pose) -> Alike {
        let [x, y, z] = [0, 1, 2].map(|k| minus(&self.axes[k], &other.axes[k]));
        nothing([x, y, z, minus(&self.origin, &other.origin)].iter().flatten())
    }

    /// By how much this frame is not another at most: directions, and the unit of its origin.
    pub fn apart(&self, other: &Pose) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|k| minus(&self.axes[k], &other.axes[k]));
        let all = [x, y, z, minus(&self.origin, &other.origin)];
        all.iter().flatten().map(|e| e.to_f64().abs()).fold(0.0, f64::max)
    }

    /// How z of this frame is z of another, as a line or, of a slide, as a direction.
    pub fn axis_alike(&self, other: &Pose, slides: bool) -> Alike {
        let direction = minus(&self.axes[2], &other.axes[2]);
        let moment = cross(&minus(&self.origin, &other.origin), &other.axes[2]);
        nothing(direction.iter().chain(moment.iter().filter(|_| !slides)))
    }

    /// As a transform whose formulas have the values of its numbers again.
    pub fn formula(&self) -> Transform<Expr> {
        let [x, y, z] = self.axes.clone().map(|v| v.map(|e| e.formula()));
        let rotation = Rotation::from_rows([0, 1, 2].map(|i| [x[i], y[i], z[i]]));
        Transform::from_rotation_translation(rotation, Vector(self.origin.clone().map(|e| e.formula())))
    }

    /// As a transform of formulas; roll, pitch and yaw where they are short.
    pub fn settled(&self) -> Transform<Expr> {
        self.frame().settled()
    }
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
