//! The rules of the project that a program can check. One line a violation, with its place.

use crate::{cargo, command, denavit, path};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Display;
use std::fs;

/// Folders and packages in the order of dependency: nothing depends on what stands behind it.
const LAYERS: &[(&str, &str)] = &[
    ("crates/symbolic", "denavit-symbolic"),
    ("crates/program", "denavit-program"),
    ("crates/robot", "denavit"),
    ("crates/report", "denavit-report"),
    ("crates/cli", "denavit-cli"),
    ("crates/web", "denavit-web"),
    ("crates/jit", "denavit-jit"),
];
/// Crates of pure algebra, and the words they do not say.
const ABSTRACT: &[&str] = &["crates/symbolic/src/", "crates/program/src/", "crates/jit/src/"];
const CONCRETE_WORDS: &[&str] = &["joint", "robot"];
/// Words of mathematics that contain one of them.
const INNOCENT_WORDS: &[&str] = &["disjoint", "adjoint"];
/// Where code that the compiler cannot check may stand; the lint `unsafe_code` denies it wherever it is not allowed.
const UNSAFE_FILES: &[&str] = &[
    "crates/elimination/src/native.rs",
    "crates/program/src/evaluate/machine.rs",
    "crates/jit/src/native.rs",
    "crates/web/src/border.rs",
];
/// What the science does not touch.
const SCIENCE: &[&str] = &["crates/robot/src/", "crates/report/src/"];
const OUTSIDE_WORLD: &[&str] =
    &["std::fs", "std::io", "std::time", "std::env", "print!(", "println!(", "eprint!(", "eprintln!("];
/// What nothing but a test contains.
const UNFINISHED: &[&str] = &[".unwrap()", "todo!", "unimplemented!", "dbg!"];
const MAX_LINES: usize = 700;
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

/// Checks all rules and prints what violates them.
///
/// # Errors
/// If something does.
pub fn run() -> Result<()> {
    let files = text_files()?;
    let mut report = Report::default();
    required(&files, &mut report);
    layers(&mut report)?;
    words(&files, &mut report);
    lengths(&files, &mut report);
    machine_folders(&files, &mut report);
    sources(&files, &mut report);
    architecture(&files, &mut report);
    first_commands(&files, &mut report);
    sessions(&files, &mut report)?;
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

fn layers(report: &mut Report) -> Result<()> {
    let output = cargo().args(["metadata", "--format-version", "1", "--no-deps"]).output()?;
    if !output.status.success() {
        bail!("cargo metadata: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    let metadata: Value = serde_json::from_slice(&output.stdout)?;
    let layer = |name: &Value| LAYERS.iter().position(|l| Some(l.1) == name.as_str());
    for package in metadata["packages"].as_array().into_iter().flatten() {
        let Some(own) = layer(&package["name"]) else { continue };
        let manifest = format!("{}/Cargo.toml", LAYERS[own].0);
        let text = fs::read_to_string(path(&manifest))?;
        for dependency in package["dependencies"].as_array().into_iter().flatten() {
            if let Some(other) = layer(&dependency["name"])
                && other >= own
            {
                let name = LAYERS[other].1;
                let line = text.lines().position(|l| l.starts_with(name)).map_or(1, |i| i + 1);
                report.add(
                    &manifest,
                    line,
                    format!("{} depends on {name}, which comes after it", LAYERS[own].1),
                );
            }
        }
    }
    Ok(())
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
            report.add("xtask/src/tidy.rs", 1, format!("{} is not long any more", file.path));
        }
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

/// The code map names every module, and nothing that is not there.
fn architecture(files: &[File], report: &mut Report) {
    const MAP: &str = "ARCHITECTURE.md";
    let Some(map) = find(files, MAP) else { return };
    let exists = |p: &str| files.iter().any(|f| f.path == p || (p.ends_with('/') && f.path.starts_with(p)));
    let mut folder = String::new();
    let mut named: BTreeSet<String> = BTreeSet::new();
    let mut fenced = false;
    for (i, line) in map.text.lines().enumerate() {
        fenced ^= line.trim_start().starts_with("```");
        if fenced {
            continue;
        }
        if let Some(heading) = line.strip_prefix("## ") {
            let first = heading.split_whitespace().next().unwrap_or_default();
            folder = first.trim_matches(['`', ':', ',']).trim_end_matches('/').to_string();
        }
        for token in line.split('`').skip(1).step_by(2).filter(|t| is_path(t)) {
            let places = [token.to_string(), format!("{folder}/src/{token}"), format!("{folder}/{token}")];
            match places.into_iter().find(|p| exists(p)) {
                Some(place) => {
                    named.insert(place);
                }
                None => report.add(MAP, i + 1, format!("`{token}` does not exist")),
            }
        }
    }
    let modules = files.iter().filter(|f| f.path.starts_with("crates/") && f.path.contains("/src/"));
    for file in modules.filter(|f| f.path.ends_with(".rs")) {
        // `x/` stands for `x/mod.rs`; the root of a crate is the crate.
        let root = ["/src/lib.rs", "/src/main.rs"].iter().any(|r| file.path.ends_with(r));
        let module = file.path.strip_suffix("mod.rs").is_some_and(|folder| named.contains(folder));
        if !root && !module && !named.contains(&file.path) {
            report.add(MAP, 1, format!("`{}` is not named", file.path));
        }
    }
}

/// Whether a word in code type is meant as a path of this project.
fn is_path(token: &str) -> bool {
    let endings = [".rs", ".toml", ".md", ".json", ".py"];
    let plain = token.chars().all(|c| c.is_alphanumeric() || "_-./".contains(c));
    let ending = endings.iter().any(|e| token.ends_with(e) && token.len() > e.len());
    plain && (ending || (token.ends_with('/') && token.len() > 1))
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

/// Every block behind `<!-- denavit ARGUMENTS -->` is what the program prints.
fn sessions(files: &[File], report: &mut Report) -> Result<()> {
    for file in files.iter().filter(|f| f.path.ends_with(".md")) {
        let mut lines = file.text.lines().enumerate();
        while let Some((i, line)) = lines.next() {
            let Some(marked) = line.trim().strip_prefix("<!-- denavit ").and_then(|l| l.strip_suffix("-->"))
            else {
                continue;
            };
            if !lines.next().is_some_and(|(_, l)| l.starts_with("```")) {
                report.add(&file.path, i + 1, "no block follows");
                continue;
            }
            let block: Vec<&str> =
                lines.by_ref().map(|(_, l)| l).take_while(|l| !l.starts_with("```")).collect();
            let printed = denavit(words_of(marked))?;
            let shown = block.strip_prefix(&[""][..]).unwrap_or(&block);
            let shown = if shown.first().is_some_and(|l| l.starts_with("$ ")) { &shown[1..] } else { shown };
            if let Err(k) = agrees(shown, &printed.lines().collect::<Vec<_>>()) {
                let n = i + 3 + (block.len() - shown.len()) + k;
                report.add(&file.path, n, format!("`denavit {}` does not print this", marked.trim()));
            }
        }
    }
    Ok(())
}

/// Words as a shell separates them; quotes hold together what stands between them.
fn words_of(text: &str) -> Vec<String> {
    let (mut words, mut quote) = (vec![], None);
    let mut word: Option<String> = None;
    for c in text.chars() {
        match quote {
            Some(q) if c == q => quote = None,
            None if c == '"' || c == '\'' => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            None if c.is_whitespace() => words.extend(word.take()),
            _ => word.get_or_insert_default().push(c),
        }
    }
    words.extend(word);
    words
}

/// Whether the lines shown are those printed, where `…` stands for any number of lines; else the first shown line
/// that is not there.
fn agrees(shown: &[&str], printed: &[&str]) -> Result<(), usize> {
    let mut at = 0;
    let mut free = false; // after `…` a part may begin anywhere
    let parts: Vec<&[&str]> = shown.split(|l| l.trim() == "…").collect();
    let mut line = 0;
    for (k, part) in parts.iter().enumerate() {
        let is_last = k + 1 == parts.len();
        let same = |from: usize| {
            part.iter().zip(&printed[from..]).take_while(|(a, b)| a.trim_end() == b.trim_end()).count()
        };
        let fits = |from: usize| same(from) == part.len() && (!is_last || from + part.len() == printed.len());
        let last = if free { printed.len().saturating_sub(part.len()) } else { at };
        match (at..=last).find(|&from| fits(from)) {
            Some(from) => at = from + part.len(),
            None => {
                return Err(
                    line + (at..=last.max(at)).map(same).max().unwrap_or(0).min(part.len().saturating_sub(1))
                );
            }
        }
        line += part.len() + 1;
        free = true;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_may_leave_lines_out() {
        let printed = ["a", "b", "c", "d"];
        for (shown, expected) in [
            (&["a", "b", "c", "d"][..], Ok(())),
            (&["a", "…"], Ok(())),
            (&["…", "d"], Ok(())),
            (&["a", "…", "c", "…"], Ok(())),
            (&["a", "b", "c", "d", "…"], Ok(())),
            (&["a", "b", "x", "d"], Err(2)),
            (&["a", "b"], Err(1)),
            (&["b", "…"], Err(0)),
            (&["a", "…", "x", "…"], Err(2)),
            (&["…", "c"], Err(1)),
        ] {
            assert_eq!(agrees(shown, &printed), expected, "{shown:?}");
        }
    }

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
    fn the_code_map_is_complete_and_true() {
        let map = "# Map\n## crates/x\n- `a.rs`: one, after `b/`\n- `c.rs`: gone\n";
        let sources = ["lib", "a", "b/mod", "b/d"].map(|f| format!("crates/x/src/{f}.rs"));
        let mut files: Vec<(&str, &str)> = sources.iter().map(|f| (f.as_str(), "")).collect();
        files.push(("ARCHITECTURE.md", map));
        let expected = [
            "ARCHITECTURE.md:4: `c.rs` does not exist",
            "ARCHITECTURE.md:1: `crates/x/src/b/d.rs` is not named",
        ];
        assert_eq!(check(architecture, &files), expected);
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
        assert_eq!(words_of(" fk -q '1, 2' ur5"), ["fk", "-q", "1, 2", "ur5"]);
    }
}
