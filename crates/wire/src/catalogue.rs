//! The robots of the catalogue.

use crate::Schema;
use crate::robot::joints;
use denavit::catalogue;
use denavit::description::{Description, RowTree};
use serde::Serialize;

/// Some of the robots, or all.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Catalogue {
    /// In the order of their names.
    pub robots: Vec<Listed>,
    /// The version.
    pub schema: Schema,
    /// The structures beside them, in the order of their names.
    pub structures: Vec<Structure>,
}

/// A tree of rows.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Structure {
    /// How many joints move by themselves.
    pub joints: usize,
    /// What it is called on a command line: `dual-arm`.
    pub name: String,
    /// Where its numbers come from.
    pub source: Option<String>,
    /// The frames at which its chains end.
    pub tips: Vec<String>,
    /// What people call it.
    pub title: String,
}

impl Structure {
    /// A tree by its name.
    pub fn of(name: &str, tree: &RowTree) -> Self {
        Structure {
            joints: tree.rows.iter().filter(|r| r.variable.is_some()).count(),
            name: name.into(),
            source: tree.source.clone(),
            tips: tree.tips(),
            title: tree.name.clone(),
        }
    }
}

/// A robot of the catalogue.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Listed {
    /// The convention of its table.
    pub convention: &'static str,
    /// `RRPRRR`.
    pub joints: String,
    /// What it is called on a command line: `staubli-rx90`.
    pub name: String,
    /// Where its numbers come from.
    pub source: Option<String>,
    /// What people call it: `Stäubli RX-90`.
    pub title: String,
}

impl Listed {
    /// A robot by its name in the catalogue.
    pub fn of(name: &str, d: &Description) -> Self {
        Listed {
            convention: d.convention.name(),
            joints: joints(d),
            name: name.into(),
            source: d.source.clone(),
            title: d.name.clone(),
        }
    }
}

impl Catalogue {
    /// The robots and the structures of lists.
    pub fn of<'a>(
        robots: impl IntoIterator<Item = (&'a str, &'a Description)>,
        structures: impl IntoIterator<Item = (&'a str, &'a RowTree)>,
    ) -> Self {
        Catalogue {
            robots: robots.into_iter().map(|(name, d)| Listed::of(name, d)).collect(),
            schema: Schema,
            structures: structures.into_iter().map(|(name, tree)| Structure::of(name, tree)).collect(),
        }
    }

    /// All robots and structures.
    pub fn whole() -> Self {
        let listed = |name| Some(Listed::of(name, &catalogue::robot(name)?));
        let structure = |name| Some(Structure::of(name, &catalogue::structure(name)?));
        Catalogue {
            robots: catalogue::names().into_iter().filter_map(listed).collect(),
            schema: Schema,
            structures: catalogue::structures().into_iter().filter_map(structure).collect(),
        }
    }
}
