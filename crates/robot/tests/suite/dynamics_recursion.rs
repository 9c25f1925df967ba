//! The recursion with a name for every quantity.

use crate::common::Random;
use crate::dynamics::{random_arm, state};
use denavit::dynamics::{BaseModel, Dynamics, Formulas, Ground, Recursion, drive_torques};
use denavit_symbolic::{Expr, Symbol};
use std::collections::HashMap;

/// Its steps in numbers, one after the other, are the torques of the arm, and each link says on what its motion rests.
#[test]
fn steps_compute_the_torques() {
    for (k, name) in
        ["planar-2r", "scara", "articulated-3r", "stanford", "staubli-rx90"].into_iter().enumerate()
    {
        let d = random_arm(name, 70 + k as u64);
        let formulas = Formulas::named(&d);
        let base = BaseModel::derive(&d, &formulas);
        let recursion = Recursion::derive(&d, &formulas, &base);
        let arm = Dynamics::numeric(&d).unwrap();
        let n = arm.joints();
        let [q, qd, qdd] = state(n, &mut Random(k as u64));
        let mut at: HashMap<Symbol, f64> = HashMap::new();
        for (symbols, values) in [(&formulas.q, &q), (&formulas.qd, &qd), (&formulas.qdd, &qdd)] {
            at.extend(symbols.iter().copied().zip(values.iter().copied()));
        }
        at.extend(formulas.parameters.iter().filter_map(|p| Some((p.symbol, p.number()?))));
        for p in &base.parameters {
            at.insert(p.symbol, base.value(&formulas, p).unwrap());
        }
        let mut give = |symbol: Symbol, e: Expr| {
            let value = e.eval(|s| at.get(&s).copied()).unwrap_or_else(|s| panic!("{name}: {}", s.name()));
            assert!(at.insert(symbol, value).is_none(), "{name}: {}", symbol.name());
            value
        };
        let outward = recursion.outward.iter().flat_map(|o| &o.steps);
        for &(symbol, e) in outward.chain(recursion.inward.iter().flat_map(|i| &i.steps)) {
            give(symbol, e);
        }
        let found: Vec<f64> = recursion.torques.iter().map(|&(s, e)| give(s, e)).collect();
        let wanted = drive_torques(&arm, &q, &qd, &qdd, None);
        let size = wanted.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        let off = found.iter().zip(&wanted).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        assert!(off < 1e-11 * size, "{name}: {found:?} {wanted:?}");
        assert_eq!(recursion.outward.len(), arm.links.len());
        let grounds: Vec<Ground> = recursion.outward.iter().map(|o| o.ground).collect();
        let are_right = grounds.iter().all(|g| match n {
            ..=4 => *g == Ground::Proved,
            _ => matches!(g, Ground::Modulo(_) | Ground::Numbers(..)),
        });
        assert!(
            recursion.ground != Ground::Failed && (n > 4 || recursion.ground == Ground::Proved),
            "{name}"
        );
        assert!(are_right, "{name}: {grounds:?}");
    }
}

/// A parameter that has the name of a torque, or of a moment, keeps it.
#[test]
fn names_of_parameters_are_no_names_of_steps() {
    let text = "convention = 'craig'\n[parameters]\nt1 = 1\nn1z = ''\n[[joints]]\ntheta = 'q1'\nmass = 1\ncom = ['t1', 0, 0]\n\
                [[joints]]\na = 'n1z'\ntheta = 'q2'\nmass = 2\ncom = ['1', 0, 0]\n";
    let d = denavit::description::read_toml(text).unwrap().0;
    let formulas = Formulas::named(&d);
    let base = BaseModel::derive(&d, &formulas);
    let recursion = Recursion::derive(&d, &formulas, &base);
    let own = formulas.parameters.iter().map(|p| p.symbol);
    let mut names: Vec<String> = recursion.names().chain(own).map(|s| s.name().to_string()).collect();
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count, "{names:?}");
}
