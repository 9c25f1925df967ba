//! Reports, source code, figures.

use crate::refusal::Refusal;
use crate::subject::Subject;
use denavit::inverse;
use denavit_emit::{Language, Precision};
use denavit_generate::{PackageOptions, Wanted, generate};
use denavit_report::figure::svg::{Palette, svg};
use denavit_report::figure::{FigureOptions, View, isometric, scheme};
use denavit_report::words::Tongue;
use denavit_report::{ReportOptions, render};
use serde::{Deserialize, Serialize};

/// A file beside others.
#[derive(Serialize)]
struct File {
    path: String,
    text: String,
}

/// A report, in Markdown with its figures.
#[derive(Serialize)]
pub struct Written {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<File>,
    text: String,
}

/// The whole report.
///
/// # Errors
/// If there is no such format or language.
pub fn report(subject: &Subject, format: &str, language: &str, q: &[f64]) -> Result<Written, Refusal> {
    let refusal = || Refusal::new(format!("reports are not written in `{language}`: {}", Tongue::codes()));
    let language = Tongue::of_code(language).ok_or_else(refusal)?;
    let pose = Some(subject.configuration(q)?.to_vec());
    let document = denavit_report::report(
        &subject.description,
        &ReportOptions { language, pose, ..ReportOptions::default() },
    );
    let text = match format {
        // The page has the font itself, and puts it there.
        "html" => render::html_with(&document, "FONT"),
        "typst" => render::typst(&document),
        "latex" => render::latex(&document),
        "markdown" => {
            let written = render::markdown(&document, "figures");
            let figures = written.figures.into_iter().map(|(path, text)| File { path, text });
            return Ok(Written { files: figures.collect(), text: written.text });
        }
        other => return Err(Refusal::new(format!("no format `{other}`: html, typst, latex or markdown"))),
    };
    Ok(Written { files: vec![], text })
}

/// Source code.
#[derive(Serialize)]
pub struct Code {
    files: Vec<File>,
    /// The command that tests it.
    test: String,
    /// What is to be said of it, line by line.
    words: String,
}

/// Source code that builds and tests itself.
///
/// # Errors
/// If there is no such language.
pub fn code(subject: &Subject, language: &str, name: Option<String>) -> Result<Code, Refusal> {
    let wanted = |l: &Language| l.name().eq_ignore_ascii_case(language);
    let language = Language::ALL
        .into_iter()
        .find(wanted)
        .ok_or_else(|| Refusal::new(format!("no code is written in `{language}`")))?;
    // IKFast's interface has no Jacobian.
    let mut functions = vec![Wanted::Pose, Wanted::Jacobian, Wanted::Inverse];
    functions.retain(|w| language != Language::IkFast || *w != Wanted::Jacobian);
    let options = PackageOptions {
        language,
        functions,
        inverse: inverse::InverseOptions::default(),
        precision: Precision::Double,
        name: Some(name.unwrap_or_else(|| subject.description.name.clone())),
        masses: None,
        loads: denavit::dynamics::Loads::default(),
        fixed: false,
    };
    let made = generate(&subject.description, &options).map_err(|why| Refusal::new(why.to_string()))?;
    if let (Some(why), true) = (&made.refused, made.files.is_empty()) {
        return Err(Refusal::new(format!("ik: {why}")));
    }
    let mut words: Vec<String> =
        made.functions.iter().map(|f| format!("{}: {}; {}", f.wanted, f.count, f.claim)).collect();
    words.extend(made.refused.iter().map(|why| format!("no ik: {why}")));
    let test = made.test_command(language);
    let files = made.files.into_iter().map(|f| File { path: f.path, text: f.text }).collect();
    Ok(Code { files, test, words: words.join("\n") })
}

/// A figure that is asked for.
#[derive(Deserialize)]
pub struct Picture {
    q: Vec<f64>,
    scheme: bool,
    azimuth: Option<f64>,
    elevation: Option<f64>,
}

/// A figure.
#[derive(Serialize)]
pub struct Drawn {
    svg: String,
}

/// The arm, or its line diagram, as SVG.
///
/// # Errors
/// If the configuration does not fit.
pub fn figure(subject: &Subject, picture: &Picture) -> Result<Drawn, Refusal> {
    let arm = subject.arm.at(subject.configuration(&picture.q)?);
    let mut look = FigureOptions::main();
    if let (Some(azimuth), Some(elevation)) = (picture.azimuth, picture.elevation) {
        look.view = Some(View::from_angles(azimuth, elevation));
    }
    let drawing = if picture.scheme { scheme(&arm, &look) } else { isometric(&arm, &look) };
    Ok(Drawn { svg: svg(&drawing, Palette::File, "figure") })
}
