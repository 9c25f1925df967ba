//! Emitted C builds without a warning as C99 and C++11, and agrees with stored values.

use crate::support::{
    Sample, arm, example, folder, has_fma, hostile, is_there, program, run, small, text, write,
};
use denavit_emit::{Language, Precision};
use denavit_program::kernel;
use denavit_symbolic::Expr;
use std::process::Command;

fn compilers() -> Vec<&'static str> {
    ["gcc", "clang"].into_iter().filter(|c| is_there(c)).collect()
}

#[test]
fn the_folder_builds_and_passes_its_own_test() {
    for (kind, sample) in [("arm", arm()), ("hostile", hostile()), ("none", small(0)), ("one", small(1))] {
        for precision in [Precision::Double, Precision::Single] {
            let folder = folder(&format!("c-{kind}-{precision:?}"));
            write(&sample.library(precision), Language::C, &folder);
            for cc in compilers() {
                let architectures: &[&str] = if has_fma() { &["", "-march=x86-64-v3"] } else { &[""] };
                for architecture in architectures {
                    let arch = format!("ARCH={architecture}");
                    run(&folder, &["make", "-s", "-B", "test", &format!("CC={cc}"), "CFLAGS=-O1", &arch]);
                }
                let cxx = if cc == "gcc" { "CXX=g++" } else { "CXX=clang++" };
                run(&folder, &["make", "-s", "-B", "test-cxx", cxx, "CXXFLAGS=-O1"]);
            }
        }
    }
}

#[test]
fn the_example_of_the_header_compiles_and_fast_arithmetic_is_refused() {
    for (kind, sample) in [("arm", arm()), ("hostile", hostile()), ("none", small(0))] {
        let folder = folder(&format!("c-example-{kind}"));
        let files = write(&sample.library(Precision::Double), Language::C, &folder);
        let (header, source) = (&files[0], &files[1].path);
        let lines = example(&header.text, " * ");
        assert!(lines.lines().count() > 2, "{lines}");
        let main = format!("#include \"{}\"\nint main(void)\n{{\n{lines}    return 0;\n}}\n", header.path);
        std::fs::write(folder.join("example.c"), main).expect("written");
        for cc in compilers() {
            let words = [cc, "-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", "example.c", source, "-lm"];
            run(&folder, &[&words[..], &["-ffp-contract=off", "-o", "example"]].concat());
            run(&folder, &["./example"]);
            let fast = Command::new(cc).args(["-Ofast", "-c", source]).current_dir(&folder).output();
            let fast = fast.expect("a compiler");
            assert!(!fast.status.success());
            assert!(String::from_utf8_lossy(&fast.stderr).contains("remove roundings"));
        }
    }
}

#[test]
fn names_are_those_of_the_formulas_or_say_whose_they_are() {
    let sample = small(1);
    let files = crate::support::write(&sample.library(Precision::Double), Language::C, &folder("c-names"));
    let source = text(&files, "x_test.c");
    for wanted in ["s1, c1;", "s_al6, c_al6;", "const double L = parameters->L;"] {
        assert!(source.contains(wanted), "{wanted}\n{source}");
    }
    let paths: Vec<&str> = files.iter().map(|f| f.path.as_str()).collect();
    assert_eq!(paths, ["x_test.h", "x_test.c", "test_x_test.c", "Makefile"]);
    assert!(text(&files, "Makefile").lines().take_while(|l| l.starts_with('#')).count() < 6);
    let hostile = hostile();
    let files = crate::support::write(&hostile.library(Precision::Double), Language::C, &folder("c-names"));
    assert!(files[0].text.contains("const_2: the symbol const; "), "{}", files[0].text);
}

/// The embedded routines have the bits of this crate's, so that its error bounds hold for them.
#[test]
fn embedded_routines_have_the_bits_of_the_kernels() {
    let [x, y] = ["x", "y"].map(Expr::symbol);
    let outputs = [("s", x.sin()), ("c", x.cos()), ("a", y.atan2(x))];
    let sample = Sample {
        name: "routines",
        variables: vec!["x", "y"],
        parameters: vec![],
        programs: vec![("all", "values", vec![3], program(&["x", "y"], &[], &outputs))],
        configurations: vec![vec![0.5, 0.25]],
    };
    let points: Vec<[f64; 2]> = (0..640)
        .map(|k| {
            let t = f64::from(k);
            [(t * 0.7).sin() * 10_f64.powf(t / 110.0), (t * 1.3 - 200.0) / 64.0]
        })
        .collect();
    for precision in [Precision::Double, Precision::Single] {
        let folder = folder(&format!("c-bits-{precision:?}"));
        write(&sample.library(precision), Language::C, &folder);
        let (real, print) = match precision {
            Precision::Double => ("double", "%.17g"),
            Precision::Single => ("float", "%.9g"),
        };
        let list: String = points.iter().map(|p| format!("    {{{:?}, {:?}}},\n", p[0], p[1])).collect();
        let text = format!(
            "#include \"routines.h\"\n#include <stdio.h>\nstatic const double points[][2] = {{\n{list}}};\n\
             int main(void)\n{{\n    {real} q[128], out[192];\n    for (int b = 0; b < 10; b++) {{\n        \
             for (int i = 0; i < 64; i++) {{\n            q[i] = ({real})points[64 * b + i][0];\n            \
             q[64 + i] = ({real})points[64 * b + i][1];\n        }}\n        routines_all_block(q, out);\n        \
             for (int i = 0; i < 64; i++) {{\n            printf(\"{print} {print} {print}\\n\", (double)out[i], \
             (double)out[64 + i], (double)out[128 + i]);\n        }}\n    }}\n    return 0;\n}}\n"
        );
        std::fs::write(folder.join("bits.c"), text).expect("written");
        for cc in compilers() {
            for fused in if has_fma() { &[false, true][..] } else { &[false] } {
                let flag = if *fused { "-march=x86-64-v3" } else { "-DROUTINES_STRICT" };
                let words = [
                    cc,
                    "-std=c99",
                    "-O3",
                    "-ffp-contract=off",
                    flag,
                    "routines.c",
                    "bits.c",
                    "-lm",
                    "-o",
                    "bits",
                ];
                run(&folder, &words);
                let printed = run(&folder, &["./bits"]);
                for (line, [x, y]) in printed.lines().zip(&points) {
                    let number = |word: &str| match precision {
                        Precision::Double => word.parse().expect("a number"),
                        Precision::Single => f64::from(word.parse::<f32>().expect("a number")),
                    };
                    let got: Vec<f64> = line.split(' ').map(number).collect();
                    let expected = match precision {
                        Precision::Double => {
                            let (s, c) =
                                pick(*fused, || kernel::sin_cos::<true>(*x), || kernel::sin_cos::<false>(*x));
                            [
                                s,
                                c,
                                pick(
                                    *fused,
                                    || kernel::atan2::<true>(*y, *x),
                                    || kernel::atan2::<false>(*y, *x),
                                ),
                            ]
                        }
                        Precision::Single => {
                            let (x, y) = (*x as f32, *y as f32);
                            if x.abs() > kernel::SINCOS_LIMIT_F32 {
                                continue; // the library's
                            }
                            let (s, c) = pick(
                                *fused,
                                || kernel::sin_cos_f32::<true>(x),
                                || kernel::sin_cos_f32::<false>(x),
                            );
                            let a = pick(
                                *fused,
                                || kernel::atan2_f32::<true>(y, x),
                                || kernel::atan2_f32::<false>(y, x),
                            );
                            [s, c, a].map(f64::from)
                        }
                    };
                    assert_eq!(got, expected, "{cc} {flag} at {x:?}, {y:?}");
                }
                assert_eq!(printed.lines().count(), points.len());
            }
        }
    }
}

fn pick<T>(fused: bool, yes: impl Fn() -> T, no: impl Fn() -> T) -> T {
    if fused { yes() } else { no() }
}
