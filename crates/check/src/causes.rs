//! One change of the robot, or of what is meant, that turns many wrong formulas right.

use super::CheckOptions;
use super::facts::{Change, SlipKind, TableCell};
use super::judge::Judge;
use super::outcome::{Cause, Claim, Entry, Finding};
use super::plan::{Plan, Walked};
use super::subject::Subject;
use super::walk::Piece;
use denavit::description::{Convention, Description, Row};
use denavit_reading::document::Document;
use denavit_reading::slip::Points;
use denavit_symbolic::{Expr, equal};
use std::rc::Rc;

/// A change of the table.
struct Hypothesis {
    change: Change,
    robot: usize,
    /// How plausible it is beforehand.
    prior: i64,
    changed: Box<dyn Fn(&Description) -> Description>,
}

/// No more causes than these are told.
const MAX_CAUSES: usize = 3;
/// No more formulas are explained under a cause.
const MAX_REST: usize = 100;
/// The hypotheses that are tried, times the formulas that each is tried on.
const MAX_WORK: usize = 40_000;
/// The robots of a document whose tables are doubted.
const MAX_ROBOTS: usize = 8;
/// The most formulas of a document for which causes are looked for.
const MAX_FORMULAS: usize = 2_000;

/// The changes that explain what is wrong, the best first; what they leave wrong is held against the changed robot.
pub(super) fn causes(
    text: &str,
    document: &Document,
    plan: &Plan,
    options: &CheckOptions,
    walked: &Walked,
    claims: &mut [Claim],
) -> Vec<Cause> {
    let standing: Vec<Vec<bool>> = claims
        .iter()
        .map(|c| c.entries.iter().map(|e| matches!(e.finding, Finding::Equal { .. })).collect())
        .collect();
    let is_wrong = |c: usize, e: usize| matches!(claims[c].entries[e].finding, Finding::Wrong(_));
    // Two entries that were exchanged are one slip.
    let weight = |e: &Entry| match &e.finding {
        Finding::Wrong(wrong)
            if wrong.slip.as_ref().is_some_and(|s| matches!(s.kind, SlipKind::ExchangedWith(..))) =>
        {
            1
        }
        Finding::Wrong(_) => 2,
        _ => 0,
    };
    let wrong = claims.iter().flat_map(|c| &c.entries).map(weight).sum::<usize>() / 2;
    let all: usize = standing.iter().map(Vec::len).sum();
    if wrong < 2 || all > MAX_FORMULAS {
        return vec![];
    }
    let mut found: Vec<(i64, Cause, Plan)> = vec![];
    for hypothesis in hypotheses(plan).into_iter().take(MAX_WORK / all.max(1)) {
        let changed = plan.with(&|s: &Subject| {
            let is_meant = std::ptr::eq(s, Rc::as_ptr(&plan.subjects[hypothesis.robot]));
            let same = same_row(s, &plan.subjects[hypothesis.robot]);
            (is_meant || same).then(|| s.with((hypothesis.changed)(&s.description)))
        });
        let other = changed.walk(text, document, options);
        if other.assertions.len() != walked.assertions.len() {
            continue;
        }
        let mut points = Points::new(3);
        let mut cause = Cause {
            change: hypothesis.change,
            slip: None,
            turns_right: vec![],
            turns_wrong: vec![],
            stays_wrong: vec![],
        };
        for (c, (a, b)) in walked.assertions.iter().zip(&other.assertions).enumerate() {
            if a.pieces.len() != b.pieces.len() {
                continue;
            }
            for (e, (before, after)) in a.pieces.iter().zip(&b.pieces).enumerate() {
                let (Piece::Pair(before), Piece::Pair(after)) = (before, after) else { continue };
                // Which sign is meant is not known here.
                if before.printed.as_ref().is_some_and(|s| s.sign_choices() > 0) {
                    continue;
                }
                let was = standing.get(c).and_then(|s| s.get(e)).copied().unwrap_or(false);
                if before.wanted == after.wanted && before.value == after.value {
                    if !was && is_wrong(c, e) {
                        cause.stays_wrong.push((c, e));
                    }
                    continue;
                }
                let (x, y) = (points.value(after.value), points.value(after.wanted));
                let is = x.is_some() && x == y;
                match (was, is) {
                    (false, true) if is_wrong(c, e) => cause.turns_right.push((c, e)),
                    (false, false) if is_wrong(c, e) => cause.stays_wrong.push((c, e)),
                    (true, false) => cause.turns_wrong.push((c, e)),
                    _ => {}
                }
            }
        }
        let (right, wrong) = (cause.turns_right.len() as i64, cause.turns_wrong.len() as i64);
        if right >= 2 && right > wrong {
            // What a hypothesis explains counts most; α is what tables have wrong most often.
            found.push((4 * right - wrong + hypothesis.prior, cause, changed));
        }
    }
    found.sort_by_key(|f| -f.0);
    // A cause is told if it explains something that a better one does not.
    let mut told: Vec<Cause> = vec![];
    for (_, cause, changed) in found {
        let is_new = |at: &(usize, usize)| !told.iter().any(|t| t.turns_right.contains(at));
        if cause.turns_right.iter().filter(|at| is_new(at)).count() < 2 {
            continue;
        }
        if told.is_empty() {
            explain_rest(text, document, &changed, options, &cause, claims);
        }
        told.push(cause);
        if told.len() == MAX_CAUSES {
            break;
        }
    }
    told
}

/// True if two robots of a document are the same table, one perhaps with more rows.
fn same_row(a: &Subject, b: &Subject) -> bool {
    let (a, b) = (&a.description, &b.description);
    let same = |x: &Row, y: &Row| x.theta == y.theta && x.d == y.d && x.a == y.a && x.alpha == y.alpha;
    a.convention == b.convention && a.rows.iter().zip(&b.rows).all(|(x, y)| same(x, y))
}

/// For what stays wrong under the best cause, the slip that is left.
fn explain_rest(
    text: &str,
    document: &Document,
    changed: &Plan,
    options: &CheckOptions,
    cause: &Cause,
    claims: &mut [Claim],
) {
    let walked = changed.walk(text, document, options);
    let mut judge = Judge::new(text, changed, &walked);
    for &(c, e) in cause.stays_wrong.iter().take(MAX_REST) {
        let Some(assertion) = walked.assertions.get(c) else { continue };
        let Some(Piece::Pair(pair)) = assertion.pieces.get(e) else { continue };
        if equal(pair.value, pair.wanted).is_equal() {
            continue;
        }
        let slip = judge.slips(pair, assertion.subject).into_iter().next();
        if let (Some(slip), Some(Finding::Wrong(wrong))) =
            (slip, claims.get_mut(c).and_then(|c| c.entries.get_mut(e)).map(|e| &mut e.finding))
        {
            wrong.under_cause = Some((0, slip));
        }
    }
}

fn hypotheses(plan: &Plan) -> Vec<Hypothesis> {
    let mut found: Vec<Hypothesis> = vec![];
    for (robot, subject) in plan.subjects.iter().enumerate().take(MAX_ROBOTS) {
        // A longer table of the same robot speaks for the shorter ones.
        if plan.subjects[..robot].iter().any(|s| same_row(s, subject) && s.last() >= subject.last()) {
            continue;
        }
        let d = &subject.description;
        let mut add = |change: Change, changed: Box<dyn Fn(&Description) -> Description>| {
            let prior = match letter(&change) {
                Some('α') => 4,
                Some('θ') => 0,
                _ => 2,
            };
            found.push(Hypothesis { change, robot, prior, changed });
        };
        let [x, z] = &subject.letters;
        let quarter = Expr::pi() / Expr::int(2);
        for (i, row) in d.rows.iter().enumerate() {
            let n = i + 1;
            let cell = |letter: &str| TableCell { letter: letter.to_string(), row: n };
            let with = |edit: fn(&mut Row)| -> Box<dyn Fn(&Description) -> Description> {
                Box::new(move |d| {
                    let mut d = d.clone();
                    if let Some(row) = d.rows.get_mut(i) {
                        edit(row);
                    }
                    d
                })
            };
            if !row.alpha.is_zero() {
                add(Change::Opposite(cell("α")), with(|r| r.alpha = -r.alpha));
                add(Change::Alpha { row: n, degrees: 0 }, with(|r| r.alpha = Expr::int(0)));
            } else {
                add(Change::Alpha { row: n, degrees: 90 }, with(|r| r.alpha = Expr::pi() / Expr::int(2)));
                add(Change::Alpha { row: n, degrees: -90 }, with(|r| r.alpha = -Expr::pi() / Expr::int(2)));
            }
            if row.alpha == quarter || row.alpha == -quarter {
                add(Change::Alpha { row: n, degrees: 180 }, with(|r| r.alpha = Expr::pi()));
            }
            for (degrees, edit) in [
                (90, (|r| r.theta = r.theta + Expr::pi() / Expr::int(2)) as fn(&mut Row)),
                (-90, |r| r.theta = r.theta - Expr::pi() / Expr::int(2)),
                (180, |r| r.theta = r.theta + Expr::pi()),
            ] {
                add(Change::Offset { row: n, degrees }, with(edit));
            }
            if row.variable.is_some_and(|v| v.kind == denavit::description::JointKind::Revolute) {
                add(Change::CountedBackwards(n), with(|r| r.theta = -r.theta));
            }
            if !row.d.is_zero() {
                add(Change::Opposite(cell(z)), with(|r| r.d = -r.d));
                add(
                    Change::Forgotten(cell(z)),
                    with(|r| {
                        r.d = r.variable.map_or(Expr::int(0), |v| {
                            if r.d.symbols().contains(&v.symbol) { v.symbol.into() } else { Expr::int(0) }
                        })
                    }),
                );
            }
            if !row.a.is_zero() {
                add(Change::Opposite(cell(x)), with(|r| r.a = -r.a));
                add(Change::Forgotten(cell(x)), with(|r| r.a = Expr::int(0)));
            }
            if i + 1 < d.rows.len() {
                let swap = move |edit: fn(&mut Row, &mut Row)| -> Box<dyn Fn(&Description) -> Description> {
                    Box::new(move |d| {
                        let mut d = d.clone();
                        if let Some([a, b]) = d.rows.get_mut(i..i + 2) {
                            edit(a, b);
                        }
                        d
                    })
                };
                if row.alpha != d.rows[i + 1].alpha {
                    add(
                        Change::ExchangedWithNext(cell("α")),
                        swap(|a, b| std::mem::swap(&mut a.alpha, &mut b.alpha)),
                    );
                }
                if row.a != d.rows[i + 1].a {
                    add(Change::ExchangedWithNext(cell(x)), swap(|a, b| std::mem::swap(&mut a.a, &mut b.a)));
                }
            }
        }
        for convention in Convention::ALL {
            // Craig's and Khalil's are one product in other letters.
            let same = (d.convention == Convention::Standard) == (convention == Convention::Standard);
            if !same && convention != Convention::Khalil {
                add(
                    Change::Convention(convention),
                    Box::new(move |d| Description { convention, ..d.clone() }),
                );
            }
        }
        if !d
            .tool
            .matrix()
            .iter()
            .flatten()
            .zip(denavit::geometry::Transform::<Expr>::identity().matrix().iter().flatten())
            .all(|(a, b)| a == b)
        {
            add(
                Change::NoTool,
                Box::new(|d| Description { tool: denavit::geometry::Transform::identity(), ..d.clone() }),
            );
        }
        for p in &d.parameters {
            let symbol = p.symbol;
            let zero = move |e: Expr| e.substitute(|s| (s == symbol).then(|| Expr::int(0)));
            add(
                Change::Vanishing(symbol),
                Box::new(move |d| {
                    let mut d = d.clone();
                    for row in &mut d.rows {
                        (row.a, row.d) = (zero(row.a), zero(row.d));
                    }
                    d
                }),
            );
        }
    }
    found
}

/// The letter that a change is about.
fn letter(change: &Change) -> Option<char> {
    match change {
        Change::Opposite(cell) | Change::Forgotten(cell) | Change::ExchangedWithNext(cell) => {
            cell.letter.chars().next()
        }
        Change::Alpha { .. } => Some('α'),
        Change::Offset { .. } | Change::CountedBackwards(_) => Some('θ'),
        Change::Vanishing(symbol) => symbol.name().chars().next(),
        Change::Convention(_) | Change::NoTool | Change::Definition { .. } => None,
    }
}
