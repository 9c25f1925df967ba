//! Speed of generated dynamics beside Pinocchio, its generated code and the crate dynibo: `bench/dynamics`, built with all of them.

use super::MISSED;
use super::evaluation::table;
use crate::languages::{apt, python, quietly};
use crate::{command, path, program, target};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fmt::Write;
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

/// Pinocchio's generator of C (`CodeGenRNEA` …), of the versions that go together. Peers alone: nothing of them is handed out.
const GENERATOR: &[&str] = &["cmeel-cppad==20230000.0", "cmeel-cppadcodegen==2.4.3"];
/// How the generated C is compiled: as Pinocchio does by default, and for this processor.
const GENERATED: &[&str] = &["-Ofast", "-march=native", "-c"];
/// The part of the time of Pinocchio's generated code that ours may take.
const PART: f64 = 0.5;

const INTRODUCTION: &str = "\
A UR5 and a Panda (seven joints, its hand fixed) with the numbers of their URDFs: generated C (gcc, one state or blocks as large as\n\
its header says, 1,024 random states) beside Pinocchio 4.1 in C++ (clang, `-O3 -march=native`, templates built for this processor), in one program, with\n\
the C that Pinocchio generates for each of the arms (`CodeGenRNEA` and its like by CppADCodeGen 2.4.3; gcc, `-Ofast -march=native`, its own default) and\n\
the crate dynibo 0.5.3 (`target-cpu=native`). The\n\
unit U, rounds and quartiles are those of [evaluation](#evaluation). Before anything is timed torques, accelerations and\n\
derivatives of all of them are compared with Pinocchio's in every state: they agree within 1e-9 of their size (the URDF's 1.57079632679 is\n\
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
        model.arg(path("bench/dynamics/model.py")).arg(&file).args([tip, arm]).arg(&folder);
        quietly(&mut model)?;
    }
    let headers =
        "import pinocchio, pathlib; print(pathlib.Path(pinocchio.__file__).resolve().parents[4] / 'include')";
    let headers = output(Command::new(&python).args(["-c", headers]))?;
    let mut left_out = String::new();
    let mut defined = vec![];
    for (what, definition, peer) in [
        ("Pinocchio's generated code", "-DGENERATED", generated(headers.trim(), &folder)),
        ("dynibo", "-DDYNIBO", dynibo(&folder).map(|library| vec![library])),
    ] {
        match peer {
            Ok(more) => {
                objects.extend(more);
                defined.push(definition);
            }
            Err(why) => {
                println!("{what} is left out: {why:#}");
                let _ = writeln!(left_out, "\nLeft out, as it does not build here: {what}.");
            }
        }
    }
    println!("building Pinocchio takes a minute or two");
    let built = folder.join("bench");
    let mut clang = Command::new("clang++");
    clang.args(PINOCCHIO).arg(headers.trim()).args(defined).arg("-I").arg(&folder);
    clang.arg(path("bench/dynamics/bench.cpp")).args(&objects);
    quietly(clang.arg("-o").arg(&built).args(["-lm", "-lpthread", "-ldl"]))?;
    let measured = output(Command::new(&built).arg(&folder))?;
    let measured = serde_json::from_str(&measured).context("the benchmark prints JSON")?;
    let table = format!("{}{}{left_out}", table(&measured)?, beside(&measured)?);
    println!("{table}");
    Ok(format!("{INTRODUCTION}{table}"))
}

/// The objects of the C that Pinocchio generates.
fn generated(headers: &str, folder: &Path) -> Result<Vec<PathBuf>> {
    python(GENERATOR)?;
    let folder_of_code = folder.join("generated");
    let generator = folder.join("codegen");
    println!("building Pinocchio's generator takes some minutes");
    let mut clang = Command::new("clang++");
    let options = PINOCCHIO.iter().map(|o| if *o == "-O3" { "-O0" } else { *o });
    clang.args(options).arg(headers).arg("-I").arg(folder).arg(path("bench/dynamics/codegen.cpp"));
    quietly(clang.arg("-o").arg(&generator).arg("-ldl"))?;
    quietly(Command::new(&generator).arg(&folder_of_code))?;
    let mut objects = vec![];
    for (_, _, arm) in ARMS {
        for function in ["rnea", "crba", "aba", "derivatives"] {
            let name = format!("{arm}_{function}_forward_zero");
            let mut gcc = Command::new("gcc");
            quietly(gcc.args(GENERATED).arg(format!("{name}.c")).current_dir(&folder_of_code))?;
            objects.push(folder_of_code.join(format!("{name}.o")));
        }
    }
    Ok(objects)
}

/// The crate dynibo with functions that C++ calls.
fn dynibo(folder: &Path) -> Result<PathBuf> {
    let target = folder.join("dynibo");
    let mut cargo = command("cargo");
    cargo
        .args(["build", "--release", "--locked", "--manifest-path"])
        .arg(path("bench/dynamics/dynibo/Cargo.toml"));
    quietly(cargo.arg("--target-dir").arg(&target).env("RUSTFLAGS", "-C target-cpu=native"))?;
    Ok(target.join("release/libdenavit_bench_dynibo.a"))
}

/// What part of the time of Pinocchio's generated code ours takes.
fn beside(measured: &Value) -> Result<String> {
    let parts = measured["beside"].as_array().context("a list of parts")?;
    if parts.is_empty() {
        return Ok(String::new());
    }
    let mut text =
        String::from("\n| of the time of Pinocchio's generated code | part | limit |\n|---|---:|---:|\n");
    for part in parts {
        let word = |key: &str| part[key].as_str().unwrap_or_default();
        let own = part["part"].as_f64().context("a part")?;
        let verdict = if own > PART { format!(" {MISSED}") } else { String::new() };
        let _ = writeln!(text, "| {}, {} | {own:.3} | {PART}{verdict} |", word("group"), word("name"));
    }
    Ok(text)
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
