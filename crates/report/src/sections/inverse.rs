//! Inverse kinematics: the derivation, and the solutions at the example.

use super::example::{numbers, plain};
use super::setting::{Level, Setting};
use crate::document::{Block, Line, Part, Section, Table};
use crate::explain::Explanation;
use crate::figure::{FigureOptions, isometric};
use crate::render::too_long;
use crate::words::{Caption, Column, Heading, Wording};
use denavit::description::JointKind;
use denavit::inverse::{Goal, InverseKinematics, Refusal, Solution};
use denavit_symbolic::Expr;

/// More solutions are not listed.
const SHOWN: usize = 16;
/// The size of one, points.
const SIZE: [f64; 2] = [108.0, 112.0];

/// The derivation and the example.
pub fn sections(s: &Setting) -> Vec<Section> {
    let mut all = vec![derivation(s)];
    if s.options.level == Level::Full {
        all.extend(solutions(s));
    }
    all
}

fn derivation(s: &Setting) -> Section {
    let explained = match s.inverse() {
        Ok(model) => Some(Explanation::of(model)),
        Err(Refusal::Stuck(stuck)) => Some(Explanation::of_stuck(&s.description, stuck, Goal::Pose)),
        Err(Refusal::Given(_) | Refusal::Unsuitable(_)) => None,
    };
    // Of arms for positions that problem follows, which most books mean.
    let position = s.inverse().as_ref().ok().and_then(Explanation::of_its_position);
    let names = match (&explained, &position) {
        (Some(e), Some(p)) => e.names_with(p),
        (Some(e), None) => e.names(),
        (None, _) => s.description.vocabulary(),
    };
    let mut section = Section::new(names);
    section.heading(2, Line::new(s.words().heading(Heading::Inverse)));
    match (explained, s.inverse()) {
        (Some(e), _) => {
            let language = s.options.language;
            let blocks = match (s.options.level, &position) {
                (Level::Full, None) => e.document(language),
                (Level::Full, Some(p)) => e.document_with(p, language),
                (Level::Short, None) => e.summary(language),
                (Level::Short, Some(p)) => e.summary_with(p, language),
            };
            lowered(blocks, s.words(), &mut section);
        }
        (None, Err(why)) => section.paragraph(Line::new(s.words().refused(why))),
        (None, Ok(_)) => {}
    }
    section
}

/// A document as a part of another: its title left out, its headings one level lower.
pub fn lowered(blocks: Vec<Block>, words: &dyn Wording, section: &mut Section) {
    for block in blocks {
        match block {
            Block::Heading(1, _) => {}
            Block::Formula { math, .. } if too_long(&math, &section.names) => {
                section.paragraph(Line::new(words.long_formula()));
            }
            Block::Heading(level, line) => section.heading(level + 1, line),
            other => section.push(other),
        }
    }
}

fn solutions(s: &Setting) -> Option<Section> {
    // Joints too many have the values of the example, as in the derivation.
    let given = s.inverse().as_ref().ok().map(|m| m.given.clone()).filter(|g| !g.is_empty());
    let options = denavit::inverse::InverseOptions { given, ..Default::default() };
    let mut solver = InverseKinematics::new(&s.valued, &options).ok()?;
    solver.seed = Some(s.q.clone());
    let pose = solver.robot.pose(&s.q);
    let given: Vec<f64> = solver.given.iter().map(|&j| s.q[j]).collect();
    let answer = solver.solve(&pose, &given);
    let mut section = Section::new(s.description.vocabulary());
    section.heading(3, Line::new(s.words().heading(Heading::Solutions)));
    section.paragraph(s.words().pose_at(s.configuration(&s.q)));
    section.formula(numbers(&pose));
    if !given.is_empty() {
        let mut line = Line::default();
        let variables = s.description.variables();
        for (k, &j) in solver.given.iter().enumerate() {
            line = line.text(if k > 0 { s.words().between() } else { "" });
            line = line.math(Expr::from(variables[j].symbol));
            line = line.text(format!(" = {}", s.reading(s.q[j], variables[j].kind)));
        }
        section.paragraph(s.words().given_values(line));
    }
    let representatives = answer.families.iter().map(|f| &f.representative);
    let found: Vec<Solution> = answer.solutions.iter().chain(representatives).cloned().collect();
    let found: Vec<Solution> = found.into_iter().map(|f| within_turns(f, &solver.space)).collect();
    if found.is_empty() {
        section.paragraph(Line::new(s.words().no_solution()));
        return Some(section);
    }
    let shown = &found[..found.len().min(SHOWN)];
    section.push(table(s, shown, answer.solutions.len()));
    let (isolated, families) = (answer.solutions.len(), answer.families.len());
    section.paragraph(Line::new(s.words().found(isolated, families, answer.is_complete())));
    if found.len() > SHOWN {
        section.paragraph(Line::new(s.words().first_of_them(SHOWN)));
    }
    section.push(pictures(s, shown)?);
    Some(section)
}

/// A solution within the limits by whole turns of its joints, with the values that are.
pub fn within_turns(mut found: Solution, space: &denavit::inverse::JointSpace) -> Solution {
    if found.within_limits {
        for ((x, limits), is_angle) in found.q.iter_mut().zip(&space.limits).zip(&space.is_angle) {
            let Some([low, high]) = limits.filter(|_| *is_angle) else { continue };
            let turn = std::f64::consts::TAU;
            let copies = [*x, *x + turn, *x - turn];
            let slack = 1e-9;
            *x = copies.into_iter().find(|c| (low - slack..=high + slack).contains(c)).unwrap_or(*x);
        }
    }
    found
}

fn table(s: &Setting, found: &[Solution], isolated: usize) -> Part {
    let variables = s.description.variables();
    let mut head = vec![Line::default()];
    head.extend(variables.iter().map(|v| {
        let unit = if v.kind == JointKind::Revolute { " (°)" } else { " (m)" };
        Line::default().math(Expr::from(v.symbol)).text(unit)
    }));
    let has_branches = found.iter().any(|f| !f.branch.is_empty());
    let has_limits = found.iter().any(|f| !f.within_limits);
    if has_branches {
        head.push(Line::new(s.words().column(Column::Branch)));
    }
    if has_limits {
        head.push(Line::new(s.words().column(Column::Limits)));
    }
    let rows = found.iter().enumerate().map(|(k, f)| {
        let star = if k < isolated { "" } else { "*" };
        let mut cells = vec![Line::new(format!("{}{star}", k + 1))];
        cells.extend(f.q.iter().zip(&variables).map(|(x, v)| Line::new(plain(*x, v.kind, s.words()))));
        if has_branches {
            cells.push(Line::new(s.words().branch(&f.branch)));
        }
        if has_limits {
            cells.push(Line::new(s.words().within_limits(f.within_limits)));
        }
        cells
    });
    Part::Table(Table {
        caption: Line::new(s.words().caption(Caption::Configurations)),
        head,
        rows: rows.collect(),
    })
}

fn pictures(s: &Setting, found: &[Solution]) -> Option<Part> {
    let arm = s.arm.as_ref()?;
    let view = arm.view();
    let arms: Vec<_> = found.iter().map(|f| arm.at(&f.q)).collect();
    let bounds = arms.iter().map(|a| a.bounds(&view)).reduce(|a, b| a.with(&b))?;
    let options =
        FigureOptions { view: Some(view), bounds: Some(bounds), ..FigureOptions::small(SIZE[0], SIZE[1]) };
    let picture =
        |(k, a): (usize, &crate::figure::Arm)| (isometric(a, &options), Line::new((k + 1).to_string()));
    Some(Part::figures(
        s.words(),
        arms.iter().enumerate().map(picture).collect(),
        Line::new(s.words().caption(if found.len() == 1 { Caption::Picture } else { Caption::Pictures })),
    ))
}
