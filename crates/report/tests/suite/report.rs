//! Reports of the whole catalogue, as trees and as pages.

use crate::language::check_text;
use denavit::catalogue;
use denavit::description::{Convention, Description};
use denavit_report::document::{Block, Branch, Line, math, plain};
use denavit_report::words::Tongue;
use denavit_report::{Document, Level, Part, ReportOptions, Topic, render, report, reports};
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

fn description(name: &str) -> Description {
    catalogue::robot(name).expect("in the catalogue")
}

/// The tree as an outline: what each part says, formulas as text, pictures by their size.
fn outline(document: &Document) -> String {
    let mut out = format!("{}\n", document.title);
    for section in &document.sections {
        let names = &section.names;
        let say = |line: &Line| plain(line, names);
        for part in &section.parts {
            let _ = match part {
                Part::Block(Block::Heading(level, line)) => {
                    writeln!(out, "\n{} {}", "#".repeat((*level).into()), say(line))
                }
                Part::Block(Block::Paragraph(line)) => writeln!(out, "¶ {}", say(line)),
                Part::Block(Block::Formula { math: m, number, proof }) => {
                    writeln!(out, "= {} {number:?} {proof:?}", math(m, names, Style::Unicode))
                }
                Part::Block(Block::List(lines)) => {
                    lines.iter().try_for_each(|l| writeln!(out, "- {}", say(l)))
                }
                Part::Block(Block::Tree(branch)) => tree(branch, names, 0, &mut out),
                Part::Equations(all) | Part::Beside(all) => {
                    all.iter().try_for_each(|m| writeln!(out, "= {}", math(m, names, Style::Unicode)))
                }
                Part::Summary(rows) => {
                    rows.iter().try_for_each(|(a, b)| writeln!(out, "{}: {}", say(a), say(b)))
                }
                Part::Table(table) => {
                    let row = |cells: &Vec<Line>| cells.iter().map(say).collect::<Vec<_>>().join(" | ");
                    let _ = writeln!(out, "table: {}\n| {}", say(&table.caption), row(&table.head));
                    table.rows.iter().try_for_each(|r| writeln!(out, "| {}", row(r)))
                }
                Part::Figure(figure) => {
                    let _ = writeln!(out, "figure: {}", say(&figure.caption));
                    figure.pictures.iter().try_for_each(|(d, line)| {
                        writeln!(out, "  {:.0} × {:.0} {}", d.width, d.height, say(line))
                    })
                }
                Part::Code(text) => writeln!(out, "code: {text}"),
            };
        }
    }
    out
}

fn tree(branch: &Branch, names: &Vocabulary, depth: usize, out: &mut String) -> std::fmt::Result {
    branch.children.iter().try_for_each(|child| {
        writeln!(out, "{}- {}", "  ".repeat(depth), plain(&child.line, names))?;
        tree(child, names, depth + 1, out)
    })
}

#[test]
fn trees_of_six_robots() {
    for (name, language) in [
        ("staubli-rx90", Tongue::English),
        ("cylindrical-wrist", Tongue::French),
        ("puma560", Tongue::English),
        ("ur3", Tongue::French),
        ("smart5-six-rail", Tongue::English),
        ("kuka-iiwa-14", Tongue::English),
    ] {
        let options =
            ReportOptions { language, conventions: vec![Convention::Standard], ..ReportOptions::default() };
        let tree = outline(&report(&description(name), &options));
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/snapshots/{name}.txt"));
        if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
            std::fs::write(&file, &tree).expect("a snapshot is written");
        }
        let expected = std::fs::read_to_string(&file).unwrap_or_default();
        let place = tree.lines().zip(expected.lines()).find(|(a, b)| a != b);
        assert!(
            tree == expected,
            "{name}: the tree has changed ({place:?}); UPDATE_SNAPSHOTS=1 writes it, and it wants to be read"
        );
    }
}

/// Does something with every robot of the catalogue, on all cores.
fn each_robot(check: impl Fn(&str) + Sync) {
    let names = catalogue::names();
    let next = AtomicUsize::new(0);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            let work = || {
                while let Some(name) = names.get(next.fetch_add(1, Ordering::Relaxed)) {
                    check(name);
                }
            };
            std::thread::Builder::new().stack_size(64 << 20).spawn_scoped(scope, work).expect("a thread");
        }
    });
}

/// Where `DENAVIT_DOCUMENTS` names a folder, the English reports are left there as Typst documents, for those who have Typst.
#[test]
fn every_robot_has_a_page() {
    let folder = std::env::var_os("DENAVIT_DOCUMENTS").map(PathBuf::from);
    each_robot(|name| {
        for document in reports(&description(name), &ReportOptions::default(), &Tongue::ALL) {
            check_page(name, &render::html(&document));
            // What is a formula in one notation is one in the others.
            assert!(!render::latex(&document).contains("NaN"), "{name}");
            if let Some(folder) = folder.as_ref().filter(|_| document.language == Tongue::English) {
                let file = folder.join(format!("{name}.typ"));
                std::fs::write(file, render::typst(&document)).expect("the folder is there");
            }
        }
    });
}

/// A page is well formed, its headings are nested, and formulas and pictures have their texts.
fn check_page(name: &str, html: &str) {
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let page = roxmltree::Document::parse_with_options(html, options).expect(name);
    let elements = || page.descendants().filter(|n| n.is_element());
    let mut level = 1;
    for heading in elements().filter_map(|e| e.tag_name().name().strip_prefix('h')?.parse::<u8>().ok()) {
        assert!(heading <= level + 1, "{name}: a heading of level {heading} below one of level {level}");
        level = heading;
    }
    for e in elements() {
        match e.tag_name().name() {
            "math" => assert!(e.attribute("alttext").is_some_and(|t| !t.is_empty()), "{name}"),
            "svg" => assert!(
                e.children().any(|c| c.has_tag_name(("http://www.w3.org/2000/svg", "title"))),
                "{name}"
            ),
            _ => {}
        }
    }
    assert!(!html.contains("NaN") && !html.contains("NOT TRUE"), "{name}");
}

#[test]
fn the_same_robot_gives_the_same_bytes() {
    for name in ["ur5e", "stanford"] {
        let write = || {
            let document = report(&description(name), &ReportOptions::default());
            (
                render::html(&document),
                render::typst(&document),
                render::latex(&document),
                render::markdown(&document, "f").text,
            )
        };
        assert_eq!(write(), write(), "{name}");
    }
}

#[test]
fn reports_in_several_languages_are_those_in_each() {
    for name in ["staubli-tx60", "abb-irb120", "kinova-gen3"] {
        let d = description(name);
        let options = |language| ReportOptions { language, ..ReportOptions::default() };
        let languages = [Tongue::French, Tongue::English];
        for (document, language) in reports(&d, &ReportOptions::default(), &languages).iter().zip(languages) {
            assert_eq!(render::html(document), render::html(&report(&d, &options(language))), "{name}");
        }
    }
}

#[test]
fn sections_are_those_asked_for() {
    let d = description("puma560");
    for topic in Topic::ALL.into_iter().filter(|t| !matches!(t, Topic::Errata | Topic::Dynamics)) {
        let document = report(&d, &ReportOptions { topics: vec![topic], ..ReportOptions::default() });
        let parts: usize = document.sections.iter().map(|s| s.parts.len()).sum();
        assert!(parts > 0, "{topic:?}");
        let others =
            report(&d, &ReportOptions { topics: vec![Topic::References], ..ReportOptions::default() });
        assert!(topic == Topic::References || outline(&document) != outline(&others), "{topic:?}");
    }
}

/// The words of the tree alone: no formulas.
fn words(document: &Document) -> Vec<String> {
    use denavit_report::document::Piece;
    let mut found = vec![];
    let mut take = |line: &Line| {
        for piece in &line.0 {
            if let Piece::Text(t) | Piece::Strong(t) = piece {
                found.push(t.clone());
            }
        }
    };
    for part in document.sections.iter().flat_map(|s| &s.parts) {
        match part {
            Part::Block(Block::Heading(_, line) | Block::Paragraph(line)) => take(line),
            Part::Block(Block::List(lines)) => lines.iter().for_each(&mut take),
            Part::Block(_) | Part::Equations(_) | Part::Beside(_) | Part::Code(_) => {}
            Part::Summary(rows) => rows.iter().for_each(|(a, b)| {
                take(a);
                take(b);
            }),
            Part::Table(t) => {
                t.head.iter().chain(t.rows.iter().flatten()).chain([&t.caption]).for_each(&mut take)
            }
            Part::Figure(f) => f.pictures.iter().map(|p| &p.1).chain([&f.caption]).for_each(&mut take),
        }
    }
    found
}

/// A robot with masses has a section on dynamics, in every language; one without has none.
#[test]
fn masses_have_a_section() {
    let options = ReportOptions { topics: vec![Topic::Dynamics], ..ReportOptions::default() };
    assert!(report(&description("puma560"), &options).sections.is_empty());
    let mut d = description("planar-2r");
    for (k, row) in d.rows.iter_mut().enumerate() {
        row.mass = Some(denavit_symbolic::Expr::int(3 - k as i64));
    }
    let all: Vec<String> = reports(&d, &options, &Tongue::ALL).iter().map(outline).collect();
    let (english, french, german) = (&all[0], &all[1], &all[2]);
    for part in
        ["Dynamics", "Base parameters", "proved equal to Lagrange's equations", "What holds the arm at rest"]
    {
        assert!(english.contains(part), "{part}: {english}");
    }
    assert!(french.contains("Modèle dynamique") && french.contains("Ce qui maintient le bras"), "{french}");
    assert!(
        german.contains("Basisparameter") && german.contains("Was den Arm gegen die Schwerkraft"),
        "{german}"
    );
}

/// Every word of a report is of its language, and numbers have its decimal sign.
#[test]
fn reports_are_in_their_language() {
    let topics: Vec<Topic> = Topic::ALL.into_iter().filter(|t| *t != Topic::References).collect();
    for name in [
        "staubli-rx90",
        "scara",
        "planar-3r",
        "kuka-iiwa-14",
        "fanuc-crx10ia-l",
        "cartesian-ppp",
        "kinova-jaco",
    ] {
        let mut d = description(name);
        d.source = None;
        let conventions = Convention::ALL.to_vec();
        let options = ReportOptions { topics: topics.clone(), conventions, ..ReportOptions::default() };
        for document in reports(&d, &options, &Tongue::ALL) {
            for text in words(&document) {
                check_text(&text, document.language, name);
                for sign in [" ;", " :", " ?", " !"] {
                    assert!(
                        !text.contains(sign),
                        "{name}: a blank that may break before {sign:?} in {text:?}"
                    );
                }
            }
        }
    }
}

/// A decimal number has the sign of the language in every format, and nowhere that of another.
#[test]
fn decimal_signs_are_those_of_the_language() {
    let d = description("abb-irb120");
    let topics = vec![Topic::Table, Topic::Example, Topic::Inverse, Topic::Workspace];
    let options = ReportOptions { topics, ..ReportOptions::default() };
    for document in reports(&d, &options, &Tongue::ALL) {
        let has_comma = document.language.words().has_decimal_comma();
        let [latex, typst] = [render::latex_fragment(&document), render::typst_fragment(&document)];
        let [html, markdown] = [render::html(&document), render::markdown(&document, "figures").text];
        for (format, text, comma) in [
            ("LaTeX", &latex, "0{,}"),
            ("Typst", &typst, "\"0,"),
            ("HTML", &html, "<mn>0,"),
            ("Markdown", &markdown, "0{,}"),
        ] {
            assert_eq!(text.contains(comma), has_comma, "{format}, {:?}", document.language);
        }
        let matrix = markdown.split("$$").find(|m| m.contains("\\begin{bmatrix}")).expect("the pose");
        assert_eq!(matrix.contains("{,}"), has_comma, "{matrix}");
        assert_ne!(matrix.contains('.'), has_comma, "{matrix}");
        let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        let is_decimal = |text: &str, sign: char| {
            text.match_indices(sign).any(|(k, _)| {
                is_digit(text[..k].chars().next_back()) && is_digit(text[k + 1..].chars().next())
            })
        };
        let tables: String = markdown.lines().filter(|l| l.starts_with('|') && !l.contains("![")).collect();
        assert_eq!([is_decimal(&tables, '.'), is_decimal(&tables, ',')], [!has_comma, has_comma], "{tables}");
    }
}

/// A matrix whose entries are numbers of many digits does not fit a page, and has names once.
#[test]
fn matrices_of_long_numbers_are_written() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robot/tests/cases/so101.toml");
    let text = std::fs::read_to_string(&path).expect("a case");
    let (description, _) = denavit::description::read_toml(&text).expect("a robot");
    let options = ReportOptions { topics: vec![Topic::Table, Topic::Forward], ..ReportOptions::default() };
    let document = report(&description, &options);
    for written in [render::html(&document), render::latex(&document), render::typst(&document)] {
        assert!(written.len() > 1_000);
    }
}

/// A title and an author of one's own, in every format, their signs escaped.
#[test]
fn title_and_author() {
    let d = description("planar-2r");
    let (title, author) = ("Exercise <3> & more".to_string(), "A. Student_1".to_string());
    let options = ReportOptions {
        title: Some(title.clone()),
        author: Some(author.clone()),
        topics: vec![Topic::Table],
        ..ReportOptions::default()
    };
    let document = report(&d, &options);
    assert_eq!((&document.title, document.author.as_ref()), (&title, Some(&author)));
    let html = render::html(&document);
    assert!(html.contains("<h1>Exercise &lt;3&gt; &amp; more</h1>") && html.contains(&author), "{html}");
    assert!(render::latex(&document).contains("\\author{A. Student\\_1}"));
    assert!(render::typst(&document).contains("#set document(author: \"A. Student_1\")"));
    assert!(render::markdown(&document, "f").text.contains("Student"));
}

/// The short report has the results and none of the steps; what it does have is in the full one.
#[test]
fn the_short_level_has_results_alone() {
    for name in ["staubli-rx90", "articulated-3r"] {
        let d = description(name);
        let of = |level: Level| {
            let options = ReportOptions { level, topics: level.topics(), ..ReportOptions::default() };
            outline(&report(&d, &options))
        };
        let (short, full) = (of(Level::Short), of(Level::Full));
        let lines = |text: &str| text.lines().count();
        assert!(lines(&short) < lines(&full) * 3 / 4, "{name}: {} {}", lines(&short), lines(&full));
        assert!(!short.contains("¶ Type ") && full.contains("¶ Type "), "{name}");
        let joints = d.variables().len();
        for j in 1..=joints {
            assert!(short.lines().any(|l| l.starts_with(&format!("= q{j} = "))), "{name}: q{j}");
        }
        let formulas = |text: &str| -> Vec<String> {
            text.lines()
                .filter(|l| l.starts_with("= J = ") || l.starts_with("= det J"))
                .map(String::from)
                .collect()
        };
        assert_eq!(formulas(&short), formulas(&full), "{name}");
    }
}

/// No page ends between a sentence and what it introduces: LaTeX and Typst are told so wherever that is the case.
#[test]
fn a_sentence_stays_with_what_it_introduces() {
    let document = report(&description("puma560"), &ReportOptions::default());
    let mut introduced = 0;
    for section in &document.sections {
        for pair in section.parts.windows(2) {
            let is_said = matches!(&pair[0], Part::Block(Block::Paragraph(_)));
            let is_text = matches!(&pair[1], Part::Block(Block::Paragraph(_) | Block::Heading(..)));
            introduced += usize::from(is_said && !is_text);
        }
    }
    assert!(introduced > 20, "{introduced}");
    assert_eq!(render::latex(&document).matches("\\par\\nobreak\n").count(), introduced);
    assert_eq!(render::typst(&document).matches("#block(sticky: true, spacing").count(), introduced);
}
