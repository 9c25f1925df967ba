//! Emitted Rust builds without a warning and agrees with stored values, with and without the standard library.

use crate::support::{Sample, arm, check_rust, folder, hostile, small, write};
use denavit_emit::{Language, Precision};

#[test]
fn packages_build_and_pass_their_own_tests() {
    let one = Sample { name: "one", ..small(1) };
    let samples = [("arm", arm()), ("hostile", hostile()), ("none", small(0)), ("one", one)];
    let folder = folder("rust");
    for (kind, sample) in &samples {
        let files = write(&sample.library(Precision::Double), Language::Rust, &folder.join(kind));
        for file in &files {
            for gone in ["reduce.rs", "sincos_", "atan2_strict.rs"] {
                assert!(!file.text.contains(gone), "{}: {gone}", file.path);
            }
        }
    }
    check_rust(&folder, &samples.map(|(kind, _)| kind.to_string()));
}
