//! Feuilles d'exercices.

use super::French;
use crate::tree::{Line, Math};
use crate::words::{Exercise, ExerciseKind};
use denavit::description::Convention;

/// Le sujet d'un exercice, avec la préposition qui suit.
fn subject(kind: ExerciseKind) -> &'static str {
    match kind {
        ExerciseKind::Forward => "modèle géométrique direct",
        ExerciseKind::Table => "table de Denavit–Hartenberg",
        ExerciseKind::Inverse => "modèle géométrique inverse",
        ExerciseKind::Jacobian => "jacobienne",
        ExerciseKind::Singularities => "singularités",
    }
}

impl Exercise for French {
    fn exercise_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Exercice : {} du robot {robot}", subject(kind))
    }

    fn solution_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Corrigé : {} du robot {robot}", subject(kind))
    }

    fn seed(&self, seed: u64) -> String {
        format!("Feuille numéro {seed}.")
    }

    fn tasks(&self) -> String {
        "Questions".into()
    }

    fn points(&self, points: u32) -> String {
        format!("({points} {})", if points > 1 { "points" } else { "point" })
    }

    fn configuration_title(&self, number: usize) -> String {
        format!("Configuration {number}")
    }

    fn given_pose_title(&self, number: usize) -> String {
        format!("Situation {number}")
    }

    fn solved_pose_title(&self, number: usize) -> String {
        format!("Modèle géométrique inverse de la situation {number}")
    }

    fn pose_title(&self) -> String {
        "La situation de l'outil".into()
    }

    fn numbers_title(&self) -> String {
        "La situation en nombres".into()
    }

    fn ask_links(&self) -> String {
        "Donner la matrice de transformation de chaque corps, A1, A2, …".into()
    }

    fn ask_pose(&self) -> String {
        "Donner la situation de l'outil dans la base sous forme de formule simplifiée.".into()
    }

    fn ask_numbers(&self, count: usize) -> String {
        let where_ = if count == 1 { "dans la configuration" } else { "dans chacune des configurations" };
        format!("Donner la situation T de l'outil en nombres {where_} ci-dessous, à quatre décimales.")
    }

    fn ask_table(&self, convention: Convention) -> String {
        format!(
            "Donner la table de Denavit–Hartenberg du bras dans la convention « {convention} », les longueurs par leurs noms."
        )
    }

    fn axes_title(&self) -> String {
        "Disposition des axes".into()
    }

    fn axes_lie(&self, configuration: Line) -> Line {
        let mut line = Line::new("Le bras est mis à ");
        line.0.extend(configuration.0);
        line.text(". Les axes de ses articulations sont alors, dans la base :")
    }

    fn axes_caption(&self) -> String {
        "Un point de chaque axe et sa direction ; R pour une rotation, P pour une translation.".into()
    }

    fn point(&self) -> String {
        "passe par".into()
    }

    fn direction(&self) -> String {
        "direction".into()
    }

    fn tool_there(&self) -> String {
        "et la situation de l'outil est".into()
    }

    fn configurations_title(&self) -> String {
        "Les articulations pour une situation".into()
    }

    fn ask_configurations(&self, count: usize) -> String {
        let pose = if count == 1 { "la situation" } else { "chacune des situations" };
        format!(
            "Donner toutes les configurations des articulations pour {pose} T de l'outil ci-dessous : les équations, et les \
             valeurs."
        )
    }

    fn formulas_title(&self) -> String {
        "Formules".into()
    }

    fn numbered_solution(&self, number: usize) -> String {
        format!("Solution {number} : ")
    }

    fn jacobian_formula(&self) -> String {
        "La jacobienne".into()
    }

    fn ask_jacobian(&self) -> String {
        "Donner la jacobienne géométrique J sous forme de formule, au point et suivant les axes ci-dessous, puis en nombres à quatre décimales, suivant les axes de la base.".into()
    }

    fn rates_given(&self) -> String {
        "Les vitesses des articulations sont ".into()
    }

    fn velocity_title(&self) -> String {
        "La vitesse de l'outil".into()
    }

    fn ask_velocity(&self) -> String {
        "Donner la vitesse de l'origine de l'outil dans la première configuration, pour les vitesses des articulations \
         ci-dessous."
            .into()
    }

    fn ask_determinant(&self) -> String {
        "Donner le déterminant de la jacobienne, factorisé.".into()
    }

    fn ask_singular(&self) -> String {
        "Dire où le bras est singulier.".into()
    }

    fn singular_where(&self, condition: Math) -> Line {
        Line::new("Le bras est singulier où ").math(condition).text(".")
    }
}
