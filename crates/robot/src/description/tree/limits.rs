//! Limits of joints that move together.

use super::Mechanism;
use denavit_symbolic::{Angle, Expr, Rational};
use std::collections::HashMap;

/// Limits that are nearer to each other leave a joint no way to move, radians or metres.
const LEAST: f64 = 1e-9;

impl Mechanism {
    /// The limits of a joint where these joints move, itself among them: its own, or those of the joint that it follows, narrowed by those
    /// of the joints that move with it. Limits that would leave no way to move do not count: files have such of joints that
    /// follow others.
    pub fn limits_among(&self, joint: usize, among: &[usize]) -> Option<[Expr; 2]> {
        let (leader, factor, offset) = self.course(joint);
        let others = among.iter().copied().filter(|&j| j != joint && self.leader(j) == leader);
        let mut along: Vec<usize> = std::iter::once(joint).chain(others).collect();
        // The leader first: its limits count in any case.
        along.sort_by_key(|&j| (j != leader, j != joint));
        let mut found: Option<[Expr; 2]> = None;
        for j in along {
            let (_, by, plus) = self.course(j);
            let Some(ends) = self.joints[j].limits.filter(|_| by != Rational::ZERO) else { continue };
            // x_j = by ℓ + plus, and the joint's value is factor ℓ + offset.
            let ratio = &factor / &by;
            let here = |x: Expr| match j == joint {
                true => x,
                false => Angle::of(Expr::from(ratio.clone()) * (x - plus) + offset).to_expr(),
            };
            let [low, high] = ends.map(here);
            let ends = if ratio < Rational::ZERO { [high, low] } else { [low, high] };
            found = Some(found.map_or(ends, |before| narrowed(before, ends).unwrap_or(before)));
        }
        found
    }

    /// The limits of the variables, narrowed by those of all joints that follow them, in doubles.
    pub fn variable_limits(&self) -> Vec<Option<[f64; 2]>> {
        let number = |e: Expr| e.eval(|_| None).ok();
        let of = |ends: Option<[Expr; 2]>| ends.and_then(|[a, b]| Some([number(a)?, number(b)?]));
        self.limits_of_variables().map(of).collect()
    }

    /// The same exactly.
    pub(in crate::description) fn limits_of_variables(&self) -> impl Iterator<Item = Option<[Expr; 2]>> {
        let mut followers: HashMap<usize, Vec<usize>> = HashMap::new();
        for (j, joint) in self.joints.iter().enumerate() {
            if let Some(f) = &joint.follows {
                followers.entry(f.joint).or_default().push(j);
            }
        }
        let of = move |j: usize| self.limits_among(j, followers.get(&j).map_or(&[], Vec::as_slice));
        self.variables().into_iter().map(of)
    }

    /// What moves a joint: itself, or the one that it follows.
    fn leader(&self, joint: usize) -> usize {
        self.joints[joint].follows.as_ref().map_or(joint, |f| f.joint)
    }

    /// What moves a joint, by how much, and what is added.
    fn course(&self, joint: usize) -> (usize, Rational, Expr) {
        match &self.joints[joint].follows {
            Some(f) => (f.joint, f.factor.clone(), f.offset),
            None => (joint, Rational::ONE, Expr::int(0)),
        }
    }
}

/// What two ranges have in common; nothing if that is no range, or they are no numbers.
fn narrowed([low, high]: [Expr; 2], other: [Expr; 2]) -> Option<[Expr; 2]> {
    let number = |e: Expr| e.eval(|_| None).ok();
    let lower = if number(other[0])? > number(low)? { other[0] } else { low };
    let upper = if number(other[1])? < number(high)? { other[1] } else { high };
    (number(upper)? - number(lower)? > LEAST).then_some([lower, upper])
}
