//! Robots that people own or study, each a robot file with its source; beside them structures, which are trees of rows, and linkages,
//! which have closed loops.

use crate::description::{Described, Description, Linkage, RowTree, read_robot, read_toml};
use include_dir::{Dir, include_dir};

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/catalogue");
static STRUCTURES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/structures");
static LINKAGES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/linkages");

/// The names of the robot files of a folder, sorted.
fn listed(folder: &Dir<'static>) -> Vec<&'static str> {
    let files = folder.files().filter(|f| f.path().extension().is_some_and(|e| e == "toml"));
    let mut names: Vec<&str> = files.filter_map(|f| f.path().file_stem()?.to_str()).collect();
    names.sort_unstable();
    names
}

/// The names of all robots, sorted.
pub fn names() -> Vec<&'static str> {
    listed(&FILES)
}

/// The robot file with this name.
pub fn text(name: &str) -> Option<&'static str> {
    FILES.get_file(format!("{name}.toml"))?.contents_utf8()
}

/// The robot with this name; a test holds that every file can be read.
pub fn robot(name: &str) -> Option<Description> {
    read_toml(text(name)?).ok().map(|(description, _)| description)
}

/// The names of all structures, sorted.
pub fn structures() -> Vec<&'static str> {
    listed(&STRUCTURES)
}

/// The structure with this name; a test holds that every file can be read.
pub fn structure(name: &str) -> Option<RowTree> {
    match read_robot(structure_text(name)?).ok()?.0 {
        Described::Tree(tree) => Some(*tree),
        Described::Chain(_) | Described::Linkage(_) => None,
    }
}

/// The robot file of the structure with this name.
pub fn structure_text(name: &str) -> Option<&'static str> {
    STRUCTURES.get_file(format!("{name}.toml"))?.contents_utf8()
}

/// The names of all linkages, sorted.
pub fn linkages() -> Vec<&'static str> {
    listed(&LINKAGES)
}

/// The linkage with this name; a test holds that every file can be read.
pub fn linkage(name: &str) -> Option<Linkage> {
    match read_robot(linkage_text(name)?).ok()?.0 {
        Described::Linkage(linkage) => Some(*linkage),
        Described::Chain(_) | Described::Tree(_) => None,
    }
}

/// The robot file of the linkage with this name.
pub fn linkage_text(name: &str) -> Option<&'static str> {
    LINKAGES.get_file(format!("{name}.toml"))?.contents_utf8()
}
