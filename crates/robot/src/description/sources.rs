//! The files that a robot description names, and places in all of them together.
//!
//! The crate opens no file: who has them answers a [`Sources`]. A place is a byte of all texts read, one behind the other.

use super::diagnostic::Diagnostic;
use std::ops::Range;

/// Where the files are that a description names.
pub trait Sources {
    /// The text of a file that another names by a path from its own folder, or an absolute one; with the name that the
    /// file has from here on, which is the same however it is reached.
    ///
    /// # Errors
    /// A sentence that says why there is none.
    fn open(&mut self, from: &str, wanted: &str) -> Result<(String, String), String>;

    /// The names of the files in a folder that is named by a path from the folder of another file, or an absolute one.
    fn files(&mut self, _from: &str, _folder: &str) -> Vec<String> {
        vec![]
    }

    /// The folder of a package.
    fn package(&mut self, name: &str) -> Option<String>;

    /// The value of a variable of the environment.
    fn variable(&self, _name: &str) -> Option<String> {
        None
    }

    /// The name by which [`open`](Sources::open) gives a file: that of the first file may be another way to it.
    fn canonical(&self, name: &str) -> String {
        name.into()
    }
}

/// No other file.
#[derive(Clone, Copy, Default, Debug)]
pub struct Alone;

impl Sources for Alone {
    fn open(&mut self, _: &str, wanted: &str) -> Result<(String, String), String> {
        Err(format!("`{wanted}` is another file"))
    }

    fn package(&mut self, _: &str) -> Option<String> {
        None
    }
}

/// The texts that were read, the first one first.
#[derive(Clone, Default, Debug)]
pub struct Files {
    all: Vec<File>,
}

#[derive(Clone, Debug)]
struct File {
    name: String,
    text: String,
    start: usize,
}

impl Files {
    /// Adds a text, and gives its number and the place of its first byte.
    pub(super) fn add(&mut self, name: String, text: String) -> (usize, usize) {
        // A place behind the end of a text is still one of it.
        let start = self.all.last().map_or(0, |f| f.start + f.text.len() + 1);
        self.all.push(File { name, text, start });
        (self.all.len() - 1, start)
    }

    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    pub(super) fn name(&self, file: usize) -> &str {
        &self.all[file].name
    }

    /// The text of a file.
    pub fn text(&self, file: usize) -> &str {
        &self.all[file].text
    }

    /// The name and the text of the file that holds a place, and the place in it.
    pub fn locate(&self, span: &Range<usize>) -> Option<(&str, &str, Range<usize>)> {
        let file = self.all.iter().rev().find(|f| f.start <= span.start)?;
        let end = span.end.saturating_sub(file.start).min(file.text.len());
        Some((&file.name, &file.text, span.start - file.start..end))
    }

    /// `file:line:column` of a place.
    pub fn place(&self, span: &Range<usize>) -> String {
        self.locate(span).map_or_else(String::new, |(name, text, span)| {
            let (line, column) = super::diagnostic::line_column(text, span.start);
            format!("{name}:{line}:{column}")
        })
    }

    /// A finding as text, see [`Diagnostic::render`].
    pub fn render(&self, finding: &Diagnostic) -> String {
        self.locate(&finding.span).map_or_else(String::new, |(name, text, span)| {
            Diagnostic { span, ..finding.clone() }.render(name, text)
        })
    }
}
