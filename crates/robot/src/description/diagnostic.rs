//! What is wrong with a text, or worth saying about it: each finding with its place and a hint.
//!
//! A reader collects all of them; whoever opened the file shows them.

use std::fmt::Write;
use std::ops::Range;

/// How much a finding matters.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Severity {
    /// The text says nothing that could be computed with.
    Error,
    /// It can be read, but is probably not what was meant.
    Warning,
    /// How something was understood.
    Note,
}

impl Severity {
    /// `error`, `warning` or `note`.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        }
    }
}

/// One finding.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Diagnostic {
    /// How much it matters.
    pub severity: Severity,
    /// Where: bytes of the text.
    pub span: Range<usize>,
    /// What.
    pub message: String,
    /// What would help.
    pub hint: Option<String>,
}

impl Diagnostic {
    /// `file:line:column: error: message`, the line of the text with the place marked, and the hint.
    pub fn render(&self, file: &str, text: &str) -> String {
        let (line, column) = line_column(text, self.span.start);
        let mut out = format!("{file}:{line}:{column}: {}: {}\n", self.severity.name(), self.message);
        let source = text.lines().nth(line - 1).unwrap_or("");
        if !source.trim().is_empty() {
            let source = source.trim_start_matches(BYTE_ORDER_MARK);
            let end = line_column(text, self.span.end.min(text.len()));
            let last = if end.0 == line { end.1 } else { usize::MAX };
            let (shown, place) = clipped(source, column - 1..last - 1);
            let marks = place.len().max(1);
            let _ = writeln!(out, "  | {shown}\n  | {}{}", " ".repeat(place.start), "^".repeat(marks));
        }
        if let Some(hint) = &self.hint {
            let _ = writeln!(out, "  = hint: {hint}");
        }
        out
    }
}

/// The most characters of a source line that are shown.
const MAX_SHOWN: usize = 160;

/// How some editors begin a text.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// A source line without control characters, cut to the neighbourhood of a place (both in characters), and the
/// place in it.
fn clipped(source: &str, place: Range<usize>) -> (String, Range<usize>) {
    let length = source.chars().count();
    let start = match place.start.min(length) {
        _ if length <= MAX_SHOWN => 0,
        at => at.saturating_sub(MAX_SHOWN / 3).min(length - MAX_SHOWN),
    };
    let end = (start + MAX_SHOWN).min(length);
    let (before, after) = (if start > 0 { "…" } else { "" }, if end < length { "…" } else { "" });
    let printable =
        source.chars().skip(start).take(end - start).map(|c| if c.is_control() { ' ' } else { c });
    let shown = format!("{before}{}{after}", printable.collect::<String>());
    let shift = |at: usize| at.min(end).saturating_sub(start) + before.chars().count();
    (shown, shift(place.start)..shift(place.end))
}

/// The findings of one reading; from the 100th on they are only counted.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    left_out: usize,
    last: Option<Diagnostic>,
}

/// How many findings are worth listing.
const MAX_FINDINGS: usize = 100;

impl Diagnostics {
    /// Adds a finding and gives it back, so that a hint can follow.
    fn push(&mut self, severity: Severity, span: Range<usize>, message: String) -> &mut Diagnostic {
        let finding = Diagnostic { severity, span, message, hint: None };
        if self.list.len() < MAX_FINDINGS {
            self.list.push(finding);
            return self.list.last_mut().expect("it was just added");
        }
        self.left_out += usize::from(severity == Severity::Error);
        self.last.insert(finding)
    }

    /// True once further findings are only counted; a reader need not look for hints any more.
    pub(super) fn is_full(&self) -> bool {
        self.list.len() >= MAX_FINDINGS
    }

    /// Those found so far.
    pub fn list(&self) -> &[Diagnostic] {
        &self.list
    }

    /// Adds what another reading found.
    pub fn add(&mut self, finding: Diagnostic) {
        let Diagnostic { severity, span, message, hint } = finding;
        self.push(severity, span, message).hint = hint;
    }

    /// Adds an error.
    pub fn error(&mut self, span: Range<usize>, message: impl Into<String>) -> &mut Diagnostic {
        self.push(Severity::Error, span, message.into())
    }

    /// Adds a warning.
    pub fn warning(&mut self, span: Range<usize>, message: impl Into<String>) -> &mut Diagnostic {
        self.push(Severity::Warning, span, message.into())
    }

    /// Adds a note.
    pub fn note(&mut self, span: Range<usize>, message: impl Into<String>) -> &mut Diagnostic {
        self.push(Severity::Note, span, message.into())
    }

    /// True if one of them is an error.
    pub(crate) fn has_errors(&self) -> bool {
        self.left_out > 0 || self.list.iter().any(|d| d.severity == Severity::Error)
    }

    /// `value` with the warnings and notes, or, if there is an error, everything found; in the order of the text.
    pub(super) fn finish<T>(mut self, value: Option<T>) -> Result<(T, Vec<Diagnostic>), Vec<Diagnostic>> {
        let failed = self.has_errors();
        self.list.sort_by_key(|d| (d.span.start, d.severity));
        self.list.dedup();
        if let (1.., Some(mut last)) = (self.left_out, self.last) {
            last.message = format!("{} (and {} more errors)", last.message, self.left_out - 1);
            self.list.push(last);
        }
        match value {
            Some(value) if !failed => Ok((value, self.list)),
            _ => Err(self.list),
        }
    }

    /// All of them as text, see [`Diagnostic::render`].
    pub fn render(&self, file: &str, text: &str) -> String {
        render(&self.list, file, text)
    }
}

impl Diagnostic {
    /// Sets the hint in place.
    pub fn hint(&mut self, hint: impl Into<String>) {
        self.hint = Some(hint.into());
    }
}

/// Findings as text, see [`Diagnostic::render`].
pub fn render(findings: &[Diagnostic], file: &str, text: &str) -> String {
    findings.iter().map(|d| d.render(file, text)).collect()
}

/// Line and column of a byte, both counted from 1, columns in characters.
pub fn line_column(text: &str, offset: usize) -> (usize, usize) {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    let before = &text[..offset];
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let in_line = before[line_start..].trim_start_matches(BYTE_ORDER_MARK);
    (before.matches('\n').count() + 1, in_line.chars().count() + 1)
}

/// Of very many names only the first ones are compared.
const MAX_CANDIDATES: usize = 5000;

/// The one of `candidates` that `word` was probably meant to be: about a third of its letters differ at most.
pub(super) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let plain =
        |s: &str| s.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect::<Vec<_>>();
    let word: Vec<char> = plain(word).into_iter().take(40).collect();
    candidates
        .into_iter()
        .take(MAX_CANDIDATES)
        .filter(|c| c.len() <= 40)
        .map(|c| (edit_distance(&word, &plain(c)), c))
        .filter(|&(distance, c)| distance <= (word.len().max(c.len()) + 1) / 3 && word.len() > 1)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, c)| c)
}

/// Insertions, deletions, replacements and swaps of neighbours from `a` to `b` (optimal string alignment).
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut rows = vec![(0..=b.len()).collect::<Vec<usize>>()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            let mut best = (rows[i - 1][j] + 1).min(row[j - 1] + 1).min(rows[i - 1][j - 1] + change);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            row.push(best);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_lines_and_characters() {
        let text = "θ = 1\nα = x\n";
        for (offset, place) in
            [(0, (1, 1)), (2, (1, 2)), (7, (2, 1)), (9, (2, 2)), (1, (1, 1)), (999, (3, 1))]
        {
            assert_eq!(line_column(text, offset), place, "byte {offset}");
        }
    }

    #[test]
    fn a_finding_is_shown_in_its_line() {
        let text = "name = \"x\"\ntheta = \"q1 + L7\"\n";
        let d = Diagnostic {
            severity: Severity::Error,
            span: 25..27,
            message: "`L7` is unknown".into(),
            hint: None,
        };
        assert_eq!(
            Diagnostic { hint: Some("declare it".into()), ..d }.render("arm.toml", text),
            "arm.toml:2:15: error: `L7` is unknown\n  | theta = \"q1 + L7\"\n  |               ^^\n  = hint: declare it\n"
        );
    }

    #[test]
    fn a_long_line_is_cut_around_the_place() {
        let shown = |before: usize, after: usize| {
            let text = format!("{}XY{}", "a".repeat(before), "b".repeat(after));
            let span = before..before + 2;
            let d = Diagnostic { severity: Severity::Error, span, message: String::new(), hint: None };
            d.render("f", &text).lines().skip(1).map(|l| l[4..].to_string()).collect::<Vec<_>>()
        };
        for (before, after, cut) in [
            (0, 158, format!("XY{}", "b".repeat(158))),
            (0, 159, format!("XY{}…", "b".repeat(158))),
            (1_000_000, 1_000_000, format!("…{}XY{}…", "a".repeat(53), "b".repeat(105))),
            (1_000_000, 0, format!("…{}XY", "a".repeat(158))),
        ] {
            let lines = shown(before, after);
            assert_eq!(lines[0], cut);
            let place = cut.chars().position(|c| c == 'X').expect("the place is shown");
            assert_eq!(lines[1], format!("{}^^", " ".repeat(place)));
        }
        let (line, place) = clipped(&"é".repeat(500), 0..usize::MAX - 1);
        assert_eq!((line.chars().count(), place), (161, 0..160));
    }

    #[test]
    fn slips_of_the_pen_find_their_word() {
        for (word, expected) in [
            ("tetha", Some("theta")),
            ("aplha", Some("alpha")),
            ("Theta", Some("theta")),
            ("limit", Some("limits")),
            ("mas", Some("mass")),
            ("colour", None),
            ("x", None),
            ("", None),
        ] {
            assert_eq!(nearest(word, ["theta", "alpha", "limits", "mass", "d"]), expected, "{word}");
        }
    }
}
