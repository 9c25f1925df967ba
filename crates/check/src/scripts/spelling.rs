//! Lines of programs as a document writes formulas.

use super::{MODULES, Region, split};
use crate::degrees::without_factor;
use denavit_reading::code::Dialect;
use std::ops::Range;

/// Writes blanks over a part of a text, if there is one.
pub(super) fn cleared(text: &mut [u8], part: Option<Range<usize>>) {
    let part = part.and_then(|p| text.get_mut(p)).unwrap_or_default();
    part.iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
}

/// The name of `for sign in (1, -1):`, `for s = [1 -1]`.
pub(super) fn sign_of_loop(line: &str) -> Option<String> {
    let rest = line.strip_prefix("for ")?;
    let (name, values) = rest.split_once(" in ").or_else(|| rest.split_once('='))?;
    let plain: String = values.chars().filter(|c| !c.is_whitespace() && *c != '+').collect();
    let plain = plain.trim_end_matches(':').trim_matches(['(', ')', '[', ']']).replace(".0", "");
    let is_sign = matches!(plain.trim_end_matches(','), "1,-1" | "-1,1" | "1-1" | "-11");
    is_sign.then(|| name.trim().to_string())
}

/// Blanks that say nothing left out.
pub(super) fn squeezed(formula: &str) -> String {
    formula.chars().filter(|c| !c.is_whitespace()).collect()
}

/// `a if c else -a` and `c ? a : -a` as ±a, other branches as `a or b`.
pub(super) fn branches(formula: &str) -> Option<String> {
    let plain = formula.trim();
    let (value, other) = match plain.split_once(" if ") {
        Some((value, rest)) => (value, rest.split_once(" else ")?.1),
        None => plain.split_once('?')?.1.split_once(':')?,
    };
    let (a, b) = (squeezed(value), squeezed(other));
    Some(match () {
        () if b == format!("-{a}") => format!("±{a}"),
        () if a == format!("-{b}") => format!("±{b}"),
        () => format!("{a} or {b}"),
    })
}

/// `hypot(x, y)` as √(x²+y²).
pub(super) fn roots(formula: &str) -> String {
    let mut out = formula.to_string();
    while let Some(i) = out.find("hypot(") {
        let inside = i + "hypot(".len();
        let mut depth = 0_usize;
        let close = out[inside..].char_indices().find(|(_, c)| match c {
            '(' | '[' => {
                depth += 1;
                false
            }
            ')' | ']' if depth > 0 => {
                depth -= 1;
                false
            }
            ')' => true,
            _ => false,
        });
        let Some((length, _)) = close else { return formula.into() };
        let arguments = split(&out, &(inside..inside + length));
        let square = |a: &Range<usize>| {
            let a = out[a.clone()].trim();
            let is_name = a.chars().all(|c| c.is_alphanumeric() || c == '_');
            if is_name { format!("{a}²") } else { format!("({a})²") }
        };
        let sum: Vec<String> = arguments.iter().map(square).collect();
        out.replace_range(i..inside + length + 1, &format!("√({})", sum.join("+")));
    }
    out
}

/// A formula as a document writes it, in as many bytes.
pub(super) fn spelled(source: &str, region: &Region, language: Dialect) -> String {
    let mut out = source.replace(['\n', '\r', '\t'], " ").replace("**", "^ ");
    for (was, now) in [(".^", " ^"), (".*", " *"), ("./", " /"), ("...", "   ")] {
        out = out.replace(was, now);
    }
    for module in MODULES {
        out = replaced(&out, module, &" ".repeat(module.len()));
    }
    out = replaced(&out, "self.", "     ");
    out = unclipped(&out);
    for name in region.conversions.names() {
        out = without_factor(&out, name);
    }
    for name in &region.signs {
        out = with_signs(&out, name);
    }
    if language == Dialect::C {
        out = with_fields(&out, region);
        for (was, now) in [
            ("sinf(", "sin ("),
            ("cosf(", "cos ("),
            ("sqrtf(", "sqrt ("),
            ("atan2f(", "atan2 ("),
            ("acosf(", "acos ("),
            ("asinf(", "asin ("),
            ("atanf(", "atan ("),
            ("M_PI_2", "(pi/2)"),
            ("M_PI_4", "(pi/4)"),
        ] {
            out = replaced(&out, was, now);
        }
        out = whole_words(&out, "M_PI", "  pi");
        out = whole_words(&out, "PI", "pi");
    }
    for (was, now) in [
        ("atan2d(", "atan2 ("),
        ("acosd(", "acos ("),
        ("asind(", "asin ("),
        ("atand(", "atan ("),
        ("sind(", "sin ("),
        ("cosd(", "cos ("),
    ] {
        out = replaced(&out, was, now);
    }
    for name in &region.parameters {
        out = with_entries(&out, name, language);
    }
    if out.len() == source.len() { out } else { source.into() }
}

/// `clip(x, -1, 1)`, `max(-1, min(1, x))` as x, in as many bytes.
fn unclipped(text: &str) -> String {
    let mut out = text.to_string();
    for _ in 0..4 {
        let found = ["clip(", "max(", "min(", "fmax(", "fmin(", "constrain("]
            .iter()
            .filter_map(|f| Some((out.rfind(f)?, f.len())))
            .filter(|(i, _)| !out[..*i].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
            .max();
        let Some((i, length)) = found else { return out };
        let inside = i + length;
        let mut depth = 0_i32;
        let close = out[inside..].char_indices().find_map(|(k, c)| {
            depth += i32::from(matches!(c, '(' | '[')) - i32::from(matches!(c, ')' | ']'));
            (depth < 0).then_some(inside + k)
        });
        let Some(close) = close else { return out };
        let is_bound = |s: &Range<usize>| {
            matches!(out[s.clone()].trim(), "1" | "-1" | "1.0" | "-1.0" | "1." | "-1." | "+1")
        };
        let arguments = split(&out, &(inside..close));
        let values: Vec<&Range<usize>> = arguments.iter().filter(|a| !is_bound(a)).collect();
        let [value] = values[..] else { return out };
        let inner = format!("({})", &out[value.clone()]);
        let width = close + 1 - i;
        let filled = format!("{inner}{}", " ".repeat(width.saturating_sub(inner.len())));
        out.replace_range(i..close + 1, &filled);
    }
    out
}

/// The statements of a line: what stands between semicolons.
pub(super) fn statements_of(text: &str, line: &Range<usize>, language: Dialect) -> Vec<Range<usize>> {
    // `double x = a, y = b`
    let declares = |rest: &str| {
        let rest = rest.trim_start().trim_start_matches(['*', '&']);
        let name = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let behind = rest[name..].trim_start();
        name > 0 && behind.starts_with('=') && !behind.starts_with("==")
    };
    let (mut depth, mut start, mut found) = (0_i32, line.start, vec![]);
    for (i, c) in text[line.clone()].char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ';' | '{' | '}' if depth <= 0 => {
                found.push(start..line.start + i);
                start = line.start + i + 1;
            }
            ',' if depth <= 0 && language == Dialect::C && declares(&text[line.start + i + 1..line.end]) => {
                found.push(start..line.start + i);
                start = line.start + i + 1;
            }
            _ => {}
        }
    }
    found.push(start..line.end);
    found.retain(|s| !text[s.clone()].trim().is_empty());
    found
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

/// A word replaced where it stands by itself.
fn whole_words(text: &str, word: &str, now: &str) -> String {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(i) = rest.find(word) {
        let behind = &rest[i + word.len()..];
        let is_word =
            !out.ends_with(is_part) && !rest[..i].ends_with(is_part) && !behind.starts_with(is_part);
        out += &rest[..i];
        out += if is_word { now } else { word };
        rest = behind;
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
        match vector_of(name).and_then(|v| entry(behind, first, v)).filter(|_| is_word) {
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

/// The letter of a pose's column that a vector has, by its name; those that have no other one are the place of the hand.
fn vector_of(name: &str) -> Option<&'static str> {
    let lower = name.to_lowercase();
    match lower.trim_end_matches(['_', '0']) {
        "n" | "nvec" | "n_vec" | "normal" => Some("n"),
        "a" | "avec" | "a_vec" | "approach" => Some("a"),
        // The centre of the wrist, where there is one.
        "w" | "wc" | "w_c" | "pw" | "p_w" | "pwc" | "p_wc" | "wrist" | "p_wrist" => Some("w"),
        // Which direction of the hand, its name does not say.
        other if ["dir", "axis", "orient", "unit"].iter().any(|w| other.contains(w)) => None,
        _ => Some("p"),
    }
}

/// `q.tilt`, `p->x` by the field alone; x, y, z of an argument are the place of the hand, or a direction of it by its name.
fn with_fields(text: &str, region: &Region) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    while let Some(i) = rest.find(is_part) {
        out += &rest[..i];
        let word = &rest[i..i + rest[i..].find(|c| !is_part(c)).unwrap_or(rest.len() - i)];
        let behind = &rest[i + word.len()..];
        let dot = [".", "->"].iter().find(|d| behind.starts_with(**d)).map_or(0, |d| d.len());
        let field = &behind[dot..];
        let field = &field[..field.find(|c| !is_part(c)).unwrap_or(field.len())];
        // `p.x()` is a field, too.
        let is_call = behind[dot + field.len()..].starts_with("()") && matches!(field, "x" | "y" | "z");
        let length = word.len() + dot + field.len() + if is_call { 2 } else { 0 };
        if dot == 0 || field.is_empty() || word.starts_with(|c: char| c.is_ascii_digit()) {
            out += word;
            rest = behind;
            continue;
        }
        let is_entry = region.parameters.iter().any(|p| p == word) && matches!(field, "x" | "y" | "z");
        let now = match vector_of(word).filter(|_| is_entry) {
            Some(letter) => format!("{letter}{field}"),
            None if is_entry => rest[i..i + length].to_string(),
            None => field.to_string(),
        };
        out += &format!("{now:length$}");
        rest = &rest[i + length..];
    }
    out + rest
}

/// The entry of the pose that indices name, and their length.
fn entry(text: &str, first: usize, vector: &str) -> Option<(String, usize)> {
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
        [r] => Some((format!("{vector}{}", axis(r)?), length)),
        [r, 3] => Some((format!("p{}", axis(r)?), length)),
        [r, c] if r < 3 && c < 3 => Some((format!("r{}{}", r + 1, c + 1), length)),
        _ => None,
    }
}

/// True for a name that a root is multiplied by, in a text without blanks: `side*sqrt(1-D*D)`.
pub(super) fn is_factor_of_root(body: &str, name: &str) -> bool {
    const ROOTS: [&str; 3] = ["sqrt(", "acos(", "arccos("];
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    !name.is_empty()
        && body.match_indices(&format!("{name}*")).any(|(at, m)| {
            let rest = MODULES.iter().find_map(|p| body[at + m.len()..].strip_prefix(p));
            let rest = rest.unwrap_or(&body[at + m.len()..]);
            !body[..at].ends_with(is_part) && ROOTS.iter().any(|r| rest.starts_with(r))
        })
}

/// True for a formula of a name that it is made from.
pub(super) fn defines(formula: &str, name: &str) -> bool {
    formula.split(|c: char| !c.is_alphanumeric() && c != '_').any(|w| w == name)
}

/// `wx` for `px`.
pub(super) fn renamed(text: &str, name: &str) -> String {
    let own = format!("w{}", &name[1..]);
    let mut out = String::with_capacity(text.len());
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let mut rest = text;
    while let Some(i) = rest.find(name) {
        let is_word = !rest[..i].ends_with(is_part) && !rest[i + name.len()..].starts_with(is_part);
        out += &rest[..i];
        out += if is_word { &own } else { name };
        rest = &rest[i + name.len()..];
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::{Region, spelled};
    use denavit_reading::code::Dialect;

    #[test]
    fn lines_of_programs_as_formulas() {
        let names = |all: &[&str]| all.iter().map(ToString::to_string).collect::<Vec<String>>();
        let region = Region::new(None, names(&["T", "p", "n", "tool_dir"]), names(&["s", "elbow"]));
        for (language, line, formula) in [
            (Dialect::Python, "np.sqrt(x**2 + y**2)", "   sqrt(x^ 2 + y^ 2)"),
            (Dialect::Python, "np.arctan2(s*np.sqrt(1 - D**2), D)", "   arctan2(±   sqrt(1 - D^ 2), D)"),
            (Dialect::Python, "a - elbow * b", "a ∓       b"),
            (Dialect::Python, "T[0, 3] - d*T[0,2]", "px      - d*r13   "),
            (Dialect::Python, "T[1][3] + p[2]", "py      + pz  "),
            (Dialect::C, "atan2(-n.y, p.x)", "atan2(-ny , px )"),
            (Dialect::C, "asin(tool_dir[0])", "asin(tool_dir[0])"),
            (Dialect::C, "asin(tool_dir.x)", "asin(tool_dir.x)"),
            (Dialect::C, "atan2(p.y(), p.x())", "atan2(py   , px   )"),
            (Dialect::Matlab, "atan2(p(2), T(1,4)) .* c.^2", "atan2(py  , px    )  * c ^2"),
        ] {
            let found = spelled(line, &region, language);
            assert_eq!(found, formula);
            assert_eq!(found.len(), line.len());
        }
    }
}
