//! `denavit identify`: recordings with torques, what is written, motions that show parameters.

use crate::recordings::{folder, run};
use denavit::description::{Described, read_robot};
use denavit::dynamics::{Dynamics, drive_torques};
use serde_json::Value;
use std::path::{Path, PathBuf};

const ARM: &str = r#"
name = "Test arm"
convention = "standard"

[[joints]]
theta = "q1"
d = "0.3 m"
alpha = "90 deg"
mass = 6
com = [0.01, -0.1, 0.02]
inertia = [0.05, 0.001, 0, 0.04, 0.002, 0.05]
viscous = 1.5
coulomb = 0.8
limits = ["-170 deg", "170 deg"]

[[joints]]
theta = "q2"
a = "0.4 m"
mass = 5
com = [-0.2, 0.01, 0.05]
inertia = [0.02, 0, 0.003, 0.09, 0, 0.09]
viscous = 1.2
coulomb = 0.9
limits = ["-90 deg", "90 deg"]

[[joints]]
theta = "q3"
a = "0.35 m"
mass = 3
com = [-0.15, 0.0, -0.03]
inertia = [0.01, 0.001, 0, 0.04, 0.001, 0.04]
viscous = 0.6
coulomb = 0.4
limits = ["-120 deg", "120 deg"]
"#;

fn dynamics(text: &str) -> Dynamics<f64> {
    let (Described::Chain(d), _) = read_robot(text).expect("a robot") else { panic!("a chain") };
    Dynamics::numeric(&d).expect("masses")
}

fn motion(t: f64) -> [Vec<f64>; 3] {
    let waves: [[[f64; 3]; 3]; 3] = [
        [[0.8, 0.9, 0.1], [0.4, 2.1, 1.0], [0.2, 3.3, 2.0]],
        [[0.5, 1.1, 0.7], [0.3, 1.9, 2.5], [0.15, 3.7, 0.4]],
        [[0.6, 1.3, 1.9], [0.3, 2.3, 0.2], [0.2, 3.1, 1.1]],
    ];
    let sum = |f: &dyn Fn(&[f64; 3]) -> f64| waves.iter().map(|own| own.iter().map(f).sum()).collect();
    [
        sum(&|[a, w, p]| a * (w * t + p).sin()),
        sum(&|[a, w, p]| a * w * (w * t + p).cos()),
        sum(&|[a, w, p]| -a * w * w * (w * t + p).sin()),
    ]
}

/// A recording with a little noise, as CSV; rows may be changed.
fn csv(head: &str, change: impl Fn(&mut Vec<f64>)) -> String {
    let arm = dynamics(ARM);
    let mut random = denavit::random::Random(5);
    let mut text = format!("{head}\n");
    for r in 0..4000 {
        let t = f64::from(r) / 200.0;
        let [q, qd, qdd] = motion(t);
        let tau = drive_torques(&arm, &q, &qd, &qdd, None);
        let mut row = vec![t];
        let mut noise = |size: f64| size * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
        row.extend(q.iter().map(|x| x + noise(2e-5)));
        row.extend(tau.iter().map(|x| x + noise(0.1)));
        change(&mut row);
        text += &format!("{}\n", row.iter().map(f64::to_string).collect::<Vec<_>>().join(","));
    }
    text
}

const HEAD: &str = "t,q1,q2,q3,tau1,tau2,tau3";

fn files(name: &str, data: &str) -> (PathBuf, String, String) {
    let folder = folder(&format!("identify-{name}"));
    let (robot, file) = (folder.join("arm.toml"), folder.join("run.csv"));
    std::fs::write(&robot, ARM).expect("a file");
    std::fs::write(&file, data).expect("a file");
    let text = |p: &Path| p.to_string_lossy().into_owned();
    let (robot, file) = (text(&robot), text(&file));
    (folder, robot, file)
}

#[test]
fn what_is_written_has_the_recorded_torques() {
    let (folder, robot, file) = files("written", &csv(HEAD, |_| {}));
    for prior in ["file", "neutral"] {
        let written = folder.join(format!("{prior}.toml"));
        let (code, out, err) =
            run(&["identify", &robot, &file, "--prior", prior, "-o", &written.to_string_lossy()]);
        assert_eq!(code, 0, "{out}{err}");
        for part in [
            "joints q1 … q3",
            "torques tau1 … tau3",
            "velocities from the positions",
            "ZZR1",
            "FS3",
            "Masses that can be",
        ] {
            assert!(out.contains(part), "{part}: {out}");
        }
        let (read, truth) = (dynamics(&std::fs::read_to_string(&written).expect("a file")), dynamics(ARM));
        let (mut off, mut size) = (0.0, 0.0);
        for k in 0..50 {
            let [q, qd, qdd] = motion(0.37 * f64::from(k));
            let (a, b) =
                (drive_torques(&read, &q, &qd, &qdd, None), drive_torques(&truth, &q, &qd, &qdd, None));
            off += a.iter().zip(&b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            size += b.iter().map(|b| b * b).sum::<f64>();
        }
        assert!(off < 1e-4 * size, "{prior}: {off} {size}");
        // The verb that reads it does.
        let (code, out, err) = run(&["dynamics", &written.to_string_lossy(), "-q", "0,0.3,-0.4", "--json"]);
        assert_eq!(code, 0, "{out}{err}");
        assert!(!err.contains("warning"), "{err}");
    }
}

#[test]
fn json_has_it_all() {
    let (_, robot, file) = files("json", &csv(HEAD, |_| {}));
    let (code, out, err) = run(&["identify", &robot, &file, "--json", "--rotors"]);
    assert_eq!(code, 0, "{err}");
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(answer["schema"], 1);
    assert_eq!(answer["roles"]["torques"][2], "tau3");
    let parameters = answer["parameters"].as_array().expect("a list");
    let friction = parameters.iter().find(|p| p["name"] == "FV1").expect("it is there");
    let (value, deviation) =
        (friction["value"].as_f64().expect("seen"), friction["deviation"].as_f64().expect("seen"));
    assert!((value - 1.5).abs() < 5.0 * deviation && deviation < 0.2, "{value} ± {deviation}");
    // The first rotor turns with the first link about one axis: no torque tells them apart.
    assert_eq!(answer["absorbed"][0]["name"], "IA1");
    assert_eq!(answer["consistent"]["links"].as_array().map(Vec::len), Some(3));
    assert_eq!(answer["suspects"], serde_json::json!([]));
}

#[test]
fn a_wrong_sign_is_named_and_nothing_is_written() {
    let (folder, robot, file) = files("sign", &csv(HEAD, |row| row[5] = -row[5]));
    let written = folder.join("none.toml");
    let (code, out, err) = run(&["identify", &robot, &file, "-o", &written.to_string_lossy()]);
    assert_eq!(code, 1, "{out}{err}");
    assert!(out.contains("the torque of q2 has the other sign"), "{out}");
    assert!(err.contains("no file is written"), "{err}");
    assert!(!written.exists());
}

#[test]
fn units_of_columns_count() {
    let head = "t [ms],q1 [deg],q2 [deg],q3 [deg],tau1 [N mm],tau2 [N mm],tau3 [N mm]";
    let data = csv(head, |row| {
        row.iter_mut().enumerate().for_each(|(k, x)| {
            *x = match k {
                1..=3 => x.to_degrees(),
                _ => *x * 1000.0,
            };
        });
    });
    let (_, robot, file) = files("units", &data);
    let (code, out, err) = run(&["identify", &robot, &file]);
    assert_eq!(code, 0, "{out}{err}");
    // A second file that does not say degrees, behind one that does.
    let (_, _, other) = files("other", &data.replace(" [deg]", ""));
    let (code, out, err) = run(&["identify", &robot, &file, &other]);
    assert_eq!(code, 0, "{out}{err}");
    assert!(out.contains("taken for degrees"), "{out}");
    // Not said, degrees are found.
    let bare = data.replace(" [deg]", "").replace(" [N mm]", "").replace(" [ms]", "");
    let (_, robot, file) = files("bare", &bare);
    let (_, out, _) = run(&["identify", &robot, &file]);
    assert!(out.contains("taken for degrees"), "{out}");
}

#[test]
fn bad_input_is_told_with_its_place() {
    let (folder, robot, file) = files("bad", &csv("t,q1,q2,q3,a,b,c", |_| {}));
    let check = |arguments: &[&str], code: i32, part: &str| {
        let (found, out, err) = run(&[&["identify"][..], arguments].concat());
        assert_eq!(found, code, "{arguments:?}: {out}{err}");
        assert!(err.contains(part), "{arguments:?}: {err}");
    };
    check(&[&robot, &file], 3, "which columns are the torques is not known");
    check(&[&robot, &file, "--torques", "a..d"], 3, "there is no column `d`");
    check(&[&robot, &file, "--torques", "a,b"], 3, "2 columns are taken for their torques");
    check(&[&robot, &file, "--torques", "a..c", "--cutoff", "fast"], 2, "--cutoff fast");
    check(&[&robot, &file, "--torques", "a..c", "--cutoff", "500"], 3, "200 rows a second");
    check(&[&robot, &file, "--torques", "a..c", "--friction", "sticky"], 2, "--friction sticky");
    check(&[&robot, &file, "--torques", "a..c", "--gains", "1,2"], 2, "one for each of 3 joints");
    check(&["ur5", &file, "--torques", "a..c"], 3, "");
    check(&["sr400", &file], 4, "not supported");
    check(&[&robot, &robot], 3, "what is this?");
    check(&[&robot], 2, "");
    check(&["ur5", &file, "--prior", "file", "--torques", "a..c"], 3, "");
    let empty = folder.join("empty.csv");
    std::fs::write(&empty, "t,q1,q2,q3,tau1,tau2,tau3\n0,0,0,0,0,0,0\n").expect("a file");
    check(&[&robot, &empty.to_string_lossy()], 3, "1 of 1 rows");
    check(&[&robot, "--excite"], 2, "--velocity");
    for option in [
        "--gains=2",
        "--cutoff=3",
        "--time=t",
        "--rate=9",
        "--joints=a..c",
        "--robust",
        "--prior=file",
        "--degrees",
    ] {
        check(&[&robot, "--excite", option], 2, "cannot be used with");
    }
    check(&[&robot, "--excite", "-o", "x.toml"], 2, "the motion is written as .csv");
    check(&[&robot, &file, "-o", "x.csv"], 2, "the robot is written as .toml");
    check(&[&robot, "--excite", "--velocity", "1", "--acceleration", "3", "--range", "1..-1"], 2, "is empty");
}

#[test]
fn a_motion_within_limits() {
    let (folder, robot, _) = files("excite", "");
    let written = folder.join("motion.csv");
    let mut arguments = vec!["identify", &robot, "--excite", "--velocity", "1.5", "--acceleration", "4"];
    let name = written.to_string_lossy().into_owned();
    arguments.extend(["--trials", "60", "--duration", "8", "-o", &name]);
    let (code, out, err) = run(&arguments);
    assert_eq!(code, 0, "{out}{err}");
    for part in ["from rest to rest", "condition number", "not known to be the best", "hits itself"] {
        assert!(out.contains(part), "{part}: {out}");
    }
    let first = std::fs::read_to_string(&written).expect("a file");
    let mut lines = first.lines();
    assert_eq!(lines.next(), Some("t,q1,q2,q3,qd1,qd2,qd3,qdd1,qdd2,qdd3"));
    let rows: Vec<Vec<f64>> =
        lines.map(|l| l.split(',').map(|x| x.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len(), 801);
    for row in &rows {
        assert!(
            row[4..7].iter().all(|v| v.abs() <= 1.5 + 1e-9) && row[7..].iter().all(|a| a.abs() <= 4.0 + 1e-9)
        );
        assert!(row[2].abs() <= 90_f64.to_radians() + 1e-9);
    }
    for row in [&rows[0], &rows[800]] {
        assert!(row[4..].iter().all(|x| x.abs() < 1e-9), "{row:?}");
    }
    // Steps that do not end with the motion end at rest behind it.
    let uneven = folder.join("uneven.csv").to_string_lossy().into_owned();
    let mut other = arguments.clone();
    other.pop();
    let (code, out, err) = run(&[&other[..], &[&uneven, "--dt", "0.3"]].concat());
    assert_eq!(code, 0, "{out}{err}");
    let text = std::fs::read_to_string(&uneven).expect("a file");
    let last: Vec<f64> =
        text.lines().last().expect("a row").split(',').map(|x| x.parse().expect("a number")).collect();
    assert!((last[0] - 8.1).abs() < 1e-9 && last[4..].iter().all(|x| x.abs() < 1e-9), "{last:?}");
    // The names are those that other verbs read.
    let torques = folder.join("torques.csv");
    let (code, out, err) = run(&["map", &robot, &name, "--torque", "-o", &torques.to_string_lossy()]);
    assert_eq!(code, 0, "{out}{err}");
    run(&arguments);
    assert_eq!(first, std::fs::read_to_string(&written).expect("a file"));
    // The verb's own motion, simulated, identifies the arm: the columns are known by their names.
    let (code, out, _) = run(&[&arguments[..], &["--json"]].concat());
    assert_eq!(code, 0);
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(answer["a"].as_array().map(Vec::len), Some(3));
}

const TREE: &str = r#"<robot name="two">
  <link name="base"/>
  <link name="left"><inertial><origin xyz="0.2 0 0.01"/><mass value="3"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.04" iyz="0" izz="0.04"/></inertial></link>
  <link name="right"><inertial><origin xyz="0.1 0 0.1"/><mass value="2"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial></link>
  <joint name="swing" type="revolute"><parent link="base"/><child link="left"/><axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="lift" type="revolute"><parent link="base"/><child link="right"/><axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>
"#;

#[test]
fn a_whole_tree() {
    let folder = folder("identify-tree");
    let (robot, file) = (folder.join("two.urdf"), folder.join("run.csv"));
    let (m, _) =
        denavit::description::read_urdf(TREE, denavit::description::Decimals::Meant).expect("it reads");
    let arm = denavit::dynamics::OfTree::new(&m).expect("masses").dynamics;
    let mut text = "t,swing,lift,swing_effort,lift_effort\n".to_string();
    for r in 0..4000 {
        let [q, qd, qdd] = motion(f64::from(r) / 200.0);
        let tau = drive_torques(&arm, &q[..2], &qd[..2], &qdd[..2], None);
        text += &format!("{},{},{},{},{}\n", f64::from(r) / 200.0, q[0], q[1], tau[0], tau[1]);
    }
    std::fs::write(&robot, TREE).expect("a file");
    std::fs::write(&file, text).expect("a file");
    let (robot, file) = (robot.to_string_lossy().into_owned(), file.to_string_lossy().into_owned());
    let (code, out, err) = run(&["identify", &robot, &file, "--whole", "--json", "--friction", "none"]);
    assert_eq!(code, 0, "{out}{err}");
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    let value = |name: &str| {
        let all = answer["parameters"].as_array().expect("a list");
        all.iter().find(|p| p["name"] == name).and_then(|p| p["value"].as_f64()).expect("it is told")
    };
    // About the axis: the steadier the nearer; the inertia about it is that about the centre and m r².
    let inertia = 0.04 + 3.0 * (0.2 * 0.2 + 0.01 * 0.01);
    assert!((value("ZZ1") - inertia).abs() < 1e-3 * inertia, "{}", value("ZZ1"));
    let (code, _, err) = run(&["identify", &robot, &file, "--whole", "-o", "x.toml"]);
    assert_eq!(code, 2, "{err}");
}
