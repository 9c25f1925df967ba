//! `denavit check ROBOT data.csv`: recorded motion, its slips, what is written.

use crate::common::{fed, text};
use denavit::{Robot, catalogue};
use serde_json::Value;
use std::path::PathBuf;

/// A folder of its own.
pub fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("denavit-recordings-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Rows of a UR5's motion: time, six joints, position and roll, pitch, yaw.
pub fn rows(change: impl Fn(&mut Vec<f64>)) -> Vec<Vec<f64>> {
    let robot = Robot::numeric(&catalogue::robot("ur5").expect("it is there")).expect("numbers");
    let row = |k: u32| {
        let t = f64::from(k) / 25.0;
        let joint = |i: u32| {
            let (a, b) = (f64::from(i), f64::from(3 * i + 1));
            [0.2, -1.4, 1.3, -0.6, 1.1, 0.4][i as usize]
                + 0.4 * (0.7 * t + a).sin()
                + 0.2 * (1.1 * t + b).sin()
        };
        let q: Vec<f64> = (0..6).map(joint).collect();
        let pose = robot.pose(&q);
        let r = pose.rotation.rows();
        let angles = [r[2][1].atan2(r[2][2]), -r[2][0].asin(), r[1][0].atan2(r[0][0])];
        let mut row = vec![t];
        row.extend(q);
        row.extend(pose.translation.0);
        row.extend(angles);
        change(&mut row);
        row
    };
    (0..250).map(row).collect()
}

const HEAD: &str = "t,q1,q2,q3,q4,q5,q6,x,y,z,roll,pitch,yaw";

fn csv(head: &str, rows: &[Vec<f64>]) -> String {
    let line = |r: &Vec<f64>| r.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    format!("{head}\n{}\n", rows.iter().map(line).collect::<Vec<_>>().join("\n"))
}

pub fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = fed(arguments, "");
    (output.status.code().expect("an exit code"), text(&output.stdout), text(&output.stderr))
}

#[test]
fn clean_motion_has_nothing_to_remark() {
    let file = folder("clean").join("clean.csv");
    std::fs::write(&file, csv(HEAD, &rows(|_| {}))).expect("a file");
    let (code, out, _) = run(&["check", "ur5", &file.to_string_lossy()]);
    assert_eq!(code, 0, "{out}");
    for part in [
        "250 rows",
        "joints q1 … q6; position x, y, z; orientation roll, pitch, yaw; time t",
        "fixed axes",
        "computed from these joints",
    ] {
        assert!(out.contains(part), "{part}: {out}");
    }
}

#[test]
fn a_slip_is_named_and_undone() {
    let at = folder("slip");
    let [file, fixed, recipe, plot] = ["slip.csv", "fixed.csv", "recipe.toml", "off.svg"].map(|n| at.join(n));
    let slipped = rows(|r| {
        r[3] = -r[3];
        r[7..10].iter_mut().for_each(|x| *x *= 1e3);
    });
    std::fs::write(&file, csv(HEAD, &slipped)).expect("a file");
    let [file, fixed_name, recipe_name, plot_name] =
        [&file, &fixed, &recipe, &plot].map(|f| f.to_string_lossy().into_owned());
    let (code, out, err) =
        run(&["check", "ur5", &file, "--fix", &fixed_name, "--recipe", &recipe_name, "--plot", &plot_name]);
    assert_eq!(code, 1, "{out}{err}");
    assert!(
        out.contains("q3: the sign is reversed") && out.contains("the position is in millimetres"),
        "{out}"
    );
    assert!(err.contains("2 findings"), "{err}");
    let written = std::fs::read_to_string(&recipe).expect("a recipe");
    assert!(
        written.contains("sign = [1, 1, -1, 1, 1, 1]") && written.contains("per_metre = 1000.0"),
        "{written}"
    );
    let drawn = std::fs::read_to_string(&plot).expect("a plot");
    let panels = [", as the columns stand", ", with all of it undone"].map(|how| drawn.matches(how).count());
    assert!(panels.iter().all(|n| *n >= 2), "{panels:?}");
    let (code, out, err) = run(&["check", "ur5", &fixed_name, "--plot", &plot_name]);
    assert_eq!(code, 0, "{out}{err}");
    let drawn = std::fs::read_to_string(&plot).expect("a plot");
    assert!(drawn.contains("position off / mm") && !drawn.contains("as the columns stand"));
    // Nothing else is left in the folder.
    assert_eq!(std::fs::read_dir(&at).expect("a folder").count(), 4);
}

#[test]
fn units_in_the_head_are_taken() {
    let at = folder("units");
    let file = at.join("units.csv");
    let head =
        "t [s],q1 [deg],q2 [deg],q3 [deg],q4 [deg],q5 [deg],q6 [deg],x [mm],y [mm],z [mm],roll,pitch,yaw";
    let rows = rows(|r| {
        r[1..7].iter_mut().for_each(|x| *x = x.to_degrees());
        r[7..10].iter_mut().for_each(|x| *x *= 1e3);
    });
    std::fs::write(&file, csv(head, &rows)).expect("a file");
    let (code, out, _) = run(&["check", "ur5", &file.to_string_lossy()]);
    assert_eq!(code, 0, "{out}");
    // The same with semicolons and decimal commas.
    let german = csv(head, &rows).replace(',', ";").replace('.', ",");
    std::fs::write(&file, german).expect("a file");
    let (code, out, err) = run(&["check", "ur5", &file.to_string_lossy()]);
    assert_eq!(code, 0, "{out}");
    assert!(err.contains("semicolons between the values, decimal commas"), "{err}");
}

#[test]
fn the_answer_as_json() {
    let file = folder("json").join("data.jsonl");
    let line = |r: &Vec<f64>| {
        format!(
            "{{\"t\":{},\"q\":{:?},\"x\":{},\"y\":{},\"z\":{},\"rpy\":{:?}}}",
            r[0],
            &r[1..7],
            r[7],
            r[8],
            r[9],
            &r[10..]
        )
    };
    let text: Vec<String> = rows(|r| r[2] += std::f64::consts::FRAC_PI_2).iter().map(line).collect();
    std::fs::write(&file, text.join("\n")).expect("a file");
    let (code, out, err) = run(&["check", "ur5", &file.to_string_lossy(), "--json"]);
    assert_eq!(code, 1, "{out}{err}");
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(
        (answer["schema"].as_i64(), answer["rows"].as_i64(), answer["understood"].as_bool()),
        (Some(1), Some(250), Some(true))
    );
    let finding = &answer["findings"][0];
    assert_eq!((finding["kind"].as_str(), finding["joint"].as_i64()), (Some("zero"), Some(2)), "{answer}");
    assert!((finding["value"].as_f64().expect("a number") - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
    assert!(answer["recipe"].as_str().expect("a text").contains("robot = \"ur5\""));
}

#[test]
fn columns_that_are_not_known() {
    let at = folder("columns");
    let file = at.join("odd.csv");
    std::fs::write(&file, csv("a,b,c,d,e,f,g,h,i,j,k,l,m", &rows(|_| {}))).expect("a file");
    let name = file.to_string_lossy();
    let (code, _, err) = run(&["check", "ur5", &name]);
    assert_eq!(code, 3, "{err}");
    assert!(err.contains("--joints"), "{err}");
    let told = ["--joints", "b..g", "--position", "h,i,j", "--rotation", "k..m", "--time", "a"];
    let (code, out, err) = run(&[&["check", "ur5", &name], &told[..]].concat());
    assert_eq!(code, 0, "{out}{err}");
    let (code, _, err) = run(&["check", "ur5", &name, "--joints", "b..z"]);
    assert_eq!(code, 3, "{err}");
    assert!(err.contains("there is no column `z`"), "{err}");
}

#[test]
fn files_that_are_none() {
    let at = folder("broken");
    let noise = rows(|r| {
        let t = r[0];
        (1..13).for_each(|k| r[k] = (1e4 * (t + 1.0) * k as f64).sin());
    });
    for (name, text, code, part) in [
        ("empty.csv", String::new(), 3, "the file is empty"),
        ("lines.jsonl", "{\"q\":[1,2]}\n{q}\n{}\n".into(), 3, "line 2"),
        ("array.npy", "no array".into(), 3, "the array is broken"),
        ("still.csv", csv(HEAD, &rows(|r| (1..7).for_each(|k| r[k] = 0.5))), 3, "does not move"),
        ("noise.csv", csv(HEAD, &noise), 3, "not understood"),
    ] {
        let file = at.join(name);
        std::fs::write(&file, text).expect("a file");
        let (found, out, err) = run(&["check", "ur5", &file.to_string_lossy()]);
        assert_eq!(found, code, "{name}: {out}{err}");
        assert!(err.contains(part), "{name}: {err}");
    }
    let (code, _, err) = run(&["check", "ur5", "README.md", "--fix", "x.csv"]);
    assert_eq!(code, 2, "{err}");
}
