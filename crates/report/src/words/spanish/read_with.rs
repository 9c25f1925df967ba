//! How masses and gravity of a document are read, and what its formulas of dynamics are of.

use denavit_check::{Dynamic, ReadWith, Spoken, Whereabouts};

/// How something of a link, or gravity, is read.
pub(super) fn read_with(what: &ReadWith) -> String {
    match what {
        ReadWith::Mass { mass, link, at } => {
            let link = link + 1;
            let at = match at {
                Whereabouts::Joint => format!("en la articulación {link}"),
                Whereabouts::End => format!("en el extremo del eslabón {link}"),
                Whereabouts::Middle => format!("en la mitad del eslabón {link}"),
                Whereabouts::FromJoint(length) => {
                    format!("a {length} de la articulación {link}, hacia el extremo del eslabón")
                }
                Whereabouts::FromEnd(length) => {
                    format!("a {length} del extremo del eslabón {link}, hacia su articulación")
                }
                Whereabouts::At([x, y, z]) => format!("en ({x}, {y}, {z}) en el sistema del eslabón {link}"),
            };
            format!("la masa {mass} {at}")
        }
        ReadWith::Point { link } => {
            format!("el eslabón {} sin inercia respecto a su centro de masas", link + 1)
        }
        ReadWith::Rod { link } => format!("el eslabón {} como varilla delgada", link + 1),
        ReadWith::Inertia { inertia, link, is_at_joint: true } => {
            format!("{inertia} respecto a la articulación {}", link + 1)
        }
        ReadWith::Inertia { inertia, link, is_at_joint: false } => {
            format!("{inertia} respecto al centro de masas del eslabón {}", link + 1)
        }
        ReadWith::Rotor { inertia, joint } => {
            format!("{inertia} como inercia del rotor de la articulación {}", joint + 1)
        }
        ReadWith::Gravity([x, y, z]) => format!("la aceleración de la gravedad ({x}, {y}, {z}) en la base"),
    }
}

/// What words say of masses and gravity.
pub(super) fn spoken(of: Spoken) -> &'static str {
    match of {
        Spoken::Gravity => "dice hacia dónde tira la gravedad",
        Spoken::Shape => "dice qué son los eslabones y dónde están sus masas",
        Spoken::Centres => "dice desde dónde se miden los centros de masas",
        Spoken::Inertias => "dice respecto a qué puntos son las inercias",
        Spoken::LeftOut => "dice que los eslabones tienen inercias, que las fórmulas omiten",
        Spoken::Links => "dice de qué eslabón es cada nombre",
    }
}

pub(super) fn dynamic(what: Dynamic) -> &'static str {
    match what {
        Dynamic::Torque => "un par",
        Dynamic::Bias => "un par a velocidades constantes",
        Dynamic::Inertia => "la matriz de inercia",
        Dynamic::Velocity => "los pares centrífugos y de Coriolis",
        Dynamic::Coriolis => "la matriz de los pares centrífugos y de Coriolis",
        Dynamic::Gravity => "los pares de la gravedad",
        Dynamic::Kinetic => "la energía cinética",
        Dynamic::Potential => "la energía potencial",
        Dynamic::Lagrangian => "el lagrangiano",
        Dynamic::Energy => "la energía",
        Dynamic::Derivative => "una derivada de una energía",
        Dynamic::Place => "un punto de un eslabón",
        Dynamic::Motion => "el movimiento de un punto de un eslabón",
    }
}
