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

/// No more readings of a document than these.
const MAX_READINGS: usize = 240;
/// Longer documents are not read again.
const MAX_BYTES: usize = 60_000;
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
        for d in used(text, walked, k) {
            if seen.contains(&d.span.start) || left == 0 {
                continue;
            }
            let search = Search { text, format, plan, options, walked, trial: &trial };
            if let Some((slip, mended)) = search.mended(d, k, *of, claims, &mut left) {
                seen.insert(d.span.start);
                // An entry of the pose is given where it is solved for, whatever formula stands for it further up.
                let pose = plan.subjects[subject].pose().matrix();
                let names = walked.names_of(subject);
                let should = read(&slip.formula, &(0..slip.formula.len()), names).ok().map(|s| s.value());
                let is_entry =
                    |e: &Expr| !e.symbols().is_empty() && should.is_some_and(|s| equal(s, *e).is_equal());
                let is_given = pose.iter().take(3).flatten().any(is_entry);
                blame(d, slip, &mended, is_given, claims);
                break;
            }
        }
    }
}

/// The helper is wrong, and what it made wrong is carried, or right where the helper is known without its formula.
fn blame(d: &Defined, slip: Slip, mended: &[usize], is_given: bool, claims: &mut Vec<Claim>) {
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
    for &k in mended.iter().filter(|k| **k != by) {
        for entry in &mut claims[k].entries {
            match &entry.finding {
                Finding::Wrong(_) if is_given => entry.finding = Finding::Equal { unless_zero: vec![] },
                Finding::Wrong(wrong) => {
                    entry.finding = Finding::Carried { by, correct: wrong.correct.clone() }
                }
                _ => {}
            }
        }
    }
}

/// The helpers that a claim uses, directly or through another one, the nearest first.
fn used<'a>(text: &str, walked: &'a Walked, claim: usize) -> Vec<&'a Defined> {
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
    /// The first change of a helper that makes a claim right, and none wrong that is right; with all that it makes right.
    fn mended(
        &self,
        d: &Defined,
        claim: usize,
        of: Expr,
        claims: &[Claim],
        left: &mut usize,
    ) -> Option<(Slip, Vec<usize>)> {
        let source = self.text.get(d.span.clone())?;
        let lengths = lengths(source, &self.plan.subjects[d.subject].description);
        for edit in edits(source, &d.printed, &lengths) {
            let formula = edited(source, &edit)?;
            if *left == 0 {
                return None;
            }
            *left -= 1;
            let text = [&self.text[..d.span.start], &formula, &self.text[d.span.end..]].concat();
            let document: Document = document::read(&text, self.format);
            let walked = self.plan.walk(&text, &document, self.options);
            // Statements behind the change have moved; a mended helper may be a claim of its own.
            let place = |start: usize| match start >= d.span.end {
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
            let mended: Vec<usize> = mended.into_iter().chain(equations).collect();
            let breaks = (0..count).any(|k| {
                self.walked.assertions[k].spoken.is_some()
                    && is_right(&claims[k])
                    && !now(k).is_some_and(is_right)
            });
            if !mended.contains(&claim) || breaks {
                continue;
            }
            let moved = |p: &Patch| Patch {
                span: p.span.start + d.span.start..p.span.end + d.span.start,
                now: p.now.clone(),
            };
            let kind = match edit.kind {
                Kind::Arguments => SlipKind::Arguments,
                Kind::Slip(slip) => SlipKind::Formula(slip),
            };
            let patches = edit.patches.iter().map(moved).collect();
            return Some((Slip { kind, patches, formula }, mended));
        }
        None
    }
}
