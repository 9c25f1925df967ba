//! The order in which unknowns are found: always the cheapest step that is possible.

use super::candidates::Problem;
use super::known::{Known, Unknown};
use super::plan::{Form, Step};
use denavit_symbolic::Rational;
use denavit_symbolic::poly::Poly;

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

/// Searches with the values of some axes given, until the work is spent.
pub fn search(problem: &Problem, given: &[usize]) -> Outcome {
    search_on(problem, given, vec![])
}

/// Searches on behind some steps.
fn search_on(problem: &Problem, given: &[usize], mut steps: Vec<Step>) -> Outcome {
    let chain = problem.chain;
    let mut known = Known::new(chain, given);
    steps.iter().for_each(|s| known.learn(chain, s.unknown));
    let mut leaves: usize = steps.iter().map(|s| usize::from(s.cost.roots)).product();
    while !known.everything() && !chain.algebra.is_spent() {
        let mut found = problem.candidates(&known);
        found.retain(|s| leaves * usize::from(s.cost.roots) <= MAX_LEAVES);
        let Some(best) = found.into_iter().min_by_key(|s| (s.cost, order(s))) else { break };
        leaves *= usize::from(best.cost.roots);
        known.learn(chain, best.unknown);
        steps.push(best);
    }
    Outcome { steps, missing: known.open(chain) }
}

/// Derivations that find the unknown of a step in another way, for the places where the step's own equation does not
/// determine it: for each such step the cheapest. Only an arm with more equations than unknowns has them.
pub fn variants(problem: &Problem, given: &[usize], steps: &[Step]) -> Vec<(usize, Vec<Step>)> {
    let mut known = Known::new(problem.chain, given);
    let mut found = vec![];
    for (i, step) in steps.iter().enumerate() {
        if step.cost.condition > 0
            && let Some(own) = divisor(step)
        {
            let other = |s: &Step| {
                s.unknown == step.unknown
                    && s.cost.roots <= step.cost.roots
                    && divisor(s).is_some_and(|d| d != own)
            };
            let candidates = problem.candidates(&known).into_iter().filter(other);
            if let Some(best) = candidates.min_by_key(|s| (s.cost, order(s))) {
                let mut first = steps[..i].to_vec();
                first.push(best);
                let outcome = search_on(problem, given, first);
                if outcome.is_complete() {
                    found.push((i, outcome.steps));
                }
            }
        }
        known.learn(problem.chain, step.unknown);
    }
    found
}

/// What a step divides by, up to a factor: two polynomials at most, one of which must not vanish.
fn divisor(step: &Step) -> Option<[Poly; 2]> {
    let monic = |p: &Poly| match p.terms().first() {
        Some((_, r)) => p.scaled(&r.recip().unwrap_or(Rational::ONE)),
        None => Poly::zero(),
    };
    match &step.form {
        Form::Ratio { denominator, .. } => Some([monic(denominator), Poly::zero()]),
        Form::Line => Some([monic(&step.rows[0].a), monic(&step.rows[0].b)]),
        _ => None,
    }
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
