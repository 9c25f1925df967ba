//! In which order statements are read: what a name means before the formulas that use it.
//!
//! People print the formula first and say with what behind it: `A·c + B·s = D with A = …, B = …, D = …`.

use super::habits::Habits;
use super::names::{Name, Token, tokens};
use denavit_reading::document::{Part, Side, Statement};
use denavit_symbolic::vocabulary::plain_name;
use std::collections::BTreeSet;
use std::ops::Range;

/// Words between a formula and the names that it uses.
const LINKS: [&str; 13] = [
    "with", "where", "wherein", "mit", "wobei", "worin", "avec", "où", "con", "donde", "dove", "com", "onde",
];
/// Words between names that are given their meaning in one go.
const JOINTS: [&str; 6] = ["and", "und", "et", "y", "e", "sowie"];
/// So many statements are looked at ahead.
const AHEAD: usize = 16;
/// The most cells of a matrix whose names are looked for.
const MAX_CELLS: usize = 64;
/// No more bytes stand between two statements of a run.
const LONGEST_GAP: usize = 240;

/// What stands between two statements.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Gap {
    /// Marks, or a word that joins two of a kind.
    Joint,
    /// A word that says that names follow.
    Link,
    /// Such a word with others behind it: `with the reach`.
    Phrase,
    Text,
}

/// The statements to be read before the one at `at`: those that give names their meaning behind a `with`, and those that
/// define a matrix that is the document's own.
pub(super) fn before(text: &str, statements: &[Statement], at: usize, habits: &Habits) -> Vec<usize> {
    let mut found = own_matrices(text, statements, at, habits);
    found.extend(entries(text, statements, at));
    let gap = |k: usize| {
        let (a, b) = (statements.get(k)?, statements.get(k + 1)?);
        between(text, &(a.span.end..b.span.start))
    };
    let mut k = at;
    while gap(k) == Some(Gap::Joint) && k < at + AHEAD {
        k += 1;
    }
    match gap(k) {
        Some(Gap::Link) => {}
        // A name that had a meaning before may get another one there.
        Some(Gap::Phrase) => {
            let left = |s: &Statement| s.sides.first().and_then(|l| text.get(l.span.clone())).map(plain_name);
            let own = statements.get(k + 1).and_then(left);
            if statements[..=at].iter().any(|s| left(s) == own) {
                return found;
            }
        }
        _ => return found,
    }
    loop {
        k += 1;
        found.extend(Some(k).filter(|k| !found.contains(k)));
        if gap(k) != Some(Gap::Joint) || k > at + 2 * AHEAD {
            return found;
        }
    }
}

/// The statements further down that define the matrices of this one, if these are the document's own. What has a meaning already gets
/// another one under the same heading only: a text that solves two problems may call the links of both by the same names.
fn own_matrices(text: &str, statements: &[Statement], at: usize, habits: &Habits) -> Vec<usize> {
    let keys = |side: &Side| names(text, side).iter().map(Name::key).collect::<Vec<String>>();
    let used: Vec<String> = statements[at].sides.iter().flat_map(keys).collect();
    let used: Vec<&String> = used.iter().filter(|key| habits.products.contains(*key)).collect();
    if used.len() < 2 {
        return vec![];
    }
    let defined = |s: &Statement| match &s.sides[..] {
        [left, _, ..] => match &keys(left)[..] {
            [key] if used.contains(&key) => Some(key.clone()),
            _ => None,
        },
        _ => None,
    };
    let ahead = at + 1..statements.len().min(at + AHEAD);
    let is_here = |k: &usize| statements[*k].heading == statements[at].heading;
    let mut known: BTreeSet<String> = statements[..at].iter().filter_map(defined).collect();
    let mut found: Vec<usize> = vec![];
    for k in ahead.clone().filter(is_here).chain(ahead.filter(|k| !is_here(k))) {
        let Some(key) = defined(&statements[k]) else { continue };
        if is_here(&k) || known.insert(key.clone()) {
            known.insert(key);
            found.push(k);
        }
    }
    found.sort_unstable();
    found
}

/// The statements further down that define the names in the cells of a printed matrix: `J = [j_11 …]`, `j_11 = …`.
fn entries(text: &str, statements: &[Statement], at: usize) -> Vec<usize> {
    // Other matrices are known by their names, and give those of their entries a meaning.
    let is_jacobian = |side: &Side| matches!(&names(text, side)[..], [name] if name.base == "J");
    if !statements[at].sides.iter().any(is_jacobian) {
        return vec![];
    }
    let grids = statements[at].sides.iter().flat_map(|s| &s.parts).filter_map(|p| match p {
        Part::Matrix(grid) => Some(grid),
        Part::Text(_) => None,
    });
    let cells =
        grids.flat_map(|g| g.rows.iter().flatten()).filter_map(|span| entry_name(text.get(span.clone())?));
    let mut wanted: BTreeSet<String> = cells.take(MAX_CELLS).collect();
    if wanted.is_empty() {
        return vec![];
    }
    // The first definition of each.
    let mut defines = |s: &Statement| {
        let [Side { span, .. }, _, ..] = &s.sides[..] else { return false };
        text.get(span.clone()).and_then(entry_name).is_some_and(|name| wanted.remove(&name))
    };
    (at + 1..statements.len().min(at + 1 + MAX_CELLS)).filter(|&k| defines(&statements[k])).collect()
}

/// The name of an entry with its place, `j_{11}`.
fn entry_name(text: &str) -> Option<String> {
    let plain = plain_name(text.trim_matches(['&', '$', ' ']));
    let letters = plain.trim_end_matches(|c: char| c.is_ascii_digit());
    let fits = plain.len() - letters.len() >= 2 && letters.chars().count() == 1;
    (fits && letters.chars().all(char::is_alphabetic)).then_some(plain)
}

/// The names of matrices in a side that is nothing else.
pub(super) fn names(text: &str, side: &Side) -> Vec<Name> {
    let [Part::Text(span)] = &side.parts[..] else { return vec![] };
    let found = tokens(text, span, &|_| false).unwrap_or_default();
    let names = found.into_iter().filter_map(|t| match t {
        Token::Name(name) => Some(name),
        _ => None,
    });
    names.collect()
}

/// What the text between two statements says.
fn between(text: &str, span: &Range<usize>) -> Option<Gap> {
    let source = text.get(span.clone()).filter(|s| s.len() < LONGEST_GAP)?;
    let words = words(source);
    Some(match &words[..] {
        [] => Gap::Joint,
        [word] if JOINTS.contains(&word.as_str()) => Gap::Joint,
        [word] if LINKS.contains(&word.as_str()) => Gap::Link,
        // `mit der Ausladung b = …`
        [word, rest @ ..] if LINKS.contains(&word.as_str()) && rest.len() <= 5 && !source.contains(". ") => {
            Gap::Phrase
        }
        _ => Gap::Text,
    })
}

/// The words of a text without what sets formulas: commands of LaTeX and their arguments, marks, numbers of equations.
fn words(source: &str) -> Vec<String> {
    let mut found = vec![];
    let mut rest = source;
    while let Some(c) = rest.chars().next() {
        if let Some(behind) = rest.strip_prefix('\\') {
            let behind = behind.trim_start_matches(|c: char| c.is_ascii_alphabetic() || c == '*');
            let inner =
                behind.strip_prefix('{').and_then(|b| b.split_once('}')).filter(|(a, _)| !a.contains(' '));
            rest = inner.map_or(behind, |(_, after)| after);
            continue;
        }
        let word: String = rest.chars().take_while(|c| c.is_alphanumeric()).collect();
        if word.chars().any(char::is_alphabetic) {
            found.push(word.to_lowercase());
        }
        rest = &rest[word.len().max(c.len_utf8())..];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{Gap, between};

    #[test]
    fn what_joins_two_formulas() {
        for (text, joins) in [
            (" with ", true),
            (
                " \\quad\\checkmark \\tag{3}\n\\end{equation*}\n\n\\noindent where\n\n\\begin{equation*}\n",
                true,
            ),
            (", and ", false),
            (" with the length ", false),
        ] {
            assert_eq!(between(text, &(0..text.len())) == Some(Gap::Link), joins, "{text}");
        }
    }
}
