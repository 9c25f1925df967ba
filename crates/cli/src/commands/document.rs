//! An explanation in each format: text, LaTeX, Typst, Markdown, HTML.

use crate::arguments::Format;
use crate::terminal::{FAINT, HEADING, NAME, styled};
use denavit_report::document::{Block, Mark, text};
use denavit_report::words::Tongue;
use denavit_report::{Document, Part, Section, render};
use denavit_symbolic::vocabulary::Vocabulary;

/// The document in English, with a title for the page; JSON is not made here.
pub fn document(title: &str, names: &Vocabulary, blocks: &[Block], format: Format) -> String {
    document_in(Tongue::English, title, names, blocks, format)
}

/// The document, which is in a language.
pub fn document_in(
    language: Tongue,
    title: &str,
    names: &Vocabulary,
    blocks: &[Block],
    format: Format,
) -> String {
    if matches!(format, Format::Terminal | Format::Json) {
        return text(blocks, names, language, &|mark, words| {
            let style = match mark {
                Mark::Heading => HEADING,
                Mark::Strong => NAME,
                Mark::Faint => FAINT,
            };
            styled(words, style)
        });
    }
    // The page has its title.
    let parts = blocks.iter().filter(|b| !matches!(b, Block::Heading(1, _))).cloned().map(Part::from);
    let section = Section { names: names.clone(), parts: parts.collect() };
    let document = Document { title: title.into(), author: None, language, sections: vec![section] };
    written(&document, format)
}

/// A document tree in a format that is not for a terminal.
pub fn written(document: &Document, format: Format) -> String {
    match format {
        Format::Latex => render::latex_fragment(document),
        Format::Typst => render::typst_fragment(document),
        Format::Markdown => render::markdown(document, "figures").text,
        Format::Html | Format::Terminal | Format::Json => render::html(document),
    }
}
