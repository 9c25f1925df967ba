//! The document with its slips marked, as a page of its own. Formulas in LaTeX are typeset; one that cannot be stands as it was written.

use super::Document;
use super::marked::{Piece, pieces};
use super::terminal::at;
use crate::terminal::words;
use denavit_check::{Claim, Entry, Finding, Patch, Standing};
use denavit_reading::document::Format;
use denavit_report::render::{font, font_face};
use denavit_report::typeset::{Marks, Printed, printed, typeset};
use std::fmt::Write;
use std::ops::Range;

const STYLE: &str = "
:root { color-scheme: light dark; --good: #1a7f37; --bad: #c4262e; --doubt: #9a6700; --line: #8884; --card: #8881; }
@media (prefers-color-scheme: dark) { :root { --good: #4ac26b; --bad: #ff7b72; --doubt: #d4a72c; } }
body { max-width: 72rem; margin: 2rem auto; padding: 0 1rem; font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.5rem; margin-bottom: .2rem; }
pre { font: 13px/1.55 ui-monospace, monospace; white-space: pre-wrap; overflow-wrap: anywhere; margin: 0; }
mark { background: none; color: inherit; border-bottom: 2px solid; }
mark.equal { border-color: var(--good); }
mark.wrong { border-color: var(--bad); }
mark.other { border-color: var(--doubt); }
del { color: var(--bad); font-weight: 600; }
ins { color: var(--good); font-weight: 600; text-decoration: none; border: 1px solid; border-radius: 3px; padding: 0 .2em; }
aside { margin: .4rem 0 .8rem 1.5rem; padding: .5rem .8rem; border-left: 3px solid; background: var(--card);
  font: 14px/1.5 system-ui, sans-serif; white-space: normal; }
aside.wrong { border-color: var(--bad); }
aside.other { border-color: var(--doubt); }
aside code { font: 12.5px/1.5 ui-monospace, monospace; overflow-wrap: anywhere; }
aside p { margin: .2rem 0; }
math { font-family: \"Denavit Maths\", \"STIX Two Math\", math; font-size: 1.15em; }
.display { display: block; margin: .5rem 0; overflow-x: auto; white-space: normal; }
math .equal, math .wrong, math .other { border-bottom: 2px solid; }
math .equal { border-color: var(--good); }
math .wrong { border-color: var(--bad); }
math .other { border-color: var(--doubt); }
math .fn { padding: 0 .13em; }
math .bold { font-weight: bold; }
math .del { color: var(--bad); text-decoration: line-through; border: 1px dashed; border-radius: 3px; padding: 0 .15em; }
math .ins { color: var(--good); border: 1px solid; border-radius: 3px; padding: 0 .15em; margin-left: .15em; }
mtable.lines mtd { text-align: left; padding: .15em .1em; }
mtable.lines mtd:first-child { text-align: right; }
.faint { opacity: .7; font-size: .9em; }
ul.legend { list-style: none; padding: 0; display: flex; gap: 1.5rem; flex-wrap: wrap; }
";

/// What stands in the `style` element: the font of formulas, and looks.
pub fn style() -> String {
    font_face(&font()) + STYLE
}

/// The page.
pub fn page(document: &Document) -> String {
    let checked = document.checked;
    let tally = checked.tally();
    let name = escaped(document.name);
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{name}, checked</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n<h1>{name}</h1>\n",
        style()
    );
    let robots: Vec<String> = checked.robots.iter().take(1).map(|r| escaped(&r.name)).collect();
    let _ = writeln!(out, "<p>Held against {}: {} claims.</p>", robots.concat(), checked.claims.len());
    out += "<ul class=\"legend\">\n";
    for (count, class, word) in [
        (tally.proved, "equal", "proved equal"),
        (tally.equal - tally.proved, "equal", "right in numbers"),
        (tally.wrong, "wrong", "wrong"),
        (tally.conditional, "other", "right under a condition"),
        (tally.carried, "other", "carried from an earlier error"),
        (tally.undecided, "other", "not decided"),
        (tally.unreadable, "other", "not readable"),
        (tally.unjudged, "other", "not judged"),
    ] {
        if count > 0 {
            let _ = writeln!(out, "<li><mark class=\"{class}\">{count} {word}</mark></li>");
        }
    }
    out += "</ul>\n";
    for cause in &checked.causes {
        let _ = writeln!(
            out,
            "<aside class=\"wrong\"><p><strong>{}</strong> would turn {} formulas right and {} wrong; {} would stay \
             wrong.</p></aside>",
            escaped(&words().change(&cause.change)),
            cause.turns_right.len(),
            cause.turns_wrong.len(),
            cause.stays_wrong.len()
        );
    }
    out += &body(document);
    out + "</main>\n</body>\n</html>\n"
}

/// A part of the text and what it is.
struct Marked {
    span: Range<usize>,
    class: &'static str,
    patches: Vec<Patch>,
}

fn class(standing: Standing) -> &'static str {
    match standing {
        Standing::Equal => "equal",
        Standing::Wrong => "wrong",
        _ => "other",
    }
}

/// The text with marks, and a note below the line in which a claim ends.
pub fn body(document: &Document) -> String {
    let text = document.text;
    let mut marks: Vec<Marked> = vec![];
    let mut notes: Vec<(usize, String)> = vec![];
    for claim in &document.checked.claims {
        for entry in &claim.entries {
            let patches = match &entry.finding {
                Finding::Wrong(w) => w.slip.as_ref().map(|s| s.patches.clone()).unwrap_or_default(),
                _ => vec![],
            };
            marks.push(Marked { span: entry.span.clone(), class: class(entry.finding.standing()), patches });
        }
        if let Some(note) = note(document, claim) {
            let end = text[claim.span.end.min(text.len())..]
                .find('\n')
                .map_or(text.len(), |n| claim.span.end + n + 1);
            notes.push((end, note));
        }
    }
    for found in &document.checked.unjudged {
        let why = escaped(&words().skipped(&found.why));
        marks.push(Marked { span: found.span.clone(), class: "other", patches: vec![] });
        let end = found.span.end.min(text.len());
        let end = text[end..].find('\n').map_or(text.len(), |n| end + n + 1);
        notes.push((end, format!("<aside class=\"other\"><p>not judged: {why}</p></aside>\n")));
    }
    marks.sort_by_key(|m| (m.span.start, m.span.end));
    let formulas = typeset_formulas(document, &marks);
    // A note about a part of a formula stands below all of it.
    for note in &mut notes {
        if let Some((f, _)) =
            formulas.iter().find(|(f, _)| (f.outer.start + 1..=f.outer.end).contains(&note.0))
        {
            note.0 = text[f.outer.end..].find('\n').map_or(text.len(), |n| f.outer.end + n + 1);
        }
    }
    notes.sort_by_key(|n| n.0);
    let is_apart =
        |m: &Marked| !formulas.iter().any(|(f, _)| m.span.start < f.outer.end && f.outer.start < m.span.end);
    marks.retain(is_apart);
    let marked = marks.into_iter().map(|m| {
        let shown = changed(text, &m.span, &m.patches);
        (m.span, format!("<mark class=\"{}\">{shown}</mark>", m.class))
    });
    let mut parts: Vec<(Range<usize>, String)> =
        formulas.into_iter().map(|(f, shown)| (f.outer, shown)).chain(marked).collect();
    parts.sort_by_key(|p| (p.0.start, p.0.end));
    let mut notes = notes.into_iter().peekable();
    let mut out = String::from("<pre>");
    let mut at = 0;
    let plain = |out: &mut String,
                 to: usize,
                 at: &mut usize,
                 notes: &mut std::iter::Peekable<std::vec::IntoIter<(usize, String)>>| {
        while let Some((end, note)) = notes.next_if(|n| n.0 <= to) {
            let end = end.max(*at);
            let _ = write!(out, "{}</pre>\n{note}<pre>", escaped(text.get(*at..end).unwrap_or_default()));
            *at = end;
        }
        out.push_str(&escaped(text.get(*at..to).unwrap_or_default()));
        *at = to;
    };
    for (span, shown) in parts {
        if span.start < at || span.is_empty() {
            continue;
        }
        plain(&mut out, span.start, &mut at, &mut notes);
        out.push_str(&shown);
        at = span.end;
    }
    plain(&mut out, text.len(), &mut at, &mut notes);
    // A formula on lines of its own brings its lines with it.
    out = out
        .replace("\n<span class=\"display\">", "<span class=\"display\">")
        .replace("</math></span>\n", "</math></span>");
    out + "</pre>\n"
}

/// The formulas of the document that can be typeset, with what is marked in them.
fn typeset_formulas(document: &Document, marks: &[Marked]) -> Vec<(Printed, String)> {
    let text = document.text;
    let is_program = super::language_of(document.name).is_some();
    if is_program || !matches!(Format::of(document.name, text), Format::Markdown | Format::Latex) {
        return vec![];
    }
    let shown = |f: Printed| {
        let set = typeset_part(text, &f.inner, marks)?;
        let source = escaped(text[f.inner.clone()].trim());
        let shown = match f.is_display {
            true => {
                let look = "display=\"block\" displaystyle=\"true\"";
                format!("<span class=\"display\"><math {look} alttext=\"{source}\">{set}</math></span>")
            }
            false => format!("<math alttext=\"{source}\">{set}</math>"),
        };
        Some((f, shown))
    };
    printed(text).into_iter().filter_map(shown).collect()
}

/// A formula, or a part of one, with what is marked in it.
fn typeset_part(text: &str, span: &Range<usize>, marks: &[Marked]) -> Option<String> {
    let meets = |r: &Range<usize>| r.start < span.end && span.start < r.end && !r.is_empty();
    let clipped = |r: &Range<usize>| {
        r.start.clamp(span.start, span.end) - span.start..r.end.clamp(span.start, span.end) - span.start
    };
    let within: Vec<&Marked> = marks.iter().filter(|m| meets(&m.span)).collect();
    let mut changes: Vec<(Range<usize>, String)> = vec![];
    for patch in within.iter().flat_map(|m| &m.patches) {
        let change = (clipped(&patch.span), patch.now.clone());
        // Two claims may have a formula in common, and its slip.
        if !changes.contains(&change) {
            changes.push(change);
        }
    }
    changes.sort_by_key(|c| (c.0.start, c.0.end));
    let classes = within.iter().map(|m| (clipped(&m.span), m.class)).collect();
    typeset(text.get(span.clone())?, &Marks { classes, changes })
}

fn changed(text: &str, span: &Range<usize>, patches: &[Patch]) -> String {
    if patches.is_empty() {
        return escaped(text.get(span.clone()).unwrap_or_default());
    }
    let shown = pieces(text, span, patches).into_iter().map(|piece| match piece {
        Piece::Plain(text) => escaped(&text),
        Piece::Changed { was, now } => {
            let tag = |name: &str, text: &str| match text.trim() {
                "" => String::new(),
                _ => format!("<{name}>{}</{name}>", escaped(text)),
            };
            tag("del", &was) + &tag("ins", &now)
        }
    });
    shown.collect()
}

/// What is said below a claim that is not simply right.
fn note(document: &Document, claim: &Claim) -> Option<String> {
    let standing = claim.standing();
    if standing == Standing::Equal && claim.remarks.is_empty() {
        return None;
    }
    let mut out = format!("<aside class=\"{}\">", class(standing));
    if let Some(instead) = claim.instead {
        let _ = write!(
            out,
            "<p><strong>{}</strong>: what is printed is {}</p>",
            prose(&claim.name),
            escaped(&words().instead(instead))
        );
    }
    let is_told = |e: &&Entry| e.finding.standing() != Standing::Equal && claim.instead.is_none();
    for entry in claim.entries.iter().filter(is_told) {
        let name = prose(&words().entry(&claim.name, entry.place));
        let _ = write!(out, "<p><strong>{name}</strong>: {}</p>", finding(document, entry));
    }
    claim.remarks.iter().for_each(|r| {
        let _ = write!(out, "<p>{}</p>", escaped(&words().remarked(r)));
    });
    Some(out + "</aside>\n")
}

fn finding(document: &Document, entry: &Entry) -> String {
    let code = |text: &str| format!("<code>{}</code>", escaped(text));
    match &entry.finding {
        Finding::Equal { .. } => "right".into(),
        Finding::Carried { by, correct } => {
            let cause = document.checked.claims.get(*by);
            let said = cause.map(|c| words().carried(&c.name, document.line(c.span.start)));
            let right = words().either(correct).map_or(String::new(), |c| format!("; right is {}", code(&c)));
            escaped(&said.unwrap_or_default()) + &right
        }
        Finding::Undecided { why } => escaped(&words().unproved(*why)),
        Finding::Unreadable(errors) => {
            let first = errors.first();
            format!(
                "cannot be read: {}",
                first.map_or(String::new(), |e| escaped(&words().unreadable(&e.why)))
            )
        }
        Finding::Conditional { condition, correct, remarks } => {
            let everywhere =
                words().either(correct).map_or(String::new(), |c| format!("; everywhere {}", code(&c)));
            let remarks: String =
                remarks.iter().map(|r| format!("; {}", escaped(&words().remarked(r)))).collect();
            format!("right {}{everywhere}{remarks}", escaped(&words().right_where(condition)))
        }
        Finding::Wrong(wrong) => {
            let patches = wrong.slip.as_ref().map_or(&[][..], |s| &s.patches);
            let mut out = match &wrong.slip {
                Some(slip) => {
                    let kind = escaped(&words().slip(&slip.kind));
                    format!("{kind}: {}", mended(document, &entry.span, patches))
                }
                None => "wrong".into(),
            };
            if let (None, Some(correct)) = (&wrong.slip, words().either(&wrong.correct)) {
                let _ = write!(out, "; right is {}", code(&correct));
            }
            if let Some((cause, slip)) = &wrong.under_cause {
                let _ = write!(out, "; by cause {}: {}", cause + 1, escaped(&words().slip(&slip.kind)));
            }
            if let Some(example) = &wrong.counterexample {
                let _ = write!(out, "<br><span class=\"faint\">{}</span>", escaped(&at(example)));
            }
            for remark in &wrong.remarks {
                let _ = write!(out, "<br>{}", escaped(&words().remarked(remark)));
            }
            out
        }
    }
}

/// A part of the document with its slip, typeset where it stands in a formula of LaTeX.
fn mended(document: &Document, span: &Range<usize>, patches: &[Patch]) -> String {
    let marked = Marked { span: span.clone(), class: "plain", patches: patches.to_vec() };
    let is_tex = document.text.get(span.clone()).is_some_and(|t| t.contains(['\\', '_', '^']))
        && Format::of(document.name, document.text) != Format::Plain
        && super::language_of(document.name).is_none();
    let set = if is_tex { typeset_part(document.text, span, &[marked]) } else { None };
    match set {
        Some(set) => format!("<math>{set}</math>"),
        None => format!("<code>{}</code>", changed(document.text, span, patches)),
    }
}

/// Words with names of LaTeX in them, which are typeset.
pub fn prose(text: &str) -> String {
    let word = |word: &str| {
        let bare = word.trim_end_matches([',', ';', ':', '.', ')']);
        let has_index = bare.chars().nth(1).is_some_and(|c| matches!(c, '_' | '^'));
        let is_name = bare.contains(['\\', '{']) || has_index;
        let set = if is_name { typeset(bare, &Marks::default()) } else { None };
        match set {
            Some(set) => format!("<math>{set}</math>{}", escaped(&word[bare.len()..])),
            None => escaped(word),
        }
    };
    text.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}
