//! Everything that would be published, in `target/release-files`; nothing is uploaded.

use crate::{cargo, command, folders, languages, path, succeed, target};
use anyhow::{Context, Result, bail};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

/// The most that files of each kind may have, bytes: the limit of crates.io, and what one waits for.
const CRATE: u64 = 10_000_000;
const PROGRAM: u64 = 60_000_000;
const WHEEL: u64 = 40_000_000;
const LIBRARY: u64 = 150_000_000;

/// The target of the program that runs on every Linux.
const STATIC: &str = "x86_64-unknown-linux-musl";

/// What is handed out otherwise than as crates, with what it is made of.
const SHIPPED: [&str; 4] = ["denavit-cli", "denavit-ffi", "denavit-python", "denavit-web"];
/// Where `crates/cli/build.rs` finds the page when it is built from its crate.
const PAGE_OF_CRATE: &str = "crates/cli/page";

/// A part with its name.
type Part = (&'static str, fn(&Path) -> Result<()>);

/// Makes the parts that are named, or all: `crates`, `sbom`, `site`, `program`, `library`, `wheel`; and the sums of what is there then.
///
/// # Errors
/// If a part cannot be made, or is larger than its limit.
pub fn run(parts: &[&str]) -> Result<()> {
    let all: [Part; 6] = [
        ("crates", crates),
        ("sbom", sbom),
        ("site", site),
        ("program", program),
        ("library", library),
        ("wheel", wheel),
    ];
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

/// The crates, each unpacked and built from what the others have, as by those who take it; `denavit-cli` with the page.
fn crates(folder: &Path) -> Result<()> {
    let metadata = metadata()?;
    let page = page()?;
    let changed = command("git").args(["status", "--porcelain"]).output().context("git")?;
    if !changed.status.success() || !changed.stdout.is_empty() {
        bail!("the working tree has changes: {}", String::from_utf8_lossy(&changed.stdout));
    }
    // Cargo takes crates of this version that it has unpacked or built before for those that are packed now.
    let built = of_this_commit(&target().join("packaged"))?;
    let mut package = cargo();
    // The page is no file of the repository.
    package.args(["package", "--locked", "--allow-dirty", "--target-dir"]).arg(&built);
    let all = published(&metadata);
    for p in &all {
        package.args(["-p", text(p, "name")]);
    }
    // A crate has files of its own folder alone.
    let own = path(PAGE_OF_CRATE);
    folders::copied(&page, &own)?;
    let packaged = succeed(&mut package);
    fs::remove_dir_all(&own)?;
    packaged?;
    for p in &all {
        let name = format!("{}-{}.crate", text(p, "name"), text(p, "version"));
        put(&built.join("package").join(&name), &folder.join("crates").join(&name), CRATE)?;
    }
    Ok(())
}

/// A folder inside of another for what is made of this commit; those of others are removed.
fn of_this_commit(folder: &Path) -> Result<PathBuf> {
    let head = command("git").args(["rev-parse", "HEAD"]).output().context("git")?;
    let own = folder.join(String::from_utf8_lossy(&head.stdout).trim());
    for entry in fs::read_dir(folder).into_iter().flatten().flatten().filter(|e| e.path() != own) {
        fs::remove_dir_all(entry.path())?;
    }
    Ok(own)
}

/// What the program, its page, the library for C and the wheel are made of, as CycloneDX 1.5: on whatever system, without what only tests use.
fn sbom(folder: &Path) -> Result<()> {
    let metadata = metadata()?;
    let packages = metadata["packages"].as_array().context("cargo metadata has packages")?;
    let nodes = metadata["resolve"]["nodes"].as_array().context("cargo metadata resolves")?;
    let purl = |p: &Value| format!("pkg:cargo/{}@{}", text(p, "name"), text(p, "version"));
    let by_id = |id: &Value| packages.iter().find(|p| p["id"] == *id);
    let taken = |id: &Value| -> Vec<&Value> {
        let node = nodes.iter().find(|n| n["id"] == *id);
        let deps = node.and_then(|n| n["deps"].as_array()).map_or(&[][..], Vec::as_slice);
        let is_taken = |d: &&Value| {
            d["dep_kinds"].as_array().is_some_and(|kinds| kinds.iter().any(|kind| kind["kind"] != "dev"))
        };
        deps.iter().filter(is_taken).map(|d| &d["pkg"]).collect()
    };
    let first = |p: &&Value| p["source"].is_null() && SHIPPED.contains(&text(p, "name"));
    let mut ids: Vec<&Value> = packages.iter().filter(first).map(|p| &p["id"]).collect();
    let mut next = 0;
    while let Some(id) = ids.get(next) {
        let new: Vec<&Value> = taken(id).into_iter().filter(|d| !ids.contains(d)).collect();
        ids.extend(new);
        next += 1;
    }
    let mut components: Vec<Value> = ids
        .iter()
        .filter_map(|id| by_id(id))
        .map(|p| component(&purl(p), text(p, "name"), text(p, "version"), p["license"].as_str()))
        .collect();
    components.extend(libraries_of_page()?);
    components.sort_by_key(|c| text(c, "purl").to_string());
    let depends = |id: &&Value| {
        let on: Vec<String> = taken(id).into_iter().filter_map(by_id).map(purl).collect();
        json!({ "ref": by_id(id).map(purl), "dependsOn": on })
    };
    let version = published(&metadata).first().map_or("", |p| text(p, "version"));
    let bom = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": { "component": { "type": "application", "name": "denavit", "version": version } },
        "components": components,
        "dependencies": ids.iter().map(depends).collect::<Vec<_>>(),
    });
    fs::write(folder.join("denavit.cdx.json"), serde_json::to_string_pretty(&bom)? + "\n")?;
    println!("denavit.cdx.json: {} components", components.len());
    Ok(())
}

fn component(purl: &str, name: &str, version: &str, license: Option<&str>) -> Value {
    let mut one =
        json!({ "type": "library", "bom-ref": purl, "name": name, "version": version, "purl": purl });
    if let Some(license) = license {
        // The older spelling of "or".
        let license = license.replace(" / ", "/").replace('/', " OR ");
        one["licenses"] = json!([{ "expression": license }]);
    }
    one
}

/// The libraries that the page takes in, by its lock file.
fn libraries_of_page() -> Result<Vec<Value>> {
    let lock: Value = serde_json::from_str(&fs::read_to_string(path("crates/web/page/package-lock.json"))?)?;
    let all = lock["packages"].as_object().context("package-lock.json has packages")?;
    let is_taken = |p: &Value| p["dev"] != true && p["devOptional"] != true;
    let taken = all.iter().filter(|(at, p)| !at.is_empty() && is_taken(p));
    let one = |(at, p): (&String, &Value)| {
        let name = at.rsplit("node_modules/").next().unwrap_or(at);
        // The @ of a scope is written in percent.
        let purl = format!("pkg:npm/{}@{}", name.replace('@', "%40"), text(p, "version"));
        component(&purl, name, text(p, "version"), p["license"].as_str())
    };
    Ok(taken.map(one).collect())
}

/// The documentation with the page in it, for any static host.
fn site(folder: &Path) -> Result<()> {
    page()?;
    folders::copied(&crate::site::build()?, &folder.join("site"))
}

/// The folder of the page as it was built.
fn page() -> Result<PathBuf> {
    crate::web::built().context("the page is not built: cargo xtask web")
}

/// The program with its page: on Linux without libraries of the system.
fn program(folder: &Path) -> Result<()> {
    page()?;
    let is_linux = cfg!(all(target_os = "linux", target_arch = "x86_64"));
    let mut build = cargo();
    build.args(["build", "--locked", "--profile", "dist", "--package", "denavit-cli"]);
    let built = if is_linux {
        let added = succeed(command("rustup").args(["target", "add", STATIC]));
        added.with_context(|| format!("the target {STATIC}, which a program for every Linux needs"))?;
        build.args(["--target", STATIC]);
        target().join(STATIC).join("dist/denavit")
    } else {
        target().join("dist").join(format!("denavit{}", std::env::consts::EXE_SUFFIX))
    };
    succeed(&mut build)?;
    succeed(command(&built).arg("--version"))?;
    if is_linux {
        let needs = command("ldd").arg(&built).output().context("ldd")?;
        let needs = String::from_utf8_lossy(&[needs.stdout, needs.stderr].concat()).into_owned();
        if !needs.contains("statically linked") && !needs.contains("not a dynamic executable") {
            bail!("{} needs libraries of the system: {needs}", built.display());
        }
    }
    let (system, machine) = (std::env::consts::OS, std::env::consts::ARCH);
    let name = format!("denavit-{system}-{machine}{}", std::env::consts::EXE_SUFFIX);
    put(&built, &folder.join(name), PROGRAM)
}

/// The library for C of this system, shared and static, with its headers.
fn library(folder: &Path) -> Result<()> {
    let build = ["build", "--locked", "--profile", "dist", "--package", "denavit-ffi"];
    succeed(cargo().args(build))?;
    let files: &[&str] = match () {
        () if cfg!(windows) => &["denavit.dll", "denavit.dll.lib", "denavit.lib"],
        () if cfg!(target_os = "macos") => &["libdenavit.dylib", "libdenavit.a"],
        () => &["libdenavit.so", "libdenavit.a"],
    };
    let own = folder.join(format!("c-{}-{}", std::env::consts::OS, std::env::consts::ARCH));
    for file in files {
        put(&target().join("dist").join(file), &own.join("lib").join(file), LIBRARY)?;
    }
    let headers = path(crate::c::HEADER);
    folders::copied(headers.parent().context("a folder")?, &own.join("include"))
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
    folders::files(&folder.join("python"))?.iter().try_for_each(|file| held(file, WHEEL))
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

/// `SHA256SUMS` over all files, as `sha256sum --check` reads it.
fn sums(folder: &Path) -> Result<()> {
    let list = folder.join("SHA256SUMS");
    if list.exists() {
        fs::remove_file(&list)?;
    }
    let names: Vec<PathBuf> = folders::files(folder)?
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
