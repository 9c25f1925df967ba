//! Errors carried forward: a formula that is wrong, but right given what the author printed before.
//!
//! Each wrong matrix or entry is put into the place of the robot's own, and the document is read once more; what then is right
//! follows from it.

use super::CheckOptions;
use super::facts::{About, Meaning, Unproved};
use super::numbers;
use super::outcome::{Claim, Finding, Standing};
use super::plan::{Plan, Walked};
use super::subject::Subject;
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

/// Frames that are wrong for the robot that is given, but right by the document's own table, are not decided: frames may be
/// chosen.
pub(super) fn by_own_table(
    text: &str,
    document: &Document,
    plan: &Plan,
    own: &Subject,
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
    let is_meant = |c: &Claim| c.standing() == Standing::Wrong && speaks_of_frames(&c.about);
    if !claims.iter().any(is_meant) {
        return;
    }
    let other = plan.with(&|_| Some(own.clone())).walk(text, document, options);
    if other.assertions.len() != walked.assertions.len() {
        return;
    }
    for (claim, assertion) in claims.iter_mut().zip(&other.assertions) {
        let is_right = |piece: &Piece| match piece {
            Piece::Pair(pair) => equal(pair.value, pair.wanted).is_equal(),
            Piece::Number { answer, .. } => {
                matches!(numbers::judge(answer, own, None), Finding::Equal { .. })
            }
            Piece::Unreadable { .. } => false,
        };
        if is_meant(claim) && assertion.pieces.iter().all(is_right) {
            claim.instead = None;
            for entry in &mut claim.entries {
                if entry.finding.standing() == Standing::Wrong {
                    entry.finding = Finding::Undecided { why: Unproved::OwnTable };
                }
            }
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
