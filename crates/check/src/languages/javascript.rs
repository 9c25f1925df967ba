//! JavaScript and TypeScript as C.

use super::{Brackets, LONGEST, Respelled, outside, word_before};

/// A program of JavaScript as one of C; nothing for other texts.
pub(crate) fn as_c(text: &str) -> Option<String> {
    const WORDS: [&str; 6] = ["=>", "function ", "export ", "module.exports", "\nlet ", "Math."];
    if !WORDS.iter().any(|w| text.contains(w)) || text.contains("#include") {
        return None;
    }
    let mut out = Respelled::new(text);
    without_words(&mut out);
    without_types(&mut out);
    objects_taken_apart(&mut out);
    arrows(&mut out);
    objects_given_back(&mut out);
    out.finished()
}

/// `export`, `async`, and what takes functions out of `Math`.
fn without_words(out: &mut Respelled<'_>) {
    let text = out.text;
    for word in ["export default ", "export ", "async "] {
        for (at, _) in text.match_indices(word) {
            if text[..at].is_empty() || text[..at].ends_with(['\n', ' ', ';', '}']) {
                out.blank(at, at + word.len());
            }
        }
    }
    for (at, mark) in text.match_indices("===").chain(text.match_indices("!==")) {
        out.write(at, at + mark.len(), &mark[..2]);
    }
    let brackets = Brackets::of(text);
    for (at, _) in text.match_indices('{') {
        let before = text[..at].trim_end();
        let (start, word) = word_before(text, before.len());
        let Some(close) = brackets.closing(at).filter(|_| matches!(word, "const" | "let" | "var")) else {
            continue;
        };
        // `const { sin, cos } = Math;`
        let rest = text[close + 1..].trim_start();
        if let Some(value) = rest.strip_prefix('=') {
            let is_library = ["Math", "require", "math"].iter().any(|m| value.trim_start().starts_with(m));
            let end = text[close..].find([';', '\n']).map_or(text.len(), |i| close + i + 1);
            if is_library {
                out.blank(start, end);
            }
        }
    }
}

/// `x: number` without the type.
fn without_types(out: &mut Respelled<'_>) {
    let text = out.text;
    for word in [": number[][]", ": number[]", ": number", ": boolean", ": void"] {
        for (at, _) in text.match_indices(word) {
            let goes_on = text[at + word.len()..].starts_with(|c: char| c.is_alphanumeric());
            if !goes_on {
                out.blank(at, at + word.len());
            }
        }
    }
}

/// Parameters that are taken out of objects stand by themselves: `f(q1, { L1, L2 })`.
fn objects_taken_apart(out: &mut Respelled<'_>) {
    let text = out.text;
    let brackets = Brackets::of(text);
    for (open, _) in text.match_indices('(') {
        let Some(close) = brackets.near(open) else { continue };
        let rest = text[close + 1..].trim_start();
        let is_head = rest.starts_with('{') || rest.starts_with("=>");
        let (start, _) = word_before(text, open);
        let before = text[..start].trim_end();
        let is_function = before.ends_with("function") || rest.starts_with("=>");
        if is_head && is_function {
            for (at, _) in text[open..close].match_indices(['{', '}']) {
                out.blank(open + at, open + at + 1);
            }
        }
    }
}

/// `const f = (a, b) => formula;` as `T f(a,b) {return formula}`.
fn arrows(out: &mut Respelled<'_>) {
    let text = out.now();
    for (arrow, _) in text.match_indices("=>") {
        let before = text[..arrow].trim_end();
        let Some(inside) = before.strip_suffix(')') else { continue };
        let Some(open) = inside.rfind('(') else { continue };
        let Some(head) = text[..open].trim_end().strip_suffix('=') else { continue };
        let (start, name) = word_before(&text, head.trim_end().len());
        let word = text[..start].trim_end();
        let (from, kind) = word_before(&text, word.len());
        if name.is_empty() || !matches!(kind, "const" | "let" | "var") {
            continue;
        }
        let parameters: String = inside[open + 1..].chars().filter(|c| !c.is_whitespace()).collect();
        let parameters = parameters.trim_end_matches(',');
        let begin = text[..from].rfind('\n').map_or(0, |i| i + 1);
        let from = if text[begin..from].trim().is_empty() { begin } else { from };
        let formula = arrow + 2 + (text[arrow + 2..].len() - text[arrow + 2..].trim_start().len());
        let is_block = text[formula..].starts_with('{');
        if is_block {
            out.write(from, arrow + 2, &format!("T {name}({parameters})"));
            continue;
        }
        let is_object = text[formula..].starts_with("({");
        let far = (formula..=text.len().min(formula + LONGEST)).rev().find(|&k| text.is_char_boundary(k));
        let ends = outside(&text, formula, far.unwrap_or(formula), ';');
        let Some(&end) = ends.first().filter(|_| !is_object) else {
            continue;
        };
        if out.write(from, formula, &format!("T {name}({parameters}){{return ")) {
            out.write(end, end + 1, "}");
        }
    }
}

/// `return { x: a, y: b };` as `x = a; y = b;`, and `return { x, y };` as `return x, y;`
fn objects_given_back(out: &mut Respelled<'_>) {
    let text = out.now();
    let brackets = Brackets::of(&text);
    for (at, word) in text.match_indices("return {") {
        let open = at + word.len() - 1;
        let Some(close) = brackets.near(open) else { continue };
        let colons = outside(&text, open + 1, close, ':');
        // `a ? b : c`
        if !outside(&text, open + 1, close, '?').is_empty() {
            continue;
        }
        out.blank(open, open + 1);
        out.blank(close, close + 1);
        if colons.is_empty() {
            continue;
        }
        out.blank(at, open);
        colons.into_iter().for_each(|k| {
            out.write(k, k + 1, "=");
        });
        for comma in outside(&text, open + 1, close, ',') {
            out.write(comma, comma + 1, ";");
        }
        // The last one may have no comma behind it.
        let is_ended = text[..close].trim_end().ends_with(',');
        if !is_ended {
            out.write(close, close + 1, ";");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::as_c;

    #[test]
    fn scripts_as_programs_of_c() {
        let text = "export function f(q1, { L1 }) {\n  return {\n    x: L1 * Math.cos(q1),\n    y: 0,\n  };\n}\n\
                    export const d = (q2, { L1 }) => L1 * sin(q2);\n";
        let now = as_c(text).unwrap_or_default();
        assert_eq!(now.len(), text.len());
        let plain: Vec<String> =
            now.lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        let wanted = [
            "function f(q1, L1 ) {",
            "",
            "x= L1 * Math.cos(q1);",
            "y= 0;",
            ";",
            "}",
            "T d(q2,L1){return L1 * sin(q2)}",
        ];
        assert_eq!(plain, wanted);
    }
}
