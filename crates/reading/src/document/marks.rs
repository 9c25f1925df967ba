//! Comments that are meant for the checker, and what they belong to.

use super::{CodeBlock, Directive, Format, Statement, cut};
use std::ops::Range;

/// The word that such a comment begins with.
const CALL: &str = "check:";
const LONGEST: usize = 500;
const MOST: usize = 5000;

/// All directives, but those in programs.
pub(super) fn directives(
    text: &str,
    format: Format,
    fences: &[Range<usize>],
    code: &[CodeBlock],
) -> Vec<Directive> {
    let mut out = vec![];
    let mut fences = fences.iter().peekable();
    let mut code = code.iter().map(|c| &c.span).peekable();
    let mut done = 0;
    for (at, _) in text.match_indices(CALL) {
        if at < done || out.len() >= MOST {
            continue;
        }
        while fences.next_if(|f| f.end <= at).is_some() {}
        while code.next_if(|c| c.end <= at).is_some() {}
        if code.peek().is_some_and(|c| c.contains(&at)) {
            continue;
        }
        let fenced = fences.peek().is_some_and(|f| f.contains(&at));
        let rest = text.get(at + CALL.len()..).unwrap_or("");
        let Some(end) = end(before(text, at), rest, format, fenced) else { continue };
        let shown = rest.get(..end).unwrap_or("");
        let start = at + CALL.len() + (shown.len() - shown.trim_start().len());
        done = at + CALL.len() + end;
        let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
        out.push(Directive { span: start..start + shown.trim().len(), words });
    }
    out
}

/// A little of the line before `at`.
fn before(text: &str, at: usize) -> &str {
    let mut start = at.saturating_sub(80);
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    text.get(start..at).unwrap_or("").trim_end_matches([' ', '\t'])
}

/// How long the directive is, if what stands before it opens a comment.
fn end(before: &str, rest: &str, format: Format, fenced: bool) -> Option<usize> {
    if let Some(outside) = before.strip_suffix("<!--") {
        let marked = format == Format::Markdown || format == Format::Plain;
        let quoted = outside.ends_with('`');
        let window = rest.as_bytes().get(..rest.len().min(LONGEST)).unwrap_or(&[]);
        let end = window.windows(3).position(|w| w == b"-->");
        return end.filter(|_| marked && !quoted);
    }
    let hash = match format {
        Format::Markdown => fenced,
        Format::Latex => false,
        Format::Plain | Format::Toml => true,
    };
    let slashes = before.ends_with("//") && !before.ends_with("://");
    let opened = match before.chars().last() {
        Some('%') => format != Format::Toml && !before.ends_with("\\%"),
        Some('#') => hash,
        Some('/') => slashes && matches!(format, Format::Markdown | Format::Plain),
        _ => false,
    };
    if !opened {
        return None;
    }
    let line = rest.bytes().take(LONGEST).position(|b| b == b'\n').unwrap_or(rest.len().min(LONGEST));
    // `LONGEST` may lie within a character.
    rest.is_char_boundary(line).then_some(line)
}

/// Gives every directive to the statement that it stands in or behind, or else to the next statement or program;
/// what is left is behind all of them.
pub(super) fn assign(
    text: &str,
    directives: Vec<Directive>,
    statements: &mut [Statement],
    code: &mut [CodeBlock],
) -> Vec<Directive> {
    let mut rest = vec![];
    let (mut s, mut c) = (0, 0);
    for directive in directives {
        let at = directive.span.start;
        while statements.get(s).is_some_and(|x| x.span.start < at) {
            s += 1;
        }
        while code.get(c).is_some_and(|x| x.span.start < at) {
            c += 1;
        }
        if let Some(last) = s.checked_sub(1).and_then(|i| statements.get_mut(i)) {
            let inside = at < last.span.end;
            // One line is looked through once: a directive ends it.
            let gap = cut(text, &(last.span.end.min(at)..at));
            if inside || (gap.len() < 400 && !gap.contains('\n')) {
                last.directives.push(directive);
                continue;
            }
        }
        match (statements.get_mut(s), code.get_mut(c)) {
            (Some(statement), Some(block)) if block.span.start < statement.span.start => {
                block.directives.push(directive);
            }
            (Some(statement), _) => statement.directives.push(directive),
            (None, Some(block)) => block.directives.push(directive),
            (None, None) => rest.push(directive),
        }
    }
    rest
}
