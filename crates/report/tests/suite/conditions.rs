//! What a pose must meet: all that it must. The printed formulas are computed one after another at poses of the arm and beside
//! them, as a reader would, and the printed conditions leave a pose no way but those of the arm.

use denavit::catalogue;
use denavit::geometry::Transform;
use denavit::inverse::{InverseModel, InverseOptions};
use denavit::robot::Robot;
use denavit::velocity::svd;
use denavit_report::document::Math;
use denavit_report::explain::{Explanation, Statement};
use denavit_symbolic::{Expr, Node, Symbol};
use std::collections::HashMap;

type Values = HashMap<Symbol, f64>;

fn value(e: Expr, known: &Values) -> f64 {
    e.eval(|s| known.get(&s).copied()).unwrap_or(f64::NAN)
}

/// Both sides of an equation.
fn sides(s: &Statement) -> Option<(Expr, Expr)> {
    match &s.math {
        Math::Chain(left, rest) if rest.len() == 1 => Some((*left, rest[0].1)),
        _ => None,
    }
}

/// What stands on the left of a formula takes the value of what stands on the right.
fn compute(s: &Statement, known: &mut Values) {
    let Some((left, right)) = sides(s) else { return };
    let x = value(right, known);
    let angle = |a: Expr| a.as_symbol();
    match left.node() {
        Node::Cos(a) => angle(a).map(|a| known.insert(a, x.clamp(-1.0, 1.0).acos())),
        // Behind the cosine of the same angle.
        Node::Sin(a) => angle(a).map(|a| {
            let cosine = known.get(&a).map_or(f64::NAN, |a| a.cos());
            known.insert(a, x.atan2(cosine))
        }),
        _ => left.as_symbol().map(|s| known.insert(s, x)),
    };
}

/// By how much a pose misses each of the conditions.
fn misses(e: &Explanation, pose: &[f64; 12], signs: usize, parameters: &Values) -> Vec<f64> {
    let mut known = parameters.clone();
    for (symbol, x) in e.pose.iter().zip(pose) {
        symbol.as_symbol().map(|s| known.insert(s, *x));
    }
    let all: Vec<Symbol> = e.steps.iter().filter_map(|s| s.sign?.as_symbol()).collect();
    known.extend(all.iter().enumerate().map(|(k, s)| (*s, if signs >> k & 1 == 1 { -1.0 } else { 1.0 })));
    for step in &e.steps {
        step.names
            .iter()
            .chain(&step.coefficients)
            .chain(&step.solution)
            .for_each(|s| compute(s, &mut known));
    }
    e.joints.iter().for_each(|s| compute(s, &mut known));
    let miss =
        |s: &Statement| sides(s).map_or(f64::NAN, |(left, right)| value(left, &known) - value(right, &known));
    e.leftovers.iter().map(miss).collect()
}

/// The pose with its frame turned or shifted a little, the six ways.
fn moved(pose: &Transform<f64>, way: usize, by: f64) -> Transform<f64> {
    match way {
        0 => Transform::rotation_x(by) * *pose,
        1 => Transform::rotation_y(by) * *pose,
        2 => Transform::rotation_z(by) * *pose,
        _ => {
            let mut shifted = *pose;
            shifted.translation.0[way - 3] += by;
            shifted
        }
    }
}

fn entries(pose: &Transform<f64>) -> [f64; 12] {
    let m = pose.matrix();
    std::array::from_fn(|k| m[k / 4][k % 4])
}

#[test]
fn no_condition_is_missing() {
    let arms = [
        "articulated-3r",
        "planar-2r",
        "planar-3r",
        "spherical-rrp",
        "cylindrical-rpp",
        "scara",
        "al5d",
        "rhino-xr3",
        "adept-one",
    ];
    for name in arms {
        let d = catalogue::robot(name).expect("in the catalogue");
        let model = InverseModel::derive(&d, &InverseOptions::default()).expect("a closed form");
        let e = Explanation::of(&model);
        let filled = model.description.filled();
        let parameters: Values = filled.known_values().into_iter().collect();
        let robot = Robot::numeric(&filled).expect("with values");
        let number = |x: Expr| value(x, &parameters);
        let (base, tool) = (model.chain.base.map(number), model.chain.tool.map(number));
        let q: Vec<f64> = (0..robot.joints).map(|j| 0.4 + 0.37 * j as f64).collect();
        let pose = base.inverse() * robot.pose(&q) * tool.inverse();
        let signs = e.steps.iter().filter(|s| s.sign.is_some()).count();
        let mut branches = 0;
        for signs in 0..1 << signs {
            let at = |pose: &Transform<f64>| misses(&e, &entries(pose), signs, &parameters);
            // Other branches than that of the configuration may be out of reach.
            if !at(&pose).iter().all(|x| x.abs() < 1e-9) {
                continue;
            }
            branches += 1;
            const STEP: f64 = 1e-5;
            let slopes: Vec<Vec<f64>> = (0..6)
                .map(|way| {
                    let (behind, before) = (at(&moved(&pose, way, STEP)), at(&moved(&pose, way, -STEP)));
                    behind.iter().zip(&before).map(|(a, b)| (a - b) / (2.0 * STEP)).collect()
                })
                .collect();
            let rows: Vec<[f64; 6]> =
                (0..e.leftovers.len()).map(|c| std::array::from_fn(|way| slopes[way][c])).collect();
            let rank = svd(rows).values.iter().filter(|x| **x > 1e-6).count();
            assert_eq!(rank, 6 - model.rank, "{name}: {:?}", at(&moved(&pose, 0, 0.1)));
        }
        assert!(branches > 0, "{name}");
    }
}
