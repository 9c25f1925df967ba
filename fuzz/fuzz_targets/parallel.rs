//! Any text as the file of a parallel robot: findings are shown, and what is read has numbers.

#![no_main]

use denavit::description::{read_parallel, read_robot, render};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    match read_parallel(text) {
        None => {}
        Some(Err(findings)) => {
            assert!(!findings.is_empty(), "refused without a reason");
            render(&findings, "robot.toml", text);
        }
        Some(Ok((parallel, findings))) => {
            render(&findings, "robot.toml", text);
            let _ = parallel.numbers();
            assert!(read_robot(text).is_err(), "one kind of file alone");
        }
    }
});
