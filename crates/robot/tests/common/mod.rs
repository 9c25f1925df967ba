//! What several test files share.

use denavit::catalogue;
use denavit::description::{Description, Diagnostic, line_column, read_toml, render};

/// A robot of the catalogue.
pub fn robot(name: &str) -> Description {
    let text = catalogue::text(name).expect("a robot of the catalogue");
    read_toml(text).unwrap_or_else(|e| panic!("{}", render(&e, name, text))).0
}

/// `line:column severity: message | hint` of each finding.
pub fn shown(text: &str, findings: &[Diagnostic]) -> Vec<String> {
    findings
        .iter()
        .map(|d| {
            let (line, column) = line_column(text, d.span.start);
            let hint = d.hint.as_deref().map_or(String::new(), |h| format!(" | {h}"));
            format!("{line}:{column} {}: {}{hint}", d.severity.name(), d.message)
        })
        .collect()
}
