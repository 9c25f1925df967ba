//! Every configuration that generates a pose is found again, and sets of configurations are complete.
//!
//! `DENAVIT_SOAK=1` runs a million poses an arm.

use crate::arms::{
    Draws, apart, distance, named, newton, perturbed, puma560, random, reversed, sliding, solve, ur10e,
};
use denavit_elimination::{Answer, Arm, Certificate, Isa, Plan};

fn soak() -> bool {
    std::env::var_os("DENAVIT_SOAK").is_some()
}

/// Solves poses of random configurations: how many of these are not among the solutions, although the pose is not a
/// singular one. Each solution must reach the pose.
fn missed(arm: &Arm, count: usize, seed: u64) -> usize {
    let plan = Plan::new(arm).unwrap();
    let (mut draws, mut answer) = (Draws(seed), Answer::default());
    let mut missed = 0;
    for _ in 0..count {
        let q = draws.configuration(arm);
        let pose = arm.pose(&q);
        solve(&plan, &pose, &mut answer);
        for solution in &answer.solutions {
            assert!(solution.residual <= 1e-10);
            assert!(distance(arm, &arm.pose(&solution.q), &pose) <= 2e-10, "{solution:?}");
        }
        let known = answer.solutions.iter().any(|solution| apart(arm, &solution.q, &q) < 1e-5);
        if !known && arm.smallest_singular_value(&q) > 1e-6 {
            missed += 1;
        }
    }
    missed
}

#[test]
fn generating_configurations_are_found() {
    for (name, arm) in named() {
        assert_eq!(missed(&arm, if soak() { 1_000_000 } else { 1500 }, 5), 0, "{name}");
    }
}

/// Other instructions round otherwise, and find the same; `solve` takes the fastest ones.
#[test]
fn all_instructions_find_the_same() {
    let mut arms = named();
    arms.extend([("one slide", sliding(&[2], 5)), ("two slides", sliding(&[1, 3], 6))]);
    for (name, arm) in arms {
        let plan = Plan::new(&arm).unwrap();
        let (mut draws, mut expected, mut found) = (Draws(21), Answer::default(), Answer::default());
        for _ in 0..100 {
            let pose = arm.pose(&draws.configuration(&arm));
            plan.solve(&pose, &mut expected);
            for isa in Isa::available() {
                plan.solve_on(isa, &pose, &mut found);
                if isa == Isa::detect() {
                    assert_eq!(found.solutions, expected.solutions, "{name}, {isa:?}");
                }
                if [&expected, &found].iter().any(|answer| answer.certificate != Certificate::Complete) {
                    continue;
                }
                assert_eq!(found.solutions.len(), expected.solutions.len(), "{name}, {isa:?}");
                for one in &expected.solutions {
                    let is_known = found.solutions.iter().any(|other| apart(&arm, &one.q, &other.q) < 1e-5);
                    assert!(is_known, "{name}, {isa:?}: {one:?}");
                }
            }
        }
    }
}

#[test]
fn random_arms() {
    for seed in 0..40 {
        assert_eq!(
            missed(&random(100 + seed), if soak() { 20_000 } else { 150 }, seed + 1),
            0,
            "seed {seed}"
        );
    }
}

/// Twists that are multiples of 45° and 90°, and many lengths that vanish.
#[test]
fn arms_with_special_values() {
    let mut tried = 0;
    for seed in 0..60 {
        let mut draws = Draws(9000 + 17 * seed);
        let rows = std::array::from_fn(|_| {
            let mut length = || if draws.unit() < 0.5 { 0.0 } else { draws.between(-0.5, 0.5) };
            let (a, d) = (length(), length());
            let alpha = [0.0, 90.0, -90.0, 90.0, -90.0, 45.0][(draws.unit() * 6.0) as usize];
            [a, d, alpha, 0.0]
        });
        let arm = crate::arms::standard(rows);
        if Plan::new(&arm).is_ok() {
            tried += 1;
            assert_eq!(missed(&arm, if soak() { 20_000 } else { 100 }, seed + 1), 0, "seed {seed} {rows:?}");
        }
    }
    assert!(tried > 10, "{tried}");
}

#[test]
fn slides() {
    let poses = if soak() { 20_000 } else { 150 };
    for first in 0..6 {
        assert_eq!(missed(&sliding(&[first], 200 + first as u64), poses, 3), 0, "1P {first}");
        for second in first + 1..6 {
            let arm = sliding(&[first, second], (300 + 10 * first + second) as u64);
            assert_eq!(missed(&arm, poses, 3), 0, "2P {first} {second}");
            for third in second + 1..6 {
                let arm = sliding(&[first, second, third], (400 + 10 * first + second) as u64);
                assert_eq!(missed(&arm, poses, 3), 0, "3P {first} {second} {third}");
            }
        }
    }
}

/// Arms with a closed form whose links are off by a little.
#[test]
fn nearly_special_arms() {
    let poses = if soak() { 100_000 } else { 400 };
    for (name, arm) in [("PUMA 560", puma560()), ("UR10e", ur10e())] {
        for amount in [1e-3, 1e-5, 1e-7, 1e-9] {
            assert_eq!(missed(&perturbed(arm.clone(), amount, 7), poses, 5), 0, "{name} off by {amount:e}");
        }
    }
}

/// The reversed arm has the same configurations at the inverse pose, in reverse; its equations are others. And Newton's
/// method from random starts finds nothing new.
#[test]
fn sets_agree_with_the_reversed_arm_and_with_newton() {
    for (name, arm) in named() {
        let other_arm = reversed(&arm);
        let (plan, other) = (Plan::new(&arm).unwrap(), Plan::new(&other_arm).unwrap());
        let (mut draws, mut answer, mut mirrored) = (Draws(21), Answer::default(), Answer::default());
        for turn in 0..if soak() { 10_000 } else { 300 } {
            let q = draws.configuration(&arm);
            let pose = arm.pose(&q);
            solve(&plan, &pose, &mut answer);
            solve(&other, &pose.inverse(), &mut mirrored);
            if [&answer, &mirrored].iter().all(|answer| answer.certificate == Certificate::Complete) {
                assert_eq!(answer.solutions.len(), mirrored.solutions.len(), "{name} {q:?}");
                for solution in &answer.solutions {
                    let mut back = solution.q;
                    back.reverse();
                    let away = mirrored.solutions.iter().map(|s| apart(&other_arm, &s.q, &back));
                    assert!(away.fold(9.0, f64::min) < 1e-5, "{name} {q:?}");
                }
            }
            if turn < 8 {
                for _ in 0..40 {
                    let start = draws.configuration(&arm);
                    let Some(found) = newton(&arm, &pose, start) else { continue };
                    let near = answer.solutions.iter().map(|s| apart(&arm, &s.q, &found)).fold(9.0, f64::min);
                    assert!(
                        near < 1e-4 || arm.smallest_singular_value(&found) < 1e-5,
                        "{name} {found:?}: {near}"
                    );
                }
            }
        }
    }
}
