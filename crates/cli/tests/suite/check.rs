//! `denavit check`: exit codes, JSON, Markdown, the marked document, points.

use crate::common::{fed, text};
use serde_json::Value;
use std::path::PathBuf;

const TABLE: &str = "# Elbow\n\nconvention: standard\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n\
                     | 1 | θ1 | 0 | a1 | 0 |\n| 2 | θ2 | 0 | a2 | 0 |\n\n";

/// A document in a folder of its own.
fn document(name: &str, text: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("denavit-check-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("sheet.md");
    std::fs::write(&file, format!("{TABLE}{text}\n")).expect("a file");
    file
}

/// The exit code and what is printed.
fn run(arguments: &[&str]) -> (i32, String) {
    let output = fed(arguments, "");
    (output.status.code().expect("an exit code"), text(&output.stdout))
}

#[test]
fn exit_codes_tell_right_wrong_and_unreadable() {
    for (name, text, code) in [
        ("right", "x = a1 C1 + a2 C12", 0),
        ("wrong", "x = a1 C1 + a2 C2", 1),
        ("unreadable", "x = a1 C1 + zeta C12", 3),
        ("both", "x = a1 C1 + a2 C2\n\ny = a1 S1 + zeta S12", 1),
        ("nothing", "Nothing is claimed here.", 3),
    ] {
        let file = document(name, text);
        assert_eq!(run(&["check", &file.to_string_lossy()]).0, code, "{name}");
    }
    assert_eq!(run(&["check", "no-such-file.md"]).0, 3);
    let file = document("named", "x = 0");
    assert_eq!(run(&["check", "staubli-rx90", &file.to_string_lossy()]).0, 1);
}

#[test]
fn the_answer_as_json() {
    let file = document("json", "x = a1 C1 + a2 C2");
    let answer = run(&["check", &file.to_string_lossy(), "--json"]);
    let answer: Value = serde_json::from_str(&answer.1).expect("JSON");
    assert_eq!((answer["schema"].as_i64(), answer["tally"]["wrong"].as_i64()), (Some(1), Some(1)));
    let claim = &answer["claims"][0];
    assert_eq!((claim["claim"].as_str(), claim["verdict"].as_str()), (Some("x"), Some("wrong")));
    assert_eq!(claim["correct"].as_str(), Some("a1 C1 + a2 C12"));
    assert_eq!(claim["slip"]["kind"].as_str(), Some("index"));
    assert_eq!(claim["slip"]["patches"][0]["was"].as_str(), Some("C2"));
}

#[test]
fn the_marked_document() {
    let file = document("html", "x = a1 C1 + a2 C2 <b>");
    let page = file.with_extension("html");
    let file = document("html", "x = a1 C1 + a2 C2");
    run(&["check", &file.to_string_lossy(), "--html", &page.to_string_lossy()]);
    let page = std::fs::read_to_string(page).expect("a page");
    assert!(page.contains("<del>C2</del><ins>C12</ins>") && page.contains("<html lang=\"en\">"), "{page}");
}

#[test]
fn points_for_a_teacher() {
    let file = document("points", "x = a1 C1 + a2 C2\n\ny = a1 S1 + a2 S12");
    let rubric = file.with_extension("toml");
    let text = "title = \"Sheet 1\"\n[[items]]\nname = \"position\"\nclaims = [\"x\", \"y\"]\npoints = 4\n\
                [[items]]\nname = \"all or nothing\"\nclaims = [\"x\", \"y\"]\npoints = 2\nwhole = true\n";
    std::fs::write(&rubric, text).expect("a rubric");
    let sheet = run(&["check", &file.to_string_lossy(), "--rubric", &rubric.to_string_lossy()]).1;
    let line = |name: &str| sheet.lines().find(|l| l.contains(name)).unwrap_or_default().to_string();
    assert!(line("position").contains("2") && line("position").contains("1 of 2 right, not x"), "{sheet}");
    assert!(line("all or nothing").contains("0"), "{sheet}");
    // What the arm cannot have, and what is no value, is said.
    for wrong in [
        "claims = 3",
        "claims = [\"q*\"]\npoints = 1\nzeros = [{ joint = 7, value = \"0\" }]",
        "claims = [\"q*\"]\npoints = 1\nzeros = [{ joint = 2, value = \"180°x\" }]",
        "claims = [\"q*\"]\npoints = 1\nconfigurations = [{ q = [0.1, 0.2, 0.3] }]",
    ] {
        std::fs::write(&rubric, format!("[[items]]\n{wrong}\n")).expect("a rubric");
        let found = run(&["check", &file.to_string_lossy(), "--rubric", &rubric.to_string_lossy()]);
        assert_eq!(found.0, 3, "{wrong}: {found:?}");
    }
}

#[test]
fn the_list_as_markdown() {
    let file = document("markdown", "x = a1 C1 + a2 C2");
    let list = run(&["check", &file.to_string_lossy(), "--markdown"]).1;
    assert!(list.contains("| `x` |") && list.contains("`a1 C1 + a2 C12`"), "{list}");
}
