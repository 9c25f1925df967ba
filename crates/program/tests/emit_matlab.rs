//! Emitted MATLAB runs in Octave, and computes what it should.

mod emitted;

use denavit_program::emit::Language;

#[test]
fn matlab_tests_itself() {
    if !emitted::has(&["octave", "--version"]) {
        return;
    }
    emitted::run_all(Language::Matlab, 100, |files| {
        let test = emitted::file_name(files, "test_", ".m");
        ["octave", "--no-gui", "--quiet", "--norc", &test].map(String::from).to_vec()
    });
}
