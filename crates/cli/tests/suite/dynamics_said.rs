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
    for (robot, gravity) in [
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
            let path = file(&format!("{robot}{gravity}.{ending}"), &text(&printed.stdout));
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
