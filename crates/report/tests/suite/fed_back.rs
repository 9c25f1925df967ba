//! What is written about a robot, fed back to the check: nothing of it is accused, and most of it is proved.

use denavit::catalogue;
use denavit::description::Description;
use denavit::forward::{Outputs, Reference};
use denavit::inverse::{InverseModel, InverseOptions};
use denavit::velocity::Singularities;
use denavit_check::{CheckOptions, Standing, check};
use denavit_reading::document::{Format, readable};
use denavit_report::document::Block;
use denavit_report::explain::{Explanation, singularities_document, velocity_vocabulary};
use denavit_report::words::Tongue;
use denavit_report::{Derivation, Document, Part, ReportOptions, Section, Topic, render, report};
use denavit_symbolic::vocabulary::Vocabulary;

/// A chain without constants at its ends and one with them, links that begin with the twist, a slide, a base.
const ROBOTS: [&str; 7] =
    ["planar-2r", "planar-3r", "articulated-3r", "scara", "stanford", "spherical-wrist", "cartesian-ppp"];

/// The parts of a report that print formulas.
const TOPICS: [Topic; 4] = [Topic::Links, Topic::Forward, Topic::Inverse, Topic::Velocity];

/// How many claims of a text are proved, and which are accused.
fn judged(robot: &str, text: &str, format: Format) -> (usize, Vec<String>) {
    let description = catalogue::robot(robot).expect("in the catalogue");
    let checked = check(text, format, Some(&description), &CheckOptions::default())
        .unwrap_or_else(|errors| panic!("{robot}: {errors:?}"));
    let accused = |s: Standing| matches!(s, Standing::Wrong | Standing::Carried);
    let wrong = checked.claims.iter().filter(|c| accused(c.standing()));
    let proved = checked.claims.iter().filter(|c| c.standing() == Standing::Equal).count();
    (proved, wrong.map(|c| format!("{}: {}", c.name, &text[c.span.clone()])).collect())
}

fn document(robot: &str) -> Document {
    let description = catalogue::robot(robot).expect("in the catalogue");
    let options = ReportOptions { topics: TOPICS.to_vec(), ..ReportOptions::default() };
    report(&description, &options)
}

#[test]
fn nothing_that_is_written_is_accused() {
    for robot in ROBOTS {
        let document = document(robot);
        let latex = render::latex_fragment(&document);
        let markdown = render::markdown(&document, "figures").text;
        for (text, format) in [(latex, Format::Latex), (markdown, Format::Markdown)] {
            let (proved, accused) = judged(robot, &text, format);
            assert!(accused.is_empty(), "{robot}, {format:?}: {accused:#?}");
            assert!(proved >= 20, "{robot}, {format:?}: {proved} proved");
        }
    }
}

/// A sine for a cosine in what is written is found.
#[test]
fn a_slip_in_what_is_written_is_accused() {
    let latex = render::latex_fragment(&document("scara"));
    let slipped = latex.replacen("a_{1} C_{1}", "a_{1} S_{1}", 1);
    assert_ne!(latex, slipped);
    assert!(!judged("scara", &slipped, Format::Latex).1.is_empty());
}

/// Hands whose body and whose point are singular elsewhere, slides, parallel axes, an orientation alone, a wrist.
const EXPLAINED: [&str; 6] =
    ["planar-2r", "articulated-3r", "cylindrical-rpp", "scara", "spherical-wrist", "staubli-rx90"];

fn of_blocks(names: Vocabulary, blocks: Vec<Block>) -> Document {
    let section = Section { names, parts: blocks.into_iter().map(Part::from).collect() };
    Document {
        title: "What is derived".into(),
        author: None,
        language: Tongue::English,
        sections: vec![section],
    }
}

/// The forward model, the closed form and the singularities, each step by step.
fn explained(d: &Description) -> [Document; 3] {
    let forward = Derivation::new(d, Reference::Base, Reference::Tool, Outputs::ALL);
    let inverse = InverseModel::derive(d, &InverseOptions::default()).expect("a closed form");
    let inverse = Explanation::of(&inverse);
    let singular = Singularities::derive(d, Reference::Tool).expect("short");
    [
        forward.document(Tongue::English),
        of_blocks(inverse.names(), inverse.document(Tongue::English)),
        of_blocks(velocity_vocabulary(d), singularities_document(d, &singular, Tongue::English)),
    ]
}

/// Every formula of a derivation is proved, in whatever language it is set.
#[test]
fn all_that_is_derived_is_proved() {
    for robot in EXPLAINED {
        let description = catalogue::robot(robot).expect("in the catalogue");
        for (k, document) in explained(&description).iter().enumerate() {
            let typst = readable("derived.typ", render::typst_fragment(document));
            let all = [
                ("LaTeX", render::latex_fragment(document), Format::Latex),
                ("Markdown", render::markdown(document, "figures").text, Format::Markdown),
                ("Typst", typst, Format::Markdown),
            ];
            for (language, text, format) in all {
                let checked = check(&text, format, Some(&description), &CheckOptions::default())
                    .unwrap_or_else(|errors| panic!("{robot}: {errors:?}"));
                let open = checked.claims.iter().filter(|c| !c.is_proved());
                let open = open.map(|c| format!("{:?}: {}", c.standing(), &text[c.span.clone()]));
                let unjudged =
                    checked.unjudged.iter().map(|u| format!("not judged: {}", &text[u.span.clone()]));
                let open: Vec<String> = open.chain(unjudged).collect();
                assert!(open.is_empty(), "{robot}, part {k}, {language}: {open:#?}");
                assert!(checked.claims.len() >= 3, "{robot}, part {k}, {language}");
            }
        }
    }
}
