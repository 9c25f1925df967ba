//! What a door says of its own accord: where a branch is left, what was left out, how a number was read.

use crate::common::{File, fed, text};
use serde_json::Value;

/// Exit code, standard output, standard error.
fn run(arguments: &[&str], input: &str) -> (i32, String, String) {
    let output = fed(arguments, input);
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

#[track_caller]
fn json(arguments: &[&str], code: i32) -> Value {
    let all: Vec<&str> = arguments.iter().chain(&["--json"]).copied().collect();
    let (status, out, err) = run(&all, "");
    assert_eq!(status, code, "{arguments:?}: {err}");
    serde_json::from_str(&out).expect("one JSON value")
}

/// The answers to the poses of configurations, each followed from the one before.
fn followed(robot: &str, configurations: &[String]) -> (Vec<Value>, String) {
    let pose = |q: &String| json(&["fk", robot, "-q", q], 0)["pose"].to_string();
    let poses: Vec<String> = configurations.iter().map(pose).collect();
    let arguments = ["ik", robot, "--input", "-", "--follow", "--near", &configurations[0]];
    let (code, out, err) = run(&arguments, &(poses.join("\n") + "\n"));
    assert_eq!(code, 0, "{err}");
    (out.lines().map(|l| serde_json::from_str(l).expect("JSON")).collect(), err)
}

/// A joint driven over its limit, each in turn: where the joints do not go on as they went, the answer says so, and nowhere
/// else; the note says the same.
#[test]
fn following_says_where_it_leaves_the_branch() {
    for joint in [0, 3, 5] {
        let at = |k: u32| -> String {
            let mut q = [0.1, -1.0, 1.2, 0.3, 0.5, 0.2];
            q[joint] = 5.9 + 0.1 * f64::from(k);
            q.map(|x| x.to_string()).join(",")
        };
        let (answers, err) = followed("ur5", &(0..9).map(at).collect::<Vec<_>>());
        let q = |a: &Value| -> Vec<f64> {
            let list = a["nearest"]["q"].as_array().expect("a list");
            list.iter().filter_map(Value::as_f64).collect()
        };
        let mut jumps = 0;
        for pair in answers.windows(2) {
            let by = q(&pair[0]).iter().zip(q(&pair[1])).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let jump = &pair[1]["jump"];
            assert_eq!(by > 0.5, jump.is_object(), "joint {joint}: {by} {jump}");
            if jump.is_object() {
                jumps += 1;
                assert_eq!(jump["why"], "limit", "{jump}");
                let said = jump["text"].as_str().expect("words");
                assert!(said.contains("would pass its limit 360°") && err.contains(said), "{said}\n{err}");
            }
        }
        assert!(jumps > 0, "joint {joint} is driven over its limit");
    }
    // On the way of another test nothing jumps, and redundant arms go on along their self-motion.
    let way = |k: u32| format!("{},0.4,0.3,-1.4,0.5,1.6,0.7", 0.1 + 0.05 * f64::from(k));
    let (answers, err) = followed("franka-panda", &(0..6).map(way).collect::<Vec<_>>());
    assert!(answers.iter().all(|a| a["jump"].is_null()) && !err.contains("branch"), "{err}");
}

/// Copies within limits: as many as the joints' turns say, each within the limits, each with the pose.
#[test]
fn copies_within_the_limits_are_listed() {
    let answer = json(&["ik", "ur5", "-q", "0.1,-1,1.2,0.3,0.5,0.2"], 0);
    for s in answer["solutions"].as_array().expect("a list") {
        let turns = s["turns"].as_array().expect("a list");
        let of = |t: &Value| t[1].as_i64().unwrap_or(0) - t[0].as_i64().unwrap_or(0) + 1;
        let count: i64 = turns.iter().map(of).product();
        let copies = s["copies"].as_array().expect("a list");
        assert_eq!((s["copies_count"].as_i64(), copies.len() as i64), (Some(count), count));
        for copy in copies {
            for (x, y) in copy.as_array().expect("a list").iter().zip(s["q"].as_array().expect("a list")) {
                let (x, y) = (x.as_f64().expect("a number"), y.as_f64().expect("a number"));
                let turns = (x - y) / std::f64::consts::TAU;
                assert!((turns - turns.round()).abs() < 1e-9 && x.abs() <= std::f64::consts::TAU + 1e-9);
            }
        }
    }
    let (_, out, _) = run(&["ik", "ur5", "-q", "0.1,-1,1.2,0.3,0.5,0.2"], "");
    assert!(
        out.contains("whole turns away, within the limits: 504") && out.contains("and 496 more"),
        "{out}"
    );
}

/// With --limits nothing is outside of them, and what was left out is counted.
#[test]
fn only_what_the_limits_allow() {
    let pose = json(&["ik", "abb-irb120", "-q", "0.1,0.2,0.3,0.4,0.5,0.6"], 0);
    let all = pose["solutions"].as_array().expect("a list");
    let within = all.iter().filter(|s| s["within_limits"] == true).count();
    let answer = json(&["ik", "abb-irb120", "-q", "0.1,0.2,0.3,0.4,0.5,0.6", "--limits"], 0);
    let some = answer["solutions"].as_array().expect("a list");
    assert_eq!((some.len(), answer["left_out"].as_u64()), (within, Some((all.len() - within) as u64)));
    assert!(within < all.len() && some.iter().all(|s| s["within_limits"] == true));
    let (_, out, _) = run(&["ik", "abb-irb120", "-q", "0.1,0.2,0.3,0.4,0.5,0.6", "--limits"], "");
    assert!(
        out.contains("outside the limits and left out") && !out.contains("outside the limits\n"),
        "{out}"
    );
}

/// Radians beyond a turn are said once, in every verb that takes joints; not where a value has a unit or may be so.
#[test]
fn radians_beyond_a_turn_are_said() {
    let said = |arguments: &[&str]| run(arguments, "").2.matches("is in radians").count();
    let q = ["-q", "30,45,0.1,0"];
    for verb in ["fk", "ik", "jacobian"] {
        assert_eq!(said(&[&[verb, "scara"][..], &q].concat()), 1, "{verb}");
    }
    assert_eq!(said(&["fk", "scara", "-q", "30deg,45°,0.1,3*pi"]), 0);
    assert_eq!(said(&["fk", "scara", "-q", "6,-6,0.1,0"]), 0);
    assert_eq!(said(&["fk", "scara", "-q", "30,45,0.1,0", "--quiet"]), 0);
    assert_eq!(said(&["path", "ur5", "-q", "0,0,0,0,0,90", "--joint", "1,0,0,0,0,0"]), 1);
    assert_eq!(said(&["ik", "ur5", "--pose", "0.4,0,0.3,180,0,0"]), 1);
}

/// Brackets and commas within a value belong to it.
#[test]
fn lists_of_values() {
    let q = |text: &str| {
        json(&["fk", "planar-3r", "-q", text, "--set", "a1=1", "--set", "a2=1", "--set", "a3=1"], 0)["q"]
            .clone()
    };
    let plain = q("1.5707963267948966,0.5,1.4142135623730951");
    for text in ["90°,1/2,sqrt(2)", "(90°, 1/2, sqrt(2))", "[90deg 0.5 sqrt(2)]", "((pi)/2; 1/2; (sqrt(2)))"]
    {
        assert_eq!(q(text), plain, "{text}");
    }
}

/// Rounding noise is shown as 0, and nothing else, however long the arm.
#[test]
fn long_arms_show_their_lengths() {
    for exponent in ["1e3", "1e150", "1e200", "1e308"] {
        let table =
            format!("name = \"L\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\nd = {exponent}\n");
        let file = File::new(&format!("long{exponent}.toml"), &table);
        let (code, out, err) = run(&["fk", file.name(), "-q", "0.5", "--quiet"], "");
        assert!(code == 0 && err.is_empty(), "{err}");
        let third: Vec<&str> = out.lines().filter(|l| l.contains(" 1 ") || l.contains(" 1e")).collect();
        let last = third.first().and_then(|l| l.split_whitespace().rev().nth(1)).unwrap_or_default();
        assert!(last == exponent || last == "1000", "{last} in {out}");
    }
}

/// Notes about a file can be left away; errors stay.
#[test]
fn quiet_leaves_notes_away() {
    let table = "name = \"F\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\nd = 502.87436\n[[joints]]\ntheta = \"q2\"\na = 300\n";
    let file = File::new("far.toml", table);
    let (_, _, err) = run(&["show", file.name()], "");
    assert!(err.contains("502.87436 m is a long way") && err.contains("write `300 mm`"), "{err}");
    // A number with many decimals was typed by no person.
    assert!(!err.contains("502.87436 mm"), "{err}");
    assert!(run(&["show", file.name(), "--quiet"], "").2.is_empty());
    let (code, _, err) = run(&["fk", file.name(), "-q", "1", "--quiet"], "");
    assert!(code == 2 && err.contains("2 joints"), "{err}");
}

/// The pose of joint values is that of the arm as it is, idealised or not.
#[test]
fn idealising_does_not_move_the_pose() {
    let table = "name = \"N\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\nd = 0.3\nalpha = 1.5708\n[[joints]]\ntheta = \"q2\"\na = 0.4\n[[joints]]\ntheta = \"q3\"\na = 0.3\nalpha = 1e-3\n[[joints]]\ntheta = \"q4\"\nd = 0.1\nalpha = \"90 deg\"\n[[joints]]\ntheta = \"q5\"\nd = 0.1\nalpha = \"-90 deg\"\n[[joints]]\ntheta = \"q6\"\nd = 0.1\n";
    let file = File::new("nearly.toml", table);
    let q = "0.1,-1,1.2,0.3,0.5,0.2";
    let pose = json(&["fk", file.name(), "-q", q], 0)["pose"].clone();
    let asked = json(&["ik", file.name(), "-q", q, "--idealise"], 0)["pose"].clone();
    for (a, b) in pose.as_array().into_iter().flatten().zip(asked.as_array().into_iter().flatten()) {
        for (x, y) in a.as_array().into_iter().flatten().zip(b.as_array().into_iter().flatten()) {
            assert!((x.as_f64().expect("x") - y.as_f64().expect("y")).abs() < 1e-12, "{pose} {asked}");
        }
    }
}

/// A document's own table gets values from the command line.
#[test]
fn a_checked_document_is_given_values() {
    let document = "convention: standard\n\n| j | theta | d | a | alpha |\n|---|---|---|---|---|\n| 1 | q1 | 0 | a1 | 0 |\n| 2 | q2 | 0 | a2 | 0 |\n\nθ1 = 60°, θ2 = 0°\n\nx = 1.5\n";
    let file = File::new("two.md", document);
    let (code, out, err) = run(&["check", file.name(), "--set", "a1=1", "--set", "a2=2"], "");
    assert_eq!(code, 0, "{out}{err}");
    let (code, out, err) = run(&["check", file.name(), "--set", "a1=1", "--set", "a2=3"], "");
    assert_eq!(code, 1, "{out}{err}");
    let (code, _, err) = run(&["check", file.name(), "--set", "b=3"], "");
    assert!(code == 3 && err.contains("they are a1, a2"), "{err}");
}

/// Angles of the orientation as formulas have the values of those in numbers.
#[test]
fn orientation_as_formulas() {
    use denavit_symbolic::parse::parse;
    use denavit_symbolic::vocabulary::Vocabulary;
    let q = [0.1, -1.0, 1.2, 0.3, 0.5, 0.2];
    for set in ["rpy", "zyz", "xyz", "zxz"] {
        let formulas = json(&["fk", "ur5", "--symbolic", "--orientation", set], 0)["orientation"].clone();
        assert_eq!(formulas["set"], set);
        let numbers = json(&["fk", "ur5", "-q", "0.1,-1,1.2,0.3,0.5,0.2", "--orientation", set], 0);
        let values = numbers["orientation"]["values"].as_array().expect("values");
        let names = set.parse::<denavit::geometry::OrientationSet>().expect("a set").names();
        for (name, value) in names.iter().zip(values) {
            let text = formulas["angles"][name].as_str().expect("a formula");
            let formula = parse(text, &denavit::catalogue::robot("ur5").expect("a robot").vocabulary())
                .or_else(|_| parse(text, &Vocabulary::new().open(true)))
                .expect("it is read");
            let at = |s: denavit_symbolic::Symbol| {
                s.name().strip_prefix('q').and_then(|n| n.parse::<usize>().ok()).map(|k| q[k - 1])
            };
            let x = formula
                .eval(|s| at(s).or_else(|| denavit::catalogue::robot("ur5")?.value(s)))
                .expect("a value");
            assert!((x - value.as_f64().expect("a number")).abs() < 1e-9, "{set} {name}");
        }
    }
    let (code, _, err) = run(&["fk", "ur5", "--symbolic", "--orientation", "quaternion"], "");
    assert!(code == 4 && err.contains("rpy and Euler sets"), "{err}");
}

/// A law whose acceleration jumps keeps no jerk; the others keep it, by differences of the samples.
#[test]
fn laws_keep_the_jerk() {
    let path = |law: &str| {
        let q = ["-q", "0,0,0,0,0,0", "--joint", "1,0.5,0,0,0,0", "--velocity", "2", "--acceleration", "5"];
        let rest = ["--jerk", "100", "--law", law, "--dt", "0.001", "--format", "json"];
        run(&[&["path", "ur5"], &q[..], &rest[..]].concat(), "")
    };
    for law in ["trapezoidal", "cubic"] {
        let (code, _, err) = path(law);
        assert!(code == 2 && err.contains("--law jerk-limited"), "{law}: {err}");
    }
    for law in ["quintic", "jerk-limited"] {
        let (code, out, err) = path(law);
        assert_eq!(code, 0, "{law}: {err}");
        let found: Value = serde_json::from_str(&out).expect("JSON");
        let samples = found["samples"].as_array().expect("samples");
        let at = |k: usize, what: &str| samples[k][what][0].as_f64().expect("a number");
        let jerk = |k: usize| (at(k, "acceleration") - at(k - 1, "acceleration")) / 1e-3;
        let most = (1..samples.len()).map(|k| jerk(k).abs()).fold(0.0, f64::max);
        assert!(most < 101.0 && at(0, "acceleration").abs() < 1e-9, "{law}: {most}");
    }
}

/// Three joints: the formulas of a position beside those of a pose; the same flag in both verbs, and a hint.
#[test]
fn positions_of_arms_with_three_joints() {
    let (code, out, _) = run(&["ik", "articulated-3r"], "");
    assert!(
        code == 0 && out.contains("The position alone (`--position`)") && out.contains("at most 4 solutions"),
        "{out}"
    );
    let values = ["--set", "d1=0.5", "--set", "a2=0.4", "--set", "a3=0.3"];
    let asked = |rest: &[&str]| run(&[&["ik", "articulated-3r"], &values[..], rest].concat(), "");
    let (code, out, _) = asked(&["-p", "0.3,0.2,0.7", "--position"]);
    assert!(code == 0 && out.contains("4 solutions"), "{out}");
    assert_eq!(asked(&["-p", "0.3,0.2,0.7", "--goal", "position"]).1, out);
    assert!(asked(&["-p", "0.3,0.2,0.7"]).2.contains("--position"));
    assert!(asked(&["-q", "0.3,0.4,0.5"]).2.contains("--position"));
    let (_, out, _) = run(&["ik", "articulated-3r", "--explain"], "");
    for said in ["One solution", "px = a2C1C2", "The position alone", "At most 4 solutions"] {
        assert!(out.contains(said), "{said}: {out}");
    }
    // An arm in a plane serves poses in the plane.
    assert!(!run(&["ik", "planar-3r"], "").1.contains("--position"));
    let (_, out, err) = run(&["jacobian", "articulated-3r", "--explain"], "");
    assert!(out.contains("never all 0 at once") && err.contains("--position"), "{out}{err}");
    let (_, out, _) = run(&["jacobian", "articulated-3r", "--explain", "--position"], "");
    assert!(
        out.contains("the point lies on axis 1")
            && !out.contains("body stands")
            && !out.contains("body at rest"),
        "{out}"
    );
}

/// What an arm holds at a number is put in, and stands among what a pose must meet.
#[test]
fn constants_of_the_pose() {
    let (code, out, _) = run(&["ik", "scara"], "");
    assert!(code == 0 && out.contains("must meet az = −1") && !out.contains("q3az"), "{out}");
    let (_, out, _) = run(&["ik", "scara", "--explain"], "");
    assert!(out.contains("q3 = −pz") && !out.contains("is the cosine of q1 + q2 − q4"), "{out}");
    // A hand that points up is out of reach for the reason that is said.
    let (code, _, err) =
        run(&["ik", "scara", "--set", "a1=0.4", "--set", "a2=0.3", "-p", "0.5,0,0,0,0,0"], "");
    assert!(code == 1 && err.contains("az = −1"), "{err}");
    let (_, out, _) = run(&["ik", "fanuc-crx10ia-l"], "");
    assert!(out.contains("no closed form") && !out.contains("proved"), "{out}");
}

/// Families: each once, named by a joint, within its limits, and which of them a configuration is in.
#[test]
fn families_are_named_and_bounded() {
    let (_, out, _) = run(&["ik", "franka-panda", "-q", "0,0,0,-1.5,0,1.5,0.7"], "");
    assert!(out.contains("-q is a member of family "), "{out}");
    let answer = json(&["ik", "franka-panda", "-q", "0,0,0,-1.5,0,1.5,0.7"], 0);
    let families = answer["families"].as_array().expect("a list");
    let lines: Vec<&Value> = families.iter().filter(|f| f["affine"] == true).collect();
    assert_eq!(lines.len(), 1, "q1 + q3 = 0, once: {lines:?}");
    assert!(lines[0]["free"][0].as_str().is_some_and(|name| name.starts_with('q')));
    let stretch = lines[0]["feasible"][0].as_array().expect("a stretch");
    assert!(
        stretch[0].as_f64() >= Some(-2.9 - 1e-9) && stretch[1].as_f64() <= Some(2.9 + 1e-9),
        "{stretch:?}"
    );
    for f in families {
        assert!(f["interval"].is_array(), "{f}");
    }
    // Two parameters: one family.
    let answer = json(&["ik", "smart5-six-rail", "-q", "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8"], 0);
    let families = answer["families"].as_array().expect("a list");
    assert_eq!(families.len(), 1);
    assert_eq!(
        (&families[0]["dimension"], families[0]["free"].as_array().map(Vec::len)),
        (&2.into(), Some(2))
    );
    let (_, out, _) = run(&["ik", "smart5-six-rail", "-q", "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8"], "");
    assert!(out.contains("2 parameters"), "{out}");
}

/// A point is turned and shifted, a free vector turned alone.
#[test]
fn points_and_free_vectors() {
    let (code, out, _) = run(&["derive", "planar-2r", "--point", "x, 0, 0", "--vector", "0, 1, 0"], "");
    assert!(code == 0 && out.contains("px = C12x + (a1C1 + a2C12)") && out.contains("vx = −S12"), "{out}");
    let (code, _, err) = run(&["derive", "planar-2r", "--point", "1, 2"], "");
    assert!(code == 2 && err.contains("three coordinates"), "{code} {err}");
}
