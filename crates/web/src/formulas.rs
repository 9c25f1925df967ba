//! What is derived of a robot, as parts that a page shows: the sections of its report.

use crate::definitions::Definitions;
use crate::refusal::Refusal;
use crate::subject::Subject;
use denavit::description::Description;
use denavit::forward::Reference;
use denavit::velocity::JacobianModel;
use denavit_report::document::{Block, Line};
use denavit_report::explain::{jacobian_document, velocity_vocabulary};
use denavit_report::words::Tongue;
use denavit_report::{Document, Part, ReportOptions, Section, Topic, report};
use denavit_wire::parts::{self, parts};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// What is shown of a topic.
#[derive(Serialize)]
pub struct Formulas {
    blocks: Vec<parts::Part>,
    /// For each name in the formulas the joints, from 0, that it is about.
    joints: BTreeMap<String, BTreeSet<usize>>,
    topic: String,
}

/// The parts of a topic, and what the names in its formulas are about.
///
/// # Errors
/// If there is no such topic.
pub fn formulas(subject: &mut Subject, topic: &str, q: &[f64]) -> Result<Formulas, Refusal> {
    let q = subject.configuration(q)?.to_vec();
    let document = document(subject, topic, &q)?;
    let definitions = Definitions::of(&subject.description, &document);
    let shown = Formulas { blocks: parts(&document), joints: definitions.joints(), topic: topic.to_string() };
    subject.formulas.retain(|(known, _)| known != topic);
    subject.formulas.push((topic.to_string(), definitions));
    Ok(shown)
}

/// What a report says about a topic.
fn document(subject: &Subject, topic: &str, q: &[f64]) -> Result<Document, Refusal> {
    let section = match topic {
        "table" => Topic::Table,
        "links" => Topic::Links,
        "forward" | "algorithm" => Topic::Forward,
        "inverse" => Topic::Inverse,
        "jacobian" => return Ok(jacobian(&subject.description)),
        "singularities" => Topic::Velocity,
        other => return Err(Refusal::new(format!("nothing is derived under the name `{other}`"))),
    };
    let options = ReportOptions { topics: vec![section], pose: Some(q.to_vec()), ..ReportOptions::default() };
    let mut document = report(&subject.description, &options);
    let first = document.sections.first_mut();
    match (topic, first) {
        // The model and the program that computes it are two sections.
        ("forward", _) => document.sections.truncate(1),
        ("algorithm", Some(_)) => drop(document.sections.remove(0)),
        // The matrix is a topic of its own.
        ("singularities", Some(first)) => {
            let level = |p: &Part| if let Part::Block(Block::Heading(level, _)) = p { *level } else { 0 };
            let start = first.parts.iter().position(|p| level(p) == 3).unwrap_or(0);
            first.parts.drain(..start);
        }
        _ => {}
    }
    Ok(document)
}

/// The matrix alone: where the arm is singular takes longer.
fn jacobian(description: &Description) -> Document {
    let language = Tongue::English;
    let model = JacobianModel::shortest(description, Reference::Tool);
    let blocks = jacobian_document(description, &model, language);
    let mut section = Section::new(velocity_vocabulary(description));
    section.heading(2, Line::new("Jacobian"));
    let below = blocks.into_iter().filter(|b| !matches!(b, Block::Heading(1, _)));
    section.parts.extend(below.map(Part::from));
    Document { title: description.name.clone(), author: None, language, sections: vec![section] }
}
