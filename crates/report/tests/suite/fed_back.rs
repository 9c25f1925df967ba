//! What is written about a robot, fed back to the check: nothing of it is accused, and most of it is proved.

use denavit::catalogue;
use denavit_check::{CheckOptions, Standing, check};
use denavit_reading::document::Format;
use denavit_report::{Document, ReportOptions, Topic, render, report};

/// Hands whose body and whose point are singular elsewhere, a chain without constants at its ends and one with them, links that begin with the twist, a slide, a base.
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
