//! Exercise sheets, and what answers earn. The same options make the same sheet, so that nothing of it is kept.

use crate::formulas::{judged_as, tongue};
use crate::trouble::{Kind, Trouble};
use denavit::description::Description;
use denavit_reading::document::{Format, readable};
use denavit_report::{Exercise, ExerciseOptions, NoExercise, exercise, render};

/// What a sheet is made from: its kind, seed, count and language.
pub type Request = (String, u64, usize, String);

fn made(d: &Description, (kind, seed, count, language): &Request) -> Result<Exercise, Trouble> {
    let kind = kind.parse().map_err(|why: String| Trouble::new(Kind::Usage, why))?;
    let options = ExerciseOptions { kind, seed: *seed, count: *count, language: tongue(language)? };
    exercise(d, &options).map_err(|why| match why {
        NoExercise::Values(missing) => Trouble::missing(missing),
        NoExercise::Count(_) => Trouble::new(Kind::Usage, why.to_string()),
        _ => Trouble::new(Kind::Unsupported, why.to_string()),
    })
}

/// Everything as JSON.
///
/// # Errors
/// If the robot has not what such an exercise is about.
pub fn data(d: &Description, request: &Request) -> Result<String, Trouble> {
    Ok(denavit_wire::text(&denavit_wire::exercise::Exercise::of(&made(d, request)?, true)))
}

/// The tasks or the solution, as a document of their own.
///
/// # Errors
/// As [`data`]; and if there is no such format.
pub fn sheet(d: &Description, request: &Request, format: &str, solution: bool) -> Result<String, Trouble> {
    let made = made(d, request)?;
    let document = if solution { &made.solution } else { &made.statement };
    Ok(match format {
        "markdown" => render::markdown(document, "figures").text,
        "html" => render::html(document),
        "latex" => render::latex(document),
        "typst" => render::typst(document),
        _ => {
            let known = "markdown, html, latex or typst";
            return Err(Trouble::new(Kind::Usage, format!("no format `{format}`: {known}")));
        }
    })
}

/// The claims of an answer with their verdicts, and what it earns, as JSON both.
///
/// # Errors
/// As [`data`]; and if the answer cannot be read.
pub fn marked(
    d: &Description,
    request: &Request,
    text: &str,
    name: &str,
) -> Result<(String, String), Trouble> {
    let made = made(d, request)?;
    let text = &readable(name, text.to_string());
    let mut checked = judged_as(text, name, Some(&made.robot))?;
    made.rubric.answer(text, Format::of(name, text), &mut checked);
    let marked = denavit_wire::exercise::Marked::of(&made.rubric, &made.rubric.mark(text, &checked));
    Ok((
        denavit_wire::text(&denavit_wire::check::Checked::of(name, text, &checked)),
        denavit_wire::text(&marked),
    ))
}
