//! Every request of the page, answered natively: the same code that is compiled for it.

use crate::ask::{ask, far, numbers, told};
use serde_json::{Value, json};

/// A robot of the catalogue in hand: its file, what is known of it.
fn taken(name: &str) -> (Value, Value) {
    let file = told("open", json!({ "text": name, "kind": "robot" }))["file"].clone();
    let answer = told("edit", json!({ "file": file }));
    assert!(answer["robot"].is_object(), "{name}: {answer}");
    (file, answer["robot"].clone())
}

#[test]
fn every_robot_of_the_catalogue_is_drawn_and_solved() {
    let list = told("catalogue", json!({}));
    let robots = list["robots"].as_array().expect("a list");
    assert!(robots.len() > 90);
    for robot in robots {
        let name = robot["name"].as_str().expect("a name");
        let (_, model) = taken(name);
        let joints = model["joints"].as_array().expect("joints").len();
        assert_eq!(robot["joints"].as_str().map(str::len), Some(joints), "{name}");
        let scene = told("scene", json!({ "q": model["q"] }));
        assert_eq!(scene["frames"].as_array().map(Vec::len), model["rows"].as_u64().map(|n| n as usize + 2));
        // The steps of each row lead from its frame to the next.
        let (rows, frames) =
            (scene["rows"].as_array().expect("rows"), scene["frames"].as_array().expect("frames"));
        for (k, row) in rows.iter().enumerate() {
            assert!(far(&row[0]["frame"], &frames[k]) < 1e-12, "{name}: row {k}");
        }
        let answer = told("solve", json!({ "q": model["q"], "near": model["q"] }));
        assert!(far(&answer["pose"], frames.last().expect("a tool")) < 1e-12, "{name}");
        let nearest = told("scene", json!({ "q": answer["nearest"]["q"] }));
        let tool = nearest["frames"].as_array().and_then(|f| f.last().cloned()).expect("a tool");
        assert!(far(&tool, &answer["pose"]) < 1e-6, "{name}: {}", answer["nearest"]);
    }
}

#[test]
fn a_robot_file_comes_back_as_it_was() {
    for name in ["staubli-rx90", "ur5", "stanford", "franka-panda"] {
        let (file, _) = taken(name);
        let text = told("write", json!({ "file": file }))["text"].clone();
        let again = told("open", json!({ "text": text, "kind": "toml" }));
        assert_eq!(again["file"], file, "{name}");
        assert_eq!(again["findings"], told("open", json!({ "text": name, "kind": "robot" }))["findings"]);
    }
}

#[test]
fn an_error_is_found_in_its_cell() {
    let (mut file, _) = taken("staubli-rx90");
    file["joints"][2]["d"] = "D3 +".into();
    file["joints"][4]["alpha"] = "90 dg".into();
    file["parameters"][1]["value"] = "450 kg".into();
    let answer = told("edit", json!({ "file": file }));
    assert!(answer["robot"].is_null());
    let cells: Vec<&str> =
        answer["findings"].as_array().into_iter().flatten().filter_map(|f| f["cell"].as_str()).collect();
    for wanted in ["joints.2.d", "joints.4.alpha", "parameters.1.value"] {
        assert!(cells.contains(&wanted), "{wanted}: {cells:?}");
    }
    // The robot before is still there.
    told("scene", json!({ "q": [0, 0, 0, 0, 0, 0] }));
}

#[test]
fn any_text_in_any_cell_is_an_answer() {
    let hostile =
        ["", "\"", "\\", "]]\n[joints", "\u{0}", "é\u{301}", "q99", "1e999", "((((", "{}", "'''", "x = 1"];
    for text in hostile {
        let (mut file, _) = taken("scara");
        file["name"] = text.into();
        file["joints"][0]["theta"] = text.into();
        file["joints"][1]["limits"] = json!([text, text]);
        file["parameters"] = json!([{ "name": text, "value": text }, { "name": text, "value": "" }]);
        file["poses"] = json!([{ "name": text, "values": [text] }]);
        file["tool"] = json!({ "xyz": [text, "0", "0"] });
        let answer = told("edit", json!({ "file": file }));
        assert!(answer["findings"].is_array(), "{text:?}: {answer}");
    }
}

#[test]
fn what_is_no_request_is_refused() {
    for (op, input) in [
        ("nothing", json!({})),
        ("scene", json!({ "q": "three" })),
        ("scene", json!({ "q": [1, 2] })),
        ("scene", json!({ "q": [1e300, 0, 0, 0, 0, 0] })),
        ("solve", json!({})),
        ("solve", json!({ "pose": [[1, 0], [0, 1]] })),
        ("angles", json!({ "pose": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], "set": "xxy" })),
        ("pose", json!({ "xyz": [0, 0, 0], "set": "zyz", "values": [1] })),
        ("open", json!({ "text": "no-such-robot", "kind": "robot" })),
        ("formulas", json!({ "topic": "weather", "q": [0, 0, 0, 0, 0, 0] })),
        ("code", json!({ "language": "cobol" })),
        ("report", json!({ "format": "docx", "language": "en", "q": [0, 0, 0, 0, 0, 0] })),
    ] {
        taken("staubli-rx90");
        let answer = ask(op, input);
        assert!(answer["error"].is_string(), "{op}: {answer}");
    }
    assert!(serde_json::from_str::<Value>(&denavit_web::answer("{")).expect("JSON")["error"].is_string());
}

#[test]
fn a_pasted_table_is_read_in_the_convention_that_is_said() {
    let table = "| j | alpha | a | theta | d |\n|---|---|---|---|---|\n| 1 | 0 | 0 | q1 | 0.4 |\n| 2 | -90° | 0.025 | q2 | 0 |\n";
    let open =
        |convention: Value| told("read", json!({ "text": table, "kind": "any", "convention": convention }));
    assert_eq!(open("craig".into())["file"]["convention"], "craig");
    let without = open(Value::Null);
    assert!(without["file"].is_null(), "{without}");
    assert!(
        without["findings"][0]["message"].as_str().is_some_and(|m| m.contains("convention")),
        "{without}"
    );
}

#[test]
fn another_convention_is_proved_the_same() {
    for to in ["standard", "craig", "khalil"] {
        taken("staubli-rx90");
        let answer = told("convert", json!({ "to": to }));
        assert_eq!(answer["proved"], true, "{to}");
        let before = told("scene", json!({ "q": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6] }));
        told("edit", json!({ "file": answer["file"] }));
        let after = told("scene", json!({ "q": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6] }));
        let tool =
            |scene: &Value| scene["frames"].as_array().and_then(|f| f.last().cloned()).expect("a tool");
        assert!(far(&tool(&before), &tool(&after)) < 1e-12, "{to}");
    }
}

#[test]
fn a_pose_beyond_reach_is_followed_to_the_nearest() {
    taken("puma560");
    let pose = json!([[1, 0, 0, 9], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    let answer = told("solve", json!({ "pose": pose, "near": [0, 0, 0, 0, 0, 0] }));
    let distance = answer["obstacle"]["distance"].as_f64().expect("a distance");
    assert!(distance > 7.0, "{distance}");
    let reached = told("scene", json!({ "q": answer["nearest"]["q"] }));
    let tool = reached["frames"].as_array().and_then(|f| f.last().cloned()).expect("a tool");
    assert!(far(&tool, &answer["stop"]["pose"]) < 1e-6);
}

#[test]
fn formulas_come_in_every_notation_with_their_numbers() {
    let (_, model) = taken("staubli-rx90");
    for topic in ["table", "links", "forward", "algorithm", "inverse", "jacobian", "singularities"] {
        let answer = told("formulas", json!({ "topic": topic, "q": model["q"] }));
        let blocks = answer["blocks"].as_array().expect("blocks");
        assert!(!blocks.is_empty(), "{topic}");
        let mut formulas: Vec<&Value> = vec![];
        for block in blocks {
            formulas.extend(block.get("formula"));
            formulas.extend(block["formulas"].as_array().into_iter().flatten());
        }
        assert_eq!(topic == "table", formulas.is_empty(), "{topic}");
        for formula in &formulas {
            for notation in ["mathml", "text", "latex", "typst", "python", "c"] {
                assert!(formula[notation].as_str().is_some_and(|t| !t.is_empty()), "{topic}: {formula}");
            }
        }
        if topic == "table" {
            continue;
        }
        let about = answer["joints"].as_object().expect("names");
        assert_eq!(about["q3"], json!([2]), "{topic}");
        if topic == "forward" {
            assert_eq!(about["C23"], json!([1, 2]));
        }
    }
    // The algorithm's results are the pose.
    let q = [0.3, -0.7, 0.9, 0.2, 1.1, -0.4];
    let values = told("values", json!({ "topic": "forward", "q": q }))["values"].clone();
    let tool = told("solve", json!({ "q": q }))["pose"].clone();
    for (row, column) in [(0, 0), (0, 3), (1, 1), (2, 3)] {
        let name = format!("t{}{}", row + 1, column + 1);
        let (shown, right) =
            (values[&name].as_f64().expect("a number"), tool[row][column].as_f64().expect("a number"));
        assert!((shown - right).abs() < 1e-12, "{name}: {shown} {right}");
    }
}

#[test]
fn documents_code_and_pictures_are_made() {
    let (_, model) = taken("scara");
    for format in ["html", "typst", "latex", "markdown"] {
        for language in ["en", "fr", "de", "es"] {
            let report = told("report", json!({ "format": format, "language": language, "q": model["q"] }));
            assert!(report["text"].as_str().is_some_and(|t| t.len() > 10_000), "{format}");
        }
    }
    for language in ["rust", "c", "python", "matlab", "javascript", "cuda", "ikfast"] {
        let code = told("code", json!({ "language": language }));
        assert!(code["files"].as_array().is_some_and(|f| f.len() > 1), "{language}: {code}");
        assert!(code["test"].as_str().is_some_and(|t| !t.is_empty()), "{language}");
    }
    for scheme in [false, true] {
        let figure = told("figure", json!({ "q": model["q"], "scheme": scheme }));
        assert!(figure["svg"].as_str().is_some_and(|s| s.starts_with("<svg")));
    }
    let workspace = told("workspace", json!({}));
    assert!(workspace["area"].as_f64().is_some_and(|a| a > 0.0));
    assert!(!told("singular", json!({}))["singularities"].as_array().expect("a list").is_empty());
}

#[test]
fn where_the_position_alone_is_singular_is_told() {
    taken("planar-2r");
    let told = told("singular", json!({}));
    let all = told["singularities"].as_array().expect("a list");
    let of_point: Vec<&Value> = all.iter().filter(|one| one["of_point"] == true).collect();
    assert_eq!(of_point.len(), 1, "{told}");
    assert_eq!(of_point[0]["factor"]["text"], "S2 = 0");
    let q = of_point[0]["q"].as_array().and_then(|q| q[1].as_f64()).expect("a configuration");
    assert!(q.sin().abs() < 1e-9, "{q}");
}

#[test]
fn a_printed_formula_is_judged() {
    taken("staubli-rx90");
    let check =
        |text: &str| told("check", json!({ "text": text, "name": "formula.md" }))["claims"][0].clone();
    assert_eq!(check("$P_x = C_1 (C_2 D3 - S_{23} RL4)$")["verdict"], "equal");
    let wrong = check("$P_x = C_1 (C_2 D3 + S_{23} RL4)$");
    assert_eq!(wrong["verdict"], "wrong", "{wrong}");
    assert!(wrong["slip"]["formula"].is_string(), "{wrong}");
}

#[test]
fn a_path_through_joints_and_lines_is_planned() {
    let (_, model) = taken("staubli-rx90");
    let q = numbers(&model["q"]);
    let to: Vec<f64> = q.iter().map(|x| x + 0.2).collect();
    let mut pose = told("solve", json!({ "q": to }))["pose"].clone();
    pose[2][3] = json!(pose[2][3].as_f64().expect("a number") - 0.05);
    let points = json!([{ "kind": "joint", "q": to }, { "kind": "line", "pose": pose }]);
    let path = told("path", json!({ "start": q, "points": points, "samples": 50 }));
    let all = path["q"].as_array().expect("configurations");
    assert_eq!(path["t"].as_array().map(Vec::len), Some(all.len()));
    assert_eq!(path["reached"], 1.0);
    for (shown, right) in numbers(&all[0]).iter().zip(&q) {
        assert!((shown - right).abs() < 1e-9);
    }
    let last = path["pose"].as_array().and_then(|p| p.last().cloned()).expect("a pose");
    assert!(far(&last, &pose) < 1e-5, "{last} {pose}");
    // Times go on, and the whole takes as long as it says.
    let times = numbers(&path["t"]);
    assert!(times.windows(2).all(|t| t[0] <= t[1]) && times.last().copied() == path["duration"].as_f64());
    for points in [json!([]), json!([{ "kind": "joint", "q": [1] }])] {
        let refused = ask("path", json!({ "start": q, "points": points, "samples": 5 }));
        assert!(refused["error"].is_string(), "{refused}");
    }
}

#[test]
fn a_self_motion_keeps_the_hand_still() {
    taken("puma560");
    // Axes 4 and 6 in one line.
    let answer = told("solve", json!({ "q": [0.3, -0.4, 0.2, 0.5, 0.0, -0.2] }));
    let family = &answer["families"][0];
    let curve = family["curve"].as_array().expect("members");
    assert!(curve.len() > 20 && answer["motions"][0]["closed"] == true, "{family}");
    for q in curve.iter().step_by(7) {
        let pose = told("solve", json!({ "q": q, "quick": true }))["pose"].clone();
        assert!(far(&pose, &answer["pose"]) < 1e-6);
    }
}

/// The keys of an answer that are in camel case; those of maps are names in formulas.
fn camels(value: &Value, out: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                if key.chars().any(|c| c.is_ascii_uppercase()) {
                    out.push(key.clone());
                }
                if !(key == "joints" && value.is_object()) && key != "values" {
                    camels(value, out);
                }
            }
        }
        Value::Array(all) => all.iter().for_each(|value| camels(value, out)),
        _ => {}
    }
}

#[test]
fn names_are_those_of_the_command_line() {
    let d = denavit::catalogue::robot("puma560").expect("it is in the catalogue");
    let q = [0.3, -0.4, 0.2, 0.5, 0.6, -0.2];
    let (_, model) = taken("puma560");
    let to: Vec<f64> = q.iter().map(|x| x + 0.1).collect();
    // Out of reach before its end: what comes of the other starts is told.
    let mut far = told("solve", json!({ "q": to }))["pose"].clone();
    far[2][3] = 9.into();
    let line = json!([{ "kind": "line", "pose": far }]);
    let answer = told("solve", json!({ "q": q, "near": q }));
    let path = told("path", json!({ "start": q, "points": line, "samples": 10 }));
    let scene = told("scene", json!({ "q": q }));
    let singular = told("singular", json!({}));
    let jacobian = told("jacobian", json!({ "q": q, "frame": "base" }));
    let formulas = told("formulas", json!({ "topic": "jacobian", "q": q }));
    let mut found = vec![];
    for one in [&model, &answer, &path, &scene, &singular, &jacobian, &formulas] {
        camels(one, &mut found);
    }
    assert!(found.is_empty(), "{found:?}");

    // What `ik`, `show`, `jacobian` and `robots` print.
    let read = |text: String| -> Value { serde_json::from_str(&text).expect("an answer is JSON") };
    let solver = denavit::inverse::InverseKinematics::new(&d, &Default::default()).expect("it is solved");
    let solved = solver.solve(&solver.robot.pose(&q), &[]);
    let solution = |s| denavit_wire::inverse::Solution::of(s, &solver.space);
    let solutions: Vec<_> = solved.solutions.iter().map(solution).collect();
    assert_eq!(answer["solutions"], read(denavit_wire::text(&solutions)));
    let shown = read(denavit_wire::text(&denavit_wire::robot::Robot::of(&d)));
    assert_eq!(model["robot"], shown["robot"]);
    assert_eq!(model["structure"], shown["structure"]);
    assert_eq!(jacobian["robot"], shown["robot"]);
    assert_eq!(jacobian["rows"], json!(["vx", "vy", "vz", "wx", "wy", "wz"]));
    let kinds: String =
        model["joints"].as_array().into_iter().flatten().filter_map(|j| j["kind"].as_str()).collect();
    assert_eq!(shown["joints"], kinds);
    let listed = told("catalogue", json!({}))["robots"].clone();
    let whole = denavit_wire::catalogue::Catalogue::whole();
    assert_eq!(listed, read(denavit_wire::text(&whole.robots)));
    for place in [&answer["nearest"], &path["starts"][0]] {
        assert!(place["within_limits"].is_boolean(), "{place}");
    }
    assert!(
        scene["within_limits"].as_array().is_some_and(|all| all.len() == 6),
        "{}",
        scene["within_limits"]
    );
}

/// A bar of 1 m on a level axis, whose ends are the joint and the tool.
fn pendulum(more: &str) -> Value {
    let text = format!(
        "name = \"p\"\nconvention = \"standard\"\n[[joints]]\na = \"1 m\"\ntheta = \"q1\"\n{more}\n[base]\nrpy = [\"90 deg\", 0, 0]\n"
    );
    let file = told("open", json!({ "text": text, "kind": "toml" }))["file"].clone();
    assert!(told("edit", json!({ "file": file }))["robot"].is_object(), "{text}");
    file
}

/// Torques and falls of a pendulum are what textbooks say of one, with its own mass and as a bar.
#[test]
fn an_arm_is_held_and_falls() {
    const G: f64 = 9.81;
    let torque = |q: f64| numbers(&told("hold", json!({ "q": [q] }))["torques"])[0];
    pendulum("");
    assert_eq!(told("hold", json!({ "q": [0.0] }))["bars"], json!(1.0));
    // A bar of 1 kg and 1 m: its weight acts at half of its length. The ball stands on the axis.
    assert!((torque(0.0) - 0.5 * G).abs() < 1e-9 && torque(std::f64::consts::FRAC_PI_2).abs() < 1e-9);
    pendulum("mass = \"2 kg\"\ncom = [\"-0.25 m\", 0, 0]\ninertia = [0, 0, 0, 0, 0, 0]\nviscous = 0.1");
    let held = told("hold", json!({ "q": [0.0] }));
    assert!(held["bars"].is_null() && held["mass"] == json!(2.0), "{held}");
    assert!((torque(0.0) - 1.5 * G).abs() < 1e-9);
    // A point 0.75 m from the axis, let go level: what it has lost of height is in its motion and in friction.
    let path = told("fall", json!({ "q": [0.0], "seconds": 2.0 }));
    let [q, velocity]: [Vec<f64>; 2] =
        ["q", "velocity"].map(|k| path[k].as_array().into_iter().flatten().map(|x| numbers(x)[0]).collect());
    let energy = |name: &str| numbers(&path["energy"][name]);
    let (kinetic, potential, lost) = (energy("kinetic"), energy("potential"), energy("lost"));
    assert!(q.len() > 100 && path["t"].as_array().map(Vec::len) == Some(q.len()));
    for k in 0..q.len() {
        assert!((potential[k] - 2.0 * G * 0.75 * q[k].sin()).abs() < 1e-6, "{k}");
        assert!((kinetic[k] - 0.75 * 0.75 * velocity[k] * velocity[k]).abs() < 1e-6, "{k}");
        assert!((kinetic[k] + potential[k] + lost[k]).abs() < 1e-5, "{k}");
    }
    assert!(q.iter().copied().fold(0.0, f64::min) < -2.0 && lost[lost.len() - 1] > 0.5);
    // Drives that follow a path need torques: at rest at its ends those that hold the arm.
    let path =
        told("path", json!({ "start": [0.0], "points": [{ "kind": "joint", "q": [1.0] }], "samples": 51 }));
    let torques: Vec<f64> = path["torque"].as_array().into_iter().flatten().map(|x| numbers(x)[0]).collect();
    assert!(torques.len() > 50 && torques.iter().all(|x| x.is_finite()));
    let reference = |k: usize, q: f64| {
        let motion = path["velocity"][k][0].as_f64().expect("a number");
        torques[k] - 1.5 * G * q.cos() - 0.1 * motion
    };
    // What is left beside weight and friction accelerates: it changes its sign on the way.
    let of = |k: usize| reference(k, path["q"][k][0].as_f64().expect("a number"));
    assert!((0..torques.len()).any(|k| of(k) > 1e-3) && (0..torques.len()).any(|k| of(k) < -1e-3));
}

/// Every arm of the catalogue falls, as bars; its energy is kept.
#[test]
fn arms_without_masses_fall_as_bars() {
    for name in ["ur5", "scara", "stanford", "planar-2r", "franka-panda"] {
        let (_, model) = taken(name);
        let held = told("hold", json!({ "q": model["q"] }));
        assert_eq!(held["bars"], json!(1.0), "{name}");
        assert!(held["mass"].as_f64() > Some(0.0), "{name}: {held}");
        let path = told("fall", json!({ "q": model["q"], "seconds": 1.0 }));
        let sum = |k: usize| -> f64 {
            ["kinetic", "potential", "lost"].iter().filter_map(|n| path["energy"][n][k].as_f64()).sum()
        };
        let all = path["t"].as_array().map_or(0, Vec::len);
        let largest = numbers(&path["energy"]["kinetic"]).into_iter().fold(1e-9, f64::max);
        assert!(all > 50 && (0..all).all(|k| sum(k).abs() < 1e-6 * largest), "{name}");
        assert!(path["torque"].is_null());
    }
}

/// What cannot fall says why.
#[test]
fn falls_that_are_refused() {
    pendulum("");
    for (input, words) in [
        (json!({ "q": [0.0, 1.0], "seconds": 1.0 }), "2 values for 1 joints"),
        (json!({ "q": [0.0], "seconds": 0.0 }), "more than 0 s"),
        (json!({ "q": [0.0], "seconds": 1e9 }), "60 s at most"),
    ] {
        assert!(ask("fall", input)["error"].as_str().is_some_and(|e| e.contains(words)), "{words}");
    }
    pendulum("mass = 0\ncom = [0, 0, 0]\ninertia = [0, 0, 0, 0, 0, 0]\nrotor = 0");
    let answer = ask("fall", json!({ "q": [0.0], "seconds": 1.0 }));
    assert!(answer["error"].as_str().is_some_and(|e| e.contains("q1 moves no mass of its own")), "{answer}");
}
