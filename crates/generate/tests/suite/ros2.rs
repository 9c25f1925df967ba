//! Packages for ROS 2: their own test, and their plug-ins behind stand-ins for ROS's headers.

use crate::packages::{self, run};
use denavit::description::{Chain, Convention, Decimals, JointKind, Mechanism, read_urdf};
use denavit::inverse::{Goal, InverseOptions};
use denavit_emit::Language;
use denavit_generate::{Links, PackageOptions, Wanted, generate_ros2};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The package of a chain of one of the project's URDFs, in a folder of its own, with what was read.
fn package(file: &str, tip: &str, goal: Goal) -> (PathBuf, Mechanism, Chain) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../robot/tests/urdf/{file}.urdf"));
    let text = fs::read_to_string(path).expect("the file is there");
    let (mechanism, _) = read_urdf(&text, Decimals::Meant).expect("it can be read");
    let chain = mechanism.chain(None, Some(tip), Convention::Craig).expect("there is a chain");
    let options = PackageOptions {
        inverse: InverseOptions { goal, given: None },
        name: Some(file.into()),
        ..packages::options(Language::C, &[Wanted::Pose, Wanted::Inverse])
    };
    let links = Links::new(&mechanism, &chain, &chain.description).expect("it has values");
    let made = generate_ros2(&chain.description, &links, &options).expect("it can be generated");
    let folder = packages::folder(&format!("ros2-{file}"), &made.files);
    (folder, mechanism, chain)
}

/// The robot model of the driver: the joints of the URDF, written out.
fn model(name: &str, m: &Mechanism, chain: &Chain, given: &[usize]) -> String {
    let value = |e: denavit_symbolic::Expr| e.eval(|_| None).expect("a number");
    let quoted = |s: &str| format!("\"{s}\"");
    let mut text = String::from(
        "#pragma once\n#include <moveit/robot_state/robot_state.hpp>\n\n\
         inline moveit::core::RobotModel robot()\n{\n    moveit::core::RobotModel model;\n    \
         moveit::core::JointModel joint;\n    moveit::core::VariableBounds bounds;\n",
    );
    for j in &m.joints {
        let x = j.origin.map(value);
        let axis = j.axis.map(value);
        let axis = axis * (1.0 / axis.norm().max(1e-300));
        let moves = j.kind.is_some() && j.follows.is_none();
        let slides = j.kind == Some(JointKind::Prismatic);
        let parent = &m.bodies[j.parent].name;
        let child = &m.bodies[j.child].name;
        let _ = write!(
            text,
            "    joint.name = \"{}\";\n    joint.parent = \"{parent}\";\n    joint.child = \"{child}\";\n    \
             joint.moves = {moves};\n    joint.slides = {slides};\n",
            j.name
        );
        let rows = x.matrix();
        for (i, row) in rows.iter().enumerate().take(3) {
            for (k, entry) in row.iter().enumerate() {
                let _ = writeln!(text, "    joint.origin.matrix()({i}, {k}) = {entry:?};");
            }
        }
        let _ =
            writeln!(text, "    joint.axis = Eigen::Vector3d({:?}, {:?}, {:?});", axis[0], axis[1], axis[2]);
        let limits = j.limits.map(|l| l.map(value));
        let [low, high] = limits.unwrap_or([0.0, 0.0]);
        let _ = write!(
            text,
            "    bounds.min_position_ = {low:?};\n    bounds.max_position_ = {high:?};\n    \
             bounds.position_bounded_ = {};\n    joint.bounds.assign(1, bounds);\n    \
             model.joints.push_back(joint);\n",
            limits.is_some()
        );
        if moves {
            let _ = writeln!(text, "    model.groups[\"arm\"].joints.push_back(joint.name);");
        }
    }
    let joints: Vec<String> = chain.joints.iter().map(|&j| quoted(&m.joints[j].name)).collect();
    let given: Vec<String> = given.iter().map(usize::to_string).collect();
    let _ = write!(
        text,
        "    return model;\n}}\n\n#define BASE {}\n#define TIP {}\n#define PACKAGE \"{name}_kinematics\"\n\
         static const std::vector<std::string> JOINTS = {{{}}};\n\
         static const std::vector<unsigned int> FREE = {{{}}};\n",
        quoted(&m.bodies[chain.from].name),
        quoted(&m.bodies[chain.to].name),
        joints.join(", "),
        given.join(", ")
    );
    text
}

/// The package's own test by its own command; then both plug-ins, with the interfaces of these distributions, asked by a node.
fn plug_ins(file: &str, tip: &str, given: &[usize], distributions: &[&str]) {
    let eigen = Path::new("/usr/include/eigen3");
    assert!(
        eigen.exists(),
        "this needs Eigen's headers (Debian: libeigen3-dev; `cargo xtask test` installs them)"
    );
    let (folder, mechanism, chain) = package(file, tip, Goal::Pose);
    run(Command::new("make").arg("test").current_dir(&folder));
    let stands = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/ros2");
    fs::write(folder.join("model.hpp"), model(file, &mechanism, &chain, given)).expect("it can be written");
    for distribution in distributions {
        let mut compile = Command::new("g++");
        compile.args(["-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", "-D", distribution]);
        compile.args(["-Iinclude", "-I.", "-isystem"]).arg(eigen).arg("-I").arg(&stands);
        compile.args(["src/arm.cpp", "src/moveit_plugin.cpp", "src/control_plugin.cpp"]);
        compile.arg(stands.join("driver.cpp")).arg(format!("{file}.o")).args(["-o", "driver"]);
        run(compile.arg("-Isrc").current_dir(&folder));
        run(Command::new("./driver").current_dir(&folder));
    }
}

#[test]
fn plug_ins_of_an_arm_with_six_joints() {
    plug_ins("ur5_robot", "tool0", &[], &["JAZZY", "HUMBLE"]);
}

#[test]
fn plug_ins_of_an_arm_with_a_joint_in_excess() {
    plug_ins("panda", "panda_link8", &[6], &["JAZZY"]);
}

/// Arms with five joints, arms by elimination, positions alone: the arm in plain C++ passes its own test.
#[test]
fn arms_in_plain_cpp_pass_their_tests() {
    for (file, tip, goal) in [
        ("so101", "gripper_frame_link", Goal::Pose),
        ("xarm7", "link7", Goal::Pose),
        ("solo12", "FL_FOOT", Goal::Position),
    ] {
        let (folder, ..) = package(file, tip, goal);
        run(Command::new("make").arg("test").current_dir(folder));
    }
}
