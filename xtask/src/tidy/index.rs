//! The index of the project's files, of the first lines in which they say what they are.

use super::{is_source, text_files};
use anyhow::Result;
use std::collections::BTreeMap;

/// Prints the index: crates, in them folders, in them files.
///
/// # Errors
/// If the files cannot be listed.
pub fn print() -> Result<()> {
    let files = text_files()?;
    let mut folders: BTreeMap<&str, Vec<(&str, &str)>> = BTreeMap::new();
    for file in files.iter().filter(|f| is_source(f)) {
        let (folder, name) = file.path.rsplit_once('/').unwrap_or(("", &file.path));
        folders.entry(folder).or_default().push((name, first_line(&file.text).unwrap_or_default()));
    }
    let mut package = "";
    for (folder, files) in &folders {
        let own = package_of(folder);
        if own != package {
            println!("\n# {own}");
            package = own;
        }
        println!("\n{folder}/");
        let width = files.iter().map(|f| f.0.len()).max().unwrap_or(0);
        files.iter().for_each(|(name, line)| println!("  {name:<width$}  {line}"));
    }
    Ok(())
}

/// The folder of the crate.
fn package_of(folder: &str) -> &str {
    let ends = ["/src", "/examples", "/tests", "/fuzz_targets"].iter().filter_map(|part| folder.find(part));
    &folder[..ends.min().unwrap_or(folder.len())]
}

/// What a file says of itself: the first sentence of its documentation, as far as it stands on the first line.
pub fn first_line(text: &str) -> Option<&str> {
    let first = text.lines().find(|l| !l.starts_with("#!["))?;
    Some(first.strip_prefix("//!")?.trim()).filter(|line| !line.is_empty())
}

#[cfg(test)]
mod tests {
    use super::{first_line, package_of};

    #[test]
    fn files_and_their_crates() {
        assert_eq!(first_line("//! What it is.\n//! More.\n"), Some("What it is."));
        assert_eq!(first_line("//!\nuse a;\n"), None);
        assert_eq!(first_line("use a;\n//! late\n"), None);
        assert_eq!(package_of("crates/robot/src/inverse"), "crates/robot");
        assert_eq!(package_of("xtask/src"), "xtask");
    }
}
