//! What of a robot each format has a place for, as it is written here.

use super::{Description, Row};

/// A format in which a robot is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    /// A robot file with the rows of a chain or of a tree.
    RobotFile,
    /// A robot file with axes or screws.
    Axes,
    /// A URDF.
    Urdf,
    /// A model of MuJoCo's.
    Mjcf,
    /// A `.par` file of SYMORO's.
    Par,
    /// A table in a document.
    Table,
}

/// What is said of a robot besides its geometry.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Part {
    /// Names of joints.
    Names,
    /// Limits of joints.
    Limits,
    /// Limits of their speeds.
    Velocities,
    /// Limits of their accelerations.
    Accelerations,
    /// Limits of their torques and forces, which a table of rows has not.
    Efforts,
    /// Configurations with names.
    Poses,
    /// Masses of links.
    Masses,
    /// Inertias of rotors.
    Rotors,
    /// Friction of joints.
    Friction,
    /// Gravity.
    Gravity,
}

impl Part {
    /// All of them.
    pub const ALL: [Part; 10] = [
        Part::Names,
        Part::Limits,
        Part::Velocities,
        Part::Accelerations,
        Part::Efforts,
        Part::Poses,
        Part::Masses,
        Part::Rotors,
        Part::Friction,
        Part::Gravity,
    ];
}

impl Format {
    /// All of them.
    pub const ALL: [Format; 6] =
        [Format::RobotFile, Format::Axes, Format::Urdf, Format::Mjcf, Format::Par, Format::Table];

    /// Whether a part has a place in what is written.
    pub fn holds(self, part: Part) -> bool {
        use Part::{
            Accelerations, Efforts, Friction, Gravity, Limits, Masses, Names, Poses, Rotors, Velocities,
        };
        match self {
            Format::RobotFile => part != Efforts,
            Format::Axes => {
                matches!(part, Names | Limits | Velocities | Accelerations | Poses | Gravity)
            }
            Format::Urdf => matches!(part, Names | Limits | Velocities | Masses | Friction),
            Format::Mjcf => matches!(part, Names | Limits | Poses | Masses | Rotors | Friction | Gravity),
            Format::Par => part == Gravity,
            Format::Table => matches!(part, Names | Limits),
        }
    }
}

impl Description {
    /// The parts that it has.
    pub fn parts(&self) -> Vec<Part> {
        let any = |of: fn(&Row) -> bool| self.rows.iter().any(of);
        let has = |part: &Part| match part {
            Part::Names => any(|r| r.variable.is_some() && r.name.is_some()),
            Part::Limits => any(|r| r.limits.is_some()),
            Part::Velocities => any(|r| r.velocity.is_some()),
            Part::Accelerations => any(|r| r.acceleration.is_some()),
            Part::Efforts => false,
            Part::Poses => !self.poses.is_empty(),
            Part::Masses => self.has_masses(),
            Part::Rotors => any(|r| r.rotor.is_some()),
            Part::Friction => any(|r| r.viscous.is_some() || r.coulomb.is_some()),
            Part::Gravity => self.gravity.is_some(),
        };
        Part::ALL.into_iter().filter(has).collect()
    }
}
