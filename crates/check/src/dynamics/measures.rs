//! Numbers that a document gives for its symbols: `m_1 = 4 kg`, `g = 9.81`.

use super::letters::{Letters, role_of};
use super::words::{Role, words};
use denavit_symbolic::{Expr, Rational};
use std::collections::BTreeMap;

/// The values of names, in kilograms and metres.
pub(super) type Measures = BTreeMap<String, Expr>;

/// No more signs of equality are looked at.
const MAX_LOOKS: usize = 2_000;
/// No more names are given one number.
const MOST_CHAINED: usize = 4;
/// No name or number with its unit is longer.
const LONGEST: usize = 24;

/// The numbers that a text gives for masses, inertias, lengths and gravity; those that it gives in one way only.
pub(super) fn measures(text: &str) -> Measures {
    let mut found: BTreeMap<String, Option<Expr>> = BTreeMap::new();
    for (at, _) in text.match_indices('=').take(MAX_LOOKS) {
        // `l_1 = l_2 = 0.5`
        let Some(words) = names_before(&text[..at]) else { continue };
        for word in words {
            let Some(role) = role_of(&word, 9, &Letters::new()) else { continue };
            let Some(value) = value_behind(&text[at + 1..], role) else { continue };
            let known = found.entry(word).or_insert(Some(value));
            if *known != Some(value) {
                *known = None;
            }
        }
    }
    found.into_iter().filter_map(|(w, v)| Some((w, v?))).collect()
}

/// The names of masses, lengths and the like that end a text, several with signs of equality between; nothing where another name is among
/// them, `V = m`.
fn names_before(text: &str) -> Option<Vec<String>> {
    let mut found = vec![];
    let mut before = text;
    while found.len() < MOST_CHAINED {
        let (word, rest) = name_before(before)?;
        role_of(&word, 9, &Letters::new())?;
        found.push(word);
        match rest.strip_suffix('=') {
            Some(other) => before = other,
            None => return Some(found),
        }
    }
    None
}

/// The name that ends a text, and what stands before it.
fn name_before(text: &str) -> Option<(String, &str)> {
    let text = text.trim_end_matches([' ', '$', '&', '~']);
    let is_name = |c: &char| c.is_alphanumeric() || matches!(c, '_' | '{' | '}' | '\\');
    let length: usize = text.chars().rev().take_while(is_name).take(LONGEST).map(char::len_utf8).sum();
    let name = &text[text.len() - length..];
    // The last of `2 m_1` or `l/m_1` is none.
    let rest = text[..text.len() - length].trim_end_matches([' ', '$', '(']);
    // Words in bold letters: `**Numbers.** $m_1 = …$`.
    let rest = rest.strip_suffix("**").unwrap_or(rest);
    let before = rest.chars().next_back();
    if name.starts_with(|c: char| c.is_ascii_digit()) || before.is_some_and(|c| "+-*/^·<>−".contains(c)) {
        return None;
    }
    Some((words(name).into_iter().max_by_key(|w| w.chars().count())?, rest))
}

/// A decimal number with a unit of the kind that a role has.
fn value_behind(text: &str, role: Role) -> Option<Expr> {
    let line: String = text.chars().take(80).take_while(|c| *c != '\n').collect();
    let line = ["\\,", "\\;", "\\mathrm", "\\text", "\\rm", "\\cdot", "$", "{", "}", "~", "^"]
        .iter()
        .fold(line, |s, look| s.replace(look, if *look == "\\cdot" { "·" } else { " " }));
    let line = line.trim_start();
    let end = line.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(line.len());
    let number = line[..end].trim_end_matches('.');
    let (whole, part) = number.split_once('.').unwrap_or((number, ""));
    if number.is_empty() || whole.len() + part.len() > 9 {
        return None;
    }
    let digits: i64 = format!("{whole}{part}").parse().ok()?;
    let value = Rational::new(digits, 10_i64.pow(u32::try_from(part.len()).ok()?));
    let behind = &line[number.len()..];
    // `0,5` may be one number or two.
    if behind.starts_with(',') && behind[1..].starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    // `0.5 (m)`
    let scale = unit(behind.trim_start().trim_start_matches('(').trim_start(), role)?;
    Some(Expr::from(value) * Expr::from(scale))
}

/// What the unit before the rest of a line is in kilograms and metres; one where there is none.
fn unit(rest: &str, role: Role) -> Option<Rational> {
    let one = || Rational::new(1, 1);
    let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || "²³^*·/".contains(c));
    let milli = || Rational::new(1, 1000);
    let is_squared = |rest: &str| {
        let rest = rest.trim_start_matches([' ', '*', '·']).strip_prefix('m').map(str::trim_start);
        rest.and_then(|r| r.strip_prefix(['²', '2'])).is_some_and(ends)
    };
    let first = rest.split(|c: char| !c.is_alphabetic()).next().unwrap_or("");
    let goes_on = ["and", "und", "et", "y", "e"].contains(&first);
    if rest.is_empty() || rest.starts_with([',', ';', '.', ')', '&']) || goes_on {
        return Some(one());
    }
    match role {
        Role::Mass(_) | Role::Motor(_) | Role::Payload => {
            let kilo = rest.strip_prefix("kg").filter(|r| ends(r) && !is_squared(r)).map(|_| one());
            kilo.or_else(|| rest.strip_prefix('g').filter(|r| ends(r) && !is_squared(r)).map(|_| milli()))
        }
        Role::Inertia(_) | Role::About(..) | Role::Rotor(_) => {
            rest.strip_prefix("kg").filter(|r| is_squared(r)).map(|_| one())
        }
        Role::Length(_) => [("mm", milli()), ("cm", Rational::new(1, 100)), ("m", one())]
            .into_iter()
            .find_map(|(u, scale)| rest.strip_prefix(u).filter(|r| ends(r)).map(|_| scale)),
        Role::Gravity => {
            let rest: String = rest.chars().filter(|c| *c != ' ').take(8).collect();
            ["m/s²", "m/s2", "ms-2", "ms⁻²", "N/kg"].iter().any(|u| rest.starts_with(u)).then(one)
        }
        Role::Ten(..) | Role::Gear(_) => None,
    }
}
