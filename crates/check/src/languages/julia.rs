//! Julia as MATLAB.

use super::{Brackets, Respelled, outside, word_before};

/// A program of Julia as one of MATLAB; nothing for other texts.
pub(crate) fn as_matlab(text: &str) -> Option<String> {
    let is_line = |l: &str| {
        let l = l.trim_start();
        l.starts_with("using ") || l.starts_with("const ") || l.starts_with("# ") || l.starts_with("import ")
    };
    let ends = text.lines().any(|l| l.trim() == "end");
    // Neither the marks of MATLAB's comments nor names of outputs before a function.
    let is_other = text.lines().any(|l| {
        let l = l.trim_start();
        let has_output = l.strip_prefix("function ").is_some_and(|r| r.contains('='));
        l.starts_with('%') || has_output && !l.contains("where")
    });
    if is_other || !(ends && text.contains("function ") || text.lines().any(is_line)) {
        return None;
    }
    let mut out = Respelled::new(text);
    remarks(&mut out);
    words(&mut out);
    indices(&mut out);
    short_functions(&mut out);
    several_names(&mut out);
    arctangents(&mut out);
    out.finished()
}

/// `# …` as `% …`; words between quotes that describe a function, and lines that load packages, as remarks.
fn remarks(out: &mut Respelled<'_>) {
    let text = out.text;
    let mut is_quoted = false;
    for line in crate::lines::lines(text) {
        let source = &text[line.clone()];
        let bare = source.trim_start();
        let start = line.start + (source.len() - bare.len());
        let shown = bare.trim_end();
        let marks = source.matches("\"\"\"").count();
        let is_words = shown.len() > 1 && shown.starts_with('"') && shown.ends_with('"');
        let is_package = ["using ", "import ", "export ", "include("].iter().any(|w| bare.starts_with(w));
        if !shown.is_empty() && (is_quoted || marks > 0 || is_words || is_package) {
            out.write(start, start + shown.chars().next().map_or(0, char::len_utf8), "%");
        } else if let Some(at) =
            source.find('#').filter(|at| source[..*at].matches('"').count().is_multiple_of(2))
        {
            out.write(line.start + at, line.start + at + 1, "%");
        }
        is_quoted ^= marks % 2 == 1;
    }
}

/// `const` says nothing here.
fn words(out: &mut Respelled<'_>) {
    let text = out.text;
    for (at, word) in text.match_indices("const ") {
        if text[..at].is_empty() || text[..at].ends_with(['\n', ' ', ';']) {
            out.blank(at, at + word.len());
        }
    }
}

/// `w[1]` as `w(1)`.
fn indices(out: &mut Respelled<'_>) {
    let text = out.now();
    let brackets = Brackets::of(&text);
    for (open, _) in text.match_indices('[') {
        let is_behind = text[..open].ends_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | ')'));
        if let Some(close) = brackets.closing(open).filter(|_| is_behind) {
            out.write(open, open + 1, "(");
            out.write(close, close + 1, ")");
        }
    }
}

/// `f(x) = formula` as `f=@(x) formula`.
fn short_functions(out: &mut Respelled<'_>) {
    let text = out.now();
    let brackets = Brackets::of(&text);
    for line in crate::lines::lines(&text) {
        let source = &text[line.clone()];
        let Some(open) = source.find('(').map(|i| line.start + i) else { continue };
        let (start, name) = word_before(&text, open);
        let is_first = text[line.start..start].trim().is_empty() && !name.is_empty();
        let Some(close) = brackets.closing(open).filter(|c| is_first && *c < line.end) else { continue };
        let inner = &text[open + 1..close];
        let is_names = inner.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | ',' | ' '))
            && !inner.trim().starts_with(|c: char| c.is_ascii_digit());
        let Some(rest) = text[close + 1..line.end].trim_start().strip_prefix('=').filter(|_| is_names) else {
            continue;
        };
        if !rest.starts_with('=') {
            out.write(start, line.end - rest.len(), &format!("{name}=@({inner})"));
        }
    }
}

/// `a, b = f(x)` as `[a,b]=f(x)`.
fn several_names(out: &mut Respelled<'_>) {
    let text = out.now();
    for line in crate::lines::lines(&text) {
        let end = line.start + text[line.clone()].find('%').unwrap_or(line.len());
        let mut parts = outside(&text, line.start, end, ';');
        parts.push(end);
        let mut start = line.start;
        for stop in parts {
            let part = &text[start..stop];
            let equals = outside(&text, start, stop, '=').first().copied();
            let is_left = |left: &str| {
                left.contains(',')
                    && left.split(',').all(|n| {
                        let n = n.trim();
                        n.starts_with(char::is_alphabetic)
                            && n.chars().all(|c| c.is_alphanumeric() || c == '_')
                    })
            };
            if let Some(equals) =
                equals.filter(|e| is_left(&text[start..*e]) && !text[e + 1..].starts_with('='))
            {
                let from = start + (part.len() - part.trim_start().len());
                let names: Vec<&str> = text[from..equals].split(',').map(str::trim).collect();
                out.write(from, equals + 1, &format!("[{}]=", names.join(",")));
            }
            start = stop + 1;
        }
    }
}

/// `atan(y, x)` as `atan2(y,x)`, where a blank makes room.
fn arctangents(out: &mut Respelled<'_>) {
    let text = out.now();
    let brackets = Brackets::of(&text);
    for (at, word) in text.match_indices("atan(") {
        let open = at + word.len() - 1;
        let is_word = !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let Some(close) = brackets.near(open).filter(|_| is_word) else { continue };
        let commas = outside(&text, open + 1, close, ',');
        if let [comma] = commas[..] {
            let (y, x) = (text[open + 1..comma].trim(), text[comma + 1..close].trim());
            out.write(at, close, &format!("atan2({y},{x}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::as_matlab;

    #[test]
    fn julia_as_matlab() {
        let text = "# an arm\nconst d1 = 0.4; const d2 = 0.1\n\"Words.\"\nfunction f(w)\n    s1, c1 = sincos(w[1])\n    \
                    return atan(w[2], s1)\nend\ng(q1, q2) = sin(q2)\n";
        let now = as_matlab(text).unwrap_or_default();
        assert_eq!(now.len(), text.len());
        let plain: Vec<String> =
            now.lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        let wanted = [
            "% an arm",
            "d1 = 0.4; d2 = 0.1",
            "%Words.\"",
            "function f(w)",
            "[s1,c1]= sincos(w(1))",
            "return atan2(w(2),s1)",
            "end",
            "g=@(q1, q2) sin(q2)",
        ];
        assert_eq!(plain, wanted);
    }
}
