//! An explanation in each format: text, LaTeX, Typst, Markdown, HTML.

use crate::arguments::Format;
use crate::terminal::{FAINT, HEADING, NAME, styled};
use denavit_report::document::{Block, Mark, Math, text};
use denavit_report::words::Tongue;
use denavit_report::{Document, Part, Section, render};
use denavit_symbolic::vocabulary::Vocabulary;

/// The document, which is in a language, with a title for the page; JSON is not made here.
pub fn document_in(
    language: Tongue,
    title: &str,
    names: &Vocabulary,
    blocks: &[Block],
    format: Format,
) -> String {
    if matches!(format, Format::Terminal | Format::Json) {
        return text(blocks, names, language, &coloured);
    }
    // The page has its title.
    let parts = blocks.iter().filter(|b| !matches!(b, Block::Heading(1, _))).cloned().map(Part::from);
    let section = Section { names: names.clone(), parts: parts.collect() };
    let document = Document { title: title.into(), author: None, language, sections: vec![section] };
    written(&document, format)
}

fn coloured(mark: Mark, words: &str) -> String {
    let style = match mark {
        Mark::Heading => HEADING,
        Mark::Strong => NAME,
        Mark::Faint => FAINT,
    };
    styled(words, style)
}

/// A document tree of headings, words and formulas as text.
fn shown(document: &Document) -> String {
    let mut out = format!("{}\n", styled(&document.title, HEADING));
    for section in &document.sections {
        let formula = |math: &Math| Block::Formula { math: math.clone(), number: None, proof: None };
        let blocks: Vec<Block> = section
            .parts
            .iter()
            .flat_map(|part| match part {
                Part::Block(block) => vec![block.clone()],
                Part::Equations(all) | Part::Beside(all) => all.iter().map(formula).collect(),
                Part::Summary(_) | Part::Table(_) | Part::Figure(_) | Part::Code(_) => vec![],
            })
            .collect();
        out += &text(&blocks, &section.names, document.language, &coloured);
    }
    out
}

/// A document tree in a format; on a terminal what it has beside tables and pictures.
pub fn written(document: &Document, format: Format) -> String {
    match format {
        Format::Terminal => shown(document),
        Format::Latex => render::latex_fragment(document),
        Format::Typst => render::typst_fragment(document),
        Format::Markdown => render::markdown(document, "figures").text,
        Format::Html | Format::Json => render::html(document),
    }
}
