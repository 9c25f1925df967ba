//! Jacobians and singularities.

use super::{French, printed};
use crate::tree::{Line, Math};
use crate::words::{Gain, Loss, Terms, Velocity};
use denavit::forward::{Proof, Reference};
use denavit::velocity::{Blocks, MAX_JOINTS, Obstacle, Place, Still};
use denavit_program::Count;
use denavit_symbolic::Refusal;

impl Velocity for French {
    fn jacobian_title(&self, robot: &str) -> String {
        say!("Jacobienne : {robot}")
    }

    fn viewpoint(&self, body: Reference, at: Reference, offset: Option<[Math; 3]>, axes: Reference) -> Line {
        let [body, at, axes] = [body, at, axes].map(|frame| self.of_frame(frame));
        let mut line = Line::new(say!(
            "D'abord les lignes de la vitesse linéaire, celle du point {body} situé à l'origine {at}"
        ));
        if let Some(offset) = offset {
            line = line.text(" décalée de (").numbers(offset, self.between()).text(")");
        }
        line.text(format!(", puis celles de la vitesse angulaire, suivant les axes {axes}."))
    }

    fn no_entries(&self, why: Refusal) -> String {
        say!("Les éléments ne sont pas développés : {}.", self.unexpanded(why))
    }

    fn jacobian_cost(&self, count: &Count, proof: Proof) -> String {
        say!("{} ; {}.", self.count(count), self.jacobian_proof(proof))
    }

    fn shortest(&self) -> String {
        say!(
            "C'est dans ce repère et en ce point que la matrice est la plus courte. Le torseur cinématique suivant d'autres \
             axes, ou en un autre point du même corps, s'en déduit par une rotation et un bras de levier, qui laissent le \
             déterminant inchangé."
        )
    }

    fn shortest_title(&self) -> String {
        say!("Là où elle est la plus courte")
    }

    fn determinant_title(&self) -> String {
        "Déterminant".into()
    }

    fn several_determinants(&self, has_surplus: bool, directions: usize) -> String {
        let number = if directions == 3 { "trois" } else { "six" };
        match has_surplus {
            true => say!(
                "Il y a plus d'articulations que de directions : le bras est singulier là où les déterminants de tous les \
                 choix de {number} articulations sont nuls."
            ),
            false => say!(
                "Il y a moins d'articulations que de directions : le bras est singulier là où les déterminants de tous les \
                 choix de lignes sont nuls. Ceux qui sont nuls partout sont omis."
            ),
        }
    }

    fn minor_of_joints(&self, joints: &[usize]) -> String {
        say!("Articulations {} :", plain(joints))
    }

    fn always_singular(&self, rank: usize, is_point: bool) -> String {
        let thing = if is_point { "au point" } else { "à l'organe terminal" };
        say!(
            "Le rang vaut au plus {rank} : dans toutes les configurations, il manque une direction {thing}, et des \
             articulations peuvent bouger sans qu'il bouge. Le rang est encore plus petit là où les déterminants de tous les choix \
             de {rank} lignes et {rank} articulations sont nuls. Ceux qui sont nuls partout ne sont pas écrits."
        )
    }

    fn minor_of_both(&self, rows: &[&str], joints: &[usize]) -> String {
        say!("Lignes {}, articulations {} :", rows.join(", "), plain(joints))
    }

    fn minor_of_rows(&self, rows: &[&str]) -> String {
        say!("Lignes {} :", rows.join(", "))
    }

    fn singularities_title(&self) -> String {
        "Singularités".into()
    }

    fn no_singularity(&self, is_complete: bool, several: bool) -> String {
        printed(match (is_complete, several) {
            (true, false) => "Il n'y en a pas : le déterminant ne s'annule jamais.",
            (true, true) => "Il n'y en a pas : les déterminants ne s'annulent jamais tous à la fois.",
            (false, _) => "Aucun facteur dépendant des articulations n'est commun à tous les déterminants.",
        })
    }

    fn besides(&self) -> String {
        say!("De plus, le bras est singulier là où tous les déterminants ci-dessus s'annulent à la fois.")
    }

    fn besides_where(&self) -> String {
        say!(
            "Les déterminants sont aussi nuls tous à la fois là où tout ce qui est écrit sur une de ces lignes est nul, et nulle \
             part ailleurs :"
        )
    }

    fn point_title(&self) -> String {
        "La position seule".into()
    }

    fn point_alone(&self, at: Reference, axes: Reference) -> Line {
        let [at, axes] = [at, axes].map(|frame| self.of_frame(frame));
        Line::new(say!(
            "Ci-dessus, le corps est considéré avec son orientation. La vitesse de l'origine {at} seule, suivant les axes {axes}, \
             est donnée par trois lignes :"
        ))
    }

    fn zeros(&self, all: Vec<Math>) -> Line {
        let mut line = Line::new("où ");
        for (k, math) in all.into_iter().enumerate() {
            line = line.text(if k > 0 { " ou " } else { "" }).math(math);
        }
        line
    }

    fn no_example(&self, assumes: bool) -> String {
        match assumes {
            true => say!(
                "aucune configuration n'a été trouvée où ce facteur s'annule seul, avec les longueurs supposées ici"
            ),
            false => say!("aucune configuration n'a été trouvée où ce facteur s'annule seul"),
        }
    }

    fn place(&self, place: &Place) -> String {
        let numbers = |joints: &[usize]| self.numbers(joints);
        match place {
            Place::OneLine(i, j) => {
                say!("les axes {} et {} sont sur une même droite", i + 1, j + 1)
            }
            Place::OnePlane(axes) => {
                say!("les axes parallèles {} sont dans un même plan : bras tendu ou replié", numbers(axes))
            }
            Place::CentreOnAxis { wrist, axis } => {
                say!("le point de concours des axes {} est sur l'axe {}", numbers(wrist), axis + 1)
            }
            Place::CentreInPlane { wrist, axes, parallel } => {
                let (wrist, axes) = (numbers(wrist), numbers(axes));
                let bent = if *parallel { " : bras tendu ou replié" } else { "" };
                say!("le point de concours des axes {wrist} est dans le plan des axes {axes}{bent}")
            }
            Place::Parallel(axes) => format!("les axes {} sont parallèles", numbers(axes)),
            Place::Line { meets, parallel } => {
                let met = match &meets[..] {
                    [axis] => format!("l'axe {}", axis + 1),
                    axes => format!("les axes {}", numbers(axes)),
                };
                let along = match &parallel[..] {
                    [] => String::new(),
                    [axis] => format!(" et est parallèle à l'axe {}", axis + 1),
                    axes => format!(" et est parallèle aux axes {}", numbers(axes)),
                };
                say!("une droite rencontre {met}{along}")
            }
            Place::PointOnAxis(axis) => say!("le point est sur l'axe {}", axis + 1),
            Place::PointInPlane { axes, parallel } => {
                let bent = if *parallel { " : bras tendu ou replié" } else { "" };
                say!("le point est dans le plan des axes {}{bent}", numbers(axes))
            }
            Place::SelfMotion { joints, still } => match &joints[..] {
                [j] => say!("l'articulation {} ne fait pas bouger {}", j + 1, still_thing(*still)),
                joints => format!(
                    "les articulations {} ont ensemble des vitesses pour lesquelles {} est au repos",
                    numbers(joints),
                    still_thing(*still)
                ),
            },
            Place::Differs => say!("la position des axes diffère d'un endroit à l'autre"),
            Place::Lost => "les articulations présentes ont une direction de moins".into(),
        }
    }

    fn lost(&self, loss: Loss) -> String {
        printed(match loss {
            Loss::VelocityAlong(axis, frame) => {
                return say!("perdue : la vitesse suivant l'axe {axis} {}", self.of_frame(frame));
            }
            Loss::RotationAbout(axis, frame) => {
                return say!("perdue : la rotation autour de l'axe {axis} {}", self.of_frame(frame));
            }
            Loss::Velocity => "perdue : une vitesse du point, dans une direction",
            Loss::Rotation => "perdue : une rotation, autour d'une direction",
            Loss::Screw => "perdu : un torseur cinématique (translation et rotation combinées)",
        })
    }

    fn gained(&self, gain: &Gain) -> String {
        match gain {
            Gain::Turns { joints: [i, j], is_same } => {
                let way = if *is_same { "dans le même sens" } else { "en sens contraires" };
                let (i, j) = (i + 1, j + 1);
                say!("gagné : les articulations {i} et {j} tournent {way}, le corps restant immobile")
            }
            Gain::Moves(joints, still) => {
                let all = plain(joints);
                let who = match joints.len() {
                    1 => format!("l'articulation {all} bouge"),
                    _ => format!("les articulations {all} bougent"),
                };
                say!("gagné : au premier ordre, {who}, {} restant immobile", still_thing(*still))
            }
        }
    }

    fn rates_title(&self) -> String {
        "Vitesses articulaires pour un torseur cinématique donné".into()
    }

    fn rates(&self, blocks: Blocks) -> String {
        printed(match blocks {
            Blocks::Point => {
                "Les lignes de la vitesse linéaire donnent les vitesses des trois articulations."
            }
            Blocks::Rows => {
                "Des lignes qui contiennent autant d'articulations inconnues qu'il y a de lignes donnent ces articulations, un bloc \
                 après l'autre. ux à rz sont ce que les articulations déjà connues laissent de vx à wz."
            }
            Blocks::Wrist => {
                "Les trois dernières articulations ne déplacent pas le point : les lignes de la vitesse linéaire donnent les \
                 vitesses des trois premières. rx, ry et rz sont ce que celles-ci laissent de la vitesse angulaire aux \
                 autres."
            }
        })
    }

    fn different(&self, all: Vec<Math>) -> Line {
        Line::new("pour ").list(all)
    }

    fn unknown_singularities(&self, why: &Obstacle) -> String {
        match why {
            Obstacle::TooLarge(why) => {
                say!("le déterminant n'est pas développé : {}", self.unexpanded(*why))
            }
            Obstacle::ManyJoints(n) => {
                say!("{n} articulations sont trop : les mineurs sont développés jusqu'à {MAX_JOINTS}")
            }
            Obstacle::AlwaysSingular(rank) => {
                say!("toutes les configurations sont singulières : le rang vaut au plus {rank}")
            }
        }
    }

    fn motion(&self, all: Vec<Math>) -> Line {
        Line::new("dans le rapport ").numbers(all, self.between())
    }

    fn values_missing(&self, parameters: Vec<Math>) -> Line {
        let has = if parameters.len() == 1 { " n’a" } else { " n’ont" };
        Line::default()
            .list(parameters)
            .text(has)
            .text(" pas de valeur\u{a0}: les configurations singulières n’ont pas été cherchées en nombres.")
    }

    fn found_singularities(&self, count: usize) -> String {
        match count {
            0 => say!(
                "Aucune descente de la plus petite valeur singulière n'a trouvé de configuration singulière."
            ),
            _ => say!(
                "En nombres, des descentes de la plus petite valeur singulière ont mené à ces configurations singulières, \
                 une de chaque sorte trouvée. Il y en a d'autres près de chacune, et il peut y en avoir d'autres sortes."
            ),
        }
    }
}

/// What stands still.
fn still_thing(still: Still) -> &'static str {
    match still {
        Still::Body => "le corps",
        Still::Point => "le point",
    }
}

/// Numbers from 0, shown from 1, with commas alone.
fn plain(joints: &[usize]) -> String {
    joints.iter().map(|j| (j + 1).to_string()).collect::<Vec<_>>().join(", ")
}
