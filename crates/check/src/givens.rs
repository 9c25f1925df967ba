//! Numbers of joints that were taken as given: an answer if with them a pose is reached that is known, and otherwise a
//! configuration, on which something should rest.

use super::goals::{MAX_ANSWERS, Search, claim, groups};
use super::numbers::Configuration;
use super::outcome::{Claim, Finding, Skipped, Unjudged};
use super::plan::{Plan, Walked};
use super::subject::Subject;
use super::walk::{Answered, GIVEN, Piece, Target};
use denavit_symbolic::Expr;

/// So many poses before are tried.
const MOST_POSES: usize = 4;
/// No more groups of numbers are tried: each is searched for.
const MOST_GROUPS: usize = 40;
/// Words of which the line of a configuration that is only given has one.
const LET: [&str; 14] = [
    "given", "let ", "take ", "suppose", "assume", "gegeben", "donné", "dado", "dada", "dato", "data",
    "soit", "sei ", "posons",
];

/// A claim for each number of a joint that was taken as given, and with which a pose is reached that the document knows from
/// somewhere else.
pub(super) fn judged(text: &str, plan: &Plan, walked: &Walked) -> Vec<Claim> {
    let given: Vec<Answered> = given(walked).take(MAX_ANSWERS).cloned().collect();
    let mut found = vec![];
    for group in groups(text, plan, &given).into_iter().take(MOST_GROUPS) {
        let subject = &plan.subjects[group[0].subject];
        let start = group[0].span.start;
        let known = poses(walked, subject, group[0].subject, start);
        let reached = known.iter().find(|(at, targets)| {
            let aimed: Vec<Answered> =
                group.iter().map(|a| Answered { targets: targets.clone(), ..a.clone() }).collect();
            let is_same =
                |at: &Configuration| aimed.iter().all(|a| a.values.iter().all(|&x| at.has(a.of, x, subject)));
            // The configuration itself, once more.
            let is_restated = at.as_ref().is_some_and(is_same);
            !is_restated
                && Search::new(subject, &aimed, false)
                    .is_some_and(|s| s.verdicts().iter().all(|v| *v == Some(true)))
        });
        if reached.is_some() {
            found.extend(group.iter().map(|a| claim(a, Finding::Equal { unless_zero: vec![] })));
        }
    }
    found
}

/// The numbers of joints that were taken as given, where no claim says anything of them and nothing is judged there.
pub(super) fn unused(text: &str, plan: &Plan, walked: &Walked, claims: &[Claim]) -> Vec<Unjudged> {
    let is_judged =
        |a: &Answered| claims.iter().any(|c| c.span.start < a.span.end && a.span.start < c.span.end);
    let numbers = numbers(plan, walked);
    let is_idle = |a: &&Answered| !a.is_given || !is_let(text, a) && !rests(plan, &numbers, a);
    let idle = walked.answered.iter().filter(|a| !is_judged(a)).filter(is_idle);
    let why = |a: &Answered| if a.is_given { Skipped::Given } else { Skipped::SaysNothing };
    idle.map(|a| Unjudged { span: a.span.clone(), why: why(a) }).collect()
}

/// The numbers that were taken for those of a pose to be reached, where no words say so and no joints follow for it.
pub(super) fn assumed(text: &str, walked: &Walked) -> Vec<Unjudged> {
    let is_answered = |span: &std::ops::Range<usize>| {
        walked.answered.iter().any(|a| !a.targets.is_empty() && a.span.start >= span.end)
    };
    let open = walked.assumed.iter().filter(|span| !is_answered(span) && !is_case(text, span));
    open.map(|span| Unjudged { span: span.clone(), why: Skipped::Given }).collect()
}

/// True for what vanishes in a case that the words behind a colon are about: `p_x = 0 and p_y = 0: the joint is free`.
fn is_case(text: &str, span: &std::ops::Range<usize>) -> bool {
    let is_zero =
        || text.get(span.clone()).and_then(|s| s.rsplit_once('=')).is_some_and(|(_, v)| v.trim() == "0");
    let behind = text.get(span.end..).and_then(|rest| rest.lines().next()).unwrap_or_default();
    let sentence = behind.split(". ").next().unwrap_or_default();
    let told = sentence.split_once(':').map(|(_, words)| words.trim_start());
    is_zero() && told.is_some_and(|words| words.starts_with(char::is_alphabetic))
}

fn given(walked: &Walked) -> impl Iterator<Item = &Answered> {
    walked.answered.iter().filter(|a| a.is_given && !a.values.is_empty())
}

/// The poses that a document has given up to a place, the last first: those to be reached, and those of configurations at which
/// it prints numbers.
fn poses(
    walked: &Walked,
    subject: &Subject,
    number: usize,
    start: usize,
) -> Vec<(Option<Configuration>, Vec<Target>)> {
    let joints = subject.joints().len();
    let mut at: Vec<&Configuration> = vec![];
    let before = walked.assertions.iter().rev().filter(|a| a.subject == number && a.span.end <= start);
    for piece in before.flat_map(|a| a.pieces.iter().rev()) {
        if at.len() == MOST_POSES {
            break;
        }
        let Piece::Number { answer, .. } = piece else { continue };
        let own = answer.at.whole(joints);
        if own.is_some() && !at.iter().any(|c| c.whole(joints) == own) {
            at.push(&answer.at);
        }
    }
    let of_configurations =
        at.into_iter().filter_map(|c| Some((Some(c.clone()), Target::of_pose(subject, c)?)));
    let goal = walked.goals.iter().rev().find(|g| g.subject == number && g.end <= start);
    goal.into_iter().map(|g| (None, g.targets.clone())).chain(of_configurations).collect()
}

/// True where the words of its line say that a configuration is only given.
fn is_let(text: &str, answered: &Answered) -> bool {
    let before = text.get(..answered.span.start).unwrap_or_default();
    let line = before.rsplit('\n').next().unwrap_or_default().to_lowercase();
    let begins = line.trim_start_matches(|c: char| !c.is_alphabetic());
    GIVEN.iter().any(|w| begins.starts_with(w)) || LET.iter().any(|w| line.contains(w))
}

/// A number that is judged: where it stands, of which robot, and at which configuration.
type Judged<'a> = (usize, usize, &'a Configuration);

/// The numbers for what joints move, in the order of the text, one a configuration.
fn numbers<'a>(plan: &Plan, walked: &'a Walked) -> Vec<Judged<'a>> {
    let mut found: Vec<Judged> = vec![];
    for assertion in &walked.assertions {
        let subject = &plan.subjects[assertion.subject];
        let moves = |e: Expr| e.symbols().iter().any(|s| subject.joints().contains(&(*s).into()));
        let first = assertion.pieces.iter().find_map(|p| match p {
            Piece::Number { answer, .. } if moves(answer.wanted) => Some(&answer.at),
            _ => None,
        });
        let Some(at) = first else { continue };
        // Numbers one behind the other stand at the same configuration.
        match found.last_mut() {
            Some(last) if last.1 == assertion.subject && last.2.present() == at.present() => {
                last.0 = assertion.span.start
            }
            _ => found.push((assertion.span.start, assertion.subject, at)),
        }
    }
    found
}

/// True if a number that is judged further down is one at the configuration: one joint of it may have no part in what the others are
/// given for.
fn rests(plan: &Plan, numbers: &[Judged<'_>], given: &Answered) -> bool {
    let subject = &plan.subjects[given.subject];
    let is_there = |at: &Configuration| given.values.iter().any(|&x| at.has(given.of, x, subject));
    let behind = numbers.iter().rev().take_while(|n| n.0 >= given.span.end);
    behind.into_iter().any(|n| n.1 == given.subject && is_there(n.2))
}
