//! Any text as a `.par` file: it is refused with a reason, or its tree has chains and is written again.

#![no_main]

use denavit::description::{Convention, Decimals, read_par, render, write_par};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    match read_par(text, Decimals::Meant) {
        Err(findings) => {
            assert!(!findings.is_empty(), "refused without a reason");
            render(&findings, "robot.par", text);
        }
        Ok((tree, findings)) => {
            render(&findings, "robot.par", text);
            let _ = tree.chain(None, None, Convention::Standard);
            if let Ok(file) = write_par(&tree)
                && let Err(findings) = read_par(&file.text, Decimals::Meant)
            {
                panic!("{}\n{}", render(&findings, "written.par", &file.text), file.text);
            }
        }
    }
});
