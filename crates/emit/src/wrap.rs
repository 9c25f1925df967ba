//! Lines of bounded length: prose at spaces, formulas at their outermost signs.

/// Sums, products.
const SIGNS: [&[&str]; 2] = [&[" + ", " - "], &[" * ", " / ", ".*", "./"]];

/// How a formula goes on in the next line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wrap {
    /// The longest line.
    pub width: usize,
    /// One step of indentation.
    pub step: usize,
    /// True if a sign opens the next line, false if it ends the line before.
    pub sign_leads: bool,
    /// What ends a line that goes on, such as ` ...`.
    pub goes_on: &'static str,
    /// Brackets around a formula of several lines.
    pub brackets: [&'static str; 2],
}

impl Wrap {
    /// `head formula tail`, in as few lines as fit; the first begins with the spaces of `head`.
    pub fn statement(&self, head: &str, formula: &str, tail: &str) -> Vec<String> {
        let whole = format!("{head} {formula}{tail}");
        if length(&whole) <= self.width {
            return vec![whole];
        }
        let indent = head.len() - head.trim_start().len() + self.step;
        if let Some((name, arguments)) = as_call(formula) {
            let room = self.width.saturating_sub(1 + self.goes_on.len());
            let mut lines = vec![format!("{head} {name}(")];
            lines.extend(self.arguments(arguments, indent, room));
            lines.push(format!("{}){tail}", " ".repeat(indent - self.step)));
            return self.continued(lines);
        }
        let [open, close] = self.brackets;
        let mut lines = vec![if open.is_empty() { head.to_string() } else { format!("{head} {open}") }];
        // Room for a sign, the tail and the mark of continuation.
        let room = self.width.saturating_sub(3 + tail.len() + self.goes_on.len());
        lines.extend(self.pieces(formula, indent, room));
        if close.is_empty() {
            append(&mut lines, tail);
        } else {
            lines.push(format!("{}{close}{tail}", " ".repeat(indent - self.step)));
        }
        self.continued(lines)
    }

    /// All lines but the last go on.
    fn continued(&self, mut lines: Vec<String>) -> Vec<String> {
        let last = lines.len() - 1;
        lines[..last].iter_mut().for_each(|line| line.push_str(self.goes_on));
        lines
    }

    /// A formula in lines of their own.
    fn pieces(&self, formula: &str, indent: usize, room: usize) -> Vec<String> {
        let margin = " ".repeat(indent);
        if indent + length(formula) <= room {
            return vec![format!("{margin}{formula}")];
        }
        for signs in SIGNS {
            let terms = split(formula, signs);
            if terms.len() > 1 {
                return self.terms(&terms, indent, room);
            }
        }
        // One function or bracket: what is inside goes into lines between its ends.
        let Some((name, arguments)) = as_call(formula) else { return vec![format!("{margin}{formula}")] };
        let mut lines = vec![format!("{margin}{name}(")];
        lines.extend(self.arguments(arguments, indent + self.step, room));
        lines.push(format!("{margin})"));
        lines
    }

    fn arguments(&self, arguments: &str, indent: usize, room: usize) -> Vec<String> {
        let mut lines = vec![];
        let arguments = split(arguments, &[", "]);
        for (k, (_, argument)) in arguments.iter().enumerate() {
            lines.extend(self.pieces(argument, indent, room));
            if k + 1 < arguments.len() {
                append(&mut lines, ",");
            }
        }
        lines
    }

    fn terms(&self, terms: &[(&str, &str)], indent: usize, room: usize) -> Vec<String> {
        let mut lines: Vec<String> = vec![];
        for (sign, term) in terms {
            let mut own = self.pieces(term, indent, room);
            if self.sign_leads && !sign.is_empty() {
                own[0] = format!("{}{} {}", " ".repeat(indent), sign.trim(), own[0].trim_start());
            } else {
                let space = if sign.starts_with(' ') { " " } else { "" };
                append(&mut lines, &format!("{space}{}", sign.trim()));
            }
            lines.extend(own);
        }
        lines
    }

    /// Values with commas, as many in a line as fit.
    pub fn list(&self, values: &[String], indent: usize) -> Vec<String> {
        let margin = " ".repeat(indent);
        let mut lines: Vec<String> = vec![];
        for (k, value) in values.iter().enumerate() {
            let comma = if k + 1 < values.len() { "," } else { "" };
            match lines.last_mut() {
                Some(line) if line.len() + value.len() + 2 + self.goes_on.len() <= self.width => {
                    line.push_str(&format!(" {value}{comma}"));
                }
                _ => lines.push(format!("{margin}{value}{comma}")),
            }
        }
        lines
    }
}

fn append(lines: &mut [String], text: &str) {
    if let Some(line) = lines.last_mut() {
        line.push_str(text);
    }
}

fn length(text: &str) -> usize {
    text.chars().count()
}

/// The name and arguments of a formula that is one call or bracket.
fn as_call(formula: &str) -> Option<(&str, &str)> {
    let is_one = SIGNS.iter().all(|signs| split(formula, signs).len() == 1);
    let (name, rest) = formula.split_once('(')?;
    let arguments = rest.strip_suffix(')')?;
    is_one.then_some((name, arguments))
}

/// The parts between signs that stand outside of all brackets, each with the sign before it.
pub(crate) fn split<'a>(formula: &'a str, signs: &[&'a str]) -> Vec<(&'a str, &'a str)> {
    let (mut parts, mut depth, mut start, mut before) = (vec![], 0_u32, 0, "");
    let mut at = 0;
    while at < formula.len() {
        match formula.as_bytes()[at] {
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let sign = signs.iter().find(|s| depth == 0 && formula[at..].starts_with(**s));
        if let Some(sign) = sign {
            parts.push((before, &formula[start..at]));
            (before, start) = (sign, at + sign.len());
            at = start;
        } else {
            at += 1;
        }
    }
    parts.push((before, &formula[start..]));
    parts
}

/// A text in lines of at most `width` characters, cut at spaces; a line that fits keeps all its spaces.
pub(crate) fn prose(text: &str, width: usize) -> Vec<String> {
    if length(text) <= width {
        return vec![text.trim_end().to_string()];
    }
    let spaces = text.chars().take_while(|c| c.is_whitespace()).count();
    let margin = " ".repeat(spaces.min(width / 2));
    let mut lines: Vec<String> = vec![];
    for word in text.split_whitespace() {
        let letters: Vec<char> = word.chars().collect();
        for part in letters.chunks(width - margin.len()) {
            let part: String = part.iter().collect();
            match lines.last_mut() {
                Some(line) if length(line) + 1 + length(&part) <= width => line.push_str(&format!(" {part}")),
                _ => lines.push(format!("{margin}{part}")),
            }
        }
    }
    lines
}

/// Lines of a comment, each with `prefix` and without spaces at its end.
pub(crate) fn comments<'a>(
    lines: impl IntoIterator<Item = &'a str>,
    prefix: &str,
    width: usize,
) -> Vec<String> {
    let room = width - prefix.len();
    let own = |line: &str| prose(&super::names::comment(line), room);
    lines.into_iter().flat_map(own).map(|line| format!("{prefix}{line}").trim_end().to_string()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PYTHON: Wrap = Wrap { width: 24, step: 4, sign_leads: true, goes_on: "", brackets: ["(", ")"] };
    const MATLAB: Wrap = Wrap { width: 24, step: 4, sign_leads: false, goes_on: " ...", brackets: ["", ""] };

    #[test]
    fn a_long_formula_goes_on_at_its_outermost_signs() {
        let check = |wrap: Wrap, formula: &str, expected: &[&str]| {
            assert_eq!(wrap.statement("x =", formula, ""), expected, "{formula}");
        };
        check(PYTHON, "a * b + c * (d - e)", &["x = a * b + c * (d - e)"]);
        check(
            PYTHON,
            "a * b + c * d - e * (f + g)",
            &["x = (", "    a * b", "    + c * d", "    - e * (f + g)", ")"],
        );
        check(
            PYTHON,
            "sqrt(alpha * beta + gamma * delta)",
            &["x = sqrt(", "    alpha * beta", "    + gamma * delta", ")"],
        );
        check(
            MATLAB,
            "a.*b + c.*d - e.*(f + g)",
            &["x = ...", "    a.*b + ...", "    c.*d - ...", "    e.*(f + g)"],
        );
    }

    #[test]
    fn prose_is_cut_at_spaces_and_words_where_they_must() {
        assert_eq!(prose("  i  a   b", 12), ["  i  a   b"]);
        assert_eq!(prose("one two three four", 9), ["one two", "three", "four"]);
        assert_eq!(prose("abcdefghijkl", 5), ["abcde", "fghij", "kl"]);
    }
}
