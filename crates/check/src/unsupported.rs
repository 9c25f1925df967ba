//! What is wrong by the robot as it is read, where nothing in the document bears that reading out: it is not called wrong.
//!
//! One change of a formula that makes it right shows that it was meant as it was read, and so does a right statement beside
//! it. Where there is neither, the table, or what is given, may be meant otherwise.

use super::blamed::used;
use super::custom::plain;
use super::facts::{About, Unproved};
use super::outcome::{Claim, Entry, Finding, Standing};
use super::plan::{Plan, Walked};
use super::unjudged::mentions;
use super::walk::{Spoken, speaks_of_singularity};
use denavit_symbolic::Expr;
use denavit_symbolic::vocabulary::plain_name;

/// A matrix with so many wrong entries is off as a whole.
const MANY_ENTRIES: usize = 3;

/// Leaves undecided what is refuted only by a reading that nothing bears out.
pub(super) fn withdraw(text: &str, plan: &Plan, walked: &Walked, claims: &mut [Claim]) {
    for (k, claim) in claims.iter_mut().enumerate().take(walked.assertions.len()) {
        if is_bare_wrong(claim)
            && let Some(Spoken::Joint { of, branches, .. }) = &walked.assertions[k].spoken
            && is_constant(plan, claim.robot, branches)
        {
            let subject = &plan.subjects[claim.robot];
            let at = |b: &Expr| subject.singular_at(of.as_symbol()?, *b);
            let is_told = speaks_of_singularity(text, claim.span.start);
            let there = is_told.then(|| branches.iter().map(at).collect::<Option<Vec<Expr>>>()).flatten();
            if there.is_some() {
                claim.about = About::Singularity;
            }
            for entry in &mut claim.entries {
                (entry.finding, entry.identities) = match &there {
                    Some(vanishing) => (
                        Finding::Equal { unless_zero: vec![] },
                        vanishing.iter().map(|e| [*e, Expr::int(0)]).collect(),
                    ),
                    None => (Finding::Undecided { why: Unproved::NoPose }, vec![]),
                };
            }
        }
    }
    open_loads(text, claims);
    let helped: Vec<usize> = (0..walked.assertions.len())
        .filter(|&k| has_helper(text, walked, k))
        .map(|k| walked.assertions[k].span.start)
        .collect();
    let is_helped = |c: &Claim| helped.contains(&c.span.start);
    for robot in 0..plan.subjects.len() {
        let of_joints = |c: &Claim| c.robot == robot && c.about == About::Joint;
        undecided(claims, &of_joints, &|c| {
            let source = text.get(c.span.clone()).unwrap_or_default();
            is_helped(c) && !names_entries(source) && c.entries.iter().all(|e| has_no_slip(&e.finding))
        });
        let of_matrices = |c: &Claim| c.robot == robot && matches!(c.about, About::Matrix(_) | About::Entry);
        let is_alone = claims.iter().filter(|c| c.robot == robot && !of_matrices(c)).all(|c| {
            matches!(c.about, About::Table | About::TableRow | About::Helper)
                || !matches!(c.standing(), Standing::Equal | Standing::Conditional)
        });
        if plan.is_own && is_alone {
            undecided(claims, &of_matrices, &|c| {
                let wrong = c.entries.iter().filter(|e| e.finding.standing() == Standing::Wrong).count();
                wrong >= MANY_ENTRIES && c.instead.is_none()
            });
        }
    }
}

/// Leaves torques undecided beside one with a name that is not known: the load that they are for may have more components.
fn open_loads(text: &str, claims: &mut [Claim]) {
    let is_torque = |c: &Claim| {
        let name = plain_name(&plain(&c.name));
        let stem = name.trim_end_matches(|x: char| x.is_ascii_digit());
        c.about == About::Entry && matches!(stem, "τ" | "Γ" | "Gamma" | "tau") && stem.len() < name.len()
    };
    let is_open = |c: &Claim| {
        let unknown = |e: &Entry| match &e.finding {
            Finding::Unreadable(errors) => errors.iter().any(|e| {
                let name = plain(text.get(e.span.clone()).unwrap_or_default());
                name.chars().count() == 2 && name.ends_with(['x', 'y', 'z'])
            }),
            _ => false,
        };
        is_torque(c) && c.entries.iter().any(unknown)
    };
    let open: Vec<usize> = claims.iter().filter(|c| is_open(c)).map(|c| c.robot).collect();
    for claim in claims.iter_mut().filter(|c| is_torque(c) && open.contains(&c.robot)) {
        for entry in &mut claim.entries {
            if !matches!(entry.finding, Finding::Unreadable(_)) {
                entry.finding = Finding::Undecided { why: Unproved::OpenLoad };
                entry.identities.clear();
            }
        }
    }
}

/// Leaves all wrong claims of a kind undecided if there are several, and each of the kind is off.
fn undecided(claims: &mut [Claim], is_kind: &dyn Fn(&Claim) -> bool, is_off: &dyn Fn(&Claim) -> bool) {
    let is_wrong = |c: &&Claim| c.standing() == Standing::Wrong;
    let of_kind = || claims.iter().filter(|c| is_kind(c));
    let is_judged = |c: &&Claim| !matches!(c.standing(), Standing::Undecided | Standing::Unreadable);
    if of_kind().filter(is_wrong).count() < 2
        || !of_kind().filter(is_judged).all(|c| is_wrong(&c) && is_off(c))
    {
        return;
    }
    for claim in claims.iter_mut().filter(|c| is_kind(c)) {
        for entry in &mut claim.entries {
            if entry.finding.standing() == Standing::Wrong {
                entry.finding = Finding::Undecided { why: Unproved::Unsupported };
            }
        }
    }
}

/// True for a value of a joint that is given by names of the document's own, which may be other than they are read.
fn has_helper(text: &str, walked: &Walked, k: usize) -> bool {
    let assertion = &walked.assertions[k];
    let source = text.get(assertion.span.clone()).unwrap_or_default();
    let unsaid =
        || walked.unsaid.iter().any(|(span, name)| *span != assertion.span && mentions(source, name));
    matches!(assertion.spoken, Some(Spoken::Joint { .. })) && (!used(text, walked, k).is_empty() || unsaid())
}

/// True if a formula names entries of the pose as only these are named: `n_x`, `p_z`, `r_{13}`; a mere `x` may be another point's.
fn names_entries(source: &str) -> bool {
    let plain: String = source
        .chars()
        .filter(|c| !matches!(c, '_' | '{' | '}' | '\\'))
        .map(|c| c.to_ascii_lowercase())
        .collect();
    plain.split(|c: char| !c.is_alphanumeric()).any(|word| {
        let mut letters = word.chars();
        let first = letters.next().is_some_and(|c| matches!(c, 'n' | 'o' | 's' | 'a' | 'p' | 'r' | 't'));
        let rest = letters.as_str();
        let is_place = rest.len() == 2 && rest.bytes().all(|b| (b'1'..=b'4').contains(&b));
        first && (matches!(rest, "x" | "y" | "z") || is_place)
    })
}

fn has_no_slip(finding: &Finding) -> bool {
    !matches!(finding, Finding::Wrong(wrong) if wrong.slip.is_some())
}

/// A value of a joint that is wrong, and no change of it is known that makes it right.
fn is_bare_wrong(claim: &Claim) -> bool {
    claim.about == About::Joint
        && claim.standing() == Standing::Wrong
        && claim.entries.iter().all(|e| has_no_slip(&e.finding))
}

/// Formulas in lengths alone are those of a configuration, and of no pose.
fn is_constant(plan: &Plan, robot: usize, branches: &[Expr]) -> bool {
    let d = &plan.subjects[robot].description;
    branches.iter().all(|b| b.symbols().iter().all(|s| d.parameter(*s).is_some()))
}
