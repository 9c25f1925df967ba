//! The text of a compiled derivation reads back as the same solver, and any text is read or refused.

use crate::common::{Random, robot, share};
use denavit::inverse::{Goal, InverseModel, InverseOptions, variables};
use denavit::{Description, Robot};
use denavit_program::solver::{Leaf, Solver};

fn model(d: &Description) -> Option<InverseModel> {
    InverseModel::derive(d, &InverseOptions::default()).ok()
}

fn read(name: &str, text: &str) -> Solver {
    Solver::from_text(text).unwrap_or_else(|e| panic!("{name}: {e:?}"))
}

/// All of what a solver finds, bit by bit.
fn bits(solver: &Solver, d: &Description, inputs: &[Vec<f64>]) -> Vec<u64> {
    let function = solver.compile_with(|s| d.value(s)).expect("all parameters have values");
    let mut scalar = function.scalar();
    let mut found = vec![];
    for one in inputs {
        let leaf = |l: Leaf| {
            let numbers = l.outputs.iter().chain([&l.residual, &l.guard]).map(|x| x.to_bits());
            let signs = l.signs.iter().map(|&s| s as u64);
            numbers.chain(signs).collect::<Vec<_>>()
        };
        found.extend(scalar.solve(one, &[]).iter().flat_map(leaf));
    }
    found
}

#[test]
fn solvers_of_the_catalogue_come_back_the_same() {
    let mut random = Random(21);
    let mut count = 0;
    for name in denavit::catalogue::names() {
        let d = robot(name);
        let (Some(model), Ok(numbers)) = (model(&d), Robot::numeric(&d)) else { continue };
        let solver = &model.compiled.solver;
        let text = solver.to_text();
        let back = read(name, &text);
        assert_eq!(back.to_text(), text, "{name}");
        assert_eq!(back.registers, solver.registers, "{name}");
        assert_eq!(back.nodes, solver.nodes, "{name}");
        let inputs: Vec<Vec<f64>> = (0..5)
            .map(|_| {
                let q: Vec<f64> = (0..numbers.joints).map(|_| 6.0 * random.unit() - 3.0).collect();
                let given: Vec<f64> = model.given.iter().map(|&j| q[j]).collect();
                variables(Goal::Pose, &numbers.pose(&q), &given)
            })
            .collect();
        let found = bits(solver, &d, &inputs);
        assert!(!found.is_empty(), "{name}: nothing is found");
        assert_eq!(found, bits(&back, &d, &inputs), "{name}");
        count += 1;
    }
    assert!(count >= 80, "only {count} robots have a solver");
}

#[test]
fn what_is_wrong_with_a_text_is_said_with_its_place() {
    let text = model(&robot("planar-2r")).expect("a closed form").compiled.solver.to_text();
    let line_of = |start: &str| text.lines().position(|l| l.starts_with(start)).expect("it is there") + 1;
    let refused = |from: &str, to: &str| {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text, "{from} occurs");
        Solver::from_text(&changed).expect_err(&changed).remove(0).to_string()
    };
    let node = line_of("node");
    assert_eq!(
        refused("\nnode ", "\nnode odd"),
        format!("{node}:6: there is no equation `odd{}`", kind(&text))
    );
    let residual = line_of("residual");
    assert_eq!(
        refused("\nresidual ", "\nresidual 9"),
        format!("{residual}:10: register 9{} is not known here", register(&text, "residual "))
    );
    let degree = line_of("degree");
    assert_eq!(
        refused("\ndegree ", "\ndegree -"),
        format!("{degree}:8: a number has no sign: subtract it, or use it negated")
    );
    assert_eq!(
        refused("\nlevel\n", "\n"),
        "3:1: this line belongs to a level"
            .replace("this line belongs to a level", "`reads` is not expected here")
    );
    let huge = "#".repeat(1 << 25);
    assert!(Solver::from_text(&huge).is_err());
}

/// The type of the first node.
fn kind(text: &str) -> &str {
    let line = text.lines().find_map(|l| l.strip_prefix("node ")).expect("a node");
    line.split(' ').next().unwrap_or_default()
}

fn register<'a>(text: &'a str, start: &str) -> &'a str {
    text.lines().find_map(|l| l.strip_prefix(start)).expect("it is there")
}

#[test]
fn mutations_of_a_text_are_read_or_refused() {
    let mut random = Random(4);
    let (mut read, mut refused) = (0, 0);
    for name in ["planar-2r", "abb-irb120", "franka-panda"] {
        let text = model(&robot(name)).expect("a closed form").compiled.solver.to_text();
        let lines: Vec<&str> = text.lines().collect();
        for _ in 0..share(20_000, 400) {
            let mut changed: Vec<String> = lines.iter().map(ToString::to_string).collect();
            for _ in 0..1 + (3.0 * random.unit()) as usize {
                mutate(&mut changed, &mut random);
            }
            match Solver::from_text(&changed.join("\n")) {
                Err(errors) => {
                    assert!(errors.iter().all(|e| e.line >= 1 && e.column >= 1));
                    refused += 1;
                }
                Ok(solver) => {
                    read += 1;
                    // What is read can be computed with, whatever comes of it.
                    let values = vec![0.5; solver.parameters.len()];
                    let inputs = vec![0.3; solver.variables.len()];
                    let mut scalar = solver.compile(&values).scalar();
                    let _ = scalar.solve(&inputs, &[]).len();
                    assert_eq!(
                        Solver::from_text(&solver.to_text()).map(|s| s.to_text()),
                        Ok(solver.to_text())
                    );
                }
            }
        }
    }
    assert!(read > 20 && refused > 100, "{read} read, {refused} refused");
}

/// A line away, twice, elsewhere, or with other words or characters.
fn mutate(lines: &mut Vec<String>, random: &mut Random) {
    let mut at = |n: usize| ((random.unit() * n as f64) as usize).min(n.max(1) - 1);
    let (i, j, kind) = (at(lines.len()), at(lines.len()), at(6));
    let mut words: Vec<String> = lines[i].split(' ').map(String::from).collect();
    let (k, l) = (at(words.len()), at(words.len()));
    match kind {
        0 => drop(lines.remove(i)),
        1 => lines.insert(j, lines[i].clone()),
        2 => lines.swap(i, j),
        3 => {
            words.swap(k, l);
            lines[i] = words.join(" ");
        }
        4 => {
            words[k] =
                ["0", "7", "262144", "99999999999999999999", "-", "%0", "\"", "angle", "é"][at(9)].into();
            lines[i] = words.join(" ");
        }
        _ => {
            let mut chars: Vec<char> = lines[i].chars().collect();
            if !chars.is_empty() {
                let place = at(chars.len());
                chars[place] = ['0', ' ', '%', 'x', '\u{301}', '"'][at(6)];
            }
            lines[i] = chars.into_iter().collect();
        }
    }
}
