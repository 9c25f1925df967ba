//! The files of a page, compressed, each with the type that a browser is told.
//!
//! `build.rs` reads this file, too: it packs the page into the program.

use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::{self, Error, ErrorKind, Write};
use std::{fs, path::Path};

/// A file of a page.
pub struct Packed {
    /// Its name relative to the page, with `/` between folders.
    pub name: String,
    /// The value of `Content-Type`.
    pub content_type: &'static str,
    /// Its contents, compressed by gzip.
    pub gzip: Vec<u8>,
}

/// All files of a folder and of the folders in it, by name. Links and hidden files are left out.
///
/// # Errors
/// If a file cannot be read, or its name would need escapes in an address.
pub fn pack(folder: &Path) -> io::Result<Vec<Packed>> {
    let mut files = vec![];
    collect(folder, "", &mut files)?;
    files.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(files)
}

fn collect(folder: &Path, prefix: &str, files: &mut Vec<Packed>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        let kind = entry.file_type()?;
        if entry.file_name().to_string_lossy().starts_with('.') {
            continue;
        }
        if kind.is_dir() {
            collect(&entry.path(), &format!("{name}/"), files)?;
        } else if kind.is_file() {
            if !name.chars().all(|c| c.is_ascii_alphanumeric() || "._-/".contains(c)) {
                return Err(Error::new(ErrorKind::InvalidData, format!("{name}: a name for no address")));
            }
            files.push(packed(&name, &fs::read(entry.path())?)?);
        }
    }
    Ok(())
}

/// One file. The same contents give the same bytes: the header holds no time.
///
/// # Errors
/// None that can occur in memory.
pub fn packed(name: &str, contents: &[u8]) -> io::Result<Packed> {
    let mut encoder = GzEncoder::new(vec![], Compression::best());
    encoder.write_all(contents)?;
    Ok(Packed { name: name.into(), content_type: content_type(name), gzip: encoder.finish()? })
}

/// By the ending; what is not known here is for no browser to guess.
fn content_type(name: &str) -> &'static str {
    match name.rsplit('.').next().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "wasm" => "application/wasm",
        "woff2" => "font/woff2",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "json" | "map" => "application/json",
        "txt" | "md" | "toml" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}
