//! Lengths of the whole arm under names of the document's own, which nothing uses: what they are is seen from their values.

use super::facts::About;
use super::lexis::read;
use super::outcome::{Claim, Entry, Finding};
use super::plan::{Plan, Walked};
use super::subject::Subject;
use denavit_reading::slip::Points;
use denavit_symbolic::{Expr, Symbol, equal};

/// A claim for each name that the document gives the distance of the hand from the first axis, or from the origin, or a
/// determinant, as a formula of the joints.
pub(super) fn judged(text: &str, plan: &Plan, walked: &Walked, claims: &[Claim]) -> Vec<Claim> {
    let mut found = vec![];
    for (number, subject) in plan.subjects.iter().enumerate() {
        let joints = subject.joints();
        let own = walked.defined.iter().filter(|d| d.subject == number);
        let open: Vec<_> = own
            .filter(|d| {
                let is_judged =
                    claims.iter().any(|c| c.span.start < d.statement.end && d.statement.start < c.span.end);
                let moves = d.value.symbols().iter().any(|s| joints.contains(&(*s).into()));
                !is_judged && moves
            })
            .collect();
        if open.is_empty() {
            continue;
        }
        // Lengths of which the table, or a program, has the numbers.
        let numbers = |e: Expr| e.substitute(|s| subject.description.exact_value(s));
        let known: Vec<Expr> = lengths(subject, text).into_iter().map(numbers).collect();
        let mut points = Points::new(43);
        for defined in open {
            // A formula of the pose is what it is told to be, whatever that is.
            let names = walked.inverse_names_of(number);
            let d = &subject.description;
            let is_known = |s: &Symbol| joints.contains(&(*s).into()) || d.parameter(*s).is_some();
            // What only a program says is known by its value.
            let told = read(text, &defined.span, names).map_or(defined.value, |s| s.value());
            let is_of_arm = told.symbols().iter().all(is_known);
            let own = numbers(defined.value);
            let value = points.value(own);
            let same = known
                .iter()
                .find(|e| value.is_some() && points.value(**e) == value && equal(**e, own).is_equal());
            if let Some(wanted) = same.filter(|_| is_of_arm) {
                found.push(Claim {
                    span: defined.statement.clone(),
                    name: defined.shown.clone(),
                    about: About::Equation,
                    entries: vec![Entry {
                        place: None,
                        span: defined.span.clone(),
                        finding: Finding::Equal { unless_zero: vec![] },
                        identities: vec![[own, *wanted]],
                    }],
                    instead: None,
                    remarks: vec![],
                    robot: number,
                });
            }
        }
    }
    found
}

/// The distance of the hand from the first axis, where that turns the arm about the upright, its square, that from the origin, and
/// determinants where the text speaks of them.
fn lengths(subject: &Subject, text: &str) -> Vec<Expr> {
    let [x, y, z] = subject.pose().translation.0;
    let around = x.powi(2) + y.powi(2);
    let mut found = vec![around, around + z.powi(2)];
    if let Some(first) = subject.transform(Some(0), Some(1)) {
        let [c, s, upright] = first.rotation.x().0;
        if upright.is_zero() {
            found.push(c * x + s * y);
        }
    }
    if ["det", "Det"].iter().any(|w| text.contains(w)) {
        found.extend(subject.determinants());
    }
    found.retain(|e| e.symbols().iter().any(|s| subject.joints().contains(&(*s).into())));
    found
}
