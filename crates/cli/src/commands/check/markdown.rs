//! The list as Markdown, as `docs/errata.md` has it.

use super::Document;
use super::terminal::entry_name;
use denavit::check::{Finding, Slip, Standing};

/// Counts, causes, and a table of what is not right.
pub fn list(document: &Document) -> String {
    let checked = document.checked;
    let t = checked.tally();
    let mut out = format!(
        "{} claims: {} proved, {} wrong, {} right under a condition, {} undecided, {} unreadable.\n",
        checked.claims.len(),
        t.equal,
        t.wrong,
        t.conditional,
        t.undecided,
        t.unreadable
    );
    for cause in &checked.causes {
        let count = |places: &[(usize, usize)]| places.len();
        out += &format!(
            "\n**{}**: turns {} right, {} wrong; {} stay wrong.\n",
            cause.change,
            count(&cause.turns_right),
            count(&cause.turns_wrong),
            count(&cause.stays_wrong)
        );
    }
    let mut rows = vec![];
    for claim in checked.claims.iter().filter(|c| c.standing() != Standing::Equal) {
        for entry in &claim.entries {
            let name = code(&entry_name(claim, entry.place));
            let line = document.line(entry.span.start);
            let printed = code(&document.source(&entry.span));
            let (verdict, right, slip) = match &entry.finding {
                Finding::Equal { .. } => continue,
                Finding::Wrong(w) => {
                    let under =
                        w.under_cause.as_ref().map(|(_, s)| format!(" (by the first cause: {})", words(s)));
                    let slip = w.slip.as_ref().map(words).unwrap_or_default() + &under.unwrap_or_default();
                    let remarks: String = w.remarks.iter().map(|r| format!("; {r}")).collect();
                    ("wrong", w.correct.as_deref().map(code).unwrap_or_default(), slip + &remarks)
                }
                Finding::Conditional { condition, correct, remarks } => {
                    let remarks: String = remarks.iter().map(|r| format!("; {r}")).collect();
                    let right = correct.as_deref().map(code).unwrap_or_default();
                    ("conditional", right, format!("right {condition}{remarks}"))
                }
                Finding::Undecided { why } => ("undecided", String::new(), why.clone()),
                Finding::Unreadable(errors) => {
                    let why = errors.first().map(|e| e.message.clone()).unwrap_or_default();
                    ("unreadable", String::new(), why)
                }
            };
            rows.push(format!(
                "| {name} | {line} | {verdict} | {printed} | {right} | {} |\n",
                escaped(&slip)
            ));
        }
        for remark in &claim.remarks {
            let (name, line) = (code(&claim.name), document.line(claim.span.start));
            rows.push(format!("| {name} | {line} | remark | | | {} |\n", escaped(remark)));
        }
    }
    if !rows.is_empty() {
        out += "\n| claim | line | verdict | printed | right | the slip |\n|---|--:|---|---|---|---|\n";
        out += &rows.concat();
    }
    out
}

fn words(slip: &Slip) -> String {
    slip.kind.clone()
}

/// A text in backquotes inside a table.
fn code(text: &str) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if text.is_empty() { text } else { format!("`{}`", escaped(&text.replace('`', "'"))) }
}

fn escaped(text: &str) -> String {
    text.replace('|', "\\|")
}
