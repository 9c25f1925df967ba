//! Slides as one page of HTML that needs nothing else. Without its program all slides stand below each other.

use super::{Pace, Slide, deck, place};
use crate::document::{Block, Document, Part, Section};
use crate::render::html::{Writer, escaped, font, head, words};
use std::fmt::Write;

const LOOK: &str = include_str!("../../../assets/slides.css");
const PROGRAM: &str = include_str!("../../../assets/slides.js");

/// The slides of a document.
pub fn slides(document: &Document, pace: Pace) -> String {
    let said = document.language.words();
    let mut out = head(document, &font(), LOOK);
    let author = document.author.as_deref();
    let author = author.map_or_else(String::new, |a| format!("<p class=\"author\">{}</p>\n", escaped(a)));
    let pace = match pace {
        Pace::Steps => "steps",
        Pace::Whole => "whole",
    };
    let _ = writeln!(
        out,
        "<body>\n<main class=\"slides\" data-pace=\"{pace}\">\n<section class=\"slide first\">\n<h1>{}</h1>\n{author}</section>",
        escaped(&document.title)
    );
    let mut writer = Writer::new(said);
    for slide in &deck(document) {
        one(slide, &mut writer);
    }
    out += &writer.out;
    let [before, next] = said.turning();
    let _ = writeln!(
        out,
        "</main>\n<nav class=\"turning\" hidden=\"hidden\">\n\
         <button type=\"button\" class=\"before\" aria-label=\"{before}\">‹</button>\n\
         <output class=\"place\" aria-live=\"off\"></output>\n\
         <button type=\"button\" class=\"next\" aria-label=\"{next}\">›</button>\n</nav>\n\
         <script>\n//<![CDATA[\n{PROGRAM}//]]>\n</script>\n</body>\n</html>"
    );
    out
}

fn one(slide: &Slide, writer: &mut Writer) {
    let names = &slide.names;
    let under =
        slide.under.as_ref().map_or_else(String::new, |u| format!(" <small>{}</small>", words(u, names)));
    let place = place(slide.place);
    let place = if place.is_empty() { place } else { format!(" <span class=\"part\">{place}</span>") };
    let has_picture = |section: &Section| section.parts.iter().any(|p| matches!(p, Part::Figure(_)));
    // A picture fills what the rest of its slide leaves; words alone stand beside it.
    let is_words = |part: &Part| matches!(part, Part::Block(Block::Paragraph(_)) | Part::Figure(_));
    let has_words = slide.steps.iter().map(|s| s.parts.len()).sum::<usize>() > 1;
    let is_beside = slide.reminder.is_none() && slide.steps.iter().all(|s| s.parts.iter().all(is_words));
    let filled = match slide.steps.iter().any(has_picture) {
        true if is_beside && has_words => " filled beside-words",
        true => " filled",
        false => "",
    };
    let _ = writeln!(
        writer.out,
        "<section class=\"slide\">\n<h2>{}{under}{place}</h2>\n<div class=\"body{filled}\">",
        words(&slide.title, names)
    );
    let mut set = |class: &str, section: &Section| {
        let _ = writeln!(writer.out, "<div class=\"{class}\">");
        writer.section(section);
        writer.out.push_str("</div>\n");
    };
    if let Some(section) = &slide.reminder {
        set("reminder", section);
    }
    for step in &slide.steps {
        set(if has_picture(step) { "step picture" } else { "step" }, step);
    }
    writer.out.push_str("</div>\n</section>\n");
}
