//! Exercise sheets.

use super::{Spanish, counted};
use crate::tree::{Line, Math};
use crate::words::{Exercise, ExerciseKind, Terms};
use denavit::description::Convention;

/// What an exercise is about.
fn subject(kind: ExerciseKind) -> &'static str {
    match kind {
        ExerciseKind::Forward => "cinemática directa",
        ExerciseKind::Table => "parámetros de Denavit-Hartenberg",
        ExerciseKind::Inverse => "cinemática inversa",
        ExerciseKind::Jacobian => "jacobiano",
        ExerciseKind::Singularities => "singularidades",
        ExerciseKind::Transforms => "matrices de transformación",
        ExerciseKind::Position => "cinemática inversa de la posición",
        ExerciseKind::Statics => "estática",
        ExerciseKind::Torques => "ecuaciones del movimiento",
        ExerciseKind::Path => "perfil temporal de un movimiento",
    }
}

impl Exercise for Spanish {
    fn exercise_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Ejercicio sobre {robot}: {}", subject(kind))
    }

    fn solution_title(&self, kind: ExerciseKind, robot: &str) -> String {
        format!("Solución del ejercicio sobre {robot}: {}", subject(kind))
    }

    fn seed(&self, seed: u64) -> String {
        format!("Hoja número {seed}.")
    }

    fn tasks(&self) -> String {
        "Preguntas".into()
    }

    fn points(&self, points: u32) -> String {
        format!("({})", counted(points as usize, "punto", "puntos"))
    }

    fn configuration_title(&self, number: usize) -> String {
        format!("Configuración {number}")
    }

    fn given_pose_title(&self, number: usize) -> String {
        format!("Pose {number}")
    }

    fn solved_pose_title(&self, number: usize) -> String {
        format!("Cinemática inversa para la pose {number}")
    }

    fn pose_title(&self) -> String {
        "La pose de la herramienta".into()
    }

    fn numbers_title(&self) -> String {
        "La pose en números".into()
    }

    fn ask_links(&self) -> String {
        "Dé la matriz de transformación de cada eslabón, A1, A2, …".into()
    }

    fn ask_pose(&self) -> String {
        "Dé la pose de la herramienta en la base como fórmula simplificada.".into()
    }

    fn ask_numbers(&self, count: usize) -> String {
        let where_ = if count == 1 {
            "en la configuración indicada"
        } else {
            "en cada una de las configuraciones indicadas"
        };
        format!("Dé la pose T de la herramienta en números {where_} abajo, con cuatro decimales.")
    }

    fn ask_table(&self, convention: Convention) -> String {
        format!(
            "Dé la tabla de Denavit-Hartenberg del brazo en la convención «{convention}», con las longitudes por sus nombres."
        )
    }

    fn axes_title(&self) -> String {
        "Disposición de los ejes".into()
    }

    fn axes_lie(&self, configuration: Line) -> Line {
        let mut line = Line::new("El brazo se coloca en ");
        line.0.extend(configuration.0);
        line.text(". Los ejes de sus articulaciones son entonces, en la base:")
    }

    fn axes_caption(&self) -> String {
        "Un punto de cada eje y su dirección; R gira, P se desliza.".into()
    }

    fn point(&self) -> String {
        "pasa por".into()
    }

    fn direction(&self) -> String {
        "dirección".into()
    }

    fn tool_there(&self) -> String {
        "y la pose de la herramienta es".into()
    }

    fn configurations_title(&self) -> String {
        "Las articulaciones para una pose".into()
    }

    fn positions_title(&self) -> String {
        "Las articulaciones para una posición".into()
    }

    fn ask_configurations(&self, count: usize) -> String {
        let pose = if count == 1 { "la pose" } else { "cada una de las poses" };
        format!(
            "Dé todas las configuraciones de las articulaciones para {pose} T de la herramienta que sigue: cómo se hallan, y en números."
        )
    }

    fn formulas_title(&self) -> String {
        "Fórmulas".into()
    }

    fn numbered_solution(&self, number: usize) -> String {
        format!("Solución {number}: ")
    }

    fn jacobian_formula(&self) -> String {
        "El jacobiano".into()
    }

    fn ask_jacobian(&self) -> String {
        "Dé el jacobiano geométrico J como fórmula, en el punto y según los ejes indicados abajo, y en números con cuatro decimales, según los \
         ejes de la base."
            .into()
    }

    fn rates_given(&self) -> String {
        "Las articulaciones se mueven con ".into()
    }

    fn velocity_title(&self) -> String {
        "La velocidad de la herramienta".into()
    }

    fn ask_velocity(&self) -> String {
        "Dé la velocidad del origen de la herramienta en la primera configuración, para las velocidades articulares indicadas abajo.".into()
    }

    fn ask_determinant(&self) -> String {
        "Dé el determinante del jacobiano, factorizado.".into()
    }

    fn ask_singular(&self) -> String {
        "Diga dónde es singular el brazo.".into()
    }

    fn singular_where(&self, condition: Math) -> Line {
        Line::new("El brazo es singular para ").math(condition).text(".")
    }

    fn coefficients(&self) -> String {
        "Los coeficientes de las potencias de t".into()
    }

    fn largest_of(&self, title: &str) -> String {
        format!(
            "{title}: el número N de configuraciones, y aquella con la mayor primera articulación (de varias, la mayor segunda, y así \
             sucesivamente)"
        )
    }

    fn made_up_arm(&self, joints: &str, seed: u64) -> String {
        format!("brazo {joints} {seed}")
    }

    fn ask_transforms(&self) -> String {
        "Dé la matriz de transformación de cada eslabón, A1, A2, …, como fórmulas y, en la configuración indicada abajo, en números con cuatro \
         decimales."
            .into()
    }

    fn ask_positions(&self, count: usize) -> String {
        let position = if count == 1 { "la posición" } else { "cada una de las posiciones" };
        format!(
            "Dé todas las configuraciones de las articulaciones para {position} de la herramienta que sigue: cómo se hallan, y en números."
        )
    }

    fn given_position_title(&self, number: usize) -> String {
        format!("Posición {number}")
    }

    fn solved_position_title(&self, number: usize) -> String {
        format!("Cinemática inversa para la posición {number}")
    }

    fn position_given(&self) -> String {
        "La herramienta debe alcanzar el punto ".into()
    }

    fn torque_formulas_title(&self) -> String {
        "Los pares articulares".into()
    }

    fn torque_numbers_title(&self) -> String {
        "Los pares articulares en números".into()
    }

    fn ask_statics(&self, force: Vec<Math>) -> Line {
        Line::new("La herramienta ejerce sobre su entorno una fuerza de componentes ")
            .list(force)
            .text(" según los ejes de la base. Dé los pares articulares (fuerzas en las prismáticas) necesarios en reposo, como fórmulas; se desprecia el peso del brazo.")
    }

    fn ask_torque_numbers(&self, count: usize) -> String {
        let where_ = if count == 1 {
            "en la configuración indicada"
        } else {
            "en cada una de las configuraciones indicadas"
        };
        format!("Delos en números {where_} abajo, con cuatro decimales.")
    }

    fn force_given(&self) -> String {
        "La fuerza es ".into()
    }

    fn statics_step(&self) -> String {
        "Las filas de la velocidad lineal del jacobiano de la herramienta, según los ejes de la base; sus columnas, multiplicadas por la fuerza, son los pares.".into()
    }

    fn point_masses(&self) -> String {
        "Cada eslabón tiene su masa como un punto en su extremo, el origen de su sistema; no hay rozamiento."
            .into()
    }

    fn gravity_in_base(&self, components: [Math; 3]) -> Line {
        Line::new("La aceleración de la gravedad en la base es (")
            .numbers(components, self.between())
            .text(").")
    }

    fn motion_parts_title(&self) -> String {
        "Los términos de las ecuaciones del movimiento".into()
    }

    fn ask_motion_parts(&self) -> String {
        "Dé la matriz de inercia M, los pares V de las fuerzas centrífugas y de Coriolis y los pares G de la gravedad.".into()
    }

    fn ask_motion(&self) -> String {
        "Dé el par de cada articulación como fórmula de los ángulos, las velocidades y las aceleraciones articulares.".into()
    }

    fn inertia_step(&self) -> String {
        "La matriz de inercia, a partir de la energía cinética:".into()
    }

    fn velocity_torques_step(&self) -> String {
        "Los pares de las fuerzas centrífugas y de Coriolis, a partir de sus derivadas:".into()
    }

    fn gravity_step(&self) -> String {
        "Los pares de la gravedad, a partir de la energía potencial:".into()
    }

    fn motion_step(&self) -> String {
        "Las filas de M por las aceleraciones, más V y G, dan los pares.".into()
    }

    fn accelerations_given(&self) -> String {
        "Sus aceleraciones son ".into()
    }

    fn motion_title(&self) -> String {
        "El movimiento".into()
    }

    fn motion_begins(&self, configuration: Line) -> Line {
        let mut line = Line::new("Empieza en reposo en ");
        line.0.extend(configuration.0);
        line.text(".")
    }

    fn motion_ends(&self, configuration: Line) -> Line {
        let mut line = Line::new("Termina en reposo en ");
        line.0.extend(configuration.0);
        line.text(".")
    }

    fn cubic_title(&self) -> String {
        "Polinomios cúbicos".into()
    }

    fn ask_cubic(&self, seconds: Math) -> Line {
        Line::new("Dé cada variable articular como polinomio de tercer grado en el tiempo t (en segundos; ángulos en grados, desplazamientos en metros) para un movimiento que dura ")
            .math(seconds)
            .text(".")
    }

    fn cubic_step(&self, formula: Math) -> Line {
        Line::new("En reposo en ambos extremos, una articulación que avanza D en el tiempo f sigue ")
            .math(formula)
            .text(".")
    }

    fn peaks_title(&self) -> String {
        "Las velocidades máximas".into()
    }

    fn ask_peaks(&self, names: Vec<Math>) -> Line {
        Line::new("Dé la velocidad máxima de cada articulación en el recorrido: ").list(names).text(".")
    }

    fn peaks_step(&self, formula: Math) -> Line {
        Line::new("Una articulación es más rápida a mitad de recorrido, con ").math(formula).text(".")
    }

    fn trapezoid_title(&self) -> String {
        "Los tiempos mínimos".into()
    }

    fn ask_trapezoid(&self, names: Vec<Math>, whole: Math) -> Line {
        Line::new("Ahora las velocidades tienen perfiles trapezoidales dentro de los límites indicados abajo. Dé el tiempo mínimo de cada articulación por separado, ")
            .list(names)
            .text(", y el de todas juntas, ")
            .math(whole)
            .text(", en segundos con cuatro decimales.")
    }

    fn joint_limits(&self, joint: Math, speed: &str, acceleration: &str) -> Line {
        Line::new("La articulación ")
            .math(joint)
            .text(format!(" tiene como máximo la velocidad {speed} y la aceleración {acceleration}."))
    }

    fn trapezoid_step(&self, joint: Math, formula: Math) -> Line {
        Line::new("La articulación ")
            .math(joint)
            .text(" alcanza su velocidad máxima v: tarda ")
            .math(formula)
            .text(".")
    }

    fn triangle_step(&self, joint: Math, formula: Math) -> Line {
        Line::new("La articulación ")
            .math(joint)
            .text(" no alcanza su velocidad máxima: tarda ")
            .math(formula)
            .text(".")
    }

    fn slowest_step(&self, whole: Math) -> Line {
        Line::new("La articulación más lenta fija el tiempo de todas: ").math(whole)
    }
}
