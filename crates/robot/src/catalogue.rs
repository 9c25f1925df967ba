//! Robots that people own or study, each a robot file with its source.

use crate::description::{Description, read_toml};
use include_dir::{Dir, include_dir};

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/catalogue");

/// The names of all robots, sorted.
pub fn names() -> Vec<&'static str> {
    let mut names: Vec<&str> = FILES.files().filter_map(|f| f.path().file_stem()?.to_str()).collect();
    names.sort_unstable();
    names
}

/// The robot file with this name.
pub fn text(name: &str) -> Option<&'static str> {
    FILES.get_file(format!("{name}.toml"))?.contents_utf8()
}

/// The robot with this name; a test holds that every file can be read.
pub fn robot(name: &str) -> Option<Description> {
    read_toml(text(name)?).ok().map(|(description, _)| description)
}
