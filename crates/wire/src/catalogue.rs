//! The robots of the catalogue.

use crate::Schema;
use crate::robot::joints;
use denavit::catalogue;
use denavit::description::parallel::Parallel;
use denavit::description::{Description, Linkage, RowTree};
use serde::Serialize;

/// Some of the robots, or all.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Catalogue {
    /// Arms and mechanisms with closed loops, in the order of their names.
    pub linkages: Vec<Closed>,
    /// Parallel robots, in the order of their names; the page opens none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parallel: Vec<OnLegs>,
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

/// A tree of rows with closed loops.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Closed {
    /// How many joints are driven.
    pub driven: usize,
    /// How many loops it has.
    pub loops: usize,
    /// What it is called on a command line: `sr400`.
    pub name: String,
    /// How many joints are passive, cut ones included.
    pub passive: usize,
    /// Where its numbers come from.
    pub source: Option<String>,
    /// What people call it.
    pub title: String,
}

impl Closed {
    /// A linkage by its name.
    pub fn of(name: &str, linkage: &Linkage) -> Self {
        Closed {
            driven: linkage.driven().len(),
            loops: linkage.closures.len(),
            name: name.into(),
            passive: linkage.passive().len(),
            source: linkage.tree.source.clone(),
            title: linkage.tree.name.clone(),
        }
    }
}

/// A parallel robot.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct OnLegs {
    /// How many drives it has.
    pub drives: usize,
    /// `gough-stewart`, `delta` or `planar-3rrr`.
    pub kind: &'static str,
    /// What it is called on a command line: `rotary-delta`.
    pub name: String,
    /// Where its numbers come from.
    pub source: Option<String>,
    /// What people call it.
    pub title: String,
}

impl OnLegs {
    /// A parallel robot by its name.
    pub fn of(name: &str, parallel: &Parallel) -> Self {
        OnLegs {
            drives: parallel.family.drives(),
            kind: parallel.family.kind(),
            name: name.into(),
            source: parallel.source.clone(),
            title: parallel.name.clone(),
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
    /// The same with parallel robots.
    #[must_use]
    pub fn with<'a>(mut self, parallel: impl IntoIterator<Item = (&'a str, &'a Parallel)>) -> Self {
        self.parallel = parallel.into_iter().map(|(name, p)| OnLegs::of(name, p)).collect();
        self
    }

    /// The robots, the structures and the linkages of lists.
    pub fn of<'a>(
        robots: impl IntoIterator<Item = (&'a str, &'a Description)>,
        structures: impl IntoIterator<Item = (&'a str, &'a RowTree)>,
        linkages: impl IntoIterator<Item = (&'a str, &'a Linkage)>,
    ) -> Self {
        Catalogue {
            linkages: linkages.into_iter().map(|(name, l)| Closed::of(name, l)).collect(),
            parallel: vec![],
            robots: robots.into_iter().map(|(name, d)| Listed::of(name, d)).collect(),
            schema: Schema,
            structures: structures.into_iter().map(|(name, tree)| Structure::of(name, tree)).collect(),
        }
    }

    /// All robots, structures and linkages.
    pub fn whole() -> Self {
        let listed = |name| Some(Listed::of(name, &catalogue::robot(name)?));
        let structure = |name| Some(Structure::of(name, &catalogue::structure(name)?));
        let closed = |name| Some(Closed::of(name, &catalogue::linkage(name)?));
        Catalogue {
            linkages: catalogue::linkages().into_iter().filter_map(closed).collect(),
            parallel: vec![],
            robots: catalogue::names().into_iter().filter_map(listed).collect(),
            schema: Schema,
            structures: catalogue::structures().into_iter().filter_map(structure).collect(),
        }
    }
}
