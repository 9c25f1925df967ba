//! `denavit derive`: formulas, in the format asked for.

mod terminal;

use crate::arguments::{DeriveArguments, Format, RobotArguments};
use crate::commands::{certificate, document};
use crate::failure::Failure;
use crate::load;
use crate::terminal::words;
use denavit::description::Description;
use denavit::forward::{Outputs, Proof, Reference};
use denavit_report::Derivation;
use denavit_report::words::Tongue;
use denavit_wire::forward::Derived;
use std::io::Write;

/// Derives a robot's formulas.
///
/// # Errors
/// If there is no such robot or frame, or nothing can be written.
pub fn run(arguments: &DeriveArguments) -> Result<(), Failure> {
    let description = load::robot(&arguments.robot)?;
    let from = reference(&description, &arguments.from, "--from")?;
    let to = reference(&description, &arguments.to, "--to")?;
    let outputs: Outputs = arguments.only.parse().map_err(|e| Failure::Usage(format!("--only: {e}")))?;
    let derivation = Derivation::new(&description, from, to, outputs);
    let format = if arguments.json { Format::Json } else { arguments.format };
    write!(anstream::stdout(), "{}", printed(&derivation, format))?;
    let certified = match &arguments.certificate {
        Some(file) => {
            certificate::write(file, denavit_certificate::forward(&description, &derivation.model, outputs))
        }
        None => Ok(()),
    };
    verdict(&derivation).and(certified)
}

/// The simplified pose of the tool alone, for `fk --symbolic`.
///
/// # Errors
/// As [`run`].
pub fn matrix_only(robot: &RobotArguments, format: Format) -> Result<(), Failure> {
    let description = load::robot(robot)?;
    let derivation = Derivation::new(&description, Reference::Base, Reference::Tool, Outputs::ALL);
    let text =
        if format == Format::Json { printed(&derivation, format) } else { terminal::forward(&derivation) };
    write!(anstream::stdout(), "{text}")?;
    verdict(&derivation)
}

/// A frame by name or number.
///
/// # Errors
/// If the robot has no such frame.
pub fn reference(d: &Description, text: &str, option: &str) -> Result<Reference, Failure> {
    let last = d.rows.len();
    match (text, text.parse::<usize>()) {
        ("base", _) => Ok(Reference::Base),
        ("tool", _) => Ok(Reference::Tool),
        (_, Ok(i)) if i <= last => Ok(Reference::Frame(i)),
        _ => Err(Failure::Usage(format!("{option} {text}: `base`, `tool`, or a frame from 0 to {last}"))),
    }
}

fn printed(derivation: &Derivation, format: Format) -> String {
    match format {
        Format::Terminal => terminal::document(derivation),
        Format::Json => format!("{}\n", denavit_wire::text(&Derived::of(derivation))),
        Format::Latex | Format::Typst | Format::Html => {
            document::written(&derivation.document(Tongue::English), format)
        }
    }
}

/// Whether everything was expanded and proved.
fn verdict(derivation: &Derivation) -> Result<(), Failure> {
    match (&derivation.model.matrix, derivation.model.proof) {
        (Err(why), _) => Err(Failure::GaveUp(format!("the matrix is not expanded: {why}"))),
        (_, Proof::Proved) => Ok(()),
        (_, proof) => Err(Failure::GaveUp(format!("the algorithm is {}", words().forward_proof(proof)))),
    }
}
