//! How masses and gravity of a document are read, what its formulas of dynamics are of, how the author of a table chose, and how
//! signs are lost.

use denavit_check::inverse::Cause;
use denavit_check::{Dynamic, Placement, ReadWith, Spoken, Whereabouts};

/// How something of a link, or gravity, is read.
pub(super) fn read_with(what: &ReadWith) -> String {
    match what {
        ReadWith::Mass { mass, link, at } => {
            let link = link + 1;
            let at = match at {
                Whereabouts::Joint => format!("auf Gelenk {link}"),
                Whereabouts::End => format!("am Ende von Glied {link}"),
                Whereabouts::Middle => format!("in der Mitte von Glied {link}"),
                Whereabouts::FromJoint(length) => {
                    format!("im Abstand {length} von Gelenk {link} zum Ende des Glieds hin")
                }
                Whereabouts::FromEnd(length) => {
                    format!("im Abstand {length} vom Ende des Glieds {link} zu seinem Gelenk hin")
                }
                Whereabouts::At([x, y, z]) => {
                    format!("bei ({x}, {y}, {z}) im Koordinatensystem von Glied {link}")
                }
            };
            format!("die Masse {mass} {at}")
        }
        ReadWith::Point { link } => format!("Glied {} ohne Trägheit um seinen Schwerpunkt", link + 1),
        ReadWith::Rod { link } => format!("Glied {} als dünner Stab", link + 1),
        ReadWith::Inertia { inertia, link, is_at_joint: true } => format!("{inertia} um Gelenk {}", link + 1),
        ReadWith::Inertia { inertia, link, is_at_joint: false } => {
            format!("{inertia} um den Schwerpunkt von Glied {}", link + 1)
        }
        ReadWith::Rotor { inertia, joint } => {
            format!("{inertia} als Trägheit des Rotors von Gelenk {}", joint + 1)
        }
        ReadWith::Gravity([x, y, z]) => format!("die Fallbeschleunigung ({x}, {y}, {z}) in der Basis"),
    }
}

/// What words say of masses and gravity.
pub(super) fn spoken(of: Spoken) -> &'static str {
    match of {
        Spoken::Gravity => "er sagt, wohin die Schwerkraft zieht",
        Spoken::Shape => "er sagt, was die Glieder sind und wo ihre Massen liegen",
        Spoken::Centres => "er sagt, von wo die Schwerpunkte gemessen werden",
        Spoken::Inertias => "er sagt, auf welche Punkte sich die Trägheiten beziehen",
        Spoken::LeftOut => "er sagt, dass die Glieder Trägheiten haben, die in den Formeln fehlen",
        Spoken::Links => "er sagt, zu welchem Glied jeder Name gehört",
    }
}

pub(super) fn dynamic(what: Dynamic) -> &'static str {
    match what {
        Dynamic::Torque => "ein Gelenkmoment",
        Dynamic::Bias => "ein Gelenkmoment bei konstanten Geschwindigkeiten",
        Dynamic::Inertia => "die Massenmatrix",
        Dynamic::Velocity => "die Zentrifugal- und Coriolismomente",
        Dynamic::Coriolis => "die Matrix der Zentrifugal- und Coriolismomente",
        Dynamic::Gravity => "die Momente der Schwerkraft",
        Dynamic::Kinetic => "die kinetische Energie",
        Dynamic::Potential => "die potentielle Energie",
        Dynamic::Lagrangian => "die Lagrange-Funktion",
        Dynamic::Energy => "die Energie",
        Dynamic::Derivative => "eine Ableitung einer Energie",
        Dynamic::Place => "ein Punkt eines Glieds",
        Dynamic::Motion => "die Bewegung eines Punkts eines Glieds",
    }
}

/// What the author of a table chose.
pub(super) fn placed(placement: &Placement) -> String {
    let mut said = vec![];
    said.extend(placement.convention.map(|c| format!("er wird in der Konvention {c} gelesen")));
    if placement.millimetres {
        said.push("Längen sind in Millimetern".into());
    }
    said.extend(placement.names.iter().map(|(own, robot)| format!("{own} steht für {robot}")));
    said.extend(
        placement.zeros.iter().map(|(k, by)| format!("Gelenk {k} ist um {by} größer als das des Roboters")),
    );
    said.extend(placement.reversed.iter().map(|k| format!("Gelenk {k} zählt andersherum")));
    if placement.base {
        said.push("System 0 liegt anderswo".into());
    }
    if placement.hand {
        said.push("das letzte System liegt anderswo".into());
    }
    if placement.is_turned && !placement.base && !placement.hand {
        said.push("System 0 oder das letzte System ist gedreht".into());
    }
    said.join("; ")
}

/// How the sign of an angle is lost.
pub(super) fn sign_lost(by: Cause) -> &'static str {
    match by {
        Cause::Arctan => "der Arkustangens eines Quotienten verliert den Quadranten; atan2 behält ihn",
        Cause::Arcsin => "ein Arkussinus gibt nur einen von zwei Winkeln",
        Cause::Arccos => "ein Arkuskosinus gibt nur einen von zwei Winkeln",
        Cause::Atan2 => "beide Argumente von atan2 haben anderswo das falsche Vorzeichen",
        Cause::Root => "das Vorzeichen der Wurzel ist nicht das der Stellung",
        Cause::Other => "das Vorzeichen geht verloren",
    }
}
