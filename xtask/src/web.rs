//! The page of `denavit view`: the engine as WebAssembly, the page around it, and how large both are.

mod split;

use crate::documents::chromium;
use crate::languages::quietly;
use crate::steps::SKIPPED;
use crate::{cargo, command, path, starts, succeed, target};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The target of the engine.
const TARGET: &str = "wasm32-unknown-unknown";
/// The page, and where it is built to.
const PAGE: &str = "crates/web/page";
const SITE: &str = "crates/web/page/dist";
/// The same in one file, which opens from a disk.
const SINGLE: &str = "crates/web/page/single/denavit.html";
/// The engine in parts: what is needed at once, what solves poses, what derives, what reads what others wrote, what writes reports
/// and source code, and what checks documents and recordings.
const ENGINE: [&str; 6] =
    ["denavit.wasm", "inverse.wasm", "derive.wasm", "read.wasm", "write.wasm", "check.wasm"];
/// How many of them a page fetches before somebody opens a file, asks for a report or for source code, or checks a document.
const AT_ONCE: usize = 3;
/// How the names of what begin that the page fetches when somebody opens an archive or a mesh (`build.mjs`).
const LATER: &str = "lazy-";
/// What the page calls of each part, and what belongs to it among the functions that are called through the table: where a
/// name is missing here, a function stands in an earlier part than it need.
const PARTS: [split::Part; 6] = [
    split::Part { exports: &["memory", "request", "answer", "text", "length"], named: &[] },
    split::Part {
        exports: &["answer_inverse"],
        named: &[
            "denavit::inverse",
            "denavit_elimination",
            "denavit_program::evaluate",
            "denavit_program::solver",
            "denavit_web::answer_inverse",
            "denavit_web::solve",
        ],
    },
    split::Part {
        exports: &["answer_more"],
        named: &[
            "denavit::motion",
            "denavit::velocity::singular",
            "denavit::workspace",
            "denavit_report::explain",
            "denavit_report::render",
            "denavit_report::sections",
            "denavit_report::words::english",
            // What languages say alike is one function, which has the name of any of them.
            "denavit_report::words::french",
            "denavit_report::words::german",
            "denavit_report::words::spanish",
            "denavit_symbolic::factor",
            "denavit_web::answer_more",
            "denavit_web::formulas",
            "denavit_web::motion",
            "denavit_web::reach",
            "denavit_web::values",
            "denavit_web::velocity",
        ],
    },
    split::Part {
        exports: &["answer_read"],
        named: &[
            "denavit::description::mjcf",
            "denavit::description::table",
            "denavit::description::toolbox",
            "denavit::description::urdf",
            "denavit::description::xacro",
            "denavit_web::answer_read",
            "denavit_web::dropped",
            "denavit_web::looks",
            "denavit_web::tree",
        ],
    },
    split::Part {
        exports: &["answer_written"],
        named: &[
            "denavit_emit",
            "denavit_generate",
            "denavit_report::render::latex",
            "denavit_report::render::markdown",
            "denavit_report::render::typst",
            "denavit_web::answer_written",
            "denavit_web::documents",
        ],
    },
    split::Part {
        exports: &["answer_check"],
        named: &[
            "csv",
            "denavit_check",
            "denavit_reading",
            "denavit_recording",
            "denavit_report::sections::errata",
            "denavit_report::words::check",
            "denavit_tables",
            "denavit_web::answer_check",
            "denavit_web::checking",
            "denavit_web::recorded",
            "denavit_wire::recording",
        ],
    },
];
/// What a dependency of the plots brings along for pages that are written in Rust.
const FOREIGN: &[&str] = &["js_sys", "wasm_bindgen", "web_sys"];
/// Where the texts stand that reports and source code are made of.
const TEXTS: &[&str] = &[
    "crates/elimination/src",
    "crates/emit/src",
    "crates/program/src/kernel",
    "crates/report/assets",
    "crates/generate/src",
];
/// What the part exports that reads them.
const READER: &str = "answer_written";
/// Shorter texts are not worth a place of their own.
const SHORT: usize = 200;
/// The most bytes that are transferred, compressed by brotli: of each part of the engine, and of the page with all that it
/// fetches before somebody checks a document, asks for one, or opens an archive or a tree.
const MAX_ENGINE: u64 = 750_000;
const MAX_SITE: u64 = 1_550_000;
/// What a tool says when it fails may be long; its beginning says what is wrong.
const MAX_LINES: usize = 40;

/// Builds the page into `crates/web/page/dist`, from where the next build of `denavit` takes it. `fast` leaves the engine
/// as the compiler makes it quickly, and measures nothing.
///
/// # Errors
/// If a tool is missing, something does not compile, or the page is above a limit.
pub fn run(fast: bool) -> Result<()> {
    let page = path(PAGE);
    if !page.is_dir() {
        bail!("there is no {PAGE}");
    }
    for program in ["node", "npm"] {
        if !starts(program) {
            bail!("{program} is missing: install Node.js 20 or newer (Debian: `apt-get install nodejs npm`)");
        }
    }
    if !has_target()? {
        bail!("the target is missing: `rustup target add {TARGET}`");
    }
    packages(&page)?;
    println!("checking types");
    briefly(Command::new("npm").args(["run", "--silent", "check"]).current_dir(&page))?;
    println!("building the engine");
    let engine = engine(fast)?;
    println!("building the page");
    // Nothing of an earlier build stays.
    let site = path(SITE);
    if site.exists() {
        fs::remove_dir_all(&site)?;
    }
    fs::create_dir_all(&site)?;
    divided(&engine, &site)?;
    fs::copy(path("crates/report/assets/maths.woff2"), site.join("maths.woff2"))?;
    briefly(Command::new("node").arg("build.mjs").current_dir(&page))?;
    briefly(Command::new("node").args(["build.mjs", "--single"]).current_dir(&page))?;
    if fast {
        return Ok(());
    }
    let files = sizes(&site)?;
    print!("{}", table(&files));
    limits(&files)
}

/// The folder of the page, if it is built.
pub fn built() -> Option<PathBuf> {
    let site = path(SITE);
    site.join("index.html").is_file().then_some(site)
}

/// The page as a single file, if it is built.
pub fn single() -> Option<PathBuf> {
    let file = path(SINGLE);
    file.is_file().then_some(file)
}

/// The page as its tests take it, if it can be built here.
///
/// # Errors
/// If it does not build.
pub fn for_tests() -> Result<()> {
    if !has_target()? {
        // Where rustup installed the compiler, it has the target, too.
        let _ = quietly(command("rustup").args(["target", "add", TARGET]));
    }
    if !has_target()? {
        println!("{SKIPPED}the target is not installed (`rustup target add {TARGET}`)");
        return Ok(());
    }
    run(true)
}

/// Drives the built page in headless Chromium; how fast it is is printed, and held against its budgets only with `is_timed`, where
/// nothing else keeps the machine busy.
///
/// # Errors
/// If there is no browser, the page does not do what its tests say, or is too slow.
pub fn drive(is_timed: bool) -> Result<()> {
    if built().is_none() {
        println!("{SKIPPED}the page is not built (`cargo xtask web`)");
        return Ok(());
    }
    let mut tests = Command::new("node");
    tests.args(["--test", "--test-concurrency=1", "tests/all.mjs"]).current_dir(path(PAGE));
    if is_timed {
        tests.env("PAGE_FIGURES", "gate");
    }
    succeed(tests.env("CHROMIUM", chromium()?))
}

/// Whether the compiler has the standard library for the target.
///
/// # Errors
/// If there is no compiler, or it does not know the target.
fn has_target() -> Result<bool> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = command(&rustc)
        .args(["--print", "target-libdir", "--target", TARGET])
        .output()
        .context("rustc does not start")?;
    if !output.status.success() {
        bail!("rustc does not know {TARGET}");
    }
    Ok(Path::new(String::from_utf8_lossy(&output.stdout).trim()).exists())
}

/// The packages of the lock file, if they are not there or older than it.
fn packages(page: &Path) -> Result<()> {
    let changed = |file: PathBuf| fs::metadata(file).and_then(|m| m.modified()).ok();
    let installed = changed(page.join("node_modules/.package-lock.json"));
    if installed.is_some() && installed >= changed(page.join("package-lock.json")) {
        return Ok(());
    }
    println!("installing packages");
    briefly(Command::new("npm").args(["ci", "--no-audit", "--no-fund", "--loglevel=error"]).current_dir(page))
}

/// Compiles the engine; where it is.
fn engine(fast: bool) -> Result<PathBuf> {
    let profile = if fast { "quick" } else { "web" };
    let mut build = cargo();
    // Names that tell what a generic function is for.
    build.args(["--config", &format!("target.{TARGET}.rustflags=[\"-Csymbol-mangling-version=v0\"]")]);
    build.args(["build", "-p", "denavit-web", "--locked", "--target", TARGET, "--profile", profile]);
    succeed(&mut build)?;
    Ok(target().join(TARGET).join(profile).join("denavit_web.wasm"))
}

/// Writes the parts of the engine.
fn divided(engine: &Path, site: &Path) -> Result<()> {
    let wasm = fs::read(engine).with_context(|| format!("no {}", engine.display()))?;
    let mut texts = vec![];
    for folder in TEXTS {
        constants(&path(folder), &mut texts)?;
    }
    let is_reader = |part: &split::Part| part.exports.contains(&READER);
    let reader = PARTS.iter().position(is_reader).context("a part reads the texts")?;
    let plan = split::Plan { parts: &PARTS, dropped: FOREIGN, texts: &texts, reader };
    for (name, part) in ENGINE.into_iter().zip(split::split(&wasm, &plan)?) {
        fs::write(site.join(name), part)?;
    }
    Ok(())
}

/// The contents of all files of a folder.
fn constants(folder: &Path, out: &mut Vec<Vec<u8>>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let file = entry?.path();
        if file.is_dir() {
            constants(&file, out)?;
        } else {
            out.push(fs::read(&file)?);
        }
    }
    out.retain(|text| text.len() >= SHORT);
    Ok(())
}

/// A file of the site, and its size in bytes: raw, and compressed.
struct Size {
    name: String,
    raw: u64,
    gzip: u64,
    brotli: u64,
}

/// The sizes of all files of a folder, by name.
fn sizes(folder: &Path) -> Result<Vec<Size>> {
    let output = command("node").arg("xtask/pages/sizes.mjs").arg(folder).output()?;
    if !output.status.success() {
        bail!("no sizes: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    parsed(&serde_json::from_slice(&output.stdout)?).context("sizes are four values a file")
}

fn parsed(rows: &Value) -> Option<Vec<Size>> {
    let size = |row: &Value| {
        let bytes = |key: &str| row[key].as_u64();
        let name = row["name"].as_str()?.to_string();
        Some(Size { name, raw: bytes("raw")?, gzip: bytes("gzip")?, brotli: bytes("brotli")? })
    };
    rows.as_array()?.iter().map(size).collect()
}

/// A line a file, and their sum.
fn table(files: &[Size]) -> String {
    let sum = |of: fn(&Size) -> u64| files.iter().map(of).sum();
    let total =
        Size { name: "in all".into(), raw: sum(|f| f.raw), gzip: sum(|f| f.gzip), brotli: sum(|f| f.brotli) };
    let mut text = format!("{:<24}{:>12}{:>12}{:>12}\n", "bytes", "raw", "gzip", "brotli");
    for Size { name, raw, gzip, brotli } in files.iter().chain([&total]) {
        text.push_str(&format!("{name:<24}{raw:>12}{gzip:>12}{brotli:>12}\n"));
    }
    text
}

/// That engine and site are no larger than they may be.
fn limits(files: &[Size]) -> Result<()> {
    let mut held = vec![];
    for name in ENGINE {
        let part = files.iter().find(|f| f.name == name).with_context(|| format!("no {name}"))?;
        held.push((name, part.brotli, MAX_ENGINE));
    }
    let is_later = |f: &&Size| ENGINE[AT_ONCE..].contains(&&*f.name) || f.name.starts_with(LATER);
    let at_once = files.iter().filter(|f| !is_later(f)).map(|f| f.brotli).sum();
    held.push(("the site", at_once, MAX_SITE));
    for (what, bytes, most) in held {
        if bytes > most {
            bail!("{what} is {bytes} bytes compressed by brotli; at most {most}");
        }
    }
    Ok(())
}

/// Runs a tool without a word; an error with the beginning of what it says if it does not succeed.
fn briefly(tool: &mut Command) -> Result<()> {
    let output = tool.stdin(Stdio::null()).output().with_context(|| format!("{tool:?} does not start"))?;
    if output.status.success() {
        return Ok(());
    }
    let said = [output.stdout, output.stderr].concat();
    let said = String::from_utf8_lossy(&said);
    let beginning: Vec<&str> = said.lines().take(MAX_LINES).collect();
    let more = if said.lines().count() > MAX_LINES { "\n…" } else { "" };
    bail!("{tool:?} failed ({})\n{}{more}", output.status, beginning.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(engine: u64, script: u64) -> Vec<Size> {
        let size = |name: &str, brotli| Size { name: name.into(), raw: 9 * brotli, gzip: 2 * brotli, brotli };
        let mut all = vec![size(ENGINE[0], engine), size("main.js", script)];
        all.extend(
            ENGINE
                .into_iter()
                .skip(1)
                .enumerate()
                .map(|(k, name)| size(name, if k + 1 < AT_ONCE { 0 } else { 3 })),
        );
        all
    }

    #[test]
    fn limits_are_kept() {
        assert!(limits(&files(MAX_ENGINE, MAX_SITE - MAX_ENGINE)).is_ok());
        let says = |files: &[Size]| limits(files).err().map(|e| e.to_string()).unwrap_or_default();
        assert_eq!(
            says(&files(MAX_ENGINE + 1, 0)),
            "denavit.wasm is 750001 bytes compressed by brotli; at most 750000"
        );
        assert_eq!(
            says(&files(1, MAX_SITE)),
            "the site is 1550001 bytes compressed by brotli; at most 1550000"
        );
        assert_eq!(says(&files(1, 1)[1..]), "no denavit.wasm");
        // What is fetched later does not count.
        let mut later = files(1, 1);
        later.push(Size { name: "lazy-stl.js".into(), raw: 0, gzip: 0, brotli: MAX_SITE });
        assert!(limits(&later).is_ok());
    }

    #[test]
    fn sizes_are_added() {
        let text = table(&files(10, 5));
        let last: Vec<&str> = text.lines().last().unwrap_or_default().split_whitespace().collect();
        assert_eq!(last, ["in", "all", "216", "48", "24"]);
    }

    #[test]
    fn sizes_are_read() {
        let rows = serde_json::json!([{"name": "a", "raw": 3, "gzip": 2, "brotli": 1}]);
        let read = parsed(&rows).unwrap();
        assert_eq!((&read[0].name[..], read[0].raw, read[0].gzip, read[0].brotli), ("a", 3, 2, 1));
        assert!(parsed(&serde_json::json!([{"name": "a"}])).is_none());
    }

    #[test]
    fn a_tool_that_fails_says_why_and_not_all() {
        let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        let error = briefly(cargo.arg("no-such-verb")).unwrap_err().to_string();
        assert!(error.contains("no-such-verb"), "{error}");
        assert!(error.lines().count() <= MAX_LINES + 2, "{error}");
    }
}
