//! Terms that several documents share.

use super::{French, counted};
use crate::tree::Proof;
use crate::words::Terms;
use denavit::forward::{Proof as ForwardProof, Reference};
use denavit::inverse::Part;
use denavit_program::Count;
use denavit_symbolic::Refusal;

impl Terms for French {
    fn code(&self) -> &'static str {
        "fr"
    }

    fn babel(&self) -> Option<[&'static str; 2]> {
        Some(["french", "french"])
    }

    fn has_decimal_comma(&self) -> bool {
        true
    }

    fn between(&self) -> &'static str {
        "\u{a0}; "
    }

    fn listed(&self, words: &[String]) -> String {
        match words {
            [] => String::new(),
            [one] => one.clone(),
            [front @ .., last] => format!("{} et {last}", front.join(", ")),
        }
    }

    fn proof(&self, proof: Proof) -> &'static str {
        match proof {
            Proof::Proved => "démontré",
            Proof::Sampled => "vérifié en des poses d’essai",
            Proof::Wrong => "FAUX",
        }
    }

    fn mark(&self, proof: Proof) -> &'static str {
        match proof {
            Proof::Proved => "✓",
            Proof::Sampled => "≈",
            Proof::Wrong => "FAUX",
        }
    }

    fn spoken_mark(&self, mark: &str) -> &'static str {
        match mark {
            "✓" => "démontré",
            "≈" => "vérifié pour des poses d’essai",
            _ => "faux",
        }
    }

    fn other_entries_vanish(&self) -> String {
        "les autres éléments sont nuls".into()
    }

    fn of_frame(&self, frame: Reference) -> String {
        match frame {
            Reference::Base => "de la base".into(),
            Reference::Tool => "de l’outil".into(),
            Reference::Frame(i) => format!("du repère {i}"),
        }
    }

    fn unexpanded(&self, why: Refusal) -> String {
        match why {
            Refusal::TooLarge => "le développement est trop grand pour conclure",
            Refusal::Undefined => {
                "un dénominateur est identiquement nul, ou l’on prend la racine d’un nombre négatif"
            }
            Refusal::OutsideBasis => {
                "un angle n’est pas un multiple entier des angles sur lesquels la formule est construite"
            }
        }
        .into()
    }

    fn forward_proof(&self, proof: ForwardProof) -> String {
        self.equality(proof, "le produit des matrices de passage")
    }

    fn jacobian_proof(&self, proof: ForwardProof) -> String {
        self.equality(proof, "la dérivée du produit des matrices de passage")
    }

    fn count(&self, count: &Count) -> String {
        let counted = |n: u32, one: &str, many: &str| counted(n as usize, one, many);
        let mut parts = vec![
            counted(count.multiplications, "multiplication", "multiplications"),
            counted(count.additions, "addition", "additions"),
            counted(count.sincos, "paire sinus-cosinus", "paires sinus-cosinus"),
        ];
        for (n, one, many) in [
            (count.divisions, "division", "divisions"),
            (count.roots, "racine", "racines"),
            (count.arctangents, "arc tangente", "arcs tangentes"),
            (count.signs, "fonction signe", "fonctions signe"),
        ] {
            if n > 0 {
                parts.push(counted(n, one, many));
            }
        }
        let mut apart = vec![];
        if count.offsets > 0 {
            apart.push(counted(count.offsets, "décalage de variable", "décalages de variables"));
        }
        if count.hoisted > 0 {
            apart.push(counted(count.hoisted, "opération", "opérations") + " sur les seuls paramètres");
        }
        let parts = parts.join(", ");
        if apart.is_empty() { parts } else { say!("{parts} ; à part : {}", apart.join(", ")) }
    }

    fn part(&self, part: Part) -> &'static str {
        match part {
            Part::Shoulder => "épaule",
            Part::Elbow => "coude",
            Part::Wrist => "poignet",
            Part::Reach => "portée",
        }
    }
}

impl French {
    fn equality(&self, proof: ForwardProof, with: &str) -> String {
        match proof {
            ForwardProof::Proved => format!("égalité démontrée avec {with}"),
            ForwardProof::Undecided(why) => say!("non démontré : {}", self.unexpanded(why)),
            ForwardProof::Failed => say!("non démontré : les formes canoniques diffèrent"),
        }
    }
}
