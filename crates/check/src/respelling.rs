//! Ways of writing that are turned into those that are read, byte for byte: each place stays where it is.

use super::components;
use super::displayed;
use super::languages;
use super::macros;
use super::signs;
use denavit_reading::code::Dialect;
use std::borrow::Cow;
use std::ops::Range;

/// Where commas are those of numbers, there are so many for each point between digits.
const COMMAS_A_POINT: usize = 4;
/// The most blanks between a word and the number behind it.
const MAX_BLANKS: usize = 3;

/// A text as it is read.
pub(super) fn respelled(text: &str, language: Option<Dialect>) -> Cow<'_, str> {
    let is_program = language.is_some();
    let mut text = Cow::Borrowed(text);
    let other = match language {
        Some(Dialect::C) => languages::as_c(&text),
        Some(Dialect::Matlab) => languages::as_matlab(&text),
        _ => None,
    };
    if let Some(now) = other {
        text = Cow::Owned(now);
    }
    let of_all: [fn(&str) -> Option<String>; 1] = [decimal_points];
    if let Some(now) = units_without_brackets(&text, is_program) {
        text = Cow::Owned(now);
    }
    let of_prose: [fn(&str) -> Option<String>; 19] = [
        macros::written_out,
        macros::values_in_tables,
        without_french_blanks,
        without_quotes,
        without_speakers,
        small_functions,
        without_asides,
        apart_by_blanks,
        rates_by_primes,
        alternatives_by_primes,
        signs::words_as_signs,
        signs::commas_in_calls,
        signs::names_behind,
        conjunctions,
        columns_by_words,
        torques_by_words,
        displayed::bracketed,
        components::with_frames,
        signs::values_of_dictionaries,
    ];
    if let Some(now) = script_without_head(&text).filter(|_| is_program) {
        text = Cow::Owned(now);
    }
    let count = if is_program { 0 } else { of_prose.len() };
    for respell in of_all.iter().chain(&of_prose[..count]) {
        if let Some(now) = respell(&text) {
            text = Cow::Owned(now);
        }
    }
    text
}

/// A MATLAB function that takes and gives nothing, the only one of its file, is a script: without its head and its end; nothing for
/// other texts.
fn script_without_head(text: &str) -> Option<String> {
    let code = |line: &Range<usize>| {
        let source = text.get(line.clone()).unwrap_or_default().trim();
        (!source.is_empty() && !source.starts_with('%')).then_some(source)
    };
    let all: Vec<Range<usize>> = super::lines::lines(text).collect();
    let first = all.iter().find(|l| code(l).is_some())?;
    let head = code(first)?.strip_prefix("function ")?.trim();
    let name = head.strip_suffix("()").unwrap_or(head);
    let is_plain = name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let is_alone = !all.iter().any(|l| l != first && code(l).is_some_and(|c| c.starts_with("function ")));
    if !is_plain || !is_alone {
        return None;
    }
    let last = all.iter().rev().find(|l| code(l).is_some()).filter(|l| code(l) == Some("end"));
    let mut bytes = text.as_bytes().to_vec();
    for line in [Some(first), last].into_iter().flatten() {
        bytes[line.clone()].iter_mut().filter(|b| !b.is_ascii_whitespace()).for_each(|b| *b = b' ');
    }
    String::from_utf8(bytes).ok()
}

/// A text with points in its numbers, where they have commas, byte for byte.
pub(super) fn with_points(text: &str) -> Cow<'_, str> {
    decimal_points(text).map_or(Cow::Borrowed(text), Cow::Owned)
}

/// A text with a blank for the `~` that French has before a semicolon or a colon in LaTeX; nothing for other texts.
fn without_french_blanks(text: &str) -> Option<String> {
    let marks = ["~;", "~:"];
    marks.iter().any(|m| text.contains(m)).then(|| text.replace("~;", " ;").replace("~:", " :"))
}

/// The lines with an `=` in them that are no longer than people write, each with its place.
fn lines_with_equations(text: &str) -> impl Iterator<Item = (usize, &str)> {
    const LONGEST: usize = 2_000;
    let lines = super::lines::lines(text).map(|line| (line.start, text.get(line).unwrap_or_default()));
    lines.filter(|(_, source)| source.len() <= LONGEST && source.contains('='))
}

/// A text without the `>` before lines that are quoted, two in a row at least; nothing for other texts.
fn without_quotes(text: &str) -> Option<String> {
    let lines: Vec<Range<usize>> = super::lines::lines(text).collect();
    let marks = |line: &Range<usize>| -> usize {
        let source = text.get(line.clone()).unwrap_or_default();
        let rest = source.trim_start_matches(['>', ' ']);
        let length = source.len() - rest.len();
        if source.trim_start().starts_with('>') { length } else { 0 }
    };
    let all: Vec<usize> = lines.iter().map(marks).collect();
    let is_quoted = |k: usize| {
        let is_beside = |k: Option<usize>| k.and_then(|k| all.get(k)).is_some_and(|m| *m > 0);
        all[k] > 0 && (is_beside(k.checked_sub(1)) || is_beside(Some(k + 1)))
    };
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for (k, line) in lines.iter().enumerate().filter(|(k, _)| is_quoted(*k)) {
        bytes[line.start..line.start + all[k]].fill(b' ');
        is_any = true;
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text without the times and names before what people say in a chat, `[12.05., 21:20] Kofi: x2 = …`, if three lines have them;
/// nothing for other texts.
fn without_speakers(text: &str) -> Option<String> {
    const LONGEST: usize = 60;
    let head = |line: &str| -> Option<usize> {
        let inner = line.strip_prefix('[')?;
        let close = inner.find(']').filter(|c| *c < LONGEST)?;
        let is_time = inner[..close].contains(':') && inner[..close].contains(|c: char| c.is_ascii_digit());
        let rest = &inner[close + 1..];
        let colon = rest.find(':').filter(|c| *c < LONGEST)?;
        let is_name = rest[..colon].trim().chars().all(|c| c.is_alphanumeric() || " ._-".contains(c));
        (is_time && is_name && !rest[..colon].trim().is_empty()).then_some(close + colon + 3)
    };
    let lines = super::lines::lines(text);
    let heads: Vec<Range<usize>> =
        lines.filter_map(|line| Some(line.start..line.start + head(text.get(line.clone())?)?)).collect();
    let mut bytes = text.as_bytes().to_vec();
    heads.iter().for_each(|h| bytes[h.clone()].fill(b' '));
    if heads.len() >= 3 { String::from_utf8(bytes).ok() } else { None }
}

/// A text with small letters for functions in capitals, `S*COS(A)`, `XDOT`; nothing for other texts.
fn small_functions(text: &str) -> Option<String> {
    const FUNCTIONS: [&str; 9] = ["ATAN2", "ATAN", "ACOS", "ASIN", "SQRT", "COS", "SIN", "TAN", "DET"];
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for (start, source) in lines_with_equations(text) {
        let is_word_at = |at: usize, length: usize| {
            let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '\\';
            !source[..at].ends_with(is_part) && !source[at + length..].starts_with(is_part)
        };
        for (at, function) in FUNCTIONS.iter().flat_map(|f| source.match_indices(f)) {
            let rest = source[at + function.len()..].trim_start();
            let is_function = match function {
                "DET" => rest.starts_with('='),
                _ => rest.starts_with('('),
            };
            if is_function && is_word_at(at, function.len()) {
                bytes[start + at..start + at + function.len()].make_ascii_lowercase();
                is_any = true;
            }
        }
        for (at, _) in source.match_indices("DOT") {
            let before = source[..at].ends_with(|c: char| c.is_ascii_alphanumeric());
            let behind = source[at + 3..].starts_with(|c: char| c.is_alphanumeric() || c == '_');
            if before && !behind {
                bytes[start + at..start + at + 3].make_ascii_lowercase();
                is_any = true;
            }
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text without the numbers in brackets behind others, `x = 160.0 (161), y = …`: they are measured, rounded or of another
/// source; nothing for other texts.
fn without_asides(text: &str) -> Option<String> {
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for (start, source) in lines_with_equations(text) {
        for (open, _) in source.match_indices(" (") {
            let open = open + 1;
            let Some(close) = source[open..].find(')').map(|i| open + i) else { break };
            let inner = source[open + 1..close].trim();
            let behind = source[close + 1..].trim_start();
            let is_end = behind.is_empty() || behind.starts_with([',', ';', '.']);
            let is_number = |s: &str| s.trim_start_matches(['-', '−', '+']).parse::<f64>().is_ok();
            let before = source[..open].trim_end();
            let word = before.rsplit([' ', '=']).next().unwrap_or_default();
            if is_end && is_number(inner) && is_number(word) {
                bytes[start + open..=start + close].fill(b' ');
                is_any = true;
            }
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text with commas between statements that blanks set apart, `X = 250.0   Y = 200.0`; nothing for other texts.
fn apart_by_blanks(text: &str) -> Option<String> {
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for line in super::lines::lines(text) {
        let source = text.get(line.clone()).unwrap_or_default();
        let has_two = source.bytes().filter(|b| *b == b'=').take(2).count() == 2;
        if !has_two || source.len() > 2_000 || source.contains(['[', '|', '&', '\\']) {
            continue;
        }
        let mut told = 0;
        for (equals, _) in source.match_indices('=') {
            let left = source[told..equals].trim_end_matches(' ');
            told = equals + 1;
            let Some(gap) = left.rfind("  ") else { continue };
            let (before, name) = (left[..gap].trim_end_matches(' '), left[gap..].trim_start());
            let is_name = name.starts_with(char::is_alphabetic)
                && name.chars().count() < 12
                && name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '\'' | '(' | ')'));
            let is_number = before.rsplit([' ', '=']).next().is_some_and(|n| n.parse::<f64>().is_ok());
            if is_name && is_number && source[..equals].contains('=') {
                let at = line.start + (before.as_ptr() as usize - source.as_ptr() as usize) + before.len();
                bytes[at] = b',';
                is_any = true;
            }
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text with `0.45  m ` for `0.45 (m)` and without the unit behind a formula, `l1 s2   (mm^2)`, at the end of a line or before a
/// comma; nothing for other texts. In a program this is said of comments alone.
fn units_without_brackets(text: &str, is_program: bool) -> Option<String> {
    const UNITS: [&str; 30] = [
        "mm", "m", "cm", "in", "rad", "deg", "°", "N", "kN", "Nm", "N m", "N*m", "N·m", "mm^2", "mm²", "m^2",
        "m²", "mm^3", "mm³", "m^3", "m³", "in^3", "in^2", "cm^2", "cm^3", "m/s", "mm/s", "rad/s", "deg/s",
        "°/s",
    ];
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for line in super::lines::lines(text) {
        let source = text.get(line.clone()).unwrap_or_default();
        let is_comment =
            source.trim_start().starts_with(['#', '%', '*']) || source.trim_start().starts_with("//");
        if !source.contains('=') || source.len() > 2_000 || is_program && !is_comment {
            continue;
        }
        for (open, _) in source.match_indices('(') {
            let Some(close) = source[open..].find(')').map(|i| open + i) else { break };
            let inner = source[open + 1..close].trim();
            let behind = source[close + 1..].trim_start();
            let is_end = behind.is_empty() || behind.starts_with([',', ';', '.', '|']);
            let before = source[..open].trim_end();
            let is_apart = before.len() < open && before.contains('=') && !before.ends_with('=');
            if !is_end || !is_apart || !UNITS.contains(&inner) {
                continue;
            }
            let value = before.rsplit(['=', ',']).next().unwrap_or_default();
            let is_number =
                value.trim().trim_start_matches(['-', '−', '+']).replace(',', ".").parse::<f64>().is_ok();
            bytes[line.start + open] = b' ';
            bytes[line.start + close] = b' ';
            if !is_number {
                bytes[line.start + open..line.start + close].fill(b' ');
            }
            is_any = true;
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text with a comma for the one letter that joins two values, `e = 0.1 m e g = 0.15 m`; nothing for other texts.
fn conjunctions(text: &str) -> Option<String> {
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for (start, source) in lines_with_equations(text) {
        for word in [" e ", " y ", " i ", " a ", " u "] {
            for (at, _) in source.match_indices(word) {
                let Some((_, value)) = source[..at].rsplit_once('=') else { continue };
                let value = value.trim().trim_end_matches(['m', '°', 'c', ' ', '$']);
                let behind = source[at + word.len()..].trim_start_matches(['$', '\\']);
                let name = behind.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '{' | '}')));
                let is_next = name
                    .is_some_and(|n| n > 0 && n < 16 && behind[n..].trim_start_matches(' ').starts_with('='));
                if is_next && value.parse::<f64>().is_ok() {
                    bytes[start + at + 1] = b',';
                    is_any = true;
                }
            }
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text with `J_2` for `column 2` and for `J(:,2)` before an `=`; nothing for other texts.
fn columns_by_words(text: &str) -> Option<String> {
    const WORDS: [&str; 10] = [
        "column ", "spalte ", "colonne ", "columna ", "coluna ", "colonna ", "kolom ", "kolumna ",
        "sloupec ", "j(:,",
    ];
    // Byte for byte, as places are of the text.
    let lower = text.to_ascii_lowercase();
    if !lower.contains("jacobi") {
        return None;
    }
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for word in WORDS {
        for (at, _) in lower.match_indices(word) {
            let rest = &lower[at + word.len()..];
            let Some(number) = rest.chars().next().filter(|c| ('1'..='9').contains(c)) else { continue };
            let close = usize::from(word.ends_with(','));
            let behind = &rest[1..];
            let is_closed = close == 0 || behind.starts_with(')');
            let is_part = lower[..at].ends_with(char::is_alphanumeric);
            let behind = behind.get(close..).unwrap_or_default();
            if is_part || !is_closed || !behind.trim_start_matches([' ', '$', '*']).starts_with('=') {
                continue;
            }
            let end = at + word.len() + 1 + close;
            bytes[at..end].fill(b' ');
            bytes[at..at + 2].copy_from_slice(b"J_");
            bytes[at + 2] = number as u8;
            is_any = true;
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text with `τ_2` for the words of `force 2 = 78 N` at the beginning of a line; nothing for other texts.
fn torques_by_words(text: &str) -> Option<String> {
    const WORDS: [&str; 14] = [
        "torque",
        "moment",
        "force",
        "couple",
        "effort",
        "drehmoment",
        "kraft",
        "coppia",
        "forza",
        "par",
        "fuerza",
        "binário",
        "força",
        "koppel",
    ];
    // A force may be any; beside a torque it is that of a slide.
    const TORQUES: [&str; 6] = ["torque", "couple", "drehmoment", "coppia", "binário", "koppel"];
    let lower = text.to_lowercase();
    let speaks = TORQUES.iter().any(|w| lower.contains(w));
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for line in super::lines::lines(text).filter(|_| speaks) {
        let source = text.get(line.clone()).unwrap_or_default();
        let own = source.trim_start_matches([' ', '\t', '-', '*', '•']);
        let word: String = own.chars().take_while(|c| c.is_alphabetic()).take(12).collect();
        let behind = &own[word.len()..];
        let number = behind.trim_start_matches(' ');
        let blanks = behind.len() - number.len();
        let is_word = WORDS.contains(&word.to_lowercase().as_str()) && (1..=MAX_BLANKS).contains(&blanks);
        let is_told = number.starts_with(|c: char| ('1'..='9').contains(&c))
            && number[1..].trim_start_matches(' ').starts_with('=');
        if !is_word || !is_told {
            continue;
        }
        let start = line.end - own.len();
        let end = start + word.len() + blanks + 1;
        let name = format!("τ_{}", &number[..1]);
        if name.len() <= end - start {
            bytes[start..end].fill(b' ');
            bytes[start..start + name.len()].copy_from_slice(name.as_bytes());
            is_any = true;
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text that writes a half as `0,5` or `0{,}5` with points instead, byte for byte; nothing for other texts.
fn decimal_points(text: &str) -> Option<String> {
    let pointed = pointed(text);
    let source = pointed.as_deref().unwrap_or(text);
    if source.contains("{,}") { Some(without_braces(source)) } else { pointed }
}

/// A text with points for the commas between digits, where these are those of numbers.
fn pointed(text: &str) -> Option<String> {
    let bytes = text.as_bytes();
    let is_digit = |k: usize| bytes.get(k).is_some_and(u8::is_ascii_digit);
    let mut commas = vec![];
    // `0,45 m` is a number.
    let mut has_unit = false;
    // `Exercise 2.6` among numbers with commas.
    let mut points = 0;
    let drawn = drawings(text);
    // `0{,}5` in formulas: then commas are those of numbers in the words, too, whatever else has points.
    // Groups of three digits alone are thousands.
    let in_braces = |at: &usize| *at > 0 && is_digit(at - 1) && is_digit(at + "{,}".len());
    let told: Vec<usize> = text.match_indices("{,}").map(|m| m.0).filter(in_braces).collect();
    let is_decimal = |at: &usize| {
        let behind = at + "{,}".len();
        let digits = (behind..bytes.len()).take_while(|&k| is_digit(k)).count();
        digits != 3 || bytes[at - 1] == b'0' && (*at < 2 || !is_digit(at - 2))
    };
    let is_told = told.len() > 2 && told.iter().any(is_decimal);
    for (k, b) in bytes.iter().enumerate() {
        if k == 0 || !is_digit(k - 1) || !is_digit(k + 1) || drawn.iter().any(|d| d.contains(&k)) {
            continue;
        }
        match b {
            b'.' => points += 1,
            b',' => {
                let start = (0..k).rev().take_while(|&i| is_digit(i)).last().unwrap_or(k);
                let end = (k + 1..bytes.len()).take_while(|&i| is_digit(i)).last().unwrap_or(k);
                let before = start.checked_sub(1).and_then(|i| bytes.get(i));
                // `T_{0,6}`, `r(1,2)`, `1,2,3`; `0.5,0.3`
                let is_index = matches!(before, Some(b'{' | b'_' | b',' | b'.'))
                    || matches!(bytes.get(end + 1), Some(b',' | b'.')) && is_digit(end + 2);
                let is_pair = before == Some(&b'(') && bytes.get(end + 1) == Some(&b')');
                if is_index || is_pair {
                    if is_told {
                        continue;
                    }
                    return None;
                }
                // `[0,1]` is a row or an interval.
                points += usize::from(before == Some(&b'[') && bytes.get(end + 1) == Some(&b']'));
                let unit = text.get(end + 1..).unwrap_or_default().trim_start_matches(' ');
                let word = unit.split(|c: char| !c.is_alphanumeric() && c != '°').next().unwrap_or_default();
                has_unit |= matches!(word, "m" | "mm" | "cm" | "rad" | "°" | "kg" | "N" | "Nm");
                commas.push(k);
            }
            _ => {}
        }
    }
    if !is_told && (commas.len() < 3 && !has_unit || commas.len() < COMMAS_A_POINT * points)
        || commas.is_empty()
    {
        return None;
    }
    let mut bytes = text.as_bytes().to_vec();
    commas.into_iter().for_each(|k| bytes[k] = b'.');
    String::from_utf8(bytes).ok()
}

/// Where pictures stand whose coordinates are those of a program.
fn drawings(text: &str) -> Vec<Range<usize>> {
    const MAX_DRAWINGS: usize = 200;
    let (begin, end) = ("\\begin{tikzpicture}", "\\end{tikzpicture}");
    let whole = |(at, _): (usize, &str)| at..text[at..].find(end).map_or(text.len(), |i| at + i);
    text.match_indices(begin).take(MAX_DRAWINGS).map(whole).collect()
}

/// A text that writes joint rates as `θ1'`, with `dθ1` instead, byte for byte; nothing for other texts.
fn rates_by_primes(text: &str) -> Option<String> {
    let has_dots = text.contains("\\dot") || text.contains('\u{307}');
    if has_dots || !super::letters::speaks_of_speed(text) {
        return None;
    }
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    let (mut seen, mut is_program) = (0, false);
    for (at, prime) in text.match_indices(['\'', '′']) {
        if prime.len() > 1 {
            continue;
        }
        let before = &text[..at];
        // In a program a prime transposes, or begins a text.
        is_program ^= text[seen..at].matches("```").count() % 2 == 1;
        seen = at;
        if is_program {
            continue;
        }
        let number = before.trim_end_matches(|c: char| c.is_ascii_digit() || ('₀'..='₉').contains(&c));
        let name = number.trim_end_matches(|c: char| c.is_alphabetic());
        let letters = number[name.len()..].chars().count();
        let is_word = name.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        if number.len() == before.len() || !(1..=5).contains(&letters) || is_word {
            continue;
        }
        let start = name.len();
        bytes.copy_within(start..at, start + 1);
        bytes[start] = b'd';
        is_any = true;
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text in which the other value of a joint has a prime, `θ_1' = θ_1 + π`, without these, byte for byte: both are values of the
/// joint; nothing for other texts.
fn alternatives_by_primes(text: &str) -> Option<String> {
    const LETTERS: [&str; 5] = ["theta", "θ", "ϑ", "q", "t"];
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for (at, prime) in text.match_indices(['\'', '′']) {
        let before = text[..at].trim_end_matches('}');
        let number = before.trim_end_matches(|c: char| c.is_ascii_digit() || ('₀'..='₉').contains(&c));
        let stem = number.trim_end_matches(['{', '_']);
        let Some(rest) = LETTERS.iter().find_map(|l| stem.strip_suffix(l)) else { continue };
        let rest = rest.strip_suffix("\\var").or(rest.strip_suffix('\\')).unwrap_or(rest);
        let is_part = rest.ends_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | '\'' | '"' | '\\'));
        let goes_on = text[at + prime.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '\'');
        if number.len() == before.len() || before.len() - number.len() > 3 || is_part || goes_on {
            continue;
        }
        bytes[at..at + prime.len()].fill(b' ');
        is_any = true;
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text with `{,}` between digits as a point, byte for byte.
fn without_braces(text: &str) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for (at, _) in text.match_indices("{,}") {
        let start = (0..at).rev().take_while(|&i| bytes[i].is_ascii_digit()).last();
        let is_number = bytes.get(at + 3).is_some_and(u8::is_ascii_digit);
        let Some(start) = start.filter(|_| is_number) else { continue };
        bytes.copy_within(start..at, start + 2);
        bytes[start..start + 2].fill(b' ');
        bytes[at + 2] = b'.';
    }
    String::from_utf8(bytes).unwrap_or_else(|_| text.to_string())
}
