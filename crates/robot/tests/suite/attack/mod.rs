//! A permanent attack: arms and poses at random, judged by the forward model and by brute force.

pub mod arms;
mod cases;
pub mod judge;
pub mod poses;

use crate::common::{Random, share};
use arms::Kind;
use denavit::description::read_toml;
use denavit::inverse::{Answer, InverseKinematics, InverseOptions};
use denavit::symbolic::scoped;
use judge::Fault;
use std::collections::BTreeMap;

/// Poses an arm; fewer where each answer is curves that are followed.
const POSES: usize = 40;
const CURVES: usize = 5;
/// Starts of Newton's method for a pose.
const STARTS: usize = 12;

/// What an arm brought to light.
#[derive(Default)]
struct Found {
    method: &'static str,
    /// How many poses of each class.
    asked: BTreeMap<&'static str, usize>,
    /// What was wrong, for a pose of which class, made from which configuration.
    faults: Vec<(Fault, &'static str, String)>,
}

/// Attacks one arm.
fn attack(seed: u64, kind: Kind) -> Found {
    let mut random = Random(seed);
    let text = arms::text(&mut random, kind);
    let Ok((mut description, _)) = read_toml(&text) else { panic!("a robot file is refused:\n{text}") };
    // The nearest of an answer is one within the limits, if one is; here it says whether a configuration is there at all.
    description.rows.iter_mut().for_each(|r| r.limits = None);
    let solver = InverseKinematics::new(&description, &InverseOptions::default())
        .unwrap_or_else(|why| panic!("an arm with numbers is refused, {why}:\n{text}"));
    let mut found = Found { method: solver.method(), ..Found::default() };
    let is_shown = std::env::var_os("DENAVIT_ATTACK_SHOW").is_some();
    for _ in 0..if solver.method() == "self-motion" { CURVES } else { POSES } {
        let asked = poses::asked(&mut random, &solver.robot, &solver.space);
        let given: Vec<f64> = solver.given.iter().map(|&j| asked.q[j]).collect();
        if is_shown {
            eprintln!("asked {:?}", asked.q);
        }
        let answer = solver.solve(&asked.pose, &given);
        *found.asked.entry(asked.class).or_default() += 1;
        let starts = if given.is_empty() { STARTS } else { 0 };
        if let Some(fault) = judge::judge(&solver, &asked, &answer, starts, &mut random) {
            if fault.is_lie() && is_shown {
                shown(&solver, fault, &asked, &answer);
            }
            let why = answer.doubt.map_or(String::new(), |doubt| format!(" ({doubt:?})"));
            found.faults.push((fault, asked.class, format!("{:?}{why}", asked.q)));
        }
    }
    found
}

fn variable(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Attacks `arms` arms of each kind, and prints what came of it; the lies.
fn all(arms: usize) -> Vec<String> {
    let first = variable("DENAVIT_ATTACK_SEED").unwrap_or(1);
    let arms = variable("DENAVIT_ATTACK_ARMS").map_or(arms, |n| n as usize);
    let only = std::env::var("DENAVIT_ATTACK_KIND").ok();
    // Words of the faults that are printed: `Doubted regular`.
    let tell = std::env::var("DENAVIT_ATTACK_TELL").ok();
    let mut lies = vec![];
    for kind in Kind::ALL.into_iter().filter(|k| only.as_ref().is_none_or(|o| *o == format!("{k:?}"))) {
        let mut tally: BTreeMap<(&str, &str, Option<Fault>), usize> = BTreeMap::new();
        for seed in (first..).take(arms) {
            let seed = seed * 1000 + kind as u64;
            let found = scoped(|| attack(seed, kind));
            for (class, n) in found.asked {
                *tally.entry((found.method, class, None)).or_default() += n;
            }
            for (fault, class, q) in found.faults {
                *tally.entry((found.method, class, Some(fault))).or_default() += 1;
                let told = format!("{kind:?} {seed} ({}): {fault:?} {class} at {q}", found.method);
                if tell.as_ref().is_some_and(|words| words.split(' ').all(|w| told.contains(w))) {
                    println!("{told}");
                }
                if fault.is_lie() {
                    lies.push(told);
                }
            }
        }
        println!("{kind:?}: {arms} arms");
        for ((method, class, fault), n) in tally {
            match fault {
                None => println!("  {method}: {n} poses {class}"),
                Some(fault) => println!("    {fault:?} {n}"),
            }
        }
    }
    lies
}

#[test]
fn nothing_is_said_that_is_not_so() {
    let lies = all(share(650, 6));
    assert!(lies.is_empty(), "{}:\n{}", lies.len(), lies.join("\n"));
}

/// Prints a lie.
fn shown(solver: &InverseKinematics, fault: Fault, asked: &poses::Asked, answer: &Answer) {
    let least = |q: &[f64]| judge::least_pivot(&solver.robot, q, &solver.space.is_angle);
    println!("{fault:?} at {:?}, singular value {:.1e}, noise {:.1e}", asked.q, least(&asked.q), asked.noise);
    for s in &answer.solutions {
        let missed = judge::miss(&solver.robot, &asked.pose, &s.q);
        let (times, seen) = (s.multiplicity, least(&s.q));
        println!(
            "  {times} × {:?} residual {:.1e}, really {missed:.1e}, guard {:.1e}, singular value {seen:.1e}",
            s.q, s.residual, s.guard
        );
    }
    for f in &answer.families {
        println!("  family of {:?}", f.representative.q);
    }
}

/// Prints an arm of the attack, and what is said of it that is not so: `DENAVIT_ATTACK_SHOW="Square 1000"`.
#[test]
#[ignore = "prints an arm"]
fn show() {
    let asked = std::env::var("DENAVIT_ATTACK_SHOW").unwrap_or_default();
    let mut words = asked.split_whitespace();
    let name = words.next().unwrap_or_default();
    let seed = words.next().and_then(|s| s.parse().ok()).unwrap_or(1000);
    for kind in Kind::ALL.into_iter().filter(|k| format!("{k:?}") == name) {
        println!("{}", arms::text(&mut Random(seed), kind));
        scoped(|| attack(seed, kind));
    }
}
