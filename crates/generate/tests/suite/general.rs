//! Generated inverse kinematics by elimination: built, and run on its own vectors.

use denavit::description::{JointKind, read_toml};
use denavit::geometry::{Rotation, Transform};
use denavit::inverse::JointSpace;
use denavit::inverse::general::GeneralSolver;
use denavit::{Description, Robot, catalogue};
use denavit_emit::Language;
use denavit_generate::{Generated, PackageOptions, Wanted, generate};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::common::{Random, share};
use crate::packages::{self, folder, run};

/// Strict C, as C programmers who ship it have it.
const STRICT: &str = "-O2 -Wall -Wextra -Werror -pedantic -std=c99 -ffp-contract=off";
/// One prismatic joint among oblique axes.
pub const ONE_SLIDE: &str = include_str!("../robots/one-slide.toml");
/// Two of them.
const TWO_SLIDES: &str = include_str!("../robots/two-slides.toml");

fn generated(d: &Description, language: Language, functions: &[Wanted]) -> Generated {
    generated_as("arm", d, language, functions)
}

fn generated_as(name: &str, d: &Description, language: Language, functions: &[Wanted]) -> Generated {
    let options = PackageOptions { name: Some(name.into()), ..packages::options(language, functions) };
    generate(d, &options).expect("nothing is fixed")
}

fn catalogued(name: &str) -> Description {
    catalogue::robot(name).expect("the catalogue has it")
}

fn read(text: &str) -> Description {
    read_toml(text).expect("it can be read").0
}

/// Both functions and the inverse one alone, as C.
fn check_c(name: &str, d: &Description, least: usize) {
    for (suffix, functions) in [("both", &[Wanted::Pose, Wanted::Inverse][..]), ("alone", &[Wanted::Inverse])]
    {
        let found = generated(d, Language::C, functions);
        let inverse = found.inverse.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", found.refused));
        assert!(inverse.by_elimination && inverse.vectors >= least, "{name}: {} poses", inverse.vectors);
        let target = folder(&format!("elimination-c-{name}-{suffix}"), &found.files);
        run(Command::new("make").arg("test").arg(format!("CFLAGS={STRICT}")).current_dir(target));
    }
}

/// A pose, and all configurations that have it.
struct Known {
    pose: Transform<f64>,
    solutions: Vec<Vec<f64>>,
}

/// Poses made of those of random configurations and two random numbers, at which our solver is certain of all solutions, at
/// least one and none of them nearly double.
fn known(
    d: &Description,
    count: usize,
    made: impl Fn(Transform<f64>, [f64; 2]) -> Transform<f64>,
) -> Vec<Known> {
    let robot = Robot::numeric(d).expect("all values are known");
    let space = JointSpace::new(d, &robot);
    let solver = GeneralSolver::new(&robot, &space).expect("it has six axes");
    let mut random = Random(53);
    let mut angle = || 6.0 * random.unit() - 3.0;
    let mut all = vec![];
    for _ in 0..8 * count {
        let q: Vec<f64> = (0..6).map(|_| angle()).collect();
        let pose = made(robot.pose(&q), [angle(), angle()]);
        let answer = solver.solve(&pose);
        let is_clean = answer.solutions.iter().all(|s| s.residual <= 1e-11 && s.guard >= 1e-3);
        let is_certain = answer.doubt.is_none() && answer.families.is_empty() && is_clean;
        if is_certain && !answer.solutions.is_empty() && all.len() < count {
            all.push(Known { pose, solutions: answer.solutions.into_iter().map(|s| s.q).collect() });
        }
    }
    assert_eq!(all.len(), count, "poses");
    all
}

/// Poses within reach of an arm whose first axis is z of the base and whose last one is z of the tool, the last axis along the
/// first or against it.
fn aligned(d: &Description, count: usize) -> Vec<Known> {
    known(d, count, |pose, [turn, side]| {
        let (s, c) = turn.sin_cos();
        let up = if side > 2.0 { 1.0 } else { -1.0 };
        let rotation = Rotation::from_rows([[c, -up * s, 0.0], [s, up * c, 0.0], [0.0, 0.0, up]]);
        Transform { rotation, ..pose }
    })
}

/// A program that holds the C function to sets of solutions: the number, each solution (to what a residual of 1e-10 is
/// where the smallest singular value is 1e-3), and the certificate, which rounding may deny at one pose in a hundred.
const ALIGNED: &str = r#"#include "arm.h"
#include <math.h>
#include <stdio.h>

static const double poses[][12] = {
@poses@};

static const double known[][6] = {
@known@};

/* All configurations, those of pose v from first[v] on. */
static const int first[] = {@first@};

static double nearest(const arm_solve_solution *found, int count, const double *q)
{
    static const int is_angle[6] = {@angles@};
    double least = HUGE_VAL;
    for (int j = 0; j < count; j++) {
        double apart = 0.0;
        for (int k = 0; k < 6; k++) {
            const double away = found[j].q[k] - q[k];
            apart = fmax(apart, is_angle[k] ? fabs(remainder(away, 6.283185307179586)) : fabs(away));
        }
        least = fmin(least, apart);
    }
    return least;
}

int main(void)
{
    const int all = (int)(sizeof poses / sizeof *poses);
    int failures = 0, uncertain = 0;
    for (int v = 0; v < all; v++) {
        arm_solve_solution found[ARM_SOLVE_MAX];
        arm_solve_certificate certificate = ARM_SOLVE_UNDECIDED;
        const int count = arm_solve(poses[v], found, &certificate);
        int is_same = count == first[v + 1] - first[v];
        uncertain += certificate != ARM_SOLVE_COMPLETE;
        for (int e = first[v]; e < first[v + 1]; e++) {
            is_same = is_same && nearest(found, count, known[e]) <= 1e-7;
        }
        if (!is_same) {
            printf("pose %d: %d solutions of %d\n", v, count, first[v + 1] - first[v]);
            failures++;
        }
    }
    printf("%d without certificate\n", uncertain);
    return failures != 0 || 100 * uncertain > all;
}
"#;

/// Where the last axis is parallel to the first, C finds the sets of solutions that our solver finds.
fn check_aligned(name: &str, d: &Description) {
    let all = aligned(d, share(2000, 60));
    let found = generated(d, Language::C, &[Wanted::Inverse]);
    let target = folder(&format!("elimination-c-{name}-aligned"), &found.files);
    let (mut poses, mut known, mut first) = (String::new(), String::new(), vec![0]);
    let row = |x: &[f64]| x.iter().map(|x| format!("{x:?}")).collect::<Vec<String>>().join(", ");
    for pose in &all {
        let _ = writeln!(poses, "    {{{}}},", row(&pose.pose.matrix()[..3].concat()));
        for q in &pose.solutions {
            let _ = writeln!(known, "    {{{}}},", row(q));
        }
        first.push(first[first.len() - 1] + pose.solutions.len());
    }
    let first: Vec<String> = first.iter().map(usize::to_string).collect();
    let joints = d.variables();
    let angles: Vec<&str> =
        joints.iter().map(|v| if v.kind == JointKind::Revolute { "1" } else { "0" }).collect();
    let program = ALIGNED
        .replace("@poses@", &poses)
        .replace("@known@", &known)
        .replace("@first@", &first.join(", "))
        .replace("@angles@", &angles.join(", "));
    fs::write(target.join("aligned.c"), program).expect("it can be written");
    let mut compiler = Command::new("cc");
    compiler.args(STRICT.split(' ')).args(["-o", "aligned", "aligned.c", "arm.c", "-lm"]);
    run(compiler.current_dir(&target));
    run(Command::new("./aligned").current_dir(&target));
}

/// A language that is interpreted: what its program is called with, ahead of the file that runs; and a program that reads a
/// pose a line, and writes the number of the certificate and all joints.
struct Interpreted {
    language: Language,
    program: String,
    arguments: &'static [&'static str],
    driver: (&'static str, &'static str),
}

fn python() -> Interpreted {
    Interpreted {
        language: Language::Python,
        program: std::env::var("DENAVIT_PYTHON").unwrap_or("python3".into()),
        arguments: &["-B", "-W", "error"],
        driver: (
            "driver.py",
            "
import sys
import numpy as np
import arm
found = arm.solve(np.loadtxt(sys.stdin, ndmin=2).reshape(-1, 3, 4))
for q, count, certificate in zip(found.q, found.count, found.certificate):
    print(certificate, *q[:count].ravel().tolist())
",
        ),
    }
}

fn octave() -> Interpreted {
    Interpreted {
        language: Language::Matlab,
        program: "octave".into(),
        arguments: &["--no-gui", "--quiet", "--norc"],
        driver: (
            "driver.m",
            r"
words = {'complete', 'near double root', 'undecided', 'not a pose'};
while ischar(line = fgetl(stdin))
    [q, info] = arm_solve(reshape(sscanf(line, '%f'), 4, 3).');
    printf('%d', find(strcmp(words, info.certificate)) - 1);
    printf(' %.17g', q.');
    printf('\n');
end
",
        ),
    }
}

impl Interpreted {
    /// The function of an arm tests itself, and lists what our solver does at random poses, with a certificate but at one pose in
    /// a hundred.
    fn check(&self, name: &str, d: &Description, least: usize, has_parallel_axes: bool) {
        let found = generated(d, self.language, &[Wanted::Pose, Wanted::Inverse]);
        let inverse = found.inverse.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", found.refused));
        assert!(inverse.by_elimination && inverse.vectors >= least, "{name}: {} poses", inverse.vectors);
        let target = folder(&format!("elimination-{:?}-{name}", self.language), &found.files);
        let test = found.files.iter().map(|f| &f.path).find(|p| p.starts_with("test_")).expect("a test");
        run(Command::new(&self.program).args(self.arguments).arg(test).current_dir(&target));

        let count = share(500, 30);
        let mut all = known(d, count, |pose, _| pose);
        if has_parallel_axes {
            all.extend(aligned(d, count));
        }
        let row = |x: &[f64]| x.iter().map(|x| format!("{x:e} ")).collect::<String>();
        let poses: String = all.iter().map(|k| row(&k.pose.matrix()[..3].concat()) + "\n").collect();
        fs::write(target.join("poses"), poses).expect("it can be written");
        fs::write(target.join(self.driver.0), self.driver.1).expect("it can be written");
        let output = Command::new(&self.program)
            .args(self.arguments)
            .arg(self.driver.0)
            .stdin(fs::File::open(target.join("poses")).expect("it is there"))
            .current_dir(&target)
            .output()
            .expect("it runs");
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(text.lines().count(), all.len(), "{name}: a line a pose");
        let robot = Robot::numeric(d).expect("all values are known");
        let space = JointSpace::new(d, &robot);
        let mut uncertain = 0;
        for (line, known) in text.lines().zip(&all) {
            let numbers: Vec<f64> = line.split_whitespace().map(|x| x.parse().expect("a number")).collect();
            let own: Vec<&[f64]> = numbers[1..].chunks(6).collect();
            let is_there = |s: &Vec<f64>| own.iter().any(|q| space.distance(s, q) <= 1e-7);
            let is_same = own.len() == known.solutions.len() && known.solutions.iter().all(is_there);
            assert!(is_same, "{name}: {own:?} at {:?}, not {:?}", known.pose, known.solutions);
            uncertain += usize::from(numbers[0] != 0.0);
        }
        println!("{name}: {uncertain} of {} without certificate", all.len());
        assert!(100 * uncertain <= all.len(), "{name}: {uncertain} without certificate");
    }

    /// The same of several arms, where the program is there.
    fn check_all(&self, version: &[&str]) {
        let is_there = Command::new(&self.program).args(version).output().is_ok_and(|o| o.status.success());
        if is_there {
            self.check("crx", &catalogued("fanuc-crx10ia-l"), 15, true);
            self.check("oblique", &catalogued("oblique-6r"), 15, false);
            self.check("one-slide", &read(ONE_SLIDE), 12, true);
        }
    }
}

/// Packages with the inverse model beside the forward one, as one workspace: two runs of cargo serve all of them.
fn check_rust(arms: &[(&str, &Description, usize)]) {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("elimination-rust");
    let _ = fs::remove_dir_all(&root);
    for (name, d, least) in arms {
        let functions = [Wanted::Pose, Wanted::Inverse];
        let found = generated_as(name, d, Language::Rust, &functions);
        let inverse = found.inverse.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", found.refused));
        assert!(inverse.by_elimination && inverse.vectors >= *least, "{name}: {} poses", inverse.vectors);
        folder(&format!("elimination-rust/{name}"), &found.files);
    }
    let members: Vec<&str> = arms.iter().map(|arm| arm.0).collect();
    let manifest = format!("[workspace]\nresolver = \"3\"\nmembers = {members:?}\n");
    fs::write(root.join("Cargo.toml"), manifest).expect("it can be written");
    let cargo = |arguments: &[&str]| {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(arguments).args(["--workspace", "--quiet", "--offline"]).current_dir(&root);
        cargo.env("RUSTFLAGS", "-D warnings").env("CARGO_TARGET_DIR", root.join("target"));
        run(&mut cargo);
    };
    cargo(&["test"]);
    cargo(&["build", "--no-default-features"]);
}

#[test]
fn c_finds_all_solutions() {
    check_c("crx", &catalogued("fanuc-crx10ia-l"), 15);
    check_c("oblique", &catalogued("oblique-6r"), 15);
    check_c("one-slide", &read(ONE_SLIDE), 12);
}

#[test]
fn c_finds_all_solutions_where_the_last_axis_is_parallel_to_the_first() {
    check_aligned("crx", &catalogued("fanuc-crx10ia-l"));
    check_aligned("jaco", &catalogued("kinova-jaco"));
    check_aligned("mico", &catalogued("kinova-mico"));
    check_aligned("one-slide", &read(ONE_SLIDE));
}

#[test]
fn python_finds_all_solutions() {
    python().check_all(&["-c", "import numpy"]);
}

#[test]
fn octave_finds_all_solutions() {
    octave().check_all(&["--version"]);
}

#[test]
fn rust_finds_all_solutions() {
    check_rust(&[
        ("crx", &catalogued("fanuc-crx10ia-l"), 15),
        ("oblique", &catalogued("oblique-6r"), 15),
        ("two-slides", &read(TWO_SLIDES), 8),
    ]);
}

/// What is generated in no other language, and what others do not serve, is said.
#[test]
fn what_is_not_generated_is_said() {
    let functions = [Wanted::Pose, Wanted::Inverse];
    let found = generated(&catalogued("oblique-6r"), Language::Cuda, &functions);
    let why = found.refused.expect("a reason");
    assert!(found.inverse.is_none() && why.contains("elimination is generated in C"), "{why}");
    for language in [Language::C, Language::Python, Language::Matlab, Language::JavaScript] {
        let why = generated(&read(TWO_SLIDES), language, &functions).refused.expect("a reason");
        assert!(why.contains("at most one prismatic joint"), "{why}");
    }
}
