//! What a name stands for: an arm of the catalogue, or a file of some kind.

use crate::text::bytes;
use denavit::catalogue;
use denavit::description::{Language, TableKind, root_element};
use denavit_parallel::catalogue as parallel;
use std::path::Path;

/// The endings of files of bodies and joints, and those of others that are known.
const TREES: [&str; 4] = ["urdf", "xacro", "xml", "mjcf"];
const OTHERS: [&str; 11] = ["toml", "md", "markdown", "txt", "typ", "csv", "tsv", "tex", "par", "m", "py"];
/// How much of a file is looked at for its root element.
const HEAD: usize = 1 << 16;

/// Which endings files have, in words.
pub const ENDINGS: &str = "a robot file ends in .toml, .urdf, .xacro, .xml, .mjcf or .par, a table in .md, .txt, .csv, .tsv, .tex or .typ, a program in .m or .py";

/// What a file holds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A robot file.
    Robot,
    /// A document with a table.
    Table(TableKind),
    /// Bodies and joints: a URDF, plain or for xacro to expand, or a model of MuJoCo's.
    Bodies,
    /// Rows of a tree as SYMORO writes them.
    Par,
    /// A program that makes a robot.
    Program(Language),
}

impl Kind {
    /// By the ending of a file, or by its root element where the ending says nothing; `-` is standard input: bodies by
    /// its root element, a robot file by its heads, else a table.
    pub fn of(name: &str) -> Option<Self> {
        match Path::new(name).extension().and_then(|e| e.to_str()) {
            _ if name == "-" => Some(Kind::of_text(&head(name))),
            Some("toml") => Some(Kind::Robot),
            Some("md" | "markdown" | "txt" | "typ") => Some(Kind::Table(TableKind::Markdown)),
            Some("csv" | "tsv") => Some(Kind::Table(TableKind::Csv)),
            Some("tex") => Some(Kind::Table(TableKind::Latex)),
            _ if is_tree(name) => Some(Kind::Bodies),
            Some("par") => Some(Kind::Par),
            Some("m") => Some(Kind::Program(Language::Matlab)),
            Some("py") => Some(Kind::Program(Language::Python)),
            _ => None,
        }
    }

    /// What a text without a name holds: bodies by its root element, a robot file by its heads, else a table.
    pub fn of_text(text: &str) -> Self {
        // The head of an array of tables, as a robot file has one for each joint.
        let is_head = |line: &str| {
            let name = line.trim().strip_prefix("[[").and_then(|l| l.strip_suffix("]]"));
            name.is_some_and(|n| !n.is_empty() && n.chars().all(|c| c.is_ascii_lowercase() || c == '_'))
        };
        // A parallel robot's file says which of these it is.
        let kinds = ["\"gough-stewart\"", "\"delta\"", "\"planar-3rrr\""];
        let is_kind = |line: &str| {
            let value = line.trim().strip_prefix("kind").and_then(|l| l.trim_start().strip_prefix('='));
            value.is_some_and(|v| kinds.iter().any(|k| v.trim_start().starts_with(k)))
        };
        let is_robot = text.lines().any(|line| is_head(line) || is_kind(line));
        match () {
            () if has_bodies(text) => Kind::Bodies,
            () if is_robot => Kind::Robot,
            () => Kind::Table(TableKind::Markdown),
        }
    }
}

/// True for a file of bodies and joints: a URDF, or a model of MuJoCo's. Which, its root element says; that it is one, too, where its
/// ending says nothing.
pub fn is_tree(name: &str) -> bool {
    let path = Path::new(name);
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    let is_open = name == "-" || (!OTHERS.contains(&ending) && path.is_file());
    TREES.contains(&ending) || (is_open && has_bodies(&head(name)))
}

/// The beginning of a file or of standard input; nothing of what cannot be read.
fn head(name: &str) -> String {
    bytes(name, HEAD).map_or(String::new(), |b| String::from_utf8_lossy(&b).into_owned())
}

/// True for what begins as a file of bodies does.
fn has_bodies(text: &str) -> bool {
    matches!(root_element(text), Some("robot" | "mujoco" | "mujocoinclude" | "sdf"))
}

/// The catalogue's spelling: lower case, words joined by hyphens. `None` for what looks like a path.
pub fn catalogue_name(text: &str) -> Option<String> {
    let is_path = text.contains(['/', '\\', '.']) || text == "-";
    (!is_path).then(|| text.to_lowercase().replace([' ', '_'], "-"))
}

/// The file of an arm of the catalogue, or of a structure, a linkage or a parallel robot beside it.
pub fn listed(name: &str) -> Option<&'static str> {
    catalogue::text(name)
        .or_else(|| catalogue::structure_text(name))
        .or_else(|| catalogue::linkage_text(name))
        .or_else(|| parallel::text(name))
}

/// Names of the catalogue that may have been meant.
pub fn close_names(name: &str) -> Vec<&'static str> {
    let names = catalogue::names().into_iter().chain(catalogue::structures()).chain(catalogue::linkages());
    let names = names.chain(parallel::names());
    let mut close: Vec<&str> = names.filter(|n| similar(n, name)).collect();
    // What differs in signs alone is meant before all others.
    close.sort_by_key(|n| plain(n) != plain(name));
    close.truncate(6);
    close
}

/// Letters and digits alone.
fn plain(s: &str) -> String {
    s.to_lowercase().chars().filter(char::is_ascii_alphanumeric).collect()
}

/// Whether a catalogue name is what somebody may have meant: it holds the text, or most of its letters in order.
fn similar(candidate: &str, text: &str) -> bool {
    let (candidate, text) = (plain(candidate), plain(text));
    if text.len() < 2 {
        return false;
    }
    let mut rest = candidate.chars();
    let found = text.chars().filter(|&c| rest.clone().any(|r| r == c) && rest.any(|r| r == c)).count();
    candidate.contains(&text) || (found + 1 >= text.len() && text.len() + 3 >= candidate.len())
}
