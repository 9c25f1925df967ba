//! Lines: their ends, labels, and whether one goes on with the one before.

use super::lexer::{Kind, lex};
use super::{cut, words};
use std::ops::Range;

/// The line that begins at `at`, without its end, and where the next one begins.
pub(super) fn line(text: &str, at: usize, limit: usize) -> (Range<usize>, usize) {
    let rest = text.get(at..limit).unwrap_or("");
    match rest.find('\n') {
        Some(length) => (at..at + length, at + length + 1),
        None => (at..limit.max(at), limit.max(at)),
    }
}

/// The first and last byte of what is not blank.
pub(super) fn trimmed(text: &str, span: &Range<usize>) -> Range<usize> {
    let shown = cut(text, span);
    let start = span.start + (shown.len() - shown.trim_start().len());
    start..start + shown.trim().len()
}

/// What begins a line of a list or of numbered equations: whether there is a bullet, the label, and where the rest
/// begins.
pub(super) struct Lead {
    pub bullet: bool,
    pub label: Option<Range<usize>>,
    pub rest: usize,
}

/// Reads `- `, `3. `, `(3) `, `t11: ` and `> ` at the start of a line.
pub(super) fn lead(text: &str, line: &Range<usize>) -> Lead {
    let mut lead = Lead { bullet: false, label: None, rest: line.start };
    loop {
        let rest = cut(text, &(lead.rest..line.end));
        let blanks = rest.len() - rest.trim_start().len();
        let rest = rest.trim_start();
        let start = lead.rest + blanks;
        lead.rest = start;
        let mut chars = rest.chars();
        let (first, second) = (chars.next(), chars.next());
        let (Some(first), Some(second)) = (first, second) else { return lead };
        if !lead.bullet && "-*+•✓–▪◦".contains(first) && second.is_whitespace() {
            lead.bullet = true;
            lead.rest = start + first.len_utf8();
            continue;
        }
        // `: x = …` is set in, as wikis do.
        if first == ':' && second == ' ' && lead.label.is_none() && !lead.bullet {
            lead.bullet = true;
            lead.rest = start + 1;
            continue;
        }
        if first == '>' && lead.label.is_none() {
            lead.rest = start + 1;
            continue;
        }
        if lead.label.is_some() {
            return lead;
        }
        let Some((label, bytes)) = number(rest).or_else(|| name(rest)) else { return lead };
        lead.label = Some(start + label.start..start + label.end);
        lead.rest = start + bytes;
    }
}

/// `3.`, `3)`, `(3)`, `(a)`, `b)` and a blank behind it.
fn number(rest: &str) -> Option<(Range<usize>, usize)> {
    // `**4)** det J = …`
    if let Some(bold) = rest.strip_prefix("**")
        && let Some(end) = bold.find("**").filter(|end| *end < 8)
    {
        let (label, bytes) = number(&format!("{} x", &bold[..end]))?;
        return (bytes == end).then_some((label.start + 2..label.end + 2, end + 4));
    }
    let open = usize::from(rest.starts_with('('));
    let inner = rest.get(open..)?;
    let digits = inner.bytes().take_while(|b| b.is_ascii_digit() || *b == b'.').count();
    let letter = usize::from(inner.starts_with(|c: char| c.is_ascii_lowercase()));
    let mut length = digits.max(letter);
    if open == 0 && inner.get(..length)?.ends_with('.') && length > 1 && digits > 0 {
        length -= 1;
    }
    let mark = inner.get(length..)?.chars().next()?;
    let marked = mark == ')' || (mark == '.' && open == 0 && digits > 0);
    let after = inner.get(length + 1..)?;
    let behind = after.trim_start().chars().next()?;
    let fits = length > 0 && length < 8 && marked && after.starts_with(char::is_whitespace);
    (fits && !"=+*/^_".contains(behind)).then_some((open..open + length, open + length + 1))
}

/// `t11:`, `**T06**:`
fn name(rest: &str) -> Option<(Range<usize>, usize)> {
    let end = rest.char_indices().take(40).find(|(_, c)| matches!(c, ':' | '\u{ff1a}'))?;
    let label = rest.get(..end.0)?;
    let after = rest.get(end.0 + end.1.len_utf8()..)?;
    let bold = usize::from(after.starts_with("**")) * 2;
    let bare = label.trim_matches(['*', '`', ' ']);
    let named = !bare.is_empty()
        && bare.starts_with(char::is_alphanumeric)
        && bare.chars().all(|c| c.is_alphanumeric() || "_{},'′()-".contains(c))
        && words::is_label(bare);
    let parted =
        after.get(bold..).is_some_and(|a| a.is_empty() || a.starts_with([' ', '\t', '$', '\r', '`']));
    let start = label.find(bare)?;
    (named && parted).then(|| (start..start + bare.len(), end.0 + end.1.len_utf8() + bold))
}

/// Whether a line goes on with the formula of the line before: it begins with a relation or an operator.
pub(super) fn goes_on(text: &str, line: &Range<usize>, bullets: bool) -> bool {
    let span = trimmed(text, line);
    let shown = cut(text, &span);
    if is_rule(shown) {
        return false;
    }
    let tokens = lex(text, &span);
    let related = tokens.iter().any(|t| matches!(t.kind, Kind::Relation(_)));
    match tokens.iter().find(|t| t.kind != Kind::Amp).map(|t| (t.kind, cut(text, &t.span))) {
        Some((Kind::Relation(_), _)) => true,
        Some((Kind::Operator, operator)) => {
            let bullet = "-+*•–·".contains(operator) && shown.chars().nth(1).is_some_and(char::is_whitespace);
            !(related || (bullet && bullets) || operator == "." || words::is_prose(text, &span))
        }
        _ => false,
    }
}

/// `----`, `====`
pub(super) fn is_rule(shown: &str) -> bool {
    shown.len() > 2 && (shown.bytes().all(|b| b == b'-') || shown.bytes().all(|b| b == b'='))
}

/// What cannot be in a formula that stands in prose without marks.
pub(super) fn is_foreign(shown: &str) -> bool {
    let tag = shown.match_indices('<').any(|(i, _)| {
        let next = shown.get(i + 1..).and_then(|r| r.chars().next());
        next.is_some_and(|c| c.is_ascii_alphabetic() || c == '/')
    });
    tag && shown.contains('>')
        || ["://", "](", "\"", "();", "->"].iter().any(|m| shown.contains(m))
        || shown.starts_with("--")
}
