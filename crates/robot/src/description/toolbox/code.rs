//! Programs as far as constructors of links need them: comments, definitions, calls and their arguments, rows of numbers.

use std::ops::Range;

/// How deep calls are looked for in calls, and how many.
const MAX_NESTED: usize = 4;
const MAX_CALLS: usize = 1000;

/// Whose language a program is in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Language {
    /// MATLAB or Octave.
    Matlab,
    /// Python.
    Python,
}

/// A call of a function, and what it is assigned to.
#[derive(Clone, Debug)]
pub(super) struct Call {
    pub name: String,
    /// The left side of its statement, without blanks: `L(1)`, `links`.
    pub target: String,
    pub span: Range<usize>,
    pub arguments: Vec<Argument>,
}

/// An argument of a call.
#[derive(Clone, Debug)]
pub(super) struct Argument {
    /// `d=…`, or `'d', …`
    pub key: Option<String>,
    pub value: Range<usize>,
}

/// What a name is said to be.
#[derive(Clone, Debug)]
pub(super) struct Definition {
    pub name: String,
    pub value: Range<usize>,
}

/// The text with blanks where comments and Python's long texts stand; places stay where they are.
pub(super) fn without_comments(text: &str, language: Language) -> String {
    let bytes = text.as_bytes();
    let mut plain = bytes.to_vec();
    let mut at = 0;
    let mut before = b' ';
    while at < bytes.len() {
        let rest = &bytes[at..];
        let is_comment = match language {
            Language::Python => rest[0] == b'#',
            Language::Matlab => rest[0] == b'%' || rest[0] == b'#' || rest.starts_with(b"..."),
        };
        let long = [&b"\"\"\""[..], b"'''"]
            .into_iter()
            .find(|q| language == Language::Python && rest.starts_with(q));
        // A quote behind a value is MATLAB's transpose.
        let is_transposed = language == Language::Matlab
            && rest[0] == b'\''
            && (before.is_ascii_alphanumeric() || matches!(before, b')' | b']' | b'}' | b'\'' | b'_' | b'.'));
        if is_comment {
            // `...` goes on on the next line.
            let goes_on = rest.starts_with(b"...");
            let end = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
            plain[at..at + end].fill(b' ');
            at += end;
            if goes_on && at < bytes.len() {
                plain[at] = b' ';
            }
        } else if let Some(quote) = long {
            let end = rest[3..].windows(3).position(|w| w == quote).map_or(rest.len(), |e| e + 6);
            plain[at..at + end].iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
            at += end;
        } else if matches!(rest[0], b'\'' | b'"') && !is_transposed {
            let end =
                rest[1..].iter().position(|&b| b == rest[0] || b == b'\n').map_or(rest.len(), |e| e + 2);
            at += end;
            before = b'"';
            continue;
        } else {
            at += 1;
            if !matches!(rest[0], b' ' | b'\t') {
                before = rest[0];
            }
        }
    }
    String::from_utf8_lossy(&plain).into_owned()
}

/// Goes through a part of a program, with how deep each letter stands in brackets; letters of texts in quotes are left out.
fn letters(text: &str, span: Range<usize>) -> impl Iterator<Item = (usize, char, usize)> {
    let (mut depth, mut quote) = (0_usize, None);
    let mut before = ' ';
    text[span.clone()].char_indices().filter_map(move |(i, c)| {
        let at = span.start + i;
        let is_transposed = c == '\'' && (before.is_alphanumeric() || matches!(before, ')' | ']'));
        before = c;
        match (quote, c) {
            (Some(q), c) if q == c || c == '\n' => quote = None,
            (Some(_), _) => {}
            (None, '\'' | '"') if !is_transposed => quote = Some(c),
            (None, '(' | '[' | '{') => {
                depth += 1;
                return Some((at, c, depth));
            }
            (None, ')' | ']' | '}') => {
                let inside = depth;
                depth = depth.saturating_sub(1);
                return Some((at, c, inside));
            }
            (None, _) => return Some((at, c, depth)),
        }
        None
    })
}

/// The statements of a program: between ends of lines and semicolons that stand in no bracket.
pub(super) fn statements(text: &str) -> Vec<Range<usize>> {
    let mut found = vec![];
    let mut start = 0;
    for (at, c, depth) in letters(text, 0..text.len()) {
        if depth == 0 && matches!(c, '\n' | ';') {
            found.push(start..at);
            start = at + 1;
        }
    }
    found.push(start..text.len());
    found.retain(|r| !text[r.clone()].trim().is_empty());
    found
}

/// The left side of a statement, and where what it is said to be begins.
fn assigned(text: &str, statement: &Range<usize>) -> Option<(String, usize)> {
    let mut all = letters(text, statement.clone()).filter(|l| l.2 == 0).peekable();
    while let Some((at, c, _)) = all.next() {
        match c {
            '=' if all.peek().is_none_or(|n| n.1 != '=' || n.0 != at + 1) => {
                let left: String = text[statement.start..at].split_whitespace().collect();
                return (!left.is_empty()).then_some((left, at + 1));
            }
            '=' | '<' | '>' | '!' | '~' => return None,
            _ => {}
        }
    }
    None
}

/// What names are said to be, in the order of the program.
pub(super) fn definitions(text: &str, statements: &[Range<usize>]) -> Vec<Definition> {
    let one = |statement: &Range<usize>| {
        let (name, value) = assigned(text, statement)?;
        let is_name = name.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        is_name.then_some(Definition { name, value: trimmed(text, value..statement.end) })
    };
    statements.iter().filter_map(one).collect()
}

/// The span without blanks around it.
pub(super) fn trimmed(text: &str, span: Range<usize>) -> Range<usize> {
    let part = &text[span.clone()];
    let start = span.start + (part.len() - part.trim_start().len());
    start..start.max(span.start + part.trim_end().len())
}

/// The calls of these functions, in the order of the program.
pub(super) fn calls(text: &str, statements: &[Range<usize>], names: &[&str]) -> Vec<Call> {
    let mut found = vec![];
    for statement in statements {
        let target = assigned(text, statement).map_or(String::new(), |a| a.0);
        let mut word = statement.start;
        // Where calls under way began, by how deep their brackets are.
        let mut open: Vec<(usize, usize, String)> = vec![];
        for (at, c, depth) in letters(text, statement.clone()) {
            if c == '(' {
                let name = &text[word..at];
                // What is nested deeper makes no link.
                if names.contains(&name) && open.len() < MAX_NESTED && found.len() < MAX_CALLS {
                    open.push((depth, word, name.to_string()));
                }
            } else if c == ')' && open.last().is_some_and(|o| o.0 == depth) {
                let Some((_, start, name)) = open.pop() else { continue };
                let inside = start + name.len() + 1..at;
                let (target, span) = (target.clone(), start..at + 1);
                found.push(Call { name, target, span, arguments: arguments(text, inside) });
            }
            if !(c.is_alphanumeric() || c == '_') {
                word = at + c.len_utf8();
            }
        }
    }
    found.sort_by_key(|c| c.span.start);
    found
}

/// The parts of a span between commas that stand in no bracket.
fn parts(text: &str, span: Range<usize>, is_cut: impl Fn(char) -> bool) -> Vec<Range<usize>> {
    let mut found = vec![];
    let mut start = span.start;
    for (at, c, depth) in letters(text, span.clone()) {
        if depth == 0 && is_cut(c) {
            found.push(trimmed(text, start..at));
            start = at + c.len_utf8();
        }
    }
    found.push(trimmed(text, start..span.end));
    found.retain(|r| !r.is_empty());
    found
}

fn arguments(text: &str, inside: Range<usize>) -> Vec<Argument> {
    let mut found: Vec<Argument> = vec![];
    let mut waiting: Option<String> = None;
    for value in parts(text, inside, |c| c == ',') {
        if let Some(key) = waiting.take() {
            found.push(Argument { key: Some(key), value });
            continue;
        }
        if let Some((key, start)) = assigned(text, &value) {
            found.push(Argument { key: Some(key), value: trimmed(text, start..value.end) });
            continue;
        }
        match quoted(&text[value.clone()]) {
            // Words that stand alone.
            Some(
                "standard" | "modified" | "std" | "mod" | "revolute" | "prismatic" | "fixed" | "dh" | "mdh"
                | "sym",
            )
            | None => {
                found.push(Argument { key: None, value });
            }
            Some(key) => waiting = Some(key.to_string()),
        }
    }
    found
}

/// The text between quotes.
pub(super) fn quoted(text: &str) -> Option<&str> {
    let inner = |q: char| text.strip_prefix(q)?.strip_suffix(q);
    inner('\'').or_else(|| inner('"'))
}

/// The rows of `[1 2; 3 4]` or `[[1, 2], [3, 4]]`, each with its entries; `np.array(…)` is what it holds.
pub(super) fn matrix(text: &str, span: Range<usize>) -> Option<Vec<Vec<Range<usize>>>> {
    let span = trimmed(text, span);
    let part = &text[span.clone()];
    if let Some(open) =
        part.find('(').filter(|&o| part[..o].chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '.')))
        && part.ends_with(')')
        && !part.starts_with('[')
    {
        return matrix(text, span.start + open + 1..span.end - 1);
    }
    if !(part.starts_with('[') && part.ends_with(']')) || part.len() < 2 {
        return None;
    }
    let inside = span.start + 1..span.end - 1;
    let first = text[inside.clone()].trim_start();
    if first.starts_with('[') {
        let rows = parts(text, inside, |c| c == ',');
        return rows.into_iter().map(|row| matrix(text, row)?.into_iter().next()).collect();
    }
    let has_cuts = letters(text, inside.clone()).any(|(_, c, depth)| depth == 0 && matches!(c, ';' | '\n'));
    let rows =
        if has_cuts { parts(text, inside, |c| matches!(c, ';' | '\n')) } else { vec![trimmed(text, inside)] };
    Some(rows.into_iter().map(|row| entries(text, row)).collect())
}

/// The entries of a row: between commas, or else between blanks, where no sign stands between blanks.
fn entries(text: &str, row: Range<usize>) -> Vec<Range<usize>> {
    if letters(text, row.clone()).any(|(_, c, depth)| depth == 0 && c == ',') {
        return parts(text, row, |c| c == ',');
    }
    let words = parts(text, row, char::is_whitespace);
    let is_sign = |t: &str| matches!(t, "+" | "-" | "*" | "/" | ".*" | "./");
    let mut found: Vec<Range<usize>> = vec![];
    for word in words {
        let shown = &text[word.clone()];
        let joins = found.last().is_some_and(|last| {
            let before = &text[last.clone()];
            before.ends_with(['+', '-', '*', '/']) || shown.starts_with(['*', '/']) || is_sign(shown)
        });
        match found.last_mut() {
            Some(last) if joins => last.end = word.end,
            _ => found.push(word),
        }
    }
    found
}
