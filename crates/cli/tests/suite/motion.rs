//! `jacobian` and `path`: what they print, and what they refuse.

use crate::common::{fed, text};
use serde_json::Value;

#[track_caller]
fn printed(arguments: &[&str], code: i32) -> String {
    let output = fed(arguments, "");
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

#[track_caller]
fn json(arguments: &[&str], code: i32) -> Value {
    let value: Value = serde_json::from_str(&printed(arguments, code)).expect("one JSON value");
    assert_eq!(value["schema"], 1);
    value
}

#[track_caller]
fn refused(arguments: &[&str], code: i32, says: &str) {
    let output = fed(arguments, "");
    let why = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {why}");
    assert!(why.contains(says), "{arguments:?}: {why}");
}

#[test]
fn a_jacobian_in_numbers() {
    let q = "0.1, -0.5, 0.7, 0.2, 0.4, 0.3";
    let found = json(&["jacobian", "ur5", "-q", q, "--json"], 0);
    assert_eq!(found["frame"], "base");
    assert_eq!(found["rows"], serde_json::json!(["vx", "vy", "vz", "wx", "wy", "wz"]));
    let rows = found["jacobian"].as_array().expect("rows");
    assert_eq!(rows.len(), 6);
    // Joint 1 turns about the base's z axis.
    let column: Vec<f64> = rows.iter().filter_map(|r| r[0].as_f64()).collect();
    assert_eq!(column[3..], [0.0, 0.0, 1.0]);
    assert_eq!(found["rank"], 6);
    // The same line in a stream, to the last bit.
    let output = fed(&["jacobian", "ur5", "--input", "-"], "[0.1,-0.5,0.7,0.2,0.4,0.3]\n[1]\n");
    assert_eq!(output.status.code(), Some(3));
    let lines: Vec<Value> =
        text(&output.stdout).lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    assert_eq!(lines.len(), 2);
    for (a, b) in rows.iter().zip(lines[0]["jacobian"].as_array().expect("rows")) {
        for (x, y) in a.as_array().into_iter().flatten().zip(b.as_array().into_iter().flatten()) {
            let (x, y) = (x.as_f64().expect("a number"), y.as_f64().expect("a number"));
            assert!((x - y).abs() < 1e-14);
        }
    }
    assert!(lines[1]["error"].as_str().is_some_and(|e| e.contains("1 value, the robot has 6 joints")));
}

#[test]
fn joint_velocities_give_the_twist() {
    let q = "0.1, -0.5, 0.7, 0.2, 0.9, 0.3";
    let found = json(&["jacobian", "ur5", "-q", q, "--twist", "0.1,0,0,0,0,-", "--json"], 0);
    let achieved = &found["joint_rates"]["achieved"];
    assert!((achieved[0].as_f64().expect("a number") - 0.1).abs() < 1e-9);
    let rates: Vec<String> =
        found["joint_rates"]["rates"].as_array().expect("rates").iter().map(ToString::to_string).collect();
    let back = json(&["jacobian", "ur5", "-q", q, "--rates", &rates.join(","), "--json"], 0);
    assert!((back["twist"][0].as_f64().expect("a number") - 0.1).abs() < 1e-9);
}

#[test]
fn singularities_in_every_format() {
    let found = json(&["jacobian", "staubli-rx90", "--explain", "--json"], 0);
    assert_eq!(found["determinants"][0]["determinant"], "D3*RL4*C3*S5*(D3*C2 - RL4*S23)");
    assert_eq!(found["complete"], true);
    assert_eq!(found["singularities"][1]["example"]["why"], "axes 4 and 6 lie on one line");
    let latex = printed(&["jacobian", "staubli-rx90", "--explain", "--format", "latex"], 0);
    assert!(latex.contains("\\det J = ") && latex.contains("\\begin{bmatrix}"));
    let html = printed(&["jacobian", "staubli-rx90", "--explain", "--format", "html"], 0);
    assert!(html.contains("<mtable>") && html.contains("<title>Jacobian of the"));
    let typst = printed(&["jacobian", "staubli-rx90", "--explain", "--format", "typst"], 0);
    assert!(typst.contains("mat("));
}

#[test]
fn refusals() {
    refused(&["jacobian", "ur5"], 2, "say where the joints are");
    refused(&["jacobian", "ur5", "-q", "0,0,0,0,0,0", "--twist", "1,2"], 2, "2 values given, 6 needed");
    refused(&["jacobian", "ur5", "-q", "0,0,0,0,0,0", "--frame", "9"], 2, "a frame from 0 to 6");
    refused(&["jacobian", "ur5", "-q", "0,0,0,0,0,0", "--of", "base"], 2, "the base does not move");
    refused(&["path", "ur5", "-q", "0,0,0,0,0,0"], 2, "say where the path goes");
    refused(&["path", "ur5", "--line", "+0.1,0,0"], 2, "say where the path starts");
    refused(&["path", "ur5", "-q", "0,0,0,0,0,0", "--arc", "1,2,3"], 2, "a point and a pose");
    let start = ["path", "ur5", "-q", "0,0,0,0,0,0"];
    let one = ["--joint", "1,1,1,1,1,1"];
    refused(&[&start[..], &one, &["--velocity", "1,2"]].concat(), 2, "2 values");
    refused(&[&start[..], &one, &["--jerk", "10"]].concat(), 2, "are needed too");
    refused(&[&start[..], &one, &["--duration", "0.1"]].concat(), 1, "its limit is");
    refused(&[&start[..], &["--line", "-0.1,0,0"]].concat(), 2, "a displacement with a plus");
    refused(&["jacobian", "ur5", "--symbolic", "--frame", "shortest", "--at", "3"], 2, "leave --at away");
    refused(&["path", "ur5", "-q", "0,0,0,0,0,0", "--line", "+0.1,0,0", "--dt", "0"], 2, "positive number");
    refused(
        &["path", "ur5", "-q", "0,0,0,0,0,0", "--joint", "1,1,1,1,1,1", "--velocity", "1,2"],
        2,
        "2 values",
    );
}

const START: &str = "0,-40deg,100deg,0,30deg,0";

#[test]
fn a_line_is_sampled_as_asked() {
    let line =
        ["path", "staubli-rx90", "-q", START, "--line", "+0.1,0,-0.1", "--duration", "1", "--dt", "0.1"];
    let csv = printed(&[&line[..], &["--format", "csv"]].concat(), 0);
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 12);
    assert!(lines[0].starts_with("t,q1,") && lines[0].ends_with(",manipulability"));
    assert!(lines.iter().all(|l| l.split(',').count() == 1 + 18 + 3 + 9 + 1));
    let position = |line: &str| -> Vec<f64> {
        line.split(',').skip(19).take(3).map(|x| x.parse().expect("a number")).collect()
    };
    let (a, b, c) = (position(lines[1]), position(lines[6]), position(lines[11]));
    for k in 0..3 {
        assert!((f64::midpoint(a[k], c[k]) - b[k]).abs() < 2e-5, "the middle of the line");
    }
    let found = json(&[&line[..], &["--json"]].concat(), 0);
    let kinds: Vec<&str> =
        found["events"].as_array().expect("events").iter().filter_map(|e| e["kind"].as_str()).collect();
    assert_eq!(kinds, ["singular", "singular"]);
    assert_eq!(found["certified"], true);
}

#[test]
fn a_line_out_of_reach_says_so() {
    let found = json(&["path", "staubli-rx90", "-q", START, "--line", "+2,0,0", "--json"], 1);
    assert!(found["reached"].as_f64().is_some_and(|r| r > 0.1 && r < 1.0));
    let end = found["events"].as_array().and_then(|e| e.last()).expect("an end");
    assert_eq!((&end["kind"], &end["reachable"]), (&Value::from("end"), &Value::from(false)));
    assert!(found["starts"].as_array().is_some_and(|s| s.len() > 1));
}

#[test]
fn joint_moves_keep_their_limits() {
    let way = ["path", "ur5", "-q", "0,0,0,0,0,0", "--joint", "1,0.5,-1,0.2,0,2"];
    let limits = ["--velocity", "1.5", "--acceleration", "4", "--jerk", "30", "--json"];
    let found = json(&[&way[..], &limits].concat(), 0);
    let samples = found["samples"].as_array().expect("samples");
    for s in samples {
        let within = |key: &str, bound: f64| {
            s[key].as_array().into_iter().flatten().all(|x| x.as_f64().is_some_and(|x| x.abs() <= bound))
        };
        assert!(within("velocity", 1.5 + 1e-9) && within("acceleration", 4.0 + 1e-9));
    }
    let last = samples.last().expect("a sample");
    assert!((last["q"][5].as_f64().expect("a number") - 2.0).abs() < 1e-9);
}

#[test]
fn way_points_from_a_file() {
    let output = fed(
        &["path", "ur5", "--via", "-", "--json"],
        "[0,-1,1,0,1,0]\n[0.3,-1,1.2,0,1,0]\n\n[0.5,-0.7,1,0,1,0.4]\n",
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let wrong = fed(&["path", "ur5", "--via", "-"], "[0,-1,1,0,1,0]\n[1,2]\nhello\n");
    assert_eq!(wrong.status.code(), Some(3));
    let why = text(&wrong.stderr);
    assert!(why.contains("-:2: 2 values") && why.contains("-:3: not JSON"), "{why}");
}

/// The plot is SVG with a title, three panels and marks.
#[test]
fn a_plot() {
    let file = std::env::temp_dir().join(format!("denavit-plot-{}.svg", std::process::id()));
    let name = file.to_str().expect("a path");
    printed(&["path", "staubli-rx90", "-q", START, "--line", "+0.1,0,-0.1", "--plot", name], 0);
    let svg = std::fs::read_to_string(&file).expect("it was written");
    std::fs::remove_file(&file).expect("it can be removed");
    assert!(svg.starts_with("<svg") && svg.contains("manipulability") && svg.contains("Stäubli RX-90"));
    // Six lines and their samples in two legends, one line, and what is not a line of the plot.
    assert!(svg.matches("stroke-width=\"1.2\"").count() >= 25, "{svg}");
    assert!(svg.contains("joint velocities / ° per second") && !svg.contains("slides"));
}
