//! Emitted JavaScript runs, and computes what it should.

mod emit_support;
mod emitted;

use denavit_program::emit::{Language, Precision};
use emit_support::{example, folder, run, small, text, write};

#[test]
fn javascript_tests_itself() {
    if !emitted::has(&["node", "--version"]) {
        return;
    }
    emitted::run_all(Language::JavaScript, 100, |_| ["node", "--test"].map(String::from).to_vec());
}

#[test]
fn few_variables_and_the_example() {
    if !emitted::has(&["node", "--version"]) {
        return;
    }
    for n in [0, 1] {
        let folder = folder(&format!("javascript-{n}"));
        let files = write(&small(n).library(Precision::Double), Language::JavaScript, &folder);
        run(&folder, &["node", "--test"]);
        let lines = example(text(&files, "test_x.js"), "// ");
        assert!(lines.contains("fixedBatch("), "{lines}");
        std::fs::write(folder.join("example.js"), lines).expect("written");
        run(&folder, &["node", "example.js"]);
    }
}
