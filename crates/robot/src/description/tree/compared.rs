//! Two trees of bodies held against each other: whether their ends are proved to move alike.
//!
//! A body moves as the joints on the way to it do, one behind the other. So it moves as a body of another tree does if these joints
//! have the same axes at rest, count by the same values, and the two have the same pose at rest: each joint and each end is compared
//! once in its numbers, however many ways go over it.

use super::{Mechanism, rest};
use crate::description::JointKind;
use crate::description::lines::{Alike, Pose, frame_on};
use denavit_symbolic::Rational;
use denavit_symbolic::real::Values;
use std::collections::HashMap;

/// What stands still stands elsewhere where it is as far apart (directions, and metres).
const STILL: f64 = 1e-12;

/// How a body of one tree moves as one of another.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Likeness {
    /// Nothing moves it, and it stands where the other does, up to rounding.
    Still,
    /// It is proved to move as the other.
    Proved,
    /// Axes and poses at rest are the same in 60 digits, which is no proof.
    Close,
    /// Its joints are of the same kinds in the same order; their axes or the poses at rest are others.
    Open,
    /// Other joints move it.
    OtherJoints,
}

/// What of two trees is alike.
#[derive(Clone, Debug)]
pub struct Alikeness {
    /// Of each pair of ends.
    pub ends: Vec<Likeness>,
    /// For each variable of the first tree that of the second by which the same joint counts, if one does.
    pub variables: Vec<Option<usize>>,
}

/// A tree with all variables at 0.
struct AtRest<'m> {
    tree: &'m Mechanism,
    /// The variable that moves each joint, and how many times.
    moves: Vec<Option<(usize, Rational)>>,
    /// Of each joint that moves a frame whose z is its axis.
    axes: Vec<Option<Pose>>,
    /// Of each body its frame.
    frames: Vec<Pose>,
    /// The joint to each body.
    to: Vec<Option<usize>>,
}

impl<'m> AtRest<'m> {
    /// Nothing where an axis has no direction.
    fn of(tree: &'m Mechanism) -> Option<Self> {
        let variables = tree.variables();
        let mut values = Values::default();
        let mut frames = vec![Pose::identity(); tree.bodies.len()];
        let (mut axes, mut moves) = (vec![], vec![]);
        for (j, joint) in tree.joints.iter().enumerate() {
            let before = frames[joint.parent].times(&Pose::of(&joint.origin, &mut values)?);
            let (leader, factor) = match &joint.follows {
                Some(f) => (f.joint, f.factor.clone()),
                None => (j, Rational::ONE),
            };
            let moving = joint.kind.filter(|_| !factor.is_zero());
            axes.push(match moving {
                Some(_) => Some(frame_on(&before, joint.axis, &mut values)?),
                None => None,
            });
            moves.push(moving.and_then(|_| Some((variables.binary_search(&leader).ok()?, factor))));
            frames[joint.child] = before.times(&rest(joint, &mut values)?);
        }
        Some(AtRest { tree, moves, axes, frames, to: tree.joints_to() })
    }

    /// The joints that move a body, the last one first.
    fn way(&self, body: usize) -> impl Iterator<Item = usize> {
        let up = std::iter::successors(self.to[body], |&j| self.to[self.tree.joints[j].parent]);
        up.take(self.tree.joints.len()).filter(|&j| self.moves[j].is_some())
    }
}

impl Mechanism {
    /// How bodies of this tree move as those of another do, which are given beside them if there are such; nothing where an axis has
    /// no direction.
    pub fn alikeness(&self, other: &Mechanism, ends: &[(usize, Option<usize>)]) -> Option<Alikeness> {
        let (a, b) = (AtRest::of(self)?, AtRest::of(other)?);
        let mut there: Vec<Option<usize>> = vec![None; self.variables().len()];
        let mut here: Vec<Option<usize>> = vec![None; other.variables().len()];
        let mut known: HashMap<(usize, usize), Alike> = HashMap::new();
        let mut axes = |i: usize, j: usize| {
            *known.entry((i, j)).or_insert_with(|| {
                let slides = self.joints[i].kind == Some(JointKind::Prismatic);
                let both = a.axes[i].as_ref().zip(b.axes[j].as_ref());
                both.map_or(Alike::No, |(x, y)| x.axis_alike(y, slides))
            })
        };
        let mut all = vec![];
        for &(end, other_end) in ends {
            let way: Vec<usize> = a.way(end).collect();
            let other_way: Vec<usize> = other_end.into_iter().flat_map(|e| b.way(e)).collect();
            if way.is_empty() && other_way.is_empty() {
                let is_elsewhere = other_end.is_some_and(|e| a.frames[end].apart(&b.frames[e]) > STILL);
                all.push(if is_elsewhere { Likeness::Open } else { Likeness::Still });
                continue;
            }
            let both = || way.iter().zip(&other_way);
            let pair = |(&i, &j): (&usize, &usize)| {
                let (Some((v, k)), Some((w, l))) = (&a.moves[i], &b.moves[j]) else { return None };
                let is_free = there[*v].is_none_or(|t| t == *w) && here[*w].is_none_or(|t| t == *v);
                (is_free && k == l && self.joints[i].kind == other.joints[j].kind).then_some((*v, *w))
            };
            let pairs: Option<Vec<(usize, usize)>> = both().map(pair).collect();
            // One variable may move several joints of the way.
            let is_one = |pairs: &Vec<(usize, usize)>| {
                let mut known: HashMap<usize, usize> = HashMap::new();
                let mut back: HashMap<usize, usize> = HashMap::new();
                pairs
                    .iter()
                    .all(|&(v, w)| *known.entry(v).or_insert(w) == w && *back.entry(w).or_insert(v) == v)
            };
            let pairs = pairs.filter(|p| way.len() == other_way.len() && is_one(p));
            let (Some(other_end), Some(pairs)) = (other_end, pairs) else {
                all.push(Likeness::OtherJoints);
                continue;
            };
            for (v, w) in pairs {
                (there[v], here[w]) = (Some(w), Some(v));
            }
            let axes = both().map(|(&i, &j)| axes(i, j));
            let worst = axes.chain([a.frames[end].alike(&b.frames[other_end])]).max();
            all.push(match worst {
                Some(Alike::Exactly) => Likeness::Proved,
                Some(Alike::Rounded) => Likeness::Close,
                _ => Likeness::Open,
            });
        }
        Some(Alikeness { ends: all, variables: there })
    }
}
