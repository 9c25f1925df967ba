//! The order in which unknowns are found: always the cheapest step that is possible.

use super::candidates::Problem;
use super::known::{Known, Unknown, axis_unknown};
use super::plan::{Form, Step};

/// Values a derivation may lead to in all.
pub const MAX_LEAVES: usize = 64;

/// How a search ended.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The steps that were found, in order.
    pub steps: Vec<Step>,
    /// What could not be found; empty for a complete derivation.
    pub missing: Vec<Unknown>,
}

impl Outcome {
    /// How many branches there are.
    pub fn leaves(&self) -> usize {
        self.steps.iter().map(|s| usize::from(s.cost.roots)).product()
    }

    /// True if every axis is known.
    pub fn is_complete(&self) -> bool {
        self.missing.is_empty()
    }
}

/// Searches with the values of some axes given.
pub fn search(problem: &Problem, given: &[usize]) -> Outcome {
    let chain = problem.chain;
    let mut known = Known::new(chain, given);
    let mut steps: Vec<Step> = vec![];
    let mut leaves = 1;
    while !known.everything() {
        let mut found = problem.candidates(&known);
        found.retain(|s| leaves * usize::from(s.cost.roots) <= MAX_LEAVES);
        let Some(best) = found.into_iter().min_by_key(|s| (s.cost, order(s))) else { break };
        leaves *= usize::from(best.cost.roots);
        known.learn(best.unknown);
        steps.push(best);
    }
    let missing: Vec<Unknown> =
        (0..chain.axes.len()).map(|k| axis_unknown(chain, k)).filter(|&x| !known.knows(x)).collect();
    Outcome { steps, missing }
}

/// Among equals: the unknown nearer to the base, the simpler type.
fn order(step: &Step) -> (Unknown, u8) {
    let kind = match step.form {
        Form::Ratio { .. } => 0,
        Form::Pair { .. } => 1,
        Form::Line => 2,
        Form::Sincos => 3,
        Form::Quadratic { .. } => 4,
        Form::Quartic(_) => 5,
    };
    (step.unknown, kind)
}
