//! Certificates, held by the checker that uses none of the crates; and that it refuses what is not so.

mod accepted;
mod refused;

use denavit::Description;
use serde_json::Value;
use std::io::Write;
use std::process::{Command, Stdio};

const CHECKER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/check_certificate.py");

/// The checker's exit code and what it prints, for a certificate on its standard input.
fn checked(certificate: &str) -> (Option<i32>, String) {
    let python = std::env::var("DENAVIT_PYTHON").unwrap_or("python3".into());
    let mut checker = Command::new(python)
        .args([CHECKER, "/dev/stdin"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("Python starts");
    let mut input = checker.stdin.take().expect("it has a standard input");
    input.write_all(certificate.as_bytes()).expect("it reads");
    drop(input);
    let output = checker.wait_with_output().expect("it ends");
    (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
}

/// A robot of the catalogue.
fn robot(name: &str) -> Description {
    denavit::catalogue::robot(name).expect("it is in the catalogue")
}

/// A robot file.
fn read(toml: &str) -> Description {
    denavit::description::read_toml(toml).expect("it is a robot file").0
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("a certificate is JSON")
}
