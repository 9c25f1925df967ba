//! Sums of joints as the pose shows them: φ = θ2 + θ3 + θ4 is an angle of the hand seen from a link before these joints.

use super::habits::Places;
use super::subject::Subject;
use denavit::description::JointKind;
use denavit::forward::Reference;
use denavit_reading::slip::Points;
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Angle, Expr, equal};
use std::rc::Rc;

/// A sum of joints in the entries of the pose and the joints before them; nothing if the pose does not show it.
pub(super) fn sum_in_pose(subject: &Subject, places: &Places, sum: Expr) -> Option<Expr> {
    let variables = subject.description.variables();
    let angle = Angle::of(sum);
    let terms: Vec<_> = angle.terms.iter().filter_map(|(e, _)| e.as_symbol()).collect();
    let is_of_joints = |s: &denavit_symbolic::Symbol| {
        variables.iter().any(|v| v.symbol == *s && v.kind == JointKind::Revolute)
    };
    if terms.len() < 2 || terms.len() != angle.terms.len() || !terms.iter().all(is_of_joints) {
        return None;
    }
    let mut points = Points::new(47);
    let (cos, sin) = (points.value(sum.cos())?, points.value(sum.sin())?);
    let hand = places.pose().rotation;
    for frame in 0..subject.last() {
        let from = subject.transform(Some(0), Some(frame))?;
        let is_before = |e: &Expr| e.symbols().iter().all(|s| !terms.contains(s));
        if !from.rotation.rows().iter().flatten().all(is_before) {
            return None;
        }
        let seen = (from.rotation.inverse() * subject.pose().rotation).rows();
        let posed = (from.rotation.inverse() * hand).rows();
        let entries = || (0..9).map(|k| (seen[k / 3][k % 3], posed[k / 3][k % 3]));
        let mut find = |value, of: Expr| {
            entries().find_map(|(own, entry)| {
                let is_it = |own: Expr, points: &mut Points| {
                    points.value(own) == Some(value) && equal(own, of).is_equal()
                };
                match () {
                    () if is_it(own, &mut points) => Some(entry),
                    () if is_it(-own, &mut points) => Some(-entry),
                    () => None,
                }
            })
        };
        if let (Some(s), Some(c)) = (find(sin, sum.sin()), find(cos, sum.cos())) {
            return Some(s.atan2(c));
        }
    }
    None
}

/// The sum of the joints that turn about the longest run of parallel axes behind one another.
pub(super) fn parallel_sum(subject: &Subject) -> Option<Expr> {
    let variables = subject.description.variables();
    let joints = subject.joints();
    let rows = subject.geometric_rows(Reference::Tool, Reference::Frame(0));
    let mut points = Points::new(53);
    let mut axis = |k: usize| -> Option<Vec<_>> {
        let turns = variables.get(k)?.kind == JointKind::Revolute;
        (3..6).map(|r| points.value(rows[r][k])).collect::<Option<Vec<_>>>().filter(|_| turns)
    };
    let axes: Vec<Option<Vec<_>>> = (0..joints.len()).map(&mut axis).collect();
    let opposite: Vec<Option<Vec<_>>> = (0..joints.len())
        .map(|k| axes[k].as_ref().and_then(|_| (3..6).map(|r| points.value(-rows[r][k])).collect()))
        .collect();
    let mut best: (usize, Option<Expr>) = (1, None);
    for start in 0..joints.len() {
        let Some(first) = &axes[start] else { continue };
        let (mut sum, mut count) = (joints[start], 1);
        for k in start + 1..joints.len() {
            sum = match () {
                // A slide between them turns nothing.
                () if variables.get(k).is_some_and(|v| v.kind == JointKind::Prismatic) => continue,
                () if axes[k].as_ref() == Some(first) => sum + joints[k],
                () if opposite[k].as_ref() == Some(first) => sum - joints[k],
                () => break,
            };
            count += 1;
        }
        if count > best.0 {
            best = (count, Some(sum));
        }
    }
    best.1
}

/// The direction of the hand of an arm whose hand stays upright: φ.
pub(super) fn direction(
    subject: &Subject,
    plain: &str,
    places: &Places,
    add: &mut dyn FnMut(&str, Expr, Expr),
) {
    let spelled: Vec<&str> = ["φ", "ϕ"].into_iter().filter(|p| plain.contains(p)).collect();
    if spelled.is_empty() {
        return;
    }
    let pose = subject.pose();
    let mut points = Points::new(3);
    let (one, zero) = (points.value(Expr::int(1)), points.value(Expr::int(0)));
    let up = pose.rotation.rows()[2][2].powi(2);
    if points.value(up) != one || !equal(up, Expr::int(1)).is_equal() {
        return;
    }
    let mut sum = Expr::int(0);
    let j = subject.geometric_rows(Reference::Tool, Reference::Frame(0));
    for (k, &q) in subject.joints().iter().enumerate() {
        let turn = points.value(j[5][k]);
        sum = match () {
            () if turn == one => sum + q,
            () if turn == points.value(Expr::int(-1)) => sum - q,
            () if turn == zero => sum,
            () => return,
        };
    }
    let [n, _, _] = pose.rotation.rows();
    let second = pose.rotation.rows()[1];
    let agrees = [(n[0], sum.cos()), (second[0], sum.sin())]
        .into_iter()
        .all(|(a, b)| points.value(a) == points.value(b) && equal(a, b).is_equal());
    if agrees {
        let inverse = Expr::from(places.symbol(1, 0)).atan2(places.symbol(0, 0).into());
        spelled.iter().for_each(|name| add(name, sum, inverse));
    }
}

/// Names for sums of joints that the text tells by a formula for one of them alone, `θ_4 = β - θ_2 - θ_3`, `θ_4 = θ_1 + θ_2 - φ`,
/// each with the sum and what it is by the pose.
pub(super) fn told(
    text: &str,
    subject: &Subject,
    names: &Vocabulary,
    places: &Places,
) -> Vec<(String, Expr, Expr)> {
    const MOST: usize = 8;
    const MOST_TRIED: usize = 24;
    let mut tried = 0;
    let joint = |word: &str| {
        let known = |w: &str| names.lookup(w).filter(|e| subject.joints().contains(e));
        // `q4s` is a solution for q4.
        known(word).or_else(|| known(word.trim_end_matches(char::is_alphabetic).trim_end_matches('_')))
    };
    let mut found: Vec<(String, Expr, Expr)> = vec![];
    for line in text.lines().filter(|l| l.len() < 300 && l.contains('=') && l.contains(['-', '−'])) {
        for (at, _) in line.match_indices('=').take(4) {
            let left = line[..at].trim_end_matches([' ', '&', '$', ':']);
            let left = left.rsplit([' ', '$', '*', '[', '(', ',', '&']).next().unwrap_or_default();
            let Some(last) = joint(&plain_name(left)) else { continue };
            let right = line[at + 1..].split(['=', ';', ',', '#', '%', '$', ':']).next().unwrap_or_default();
            let right = right.trim_matches(['&', ' ', '\\', '.', ']']).replace('−', "-");
            let Some((name, sum)) = solved_for_name(&right, last, &joint) else { continue };
            let is_name = name.chars().count() < 8
                && name.starts_with(char::is_alphabetic)
                && name.chars().all(char::is_alphanumeric)
                && !matches!(name.as_str(), "pi" | "π")
                && names.lookup(&name).is_none();
            if !is_name {
                continue;
            }
            tried += 1;
            if tried > MOST_TRIED {
                return found;
            }
            let is_new =
                found.len() < MOST && found.iter().all(|f| f.0 != name) && !is_other(text, &name, sum, names);
            if let Some(entry) = sum_in_pose(subject, places, sum).filter(|_| is_new) {
                found.push((name, sum, entry));
            }
        }
    }
    found
}

/// The one name in a sum of joints that is no joint, and what it is where a joint is that sum.
fn solved_for_name(
    sum: &str,
    joint: Expr,
    joint_of: &dyn Fn(&str) -> Option<Expr>,
) -> Option<(String, Expr)> {
    const MOST: usize = 8;
    let (mut name, mut rest, mut count) = (None, joint, 0);
    let mut at = 0;
    while at < sum.len() {
        let source = &sum[at..];
        let is_minus = source.trim_start().starts_with('-');
        let begin = at + source.len() - source.trim_start_matches([' ', '+', '-']).len();
        let end = sum[begin..].find(['+', '-']).map_or(sum.len(), |i| begin + i);
        let term = plain_name(sum[begin..end].trim());
        at = end.max(begin + 1);
        count += 1;
        match joint_of(&term) {
            _ if term.is_empty() || count > MOST => return None,
            Some(q) if q == joint => return None,
            Some(q) => rest = if is_minus { rest + q } else { rest - q },
            None if name.is_none() => name = Some((term, is_minus)),
            None => return None,
        }
    }
    let (name, is_minus) = name.filter(|_| count > 1)?;
    Some((name, if is_minus { -rest } else { rest }))
}

/// True for a name that the text gives a formula for something else than a sum.
fn is_other(text: &str, name: &str, sum: Expr, names: &Vocabulary) -> bool {
    text.lines().any(|line| {
        let Some((left, right)) = line.split_once('=') else { return false };
        let left = left.trim_end_matches([' ', '&', '$', ':']);
        let is_it = !left.is_empty()
            && left.len() < 200
            && plain_name(left.rsplit([' ', '$', '*', '(']).next().unwrap_or("")) == name;
        let right = right.split(['=', ';', '#', '%', '$', '.', ',']).next().unwrap_or_default().trim();
        is_it
            && !super::lexis::read(right, &(0..right.len()), names)
                .is_ok_and(|s| equal(s.value(), sum).is_equal())
    })
}

/// Names that programs give the direction of the hand.
pub(super) const DIRECTIONS: [&str; 10] =
    ["phi", "pitch", "gamma", "zeta", "psi", "beta", "gam", "orient", "heading", "fi"];

/// Names that a robot gives their meaning; those of the direction of the hand, if its arm is planar.
pub(super) struct Known {
    names: Vocabulary,
    is_planar: bool,
}

impl Known {
    /// The names of the first robot of a document.
    pub fn of(subjects: &[Rc<Subject>]) -> Self {
        let Some(subject) = subjects.first() else {
            return Known { names: Vocabulary::new(), is_planar: true };
        };
        let mut points = Points::new(59);
        let flat = subject.pose().rotation.rows()[2][2].powi(2);
        let is_planar = points.value(flat) == points.value(Expr::int(1));
        Known { names: subject.vocabulary(), is_planar }
    }

    pub fn has(&self, name: &str) -> bool {
        self.names.lookup(name).is_some() || self.is_planar && name == "phi"
    }
}
