//! Points for what a document shows, by a teacher's rubric: what was not judged is not wrong, it is marked by hand.

mod answers;

use super::outcome::{Checked, Claim, Entry, Standing};
use super::values_asked::{Answer, ValueSlip};
use denavit_reading::document::Format;
use denavit_symbolic::greek;
use std::ops::Range;

/// Which claims count how much.
#[derive(Clone, PartialEq, Debug)]
pub struct Rubric {
    /// What the sheet is called.
    pub title: Option<String>,
    /// The share that a formula earns which is right under a condition, 0 to 1.
    pub conditional: f64,
    /// The share that a formula earns which is right but for an earlier error, 0 to 1.
    pub carried: f64,
    /// The items in their order.
    pub items: Vec<Item>,
}

/// One item of a rubric.
#[derive(Clone, PartialEq, Debug)]
pub struct Item {
    /// What it is called.
    pub name: String,
    /// The left sides that belong to it, as printed: their letters and digits, `*` for any.
    pub claims: Vec<String>,
    /// What it is worth.
    pub points: f64,
    /// All or nothing; else each formula earns its share.
    pub whole: bool,
    /// How many formulas a full answer has: those that are missing earn nothing. 0 where that is not known.
    pub formulas: usize,
    /// Values that it asks for, each a formula of a full answer.
    pub answers: Vec<Answer>,
}

/// What a document earns, item by item.
#[derive(Clone, PartialEq, Debug)]
pub struct Sheet {
    /// As many as the rubric has items.
    pub marks: Vec<Mark>,
}

/// What a document earns for an item.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Mark {
    /// The points that are certain, to a hundredth.
    pub points: f64,
    /// Further points that a teacher decides on.
    pub open: f64,
    /// How many formulas are proved right, of how many that count: zeros and ones of a matrix do not, if they are right.
    pub right: [usize; 2],
    /// Claims that are not proved right, with what they are.
    pub others: Vec<(String, Standing)>,
    /// Values that are wrong, with their slips and what is right.
    pub slips: Vec<(String, ValueSlip, String)>,
    /// What is to be marked by hand.
    pub by_hand: Vec<Range<usize>>,
}

impl Sheet {
    /// The sum of what is certain.
    pub fn points(&self) -> f64 {
        self.marks.iter().map(|m| m.points).sum()
    }

    /// The sum of what a teacher decides on.
    pub fn open(&self) -> f64 {
        self.marks.iter().map(|m| m.open).sum()
    }
}

impl Rubric {
    /// The most that can be earned.
    pub fn points(&self) -> f64 {
        self.items.iter().map(|i| i.points).sum()
    }

    /// Holds a document against the values that the items ask for; what it says of them is judged by that alone.
    pub fn answer(&self, text: &str, format: Format, checked: &mut Checked) {
        answers::answer(self, text, format, checked);
    }

    /// What a document earns; `text` is the document. Where items ask for values, [`answer`](Self::answer) goes before.
    pub fn mark(&self, text: &str, checked: &Checked) -> Sheet {
        let all = self.items.iter().enumerate();
        Sheet { marks: all.map(|(k, item)| self.mark_item(k, item, text, checked)).collect() }
    }

    fn mark_item(&self, at: usize, item: &Item, text: &str, checked: &Checked) -> Mark {
        let mut mark = Mark::default();
        let patterns: Vec<String> = item.claims.iter().map(|c| plain(c)).collect();
        let values = item.answers.iter().flat_map(|a| &a.names).map(|name| plain(name));
        let lines: Vec<String> = patterns.iter().cloned().chain(values).collect();
        let is_meant = |name: &str| patterns.iter().any(|pattern| fits(pattern, &plain(name)));
        let mut shares: Vec<Option<f64>> = vec![];
        for claim in checked.claims.iter().filter(|c| is_meant(&c.name)) {
            for entry in counted(text, claim) {
                let share = self.share(entry.finding.standing());
                if share.is_none() {
                    mark.by_hand.push(entry.span.clone());
                }
                mark.right[0] += usize::from(entry.finding.standing() == Standing::Equal);
                shares.push(share);
            }
            if claim.standing() != Standing::Equal {
                mark.others.push((claim.name.clone(), claim.standing()));
            }
        }
        for answered in checked.answered.iter().filter(|a| a.of[0] == at) {
            shares.push(Some(if answered.slip.is_none() { 1.0 } else { 0.0 }));
            mark.right[0] += usize::from(answered.slip.is_none());
            if let Some(slip) = answered.slip {
                mark.others.push((answered.name.clone(), Standing::Wrong));
                mark.slips.push((answered.name.clone(), slip, answered.right.clone()));
            }
        }
        // A line that was passed over and names what is asked for.
        for line in &checked.unjudged {
            let source = text.get(line.span.clone()).unwrap_or_default();
            let left = source.split_once('=').map_or(source, |sides| sides.0).trim();
            if lines.iter().any(|pattern| fits(pattern, &plain(left))) {
                mark.by_hand.push(line.span.clone());
                mark.others.push((left.to_string(), Standing::Undecided));
                shares.push(None);
            }
        }
        mark.right[1] = shares.len();
        let count = shares.len().max(item.formulas + item.answers.len()).max(1) as f64;
        // A sum of nothing is -0.
        let certain = 0.0 + shares.iter().flatten().sum::<f64>();
        let open = shares.iter().filter(|s| s.is_none()).count() as f64;
        let [certain, open] = match item.whole {
            false => [certain, open],
            true if shares.len() < item.formulas + item.answers.len()
                || shares.iter().flatten().any(|s| *s < 1.0) =>
            {
                [0.0, 0.0]
            }
            true if open > 0.0 => [0.0, count],
            true => [certain, 0.0],
        };
        [mark.points, mark.open] =
            [certain, open].map(|share| (share / count * item.points * 100.0).round() / 100.0);
        mark
    }

    /// What a formula earns; nothing where a teacher looks at it.
    fn share(&self, standing: Standing) -> Option<f64> {
        match standing {
            Standing::Equal => Some(1.0),
            Standing::Conditional => Some(self.conditional),
            Standing::Carried => Some(self.carried),
            Standing::Wrong => Some(0.0),
            Standing::Undecided | Standing::Unreadable => None,
        }
    }
}

/// The formulas of a claim that count: of a matrix, not the zeros and ones that are right, unless there is nothing else.
fn counted<'a>(text: &str, claim: &'a Claim) -> Vec<&'a Entry> {
    let is_trivial = |e: &&Entry| {
        let printed = text.get(e.span.clone()).unwrap_or_default().trim();
        e.place.is_some() && e.finding.standing() == Standing::Equal && matches!(printed, "0" | "1")
    };
    let (trivial, all): (Vec<&Entry>, Vec<&Entry>) = claim.entries.iter().partition(is_trivial);
    if all.is_empty() { trivial.into_iter().take(1).collect() } else { all }
}

/// Letters and digits alone, Greek letters by their names.
fn plain(name: &str) -> String {
    let kept = name.chars().filter(|c| c.is_alphanumeric() || *c == '*');
    kept.map(|c| greek::name(c).map_or(c.to_string(), str::to_string)).collect()
}

/// Whether a name fits a pattern in which `*` stands for any letters.
fn fits(pattern: &str, name: &str) -> bool {
    let parts: Vec<&str> = pattern.split('*').collect();
    let (Some(first), Some(last)) = (parts.first(), parts.last()) else { return false };
    if parts.len() == 1 {
        return pattern == name;
    }
    let Some(mut rest) = name.strip_prefix(first) else { return false };
    for part in &parts[1..parts.len() - 1] {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

#[cfg(test)]
mod tests {
    use super::{fits, plain};

    #[test]
    fn patterns() {
        for (pattern, name, expected) in [
            ("T06", "T06", true),
            ("T06", "T16", false),
            ("t*", "t34", true),
            ("*x", "Px", true),
            ("n*z", "nyz", true),
            ("n*z", "nx", false),
            ("θ*", r"\theta_{2}", true),
        ] {
            assert_eq!(fits(&plain(pattern), &plain(name)), expected, "{pattern} {name}");
        }
    }
}
