//! A whole tree of bodies: a link for each joint that moves, on the link that it stands on, and what is fixed to it part of it. All
//! algorithms over [`Scalar`] go for it as for an arm. What stands on the root moves with nothing: the root stands still.

use super::model::{Drive, Dynamics, GRAVITY, Link};
use crate::description::Mechanism;
use crate::geometry::{Axis, Body, Rotation, Transform, Vector};
use crate::mechanism::Affine;
use crate::scalar::Scalar;
use denavit_symbolic::{Expr, Rational};
use std::fmt;

/// A tree with masses.
#[derive(Clone, PartialEq, Debug)]
pub struct OfTree<T> {
    /// Its links, with no tool.
    pub dynamics: Dynamics<T>,
    /// The joints that move by themselves, by their numbers in the mechanism: the variables.
    pub joints: Vec<usize>,
    /// Of each body of the mechanism the link that it is part of, none for what stands with the root, and its frame there.
    pub places: Vec<Option<(Option<usize>, Transform<T>)>>,
}

/// Why there are no numbers of a tree.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Unknown {
    /// It says nothing of masses.
    NoMasses,
    /// Not all of what this body weighs is known.
    Unweighed(String),
    /// A number of this joint or body has no value.
    NoValue(String),
    /// This joint has an axis without direction.
    NoAxis(String),
    /// This body weighs less than nothing.
    NegativeMass(String),
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unknown::NoMasses => f.write_str("it says nothing of masses"),
            Unknown::Unweighed(body) => write!(f, "not all of what `{body}` weighs is known"),
            Unknown::NoValue(what) => write!(f, "a number of `{what}` has no value"),
            Unknown::NoAxis(joint) => write!(f, "the axis of `{joint}` has no direction"),
            Unknown::NegativeMass(body) => write!(f, "the mass of `{body}` is negative"),
        }
    }
}

impl std::error::Error for Unknown {}

impl OfTree<f64> {
    /// The dynamics of all joints that move, in numbers; gravity along −z of the root where the mechanism says nothing of it.
    ///
    /// # Errors
    /// If masses or values are missing, a mass is negative, or an axis has no direction.
    pub fn new(m: &Mechanism) -> Result<Self, Unknown> {
        Self::of(m, number, |axis| {
            let z = axis.scale(1.0 / axis.norm());
            frame_about(z, z.any_across())
        })
    }
}

impl OfTree<Expr> {
    /// The same with its numbers exactly as they stand.
    ///
    /// # Errors
    /// If masses or values are missing, a mass is negative, or an axis has no direction.
    pub fn exact(m: &Mechanism) -> Result<Self, Unknown> {
        let known = |e: Expr| number(e).map(|_| e);
        Self::of(m, known, |axis| {
            let z = axis.scale(Expr::int(1) / axis.norm());
            let near = z.map(|e| number(e).unwrap_or(0.0));
            // Towards the axis that is farthest from it.
            let least = Axis::ALL.into_iter().min_by(|a, b| {
                let size = |x: &Axis| near[x.index()].abs();
                size(a).total_cmp(&size(b))
            });
            let e = Vector::unit(least.unwrap_or(Axis::X));
            let across = e - z.scale(e.dot(z));
            frame_about(z, across.scale(Expr::int(1) / across.norm()))
        })
    }
}

impl<T: Scalar> OfTree<T> {
    /// With what numbers are, and a rotation whose z is along an axis that has a direction.
    fn of(
        m: &Mechanism,
        value: impl Fn(Expr) -> Option<T>,
        onto_z: impl Fn(Vector<T>) -> Rotation<T>,
    ) -> Result<Self, Unknown> {
        if m.bodies.iter().all(|b| b.mass.is_none() && !b.is_unweighed) {
            return Err(Unknown::NoMasses);
        }
        let joints = m.variables();
        let mut place = vec![None; m.joints.len()];
        joints.iter().enumerate().for_each(|(k, &j)| place[j] = Some(k));
        let mut links: Vec<Link<T>> = vec![];
        let mut drives = vec![Drive::nothing(); joints.len()];
        // The link of each body, and its frame there; those of the root stand in the base.
        let mut at: Vec<Option<(Option<usize>, Transform<T>)>> = vec![None; m.bodies.len()];
        at[m.root] = Some((None, Transform::identity()));
        // The joint to a body stands before those behind it.
        for (j, joint) in m.joints.iter().enumerate() {
            let Some((parent, frame)) = at[joint.parent] else { continue };
            let unknown = || Unknown::NoValue(joint.name.clone());
            let frame = frame * values(&joint.origin, &value).ok_or_else(unknown)?;
            let Some(kind) = joint.kind else {
                at[joint.child] = Some((parent, frame));
                continue;
            };
            let no_axis = || Unknown::NoAxis(joint.name.clone());
            let near = Vector(joint.axis.0.map(|e| number(e).unwrap_or(f64::NAN))).norm();
            if !(near.is_finite() && near > 0.0) {
                return Err(no_axis());
            }
            let [x, y, z] = joint.axis.0.map(&value);
            let turn =
                onto_z(Vector([x.ok_or_else(no_axis)?, y.ok_or_else(no_axis)?, z.ok_or_else(no_axis)?]));
            let (leader, ratio, offset) = match &joint.follows {
                None => (place[j], Rational::ONE, T::zero()),
                Some(f) => (place[f.joint], f.factor.clone(), value(f.offset).ok_or_else(unknown)?),
            };
            let leader = leader.ok_or_else(unknown)?;
            let times = |r: Rational| value(Expr::from(r)).ok_or_else(unknown);
            let affine = Affine { offset, quarters: 0, terms: vec![(leader, times(ratio.clone())?)] };
            let (square, size) = (times(&ratio * &ratio)?, times(ratio.abs())?);
            let part = |e: Option<Expr>| e.map_or(Some(T::zero()), &value).ok_or_else(unknown);
            let drive = &mut drives[leader];
            drive.rotor = drive.rotor + square * part(joint.drive.rotor)?;
            drive.viscous = drive.viscous + square * part(joint.drive.viscous)?;
            drive.coulomb = drive.coulomb + size * part(joint.drive.coulomb)?;
            let turned = Transform::from_rotation_translation(turn, Vector::zero());
            links.push(Link {
                parent,
                before: frame * turned,
                kind,
                value: affine,
                body: Body::nothing(),
                row: j,
            });
            at[joint.child] = Some((Some(links.len() - 1), turned.inverse()));
        }
        for (body, at) in m.bodies.iter().zip(&at) {
            let Some((Some(link), frame)) = at else { continue };
            if body.is_unweighed {
                return Err(Unknown::Unweighed(body.name.clone()));
            }
            if let Some(mass) = &body.mass {
                let own: Option<Vec<T>> = mass.body().parameters().into_iter().map(&value).collect();
                let own = own.and_then(|all| <[T; 10]>::try_from(all).ok());
                let own = own.ok_or_else(|| Unknown::NoValue(body.name.clone()))?;
                if number(mass.mass).is_some_and(|m| m < 0.0) {
                    return Err(Unknown::NegativeMass(body.name.clone()));
                }
                links[*link].body = links[*link].body + Body::of(own).seen_from(frame);
            }
        }
        let (n, d) = GRAVITY;
        let o = Expr::int(0);
        let gravity = m.gravity.unwrap_or([o, o, Expr::from(Rational::new(-n, d))]).map(&value);
        let [Some(x), Some(y), Some(z)] = gravity else { return Err(Unknown::NoValue(m.name.clone())) };
        let gravity = Vector([x, y, z]);
        let dynamics = Dynamics { links, tool: Transform::identity(), gravity, drives };
        Ok(OfTree { dynamics, joints, places: at })
    }
}

fn number(e: Expr) -> Option<f64> {
    e.eval(|_| None).ok().filter(|x| x.is_finite())
}

fn values<T: Scalar>(x: &Transform<Expr>, value: impl Fn(Expr) -> Option<T>) -> Option<Transform<T>> {
    let mut all = true;
    let found = x.map(|e| {
        value(e).unwrap_or_else(|| {
            all = false;
            T::zero()
        })
    });
    all.then_some(found)
}

/// The rotation with these columns for z and x.
fn frame_about<T: Scalar>(z: Vector<T>, x: Vector<T>) -> Rotation<T> {
    let y = z.cross(x);
    Rotation::from_rows([0, 1, 2].map(|i| [x[i], y[i], z[i]]))
}
