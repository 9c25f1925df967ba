//! Where the page is served.

use crate::Schema;
use serde::Serialize;

/// An address.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Served {
    /// The version.
    pub schema: Schema,
    /// Where the page is, for the browser of this machine.
    pub url: String,
}

/// A description of a tree as the page opens it: the answer of `tree` of its engine is what the page draws.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Bundle {
    /// What xacro is given.
    pub arguments: Vec<(String, String)>,
    /// Whether angles are read as they are written.
    pub as_written: bool,
    /// The link that the chain begins at, if one was named.
    pub base: Option<String>,
    /// The convention of the table, if one was named.
    pub convention: Option<&'static str>,
    /// The meshes: their paths, the addresses that they are served at, their sizes in bytes.
    pub meshes: Vec<(String, String, usize)>,
    /// The path of the description.
    pub name: String,
    /// The packages that were found, by name.
    pub packages: Vec<(String, String)>,
    /// The texts that were read, by path; the description is among them.
    pub texts: Vec<(String, String)>,
    /// The link that the chain ends at, if one was named.
    pub tip: Option<String>,
}
