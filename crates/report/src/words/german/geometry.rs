//! Axes and tables.

use super::{German, counted};
use crate::words::geometry::{Given, Whole};
use crate::words::{Geometry, Terms};
use denavit::description::{Agreement, Chain, Mechanism, Moved, Part};
use denavit::idealise::Measured;
use denavit::structure::{NearlySpecial, Relation, Special};

impl Geometry for German {
    fn relation(&self, relation: Relation) -> String {
        match relation {
            Relation::Coincident => "fallen zusammen",
            Relation::Parallel => "sind parallel",
            Relation::MeetPerpendicular => "schneiden sich rechtwinklig",
            Relation::Meet => "schneiden sich",
            Relation::Perpendicular => "kreuzen sich rechtwinklig",
            Relation::Skew => "sind windschief",
            Relation::PerpendicularDirections => "stehen senkrecht aufeinander",
            Relation::ObliqueDirections => "stehen schräg zueinander",
        }
        .into()
    }

    fn nearly(&self, near: &NearlySpecial) -> String {
        let unit = if near.is_angle { "rad" } else { "m" };
        let (first, second) = near.joints;
        let by = self.written(format!("{:.3e}", near.by));
        match near.nearly {
            Special::Coincident => {
                format!("die Achsen {first} und {second} fallen fast zusammen: bis auf {by} {unit}")
            }
            Special::Parallel => {
                format!("die Achsen {first} und {second} sind fast parallel: bis auf {by} {unit}")
            }
            Special::Perpendicular => {
                format!("die Achsen {first} und {second} sind fast senkrecht: bis auf {by} {unit}")
            }
            Special::Meeting => {
                format!("die Achsen {first} und {second} schneiden sich fast: bis auf {by} {unit}")
            }
        }
    }

    fn measured(&self, what: Measured) -> String {
        match what {
            Measured::Angle => "Verwindung α",
            Measured::Normal => "gemeinsame Normale a",
            Measured::Offset => "Versatz d",
            Measured::Turn => "Winkel θ",
        }
        .into()
    }

    fn moved(&self, all: &[Moved]) -> String {
        if all.is_empty() {
            return "Basis und Werkzeug bleiben, wie sie sind".into();
        }
        let one = |moved: &Moved| match moved {
            Moved::BranchToBase => "γ1 und b1 gehören nun zur Basis".into(),
            Moved::BranchToRow(row) => format!("γ{0} und b{0} gehören nun zur Zeile {1}", row + 2, row + 1),
            Moved::FirstToBase => "α und die Länge längs x der ersten Zeile gehören nun zur Basis".into(),
            Moved::LastToTool => "α und die Länge längs x der letzten Zeile gehören nun zum Werkzeug".into(),
        };
        all.iter().map(one).collect::<Vec<String>>().join("; ")
    }

    fn agreement(&self, agreement: Agreement, of: Whole) -> String {
        let whole = match of {
            Whole::File => "der Datei",
            Whole::Tree => "des Baums",
        };
        match agreement {
            Agreement::Proved => {
                format!("ihre Tabelle ist bewiesen dieselbe wie die Kette {whole}, so wie sie gelesen wurde")
            }
            Agreement::Within(by) if by < 1e-50 => {
                format!("ihre Tabelle ist auf 60 Stellen die Kette {whole}")
            }
            Agreement::Within(by) => format!("ihre Tabelle ist bis auf {by:.0e} die Kette {whole}"),
        }
    }

    fn chain(&self, chain: &Chain, mechanism: &Mechanism) -> String {
        let Given { ends: [from, to], joints, limited, heavy, links, follows } = Given::of(chain, mechanism);
        let agreement = self.agreement(chain.agreement, Whole::File);
        let follows = follows.map_or(String::new(), |name| {
            format!("; wem `{name}` folgt, liegt nicht auf dem Weg, es bewegt sich frei")
        });
        let limits = match limited {
            0 => "keine Grenzen".to_string(),
            _ if limited == joints => "Grenzen für alle".into(),
            _ => format!("Grenzen für {limited}"),
        };
        let inertias = match heavy {
            0 => "keine Trägheiten".to_string(),
            _ if chain.unweighed.is_some() => format!("Trägheiten für {heavy} von {links} Gliedern"),
            _ => format!("Trägheiten für {heavy} von {links} Gliedern, die in den Zeilen stehen"),
        };
        let joints = counted(joints, "Gelenk", "Gelenke");
        format!(
            "von `{from}` nach `{to}`, {joints}; {agreement}{follows}. Die Datei enthält {limits}, {inertias}"
        )
    }

    fn left_part(&self, part: Part) -> &'static str {
        match part {
            Part::Names => "Namen der Gelenke",
            Part::Limits => "Grenzen",
            Part::Velocities => "Geschwindigkeitsgrenzen",
            Part::Accelerations => "Beschleunigungsgrenzen",
            Part::Efforts => "Grenzen für Moment und Kraft",
            Part::Poses => "benannte Posen",
            Part::Masses => "Massen",
            Part::Rotors => "Rotoren",
            Part::Friction => "Reibung",
            Part::Gravity => "Schwerkraft",
        }
    }

    fn read_apart(&self, metres: f64) -> String {
        let micrometres = self.written(format!("{:.3}", metres * 1e6));
        format!(
            "so gelesen, liegen Glieder in den erprobten Stellungen bis zu {micrometres} µm neben dem Ort, den die Dezimalzahlen der Datei angeben"
        )
    }
}
