//! Emitted solvers build without a warning, and find all solutions in every language.

use crate::solver_support::samples;
use crate::support::{check_rust, folder, has_fma, is_there, only, run, write};
use denavit_emit::{Language, Precision};

#[test]
fn c_finds_all_solutions() {
    for (k, sample) in samples().iter().enumerate() {
        for precision in [Precision::Double, Precision::Single] {
            let folder = folder(&format!("solver-c-{k}-{precision:?}"));
            let mut library = sample.library();
            library.precision = precision;
            if precision == Precision::Single {
                // Parameters are rounded to single precision.
                library.solvers[0].vectors.truncate(3);
                library.solvers[0].vectors.iter_mut().for_each(|v| v.tolerance = 1e-4);
                if !sample.parameters.is_empty() {
                    continue;
                }
            }
            let files = write(&library, Language::C, &folder);
            if k == 0 {
                let count = |end: &str| {
                    files.iter().filter(|f| f.path == end).map(|f| f.text.lines().count()).sum::<usize>()
                };
                assert!(count("ur5.c") + count("ur5.h") < 1000);
            }
            for cc in ["gcc", "clang"].into_iter().filter(|c| is_there(c)) {
                let arch = if has_fma() { "ARCH=-march=x86-64-v3" } else { "ARCH=" };
                run(&folder, &["make", "-s", "-B", "test", &format!("CC={cc}"), "CFLAGS=-O1", arch]);
                let cxx = if cc == "gcc" { "CXX=g++" } else { "CXX=clang++" };
                run(&folder, &["make", "-s", "-B", "test-cxx", cxx, "CXXFLAGS=-O1"]);
            }
        }
    }
}

#[test]
fn rust_finds_all_solutions_alone_and_in_blocks() {
    let folder = folder("solver-rust");
    let members: Vec<String> = (0..samples().len()).map(|k| format!("sample-{k}")).collect();
    for (k, (sample, member)) in samples().iter().zip(&members).enumerate() {
        let mut library = sample.library();
        // In a workspace no two packages have one name.
        library.name += &format!(" {k}");
        write(&library, Language::Rust, &folder.join(member));
    }
    check_rust(&folder, &members);
}

#[test]
fn interpreted_languages_find_all_solutions() {
    let python = std::env::var("DENAVIT_PYTHON").unwrap_or("python3".into());
    let has = |words: &[&str]| {
        std::process::Command::new(words[0]).args(&words[1..]).output().is_ok_and(|o| o.status.success())
    };
    for (k, sample) in samples().iter().enumerate() {
        let library = sample.library();
        let in_folder = |language: Language| {
            let folder = folder(&format!("solver-{}-{k}", language.name()));
            let files = write(&library, language, &folder);
            (folder, files)
        };
        let (there, _) = in_folder(Language::JavaScript);
        if has(&["node", "--version"]) {
            run(&there, &["node", "--test"]);
        }
        let (there, files) = in_folder(Language::Python);
        assert!(files.iter().flat_map(|f| f.text.lines()).all(|line| line.chars().count() <= 88));
        if has(&[&python, "-c", "import numpy"]) {
            run(&there, &[&python, "-B", "-W", "error", &only(&files, "test_", ".py")]);
        }
        let (there, files) = in_folder(Language::Matlab);
        if has(&["octave", "--version"]) {
            let test = only(&files, "test_", ".m");
            let said = run(&there, &["octave", "--no-gui", "--quiet", "--norc", &test]);
            assert!(said.contains("all configurations agree"), "{said}");
        }
    }
}

/// What the compiler of CUDA knows by itself, for a compiler of C++.
const EMULATION: &str = "\
#include <cmath>
#include <cstdio>
#include <cstddef>
#define __device__
#define __host__
#define __global__
struct index { unsigned x; };
static index blockIdx, blockDim = {1}, threadIdx;
";

#[test]
fn cuda_finds_all_solutions_thread_by_thread() {
    for (k, sample) in samples().iter().enumerate() {
        let folder = folder(&format!("solver-cuda-{k}"));
        let library = sample.library();
        let files = write(&library, Language::Cuda, &folder);
        let name = files[1].path.strip_suffix(".cu").expect("kernels").to_string();
        let solver = &library.solvers[0];
        let (rows, n, m) = (&solver.vectors, solver.solver.variables.len(), solver.solver.outputs.len());
        let (count, width) = (rows.len(), 2 + solver.solver.max_solutions() * (m + 4));
        let mut signatures = files[1].text.lines().filter(|l| l.starts_with("extern \"C\""));
        let signature = signatures.next_back().expect("a kernel");
        let function = signature.split("void ").nth(1).and_then(|s| s.split('(').next()).expect("a name");
        let list = |values: Vec<f64>| values.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(", ");
        let given = list((0..n).flat_map(|j| rows.iter().map(move |v| v.variables[j])).collect());
        let parameters = match sample.parameters.is_empty() {
            true => String::new(),
            false => format!("{name}_parameters{{{}}}, ", list(rows[0].parameters.clone())),
        };
        let main = format!(
            "{EMULATION}#include \"{name}.cu\"\nint main()\n{{\n    static const double given[] = {{{given}}};\n    \
             static double out[{}];\n    for (blockIdx.x = 0; blockIdx.x < {count} + 2; blockIdx.x++)\n        \
             {function}({count}, given, {parameters}out);\n    for (int i = 0; i < {count}; i++)\n        \
             for (int k = 0; k < {width}; k++) std::printf(\"%.17g \", out[k * {count} + i]);\n    return 0;\n}}\n",
            width * count
        );
        std::fs::write(folder.join("emulated.cpp"), main).expect("written");
        let words = ["g++", "-std=c++14", "-O1", "-Wall", "-Wextra", "-Wno-unknown-pragmas", "-Werror"];
        run(&folder, &[&words[..], &["emulated.cpp", "-o", "emulated"]].concat());
        let printed = run(&folder, &["./emulated"]);
        let values: Vec<f64> = printed.split_whitespace().map(|w| w.parse().expect("a number")).collect();
        for (v, values) in rows.iter().zip(values.chunks(width)) {
            assert_eq!(values[0] as usize, v.solutions.len());
            assert_eq!(values[1] as usize, v.certificate.code(), "{name}");
            for known in &v.solutions {
                let is_it = |found: &[f64]| {
                    let near = |(k, a): (usize, &f64)| {
                        let apart = (a - known.results[k]).abs();
                        let turns = (apart / std::f64::consts::TAU).round();
                        let is_angle = solver.solver.angles[k];
                        (apart - if is_angle { std::f64::consts::TAU * turns } else { 0.0 }).abs()
                            <= v.tolerance
                    };
                    found[..m].iter().enumerate().all(near)
                        && found[m] <= 1e-9
                        && found[m + 1] == f64::from(known.multiplicity)
                        && found[m + 3] == f64::from(known.free)
                };
                assert!(values[2..].chunks(m + 4).take(values[0] as usize).any(is_it), "{name}: {known:?}");
            }
        }
        std::fs::write(folder.join("played.py"), played(&name, &values, width)).expect("written");
        if is_there("python3") {
            run(&folder, &["python3", "played.py"]);
        }
    }
}

/// The test that is emitted for machines with a GPU, with the values of the emulated kernel for those of a device: it finds
/// nothing wrong, and what is made wrong.
fn played(name: &str, values: &[f64], width: usize) -> String {
    let rows: Vec<String> = values.chunks(width).map(|row| format!("{row:?}")).collect();
    let rows = rows.join(",\n    ").replace("NaN", "float('nan')").replace("inf", "float('inf')");
    format!("import test_{name} as test\n\nROWS = [\n    {rows}\n]\n") + include_str!("played.py.txt")
}
