//! Sums of joints that a text names: `θ4 = φ - θ2 - θ3` says what φ is.

use super::directions::sum_in_pose;
use super::habits::Places;
use super::subject::Subject;
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Expr, equal};

/// Names for sums of joints that the text tells by a formula for one of them alone, `θ_4 = β - θ_2 - θ_3`, `θ_4 = θ_1 + θ_2 - φ`,
/// each with the sum and what it is by the pose.
pub(super) fn told(
    text: &str,
    subject: &Subject,
    names: &Vocabulary,
    places: &Places,
) -> Vec<(String, Expr, Expr)> {
    const MOST: usize = 8;
    const MOST_TRIED: usize = 24;
    let mut tried = 0;
    let joint = |word: &str| {
        let known = |w: &str| names.lookup(w).filter(|e| subject.joints().contains(e));
        // `q4s` is a solution for q4.
        known(word).or_else(|| known(word.trim_end_matches(char::is_alphabetic).trim_end_matches('_')))
    };
    let mut found: Vec<(String, Expr, Expr)> = vec![];
    for line in text.lines().filter(|l| l.len() < 300 && l.contains('=') && l.contains(['-', '−'])) {
        for (at, _) in line.match_indices('=').take(4) {
            let left = line[..at].trim_end_matches([' ', '&', '$', ':']);
            let left = left.rsplit([' ', '$', '*', '[', '(', ',', '&']).next().unwrap_or_default();
            let Some(last) = joint(&plain_name(left)) else { continue };
            let right = line[at + 1..].split(['=', ';', ',', '#', '%', '$', ':']).next().unwrap_or_default();
            let right = right.trim_matches(['&', ' ', '\\', '.', ']']).replace('−', "-");
            let Some((name, sum)) = solved_for_name(&right, last, &joint) else { continue };
            let is_name = name.chars().count() < 8
                && name.starts_with(char::is_alphabetic)
                && name.chars().all(char::is_alphanumeric)
                && !matches!(name.as_str(), "pi" | "π")
                && names.lookup(&name).is_none();
            if !is_name {
                continue;
            }
            tried += 1;
            if tried > MOST_TRIED {
                return found;
            }
            let is_new =
                found.len() < MOST && found.iter().all(|f| f.0 != name) && !is_other(text, &name, sum, names);
            if let Some(entry) = sum_in_pose(subject, places, sum).filter(|_| is_new) {
                found.push((name, sum, entry));
            }
        }
    }
    found
}

/// The one name in a sum of joints that is no joint, and what it is where a joint is that sum.
fn solved_for_name(
    sum: &str,
    joint: Expr,
    joint_of: &dyn Fn(&str) -> Option<Expr>,
) -> Option<(String, Expr)> {
    const MOST: usize = 8;
    let (mut name, mut rest, mut count) = (None, joint, 0);
    let mut at = 0;
    while at < sum.len() {
        let source = &sum[at..];
        let is_minus = source.trim_start().starts_with('-');
        let begin = at + source.len() - source.trim_start_matches([' ', '+', '-']).len();
        let end = sum[begin..].find(['+', '-']).map_or(sum.len(), |i| begin + i);
        let term = plain_name(sum[begin..end].trim());
        at = end.max(begin + 1);
        count += 1;
        match joint_of(&term) {
            _ if term.is_empty() || count > MOST => return None,
            Some(q) if q == joint => return None,
            Some(q) => rest = if is_minus { rest + q } else { rest - q },
            None if name.is_none() => name = Some((term, is_minus)),
            None => return None,
        }
    }
    let (name, is_minus) = name.filter(|_| count > 1)?;
    Some((name, if is_minus { -rest } else { rest }))
}

/// True for a name that the text gives a formula for something else than a sum.
fn is_other(text: &str, name: &str, sum: Expr, names: &Vocabulary) -> bool {
    text.lines().any(|line| {
        let Some((left, right)) = line.split_once('=') else { return false };
        let left = left.trim_end_matches([' ', '&', '$', ':']);
        let is_it = !left.is_empty()
            && left.len() < 200
            && plain_name(left.rsplit([' ', '$', '*', '(']).next().unwrap_or("")) == name;
        let right = right.split(['=', ';', '#', '%', '$', '.', ',']).next().unwrap_or_default().trim();
        is_it
            && !super::lexis::read(right, &(0..right.len()), names)
                .is_ok_and(|s| equal(s.value(), sum).is_equal())
    })
}
