//! Robots by their axes, trees of rows and bodies, and what `convert` makes of them.

use crate::common::{File, fed, text};
use serde_json::Value;

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = fed(arguments, "");
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

fn structure(name: &str) -> String {
    format!("{}/../robot/structures/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn urdf(name: &str) -> String {
    format!("{}/../robot/tests/urdf/{name}.urdf", env!("CARGO_MANIFEST_DIR"))
}

/// What is written in a format opens again and is converted from there as well.
#[test]
fn every_format_goes_there_and_back() {
    for (to, ending) in [
        ("axes", "toml"),
        ("poe", "toml"),
        ("body-poe", "toml"),
        ("markdown", "md"),
        ("latex", "tex"),
        ("csv", "csv"),
        ("par", "par"),
        ("tree", "toml"),
    ] {
        let (code, written, said) = run(&["convert", "puma560", "--to", to]);
        assert_eq!(code, 0, "{to}: {said}");
        assert!(said.contains("read back, it is proved to be the same robot"), "{to}: {said}\n{written}");
        let file = File::new(&format!("puma.{ending}"), &written);
        let (code, shown, said) = run(&["show", file.name()]);
        assert_eq!(code, 0, "{to}: {said}");
        assert!(shown.contains("a spherical wrist"), "{to}: {shown}");
        let (code, _, said) = run(&["convert", file.name(), "--to", "toml"]);
        assert!(code == 0 && said.contains("proved to be the same robot"), "{to}: {said}");
    }
    let (code, text, said) = run(&["convert", "ur5", "--to", "markdown", "--as", "craig"]);
    assert!(code == 0 && text.contains("convention: craig") && text.contains("α_{i-1}"), "{said}{text}");
    let (_, text, said) = run(&["convert", "rethink-baxter-left", "--to", "csv"]);
    assert!(said.contains("its poses differ by"), "{said}{text}");
    let (code, _, said) = run(&["convert", "parallelogram-5r", "--to", "par"]);
    assert!(code == 3 && said.contains("has no words for that"), "{said}");
}

#[test]
fn axes_say_what_is_wrong_with_them() {
    let file = File::new("axes.toml", "[[axes]]\npoint = [0, 0, 0]\ndirection = [0, 0, 0]\n");
    let (code, _, said) = run(&["show", file.name()]);
    assert!(code == 3 && said.contains(":3:13: error: this axis has no direction"), "{said}");
}

#[test]
fn chains_of_a_tree_of_rows() {
    let file = structure("dual-arm");
    let (code, shown, said) = run(&["show", &file]);
    assert!(code == 0 && shown.contains("7 joints"), "{said}{shown}");
    assert!(said.contains("from `base` to `right hand`, 7 joints; its rows as they stand"), "{said}");
    let (code, shown, said) = run(&["show", &file, "--base", "left hand", "--tip", "right hand"]);
    assert!(
        code == 0 && shown.contains("12 joints") && said.contains("proved to be the tree's chain"),
        "{said}"
    );
    let (code, _, said) = run(&["show", &file, "--tip", "right hend"]);
    assert!(code == 2 && said.contains("did you mean `right hand`?"), "{said}");
    let (code, _, said) = run(&["show", "ur5", "--tip", "hand"]);
    assert!(code == 2 && said.contains("--tip is for URDF files and trees, and ur5 is one chain"), "{said}");
    let (code, written, said) = run(&["convert", &file, "--to", "par"]);
    assert!(code == 0 && said.contains("chains are proved to be the same"), "{said}");
    let par = File::new("dual.par", &written);
    // The two hands and the camera are rows 14, 15 and 16 of the file.
    let (code, shown, said) = run(&["show", par.name(), "--tip", "15"]);
    assert!(code == 0 && shown.contains("7 joints"), "{said}{shown}");
    let (code, _, said) = run(&["show", par.name()]);
    assert!(code == 2 && said.contains("there are several tips"), "{said}");
    let (code, written, said) = run(&["convert", &urdf("ur5_gripper"), "--to", "tree"]);
    assert!(code == 0 && said.contains("chains are proved to be the same"), "{said}\n{written}");
}

#[test]
fn all_bodies_of_a_tree_at_once() {
    let file = structure("humanoid");
    let at = "left elbow=-60deg, right knee=0.5";
    let (code, shown, said) = run(&["fk", &file, "--frames", "all", "-q", at]);
    assert!(code == 0 && shown.contains("left elbow = −60°"), "{said}{shown}");
    assert_eq!(shown.lines().filter(|l| l.contains("palm")).count(), 2, "{shown}");
    let (code, out, said) = run(&["fk", &file, "--frames", "all", "-q", at, "--json"]);
    assert_eq!(code, 0, "{said}");
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    let frames = answer["frames"].as_array().expect("frames");
    assert_eq!((frames.len(), answer["joints"].as_array().map(Vec::len)), (37, Some(31)));
    // The palm is where its chain has it.
    let palm = frames.iter().find(|f| f["name"] == "left palm").expect("a palm");
    let chain = ["fk", &file, "--tip", "left palm", "-q", "0,0,0,0,0,0,-60deg,0,0,0", "--json"];
    let (code, out, said) = run(&chain);
    assert_eq!(code, 0, "{said}");
    let one: Value = serde_json::from_str(&out).expect("JSON");
    for (a, b) in palm["pose"].as_array().unwrap().iter().zip(one["pose"].as_array().unwrap()) {
        for (a, b) in a.as_array().unwrap().iter().zip(b.as_array().unwrap()) {
            assert!((a.as_f64().unwrap() - b.as_f64().unwrap()).abs() < 1e-14, "{a} {b}");
        }
    }
    // A line for each line, as with one chain.
    let output = fed(&["fk", &urdf("pr2"), "--frames", "all", "--input", "-"], "[0]\n");
    assert!(text(&output.stdout).contains("\"error\""), "one value is too few");
    let (code, _, said) = run(&["fk", &file, "--frames", "all"]);
    assert!(code == 2 && said.contains("say where the joints are"), "{said}");
    let (code, _, said) = run(&["fk", &file, "--frames", "all", "-q", "elbow=1"]);
    assert!(code == 2 && said.contains("no joint `elbow` moves by itself"), "{said}");
    let (code, _, said) = run(&["fk", &file, "--frames", "all", "-q", "1, 2"]);
    assert!(code == 2 && said.contains("2 values given, the tree has 31 joints"), "{said}");
}

/// What is written is read back as its decimals are: an angle of 1.5708 that is none of 90°.
#[test]
fn what_is_written_is_what_was_meant() {
    let arm = |angle: &str| {
        format!(
            "name = \"a\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\nd = 0.3\nalpha = \"{angle}\"\n[[joints]]\ntheta = \"q2\"\na = 0.5\n"
        )
    };
    let file = File::new("decimals.toml", &arm("1.5708"));
    for to in ["urdf", "mjcf", "par"] {
        let (code, _, said) = run(&["convert", file.name(), "--to", to]);
        assert!(code == 0 && said.contains("read back"), "{to}: {said}");
        assert!(to != "urdf" || said.contains("with --as-written"), "{to}: {said}");
        assert!(!said.contains("e-6 at most"), "{to}: {said}");
    }
    let (_, written, _) = run(&["convert", file.name(), "--to", "urdf"]);
    let back = File::new("decimals.urdf", &written);
    let (code, _, said) = run(&["convert", back.name(), "--as-written", "--to", "urdf"]);
    assert!(code == 0 && !said.contains("its decimals are meant so"), "{said}");
    let exact = File::new("exact.toml", &arm("90 deg"));
    let (code, _, said) = run(&["convert", exact.name(), "--to", "urdf"]);
    assert!(code == 0 && said.contains("note: read back, it is proved to be the same robot"), "{said}");
}

#[test]
fn a_description_in_xml_is_known_by_its_root() {
    let text = std::fs::read_to_string(urdf("ur5_robot")).expect("a file");
    for name in ["arm", "arm.xml", "arm.model", "arm.urdf.in"] {
        let file = File::new(name, &text);
        let (code, shown, said) = run(&["show", file.name(), "--tip", "tool0"]);
        assert!(code == 0 && shown.contains("6 joints"), "{name}: {said}");
    }
    let model = "<mujoco><worldbody><body name='a'><joint axis='0 0 1'/></body></worldbody></mujoco>";
    let file = File::new("model", model);
    let (code, shown, said) = run(&["fk", file.name(), "--frames", "all", "-q", "0"]);
    assert!(code == 0 && shown.contains('a'), "{said}");
    let file = File::new("page", "<html><body/></html>");
    let (code, _, said) = run(&["show", file.name()]);
    assert!(code == 3 && said.contains("what is this?"), "{said}");
}

#[test]
fn joints_that_follow_others_say_whom() {
    let joint = |name: &str, parent: &str, child: &str, mimic: &str| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{parent}'/><child link='{child}'/>{mimic}</joint>"
        )
    };
    let text = format!(
        "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>{}{}</robot>",
        joint("driver", "a", "b", ""),
        joint("idler", "b", "c", "<mimic joint='driver' multiplier='-1'/>")
    );
    let file = File::new("mimic.urdf", &text);
    let (code, _, said) = run(&["fk", file.name(), "--frames", "all", "-q", "idler=1"]);
    assert!(code == 2 && said.contains("`idler` follows `driver`: give that one its value"), "{said}");
    let (code, _, said) = run(&["fk", file.name(), "-q", "idler=1"]);
    assert!(code == 2 && said.contains("`idler` does not move by itself: it follows q1 (driver)"), "{said}");
}

#[test]
fn structures_have_names_like_robots() {
    let (code, listed, said) = run(&["robots", "arm"]);
    assert!(
        code == 0 && listed.contains("left hand, right hand, camera") && listed.contains("mobile-arm"),
        "{said}{listed}"
    );
    let (_, out, _) = run(&["robots", "humanoid", "--json"]);
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    let structure = &answer["structures"][0];
    assert_eq!((&structure["name"], structure["joints"].as_u64()), (&Value::from("humanoid"), Some(31)));
    assert_eq!(structure["tips"].as_array().map(Vec::len), Some(5));
    let (code, shown, said) = run(&["show", "Dual_Arm", "--tip", "left hand"]);
    assert!(code == 0 && shown.contains("7 joints"), "{said}{shown}");
    let (code, _, said) = run(&["fk", "humanoid", "--frames", "all", "-q", "left elbow=1"]);
    assert_eq!(code, 0, "{said}");
    let (code, _, said) = run(&["show", "humanoids"]);
    assert!(code == 3 && said.contains("did you mean humanoid?"), "{said}");
    // Frames by their numbers, as a table has them.
    let (code, _, said) = run(&["show", "dual-arm", "--base", "0", "--tip", "5"]);
    assert!(code == 0 && said.contains("from `base` to `left forearm`, 5 joints"), "{said}");
    let (code, _, said) = run(&["show", "dual-arm", "--tip", "17"]);
    assert!(code == 2 && said.contains("there is no link `17`"), "{said}");
}

/// All of a tree as one table, which opens again.
#[test]
fn whole_trees_are_tables() {
    for (to, ending) in [("markdown", "md"), ("latex", "tex"), ("csv", "csv")] {
        for (name, chains) in [("dual-arm", 3), ("gripper", 3), ("humanoid", 5)] {
            let (code, written, said) = run(&["convert", name, "--to", to, "--whole"]);
            assert!(
                code == 0 && said.contains(&format!("of {chains} chains are proved")),
                "{name} {to}: {said}"
            );
            assert!(!said.contains("not compared"), "{name} {to}: {said}");
            let file = File::new(&format!("whole-{name}.{ending}"), &written);
            let tip = ["right hand", "left pad", "right palm"]
                .into_iter()
                .find(|t| written.contains(t))
                .expect("a tip");
            let (code, shown, said) = run(&["show", file.name(), "--tip", tip]);
            let (_, own, _) = run(&["show", name, "--tip", tip]);
            assert_eq!(code, 0, "{name} {to}: {said}{own}");
            let count = |text: &str| {
                text.lines()
                    .next()
                    .and_then(|l| l.split_once(": "))
                    .map(|l| l.1.split(' ').next().map(str::to_string))
            };
            assert_eq!(count(&shown), count(&own), "{name} {to}");
        }
    }
    // A file without a branch is a tree of one chain.
    for to in ["markdown", "csv", "latex"] {
        let (code, written, said) = run(&["convert", &urdf("ur5_robot"), "--tip", "tool0", "--to", "urdf"]);
        assert_eq!(code, 0, "{said}");
        let one = File::new("one-chain.urdf", &written);
        let (code, _, said) = run(&["convert", one.name(), "--to", to, "--whole"]);
        assert!(code == 0 && said.contains("read back"), "{to}: {said}");
    }
    let (code, _, said) = run(&["convert", &urdf("pr2"), "--to", "markdown", "--whole"]);
    assert!(code == 0 && said.contains("of 25 chains"), "{said}");
    let (code, _, said) = run(&["convert", "dual-arm", "--to", "poe", "--whole"]);
    assert!(code == 2 && said.contains("--whole is for"), "{said}");
}

/// All of a tree as bodies and joints, from any description of one.
#[test]
fn whole_trees_are_bodies_and_joints() {
    for (to, ending) in [("urdf", "urdf"), ("mjcf", "xml")] {
        for (name, chains) in [("dual-arm", 3), ("gripper", 3), ("humanoid", 5)] {
            let (code, written, said) = run(&["convert", name, "--to", to, "--whole"]);
            assert!(
                code == 0 && said.contains(&format!("of {chains} chains are proved")),
                "{name} {to}: {said}"
            );
            let file = File::new(&format!("bodies-{name}.{ending}"), &written);
            let (code, again, said) = run(&["convert", file.name(), "--to", to, "--whole"]);
            assert_eq!(code, 0, "{name} {to}: {said}");
            // Links in another order; a model has the masses of its solids when it is read.
            let lines = |text: &str| {
                let mut all: Vec<String> = text.lines().map(str::to_string).collect();
                all.sort();
                all
            };
            assert!(to == "mjcf" || lines(&again) == lines(&written), "{name}: {again}");
        }
        for (name, chains) in [("pr2", 25), ("ur5_gripper", 2)] {
            let (code, written, said) = run(&["convert", &urdf(name), "--to", to, "--whole"]);
            assert!(code == 0 && said.contains(&format!("of {chains} chains")), "{name} {to}: {said}");
            assert!(!said.contains("torques"), "efforts have a place: {said}");
            let joints = if to == "urdf" {
                written.matches("effort=").count()
            } else {
                written.matches("actuatorfrcrange").count()
            };
            assert!(joints > 5, "{name} {to}");
        }
    }
    let (code, _, said) = run(&["convert", "dual-arm", "--to", "urdf", "--whole", "--as", "craig"]);
    assert!(code == 2 && said.contains("no convention"), "{said}");
}

#[test]
fn joints_are_called_as_their_file_calls_them() {
    let file = urdf("ur5_robot");
    let chain = |verb: &str, more: &[&str]| {
        let words = [&[verb, &file, "--tip", "tool0", "-q", "0.1,0.2,0.3,0.4,0.5,0.6"], more].concat();
        let (code, out, said) = run(&words);
        assert_eq!(code, 0, "{verb}: {said}");
        out
    };
    for verb in ["fk", "ik", "jacobian"] {
        let out = chain(verb, &[]);
        assert!(out.contains("joints: q1 shoulder_pan_joint, q2 shoulder_lift_joint,"), "{verb}: {out}");
    }
    for verb in ["ik", "jacobian"] {
        let answer: Value = serde_json::from_str(&chain(verb, &["--json"])).expect("JSON");
        assert_eq!(answer["joints"][5], "wrist_3_joint", "{verb}");
    }
    let (code, out, said) =
        run(&["report", &file, "--tip", "tool0", "--sections", "table", "--format", "markdown", "-o", "-"]);
    assert!(code == 0 && out.contains(r"| wrist\_3\_joint |") && out.contains("| name |"), "{said}{out}");
    // What has no names says none.
    let (_, out, _) = run(&["ik", "ur5", "-q", "0.1,0.2,0.3,0.4,0.5,0.6", "--json"]);
    assert!(!out.contains("\"joints\""), "{out}");
}

#[test]
fn keyframes_are_configurations_by_name() {
    let model =
        "<mujoco><worldbody><body name='b'><joint name='one' axis='0 0 1'/><body name='c' pos='1 0 0'>
        <joint name='two' axis='0 1 0'/><body name='e' pos='1 0 0'/></body></body></worldbody>
        <keyframe><key name='home' qpos='0.25 1'/></keyframe></mujoco>";
    let file = File::new("keyframe.xml", model);
    for more in [&["--json"][..], &["--frames", "all", "--json"]] {
        let answer = |q: &str| {
            let (code, out, said) = run(&[&["fk", file.name(), "-q", q], more].concat());
            assert_eq!(code, 0, "{said}");
            out
        };
        assert_eq!(answer("home"), answer("0.25, 1"));
    }
}

/// A tree in a table has all its frames, rows are frames by their names, and what a format has no place for is said.
#[test]
fn frames_have_names_and_losses_are_said() {
    let rows = "name = \"t\"\nconvention = \"khalil\"\n[[joints]]\nname = \"mast\"\ntheta = \"q1\"\nmass = 2\nrotor = 0.1\n\
                [[joints]]\nname = \"arm\"\nd = \"300 mm\"\ntheta = \"q2\"\nviscous = 0.5\n\
                [[joints]]\nname = \"other\"\nafter = \"mast\"\nd = \"-300 mm\"\ntheta = \"q3\"\n";
    let tree = File::new("named.toml", rows);
    let (code, csv, said) = run(&["convert", tree.name(), "--to", "csv", "--whole"]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("no place for it: masses, rotors, friction"), "{said}");
    let csv = File::new("named.csv", &csv);
    let all = run(&["fk", csv.name(), "--frames", "all", "-q", "other=1"]);
    assert!(all.0 == 0 && all.1.contains("other") && all.1.contains("arm"), "{}{}", all.1, all.2);
    let both = run(&["fk", tree.name(), "--tip", "arm", "--frames", "mast,2", "-q", "0,0"]);
    assert!(both.0 == 0 && both.1.contains("⁰T₁") && both.1.contains("⁰T₂"), "{}{}", both.1, both.2);
    let (code, _, said) = run(&["fk", tree.name(), "--tip", "arm", "--frames", "must", "-q", "0,0"]);
    assert!(code != 0 && said.contains("no frame `must`") && said.contains("mast, arm"), "{said}");
    let by_name = run(&["derive", tree.name(), "--tip", "arm", "--from", "mast", "--to", "arm"]);
    let by_number = run(&["derive", tree.name(), "--tip", "arm", "--from", "1", "--to", "2"]);
    assert!(by_name.0 == 0 && by_name == by_number, "{}", by_name.2);
    let (_, urdf, said) = run(&["convert", tree.name(), "--tip", "arm", "--to", "urdf"]);
    assert!(said.contains("has no place for it: rotors"), "{said}");
    assert!(urdf.contains("damping=\"0.5\""), "{urdf}");
}

/// Links of a file are frames of a chain through it, wherever they stand on it; one that moves by itself is none.
#[test]
fn links_are_frames_of_a_chain() {
    let file = urdf("ur5_gripper");
    let q = "0.3,-0.4,0.5,0.6,-0.7,0.8";
    let all = ["fk", &file, "--frames", "all", "--json", "-q"];
    let joints = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"];
    let values: Vec<String> =
        joints.iter().zip(q.split(',')).map(|(j, x)| format!("{j}_joint={x}")).collect();
    let (code, whole, said) = run(&[&all[..], &[&values.join(",")]].concat());
    assert_eq!(code, 0, "{said}");
    let whole: Value = serde_json::from_str(&whole).expect("an answer");
    let (code, some, said) =
        run(&["fk", &file, "--tip", "tool0", "--frames", "forearm_link,tool0,base_link", "-q", q, "--json"]);
    assert_eq!(code, 0, "{said}");
    let some: Value = serde_json::from_str(&some).expect("an answer");
    for (k, name) in ["forearm_link", "tool0", "base_link"].iter().enumerate() {
        let frames = whole["frames"].as_array().expect("frames");
        let there = frames.iter().find(|f| f["name"] == *name).expect("a link");
        let rows = |v: &Value| -> Vec<f64> {
            let rows = v.as_array().expect("rows").iter().flat_map(|r| r.as_array().expect("a row").clone());
            rows.map(|x| x.as_f64().expect("a number")).collect()
        };
        let (a, b) = (rows(&there["pose"]), rows(&some["frames"][k]));
        let off = a.iter().zip(&b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(off < 1e-12 && a.len() == b.len(), "{name}: {a:?} {b:?}");
    }
    let (_, text, _) = run(&["fk", &file, "--tip", "tool0", "--frames", "forearm_link", "-q", q]);
    assert!(text.contains("→ forearm_link) ="), "{text}");
    let (code, _, said) =
        run(&["fk", &file, "--tip", "tool0", "--frames", "robotiq_85_left_finger_tip_link", "-q", q]);
    assert!(code == 2 && said.contains("no frame"), "{said}");
}

/// A word that is the variable of one joint and the name of another names neither.
#[test]
fn a_name_that_is_anothers_variable_is_refused() {
    let rows = "name = \"t\"\nconvention = \"standard\"\n[[joints]]\nname = \"q2\"\ntheta = \"q1\"\na = 1\n\
                [[joints]]\nname = \"q1\"\ntheta = \"q2\"\na = 1\n";
    let file = File::new("crossed.toml", rows);
    let (code, _, said) = run(&["fk", file.name(), "-q", "q2=1"]);
    assert!(code == 2 && said.contains("`q2` is the variable of joint 2 and the name of joint 1"), "{said}");
    assert_eq!(run(&["fk", file.name(), "-q", "2=1"]).0, 0);
}

/// What MuJoCo refuses to be a body is written without its mass, and that is said.
#[test]
fn masses_that_no_body_has_are_said() {
    let rows = "name = \"t\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\na = 1\nmass = 1\ncom = [0, 0, 0]\n\
                inertia = [1, 0, 0, 0.1, 0, 0.1]\n";
    let file = File::new("impossible.toml", rows);
    let (_, model, said) = run(&["convert", file.name(), "--to", "mjcf"]);
    assert!(
        said.contains("MuJoCo refuses the masses of link1") && !model.contains("<inertial"),
        "{said}{model}"
    );
}

/// Links anywhere in a tree, by their names, and a file in which nothing moves.
#[test]
fn links_are_named_without_a_tip() {
    let file = urdf("ur5_gripper");
    let pose = |frames: &str, name: &str, q: &str| {
        let (code, out, said) = run(&["fk", &file, "--frames", frames, "-q", q, "--json"]);
        assert_eq!(code, 0, "{said}");
        let answer: Value = serde_json::from_str(&out).expect("JSON");
        let all = answer["frames"].as_array().expect("frames").clone();
        let found = all.iter().find(|f| f["name"] == name).map(|f| f["pose"].clone());
        (all.len(), found.expect("the frame"))
    };
    let two = "ee_link,tool0";
    let q = "elbow_joint=0.5, shoulder_pan_joint=0.2";
    let (count, left) = pose(two, "ee_link", q);
    let (all, whole) = pose("all", "ee_link", q);
    assert!(count == 2 && all > 10 && left == whole);
    let (code, _, said) = run(&["fk", &file, "--frames", "forearm_lnk,tool0", "-q", q]);
    assert!(
        code == 2 && said.contains("there is no link `forearm_lnk`; did you mean `forearm_link`?"),
        "{said}"
    );
    let still = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'><origin xyz='1 2 3'/>\
                 <parent link='a'/><child link='b'/></joint></robot>";
    let still = File::new("still.urdf", still);
    let (code, shown, said) = run(&["fk", still.name(), "--frames", "all"]);
    assert!(code == 0 && shown.contains("no joint moves") && shown.contains("b"), "{said}{shown}");
    let (code, tree, said) = run(&["convert", still.name(), "--to", "tree"]);
    assert!(code == 0 && said.contains("no joint moves in it"), "{said}");
    let tree = File::new("still.toml", &tree);
    let (code, again, said) = run(&["fk", tree.name(), "--frames", "b"]);
    assert!(code == 0 && again.contains("b"), "{said}");
}

/// A frame whose place has no value is refused, not printed.
#[test]
fn a_frame_without_a_place_is_refused() {
    let rows = "name = \"t\"\nconvention = \"khalil\"\ntip = \"a\"\n[parameters]\nL = {}\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\n\
                [[frames]]\nname = \"f\"\non = \"a\"\nxyz = [\"L\", 0, 0]\n[poses]\nrest = [0.5]\n";
    let file = File::new("open.toml", rows);
    let (code, out, said) = run(&["fk", file.name(), "--tip", "a", "--frames", "f", "-q", "0"]);
    assert!(code == 2 && said.contains("where `f` stands has no value: L"), "{out}{said}");
    let with = ["fk", file.name(), "--tip", "a", "--frames", "f", "--set", "L=0.5", "--json", "-q"];
    let (code, out, said) = run(&[&with[..], &["0.5"]].concat());
    assert!(code == 0 && !out.contains("null"), "{said}{out}");
    // Poses of a tree are those of its chains.
    assert_eq!(run(&[&with[..], &["rest"]].concat()).1, out);
}

/// What `convert` says in JSON: the text, what has no place in it, and how it is the robot.
#[test]
fn what_convert_does_is_told_in_json() {
    let file = urdf("ur5_gripper");
    let (code, out, said) = run(&["convert", &file, "--tip", "tool0", "--to", "csv", "--json"]);
    assert!(code == 0 && said.contains("left out, as a table has no place for it: "), "{said}");
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!((&answer["schema"], &answer["chains"], &answer["proved"]), (&1.into(), &1.into(), &1.into()));
    let left: Vec<&str> =
        answer["left_out"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
    assert!(left.contains(&"masses") && left.contains(&"limits of speed"), "{left:?}");
    assert!(left.contains(&"limits of torque and force") && !left.contains(&"limits"), "{left:?}");
    assert!(answer["text"].as_str().is_some_and(|t| t.contains("min")), "{out}");
    let (code, out, said) = run(&["convert", &file, "--to", "tree", "--json"]);
    let answer: Value = serde_json::from_str(&out).expect("JSON");
    assert!(code == 0 && answer["chains"].as_u64() > Some(1) && said.contains("chains are proved"), "{said}");
}

/// Bodies with names that rows have already, or the base has, are compared by the names that they get.
#[test]
fn bodies_that_are_called_as_the_base_is() {
    let joint = |name: &str, parent: &str, child: &str, kind: &str, x: &str| {
        format!(
            "<joint name='{name}' type='{kind}'><origin xyz='{x} 0 0'/><parent link='{parent}'/><child link='{child}'/>\
             <axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
        )
    };
    let links: String =
        ["world", "base", "base body", "arm", "still"].map(|n| format!("<link name='{n}'/>")).concat();
    let text = format!(
        "<robot name='r'>{links}{}{}{}{}</robot>",
        joint("rail", "world", "base", "prismatic", "0.1"),
        joint("arm", "world", "arm", "revolute", "0.2"),
        joint("turn", "world", "base body", "revolute", "0.3"),
        joint("fixed", "world", "still", "fixed", "0.4"),
    );
    let file = File::new("called.urdf", &text);
    for to in ["tree", "par", "markdown"] {
        let (code, out, said) = run(&["convert", file.name(), "--whole", "--to", to]);
        assert!(code == 0 && said.contains("3 of 3 chains are proved to be the same"), "{to}: {said}\n{out}");
    }
}

/// What comes through standard input is read as what it is.
#[test]
fn standard_input_is_any_description() {
    let written = |to| run(&["convert", "ur5", "--to", to]).1;
    let table = "convention: standard\n\n| joint | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | 0.5 | 0 |\n| 2 | q2 | 0 | 0.3 | 0 |\n";
    let pose = |input: &str, q: &str| {
        let output = fed(&["fk", "-", "-q", q, "--json"], input);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let value: Value = serde_json::from_slice(&output.stdout).unwrap();
        value["pose"][0][3].as_f64().unwrap()
    };
    let q = "0.1,-0.4,0.3,0.2,0.5,0.6";
    let [a, b] = ["urdf", "toml"].map(|to| pose(&written(to), q));
    assert!((a - b).abs() < 1e-12, "{a} {b}");
    assert!((pose(table, "0.1,0.2") - 0.5 * 0.1f64.cos() - 0.3 * 0.3f64.cos()).abs() < 1e-12);
}
