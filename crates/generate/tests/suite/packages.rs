//! Packages that tests generate: with what options, where they are written, and commands that succeed.

use denavit::dynamics::Loads;
use denavit::inverse::{Goal, InverseOptions};
use denavit_emit::{File, Language, Precision};
use denavit_generate::{PackageOptions, Wanted};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Functions in a language, called `arm`: for poses, in double precision, parameters as arguments.
pub fn options(language: Language, functions: &[Wanted]) -> PackageOptions {
    PackageOptions {
        language,
        functions: functions.to_vec(),
        inverse: InverseOptions { goal: Goal::Pose, given: None },
        precision: Precision::Double,
        name: Some("arm".into()),
        masses: None,
        loads: Loads::default(),
        fixed: false,
    }
}

/// A folder of its own with the files, and with nothing else.
pub fn folder(name: &str, files: &[File]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    write(&folder, files);
    folder
}

/// Writes files into a folder that has nothing else.
pub fn write(folder: &Path, files: &[File]) {
    let _ = fs::remove_dir_all(folder);
    for file in files {
        let path = folder.join(&file.path);
        fs::create_dir_all(path.parent().expect("it is in a folder")).expect("it can be made");
        fs::write(path, &file.text).expect("it can be written");
    }
}

/// Runs a command, which must succeed; what it prints.
pub fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    let [out, error] = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{command:?}\n{out}{error}");
    out
}
