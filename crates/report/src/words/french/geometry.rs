//! Axes and tables.

use super::{French, printed};
use crate::words::Geometry;
use denavit::description::Moved;
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
        say!("les axes {first} et {second} sont presque {what} : à {:.3e} {unit} près", near.by)
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
}
