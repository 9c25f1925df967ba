//! The study: slips of every kind, alone and in pairs, on a dozen arms, and recordings without any.

use crate::made::{Dice, KINDS, Made, NOMINAL, Noise, Setting, make, variant};
use denavit_recording::{Form, Held, HoldOptions, Slip, hold};
use std::collections::BTreeMap;

const ARMS: &[&str] = &[
    "ur5",
    "ur5e",
    "staubli-rx90",
    "puma560",
    "abb-irb120",
    "ufactory-xarm6",
    "franka-panda",
    "kuka-iiwa-7",
    "kinova-gen3",
    "stanford",
    "scara",
    "ur10",
];

/// A whole study takes long; a test run takes a part of it.
pub fn share(of: usize, usual: usize) -> usize {
    if std::env::var_os("DENAVIT_SOAK").is_some() { of } else { usual }
}

/// What a slip is called in the study.
fn name(slip: &Slip) -> String {
    match slip {
        Slip::Degrees => "deg".into(),
        Slip::Radians => "rad".into(),
        Slip::Hundred => "hundred".into(),
        Slip::Dropped(c) => format!("drop {c}"),
        Slip::Reversed => "reverse".into(),
        Slip::Swap(i, j) => format!("swap {i} {j}"),
        Slip::Flip(i) => format!("flip {i}"),
        Slip::Quarter(i, _) | Slip::Zero(i, _) => format!("zero {i}"),
        Slip::Couple(i, _) | Slip::CoupleBy(i, _) => format!("couple {i}"),
        Slip::DegreesOne(i) => format!("deg {i}"),
        Slip::Gain(i, _) | Slip::GainBy(i, _) => format!("gain {i}"),
        Slip::Inverse => "inverse".into(),
        Slip::Transposed => "transposed".into(),
        Slip::Unit(k) => format!("unit {k}"),
        Slip::LeftHanded(_) => "mirror".into(),
        Slip::OtherArm(a) => format!("arm {a}"),
        Slip::Base(_) => "base".into(),
        Slip::Tool(_) => "tool".into(),
        Slip::Lag(_) => "lag".into(),
        Slip::Length(l) => format!("length {} {}", l.constant, l.axis),
        Slip::Jump(c, ..) => format!("jump {c}"),
        Slip::Stuck(s) => format!("stuck {}", s.joint),
        Slip::Spikes(_) => "spikes".into(),
        Slip::Missing(_) => "missing".into(),
        Slip::TimeBack(_) => "back".into(),
        Slip::Apart(..) => "apart".into(),
        Slip::Gaps(_) => "gaps".into(),
        Slip::Unlike(u) => format!("unlike {}", u.joint),
        Slip::NotUnderstood => "not understood".into(),
    }
}

fn names(slips: &[&Slip], form: Form, degrees: bool) -> Vec<String> {
    let mut all: Vec<String> = slips.iter().map(|s| name(s)).collect();
    all.push(format!("format {form}{}", if degrees { " deg" } else { "" }));
    all.sort();
    all.dedup();
    all
}

/// The zero of the first joint is the base, that of the last the tool.
fn canonical(names: &[String], joints: usize) -> Vec<String> {
    let one = |n: &String| match n.strip_prefix("zero ").and_then(|i| i.parse::<usize>().ok()) {
        Some(0) => "base".into(),
        Some(i) if i + 1 == joints => "tool".into(),
        _ => n.clone(),
    };
    let mut all: Vec<String> = names.iter().map(one).collect();
    all.sort();
    all.dedup();
    all
}

/// exact, same (the same function), tie (among the rivals), other (the residual is noise), lost (not understood), wrong.
fn grade(made: &Made, held: &Held, joints: usize) -> (&'static str, Vec<String>) {
    // A jump is told by its column; the truth by its joint.
    let joint = |c: usize| held.recipe.joints.iter().position(|j| j.column == format!("c{c}")).unwrap_or(c);
    let by_joint = |s: &Slip| match *s {
        Slip::Jump(c, r, n, turn) => Slip::Jump(joint(c), r, n, turn),
        ref other => other.clone(),
    };
    let slips: Vec<Slip> = held.findings.iter().map(|f| by_joint(&f.slip)).collect();
    let slips: Vec<&Slip> = slips.iter().collect();
    let format = held.recipe.format;
    let found = names(&slips, format.form, format.degrees);
    let truth = canonical(&made.truth, joints);
    let in_columns = |s: &&Slip| matches!(s, Slip::Jump(..) | Slip::Stuck(_) | Slip::Spikes(_));
    let is_rival = held.rivals.iter().any(|r| {
        let slips: Vec<&Slip> = r.slips.iter().chain(slips.iter().copied().filter(in_columns)).collect();
        canonical(&names(&slips, r.format.form, r.format.degrees), joints) == truth
    });
    let grade = match () {
        () if found == made.truth => "exact",
        () if canonical(&found, joints) == truth => "same",
        () if is_rival => "tie",
        () if held.rho < 1.6 => "other",
        () if !held.is_understood => "lost",
        () => "WRONG",
    };
    (grade, found)
}

/// Runs cases, prints what is not named, and counts the grades.
fn run(cases: &[(&str, Vec<&str>, u64, Setting)]) -> BTreeMap<&'static str, usize> {
    let mut tally = BTreeMap::new();
    for (arm, slips, seed, setting) in cases {
        let made = make(arm, slips, *seed, setting);
        let own = crate::made::arm(arm);
        let held = hold(&own, &made.recording, &made.roles, &HoldOptions::default()).expect("it can be held");
        let (grade, found) = grade(&made, &held, own.joints());
        *tally.entry(grade).or_insert(0) += 1;
        if !["exact", "same", "tie"].contains(&grade) {
            println!(
                "{grade}: {arm} {slips:?} {seed} rho {:.2}: is {:?}, found {found:?}",
                held.rho, made.truth
            );
        }
    }
    println!("{tally:?}");
    tally
}

fn named(tally: &BTreeMap<&'static str, usize>) -> f64 {
    let all: usize = tally.values().sum();
    let right: usize = ["exact", "same", "tie"].iter().filter_map(|g| tally.get(g)).sum();
    right as f64 / all as f64
}

fn applies(arm: &str, kind: &str) -> bool {
    kind != "variant" || variant(arm).is_some()
}

#[test]
fn single_slips_are_named() {
    let mut cases = vec![];
    for round in 0..share(6, 1) as u64 {
        for (a, arm) in ARMS.iter().enumerate() {
            for (k, kind) in KINDS.iter().enumerate() {
                // A test run takes one arm in so many for each kind.
                if applies(arm, kind) && (share(1, 0) == 1 || (a + k) % 6 == 0) {
                    cases.push((*arm, vec![*kind], 7919 * (round + 1) + 31 * k as u64 + a as u64, NOMINAL));
                }
            }
        }
    }
    let tally = run(&cases);
    assert!(named(&tally) >= 0.98, "{tally:?}");
    assert_eq!(tally.get("WRONG"), None);
}

/// Whether two kinds cannot be told apart by their own words, or are put into the same columns.
fn clash(a: &str, b: &str) -> bool {
    let group = |k: &'static str| match k {
        "rotvec" | "euler" | "wxyz" | "xyzw" | "6drows" | "euler-deg" => "format",
        "all-deg" | "norm100" | "one-deg" => "unit",
        "inverse" | "transposed" => "direction",
        "base90" | "base" => "base",
        "tool-z" | "tool" => "tool",
        "zero90" | "zero180" | "zerofit" => "zero",
        other => other,
    };
    let known = |k: &str| KINDS.iter().copied().find(|x| *x == k).expect("a kind");
    let (a, b) = (known(a), known(b));
    let pair = |x: &str, y: &str| (a, b) == (x, y) || (b, a) == (x, y);
    group(a) == group(b) || pair("length", "variant") || pair("mirror", "transposed")
}

#[test]
fn pairs_of_slips_are_named() {
    let mut dice = Dice::new(77);
    let mut cases = vec![];
    while cases.len() < share(600, 24) {
        let arm = dice.one_of(ARMS);
        let (a, b) = (dice.one_of(KINDS), dice.one_of(KINDS));
        if !clash(a, b) && applies(arm, a) && applies(arm, b) {
            cases.push((arm, vec![a, b], 90_000 + cases.len() as u64, NOMINAL));
        }
    }
    let tally = run(&cases);
    assert!(named(&tally) >= 0.95, "{tally:?}");
}

#[test]
fn clean_recordings_are_clean() {
    let noises = [
        Noise(0.1e-3, 0.05, 0.005),
        Noise(0.3e-3, 0.1, 0.01),
        Noise(1e-3, 0.2, 0.03),
        Noise(2e-3, 0.5, 0.1),
        Noise(5e-3, 1.5, 0.3),
    ];
    let mut settings: Vec<Setting> = noises.iter().map(|n| Setting { noise: *n, ..NOMINAL }).collect();
    settings.push(Setting { rows: 150, ..NOMINAL });
    settings.push(Setting { motion: 0.15, ..NOMINAL });
    settings.push(Setting { calibration: (0.5e-3, 0.1), ..NOMINAL });
    let mut cases = vec![];
    for round in 0..share(5, 1) as u64 {
        for (a, arm) in ARMS.iter().enumerate() {
            for (s, setting) in settings.iter().enumerate() {
                if share(1, 0) == 1 || (a + s) % 3 == 0 {
                    cases.push((*arm, vec![], 101 * round + 17 * s as u64 + a as u64, *setting));
                }
            }
        }
    }
    let tally = run(&cases);
    let alarms: usize =
        tally.iter().filter(|(g, _)| !["exact", "same", "tie"].contains(*g)).map(|g| g.1).sum();
    assert_eq!(alarms, 0, "{tally:?}");
}

/// A hand that is elsewhere in a part of the rows is said to be, wherever these stand.
#[test]
fn rows_in_which_the_hand_is_elsewhere_are_said() {
    for (k, from) in [(0, 0), (1, 300), (2, 720)] {
        let mut made = make("ur5", &[], 400 + k, &NOMINAL);
        let z = made.roles.position[2];
        made.recording.columns[z].values[from..from + 180].iter_mut().for_each(|x| *x += 0.1);
        let arm = crate::made::arm("ur5");
        let held = hold(&arm, &made.recording, &made.roles, &HoldOptions::default()).expect("read");
        let rows = held.findings.iter().find_map(|f| match &f.slip {
            Slip::Apart(rows, _) => Some(rows.clone()),
            _ => None,
        });
        let rows = rows.unwrap_or_else(|| panic!("{:?}", held.findings));
        assert!(rows.len() > 100 && rows.iter().all(|r| (from..from + 180).contains(r)), "{rows:?}");
    }
}
