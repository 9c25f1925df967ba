//! Entries of a matrix that a program sets one by one: each is a statement, and has a verdict of its own.

use super::facts::About;
use super::outcome::{Cause, Claim, Entry, Finding, Standing};
use std::ops::Range;

/// The longest left side.
const LONGEST: usize = 80;

/// The claims of a document, those whose entries stand in statements of their own taken apart.
pub(super) fn split(text: &str, claims: Vec<Claim>, causes: &mut [Cause]) -> Vec<Claim> {
    let mut found: Vec<Claim> = vec![];
    // For each claim the new places of its entries.
    let mut places: Vec<Vec<Option<(usize, usize)>>> = vec![];
    // The entry for which a claim is called the cause of others.
    let mut faults: Vec<usize> = vec![];
    for claim in claims {
        let is = |s: Standing| claim.entries.iter().position(|e| e.finding.standing() == s);
        faults.push(is(Standing::Wrong).or_else(|| is(Standing::Carried)).unwrap_or(0));
        let own: Vec<Option<Range<usize>>> =
            claim.entries.iter().map(|e| e.place.and_then(|_| left_side(text, &e.span))).collect();
        if own.iter().flatten().count() < 2 {
            places.push((0..claim.entries.len()).map(|k| Some((found.len(), k))).collect());
            found.push(claim);
            continue;
        }
        let mut at = vec![None; claim.entries.len()];
        let mut rest = Claim { entries: vec![], ..claim.clone() };
        let mut others = vec![];
        for (k, (entry, left)) in claim.entries.into_iter().zip(own).enumerate() {
            match left {
                Some(left) => {
                    at[k] = Some((found.len(), 0));
                    found.push(Claim {
                        span: left.start..entry.span.end,
                        name: text[left].to_string(),
                        about: About::Entry,
                        entries: vec![Entry { place: None, ..entry }],
                        instead: None,
                        remarks: vec![],
                        robot: claim.robot,
                    });
                }
                None => {
                    others.push(k);
                    rest.entries.push(entry);
                }
            }
        }
        // What is left of the matrix, as its zeros, is worth a word where it is not right.
        if rest.standing() != Standing::Equal {
            others.iter().enumerate().for_each(|(n, &k)| at[k] = Some((found.len(), n)));
            rest.instead = None;
            found.push(rest);
        }
        places.push(at);
    }
    for entry in found.iter_mut().flat_map(|c| &mut c.entries) {
        if let Finding::Carried { by, .. } = &mut entry.finding {
            let new = places.get(*by).and_then(|p| p.get(faults[*by]).copied().flatten());
            *by = new.map_or(*by, |p| p.0);
        }
    }
    for cause in causes {
        for all in [&mut cause.turns_right, &mut cause.turns_wrong, &mut cause.stays_wrong] {
            let new = |at: &(usize, usize)| places.get(at.0)?.get(at.1).copied().flatten();
            *all = all.iter().filter_map(new).collect();
        }
    }
    found
}

/// The left side of the statement that sets one entry to a formula: `J[0][2]`, `T(1,4)`.
fn left_side(text: &str, formula: &Range<usize>) -> Option<Range<usize>> {
    let before = text.get(..formula.start)?.trim_end_matches([' ', '\t', '(']);
    let left = before.strip_suffix('=')?;
    let start = left.rfind([';', '{', '}', '\n', '=']).map_or(0, |i| i + 1);
    let shown = left[start..].trim();
    let is_entry = shown.ends_with([']', ')']) && shown.contains(['[', '(']) && shown.len() <= LONGEST;
    let start = start + (left[start..].len() - left[start..].trim_start().len());
    is_entry.then_some(start..start + shown.len())
}

#[cfg(test)]
mod tests {
    use super::left_side;

    #[test]
    fn the_left_side_of_an_entry() {
        let text = "  J[0][0] = -s1*w;  J[0][1] = a;\nT = [[a, b]]; x = c";
        let of = |formula: &str| {
            let at = text.find(formula).unwrap_or_default();
            left_side(text, &(at..at + formula.len())).map(|l| &text[l])
        };
        assert_eq!(of("-s1*w"), Some("J[0][0]"));
        assert_eq!(of("a;"), Some("J[0][1]"));
        assert_eq!(of("b]"), None);
        assert_eq!(of("c"), None);
    }
}
