//! Several robots beside each other: at a glance, in pictures, by their tables and by what they reach.

use super::setting::{ReportOptions, Setting, Topic};
use super::{given, summary, table, workspace};
use crate::document::{Block, Document, Line, Part, Section, Table, plain};
use crate::figure::{Arm, Bounds, FigureOptions, View, isometric};
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
        caption: Line::new(words.beside_each_other(false)[0]),
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
    section.heading(2, Line::new(words.heading(Heading::Arms)));
    let width = WIDTH / columns(all.len()) as f64;
    let arms: Vec<(&Arm, View, Line)> = all
        .iter()
        .filter_map(|s| Some((s.arm.as_ref()?, Line::new(s.description.name.clone()))))
        .map(|(arm, name)| (arm, arm.view(), name))
        .collect();
    if arms.is_empty() {
        return None;
    }
    let common = one_scale(&arms.iter().map(|(arm, view, _)| arm.bounds(view)).collect::<Vec<_>>());
    let drawn = arms.iter().enumerate().map(|(k, (arm, view, name))| {
        let bounds = common.as_ref().map(|all| all[k]);
        let small = FigureOptions::small(width, width.max(180.0));
        (isometric(arm, &FigureOptions { view: Some(*view), bounds, ..small }), name.clone())
    });
    let caption = words.beside_each_other(common.is_some())[1];
    section.push(Part::figures(words, drawn.collect(), Line::new(caption)));
    Some(section)
}

/// Robots that differ more in size are drawn each as large as its picture allows.
const MOST: f64 = 4.0;

/// Bounds that are equally wide and high around each of these, with what stands lowest at one height; nothing where one would be
/// too small beside another.
fn one_scale(all: &[Bounds]) -> Option<Vec<Bounds>> {
    let extents: Vec<[f64; 2]> = all.iter().map(Bounds::extent).collect();
    let largest = |e: &[f64; 2]| e[0].max(e[1]);
    let sizes = || extents.iter().map(largest);
    let (least, most) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    if all.len() < 2 || most > MOST * least {
        return None;
    }
    let [width, height] = [0, 1].map(|k| extents.iter().map(|e| e[k]).fold(0.0, f64::max));
    let around = |b: &Bounds| {
        let middle = (b.min[0] + b.max[0]) / 2.0;
        let min = [middle - width / 2.0, b.min[1]];
        Bounds { min, max: [middle + width / 2.0, b.min[1] + height] }
    };
    Some(all.iter().map(around).collect())
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
