//! Typst on this machine, as a program or as a Python package.

use std::io::Write;
use std::process::{Command, Stdio};

/// What compiles a document from its standard input to its standard output.
const COMPILERS: [(&str, &[&str]); 3] =
    [("typst", &["compile", "-", "-"]), ("python3", &["-c", PYTHON]), ("python", &["-c", PYTHON])];

const PYTHON: &str = "import sys, typst; sys.stdout.buffer.write(typst.compile(sys.stdin.buffer.read()))";

/// The document as PDF; nothing if there is no Typst on this machine.
///
/// # Errors
/// What Typst says, if it refuses the document.
pub fn pdf(markup: &str) -> Result<Option<Vec<u8>>, String> {
    for (program, arguments) in COMPILERS {
        let Some((out, errors)) = run(program, arguments, markup) else { continue };
        if out.starts_with(b"%PDF") {
            return Ok(Some(out));
        }
        // A Python without the package is no Typst.
        let is_absent = errors.contains("No module named");
        if !is_absent {
            return Err(errors.trim().to_string());
        }
    }
    Ok(None)
}

/// What a program writes to its outputs; nothing if it cannot be started.
fn run(program: &str, arguments: &[&str], input: &str) -> Option<(Vec<u8>, String)> {
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .ok()?;
    let mut stdin = child.stdin.take()?;
    let input = input.as_bytes().to_vec();
    // It may write before it has read everything.
    let writer = std::thread::spawn(move || stdin.write_all(&input));
    let output = child.wait_with_output().ok()?;
    // A program that does not read has said why.
    let _ = writer.join();
    Some((output.stdout, String::from_utf8_lossy(&output.stderr).into_owned()))
}
