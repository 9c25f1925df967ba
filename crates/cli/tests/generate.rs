//! `denavit generate`: which files, where, and what is refused. That they build and agree is `cargo xtask languages`.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn denavit(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_denavit"));
    command.args(arguments).env("NO_COLOR", "1").output().expect("the command starts")
}

/// An empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

/// The folder of a robot in a language, and the answer.
#[track_caller]
fn generated(robot: &str, language: &str, folder: &Path, more: &[&str]) -> Value {
    let path = folder.to_str().expect("a path of the project");
    let arguments = ["generate", robot, "--language", language, "--output", path, "--json"];
    let output = denavit(&[&arguments[..], more].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one JSON value")
}

#[track_caller]
fn refused(arguments: &[&str], code: i32, says: &str) {
    let output = denavit(arguments);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{text}");
    assert!(text.contains(says), "{text}");
}

fn texts(folder: &Path, answer: &Value) -> Vec<String> {
    let files = answer["files"].as_array().expect("a list of files");
    let read =
        |f: &Value| fs::read_to_string(folder.join(f.as_str().expect("a path"))).expect("the file is there");
    files.iter().map(read).collect()
}

#[test]
fn every_language_writes_what_it_says() {
    for language in ["rust", "c", "python", "matlab", "javascript", "cuda"] {
        let folder = folder(&format!("all-{language}"));
        let answer = generated("stanford", language, &folder, &["--functions", "fk, frames,"]);
        assert_eq!(answer["functions"][0]["name"], "fk");
        assert_eq!(answer["functions"][1]["proved"], true, "{answer}");
        for text in texts(&folder, &answer) {
            assert!(text.contains("Stanford"), "the title stands in every file");
        }
        let again = generated("stanford", language, &folder, &["--functions", "fk,frames"]);
        assert_eq!(answer, again, "the same files do not stand in their own way");
    }
}

#[test]
fn files_of_others_are_not_overwritten() {
    let folder = folder("in-the-way");
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join("ur5.c"), "mine").expect("a file");
    let path = folder.to_str().expect("a path");
    let arguments = ["generate", "ur5", "--language", "c", "--output", path];
    refused(&arguments, 3, "--force");
    assert_eq!(fs::read_to_string(folder.join("ur5.c")).expect("still there"), "mine");
    assert!(!folder.join("ur5.h").exists(), "nothing is written by halves");
    generated("ur5", "c", &folder, &["--force"]);
    assert!(folder.join("ur5.h").exists());

    fs::remove_file(folder.join("ur5.c")).expect("a file");
    fs::create_dir(folder.join("ur5.c")).expect("a folder");
    fs::remove_file(folder.join("ur5.h")).expect("a file");
    refused(&[&arguments[..], &["--force"]].concat(), 3, "a folder stands where a file should");
    assert!(!folder.join("ur5.h").exists(), "nothing is written by halves");
}

#[test]
fn refusals() {
    refused(
        &["generate", "ur5", "--language", "c", "-o", "x", "--functions", "ik2"],
        2,
        "known are fk, frames",
    );
    refused(&["generate", "ur5", "--language", "python", "-o", "x", "--float"], 2, "double precision");
    refused(&["generate", "ur5", "--language", "c", "-o", "x", "--name", "/"], 2, "--name needs");
    refused(&["generate", "prrrrp", "--language", "c", "-o", "x", "--fixed"], 3, "no value for");
    refused(&["generate", "ur5", "--language", "cobol", "-o", "x"], 2, "javascript");
}

#[test]
fn names_stay_in_the_folder() {
    let folder = folder("names");
    let answer = generated("ur5", "c", &folder, &["--name", "../../evil"]);
    assert!(
        answer["files"]
            .as_array()
            .expect("files")
            .iter()
            .all(|f| !f.as_str().expect("a path").contains(".."))
    );
}

#[test]
fn a_parameter_called_like_a_result_is_not_mistaken_for_it() {
    let folder = folder("results");
    fs::create_dir_all(&folder).expect("a folder");
    let robot = folder.join("tee.toml");
    let text = "name = \"Tee\"\nconvention = \"standard\"\n[parameters]\nt11 = 0.3\nt14 = 0.2\n\
                [[joints]]\ntheta = \"q1\"\na = \"t11\"\nalpha = \"90 deg\"\n[[joints]]\ntheta = \"q2\"\na = \"t14\"\n";
    fs::write(&robot, text).expect("a file");
    let answer = generated(robot.to_str().expect("a path"), "python", &folder.join("out"), &[]);
    let module = &texts(&folder.join("out"), &answer).concat();
    assert!(module.contains("t11 = parameters.t11"), "{module}");
    assert_eq!(module.matches("    t11 = ").count(), 1, "one thing is called t11:\n{module}");
}

#[test]
fn fixed_values_leave_no_parameters() {
    let folder = folder("fixed");
    let answer = generated("ur5", "c", &folder, &["--fixed"]);
    assert!(texts(&folder, &answer).iter().all(|text| !text.contains("ur5_parameters")));
}
