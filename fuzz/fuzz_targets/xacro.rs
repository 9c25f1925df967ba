//! Any text as a file for xacro to expand, alone: it is refused with a reason and a place, or read.

#![no_main]

use denavit::description::{Alone, Convention, Decimals, read_xacro};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let arguments = [("name".to_string(), "arm".to_string())];
    let (reading, files) = read_xacro("robot.xacro", text, &mut Alone, &arguments, Decimals::Meant);
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
