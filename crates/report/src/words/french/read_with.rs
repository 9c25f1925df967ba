//! How masses and gravity of a document are read, and what its formulas of dynamics are of.

use denavit_check::{Dynamic, ReadWith, Spoken, Whereabouts};

/// How something of a link, or gravity, is read.
pub(super) fn read_with(what: &ReadWith) -> String {
    match what {
        ReadWith::Mass { mass, link, at } => {
            let link = link + 1;
            let at = match at {
                Whereabouts::Joint => format!("sur l’articulation {link}"),
                Whereabouts::End => format!("au bout du segment {link}"),
                Whereabouts::Middle => format!("au milieu du segment {link}"),
                Whereabouts::FromJoint(length) => {
                    format!("à {length} de l’articulation {link}, vers le bout du segment")
                }
                Whereabouts::FromEnd(length) => {
                    format!("à {length} du bout du segment {link}, vers son articulation")
                }
                Whereabouts::At([x, y, z]) => format!("en ({x}, {y}, {z}) dans le repère du segment {link}"),
            };
            format!("la masse {mass} {at}")
        }
        ReadWith::Point { link } => {
            format!("le segment {} sans inertie autour de son centre de masse", link + 1)
        }
        ReadWith::Rod { link } => format!("le segment {} comme une tige mince", link + 1),
        ReadWith::Inertia { inertia, link, is_at_joint: true } => {
            format!("{inertia} autour de l’articulation {}", link + 1)
        }
        ReadWith::Inertia { inertia, link, is_at_joint: false } => {
            format!("{inertia} autour du centre de masse du segment {}", link + 1)
        }
        ReadWith::Rotor { inertia, joint } => {
            format!("{inertia} comme inertie du rotor de l’articulation {}", joint + 1)
        }
        ReadWith::Gravity([x, y, z]) => {
            format!("l’accélération de la pesanteur ({x}, {y}, {z}) dans la base")
        }
    }
}

/// What words say of masses and gravity.
pub(super) fn spoken(of: Spoken) -> &'static str {
    match of {
        Spoken::Gravity => "la direction de la pesanteur",
        Spoken::Shape => "ce que sont les segments, et où sont leurs masses",
        Spoken::Centres => "d’où se mesurent les centres de masse",
        Spoken::Inertias => "autour de quels points sont les inerties",
        Spoken::LeftOut => "des inerties, que les formules n’ont pas",
        Spoken::Links => "de quel segment est chaque nom",
    }
}

pub(super) fn dynamic(what: Dynamic) -> &'static str {
    match what {
        Dynamic::Torque => "un couple",
        Dynamic::Bias => "un couple à vitesses constantes",
        Dynamic::Inertia => "la matrice d’inertie",
        Dynamic::Velocity => "les couples centrifuges et de Coriolis",
        Dynamic::Coriolis => "la matrice des couples centrifuges et de Coriolis",
        Dynamic::Gravity => "les couples de pesanteur",
        Dynamic::Kinetic => "l’énergie cinétique",
        Dynamic::Potential => "l’énergie potentielle",
        Dynamic::Lagrangian => "le lagrangien",
        Dynamic::Energy => "l’énergie",
        Dynamic::Derivative => "une dérivée d’une énergie",
        Dynamic::Place => "un point d’un corps",
        Dynamic::Motion => "le mouvement d’un point d’un corps",
    }
}
