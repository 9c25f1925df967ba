//! Exercises for systems that ask and mark by themselves: Moodle, PrairieLearn, Jupyter with nbgrader.
//!
//! Numbers become fields that the system marks, with a tolerance; formulas are left to a teacher, who has the solution beside
//! them, and to `denavit check`.

mod html;
mod moodle;
mod notebook;
mod prairielearn;

pub use moodle::moodle;
pub use notebook::notebook;
pub use prairielearn::prairielearn;

use super::Exercise;
use super::sheet::{Field, Question};
use crate::document::{Block, Document, Part, Section};
use crate::render;

/// Answers are right within this share of their value.
const SHARE: f64 = 0.005;
/// And this beside it: of angles in degrees, of others.
const LEAST: [f64; 2] = [0.05, 0.001];

impl Field {
    /// How far an answer may be off wherever it is: that, and what the digits of what is given do to it.
    fn least(&self) -> f64 {
        LEAST[usize::from(self.unit != "°")] + self.within
    }

    /// How far an answer may be off.
    fn tolerance(&self) -> f64 {
        SHARE * self.value.abs() + self.least()
    }
}

/// A number without an exponent, as it is written.
fn written(x: f64) -> String {
    let text = format!("{x:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// A document in Markdown without its title, and its figures by the names that it has for them.
fn body(document: &Document) -> render::Markdown {
    let mut made = render::markdown(document, "figures");
    // Blanks of no width keep words and formulas together where formulas are set by others.
    let text = made.text.replace('\u{200b}', "");
    made.text = text.split_once("\n\n").map_or("", |(_, rest)| rest).to_string();
    made
}

/// The tasks that are marked by a teacher: they ask for formulas, alone or beside numbers.
fn by_hand(e: &Exercise) -> impl Iterator<Item = &Question> {
    e.questions.iter().filter(|q| q.fields.is_empty() || q.has_formulas)
}

/// The words of a task, in Markdown.
fn asked(e: &Exercise, question: &Question) -> String {
    let mut section = Section::new(question.names.clone());
    section.push(Part::Block(Block::Paragraph(question.words.clone())));
    let document =
        Document { title: "-".into(), author: None, language: e.options.language, sections: vec![section] };
    body(&document).text.trim().to_string()
}

/// The answer to a task, in Markdown.
fn answer(e: &Exercise, question: &Question) -> String {
    let document = Document {
        title: "-".into(),
        author: None,
        language: e.options.language,
        sections: question.answer.clone(),
    };
    body(&document).text
}

/// What tells exercises apart: 128 bits of their kind, seed and robot.
fn mark(e: &Exercise) -> [u64; 2] {
    let text = format!(
        "{} {} {} {}",
        e.options.kind.name(),
        e.options.seed,
        e.options.count,
        body(&e.statement).text
    );
    // Two sums after Fowler, Noll and Vo.
    [0xcbf2_9ce4_8422_2325_u64, 0x6c62_272e_07bb_0142].map(|start| {
        text.bytes().fold(start, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    })
}

/// A text in quotation marks, as JSON has it.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out += "\\\"",
            '\\' => out += "\\\\",
            '\n' => out += "\\n",
            c if c.is_control() => out += &format!("\\u{:04x}", c as u32),
            c => out.push(c),
        }
    }
    out + "\""
}
