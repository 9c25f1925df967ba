//! Puts the page of `denavit view` into the program.
//!
//! Every file of `crates/web/page/dist`, which `cargo xtask web` writes, is compressed and becomes a row of a table; in the
//! published crate those files are its folder `page`. The variable `DENAVIT_PAGE` names another folder, from the root of the workspace, or says `none`. A program that is built
//! without the page has an empty table. The same files give the same program: nothing of the table depends on the time
//! or on where the folder is.

#[path = "src/commands/view/packing.rs"]
mod packing;

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// The variable that names another page.
const VARIABLE: &str = "DENAVIT_PAGE";

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/commands/view/packing.rs");
    println!("cargo::rerun-if-env-changed={VARIABLE}");
    let files = match folder()? {
        Some(folder) => packing::pack(&folder).map_err(|e| format!("{}: {e}", folder.display()))?,
        None => vec![],
    };
    // Tests ask whether there is a page.
    println!("cargo::rustc-env=DENAVIT_PAGE_FILES={}", files.len());
    write(&files, &PathBuf::from(env::var("OUT_DIR")?))
}

/// The folder of the page, if there is one.
fn folder() -> Result<Option<PathBuf>, Box<dyn Error>> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?).join("../..");
    match env::var(VARIABLE) {
        Ok(text) if text == "none" => Ok(None),
        Ok(text) => {
            let folder = root.join(text);
            println!("cargo::rerun-if-changed={}", folder.display());
            if !folder.join("index.html").is_file() {
                return Err(format!("{VARIABLE}: no index.html in {}", folder.display()).into());
            }
            Ok(Some(folder))
        }
        Err(_) => {
            let packed = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?).join("page");
            let is_packed = !root.join("crates/web").is_dir() && packed.is_dir();
            let folder = if is_packed { packed } else { root.join("crates/web/page/dist") };
            // A path that is watched and does not exist would build the program anew each time. The folder around one
            // that does not exist yet changes when it appears.
            if let Some(watched) = folder.ancestors().take(4).find(|f| f.is_dir()) {
                println!("cargo::rerun-if-changed={}", watched.display());
            }
            Ok(folder.join("index.html").is_file().then_some(folder))
        }
    }
}

/// The compressed files, and the table that names them.
fn write(files: &[packing::Packed], to: &Path) -> Result<(), Box<dyn Error>> {
    let mut table = String::from("&[\n");
    for (i, file) in files.iter().enumerate() {
        fs::write(to.join(format!("page-{i}.gz")), &file.gzip)?;
        writeln!(
            table,
            "    ({:?}, {:?}, include_bytes!(concat!(env!(\"OUT_DIR\"), \"/page-{i}.gz\"))),",
            file.name, file.content_type
        )?;
    }
    table.push_str("]\n");
    fs::write(to.join("page.rs"), table)?;
    Ok(())
}
