//! The arm as it looks, and as a line diagram.

use super::setting::Setting;
use crate::document::{Part, Section};
use crate::figure::{self, Options, isometric};

/// Both pictures; nothing if the arm cannot be drawn.
pub fn section(s: &Setting) -> Option<Section> {
    let arm = s.arm.as_ref()?;
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, s.line("The arm", "Le bras"));
    if let Some(assumed) = s.assumed() {
        section.paragraph(assumed);
    }
    let mut caption =
        s.line("The arm with its frames and lengths, at ", "Le bras, ses repères et ses longueurs, pour ");
    caption.0.extend(s.configuration(&s.q).0);
    caption = caption.text(s.say(
        ". Cylinders turn, boxes slide; x axes red, z axes blue.",
        ". Un cylindre tourne, une boîte coulisse ; axes x en rouge, axes z en bleu.",
    ));
    section.push(Part::figure(s.language, isometric(arm, &Options::main()), caption));
    let caption = s.line(
        "Line diagram: the axes of the joints, their variables and the lengths between them.",
        "Schéma cinématique : axes des articulations, variables et longueurs.",
    );
    section.push(Part::figure(s.language, figure::scheme(arm, &Options::main()), caption));
    Some(section)
}
