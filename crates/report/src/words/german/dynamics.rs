//! Dynamics.

use super::German;
use crate::tree::{Line, Math};
use crate::words::{Dynamics, Terms};
use denavit::dynamics::{Gives, Ground, Minimality};
use denavit::geometry::NoBody;
use denavit_program::Count;

impl Dynamics for German {
    fn dynamics_title(&self, robot: &str) -> String {
        format!("Dynamik: {robot}")
    }

    fn link_parameters(&self, has_other_frames: bool) -> String {
        let frames = match has_other_frames {
            true => {
                "des Koordinatensystems, dessen z-Achse auf der eigenen Achse des Glieds liegt (wie in der Tabelle nach \
                 Khalil, nicht wie in dieser hier)"
            }
            false => "seines Koordinatensystems",
        };
        format!(
            "Glied j hat den Trägheitstensor XXj … ZZj (XYj ist das negative Deviationsmoment), die statischen Momente MXj, MYj, \
             MZj und die Masse Mj, alle bezogen auf den Ursprung {frames}. qd und qdd sind die Geschwindigkeiten und \
             Beschleunigungen der Gelenke."
        )
    }

    fn no_body(&self, why: NoBody) -> &'static str {
        match why {
            NoBody::NotFinite => "eine Zahl ist nicht endlich",
            NoBody::NegativeMass => "die Masse ist negativ",
            NoBody::NoMass => "die Masse ist 0, das statische Moment oder die Trägheit aber nicht",
            NoBody::NotPositive => "der Trägheitstensor um den Schwerpunkt ist nicht positiv",
            NoBody::Triangle => "eines der Hauptträgheitsmomente ist größer als die Summe der beiden anderen",
        }
    }

    fn gravity_is(&self, components: [Math; 3]) -> Line {
        Line::new("Die Fallbeschleunigung in der Basis ist (").numbers(components, self.between()).text(").")
    }

    fn base_title(&self) -> String {
        "Basisparameter".into()
    }

    fn base_count(&self, all: usize, base: usize, minimality: Minimality) -> String {
        let rest = match minimality {
            Minimality::Proved => {
                "Weniger genügen nicht: Die Spalten, die zu ihnen gehören, sind bewiesen linear unabhängig."
                    .into()
            }
            Minimality::AtLeast(rank) => {
                format!("Vielleicht genügen weniger: Bewiesen unabhängig sind {rank} davon.")
            }
            Minimality::Unknown => "Ob weniger genügen, wurde nicht entschieden.".to_string(),
        };
        let of = match all {
            1 => "Von 1 Parameter der Glieder".into(),
            n => format!("Von {n} Parametern der Glieder"),
        };
        let have = if base == 1 { "wirkt" } else { "wirken" };
        format!("{of} {have}, zusammengefasst, {base} auf die Gelenkmomente. {rest}")
    }

    fn kept(&self, all: Vec<Math>) -> Line {
        Line::new("Wie verlangt, stehen diese für das, was mit ihnen zusammengefasst ist: ")
            .list(all)
            .text(".")
    }

    fn dropped(&self, all: Vec<Math>) -> Line {
        Line::new("Wie verlangt, stehen andere anstelle von ").list(all).text(".")
    }

    fn base_alone(&self, all: Vec<Math>) -> Line {
        Line::new("unverändert: ").list(all)
    }

    fn without_effect(&self, all: Vec<Math>) -> Line {
        Line::new("ohne Einfluss auf die Gelenkmomente: ").list(all)
    }

    fn torques_title(&self) -> String {
        "Gelenkmomente".into()
    }

    fn torques_cost(&self, count: &Count, ground: Ground) -> String {
        let ground = match ground {
            Ground::Proved => "Gleichheit mit den Lagrange-Gleichungen bewiesen".into(),
            Ground::Modulo(states) => format!(
                "nicht allgemein bewiesen: in {states} zufälligen Zuständen modulo einer Primzahl von 61 Bit genau gleich den \
                 Lagrange-Gleichungen"
            ),
            Ground::Numbers(states, off) => format!(
                "nicht bewiesen: in {states} Zuständen bis auf {off:.0e} gleich den Lagrange-Gleichungen"
            ),
            Ground::Failed => {
                "verschieden von den Lagrange-Gleichungen: das ist ein Fehler des Programms".into()
            }
        };
        format!("{}; {ground}.", self.count(count))
    }

    fn with_friction(&self) -> String {
        "h enthält die Reibung der Gelenke.".into()
    }

    fn divides_by(&self, all: Vec<Math>) -> Line {
        Line::new("Dieses Programm dividiert durch ").list(all).text(" und gilt, wo das nicht 0 ist.")
    }

    fn inertia_title(&self) -> String {
        "Massenmatrix".into()
    }

    fn velocity_torques_title(&self) -> String {
        "Zentrifugal- und Coriolismomente".into()
    }

    fn gravity_torques_title(&self) -> String {
        "Momente der Schwerkraft".into()
    }

    fn bodies_title(&self) -> String {
        "Die Glieder".into()
    }

    fn bodies(&self) -> String {
        "Ein Glied ist alles, was sich mit einer Achse bewegt. Die z-Achse seines Koordinatensystems liegt auf dieser Achse; System 0 \
         ist die Basis. Was zwischen zwei Achsen konstant ist und die Bewegung der zweiten ergeben die Transformationsmatrizen:"
            .into()
    }

    fn grouping(&self) -> String {
        "Eine Masse auf der Achse eines Drehgelenks ruht in beiden Gliedern, die das Gelenk verbindet: Die Gelenkmomente sind dieselben, \
         gleich zu welchem Glied sie gezählt wird. Von der Spitze zur Basis gibt jedes Glied dem vorigen alles ab, was dort gezählt \
         werden darf:"
            .into()
    }

    fn gives(&self, link: usize, gives: Gives) -> String {
        let k = link;
        let (to, taker) = match link {
            1 => ("der Basis".to_string(), "die Basis".to_string()),
            _ => (format!("Glied {}", link - 1), format!("Glied {}", link - 1)),
        };
        match gives {
            Gives::OnAxis => format!(
                "Glied {k} dreht sich: Es gibt M{k}, MZ{k} und YY{k} (als zweites Moment längs seiner Achse) an {taker} ab und behält \
                 XX{k} − YY{k}, XY{k}, XZ{k}, YZ{k}, ZZ{k}, MX{k}, MY{k} samt dem, was es bekommen hat"
            ),
            Gives::Nothing => format!(
                "Glied {k} dreht sich und hat für jede Richtung eine eigene Masse: Es gibt nichts ab und behält, was es bekommen hat"
            ),
            Gives::Inertia => format!(
                "Glied {k} gleitet: Es dreht sich mit {to}, und dort zählt seine Trägheit; es behält M{k}, MX{k}, MY{k}, MZ{k} samt \
                 dem, was es bekommen hat"
            ),
            Gives::Across => format!(
                "Glied {k} gleitet: Es dreht sich mit {to}, und dort zählt seine Trägheit; es behält M{k}, MX{k}, MY{k}, MZ{k} samt \
                 dem, was es bekommen hat, ohne das erste Moment in der Richtung aller Drehachsen vor ihm, das nichts bewirkt"
            ),
            Gives::Plan => format!(
                "Glied {k} gleitet in der Richtung aller Drehachsen vor ihm: {taker} übernimmt alles außer seiner Masse in dieser \
                 Richtung"
            ),
        }
    }

    fn outward_title(&self) -> String {
        "Von der Basis zum Werkzeug: wie sich die Glieder bewegen".into()
    }

    fn outward(&self) -> String {
        "Im Koordinatensystem jedes Glieds: w ist seine Winkelgeschwindigkeit, wd deren Ableitung, a die Beschleunigung des Ursprungs, \
         vermindert um die Fallbeschleunigung. R ist die Drehung in dieses System aus dem des vorigen Glieds, dessen Werte den Index p \
         tragen, r der Ort des Ursprungs dort: w = R wp, wd = R wdp, a = R(ap + Up r); ein Drehgelenk fügt z qd zu w hinzu und \
         z qdd + w × z qd (mit dem w davor) zu wd; ein Schubgelenk fügt z qdd + 2 w × z qd zu a hinzu. U = [wd]× + [w]×[w]×: Ein Punkt \
         des Glieds bei r hat die Beschleunigung a + U r. Was 0 oder gleich einem anderen Wert ist, hat keinen Namen."
            .into()
    }

    fn link(&self, link: usize) -> String {
        format!("Glied {link}")
    }

    fn link_of_tree(&self, link: usize, joint: &str, parent: Option<usize>) -> String {
        match parent {
            Some(parent) => format!("Glied {link}: hinter dem Gelenk {joint}, an Glied {parent}."),
            None => format!("Glied {link}: hinter dem Gelenk {joint}, an der Wurzel."),
        }
    }

    fn motion_ground(&self, ground: Ground) -> String {
        match ground {
            Ground::Proved => {
                "Bewiesen: w, wd und a sind die des Produkts der Transformationsmatrizen, nach dessen Ableitungen."
                    .into()
            }
            Ground::Modulo(states) => format!(
                "Nicht allgemein bewiesen: w, wd und a sind in {states} zufälligen Zuständen modulo einer Primzahl von 61 Bit genau \
                 gleich den Ableitungen des Produkts der Transformationsmatrizen."
            ),
            Ground::Numbers(states, off) => format!(
                "Nicht bewiesen: w, wd und a sind in {states} Zuständen bis auf {off:.0e} die Ableitungen des Produkts der \
                 Transformationsmatrizen."
            ),
            Ground::Failed => {
                "Nicht die Ableitungen des Produkts der Transformationsmatrizen: das ist ein Fehler des Programms."
                    .into()
            }
        }
    }

    fn inward_title(&self) -> String {
        "Vom Werkzeug zur Basis: was die Glieder bewegt".into()
    }

    fn inward(&self) -> String {
        "Von der Spitze zur Basis, bezogen auf den Ursprung jedes Koordinatensystems: f ist die Kraft und n das Moment, die das Glied \
         und alle hinter ihm bewegen. Für das Glied allein sind das, in Basisparametern, M a + U MS und J wd + w × J w + MS × a; dazu \
         kommt, in dieses System umgerechnet, was die Glieder dahinter bewegt. Das Moment eines Drehgelenks ist das um seine z-Achse, \
         die Kraft eines Schubgelenks die längs dieser Achse."
            .into()
    }

    fn short_title(&self) -> String {
        "Das kurze Programm".into()
    }

    fn short(&self) -> String {
        "Dieselbe Rekursion hat viele Formen: parallele Achsen zusammengenommen, Bewegung und Kräfte eines Glieds in diesem oder jenem \
         System, Massen auf den Achsen hier oder dort gezählt, eine Länge als Einheit. Die kürzeste, die eine Suche gefunden hat, an der \
         Stelle der obigen (`--symbolic` schreibt sie aus):"
            .into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::german::counted;

    #[test]
    fn one_and_many_parameters() {
        let said = |all, base| German.base_count(all, base, Minimality::Unknown);
        assert!(said(1, 1).starts_with("Von 1 Parameter der Glieder wirkt, zusammengefasst, 1 auf"));
        assert!(said(20, 3).starts_with("Von 20 Parametern der Glieder wirken, zusammengefasst, 3 auf"));
        assert_eq!(counted(1, "Gelenk", "Gelenke"), "1 Gelenk");
        assert_eq!(counted(0, "Gelenk", "Gelenke"), "0 Gelenke");
    }
}
