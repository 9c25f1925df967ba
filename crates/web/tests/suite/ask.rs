//! Requests of the page, answered natively.

use serde_json::{Value, json};

pub fn ask(op: &str, input: Value) -> Value {
    let request = json!({ "op": op, "input": input }).to_string();
    let text = match op {
        "formulas" | "values" | "singular" | "workspace" | "path" | "fall" => {
            denavit_web::answer_more(&request)
        }
        "solve" => denavit_web::answer_inverse(&request),
        "read" | "tree" => denavit_web::answer_read(&request),
        "report" | "code" | "figure" => denavit_web::answer_written(&request),
        "check" | "recording" => denavit_web::answer_check(&request),
        _ => denavit_web::answer(&request),
    };
    serde_json::from_str(&text).expect("an answer is JSON")
}

/// The answer, which is no refusal.
pub fn told(op: &str, input: Value) -> Value {
    let answer = ask(op, input);
    assert!(answer.get("error").is_none(), "{op}: {answer}");
    answer
}

pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
}

fn flat(matrix: &Value) -> Vec<f64> {
    matrix.as_array().into_iter().flatten().flat_map(numbers).collect()
}

pub fn far(a: &Value, b: &Value) -> f64 {
    flat(a).iter().zip(flat(b)).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}
