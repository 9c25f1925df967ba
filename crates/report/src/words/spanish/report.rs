//! The sections of a report.

use super::{Spanish, counted};
use crate::tree::{Line, Math};
use crate::words::report::{Caption, Column, Factors, Glance, Heading, List, Names, Report, Standings};
use crate::words::{Inverse, Terms};
use denavit::description::{Convention, JointKind};
use denavit::forward::Proof;
use denavit::inverse::Refusal;
use denavit::structure::{Relation, Structure};
use denavit::workspace::Section as Plane;
use denavit_program::Count;
use denavit_symbolic::Refusal as Unexpanded;

impl Report for Spanish {
    fn title(&self, robot: &str) -> String {
        format!("Cinemática: {robot}")
    }

    fn of_the_position(&self, said: &str) -> String {
        format!("Solo la posición: {said}")
    }

    fn compared(&self, robots: &[&str]) -> String {
        format!("Comparación: {}", self.listed(&robots.iter().map(ToString::to_string).collect::<Vec<_>>()))
    }

    fn beside_each_other(&self, have_one_scale: bool) -> [&'static str; 2] {
        let pictures = match have_one_scale {
            true => "Los robots a la misma escala.",
            false => "Los robots, cada uno tan grande como permite su imagen.",
        };
        ["Los robots de un vistazo.", pictures]
    }

    fn heading(&self, heading: Heading) -> String {
        match heading {
            Heading::Arm => "El brazo",
            Heading::Arms => "Los brazos",
            Heading::Table => "Parámetros de Denavit-Hartenberg",
            Heading::Links => "Matrices de transformación",
            Heading::Algorithm => "Algoritmo",
            Heading::Example => "Un ejemplo numérico",
            Heading::Inverse => "Cinemática inversa",
            Heading::Solutions => "Las soluciones del ejemplo",
            Heading::Velocity => "Jacobiano y singularidades",
            Heading::Dynamics => "Dinámica",
            Heading::Workspace => "Espacio de trabajo",
            Heading::Errata => "Erratas",
            Heading::References => "Referencias",
        }
        .into()
    }

    fn glance(&self, glance: Glance) -> String {
        match glance {
            Glance::Structure => "Estructura",
            Glance::Convention => "Convención",
            Glance::Source => "Fuente",
            Glance::Forward => "Cinemática directa",
            Glance::Inverse => "Cinemática inversa",
            Glance::Singularities => "Singularidades",
        }
        .into()
    }

    fn column(&self, column: Column) -> String {
        match column {
            Column::Joint => "articulación",
            Column::Torque => "par de sujeción",
            Column::Inertia => "inercia",
            Column::Name => "nombre",
            Column::Limits => "límites",
            Column::Branch => "rama",
            Column::Step => "paso",
            Column::Value => "valor",
        }
        .into()
    }

    fn caption(&self, caption: Caption) -> String {
        match caption {
            Caption::AtRest => {
                "Lo que sostiene el brazo en reposo contra la gravedad, y la inercia que siente cada articulación por sí sola, con"
            }
            Caption::Steps => "Los pasos del algoritmo en números; longitudes en metros.",
            Caption::Configurations => "Todas las configuraciones con esta pose.",
            Caption::Picture => "La configuración de la tabla.",
            Caption::Pictures => "Las configuraciones de la tabla, todas con la misma pose de la herramienta.",
            Caption::Singular => {
                "Una configuración en cada singularidad; los ejes que la causan están destacados."
            }
            Caption::Scheme => "Esquema cinemático: ejes de las articulaciones, variables y longitudes.",
        }
        .into()
    }

    fn table(&self) -> &'static str {
        "Tabla"
    }

    fn figure(&self) -> &'static str {
        "Figura"
    }

    fn contents(&self) -> &'static str {
        "Índice"
    }

    fn turning(&self) -> [&'static str; 2] {
        ["Paso anterior", "Paso siguiente"]
    }

    fn formula(&self) -> &'static str {
        "fórmula"
    }

    fn picture(&self, own: &str, whole: &str) -> String {
        format!("{own}: {whole}")
    }

    fn arm_picture(&self, is_scheme: bool, robot: &str, joints: &str) -> String {
        let what = if is_scheme { "Esquema cinemático" } else { "Vista" };
        format!("{what}: {robot}, articulaciones {joints} de la base al efector final")
    }

    fn workspace_picture(&self, plane: &Plane, [[a, b], [c, d]]: [[String; 2]; 2]) -> String {
        let [u, v] = plane.symbols();
        let what = match plane {
            Plane::ThroughAxis { joint, .. } => format!(
                "semiplano que pasa por el eje {} (distancia {u} al eje, altura {v} a lo largo de él)",
                joint + 1
            ),
            Plane::Plane { .. } => format!("plano {u}-{v}, en el que se mueve el brazo"),
            Plane::Projection { .. } => format!("proyección sobre el plano {u}-{v}"),
        };
        let [a, b, c, d] = [a, b, c, d].map(|x| self.written(x));
        format!(
            "Sección del espacio de trabajo, {what}: {u} de {a} a {b} m, {v} de {c} a {d} m; colores según la manipulabilidad, cuyo \
             máximo es 1"
        )
    }

    fn curves_picture(&self, title: &str, names: &[String]) -> String {
        format!("{title}: {} en función del eje horizontal", names.join(", "))
    }

    fn assumed_lengths(&self) -> String {
        "Algunas longitudes no tienen valor. Las figuras y los números suponen ".into()
    }

    fn structure(&self, structure: &Structure) -> String {
        let kind = |k: &JointKind| if *k == JointKind::Revolute { 'R' } else { 'P' };
        let kinds: String = structure.joints.iter().map(kind).collect();
        let n = kinds.len();
        let mut text =
            format!("{kinds}, {}; {}", counted(n, "articulación", "articulaciones"), structure.schematic());
        let numbers = |all: &[usize]| self.listed(&all.iter().map(ToString::to_string).collect::<Vec<_>>());
        for run in &structure.parallel {
            text += &format!("; ejes {} paralelos", numbers(run));
        }
        for &first in &structure.spherical {
            let what = if first + 2 == n { "muñeca esférica" } else { "articulación esférica" };
            let axes = numbers(&[first, first + 1, first + 2]);
            text += &format!("; ejes {axes} concurrentes ({what})");
        }
        for (k, _) in structure.relations.iter().enumerate().filter(|r| *r.1 == Relation::Coincident) {
            text += &format!("; ejes {} y {} coincidentes", k + 1, k + 2);
        }
        text + "."
    }

    fn convention(&self, convention: Convention) -> String {
        match convention {
            Convention::Standard => {
                "Denavit-Hartenberg estándar: Rot(z, θ) Trans(z, d) Trans(x, a) Rot(x, α)."
            }
            Convention::Craig => {
                "Denavit-Hartenberg modificada (Craig): Rot(x, α) Trans(x, a) Rot(z, θ) Trans(z, d)."
            }
            Convention::Khalil => "Khalil-Kleinfinger: Rot(x, α) Trans(x, d) Rot(z, θ) Trans(z, r).",
        }
        .into()
    }

    fn forward_cost(&self, count: &Count, proof: Proof) -> String {
        format!("{}; {}.", self.count(count), self.forward_proof(proof))
    }

    fn closed_form(&self, solutions: usize, given: &[String]) -> String {
        let count = match solutions {
            1 => "una solución".into(),
            n => format!("como mucho {n} soluciones"),
        };
        match given {
            [] => format!("forma cerrada, {count}."),
            _ => format!("forma cerrada, {count} para cada valor de {}.", given.join(", ")),
        }
    }

    fn no_closed_form(&self, by_elimination: bool) -> String {
        match by_elimination {
            true => "sin forma cerrada; todas las soluciones, 16 como mucho, por eliminación.",
            false => "sin forma cerrada; por cálculo numérico.",
        }
        .into()
    }

    fn factors(&self, factors: Factors) -> Line {
        Line::new(match factors {
            Factors::None => "ninguna.",
            Factors::NotShared => {
                "donde se anulan a la vez todos los determinantes de la sección sobre el jacobiano; no tienen ningún factor común."
            }
            Factors::Long => "factores del determinante demasiado largos para un resumen.",
            Factors::Everywhere => "en ninguna parte tiene el brazo seis direcciones.",
            Factors::TooLarge => "demasiado grandes para desarrollarlas.",
            Factors::Shared(all, is_complete) => {
                let mut line = Line::default();
                for (k, math) in all.into_iter().enumerate() {
                    line = line.text(if k > 0 { "; " } else { "" }).math(math);
                }
                return line.text(match is_complete {
                    true => ".",
                    false => {
                        "; además, donde se anulan a la vez todos los determinantes de la sección sobre el jacobiano."
                    }
                });
            }
        })
    }

    fn arm_caption(&self, configuration: Line) -> Line {
        let mut line = Line::new("El brazo con sus sistemas y longitudes, con ");
        line.0.extend(configuration.0);
        line.text(". Los cilindros giran, las cajas se deslizan; ejes x en rojo, ejes z en azul.")
    }

    fn converted(&self, convention: Convention) -> String {
        match convention {
            Convention::Standard => "En la convención estándar",
            Convention::Craig => "En la convención de Craig",
            Convention::Khalil => "En la convención de Khalil y Kleinfinger",
        }
        .into()
    }

    fn same_pose(&self, is_proved: bool) -> String {
        match is_proved {
            true => {
                "Demostrado: ambas tablas dan la misma pose de la herramienta, sean cuales sean los valores articulares y las longitudes."
            }
            false => {
                "No está demostrado que ambas tablas den la misma pose: el desarrollo es demasiado grande."
            }
        }
        .into()
    }

    fn parameter(&self, is_angle: bool, axis: char, frame: &str) -> String {
        let (what, how) = if is_angle { ("ángulo", "en torno al") } else { ("distancia", "a lo largo del") };
        let other = if axis == 'z' { 'x' } else { 'z' };
        format!(
            ": {what} del eje {other} del sistema j−1 al del sistema j, {how} eje {axis} del sistema {frame}"
        )
    }

    fn parameters(&self, convention: Convention) -> String {
        let convention = match convention {
            Convention::Standard => "estándar",
            Convention::Craig => "modificada de Craig",
            Convention::Khalil => "de Khalil y Kleinfinger",
        };
        format!("Parámetros en la convención {convention}; longitudes en metros.")
    }

    fn base_stands(&self) -> String {
        "La pose del sistema 0 en la base es".into()
    }

    fn tool_stands(&self) -> String {
        "La pose de la herramienta en el último sistema es".into()
    }

    fn base(&self) -> String {
        "base".into()
    }

    fn tool(&self) -> String {
        "herramienta".into()
    }

    fn values(&self) -> String {
        "Valores: ".into()
    }

    fn row_transform(&self) -> String {
        "La matriz de una fila de la tabla es".into()
    }

    fn row_by_row(&self) -> String {
        "y así, fila por fila,".into()
    }

    fn forward_title(&self) -> String {
        "Cinemática directa ".into()
    }

    fn image_title(&self, is_point: bool) -> String {
        if is_point { "Un punto en el otro sistema" } else { "Un vector libre en el otro sistema" }.into()
    }

    fn image(&self, is_point: bool, of: [Math; 3], from: &str, to: &str) -> Line {
        let (what, how) = match is_point {
            true => ("El punto", "gira y se traslada (cuarta coordenada 1)"),
            false => ("El vector", "gira sin trasladarse (cuarta coordenada 0)"),
        };
        let line = Line::new(format!("{what} (")).numbers(of, self.between());
        line.text(format!(") del sistema {to} tiene en el sistema {from} estas coordenadas; {how}."))
    }

    fn long_matrix(&self) -> String {
        "Los elementos de la matriz son demasiado largos para imprimirlos; los calcula el algoritmo que sigue.".into()
    }

    fn no_matrix(&self, why: Unexpanded) -> String {
        format!("La matriz no está desarrollada: {}.", self.unexpanded(why))
    }

    fn shortest_program(&self) -> String {
        "El mismo modelo, con el programa más corto que se ha encontrado:".into()
    }

    fn names(&self, all: Vec<Names>) -> Line {
        let mut line = Line::default();
        for (k, one) in all.into_iter().enumerate() {
            line = line.text(if k > 0 { "; " } else { "" }).list(one.names);
            line = line.text(match (one.has_cosine, one.has_sine) {
                (true, false) => ": coseno de ",
                (true, true) => ": coseno y seno de ",
                (false, _) => ": seno de ",
            });
            line = line.math(one.angle);
        }
        if line.0.is_empty() { line } else { line.text(".") }
    }

    fn counting_rule(&self) -> String {
        "Se cuentan cada multiplicación y cada suma cuyo resultado depende de una variable; los signos no cuentan; el seno y el coseno de un \
         mismo ángulo son un par; una constante sumada a una variable (su desfase) y lo que solo depende de parámetros se cuentan aparte."
            .into()
    }

    fn example(&self, configuration: Line) -> Line {
        let mut line = Line::new("Con ");
        line.0.extend(configuration.0);
        line.text(" los pasos del algoritmo dan, uno tras otro,")
    }

    fn example_pose(&self) -> String {
        "y la pose de la herramienta en la base es".into()
    }

    fn orientation(&self, rpy: &str, zyz: &str) -> String {
        format!(
            "Su orientación: alabeo, cabeceo y guiñada {rpy} (en torno a los ejes fijos x, y, z); ángulos de Euler ZYZ {zyz}."
        )
    }

    fn difference(&self, by: &str) -> String {
        format!(
            "El producto de las matrices de transformación, multiplicado en números, difiere de ella en {by} como mucho."
        )
    }

    fn refused(&self, why: &Refusal) -> String {
        format!("No hay forma cerrada: {}.", self.refusal(why))
    }

    fn long_formula(&self) -> String {
        "Aquí hay una fórmula demasiado larga para imprimirla; la opción `--json` de la orden la da.".into()
    }

    fn pose_at(&self, configuration: Line) -> Line {
        let mut line = Line::new("La pose de la herramienta con ");
        line.0.extend(configuration.0);
        line.text(" es")
    }

    fn given_values(&self, values: Line) -> Line {
        let mut line = Line::new("Dado ");
        line.0.extend(values.0);
        line.text(":")
    }

    fn no_solution(&self) -> String {
        "No se ha encontrado ninguna solución numérica.".into()
    }

    fn found(&self, isolated: usize, families: usize, is_complete: bool) -> String {
        let mut text = counted(isolated, "solución aislada", "soluciones aisladas");
        if families > 0 {
            let families = counted(
                families,
                "familia en la que el brazo se mueve con el efector final quieto (marcada con *: se muestra un miembro)",
                "familias en las que el brazo se mueve con el efector final quieto (marcadas con *: se muestra un miembro de cada una)",
            );
            text += &format!(" y {families}");
        }
        text + match is_complete {
            true if isolated + families == 1 => "; no hay otra. Se ha sustituido en la cadena.",
            true => "; no hay más. Cada una se ha sustituido en la cadena.",
            false => "; puede haber otras.",
        }
    }

    fn first_of_them(&self, shown: usize) -> String {
        format!("Se muestran las {shown} primeras.")
    }

    fn within_limits(&self, is_within: bool) -> String {
        if is_within { "dentro" } else { "fuera" }.into()
    }

    fn reach(&self, first: (&str, &str), second: (&str, &str), from_shoulder: Option<&str>) -> String {
        let ((u, x), (v, y)) = (first, second);
        let far = from_shoulder.map(|d| format!("; su mayor distancia al hombro es {d}"));
        format!(
            "Dentro de los límites articulares, la punta de la herramienta alcanza {u} = {x} y {v} = {y}{}.",
            far.unwrap_or_default()
        )
    }

    fn full_turns(&self) -> String {
        " Las articulaciones de rotación sin límites dan la vuelta completa.".into()
    }

    fn assumed_travel(&self) -> String {
        " Recorrido supuesto: ".into()
    }

    fn held(&self) -> String {
        " Fijo: ".into()
    }

    fn workspace(&self, plane: &Plane, [u, v]: [&str; 2], has_arm: bool) -> String {
        let text = match plane {
            Plane::ThroughAxis { joint, .. } => format!(
                "Lo que alcanza la punta de la herramienta, en el semiplano que pasa por el eje {} (distancia {u}, altura {v}). Colores: la \
                 mayor manipulabilidad √det(J Jᵀ) de su velocidad hallada allí, relativa a la mayor de todas.",
                joint + 1
            ),
            Plane::Plane { .. } => format!(
                "Lo que alcanza la punta de la herramienta, en su plano ({u}, {v}). Colores: la mayor manipulabilidad de su velocidad \
                 hallada allí, relativa a la mayor de todas."
            ),
            Plane::Projection { .. } => format!(
                "Lo que alcanza la punta de la herramienta, proyectado sobre el plano ({u}, {v}). Colores: la mayor manipulabilidad de su \
                 velocidad hallada allí, relativa a la mayor de todas."
            ),
        };
        text + if has_arm { " La línea es el brazo del ejemplo." } else { "" }
    }

    fn claims(&self, name: &str, claims: usize, s: Standings) -> String {
        let all = [
            (s.equal, ["demostrada", "demostradas"]),
            (s.wrong, ["errónea", "erróneas"]),
            (s.conditional, ["correcta con una condición", "correctas con una condición"]),
            (s.carried, ["arrastrada de un error anterior", "arrastradas de un error anterior"]),
            (s.undecided, ["sin decidir", "sin decidir"]),
            (s.unreadable, ["ilegible", "ilegibles"]),
        ];
        let parts = all.into_iter().filter(|(n, _)| *n > 0).map(|(n, [one, many])| counted(n, one, many));
        let unjudged = match s.unjudged {
            0 => String::new(),
            1 => " Otra línea no se ha juzgado.".into(),
            n => format!(" Otras {n} líneas no se han juzgado."),
        };
        let claims = counted(claims, "fórmula", "fórmulas");
        format!("{name} contiene {claims}: {}.{unjudged}", self.listed(&parts.collect::<Vec<_>>()))
    }

    fn cause(&self, [right, wrong, still]: [usize; 3]) -> String {
        let right = counted(right, "correcta", "correctas");
        let wrong = counted(wrong, "errónea", "erróneas");
        let still = if still == 1 { "una seguiría".to_string() } else { format!("{still} seguirían") };
        format!(" haría {right} y {wrong} de ellas; {still} mal.")
    }

    fn list(&self, list: List) -> String {
        match list {
            List::Wrong => "Erróneas",
            List::Conditional => "Correctas con una condición",
            List::Open => "Sin decidir o ilegibles",
            List::Unjudged => "No juzgadas",
        }
        .into()
    }

    fn more(&self, number: usize) -> String {
        let [more, them] = if number == 1 {
            ["otra".to_string(), "la".into()]
        } else {
            [format!("{number} más"), "las".into()]
        };
        format!("Y {more}; `denavit check` {them} enumera.")
    }

    fn printed(&self, line: usize, formula: &str) -> String {
        format!(", línea {line}: {formula}")
    }

    fn right(&self) -> String {
        "; correcto: ".into()
    }

    fn robot(&self) -> String {
        "El robot: ".into()
    }

    fn made_by(&self, version: &str) -> String {
        format!("Deducido, demostrado e impreso por denavit {version}.")
    }
}
