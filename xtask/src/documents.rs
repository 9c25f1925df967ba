//! Reports of robots as other programs read them: LaTeX, Typst and a browser.

use crate::languages::{apt, python, quietly};
use crate::{command, path, program, robots, runner, starts, succeed};
use anyhow::{Context, Result, bail};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A robot of each kind; the first three in every language.
const ROBOTS: &[&str] =
    &["staubli-rx90", "cylindrical-wrist", "puma560", "ur3", "smart5-six-rail", "kuka-iiwa-14"];
const SEVERAL: usize = 3;
const OTHERS: [&str; 3] = ["fr", "de", "es"];
/// Lines that are wider than the page by less, points, nobody sees.
const OVERFULL: f64 = 3.0;

/// Writes reports and has them read; installs what is missing first.
///
/// # Errors
/// If something cannot be installed, or a document is refused, runs off its page, or is not accessible.
pub fn run() -> Result<()> {
    let folder = path("target/documents");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    // Each waits much of its time for a program that uses one core.
    std::thread::scope(|scope| {
        let browser = scope.spawn(|| pages(&folder.join("pages")));
        let typeset = latex(&folder.join("latex")).and_then(|()| typst(&folder.join("typst")));
        let looked = browser.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        typeset.and(looked)
    })
}

fn report(robot: &str, to: &Path, extra: &[&str]) -> Result<()> {
    quietly(command(program()?).args(["report", robot, "-o"]).arg(to).args(extra))
}

/// Six robots by pdfTeX, as it comes with Debian's base packages.
fn latex(folder: &Path) -> Result<()> {
    if !starts("pdflatex") || !has_tikz() {
        println!("installing LaTeX");
        apt(&["update", "-qq"])?;
        let packages = ["texlive-latex-base", "texlive-latex-recommended", "texlive-pictures"];
        apt(&[&["install", "-y", "-qq", "--no-install-recommends"][..], &packages].concat())?;
    }
    fs::create_dir_all(folder)?;
    let others = ROBOTS[..SEVERAL].iter().flat_map(|r| OTHERS.map(|language| (r, language)));
    for (robot, language) in ROBOTS.iter().map(|r| (r, "en")).chain(others) {
        let stem = format!("{robot}-{language}");
        report(robot, &folder.join(format!("{stem}.tex")), &["--language", language])?;
        let mut tex = Command::new("pdflatex");
        tex.args(["-interaction=nonstopmode", "-halt-on-error", &format!("{stem}.tex")]).current_dir(folder);
        quietly(&mut tex)?;
        let log = String::from_utf8_lossy(&fs::read(folder.join(format!("{stem}.log")))?).into_owned();
        let wide: Vec<&str> = log.lines().filter(|l| overfull(l) > OVERFULL).collect();
        if !wide.is_empty() {
            bail!("{stem}.tex runs off the page:\n{}", wide.join("\n"));
        }
    }
    println!("{} documents by pdfTeX, none wider than its page", ROBOTS.len() + SEVERAL * OTHERS.len());
    Ok(())
}

/// By how much a line of a log says that something is too wide, points.
fn overfull(line: &str) -> f64 {
    let rest = line.strip_prefix("Overfull \\hbox (");
    rest.and_then(|r| r.split("pt").next()).and_then(|n| n.parse().ok()).unwrap_or(0.0)
}

/// Every robot of the catalogue by Typst; the test of all reports writes them.
fn typst(folder: &Path) -> Result<()> {
    let python = python(&["typst", "pillow"])?;
    fs::create_dir_all(folder)?;
    runner::reports(folder)?;
    let missing: Vec<String> =
        robots()?.into_iter().filter(|r| !folder.join(format!("{r}.typ")).exists()).collect();
    if !missing.is_empty() {
        bail!("no documents of {}", missing.join(", "));
    }
    for (robot, language) in ROBOTS.iter().flat_map(|r| OTHERS.map(|language| (r, language))) {
        report(
            robot,
            &folder.join(format!("{robot}-{language}.typ")),
            &["--language", language, "--conventions", "standard,craig,khalil"],
        )?;
    }
    for (k, robot) in ROBOTS.iter().enumerate() {
        let pace = if k % 2 == 0 { "--slides" } else { "--slides=whole" };
        let language = OTHERS.get(k).unwrap_or(&"en");
        report(robot, &folder.join(format!("{robot}-slides.typ")), &[pace, "--language", language])?;
    }
    succeed(command(python).arg("xtask/pages/look.py").arg(folder))
}

/// Six pages in headless Chromium.
fn pages(folder: &Path) -> Result<()> {
    let chromium = chromium()?;
    let tools = path("xtask/pages");
    if !tools.join("node_modules/axe-core").exists() {
        quietly(Command::new("npm").args(["ci", "--silent"]).current_dir(&tools))?;
    }
    fs::create_dir_all(folder)?;
    let mut look = command("node");
    look.arg("xtask/pages/look.mjs").arg(&chromium);
    for (k, robot) in ROBOTS.iter().enumerate() {
        let page = folder.join(format!("{robot}.html"));
        report(robot, &page, &["--language", OTHERS.get(k).unwrap_or(&"en")])?;
        look.arg(page);
    }
    succeed(&mut look)?;
    let mut turn = command("node");
    turn.arg("xtask/pages/turn.mjs").arg(chromium);
    for (k, robot) in ROBOTS[..SEVERAL].iter().enumerate() {
        let page = folder.join(format!("{robot}-slides.html"));
        let pace = if k % 2 == 0 { "--slides" } else { "--slides=whole" };
        report(robot, &page, &[pace, "--language", OTHERS.get(k).unwrap_or(&"en")])?;
        turn.arg(page);
    }
    succeed(&mut turn)
}

/// The browser, installed if it is missing.
pub fn chromium() -> Result<PathBuf> {
    let find = || ["chromium", "chromium-browser", "google-chrome"].into_iter().find(|p| starts(p));
    if find().is_none() {
        println!("installing Chromium");
        apt(&["update", "-qq"])?;
        apt(&["install", "-y", "-qq", "--no-install-recommends", "chromium", "fonts-dejavu-core"])?;
    }
    let program = find().context("no Chromium")?;
    let output = Command::new("which").arg(program).output()?;
    Ok(PathBuf::from(String::from_utf8_lossy(&output.stdout).trim()))
}

fn has_tikz() -> bool {
    let found = Command::new("kpsewhich").arg("tikz.sty").output();
    found.is_ok_and(|o| !o.stdout.is_empty())
}

#[cfg(test)]
mod tests {
    use super::overfull;

    #[test]
    fn widths_of_lines_are_read() {
        let line = "Overfull \\hbox (12.34pt too wide) in paragraph at lines 1--2";
        assert!((overfull(line) - 12.34).abs() < 1e-9);
        assert!(overfull("Underfull \\hbox (badness 10000)").abs() < 1e-9);
    }
}
