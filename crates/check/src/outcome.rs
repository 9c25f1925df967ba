//! What is said of a document.

use super::facts::{About, Change, Condition, Instead, Remark, SlipKind, Unproved};
use super::formula::Formula;
use super::note::{Note, Unread, Unreadable};
use super::values_asked::Answered;
use denavit::description::Description;
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;

/// A document, held against a robot.
#[derive(Clone, Debug)]
pub struct Checked {
    /// What it claims, in its order.
    pub claims: Vec<Claim>,
    /// Single changes that would turn several claims right.
    pub causes: Vec<Cause>,
    /// What looks like a formula and was not judged, in the order of the text.
    pub unjudged: Vec<Unjudged>,
    /// What else is worth saying: tables and directives with errors.
    pub notes: Vec<Note>,
    /// The robots that the claims are about.
    pub robots: Vec<Description>,
    /// What was held against the values that a rubric asks for (`Rubric::answer`).
    pub answered: Vec<Answered>,
}

/// How many claims there are of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Right: proved equal, or right in numbers.
    pub equal: usize,
    /// Of these, what is proved.
    pub proved: usize,
    /// Refuted.
    pub wrong: usize,
    /// Equal where a condition holds.
    pub conditional: usize,
    /// Right but for a wrong one before.
    pub carried: usize,
    /// Neither proved nor refuted.
    pub undecided: usize,
    /// Not read.
    pub unreadable: usize,
    /// Lines that look like formulas and were not judged.
    pub unjudged: usize,
}

/// A line that looks like a formula and was not judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Unjudged {
    /// Where it stands.
    pub span: Range<usize>,
    /// Why.
    pub why: Skipped,
}

/// Why a formula was not judged.
#[derive(Clone, Debug, PartialEq)]
pub enum Skipped {
    /// It could not be read.
    Unreadable(Unreadable),
    /// It defines a name that nothing uses that was found right.
    Unused(String),
    /// It is read, but says nothing that is known of the robot.
    SaysNothing,
    /// It was taken for a configuration that is given, and nothing that is judged rests on it.
    Given,
    /// It stands among words, and nothing shows where it begins and ends.
    AmongWords,
    /// A program gives it, but nothing says what it is.
    OfProgram(String),
    /// The document has more formulas than are judged.
    TooMany,
}

impl Checked {
    /// Puts the claims into the order of the text.
    pub(super) fn sort(&mut self) {
        let mut order: Vec<usize> = (0..self.claims.len()).collect();
        order.sort_by_key(|&k| (self.claims[k].span.start, k));
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(new, &old)| place[old] = new);
        let mut claims: Vec<Option<Claim>> = std::mem::take(&mut self.claims).into_iter().map(Some).collect();
        self.claims = order.iter().filter_map(|&k| claims[k].take()).collect();
        for entry in self.claims.iter_mut().flat_map(|c| &mut c.entries) {
            if let Finding::Carried { by, .. } = &mut entry.finding {
                *by = place.get(*by).copied().unwrap_or(*by);
            }
        }
        for cause in &mut self.causes {
            let all = [&mut cause.turns_right, &mut cause.turns_wrong, &mut cause.stays_wrong];
            all.into_iter().flatten().for_each(|at| at.0 = place.get(at.0).copied().unwrap_or(at.0));
        }
    }

    /// The number of claims of each kind.
    pub fn tally(&self) -> Tally {
        let mut tally = Tally { unjudged: self.unjudged.len(), ..Tally::default() };
        for answered in self.answered.iter().filter(|a| !a.by_hand) {
            match answered.slip {
                None => tally.equal += 1,
                Some(_) => tally.wrong += 1,
            }
        }
        for claim in &self.claims {
            tally.proved += usize::from(claim.is_proved());
            match claim.standing() {
                Standing::Equal => tally.equal += 1,
                Standing::Wrong => tally.wrong += 1,
                Standing::Conditional => tally.conditional += 1,
                Standing::Carried => tally.carried += 1,
                Standing::Undecided => tally.undecided += 1,
                Standing::Unreadable => tally.unreadable += 1,
            }
        }
        tally
    }
}

/// One statement of the document about the robot.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Where it stands.
    pub span: Range<usize>,
    /// Its left side as printed.
    pub name: String,
    /// What it is about.
    pub about: About,
    /// Its formulas: one, or the entries of a matrix.
    pub entries: Vec<Entry>,
    /// What a matrix with several wrong entries is as a whole.
    pub instead: Option<Instead>,
    /// What else is to be said of it.
    pub remarks: Vec<Remark>,
    /// Which of the robots it is about.
    pub robot: usize,
}

/// The verdict on a claim, or on one of its entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Proved equal.
    Equal,
    /// Proved equal, or found so in every sample, where a condition holds.
    Conditional,
    /// Refuted, but it follows correctly from what is wrong before it.
    Carried,
    /// Refuted.
    Wrong,
    /// Neither proved nor refuted.
    Undecided,
    /// Not read.
    Unreadable,
}

impl Standing {
    /// The word of the JSON form.
    pub fn name(self) -> &'static str {
        match self {
            Standing::Equal => "equal",
            Standing::Conditional => "conditional",
            Standing::Carried => "carried",
            Standing::Wrong => "wrong",
            Standing::Undecided => "undecided",
            Standing::Unreadable => "unreadable",
        }
    }
}

impl Claim {
    /// The verdict on all of it: wrong if one entry is, else unreadable if one is, and so on.
    pub fn standing(&self) -> Standing {
        let has = |s| self.entries.iter().any(|e| e.finding.standing() == s);
        let order = [
            Standing::Wrong,
            Standing::Carried,
            Standing::Unreadable,
            Standing::Undecided,
            Standing::Conditional,
        ];
        order.into_iter().find(|&s| has(s)).unwrap_or(Standing::Equal)
    }

    /// True if it is right by proof: what agrees with printed digits, is found by a search or seen in samples is not.
    pub fn is_proved(&self) -> bool {
        // Tables have a proof of their own; a helper is right by what uses it.
        let is_apart = matches!(self.about, About::Table | About::TableRow | About::Helper);
        let by_proof = |e: &Entry| is_apart || !e.identities.is_empty();
        self.standing() == Standing::Equal && self.entries.iter().all(by_proof)
    }
}

/// A printed formula.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Row and column, from 1, in a matrix.
    pub place: Option<(usize, usize)>,
    /// Where it stands.
    pub span: Range<usize>,
    /// The verdict.
    pub finding: Finding,
    /// The equalities that it rests on, each proved for all configurations: what is printed, and what the robot makes of it; of
    /// a joint's value, that the sine of its difference to the joint, times a length, is 0.
    pub identities: Vec<[Expr; 2]>,
}

/// The verdict on a formula, with its reasons.
#[derive(Clone, Debug)]
pub enum Finding {
    /// Proved equal; the expressions must not be 0.
    Equal {
        /// Denominators.
        unless_zero: Vec<Formula>,
    },
    /// Right where a condition holds.
    Conditional {
        /// The condition.
        condition: Condition,
        /// What holds everywhere, each value in the author's notation; nothing if it is not known.
        correct: Vec<String>,
        /// What happens elsewhere.
        remarks: Vec<Remark>,
    },
    /// Refuted.
    Wrong(Box<Wrong>),
    /// Refuted, but right given what another claim of the document says that is wrong.
    Carried {
        /// That claim: a number in [`Checked::claims`].
        by: usize,
        /// The right formula, as in [`Wrong::correct`].
        correct: Vec<String>,
    },
    /// Neither proved nor refuted.
    Undecided {
        /// Why.
        why: Unproved,
    },
    /// Not read.
    Unreadable(Vec<Unread>),
}

impl Finding {
    /// The verdict alone.
    pub fn standing(&self) -> Standing {
        match self {
            Finding::Equal { .. } => Standing::Equal,
            Finding::Conditional { .. } => Standing::Conditional,
            Finding::Wrong(_) => Standing::Wrong,
            Finding::Carried { .. } => Standing::Carried,
            Finding::Undecided { .. } => Standing::Undecided,
            Finding::Unreadable(_) => Standing::Unreadable,
        }
    }
}

/// Why a formula is wrong, and what it should be.
#[derive(Clone, Debug, Default)]
pub struct Wrong {
    /// The right formula, each value of it, in the author's notation where the slip is known; nothing if it is not known.
    pub correct: Vec<String>,
    /// The smallest change that makes it right.
    pub slip: Option<Slip>,
    /// Other changes that are as small.
    pub rivals: Vec<Slip>,
    /// Printed minus right.
    pub difference: Option<Formula>,
    /// A configuration at which both values differ.
    pub counterexample: Option<Counterexample>,
    /// It is right all the same where this parameter is 0.
    pub holds_if: Option<Symbol>,
    /// The change that makes it right under a cause (its number in [`Checked::causes`]).
    pub under_cause: Option<(usize, Slip)>,
    /// What else is to be said.
    pub remarks: Vec<Remark>,
}

/// A change of the printed text.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    /// What was done.
    pub kind: SlipKind,
    /// Parts of the document and what should stand there.
    pub patches: Vec<Patch>,
    /// The formula after the change.
    pub formula: String,
}

/// A part of the document that should read otherwise.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Patch {
    /// The part; empty where something is missing.
    pub span: Range<usize>,
    /// What should stand there.
    pub now: String,
}

/// A configuration at which a printed formula has another value than the right one.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// Symbols and their values; angles in radians, lengths in metres.
    pub at: Vec<(String, f64)>,
    /// The value of what is printed.
    pub printed: f64,
    /// The value that it should have.
    pub right: f64,
}

/// One change that turns several claims right.
#[derive(Clone, Debug)]
pub struct Cause {
    /// The change.
    pub change: Change,
    /// The place in the document, and what should stand there, if it is a definition.
    pub slip: Option<Slip>,
    /// Claim and entry (numbers from 0) that it turns right.
    pub turns_right: Vec<(usize, usize)>,
    /// Those that it turns wrong.
    pub turns_wrong: Vec<(usize, usize)>,
    /// Those that stay wrong.
    pub stays_wrong: Vec<(usize, usize)>,
}
