//! Every block behind `<!-- denavit ARGUMENTS -->` in a page of the project is what the program prints.

use super::{File, Report};
use crate::denavit;
use anyhow::Result;

/// Runs the program for every block.
///
/// # Errors
/// If it cannot be built, or prints nothing.
pub fn sessions(files: &[File], report: &mut Report) -> Result<()> {
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
    use super::{agrees, words_of};

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
    fn words_as_a_shell_has_them() {
        assert_eq!(words_of(" fk -q '1, 2' ur5"), ["fk", "-q", "1, 2", "ur5"]);
    }
}
