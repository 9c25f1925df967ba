//! Benchmarks, and the page that keeps their results.

mod answers;
mod arms;
mod closed_form;
mod columns;
mod cuda;
mod derivation;
mod descriptions;
mod dynamics;
mod evaluation;
mod inverse;
mod python;
mod report;

pub use inverse::cmake;

use crate::{command, date, path};
use anyhow::{Context, Result};
use std::fs;
use std::time::{SystemTime, UNIX_EPOCH};

const PAGE: &str = "docs/performance.md";

/// What can be measured: its name, the title of its section, and the measurement, with fewer poses if that is true.
type Part = (&'static str, &'static str, fn(bool) -> Result<String>);

const PARTS: &[Part] = &[
    ("evaluation", "Evaluation", |_| evaluation::run()),
    ("dynamics", "Dynamics", |_| dynamics::run()),
    (cuda::NAME, "On a GPU", |_| cuda::run()),
    ("inverse", "Inverse kinematics", |_| inverse::run()),
    ("arms", "Every arm", arms::run),
    ("answers", "First answers", |_| answers::run()),
    ("derivation", "Derivation", |_| derivation::run()),
    ("descriptions", "Descriptions", |_| descriptions::run()),
    ("report", "Reports", |_| report::run()),
    ("python", "From Python", |_| python::run()),
    ("columns", "Files of columns", columns::run),
];
/// What stands behind a figure that is above its limit.
const MISSED: &str = "**missed**";

/// Takes fewer poses, where a part can: to see that it works.
const QUICK: &str = "--quick";

/// Measures the parts named, or all of them; with `write` their sections of the page are renewed.
///
/// # Errors
/// If a measurement fails, a limit is missed, there is no such part, or the page cannot be written.
pub fn run(arguments: &[&str], write: bool) -> Result<()> {
    let is_quick = arguments.contains(&QUICK);
    anyhow::ensure!(!(is_quick && write), "figures of a quick run are not kept");
    let wanted: Vec<&str> = arguments.iter().copied().filter(|a| *a != QUICK).collect();
    if let Some(unknown) = wanted.iter().find(|w| PARTS.iter().all(|p| p.0 != **w)) {
        let known: Vec<&str> = PARTS.iter().map(|p| p.0).collect();
        anyhow::bail!("no benchmark `{unknown}`; there are {}", known.join(", "));
    }
    let mut missed = 0;
    for (name, title, measure) in PARTS.iter().filter(|p| wanted.is_empty() || wanted.contains(&p.0)) {
        if wanted.is_empty() && *name == cuda::NAME && !cuda::is_here() {
            println!("\n━━ {title}: left out for want of nvcc ━━");
            continue;
        }
        println!("\n━━ {title} ━━");
        let section = measure(is_quick)?;
        missed += section.matches(MISSED).count();
        if write {
            renew(title, &section)?;
            println!("wrote the section {title} of {PAGE}");
        }
    }
    anyhow::ensure!(missed == 0, "figures above their limits: {missed}");
    Ok(())
}

/// Replaces one section of the page, from its heading to the next one of that rank, or adds it.
fn renew(title: &str, section: &str) -> Result<()> {
    let page = fs::read_to_string(path(PAGE)).context(PAGE)?;
    let place = |title: &str| page.find(&format!("## {title}\n"));
    let heading = format!("## {title}\n");
    let (start, end) = if let Some(start) = place(title) {
        let rest = start + heading.len();
        (start, page[rest..].find("\n## ").map_or(page.len(), |n| rest + n + 1))
    } else {
        // A new section stands before the first of those that follow it.
        let following = PARTS.iter().skip_while(|p| p.1 != title).skip(1);
        let start = following.filter_map(|p| place(p.1)).min().unwrap_or(page.len());
        (start, start)
    };
    let today = date(SystemTime::now().duration_since(UNIX_EPOCH)?.as_secs() / 86_400);
    let text = format!(
        "{}\n\n{heading}\nMeasured {today} on {}.\n\n{}\n{}",
        page[..start].trim_end(),
        machine(),
        section.trim_end(),
        if end < page.len() { format!("\n{}", &page[end..]) } else { String::new() }
    );
    fs::write(path(PAGE), text).context(PAGE)
}

/// Processor, cores, system and compiler.
fn machine() -> String {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| {
        let line = info.lines().find_map(|l| l.strip_prefix(name)?.split_once(':'));
        line.map(|l| l.1.trim().to_string())
    };
    let model = field("model name").unwrap_or_else(|| std::env::consts::ARCH.into());
    let family = match (field("cpu family"), field("model\t")) {
        (Some(family), Some(number)) => format!(", family {family} model {number}"),
        _ => String::new(),
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let rustc = command("rustc").arg("--version").output();
    let rustc = rustc.map(|o| String::from_utf8_lossy(&o.stdout).trim().to_string());
    let rustc = rustc.unwrap_or_else(|_| "rustc, version unknown".into());
    format!("{model}{family} ({cores} cores, {}, {rustc})", std::env::consts::OS)
}
