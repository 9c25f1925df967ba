//! Steps one after the other, some of them side by side with the rest, and a summary of their times.

use anyhow::{Context, Result, anyhow};
use std::fs::File;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::thread;
use std::time::{Duration, Instant};

/// A part of a test.
pub struct Step {
    /// What the summary calls it.
    pub name: &'static str,
    /// The arguments of this program that run it.
    pub words: &'static [&'static str],
}

/// What a step that skips something begins a line with, before the reason.
pub const SKIPPED: &str = "skipped: ";

/// How a step ended.
struct Ended {
    name: &'static str,
    took: Duration,
    result: Result<String>,
}

/// Runs the first steps in their order, then two lists side by side: of the second what is printed is shown when a step ends,
/// whole. A failure ends its list, and nothing begins after it.
///
/// # Errors
/// The first step that fails.
pub fn run(first: &[Step], front: &[Step], aside: &[Step]) -> Result<()> {
    this_program();
    let mut ended = in_order(first, false);
    if ended.iter().all(|e| e.result.is_ok()) {
        let both = thread::scope(|scope| {
            let other = scope.spawn(|| in_order(aside, true));
            let own = in_order(front, false);
            (own, other.join())
        });
        ended.extend(both.0);
        ended.extend(both.1.map_err(|_| anyhow!("a thread panicked"))?);
    }
    println!("\n━━ summary ━━");
    for Ended { name, took, result } in &ended {
        let result = result.as_ref().map_or_else(|e| format!("FAILED: {e:#}"), String::clone);
        println!("{name:<18} {:>6.1} s  {result}", took.as_secs_f64());
    }
    let all = first.iter().chain(front).chain(aside);
    for step in all.filter(|s| ended.iter().all(|e| e.name != s.name)) {
        println!("{:<18} {:>8}  not run", step.name, "");
    }
    match ended.into_iter().find_map(|e| Some((e.name, e.result.err()?))) {
        Some((name, error)) => Err(error.context(format!("{name} failed"))),
        None => Ok(()),
    }
}

fn in_order(steps: &[Step], kept: bool) -> Vec<Ended> {
    let mut ended = vec![];
    for step in steps {
        let start = Instant::now();
        let result = if kept { aside(step) } else { before_our_eyes(step) };
        let failed = result.is_err();
        ended.push(Ended { name: step.name, took: start.elapsed(), result });
        if failed {
            break;
        }
    }
    ended
}

/// Where this program is; a build on the way may put another one of the same text there.
fn this_program() -> Option<&'static PathBuf> {
    static PLACE: OnceLock<Option<PathBuf>> = OnceLock::new();
    PLACE.get_or_init(|| std::env::current_exe().ok()).as_ref()
}

fn this(step: &Step) -> Result<Command> {
    let mut command = Command::new(this_program().context("a program knows where it is")?);
    command.args(step.words).stdin(Stdio::null());
    Ok(command)
}

fn before_our_eyes(step: &Step) -> Result<String> {
    println!("\n━━ {} ━━", step.name);
    let status = this(step)?.status()?;
    if status.success() { Ok("passed".into()) } else { Err(anyhow!("{status}")) }
}

/// Runs a step whose output goes to a file, and shows it in the end.
fn aside(step: &Step) -> Result<String> {
    let log = log(step)?;
    let file = File::create(&log)?;
    let status = this(step)?.stdout(file.try_clone()?).stderr(file).status()?;
    let said = String::from_utf8_lossy(&std::fs::read(&log)?).into_owned();
    println!("\n━━ {}, side by side ━━\n{}", step.name, said.trim_end());
    if !status.success() {
        return Err(anyhow!("{status}; what it printed is in {}", log.display()));
    }
    let skipped = said.lines().rfind(|l| l.starts_with(SKIPPED));
    Ok(skipped.unwrap_or("passed").to_string())
}

fn log(step: &Step) -> Result<PathBuf> {
    Ok(crate::scratch()?.join(format!("{}.log", step.name.replace(' ', "-"))))
}
