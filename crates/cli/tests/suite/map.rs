//! `map`: the bits of `fk --input`, what is said, exit codes. The crate `map` has its own tests.

use super::common::{fed, text};
use super::recordings::{folder, run};
use serde_json::Value;
use std::fs;

/// Poses of a file, against those that `fk` answers line by line.
#[test]
fn poses_have_the_bits_of_fk() {
    let at = folder("map-fk");
    let (input, output) = (at.join("in.csv"), at.join("out.csv"));
    let row =
        |k: usize| (1..=6).map(|j| (k as f64 * 0.37 + j as f64 * 1.7).sin() * 3.0).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = (0..50).map(row).collect();
    let line = |q: &Vec<f64>| q.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let head = "q1,q2,q3,q4,q5,q6\n";
    let lines: Vec<String> = rows.iter().map(line).collect();
    fs::write(&input, head.to_string() + &lines.join("\n")).expect("written");
    let (input, output) = (input.to_string_lossy().into_owned(), output.to_string_lossy().into_owned());
    let (code, out, err) = run(&["map", "ur5", &input, "-o", &output, "--fk", "--json"]);
    assert_eq!(code, 0, "{err}");
    let said: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(
        (said["rows"].as_u64(), said["nulls"].as_u64(), said["schema"].as_u64()),
        (Some(50), Some(0), Some(1))
    );
    assert!(err.contains("note: 50 rows in "), "{err}");
    let json: String = lines.iter().map(|l| format!("[{l}]\n")).collect();
    let answers = text(&fed(&["fk", "ur5", "--input", "-"], &json).stdout);
    let found = fs::read_to_string(&output).expect("a text");
    let mut found = found.lines();
    assert_eq!(found.next(), Some("q1,q2,q3,q4,q5,q6,x,y,z,r11,r12,r13,r21,r22,r23,r31,r32,r33"));
    for (line, answer) in found.zip(answers.lines()) {
        let numbers: Vec<f64> = line.split(',').map(|x| x.parse().expect("a number")).collect();
        let answer: Value = serde_json::from_str(answer).expect("JSON");
        let entry = |r: usize, c: usize| answer["pose"][r][c].as_f64().expect("a number");
        let wanted: Vec<f64> =
            (0..3).map(|r| entry(r, 3)).chain((0..9).map(|k| entry(k / 3, k % 3))).collect();
        let bits = |all: &[f64]| all.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&numbers[6..]), bits(&wanted));
    }
}

#[test]
fn what_is_said_of_rows_without_numbers() {
    let at = folder("map-said");
    let (input, output) = (at.join("in.csv"), at.join("out.csv"));
    fs::write(&input, "q1,q2,q3,q4,q5,q6\n1,2,3,4,5,6\n1,,3,4,5,6\n1,2,nan,4,5,6\n").expect("written");
    let (input, output) = (input.to_string_lossy().into_owned(), output.to_string_lossy().into_owned());
    let (code, _, err) = run(&["map", "ur5", &input, "-o", &output, "--fk"]);
    assert_eq!(code, 0, "{err}");
    let said = "2 rows without all results: 1 with a null among the inputs, 1 with what is no finite number; the first is row 2";
    assert!(err.contains(said), "{err}");
    let (code, _, err) = run(&["map", "ur5", &input, "-o", &output, "--fk", "--strict"]);
    assert!(code == 3 && err.contains("row 2: an input is null"), "{err}");
}

#[test]
fn what_does_not_fit_is_refused() {
    let at = folder("map-refused");
    let input = at.join("in.csv");
    fs::write(&input, "q1,q2,q3,q4,q5,q6\n1,2,3,4,5,6\n").expect("written");
    let (input, output) =
        (input.to_string_lossy().into_owned(), at.join("out.csv").to_string_lossy().into_owned());
    let refused = |arguments: &[&str], code: i32, what: &str| {
        let all = [&["map", "ur5", &input, "-o", &output], arguments].concat();
        let (found, _, err) = run(&all);
        assert!(found == code && err.contains(what), "{arguments:?}: {found} {err}");
        assert!(!at.join("out.csv").exists());
    };
    refused(&[], 2, "nothing is to be computed");
    refused(&["--torque"], 2, "says nothing of masses");
    refused(&["--fk", "--frame", "9"], 2, "--frame 9");
    refused(&["--fk", "--units", "inch"], 2, "no unit `inch`");
    refused(&["--fk", "--orientation", "up"], 2, "--orientation");
    refused(&["--fk", "--joints", "q1..q5"], 3, "5 columns, and 6 are needed");
    refused(&["--ik"], 3, "poses are in no columns that are known");
    refused(&["--fk", "--limits"], 2, "--limits is of --ik");
    refused(&["--fk", "--resume"], 3, "--resume writes Parquet alone");
    let (code, _, err) = run(&["map", "ur5", &input, "-o", "out.xls", "--fk"]);
    assert!(code == 2 && err.contains("map reads and writes .parquet"), "{err}");
}
