//! Closed loops on the command line.

use crate::common::{File, fed, text};
use serde_json::Value;

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = fed(arguments, "");
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

#[test]
fn every_verb_serves_a_parallelogram_as_a_chain() {
    let (code, shown, said) = run(&["show", "sr400"]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("closed loops in the mode parallelogram (=): p1 = q3 − q2 − 90°"), "{said}");
    assert!(shown.contains("q3 − q2 − 90°") && shown.contains("a spherical wrist"), "{shown}");
    assert!(shown.contains("assembly modes: = (parallelogram), x"), "{shown}");
    assert!(shown.contains("mobility 6 by rank (9 joints, constraints of rank 3"), "{shown}");
    assert!(said.contains("where sin(q2 − q3) = 0: a parallel singularity"), "{said}");
    let (code, torques, said) = run(&["dynamics", "sr400", "--symbolic"]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("the whole linkage, the links beside the chain with it: lever, rod"), "{said}");
    assert!(torques.contains("Of 80 parameters of the links, grouped, 39 have an effect"), "{torques}");
    assert!(torques.contains("proved to be independent"), "{torques}");
    let (code, _, said) = run(&["dynamics", "sr400", "--tip", "forearm", "--symbolic"]);
    assert_eq!(
        (code, said.contains("warning: this is the chain alone: the masses of lever, rod")),
        (0, true),
        "{said}"
    );
    // The solutions are in driven joints, and each reaches the pose of the configuration.
    let q = "10deg,-80deg,20deg,30deg,40deg,50deg";
    let (code, solved, said) = run(&["ik", "sr400", "-q", q, "--json"]);
    assert_eq!(code, 0, "{said}");
    let answer: Value = serde_json::from_str(&solved).expect("JSON");
    assert_eq!(answer["complete"], true);
    assert!(answer["solutions"].as_array().expect("a list").len() >= 4, "{solved}");
    for arguments in [
        vec!["fk", "sr400", "-q", q],
        vec!["fk", "sr400", "-q", "turret=0.5", "--frames", "all"],
        vec!["jacobian", "sr400", "-q", q],
        vec!["derive", "sr400"],
        vec!["ik", "sr400", "--explain"],
        vec!["ik", "palletiser", "-q", "10deg,60deg,20deg,5deg"],
        vec!["convert", "palletiser", "--to", "urdf"],
    ] {
        let (code, _, said) = run(&arguments);
        assert_eq!(code, 0, "{arguments:?}: {said}");
    }
}

#[test]
fn what_is_no_chain_says_so_and_is_served_as_it_is() {
    let (code, _, said) = run(&["derive", "akr3000"]);
    assert_eq!(code, 4);
    assert!(
        said.contains("the passive joints p1, p4 are not affine in the driven joints in the mode ++"),
        "{said}"
    );
    let (code, shown, said) = run(&["show", "akr3000"]);
    assert_eq!(code, 0, "{said}");
    assert!(shown.contains("6 driven and 6 passive joints, 2 closed loops"), "{shown}");
    assert!(shown.contains("drive of the arm: planar, R R R: p1, p3, p6 in closed form"), "{shown}");
    let (code, placed, said) = run(&["fk", "akr3000", "-q", "home"]);
    assert_eq!(code, 0, "{said}");
    assert!(placed.contains("T(base → hand)"), "{placed}");
    let (code, one, said) = run(&["fk", "four-bar", "-q", "60deg", "--mode", "open", "--json"]);
    assert_eq!(code, 0, "{said}");
    let answer: Value = serde_json::from_str(&one).expect("JSON");
    assert_eq!(
        (answer["assemblies"].as_array().map(Vec::len), &answer["assemblies"][0]["mode"]),
        (Some(1), &Value::from("+"))
    );
    assert!(answer["assemblies"][0]["residual"].as_f64().expect("a number") < 1e-12);
    let (code, formulas, said) = run(&["fk", "four-bar", "--symbolic"]);
    assert_eq!(code, 0, "{said}");
    assert!(formulas.contains("h = ±√(|P|²|A|² − k²)") && formulas.contains("t14 = "), "{formulas}");
    let (code, moved, said) = run(&["jacobian", "five-bar", "-q", "home", "--mode", "+", "--json"]);
    assert_eq!(code, 0, "{said}");
    let answer: Value = serde_json::from_str(moved.trim()).expect("JSON");
    assert_eq!((answer["free"].as_u64(), answer["rank"].as_u64()), (Some(0), Some(2)), "{moved}");
    // A dead point of the slider and crank is none of the crank: driven by it, the piston turns round there.
    let (code, still, said) = run(&["jacobian", "slider-crank", "-q", "0"]);
    assert_eq!(code, 0, "{said}");
    assert!(still.contains("a serial singularity: J has rank 0"), "{still}");
    let (code, _, said) = run(&["fk", "four-bar", "-q", "60deg", "--mode", "sideways"]);
    assert_eq!((code, said.contains("there are open, crossed, +, -")), (2, true), "{said}");
    let (code, _, said) = run(&["fk", "ur5", "-q", "0,0,0,0,0,0", "--mode", "+"]);
    assert_eq!((code, said.contains("--mode is for closed loops")), (2, true), "{said}");
}

#[test]
fn linkages_have_inverse_kinematics_and_dynamics() {
    let (code, solved, said) = run(&["ik", "five-bar", "--position", "-q", "home", "--json"]);
    assert_eq!(code, 0, "{said}");
    let answer: Value = serde_json::from_str(&solved).expect("JSON");
    assert_eq!((&answer["complete"], &answer["closed_form"]), (&true.into(), &true.into()));
    assert_eq!(answer["solutions"].as_array().map(Vec::len), Some(4), "{solved}");
    let (code, _, said) = run(&["ik", "five-bar", "--position", "--pose", "100, 0, 0"]);
    assert_eq!((code, said.contains("not reachable")), (1, true), "{said}");
    let (code, _, said) = run(&["ik", "five-bar", "--position", "--pose", "0, 0, 1"]);
    assert_eq!((code, said.contains("moves in a plane")), (1, true), "{said}");
    let (code, _, said) = run(&["ik", "five-bar", "--explain"]);
    assert_eq!(code, 4, "{said}");
    let (code, solved, said) = run(&["ik", "akr3000", "-q", "home"]);
    assert_eq!((code, solved.contains("there may be more")), (0, true), "{said}");

    let state = ["four-bar", "-q", "50deg", "--qd", "1", "--qdd", "2", "--json"];
    let (code, found, said) = run(&[&["dynamics"], &state[..]].concat());
    assert_eq!(code, 0, "{said}");
    let answer: Value = serde_json::from_str(&found).expect("JSON");
    assert_eq!((&answer["mode"], answer["passive"].as_array().map(Vec::len)), (&"+".into(), Some(3)));
    let torque = answer["torques"][0].as_f64().expect("a number");
    let (code, found, said) =
        run(&["dynamics", "four-bar", "-q", "50deg", "--qd", "1", "--tau", &torque.to_string(), "--json"]);
    assert_eq!(code, 0, "{said}");
    let answer: Value = serde_json::from_str(&found).expect("JSON");
    assert!((answer["accelerations"][0].as_f64().expect("a number") - 2.0).abs() < 1e-9, "{found}");
    let (code, fallen, said) = run(&["dynamics", "four-bar", "-q", "50deg", "--simulate", "2", "--json"]);
    assert_eq!(code, 0, "{said}");
    let motion: Value = serde_json::from_str(&fallen).expect("JSON");
    assert!(motion["drift"].as_f64().expect("a number") < 1e-6, "{}", motion["drift"]);
    assert_eq!(motion["samples"][0]["q"].as_array().map(Vec::len), Some(4));
    let (code, _, said) = run(&["dynamics", "four-bar", "--symbolic"]);
    assert_eq!((code, said.contains("are not couplings of the driven ones")), (4, true), "{said}");
    let (code, _, said) = run(&["dynamics", "five-bar", "-q", "home"]);
    assert_eq!((code, said.contains("says nothing of masses")), (3, true), "{said}");
}

#[test]
fn a_linkage_is_written_and_read_again() {
    for (to, ending) in [("par", "par"), ("tree", "toml")] {
        let (code, written, said) = run(&["convert", "akr3000", "--to", to]);
        assert_eq!(code, 0, "{said}");
        assert!(said.contains("its loops close where these do"), "{said}");
        let file = File::new(&format!("akr.{ending}"), &written);
        let (code, shown, said) = run(&["show", file.name()]);
        assert_eq!(code, 0, "{said}");
        assert!(shown.contains("mobility 6 by rank (12 joints"), "{shown}");
    }
}

#[test]
fn what_is_wrong_with_loops_has_its_place() {
    let text = "name = \"x\"\nconvention = \"khalil\"\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\n[[joints]]\nname = \"b\"\nd = 1\n\
        theta = \"p1\"\n[[joints]]\nname = \"c\"\nafter = \"base\"\nd = 4\ntheta = \"p2\"\n[[closures]]\n\
        left = { after = \"b\", d = 3, b = 0.001, theta = \"p3\" }\nright = { after = \"c\", d = 3 }\n";
    let file = File::new("jammed.toml", text);
    let (code, _, said) = run(&["show", file.name()]);
    assert_eq!(code, 3, "{said}");
    assert!(
        said.contains(":15:1: error: `loop 1` cannot be assembled: its sides end 1.000e-3 m apart"),
        "{said}"
    );
}

#[test]
fn a_model_of_mujocos_with_a_loop_is_a_linkage() {
    let model = |closed: &str| {
        format!(
            "<mujoco model='four-bar'><worldbody>
  <body name='crank'><joint name='crank'/><geom size='0.01'/>
    <body name='coupler' pos='1 0 0' euler='0 0 36.86989765'><joint name='coupler'/><geom size='0.01'/>
      <site name='point' pos='2 0 0'/></body></body>
  <body name='rocker' pos='5 0 0'><joint name='rocker'/><geom size='0.01'/></body>
</worldbody><equality>{closed}</equality><actuator><motor joint='crank'/></actuator></mujoco>"
        )
    };
    let file =
        File::new("loop.xml", &model("<connect name='pin' body1='coupler' body2='rocker' anchor='4 0 0'/>"));
    let (code, shown, said) = run(&["show", file.name()]);
    assert_eq!(code, 0, "{said}");
    assert!(shown.contains("1 driven and 3 passive joints, 1 closed loop"), "{shown}");
    assert!(shown.contains("pin: planar, R R R: p1, p2, p3 in closed form"), "{shown}");
    let (code, placed, said) = run(&["fk", file.name(), "-q", "0.4", "--json"]);
    assert_eq!(code, 0, "{said}");
    assert!(placed.contains("\"point\""), "{placed}");
    // What cannot be assembled is left, as it was.
    let file =
        File::new("open.xml", &model("<weld body1='coupler' body2='rocker' relpose='0 0 1 1 0 0 0'/>"));
    let (code, _, said) = run(&["show", file.name(), "--tip", "point"]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("the closed loops are left: joints move as if they were open"), "{said}");
}
