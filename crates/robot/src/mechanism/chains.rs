//! The chains of two descriptions of a tree, held against each other.

use super::compared::{COMPARED, Comparison, apart, compare, range};
use crate::description::{Convention, Description, Joint, JointKind, Likeness, Mechanism, RowTree};
use crate::random::Random;
use std::borrow::Cow;

/// A tree as it was described.
#[derive(Clone, Copy, Debug)]
pub enum Tree<'a> {
    /// As bodies and joints between them.
    Bodies(&'a Mechanism),
    /// As rows.
    Rows(&'a RowTree),
}

/// How many chains of a tree are those of another.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub struct Chains {
    /// Proved the same.
    pub proved: usize,
    /// Not proved, but compared in configurations.
    pub sampled: usize,
    /// By how much the poses of these differ at most (directions, and metres).
    pub most: f64,
    /// Of other joints than in the first tree.
    pub others: usize,
    /// Not compared: a parameter has no value, or what follows a joint beside the way is one of its own there.
    pub open: usize,
}

impl Chains {
    /// How many chains there are.
    pub fn count(&self) -> usize {
        self.proved + self.sampled + self.others + self.open
    }

    /// True if poses differ by more than doubles round by, or joints are others.
    pub fn differ(&self) -> bool {
        self.others > 0 || Comparison::Sampled(self.most).differs()
    }
}

impl Tree<'_> {
    /// The chain from the root to an end; of bodies nothing where it holds what follows a joint beside the way: that counts by
    /// itself there, and as that joint in rows.
    fn chain(&self, end: &str) -> Option<Option<Description>> {
        match self {
            Tree::Bodies(m) => {
                let chain = m.chain(None, Some(end), Convention::Khalil).ok()?;
                let follows = chain.joints.iter().any(|&j| m.joints[j].follows.is_some());
                Some((!follows).then_some(chain.description))
            }
            Tree::Rows(rows) => Some(Some(rows.chain(None, Some(end), Convention::Khalil).ok()?.description)),
        }
    }
}

/// So many rows on chains are compared chain by chain: for all values of their parameters (trees with more are compared at the values that
/// they have), or where numbers are not exact.
const FEW: usize = 2000;

/// Compares the chains from the root of a tree to these ends with those of rows, in which the ends have their second names. What has
/// no joint is no chain.
pub fn compare_chains(tree: Tree, rows: &RowTree, ends: &[(String, String)]) -> Chains {
    let is_named = |r: &RowTree| !r.parameters.is_empty() && r.rows.len() * ends.len() <= FEW;
    let bodies = match tree {
        Tree::Bodies(m) => Some(Cow::Borrowed(m)),
        Tree::Rows(r) if is_named(r) => None,
        Tree::Rows(r) => r.mechanism().ok().map(Cow::Owned),
    };
    let whole = bodies.and_then(|m| compare_whole(&m, rows, ends));
    whole.unwrap_or_else(|| compare_each(tree, rows, ends))
}

/// All chains at once, in numbers; nothing where there are none.
fn compare_whole<'a>(tree: &Mechanism, rows: &RowTree, ends: &'a [(String, String)]) -> Option<Chains> {
    let other = rows.mechanism().ok()?;
    let known = |(end, there): &'a (String, String)| {
        Some(((tree.body(end)?, other.body(&rows.named(there))), there.as_str()))
    };
    let (pairs, names): (Vec<_>, Vec<&str>) = ends.iter().filter_map(known).unzip();
    let mut alike = tree.alikeness(&other, &pairs)?;
    // Decimals of rows in place of roots are what they are in the chains of both.
    let is_open = |l: &Likeness| matches!(l, Likeness::Open | Likeness::Close);
    let open: Vec<usize> = (0..pairs.len()).filter(|&k| is_open(&alike.ends[k])).collect();
    if open.len() * rows.rows.len() <= FEW {
        for k in open {
            let [end, there] = [tree.bodies[pairs[k].0].name.as_str(), names[k]];
            let one = tree.chain(None, Some(end), Convention::Khalil).ok();
            let two = rows.chain(None, Some(there), Convention::Khalil).ok();
            let both = one.zip(two).map(|(a, b)| compare(&a.description, &b.description));
            if both == Some(Comparison::Proved) {
                alike.ends[k] = Likeness::Proved;
            }
        }
    }
    let count = |of: Likeness| alike.ends.iter().filter(|l| **l == of).count();
    let sampled = alike.ends.iter().filter(|l| is_open(l)).count();
    let (proved, others) = (count(Likeness::Proved), count(Likeness::OtherJoints));
    let mut found = Chains { proved, sampled, others, ..Chains::default() };
    if sampled == 0 {
        return Some(found);
    }
    let joints: Vec<&Joint> = tree.variables().into_iter().map(|j| &tree.joints[j]).collect();
    let ranges: Vec<[f64; 2]> =
        joints.iter().map(|j| range(j.kind.unwrap_or(JointKind::Revolute), j.limits)).collect();
    let (here, there) = (tree.placing(), other.placing());
    let mut random = Random(20);
    for _ in 0..COMPARED {
        let q: Vec<f64> = ranges.iter().map(|[low, high]| low + (high - low) * random.unit()).collect();
        let mut other_q = vec![0.0; other.variables().len()];
        for (x, v) in q.iter().zip(&alike.variables) {
            if let Some(v) = v {
                other_q[*v] = *x;
            }
        }
        let (x, y) = (here.poses(&q), there.poses(&other_q));
        let open = pairs.iter().zip(&alike.ends).filter(|(_, l)| is_open(l));
        for (a, b) in open.filter_map(|((a, b), _)| Some((*a, (*b)?))) {
            found.most = apart(found.most, &x[a], &y[b]);
        }
    }
    Some(found)
}

/// Each chain by itself.
fn compare_each(tree: Tree, rows: &RowTree, ends: &[(String, String)]) -> Chains {
    let mut found = Chains::default();
    for (end, there) in ends {
        let Some(one) = tree.chain(end) else { continue };
        let other = rows.chain(None, Some(there), Convention::Khalil).ok();
        let compared = match (one, other) {
            (Some(one), Some(other)) => compare(&one, &other.description),
            (Some(_), None) => Comparison::OtherJoints,
            (None, _) => {
                found.open += 1;
                continue;
            }
        };
        match compared {
            Comparison::Proved => found.proved += 1,
            Comparison::Sampled(by) => {
                found.sampled += 1;
                found.most = found.most.max(by);
            }
            Comparison::OtherJoints => found.others += 1,
            Comparison::NoNumbers(_) => found.open += 1,
        }
    }
    found
}
