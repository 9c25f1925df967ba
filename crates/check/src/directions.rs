//! Sums of joints as the pose shows them: φ = θ2 + θ3 + θ4 is an angle of the hand seen from a link before these joints.

use super::habits::Places;
use super::subject::Subject;
use denavit::description::JointKind;
use denavit::forward::Reference;
use denavit_reading::slip::Points;
use denavit_symbolic::vocabulary::Vocabulary;
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
