//! What is served: the files of the page and the robot that it is opened with, all in memory.

use super::packing::{Packed, pack, packed};
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Error, ErrorKind, Read};
use std::path::{Path, PathBuf};

/// The file that the address of the page itself stands for.
const INDEX: &str = "index.html";
/// The file of the robot that the page is opened with: a table, or a tree with all that belongs to it.
const ROBOT: &str = "robot.toml";
const TREE: &str = "robot.json";

/// A row of the table in the program: name, content type, contents compressed.
pub type Row = (&'static str, &'static str, &'static [u8]);

/// The page in the program, or nothing; `build.rs` writes the table.
static EMBEDDED: &[Row] = include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// A file that is served.
pub struct File {
    /// The value of `Content-Type`.
    pub content_type: &'static str,
    /// Its contents, compressed by gzip.
    pub gzip: Cow<'static, [u8]>,
}

impl File {
    /// Its contents.
    ///
    /// # Errors
    /// If it was not compressed by gzip.
    pub fn plain(&self) -> io::Result<Vec<u8>> {
        let mut contents = vec![];
        GzDecoder::new(&self.gzip[..]).read_to_end(&mut contents)?;
        Ok(contents)
    }
}

/// All files by name; no other name can be asked for.
pub struct Site {
    files: BTreeMap<String, File>,
}

impl Site {
    /// The page in the program; `None` if it was built without.
    pub fn embedded() -> Option<Site> {
        let rows = EMBEDDED.iter().map(|&(name, content_type, gzip)| {
            (name.to_string(), File { content_type, gzip: Cow::Borrowed(gzip) })
        });
        let files: BTreeMap<_, _> = rows.collect();
        (!files.is_empty()).then_some(Site { files })
    }

    /// The page in a folder, as it is now.
    ///
    /// # Errors
    /// If it cannot be read, or has no index.
    pub fn of_folder(folder: &Path) -> io::Result<Site> {
        let site = Site::of(pack(folder)?);
        if !site.files.contains_key(INDEX) {
            return Err(Error::new(ErrorKind::NotFound, format!("no {INDEX} in it")));
        }
        Ok(site)
    }

    /// These files.
    pub fn of(files: Vec<Packed>) -> Site {
        let owned = |f: Packed| (f.name, File { content_type: f.content_type, gzip: Cow::Owned(f.gzip) });
        Site { files: files.into_iter().map(owned).collect() }
    }

    /// The page opened with a robot, the text of a robot file: the index names the file, and the file is there.
    ///
    /// # Errors
    /// If the index has no head to name it in.
    pub fn with_robot(self, text: &str) -> io::Result<Site> {
        self.opened_with(ROBOT, text)
    }

    /// The page opened with a tree, the JSON of a bundle; its meshes are read now, and have numbers for names.
    ///
    /// # Errors
    /// If the index has no head, or a mesh cannot be read.
    pub fn with_tree(self, bundle: &str, meshes: &[PathBuf]) -> io::Result<Site> {
        let mut site = self.opened_with(TREE, bundle)?;
        for (number, path) in meshes.iter().enumerate() {
            // Many bytes, compressed for a short way: quickly.
            let mut encoder = GzEncoder::new(vec![], Compression::fast());
            io::copy(&mut fs::File::open(path)?, &mut encoder)?;
            let file = File { content_type: "application/octet-stream", gzip: Cow::Owned(encoder.finish()?) };
            site.files.insert(format!("mesh/{number}"), file);
        }
        Ok(site)
    }

    fn opened_with(mut self, name: &str, text: &str) -> io::Result<Site> {
        const HEAD: &str = "<head>";
        let index = self.files.get(INDEX).map_or(Ok(vec![]), File::plain)?;
        let index = String::from_utf8_lossy(&index);
        if !index.contains(HEAD) {
            return Err(Error::new(ErrorKind::InvalidData, format!("{INDEX} has no {HEAD}")));
        }
        let mention = format!(
            r#"{HEAD}
<meta name="denavit-robot" content="{name}">"#
        );
        let index = index.replacen(HEAD, &mention, 1);
        let changed = vec![packed(INDEX, index.as_bytes())?, packed(name, text.as_bytes())?];
        self.files.extend(Site::of(changed).files);
        Ok(self)
    }

    /// The file of that name, letter by letter; no name is the index.
    pub fn file(&self, name: &str) -> Option<&File> {
        self.files.get(if name.is_empty() { INDEX } else { name })
    }
}
