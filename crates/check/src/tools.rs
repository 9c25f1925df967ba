//! Tools of which a document speaks in words or only in its formulas: `the tip is at (L_3, 0, 0) in frame 4`, or a length that the
//! table does not have. Each is a reading that the document's statements have to support.

use super::note::Unread;
use super::plan::{Plan, Walked};
use super::walk::Piece;
use denavit::description::Description;
use denavit::geometry::{Transform, Vector};
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Expr, Symbol};
use std::collections::{BTreeMap, BTreeSet};

/// No more unknown names, and no more told places, are tried.
const MOST_NAMES: usize = 3;
const MOST_TOLD: usize = 4;
/// The frame in which a place is told stands no farther from it, in bytes.
const NEAR: usize = 60;
/// The longest text of a place.
const LONGEST: usize = 80;

/// Places of the hand in the last frame that the text may mean, for arms without a tool, and whether it tells them.
pub(super) fn candidates(text: &str, plan: &Plan, walked: &Walked) -> Vec<(Vector<Expr>, bool)> {
    let is_bare = |d: &Description| d.tool == Transform::identity();
    if !plan.is_own || plan.subjects.is_empty() || !plan.subjects.iter().all(|s| is_bare(&s.description)) {
        return vec![];
    }
    let mut found: Vec<_> =
        by_words(text, plan).into_iter().chain(told(text, plan)).map(|place| (place, true)).collect();
    let zero = Expr::int(0);
    for name in unknown(walked) {
        let size = Expr::symbol(&name);
        for axis in [0, 2, 1] {
            for size in [size, -size] {
                found.push((Vector(std::array::from_fn(|k| if k == axis { size } else { zero })), false));
            }
        }
    }
    found
}

/// Letters that formulas have with numbers for lengths, and the robot has not: `l1`, `l2` where the table has 0.4 and 0.3.
pub(super) fn letters_of_lengths(plan: &Plan, walked: &Walked) -> Vec<char> {
    let names = walked.assertions.iter().flat_map(|a| &a.pieces).filter_map(|p| match p {
        Piece::Unreadable { errors, .. } => Some(errors),
        _ => None,
    });
    let letter = |name: String| {
        let mut chars = name.chars();
        let (first, rest) = (chars.next()?, chars.as_str());
        let is_row = rest.parse::<usize>().is_ok_and(|n| plan.subjects.iter().all(|s| n <= s.last()));
        (is_row && first.is_ascii_alphabetic()).then_some(first)
    };
    let all = names.flatten().filter_map(|e| letter(plain_name(e.unknown()?)));
    let found: BTreeSet<char> = all.collect();
    found.into_iter().filter(|_| plan.is_own).take(2).collect()
}

/// Names of lengths that formulas have and the robot has not, the one first that stands in most of them.
fn unknown(walked: &Walked) -> Vec<String> {
    let pieces = walked.assertions.iter().flat_map(|a| &a.pieces);
    let unread = pieces.filter_map(|p| match p {
        Piece::Unreadable { errors, .. } => Some(errors),
        _ => None,
    });
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for errors in unread {
        let mut names: Vec<String> =
            errors.iter().filter_map(Unread::unknown).map(plain_name).filter(|n| is_length(n)).collect();
        names.dedup();
        // What is unknown for two reasons is not made known by one.
        if let ([name], true) = (&names[..], errors.iter().all(|e| e.unknown().is_some())) {
            *counts.entry(name.clone()).or_default() += 1;
        }
    }
    // In programs a formula is refused as a whole, and a length may have a number.
    let refused =
        walked.refused.iter().filter_map(Unread::unknown).chain(walked.numbers.iter().map(String::as_str));
    for name in refused.map(plain_name).filter(|n| is_length(n)) {
        *counts.entry(name).or_default() += 1;
    }
    let mut names: Vec<(String, usize)> = counts.into_iter().collect();
    names.sort_by_key(|n| std::cmp::Reverse(n.1));
    names.into_iter().map(|n| n.0).take(MOST_NAMES).collect()
}

/// True for a letter of lengths, with a number or a letter behind it or without: `L3`, `l_t`, `e`.
fn is_length(name: &str) -> bool {
    let mut chars = name.chars();
    let first = chars.next().is_some_and(|c| "aAbBcdDeEfghHklLprRt".contains(c));
    let rest: Vec<char> = chars.collect();
    first && rest.len() <= 2 && rest.iter().all(char::is_ascii_alphanumeric)
}

/// `Q lies on the x axis of frame 3 at the distance L_3`: a letter of length along an axis of the last frame.
fn by_words(text: &str, plan: &Plan) -> Vec<Vector<Expr>> {
    const AXES: [&str; 8] = ["axis", "achse", "axe ", "asse", "eje", "eixo", "as van", "-as "];
    const DISTANCES: [&str; 8] =
        ["distance", "abstand", "distanza", "distancia", "distância", "afstand", "entfernung", "avstånd"];
    const FAR: usize = 160;
    let names = Vocabulary::new().open(true);
    let last: Vec<String> = plan.subjects.iter().map(|s| s.last().to_string()).collect();
    let zero = Expr::int(0);
    let plain: String =
        text.chars().map(|c| if matches!(c, '$' | '*' | '\n' | '{' | '}') { ' ' } else { c }).collect();
    // Places stay where they are.
    let lower = plain.to_ascii_lowercase();
    let mut found = out_along_an_axis(&lower, &last);
    for (at, word) in DISTANCES.iter().flat_map(|w| lower.match_indices(w).take(20)) {
        let start = edge(&plain, at.saturating_sub(FAR));
        let sentence = lower[start..at].rsplit(". ").next().unwrap_or_default();
        let words: Vec<&str> =
            sentence.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).collect();
        let is_axis = |w: &str| AXES.iter().any(|a| w.starts_with(a.trim_matches([' ', '-'])));
        // `x axis`, `axe x`, `x3`.
        let letter = |w: &str| {
            let stem = w.trim_end_matches(|c: char| c.is_ascii_digit());
            ["x", "y", "z"].iter().position(|l| *l == stem)
        };
        let Some(axis) = words.windows(2).rev().find_map(|w| match () {
            () if is_axis(w[1]) => letter(w[0]),
            () if is_axis(w[0]) => letter(w[1]),
            () => None,
        }) else {
            continue;
        };
        let is_last = |w: &&str| {
            let number = w.trim_start_matches(|c: char| c.is_alphabetic());
            last.iter().any(|l| l == number)
        };
        if !words.iter().any(is_last) {
            continue;
        }
        let behind = plain[at + word.len()..].trim_start();
        let behind = behind.strip_prefix("of ").or_else(|| behind.strip_prefix("von ")).unwrap_or(behind);
        let size: String =
            behind.chars().take_while(|c| c.is_alphanumeric() || matches!(c, '_' | '\\' | '.')).collect();
        let size = size.trim_end_matches('.');
        let Some(size) = parse(size, &names).ok().filter(|e| is_short(*e) && !e.is_zero()) else { continue };
        let place = Vector(std::array::from_fn(|k| if k == axis { size } else { zero }));
        if !found.contains(&place) {
            found.push(place);
        }
    }
    found.truncate(MOST_TOLD);
    found
}

/// `The probe sits 0.38 m out on the x axis of frame 3`: a length in figures, an axis of the last frame behind it.
fn out_along_an_axis(lower: &str, last: &[String]) -> Vec<Vector<Expr>> {
    const UNITS: [(&str, i64); 6] =
        [("m", 1), ("metres", 1), ("meters", 1), ("cm", 100), ("mm", 1000), ("millimetres", 1000)];
    let names = Vocabulary::new();
    let mut found = vec![];
    for (letter, k) in [("x", 0), ("y", 1), ("z", 2)] {
        for axis in [format!("{letter} axis of "), format!("{letter}-axis of ")] {
            for (at, _) in lower.match_indices(&axis).take(20) {
                let behind = lower[at + axis.len()..].strip_prefix("frame ").unwrap_or_default().trim_start();
                let number: String = behind.chars().take_while(char::is_ascii_digit).collect();
                if !last.contains(&number) {
                    continue;
                }
                let before = lower[..at].rsplit(". ").next().unwrap_or_default();
                let words: Vec<&str> = before.split_whitespace().rev().take(12).collect();
                let is_size = |w: &str| w.starts_with(|c: char| c.is_ascii_digit());
                let unit = |w: &str| UNITS.iter().find(|u| u.0 == w).map(|u| u.1);
                // From the axis backwards.
                let pair = words.windows(2).find_map(|w| Some((w[1], unit(w[0])?)).filter(|p| is_size(p.0)));
                let Some((size, parts)) = pair.and_then(|(w, parts)| Some((parse(w, &names).ok()?, parts)))
                else {
                    continue;
                };
                // The table may be in the same unit, or in metres.
                let mut sizes = vec![size, size / Expr::int(parts)];
                sizes.dedup();
                for size in sizes {
                    let place = Vector(std::array::from_fn(|i| if i == k { size } else { Expr::int(0) }));
                    if !found.contains(&place) {
                        found.push(place);
                    }
                }
            }
        }
    }
    found
}

/// Three lengths in brackets beside the number of the last frame.
fn told(text: &str, plan: &Plan) -> Vec<Vector<Expr>> {
    let last: Vec<String> = plan.subjects.iter().map(|s| s.last().to_string()).collect();
    let names = Vocabulary::new().open(true);
    let mut found: Vec<Vector<Expr>> = vec![];
    for (at, _) in text.match_indices(['(', '[']).take(2_000) {
        let inside = &text[at + 1..];
        let mut chars = inside.char_indices().take(LONGEST);
        let Some((length, _)) = chars.find(|c| matches!(c.1, ')' | ']')) else { continue };
        let parts: Vec<&str> = inside[..length].split([',', ';']).map(str::trim).collect();
        if parts.len() != 3 {
            continue;
        }
        let before = &text[edge(text, at.saturating_sub(NEAR))..at];
        let behind = text.get(at + length + 2..edge(text, at + length + NEAR)).unwrap_or("");
        let line = |t: &str| t.split('\n').next().unwrap_or_default().to_string();
        let around = format!("{} {}", before.rsplit('\n').next().unwrap_or_default(), line(behind));
        let mut words = around.split(|c: char| !c.is_ascii_digit());
        if !words.any(|w| last.iter().any(|l| l == w)) {
            continue;
        }
        // `^3P_W = (m, 0, 0)`: a letter of any kind, as it is one of a place.
        let is_named = before.trim_end().trim_end_matches(['[', '(']).trim_end().ends_with('=');
        let is_letter =
            |e: Expr| e.symbols().len() <= 1 && e.symbols().iter().all(|s| s.name().chars().count() <= 2);
        let is_size = |e: &Expr| is_short(*e) || is_named && is_letter(*e);
        let value = |p: &&str| parse(&p.replace('−', "-"), &names).ok().filter(is_size);
        let Some(place) = parts.iter().map(value).collect::<Option<Vec<Expr>>>() else { continue };
        let [x, y, z] = place[..] else { continue };
        let place = Vector([x, y, z]);
        let moves = |s: Symbol| plan.is_joint(&s.name());
        let is_still = place.0.iter().flat_map(|e| e.symbols()).all(|s| !moves(s));
        if is_still && place.0.iter().any(|e| !e.is_zero()) && !found.contains(&place) {
            found.push(place);
        }
    }
    found.truncate(MOST_TOLD);
    found
}

/// A number, or a letter with a factor.
fn is_short(e: Expr) -> bool {
    e.symbols().len() <= 1 && e.symbols().iter().all(|s| is_length(&plain_name(&s.name())))
}

/// The nearest place up to `at` at which no character is cut.
pub(super) fn edge(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|i| text.is_char_boundary(*i)).unwrap_or(0)
}
