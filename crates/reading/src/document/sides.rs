//! A piece of a document as a formula parser wants it.

use super::cut;
use super::lexer::{Bracket, Kind, Token, lex};
use std::borrow::Cow;
use std::ops::Range;

/// `text[span]` with blanks in place of what is no formula (`&`, `\\[4pt]`, `\quad`, `\label{…}`, `$`, comments,
/// characters of no width): as many bytes as the span has, so that places in it are places in the text.
pub fn formula<'t>(text: &'t str, span: &Range<usize>) -> Cow<'t, str> {
    let source = cut(text, span);
    let mut out = String::new();
    let blank = |from: usize, to: usize, out: &mut String| {
        out.extend(std::iter::repeat_n(' ', to.saturating_sub(from)));
    };
    let mut at = span.start;
    let tokens = lex(text, span);
    let kind = |i: usize| tokens.get(i).map(|t| t.kind);
    // `{}` before a sign keeps its distance; before a script it bears that.
    let is_empty = |i: usize| {
        kind(i) == Some(Kind::Open(Bracket::Brace))
            && kind(i + 1) == Some(Kind::Close(Bracket::Brace))
            && kind(i + 2) != Some(Kind::Script)
    };
    for (i, token) in tokens.iter().enumerate() {
        blank(at, token.span.start, &mut out);
        match token.kind {
            _ if is_empty(i) || i > 0 && is_empty(i - 1) => blank(token.span.start, token.span.end, &mut out),
            Kind::Amp | Kind::Row | Kind::Quad => blank(token.span.start, token.span.end, &mut out),
            _ => out.push_str(cut(text, &token.span)),
        }
        at = token.span.end;
    }
    blank(at, span.start + source.len(), &mut out);
    if out == source { Cow::Borrowed(source) } else { Cow::Owned(out) }
}

/// The parts of `span` between the `=` (also `:=`, `≡`, `≈` and their commands) that stand in no bracket, trimmed.
pub fn sides(text: &str, span: &Range<usize>) -> Vec<Range<usize>> {
    let tokens = lex(text, span);
    let mut depth = 0usize;
    let mut sides = vec![];
    let mut first = 0;
    for (i, token) in tokens.iter().enumerate() {
        match token.kind {
            Kind::Open(_) | Kind::Begin(_) => depth += 1,
            Kind::Close(_) | Kind::End => depth = depth.saturating_sub(1),
            Kind::Relation(_) if depth == 0 => {
                sides.push(trimmed(text, tokens.get(first..i).unwrap_or(&[]), token.span.start));
                first = i + 1;
            }
            _ => {}
        }
    }
    sides.push(trimmed(text, tokens.get(first..).unwrap_or(&[]), span.end.max(span.start)));
    sides
}

/// The span of the tokens without what only sets or ends a formula; an empty one at `end`.
fn trimmed(text: &str, tokens: &[Token], end: usize) -> Range<usize> {
    let stop =
        |t: &&Token| matches!(t.kind, Kind::Comma | Kind::Semicolon | Kind::Amp | Kind::Row | Kind::Quad);
    let full_stop = |t: &&Token| t.kind == Kind::Operator && cut(text, &t.span) == ".";
    let first = tokens.iter().find(|t| !stop(t));
    let last = tokens.iter().rev().find(|t| !stop(t) && (!full_stop(t) || tokens.len() == 1));
    match (first, last) {
        (Some(first), Some(last)) if first.span.start <= last.span.end => first.span.start..last.span.end,
        _ => end..end,
    }
}
