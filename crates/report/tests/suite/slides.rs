//! Slides: nothing of a document is lost in them, and the pages are well-formed.

use denavit::catalogue;
use denavit_report::render::slides::{self, Pace};
use denavit_report::words::Tongue;
use denavit_report::{Document, Part, ReportOptions, Topic, compared, render, report};

fn document(name: &str, language: Tongue) -> Document {
    let robot = catalogue::robot(name).expect("in the catalogue");
    report(&robot, &ReportOptions { language, ..ReportOptions::default() })
}

/// What stands in the attributes with which formulas are read aloud, each as often as it stands there, and each picture's title.
fn spoken(page: &str) -> Vec<String> {
    // A heading stands on each slide that goes on below it.
    let headings = [("<h2", "</h2>"), ("<h3", "</h3>"), ("<h4", "</h4>"), ("<nav", "</nav>")];
    let page = &headings.into_iter().fold(page.to_string(), |page, (from, to)| without(&page, from, to));
    let after = |mark: &'static str, end: &'static str| {
        page.split(mark).skip(1).filter_map(move |rest| rest.split(end).next())
    };
    // Equations below each other are read aloud in one.
    let spoken = after("alttext=\"", "\"").flat_map(|text| text.split("; "));
    let mut all: Vec<String> = spoken.chain(after("<td>", "</td>")).map(String::from).collect();
    all.sort();
    all
}

/// The page without what stands between two marks.
fn without(page: &str, from: &str, to: &str) -> String {
    let mut parts = page.split(from);
    let first = parts.next().unwrap_or_default().to_string();
    parts.fold(first, |before, rest| before + rest.split_once(to).map_or("", |(_, own)| own))
}

/// The page without what a slide reminds of.
fn without_reminders(page: &str) -> String {
    without(page, "<div class=\"reminder\">\n", "<div class=\"step\">\n")
}

#[test]
fn slides_hold_all_that_the_report_says() {
    for (name, language) in [
        ("staubli-rx90", Tongue::English),
        ("scara", Tongue::German),
        ("ur5", Tongue::French),
        ("kuka-iiwa-14", Tongue::Spanish),
    ] {
        let document = document(name, language);
        let page = spoken(&render::html(&document));
        for pace in [Pace::Steps, Pace::Whole] {
            let talk = slides::html(&document, pace);
            let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
            roxmltree::Document::parse_with_options(&talk, options).expect(name);
            let own = spoken(&without_reminders(&talk));
            let missing: Vec<&String> = page.iter().filter(|one| own.binary_search(one).is_err()).collect();
            assert!(missing.is_empty(), "{name}: {missing:?}");
            assert_eq!(page.len(), own.len(), "{name}: as many formulas and cells, none twice");
        }
    }
}

#[test]
fn a_slide_reminds_of_the_formula_before_and_of_nothing_else() {
    let talk = slides::html(&document("staubli-rx90", Tongue::English), Pace::Steps);
    assert!(talk.matches("class=\"reminder\"").count() > 3, "long derivations go on");
    for part in talk.split("<div class=\"reminder\">\n").skip(1) {
        let reminder = part.split("<div class=\"step\">").next().unwrap_or_default();
        assert!(reminder.starts_with("<div class=\"formula\""), "{reminder}");
    }
}

#[test]
fn several_robots_stand_in_one_table() {
    let robots =
        ["ur5", "staubli-rx90", "scara"].map(|name| catalogue::robot(name).expect("in the catalogue"));
    for language in Tongue::ALL {
        let document = compared(&robots, &ReportOptions { language, ..ReportOptions::default() });
        let page = render::html(&document);
        for robot in &robots {
            let heading = format!("<th scope=\"col\">{}</th>", robot.name);
            assert!(page.contains(&heading), "{}", robot.name);
            assert!(document.title.contains(&robot.name), "{}", document.title);
        }
        // The table of each, and what each reaches.
        assert_eq!(page.matches("<h3>").count(), 2 * robots.len(), "{language:?}");
    }
}

#[test]
fn arms_beside_each_other_have_one_scale_unless_one_would_be_tiny() {
    let pictures = |scale: &str| {
        let small = catalogue::text("ur5").expect("in the catalogue");
        let (large, _) = denavit::description::read_toml(small).expect("a robot");
        let mut other = large.clone();
        other.name = "other".into();
        for name in ["d1", "a2", "a3", "d4", "d5", "d6"] {
            let own = large.parameters.iter().find(|p| &*p.symbol.name() == name).and_then(|p| p.value);
            let metres = own.expect("a length").as_number().expect("a number").to_f64();
            let factor: f64 = scale.parse().expect("a number");
            other.set(name, &format!("{}", metres * factor)).expect("a value");
        }
        let options = ReportOptions { topics: vec![Topic::Figures], ..ReportOptions::default() };
        let document = compared(&[large, other], &options);
        let parts = document.sections.into_iter().flat_map(|s| s.parts);
        let mut figures = parts.filter_map(|part| match part {
            Part::Figure(figure) => Some(figure),
            _ => None,
        });
        let figure = figures.next().expect("pictures");
        let caption = format!("{:?}", figure.caption);
        (caption, figure.pictures.iter().map(|(d, _)| (d.height, reach(d))).collect::<Vec<_>>())
    };
    let (caption, drawn) = pictures("0.5");
    assert!(caption.contains("at one scale"), "{caption}");
    assert_eq!(drawn[0].0, drawn[1].0);
    // Half the arm is half as high.
    assert!((drawn[0].1 / drawn[1].1 - 2.0).abs() < 0.1, "{drawn:?}");
    let (caption, drawn) = pictures("0.05");
    assert!(caption.contains("as its picture allows"), "{caption}");
    assert!((drawn[0].1 / drawn[1].1 - 1.0).abs() < 0.1, "{drawn:?}");
}

/// How far apart the highest and the lowest point of a drawing are.
fn reach(drawing: &denavit_report::figure::Drawing) -> f64 {
    let text = denavit_report::figure::svg::svg(drawing, denavit_report::figure::svg::Palette::Page, "f");
    let numbers = |part: &str| -> Vec<f64> {
        part.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
            .filter_map(|n| n.parse().ok())
            .collect()
    };
    let paths = text.split(" d=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let heights: Vec<f64> = paths
        .flat_map(|d| d.split('M').skip(1).map(str::to_string).collect::<Vec<_>>())
        .filter(|line| !line.contains('H'))
        .filter_map(|line| {
            numbers(line.split(['L', 'C', 'A', 'Z']).next().unwrap_or_default()).get(1).copied()
        })
        .collect();
    heights.iter().copied().fold(f64::MIN, f64::max) - heights.iter().copied().fold(f64::MAX, f64::min)
}

#[test]
fn figures_fill_their_slides() {
    let robot = catalogue::robot("ur5").expect("in the catalogue");
    let options =
        ReportOptions { for_slides: true, topics: vec![Topic::Figures], ..ReportOptions::default() };
    let document = report(&robot, &options);
    let figures = document.sections.iter().flat_map(|s| &s.parts).filter_map(|part| match part {
        Part::Figure(figure) => Some(&figure.pictures[0].0),
        _ => None,
    });
    let figures: Vec<_> = figures.collect();
    assert_eq!(figures.len(), 2);
    // Wider than high, as the room below a heading is; letters are the larger for it.
    assert!(figures.iter().all(|d| d.height <= 260.0 && d.width > 1.5 * d.height));
    let talk = slides::html(&document, Pace::Steps);
    assert_eq!(talk.matches("<div class=\"body filled\">\n<div class=\"step picture\">").count(), 2);
}
