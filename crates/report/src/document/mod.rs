//! Documents in no format: a tree of headings, paragraphs and formulas, and what only a report has.
//!
//! [`text`] is such a tree for a terminal, [`math()`] a formula in any style, [`laid`] one in lines that fit a page.

mod text;

pub use crate::tree::{
    Block, Branch, BrokenLine, Factor, Laid, Line, Math, Piece, Proof, Sign, aligned, laid, math,
    matrix_width,
};
pub use text::{Mark, plain, text};

use crate::figure::drawing::Drawing;
use crate::words::{Tongue, Wording};
use denavit_symbolic::vocabulary::Vocabulary;

/// A document in no format.
#[derive(Clone, Debug)]
pub struct Document {
    /// The title, plain words.
    pub title: String,
    /// Who hands it in, plain words.
    pub author: Option<String>,
    /// The language of the words.
    pub language: Tongue,
    /// The parts, in order.
    pub sections: Vec<Section>,
}

/// Parts whose formulas use the same names.
#[derive(Clone, Debug)]
pub struct Section {
    /// How angles are numbered and which names are symbols.
    pub names: Vocabulary,
    /// In order.
    pub parts: Vec<Part>,
}

/// A part of a document.
#[derive(Clone, Debug)]
pub enum Part {
    /// What explanations are made of.
    Block(Block),
    /// Equations below each other, aligned at their signs.
    Equations(Vec<Math>),
    /// Formulas beside each other, as many as fit.
    Beside(Vec<Math>),
    /// What a reader should see first: labels and values.
    Summary(Vec<(Line, Line)>),
    /// Rows and columns.
    Table(Table),
    /// One picture, or several side by side.
    Figure(Figure),
    /// Text that is set as it stands.
    Code(String),
}

/// Rows and columns.
#[derive(Clone, Debug)]
pub struct Table {
    /// What it shows.
    pub caption: Line,
    /// The heading of each column.
    pub head: Vec<Line>,
    /// One cell a column.
    pub rows: Vec<Vec<Line>>,
}

/// Pictures with a caption.
#[derive(Clone, Debug)]
pub struct Figure {
    /// What it shows.
    pub caption: Line,
    /// The pictures, each with a caption of its own where there are several.
    pub pictures: Vec<(Drawing, Line)>,
}

impl Document {
    /// The parts, with names that spell numbers as the language of the document does.
    pub(crate) fn spelled(&self) -> Vec<Section> {
        let spelled =
            |s: &Section| Section { names: self.language.spelled(&s.names), parts: s.parts.clone() };
        self.sections.iter().map(spelled).collect()
    }

    /// Whether there are pictures in it.
    pub fn has_figures(&self) -> bool {
        self.sections.iter().flat_map(|s| &s.parts).any(|part| matches!(part, Part::Figure(_)))
    }
}

impl Part {
    /// Whether it introduces what follows: a page does not end between the two.
    pub(crate) fn introduces(&self, next: Option<&Part>) -> bool {
        let is_shown = |next: &Part| !matches!(next, Part::Block(Block::Paragraph(_) | Block::Heading(..)));
        matches!(self, Part::Block(Block::Paragraph(_))) && next.is_some_and(is_shown)
    }
}

impl From<Block> for Part {
    fn from(block: Block) -> Self {
        Part::Block(block)
    }
}

impl Section {
    /// A section without parts.
    pub fn new(names: Vocabulary) -> Self {
        Section { names, parts: vec![] }
    }

    /// A part more.
    pub fn push(&mut self, part: impl Into<Part>) {
        self.parts.push(part.into());
    }

    /// A heading: level 2 for sections of a document, 3 inside.
    pub fn heading(&mut self, level: u8, line: Line) {
        self.push(Block::Heading(level, line));
    }

    /// Running text.
    pub fn paragraph(&mut self, line: Line) {
        self.push(Block::Paragraph(line));
    }

    /// A formula on lines of its own.
    pub fn formula(&mut self, math: Math) {
        self.push(Block::Formula { math, number: None, proof: None });
    }
}

impl Part {
    /// One picture; its caption says what is to be seen, for those who do not see it, too.
    pub fn figure(words: &dyn Wording, drawing: Drawing, caption: Line) -> Self {
        Part::figures(words, vec![(drawing, Line::default())], caption)
    }

    /// Pictures side by side, each with a caption of its own.
    pub fn figures(words: &dyn Wording, mut pictures: Vec<(Drawing, Line)>, caption: Line) -> Self {
        let names = Vocabulary::new().decimal_comma(words.has_decimal_comma());
        for (drawing, own) in &mut pictures {
            drawing.write_numbers(&|text| words.written(text));
            let own = plain(own, &names);
            let whole = plain(&caption, &names);
            drawing.description = if own.is_empty() { whole } else { words.picture(&own, &whole) };
        }
        Part::Figure(Figure { caption, pictures })
    }
}
