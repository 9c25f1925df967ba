//! A file that takes its name when it is whole.

use super::broken::unwritable;
use crate::MapError;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A file under another name beside its own; removed again unless it is kept.
pub struct Temporary {
    own: PathBuf,
    now: PathBuf,
    is_kept: bool,
}

impl Temporary {
    /// Begins one.
    ///
    /// # Errors
    /// If it cannot be made.
    pub fn new(own: &Path) -> Result<(Self, File), MapError> {
        let name = own.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let now = own.with_file_name(format!(".{name}.{}.tmp", std::process::id()));
        let mut options = File::options();
        let file = options.read(true).write(true).create(true).truncate(true).open(&now);
        let file = file.map_err(|why| unwritable(own, &why))?;
        Ok((Temporary { own: own.into(), now, is_kept: false }, file))
    }

    /// Gives it its name, once all of it is on the disk.
    ///
    /// # Errors
    /// If that cannot be done.
    pub fn keep(mut self, file: &File) -> Result<(), MapError> {
        file.sync_all().map_err(|why| unwritable(&self.own, &why))?;
        fs::rename(&self.now, &self.own).map_err(|why| unwritable(&self.own, &why))?;
        self.is_kept = true;
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if !self.is_kept {
            // There is nobody to tell.
            let _ = fs::remove_file(&self.now);
        }
    }
}
