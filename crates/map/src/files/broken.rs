//! What is said of files that cannot be read or written.

use crate::MapError;
use std::fmt::Display;
use std::path::Path;

/// A file cannot be read.
pub fn unreadable(path: &Path, why: &dyn Display) -> MapError {
    MapError::new(format!("{}: {why}", path.display()), "is it there, and may it be read?")
}

/// A file cannot be written.
pub fn unwritable(path: &Path, why: &dyn Display) -> MapError {
    MapError::new(format!("{}: {why}", path.display()), "is there room, and may it be written?")
}

/// A file is not what it seems to be.
pub fn broken(path: &Path, why: &dyn Display) -> MapError {
    let what = why.to_string();
    // Compressions that need a library in C are not built in.
    let hint = if what.contains("IPC") && what.contains("feature") {
        "write it without compression"
    } else if what.contains("feature") || what.contains("ompression") {
        "write it with compression snappy, gzip or none"
    } else {
        "was it copied whole?"
    };
    MapError::new(format!("{} cannot be read: {what}", path.display()), hint)
}
