//! The C library: its header held to its source, its examples in C, C++ and Go built by the lines that the page prints, its tests run.

mod header;

use crate::languages::{apt, quietly};
use crate::steps::SKIPPED;
use crate::{cargo, command, languages, path, scratch, succeed, target};
use anyhow::{Context, Result, bail};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

pub use header::HEADER;

/// The page with the lines that build and run the examples.
const PAGE: &str = "docs/c.md";
/// What the program of the tests is compiled with: leaks, what is freed twice, and what C itself does wrong end it.
const STRICT: &str = "-std=c99 -O1 -g -Wall -Wextra -Werror -pedantic -fsanitize=address,undefined";
/// What headers are compiled with in C++.
const STRICT_CPP: &str = "-O1 -Wall -Wextra -Werror -pedantic -Wno-unused-function";

/// Renews the header.
///
/// # Errors
/// If something in the source is not understood.
pub fn write() -> Result<()> {
    header::check(true).map(drop)
}

/// Builds the library beside the program, and everything that calls it; runs that.
///
/// # Errors
/// If something does not build or agree.
pub fn test() -> Result<()> {
    let functions = header::check(false)?;
    languages::install()?;
    // As the program is built, so that both take the same libraries.
    let arguments = ["build", "--quiet", "--locked", "--workspace", "--lib", "--bins", "--examples"];
    succeed(cargo().args(arguments))?;
    let built = target().join("debug");
    if cfg!(target_os = "linux") {
        symbols(&built.join("libdenavit.so"), &functions)?;
    }
    let folder = scratch()?.join("c");
    fs::create_dir_all(&folder)?;
    against(&built, &folder)?;
    let skipped = examples(&built, &folder)?;
    println!("{} functions of C; examples print what the library does", functions.len());
    skipped.iter().for_each(|why| println!("{SKIPPED}{why}"));
    Ok(())
}

/// The library lets see the functions of the header, and nothing else.
fn symbols(library: &Path, functions: &[String]) -> Result<()> {
    let output = command("nm").args(["--dynamic", "--defined-only"]).arg(library).output().context("nm")?;
    let listed = String::from_utf8_lossy(&output.stdout).into_owned();
    let seen: BTreeSet<&str> = listed.lines().filter_map(|l| l.split_whitespace().last()).collect();
    let wanted: BTreeSet<&str> = functions.iter().map(String::as_str).collect();
    if let Some(name) = seen.symmetric_difference(&wanted).next() {
        bail!("{name} is in one of {} and {HEADER} only", library.display());
    }
    Ok(())
}

/// The tests in C, under the address sanitizer; the headers as C++.
fn against(built: &Path, folder: &Path) -> Result<()> {
    let vectors = command(built.join("examples/vectors")).output().context("vectors")?;
    if !vectors.status.success() {
        bail!("vectors: {}", String::from_utf8_lossy(&vectors.stderr));
    }
    let list = folder.join("vectors");
    fs::write(&list, vectors.stdout)?;
    let include = path(HEADER);
    let include = include.parent().context("a folder")?;
    let program = folder.join("against");
    let mut build = command("gcc");
    build.args(STRICT.split(' ')).arg("-I").arg(include).arg(path("crates/ffi/tests/against.c"));
    build.arg("-L").arg(built).arg(format!("-Wl,-rpath,{}", built.display()));
    quietly(build.args(["-ldenavit", "-lpthread", "-lm", "-o"]).arg(&program))?;
    quietly(command(&program).arg(&list))?;
    for (compiler, standard) in [("g++", "c++11"), ("clang++", "c++20")] {
        let mut build = command(compiler);
        build.arg(format!("-std={standard}")).args(STRICT_CPP.split(' ')).arg("-I").arg(include);
        let file = path("crates/ffi/examples/first.cpp");
        quietly(build.arg("-c").arg(file).arg("-o").arg(folder.join("first.o")))?;
    }
    Ok(())
}

/// The lines of the page that build and run the examples: each program prints what the library prints. What was not run.
fn examples(built: &Path, folder: &Path) -> Result<Vec<String>> {
    let expected = printed(&mut command(built.join("examples/first")))?;
    let page = fs::read_to_string(path(PAGE))?;
    let (mut inside, mut ran, mut skipped) = (false, 0, vec![]);
    for line in page.lines() {
        if line.starts_with("```") {
            inside = line == "```sh";
            continue;
        }
        let first = line.split_whitespace().find(|word| !word.contains('=')).unwrap_or_default();
        // What builds the library was done, as tests are built.
        if !inside || first.is_empty() || first == "cargo" || first == "#" {
            continue;
        }
        if first == "go" && !has_go() {
            skipped.push("the example in Go: there is no Go, and none could be installed".into());
            break;
        }
        let here = line.replace("$PWD/target/release", &built.to_string_lossy());
        let here = here.replace("target/release", &built.to_string_lossy());
        let here = here.replace("target/c/", &format!("{}/", folder.display()));
        let mut shell = command("sh");
        shell.args(["-e", "-c", &here]).env("GOCACHE", scratch()?.join("go")).env("GOTOOLCHAIN", "local");
        let said = printed(&mut shell).with_context(|| format!("{PAGE}: {line}"))?;
        if !said.is_empty() {
            ran += 1;
            if said != expected {
                bail!("{PAGE}: {line}\nprints\n{said}and the library prints\n{expected}");
            }
        }
    }
    if ran + skipped.len() < 4 {
        bail!("{PAGE}: {ran} examples print something, in C, C with the static library, C++ and Go");
    }
    Ok(skipped)
}

/// What a command prints.
fn printed(command: &mut Command) -> Result<String> {
    let output = command.stdin(Stdio::null()).output()?;
    if !output.status.success() {
        bail!("{}", String::from_utf8_lossy(&[output.stdout, output.stderr].concat()));
    }
    Ok(String::from_utf8(output.stdout)?)
}

/// Whether there is Go, or it can be installed.
fn has_go() -> bool {
    let starts = || {
        let mut go = command("go");
        go.arg("version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|s| s.success())
    };
    let install = || {
        println!("installing golang-go");
        apt(&["update", "-qq"])
            .and_then(|()| apt(&["install", "-y", "-qq", "--no-install-recommends", "golang-go"]))
    };
    starts() || (install().is_ok() && starts())
}
