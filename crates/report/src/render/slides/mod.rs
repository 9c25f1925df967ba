//! A document as slides: what fits a screen, step by step.
//!
//! A slide begins with a heading or where the one before is full; one that goes on with a derivation shows the formula
//! that it goes on from. What does not fit, as a matrix with six rows of long entries, is set smaller by the formats.

mod html;
mod typst;

pub use html::slides as html;
pub use typst::slides as typst;

use super::layout::{Named, beside, display, equation, named};
use crate::document::{Block, Branch, Document, Figure, Line, Math, Part, Piece, Section, Table, plain};
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
/// So many lines of equations below each other come at once, and so many pictures.
const STRIDE: usize = 3;
const PICTURES: usize = 4;

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
    reminder: Option<Section>,
    /// What comes into view together, in order.
    steps: Vec<Section>,
}

/// The slides of a document, in order.
fn deck(document: &Document) -> Vec<Slide> {
    let mut out: Vec<Slide> = vec![];
    let mut title = Line::default();
    for section in &document.spelled() {
        let mut under = None;
        let mut parts: Vec<Shown> = vec![];
        for part in &section.parts {
            match part {
                Part::Block(Block::Heading(level, line)) => {
                    let own = run(&title, under.as_ref(), section, &std::mem::take(&mut parts));
                    under = match (level, under.take()) {
                        (..=2, _) => {
                            title = line.clone();
                            None
                        }
                        // A heading with nothing of its own stands before the first inside of it.
                        (4.., Some(Line(above))) if own.is_empty() => {
                            let mut line = line.clone();
                            line.0.splice(0..0, above.into_iter().chain([Piece::Text(": ".into())]));
                            Some(line)
                        }
                        _ => Some(line.clone()),
                    };
                    out.extend(own);
                }
                other => parts.extend(pieces(other, &section.names)),
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

/// A part that fits a slide, with the names of its formulas.
struct Shown {
    part: Part,
    names: Vocabulary,
}

impl Shown {
    fn height(&self) -> f64 {
        height(&self.part, &self.names)
    }
}

/// The slides with the same headings.
fn run(title: &Line, under: Option<&Line>, section: &Section, parts: &[Shown]) -> Vec<Slide> {
    let mut slides: Vec<(Option<Section>, Vec<Section>)> = vec![];
    let mut full = f64::INFINITY;
    let mut last: Option<&Shown> = None;
    let mut rest = parts;
    while let Some((first, behind)) = rest.split_first() {
        let count = if first.part.introduces(behind.first().map(|next| &next.part)) { 2 } else { 1 };
        let (step, behind) = rest.split_at(count);
        let height: f64 = step.iter().map(Shown::height).sum();
        if full + height > ROOM {
            let reminder = last.filter(|shown| is_formula(&shown.part) && shown.height() <= REMINDED);
            // What fills a slide has no room for more.
            let reminder = reminder.filter(|shown| shown.height() + height <= ROOM);
            full = reminder.map_or(0.0, Shown::height);
            slides.push((reminder.map(|shown| together(std::slice::from_ref(shown))), vec![]));
        }
        full += height;
        if let Some((_, steps)) = slides.last_mut() {
            steps.push(together(step));
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
        names: section.names.clone(),
        reminder,
        steps,
    };
    slides.into_iter().enumerate().map(slide).collect()
}

/// What comes together, under the names of the last, which are those of a text and more.
fn together(step: &[Shown]) -> Section {
    let names = step.last().map(|shown| shown.names.clone()).unwrap_or_default();
    Section { names, parts: step.iter().map(|shown| shown.part.clone()).collect() }
}

fn is_formula(part: &Part) -> bool {
    matches!(part, Part::Block(Block::Formula { .. }) | Part::Equations(_))
}

/// A part in pieces that fit a slide, where it can be cut.
fn pieces(part: &Part, names: &Vocabulary) -> Vec<Shown> {
    let own = |part: Part| Shown { part, names: names.clone() };
    let equations = |all: &[Math], names: &Vocabulary| {
        let of = |some: &[Math]| Shown { part: Part::Equations(some.to_vec()), names: names.clone() };
        in_strides(all, names).into_iter().map(of).collect::<Vec<_>>()
    };
    match part {
        Part::Block(block @ Block::Formula { .. }) => match named(block, names) {
            // The matrix, then what its names stand for.
            Some(Named { matrix, entries, names }) => {
                let mut all = vec![Shown { part: matrix.into(), names: names.clone() }];
                all.extend(equations(&entries, &names));
                all
            }
            None => vec![own(part.clone())],
        },
        Part::Block(Block::List(lines)) => {
            lines.iter().map(|l| own(Block::List(vec![l.clone()]).into())).collect()
        }
        Part::Equations(all) => equations(all, names),
        Part::Table(table) if table.rows.len() > ROWS => {
            let of = |rows: &[Vec<Line>]| own(Part::Table(Table { rows: rows.to_vec(), ..table.clone() }));
            table.rows.chunks(ROWS).map(of).collect()
        }
        Part::Figure(figure) if figure.pictures.len() > PICTURES => {
            let of = |some: &[_]| {
                own(Part::Figure(Figure { caption: figure.caption.clone(), pictures: some.to_vec() }))
            };
            figure.pictures.chunks(PICTURES).map(of).collect()
        }
        Part::Code(text) => {
            let lines: Vec<&str> = text.lines().collect();
            lines.chunks(LINES).map(|some| own(Part::Code(some.join("\n")))).collect()
        }
        other => vec![own(other.clone())],
    }
}

/// Equations that come at once: a few, or one that is long.
fn in_strides<'a>(all: &'a [Math], names: &Vocabulary) -> Vec<&'a [Math]> {
    let mut out = vec![];
    let mut rest = all;
    while !rest.is_empty() {
        let mut count = 1;
        let mut height = lines(&rest[0], names);
        while count < rest.len().min(STRIDE) && height + lines(&rest[count], names) <= STRIDE as f64 {
            height += lines(&rest[count], names);
            count += 1;
        }
        let (some, behind) = rest.split_at(count);
        out.push(some);
        rest = behind;
    }
    out
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
