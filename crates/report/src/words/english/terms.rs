//! Terms that several documents share.

use super::English;
use crate::tree::Proof;
use crate::words::Terms;
use denavit::forward::{Proof as ForwardProof, Reference};
use denavit::inverse::Part;
use denavit_program::Count;
use denavit_symbolic::Refusal;

impl Terms for English {
    fn code(&self) -> &'static str {
        "en"
    }

    fn babel(&self) -> Option<[&'static str; 2]> {
        None
    }

    fn has_decimal_comma(&self) -> bool {
        false
    }

    fn listed(&self, words: &[String]) -> String {
        match words {
            [] => String::new(),
            [one] => one.clone(),
            [front @ .., last] => format!("{} and {last}", front.join(", ")),
        }
    }

    fn proof(&self, proof: Proof) -> &'static str {
        match proof {
            Proof::Proved => "proved",
            Proof::Sampled => "checked at sample poses",
            Proof::Wrong => "NOT TRUE",
        }
    }

    fn mark(&self, proof: Proof) -> &'static str {
        match proof {
            Proof::Proved => "✓",
            Proof::Sampled => "≈",
            Proof::Wrong => "NOT TRUE",
        }
    }

    fn spoken_mark(&self, mark: &str) -> &'static str {
        match mark {
            "✓" => "proved",
            "≈" => "checked at sample poses",
            _ => "not true",
        }
    }

    fn other_entries_vanish(&self) -> String {
        "the other entries are 0".into()
    }

    fn of_frame(&self, frame: Reference) -> String {
        match frame {
            Reference::Base => "of the base".into(),
            Reference::Tool => "of the tool".into(),
            Reference::Frame(i) => format!("of frame {i}"),
        }
    }

    fn unexpanded(&self, why: Refusal) -> String {
        why.to_string()
    }

    fn forward_proof(&self, proof: ForwardProof) -> String {
        equality(proof, "the product of the link transforms")
    }

    fn jacobian_proof(&self, proof: ForwardProof) -> String {
        equality(proof, "the derivative of the product of the link transforms")
    }

    fn count(&self, count: &Count) -> String {
        count.to_string()
    }

    fn part(&self, part: Part) -> &'static str {
        match part {
            Part::Shoulder => "shoulder",
            Part::Elbow => "elbow",
            Part::Wrist => "wrist",
            Part::Reach => "reach",
        }
    }
}

fn equality(proof: ForwardProof, with: &str) -> String {
    match proof {
        ForwardProof::Proved => format!("proved equal to {with}"),
        ForwardProof::Undecided(why) => format!("not proved: {why}"),
        ForwardProof::Failed => "not proved: the canonical forms differ".into(),
    }
}
