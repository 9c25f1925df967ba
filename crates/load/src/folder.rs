//! The files that a robot description names, where they lie.

use denavit::description::{MAX_XML_BYTES, Sources};
use std::fs;
use std::path::{Component, Path, PathBuf};

/// A folder with more files is not looked through.
const MOST_FILES: usize = 100_000;
/// How many folders above a file are looked through for packages.
const MOST_ABOVE: usize = 12;

/// Files below the folder of the first one, below its packages, and below those that are named.
pub struct Folder {
    /// The folders that may be read from.
    roots: Vec<PathBuf>,
    /// Packages that were named.
    named: Vec<(String, PathBuf)>,
    /// Folders with packages in them.
    around: Vec<PathBuf>,
    /// What was asked for and found.
    pub found: Found,
}

/// Files and packages that were found, by paths without links and dots.
#[derive(Default)]
pub struct Found {
    /// Texts by path.
    pub texts: Vec<(String, String)>,
    /// Folders of packages by name.
    pub packages: Vec<(String, String)>,
}

impl Folder {
    /// Around a file; `packages` are those that the command line names.
    pub fn around(file: &str, packages: &[(String, PathBuf)]) -> Self {
        let file = fs::canonicalize(file).unwrap_or_else(|_| file.into());
        let mut around = vec![];
        let mut roots = vec![];
        for above in file.ancestors().skip(1).take(MOST_ABOVE) {
            // A package and what lies beside it.
            if above.join("package.xml").is_file() {
                roots.push(above.to_path_buf());
                around.extend(above.parent().map(Path::to_path_buf));
            }
        }
        roots.extend(file.parent().map(Path::to_path_buf));
        for (variable, inside) in [("ROS_PACKAGE_PATH", ""), ("AMENT_PREFIX_PATH", "share")] {
            let paths = std::env::var_os(variable).unwrap_or_default();
            around.extend(std::env::split_paths(&paths).filter(|p| p.is_dir()).map(|p| p.join(inside)));
        }
        let named: Vec<_> =
            packages.iter().filter_map(|(n, p)| Some((n.clone(), fs::canonicalize(p).ok()?))).collect();
        roots.extend(named.iter().map(|n| n.1.clone()));
        Folder { roots, named, around, found: Found::default() }
    }
}

impl Sources for Folder {
    fn open(&mut self, from: &str, wanted: &str) -> Result<(String, String), String> {
        let wanted_path = Path::new(wanted.strip_prefix("file://").unwrap_or(wanted));
        let beside = Path::new(from).parent().unwrap_or(Path::new("."));
        let path = fs::canonicalize(beside.join(wanted_path)).map_err(|e| format!("`{wanted}`: {e}"))?;
        if !self.roots.iter().any(|root| path.starts_with(root)) {
            return Err(format!("`{wanted}` lies outside of the folders of the robot and its packages"));
        }
        let size = fs::metadata(&path).map_err(|e| format!("`{wanted}`: {e}"))?.len();
        if size > MAX_XML_BYTES as u64 {
            return Err(format!("`{wanted}` has {size} bytes; {MAX_XML_BYTES} are allowed"));
        }
        let bytes = fs::read(&path).map_err(|e| format!("`{wanted}`: {e}"))?;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        for name in [plain(&beside.join(wanted_path)), plain(&path)] {
            if !self.found.texts.iter().any(|(known, _)| *known == name) {
                self.found.texts.push((name, text.clone()));
            }
        }
        Ok((path.to_string_lossy().into_owned(), text))
    }

    fn files(&mut self, from: &str, folder: &str) -> Vec<String> {
        let beside = Path::new(from).parent().unwrap_or(Path::new("."));
        let folder = fs::canonicalize(beside.join(folder.strip_prefix("file://").unwrap_or(folder))).ok();
        let inside = folder.filter(|f| self.roots.iter().any(|root| f.starts_with(root)));
        let entries = inside.and_then(|f| fs::read_dir(f).ok());
        let file =
            |entry: fs::DirEntry| entry.file_name().into_string().ok().filter(|_| entry.path().is_file());
        let files = entries.into_iter().flatten().filter_map(Result::ok).filter_map(file);
        let files: Vec<String> = files.take(MOST_FILES + 1).collect();
        // In which order they come is chance: all, or none.
        if files.len() > MOST_FILES { vec![] } else { files }
    }

    fn package(&mut self, name: &str) -> Option<String> {
        let is_plain = !name.is_empty() && !name.contains(['/', '\\']) && name != "." && name != "..";
        if !is_plain {
            return None;
        }
        let named = self.named.iter().find(|n| n.0 == name).map(|n| n.1.clone());
        let own = self.roots.iter().find(|r| names(r, name)).cloned();
        let beside = || self.around.iter().map(|a| a.join(name)).find(|p| p.is_dir());
        let found = named.or(own).or_else(beside)?;
        let found = fs::canonicalize(found).ok()?;
        if !self.roots.contains(&found) {
            self.roots.push(found.clone());
        }
        let folder = found.to_string_lossy().into_owned();
        if !self.found.packages.iter().any(|(known, _)| known == name) {
            self.found.packages.push((name.into(), plain(&found)));
        }
        Some(folder)
    }

    fn variable(&self, name: &str) -> Option<String> {
        std::env::var(name).ok()
    }

    fn canonical(&self, name: &str) -> String {
        fs::canonicalize(name).map_or_else(|_| name.into(), |path| path.to_string_lossy().into_owned())
    }
}

impl Folder {
    /// A mesh that a description names, and its path; nothing if there is none below the folders of the robot and its packages.
    pub fn mesh(&mut self, from: &str, wanted: &str) -> Option<(String, PathBuf)> {
        let in_package = wanted.strip_prefix("package://").or_else(|| wanted.strip_prefix("model://"));
        let (roots, named) = match in_package.and_then(|name| name.split_once('/')) {
            Some((package, rest)) => {
                let folder = PathBuf::from(self.package(package)?);
                let path = folder.join(rest.trim_start_matches('/'));
                (vec![folder], path)
            }
            None => {
                let beside = Path::new(from).parent().unwrap_or(Path::new("."));
                (self.roots.clone(), beside.join(wanted.strip_prefix("file://").unwrap_or(wanted)))
            }
        };
        let path = fs::canonicalize(&named).ok().filter(|p| p.is_file())?;
        roots.iter().any(|root| path.starts_with(root)).then(|| (plain(&named), path))
    }
}

/// A path from the top without dots, words between slashes.
pub fn plain(path: &Path) -> String {
    let mut parts: Vec<String> = vec![];
    for part in path.components() {
        match part {
            Component::Normal(_) | Component::Prefix(_) => {
                parts.push(part.as_os_str().to_string_lossy().replace('\\', "/"));
            }
            Component::ParentDir => {
                parts.pop();
            }
            Component::CurDir | Component::RootDir => {}
        }
    }
    parts.join("/")
}

/// True if a folder is the package of a name: by its `package.xml`, or its own name.
fn names(folder: &Path, name: &str) -> bool {
    let tag = format!("<name>{name}</name>");
    let said = fs::read_to_string(folder.join("package.xml"))
        .is_ok_and(|text| text.replace([' ', '\n'], "").contains(&tag));
    said || folder.file_name().is_some_and(|n| n == name)
}
