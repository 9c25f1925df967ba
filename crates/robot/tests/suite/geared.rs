//! Arms of six joints that move seven axes or more: one joint drives several of them.

use crate::attack::arms::one_of;
use crate::attack::judge::{self, Fault};
use crate::attack::poses;
use crate::common::{Random, share};
use denavit::description::read_toml;
use denavit::inverse::{InverseKinematics, InverseOptions};
use denavit::structure::Structure;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Where the driven axes stand, and how often they turn.
const GEARS: [&[(usize, &str)]; 10] = [
    &[(5, "q5"), (6, "-q5")],
    &[(4, "q4"), (5, "q4")],
    &[(5, "q5"), (6, "-q5/2")],
    &[(4, "q4"), (6, "-q4")],
    &[(2, "q2"), (3, "-2*q2")],
    &[(1, "q1"), (2, "q1")],
    &[(3, "q3"), (6, "q3")],
    &[(6, "q6/2"), (7, "-q6/2")],
    &[(5, "q5 + q4"), (6, "-q5 - q4")],
    &[(4, "q4"), (5, "-q4"), (6, "q4")],
];

/// A robot file; of square arms all twists but a few are quarter turns, and lengths are often 0.
fn text(random: &mut Random, gears: &[(usize, &str)], is_square: bool) -> String {
    let mut text = "name = \"geared\"\nconvention = \"craig\"\n".to_string();
    let mut joint = 0;
    for row in 1..=5 + gears.len() {
        let gear = gears.iter().position(|g| g.0 == row);
        // The first of the driven axes brings the variable.
        joint += usize::from(gear.is_none_or(|k| k == 0));
        let theta = gear.map_or(format!("q{joint}"), |k| gears[k].1.to_string());
        let twist = ["0", "90 deg", "-90 deg", "90 deg", "-90 deg", "35 deg", "-70 deg"];
        let [alpha, a, d] = if is_square {
            let mut nice = || one_of(random, &["0", "0", "0.1", "0.3", "-0.25"]).to_string();
            let lengths = [nice(), nice()];
            let [a, d] = lengths;
            [one_of(random, &twist).to_string(), a, d]
        } else {
            let mut number = |most: f64| format!("{:.4}", most * (2.0 * random.unit() - 1.0));
            [number(3.0), number(0.5), number(0.5)]
        };
        let _ =
            writeln!(text, "[[joints]]\nalpha = \"{alpha}\"\na = \"{a}\"\nd = \"{d}\"\ntheta = \"{theta}\"");
    }
    text
}

/// Judged by Newton's method from many starts: `complete` is never said of what is not, and of regular poses nearly always.
#[test]
fn geared_arms_are_solved() {
    let mut tally: BTreeMap<String, usize> = BTreeMap::new();
    let (mut lies, mut regular, mut complete) = (vec![], 0, 0);
    for seed in 0..share(60, 1) as u64 {
        for (k, gears) in GEARS.iter().enumerate() {
            for is_square in [true, false] {
                let mut random = Random(1 + seed * 1000 + k as u64);
                let text = text(&mut random, gears, is_square);
                let (description, _) = read_toml(&text).unwrap_or_else(|e| panic!("{e:?}\n{text}"));
                let solver =
                    InverseKinematics::new(&description, &InverseOptions::default()).expect("numbers");
                assert!(is_square || solver.method() == "elimination", "{}:\n{text}", solver.method());
                for _ in 0..8 {
                    let asked = poses::asked(&mut random, &solver.robot, &solver.space);
                    let answer = solver.solve(&asked.pose, &[]);
                    let fault = judge::judge(&solver, &asked, &answer, 40, &mut random);
                    let word = fault.map_or("complete".to_string(), |f| format!("{f:?} {:?}", answer.doubt));
                    let arm = if is_square { "square" } else { "any" };
                    let name = format!("{arm} {}: {} {word}", solver.method(), asked.class);
                    *tally.entry(name).or_default() += 1;
                    let counts = usize::from(!is_square && asked.class == "regular");
                    regular += counts;
                    complete += counts * usize::from(answer.is_complete());
                    if fault.is_some_and(Fault::is_lie) {
                        lies.push(format!("{fault:?} at {:?}:\n{text}", asked.q));
                    }
                }
            }
        }
    }
    tally.iter().for_each(|(name, n)| println!("{n:5} {name}"));
    assert!(lies.is_empty(), "{}: {}", lies.len(), lies.join("\n"));
    assert!(100 * complete >= 97 * regular, "{complete} of {regular} regular poses are complete");
}

/// What lies between two axes is special only if it is so wherever the joints are that a row between them follows.
#[test]
fn axes_behind_coupled_rows_are_special_for_all_values() {
    let of = |rows: &str| {
        let text =
            format!("convention = \"standard\"\n{}", rows.replace("| ", "[[joints]]\n").replace("; ", "\n"));
        Structure::of(&read_toml(&text).unwrap().0)
    };
    // Between the first axis and the next one of its own lies a turn by twice the first one's value.
    let turned = of(
        "| theta = \"q1\"; a = 0.2; alpha = \"-90 deg\"\n| theta = \"2*q1\"; a = 0.3; alpha = \"90 deg\"\n\
         | theta = \"q2\"; a = 0.3\n| theta = \"q3\"; a = 0.1\n",
    );
    assert_eq!(turned.parallel, [vec![2, 3]]);
    // Between them lies a slide: the third axis stands that far from where the others meet.
    let slides = of(
        "| theta = \"q1\"; alpha = \"90 deg\"\n| d = \"q1\"\n| theta = \"q2\"; alpha = \"90 deg\"\n| theta = \"q3\"\n",
    );
    assert!(slides.spherical.is_empty(), "{:?}", slides.spherical);
    // A turn about the axis itself, and one about a parallel axis, leave what is special as it is.
    let about = of(
        "| theta = \"q1\"; a = 0.2\n| theta = \"-q1\"; a = 0.3\n| theta = \"q2\"; a = 0.3\n| theta = \"q3\"; alpha = \"90 deg\"\n\
         | theta = \"q4\"; alpha = \"-90 deg\"\n| theta = \"q5\"\n",
    );
    assert_eq!((about.parallel, about.spherical), (vec![vec![1, 2, 3]], vec![3]));
}
