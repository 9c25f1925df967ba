//! Exercise sheets.

use super::{German, counted};
use crate::tree::{Line, Math};
use crate::words::{Exercise, ExerciseKind, Terms};
use denavit::description::Convention;

/// What an exercise is about.
fn subject(kind: ExerciseKind) -> &'static str {
    match kind {
        ExerciseKind::Forward => "direkte Kinematik",
        ExerciseKind::Table => "Denavit-Hartenberg-Parameter",
        ExerciseKind::Inverse => "inverse Kinematik",
        ExerciseKind::Jacobian => "Jacobi-Matrix",
        ExerciseKind::Singularities => "Singularitäten",
        ExerciseKind::Transforms => "Transformationsmatrizen",
        ExerciseKind::Position => "inverse Kinematik der Position",
        ExerciseKind::Statics => "Statik",
        ExerciseKind::Torques => "Bewegungsgleichungen",
        ExerciseKind::Path => "Zeitverlauf einer Bewegung",
    }
}

impl Exercise for German {
    fn exercise_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Aufgabe zu {robot}: {}", subject(kind))
    }

    fn solution_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Lösung zu {robot}: {}", subject(kind))
    }

    fn seed(&self, seed: u64) -> String {
        format!("Blatt Nummer {seed}.")
    }

    fn tasks(&self) -> String {
        "Aufgaben".into()
    }

    fn points(&self, points: u32) -> String {
        format!("({})", counted(points as usize, "Punkt", "Punkte"))
    }

    fn configuration_title(&self, number: usize) -> String {
        format!("Stellung {number}")
    }

    fn given_pose_title(&self, number: usize) -> String {
        format!("Pose {number}")
    }

    fn solved_pose_title(&self, number: usize) -> String {
        format!("Inverse Kinematik zur Pose {number}")
    }

    fn pose_title(&self) -> String {
        "Die Pose des Werkzeugs".into()
    }

    fn numbers_title(&self) -> String {
        "Die Pose in Zahlen".into()
    }

    fn ask_links(&self) -> String {
        "Geben Sie die Transformationsmatrix jedes Glieds an, A1, A2, …".into()
    }

    fn ask_pose(&self) -> String {
        "Geben Sie die Pose des Werkzeugs in der Basis als Formel an, vereinfacht.".into()
    }

    fn ask_numbers(&self, count: usize) -> String {
        let where_ = if count == 1 { "in der Stellung unten" } else { "in jeder der Stellungen unten" };
        format!("Geben Sie die Pose T des Werkzeugs {where_} in Zahlen an, auf vier Nachkommastellen.")
    }

    fn ask_table(&self, convention: Convention) -> String {
        format!(
            "Geben Sie die Denavit-Hartenberg-Tabelle des Arms in der Konvention „{convention}“ an, die Längen mit ihren Namen."
        )
    }

    fn axes_title(&self) -> String {
        "Wie die Achsen liegen".into()
    }

    fn axes_lie(&self, configuration: Line) -> Line {
        let mut line = Line::new("Der Arm steht bei ");
        line.0.extend(configuration.0);
        line.text(". Seine Gelenkachsen sind dann, in der Basis:")
    }

    fn axes_caption(&self) -> String {
        "Ein Punkt jeder Achse und ihre Richtung; R dreht, P schiebt.".into()
    }

    fn point(&self) -> String {
        "durch".into()
    }

    fn direction(&self) -> String {
        "längs".into()
    }

    fn tool_there(&self) -> String {
        "und die Pose des Werkzeugs ist".into()
    }

    fn configurations_title(&self) -> String {
        "Die Gelenke zu einer Pose".into()
    }

    fn positions_title(&self) -> String {
        "Die Gelenke zu einer Position".into()
    }

    fn ask_configurations(&self, count: usize) -> String {
        let pose = if count == 1 { "zur Pose" } else { "zu jeder der Posen" };
        format!(
            "Geben Sie {pose} T des Werkzeugs unten alle Stellungen der Gelenke an: den Weg dorthin und die Zahlen."
        )
    }

    fn formulas_title(&self) -> String {
        "Formeln".into()
    }

    fn numbered_solution(&self, number: usize) -> String {
        format!("Lösung {number}: ")
    }

    fn jacobian_formula(&self) -> String {
        "Die Jacobi-Matrix".into()
    }

    fn ask_jacobian(&self) -> String {
        "Geben Sie die geometrische Jacobi-Matrix J als Formel an, für den Punkt und längs der Achsen wie unten, und in Zahlen auf vier \
         Nachkommastellen, längs der Achsen der Basis."
            .into()
    }

    fn rates_given(&self) -> String {
        "Die Gelenke bewegen sich mit ".into()
    }

    fn velocity_title(&self) -> String {
        "Die Geschwindigkeit des Werkzeugs".into()
    }

    fn ask_velocity(&self) -> String {
        "Geben Sie die Geschwindigkeit des Werkzeugursprungs in der ersten Stellung an, für die Gelenkgeschwindigkeiten unten.".into()
    }

    fn ask_determinant(&self) -> String {
        "Geben Sie die Determinante der Jacobi-Matrix an, in Faktoren zerlegt.".into()
    }

    fn ask_singular(&self) -> String {
        "Geben Sie an, wo der Arm singulär ist.".into()
    }

    fn singular_where(&self, condition: Math) -> Line {
        Line::new("Der Arm ist singulär für ").math(condition).text(".")
    }

    fn coefficients(&self) -> String {
        "Die Koeffizienten der Potenzen von t".into()
    }

    fn largest_of(&self, title: &str) -> String {
        format!(
            "{title}: die Anzahl N der Stellungen und diejenige mit dem größten ersten Gelenkwert (unter mehreren dem größten zweiten und \
             so weiter)"
        )
    }

    fn made_up_arm(&self, joints: &str, seed: u64) -> String {
        format!("{joints}-Arm {seed}")
    }

    fn ask_transforms(&self) -> String {
        "Geben Sie die Transformationsmatrix jedes Glieds an, A1, A2, …, als Formeln und in der Stellung unten in Zahlen, auf vier \
         Nachkommastellen."
            .into()
    }

    fn ask_positions(&self, count: usize) -> String {
        let position = if count == 1 { "zur Position" } else { "zu jeder der Positionen" };
        format!(
            "Geben Sie {position} des Werkzeugs unten alle Stellungen der Gelenke an: den Weg dorthin und die Zahlen."
        )
    }

    fn given_position_title(&self, number: usize) -> String {
        format!("Position {number}")
    }

    fn solved_position_title(&self, number: usize) -> String {
        format!("Inverse Kinematik zur Position {number}")
    }

    fn position_given(&self) -> String {
        "Das Werkzeug soll diesen Punkt erreichen: ".into()
    }

    fn torque_formulas_title(&self) -> String {
        "Die Gelenkmomente".into()
    }

    fn torque_numbers_title(&self) -> String {
        "Die Gelenkmomente in Zahlen".into()
    }

    fn ask_statics(&self, force: Vec<Math>) -> Line {
        Line::new("Das Werkzeug drückt auf seine Umgebung mit einer Kraft, die längs der Achsen der Basis die Komponenten ")
            .list(force)
            .text(" hat. Geben Sie die Gelenkmomente (bei Schubgelenken die Kräfte) an, die dafür in Ruhe nötig sind, als Formeln; das Gewicht des Arms wird vernachlässigt.")
    }

    fn ask_torque_numbers(&self, count: usize) -> String {
        let where_ = if count == 1 { "in der Stellung unten" } else { "in jeder der Stellungen unten" };
        format!("Geben Sie sie {where_} in Zahlen an, auf vier Nachkommastellen.")
    }

    fn force_given(&self) -> String {
        "Die Kraft ist ".into()
    }

    fn statics_step(&self) -> String {
        "Die Zeilen der Geschwindigkeit in der Jacobi-Matrix des Werkzeugs, längs der Achsen der Basis; ihre Spalten, mit der Kraft multipliziert, sind die Momente.".into()
    }

    fn point_masses(&self) -> String {
        "Die Masse jedes Glieds ist ein Punkt an seinem Ende, dem Ursprung seines Koordinatensystems; Reibung gibt es nicht.".into()
    }

    fn gravity_in_base(&self, components: [Math; 3]) -> Line {
        Line::new("Die Fallbeschleunigung in der Basis ist (").numbers(components, self.between()).text(").")
    }

    fn motion_parts_title(&self) -> String {
        "Die Teile der Bewegungsgleichungen".into()
    }

    fn ask_motion_parts(&self) -> String {
        "Geben Sie die Massenmatrix M, die Zentrifugal- und Coriolismomente V und die Momente G der Schwerkraft an.".into()
    }

    fn ask_motion(&self) -> String {
        "Geben Sie das Moment jedes Gelenks als Formel in Winkeln, Geschwindigkeiten und Beschleunigungen der Gelenke an.".into()
    }

    fn inertia_step(&self) -> String {
        "Die Massenmatrix, aus der kinetischen Energie:".into()
    }

    fn velocity_torques_step(&self) -> String {
        "Die Zentrifugal- und Coriolismomente, aus ihren Ableitungen:".into()
    }

    fn gravity_step(&self) -> String {
        "Die Momente der Schwerkraft, aus der potentiellen Energie:".into()
    }

    fn motion_step(&self) -> String {
        "Die Zeilen von M mal die Beschleunigungen, dazu V und G, ergeben die Momente.".into()
    }

    fn accelerations_given(&self) -> String {
        "Ihre Beschleunigungen sind ".into()
    }

    fn motion_title(&self) -> String {
        "Die Bewegung".into()
    }

    fn motion_begins(&self, configuration: Line) -> Line {
        let mut line = Line::new("Sie beginnt in Ruhe bei ");
        line.0.extend(configuration.0);
        line.text(".")
    }

    fn motion_ends(&self, configuration: Line) -> Line {
        let mut line = Line::new("Sie endet in Ruhe bei ");
        line.0.extend(configuration.0);
        line.text(".")
    }

    fn cubic_title(&self) -> String {
        "Kubische Polynome".into()
    }

    fn ask_cubic(&self, seconds: Math) -> Line {
        Line::new("Geben Sie jede Gelenkvariable als Polynom dritten Grades in der Zeit t an (in Sekunden; Winkel in Grad, Verschiebungen in Metern), für eine Bewegung der Dauer ")
            .math(seconds)
            .text(".")
    }

    fn cubic_step(&self, formula: Math) -> Line {
        Line::new("An beiden Enden in Ruhe, folgt ein Gelenk, das sich in der Zeit f um D bewegt, ")
            .math(formula)
            .text(".")
    }

    fn peaks_title(&self) -> String {
        "Die größten Geschwindigkeiten".into()
    }

    fn ask_peaks(&self, names: Vec<Math>) -> Line {
        Line::new("Geben Sie die größte Geschwindigkeit jedes Gelenks unterwegs an: ").list(names).text(".")
    }

    fn peaks_step(&self, formula: Math) -> Line {
        Line::new("Am schnellsten ist ein Gelenk auf halbem Weg, mit ").math(formula).text(".")
    }

    fn trapezoid_title(&self) -> String {
        "Die kürzesten Zeiten".into()
    }

    fn ask_trapezoid(&self, names: Vec<Math>, whole: Math) -> Line {
        Line::new("Nun haben die Geschwindigkeiten Trapezprofile innerhalb der Grenzen unten. Geben Sie die kürzeste Zeit jedes Gelenks für sich an, ")
            .list(names)
            .text(", und die aller Gelenke zusammen, ")
            .math(whole)
            .text(", in Sekunden auf vier Nachkommastellen.")
    }

    fn joint_limits(&self, joint: Math, speed: &str, acceleration: &str) -> Line {
        Line::new("Gelenk ").math(joint).text(format!(
            " hat höchstens die Geschwindigkeit {speed} und die Beschleunigung {acceleration}."
        ))
    }

    fn trapezoid_step(&self, joint: Math, formula: Math) -> Line {
        Line::new("Gelenk ")
            .math(joint)
            .text(" erreicht seine größte Geschwindigkeit v: Es braucht ")
            .math(formula)
            .text(".")
    }

    fn triangle_step(&self, joint: Math, formula: Math) -> Line {
        Line::new("Gelenk ")
            .math(joint)
            .text(" erreicht seine größte Geschwindigkeit nicht: Es braucht ")
            .math(formula)
            .text(".")
    }

    fn slowest_step(&self, whole: Math) -> Line {
        Line::new("Das langsamste Gelenk bestimmt die Zeit aller: ").math(whole)
    }
}
