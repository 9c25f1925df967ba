//! What generated inverse kinematics takes of the stack: the deepest chain of calls, by what gcc says of each function.

use crate::packages;
use denavit::{Description, catalogue};
use denavit_emit::Language;
use denavit_generate::{Wanted, generate};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::Command;

/// The compilers, each with what its processor is.
const COMPILERS: [&[&str]; 2] =
    [&["gcc", "-O2"], &["arm-none-eabi-gcc", "-O2", "-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=hard"]];

/// Functions with their frames (bytes; none where the compiler does not know one), and what they call.
#[derive(Default)]
struct Calls {
    frames: BTreeMap<String, usize>,
    called: BTreeMap<String, BTreeSet<String>>,
}

impl Calls {
    /// Reads what `-fcallgraph-info=su` writes.
    fn read(text: &str) -> Calls {
        let mut calls = Calls::default();
        let quoted = |line: &str, key: &str| {
            let (_, rest) = line.split_once(&format!("{key}: \""))?;
            Some(rest.split_once('"')?.0.to_string())
        };
        for line in text.lines() {
            if let (Some(from), Some(to)) = (quoted(line, "sourcename"), quoted(line, "targetname")) {
                calls.called.entry(from).or_default().insert(to);
            } else if let (Some(title), Some(label)) = (quoted(line, "title"), quoted(line, "label")) {
                // `name\nfile:line:column\n64 bytes (static)`; what is called and not in the file has no size.
                let Some(size) = label.rsplit("\\n").find(|part| part.contains(" bytes (")) else { continue };
                assert!(size.ends_with("(static)"), "{label}: a frame of a size that is not known");
                let bytes = size.split(' ').next().and_then(|x| x.parse().ok()).expect("a number of bytes");
                calls.frames.insert(title, bytes);
            }
        }
        calls
    }

    /// The bytes of the deepest chain from a function, and the functions in it.
    fn deepest<'a>(&'a self, name: &'a str, above: &mut Vec<&'a str>) -> (usize, Vec<&'a str>) {
        assert!(!above.contains(&name), "{name} calls itself: {above:?}");
        above.push(name);
        let below = self.called.get(name).into_iter().flatten();
        let (bytes, mut chain) = below.map(|next| self.deepest(next, above)).max().unwrap_or_default();
        above.pop();
        chain.insert(0, name);
        (bytes + self.frames.get(name).copied().unwrap_or(0), chain)
    }
}

/// Chains from functions stay within bounds (bytes).
fn check(name: &str, d: &Description, bounds: &[(&str, usize)]) {
    let options = packages::options(Language::C, &[Wanted::Inverse]);
    let generated = generate(d, &options).expect("nothing is fixed");
    let folder = packages::folder(&format!("stack-{name}"), &generated.files);
    for compiler in COMPILERS {
        let Ok(version) = Command::new(compiler[0]).arg("--version").output() else { continue };
        // What is called gcc may be another compiler.
        if !String::from_utf8_lossy(&version.stdout).contains("Free Software Foundation") {
            continue;
        }
        let flags = ["-std=c99", "-ffp-contract=off", "-fcallgraph-info=su", "-c", "arm.c", "-o", "arm.o"];
        packages::run(Command::new(compiler[0]).args(&compiler[1..]).args(flags).current_dir(&folder));
        let calls = Calls::read(&fs::read_to_string(folder.join("arm.ci")).expect("it is written"));
        for (function, bound) in bounds {
            let (bytes, chain) = calls.deepest(function, &mut vec![]);
            println!("{name}, {}: {function} {bytes}", compiler[0]);
            assert!(bytes <= *bound, "{name}, {compiler:?}: {bytes} bytes of stack: {chain:?}");
            // A chain that ends where it starts would be within any bound.
            assert!(chain.len() > 2 && bytes > 400, "{name}, {compiler:?}: {bytes} bytes: {chain:?}");
        }
    }
}

#[test]
fn a_closed_form_takes_little_stack() {
    let bounds = [
        ("arm_solve", 1_500),
        ("arm_ik", 5_000),
        ("arm_ik_nearest", 6_500),
        ("arm_ik_all_within_limits", 6_500),
    ];
    check("ur5", &catalogue::robot("ur5").expect("the catalogue has it"), &bounds);
}

#[test]
fn elimination_takes_what_firmware_has() {
    let bounds = [
        ("arm_solve", 11_500),
        ("arm_ik", 13_500),
        ("arm_ik_nearest", 16_000),
        ("arm_ik_all_within_limits", 16_000),
    ];
    check("crx", &catalogue::robot("fanuc-crx10ia-l").expect("the catalogue has it"), &bounds);
}
