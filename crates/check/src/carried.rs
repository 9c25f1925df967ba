//! Errors carried forward: a formula that is wrong, but right given what the author printed before.
//!
//! Each wrong matrix or entry is put into the place of the robot's own, and the document is read once more; what then is right
//! follows from it.

use super::CheckOptions;
use super::facts::{About, Meaning, Remark, Unproved};
use super::matrix::Matrix;
use super::numbers;
use super::outcome::{Claim, Finding, Standing};
use super::plan::{Plan, Walked};
use super::programs::Followed;
use super::subject::Subject;
use super::tables::{Judged, Standing as TableStanding};
use super::walk::{Assertion, Piece, Spoken};
use denavit_reading::document::Document;
use denavit_reading::slip::Points;
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Expr, equal};
use std::collections::{BTreeMap, BTreeSet};

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

/// What is wrong with wrong coordinates in it, but holds of the coordinates as they are, is right: `x_C \sin θ1 − y_C \cos θ1 = b3`
/// behind a wrong `y_C`.
pub(super) fn of_true_coordinates(
    text: &str,
    document: &Document,
    plan: &Plan,
    options: &CheckOptions,
    walked: &Walked,
    claims: &mut [Claim],
) {
    let is_wrong = |c: &Claim| c.standing() == Standing::Wrong;
    let is_coordinate = |c: &&Claim| {
        let of_a_point = |m: &Meaning| matches!(m, Meaning::Origin(_) | Meaning::Position);
        let is = matches!(&c.about, About::Entry) || matches!(&c.about, About::Matrix(m) if of_a_point(m));
        is && is_wrong(c) && c.entries.len() == 1
    };
    let right = |(c, a): (&Claim, &Assertion)| match &a.pieces[..] {
        [Piece::Pair(pair)] if is_coordinate(&c) => Some((c.span.start, (plain_name(&a.name), pair.wanted))),
        _ => None,
    };
    let truths: BTreeMap<usize, (String, Expr)> =
        claims.iter().zip(&walked.assertions).filter_map(right).collect();
    let Some(&first) = truths.keys().next() else { return };
    let follows = |c: &Claim| is_wrong(c) && c.about == About::Equation && c.span.start > first;
    if walked.assertions.len() > MAX_FORMULAS || !claims.iter().any(follows) {
        return;
    }
    let other = plan.with_truths(truths);
    let read = other.walk(text, document, options);
    if read.assertions.len() != walked.assertions.len() {
        return;
    }
    let (judged, _) = super::judge::judge(text, &other, &read, options.tolerance);
    for (claim, other) in claims.iter_mut().zip(judged).filter(|(c, _)| follows(c)) {
        if claim.span == other.span && matches!(other.standing(), Standing::Equal | Standing::Conditional) {
            (claim.entries, claim.remarks, claim.instead) = (other.entries, other.remarks, None);
            claim.remarks.push(Remark::OfTrueCoordinates);
        }
    }
}

/// Entries that are the name of something wrong before are carried: `return np.array([x, y, z])`.
pub(super) fn by_name(text: &str, claims: &mut [Claim]) {
    let wrong: Vec<(String, usize, usize)> = claims
        .iter()
        .enumerate()
        .filter(|(_, c)| matches!(c.standing(), Standing::Wrong | Standing::Carried) && c.entries.len() == 1)
        .map(|(k, c)| (c.name.clone(), k, c.span.start))
        .collect();
    for (k, claim) in claims.iter_mut().enumerate() {
        if claim.entries.len() < 2 {
            continue;
        }
        for entry in &mut claim.entries {
            let source = text.get(entry.span.clone()).unwrap_or_default().trim();
            let before = |w: &&(String, usize, usize)| w.0 == source && w.1 != k && w.2 < entry.span.start;
            if let (Finding::Wrong(is), Some((_, by, _))) = (&entry.finding, wrong.iter().rev().find(before))
            {
                entry.finding = Finding::Carried { by: *by, correct: is.correct.clone() };
                claim.instead = None;
            }
        }
    }
}

/// Turns wrong matrices of programs into carried ones that are products or inverses of others by name, one of them wrong, and
/// would be right if those were.
pub(super) fn in_programs(text: &str, walked: &Walked, claims: &mut [Claim]) {
    for k in 0..claims.len().min(walked.assertions.len()) {
        let assertion = &walked.assertions[k];
        let Some(whole) = assertion.whole.as_ref().filter(|_| claims[k].standing() == Standing::Wrong) else {
            continue;
        };
        let source = text.get(assertion.span.clone()).unwrap_or_default();
        let before = || walked.assertions[..k].iter().enumerate().rev();
        let factor = |name: &str| before().find(|(_, a)| a.name == name && a.whole.is_some());
        let plain = ["np.linalg.inv", "linalg.inv", "inv"];
        let inner = plain
            .iter()
            .find_map(|f| source.trim().strip_prefix(f)?.trim().strip_prefix('(')?.strip_suffix(')'));
        let names: Vec<&str> = inner.unwrap_or(source).split(['@', '*']).map(str::trim).collect();
        let Some(factors) = names.iter().map(|n| factor(n)).collect::<Option<Vec<_>>>() else { continue };
        let mut matrices = factors.iter().filter_map(|f| f.1.whole.clone());
        let Some(first) = matrices.next() else { continue };
        let product = matrices.try_fold(first, |x, y| x.times(&y));
        let product = if inner.is_some() { product.and_then(|p| p.times(whole)) } else { product };
        let is_same = |p: Matrix| {
            let one = |r, c| Some(Expr::int(i64::from(r == c)));
            let wanted = |r, c| if inner.is_some() { one(r, c) } else { whole.entry(r, c) };
            let (rows, columns) = p.shape().unwrap_or_default();
            let places = (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c)));
            let mut pairs = places.map(|(r, c)| Some((p.entry(r, c)?, wanted(r, c)?)));
            rows > 0 && pairs.all(|pair| pair.is_some_and(|(x, y)| equal(x, y).is_equal()))
        };
        let is_off = |k: usize| matches!(claims[k].standing(), Standing::Wrong | Standing::Carried);
        let by = factors.iter().map(|f| f.0).find(|&f| is_off(f));
        let (Some(by), true) = (by, product.is_some_and(is_same)) else { continue };
        claims[k].instead = None;
        for entry in &mut claims[k].entries {
            if let Finding::Wrong(wrong) = &entry.finding {
                entry.finding = Finding::Carried { by, correct: wrong.correct.clone() };
            }
        }
    }
}

/// The angle of a sine and a cosine that have formulas of their own before, `θ3 = atan2(s3, c3)`: it is proved with them, and carried
/// where one of them is wrong.
pub(super) fn by_sines(walked: &Walked, claims: &mut [Claim]) {
    let count = claims.len().min(walked.assertions.len());
    for k in 0..count {
        let assertion = &walked.assertions[k];
        let Some(Spoken::Joint { of, branches, .. }) = &assertion.spoken else { continue };
        let (sine, cosine) = of.sin_cos();
        if branches[..] != [sine.atan2(cosine)] || claims[k].standing() != Standing::Undecided {
            continue;
        }
        let told = |e: Expr| {
            let mut before = walked.assertions[..count].iter().enumerate();
            let is_it = |(_, a): &(usize, &Assertion)| {
                a.subject == assertion.subject
                    && a.span.end <= assertion.span.start
                    && a.reference.as_ref().is_some_and(|r| r.1.value() == e)
            };
            before.rfind(is_it).map(|(j, _)| j)
        };
        let (Some(a), Some(b)) = (told(sine), told(cosine)) else { continue };
        let wrong = |j: &usize| matches!(claims[*j].standing(), Standing::Wrong | Standing::Carried);
        let by = [a, b].into_iter().find(wrong);
        let both = [a, b].map(|j| &claims[j]);
        let entries = || both.iter().flat_map(|c| &c.entries);
        let identities = entries().flat_map(|e| e.identities.clone()).collect();
        // What only agrees in samples proves nothing; what a sine divides by, its angle does.
        let is_right = both.iter().all(|c| c.standing() == Standing::Equal)
            && entries().all(|e| !e.identities.is_empty());
        let mut unless_zero = vec![];
        for entry in entries() {
            let Finding::Equal { unless_zero: own } = &entry.finding else { continue };
            unless_zero.extend(own.iter().cloned());
        }
        let Some(entry) = claims[k].entries.first_mut() else { continue };
        match by {
            Some(by) => entry.finding = Finding::Carried { by, correct: vec![] },
            None if is_right => {
                entry.finding = Finding::Equal { unless_zero };
                entry.identities = identities;
            }
            None => {}
        }
    }
}

/// What of programs is right given what they computed before is carried.
pub(super) fn as_computed(walked: &Walked, claims: &mut [Claim]) {
    for Followed { span, by, follows } in &walked.followed {
        let at = |span: &std::ops::Range<usize>| walked.assertions.iter().position(|a| a.span == *span);
        let (Some(k), Some(by)) = (at(span), at(by)) else { continue };
        if !claims.get(by).is_some_and(|c| matches!(c.standing(), Standing::Wrong | Standing::Carried)) {
            continue;
        }
        let Some(claim) = claims.get_mut(k).filter(|c| c.entries.len() == follows.len()) else { continue };
        for (entry, _) in claim.entries.iter_mut().zip(follows).filter(|(_, follows)| **follows) {
            if let Finding::Wrong(wrong) = &entry.finding {
                entry.finding = Finding::Carried { by, correct: wrong.correct.clone() };
                claim.instead = None;
            }
        }
    }
}

/// What a wrong function of a row makes wrong is carried: with its entries mended it is right.
pub(super) fn by_row_function(
    text: &str,
    document: &Document,
    plan: &Plan,
    options: &CheckOptions,
    walked: &Walked,
    claims: &mut [Claim],
) {
    let is_row = |c: &Claim| c.about == About::Matrix(Meaning::Row) && c.standing() == Standing::Wrong;
    let Some(by) = claims.iter().position(is_row) else { return };
    let slips = claims[by].entries.iter().filter_map(|e| match &e.finding {
        Finding::Wrong(wrong) => Some((e.span.clone(), wrong.correct.first()?.clone())),
        _ => None,
    });
    let mut patches: Vec<_> = slips.collect();
    patches.sort_by_key(|p| p.0.start);
    // Places stay where they are if nothing becomes longer than it was; else the rest moves, and only the order counts.
    let mut mended = plan.programs.as_deref().unwrap_or(text).to_string();
    for (span, now) in patches.into_iter().rev() {
        if mended.get(span.clone()).is_none() {
            return;
        }
        mended.replace_range(span, &now);
    }
    let is_program = options.language.is_some();
    if !is_program || walked.assertions.len() > MAX_FORMULAS {
        return;
    }
    let other = plan.without_programs().walk(&mended, document, options);
    if other.assertions.len() != walked.assertions.len() {
        return;
    }
    for (k, after) in other.assertions.iter().enumerate().filter(|(k, _)| *k != by) {
        let is_right = |piece: &Piece| match piece {
            Piece::Pair(pair) => equal(pair.value, pair.wanted).is_equal(),
            _ => false,
        };
        if claims[k].standing() == Standing::Wrong && after.pieces.iter().all(is_right) {
            claims[k].instead = None;
            for entry in &mut claims[k].entries {
                if let Finding::Wrong(wrong) = &entry.finding {
                    entry.finding = Finding::Carried { by, correct: wrong.correct.clone() };
                }
            }
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
                Meaning::Frame { .. } | Meaning::Rotation(_) | Meaning::Origin(_) | Meaning::Axis(..)
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
