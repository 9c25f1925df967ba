//! A tree of rows with masses.

use super::model::{Drive, Dynamics, Link};
use crate::description::JointKind;
use crate::geometry::{Axis, Body, Rotation, Transform, Vector};
use crate::mechanism::Link as Row;
use crate::scalar::Scalar;

impl<T: Scalar> Dynamics<T> {
    /// A tree of rows, each with what it stands on, in the convention of Khalil: with the mass of each in its own frame, the drives of its
    /// variables, under gravity. It has no tool; what is fixed to the base does not count.
    ///
    /// # Panics
    /// If a row stands on a later one.
    pub(crate) fn of_rows(
        base: Transform<T>,
        rows: &[(Row<T>, Option<usize>)],
        bodies: &[Body<T>],
        drives: Vec<Drive<T>>,
        gravity: Vector<T>,
    ) -> Self {
        let mut links: Vec<Link<T>> = vec![];
        // The link that each row's frame is fixed to, and its place there.
        let mut at: Vec<(Option<usize>, Transform<T>)> = vec![];
        for (k, (row, on)) in rows.iter().enumerate() {
            let (mut parent, before) = on.map_or((None, base), |on| at[on]);
            if !row.moves() {
                at.push((parent, before * row.transform(&[])));
                continue;
            }
            let mut before = before * row.before;
            let body = Body::nothing();
            if row.turns() {
                if !row.slides() {
                    before = before * Transform::translation_z(row.d.offset);
                }
                links.push(Link {
                    parent,
                    before,
                    kind: JointKind::Revolute,
                    value: row.theta.clone(),
                    body,
                    row: k,
                });
                (parent, before) = (Some(links.len() - 1), Transform::identity());
            }
            if row.slides() {
                if !row.turns() {
                    let (s, c) = row.theta.at_rest().sin_cos(&[]);
                    let turn = Rotation::from_sin_cos(Axis::Z, s, c);
                    before = before * Transform::from_rotation_translation(turn, Vector::zero());
                }
                links.push(Link {
                    parent,
                    before,
                    kind: JointKind::Prismatic,
                    value: row.d.clone(),
                    body,
                    row: k,
                });
            }
            at.push((Some(links.len() - 1), row.after));
        }
        for (body, (on, place)) in bodies.iter().zip(&at) {
            if let Some(link) = on {
                links[*link].body = links[*link].body + body.seen_from(place);
            }
        }
        Dynamics { links, tool: Transform::identity(), gravity, drives }
    }
}
