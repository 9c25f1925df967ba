//! The derivation as JSON; formulas are plain text that parses back.

use crate::terminal::words;
use denavit::description::Description;
use denavit_report::document::{Math, math};
use denavit_report::explain::{Explanation, Statement};
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use serde_json::{Value, json};

/// A derivation that did not begin, or whose numbers were asked for.
pub fn refusal(d: &Description, why: &str) -> Value {
    json!({"schema": 1, "robot": d.name, "status": "refused", "complete": false, "why": why, "solutions": [], "families": []})
}

/// Schema 1 of `ik` without a pose.
pub fn document(e: &Explanation) -> String {
    let names = e.names();
    let text = |x: Expr| print(x, &names, Style::Ascii);
    let formula = |m: &Math| math(m, &names, Style::Ascii);
    let statement = |s: &Statement| -> Value {
        let mut value = match &s.math {
            Math::Chain(left, rest) if rest.len() == 1 => {
                json!({"left": text(*left), "right": text(rest[0].1)})
            }
            other => json!({"formula": formula(other)}),
        };
        if let Some(n) = s.number {
            value["number"] = n.into();
        }
        if let Some(p) = s.proof {
            value["proof"] = words().proof(p).into();
        }
        value
    };
    let all = |s: &[Statement]| -> Value { s.iter().map(statement).collect() };
    let steps: Vec<Value> = e
        .steps
        .iter()
        .map(|s| {
            let sources: Vec<Value> = s
                .sources
                .iter()
                .map(|o| {
                    json!({
                        "product": formula(&Math::Products(o.product.0.clone(), o.product.1.clone())),
                        "elements": o.elements,
                        "inverse": o.inverse,
                        "squares_added": o.squared,
                        "why": o.why.as_ref().map(|why| words().component(why)),
                        "equations": all(&o.equations),
                    })
                })
                .collect();
            let conditions: Vec<Value> = s
                .conditions
                .iter()
                .map(|c| json!({"when": c.when.iter().map(formula).collect::<Vec<_>>(), "then": words().consequence(c.then)}))
                .collect();
            json!({
                "unknown": text(s.unknown),
                "meaning": s.meaning.map(text),
                "values": s.values,
                "label": s.label.map(|label| label.to_string()),
                "sign": s.sign.map(text),
                "type": s.kind.number(),
                "kind": words().kind(s.kind),
                "sources": sources,
                "names": all(&s.names),
                "form": s.form.iter().map(formula).collect::<Vec<_>>(),
                "coefficients": all(&s.coefficients),
                "solution": all(&s.solution),
                "conditions": conditions,
                "used_by": s.used_by,
                "remark": words().remark(s.remark),
            })
        })
        .collect();
    let document = json!({
        "schema": 1,
        "robot": e.description.name,
        "status": if e.solutions.is_some() { "derived" } else { "refused" },
        "given": e.given.iter().map(|q| text(*q)).collect::<Vec<_>>(),
        "given_by_choice": e.given_by_choice,
        "matrices": e.matrices.iter()
            .map(|(name, product)| formula(&Math::Products(vec![name.clone()], product.clone()))).collect::<Vec<_>>(),
        "steps": steps,
        "joints": all(&e.joints),
        "pose_conditions": all(&e.leftovers),
        "max_solutions": e.solutions,
        "missing": e.missing.iter().map(|q| text(*q)).collect::<Vec<_>>(),
        "proof": words().proof(e.proof()),
    });
    format!("{document}\n")
}
