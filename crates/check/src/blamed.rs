//! A wrong value of a joint whose fault is in a helper: the one change of the helper's definition that makes it right.
//!
//! Each change is made in the text, and the document is read once more; nothing else is known of how formulas use one another.

use super::CheckOptions;
use super::edits::{Kind, edited, edits, lengths};
use super::facts::{About, SlipKind};
use super::lexis::read;
use super::outcome::{Claim, Entry, Finding, Patch, Slip, Standing, Wrong};
use super::plan::{Plan, Walked};
use super::trial::Trial;
use super::unjudged::mentions;
use super::walk::{Defined, Piece, Spoken};
use super::{habits::Places, values};
use denavit_reading::document::{self, Document, Format};
use denavit_symbolic::{Expr, equal};
use std::collections::BTreeSet;
use std::ops::Range;

/// No more readings of a document than these.
const MAX_READINGS: usize = 240;
/// Longer documents are not read again.
const MAX_BYTES: usize = 60_000;
/// No more wrong equations before a value are looked at.
const MOST_BEFORE: usize = 4;
/// A change is looked at if it gives the own value at such a share of the configurations.
const LEAST_SHARE: f64 = 0.2;

/// Names the helpers that make values of joints wrong; the values are carried then.
pub(super) fn helpers(
    text: &str,
    format: Format,
    plan: &Plan,
    options: &CheckOptions,
    walked: &Walked,
    claims: &mut Vec<Claim>,
) {
    let is_open = |c: &Claim| match c.entries.first().map(|e| &e.finding) {
        Some(Finding::Wrong(wrong)) => wrong.slip.is_none() && c.about == About::Joint,
        _ => false,
    };
    let count = walked.assertions.len();
    if text.len() > MAX_BYTES || options.language.is_some() {
        return;
    }
    let mut left = MAX_READINGS;
    let mut seen: BTreeSet<usize> = BTreeSet::new();
    for k in 0..count.min(claims.len()) {
        if !is_open(&claims[k]) {
            continue;
        }
        let Some(Spoken::Joint { of, .. }) = &walked.assertions[k].spoken else { continue };
        let subject = walked.assertions[k].subject;
        let trial = Trial::new(&plan.subjects[subject], &Places(plan.habits.columns));
        let search = Search { text, format, plan, options, walked, trial: &trial };
        let before: Vec<usize> = mended_before(text, walked, k, claims);
        let found = before.into_iter().find_map(|by| {
            let (span, slip) = slip_of(&claims[by])?;
            let changes = std::iter::once(slip.clone());
            let (_, mended) = search.mended(span, changes, (k, *of), claims, &mut left)?;
            Some((by, mended))
        });
        if let Some((by, mended)) = found {
            // The name is one that the robot gives: a value is right with it, whatever stands for it further up.
            let (values, others): (Vec<Mended>, Vec<Mended>) =
                mended.into_iter().partition(|m| walked.assertions[m.at].spoken.is_some());
            as_found(by, &values, claims);
            carry(by, &others, claims);
            continue;
        }
        for d in used(text, walked, k) {
            if seen.contains(&d.span.start) || left == 0 {
                continue;
            }
            let changes = search.changes(d);
            if let Some((slip, mended)) = search.mended(&d.span, changes, (k, *of), claims, &mut left) {
                seen.insert(d.span.start);
                // An entry of the pose is given where it is solved for, whatever formula stands for it further up.
                let pose = plan.subjects[subject].pose().matrix();
                let names = walked.names_of(subject);
                let should = read(&slip.formula, &(0..slip.formula.len()), names).ok().map(|s| s.value());
                let is_entry =
                    |e: &Expr| !e.symbols().is_empty() && should.is_some_and(|s| equal(s, *e).is_equal());
                // By custom, or by its index: `uz` is the z of what is told of the hand.
                let row = ["x", "y", "z"].iter().position(|axis| d.name.ends_with(axis));
                let own_row = row.is_some_and(|r| pose[r].iter().any(is_entry));
                let is_given = own_row || d.by_custom && pose.iter().take(3).flatten().any(is_entry);
                blame(d, slip, &mended, is_given, claims);
                break;
            }
        }
    }
}

/// The helper is wrong, and what it made wrong is carried, or right where the helper is known without its formula.
fn blame(d: &Defined, slip: Slip, mended: &[Mended], is_given: bool, claims: &mut Vec<Claim>) {
    // A name behind an equation that is wrong itself: the equation is the fault.
    let own = claims.iter().position(|c| c.span == d.statement && c.standing() == Standing::Wrong);
    let by = own.unwrap_or(claims.len());
    let wrong = Wrong { correct: vec![slip.formula.clone()], slip: Some(slip), ..Wrong::default() };
    let finding = Finding::Wrong(Box::new(wrong));
    if own.is_none() {
        claims.push(Claim {
            span: d.statement.clone(),
            name: d.shown.clone(),
            about: About::Helper,
            entries: vec![Entry { place: None, span: d.span.clone(), finding, identities: vec![] }],
            instead: None,
            remarks: vec![],
            robot: d.subject,
        });
    }
    match is_given {
        true => as_found(by, mended, claims),
        false => carry(by, mended, claims),
    }
}

/// What a claim made wrong is what was found of it without that.
fn as_found(by: usize, mended: &[Mended], claims: &mut [Claim]) {
    for Mended { at, found } in mended.iter().filter(|m| m.at != by) {
        for (entry, (finding, identities)) in claims[*at].entries.iter_mut().zip(found) {
            if matches!(entry.finding, Finding::Wrong(_)) {
                (entry.finding, entry.identities) = (finding.clone(), identities.clone());
            }
        }
    }
}

/// What a claim made wrong is carried.
fn carry(by: usize, mended: &[Mended], claims: &mut [Claim]) {
    for m in mended.iter().filter(|m| m.at != by) {
        for entry in &mut claims[m.at].entries {
            if let Finding::Wrong(wrong) = &entry.finding {
                entry.finding = Finding::Carried { by, correct: wrong.correct.clone() };
            }
        }
    }
}

/// The one formula of a wrong claim and the change that makes it right.
fn slip_of(claim: &Claim) -> Option<(&Range<usize>, &Slip)> {
    let [Entry { span, finding: Finding::Wrong(wrong), .. }] = &claim.entries[..] else { return None };
    Some((span, wrong.slip.as_ref()?))
}

/// The equations before a claim that are wrong by one change and whose names it uses, the nearest first.
fn mended_before(text: &str, walked: &Walked, claim: usize, claims: &[Claim]) -> Vec<usize> {
    let own = &walked.assertions[claim];
    let source = text.get(own.span.clone()).unwrap_or_default();
    let is_used = |&k: &usize| {
        let c = &claims[k];
        let is_before = c.span.end <= own.span.start && c.robot == own.subject;
        is_before && c.about != About::Joint && slip_of(c).is_some() && mentions(source, &c.name)
    };
    (0..walked.assertions.len().min(claims.len())).rev().filter(is_used).take(MOST_BEFORE).collect()
}

/// A claim that a mended helper makes right, and what is found of its entries then, with what that rests on.
struct Mended {
    at: usize,
    found: Vec<(Finding, Vec<[Expr; 2]>)>,
}

/// The helpers that a claim uses, directly or through another one, the nearest first.
pub(super) fn used<'a>(text: &str, walked: &'a Walked, claim: usize) -> Vec<&'a Defined> {
    let assertion = &walked.assertions[claim];
    let mut sources = vec![text.get(assertion.span.clone()).unwrap_or_default()];
    let mut found: Vec<&Defined> = vec![];
    for d in walked.defined.iter().rev() {
        let is_before = d.from <= assertion.span.start && d.subject == assertion.subject;
        let own = assertion.span.start < d.statement.end && d.statement.start < assertion.span.end;
        if is_before && !own && sources.iter().any(|s| mentions(s, &d.name)) {
            sources.push(text.get(d.span.clone()).unwrap_or_default());
            found.push(d);
        }
    }
    found
}

struct Search<'a> {
    text: &'a str,
    format: Format,
    plan: &'a Plan,
    options: &'a CheckOptions,
    walked: &'a Walked,
    trial: &'a Trial,
}

impl Search<'_> {
    /// The changes of a helper's formula.
    fn changes(&self, d: &Defined) -> impl Iterator<Item = Slip> + use<'_> {
        let source = self.text.get(d.span.clone()).unwrap_or_default();
        let lengths = lengths(source, &self.plan.subjects[d.subject].description);
        let start = d.span.start;
        edits(source, &d.printed, &lengths).into_iter().map_while(move |edit| {
            let formula = edited(source, &edit)?;
            let moved =
                |p: &Patch| Patch { span: p.span.start + start..p.span.end + start, now: p.now.clone() };
            let kind = match edit.kind {
                Kind::Arguments => SlipKind::Arguments,
                Kind::Slip(slip) => SlipKind::Formula(slip),
            };
            let patches = edit.patches.iter().map(moved).collect();
            Some(Slip { kind, patches, formula })
        })
    }

    /// The first change of a formula that makes a value right, and none wrong that is right; with all that it makes right.
    fn mended(
        &self,
        span: &Range<usize>,
        changes: impl Iterator<Item = Slip>,
        (claim, of): (usize, Expr),
        claims: &[Claim],
        left: &mut usize,
    ) -> Option<(Slip, Vec<Mended>)> {
        let source = self.text.get(span.clone())?;
        for slip in changes {
            if *left == 0 {
                return None;
            }
            *left -= 1;
            let formula = &slip.formula;
            let text = [&self.text[..span.start], formula, &self.text[span.end..]].concat();
            let document: Document = document::read(&text, self.format);
            let walked = self.plan.walk(&text, &document, self.options);
            // Statements behind the change have moved; a mended helper may be a claim of its own.
            let place = |start: usize| match start >= span.end {
                true => (start + formula.len()).saturating_sub(source.len()),
                false => start,
            };
            let same = |k: usize| {
                let start = place(self.walked.assertions[k].span.start);
                walked.assertions.iter().position(|a| a.span.start == start && a.spoken.is_some())
            };
            let Some(Spoken::Joint { of: other, branches, .. }) =
                same(claim).and_then(|k| walked.assertions[k].spoken.as_ref())
            else {
                continue;
            };
            if *other != of || self.trial.shares(of, branches)[0] < LEAST_SHARE {
                continue;
            }
            let (judged, _) = values::judge(&text, self.plan, &walked);
            let is_right = |c: &Claim| matches!(c.standing(), Standing::Equal | Standing::Conditional);
            let now = |k: usize| {
                let at = same(k)?;
                judged.iter().find(|j| j.0 == at).map(|j| &j.1)
            };
            let count = self.walked.assertions.len().min(claims.len());
            let mended: Vec<usize> = (0..count)
                .filter(|&k| claims[k].standing() == Standing::Wrong && now(k).is_some_and(is_right))
                .collect();
            // Equations that are right then, too.
            let holds = |k: usize| {
                let start = place(self.walked.assertions[k].span.start);
                let same = walked.assertions.iter().find(|a| a.span.start == start && a.spoken.is_none());
                let is_right = |p: &Piece| matches!(p, Piece::Pair(p) if equal(p.value, p.wanted).is_equal());
                same.is_some_and(|a| !a.pieces.is_empty() && a.pieces.iter().all(is_right))
            };
            let equations = (0..count).filter(|&k| {
                self.walked.assertions[k].spoken.is_none()
                    && claims[k].standing() == Standing::Wrong
                    && holds(k)
            });
            let found = |k: usize| {
                let at = same(k);
                let judged = judged.iter().find(|j| Some(j.0) == at).map(|j| &j.1);
                let of = |e: &Entry| (e.finding.clone(), e.identities.clone());
                judged.map(|c| c.entries.iter().map(of).collect()).unwrap_or_default()
            };
            let of_values = mended.into_iter().map(|at| Mended { at, found: found(at) });
            // These are equal by canonical form.
            let equal = |at: usize| {
                let finding = (Finding::Equal { unless_zero: vec![] }, vec![]);
                Mended { at, found: vec![finding; claims[at].entries.len()] }
            };
            let mended: Vec<Mended> = of_values.chain(equations.map(equal)).collect();
            let breaks = (0..count).any(|k| {
                self.walked.assertions[k].spoken.is_some()
                    && is_right(&claims[k])
                    && !now(k).is_some_and(is_right)
            });
            if !mended.iter().any(|m| m.at == claim) || breaks {
                continue;
            }
            return Some((slip, mended));
        }
        None
    }
}
