//! Inverse kinematics in programs: the lines of a function, or of a script, that give joints their values, read as the formulas
//! that they are.
//!
//! A program is not run for this. Its lines `name = formula` are respelled in place, byte for byte, as a document would write
//! them, and become statements of the document: helpers are judged where they are used, `for sign in (1, -1)` is ±, and
//! an entry of an argument, `T[0, 3]`, is the entry of the pose.

mod computed;
mod forces;
mod spelling;

use super::directions::DIRECTIONS;
use super::listing::comment_mark;
use crate::degrees::{Angles, Conversions, INVERSE, Turned, Units, code_alone, names_in};
pub(super) use computed::computed;
use denavit_reading::code::{Dialect, is_sign_name};
use denavit_reading::document::{self, Document, Format, Statement};
pub(super) use forces::{Forces, forces};
use spelling::{
    branches, cleared, defines, is_factor_of_root, renamed, roots, sign_of_loop, spelled, squeezed,
    statements_of,
};
use std::collections::BTreeSet;
use std::ops::Range;

/// A document with the inverse formulas of its programs among its statements.
pub(super) struct Scripts {
    /// The text with those lines respelled; places are those of the original.
    pub text: String,
    /// The text without the functions that were read so.
    pub programs: String,
    pub statements: Vec<Statement>,
    /// Functions, or whole programs, that give joints their values and are not read line by line.
    pub posed: Vec<Range<usize>>,
    /// Names and formulas that are not read.
    pub lost: Vec<(Range<usize>, String)>,
}

/// Modules whose names stand before functions.
pub(super) const MODULES: [&str; 9] =
    ["np.", "math.", "numpy.", "sp.", "sympy.", "sym.", "jnp.", "std::", "Math."];
/// Functions that formulas have.
const KNOWN: [&str; 30] = [
    "sin", "cos", "tan", "sqrt", "atan2", "arctan2", "acos", "asin", "atan", "arccos", "arcsin", "arctan",
    "hypot", "sind", "cosd", "tand", "atan2d", "acosd", "asind", "atand", "deg2rad", "radians", "pow",
    "sqrtf", "atan2f", "acosf", "sinf", "cosf", "abs", "if",
];
/// The most statements of a line.
const MAX_BESIDE: usize = 12;
/// The longest line, and the most parameters of a function that are looked at.
const LONGEST: usize = 2_000;
const MAX_PARAMETERS: usize = 40;

/// A function of a program, or what stands outside of them.
struct Region {
    /// From its head to its last line; nothing for a script.
    function: Option<Range<usize>>,
    parameters: Vec<String>,
    /// Names that are 1 or −1.
    signs: Vec<String>,
    lines: Vec<Line>,
    /// `px`, `py`, `pz` that are another point's from here on: `px = px - d6*az`.
    renamed: Vec<String>,
    /// Constants that turn degrees into radians, and back.
    conversions: Conversions,
}

impl Region {
    fn new(function: Option<Range<usize>>, parameters: Vec<String>, signs: Vec<String>) -> Self {
        let conversions = Conversions::default();
        Region { function, parameters, signs, lines: vec![], renamed: vec![], conversions }
    }
}

/// A statement `name = formula`, or several as a tuple.
struct Line {
    /// The statement, with blanks and the comment behind it as far as they may be written over.
    span: Range<usize>,
    end: usize,
    /// Names, each with its formula.
    parts: Vec<(String, Range<usize>)>,
    /// Both signs are meant: the other one is given further down.
    is_signed: bool,
}

/// The inverse formulas of the programs of a document; nothing if there are none.
pub(super) fn inverse(
    text: &str,
    programs: &[(Range<usize>, Dialect)],
    is_joint: &dyn Fn(&str) -> bool,
    is_known: &dyn Fn(&str) -> bool,
) -> Option<Scripts> {
    let mut respelled = text.as_bytes().to_vec();
    let mut kept = text.as_bytes().to_vec();
    // The statements, those that stand in one tuple each in a text of its own.
    let blank: Vec<u8> = text.bytes().map(|b| if b == b'\n' { b'\n' } else { b' ' }).collect();
    let mut alone = vec![blank.clone()];
    let (mut is_any, mut unread, mut posed) = (false, vec![], vec![]);
    for (span, language) in programs {
        let all = regions(text, span, *language);
        let functions: Vec<Range<usize>> = all.iter().filter_map(|r| r.function.clone()).collect();
        let program = code_alone(text, std::slice::from_ref(span), *language);
        let turned = Turned::of(&program, &functions, is_joint);
        // Numbers that the program gives names beside the functions.
        let mut own: Vec<String> =
            all.iter().take(1).flat_map(|r| &r.lines).flat_map(|l| &l.parts).map(|p| p.0.clone()).collect();
        if *language == Dialect::C {
            let defines = text[span.clone()].lines().filter_map(|l| l.trim_start().strip_prefix("#define "));
            own.extend(defines.filter_map(|l| l.split_whitespace().next()).map(String::from));
        }
        own.retain(|name| !turned.constants.names().any(|c| c == name));
        for region in all {
            let solves = |line: &Line| {
                let has = |part: &(String, Range<usize>)| {
                    let source = &text[part.1.clone()];
                    is_joint(&part.0) && INVERSE.iter().any(|f| source.contains(f))
                };
                line.parts.iter().any(has)
            };
            let whole = region.function.clone().unwrap_or(span.clone());
            if !region.lines.iter().any(solves) {
                let tells = |source: &str| INVERSE.iter().any(|f| source.contains(f));
                // Functions are regions of their own.
                let is_inverse = match &region.function {
                    Some(function) => tells(&text[function.clone()]),
                    None => {
                        let starts = functions.iter().map(|f| f.start).chain([span.end]);
                        let ends = std::iter::once(span.start).chain(functions.iter().map(|f| f.end));
                        ends.zip(starts).any(|(a, b)| a < b && tells(&text[a..b]))
                    }
                };
                if is_inverse {
                    is_any = true;
                    posed.push(whole);
                }
                continue;
            }
            is_any = true;
            // What a root is multiplied by is 1 or −1.
            let body: String = text[whole.clone()].chars().filter(|c| !c.is_whitespace()).collect();
            let parameters = region.parameters.iter().take(MAX_PARAMETERS);
            let factors: Vec<String> = parameters.filter(|p| is_factor_of_root(&body, p)).cloned().collect();
            let mut region = region;
            region.signs.extend(factors);
            let source = &program[whole.clone()];
            let uses = names_in(source).any(|w| turned.constants.names().any(|c| c == w));
            let conversions = match turned.angles(region.function.as_ref()) {
                Angles::Radians if !uses => Conversions::default(),
                _ => turned.constants.clone(),
            };
            let mut units = Units::new(&conversions, is_joint);
            let plain = Region::new(None, vec![], vec![]);
            let mut holds = |part: &(String, Range<usize>)| {
                let formula = spelled(&text[part.1.clone()], &plain, *language);
                let formula = branches(&formula).unwrap_or(formula).replace('±', "-");
                says_nothing(&part.0, &formula) || formula.split(" or ").all(|f| units.hold_in(&part.0, f))
            };
            if !conversions.is_empty() && !region.lines.iter().flat_map(|l| &l.parts).all(&mut holds) {
                // Some angles are in degrees and others are not, or it is not known which.
                let of = |l: &Line| {
                    (l.span.start..l.end, l.parts.first().map(|p| p.0.clone()).unwrap_or_default())
                };
                unread.extend(region.lines.iter().map(of));
                cleared(&mut kept, region.function);
                continue;
            }
            region.conversions = conversions.clone();
            // What goes by vectors and matrices is followed as a program.
            let mut known = region.parameters.clone();
            known.extend(poses(text, &region.lines));
            let signs = region.signs.iter().filter(|n| !is_known(n)).cloned().collect();
            let conversions = conversions.clone();
            let telling = Region { conversions, ..Region::new(None, known, signs) };
            let mut lost: BTreeSet<String> = BTreeSet::new();
            let is_cut = |line: &Line, lost: &mut BTreeSet<String>| {
                line.is_lost(text, &telling, *language, lost) && line.parts.iter().any(|p| is_joint(&p.0))
            };
            let words = |l: &Line| -> BTreeSet<String> {
                let source = l.parts.iter().map(|p| &text[p.1.clone()]);
                source.flat_map(|s| names_in(s).map(String::from).collect::<Vec<_>>()).collect()
            };
            let is_foreign = |w: &String| {
                let is_own =
                    own.contains(w) || DIRECTIONS.contains(&w.as_str()) && region.parameters.contains(w);
                is_own && !is_known(w)
            };
            let has_own =
                region.function.is_some() && region.lines.iter().any(|l| words(l).iter().any(is_foreign));
            // Several solutions for one joint, `th3a`, `th3b`.
            let is_variant = |p: &(String, Range<usize>)| {
                let stem = p.0.strip_suffix(['a', 'b', 'A', 'B']).unwrap_or_default();
                let number = stem.trim_end_matches(|c: char| c.is_ascii_digit());
                number.len() < stem.len()
                    && is_joint(stem)
                    && !is_joint(&p.0)
                    && INVERSE.iter().any(|f| text[p.1.clone()].contains(f))
            };
            let has_variants = region.lines.iter().flat_map(|l| &l.parts).any(is_variant);
            if has_own || has_variants || region.lines.iter().filter(|l| is_cut(l, &mut lost)).count() > 0 {
                posed.push(whole);
                cleared(&mut kept, region.function);
                continue;
            }
            region.parameters.extend(poses(text, &region.lines));
            let mut lost: BTreeSet<String> = BTreeSet::new();
            let lines = std::mem::take(&mut region.lines);
            for line in &lines {
                if line.is_lost(text, &region, *language, &mut lost) {
                    let name = line.parts.first().map(|p| p.0.clone()).unwrap_or_default();
                    unread.push((line.span.start..line.end, name));
                    continue;
                }
                region.rename(text, line, *language);
                for (span, bytes) in line.written(text, &region, *language) {
                    // One statement a line.
                    let start = text[..span.start].rfind('\n').map_or(0, |i| i + 1);
                    let end = text[span.end..].find('\n').map_or(text.len(), |i| span.end + i);
                    let is_free = |a: &Vec<u8>| a[start..end].iter().all(|b| *b == b' ');
                    let k = alone.iter().position(is_free).unwrap_or(alone.len());
                    if k >= MAX_BESIDE {
                        continue;
                    }
                    if alone.len() <= k {
                        alone.push(blank.clone());
                    }
                    respelled[span.clone()].copy_from_slice(&bytes);
                    alone[k][span].copy_from_slice(&bytes);
                }
            }
            cleared(&mut kept, region.function);
        }
    }
    if !is_any {
        return None;
    }
    let [respelled, kept] = [respelled, kept].map(|b| String::from_utf8(b).ok());
    let mut statements = vec![];
    for bytes in alone {
        statements.extend(document::read(&String::from_utf8(bytes).ok()?, Format::Plain).statements);
    }
    statements.sort_by_key(|s| s.span.start);
    Some(Scripts { text: respelled?, programs: kept?, statements, posed, lost: unread })
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
    let is_own = plain.trim_matches(['(', ')']) == name;
    is_number || is_entry || is_own || plain.contains(['[', '{', '"', '\''])
}

/// The functions of a program, and what stands outside of them.
fn regions(text: &str, span: &Range<usize>, language: Dialect) -> Vec<Region> {
    let mut found = vec![Region::new(None, vec![], vec![])];
    // The function that is open, and how far it is set in.
    let mut open: Option<(usize, usize)> = None;
    let (mut is_quoted, mut is_remark, mut is_other) = (false, false, false);
    let (mut braces, mut was_open) = (0_i32, false);
    let mut at = span.start;
    while at < span.end {
        let (line, next) = logical(text, at, span.end, language);
        // Comments of several lines are none of the program.
        let whole = &text[at..next.min(span.end)];
        at = next;
        if language == Dialect::C {
            let was_remark = is_remark;
            is_remark = match (whole.rfind("/*"), whole.rfind("*/")) {
                (Some(opened), Some(closed)) => opened > closed,
                (None, None) => is_remark,
                (opened, _) => opened.is_some(),
            };
            if was_remark {
                continue;
            }
        }
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
                || language == Dialect::Matlab && trimmed.starts_with("function")
                || language == Dialect::C && braces <= 0 && was_open)
        {
            open = None;
        }
        let opened = source.matches('{').count() as i32 - source.matches('}').count() as i32;
        if let Some((parameters, signs)) =
            head(trimmed, language).filter(|_| open.is_none() || language != Dialect::C)
        {
            (braces, was_open) = (opened, source.contains('{'));
            let function = Some(line.start..line.end);
            found.push(Region::new(function, parameters, signs));
            open = Some((found.len() - 1, indent));
            continue;
        }
        braces += opened;
        // The bracket may stand on a line of its own.
        was_open |= source.contains('{');
        let region = &mut found[open.map_or(0, |o| o.0)];
        if let Some(function) = &mut region.function {
            function.end = line.end;
        }
        region.signs.extend(sign_of_loop(trimmed));
        if trimmed.starts_with("else") || trimmed.starts_with("} else") {
            is_other = true;
        }
        for part in statements_of(text, &line, language) {
            let Some(new) = assigned(text, &part, next) else { continue };
            region.push(new, text, is_other);
            is_other = false;
        }
    }
    found
}

/// A line with those that go on inside its brackets, without the comment; and where the next one begins.
fn logical(text: &str, start: usize, end: usize, language: Dialect) -> (Range<usize>, usize) {
    let mark = comment_mark(language);
    let (mut depth, mut cut) = (0_i32, None);
    for (i, c) in text[start..end].char_indices() {
        match c {
            '{' | '}' if language == Dialect::C => {}
            '(' | '[' | '{' if cut.is_none() => depth += 1,
            ')' | ']' | '}' if cut.is_none() => depth -= 1,
            '\n' if depth <= 0 || cut.is_some() => {
                return (start..cut.unwrap_or(start + i), start + i + 1);
            }
            _ if cut.is_none() && text[start + i..].starts_with(mark) => cut = Some(start + i),
            '/' if cut.is_none() && language == Dialect::C && text[start + i..].starts_with("/*") => {
                cut = Some(start + i);
            }
            _ => {}
        }
    }
    (start..cut.unwrap_or(end), end)
}

/// The parameters of a function, and those of them that are 1 or −1 by default.
fn head(line: &str, language: Dialect) -> Option<(Vec<String>, Vec<String>)> {
    let word = match language {
        Dialect::Python => "def ",
        Dialect::Matlab => "function ",
        Dialect::C => "",
    };
    let rest = line.strip_prefix(word)?;
    if language == Dialect::C {
        let before = rest.split_once('(')?.0.trim();
        let is_head = before.split_whitespace().count() > 1
            && !before.contains(['=', ';'])
            && !before.starts_with("else")
            && !before.starts_with("return")
            && !rest.contains(';');
        if !is_head {
            return None;
        }
    }
    let rest = if language == Dialect::Matlab { rest.split_once('=').map_or(rest, |r| r.1) } else { rest };
    let inside = rest.split_once('(').map_or("", |r| r.1).rsplit_once(')').map_or("", |r| r.0);
    let (mut parameters, mut signs) = (vec![], vec![]);
    for parameter in inside.split(',') {
        let (name, default) = parameter.split_once('=').unwrap_or((parameter, ""));
        let name = name.split(':').next().unwrap_or_default().trim();
        let name = match language {
            Dialect::C => name.split(['[', ']']).next().and_then(|n| n.rsplit([' ', '*', '&']).next()),
            _ => Some(name),
        };
        let name = name.unwrap_or_default().to_string();
        let lower = name.to_lowercase();
        let is_called = || is_sign_name(&lower) && default.trim().is_empty();
        if matches!(default.trim(), "1" | "-1" | "+1" | "1.0" | "-1.0") || is_called() {
            signs.push(name.clone());
        }
        parameters.push(name);
    }
    Some((parameters, signs))
}

/// The parts between commas outside of brackets, without blanks around them.
fn split(text: &str, span: &Range<usize>) -> Vec<Range<usize>> {
    let (mut depth, mut start, mut found) = (0_i32, span.start, vec![]);
    for (i, c) in text[span.clone()].char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => {
                found.push(start..span.start + i);
                start = span.start + i + 1;
            }
            _ => {}
        }
    }
    found.push(start..span.end);
    let trim = |s: Range<usize>| {
        let source = &text[s.clone()];
        let from = s.start + (source.len() - source.trim_start().len());
        from..from + source.trim().len()
    };
    found.into_iter().map(trim).collect()
}

/// A statement `name = formula`; `next` is where the next line begins.
fn assigned(text: &str, line: &Range<usize>, next: usize) -> Option<Line> {
    let source = &text[line.clone()];
    let equals = source.find('=')?;
    let rest = &source[equals + 1..];
    if rest.starts_with('=') || source[..equals].ends_with(['!', '<', '>', '+', '-', '*', '/', '~']) {
        return None;
    }
    let left = line.start..line.start + equals;
    let names = split(text, &left);
    let formula = line.start + equals + 1;
    let body = rest.trim_end().trim_end_matches([';', ',']).trim_end();
    let right = formula..formula + body.len();
    let formulas = if names.len() > 1 { split(text, &right) } else { vec![right] };
    if names.len() != formulas.len() {
        return None;
    }
    let mut parts = vec![];
    let mut start = line.end;
    for (name, formula) in names.iter().zip(formulas) {
        // `double x`, `*t1`, `q->tilt`, `self.d1`
        let last = text[name.clone()].rsplit([' ', '*', '.', '>']).next()?.to_string();
        let is_name =
            last.starts_with(char::is_alphabetic) && last.chars().all(|c| c.is_alphanumeric() || c == '_');
        if !is_name {
            return None;
        }
        start = start.min(name.end - last.len());
        parts.push((last, formula));
    }
    let end = parts.last().map_or(line.end, |p| p.1.end);
    // What stands behind on the line may be written over.
    let behind = text[line.end..next.min(text.len())].trim_end_matches(['\n', '\r']);
    let is_free = !behind.contains('=') && !text[end..line.end].contains('=');
    let whole = if is_free && !behind.contains('{') { line.end + behind.len() } else { end };
    Some(Line { span: start..whole.max(end), end, parts, is_signed: false })
}

impl Region {
    /// Notes a coordinate of the hand that is made one of another point.
    fn rename(&mut self, text: &str, line: &Line, language: Dialect) {
        let [(name, formula)] = &line.parts[..] else { return };
        let now = spelled(&text[formula.clone()], self, language);
        let is_own = matches!(name.as_str(), "px" | "py" | "pz") && now.trim() != name;
        let uses = |w: &str| now.split(|c: char| !c.is_alphanumeric() && c != '_').any(|x| x == w);
        if is_own && uses(name) && !self.renamed.contains(name) {
            self.renamed.push(name.clone());
        }
    }

    /// One more statement: `s2 = -s2` under a condition gives the one before both signs, and so do two branches that differ
    /// in their sign.
    fn push(&mut self, new: Line, text: &str, is_other: bool) {
        let formula = |line: &Line| {
            let [(_, formula)] = &line.parts[..] else { return String::new() };
            text[formula.clone()].chars().filter(|c| !c.is_whitespace()).collect::<String>()
        };
        let (Some((name, _)), own) = (new.parts.first(), formula(&new)) else { return };
        let before = self.lines.iter_mut().rev().find(|l| l.parts.len() == 1 && l.parts[0].0 == *name);
        if let Some(before) = before {
            let other = formula(before);
            let is_negated = own == format!("-{name}");
            let is_opposite = is_other && (own == format!("-{other}") || other == format!("-{own}"));
            if is_negated || is_opposite {
                before.is_signed = true;
                return;
            }
        }
        self.lines.push(new);
    }
}

/// Names of the pose in a script, given as numbers or as a part of another: `T06 = [0.5 …]`, `R = T06(1:3,1:3)`.
fn poses(text: &str, lines: &[Line]) -> Vec<String> {
    let is_given = |n: &&str| !lines.iter().any(|l| l.parts.iter().any(|p| p.0 == **n));
    let mut found: Vec<String> =
        ["T", "T06", "R"].iter().filter(|n| is_given(n)).map(|n| n.to_string()).collect();
    for line in lines {
        let [(name, formula)] = &line.parts[..] else { continue };
        let source = text[formula.clone()].trim();
        let is_pose =
            matches!(name.trim_end_matches(|c: char| c.is_ascii_digit()), "T" | "H" | "T_" | "Td" | "T_d")
                || matches!(name.as_str(), "T_goal" | "Tgoal" | "T_des" | "Tdes" | "T_target");
        let plain = ["np.array(", "array(", "np.matrix(", "sp.Matrix(", "Matrix("];
        let inner = plain.iter().find_map(|p| source.strip_prefix(p)).unwrap_or(source);
        let is_numbers = inner.starts_with('[')
            && inner.chars().all(|c| c.is_ascii_digit() || c.is_whitespace() || "[](){},;.-+e".contains(c));
        let base = source.split(['(', '[']).next().unwrap_or_default();
        let is_part = found.iter().any(|f| f == base) || matches!(base, "T" | "T06");
        let is_rotation =
            is_part && source[base.len()..].matches([':', '3']).count() >= 2 && name.starts_with('R');
        if is_pose && is_numbers || is_rotation {
            found.push(name.clone());
        }
    }
    found
}

impl Line {
    /// True for a statement that is not read here, and for one that uses what such a one gives.
    fn is_lost(&self, text: &str, region: &Region, language: Dialect, lost: &mut BTreeSet<String>) -> bool {
        let mut is_any = false;
        for (name, formula) in &self.parts {
            let now = spelled(&text[formula.clone()], region, language);
            let uses = |w: &str| lost.contains(w);
            let is_number = now.trim().trim_start_matches(['-', '+']).parse::<f64>().is_ok();
            let is_array = now.contains(['[', '{', '"', '\'', ':']) || now.contains(".T");
            let is_call = now.match_indices('(').any(|(i, _)| {
                let word =
                    now[..i].rsplit(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default();
                !word.is_empty() && !KNOWN.contains(&word)
            });
            let words = now.split(|c: char| !c.is_alphanumeric() && c != '_');
            let is_used = words.into_iter().any(uses);
            if !is_number && (is_array || is_call || is_used) && !region.parameters.contains(name) {
                is_any = true;
            }
        }
        for (name, _) in &self.parts {
            if is_any {
                lost.insert(name.clone());
            } else {
                lost.remove(name);
            }
        }
        is_any
    }

    /// What is written in place, statement by statement.
    fn written(&self, text: &str, region: &Region, language: Dialect) -> Vec<(Range<usize>, Vec<u8>)> {
        let mut found = vec![];
        if let ([(name, formula)], false) = (&self.parts[..], self.is_signed) {
            let now = spelled(&text[formula.clone()], region, language);
            let changed = branches(&now);
            if changed.as_deref().is_none_or(|c| c.len() <= now.len()) && !now.contains("hypot") {
                let now = changed
                    .map_or(now.clone(), |c| format!("{c:0$}", now.len() - (c.len() - c.chars().count())));
                if now.len() == formula.len() && !says_nothing(name, &now) {
                    let mut head = text[self.span.start..formula.start].to_string();
                    let (mut now, is_renamed) = (now, region.renamed.contains(name));
                    let is_own = defines(&now, name);
                    for other in region.renamed.iter().filter(|r| *r != name || !is_own) {
                        now = renamed(&now, other);
                    }
                    if is_renamed {
                        head = renamed(&head, name);
                    }
                    found.push((self.span.start..formula.end, head.bytes().chain(now.bytes()).collect()));
                }
                return found;
            }
        }
        // Packed from the beginning of the statement on.
        let mut at = self.span.start;
        for (name, formula) in &self.parts {
            let now = spelled(&text[formula.clone()], region, language);
            let now = roots(&branches(&now).unwrap_or_else(|| squeezed(&now)));
            if says_nothing(name, &now) {
                continue;
            }
            let sign = match self.is_signed {
                true => now.strip_prefix('-').map_or(format!("±{now}"), |n| format!("±{n}")),
                false => now,
            };
            let bytes = format!("{name}={sign}").into_bytes();
            let end = at + bytes.len();
            if end > self.span.end.max(self.end) {
                break;
            }
            found.push((at..end, bytes));
            at = end + 1;
        }
        // What is left of the old statement.
        if let Some((last, bytes)) = found.last_mut()
            && last.end < self.end
        {
            bytes.resize(bytes.len() + self.end - last.end, b' ');
            last.end = self.end;
        }
        found
    }
}
