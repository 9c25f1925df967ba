//! Inverse kinematics.

use super::{German, counted};
use crate::explained::{Bound, Case, Component, Consequence, Kind, Remark, Source};
use crate::tree::{Line, Math, Proof, Sign};
use crate::words::{Coefficients, Given, Inverse, Terms};
use denavit::inverse::derivation::{Elimination, MAX_AXES, NotGiven};
use denavit::inverse::{Doubt, Goal, Label, Obstacle, Stuck, Task, Unsuitable};
use denavit_symbolic::Expr;

const ORDINALS: [&str; 5] = ["nullte", "erste", "zweite", "dritte", "vierte"];

impl Inverse for German {
    fn inverse_title(&self, robot: &str) -> String {
        format!("Inverse Kinematik: {robot}")
    }

    fn other_joints(&self) -> String {
        "Die übrigen Gelenke".into()
    }

    fn solutions_found(&self, solutions: Option<usize>) -> String {
        match solutions {
            Some(1) => "eine Lösung".into(),
            Some(n) => format!("höchstens {n} Lösungen"),
            None => "hier endet die Herleitung: es wurde keine geschlossene Form gefunden".into(),
        }
    }

    fn given(&self, given: Given) -> Line {
        let mut line = Line::new(match given.goal {
            Goal::Pose => "Gegeben ist die Pose T des Endeffektors",
            Goal::Position => "Gegeben ist die Position des Endeffektors",
            Goal::PositionAndAxis => {
                "Gegeben sind die Position des Endeffektors und die Richtung seiner z-Achse"
            }
        });
        let beside = given.joints.len();
        if beside > 0 {
            line = line.text(", dazu ").list(given.joints);
        }
        line = line.text(match (given.is_choice && beside > 0, beside) {
            (false, _) => "",
            (true, 1) => {
                " (ein Gelenk zu viel: jeder Wert ist erlaubt, und mit diesem ist die Herleitung am kürzesten)"
            }
            (true, _) => {
                " (Gelenke zu viel: alle Werte sind erlaubt, und mit diesen ist die Herleitung am kürzesten)"
            }
        });
        let line = line.text("; gesucht: ").list(given.sought).text(". ");
        match given.is_whole {
            true => line.text("Mit ").math(Given::whole()).text(" lautet die Kette"),
            false => {
                line.text("Was an beiden Enden konstant ist, kommt auf die Seite der Pose; übrig bleibt")
            }
        }
    }

    fn given_columns(&self, has_axis: bool) -> &'static str {
        match has_axis {
            true => {
                "Von U sind nur die dritte und die vierte Spalte gegeben; die anderen folgen aus der Lösung."
            }
            false => "Von U ist nur die vierte Spalte gegeben; die anderen folgen aus der Lösung.",
        }
    }

    fn short_names(&self, q: Expr, sum: Option<Expr>) -> Line {
        let line = Line::default().math(q.cos()).text(" und ").math(q.sin());
        let line = line.text(" sind Kosinus und Sinus von ").math(q);
        match sum {
            Some(sum) => line.text(", ").math(sum.cos()).text(" ist der Kosinus von ").math(sum).text("."),
            None => line.text("."),
        }
    }

    fn step_title(&self, number: usize, unknown: Line, values: usize, label: Option<Label>) -> Line {
        let mut line = Line::new(format!("Schritt {number}. "));
        line.0.extend(unknown.0);
        let line = line.text(match values {
            1 => ": ein Wert".into(),
            n => format!(": {n} Werte"),
        });
        line.text(label.map(|l| format!(" ({})", self.label(l))).unwrap_or_default())
    }

    fn source(&self, source: &Source) -> Line {
        let (left, right) = source.product.clone();
        let mut line = Line::new(if source.inverse { "Beide Seiten invertiert: " } else { "" });
        line = line.math(Math::Products(left, right)).text(", ");
        let [rows, columns] = source.rows_and_columns();
        // The noun stays in the singular: the second and third row are one each.
        let several = |all: &[usize], noun: &str| {
            let names: Vec<String> = all.iter().map(|&n| ORDINALS[n.min(4)].to_string()).collect();
            format!("{} {noun}", self.listed(&names))
        };
        line = line.text(match (rows.len(), columns.len()) {
            (1, _) | (_, 1) => format!("{}, {}", several(&rows, "Zeile"), several(&columns, "Spalte")),
            _ => {
                let places: Vec<String> =
                    source.elements.iter().map(|(r, c)| format!("({r}, {c})")).collect();
                format!("Elemente {}", self.listed(&places))
            }
        });
        let why = source.why.as_ref().map(|why| format!(" ({})", self.component(why)));
        line.text(why.unwrap_or_default()).text(":")
    }

    fn component(&self, component: &Component) -> String {
        let numbers = |all: &[usize]| self.numbers(all);
        let of = match (&component.of[..], component.is_point) {
            ([], _) => String::new(),
            ([axis], false) => format!(" der Richtung von Achse {}", axis + 1),
            (axes, false) => format!(" der Richtung der Achsen {}", numbers(axes)),
            ([axis], true) => format!(" eines Punkts auf Achse {}", axis + 1),
            (axes, true) => format!(" eines gemeinsamen Punkts der Achsen {}", numbers(axes)),
        };
        let along = match &component.along[..] {
            [] => String::new(),
            [axis] => format!(" längs Achse {}", axis + 1),
            axes => format!(" längs der parallelen Achsen {}", numbers(axes)),
        };
        let free = match &component.free[..] {
            [joint] => format!(": unabhängig von Gelenk {}", joint + 1),
            joints => format!(": unabhängig von den Gelenken {}", numbers(joints)),
        };
        format!("eine Komponente{of}{along}{free}")
    }

    fn elimination(&self, unknown: Expr, how: Elimination) -> Line {
        Line::default().math(unknown).text(match how {
            Elimination::Rotation => {
                " fällt heraus, wenn man beide Gleichungen nach den Termen darin auflöst, quadriert und addiert: Die Faktoren \
                 von Kosinus und Sinus sind die einer Drehung."
            }
            Elimination::Cramer => {
                " fällt heraus, wenn man Kosinus und Sinus mit der Cramerschen Regel berechnet; die Summe ihrer Quadrate ist 1."
            }
            Elimination::Displacement => {
                " fällt heraus, wenn man die eine Gleichung danach auflöst und in die andere einsetzt."
            }
        })
    }

    fn names_follow(&self, is_beside: bool) -> String {
        if is_beside { "mit" } else { "Es sei" }.into()
    }

    fn kind(&self, kind: Kind) -> String {
        match kind {
            Kind::Displacement => "linear in der Verschiebung",
            Kind::DisplacementSquared => "quadratisch in der Verschiebung",
            Kind::Quartic => "vom Grad 2 in Kosinus und Sinus: vom Grad 4 in tan(θ/2)",
            Kind::Homogeneous => "linear in Kosinus und Sinus, ohne rechte Seite",
            Kind::Cosine => "ein Kosinus allein",
            Kind::Sine => "ein Sinus allein",
            Kind::Linear => "linear in Kosinus und Sinus",
            Kind::Pair => "zwei Gleichungen, linear in Kosinus und Sinus",
            Kind::Separate => "Kosinus und Sinus, jeder aus einer eigenen Gleichung",
        }
        .into()
    }

    fn equation(&self, kind: Kind, is_squared: bool, form: &[Math], coefficients: &Coefficients) -> Line {
        let mut line = Line::new(match (kind.number(), is_squared) {
            ("none", _) => "Eine Gleichung ".to_string(),
            (n, true) => format!("Die Quadrate beider Seiten, addiert: Typ {n}, "),
            (n, false) => format!("Typ {n}, "),
        });
        line = line.text(self.kind(kind));
        for (k, f) in form.iter().enumerate() {
            line = line.text(if k == 0 { ": " } else { " und " }).math(f.clone());
        }
        match coefficients {
            Coefficients::Below => line.text(" mit"),
            Coefficients::Here([]) => line.text("; also"),
            Coefficients::Here(all) => {
                line.text(" mit ").numbers(all.iter().cloned(), self.between()).text("; also")
            }
        }
    }

    fn so(&self) -> String {
        "also".into()
    }

    fn case(&self, case: &Case) -> Line {
        let mut line = Line::default();
        let between = if case.is_zeros() { " und " } else { " oder " };
        for (k, m) in case.when.iter().enumerate() {
            line = line.text(if k == 0 { "" } else { between }).math(m.clone());
        }
        line.text(if case.when.is_empty() { "" } else { ": " }).text(self.consequence(case.then))
    }

    fn consequence(&self, consequence: Consequence) -> String {
        match consequence {
            Consequence::NoSolution(bound) => nothing(bound),
            Consequence::Coincide => "beide Werte fallen zusammen (Vielfachheit 2)",
            Consequence::TwoValues(bound) => {
                return format!(
                    "zwei Werte; sie fallen zusammen, wo Gleichheit gilt (Vielfachheit 2, eine singuläre Stellung); sonst {}",
                    match bound {
                        Bound::Reach => nothing(bound),
                        Bound::Span => {
                            "ist der Arm zu kurz oder lässt sich nicht so weit falten: keine Lösung auf diesem Zweig"
                        }
                    }
                );
            }
            Consequence::OpenDisplacement => {
                "die Gleichung bestimmt die Verschiebung nicht: Verschwindet auch die rechte Seite, so ist sie frei oder folgt aus einer \
                 anderen Gleichung; sonst keine Lösung"
            }
            Consequence::OpenAngle => {
                "die Gleichung lässt den Winkel offen: Er ist frei (der Arm kann sich bewegen, ohne das Ziel zu verlassen) oder folgt aus \
                 einer anderen Gleichung"
            }
            Consequence::OpenUnless => {
                "keine Lösung, es sei denn, auch die rechte Seite verschwindet: dann lässt die Gleichung das Gelenk offen"
            }
            Consequence::OpenJoint => {
                "verschwinden auch die rechten Seiten, so ist das Gelenk frei oder folgt aus einer anderen Gleichung; sonst keine Lösung"
            }
            Consequence::Roots => {
                "so viele Werte, wie das Polynom reelle Nullstellen t = tan(θ/2) hat: 0, 2 oder 4; eine doppelte zählt zweifach"
            }
            Consequence::HalfTurn => "eine der Nullstellen ist die halbe Umdrehung",
            Consequence::Free => "das Gelenk ist frei",
            Consequence::OneValue => "immer genau ein Wert",
            Consequence::OneEquation => {
                "beide Gleichungen sind eine: zwei Werte, ein freies Gelenk oder keine Lösung; der Löser nimmt die Zeile mit der größeren \
                 Norm"
            }
        }
        .into()
    }

    fn remark(&self, remark: Remark) -> String {
        match remark {
            Remark::MayAdd => {
                "Beim Eliminieren können Nullstellen dazukommen, die nur diese Gleichung lösen; das Residuum der Pose sondert sie aus."
            }
            Remark::SquaresAddNone => {
                "Das Quadrieren bringt keine Lösung hinzu: Zu jedem Wert der Unbekannten geben die Komponenten die Richtung, die beim \
                 Quadrieren verloren ging."
            }
            Remark::Whole => "Keine Gleichung wird weggelassen, nichts wird quadriert.",
            Remark::AddsNone => "Keine Nullstelle kommt hinzu.",
        }
        .into()
    }

    fn step_remark(&self, sign: Option<(Expr, Option<Label>)>, remark: Remark, used_by: &[usize]) -> Line {
        let mut line = Line::default();
        if let Some((sign, label)) = sign {
            line = line.math(Math::relation(sign, Sign::EitherSign, Expr::int(1)));
            if let Some(label) = label.map(|l| self.label(l)) {
                line = line.text(format!(": {label}+ und {label}−"));
            }
            line = line.text(". ");
        }
        line.text(self.remark(remark)).text(match used_by {
            [] => " Kein späterer Schritt braucht das Ergebnis.".to_string(),
            [one] => format!(" Gebraucht in Schritt {one}."),
            many => {
                let many: Vec<String> = many.iter().map(ToString::to_string).collect();
                format!(" Gebraucht in den Schritten {}.", self.listed(&many))
            }
        })
    }

    fn conditions_title(&self) -> String {
        "Was die Pose erfüllen muss".into()
    }

    fn conditions(&self, rank: usize, task: Option<Task>) -> String {
        let freedoms = counted(rank, "Freiheitsgrad", "Freiheitsgrade");
        let told = task.map(|t| format!(": Vorgeben lässt sich {}", self.task(t))).unwrap_or_default();
        format!("Der Endeffektor hat {freedoms}{told}. Eine erreichbare Pose erfüllt")
    }

    fn task(&self, task: Task) -> String {
        match task {
            Task::Pose => "jede Position und Orientierung".into(),
            Task::PositionAndAxis => "eine Position und die Richtung der Werkzeugachse".into(),
            Task::PositionAndTurn => {
                "eine Position und eine Drehung um eine feste Richtung (x, y, z, φ)".into()
            }
            Task::Planar => "eine Position und eine Drehung in einer Ebene (x, y, φ)".into(),
            Task::Position => "eine Position (x, y, z)".into(),
            Task::Orientation => "eine Orientierung".into(),
            Task::Other(n) => format!("eine Pose aus einer {n}-dimensionalen Menge"),
        }
    }

    fn solutions_title(&self, solutions: usize) -> String {
        match solutions {
            1 => "Eine Lösung".into(),
            n => format!("Höchstens {n} Lösungen"),
        }
    }

    fn solutions_product(&self, product: &str) -> String {
        format!("{product} Zweige:")
    }

    fn solutions_remark(&self) -> String {
        "Jeder Schritt folgt aus den Gleichungen davor und hat alle ihre Lösungen, also geht keine verloren. Jede Lösung wird in die \
         ganze Kette eingesetzt; was die Pose nicht ergibt, entfällt. Die Typen sind wie bei Khalil und Dombre nummeriert; 1, 2 und 3 \
         sind die von Paul."
            .into()
    }

    fn ended_title(&self) -> String {
        "Hier endet die Herleitung".into()
    }

    fn ended(&self, has_found: bool, missing: Vec<Math>) -> Line {
        let line = Line::new(if has_found { "" } else { "Es wurde nichts gefunden. " });
        let line = line.text(
            "Keine Gleichung der Kette und keine der erprobten Kombinationen von je zweien enthält als einzige Unbekannte ",
        );
        line.list(missing).text(", und zwar mit einem Grad bis 4 in tan(θ/2).")
    }

    fn ended_remark(&self, surplus: usize) -> String {
        if surplus == 0 {
            return "Geschlossene Formen gibt es, wo sich drei aufeinanderfolgende Achsen in einem Punkt schneiden oder parallel sind; \
                    sonst hat ein Arm im Allgemeinen bis zu 16 Lösungen, Nullstellen eines Polynoms vom Grad 16."
                .into();
        }
        format!(
            "Der Arm hat {} mehr, als der Endeffektor braucht: Sind andere Gelenke gegeben, kommt die Herleitung vielleicht ans Ziel.",
            counted(surplus, "Gelenk", "Gelenke")
        )
    }

    fn solution(&self, number: usize) -> String {
        format!("Lösung {number}")
    }

    fn legend(&self, proof: Proof) -> String {
        match proof {
            Proof::Proved => {
                "✓: bewiesen. Mit A1·A2·… für U sind beide Seiten identisch, für alle Gelenkwerte und Längen."
            }
            Proof::Sampled => {
                "✓: bewiesen. ≈: nur an Stichproben geprüft; ausmultipliziert ist der Ausdruck zu groß, um zu entscheiden."
            }
            Proof::Wrong => "Eine der Formeln oben ist FALSCH: das ist ein Fehler des Programms.",
        }
        .into()
    }

    fn unsuitable(&self, why: &Unsuitable) -> String {
        match why {
            Unsuitable::Helical(row) => format!("Zeile {row} dreht und schiebt zugleich (Schraubgelenk)"),
            Unsuitable::Coupling => {
                "die Winkel der Zeilen sind keine Summen ganzer Vielfacher von so vielen von ihnen, wie es \
                 Gelenkvariablen gibt"
                    .into()
            }
            Unsuitable::NoJoint => "der Roboter hat kein Gelenk".into(),
            Unsuitable::TooLong(n) => {
                format!("der Roboter hat {n} Gelenke; geschlossene Formen werden bis {MAX_AXES} gesucht")
            }
        }
    }

    fn not_given(&self, why: NotGiven) -> String {
        match why {
            NotGiven::NoSuchJoint { joint, joints } => {
                format!("Gelenk {} ist gegeben, aber es gibt nur {joints}", joint + 1)
            }
            NotGiven::NoSurplus => {
                "es kann kein Gelenk gegeben sein: der Arm hat nicht mehr, als sein Endeffektor braucht"
                    .into()
            }
            NotGiven::TooMany { given, surplus } => format!(
                "{} gegeben, aber der Arm hat nur {surplus} zu viel",
                if given == 1 { "1 Gelenk ist".into() } else { format!("{given} Gelenke sind") }
            ),
        }
    }

    fn stuck(&self, stuck: &Stuck) -> String {
        let [found, missing] = [stuck.found(), stuck.open()].map(|all| all.join(", "));
        let found = if found.is_empty() { "nichts".into() } else { found };
        if stuck.is_spent {
            format!(
                "keine geschlossene Form innerhalb der Rechengrenze: gefunden wurde bis dahin {found}; offen ist {missing}"
            )
        } else {
            format!(
                "keine geschlossene Form: gefunden wurde {found}; für {missing} bleibt keine Gleichung mit einer einzigen Unbekannten \
                 und einem Grad bis 4"
            )
        }
    }

    fn doubt(&self, doubt: Doubt) -> String {
        match doubt {
            Doubt::Sampled => "manche Lösungen wurden durch Probieren gefunden",
            Doubt::DoubleRoot => "nahe einer doppelten Nullstelle unentschieden",
            Doubt::Uncounted => "die Nullstellen konnten nicht gezählt werden",
            Doubt::Searched => "von mehreren Startwerten aus gesucht",
            Doubt::OneAsked => "nur eine war verlangt",
            Doubt::Copies => {
                "durch Getriebe kehrt jede Stellung innerhalb einer Umdrehung öfter wieder als aufgeführt"
            }
            Doubt::Digits => {
                "der Roboter steht so weit vom Ursprung entfernt, dass die Pose zu wenige Stellen hat"
            }
        }
        .into()
    }

    fn obstacle(&self, obstacle: &Obstacle) -> String {
        match &obstacle.unknown {
            Some(x) => format!("kein Zweig hat einen Wert für {x}"),
            None => "der Endeffektor kann diese Pose nicht einnehmen".into(),
        }
    }

    fn violated(&self, conditions: &[&str]) -> String {
        format!("eine Pose dieses Arms erfüllt {}", conditions.join(", "))
    }
}

fn nothing(bound: Bound) -> &'static str {
    match bound {
        Bound::Reach => "außer Reichweite: keine Lösung auf diesem Zweig",
        Bound::Span => {
            "der Arm ist zu kurz oder lässt sich nicht so weit falten: keine Lösung auf diesem Zweig"
        }
    }
}
