//! Emitted MATLAB runs in Octave, and computes what it should.

use crate::support::{example, folder, only, run, small, text, write};
use denavit_emit::{Language, Precision};

#[test]
fn matlab_tests_itself() {
    if !crate::emitted::has(&["octave", "--version"]) {
        return;
    }
    crate::emitted::run_all(Language::Matlab, 100, |files| {
        let test = crate::emitted::file_name(files, "test_", ".m");
        ["octave", "--no-gui", "--quiet", "--norc", &test].map(String::from).to_vec()
    });
}

#[test]
fn few_variables_and_the_example() {
    if !crate::emitted::has(&["octave", "--version"]) {
        return;
    }
    for n in [0, 1] {
        let folder = folder(&format!("matlab-{n}"));
        let files = write(&small(n).library(Precision::Double), Language::Matlab, &folder);
        let test = only(&files, "test_", ".m");
        let said = run(&folder, &["octave", "--no-gui", "--quiet", "--norc", &test]);
        assert!(said.starts_with("x_test: all configurations agree\n"), "{said}");
        let lines = example(text(&files, "x_test_fixed.m"), "% ");
        assert!(lines.contains("x_test_fixed(q, parameters)"), "{lines}");
        run(&folder, &["octave", "--no-gui", "--quiet", "--norc", "--eval", &lines]);
    }
}
