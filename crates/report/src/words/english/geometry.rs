//! Axes and tables.

use super::English;
use crate::words::Geometry;
use denavit::description::Moved;
use denavit::idealise::Measured;
use denavit::structure::{NearlySpecial, Relation};

impl Geometry for English {
    fn relation(&self, relation: Relation) -> String {
        match relation {
            Relation::Coincident => "coincide",
            Relation::Parallel => "are parallel",
            Relation::MeetPerpendicular => "meet at a right angle",
            Relation::Meet => "meet",
            Relation::Perpendicular => "are perpendicular, at a distance",
            Relation::Skew => "are skew",
            Relation::PerpendicularDirections => "are perpendicular",
            Relation::ObliqueDirections => "are oblique",
        }
        .into()
    }

    fn nearly(&self, near: &NearlySpecial) -> String {
        let unit = if near.is_angle { "rad" } else { "m" };
        let (first, second) = near.joints;
        format!("axes {first} and {second} are nearly {}: {:.3e} {unit} off", near.nearly.name(), near.by)
    }

    fn measured(&self, what: Measured) -> String {
        match what {
            Measured::Angle => "angle α",
            Measured::Normal => "common normal a",
            Measured::Offset => "offset d",
            Measured::Turn => "angle θ",
        }
        .into()
    }

    fn moved(&self, all: &[Moved]) -> String {
        if all.is_empty() {
            return "base and tool are unchanged".into();
        }
        let one = |moved: &Moved| match moved {
            Moved::BranchToBase => "γ1 and b1 are part of the base".into(),
            Moved::BranchToRow(row) => format!("γ{0} and b{0} are part of row {1}", row + 2, row + 1),
            Moved::FirstToBase => "α and length x of the first row are part of the base".into(),
            Moved::LastToTool => "α and length x of the last row are part of the tool".into(),
        };
        all.iter().map(one).collect::<Vec<String>>().join("; ")
    }
}
