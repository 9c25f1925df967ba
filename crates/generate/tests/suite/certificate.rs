//! What generated inverse kinematics says of its answers, where poses are singular, nearly so, rounded, or none: judged by
//! the forward model alone.

use crate::common::{Random, case, robot};
use crate::packages;
use denavit::space::JointSpace;
use denavit::{Description, Robot};
use denavit_emit::Language;
use denavit_generate::{PackageOptions, Wanted, generate};
use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// Reads poses, 12 numbers a line; writes the certificate, the number of solutions, and for each `free` and the joints.
const DRIVER: &str = r#"
#include "arm.h"
#include <stdio.h>
#include <stdlib.h>
int main(void) {
    double pose[12];
    char text[64];
    for (int k = 0; scanf("%63s", text) == 1; k++) {
        pose[k % 12] = strtod(text, NULL);
        if (k % 12 == 11) {
            arm_solve_solution found[ARM_SOLVE_MAX];
            arm_solve_certificate certificate;
            const int count = arm_solve(pose, @parameters@found, &certificate);
            printf("%d %d", (int)certificate, count);
            for (int s = 0; s < count; s++) {
                printf(" %u", found[s].free);
                for (int j = 0; j < @n@; j++) {
                    printf(" %.17g", found[s].q[j]);
                }
            }
            printf("\n");
        }
    }
    return 0;
}
"#;

const COMPLETE: u32 = 0;
const NOT_A_POSE: u32 = 2;

/// An arm whose inverse function was compiled.
struct Arm {
    robot: Robot<f64>,
    space: JointSpace,
    program: PathBuf,
    folder: PathBuf,
}

/// What it answered.
struct Answer {
    certificate: u32,
    solutions: Vec<(u32, Vec<f64>)>,
}

impl Arm {
    fn new(name: &str, d: &Description) -> Arm {
        let options = PackageOptions { fixed: true, ..packages::options(Language::C, &[Wanted::Inverse]) };
        let generated = generate(d, &options).expect("parameters have values");
        assert!(generated.inverse.is_some_and(|i| !i.by_elimination), "{name} has a closed form");
        let folder = packages::folder(&format!("certificate-{name}"), &generated.files);
        let robot = Robot::numeric(d).expect("parameters have values");
        let driver = DRIVER.replace("@parameters@", "").replace("@n@", &robot.joints.to_string());
        fs::write(folder.join("driver.c"), driver).expect("it can be written");
        let program = folder.join("driver");
        let flags = ["-O1", "-std=c99", "-ffp-contract=off", "arm.c", "driver.c", "-lm", "-o"];
        packages::run(Command::new("cc").args(flags).arg(&program).current_dir(&folder));
        let space = JointSpace::new(d, &robot);
        Arm { robot, space, program, folder }
    }

    fn pose(&self, q: &[f64]) -> [f64; 12] {
        let m = self.robot.pose(q).matrix();
        std::array::from_fn(|k| m[k / 4][k % 4])
    }

    fn answers(&self, poses: &[[f64; 12]]) -> Vec<Answer> {
        let mut text = String::new();
        for pose in poses {
            pose.iter().for_each(|x| write!(text, "{x:e} ").expect("text"));
            text.push('\n');
        }
        let input = self.folder.join("poses");
        fs::write(&input, text.replace("NaN", "nan")).expect("it can be written");
        let input = fs::File::open(input).expect("it is there");
        let output = Command::new(&self.program).stdin(input).output().expect("it runs");
        let text = String::from_utf8_lossy(&output.stdout);
        let answers: Vec<Answer> = text.lines().map(|line| self.answer(line)).collect();
        assert_eq!(answers.len(), poses.len());
        answers
    }

    fn answer(&self, line: &str) -> Answer {
        let numbers: Vec<f64> = line.split(' ').map(|x| x.parse().expect("a number")).collect();
        let solutions = numbers[2..].chunks(self.robot.joints + 1);
        let solutions: Vec<_> = solutions.map(|c| (c[0] as u32, c[1..].to_vec())).collect();
        assert_eq!(solutions.len(), numbers[1] as usize);
        Answer { certificate: numbers[0] as u32, solutions }
    }

    /// What is wrong with an answer to a pose that is off by `off` from that of q.
    fn fault(&self, q: &[f64], pose: &[f64; 12], off: f64, answer: &Answer) -> Option<String> {
        let far = |a: &[f64], b: &[f64]| {
            let size = |k: usize| if k % 4 == 3 { self.robot.reach() } else { 1.0 };
            (0..12).map(|k| (a[k] - b[k]).abs() / size(k)).fold(0.0, f64::max)
        };
        if let Some((_, s)) =
            answer.solutions.iter().find(|s| far(&self.pose(&s.1), pose) > 1e-8 + 20.0 * off)
        {
            return Some(format!("{s:?} has another pose"));
        }
        // Of roots that nearly coincide one knows where they are to the square root of rounding: what lies between solves, too.
        let is_between = |s: &[f64]| {
            let middle: Vec<f64> = s.iter().zip(self.space.moved(s, q)).map(|(x, d)| x + d / 2.0).collect();
            far(&self.pose(&middle), pose) <= 1e-9
        };
        let is_one = |s: &[f64]| {
            let away = self.space.distance(s, q);
            away <= 1e-6 + 1e4 * off || away <= 1e-2 && is_between(s)
        };
        let is_found = answer.solutions.iter().any(|s| is_one(&s.1));
        (answer.certificate == COMPLETE && !is_found)
            .then(|| format!("it is missing, and all is said: {:?}", answer.solutions))
    }
}

/// Configurations in multiples of a quarter turn; regular ones; and those beside the first.
fn configurations(joints: usize) -> [Vec<Vec<f64>>; 3] {
    let mut random = Random(77);
    let mut list = |count: usize, value: &mut dyn FnMut(&mut Random) -> f64| -> Vec<Vec<f64>> {
        (0..count).map(|_| (0..joints).map(|_| value(&mut random)).collect()).collect()
    };
    let quarter = |r: &mut Random| FRAC_PI_2 * (4.0 * r.unit()).floor() - FRAC_PI_2;
    let square = list(200, &mut |r| quarter(r));
    let regular = list(200, &mut |r| 6.0 * r.unit() - 3.0);
    let beside = list(200, &mut |r| {
        let away = 10_f64.powf(-4.0 - 8.0 * r.unit());
        quarter(r) + away * (2.0 * r.unit() - 1.0)
    });
    [square, regular, beside]
}

fn check(name: &str, d: &Description) {
    let arm = Arm::new(name, d);
    let [square, regular, beside] = configurations(arm.robot.joints);
    let mut faults: Vec<String> = vec![];
    let mut holds = |all: &[Vec<f64>], off: f64, round: &dyn Fn(f64) -> f64| -> usize {
        let poses: Vec<[f64; 12]> = all.iter().map(|q| arm.pose(q).map(round)).collect();
        let answers = arm.answers(&poses);
        for ((q, pose), answer) in all.iter().zip(&poses).zip(&answers) {
            faults
                .extend(arm.fault(q, pose, off, answer).map(|why| format!("{q:?} (off by {off:e}): {why}")));
        }
        answers.iter().filter(|a| a.certificate == COMPLETE).count()
    };
    let plain = |x: f64| x;
    holds(&square, 0.0, &plain);
    holds(&beside, 0.0, &plain);
    let exact = holds(&regular, 0.0, &plain);
    let mut rounded = vec![holds(&regular, 6e-8, &|x| f64::from(x as f32))];
    for decimals in [9, 6] {
        let unit = 10_f64.powi(decimals);
        let round = move |x: f64| (x * unit).round() / unit;
        holds(&square, 1.0 / unit, &round);
        rounded.push(holds(&regular, 1.0 / unit, &round));
    }
    assert!(faults.is_empty(), "{name}: {} faults\n{}", faults.len(), faults.join("\n"));
    assert!(exact >= 198, "{name}: {exact} of {} regular poses", regular.len());
    assert!(rounded.iter().all(|r| *r >= 190), "{name}: {rounded:?} of rounded ones");
    // What is no pose, and what is out of reach.
    let good = arm.pose(&regular[0]);
    let far = std::array::from_fn(|k| good[k] + if k == 3 { 10.0 * arm.robot.reach() } else { 0.0 });
    let mut none = [good; 3];
    none[0][5] = f64::NAN;
    none[1][7] = f64::INFINITY;
    none[2] = good.map(|x| 1.01 * x);
    assert!(
        arm.answers(&none).iter().all(|a| a.certificate == NOT_A_POSE && a.solutions.is_empty()),
        "{name}"
    );
    if arm.space.is_angle.iter().all(|x| *x) {
        let answer = &arm.answers(&[far])[0];
        assert!(answer.certificate == COMPLETE && answer.solutions.is_empty(), "{name}: out of reach");
    }
}

#[test]
fn generated_code_does_not_say_complete_where_it_is_not() {
    for name in ["ur5", "ur10e", "techman-tm5-700", "puma560", "stanford"] {
        check(name, &robot(name));
    }
    for name in ["gs0", "gk1_4"] {
        check(name, &case(name));
    }
}
