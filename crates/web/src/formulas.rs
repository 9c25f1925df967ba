//! What is derived of a robot, as parts that a page shows: the sections of its report.

use crate::definitions::Definitions;
use crate::refusal::Refusal;
use crate::subject::Subject;
use denavit::description::Description;
use denavit::forward::Reference;
use denavit::velocity::JacobianModel;
use denavit_emit::{Language as Code, expression};
use denavit_report::document::{Block, Line, Math, Sign, math};
use denavit_report::explain::{jacobian_document, velocity_vocabulary};
use denavit_report::words::Language;
use denavit_report::{Document, Options, Part, Section, Topic, render, report};
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;
use serde_json::{Value, json};

/// The parts of a topic, and what the names in its formulas are about.
///
/// # Errors
/// If there is no such topic.
pub fn formulas(subject: &mut Subject, topic: &str, q: &[f64]) -> Result<Value, Refusal> {
    let q = subject.configuration(q)?.to_vec();
    let document = document(subject, topic, &q)?;
    let definitions = Definitions::of(&subject.description, &document);
    let value = json!({
        "topic": topic,
        "blocks": render::json_parts(&document, sources),
        "joints": definitions.joints(),
    });
    subject.formulas.retain(|(known, _)| known != topic);
    subject.formulas.push((topic.to_string(), definitions));
    Ok(value)
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
    let options = Options { topics: vec![section], pose: Some(q.to_vec()), ..Options::default() };
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
    let language = Language::English;
    let model = JacobianModel::shortest(description, Reference::Tool);
    let blocks = jacobian_document(description, &model, language);
    let mut section = Section::new(velocity_vocabulary(description));
    section.heading(2, Line::new("Jacobian"));
    let below = blocks.into_iter().filter(|b| !matches!(b, Block::Heading(1, _)));
    section.parts.extend(below.map(Part::from));
    Document { title: description.name.clone(), language, sections: vec![section] }
}

/// A formula in every notation.
pub fn formula(m: &Math, names: &Vocabulary) -> Value {
    render::json_formula(m, names, sources)
}

/// What somebody may want to copy.
fn sources(m: &Math, names: &Vocabulary) -> Vec<(&'static str, String)> {
    vec![("python", code(m, names, Code::Python)), ("c", code(m, names, Code::C))]
}

/// An assignment in a programming language; what no language has is given as plain text behind a sign of comment.
fn code(m: &Math, names: &Vocabulary, language: Code) -> String {
    let spelled = |e: &_| expression(*e, language);
    let end = if language == Code::C { ";" } else { "" };
    let [open, close] = if language == Code::C { ["{", "}"] } else { ["[", "]"] };
    match m {
        Math::Expr(e) => spelled(e),
        Math::Chain(left, rest)
            if left.as_symbol().is_some() && rest[..].iter().all(|r| r.0 == Sign::Equal) =>
        {
            let right = rest.last().map(|r| spelled(&r.1)).unwrap_or_default();
            format!("{} = {right}{end}", spelled(left))
        }
        Math::Matrix(_, all) => {
            let row = |row: &Vec<_>| {
                format!("{open}{}{close}", row.iter().map(spelled).collect::<Vec<_>>().join(", "))
            };
            format!("{open}{}{close}", all.iter().map(row).collect::<Vec<_>>().join(",\n "))
        }
        Math::Determinant(_, e) => format!("det = {}{end}", spelled(e)),
        other => {
            let comment = if language == Code::C { "//" } else { "#" };
            format!("{comment} {}", math(other, names, Style::Ascii))
        }
    }
}
