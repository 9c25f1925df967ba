//! A document as slides: what fits a screen, step by step.
//!
//! A slide begins with a heading or where the one before is full; one that goes on with a derivation shows the formula
//! that it goes on from. What does not fit, as a matrix with six rows of long entries, is set smaller by the formats.

mod html;
mod typst;

pub use html::slides as html;
pub use typst::slides as typst;

use super::layout::{beside, display, equation, named};
use crate::document::{Block, Branch, Document, Figure, Line, Math, Part, Section, Table, plain};
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;

/// How a talk goes from slide to slide.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Pace {
    /// A formula or a paragraph at a time.
    #[default]
    Steps,
    /// Whole slides.
    Whole,
}

/// What fits a slide, lines of text.
const ROOM: f64 = 13.0;
/// Of a formula with more lines the next slide does not remind.
const REMINDED: f64 = 4.0;
/// Characters of a line of text.
const LETTERS: f64 = 84.0;
/// Rows of a table on one slide, and lines of text that is set as it stands.
const ROWS: usize = 12;
const LINES: usize = 16;
/// So many equations below each other come at once.
const STRIDE: usize = 3;

/// A slide.
struct Slide {
    /// The heading of its section, and that inside of it.
    title: Line,
    under: Option<Line>,
    /// Whether it is the first of its section.
    opens: bool,
    /// Which one it is of those with its headings, and of how many.
    place: (usize, usize),
    names: Vocabulary,
    /// What the slide before ended with.
    reminder: Option<Part>,
    /// What comes into view together, in order.
    steps: Vec<Vec<Part>>,
}

/// The slides of a document, in order.
fn deck(document: &Document) -> Vec<Slide> {
    let mut out: Vec<Slide> = vec![];
    let mut title = Line::default();
    for section in &document.spelled() {
        let mut under = None;
        let mut parts: Vec<Part> = vec![];
        for part in &section.parts {
            match part {
                Part::Block(Block::Heading(level, line)) => {
                    out.extend(run(&title, under.as_ref(), section, &std::mem::take(&mut parts)));
                    match level {
                        ..=2 => (title, under) = (line.clone(), None),
                        _ => under = Some(line.clone()),
                    }
                }
                other => parts.extend(pieces(other)),
            }
        }
        out.extend(run(&title, under.as_ref(), section, &parts));
    }
    let mut before = None;
    for slide in &mut out {
        let title = plain(&slide.title, &slide.names);
        slide.opens = before.as_ref() != Some(&title);
        before = Some(title);
    }
    out
}

/// The slides with the same headings.
fn run(title: &Line, under: Option<&Line>, section: &Section, parts: &[Part]) -> Vec<Slide> {
    let names = &section.names;
    let mut slides: Vec<(Option<Part>, Vec<Vec<Part>>)> = vec![];
    let mut full = f64::INFINITY;
    let mut last: Option<&Part> = None;
    let mut rest = parts;
    while let Some((first, behind)) = rest.split_first() {
        let count = if first.introduces(behind.first()) { 2 } else { 1 };
        let (step, behind) = rest.split_at(count);
        let height: f64 = step.iter().map(|part| height(part, names)).sum();
        if full + height > ROOM {
            let reminder = last.filter(|part| is_formula(part) && self::height(part, names) <= REMINDED);
            full = reminder.map_or(0.0, |part| self::height(part, names));
            // What fills a slide has no room for more.
            let reminder = reminder.filter(|_| full + height <= ROOM);
            slides.push((reminder.cloned(), vec![]));
        }
        full += height;
        if let Some((_, steps)) = slides.last_mut() {
            steps.push(step.to_vec());
        }
        last = step.last();
        rest = behind;
    }
    let count = slides.len();
    let slide = |(k, (reminder, steps))| Slide {
        title: title.clone(),
        under: under.cloned(),
        opens: false,
        place: (k + 1, count),
        names: names.clone(),
        reminder,
        steps,
    };
    slides.into_iter().enumerate().map(slide).collect()
}

fn is_formula(part: &Part) -> bool {
    matches!(part, Part::Block(Block::Formula { .. }) | Part::Equations(_))
}

/// A part in pieces that fit a slide, where it can be cut.
fn pieces(part: &Part) -> Vec<Part> {
    match part {
        Part::Block(Block::List(lines)) => {
            lines.iter().map(|l| Block::List(vec![l.clone()]).into()).collect()
        }
        Part::Equations(all) => all.chunks(STRIDE).map(|some| Part::Equations(some.to_vec())).collect(),
        Part::Table(table) if table.rows.len() > ROWS => {
            let of = |rows: &[Vec<Line>]| Part::Table(Table { rows: rows.to_vec(), ..table.clone() });
            table.rows.chunks(ROWS).map(of).collect()
        }
        Part::Figure(figure) if figure.pictures.len() > 4 => {
            let of = |some: &[_]| {
                Part::Figure(Figure { caption: figure.caption.clone(), pictures: some.to_vec() })
            };
            figure.pictures.chunks(4).map(of).collect()
        }
        Part::Code(text) => {
            let lines: Vec<&str> = text.lines().collect();
            lines.chunks(LINES).map(|some| Part::Code(some.join("\n"))).collect()
        }
        other => vec![other.clone()],
    }
}

/// How much of a slide a part takes, lines of text.
fn height(part: &Part, names: &Vocabulary) -> f64 {
    match part {
        Part::Block(block) => height_of(block, names),
        Part::Equations(all) => 0.5 + all.iter().map(|m| 1.25 * lines(m, names)).sum::<f64>(),
        Part::Beside(all) => {
            let row = |row: &Vec<&Math>| row.iter().map(|m| 0.5 + 1.35 * rows(m)).fold(1.5, f64::max);
            beside(all, names).iter().map(row).sum()
        }
        Part::Summary(rows) => {
            let row = |(label, value): &(Line, Line)| text(value, names, 60.0).max(text(label, names, 24.0));
            1.0 + rows.iter().map(row).sum::<f64>()
        }
        Part::Table(table) => 3.0 + 1.15 * table.rows.len() as f64,
        // With its caption it has a slide for itself.
        Part::Figure(_) => ROOM - 2.5,
        Part::Code(of) => 0.5 + 0.8 * of.lines().count() as f64,
    }
}

fn height_of(block: &Block, names: &Vocabulary) -> f64 {
    if let Some(named) = named(block, names) {
        let entries = named.entries.iter().map(|m| 1.4 * lines(m, &named.names)).sum::<f64>();
        return entries + height_of(&named.matrix, &named.names);
    }
    match block {
        Block::Heading(..) => 0.0,
        Block::Paragraph(line) => 0.4 + text(line, names, LETTERS),
        Block::Formula { math, .. } if rows(math) > 1.0 => 0.6 + 1.35 * rows(math),
        Block::Formula { math, .. } => 0.6 + 1.4 * display(math, names, Style::Latex).lines.len() as f64,
        Block::List(all) => all.iter().map(|line| 0.3 + text(line, names, LETTERS)).sum(),
        Block::Tree(branch) => branches(branch, names),
    }
}

fn branches(branch: &Branch, names: &Vocabulary) -> f64 {
    text(&branch.line, names, LETTERS) + branch.children.iter().map(|b| branches(b, names)).sum::<f64>()
}

fn text(line: &Line, names: &Vocabulary, letters: f64) -> f64 {
    (plain(line, names).chars().count() as f64 / letters).ceil()
}

/// Lines of one of several equations.
fn lines(m: &Math, names: &Vocabulary) -> f64 {
    equation(m, names, Style::Latex).lines.len() as f64
}

/// Rows of a matrix; 1 of what is none.
fn rows(m: &Math) -> f64 {
    match m {
        Math::Matrix(_, rows) => rows.len() as f64,
        Math::Numbers(_, rows) => rows.len() as f64,
        _ => 1.0,
    }
}

/// Where a slide stands among those with its headings; nothing if it is the only one.
fn place((k, of): (usize, usize)) -> String {
    if of > 1 { format!("{k}/{of}") } else { String::new() }
}
