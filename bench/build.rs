//! Generates source code for some arms and compiles it, Rust with this compiler, C with gcc and clang. Where nothing is
//! measured (`cargo check`), it is compiled without being optimised.

use denavit::catalogue;
use denavit_emit::{Language, Precision};
use denavit_generate::{PackageOptions, Wanted, generate};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// What is generated.
struct Source {
    robot: &'static str,
    name: &'static str,
    wanted: Wanted,
    precision: Precision,
}

const UR5: Source = Source { robot: "ur5", name: "ur5", wanted: Wanted::Pose, precision: Precision::Double };
const UR5_SINGLE: Source = Source { name: "ur5f", precision: Precision::Single, ..UR5 };
const PANDA: Source = Source { robot: "franka-panda", name: "panda", wanted: Wanted::Frames, ..UR5 };
const UR5_JACOBIAN: Source = Source { name: "ur5j", wanted: Wanted::JacobianAndPose, ..UR5 };
const PANDA_JACOBIAN: Source = Source { robot: "franka-panda", name: "pandaj", ..UR5_JACOBIAN };
const UR5_INVERSE: Source = Source { name: "ur5_ik", wanted: Wanted::Inverse, ..UR5 };
const IRB_INVERSE: Source = Source { robot: "abb-irb2400-10", name: "irb2400_ik", ..UR5_INVERSE };

/// Levels of instructions to compile for; on other architectures there is one.
const LEVELS: [&str; 2] = ["v3", "v4"];

/// Both compilers take 256 bits at a time where 512 are there, unless they are told otherwise.
const WIDE_RUST: &[&str] = &["-C", "target-feature=-prefer-256-bit", "-A", "warnings"];

/// What `rustc` calls a level of optimisation; of C compilers it is the flag `-O`.
fn effort() -> &'static str {
    if env::var("PROFILE").is_ok_and(|p| p == "release") { "3" } else { "0" }
}

fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let is_x86 = env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|a| a == "x86_64");
    for level in LEVELS {
        let target = if is_x86 { format!("x86-64-{level}") } else { "native".into() };
        for source in [&UR5, &PANDA, &UR5_JACOBIAN, &PANDA_JACOBIAN, &UR5_INVERSE, &IRB_INVERSE] {
            rust(&out, source, level, &target);
        }
        for source in [&UR5, &UR5_SINGLE, &PANDA, &UR5_JACOBIAN, &PANDA_JACOBIAN] {
            for compiler in ["gcc", "clang"] {
                c(&out, source, compiler, level, &target);
            }
        }
    }
    println!("cargo:rustc-link-search=all={}", out.display());
    println!("cargo:rustc-link-lib=m");
}

fn rust(out: &Path, source: &Source, level: &str, target: &str) {
    let name = format!("{}_{level}", source.name);
    let folder = write(out, Language::Rust, source);
    let rustc = env::var_os("RUSTC").expect("cargo sets RUSTC");
    run(Command::new(rustc)
        .args(["--crate-type", "rlib", "--crate-name", &name, "--edition", "2024"])
        .args(["--cfg", "feature=\"std\"", "-C", &format!("opt-level={}", effort())])
        .args(["-C", &format!("target-cpu={target}")])
        .args(if level == "v4" { WIDE_RUST } else { &[] })
        .arg(folder.join("src/lib.rs"))
        .arg("-o")
        .arg(out.join(format!("lib{name}.rlib"))));
}

fn c(out: &Path, source: &Source, compiler: &str, level: &str, target: &str) {
    let (name, folder) = (source.name, write(out, Language::C, source));
    // A header says how many configurations a block holds.
    let header = fs::read_to_string(folder.join(format!("{name}.h"))).expect("a header");
    let lanes = format!("{}_LANES", name.to_uppercase());
    let count = header.lines().find_map(|line| line.strip_prefix(&format!("#define {lanes} ")));
    println!("cargo:rustc-env={lanes}={}", count.expect("a header says its lanes"));
    let own = format!("{name}_{compiler}_{level}");
    let object = out.join(format!("{own}.o"));
    let mut command = Command::new(compiler);
    command.args(["-std=c99", &format!("-O{}", effort()), "-fPIE", "-ffp-contract=off"]);
    command.arg(format!("-march={target}"));
    // The same file several times in one program: the functions of each get names of their own.
    if level == "v4" {
        command.arg("-mprefer-vector-width=512");
    }
    for symbol in ["fk", "fk_block", "frames", "frames_block", "jacobian_fk", "jacobian_fk_block", "defaults"]
    {
        command.arg(format!("-D{name}_{symbol}={own}_{symbol}"));
    }
    run(command.arg("-c").arg(folder.join(format!("{name}.c"))).arg("-o").arg(&object));
    let archive = out.join(format!("lib{own}.a"));
    let _ = fs::remove_file(&archive);
    run(Command::new("ar").arg("rcs").arg(&archive).arg(&object));
    println!("cargo:rustc-link-lib=static={own}");
}

fn write(out: &Path, language: Language, source: &Source) -> PathBuf {
    let description = catalogue::robot(source.robot).expect("a robot of the catalogue");
    let (functions, name) = (vec![source.wanted], Some(source.name.into()));
    let inverse = Default::default();
    let options = PackageOptions {
        language,
        functions,
        inverse,
        precision: source.precision,
        name,
        masses: None,
        loads: Default::default(),
        fixed: false,
    };
    let generated = generate(&description, &options).expect("nothing is fixed");
    let folder = out.join(format!("{}_{language:?}", source.name));
    for file in generated.files {
        let path = folder.join(&file.path);
        fs::create_dir_all(path.parent().expect("a file stands in a folder"))
            .expect("OUT_DIR can be written");
        fs::write(path, file.text).expect("OUT_DIR can be written");
    }
    folder
}

fn run(command: &mut Command) {
    let status = command.status().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    assert!(status.success(), "{command:?} failed");
}
