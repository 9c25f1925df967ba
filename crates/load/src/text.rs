//! The bytes of files and of standard input.

use denavit::description::MAX_XML_BYTES;
use denavit_reading::document::readable;
use std::fs::File;
use std::io::{self, Read};
use std::sync::OnceLock;

/// The text of a file or of standard input (`-`), bounded (one byte more says that there are more), whatever its bytes are; a document
/// of Typst as it is read.
///
/// # Errors
/// If it cannot be read.
pub fn contents(name: &str, most: usize) -> io::Result<String> {
    Ok(readable(name, String::from_utf8_lossy(&bytes(name, most)?).into_owned()))
}

/// The bytes of a file or of standard input (`-`), at most one more than `most`.
///
/// # Errors
/// If it cannot be read.
pub fn bytes(name: &str, most: usize) -> io::Result<Vec<u8>> {
    if name == "-" {
        let all = standard_input()?;
        return Ok(all[..all.len().min(most + 1)].to_vec());
    }
    let mut bytes = vec![];
    File::open(name)?.take(most as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// All of standard input, up to what the largest kind of file may have: it can be read but once.
fn standard_input() -> io::Result<&'static [u8]> {
    static ALL: OnceLock<Result<Vec<u8>, io::ErrorKind>> = OnceLock::new();
    let all = ALL.get_or_init(|| {
        let mut bytes = vec![];
        let read = io::stdin().lock().take(MAX_XML_BYTES as u64 + 1).read_to_end(&mut bytes);
        read.map(|_| bytes).map_err(|e| e.kind())
    });
    all.as_deref().map_err(|kind| io::Error::from(*kind))
}
