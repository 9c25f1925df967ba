//! Feuilles d'exercices.

use super::French;
use crate::tree::{Line, Math};
use crate::words::{Exercise, ExerciseKind, Terms};
use denavit::description::Convention;

/// Le sujet d'un exercice, avec la préposition qui suit.
fn subject(kind: ExerciseKind) -> &'static str {
    match kind {
        ExerciseKind::Forward => "modèle géométrique direct",
        ExerciseKind::Table => "table de Denavit–Hartenberg",
        ExerciseKind::Inverse => "modèle géométrique inverse",
        ExerciseKind::Jacobian => "jacobienne",
        ExerciseKind::Singularities => "singularités",
        ExerciseKind::Transforms => "transformations des corps",
        ExerciseKind::Position => "modèle inverse en position",
        ExerciseKind::Statics => "statique",
        ExerciseKind::Torques => "équations du mouvement",
        ExerciseKind::Path => "loi de mouvement",
    }
}

impl Exercise for French {
    fn exercise_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Exercice\u{a0}: {} du robot {robot}", subject(kind))
    }

    fn solution_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Corrigé\u{a0}: {} du robot {robot}", subject(kind))
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
        "La situation de l’outil".into()
    }

    fn numbers_title(&self) -> String {
        "La situation en nombres".into()
    }

    fn ask_links(&self) -> String {
        "Donner la matrice de transformation de chaque corps, A1, A2, …".into()
    }

    fn ask_pose(&self) -> String {
        "Donner la situation de l’outil dans la base sous forme de formule simplifiée.".into()
    }

    fn ask_numbers(&self, count: usize) -> String {
        let where_ = if count == 1 { "dans la configuration" } else { "dans chacune des configurations" };
        format!("Donner la situation T de l’outil en nombres {where_} ci-dessous, à quatre décimales.")
    }

    fn ask_table(&self, convention: Convention) -> String {
        format!(
            "Donner la table de Denavit–Hartenberg du bras dans la convention «\u{a0}{convention}\u{a0}», les longueurs par leurs noms."
        )
    }

    fn axes_title(&self) -> String {
        "Disposition des axes".into()
    }

    fn axes_lie(&self, configuration: Line) -> Line {
        let mut line = Line::new("Le bras est mis à ");
        line.0.extend(configuration.0);
        line.text(". Les axes de ses articulations sont alors, dans la base\u{a0}:")
    }

    fn axes_caption(&self) -> String {
        "Un point de chaque axe et sa direction\u{a0}; R pour une rotation, P pour une translation.".into()
    }

    fn point(&self) -> String {
        "passe par".into()
    }

    fn direction(&self) -> String {
        "direction".into()
    }

    fn tool_there(&self) -> String {
        "et la situation de l’outil est".into()
    }

    fn configurations_title(&self) -> String {
        "Les articulations pour une situation".into()
    }

    fn positions_title(&self) -> String {
        "Les articulations pour une position".into()
    }

    fn ask_configurations(&self, count: usize) -> String {
        let pose = if count == 1 { "la situation" } else { "chacune des situations" };
        format!(
            "Donner toutes les configurations des articulations pour {pose} T de l’outil ci-dessous\u{a0}: les équations, et les \
             valeurs."
        )
    }

    fn formulas_title(&self) -> String {
        "Formules".into()
    }

    fn numbered_solution(&self, number: usize) -> String {
        format!("Solution {number}\u{a0}: ")
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
        "La vitesse de l’outil".into()
    }

    fn ask_velocity(&self) -> String {
        "Donner la vitesse de l’origine de l’outil dans la première configuration, pour les vitesses des articulations \
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

    fn coefficients(&self) -> String {
        "Les coefficients des puissances de t".into()
    }

    fn largest_of(&self, title: &str) -> String {
        format!(
            "{title}\u{a0}: le nombre N de configurations, et celle dont la première articulation est la plus grande (à égalité la deuxième, et ainsi de suite)"
        )
    }

    fn made_up_arm(&self, joints: &str, seed: u64) -> String {
        format!("{joints} {seed}")
    }

    fn ask_transforms(&self) -> String {
        "Donner la matrice de transformation de chaque corps, A1, A2, …, sous forme de formules, puis en nombres dans la configuration ci-dessous, à quatre décimales.".into()
    }

    fn ask_positions(&self, count: usize) -> String {
        let position = if count == 1 { "la position" } else { "chacune des positions" };
        format!(
            "Donner toutes les configurations des articulations pour {position} de l’outil ci-dessous\u{a0}: les équations, et les valeurs."
        )
    }

    fn given_position_title(&self, number: usize) -> String {
        format!("Position {number}")
    }

    fn solved_position_title(&self, number: usize) -> String {
        format!("Modèle géométrique inverse de la position {number}")
    }

    fn position_given(&self) -> String {
        "L’outil doit atteindre le point ".into()
    }

    fn torque_formulas_title(&self) -> String {
        "Les couples articulaires".into()
    }

    fn torque_numbers_title(&self) -> String {
        "Les couples articulaires en nombres".into()
    }

    fn ask_statics(&self, force: Vec<Math>) -> Line {
        Line::new("L’outil exerce sur son environnement une force de composantes ")
            .list(force)
            .text(" suivant les axes de la base. Donner les couples articulaires (les forces des translations) nécessaires à l’équilibre, sous forme de formules\u{a0}; le poids du bras est négligé.")
    }

    fn ask_torque_numbers(&self, count: usize) -> String {
        let where_ = if count == 1 { "dans la configuration" } else { "dans chacune des configurations" };
        format!("Les donner en nombres {where_} ci-dessous, à quatre décimales.")
    }

    fn force_given(&self) -> String {
        "La force est ".into()
    }

    fn statics_step(&self) -> String {
        "Les lignes linéaires de la jacobienne de l’outil, suivant les axes de la base\u{a0}; leurs colonnes, multipliées par la force, donnent les couples.".into()
    }

    fn point_masses(&self) -> String {
        "Chaque corps a sa masse concentrée à son extrémité, l’origine de son repère\u{a0}; il n’y a pas de frottement.".into()
    }

    fn gravity_in_base(&self, components: [Math; 3]) -> Line {
        Line::new("L’accélération de la pesanteur dans la base est (")
            .numbers(components, self.between())
            .text(").")
    }

    fn motion_parts_title(&self) -> String {
        "Les termes des équations du mouvement".into()
    }

    fn ask_motion_parts(&self) -> String {
        "Donner la matrice d’inertie M, les couples V des forces centrifuges et de Coriolis et les couples G de la pesanteur.".into()
    }

    fn ask_motion(&self) -> String {
        "Donner le couple de chaque articulation en fonction des positions, vitesses et accélérations articulaires.".into()
    }

    fn inertia_step(&self) -> String {
        "La matrice d’inertie, par l’énergie cinétique\u{a0}:".into()
    }

    fn velocity_torques_step(&self) -> String {
        "Les couples des forces centrifuges et de Coriolis, par ses dérivées\u{a0}:".into()
    }

    fn gravity_step(&self) -> String {
        "Les couples de la pesanteur, par l’énergie potentielle\u{a0}:".into()
    }

    fn motion_step(&self) -> String {
        "Les lignes de M fois les accélérations, plus V et G, donnent les couples.".into()
    }

    fn accelerations_given(&self) -> String {
        "Leurs accélérations sont ".into()
    }

    fn motion_title(&self) -> String {
        "Le mouvement".into()
    }

    fn motion_begins(&self, configuration: Line) -> Line {
        let mut line = Line::new("Il commence à l’arrêt à ");
        line.0.extend(configuration.0);
        line.text(".")
    }

    fn motion_ends(&self, configuration: Line) -> Line {
        let mut line = Line::new("Il finit à l’arrêt à ");
        line.0.extend(configuration.0);
        line.text(".")
    }

    fn cubic_title(&self) -> String {
        "Polynômes de degré trois".into()
    }

    fn ask_cubic(&self, seconds: Math) -> Line {
        Line::new("Donner chaque variable articulaire comme polynôme de degré trois du temps t (en secondes\u{a0}; angles en degrés, translations en mètres) pour un mouvement qui dure ")
            .math(seconds)
            .text(".")
    }

    fn cubic_step(&self, formula: Math) -> Line {
        Line::new("À l’arrêt aux deux bouts, une articulation qui avance de D dans le temps f suit ")
            .math(formula)
            .text(".")
    }

    fn peaks_title(&self) -> String {
        "Les vitesses maximales".into()
    }

    fn ask_peaks(&self, names: Vec<Math>) -> Line {
        Line::new("Donner la plus grande vitesse de chaque articulation en chemin\u{a0}: ")
            .list(names)
            .text(".")
    }

    fn peaks_step(&self, formula: Math) -> Line {
        Line::new("Une articulation est la plus rapide à mi-chemin, avec ").math(formula).text(".")
    }

    fn trapezoid_title(&self) -> String {
        "Les temps minimaux".into()
    }

    fn ask_trapezoid(&self, names: Vec<Math>, whole: Math) -> Line {
        Line::new("Les vitesses ont maintenant des profils trapézoïdaux dans les limites ci-dessous. Donner le temps minimal de chaque articulation seule, ")
            .list(names)
            .text(", et celui de toutes ensemble, ")
            .math(whole)
            .text(", en secondes à quatre décimales.")
    }

    fn joint_limits(&self, joint: Math, speed: &str, acceleration: &str) -> Line {
        Line::new("L’articulation ")
            .math(joint)
            .text(format!(" a au plus la vitesse {speed} et l’accélération {acceleration}."))
    }

    fn trapezoid_step(&self, joint: Math, formula: Math) -> Line {
        Line::new("L’articulation ")
            .math(joint)
            .text(" atteint sa vitesse maximale v\u{a0}: il lui faut ")
            .math(formula)
            .text(".")
    }

    fn triangle_step(&self, joint: Math, formula: Math) -> Line {
        Line::new("L’articulation ")
            .math(joint)
            .text(" n’atteint pas sa vitesse maximale\u{a0}: il lui faut ")
            .math(formula)
            .text(".")
    }

    fn slowest_step(&self, whole: Math) -> Line {
        Line::new("L’articulation la plus lente donne le temps de toutes\u{a0}: ").math(whole)
    }
}
