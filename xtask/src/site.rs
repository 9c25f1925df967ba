//! The documentation site: pages, notebooks and the reference of the Python package, by Sphinx; `docs/site` says how it looks.

use crate::{command, folders, languages, path, python, scratch, succeed, target, web};
use anyhow::{Context, Result};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// What builds the site, all of which says of itself that it is free; in these versions it builds without warnings.
const PACKAGES: &[&str] = &[
    "sphinx==9.0.4",
    "myst-nb==1.4.0",
    "myst-parser==5.2.0",
    "furo==2025.12.19",
    "sphinx-copybutton==0.5.2",
    "sphinx-design==0.8.0",
    "numpy",
];
/// Pages at the root of the project.
const ROOT: &[&str] = &["README.md", "ARCHITECTURE.md", "CHANGELOG.md"];
/// Where the rest of it stands, and what of that lies at the root of the site.
const DOCS: &str = "docs";
const SITE: &str = "docs/site";
/// The page of `denavit view` in the site.
const VIEW: &str = "view";
/// Longer files that a page links to are handed out, and not shown.
const SHOWN: usize = 100_000;

/// Builds the site into `target/site`, with the page of `denavit view` where that is built; gives the folder.
///
/// # Errors
/// If Sphinx warns of something, a link within the site is broken, or a public name of the package has no place in it.
pub fn build() -> Result<PathBuf> {
    let python = languages::python_in(&scratch()?.join("site-python"), PACKAGES)?;
    let package = python::built(&scratch()?.join("site-package"))?;
    let (pages, site) = (scratch()?.join("site"), target().join("site"));
    for folder in [&pages, &site] {
        if folder.exists() {
            fs::remove_dir_all(folder)?;
        }
    }
    gather(&pages)?;
    let app = web::built();
    let mut sphinx = command(&python);
    sphinx.args(["-m", "sphinx", "--builder", "html", "--quiet", "--fail-on-warning", "--doctree-dir"]);
    sphinx.arg(scratch()?.join("site-doctrees")).arg("--fresh-env");
    if app.is_some() {
        sphinx.args(["--tag", "app"]);
    }
    if web::single().is_some() {
        sphinx.args(["--tag", "single"]);
    }
    sphinx.env("PYTHONPATH", &package).env("DENAVIT_VERSION", env!("CARGO_PKG_VERSION"));
    succeed(sphinx.arg(&pages).arg(&site))?;
    match app {
        Some(app) => {
            folders::copied(&app, &site.join(VIEW))?;
            if let Some(file) = web::single() {
                fs::copy(&file, site.join(VIEW).join("denavit.html"))?;
            }
        }
        None => println!("without the page of `denavit view`, which is not built (`cargo xtask web`)"),
    }
    let mut check = command(&python);
    succeed(check.arg(path(SITE).join("check.py")).arg(&site).env("PYTHONPATH", &package))?;
    println!("{}", site.join("index.html").display());
    Ok(site)
}

/// Puts together what Sphinx reads: pages where they stand in the project, so that their links hold, and what they link to.
fn gather(to: &Path) -> Result<()> {
    folders::copied(&path(DOCS), &to.join(DOCS))?;
    fs::remove_dir_all(to.join(SITE))?;
    folders::beside(&path(SITE), to)?;
    for name in ROOT {
        fs::copy(path(name), to.join(name))?;
    }
    let mut shown: BTreeMap<PathBuf, BTreeSet<PathBuf>> = BTreeMap::new();
    for page in folders::files(to)?.iter().filter(|f| f.extension().is_some_and(|e| e == "md")) {
        let text = fs::read_to_string(page)?;
        let own = page.strip_prefix(to)?.parent().context("a folder")?;
        let changed = relinked(&text, own, to, &mut shown)?;
        if changed != text {
            fs::write(page, changed)?;
        }
    }
    for (folder, files) in &shown {
        let text = listing(folder, files, to)?;
        fs::write(to.join(folder).join("folder.md"), text)?;
    }
    Ok(())
}

/// A page whose links to files of the project that are no pages, or to folders, lead to pages that show them.
fn relinked(
    text: &str,
    own: &Path,
    to: &Path,
    shown: &mut BTreeMap<PathBuf, BTreeSet<PathBuf>>,
) -> Result<String> {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, link)) = rest.split_once("](") {
        out += before;
        out += "](";
        let end = link.find([')', '\n']).unwrap_or(link.len());
        let (goal, after) = link.split_at(end);
        rest = after;
        let place = plain(&own.join(goal.split('#').next().unwrap_or_default()));
        let there = path("").join(&place);
        let is_page = to.join(&place).is_file();
        if goal.contains("://") || goal.starts_with('#') || is_page || !there.exists() {
            out += goal;
            continue;
        }
        let (folder, anchor) = if there.is_dir() {
            let all = folders::files(&there)?;
            let files = all.iter().map(|f| Ok(f.strip_prefix(path(""))?.to_path_buf()));
            shown.entry(place.clone()).or_default().extend(files.collect::<Result<Vec<_>>>()?);
            (place, String::new())
        } else {
            let folder = place.parent().context("a folder")?.to_path_buf();
            shown.entry(folder.clone()).or_default().insert(place.clone());
            (folder, format!("#{}", slug(&named(&place))))
        };
        // From where the page is up to the root, and down again.
        let up = "../".repeat(own.components().count());
        write!(out, "{up}{}/folder.md{anchor}", folder.to_string_lossy().replace('\\', "/"))?;
    }
    Ok(out + rest)
}

/// A path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => _ = out.pop(),
            Component::CurDir => {}
            other => out.push(other),
        }
    }
    out
}

fn named(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// What a heading is called in a link.
fn slug(heading: &str) -> String {
    heading.chars().filter(|c| c.is_alphanumeric() || "-_".contains(*c)).collect::<String>().to_lowercase()
}

/// The page that shows files of a folder.
fn listing(folder: &Path, files: &BTreeSet<PathBuf>, to: &Path) -> Result<String> {
    let title = folder.to_string_lossy().replace('\\', "/");
    let mut page = format!("---\norphan: true\n---\n\n# `{title}`\n");
    for file in files {
        let (name, copy) = (named(file), to.join(file));
        fs::create_dir_all(copy.parent().context("a folder")?)?;
        fs::copy(path("").join(file), &copy)?;
        let below = file.strip_prefix(folder)?.to_string_lossy().replace('\\', "/");
        write!(page, "\n## `{name}`\n\n")?;
        if fs::metadata(&copy)?.len() as usize > SHOWN {
            writeln!(page, "{{download}}`{below}`")?;
            continue;
        }
        let language = match file.extension().and_then(|e| e.to_str()) {
            Some("rs") => "rust",
            Some("py") => "python",
            Some("c" | "h") => "c",
            Some("cpp" | "hpp") => "cpp",
            Some("go") => "go",
            Some(known @ ("toml" | "json")) => known,
            _ => "none",
        };
        write!(page, "```{{literalinclude}} {below}\n:language: {language}\n```\n")?;
    }
    Ok(page)
}

#[cfg(test)]
mod tests {
    use super::{plain, relinked, slug};
    use std::collections::BTreeMap;
    use std::path::Path;

    #[test]
    fn links_to_files_lead_to_pages_that_show_them() {
        let mut shown = BTreeMap::new();
        let nowhere = Path::new("no such folder");
        let text = "[a](../crates/robot/examples/04_inverse.rs), [b](#there), [c](https://x.org/d), [d](../crates/robot/examples)";
        let changed = relinked(text, Path::new("docs"), nowhere, &mut shown).unwrap();
        assert_eq!(
            changed,
            "[a](../crates/robot/examples/folder.md#04_inversers), [b](#there), [c](https://x.org/d), \
             [d](../crates/robot/examples/folder.md)"
        );
        let files = &shown[Path::new("crates/robot/examples")];
        assert!(files.contains(Path::new("crates/robot/examples/01_forward_model.rs")), "{files:?}");
    }

    #[test]
    fn places_are_plain() {
        assert_eq!(plain(Path::new("docs/../crates/./robot")), Path::new("crates/robot"));
        assert_eq!(slug("make_Dynamics.py"), "make_dynamicspy");
    }
}
