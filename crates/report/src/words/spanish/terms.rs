//! Terms that several documents share.

use super::{Spanish, counted};
use crate::tree::Proof;
use crate::words::Terms;
use denavit::forward::{Proof as ForwardProof, Reference};
use denavit::inverse::Part;
use denavit_program::Count;
use denavit_symbolic::Refusal;

impl Terms for Spanish {
    fn code(&self) -> &'static str {
        "es"
    }

    fn babel(&self) -> Option<[&'static str; 2]> {
        // Dots of formulas stay dots, and no character is a command.
        Some(["spanish", "spanish,es-noshorthands,es-nodecimaldot,es-noindentfirst"])
    }

    fn has_decimal_comma(&self) -> bool {
        true
    }

    fn listed(&self, words: &[String]) -> String {
        match words {
            [] => String::new(),
            [one] => one.clone(),
            // *Y* before the sound of an i is *e*.
            [front @ .., last] => {
                let behind = last.trim_start_matches(|c: char| c.is_ascii_digit() || c == ' ');
                let is_i = behind == *last && (last.starts_with('i') || last.starts_with("hi"));
                format!("{} {} {last}", front.join(", "), if is_i { "e" } else { "y" })
            }
        }
    }

    fn proof(&self, proof: Proof) -> &'static str {
        match proof {
            Proof::Proved => "demostrado",
            Proof::Sampled => "comprobado en poses de prueba",
            Proof::Wrong => "FALSO",
        }
    }

    fn mark(&self, proof: Proof) -> &'static str {
        match proof {
            Proof::Proved => "✓",
            Proof::Sampled => "≈",
            Proof::Wrong => "FALSO",
        }
    }

    fn spoken_mark(&self, mark: &str) -> &'static str {
        match mark {
            "✓" => "demostrado",
            "≈" => "comprobado en poses de prueba",
            _ => "falso",
        }
    }

    fn other_entries_vanish(&self) -> String {
        "los demás elementos son nulos".into()
    }

    fn of_frame(&self, frame: Reference) -> String {
        match frame {
            Reference::Base => "de la base".into(),
            Reference::Tool => "de la herramienta".into(),
            Reference::Frame(i) => format!("del sistema {i}"),
        }
    }

    fn unexpanded(&self, why: Refusal) -> String {
        match why {
            Refusal::TooLarge => "el desarrollo es demasiado grande para decidir",
            Refusal::Undefined => {
                "un denominador es idénticamente nulo, o aparece la raíz de un número negativo"
            }
            Refusal::OutsideBasis => {
                "un ángulo no es múltiplo entero de los ángulos con los que está construida la fórmula"
            }
        }
        .into()
    }

    fn forward_proof(&self, proof: ForwardProof) -> String {
        self.equality(proof, "el producto de las matrices de transformación")
    }

    fn jacobian_proof(&self, proof: ForwardProof) -> String {
        self.equality(proof, "la derivada del producto de las matrices de transformación")
    }

    fn count(&self, count: &Count) -> String {
        let counted = |n: u32, one: &str, many: &str| counted(n as usize, one, many);
        let mut parts = vec![
            counted(count.multiplications, "multiplicación", "multiplicaciones"),
            counted(count.additions, "suma", "sumas"),
            counted(count.sincos, "par seno-coseno", "pares seno-coseno"),
        ];
        for (n, one, many) in [
            (count.divisions, "división", "divisiones"),
            (count.roots, "raíz", "raíces"),
            (count.arctangents, "arcotangente", "arcotangentes"),
            (count.signs, "función signo", "funciones signo"),
        ] {
            if n > 0 {
                parts.push(counted(n, one, many));
            }
        }
        let mut apart = vec![];
        if count.offsets > 0 {
            apart.push(counted(count.offsets, "desfase de variable", "desfases de variables"));
        }
        if count.hoisted > 0 {
            apart.push(counted(count.hoisted, "operación", "operaciones") + " solo con parámetros");
        }
        let parts = parts.join(", ");
        if apart.is_empty() { parts } else { format!("{parts}; aparte, {}", apart.join(", ")) }
    }

    fn part(&self, part: Part) -> &'static str {
        match part {
            Part::Shoulder => "hombro",
            Part::Elbow => "codo",
            Part::Wrist => "muñeca",
            Part::Reach => "alcance",
        }
    }
}

impl Spanish {
    fn equality(&self, proof: ForwardProof, with: &str) -> String {
        match proof {
            ForwardProof::Proved => format!("igualdad demostrada con {with}"),
            ForwardProof::Undecided(why) => format!("no demostrado: {}", self.unexpanded(why)),
            ForwardProof::Failed => "no demostrado: las formas canónicas difieren".into(),
        }
    }
}
