//! The arm as it looks, and as a line diagram.

use super::setting::Setting;
use crate::document::{Line, Part, Section};
use crate::figure::{self, FigureOptions, isometric};
use crate::words::{Caption, Heading};

/// Both pictures; nothing if the arm cannot be drawn.
pub fn section(s: &Setting) -> Option<Section> {
    let arm = s.arm.as_ref()?;
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, Line::new(s.words().heading(Heading::Arm)));
    if let Some(assumed) = s.assumed() {
        section.paragraph(assumed);
    }
    let look = if s.options.for_slides { FigureOptions::slide() } else { FigureOptions::main() };
    let caption = s.words().arm_caption(s.configuration(&s.q));
    section.push(Part::figure(s.words(), isometric(arm, &look), caption));
    let caption = Line::new(s.words().caption(Caption::Scheme));
    section.push(Part::figure(s.words(), figure::scheme(arm, &look), caption));
    Some(section)
}
