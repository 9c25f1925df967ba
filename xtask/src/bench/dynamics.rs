//! Speed of generated dynamics beside Pinocchio: `bench/dynamics`, built with both.

use super::evaluation::table;
use crate::languages::{apt, python, quietly};
use crate::{command, path, program, target};
use anyhow::{Context, Result, bail};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Files, tips and names of the arms.
pub(super) const ARMS: [(&str, &str, &str); 2] =
    [("ur5_robot", "tool0", "ur5"), ("panda", "panda_link8", "panda")];
/// Levels of instructions, with what gcc needs to use them.
const LEVELS: [(&str, &[&str]); 2] = [("v3", &[]), ("v4", &["-mprefer-vector-width=512"])];
const FUNCTIONS: &str = "torque,inertia,acceleration,torque_derivatives,torque_with_derivatives";
/// What Pinocchio's headers ask of a compiler.
const PINOCCHIO: &[&str] = &[
    "-std=c++17",
    "-O3",
    "-march=native",
    "-DNDEBUG",
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
    "-isystem",
    "/usr/include/eigen3",
    "-isystem",
];

const INTRODUCTION: &str = "\
A UR5 and a Panda (seven joints, its hand fixed) with the numbers of their URDFs: generated C (gcc, one state or blocks as large as\n\
its header says, 1,024 random states) beside Pinocchio 4.1 in C++ (clang, `-O3 -march=native`, templates built for this processor), in one program. The\n\
unit U, rounds and quartiles are those of [evaluation](#evaluation). Before anything is timed torques, accelerations and\n\
derivatives are compared with Pinocchio's in every state: they agree within 1e-9 of their size (the URDF's 1.57079632679 is\n\
π/2 to us). A is all of the matrix; Pinocchio computes half of it. Torque with derivatives is τ, ∂τ/∂q, ∂τ/∂q̇ and A, by\n\
`torque_with_derivatives`.\n";

/// Generates, builds and measures, and gives the section of the page.
///
/// # Errors
/// If something is missing that cannot be installed, or results differ.
pub fn run() -> Result<String> {
    if !cfg!(target_arch = "x86_64") {
        return Ok("Measured on x86-64 only.\n".into());
    }
    if !Path::new("/usr/include/eigen3").exists() {
        println!("installing Eigen");
        apt(&["install", "-y", "-qq", "--no-install-recommends", "libeigen3-dev"])?;
    }
    let python = python(&["numpy", "pin"])?;
    let (program, folder) = (program()?, target().join("bench/dynamics"));
    fs::create_dir_all(&folder)?;
    let mut objects: Vec<PathBuf> = vec![];
    for (file, tip, arm) in ARMS {
        let file = path(&format!("crates/robot/tests/urdf/{file}.urdf"));
        for (level, more) in LEVELS {
            let name = format!("{arm}{level}");
            let mut generate = command(&program);
            generate.arg("generate").arg(&file).args([
                "--tip",
                tip,
                "--language",
                "c",
                "--functions",
                FUNCTIONS,
            ]);
            quietly(generate.args(["--name", &name, "--force", "--output"]).arg(&folder))?;
            let mut gcc = Command::new("gcc");
            gcc.args(["-std=c99", "-O3", "-ffp-contract=off", "-c", &format!("-march=x86-64-{level}")])
                .args(more);
            quietly(gcc.arg(format!("{name}.c")).current_dir(&folder))?;
            objects.push(folder.join(format!("{name}.o")));
        }
        let mut model = Command::new(&python);
        let text = output(model.arg(path("bench/dynamics/model.py")).arg(&file).args([tip, arm]))?;
        fs::write(folder.join(format!("{arm}.inc")), text)?;
    }
    let headers =
        "import pinocchio, pathlib; print(pathlib.Path(pinocchio.__file__).resolve().parents[4] / 'include')";
    let headers = output(Command::new(&python).args(["-c", headers]))?;
    println!("building Pinocchio takes a minute or two");
    let built = folder.join("bench");
    let mut clang = Command::new("clang++");
    clang.args(PINOCCHIO).arg(headers.trim()).arg("-I").arg(&folder).arg(path("bench/dynamics/bench.cpp"));
    quietly(clang.args(&objects).arg("-o").arg(&built).arg("-lm"))?;
    let measured =
        serde_json::from_str(&output(&mut Command::new(&built))?).context("the benchmark prints JSON")?;
    let table = table(&measured)?;
    println!("{table}");
    Ok(format!("{INTRODUCTION}{table}"))
}

/// What a command prints.
pub(super) fn output(command: &mut Command) -> Result<String> {
    let output =
        command.stderr(Stdio::inherit()).output().with_context(|| format!("{command:?} does not start"))?;
    if !output.status.success() {
        bail!("{command:?} failed");
    }
    Ok(String::from_utf8(output.stdout)?)
}
