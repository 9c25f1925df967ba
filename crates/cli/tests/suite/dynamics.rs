//! `denavit dynamics`.

use crate::common::{fed, text};
use serde_json::Value;

/// Two links in a vertical plane with point masses, as Craig has them (section 6.7), and friction.
const TWO_LINKS: &str = "name = '2R'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n\
    [[joints]]\ntheta = 'q1'\nmass = '4.6'\ncom = ['0.5', 0, 0]\nviscous = '0.5'\n\
    [[joints]]\na = '0.5'\ntheta = 'q2'\nmass = '2.3'\ncom = ['0.4', 0, 0]\ncoulomb = '0.2'\n";

/// The file of a test, by its name.
pub fn file(name: &str, contents: &str) -> String {
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
pub fn refused(arguments: &[&str], code: i32, says: &str) {
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
    refused(&["ur5"], 2, "say where the joints are: -q with 6 values; or --symbolic or --explain");
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
    // Once: where the file was read, or here where a name got its value.
    let said = text(&fed(&["dynamics", &wrong, "-q", "0"], "").stderr);
    assert!(said.contains("`arm`: no body has this inertia") && !said.contains("link 1"), "{said}");
    let named = file(
        "wrong-named.toml",
        "convention = 'craig'\n[parameters]\nJ = 3\n[[joints]]\nname = 'arm'\ntheta = 'q1'\nmass = 1\n\
         inertia = [1, 0, 0, 1, 0, 'J']\n",
    );
    let said = text(&fed(&["dynamics", &named, "-q", "0"], "").stderr);
    assert!(said.contains("link 1 (arm): one of its principal moments"), "{said}");
    for option in ["--qd", "--qdd", "--tau", "--wrench", "--input"] {
        refused(&["planar-2r", "--symbolic", option, "1,2"], 2, "cannot be used with");
    }
}

/// Masses, friction, torques and gravity have units, and what measures something else is refused.
#[test]
fn units_of_dynamics() {
    let arm = file(
        "units.toml",
        "convention = 'craig'\n[parameters]\nM = ''\n[[joints]]\ntheta = 'q1'\nmass = 'M'\ncom = ['500 mm', 0, 0]\n\
         inertia = [0, 0, 0, '0.1 kg m²', 0, '0.1 kg·m^2']\nviscous = '0.2 N m s/rad'\ncoulomb = '300 N·mm'\n",
    );
    let missing = text(&fed(&["dynamics", &arm, "-q", "0"], "").stderr);
    assert!(missing.contains("--set M=1kg"), "{missing}");
    let with = |more: &[&str]| json(&[&[&arm, "-q", "0", "--set", "M=4kg"], more].concat());
    let of = |v: &Value, key: &str| numbers(&v[key])[0];
    let a = with(&["--qd", "2", "--gravity", "0, -1.62 m/s^2, 0"]);
    assert!((a["inertia"][0][0].as_f64().unwrap() - 1.1).abs() < 1e-15, "{a}");
    assert!(
        (of(&a, "gravity") - 4.0 * 0.5 * 1.62).abs() < 1e-14 && (of(&a, "friction") - 0.7).abs() < 1e-15,
        "{a}"
    );
    let a = with(&["--gravity", "none", "--tau", "2.2 N·m"]);
    assert!((of(&a, "accelerations") - 2.0).abs() < 1e-15, "{a}");
    refused(&[&arm, "-q", "0", "--set", "M=4mm"], 2, "this is a mass");
    refused(&[&arm, "-q", "0", "--set", "M=4", "--gravity", "0,1e400,0"], 2, "finite");
    refused(&[&arm, "-q", "0", "--set", "M=4", "--gravity", "0,1 kg,0"], 2, "this is an acceleration");
    refused(&[&arm, "-q", "0", "--set", "M=4", "--tau", "1 N"], 2, "this is a torque");
}

/// A pendulum falls: as text, CSV, JSON and a plot, with the balance of its energy.
#[test]
fn a_motion_is_followed() {
    let arm = file("fall.toml", TWO_LINKS);
    let base = ["dynamics", &arm, "-q", "0,0", "--simulate", "0.5"];
    let of = |more: &[&str], stdin: &str| {
        let output = fed(&[&base, more].concat(), stdin);
        assert_eq!(output.status.code(), Some(0), "{more:?}: {}", text(&output.stderr));
        (text(&output.stdout), text(&output.stderr))
    };
    let plot = file("fall.svg", "");
    let (shown, _) = of(&["--plot", &plot], "");
    for part in [
        "motion over 0.5 s",
        "of order 5",
        "estimated error of a step",
        "energy: what is there",
        "201 samples",
    ] {
        assert!(shown.contains(part), "{shown}");
    }
    assert!(std::fs::read_to_string(&plot).is_ok_and(|svg| svg.contains("lost to friction")));
    let (csv, said) = of(&["--csv", "--dt", "0.1"], "");
    let lines: Vec<&str> = csv.lines().collect();
    assert!(lines.len() == 7 && lines[0].starts_with("t,q1,q2,q1_velocity"), "{csv}");
    assert!(said.contains("energy: what is there"), "{said}");
    let motion = json(&[&base[1..], &["--dt", "0.25"]].concat());
    let last = &motion["samples"][2];
    assert!(last["q"][0].as_f64().unwrap() < -0.5 && last["dissipated"].as_f64().unwrap() > 0.0, "{motion}");
    assert!(motion["drift"].as_f64().unwrap() < 1e-7, "{motion}");
    // Torques that hold it.
    let hold = json(&[&arm, "-q", "0,0"]);
    let torques = numbers(&hold["torques"]);
    let row = |t: f64| format!("{t}, {}, {}\n", torques[0], torques[1]);
    let table = format!("t, tau1, tau2\n{}{} # the end\n", row(0.0), row(1.0).trim());
    let (held, _) = of(&["--csv", "--tau-file", "-"], &table);
    let cells: Vec<f64> = held.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
    assert!(cells[1].abs() < 1e-9 && cells[2].abs() < 1e-9, "{held}");
    refused(&[&base[1..], &["--step", "0.01"]].concat(), 2, "Coulomb");
    refused(&[&base[1..], &["--tau-file", "nowhere.csv"]].concat(), 3, "nowhere.csv");
    for (torques, why) in
        [("0,1\n", "line 1: 2 numbers"), ("1,2,3\n1,2,3\n", "line 2: times increase"), ("", "no torques")]
    {
        let output = fed(&[&base, &["--tau-file", "-"][..]].concat(), torques);
        assert!(text(&output.stderr).contains(why), "{torques}: {}", text(&output.stderr));
    }
    refused(&[&arm, "-q", "0,0", "--simulate", "0"], 2, "a positive number");
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
/// Base parameters with representatives that were asked for, in formulas, words and of a whole tree; reasons where there are none.
#[test]
fn representatives_are_chosen() {
    let arm = ["articulated-3r", "--symbolic"];
    let names = |more: &[&str]| -> Vec<String> {
        let model = json(&[&arm[..], more].concat());
        assert_eq!(model["proof"], "proved");
        let all = model["base_parameters"].as_array().unwrap();
        all.iter().map(|p| p["name"].as_str().unwrap().to_string()).collect()
    };
    let (plain, kept) = (names(&[]), names(&["--keep", "YY3, YY2"]));
    assert_eq!(plain.len(), kept.len());
    assert!(plain.contains(&"XXR3".into()) && !plain.contains(&"YYR3".into()), "{plain:?}");
    assert!(!kept.contains(&"XXR3".into()) && kept.contains(&"YYR3".into()), "{kept:?}");
    let shown = text(&fed(&["dynamics", arm[0], "--explain", "--keep", "YY3", "--drop", "XX2"], "").stdout);
    assert!(shown.contains("YYR3 = "), "{shown}");
    assert!(shown.contains("these stand for what is grouped with them: YY3."), "{shown}");
    assert!(shown.contains("others stand in the place of XX2."), "{shown}");
    refused(&[&arm[..], &["--keep", "XX1"]].concat(), 3, "XX1 has no effect on the torques");
    refused(&[&arm[..], &["--drop", "MY3"]].concat(), 3, "MY3 cannot be dropped");
    refused(&["planar-2r", "--symbolic", "--keep", "ZZ1 M2"], 3, "M2 cannot be kept with the others");
    refused(&[&arm[..], &["--keep", ","]].concat(), 2, "--keep and --drop take names");
    refused(&[arm[0], "-q", "0,0,0", "--keep", "YY3"], 2, "--keep");
    refused(&[arm[0], "--keep", "YY3"], 2, "are for --symbolic and --explain");
}

#[test]
fn joints_beside_the_chain_are_named() {
    let arm = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot/tests/urdf/panda.urdf");
    let output = fed(&["dynamics", arm, "--tip", "panda_hand", "-q", "0,0,0,-1,0,1,0"], "");
    assert_eq!(output.status.code(), Some(0));
    let said = text(&output.stderr);
    assert!(said.contains("behind panda_finger_joint1, panda_finger_joint2 counts as fixed"), "{said}");
}

/// A line for each line: objects, arrays and plain numbers; a bad line is named and the others are answered.
#[test]
fn states_are_streamed() {
    let arm = file("stream.toml", TWO_LINKS);
    let lines = "{\"q\": [0.4, -1.1], \"qd\": [0.7, -1.3], \"qdd\": [2, 0.6]}\n[0.4, -1.1, 0.7, -1.3, 2, 0.6]\n\
                 0.4, -1.1, 0.7, -1.3, 2, 0.6\n\n{\"q\": [0, 0], \"tau\": [1, 2]}\n[1]\n{\"q\": [0, 0], \"t\": [1, 2]}\n";
    let output = fed(&["dynamics", &arm, "--input", "-"], lines);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    let all: Vec<Value> = text(&output.stdout).lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    let one = json(&[&arm, "-q", "0.4,-1.1", "--qd", "0.7,-1.3", "--qdd", "2,0.6"]);
    assert!(all.len() == 6 && all[..3].iter().all(|a| *a == one), "{all:?}");
    assert_eq!(all[3]["accelerations"], json(&[&arm, "-q", "0,0", "--tau", "1,2"])["accelerations"]);
    assert!(all[4]["error"].as_str().unwrap().contains("1 number"), "{}", all[4]);
    assert!(all[5]["error"].as_str().unwrap().contains("`t` is none of"), "{}", all[5]);
}

/// A byte order mark before the first line is none of its numbers; an arm without joints has states without numbers.
#[test]
fn lines_of_states_may_be_odd() {
    let arm = file("marked.toml", TWO_LINKS);
    for line in ["\u{feff}{\"q\": [0.4, -1.1]}\n", "\u{feff}0.4, -1.1\n", "\u{feff}[0.4, -1.1]\n"] {
        let output = fed(&["dynamics", &arm, "--input", "-"], line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", text(&output.stdout));
        let found: Value = serde_json::from_str(&text(&output.stdout)).unwrap();
        assert_eq!(found, json(&[&arm, "-q", "0.4,-1.1"]));
    }
    let fixed = file("fixed.toml", "convention = 'craig'\n[[joints]]\ntheta = '30 deg'\nmass = 1\n");
    let output = fed(&["dynamics", &fixed, "--input", "-"], "[]\n[1]\n1, 2\n");
    let said = text(&output.stderr);
    assert!(!said.contains("panicked") && [1, 2, 3].contains(&output.status.code().unwrap()), "{said}");
}

/// What is said of a motion in words stands in JSON, too: limits that are left, and why it ends.
#[test]
fn motions_in_json_say_what_befell_them() {
    let arm =
        file("left.toml", &TWO_LINKS.replace("mass = '4.6'", "limits = ['-45 deg', '45 deg']\nmass = '4.6'"));
    let motion = json(&[&arm, "-q", "0,0", "--simulate", "1", "--dt", "0.1"]);
    assert_eq!(motion["leaves"][0]["joint"], "q1", "{motion}");
    assert!(
        motion["leaves"][0]["t"].as_f64().is_some_and(|t| t > 0.1) && motion.get("ends").is_none(),
        "{motion}"
    );
    let output = fed(&["dynamics", &arm, "-q", "0,0", "--simulate", "1", "--qd", "1e160,0", "--json"], "");
    assert_eq!(output.status.code(), Some(5), "{}", text(&output.stderr));
    let broken: Value = serde_json::from_str(&text(&output.stdout)).unwrap();
    assert!(broken["ends"].as_str().is_some_and(|why| !why.is_empty()), "{broken}");
}

/// A wrench may be that of a line, at a frame; and a frame of a file of bodies that the table has not.
#[test]
fn wrenches_at_frames() {
    let arm = file("at.toml", TWO_LINKS);
    let output = fed(
        &["dynamics", &arm, "--input", "-", "--at", "1"],
        "{\"q\": [0.4, -1.1], \"wrench\": [0, -10, 0, 0, 0, 3]}\n",
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let found: Value = serde_json::from_str(&text(&output.stdout)).unwrap();
    assert_eq!(numbers(&found["wrench"]), [3.0, 0.0]);
    let panda = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot/tests/urdf/panda.urdf");
    let q = "0.1,-0.5,0.3,-1.7,0.2,1.4,0.6";
    let held = |tip: &str, at: &[&str]| {
        numbers(
            &json(&[&[panda, "--tip", tip, "-q", q, "--wrench", "3,-2,5,0.5,0.1,-0.3"], at].concat())["wrench"],
        )
    };
    let (named, tip) = (held("panda_hand_tcp", &["--at", "panda_hand"]), held("panda_hand", &[]));
    assert!(named.iter().zip(&tip).all(|(a, b)| (a - b).abs() < 1e-9), "{named:?} {tip:?}");
    assert_ne!(named, held("panda_hand_tcp", &[]));
    refused(&[&arm, "-q", "0,0", "--wrench", "1,0,0,0,0,0", "--at", "nowhere"], 2, "no frame `nowhere`");
}

/// A load at the tool, a wrench at a frame, momentum and power.
#[test]
fn loads_momentum_and_power() {
    let arm = file("load.toml", TWO_LINKS);
    let of = |more: &[&str]| json(&[&[&arm, "-q", "0.4,-1.1"], more].concat());
    let gravity = |a: &Value| numbers(&a["gravity"]);
    let (bare, loaded) = (gravity(&of(&[])), gravity(&of(&["--payload", "2 kg, 300 mm, 0, 0"])));
    let moment = 2.0 * 9.81 * 0.3 * 0.7_f64.cos();
    assert!((loaded[1] - bare[1] - moment).abs() < 1e-12, "{loaded:?}");
    refused(&[&arm, "-q", "0,0", "--payload", "-1"], 2, "its mass is negative");
    refused(&[&arm, "-q", "0,0", "--payload", "1,2"], 2, "a mass, or mass, x, y, z");
    // 10 N down at the first frame, on the axis of the first joint, and a moment about it.
    let at = |frame: &str| numbers(&of(&["--wrench", "0,-10,0,0,0,3", "--at", frame])["wrench"]);
    assert_eq!(at("1"), [3.0, 0.0]);
    assert!((at("2")[0] - (3.0 - 10.0 * 0.5 * 0.4_f64.cos())).abs() < 1e-12);
    let a = of(&["--qd", "0.7,-1.3", "--qdd", "2,0.6", "--wrench", "1,2,0,0,0,0"]);
    let p = |key: &str| a["power"][key].as_f64().unwrap();
    let rest = p("supplied") - p("dissipated") - p("exerted") - p("potential") - p("kinetic");
    assert!(rest.abs() < 1e-12 && (p("dissipated") - (0.5 * 0.49 + 0.2 * 1.3)).abs() < 1e-12, "{a}");
    // q̇ᵀ(A q̈ + C q̇)
    let rates = [0.7, -1.3];
    let pulled = |k: usize| numbers(&a["inertia"][k]).iter().zip([2.0, 0.6]).map(|(m, x)| m * x).sum::<f64>();
    let kinetic: f64 = (0..2).map(|k| rates[k] * (pulled(k) + numbers(&a["velocity"])[k])).sum();
    assert!((p("kinetic") - kinetic).abs() < 1e-12, "{a}");
    assert!((a["momentum"]["mass"].as_f64().unwrap() - 6.9).abs() < 1e-14, "{a}");
    let shown = text(&fed(&["dynamics", &arm, "-q", "0,0", "--qd", "1,0"], "").stdout);
    assert!(shown.contains("6.9 kg that move") && shown.contains("power: the torques supply"), "{shown}");
}

/// The derivation in words, in two languages and all formats; every link's motion says on what it rests.
#[test]
fn the_derivation_is_explained() {
    let of = |more: &[&str]| {
        let output = fed(&[&["dynamics", "articulated-3r", "--explain"], more].concat(), "");
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout).split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let plain = of(&[]);
    for part in [
        "link 3 turns: it gives M3, MZ3 and YY3",
        "Outward: how the links move",
        "Proved: w, wd and a are those of the product of the transforms",
        "Inward: what moves them",
        "proved equal to Lagrange's equations",
        "The short program",
    ] {
        assert!(plain.contains(part), "{part}: {plain}");
    }
    assert_eq!(plain.matches("Proved: w, wd and a").count(), 3, "{plain}");
    let french = of(&["--language", "fr"]);
    assert!(
        french.contains("Démontré : w, wd et a sont ceux du produit") && !french.contains("Link"),
        "{french}"
    );
    assert!(
        of(&["--format", "latex"]).contains("\\section") || of(&["--format", "latex"]).contains("Outward")
    );
    assert!(of(&["--format", "html"]).contains("<math") && of(&["--format", "typst"]).contains("Outward"));
    let slides = text(&fed(&["dynamics", "scara", "--explain"], "").stdout);
    assert!(slides.contains("slides along the direction of all turns before it"), "{slides}");
    // Of six joints how the links move is sampled, and called so.
    let model = json(&["staubli-rx90", "--explain"]);
    let recursion = &model["recursion"];
    assert!(["proved", "sampled"].contains(&recursion["proof"].as_str().unwrap()), "{recursion}");
    let outward = recursion["outward"].as_array().unwrap();
    assert!(outward.len() == 6 && outward.iter().all(|o| o["proof"] == "sampled"), "{outward:?}");
    refused(&["ur5", "--explain", "-q", "0,0,0,0,0,0"], 2, "cannot be used with");
}

/// A path within torque limits: one with weak drives takes longer, and one that cannot carry the arm is refused.
#[test]
fn paths_keep_torque_limits() {
    let arm = file("path.toml", TWO_LINKS);
    let of = |torque: &str| {
        let path = ["path", &arm, "--joint", "0.9,0", "-q", "1.5,0", "--velocity", "3", "--torque", torque];
        fed(&[&path[..], &["--json"]].concat(), "")
    };
    let duration = |torque: &str| {
        let output = of(torque);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let path: Value = serde_json::from_str(&text(&output.stdout)).unwrap();
        // The first joint has viscous friction.
        assert_eq!(path["timing"], "fast, within velocity and torque limits");
        path["duration"].as_f64().unwrap()
    };
    assert!(duration("200 N m") < 0.9 * duration("60,20"), "{} {}", duration("200 N m"), duration("60,20"));
    // The efforts of a URDF; a robot file has none.
    let panda = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot/tests/urdf/panda.urdf");
    let motion = |torque: &str| {
        let path = [
            "path",
            panda,
            "--tip",
            "panda_hand",
            "-q",
            "0,-0.5,0,-1.7,0,1.4,0.6",
            "--joint",
            "0.4,-0.2,0.3,-1.4,0.2,1.6,0",
        ];
        let output = fed(&[&path[..], &["--torque", torque, "--json"]].concat(), "");
        assert_eq!(output.status.code(), Some(0), "{torque}: {}", text(&output.stderr));
        let path: Value = serde_json::from_str(&text(&output.stdout)).unwrap();
        path["duration"].as_f64().unwrap()
    };
    assert_eq!(motion("file"), motion("87,87,87,87,12,12,12"));
    assert!(text(&of("file").stderr).contains("it has no efforts"), "{}", text(&of("file").stderr));
    // Jerks besides: slower than within either, all limits held.
    let both = |extra: &[&str]| {
        let path = ["path", &arm, "--joint", "0.9,0", "-q", "1.5,0", "--velocity", "3", "--torque", "60,20"];
        fed(&[&path[..], &["--jerk", "100"], extra].concat(), "")
    };
    let found: Value = serde_json::from_str(&text(&both(&["--json"]).stdout)).unwrap();
    assert_eq!(found["timing"], "fast, within velocity, jerk and torque limits");
    assert!(found["duration"].as_f64().unwrap() > 0.4, "{found}");
    let held = &found["held"];
    assert!(held["jerk"].as_f64().is_some_and(|j| j > 0.95 && j < 1.001), "{held}");
    assert!(held["torque"].as_f64().is_some_and(|t| t > 0.3 && t < 1.001), "{held}");
    assert!(held["acceleration"].is_null() && held["instants"] == 10001, "{held}");
    let said = text(&both(&[]).stdout);
    assert!(said.contains("at 10001 instants at most velocities at"), "{said}");
    assert!(text(&both(&["--law", "quintic"]).stderr).contains("cannot be used with"));
    let weak = of("5");
    assert_eq!(weak.status.code(), Some(1), "{}", text(&weak.stderr));
    assert!(text(&weak.stderr).contains("cannot carry the arm at rest"), "{}", text(&weak.stderr));
    assert!(text(&of("5kg").stderr).contains("this is a torque"), "{}", text(&of("5kg").stderr));
    let bare = fed(&["path", "ur5", "-q", "0,0,0,0,0,0", "--joint", "1,0,0,0,0,0", "--torque", "10"], "");
    assert!(text(&bare.stderr).contains("it says nothing of masses"), "{}", text(&bare.stderr));
}

/// All joints of a tree at once: two arms, what one of them does not move has no torque of it.
#[test]
fn a_whole_tree_is_answered() {
    let baxter = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot/tests/urdf/baxter.urdf");
    let found = json(&[baxter, "--whole", "-q", "left_s0=0.3, left_s1=-0.4, right_s1=0.2"]);
    let n = numbers(&found["q"]).len();
    assert!(n > 14 && numbers(&found["torques"]).len() == n, "{found}");
    assert_eq!(found["torques"], found["gravity"]);
    let torques: Vec<String> = numbers(&found["torques"]).iter().map(f64::to_string).collect();
    // What holds it accelerates it by nothing.
    let back = json(&[
        baxter,
        "--whole",
        "-q",
        "left_s0=0.3, left_s1=-0.4, right_s1=0.2",
        "--tau",
        &torques.join(","),
    ]);
    assert!(numbers(&back["accelerations"]).iter().all(|a| a.abs() < 1e-6), "{}", back["accelerations"]);
    let shown = text(&fed(&["dynamics", baxter, "--whole", "-q", "left_s0=0.3"], "").stdout);
    assert!(shown.contains("left_s0 = ") && shown.contains("Inertia matrix"), "{shown}");
    // Formulas of all of it.
    let legs = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot/tests/urdf/solo12.urdf");
    let formulas = json(&[legs, "--whole", "--symbolic"]);
    assert_eq!(formulas["proof"].as_str(), Some("sampled"));
    let parameters = formulas["base_parameters"].as_array().expect("a list");
    assert!(parameters.len() > 20, "{parameters:?}");
    let shown = text(&fed(&["dynamics", legs, "--whole", "--symbolic"], "").stdout);
    assert!(shown.contains("behind joint HL_KFE, on link 8"), "{shown}");
    refused(&[baxter, "--whole"], 2, "say where the joints are");
    refused(&[baxter, "--whole", "-q", "left_s0=0", "--qd", "1,2"], 2, "--qd: 2 values given");
    refused(&["ur5", "--whole", "-q", "0,0,0,0,0,0"], 2, "is no tree");
    // A quotient is one, and per second goes without saying.
    let one = file(
        "whole.urdf",
        "<robot name='r'><link name='a'/><link name='b'><inertial><mass value='1'/>\
         <inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>\
         <joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint></robot>",
    );
    let found = json(&[&one, "--whole", "-q", "j=0", "--qd", "pi/2", "--qdd", "1/2"]);
    assert!((numbers(&found["qd"])[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{found}");
    assert!((numbers(&found["qdd"])[0] - 0.5).abs() < 1e-15, "{found}");
}

/// Derivatives of Craig's two links, of torques and of accelerations, and of a whole tree.
#[test]
fn derivatives_of_a_state() {
    let arm = file("slopes.toml", TWO_LINKS);
    let state = [&arm, "-q", "0.4,-1.1", "--qd", "0.7,-1.3", "--derivatives"];
    let of = |a: &Value, key: &str| -> Vec<Vec<f64>> {
        a["derivatives"][key].as_array().unwrap_or_else(|| panic!("{key}: {a}")).iter().map(numbers).collect()
    };
    let a = json(&[&state[..], &["--qdd", "2,0.6"]].concat());
    // By Craig's formulas: gravity of the second joint by the first, and friction by its rate.
    let (m2, l1, l2, g) = (2.3, 0.5, 0.4, 9.81);
    let (s12, s2) = ((-0.7_f64).sin(), (-1.1_f64).sin());
    let near = |x: f64, wanted: f64| assert!((x - wanted).abs() < 1e-12, "{x} {wanted}");
    near(of(&a, "by_q")[1][0], -m2 * l2 * g * s12);
    near(of(&a, "by_qd")[0][0], 2.0 * m2 * l1 * l2 * s2 * 1.3 + 0.5);
    assert_eq!(of(&a, "by_qdd"), a["inertia"].as_array().unwrap().iter().map(numbers).collect::<Vec<_>>());
    assert!(a["derivatives"].get("by_tau").is_none());
    // The accelerations' are these through the inverse of A.
    let b = json(&[&state[..], &["--tau", "3,-1"]].concat());
    let (inverse, matrix) = (of(&b, "by_tau"), of(&a, "by_qdd"));
    for (i, row) in inverse.iter().enumerate() {
        for j in 0..2 {
            let product: f64 = row.iter().zip(&matrix).map(|(x, column)| x * column[j]).sum();
            near(product, f64::from(u8::from(i == j)));
        }
    }
    let baxter = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot/tests/urdf/baxter.urdf");
    let tree = json(&[baxter, "--whole", "-q", "left_s0=0.3", "--derivatives"]);
    assert_eq!(of(&tree, "by_q").len(), tree["q"].as_array().unwrap().len());
    let shown = text(&fed(&[&["dynamics"], &state[..]].concat(), "").stdout);
    assert!(["∂τ/∂q\n", "∂τ/∂q̇\n", "∂τ/∂q̈\n"].iter().all(|w| shown.contains(w)), "{shown}");
    refused(&[&state[..], &["--wrench", "1,0,0,0,0,0"]].concat(), 2, "--wrench");
}
