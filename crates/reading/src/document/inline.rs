//! Formulas between marks in a line: `$…$`, `$$…$$`, `\[…\]`, environments, backquotes.

use super::lexer::DISPLAYS;
use super::lines::{is_foreign, line};
use super::scan::Scanner;
use super::statements::Manner;
use super::{MAX_FORMULA, Place, cut, words};

/// The longest formula between single `$` or backquotes.
const LONGEST_INLINE: usize = 20_000;
const LONGEST_VERBATIM: usize = 1000;

impl Scanner<'_, '_> {
    /// The next mark of a formula or comment on a line.
    pub(super) fn mark(&self, from: usize, end: usize) -> Option<usize> {
        let bytes = self.text().as_bytes();
        let mut at = from;
        while at < end {
            match bytes.get(at)? {
                b'$' if self.style.dollars || bytes.get(at + 1) == Some(&b'$') => return Some(at),
                b'`' if self.style.marks => return Some(at),
                b'<' if bytes.get(at..at + 4) == Some(b"<!--") => return Some(at),
                b'%' if self.style.latex => return Some(at),
                b'\\' => {
                    if matches!(bytes.get(at + 1), Some(b'[' | b'('))
                        || self.display(at).is_some()
                        || (self.style.latex && bytes.get(at..at + 5) == Some(b"\\verb"))
                    {
                        return Some(at);
                    }
                    at += 1;
                }
                _ => {}
            }
            at += 1;
        }
        None
    }

    /// The display environment that begins here, and its name without a star.
    fn display(&self, at: usize) -> Option<&'static str> {
        let rest = self.text().get(at..)?.strip_prefix("\\begin{")?;
        let inner = ["aligned", "alignedat", "split", "gathered"];
        DISPLAYS
            .into_iter()
            .filter(|d| !inner.contains(d))
            .find(|d| rest.strip_prefix(*d).is_some_and(|r| r.starts_with('}') || r.starts_with("*}")))
    }

    /// Reads what begins at a mark: where it ends, and whether it was a formula's mark.
    pub(super) fn marked(&mut self, at: usize, limit: usize) -> (usize, bool) {
        let text = self.text();
        let rest = text.get(at..limit).unwrap_or("");
        let display = self.manner(Place::Display);
        let inline = self.manner(Place::Inline);
        if rest.starts_with("<!--") {
            return (self.next("-->", at, limit).map_or(at + 4, |end| end.end), false);
        }
        if rest.starts_with('%') {
            return (line(text, at, limit).0.end, false);
        }
        if let Some(verb) = rest.strip_prefix("\\verb") {
            let mark = verb.bytes().next().filter(u8::is_ascii_punctuation);
            let inner = mark.and_then(|m| verb.bytes().skip(1).take(LONGEST_VERBATIM).position(|b| b == m));
            return (inner.map_or(at + 5, |length| at + 5 + length + 2), false);
        }
        if rest.starts_with('`') {
            return self.quoted(at, limit);
        }
        if rest.starts_with("$$") {
            let close =
                rest.get(2..).and_then(|r| r.find("$$")).filter(|&i| i < MAX_FORMULA && whole(rest, 2 + i));
            let Some(length) = close else {
                self.reader.note(at..at + 2, "`$$` is not closed", "close the formula with `$$`");
                return (at + 2, false);
            };
            self.reader.region(at + 2..at + 2 + length, display);
            return (at + length + 4, true);
        }
        if rest.starts_with("\\[") || rest.starts_with("\\(") {
            let (close, manner) = if rest.starts_with("\\[") { ("\\]", display) } else { ("\\)", inline) };
            return match closing(rest, close) {
                Some(length) => {
                    self.reader.region(at + 2..at + length, manner);
                    (at + length + 2, true)
                }
                None => (at + 2, false),
            };
        }
        if let Some(name) = self.display(at) {
            let starred = rest.get(7 + name.len()..).is_some_and(|r| r.starts_with('*'));
            let full = if starred { format!("{name}*") } else { name.to_string() };
            let end = self.end_of(&full, at, limit);
            let Some(end) = end else {
                let span = at..at + 7 + name.len();
                self.reader.note(
                    span.clone(),
                    format!("`\\begin{{{name}}}` has no end"),
                    "close the environment",
                );
                return (span.end, false);
            };
            self.reader.region(at..end.end, display);
            return (end.end, true);
        }
        self.dollar(at, rest, inline)
    }

    /// `$…$`
    fn dollar(&mut self, at: usize, rest: &str, manner: Manner) -> (usize, bool) {
        let bytes = rest.as_bytes();
        let mut i = 1;
        let mut related = false;
        while let Some(&byte) = bytes.get(i) {
            match byte {
                b'\\' => i += 1,
                b'=' => related = true,
                b'$' if bytes.get(i + 1) == Some(&b'$') => break,
                b'$' => {
                    if let Some(bytes) = continuation(rest.get(i + 1..).unwrap_or("")) {
                        i += bytes + 1;
                        continue;
                    }
                    // `it costs $5, and x = 3 of $`
                    let content = at + 1..at + i;
                    let inner = cut(self.text(), &content);
                    let uneven =
                        inner.starts_with(char::is_whitespace) != inner.ends_with(char::is_whitespace);
                    if uneven && !inner.contains('\\') && words::is_prose(self.text(), &content) {
                        break;
                    }
                    self.reader.region(at + 1..at + i, manner);
                    return (at + i + 1, true);
                }
                b'\n' if blank_line(rest, i + 1) => break,
                _ if i > LONGEST_INLINE => break,
                _ => {}
            }
            i += 1;
        }
        if related {
            let hint = "close the formula with `$`, or write `\\$` for the sign";
            self.reader.note(at..at + 1, "`$` is not closed in its paragraph", hint);
        }
        (at + 1, false)
    }

    /// Code between backquotes.
    fn quoted(&mut self, at: usize, limit: usize) -> (usize, bool) {
        let text = self.text();
        let rest = text.get(at..limit).unwrap_or("");
        let run = rest.bytes().take_while(|&b| b == b'`').count();
        let known = self.quotes.get(run).copied();
        if known.is_none_or(|k| at < k) {
            return (at + run, false);
        }
        let bytes = rest.as_bytes();
        let mut i = run;
        while let Some(&byte) = bytes.get(i) {
            match byte {
                b'`' => {
                    let here = bytes.iter().skip(i).take_while(|&&b| b == b'`').count();
                    if here == run {
                        let manner = self.manner(Place::Code);
                        let content = at + run..at + i;
                        if !is_foreign(cut(text, &content)) {
                            self.reader.region(content, Manner { sums: true, ..manner });
                        }
                        return (at + i + run, true);
                    }
                    i += here;
                    continue;
                }
                b'\n' if blank_line(rest, i + 1) => break,
                _ if i > LONGEST_INLINE => break,
                _ => {}
            }
            i += 1;
        }
        if let Some(known) = self.quotes.get_mut(run) {
            *known = at + i;
        }
        (at + run, false)
    }
}

/// The bytes up to the formula that goes on behind a `$`: ` ${}+ b$`, where the line may be broken.
fn continuation(rest: &str) -> Option<usize> {
    let behind = rest.trim_start_matches([' ', '\n']);
    let blanks = rest.len() - behind.len();
    (blanks <= 2 && behind.starts_with("${}")).then_some(blanks + 1)
}

/// Whether a display goes on from the start of `rest` to byte `end`: no heading or fence is in it.
fn whole(rest: &str, end: usize) -> bool {
    let inner = rest.get(..end).unwrap_or("");
    !["\n```", "\n~~~", "\n# ", "\n## ", "\n### "].iter().any(|m| inner.contains(m))
}

/// Where `\]` or `\)` stands, before the next opening and the end of the paragraph.
fn closing(rest: &str, close: &str) -> Option<usize> {
    let bytes = rest.as_bytes();
    let inline = close == "\\)";
    let mut i = 2;
    while i < bytes.len().min(MAX_FORMULA) {
        match bytes.get(i)? {
            b'\\' => {
                let pair = bytes.get(i..i + 2)?;
                if pair == close.as_bytes() {
                    return Some(i);
                }
                if pair == b"\\[" || pair == b"\\(" {
                    return None;
                }
                i += 1;
            }
            b'\n' if blank_line(rest, i + 1) && inline => return None,
            b'\n' if rest.get(i..).is_some_and(|r| r.starts_with("\n```") || r.starts_with("\n# ")) => {
                return None;
            }
            _ => {}
        }
        i += 1;
    }
    None
}

/// Whether the line that begins at byte `at` is blank.
fn blank_line(text: &str, at: usize) -> bool {
    let rest = text.as_bytes().get(at..).unwrap_or(&[]);
    let blanks = rest.iter().take(200).take_while(|b| matches!(b, b' ' | b'\t' | b'\r')).count();
    rest.get(blanks).is_none_or(|&b| b == b'\n')
}
