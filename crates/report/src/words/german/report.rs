//! The sections of a report.

use super::{German, counted};
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

impl Report for German {
    fn title(&self, robot: &str) -> String {
        format!("Kinematik: {robot}")
    }

    fn of_the_position(&self, said: &str) -> String {
        format!("Die Position allein: {said}")
    }

    fn compared(&self, robots: &[&str]) -> String {
        format!("{} im Vergleich", self.listed(&robots.iter().map(ToString::to_string).collect::<Vec<_>>()))
    }

    fn beside_each_other(&self, have_one_scale: bool) -> [&'static str; 2] {
        let pictures = match have_one_scale {
            true => "Die Roboter in einem gemeinsamen Maßstab.",
            false => "Die Roboter, jeder so groß, wie es sein Bild erlaubt.",
        };
        ["Die Roboter auf einen Blick.", pictures]
    }

    fn heading(&self, heading: Heading) -> String {
        match heading {
            Heading::Arm => "Der Arm",
            Heading::Arms => "Die Arme",
            Heading::Table => "Denavit-Hartenberg-Parameter",
            Heading::Links => "Transformationsmatrizen",
            Heading::Algorithm => "Algorithmus",
            Heading::Example => "Ein Zahlenbeispiel",
            Heading::Inverse => "Inverse Kinematik",
            Heading::Solutions => "Die Lösungen im Beispiel",
            Heading::Velocity => "Jacobi-Matrix und Singularitäten",
            Heading::Dynamics => "Dynamik",
            Heading::Workspace => "Arbeitsraum",
            Heading::Errata => "Errata",
            Heading::References => "Literatur",
        }
        .into()
    }

    fn glance(&self, glance: Glance) -> String {
        match glance {
            Glance::Structure => "Aufbau",
            Glance::Convention => "Konvention",
            Glance::Source => "Quelle",
            Glance::Forward => "Direkte Kinematik",
            Glance::Inverse => "Inverse Kinematik",
            Glance::Singularities => "Singularitäten",
        }
        .into()
    }

    fn column(&self, column: Column) -> String {
        match column {
            Column::Joint => "Gelenk",
            Column::Torque => "Haltemoment",
            Column::Inertia => "Trägheit",
            Column::Name => "Name",
            Column::Limits => "Grenzen",
            Column::Branch => "Zweig",
            Column::Step => "Schritt",
            Column::Value => "Wert",
        }
        .into()
    }

    fn caption(&self, caption: Caption) -> String {
        match caption {
            Caption::AtRest => {
                "Was den Arm gegen die Schwerkraft in Ruhe hält und welche Trägheit jedes Gelenk für sich spürt, bei"
            }
            Caption::Steps => "Die Schritte des Algorithmus in Zahlen; Längen in Metern.",
            Caption::Configurations => "Alle Stellungen mit dieser Pose.",
            Caption::Picture => "Die Stellung der Tabelle.",
            Caption::Pictures => "Die Stellungen der Tabelle, alle mit derselben Pose des Werkzeugs.",
            Caption::Singular => {
                "Zu jeder Singularität eine Stellung; die Achsen, auf die es ankommt, sind hervorgehoben."
            }
            Caption::Scheme => "Kinematisches Schema: Gelenkachsen, Gelenkvariablen und die Längen dazwischen.",
        }
        .into()
    }

    fn table(&self) -> &'static str {
        "Tabelle"
    }

    fn figure(&self) -> &'static str {
        "Abbildung"
    }

    fn contents(&self) -> &'static str {
        "Inhalt"
    }

    fn turning(&self) -> [&'static str; 2] {
        ["Schritt zurück", "Nächster Schritt"]
    }

    fn formula(&self) -> &'static str {
        "Formel"
    }

    fn picture(&self, own: &str, whole: &str) -> String {
        format!("{own}: {whole}")
    }

    fn arm_picture(&self, is_scheme: bool, robot: &str, joints: &str) -> String {
        let what = if is_scheme { "Kinematisches Schema" } else { "Ansicht" };
        format!("{what}: {robot}, Gelenke {joints} von der Basis zum Endeffektor")
    }

    fn workspace_picture(&self, plane: &Plane, [[a, b], [c, d]]: [[String; 2]; 2]) -> String {
        let [u, v] = plane.symbols();
        let what = match plane {
            Plane::ThroughAxis { joint, .. } => {
                format!("Halbebene durch Achse {} (Abstand {u} von ihr, Höhe {v} längs der Achse)", joint + 1)
            }
            Plane::Plane { .. } => format!("{u}-{v}-Ebene, in der sich der Arm bewegt"),
            Plane::Projection { .. } => format!("Projektion auf die {u}-{v}-Ebene"),
        };
        let [a, b, c, d] = [a, b, c, d].map(|x| self.written(x));
        format!(
            "Schnitt durch den Arbeitsraum, {what}: {u} von {a} bis {b} m, {v} von {c} bis {d} m; Farben nach der \
             Manipulierbarkeit, der größte Wert ist 1"
        )
    }

    fn curves_picture(&self, title: &str, names: &[String]) -> String {
        format!("{title}: {} über der waagerechten Achse", names.join(", "))
    }

    fn assumed_lengths(&self) -> String {
        "Einige Längen haben keinen Wert. Abbildungen und Zahlen nehmen an: ".into()
    }

    fn structure(&self, structure: &Structure) -> String {
        let kind = |k: &JointKind| if *k == JointKind::Revolute { 'R' } else { 'P' };
        let kinds: String = structure.joints.iter().map(kind).collect();
        let n = kinds.len();
        let mut text = format!("{kinds}, {}; {}", counted(n, "Gelenk", "Gelenke"), structure.schematic());
        let numbers = |all: &[usize]| self.listed(&all.iter().map(ToString::to_string).collect::<Vec<_>>());
        for run in &structure.parallel {
            text += &format!("; Achsen {} parallel", numbers(run));
        }
        for &first in &structure.spherical {
            let what = if first + 2 == n { "sphärisches Handgelenk" } else { "Kugelgelenk" };
            let axes = numbers(&[first, first + 1, first + 2]);
            text += &format!("; Achsen {axes} mit gemeinsamem Schnittpunkt ({what})");
        }
        for (k, _) in structure.relations.iter().enumerate().filter(|r| *r.1 == Relation::Coincident) {
            text += &format!("; Achsen {} und {} fallen zusammen", k + 1, k + 2);
        }
        text + "."
    }

    fn convention(&self, convention: Convention) -> String {
        match convention {
            Convention::Standard => {
                "Denavit-Hartenberg, klassisch: Rot(z, θ) Trans(z, d) Trans(x, a) Rot(x, α)."
            }
            Convention::Craig => {
                "Denavit-Hartenberg, modifiziert (Craig): Rot(x, α) Trans(x, a) Rot(z, θ) Trans(z, d)."
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
            1 => "eine Lösung".into(),
            n => format!("höchstens {n} Lösungen"),
        };
        match given {
            [] => format!("geschlossene Form, {count}."),
            _ => format!("geschlossene Form, {count} zu jedem Wert von {}.", given.join(", ")),
        }
    }

    fn no_closed_form(&self, by_elimination: bool) -> String {
        match by_elimination {
            true => "keine geschlossene Form; alle Lösungen, höchstens 16, durch Elimination.",
            false => "keine geschlossene Form; numerisch.",
        }
        .into()
    }

    fn factors(&self, factors: Factors) -> Line {
        Line::new(match factors {
            Factors::None => "keine.",
            Factors::NotShared => {
                "wo alle Determinanten des Abschnitts über die Jacobi-Matrix zugleich verschwinden; einen gemeinsamen Faktor haben sie \
                 nicht."
            }
            Factors::Long => "Faktoren der Determinante, die für eine Übersicht zu lang sind.",
            Factors::Everywhere => "der Arm hat nirgends sechs Richtungen.",
            Factors::TooLarge => "zu groß zum Ausmultiplizieren.",
            Factors::Shared(all, is_complete) => {
                let mut line = Line::default();
                for (k, math) in all.into_iter().enumerate() {
                    line = line.text(if k > 0 { "; " } else { "" }).math(math);
                }
                return line.text(match is_complete {
                    true => ".",
                    false => {
                        "; außerdem, wo alle Determinanten des Abschnitts über die Jacobi-Matrix zugleich verschwinden."
                    }
                });
            }
        })
    }

    fn arm_caption(&self, configuration: Line) -> Line {
        let mut line = Line::new("Der Arm mit Koordinatensystemen und Längen, bei ");
        line.0.extend(configuration.0);
        line.text(". Zylinder drehen, Quader schieben; x-Achsen rot, z-Achsen blau.")
    }

    fn converted(&self, convention: Convention) -> String {
        match convention {
            Convention::Standard => "In der klassischen Konvention",
            Convention::Craig => "In der Konvention von Craig",
            Convention::Khalil => "In der Konvention von Khalil und Kleinfinger",
        }
        .into()
    }

    fn same_pose(&self, is_proved: bool) -> String {
        match is_proved {
            true => {
                "Bewiesen: Beide Tabellen ergeben dieselbe Pose des Werkzeugs, für alle Gelenkwerte und Längen."
            }
            false => {
                "Dass beide Tabellen dieselbe Pose ergeben, ist nicht bewiesen: ausmultipliziert ist der Ausdruck zu groß."
            }
        }
        .into()
    }

    fn parameter(&self, is_angle: bool, axis: char, frame: &str) -> String {
        let (what, how) = if is_angle { ("Winkel", "um die") } else { ("Abstand", "längs der") };
        let other = if axis == 'z' { 'x' } else { 'z' };
        format!(
            ": {what} von der {other}-Achse des Systems j−1 zu der des Systems j, {how} {axis}-Achse des Systems {frame}"
        )
    }

    fn parameters(&self, convention: Convention) -> String {
        let convention = match convention {
            Convention::Standard => "in der klassischen Konvention",
            Convention::Craig => "in der (modifizierten) Konvention von Craig",
            Convention::Khalil => "in der Konvention von Khalil und Kleinfinger",
        };
        format!("Parameter {convention}; Längen in Metern.")
    }

    fn base_stands(&self) -> String {
        "Die Lage des Koordinatensystems 0 in der Basis:".into()
    }

    fn tool_stands(&self) -> String {
        "Die Lage des Werkzeugs im letzten Koordinatensystem:".into()
    }

    fn base(&self) -> String {
        "Basis".into()
    }

    fn tool(&self) -> String {
        "Werkzeug".into()
    }

    fn values(&self) -> String {
        "Werte: ".into()
    }

    fn row_transform(&self) -> String {
        "Zu einer Zeile der Tabelle gehört die Matrix".into()
    }

    fn row_by_row(&self) -> String {
        "also, Zeile für Zeile,".into()
    }

    fn forward_title(&self) -> String {
        "Direkte Kinematik ".into()
    }

    fn image_title(&self, is_point: bool) -> String {
        if is_point {
            "Ein Punkt im anderen Koordinatensystem"
        } else {
            "Ein freier Vektor im anderen Koordinatensystem"
        }
        .into()
    }

    fn image(&self, is_point: bool, of: [Math; 3], from: &str, to: &str) -> Line {
        let (what, how) = match is_point {
            true => ("Der Punkt", "er wird gedreht und verschoben (vierte Koordinate 1)"),
            false => ("Der Vektor", "er wird gedreht, aber nicht verschoben (vierte Koordinate 0)"),
        };
        let line = Line::new(format!("{what} (")).numbers(of, self.between());
        line.text(format!(") des Systems {to} hat im System {from} diese Koordinaten; {how}."))
    }

    fn long_matrix(&self) -> String {
        "Die Elemente der Matrix sind zu lang zum Drucken; der Algorithmus unten berechnet sie.".into()
    }

    fn no_matrix(&self, why: Unexpanded) -> String {
        format!("Die Matrix ist nicht ausmultipliziert: {}.", self.unexpanded(why))
    }

    fn shortest_program(&self) -> String {
        "Dasselbe Modell als kürzestes Programm, das dafür gefunden wurde:".into()
    }

    fn names(&self, all: Vec<Names>) -> Line {
        let mut line = Line::default();
        for (k, one) in all.into_iter().enumerate() {
            line = line.text(if k > 0 { "; " } else { "" }).list(one.names);
            line = line.text(match (one.has_cosine, one.has_sine) {
                (true, false) => ": Kosinus von ",
                (true, true) => ": Kosinus und Sinus von ",
                (false, _) => ": Sinus von ",
            });
            line = line.math(one.angle);
        }
        if line.0.is_empty() { line } else { line.text(".") }
    }

    fn counting_rule(&self) -> String {
        "Gezählt wird jede Multiplikation und jede Addition, deren Ergebnis von einer Variablen abhängt; Vorzeichen zählen nicht; Sinus und \
         Kosinus desselben Winkels sind ein Paar; eine Konstante, die zu einer Variablen addiert wird (ihr Versatz), und was nur von \
         Parametern abhängt, werden gesondert gezählt."
            .into()
    }

    fn example(&self, configuration: Line) -> Line {
        let mut line = Line::new("Mit ");
        line.0.extend(configuration.0);
        line.text(" ergeben die Schritte des Algorithmus der Reihe nach")
    }

    fn example_pose(&self) -> String {
        "und die Pose des Werkzeugs in der Basis".into()
    }

    fn orientation(&self, rpy: &str, zyz: &str) -> String {
        format!(
            "Ihre Orientierung: Roll-, Nick- und Gierwinkel {rpy} (um die festen Achsen x, y, z); Euler-Winkel ZYZ {zyz}."
        )
    }

    fn difference(&self, by: &str) -> String {
        format!(
            "Das in Zahlen ausmultiplizierte Produkt der Transformationsmatrizen weicht davon um höchstens {by} ab."
        )
    }

    fn refused(&self, why: &Refusal) -> String {
        format!("Es gibt keine geschlossene Form: {}.", self.refusal(why))
    }

    fn long_formula(&self) -> String {
        "Hier steht eine Formel, die zu lang zum Drucken ist; die Option `--json` des Befehls gibt sie aus."
            .into()
    }

    fn pose_at(&self, configuration: Line) -> Line {
        let mut line = Line::new("Die Pose des Werkzeugs bei ");
        line.0.extend(configuration.0);
        line.text(" ist")
    }

    fn given_values(&self, values: Line) -> Line {
        let mut line = Line::new("Gegeben ");
        line.0.extend(values.0);
        line.text(":")
    }

    fn no_solution(&self) -> String {
        "Numerisch wurde keine Lösung gefunden.".into()
    }

    fn found(&self, isolated: usize, families: usize, is_complete: bool) -> String {
        let mut text = counted(isolated, "isolierte Lösung", "isolierte Lösungen");
        if families > 0 {
            let families = counted(
                families,
                "Schar, in der sich der Arm bei ruhendem Endeffektor bewegt (mit * bezeichnet: gezeigt ist ein Mitglied)",
                "Scharen, in denen sich der Arm bei ruhendem Endeffektor bewegt (mit * bezeichnet: gezeigt ist je ein Mitglied)",
            );
            text += &format!(" und {families}");
        }
        text + match is_complete {
            true if isolated + families == 1 => {
                "; eine andere gibt es nicht. Sie wurde in die Kette eingesetzt."
            }
            true => "; das sind alle. Jede wurde in die Kette eingesetzt.",
            false => "; es kann weitere geben.",
        }
    }

    fn first_of_them(&self, shown: usize) -> String {
        format!("Gezeigt sind die ersten {shown}.")
    }

    fn within_limits(&self, is_within: bool) -> String {
        if is_within { "eingehalten" } else { "verletzt" }.into()
    }

    fn reach(&self, first: (&str, &str), second: (&str, &str), from_shoulder: Option<&str>) -> String {
        let ((u, x), (v, y)) = (first, second);
        let far = from_shoulder.map(|d| format!("; ihr größter Abstand von der Schulter ist {d}"));
        format!(
            "Innerhalb der Gelenkgrenzen erreicht die Werkzeugspitze {u} = {x} und {v} = {y}{}.",
            far.unwrap_or_default()
        )
    }

    fn full_turns(&self) -> String {
        " Drehgelenke ohne Grenzen drehen sich ganz herum.".into()
    }

    fn assumed_travel(&self) -> String {
        " Angenommener Verfahrweg: ".into()
    }

    fn held(&self) -> String {
        " Festgehalten: ".into()
    }

    fn workspace(&self, plane: &Plane, [u, v]: [&str; 2], has_arm: bool) -> String {
        let text = match plane {
            Plane::ThroughAxis { joint, .. } => format!(
                "Was die Werkzeugspitze erreicht, in der Halbebene durch Achse {} (Abstand {u}, Höhe {v}). Farben: die größte dort \
                 gefundene Manipulierbarkeit √det(J Jᵀ) ihrer Geschwindigkeit, bezogen auf die größte von allen.",
                joint + 1
            ),
            Plane::Plane { .. } => format!(
                "Was die Werkzeugspitze erreicht, in ihrer Ebene ({u}, {v}). Farben: die größte dort gefundene Manipulierbarkeit ihrer \
                 Geschwindigkeit, bezogen auf die größte von allen."
            ),
            Plane::Projection { .. } => format!(
                "Was die Werkzeugspitze erreicht, auf die Ebene ({u}, {v}) projiziert. Farben: die größte dort gefundene \
                 Manipulierbarkeit ihrer Geschwindigkeit, bezogen auf die größte von allen."
            ),
        };
        text + if has_arm { " Die Linie ist der Arm des Beispiels." } else { "" }
    }

    fn claims(&self, name: &str, claims: usize, s: Standings) -> String {
        let all = [
            (s.equal, "bewiesen"),
            (s.wrong, "falsch"),
            (s.conditional, "unter einer Bedingung richtig"),
            (s.carried, "Folgefehler"),
            (s.undecided, "unentschieden"),
            (s.unreadable, "unlesbar"),
        ];
        let parts = all.into_iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}"));
        let unjudged = match s.unjudged {
            0 => String::new(),
            1 => " Eine weitere Zeile wurde nicht beurteilt.".into(),
            n => format!(" {n} weitere Zeilen wurden nicht beurteilt."),
        };
        let claims = counted(claims, "Formel", "Formeln");
        format!("{name} enthält {claims}: {}.{unjudged}", self.listed(&parts.collect::<Vec<_>>()))
    }

    fn cause(&self, [right, wrong, still]: [usize; 3]) -> String {
        let still = if still == 1 { "bliebe eine".to_string() } else { format!("blieben {still}") };
        format!(" würde {right} davon richtig und {wrong} falsch machen; falsch {still}.")
    }

    fn list(&self, list: List) -> String {
        match list {
            List::Wrong => "Falsch",
            List::Conditional => "Unter einer Bedingung richtig",
            List::Open => "Unentschieden oder unlesbar",
            List::Unjudged => "Nicht beurteilt",
        }
        .into()
    }

    fn more(&self, number: usize) -> String {
        let more = if number == 1 { "eine".to_string() } else { number.to_string() };
        format!("Und {more} weitere; `denavit check` führt sie auf.")
    }

    fn printed(&self, line: usize, formula: &str) -> String {
        format!(", Zeile {line}: {formula}")
    }

    fn right(&self) -> String {
        "; richtig: ".into()
    }

    fn robot(&self) -> String {
        "Der Roboter: ".into()
    }

    fn made_by(&self, version: &str) -> String {
        format!("Hergeleitet, bewiesen und gedruckt mit denavit {version}.")
    }
}
