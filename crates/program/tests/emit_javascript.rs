//! Emitted JavaScript runs, and computes what it should.

mod emitted;

use denavit_program::emit::Language;

#[test]
fn javascript_tests_itself() {
    if !emitted::has(&["node", "--version"]) {
        return;
    }
    emitted::run_all(Language::JavaScript, 100, |_| ["node", "--test"].map(String::from).to_vec());
}
