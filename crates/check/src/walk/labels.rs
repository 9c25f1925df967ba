//! Configurations that a document gives a name, `Pose R1: q = (30°, 20°)`, and speaks of by it later: `R1: z = 0.41`, `in pose R1`.

use super::Walk;
use super::cases::tells_goal;
use crate::numbers::Values;
use std::ops::Range;

/// The longest name, in words and in bytes.
const WORDS: usize = 4;
const LONGEST: usize = 40;
/// No more names are kept.
const MOST: usize = 40;
/// A name among other words has at least so many bytes.
const SHORTEST: usize = 5;

/// Names of configurations, in small letters.
#[derive(Clone, Debug, Default)]
pub(super) struct Labels(Vec<(String, Values)>);

impl Walk<'_> {
    /// Keeps the present configuration under the name that its line begins with, if it is not the one before.
    pub(super) fn learn_label(&mut self, span: &Range<usize>, before: &Values) {
        let Some(values) = self.at.whole(self.subject.joints().len()) else { return };
        if values == *before || self.labels.0.len() > MOST {
            return;
        }
        let text: &str = self.text;
        let Some(equals) = text.get(span.clone()).and_then(|s| s.find('=')).map(|i| span.start + i) else {
            return;
        };
        let start = text[..equals].rfind('\n').map_or(0, |i| i + 1);
        let head = text[start..equals].trim_end();
        // The last word is the name of the joints, or of the first one.
        let Some(cut) = head.rfind([' ', ':', ',', '(']) else { return };
        let Some(full) = plain(&head[..cut]) else { return };
        let short = full.rsplit(' ').next().filter(|w| w.len() < 4 && full.len() > w.len()).map(String::from);
        for name in std::iter::once(full).chain(short) {
            self.labels.0.retain(|l| l.0 != name);
            self.labels.0.push((name, values.clone()));
        }
    }

    /// Goes to the configuration whose name stands before a statement on its line: `R1: z = 0.41`.
    pub(super) fn recall_before(&mut self, at: usize) {
        if self.labels.0.is_empty() || self.in_inverse {
            return;
        }
        let before = self.text.get(..at).unwrap_or_default();
        let head = before.rsplit('\n').next().unwrap_or_default();
        let Some((head, rest)) = head.split_once(':') else { return };
        if rest.len() > 2 * LONGEST {
            return;
        }
        let Some(name) = plain(head) else { return };
        if let Some((_, values)) = self.labels.0.iter().find(|l| l.0 == name) {
            self.at.put(values.clone());
        }
    }

    /// Goes to the configuration that a sentence, in small letters, names.
    pub(super) fn recall_named(&mut self, sentence: &str) {
        if self.labels.0.is_empty() || tells_goal(sentence) {
            return;
        }
        let is_there = |name: &str| {
            name.len() >= SHORTEST
                && name.contains(' ')
                && sentence.match_indices(name).any(|(i, _)| {
                    let ends = |c: Option<char>| !c.is_some_and(char::is_alphanumeric);
                    ends(sentence[..i].chars().next_back()) && ends(sentence[i + name.len()..].chars().next())
                })
        };
        // `in point A` of `measuring point A`.
        let words: Vec<&str> =
            sentence.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).collect();
        let is_short = |name: &str| {
            let Some((before, letter)) = name.rsplit_once(' ') else { return false };
            let last = before.rsplit(' ').next().unwrap_or_default();
            letter.chars().count() == 1
                && words.windows(2).any(|w| w[1] == letter && w[0].len() >= SHORTEST && last.ends_with(w[0]))
        };
        let labels = || self.labels.0.iter();
        let mut named: Vec<&(String, Values)> = labels().filter(|l| is_there(&l.0)).collect();
        if named.is_empty() {
            named = labels().filter(|l| is_short(&l.0)).collect();
        }
        if let [(_, values)] = &named[..] {
            let values = values.clone();
            self.seek(false);
            self.at.put(values);
        }
    }
}

/// A name without marks around it, in small letters; nothing for longer texts.
fn plain(head: &str) -> Option<String> {
    let is_mark = |c: char| !c.is_alphanumeric() && c != ')';
    let head = head.trim_matches(is_mark).trim_end_matches(')');
    let words: Vec<&str> = head.split_whitespace().collect();
    let is_name = !head.is_empty()
        && head.len() <= LONGEST
        && words.len() <= WORDS
        && head.chars().any(char::is_alphabetic)
        && head.chars().all(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '\'' | '.'));
    is_name.then(|| words.join(" ").to_lowercase())
}
