//! A certificate that was tampered with is refused, whatever was changed: the formulas, the cofactors, the table, the list.

use crate::{checked, json, robot};
use denavit::forward::{ForwardModel, Outputs, Reference};
use denavit::velocity::Singularities;
use serde_json::{Value, json};

fn forward(name: &str) -> Value {
    let arm = robot(name);
    let model = ForwardModel::of_tool(&arm, Outputs::ALL);
    json(&denavit_certificate::forward(&arm, &model, Outputs::ALL).to_json())
}

fn determinant() -> Value {
    let arm = robot("scara");
    let found = Singularities::derive(&arm, Reference::Tool).expect("it is short");
    json(&denavit_certificate::jacobian(&arm, &found.jacobian, &found.minors).to_json())
}

/// Refuses a certificate after a change, for this reason.
#[track_caller]
fn refuses(mut certificate: Value, change: impl FnOnce(&mut Value), why: &str) {
    let before = certificate.clone();
    change(&mut certificate);
    assert_ne!(certificate, before, "nothing was changed");
    let (code, said) = checked(&certificate.to_string());
    assert_ne!(code, Some(0), "{said}");
    assert!(said.contains(why), "{said}");
}

/// The first claim with cofactors.
fn proved(certificate: &mut Value) -> &mut Value {
    let claims = certificate["claims"].as_array_mut().expect("claims");
    claims.iter_mut().find(|c| c["cofactors"].as_object().is_some_and(|c| !c.is_empty())).expect("a proof")
}

/// The first cofactor of a claim.
fn cofactor(certificate: &mut Value) -> &mut Value {
    proved(certificate)["cofactors"].as_object_mut().and_then(|c| c.values_mut().next()).expect("a cofactor")
}

const NO_SUM: &str = "is not the sum of cofactors";

#[test]
fn a_formula() {
    let puma = || forward("puma560");
    let edit =
        |text: &Value, from: &str, to: &str| json!(text.as_str().expect("a formula").replacen(from, to, 1));
    refuses(puma(), |c| c["claims"][3]["right"] = edit(&c["claims"][3]["right"], "+", "-"), NO_SUM);
    refuses(puma(), |c| c["claims"][3]["right"] = edit(&c["claims"][3]["right"], "cos", "sin"), NO_SUM);
    refuses(
        puma(),
        |c| {
            c["claims"][3]["right"] =
                json!(format!("2*({})", c["claims"][3]["right"].as_str().expect("it is")))
        },
        NO_SUM,
    );
    refuses(puma(), |c| c["definitions"][0][1] = edit(&c["definitions"][0][1], "cos", "2*cos"), NO_SUM);
    refuses(
        puma(),
        |c| c["claims"][0]["right"] = json!("sin(q1/q2)"),
        "denominator where there must be none",
    );
    refuses(puma(), |c| c["claims"][0]["right"] = json!("__import__('os').getcwd()"), "not understood");
    refuses(
        puma(),
        |c| c["claims"][0]["right"] = json!("1/(cos(q1)**2 + sin(q1)**2 - 1)"),
        "a denominator is 0",
    );
}

#[test]
fn a_cofactor() {
    let all = [determinant(), forward("agilex-piper")];
    for of in all {
        refuses(of.clone(), |c| cofactor(c)[0][0] = json!(7), NO_SUM);
        refuses(of.clone(), |c| cofactor(c)[0][2] = json!(3), NO_SUM);
        refuses(of.clone(), |c| cofactor(c)[0][2] = json!(-1), "not positive");
        refuses(of.clone(), |c| drop(cofactor(c).as_array_mut().map(|terms| terms.remove(0))), NO_SUM);
        refuses(of.clone(), |c| proved(c)["cofactors"] = json!({}), NO_SUM);
        refuses(
            of,
            |c| {
                let term = cofactor(c)[0].clone();
                cofactor(c).as_array_mut().expect("terms").push(term);
            },
            "not collected",
        );
    }
}

#[test]
fn the_table() {
    let ur = || forward("ur5");
    refuses(ur(), |c| c["robot"]["rows"][0]["alpha"] = json!("-pi/2"), NO_SUM);
    refuses(ur(), |c| c["robot"]["rows"][1]["a"] = json!("a3"), NO_SUM);
    refuses(ur(), |c| c["robot"]["rows"][3]["theta"] = json!("q4 + pi"), NO_SUM);
    refuses(ur(), |c| c["robot"]["convention"] = json!("craig"), NO_SUM);
    refuses(ur(), |c| c["robot"]["tool"][2][3] = json!("1"), NO_SUM);
    refuses(ur(), |c| drop(c["robot"]["rows"].as_array_mut().map(Vec::pop)), NO_SUM);
    refuses(
        ur(),
        |c| drop(c["robot"]["rows"][2].as_object_mut().map(|row| row.remove("alpha"))),
        "other cells",
    );
}

#[test]
fn what_names_mean() {
    let piper = || forward("agilex-piper");
    refuses(piper(), |c| drop(c["angles"].as_array_mut().map(Vec::pop)), "");
    refuses(piper(), |c| c["angles"][0][2] = json!("q2"), "");
    refuses(piper(), |c| c["parameters"][0] = c["variables"][0].clone(), "not a new name");
    refuses(piper(), |c| c["roots"] = json!([["c1", "2"]]), "not a new name");
    refuses(piper(), |c| c["roots"] = json!([["i", "-1"]]), "negative number");
    refuses(
        piper(),
        |c| c["definitions"].as_array_mut().expect("a list").push(json!(["q1", "0"])),
        "defined twice",
    );
    // Without its square a root is nothing that is known.
    let mut oblique = forward("oblique-6r");
    oblique["roots"][0][1] = json!("3");
    assert_ne!(checked(&oblique.to_string()).0, Some(0));
}

#[test]
fn the_list_of_claims() {
    let ur = || forward("ur5");
    refuses(ur(), |c| drop(c["claims"].as_array_mut().map(Vec::pop)), "summary");
    refuses(
        ur(),
        |c| {
            for list in ["claims", "summary", "missing"] {
                c[list] = json!([]);
            }
        },
        "it says nothing",
    );
    refuses(ur(), |c| c["claims"][1] = c["claims"][0].clone(), "summary");
    refuses(ur(), |c| c["claims"][0]["name"] = json!("another"), "summary");
    refuses(ur(), |c| c["claims"][0]["left"]["frame"][2] = json!(2), NO_SUM);
    refuses(ur(), |c| c["claims"][8]["left"]["frame"][2] = json!(0), "");
    refuses(determinant(), |c| c["claims"][0]["left"]["jacobian"][1] = json!(7), "no such entry");
    refuses(ur(), |c| c["format"] = json!("another"), "format");
    // A determinant stands on entries and minors that are claimed before it.
    let is_minor = |c: &Value| c["name"].as_str().is_some_and(|n| n.starts_with("minor"));
    let dropped = |c: &mut Value| {
        let k = c["claims"].as_array().and_then(|all| all.iter().position(is_minor)).expect("a minor");
        c["claims"].as_array_mut().map(|all| all.remove(k));
        c["summary"].as_array_mut().map(|all| all.remove(k));
    };
    refuses(determinant(), dropped, "");
}

#[test]
fn something_else() {
    assert_eq!(checked("{}").0, Some(3));
    assert_eq!(checked("no JSON").0, Some(3));
}
