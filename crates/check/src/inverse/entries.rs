//! A right formula in the document's own style: the unknown's sine and cosine are two entries of the pose, seen from frames
//! that known joints carry, divided by a sine or cosine of another joint.

use super::arm::Arm;
use super::compare::{Comparison, Formulas};
use super::condition::seen_from;
use super::judgement::{Origin, Right};
use super::setting::Unknown;
use denavit_symbolic::{Expr, Symbol};

/// Two numbers this near are the same.
const SAME: f64 = 1e-9;

/// An entry that is ± a factor times the sine, or the cosine, of the unknown.
struct Found {
    entry: usize,
    factor: usize,
    negative: bool,
}

/// atan2(±a/f, ±b/f) with entries a, b and a factor f of 1, a sine or a cosine; what is known comes first.
pub fn pair(arm: &Arm, of: &[Unknown], known: &[Unknown]) -> Option<Right> {
    let [unknown] = of else { return None };
    let setting = &arm.setting;
    if !unknown.is_angle || arm.samples.is_empty() {
        return None;
    }
    let before: Vec<Expr> = known.iter().map(|u| u.formula).collect();
    let pool = seen_from(arm, &before);
    let own = unknown.formula.symbols();
    let others = |s: &&Symbol| !own.contains(s) && !before.contains(&Expr::from(**s));
    let others: Vec<Expr> = setting.variables.iter().filter(others).map(|&s| s.into()).collect();
    let angles: Vec<Expr> =
        before.iter().chain(&others).copied().filter(|&e| setting.unknown(e).is_angle).collect();
    let mut factors = vec![Expr::int(1)];
    factors.extend(angles.iter().flat_map(|a| <[Expr; 2]>::from(a.sin_cos())));
    let (sine, cosine) = unknown.formula.sin_cos();
    let all: Vec<Expr> =
        [sine, cosine].into_iter().chain(factors.iter().copied()).chain(pool.clone()).collect();
    let tape = setting.tape(&all).ok()?;
    let values: Vec<Vec<f64>> =
        arm.samples.iter().map(|s| tape.values(&setting.point(&s.q, &s.entries))).collect();
    let first = 2 + factors.len();
    let find = |which: usize, factor: usize| {
        let is = |entry: usize, sign: f64| {
            values.iter().all(|v| (v[first + entry] - sign * v[which] * v[2 + factor]).abs() <= SAME)
        };
        let signs = [(1.0, false), (-1.0, true)];
        (0..pool.len()).find_map(|entry| {
            let negative = signs.iter().find(|s| is(entry, s.0))?.1;
            Some(Found { entry, factor, negative })
        })
    };
    let (y, x) = (0..factors.len()).find_map(|f| Some((find(0, f)?, find(1, f)?)))?;
    let side = |found: &Found| {
        let e = pool[found.entry] / factors[found.factor];
        if found.negative { -e } else { e }
    };
    let branches = vec![vec![side(&y).atan2(side(&x))]];
    let mut needed = known.to_vec();
    if y.factor > 0 {
        let angle = angles[(y.factor - 1) / 2];
        if !before.contains(&angle) {
            needed.push(setting.unknown(angle));
        }
    }
    let formulas = Formulas { of, known: &needed, branches: &branches };
    Comparison::new(setting, &arm.samples, &formulas).ok().filter(Comparison::is_right)?;
    let known = needed.iter().map(|u| u.formula).collect();
    Some(Right { of: vec![unknown.formula], branches, known, origin: Origin::Entries })
}
