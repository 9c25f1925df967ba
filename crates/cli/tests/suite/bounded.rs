//! Every verb on arms of ordinary life (calibrated, out of a URDF, geared): it ends within its memory, with an answer or with
//! exit code 4 or 5 that says what is missing.
#![cfg(target_os = "linux")]

use crate::common::text;
use std::process::Command;

/// Of address space, in kB: 2 GB, and what is mapped without being used.
const MEMORY: u32 = 2_600_000;
/// CPU seconds after which a verb hangs; in a release build all take less than 20.
const SECONDS: u32 = 120;

/// A verb on an arm of `crates/robot/tests/cases`.
#[track_caller]
fn ends(verb: &str, arm: &str, options: &[&str]) {
    let file = format!("{}/../robot/tests/cases/{arm}.toml", env!("CARGO_MANIFEST_DIR"));
    let limited = format!("ulimit -v {MEMORY} && ulimit -t {SECONDS} && exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &limited, env!("CARGO_BIN_EXE_denavit"), verb, &file]).args(options);
    let output = command.env("NO_COLOR", "1").output().expect("a shell");
    let (said, printed) = (text(&output.stderr), text(&output.stdout));
    match output.status.code() {
        Some(0) => assert!(!output.stdout.is_empty() || verb == "report", "{verb} {arm}: nothing"),
        // What no method serves in formulas: numbers are had without `--explain`.
        Some(4) => assert!(said.contains("not supported: "), "{verb} {arm} does not say why: {said}"),
        Some(5) => {
            assert!(said.contains("gave up: "), "{verb} {arm} does not say why: {said}");
            // What is had in numbers is given.
            let is_had = verb != "jacobian" || options != ["--explain"] || printed.contains("In numbers, ");
            assert!(is_had, "{verb} {arm} gives nothing: {printed}");
        }
        code => panic!("{verb} {arm} {options:?}: {code:?}, {}\n{said}", output.status),
    }
}

/// All verbs but those about paths.
fn all(arm: &str) {
    ends("derive", arm, &[]);
    ends("jacobian", arm, &["--symbolic"]);
    ends("jacobian", arm, &["--explain"]);
    ends("ik", arm, &["--explain"]);
    let page = std::env::temp_dir().join(format!("denavit-bounded-{arm}-{}.html", std::process::id()));
    ends("report", arm, &["-o", page.to_str().expect("UTF-8")]);
    std::fs::remove_file(page).expect("a report was written");
}

#[test]
fn calibrated_arms() {
    all("ur5cal");
    ends("path", "ur5cal", &["-q=0.3,-0.5,0.7,-0.8,1.1,-0.9", "--line", "+0.05,0.02,-0.03"]);
}

#[test]
fn arms_out_of_a_urdf() {
    all("so101");
    ends("path", "gen3_7", &["-q=0.3,-0.5,0.7,-0.8,1.1,-0.9,0.2", "--line", "+0.05,0.02,-0.03"]);
}

#[test]
fn calibrated_and_geared() {
    all("ur5ecal");
    all("irb5400");
}
