//! La dynamique.

use super::{French, counted};
use crate::tree::{Line, Math};
use crate::words::{Dynamics, Terms};
use denavit::dynamics::{Ground, Minimality};
use denavit::geometry::NoBody;
use denavit_program::Count;

impl Dynamics for French {
    fn dynamics_title(&self, robot: &str) -> String {
        say!("Modèle dynamique : {robot}")
    }

    fn link_parameters(&self, has_other_frames: bool) -> String {
        let frames = match has_other_frames {
            true => {
                "du repère dont l'axe z est porté par l'axe du corps (ceux du tableau dans la convention de Khalil, et non \
                 ceux de celui-ci)"
            }
            false => "de son repère",
        };
        say!(
            "Le corps j a pour inertie XXj … ZZj (un tenseur : XYj est l'opposé du produit d'inertie), pour premiers moments MXj, MYj, MZj et pour \
             masse Mj, le tout par rapport à l'origine {frames}. qd et qdd sont les vitesses et les accélérations \
             articulaires."
        )
    }

    fn no_body(&self, why: NoBody) -> &'static str {
        match why {
            NoBody::NotFinite => "un nombre n’est pas fini",
            NoBody::NegativeMass => "sa masse est négative",
            NoBody::NoMass => "sa masse est nulle, et son premier moment ou son inertie ne l’est pas",
            NoBody::NotPositive => "son inertie par rapport au centre de masse n’est pas positive",
            NoBody::Triangle => "l’un de ses moments principaux dépasse la somme des deux autres",
        }
    }

    fn gravity_is(&self, components: [Math; 3]) -> Line {
        Line::new(say!("L'accélération de la pesanteur dans la base est (")).list(components).text(").")
    }

    fn base_title(&self) -> String {
        "Paramètres de base".into()
    }

    fn base_count(&self, all: usize, base: usize, minimality: Minimality) -> String {
        let of = counted(all, "paramètre", "paramètres");
        let rest = match minimality {
            Minimality::Proved => {
                "Il n'en faut pas moins : les colonnes correspondantes des couples sont démontrées indépendantes.".into()
            }
            Minimality::AtLeast(rank) => {
                format!("Il en faut peut-être moins : {rank} d'entre eux sont démontrés indépendants.")
            }
            Minimality::Unknown => "On n'a pas décidé si moins suffiraient.".to_string(),
        };
        let have = if base < 2 { "agit" } else { "agissent" };
        say!("Des {of} des corps, regroupés, {base} {have} sur les couples. {rest}")
    }

    fn base_alone(&self, all: Vec<Math>) -> Line {
        Line::new(say!("tels quels : ")).list(all)
    }

    fn without_effect(&self, all: Vec<Math>) -> Line {
        Line::new(say!("sans effet sur les couples : ")).list(all)
    }

    fn torques_title(&self) -> String {
        "Couples".into()
    }

    fn torques_cost(&self, count: &Count, ground: Ground) -> String {
        let ground = match ground {
            Ground::Proved => "égalité avec les équations de Lagrange démontrée".into(),
            Ground::Modulo(states) => format!(
                "non démontré en général : exactement égal aux équations de Lagrange en {states} états aléatoires modulo un \
                 nombre premier de 61 bits"
            ),
            Ground::Numbers(states, off) => {
                format!("non démontré : égal aux équations de Lagrange à {off:.0e} près en {states} états")
            }
            Ground::Failed => "différent des équations de Lagrange : c'est un défaut du programme".into(),
        };
        say!("{} ; {ground}.", self.count(count))
    }

    fn with_friction(&self) -> String {
        "h comprend le frottement des articulations.".into()
    }

    fn divides_by(&self, all: Vec<Math>) -> Line {
        Line::new("Ce programme divise par ").list(all).text(", et vaut là où cela n'est pas nul.")
    }

    fn inertia_title(&self) -> String {
        "Matrice d'inertie".into()
    }

    fn velocity_torques_title(&self) -> String {
        "Couples centrifuges et de Coriolis".into()
    }

    fn gravity_torques_title(&self) -> String {
        "Couples de pesanteur".into()
    }
}
