//! Sines and cosines inside a word: `C23`, `s_{2-3}`, `cosθ1`, `c_{θ_1}`, `sα_j`.

use super::ParseError;
use super::functions::{FUNCTIONS, Function};
use super::names::Names;
use super::words::{KNOWN, Letter, Next, Piece, REFUSED, TRIG, ends, is_angle_letter, spelled};
use crate::expr::Expr;
use std::ops::Range;

/// A way to read the letters up to `to`.
pub(super) struct Edge {
    pub to: usize,
    pub cost: u64,
    pub meaning: Result<Piece, ParseError>,
}

/// The functions that begin at `from`, with their arguments.
pub(super) fn edges(letters: &[Letter], from: usize, next: Next, names: &Names) -> Vec<Edge> {
    let mut found = vec![];
    for &(name, function) in FUNCTIONS {
        let length = name.chars().count();
        let Some(spelling) = letters.get(from..from + length) else { continue };
        let is_here = spelling.iter().zip(name.chars()).all(|(l, c)| l.c == c && (!l.glued || c == '2'));
        if !is_here {
            continue;
        }
        let after = from + length;
        if after == letters.len() {
            let is_arc = function.is_inverse() && name.starts_with("arc");
            if next == Next::Bracket || next == Next::Argument && length > 1 || next == Next::Letter && is_arc
            {
                // Where `a` is itself a known symbol, `acos` is as well the product a·cos: both cost the same.
                let cost = if matches!(name, "asin" | "acos" | "atan") { KNOWN + TRIG } else { TRIG };
                found.push(Edge { to: after, cost, meaning: Ok(Piece::Function(function)) });
            }
        } else if function.takes_angle() {
            found.extend(arguments(letters, from, after, function, names));
        } else if function.is_inverse() && name.starts_with("arc") && !letters[after].glued {
            // `\arccos a_x`: one name.
            if names.known(&spelled(&letters[after..])).is_some() {
                found.push(Edge { to: after, cost: TRIG, meaning: Ok(Piece::Function(function)) });
            }
        }
    }
    found
}

/// What the sine from `from` to `after` may have as its argument.
fn arguments(letters: &[Letter], from: usize, after: usize, function: Function, names: &Names) -> Vec<Edge> {
    let (power, at) = power(letters, after);
    let value = |angle: Expr| Piece::Atom(function.of(&[angle]).powi(power));
    let span = |to: usize| letters[from].span.start..letters[to - 1].span.end;
    let Some(first) = letters.get(at) else { return vec![] };
    let mut found = vec![];
    if first.glued && function == Function::Tan {
        return found;
    }
    if first.glued {
        let to = ends(letters, at).next().unwrap_or(letters.len());
        let indices = spelled(&letters[at..to]);
        if let Some(angle) = subscript(&indices, span(to), &spelled(&letters[from..to]), names) {
            let angle = match angle {
                Ok(_) if is_angle_letter(letters, to) && !is_known_length(letters, to, names) => {
                    Err(factor_or_index(letters, from, at, to))
                }
                other => other,
            };
            let cost = if angle.is_ok() { TRIG } else { REFUSED };
            found.push(Edge { to, cost, meaning: angle.map(value) });
        }
        return found;
    }
    let is_full = after - from > 1;
    let is_greek = is_angle_letter(letters, at);
    if !is_full && !is_greek {
        return found;
    }
    // Where the letter is itself a known symbol, `cβ` is as well the product c·β: both cost the same.
    let is_symbol = !is_full && names.known(&spelled(&letters[from..after])).is_some();
    let cost = if is_symbol { 2 * KNOWN } else { TRIG };
    for to in ends(letters, at).take_while(|to| to - at <= names.longest) {
        let word = spelled(&letters[at..to]);
        if let Some(angle) = names.known(&word) {
            found.push(Edge { to, cost, meaning: Ok(value(angle)) });
            continue;
        }
        let digits = word.strip_prefix('θ').filter(|d| !d.is_empty());
        if let Some(angle) = digits.and_then(|d| subscript(d, span(to), &spelled(&letters[from..to]), names))
        {
            let cost = if angle.is_ok() { cost } else { REFUSED };
            found.push(Edge { to, cost, meaning: angle.map(value) });
        } else if names.is_open() && is_greek && letters[at + 1..to].iter().all(|l| l.glued) {
            let is_name = word.chars().all(char::is_alphanumeric);
            found.extend(is_name.then(|| Edge { to, cost, meaning: Ok(value(Expr::symbol(&word))) }));
        }
    }
    found
}

/// `^2` behind the name of a function, and the place behind it.
fn power(letters: &[Letter], at: usize) -> (i32, usize) {
    if letters.get(at).is_none_or(|l| l.c != '^') {
        return (1, at);
    }
    // The digits of the exponent share the place of the sign.
    let digits = letters[at + 1..].iter().take_while(|l| l.c.is_ascii_digit() && l.span == letters[at].span);
    let digits: String = digits.map(|l| l.c).collect();
    match digits.parse() {
        Ok(n) if n <= super::MAX_EXPONENT => (n, at + 1 + digits.len()),
        _ => (1, letters.len()),
    }
}

/// The angle of a subscript: `23`, `2,10`, `2-3`, `θ1`. `None` if it names no angle at all.
fn subscript(text: &str, span: Range<usize>, sine: &str, names: &Names) -> Option<Result<Expr, ParseError>> {
    let mut sum = Expr::int(0);
    let mut rest = text;
    if rest.is_empty() {
        return None;
    }
    let mut sign = 1;
    loop {
        let length = rest.find(['+', '-']).unwrap_or(rest.len());
        let part = &rest[..length];
        let angle = if part.is_empty() && length < rest.len() && rest.len() == text.len() {
            Expr::int(0) // a leading sign
        } else if part.starts_with(|c: char| c.is_ascii_digit()) {
            match indices(part, &span, sine, names) {
                Ok(angle) => angle,
                Err(e) => return Some(Err(e)),
            }
        } else {
            let is_greek = part.starts_with(|c| super::normalise::is_greek(c) && c != 'π');
            let angle = match names.known(part) {
                None if is_greek && names.is_open() && part.chars().all(char::is_alphanumeric) => {
                    Expr::symbol(part)
                }
                None => return None,
                Some(e) => e,
            };
            let is_numbered = angle.as_symbol().is_some_and(|s| names.vocabulary.number_of(s).is_some());
            if !is_greek && !is_numbered {
                return None;
            }
            angle
        };
        sum = if sign > 0 { sum + angle } else { sum - angle };
        let Some(operator) = rest[length..].chars().next() else { return Some(Ok(sum)) };
        sign = if operator == '-' { -1 } else { 1 };
        rest = &rest[length + 1..];
    }
}

/// The sum of numbered angles: digits in ascending order, or numbers with commas between them.
fn indices(text: &str, span: &Range<usize>, sine: &str, names: &Names) -> Result<Expr, ParseError> {
    let refuse = |message: String| ParseError::new(span.clone(), message);
    let letter = |text: &str| format!("{}_{{{text}}}", sine.trim_end_matches(|c: char| !c.is_alphabetic()));
    let has_comma = text.contains(',');
    let numbers: Option<Vec<u32>> = match has_comma {
        true => text.split(',').filter(|n| !n.is_empty()).map(|n| n.parse().ok()).collect(),
        false => text.chars().map(|c| c.to_digit(10)).collect(),
    };
    let numbers = numbers.ok_or_else(|| refuse(format!("`{text}` is no list of angle numbers")))?;
    let single: Option<u32> = if has_comma { None } else { text.parse().ok().filter(|n| *n >= 10) };
    let declared = |n: &u32| {
        let is_angle =
            names.vocabulary.angle_number(*n).is_some_and(|s| names.vocabulary.number_of(s).is_some());
        is_angle || names.vocabulary.is_sliding(*n)
    };
    let is_ascending = numbers.is_sorted_by(|a, b| a < b);
    if let Some(n) = single.filter(declared) {
        if !is_ascending {
            return angle(n, names).map_err(refuse);
        }
        let with_commas: Vec<String> = numbers.iter().map(u32::to_string).collect();
        let sum = with_commas.join(",");
        let message = format!("`{sine}` reads as angle {n} or as the sum of the angles {sum}");
        return Err(refuse(message).hint(format!(
            "write `{}` or `{}`",
            letter(&sum),
            letter(&format!("{n},"))
        )));
    }
    if !is_ascending {
        let e = refuse(format!("the indices of `{sine}` do not ascend"));
        return Err(e.hint(format!("{} is the sum of the angles 1, 2 and 3", letter("123"))));
    }
    let mut sum = Expr::int(0);
    for n in numbers {
        sum = sum + angle(n, names).map_err(refuse)?;
    }
    Ok(sum)
}

/// Angle number `n`.
fn angle(n: u32, names: &Names) -> Result<Expr, String> {
    match names.vocabulary.angle_number(n) {
        Some(symbol) => Ok(symbol.into()),
        None if names.vocabulary.is_sliding(n) => Err(format!("variable {n} is a length, not an angle")),
        None => Err(format!("there is no angle number {n}")),
    }
}

/// True if a name begins here that stands for what is no angle: `c_1ρ` where ρ is a length with a formula.
fn is_known_length(letters: &[Letter], from: usize, names: &Names) -> bool {
    let is_linear = |e: Expr| {
        let angle = crate::expr::Angle::of(e);
        angle.terms.iter().all(|(term, _)| term.as_symbol().is_some())
    };
    let ends = ends(letters, from).take_while(|to| to - from <= names.longest);
    ends.filter_map(|to| names.known(&spelled(&letters[from..to]))).last().is_some_and(|e| !is_linear(e))
}

/// `cos2θ1`: cos(2·θ1), or cos(θ2)·θ1?
fn factor_or_index(letters: &[Letter], from: usize, at: usize, to: usize) -> ParseError {
    let (sine, index) = (spelled(&letters[from..at]), spelled(&letters[at..to]));
    let next = ends(letters, to).next().unwrap_or(letters.len());
    let angle = spelled(&letters[to..next]);
    let span = letters[from].span.start..letters[next - 1].span.end;
    let message =
        format!("`{sine}{index}{angle}` reads as `{sine}({index}*{angle})` or as `{sine}{index}*{angle}`");
    ParseError::new(span, message).hint("write brackets or `*`")
}
