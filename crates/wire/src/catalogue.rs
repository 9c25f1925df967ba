//! The robots of the catalogue.

use crate::Schema;
use crate::robot::joints;
use denavit::catalogue;
use denavit::description::Description;
use serde::Serialize;

/// Some of the robots, or all.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Catalogue {
    /// In the order of their names.
    pub robots: Vec<Listed>,
    /// The version.
    pub schema: Schema,
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
    /// The robots of a list.
    pub fn of<'a>(robots: impl IntoIterator<Item = (&'a str, &'a Description)>) -> Self {
        Catalogue {
            robots: robots.into_iter().map(|(name, d)| Listed::of(name, d)).collect(),
            schema: Schema,
        }
    }

    /// All robots.
    pub fn whole() -> Self {
        let listed = |name| Some(Listed::of(name, &catalogue::robot(name)?));
        Catalogue { robots: catalogue::names().into_iter().filter_map(listed).collect(), schema: Schema }
    }
}
