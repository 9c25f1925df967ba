//! Printed formulas held against the robot.

use crate::refusal::Refusal;
use crate::subject::Subject;
use denavit_check::check as checked;
use denavit_reading::document::{Format, readable};
use denavit_report::words::Tongue;
use denavit_wire::check::Checked;

/// The claims of a text, each with its verdict.
///
/// # Errors
/// If the text cannot be read.
pub fn check(subject: &Subject, text: &str, name: &str) -> Result<Checked, Refusal> {
    let text = &readable(name, text.to_string());
    let format = Format::of(name, text);
    match checked(text, format, Some(&subject.description), &denavit_check::CheckOptions::default()) {
        Ok(found) => Ok(Checked::of(name, text, &found)),
        Err(notes) => {
            let first = notes.first().map(|n| Tongue::English.words().note(n));
            let hint = first.as_ref().and_then(|d| d.hint.clone());
            Err(Refusal { error: first.map_or_else(|| "nothing can be read".into(), |d| d.message), hint })
        }
    }
}
