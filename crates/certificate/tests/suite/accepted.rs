//! What the program proves is accepted: models of robots, inverse models, documents. All of the catalogue: `cargo xtask certificates`.

use crate::{checked, json, read, robot};
use denavit::Description;
use denavit::description::line_column;
use denavit::forward::{ForwardModel, Outputs, Reference};
use denavit::inverse::{InverseModel, InverseOptions};
use denavit::velocity::{JacobianModel, Singularities, Viewpoint};
use denavit_certificate::{Certificate, Obstacle};
use denavit_check::{CheckOptions, check};
use denavit_reading::document::Format;

/// Nothing is missing, there are so many claims, and the checker agrees.
#[track_caller]
fn accepted(mut certificate: Certificate, claims: usize) {
    assert!(certificate.missing.is_empty(), "{:?}", certificate.missing);
    assert_eq!(certificate.claims.len(), claims);
    let (code, said) = checked(&certificate.to_json());
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains(&format!("{claims} claims hold")), "{said}");
}

fn forward(description: &Description) -> Certificate {
    let model = ForwardModel::of_tool(description, Outputs::ALL);
    denavit_certificate::forward(description, &model, Outputs::ALL)
}

#[test]
fn forward_models() {
    // Standard, Craig and Khalil; twists of 45, 30 and 60 degrees, and constant angles that add up to a third.
    for name in ["ur5", "puma560-craig", "staubli-rx90", "oblique-6r", "agilex-piper", "smart5-six-rail"] {
        accepted(forward(&robot(name)), 24);
    }
}

#[test]
fn frames_in_frames_and_backwards() {
    let arm = robot("stanford");
    for (from, to) in [(Reference::Frame(1), Reference::Frame(4)), (Reference::Tool, Reference::Frame(2))] {
        let model = ForwardModel::derive(&arm, from, to, Outputs::ALL);
        accepted(denavit_certificate::forward(&arm, &model, Outputs::ALL), 24);
    }
}

#[test]
fn gears_couplings_roots_and_a_tool() {
    let arm = read(
        "name = \"gears\"\nconvention = \"standard\"\n[parameters]\nL = \"0.3 m\"\nlambda = \"\"\n\
         [[joints]]\ntheta = \"q1/2 + 10 deg\"\na = \"L\"\nalpha = \"15 deg\"\n\
         [[joints]]\ntheta = \"2*q2 - q1\"\nd = \"sqrt(2)*lambda\"\nalpha = \"0.3\"\n\
         [[joints]]\nd = \"q3 - lambda\"\ntheta = \"80 deg\"\n\
         [tool]\nxyz = [\"0\", \"L\", \"0.1\"]\nrpy = [\"0\", \"20 deg\", \"-0.3\"]\n",
    );
    accepted(forward(&arm), 24);
    let view = Viewpoint::of(Reference::Tool, Reference::Frame(2));
    accepted(denavit_certificate::jacobian(&arm, &JacobianModel::derive(&arm, view), &[]), 36);
}

#[test]
fn jacobians_and_determinants() {
    for (name, determinants) in [("ur5", 1), ("kinova-jaco", 1), ("franka-panda", 7)] {
        let arm = robot(name);
        let found = Singularities::derive(&arm, Reference::Tool).expect("it is short");
        let mut certificate = denavit_certificate::jacobian(&arm, &found.jacobian, &found.minors);
        assert!(certificate.missing.is_empty(), "{:?}", certificate.missing);
        let names = certificate.claims.iter().filter(|c| c.name.starts_with("determinant"));
        assert_eq!(names.count(), determinants);
        let (code, said) = checked(&certificate.to_json());
        assert_eq!(code, Some(0), "{said}");
    }
}

#[test]
fn equations_of_inverse_models() {
    for name in ["puma560", "ur5", "stanford", "scara"] {
        let model =
            InverseModel::derive(&robot(name), &InverseOptions::default()).expect("it has a closed form");
        let mut certificate = denavit_certificate::inverse(&model);
        assert!(certificate.missing.is_empty(), "{:?}", certificate.missing);
        let equations = certificate.claims.iter().filter(|c| c.name.starts_with("step")).count();
        assert!(equations >= model.steps.len(), "{name}: {equations} equations");
        let (code, said) = checked(&certificate.to_json());
        assert_eq!(code, Some(0), "{said}");
    }
}

#[test]
fn a_document() {
    let text = "| joint | theta | d | a | alpha |\n|---|---|---|---|---|\n| 1 | q1 | 0 | a1 | 0° |\n| 2 | q2 | 0 | a2 | 0° |\n\n\
         convention: standard\n\n$P_x = a_1 c_1 + a_2 c_{12}$\n\n$P_y = a_1 s_1 - a_2 s_{12}$\n\n\
         $\\theta_2 = \\mathrm{atan2}(\\sqrt{1 - D^2}, D)$ where nothing is known of D.\n";
    let checked_text = check(text, Format::Markdown, None, &CheckOptions::default()).expect("it has a table");
    let line = |at: usize| line_column(text, at).0;
    let mut certificate = denavit_certificate::document(&checked_text, 0, &line).expect("something is equal");
    // The second is wrong, the third is not read: only the first is claimed, as an entry of the table's own product.
    let names: Vec<&str> = certificate.claims.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["line 8: P_x"]);
    let text = certificate.to_json();
    assert!(json(&text)["claims"][0]["left"]["frame"].is_array(), "{text}");
    assert_eq!(checked(&text).0, Some(0));
}

#[test]
fn what_is_false_has_no_certificate() {
    let arm = robot("puma560");
    let mut model = ForwardModel::of_tool(&arm, Outputs::ALL);
    if let Ok(matrix) = &mut model.matrix {
        matrix[0][0] = -matrix[0][0];
    }
    let certificate = denavit_certificate::forward(&arm, &model, Outputs::ALL);
    assert_eq!(certificate.missing, [("matrix 1 1".to_string(), Obstacle::NoIdentity)]);
}

#[test]
fn the_checker_is_short_and_uses_the_standard_library_alone() {
    let text = std::fs::read_to_string(crate::CHECKER).expect("it is there");
    let code = text.splitn(3, "\"\"\"").nth(2).expect("what it says of itself, then code");
    let lines = code.lines().filter(|l| !l.trim().is_empty() && !l.trim_start().starts_with('#'));
    assert!(lines.count() < 200);
    let imports: Vec<&str> = code.lines().filter(|l| l.contains("import ")).collect();
    let standard = [
        "import ast",
        "import itertools",
        "import json",
        "import sys",
        "from fractions import Fraction",
        "from functools import reduce",
    ];
    assert_eq!(imports, standard);
}
