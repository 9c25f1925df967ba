//! The Typst library, built in: one document held in memory and the fonts of `typst-assets`; no files, no packages, no
//! clock. The same markup gives the same bytes.

use typst::diag::{FileError, FileResult, SourceDiagnostic, Warned};
use typst::foundations::{Bytes, Datetime};
use typst::layout::PagedDocument;
use typst::syntax::{FileId, Source};
use typst::text::{Font, FontBook};
use typst::utils::LazyHash;
use typst::{Library, LibraryExt, World};
use typst_pdf::PdfOptions;

/// Of what is wrong, this much is said.
const SAID: usize = 3;

/// The document as PDF.
///
/// # Errors
/// What is wrong with the markup and in which lines, if it is no document.
pub fn pdf(markup: &str) -> Result<Vec<u8>, String> {
    let world = Memory::new(markup);
    let Warned { output, .. } = typst::compile::<PagedDocument>(&world);
    // As they are, the options give no date, and an identifier that is a hash of the document.
    output
        .and_then(|document| typst_pdf::pdf(&document, &PdfOptions::default()))
        .map_err(|found| in_words(&world.main, &found))
}

fn in_words(source: &Source, found: &[SourceDiagnostic]) -> String {
    let mut words: Vec<String> = found.iter().take(SAID).map(|d| line(source, d)).collect();
    if found.len() > SAID {
        words.push(format!("and {} more", found.len() - SAID));
    }
    words.join("; ")
}

fn line(source: &Source, diagnostic: &SourceDiagnostic) -> String {
    let start = source.range(diagnostic.span).map(|r| r.start);
    match start.and_then(|at| source.lines().byte_to_line(at)) {
        Some(line) => format!("line {}: {}", line + 1, diagnostic.message),
        None => diagnostic.message.to_string(),
    }
}

/// All that Typst may see.
struct Memory {
    main: Source,
    library: LazyHash<Library>,
    book: LazyHash<FontBook>,
    fonts: Vec<Font>,
}

impl Memory {
    fn new(markup: &str) -> Memory {
        let fonts: Vec<Font> = typst_assets::fonts().flat_map(|f| Font::iter(Bytes::new(f))).collect();
        Memory {
            main: Source::detached(markup),
            library: LazyHash::new(Library::default()),
            book: LazyHash::new(FontBook::from_fonts(&fonts)),
            fonts,
        }
    }
}

impl World for Memory {
    fn library(&self) -> &LazyHash<Library> {
        &self.library
    }

    fn book(&self) -> &LazyHash<FontBook> {
        &self.book
    }

    fn main(&self) -> FileId {
        self.main.id()
    }

    fn source(&self, id: FileId) -> FileResult<Source> {
        if id == self.main.id() { Ok(self.main.clone()) } else { Err(absent(id)) }
    }

    fn file(&self, id: FileId) -> FileResult<Bytes> {
        Err(absent(id))
    }

    fn font(&self, index: usize) -> Option<Font> {
        self.fonts.get(index).cloned()
    }

    fn today(&self, _offset: Option<i64>) -> Option<Datetime> {
        None
    }
}

fn absent(id: FileId) -> FileError {
    FileError::NotFound(id.vpath().as_rootless_path().to_path_buf())
}

#[cfg(test)]
mod tests {
    use super::pdf;

    #[test]
    fn the_same_markup_gives_the_same_bytes() {
        let markup = "#set document(title: \"An arm\", date: none)\n= Joints\n$ theta_1 = pi / 2 $";
        let bytes = pdf(markup).unwrap();
        assert!(bytes.starts_with(b"%PDF"));
        assert_eq!(bytes, pdf(markup).unwrap());
    }

    #[test]
    fn a_refusal_says_what_and_where() {
        assert_eq!(pdf("= Joints\n#nothing"), Err("line 2: unknown variable: nothing".into()));
        let many = pdf("#(1 +)\n#(2 +)\n#(3 +)\n#(4 +)\n#(5 +)").unwrap_err();
        assert_eq!(many.matches("expected expression").count(), 3, "{many}");
        assert!(many.ends_with("; and 2 more"), "{many}");
    }

    #[test]
    fn there_is_nothing_beside_the_document() {
        for markup in ["#read(\"x.txt\")", "#include \"x.typ\"", "#import \"@preview/cetz:0.4.0\""] {
            assert!(pdf(markup).is_err(), "{markup}");
        }
    }
}
