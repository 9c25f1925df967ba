//! Numbers that joints are said to have where a pose is given in numbers: they are right if some configuration with them has that
//! pose, as far as the printed digits tell.

use super::facts::{About, Remark, Unproved};
use super::inverse::Tape;
use super::numbers::decimal;
use super::outcome::{Claim, Entry, Finding, Wrong};
use super::plan::{Plan, Walked};
use super::subject::Subject;
use super::walk::{Answered, Target};
use denavit::description::JointKind;
use denavit::random::Random;
use denavit_symbolic::{Angle, Expr, Symbol};
use rustc_hash::FxHashMap;
use std::f64::consts::{PI, TAU};
use std::rc::Rc;

/// Starts of a search, and its steps.
const STARTS: usize = 60;
const STEPS: usize = 40;
/// Residuals in units of what rounding explains, up to which a value is right.
const ENOUGH: f64 = 2.0;
/// No more answers are looked at.
pub(super) const MAX_ANSWERS: usize = 200;

/// A claim for each of the numbers; those of which the pose is not known are left out.
pub(super) fn judged(text: &str, plan: &Plan, walked: &Walked) -> Vec<Claim> {
    let answers: Vec<Answered> =
        walked.answered.iter().filter(|a| !a.is_given).take(MAX_ANSWERS).cloned().collect();
    let groups = groups(text, plan, &answers);
    // Lengths without a unit may be in millimetres where those of the robot are in metres.
    let units = if plan.habits.millimetres { &[1.0, 1e-3][..] } else { &[1.0] };
    let verdicts = |group: &[Answered], is_exact: bool| {
        let subject = &plan.subjects[group.first()?.subject];
        let mut all = units.iter().filter_map(|&unit| {
            let search = Search::new(subject, group, is_exact)?;
            Some(Search { unit, size: search.size * unit, ..search }.verdicts())
        });
        // What is not known in one unit is not wrong by another.
        let rank = |v: &Vec<Option<bool>>| (!v.contains(&Some(true)), !v.contains(&None));
        let first = all.next()?;
        Some(all.fold(first, |best, other| if rank(&other) < rank(&best) { other } else { best }))
    };
    let is_same = |a: &[Answered], b: &[Answered]| {
        let key = |g: &[Answered]| -> Vec<(Expr, u64)> {
            g.iter().take(1).flat_map(|a| &a.targets).map(|t| (t.wanted, t.printed.to_bits())).collect()
        };
        key(a) == key(b)
    };
    // Where some values are those of the pose as it is printed, it is no rounded one.
    let is_coarse = |g: &[Answered]| {
        let size = g[0].targets.iter().filter(|t| t.is_length).map(|t| t.printed.abs()).fold(0.0, f64::max);
        g[0].targets.iter().any(|t| t.half > 2e-4 * if t.is_length { size } else { 1.0 })
    };
    let exact: Vec<Option<Vec<Option<bool>>>> =
        groups.iter().map(|g| if is_coarse(g) { verdicts(g, true) } else { None }).collect();
    let is_right =
        |v: &Option<Vec<Option<bool>>>| v.as_ref().is_some_and(|v| v.iter().all(|x| *x == Some(true)));
    let mut found: Vec<(Option<bool>, &Answered, &[Answered])> = vec![];
    for (group, own) in groups.iter().zip(&exact) {
        let is_exact = groups.iter().zip(&exact).any(|(other, v)| {
            let is_joint = other.iter().any(|a| plan.subjects[a.subject].joints().contains(&a.of));
            is_joint && is_right(v) && is_same(other, group)
        });
        let own = if is_exact { own.clone() } else { verdicts(group, false) };
        found.extend(own.into_iter().flatten().zip(group.iter()).map(|(v, a)| (v, a, *group)));
    }
    // What is wrong is so only beside something that is right of the same robot: then the pose is the one that is meant.
    let right: Vec<&[Answered]> = found.iter().filter(|f| f.0 == Some(true)).map(|f| f.2).collect();
    let claims = found.iter().map(|&(verdict, answer, group)| {
        // Of a formula the pose itself must be borne out.
        let is_joint = plan.subjects[answer.subject].joints().contains(&answer.of);
        let is_meant = right.iter().any(|other| is_joint || is_same(other, group));
        let finding = match verdict {
            Some(true) => Finding::Equal { unless_zero: vec![] },
            Some(false) if is_meant => Finding::Wrong(Box::new(wrong(plan, answer, group))),
            _ => Finding::Undecided { why: Unproved::NoPose },
        };
        claim(answer, finding)
    });
    claims.collect()
}

/// The numbers of a line together, and those of lines one behind the other with one joint each.
pub(super) fn groups<'a>(text: &str, plan: &Plan, answers: &'a [Answered]) -> Vec<&'a [Answered]> {
    let mut groups: Vec<&[Answered]> = vec![];
    let mut at = 0;
    while at < answers.len() {
        let first = &answers[at];
        let line = |a: &Answered| text[..a.span.start].matches('\n').count();
        let same = |a: &&Answered| a.subject == first.subject && line(a) == line(first);
        let mut count = answers[at..].iter().take_while(same).count();
        // One joint a line, one behind the other, is one configuration.
        let is_alone = |k: usize| {
            let a = &answers[k];
            let is_joint = plan.subjects[a.subject].joints().contains(&a.of);
            let is_new = answers[at..k].iter().all(|b| b.of != a.of);
            is_joint && is_new && a.values.len() == 1 && a.subject == first.subject
        };
        if count == 1 && is_alone(at) {
            let goes_on = |k: &usize| line(&answers[*k]) == line(&answers[*k - 1]) + 1 && is_alone(*k);
            count += (at + 1..answers.len()).take_while(goes_on).count();
        }
        groups.push(&answers[at..at + count]);
        at += count;
    }
    groups
}

/// A claim of a number that a joint is said to have.
pub(super) fn claim(answer: &Answered, finding: Finding) -> Claim {
    let entry = Entry { place: None, span: answer.value.clone(), finding, identities: vec![] };
    Claim {
        span: answer.span.clone(),
        name: answer.name.clone(),
        about: About::Configuration,
        entries: vec![entry],
        instead: None,
        remarks: vec![],
        robot: answer.subject,
    }
}

/// What is said of a wrong value: the one that goes with the others of its line, or else the right one nearest to it.
fn wrong(plan: &Plan, answer: &Answered, group: &[Answered]) -> Wrong {
    // Nothing was found by a search: that is no proof.
    let mut wrong = Wrong { remarks: vec![Remark::Sampled], ..Wrong::default() };
    let Some(search) = Search::new(&plan.subjects[answer.subject], group, false) else { return wrong };
    let Some(k) = group.iter().position(|a| std::ptr::eq(a, answer)) else { return wrong };
    let right = search.of_branch(k).or_else(|| search.nearest(k));
    let (Some(&x), Some(right)) = (answer.values.first(), right) else { return wrong };
    let shown = |v: f64| if search.in_degrees(k) { decimal(v.to_degrees()) } else { decimal(v) };
    wrong.correct = vec![shown(right)];
    let off = (right - x).abs();
    wrong.remarks.push(if (right + x).abs() < 4.0 * answer.half + 1e-9 {
        Remark::Sign
    } else {
        Remark::OffBy(if search.in_degrees(k) { off.to_degrees() } else { off })
    });
    wrong
}

/// What an answer gives a value to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A joint that turns, or a sum of such.
    Turn,
    /// Another joint, or a sum.
    Sum,
    /// Another formula.
    Formula,
}

/// An answer at a value, and how far it may be off.
#[derive(Clone, Copy)]
struct Fixed {
    /// The number of the answer in its group.
    answer: usize,
    kind: Kind,
    joint: Option<usize>,
    value: f64,
    half: f64,
}

/// What a search comes to.
enum Reached {
    At(Vec<f64>),
    /// The pose does not determine the joints there.
    Vague,
    Nowhere,
}

/// Configurations that reach a pose.
pub(super) struct Search<'a> {
    subject: &'a Subject,
    group: &'a [Answered],
    is_angle: Vec<bool>,
    /// The joints on which the pose depends, as far as it is given.
    moving: Vec<usize>,
    size: f64,
    /// The pose is exactly what is printed.
    is_exact: bool,
    /// Lengths in print are in this unit.
    unit: f64,
    /// The quantities of the pose, and then what the answers are of, over the joints.
    tape: Rc<Tape>,
    /// The joints' places and the values of all lengths behind them.
    lengths: Vec<f64>,
    /// Answers of which no number is known.
    is_open: Vec<bool>,
    kinds: Vec<Kind>,
}

impl<'a> Search<'a> {
    /// Nothing if the pose does not determine the joints.
    pub(super) fn new(subject: &'a Subject, group: &'a [Answered], is_exact: bool) -> Option<Self> {
        let kinds = subject.description.variables();
        let is_angle: Vec<bool> = kinds.iter().map(|v| v.kind == JointKind::Revolute).collect();
        let targets = &group.first()?.targets;
        let joints = subject.joints();
        let depends = |e: Expr, k: usize| e.symbols().iter().any(|s| joints[k] == (*s).into());
        let moving: Vec<usize> =
            (0..joints.len()).filter(|&k| targets.iter().any(|t| depends(t.wanted, k))).collect();
        let asked = |k: &usize| moving.contains(k) || !group.iter().any(|a| depends(a.of, *k));
        if !(0..joints.len()).all(|k| asked(&k)) {
            return None;
        }
        if targets.len() < moving.len() || moving.is_empty() {
            return None;
        }
        let (d, at) = (&subject.description, &group[0].at);
        let mut inputs: FxHashMap<Symbol, usize> =
            (0..).zip(joints).filter_map(|(k, q)| Some((q.as_symbol()?, k))).collect();
        let mut lengths: Vec<f64> = vec![];
        let formulas = || targets.iter().map(|t| t.wanted).chain(group.iter().map(|a| a.of));
        for s in formulas().flat_map(|e| e.symbols()) {
            if let (false, Some(x)) = (inputs.contains_key(&s), at.length(s).or_else(|| d.value(s))) {
                inputs.insert(s, joints.len() + lengths.len());
                lengths.push(x);
            }
        }
        let is_known = |e: Expr| e.symbols().iter().all(|s| inputs.contains_key(s));
        let is_open: Vec<bool> = group.iter().map(|a| !is_known(a.of)).collect();
        let all: Vec<Expr> = formulas().map(|e| if is_known(e) { e } else { Expr::int(0) }).collect();
        if !targets.iter().all(|t| is_known(t.wanted)) {
            return None;
        }
        let tape = Rc::new(Tape::new(&all, &inputs).ok()?);
        let is_joint = |e: &Expr| joints.contains(e) || e.symbols().is_empty();
        let kind = |a: &Answered| {
            let symbols = a.of.symbols();
            let mut all = symbols.iter().map(|s| joints.iter().position(|j| *j == (*s).into()));
            match Angle::of(a.of).terms.iter().all(|(e, _)| is_joint(e)) {
                false => Kind::Formula,
                true if all.all(|k| k.is_some_and(|k| is_angle[k])) => Kind::Turn,
                true => Kind::Sum,
            }
        };
        let kinds = group.iter().map(kind).collect();
        let of_lengths = targets.iter().filter(|t| t.is_length).map(|t| t.printed.abs());
        let size = of_lengths.fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let unit = 1.0;
        Some(Search { subject, group, is_angle, moving, size, is_exact, unit, tape, lengths, is_open, kinds })
    }

    fn scale(&self, target: &Target) -> f64 {
        if target.is_length { self.size } else { 1.0 }
    }

    fn scaled(&self, target: &Target) -> f64 {
        if target.is_length { self.unit } else { 1.0 }
    }

    /// The quantities of the pose, and then those that have answers.
    fn values(&self, q: &[f64]) -> Vec<f64> {
        let point: Vec<f64> = q.iter().chain(&self.lengths).copied().collect();
        self.tape.values(&point)
    }

    /// The value that an answer's formula has.
    fn value(&self, answer: usize, q: &[f64]) -> Option<f64> {
        self.values(q).get(self.group[0].targets.len() + answer).copied().filter(|x| x.is_finite())
    }

    /// True for values of angles that are in degrees: they say so, or are more than a turn in radians.
    fn in_degrees(&self, answer: usize) -> bool {
        let turning = (0..self.group.len()).filter(|&k| self.kinds[k] == Kind::Turn);
        let bare = turning.map(|k| &self.group[k]).filter(|a| !a.has_unit).flat_map(|a| &a.values);
        self.kinds[answer] == Kind::Turn
            && (self.group[answer].has_unit
                || bare.into_iter().any(|x| x.abs() > TAU || *x != 0.0 && x % 5.0 == 0.0))
    }

    /// A value in radians or in the document's length, and half a unit of its last digit.
    fn fixed(&self, answer: usize, value: f64) -> Fixed {
        let a = &self.group[answer];
        let to = if self.in_degrees(answer) && !a.has_unit { PI / 180.0 } else { 1.0 };
        let joint = self.subject.joints().iter().position(|j| *j == a.of);
        Fixed { answer, kind: self.kinds[answer], joint, value: value * to, half: a.half * to }
    }

    /// Residuals in units of what rounding explains.
    fn residuals(&self, fixed: &[Fixed], q: &[f64]) -> Option<Vec<f64>> {
        let (values, targets) = (self.values(q), &self.group[0].targets);
        let mut found = vec![];
        for (t, x) in targets.iter().zip(&values) {
            let off = x - t.printed * self.scaled(t);
            let half = if self.is_exact { 0.0 } else { t.half * self.scaled(t) };
            found.push(off / (half + 2e-4 * self.scale(t)));
        }
        for f in fixed {
            let own = *values.get(targets.len() + f.answer)?;
            // A length, an area, or neither.
            let powers = if self.unit == 1.0 || f.kind == Kind::Turn { 1 } else { 3 };
            let factors = (0..powers).map(|p| self.unit.powi(p));
            let factor =
                factors.min_by(|a, b| (f.value * a - own).abs().total_cmp(&(f.value * b - own).abs()))?;
            let (value, half) = (f.value * factor, f.half * factor);
            let off = own - value;
            let off = if f.kind == Kind::Turn { off - TAU * (off / TAU).round() } else { off };
            let scale = match f.kind {
                Kind::Turn => 1.0,
                Kind::Sum => self.size,
                Kind::Formula => value.abs(),
            };
            found.push(off / (half + 2e-4 * scale));
        }
        found.iter().all(|x| x.is_finite()).then_some(found)
    }

    /// A configuration with these values that reaches the pose.
    fn reach(&self, fixed: &[Fixed], random: &mut Random) -> Reached {
        let mut is_vague = false;
        for _ in 0..STARTS {
            if let Some(q) = self.descend(fixed, random) {
                if self.is_isolated(&q) {
                    return Reached::At(q);
                }
                is_vague = true;
            }
        }
        if is_vague { Reached::Vague } else { Reached::Nowhere }
    }

    /// Goes from a configuration at random to one with these values that reaches the pose.
    fn descend(&self, fixed: &[Fixed], random: &mut Random) -> Option<Vec<f64>> {
        let n = self.is_angle.len();
        let draw = |random: &mut Random, &is_angle: &bool| {
            (2.0 * random.unit() - 1.0) * if is_angle { PI } else { self.size }
        };
        let mut q: Vec<f64> = self.is_angle.iter().map(|a| draw(random, a)).collect();
        for f in fixed {
            if let Some(k) = f.joint {
                q[k] = f.value;
            }
        }
        let mut damping = 1e-2;
        let mut r = self.residuals(fixed, &q)?;
        for _ in 0..STEPS {
            let cost: f64 = r.iter().map(|x| x * x).sum();
            if r.iter().all(|x| x.abs() <= ENOUGH) {
                return Some(q);
            }
            let mut j = vec![vec![0.0; n]; r.len()];
            for k in 0..n {
                let h = 1e-7 * if self.is_angle[k] { 1.0 } else { self.size };
                let mut there = q.clone();
                there[k] += h;
                let moved = self.residuals(fixed, &there)?;
                for (row, (a, b)) in j.iter_mut().zip(moved.iter().zip(&r)) {
                    row[k] = (a - b) / h;
                }
            }
            let step = damped(&j, &r, damping)?;
            let next: Vec<f64> = q.iter().zip(&step).map(|(a, b)| a - b).collect();
            let there = self.residuals(fixed, &next)?;
            if there.iter().map(|x| x * x).sum::<f64>() < cost {
                (q, r) = (next, there);
                damping = (damping * 0.2).max(1e-12);
            } else {
                damping *= 8.0;
                if damping > 1e6 {
                    return None;
                }
            }
        }
        None
    }

    /// True where the pose determines the joints.
    fn is_isolated(&self, q: &[f64]) -> bool {
        let n = self.moving.len();
        let Some(r) = self.residuals(&[], q) else { return false };
        let mut normal = vec![vec![0.0; n]; n];
        let mut columns = vec![];
        for &k in &self.moving {
            let step = 1e-6 * if self.is_angle[k] { 1.0 } else { self.size };
            let mut there = q.to_vec();
            there[k] += step;
            let Some(moved) = self.residuals(&[], &there) else { return false };
            let scale = self.group[0]
                .targets
                .iter()
                .map(|t| (t.half * self.scaled(t) + 2e-4 * self.scale(t)) / self.scale(t));
            let column = moved.iter().zip(&r).zip(scale).map(|((a, b), s)| (a - b) / 1e-6 * s);
            columns.push(column.collect::<Vec<f64>>());
        }
        for (a, row) in normal.iter_mut().enumerate() {
            for (b, entry) in row.iter_mut().enumerate() {
                *entry = columns[a].iter().zip(&columns[b]).map(|(x, y)| x * y).sum();
            }
        }
        determinant(normal).abs().powf(0.5 / n as f64) > 1e-3
    }

    /// For each value: whether some configuration with it reaches the pose; nothing where that is not known.
    pub(super) fn verdicts(&self) -> Vec<Option<bool>> {
        let mut random = Random(11);
        // `q2 = 60° or q2 = -60°` are two answers.
        let twice = (1..self.group.len()).any(|k| self.group[..k].iter().any(|a| a.of == self.group[k].of));
        let single = self.group.iter().all(|a| a.values.len() == 1) && self.group.len() > 1 && !twice;
        if self.is_open.contains(&true) {
            return vec![None; self.group.len()];
        }
        let is_at = |r: Reached| matches!(r, Reached::At(_));
        let one = |k: usize| self.fixed(k, self.group[k].values.first().copied().unwrap_or(f64::NAN));
        if single {
            let all: Vec<Fixed> = (0..self.group.len()).map(one).collect();
            if is_at(self.reach(&all, &mut random)) {
                return vec![Some(true); self.group.len()];
            }
            // One that is wrong leaves the others right together.
            for k in 0..all.len() {
                let mut rest = all.clone();
                rest.remove(k);
                if all.len() > 2 && is_at(self.reach(&rest, &mut random)) {
                    return (0..all.len()).map(|i| Some(i != k)).collect();
                }
            }
        }
        let mut own = |k: usize| {
            let mut is_right = Some(true);
            for &v in &self.group[k].values {
                match self.reach(&[self.fixed(k, v)], &mut random) {
                    Reached::At(_) => {}
                    Reached::Vague => return None,
                    Reached::Nowhere => is_right = Some(false),
                }
            }
            is_right
        };
        let found: Vec<Option<bool>> = (0..self.group.len()).map(&mut own).collect();
        // Each is one of the pose, but not all together.
        if single && found.iter().all(|f| *f == Some(true)) { vec![None; found.len()] } else { found }
    }

    /// The value with which the others of the line, one number each, reach the pose.
    fn of_branch(&self, answer: usize) -> Option<f64> {
        let others = || (0..self.group.len()).filter(|&k| self.group[k].of != self.group[answer].of);
        if others().next().is_none() || others().any(|k| self.group[k].values.len() != 1) {
            return None;
        }
        let fixed: Vec<Fixed> = others().map(|k| self.fixed(k, self.group[k].values[0])).collect();
        let Reached::At(q) = self.reach(&fixed, &mut Random(17)) else { return None };
        let y = self.value(answer, &q)?;
        let x = self.fixed(answer, *self.group[answer].values.first()?).value;
        Some(if self.kinds[answer] == Kind::Turn { y - TAU * ((y - x) / TAU).round() } else { y })
    }

    /// The value nearest to a wrong one with which the pose is reached.
    fn nearest(&self, answer: usize) -> Option<f64> {
        let x = self.fixed(answer, *self.group[answer].values.first()?).value;
        let mut random = Random(13);
        let mut best: Option<f64> = None;
        for _ in 0..8 {
            let Reached::At(q) = self.reach(&[], &mut random) else { continue };
            let y = self.value(answer, &q)?;
            let y = if self.kinds[answer] == Kind::Turn { y - TAU * ((y - x) / TAU).round() } else { y };
            if best.is_none_or(|b| (y - x).abs() < (b - x).abs()) {
                best = Some(y);
            }
        }
        best
    }
}

/// The step of least squares, damped.
fn damped(j: &[Vec<f64>], r: &[f64], damping: f64) -> Option<Vec<f64>> {
    let n = j.first()?.len();
    let mut a = vec![vec![0.0; n + 1]; n];
    for (i, row) in a.iter_mut().enumerate() {
        for (k, entry) in row.iter_mut().take(n).enumerate() {
            *entry = j.iter().map(|g| g[i] * g[k]).sum();
        }
        row[n] = j.iter().zip(r).map(|(g, r)| g[i] * r).sum();
    }
    let largest = (0..n).map(|i| a[i][i]).fold(1e-30, f64::max);
    for (i, row) in a.iter_mut().enumerate() {
        row[i] += damping * row[i].max(1e-9 * largest);
    }
    for i in 0..n {
        let pivot = (i..n).max_by(|&x, &y| a[x][i].abs().total_cmp(&a[y][i].abs()))?;
        a.swap(i, pivot);
        if a[i][i].abs() < 1e-300 {
            return None;
        }
        for k in 0..n {
            if k != i {
                let factor = a[k][i] / a[i][i];
                let row = a[i].clone();
                a[k].iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    Some((0..n).map(|i| a[i][n] / a[i][i]).collect())
}

fn determinant(mut a: Vec<Vec<f64>>) -> f64 {
    let n = a.len();
    let mut product = 1.0;
    for i in 0..n {
        let Some(pivot) = (i..n).max_by(|&x, &y| a[x][i].abs().total_cmp(&a[y][i].abs())) else { return 0.0 };
        if a[pivot][i] == 0.0 {
            return 0.0;
        }
        if pivot != i {
            a.swap(i, pivot);
            product = -product;
        }
        product *= a[i][i];
        for k in i + 1..n {
            let factor = a[k][i] / a[i][i];
            let row = a[i].clone();
            a[k].iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
        }
    }
    product
}
