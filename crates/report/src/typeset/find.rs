//! Where formulas stand in a text.

use std::ops::Range;

/// A formula in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Printed {
    /// With its dollar signs or brackets.
    pub outer: Range<usize>,
    /// Without them.
    pub inner: Range<usize>,
    /// On lines of its own.
    pub is_display: bool,
}

/// Environments whose inside is a formula.
const DISPLAYS: [&str; 9] =
    ["equation", "align", "gather", "eqnarray", "displaymath", "multline", "flalign", "alignat", "math"];

/// The formulas of a document in Markdown or LaTeX, in its order; nothing of code.
pub fn printed(text: &str) -> Vec<Printed> {
    let mut found = vec![];
    let mut at = 0;
    while let Some(step) = text[at..].find(['$', '\\', '`']) {
        let start = at + step;
        let rest = &text[start..];
        if rest.starts_with('`') {
            at = behind_code(text, start);
            continue;
        }
        let next = if rest.starts_with("$$") {
            between(text, start, "$$", "$$", true)
        } else if rest.starts_with('$') {
            in_dollars(text, start)
        } else if rest.starts_with("\\[") {
            between(text, start, "\\[", "\\]", true)
        } else if rest.starts_with("\\(") {
            between(text, start, "\\(", "\\)", false)
        } else if let Some(name) = rest.strip_prefix("\\begin{").and_then(|r| r.split('}').next()) {
            match name {
                "verbatim" | "lstlisting" | "minted" | "tikzpicture" => {
                    let end = format!("\\end{{{name}}}");
                    at = rest.find(&end).map_or(text.len(), |n| start + n + end.len());
                    continue;
                }
                _ if DISPLAYS.contains(&name.trim_end_matches('*')) => {
                    let (open, close) = (format!("\\begin{{{name}}}"), format!("\\end{{{name}}}"));
                    between(text, start, &open, &close, true)
                }
                _ => None,
            }
        } else {
            None
        };
        // A sign behind a backslash is that sign.
        let signs = rest.strip_prefix('\\').map_or(1, |r| 1 + r.chars().next().map_or(0, char::len_utf8));
        at = next.as_ref().map_or(start + signs, |p| p.outer.end);
        found.extend(next);
    }
    found
}

/// Behind code in backticks, or behind a fence; but a fence of `math` is looked into by nobody here.
fn behind_code(text: &str, start: usize) -> usize {
    let rest = &text[start..];
    let ticks = rest.len() - rest.trim_start_matches('`').len();
    let inside = &rest[ticks..];
    let end = inside.find(&"`".repeat(ticks)).map(|n| start + ticks + n + ticks);
    // A backtick that nothing closes in its paragraph is one.
    let is_open = ticks < 3 && inside.find("\n\n").is_some_and(|n| end.is_none_or(|e| e > start + ticks + n));
    match end {
        Some(end) if !is_open => end,
        _ if ticks >= 3 => text.len(),
        _ => start + ticks,
    }
}

fn between(text: &str, start: usize, open: &str, close: &str, is_display: bool) -> Option<Printed> {
    let from = start + open.len();
    let end = from + text[from..].find(close)?;
    Some(Printed { outer: start..end + close.len(), inner: from..end, is_display })
}

/// `$x$`: no blank inside of the signs, no paragraph's end and no code between them, so that prices are none.
fn in_dollars(text: &str, start: usize) -> Option<Printed> {
    let mut from = start + 1;
    loop {
        let end = from + text[from..].find('$')?;
        let inside = &text[start + 1..end];
        if inside.contains("\n\n")
            || inside.contains('`')
            || inside.starts_with(char::is_whitespace)
            || inside.is_empty()
        {
            return None;
        }
        if inside.ends_with('\\') {
            from = end + 1;
            continue;
        }
        let is_price = text[end + 1..].starts_with(|c: char| c.is_ascii_digit());
        if is_price || inside.ends_with(char::is_whitespace) {
            return None;
        }
        return Some(Printed { outer: start..end + 1, inner: start + 1..end, is_display: false });
    }
}

#[cfg(test)]
mod tests {
    use super::printed;

    #[test]
    fn formulas_are_found_and_prices_are_not() {
        let inside = |text: &str| -> Vec<String> {
            printed(text).iter().map(|p| text[p.inner.clone()].trim().to_string()).collect()
        };
        for (text, expected) in [
            ("with $a_1$ and $$b$$", vec!["a_1", "b"]),
            ("it costs $5 and $6 more", vec![]),
            ("it costs $5 and `$x$`", vec![]),
            ("`$a$` and ``` $b$ ``` and $c$", vec!["c"]),
            ("```\n$a$\n```\n\\[ d \\] \\(e\\)", vec!["d", "e"]),
            ("\\begin{align*} a &= b \\end{align*}", vec!["a &= b"]),
            ("\\begin{verbatim} $a$ \\end{verbatim} $b$", vec!["b"]),
            ("5 \\$ and $x$", vec!["x"]),
            ("a ` b $x$\n\nc", vec!["x"]),
            ("$open\n\nparagraph$", vec![]),
        ] {
            assert_eq!(inside(text), expected, "{text}");
        }
    }
}
