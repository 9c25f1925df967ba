//! What `denavit dynamics` says of options and files, and that `check` reads what it prints.

use crate::common::{fed, text};
use crate::dynamics::{file, refused};
use serde_json::Value;

const ONE: &str = "name = '1R'\nconvention = 'craig'\n[[joints]]\ntheta = 'q1'\nmass = 2\ncom = ['0.3', 0, 0]\ncoulomb = '0.2'\n";

/// An option that would change nothing is an error.
#[test]
fn no_option_is_passed_over() {
    let arm = file("said.toml", ONE);
    refused(&[&arm, "-q", "0", "--at", "tool"], 2, "give --wrench, too");
    refused(&[&arm, "--symbolic", "--derivatives"], 2, "--derivatives");
    refused(&[&arm, "--explain", "--derivatives"], 2, "--derivatives");
    let answer = fed(
        &["dynamics", &arm, "--input", "-", "--derivatives"],
        "{\"q\": [0.1], \"wrench\": [0,0,1,0,0,0]}\n",
    );
    let said = text(&answer.stdout) + &text(&answer.stderr);
    assert!(said.contains("--derivatives"), "{said}");
}

/// Options of one that is excluded by a third are refused, as clap alone does not, for every verb.
#[test]
fn options_of_one_that_is_not_there_are_refused() {
    let arm = file("alone.toml", ONE);
    for (arguments, says) in [
        (&["dynamics", &arm, "--symbolic", "--csv"][..], "--csv is for --simulate"),
        (&["dynamics", &arm, "--explain", "--plot", "f.svg"], "--plot is for --simulate"),
        (&["dynamics", &arm, "--input", "-", "--dt", "1"], "--dt is for --simulate"),
        (&["dynamics", &arm, "--input", "-", "--tau-file", "-"], "--tau-file is for --simulate"),
        (&["jacobian", "ur5", "--explain", "--rates", "1,2,3,4,5,6"], "--rates is for --joints"),
        (&["jacobian", "ur5", "-q", "0,0,0,0,0,0", "--position"], "--position is for --explain"),
        (&["ik", "ur5", "-q", "0,0,0,0,0,0", "--orientation", "zyz"], "--orientation is for --pose"),
        (&["show", "ur5", "--json", "--scheme"], "--scheme is for --figure"),
        (&["path", "ur5", "-q", "0,0,0,0,0,0", "--joint", "0,0,0,0,0,1", "--screw"], "--screw is for --line"),
        (&["calibrate", &arm, "--choose", "10", "--robust"], "--robust is for <FILE>"),
        (&["identify", &arm, "run.csv", "--harmonics", "4"], "--harmonics is for --excite"),
    ] {
        let answer = fed(arguments, "");
        let said = text(&answer.stderr);
        assert_eq!(answer.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(
            said.contains(says) && said.contains(&format!("denavit {}", arguments[0])),
            "{arguments:?}: {said}"
        );
        assert!(answer.stdout.is_empty(), "{arguments:?}");
    }
    // Derivatives go with a stream, too.
    let answer = fed(&["dynamics", &arm, "--input", "-", "--derivatives"], "0.1\n");
    assert!(text(&answer.stdout).contains("by_q"), "{}", text(&answer.stdout));
}

/// Numbers that doubles do not hold are no answer, in a line of a stream as alone.
#[test]
fn states_beyond_doubles_are_refused() {
    let arm = file(
        "beyond.toml",
        "name = '1R'\nconvention = 'craig'\n[[joints]]\ntheta = 'q1'\nmass = 2\ncom = ['0.3', 0, 0]\n",
    );
    refused(&[&arm, "-q", "0", "--qd", "1e200"], 3, "doubles do not hold");
    let answer = fed(&["dynamics", &arm, "--input", "-"], "0.1, 1e200\n0.1, 1\n");
    let lines: Vec<String> = text(&answer.stdout).lines().map(String::from).collect();
    assert!(lines[0].contains("doubles do not hold") && lines[1].contains("torques"), "{lines:?}");
}

/// A link of a tree exerts what a chain to it exerts; states of a tree come line by line, and its motion keeps the energy.
#[test]
fn trees_have_wrenches_streams_and_motions() {
    let baxter = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot/tests/urdf/baxter.urdf");
    let of = |arguments: &[&str]| -> Value {
        let answer = fed(&[&["dynamics", baxter], arguments, &["--json"]].concat(), "");
        assert_eq!(answer.status.code(), Some(0), "{arguments:?}: {}", text(&answer.stderr));
        serde_json::from_str(&text(&answer.stdout)).expect("JSON")
    };
    let all = |v: &Value| -> Vec<f64> { v.as_array().unwrap().iter().filter_map(Value::as_f64).collect() };
    let wrench = ["--wrench", "3,-2,5,0.4,0.1,-0.7"];
    let chain = of(&[&["--tip", "left_wrist", "-q", "0.3,-0.4,0.2,0.7,-0.1,0.5,0.9"], &wrench[..]].concat());
    let names = "left_s0=0.3, left_s1=-0.4, left_e0=0.2, left_e1=0.7, left_w0=-0.1, left_w1=0.5, left_w2=0.9";
    let tree = of(&[&["--whole", "--at", "left_wrist", "-q", names], &wrench[..]].concat());
    // The joints of the arm, in their order; the others hold nothing.
    let own: Vec<f64> = all(&tree["wrench"]).into_iter().filter(|t| *t != 0.0).collect();
    let wanted: Vec<f64> = all(&chain["wrench"]).into_iter().filter(|t| t.abs() > 1e-12).collect();
    assert!(!wanted.is_empty() && own.len() == wanted.len(), "{own:?} {wanted:?}");
    assert!(own.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{own:?} {wanted:?}");
    refused(
        &[&[baxter, "--whole", "-q", names], &wrench[..]].concat(),
        2,
        "name the link that exerts it with --at",
    );
    refused(
        &[&[baxter, "--whole", "--at", "hand", "-q", names], &wrench[..]].concat(),
        2,
        "there is no such link",
    );
    let (q, torques) = (&tree["q"], &tree["torques"]);
    let line = format!("{{\"q\": {q}, \"wrench\": [3,-2,5,0.4,0.1,-0.7]}}\n");
    let answer = fed(&["dynamics", baxter, "--whole", "--at", "left_wrist", "--input", "-"], &line);
    let found: Value = serde_json::from_str(&text(&answer.stdout)).expect("JSON");
    assert_eq!(&found["torques"], torques);
    let answer = fed(&["dynamics", baxter, "--whole", "--input", "-"], &line);
    assert!(text(&answer.stdout).contains("--at LINK"), "{}", text(&answer.stdout));
    let moved = of(&["--whole", "-q", names, "--simulate", "0.1"]);
    let count = moved["samples"].as_array().map_or(0, Vec::len);
    assert!(
        count > 100 && moved["drift"].as_f64().is_some_and(|d| d.abs() < 1e-9),
        "{count} {}",
        moved["drift"]
    );
}

/// Axes at no usual angles make base parameters of millions of terms: that is said in time, and its numbers are there all the same.
#[test]
fn formulas_without_end_are_not_begun() {
    let link = |k: usize| {
        format!(
            "<link name='l{k}'><inertial><origin xyz='0.1 0.2 0.3'/><mass value='1.{k}'/>\
             <inertia ixx='1' iyy='1.1' izz='1.2' ixy='0.1' ixz='0.2' iyz='0.05'/></inertial></link>"
        )
    };
    let joint = |k: usize| {
        format!(
            "<joint name='j{k}' type='continuous'><parent link='l{}'/><child link='l{k}'/>\
             <origin xyz='0.11 0.2{k} 0.31' rpy='0.3{k} 0.5 0.71'/><axis xyz='0.2{k} 0.33 0.9'/></joint>",
            k - 1
        )
    };
    let parts: String = (1..=4).map(|k| link(k) + &joint(k)).collect();
    let arm = file("askew.urdf", &format!("<robot name='r'>{}{parts}</robot>", link(0)));
    refused(&[&arm, "--whole", "--symbolic"], 5, "literals as a formula");
    let answer = fed(&["dynamics", &arm, "--whole", "-q", "j1=0.3"], "");
    assert_eq!(answer.status.code(), Some(0), "{}", text(&answer.stderr));
}

/// A joint with Coulomb's friction that stands still: what the friction is there is not known.
#[test]
fn friction_at_rest_is_said() {
    let arm = file("rest.toml", ONE);
    for (more, is_said) in
        [(&["--tau", "0.1"][..], true), (&[], true), (&["--tau", "0.1", "--qd", "0.5"], false)]
    {
        let answer = fed(&[&["dynamics", &arm, "-q", "0"], more].concat(), "");
        assert_eq!(answer.status.code(), Some(0));
        let said =
            text(&answer.stderr).contains("Coulomb's friction counts as 0 of joints that stand still (q1)");
        assert_eq!(said, is_said, "{more:?}: {}", text(&answer.stderr));
    }
}

#[test]
fn masses_that_cannot_be_are_refused_with_their_line() {
    let urdf = |mass: &str| {
        format!(
            "<robot name='r'>\n<link name='a'/>\n<link name='b'>\n<inertial>\n<mass value='{mass}'/>\n\
             <inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>\n\
             <joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint></robot>"
        )
    };
    let negative = file("negative.urdf", &urdf("-1"));
    for options in [&["-q", "0"][..], &["-q", "j=0", "--whole"]] {
        let arguments = [&[negative.as_str()], options].concat();
        refused(&arguments, 3, "negative; no motion follows from it");
        refused(&arguments, 3, "negative.urdf:4:");
    }
    // Where it is needs no mass.
    assert_eq!(fed(&["fk", &negative, "-q", "0"], "").status.code(), Some(0));
    let none = file("none.urdf", &urdf("nan"));
    refused(&[&none, "-q", "0"], 3, "`nan` is no decimal number");
    let said = text(&fed(&["dynamics", &none, "-q", "0"], "").stderr);
    assert!(!said.contains("<inertial> has no"), "{said}");
}

/// All formulas that it prints are proved when they are checked.
#[test]
fn what_it_prints_is_proved() {
    let level = file(
        "level.toml",
        "name = 'level'\nconvention = 'standard'\n[parameters]\na1 = ''\na2 = ''\na3 = ''\n[[joints]]\ntheta = 'q1'\na = 'a1'\n\
         [[joints]]\ntheta = 'q2'\na = 'a2'\n[[joints]]\ntheta = '-q1 - q2'\na = 'a3'\n",
    );
    for (robot, gravity) in [
        (level.as_str(), "-y"),
        ("planar-2r", "-y"),
        ("planar-2r", "x"),
        ("planar-3r", "-y"),
        ("scara", "-z"),
        ("articulated-3r", "-z"),
    ] {
        for (format, ending) in [("markdown", "md"), ("latex", "tex")] {
            let printed =
                fed(&["dynamics", robot, "--symbolic", "--gravity", gravity, "--format", format], "");
            assert_eq!(printed.status.code(), Some(0), "{}", text(&printed.stderr));
            let name = robot.rsplit(['/', '\\']).next().unwrap_or(robot);
            let path = file(&format!("{name}{gravity}.{ending}"), &text(&printed.stdout));
            let answer = fed(&["check", robot, &path, "--json", "-a"], "");
            let found: Value = serde_json::from_str(&text(&answer.stdout)).expect("JSON");
            let claims = found["claims"].as_array().expect("a list");
            let torques = claims.iter().filter(|c| c["about"] == "a torque").count();
            assert!(torques > 1, "{robot} {format}: {claims:?}");
            let left: Vec<&Value> = claims.iter().filter(|c| c["verdict"] != "equal").collect();
            assert!(left.is_empty(), "{robot} {format}: {left:?}");
            assert_eq!(
                found["unjudged"].as_array().map(Vec::len),
                Some(0),
                "{robot} {format}: {}",
                found["unjudged"]
            );
        }
    }
}
