//! Inverse kinematics in programs: the lines of a function, or of a script, that give joints their values, read as the formulas
//! that they are.
//!
//! A program is not run for this. Its lines `name = formula` are respelled in place, byte for byte, as a document would write
//! them, and become statements of the document: helpers are judged where they are used, `for sign in (1, -1)` is ±, and
//! an entry of an argument, `T[0, 3]`, is the entry of the pose.

use denavit_reading::code::Dialect;
use denavit_reading::document::{self, Document, Format, Statement};
use std::ops::Range;

/// A document with the inverse formulas of its programs among its statements.
pub(super) struct Scripts {
    /// The text with those lines respelled; places are those of the original.
    pub text: String,
    /// The text without the functions that were read so.
    pub programs: String,
    pub statements: Vec<Statement>,
}

/// Functions by which inverse formulas are told.
const INVERSE: [&str; 7] = ["atan2", "arctan", "atan(", "acos", "arccos", "asin", "arcsin"];
/// Modules whose names stand before functions.
const MODULES: [&str; 7] = ["np.", "math.", "numpy.", "sp.", "sympy.", "sym.", "jnp."];
/// The longest line.
const LONGEST: usize = 2_000;

/// A function of a program, or what stands outside of them.
struct Region {
    /// From its head to its last line; nothing for a script.
    function: Option<Range<usize>>,
    parameters: Vec<String>,
    /// Names that are 1 or −1.
    signs: Vec<String>,
    lines: Vec<Line>,
}

/// A line `name = formula`.
struct Line {
    span: Range<usize>,
    name: String,
    /// Where the formula stands.
    formula: Range<usize>,
}

/// The inverse formulas of the programs of a document; nothing if there are none.
pub(super) fn inverse(
    text: &str,
    programs: &[(Range<usize>, Dialect)],
    is_joint: &dyn Fn(&str) -> bool,
) -> Option<Scripts> {
    let mut respelled = text.as_bytes().to_vec();
    let mut kept = text.as_bytes().to_vec();
    let mut alone: Vec<u8> = text.bytes().map(|b| if b == b'\n' { b'\n' } else { b' ' }).collect();
    let mut is_any = false;
    for (span, language) in programs {
        for region in regions(text, span, *language) {
            let solves = |line: &Line| {
                let source = &text[line.formula.clone()];
                is_joint(&line.name) && INVERSE.iter().any(|f| source.contains(f))
            };
            if !region.lines.iter().any(solves) {
                continue;
            }
            is_any = true;
            for line in &region.lines {
                let formula = spelled(&text[line.formula.clone()], &region, *language);
                if says_nothing(&line.name, &formula) {
                    continue;
                }
                let head = text[line.span.start..line.formula.start].bytes();
                let bytes: Vec<u8> = head.chain(formula.bytes()).collect();
                respelled[line.span.clone()].copy_from_slice(&bytes);
                alone[line.span.clone()].copy_from_slice(&bytes);
            }
            if let Some(function) = region.function {
                kept[function].iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
            }
        }
    }
    if !is_any {
        return None;
    }
    let [respelled, kept, alone] = [respelled, kept, alone].map(|b| String::from_utf8(b).ok());
    let statements = document::read(&alone?, Format::Plain).statements;
    Some(Scripts { text: respelled?, programs: kept?, statements })
}

impl Scripts {
    /// Puts the statements among those of the document.
    pub fn join(&mut self, document: &mut Document) {
        document.statements.append(&mut self.statements);
        document.statements.sort_by_key(|s| s.span.start);
    }
}

/// True for a line that only takes an argument apart, or makes an empty list or a number.
fn says_nothing(name: &str, formula: &str) -> bool {
    let plain = formula.trim();
    let is_number = plain.trim_start_matches(['-', '+']).parse::<f64>().is_ok();
    let is_entry = matches!(plain, "px" | "py" | "pz")
        && matches!(name.to_lowercase().as_str(), "x" | "y" | "z" | "px" | "py" | "pz");
    // Arrays are read where the program is.
    is_number || is_entry || plain == name || plain.contains(['[', '{', '"', '\''])
}

/// The functions of a program, and what stands outside of them.
fn regions(text: &str, span: &Range<usize>, language: Dialect) -> Vec<Region> {
    let mut found = vec![Region { function: None, parameters: vec![], signs: vec![], lines: vec![] }];
    // The function that is open, and how far it is set in.
    let mut open: Option<(usize, usize)> = None;
    let mut is_quoted = false;
    let mut at = span.start;
    while at < span.end {
        let (line, next) = logical(text, at, span.end, language);
        at = next;
        let source = &text[line.clone()];
        let trimmed = source.trim_start();
        let indent = source.len() - trimmed.len();
        let quotes = source.matches("\"\"\"").count() + source.matches("'''").count();
        let was_quoted = is_quoted;
        is_quoted ^= quotes % 2 == 1;
        if was_quoted || quotes > 0 || trimmed.trim().is_empty() || source.len() > LONGEST {
            continue;
        }
        if let Some((_, depth)) = open
            && (language == Dialect::Python && indent <= depth
                || language == Dialect::Matlab && trimmed.starts_with("function"))
        {
            open = None;
        }
        if let Some((parameters, signs)) = head(trimmed, language) {
            let function = Some(line.start..line.end);
            found.push(Region { function, parameters, signs, lines: vec![] });
            open = Some((found.len() - 1, indent));
            continue;
        }
        let region = &mut found[open.map_or(0, |o| o.0)];
        if let Some(function) = &mut region.function {
            function.end = line.end;
        }
        region.signs.extend(sign_of_loop(trimmed));
        region.lines.extend(assigned(text, &line));
    }
    found
}

/// A line with those that go on inside its brackets, without the comment; and where the next one begins.
fn logical(text: &str, start: usize, end: usize, language: Dialect) -> (Range<usize>, usize) {
    let comment = if language == Dialect::Python { '#' } else { '%' };
    let (mut depth, mut cut) = (0_i32, None);
    for (i, c) in text[start..end].char_indices() {
        match c {
            '(' | '[' | '{' if cut.is_none() => depth += 1,
            ')' | ']' | '}' if cut.is_none() => depth -= 1,
            '\n' if depth <= 0 || cut.is_some() => {
                return (start..cut.unwrap_or(start + i), start + i + 1);
            }
            c if c == comment && cut.is_none() => cut = Some(start + i),
            _ => {}
        }
    }
    (start..cut.unwrap_or(end), end)
}

/// The parameters of a function, and those of them that are 1 or −1 by default.
fn head(line: &str, language: Dialect) -> Option<(Vec<String>, Vec<String>)> {
    let word = if language == Dialect::Python { "def " } else { "function " };
    let rest = line.strip_prefix(word)?;
    let rest = if language == Dialect::Matlab { rest.split_once('=').map_or(rest, |r| r.1) } else { rest };
    let inside = rest.split_once('(').map_or("", |r| r.1).rsplit_once(')').map_or("", |r| r.0);
    let (mut parameters, mut signs) = (vec![], vec![]);
    for parameter in inside.split(',') {
        let (name, default) = parameter.split_once('=').unwrap_or((parameter, ""));
        let name = name.split(':').next().unwrap_or_default().trim().to_string();
        if matches!(default.trim(), "1" | "-1" | "+1" | "1.0" | "-1.0") {
            signs.push(name.clone());
        }
        parameters.push(name);
    }
    Some((parameters, signs))
}

/// The name of `for sign in (1, -1):`, `for s = [1 -1]`.
fn sign_of_loop(line: &str) -> Option<String> {
    let rest = line.strip_prefix("for ")?;
    let (name, values) = rest.split_once(" in ").or_else(|| rest.split_once('='))?;
    let plain: String = values.chars().filter(|c| !c.is_whitespace() && *c != '+').collect();
    let plain = plain.trim_end_matches(':').trim_matches(['(', ')', '[', ']']).replace(".0", "");
    let is_sign = matches!(plain.trim_end_matches(','), "1,-1" | "-1,1" | "1-1" | "-11");
    is_sign.then(|| name.trim().to_string())
}

/// A line `name = formula`, without a semicolon.
fn assigned(text: &str, line: &Range<usize>) -> Option<Line> {
    let source = &text[line.clone()];
    let equals = source.find('=')?;
    let name = source[..equals].trim();
    let is_name =
        name.starts_with(char::is_alphabetic) && name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let rest = &source[equals + 1..];
    if !is_name || rest.starts_with('=') {
        return None;
    }
    let body = rest.trim_end().trim_end_matches([';', ',']).trim_end();
    let start = line.start + (source.len() - source.trim_start().len());
    let formula = line.start + equals + 1;
    Some(Line {
        span: start..formula + body.len(),
        name: name.into(),
        formula: formula..formula + body.len(),
    })
}

/// A formula as a document writes it, in as many bytes.
fn spelled(source: &str, region: &Region, language: Dialect) -> String {
    let mut out = source.replace(['\n', '\r', '\t'], " ").replace("**", "^ ");
    for (was, now) in [(".^", " ^"), (".*", " *"), ("./", " /"), ("...", "   ")] {
        out = out.replace(was, now);
    }
    for module in MODULES {
        out = replaced(&out, module, &" ".repeat(module.len()));
    }
    for name in &region.signs {
        out = with_signs(&out, name);
    }
    for name in &region.parameters {
        out = with_entries(&out, name, language);
    }
    if out.len() == source.len() { out } else { source.into() }
}

/// A word replaced where no letter stands before it.
fn replaced(text: &str, word: &str, now: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(i) = rest.find(word) {
        let before = rest[..i].chars().next_back().or_else(|| out.chars().next_back());
        let is_word = !before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '.'));
        out += &rest[..i];
        out += if is_word { now } else { word };
        rest = &rest[i + word.len()..];
    }
    out + rest
}

/// `sign * x` as ± x, `-sign * x` as ∓ x.
fn with_signs(text: &str, name: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(i) = rest.find(name) {
        let behind = &rest[i + name.len()..];
        let star = behind.trim_start().starts_with('*').then(|| behind.find('*')).flatten();
        let before = rest[..i].chars().next_back();
        out += &rest[..i];
        match star.filter(|_| !before.is_some_and(|c| c.is_alphanumeric() || c == '_')) {
            Some(star) => {
                let head = out.trim_end();
                let is_minus = head.ends_with('-');
                let mark = if is_minus { '∓' } else { '±' };
                let mut length = name.len() + star + 1;
                if is_minus {
                    // The minus is part of the mark.
                    let cut = head.len() - 1;
                    length += out.len() - cut;
                    out.truncate(cut);
                }
                out.push(mark);
                out.push_str(&" ".repeat(length.saturating_sub(mark.len_utf8())));
                rest = &behind[star + 1..];
            }
            None => {
                out += name;
                rest = behind;
            }
        }
    }
    out + rest
}

/// `T[0, 3]`, `T[0][3]`, `T(1,4)` as `px`, `p[0]` as `px`.
fn with_entries(text: &str, name: &str, language: Dialect) -> String {
    let first = usize::from(language == Dialect::Matlab);
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(i) = rest.find(name).filter(|_| !name.is_empty()) {
        let before = rest[..i].chars().next_back().or_else(|| out.chars().next_back());
        let behind = &rest[i + name.len()..];
        out += &rest[..i];
        let is_word = !before.is_some_and(|c| c.is_alphanumeric() || c == '_');
        match entry(behind, first).filter(|_| is_word) {
            Some((entry, length)) => {
                let whole = name.len() + length;
                out += &format!("{entry:whole$}");
                rest = &behind[length..];
            }
            None => {
                out += name;
                rest = behind;
            }
        }
    }
    out + rest
}

/// The entry of the pose that indices name, and their length.
fn entry(text: &str, first: usize) -> Option<(String, usize)> {
    let close = match text.chars().next()? {
        '[' => ']',
        '(' if first == 1 => ')',
        _ => return None,
    };
    let end = text.find(close)?;
    let mut length = end + 1;
    let mut indices: Vec<usize> =
        text[1..end].split(',').map(|k| k.trim().parse::<usize>().ok()).collect::<Option<_>>()?;
    if let ([_], Some(rest)) = (&indices[..], text[length..].strip_prefix('[')) {
        let end = rest.find(']')?;
        indices.push(rest[..end].trim().parse().ok()?);
        length += end + 2;
    }
    let indices: Vec<usize> = indices.into_iter().map(|k| k.checked_sub(first)).collect::<Option<_>>()?;
    let axis = |k: usize| ["x", "y", "z"].get(k).copied();
    match indices[..] {
        [r] => Some((format!("p{}", axis(r)?), length)),
        [r, 3] => Some((format!("p{}", axis(r)?), length)),
        [r, c] if r < 3 && c < 3 => Some((format!("r{}{}", r + 1, c + 1), length)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{Region, spelled};
    use denavit_reading::code::Dialect;

    #[test]
    fn lines_of_programs_as_formulas() {
        let region = Region {
            function: None,
            parameters: vec!["T".into(), "p".into()],
            signs: vec!["s".into(), "elbow".into()],
            lines: vec![],
        };
        for (language, line, formula) in [
            (Dialect::Python, "np.sqrt(x**2 + y**2)", "   sqrt(x^ 2 + y^ 2)"),
            (Dialect::Python, "np.arctan2(s*np.sqrt(1 - D**2), D)", "   arctan2(±   sqrt(1 - D^ 2), D)"),
            (Dialect::Python, "a - elbow * b", "a ∓       b"),
            (Dialect::Python, "T[0, 3] - d*T[0,2]", "px      - d*r13   "),
            (Dialect::Python, "T[1][3] + p[2]", "py      + pz  "),
            (Dialect::Matlab, "atan2(p(2), T(1,4)) .* c.^2", "atan2(py  , px    )  * c ^2"),
        ] {
            let found = spelled(line, &region, language);
            assert_eq!(found, formula);
            assert_eq!(found.len(), line.len());
        }
    }
}
