//! Bodies with letters for numbers: `m_A`, `J_b`, `T_B`. Which letter is which body is read as most of the document is right.

use super::words::{Role, role};
use crate::names::Name;
use std::collections::{BTreeMap, BTreeSet};

/// The bodies, counted from 0, that letters stand for.
pub(super) type Letters = BTreeMap<char, usize>;

/// No document has more letters for bodies.
const MAX_LETTERS: usize = 6;
/// The most ways in which letters are given to bodies.
const MAX_MAPS: usize = 24;

/// True for a letter that may number a body: `m_l` is the mass of a link, `m_i` that of any, `m_G` one at a centre.
fn may_number(c: char) -> bool {
    c.is_ascii_alphabetic() && !"gGijklnxyz".contains(c)
}

/// The quantity and the letter of a name of two.
fn lettered(word: &str) -> Option<(char, char)> {
    let mut chars = word.chars();
    let pair = (chars.next()?, chars.next()?);
    (chars.next().is_none() && may_number(pair.1)).then_some(pair)
}

/// True for the mass or the inertia of a body with a letter among these.
pub(super) fn is_body(word: &str, letters: &[char]) -> bool {
    lettered(word).is_some_and(|(of, c)| matches!(of, 'm' | 'I' | 'J') && letters.contains(&c))
}

/// The letters that number the bodies of a document with these words, in the order in which its text first has them; none where
/// masses have numbers.
pub(super) fn letters(mentioned: &BTreeSet<String>, text: &str) -> Vec<char> {
    // `M_2` may be a torque.
    let is_numbered = |w: &String| w.starts_with('m') && matches!(role(w, 9), Some(Role::Mass(Some(_))));
    if mentioned.iter().any(is_numbered) {
        return vec![];
    }
    let all: BTreeSet<(char, char)> = mentioned.iter().filter_map(|w| lettered(w)).collect();
    if !all.iter().any(|(of, _)| *of == 'm') {
        return vec![];
    }
    // `J_b` of a base that only turns, beside a mass with a letter.
    let of_bodies = all.iter().filter(|(of, _)| matches!(of, 'm' | 'I' | 'J'));
    let found: BTreeSet<char> = of_bodies.map(|(_, c)| *c).collect();
    let place = |c: &char| {
        let looks =
            [format!("_{c}"), format!("_{{{c}"), format!("_{{\\mathrm{{{c}"), format!("_\\mathrm{{{c}")];
        looks.iter().filter_map(|look| text.find(look)).min().unwrap_or(usize::MAX)
    };
    let mut found: Vec<char> = found.into_iter().collect();
    found.sort_by_key(place);
    found.truncate(MAX_LETTERS);
    found
}

/// The ways to give letters to `n` bodies, each to one, the order of the letters first; and whether there are more.
pub(super) fn maps(letters: &[char], n: usize) -> (Vec<Letters>, bool) {
    if letters.is_empty() {
        return (vec![], false);
    }
    // Of bodies to letters, or to none where there are fewer.
    let mut found: Vec<Vec<Option<usize>>> = vec![vec![]];
    let free = n.saturating_sub(letters.len());
    for _ in 0..n {
        let longer = |map: &Vec<Option<usize>>| -> Vec<Vec<Option<usize>>> {
            let choices = (0..letters.len()).map(Some).filter(|c| !map.contains(c));
            let none = (map.iter().filter(|c| c.is_none()).count() < free).then_some(None);
            choices.chain(none).map(|c| [&map[..], &[c]].concat()).collect()
        };
        // Each beginning has an end, so that no more are needed.
        found = found.iter().flat_map(longer).take(MAX_MAPS + 1).collect();
    }
    let is_cut = found.len() > MAX_MAPS;
    let of = |map: Vec<Option<usize>>| -> Letters {
        map.into_iter().enumerate().filter_map(|(body, c)| Some((letters[c?], body))).collect()
    };
    (found.into_iter().take(MAX_MAPS).map(of).collect(), is_cut)
}

/// The bodies of `m_0`, `m_1`, …, which are counted from 0: none where the last of `n` has its usual number, or another one has not.
pub(super) fn from_zero(mentioned: &BTreeSet<String>, n: usize) -> Option<Letters> {
    let has = |k: usize| mentioned.contains(&format!("m{k}"));
    let is_whole = n > 1 && n < 10 && (0..n).all(has) && !has(n);
    is_whole.then(|| ('0'..='9').zip(0..n).collect())
}

/// What a name stands for where letters are those of bodies.
pub(super) fn role_of(word: &str, n: usize, letters: &Letters) -> Option<Role> {
    let numbered = || {
        let last = word.chars().next_back()?;
        let body = letters.get(&last)?;
        let before = &word[..word.len() - last.len_utf8()];
        // `l_c` is one to a centre.
        let is_plain = !before.is_empty() && !before.contains(|c: char| c.is_ascii_digit());
        let role = is_plain.then(|| role(&format!("{before}{}", body + 1), n)).flatten()?;
        (last != 'c' || !matches!(role, Role::Length(_))).then_some(role)
    };
    numbered().or_else(|| role(word, n))
}

/// A name with the number of its body for the letter; nothing where it has none.
pub(super) fn numbered(name: &Name, letters: &Letters) -> Option<Name> {
    let plain: Vec<char> = name.sub.chars().filter(|c| c.is_alphanumeric()).collect();
    let &[letter] = &plain[..] else { return None };
    // A number is that of a joint.
    let body = letters.get(&letter).filter(|_| !letter.is_ascii_digit())?;
    Some(Name { sub: (body + 1).to_string(), ..name.clone() })
}

#[cfg(test)]
mod tests {
    use super::maps;

    #[test]
    fn long_arms_have_few_maps() {
        let (found, is_cut) = maps(&['a', 'b', 'c', 'd', 'e', 'f'], 40);
        assert!(is_cut && found.len() == super::MAX_MAPS);
        assert!(found.iter().all(|map| map.len() == 6), "each letter is a body");
        let (found, is_cut) = maps(&['A', 'B'], 3);
        assert_eq!((found.len(), is_cut), (6, false));
        assert_eq!(found[0], [('A', 0), ('B', 1)].into());
    }
}
