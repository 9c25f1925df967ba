//! Generated source code in every language, built and run on its own vectors.

use crate::{command, path, succeed};
use anyhow::{Context, Result, bail};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

/// Robots of different structure: parallel and crossing axes, slides, couplings, redundant arms, a rail, oblique
/// twists (which have no closed form back); and some whose parameters have no values, hostile names, or those of results.
const ROBOTS: &[&str] = &[
    "ur5",
    "staubli-rx90",
    "stanford",
    "scara",
    "prrrrp",
    "cylindrical-wrist",
    "franka-panda",
    "smart5-six-rail",
    "oblique-6r",
    "crates/generate/tests/robots/symbols.toml",
    "crates/generate/tests/robots/mixed.toml",
    "crates/generate/tests/robots/names.toml",
];
/// Of these also with the values of parameters in the code.
const FIXED: &[&str] = &["scara", "franka-panda"];
/// What every C file is compiled with, beside what its Makefile says.
const STRICT: &str = "-O2 -Wall -Wextra -Werror -pedantic";
const PYTHON_PACKAGES: &[&str] = &["numpy", "nvidia-cuda-nvrtc-cu12"];

/// Generates, builds and tests; installs what is missing first.
///
/// # Errors
/// If something cannot be installed, or a generated folder fails.
pub fn run() -> Result<()> {
    install()?;
    let python = python(PYTHON_PACKAGES)?;
    succeed(crate::cargo().args(["build", "--locked", "-p", "denavit-cli"]))?;
    let folder = path("target/generated");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    // Two at a time: compilers take a core each.
    let (first, second) = ROBOTS.split_at(ROBOTS.len() / 2);
    let half = |robots: &'static [&'static str]| {
        let (python, folder) = (python.clone(), folder.clone());
        move || robots.iter().try_for_each(|robot| one(robot, &python, &folder))
    };
    let (a, b) = thread::scope(|scope| {
        let other = scope.spawn(half(second));
        let own = half(first)();
        (own, other.join())
    });
    a?;
    b.unwrap_or_else(|_| bail!("a test thread panicked"))?;
    println!("{} robots in every language agree with their link transforms, forward and back", ROBOTS.len());
    Ok(())
}

fn one(robot: &str, python: &Path, folder: &Path) -> Result<()> {
    let stem = Path::new(robot).file_stem().and_then(|s| s.to_str()).context("a name")?;
    let generate = |language: &str, extra: &[&str]| -> Result<PathBuf> {
        let target = folder.join(format!("{stem}-{language}{}", extra.concat()));
        let functions = ["--functions", "fk,frames,jacobian,ik", "--language", language, "--output"];
        let output = command(path("target/debug/denavit"))
            .args(["generate", robot])
            .args(functions)
            .arg(&target)
            .args(extra)
            .output()?;
        if !output.status.success() {
            bail!("generate {robot} --language {language}: {}", String::from_utf8_lossy(&output.stderr));
        }
        Ok(target)
    };
    rust(&generate("rust", &[])?, folder)?;
    for extra in [&[][..], &["--float"]] {
        c(&generate("c", extra)?, stem)?;
    }
    let target = generate("python", &[])?;
    quietly(Command::new(python).args(["-W", "error"]).arg(test_file(&target, ".py")?).current_dir(&target))?;
    let target = generate("matlab", &[])?;
    quietly(
        Command::new("octave")
            .args(["--no-gui", "--quiet"])
            .arg(test_file(&target, ".m")?)
            .current_dir(&target),
    )?;
    let target = generate("javascript", &[])?;
    quietly(Command::new("node").arg("--test").current_dir(&target))?;
    for extra in [&[][..], &["--float"]] {
        let target = generate("cuda", extra)?;
        quietly(Command::new(python).arg(test_file(&target, ".py")?).current_dir(&target))?;
    }
    if FIXED.contains(&robot) {
        c(&generate("c", &["--fixed"])?, stem)?;
        rust(&generate("rust", &["--fixed"])?, folder)?;
    }
    Ok(())
}

/// With the standard library and without, with and without fused multiplications.
fn rust(target: &Path, folder: &Path) -> Result<()> {
    let build = folder.join("rust-target").join(thread_name());
    let cargo = |arguments: &[&str], flags: &str| {
        let mut cargo = crate::cargo();
        cargo.args(arguments).current_dir(target).env("CARGO_TARGET_DIR", &build);
        cargo.env("RUSTFLAGS", format!("-D warnings {flags}"));
        quietly(&mut cargo)
    };
    cargo(&["test", "--quiet"], "")?;
    cargo(&["build", "--quiet", "--no-default-features"], "")?;
    if cfg!(target_arch = "x86_64") && std::is_x86_feature_detected!("fma") {
        cargo(&["test", "--quiet"], "-C target-cpu=x86-64-v3")?;
    }
    Ok(())
}

/// Under two compilers, as C and as C++.
fn c(target: &Path, stem: &str) -> Result<()> {
    for compiler in ["gcc", "clang"] {
        quietly(Command::new("make").args(["clean"]).current_dir(target))?;
        let flags = [format!("CC={compiler}"), format!("CFLAGS=-std=c99 {STRICT} -ffp-contract=off")];
        quietly(Command::new("make").arg("test").args(&flags).current_dir(target))?;
    }
    let source = format!("{}.c", stem.replace('-', "_"));
    for (compiler, extra) in [("g++", ""), ("clang++", "-Wno-deprecated")] {
        let mut cpp = Command::new(compiler);
        cpp.args(["-x", "c++", "-std=c++11"]).args(STRICT.split(' ')).args(extra.split_whitespace());
        cpp.args(["-c", &source, "-o", "cpp.o"]).current_dir(target);
        quietly(&mut cpp)?;
    }
    Ok(())
}

/// A name for this thread's build folder, so that two builds do not wait for each other.
fn thread_name() -> String {
    format!("{:?}", thread::current().id()).replace(['(', ')'], "")
}

fn test_file(target: &Path, ending: &str) -> Result<PathBuf> {
    let files = fs::read_dir(target)?.filter_map(|f| Some(f.ok()?.path()));
    let is_test = |f: &PathBuf| {
        let name = f.file_name().and_then(|n| n.to_str()).unwrap_or_default();
        name.starts_with("test_") && name.ends_with(ending)
    };
    let file = files.into_iter().find(is_test);
    let file = file.with_context(|| format!("{}: no test file", target.display()))?;
    Ok(PathBuf::from(file.file_name().context("a file has a name")?))
}

/// Runs a command; its output is shown if it fails.
pub fn quietly(command: &mut Command) -> Result<()> {
    let output =
        command.stdin(Stdio::null()).output().with_context(|| format!("{command:?} does not start"))?;
    if !output.status.success() {
        bail!(
            "{command:?} in {} failed ({})\n{}{}",
            command.get_current_dir().unwrap_or(Path::new(".")).display(),
            output.status,
            String::from_utf8_lossy(&output.stdout),
            String::from_utf8_lossy(&output.stderr)
        );
    }
    Ok(())
}

/// Debian packages for the programs that are missing.
fn install() -> Result<()> {
    const PROGRAMS: &[(&str, &str)] = &[
        ("gcc", "gcc"),
        ("g++", "g++"),
        ("make", "make"),
        ("clang", "clang"),
        ("octave", "octave"),
        ("node", "nodejs"),
        ("python3", "python3"),
    ];
    let is_missing = |program: &str| {
        let started =
            Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        !started.is_ok_and(|s| s.success())
    };
    let missing: BTreeSet<&str> = PROGRAMS.iter().filter(|p| is_missing(p.0)).map(|p| p.1).collect();
    if missing.is_empty() {
        return Ok(());
    }
    println!("installing {}", missing.iter().copied().collect::<Vec<_>>().join(", "));
    apt(&["update", "-qq"]).context("installing needs apt and the right to use it")?;
    let mut arguments = vec!["install", "-y", "-qq", "--no-install-recommends"];
    arguments.extend(&missing);
    apt(&arguments)
}

/// Debian's package manager.
pub fn apt(arguments: &[&str]) -> Result<()> {
    quietly(Command::new("apt-get").args(arguments).env("DEBIAN_FRONTEND", "noninteractive"))
}

/// The Python of the project's environment, with these packages.
pub fn python(packages: &[&str]) -> Result<PathBuf> {
    let python = path(".venv/bin/python");
    let environment = || succeed(command("python3").args(["-m", "venv", ".venv"]));
    if !python.exists() && environment().is_err() {
        apt(&["install", "-y", "-qq", "python3-venv"])?;
        environment()?;
    }
    let has = |package: &str| {
        let mut pip = Command::new(&python);
        pip.args(["-m", "pip", "show", "--quiet", package]).stderr(Stdio::null());
        pip.status().is_ok_and(|s| s.success())
    };
    let missing: Vec<&&str> = packages.iter().filter(|p| !has(p)).collect();
    if !missing.is_empty() {
        succeed(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(missing))?;
    }
    Ok(python)
}
