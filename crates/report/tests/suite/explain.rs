//! Explanations of inverse kinematics: every formula that is printed is proved; two are looked at in full.

use denavit::catalogue;
use denavit::description::Description;
use denavit::inverse::{Branch, Choice, Goal, InverseModel, InverseOptions, Refusal};
use denavit_report::document::{Math, Proof, math, text};
use denavit_report::explain::Explanation;
use denavit_report::words::Tongue;
use denavit_symbolic::print::Style;
use denavit_symbolic::{Expr, Node, Symbol};

fn robot(name: &str) -> Description {
    catalogue::robot(name).unwrap_or_else(|| panic!("no robot {name}"))
}

fn explanation(name: &str, given: Option<Vec<usize>>) -> Explanation {
    let model = InverseModel::derive(&robot(name), &InverseOptions { goal: Goal::Pose, given });
    Explanation::of(&model.unwrap_or_else(|why| panic!("{name}: {why}")))
}

fn plain(e: &Explanation) -> String {
    text(&e.document(Tongue::English), &e.names(), Tongue::English, &|_, words| words.to_string())
}

/// The robots of the documents, and of each kind one.
const ROBOTS: [(&str, Option<usize>); 13] = [
    ("staubli-rx90", None),
    ("stanford", None),
    ("cylindrical-wrist", None),
    ("cylindrical-wrist-b", None),
    ("prrrrp", None),
    ("ur3-lab", None),
    ("smart5-six-rail", None),
    ("puma560", None),
    ("ur5", None),
    ("scara", None),
    ("planar-3r", None),
    ("kuka-kr16-2", None),
    ("franka-panda", Some(6)),
];

#[test]
fn every_formula_is_proved() {
    for (name, given) in ROBOTS {
        let e = explanation(name, given.map(|j| vec![j]));
        let names = e.names();
        let mut equations = 0;
        for s in e.statements() {
            let shown = math(&s.math, &names, Style::Unicode);
            assert!(s.proof.is_none_or(|p| p == Proof::Proved), "{name}: {shown}: {:?}", s.proof);
            equations += usize::from(s.number.is_some());
        }
        assert!(equations >= e.steps.len(), "{name}");
        assert_eq!(e.proof(), Proof::Proved, "{name}");
    }
}

/// A step has its equation, its type, its solution and its conditions, and says where its result is needed.
#[test]
fn every_step_has_its_parts() {
    for (name, given) in ROBOTS {
        let e = explanation(name, given.map(|j| vec![j]));
        assert_eq!(e.solutions, Some(e.steps.iter().map(|s| s.values).product()), "{name}");
        for (i, s) in e.steps.iter().enumerate() {
            assert!(
                !s.sources.is_empty() && s.sources.iter().all(|o| !o.equations.is_empty()),
                "{name}, step {}",
                i + 1
            );
            assert!(s.solution.iter().any(|x| x.proof.is_some()), "{name}, step {}", i + 1);
            let last = s.solution.last().map(|x| x.math.exprs()[0]);
            assert_eq!(last, Some(s.unknown), "{name}, step {}", i + 1);
            assert_eq!(s.sign.is_some(), s.values > 1, "{name}, step {}", i + 1);
            assert!(s.used_by.iter().all(|&k| k > i + 1), "{name}, step {}", i + 1);
        }
        // Every joint variable has a formula or is given.
        for v in e.description.variables() {
            let q = Expr::from(v.symbol);
            let by_step = e.steps.iter().any(|s| s.unknown == q);
            let follows = e.joints.iter().any(|s| s.math.exprs()[0] == q);
            assert!(by_step || follows || e.given.contains(&q), "{name}: {q}");
        }
    }
}

/// Values of symbols; of joint variables only sums may be known yet.
#[derive(Clone, Default)]
struct Values {
    known: Vec<(Symbol, f64)>,
    /// Coefficients of the joint variables, and the value of the sum.
    sums: Vec<(Vec<f64>, f64)>,
}

impl Values {
    /// Any joint variables that have the known sums.
    fn joints(&self, n: usize) -> Vec<f64> {
        let mut rows: Vec<Vec<f64>> = vec![];
        for (sum, value) in &self.sums {
            let mut row: Vec<f64> = sum.iter().copied().chain([*value]).collect();
            for r in &rows {
                let k = r.iter().position(|x| x.abs() > 0.5).expect("a pivot");
                let factor = row[k] / r[k];
                row.iter_mut().zip(r).for_each(|(x, y)| *x -= factor * y);
            }
            if row[..n].iter().any(|x| x.abs() > 0.5) {
                rows.push(row);
            }
        }
        let mut q = vec![0.0; n];
        for r in rows.iter().rev() {
            let k = r.iter().position(|x| x.abs() > 0.5).expect("a pivot");
            let rest: f64 = (0..n).filter(|&j| j != k).map(|j| r[j] * q[j]).sum();
            q[k] = (r[n] - rest) / r[k];
        }
        q
    }

    fn of(&self, e: Expr, variables: &[Symbol]) -> f64 {
        let q = self.joints(variables.len());
        let joint = |s| variables.iter().position(|v| *v == s).map(|j| q[j]);
        let value = |s| self.known.iter().rev().find(|k| k.0 == s).map(|k| k.1).or_else(|| joint(s));
        e.eval(value).unwrap_or_else(|s| panic!("{e}: no value of {s:?}"))
    }

    fn learn(&mut self, angle: Expr, value: f64, variables: &[Symbol]) {
        let unit = |j: usize| {
            let one = |s| Some(if s == variables[j] { 1.0 } else { 0.0 });
            angle.eval(one).unwrap_or(0.0)
        };
        let row: Vec<f64> = (0..variables.len()).map(unit).collect();
        self.sums.retain(|s| s.0 != row);
        self.sums.push((row, value));
    }
}

/// What is printed can be computed with: branch by branch it gives what the solver gives.
#[test]
fn formulas_give_the_solutions_of_the_solver() {
    for (name, given) in ROBOTS {
        let d = robot(name);
        let Ok(numbers) = denavit::Robot::numeric(&d) else { continue };
        let options = InverseOptions { goal: Goal::Pose, given: given.map(|j| vec![j]) };
        let model = InverseModel::derive(&d, &options).expect("a closed form");
        let e = Explanation::of(&model);
        let variables: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
        let q: Vec<f64> = (0..variables.len()).map(|j| 0.3 + 0.17 * (j * j) as f64 % 1.1).collect();
        let pose = numbers.pose(&q);
        let fixed: Vec<f64> = model.given.iter().map(|&j| q[j]).collect();
        let answer = model.solver(&d).expect("values").solve(&pose, &fixed);
        assert!(answer.families.is_empty() && !answer.solutions.is_empty(), "{name}");

        let number = |x: Expr| x.eval(|s| d.value(s)).expect("a constant");
        let moved = model.chain.base.map(number).inverse() * pose * model.chain.tool.map(number).inverse();
        let mut start = Values::default();
        start.known.extend(d.known_values());
        let entries = e.pose.iter().zip(moved.matrix().into_iter().flatten());
        start.known.extend(entries.filter_map(|(s, x)| Some((s.as_symbol()?, x))));
        for (&j, &x) in model.given.iter().zip(&fixed) {
            start.learn(variables[j].into(), x, &variables);
        }
        let signs: Vec<Symbol> = e.steps.iter().filter_map(|s| s.sign?.as_symbol()).collect();
        let mut found = 0;
        for branch in 0..1_usize << signs.len() {
            let mut values = start.clone();
            let mut taken = Branch::default();
            for step in &e.steps {
                if let Some(k) = step.sign {
                    let plus = branch >> signs.iter().position(|s| Expr::from(*s) == k).unwrap_or(0) & 1 == 0;
                    values.known.extend(k.as_symbol().map(|s| (s, if plus { 1.0 } else { -1.0 })));
                    let choice = if plus { Choice::Plus } else { Choice::Minus };
                    taken.0.extend(step.label.map(|label| (label, choice)));
                }
                let (mut cosine, mut sine) = (None, None);
                for s in step.names.iter().chain(&step.coefficients).chain(&step.solution) {
                    let [left, right] = s.math.exprs()[..] else { panic!("an equation") };
                    let value = values.of(right, &variables);
                    match left.node() {
                        Node::Symbol(_) if left == step.unknown => {
                            let meaning = step.meaning.unwrap_or(left);
                            // atan2 of a cosine and a sine that were said before holds already.
                            values.learn(meaning, value, &variables);
                        }
                        Node::Symbol(x) => values.known.push((x, value)),
                        Node::Cos(angle) => {
                            cosine = Some(value);
                            let sine = sine.unwrap_or_else(|| (1.0 - value * value).sqrt());
                            values.learn(angle, f64::atan2(sine, value), &variables);
                        }
                        Node::Sin(angle) => {
                            sine = Some(value);
                            let cosine = cosine.unwrap_or_else(|| (1.0 - value * value).sqrt());
                            values.learn(angle, f64::atan2(value, cosine), &variables);
                        }
                        other => panic!("{name}: {other:?}"),
                    }
                }
            }
            let ours = values.joints(variables.len());
            let theirs = answer.solutions.iter().find(|s| s.branch == taken);
            if ours.iter().any(|x| x.is_nan()) {
                assert!(theirs.is_none(), "{name} {taken}");
                continue;
            }
            let Some(theirs) = theirs else {
                panic!("{name}: the solver has no {taken}: {:?}", answer.solutions)
            };
            for (j, (a, b)) in ours.iter().zip(&theirs.q).enumerate() {
                let off = if model.chain.is_angle(j) {
                    (a - b).sin().hypot(1.0 - (a - b).cos())
                } else {
                    (a - b).abs()
                };
                assert!(off < 1e-9, "{name} {taken} q{}: {a} {b}", j + 1);
            }
            found += 1;
        }
        assert_eq!(found, answer.solutions.len(), "{name}");
    }
}

/// A formula that is not true is not called proved.
#[test]
fn what_is_false_is_found() {
    let model = InverseModel::derive(&robot("ur5"), &InverseOptions::default()).expect("a closed form");
    let mut other = model;
    // The derivation of another robot: every equation that holds d4 is wrong for it.
    other.chain = denavit::inverse::derivation::NormalChain::new(
        &robot("ur5e"),
        denavit::inverse::derivation::End::Pose,
    )
    .expect("a chain");
    let row = &mut other.steps[0].rows[0];
    std::mem::swap(&mut row.a, &mut row.b);
    assert_eq!(Explanation::of(&other).proof(), Proof::Wrong);
}

/// The order of the UR3 report: q1, then the wrist and the sum, then the elbow; eight solutions.
#[test]
fn ur3_as_in_the_report() {
    let e = explanation("ur3-lab", None);
    let unknowns: Vec<String> = e.steps.iter().map(|s| s.unknown.to_string()).collect();
    assert_eq!(unknowns[0], "q1");
    assert!(unknowns.contains(&"q234".to_string()) && unknowns.contains(&"q5".to_string()), "{unknowns:?}");
    assert_eq!(unknowns[4..], ["q3", "q2"]);
    assert_eq!(e.solutions, Some(8));
    let names = e.names();
    let last: Vec<String> = e.joints.iter().map(|s| math(&s.math, &names, Style::Ascii)).collect();
    assert_eq!(last, ["q4 = q234 - q2 - q3"]);
    let Math::Chain(..) = e.steps[0].sources[0].equations[0].math else { panic!("an equation") };
}

#[test]
fn refusals_say_how_far_it_came() {
    let d = robot("oblique-6r");
    let Err(Refusal::Stuck(stuck)) = InverseModel::derive(&d, &InverseOptions::default()) else {
        panic!("a closed form")
    };
    let e = Explanation::of_stuck(&d, &stuck, Goal::Pose);
    assert_eq!(e.solutions, None);
    assert_eq!(e.missing.len(), 6);
    let shown = plain(&e);
    assert!(
        shown.contains("Here the derivation ends") && shown.contains("polynomial of degree 16"),
        "{shown}"
    );
}

#[track_caller]
fn snapshot(name: &str) {
    let found = plain(&explanation(name, None));
    let path = format!("{}/tests/snapshots/explain_{name}.txt", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(&path, &found).expect("the snapshot is written");
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(found, expected, "UPDATE_SNAPSHOTS=1 writes the new text");
}

#[test]
fn ur5_in_full() {
    snapshot("ur5");
}

#[test]
fn rx90_in_full() {
    snapshot("staubli-rx90");
}
