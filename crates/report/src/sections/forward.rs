//! The forward model and its algorithm.

use super::setting::Setting;
use crate::derivation::Derivation;
use crate::document::Section;

/// Matrix, program, proof.
pub fn sections(s: &Setting) -> [Section; 2] {
    Derivation::of(&s.description, s.forward().clone()).sections(2, s.options.language)
}
