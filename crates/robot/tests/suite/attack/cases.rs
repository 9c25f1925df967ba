//! Cases that an attack found once: the configuration that a pose was made from is among the answers.

use super::judge::{Fault, judge};
use super::poses::Asked;
use crate::common::{Random, case};
use denavit::description::read_toml;
use denavit::inverse::{Doubt, InverseKinematics, InverseOptions};
use std::f64::consts::{FRAC_PI_2, PI};

fn solver(name: &str) -> InverseKinematics {
    let mut description = case(name);
    description.rows.iter_mut().for_each(|r| r.limits = None);
    InverseKinematics::new(&description, &InverseOptions::default()).expect("a robot with numbers")
}

#[test]
fn what_was_missed_once_is_found() {
    let right = FRAC_PI_2;
    let six = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let cases: [(&str, &[f64]); 11] = [
        // Geared joints: their own periods, all copies in the window.
        ("co1", &[4.3, 0.5]),
        ("co2", &[0.3, 0.5]),
        ("co3", &[0.3, 0.2, 4.3, 0.4, 0.5, 0.6]),
        // Named lengths with negative values.
        ("min1", &[0.3, 0.5, 0.7]),
        ("neg33", &six),
        // A self-motion of an arm with three parallel axes.
        ("four", &[-right, PI, -right, -right, -right, PI]),
        // Five joints, a regular solution.
        ("five", &[PI, right, 0.0, PI, 0.0]),
        ("miss10l", &[0.0, -right, 0.0, PI, 1.0]),
        // No lengths, and a joint more than the rank.
        ("sph", &[0.1, 0.2, 0.3, 0.4]),
        // The same arm in other units.
        ("gen1e-06", &six),
        ("gen1e+09", &six),
    ];
    for (name, q) in cases {
        let fault = fault(name, q);
        assert!(matches!(fault, None | Some(Fault::Doubted)), "{name}: {fault:?}");
    }
}

/// What is wrong with the answer to the pose at a configuration.
fn fault(name: &str, q: &[f64]) -> Option<Fault> {
    let solver = solver(name);
    let asked = Asked { q: q.to_vec(), pose: solver.robot.pose(q), noise: 0.0, class: "a case" };
    let given: Vec<f64> = solver.given.iter().map(|&j| q[j]).collect();
    judge(&solver, &asked, &solver.solve(&asked.pose, &given), 200, &mut Random(1))
}

/// Where rounding takes a solution away, the answer is said to lack some.
#[test]
fn what_rounding_takes_away_leaves_a_doubt() {
    let right = FRAC_PI_2;
    let cases: [(&str, &[f64]); 6] = [
        // Beside a fourfold root: what follows is known to a few digits only, and one of its roots is lost in rounding.
        (
            "fourfold",
            &[-right - 6.4e-14, 1.6e-12, -0.7853981633982269, -7.9e-13, 4.6e-13, -0.04718954633843023],
        ),
        // A slide's two values meet at 0, where their coefficients are what rounding leaves.
        ("reach0", &[0.7853981624970426, -2.300000004117141, 6.4e-10, -0.785398164302577, -3.1e-11, 6.6e-10]),
        // Elimination beside a singular pose: a smallest singular value of 4e-4.
        ("beside", &[3.78e-16, 8.7e-16, right, -2e-16, -4.3e-16, 9.5e-16]),
        // Elimination of an arm with six axes that are nearly parallel: descents crawl everywhere.
        ("faint", &[-2.5676949628443184, right, PI, 0.0, right, 0.0]),
        // A micrometre that everything is divided by.
        ("tiny", &[right, -right, 1.742053175496288, 0.6746042711961113, right, -right]),
        (
            "tiny",
            &[
                1.7063645126897402,
                1.7124425084900023,
                -2.8301629253324316,
                -1.8259006689882349,
                -2.492263637343356,
                0.27039199022693516,
            ],
        ),
    ];
    for (name, q) in cases {
        let fault = fault(name, q);
        assert!(
            matches!(fault, None | Some(Fault::Doubted | Fault::Overlooked | Fault::Empty)),
            "{name}: {fault:?}"
        );
    }
}

/// All copies of geared joints in a window of a whole turn or more are listed.
#[test]
fn copies_of_geared_joints_are_listed() {
    for (name, q, count) in [("co1", [4.3, 0.5], 1), ("co2", [0.3, 0.5], 2)] {
        let solver = solver(name);
        let answer = solver.solve(&solver.robot.pose(&q), &[]);
        assert_eq!(answer.solutions.len(), count, "{name}: {answer:#?}");
        assert!(answer.is_complete());
    }
}

/// Gears that repeat a configuration more often than is listed leave a doubt, and so do copies of curves; what is asked to
/// be within the limits is.
#[test]
fn what_gears_leave_out_is_doubted() {
    let rows = |angles: [&str; 3]| {
        let row = |(theta, a): (&str, f64)| format!("[[joints]]\ntheta = \"{theta}\"\na = {a}\n");
        let first = row((angles[0], 0.3)) + "limits = [\"300 deg\", \"400 deg\"]\n";
        format!(
            "name = \"x\"\nconvention = \"craig\"\n{first}{}{}",
            row((angles[1], 0.2)),
            row((angles[2], 0.1))
        )
    };
    let of = |file: &str, q: &[f64]| {
        let d = read_toml(file).expect("a robot").0;
        let solver = InverseKinematics::new(&d, &InverseOptions::default()).expect("a solver");
        let pose = solver.robot.pose(q);
        (solver.solve(&pose, &[]), solver.one(&pose, &[], None), solver)
    };
    let (all, one, solver) = of(&rows(["300*q1", "q2", "q3"]), &[5.5, 0.4, 0.7]);
    assert_eq!(all.doubt, Some(Doubt::Copies));
    assert!(one.solutions[0].within_limits && solver.space.is_inside(&one.solutions[0].q), "{one:?}");
    let (all, one, solver) = of(&rows(["2*q1", "q2", "q3/2"]), &[5.5, 0.4, 0.7]);
    assert!(all.is_complete() && all.solutions.len() == 4, "{all:?}");
    assert!(one.solutions[0].within_limits && solver.space.is_inside(&one.solutions[0].q), "{one:?}");
    // A joint to spare: each curve holds its own sample.
    let four = rows(["2*q1", "q2", "q3"]) + "[[joints]]\ntheta = \"q4\"\na = 0.05\n";
    let (all, ..) = of(&four, &[0.1, 0.2, 0.3, 0.4]);
    assert!(!all.is_complete() && !all.families.is_empty());
    for family in &all.families {
        let [low, high] = family.interval.expect("an interval");
        assert_eq!(family.free, ["q1"]);
        assert!((low..=high).contains(&family.representative.q[0]), "{family:?}");
    }
}

/// Of coupled joints only such are given as determine axes.
#[test]
fn coupled_joints_to_spare() {
    let row = |alpha: &str, d: f64, theta: &str, r: &str| {
        format!("[[joints]]\nalpha = \"{alpha}\"\nd = {d}\ntheta = \"{theta}\"\nr = \"{r}\"\n")
    };
    let rows = row("-90 deg", -0.3, "0", "q1")
        + &row("180 deg", 0.15, "2*q2", "0")
        + &row("180 deg", 0.4, "q3 + q2", "0")
        + &row("0", 0.2, "q4 + q3", "0.15")
        + &row("180 deg", 0.1, "q5", "0")
        + &row("90 deg", 0.15, "2*q6", "0.2");
    let d = read_toml(&format!("name = \"x\"\nconvention = \"khalil\"\n{rows}")).expect("a robot").0;
    for given in [None, Some(vec![2]), Some(vec![1]), Some(vec![4])] {
        let options = InverseOptions { given: given.clone(), ..InverseOptions::default() };
        let solver = InverseKinematics::new(&d, &options).expect("an arm with numbers");
        let q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
        let pose = solver.robot.pose(&q);
        let values: Vec<f64> = solver.given.iter().map(|&j| q[j]).collect();
        let answer = solver.solve(&pose, &values);
        let found = solver.nearest(&pose, &answer, &q);
        assert!(found.is_some_and(|n| n.distance < 1e-6), "{given:?}: {answer:?}");
        for s in answer.solutions.iter().chain(answer.families.iter().map(|f| &f.representative)) {
            assert!(solver.given.iter().zip(&values).all(|(&j, x)| (s.q[j] - x).abs() < 1e-9), "{s:?}");
            assert!(super::judge::miss(&solver.robot, &pose, &s.q) < 1e-8, "{s:?}");
        }
    }
}

/// An arm far from the origin has the answers that it has at the origin, and says what it does not know; lengths that are
/// no numbers any more are refused.
#[test]
fn far_from_the_origin() {
    let arm = |height: f64, length: f64| {
        let row = |theta: &str, d: f64, a: f64, alpha: &str| {
            let (d, a) = (d * length, a * length);
            format!("[[joints]]\ntheta = \"{theta}\"\nd = {d:?}\na = {a:?}\nalpha = \"{alpha}\"\n")
        };
        let rows = row("q1", height, 0.0, "pi/2")
            + &row("q2", 0.0, 0.5, "0")
            + &row("q2 + q3", 0.0, 0.0, "pi/2")
            + &row("q4/2", -0.3, 0.0, "-pi/2")
            + &row("-q5", 0.0, 0.0, "pi/2")
            + &row("q6 - q5", 0.0, 0.0, "0");
        read_toml(&format!("name = \"x\"\nconvention = \"standard\"\n{rows}")).expect("a robot").0
    };
    let solver = |d| InverseKinematics::new(&d, &InverseOptions::default());
    let q = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8];
    for (height, is_complete) in [(0.4, true), (1e3, true), (1e6, false), (1e9, false)] {
        let solver = solver(arm(height, 1.0)).expect("a solver");
        let answer = solver.solve(&solver.robot.pose(&q), &[]);
        assert_eq!((answer.solutions.len(), answer.families.len()), (8, 0), "{height}");
        assert_eq!(answer.is_complete(), is_complete, "{height}");
        assert!(answer.solutions.iter().any(|s| solver.space.distance(&s.q, &q) < 1e-15 * height + 1e-9));
    }
    for (length, is_computed) in [(1e-20, true), (1e20, true), (1e-50, false), (1e150, false), (1e200, false)]
    {
        let made = solver(arm(0.4, length));
        assert_eq!(made.is_ok(), is_computed, "{length}");
        if let Ok(solver) = made {
            let answer = solver.solve(&solver.robot.pose(&q), &[]);
            assert!(answer.is_complete() && answer.solutions.len() == 8, "{length}: {answer:?}");
        }
    }
}

/// A table in micrometres or in gigametres has the same answers.
#[test]
fn units_do_not_matter() {
    let q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let [small, large] = ["gen1e-06", "gen1e+09"].map(|name| {
        let solver = solver(name);
        let answer = solver.solve(&solver.robot.pose(&q), &[]);
        assert!(answer.is_complete(), "{name}");
        answer.solutions.into_iter().map(|s| s.q).collect::<Vec<_>>()
    });
    assert_eq!(small.len(), large.len());
    for (a, b) in small.iter().flatten().zip(large.iter().flatten()) {
        assert!((a - b).abs() < 1e-9, "{small:?} and {large:?}");
    }
}
