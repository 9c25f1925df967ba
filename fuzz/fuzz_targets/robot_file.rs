//! Any text as a robot file: what is read is written, read again, and is the same; its findings are shown.

#![no_main]

use denavit::description::{read_toml, render, write_toml};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    match read_toml(text) {
        Err(findings) => {
            assert!(!findings.is_empty(), "refused without a reason");
            render(&findings, "robot.toml", text);
        }
        Ok((description, findings)) => {
            render(&findings, "robot.toml", text);
            let written = write_toml(&description);
            match read_toml(&written) {
                Ok((again, _)) => assert_eq!(write_toml(&again), written),
                Err(findings) => panic!("{}\n{written}", render(&findings, "written.toml", &written)),
            }
        }
    }
});
