//! Axes and tables.

use super::{French, printed};
use crate::words::geometry::{Given, Whole};
use crate::words::{Geometry, Terms};
use denavit::description::{Agreement, Chain, Mechanism, Moved, Part};
use denavit::idealise::Measured;
use denavit::structure::{NearlySpecial, Relation, Special};

impl Geometry for French {
    fn relation(&self, relation: Relation) -> String {
        match relation {
            Relation::Coincident => "sont confondus",
            Relation::Parallel => "sont parallèles",
            Relation::MeetPerpendicular => "se coupent à angle droit",
            Relation::Meet => "se coupent",
            Relation::Perpendicular => "sont orthogonaux, à distance",
            Relation::Skew => "sont gauches",
            Relation::PerpendicularDirections => "sont orthogonaux",
            Relation::ObliqueDirections => "sont obliques",
        }
        .into()
    }

    fn nearly(&self, near: &NearlySpecial) -> String {
        let unit = if near.is_angle { "rad" } else { "m" };
        let (first, second) = near.joints;
        let what = match near.nearly {
            Special::Coincident => "confondus",
            Special::Parallel => "parallèles",
            Special::Perpendicular => "orthogonaux",
            Special::Meeting => "concourants",
        };
        let by = self.written(format!("{:.3e}", near.by));
        say!("les axes {first} et {second} sont presque {what} : à {by} {unit} près")
    }

    fn measured(&self, what: Measured) -> String {
        printed(match what {
            Measured::Angle => "angle α",
            Measured::Normal => "perpendiculaire commune a",
            Measured::Offset => "décalage d",
            Measured::Turn => "angle θ",
        })
    }

    fn moved(&self, all: &[Moved]) -> String {
        if all.is_empty() {
            return say!("la base et l'outil sont inchangés");
        }
        let one = |moved: &Moved| match moved {
            Moved::BranchToBase => "γ1 et b1 passent dans la base".into(),
            Moved::BranchToRow(row) => format!("γ{0} et b{0} passent dans la ligne {1}", row + 2, row + 1),
            Moved::FirstToBase => {
                "α et la longueur suivant x de la première ligne passent dans la base".into()
            }
            Moved::LastToTool => {
                say!("α et la longueur suivant x de la dernière ligne passent dans l'outil")
            }
        };
        let all = all.iter().map(one).collect::<Vec<String>>().join(" ; ");
        printed(&all)
    }

    fn agreement(&self, agreement: Agreement, of: Whole) -> String {
        let whole = match of {
            Whole::File => "du fichier",
            Whole::Tree => "de l’arbre",
        };
        match agreement {
            Agreement::Proved => {
                format!("il est prouvé que son tableau est la chaîne {whole}, telle qu’elle est lue")
            }
            Agreement::Within(by) if by < 1e-50 => {
                format!("son tableau est la chaîne {whole} à 60 chiffres près")
            }
            Agreement::Within(by) => format!("son tableau est la chaîne {whole} à {by:.0e} près"),
        }
    }

    fn chain(&self, chain: &Chain, mechanism: &Mechanism) -> String {
        let Given { ends: [from, to], joints, limited, heavy, links, follows } = Given::of(chain, mechanism);
        let agreement = self.agreement(chain.agreement, Whole::File);
        let follows = follows.map_or(String::new(), |name| {
            format!(" ; ce que suit `{name}` n’est pas sur le chemin, elle bouge d’elle-même")
        });
        let limits = match limited {
            0 => "aucune butée".to_string(),
            _ if limited == joints => "des butées pour toutes".into(),
            _ => format!("des butées pour {limited}"),
        };
        let inertias = match heavy {
            0 => "aucune inertie".to_string(),
            _ => format!("des inerties pour {heavy} corps sur {links}, que portent ses lignes"),
        };
        let plural = if joints == 1 { "" } else { "s" };
        printed(&format!(
            "de `{from}` à `{to}`, {joints} articulation{plural} ; {agreement}{follows}. Le fichier donne {limits}, {inertias}"
        ))
    }

    fn left_part(&self, part: Part) -> &'static str {
        match part {
            Part::Names => "noms des articulations",
            Part::Limits => "butées",
            Part::Velocities => "limites de vitesse",
            Part::Accelerations => "limites d’accélération",
            Part::Efforts => "limites de couple et de force",
            Part::Poses => "poses nommées",
            Part::Masses => "masses",
            Part::Rotors => "rotors",
            Part::Friction => "frottement",
            Part::Gravity => "gravité",
        }
    }

    fn read_apart(&self, metres: f64) -> String {
        let micrometres = self.written(format!("{:.3}", metres * 1e6));
        printed(&format!(
            "ainsi lus, les corps se trouvent jusqu’à {micrometres} µm d’où les mettent les décimales telles qu’elles sont écrites, dans les configurations essayées"
        ))
    }
}
