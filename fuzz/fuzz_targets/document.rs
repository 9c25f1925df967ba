//! Any text as a document of printed formulas about an arm, in every format.

#![no_main]

use denavit::catalogue;
use denavit_check::{CheckOptions, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Some(robot) = catalogue::robot("staubli-rx90") else { return };
    for format in [Format::Markdown, Format::Latex, Format::Plain, Format::Toml] {
        let _ = check(text, format, Some(&robot), &CheckOptions::default());
        let _ = check(text, format, None, &CheckOptions::default());
    }
    for language in [Dialect::Python, Dialect::Matlab] {
        let options = CheckOptions { language: Some(language), ..CheckOptions::default() };
        let _ = check(text, Format::Plain, Some(&robot), &options);
    }
});
