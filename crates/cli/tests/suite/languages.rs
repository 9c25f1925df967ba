//! `--language`: derivations in the words of each language.

use crate::common::{fed, text};

fn said(arguments: &[&str]) -> String {
    let output = fed(arguments, "");
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

#[test]
fn derivations_are_in_the_language_that_is_asked_for() {
    let verbs: [&[&str]; 4] = [
        &["derive", "planar-2r"],
        &["ik", "planar-2r", "--explain"],
        &["ik", "planar-2r", "--symbolic"],
        &["jacobian", "planar-2r", "--symbolic"],
    ];
    let heads = [
        (
            "en",
            ["Link transforms", "Inverse kinematics of the", "Inverse kinematics of the", "Jacobian of the"],
        ),
        (
            "fr",
            ["Matrices de passage", "Modèle géométrique inverse", "Modèle géométrique inverse", "Jacobienne"],
        ),
        ("de", ["Transformationsmatrizen", "Inverse Kinematik: ", "Inverse Kinematik: ", "Jacobi-Matrix: "]),
        ("es", ["Matrices de transformación", "Cinemática inversa: ", "Cinemática inversa: ", "Jacobiano: "]),
    ];
    for (language, heads) in heads {
        for (verb, head) in verbs.iter().zip(heads) {
            let shown = said(&[verb, &["--language", language][..]].concat());
            assert!(shown.contains(head), "{language}: {head}: {shown}");
            for other in heads_of_all(verb).into_iter().filter(|h| *h != head) {
                assert!(!shown.contains(other), "{language}: {other}: {shown}");
            }
        }
    }
}

fn heads_of_all(verb: &[&str]) -> Vec<&'static str> {
    match verb[0] {
        "derive" => {
            vec![
                "Link transforms",
                "Matrices de passage",
                "Transformationsmatrizen",
                "Matrices de transformación",
            ]
        }
        "ik" => vec![
            "Inverse kinematics of the",
            "Modèle géométrique inverse",
            "Inverse Kinematik: ",
            "Cinemática inversa: ",
        ],
        _ => vec!["Jacobian of the", "Jacobienne", "Jacobi-Matrix: ", "Jacobiano: "],
    }
}

/// Numbers have commas in words and formulas, and points in JSON, in code and in ASCII.
#[test]
fn json_keeps_its_points() {
    let german = said(&["report", "planar-3r", "-o", "-", "--format", "markdown", "--language", "de"]);
    assert!(german.contains("0{,}") && !german.contains("0.5"), "{german}");
    let output = fed(&["ik", "planar-2r", "--json", "--language", "de"], "");
    assert!(!output.status.success(), "JSON is of no language");
}
