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

    /// The language's name in babel, a package of LaTeX, and its options; nothing where no package is needed.
    fn babel(&self) -> Option<[&'static str; 2]>;

    /// Whether a half is written `0,5`.
    fn has_decimal_comma(&self) -> bool;

    /// A text of numbers, `0.5 m`, with the decimal sign of the language: where a point stands between digits.
    fn written(&self, numbers: String) -> String {
        if self.has_decimal_comma() { with_commas(&numbers) } else { numbers }
    }

    /// Between numbers of a list, which may have decimals.
    fn between(&self) -> &'static str {
        if self.has_decimal_comma() { "; " } else { ", " }
    }

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

/// A text with commas for the points between digits.
fn with_commas(text: &str) -> String {
    let all: Vec<char> = text.chars().collect();
    let is_digit = |k: usize| all.get(k).is_some_and(char::is_ascii_digit);
    let one = |(k, c): (usize, &char)| match c {
        '.' if k > 0 && is_digit(k - 1) && is_digit(k + 1) => ',',
        c => *c,
    };
    all.iter().enumerate().map(one).collect()
}
