//! Everything that would be published, in `target/release-files`; nothing is uploaded.

use crate::{cargo, command, languages, path, succeed, target};
use anyhow::{Context, Result, bail};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

/// The most that files of each kind may have, bytes: the limit of crates.io, and what one waits for.
const CRATE: u64 = 10_000_000;
const PROGRAM: u64 = 60_000_000;
const WHEEL: u64 = 40_000_000;

/// The target of the program that runs on every Linux.
const STATIC: &str = "x86_64-unknown-linux-musl";

/// A part with its name.
type Part = (&'static str, fn(&Path) -> Result<()>);

/// Makes the parts that are named, or all: `crates`, `sbom`, `program`, `wheel`; and the sums of what is there then.
///
/// # Errors
/// If a part cannot be made, or is larger than its limit.
pub fn run(parts: &[&str]) -> Result<()> {
    let all: [Part; 4] = [("crates", crates), ("sbom", sbom), ("program", program), ("wheel", wheel)];
    if let Some(unknown) = parts.iter().find(|part| all.iter().all(|(name, _)| name != *part)) {
        bail!("no part {unknown}: {}", all.map(|(name, _)| name).join(", "));
    }
    let folder = target().join("release-files");
    if parts.is_empty() && folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    for (name, make) in all.iter().filter(|(name, _)| parts.is_empty() || parts.contains(name)) {
        make(&folder).with_context(|| (*name).to_string())?;
    }
    sums(&folder)
}

/// The metadata of the workspace with all that it depends on.
fn metadata() -> Result<Value> {
    let output = cargo().args(["metadata", "--format-version", "1", "--locked"]).output()?;
    if !output.status.success() {
        bail!("cargo metadata: {}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

fn text<'a>(of: &'a Value, key: &str) -> &'a str {
    of[key].as_str().unwrap_or_default()
}

/// Members of the workspace that are published: those whose `publish` is no empty list.
fn published(metadata: &Value) -> Vec<&Value> {
    let members = metadata["workspace_members"].as_array().map_or(&[][..], Vec::as_slice);
    let packages = metadata["packages"].as_array().map_or(&[][..], Vec::as_slice);
    let is_kept =
        |p: &&Value| members.contains(&p["id"]) && p["publish"].as_array().is_none_or(|to| !to.is_empty());
    packages.iter().filter(is_kept).collect()
}

/// The crates, each built as it would be by those who take it.
fn crates(folder: &Path) -> Result<()> {
    let metadata = metadata()?;
    let mut package = cargo();
    package.args(["package", "--locked", "--no-verify"]);
    let all = published(&metadata);
    for p in &all {
        package.args(["-p", text(p, "name")]);
    }
    succeed(&mut package)?;
    for p in &all {
        let name = format!("{}-{}.crate", text(p, "name"), text(p, "version"));
        put(&target().join("package").join(&name), &folder.join("crates").join(&name), CRATE)?;
    }
    Ok(())
}

/// What the program and the wheel are made of, as CycloneDX 1.5.
fn sbom(folder: &Path) -> Result<()> {
    let metadata = metadata()?;
    let packages = metadata["packages"].as_array().context("cargo metadata has packages")?;
    let purl = |p: &Value| format!("pkg:cargo/{}@{}", text(p, "name"), text(p, "version"));
    let component = |p: &Value| {
        let mut one = json!({
            "type": "library",
            "bom-ref": purl(p),
            "name": text(p, "name"),
            "version": text(p, "version"),
            "purl": purl(p),
        });
        if let Some(license) = p["license"].as_str() {
            // The older spelling of "or".
            one["licenses"] = json!([{ "expression": license.replace('/', " OR ") }]);
        }
        one
    };
    let by_id = |id: &Value| packages.iter().find(|p| p["id"] == *id).map(&purl);
    let nodes = metadata["resolve"]["nodes"].as_array().context("cargo metadata resolves")?;
    let depends = |node: &Value| {
        let on = node["dependencies"].as_array().map_or(&[][..], Vec::as_slice);
        json!({ "ref": by_id(&node["id"]), "dependsOn": on.iter().filter_map(&by_id).collect::<Vec<_>>() })
    };
    let own = published(&metadata);
    let version = own.first().map_or("", |p| text(p, "version"));
    let bom = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": { "component": { "type": "application", "name": "denavit", "version": version } },
        "components": packages.iter().map(component).collect::<Vec<_>>(),
        "dependencies": nodes.iter().map(depends).collect::<Vec<_>>(),
    });
    fs::write(folder.join("denavit.cdx.json"), serde_json::to_string_pretty(&bom)? + "\n")?;
    println!("denavit.cdx.json: {} components", packages.len());
    Ok(())
}

/// The program with its page: on Linux without libraries of the system, where that target is there.
fn program(folder: &Path) -> Result<()> {
    if !path("crates/web/page/dist/index.html").is_file() {
        bail!("the page is not built: cargo xtask web");
    }
    let is_linux = cfg!(all(target_os = "linux", target_arch = "x86_64"));
    let mut build = cargo();
    build.args(["build", "--locked", "--profile", "dist", "--package", "denavit-cli"]);
    let built = if is_linux {
        succeed(command("rustup").args(["target", "add", STATIC]))?;
        build.args(["--target", STATIC]);
        target().join(STATIC).join("dist/denavit")
    } else {
        target().join("dist").join(format!("denavit{}", std::env::consts::EXE_SUFFIX))
    };
    succeed(&mut build)?;
    succeed(command(&built).arg("--version"))?;
    let (system, machine) = (std::env::consts::OS, std::env::consts::ARCH);
    let name = format!("denavit-{system}-{machine}{}", std::env::consts::EXE_SUFFIX);
    put(&built, &folder.join(name), PROGRAM)
}

/// The wheel of this system, on Linux for every distribution of the last years (manylinux, by the linker of zig), and the source.
fn wheel(folder: &Path) -> Result<()> {
    let python = languages::python(&["maturin", "ziglang"])?;
    // zig is asked of the Python that is found first.
    let own = python.parent().context("a folder")?.to_path_buf();
    let places = std::env::var_os("PATH").unwrap_or_default();
    let places = std::env::join_paths([own].into_iter().chain(std::env::split_paths(&places)))?;
    let maturin = |words: &[&str]| {
        let mut build = command(&python);
        build.env("PATH", &places).args(["-m", "maturin"]).args(words).args([
            "--manifest-path",
            "crates/python/Cargo.toml",
            "--out",
        ]);
        succeed(build.arg(folder.join("python")))
    };
    let zig: &[&str] =
        if cfg!(target_os = "linux") { &["--zig", "--compatibility", "manylinux2014"] } else { &[] };
    maturin(&[&["build", "--locked", "--profile", "dist"], zig].concat())?;
    maturin(&["sdist"])?;
    files(&folder.join("python"))?.iter().try_for_each(|file| held(file, WHEEL))
}

/// Copies a file that is not above its limit.
fn put(from: &Path, to: &Path, limit: u64) -> Result<()> {
    held(from, limit)?;
    fs::create_dir_all(to.parent().context("a folder")?)?;
    fs::copy(from, to).with_context(|| from.display().to_string())?;
    Ok(())
}

fn held(file: &Path, limit: u64) -> Result<()> {
    let size = fs::metadata(file).with_context(|| file.display().to_string())?.len();
    println!("{}: {size} bytes", file.file_name().unwrap_or_default().to_string_lossy());
    if size > limit {
        bail!("{}: {size} bytes; {limit} at the most", file.display());
    }
    Ok(())
}

/// All files below a folder, in order.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = vec![];
    for entry in fs::read_dir(folder)? {
        let entry = entry?.path();
        if entry.is_dir() { found.extend(files(&entry)?) } else { found.push(entry) }
    }
    found.sort();
    Ok(found)
}

/// `SHA256SUMS` over all files, as `sha256sum --check` reads it.
fn sums(folder: &Path) -> Result<()> {
    let list = folder.join("SHA256SUMS");
    if list.exists() {
        fs::remove_file(&list)?;
    }
    let names: Vec<PathBuf> = files(folder)?
        .iter()
        .map(|f| f.strip_prefix(folder).map(Path::to_path_buf))
        .collect::<Result<_, _>>()?;
    let mut sum = if cfg!(target_os = "macos") { command("shasum") } else { command("sha256sum") };
    if cfg!(target_os = "macos") {
        sum.args(["-a", "256"]);
    }
    let output = sum.args(&names).current_dir(folder).output().context("sha256sum")?;
    if !output.status.success() {
        bail!("sha256sum: {}", String::from_utf8_lossy(&output.stderr));
    }
    fs::write(&list, output.stdout)?;
    println!("{} files in {}", names.len(), folder.display());
    Ok(())
}
