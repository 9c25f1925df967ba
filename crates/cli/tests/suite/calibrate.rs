//! `denavit calibrate`: what is seen, what is found, which file is written, what is refused.

use crate::common::{fed, text};
use crate::recordings::folder;
use denavit::description::read_toml;
use denavit::geometry::{Transform, Vector};
use denavit::random::Random;
use denavit::{Description, Robot, catalogue};
use denavit_recording::Arm;
use denavit_recording::turns::{between, exp, log};
use serde_json::Value;
use std::path::Path;

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = fed(arguments, "");
    (output.status.code().expect("an exit code"), text(&output.stdout), text(&output.stderr))
}

/// An arm of the catalogue with other lengths and angles.
struct Real {
    arm: Arm,
    constants: Vec<Transform<f64>>,
    random: Random,
}

impl Real {
    fn new(name: &str, seed: u64) -> Self {
        let description = catalogue::robot(name).expect("it is there").filled();
        let arm = Arm::new(name, &description).expect("numbers");
        let mut real = Real { constants: arm.constants.clone(), arm, random: Random(seed) };
        for k in 0..real.constants.len() {
            let by = Transform::from_rotation_translation(exp(real.vector(2e-3)), real.vector(0.7e-3));
            real.constants[k] = real.constants[k] * by;
        }
        real
    }

    /// Numbers of this deviation.
    fn vector(&mut self, deviation: f64) -> Vector<f64> {
        let mut one = || deviation * (12.0_f64).sqrt() * (self.random.unit() - 0.5);
        Vector([one(), one(), one()])
    }

    fn configuration(&mut self) -> Vec<f64> {
        let limits = self.arm.limits.clone();
        limits.iter().map(|[low, high]| low + (high - low) * self.random.unit()).collect()
    }

    fn pose(&self, q: &[f64]) -> Transform<f64> {
        self.arm.pose_with(&self.constants, q)
    }

    /// Rows of joints and noisy poses: position, rotation vector.
    fn rows(&mut self, count: usize, frame: &Transform<f64>) -> Vec<Vec<f64>> {
        let mut rows = vec![];
        for _ in 0..count {
            let q = self.configuration();
            let x = *frame * self.pose(&q);
            let (turn, shift) = (self.vector(3e-4), self.vector(1e-4));
            let turn = log(&(x.rotation * exp(turn)));
            rows.push([&q[..], &(x.translation + shift).0, &turn.0].concat());
        }
        rows
    }
}

fn write(file: &Path, head: &str, rows: &[Vec<f64>]) -> String {
    let line = |r: &Vec<f64>| r.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let lines: Vec<String> = rows.iter().map(line).collect();
    std::fs::write(file, format!("{head}\n{}\n", lines.join("\n"))).expect("a file");
    file.to_string_lossy().into_owned()
}

fn read(file: &str) -> Description {
    read_toml(&std::fs::read_to_string(file).expect("it was written")).expect("a robot file").0
}

const HEAD: &str = "q1,q2,q3,q4,q5,q6,x,y,z,rx,ry,rz";

#[test]
fn what_a_measurement_shows() {
    let (code, out, err) = run(&["calibrate", "ur5"]);
    assert_eq!(code, 0, "{err}");
    for part in
        ["full poses: 30 numbers are seen, of 42", "only the sum is seen", "the rank in numbers is 30"]
    {
        assert!(out.contains(part), "{part}:\n{out}");
    }
    let (_, out, _) =
        run(&["calibrate", "scara", "--measure", "position", "--point", "70mm,30mm,110mm", "--json"]);
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!((answer["seen"].as_u64(), answer["measure"].as_str()), (Some(17), Some("position")), "{out}");
}

#[test]
fn full_poses() {
    let folder = folder("calibrate-poses");
    for name in ["ur5", "staubli-rx90"] {
        let mut real = Real::new(name, 3);
        let rows = real.rows(60, &Transform::identity());
        let file = write(&folder.join(format!("{name}.csv")), HEAD, &rows);
        let written = folder.join(format!("{name}.toml")).to_string_lossy().into_owned();
        let set = ["--set", "D3=450mm", "--set", "RL4=450mm"];
        let mut arguments = vec!["calibrate", name, &file, "-o", &written, "--json"];
        let arm = catalogue::robot(name).expect("it is there");
        if arm.parameters.iter().any(|p| p.value.is_none()) {
            arguments.extend(set);
        }
        let (code, out, err) = run(&arguments);
        assert_eq!(code, 0, "{out}{err}");
        let answer: Value = serde_json::from_str(&out).expect("JSON");
        assert_eq!(answer["seen"].as_u64(), Some(30));
        let number = |path: &str| answer.pointer(path).and_then(Value::as_f64).expect("a number");
        assert!(number("/after/distance") < 0.2 * number("/before/distance"), "{out}");
        assert!(number("/held_out/1/distance") < 0.2 * number("/held_out/0/distance"), "{out}");
        // The file has the residual that was said, to the last digits.
        let robot = Robot::numeric(&read(&written)).expect("numbers");
        let (mut turns, mut shifts) = (0.0, 0.0);
        for row in &rows {
            let pose = robot.pose(&row[..6]);
            turns += between(&pose.rotation, &exp(Vector([row[9], row[10], row[11]]))).powi(2);
            shifts += (pose.translation - Vector([row[6], row[7], row[8]])).norm().powi(2);
        }
        let n = rows.len() as f64;
        assert!(((turns / n).sqrt() - number("/after/angle")).abs() < 1e-11, "{out}");
        assert!(((shifts / n).sqrt() - number("/after/distance")).abs() < 1e-11, "{out}");
        // And it is the arm: poses of its own.
        let mut worst = 0.0_f64;
        for _ in 0..50 {
            let q = real.configuration();
            worst = worst.max((robot.pose(&q).translation - real.pose(&q).translation).norm());
        }
        assert!(worst < 0.4e-3, "{worst}");
        // Its own verbs read it.
        let (code, out, err) = run(&["ik", &written, "-q", "0.3,-1.2,1.1,0.4,0.9,-0.5"]);
        assert_eq!(code, 0, "{out}{err}");
    }
}

#[test]
fn a_slip_is_refused() {
    let folder = folder("calibrate-slip");
    let mut real = Real::new("ur5", 5);
    let mut rows = real.rows(80, &Transform::identity());
    rows.iter_mut().for_each(|r| r[2] = -r[2]);
    let file = write(&folder.join("flipped.csv"), HEAD, &rows);
    let (code, _, err) = run(&["calibrate", "ur5", &file]);
    assert_eq!(code, 3);
    assert!(err.contains("q3: the sign is reversed") && err.contains("run `denavit check ur5"), "{err}");
    // With the recipe that undoes it, and with the columns that were made right.
    let recipe = folder.join("run.toml").to_string_lossy().into_owned();
    let clean = folder.join("clean.csv").to_string_lossy().into_owned();
    let (code, _, err) = run(&["check", "ur5", &file, "--recipe", &recipe, "--fix", &clean]);
    assert_eq!(code, 1, "{err}");
    for arguments in [vec!["calibrate", "ur5", &file, "--recipe", &recipe], vec!["calibrate", "ur5", &clean]]
    {
        let (code, out, err) = run(&arguments);
        assert_eq!(code, 0, "{out}{err}");
        assert!(out.contains("30 of 30 numbers are found"), "{out}");
    }
}

/// Rows that are far off are no matter of least squares: they are named, refused, and count for little where that is asked for.
#[test]
fn rows_that_are_far_off() {
    let folder = folder("calibrate-apart");
    let mut real = Real::new("ur5", 15);
    let mut rows = real.rows(200, &Transform::identity());
    rows.iter_mut().step_by(7).for_each(|r| r[8] += 0.1);
    let file = write(&folder.join("apart.csv"), HEAD, &rows);
    let (code, _, err) = run(&["calibrate", "ur5", &file]);
    assert_eq!(code, 3, "{err}");
    for part in ["error: ", "the hand is far off in 29 lines of 200", "hint: --robust"] {
        assert!(err.contains(part), "{part}: {err}");
    }
    let (code, out, err) = run(&["calibrate", "ur5", &file, "--robust"]);
    assert_eq!(code, 0, "{out}{err}");
    assert!(err.contains("note: ") && err.contains("the hand is far off in 29 lines of 200"), "{err}");
    assert_eq!(out.matches("left aside").count(), 29, "{out}");
}

/// An option that would change nothing is a mistake.
#[test]
fn options_without_what_they_are_for() {
    let check = |arguments: &[&str], part: &str| {
        let (code, _, err) = run(&[&["calibrate", "ur5"], arguments].concat());
        assert_eq!((code, err.contains(part)), (2, true), "{arguments:?}: {err}");
    };
    for option in ["--robust", "--folds=3", "--recipe=r.toml", "--unchecked"] {
        check(&[option], "<FILE>");
        check(&[option, "--choose", "4"], "<FILE>");
    }
    check(&["--group=g", "--measure=plane"], "<FILE>");
    check(&["--joints", "q1..q6"], "--joints is for measurements");
    check(&["--choose", "4", "--time", "t"], "--time is for measurements");
    check(&["--noise", "0.1mm"], "--noise is for measurements");
    check(&["--choose", "4", "-o", "x.toml"], "the list of configurations is written as .csv");
    // Before anything is read.
    check(&["nowhere.csv", "-o", "x.json"], "the calibrated arm is written as .toml or .urdf");
}

#[test]
fn poses_to_measure_at() {
    let run_with =
        |seed: &str| run(&["calibrate", "ur5", "--choose", "8", "--candidates", "60", "--seed", seed]);
    let (code, first, err) = run_with("1");
    assert_eq!(code, 0, "{err}");
    let (_, again, _) = run_with("1");
    let (_, other, _) = run_with("2");
    assert_eq!(first, again);
    assert_ne!(first, other);
    assert!(
        first.contains("8 configurations chosen out of 60") && first.contains("q1 [rad],q2 [rad]"),
        "{first}"
    );
    let rows: Vec<Vec<f64>> = first
        .lines()
        .skip_while(|l| !l.starts_with("q1"))
        .skip(1)
        .map(|l| l.split(',').map(|x| x.parse().expect("a number")).collect())
        .collect();
    assert_eq!((rows.len(), rows[0].len()), (8, 6));
}

/// Orientations say nothing of lengths: no number of them is given.
#[test]
fn orientations_have_no_lengths() {
    let asked = ["calibrate", "ur5", "--measure", "orientation"];
    let (code, out, err) = run(&[&asked[..], &["--choose", "6", "--candidates", "40"]].concat());
    assert_eq!(code, 0, "{err}");
    assert!(!out.contains(" mm") && out.contains("for a noise of 0.0200°\n"), "{out}");
    let (_, out, _) = run(&[&asked[..], &["--choose", "6", "--candidates", "40", "--json"]].concat());
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    for path in ["/deviation_of_hand", "/deviation_with_random", "/noise/distance"] {
        assert_eq!(answer.pointer(path), Some(&Value::Null), "{path}: {out}");
    }
    let folder = folder("calibrate-orientations");
    let mut real = Real::new("ur5", 17);
    let rows = real.rows(60, &Transform::identity());
    let file = write(&folder.join("o.csv"), HEAD, &rows);
    let (code, out, err) = run(&["calibrate", "ur5", &file, "--measure", "orientation", "--json"]);
    assert_eq!(code, 0, "{err}");
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    for path in [
        "/deviation_of_hand",
        "/noise/distance",
        "/after/distance",
        "/before/distance",
        "/held_out/1/distance",
    ] {
        assert_eq!(answer.pointer(path), Some(&Value::Null), "{path}: {out}");
    }
    assert!(answer.pointer("/after/angle").is_some_and(Value::is_f64), "{out}");
}

#[test]
fn positions_of_a_point() {
    let folder = folder("calibrate-positions");
    let point = Vector([0.07, 0.03, 0.11]);
    let mut real = Real::new("ur5", 7);
    // A tracker of its own.
    let tracker =
        Transform::from_rotation_translation(exp(Vector([0.4, -1.1, 0.8])), Vector([2.0, -0.5, 0.7]));
    let mut rows = vec![];
    for _ in 0..80 {
        let q = real.configuration();
        let at = tracker.act_on_point(real.pose(&q).act_on_point(point)) + real.vector(1e-4);
        rows.push([&q[..], &at.0].concat());
    }
    let head = "q1,q2,q3,q4,q5,q6,x,y,z";
    let file = write(&folder.join("p.csv"), head, &rows);
    let written = folder.join("p.toml").to_string_lossy().into_owned();
    let asked = ["calibrate", "ur5", &file, "--measure", "position", "--point", "70mm,30mm,110mm"];
    let (code, out, err) = run(&[&asked[..], &["-o", &written]].concat());
    assert_eq!(code, 0, "{out}{err}");
    assert!(out.contains("27 of 27 numbers are found") && out.contains("the base stands elsewhere"), "{out}");
    let robot = Robot::numeric(&read(&written)).expect("numbers");
    for row in &rows {
        let at = robot.pose(&row[..6]).act_on_point(point);
        assert!((at - Vector([row[6], row[7], row[8]])).norm() < 0.6e-3);
    }
    // Millimetres that are not said.
    let in_mm: Vec<Vec<f64>> = rows
        .iter()
        .map(|r| r.iter().enumerate().map(|(k, x)| if k < 6 { *x } else { 1e3 * x }).collect())
        .collect();
    let file = write(&folder.join("mm.csv"), head, &in_mm);
    let (code, _, err) =
        run(&["calibrate", "ur5", &file, "--measure", "position", "--point", "70mm,30mm,110mm"]);
    assert_eq!(code, 3);
    assert!(err.contains("positions are in millimetres"), "{err}");
    let file = write(&folder.join("said.csv"), "q1,q2,q3,q4,q5,q6,x [mm],y [mm],z [mm]", &in_mm);
    let (code, out, _) =
        run(&["calibrate", "ur5", &file, "--measure", "position", "--point", "70mm,30mm,110mm"]);
    assert_eq!(code, 0, "{out}");
}

/// Distances, measured and not: the centre is nowhere told.
#[test]
fn distances_to_a_centre() {
    let folder = folder("calibrate-distances");
    let point = Vector([0.07, 0.03, 0.11]);
    let mut real = Real::new("staubli-rx90", 9);
    let centre = Vector([0.6, 0.5, 0.1]);
    let mut rows = vec![];
    for _ in 0..400 {
        let q = real.configuration();
        let far = (real.pose(&q).act_on_point(point) - centre).norm() + real.vector(1e-5)[0];
        rows.push([&q[..], &[far]].concat());
    }
    let file = write(&folder.join("d.csv"), "q1,q2,q3,q4,q5,q6,bar", &rows);
    let asked = [
        "calibrate",
        "staubli-rx90",
        &file,
        "--measure",
        "distance",
        "--distance",
        "bar",
        "--point",
        "70mm,30mm,110mm",
    ];
    let (code, out, err) = run(&asked);
    assert_eq!(code, 0, "{out}{err}");
    assert!(out.contains("24 of 24 numbers are found"), "{out}");
    let (code, _, err) =
        run(&["calibrate", "staubli-rx90", &file, "--measure", "plane", "--distance", "bar"]);
    assert_eq!((code, err.contains("--distance is not for --measure plane")), (2, true), "{err}");
}

/// A joint that does not move: what it hides is named, and the answer is no.
#[test]
fn what_rows_do_not_show() {
    let folder = folder("calibrate-still");
    let mut real = Real::new("ur5", 11);
    let mut rows = vec![];
    for _ in 0..60 {
        let mut q = real.configuration();
        q[4] = 0.8;
        let x = real.pose(&q);
        let (turn, shift) = (real.vector(3e-4), real.vector(1e-4));
        let turn = log(&(x.rotation * exp(turn)));
        rows.push([&q[..], &(x.translation + shift).0, &turn.0].concat());
    }
    let file = write(&folder.join("still.csv"), HEAD, &rows);
    let (code, out, err) = run(&["calibrate", "ur5", &file, "--unchecked"]);
    assert_eq!(code, 1, "{out}{err}");
    assert!(
        out.contains("not seen in these rows") && err.contains("4 combinations are not seen"),
        "{out}{err}"
    );
}

#[test]
fn a_urdf_is_written() {
    let folder = folder("calibrate-urdf");
    let mut real = Real::new("ur5", 13);
    let rows = real.rows(60, &Transform::identity());
    let file = write(&folder.join("u.csv"), HEAD, &rows);
    let written = folder.join("u.urdf").to_string_lossy().into_owned();
    let (code, out, err) = run(&["calibrate", "ur5", &file, "-o", &written]);
    assert_eq!(code, 0, "{out}{err}");
    let q = rows[0][..6].iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let (code, out, err) = run(&["fk", &written, "-q", &q, "--as-written", "--json"]);
    assert_eq!(code, 0, "{err}");
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    for k in 0..3 {
        let at = answer.pointer(&format!("/pose/{k}/3")).and_then(Value::as_f64).expect("a number");
        assert!((at - rows[0][6 + k]).abs() < 1e-3, "{out}");
    }
}
