//! `denavit ik`: solutions, derivations, refusals, as the built command prints them.

use crate::common::{fed, text};
use serde_json::Value;

/// Exit code, standard output, standard error.
fn ik(arguments: &[&str]) -> (i32, String, String) {
    let all: Vec<&str> = ["ik"].iter().chain(arguments).copied().collect();
    let output = fed(&all, "");
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

fn json(arguments: &[&str], code: i32) -> Value {
    let all: Vec<&str> = arguments.iter().chain(&["--json"]).copied().collect();
    let (status, out, err) = ik(&all);
    assert_eq!(status, code, "{arguments:?}: {err}");
    let value: Value = serde_json::from_str(&out).expect("one JSON value");
    assert_eq!(value["schema"], 1);
    value
}

fn solutions(v: &Value) -> Vec<Vec<f64>> {
    let of = |s: &Value| s["q"].as_array().expect("a list").iter().filter_map(Value::as_f64).collect();
    v["solutions"].as_array().expect("a list").iter().map(of).collect()
}

const Q: [f64; 6] = [0.1, -1.0, 1.2, 0.3, 0.5, 0.2];

#[test]
fn all_solutions_of_a_pose() {
    let answer = json(&["ur5", "-q", "0.1,-1,1.2,0.3,0.5,0.2"], 0);
    assert_eq!((&answer["status"], &answer["complete"]), (&"solved".into(), &true.into()));
    let found = solutions(&answer);
    assert_eq!(found.len(), 8);
    assert!(found.iter().any(|q| q.iter().zip(Q).all(|(a, b)| (a - b).abs() < 1e-9)), "{found:?}");
    for s in answer["solutions"].as_array().expect("a list") {
        assert!(s["residual"].as_f64().is_some_and(|r| r < 1e-12));
        assert_eq!(s["multiplicity"], 1);
        assert_eq!(s["branch"].as_str().map(|b| b.split(' ').count()), Some(3));
    }
    // The same pose, as a matrix and as position and angles.
    let pose = answer["pose"].to_string();
    assert_eq!(solutions(&json(&["ur5", "--pose", &pose], 0)).len(), 8);
    let fk = fed(&["fk", "ur5", "-q", "0.1,-1,1.2,0.3,0.5,0.2", "--orientation", "rpy", "--json"], "");
    let fk: Value = serde_json::from_slice(&fk.stdout).expect("JSON");
    let at = |k: usize| fk["pose"][k][3].to_string();
    let angle = |k: usize| fk["orientation"]["values"][k].to_string();
    let words = [at(0), at(1), at(2), angle(0), angle(1), angle(2)].join(", ");
    let again = solutions(&json(&["ur5", "--pose", &words], 0));
    assert!(again.iter().any(|q| q.iter().zip(Q).all(|(a, b)| (a - b).abs() < 1e-9)), "{again:?}");
}

#[test]
fn a_table_to_read() {
    let (code, out, _) = ik(&["ur5", "-q", "0.1,-1,1.2,0.3,0.5,0.2"]);
    assert_eq!(code, 0);
    assert!(
        out.contains("8 solutions for") && out.contains("shoulder+ wrist") && out.contains("← -q"),
        "{out}"
    );
    // Units, as in fk.
    let (code, out, err) = ik(&["staubli-rx90", "--pose", "400 mm, 100mm, 0.5, 10 deg, 80deg, 0"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("8 solutions") || out.contains("4 solutions"), "{out}");
}

#[test]
fn unreachable_is_an_answer() {
    let (code, out, err) = ik(&["ur5", "--pose", "5, 0, 0, 0, 0, 0"]);
    assert_eq!(code, 1);
    assert!(out.contains("no solution") && err.contains("unreachable"), "{out}{err}");
    let answer = json(&["ur5", "--pose", "5, 0, 0, 0, 0, 0"], 1);
    assert_eq!((&answer["status"], &answer["solutions"]), (&"unreachable".into(), &Value::Array(vec![])));
    // A hand that always points down cannot point aside.
    let (code, _, err) = ik(&["scara", "--pose", "0.5, 0, 0, 90deg, 0, 0"]);
    assert!(code == 1 && err.contains("cannot take this pose") && err.contains("meets"), "{err}");
}

#[test]
fn families_where_the_hand_can_stand_still() {
    let answer = json(&["staubli-rx90", "-q", "0.1,0.2,0.3,0.4,0,0.5"], 0);
    let families = answer["families"].as_array().expect("a list");
    assert!(!families.is_empty(), "{answer}");
    let direction = &families[0]["direction"];
    assert_eq!(direction.as_array().map(Vec::len), Some(6));
    let (_, out, _) = ik(&["staubli-rx90", "-q", "0.1,0.2,0.3,0.4,0,0.5"]);
    assert!(out.contains("the hand stands still while q4 by"), "{out}");
}

#[test]
fn given_joints() {
    let answer = json(&["franka-panda", "-q", "0.1,0.2,0.3,-1.4,0.5,1.6,0.7", "--given", "q7"], 0);
    assert!((answer["given"]["q7"].as_f64().expect("a number") - 0.7).abs() < 1e-12, "{answer}");
    assert!(solutions(&answer).iter().all(|q| (q[6] - 0.7).abs() < 1e-12));
    let (code, _, err) = ik(&["franka-panda", "--pose", "0.4, 0, 0.5, 180deg, 0, 0", "--given", "q7"]);
    assert!(code <= 1 && err.contains("--given q7=30deg"), "{err}");
    let (code, _, err) = ik(&["ur5", "--given", "q9"]);
    assert!(code == 2 && err.contains("no joint `q9`"), "{err}");
    let (code, _, err) = ik(&["ur5", "--given", "q6"]);
    assert!(code == 2 && err.contains("no joint can be given"), "{err}");
}

#[test]
fn lines_in_lines_out() {
    let pose = json(&["ur5", "-q", "0.1,-1,1.2,0.3,0.5,0.2"], 0)["pose"].to_string();
    let input = format!("{pose}\n\n[1,2]\n{pose}\n");
    let output = fed(&["ik", "ur5", "--input", "-"], &input);
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let lines: Vec<Value> = text.lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    assert_eq!(output.status.code(), Some(3));
    assert_eq!(lines.len(), 3);
    assert_eq!(solutions(&lines[0]).len(), 8);
    assert_eq!(lines[1]["line"], 3);
    assert_eq!(lines[0], lines[2]);
}

#[test]
fn derivations() {
    let (code, out, _) = ik(&["ur5"]);
    assert!(
        code == 0 && out.contains("at most 8 solutions") && out.contains("needs px² + py² ≥ d4²"),
        "{out}"
    );
    let (_, out, _) = ik(&["ur5", "--explain"]);
    assert!(out.contains("q1 = atan2(px, −py) + κ1·atan2(R, d4)") && out.contains("Step 6. q2"), "{out}");
    let (_, out, _) = ik(&["ur5", "--symbolic"]);
    assert!(out.contains("q4 = q234 − q2 − q3") && !out.contains("Step 6"), "{out}");
    let (_, out, _) = ik(&["ur5", "--explain", "--format", "latex"]);
    assert!(
        out.contains("\\operatorname{atan2}") && out.contains("p_{x}") && out.contains("\\tag{1}"),
        "{out}"
    );
    assert_eq!(out.matches("\\begin").count(), out.matches("\\end").count());
    let (_, out, _) = ik(&["ur5", "--explain", "--format", "typst"]);
    assert!(out.contains("op(\"atan2\")") && out.contains("#sym.checkmark"), "{out}");
    let (_, out, _) = ik(&["ur5", "--explain", "--format", "html"]);
    for tag in ["math", "ul", "li", "p", "div", "mrow", "msub"] {
        let open = out.matches(&format!("<{tag}>")).count() + out.matches(&format!("<{tag} ")).count();
        assert_eq!(open, out.matches(&format!("</{tag}>")).count(), "{tag}");
    }
    let value = json(&["ur5", "--explain"], 0);
    assert_eq!(value["proof"], "proved");
    assert_eq!(value["max_solutions"], 8);
    assert_eq!(value["steps"].as_array().map(Vec::len), Some(6));
    assert_eq!(value["steps"][0]["solution"][1]["left"], "q1");
    assert_eq!(value["joints"][0]["right"], "q234 - q2 - q3");
}

#[test]
fn refusals() {
    let (code, out, err) = ik(&["oblique-6r"]);
    assert!(code == 4 && out.contains("not found") && err.contains("no closed form"), "{out}{err}");
    let (code, _, err) = ik(&["oblique-6r", "--pose", "9,0,0,0,0,0"]);
    assert!(code == 1 && err.contains("unreachable"), "{err}");
    let value = json(&["oblique-6r"], 4);
    assert_eq!(value["status"], "refused");
    for (arguments, says) in [
        (["ur5", "--pose", "1,2"], "2 values; a pose is x, y, z, roll, pitch, yaw"),
        (["ur5", "--pose", "[[1,0,0,0],[0,1,0,0],[0,0,2,0]]"], "--pose"),
        (["ur5", "--pose", "1,2,x,0,0,0"], "`x`"),
    ] {
        let (code, _, err) = ik(&arguments);
        assert!(code == 2 && err.contains(says), "{err}");
    }
    let (code, _, err) = ik(&["prrrrp", "--pose", "1,0,0,0,0,0"]);
    assert!(code == 3 && err.contains("no value for"), "{err}");
}

/// Arms without a closed form, redundant ones, nearly special ones.
#[test]
fn every_arm() {
    let crx = json(&["fanuc-crx10ia-l", "-q", "20deg,30deg,-40deg,50deg,60deg,70deg"], 0);
    assert_eq!((&crx["method"], &crx["complete"]), (&"elimination".into(), &true.into()));
    assert_eq!(solutions(&crx).len(), 8);
    let iiwa = json(&["kuka-iiwa-14", "-q", "0.1,0.2,0.3,-1.5,0.5,1.2,0.7", "--near", "0,0,0,-1,0,1,0"], 0);
    assert_eq!(iiwa["families"].as_array().map(Vec::len), Some(8));
    assert_eq!(iiwa["families"][0]["free"][0], "ψ");
    assert!(iiwa["nearest"]["within_limits"] == true && iiwa["nearest"]["distance"].as_f64() < Some(1.0));
    let some_are_within =
        iiwa["families"].as_array().expect("a list").iter().any(|f| f["feasible"].is_array());
    assert!(some_are_within);
    let one = json(&["franka-panda", "-q", "0.1,0.2,0.3,-1.5,0.5,1.2,0.7", "--one", "--best", "limits"], 0);
    assert_eq!((solutions(&one).len(), &one["best"]["within_limits"]), (1, &true.into()));
    let turns = json(&["ur5", "-q", "0.1,-1,1.2,0.3,0.5,0.2", "--near", "6.2,-1,1,0,0,0"], 0);
    assert_eq!(turns["solutions"][0]["turns"].as_array().map(Vec::len), Some(6));
    assert!(turns["nearest"]["q"][0].as_f64() > Some(3.2), "{}", turns["nearest"]);
}

/// What is nearly special is said and solved as it is; made special on request.
#[test]
fn nearly_special() {
    let text = "name = \"N\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\nd = 0.3\nalpha = 1.5708\n[[joints]]\ntheta = \"q2\"\na = 0.4\n[[joints]]\ntheta = \"q3\"\na = 0.3\nalpha = 1e-4\n[[joints]]\ntheta = \"q4\"\nd = 0.1\nalpha = \"90 deg\"\n[[joints]]\ntheta = \"q5\"\nd = 0.1\nalpha = \"-90 deg\"\n[[joints]]\ntheta = \"q6\"\nd = 0.1\n";
    let path = std::env::temp_dir().join(format!("denavit-nearly-{}.toml", std::process::id()));
    std::fs::write(&path, text).expect("a file");
    let robot = path.to_str().expect("a name");
    let q = "0.1,-1,1.2,0.3,0.5,0.2";
    let (code, _, err) = ik(&[robot, "-q", q]);
    assert!(code == 0 && err.contains("axes 3 and 4 are nearly parallel: 1.000e-4 rad off"), "{err}");
    let as_it_is = json(&[robot, "-q", q], 0);
    assert_eq!((&as_it_is["method"], &as_it_is["complete"]), (&"elimination".into(), &true.into()));
    let ideal = json(&[robot, "-q", q, "--idealise=0.001"], 0);
    assert_eq!(ideal["method"], "closed form");
    assert_eq!(ideal["idealised"]["changes"].as_array().map(Vec::len), Some(2));
    assert!(ideal["idealised"]["position_error"].as_f64() < Some(1e-3));
    assert_eq!(solutions(&ideal).len(), solutions(&as_it_is).len());
    std::fs::remove_file(&path).expect("it was there");
}

/// A thousand lines, reachable, out of reach, singular and malformed ones: an answer each, in order.
#[test]
fn a_thousand_poses() {
    let pose = |q: &str| json(&["ur5", "-q", q], 0)["pose"].to_string();
    let singular = pose("0.1,-1,1.2,0.3,0,0.2");
    let far = "[[1,0,0,9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]".to_string();
    let bent = "[[1,0.5,0,0.4],[0,1,0,0],[0,0,1,0],[0,0,0,1]]".to_string();
    let kinds = [pose("0.1,-1,1.2,0.3,0.5,0.2"), far, singular, bent, "[1,2]".into(), "[[NaN]]".into()];
    let lines: Vec<&str> = (0..1000).map(|k| kinds[k % kinds.len()].as_str()).collect();
    let output = fed(&["ik", "ur5", "--input", "-"], &(lines.join("\n") + "\n"));
    assert_eq!(output.status.code(), Some(3));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let answers: Vec<Value> = text.lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    assert_eq!(answers.len(), 1000);
    for (k, answer) in answers.iter().enumerate() {
        match k % kinds.len() {
            0 => assert_eq!(solutions(answer).len(), 8),
            1 => assert_eq!(answer["status"], "unreachable"),
            2 => assert!(!answer["families"].as_array().expect("a list").is_empty()),
            _ => assert_eq!((&answer["line"], answer["error"].is_string()), (&(k + 1).into(), true)),
        }
    }
}

/// A path: each pose takes the branch of the one before.
#[test]
fn a_path_is_followed() {
    let at = |k: u32| format!("{},-1,1.2,0.3,0.5,0.2", 0.1 + 0.05 * f64::from(k));
    let poses: Vec<String> = (0..20).map(|k| json(&["ur5", "-q", &at(k)], 0)["pose"].to_string()).collect();
    let output =
        fed(&["ik", "ur5", "--input", "-", "--follow", "--near", &at(0)], &(poses.join("\n") + "\n"));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let answers: Vec<Value> = text.lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    assert_eq!(answers.len(), 20);
    for (k, answer) in (0..).zip(&answers) {
        let q1 = answer["nearest"]["q"][0].as_f64().expect("a number");
        assert!((q1 - 0.1 - 0.05 * f64::from(k)).abs() < 1e-6, "{answer}");
        assert!(answer["nearest"]["distance"].as_f64() < Some(0.06));
    }
}

/// Only the position, or the position and a direction.
#[test]
fn goals() {
    let answer = json(
        &[
            "articulated-3r",
            "-q",
            "0.3,0.4,0.5",
            "--goal",
            "position",
            "--set",
            "d1=0.5",
            "--set",
            "a2=0.4",
            "--set",
            "a3=0.3",
        ],
        0,
    );
    assert_eq!(solutions(&answer).len(), 4, "{answer}");
}
