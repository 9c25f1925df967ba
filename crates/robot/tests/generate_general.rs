//! Generated inverse kinematics by elimination: built, and run on its own vectors.

use denavit::generate::{Generated, Options, Wanted, generate};
use denavit::inverse::{self, Goal};
use denavit::{catalogue, description};
use denavit_program::emit::{Language, Precision};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Strict C, as C programmers who ship it have it.
const STRICT: &str = "-O2 -Wall -Wextra -Werror -pedantic -std=c99 -ffp-contract=off";
/// One prismatic joint among oblique axes.
const ONE_SLIDE: &str = include_str!("generated/one-slide.toml");
/// Two of them.
const TWO_SLIDES: &str = include_str!("generated/two-slides.toml");

fn generated(text: &str, language: Language, functions: &[Wanted]) -> Generated {
    let d = description::read_toml(text).expect("it can be read").0;
    let options = Options {
        language,
        functions: functions.to_vec(),
        inverse: inverse::Options { goal: Goal::Pose, given: None },
        precision: Precision::Double,
        name: Some("arm".into()),
        fixed: false,
    };
    generate(&d, &options).expect("nothing is fixed")
}

fn catalogued(name: &str) -> &'static str {
    catalogue::text(name).expect("the catalogue has it")
}

/// A folder of its own with the files.
fn folder(name: &str, generated: &Generated) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    for file in &generated.files {
        let path = folder.join(&file.path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("it can be made");
        fs::write(path, &file.text).expect("it can be written");
    }
    folder
}

fn run(command: &mut Command) {
    let output = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    let words = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{command:?}\n{}", words.concat());
}

/// Both functions and the inverse one alone, as C.
fn check_c(name: &str, text: &str, least: usize) {
    for (suffix, functions) in [("both", &[Wanted::Pose, Wanted::Inverse][..]), ("alone", &[Wanted::Inverse])]
    {
        let found = generated(text, Language::C, functions);
        let inverse = found.inverse.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", found.refused));
        assert!(inverse.by_elimination && inverse.vectors >= least, "{name}: {} poses", inverse.vectors);
        let target = folder(&format!("elimination-c-{name}-{suffix}"), &found);
        run(Command::new("make").arg("test").arg(format!("CFLAGS={STRICT}")).current_dir(target));
    }
}

fn check_rust(name: &str, text: &str, least: usize) {
    let found = generated(text, Language::Rust, &[Wanted::Pose, Wanted::Inverse]);
    let inverse = found.inverse.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", found.refused));
    assert!(inverse.by_elimination && inverse.vectors >= least, "{name}: {} poses", inverse.vectors);
    let target = folder(&format!("elimination-rust-{name}"), &found);
    // A workspace of its own: the folder lies in that of this package.
    let manifest = target.join("Cargo.toml");
    let text = fs::read_to_string(&manifest).expect("it is there") + "\n[workspace]\n";
    fs::write(&manifest, text).expect("it can be written");
    let cargo = |arguments: &[&str]| {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(arguments).current_dir(&target).env("RUSTFLAGS", "-D warnings");
        cargo.env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("elimination-rust-target"));
        run(&mut cargo);
    };
    cargo(&["test", "--quiet", "--offline"]);
    cargo(&["build", "--quiet", "--offline", "--no-default-features"]);
}

#[test]
fn c_finds_all_solutions() {
    check_c("crx", catalogued("fanuc-crx10ia-l"), 15);
    check_c("oblique", catalogued("oblique-6r"), 15);
    check_c("one-slide", ONE_SLIDE, 12);
}

#[test]
fn rust_finds_all_solutions() {
    check_rust("crx", catalogued("fanuc-crx10ia-l"), 15);
    check_rust("oblique", catalogued("oblique-6r"), 15);
    check_rust("two-slides", TWO_SLIDES, 8);
}

/// What is generated in no other language, and what C does not serve, is said.
#[test]
fn what_is_not_generated_is_said() {
    let functions = [Wanted::Pose, Wanted::Inverse];
    for language in [Language::Python, Language::Matlab, Language::JavaScript, Language::Cuda] {
        let found = generated(catalogued("oblique-6r"), language, &functions);
        let why = found.refused.expect("a reason");
        assert!(found.inverse.is_none() && why.contains("in C and Rust"), "{why}");
    }
    let why = generated(TWO_SLIDES, Language::C, &functions).refused.expect("a reason");
    assert!(why.contains("at most one prismatic joint"), "{why}");
}
