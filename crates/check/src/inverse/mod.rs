//! Printed formulas of inverse kinematics, judged: values of joint variables, and equations in them and the pose.
//!
//! Two methods, one for certainty and one for everything. The forward model in place of the pose makes a printed value a
//! formula in the joint variables, and that it is the joint's own is an identity that is proved (`proof`). All
//! solutions of many poses, by the derived inverse model, say which values belong to no solution and which solutions
//! have no value (`compare`). Where a value is right in a part of all configurations only, the sign that tells is searched
//! (`condition`); a right formula is the printed one mended, or the derived model's (`mend`).
//!
//! In reading order: `judgement`, `tape`, `setting`, `arm`, `compare`, `condition`, `proof`, `division`, `mend`,
//! `entries`, `compose`, `orientation`. Angles are in radians, lengths in metres; n, o, a, p are the columns of the tool's pose in
//! the base.

mod arm;
mod compare;
mod compose;
mod condition;
mod division;
mod entries;
mod judgement;
mod mend;
mod orientation;
mod proof;
mod setting;
mod spoken;
mod tape;

pub use judgement::{
    Cause, Composed, Counterexample, Fault, Grounds, Judgement, Missing, Origin, Right, Undecided, Values,
    Verdict, Where,
};
pub(super) use mend::rebuilt;
pub use orientation::{Orientation, orientation};
pub(super) use tape::Tape;

use arm::Arm;
use compare::{Comparison, Formulas, share};
use denavit::description::Description;
use denavit::inverse::Goal;
use denavit_symbolic::{Equality, Expr, Symbol, equal, readable};
use setting::Unknown;
use std::collections::BTreeMap;

/// Alternatives that are judged at most.
const BRANCHES: usize = 256;

/// A robot whose printed inverse formulas are judged. What is needed of it is prepared once.
pub struct Inverse<'a> {
    description: &'a Description,
    pose: [[Symbol; 4]; 3],
    goal: Goal,
    /// By the number of rows; nothing where there is no such arm.
    arms: BTreeMap<Option<usize>, Option<Arm>>,
}

impl<'a> Inverse<'a> {
    /// For a table, the names of the entries of a pose by rows, and what of the pose the document gives: `Position` if its
    /// formulas contain no entry of a rotation.
    pub fn new(description: &'a Description, pose: [[Symbol; 4]; 3], goal: Goal) -> Self {
        Inverse { description, pose, goal, arms: BTreeMap::new() }
    }

    fn arm(&mut self, rows: Option<usize>) -> Option<&mut Arm> {
        let (description, pose, goal) = (self.description, &self.pose, self.goal);
        self.arms.entry(rows).or_insert_with(|| Arm::new(description, rows, pose, goal)).as_mut()
    }

    /// Whether an equation in joint variables, parameters and entries of the pose holds in every configuration.
    pub fn equation(&mut self, left: Expr, right: Expr) -> Judgement {
        match self.arm(None) {
            Some(arm) => equation(arm, left, right),
            None => Judgement::undecided(Undecided::NoSamples),
        }
    }

    /// Whether values are those of the arm's solutions that agree in what is known: joint variables, or sums of them.
    /// Angles in whose sines and cosines the formulas are written count as known, too.
    pub fn values(&mut self, v: &Values, known: &[Expr]) -> Judgement {
        match self.arm(v.of_first_rows) {
            Some(arm) => values(arm, v, known),
            None => Judgement::undecided(Undecided::NoSamples),
        }
    }

    /// What all formulas yield one after another, in the order of the document.
    ///
    /// # Errors
    /// See [`Undecided`].
    pub fn composed(&mut self, all: &[Values]) -> Result<Composed, Undecided> {
        let rows = all.first().and_then(|v| v.of_first_rows);
        if all.iter().any(|v| v.of_first_rows != rows) {
            return Err(Undecided::Shape);
        }
        let arm = self.arm(rows).ok_or(Undecided::NoSamples)?;
        compose::composed(arm, all)
    }
}

/// See [`Inverse::equation`].
fn equation(arm: &mut Arm, left: Expr, right: Expr) -> Judgement {
    let tape = match arm.setting.tape(&[left, right]) {
        Ok(tape) => tape,
        Err(s) => return Judgement::undecided(Undecided::UnknownSymbol(s)),
    };
    let setting = &arm.setting;
    let (mut holds, mut apart) = (vec![], vec![]);
    let mut defined = vec![];
    let mut counterexample = None;
    for s in &arm.any {
        let sides = tape.values(&setting.point(&s.q, &s.entries));
        if !sides.iter().all(|x| x.is_finite()) {
            continue;
        }
        let difference = (sides[0] - sides[1]).abs() / (1.0 + sides[0].abs() + sides[1].abs());
        let near = difference <= 1e-9;
        apart.push(difference);
        holds.push(near);
        defined.push(s.clone());
        if !near && counterexample.is_none() {
            let printed = sides.iter().map(|&x| vec![x]).collect();
            counterexample =
                Some(Counterexample { q: s.q.clone(), pose: s.entries.clone(), printed, right: vec![] });
        }
    }
    if holds.is_empty() {
        return Judgement::undecided(Undecided::NeverDefined);
    }
    let [l, r] = [left, right].map(|e| setting.by_table(e));
    let apart = compare::median(apart);
    let mut grounds = Grounds { proved: counterexample.is_some(), poses: holds.len(), special: 0, apart };
    let mut faults = vec![];
    let mut place = Where::Everywhere;
    if counterexample.is_none() {
        match equal(l, r) {
            Equality::Equal { .. } => grounds.proved = true,
            Equality::Different { .. } => {
                grounds.proved = true;
                place = Where::Nowhere;
            }
            Equality::Undecided(_) => {}
        }
    } else {
        let mut pool = condition::own(&[left, right], &[]);
        pool.extend(setting.variables.iter().flat_map(|&v| <[Expr; 2]>::from(Expr::from(v).sin_cos())));
        place = condition::place(setting, &defined, &holds, &pool);
    }
    if place != Where::Everywhere {
        faults.push(Fault::Residual(readable::simplify(l - r, &[]).map_or(l - r, |s| s.expr)));
    }
    let verdict = match place {
        Where::Everywhere => Verdict::Right,
        Where::Nowhere => Verdict::Wrong,
        Where::If(_) | Where::Partly(_) => Verdict::Conditional,
    };
    faults.extend(division::faults(arm, &[], &[], &[left, right]));
    let identities = if verdict == Verdict::Right && grounds.proved { vec![[l, r]] } else { vec![] };
    Judgement {
        identities,
        verdict,
        grounds,
        branches: vec![place],
        missing: None,
        extra: vec![],
        faults,
        counterexample,
        right: None,
    }
}

/// See [`Inverse::values`].
fn values(arm: &mut Arm, v: &Values, known: &[Expr]) -> Judgement {
    let branches = &v.branches;
    let is_bounded = (1..=BRANCHES).contains(&branches.len());
    if v.of.is_empty() || !is_bounded || branches.iter().any(|b| b.len() != v.of.len()) {
        return Judgement::undecided(Undecided::Shape);
    }
    let setting = &arm.setting;
    let of: Vec<Unknown> = v.of.iter().map(|&e| setting.unknown(e)).collect();
    let Some(known) = spoken::known(setting, &v.of, known, branches) else {
        return Judgement::undecided(Undecided::Circular);
    };
    let formulas = Formulas { of: &of, known: &known, branches };
    let compared = match Comparison::new(setting, &arm.samples, &formulas) {
        Ok(compared) if !arm.samples.is_empty() => compared,
        Ok(_) => return Judgement::undecided(Undecided::NoSamples),
        Err(why) => return Judgement::undecided(why),
    };
    if !compared.finite.iter().flatten().any(|&f| f) {
        return Judgement::undecided(Undecided::NeverDefined);
    }
    let places = places(arm, &formulas, &compared);
    let extra: Vec<usize> = (0..branches.len()).filter(|&k| compared.extra(k) > 0.0).collect();
    let missing = compared.missing();
    let everywhere = |k: usize| places[k] == Where::Everywhere;
    let verdict = if compared.is_right() {
        Verdict::Right
    } else if !arm.setting.is_enumerated {
        Verdict::Undecided(Undecided::NoEnumeration)
    } else if places.iter().all(|p| *p == Where::Nowhere) {
        Verdict::Wrong
    } else if extra.is_empty() && (0..branches.len()).all(everywhere) {
        Verdict::Incomplete
    } else {
        Verdict::Conditional
    };
    let mut faults = vec![];
    for (k, place) in places.iter().enumerate() {
        if let (Where::If(conditions), false) = (place, verdict == Verdict::Right) {
            let (cause, conditions) = (condition::cause(&branches[k]), conditions.clone());
            faults.push(Fault::WrongQuadrant { branch: k, cause, conditions });
        }
        let undefined = share(compared.finite[k].iter().map(|f| !f));
        if undefined > 0.0 && verdict != Verdict::Right {
            faults.push(Fault::OutOfDomain { branch: k, share: undefined });
        }
    }
    faults.extend(extra.iter().map(|&branch| Fault::ExtraBranch { branch, share: compared.extra(branch) }));
    faults.extend(missing.map(|_| Fault::MissingBranch));
    if verdict == Verdict::Right {
        faults.extend(compare::fails_at(&arm.setting, &arm.special, &formulas).map(Fault::FailsAt));
    }
    let proof = match verdict {
        Verdict::Right | Verdict::Conditional => {
            proof::proof(&arm.setting, &arm.samples, &of, branches, &places_to_prove(verdict, &places))
        }
        Verdict::Wrong | Verdict::Incomplete | Verdict::Undecided(_) => None,
    };
    let proved = verdict == Verdict::Wrong || proof.is_some();
    let right = match verdict {
        Verdict::Right | Verdict::Undecided(_) => None,
        _ => mend::mended(&arm.setting, &arm.samples, &formulas, &[])
            .or_else(|| entries::pair(arm, &of, &known))
            .or_else(|| mend::derived(arm, &of, &known))
            .or_else(|| mend::mended(&arm.setting, &arm.samples, &formulas, &places)),
    };
    let apart = compare::apart(&arm.setting, &arm.samples, &formulas);
    let grounds = Grounds { proved, poses: arm.samples.len(), special: arm.special.len(), apart };
    faults.extend(division::faults(arm, &of, &known, &branches.concat()));
    Judgement {
        identities: proof.unwrap_or_default(),
        verdict,
        grounds,
        branches: places,
        missing,
        extra,
        faults,
        counterexample: compared.example,
        right,
    }
}

/// Of right values every branch may be needed.
fn places_to_prove(verdict: Verdict, places: &[Where]) -> Vec<Where> {
    match verdict {
        Verdict::Right => vec![Where::Everywhere; places.len()],
        _ => places.to_vec(),
    }
}

/// Where each branch is right.
fn places(arm: &Arm, formulas: &Formulas, compared: &Comparison) -> Vec<Where> {
    let known: Vec<Expr> = formulas.known.iter().map(|u| u.formula).collect();
    let mut seen: Option<Vec<Expr>> = None;
    let branches = formulas.branches.iter().zip(&compared.right);
    branches
        .map(|(branch, right)| {
            if right.iter().all(|&r| r) || !right.iter().any(|&r| r) {
                return condition::place(&arm.setting, &arm.samples, right, &[]);
            }
            let mut pool = condition::own(branch, &known);
            pool.extend(seen.get_or_insert_with(|| condition::seen_from(arm, &known)).iter());
            condition::place(&arm.setting, &arm.samples, right, &pool)
        })
        .collect()
}
