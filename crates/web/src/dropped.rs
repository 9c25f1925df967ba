//! Files that were dropped on the page, or that the server of the page found: a folder in memory.
//!
//! A path is words between slashes; `.` and `..` are resolved before anything is looked up, and never lead out of the folder.

use denavit::description::{MAX_XML_BYTES, Sources};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};

/// What lies around a description.
#[derive(Deserialize, Default)]
#[serde(default)]
pub struct Lying {
    /// The texts that it may include, by path.
    texts: Vec<(String, String)>,
    /// Where packages are that are named otherwise than their folders.
    packages: Vec<(String, String)>,
    /// The paths of files that are no texts.
    others: Vec<String>,
}

/// Files by their paths.
pub struct Dropped<'a> {
    texts: BTreeMap<String, &'a str>,
    others: BTreeSet<String>,
    packages: BTreeMap<String, String>,
}

impl<'a> Dropped<'a> {
    /// These files; packages are folders with a `package.xml`, or of the name.
    pub fn new(lying: &'a Lying) -> Self {
        let texts: BTreeMap<String, &str> =
            lying.texts.iter().filter_map(|(p, t)| Some((within("", p)?, t.as_str()))).collect();
        let others: BTreeSet<String> = lying.others.iter().filter_map(|p| within("", p)).collect();
        let mut packages = BTreeMap::new();
        for path in texts.keys().chain(&others) {
            // The outermost folder of a name counts.
            for (end, _) in path.match_indices('/') {
                let folder = &path[..end];
                let name = folder.rsplit('/').next().unwrap_or(folder);
                packages.entry(name.to_string()).or_insert_with(|| folder.to_string());
            }
        }
        for (path, text) in &texts {
            let folder = path.strip_suffix("package.xml").map(|f| f.trim_end_matches('/'));
            let name = text.split_once("<name>").and_then(|(_, rest)| rest.split_once("</name>"));
            if let (Some(folder), Some((name, _))) = (folder, name) {
                packages.insert(name.trim().into(), folder.into());
            }
        }
        let named = lying.packages.iter().filter_map(|(n, p)| Some((n.clone(), within("", p)?)));
        packages.extend(named);
        Dropped { texts, others, packages }
    }
}

impl Dropped<'_> {
    /// The path of a mesh that a description names: in a package, or by a path from its own folder; nothing if it is not there.
    pub fn mesh(&self, from: &str, wanted: &str) -> Option<String> {
        let path = match Self::in_package(wanted) {
            Some((package, rest)) => {
                let Some(folder) = self.packages.get(package) else { return self.by_tail(rest) };
                let path = within(folder, rest.trim_start_matches('/'))?;
                // A package is left by no name.
                path.strip_prefix(folder.as_str()).is_some_and(|p| p.starts_with('/')).then_some(path)?
            }
            None => within(parent(from), wanted.strip_prefix("file://").unwrap_or(wanted))?,
        };
        self.others.contains(&path).then_some(path)
    }

    /// A mesh of a package that is not there as such: the one file whose path ends as its name does, with a folder at least.
    fn by_tail(&self, rest: &str) -> Option<String> {
        let rest = within("", rest)?;
        let mut tail = rest.as_str();
        while tail.contains('/') {
            let ends = |path: &&String| {
                path.strip_suffix(tail).is_some_and(|top| top.is_empty() || top.ends_with('/'))
            };
            let mut found = self.others.iter().filter(ends);
            match (found.next(), found.next()) {
                (Some(path), None) => return Some(path.clone()),
                (Some(_), Some(_)) => return None,
                (None, _) => tail = tail.split_once('/')?.1,
            }
        }
        None
    }

    /// The package that the name of a file names.
    pub fn package_named(wanted: &str) -> Option<&str> {
        Self::in_package(wanted).map(|(package, _)| package)
    }

    fn in_package(wanted: &str) -> Option<(&str, &str)> {
        let name = wanted.strip_prefix("package://").or_else(|| wanted.strip_prefix("model://"))?;
        name.split_once('/')
    }
}

impl Sources for Dropped<'_> {
    fn open(&mut self, from: &str, wanted: &str) -> Result<(String, String), String> {
        let wanted = wanted.strip_prefix("file://").unwrap_or(wanted);
        let path = within(parent(from), wanted)
            .ok_or_else(|| format!("`{wanted}` lies outside of what was dropped"))?;
        match self.texts.get(&path) {
            Some(text) if text.len() > MAX_XML_BYTES => {
                Err(format!("`{wanted}` has {} bytes; {MAX_XML_BYTES} are allowed", text.len()))
            }
            Some(text) => Ok((path, (*text).to_string())),
            None if self.others.contains(&path) => Err(format!("`{wanted}` is no text")),
            None => Err(format!("`{wanted}` is not among the files: open its whole folder")),
        }
    }

    fn files(&mut self, from: &str, folder: &str) -> Vec<String> {
        let Some(folder) = within(parent(from), folder) else { return vec![] };
        let top = if folder.is_empty() { folder } else { format!("{folder}/") };
        let name = |path: &String| path.strip_prefix(&top).filter(|n| !n.contains('/')).map(str::to_string);
        self.texts.keys().filter_map(name).collect()
    }

    fn package(&mut self, name: &str) -> Option<String> {
        // An absolute path is one from the top of what was dropped.
        self.packages.get(name).map(|folder| format!("/{folder}"))
    }

    fn canonical(&self, name: &str) -> String {
        within("", name).unwrap_or_else(|| name.into())
    }
}

/// The folder of a file.
fn parent(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// The path of a file from the top, named from a folder; nothing if it leads out.
fn within(folder: &str, path: &str) -> Option<String> {
    let path = path.replace('\\', "/");
    let mut parts: Vec<&str> = if path.starts_with('/') { vec![] } else { folder.split('/').collect() };
    for part in path.split('/') {
        match part {
            ".." => {
                parts.retain(|p| !p.is_empty() && *p != ".");
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    parts.retain(|p| !p.is_empty() && *p != ".");
    Some(parts.join("/"))
}
