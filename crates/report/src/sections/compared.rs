//! Several robots beside each other: at a glance, in pictures, by their tables and by what they reach.

use super::setting::{ReportOptions, Setting, Topic};
use super::{given, summary, table, workspace};
use crate::document::{Block, Document, Line, Part, Section, Table, plain};
use crate::figure::{FigureOptions, isometric};
use crate::render::columns;
use crate::words::{Glance, Heading, Tongue};
use denavit::description::Description;
use denavit_symbolic::vocabulary::Vocabulary;

/// What is held beside each other.
const SHOWN: [Glance; 5] =
    [Glance::Structure, Glance::Convention, Glance::Forward, Glance::Inverse, Glance::Singularities];

/// What all pictures beside each other may take of a page, points.
const WIDTH: f64 = 450.0;

/// The robots beside each other. Of the topics of the options those count that a comparison has: the summary, figures,
/// tables and workspaces.
pub fn compared(descriptions: &[Description], options: &ReportOptions) -> Document {
    // Each is shown as it shows itself best.
    let options = ReportOptions { pose: None, errata: None, ..options.clone() };
    let all: Vec<Setting> = descriptions.iter().map(|d| Setting::new(d, &options)).collect();
    let has = |topic| options.topics.contains(&topic);
    let mut sections = vec![];
    if has(Topic::Summary) {
        sections.push(glance(&all, options.language));
    }
    if has(Topic::Figures) {
        sections.extend(pictures(&all, options.language));
    }
    if has(Topic::Table) {
        sections.extend(each(&all, Heading::Table, table::sections));
    }
    if has(Topic::Workspace) {
        sections.extend(each(&all, Heading::Workspace, |s| workspace::section(s).into_iter().collect()));
    }
    let names: Vec<&str> = all.iter().map(|s| s.description.name.as_str()).collect();
    let words = options.language.words();
    let title = given(&options.title).unwrap_or_else(|| words.compared(&names));
    Document { title, author: given(&options.author), language: options.language, sections }
}

/// The summaries as the columns of a table. Formulas stand as text, since each robot has its own names.
fn glance(all: &[Setting], language: Tongue) -> Section {
    let words = language.words();
    let text =
        |s: &Setting, line: &Line| Line::new(plain(line, &language.spelled(&s.description.vocabulary())));
    let columns: Vec<Vec<(Glance, Line)>> = all.iter().map(summary::rows).collect();
    let row = |&glance: &Glance| {
        let own = |rows: &[(Glance, Line)]| rows.iter().find(|r| r.0 == glance).map(|r| r.1.clone());
        let cells: Vec<Option<Line>> = columns.iter().map(|rows| own(rows)).collect();
        let is_said = cells.iter().any(Option::is_some);
        let cell = |(s, line): (&Setting, Option<Line>)| line.map_or_else(|| Line::new("–"), |l| text(s, &l));
        let row = std::iter::once(Line::new(words.glance(glance))).chain(all.iter().zip(cells).map(cell));
        is_said.then(|| row.collect::<Vec<_>>())
    };
    let mut section = Section::new(Vocabulary::new());
    section.push(Part::Table(Table {
        caption: Line::new(words.beside_each_other()[0]),
        head: std::iter::once(Line::default())
            .chain(all.iter().map(|s| Line::new(s.description.name.clone())))
            .collect(),
        rows: SHOWN.iter().filter_map(row).collect(),
    }));
    section
}

fn pictures(all: &[Setting], language: Tongue) -> Option<Section> {
    let words = language.words();
    let mut section = Section::new(Vocabulary::new());
    section.heading(2, Line::new(words.heading(Heading::Arm)));
    let width = WIDTH / columns(all.len()) as f64;
    let drawn = all.iter().filter_map(|s| {
        let name = Line::new(s.description.name.clone());
        s.arm.as_ref().map(|arm| (isometric(arm, &FigureOptions::small(width, width.max(180.0))), name))
    });
    let drawn: Vec<_> = drawn.collect();
    if drawn.is_empty() {
        return None;
    }
    section.push(Part::figures(words, drawn, Line::new(words.beside_each_other()[1])));
    Some(section)
}

/// A section of each robot, under one heading and its name.
fn each(all: &[Setting], heading: Heading, sections: impl Fn(&Setting) -> Vec<Section>) -> Vec<Section> {
    let mut out: Vec<Section> = vec![];
    for s in all {
        for (k, mut section) in sections(s).into_iter().enumerate() {
            section.parts.retain(|part| !matches!(part, Part::Block(Block::Heading(2, _))));
            let mut first = vec![];
            if out.is_empty() {
                first.push(Block::Heading(2, Line::new(s.words().heading(heading))).into());
            }
            if k == 0 {
                first.push(Block::Heading(3, Line::new(s.description.name.clone())).into());
            }
            section.parts.splice(0..0, first);
            out.push(section);
        }
    }
    out
}
