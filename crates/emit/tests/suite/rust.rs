//! Emitted Rust builds without a warning and agrees with stored values, with and without the standard library.

use crate::support::{arm, folder, has_fma, hostile, run_with, small, write};
use denavit_emit::{Language, Precision};

#[test]
fn the_package_builds_and_passes_its_own_test() {
    let samples = [("arm", arm()), ("hostile", hostile()), ("none", small(0)), ("one", small(1))];
    for (kind, sample) in samples {
        let folder = folder(&format!("rust-{kind}"));
        // The folder stands inside the workspace of this crate, to which it does not belong.
        let files = write(&sample.library(Precision::Double), Language::Rust, &folder);
        for file in &files {
            for gone in ["reduce.rs", "sincos_", "atan2_strict.rs"] {
                assert!(!file.text.contains(gone), "{}: {gone}", file.path);
            }
        }
        run_with(&folder, &[env!("CARGO"), "fmt", "--check"], &[]);
        let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
        std::fs::write(folder.join("Cargo.toml"), manifest + "\n[workspace]\n").expect("written");
        let target = folder.join("target");
        let target = target.to_str().expect("a path");
        let plain = "-D warnings";
        let fused = "-D warnings -C target-feature=+avx2,+fma";
        for flags in [plain, fused].into_iter().take(if has_fma() { 2 } else { 1 }) {
            let variables = [("RUSTFLAGS", flags), ("CARGO_TARGET_DIR", target)];
            run_with(&folder, &[env!("CARGO"), "test", "-q", "--offline"], &variables);
        }
        let variables = [("RUSTFLAGS", plain), ("CARGO_TARGET_DIR", target)];
        run_with(&folder, &[env!("CARGO"), "test", "-q", "--offline", "--no-default-features"], &variables);
    }
}
