//! Generated inverse kinematics beside the library's: the same solutions and families, with a status that says no more than
//! is so, at regular, singular, nearly singular and rounded poses.

use crate::common::{Random, robot, share};
use crate::general::ONE_SLIDE;
use crate::packages;
use denavit::description::read_toml;
use denavit::geometry::Transform;
use denavit::inverse::{Answer, Goal, InverseKinematics, InverseOptions, Solution};
use denavit::space::JointSpace;
use denavit::{Description, Robot};
use denavit_emit::Language;
use denavit_generate::{Inverse, PackageOptions, Wanted, generate};
use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Arms of different structure.
const ARMS: [&str; 12] = [
    "planar-3r",
    "scara",
    "articulated-3r",
    "stanford",
    "puma560",
    "staubli-rx90",
    "ur5",
    "techman-tm5-700",
    "kuka-kr16-2",
    "gantry-wrist",
    "franka-panda",
    "fanuc-crx10ia-l",
];

const SOLVED: u32 = 0;
const NO_SOLUTION: u32 = 1;
const FAMILY: u32 = 2;
const UNDECIDED: u32 = 3;

/// Reads poses with the values of given joints, a line each; writes status, count, and for each solution its dimension and joints.
const DRIVER: &str = r#"
#include "arm.h"
#include <stdio.h>
#include <stdlib.h>
int main(void) {
    double pose[4][4] = {{0.0}};
    double given[8] = {0.0};
    char text[64];
    (void)given;
    for (int k = 0; scanf("%63s", text) == 1; k = (k + 1) % @width@) {
        if (k < 12) {
            pose[k / 4][k % 4] = strtod(text, NULL);
        } else {
            given[k - 12] = strtod(text, NULL);
        }
        if (k == @width@ - 1) {
            arm_ik_result result;
            const arm_ik_status status = arm_ik(pose, @given@&result);
            printf("%d %d", (int)status, result.count);
            for (int s = 0; s < result.count; s++) {
                printf(" %d", result.solutions[s].dimension);
                for (int j = 0; j < @n@; j++) {
                    printf(" %.17g", result.solutions[s].q[j]);
                }
            }
            printf("\n");
        }
    }
    return 0;
}
"#;

/// The same in another language: what its program is called with, ahead of the file that runs.
struct Twin {
    language: Language,
    /// What rustc is called with ahead of it.
    build: &'static [&'static [&'static str]],
    command: &'static [&'static str],
    file: &'static str,
    driver: &'static str,
}

const PYTHON: Twin = Twin {
    language: Language::Python,
    build: &[],
    command: &["-B", "-W", "error"],
    file: "driver.py",
    driver: "
import sys
import arm
for line in sys.stdin:
    numbers = [float(x) for x in line.split()]
    pose, given = [numbers[k : k + 4] for k in (0, 4, 8)], numbers[12:]
    result = arm.ik(pose@given@)
    answer = [int(result.status), len(result.solutions)]
    for s in result.solutions:
        answer += [s.dimension, *s.q.tolist()]
    print(*answer)
",
};

const RUST: Twin = Twin {
    language: Language::Rust,
    build: &[
        &["--crate-type", "lib", "--crate-name", "arm", "--cfg", "feature=\"std\"", "src/lib.rs"],
        &["driver.rs", "--extern", "arm=libarm.rlib"],
    ],
    command: &[],
    file: "driver.rs",
    driver: r#"
use arm::*;
fn main() {
    for line in std::io::stdin().lines() {
        let line = line.unwrap();
        let numbers: Vec<f64> = line.split_whitespace().map(|x| x.parse().unwrap()).collect();
        let mut pose = [[0.0; 4]; 4];
        (0..12).for_each(|k| pose[k / 4][k % 4] = numbers[k]);
        let given: [f64; @given_count@] = std::array::from_fn(|k| numbers[12 + k]);
        let _ = given;
        let result = ik(&pose@given@);
        print!("{} {}", result.status as u32, result.solutions().len());
        for s in result.solutions() {
            print!(" {}", s.dimension);
            s.q.iter().for_each(|x| print!(" {x:e}"));
        }
        println!();
    }
}
"#,
};

const JAVASCRIPT: Twin = Twin {
    language: Language::JavaScript,
    build: &[],
    command: &[],
    file: "driver.mjs",
    driver: r#"
import { readFileSync } from "node:fs";
import { ik } from "./arm.js";
const words = ["solved", "no solution", "family", "undecided", "not a rotation", "not finite"];
for (const line of readFileSync(0, "utf8").trim().split("\n")) {
  const numbers = line.trim().split(" ").map(Number);
  const given = numbers.slice(12);
  const result = ik(numbers.slice(0, 12)@given@);
  const solutions = result.solutions.flatMap((s) => [s.dimension, ...s.q]);
  console.log([words.indexOf(result.status), result.solutions.length, ...solutions].join(" "));
}
"#,
};

const OCTAVE: Twin = Twin {
    language: Language::Matlab,
    build: &[],
    command: &["--no-gui", "--quiet"],
    file: "driver.m",
    driver: r"
words = {'solved', 'no solution', 'family', 'undecided', 'not a rotation', 'not finite'};
while ischar(line = fgetl(stdin))
    numbers = sscanf(line, '%f').';
    given = numbers(13:end);
    result = arm_ik(reshape(numbers(1:12), 4, 3).'@given@);
    printf('%d %d', find(strcmp(words, result.status)) - 1, numel(result.solutions));
    for s = result.solutions.'
        printf(' %.17g', s.dimension, s.q);
    end
    printf('\n');
end
",
};

/// An arm whose functions were compiled.
struct Arm {
    name: &'static str,
    robot: Robot<f64>,
    space: JointSpace,
    solver: InverseKinematics,
    given: Vec<usize>,
    folder: PathBuf,
}

/// What the code answered.
struct Coded {
    status: u32,
    isolated: Vec<Vec<f64>>,
    members: Vec<Vec<f64>>,
}

impl Arm {
    /// Of a test, which has a folder of its own.
    fn new(test: &str, name: &'static str, d: &Description) -> Arm {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{test}-{name}"));
        let facts = written(d, Language::C, &folder);
        let robot = Robot::numeric(d).expect("parameters have values");
        let names: Vec<_> = d.variables().iter().map(|v| v.symbol).collect();
        let given: Vec<usize> =
            facts.given.iter().filter_map(|s| names.iter().position(|n| n == s)).collect();
        let driver = DRIVER
            .replace("@width@", &(12 + given.len()).to_string())
            .replace("@given@", if given.is_empty() { "" } else { "given, " })
            .replace("@n@", &robot.joints.to_string());
        fs::write(folder.join("driver.c"), driver).expect("it can be written");
        let flags = ["-O1", "-std=c99", "-ffp-contract=off", "arm.c", "driver.c", "-lm", "-o", "driver"];
        packages::run(Command::new("cc").args(flags).current_dir(&folder));
        let inverse = InverseOptions { goal: Goal::Pose, given: Some(given.clone()) };
        let solver = InverseKinematics::new(d, &inverse).expect("the arm can be solved");
        let space = JointSpace::new(d, &robot);
        Arm { name, robot, space, solver, given, folder }
    }

    /// What the code in C answers to poses with the values of given joints.
    fn coded(&self, poses: &[(Transform<f64>, Vec<f64>)]) -> Vec<Coded> {
        self.answered(&mut Command::new(self.folder.join("driver")), poses)
    }

    fn answered(&self, command: &mut Command, poses: &[(Transform<f64>, Vec<f64>)]) -> Vec<Coded> {
        let mut text = String::new();
        for (pose, given) in poses {
            let m = pose.matrix();
            (0..12).for_each(|k| write!(text, "{:e} ", m[k / 4][k % 4]).expect("text"));
            given.iter().for_each(|x| write!(text, "{x:e} ").expect("text"));
            text.push('\n');
        }
        let input = self.folder.join("poses");
        fs::write(&input, text).expect("it can be written");
        let input = fs::File::open(input).expect("it is there");
        let output = command.stdin(input).output().expect("it runs");
        assert!(output.status.success(), "{}: {}", self.name, String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8_lossy(&output.stdout);
        let all: Vec<Coded> = text.lines().map(|line| self.line(line)).collect();
        assert_eq!(all.len(), poses.len(), "{}: a line a pose", self.name);
        all
    }

    fn line(&self, line: &str) -> Coded {
        let numbers: Vec<f64> = line.split(' ').map(|x| x.parse().expect("a number")).collect();
        let (mut isolated, mut members) = (vec![], vec![]);
        for s in numbers[2..].chunks(self.robot.joints + 1) {
            if s[0] > 0.0 { members.push(s[1..].to_vec()) } else { isolated.push(s[1..].to_vec()) }
        }
        Coded { status: numbers[0] as u32, isolated, members }
    }

    /// How far the hand is from a pose, lengths by the arm's size.
    fn missed(&self, pose: &Transform<f64>, q: &[f64]) -> f64 {
        let (a, b) = (self.robot.pose(q).matrix(), pose.matrix());
        let size = |k: usize| if k % 4 == 3 { self.space.length() } else { 1.0 };
        (0..12).map(|k| (a[k / 4][k % 4] - b[k / 4][k % 4]).abs() / size(k)).fold(0.0, f64::max)
    }

    /// Whether two configurations are the same, or what lies between them has the pose, too: of roots that come together one
    /// knows where they are to the root of rounding.
    fn is_same(&self, pose: &Transform<f64>, a: &[f64], b: &[f64], off: f64) -> bool {
        let apart = self.space.distance(a, b);
        let way = self.space.moved(a, b);
        let between = |part: f64| a.iter().zip(&way).map(|(x, d)| x + part * d).collect::<Vec<f64>>();
        apart <= 1e-6 + 1e4 * off
            || apart <= 0.02
                && [0.25, 0.5, 0.75].iter().all(|&t| self.missed(pose, &between(t)) <= 1e-9 + off)
    }

    /// What differs between the two answers to a pose that is off by `off` from that of q.
    fn fault(
        &self,
        pose: &Transform<f64>,
        q: &[f64],
        off: f64,
        coded: &Coded,
        known: &Answer,
    ) -> Option<String> {
        let own = || coded.isolated.iter().chain(&coded.members);
        if let Some(s) = own().find(|s| self.missed(pose, s) > 1e-8 + 20.0 * off) {
            return Some(format!("{s:?} misses the pose by {:e}", self.missed(pose, s)));
        }
        // Nothing that the library knows is missing.
        let missing = known.solutions.iter().find(|s| {
            let is_regular = s.multiplicity == 1 && s.guard > 1e-3;
            // What was found by trying values, between solutions that nearly coincide, need be none.
            if s.guard == 0.0 && !known.is_complete() {
                return false;
            }
            let is_there = own().any(|t| self.is_same(pose, &s.q, t, off));
            !is_there && (is_regular || matches!(coded.status, SOLVED | NO_SOLUTION))
        });
        if let Some(s) = missing {
            return Some(format!("status {}: {:?} is missing (guard {:e})", coded.status, s.q, s.guard));
        }
        if matches!(coded.status, SOLVED | NO_SOLUTION) {
            // A rounded pose is another: where roots nearly coincide its solutions are elsewhere, or there are none.
            if off == 0.0 && !own().any(|t| self.is_same(pose, q, t, off)) {
                return Some(format!("status {}: its own configuration is missing", coded.status));
            }
            // Where the library cannot tell all solutions, what it takes for a family may be a curve along which the hand leaves
            // the pose slowly.
            if let (true, Some(f)) = (known.is_complete(), known.families.first()) {
                return Some(format!(
                    "status {}: there is a family through {:?}",
                    coded.status, f.representative.q
                ));
            }
        }
        // Nothing is there beyond what the library knows.
        if known.is_complete() {
            let extra = coded.isolated.iter().find(|s| {
                let is_known = known.solutions.iter().any(|t| self.is_same(pose, &t.q, s, off));
                let is_member = || self.solver.family_of(pose, known, s).is_some();
                // Beside a singular pose, what a copy misses the pose by may take it that far from the solution.
                let is_copy = |t: &Solution| {
                    let apart = self.space.distance(&t.q, s);
                    apart <= 0.02 && apart * t.guard <= 2.0 * self.missed(pose, s)
                };
                let is_copy = || coded.status == UNDECIDED && known.solutions.iter().any(is_copy);
                !is_known && !is_member() && !is_copy()
            });
            if let Some(s) = extra {
                return Some(format!("status {}: {s:?} is one more than the library knows", coded.status));
            }
        }
        if coded.status == FAMILY && known.families.is_empty() && known.is_complete() {
            return Some(format!("a family through {:?}, which the library does not know", coded.members[0]));
        }
        None
    }
}

/// Writes the functions into an empty folder.
fn written(d: &Description, language: Language, folder: &Path) -> Inverse {
    let options = PackageOptions { fixed: true, ..packages::options(language, &[Wanted::Inverse]) };
    let generated = generate(d, &options).expect("parameters have values");
    packages::write(folder, &generated.files);
    generated.inverse.unwrap_or_else(|| panic!("{:?}", generated.refused))
}

/// Regular configurations; with joints at multiples of a quarter turn; beside these.
fn configurations(arm: &Arm, counts: [usize; 3]) -> [Vec<Vec<f64>>; 3] {
    let mut random = Random(0x23);
    let angle = arm.space.is_angle.clone();
    let size = arm.space.length();
    let regular =
        |r: &mut Random, j: usize| if angle[j] { 6.2 * r.unit() - 3.1 } else { size * (0.1 + r.unit()) };
    let mut list = |count: usize, value: &mut dyn FnMut(&mut Random, usize) -> f64| -> Vec<Vec<f64>> {
        (0..count).map(|_| (0..angle.len()).map(|j| value(&mut random, j)).collect()).collect()
    };
    let quarter = |r: &mut Random| FRAC_PI_2 * (4.0 * r.unit()).floor() - FRAC_PI_2;
    let some = |r: &mut Random, j: usize, away: f64| {
        // Half of the joints at quarter turns, or all of them.
        if angle[j] && r.unit() < 0.7 { quarter(r) + away * (2.0 * r.unit() - 1.0) } else { regular(r, j) }
    };
    [
        list(counts[0], &mut |r, j| regular(r, j)),
        list(counts[1], &mut |r, j| some(r, j, 0.0)),
        list(counts[2], &mut |r, j| {
            let away = 10_f64.powf(-3.0 - 8.0 * r.unit());
            some(r, j, away)
        }),
    ]
}

fn check(name: &'static str) {
    let arm = Arm::new("conformance", name, &robot(name));
    let soak = [share(10_000, 100), share(2_000, 40), share(2_000, 40), share(1_000, 20)];
    let [regular, singular, beside] = configurations(&arm, [soak[0], soak[1], soak[2]]);
    let mut faults: Vec<String> = vec![];
    let mut table = vec![];
    let mut judge = |kind: &str, all: &[Vec<f64>], off: f64| {
        let unit = off.max(f64::MIN_POSITIVE);
        let round = |x: f64, by: f64| if off == 0.0 { x } else { (x / by / unit).round() * unit * by };
        let poses: Vec<(Transform<f64>, Vec<f64>)> = all
            .iter()
            .map(|q| {
                let m = arm.robot.pose(q).matrix();
                let length = arm.space.length();
                let r = std::array::from_fn(|i| std::array::from_fn(|j| round(m[i][j], 1.0)));
                let t = denavit::geometry::Vector(std::array::from_fn(|i| round(m[i][3], length)));
                let rotation = denavit::geometry::Rotation::from_rows(r);
                let given = arm.given.iter().map(|&j| q[j]).collect();
                (Transform::from_rotation_translation(rotation, t), given)
            })
            .collect();
        let coded = arm.coded(&poses);
        let mut statuses = [0_usize; 7];
        let mut known: Vec<Answer> = vec![];
        if arm.given.is_empty() {
            let poses: Vec<_> = poses.iter().map(|p| p.0).collect();
            known = arm.solver.solve_all(&poses, &[], NonZero::<usize>::MIN);
        } else {
            known.extend(poses.iter().map(|(pose, given)| arm.solver.solve(pose, given)));
        }
        let mut complete = 0;
        for (((q, (pose, _)), coded), known) in all.iter().zip(&poses).zip(&coded).zip(&known) {
            statuses[coded.status as usize] += 1;
            complete += usize::from(known.is_complete());
            faults.extend(arm.fault(pose, q, off, coded, known).map(|why| format!("{kind} {q:?}: {why}")));
        }
        table.push(format!("{kind}: {statuses:?}, library complete {complete} of {}", all.len()));
        statuses
    };
    let plain = judge("regular", &regular, 0.0);
    judge("singular", &singular, 0.0);
    judge("beside", &beside, 0.0);
    judge("rounded", &regular[..soak[3]], 1e-6);
    println!("{name}\n  {}", table.join("\n  "));
    assert!(
        faults.is_empty(),
        "{name}: {} faults\n{}",
        faults.len(),
        faults[..faults.len().min(20)].join("\n")
    );
    // A pose like any other is decided.
    assert!(plain[SOLVED as usize] * 100 >= 98 * regular.len(), "{name}: {plain:?}");
    assert_eq!(
        plain[NO_SOLUTION as usize]
            + plain[UNDECIDED as usize]
            + plain[SOLVED as usize]
            + plain[FAMILY as usize],
        regular.len()
    );
}

macro_rules! arms {
    ($($test:ident $number:literal)*) => {$(
        #[test]
        fn $test() {
            check(ARMS[$number]);
        }
    )*};
}

arms! {
    planar 0
    scara 1
    articulated 2
    stanford 3
    puma 4
    staubli 5
    ur5 6
    techman 7
    kuka 8
    gantry 9
    panda 10
    crx 11
}

/// Arms that other languages are held to C at.
const TWINS: [&str; 4] = ["planar-3r", "scara", "ur5", "franka-panda"];
/// The same where there is no closed form.
const ELIMINATED: [&str; 3] = ["fanuc-crx10ia-l", "oblique-6r", "one-slide"];
/// Poses of these, which are regular: what lies about singular ones may depend on rounding.
const REGULAR: [usize; 3] = [20, 0, 0];

/// An arm of the catalogue, or of a file of these tests.
fn arm(name: &str) -> Description {
    if name == "one-slide" { read_toml(ONE_SLIDE).expect("it can be read").0 } else { robot(name) }
}

/// Whether a program is there.
fn has(words: &[&str]) -> bool {
    Command::new(words[0]).args(&words[1..]).output().is_ok_and(|o| o.status.success())
}

/// The code in another language answers as that in C does: the same status, the same isolated solutions, and members of families
/// that have the pose. Of a family, which members come may depend on rounding.
fn agree(twin: &Twin, program: &str, arms: &[&'static str], counts: [usize; 3]) {
    for &name in arms {
        let d = arm(name);
        let arm = Arm::new(&format!("twin-{:?}", twin.language), name, &d);
        let folder = arm.folder.join("twin");
        written(&d, twin.language, &folder);
        let passed = match (arm.given.is_empty(), twin.language) {
            (true, _) => "",
            (false, Language::Rust) => ", &given",
            _ => ", given",
        };
        let driver =
            twin.driver.replace("@given@", passed).replace("@given_count@", &arm.given.len().to_string());
        fs::write(folder.join(twin.file), driver).expect("it can be written");
        for arguments in twin.build {
            let mut rustc = Command::new("rustc");
            let built = rustc
                .args(["-Copt-level=1", "--edition", "2024"])
                .args(*arguments)
                .current_dir(&folder)
                .output();
            let built = built.expect("rustc is there");
            assert!(built.status.success(), "{name}: {}", String::from_utf8_lossy(&built.stderr));
        }
        let all: Vec<Vec<f64>> = configurations(&arm, counts).concat();
        let given = |q: &[f64]| arm.given.iter().map(|&j| q[j]).collect();
        let poses: Vec<_> = all.iter().map(|q| (arm.robot.pose(q), given(q))).collect();
        let mut command = Command::new(program);
        let own = arm.answered(command.args(twin.command).arg(twin.file).current_dir(&folder), &poses);
        let same = |pose, a: &[Vec<f64>], b: &[Vec<f64>]| {
            a.len() == b.len() && a.iter().all(|s| b.iter().any(|t| arm.is_same(pose, s, t, 0.0)))
        };
        for (((pose, _), q), (a, b)) in poses.iter().zip(&all).zip(own.iter().zip(&arm.coded(&poses))) {
            assert_eq!(a.status, b.status, "{name} {q:?}");
            assert!(same(pose, &a.isolated, &b.isolated), "{name} {q:?}: {:?} {:?}", a.isolated, b.isolated);
            assert_eq!(a.members.is_empty(), b.members.is_empty(), "{name} {q:?}");
            assert!(a.members.iter().all(|s| arm.missed(pose, s) <= 1e-8), "{name} {q:?}: {:?}", a.members);
        }
    }
}

#[test]
fn rust_answers_as_c_does() {
    agree(&RUST, "./driver", &TWINS[1..], [200, 60, 40]);
    agree(&RUST, "./driver", &ELIMINATED[..1], REGULAR);
}

#[test]
fn python_answers_as_c_does() {
    let python = std::env::var("DENAVIT_PYTHON").unwrap_or("python3".into());
    if has(&[&python, "-c", "import numpy"]) {
        agree(&PYTHON, &python, &TWINS, [12, 8, 4]);
        agree(&PYTHON, &python, &ELIMINATED, REGULAR);
    }
}

#[test]
fn javascript_answers_as_c_does() {
    if has(&["node", "--version"]) {
        agree(&JAVASCRIPT, "node", &TWINS, [40, 30, 20]);
        // By elimination, rounding decides what of a family is found.
        agree(&JAVASCRIPT, "node", &ELIMINATED, [40, 0, 0]);
    }
}

#[test]
fn octave_answers_as_c_does() {
    if has(&["octave", "--version"]) {
        agree(&OCTAVE, "octave", &TWINS, [8, 3, 1]);
        agree(&OCTAVE, "octave", &ELIMINATED, REGULAR);
    }
}

/// What is known to be within the limits is found: of families, which narrow limits leave a part of, and of self-motions.
#[test]
fn the_nearest_is_within_the_limits() {
    for (name, straight, far, is_narrow) in [
        ("abb-irb120", 4, 0.05, 0),
        ("abb-irb120", 4, 0.05, 1),
        ("franka-panda", -1, 6.0, 0),
        ("franka-panda", -1, 0.05, 1),
    ] {
        let options = PackageOptions {
            fixed: true,
            ..packages::options(Language::C, &[Wanted::Pose, Wanted::Inverse])
        };
        let made = generate(&robot(name), &options).expect("parameters have values");
        let folder = packages::folder(&format!("limits-{name}-{is_narrow}"), &made.files);
        fs::write(folder.join("limits.c"), include_str!("limits.c")).expect("it can be written");
        let mut compile = Command::new("cc");
        compile.args(["-O1", "-std=c99", "-ffp-contract=off", "arm.c", "limits.c", "-lm", "-o", "limits"]);
        packages::run(
            compile.args(if straight < 0 { &["-DHAS_GIVEN"][..] } else { &[] }).current_dir(&folder),
        );
        let count = share(5_000, 200);
        let words = [straight.to_string(), far.to_string(), is_narrow.to_string(), count.to_string()];
        let text = packages::run(Command::new(folder.join("limits")).args(words));
        let numbers: Vec<usize> = text.split_whitespace().filter_map(|w| w.parse().ok()).collect();
        // Of all self-motions of an arm far away some lead to no limits: one in a thousand.
        let lost = if straight < 0 && far > 1.0 { count / 1000 } else { 0 };
        assert!(numbers[0] <= lost && numbers[1..] == [0, 0], "{name}: {text}");
    }
}
