//! Axes and tables.

use super::{Spanish, counted};
use crate::words::geometry::{Given, Whole};
use crate::words::{Geometry, Terms};
use denavit::description::{Agreement, Chain, Mechanism, Moved, Part};
use denavit::idealise::Measured;
use denavit::structure::{NearlySpecial, Relation, Special};

impl Geometry for Spanish {
    fn relation(&self, relation: Relation) -> String {
        match relation {
            Relation::Coincident => "coinciden",
            Relation::Parallel => "son paralelos",
            Relation::MeetPerpendicular => "se cortan en ángulo recto",
            Relation::Meet => "se cortan",
            Relation::Perpendicular => "se cruzan en ángulo recto",
            Relation::Skew => "se cruzan",
            Relation::PerpendicularDirections => "son perpendiculares",
            Relation::ObliqueDirections => "son oblicuos",
        }
        .into()
    }

    fn nearly(&self, near: &NearlySpecial) -> String {
        let unit = if near.is_angle { "rad" } else { "m" };
        let (first, second) = near.joints;
        let what = match near.nearly {
            Special::Coincident => "casi coinciden",
            Special::Parallel => "son casi paralelos",
            Special::Perpendicular => "son casi perpendiculares",
            Special::Meeting => "casi se cortan",
        };
        let by = self.written(format!("{:.3e}", near.by));
        format!("los ejes {first} y {second} {what}: se apartan {by} {unit}")
    }

    fn measured(&self, what: Measured) -> String {
        match what {
            Measured::Angle => "torsión α",
            Measured::Normal => "normal común a",
            Measured::Offset => "desplazamiento d",
            Measured::Turn => "ángulo θ",
        }
        .into()
    }

    fn moved(&self, all: &[Moved]) -> String {
        if all.is_empty() {
            return "la base y la herramienta no cambian".into();
        }
        let one = |moved: &Moved| match moved {
            Moved::BranchToBase => "γ1 y b1 pasan a la base".into(),
            Moved::BranchToRow(row) => format!("γ{0} y b{0} pasan a la fila {1}", row + 2, row + 1),
            Moved::FirstToBase => "α y la longitud según x de la primera fila pasan a la base".into(),
            Moved::LastToTool => "α y la longitud según x de la última fila pasan a la herramienta".into(),
        };
        all.iter().map(one).collect::<Vec<String>>().join("; ")
    }

    fn agreement(&self, agreement: Agreement, of: Whole) -> String {
        let whole = match of {
            Whole::File => "del archivo",
            Whole::Tree => "del árbol",
        };
        match agreement {
            Agreement::Proved => {
                format!("está demostrado que su tabla es la cadena {whole} tal como se ha leído")
            }
            Agreement::Within(by) if by < 1e-50 => format!("su tabla es la cadena {whole} con 60 cifras"),
            Agreement::Within(by) => format!("su tabla es la cadena {whole} salvo {by:.0e}"),
        }
    }

    fn chain(&self, chain: &Chain, mechanism: &Mechanism) -> String {
        let Given { ends: [from, to], joints, limited, heavy, links, follows } = Given::of(chain, mechanism);
        let agreement = self.agreement(chain.agreement, Whole::File);
        let follows = follows.map_or(String::new(), |name| {
            format!("; aquello a lo que sigue `{name}` no está en el camino, se mueve por sí misma")
        });
        let limits = match limited {
            0 => "ningún límite".to_string(),
            _ if limited == joints => "límites para todas".into(),
            _ => format!("límites para {limited}"),
        };
        let inertias = match heavy {
            0 => "ninguna inercia".to_string(),
            _ => {
                let rows = if chain.unweighed.is_some() { "" } else { ", que llevan sus filas" };
                format!("inercias para {heavy} de {}{rows}", counted(links, "eslabón", "eslabones"))
            }
        };
        let joints = counted(joints, "articulación", "articulaciones");
        format!(
            "de `{from}` a `{to}`, {joints}; {agreement}{follows}. El archivo contiene {limits}, {inertias}"
        )
    }

    fn left_part(&self, part: Part) -> &'static str {
        match part {
            Part::Names => "nombres de las articulaciones",
            Part::Limits => "límites",
            Part::Velocities => "límites de velocidad",
            Part::Accelerations => "límites de aceleración",
            Part::Efforts => "límites de par y fuerza",
            Part::Poses => "poses con nombre",
            Part::Masses => "masas",
            Part::Rotors => "rotores",
            Part::Friction => "rozamiento",
            Part::Gravity => "gravedad",
        }
    }

    fn read_apart(&self, metres: f64) -> String {
        let micrometres = self.written(format!("{:.3}", metres * 1e6));
        format!(
            "así leídos, en las configuraciones probadas los eslabones quedan hasta a {micrometres} µm de donde los sitúan los decimales tal como están escritos"
        )
    }
}
