//! Everything a contributor runs: `cargo xtask help`.

mod bench;
mod c;
mod certificates;
mod counts;
mod descriptions;
mod documents;
mod dynamics_counts;
mod errata;
mod firmware;
mod folders;
mod languages;
mod python;
mod release;
mod runner;
mod site;
mod soak;
mod steps;
mod test;
mod tidy;
mod web;

use anyhow::{Context, Result, bail};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::OnceLock;

/// The robot files that come with the program.
const CATALOGUE: &str = "crates/robot/catalogue";

const HELP: &str = "\
Everything a contributor runs.

cargo xtask test                 all that a change must pass; steps that wait for others run side by side
cargo xtask test --quick         after an edit: format, rules, and tests and lints of the crates that differ from the last
                                 commit and of those that use them, without the tests that run other languages' compilers
cargo xtask test --full          before a release: all of the above, the page within its limits of size,
                                 certificates, public robot descriptions, Miri, soak and benchmarks; hours
cargo xtask tidy [--rules | --sessions]
                                 the rules of the project that a program can check: those of its files, and that the
                                 program prints what its pages show
cargo xtask index                the index of files, by what each says of itself
cargo xtask surface              public items that nobody uses, by their names
cargo xtask bench [--write | --quick] [evaluation] [dynamics] [gpu] [inverse] [arms] [answers] [derivation]
                   [descriptions] [report] [python] [columns]
                                 speed of evaluators and generated code beside peers, forward and inverse, and of
                                 inverse kinematics without a closed form; CPU time from start to a first answer, of
                                 deriving every robot of the catalogue, beside SymPy's, and of writing its report; the package beside other
                                 packages; files of columns beside reading and writing them alone; kernels on a GPU where nvcc is; --write renews docs/performance.md, --quick takes fewer poses (arms); fails if a figure is above its limit
cargo xtask languages [--every]  builds and runs generated source code in every language; --every: in C and Rust of all robots
cargo xtask c [--write]          the C library: its header compared, its examples in C, C++ and Go and its tests built and run;
                                 --write renews the header
cargo xtask python               the Python package: built beside the program, its types checked, its tests run
cargo xtask wheel                its wheel as it would be published, installed into an empty environment and tested there
cargo xtask site                 the documentation as a site for any static host, in target/site; with the page, where it is built
cargo xtask release [crates | sbom | site | program | library | wheel]...
                                 everything that would be published, in target/release-files with checksums; nothing is
                                 uploaded; the page has to be built (`cargo xtask web`)
cargo xtask firmware             generated C on a Cortex-M7 in qemu: instructions, stack, code; what cppcheck and clang-tidy remark
cargo xtask counts [--check]     writes docs/operation-counts.md; --check fails if it is not up to date,
                                 or if SymPy needs fewer operations for some robot
cargo xtask counts dynamics [--check]
                                 the same for docs/dynamics-counts.md
cargo xtask web [--debug]        builds the page of `denavit view`, which the next build of denavit takes in; fails if it is
                                 above its limits of size; --debug is quick, and limits nothing
cargo xtask page [--timed]       drives the page, as it is built, in a browser; timed: fails if it is three times slower than its
                                 budgets
cargo xtask certificates         certificates of the whole catalogue and of the documents, held by their checker; six by Coq
cargo xtask descriptions         every URDF and xacro file of example-robot-data, pybullet_data and rtb-data: read, links where
                                 Pinocchio has them, chains proved
cargo xtask documents            reports as LaTeX, Typst and a browser read them
cargo xtask errata [--write]     compares docs/errata.md with what `denavit check` says of the documents; --write renews it
cargo xtask soak [--seconds N] [TARGET...]
                                 feeds random bytes to the readers, N seconds each (60); TARGET `suites`: the tests at the size
                                 that takes hours; `attack`: arms and poses at random, an hour;
                                 `clusters`: record batches on Ray, Spark, Daft and DuckDB, started here (1.5 GB of packages, Java)
cargo xtask miri                 the evaluators' conformance suite under Miri (half an hour)
cargo xtask help                 this text
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match dispatch(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(e) => {
            eprintln!("error: {e:#}");
            ExitCode::FAILURE
        }
    }
}

fn dispatch(arguments: &[String]) -> Result<()> {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["test"] => test::run(),
        ["test", "--quick"] => test::quick(),
        ["test", "--full"] => test::full(),
        // What `test` calls.
        ["step", name] => test::one(name),
        ["tidy"] => tidy::run(tidy::Part::Both),
        ["tidy", "--rules"] => tidy::run(tidy::Part::Rules),
        ["tidy", "--sessions"] => tidy::run(tidy::Part::Sessions),
        ["index"] => tidy::index(),
        ["surface"] => tidy::surface(),
        ["bench", "--write", ref parts @ ..] => bench::run(parts, true),
        ["bench", ref parts @ ..] => bench::run(parts, false),
        ["languages"] => languages::run(),
        ["languages", "--every"] => languages::every(),
        ["c"] => c::test(),
        ["c", "--write"] => c::write(),
        ["firmware"] => firmware::run(),
        ["python"] => python::test(),
        ["wheel"] => python::wheel(),
        ["site"] => site::build().map(drop),
        ["release", ref parts @ ..] => release::run(parts),
        ["miri"] => soak::miri(),
        ["counts"] => counts::run(false),
        ["counts", "--check"] => counts::run(true),
        ["counts", "dynamics"] => dynamics_counts::run(false),
        ["counts", "dynamics", "--check"] => dynamics_counts::run(true),
        ["web"] => web::run(false),
        ["web", "--debug"] => web::run(true),
        ["page"] => web::drive(false),
        ["page", "--timed"] => web::drive(true),
        ["certificates"] => certificates::run(),
        ["descriptions"] => descriptions::run(),
        ["documents"] => documents::run(),
        ["errata"] => errata::run(false),
        ["errata", "--write"] => errata::run(true),
        ["soak", "--seconds", n, ref targets @ ..] => {
            soak::run(n.parse().context("--seconds takes a whole number")?, targets)
        }
        ["soak", ref targets @ ..] => soak::run(60, targets),
        ["help" | "--help" | "-h"] | [] => {
            print!("{HELP}");
            Ok(())
        }
        _ => bail!("no such command: {}\n\n{HELP}", words.join(" ")),
    }
}

/// The folder of the workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// A file of the project by its path from the root.
fn path(relative: &str) -> PathBuf {
    root().join(relative)
}

/// A command that runs in the root.
fn command(program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(program);
    command.current_dir(root());
    command
}

/// The cargo that runs this program.
fn cargo() -> Command {
    command(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Runs a command; an error if it cannot start or does not succeed.
fn succeed(command: &mut Command) -> Result<()> {
    let status = command.status().with_context(|| format!("{command:?} does not start"))?;
    if !status.success() {
        bail!("{command:?} failed ({status})");
    }
    Ok(())
}

/// Whether a program is there.
fn starts(program: &str) -> bool {
    let status = Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    status.is_ok_and(|s| s.success())
}

/// The folder of cargo's results.
fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| path("target"), |folder| path("").join(folder))
}

/// Where this program keeps what it needs between its steps.
fn scratch() -> Result<PathBuf> {
    let folder = target().join("xtask");
    std::fs::create_dir_all(&folder)?;
    Ok(folder)
}

/// The command line of the project, built as its tests are: with the features of all packages and what examples need, so that
/// both take the same libraries.
fn program() -> Result<PathBuf> {
    static IS_BUILT: OnceLock<bool> = OnceLock::new();
    let arguments = ["build", "--quiet", "--locked", "--workspace", "--bins", "--examples"];
    let build = || succeed(cargo().args(arguments)).is_ok();
    if !IS_BUILT.get_or_init(build) {
        bail!("denavit does not build");
    }
    Ok(target().join("debug/denavit"))
}

/// What the command line prints on standard output, whatever its exit code.
fn denavit<W: AsRef<OsStr>>(words: impl IntoIterator<Item = W>) -> Result<String> {
    let mut run = command(program()?);
    let output = run.args(words).env("NO_COLOR", "1").output()?;
    if output.stdout.is_empty() {
        bail!("{run:?} prints nothing: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(String::from_utf8(output.stdout)?)
}

/// The names of all robots of the catalogue, sorted.
fn robots() -> Result<Vec<String>> {
    let files = std::fs::read_dir(path(CATALOGUE))?.map(|f| Ok(f?.path())).collect::<Result<Vec<_>>>()?;
    let files = files.iter().filter(|f| f.extension().is_some_and(|e| e == "toml"));
    let mut names: Vec<String> = files.filter_map(|f| Some(f.file_stem()?.to_str()?.into())).collect();
    names.sort_unstable();
    Ok(names)
}

/// Days since 1970-01-01 as year-month-day in UTC (Hinnant, *chrono-compatible low-level date algorithms*).
fn date(days: u64) -> String {
    let z = days + 719_468;
    let era = z / 146_097;
    let day_of_era = z % 146_097;
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * day_of_year + 2) / 153;
    let month = if shifted < 10 { shifted + 3 } else { shifted - 9 };
    let year = era * 400 + year_of_era + u64::from(month <= 2);
    format!("{year}-{month:02}-{:02}", day_of_year - (153 * shifted + 2) / 5 + 1)
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn dates_by_the_calendar() {
        // `date -u -d @$((86400 * n)) +%F`
        for (days, expected) in
            [(0, "1970-01-01"), (59, "1970-03-01"), (11_016, "2000-02-29"), (20_454, "2026-01-01")]
        {
            assert_eq!(date(days), expected);
        }
    }
}
