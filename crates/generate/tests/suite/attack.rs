//! Arms made at random, generated, and held to their own vectors by the very command that `generate` prints.

use crate::common::{Random, share};
use crate::packages;
use arms::Kind;
use denavit::description::read_toml;
use denavit_emit::Language;
use denavit_generate::{Wanted, generate};
use std::process::Command;

#[path = "../../../robot/tests/suite/attack/arms.rs"]
mod arms;

/// Languages that need no more than what building the project needs.
const LANGUAGES: [Language; 2] = [Language::C, Language::JavaScript];

/// The package of an arm passes its own tests, or says what is left out of it.
fn attack(kind: Kind, seed: u64, language: Language) -> Result<bool, String> {
    let text = arms::text(&mut Random(seed), kind);
    let (description, _) = read_toml(&text).map_err(|e| format!("{e:?}\n{text}"))?;
    let options = packages::options(language, &[Wanted::Pose, Wanted::Jacobian, Wanted::Inverse]);
    let found = std::panic::catch_unwind(|| generate(&description, &options))
        .map_err(|_| format!("it panics\n{text}"))?
        .map_err(|e| format!("{e:?}\n{text}"))?;
    if found.inverse.is_none() && found.refused.is_none() {
        return Err(format!("the inverse function is missing without a reason\n{text}"));
    }
    let name = format!("attack-{kind:?}-{seed}-{language:?}");
    let folder = packages::folder(&name, &found.files);
    let command = found.test_command(language);
    let run = Command::new("sh").args(["-c", &command]).current_dir(&folder).output().expect("a shell");
    if !run.status.success() {
        let said = [run.stdout, run.stderr].map(|t| String::from_utf8_lossy(&t).into_owned()).concat();
        return Err(format!("`{command}` in {}:\n{said}\n{text}", folder.display()));
    }
    let _ = std::fs::remove_dir_all(&folder);
    Ok(found.inverse.is_some())
}

#[test]
fn code_for_any_arm_passes_its_own_tests() {
    let first: u64 = std::env::var("DENAVIT_ATTACK_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(1);
    let (mut wrong, mut inverse) = (vec![], 0);
    let arms = share(25, 1) as u64;
    for (k, kind) in Kind::ALL.into_iter().enumerate() {
        // A bounded run takes the languages in turn.
        let languages = if arms > 1 { &LANGUAGES[..] } else { &LANGUAGES[k % 2..][..1] };
        for seed in first..first + arms {
            for &language in languages {
                match attack(kind, seed * 1000 + kind as u64, language) {
                    Ok(has_inverse) => inverse += usize::from(has_inverse),
                    Err(why) => wrong.push(format!("{kind:?} {seed} {language:?}: {why}")),
                }
            }
        }
    }
    println!("{inverse} packages with an inverse function");
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(inverse > 2, "{inverse}");
}
