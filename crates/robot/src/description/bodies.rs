//! Descriptions of bodies and joints, whichever of the formats they are in.

use super::sources::{Files, Sources};
use super::urdf::Reading;
use super::xml::root_element;
use super::{Decimals, read_mjcf, read_xacro};

/// True for a model of MuJoCo's, or a part of one.
pub fn is_mjcf(text: &str) -> bool {
    matches!(root_element(text), Some("mujoco" | "mujocoinclude"))
}

/// Reads a model of MuJoCo's where the root element says that it is one, else a URDF, with xacro expanded where there is any.
///
/// Arguments are names and values for xacro. Places are those of all files together ([`Files`]).
///
/// # Errors
/// All errors of the texts (with the warnings and notes).
pub fn read_bodies(
    name: &str,
    text: &str,
    sources: &mut dyn Sources,
    arguments: &[(String, String)],
    decimals: Decimals,
) -> (Reading, Files) {
    match is_mjcf(text) {
        true => read_mjcf(name, text, sources, decimals),
        false => read_xacro(name, text, sources, arguments, decimals),
    }
}
