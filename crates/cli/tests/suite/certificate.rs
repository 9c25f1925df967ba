//! `--certificate FILE`: which file is written, how the command ends, what it says is missing.

use crate::common::{fed, text};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

fn file(name: &str) -> PathBuf {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_file(&file);
    file
}

/// The certificate that a command writes.
#[track_caller]
fn written(arguments: &[&str], name: &str, code: i32) -> String {
    let file = file(name);
    let path = file.to_str().expect("a path of the project");
    let output = fed(&[arguments, &["--certificate", path]].concat(), "");
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
    fs::read_to_string(file).expect("it is written")
}

fn claims(certificate: &str) -> usize {
    let value: Value = serde_json::from_str(certificate).expect("JSON");
    assert_eq!(value["format"], "denavit certificate 1");
    assert_eq!(value["missing"], Value::Array(vec![]));
    value["claims"].as_array().map_or(0, Vec::len)
}

#[test]
fn each_verb_that_proves_writes_one() {
    assert_eq!(claims(&written(&["derive", "scara"], "derive.json", 0)), 24);
    assert_eq!(claims(&written(&["derive", "scara", "--only", "position"], "position.json", 0)), 15);
    assert_eq!(claims(&written(&["jacobian", "scara", "--symbolic"], "jacobian.json", 0)), 48);
    assert!(claims(&written(&["jacobian", "scara", "--explain"], "determinant.json", 0)) > 48);
    assert!(claims(&written(&["ik", "scara", "--explain"], "ik.json", 0)) > 6);
}

#[test]
fn a_name_of_coq_gives_a_file_for_coq() {
    let written = written(&["derive", "scara"], "scara.v", 0);
    assert!(written.contains("Lemma matrix_1_4 :"), "{written}");
}

#[test]
fn it_goes_with_formulas_alone() {
    let path = file("none.json");
    let path = path.to_str().expect("a path of the project");
    let output = fed(&["jacobian", "scara", "-q", "0,0,0,0", "--certificate", path], "");
    assert_eq!(output.status.code(), Some(2));
    let output = fed(&["jacobian", "scara", "--certificate", path], "");
    assert_eq!(output.status.code(), Some(2));
}
