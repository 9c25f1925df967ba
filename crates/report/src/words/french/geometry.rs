//! Axes.

use super::{French, printed};
use crate::words::Geometry;
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
}
