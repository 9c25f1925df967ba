//! Right formulas: the printed one with other functions and signs, or a step of the derived inverse model.

use super::arm::Arm;
use super::compare::{Comparison, Formulas};
use super::condition::{self, quotient};
use super::judgement::{Origin, Right, Where};
use super::setting::{Sample, Setting, Unknown};
use super::spoken;
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::inverse::InverseModel;
use denavit::inverse::derivation::{Determinant, Form, Norm, Step};
use denavit_symbolic::poly::Poly;
use denavit_symbolic::{Angle, Expr, Node, Rational};
use rustc_hash::FxHashMap;

/// Places of a formula that are tried with other signs, and formulas that are tried in all.
const SITES: usize = 5;
const TRIALS: usize = 256;
/// Steps of which a sum is looked for.
const SUMMED: usize = 8;

/// The formula with each node rebuilt bottom-up; `change` gets the node as it was and as it is rebuilt.
pub fn rebuilt(e: Expr, change: &mut dyn FnMut(Expr, Expr) -> Expr) -> Expr {
    let mut new: FxHashMap<Expr, Expr> = FxHashMap::default();
    for x in Expr::postorder(&[e]) {
        let of = |a: &Expr| new[a];
        let plain = match x.node() {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => x,
            Node::Neg(a) => -of(&a),
            Node::Add(a, b) => of(&a) + of(&b),
            Node::Sub(a, b) => of(&a) - of(&b),
            Node::Mul(a, b) => of(&a) * of(&b),
            Node::Div(a, b) => of(&a) / of(&b),
            Node::Pow(a, n) => of(&a).powi(n),
            Node::Sqrt(a) => of(&a).sqrt(),
            Node::Sin(a) => of(&a).sin(),
            Node::Cos(a) => of(&a).cos(),
            Node::Atan2(a, b) => of(&a).atan2(of(&b)),
            Node::Sign(a) => of(&a).sign(),
        };
        let made = change(x, plain);
        new.insert(x, made);
    }
    new[&e]
}

/// The printed formulas with atan2 for arctan, other signs of roots, and both arguments of an atan2 with the other sign
/// or with the sign of a condition: those of them that are the solutions, if together they are all.
pub fn mended(setting: &Setting, samples: &[Sample], formulas: &Formulas, places: &[Where]) -> Option<Right> {
    let signs: Vec<Expr> = places
        .iter()
        .filter_map(|p| match p {
            Where::If(e) => e.first().copied(),
            _ => None,
        })
        .collect();
    let mut trials: Vec<Vec<Expr>> = vec![];
    for branch in formulas.branches {
        for sign in std::iter::once(None).chain(signs.iter().copied().map(Some)) {
            trials.extend(variants(branch, sign));
        }
    }
    let mut seen = rustc_hash::FxHashSet::default();
    trials.retain(|t| seen.insert(t.clone()));
    trials.truncate(TRIALS);
    let all = Comparison::new(setting, samples, &Formulas { branches: &trials, ..*formulas }).ok()?;
    let good = (0..trials.len()).filter(|&k| all.right[k].iter().all(|&r| r));
    let mut chosen: Vec<Vec<Expr>> = vec![];
    let mut given = 0;
    for k in good.collect::<Vec<_>>() {
        chosen.push(trials[k].clone());
        let found = Comparison::new(setting, samples, &Formulas { branches: &chosen, ..*formulas }).ok()?;
        if found.is_right() {
            return Some(right(formulas.of, chosen, formulas.known, Origin::Mended));
        }
        if found.most[0] <= given {
            chosen.pop();
        }
        given = given.max(found.most[0]);
    }
    None
}

fn right(of: &[Unknown], branches: Vec<Vec<Expr>>, known: &[Unknown], origin: Origin) -> Right {
    let formulas = |all: &[Unknown]| all.iter().map(|u| u.formula).collect();
    Right { of: formulas(of), branches, known: formulas(known), origin }
}

/// A branch with other signs, the least changed first.
fn variants(branch: &[Expr], sign: Option<Expr>) -> Vec<Vec<Expr>> {
    let nodes = Expr::postorder(branch);
    let mut sites: Vec<Expr> =
        nodes.into_iter().filter(|e| matches!(e.node(), Node::Atan2(..) | Node::Sqrt(_))).collect();
    sites.reverse();
    sites.truncate(SITES);
    let of = |mask: usize| -> Vec<Expr> {
        let flipped = |e: Expr| sites.iter().position(|&s| s == e).is_some_and(|k| mask >> k & 1 == 1);
        let mut change = |old: Expr, new: Expr| {
            let one = if flipped(old) { Expr::int(-1) } else { Expr::int(1) };
            match (old.node(), new.node()) {
                (Node::Sqrt(_), _) => one * new,
                (Node::Atan2(_, x), Node::Atan2(b, a)) => {
                    let factor = sign.filter(|_| sites.contains(&old)).map_or(one, |s| one * s);
                    let (b, a) = match quotient(b).filter(|_| x.is_one()) {
                        Some(pair) => pair,
                        None if x.is_one() && sign.is_none() => return new,
                        None => (b, a),
                    };
                    (factor * b).atan2(factor * a)
                }
                _ => new,
            }
        };
        branch.iter().map(|&e| rebuilt(e, &mut change)).collect()
    };
    let mut masks: Vec<usize> = (0..1 << sites.len()).collect();
    masks.sort_by_key(|m| m.count_ones());
    masks.into_iter().map(of).collect()
}

/// The step of the derived model for one unknown; `before` is what the document knows.
pub fn derived(arm: &Arm, of: &[Unknown], before: &[Unknown]) -> Option<Right> {
    let ([unknown], Some(model)) = (of, &arm.model) else { return None };
    let setting = &arm.setting;
    let wanted = setting.row(unknown.formula)?;
    let unknowns: Vec<Expr> = model.steps.iter().map(|s| model.chain.unknown_expr(s.unknown)).collect();
    let step = unknowns.iter().position(|&u| {
        setting.row(u).is_some_and(|r| r == wanted || r.iter().zip(&wanted).all(|(x, y)| x + y == 0.0))
    });
    if setting.given.iter().any(|&j| Expr::from(setting.variables[j]) == unknown.formula) {
        return None;
    }
    // No step of its own: a sum of others.
    let Some(k) = step else {
        let given = setting.given.iter().map(|&j| Expr::from(setting.variables[j]));
        return combined(arm, unknown, &unknowns.iter().copied().chain(given).collect::<Vec<_>>());
    };
    // An unknown that turns the other way, or with an offset: q = ±(u − offset).
    let form = Angle::of(unknowns[k]);
    let is_variable = |x: Expr| x.as_symbol().is_some_and(|s| setting.variables.contains(&s));
    let terms = form.terms.iter().filter(|t| is_variable(t.0)).cloned().collect();
    let offset = unknowns[k] - Angle { terms, ..Angle::default() }.to_expr();
    let negative = setting.row(unknowns[k])? != wanted;
    let own = |e: Expr| if negative { offset - e } else { e - offset };
    let branches: Vec<Vec<Expr>> = solutions(arm, model, k)?.into_iter().map(|e| vec![own(e)]).collect();
    let known = spoken::known(setting, &[unknown.formula], &[], &branches)?;
    let compare = |known: &[Unknown]| {
        let formulas = Formulas { of, known, branches: &branches };
        Comparison::new(setting, &arm.samples, &formulas).ok()
    };
    if !compare(&known)?.is_right() {
        return None;
    }
    // What the document knows beside may tell the branches apart.
    let is_new = |u: &&Unknown| !known.iter().any(|k| k.formula == u.formula);
    let all: Vec<Unknown> = known.iter().chain(before.iter().filter(is_new)).copied().collect();
    let compared = compare(&all)?;
    if !compared.is_right() {
        let of_all: Vec<Expr> = all.iter().map(|u| u.formula).collect();
        let places: Vec<Where> = branches
            .iter()
            .zip(&compared.right)
            .map(|(b, right)| condition::place(setting, &arm.samples, right, &condition::own(b, &of_all)))
            .collect();
        let formulas = Formulas { of, known: &all, branches: &branches };
        if let Some(told) = mended(setting, &arm.samples, &formulas, &places) {
            return Some(Right { origin: Origin::Derived, ..told });
        }
    }
    Some(right(of, branches, &known, Origin::Derived))
}

/// The unknown as a sum of what the steps find, with factors of ±1.
fn combined(arm: &Arm, unknown: &Unknown, found: &[Expr]) -> Option<Right> {
    let setting = &arm.setting;
    let wanted = setting.row(unknown.formula)?;
    let rows: Option<Vec<Vec<f64>>> = found.iter().map(|&u| setting.row(u)).collect();
    let rows = rows.filter(|r| r.len() <= SUMMED)?;
    let choices = 3_usize.pow(rows.len() as u32);
    let factor = |choice: usize, k: usize| [0.0, 1.0, -1.0][choice / 3_usize.pow(k as u32) % 3];
    let is_sum = |choice: &usize| {
        (0..wanted.len()).all(|j| {
            let sum: f64 = rows.iter().enumerate().map(|(k, r)| factor(*choice, k) * r[j]).sum();
            (sum - wanted[j]).abs() < 1e-9
        })
    };
    let choice = (0..choices).find(is_sum)?;
    let used = |f: f64| (0..rows.len()).filter(move |&k| factor(choice, k) == f).map(|k| found[k]);
    let plus = used(1.0).reduce(|a, b| a + b).unwrap_or(Expr::int(0));
    let sum = used(-1.0).fold(plus, |a, b| a - b);
    let known: Vec<Unknown> = used(1.0).chain(used(-1.0)).map(|u| setting.unknown(u)).collect();
    let (of, branches) = (std::slice::from_ref(unknown), vec![vec![sum]]);
    let formulas = Formulas { of, known: &known, branches: &branches };
    Comparison::new(setting, &arm.samples, &formulas).ok().filter(Comparison::is_right)?;
    Some(right(of, branches, &known, Origin::Derived))
}

/// The values of a step's unknown in the entries of the pose and what earlier steps found.
fn solutions(arm: &Arm, model: &InverseModel, k: usize) -> Option<Vec<Expr>> {
    let step: &Step = &model.steps[k];
    let moved = moved_pose(arm, model);
    let read = |e: Expr| e.substitute(|s| model.chain.pose.iter().position(|&p| p == s).map(|k| moved[k]));
    let poly = |p: &Poly| read(model.chain.algebra.formula(p));
    let norm = |n: &Norm| n.squares.iter().fold(Expr::int(0), |sum, p| sum + poly(p).powi(2)) + poly(&n.plus);
    let row = |k: usize| step.rows.get(k).map(|r| [poly(&r.a), poly(&r.b), norm(&r.c)]);
    let both = |x: Expr, root: Expr| vec![x + root, x - root];
    Some(match &step.form {
        Form::Ratio { numerator, denominator } => vec![poly(numerator) / poly(denominator)],
        Form::Quadratic { a, b, c } => {
            let (a, b, c) = (poly(a), poly(b), norm(c));
            both(-b / a, (b.powi(2) - a * c).sqrt() / a)
        }
        Form::Line => {
            let [a, b, _] = row(0)?;
            vec![(-a).atan2(b), a.atan2(-b)]
        }
        Form::Sincos => {
            let [a, b, c] = row(0)?;
            let root = (a.powi(2) + b.powi(2) - c.powi(2)).sqrt();
            if b.is_zero() {
                return Some(vec![(root / a).atan2(c / a), (-root / a).atan2(c / a)]);
            }
            both(b.atan2(a), root.atan2(c))
        }
        Form::Pair { determinant } => {
            let ([a, b, c], [d, e, f]) = (row(0)?, row(1)?);
            let (y, x, w) = (a * f - d * c, c * e - f * b, a * e - d * b);
            match *determinant {
                Determinant::General => vec![(y / w).atan2(x / w)],
                _ => vec![signed(arm, w, y, x)],
            }
        }
        Form::Quartic(_) => return None,
    })
}

/// atan2(y/w, x/w), where the sign of w does not change.
fn signed(arm: &Arm, w: Expr, y: Expr, x: Expr) -> Expr {
    let positive = arm.setting.tape(&[w]).is_ok_and(|t| {
        arm.samples.first().is_some_and(|s| t.values(&arm.setting.point(&s.q, &s.entries))[0] > 0.0)
    });
    let sign = Expr::from(Rational::from(if positive { 1 } else { -1 }));
    (sign * y).atan2(sign * x)
}

/// The entries of U = base⁻¹·T·tool⁻¹ in those of T.
fn moved_pose(arm: &Arm, model: &InverseModel) -> Vec<Expr> {
    let entry = |k: usize| Expr::from(arm.setting.entries[k].0);
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| entry(4 * i + j)));
    let position = Vector(std::array::from_fn(|i| entry(4 * i + 3)));
    let pose = Transform::from_rotation_translation(Rotation::from_rows(rotation), position);
    let moved = model.chain.base.inverse() * pose * model.chain.tool.inverse();
    moved.matrix().concat()
}
