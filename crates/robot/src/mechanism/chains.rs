//! The chains of two descriptions of a tree, held against each other.

use super::compared::{Comparison, compare};
use crate::description::{Convention, Description, Mechanism, RowTree};

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

/// Compares the chains from the root of a tree to these ends with those of rows, in which the ends have their second names. What has
/// no joint is no chain.
pub fn compare_chains(tree: Tree, rows: &RowTree, ends: &[(String, String)]) -> Chains {
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
