//! Formulas carried out one after the other, branch by branch.

use super::{Model, Models, POSES, Random, near};
use crate::common::printed::{formulas, list, read, string, strings, text, values};
use denavit::geometry::Transform;
use denavit_symbolic::Expr;
use denavit_symbolic::vocabulary::Vocabulary;
use toml::{Table, Value};

/// One branch of a procedure: the joint variables found so far, and the sums that must stay.
#[derive(Clone)]
struct Branch {
    q: Vec<f64>,
    sums: Vec<(Expr, f64)>,
}

/// All combinations of the values of the steps.
pub fn run(model: &Model, steps: &[(Vec<Expr>, Vec<Vec<Expr>>)], pose: &Transform<f64>) -> Vec<Vec<f64>> {
    let mut branches = vec![Branch { q: vec![0.0; model.variables.len()], sums: vec![] }];
    for (of, values) in steps {
        let next = branches.iter().flat_map(|branch| values.iter().map(move |value| (branch, value)));
        branches = next
            .filter_map(|(branch, value)| {
                let found = model.values(value, &branch.q, pose);
                if !found.iter().all(|x| x.is_finite()) {
                    return None;
                }
                let mut branch = branch.clone();
                for (&of, x) in of.iter().zip(found) {
                    branch.sums.push((of, x));
                    // The last variable of each sum makes up for what has changed in the others.
                    for &(sum, x) in branch.sums.iter().rev() {
                        let last = model.last(sum);
                        branch.q[last] += x - model.value(sum, &branch.q, pose);
                    }
                }
                Some(branch)
            })
            .collect();
    }
    branches.into_iter().map(|b| b.q).collect()
}

/// The steps of a procedure: as printed, or what is under the first of `keys` that a claim has.
pub fn steps(
    file: &Table,
    procedure: &Table,
    names: &Vocabulary,
    keys: &[&str],
) -> Vec<(Vec<Expr>, Vec<Vec<Expr>>)> {
    let formulas_of = |id: &String| {
        let all = list(file, "claims").into_iter().chain(list(file, "omitted"));
        let claim = all.into_iter().find(|c| string(c, "id") == id).expect("a claim");
        let right = keys.iter().find_map(|key| claim.get(*key).and_then(Value::as_table));
        (formulas(claim, "of", names), values(right.unwrap_or(claim), names))
    };
    strings(procedure, "steps").iter().map(formulas_of).collect()
}

/// The corrected formulas, one after the other, give the solutions of the derived inverse model, and no others.
pub fn check_procedures(file: &Table, change: Option<&str>) {
    let keys: &[&str] = if change.is_some() { &["hypothesis_right", "right"] } else { &["right"] };
    let mut models = Models::new(file, change);
    for procedure in list(file, "procedures") {
        let model = models.of(procedure);
        let steps = steps(file, procedure, &model.names, keys);
        let length = procedure.get("length").map(|l| read(text(l), &model.names));
        let integer = |key: &str| procedure.get(key).and_then(Value::as_integer).map(|n| n as usize);
        let mut most = 0;
        let mut random = Random(13);
        for _ in 0..POSES {
            let q = model.random(&mut random);
            let pose = model.robot.pose(&q);
            let ours = run(model, &steps, &pose);
            let derived = model.solver.solve(&pose, &[]);
            assert_eq!(ours.len(), derived.solutions.len(), "{q:?}");
            for solution in &derived.solutions {
                assert!(ours.iter().any(|o| near(o, &solution.q)), "{:?} in {ours:?}", solution.q);
            }
            assert!(ours.iter().any(|o| near(o, &q)));
            most = most.max(ours.len());
            if let Some(length) = length {
                let positive = ours.iter().filter(|o| model.value(length, o, &pose) > 0.0).count();
                assert_eq!(Some(positive), integer("positive"));
            }
        }
        assert_eq!(Some(most), integer("most"));
        assert_eq!(Some(model.inverse.max_solutions()), integer("most"));
    }
}
