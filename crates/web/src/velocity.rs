//! Jacobians in numbers, and where the arm is singular.

use crate::refusal::Refusal;
use crate::scene::{Bodies, bodies};
use crate::subject::Subject;
use crate::words;
use denavit::forward::Reference;
use denavit::velocity::{Singularities, Singularity, Viewpoint, geometric, singular_configuration};
use denavit_report::document::Math;
use denavit_report::words::Velocity as _;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use denavit_wire::jacobian::{Matrix, frame};
use denavit_wire::parts::Formula;
use denavit_wire::singular::Zeros;
use serde::Serialize;

/// Where the arm is singular.
#[derive(Serialize)]
pub struct Singular {
    /// Whether these are all.
    complete: bool,
    singularities: Vec<Place>,
}

/// The zeros of a factor.
#[derive(Serialize)]
struct Place {
    factor: Formula,
    /// Whether the tool's point alone gets stuck there: of an arm with at most three joints, where that is elsewhere.
    of_point: bool,
    /// A configuration there, near to the one that the arm is drawn in.
    q: Option<Vec<f64>>,
    scene: Option<Bodies>,
    /// How the axes lie.
    why: Option<String>,
    zeros: Vec<Zeros>,
}

/// The Jacobian of the tool, as text.
///
/// # Errors
/// If the configuration does not fit, or there is no such frame.
pub fn jacobian(subject: &Subject, q: &[f64], axes: &str) -> Result<String, Refusal> {
    let q = subject.configuration(q)?;
    let view = match axes {
        "base" => Viewpoint::tool(),
        "tool" => Viewpoint::of(Reference::Tool, Reference::Tool),
        other => return Err(Refusal::new(format!("no frame `{other}`: base or tool"))),
    };
    let entries = geometric(&subject.robot, q, &view).rows().concat();
    let name = &subject.description.name;
    Ok(denavit_wire::text(&Matrix::of(name, &frame(view.axes), q, &entries)))
}

/// The factors whose zeros make the arm singular, each with a configuration near the one it is drawn in.
///
/// # Errors
/// If the arm is singular everywhere, or its determinant too large.
pub fn singular(subject: &Subject) -> Result<Singular, Refusal> {
    let found = Singularities::derive(&subject.description, Reference::Tool)
        .map_err(|why| Refusal::new(why.to_string()))?;
    let names = subject.description.vocabulary();
    let near = denavit::velocity::regular_configuration(&subject.valued, subject.arm.pose().to_vec());
    let places = |found: &Singularities, of_point: bool| {
        let factors: Vec<Expr> = found.common.iter().map(|c| c.factor).collect();
        let of = |one: &Singularity| {
            let q = singular_configuration(&subject.valued, one.factor, &factors, &near);
            Place {
                factor: Formula::of(&Math::equation(one.factor, Expr::int(0)), &names),
                of_point,
                scene: q.as_ref().map(|q| bodies(&subject.arm.at(q))),
                q,
                why: one.example.as_ref().map(|e| words().place(&e.place)),
                zeros: one.zeros.iter().map(|z| Zeros::of(z, |e| print(e, &names, Style::Unicode))).collect(),
            }
        };
        found.common.iter().map(of).collect::<Vec<_>>()
    };
    let point = found.of_its_point(&subject.description);
    let mut singularities = places(&found, false);
    singularities.extend(point.iter().flat_map(|p| places(p, true)));
    let complete = found.is_complete && point.is_none_or(|p| p.is_complete);
    Ok(Singular { complete, singularities })
}
