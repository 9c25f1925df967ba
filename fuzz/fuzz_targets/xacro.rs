//! Any text as a file for xacro to expand, with what stands behind a line `%%%` as a file of YAML: it is refused with a reason and a
//! place, or read.

#![no_main]

use denavit::description::{Convention, Decimals, Sources, read_xacro};
use libfuzzer_sys::fuzz_target;

/// The file of YAML, and one that is the text itself.
struct Two<'t> {
    text: &'t str,
    values: &'t str,
}

impl Sources for Two<'_> {
    fn open(&mut self, _: &str, wanted: &str) -> Result<(String, String), String> {
        let text = if wanted.ends_with("yaml") { self.values } else { self.text };
        Ok((wanted.into(), text.into()))
    }

    fn package(&mut self, _: &str) -> Option<String> {
        None
    }
}

fuzz_target!(|whole: &str| {
    let (text, values) = whole.split_once("\n%%%\n").unwrap_or((whole, "a: {b: [1, !degrees 2]}"));
    let arguments = [("name".to_string(), "arm".to_string())];
    let mut sources = Two { text, values };
    let (reading, files) = read_xacro("robot.xacro", text, &mut sources, &arguments, Decimals::Meant);
    match reading {
        Err(findings) => {
            assert!(!findings.is_empty(), "refused without a reason");
            findings.iter().for_each(|f| assert!(!files.render(f).is_empty()));
        }
        Ok((mechanism, _)) => {
            let _ = mechanism.chain(None, None, Convention::Craig);
        }
    }
});
