//! Top-level modules of a crate that use each other in a circle.
//!
//! What counts is paths in code outside tests: `crate::…`, `super::…` where it leads to the root, and names that the root
//! takes from a module.

use super::{File, Report, code};
use std::collections::{BTreeMap, BTreeSet};

/// The circles that are there: crate, and the modules of each. The list gets shorter, never longer.
const KNOWN: &[(&str, &[&str])] = &[("bench", &["compiled", "inverse", "peers"])];

/// Who uses whom, and where for the first time.
type Uses<'a> = BTreeMap<&'a str, BTreeMap<&'a str, (&'a str, usize)>>;

/// No crate has a circle that is not known, and all that are known are there.
pub fn circles(files: &[File], report: &mut Report) {
    for package in crates(files) {
        let uses = uses(files, package);
        let circles = components(&uses);
        for circle in &circles {
            let within = |k: &&(&str, &[&str])| k.0 == package && circle.iter().all(|m| k.1.contains(m));
            if !KNOWN.iter().any(|k| within(&k)) {
                let round = shortest(&uses, circle);
                let (file, line) = uses[round[0]][round[1]];
                let all: Vec<&str> = circle.iter().copied().collect();
                let what = format!("circle {}; in all {all:?}", round.join(" → "));
                report.add(file, line, what);
            }
        }
        for (_, known) in KNOWN.iter().filter(|k| k.0 == package) {
            if !circles.iter().any(|c| c.iter().eq(known.iter())) {
                report.add(PLACE, 1, format!("the circle {known:?} of {package} is smaller now, or gone"));
            }
        }
    }
}

const PLACE: &str = "xtask/src/tidy/circles.rs";

/// The folders of crates.
fn crates(files: &[File]) -> BTreeSet<&str> {
    let root = |f: &'_ File| ["/src/lib.rs", "/src/main.rs"].iter().any(|end| f.path.ends_with(end));
    files.iter().filter(|f| root(f)).filter_map(|f| Some(f.path.split_once("/src/")?.0)).collect()
}

fn uses<'a>(files: &'a [File], package: &str) -> Uses<'a> {
    let source = format!("{package}/src/");
    let own = || files.iter().filter_map(|f| Some((f, f.path.strip_prefix(&source)?)));
    let own = || own().filter(|(f, path)| path.ends_with(".rs") && !is_test(&f.path));
    let top = |path: &'a str| path.split('/').next().unwrap_or_default().trim_end_matches(".rs");
    let modules: BTreeSet<&str> = own().map(|(_, path)| top(path)).collect();
    // Names at the root that come from a module.
    let mut given: BTreeMap<&str, &str> = BTreeMap::new();
    for (file, _) in own().filter(|(_, path)| is_root(path)) {
        for (_, statement) in statements(&file.text).into_iter().filter(|(_, s)| s.contains("use ")) {
            for module in modules.iter().filter(|m| leads(statement, m)) {
                words(statement).filter(|w| w != module).for_each(|w| _ = given.entry(w).or_insert(module));
            }
        }
    }
    let mut uses = Uses::new();
    for (file, path) in own().filter(|(_, path)| !is_root(path)) {
        let depth = path.trim_end_matches("/mod.rs").split('/').count();
        let from = top(path);
        for (line, statement) in statements(&file.text) {
            for first in firsts(statement, depth) {
                let to = modules.get(first).or_else(|| given.get(first)).copied();
                if let Some(to) = to.filter(|to| *to != from) {
                    uses.entry(from).or_default().entry(to).or_insert((&file.path, line));
                }
            }
        }
    }
    uses
}

fn is_root(path: &str) -> bool {
    matches!(path, "lib.rs" | "main.rs")
}

fn is_test(path: &str) -> bool {
    path.ends_with("tests.rs") || path.contains("/tests/")
}

/// Code outside tests in pieces, with the line of each: a statement `use` is one piece, everything else a line.
fn statements(text: &str) -> Vec<(usize, &str)> {
    let mut pieces = vec![];
    let mut open: Option<(usize, &str)> = None;
    for (n, line) in code(text) {
        let end = line.as_ptr() as usize + line.len() - text.as_ptr() as usize;
        let start = end - line.len();
        let words = line.trim_start();
        let begins = ["use ", "pub use ", "pub(crate) use ", "pub(super) use "];
        if open.is_none() && begins.iter().any(|b| words.starts_with(b)) {
            open = Some((n, &text[start..]));
        }
        match open {
            Some((first, rest)) if line.ends_with(';') => {
                pieces.push((first, &rest[..end - (rest.as_ptr() as usize - text.as_ptr() as usize)]));
                open = None;
            }
            Some(_) => {}
            None => pieces.push((n, line)),
        }
    }
    pieces
}

/// Whether a statement of the root takes names from a module.
fn leads(statement: &str, module: &str) -> bool {
    let path = statement.split("use ").nth(1).unwrap_or_default();
    let path = path.trim_start_matches("crate::").trim_start_matches("self::");
    path.strip_prefix(module).is_some_and(|rest| rest.starts_with("::"))
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty())
}

/// The first names of the paths from the root that a piece of code has in it, in a file of a module at some depth.
fn firsts(text: &str, depth: usize) -> Vec<&str> {
    let up = "super::".repeat(depth);
    let mut found = vec![];
    for sign in ["crate::", &up] {
        for (at, _) in text.match_indices(sign) {
            let before = &text[..at];
            let is_longer = before.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '$');
            if is_longer || before.ends_with("super::") || text[at + sign.len()..].starts_with("super::") {
                continue;
            }
            found.extend(heads(&text[at + sign.len()..]));
        }
    }
    found
}

/// The first name of a path, or those of a group `{a::b, c}`.
fn heads(rest: &str) -> Vec<&str> {
    let Some(group) = rest.strip_prefix('{') else { return words(rest).take(1).collect() };
    let (mut depth, mut start, mut found) = (0, 0, vec![]);
    for (i, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                found.extend(words(&group[start..i]).next());
                start = i + 1;
            }
            _ => {}
        }
        if c == '}' && depth == 0 && start == i + 1 {
            break;
        }
    }
    found
}

/// Everything that a module reaches.
fn reached<'a>(uses: &Uses<'a>, from: &str) -> BTreeSet<&'a str> {
    let mut open: Vec<&str> = uses.get(from).into_iter().flat_map(|to| to.keys().copied()).collect();
    let mut reached = BTreeSet::new();
    while let Some(module) = open.pop() {
        if reached.insert(module) {
            open.extend(uses.get(module).into_iter().flat_map(|to| to.keys().copied()));
        }
    }
    reached
}

/// The largest sets of modules of which each reaches each.
fn components<'a>(uses: &Uses<'a>) -> BTreeSet<BTreeSet<&'a str>> {
    let reach: BTreeMap<&str, BTreeSet<&str>> = uses.keys().map(|m| (*m, reached(uses, m))).collect();
    let mutual = |a: &&'a str| -> BTreeSet<&'a str> {
        reach[a].iter().copied().filter(|b| reach.get(b).is_some_and(|back| back.contains(a))).collect()
    };
    uses.keys().map(mutual).filter(|set| set.len() > 1).collect()
}

/// A shortest way round within a component, its first module at the end again.
fn shortest<'a>(uses: &Uses<'a>, circle: &BTreeSet<&'a str>) -> Vec<&'a str> {
    let mut ways: Vec<Vec<&str>> = circle.iter().map(|m| vec![*m]).collect();
    loop {
        let mut longer = vec![];
        for way in ways {
            for next in uses[way[way.len() - 1]].keys().filter(|m| circle.contains(*m)) {
                let way = [&way[..], &[*next]].concat();
                if way[0] == *next {
                    return way;
                }
                if !way[..way.len() - 1].contains(next) {
                    longer.push(way);
                }
            }
        }
        ways = longer;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_from_the_root() {
        assert_eq!(firsts("use crate::{a::{b, c}, d, e::f};", 1), ["a", "d", "e"]);
        assert_eq!(firsts("let x = crate::a::b(super::c::d, self::e);", 1), ["a", "c"]);
        assert_eq!(firsts("use super::a;", 2), [""; 0]);
        assert_eq!(firsts("use super::super::a;", 2), ["a"]);
        assert_eq!(firsts("$crate::a", 1), [""; 0]);
    }

    #[test]
    fn circles_are_found() {
        let texts = [
            ("lib", "mod a;\nmod b;\nmod c;\npub use c::Thing;\n"),
            ("a", "use crate::{\n    b::x,\n};\n"),
            ("b/mod", "pub mod d;\n"),
            ("b/d", "use crate::Thing;\n#[cfg(test)]\nmod tests {\n    use crate::a;\n}\n"),
            ("c", "// crate::b\nfn f() {\n    crate::a::g()\n}\n"),
        ];
        let mut files: Vec<File> = vec![];
        for (name, text) in texts {
            files.push(File { path: format!("crates/x/src/{name}.rs"), text: text.into() });
        }
        let mut report = Report::default();
        circles(&files, &mut report);
        assert_eq!(
            report.violations,
            ["crates/x/src/a.rs:1: circle a → b → c → a; in all [\"a\", \"b\", \"c\"]"]
        );
        files.pop();
        let mut report = Report::default();
        circles(&files, &mut report);
        assert_eq!(report.violations, [""; 0]);
    }
}
