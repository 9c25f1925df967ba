//! The masses of a chain through the tree, on its rows.

use super::{Body, Chain, Mass, Mechanism, rest};
use crate::description::lines::{Pose, settled};
use crate::description::{Description, NamedFrame, Row};
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
#[derive(Clone, Debug)]
pub(super) struct Landing {
    /// The body.
    pub body: usize,
    /// Its frame in the base of the chain with all variables 0.
    pub at_rest: Pose,
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
        let hanging = self.hanging(moving);
        let mut values = Values::default();
        self.fixed_to(&Landing::first(first), &hanging, &mut seen, &mut values);
        let rows = frames_at_rest(d);
        let mut rows = rows.into_iter();
        for landing in landings {
            let bodies = self.fixed_to(landing, &hanging, &mut seen, &mut values);
            let Some((i, frame)) = rows.next() else { break };
            let frame = Pose::of(&frame, &mut values);
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
                Some(mass.body().seen_from(&frame.as_ref()?.seen(&f.at_rest).settled()))
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
        let start = Landing::first(chain.from);
        let mut values = Values::default();
        let rows =
            [(None, d.base)].into_iter().chain(frames_at_rest(d).into_iter().map(|(i, x)| (Some(i), x)));
        let hanging = self.hanging(&chain.moving);
        let mut found = vec![];
        for (landing, (on, frame)) in [start].iter().chain(&chain.landings).zip(rows) {
            let fixed = self.fixed_to(landing, &hanging, &mut seen, &mut values);
            let Some(frame) = Pose::of(&frame, &mut values) else { continue };
            found.extend(fixed.into_iter().filter(|f| f.held.is_none()).map(|f| NamedFrame {
                name: self.bodies[f.body].name.clone(),
                on,
                pose: frame.seen(&f.at_rest).settled(),
            }));
        }
        found
    }

    /// What hangs on what beside these joints.
    fn hanging(&self, moving: &[usize]) -> Hanging {
        let mut at = vec![vec![]; self.bodies.len()];
        for (j, joint) in self.joints.iter().enumerate() {
            at[joint.parent].push(j);
            at[joint.child].push(j);
        }
        let mut is_moving = vec![false; self.joints.len()];
        moving.iter().for_each(|&j| is_moving[j] = true);
        Hanging { at, is_moving }
    }

    /// A body with all that is fixed to it, or held where it is behind a joint that is not among those that move.
    fn fixed_to(
        &self,
        landing: &Landing,
        hanging: &Hanging,
        seen: &mut [bool],
        values: &mut Values,
    ) -> Vec<Fixed> {
        let first = Fixed { body: landing.body, at_rest: landing.at_rest.clone(), held: None };
        let (mut found, mut pending) = (vec![], vec![first]);
        while let Some(fixed) = pending.pop() {
            if std::mem::replace(&mut seen[fixed.body], true) {
                continue;
            }
            let others = hanging.at[fixed.body].iter().filter(|j| !hanging.is_moving[**j]);
            for (j, joint) in others.map(|&j| (j, &self.joints[j])) {
                let other = if joint.parent == fixed.body { joint.child } else { joint.parent };
                if seen[other] {
                    continue;
                }
                let mut through = || Some(Pose::of(&joint.origin, values)?.times(&rest(joint, values)?));
                let Some(through) = through() else { continue };
                let through = if joint.parent == fixed.body { through } else { through.inverse() };
                let held = joint.kind.map(|_| j).or(fixed.held);
                pending.push(Fixed { body: other, at_rest: fixed.at_rest.times(&through), held });
            }
            found.push(fixed);
        }
        found
    }
}

impl Landing {
    /// Where a chain begins.
    fn first(body: usize) -> Self {
        Landing { body, at_rest: Pose::identity() }
    }
}

/// The joints at each body, and which of all are those of a chain that move.
struct Hanging {
    at: Vec<Vec<usize>>,
    is_moving: Vec<bool>,
}

/// A body that moves with another.
#[derive(Clone)]
struct Fixed {
    body: usize,
    /// Its frame in the base of the chain with all variables 0.
    at_rest: Pose,
    /// The last joint before it that could move it.
    held: Option<usize>,
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
