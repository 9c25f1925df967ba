//! Emitted JavaScript runs, and computes what it should.

use crate::support::{example, folder, run, small, text, write};
use denavit_emit::{Language, Precision};

#[test]
fn javascript_tests_itself() {
    if !crate::emitted::has(&["node", "--version"]) {
        return;
    }
    crate::emitted::run_all(Language::JavaScript, 100, |_| ["node", "--test"].map(String::from).to_vec());
}

#[test]
fn few_variables_and_the_example() {
    if !crate::emitted::has(&["node", "--version"]) {
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
