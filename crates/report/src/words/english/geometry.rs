//! Axes and tables.

use super::{English, counted};
use crate::words::Geometry;
use crate::words::geometry::{Given, Whole};
use denavit::description::{Agreement, Chain, Mechanism, Moved, Part};
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

    fn agreement(&self, agreement: Agreement, of: Whole) -> String {
        let whole = match of {
            Whole::File => "file's",
            Whole::Tree => "tree's",
        };
        match agreement {
            Agreement::Proved => format!("its table is proved to be the {whole} chain as it was read"),
            Agreement::Within(by) if by < 1e-50 => format!("its table is the {whole} chain to 60 digits"),
            Agreement::Within(by) => format!("its table is the {whole} chain within {by:.0e}"),
        }
    }

    fn chain(&self, chain: &Chain, mechanism: &Mechanism) -> String {
        let Given { ends: [from, to], joints, limited, heavy, links, follows } = Given::of(chain, mechanism);
        let agreement = self.agreement(chain.agreement, Whole::File);
        let follows = follows.map_or(String::new(), |name| {
            format!("; what `{name}` follows is not on the way, it moves by itself")
        });
        let limits = match limited {
            0 => "no limits".to_string(),
            _ if limited == joints => "limits for all".into(),
            _ => format!("limits for {limited}"),
        };
        let inertias = match heavy {
            0 => "no inertias".to_string(),
            _ if chain.unweighed.is_some() => format!("inertias for {heavy} of {links} links"),
            _ => format!("inertias for {heavy} of {links} links, which its rows have"),
        };
        let joints = counted(joints, "joint", "joints");
        format!(
            "from `{from}` to `{to}`, {joints}; {agreement}{follows}. The file gives {limits}, {inertias}"
        )
    }

    fn left_part(&self, part: Part) -> &'static str {
        match part {
            Part::Names => "names of joints",
            Part::Limits => "limits",
            Part::Velocities => "limits of speed",
            Part::Accelerations => "limits of acceleration",
            Part::Efforts => "limits of torque and force",
            Part::Poses => "named poses",
            Part::Masses => "masses",
            Part::Rotors => "rotors",
            Part::Friction => "friction",
            Part::Gravity => "gravity",
        }
    }

    fn read_apart(&self, metres: f64) -> String {
        let micrometres = metres * 1e6;
        format!(
            "read so, links lie up to {micrometres:.3} µm from where the decimals as they are written have them, in configurations that were tried"
        )
    }
}
