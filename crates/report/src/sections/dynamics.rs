//! The dynamic model of an arm with masses: base parameters, torques as a program, and torques at the example.

use super::inverse::lowered;
use super::setting::Setting;
use crate::cell::decimals;
use crate::document::{Line, Part, Section, Table};
use crate::explain::{dynamics_document, dynamics_vocabulary};
use crate::words::{Caption, Column, Heading};
use denavit::description::JointKind;
use denavit::dynamics::{DynamicModel, Dynamics, gravity_torques, inertia_matrix};
use denavit::quantity::torque_unit;
use denavit_symbolic::Expr;

/// Nothing for a robot that says nothing of masses.
pub fn section(s: &Setting) -> Option<Section> {
    if !s.description.has_masses() {
        return None;
    }
    let model = DynamicModel::derive(&s.description);
    let mut section = Section::new(dynamics_vocabulary(&s.description, &model));
    section.heading(2, Line::new(s.words().heading(Heading::Dynamics)));
    lowered(dynamics_document(&s.description, &model, s.options.language), s.words(), &mut section);
    section.parts.extend(at_rest(s));
    Some(section)
}

/// What holds the arm at the example, and what its joints feel of its inertia there; nothing without numbers.
fn at_rest(s: &Setting) -> Option<Part> {
    let arm = Dynamics::numeric(&s.valued).ok()?;
    let (gravity, inertia) = (gravity_torques(&arm, &s.q), inertia_matrix(&arm, &s.q));
    let written = |x: f64| s.words().written(decimals(x, 4));
    let row = |(j, v): (usize, &denavit::description::Variable)| {
        let units = [torque_unit(v.kind), if v.kind == JointKind::Revolute { "kg m²" } else { "kg" }];
        vec![
            Line::default().math(Expr::from(v.symbol)),
            Line::new(format!("{} {}", written(gravity[j]), units[0])),
            Line::new(format!("{} {}", written(inertia[j][j]), units[1])),
        ]
    };
    let head = [Column::Joint, Column::Torque, Column::Inertia].map(|c| Line::new(s.words().column(c)));
    let rows = s.description.variables().iter().enumerate().map(row).collect();
    let mut caption = Line::new(s.words().caption(Caption::AtRest)).text(" ");
    caption.0.extend(s.configuration(&s.q).text(".").0);
    Some(Part::Table(Table { caption, head: head.to_vec(), rows }))
}
