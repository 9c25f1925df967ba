//! docs/errata.md: what `denavit check` says of the documents that the project knows.

use crate::{denavit, path};
use anyhow::{Context, Result, bail};
use std::fmt::Write;
use std::fs;

const PAGE: &str = "docs/errata.md";
/// Where the documents are.
pub const FOLDER: &str = "examples/documents";
/// In the order in which the project met them.
pub const DOCUMENTS: &[&str] = &["transforms", "rx90", "stanford", "prrrrp", "ur3", "cylindrical", "smart5"];

/// Compares the page, or writes it.
///
/// # Errors
/// If the page is not up to date and shall not be written.
pub fn run(write: bool) -> Result<()> {
    let text = page()?;
    if write {
        fs::write(path(PAGE), text)?;
        println!("wrote {PAGE}");
        return Ok(());
    }
    if fs::read_to_string(path(PAGE)).ok().as_deref() != Some(&text) {
        bail!("{PAGE} is not up to date; `cargo xtask errata --write` renews it");
    }
    println!("{PAGE} is up to date");
    Ok(())
}

fn page() -> Result<String> {
    let (mut rows, mut lists) = (String::new(), String::new());
    for name in DOCUMENTS {
        let file = format!("{FOLDER}/{name}.md");
        let text = fs::read_to_string(path(&file)).with_context(|| file.clone())?;
        let (title, source) = head(&text).with_context(|| format!("{file}: no heading with a paragraph"))?;
        let list = denavit(["check", &file, "--markdown"])?;
        let (counts, list) = list.split_once('\n').context("counts")?;
        let cells: Vec<&str> =
            counts.split(|c: char| !c.is_ascii_digit()).filter(|n| !n.is_empty()).collect();
        if cells.len() != 9 {
            bail!("{file}: nine counts, not `{counts}`");
        }
        let _ = writeln!(rows, "| [{title}](#{}) | {} |", anchor(title), cells.join(" | "));
        let _ = write!(lists, "\n## {title}\n\n{source} [Transcription](../{file}).\n{list}");
    }
    Ok(format!(
        "# Errata\n\n\
         Formulas of teaching documents that their own tables contradict. Generated: this is what\n\
         `denavit check {FOLDER}/NAME.md --markdown` prints for each transcription. `cargo xtask errata --write` renews it,\n\
         `cargo xtask test` fails if it is not up to date.\n\n\
         A claim is what stands to the left of an equality sign, with one formula or a matrix; it is wrong if one of its\n\
         entries is. Verdicts are by proof, unless they say that they are by comparison with all solutions or found in\n\
         samples. Line is the line of the transcription. What is not wrong or right under a condition is proved,\n\
         or said to be right in numbers, and not listed. Where a slip comes from, what is odd in print and what the documents leave out:\n\
         [remarks](errata-remarks.md).\n\n\
         | document | claims | proved | right in numbers | wrong | right under a condition | carried | undecided | unreadable | lines not judged |\n\
         |---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n{rows}{lists}"
    ))
}

/// The first heading of a document and the paragraph below it, on one line.
fn head(text: &str) -> Option<(&str, String)> {
    let mut lines = text.lines();
    let title = lines.find_map(|l| l.strip_prefix("# "))?;
    let paragraph = lines.skip_while(|l| l.trim().is_empty()).take_while(|l| !l.trim().is_empty());
    let paragraph: Vec<&str> = paragraph.collect();
    (!paragraph.is_empty()).then(|| (title, paragraph.join(" ")))
}

/// The name of a heading in links, as GitHub and others form it.
fn anchor(heading: &str) -> String {
    let kept = heading.to_lowercase();
    kept.chars().filter(|c| c.is_alphanumeric() || " -".contains(*c)).collect::<String>().replace(' ', "-")
}

#[cfg(test)]
mod tests {
    use super::{anchor, head};

    #[test]
    fn heads_of_documents() {
        let text = "# Stäubli RX-90\n\nFrom a course,\nas printed.\n\nconvention: khalil\n";
        assert_eq!(head(text), Some(("Stäubli RX-90", "From a course, as printed.".into())));
        assert_eq!(head("# Title\n"), None);
        assert_eq!(anchor("Stäubli RX-90"), "stäubli-rx-90");
    }
}
