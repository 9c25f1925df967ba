//! Names: every one is in the documentation, and what is said in several answers has one.

use super::answers::{answers, judged};
use denavit::catalogue;
use denavit_report::{ReportOptions, report};
use denavit_wire::parts::{Part, parts};
use serde_json::Value;
use std::collections::BTreeSet;

const DOCUMENTATION: &str = include_str!("../../../../docs/json.md");

/// Maps whose keys are names of joints and symbols.
const MAPS: [&str; 2] = ["given", "counterexample"];

/// All keys of an answer, but those of maps.
fn keys(value: &Value, out: &mut BTreeSet<String>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                out.insert(key.clone());
                if !MAPS.contains(&key.as_str()) {
                    keys(value, out);
                }
            }
        }
        Value::Array(all) => all.iter().for_each(|value| keys(value, out)),
        _ => {}
    }
}

fn keys_of(answer: &str) -> BTreeSet<String> {
    let mut out = BTreeSet::new();
    keys(&serde_json::from_str(answer).expect("it is JSON"), &mut out);
    out
}

fn value(answer: &str) -> Value {
    serde_json::from_str(answer).expect("it is JSON")
}

#[test]
fn every_name_is_documented() {
    let documented: BTreeSet<&str> = DOCUMENTATION
        .split('`')
        .skip(1)
        .step_by(2)
        .flat_map(|code| code.split(['"', ' ', ':', ',']))
        .collect();
    let mut said: BTreeSet<String> = BTreeSet::new();
    for name in ["staubli-rx90", "franka-panda", "stanford"] {
        said.extend(answers(name).iter().flat_map(|(_, answer)| keys_of(answer)));
    }
    said.extend(keys_of(&judged()));
    said.extend(super::parallel::answers().iter().flat_map(|answer| keys_of(answer)));
    // The letters of tables are those of the conventions.
    let letters = ["a", "alpha", "b", "d", "gamma", "r", "theta"];
    let missing: Vec<&String> = said
        .iter()
        .filter(|key| !documented.contains(key.as_str()) && !letters.contains(&key.as_str()))
        .collect();
    assert!(missing.is_empty(), "docs/json.md does not tell of {missing:?}");
    let is_snake = |key: &&String| key.chars().all(|c| c.is_ascii_lowercase() || c == '_');
    assert_eq!(said.iter().filter(|key| !is_snake(key)).count(), 0, "{said:?}");
}

#[test]
fn limits_have_one_name() {
    let all = answers("puma560");
    let [fk, ik, path] =
        ["fk", "ik", "path"].map(|verb| value(&all.iter().find(|a| a.0 == verb).expect("it is answered").1));
    for place in [&fk, &ik["solutions"][0], &ik["nearest"], &ik["best"], &path["starts"][0]] {
        assert!(place["within_limits"].is_boolean(), "{place}");
    }
}

/// A family is one of its members and more.
#[test]
fn a_family_is_a_solution() {
    let all = answers("puma560");
    let q = [0.3, -0.4, 0.2, 0.5, 0.0, -0.2];
    let d = catalogue::robot("puma560").expect("it is in the catalogue");
    let solver = denavit::inverse::InverseKinematics::new(&d, &Default::default()).expect("it is solved");
    let pose = solver.robot.pose(&q);
    let answer = solver.solve(&pose, &[]);
    let family = denavit_wire::inverse::Family::of(&answer.families[0], &solver.space);
    let family = keys_of(&denavit_wire::text(&family));
    let ik = value(&all.iter().find(|a| a.0 == "ik").expect("it is answered").1);
    let solution = keys_of(&ik["solutions"][0].to_string());
    assert!(solution.len() > 4 && solution.is_subset(&family), "{solution:?} {family:?}");
}

#[test]
fn every_verdict_has_its_reasons() {
    let judged = value(&judged());
    let claims = judged["claims"].as_array().expect("claims");
    let verdicts: Vec<&str> = claims.iter().filter_map(|c| c["verdict"].as_str()).collect();
    for (verdict, reason) in [("wrong", "slip"), ("conditional", "condition"), ("unreadable", "errors")] {
        let at = verdicts.iter().position(|v| *v == verdict);
        let at = at.unwrap_or_else(|| panic!("no claim is {verdict}: {verdicts:?}"));
        assert!(!claims[at]["entries"][0][reason].is_null(), "{}", claims[at]);
        assert_eq!(judged["tally"][verdict], verdicts.iter().filter(|v| **v == verdict).count());
    }
    assert_eq!(verdicts[0], "equal");
    assert!(claims[0]["entries"][0].get("slip").is_none(), "{}", claims[0]);
}

#[test]
fn a_report_is_a_list_of_parts() {
    let d = catalogue::robot("planar-2r").expect("it is in the catalogue");
    let parts = parts(&report(&d, &ReportOptions::default()));
    let text = denavit_wire::text(&parts);
    let told = value(&text);
    assert_eq!(told.as_array().map(Vec::len), Some(parts.len()));
    for (part, told) in parts.iter().zip(told.as_array().expect("parts")) {
        if let Part::Formula { formula, number, proof } = part {
            assert_eq!(told["kind"], "formula");
            for notation in [&formula.c, &formula.latex, &formula.mathml, &formula.python, &formula.typst] {
                assert!(!notation.is_empty(), "{told}");
            }
            assert_eq!(
                (told["number"].is_null(), told["proof"].is_null()),
                (number.is_none(), proof.is_none())
            );
        }
    }
    let kinds: BTreeSet<&str> =
        told.as_array().expect("parts").iter().filter_map(|p| p["kind"].as_str()).collect();
    for kind in ["equations", "figure", "formula", "heading", "paragraph", "summary", "table"] {
        assert!(kinds.contains(kind), "{kinds:?}");
    }
}
