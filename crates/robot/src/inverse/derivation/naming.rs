//! What the results of the steps are called.

use super::chain::NormalChain;
use super::inputs::Inputs;
use super::known::Unknown;
use super::plan::Step;
use denavit_symbolic::Symbol;
use rustc_hash::FxHashSet;

/// A name that is not taken.
pub(super) fn unique(mut name: String, taken: &mut FxHashSet<String>) -> String {
    while !taken.insert(name.clone()) {
        name.push('_');
    }
    name
}

/// Names of the results of each step: c23, s23, k23; r3.
pub(super) fn names(chain: &NormalChain, steps: &[Step], inputs: &Inputs) -> Vec<Vec<Symbol>> {
    let mut taken: FxHashSet<String> = chain
        .variables
        .iter()
        .chain(&chain.parameters)
        .chain(&chain.pose)
        .chain(inputs.symbols().iter())
        .map(|s| s.name().to_string())
        .collect();
    let mut name = |prefix: &str, index: &str| Symbol::new(&unique(format!("{prefix}{index}"), &mut taken));
    steps
        .iter()
        .map(|step| {
            let index = index(chain, step.unknown);
            let mut found = match step.unknown {
                Unknown::Angle(_) => vec![name("c", &index), name("s", &index)],
                Unknown::Slide(_) => vec![name("r", &index)],
            };
            if step.cost.roots > 1 {
                found.push(name("k", &index));
            }
            found
        })
        .collect()
}

/// The numbers of the axes whose angles add up to an unknown: 234.
pub fn index(chain: &NormalChain, x: Unknown) -> String {
    match x {
        Unknown::Slide(k) => (k + 1).to_string(),
        Unknown::Angle(d) => {
            let numbers: Vec<String> =
                chain.axes_between(d).iter().map(|(k, _)| (k + 1).to_string()).collect();
            numbers.join(if chain.axes.len() > 9 { "_" } else { "" })
        }
    }
}
