//! Formulas: the Jacobian, its algorithm, the singularities.

use super::answer::name;
use crate::arguments::Format;
use crate::commands::document;
use crate::failure::Failure;
use crate::terminal::words;
use denavit::description::Description;
use denavit::forward::Reference;
use denavit::velocity::{JacobianModel, Minor, Obstacle, ROWS, Singularities, Singularity, Viewpoint};
use denavit_report::document::{Block, Line, Math};
use denavit_report::explain::{jacobian_document, singularities_document, velocity_vocabulary};
use denavit_report::words::Language;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use serde_json::{Value, json};

/// What is asked for.
pub enum What {
    /// The matrix at a viewpoint, or where it is shortest.
    Matrix(Option<Viewpoint<Expr>>),
    /// Where the arm is singular.
    Singularities,
    /// Where the position is, the orientation left aside.
    PositionSingularities,
}

/// The document in a format.
///
/// # Errors
/// If a formula is too large.
pub fn document(
    description: &Description,
    body: Reference,
    what: What,
    format: Format,
) -> Result<String, Failure> {
    let found = match what {
        What::Singularities => Singularities::derive(description, body),
        What::PositionSingularities => Singularities::of_position(description, body),
        What::Matrix(view) => {
            let model = match view {
                Some(view) => JacobianModel::derive(description, view),
                None => JacobianModel::shortest(description, body),
            };
            return matrix(description, &model, format);
        }
    };
    match found {
        Ok(found) if format == Format::Json => Ok(singularities_json(description, &found)),
        Ok(found) => Ok(printed(
            description,
            &found.jacobian,
            singularities_document(description, &found, Language::English),
            format,
        )),
        // The matrix is there all the same.
        Err(why @ Obstacle::AlwaysSingular(_)) => {
            let model = JacobianModel::shortest(description, body);
            if format == Format::Json {
                let mut map = model_json(description, &model);
                map.insert("always_singular".into(), why.to_string().into());
                return Ok(format!("{}\n", Value::Object(map)));
            }
            let mut blocks = jacobian_document(description, &model, Language::English);
            blocks.push(Block::Heading(2, Line::new("Singularities")));
            blocks.push(Block::Paragraph(Line::new(format!("{why}."))));
            Ok(printed(description, &model, blocks, format))
        }
        Err(why) => Err(Failure::GaveUp(why.to_string())),
    }
}

/// The matrix and its algorithm.
fn matrix(description: &Description, model: &JacobianModel, format: Format) -> Result<String, Failure> {
    if let Err(why) = &model.matrix {
        return Err(Failure::GaveUp(format!("the matrix is not expanded: {why}")));
    }
    Ok(match format {
        Format::Json => format!("{}\n", Value::Object(model_json(description, model))),
        _ => {
            let mut blocks = jacobian_document(description, model, Language::English);
            blocks.extend(algorithm(model));
            printed(description, model, blocks, format)
        }
    })
}

/// The program, step by step.
fn algorithm(model: &JacobianModel) -> Vec<Block> {
    let steps = model.algorithm.steps();
    let mut blocks = vec![Block::Heading(2, Line::new("Algorithm"))];
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

fn printed(description: &Description, model: &JacobianModel, blocks: Vec<Block>, format: Format) -> String {
    let title = format!("Jacobian of the {}", description.name);
    document::document(&title, &names(description, model), &blocks, format)
}

fn model_json(description: &Description, model: &JacobianModel) -> serde_json::Map<String, Value> {
    let names = names(description, model);
    let text = |e: Expr| print(e, &names, Style::Ascii);
    let matrix = model.matrix.as_ref().ok();
    let rows = matrix.map(|m| m.rows().map(|r| r.into_iter().map(text).collect::<Vec<_>>()));
    let count = model.algorithm.count();
    let steps = model.algorithm.steps();
    let steps: Vec<Value> = steps
        .iter()
        .map(|s| json!({"name": s.name, "value": text(s.value), "output": s.is_output}))
        .collect();
    let object = json!({
        "schema": 1,
        "robot": description.name,
        "frame": name(model.view.axes),
        "of": name(model.view.body),
        "at": name(model.view.at),
        "rows": ROWS,
        "jacobian": rows,
        "steps": steps,
        "count": {
            "multiplications": count.multiplications, "additions": count.additions, "sincos": count.sincos,
        },
        "proof": words().jacobian_proof(model.proof),
    });
    match object {
        Value::Object(map) => map,
        _ => serde_json::Map::new(),
    }
}

fn singularities_json(description: &Description, found: &Singularities) -> String {
    let names = names(description, &found.jacobian);
    let text = |e: Expr| print(e, &names, Style::Ascii);
    let minor = |m: &Minor| {
        json!({
            "rows": m.rows.iter().map(|&r| ROWS[r]).collect::<Vec<_>>(),
            "joints": m.joints.iter().map(|j| j + 1).collect::<Vec<_>>(),
            "determinant": text(m.determinant.to_expr()),
        })
    };
    let singularity = |s: &Singularity| {
        let zeros: Vec<Value> = s
            .zeros
            .iter()
            .map(|z| json!({"angle": text(z.angle()), "values": z.values().into_iter().map(text).collect::<Vec<_>>()}))
            .collect();
        json!({
            "factor": text(s.factor), "power": s.power, "zeros": zeros,
            "example": s.example.as_ref().map(|e| json!({
                "q": e.q, "free": e.free, "lost": e.lost, "why": words().place(&e.place),
            })),
        })
    };
    let mut map = model_json(description, &found.jacobian);
    map.insert("determinants".into(), found.minors.iter().map(minor).collect());
    map.insert("singularities".into(), found.common.iter().map(singularity).collect());
    map.insert("complete".into(), found.is_complete.into());
    if let Some(rates) = &found.rates {
        let steps: Vec<Value> =
            rates.steps.iter().map(|(name, value)| json!({"name": name, "value": text(*value)})).collect();
        let different: Vec<String> = rates.conditions.iter().map(|&c| text(c)).collect();
        map.insert(
            "joint_rates".into(),
            json!({"steps": steps, "not_zero": different, "proved": rates.is_proved}),
        );
    }
    format!("{}\n", Value::Object(map))
}
