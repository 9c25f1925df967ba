//! Inverse kinematics.

use super::{French, counted, printed, set};
use crate::explained::{Bound, Case, Component, Consequence, Kind, Remark, Source};
use crate::tree::{Line, Math, Proof, Sign};
use crate::words::{Coefficients, Given, Inverse, Terms};
use denavit::inverse::derivation::{Elimination, MAX_AXES, NotGiven};
use denavit::inverse::{Doubt, Goal, Label, Obstacle, Stuck, Task, Unsuitable};
use denavit_symbolic::Expr;

const ORDINALS: [&str; 5] = ["zéroième", "première", "deuxième", "troisième", "quatrième"];

impl Inverse for French {
    fn inverse_title(&self, robot: &str) -> String {
        // No article: whatever the gender of the name.
        say!("Modèle géométrique inverse : {robot}")
    }

    fn other_joints(&self) -> String {
        "Les autres articulations".into()
    }

    fn solutions_found(&self, solutions: Option<usize>) -> String {
        match solutions {
            Some(1) => "une seule solution".into(),
            Some(n) => format!("au plus {n} solutions"),
            None => say!("la résolution s'arrête ici : aucune forme explicite n'a été trouvée"),
        }
    }

    fn given(&self, given: Given) -> Line {
        let mut line = Line::new(match given.goal {
            Goal::Pose => "On donne la pose T de l'organe terminal",
            Goal::Position => "On donne la position de l'organe terminal",
            Goal::PositionAndAxis => "On donne la position de l'organe terminal et la direction de son axe z",
        });
        let beside = given.joints.len();
        if beside > 0 {
            line = line.text(" et ").list(given.joints);
        }
        line = line.text(match (given.is_choice && beside > 0, beside) {
            (false, _) => "",
            (true, 1) => {
                " (une articulation en trop : toute valeur est permise, et la résolution est la plus courte avec celle-ci)"
            }
            (true, _) => {
                " (articulations en trop : toutes les valeurs sont permises, et la résolution est la plus courte avec \
                 celles-ci)"
            }
        });
        let line = line.text(" ; on cherche ").list(given.sought).text(". ");
        set(match given.is_whole {
            true => line.text("Avec ").math(Given::whole()).text(", la chaîne s'écrit"),
            false => line.text("Ce qui est constant aux deux extrémités passe du côté de la pose ; il reste"),
        })
    }

    fn given_columns(&self, has_axis: bool) -> &'static str {
        match has_axis {
            true => {
                "De U, seules les troisième et quatrième colonnes sont données ; les autres découlent de la solution."
            }
            false => "De U, seule la quatrième colonne est donnée ; les autres découlent de la solution.",
        }
    }

    fn short_names(&self, q: Expr, sum: Option<Expr>) -> Line {
        let line = Line::default().math(q.cos()).text(" et ").math(q.sin());
        let line = line.text(" sont le cosinus et le sinus de ").math(q);
        match sum {
            Some(sum) => line.text(", ").math(sum.cos()).text(" est le cosinus de ").math(sum).text("."),
            None => line.text("."),
        }
    }

    fn step_title(&self, number: usize, unknown: Line, values: usize, label: Option<Label>) -> Line {
        let mut line = Line::new(format!("Étape {number}. "));
        line.0.extend(unknown.0);
        let line = line.text(match values {
            1 => say!(" : une valeur"),
            n => say!(" : {n} valeurs"),
        });
        line.text(label.map(|l| format!(" ({})", self.label(l))).unwrap_or_default())
    }

    fn source(&self, source: &Source) -> Line {
        let (left, right) = source.product.clone();
        let mut line = Line::new(if source.inverse { "L'inverse des deux membres de " } else { "" });
        line = line.math(Math::Products(left, right)).text(", ");
        let [rows, columns] = source.rows_and_columns();
        let several = |all: &[usize], word: &str| {
            let names: Vec<String> = all.iter().map(|&n| ORDINALS[n.min(4)].to_string()).collect();
            format!("{} {word}{}", self.listed(&names), if all.len() == 1 { "" } else { "s" })
        };
        line = line.text(match (rows.len(), columns.len()) {
            (1, _) | (_, 1) => format!("{}, {}", several(&rows, "ligne"), several(&columns, "colonne")),
            _ => {
                let places: Vec<String> =
                    source.elements.iter().map(|(r, c)| format!("({r}, {c})")).collect();
                format!("éléments {}", self.listed(&places))
            }
        });
        let why = source.why.as_ref().map(|why| format!(" ({})", self.component(why)));
        set(line.text(why.unwrap_or_default()).text(" :"))
    }

    fn component(&self, component: &Component) -> String {
        let numbers = |all: &[usize]| self.numbers(all);
        let of = match (&component.of[..], component.is_point) {
            ([], _) => String::new(),
            ([axis], false) => format!(" de la direction de l'axe {}", axis + 1),
            (axes, false) => format!(" de la direction des axes {}", numbers(axes)),
            ([axis], true) => format!(" d'un point de l'axe {}", axis + 1),
            (axes, true) => format!(" d'un point commun aux axes {}", numbers(axes)),
        };
        let along = match &component.along[..] {
            [] => String::new(),
            [axis] => format!(" suivant l'axe {}", axis + 1),
            axes => format!(" suivant les axes parallèles {}", numbers(axes)),
        };
        let free = match &component.free[..] {
            [joint] => format!(" : indépendante de l'articulation {}", joint + 1),
            joints => format!(" : indépendante des articulations {}", numbers(joints)),
        };
        say!("une composante{of}{along}{free}")
    }

    fn elimination(&self, unknown: Expr, how: Elimination) -> Line {
        set(Line::default().math(unknown).text(match how {
            Elimination::Rotation => {
                " s'élimine en isolant ses termes dans les deux équations, puis en ajoutant leurs carrés : les facteurs de \
                 son cosinus et de son sinus sont ceux d'une rotation."
            }
            Elimination::Cramer => {
                " s'élimine en calculant son cosinus et son sinus par la règle de Cramer ; la somme de leurs carrés vaut 1."
            }
            Elimination::Displacement => {
                " s'élimine : on le tire d'une équation et on le reporte dans l'autre."
            }
        }))
    }

    fn names_follow(&self, is_beside: bool) -> String {
        if is_beside { "avec" } else { "Posons" }.into()
    }

    fn kind(&self, kind: Kind) -> String {
        printed(match kind {
            Kind::Displacement => "linéaire par rapport au déplacement",
            Kind::DisplacementSquared => "du second degré par rapport au déplacement",
            Kind::Quartic => "de degré 2 en cosinus et sinus : degré 4 en tan(θ/2)",
            Kind::Homogeneous => "linéaire en cosinus et sinus, sans second membre",
            Kind::Cosine => "un cosinus seul",
            Kind::Sine => "un sinus seul",
            Kind::Linear => "linéaire en cosinus et sinus",
            Kind::Pair => "deux équations linéaires en cosinus et sinus",
            Kind::Separate => "cosinus et sinus, chacun donné par sa propre équation",
        })
    }

    fn equation(&self, kind: Kind, is_squared: bool, form: &[Math], coefficients: &Coefficients) -> Line {
        let mut line = Line::new(match (kind.number(), is_squared) {
            ("none", _) => "Une équation ".to_string(),
            (n, true) => format!("Les carrés des deux membres, additionnés : type {n}, "),
            (n, false) => format!("Type {n}, "),
        });
        line = line.text(self.kind(kind));
        for (k, f) in form.iter().enumerate() {
            line = line.text(if k == 0 { " : " } else { " et " }).math(f.clone());
        }
        set(match coefficients {
            Coefficients::Below => line.text(" avec"),
            Coefficients::Here([]) => line.text(" ; d'où"),
            Coefficients::Here(all) => {
                line.text(" avec ").numbers(all.iter().cloned(), self.between()).text(" ; d'où")
            }
        })
    }

    fn so(&self) -> String {
        say!("d'où")
    }

    fn case(&self, case: &Case) -> Line {
        let mut line = Line::default();
        let between = if case.is_zeros() { " et " } else { " ou " };
        for (k, m) in case.when.iter().enumerate() {
            line = line.text(if k == 0 { "" } else { between }).math(m.clone());
        }
        let colon = if case.when.is_empty() { "" } else { " : " };
        set(line.text(colon).text(self.consequence(case.then)))
    }

    fn consequence(&self, consequence: Consequence) -> String {
        printed(match consequence {
            Consequence::NoSolution(bound) => nothing(bound),
            Consequence::Coincide => "les deux valeurs sont confondues (multiplicité 2)",
            Consequence::TwoValues(bound) => {
                return say!(
                    "deux valeurs, confondues en cas d'égalité (multiplicité 2, configuration singulière) ; sinon, {}",
                    nothing(bound)
                );
            }
            Consequence::OpenDisplacement => {
                "l'équation ne détermine pas le déplacement : si le second membre s'annule aussi, le déplacement est libre \
                 ou donné par une autre équation ; sinon, aucune solution"
            }
            Consequence::OpenAngle => {
                "l'équation laisse l'angle indéterminé : il est libre (le bras peut bouger sans quitter la \
                 cible) ou donné par une autre équation"
            }
            Consequence::OpenUnless => {
                "aucune solution, sauf si le second membre s'annule aussi : l'équation laisse alors l'articulation \
                 indéterminée"
            }
            Consequence::OpenJoint => {
                "si les seconds membres s'annulent aussi, l'articulation est libre ou donnée par une autre équation ; sinon, \
                 aucune solution"
            }
            Consequence::Roots => {
                "autant de valeurs que le polynôme a de racines réelles t = tan(θ/2) : 0, 2 ou 4 ; une racine double compte \
                 deux fois"
            }
            Consequence::HalfTurn => "une des racines est le demi-tour",
            Consequence::Free => "l'articulation est libre",
            Consequence::OneValue => "toujours une valeur et une seule",
            Consequence::OneEquation => {
                "les deux équations n'en font qu'une : deux valeurs, une articulation libre ou aucune solution ; le solveur \
                 retient la ligne de plus grande norme"
            }
        })
    }

    fn remark(&self, remark: Remark) -> String {
        printed(match remark {
            Remark::MayAdd => {
                "L'élimination peut ajouter des racines de cette seule équation ; le résidu de la pose les écarte."
            }
            Remark::SquaresAddNone => {
                "L'élévation au carré n'ajoute aucune racine : pour chaque valeur de l'inconnue, les composantes donnent la \
                 direction que les carrés avaient fait disparaître."
            }
            Remark::Whole => "Aucune équation n'est écartée, rien n'est élevé au carré.",
            Remark::AddsNone => "Aucune racine n'est ajoutée.",
        })
    }

    fn step_remark(&self, sign: Option<(Expr, Option<Label>)>, remark: Remark, used_by: &[usize]) -> Line {
        let mut line = Line::default();
        if let Some((sign, label)) = sign {
            line = line.math(Math::relation(sign, Sign::EitherSign, Expr::int(1)));
            if let Some(label) = label.map(|l| self.label(l)) {
                line = line.text(say!(" : {label}+ et {label}−"));
            }
            line = line.text(". ");
        }
        line.text(self.remark(remark)).text(match used_by {
            [] => " Ne sert à aucune étape suivante.".to_string(),
            [one] => say!(" Sert à l'étape {one}."),
            many => {
                let many: Vec<String> = many.iter().map(ToString::to_string).collect();
                format!(" Sert aux étapes {}.", self.listed(&many))
            }
        })
    }

    fn conditions_title(&self) -> String {
        "Ce que la pose doit vérifier".into()
    }

    fn conditions(&self, rank: usize, task: Option<Task>) -> String {
        let freedoms = counted(rank, "degré de liberté", "degrés de liberté");
        let told = task.map(|t| format!(" : on peut lui imposer {}", self.task(t))).unwrap_or_default();
        say!("L'organe terminal a {freedoms}{told}. Une pose accessible vérifie")
    }

    fn task(&self, task: Task) -> String {
        match task {
            Task::Pose => "une position et une orientation quelconques".into(),
            Task::PositionAndAxis => say!("une position et la direction de l'axe de l'outil"),
            Task::PositionAndTurn => {
                say!("une position et une rotation autour d'une direction (x, y, z, φ)")
            }
            Task::Planar => "une position et une rotation dans un plan (x, y, φ)".into(),
            Task::Position => "une position (x, y, z)".into(),
            Task::Orientation => "une orientation".into(),
            Task::Other(n) => format!("une pose prise dans un ensemble de dimension {n}"),
        }
    }

    fn solutions_title(&self, solutions: usize) -> String {
        match solutions {
            1 => "Une seule solution".into(),
            n => format!("Au plus {n} solutions"),
        }
    }

    fn solutions_product(&self, product: &str) -> String {
        say!("{product} branches :")
    }

    fn solutions_remark(&self) -> String {
        say!(
            "Chaque étape découle des équations qui la précèdent et en a toutes les racines : aucune solution n'est perdue. \
             Chaque solution est reportée dans la chaîne entière ; celles qui ne redonnent pas la pose sont écartées. \
             Les types sont numérotés d'après Khalil et Dombre ; les types 1, 2 et 3 sont ceux de Paul."
        )
    }

    fn ended_title(&self) -> String {
        say!("La résolution s'arrête ici")
    }

    fn ended(&self, has_found: bool, missing: Vec<Math>) -> Line {
        let line = Line::new(if has_found { "" } else { "Rien n'a été trouvé. " });
        let line = line.text(
            "Aucune équation de la chaîne, ni aucune des combinaisons de deux équations essayées, ne fournit, pour ",
        );
        set(line.list(missing).text(", d'équation à une seule inconnue de degré au plus 4 en tan(θ/2)."))
    }

    fn ended_remark(&self, surplus: usize) -> String {
        if surplus == 0 {
            return say!(
                "Il existe des formes explicites lorsque trois axes consécutifs sont concourants ou parallèles ; \
                 à défaut, le bras général a jusqu'à 16 solutions, racines d'un même polynôme de degré 16."
            );
        }
        say!(
            "Le bras a {} de plus que l'organe terminal ne peut en utiliser : avec d'autres articulations données, la \
             résolution peut aboutir.",
            counted(surplus, "articulation", "articulations")
        )
    }

    fn solution(&self, number: usize) -> String {
        format!("solution {number}")
    }

    fn legend(&self, proof: Proof) -> String {
        printed(match proof {
            Proof::Proved => {
                "✓ : démontré. Si l'on remplace U par A1·A2·…, les deux membres sont identiques, quelles que soient les \
                 valeurs articulaires et les longueurs."
            }
            Proof::Sampled => {
                "✓ : démontré. ≈ : vérifié seulement en des poses d'essai ; le développement est trop grand pour conclure."
            }
            Proof::Wrong => "Une formule ci-dessus est FAUSSE : c'est une erreur du programme.",
        })
    }

    fn unsuitable(&self, why: &Unsuitable) -> String {
        match why {
            Unsuitable::Helical(row) => {
                format!("la ligne {row} tourne et glisse à la fois (liaison hélicoïdale)")
            }
            Unsuitable::Coupling => {
                "les angles des lignes ne sont pas des sommes de multiples entiers d’autant d’entre eux qu’il y a de \
                 variables articulaires"
                    .into()
            }
            Unsuitable::NoJoint => say!("le robot n'a aucune articulation"),
            Unsuitable::TooLong(n) => {
                say!("le robot a {n} articulations ; les formes explicites sont cherchées jusqu'à {MAX_AXES}")
            }
        }
    }

    fn not_given(&self, why: NotGiven) -> String {
        match why {
            NotGiven::NoSuchJoint { joint, joints } => {
                say!("l'articulation {} est donnée, mais il n'y en a que {joints}", joint + 1)
            }
            NotGiven::NoSurplus => say!(
                "aucune articulation ne peut être donnée : le bras n'en a pas plus que son organe terminal ne peut en utiliser"
            ),
            NotGiven::TooMany { given, surplus } => say!(
                "{} {}, mais le bras n'en a que {surplus} en trop",
                counted(given, "articulation", "articulations"),
                if given < 2 { "donnée" } else { "données" }
            ),
        }
    }

    fn stuck(&self, stuck: &Stuck) -> String {
        let [found, missing] = [stuck.found(), stuck.open()].map(|all| all.join(", "));
        let found = if found.is_empty() { "rien".into() } else { found };
        if stuck.is_spent {
            say!(
                "pas de forme explicite dans la limite de calcul : trouvé jusqu'ici {found} ; reste {missing}"
            )
        } else {
            say!(
                "pas de forme explicite : trouvé {found} ; pour {missing}, il ne reste aucune équation de degré au plus 4 à \
                 une seule inconnue"
            )
        }
    }

    fn doubt(&self, doubt: Doubt) -> String {
        printed(match doubt {
            Doubt::Sampled => "certaines solutions ont été trouvées par essais",
            Doubt::DoubleRoot => "cas indécis au voisinage d'une racine double",
            Doubt::Uncounted => "les racines n'ont pas pu être comptées",
            Doubt::Searched => "solutions cherchées à partir de plusieurs configurations initiales",
            Doubt::OneAsked => "une seule solution était demandée",
            Doubt::Copies => {
                "les réducteurs répètent chaque configuration plus souvent par tour que la liste ne le montre"
            }
            Doubt::Digits => "le robot est si loin de l’origine que la pose a trop peu de chiffres",
        })
    }

    fn obstacle(&self, obstacle: &Obstacle) -> String {
        match &obstacle.unknown {
            Some(x) => say!("aucune branche ne donne de valeur à {x}"),
            None => say!("l'organe terminal ne peut pas prendre cette pose"),
        }
    }

    fn violated(&self, conditions: &[&str]) -> String {
        format!("une pose de ce bras vérifie {}", conditions.join(", "))
    }
}

fn nothing(bound: Bound) -> &'static str {
    match bound {
        Bound::Reach => "hors d'atteinte : aucune solution sur cette branche",
        Bound::Span => {
            "le bras est trop court, ou ne peut pas se replier autant : aucune solution sur cette branche"
        }
    }
}
