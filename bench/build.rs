//! Generates source code for a UR5 and compiles it, Rust with this compiler, C with gcc and clang.

use denavit::catalogue;
use denavit::description::read_toml;
use denavit::generate::{Options, Wanted, generate};
use denavit_program::emit::{Language, Precision};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

fn main() {
    println!("cargo:rerun-if-env-changed=DENAVIT_BENCH_LEVEL");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let level = env::var("DENAVIT_BENCH_LEVEL").unwrap_or_else(|_| "native".into());
    println!("cargo:rustc-env=DENAVIT_BENCH_LEVEL={level}");

    let folder = write(&out, Language::Rust, Precision::Double, "ur5_generated");
    let rustc = env::var_os("RUSTC").expect("cargo sets RUSTC");
    run(Command::new(rustc)
        .args(["--crate-type", "rlib", "--crate-name", "ur5_generated", "--edition", "2024"])
        .args(["--cfg", "feature=\"std\"", "-C", "opt-level=3", "-C", &format!("target-cpu={level}")])
        .arg(folder.join("src/lib.rs"))
        .arg("-o")
        .arg(out.join("libur5_generated.rlib")));
    println!("cargo:rustc-link-search=all={}", out.display());

    for (precision, name) in [(Precision::Double, "ur5"), (Precision::Single, "ur5f")] {
        let folder = write(&out, Language::C, precision, name);
        for compiler in ["gcc", "clang"] {
            let object = out.join(format!("{name}_{compiler}.o"));
            let mut command = Command::new(compiler);
            command.args(["-std=c99", "-O3", "-fPIC", "-ffp-contract=off", &format!("-march={level}")]);
            // The same file twice in one program: each compiler's functions get names of their own.
            for symbol in ["fk", "fk_block", "defaults"] {
                command.arg(format!("-D{name}_{symbol}={name}_{symbol}_{compiler}"));
            }
            run(command.arg("-c").arg(folder.join(format!("{name}.c"))).arg("-o").arg(&object));
            let archive = out.join(format!("lib{name}_{compiler}.a"));
            let _ = fs::remove_file(&archive);
            run(Command::new("ar").arg("rcs").arg(&archive).arg(&object));
            println!("cargo:rustc-link-lib=static={name}_{compiler}");
        }
    }
    println!("cargo:rustc-link-lib=m");
}

fn write(out: &Path, language: Language, precision: Precision, name: &str) -> PathBuf {
    let text = catalogue::text("ur5").expect("the catalogue has a UR5");
    let (description, _) = read_toml(text).unwrap_or_else(|_| panic!("the catalogue's UR5 can be read"));
    let options =
        Options { language, functions: vec![Wanted::Pose], precision, name: Some(name.into()), fixed: false };
    let generated = generate(&description, &options).expect("a UR5 can be generated");
    let folder = out.join(format!("{name}_{language:?}"));
    for file in generated.files {
        let path = folder.join(&file.path);
        fs::create_dir_all(path.parent().expect("a file stands in a folder")).expect("OUT_DIR can be written");
        fs::write(path, file.text).expect("OUT_DIR can be written");
    }
    folder
}

fn run(command: &mut Command) {
    let status = command.status().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    assert!(status.success(), "{command:?} failed");
}
