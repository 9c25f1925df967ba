//! The index of the project's files, of the first lines in which they say what they are.

use super::{is_source, text_files};
use anyhow::Result;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;

/// Prints the index: crates, in them folders, in them files.
///
/// # Errors
/// If the files cannot be listed.
pub fn print() -> Result<()> {
    let files = text_files()?;
    let mut folders: BTreeMap<&str, Vec<(&str, String)>> = BTreeMap::new();
    for file in files.iter().filter(|f| is_source(f)) {
        let (folder, name) = file.path.rsplit_once('/').unwrap_or(("", &file.path));
        folders.entry(folder).or_default().push((name, first_line(&file.text).unwrap_or_default()));
    }
    let (mut package, mut out) = ("", String::new());
    for (folder, files) in &folders {
        let own = package_of(folder);
        if own != package {
            let _ = writeln!(out, "\n# {own}");
            package = own;
        }
        let _ = writeln!(out, "\n{folder}/");
        let width = files.iter().map(|f| f.0.len()).max().unwrap_or(0);
        for (name, line) in files {
            let _ = writeln!(out, "  {name:<width$}  {line}");
        }
    }
    // A reader may have seen enough.
    let _ = std::io::stdout().write_all(out.as_bytes());
    Ok(())
}

/// The folder of the crate.
fn package_of(folder: &str) -> &str {
    let ends = ["/src", "/examples", "/tests", "/fuzz_targets"].iter().filter_map(|part| folder.find(part));
    &folder[..ends.min().unwrap_or(folder.len())]
}

/// What a file says of itself: the first sentence of its documentation.
pub fn first_line(text: &str) -> Option<String> {
    let lines = text.lines().skip_while(|l| l.starts_with("#!["));
    let paragraph: Vec<&str> =
        lines.map_while(|l| Some(l.strip_prefix("//!")?.trim())).take_while(|l| !l.is_empty()).collect();
    let paragraph = paragraph.join(" ");
    let end = paragraph.find(". ").map_or(paragraph.len(), |at| at + 1);
    Some(paragraph[..end].to_string()).filter(|sentence| !sentence.is_empty())
}

#[cfg(test)]
mod tests {
    use super::{first_line, package_of};

    #[test]
    fn files_and_their_crates() {
        assert_eq!(first_line("//! What\n//! it is. More.\n"), Some("What it is.".into()));
        assert_eq!(first_line("//!\nuse a;\n"), None);
        assert_eq!(first_line("use a;\n//! late\n"), None);
        assert_eq!(package_of("crates/robot/src/inverse"), "crates/robot");
        assert_eq!(package_of("xtask/src"), "xtask");
    }
}
