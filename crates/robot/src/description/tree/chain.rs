//! A serial chain through the tree.

use super::masses::{Landing, Unweighed};
use super::{Joint, JointDrive, Mechanism};
use crate::description::lines::{Agreement, AxisAtRest, ChainAtRest, NotPlaced, Pose};
use crate::description::{Convention, Description, JointKind, MAX_ROWS, diagnostic::nearest};
use crate::geometry::{Rotation, Transform, Vector};
use denavit_symbolic::real::Values;
use denavit_symbolic::{Expr, Rational};
use std::fmt;

/// A chain through a mechanism.
#[derive(Clone, Debug)]
pub struct Chain {
    /// Its table.
    pub description: Description,
    /// The body it begins at.
    pub from: usize,
    /// The body it ends at.
    pub to: usize,
    /// The joint of the mechanism that each joint variable is the value of.
    pub joints: Vec<usize>,
    /// How the table was found to be the chain.
    pub agreement: Agreement,
    /// Joints that are not of the chain and behind which something weighs that hangs on a link of it: they count as fixed at 0.
    pub held: Vec<usize>,
    /// Why its rows have no masses, if bodies of the file weigh.
    pub unweighed: Option<Unweighed>,
    /// The joints that move, in order, and the bodies on which they end.
    pub(super) moving: Vec<usize>,
    pub(super) landings: Vec<Landing>,
}

/// Why there is no chain.
#[derive(Clone, PartialEq, Debug)]
pub enum NoChain {
    /// There is no body of this name.
    Unknown {
        /// The name.
        name: String,
        /// One that may have been meant.
        near: Option<String>,
    },
    /// No joint moves between these.
    Rigid {
        /// Where it begins.
        from: String,
        /// Where it ends.
        to: String,
    },
    /// Several ends have as many joints, the most.
    Several(Vec<String>),
    /// More joints than a table may have rows.
    TooLong(usize),
    /// The axis of this joint has no direction.
    NoDirection(String),
    /// The chain is not a way down the tree, and these have no value.
    NeedsValues(Vec<String>),
}

impl fmt::Display for NoChain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoChain::Unknown { name, near: None } => write!(f, "there is no link `{name}`"),
            NoChain::Unknown { name, near: Some(near) } => {
                write!(f, "there is no link `{name}`; did you mean `{near}`?")
            }
            NoChain::Rigid { from, to } => write!(f, "no joint moves between `{from}` and `{to}`"),
            NoChain::Several(tips) => {
                write!(f, "there are several tips: {}", tips.join(", "))
            }
            NoChain::TooLong(joints) => write!(f, "a chain of {joints} joints; {} are allowed", MAX_ROWS / 2),
            NoChain::NoDirection(joint) => write!(f, "the axis of `{joint}` has no direction"),
            NoChain::NeedsValues(names) => {
                write!(
                    f,
                    "this chain does not go down the tree, and is made of values: {} has none",
                    names.join(", ")
                )
            }
        }
    }
}

impl std::error::Error for NoChain {}

/// A joint on the way, and whether it is gone through from its child to its parent.
#[derive(Clone, Copy)]
struct Step {
    joint: usize,
    is_up: bool,
}

impl Mechanism {
    /// The chain between two bodies, by their names: from the root, and to the leaf with the most joints, where none is given.
    ///
    /// Its joint variables are the joints on the way in order, each counting as in the mechanism. Of joints that follow one, and this
    /// itself, the first on the way is the variable.
    ///
    /// # Errors
    /// If there is no such body, several ends, or nothing that moves.
    pub fn chain(
        &self,
        from: Option<&str>,
        to: Option<&str>,
        convention: Convention,
    ) -> Result<Chain, NoChain> {
        let find = |name: &str| {
            let near = || nearest(name, self.bodies.iter().map(|b| b.name.as_str())).map(str::to_string);
            self.body(name).ok_or_else(|| NoChain::Unknown { name: name.into(), near: near() })
        };
        let from = from.map_or(Ok(self.root), find)?;
        let to = match to {
            Some(name) => find(name)?,
            None => self.tip(from)?,
        };
        self.between(from, to, convention)
    }

    /// The leaf with the most joints on the way to it.
    pub(in crate::description) fn tip(&self, from: usize) -> Result<usize, NoChain> {
        let mut is_above = vec![false; self.bodies.len()];
        is_above[from] = true;
        for &joint in &self.to_root(from, &self.joints_to()) {
            is_above[self.joints[joint].parent] = true;
        }
        // The joints that move by themselves between the root and a body, and between the root and where its way joins that of the
        // beginning: the joint to a body stands before those behind it.
        let mut count = vec![0_usize; self.bodies.len()];
        let mut shared = count.clone();
        for joint in &self.joints {
            let moves = joint.kind.is_some() && joint.follows.is_none();
            count[joint.child] = count[joint.parent] + usize::from(moves);
            shared[joint.child] =
                if is_above[joint.child] { count[joint.child] } else { shared[joint.parent] };
        }
        let leaves: Vec<(usize, usize)> = self
            .leaves()
            .into_iter()
            .filter(|&l| l != from)
            .map(|l| (count[l] + count[from] - 2 * shared[l], l))
            .collect();
        let most = leaves.iter().map(|l| l.0).max().unwrap_or(0);
        let tips: Vec<usize> = leaves.iter().filter(|l| l.0 == most).map(|l| l.1).collect();
        match tips[..] {
            [tip] => Ok(tip),
            [] => Err(self.rigid(from, from)),
            _ if most == 0 => Err(self.rigid(from, tips[0])),
            _ => Err(NoChain::Several(tips.iter().map(|&t| self.bodies[t].name.clone()).collect())),
        }
    }

    fn rigid(&self, from: usize, to: usize) -> NoChain {
        let name = |b: usize| self.bodies[b].name.clone();
        NoChain::Rigid { from: name(from), to: name(to) }
    }

    /// The joints from a body to the root, where these are the joints to bodies.
    pub(super) fn to_root(&self, body: usize, to: &[Option<usize>]) -> Vec<usize> {
        let mut all = vec![];
        let mut body = body;
        while let Some(joint) = to[body].filter(|_| all.len() <= self.joints.len()) {
            all.push(joint);
            body = self.joints[joint].parent;
        }
        all
    }

    /// A body in the root's frame, all joints at 0.
    fn at_rest(&self, up: &[usize], values: &mut Values) -> Option<Pose> {
        up.iter().rev().try_fold(Pose::identity(), |x, &joint| {
            let joint = &self.joints[joint];
            Some(x.times(&Pose::of(&joint.origin, values)?).times(&rest(joint, values)?))
        })
    }

    /// The joints on the way between two bodies whose joints to the root these are.
    fn way(up: &[usize], down: &[usize]) -> Vec<Step> {
        let common = up.iter().rev().zip(down.iter().rev()).take_while(|(a, b)| a == b).count();
        let upward = up[..up.len() - common].iter().map(|&joint| Step { joint, is_up: true });
        let downward = down[..down.len() - common].iter().rev().map(|&joint| Step { joint, is_up: false });
        upward.chain(downward).collect()
    }

    fn between(&self, from: usize, to: usize, convention: Convention) -> Result<Chain, NoChain> {
        let joints_to = self.joints_to();
        let up = self.to_root(from, &joints_to);
        let way = Self::way(&up, &self.to_root(to, &joints_to));
        // Each moving joint on the way as a variable's factor and an offset.
        let mut joints: Vec<usize> = vec![];
        let mut axes: Vec<AxisAtRest> = vec![];
        let mut of_axis: Vec<usize> = vec![];
        let mut values = Values::default();
        let mut x = Pose::identity();
        let mut beside = None;
        let mut landings: Vec<Landing> = vec![];
        let mut ratios: Vec<(usize, Rational)> = vec![];
        for Step { joint: j, is_up } in way.iter().copied() {
            let joint = &self.joints[j];
            let (moves, rest) = self.moves(j, &way, &mut joints);
            let mut frame = |x: &Transform<Expr>| Pose::of(x, &mut values).ok_or(self.rigid(from, to));
            let motion = match joint.kind.filter(|_| !rest.is_zero()) {
                Some(kind) => Some(frame(&moved(joint, kind, rest))?),
                None => None,
            };
            let origin = frame(&joint.origin)?;
            if !is_up {
                x = x.times(&origin);
            }
            if let (Some(kind), Some(moves)) = (joint.kind, moves) {
                let here = x.formula();
                let direction = here.act_on_vector(joint.axis);
                let direction = if is_up { -direction } else { direction };
                ratios.push(moves.clone());
                axes.push(AxisAtRest { kind, point: here.translation, direction, moves: vec![moves] });
                of_axis.push(j);
                beside.get_or_insert(here.rotation);
            }
            if let Some(motion) = motion {
                x = x.times(&if is_up { motion.inverse() } else { motion });
            }
            if is_up {
                x = x.times(&origin.inverse());
            }
            if of_axis.last() == Some(&j) {
                let body = if is_up { joint.parent } else { joint.child };
                landings.push(Landing { body, at_rest: x.clone() });
            }
        }
        if axes.is_empty() {
            return Err(self.rigid(from, to));
        }
        if axes.len() > MAX_ROWS / 2 {
            return Err(NoChain::TooLong(axes.len()));
        }
        let chain = ChainAtRest { axes, tip: x.formula(), beside: beside.unwrap_or_else(Rotation::identity) };
        let placed = chain.description(&self.name, convention).map_err(|why| match why {
            NotPlaced::NoDirection(k) => NoChain::NoDirection(self.joints[of_axis[k]].name.clone()),
            NotPlaced::Symbols => self.rigid(from, to),
        });
        let (mut description, agreement) = placed?;
        self.name_rows(&mut description, &of_axis, &joints, &ratios);
        let variables = self.variables();
        let pose = |(name, values): &(String, Vec<Expr>)| {
            (name.clone(), joints.iter().map(|&j| self.value_of(j, &variables, values)).collect())
        };
        description.poses = self.poses.iter().map(pose).collect();
        description.gravity = self.gravity.and_then(|g| {
            let there = self.at_rest(&up, &mut values)?.inverse();
            let turned = there.formula().act_on_vector(Vector(g));
            Some(turned.0.map(|e| values.of(e).map_or(e, |x| x.settled())))
        });
        let (held, unweighed) = self.weigh_rows(&mut description, &of_axis, &landings, from);
        Ok(Chain { description, from, to, joints, agreement, held, unweighed, moving: of_axis, landings })
    }

    /// What moves a joint: a variable of the chain with its factor, none if it stands still; and its value at rest.
    fn moves(&self, j: usize, way: &[Step], joints: &mut Vec<usize>) -> (Option<(usize, Rational)>, Expr) {
        let none = Expr::int(0);
        if self.joints[j].kind.is_none() {
            return (None, none);
        }
        let of = |j: usize| match &self.joints[j].follows {
            Some(f) => (f.joint, f.factor.clone(), f.offset),
            None => (j, Rational::ONE, Expr::int(0)),
        };
        let (leader, factor, offset) = of(j);
        if factor.is_zero() {
            return (None, offset);
        }
        // The variable is that of the row which introduces it: it has the row's name.
        let is_one = |s: &&Step| {
            let (other, factor, _) = of(s.joint);
            self.joints[s.joint].kind.is_some() && other == leader && !factor.is_zero()
        };
        let own = way.iter().find(is_one).map_or(j, |s| s.joint);
        let (_, own_factor, own_offset) = of(own);
        let ratio = &factor / &own_factor;
        let rest = offset - Expr::from(ratio.clone()) * own_offset;
        let known = joints.iter().position(|&k| k == own);
        let number = known.unwrap_or(joints.len());
        if known.is_none() {
            joints.push(own);
        }
        (Some((number, ratio)), rest)
    }

    /// Names, limits and drives of the joints; `ratios` says of each axis which variable moves it, and how many times.
    fn name_rows(
        &self,
        d: &mut Description,
        of_axis: &[usize],
        joints: &[usize],
        ratios: &[(usize, Rational)],
    ) {
        let drives: Vec<JointDrive> = (0..joints.len())
            .map(|k| {
                let of_variable = of_axis.iter().zip(ratios).filter(|(_, r)| r.0 == k);
                JointDrive::together(of_variable.map(|(&j, r)| (&self.joints[j].drive, &r.1)))
            })
            .collect();
        let names: Vec<&str> = of_axis.iter().map(|&j| self.joints[j].name.as_str()).collect();
        let symbols: Vec<_> = d.variables().iter().map(|v| v.symbol).collect();
        let moves = |e: Expr| e.symbols().iter().any(|s| symbols.contains(s));
        let rows = d.rows.iter_mut().filter(|r| moves(r.theta) || moves(r.d));
        let mut next = 0;
        for (row, name) in rows.zip(names) {
            row.name = Some(name.into());
            if row.variable.is_some() {
                (row.limits, row.velocity) = self.limits_on(joints[next], of_axis);
                let drive = drives[next];
                (row.rotor, row.viscous, row.coulomb) = (drive.rotor, drive.viscous, drive.coulomb);
                next += 1;
            }
        }
    }

    /// The limits of a joint and of its rate on a way on which these joints move: those of the joint that it follows, if this moves
    /// there as well and has any.
    fn limits_on(&self, joint: usize, way: &[usize]) -> (Option<[Expr; 2]>, Option<Expr>) {
        let own = &self.joints[joint];
        let limits = self.limits_among(joint, way);
        let Some(follows) = own.follows.as_ref().filter(|f| way.contains(&f.joint)) else {
            return (limits, own.velocity);
        };
        let leader = &self.joints[follows.joint];
        let velocity = leader.velocity.map(|v| Expr::from(follows.factor.abs()) * v);
        (limits, velocity.or(own.velocity))
    }
}

/// What a joint does where it is held: its value is 0, or that which it has where the joint that it follows is at 0.
pub(in crate::description) fn rest(joint: &Joint, values: &mut Values) -> Option<Pose> {
    let value = joint.follows.as_ref().map_or(Expr::int(0), |f| f.offset);
    match joint.kind.filter(|_| !value.is_zero()) {
        Some(kind) => Pose::of(&moved(joint, kind, value), values),
        None => Some(Pose::identity()),
    }
}

/// What a joint does at a value, in its frame: a turn about its axis or a slide along it.
pub(in crate::description) fn moved(joint: &Joint, kind: JointKind, value: Expr) -> Transform<Expr> {
    if value.is_zero() {
        return Transform::identity();
    }
    if kind == JointKind::Prismatic {
        let axis = joint.axis.scale(Expr::int(1) / joint.axis.norm());
        return Transform::from_rotation_translation(Rotation::identity(), axis.scale(value));
    }
    Transform::from_rotation_translation(turned(joint.axis, value), Vector::zero())
}

/// The turn about an axis of any length.
pub(in crate::description) fn turned(axis: Vector<Expr>, angle: Expr) -> Rotation<Expr> {
    // 1 + sin θ·[z] + (1 − cos θ)·[z]²
    let [x, y, z] = axis.scale(Expr::int(1) / axis.norm()).0;
    let ((s, c), one) = (angle.sin_cos(), Expr::int(1));
    let v = one - c;
    Rotation::from_rows([
        [one - v * (y * y + z * z), v * x * y - s * z, v * x * z + s * y],
        [v * x * y + s * z, one - v * (x * x + z * z), v * y * z - s * x],
        [v * x * z - s * y, v * y * z + s * x, one - v * (x * x + y * y)],
    ])
}
