//! Any text as a document of printed formulas about an arm, in every format.

#![no_main]

use denavit::catalogue;
use denavit_check::{Options, check};
use denavit_reading::code::Language;
use denavit_reading::document::Format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Some(robot) = catalogue::robot("staubli-rx90") else { return };
    for format in [Format::Markdown, Format::Latex, Format::Plain, Format::Toml] {
        let _ = check(text, format, Some(&robot), &Options::default());
        let _ = check(text, format, None, &Options::default());
    }
    for language in [Language::Python, Language::Matlab] {
        let options = Options { language: Some(language), ..Options::default() };
        let _ = check(text, Format::Plain, Some(&robot), &options);
    }
});
