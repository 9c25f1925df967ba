//! A whole tree of bodies in numbers: a link for each joint that moves, on the link that it stands on, and what is fixed to it part of
//! it. All algorithms over numbers go for it as for an arm; formulas are derived of arms alone. What stands on the root moves with
//! nothing: the root stands still.

use super::model::{Drive, Dynamics, GRAVITY, Link};
use crate::description::Mechanism;
use crate::geometry::{Body, Rotation, Transform, Vector};
use crate::mechanism::Affine;
use denavit_symbolic::Expr;
use std::fmt;

/// A tree with masses.
#[derive(Clone, PartialEq, Debug)]
pub struct OfTree {
    /// Its links, with no tool.
    pub dynamics: Dynamics<f64>,
    /// The joints that move by themselves, by their numbers in the mechanism: the variables.
    pub joints: Vec<usize>,
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
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unknown::NoMasses => f.write_str("it says nothing of masses"),
            Unknown::Unweighed(body) => write!(f, "not all of what `{body}` weighs is known"),
            Unknown::NoValue(what) => write!(f, "a number of `{what}` has no value"),
            Unknown::NoAxis(joint) => write!(f, "the axis of `{joint}` has no direction"),
        }
    }
}

impl std::error::Error for Unknown {}

impl OfTree {
    /// The dynamics of all joints that move; gravity along −z of the root where the mechanism says nothing of it.
    ///
    /// # Errors
    /// If masses or values are missing, or an axis has no direction.
    pub fn new(m: &Mechanism) -> Result<Self, Unknown> {
        if m.bodies.iter().all(|b| b.mass.is_none() && !b.is_unweighed) {
            return Err(Unknown::NoMasses);
        }
        let joints = m.variables();
        let mut place = vec![None; m.joints.len()];
        joints.iter().enumerate().for_each(|(k, &j)| place[j] = Some(k));
        let mut links: Vec<Link<f64>> = vec![];
        let mut drives = vec![Drive::nothing(); joints.len()];
        // The link of each body, and its frame there; those of the root stand in the base.
        let mut at: Vec<Option<(Option<usize>, Transform<f64>)>> = vec![None; m.bodies.len()];
        at[m.root] = Some((None, Transform::identity()));
        // The joint to a body stands before those behind it.
        for (j, joint) in m.joints.iter().enumerate() {
            let Some((parent, frame)) = at[joint.parent] else { continue };
            let unknown = || Unknown::NoValue(joint.name.clone());
            let frame = frame * numbers(&joint.origin).ok_or_else(unknown)?;
            let Some(kind) = joint.kind else {
                at[joint.child] = Some((parent, frame));
                continue;
            };
            let axis = Vector([0, 1, 2].map(|i| number(joint.axis[i]).unwrap_or(f64::NAN)));
            let turn = onto_z(axis).ok_or_else(|| Unknown::NoAxis(joint.name.clone()))?;
            let (leader, factor, offset) = match &joint.follows {
                None => (place[j], 1.0, 0.0),
                Some(f) => (place[f.joint], f.factor.to_f64(), number(f.offset).ok_or_else(unknown)?),
            };
            let leader = leader.ok_or_else(unknown)?;
            let value = Affine { offset, quarters: 0, terms: vec![(leader, factor)] };
            let part = |e: Option<Expr>| e.map_or(Some(0.0), number).ok_or_else(unknown);
            let drive = &mut drives[leader];
            drive.rotor += factor * factor * part(joint.drive.rotor)?;
            drive.viscous += factor * factor * part(joint.drive.viscous)?;
            drive.coulomb += factor.abs() * part(joint.drive.coulomb)?;
            let turned = Transform::from_rotation_translation(turn, Vector::zero());
            links.push(Link {
                parent,
                before: frame * turned,
                kind,
                value,
                body: Body::nothing(),
                row: links.len(),
            });
            at[joint.child] = Some((Some(links.len() - 1), turned.inverse()));
        }
        for (body, at) in m.bodies.iter().zip(&at) {
            let Some((Some(link), frame)) = at else { continue };
            if body.is_unweighed {
                return Err(Unknown::Unweighed(body.name.clone()));
            }
            if let Some(mass) = &body.mass {
                let own = mass.body().parameters().map(|e| number(e).unwrap_or(f64::NAN));
                if own.iter().any(|x| x.is_nan()) {
                    return Err(Unknown::NoValue(body.name.clone()));
                }
                links[*link].body = links[*link].body + Body::of(own).seen_from(frame);
            }
        }
        let (n, d) = GRAVITY;
        let down = [0.0, 0.0, -(n as f64) / d as f64];
        let gravity = m.gravity.map_or(Some(Vector(down)), |g| {
            let [x, y, z] = g.map(number);
            Some(Vector([x?, y?, z?]))
        });
        let gravity = gravity.ok_or_else(|| Unknown::NoValue(m.name.clone()))?;
        Ok(OfTree { dynamics: Dynamics { links, tool: Transform::identity(), gravity, drives }, joints })
    }
}

fn number(e: Expr) -> Option<f64> {
    e.eval(|_| None).ok().filter(|x| x.is_finite())
}

fn numbers(x: &Transform<Expr>) -> Option<Transform<f64>> {
    let mut all = true;
    let found = x.map(|e| {
        number(e).unwrap_or_else(|| {
            all = false;
            0.0
        })
    });
    all.then_some(found)
}

/// A rotation whose z is along an axis.
fn onto_z(axis: Vector<f64>) -> Option<Rotation<f64>> {
    let length = axis.dot(axis).sqrt();
    if !(length.is_finite() && length > 0.0) {
        return None;
    }
    let z = axis.scale(1.0 / length);
    let x = z.any_across();
    let y = z.cross(x);
    Some(Rotation::from_rows([0, 1, 2].map(|i| [x[i], y[i], z[i]])))
}
