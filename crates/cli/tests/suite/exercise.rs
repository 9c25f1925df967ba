//! `denavit exercise`: sheets, and the task that marks answers.

use crate::common::{fed, text};
use std::fs;
use std::path::PathBuf;

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = fed(arguments, "");
    (output.status.code().expect("an exit code"), text(&output.stdout), text(&output.stderr))
}

fn folder(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("denavit-exercise-{}-{name}", std::process::id()))
}

/// What is earned of what can be, on the last line of a sheet of points.
fn sum(sheet: &str) -> [f64; 2] {
    let line = sheet.lines().find_map(|l| l.trim().strip_prefix("sum")).unwrap_or_else(|| panic!("{sheet}"));
    let all: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    [all[0], all[1]]
}

/// A task is a folder; its solution, marked by it, earns everything, and a slip does not.
#[test]
fn a_task_marks_its_solution() {
    for (kind, robot) in [("fk", "planar-3r"), ("ik", "planar-2r"), ("dh", "stanford")] {
        let folder = folder(kind);
        let at = |name: &str| folder.join(name).to_string_lossy().into_owned();
        let made =
            run(&["exercise", robot, "--kind", kind, "--seed", "9", "--task", &folder.to_string_lossy()]);
        assert_eq!(made.0, 0, "{}", made.2);
        let (code, sheet, said) = run(&["check", &at("task.toml"), &at("solution.md")]);
        assert_eq!(code, 0, "{kind}: {sheet}{said}");
        let task = fs::read_to_string(at("task.toml")).expect("a task");
        assert!(task.contains("formulas = "), "{task}");
        let points: f64 = task.lines().filter_map(|l| l.strip_prefix("points = ")?.parse::<f64>().ok()).sum();
        assert_eq!(sum(&sheet), [points; 2], "{sheet}");
        if kind == "fk" {
            let solution = fs::read_to_string(at("solution.md")).expect("a solution");
            fs::write(at("answer.md"), solution.replacen("-S_{1}", "S_{1}", 1)).expect("an answer");
            let (code, sheet, _) = run(&["check", &at("task.toml"), &at("answer.md")]);
            assert_eq!(code, 1);
            assert!(sum(&sheet)[0] < points, "{sheet}");
        }
        fs::remove_dir_all(&folder).expect("it is there");
    }
}

#[test]
fn sheets_in_all_formats() {
    let make =
        |more: &[&str]| run(&[&["exercise", "scara", "--kind", "jacobian", "--seed", "4"], more].concat());
    let (code, sheet, said) = make(&[]);
    assert_eq!(code, 0, "{said}");
    assert!(sheet.starts_with("# Exercise: Jacobian") && said.contains("-o FILE.md"), "{sheet}{said}");
    assert_eq!(sheet, make(&[]).1);
    assert!(make(&["--solution"]).1.starts_with("# Solution"));
    assert!(make(&["--format", "latex"]).1.contains("\\begin{document}"));
    assert!(make(&["--format", "typst"]).1.contains("Configuration 1"));
    assert!(make(&["--language", "fr"]).1.contains("Questions"));
    let json = |more| serde_json::from_str::<serde_json::Value>(&make(more).1).expect("it is JSON");
    assert!(json(&["--format", "json"]).get("solution").is_none());
    assert_eq!(json(&["--format", "json", "--solution"])["kind"], "jacobian");
    let folder = folder("formats");
    fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("sheet.md");
    assert_eq!(make(&["-o", &file.to_string_lossy()]).0, 0);
    assert!(folder.join("sheet-figures/figure-1.svg").exists());
    fs::remove_dir_all(&folder).expect("it is there");
}

#[test]
fn what_there_is_not_is_said() {
    assert_eq!(run(&["exercise", "kuka-iiwa-7", "--kind", "ik"]).0, 4);
    assert_eq!(run(&["exercise", "ur5", "--kind", "fk", "--count", "0"]).0, 2);
    assert_eq!(run(&["exercise", "ur5", "--kind", "fk", "-o", "sheet.docx"]).0, 2);
    assert_eq!(run(&["exercise", "cartesian-ppp", "--kind", "singularities"]).0, 4);
}

/// A class: a folder for each student, no two sheets alike, each marked by its own task; a wrong value is named.
#[test]
fn a_series_has_a_folder_for_each() {
    let folder = folder("series");
    fs::create_dir_all(&folder).expect("a folder");
    let at = |name: &str| folder.join(name).to_string_lossy().into_owned();
    fs::write(at("class.csv"), "Name,Group\nAnna,7\nBen,8\n").expect("a file");
    let arguments = ["exercise", "--kind", "path", "--difficulty", "easy", "--seed", "3", "--students"];
    let made = run(&[&arguments[..], &[&at("class.csv"), "--task", &at("task")]].concat());
    assert_eq!(made.0, 0, "{}", made.2);
    assert!(made.2.contains("the first row, `Name`, is a head"), "{}", made.2);
    let read = |name: &str| fs::read_to_string(at(name)).expect("a file");
    assert!(read("task/series.csv").starts_with("name,seed,robot\nAnna,3,"));
    let sheet = |name: &str| read(name).lines().skip(4).map(String::from).collect::<Vec<_>>();
    assert_ne!(sheet("task/Anna/exercise.md"), sheet("task/Ben/exercise.md"));
    let (code, sheet, said) = run(&["check", &at("task/Ben/task.toml"), &at("task/Ben/solution.md")]);
    assert_eq!(code, 0, "{sheet}{said}");
    let wrong = read("task/Ben/solution.md").replacen("$T = ", "$T = -", 1);
    fs::write(at("answer.md"), wrong).expect("an answer");
    let (code, sheet, _) = run(&["check", &at("task/Ben/task.toml"), &at("answer.md")]);
    assert!(code == 1 && sheet.contains("T: a sign, right is "), "{sheet}");
    fs::remove_dir_all(&folder).expect("it is there");
    assert_eq!(run(&["exercise", "--kind", "fk", "--series", "2"]).0, 2);
}

/// The same numbers are asked for in Moodle, PrairieLearn and a notebook, and they are those of the solution.
#[test]
fn exercises_for_other_systems() {
    let folder = folder("systems");
    fs::create_dir_all(&folder).expect("a folder");
    let at = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let read = |name: &str| fs::read_to_string(at(name)).expect("a file");
    for (kind, numbers) in
        [("fk", 4), ("ik", 4), ("jacobian", 7), ("transforms", 12), ("statics", 3), ("path", 16), ("dh", 0)]
    {
        let made = |more: &[&str]| {
            let (code, out, said) = run(&[&["exercise", "--kind", kind, "--seed", "4"], more].concat());
            assert_eq!(code, 0, "{kind}: {said}");
            out
        };
        made(&["-o", &at("x.xml")]);
        made(&["-o", &at("x.ipynb")]);
        made(&["--format", "prairielearn", "-o", &at(kind)]);
        let moodle = read("x.xml");
        assert_eq!(denavit::description::root_element(&moodle), Some("quiz"));
        assert_eq!(moodle.matches(":NUMERICAL:=").count(), numbers, "{kind}");
        assert_eq!(moodle.matches("<question type=\"essay\">").count() == 0, kind == "path");
        let notebook: serde_json::Value = serde_json::from_str(&read("x.ipynb")).expect("it is JSON");
        let cells = notebook["cells"].as_array().expect("cells");
        let sources: String = cells.iter().filter_map(|c| c["source"].as_str()).collect();
        assert_eq!(sources.matches("assert abs(").count(), numbers, "{kind}");
        assert!(cells.iter().any(|c| c["metadata"]["nbgrader"]["points"].as_f64() > Some(0.0)));
        let info = fs::read_to_string(folder.join(kind).join("info.json")).expect("a file");
        let info: serde_json::Value = serde_json::from_str(&info).expect("it is JSON");
        assert_eq!(info["uuid"].as_str().map(str::len), Some(36));
        let page = fs::read_to_string(folder.join(kind).join("question.html")).expect("a file");
        let values: Vec<&str> =
            page.split("correct-answer=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(values.len(), numbers, "{kind}");
        // Mustache has these for itself.
        assert!(!page.contains("{{"), "{kind}");
        if kind == "statics" {
            let solution = made(&["--solution"]);
            assert!(
                values.iter().all(|value| solution.contains(&format!("= {value} "))),
                "{values:?}{solution}"
            );
        }
    }
    // A class in one file: as many questions with gaps as students.
    let made = run(&["exercise", "--kind", "statics", "--series", "3", "-o", &at("pool.xml")]);
    assert_eq!(made.0, 0, "{}", made.2);
    assert_eq!(read("pool.xml").matches("type=\"cloze\"").count(), 3);
    fs::remove_dir_all(&folder).expect("it is there");
}
