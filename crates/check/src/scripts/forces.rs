//! Dynamics in programs: the lines of functions that speak of masses, read as the formulas that they are.

use super::spelling::{spelled, squeezed};
use super::{KNOWN, Line, Region, regions};
use crate::dynamics::speaks_of_masses;
use crate::facts::Motion;
use denavit_reading::code::Dialect;
use denavit_reading::document::{self, Document, Format};
use std::ops::Range;

/// Lines of programs as formulas of dynamics.
pub(crate) struct Forces {
    /// The text with those lines respelled; places are those of the original.
    pub text: String,
    /// These lines.
    pub document: Document,
    /// Where each of them stands, and what stands there now.
    lines: Vec<(Range<usize>, Vec<u8>)>,
    /// The heads of their functions.
    pub heads: Vec<Range<usize>>,
    /// Parameters for rates (1) and accelerations (2) of joints.
    pub motion: Motion,
}

/// No more lines are looked at.
const MAX_LINES: usize = 400;
/// Functions of languages that make arrays, whose argument is no index.
const MAKERS: [&str; 10] = ["zeros", "ones", "eye", "rand", "diag", "size", "sym", "exp", "log", "round"];
/// What rates and accelerations are called where they are parameters beside the joints.
const RATES: [&str; 7] = ["w", "om", "omega", "v", "vel", "u", "ω"];
const ACCELERATIONS: [&str; 6] = ["a", "acc", "al", "alpha", "e", "eps"];

/// The lines of programs that may be formulas of dynamics; nothing where no program speaks of masses. `joint` is the
/// number of a joint.
pub(crate) fn forces(
    text: &str,
    programs: &[(Range<usize>, Dialect)],
    joint: &dyn Fn(&str) -> Option<usize>,
) -> Option<Forces> {
    let blank: Vec<u8> = text.bytes().map(|b| if b == b'\n' { b'\n' } else { b' ' }).collect();
    let mut alone = vec![blank.clone()];
    let (mut lines, mut heads, mut motion) = (vec![], vec![], Motion::new());
    for (span, language) in programs {
        let named = with_numbers(text, span, *language);
        for region in regions(&named, span, *language) {
            let speaks = |line: &Line| {
                line.parts.iter().any(|p| speaks_of_masses(named.get(p.1.clone()).unwrap_or_default()))
            };
            if !region.lines.iter().any(speaks) {
                continue;
            }
            heads.extend(region.function.as_ref().map(|f| {
                let end = text[f.start..f.end].find('\n').map_or(f.end, |i| f.start + i);
                f.start..end
            }));
            motion.extend(moving(&region.parameters, joint));
            let plain = Region::new(None, vec![], vec![]);
            for line in region.lines.iter().take(MAX_LINES) {
                for (span, bytes) in written(&named, line, &plain, *language) {
                    let start = text[..span.start].rfind('\n').map_or(0, |i| i + 1);
                    let end = text[span.end..].find('\n').map_or(text.len(), |i| span.end + i);
                    let is_free = |a: &Vec<u8>| a[start..end].iter().all(u8::is_ascii_whitespace);
                    let k = alone.iter().position(is_free).unwrap_or(alone.len());
                    if k >= super::MAX_BESIDE {
                        continue;
                    }
                    if alone.len() <= k {
                        alone.push(blank.clone());
                    }
                    alone[k][span.clone()].copy_from_slice(&bytes);
                    lines.push((span, bytes));
                }
            }
        }
    }
    if lines.is_empty() {
        return None;
    }
    let mut document = Document::default();
    for bytes in alone {
        document.statements.extend(document::read(&String::from_utf8(bytes).ok()?, Format::Plain).statements);
    }
    document.statements.sort_by_key(|s| s.span.start);
    let mut found = Forces { text: String::new(), document, lines, heads, motion };
    found.text = found.over(text)?;
    Some(found)
}

impl Forces {
    /// A text of the same length with these lines in it.
    pub fn over(&self, text: &str) -> Option<String> {
        let mut bytes = text.as_bytes().to_vec();
        for (span, now) in &self.lines {
            bytes.get_mut(span.clone())?.copy_from_slice(now);
        }
        String::from_utf8(bytes).ok()
    }
}

/// What is written in place of a line, statement by statement.
fn written(text: &str, line: &Line, plain: &Region, language: Dialect) -> Vec<(Range<usize>, Vec<u8>)> {
    let is_formula = |now: &str| {
        let is_array = now.contains(['{', '"', '\'', ':', '?']) || now.contains(".T");
        let is_call = now.match_indices('(').any(|(i, _)| {
            let word = now[..i].rsplit(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default();
            !word.is_empty() && !KNOWN.contains(&word)
        });
        !is_array && !is_call
    };
    let formula = |span: &Range<usize>| {
        let now = without_maker(&spelled(text.get(span.clone()).unwrap_or_default(), plain, language));
        is_formula(&now).then_some(now)
    };
    if let [(_, span)] = &line.parts[..] {
        let Some(now) = formula(span).filter(|now| now.len() == span.len()) else { return vec![] };
        let head = text[line.span.start..span.start].replace('\n', " ");
        return vec![(line.span.start..span.end, head.bytes().chain(now.bytes()).collect())];
    }
    // Packed from the beginning of the statement on.
    let (mut found, mut at) = (vec![], line.span.start);
    for (name, span) in &line.parts {
        let Some(now) = formula(span) else { continue };
        let bytes = format!("{name}={}", squeezed(&now)).into_bytes();
        let end = at + bytes.len();
        if end > line.end {
            break;
        }
        found.push((at..end, bytes));
        at = end + 1;
    }
    // What is left of the old statement.
    if let Some((last, bytes)) = found.last_mut()
        && last.end < line.end
    {
        bytes.resize(bytes.len() + line.end - last.end, b' ');
        last.end = line.end;
    }
    found
}

/// `array([[a, b], [c, d]])` without its maker, in as many bytes.
fn without_maker(formula: &str) -> String {
    const ARRAYS: [&str; 4] = ["array(", "matrix(", "Matrix(", "asarray("];
    let bare = formula.trim();
    let made = ARRAYS.iter().find_map(|m| Some((bare.strip_prefix(m)?.strip_suffix(')')?, m.len())));
    match made {
        Some((inner, length)) => {
            let before = formula.len() - formula.trim_start().len() + length;
            let width = formula.len() - before;
            format!("{}{inner:width$}", " ".repeat(before))
        }
        None => formula.into(),
    }
}

/// A program with the entries of arrays as names with numbers, `q1  ` for `q[0]` or `q(1)`, `M12    ` for `M[0, 1]`.
fn with_numbers(text: &str, span: &Range<usize>, language: Dialect) -> String {
    let (open, close, first) = match language {
        Dialect::Matlab => ('(', ')', 1),
        _ => ('[', ']', 0),
    };
    let source = text.get(span.clone()).unwrap_or_default();
    let mut out = String::with_capacity(source.len());
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let mut rest = source;
    while let Some(i) = rest.find(is_part) {
        out += &rest[..i];
        let length = rest[i..].find(|c| !is_part(c)).unwrap_or(rest.len() - i);
        let (word, behind) = rest[i..].split_at(length);
        let is_name = word.starts_with(char::is_alphabetic)
            && !word.ends_with(|c: char| c.is_ascii_digit())
            && !KNOWN.contains(&word)
            && !MAKERS.contains(&word);
        let index = is_name.then(|| index(behind, open, close, first)).flatten();
        out += word;
        rest = behind;
        if let Some((digits, length)) = index {
            out += &format!("{digits:length$}");
            rest = &behind[length..];
        }
    }
    out += rest;
    let mut whole = text.to_string();
    whole.replace_range(span.clone(), &out);
    whole
}

/// One index or two behind a name as digits that count from 1, and their length.
fn index(behind: &str, open: char, close: char, first: usize) -> Option<(String, usize)> {
    let digit = |k: &str| {
        let k: usize = k.trim().parse().ok()?;
        let k = k.checked_sub(first)?;
        (k < 9).then(|| (k + 1).to_string())
    };
    let inside = |text: &str| -> Option<(String, usize)> {
        let inner = text.strip_prefix(open)?;
        let end = inner.find(close).filter(|e| *e < 8)?;
        let indices: Vec<String> = inner[..end].split(',').map(digit).collect::<Option<_>>()?;
        (indices.len() <= 2).then(|| (indices.concat(), end + 2))
    };
    let (digits, length) = inside(behind)?;
    match inside(&behind[length..]).filter(|_| digits.len() == 1) {
        Some((more, further)) if more.len() == 1 => Some((digits + &more, length + further)),
        _ => Some((digits, length)),
    }
}

/// Parameters beside the joints that are called as rates or accelerations: `w1, w2`.
fn moving(parameters: &[String], joint: &dyn Fn(&str) -> Option<usize>) -> Motion {
    let mut found = Motion::new();
    let digits =
        |p: &str| p.find(|c: char| c.is_ascii_digit()).map(|i| (p[..i].to_string(), p[i..].to_string()));
    for (p, of) in parameters.iter().filter_map(|p| Some((p, joint(p)?))) {
        let Some((_, number)) = digits(p) else { continue };
        for other in parameters.iter().filter(|o| joint(o).is_none()) {
            let order = match digits(other).filter(|o| o.1 == number).map(|o| o.0) {
                Some(stem) if RATES.contains(&&*stem) => 1,
                Some(stem) if ACCELERATIONS.contains(&&*stem) => 2,
                _ => continue,
            };
            found.insert(other.clone(), (of, order));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{moving, with_numbers, without_maker};
    use denavit_reading::code::Dialect;

    #[test]
    fn entries_of_arrays_are_names_with_numbers() {
        for (language, was, now) in [
            (Dialect::Python, "tau[0] = m[1]*sin(q[0])", "tau1   = m2  *sin(q1  )"),
            (Dialect::C, "M[0][1] = M12[3];", "M12     = M12[3];"),
            (Dialect::Matlab, "M(1,2) = cos(q(2))*zeros(2);", "M12    = cos(q2  )*zeros(2);"),
            (Dialect::Python, "T[:3, 0] + x[k] + y[-1]", "T[:3, 0] + x[k] + y[-1]"),
        ] {
            assert_eq!(with_numbers(was, &(0..was.len()), language), now);
        }
        assert_eq!(without_maker(" array([[a, b]]) "), "       [[a, b]]  ");
    }

    #[test]
    fn parameters_beside_joints() {
        let joint = |name: &str| ["q1", "q2"].iter().position(|q| *q == name);
        let parameters = ["q1", "q2", "w1", "w2", "a2", "m1", "k"].map(String::from);
        let found = moving(&parameters, &joint);
        assert_eq!(found, [("w1".into(), (0, 1)), ("w2".into(), (1, 1)), ("a2".into(), (1, 2))].into());
    }
}
