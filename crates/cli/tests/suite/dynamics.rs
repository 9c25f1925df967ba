//! `denavit dynamics`.

use crate::common::{fed, text};
use serde_json::Value;

/// Two links in a vertical plane with point masses, as Craig has them (section 6.7), and friction.
const TWO_LINKS: &str = "name = '2R'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n\
    [[joints]]\ntheta = 'q1'\nmass = '4.6'\ncom = ['0.5', 0, 0]\nviscous = '0.5'\n\
    [[joints]]\na = '0.5'\ntheta = 'q2'\nmass = '2.3'\ncom = ['0.4', 0, 0]\ncoulomb = '0.2'\n";

/// The file of a test, by its name.
fn file(name: &str, contents: &str) -> String {
    let path = std::env::temp_dir().join(format!("denavit-dynamics-{}-{name}", std::process::id()));
    std::fs::write(&path, contents).expect("a file");
    path.to_string_lossy().into_owned()
}

fn json(arguments: &[&str]) -> Value {
    let output = fed(&[&["dynamics"], arguments, &["--json"]].concat(), "");
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", text(&output.stderr));
    serde_json::from_str(&text(&output.stdout)).expect("one JSON value")
}

fn numbers(v: &Value) -> Vec<f64> {
    v.as_array().unwrap_or_else(|| panic!("{v}")).iter().filter_map(Value::as_f64).collect()
}

#[track_caller]
fn refused(arguments: &[&str], code: i32, says: &str) {
    let output = fed(&[&["dynamics"], arguments].concat(), "");
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
    assert!(text(&output.stderr).contains(says), "{arguments:?}: {}", text(&output.stderr));
    assert!(output.stdout.is_empty(), "{arguments:?}: data after a refusal");
}

/// By Craig's formulas, with the friction of the file; the torques give the accelerations back.
#[test]
fn torques_and_accelerations_of_two_links() {
    let arm = file("two.toml", TWO_LINKS);
    let state = [&arm, "-q", "0.4,-1.1", "--qd", "0.7,-1.3"];
    let a = json(&[&state[..], &["--qdd", "2 rad/s²,0.6"]].concat());
    let (m1, m2, l1, l2, g) = (4.6, 2.3, 0.5, 0.4, 9.81);
    let (c1, c2, s2, c12) = (0.4_f64.cos(), 1.1_f64.cos(), -1.1_f64.sin(), 0.7_f64.cos());
    let inertia = [
        l2 * l2 * m2 + 2.0 * l1 * l2 * m2 * c2 + l1 * l1 * (m1 + m2),
        l2 * l2 * m2 + l1 * l2 * m2 * c2,
        l2 * l2 * m2,
    ];
    let velocity =
        [-m2 * l1 * l2 * s2 * 1.3 * 1.3 + 2.0 * m2 * l1 * l2 * s2 * 0.7 * 1.3, m2 * l1 * l2 * s2 * 0.7 * 0.7];
    let gravity = [m2 * l2 * g * c12 + (m1 + m2) * l1 * g * c1, m2 * l2 * g * c12];
    let friction = [0.5 * 0.7, -0.2];
    let torques = [
        inertia[0] * 2.0 + inertia[1] * 0.6 + velocity[0] + gravity[0] + friction[0],
        inertia[1] * 2.0 + inertia[2] * 0.6 + velocity[1] + gravity[1] + friction[1],
    ];
    let near = |what: &str, found: &Value, wanted: &[f64]| {
        let off = numbers(found).iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(numbers(found).len() == wanted.len() && off < 1e-12, "{what}: {found} {wanted:?}");
    };
    near("torques", &a["torques"], &torques);
    near("A", &a["inertia"][0], &inertia[..2]);
    near("A", &a["inertia"][1], &inertia[1..]);
    near("velocity", &a["velocity"], &velocity);
    near("gravity", &a["gravity"], &gravity);
    near("friction", &a["friction"], &friction);
    let pushed = format!("{},{}", torques[0], torques[1]);
    let back = json(&[&state[..], &["--tau", &pushed]].concat());
    near("accelerations", &back["accelerations"], &[2.0, 0.6]);
    // A downward push of 10 N of the tool at the second link's frame.
    let pressed = json(&[&state[..], &["--wrench", "0,-10,0,0,0,0"]].concat());
    near("wrench", &pressed["wrench"], &[-10.0 * l1 * c1, 0.0]);
    let none = json(&[&state[..], &["--gravity", "none"]].concat());
    near("no gravity", &none["gravity"], &[0.0, 0.0]);
    let shown = text(&fed(&["dynamics", &arm, "-q", "0.4,-1.1", "--qd", "0.7,-1.3"], "").stdout);
    for part in ["Torques", "friction", "Inertia matrix", "kinetic energy", "N m"] {
        assert!(shown.contains(part), "{shown}");
    }
}

#[test]
fn what_is_missing_is_said() {
    refused(&["ur5", "-q", "0,0,0,0,0,0"], 3, "it says nothing of masses");
    refused(&["ur5"], 2, "say where the joints are: -q with 6 values; or --symbolic");
    let arm = file(
        "named.toml",
        "convention = 'craig'\n[parameters]\nM1 = ''\n[[joints]]\ntheta = 'q1'\nmass = 'M1'\n",
    );
    refused(&[&arm, "-q", "0"], 3, "M1");
    let light = file("light.toml", "convention = 'craig'\n[[joints]]\ntheta = 'q1'\nmass = 1\n");
    refused(&[&light, "-q", "0", "--tau", "1"], 3, "q1 moves no mass of its own");
    refused(&[&light, "-q", "0", "--tau", "1,2"], 2, "--tau");
    refused(&[&light, "-q", "0", "--gravity", "down"], 2, "x, -x, y, -y");
    let wrong = file(
        "wrong.toml",
        "convention = 'craig'\n[[joints]]\nname = 'arm'\ntheta = 'q1'\nmass = 1\ninertia = [1, 0, 0, 1, 0, 3]\n",
    );
    let output = fed(&["dynamics", &wrong, "-q", "0"], "");
    assert!(
        text(&output.stderr).contains("link 1 (arm): one of its principal moments"),
        "{}",
        text(&output.stderr)
    );
}

/// Formulas in every format; those of JSON read back.
#[test]
fn formulas_of_dynamics() {
    let of = |more: &[&str]| {
        let output = fed(&[&["dynamics", "planar-2r", "--symbolic", "--gravity", "-y"], more].concat(), "");
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let plain = of(&[]);
    assert!(plain.contains("MXR1 = a1M2 + MX1"), "{plain}");
    // Lines are broken somewhere.
    let joined = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(joined(&plain).contains("proved equal to Lagrange's equations"), "{plain}");
    let french = joined(&of(&["--language", "fr"]));
    assert!(french.contains("égalité avec les équations de Lagrange démontrée"), "{french}");
    assert!(of(&["--format", "markdown"]).starts_with("# Dynamics of the Planar 2R arm"));
    assert!(of(&["--format", "latex"]).contains("\\mathit{MXR}_{1} = a_{1} M_{2} + \\mathit{MX}_{1}"));
    assert!(of(&["--format", "typst"]).contains("Base parameters"));
    assert!(of(&["--format", "html"]).contains("<math"));
    let model = json(&["planar-2r", "--symbolic", "--gravity", "-y"]);
    assert_eq!((model["minimal"].as_bool(), model["proof"].as_str()), (Some(true), Some("proved")));
    assert_eq!(model["base_parameters"].as_array().map(Vec::len), Some(6));
    assert_eq!(model["parts"]["inertia"][1][1], "ZZ2");
    // With masses in numbers base parameters have values: MX1 + a M2.
    let arm = file("two.toml", TWO_LINKS);
    let valued = json(&[&arm, "--symbolic"]);
    let all = valued["base_parameters"].as_array().unwrap();
    let first = all.iter().find(|p| p["name"] == "MXR1").unwrap_or_else(|| panic!("{valued}"));
    assert!((first["number"].as_f64().unwrap() - (4.6 * 0.5 + 0.5 * 2.3)).abs() < 1e-15, "{first}");
}

/// Fingers beside the chain count as fixed, and are named.
#[test]
fn joints_beside_the_chain_are_named() {
    let arm = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot/tests/urdf/panda.urdf");
    let output = fed(&["dynamics", arm, "--tip", "panda_hand", "-q", "0,0,0,-1,0,1,0"], "");
    assert_eq!(output.status.code(), Some(0));
    let said = text(&output.stderr);
    assert!(said.contains("behind panda_finger_joint1, panda_finger_joint2 counts as fixed"), "{said}");
}
