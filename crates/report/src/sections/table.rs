//! The Denavit–Hartenberg table.

use super::setting::{Setting, quantities};
use crate::cell::cell;
use crate::document::{Block, Factor, Line, Math, Part, Section, Table};
use crate::words::{Column as Heads, Heading};
use denavit::description::{Description, JointKind};
use denavit::geometry::Transform;
use denavit_symbolic::Expr;

/// The table in its own convention, and in those that were asked for beside.
pub fn sections(s: &Setting) -> Vec<Section> {
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, Line::new(s.words().heading(Heading::Table)));
    one(s, &s.description, &mut section);
    section.push(Block::List(meanings(s)));
    let mut all = vec![section];
    for &convention in s.options.conventions.iter().filter(|c| **c != s.description.convention) {
        let other = s.description.converted(convention);
        let mut section = Section::new(other.description.vocabulary());
        section.heading(3, Line::new(s.words().converted(convention)));
        one(s, &other.description, &mut section);
        let proof = denavit::description::prove_same_chain(&s.description, &other.description);
        section.paragraph(Line::new(s.words().same_pose(proof.is_equal())));
        all.push(section);
    }
    all
}

/// What the four parameters of a row are.
fn meanings(s: &Setting) -> Vec<Line> {
    let symbol = |name: &str| Line::default().math(Expr::symbol(name));
    let [x, z] = [s.description.convention.length_x(), s.description.convention.length_z()];
    // From which frame's x axis the twist and the length are taken.
    let (before, own) = ("j−1", "j");
    let begins_with_joint = s.description.convention.begins_with_joint();
    let (along_x, along_z) = if begins_with_joint { (own, before) } else { (before, own) };
    let rows = [
        ("theta", true, 'z', along_z),
        (z, false, 'z', along_z),
        ("alpha", true, 'x', along_x),
        (x, false, 'x', along_x),
    ];
    let row = |(name, is_angle, axis, frame)| symbol(name).text(s.words().parameter(is_angle, axis, frame));
    rows.map(row).to_vec()
}

/// A table with the values of its parameters and what stands at its ends.
fn one(s: &Setting, d: &Description, section: &mut Section) {
    rows(s, d, section);
    values(s, d, section);
    ends(s, d, section);
}

/// The rows of a table.
pub fn rows(s: &Setting, d: &Description, section: &mut Section) {
    let columns = d.columns();
    let has_limits = d.rows.iter().any(|r| r.limits.is_some());
    let mut head = vec![Line::default().math(Expr::symbol("j")), Line::new(s.words().column(Heads::Joint))];
    head.extend(columns.iter().map(|c| {
        let line = Line::default().math(Expr::symbol(c.key(d.convention)));
        if c.turns() { line } else { line.text(" (m)") }
    }));
    if has_limits {
        head.push(Line::new(s.words().column(Heads::Limits)));
    }
    let has_names = d.rows.iter().any(|r| r.name.is_some());
    if has_names {
        head.push(Line::new(s.words().column(Heads::Name)));
    }
    let rows = (1..).zip(&d.rows).map(|(i, row)| {
        let kind = match row.variable.map(|v| v.kind) {
            Some(JointKind::Revolute) => "R",
            Some(JointKind::Prismatic) => "P",
            None => "–",
        };
        let mut cells = vec![Line::new(i.to_string()), Line::new(kind)];
        cells.extend(columns.iter().map(|c| cell(c.of(row), c.turns(), s.words())));
        if has_limits {
            let turns = row.variable.is_some_and(|v| v.kind == JointKind::Revolute);
            let mut line = Line::default();
            if let Some([low, high]) = row.limits {
                line.0.extend(cell(low, turns, s.words()).0);
                line = line.text(" … ");
                line.0.extend(cell(high, turns, s.words()).0);
                line = line.text(if turns { "" } else { " m" });
            }
            cells.push(line);
        }
        if has_names {
            cells.push(Line::new(row.name.clone().unwrap_or_default()));
        }
        cells
    });
    let caption = Line::new(s.words().parameters(d.convention));
    section.push(Part::Table(Table { caption, head, rows: rows.collect() }));
}

/// Where frame 0 stands in the base, and the tool in the last frame, where these are not the same.
pub fn ends(s: &Setting, d: &Description, section: &mut Section) {
    let mut placed = |x: &Transform<Expr>, words: String, from: String, to: String| {
        if *x != Transform::identity() {
            section.paragraph(Line::new(words));
            let rows = x.matrix().iter().map(|r| r.to_vec()).collect();
            section.formula(Math::Matrix(Factor::Frame { from, to }, rows));
        }
    };
    placed(&d.base, s.words().base_stands(), s.words().base(), "0".into());
    placed(&d.tool, s.words().tool_stands(), d.rows.len().to_string(), s.words().tool());
}

/// The values of the parameters, where they are known.
pub fn values(s: &Setting, d: &Description, section: &mut Section) {
    let known: Vec<_> = d.parameters.iter().filter(|p| p.value.is_some()).collect();
    if !known.is_empty() {
        section.paragraph(quantities(Line::new(s.words().values()), d, &known, s.words()));
    }
}
