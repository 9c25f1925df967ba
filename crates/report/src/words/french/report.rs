//! The sections of a report.

use super::{French, counted, printed, set};
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

impl Report for French {
    fn title(&self, robot: &str) -> String {
        say!("Modélisation géométrique et cinématique : {robot}")
    }

    fn of_the_position(&self, said: &str) -> String {
        say!("La position seule : {said}")
    }

    fn compared(&self, robots: &[&str]) -> String {
        say!("Comparaison : {}", self.listed(&robots.iter().map(ToString::to_string).collect::<Vec<_>>()))
    }

    fn beside_each_other(&self, have_one_scale: bool) -> [&'static str; 2] {
        let pictures = match have_one_scale {
            true => "Les robots à la même échelle.",
            false => "Les robots, chacun aussi grand que son image le permet.",
        };
        ["Les robots en bref.", pictures]
    }

    fn heading(&self, heading: Heading) -> String {
        printed(match heading {
            Heading::Arm => "Le bras",
            Heading::Arms => "Les bras",
            Heading::Table => "Paramètres de Denavit–Hartenberg",
            Heading::Links => "Matrices de passage",
            Heading::Algorithm => "Algorithme",
            Heading::Example => "Exemple numérique",
            Heading::Inverse => "Modèle géométrique inverse",
            Heading::Solutions => "Les solutions de l'exemple",
            Heading::Velocity => "Jacobienne et singularités",
            Heading::Dynamics => "Modèle dynamique",
            Heading::Workspace => "Espace de travail",
            Heading::Errata => "Errata",
            Heading::References => "Références",
        })
    }

    fn glance(&self, glance: Glance) -> String {
        match glance {
            Glance::Structure => "Structure",
            Glance::Convention => "Convention",
            Glance::Source => "Source",
            Glance::Forward => "Modèle direct",
            Glance::Inverse => "Modèle inverse",
            Glance::Singularities => "Singularités",
        }
        .into()
    }

    fn column(&self, column: Column) -> String {
        match column {
            Column::Joint => "liaison",
            Column::Torque => "couple de maintien",
            Column::Inertia => "inertie",
            Column::Name => "nom",
            Column::Limits => "butées",
            Column::Branch => "branche",
            Column::Step => "étape",
            Column::Value => "valeur",
        }
        .into()
    }

    fn caption(&self, caption: Caption) -> String {
        printed(match caption {
            Caption::AtRest => {
                "Ce qui maintient le bras au repos contre la pesanteur, et l'inertie que voit chaque liaison seule, à"
            }
            Caption::Steps => "Les étapes de l'algorithme direct en nombres ; longueurs en mètres.",
            Caption::Configurations => "Toutes les configurations qui donnent cette pose.",
            Caption::Picture => "La configuration du tableau.",
            Caption::Pictures => "Les configurations du tableau, toutes avec la même pose de l'outil.",
            Caption::Singular => "Une configuration à chaque singularité ; les axes en cause sont marqués.",
            Caption::Scheme => "Schéma cinématique : axes des articulations, variables et longueurs.",
        })
    }

    fn table(&self) -> &'static str {
        "Tableau"
    }

    fn figure(&self) -> &'static str {
        "Figure"
    }

    fn contents(&self) -> &'static str {
        "Sommaire"
    }

    fn turning(&self) -> [&'static str; 2] {
        ["Étape précédente", "Étape suivante"]
    }

    fn formula(&self) -> &'static str {
        "formule"
    }

    fn picture(&self, own: &str, whole: &str) -> String {
        format!("{own}\u{a0}: {whole}")
    }

    fn arm_picture(&self, is_scheme: bool, robot: &str, joints: &str) -> String {
        let what = if is_scheme { "Schéma cinématique" } else { "Vue" };
        say!("{what} : {robot}, liaisons {joints} de la base à l'organe terminal")
    }

    fn workspace_picture(&self, plane: &Plane, [[a, b], [c, d]]: [[String; 2]; 2]) -> String {
        let [u, v] = plane.symbols();
        let what = match plane {
            Plane::ThroughAxis { joint, .. } => format!(
                "demi-plan de l'axe {} (à la distance {u} de l'axe, à la hauteur {v} le long de l'axe)",
                joint + 1
            ),
            Plane::Plane { .. } => format!("plan {u}–{v}, dans lequel le bras se déplace"),
            Plane::Projection { .. } => format!("projection sur le plan {u}–{v}"),
        };
        let [a, b, c, d] = [a, b, c, d].map(|x| self.written(x));
        say!(
            "Coupe de l'espace de travail, {what} : {u} de {a} à {b} m, {v} de {c} à {d} m ; couleurs selon la \
             manipulabilité, de maximum 1"
        )
    }

    fn curves_picture(&self, title: &str, names: &[String]) -> String {
        say!("{title} : {} en fonction de l'abscisse", names.join(", "))
    }

    fn assumed_lengths(&self) -> String {
        say!("Certaines longueurs n'ont pas de valeur. Les figures et les nombres supposent ")
    }

    fn structure(&self, structure: &Structure) -> String {
        let kind = |k: &JointKind| if *k == JointKind::Revolute { 'R' } else { 'P' };
        let kinds: String = structure.joints.iter().map(kind).collect();
        let n = kinds.len();
        let joints = counted(n, "articulation", "articulations");
        let mut text = format!("{kinds}, {joints} ; {}", structure.schematic());
        let numbers = |all: &[usize]| self.listed(&all.iter().map(ToString::to_string).collect::<Vec<_>>());
        for run in &structure.parallel {
            text += &format!(" ; axes {} parallèles", numbers(run));
        }
        for &first in &structure.spherical {
            let what = if first + 2 == n { "poignet sphérique" } else { "rotule" };
            text += &format!(" ; axes {} concourants ({what})", numbers(&[first, first + 1, first + 2]));
        }
        for (k, _) in structure.relations.iter().enumerate().filter(|r| *r.1 == Relation::Coincident) {
            text += &format!(" ; axes {} et {} confondus", k + 1, k + 2);
        }
        printed(&(text + "."))
    }

    fn convention(&self, convention: Convention) -> String {
        printed(match convention {
            Convention::Standard => {
                "Denavit–Hartenberg standard : Rot(z, θ) Trans(z, d) Trans(x, a) Rot(x, α)."
            }
            Convention::Craig => {
                "Denavit–Hartenberg modifié (Craig) : Rot(x, α) Trans(x, a) Rot(z, θ) Trans(z, d)."
            }
            Convention::Khalil => "Khalil–Kleinfinger : Rot(x, α) Trans(x, d) Rot(z, θ) Trans(z, r).",
        })
    }

    fn forward_cost(&self, count: &Count, proof: Proof) -> String {
        say!("{} ; {}.", self.count(count), self.forward_proof(proof))
    }

    fn closed_form(&self, solutions: usize, given: &[String]) -> String {
        let count = match solutions {
            1 => "une solution".into(),
            n => format!("au plus {n} solutions"),
        };
        match given {
            [] => format!("forme explicite, {count}."),
            _ => format!("forme explicite, {count}, pour chaque valeur de {}.", given.join(", ")),
        }
    }

    fn no_closed_form(&self, by_elimination: bool) -> String {
        printed(match by_elimination {
            true => "pas de forme explicite ; toutes les solutions, 16 au plus, par élimination.",
            false => "pas de forme explicite ; par calcul numérique.",
        })
    }

    fn factors(&self, factors: Factors) -> Line {
        set(Line::new(match factors {
            Factors::None => "aucune.",
            Factors::NotShared => {
                "là où tous les déterminants de la section sur la jacobienne s'annulent à la fois ; ils n'ont aucun facteur \
                 commun."
            }
            Factors::Long => "facteurs du déterminant trop longs pour un résumé.",
            Factors::Everywhere => "le bras a partout moins de six degrés de liberté.",
            Factors::TooLarge => "expressions trop grandes pour être développées.",
            Factors::Shared(all, is_complete) => {
                let mut line = Line::default();
                for (k, math) in all.into_iter().enumerate() {
                    line = line.text(if k > 0 { " ; " } else { "" }).math(math);
                }
                return set(line.text(match is_complete {
                    true => ".",
                    false => {
                        ", et là où tous les déterminants de la section sur la jacobienne s'annulent à la fois."
                    }
                }));
            }
        }))
    }

    fn arm_caption(&self, configuration: Line) -> Line {
        let mut line = Line::new("Le bras, ses repères et ses longueurs, pour ");
        line.0.extend(configuration.0);
        line.text(say!(". Un cylindre tourne, une boîte coulisse ; axes x en rouge, axes z en bleu."))
    }

    fn converted(&self, convention: Convention) -> String {
        match convention {
            Convention::Standard => "Dans la convention standard",
            Convention::Craig => "Dans la convention de Craig",
            Convention::Khalil => "Dans la convention de Khalil et Kleinfinger",
        }
        .into()
    }

    fn same_pose(&self, is_proved: bool) -> String {
        printed(match is_proved {
            true => {
                "Démontré : les deux tableaux donnent la même pose de l'outil, quelles que soient les variables et les \
                 longueurs."
            }
            false => "L'égalité des poses n'est pas démontrée : le développement est trop grand.",
        })
    }

    fn parameter(&self, is_angle: bool, axis: char, frame: &str) -> String {
        let (what, how) = if is_angle { ("angle", "autour de") } else { ("distance", "le long de") };
        let other = if axis == 'z' { 'x' } else { 'z' };
        say!(
            " : {what} de l'axe {other} du repère j−1 à celui du repère j, {how} l'axe {axis} du repère {frame}"
        )
    }

    fn parameters(&self, convention: Convention) -> String {
        let convention = match convention {
            Convention::Standard => "standard",
            Convention::Craig => "modifiée de Craig",
            Convention::Khalil => "de Khalil et Kleinfinger",
        };
        say!("Paramètres dans la convention {convention} ; longueurs en mètres.")
    }

    fn base_stands(&self) -> String {
        "Le repère 0 est placé dans la base par".into()
    }

    fn tool_stands(&self) -> String {
        say!("L'outil est placé dans le dernier repère par")
    }

    fn base(&self) -> String {
        "base".into()
    }

    fn tool(&self) -> String {
        "outil".into()
    }

    fn values(&self) -> String {
        say!("Valeurs : ")
    }

    fn row_transform(&self) -> String {
        say!("La matrice de passage d'une ligne du tableau est")
    }

    fn row_by_row(&self) -> String {
        "et donc, ligne par ligne,".into()
    }

    fn forward_title(&self) -> String {
        "Modèle géométrique direct ".into()
    }

    fn image_title(&self, is_point: bool) -> String {
        match is_point {
            true => say!("Un point dans l'autre repère"),
            false => say!("Un vecteur libre dans l'autre repère"),
        }
    }

    fn image(&self, is_point: bool, of: [Math; 3], from: &str, to: &str) -> Line {
        let (what, how) = match is_point {
            true => ("Le point", "il tourne et se déplace (quatrième coordonnée 1)"),
            false => ("Le vecteur", "il tourne sans se déplacer (quatrième coordonnée 0)"),
        };
        let line = Line::new(format!("{what} (")).numbers(of, self.between());
        line.text(say!(") du repère {to} a dans le repère {from} ces coordonnées : {how}."))
    }

    fn long_matrix(&self) -> String {
        say!(
            "Les éléments de la matrice sont trop longs pour être imprimés ; l'algorithme ci-dessous les calcule."
        )
    }

    fn no_matrix(&self, why: Unexpanded) -> String {
        say!("La matrice n'est pas développée : {}.", self.unexpanded(why))
    }

    fn shortest_program(&self) -> String {
        say!("Le même modèle, par le programme le plus court trouvé :")
    }

    fn names(&self, all: Vec<Names>) -> Line {
        let mut line = Line::default();
        for (k, one) in all.into_iter().enumerate() {
            line = line.text(if k > 0 { " ; " } else { "" }).list(one.names);
            line = line.text(match (one.has_cosine, one.has_sine) {
                (true, false) => " : cosinus de ",
                (true, true) => " : cosinus et sinus de ",
                (false, _) => " : sinus de ",
            });
            line = line.math(one.angle);
        }
        if line.0.is_empty() { line } else { set(line.text(".")) }
    }

    fn counting_rule(&self) -> String {
        say!(
            "On compte chaque multiplication et chaque addition dont le résultat dépend d'une variable ; les signes ne \
             comptent pas ; le sinus et le cosinus d'un même angle forment une paire ; une constante ajoutée à une \
             variable (son décalage) et ce qui ne dépend que des paramètres sont comptés à part."
        )
    }

    fn example(&self, configuration: Line) -> Line {
        let mut line = Line::new("Avec ");
        line.0.extend(configuration.0);
        line.text(say!(" les étapes de l'algorithme donnent, l'une après l'autre,"))
    }

    fn example_pose(&self) -> String {
        say!("et la pose de l'outil dans la base est")
    }

    fn orientation(&self, rpy: &str, zyz: &str) -> String {
        say!(
            "Son orientation : roulis, tangage, lacet {rpy} (autour des axes fixes x, y, z) ; angles d'Euler ZYZ {zyz}."
        )
    }

    fn difference(&self, by: &str) -> String {
        format!("Le produit numérique des matrices de passage en diffère de {by} au plus.")
    }

    fn refused(&self, why: &Refusal) -> String {
        say!("Il n'y a pas de forme explicite : {}.", self.refusal(why))
    }

    fn long_formula(&self) -> String {
        say!(
            "Ici se trouve une formule trop longue pour être imprimée ; l'option `--json` de la commande la donne."
        )
    }

    fn pose_at(&self, configuration: Line) -> Line {
        let mut line = Line::new(say!("La pose de l'outil pour "));
        line.0.extend(configuration.0);
        line.text(" est")
    }

    fn given_values(&self, values: Line) -> Line {
        let mut line = Line::new("Avec ");
        line.0.extend(values.0);
        line.text(say!(" donné :"))
    }

    fn no_solution(&self) -> String {
        say!("Aucune solution n'a été trouvée numériquement.")
    }

    fn found(&self, isolated: usize, families: usize, is_complete: bool) -> String {
        let mut text = counted(isolated, "solution isolée", "solutions isolées");
        if families > 0 {
            let families = counted(
                families,
                "famille dans laquelle le bras bouge sans que la main bouge",
                "familles dans lesquelles le bras bouge sans que la main bouge",
            );
            text += &format!(" et {families} (marquées * : un membre de chacune est montré)");
        }
        text += match is_complete {
            true if isolated + families == 1 => {
                " ; il n'y en a pas d'autre. Elle a été reportée dans la chaîne."
            }
            true => " ; il n'y en a pas d'autres. Chacune a été reportée dans la chaîne.",
            false => " ; il peut en exister d'autres.",
        };
        printed(&text)
    }

    fn first_of_them(&self, shown: usize) -> String {
        format!("Seules les {shown} premières sont montrées.")
    }

    fn within_limits(&self, is_within: bool) -> String {
        if is_within { "respectées" } else { "dépassées" }.into()
    }

    fn reach(&self, first: (&str, &str), second: (&str, &str), from_shoulder: Option<&str>) -> String {
        let ((u, x), (v, y)) = (first, second);
        let far = from_shoulder.map(|d| format!(" ; sa plus grande distance à l'épaule est {d}"));
        say!(
            "Dans les butées des articulations, le point de l'outil atteint {u} = {x} et {v} = {y}{}.",
            far.unwrap_or_default()
        )
    }

    fn full_turns(&self) -> String {
        say!(" Une articulation rotoïde sans butées tourne d'un tour complet.")
    }

    fn assumed_travel(&self) -> String {
        say!(" Course supposée : ")
    }

    fn held(&self) -> String {
        say!(" Fixé : ")
    }

    fn workspace(&self, plane: &Plane, [u, v]: [&str; 2], has_arm: bool) -> String {
        let text = match plane {
            Plane::ThroughAxis { joint, .. } => format!(
                "Ce que le point de l'outil atteint, dans le demi-plan de l'axe {} (distance {u}, hauteur {v}). \
                 Couleurs : la plus grande manipulabilité √det(J Jᵀ) de sa vitesse trouvée à cet endroit, rapportée au \
                 maximum.",
                joint + 1
            ),
            Plane::Plane { .. } => format!(
                "Ce que le point de l'outil atteint, dans son plan ({u}, {v}). Couleurs : la plus grande manipulabilité \
                 de sa vitesse trouvée à cet endroit, rapportée au maximum."
            ),
            Plane::Projection { .. } => format!(
                "Ce que le point de l'outil atteint, en projection sur le plan ({u}, {v}). Couleurs : la plus grande \
                 manipulabilité de sa vitesse trouvée à cet endroit, rapportée au maximum."
            ),
        };
        printed(&(text + if has_arm { " La ligne est le bras de l'exemple." } else { "" }))
    }

    fn claims(&self, name: &str, claims: usize, s: Standings) -> String {
        let all = [
            (s.equal, ["démontrée", "démontrées"]),
            (s.wrong, ["fausse", "fausses"]),
            (s.conditional, ["juste sous condition", "justes sous condition"]),
            (s.carried, ["due à une erreur précédente", "dues à une erreur précédente"]),
            (s.undecided, ["indécise", "indécises"]),
            (s.unreadable, ["illisible", "illisibles"]),
        ];
        let parts = all.into_iter().filter(|(n, _)| *n > 0).map(|(n, [one, many])| counted(n, one, many));
        let parts = self.listed(&parts.collect::<Vec<_>>());
        let unjudged = match s.unjudged {
            0 => String::new(),
            n => say!(" Non jugé : {}.", counted(n, "autre ligne", "autres lignes")),
        };
        say!("{name} énonce {claims} formules : {parts}.{unjudged}")
    }

    fn cause(&self, [right, wrong, still]: [usize; 3]) -> String {
        let [right, wrong] = [counted(right, "juste", "justes"), counted(wrong, "fausse", "fausses")];
        let still = counted(still, "resterait fausse", "resteraient fausses");
        say!(" en rendrait {right} et {wrong} ; {still}.")
    }

    fn list(&self, list: List) -> String {
        match list {
            List::Wrong => "Faux",
            List::Conditional => "Juste sous condition",
            List::Open => "Indécis ou illisible",
            List::Unjudged => "Non jugé",
        }
        .into()
    }

    fn more(&self, number: usize) -> String {
        let them = if number == 1 { "la" } else { "les" };
        say!("Et {} ; `denavit check` {them} donne.", counted(number, "autre", "autres"))
    }

    fn printed(&self, line: usize, formula: &str) -> String {
        say!(", ligne {line} : {formula}")
    }

    fn right(&self) -> String {
        say!(" ; juste : ")
    }

    fn robot(&self) -> String {
        say!("Le robot : ")
    }

    fn made_by(&self, version: &str) -> String {
        format!("Établi, démontré et imprimé par denavit {version}.")
    }
}
