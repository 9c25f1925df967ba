//! The masses of a chain through the tree, on its rows.

use super::{Body, Chain, Joint, Mass, Mechanism, moved};
use crate::description::lines::settled;
use crate::description::{Description, JointKind, NamedFrame, Row};
use crate::geometry;
use crate::geometry::{Transform, Vector};
use denavit_symbolic::Expr;
use denavit_symbolic::real::Values;
use std::fmt;

impl Mass {
    /// About the origin of the body's frame.
    pub fn body(&self) -> geometry::Body<Expr> {
        geometry::Body::about_centre(self.mass, Vector(self.com), self.inertia)
    }

    /// A body in the form of files: its numbers in their shortest form.
    pub(in crate::description) fn of_body(body: &geometry::Body<Expr>) -> Option<Self> {
        let (centre, inertia) = body.at_centre()?;
        let mut values = Values::default();
        let mut short = |e: Expr| values.of(e).map_or(e, |x| x.settled());
        Some(Mass { mass: short(body.mass), com: centre.0.map(&mut short), inertia: inertia.map(&mut short) })
    }
}

/// Why the rows of a chain have no masses, although bodies of its file weigh.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Unweighed {
    /// This body, which the chain moves, weighs something of which the mass is not known.
    Body(String),
    /// This joint hangs on the chain and moves with a joint of it, and so does what weighs behind it.
    Joint(String),
}

impl fmt::Display for Unweighed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unweighed::Body(name) => {
                write!(f, "not all of what `{name}` weighs is known: the rows of this chain have no masses")
            }
            Unweighed::Joint(name) => write!(
                f,
                "`{name}` is not on the way, moves with a joint of it, and something weighs behind it: the rows of this chain \
                 have no masses"
            ),
        }
    }
}

/// A body on which a moving joint of a chain ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landing {
    /// The body.
    pub body: usize,
    /// Its frame in the base of the chain with all variables 0.
    pub at_rest: Transform<Expr>,
}

impl Mechanism {
    /// Puts the masses of the bodies on the rows that move them, with those of all that is fixed to them: bodies behind joints
    /// that are not among the `moving` ones stand as these joints are at 0, and the joints are returned whose bodies weigh. Where
    /// masses are not known, or move with the chain beside it, the rows get none.
    pub(super) fn weigh_rows(
        &self,
        d: &mut Description,
        moving: &[usize],
        landings: &[Landing],
        first: usize,
    ) -> (Vec<usize>, Option<Unweighed>) {
        if self.bodies.iter().all(|b| b.mass.is_none() && !b.is_unweighed) {
            return (vec![], None);
        }
        let leader = |j: usize| self.joints[j].follows.as_ref().map_or(j, |f| f.joint);
        let leaders: Vec<usize> = moving.iter().map(|&j| leader(j)).collect();
        let mut unweighed = None;
        let mut seen = vec![false; self.bodies.len()];
        let mut held = vec![];
        // What is fixed to the base does not move, but what hangs on it beside the chain is not part of it either.
        let at = self.joints_at();
        self.fixed_to(first, Transform::identity(), (&at, moving), &mut seen);
        let rows = frames_at_rest(d);
        let mut rows = rows.into_iter();
        for landing in landings {
            let bodies = self.fixed_to(landing.body, landing.at_rest, (&at, moving), &mut seen);
            let Some((i, frame)) = rows.next() else { break };
            for Fixed { body, held, .. } in &bodies {
                let Body { name, mass, is_unweighed, .. } = &self.bodies[*body];
                let moves = held.filter(|&j| mass.is_some() && leaders.contains(&leader(j)));
                let why = moves.map(|j| Unweighed::Joint(self.joints[j].name.clone()));
                let unknown = is_unweighed.then(|| Unweighed::Body(name.clone()));
                unweighed = unweighed.or(why).or(unknown);
            }
            let weighing = bodies.iter().filter(|f| self.bodies[f.body].mass.is_some());
            for joint in weighing.filter_map(|f| f.held) {
                if !held.contains(&joint) {
                    held.push(joint);
                }
            }
            let seen_from = |f: &Fixed| {
                let mass = self.bodies[f.body].mass.as_ref()?;
                Some(mass.body().seen_from(&settled(&(frame.inverse() * f.at_rest))))
            };
            let sum = bodies.iter().filter_map(seen_from).reduce(|a, b| a + b);
            if let Some(mass) = sum.as_ref().and_then(Mass::of_body) {
                let row = &mut d.rows[i];
                (row.mass, row.com, row.inertia) = (Some(mass.mass), Some(mass.com), Some(mass.inertia));
            }
        }
        held.sort_unstable();
        if unweighed.is_some() {
            d.rows.iter_mut().for_each(Row::weigh_nothing);
        }
        (held, unweighed)
    }

    /// The bodies that do not move on frames of a chain, as frames of its table: those of frame 0 and of the rows that move. What
    /// hangs behind joints beside the chain is not among them.
    pub fn frames(&self, chain: &Chain) -> Vec<NamedFrame> {
        let d = &chain.description;
        let mut seen = vec![false; self.bodies.len()];
        let start = Landing { body: chain.from, at_rest: Transform::identity() };
        let rows =
            [(None, d.base)].into_iter().chain(frames_at_rest(d).into_iter().map(|(i, x)| (Some(i), x)));
        let at = self.joints_at();
        let mut found = vec![];
        for (landing, (on, frame)) in [start].iter().chain(&chain.landings).zip(rows) {
            let fixed = self.fixed_to(landing.body, landing.at_rest, (&at, &chain.moving), &mut seen);
            found.extend(fixed.into_iter().filter(|f| f.held.is_none()).map(|f| NamedFrame {
                name: self.bodies[f.body].name.clone(),
                on,
                pose: settled(&(frame.inverse() * f.at_rest)),
            }));
        }
        found
    }

    /// The joints at each body.
    fn joints_at(&self) -> Vec<Vec<usize>> {
        let mut at = vec![vec![]; self.bodies.len()];
        for (j, joint) in self.joints.iter().enumerate() {
            at[joint.parent].push(j);
            at[joint.child].push(j);
        }
        at
    }

    /// A body with all that is fixed to it, or held where it is behind a joint that is not among the `moving` ones.
    fn fixed_to(
        &self,
        body: usize,
        at_rest: Transform<Expr>,
        (at, moving): (&[Vec<usize>], &[usize]),
        seen: &mut [bool],
    ) -> Vec<Fixed> {
        let (mut found, mut pending) = (vec![], vec![Fixed { body, at_rest, held: None }]);
        while let Some(fixed) = pending.pop() {
            if std::mem::replace(&mut seen[fixed.body], true) {
                continue;
            }
            found.push(fixed);
            let others = at[fixed.body].iter().filter(|j| !moving.contains(j));
            for (j, joint) in others.map(|&j| (j, &self.joints[j])) {
                let through = || joint.origin * rest(joint);
                let held = joint.kind.map(|_| j).or(fixed.held);
                if joint.parent == fixed.body {
                    pending.push(Fixed { body: joint.child, at_rest: fixed.at_rest * through(), held });
                } else if joint.child == fixed.body {
                    let at_rest = fixed.at_rest * through().inverse();
                    pending.push(Fixed { body: joint.parent, at_rest, held });
                }
            }
        }
        found
    }
}

/// A body that moves with another.
#[derive(Clone, Copy)]
struct Fixed {
    body: usize,
    /// Its frame in the base of the chain with all variables 0.
    at_rest: Transform<Expr>,
    /// The last joint before it that could move it.
    held: Option<usize>,
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
