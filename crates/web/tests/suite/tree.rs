//! URDF and xacro with the files around them, as they are dropped on the page.

use crate::ask::{ask, far, numbers, told};
use serde_json::{Value, json};

/// Two arms of two joints on one trunk, the second with a joint more where `more` is.
fn two_arms(more: bool) -> String {
    let links = ["trunk", "l1", "l2", "r1", "r2", "r3"];
    let links: String =
        links.iter().filter(|l| more || **l != "r3").map(|l| format!("<link name=\"{l}\"/>")).collect();
    let joint = |name: &str, from: &str, to: &str, y: &str| {
        format!(
            "<joint name=\"{name}\" type=\"revolute\"><parent link=\"{from}\"/><child link=\"{to}\"/>\
             <origin xyz=\"0.3 {y} 0\" rpy=\"1.5708 0 0\"/><axis xyz=\"0 0 1\"/>\
             <limit lower=\"-1\" upper=\"2\" velocity=\"3\" effort=\"1\"/></joint>\n"
        )
    };
    let mut joints = joint("left_shoulder", "trunk", "l1", "0.2") + &joint("left_elbow", "l1", "l2", "0");
    joints += &(joint("right_shoulder", "trunk", "r1", "-0.2") + &joint("right_elbow", "r1", "r2", "0"));
    if more {
        joints += &joint("right_hand", "r2", "r3", "0");
    }
    format!("<?xml version=\"1.0\"?>\n<robot name=\"pair\">{links}\n{joints}</robot>")
}

fn messages(answer: &Value) -> String {
    let all = answer["findings"].as_array().into_iter().flatten();
    all.map(|f| format!("{} {}\n", f["message"], f["hint"])).collect()
}

#[test]
fn a_chain_is_taken_and_another_one_is_chosen() {
    let text = two_arms(true);
    let open = |base: Value, tip: Value| {
        told(
            "tree",
            json!({ "name": "pair.urdf", "text": text, "base": base, "tip": tip, "convention": "craig" }),
        )
    };
    let answer = open(Value::Null, Value::Null);
    assert_eq!(answer["tree"]["tip"], "r3");
    assert_eq!(answer["tree"]["base"], "trunk");
    assert_eq!(answer["tree"]["tips"], json!(["l2", "r3"]));
    assert_eq!(answer["file"]["convention"], "craig");
    assert_eq!(answer["file"]["joints"][0]["name"], "right_shoulder");
    let words = answer["tree"]["words"].as_str().expect("words");
    assert!(
        words.contains("from `trunk` to `r3`, 3 joints; its table is proved to be the file's chain"),
        "{words}"
    );
    assert!(words.ends_with("The file gives limits for all, no inertias"), "{words}");
    assert!(messages(&answer).contains("1.5708 is read as π/2"), "{}", messages(&answer));
    // From hand to hand, up the tree and down.
    let across = open(json!("l2"), json!("r2"));
    let names: Vec<&Value> =
        across["file"]["joints"].as_array().into_iter().flatten().map(|j| &j["name"]).collect();
    assert_eq!(names.iter().filter(|n| n.is_string()).count(), 4, "{names:?}");
    // The hand is where the joints of the file put it: both shoulders and elbows are a quarter turn about x apart.
    let edited = told("edit", json!({ "file": answer["file"] }));
    let limits = numbers(&edited["robot"]["joints"][0]["limits"]);
    assert_eq!(limits, [-1.0, 2.0]);
    let scene = told("scene", json!({ "q": [0, 0, 0] }));
    let tool = scene["frames"].as_array().and_then(|f| f.last()).expect("a tool");
    // Rx(90°)³ = Rx(270°), each joint 0.3 along x; y only in front of the first turn.
    let right = json!([[1, 0, 0, 0.9], [0, 0, 1, -0.2], [0, -1, 0, 0], [0, 0, 0, 1]]);
    assert!(far(tool, &right) < 1e-15, "{tool}");
}

#[test]
fn several_tips_are_listed_for_a_choice() {
    let open = |tip: Value| told("tree", json!({ "name": "pair.urdf", "text": two_arms(false), "tip": tip }));
    let answer = open(Value::Null);
    assert!(answer["file"].is_null());
    assert_eq!(answer["tree"]["tips"], json!(["l2", "r2"]));
    assert!(answer["tree"]["tip"].is_null());
    assert!(messages(&answer).contains("choose where the chain ends"), "{answer}");
    assert_eq!(open(json!("l2"))["file"]["joints"][0]["name"], "left_shoulder");
    // A name that is none gets the one that was meant.
    let wrong = open(json!("l22"));
    assert!(wrong["file"].is_null() && messages(&wrong).contains("did you mean `l2`"), "{wrong}");
    assert_eq!(wrong["tree"]["links"].as_array().map(Vec::len), Some(5));
}

#[test]
fn errors_have_their_file_line_and_column() {
    let text = "<robot name=\"x\">\n  <link name=\"a\"/>\n  <link name=\"a\"/>\n</robot>";
    let answer = told("tree", json!({ "name": "x.urdf", "text": text }));
    assert!(answer["file"].is_null() && answer["tree"].is_null());
    let error = &answer["findings"][1];
    assert_eq!((&error["at"]["line"], &error["at"]["column"]), (&json!(3), &json!(3)), "{answer}");
    // In a file that is included, with its name.
    let main = "<robot xmlns:xacro=\"x\" name=\"x\"><xacro:include filename=\"$(find arm)/urdf/part.xacro\"/></robot>";
    let part = "<robot>\n<link name=\"a\"/><joint name=\"j\" type=\"turning\"/></robot>";
    let around = json!({ "texts": [["ws/arm/urdf/part.xacro", part], ["ws/arm/urdf/main.xacro", main]] });
    let answer = told("tree", json!({ "name": "ws/arm/urdf/main.xacro", "text": main, "around": around }));
    let error = answer["findings"].as_array().into_iter().flatten().find(|f| f["severity"] == "error");
    let error = error.expect("an error");
    assert_eq!(
        (&error["source"], &error["at"]["line"]),
        (&json!("ws/arm/urdf/part.xacro"), &json!(2)),
        "{answer}"
    );
    for text in ["", "<robot", "<robot/>", "<sdf/>", "a table", "<robot><link name='a'/></robot>"] {
        let answer = told("tree", json!({ "name": "x", "text": text }));
        assert!(answer["file"].is_null() && !messages(&answer).is_empty(), "{text}: {answer}");
    }
    assert!(ask("tree", json!({ "name": "x", "text": "", "convention": "roman" }))["error"].is_string());
}

#[test]
fn files_are_found_below_the_top_and_nowhere_else() {
    let arm = "<robot xmlns:xacro=\"x\"><xacro:macro name=\"arm\" params=\"p\"><link name=\"${p}a\"/><link name=\"${p}b\"/>\
        <joint name=\"${p}j\" type=\"continuous\"><parent link=\"${p}a\"/><child link=\"${p}b\"/>\
        <origin rpy=\"${radians(90)} 0 0\"/></joint></xacro:macro></robot>";
    let manifest = "<package><name> my_arm </name></package>";
    let open = |name: &str, include: &str| {
        let main = format!(
            "<robot xmlns:xacro=\"x\" name=\"x\"><xacro:arg name=\"p\" default=\"r_\"/>\
             <xacro:include filename=\"{include}\"/><xacro:arm p=\"$(arg p)\"/></robot>"
        );
        let around = json!({
            "texts": [["ws/folder/package.xml", manifest], ["ws/folder/macros/arm.xacro", arm], ["secret.xacro", arm]],
            "packages": [["elsewhere", "ws/folder/macros"]],
        });
        told("tree", json!({ "name": name, "text": main, "around": around, "arguments": [["p", "s_"]] }))
    };
    let name = "ws/folder/urdf/main.xacro";
    let found = [
        "$(find my_arm)/macros/arm.xacro",
        "$(find folder)/macros/arm.xacro",
        "$(find elsewhere)/arm.xacro",
        "../macros/arm.xacro",
        "./../macros/./arm.xacro",
    ];
    for include in found {
        let answer = open(name, include);
        assert_eq!(answer["file"]["joints"][0]["name"], "s_j", "{include}: {answer}");
    }
    for include in ["../../../../secret.xacro", "$(find nothing)/arm.xacro", "arm.xacro", "/etc/passwd"] {
        let answer = open(name, include);
        assert!(answer["file"].is_null() && !messages(&answer).is_empty(), "{include}: {answer}");
    }
    assert!(messages(&open(name, "../../../../secret.xacro")).contains("outside of what was dropped"));
    assert!(messages(&open(name, "../x.xacro")).contains("open its whole folder"));
}

/// An arm with a gripper whose second finger follows the first, and a mast beside.
const GRIPPER: &str = r#"<robot name="g">
<material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
<link name="base"><visual><geometry><box size="0.2 0.3 0.1"/></geometry><material name="grey"/></visual></link>
<link name="mast"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
<link name="arm"><visual><origin xyz="0 0 0.5" rpy="0 1.5708 0"/>
  <geometry><mesh filename="package://arm/meshes/arm.stl" scale="0.001 0.001 0.001"/></geometry></visual></link>
<link name="left"><visual><geometry><mesh filename="../meshes/../meshes/left.dae"/></geometry></visual></link>
<link name="right"><visual><geometry><mesh filename="package://arm/../../secret.stl"/></geometry></visual>
  <visual><geometry><mesh filename="package://hand/right.stl"/></geometry></visual>
  <visual><geometry><mesh filename="package://hand/nail.stl"/></geometry></visual>
  <visual><geometry><cone/></geometry></visual><visual><geometry><box size="1 2"/></geometry></visual></link>
<joint name="m" type="revolute"><parent link="base"/><child link="mast"/><origin xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="q" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 2"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="l" type="prismatic"><parent link="arm"/><child link="left"/><origin xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
<joint name="r" type="prismatic"><parent link="arm"/><child link="right"/><origin xyz="0 0 1"/><mimic joint="l" multiplier="-2" offset="0.5"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
</robot>"#;

#[test]
fn bodies_look_as_the_file_says_and_move_with_the_chain() {
    let others = ["ws/arm/meshes/arm.stl", "ws/arm/meshes/left.dae", "secret.stl", "ws/secret.stl"];
    let open = |base: &str, tip: &str| {
        told(
            "tree",
            json!({ "name": "ws/arm/urdf/g.urdf", "text": GRIPPER, "base": base, "tip": tip, "around": { "others": others } }),
        )
    };
    let answer = open("base", "left");
    let looks = &answer["looks"];
    assert_eq!((&looks["base"], &looks["bodies"]), (&json!(0), &json!(5)));
    let parts = looks["parts"].as_array().expect("parts");
    let shapes: Vec<(&Value, &Value)> = parts.iter().map(|p| (&p["body"], &p["shape"])).collect();
    let expected = [(0, "box"), (1, "sphere"), (2, "mesh"), (3, "mesh")].map(|(b, s)| (json!(b), json!(s)));
    assert_eq!(shapes, expected.iter().map(|(b, s)| (b, s)).collect::<Vec<_>>());
    assert_eq!(parts[0]["colour"], json!([0.5, 0.5, 0.5, 1.0]));
    assert_eq!(parts[0]["size"], json!([0.2, 0.3, 0.1]));
    assert!(parts[1]["colour"].is_null());
    assert_eq!(parts[2]["file"], "ws/arm/meshes/arm.stl");
    assert_eq!(parts[2]["size"], json!([0.001, 0.001, 0.001]));
    // Ry(90°): z of the mesh lies along x of the link.
    let right = json!([[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0.5], [0, 0, 0, 1]]);
    assert!(far(&parts[2]["origin"], &right) < 1e-5, "{}", parts[2]["origin"]);
    // A path may lead up and down below the top.
    assert_eq!(parts[3]["file"], "ws/arm/meshes/left.dae");
    let of = |answer: &Value, child: u64| -> Value {
        let joints = answer["looks"]["joints"].as_array().into_iter().flatten();
        let joint = joints.into_iter().find(|j| j["child"] == child).expect("a joint");
        json!([joint["kind"], joint["variable"], joint["factor"], joint["offset"]])
    };
    assert_eq!(of(&answer, 1), json!(["R", null, 0.0, 0.0]), "the mast stands");
    assert_eq!(of(&answer, 2), json!(["R", 0, 1.0, 0.0]));
    assert_eq!(of(&answer, 3), json!(["P", 1, 1.0, 0.0]));
    assert_eq!(of(&answer, 4), json!(["P", 1, -2.0, 0.5]), "the other finger follows");
    // Of a chain to the finger that follows, its own value is the variable: r = −2 l + 0.5, so l = −r/2 + 0.25.
    let other = open("mast", "right");
    assert_eq!(other["looks"]["base"], 1);
    assert_eq!(of(&other, 4), json!(["P", 2, 1.0, 0.0]));
    assert_eq!(of(&other, 3), json!(["P", 2, -0.5, 0.25]));
    assert_eq!(of(&other, 1), json!(["R", 0, 1.0, 0.0]));
    // One note for each package, a warning for each shape that is none, and nothing of it stops the robot.
    let said = messages(&answer);
    assert!(said.contains("2 meshes of the package `hand` are not among the files, the first one is `package://hand/right.stl`"), "{said}");
    assert!(
        said.contains("1 mesh of the package `arm` is not among the files"),
        "a package is left by no name: {said}"
    );
    assert!(said.contains("<cone> is no shape that is known"), "{said}");
    assert!(said.contains("`size` is not 3 numbers"), "{said}");
    assert!(answer["findings"].as_array().into_iter().flatten().all(|f| f["severity"] != "error"), "{said}");
}

#[test]
fn meshes_are_found_without_the_top_of_their_package() {
    let text = "<robot name=\"r\"><link name=\"a\"><visual><geometry>\
        <mesh filename=\"package://all/robots/arm/meshes/a.stl\"/></geometry></visual></link><link name=\"b\"/>\
        <joint name=\"j\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>";
    let open = |others: &[&str]| {
        let answer = told("tree", json!({ "name": "r.urdf", "text": text, "around": { "others": others } }));
        answer["looks"]["parts"][0]["file"].clone()
    };
    assert_eq!(open(&["arm/meshes/a.stl", "meshes/a.stl"]), "arm/meshes/a.stl");
    assert_eq!(open(&["x/meshes/a.stl"]), "x/meshes/a.stl");
    // Of two that fit none is taken; nor a file by its last word alone.
    assert!(open(&["x/meshes/a.stl", "y/meshes/a.stl"]).is_null());
    assert!(open(&["x/a.stl", "a.stl", "x/otherarm/a.stl"]).is_null());
}
