//! Where the programs of a document stand.

use super::CheckOptions;
use denavit_reading::code::Dialect;
use denavit_reading::document::{CodeBlock, Document};
use std::ops::Range;

/// The programs of a document, or the one that it is.
pub(super) fn programs(
    text: &str,
    document: &Document,
    options: &CheckOptions,
) -> Vec<(Range<usize>, Dialect)> {
    if let Some(language) = options.language {
        return vec![(0..text.len(), language)];
    }
    let of = |block: &CodeBlock| {
        let language = match block.language.as_str() {
            "python" | "py" | "python3" | "numpy" => Dialect::Python,
            "matlab" | "octave" | "m" => Dialect::Matlab,
            "c" | "cpp" | "c++" | "arduino" | "ino" => Dialect::C,
            _ => return None,
        };
        let is_skipped = block
            .directives
            .iter()
            .any(|d| matches!(d.words.split_whitespace().next(), Some("skip" | "off")));
        (!is_skipped).then(|| (block.span.clone(), language))
    };
    document.code.iter().filter_map(of).collect()
}

/// Where what a block of a program shows may stand: up to the next block of a language.
pub(super) fn outputs(text: &str, document: &Document, blocks: &[Range<usize>]) -> Vec<Range<usize>> {
    let next = |end: usize| {
        let later = document.code.iter().filter(|c| c.span.start > end && !c.language.is_empty());
        later.map(|c| c.span.start).min().unwrap_or(text.len())
    };
    blocks.iter().map(|b| b.end..next(b.end)).collect()
}
