//! Emitted Python runs, and computes what it should.

mod emitted;

use denavit_program::emit::Language;

#[test]
fn python_tests_itself() {
    if !emitted::has(&["python3", "-c", "import numpy"]) {
        return;
    }
    emitted::run_all(Language::Python, 88, |files| {
        let test = emitted::file_name(files, "test_", ".py");
        ["python3", "-B", "-W", "error", &test].map(String::from).to_vec()
    });
}
