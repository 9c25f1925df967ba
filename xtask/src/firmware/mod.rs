//! Generated C as firmware: for a Cortex-M7 it is compiled, weighed and run in qemu, which counts instructions; cppcheck and clang-tidy
//! read it. In Rust it is compiled for the same processor.

use crate::languages::{install_missing, quietly};
use crate::{command, program, scratch};
use anyhow::{Context, Result, bail, ensure};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// An arm with what its functions may take: code and constants, and stack, bytes.
struct Arm {
    name: &'static str,
    most_code: u64,
    most_stack: u64,
    /// Random configurations that are tried.
    count: usize,
}

/// By formulas, by formulas with a given joint, and by elimination.
const ARMS: &[Arm] = &[
    Arm { name: "ur5", most_code: 40_000, most_stack: 6_500, count: 500 },
    Arm { name: "franka-panda", most_code: 60_000, most_stack: 16_000, count: 100 },
    Arm { name: "fanuc-crx10ia-l", most_code: 90_000, most_stack: 16_000, count: 50 },
];
const CORE: &[&str] = &["-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=hard", "-mthumb"];
const FLAGS: &[&str] = &["-std=c99", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-pedantic"];
/// What clang-tidy looks for. Parameters of one type beside each other, and sums of products of small numbers, are no mistakes.
const CHECKS: &str = "-*,bugprone-*,cert-*,clang-analyzer-*,misc-*,portability-*,\
     -bugprone-easily-swappable-parameters,-bugprone-implicit-widening-of-multiplication-result";

/// Builds, runs and prints a table.
///
/// # Errors
/// If something is missing, does not build, is remarked on, or takes more than it may.
pub fn run() -> Result<()> {
    install_missing(&[
        ("arm-none-eabi-gcc", &["gcc-arm-none-eabi", "libnewlib-arm-none-eabi"]),
        ("qemu-system-arm", &["qemu-system-arm"]),
        ("cppcheck", &["cppcheck"]),
        ("clang-tidy", &["clang-tidy"]),
    ])?;
    let program = program()?;
    let root = scratch()?.join("firmware");
    let mut table = String::from(
        "| arm | function | instructions, mean | most | stack, bytes | code, bytes |\n|---|---|---:|---:|---:|---:|\n",
    );
    let mut beyond = vec![];
    for arm in ARMS {
        let folder = root.join(arm.name);
        fs::create_dir_all(&folder)?;
        let mut generate = command(&program);
        generate.args([
            "generate",
            arm.name,
            "--language",
            "c",
            "--fixed",
            "--name",
            "arm",
            "--force",
            "--output",
        ]);
        quietly(generate.arg(&folder))?;
        read(&folder)?;
        let code = compiled(&folder)?;
        rust(&program, arm.name, &root)?;
        for measured in ran(arm, &folder)? {
            let [name, mean, most, stack] = &measured[..] else {
                bail!("four words a function: {measured:?}")
            };
            let bytes: u64 = stack.parse()?;
            if bytes > arm.most_stack {
                beyond.push(format!(
                    "{}: {name} takes {bytes} bytes of stack ({} allowed)",
                    arm.name, arm.most_stack
                ));
            }
            table += &format!("| {} | {name} | {mean} | {most} | {stack} | {code} |\n", arm.name);
        }
        if code > arm.most_code {
            beyond.push(format!("{}: {code} bytes of code ({} allowed)", arm.name, arm.most_code));
        }
    }
    println!("{table}");
    ensure!(beyond.is_empty(), "{}", beyond.join("\n"));
    Ok(())
}

/// What readers of C remark.
fn read(folder: &Path) -> Result<()> {
    let mut cppcheck = Command::new("cppcheck");
    cppcheck.args([
        "--enable=warning,style,performance,portability",
        "--std=c99",
        "--error-exitcode=1",
        "--quiet",
    ]);
    // It takes the smaller of two numbers for the first of them.
    cppcheck.args(["--suppress=missingIncludeSystem", "--suppress=knownConditionTrueFalse", "arm.c"]);
    quietly(cppcheck.current_dir(folder))?;
    let mut tidy = Command::new("clang-tidy");
    tidy.args([
        "--quiet",
        "--warnings-as-errors=*",
        &format!("--checks={CHECKS}"),
        "arm.c",
        "--",
        "-std=c99",
    ]);
    quietly(tidy.current_dir(folder))
}

/// Compiles the functions; how many bytes of code and constants they are.
fn compiled(folder: &Path) -> Result<u64> {
    let mut gcc = Command::new("arm-none-eabi-gcc");
    quietly(gcc.args(CORE).args(FLAGS).args(["-c", "arm.c"]).current_dir(folder))?;
    let mut size = Command::new("arm-none-eabi-size");
    let printed = size.arg("arm.o").current_dir(folder).output()?;
    let text = String::from_utf8_lossy(&printed.stdout).into_owned();
    let row = text.lines().nth(1).context("a row of sizes")?;
    let numbers: Vec<u64> = row.split_whitespace().take(3).filter_map(|w| w.parse().ok()).collect();
    let [code, data, zeros] = numbers[..] else { bail!("sizes: {text}") };
    ensure!(data == 0 && zeros == 0, "the functions have variables of their own: {text}");
    Ok(code)
}

/// Compiles the package in Rust for the same processor, without the standard library.
fn rust(program: &Path, arm: &str, root: &Path) -> Result<()> {
    const TARGET: &str = "thumbv7em-none-eabihf";
    quietly(command("rustup").args(["target", "add", TARGET]))?;
    let folder = root.join("rust").join(arm);
    let mut generate = command(program);
    generate.args(["generate", arm, "--language", "rust", "--fixed", "--force", "--output"]);
    quietly(generate.arg(&folder))?;
    // A package of its own, wherever the folder lies.
    fs::write(root.join("rust/Cargo.toml"), "[workspace]\nresolver = \"3\"\nmembers = [\"*\"]\n")?;
    let mut cargo = crate::cargo();
    cargo.args(["build", "--release", "--quiet", "--offline", "--no-default-features", "--target", TARGET]);
    quietly(cargo.env("CARGO_TARGET_DIR", root.join("rust-target")).current_dir(&folder))
}

/// Runs the firmware; for each function its name, instructions in the mean and at most, and bytes of stack.
fn ran(arm: &Arm, folder: &Path) -> Result<Vec<Vec<String>>> {
    let header = fs::read_to_string(folder.join("arm.h"))?;
    let given = if header.contains("const double given[") { "&q[JOINTS - 1], " } else { "" };
    let board = include_str!("board.c")
        .replace("@name@", "arm")
        .replace("@NAME@", "ARM")
        .replace("@given@", given)
        .replace("@count@", &arm.count.to_string());
    fs::write(folder.join("board.c"), board)?;
    fs::write(folder.join("link.ld"), include_str!("link.ld"))?;
    let mut gcc = Command::new("arm-none-eabi-gcc");
    gcc.args(CORE).args(["-std=c11", "-O2", "--specs=rdimon.specs", "-nostartfiles", "-T", "link.ld"]);
    quietly(gcc.args(["arm.o", "board.c", "-lm", "-o", "arm.elf"]).current_dir(folder))?;
    let mut qemu = Command::new("timeout");
    qemu.args(["300", "qemu-system-arm", "-M", "mps2-an500", "-nographic", "-icount", "shift=0"]);
    qemu.args(["-semihosting-config", "enable=on,target=native", "-kernel", "arm.elf"]);
    let printed = qemu.stdin(Stdio::null()).current_dir(folder).output().context("qemu does not start")?;
    let text = String::from_utf8_lossy(&printed.stdout).into_owned();
    let said = String::from_utf8_lossy(&printed.stderr);
    ensure!(printed.status.success(), "qemu: {} {text}{said}", printed.status);
    let lines: Vec<Vec<String>> =
        text.lines().map(|line| line.split_whitespace().map(str::to_string).collect()).collect();
    ensure!(lines.len() == 4, "the firmware printed {text}{said}");
    Ok(lines)
}
