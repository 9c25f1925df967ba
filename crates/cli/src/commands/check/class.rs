//! Many documents held against one robot: a table of students and items, and the slips that are typical of the class.

use super::rubric::Task;
use super::sheet::{earned, points, remark};
use super::{Document, class_page, contents, findings, language_of, verdict};
use crate::arguments::CheckArguments;
use crate::failure::Failure;
use crate::load;
use crate::terminal::{Align, decimals, note, styled, table, words};
use anstyle::Style;
use denavit::description::{line_column, read_toml, render};
use denavit::symbolic::scoped;
use denavit_check::marking::{Rubric, Sheet};
use denavit_check::{CheckOptions, Checked, Finding, Skipped, Tally, check};
use denavit_reading::document::Format;
use denavit_wire::class as wire;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// The stack of a thread that checks, as large as that of a program's first.
const STACK: usize = 8 << 20;
/// So many slips of the class are printed.
const SLIPS: usize = 12;

/// A document of the class.
pub struct Submission {
    /// The student: the file's name without its ending, with its folder where two are the same.
    pub name: String,
    pub file: String,
    /// What came of it, or why it could not be held against the robot.
    pub outcome: Result<Held, String>,
}

/// A document that was held against the robot.
pub struct Held {
    pub tally: Tally,
    pub sheet: Option<Sheet>,
    /// What is said of each item.
    pub remarks: Vec<String>,
    /// The table of the sheet.
    pub points: String,
    /// Wrong claims by their left sides, each with its slip in words.
    pub slips: Vec<(String, String)>,
    /// What is to be marked by hand: line, text, why.
    pub by_hand: Vec<(usize, String, String)>,
    /// The document with its marks, where a page is asked for.
    pub page: String,
    exit: Result<(), Failure>,
}

/// All documents of a class.
pub struct Class {
    pub title: String,
    pub rubric: Option<Rubric>,
    pub submissions: Vec<Submission>,
}

/// A slip that students made.
pub struct Slip<'a> {
    pub claim: &'a str,
    pub slip: &'a str,
    pub students: Vec<&'a str>,
}

impl Class {
    /// The slips of the class, the most frequent first.
    pub fn slips(&self) -> Vec<Slip<'_>> {
        let mut all: BTreeMap<(&str, &str), BTreeSet<&str>> = BTreeMap::new();
        for submission in &self.submissions {
            let Ok(held) = &submission.outcome else { continue };
            for (claim, slip) in &held.slips {
                all.entry((claim, slip)).or_default().insert(&submission.name);
            }
        }
        let mut all: Vec<Slip<'_>> = all
            .into_iter()
            .map(|((claim, slip), students)| Slip { claim, slip, students: students.into_iter().collect() })
            .collect();
        all.sort_by_key(|s| std::cmp::Reverse(s.students.len()));
        all
    }

    /// The heads of the columns after the student's name.
    pub fn columns(&self) -> Vec<String> {
        match &self.rubric {
            Some(rubric) => {
                let items = rubric.items.iter().map(|i| format!("{} ({})", i.name, decimals(i.points, 2)));
                items.chain([format!("sum ({})", decimals(rubric.points(), 2))]).collect()
            }
            None => {
                ["right", "wrong", "conditional", "carried", "not decided", "by hand"].map(Into::into).into()
            }
        }
    }

    /// A row of the table: the student, and a cell a column.
    pub fn row(&self, submission: &Submission) -> Vec<String> {
        let cells = match (&submission.outcome, &self.rubric) {
            (Err(_), _) => vec!["–".to_string(); self.columns().len()],
            (Ok(Held { sheet: Some(sheet), .. }), Some(_)) => {
                let items = sheet.marks.iter().map(|m| earned(m.points, m.open));
                items.chain([earned(sheet.points(), sheet.open())]).collect()
            }
            (Ok(held), _) => counts(&held.tally).map(|n| n.to_string()).into(),
        };
        [submission.name.clone()].into_iter().chain(cells).collect()
    }
}

/// What is counted where there is no rubric.
fn counts(tally: &Tally) -> [usize; 6] {
    let open = tally.undecided + tally.unreadable;
    [tally.equal, tally.wrong, tally.conditional, tally.carried, open, tally.unjudged]
}

/// Holds several documents against one robot.
///
/// # Errors
/// If the robot, the rubric or a folder cannot be read; otherwise as one document: 1 if something is wrong in any of them, 3
/// if something is to be looked at by hand or a document cannot be read.
pub fn run(arguments: &CheckArguments, task: Option<Task>, files: &[PathBuf]) -> Result<(), Failure> {
    if arguments.certificate.is_some() || arguments.claim.is_some() {
        return Err(Failure::Usage("--certificate and --claim are for one document".into()));
    }
    let (arm, robot) = load::robot_file(&arguments.robot)?;
    task.as_ref().map_or(Ok(()), |t| t.fits(arm.variables().len()))?;
    let options = Options {
        robot,
        tolerance: arguments.tolerance,
        table: load::table_options(&arguments.robot),
        rubric: task.map(|t| t.rubric),
        is_page: arguments.html.is_some(),
    };
    let submissions = all(&options, files);
    let title = options.rubric.as_ref().and_then(|r| r.title.clone()).unwrap_or("Submissions".into());
    let class = Class { title, rubric: options.rubric, submissions };
    for (file, text) in [
        (&arguments.html, class_page::page as fn(&Class) -> String),
        (&arguments.csv, |class: &Class| csv(class)),
    ] {
        if let Some(file) = file {
            fs::write(file, text(&class))
                .map_err(|e| Failure::Input(format!("error: {}: {e}", file.display())))?;
        }
    }
    let mut out = anstream::stdout();
    if arguments.json {
        writeln!(out, "{}", denavit_wire::text(&json(&class)))?;
    } else if arguments.markdown {
        write!(out, "{}", markdown(&class))?;
    } else {
        write!(out, "{}", report(&class, arguments.all))?;
    }
    exit(class)
}

/// What is the same for all documents.
struct Options {
    /// The text of the robot file.
    robot: String,
    tolerance: Option<f64>,
    table: denavit::description::TableOptions,
    rubric: Option<Rubric>,
    is_page: bool,
}

/// Checks all of them, on all cores; each has a store of expressions of its own.
fn all(options: &Options, files: &[PathBuf]) -> Vec<Submission> {
    let names = names(files);
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, Submission)>> = Mutex::new(vec![]);
    let work = || {
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            let Some(file) = files.get(k) else { return };
            let shown = file.to_string_lossy().into_owned();
            let outcome = scoped(|| held(options, &shown));
            let submission = Submission { name: names[k].clone(), file: shown.clone(), outcome };
            let mut done = done.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            done.push((k, submission));
            if io::stderr().is_terminal() && !io::stdout().is_terminal() {
                note(&format!("{} of {}: {}", done.len(), files.len(), shown));
            }
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from).min(files.len());
    thread::scope(|scope| {
        for _ in 0..threads {
            // Where no thread can be had, the work is done here below.
            let _ = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        }
    });
    work();
    let mut all = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    all.sort_by_key(|s| s.0);
    all.into_iter().map(|s| s.1).collect()
}

/// What comes of one document.
fn held(options: &Options, file: &str) -> Result<Held, String> {
    let told = |failure: Failure| match failure {
        Failure::Input(text) => text.trim_start_matches("error: ").trim().to_string(),
        other => format!("{other:?}"),
    };
    let text = contents(file).map_err(told)?;
    if text.trim().is_empty() {
        return Err("the document is empty".into());
    }
    let (robot, _) = read_toml(&options.robot).map_err(|found| render(&found, "robot", &options.robot))?;
    let check_options = CheckOptions {
        table: options.table.clone(),
        tolerance: options.tolerance,
        language: language_of(file),
        ..CheckOptions::default()
    };
    let format = Format::of(file, &text);
    let mut checked = check(&text, format, Some(&robot), &check_options)
        .map_err(|notes| render(&findings(notes.iter()), file, &text))?;
    if let Some(rubric) = &options.rubric {
        rubric.answer(&text, format, &mut checked);
    }
    let document = Document { name: file, text: &text, checked: &checked };
    let sheet = options.rubric.as_ref().map(|r| r.mark(&text, &checked));
    let line = |at: usize| line_column(&text, at).0;
    let (remarks, points) = match (&sheet, &options.rubric) {
        (Some(sheet), Some(rubric)) => {
            (sheet.marks.iter().map(|m| remark(m, line)).collect(), points(rubric, sheet, line))
        }
        _ => (vec![], String::new()),
    };
    let page = if options.is_page { super::html::body(&document) } else { String::new() };
    Ok(Held {
        tally: checked.tally(),
        sheet,
        remarks,
        points,
        slips: slips(&checked),
        by_hand: by_hand(&document),
        page,
        exit: verdict(&document),
    })
}

/// The slips of a document in words, each with the left side of its claim.
fn slips(checked: &Checked) -> Vec<(String, String)> {
    let mut found = vec![];
    for claim in &checked.claims {
        for entry in &claim.entries {
            let Finding::Wrong(wrong) = &entry.finding else { continue };
            let slip = match (&claim.instead, &wrong.slip) {
                (Some(instead), _) => words().instead(*instead),
                (None, Some(slip)) => words().slip(&slip.kind),
                (None, None) => "wrong".into(),
            };
            let name = claim.name.split_whitespace().collect::<Vec<_>>().join(" ");
            if !found.contains(&(name.clone(), slip.clone())) {
                found.push((name, slip));
            }
        }
    }
    for answered in &checked.answered {
        let Some(slip) = answered.slip else { continue };
        let told = (answered.name.clone(), words().value_slip(slip));
        if !found.contains(&told) {
            found.push(told);
        }
    }
    found
}

/// What a teacher has to look at.
fn by_hand(document: &Document) -> Vec<(usize, String, String)> {
    let mut found = vec![];
    let short = |span: &std::ops::Range<usize>| document.source(span).chars().take(80).collect::<String>();
    for claim in &document.checked.claims {
        for entry in &claim.entries {
            let why = match &entry.finding {
                Finding::Undecided { why } => words().unproved(*why),
                Finding::Unreadable(_) => "not readable".into(),
                _ => continue,
            };
            found.push((document.line(entry.span.start), short(&entry.span), why));
        }
    }
    for answered in document.checked.answered.iter().filter(|a| a.by_hand && a.counts > 0) {
        let why = words().skipped(&Skipped::SaysNothing);
        found.push((document.line(answered.span.start), short(&answered.span), why));
    }
    for line in &document.checked.unjudged {
        found.push((document.line(line.span.start), short(&line.span), words().skipped(&line.why)));
    }
    found.sort();
    found
}

/// What students are called.
fn names(files: &[PathBuf]) -> Vec<String> {
    let stem = |f: &Path| f.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let stems: Vec<String> = files.iter().map(|f| stem(f)).collect();
    let named = |(file, name): (&PathBuf, &String)| {
        let folder = file.parent().and_then(Path::file_name).map(|f| f.to_string_lossy().into_owned());
        match folder {
            Some(folder) if stems.iter().filter(|s| *s == name).count() > 1 => format!("{folder}/{name}"),
            _ => name.clone(),
        }
    };
    files.iter().zip(&stems).map(named).collect()
}

const HEADING: Style = Style::new().bold();

/// What a terminal shows: the table, the slips, what is left for the teacher; with `all` the sheet of each.
fn report(class: &Class, all: bool) -> String {
    let columns = class.columns();
    let header: Vec<&str> = ["student"].into_iter().chain(columns.iter().map(String::as_str)).collect();
    let mut align = vec![Align::Right; header.len()];
    align[0] = Align::Left;
    let rows: Vec<Vec<String>> = class.submissions.iter().map(|s| class.row(s)).collect();
    let mut out = format!("{}\n{}", styled(&class.title, HEADING), table(&header, &align, &rows));
    let slips = class.slips();
    if !slips.is_empty() {
        out += &format!("\n{}\n", styled("slips", HEADING));
        for s in slips.iter().take(SLIPS) {
            out +=
                &format!("  {} × {}: {}  ({})\n", s.students.len(), s.claim, s.slip, s.students.join(", "));
        }
        if slips.len() > SLIPS {
            out += &format!("  and {} more\n", slips.len() - SLIPS);
        }
    }
    let mut open = String::new();
    for s in &class.submissions {
        match &s.outcome {
            Err(why) => open += &format!("  {}: {}\n", s.name, why.replace('\n', "\n    ")),
            Ok(held) => {
                for (line, text, why) in &held.by_hand {
                    open += &format!("  {}, line {line}: {text}  {why}\n", s.name);
                }
            }
        }
    }
    if !open.is_empty() {
        out += &format!("\n{}\n{open}", styled("by hand", HEADING));
    }
    for s in class.submissions.iter().filter(|_| all) {
        if let Ok(Held { points, sheet: Some(_), .. }) = &s.outcome {
            out += &format!("\n{}\n{points}", styled(&s.name, HEADING));
        }
    }
    out
}

/// The same as Markdown, the remarks of each student with it.
fn markdown(class: &Class) -> String {
    let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
    let line =
        |cells: &[String]| format!("| {} |\n", cells.iter().map(|c| cell(c)).collect::<Vec<_>>().join(" | "));
    let columns: Vec<String> = ["student".to_string()].into_iter().chain(class.columns()).collect();
    let mut out =
        format!("# {}\n\n{}|---|{}\n", class.title, line(&columns), "--:|".repeat(columns.len() - 1));
    class.submissions.iter().for_each(|s| out += &line(&class.row(s)));
    let slips = class.slips();
    if !slips.is_empty() {
        out += "\n## Slips\n\n| students | claim | slip | who |\n|--:|---|---|---|\n";
        for s in slips {
            let students = s.students.join(", ");
            out += &line(&[s.students.len().to_string(), format!("`{}`", s.claim), s.slip.into(), students]);
        }
    }
    for s in &class.submissions {
        out += &format!("\n## {}\n\n", s.name);
        match &s.outcome {
            Err(why) => out += &format!("Not held against the robot: {}\n", cell(why)),
            Ok(held) => {
                if let (Some(sheet), Some(rubric)) = (&held.sheet, &class.rubric) {
                    out += "| item | points | of | |\n|---|--:|--:|---|\n";
                    for ((item, mark), remark) in rubric.items.iter().zip(&sheet.marks).zip(&held.remarks) {
                        let [points, of] = [earned(mark.points, mark.open), decimals(item.points, 2)];
                        out += &line(&[item.name.clone(), points, of, remark.clone()]);
                    }
                }
                for (at, text, why) in &held.by_hand {
                    out += &format!("\n- by hand, line {at}: `{}`: {why}\n", text.replace('`', "'"));
                }
            }
        }
    }
    out
}

/// The table for a spreadsheet: points that are certain, and those that a teacher decides on.
fn csv(class: &Class) -> String {
    let quoted = |text: &str| match text.contains([',', '"', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_string(),
    };
    let line = |cells: Vec<String>| cells.iter().map(|c| quoted(c)).collect::<Vec<_>>().join(",") + "\n";
    let mut head = vec!["student".to_string()];
    match &class.rubric {
        Some(rubric) => {
            head.extend(rubric.items.iter().map(|i| i.name.clone()));
            head.extend(["sum", "of", "by hand", "remark"].map(String::from));
        }
        None => head.extend(class.columns().into_iter().chain(["remark".into()])),
    }
    let width = head.len();
    let mut out = line(head);
    for s in &class.submissions {
        let mut cells = vec![s.name.clone()];
        match (&s.outcome, &class.rubric) {
            (Err(why), _) => {
                cells.resize(width - 1, String::new());
                cells.push(why.lines().next().unwrap_or_default().to_string());
            }
            (Ok(Held { sheet: Some(sheet), .. }), Some(rubric)) => {
                cells.extend(sheet.marks.iter().map(|m| decimals(m.points, 2)));
                cells.extend([sheet.points(), rubric.points(), sheet.open()].map(|x| decimals(x, 2)));
                cells.push(String::new());
            }
            (Ok(held), _) => {
                cells.extend(counts(&held.tally).map(|n| n.to_string()));
                cells.push(String::new());
            }
        }
        out += &line(cells);
    }
    out
}

/// The class as it goes out as JSON.
fn json(class: &Class) -> wire::Class {
    let student = |s: &Submission| {
        let held = s.outcome.as_ref().ok();
        let marks = held.and_then(|h| h.sheet.as_ref()).map(|sheet| {
            let remarks = held.map(|h| h.remarks.clone()).unwrap_or_default();
            let marks = sheet.marks.iter().zip(remarks);
            marks.map(|(m, remark)| wire::Mark { open: m.open, points: m.points, remark }).collect()
        });
        wire::Student {
            by_hand: held.map_or(vec![], |h| {
                let lines = h.by_hand.iter().cloned();
                lines.map(|(line, text, why)| wire::ByHand { line, text, why }).collect()
            }),
            document: s.file.clone(),
            error: s.outcome.as_ref().err().cloned(),
            marks,
            name: s.name.clone(),
            open: held.and_then(|h| h.sheet.as_ref()).map(Sheet::open),
            points: held.and_then(|h| h.sheet.as_ref()).map(Sheet::points),
            tally: held.map(|h| h.tally.into()),
        }
    };
    let slips = class.slips().into_iter().map(|s| wire::ClassSlip {
        claim: s.claim.into(),
        slip: s.slip.into(),
        students: s.students.into_iter().map(Into::into).collect(),
    });
    let items = class.rubric.iter().flat_map(|r| &r.items);
    wire::Class {
        items: items.map(|i| wire::Item { name: i.name.clone(), points: i.points }).collect(),
        schema: denavit_wire::Schema,
        slips: slips.collect(),
        students: class.submissions.iter().map(student).collect(),
        title: class.title.clone(),
    }
}

/// The exit code: that of the worst document, with a count.
fn exit(class: Class) -> Result<(), Failure> {
    let (mut wrong, mut open) = (0, 0);
    for s in class.submissions {
        match s.outcome.map(|h| h.exit) {
            Ok(Ok(())) => {}
            Ok(Err(Failure::No(_))) => wrong += 1,
            Ok(Err(_)) | Err(_) => open += 1,
        }
    }
    match (wrong, open) {
        (0, 0) => Ok(()),
        (0, n) => Err(Failure::Input(format!("{n} to be looked at"))),
        (n, 0) => Err(Failure::No(format!("{n} with errors"))),
        (n, m) => Err(Failure::No(format!("{n} with errors, {m} to be looked at"))),
    }
}
