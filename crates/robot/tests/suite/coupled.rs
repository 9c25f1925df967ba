//! Chains in which axes follow others: the level plate of a palletiser, and couplings at random.

use crate::attack::arms::one_of;
use crate::attack::judge::{self, Fault};
use crate::attack::poses;
use crate::common::{Random, share};
use crate::linkages::{Between, catalogued};
use denavit::closure::{ClosedInverse, Loops};
use denavit::description::linkage::Wanted;
use denavit::description::{Convention, prove_same_chain, read_toml};
use denavit::inverse::{InverseKinematics, InverseModel, InverseOptions, Refusal, Task, Unsuitable};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The angles of the rows of arms that are tried: of the letters in front `t` is any row, `p` one whose axis is parallel to
/// that of the row before.
const ARMS: [(&str, &[&str]); 19] = [
    // Palletisers, their levers counted from the ground and from the arm.
    ("ttppt", &["q1", "q2", "q3 - q2", "-q3", "q4"]),
    ("ttppt", &["q1", "q2", "q3", "-q2 - q3", "q4"]),
    ("ttppt", &["q1", "q2 + 20 deg", "q3 - q2", "35 deg - q3", "q4"]),
    ("ttpptt", &["q1", "q2", "q3", "-q2 - q3 + 0.3", "q4", "q5"]),
    ("tpppt", &["q1", "q2", "q3", "-q1 - q2 - q3", "q4"]),
    // Plates that keep level, and such that turn over.
    ("ttpt", &["q1", "q2", "-q2", "q3"]),
    ("ttppt", &["q1", "q2", "q3", "q2", "q4"]),
    ("ttpt", &["q1", "q2", "q2", "q3"]),
    // What follows an axis of another direction.
    ("tttt", &["q1", "q2", "q3", "q1"]),
    ("tttt", &["q1", "q2", "q1 + q2", "q3"]),
    ("ttppt", &["q1", "q2", "q3", "-q2 - q3", "q4 - q1"]),
    ("ttptt", &["q1", "q2", "q3", "q4", "-q4"]),
    ("ttptt", &["2*q1", "q2", "q3", "q4", "4*q1"]),
    // More is asked than these can do: what the pose tells twice has to agree.
    ("tpp", &["q1", "q2", "2*q1"]),
    ("tpp", &["q1", "q2", "q2 - q1"]),
    ("tppp", &["q1", "q2", "q1 - q2", "q3"]),
    ("ttpp", &["q1", "q2", "2*q1", "q3"]),
    ("tptt", &["q1", "q2", "q3", "q2 - q1"]),
    // Half an angle does not follow the angle, but the angle follows its half.
    ("ttpt", &["q1", "q2", "-q2/2", "q3"]),
];

fn text(random: &mut Random, (kinds, angles): (&str, &[&str])) -> String {
    let mut text = "name = \"coupled\"\nconvention = \"craig\"\n".to_string();
    for (kind, theta) in kinds.chars().zip(angles) {
        let alpha =
            if kind == 'p' { "0" } else { one_of(random, &["90 deg", "-90 deg", "90 deg", "35 deg", "0"]) };
        let mut length = || one_of(random, &["0", "0", "0.1", "0.3", "-0.25", "0.47"]);
        let (a, d) = (length(), length());
        let a = if kind == 'p' { one_of(random, &["0.5", "0.61"]) } else { a };
        let _ =
            writeln!(text, "[[joints]]\nalpha = \"{alpha}\"\na = \"{a}\"\nd = \"{d}\"\ntheta = \"{theta}\"");
    }
    text
}

#[test]
fn coupled_chains_are_solved() {
    let mut tally: BTreeMap<String, usize> = BTreeMap::new();
    let mut lies = vec![];
    for seed in 0..share(200, 2) as u64 {
        for (k, arm) in ARMS.iter().enumerate() {
            let mut random = Random(1 + seed * 1000 + k as u64);
            let text = text(&mut random, *arm);
            let (description, _) = read_toml(&text).unwrap_or_else(|e| panic!("{e:?}\n{text}"));
            let solver = InverseKinematics::new(&description, &InverseOptions::default()).expect("numbers");
            for _ in 0..6 {
                let asked = poses::asked(&mut random, &solver.robot, &solver.space);
                let answer = solver.solve(&asked.pose, &[]);
                let fault = judge::judge(&solver, &asked, &answer, 30, &mut random);
                let word = fault.map_or("complete".to_string(), |f| format!("{f:?} {:?}", answer.doubt));
                let name = format!("{:?} {}: {} {word}", arm.1, solver.method(), asked.class);
                *tally.entry(name).or_default() += 1;
                // Nor has what is said of a pose that nobody reaches a configuration without it.
                let away = asked.pose * denavit::geometry::Transform::rotation_z(random.between(0.2, 2.0));
                let false_ones = solver.solve(&away, &[]).solutions.into_iter().filter(|s| s.residual > 1e-6);
                lies.extend(false_ones.map(|s| format!("{s:?} for {away:?}, {}:\n{text}", solver.method())));
                if fault.is_some_and(Fault::is_lie) {
                    lies.push(format!("{fault:?} at {:?}, {}:\n{text}", asked.q, solver.method()));
                }
            }
        }
    }
    tally.iter().for_each(|(name, n)| println!("{n:5} {name}"));
    assert!(lies.is_empty(), "{}: {}", lies.len(), lies.join("\n"));
}

/// What follows by halves has no closed form, and says so; the palletiser has one, and moves its hand like a SCARA.
#[test]
fn followers_by_whole_multiples_have_a_normal_form() {
    let model = |arm: (&str, &[&str])| {
        let (description, _) = read_toml(&text(&mut Random(5), arm)).expect("a table");
        InverseModel::derive(&description, &InverseOptions::default())
    };
    let half: &[&str] = &["q1", "q2", "-3*q2/2", "q3"];
    assert!(matches!(model(("ttpt", half)), Err(Refusal::Unsuitable(Unsuitable::Coupling))));
    let palletiser = catalogued("palletiser").chain(None, None, None, Convention::Khalil).expect("a chain");
    let model = InverseModel::derive(&palletiser.description, &InverseOptions::default()).expect("closed");
    assert_eq!((model.rank, model.task, model.max_solutions()), (4, Task::PositionAndTurn, 4));
}

/// The palletiser's solutions in closed form: what its linkage has in this mode, what descents find, and no others.
#[test]
fn the_palletiser_has_all_its_solutions_in_closed_form() {
    let linkage = catalogued("palletiser");
    let chain = linkage.chain(None, None, None, Convention::Khalil).expect("a chain");
    let solver =
        InverseKinematics::new(&chain.description, &InverseOptions::default()).expect("all have values");
    assert_eq!(solver.method(), "closed form");
    let loops = Loops::new(&linkage).expect("values");
    let (mode, place) = (loops.mode(None).expect("the first"), loops.place(None).expect("a tip").1);
    let searched = ClosedInverse::new(&linkage, None, Wanted::Pose).expect("an inverse");
    let mut random = Random(17);
    let (poses, by_linkage) = (share(100_000, 300), share(500, 3));
    let (mut found, mut regular) = (0, 0);
    for number in 0..poses {
        let asked = poses::asked(&mut random, &solver.robot, &solver.space);
        let answer = solver.solve(&asked.pose, &[]);
        let starts = if number % 10 == 0 { 20 } else { 0 };
        let fault = judge::judge(&solver, &asked, &answer, starts, &mut random);
        assert!(
            fault.is_none() || asked.class != "regular" && !fault.is_some_and(Fault::is_lie),
            "{fault:?}: {asked:?} {answer:?}"
        );
        if asked.class != "regular" {
            continue;
        }
        (found, regular) = (found + answer.solutions.len(), regular + 1);
        for s in &answer.solutions {
            // Where the parallelograms are flat, their modes meet.
            if let Ok(a) = loops.assembly(&s.q, &mode) {
                let there = loops.pose(&place, &s.q, &a.passive);
                assert!((there.translation - asked.pose.translation).norm() < 1e-9);
            }
        }
        if number < by_linkage {
            for s in searched.solve(&asked.pose).solutions.iter().filter(|s| s.mode.as_ref() == Some(&mode)) {
                assert!(judge::holds(&solver, &asked.pose, &answer, &s.q, 1e-5), "{:?} of {asked:?}", s.q);
            }
        }
    }
    assert!(found >= 3 * regular, "{found} solutions of {regular} regular poses");
    // A pose whose plate is tilted is said to be out of the question.
    let tilted = denavit::geometry::Transform::rotation_x(random.between(0.2, 0.4))
        * solver.robot.pose(&[0.1, 1.2, 0.2, 0.3]);
    let answer = solver.solve(&tilted, &[]);
    assert!(!answer.is_reachable() && answer.is_complete(), "{answer:?}");
}

/// The catalogue's arms with parallelograms are chains of which all solutions are found; that of the IRB 2400 is the table without
/// its rods, the angle of the forearm measured against the turret.
#[test]
fn arms_with_parallelograms_are_chains_with_closed_forms() {
    let mut random = Random(23);
    for (name, joints) in [("irb660", 4), ("kr-pa", 4), ("irb2400", 6), ("sr400", 6)] {
        let chain = catalogued(name).chain(None, None, None, Convention::Khalil).expect("a chain");
        assert!(!chain.closed.as_ref().is_some_and(|c| c.is_of_values), "{name}: proved for all lengths");
        // Poses are asked for from everywhere.
        let mut free = chain.description.clone();
        free.rows.iter_mut().for_each(|r| r.limits = None);
        let solver = InverseKinematics::new(&free, &InverseOptions::default()).expect("values");
        assert_eq!((solver.method(), solver.robot.joints), ("closed form", joints), "{name}");
        for _ in 0..share(2_000, 20) {
            let asked = poses::asked(&mut random, &solver.robot, &solver.space);
            let answer = solver.solve(&asked.pose, &[]);
            let fault = judge::judge(&solver, &asked, &answer, 6, &mut random);
            assert!(
                fault.is_none() || asked.class != "regular" && !fault.is_some_and(Fault::is_lie),
                "{name}: {fault:?}: {asked:?}"
            );
        }
        if name == "irb2400" {
            let text = denavit::catalogue::text("abb-irb2400-10").expect("it is there");
            let (serial, _) = read_toml(&text.replace("\"q3\"", "\"q3 - q2\"")).expect("a table");
            assert!(prove_same_chain(&chain.description, &serial).is_equal());
        }
    }
}
