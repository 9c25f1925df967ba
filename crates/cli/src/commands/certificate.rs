//! `--certificate FILE`: what is proved, for others to check.

use crate::failure::Failure;
use denavit_certificate::{Certificate, Obstacle};
use std::fs;
use std::path::Path;

/// Writes a certificate: for Coq if the file ends in `.v`, else for the checker.
///
/// # Errors
/// 5 if something that was asked for is not in it: the message says what; and if the file cannot be written.
pub fn write(file: &Path, mut certificate: Certificate) -> Result<(), Failure> {
    let is_coq = file.extension().is_some_and(|e| e == "v");
    let text = if is_coq { certificate.to_coq() } else { certificate.to_json() };
    fs::write(file, text).map_err(|e| Failure::Input(format!("error: {}: {e}", file.display())))?;
    // What was only compared is not expected.
    let missing = certificate.missing.iter().filter(|m| m.1 != Obstacle::Compared);
    let missing: Vec<String> = missing.map(|(name, why)| format!("{name}: {why}")).collect();
    if missing.is_empty() {
        return Ok(());
    }
    Err(Failure::GaveUp(format!("not in the certificate: {}", missing.join("; "))))
}
