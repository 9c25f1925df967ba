//! The list as Markdown, as `docs/errata.md` has it.

use super::Document;
use crate::terminal::words;
use denavit_check::{Claim, Finding, Standing};
use std::ops::Range;

/// Counts, causes, and a table of what is not right.
pub fn list(document: &Document) -> String {
    let checked = document.checked;
    let t = checked.tally();
    let mut out = format!(
        "{} claims: {} proved, {} right in numbers, {} wrong, {} right under a condition, {} carried, {} undecided, {} unreadable; {} lines not \
         judged.\n",
        checked.claims.len(),
        t.proved,
        t.equal - t.proved,
        t.wrong,
        t.conditional,
        t.carried,
        t.undecided,
        t.unreadable,
        t.unjudged
    );
    for (n, cause) in (1..).zip(&checked.causes) {
        out += &format!("\n**Cause {n}: {}.**", escaped(&words().change(&cause.change)));
        for (what, places) in [
            ("turns right", &cause.turns_right),
            ("turns wrong", &cause.turns_wrong),
            ("leaves wrong", &cause.stays_wrong),
        ] {
            if !places.is_empty() {
                out += &format!(" It {what}: {}.", names(document, places));
            }
        }
        out += "\n";
    }
    let mut rows = vec![];
    for claim in checked.claims.iter().filter(|c| c.standing() != Standing::Equal) {
        if let Some((span, wrong)) = as_a_whole(claim) {
            let (name, printed, line) =
                (code(&claim.name), code(&document.source(span)), document.line(span.start));
            rows.push(format!("| {name} | {line} | wrong | {printed} | | in {wrong} elements |\n"));
            continue;
        }
        for entry in &claim.entries {
            let name = code(&words().entry(&claim.name, entry.place));
            let line = document.line(entry.span.start);
            let printed = code(&document.source(&entry.span));
            let (verdict, right, said) = match &entry.finding {
                Finding::Equal { .. } => continue,
                Finding::Wrong(w) => {
                    let slip = w.slip.iter().map(|s| escaped(&words().slip(&s.kind)));
                    let under = w.under_cause.iter().map(|(cause, s)| {
                        let kind = escaped(&words().slip(&s.kind));
                        format!("by cause {}, {kind}: {}", cause + 1, code(&s.formula))
                    });
                    let remarks = w.remarks.iter().map(|r| escaped(&words().remarked(r)));
                    let said: Vec<String> = slip.chain(under).chain(remarks).collect();
                    ("wrong", right(&w.correct), said.join("; "))
                }
                Finding::Conditional { condition, correct, remarks } => {
                    let remarks = remarks.iter().map(|r| words().remarked(r));
                    let said =
                        std::iter::once(format!("right {}", words().right_where(condition))).chain(remarks);
                    let said: Vec<String> = said.map(|r| escaped(&r)).collect();
                    ("conditional", right(correct), said.join("; "))
                }
                Finding::Carried { by, correct } => {
                    let cause = document.checked.claims.get(*by);
                    let said = cause.map(|c| words().carried(&c.name, document.line(c.span.start)));
                    ("carried", right(correct), escaped(&said.unwrap_or_default()))
                }
                Finding::Undecided { why } => ("undecided", String::new(), escaped(&words().unproved(*why))),
                Finding::Unreadable(errors) => {
                    let why =
                        errors.first().map(|e| escaped(&words().unreadable(&e.why))).unwrap_or_default();
                    ("unreadable", String::new(), why)
                }
            };
            rows.push(format!("| {name} | {line} | {verdict} | {printed} | {right} | {said} |\n"));
        }
        for remark in &claim.remarks {
            let (name, line) = (code(&claim.name), document.line(claim.span.start));
            rows.push(format!("| {name} | {line} | remark | | | {} |\n", escaped(&words().remarked(remark))));
        }
    }
    if !rows.is_empty() {
        out += "\n| claim | line | verdict | printed | right | the slip |\n|---|--:|---|---|---|---|\n";
        out += &rows.concat();
    }
    let unjudged = checked.unjudged.iter().map(|u| {
        let (line, text) = (document.line(u.span.start), code(&document.source(&u.span)));
        format!("| {line} | {text} | {} |\n", escaped(&words().skipped(&u.why)))
    });
    let unjudged: String = unjudged.collect();
    if !unjudged.is_empty() {
        out += "\n| line | not judged | why |\n|--:|---|---|\n";
        out += &unjudged;
    }
    out
}

/// Where a matrix stands whose elements are not printed one by one, and how many of them are wrong.
fn as_a_whole(claim: &Claim) -> Option<(&Range<usize>, usize)> {
    let span = &claim.entries.first()?.span;
    let is_whole = claim.entries.len() > 1 && claim.entries.iter().all(|e| e.span == *span);
    let wrong = claim.entries.iter().filter(|e| e.finding.standing() == Standing::Wrong).count();
    (is_whole && wrong > 0).then_some((span, wrong))
}

/// Claims and entries by their names.
fn names(document: &Document, places: &[(usize, usize)]) -> String {
    let name = |&(c, e): &(usize, usize)| {
        let claim = document.checked.claims.get(c)?;
        Some(code(&words().entry(&claim.name, claim.entries.get(e)?.place)))
    };
    places.iter().filter_map(name).collect::<Vec<_>>().join(", ")
}

/// What is right, if it is known.
fn right(correct: &[String]) -> String {
    words().either(correct).as_deref().map(code).unwrap_or_default()
}

/// A text in backquotes inside a table.
fn code(text: &str) -> String {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|");
    match &text[..] {
        "" => text,
        quoted if quoted.contains('`') => format!("`` {quoted} ``"),
        _ => format!("`{text}`"),
    }
}

/// A text inside a table, its own marks without effect; what stands in backquotes is left as it is.
fn escaped(text: &str) -> String {
    let part = |(k, part): (usize, &str)| {
        let marks: &[char] = if k % 2 == 0 { &['\\', '*', '_', '|', '<', '['] } else { &['|'] };
        part.chars().fold(String::new(), |mut out, c| {
            out.extend(marks.contains(&c).then_some('\\'));
            out.push(c);
            out
        })
    };
    text.split('`').enumerate().map(part).collect::<Vec<_>>().join("`")
}
