//! Divisors of a formula, and where they vanish.

use super::arm::Arm;
use super::judgement::Fault;
use super::setting::{Sample, Setting, Unknown};
use denavit_symbolic::factor::{factored, zeros};
use denavit_symbolic::{Expr, Node, Ring, Symbol, readable};

/// Points of a circle or a length at which the sign of a divisor is looked at.
const SCANNED: usize = 64;
/// Halvings to a zero.
const HALVINGS: usize = 60;
/// Configurations from which zeros are looked for.
const STARTS: usize = 4;

/// A divisor as it is printed, and a factor of it by the table that contains a variable.
fn divisors(setting: &Setting, formulas: &[Expr]) -> Vec<(Expr, Expr)> {
    let mut found: Vec<(Expr, Expr)> = vec![];
    for e in Expr::postorder(formulas) {
        let divisor = match e.node() {
            Node::Div(_, b) => b,
            Node::Pow(b, n) if n < 0 => b,
            _ => continue,
        };
        let divisor = match divisor.node() {
            Node::Sqrt(a) => a,
            _ => divisor,
        };
        for f in factors(setting.by_table(divisor)) {
            let varies = f.symbols().iter().any(|s| setting.variables.contains(s));
            if varies && !found.iter().any(|x| x.1 == f || x.1 == -f) {
                found.push((divisor, f));
            }
        }
    }
    found
}

fn factors(e: Expr) -> Vec<Expr> {
    let mut ring = Ring::new(&[e], &[]);
    let Ok(form) = ring.normal(e) else { return vec![e] };
    let num = readable::show(&ring, &form.num);
    let Ok(product) = factored(num, &[]) else { return vec![num] };
    let inner = |f: Expr| match f.node() {
        Node::Sqrt(a) => factored(a, &[]).map_or(vec![a], |p| p.factors.into_iter().map(|x| x.0).collect()),
        _ => vec![f],
    };
    product.factors.into_iter().flat_map(|f| inner(f.0)).collect()
}

/// What vanishes, where, and whether the unknown is determined there. What is not seen to vanish is left out.
pub fn faults(arm: &mut Arm, of: &[Unknown], known: &[Unknown], formulas: &[Expr]) -> Vec<Fault> {
    let found = divisors(&arm.setting, formulas);
    let starts: Vec<Sample> = arm.any.iter().take(STARTS).cloned().collect();
    let mut faults = vec![];
    for (divisor, factor) in found {
        let at: Vec<Vec<f64>> = starts.iter().filter_map(|s| zero(&arm.setting, factor, s)).collect();
        let zeros = zeros(factor);
        if at.is_empty() && zeros.is_empty() {
            continue;
        }
        let is_singular = of.is_empty() || (!at.is_empty() && at.iter().all(|q| is_open(arm, q, of, known)));
        faults.push(Fault::DivisionByZero { divisor, factor, zeros, at: at.into_iter().next(), is_singular });
    }
    faults
}

/// A configuration near a sample at which a factor is 0: one joint is moved until the sign changes.
fn zero(setting: &Setting, factor: Expr, near: &Sample) -> Option<Vec<f64>> {
    let tape = setting.tape(&[factor]).ok()?;
    let used = factor.symbols();
    let joints = (0..setting.variables.len()).rev().filter(|&j| used.contains(&setting.variables[j]));
    for j in joints {
        let half = if setting.is_angle[j] { std::f64::consts::PI } else { 3.0 * setting.size };
        let at = |x: f64| {
            let mut q = near.q.clone();
            q[j] = x;
            q
        };
        let value = |x: f64| tape.values(&setting.point(&at(x), &near.entries))[0];
        // The points keep clear of the special angles.
        let place = |k: usize| half * (2.0 * (k as f64 + 0.37) / SCANNED as f64 - 1.0);
        for k in 0..SCANNED {
            let (mut low, mut high) = (place(k), place(k + 1));
            let below = value(low);
            if below * value(high) >= 0.0 {
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = f64::midpoint(low, high);
                if (value(middle) < 0.0) == (below < 0.0) { low = middle } else { high = middle }
            }
            return Some(at(f64::midpoint(low, high)));
        }
    }
    None
}

/// True if at a configuration the unknown can change while the hand, and what is known, stay.
fn is_open(arm: &mut Arm, q: &[f64], of: &[Unknown], known: &[Unknown]) -> bool {
    let Some((sample, _)) = arm.sample(q.to_vec()) else { return false };
    let setting = &arm.setting;
    let unit = |s: Symbol| setting.row(s.into());
    let row = |u: &Unknown| match setting.row(u.formula) {
        Some(row) => vec![row],
        None => u.formula.symbols().into_iter().filter_map(unit).collect(),
    };
    let rows = |all: &[Unknown]| all.iter().flat_map(row).collect::<Vec<_>>();
    let (of, known) = (rows(of), rows(known));
    let moves =
        |motion: &[f64], row: &Vec<f64>| row.iter().zip(motion).map(|(x, y)| x * y).sum::<f64>().abs() > 1e-6;
    sample.motions.iter().any(|m| of.iter().any(|r| moves(m, r)) && !known.iter().any(|r| moves(m, r)))
        || sample.solutions.is_empty()
}
