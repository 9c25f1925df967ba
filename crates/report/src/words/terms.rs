//! Terms that several documents share: lists, frames, operation counts, proofs, branches.

use crate::tree::Proof;
use denavit::forward::{Proof as ForwardProof, Reference};
use denavit::inverse::{Branch, Label, Part};
use denavit_program::Count;
use denavit_symbolic::Refusal;

/// Terms that several documents share.
pub trait Terms: Sync {
    /// Its code in HTML and Typst: `en`.
    fn code(&self) -> &'static str;

    /// The last of several behind the others: `a, b and c`.
    fn listed(&self, words: &[String]) -> String;

    /// Numbers from 0, shown from 1: `2, 3 and 4`.
    fn numbers(&self, all: &[usize]) -> String {
        self.listed(&all.iter().map(|k| (k + 1).to_string()).collect::<Vec<_>>())
    }

    /// What is known of a formula.
    fn proof(&self, proof: Proof) -> &'static str;

    /// The mark behind a formula: ✓, ≈, or that it is not true.
    fn mark(&self, proof: Proof) -> &'static str;

    /// A mark behind a formula, read aloud.
    fn spoken_mark(&self, mark: &str) -> &'static str;

    /// A matrix whose entries other than those listed are 0.
    fn other_entries_vanish(&self) -> String;

    /// With its article and *of*: `of frame 3`.
    fn of_frame(&self, frame: Reference) -> String;

    /// Why a formula was not expanded.
    fn unexpanded(&self, why: Refusal) -> String;

    /// Whether a forward model is proved.
    fn forward_proof(&self, proof: ForwardProof) -> String;

    /// Whether a Jacobian is proved.
    fn jacobian_proof(&self, proof: ForwardProof) -> String;

    /// What a program costs.
    fn count(&self, count: &Count) -> String;

    /// The part of an arm that a choice of roots is about.
    fn part(&self, part: Part) -> &'static str;

    /// The name of a step with several roots: `elbow2`.
    fn label(&self, label: Label) -> String {
        let part = self.part(label.part);
        if label.number == 1 { part.into() } else { format!("{part}{}", label.number) }
    }

    /// The name of a branch: `shoulder+ elbow2−`.
    fn branch(&self, branch: &Branch) -> String {
        let all = branch.0.iter().map(|(label, choice)| format!("{}{choice}", self.label(*label)));
        all.collect::<Vec<_>>().join(" ")
    }
}
