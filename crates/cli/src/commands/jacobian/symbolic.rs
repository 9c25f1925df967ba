//! Formulas: the Jacobian, its algorithm, the singularities.

use crate::arguments::Format;
use crate::commands::fk::plural;
use crate::commands::{certificate, document};
use crate::failure::Failure;
use crate::terminal::note;
use denavit::description::Description;
use denavit::forward::Reference;
use denavit::velocity::{JacobianModel, Minor, Obstacle, Singularities, Viewpoint, singular_configurations};
use denavit_report::document::{Block, Line, Math};
use denavit_report::explain::{
    found_singularities_document, jacobian_document, singularities_document, velocity_vocabulary,
};
use denavit_report::words::{Heading, Tongue};
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_wire::singular::Model;
use std::path::Path;

/// What is asked for.
pub enum What {
    /// The matrix at a viewpoint, or where it is shortest.
    Matrix(Option<Viewpoint<Expr>>),
    /// Where the arm is singular.
    Singularities,
    /// Where the position is, the orientation left aside.
    PositionSingularities,
}

/// The document in a format, and how the command ends: what is not in it, or a certificate that is not written.
///
/// # Errors
/// If a formula is too large.
pub fn document(
    description: &Description,
    body: Reference,
    what: What,
    format: Format,
    language: Tongue,
    file: Option<&Path>,
) -> Result<(String, Result<(), Failure>), Failure> {
    let certify = |model: &JacobianModel, minors: &[Minor]| match file {
        Some(file) => certificate::write(file, denavit_certificate::jacobian(description, model, minors)),
        None => Ok(()),
    };
    let found = match what {
        What::Singularities => Singularities::derive(description, body),
        What::PositionSingularities => Singularities::of_position(description, body),
        What::Matrix(view) => {
            let model = match view {
                Some(view) => JacobianModel::derive(description, view),
                None => JacobianModel::shortest(description, body),
            };
            return Ok((matrix(description, &model, format, language)?, certify(&model, &[])));
        }
    };
    match found {
        Ok(found) => {
            let n = description.variables().len();
            if format != Format::Json && found.rows.len() > n {
                note(&format!(
                    "note: {} cannot give the body all six directions; `--position` looks at its point alone",
                    plural(n, "joint")
                ));
            }
            let text = if format == Format::Json {
                let point = found.of_its_point(description);
                let of = |robot: &str, text: &dyn Fn(Expr) -> String| {
                    Model::with_singularities(robot, &found, point.as_ref(), text)
                };
                json(description, &found.jacobian, of)
            } else {
                let blocks = singularities_document(description, &found, language);
                printed(description, &found.jacobian, blocks, format, language)
            };
            Ok((text, certify(&found.jacobian, &found.minors)))
        }
        // The matrix is there all the same, and numbers.
        Err(why) => {
            let model = match what {
                What::PositionSingularities => JacobianModel::shortest_at_origin(description, body),
                _ => JacobianModel::shortest(description, body),
            };
            let rows: &[usize] = match what {
                What::PositionSingularities => &[0, 1, 2],
                _ => &[0, 1, 2, 3, 4, 5],
            };
            let is_everywhere = matches!(why, Obstacle::AlwaysSingular(_));
            let found = match is_everywhere {
                true => Ok(vec![]),
                false => singular_configurations(description, &model.view, rows),
            };
            let certified = certify(&model, &[]);
            let text = if format == Format::Json {
                json(description, &model, |robot, text| {
                    Model::without_singularities(robot, &model, &why, found.as_deref().ok(), text)
                })
            } else {
                let blocks =
                    found_singularities_document(description, &model, &why, found.as_deref(), language);
                printed(description, &model, blocks, format, language)
            };
            let ended = if is_everywhere { Ok(()) } else { Err(Failure::GaveUp(why.to_string())) };
            Ok((text, certified.and(ended)))
        }
    }
}

/// The matrix and its algorithm.
fn matrix(
    description: &Description,
    model: &JacobianModel,
    format: Format,
    language: Tongue,
) -> Result<String, Failure> {
    if let Err(why) = &model.matrix {
        return Err(Failure::GaveUp(format!("the matrix is not expanded: {why}")));
    }
    Ok(match format {
        Format::Json => json(description, model, |robot, text| Model::of(robot, model, text)),
        _ => {
            let mut blocks = jacobian_document(description, model, language);
            blocks.extend(algorithm(model, language));
            printed(description, model, blocks, format, language)
        }
    })
}

/// The program, step by step.
fn algorithm(model: &JacobianModel, language: Tongue) -> Vec<Block> {
    let steps = model.algorithm.steps();
    let mut blocks = vec![Block::Heading(2, Line::new(language.words().heading(Heading::Algorithm)))];
    for step in steps.iter().filter(|s| !(s.is_output && s.value.as_number().is_some())) {
        let math = Math::equation(Expr::symbol(&step.name), step.value);
        blocks.push(Block::Formula { math, number: None, proof: None });
    }
    blocks
}

/// The robot's names, those of the algorithm's steps, and those of velocities.
fn names(description: &Description, model: &JacobianModel) -> Vocabulary {
    let steps = model.algorithm.steps().into_iter().map(|step| step.name);
    steps.fold(velocity_vocabulary(description), |v, name| v.symbol(&name))
}

fn printed(
    description: &Description,
    model: &JacobianModel,
    blocks: Vec<Block>,
    format: Format,
    language: Tongue,
) -> String {
    let title = language.words().jacobian_title(&description.name);
    document::document_in(language, &title, &names(description, model), &blocks, format)
}

/// What `of` makes of the robot's name and what prints formulas in the model's names, as JSON.
fn json(
    description: &Description,
    model: &JacobianModel,
    of: impl FnOnce(&str, &dyn Fn(Expr) -> String) -> Model,
) -> String {
    let names = names(description, model);
    let text = |e: Expr| print(e, &names, Style::Ascii);
    format!("{}\n", denavit_wire::text(&of(&description.name, &text)))
}
