//! Axes.

use super::English;
use crate::words::Geometry;
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
}
