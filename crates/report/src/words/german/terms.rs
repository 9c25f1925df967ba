//! Terms that several documents share.

use super::{German, counted};
use crate::tree::Proof;
use crate::words::Terms;
use denavit::forward::{Proof as ForwardProof, Reference};
use denavit::inverse::Part;
use denavit_program::Count;
use denavit_symbolic::Refusal;

impl Terms for German {
    fn code(&self) -> &'static str {
        "de"
    }

    fn babel(&self) -> Option<[&'static str; 2]> {
        Some(["ngerman", "ngerman"])
    }

    fn has_decimal_comma(&self) -> bool {
        true
    }

    fn listed(&self, words: &[String]) -> String {
        match words {
            [] => String::new(),
            [one] => one.clone(),
            [front @ .., last] => format!("{} und {last}", front.join(", ")),
        }
    }

    fn proof(&self, proof: Proof) -> &'static str {
        match proof {
            Proof::Proved => "bewiesen",
            Proof::Sampled => "an Stichproben geprüft",
            Proof::Wrong => "FALSCH",
        }
    }

    fn mark(&self, proof: Proof) -> &'static str {
        match proof {
            Proof::Proved => "✓",
            Proof::Sampled => "≈",
            Proof::Wrong => "FALSCH",
        }
    }

    fn spoken_mark(&self, mark: &str) -> &'static str {
        match mark {
            "✓" => "bewiesen",
            "≈" => "an Stichproben geprüft",
            _ => "falsch",
        }
    }

    fn other_entries_vanish(&self) -> String {
        "alle übrigen Elemente sind 0".into()
    }

    fn of_frame(&self, frame: Reference) -> String {
        match frame {
            Reference::Base => "der Basis".into(),
            Reference::Tool => "des Werkzeugs".into(),
            Reference::Frame(i) => format!("des Koordinatensystems {i}"),
        }
    }

    fn unexpanded(&self, why: Refusal) -> String {
        match why {
            Refusal::TooLarge => "ausmultipliziert ist der Ausdruck zu groß, um zu entscheiden",
            Refusal::Undefined => {
                "ein Nenner ist identisch 0, oder es steht die Wurzel einer negativen Zahl da"
            }
            Refusal::OutsideBasis => {
                "ein Winkel ist kein ganzzahliges Vielfaches der Winkel, aus denen die Formel besteht"
            }
        }
        .into()
    }

    fn forward_proof(&self, proof: ForwardProof) -> String {
        self.equality(proof, "dem Produkt der Transformationsmatrizen")
    }

    fn jacobian_proof(&self, proof: ForwardProof) -> String {
        self.equality(proof, "der Ableitung des Produkts der Transformationsmatrizen")
    }

    fn count(&self, count: &Count) -> String {
        let counted = |n: u32, one: &str, many: &str| counted(n as usize, one, many);
        let mut parts = vec![
            counted(count.multiplications, "Multiplikation", "Multiplikationen"),
            counted(count.additions, "Addition", "Additionen"),
            counted(count.sincos, "Sinus-Kosinus-Paar", "Sinus-Kosinus-Paare"),
        ];
        for (n, one, many) in [
            (count.divisions, "Division", "Divisionen"),
            (count.roots, "Wurzel", "Wurzeln"),
            (count.arctangents, "Arkustangens", "Arkustangens"),
            (count.signs, "Vorzeichenfunktion", "Vorzeichenfunktionen"),
        ] {
            if n > 0 {
                parts.push(counted(n, one, many));
            }
        }
        let mut apart = vec![];
        if count.offsets > 0 {
            apart.push(counted(count.offsets, "Versatz einer Variablen", "Versätze von Variablen"));
        }
        if count.hoisted > 0 {
            apart.push(counted(count.hoisted, "Operation", "Operationen") + " mit den Parametern allein");
        }
        let parts = parts.join(", ");
        if apart.is_empty() { parts } else { format!("{parts}; dazu {}", apart.join(", ")) }
    }

    fn part(&self, part: Part) -> &'static str {
        match part {
            Part::Shoulder => "Schulter",
            Part::Elbow => "Ellenbogen",
            Part::Wrist => "Handgelenk",
            Part::Reach => "Reichweite",
        }
    }
}

impl German {
    /// `with` in the dative.
    fn equality(&self, proof: ForwardProof, with: &str) -> String {
        match proof {
            ForwardProof::Proved => format!("Gleichheit mit {with} bewiesen"),
            ForwardProof::Undecided(why) => format!("nicht bewiesen: {}", self.unexpanded(why)),
            ForwardProof::Failed => "nicht bewiesen: die kanonischen Formen sind verschieden".into(),
        }
    }
}
