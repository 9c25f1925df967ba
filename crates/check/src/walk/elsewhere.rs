//! Coordinates in print that are those of another point than the hand's: `bucket pin at x = 2.097, y = 1.468, z = 1.428`.
//!
//! Numbers of one sentence that are all wrong for the hand, and all right for the origin of one frame before it, are of that frame if
//! the document has the hand's own coordinates right at that configuration: else they may be the hand's without its last link.

use super::{Assertion, Piece};
use crate::numbers::judge;
use crate::outcome::Finding;
use crate::subject::Subject;
use std::rc::Rc;

/// Coordinates of one point stand no farther from each other, in bytes.
const NEAR: usize = 60;
/// No more runs of numbers are looked at.
const MOST: usize = 100;

/// Gives numbers the point that they are of.
pub(in super::super) fn of_other_points(assertions: &mut [Assertion], subjects: &[Rc<Subject>]) {
    let mut start = 0;
    let mut runs = 0;
    while start < assertions.len() && runs < MOST {
        let mut end = start;
        while end < assertions.len() && end - start < 3 && is_coordinate(&assertions[end], subjects) {
            let is_beside = end == start
                || assertions[end].subject == assertions[start].subject
                    && assertions[end].span.start.saturating_sub(assertions[end - 1].span.end) < NEAR;
            // A coordinate that comes again is that of the next point.
            let own = coordinate(&assertions[end], subjects);
            let comes_again = assertions[start..end].iter().any(|a| coordinate(a, subjects) == own);
            if !is_beside || comes_again {
                break;
            }
            end += 1;
        }
        if end - start > 1 {
            runs += 1;
            let (others, rest) = assertions.split_at_mut(start);
            let (run, behind) = rest.split_at_mut(end - start);
            if run.iter().all(|a| has_own(a, others.iter().chain(&*behind), subjects)) {
                move_to_frame(run, subjects);
            }
        }
        start = end.max(start + 1);
    }
}

/// The coordinate of the hand that an assertion gives as a number.
fn coordinate(a: &Assertion, subjects: &[Rc<Subject>]) -> Option<usize> {
    let [Piece::Number { answer, .. }] = &a.pieces[..] else { return None };
    subjects.get(a.subject)?.pose().translation.0.iter().position(|e| *e == answer.wanted)
}

fn is_coordinate(a: &Assertion, subjects: &[Rc<Subject>]) -> bool {
    coordinate(a, subjects).is_some()
}

/// True if the same coordinate of the hand stands elsewhere, right at the same configuration.
fn has_own<'a>(
    a: &Assertion,
    mut others: impl Iterator<Item = &'a Assertion>,
    subjects: &[Rc<Subject>],
) -> bool {
    let [Piece::Number { answer, .. }] = &a.pieces[..] else { return false };
    let Some(subject) = subjects.get(a.subject) else { return false };
    others.any(|o| match &o.pieces[..] {
        [Piece::Number { answer: own, .. }] => {
            o.subject == a.subject
                && own.wanted == answer.wanted
                && own.at.present() == answer.at.present()
                && matches!(judge(own, subject, None), Finding::Equal { .. })
        }
        _ => false,
    })
}

fn move_to_frame(run: &mut [Assertion], subjects: &[Rc<Subject>]) {
    let Some(subject) = subjects.get(run[0].subject) else { return };
    let is_wrong = |a: &Assertion| match &a.pieces[..] {
        [Piece::Number { answer, .. }] => matches!(judge(answer, subject, None), Finding::Wrong(_)),
        _ => false,
    };
    if !run.iter().all(is_wrong) {
        return;
    }
    for frame in (1..subject.last()).rev() {
        let origin = subject.origin(frame).0;
        let there: Option<Vec<Piece>> = run
            .iter()
            .map(|a| {
                let [Piece::Number { place, span, answer }] = &a.pieces[..] else { return None };
                let wanted = origin[coordinate(a, subjects)?];
                let answer = crate::numbers::Answer { wanted, ..answer.clone() };
                let is_right = matches!(judge(&answer, subject, None), Finding::Equal { .. });
                is_right.then(|| Piece::Number { place: *place, span: span.clone(), answer })
            })
            .collect();
        if let Some(there) = there {
            run.iter_mut().zip(there).for_each(|(a, piece)| a.pieces = vec![piece]);
            return;
        }
    }
}
