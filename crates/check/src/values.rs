//! Printed values of joint variables and of orientation angles: from statements to the judges, and from their answers to
//! verdicts.

use super::edits::{Edit, Kind, edited, edits, lengths};
use super::facts::SlipKind;
use super::facts::{Condition, Remark, Unproved, Zeros};
use super::formula::Formula;
use super::habits::{Columns, Habits, Places, pose_symbol};
use super::inverse::{Composed, Fault, Inverse, Judgement, Undecided, Values, Verdict, Where, orientation};
use super::lexis::read;
use super::outcome::{Claim, Counterexample, Entry, Finding, Patch, Slip, Standing, Wrong};
use super::plan::{Plan, Walked};
use super::subject::Subject;
use super::trial::Trial;
use super::walk::{Assertion, Spoken};
use denavit::inverse::Goal;
use denavit_symbolic::factor::Zero;
use denavit_symbolic::parse::Syntax;
use denavit_symbolic::readable::{literals, simplify};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;
use std::rc::Rc;

/// No more formulas of a document than these are judged in this way.
const MAX_VALUES: usize = 300;
/// What the formulas of all joints yield together, in a part of the document.
pub(super) type Together = (Range<usize>, Composed);

/// A formula of more literals is not shown.
const MAX_SHOWN: u64 = 200;
/// A change is looked at if it gives the own value at such a share of the configurations.
const LEAST_SHARE: f64 = 0.2;

/// The claims about values of joints and angles, each with its place among all assertions; what the formulas of all
/// joints yield together.
pub(super) fn judge(text: &str, plan: &Plan, walked: &Walked) -> (Vec<(usize, Claim)>, Vec<Together>) {
    let habits = &plan.habits;
    let columns = habits.columns;
    let mut claims = vec![];
    let mut notes = vec![];
    for (number, subject) in plan.subjects.iter().enumerate() {
        let of: Vec<(usize, &Assertion, &Spoken)> = walked
            .assertions
            .iter()
            .enumerate()
            .filter(|(_, a)| a.subject == number)
            .filter_map(|(i, a)| Some((i, a, a.spoken.as_ref()?)))
            .take(MAX_VALUES)
            .collect();
        let joints: Vec<_> = of.iter().filter(|s| matches!(s.2, Spoken::Joint { .. })).copied().collect();
        let angles: Vec<_> = of.iter().filter(|s| matches!(s.2, Spoken::Angle { .. })).copied().collect();
        if !joints.is_empty() {
            let trial = Trial::new(subject, &Places(columns));
            let judge = Judge { text, subject, names: walked.inverse_names_of(number), habits, trial };
            judge.joints(&joints, &mut claims, &mut notes);
        }
        claims.extend(orientations(&angles, habits, walked.inverse_names_of(number)));
    }
    claims.sort_by_key(|c| c.0);
    (claims, notes)
}

struct Judge<'a> {
    text: &'a str,
    trial: Trial,
    subject: &'a Subject,
    names: &'a Rc<Vocabulary>,
    habits: &'a Habits,
}

type Statement<'a> = (usize, &'a Assertion, &'a Spoken);

impl Judge<'_> {
    fn joints(
        &self,
        statements: &[Statement<'_>],
        claims: &mut Vec<(usize, Claim)>,
        notes: &mut Vec<Together>,
    ) {
        let pose = [0, 1, 2].map(|r| [0, 1, 2, 3].map(|c| pose_symbol(self.habits.columns, r, c)));
        let mut all: Vec<Values> = vec![];
        let mut spans: Option<Range<usize>> = None;
        for (_, assertion, spoken) in statements {
            let Spoken::Joint { of, branches, .. } = spoken else { continue };
            let branches = branches.iter().map(|e| vec![*e]).collect();
            all.push(Values { of: vec![*of], branches, of_first_rows: None });
            spans = Some(spans.map_or(assertion.span.clone(), |s| s.start..assertion.span.end));
        }
        let speaks_of = |c: usize| {
            let symbols: Vec<Symbol> = (0..3).map(|r| pose[r][c]).collect();
            all.iter()
                .flat_map(|v| &v.branches)
                .flatten()
                .any(|e| e.symbols().iter().any(|s| symbols.contains(s)))
        };
        let goal = if (0..3).any(speaks_of) { Goal::Pose } else { Goal::Position };
        let mut inverse = Inverse::new(&self.subject.description, pose, goal);
        let needs = needs(&all);
        for (k, ((at, assertion, spoken), values)) in statements.iter().zip(&all).enumerate() {
            let Spoken::Joint { sides, .. } = spoken else { continue };
            // What is found before, in print or because it is needed; not what itself needs this.
            let own = values.of[0];
            let mut taken: Vec<Expr> = needs[k].clone();
            for (j, before) in all[..k].iter().enumerate() {
                if before.of[0] != own && !needs[j].contains(&own) && !taken.contains(&before.of[0]) {
                    taken.push(before.of[0]);
                }
            }
            let mut judgement = inverse.values(values, &taken);
            let is_open = |j: &Judgement| !matches!(j.verdict, Verdict::Right);
            if is_open(&judgement) && taken != needs[k] {
                let other = inverse.values(values, &needs[k]);
                if other.verdict == Verdict::Right {
                    judgement = other;
                }
            }
            // Values that stand in several statements are alternatives.
            let same: Vec<&Values> = all.iter().filter(|v| v.of == values.of).collect();
            if is_open(&judgement) && same.len() > 1 {
                let branches = same.iter().flat_map(|v| v.branches.clone()).collect();
                let union = Values { of: values.of.clone(), branches, of_first_rows: None };
                let together = inverse.values(&union, &needs[k]);
                // With those of a joint before it they belong together, the first to the first.
                let pairs_up = self.pairs_up(&all[..k], &same);
                if together.verdict == Verdict::Right && pairs_up {
                    judgement = together;
                } else if together.verdict == Verdict::Right {
                    judgement = Judgement { verdict: Verdict::Wrong, ..judgement };
                }
            }
            let place =
                sides.first().map_or(assertion.span.clone(), |s| s.0.start..sides[sides.len() - 1].0.end);
            let mut finding = self.finding(&judgement, sides);
            // A formula of what itself depends on the joint, as of a point of the arm: that it gives the joint's own value proves
            // nothing, that it gives another one does.
            if judgement.verdict == Verdict::Undecided(Undecided::Circular) {
                finding = self.never_own(own, values, sides).unwrap_or(finding);
            }
            let identities = judgement.identities.clone();
            if let (Standing::Wrong, [(span, syntax)]) = (finding.standing(), &sides[..])
                && let Finding::Wrong(wrong) = &mut finding
                && let Some(slip) = self.slip(&mut inverse, own, span, syntax, &taken)
            {
                wrong.correct = vec![slip.formula.clone()];
                wrong.slip = Some(slip);
            }
            let entry = Entry { place: None, span: place, finding, identities };
            claims.push((*at, claim(assertion, entry)));
        }
        // What the last formula for each joint yields together.
        let mut last: Vec<Values> = vec![];
        for values in all {
            last.retain(|v| v.of != values.of);
            last.push(values);
        }
        if last.len() > 1
            && let (Ok(composed), Some(span)) = (inverse.composed(&last), spans)
            && composed.open.is_empty()
        {
            notes.push((span, composed));
        }
    }

    /// A formula that gives another value than the joint's own wherever it gives one, and one change from which it gives that.
    fn never_own(&self, of: Expr, values: &Values, sides: &[(Range<usize>, Syntax)]) -> Option<Finding> {
        let [(span, syntax)] = sides else { return None };
        let [own, any] = self.trial.shares(of, &values.branches.concat());
        if own > 0.0 || any < 0.9 {
            return None;
        }
        let source = self.text.get(span.clone())?;
        let found = edits(source, syntax, &lengths(source, &self.subject.description)).into_iter().find_map(
            |edit| {
                let formula = edited(source, &edit)?;
                let changed = self.habits.ordered(read(&formula, &(0..formula.len()), self.names).ok()?);
                let branches: Vec<Expr> = changed.variants().iter().map(Syntax::value).collect();
                (self.trial.shares(of, &branches)[0] >= 2.0 * LEAST_SHARE)
                    .then(|| slip_of(edit, formula, span.start))
            },
        )?;
        let (correct, remarks) = (vec![found.formula.clone()], vec![Remark::Sampled]);
        Some(Finding::Wrong(Box::new(Wrong { correct, slip: Some(found), remarks, ..Wrong::default() })))
    }

    fn shown(&self, e: Expr) -> Option<Formula> {
        shown(e, self.names)
    }

    /// True if values in several statements belong to those of a joint before that has as many statements, one by one.
    fn pairs_up(&self, before: &[Values], same: &[&Values]) -> bool {
        let own = |v: &Values| self.trial.own(v.of[0], &v.branches.concat());
        // What is right nowhere belongs to nothing.
        let is_some = |v: &&Values| v.of != same[0].of && own(v).into_iter().any(|right| right);
        let others: Vec<&Values> = before.iter().filter(is_some).collect();
        let partner = others
            .iter()
            .map(|v| &v.of)
            .find(|of| others.iter().filter(|v| v.of == **of).count() == same.len());
        let Some(partner) = partner else { return true };
        let partners = others.iter().filter(|v| v.of == *partner);
        let pairs: Vec<(Vec<bool>, Vec<bool>)> = partners.zip(same).map(|(a, b)| (own(a), own(b))).collect();
        let count = pairs.first().map_or(0, |p| p.0.len());
        (0..count).all(|k| pairs.iter().all(|(a, b)| !a[k] || b[k]))
    }

    /// The single change of the text that makes a value right.
    fn slip(
        &self,
        inverse: &mut Inverse<'_>,
        of: Expr,
        span: &Range<usize>,
        syntax: &Syntax,
        known: &[Expr],
    ) -> Option<Slip> {
        let source = self.text.get(span.clone())?;
        for edit in edits(source, syntax, &lengths(source, &self.subject.description)) {
            let Some(formula) = edited(source, &edit) else { continue };
            let Ok(changed) = read(&formula, &(0..formula.len()), self.names) else { continue };
            let changed = self.habits.ordered(changed);
            let branches: Vec<Expr> = changed.variants().iter().map(Syntax::value).collect();
            if self.trial.shares(of, &branches)[0] < LEAST_SHARE {
                continue;
            }
            let values = Values {
                of: vec![of],
                branches: branches.into_iter().map(|b| vec![b]).collect(),
                of_first_rows: None,
            };
            if matches!(inverse.values(&values, known).verdict, Verdict::Wrong | Verdict::Undecided(_)) {
                continue;
            }
            return Some(slip_of(edit, formula, span.start));
        }
        None
    }

    fn finding(&self, j: &Judgement, sides: &[(Range<usize>, Syntax)]) -> Finding {
        let mut remarks: Vec<Remark> = j.faults.iter().filter_map(|f| self.fault(f, j, sides)).collect();
        if !j.grounds.proved {
            remarks.push(Remark::Compared(j.grounds.poses + j.grounds.special));
        }
        let correct = self.correct(j);
        match j.verdict {
            Verdict::Right if !j.grounds.proved => {
                remarks.retain(|r| !matches!(r, Remark::Compared(_)));
                Finding::Conditional { condition: compared(j), correct, remarks }
            }
            Verdict::Right => Finding::Equal { unless_zero: self.divisors(j) },
            Verdict::Incomplete => {
                Finding::Conditional { condition: Condition::Incomplete(j.missing), correct, remarks }
            }
            Verdict::Conditional => {
                let condition = Condition::Configurations(self.conditions(j));
                Finding::Conditional { condition, correct, remarks }
            }
            Verdict::Wrong => Finding::Wrong(Box::new(Wrong {
                correct,
                counterexample: j.counterexample.as_ref().and_then(|c| self.counterexample(c)),
                remarks,
                ..Wrong::default()
            })),
            Verdict::Undecided(why) => Finding::Undecided { why: Unproved::Values(why) },
        }
    }

    /// The values that are right, if all of them can be shown.
    fn correct(&self, j: &Judgement) -> Vec<String> {
        let branches = j.right.iter().flat_map(|r| &r.branches);
        let shown = branches.map(|b| Some(self.shown(self.habits.printed(*b.first()?))?.to_string()));
        let mut all = shown.collect::<Option<Vec<String>>>().unwrap_or_default();
        all.dedup();
        all
    }

    /// What must be positive, for each branch that is right somewhere.
    fn conditions(&self, j: &Judgement) -> Vec<Vec<Formula>> {
        let positive = j.branches.iter().filter_map(|b| match b {
            Where::If(conditions) => conditions.iter().map(|c| self.shown(*c)).collect(),
            _ => None,
        });
        let mut all: Vec<Vec<Formula>> = positive.collect();
        all.dedup();
        all
    }

    /// What must not be 0.
    fn divisors(&self, j: &Judgement) -> Vec<Formula> {
        let mut found: Vec<Formula> = vec![];
        for fault in &j.faults {
            if let Fault::DivisionByZero { factor, .. } = fault {
                found.extend(self.shown(*factor).filter(|f| !found.contains(f)));
            }
        }
        found
    }

    fn fault(&self, fault: &Fault, j: &Judgement, sides: &[(Range<usize>, Syntax)]) -> Option<Remark> {
        let count: usize = sides.iter().map(|(_, s)| 1 << s.sign_choices().min(6)).sum();
        let which = |branch: usize| (count > 1).then_some(branch);
        Some(match fault {
            Fault::WrongQuadrant { branch, cause, conditions } => Remark::SignLost {
                value: which(*branch),
                by: *cause,
                right_where: conditions.iter().filter_map(|c| self.shown(*c)).collect(),
            },
            Fault::MissingBranch => Remark::LeftOut(j.missing?),
            Fault::ExtraBranch { branch, share } => {
                Remark::NoSolution { value: which(*branch), share: *share }
            }
            Fault::OutOfDomain { branch, share } => Remark::NoNumber { value: which(*branch), share: *share },
            Fault::DivisionByZero { factor, zeros, .. } => Remark::DivisionByZero {
                zeros: zeros.iter().take(2).map(|z| self.zeros(z)).collect(),
                factor: self.shown(*factor)?,
            },
            Fault::FailsAt(q) => Remark::FailsAt(q.clone()),
            Fault::Residual(e) => Remark::Residual(self.shown(*e)?),
        })
    }

    fn zeros(&self, zero: &Zero) -> Zeros {
        let values = zero.values().iter().filter_map(|v| self.shown(*v)).collect();
        Zeros { angle: self.shown(zero.angle()), values }
    }

    fn counterexample(&self, c: &super::inverse::Counterexample) -> Option<Counterexample> {
        let variables = self.subject.description.variables();
        let at = variables.iter().zip(&c.q).map(|(v, &x)| (v.symbol.name().to_string(), x)).collect();
        Some(Counterexample { at, printed: *c.printed.first()?.first()?, right: *c.right.first()?.first()? })
    }
}

/// A change of a formula that begins at a place of the text.
fn slip_of(edit: Edit, formula: String, start: usize) -> Slip {
    let moved = |p: &Patch| Patch { span: p.span.start + start..p.span.end + start, now: p.now.clone() };
    let kind = match edit.kind {
        Kind::Arguments => SlipKind::Arguments,
        Kind::Slip(slip) => SlipKind::Formula(slip),
    };
    Slip { kind, patches: edit.patches.iter().map(moved).collect(), formula }
}

/// What each formula needs of the joints, directly and through the formulas for those.
fn needs(all: &[Values]) -> Vec<Vec<Expr>> {
    let of: Vec<Expr> = all.iter().map(|v| v.of[0]).collect();
    let speaks = |values: &Values, e: Expr| {
        let own = e.symbols();
        values.branches.iter().flatten().any(|b| own.iter().all(|s| b.symbols().contains(s)))
    };
    let mut needs: Vec<Vec<Expr>> = all
        .iter()
        .map(|v| {
            let mut found: Vec<Expr> = vec![];
            for &e in of.iter().filter(|e| **e != v.of[0] && speaks(v, **e)) {
                if !found.contains(&e) {
                    found.push(e);
                }
            }
            found
        })
        .collect();
    // As often as there are formulas: no chain is longer.
    for _ in 0..all.len().min(12) {
        let before = needs.clone();
        for (k, own) in needs.iter_mut().enumerate() {
            for e in before[k].clone() {
                let further = of.iter().zip(&before).filter(|(o, _)| **o == e).flat_map(|(_, n)| n.clone());
                for f in further.collect::<Vec<Expr>>() {
                    if f != of[k] && !own.contains(&f) {
                        own.push(f);
                    }
                }
            }
        }
        if before == needs {
            break;
        }
    }
    needs
}

fn claim(assertion: &Assertion, entry: Entry) -> Claim {
    Claim {
        span: assertion.span.clone(),
        name: assertion.name.clone(),
        about: assertion.about.clone(),
        entries: vec![entry],
        instead: None,
        remarks: assertion.remarks.clone(),
        robot: assertion.subject,
    }
}

/// A formula simplified if that is quick, unless it is too long to be shown.
fn shown(e: Expr, names: &Rc<Vocabulary>) -> Option<Formula> {
    let size = literals(e);
    if size > 10 * MAX_SHOWN {
        return None;
    }
    let has_function = e.symbols().is_empty();
    let simple = simplify(e, &e.symbols()).map_or(e, |s| if has_function { e } else { s.expr });
    let shorter = if literals(simple) < size { simple } else { e };
    (literals(shorter) <= MAX_SHOWN).then(|| Formula::new(shorter, names))
}

/// Formulas for the angles of an orientation, those of one set together.
fn orientations(
    statements: &[Statement<'_>],
    habits: &Habits,
    names: &Rc<Vocabulary>,
) -> Vec<(usize, Claim)> {
    let columns = habits.columns;
    let entries = [0, 1, 2].map(|r| [0, 1, 2].map(|c| pose_symbol(columns, r, c)));
    let mut found = vec![];
    let mut rest = statements;
    while let Some((_, _, Spoken::Angle { set, .. })) = rest.first() {
        // A name that occurs again begins another triple.
        let mut seen: Vec<&str> = vec![];
        let length = rest
            .iter()
            .take_while(|(_, _, s)| match s {
                Spoken::Angle { set: other, name, .. } if other == set && !seen.contains(&name.as_str()) => {
                    seen.push(name);
                    true
                }
                _ => false,
            })
            .count();
        let (group, behind) = rest.split_at(length.max(1));
        rest = behind;
        let angles: Vec<(String, Expr)> = group
            .iter()
            .filter_map(|(_, _, s)| match s {
                Spoken::Angle { name, value, .. } => Some((name.clone(), value.1.value())),
                Spoken::Joint { .. } => None,
            })
            .collect();
        let judged = orientation(*set, &angles, &entries);
        for (k, (at, assertion, spoken)) in group.iter().enumerate() {
            let Spoken::Angle { value: (span, _), .. } = spoken else { continue };
            let finding = match &judged {
                None => Finding::Undecided { why: Unproved::NotOfSet },
                Some(o) => of_angle(&o.angles[k].1, o.range, habits, names),
            };
            let identities = judged.iter().flat_map(|o| o.angles[k].1.identities.clone()).collect();
            found.push((
                *at,
                claim(assertion, Entry { place: None, span: span.clone(), finding, identities }),
            ));
        }
    }
    found
}

/// The verdict on an angle in its range.
fn of_angle(j: &Judgement, range: Expr, habits: &Habits, names: &Rc<Vocabulary>) -> Finding {
    let right = || -> Vec<String> {
        let right =
            j.right.as_ref().and_then(|r| shown(habits.printed(*r.branches.first()?.first()?), names));
        right.iter().map(|r| entry_names(&r.to_string(), habits.columns)).collect()
    };
    match j.verdict {
        Verdict::Right if !j.grounds.proved => {
            Finding::Conditional { condition: compared(j), correct: right(), remarks: vec![] }
        }
        Verdict::Right => Finding::Equal { unless_zero: vec![in_own_names(range)] },
        Verdict::Undecided(why) => Finding::Undecided { why: Unproved::Values(why) },
        Verdict::Wrong => Finding::Wrong(Box::new(Wrong { correct: right(), ..Wrong::default() })),
        Verdict::Incomplete | Verdict::Conditional => {
            Finding::Conditional { condition: orientations_of(j), correct: right(), remarks: vec![] }
        }
    }
}

/// What values agree in that are not proved.
fn compared(j: &Judgement) -> Condition {
    Condition::Compared { poses: j.grounds.poses + j.grounds.special, apart: j.grounds.apart }
}

/// A formula in the angles of a set, these named as the set names them.
fn in_own_names(e: Expr) -> Formula {
    let own = |s: Symbol| s.name().strip_prefix("angle ").map(Expr::symbol);
    Formula::new(e.substitute(own), &Rc::default())
}

/// In which part of all orientations an angle is right.
fn orientations_of(j: &Judgement) -> Condition {
    let names = Rc::default();
    let all = j.branches.iter().filter_map(|b| match b {
        Where::If(all) => Some(all),
        _ => None,
    });
    Condition::Orientations(all.flatten().filter_map(|c| shown(*c, &names)).collect())
}

/// The entries of the rotation as r11 … r33.
fn entry_names(formula: &str, columns: Columns) -> String {
    let mut out = formula.to_string();
    for r in 0..3 {
        for c in 0..3 {
            out = out.replace(&*pose_symbol(columns, r, c).name(), &format!("r{}{}", r + 1, c + 1));
        }
    }
    out.replace('`', "")
}
