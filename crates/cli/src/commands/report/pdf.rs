//! PDF through Typst: built in with the feature `pdf`, else as a program or a Python package, whichever is there.

use crate::failure::Failure;

/// The document as PDF.
///
/// # Errors
/// 5 if Typst refuses the document.
#[cfg(feature = "pdf")]
pub fn pdf(markup: &str) -> Result<Vec<u8>, Failure> {
    super::embedded::pdf(markup).map_err(|why| refused(&why))
}

/// The document as PDF.
///
/// # Errors
/// 4 if there is no Typst on this machine; 5 if it refuses the document.
#[cfg(not(feature = "pdf"))]
pub fn pdf(markup: &str) -> Result<Vec<u8>, Failure> {
    super::installed::pdf(markup).map_err(|why| refused(&why))?.ok_or_else(|| {
        Failure::Unsupported(
            "a PDF needs Typst, and there is none: install the program from https://typst.app, or `pip install typst`, or \
             build with `cargo build --release --features pdf`; -o with .html, .typ, .tex or .md needs nothing"
                .into(),
        )
    })
}

fn refused(why: &str) -> Failure {
    Failure::GaveUp(format!("Typst refuses the document: {why}"))
}
