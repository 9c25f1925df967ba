//! Parallel robots that come with the program, each a file with its source.

use denavit::description::parallel::Parallel;
use denavit::description::read_parallel;

/// Names and texts, in the order of the names.
const FILES: [(&str, &str); 5] = [
    ("dietmaier", include_str!("../catalogue/dietmaier.toml")),
    ("linear-delta", include_str!("../catalogue/linear-delta.toml")),
    ("octahedral-hexapod", include_str!("../catalogue/octahedral-hexapod.toml")),
    ("planar-3rrr", include_str!("../catalogue/planar-3rrr.toml")),
    ("rotary-delta", include_str!("../catalogue/rotary-delta.toml")),
];

/// All names.
pub fn names() -> impl Iterator<Item = &'static str> {
    FILES.into_iter().map(|f| f.0)
}

/// The file with this name.
pub fn text(name: &str) -> Option<&'static str> {
    FILES.into_iter().find(|f| f.0 == name).map(|f| f.1)
}

/// The robot with this name; a test holds that every file can be read.
pub fn robot(name: &str) -> Option<Parallel> {
    read_parallel(text(name)?)?.ok().map(|read| read.0)
}
