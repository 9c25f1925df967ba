//! The link transforms.

use super::setting::Setting;
use crate::document::Section;
use denavit::forward::link_transforms;

/// A matrix a row of the table.
pub fn section(s: &Setting) -> Section {
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, s.line("Link transforms", "Matrices de passage"));
    section.push(crate::derivation::transforms(&link_transforms(s.description)));
    section
}
