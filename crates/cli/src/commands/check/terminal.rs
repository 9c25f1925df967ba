//! What a person reads in a terminal.

use super::Document;
use super::marked::{Piece, pieces};
use crate::terminal::{FAINT, HEADING, NAME, decimals, styled, words};
use anstyle::{AnsiColor, Style};
use denavit_check::{Cause, Claim, Counterexample, Entry, Finding, Patch, Slip, Standing, Wrong};
use std::ops::Range;

const GOOD: Style = AnsiColor::Green.on_default();
const BAD: Style = AnsiColor::Red.on_default().bold();
const DOUBT: Style = AnsiColor::Yellow.on_default();

/// The verdicts, those on wrong claims with what is wrong; with `all`, the right ones too.
pub fn report(document: &Document, all: bool) -> String {
    let checked = document.checked;
    let tally = checked.tally();
    let mut out = String::new();
    for (n, cause) in (1..).zip(&checked.causes) {
        out += &told(document, n, cause);
    }
    for claim in &checked.claims {
        let standing = claim.standing();
        if standing != Standing::Equal || all || !claim.remarks.is_empty() {
            out += &shown(document, claim);
        }
    }
    out += &unjudged(document);
    let names: Vec<&str> = checked.robots.iter().map(|r| r.name.as_str()).collect();
    let mut robots = names.clone();
    robots.dedup();
    let mut parts = vec![format!("{} proved", styled(&tally.proved.to_string(), GOOD))];
    for (count, word, style) in [
        (tally.equal - tally.proved, "right in numbers", GOOD),
        (tally.wrong, "wrong", BAD),
        (tally.conditional, "right under a condition", DOUBT),
        (tally.carried, "carried from an earlier error", DOUBT),
        (tally.undecided, "not decided", DOUBT),
        (tally.unreadable, "not readable", DOUBT),
    ] {
        if count > 0 {
            parts.push(format!("{} {word}", styled(&count.to_string(), style)));
        }
    }
    if tally.unjudged > 0 {
        let plural = if tally.unjudged == 1 { "line" } else { "lines" };
        parts.push(format!("{} {plural} not judged", styled(&tally.unjudged.to_string(), DOUBT)));
    }
    let count = checked.claims.len();
    let plural = if count == 1 { "claim" } else { "claims" };
    let about = robots.first().map_or(String::new(), |r| format!(" about {r}"));
    out + &format!("{}: {count} {plural}{about}: {}\n", styled(document.name, HEADING), parts.join(", "))
}

/// What looks like a formula and was not judged, line by line.
fn unjudged(document: &Document) -> String {
    let all = &document.checked.unjudged;
    if all.is_empty() {
        return String::new();
    }
    let mut out = format!("{}\n", styled("not judged:", HEADING));
    for found in all {
        let text: String = document.source(&found.span).chars().take(100).collect();
        let why = words().skipped(&found.why);
        out += &format!("  line {}: {}  {}\n", document.line(found.span.start), text, styled(&why, FAINT));
    }
    out + "\n"
}

fn told(document: &Document, n: usize, cause: &Cause) -> String {
    let names = |places: &[(usize, usize)]| {
        let mut names: Vec<String> = vec![];
        for &(c, e) in places {
            let Some(claim) = document.checked.claims.get(c) else { continue };
            let name = words().entry(&claim.name, claim.entries.get(e).and_then(|e| e.place));
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let more = names.len().saturating_sub(12);
        names.truncate(12);
        format!("{}{}", names.join(", "), if more > 0 { format!(" and {more} more") } else { String::new() })
    };
    let mut out = format!("{} {}\n", styled(&format!("cause {n}:"), HEADING), words().change(&cause.change));
    if let Some(slip) = &cause.slip
        && let (Some(first), Some(last)) = (slip.patches.first(), slip.patches.last())
    {
        let line = |at: usize| document.text[..at].rfind('\n').map_or(0, |n| n + 1);
        let end =
            document.text[last.span.end..].find('\n').map_or(document.text.len(), |n| last.span.end + n);
        let span = line(first.span.start)..end;
        out += &format!(
            "  line {}: {}\n",
            document.line(first.span.start),
            marked(document, &span, &slip.patches)
        );
    }
    for (what, places) in [
        ("turns right", &cause.turns_right),
        ("turns wrong", &cause.turns_wrong),
        ("stays wrong", &cause.stays_wrong),
    ] {
        if !places.is_empty() {
            out += &format!("  {what} ({}): {}\n", places.len(), names(places));
        }
    }
    out + "\n"
}

fn shown(document: &Document, claim: &Claim) -> String {
    let standing = claim.standing();
    let (sign, style) = match standing {
        Standing::Equal => ("✓", GOOD),
        Standing::Wrong => ("✗", BAD),
        _ => ("?", DOUBT),
    };
    let word = match standing {
        Standing::Equal if claim.is_proved() => "proved equal",
        Standing::Equal => "right in numbers",
        Standing::Wrong => "wrong",
        Standing::Conditional => "right under a condition",
        Standing::Carried => "carried from an earlier error",
        Standing::Undecided => "not decided",
        Standing::Unreadable => "cannot be read",
    };
    let line = document.line(claim.span.start);
    let about = words().about(&claim.about);
    let mut out = format!(
        "{} {} ({about}), line {line}: {}\n",
        styled(sign, style),
        styled(&claim.name, NAME),
        styled(word, style)
    );
    if let Some(instead) = claim.instead {
        out += &format!("    what is printed is {}\n", words().instead(instead));
    }
    for entry in claim.entries.iter().filter(|_| claim.instead.is_none()) {
        out += &finding(document, entry);
    }
    for remark in &claim.remarks {
        out += &format!("    {}\n", words().remarked(remark));
    }
    out + "\n"
}

fn finding(document: &Document, entry: &Entry) -> String {
    let place = entry.place.map_or(String::new(), |(r, c)| format!("row {r}, column {c}: "));
    match &entry.finding {
        Finding::Equal { unless_zero } if unless_zero.is_empty() => String::new(),
        Finding::Equal { unless_zero } => {
            let factors: Vec<String> = unless_zero.iter().map(ToString::to_string).collect();
            format!("    {place}where {} is not 0\n", factors.join(", "))
        }
        Finding::Carried { by, correct } => {
            let Some(cause) = document.checked.claims.get(*by) else { return String::new() };
            let carried = words().carried(&cause.name, document.line(cause.span.start));
            let right = words().either(correct).map(|c| format!("    right       {}\n", styled(&c, GOOD)));
            format!(
                "    {place}{}\n    {carried}\n{}",
                document.source(&entry.span),
                right.unwrap_or_default()
            )
        }
        Finding::Undecided { why } => format!("    {place}{}\n", words().unproved(*why)),
        Finding::Unreadable(findings) => findings
            .iter()
            .take(3)
            .map(|u| {
                let d = words().unread(u);
                format!("    {}", d.render(document.name, document.text).replace('\n', "\n    ").trim_end())
                    + "\n"
            })
            .collect(),
        Finding::Conditional { condition, correct, remarks } => {
            let condition = words().right_where(condition);
            let mut out = format!("    {place}{}\n    right {condition}\n", document.source(&entry.span));
            if let Some(correct) = words().either(correct) {
                out += &format!("    everywhere  {}\n", styled(&correct, GOOD));
            }
            remarks.iter().for_each(|r| out += &format!("    {}\n", words().remarked(r)));
            out
        }
        Finding::Wrong(w) => wrong(document, entry, &place, w),
    }
}

fn wrong(document: &Document, entry: &Entry, place: &str, wrong: &Wrong) -> String {
    let mut out = String::new();
    let patches: &[Patch] = wrong.slip.as_ref().map_or(&[], |s| &s.patches);
    out += &format!("    {place}{}\n", marked(document, &entry.span, patches));
    if let Some(correct) = words().either(&wrong.correct) {
        let correct = correct.split_whitespace().collect::<Vec<_>>().join(" ");
        out += &format!("    right       {}\n", styled(&correct, GOOD));
    }
    if let Some(slip) = &wrong.slip {
        let rivals: Vec<String> = wrong.rivals.iter().map(|r| rival(document, &entry.span, r)).collect();
        let or = if rivals.is_empty() { String::new() } else { format!("; or {}", rivals.join("; or ")) };
        out += &format!("    the slip    {}{or}\n", words().slip(&slip.kind));
    }
    if let Some((cause, slip)) = &wrong.under_cause {
        out += &format!(
            "    by cause {}  {}: {}\n",
            cause + 1,
            words().slip(&slip.kind),
            marked(document, &entry.span, &slip.patches)
        );
    }
    if let Some(example) = &wrong.counterexample {
        out += &format!("    {}\n", styled(&at(example), FAINT));
    }
    if let Some(parameter) = wrong.holds_if {
        out += &format!("    right only if {}\n", words().is_zero(parameter));
    }
    wrong.remarks.iter().for_each(|r| out += &format!("    {}\n", words().remarked(r)));
    out
}

fn rival(document: &Document, span: &Range<usize>, slip: &Slip) -> String {
    format!("{}: {}", words().slip(&slip.kind), marked(document, span, &slip.patches))
}

/// The values at a configuration.
pub fn at(example: &Counterexample) -> String {
    let values: Vec<String> =
        example.at.iter().map(|(name, x)| format!("{name} = {}", decimals(*x, 4))).collect();
    let place = if values.is_empty() { String::new() } else { format!("at {}: ", values.join(", ")) };
    format!("{place}printed {}, right {}", decimals(example.printed, 6), decimals(example.right, 6))
}

/// The printed formula, `[C6 → S6]` where it should read otherwise.
fn marked(document: &Document, span: &Range<usize>, patches: &[Patch]) -> String {
    let shown = pieces(document.text, span, patches).into_iter().map(|piece| match piece {
        Piece::Plain(text) => text,
        Piece::Changed { was, now } => {
            let was = if was.trim().is_empty() { "nothing".to_string() } else { was };
            let now = if now.trim().is_empty() { "nothing".to_string() } else { now };
            format!("[{} → {}]", styled(&was, BAD), styled(&now, GOOD))
        }
    });
    shown.collect()
}
