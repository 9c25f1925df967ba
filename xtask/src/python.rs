//! The Python package: built with the artefacts of the workspace and tested; as a wheel, installed and tested.

use crate::{cargo, command, languages, path, program, scratch, succeed, target};
use anyhow::{Context, Result, bail};
use serde_json::json;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The package without its module.
const PACKAGE: &str = "crates/python/python/denavit";
const TESTS: &str = "crates/python/tests";
/// What makes the documentation of it.
const SITE: &str = "docs/site";
/// How ruff is to look at it.
const RULES: &str = "crates/python/pyproject.toml";
/// What tests use.
const PACKAGES: &[&str] =
    &["numpy", "pytest", "hypothesis", "scipy", "sympy", "jax", "ikpy", "nbformat", "pyarrow", "duckdb"];
/// What the tests on clusters use besides.
const CLUSTERS: &[&str] = &["numpy", "pytest", "pyarrow", "duckdb", "pandas", "ray[data]", "pyspark", "daft"];
/// The folder of their environment, in the target: 1.5 GB.
const ENVIRONMENT: &str = "clusters";
/// What reads the package itself.
const READERS: &[&str] = &["mypy", "basedpyright", "ruff"];

/// Builds the module beside the program, puts the package together and runs its tests and those of its types.
///
/// # Errors
/// If something fails.
pub fn test() -> Result<()> {
    let python = languages::python(&[PACKAGES, READERS].concat())?;
    let program = program()?;
    let folder = built(&scratch()?.join("python"))?;
    style(&python)?;
    types(&python, &folder)?;
    let mut tests = pytest(&python, &program)?;
    succeed(tests.env("PYTHONPATH", &folder))
}

/// Runs what is computed over record batches on local clusters of Ray and Spark, and in Daft and DuckDB, each started and stopped by its test.
///
/// # Errors
/// If something fails, or there is no Java.
pub fn clusters() -> Result<()> {
    if command("java").arg("-version").output().is_err() {
        bail!("Spark needs Java: `apt-get install default-jre-headless`, or as it is called elsewhere");
    }
    let python = languages::python_in(&target().join(ENVIRONMENT), CLUSTERS)?;
    let program = program()?;
    let folder = built(&scratch()?.join("python"))?;
    let mut tests = command(&python);
    tests
        .args(["-m", "pytest", "-q", "-s", "-p", "no:cacheprovider"])
        .arg(path(TESTS).join("test_clusters.py"));
    tests.env("DENAVIT", program).env("DENAVIT_CLUSTERS", "1").env("PYTHONDONTWRITEBYTECODE", "1");
    succeed(tests.env("PYTHONPATH", &folder))
}

/// The package with its module, beside the program, put into a folder.
///
/// # Errors
/// If it does not build, or a file cannot be copied.
pub fn built(folder: &Path) -> Result<PathBuf> {
    // As the program is built, so that both take the same libraries.
    let arguments = ["build", "--quiet", "--locked", "--workspace", "--lib", "--bins", "--examples"];
    succeed(cargo().args(arguments))?;
    assembled("debug", folder)
}

/// The package with the module that was built to a folder of the target, put into another folder.
///
/// # Errors
/// If a file cannot be copied.
pub fn assembled(from: &str, folder: &Path) -> Result<PathBuf> {
    let package = folder.join("denavit");
    if package.exists() {
        fs::remove_dir_all(&package)?;
    }
    fs::create_dir_all(&package)?;
    for entry in fs::read_dir(path(PACKAGE))? {
        let file = entry?.path();
        if file.is_file() {
            fs::copy(&file, package.join(file.file_name().context("a name")?))?;
        }
    }
    let (library, module) = match () {
        () if cfg!(windows) => ("denavit_python.dll", "_denavit.pyd"),
        () if cfg!(target_os = "macos") => ("libdenavit_python.dylib", "_denavit.abi3.so"),
        () => ("libdenavit_python.so", "_denavit.abi3.so"),
    };
    fs::copy(target().join(from).join(library), package.join(module))?;
    Ok(folder.to_path_buf())
}

/// ruff finds nothing in the package and its tests, and all is as it formats it.
fn style(python: &Path) -> Result<()> {
    for check in [&["check", "--quiet"][..], &["format", "--check", "--quiet"]] {
        let mut ruff = command(python);
        succeed(ruff.args(["-m", "ruff"]).args(check).args([
            "--no-cache",
            "--config",
            RULES,
            PACKAGE,
            TESTS,
            SITE,
        ]))?;
    }
    Ok(())
}

/// mypy and pyright find nothing in the package, and nothing in the examples of its documentation.
fn types(python: &Path, folder: &Path) -> Result<()> {
    let examples = scratch()?.join("examples");
    let mut write = command(python);
    succeed(write.arg(path(TESTS).join("examples.py")).arg(&examples).env("PYTHONDONTWRITEBYTECODE", "1"))?;
    for what in [&["-p", "denavit"].map(PathBuf::from)[..], std::slice::from_ref(&examples)] {
        let mut check = command(python);
        check.args(["-m", "mypy", "--strict", "--no-error-summary", "--cache-dir"]);
        // JAX does not say what its settings take.
        check.arg(scratch()?.join("mypy")).args(["--untyped-calls-exclude", "jax"]);
        succeed(check.args(what).env("MYPYPATH", folder))?;
    }
    let settings = json!({ "typeCheckingMode": "standard", "extraPaths": [folder] });
    fs::write(examples.join("pyrightconfig.json"), settings.to_string())?;
    for project in [&path("crates/python"), &examples] {
        let mut check = command(python);
        check.args(["-m", "basedpyright", "--level", "error", "--project"]).arg(project);
        succeed(check.arg("--pythonpath").arg(python))?;
    }
    Ok(())
}

/// The tests, beside the program.
fn pytest(python: &Path, program: &Path) -> Result<Command> {
    let mut tests = command(python);
    tests.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", TESTS]);
    tests.env("DENAVIT", program).env("PYTHONDONTWRITEBYTECODE", "1");
    tests.env("HYPOTHESIS_STORAGE_DIRECTORY", scratch()?.join("hypothesis"));
    Ok(tests)
}

/// Builds the wheel as it would be published, installs it into an empty environment and runs the tests there.
///
/// # Errors
/// If something fails.
pub fn wheel() -> Result<()> {
    let python = languages::python(&["maturin"])?;
    let program = program()?;
    let wheels = target().join("wheels");
    if wheels.exists() {
        fs::remove_dir_all(&wheels)?;
    }
    let mut build = command(&python);
    build.args(["-m", "maturin", "build", "--profile", "dist", "--locked", "--out"]).arg(&wheels);
    succeed(build.args(["--manifest-path", "crates/python/Cargo.toml"]))?;
    let built: Vec<PathBuf> = fs::read_dir(&wheels)?.map(|e| Ok(e?.path())).collect::<Result<_>>()?;
    let [wheel] = &built[..] else { bail!("{} wheels in {}", built.len(), wheels.display()) };
    let environment = scratch()?.join("wheel");
    if environment.exists() {
        fs::remove_dir_all(&environment)?;
    }
    succeed(command(&python).args(["-m", "venv"]).arg(&environment))?;
    let own = languages::interpreter(&environment);
    let install =
        |packages: &[&str]| succeed(command(&own).args(["-m", "pip", "install", "--quiet"]).args(packages));
    install(&[&wheel.to_string_lossy()])?;
    install(PACKAGES)?;
    println!("{}: {} bytes", wheel.display(), fs::metadata(wheel)?.len());
    succeed(&mut pytest(&own, &program)?)
}
