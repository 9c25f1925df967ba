//! The rules of the project that a program can check. One line a violation, with its place.

mod circles;
mod crates;
mod index;
mod sessions;
mod surface;

pub use index::print as index;
pub use surface::print as surface;

use crate::{command, path};
use anyhow::{Context, Result, bail};
use std::fmt::Display;
use std::fs;

/// Crates of pure algebra, and the words they do not say.
const ABSTRACT: &[&str] =
    &["crates/symbolic/src/", "crates/program/src/", "crates/emit/src/", "crates/jit/src/"];
const CONCRETE_WORDS: &[&str] = &["joint", "robot"];
/// Words of mathematics that contain one of them.
const INNOCENT_WORDS: &[&str] = &["disjoint", "adjoint"];
/// Where code that the compiler cannot check may stand; the lint `unsafe_code` denies it wherever it is not allowed.
const UNSAFE_FILES: &[&str] = &[
    "crates/elimination/src/native.rs",
    "crates/ffi/src/border.rs",
    "crates/ffi/src/c/answer.rs",
    "crates/ffi/src/c/dynamics.rs",
    "crates/ffi/src/c/error.rs",
    "crates/ffi/src/c/kinematics.rs",
    "crates/ffi/src/c/robot.rs",
    "crates/ffi/src/c/solver.rs",
    "crates/program/src/evaluate/machine.rs",
    "crates/python/src/border.rs",
    "crates/jit/src/native.rs",
    "crates/web/src/border.rs",
];
/// What the science does not touch.
const SCIENCE: &[&str] = &[
    "crates/symbolic/src/",
    "crates/reading/src/",
    "crates/program/src/",
    "crates/emit/src/",
    "crates/robot/src/",
    "crates/parallel/src/",
    "crates/check/src/",
    "crates/certificate/src/",
    "crates/generate/src/",
    "crates/recording/src/",
    "crates/identification/src/",
    "crates/calibration/src/",
    "crates/report/src/",
    "crates/wire/src/",
];
const OUTSIDE_WORLD: &[&str] =
    &["std::fs", "std::io", "std::time", "std::env", "print!(", "println!(", "eprint!(", "eprintln!("];
/// What nothing but a test contains.
const UNFINISHED: &[&str] = &[".unwrap()", "todo!", "unimplemented!", "dbg!"];
const MAX_LINES: usize = 600;
/// Longer files, each with the reason.
const LONG_FILES: &[(&str, &str)] = &[];
const REQUIRED: &[&str] = &["README.md", "CHANGELOG.md", "ARCHITECTURE.md", "LICENSE-MIT", "LICENSE-APACHE"];
const FIRST_COMMANDS: [&str; 2] = ["cargo run --release -- derive staubli-rx90", "cargo xtask test"];
/// Folders of one machine, without the slash behind them.
const MACHINE_FOLDERS: &[&str] = &["/work", "/root", "/tmp", "/home"];

/// A text file under version control, or about to be.
struct File {
    path: String,
    text: String,
}

#[derive(Default)]
struct Report {
    violations: Vec<String>,
}

impl Report {
    fn add(&mut self, file: &str, line: usize, what: impl Display) {
        self.violations.push(format!("{file}:{line}: {what}"));
    }
}

/// What is checked: the rules, which take a moment, or what the program prints in the project's pages, or both.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Part {
    Rules,
    Sessions,
    Both,
}

/// Checks and prints what violates the rules.
///
/// # Errors
/// If something does.
pub fn run(part: Part) -> Result<()> {
    let files = text_files()?;
    let mut report = Report::default();
    if part != Part::Sessions {
        required(&files, &mut report);
        crates::layers(&mut report)?;
        words(&files, &mut report);
        lengths(&files, &mut report);
        machine_folders(&files, &mut report);
        sources(&files, &mut report);
        headers(&files, &mut report);
        circles::circles(&files, &mut report);
        first_commands(&files, &mut report);
    }
    if part != Part::Rules {
        sessions::sessions(&files, &mut report)?;
    }
    for line in &report.violations {
        println!("{line}");
    }
    match report.violations.len() {
        0 => {
            println!("tidy: {} files, nothing to remark", files.len());
            Ok(())
        }
        n => bail!("tidy: {n} violation{}", if n == 1 { "" } else { "s" }),
    }
}

fn text_files() -> Result<Vec<File>> {
    let output = command("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .output()
        .context("git does not start")?;
    if !output.status.success() {
        bail!("not a git checkout: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    let names = String::from_utf8(output.stdout)?;
    let mut files: Vec<File> = names
        .split_terminator('\0')
        .filter_map(|name| Some(File { path: name.into(), text: fs::read_to_string(path(name)).ok()? }))
        .collect();
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

fn find<'a>(files: &'a [File], path: &str) -> Option<&'a File> {
    files.iter().find(|f| f.path == path)
}

fn required(files: &[File], report: &mut Report) {
    for name in REQUIRED.iter().filter(|name| find(files, name).is_none()) {
        report.add(name, 1, "the file does not exist");
    }
}

fn words(files: &[File], report: &mut Report) {
    let sources = files.iter().filter(|f| f.path.starts_with("crates/") && f.path.ends_with(".rs"));
    for file in sources.filter(|f| f.path.contains("/src/")) {
        if ABSTRACT.iter().any(|folder| file.path.starts_with(folder)) {
            for (i, line) in file.text.lines().enumerate() {
                let plain = INNOCENT_WORDS.iter().fold(line.to_lowercase(), |l, word| l.replace(word, ""));
                for word in CONCRETE_WORDS.iter().filter(|w| plain.contains(*w)) {
                    report.add(&file.path, i + 1, format!("says `{word}`"));
                }
            }
        }
        let is_test = file.path.ends_with("/tests.rs");
        for (n, line) in code(&file.text).into_iter().filter(|_| !is_test) {
            if contains(line, "allow(unsafe_code") && !UNSAFE_FILES.contains(&file.path.as_str()) {
                report.add(&file.path, n, "allows unsafe code");
            }
            for bad in UNFINISHED.iter().filter(|bad| contains(line, bad)) {
                report.add(&file.path, n, format!("`{bad}` outside a test"));
            }
            if SCIENCE.iter().any(|s| file.path.starts_with(s)) {
                for bad in OUTSIDE_WORLD.iter().filter(|bad| contains(line, bad) || grouped(line, bad)) {
                    report.add(&file.path, n, format!("`{bad}` in the science"));
                }
            }
        }
    }
}

/// Whether `needle` occurs and does not begin in the middle of a word.
fn contains(line: &str, needle: &str) -> bool {
    let in_word = |at: usize| line[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
    line.match_indices(needle).any(|(at, _)| needle.starts_with('.') || !in_word(at))
}

/// Whether `use std::{…}` names `std::x`.
fn grouped(line: &str, needle: &str) -> bool {
    match (line.trim_start().strip_prefix("use std::{"), needle.strip_prefix("std::")) {
        (Some(list), Some(module)) => {
            list.split(|c: char| !c.is_alphanumeric() && c != '_').any(|w| w == module)
        }
        _ => false,
    }
}

/// The lines, numbered from 1, that are neither comments nor under `#[cfg(test)]`; the text is formatted by rustfmt.
fn code(text: &str) -> Vec<(usize, &str)> {
    let mut lines = text.lines().enumerate();
    let mut kept = vec![];
    while let Some((i, line)) = lines.next() {
        let trimmed = line.trim_start();
        if trimmed.starts_with("#[cfg(test)]") {
            let indent = &line[..line.len() - trimmed.len()];
            // The item ends with its first line, or where a brace closes at its indentation.
            let item = lines.by_ref().map(|(_, l)| l).find(|l| !l.trim_start().starts_with("#["));
            if item.is_some_and(|l| !l.ends_with([';', '}'])) {
                lines.by_ref().find(|(_, l)| l.strip_prefix(indent).is_some_and(|l| l.starts_with('}')));
            }
        } else if !trimmed.starts_with("//") {
            kept.push((i + 1, line));
        }
    }
    kept
}

fn lengths(files: &[File], report: &mut Report) {
    for file in files.iter().filter(|f| f.path.ends_with(".rs") || f.path.ends_with(".py")) {
        let n = file.text.lines().count();
        let allowed = LONG_FILES.iter().any(|l| l.0 == file.path);
        if n > MAX_LINES && !allowed {
            report.add(
                &file.path,
                MAX_LINES,
                format!("{n} lines; at most {MAX_LINES} without a stated reason"),
            );
        } else if allowed && n <= MAX_LINES {
            report.add("xtask/src/tidy/mod.rs", 1, format!("{} is not long any more", file.path));
        }
    }
    for (path, _) in LONG_FILES.iter().filter(|l| find(files, l.0).is_none()) {
        report.add("xtask/src/tidy/mod.rs", 1, format!("{path}, a long file, is not there"));
    }
}

fn machine_folders(files: &[File], report: &mut Report) {
    for file in files {
        for (i, line) in file.text.lines().enumerate() {
            for folder in MACHINE_FOLDERS.iter().map(|f| format!("{f}/")) {
                // A folder at the root, not the middle of a relative path or an address.
                let inside =
                    |at: usize| line[..at].ends_with(|c: char| c.is_alphanumeric() || "_-.}/".contains(c));
                if line.match_indices(&folder).any(|(at, _)| !inside(at)) {
                    report.add(&file.path, i + 1, format!("a path of one machine: {folder}"));
                }
            }
        }
    }
}

fn sources(files: &[File], report: &mut Report) {
    for file in
        files.iter().filter(|f| f.path.starts_with("crates/robot/catalogue/") && f.path.ends_with(".toml"))
    {
        match file.text.parse::<toml::Table>() {
            Err(e) => report.add(&file.path, 1, e.message()),
            Ok(table) => {
                if table.get("source").and_then(|s| s.as_str()).is_none_or(|s| s.trim().is_empty()) {
                    report.add(&file.path, 1, "no `source`");
                }
            }
        }
    }
}

/// Every source file says in its first line what it is: `cargo xtask index` makes the index of these lines.
fn headers(files: &[File], report: &mut Report) {
    for file in files.iter().filter(|f| is_source(f)) {
        if index::first_line(&file.text).is_none() {
            report.add(&file.path, 1, "no `//!` line says what it is");
        }
    }
}

/// Whether a file is source code of the project, and no test data or text of which generated code is made.
fn is_source(file: &File) -> bool {
    let folder = ["/src/", "/examples/", "/tests/", "/fuzz_targets/"].iter().any(|f| file.path.contains(f));
    let is_ours = ["crates/", "xtask/", "bench/", "fuzz/"].iter().any(|f| file.path.starts_with(f));
    file.path.ends_with(".rs") && folder && is_ours && !file.path.contains("/src/kernel/")
}

fn first_commands(files: &[File], report: &mut Report) {
    let Some(readme) = find(files, "README.md") else { return };
    let mut inside = false;
    let mut commands = readme.text.lines().enumerate().filter_map(|(i, line)| {
        let fence = line.starts_with("```");
        let given = inside && !fence && !line.trim().is_empty() && !line.trim_start().starts_with('#');
        inside = if fence { line.trim() == "```sh" } else { inside };
        given.then(|| (i + 1, line.trim().trim_start_matches("$ ")))
    });
    for expected in FIRST_COMMANDS {
        match commands.next() {
            Some((_, line)) if line.split(" #").next().unwrap_or_default().trim_end() == expected => {}
            Some((n, line)) => {
                report.add("README.md", n, format!("`{line}` stands where `{expected}` should"))
            }
            None => report.add("README.md", 1, format!("no command `{expected}` in a block ```sh")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_and_comments_are_no_code() {
        let text = "a\n// b\n#[cfg(test)]\nmod tests {\n    c\n}\nd\n    #[cfg(test)]\n    use e;\nf\n";
        assert_eq!(code(text), [(1, "a"), (7, "d"), (10, "f")]);
    }

    fn check(rule: fn(&[File], &mut Report), texts: &[(&str, &str)]) -> Vec<String> {
        let files: Vec<File> = texts.iter().map(|t| File { path: t.0.into(), text: t.1.into() }).collect();
        let mut report = Report::default();
        rule(&files, &mut report);
        report.violations
    }

    #[test]
    fn a_file_says_what_it_is() {
        let files =
            [("crates/x/src/a.rs", "//! What.\n"), ("crates/x/src/b.rs", "use c;\n"), ("x/src/c.rs", "")];
        assert_eq!(check(headers, &files), ["crates/x/src/b.rs:1: no `//!` line says what it is"]);
    }

    #[test]
    fn the_first_commands_of_the_readme() {
        let [derive, test] = FIRST_COMMANDS;
        let good = format!("```text\nx\n```\n```sh\n# why\n$ {derive}\n```\n```sh\n{test}   # all\n```\n");
        assert_eq!(check(first_commands, &[("README.md", &good)]), [""; 0]);
        let bad = format!("```sh\n{test}\n```\n");
        assert_eq!(check(first_commands, &[("README.md", &bad)]).len(), 2);
    }

    #[test]
    fn folders_of_one_machine() {
        let [folder, ..] = MACHINE_FOLDERS else { panic!("there are some") };
        let text = format!("see {folder}/main\nhttps://x.org{folder}/a\nhome{folder}/b\n");
        assert_eq!(check(machine_folders, &[("a.md", &text)]).len(), 1);
    }

    #[test]
    fn words_are_found_where_they_begin() {
        assert!(contains("std::println!(\"\")", "println!("));
        assert!(!contains("eprintln!(\"\")", "println!("));
        assert!(contains("x.unwrap()", ".unwrap()"));
        assert!(grouped("use std::{fmt, fs};", "std::fs"));
        assert!(!grouped("use std::{fmt, ops};", "std::fs"));
    }
}
