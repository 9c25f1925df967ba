//! What was found in a document: its claims about a robot, each with its verdict.

use crate::Schema;
use crate::finding::{Finding, Place};
use denavit_check as check;
use denavit_report::words::{Tongue, Wording};
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::Range;

/// A document with its verdicts.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Checked {
    /// Single changes that would turn several claims right.
    pub causes: Vec<Cause>,
    /// What it claims, in its order.
    pub claims: Vec<Claim>,
    /// What it is called.
    pub document: String,
    /// What else is worth saying.
    pub notes: Vec<Finding>,
    /// The robots that the claims are about.
    pub robots: Vec<String>,
    /// The version.
    pub schema: Schema,
    /// How many claims there are of each verdict.
    pub tally: Tally,
    /// What looks like a formula and was not judged.
    pub unjudged: Vec<Unjudged>,
}

/// A line that looks like a formula and was not judged.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Unjudged {
    /// Where it stands.
    pub at: Place,
    /// It, blanks run together.
    pub text: String,
    /// Why, in words.
    pub why: String,
}

/// How many claims there are of each verdict.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Tally {
    /// Right but for a wrong one before.
    pub carried: usize,
    /// Equal where a condition holds.
    pub conditional: usize,
    /// Proved equal.
    pub equal: usize,
    /// Neither proved nor refuted.
    pub undecided: usize,
    /// Lines that look like formulas and were not judged.
    pub unjudged: usize,
    /// Not read.
    pub unreadable: usize,
    /// Refuted.
    pub wrong: usize,
}

/// One change that turns several claims right; claims by their names.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Cause {
    /// The change in words.
    pub change: String,
    /// The change in the document, if it stands there.
    pub slip: Option<Slip>,
    /// Those that stay wrong.
    pub stays_wrong: Vec<String>,
    /// Those that it turns right.
    pub turns_right: Vec<String>,
    /// Those that it turns wrong.
    pub turns_wrong: Vec<String>,
}

/// An equation that says something about a robot.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Claim {
    /// What it is about, in words.
    pub about: String,
    /// Where it stands.
    pub at: Place,
    /// Its left side as printed.
    pub claim: String,
    /// What is right, of the first entry that decides the verdict.
    pub correct: Option<String>,
    /// Its formulas: one, or the entries of a matrix.
    pub entries: Vec<Entry>,
    /// What a matrix is as a whole.
    pub instead: Option<String>,
    /// It is right by proof; what is equal and not proved is right in numbers.
    pub proved: bool,
    /// What else is to be said.
    pub remarks: Vec<String>,
    /// Its robot, a number in the list, from 0.
    pub robot: usize,
    /// The slip of the first entry that decides the verdict.
    pub slip: Option<Slip>,
    /// `equal`, `wrong`, `conditional`, `carried`, `undecided` or `unreadable`.
    pub verdict: &'static str,
}

/// A formula with its verdict; each verdict has its own reasons.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Entry {
    /// Where it stands.
    pub at: Place,
    /// Carried: the claim that it follows from, a number in the list, from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<usize>,
    /// The column, in a matrix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
    /// Conditional: on what, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub condition: Option<String>,
    /// Conditional, carried or wrong: what is right, null if that is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub correct: Option<Option<String>>,
    /// Wrong: where printed and right differ, null if no place was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counterexample: Option<Option<Counterexample>>,
    /// Wrong: printed minus right.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub difference: Option<Option<String>>,
    /// Unreadable: why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub errors: Option<Vec<Unread>>,
    /// Wrong: where it is right all the same.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub holds_if: Option<Option<String>>,
    /// As it stands in the document, blanks run together.
    pub printed: String,
    /// Conditional or wrong: what else is to be said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remarks: Option<Vec<String>>,
    /// Wrong: other changes that are as small.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rivals: Option<Vec<Slip>>,
    /// The row, in a matrix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub row: Option<usize>,
    /// Wrong: the smallest change that makes it right, null if none was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slip: Option<Option<Slip>>,
    /// Wrong: the change that makes it right under a cause.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub under_cause: Option<UnderCause>,
    /// Equal: what must not be 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unless_zero: Option<Vec<String>>,
    /// `equal`, `wrong`, `conditional`, `carried`, `undecided` or `unreadable`.
    pub verdict: &'static str,
    /// Undecided or carried: why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// What could not be read.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Unread {
    /// Where.
    pub at: Place,
    /// What would help.
    pub hint: Option<String>,
    /// What is wrong.
    pub message: String,
}

/// A change of the printed text.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Slip {
    /// The formula after it.
    pub formula: String,
    /// What was done: `sign`, `sine-cosine`, `lost-factor`.
    pub kind: String,
    /// What should stand in which place.
    pub patches: Vec<Patch>,
    /// What was done, in words.
    pub words: String,
}

/// A part of the document that should read otherwise.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Patch {
    /// Where.
    pub at: Place,
    /// What should stand there.
    pub now: String,
    /// What does.
    pub was: String,
}

/// The change that makes a formula right once something else is changed.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct UnderCause {
    /// What is changed before: a number in the list of causes, from 0.
    pub cause: usize,
    /// The change.
    pub slip: Slip,
}

/// Where a printed formula has another value than the right one.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Counterexample {
    /// Symbols and their values.
    pub at: BTreeMap<String, f64>,
    /// The value of what is printed.
    pub printed: f64,
    /// The value that it should have.
    pub right: f64,
}

impl Checked {
    /// All claims of a document, its name and its text.
    pub fn of(name: &str, text: &str, checked: &check::Checked) -> Self {
        let document = &Document { text, checked };
        Checked {
            causes: checked.causes.iter().map(|c| document.cause(c)).collect(),
            claims: checked.claims.iter().map(|c| document.claim(c)).collect(),
            document: name.into(),
            notes: checked.notes.iter().map(|n| Finding::placed(&words().note(n), text)).collect(),
            robots: checked.robots.iter().map(|r| r.name.clone()).collect(),
            schema: Schema,
            tally: Tally::from(checked.tally()),
            unjudged: checked.unjudged.iter().map(|u| document.unjudged(u)).collect(),
        }
    }
}

impl From<check::Tally> for Tally {
    fn from(tally: check::Tally) -> Self {
        let check::Tally { equal, proved: _, wrong, conditional, carried, undecided, unreadable, unjudged } =
            tally;
        Tally { carried, conditional, equal, undecided, unjudged, unreadable, wrong }
    }
}

/// JSON is in English.
fn words() -> &'static dyn Wording {
    Tongue::English.words()
}

fn remarks(all: &[check::Remark]) -> Vec<String> {
    all.iter().map(|r| words().remarked(r)).collect()
}

/// A document with what was found in it.
struct Document<'a> {
    text: &'a str,
    checked: &'a check::Checked,
}

impl Document<'_> {
    fn place(&self, span: &Range<usize>) -> Place {
        Place::of(self.text, span)
    }

    /// The part at a place, blanks run together.
    fn source(&self, span: &Range<usize>) -> String {
        let source = self.text.get(span.clone()).unwrap_or_default();
        source.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    fn unjudged(&self, found: &check::Unjudged) -> Unjudged {
        let (at, text) = (self.place(&found.span), self.source(&found.span));
        Unjudged { at, text, why: words().skipped(&found.why) }
    }

    fn cause(&self, cause: &check::Cause) -> Cause {
        let name = |&(c, e): &(usize, usize)| {
            let claim = self.checked.claims.get(c)?;
            Some(words().entry(&claim.name, claim.entries.get(e)?.place))
        };
        let names = |places: &[(usize, usize)]| places.iter().filter_map(name).collect();
        Cause {
            change: words().change(&cause.change),
            slip: cause.slip.as_ref().map(|s| self.slip(s)),
            stays_wrong: names(&cause.stays_wrong),
            turns_right: names(&cause.turns_right),
            turns_wrong: names(&cause.turns_wrong),
        }
    }

    fn claim(&self, claim: &check::Claim) -> Claim {
        let entries: Vec<Entry> = claim.entries.iter().map(|e| self.entry(e)).collect();
        // The first entry with the claim's own verdict speaks for it.
        let standing = claim.standing();
        let speaker = entries.iter().find(|e| e.verdict == standing.name());
        Claim {
            about: words().about(&claim.about),
            at: self.place(&claim.span),
            claim: claim.name.clone(),
            correct: speaker.and_then(|e| e.correct.clone()).flatten(),
            slip: speaker.and_then(|e| e.slip.clone()).flatten(),
            entries,
            instead: claim.instead.map(|i| words().instead(i)),
            proved: claim.is_proved(),
            remarks: remarks(&claim.remarks),
            robot: claim.robot,
            verdict: standing.name(),
        }
    }

    fn entry(&self, entry: &check::Entry) -> Entry {
        let plain = self.plain(entry);
        match &entry.finding {
            check::Finding::Equal { unless_zero } => {
                let unless_zero =
                    (!unless_zero.is_empty()).then(|| unless_zero.iter().map(ToString::to_string).collect());
                Entry { unless_zero, ..plain }
            }
            check::Finding::Conditional { condition, correct, remarks: all } => Entry {
                condition: Some(words().right_where(condition)),
                correct: Some(words().either(correct)),
                remarks: Some(remarks(all)),
                ..plain
            },
            check::Finding::Carried { by, correct } => {
                let cause = self.checked.claims.get(*by);
                let why = cause.map(|c| words().carried(&c.name, self.place(&c.span).line));
                Entry { by: Some(*by), correct: Some(words().either(correct)), why, ..plain }
            }
            check::Finding::Undecided { why } => Entry { why: Some(words().unproved(*why)), ..plain },
            check::Finding::Unreadable(all) => {
                Entry { errors: Some(all.iter().map(|d| self.unread(d)).collect()), ..plain }
            }
            check::Finding::Wrong(wrong) => self.wrong(wrong, plain),
        }
    }

    /// An entry without reasons.
    fn plain(&self, entry: &check::Entry) -> Entry {
        Entry {
            at: self.place(&entry.span),
            by: None,
            column: entry.place.map(|p| p.1),
            condition: None,
            correct: None,
            counterexample: None,
            difference: None,
            errors: None,
            holds_if: None,
            printed: self.source(&entry.span),
            remarks: None,
            rivals: None,
            row: entry.place.map(|p| p.0),
            slip: None,
            under_cause: None,
            unless_zero: None,
            verdict: entry.finding.standing().name(),
            why: None,
        }
    }

    fn wrong(&self, wrong: &check::Wrong, plain: Entry) -> Entry {
        let under = wrong.under_cause.as_ref();
        Entry {
            correct: Some(words().either(&wrong.correct)),
            counterexample: Some(wrong.counterexample.as_ref().map(Counterexample::from)),
            difference: Some(wrong.difference.as_ref().map(ToString::to_string)),
            holds_if: Some(wrong.holds_if.map(|p| words().is_zero(p))),
            remarks: Some(remarks(&wrong.remarks)),
            rivals: Some(wrong.rivals.iter().map(|s| self.slip(s)).collect()),
            slip: Some(wrong.slip.as_ref().map(|s| self.slip(s))),
            under_cause: under.map(|(cause, slip)| UnderCause { cause: *cause, slip: self.slip(slip) }),
            ..plain
        }
    }

    fn unread(&self, found: &check::Unread) -> Unread {
        let found = words().unread(found);
        Unread { at: self.place(&found.span), hint: found.hint, message: found.message }
    }

    fn slip(&self, slip: &check::Slip) -> Slip {
        let patch = |p: &check::Patch| Patch {
            at: self.place(&p.span),
            now: p.now.clone(),
            was: self.source(&p.span),
        };
        Slip {
            formula: slip.formula.clone(),
            kind: slip.kind.id().into(),
            patches: slip.patches.iter().map(patch).collect(),
            words: words().slip(&slip.kind),
        }
    }
}

impl From<&check::Counterexample> for Counterexample {
    fn from(found: &check::Counterexample) -> Self {
        Counterexample { at: found.at.iter().cloned().collect(), printed: found.printed, right: found.right }
    }
}
