//! The derivation as JSON; formulas are plain text that parses back.

use crate::commands::robots::joints;
use crate::terminal::words;
use denavit_report::Derivation;
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use serde_json::{Value, json};

/// Schema 1 of `derive`.
pub fn document(d: &Derivation) -> String {
    let text = |e: Expr| d.text(e, Style::Ascii);
    let rows = |m: &[[Expr; 4]; 4]| -> Value { m.iter().map(|row| row.map(text).to_vec()).collect() };
    let plain = |e: Expr| d.in_full(e, Style::Ascii);
    let trigonometry = d.trigonometry().into_iter();
    let mut steps: Vec<Value> = trigonometry
        .map(|(name, value)| json!({"name": name, "value": plain(value), "output": false}))
        .collect();
    steps.extend(
        d.steps.iter().map(|s| json!({"name": s.name, "value": text(s.value), "output": s.is_output})),
    );
    let count = d.model.algorithm.count();
    let [from, to] = d.frames();
    let variables = d.description.variables();
    let document = json!({
        "schema": 1,
        "robot": d.description.name,
        "convention": d.description.convention.name(),
        "joints": variables.iter().zip(joints(d.description).chars())
            .map(|(v, kind)| json!({"name": &*v.symbol.name(), "kind": kind.to_string()})).collect::<Vec<_>>(),
        "links": d.links.iter().map(rows).collect::<Vec<_>>(),
        "forward": {
            "from": from,
            "to": to,
            "matrix": d.model.matrix.as_ref().map(rows).ok(),
            "steps": steps,
            "count": {
                "multiplications": count.multiplications,
                "additions": count.additions,
                "sincos": count.sincos,
                "offsets": count.offsets,
                "hoisted": count.hoisted,
                "depth": d.model.algorithm.depth(),
                "cycles": d.model.algorithm.cycles(),
            },
            "proof": words().forward_proof(d.model.proof),
        },
    });
    format!("{document}\n")
}
