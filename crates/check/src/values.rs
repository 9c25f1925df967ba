//! Printed values of joint variables and of orientation angles: from statements to the judges, and their answers in
//! words.

use super::inverse::{
    Cause, Composed, Fault, Inverse, Judgement, Undecided, Values, Verdict, Where, orientation,
};
use super::lexis::{Columns, pose_symbol};
use super::outcome::{Claim, Counterexample, Entry, Finding, Wrong};
use super::plan::{Plan, Walked};
use super::subject::Subject;
use super::walk::{Assertion, Spoken};
use denavit::inverse::Goal;
use denavit_symbolic::factor::Zero;
use denavit_symbolic::parse::Syntax;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::readable::{literals, simplify};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;

/// No more formulas of a document than these are judged in this way.
const MAX_VALUES: usize = 300;
/// What is said of a part of the document.
pub(super) type Remark = (Range<usize>, String);

/// A formula of more literals is not shown.
const MAX_SHOWN: u64 = 200;

/// The claims about values of joints and angles, each with its place among all assertions; what the formulas of all
/// joints yield together, in words.
pub(super) fn judge(plan: &Plan, walked: &Walked, columns: Columns) -> (Vec<(usize, Claim)>, Vec<Remark>) {
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
            let judge = Judge { subject, names: walked.inverse_names_of(number), columns };
            judge.joints(&joints, &mut claims, &mut notes);
        }
        claims.extend(orientations(&angles, columns, walked.inverse_names_of(number)));
    }
    claims.sort_by_key(|c| c.0);
    (claims, notes)
}

struct Judge<'a> {
    subject: &'a Subject,
    names: &'a Vocabulary,
    columns: Columns,
}

type Statement<'a> = (usize, &'a Assertion, &'a Spoken);

impl Judge<'_> {
    fn joints(
        &self,
        statements: &[Statement<'_>],
        claims: &mut Vec<(usize, Claim)>,
        notes: &mut Vec<(Range<usize>, String)>,
    ) {
        let pose = [0, 1, 2].map(|r| [0, 1, 2, 3].map(|c| pose_symbol(self.columns, r, c)));
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
        let mut known: Vec<Expr> = vec![];
        // A second formula for a joint takes as known what the first one did.
        let mut before: Vec<(Expr, Vec<Expr>)> = vec![];
        for ((at, assertion, spoken), values) in statements.iter().zip(&all) {
            let Spoken::Joint { sides, .. } = spoken else { continue };
            let first = before.iter().find(|b| b.0 == values.of[0]).map(|b| b.1.clone());
            let taken = first.unwrap_or_else(|| known.clone());
            before.push((values.of[0], taken.clone()));
            let judgement = inverse.values(values, &taken);
            let place =
                sides.first().map_or(assertion.span.clone(), |s| s.0.start..sides[sides.len() - 1].0.end);
            let finding = self.finding(&judgement, sides);
            let entry = Entry { place: None, span: place, finding };
            claims.push((*at, claim(assertion, entry)));
            if !known.contains(&values.of[0]) {
                known.push(values.of[0]);
            }
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
            notes.push((span, together(&composed)));
        }
    }

    fn shown(&self, e: Expr) -> Option<String> {
        shown(e, self.names)
    }

    fn finding(&self, j: &Judgement, sides: &[(Range<usize>, Syntax)]) -> Finding {
        let remarks: Vec<String> = j.faults.iter().filter_map(|f| self.fault(f, j, sides)).collect();
        let correct = j.right.as_ref().and_then(|r| {
            let branches: Option<Vec<String>> = r.branches.iter().map(|b| self.shown(*b.first()?)).collect();
            let mut branches = branches?;
            branches.dedup();
            Some(branches.join(" or "))
        });
        let grounds = match j.grounds.proved {
            true => String::new(),
            false => {
                format!("by comparison with all solutions at {} poses", j.grounds.poses + j.grounds.special)
            }
        };
        match j.verdict {
            Verdict::Right => Finding::Equal { unless_zero: self.divisors(j) },
            Verdict::Incomplete => {
                let missing = j
                    .missing
                    .map_or(String::new(), |m| format!(": it gives {} of {} values", m.given, m.existing));
                let mut remarks = remarks;
                remarks.extend(Some(grounds).filter(|g| !g.is_empty()));
                Finding::Conditional {
                    condition: format!("as far as it goes, but solutions are left out{missing}"),
                    correct,
                    remarks,
                }
            }
            Verdict::Conditional => {
                let conditions: Vec<String> = j
                    .branches
                    .iter()
                    .filter_map(|b| match b {
                        Where::If(conditions) => {
                            let all: Option<Vec<String>> =
                                conditions.iter().map(|c| Some(format!("{} > 0", self.shown(*c)?))).collect();
                            Some(all?.join(" and "))
                        }
                        _ => None,
                    })
                    .collect();
                let mut conditions = conditions;
                conditions.dedup();
                let condition = match conditions.is_empty() {
                    true => "in a part of all configurations".to_string(),
                    false => format!("where {}", conditions.join(", or where ")),
                };
                let mut remarks = remarks;
                remarks.extend(Some(grounds).filter(|g| !g.is_empty()));
                Finding::Conditional { condition, correct, remarks }
            }
            Verdict::Wrong => {
                let mut remarks = remarks;
                remarks.extend(Some(grounds).filter(|g| !g.is_empty()));
                Finding::Wrong(Box::new(Wrong {
                    correct,
                    counterexample: j.counterexample.as_ref().and_then(|c| self.counterexample(c)),
                    remarks,
                    ..Wrong::default()
                }))
            }
            Verdict::Undecided(why) => Finding::Undecided { why: undecided(why) },
        }
    }

    /// What must not be 0.
    fn divisors(&self, j: &Judgement) -> Vec<String> {
        let mut found: Vec<String> = vec![];
        for fault in &j.faults {
            if let Fault::DivisionByZero { factor, .. } = fault {
                found.extend(self.shown(*factor).filter(|f| !found.contains(f)));
            }
        }
        found
    }

    fn fault(&self, fault: &Fault, j: &Judgement, sides: &[(Range<usize>, Syntax)]) -> Option<String> {
        let count: usize = sides.iter().map(|(_, s)| 1 << s.sign_choices().min(6)).sum();
        let which = |branch: usize| if count > 1 { format!("value {} ", branch + 1) } else { String::new() };
        let share = |x: f64| format!("{} %", (100.0 * x).round());
        Some(match fault {
            Fault::WrongQuadrant { branch, cause, conditions } => {
                let conditions: Vec<String> =
                    conditions.iter().filter_map(|c| Some(format!("{} > 0", self.shown(*c)?))).collect();
                let what = match cause {
                    Cause::Arctan => "an arctangent of a quotient loses the quadrant: atan2 keeps it",
                    Cause::Arcsin => "an arcsine gives one of two angles",
                    Cause::Arccos => "an arccosine gives one of two angles",
                    Cause::Atan2 => "both arguments of atan2 have the wrong sign elsewhere",
                    Cause::Root => "the sign of the root is not that of the configuration",
                    Cause::Other => "the sign is lost",
                };
                let place = if conditions.is_empty() {
                    String::new()
                } else {
                    format!(" (right where {})", conditions.join(" and "))
                };
                format!("{}{what}{place}", which(*branch))
            }
            Fault::MissingBranch => {
                let m = j.missing?;
                format!(
                    "solutions are left out at {} of the poses: {} of {} values",
                    share(m.poses),
                    m.given,
                    m.existing
                )
            }
            Fault::ExtraBranch { branch, share: x } => {
                format!("{}belongs to no solution at {} of the poses", which(*branch), share(*x))
            }
            Fault::OutOfDomain { branch, share: x } => {
                format!("{}is no number at {} of the poses", which(*branch), share(*x))
            }
            Fault::DivisionByZero { factor, zeros, .. } => {
                let zeros: Vec<String> = zeros.iter().take(2).map(|z| self.zero(z)).collect();
                let place = if zeros.is_empty() { String::new() } else { format!(" ({})", zeros.join("; ")) };
                format!("division by zero where {} = 0{place}", self.shown(*factor)?)
            }
            Fault::FailsAt(q) => format!("wrong at q = {q:.4?}, though the joint is determined there"),
            Fault::Residual(e) => format!("left minus right is {}", self.shown(*e)?),
        })
    }

    fn zero(&self, zero: &Zero) -> String {
        let angle = self.shown(zero.angle()).unwrap_or_default();
        let values: Vec<String> = zero.values().iter().filter_map(|v| self.shown(*v)).collect();
        format!("{angle} = {}", values.join(" or "))
    }

    fn counterexample(&self, c: &super::inverse::Counterexample) -> Option<Counterexample> {
        let variables = self.subject.description.variables();
        let at = variables.iter().zip(&c.q).map(|(v, &x)| (v.symbol.name().to_string(), x)).collect();
        Some(Counterexample { at, printed: *c.printed.first()?.first()?, right: *c.right.first()?.first()? })
    }
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

/// A formula as text, simplified if that is quick, unless it is too long.
fn shown(e: Expr, names: &Vocabulary) -> Option<String> {
    let size = literals(e);
    if size > 10 * MAX_SHOWN {
        return None;
    }
    let has_function = e.symbols().is_empty();
    let simple = simplify(e, &e.symbols()).map_or(e, |s| if has_function { e } else { s.expr });
    let shorter = if literals(simple) < size { simple } else { e };
    (literals(shorter) <= MAX_SHOWN).then(|| print(shorter, names, Style::Ascii))
}

fn undecided(why: Undecided) -> String {
    match why {
        Undecided::UnknownSymbol(s) => {
            format!("`{}` is neither a joint, a length nor an entry of the pose", s.name())
        }
        Undecided::Shape => "there are too many values".into(),
        Undecided::Circular => "the formula uses the joint that it is for".into(),
        Undecided::NeverDefined => "the formula is no number at any pose".into(),
        Undecided::NoSamples => "there are no poses to try it at".into(),
        Undecided::NoEnumeration => "the solutions of this arm cannot be listed".into(),
    }
}

fn together(c: &Composed) -> String {
    let spurious = match c.spurious {
        0 => String::new(),
        n => format!(", and {n} configurations that do not reach the pose"),
    };
    format!(
        "one after another the formulas yield {} of {} solutions at {} poses{spurious}",
        c.yielded, c.existing, c.poses
    )
}

/// Formulas for the angles of an orientation, those of one set together.
fn orientations(statements: &[Statement<'_>], columns: Columns, names: &Vocabulary) -> Vec<(usize, Claim)> {
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
                None => Finding::Undecided { why: "these are no angles of that set".into() },
                Some(o) => {
                    let range = shown(o.range, &Vocabulary::new()).unwrap_or_default().replace('`', "");
                    let judgement = &o.angles[k].1;
                    match judgement.verdict {
                        Verdict::Right => {
                            Finding::Equal { unless_zero: vec![range.replacen("angle ", "", 9)] }
                        }
                        Verdict::Undecided(why) => Finding::Undecided { why: undecided(why) },
                        _ => {
                            let right = judgement
                                .right
                                .as_ref()
                                .and_then(|r| shown(*r.branches.first()?.first()?, names));
                            let right = right.map(|r| entry_names(&r, columns));
                            match judgement.verdict {
                                Verdict::Wrong => {
                                    Finding::Wrong(Box::new(Wrong { correct: right, ..Wrong::default() }))
                                }
                                _ => Finding::Conditional {
                                    condition: conditions(judgement),
                                    correct: right,
                                    remarks: vec![],
                                },
                            }
                        }
                    }
                }
            };
            found.push((*at, claim(assertion, Entry { place: None, span: span.clone(), finding })));
        }
    }
    found
}

fn conditions(j: &Judgement) -> String {
    let mut found: Vec<String> = vec![];
    for b in &j.branches {
        if let Where::If(all) = b {
            found.extend(all.iter().filter_map(|c| Some(format!("{} > 0", shown(*c, &Vocabulary::new())?))));
        }
    }
    if found.is_empty() {
        "in a part of all orientations".into()
    } else {
        format!("where {}", found.join(" and "))
    }
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
