//! `denavit check TASK FOLDER`: a table of students and items.

use crate::common::{fed, text};
use serde_json::Value;
use std::path::{Path, PathBuf};

const ROBOT: &str = "name = \"planar\"\nconvention = \"standard\"\n[parameters]\na1 = {}\na2 = {}\n\
                     [[joints]]\ntheta = \"q1\"\na = \"a1\"\n[[joints]]\ntheta = \"q2\"\na = \"a2\"\n";
const TASK: &str = "title = \"Sheet 1\"\nrobot = \"arm.toml\"\n[[items]]\nname = \"position\"\nclaims = [\"x\", \"y\"]\n\
                    points = 4\n[[items]]\nname = \"determinant\"\nclaims = \"det J\"\npoints = 2\n";

/// A folder with a task and a class.
fn class(name: &str, documents: &[(&str, &[u8])]) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("denavit-class-{}-{name}", std::process::id()));
    std::fs::write(made(&folder).join("arm.toml"), ROBOT).expect("a robot");
    std::fs::write(folder.join("task.toml"), TASK).expect("a task");
    for (name, text) in documents {
        let file = folder.join("sent").join(name);
        made(file.parent().expect("a folder"));
        std::fs::write(file, text).expect("a document");
    }
    folder
}

fn made(folder: &Path) -> &Path {
    std::fs::create_dir_all(folder).expect("a folder");
    folder
}

fn run(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let [task, sent] = ["task.toml", "sent"].map(|f| folder.join(f).to_string_lossy().into_owned());
    let output = fed(&[&["check", &task, &sent], arguments].concat(), "");
    (output.status.code().expect("an exit code"), text(&output.stdout))
}

const RIGHT: &[u8] = b"x = a1 C1 + a2 C12\n\ny = a1 S1 + a2 S12\n\ndet J = a1 a2 S2\n";
const SLIP: &[u8] = b"x = a1 C1 + a2 C2\n\ny = a1 S1 + a2 S12\n\ndet J = a1 a2 S2\n";

#[test]
fn a_table_of_students() {
    let wide: Vec<u8> = "\u{feff}"
        .encode_utf16()
        .chain(String::from_utf8_lossy(RIGHT).encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    let documents: [(&str, &[u8]); 6] = [
        ("anna.md", RIGHT),
        ("ben.txt", SLIP),
        ("cem.md", SLIP),
        ("dora.md", b"x = a1 C1 + zeta C12\n\ny = a1 S1 + a2 S12\n"),
        ("emil.md", b""),
        ("fay.txt", &wide),
    ];
    let folder = class("table", &documents);
    let (code, json) = run(&folder, &["--json"]);
    let json: Value = serde_json::from_str(&json).expect("JSON");
    let points: Vec<Option<f64>> =
        json["students"].as_array().expect("students").iter().map(|s| s["points"].as_f64()).collect();
    assert_eq!((code, points), (1, vec![Some(6.0), Some(4.0), Some(4.0), Some(2.0), None, Some(6.0)]));
    assert_eq!(json["students"][3]["open"].as_f64(), Some(2.0));
    assert_eq!(json["students"][4]["error"].as_str(), Some("the document is empty"));
    let slip = &json["slips"][0];
    assert_eq!((slip["claim"].as_str(), slip["slip"].as_str()), (Some("x"), Some("an index")));
    assert_eq!(slip["students"].as_array().map(Vec::len), Some(2));
    let [page, sheet] = ["class.html", "class.csv"].map(|f| folder.join(f).to_string_lossy().into_owned());
    let (_, table) = run(&folder, &["--html", &page, "--csv", &sheet]);
    assert!(table.contains("position (4)") && table.contains("2 × x: an index  (ben, cem)"), "{table}");
    assert!(table.contains("2 + 2?") && table.contains("dora, line 1: a1 C1 + zeta C12"), "{table}");
    let page = std::fs::read_to_string(page).expect("a page");
    assert!(
        page.contains("<a href=\"#s1\">ben</a>") && page.contains("<del>C2</del><ins>C12</ins>"),
        "{page}"
    );
    let sheet = std::fs::read_to_string(sheet).expect("a table");
    assert!(sheet.contains("\nben,2,2,4,6,0,\n") && sheet.contains("\nemil,,,,,,the document"), "{sheet}");
    let (_, markdown) = run(&folder, &["--markdown"]);
    assert!(
        markdown.contains("| ben | 2 | 2 | 4 |") && markdown.contains("1 of 2 right, not x"),
        "{markdown}"
    );
}

#[test]
fn formulas_of_latex_are_typeset_with_their_slips() {
    let markdown = b"The hand is at $x = a_1 C_1 + a_2 C_{2}$.\n\n$$\ny = a_1 S_1 + a_2 S_{12}\n$$\n\nIt costs $5 and `$x$`.\n";
    let latex = b"\\begin{align}\nx &= a_1 C_1 + a_2 C_{12} \\\\\ny &= \\foo{S}\n\\end{align}\n\\[\\det J = a_1 a_2 S_2\\]\n";
    let folder = class("typeset", &[("ben.md", markdown), ("cem.tex", latex), ("dora.txt", SLIP)]);
    let page = folder.join("class.html").to_string_lossy().into_owned();
    run(&folder, &["--html", &page]);
    let page = std::fs::read_to_string(page).expect("a page");
    let index = "<mrow class=\"del\"><msub><mi>C</mi><mn>2</mn></msub></mrow><mrow class=\"ins\"><msub><mi>C</mi><mn>12</mn></msub></mrow>";
    assert!(page.contains(index), "{page}");
    assert!(page.contains("<span class=\"display\"><math display=\"block\""), "{page}");
    // The formula with a command that nobody knows stands as it was written, the next one is set.
    assert!(page.contains("\\foo{S}") && page.contains("alttext=\"\\det J = a_1 a_2 S_2\""), "{page}");
    assert!(page.contains("It costs $5 and `$x$`."), "{page}");
    assert!(page.contains("<del>C2</del><ins>C12</ins>"), "{page}");
    assert!(page.contains("@font-face{font-family:\"Denavit Maths\""));
}

#[test]
fn exit_codes_of_a_class() {
    let folder = class("right", &[("a.md", RIGHT), ("b.md", RIGHT)]);
    assert_eq!(run(&folder, &[]).0, 0);
    let folder = class("open", &[("a.md", RIGHT), ("b.md", b"%PDF-1.7\n")]);
    assert_eq!(run(&folder, &[]).0, 3);
    let folder = class("same", &[("a/sheet.md", RIGHT), ("b/sheet.md", SLIP)]);
    let task = folder.join("task.toml").to_string_lossy().into_owned();
    let files = ["a", "b"].map(|f| folder.join("sent").join(f).to_string_lossy().into_owned());
    let output = fed(&["check", &task, &files[0], &files[1]], "");
    let table = text(&output.stdout);
    assert!(
        output.status.code() == Some(1) && table.contains("a/sheet") && table.contains("b/sheet"),
        "{table}"
    );
    std::fs::write(&task, TASK.replace("robot = \"arm.toml\"\n", "")).expect("a task");
    let output = fed(&["check", &task, &files[0]], "");
    assert!(output.status.code() == Some(3) && text(&output.stderr).contains("a task names its robot"));
}
