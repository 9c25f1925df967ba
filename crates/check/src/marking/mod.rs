//! Points for what a document shows, by a teacher's rubric: what was not judged is not wrong, it is marked by hand.

mod answers;
mod configurations;
mod flat;
mod meant;
mod singular;

use super::outcome::{Checked, Claim, Entry, Skipped, Standing};
use super::values_asked::{Answer, ValueSlip};
use denavit_reading::document::Format;
use denavit_symbolic::greek;
use meant::Belongs;
use std::collections::BTreeSet;
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

/// What an item asks for: what answers it is found by that, whatever it is called.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Subject {
    /// The transforms of the links.
    Links,
    /// The pose of the tool in the base.
    Pose,
    /// A determinant.
    Determinant,
    /// Where the arm is singular.
    Singularities,
    /// The joints for a pose.
    Joints,
}

impl Subject {
    /// All of them.
    pub const ALL: [Subject; 5] =
        [Subject::Links, Subject::Pose, Subject::Determinant, Subject::Singularities, Subject::Joints];

    /// Its word in a rubric.
    pub fn name(self) -> &'static str {
        match self {
            Subject::Links => "links",
            Subject::Pose => "pose",
            Subject::Determinant => "determinant",
            Subject::Singularities => "singularities",
            Subject::Joints => "joints",
        }
    }
}

/// Whether an item asks for formulas or for numbers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Form {
    /// Formulas in the joints.
    Formulas,
    /// Numbers at a configuration.
    Numbers,
}

impl Form {
    /// Both.
    pub const ALL: [Form; 2] = [Form::Formulas, Form::Numbers];

    /// Its word in a rubric.
    pub fn name(self) -> &'static str {
        match self {
            Form::Formulas => "formulas",
            Form::Numbers => "numbers",
        }
    }
}

/// A configuration that an item asks for, in numbers.
#[derive(Clone, PartialEq, Debug)]
pub struct Asked {
    /// The joints, radians and metres.
    pub q: Vec<f64>,
    /// How far the digits of what is given let each of them be off.
    pub within: Vec<f64>,
}

/// One item of a rubric.
#[derive(Clone, PartialEq, Debug, Default)]
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
    /// What it asks for; where it does not say it, what its left sides name.
    pub about: Vec<Subject>,
    /// Formulas or numbers alone; nothing where either will do.
    pub form: Option<Form>,
    /// All configurations for the poses that are given; each joint of them is a formula of a full answer.
    pub configurations: Vec<Asked>,
    /// All values of joints at which the arm is singular: the joint (a number from 1), and its value as a formula.
    pub zeros: Vec<(usize, String)>,
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
    /// Claims whose value is right, and whose name says that it is something else.
    pub named_otherwise: Vec<String>,
    /// Of the configurations that are asked for, how many are there and right, and how many there are.
    pub configurations: Option<[usize; 2]>,
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
        configurations::answer(self, text, format, checked);
        singular::answer(self, text, checked);
        checked.answered.sort_by_key(|a| (a.span.start, a.of));
    }

    /// What a document earns; `text` is the document. Where items ask for values, [`answer`](Self::answer) goes before.
    pub fn mark(&self, text: &str, checked: &Checked) -> Sheet {
        let belonging = meant::belonging(&self.items, text, checked);
        let all = self.items.iter().enumerate();
        Sheet { marks: all.map(|(k, item)| self.mark_item(k, item, text, checked, &belonging)).collect() }
    }

    fn mark_item(
        &self,
        at: usize,
        item: &Item,
        text: &str,
        checked: &Checked,
        belonging: &[Vec<Option<Belongs>>],
    ) -> Mark {
        let mut mark = Mark::default();
        let patterns = item.claims.iter().map(|c| plain(c));
        let values = item.answers.iter().flat_map(|a| &a.names).map(|name| plain(name));
        let is_of_joints = [Subject::Joints, Subject::Singularities].iter().any(|s| item.about.contains(s));
        let joints = ["q*", "theta*", "th*"].into_iter().filter(|_| is_of_joints).map(String::from);
        let lines: Vec<String> = patterns.chain(values).chain(joints).collect();
        let mut shares: Vec<Option<f64>> = vec![];
        let repeated = meant::repeated(text, checked);
        for ((claim, belongs), is_again) in checked.claims.iter().zip(belonging).zip(repeated) {
            let Some(belongs) = belongs[at].filter(|_| !is_again) else { continue };
            if belongs == Belongs::NamedOtherwise {
                // Each entry is proved to be that of the matrix that is asked for.
                let count = counted_of_value(text, claim);
                shares.extend(vec![Some(1.0); count]);
                mark.right[0] += count;
                mark.named_otherwise.push(claim.name.clone());
                continue;
            }
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
            if answered.by_hand {
                if answered.counts > 0 {
                    shares.extend(vec![None; answered.counts]);
                    mark.by_hand.push(answered.span.clone());
                    mark.others.push((answered.name.clone(), Standing::Undecided));
                }
                continue;
            }
            shares.extend(vec![Some(if answered.slip.is_none() { 1.0 } else { 0.0 }); answered.counts]);
            if answered.slip.is_none() {
                mark.right[0] += answered.counts;
            }
            if let Some(slip) = answered.slip {
                mark.others.push((answered.name.clone(), Standing::Wrong));
                mark.slips.push((answered.name.clone(), slip, answered.right.clone()));
            }
        }
        if !item.configurations.is_empty() {
            let found: BTreeSet<usize> = checked
                .answered
                .iter()
                .filter(|a| a.of[0] == at && a.slip.is_none() && !a.by_hand && a.of[1] >= item.answers.len())
                .map(|a| a.of[1])
                .collect();
            mark.configurations = Some([found.len(), item.configurations.len()]);
        }
        // A line that was passed over and names what is asked for.
        for line in &checked.unjudged {
            let source = text.get(line.span.clone()).unwrap_or_default();
            let left = source.split_once('=').map_or(source, |sides| sides.0).trim();
            // A list of values without a name.
            let is_list = !item.configurations.is_empty() && left.starts_with(['(', '[']);
            if is_list || lines.iter().any(|pattern| fits(pattern, &plain(left))) {
                mark.by_hand.push(line.span.clone());
                mark.others.push((left.to_string(), Standing::Undecided));
                shares.push(None);
            }
        }
        let full = item.full();
        // What belongs to no item, and may be what is missing here.
        if shares.len() < full.max(1) {
            let mut missing = full.max(1) - shares.len();
            for (claim, belongs) in checked.claims.iter().zip(belonging) {
                let is_free = belongs.iter().all(Option::is_none);
                if missing > 0 && is_free && meant::may_be_meant(item, claim, checked) {
                    let count = counted(text, claim).len().min(missing);
                    missing -= count;
                    shares.extend(vec![None; count]);
                    mark.by_hand.push(claim.span.clone());
                    mark.others.push((claim.name.clone(), Standing::Undecided));
                }
            }
        }
        // What could not be read at all, where nothing else is there.
        if shares.is_empty() && !item.about.is_empty() {
            let is_named = |left: &str| {
                let names = self.items.iter().flat_map(|i| &i.claims);
                names.into_iter().any(|pattern| fits(&plain(pattern), &plain(left)))
            };
            for line in &checked.unjudged {
                let source = text.get(line.span.clone()).unwrap_or_default();
                let Some((left, _)) = source.split_once('=') else { continue };
                let is_no_formula = matches!(line.why, Skipped::Given | Skipped::Unused(_));
                if !is_no_formula && !is_named(left) && shares.len() < full.max(1) {
                    mark.by_hand.push(line.span.clone());
                    shares.push(None);
                }
            }
            // Nothing is known of how much of the answer it is.
            if !shares.is_empty() {
                shares.resize(full.max(1), None);
            }
        }
        mark.right[1] = shares.len();
        let count = shares.len().max(full).max(1) as f64;
        // A sum of nothing is -0.
        let certain = 0.0 + shares.iter().flatten().sum::<f64>();
        let open = shares.iter().filter(|s| s.is_none()).count() as f64;
        let [certain, open] = match item.whole {
            false => [certain, open],
            true if shares.len() < full || shares.iter().flatten().any(|s| *s < 1.0) => [0.0, 0.0],
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

impl Item {
    /// How many formulas a full answer has.
    fn full(&self) -> usize {
        self.formulas + self.answers.len()
    }
}

/// How many entries count of a matrix that is wrong by its name alone.
fn counted_of_value(text: &str, claim: &Claim) -> usize {
    let printed = |e: &&Entry| text.get(e.span.clone()).unwrap_or_default().trim();
    claim.entries.iter().filter(|e| e.place.is_some() && !matches!(printed(e), "0" | "1")).count().max(1)
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

/// Whether parts of a text have something in common.
fn touch(a: &Range<usize>, b: &Range<usize>) -> bool {
    a.start < b.end && b.start < a.end
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
