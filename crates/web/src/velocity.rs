//! Jacobians in numbers, and where the arm is singular.

use crate::formulas::formula;
use crate::refusal::Refusal;
use crate::scene::bodies;
use crate::subject::Subject;
use crate::words;
use denavit::forward::Reference;
use denavit::velocity::{ROWS, Singularities, Viewpoint, geometric, singular_configuration};
use denavit_report::document::Math;
use denavit_report::words::Velocity as _;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use serde_json::{Value, json};

/// The Jacobian of the tool.
///
/// # Errors
/// If the configuration does not fit, or there is no such frame.
pub fn jacobian(subject: &Subject, q: &[f64], frame: &str) -> Result<Value, Refusal> {
    let q = subject.configuration(q)?;
    let view = match frame {
        "base" => Viewpoint::tool(),
        "tool" => Viewpoint::of(Reference::Tool, Reference::Tool),
        other => return Err(Refusal::new(format!("no frame `{other}`: base or tool"))),
    };
    let rows = geometric(&subject.robot, q, &view).rows();
    Ok(json!({ "rows": ROWS, "jacobian": rows }))
}

/// The factors whose zeros make the arm singular, each with a configuration near the one it is drawn in.
///
/// # Errors
/// If the arm is singular everywhere, or its determinant too large.
pub fn singular(subject: &Subject) -> Result<Value, Refusal> {
    let found = Singularities::derive(&subject.description, Reference::Tool)
        .map_err(|why| Refusal::new(why.to_string()))?;
    let names = subject.description.vocabulary();
    let factors: Vec<Expr> = found.common.iter().map(|c| c.factor).collect();
    let near = denavit::velocity::regular_configuration(&subject.valued, subject.arm.pose().to_vec());
    let all = found.common.iter().map(|one| {
        let q = singular_configuration(&subject.valued, one.factor, &factors, &near);
        let conditions = one.zeros.iter().flat_map(|z| {
            let angle = print(z.angle(), &names, Style::Unicode);
            z.values().into_iter().map(move |v| (angle.clone(), v))
        });
        let conditions: Vec<String> =
            conditions.map(|(angle, v)| format!("{angle} = {}", print(v, &names, Style::Unicode))).collect();
        let factor = Math::equation(one.factor, Expr::int(0));
        json!({
            "words": one.example.as_ref().map_or_else(String::new, |e| words().place(&e.place)),
            "factor": formula(&factor, &names),
            "conditions": conditions,
            "scene": q.as_ref().map(|q| bodies(&subject.arm.at(q))),
            "q": q,
        })
    });
    let singular: Vec<Value> = all.collect();
    let remark = (!found.is_complete).then_some("there may be more: not all zeros of the minors are solved");
    Ok(json!({ "singular": singular, "remark": remark }))
}
