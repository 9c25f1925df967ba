//! Emitted CUDA: its kernels run as C++ with one thread at a time, and compile with NVRTC where that is installed.

use crate::support::{arm, folder, hostile, is_there, only, run, small, write};
use denavit_emit::{Language, Library, Precision};
use std::path::Path;
use std::process::Command;

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
fn kernels_agree_with_stored_values_thread_by_thread() {
    let samples = [("arm", arm()), ("hostile", hostile()), ("none", small(0)), ("one", small(1))];
    for (kind, sample) in samples {
        for precision in [Precision::Double, Precision::Single] {
            let folder = folder(&format!("cuda-{kind}-{precision:?}"));
            let library = sample.library(precision);
            let files = write(&library, Language::Cuda, &folder);
            let name = files[1].path.strip_suffix(".cu").expect("kernels").to_string();
            assert_eq!(only(&files, "test_", ".py"), format!("test_{name}.py"));
            assert_eq!(files[0].text.contains("rctangents"), kind == "arm", "{kind}");
            let real = if precision == Precision::Single { "float" } else { "double" };
            std::fs::write(folder.join("emulated.cpp"), emulated(&library, &files[1].text, &name, real))
                .expect("written");
            let words = ["g++", "-std=c++14", "-O1", "-Wall", "-Wextra", "-Wno-unknown-pragmas", "-Werror"];
            let rest = ["-Wno-unused-variable", "-Wno-unused-function", "emulated.cpp", "-o", "emulated"];
            run(&folder, &[&words[..], &rest].concat());
            let printed = run(&folder, &["./emulated"]);
            let values: Vec<f64> = printed.split_whitespace().map(|w| w.parse().expect("a number")).collect();
            let expected: Vec<f64> = library
                .routines
                .iter()
                .flat_map(|r| r.vectors.iter().flat_map(|v| v.results.clone()))
                .collect();
            assert_eq!(values.len(), expected.len());
            let allowed = if precision == Precision::Single { 1e-5 } else { 1e-14 };
            for (value, expected) in values.iter().zip(&expected) {
                let scale = expected.abs().max(1.0);
                assert!((value - expected).abs() <= allowed * scale, "{kind}: {value}, expected {expected}");
            }
            compile_at_run_time(&folder, &name);
        }
    }
}

/// Each kernel on all stored configurations, side by side.
fn emulated(library: &Library, kernels: &str, name: &str, real: &str) -> String {
    let mut text = format!("{EMULATION}#include \"{name}.cu\"\nint main()\n{{\n");
    let signatures = kernels.lines().filter(|l| l.starts_with("extern \"C\" __global__"));
    for (routine, signature) in library.routines.iter().zip(signatures) {
        let function = signature.split("void ").nth(1).and_then(|s| s.split('(').next()).expect("a name");
        let (count, n) = (routine.vectors.len(), library.variables.len());
        let (m, rows) = (routine.vectors[0].results.len(), &routine.vectors);
        let list =
            |values: Vec<f64>| values.iter().map(|x| format!("({real}){x:?}")).collect::<Vec<_>>().join(", ");
        let q: Vec<f64> = (0..n).flat_map(|j| rows.iter().map(move |v| v.variables[j])).collect();
        let reads_parameters = kernels
            .split(&format!("{function}("))
            .nth(1)
            .and_then(|rest| rest.split(')').next())
            .is_some_and(|arguments| arguments.contains("_parameters "));
        let parameters = list(rows[0].parameters.clone());
        let prefix = function.rsplit_once("_kernel").expect("a kernel").0;
        let structure = format!("{name}_parameters");
        let argument =
            if reads_parameters { format!("{structure}{{{parameters}}}, ") } else { String::new() };
        text.push_str(&format!(
            "    {{ /* {prefix} */\n        static const {real} q[] = {{{}}};\n        static {real} out[{}];\n        \
             for (blockIdx.x = 0; blockIdx.x < {count} + 2; blockIdx.x++) {function}({count}, q, {argument}out);\n        \
             for (int i = 0; i < {count}; i++) for (int k = 0; k < {m}; k++) \
             std::printf(\"%.17g \", (double)out[k * {count} + i]);\n    }}\n",
            list(q),
            m * count
        ));
    }
    text + "    return 0;\n}\n"
}

/// The emitted test: 77 says that there is no compiler.
fn compile_at_run_time(folder: &Path, name: &str) {
    let python = std::env::var("DENAVIT_CUDA_PYTHON").unwrap_or("python3".into());
    if !is_there(&python) {
        return;
    }
    let output = Command::new(python)
        .arg(format!("test_{name}.py"))
        .current_dir(folder)
        .output()
        .expect("Python runs");
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(matches!(output.status.code(), Some(0 | 77)), "{text}");
}
