//! Public items that nobody uses: neither another crate, nor a test, an example or the documentation of their own.
//!
//! By their names in the text, so that a name that somebody else has, too, is not found.

use super::{File, code, text_files};
use anyhow::Result;
use std::collections::BTreeSet;
use std::io::Write;

/// What begins an item that has a name.
const KINDS: &[&str] = &["fn", "struct", "enum", "trait", "const", "type", "static"];

/// Prints the items.
///
/// # Errors
/// If the files cannot be listed.
pub fn print() -> Result<()> {
    let files = text_files()?;
    let unused = unused(&files);
    // A reader may have seen enough.
    let _ =
        writeln!(std::io::stdout(), "{}\n{} public items that nobody uses", unused.join("\n"), unused.len());
    Ok(())
}

fn unused(files: &[File]) -> Vec<String> {
    let roots = files.iter().filter_map(|f| f.path.strip_suffix("/src/lib.rs"));
    let mut found = vec![];
    for package in roots.filter(|p| p.starts_with("crates/")) {
        let source = format!("{package}/src/");
        let (used, named, told) = (used(files, &source), renamed(files, &source), signatures(files, &source));
        for file in files.iter().filter(|f| f.path.starts_with(&source) && f.path.ends_with(".rs")) {
            let items = items(&file.text);
            let is_open = is_public(files, &source, &file.path[source.len()..]);
            let is_named = items.iter().any(|i| named.contains(i.name));
            for Item { line, name, kind, is_inner } in items {
                let is_shown = is_open || named.contains(name) || (is_inner && is_named);
                let is_told = kind != "fn" && told.contains(name);
                if is_shown && !is_told && !used.contains(name) {
                    found.push(format!("{}:{line}: `{name}`", file.path));
                }
            }
        }
    }
    found
}

/// A public item.
struct Item<'a> {
    line: usize,
    name: &'a str,
    kind: &'a str,
    /// Whether it stands within something.
    is_inner: bool,
}

fn items(text: &str) -> Vec<Item<'_>> {
    code(text).into_iter().filter_map(|(n, line)| item(n, line)).collect()
}

fn item(n: usize, line: &str) -> Option<Item<'_>> {
    let rest = line.trim_start().strip_prefix("pub ")?;
    let before = |w: &&str| matches!(*w, "unsafe" | "async" | "extern" | "\"C\"");
    let mut all = rest.split_whitespace().skip_while(before);
    let mut kind = all.next().filter(|kind| KINDS.contains(kind))?;
    let mut declared = all.next()?;
    if (kind, declared) == ("const", "fn") {
        (kind, declared) = ("fn", all.next()?);
    }
    let name = words(declared).next().filter(|name| declared.starts_with(name))?;
    Some(Item { line: n, name, kind, is_inner: line.starts_with(' ') })
}

/// Words of what a crate shows, without the names that are declared there: a type that a public function takes or gives has
/// a user.
fn signatures<'a>(files: &'a [File], source: &str) -> BTreeSet<&'a str> {
    let own = files.iter().filter(|f| f.path.starts_with(source) && f.path.ends_with(".rs"));
    let lines = own.flat_map(|f| code(&f.text));
    let shown = lines.filter(|(_, line)| line.trim_start().starts_with("pub ") || line.contains("-> "));
    let mut told = BTreeSet::new();
    for (n, line) in shown {
        let declared = item(n, line).map(|i| i.name);
        told.extend(words(line).filter(|w| Some(*w) != declared));
    }
    told
}

/// Words outside of a crate's own code: everybody else's, and those in its documentation.
fn used<'a>(files: &'a [File], source: &str) -> BTreeSet<&'a str> {
    let is_text = |f: &&File| [".rs", ".md", ".py", ".toml"].iter().any(|e| f.path.ends_with(e));
    let mut used = BTreeSet::new();
    for file in files.iter().filter(is_text) {
        if !file.path.starts_with(source) || file.path.ends_with("tests.rs") {
            used.extend(words(&file.text));
            continue;
        }
        let mut is_example = false;
        for line in file.text.lines().map(str::trim_start).filter(|l| l.starts_with("//")) {
            let text = line.trim_start_matches(['/', '!']).trim_start();
            is_example ^= text.starts_with("```");
            if is_example {
                used.extend(words(line));
            }
        }
    }
    used
}

/// Names in statements `pub use` of a crate.
fn renamed<'a>(files: &'a [File], source: &str) -> BTreeSet<&'a str> {
    let own = files.iter().filter(|f| f.path.starts_with(source));
    let statements = own.flat_map(|f| f.text.split("pub use ").skip(1));
    statements.flat_map(|s| words(s.split(';').next().unwrap_or_default())).collect()
}

/// Whether each module on the way to a file is public, or shown as a whole by the one around it.
fn is_public(files: &[File], source: &str, path: &str) -> bool {
    let inner = path.trim_end_matches(".rs").trim_end_matches("/mod");
    let mut around = String::new();
    inner.split('/').all(|module| {
        if matches!(module, "lib" | "main") {
            return true;
        }
        let places = match around.as_str() {
            "" => [format!("{source}lib.rs"), String::new()],
            folder => [format!("{source}{folder}/mod.rs"), format!("{source}{folder}.rs")],
        };
        around = if around.is_empty() { module.into() } else { format!("{around}/{module}") };
        let declared = [format!("pub mod {module};"), format!("pub use {module}::*;")];
        files.iter().any(|f| places.contains(&f.path) && declared.iter().any(|d| f.text.contains(d)))
    })
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_without_a_user() {
        let texts = [
            (
                "crates/x/src/lib.rs",
                "pub mod a;\nmod b;\npub use b::Shown;\n/// ```\n/// documented()\n/// ```\n",
            ),
            ("crates/x/src/a.rs", "pub fn documented() {}\npub const fn lonely() {}\nfn own() {}\n"),
            (
                "crates/x/src/b.rs",
                "pub struct Shown;\npub struct Hidden;\nimpl Shown {\n    pub fn sad() {}\n}\n",
            ),
            ("crates/x/tests/t.rs", "use x::Shown;\n"),
        ];
        let files: Vec<File> = texts.iter().map(|t| File { path: t.0.into(), text: t.1.into() }).collect();
        let expected = ["crates/x/src/a.rs:2: `lonely`", "crates/x/src/b.rs:4: `sad`"];
        assert_eq!(unused(&files), expected);
    }
}
