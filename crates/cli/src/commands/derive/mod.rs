//! `denavit derive`: formulas, in the format asked for.

mod terminal;

use crate::arguments::{DeriveArguments, Format, RobotArguments};
use crate::commands::{certificate, document};
use crate::failure::Failure;
use crate::load;
use crate::terminal::words;
use denavit::description::{Description, Measure};
use denavit::forward::{Outputs, Proof, Reference};
use denavit::geometry::Rotation;
use denavit::geometry::orientation::{OrientationSet, extraction_formulas};
use denavit_report::Derivation;
use denavit_report::words::Tongue;
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use denavit_wire::forward::{Angles, Derived};
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
    let images = [(&arguments.point, true, "--point"), (&arguments.vector, false, "--vector")];
    let images: Vec<([Expr; 3], bool)> = images
        .into_iter()
        .filter_map(|(text, is_point, option)| Some((coordinates(text.as_deref()?, option), is_point)))
        .map(|(found, is_point)| Ok((found?, is_point)))
        .collect::<Result<_, Failure>>()?;
    write!(anstream::stdout(), "{}", printed(&derivation, &images, format, arguments.language.tongue()))?;
    let certified = match &arguments.certificate {
        Some(file) => {
            certificate::write(file, denavit_certificate::forward(&description, &derivation.model, outputs))
        }
        None => Ok(()),
    };
    verdict(&derivation).and(certified)
}

/// The simplified pose of the tool alone, with its orientation as angles where a set is asked for, for `fk --symbolic`.
///
/// # Errors
/// As [`run`].
pub fn matrix_only(
    robot: &RobotArguments,
    orientation: Option<OrientationSet>,
    format: Format,
) -> Result<(), Failure> {
    let description = load::robot(robot)?;
    let derivation = Derivation::new(&description, Reference::Base, Reference::Tool, Outputs::ALL);
    let angles = orientation.map(|set| angles(&derivation, set)).transpose()?;
    let text = match format {
        Format::Json => {
            let text = |e| derivation.text(e, Style::Ascii);
            let angles = angles.map(|(set, all)| Angles::of(set, &all, text));
            format!("{}\n", denavit_wire::text(&Derived { orientation: angles, ..Derived::of(&derivation) }))
        }
        _ => {
            let shown = |(set, all): (OrientationSet, Formulas)| terminal::angles(&derivation, set, &all);
            terminal::forward(&derivation) + &angles.map(shown).unwrap_or_default()
        }
    };
    write!(anstream::stdout(), "{text}")?;
    verdict(&derivation)
}

/// The formulas of a set of angles by their names.
type Formulas = Vec<(&'static str, Expr)>;

/// The tool's orientation as formulas in the joints.
fn angles(derivation: &Derivation, set: OrientationSet) -> Result<(OrientationSet, Formulas), Failure> {
    // What is not expanded has no entries to take angles of.
    let Ok(rows) = &derivation.model.matrix else { return Ok((set, vec![])) };
    let rotation = Rotation::from_rows([0, 1, 2].map(|r| [rows[r][0], rows[r][1], rows[r][2]]));
    let formulas = extraction_formulas(&rotation, set).ok_or_else(|| {
        Failure::Unsupported(format!("{set} as formulas; rpy and Euler sets such as zyz have them"))
    })?;
    Ok((set, formulas))
}

/// A frame by name or number.
///
/// # Errors
/// If the robot has no such frame.
pub fn reference(d: &Description, text: &str, option: &str) -> Result<Reference, Failure> {
    match text {
        "base" => Ok(Reference::Base),
        "tool" => Ok(Reference::Tool),
        _ => load::frame(d, text)
            .map(Reference::Frame)
            .map_err(|why| Failure::Usage(format!("{option} {text}: {why}, or `base` or `tool`"))),
    }
}

/// Three lengths, or names of such.
fn coordinates(text: &str, option: &str) -> Result<[Expr; 3], Failure> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let [x, y, z] = parts[..] else {
        return Err(Failure::Usage(format!("{option} {text}: three coordinates x, y, z")));
    };
    let is_name = |part: &str| {
        part.starts_with(|c: char| c.is_alphabetic()) && part.chars().all(|c| c.is_alphanumeric() || c == '_')
    };
    let read = |part: &str| match is_name(part) {
        true => Ok(Expr::symbol(part)),
        false => {
            load::value_of(part, Measure::Length).map_err(|why| Failure::Usage(format!("{option}: {why}")))
        }
    };
    Ok([read(x)?, read(y)?, read(z)?])
}

fn printed(
    derivation: &Derivation,
    images: &[([Expr; 3], bool)],
    format: Format,
    language: Tongue,
) -> String {
    let sections = images.iter().map(|(of, is_point)| derivation.image_section(*of, *is_point, language));
    match format {
        Format::Terminal if language == Tongue::English => {
            let shown = sections.map(|section| terminal::section(&section));
            terminal::whole(derivation) + &shown.collect::<String>()
        }
        Format::Json => {
            let found = |wanted: bool| {
                let (of, is_point) = images.iter().find(|image| image.1 == wanted)?;
                let image = derivation.image(*of, *is_point)?;
                Some(image.map(|e| derivation.text(e, Style::Ascii)))
            };
            let derived = Derived { point: found(true), vector: found(false), ..Derived::of(derivation) };
            format!("{}\n", denavit_wire::text(&derived))
        }
        Format::Terminal | Format::Latex | Format::Typst | Format::Html | Format::Markdown => {
            let mut document = derivation.document(language);
            document.sections.extend(sections);
            document::written(&document, format)
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
