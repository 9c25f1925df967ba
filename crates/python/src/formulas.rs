//! What is derived of a robot, as text: formulas, explanations, verdicts on documents, source code.

use crate::named::{body, options, reference};
use crate::trouble::{Found, Kind, Trouble, apart, found};
use denavit::description::Description;
use denavit::dynamics::{DynamicModel, Loads, Recursion, Representatives};
use denavit::forward::Outputs;
use denavit::inverse::InverseModel;
use denavit::velocity::{JacobianModel, Obstacle, Singularities, singular_configurations};
use denavit_check::{CheckOptions, Checked, check as judged};
use denavit_emit::{Language, Precision};
use denavit_generate::{PackageOptions, Wanted};
use denavit_reading::document::{Format, readable};
use denavit_report::document::{Block, plain, text};
use denavit_report::explain::{
    Explanation, dynamics_explanation, found_singularities_document, recursion_vocabulary,
    singularities_document, velocity_vocabulary,
};
use denavit_report::figure::svg::{Palette, svg};
use denavit_report::figure::{Arm, FigureOptions, isometric, scheme as line_diagram};
use denavit_report::words::Tongue;
use denavit_report::{Derivation, Document, Part, ReportOptions, Section, render};
use denavit_symbolic::Symbol;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use pyo3::prelude::*;

/// Files with their texts, what is said of each function, and the command that tests them.
pub type Code = (Vec<(String, String)>, Vec<String>, String);

const FORMATS: &str = "text, latex, typst, markdown, html or json";

/// A document in a format; `json` makes that of it.
fn written(document: &Document, format: &str, json: impl FnOnce() -> String) -> Result<String, Trouble> {
    Ok(match format {
        "text" => document.sections.iter().map(|s| plain_text(s, document.language)).collect(),
        "latex" => render::latex_fragment(document),
        "typst" => render::typst_fragment(document),
        "markdown" => render::markdown(document, "figures").text,
        "html" => render::html(document),
        "json" => json(),
        _ => return Err(Trouble::new(Kind::Usage, format!("no format `{format}`: {FORMATS}"))),
    })
}

/// A section as text.
fn plain_text(section: &Section, language: Tongue) -> String {
    let names = &section.names;
    let formula = |math: &_| Block::Formula { math: Clone::clone(math), number: None, proof: None };
    let mut out = String::new();
    for part in &section.parts {
        let blocks: Vec<Block> = match part {
            Part::Block(block) => vec![block.clone()],
            Part::Equations(all) | Part::Beside(all) => all.iter().map(formula).collect(),
            Part::Code(code) => {
                out += code;
                vec![]
            }
            Part::Summary(lines) => {
                for (label, value) in lines {
                    out += &format!("  {}: {}\n", plain(label, names), plain(value, names));
                }
                vec![]
            }
            Part::Table(table) => {
                for row in [&table.head].into_iter().chain(&table.rows) {
                    let cells: Vec<String> = row.iter().map(|c| plain(c, names)).collect();
                    out += &format!("  {}\n", cells.join("  "));
                }
                vec![]
            }
            Part::Figure(figure) => {
                out += &format!("  [{}]\n", plain(&figure.caption, names));
                vec![]
            }
        };
        out += &text(&blocks, names, language, &|_, words| words.to_string());
    }
    out
}

/// Blocks under a title as a document.
fn of_blocks(title: String, names: Vocabulary, blocks: Vec<Block>) -> Document {
    let section = Section { names, parts: blocks.into_iter().map(Part::from).collect() };
    Document { title, author: None, language: Tongue::English, sections: vec![section] }
}

/// The forward model.
///
/// # Errors
/// If there is no such frame, part or format.
pub fn forward(d: &Description, format: &str, from: &str, to: &str, only: &str) -> Result<String, Trouble> {
    let outputs: Outputs = only.parse().map_err(|e| Trouble::new(Kind::Usage, format!("only: {e}")))?;
    let derivation = Derivation::new(d, reference(d, from)?, reference(d, to)?, outputs);
    let document = derivation.document(Tongue::English);
    written(&document, format, || denavit_wire::text(&denavit_wire::forward::Derived::of(&derivation)))
}

/// The derivation of the closed form.
///
/// # Errors
/// If there is none.
pub fn inverse(
    d: &Description,
    format: &str,
    given: Option<&[String]>,
    goal: &str,
) -> Result<String, Trouble> {
    let options = options(d, given, goal)?;
    let model = InverseModel::derive(d, &options).map_err(|why| {
        Trouble::new(
            Kind::Unsupported,
            format!("no closed form: {why}; `ik` answers in numbers all the same"),
        )
    })?;
    let explanation = Explanation::of(&model);
    let title = format!("Inverse kinematics of the {}", d.name);
    let document = of_blocks(title, explanation.names(), explanation.document(Tongue::English));
    written(&document, format, || denavit_wire::text(&denavit_wire::derivation::Derivation::of(&explanation)))
}

/// The Jacobian and where it is singular.
///
/// # Errors
/// If there is no such body or format.
pub fn jacobian(d: &Description, format: &str, of: &str) -> Result<String, Trouble> {
    let body = body(d, of)?;
    let title = format!("Jacobian of the {}", d.name);
    let names = |model: &JacobianModel| {
        let steps = model.algorithm.steps().into_iter().map(|step| step.name);
        steps.fold(velocity_vocabulary(d), |v, name| v.symbol(&name))
    };
    match Singularities::derive(d, body) {
        Ok(found) => {
            let names = names(&found.jacobian);
            let blocks = singularities_document(d, &found, Tongue::English);
            written(&of_blocks(title, names.clone(), blocks), format, || {
                let text = |e| print(e, &names, Style::Ascii);
                let point = found.of_its_point(d);
                let model = denavit_wire::singular::Model::with_singularities;
                denavit_wire::text(&model(&d.name, &found, point.as_ref(), text))
            })
        }
        // The matrix is there all the same, and numbers.
        Err(why) => {
            let model = JacobianModel::shortest(d, body);
            let names = names(&model);
            let found = match why {
                Obstacle::AlwaysSingular(_) => Ok(vec![]),
                _ => singular_configurations(d, &model.view, &[0, 1, 2, 3, 4, 5]),
            };
            let blocks = found_singularities_document(d, &model, &why, found.as_deref(), Tongue::English);
            written(&of_blocks(title, names.clone(), blocks), format, || {
                let (text, found) = (|e| print(e, &names, Style::Ascii), found.as_deref().ok());
                denavit_wire::text(&denavit_wire::singular::Model::without_singularities(
                    &d.name, &model, &why, found, text,
                ))
            })
        }
    }
}

/// Torques as formulas, in base parameters for which parameters of the links stand that are chosen, where there are any.
///
/// # Errors
/// If these cannot be chosen.
pub fn torques(d: &Description, kept: &[String], dropped: &[String]) -> Result<DynamicModel, Trouble> {
    let symbols = |names: &[String]| names.iter().map(|name| Symbol::new(name)).collect();
    let wanted = Representatives { kept: symbols(kept), dropped: symbols(dropped) };
    if wanted == Representatives::default() {
        return Ok(DynamicModel::derive(d));
    }
    DynamicModel::derive_for(d, &wanted).map_err(|why| Trouble::new(Kind::Usage, why.to_string()))
}

/// Torques as formulas, step by step.
///
/// # Errors
/// If there is no such format, or parameters cannot be chosen.
pub fn dynamics(
    d: &Description,
    format: &str,
    kept: &[String],
    dropped: &[String],
) -> Result<String, Trouble> {
    let model = torques(d, kept, dropped)?;
    let recursion = Recursion::derive(d, &model.formulas, &model.base);
    let names = recursion_vocabulary(d, &model, &recursion);
    let blocks = dynamics_explanation(d, &model, &recursion, Tongue::English);
    let title = Tongue::English.words().dynamics_title(&d.name);
    written(&of_blocks(title, names.clone(), blocks), format, || {
        let text = |e| print(e, &names, Style::Ascii);
        let mut wire = denavit_wire::dynamics::Model::of(&d.name, &model, text);
        wire.recursion = Some(denavit_wire::dynamics::Recursive::of(&recursion, text));
        denavit_wire::text(&wire)
    })
}

/// A language by its code.
///
/// # Errors
/// If nothing is written in it.
pub fn tongue(language: &str) -> Result<Tongue, Trouble> {
    let trouble = || {
        let codes = Tongue::codes();
        Trouble::new(Kind::Usage, format!("documents are not written in `{language}`: {codes}"))
    };
    Tongue::of_code(language).ok_or_else(trouble)
}

/// The report.
///
/// # Errors
/// If there is no such format or language.
pub fn report(d: &Description, format: &str, language: &str) -> Result<String, Trouble> {
    let language = tongue(language)?;
    let document = denavit_report::report(d, &ReportOptions { language, ..ReportOptions::default() });
    Ok(match format {
        "html" => render::html(&document),
        "typst" => render::typst(&document),
        "latex" => render::latex(&document),
        _ => return Err(Trouble::new(Kind::Usage, format!("no format `{format}`: html, typst or latex"))),
    })
}

/// The arm, or its line diagram, as SVG.
///
/// # Errors
/// If a length has no value that could be chosen.
pub fn figure(d: &Description, q: Option<&[f64]>, scheme: bool) -> Result<String, Trouble> {
    let arm = Arm::new(&d.filled()).map_err(Trouble::missing)?;
    let n = d.variables().len();
    let arm = match q {
        Some(q) if q.len() != n => {
            return Err(Trouble::new(Kind::Shape, format!("q has {} values; {n} are needed", q.len())));
        }
        Some(q) => arm.at(q),
        None => arm,
    };
    let look = FigureOptions::main();
    let drawing = if scheme { line_diagram(&arm, &look) } else { isometric(&arm, &look) };
    Ok(svg(&drawing, Palette::File, "arm"))
}

/// The claims of a document, each with its verdict.
///
/// # Errors
/// If it cannot be read.
pub fn judged_as(text: &str, name: &str, d: Option<&Description>) -> Result<Checked, Trouble> {
    let judged = judged(text, Format::of(name, text), d, &CheckOptions::default());
    judged.map_err(|notes| {
        let words = Tongue::English.words();
        let notes: Vec<Found> = notes.iter().map(|n| found(&words.note(n), name, text)).collect();
        Trouble::of(notes)
    })
}

/// The claims of a document, each with its verdict, as JSON.
///
/// # Errors
/// If it cannot be read.
pub fn checked(text: &str, name: &str, d: Option<&Description>) -> Result<String, Trouble> {
    let text = &readable(name, text.to_string());
    let judged = judged_as(text, name, d)?;
    Ok(denavit_wire::text(&denavit_wire::check::Checked::of(name, text, &judged)))
}

/// The claims of a document about the robots in it, as JSON.
#[pyfunction]
pub fn check(py: Python<'_>, text: String, name: String) -> PyResult<String> {
    apart(py, move || checked(&text, &name, None))
}

/// Source code that builds and tests itself.
///
/// # Errors
/// If there is no such language or function, or there can be no such code.
pub fn code(
    d: &Description,
    language: &str,
    functions: &[String],
    name: Option<String>,
    goal: &str,
) -> Result<Code, Trouble> {
    let usage = |why: String| Trouble::new(Kind::Usage, why);
    let known = || Language::ALL.map(|l| l.name().to_lowercase()).join(", ");
    let language = Language::ALL
        .into_iter()
        .find(|l| l.name().eq_ignore_ascii_case(language))
        .ok_or_else(|| usage(format!("no code is written in `{language}`: {}", known())))?;
    let mut wanted: Vec<Wanted> = vec![];
    for function in functions {
        let one: Wanted = function.parse().map_err(usage)?;
        if !wanted.contains(&one) {
            wanted.push(one);
        }
    }
    let options = PackageOptions {
        language,
        functions: wanted,
        inverse: options(d, None, goal)?,
        precision: Precision::Double,
        name: Some(name.unwrap_or_else(|| d.name.clone())),
        masses: None,
        loads: Loads::default(),
        fixed: false,
    };
    let made = denavit_generate::generate(d, &options);
    let made = made.map_err(|why| Trouble::new(Kind::Unsupported, why.to_string()))?;
    if let (Some(why), true) = (&made.refused, made.files.is_empty()) {
        return Err(Trouble::new(Kind::Unsupported, format!("ik: {why}")));
    }
    let mut said: Vec<String> =
        made.functions.iter().map(|f| format!("{}: {}; {}", f.wanted, f.count, f.claim)).collect();
    said.extend(made.refused.iter().map(|why| format!("no ik: {why}")));
    let test = made.test_command(language);
    Ok((made.files.into_iter().map(|f| (f.path, f.text)).collect(), said, test))
}
