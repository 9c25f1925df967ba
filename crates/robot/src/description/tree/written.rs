//! What files of bodies and joints share when they are written: names of joints that are their own, and simple solids in place of
//! links, a bar to each joint that a body carries, or a ball.

use super::{Joint, Mechanism};
use crate::description::xml::escaped;
use crate::geometry::Vector;
use denavit_symbolic::Expr;
use std::collections::HashSet;

/// How thick solids are, of the longest way from a joint to the next.
const THICKNESS: f64 = 0.06;
/// The thinnest ones, metres.
const THINNEST: f64 = 0.005;

/// The names of joints as they are written, each its own.
pub(in crate::description) fn joint_names(tree: &Mechanism) -> Vec<String> {
    let mut taken: HashSet<String> = HashSet::new();
    let one = |joint: &Joint| {
        let name = escaped(&joint.name);
        let numbered = (2..).map(|k| format!("{name}_{k}"));
        let own = std::iter::once(name.clone()).chain(numbered).find(|n| !taken.contains(n));
        let own = own.unwrap_or(name);
        taken.insert(own.clone());
        own
    };
    tree.joints.iter().map(one).collect()
}

/// The solids of a tree whose numbers are constants.
pub(in crate::description) struct Solids {
    /// The joints on each body.
    pub on: Vec<Vec<usize>>,
    /// Of bars and balls, metres.
    pub radius: f64,
    origins: Vec<[f64; 3]>,
}

fn length(p: &[f64; 3]) -> f64 {
    p.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl Solids {
    pub fn new(tree: &Mechanism) -> Self {
        let mut on: Vec<Vec<usize>> = vec![vec![]; tree.bodies.len()];
        for (j, joint) in tree.joints.iter().enumerate() {
            on[joint.parent].push(j);
        }
        let value = |e: Expr| e.eval(|_| None).unwrap_or(f64::NAN);
        let origins: Vec<[f64; 3]> = tree
            .joints
            .iter()
            .map(|j| {
                let Vector(p) = j.origin.translation.map(value);
                p
            })
            .collect();
        let far = origins.iter().map(length).fold(0.0, f64::max);
        Solids { on, radius: (THICKNESS * far).max(THINNEST), origins }
    }

    /// The ends of a body's bars, which begin at its origin.
    pub fn bars(&self, body: usize) -> Vec<[f64; 3]> {
        let ends = self.on[body].iter().map(|&j| self.origins[j]);
        ends.filter(|p| length(p) > self.radius).collect()
    }
}
