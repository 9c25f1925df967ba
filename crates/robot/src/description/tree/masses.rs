//! The masses of a chain through the tree, on its rows.

use super::{Joint, Mass, Mechanism, moved};
use crate::description::lines::settled;
use crate::description::{Description, JointKind};
use crate::geometry::{Body, Transform, Vector};
use denavit_symbolic::Expr;
use denavit_symbolic::real::Values;

impl Mass {
    /// About the origin of the body's frame.
    pub fn body(&self) -> Body<Expr> {
        Body::about_centre(self.mass, Vector(self.com), self.inertia)
    }

    /// A body in the form of files: its numbers in their shortest form.
    pub(in crate::description) fn of_body(body: &Body<Expr>) -> Option<Self> {
        let (centre, inertia) = body.at_centre()?;
        let mut values = Values::default();
        let mut short = |e: Expr| values.of(e).map_or(e, |x| x.settled());
        Some(Mass { mass: short(body.mass), com: centre.0.map(&mut short), inertia: inertia.map(&mut short) })
    }
}

/// A body on which a moving joint of a chain ends.
#[derive(Clone, Copy)]
pub(super) struct Landing {
    /// The body.
    pub body: usize,
    /// Its frame in the base of the chain with all variables 0.
    pub at_rest: Transform<Expr>,
}

impl Mechanism {
    /// Puts the masses of the bodies on the rows that move them, with those of all that is fixed to them: bodies behind joints
    /// that are not among the `moving` ones stand as these joints are at 0, and the joints are returned whose bodies weigh.
    pub(super) fn weigh_rows(
        &self,
        d: &mut Description,
        moving: &[usize],
        landings: &[Landing],
        first: usize,
    ) -> Vec<usize> {
        if self.bodies.iter().all(|b| b.mass.is_none()) {
            return vec![];
        }
        let mut seen = vec![false; self.bodies.len()];
        let mut held = vec![];
        // What is fixed to the base does not move, but what hangs on it beside the chain is not part of it either.
        self.fixed_to(first, Transform::identity(), moving, &mut seen, &mut vec![]);
        let rows = frames_at_rest(d);
        let mut rows = rows.into_iter();
        for landing in landings {
            let bodies = self.fixed_to(landing.body, landing.at_rest, moving, &mut seen, &mut held);
            let Some((i, frame)) = rows.next() else { break };
            let seen_from = |(b, x): &(usize, Transform<Expr>)| {
                let mass = self.bodies[*b].mass.as_ref()?;
                Some(mass.body().seen_from(&settled(&(frame.inverse() * *x))))
            };
            let sum = bodies.iter().filter_map(seen_from).reduce(|a, b| a + b);
            if let Some(mass) = sum.as_ref().and_then(Mass::of_body) {
                let row = &mut d.rows[i];
                (row.mass, row.com, row.inertia) = (Some(mass.mass), Some(mass.com), Some(mass.inertia));
            }
        }
        held.sort_unstable();
        held
    }

    /// A body with all that is fixed to it, each with its frame in the base; joints that are held where they are.
    fn fixed_to(
        &self,
        body: usize,
        at_rest: Transform<Expr>,
        moving: &[usize],
        seen: &mut [bool],
        held: &mut Vec<usize>,
    ) -> Vec<(usize, Transform<Expr>)> {
        let (mut found, mut pending) = (vec![], vec![(body, at_rest, false)]);
        while let Some((b, x, is_held)) = pending.pop() {
            if std::mem::replace(&mut seen[b], true) {
                continue;
            }
            if is_held && self.bodies[b].mass.is_some() {
                held.extend(self.joint_to(b).filter(|j| !held.contains(j)));
            }
            found.push((b, x));
            let others = (0..self.joints.len()).filter(|j| !moving.contains(j));
            for joint in others.map(|j| &self.joints[j]) {
                let through = || joint.origin * rest(joint);
                let is_held = is_held || joint.kind.is_some();
                if joint.parent == b {
                    pending.push((joint.child, x * through(), is_held));
                } else if joint.child == b {
                    pending.push((joint.parent, x * through().inverse(), is_held));
                }
            }
        }
        found
    }
}

/// What a joint does where it is held: its value is 0, or that which it has where the joint that it follows is at 0.
fn rest(joint: &Joint) -> Transform<Expr> {
    let value = joint.follows.as_ref().map_or(Expr::int(0), |f| f.offset);
    let kind: Option<JointKind> = joint.kind;
    kind.map_or_else(Transform::identity, |kind| moved(joint, kind, value))
}

/// The rows that move and the frames behind them, in the base, with all variables 0.
fn frames_at_rest(d: &Description) -> Vec<(usize, Transform<Expr>)> {
    let variables: Vec<_> = d.variables().iter().map(|v| v.symbol).collect();
    let still = |e: Expr| e.substitute(|s| variables.contains(&s).then(|| Expr::int(0)));
    let moves = |e: Expr| e.symbols().iter().any(|s| variables.contains(s));
    let mut x = d.base;
    let mut frames = vec![];
    for (i, row) in d.rows.iter().enumerate() {
        for screw in row.screws(d.convention) {
            x = x * screw.transform().map(still);
        }
        x = settled(&x);
        if moves(row.theta) || moves(row.d) {
            frames.push((i, x));
        }
    }
    frames
}
