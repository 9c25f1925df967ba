//! Folders: what lies in them, and copies of it.

use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// All files below a folder, in order.
///
/// # Errors
/// If a folder cannot be read.
pub fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = vec![];
    for entry in fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let entry = entry?.path();
        if entry.is_dir() { found.extend(files(&entry)?) } else { found.push(entry) }
    }
    found.sort();
    Ok(found)
}

/// Copies all files of a folder to another, which has no others then.
///
/// # Errors
/// If a file cannot be copied, or the other folder not be emptied.
pub fn copied(from: &Path, to: &Path) -> Result<()> {
    if to.exists() {
        fs::remove_dir_all(to)?;
    }
    beside(from, to)
}

/// Copies all files of a folder to another, beside those that it has.
///
/// # Errors
/// If a file cannot be copied.
pub fn beside(from: &Path, to: &Path) -> Result<()> {
    for file in files(from)? {
        let copy = to.join(file.strip_prefix(from)?);
        fs::create_dir_all(copy.parent().context("a folder")?)?;
        fs::copy(&file, copy).with_context(|| file.display().to_string())?;
    }
    Ok(())
}
