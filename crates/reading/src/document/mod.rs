//! The statements of a document: its equations and matrices, found by their text alone.
//!
//! Nothing here knows robots or what a name means. Every span is bytes of the original text, so that whatever is
//! said about a formula can point at it; [`formula`] gives a span's text ready for reading, at the same places.

mod chain;
mod drawn;
mod grid;
mod inline;
mod keyed;
mod lexer;
mod lines;
mod marks;
mod prose;
mod scan;
mod sides;
mod statements;
mod tree;
mod words;

pub use lexer::Relation;
pub use scan::closing_brace;
pub use sides::{formula, sides};

use std::ops::Range;

/// What a document states.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Document {
    /// In the order of the text.
    pub statements: Vec<Statement>,
    /// The programs between the text, which are not read.
    pub code: Vec<CodeBlock>,
    /// Directives behind the last statement.
    pub directives: Vec<Directive>,
    /// What could not be read, in the order of the text.
    pub notes: Vec<Note>,
}

/// Sides that are said to be equal, or one matrix on its own.
#[derive(Clone, PartialEq, Debug)]
pub struct Statement {
    /// From the first side to the last.
    pub span: Range<usize>,
    /// At least one; in order.
    pub sides: Vec<Side>,
    /// Between the sides: one fewer than these.
    pub relations: Vec<Relation>,
    /// The comments before it that are meant for the checker, and those behind it on its line.
    pub directives: Vec<Directive>,
    /// The last heading before it.
    pub heading: Option<Range<usize>>,
    /// The last prose before it: on its line, or else the last line of it.
    pub prose: Option<Range<usize>>,
    /// `t11` of `- t11: a + b = c`, or `3` of `(3) a = b`.
    pub label: Option<Range<usize>>,
    /// The word that joins it to the statement before on its line: `and`, `or`, `\Rightarrow`.
    pub link: Option<Range<usize>>,
    /// What stands behind it and is no part of it: `\quad (0.5pt)`, `\text{if } s_5 > 0`.
    pub aside: Option<Range<usize>>,
    /// Where it stands.
    pub place: Place,
    /// It was cut off the statement before, or the statement behind was cut off it, between a matrix and a name
    /// with nothing between them: `A = [..] B = [..]`. It may also have been meant as a product.
    pub juxtaposed: bool,
}

/// Where a statement stands.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Place {
    /// A formula set off from the text, or in a fence.
    Display,
    /// A formula in a line of prose.
    Inline,
    /// Between backquotes.
    Code,
    /// A line of its own without marks.
    Line,
    /// A key and its value.
    Key,
    /// Values in brackets that a sentence tells of something: `the tip is at (0.3, 0.4)`.
    Told,
}

/// One side of a statement: its parts are multiplied where no operator stands between them.
#[derive(Clone, PartialEq, Debug)]
pub struct Side {
    /// From the first part to the last; empty if nothing is written.
    pub span: Range<usize>,
    /// In order. Two texts that follow one another are one formula in two places.
    pub parts: Vec<Part>,
}

/// A piece of a side.
#[derive(Clone, PartialEq, Debug)]
pub enum Part {
    /// Names, operators, formulas.
    Text(Range<usize>),
    /// A matrix.
    Matrix(Grid),
}

/// A matrix as it is written.
#[derive(Clone, PartialEq, Debug)]
pub struct Grid {
    /// With its brackets and the name under it.
    pub span: Range<usize>,
    /// What stands around it.
    pub fence: Fence,
    /// The cells; rows may differ in length, cells may be empty or say `.`, `*`, `\cdots`.
    pub rows: Vec<Vec<Range<usize>>>,
    /// What is written under it: `T_{45}` of `\underbrace{…}_{T_{45}}`.
    pub under: Option<Range<usize>>,
}

/// The brackets around a matrix.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Fence {
    /// `[ ]`
    Square,
    /// `( )`
    Round,
    /// `| |`: a determinant.
    Bars,
    /// `{ }`, also those of `cases`, whose second column may be conditions.
    Braces,
    /// None, as in a table.
    None,
}

/// A comment for the checker: `<!-- check: claim T06 -->`, `% check: …`, `# check: …`, `// check: …`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Directive {
    /// The words.
    pub span: Range<usize>,
    /// What stands behind `check:`, with single blanks.
    pub words: String,
}

/// A program in the text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CodeBlock {
    /// Its lines.
    pub span: Range<usize>,
    /// As named at the fence, in small letters: `python`, `matlab`.
    pub language: String,
    /// The directives before it.
    pub directives: Vec<Directive>,
}

/// What could not be read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Note {
    /// Where.
    pub span: Range<usize>,
    /// What.
    pub message: String,
    /// What would help.
    pub hint: String,
}

/// How a text is written.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Format {
    /// With formulas between `$`, in fences, or on lines of their own.
    Markdown,
    /// A whole LaTeX file, or a part of one.
    Latex,
    /// Formulas on lines of their own.
    Plain,
    /// Keys with formulas and matrices as values.
    Toml,
}

/// The most statements that are read.
pub(crate) const MAX_STATEMENTS: usize = 20_000;
/// The longest formula that is read, in bytes.
pub(crate) const MAX_FORMULA: usize = 1 << 18;
const MAX_NOTES: usize = 1000;

/// Reads the statements of `text`.
pub fn read(text: &str, format: Format) -> Document {
    let mut reader = statements::Reader::new(text);
    match format {
        Format::Toml => keyed::read(&mut reader),
        _ => scan::read(&mut reader, format),
    }
    reader.finish(format)
}

/// The text of a document as it is read, places in it being those that are told: a document of Typst is one of Markdown.
pub fn readable(file_name: &str, text: String) -> String {
    let is_typst = file_name.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case("typ"));
    if is_typst { crate::typst::markdown(&text) } else { text }
}

impl Format {
    /// By the file's ending, or else by what the text looks like.
    pub fn of(file_name: &str, text: &str) -> Format {
        let ending = file_name.rsplit_once('.').map_or("", |(_, e)| e).to_ascii_lowercase();
        match ending.as_str() {
            // What is read of Typst is Markdown: see [`readable`].
            "md" | "markdown" | "mdx" | "qmd" | "rmd" | "mkd" | "typ" => return Format::Markdown,
            "tex" | "latex" | "ltx" => return Format::Latex,
            "toml" => return Format::Toml,
            _ => {}
        }
        let line_begins = |start: &str| text.lines().any(|l| l.trim_start().starts_with(start));
        if text.contains("\\documentclass") || text.contains("\\begin{document}") {
            Format::Latex
        } else if text.contains("$$") || line_begins("```") || line_begins("# ") || line_begins("## ") {
            Format::Markdown
        } else if lexer::DISPLAYS.iter().any(|d| text.contains(&format!("\\begin{{{d}}}")))
            || line_begins("\\section")
            || line_begins("\\[")
        {
            Format::Latex
        } else if text.contains('$') {
            Format::Markdown
        } else {
            Format::Plain
        }
    }
}

impl Grid {
    fn new(span: Range<usize>, fence: Fence, rows: Vec<Vec<Range<usize>>>) -> Grid {
        Grid { span, fence, rows, under: None }
    }
}

/// `text[span]`, or nothing where that would cut a character.
fn cut<'t>(text: &'t str, span: &Range<usize>) -> &'t str {
    text.get(span.clone()).unwrap_or("")
}
