//! What is written about a robot, fed back to the check: nothing of it is accused, and most of it is proved.

use denavit::catalogue;
use denavit::description::{Description, read_toml};
use denavit::forward::{Outputs, Reference};
use denavit::inverse::{InverseModel, InverseOptions};
use denavit::velocity::Singularities;
use denavit_check::{CheckOptions, Standing, check};
use denavit_reading::document::{Format, readable};
use denavit_report::document::Block;
use denavit_report::explain::{Explanation, singularities_document, velocity_vocabulary};
use denavit_report::words::Tongue;
use denavit_report::{Derivation, Document, Part, ReportOptions, Section, Topic, render, reports};
use denavit_symbolic::vocabulary::Vocabulary;

/// A chain without constants at its ends and one with them, links that begin with the twist, a slide, a base.
const ROBOTS: [&str; 7] =
    ["planar-2r", "planar-3r", "articulated-3r", "scara", "stanford", "spherical-wrist", "cartesian-ppp"];

/// Those that are written in all languages: what differs is words and the sign of decimals.
const IN_ALL_LANGUAGES: [&str; 3] = ["planar-3r", "articulated-3r", "scara"];

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

fn documents(robot: &str) -> Vec<Document> {
    let description = catalogue::robot(robot).expect("in the catalogue");
    let options = ReportOptions { topics: TOPICS.to_vec(), ..ReportOptions::default() };
    let count = if IN_ALL_LANGUAGES.contains(&robot) { Tongue::ALL.len() } else { 1 };
    reports(&description, &options, &Tongue::ALL[..count])
}

#[test]
fn nothing_that_is_written_is_accused() {
    for robot in ROBOTS {
        let mut of_english = vec![];
        for document in documents(robot) {
            let language = document.language;
            let latex = render::latex_fragment(&document);
            let markdown = render::markdown(&document, "figures").text;
            let texts = [(latex, Format::Latex), (markdown, Format::Markdown)];
            for (k, (text, format)) in texts.iter().enumerate() {
                let (proved, accused) = judged(robot, text, *format);
                assert!(accused.is_empty(), "{robot}, {language:?}, {format:?}: {accused:#?}");
                assert!(proved >= 20, "{robot}, {language:?}, {format:?}: {proved} proved");
                if language == Tongue::English {
                    of_english.push(proved);
                }
                assert!(proved >= of_english[k], "{robot}, {language:?}, {format:?}: {proved} proved");
            }
        }
    }
}

/// A sine for a cosine in what is written is found.
#[test]
fn a_slip_in_what_is_written_is_accused() {
    let latex = render::latex_fragment(&documents("scara")[0]);
    let slipped = latex.replacen("a_{1} C_{1}", "a_{1} S_{1}", 1);
    assert_ne!(latex, slipped);
    assert!(!judged("scara", &slipped, Format::Latex).1.is_empty());
}

/// Hands whose body and whose point are singular elsewhere, slides, parallel axes, an orientation alone, a wrist.
const EXPLAINED: [&str; 6] =
    ["planar-2r", "articulated-3r", "cylindrical-rpp", "scara", "spherical-wrist", "staubli-rx90"];

fn of_blocks(names: Vocabulary, blocks: Vec<Block>, language: Tongue) -> Document {
    let section = Section { names, parts: blocks.into_iter().map(Part::from).collect() };
    Document { title: "What is derived".into(), author: None, language, sections: vec![section] }
}

/// The forward model, the closed form and the singularities, each step by step.
fn explained(d: &Description) -> Vec<Document> {
    let forward = Derivation::new(d, Reference::Base, Reference::Tool, Outputs::ALL);
    let inverse = InverseModel::derive(d, &InverseOptions::default()).expect("a closed form");
    let inverse = Explanation::of(&inverse);
    let singular = Singularities::derive(d, Reference::Tool).expect("short");
    let all = Tongue::ALL.into_iter().flat_map(|language| {
        [
            forward.document(language),
            of_blocks(inverse.names(), inverse.document(language), language),
            of_blocks(velocity_vocabulary(d), singularities_document(d, &singular, language), language),
        ]
    });
    all.collect()
}

/// An arm with numbers for lengths, decimals in the formulas.
const NUMBERED: [&str; 1] = ["abb-irb120"];

/// The catalogue's arm with what it knows of its lengths in the cells of its table.
fn with_numbers(robot: &str) -> Description {
    let text = catalogue::text(robot).expect("in the catalogue");
    let (head, rest) = text.split_once("[parameters]\n").expect("lengths");
    let (values, rows) = rest.split_once("\n\n").expect("rows");
    let put = |rows: String, (name, value): (&str, &str)| {
        rows.replace(&format!("= \"{name}\""), &format!("= {value}"))
    };
    let rows = values.lines().filter_map(|line| line.split_once(" = ")).fold(rows.to_string(), put);
    let d = read_toml(&format!("{head}{rows}")).unwrap_or_else(|errors| panic!("{robot}: {errors:?}")).0;
    assert!(d.parameters.is_empty(), "{robot}");
    d
}

/// Every formula of these parts of a derivation is proved, in whatever notation and language it is set.
fn all_is_proved(description: &Description, parts: &[usize]) {
    let (robot, mut of_english) = (&description.name, vec![]);
    for (k, document) in explained(description).iter().enumerate().filter(|(k, _)| parts.contains(&(k % 3))) {
        let typst = readable("derived.typ", render::typst_fragment(document));
        let all = [
            (render::latex_fragment(document), Format::Latex),
            (render::markdown(document, "figures").text, Format::Markdown),
            (typst, Format::Markdown),
        ];
        for (n, (text, format)) in all.into_iter().enumerate() {
            let place = format!("{robot}, part {k}, {:?}, format {n}", document.language);
            let checked = check(&text, format, Some(description), &CheckOptions::default())
                .unwrap_or_else(|errors| panic!("{place}: {errors:?}"));
            let open = checked.claims.iter().filter(|c| !c.is_proved());
            let open = open.map(|c| format!("{:?}: {}", c.standing(), &text[c.span.clone()]));
            let unjudged = checked.unjudged.iter().map(|u| format!("not judged: {}", &text[u.span.clone()]));
            let open: Vec<String> = open.chain(unjudged).collect();
            assert!(open.is_empty(), "{place}: {open:#?}");
            // As many as in English: nothing is passed over.
            if document.language == Tongue::English {
                of_english.push((k, n, checked.claims.len()));
            }
            assert!(of_english.contains(&(k % 3, n, checked.claims.len())), "{place}");
            assert!(checked.claims.len() >= 3, "{place}");
        }
    }
}

#[test]
fn all_that_is_derived_is_proved() {
    for robot in EXPLAINED {
        all_is_proved(&catalogue::robot(robot).expect("in the catalogue"), &[0, 1, 2]);
    }
}

/// With decimals in the formulas; what stands at the ends of a chain is read by names alone, so that an inverse model is not.
#[test]
fn decimals_that_are_derived_are_proved() {
    for robot in NUMBERED {
        all_is_proved(&with_numbers(robot), &[0, 2]);
    }
}

/// Numbers in other languages have commas in what is fed back above.
#[test]
fn arms_with_numbers_are_written_with_commas() {
    let markdown = |document: &Document| render::markdown(document, "figures").text;
    for document in explained(&with_numbers("abb-irb120")).iter().step_by(3) {
        let has_comma = document.language.words().has_decimal_comma();
        assert_eq!(markdown(document).contains("0{,}27"), has_comma, "{:?}", document.language);
        assert_ne!(markdown(document).contains("0.27"), has_comma, "{:?}", document.language);
    }
}
