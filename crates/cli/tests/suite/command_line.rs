//! The built command: what it prints, where, and how it ends.

use crate::common::{fed, text};
use denavit::catalogue;
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol, equal};
use serde_json::Value;
use std::process::{Command, Output, Stdio};

fn denavit(arguments: &[&str]) -> Output {
    fed(arguments, "")
}

fn stdout(output: &Output) -> String {
    text(&output.stdout)
}

fn stderr(output: &Output) -> String {
    text(&output.stderr)
}

fn json(arguments: &[&str]) -> Value {
    let output = denavit(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    let value: Value = serde_json::from_str(&stdout(&output)).expect("one JSON value");
    assert_eq!(value["schema"], 1);
    value
}

/// Exit code, and a text that standard error holds.
#[track_caller]
fn refused(arguments: &[&str], code: i32, says: &str) {
    let output = denavit(arguments);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
    assert!(stderr(&output).contains(says), "{arguments:?}: {}", stderr(&output));
    assert!(output.stdout.is_empty(), "{arguments:?}: data after a refusal");
}

#[test]
fn refusals() {
    refused(&["derive", "nobody"], 3, "no robot or file `nobody`");
    refused(&["derive", "puma"], 3, "did you mean puma-simple, puma560");
    refused(&["fk", "ur5"], 2, "-q with 6 values");
    refused(&["fk", "ur5", "-q", "0,0,0"], 2, "3 values given, the robot has 6 joints");
    refused(&["fk", "ur5", "-q", "0,0,0,0,0,nan"], 2, "q6: the value is not a finite number");
    refused(&["fk", "ur5", "-q", "0,0,0,0,0,1/0"], 2, "q6: division by zero");
    refused(&["fk", "scara", "-q", "20mm,0,20deg,x"], 2, "q1: `mm` measures a length");
    refused(&["fk", "scara", "-q", "20mm,0,20deg,x"], 2, "q4: `x` is no number");
    refused(&["fk", "puma560", "-q", "ready", "--set", "d6=30deg"], 2, "`deg` measures an angle");
    refused(&["fk", "puma560", "-q", "ready", "--set", "d6=1", "--set", "d6=2"], 2, "two values");
    refused(&["show", "scara", "--convention", "craig"], 2, "--convention is for tables");
    refused(&["robots", "zzz"], 1, "no robot of the catalogue matches `zzz`");
    refused(&["fk", "prrrrp", "-q", "0 0 0 0 0 0"], 3, "no value for r7, a2, a3");
    refused(&["fk", "ur5", "-q", "0 0 0 0 0 0", "--frames", "9"], 2, "0 to 6");
    refused(&["fk", "ur5", "-q", "0 0 0 0 0 0", "--orientation", "xxy"], 2, "xxy");
    refused(&["derive", "ur5", "--from", "7"], 2, "0 to 6");
    refused(&["derive", "ur5", "--only", "w"], 2, "unknown part `w`");
    refused(&["show", "ur5", "--set", "d9=1"], 2, "no parameter `d9`");
    refused(&["show", "arm.urdf"], 3, "error: arm.urdf: ");
    refused(&["show", "arm.urdf.xacro"], 3, "error: arm.urdf.xacro: ");
    refused(&["show", "ur5", "--arg", "a=1"], 2, "--arg is for URDF files");
    refused(&["show", "ur5", "--tip", "tool0"], 2, "--tip is for URDF files");
    refused(&["paint", "ur5"], 2, "unrecognized subcommand");
}

/// A URDF of the tests of the science.
fn urdf(name: &str) -> String {
    format!("{}/../robot/tests/urdf/{name}.urdf", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn every_verb_takes_a_urdf() {
    let file = urdf("ur5_robot");
    let chain = ["--base", "base", "--tip", "tool0"];
    let all = |verb: &str, rest: &[&str]| {
        let arguments = [&[verb, &file][..], &chain, rest].concat();
        let output = denavit(&arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
        (stdout(&output), stderr(&output))
    };
    let (table, notes) = all("show", &[]);
    assert!(
        table.contains("shoulder_pan_joint") && table.contains("0.42500") | table.contains("0.425"),
        "{table}"
    );
    assert!(
        notes.contains("note: 1.57079632679 is read as π/2")
            && notes.contains("proved to be the file's chain"),
        "{notes}"
    );
    // As the catalogue's arm, whose table is the maker's.
    let q = ["-q", "0.3,-1.2,1.5,0.4,0.9,-0.6"];
    let pose = |arguments: &[&str]| json(&[arguments, &q, &["--json"]].concat())["pose"].clone();
    let [here, there] = [pose(&[&["fk", &file][..], &chain].concat()), pose(&["fk", "ur5"])];
    let numbers = |v: &Value| -> Vec<f64> {
        v.as_array()
            .unwrap()
            .iter()
            .flat_map(|r| r.as_array().unwrap())
            .map(|x| x.as_f64().unwrap())
            .collect()
    };
    for (x, y) in numbers(&here).iter().zip(numbers(&there)) {
        assert!((x - y).abs() < 1e-12, "{here} {there}");
    }
    let (solved, _) = all("ik", &["-q", "0.3,-1.2,1.5,0.4,0.9,-0.6"]);
    assert!(solved.contains('8'), "{solved}");
    all("derive", &["--from", "1"]);
    all("jacobian", &["-q", "0.3,-1.2,1.5,0.4,0.9,-0.6"]);
    let (file_text, _) = all("show", &["--toml"]);
    assert!(file_text.contains("name = \"wrist_3_joint\""), "{file_text}");
    let (craig, _) = all("show", &["--convention", "craig"]);
    assert!(craig.contains("craig convention"));
    let (_, notes) = all("show", &["--as-written"]);
    assert!(!notes.contains("is read as π/2"), "{notes}");
}

/// A robot in packages on disk: what it includes is found beside it, and nothing outside of the packages is read.
#[test]
fn xacro_finds_its_files() {
    let folder = std::env::temp_dir().join(format!("denavit-xacro-{}", std::process::id()));
    let write = |name: &str, text: &str| {
        let file = folder.join(name);
        std::fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
        std::fs::write(&file, text).expect("a file");
        file.to_str().expect("UTF-8").to_string()
    };
    let robot = |inner: &str| {
        format!("<robot xmlns:xacro='http://www.ros.org/wiki/xacro' name='r'>\n{inner}\n</robot>")
    };
    let macros = "<xacro:macro name='arm' params='l'><link name='a'/><link name='b'/><joint name='turn' type='continuous'>\
        <origin xyz='0 0 ${l}' rpy='${radians(90)} 0 0'/><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint></xacro:macro>";
    write("arm_description/package.xml", "<package><name>arm_description</name></package>");
    write("arm_description/arm.xacro", &robot(macros));
    write("other/package.xml", "<package><name>other</name></package>");
    write("secret.xacro", &robot(macros));
    let main = write(
        "other/urdf/r.urdf.xacro",
        &robot(
            "<xacro:arg name='l' default='0.5'/><xacro:include filename='$(find arm_description)/arm.xacro'/><xacro:arm l='$(arg l)'/>",
        ),
    );
    let shown = json(&["show", &main, "--arg", "l:=0.25", "--json"]);
    assert_eq!(shown["joints"].as_array().map(Vec::len).unwrap_or(1), 1, "{shown}");
    let file = denavit(&["show", &main, "--arg", "l=0.25", "--toml"]);
    assert!(stdout(&file).contains("0.25 m") && stdout(&file).contains("turn"), "{}", stdout(&file));
    let outside = write(
        "other/urdf/outside.urdf.xacro",
        &robot("<xacro:include filename='../../secret.xacro'/><link name='a'/>"),
    );
    refused(&["show", &outside], 3, "lies outside");
    let missing =
        write("other/urdf/missing.urdf.xacro", &robot("<xacro:include filename='$(find nowhere)/x.xacro'/>"));
    refused(&["show", &missing], 3, "--package nowhere=FOLDER");
    refused(&["show", &missing, "--package", "nowhere"], 2, "write NAME=VALUE");
    std::fs::remove_dir_all(folder).expect("it was written");
}

#[test]
fn robots_are_converted_and_held_against_themselves() {
    let output = denavit(&["convert", "puma560", "--to", "urdf"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(
        stdout(&output).starts_with("<robot name=\"")
            && stderr(&output).contains("proved to be the same robot")
    );
    let file = std::env::temp_dir().join(format!("denavit-convert-{}.urdf", std::process::id()));
    let path = file.to_str().expect("UTF-8");
    assert_eq!(denavit(&["convert", "ur5", "--to", "urdf", "-o", path]).status.code(), Some(0));
    let output = denavit(&["convert", path, "--to", "toml", "--as", "craig"]);
    assert!(stdout(&output).contains("convention = \"craig\""), "{}", stderr(&output));
    assert!(stderr(&output).contains("proved to be the same robot"), "{}", stderr(&output));
    std::fs::remove_file(file).expect("it was written");
    let output = denavit(&["convert", "kinova-mico", "--to", "urdf"]);
    assert!(stderr(&output).contains("poses differ by"), "{}", stderr(&output));
    refused(&["convert", "prrrrp", "--to", "urdf"], 3, "no value for");
}

/// A model is known by its root element, whatever its name is; what is written of a robot is the robot.
#[test]
fn every_verb_takes_a_model_for_mujoco() {
    let model = format!("{}/../robot/tests/mjcf/ur5e.xml", env!("CARGO_MANIFEST_DIR"));
    let folder = std::env::temp_dir().join(format!("denavit-mjcf-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    for name in ["arm.xml", "arm.urdf", "arm.mjcf"] {
        let path = folder.join(name);
        std::fs::copy(&model, &path).expect("the model is there");
        let file = path.to_str().expect("UTF-8");
        for (verb, rest) in
            [("show", &[][..]), ("fk", &["-q", "1 2 3 4 5 6"]), ("ik", &["-q", "0.3,-1.2,1.5,0.4,0.9,-0.6"])]
        {
            let arguments = [&[verb, file, "--base", "base", "--tip", "right_hand"][..], rest].concat();
            let output = denavit(&arguments);
            assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
            assert!(stderr(&output).contains("proved to be the file's chain"), "{}", stderr(&output));
        }
        refused(&["show", file, "--arg", "a=1"], 2, "--arg is for xacro files");
        refused(&["show", file, "--tip", "rigt_hand"], 2, "did you mean `right_hand`?");
    }
    let written = folder.join("written.xml");
    let path = written.to_str().expect("UTF-8");
    let output = denavit(&["convert", "puma560", "--to", "mjcf", "-o", path]);
    assert!(stderr(&output).contains("proved to be the same robot"), "{}", stderr(&output));
    let output = denavit(&["convert", path, "--base", "base", "--tip", "tool", "--to", "urdf"]);
    assert!(stdout(&output).starts_with("<robot"), "{}", stderr(&output));
    assert!(stderr(&output).contains("proved to be the same robot"), "{}", stderr(&output));
    refused(&["convert", "prrrrp", "--to", "mjcf"], 3, "no value for");
    std::fs::write(&written, "<mujoco>\n  <worldbody>\n    <body pos='1 2'/>\n  </worldbody>\n</mujoco>\n")
        .expect("a file");
    refused(&["show", path], 3, "written.xml:3:16: ");
    std::fs::remove_dir_all(folder).expect("it was made");
}

/// Joints are called as their file calls them, or by their variables.
#[test]
fn joints_go_by_their_names() {
    let file = urdf("ur5_robot");
    let file = [file.as_str(), "--tip", "wrist_3_link", "--quiet"];
    let fk = |q: &str| stdout(&denavit(&[&["fk"][..], &file, &["--json", "-q", q]].concat()));
    let all = fk("0, -0.5, 0, 0, 1, 0");
    assert!(all.contains("pose"), "{all}");
    assert_eq!(fk("shoulder_lift_joint=-0.5, q5=1"), all);
    assert_eq!(fk("2=-0.5, wrist_2_joint=1"), all);
    let shown = stdout(&denavit(&[&["show"][..], &file, &["--json"]].concat()));
    assert!(shown.contains("\"name\":\"shoulder_pan_joint\""), "{shown}");
    let refuses = |q: &str, why: &str| refused(&[&["fk"][..], &file, &["-q", q]].concat(), 2, why);
    refuses("elbow=1", "no joint `elbow`; there are q1 (shoulder_pan_joint), q2");
    refuses("q2=1, shoulder_lift_joint=2", "shoulder_lift_joint is given twice");
    refuses("q2=1, 3", "`3`: write NAME=VALUE");
}

/// ROS's own parser asks for velocity and effort of every limit and for limits of every slide; masses are carried over; names
/// come back out of LaTeX.
#[test]
fn what_is_written_is_what_others_read() {
    let folder = std::env::temp_dir().join(format!("denavit-written-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let at = |name: &str| folder.join(name).to_str().expect("UTF-8").to_string();
    let rows = "[[joints]]\nname = \"arm_1_joint\"\ntheta = \"q1\"\na = \"1 m\"\nlimits = [-1, 1]\nmass = 2\n\
                com = [\"-0.5 m\", 0, 0]\ninertia = [0.1, 0.2, 0.3, 0.01, 0, 0]\n\
                [[joints]]\nname = \"arm_2_joint\"\nd = \"q2\"\nalpha = \"90 deg\"\n";
    std::fs::write(at("arm.toml"), format!("name = \"arm\"\nconvention = \"standard\"\n{rows}"))
        .expect("a file");
    let urdf = stdout(&denavit(&["convert", &at("arm.toml"), "--to", "urdf"]));
    let limits: Vec<&str> = urdf.lines().filter(|l| l.contains("<limit")).collect();
    assert_eq!(limits.len(), 2, "{urdf}");
    let asked = ["lower=", "upper=", "effort=", "velocity="];
    assert!(limits.iter().all(|l| asked.iter().all(|a| l.contains(a))), "{urdf}");
    assert!(urdf.contains("<mass value=\"2\"/>") && urdf.contains("ixx=\"0.1\""), "{urdf}");
    std::fs::write(at("arm.urdf"), &urdf).expect("a file");
    let output = denavit(&["show", &at("arm.urdf"), "--tip", "tool"]);
    assert!(stderr(&output).contains("links, which its rows have"), "{}", stderr(&output));
    denavit(&["convert", &at("arm.toml"), "--to", "latex", "-o", &at("arm.tex")]);
    let shown = stdout(&denavit(&["show", &at("arm.tex")]));
    assert!(shown.contains("arm_1_joint") && !shown.contains('\\'), "{shown}");
    // A planar joint about z slides along x and y.
    let planar = "<robot name=\"p\"><link name=\"a\"/><link name=\"b\"/><joint name=\"pl\" type=\"planar\">\
                  <parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/></joint></robot>";
    std::fs::write(at("planar.urdf"), planar).expect("a file");
    let output = denavit(&["fk", &at("planar.urdf"), "--frames", "all", "-q", "pl x=1, pl y=2", "--json"]);
    let poses = stdout(&output);
    assert!(
        poses.replace(char::is_whitespace, "").contains("[1.0,0.0,0.0,1.0],[0.0,1.0,0.0,2.0]"),
        "{poses}"
    );
    std::fs::remove_dir_all(folder).expect("it was made");
}

#[test]
fn a_urdf_says_what_it_cannot_do() {
    refused(&["show", &urdf("ur5_gripper")], 2, "choose one with --tip LINK");
    refused(&["show", &urdf("ur5_robot"), "--tip", "tol0"], 2, "did you mean `tool0`?");
    refused(&["show", &urdf("ur5_robot"), "--base", "base", "--tip", "base_link"], 3, "no joint moves");
    refused(&["show", &urdf("ur5_robot"), "--table", "2"], 2, "--table is for tables");
}

#[test]
fn names_are_found_in_any_spelling() {
    assert_eq!(json(&["show", "UR5", "--json"])["robot"], json(&["show", "ur5", "--json"])["robot"]);
    assert_eq!(denavit(&["show", "Staubli RX90"]).status.code(), Some(0));
}

#[test]
fn what_is_too_long_to_read_is_given_up() {
    let rows: String = (1..=20)
        .map(|i| format!("[[joints]]\ntheta = \"q{i}\"\na = \"1 m\"\nalpha = \"37 deg\"\n"))
        .collect();
    let folder = std::env::temp_dir().join(format!("denavit-long-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("long.toml");
    std::fs::write(&file, format!("name = \"long\"\nconvention = \"standard\"\n{rows}")).expect("a file");
    let output = denavit(&["derive", file.to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(5), "{}", stderr(&output));
    assert!(stdout(&output).contains("Algorithm") && stderr(&output).contains("gave up"));
    let _ = std::fs::remove_dir_all(&folder);
}

#[test]
fn configurations_with_units_poses_and_limits() {
    let units = json(&["fk", "stanford", "-q", "90deg, pi/2, 250 mm, 0, -0.5, 1e-1", "--json"]);
    let plain =
        json(&["fk", "stanford", "-q", "1.5707963267948966 1.5707963267948966 0.25 0 -0.5 0.1", "--json"]);
    assert_eq!(units["pose"], plain["pose"]);
    let ready = json(&["fk", "puma560", "-q", "ready", "--json"]);
    assert_eq!(ready["q"][1], std::f64::consts::FRAC_PI_2);
    let outside = denavit(&["fk", "puma560", "-q", "170deg 0 0 0 0 0"]);
    assert_eq!(outside.status.code(), Some(0));
    assert!(
        stderr(&outside).contains("q1 = 170° is outside its limits −160° … 160°"),
        "{}",
        stderr(&outside)
    );
}

#[test]
fn frames_and_orientations() {
    let answer =
        json(&["fk", "ur5", "-q", "0 0 0 0 0 0", "--frames", "all", "--orientation", "rpy", "--json"]);
    assert_eq!(answer["frames"].as_array().map(Vec::len), Some(7));
    assert_eq!(answer["frames"][6], answer["pose"]);
    assert_eq!(answer["orientation"]["set"], "rpy");
    let singular = json(&["fk", "planar-2r", "-q", "0.1 0.2", "--orientation", "zyz", "--json"]);
    assert_eq!(singular["orientation"]["singular"], true);
    assert_eq!(singular["orientation"]["values"][2], 0.0);
}

#[test]
fn a_stream_answers_each_line_in_order() {
    let input = "[0,0]\n[1,\n\n[1,2,3]\n\"x\"\n[0.5,-0.5]\n\u{0}\n[null,1]\n";
    let output = fed(&["fk", "planar-2r", "--input", "-"], input);
    assert_eq!(output.status.code(), Some(3));
    let lines: Vec<Value> = stdout(&output).lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    let good: Vec<bool> = lines.iter().map(|l| l["pose"].is_array()).collect();
    assert_eq!(good, [true, false, false, false, true, false, false]);
    assert_eq!(lines[2]["line"], 4);
    assert!(lines[2]["error"].as_str().is_some_and(|e| e.contains("3 values")), "{}", lines[2]);
}

/// The names that the JSON of `derive` uses.
fn names(answer: &Value) -> Vocabulary {
    let variables = answer["joints"].as_array().into_iter().flatten();
    let numbered = (1..).zip(variables).fold(Vocabulary::new().open(true), |v, (i, joint)| {
        let symbol = Symbol::new(joint["name"].as_str().expect("a name"));
        if joint["kind"] == "R" { v.angle(i, symbol) } else { v.sliding(i, symbol) }
    });
    let steps = answer["forward"]["steps"].as_array().into_iter().flatten();
    steps.fold(numbered, |v, step| match step["name"].as_str() {
        Some(name) if !name.starts_with(['C', 'S']) => v.symbol(name),
        _ => v,
    })
}

/// Steps of the algorithm, put into each other, give the matrix: by proof, from the JSON alone.
#[test]
fn the_json_of_derive_reads_back() {
    for robot in ["staubli-rx90", "scara", "cylindrical-wrist", "kinova-jaco", "smart5-six-rail"] {
        let answer = json(&["derive", robot, "--json"]);
        let names = names(&answer);
        let read = |v: &Value| {
            let text = v.as_str().expect("text");
            parse(text, &names).unwrap_or_else(|e| panic!("{robot}: {text}: {e:?}"))
        };
        let mut values: Vec<(Symbol, Expr)> = vec![];
        for step in answer["forward"]["steps"].as_array().expect("steps") {
            let value = read(&step["value"]).substitute(|s| values.iter().find(|v| v.0 == s).map(|v| v.1));
            values.push((Symbol::new(step["name"].as_str().expect("a name")), value));
        }
        for row in 0..3 {
            for column in 0..4 {
                let name = format!("t{}{}", row + 1, column + 1);
                let found = values.iter().rev().find(|v| *v.0.name() == *name).expect("a result").1;
                let entry = read(&answer["forward"]["matrix"][row][column]);
                assert!(equal(found, entry).is_equal(), "{robot}: {name}");
            }
        }
    }
}

#[test]
fn every_robot_in_every_format() {
    for name in catalogue::names() {
        json(&["show", name, "--json"]);
        for format in ["terminal", "latex", "typst", "html", "json"] {
            let output = denavit(&["derive", name, "--format", format]);
            assert_eq!(output.status.code(), Some(0), "{name} as {format}: {}", stderr(&output));
            assert!(output.stderr.is_empty(), "{name} as {format}: {}", stderr(&output));
            assert_eq!(
                output.stdout,
                denavit(&["derive", name, "--format", format]).stdout,
                "{name}: not the same twice"
            );
        }
    }
}

#[test]
fn all_errors_of_a_table_at_once_each_with_its_place() {
    let table = "convention: standard\n\n| j | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | d1 | 0 | 9O° |\n| 2 | θ2 | q2 | $ | 0 |\n";
    let output = fed(&["derive", "-"], table);
    assert_eq!(output.status.code(), Some(3));
    let text = stderr(&output);
    for place in ["-:5:", "-:6:"] {
        assert!(text.contains(place), "{text}");
    }
    assert!(text.matches("error:").count() >= 2, "{text}");
}

#[test]
fn frames_of_a_table_on_standard_input() {
    let table = "convention: standard\n\n| j | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | 0.5 | 0 |\n| 2 | q2 | 0 | 0.3 | 0 |\n";
    let output = fed(&["fk", "-", "-q", "0,0", "--frames", "all", "--json"], table);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("0.8"), "{}", stdout(&output));
}

#[test]
fn hostile_names_stay_text() {
    let robot = "name = '''</title><script>alert(1)</script> \\input{x} #panic()'''\nconvention = \"standard\"\n\
                 [[joints]]\ntheta = \"q1\"\na = 1\n";
    let folder = std::env::temp_dir().join(format!("denavit-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("hostile.toml");
    std::fs::write(&file, robot).expect("a file");
    let file = file.to_str().expect("UTF-8");
    let html = stdout(&denavit(&["derive", file, "--format", "html"]));
    assert!(!html.contains("<script>") && html.contains("&lt;script&gt;"), "{html}");
    let latex = stdout(&denavit(&["derive", file, "--format", "latex"]));
    assert!(!latex.contains("\\input{x}"), "{latex}");
    let typst = stdout(&denavit(&["derive", file, "--format", "typst"]));
    assert!(typst.contains("#heading(level: 1, \"") && !typst.contains("\n#panic"), "{typst}");
    let _ = std::fs::remove_dir_all(&folder);
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_denavit"))
        .args(["derive", "franka-panda"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the command ends");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(output.stderr.is_empty());
}
