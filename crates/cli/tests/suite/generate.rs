//! `denavit generate`: which files, where, and what is refused. That they build and agree is `cargo xtask languages`.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn denavit(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_denavit"));
    command.args(arguments).env("NO_COLOR", "1").output().expect("the command starts")
}

/// An empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

/// The folder of a robot in a language, and the answer.
#[track_caller]
fn generated(robot: &str, language: &str, folder: &Path, more: &[&str]) -> Value {
    let path = folder.to_str().expect("a path of the project");
    let arguments = ["generate", robot, "--language", language, "--output", path, "--json"];
    let output = denavit(&[&arguments[..], more].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one JSON value")
}

#[track_caller]
fn refused(arguments: &[&str], code: i32, says: &str) {
    let output = denavit(arguments);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{text}");
    assert!(text.contains(says), "{text}");
}

fn texts(folder: &Path, answer: &Value) -> Vec<String> {
    let files = answer["files"].as_array().expect("a list of files");
    let read =
        |f: &Value| fs::read_to_string(folder.join(f.as_str().expect("a path"))).expect("the file is there");
    files.iter().map(read).collect()
}

#[test]
fn every_language_writes_what_it_says() {
    for language in ["rust", "c", "python", "matlab", "javascript", "cuda"] {
        let folder = folder(&format!("all-{language}"));
        let answer = generated("stanford", language, &folder, &["--functions", "fk, frames,"]);
        assert_eq!(answer["functions"][0]["name"], "fk");
        assert_eq!(answer["functions"][1]["proved"], true, "{answer}");
        for text in texts(&folder, &answer) {
            assert!(text.contains("Stanford"), "the title stands in every file");
        }
        let again = generated("stanford", language, &folder, &["--functions", "fk,frames"]);
        assert_eq!(answer, again, "the same files do not stand in their own way");
    }
}

#[test]
fn every_language_has_jacobians() {
    for (language, function) in [
        ("rust", "pub fn jacobian(q: &[f64; 7], parameters: &Parameters) -> [[f64; 7]; 6]"),
        ("c", "double jacobian[6][7]"),
        ("python", "def jacobian("),
        ("matlab", "function jacobian = franka_panda_jacobian("),
        ("javascript", "export function jacobian("),
        ("cuda", "franka_panda_jacobian("),
    ] {
        let folder = folder(&format!("jacobian-{language}"));
        let answer = generated("franka-panda", language, &folder, &["--functions", "jacobian"]);
        assert_eq!(answer["functions"].as_array().map(Vec::len), Some(1));
        assert_eq!(answer["functions"][0]["proved"], true, "{answer}");
        let text = texts(&folder, &answer).concat();
        assert!(text.contains(function), "{text}");
        assert!(text.contains("proved equal to the derivative of the product of the link transforms"));
    }
}

/// IKFast's interface has pose and inverse, both by default, with the values of parameters in them.
#[test]
fn the_interface_of_ikfast_has_what_it_has() {
    let folder = folder("ikfast");
    let answer = generated("franka-panda", "ikfast", &folder, &["--name", "panda_solver", "--given", "q7"]);
    assert_eq!(answer["files"][0], "panda_solver.cpp");
    assert_eq!(answer["functions"].as_array().map(Vec::len), Some(1));
    assert_eq!(answer["ik"]["given"][0], "q7");
    let text = texts(&folder, &answer).concat();
    for part in ["IKFAST_API bool ComputeIk(", "static int joints[1] = {6};", "return 0x67000001;"] {
        assert!(text.contains(part), "{part}");
    }
    let path = folder.to_str().expect("a path");
    let asked = |robot: &'static str| ["generate", robot, "--language", "ikfast", "--output", path];
    refused(
        &[&asked("ur5")[..], &["--functions", "fk,jacobian"]].concat(),
        3,
        "--language c has all functions",
    );
    refused(&asked("articulated-3r"), 4, "--goal position asks for what it can");
}

#[test]
fn pose_and_jacobian_together_are_one_pass_too() {
    let folder = folder("one-pass");
    let answer = generated("ur5", "c", &folder, &["--functions", "jacobian,fk"]);
    let names: Vec<&Value> =
        answer["functions"].as_array().expect("a list").iter().map(|f| &f["name"]).collect();
    assert_eq!(names, ["jacobian", "fk", "jacobian_fk"]);
    assert!(texts(&folder, &answer).concat().contains("double jacobian_and_pose[52]"));
}

#[test]
fn files_of_others_are_not_overwritten() {
    let folder = folder("in-the-way");
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join("ur5.c"), "mine").expect("a file");
    let path = folder.to_str().expect("a path");
    let arguments = ["generate", "ur5", "--language", "c", "--output", path];
    refused(&arguments, 3, "--force");
    assert_eq!(fs::read_to_string(folder.join("ur5.c")).expect("still there"), "mine");
    assert!(!folder.join("ur5.h").exists(), "nothing is written by halves");
    generated("ur5", "c", &folder, &["--force"]);
    assert!(folder.join("ur5.h").exists());

    fs::remove_file(folder.join("ur5.c")).expect("a file");
    fs::create_dir(folder.join("ur5.c")).expect("a folder");
    fs::remove_file(folder.join("ur5.h")).expect("a file");
    refused(&[&arguments[..], &["--force"]].concat(), 3, "a folder stands where a file should");
    assert!(!folder.join("ur5.h").exists(), "nothing is written by halves");
}

#[test]
fn refusals() {
    refused(
        &["generate", "ur5", "--language", "c", "-o", "x", "--functions", "ik2"],
        2,
        "known are fk, frames, jacobian, jacobian_fk, ik",
    );
    refused(&["generate", "ur5", "--language", "python", "-o", "x", "--float"], 2, "double precision");
    refused(&["generate", "ur5", "--language", "c", "-o", "x", "--name", "/"], 2, "--name needs");
    refused(&["generate", "prrrrp", "--language", "c", "-o", "x", "--fixed"], 3, "no value for");
    refused(
        &["generate", "oblique-6r", "--language", "cuda", "-o", "x", "--functions", "ik"],
        4,
        "elimination is generated in C, Rust, Python, MATLAB and JavaScript",
    );
    refused(&["generate", "ur5", "--language", "c", "-o", "x", "--given", "q9"], 2, "no joint `q9`");
    refused(
        &["generate", "ur5", "--language", "c", "-o", "x", "--functions", "ik", "--given", "q3"],
        4,
        "no joint can be given",
    );
    refused(&["generate", "ur5", "--language", "cobol", "-o", "x"], 2, "javascript");
}

#[test]
fn names_stay_in_the_folder() {
    let folder = folder("names");
    let answer = generated("ur5", "c", &folder, &["--name", "../../evil"]);
    assert!(
        answer["files"]
            .as_array()
            .expect("files")
            .iter()
            .all(|f| !f.as_str().expect("a path").contains(".."))
    );
}

#[test]
fn a_parameter_called_like_a_result_is_not_mistaken_for_it() {
    let folder = folder("results");
    fs::create_dir_all(&folder).expect("a folder");
    let robot = folder.join("tee.toml");
    let text = "name = \"Tee\"\nconvention = \"standard\"\n[parameters]\nt11 = 0.3\nt14 = 0.2\n\
                [[joints]]\ntheta = \"q1\"\na = \"t11\"\nalpha = \"90 deg\"\n[[joints]]\ntheta = \"q2\"\na = \"t14\"\n";
    fs::write(&robot, text).expect("a file");
    let answer =
        generated(robot.to_str().expect("a path"), "python", &folder.join("out"), &["--functions", "fk"]);
    let module = &texts(&folder.join("out"), &answer).concat();
    assert!(module.contains("t11 = parameters.t11"), "{module}");
    assert_eq!(module.matches("    t11 = ").count(), 1, "one thing is called t11:\n{module}");
}

#[test]
fn fixed_values_leave_no_parameters() {
    let folder = folder("fixed");
    let answer = generated("ur5", "c", &folder, &["--fixed"]);
    assert!(texts(&folder, &answer).iter().all(|text| !text.contains("ur5_parameters")));
}

#[test]
fn there_is_inverse_kinematics_where_it_has_a_closed_form() {
    let there = folder("inverse");
    let answer = generated("ur5", "c", &there, &[]);
    assert_eq!(answer["functions"].as_array().map(Vec::len), Some(2), "fk, and what ik calls");
    assert_eq!(answer["ik"]["max_solutions"], 8);
    assert_eq!(answer["ik"]["branches"].as_array().map(Vec::len), Some(3), "{answer}");
    assert!(answer["ik"]["poses_in_test"].as_u64() > Some(10), "{answer}");
    let lines = texts(&there, &answer)[..2].iter().map(|t| t.lines().count()).sum::<usize>();
    assert!(lines < 2700, "{lines} lines of C");

    let there = folder("inverse-alone");
    let answer = generated("scara", "python", &there, &["--functions", "ik", "--fixed"]);
    assert_eq!(answer["functions"].as_array().map(Vec::len), Some(1), "what ik calls");
    assert!(texts(&there, &answer).iter().any(|t| t.contains("def ik(")));

    let there = folder("inverse-position");
    let answer = generated("planar-2r", "python", &there, &["--goal", "position"]);
    assert_eq!(answer["ik"]["max_solutions"], 2, "{answer}");
}

#[test]
fn joints_too_many_are_given() {
    let answer = generated("franka-panda", "c", &folder("chosen"), &["--functions", "ik"]);
    assert_eq!(answer["ik"]["given_by_choice"], true);
    assert_eq!(answer["ik"]["given"].as_array().map(Vec::len), Some(1));
    let answer = generated("franka-panda", "c", &folder("given"), &["--functions", "ik", "--given", "q7"]);
    assert_eq!(answer["ik"]["given_by_choice"], false);
    assert_eq!(answer["ik"]["given"][0], "q7");
}

#[test]
fn an_arm_without_closed_form_has_the_forward_model_only_in_cuda() {
    let folder = folder("oblique");
    let path = folder.to_str().expect("a path");
    let output = denavit(&["generate", "oblique-6r", "--language", "cuda", "--output", path]);
    assert_eq!(output.status.code(), Some(0));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("warning: no ik: no closed form"), "{said}");
    let module = fs::read_to_string(folder.join("oblique_6r.cuh")).expect("the module is there");
    assert!(module.contains("oblique_6r_fk(") && !module.contains("oblique_6r_ik("));
    // What is asked for by its name is there, or nothing is.
    let output = denavit(&[
        "generate",
        "oblique-6r",
        "--language",
        "cuda",
        "--functions",
        "fk,ik",
        "--output",
        path,
        "--force",
    ]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.code().is_some_and(|code| code > 0) && said.contains("ik: no closed form"),
        "{said}"
    );
}

/// Functions that move: what they are equal to, what they take, and what cannot be.
#[test]
fn dynamics_are_generated() {
    let moving = concat!(env!("CARGO_MANIFEST_DIR"), "/../generate/tests/robots/moving.toml");
    let target = folder("moving");
    let all = "torque,inertia,bias,gravity,acceleration,energy,torque_derivatives,acceleration_derivatives,\
               torque_with_derivatives,acceleration_with_derivatives";
    let answer = generated(moving, "c", &target, &["--functions", all]);
    let functions = answer["functions"].as_array().expect("a list");
    assert_eq!(functions.len(), 10);
    for f in functions {
        let is_energy = f["name"] == "energy";
        assert!(
            is_energy || f["claim"].as_str().unwrap().contains("proved equal to Lagrange's equations"),
            "{f}"
        );
    }
    // No number of the robot is asked for, and Coulomb's friction is there.
    let header = fs::read_to_string(target.join("moving.h")).unwrap();
    assert!(!header.contains("moving_parameters") && header.contains("2 sign functions"), "{header}");

    let target = folder("moving-base");
    generated("planar-2r", "python", &target, &["--functions", "torque", "--masses", "base"]);
    let text = fs::read_to_string(target.join("planar_2r.py")).unwrap();
    assert!(text.contains("Base parameter of link 1: a1^2*M2 + ZZ1"), "{text}");

    // A file of MATLAB has the name of its function, with all of its letters.
    let target = folder("moving-matlab");
    let name = "three_links_and_a_long_name";
    generated(moving, "matlab", &target, &["--functions", "acceleration_with_derivatives", "--name", name]);
    let function = format!("{name}_acceleration_with_derivatives");
    let text = fs::read_to_string(target.join(format!("{function}.m"))).unwrap();
    assert!(function.len() <= 63 && text.contains(&format!(" = {function}(")), "{text}");

    let path = target.to_str().unwrap();
    let generate = |functions: &'static str, masses: &'static str| {
        vec![
            "generate",
            "planar-2r",
            "-l",
            "c",
            "-o",
            path,
            "--force",
            "--functions",
            functions,
            "--masses",
            masses,
        ]
    };
    refused(&generate("energy", "base"), 3, "base parameters do not tell energies");
    refused(&generate("torque", "numbers"), 3, "the description says nothing of masses");
}

/// Functions of a whole tree: of all its joints, by their names; what only a chain has is refused.
#[test]
fn whole_trees_are_generated() {
    let tree = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot/tests/urdf/solo12.urdf");
    let target = folder("solo12");
    let answer =
        generated(tree, "c", &target, &["--whole", "--functions", "torque,inertia,torque_with_derivatives"]);
    let functions = answer["functions"].as_array().expect("a list");
    assert_eq!(functions.len(), 3);
    for f in functions {
        assert!(f["claim"].as_str().unwrap().contains("equal to Lagrange's equations"), "{f}");
    }
    let all = texts(&target, &answer).concat();
    for word in ["q[36]", "A whole tree", "HL_KFE on"] {
        assert!(all.contains(word), "{word}");
    }
    let path = target.to_str().unwrap().to_string();
    let of = |robot: &'static str, more: &[&'static str]| -> Vec<String> {
        let start = ["generate", robot, "-l", "c", "-o", &path, "--force", "--whole"].map(str::to_string);
        start.into_iter().chain(more.iter().map(|w| (*w).to_string())).collect()
    };
    let said = |all: Vec<String>, code: i32, word: &str| {
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        refused(&all, code, word);
    };
    said(of(tree, &["--functions", "fk"]), 3, "fk is of a chain, not of a whole tree");
    said(of("ur5", &["--functions", "torque"]), 2, "ur5 is no tree");
}

/// Loads as arguments, and what a program divides by.
#[test]
fn loads_are_arguments() {
    let folder = folder("loads");
    fs::create_dir_all(&folder).unwrap();
    let arm = folder.join("two.toml");
    let rows = "[[joints]]\na = 'a1'\ntheta = 'q1'\n[[joints]]\na = 'a2'\ntheta = 'q2'\n";
    let table = format!(
        "name = 'two'\nconvention = 'standard'\ngravity = [0, '-9.81', 0]\n[parameters]\na1 = ''\na2 = ''\n{rows}"
    );
    fs::write(&arm, table).unwrap();
    let arm = arm.to_str().unwrap();
    let functions = ["--functions", "torque,inertia,acceleration", "--wrench", "--payload"];
    let answer = generated(arm, "c", &folder.join("c"), &functions);
    let of = |name: &str| {
        let all = answer["functions"].as_array().unwrap();
        all.iter().find(|f| f["name"] == name).unwrap_or_else(|| panic!("{answer}"))
    };
    let claim = |name: &str| of(name)["claim"].as_str().unwrap();
    assert!(claim("torque").contains("what holds the wrench proved equal to J^T w"), "{}", claim("torque"));
    assert!(!claim("inertia").contains("wrench"), "{}", claim("inertia"));
    // What was shortened and compared at random states is not called proved.
    for name in ["torque", "inertia", "acceleration"] {
        assert_eq!(of(name)["proved"], !claim(name).contains("random states"), "{answer}");
    }
    let divisors = of("torque")["divides_by"].as_array().cloned().unwrap_or_default();
    let is_said = claim("torque").contains("it divides by");
    assert_eq!(divisors.is_empty(), !is_said, "{answer}");
    let header = fs::read_to_string(folder.join("c/two.h")).unwrap();
    for part in
        ["force that the tool exerts, along x of the base, in N", "M of what the tool carries", "ML", "FX"]
    {
        assert!(header.contains(part), "{part}: {header}");
    }
    let bare = generated(arm, "python", &folder.join("bare"), &["--functions", "torque"]);
    assert_eq!(bare["functions"][0]["divides_by"][0], "a1", "{bare}");
    assert!(
        bare["functions"][0]["claim"]
            .as_str()
            .unwrap()
            .ends_with("it divides by a1, and holds where that is not 0")
    );
    let out = folder.join("none");
    let refuse = |more: &[&'static str], why: &str| {
        let base = ["generate", arm, "-l", "c", "-o", out.to_str().unwrap(), "--functions"];
        refused(&[&base[..], more].concat(), 3, why);
    };
    refuse(
        &["torque", "--masses", "base", "--payload"],
        "base parameters have what the tool carries in them",
    );
    refuse(&["inertia", "--wrench"], "no function that is asked for feels it");
    refuse(&["fk", "--payload"], "no function that is asked for feels it");
    let light = folder.join("light.toml");
    fs::write(&light, "convention = 'craig'\n[[joints]]\ntheta = 'q1'\nmass = 1\n").unwrap();
    let base = ["generate", light.to_str().unwrap(), "-l", "c", "-o", out.to_str().unwrap(), "--functions"];
    refused(&[&base[..], &["acceleration"]].concat(), 3, "joint 1 moves no mass of its own");
}
