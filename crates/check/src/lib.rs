//! Formulas that somebody printed, held against the robot.
//!
//! A document is read as it is (`denavit_reading::document`), its names are given their meaning (`names`, `subject`, `lexis`), its
//! statements become pairs of formulas, printed and right (`walk`, `product`, `matrix`), and each pair is judged by proof
//! (`judge`). For what is wrong, the smallest change that mends it is looked for, first of the robot's table (`causes`),
//! then of the formula (`denavit_reading::slip`).

mod causes;
mod definitions;
pub mod inverse;
mod judge;
mod lexis;
mod matrix;
mod names;
mod numbers;
mod outcome;
mod plan;
mod product;
mod programs;
mod subject;
mod values;
mod walk;
mod whole;

pub use outcome::{
    Cause, Checked, Claim, Counterexample, Entry, Finding, Patch, Slip, Standing, Tally, Wrong,
};

use denavit::description::{Description, Diagnostic, Diagnostics, TableOptions};
use denavit_reading::code::Language;
use denavit_reading::document::{self, Document, Format};
use judge::Judge;
use plan::Plan;

/// The longest document, in bytes.
pub const MAX_BYTES: usize = 8_000_000;
/// The most formulas of a document that are judged.
pub(crate) const MAX_FORMULAS: usize = 20_000;

/// What may be told beside the document.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How the tables of the document are read.
    pub table: TableOptions,
    /// What the left side of the first statement means, `T06`.
    pub claim: Option<String>,
    /// How far a numeric answer may be off, in its own unit.
    pub tolerance: Option<f64>,
    /// The text is a program in this language.
    pub language: Option<Language>,
}

/// Holds a document against a robot, or against the tables that stand in it.
///
/// # Errors
/// If there is no robot: neither given nor a table in the document that can be read.
pub fn check(
    text: &str,
    format: Format,
    robot: Option<&Description>,
    options: &Options,
) -> Result<Checked, Vec<Diagnostic>> {
    let mut notes = Diagnostics::default();
    if text.len() > MAX_BYTES {
        notes.error(0..0, format!("the document has {} bytes; at most {MAX_BYTES} are read", text.len()));
        return Err(notes.list().to_vec());
    }
    let document = match options.language {
        Some(_) => Document::default(),
        None => document::read(text, format),
    };
    let plan = Plan::of(text, format, &document, robot, options, &mut notes)?;
    let walked = plan.walk(text, &document, options);
    if !plan.has_robot && walked.assertions.is_empty() {
        notes
            .error(0..0, "there is no robot: no table of Denavit-Hartenberg parameters stands in the document")
            .hint(
                "name the robot before the file, or put its table into the document, its header with at least three of \
                 theta, d, a, alpha, r",
            );
        return Err(notes.list().to_vec());
    }
    for (span, error) in &walked.skipped {
        let finding = notes.note(span.clone(), format!("passed over: {}", error.message));
        error.hint.iter().for_each(|hint| finding.hint(hint.clone()));
    }
    for error in &walked.refused {
        let finding = notes.warning(error.span.clone(), format!("not read: {}", error.message));
        error.hint.iter().for_each(|hint| finding.hint(hint.clone()));
    }
    for note in &document.notes {
        notes.warning(note.span.clone(), note.message.clone());
    }
    let (mut claims, remarks) = judge::judge(text, &plan, &walked, options.tolerance);
    for (span, remark) in remarks {
        notes.note(span, remark);
    }
    let mut causes = definitions::causes(&mut Judge::new(text, &plan, &walked), text, &walked, &claims);
    if causes.is_empty() {
        causes = causes::causes(text, &document, &plan, options, &walked, &mut claims);
    }
    let mut notes = notes.list().to_vec();
    notes.sort_by_key(|n| n.span.start);
    notes.dedup();
    Ok(Checked {
        claims,
        causes,
        notes,
        robots: plan.subjects.iter().map(|s| s.description.clone()).collect(),
    })
}
