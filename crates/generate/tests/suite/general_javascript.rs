//! Elimination in JavaScript: its own vectors, and random poses beside the library and C.

use denavit::geometry::Transform;
use denavit::inverse::general::GeneralSolver;
use denavit::space::JointSpace;
use denavit::{Description, Robot};
use denavit_emit::Language;
use denavit_generate::{Wanted, generate};
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::common::{Random, robot, share};
use crate::packages::{self, folder, run};

/// One prismatic joint among oblique axes.
const ONE_SLIDE: &str = include_str!("../robots/one-slide.toml");

/// Poses, a line each; writes whether all solutions are known, and them.
const JAVASCRIPT: &str = r#"
import { readFileSync } from "node:fs";
import { solve } from "./arm.js";
for (const line of readFileSync("poses", "utf8").trim().split("\n")) {
  const found = solve(line.trim().split(" ").map(Number));
  console.log([found.certificate === "complete" ? 1 : 0, ...found.flatMap((s) => s.q)].join(" "));
}
"#;

/// The same in C.
const C: &str = r#"
#include "arm.h"
#include <stdio.h>
int main(void) {
    double pose[12];
    FILE *file = fopen("poses", "r");
    for (int k = 0; file && fscanf(file, "%lf", &pose[k]) == 1; k = (k + 1) % 12) {
        if (k == 11) {
            arm_solve_solution found[ARM_SOLVE_MAX];
            arm_solve_certificate certificate;
            const int count = arm_solve(pose, found, &certificate);
            printf("%d", certificate == ARM_SOLVE_COMPLETE);
            for (int s = 0; s < count; s++) {
                for (int j = 0; j < 6; j++) {
                    printf(" %.17g", found[s].q[j]);
                }
            }
            printf("\n");
        }
    }
    return 0;
}
"#;

/// What is found at a pose, and whether that is all.
struct Found {
    is_all: bool,
    solutions: Vec<Vec<f64>>,
}

/// A folder with `fk` and `ik`.
fn written(name: &str, d: &Description, language: Language) -> PathBuf {
    let options = packages::options(language, &[Wanted::Pose, Wanted::Inverse]);
    let generated = generate(d, &options).expect("nothing is fixed");
    let inverse = generated.inverse.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", generated.refused));
    assert!(inverse.by_elimination && inverse.vectors >= 12, "{name}: {} poses", inverse.vectors);
    folder(&format!("elimination-{language:?}-{name}-random"), &generated.files)
}

fn read(text: &str) -> Vec<Found> {
    let line = |line: &str| {
        let numbers: Vec<f64> = line.split(' ').map(|x| x.parse().expect("a number")).collect();
        Found { is_all: numbers[0] == 1.0, solutions: numbers[1..].chunks(6).map(<[f64]>::to_vec).collect() }
    };
    text.lines().map(line).collect()
}

/// Nothing is missing, nothing is there that the library does not know, and all is known as often as in C.
fn check(name: &str, d: &Description) {
    if Command::new("node").arg("--version").output().is_err() {
        return;
    }
    let arm = Robot::numeric(d).expect("all values are known");
    let space = JointSpace::new(d, &arm);
    let solver = GeneralSolver::new(&arm, &space).expect("it has six axes");
    let mut random = Random(31);
    let poses: Vec<Transform<f64>> = (0..share(2000, 150))
        .map(|_| {
            let value = |(is_angle, x): (&bool, f64)| {
                if *is_angle { 6.2 * x - 3.1 } else { space.length() * (0.1 + x) }
            };
            let numbers: Vec<f64> = (0..6).map(|_| random.unit()).collect();
            let q: Vec<f64> = space.is_angle.iter().zip(numbers).map(value).collect();
            arm.pose(&q)
        })
        .collect();
    let mut text = String::new();
    for pose in &poses {
        let entries: Vec<String> = pose.matrix()[..3].concat().iter().map(|x| format!("{x:e}")).collect();
        let _ = writeln!(text, "{}", entries.join(" "));
    }

    let folder = written(name, d, Language::JavaScript);
    run(Command::new("node").arg("--test").current_dir(&folder));
    fs::write(folder.join("poses"), &text).expect("it can be written");
    fs::write(folder.join("random.mjs"), JAVASCRIPT).expect("it can be written");
    let own = read(&run(Command::new("node").arg("random.mjs").current_dir(&folder)));

    let folder = written(name, d, Language::C);
    fs::write(folder.join("poses"), &text).expect("it can be written");
    fs::write(folder.join("random.c"), C).expect("it can be written");
    let compiler = ["-O1", "-std=c99", "-ffp-contract=off", "arm.c", "random.c", "-lm", "-o", "random"];
    run(Command::new("cc").args(compiler).current_dir(&folder));
    let in_c = read(&run(Command::new("./random").current_dir(&folder)));

    assert_eq!([own.len(), in_c.len()], [poses.len(); 2], "{name}: a line a pose");
    let has = |all: &[Vec<f64>], q: &[f64]| all.iter().any(|s| space.distance(s, q) <= 1e-7);
    let mut certain = 0;
    for (pose, found) in poses.iter().zip(&own) {
        let known = solver.solve(pose);
        let clean: Vec<Vec<f64>> =
            known.solutions.iter().filter(|s| s.guard >= 1e-3).map(|s| s.q.clone()).collect();
        let all: Vec<Vec<f64>> = known.solutions.iter().map(|s| s.q.clone()).collect();
        if known.doubt.is_none() && known.families.is_empty() && clean.len() == all.len() {
            certain += 1;
            let missing = clean.iter().find(|q| !has(&found.solutions, q));
            assert!(missing.is_none(), "{name}: {missing:?} is missing");
            let extra = found.solutions.iter().find(|q| !has(&all, q));
            assert!(extra.is_none(), "{name}: {extra:?} is one more than the library knows");
        }
    }
    assert!(certain * 100 >= 95 * poses.len(), "{name}: the library is certain of {certain} poses");
    let count = |all: &[Found]| all.iter().filter(|found| found.is_all).count();
    assert!(count(&own) + poses.len() / 100 >= count(&in_c), "{name}: {} of {}", count(&own), count(&in_c));
    assert!(count(&own) * 100 >= 98 * poses.len(), "{name}: {} of {}", count(&own), poses.len());
}

#[test]
fn javascript_finds_what_the_library_finds() {
    check("crx", &robot("fanuc-crx10ia-l"));
    check("oblique", &robot("oblique-6r"));
    check("one-slide", &denavit::description::read_toml(ONE_SLIDE).expect("it can be read").0);
}
