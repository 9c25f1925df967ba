//! Printed values of joints at a few configurations: whether the configuration's own value is among them.
//!
//! This refutes quickly and proves nothing; readings and slips are chosen by it, and judged as all else is.

use super::habits::Places;
use super::subject::Subject;
use denavit::description::JointKind;
use denavit::geometry::orientation::{OrientationSet, extract, rotation};
use denavit::random::Random;
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashMap;
use std::f64::consts::{PI, TAU};

/// Configurations that are tried.
const TRIALS: usize = 24;
/// Values that are as near are the same.
const NEAR: f64 = 1e-7;

/// Configurations with their poses.
pub(super) struct Trial {
    points: Vec<FxHashMap<Symbol, f64>>,
    angles: Vec<Symbol>,
}

impl Trial {
    /// Configurations of a robot.
    pub fn new(subject: &Subject, places: &Places) -> Self {
        let d = &subject.description;
        let variables = d.variables();
        let pose = subject.pose().matrix();
        let mut random = Random(11);
        let mut points = vec![];
        for _ in 0..TRIALS {
            let mut point: FxHashMap<Symbol, f64> = FxHashMap::default();
            for (k, p) in d.parameters.iter().enumerate() {
                let known = d.value(p.symbol).filter(|x| *x != 0.0);
                point.insert(p.symbol, known.unwrap_or(0.31 + 0.07 * k as f64));
            }
            for v in &variables {
                let x = match v.kind {
                    JointKind::Revolute => (2.0 * random.unit() - 1.0) * PI,
                    JointKind::Prismatic => 0.2 + random.unit(),
                };
                point.insert(v.symbol, x);
            }
            let known = point.clone();
            for (r, row) in pose.iter().enumerate().take(3) {
                for (c, e) in row.iter().enumerate() {
                    if let Ok(x) = e.eval(|s| known.get(&s).copied()) {
                        point.insert(places.symbol(r, c), x);
                    }
                }
            }
            points.push(point);
        }
        let turning = variables.iter().filter(|v| v.kind == JointKind::Revolute);
        Trial { points, angles: turning.map(|v| v.symbol).collect() }
    }

    /// For each configuration whether the own value is among the printed ones.
    pub fn own(&self, of: Expr, branches: &[Expr]) -> Vec<bool> {
        let each = self.points.iter().map(|p| Trial { points: vec![p.clone()], angles: self.angles.clone() });
        each.map(|trial| trial.shares(of, branches)[0] > 0.0).collect()
    }

    /// The shares of configurations at which the own value is among the printed ones, and at which there are any.
    pub fn shares(&self, of: Expr, branches: &[Expr]) -> [f64; 2] {
        let is_angle = of.symbols().iter().all(|s| self.angles.contains(s));
        let (mut own, mut any) = (0, 0);
        for point in &self.points {
            let value = |e: Expr| e.eval(|s| point.get(&s).copied()).ok().filter(|x| x.is_finite());
            let Some(right) = value(of) else { continue };
            let printed: Vec<f64> = branches.iter().filter_map(|&b| value(b)).collect();
            let apart = |x: f64| {
                let d = x - right;
                if is_angle { (d - TAU * (d / TAU).round()).abs() } else { d.abs() }
            };
            any += usize::from(!printed.is_empty());
            own += usize::from(printed.iter().any(|&x| apart(x) < NEAR));
        }
        [own, any].map(|n| n as f64 / self.points.len().max(1) as f64)
    }
}

/// Whether a printed value for an angle of an orientation is one of the two that the angle has, at some orientation;
/// nothing where it has no value.
pub(super) fn is_angle(set: OrientationSet, name: &str, value: Expr, places: &Places) -> Option<bool> {
    let k = set.names().iter().position(|n| *n == name)?;
    let mut random = Random(13);
    let mut is_any = false;
    for _ in 0..TRIALS {
        let angles = [(); 3].map(|()| (2.0 * random.unit() - 1.0) * PI);
        let turned = rotation(set, &angles).ok()?;
        let usual = extract(&turned, set);
        let other = usual.other_solution();
        let rows = turned.rows();
        let entry = |s: Symbol| {
            let all = (0..3).flat_map(|r| (0..3).map(move |c| (r, c)));
            all.into_iter().find(|&(r, c)| places.symbol(r, c) == s).map(|(r, c)| rows[r][c])
        };
        let Ok(x) = value.eval(entry) else { continue };
        if !x.is_finite() {
            continue;
        }
        is_any = true;
        let right = [Some(usual.values.clone()), other.map(|o| o.values)];
        let apart = |y: f64| ((x - y) - TAU * ((x - y) / TAU).round()).abs();
        if right.into_iter().flatten().any(|r| r.get(k).is_some_and(|&y| apart(y) < NEAR)) {
            return Some(true);
        }
    }
    is_any.then_some(false)
}
