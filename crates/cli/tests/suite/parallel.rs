//! Parallel robots on the command line.

use crate::common::{File, fed, text};
use serde_json::Value;

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = fed(arguments, "");
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

fn json(arguments: &[&str]) -> Value {
    let (code, answer, said) = run(&[arguments, &["--json"]].concat());
    assert_eq!(code, 0, "{arguments:?}: {said}");
    serde_json::from_str(&answer).expect("JSON")
}

#[test]
fn forty_poses_are_printed_and_proved() {
    let (code, answer, said) = run(&["fk", "dietmaier", "-q", "forty"]);
    assert_eq!((code, said.as_str()), (0, ""));
    assert!(answer.starts_with("Dietmaier's platform at l1 = 1 m, l2 = 0.645275 m"), "{answer}");
    assert!(answer.contains(": 40 poses\n"), "{answer}");
    assert!(answer.contains("complete: all 40 solutions over the complex numbers are proved"), "{answer}");
    let found = json(&["fk", "dietmaier", "-q", "forty", "--orientation", "quaternion"]);
    let poses = found["assemblies"].as_array().expect("a list");
    assert_eq!(poses.len(), 40);
    assert!(
        poses
            .iter()
            .all(|p| p["proved"] == true
                && p["orientation"]["values"].as_array().is_some_and(|v| v.len() == 4))
    );
    assert_eq!(
        (&found["complete"], &found["most"], &found["solutions"], &found["lost"]),
        (&true.into(), &40.into(), &40.into(), &0.into())
    );
    // Each pose leads back to the lengths.
    let pose = poses[7]["pose"].to_string();
    let back = json(&["ik", "dietmaier", "-p", &pose]);
    let (wanted, lengths) = (&found["q"], &back["solutions"][0]["q"]);
    for k in 0..6 {
        let off = wanted[k].as_f64().expect("a number") - lengths[k].as_f64().expect("a number");
        assert!(off.abs() < 1e-12, "{back}");
    }
    let (_, one, _) = run(&["fk", "dietmaier", "-q", "forty", "--mode", "3"]);
    assert!(one.contains(": 1 pose\n") && one.contains("T(base → platform) = "), "{one}");
    let (code, _, said) = run(&["fk", "dietmaier", "-q", "forty", "--mode", "41"]);
    assert_eq!((code, said.contains("no assembly mode `41` here")), (2, true), "{said}");
}

#[test]
fn what_is_not_proved_is_said() {
    // Flat hexagons, symmetric: twenty-eight of forty.
    let file = File::new(
        "hexagons.toml",
        "kind = \"gough-stewart\"\nname = \"hexagons\"\n\
         base = [[1, -0.2, 0], [1, 0.2, 0], [-0.33, 0.97, 0], [-0.67, 0.77, 0], [-0.67, -0.77, 0], [-0.33, -0.97, 0]]\n\
         platform = [[0.4, -0.4, 0], [0.4, 0.4, 0], [0.3, 0.5, 0], [-0.6, 0.1, 0], [-0.6, -0.1, 0], [0.3, -0.5, 0]]\n\
         [poses]\nhome = { xyz = [0, 0, 1] }\n",
    );
    let (code, answer, _) = run(&["fk", file.name(), "-q", "home"]);
    assert_eq!(code, 0, "{answer}");
    let found = json(&["fk", file.name(), "-q", "home"]);
    assert_eq!(found["complete"], found["solutions"] == 40);
    assert_eq!(answer.contains("there may be others"), found["complete"] == false, "{answer}");
    // A singular pose: two poses meet in it.
    let (code, answer, _) = run(&["fk", "octahedral-hexapod", "-q", "fichter"]);
    assert_eq!(code, 0, "{answer}");
    assert!(
        answer.contains("  proved\n") && answer.contains("  no\n") && answer.contains("there may be others"),
        "{answer}"
    );
    let (code, answer, said) = run(&["fk", "octahedral-hexapod", "-q", "0.9,0.9,0.9,0.9,0.9,0.5"]);
    assert!(said.contains("warning: l6 = 0.5 m is outside its limits 0.7 m … 1.2 m"), "{said}");
    assert!(code <= 1 && answer.contains("16 isolated poses at most"), "{code} {answer}");
}

#[test]
fn deltas_have_eight_modes_and_two_positions() {
    let found = json(&["ik", "rotary-delta", "--position", "-p", "0.1, 0.05, -0.8"]);
    let all = found["solutions"].as_array().expect("a list");
    assert_eq!((all.len(), &found["status"]), (8, &Value::from("solved")));
    for solution in all {
        let q: Vec<String> = solution["q"].as_array().expect("a list").iter().map(Value::to_string).collect();
        let placed = json(&["fk", "rotary-delta", "-q", &q.join(",")]);
        let both = placed["assemblies"].as_array().expect("a list");
        let is_own = |p: &Value| {
            [(0, 0.1), (1, 0.05), (2, -0.8)]
                .iter()
                .all(|(i, x)| (p["pose"][i][3].as_f64().unwrap_or(9.0) - x).abs() < 1e-9)
        };
        assert!(both.len() == 2 && both.iter().any(is_own), "{placed}");
    }
    let inside = json(&["ik", "rotary-delta", "-p", "0.1, 0.05, -0.8", "--limits"]);
    assert_eq!(inside["solutions"].as_array().map(Vec::len), Some(1), "{inside}");
    assert_eq!((&inside["solutions"][0]["mode"], &inside["left_out"]), (&Value::from("+++"), &7.into()));
    let (_, one, _) = run(&["ik", "linear-delta", "-p", "0.02, 0, -0.3", "--mode", "--+"]);
    assert!(one.contains("1 solution in closed form") && one.contains("  --+  "), "{one}");
    let (code, _, said) = run(&["ik", "rotary-delta", "-p", "0, 0, -3"]);
    assert_eq!((code, said.contains("leg 1 does not reach the pose: it lacks ")), (1, true), "{said}");
    let (code, _, said) = run(&["ik", "rotary-delta", "-p", "0, 0, -0.8, 0, 0, 10deg"]);
    assert_eq!((code, said.contains("keeps its orientation")), (1, true), "{said}");
}

#[test]
fn planar_robots_are_counted() {
    let found = json(&["ik", "planar-3rrr", "-p", "0.25, 0.15, 10deg"]);
    assert_eq!(found["solutions"].as_array().map(Vec::len), Some(8), "{found}");
    let q: Vec<String> =
        found["solutions"][2]["q"].as_array().expect("a list").iter().map(Value::to_string).collect();
    let placed = json(&["fk", "planar-3rrr", "-q", &q.join(",")]);
    assert_eq!(placed["complete"], true, "{placed}");
    let (_, answer, _) = run(&["fk", "planar-3rrr", "-q", &q.join(",")]);
    assert!(answer.contains("no other real root, proved") && answer.contains("10°"), "{answer}");
}

#[test]
fn singularities_are_told_in_words_and_numbers() {
    let (code, answer, said) = run(&["jacobian", "octahedral-hexapod", "-q", "fichter"]);
    assert_eq!(code, 0, "{said}");
    assert!(
        answer.contains(
            "a parallel singularity (type 2): with all drives at rest the platform still has the screw"
        ),
        "{answer}"
    );
    assert!(!answer.contains("J_x⁻¹J_q"), "{answer}");
    let found = json(&["jacobian", "octahedral-hexapod", "-q", "fichter"]);
    assert!(found["jacobian"].is_null() && found["condition"].is_null(), "{found}");
    let axis = &found["gained"][0]["direction"];
    assert!(axis[2].as_f64().is_some_and(|z| z.abs() > 1.0 - 1e-9), "{found}");
    let (_, answer, _) = run(&["jacobian", "octahedral-hexapod", "-q", "home"]);
    assert!(
        answer.contains("not singular")
            && answer.contains("J = J_x⁻¹J_q = ")
            && answer.contains("held least: "),
        "{answer}"
    );
    // Stretched: the leg's drive moves alone.
    let stretched = File::new(
        "stretched.toml",
        "kind = \"planar-3rrr\"\nbase = [[0, 0], [1, 0], [0.5, 1]]\nplatform = [[0, 0], [0.2, 0], [0.1, 0.2]]\nproximal = 0.3\n\
         distal = [0.2, 0.4, 0.6]\n[poses]\na = { xyz = [0.5, 0, 0] }\n",
    );
    let (code, answer, said) = run(&["jacobian", stretched.name(), "-q", "a"]);
    assert_eq!(code, 0, "{said}");
    assert!(
        answer.contains("a serial singularity (type 1): leg 1 is stretched or folded, q1 moves"),
        "{answer}"
    );
}

#[test]
fn files_are_shown_and_other_verbs_refuse_them() {
    for name in ["dietmaier", "octahedral-hexapod", "rotary-delta", "linear-delta", "planar-3rrr"] {
        let (code, shown, said) = run(&["show", name]);
        assert_eq!((code, said.as_str()), (0, ""), "{name}");
        assert!(shown.contains("How it is solved") && shown.contains("rates"), "{shown}");
        let shown = json(&["show", name]);
        assert!(
            shown["geometry"].is_object() && shown["drives"].as_array().is_some_and(|d| d.len() >= 3),
            "{shown}"
        );
        let (code, file, _) = run(&["show", name, "--toml"]);
        assert!(code == 0 && file.contains("kind = "), "{file}");
        let (code, formulas, _) = run(&["ik", name]);
        assert!(code == 0 && formulas.contains("inverse"), "{formulas}");
        for verb in ["derive", "dynamics", "report", "generate", "convert", "path", "exercise", "view"] {
            let more: &[&str] = match verb {
                "generate" => &["--language", "c", "-o", "arm-c"],
                "exercise" => &["--kind", "fk"],
                "convert" => &["--to", "urdf"],
                "report" => &["-o", "report.md"],
                "path" => &["-q", "0", "--line", "0,0,1"],
                _ => &[],
            };
            let (code, _, said) = run(&[&[verb, name], more].concat());
            assert_eq!(code, 4, "{verb} {name}: {said}");
            assert!(
                said.contains("is a parallel robot") && said.contains("`show`, `fk`, `ik` and `jacobian`"),
                "{said}"
            );
        }
    }
    let (_, all, _) = run(&["robots", "delta"]);
    assert!(all.contains("rotary-delta") && all.contains("linear-delta"), "{all}");
    assert_eq!(json(&["robots", "dietmaier"])["parallel"][0]["kind"], "gough-stewart");
    let (code, _, said) = run(&["fk", "dietmayer", "-q", "0"]);
    assert!(code == 3 && said.contains("dietmaier"), "{said}");
}

#[test]
fn errors_come_with_their_places() {
    let file = File::new("bad.toml", "kind = \"delta\"\nbase_radius = \"1 kg\"\nrod = 3\n");
    let (code, _, said) = run(&["fk", file.name(), "-q", "0,0,0"]);
    assert_eq!(code, 3, "{said}");
    for part in
        [":2:", ":3:1: error: unknown key `rod`", "did you mean `lower_arm`?", "how are the arms driven?"]
    {
        assert!(said.contains(part), "{part}: {said}");
    }
    for (arguments, part) in [
        (vec!["fk", "rotary-delta", "-q", "0,0"], "2 values given, the robot has 3 drives (q1, q2, q3)"),
        (vec!["fk", "dietmaier", "-q", "1,1,1,1,1,-1"], "l6: the length of a leg is not negative"),
        (vec!["fk", "rotary-delta"], "or a pose by name: "),
        (vec!["fk", "rotary-delta", "-q", "l1=0, q2=0, q3=0"], "no drive `l1`"),
        (vec!["ik", "dietmaier", "--position", "-p", "0,0,1"], "its legs hold a whole pose"),
        (vec!["ik", "dietmaier", "-q", "forty"], "`fk` gives them"),
        (vec!["fk", "rotary-delta", "-q", "0,0,0", "--frames", "all"], "--frames for parallel robots"),
        (vec!["fk", "rotary-delta", "-q", "0,0,0", "--tip", "x"], "its base and its platform alone"),
        (vec!["fk", "planar-3rrr", "-q", "0,0,0", "--set", "e=3deg"], "--set e=3deg"),
    ] {
        let (code, _, said) = run(&arguments);
        assert!([2, 3, 4].contains(&code) && said.contains(part), "{arguments:?}: {code} {said}");
    }
    // From standard input, too.
    let text_of = run(&["show", "rotary-delta", "--toml"]).1;
    let output = fed(&["fk", "-", "-q", "home"], &text_of);
    assert!(output.status.success(), "{}", text(&output.stderr));
}
