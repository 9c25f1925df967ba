//! Generated source code in every language, built and run on its own vectors.

use crate::{command, path, program, scratch, succeed};
use anyhow::{Context, Result, bail};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
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
/// Of these those without a closed form back.
const ELIMINATED: &[&str] = &["oblique-6r"];
/// Of these also with the values of parameters in the code.
const FIXED: &[&str] = &["scara", "franka-panda"];
/// Of these the dynamic functions: of one with masses and friction, and of one that takes the numbers of its links, with loads; in Rust
/// of the first.
const MOVING: &[(&str, &[&str])] = &[
    ("crates/generate/tests/robots/moving.toml", &["--wrench"]),
    ("planar-2r", &["--masses", "links", "--wrench", "--payload"]),
];
/// Of these files with IKFast's interface: by formulas, by elimination, with a joint that is given, with one angle.
const INTERFACES: &[&str] = &["ur5", "oblique-6r", "franka-panda", "scara"];
/// What is generated of the others.
const KINEMATIC: &str = "fk,frames,jacobian,ik";
/// What is generated of those that move.
const DYNAMIC: &str = "fk,torque,inertia,bias,gravity,acceleration,energy,torque_derivatives,acceleration_derivatives,\
     torque_with_derivatives,acceleration_with_derivatives";
/// Robots that something was found with.
const CASES: &str = "crates/robot/tests/cases";
/// What every C file is compiled with, beside what its Makefile says.
const STRICT: &str = "-O2 -Wall -Wextra -Werror -pedantic";
const PYTHON_PACKAGES: &[&str] = &["numpy", "nvidia-cuda-nvrtc-cu12"];

/// Generates, builds and tests; installs what is missing first.
///
/// # Errors
/// If something cannot be installed, or a generated folder fails.
pub fn run() -> Result<()> {
    install()?;
    let tools =
        Tools { python: python(PYTHON_PACKAGES)?, program: program()?, folder: path("target/generated") };
    if tools.folder.exists() {
        fs::remove_dir_all(&tools.folder)?;
    }
    // Two at a time: compilers take a core each. All Rust is one of the parts.
    let kinematic = ROBOTS.iter().map(|&robot| (robot, KINEMATIC, &[][..]));
    let dynamic = MOVING.iter().map(|&(robot, more)| (robot, DYNAMIC, more));
    let robots = dynamic.chain(kinematic.rev());
    let parts = Mutex::new(robots.map(Some).chain([None]).collect::<Vec<_>>());
    let next = || parts.lock().ok()?.pop();
    let work = || -> Result<()> {
        while let Some(part) = next() {
            part.map_or_else(
                || tools.rust(),
                |(robot, functions, more)| tools.others(robot, functions, more),
            )?;
        }
        Ok(())
    };
    let (a, b) = thread::scope(|scope| {
        let other = scope.spawn(work);
        (work(), other.join())
    });
    a?;
    b.unwrap_or_else(|_| bail!("a test thread panicked"))?;
    println!(
        "{} robots in every language agree with their link transforms, forward and back, and {} with their torques",
        ROBOTS.len(),
        MOVING.len()
    );
    Ok(())
}

/// Every robot of the catalogue, and every file of the library's tests that is one, in C and in Rust: built and tested by the commands
/// that `generate` prints, or refused with a reason.
///
/// # Errors
/// What fails, all of it.
pub fn every() -> Result<()> {
    install()?;
    let (program, root) = (program()?, path("target/generated-every"));
    if root.exists() {
        fs::remove_dir_all(&root)?;
    }
    let listed = command(&program).args(["robots", "--json"]).output()?;
    let listed: serde_json::Value = serde_json::from_slice(&listed.stdout).context("a list of robots")?;
    let names = listed["robots"].as_array().context("robots")?.iter().filter_map(|r| r["name"].as_str());
    let mut robots: Vec<String> = names.map(str::to_string).collect();
    for file in fs::read_dir(path(CASES))? {
        let file = file?.path();
        if file.extension().is_some_and(|e| e == "toml") {
            robots.push(file.display().to_string());
        }
    }
    robots.sort();
    let (mut failed, mut refused) = (vec![], vec![]);
    let mut members = vec![];
    for robot in &robots {
        let stem = stem(robot)?.to_string();
        for language in ["c", "rust"] {
            let target = root.join(language).join(&stem);
            let mut generate = command(&program);
            generate.args(["generate", robot, "--language", language, "--functions", KINEMATIC, "--output"]);
            let output = generate.arg(&target).stdin(Stdio::null()).output()?;
            if !output.status.success() {
                let said = String::from_utf8_lossy(&output.stderr);
                let why = said.lines().last().unwrap_or("no reason").to_string();
                let list = if output.status.code() == Some(4) { &mut refused } else { &mut failed };
                list.push(format!("{stem} in {language}: {why}"));
            } else if language == "rust" {
                members.push(stem.clone());
            } else if let Err(why) = quietly(Command::new("make").arg("test").current_dir(&target)) {
                failed.push(format!("{stem} in C: {why:#}"));
            }
        }
    }
    let folder = root.join("rust");
    fs::write(folder.join("Cargo.toml"), format!("[workspace]\nresolver = \"3\"\nmembers = {members:?}\n"))?;
    let mut cargo = crate::cargo();
    cargo.args(["test", "--workspace", "--no-fail-fast", "--quiet", "--offline"]).current_dir(&folder);
    cargo.env("CARGO_TARGET_DIR", root.join("rust-target"));
    if let Err(why) = quietly(&mut cargo) {
        failed.push(format!("in Rust: {why:#}"));
    }
    refused.iter().for_each(|why| println!("refused: {why}"));
    println!("{} robots in C and {} in Rust, {} refused", robots.len(), members.len(), refused.len());
    if failed.is_empty() { Ok(()) } else { bail!("{}", failed.join("\n")) }
}

/// What generates and interprets, and where.
struct Tools {
    python: PathBuf,
    program: PathBuf,
    folder: PathBuf,
}

impl Tools {
    /// Generates source code into `target`.
    fn generate(
        &self,
        robot: &str,
        functions: &str,
        language: &str,
        extra: &[&str],
        target: PathBuf,
    ) -> Result<PathBuf> {
        let functions = ["--functions", functions, "--language", language, "--output"];
        let mut generate = command(&self.program);
        generate.args(["generate", robot]).args(functions).arg(&target).args(extra);
        quietly(&mut generate)?;
        Ok(target)
    }

    /// Every language but Rust.
    fn others(&self, robot: &str, functions: &str, more: &[&str]) -> Result<()> {
        let stem = stem(robot)?;
        let generate = |language: &str, extra: &[&str]| {
            let target = self.folder.join(format!("{stem}-{language}{}", extra.concat()));
            self.generate(robot, functions, language, &[more, extra].concat(), target)
        };
        for extra in [&[][..], &["--float"]] {
            c(&generate("c", extra)?, stem)?;
        }
        let target = generate("python", &[])?;
        quietly(
            Command::new(&self.python)
                .args(["-W", "error"])
                .arg(test_file(&target, ".py")?)
                .current_dir(&target),
        )?;
        let target = generate("matlab", &[])?;
        quietly(
            Command::new("octave")
                .args(["--no-gui", "--quiet"])
                .arg(test_file(&target, ".m")?)
                .current_dir(&target),
        )?;
        let target = generate("javascript", &[])?;
        quietly(Command::new("node").arg("--test").current_dir(&target))?;
        // Elimination is not generated in CUDA.
        let functions =
            if ELIMINATED.contains(&robot) { functions.trim_end_matches(",ik") } else { functions };
        for extra in [&[][..], &["--float"]] {
            let target = self.folder.join(format!("{stem}-cuda{}", extra.concat()));
            let target = self.generate(robot, functions, "cuda", &[more, extra].concat(), target)?;
            quietly(Command::new(&self.python).arg(test_file(&target, ".py")?).current_dir(&target))?;
        }
        if FIXED.contains(&robot) {
            c(&generate("c", &["--fixed"])?, stem)?;
        }
        if INTERFACES.contains(&robot) {
            let target = self.folder.join(format!("{stem}-ikfast"));
            self.generate(robot, "fk,ik", "ikfast", &[], target.clone())?;
            for compiler in ["g++", "clang++"] {
                quietly(Command::new("make").args(["clean"]).current_dir(&target))?;
                let compiler = format!("CXX={compiler}");
                quietly(Command::new("make").args(["test", &compiler]).current_dir(&target))?;
            }
        }
        Ok(())
    }

    /// All packages in one workspace, with the standard library and without, with and without fused multiplications; and
    /// one of them as its user has it.
    fn rust(&self) -> Result<()> {
        let folder = self.folder.join("rust");
        let mut members = vec![];
        for robot in ROBOTS {
            let stem = stem(robot)?;
            members.push(stem.to_string());
            self.generate(robot, KINEMATIC, "rust", &[], folder.join(stem))?;
            if FIXED.contains(robot) {
                let name = format!("{}_fixed", stem.replace('-', "_"));
                self.generate(robot, KINEMATIC, "rust", &["--fixed", "--name", &name], folder.join(&name))?;
                members.push(name);
            }
        }
        let (moving, more) = MOVING[0];
        members.push(stem(moving)?.to_string());
        self.generate(moving, DYNAMIC, "rust", more, folder.join(stem(moving)?))?;
        let manifest = format!("[workspace]\nresolver = \"3\"\nmembers = {members:?}\n");
        fs::write(folder.join("Cargo.toml"), manifest)?;
        let cargo = |folder: &Path, arguments: &[&str], flags: &str| {
            let mut cargo = crate::cargo();
            cargo.args(arguments).args(["--quiet", "--offline"]).current_dir(folder);
            cargo.env("CARGO_TARGET_DIR", self.folder.join("rust-target"));
            quietly(cargo.env("RUSTFLAGS", format!("-D warnings {flags}")))
        };
        cargo(&folder, &["test", "--workspace"], "")?;
        cargo(&folder, &["build", "--workspace", "--no-default-features"], "")?;
        if cfg!(target_arch = "x86_64") && std::is_x86_feature_detected!("fma") {
            cargo(&folder, &["test", "--workspace"], "-C target-cpu=x86-64-v3")?;
        }
        let alone = self.folder.join("rust-alone");
        cargo(&self.generate(ROBOTS[0], KINEMATIC, "rust", &[], alone)?, &["test"], "")
    }
}

fn stem(robot: &str) -> Result<&str> {
    Path::new(robot).file_stem().and_then(|s| s.to_str()).context("a name")
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

/// What the tests of generated code need.
///
/// # Errors
/// If something cannot be installed.
pub fn install() -> Result<()> {
    install_missing(&[
        ("gcc", &["gcc"]),
        ("g++", &["g++"]),
        ("make", &["make"]),
        ("clang", &["clang"]),
        ("octave", &["octave"]),
        ("node", &["nodejs"]),
        ("python3", &["python3"]),
        ("/usr/include/eigen3", &["libeigen3-dev"]),
    ])
}

/// Debian packages for the programs, and headers by their folders, that are missing.
///
/// # Errors
/// If they cannot be installed.
pub fn install_missing(programs: &[(&str, &[&str])]) -> Result<()> {
    let is_missing = |program: &str| {
        if program.starts_with('/') {
            return !Path::new(program).exists();
        }
        let started =
            Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        !started.is_ok_and(|s| s.success())
    };
    let missing: BTreeSet<&str> =
        programs.iter().filter(|p| is_missing(p.0)).flat_map(|p| p.1).copied().collect();
    if missing.is_empty() {
        return Ok(());
    }
    println!("installing {}", missing.iter().copied().collect::<Vec<_>>().join(", "));
    apt(&["update", "-qq"]).context("installing needs apt and the right to use it")?;
    let mut arguments = vec!["install", "-y", "-qq", "--no-install-recommends"];
    arguments.extend(&missing);
    apt(&arguments)
}

/// What installs is used by one step at a time: until the file is dropped.
fn turn(of: &str) -> Result<fs::File> {
    let file = fs::File::create(scratch()?.join(format!("{of}.lock")))?;
    file.lock()?;
    Ok(file)
}

/// Debian's package manager.
pub fn apt(arguments: &[&str]) -> Result<()> {
    let _turn = turn("apt")?;
    // Somebody else may be installing something.
    let wait = ["-o", "DPkg::Lock::Timeout=600"];
    quietly(Command::new("apt-get").args(wait).args(arguments).env("DEBIAN_FRONTEND", "noninteractive"))
}

/// The Python of the project's environment, with these packages.
pub fn python(packages: &[&str]) -> Result<PathBuf> {
    python_in(&path(".venv"), packages)
}

/// The Python of an environment, with these packages: `name`, or `name==version`.
pub fn python_in(folder: &Path, packages: &[&str]) -> Result<PathBuf> {
    let _turn = turn("python")?;
    let python = interpreter(folder);
    let first = if cfg!(windows) { "python" } else { "python3" };
    let environment = || succeed(command(first).args(["-m", "venv"]).arg(folder));
    if !python.exists() && environment().is_err() {
        apt(&["install", "-y", "-qq", "python3-venv"])?;
        environment()?;
    }
    let mut pip = Command::new(&python);
    let listed = pip.args(["-m", "pip", "list", "--format", "freeze"]).stderr(Stdio::null()).output()?;
    let listed = String::from_utf8_lossy(&listed.stdout).to_lowercase().replace('_', "-");
    let has = |package: &&&str| {
        let name = package.to_lowercase().replace('_', "-");
        // What a package brings besides is not listed with it.
        let name = name.split('[').next().unwrap_or_default();
        listed.lines().any(|l| l == name || l.split("==").next() == Some(name))
    };
    let missing: Vec<&&str> = packages.iter().filter(|p| !has(p)).collect();
    if !missing.is_empty() {
        succeed(Command::new(&python).args(["-m", "pip", "install", "--quiet"]).args(missing))?;
    }
    Ok(python)
}

/// The Python of a virtual environment.
pub fn interpreter(environment: &Path) -> PathBuf {
    environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}
