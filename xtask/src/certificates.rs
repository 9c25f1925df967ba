//! Certificates of everything that the project proves, held by the checker of its own; some by Coq.

use crate::errata::{DOCUMENTS, FOLDER};
use crate::languages::{apt, quietly};
use crate::{command, path, program, robots, starts};
use anyhow::{Result, bail};
use std::fs;
use std::path::{Path, PathBuf};

/// Those that Coq looks at, too: what is asked, of which robot.
const FOR_COQ: &[(&str, &str)] = &[
    ("derive", "puma560"),
    ("derive", "ur5"),
    ("derive", "staubli-rx90"),
    ("jacobian", "scara"),
    ("jacobian", "puma560"),
    ("ik", "scara"),
];
const CHECKER: &str = "crates/certificate/check_certificate.py";

/// Writes all certificates and has them checked; installs Coq if it is not there.
///
/// # Errors
/// If a certificate is not complete, or refused.
pub fn run() -> Result<()> {
    let folder = path("target/certificates");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    for robot in robots()? {
        for verb in ["derive", "jacobian", "ik"] {
            write(verb, &robot, &folder.join(format!("{robot}-{verb}.json")))?;
        }
    }
    for document in DOCUMENTS {
        let file = folder.join(format!("document-{document}.json"));
        write("check", &format!("{FOLDER}/{document}.md"), &file)?;
    }
    let files: Vec<PathBuf> = fs::read_dir(&folder)?.map(|e| Ok(e?.path())).collect::<Result<_>>()?;
    quietly(command("python3").arg(path(CHECKER)).args(&files))?;
    println!("{} certificates are accepted by {CHECKER}", files.len());
    coq(&folder)
}

fn write(verb: &str, of: &str, file: &Path) -> Result<()> {
    let mut run = command(program()?);
    run.args([verb, of, "--certificate"]).arg(file);
    if matches!(verb, "jacobian" | "ik") {
        run.arg("--explain");
    }
    let output = run.output()?;
    // Documents have claims that are wrong; some arms have no closed form.
    let is_expected = match output.status.code() {
        Some(0) => true,
        Some(1 | 3) => verb == "check",
        Some(4) => verb == "ik",
        _ => false,
    };
    if !is_expected || (verb != "ik" && !file.exists()) {
        bail!("{run:?}: {}\n{}", output.status, String::from_utf8_lossy(&output.stderr));
    }
    Ok(())
}

fn coq(folder: &Path) -> Result<()> {
    if !starts("coqc") {
        println!("installing Coq");
        apt(&["update", "-qq"])?;
        apt(&["install", "-y", "-qq", "--no-install-recommends", "coq"])?;
    }
    for (verb, robot) in FOR_COQ {
        let file = folder.join(format!("{}_{verb}.v", robot.replace('-', "_")));
        write(verb, robot, &file)?;
        quietly(command("coqc").arg(&file).current_dir(folder))?;
    }
    println!("{} certificates are accepted by Coq", FOR_COQ.len());
    Ok(())
}
