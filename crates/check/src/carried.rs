//! Errors carried forward: a formula that is wrong, but right given what the author printed before.
//!
//! Each wrong matrix or entry is put into the place of the robot's own, and the document is read once more; what then is right
//! follows from it.

use super::CheckOptions;
use super::facts::{About, Meaning, Remark, Unproved};
use super::numbers;
use super::outcome::{Claim, Finding, Standing};
use super::plan::{Plan, Walked};
use super::subject::Subject;
use super::tables::{Judged, Standing as TableStanding};
use super::walk::Piece;
use denavit_reading::document::Document;
use denavit_reading::slip::Points;
use denavit_symbolic::equal;
use std::collections::BTreeSet;

/// No more wrong claims are followed.
const MAX_FOLLOWED: usize = 12;
/// The most formulas of a document that are followed.
const MAX_FORMULAS: usize = 3_000;

/// Turns wrong findings into carried ones where an earlier wrong claim explains them.
pub(super) fn carry(
    text: &str,
    document: &Document,
    plan: &Plan,
    options: &CheckOptions,
    walked: &Walked,
    claims: &mut [Claim],
) {
    let count: usize = walked.assertions.iter().map(|a| a.pieces.len()).sum();
    if count > MAX_FORMULAS {
        return;
    }
    let wrong: Vec<usize> = (0..claims.len()).filter(|&k| claims[k].standing() == Standing::Wrong).collect();
    let mut authors = BTreeSet::new();
    for &by in wrong.iter().take(MAX_FOLLOWED) {
        if claims[by].standing() != Standing::Wrong || !wrong.iter().any(|&k| k > by) {
            continue;
        }
        let place = claims[by].span.start;
        // It alone, and with those before it.
        let alone = BTreeSet::from([place]);
        authors.insert(place);
        let sets = if authors.len() > 1 { vec![alone, authors.clone()] } else { vec![alone] };
        for set in sets {
            let author = plan.with_authors(set).walk(text, document, options);
            follow(plan, walked, &author, claims, by);
        }
    }
}

/// What is wrong for the robot that is given, but right by the document's own table: right too if that is the same mechanism,
/// carried if it is wrong, and of frames not decided if nobody knows.
pub(super) fn by_own_table(
    text: &str,
    document: &Document,
    plan: &Plan,
    own: &Judged,
    options: &CheckOptions,
    walked: &Walked,
    claims: &mut [Claim],
) {
    let speaks_of_frames = |about: &About| {
        matches!(
            about,
            About::Matrix(
                Meaning::Frame { .. } | Meaning::Rotation(_) | Meaning::Origin(_) | Meaning::AxisZ(_)
            )
        )
    };
    let is_known = own.standing != TableStanding::Undecided;
    let is_off = |c: &Claim| match c.standing() {
        Standing::Wrong => is_known || speaks_of_frames(&c.about),
        Standing::Carried => is_known,
        _ => false,
    };
    if own.standing == TableStanding::Identical || !claims.iter().any(is_off) {
        return;
    }
    let other = plan.with(&|_| Some(Subject::clone(&own.subject)));
    let read = other.walk(text, document, options);
    if read.assertions.len() != walked.assertions.len() {
        return;
    }
    let (judged, _) = super::judge::judge(text, &other, &read, options.tolerance);
    let by = claims.len();
    for (claim, other) in claims.iter_mut().zip(judged) {
        if !is_off(claim) || !matches!(other.standing(), Standing::Equal | Standing::Conditional) {
            continue;
        }
        claim.instead = None;
        if own.standing == TableStanding::SameArm {
            (claim.entries, claim.remarks) = (other.entries, other.remarks);
            claim.remarks.push(Remark::ByOwnTable);
            continue;
        }
        for entry in &mut claim.entries {
            entry.finding = match &entry.finding {
                Finding::Wrong(_) if !is_known => Finding::Undecided { why: Unproved::OwnTable },
                Finding::Wrong(wrong) => Finding::Carried { by, correct: wrong.correct.clone() },
                Finding::Carried { correct, .. } => Finding::Carried { by, correct: correct.clone() },
                _ => continue,
            };
        }
    }
}

/// Marks what is right by the author's own values.
fn follow(plan: &Plan, walked: &Walked, author: &Walked, claims: &mut [Claim], by: usize) {
    if author.assertions.len() != walked.assertions.len() {
        return;
    }
    let mut points = Points::new(19);
    let pairs = walked.assertions.iter().zip(&author.assertions).enumerate().skip(by + 1);
    for (k, (before, after)) in pairs {
        let is_same = before.span == after.span && before.pieces.len() == after.pieces.len();
        let Some(claim) = claims.get_mut(k).filter(|c| is_same && c.entries.len() == after.pieces.len())
        else {
            continue;
        };
        for (entry, piece) in claim.entries.iter_mut().zip(&after.pieces) {
            let Finding::Wrong(wrong) = &entry.finding else { continue };
            let follows = match piece {
                Piece::Pair(pair) => {
                    let (a, b) = (points.value(pair.value), points.value(pair.wanted));
                    a.is_some() && a == b && equal(pair.value, pair.wanted).is_equal()
                }
                Piece::Number { answer, .. } => numbers::is_near(answer, &plan.subjects[after.subject]),
                Piece::Unreadable { .. } => false,
            };
            if follows {
                entry.finding = Finding::Carried { by, correct: wrong.correct.clone() };
                claim.instead = None;
            }
        }
    }
}
