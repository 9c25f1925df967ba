//! Terms that several documents share, in each language: frames, operation counts, proofs, refusals.

use super::language::Language;
use crate::forward::{Proof, Reference};
use denavit_program::Count;
use denavit_symbolic::Refusal;

impl Reference {
    /// With its article and *of*: `of frame 3`, `de l'outil`.
    pub fn of(self, language: Language) -> String {
        match self {
            Reference::Base => language.pick("of the base", "de la base").into(),
            Reference::Tool => language.pick("of the tool", "de l’outil").into(),
            Reference::Frame(i) => language.pick(format!("of frame {i}"), format!("du repère {i}")),
        }
    }
}

impl Proof {
    /// In words, of a program that computes `what`.
    fn words(self, language: Language, what: [&str; 2]) -> String {
        match self {
            Proof::Proved => language
                .pick(format!("proved equal to {}", what[0]), format!("égalité démontrée avec {}", what[1])),
            Proof::Undecided(why) => {
                let why = refusal(why, language);
                language.pick(format!("not proved: {why}"), language.spaced(&format!("non démontré : {why}")))
            }
            Proof::Failed => language
                .pick(
                    "not proved: the canonical forms differ",
                    "non démontré\u{a0}: les formes canoniques diffèrent",
                )
                .into(),
        }
    }

    /// In words, of a forward model.
    pub fn of_model(self, language: Language) -> String {
        self.words(language, ["the product of the link transforms", "le produit des matrices de passage"])
    }

    /// In words, of a Jacobian.
    pub fn of_jacobian(self, language: Language) -> String {
        self.words(
            language,
            [
                "the derivative of the product of the link transforms",
                "la dérivée du produit des matrices de passage",
            ],
        )
    }
}

/// Why a formula was not expanded.
pub fn refusal(why: Refusal, language: Language) -> String {
    let french = match why {
        Refusal::TooLarge => "le développement est trop grand pour conclure",
        Refusal::Undefined => {
            "un dénominateur est identiquement nul, ou l’on prend la racine d’un nombre négatif"
        }
        Refusal::OutsideBasis => {
            "un angle n’est pas un multiple entier des angles sur lesquels la formule est construite"
        }
    };
    language.pick(why.to_string(), french.into())
}

/// What a program costs.
pub fn count(count: &Count, language: Language) -> String {
    if language == Language::English {
        return count.to_string();
    }
    let counted = |n: u32, one: &str, many: &str| format!("{n} {}", if n < 2 { one } else { many });
    let mut parts = vec![
        counted(count.multiplications, "multiplication", "multiplications"),
        counted(count.additions, "addition", "additions"),
        counted(count.sincos, "couple sinus-cosinus", "couples sinus-cosinus"),
    ];
    for (n, one, many) in [
        (count.divisions, "division", "divisions"),
        (count.roots, "racine", "racines"),
        (count.arctangents, "arc tangente", "arcs tangentes"),
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
    let apart =
        if apart.is_empty() { String::new() } else { format!("\u{a0}; à part\u{a0}: {}", apart.join(", ")) };
    parts.join(", ") + &apart
}
