//! What is said under a supposition, of another point, or of the other solution: it is refuted of the hand, or everywhere, and
//! right, or not known to be wrong, as it is meant.

use super::blamed::used;
use super::facts::{About, Condition, Meaning, Unproved};
use super::matrix::Matrix;
use super::outcome::{Claim, Finding, Standing};
use super::plan::{Plan, Walked};
use super::recognised;
use super::subject::Subject;
use super::told_otherwise::{as_pose, is_told_otherwise, told_together, told_values};
use super::unjudged::mentions;
use super::walk::{Assertion, Defined, Pair, Piece, Spoken};
use denavit::forward::Reference;
use denavit_reading::slip::Points;
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Expr, Symbol, equal};

/// So many bytes before a formula a supposition may stand.
const BEFORE: usize = 400;

/// The condition of a formula that is right where a joint has the value that the words before it suppose, `in the posture q_3 = 0 the
/// wrist is at …`, or follows others as these say.
pub(super) fn where_told(text: &str, pair: &Pair, subject: &Subject) -> Option<Condition> {
    let start =
        (pair.span.start.saturating_sub(BEFORE)..=pair.span.start).find(|&k| text.is_char_boundary(k));
    let window = start.and_then(|s| text.get(s..pair.span.start))?;
    let parts: Vec<&str> = window.split("\n\n").collect();
    let window = parts[parts.len().saturating_sub(2)..].join(" ");
    let joints = subject.joints();
    let told = told_values(&window, subject);
    let mut points = Points::new(61);
    let mut holds = |given: &[(Symbol, Expr)]| {
        let there = |e: Expr| e.substitute(|s| given.iter().find(|g| g.0 == s).map(|g| g.1));
        let (value, wanted) = (there(pair.value), there(pair.wanted));
        // What is left is still a formula of the joints.
        let moves = |e: Expr| e.symbols().iter().any(|s| joints.contains(&(*s).into()));
        moves(wanted)
            && moves(value)
            && points.value(value).is_some_and(|v| points.value(wanted) == Some(v))
            && equal(value, wanted).is_equal()
    };
    if told.iter().any(|t| holds(&[*t])) || told.len() > 1 && holds(&told) {
        return Some(Condition::Locked);
    }
    let together = told_together(text, pair.span.start, subject);
    together.iter().any(|t| holds(&[*t])).then_some(Condition::Following)
}

/// Takes back what is refuted of the hand and right of another point that the words name, and values of another solution.
pub(super) fn withdraw(text: &str, plan: &Plan, walked: &Walked, claims: &mut [Claim]) {
    for k in 0..claims.len().min(walked.assertions.len()) {
        if claims[k].standing() != Standing::Wrong {
            continue;
        }
        let (assertion, subject) = (&walked.assertions[k], &plan.subjects[claims[k].robot]);
        if let Some(findings) = as_pose(text, assertion, subject) {
            claims[k].about = About::Matrix(Meaning::Hand);
            claims[k].instead = None;
            for (entry, finding) in claims[k].entries.iter_mut().zip(findings) {
                entry.finding = finding;
            }
        } else if let Some(about) = of_other_point(text, assertion, subject) {
            claims[k].about = About::Matrix(about);
            claims[k].instead = None;
            let pairs = assertion.pieces.iter().map(|p| match p {
                Piece::Pair(pair) => vec![[pair.value, pair.value]],
                _ => vec![],
            });
            for (entry, identities) in claims[k].entries.iter_mut().zip(pairs) {
                entry.finding = Finding::Equal { unless_zero: vec![] };
                entry.identities = identities;
            }
        } else if is_of_other_solution(walked, claims, k)
            || is_made_of_others(text, assertion)
            || is_told_otherwise(text, assertion, subject)
            || is_of_own_point(text, walked, k)
        {
            for entry in claims[k].entries.iter_mut().filter(|e| e.finding.standing() == Standing::Wrong) {
                entry.finding = Finding::Undecided { why: Unproved::Unsupported };
            }
        }
    }
}

/// The origin of a frame that a vector is, where the words before it speak of such a point.
fn of_other_point(text: &str, assertion: &Assertion, subject: &Subject) -> Option<Meaning> {
    const POINTS: [&str; 26] = [
        "elbow",
        "wrist",
        "shoulder",
        "knee",
        "origin",
        "frame ",
        "ellbogen",
        "handgelenk",
        "handwurzel",
        "schulter",
        "ursprung",
        "coude",
        "poignet",
        "épaule",
        "origine",
        "codo",
        "muñeca",
        "hombro",
        "origen",
        "gomito",
        "polso",
        "spalla",
        "cotovelo",
        "punho",
        "ombro",
        "origem",
    ];
    let hand = |m: &Meaning| {
        matches!(m, Meaning::Position)
            || matches!(m, Meaning::Origin(f) if matches!(**f, Meaning::Frame { of: Reference::Tool, .. }))
    };
    if !matches!(&assertion.about, About::Matrix(m) if hand(m)) {
        return None;
    }
    let start = (assertion.span.start.saturating_sub(BEFORE / 2)..=assertion.span.start)
        .find(|&k| text.is_char_boundary(k))?;
    let before = text.get(start..assertion.span.start)?.to_lowercase();
    if !POINTS.iter().any(|w| before.contains(w)) {
        return None;
    }
    let values = assertion.pieces.iter().map(|p| match p {
        Piece::Pair(pair) => Some(vec![Some(pair.value)]),
        _ => None,
    });
    let printed = Matrix(values.collect::<Option<Vec<Vec<Option<Expr>>>>>()?);
    let ((_, about), agreement) = recognised::nearest(subject, &printed)?;
    (agreement.is_whole && agreement.telling > 1 && matches!(about, Meaning::Origin(_))).then_some(about)
}

/// True for a value of a joint that is half a turn from one that is right, or its opposite: that of the other solution.
fn is_of_other_solution(walked: &Walked, claims: &[Claim], k: usize) -> bool {
    let joint = |a: &Assertion| -> Option<(Expr, Vec<Expr>)> {
        match (&a.spoken, &a.pieces[..]) {
            (Some(Spoken::Joint { of, branches, .. }), _) => Some((*of, branches.clone())),
            (None, [Piece::Pair(pair)]) if pair.wanted.as_symbol().is_some() => {
                Some((pair.wanted, vec![pair.value]))
            }
            _ => None,
        }
    };
    let Some((of, own)) = joint(&walked.assertions[k]) else { return false };
    let count = claims.len().min(walked.assertions.len());
    let right = (0..count)
        .filter(|&i| i != k && matches!(claims[i].standing(), Standing::Equal | Standing::Conditional));
    let mut points = Points::new(67);
    let mut is_other = |a: Expr, b: Expr| {
        let pair = |e: Expr, points: &mut Points| Some((points.value(e.sin())?, points.value(e.cos())?));
        let (here, turned, opposite) =
            (pair(a, &mut points), pair(b + Expr::pi(), &mut points), pair(-b, &mut points));
        here.is_some() && (here == turned || here == opposite)
    };
    right
        .filter_map(|i| joint(&walked.assertions[i]))
        .filter(|o| o.0 == of)
        .any(|(_, others)| own.iter().all(|a| others.iter().any(|b| is_other(*a, *b))))
}

/// True for an equation between coordinates of a point that the document names itself, `h_x² + h_y² + h_z² = …`: where it does not
/// follow, it may be the formula of one of them that is wrong.
fn is_of_own_point(text: &str, walked: &Walked, k: usize) -> bool {
    let source = text.get(walked.assertions[k].span.clone()).unwrap_or_default();
    let left = source.split('=').next().unwrap_or_default();
    let is_coordinate = |d: &&Defined| {
        let name = plain_name(&d.name);
        let stem = name.trim_end_matches(['x', 'y', 'z']).trim_end_matches('_');
        stem.len() < name.len() && stem.chars().count() == 1 && !d.by_custom && mentions(left, &d.name)
    };
    matches!(walked.assertions[k].about, About::Equation)
        && used(text, walked, k).into_iter().filter(is_coordinate).count() > 1
}

/// True for a bare letter for a product of other matrices with a transpose or an inverse among them: `R = (R_03)^T R_06`.
fn is_made_of_others(text: &str, assertion: &Assertion) -> bool {
    let source = text.get(assertion.span.clone()).unwrap_or_default();
    let Some((_, formula)) = source.split_once('=') else { return false };
    let is_bare = matches!(
        assertion.name.trim_matches(['\\', '$', ' ', '{', '}']),
        "R" | "T" | "H" | "mathbf{R" | "mathbf{T"
    );
    let turns = ["^T", "^{T}", "^\\top", "^{\\top}", "ᵀ", "^{-1}", "^-1", "⁻¹", "'"]
        .iter()
        .any(|t| formula.contains(t));
    let is_grid = ["[", "\\begin", "|", "matrix"].iter().any(|g| formula.contains(g));
    is_bare && turns && !is_grid && formula.len() < 200
}
