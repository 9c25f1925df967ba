//! Names as they stand in a text, without what sets them.

use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Expr, greek};
use std::collections::BTreeSet;

/// The axes of coordinates.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// Words, units and names of velocities.
const SPEED: [&str; 20] = [
    "rad/s",
    "m/s",
    "deg/s",
    "°/s",
    "velo",
    "vitesse",
    "geschwind",
    "rates",
    " rate ",
    "speed",
    "snelheid",
    "prędk",
    "скорост",
    "hastighet",
    "hız",
    "速度",
    "ωz",
    "vx",
    "v_x",
    "tempo",
];

/// True for a text that speaks of velocities.
pub(super) fn speaks_of_speed(text: &str) -> bool {
    let lower = text.to_lowercase();
    SPEED.iter().any(|w| lower.contains(w))
}

/// Takes a name with its meaning, and what it is by the entries of the pose.
pub(super) type Add<'a> = dyn FnMut(&str, Expr, Expr) + 'a;

/// The names of a text: letters, each with the digits and letters behind it, marks of subscripts left aside.
pub(super) fn plain(text: &str) -> String {
    // `\\rho` as ρ, by its command; of the rest only names that no word contains.
    let text = if text.contains('\\') { greek_commands(text) } else { text.to_string() };
    let mut plain = plain_name(&text);
    for name in ["vartheta", "varphi", "theta", "omega", "phi", "tau"] {
        if plain.contains(name) {
            let letter = greek::letter(name).unwrap_or('φ');
            plain = plain.replace(name, letter.encode_utf8(&mut [0; 4]));
        }
    }
    plain
}

/// True for a name, marks of subscripts left aside, that stands in a text as such, or behind the digits of another.
pub(super) fn is_mentioned(text: &str, name: &str) -> bool {
    let words = text.split(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '{' | '}' | '\\')));
    // Letters stay what they are in a plain name.
    let letters = || name.chars().filter(char::is_ascii);
    let may_be = |w: &&str| w.len() < 200 && letters().all(|c| w.contains(c));
    words.filter(may_be).any(|word| {
        let word = plain_name(word);
        word.match_indices(name).any(|(at, _)| {
            let ends = word[at + name.len()..].starts_with(char::is_alphanumeric);
            !ends && !word[..at].ends_with(char::is_alphabetic)
        })
    })
}

/// The words of a text that are a letter or two and a number, marks of subscripts left aside.
pub(super) fn mentioned(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for word in text.split_whitespace() {
        let plain = plain_name(word);
        let chars: Vec<char> = plain.chars().collect();
        for (i, pair) in chars.windows(2).enumerate() {
            if pair[0].is_alphabetic() && pair[1].is_ascii_digit() {
                let digits: String =
                    chars[i + 1..].iter().take_while(|c| c.is_ascii_digit()).take(2).collect();
                found.insert(format!("{}{digits}", pair[0]));
                found.insert(format!("{}{}", pair[0], pair[1]));
            }
        }
    }
    found
}

/// A text with the commands of Greek letters as letters.
fn greek_commands(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('\\') {
        out.push_str(&rest[..at]);
        let name: String = rest[at + 1..].chars().take_while(char::is_ascii_alphabetic).collect();
        match greek::letter(&name) {
            Some(letter) => out.push(letter),
            None => out.push_str(&rest[at..at + 1 + name.len()]),
        }
        rest = &rest[at + 1 + name.len()..];
    }
    out.push_str(rest);
    out
}
