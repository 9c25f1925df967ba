//! Short names that a document gives to words, `\newcommand{\atan}{\operatorname{atan2}}`, and tables of values, written out where they
//! stand, byte for byte.

use super::lines::lines;
use super::tools::edge;
use denavit_reading::document::closing_brace;
use denavit_symbolic::greek;
use std::ops::Range;

/// No more definitions are read.
const MAX_DEFINED: usize = 100;
/// The longest line of a table, and the longest body, that is looked at.
const LONGEST: usize = 300;
/// Units of lengths.
const LENGTHS: [&str; 4] = ["m", "mm", "cm", "in"];

/// A text with the words for its macros without arguments, where these are as short; nothing for other texts.
pub(super) fn written_out(text: &str) -> Option<String> {
    let mut found: Vec<(String, String, Range<usize>)> = vec![];
    for opening in ["\\newcommand", "\\renewcommand", "\\providecommand", "\\DeclareMathOperator", "\\def"] {
        for (at, _) in text.match_indices(opening).take(MAX_DEFINED) {
            let Some((name, body, end)) = definition(text, at + opening.len()) else { continue };
            let is_operator = opening == "\\DeclareMathOperator";
            let Some(word) = word(body).filter(|w| w.len() <= name.len()) else { continue };
            let known = ["atan2", "sin", "cos", "tan", "arcsin", "arccos", "arctan", "atan", "asin", "acos"];
            let is_letter = word.chars().count() == 1;
            if known.contains(&&*word) || is_letter && !is_operator {
                found.push((name.to_string(), word, at..end));
            }
        }
    }
    if found.is_empty() {
        return None;
    }
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for (name, word, _) in &found {
        for (at, _) in text.match_indices(name.as_str()) {
            let behind = text[at + name.len()..].chars().next();
            let is_whole = !behind.is_some_and(char::is_alphabetic);
            let is_defined = found.iter().any(|(.., own)| own.contains(&at));
            if is_whole && !is_defined {
                let now = format!("{word}{}", " ".repeat(name.len() - word.len()));
                bytes[at..at + name.len()].copy_from_slice(now.as_bytes());
                is_any = true;
            }
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// `{\name}{body}`, `\name{body}`: the name with its stroke, the body and where it ends; nothing for one with arguments.
fn definition(text: &str, at: usize) -> Option<(&str, &str, usize)> {
    let rest = text.get(at..)?.strip_prefix('*').unwrap_or(text.get(at..)?);
    let bare = rest.strip_prefix('{').unwrap_or(rest);
    let letters = bare.strip_prefix('\\')?.chars().take_while(|c| c.is_ascii_alphabetic()).count();
    let (name, behind) = bare.split_at(letters + 1);
    let behind = behind.strip_prefix('}').unwrap_or(behind);
    let inner = behind.strip_prefix('{')?;
    let close = closing_brace(&inner[..edge(inner, LONGEST)])?;
    (letters > 0).then(|| (name, &inner[..close], text.len() - inner.len() + close + 1))
}

/// The word that a body is, without what says how it looks; a letter for the name of a Greek one.
fn word(body: &str) -> Option<String> {
    let looks = ["\\operatorname", "\\mathrm", "\\text", "\\mathit", "\\ensuremath", "\\rm", "\\,", "\\!"];
    let plain = looks.iter().fold(body.to_string(), |s, look| s.replace(look, ""));
    let plain: String = plain.chars().filter(|c| !matches!(c, '{' | '}' | '$' | ' ' | '*')).collect();
    match plain.strip_prefix('\\') {
        Some(name) => match greek::letter(name) {
            Some(letter) => Some(letter.to_string()),
            None => {
                ["sin", "cos", "tan", "arcsin", "arccos", "arctan"].contains(&name).then(|| name.to_string())
            }
        },
        None => (!plain.is_empty() && plain.chars().all(char::is_alphanumeric)).then_some(plain),
    }
}

/// A text in which `| a1 | 0.05 m | pan axis to tilt axis |` says `a1 = 0.05 m`, in tables whose rows all give a length its value;
/// nothing for other texts.
pub(super) fn values_in_tables(text: &str) -> Option<String> {
    let all: Vec<Range<usize>> = lines(text).collect();
    let source = |r: &Range<usize>| text.get(r.clone()).unwrap_or_default();
    let is_row = |r: &Range<usize>| source(r).trim_start().starts_with('|') && r.len() < LONGEST;
    let mut bytes = text.as_bytes().to_vec();
    let (mut is_any, mut at) = (false, 0);
    while at < all.len() {
        let end = at + all[at..].iter().take_while(|r| is_row(r)).count();
        if end < at + 3 {
            at = end.max(at + 1);
            continue;
        }
        let values: Option<Vec<Vec<u8>>> = all[at + 2..end].iter().map(|r| value(source(r))).collect();
        if let Some(values) = values.filter(|_| source(&all[at + 1]).contains("--")) {
            for (line, now) in all[at + 2..end].iter().zip(values) {
                bytes[line.clone()].copy_from_slice(&now);
            }
            is_any = true;
        }
        at = end;
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A row that gives a length its value, as a statement of the same length.
fn value(line: &str) -> Option<Vec<u8>> {
    let cuts: Vec<usize> = line.match_indices('|').map(|c| c.0).collect();
    let &[first, second, third] = cuts.first_chunk::<3>()?;
    // A table of a robot has numbers in more columns.
    let is_figure = |cell: &str| cell.trim_matches(['`', '$', ' ']).parse::<f64>().is_ok();
    if cuts[2..].windows(2).any(|c| is_figure(&line[c[0] + 1..c[1]])) {
        return None;
    }
    let bare = |s: &str| s.trim().trim_matches(['`', '$', '*', ' ']).to_string();
    let (name, number) = (bare(&line[first + 1..second]), bare(&line[second + 1..third]));
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('_');
    let is_name = !letters.is_empty()
        && letters.chars().all(char::is_alphabetic)
        && letters.chars().count() < 4
        && !matches!(letters, "x" | "y" | "z" | "p" | "px" | "py" | "pz" | "q");
    let (figure, unit) = number.split_once(' ')?;
    let is_length = figure.parse::<f64>().is_ok() && LENGTHS.contains(&unit.trim());
    if !is_name || !is_length {
        return None;
    }
    let now = format!("{}{name} = {figure} {}", " ".repeat(first), unit.trim());
    (now.len() <= line.len()).then(|| format!("{now}{}", " ".repeat(line.len() - now.len())).into_bytes())
}

#[cfg(test)]
mod tests {
    use super::{values_in_tables, written_out};

    #[test]
    fn short_names_for_words() {
        let text = "\\newcommand{\\atan}{\\operatorname{atan2}}\n\\newcommand{\\q}{\\theta}\n$\\q_1=\\atan(y,x)+\\atanh$";
        let now = written_out(text).expect("macros");
        assert_eq!(now.len(), text.len());
        assert!(now.ends_with("$θ_1=atan2(y,x)+\\atanh$"), "{now}");
        assert!(written_out("\\newcommand{\\R}[1]{\\mathbf{#1}} $\\R{x}$").is_none());
    }

    #[test]
    fn lengths_in_a_table() {
        let text = "| symbol | default | meaning |\n|---|---|---|\n| `a1` | 0.05 m | pan to tilt |\n| d_2 | 40 mm | beside |\n";
        let now = values_in_tables(text).expect("values");
        assert_eq!(now.len(), text.len());
        assert!(now.contains("a1 = 0.05 m") && now.contains("d_2 = 40 mm"), "{now}");
        assert!(values_in_tables("| i | a |\n|---|---|\n| 1 | 0.4 m |\n").is_none());
    }
}
