//! Any text as a `.par` file: it is refused with a reason, or what it describes has chains and is written again.

#![no_main]

use denavit::description::{Convention, Decimals, Described, read_par, render, write_linkage_par, write_par};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    match read_par(text, Decimals::Meant) {
        Err(findings) => {
            assert!(!findings.is_empty(), "refused without a reason");
            render(&findings, "robot.par", text);
        }
        Ok((read, findings)) => {
            render(&findings, "robot.par", text);
            let file = match &read {
                Described::Linkage(linkage) => {
                    let _ = linkage.chain(None, None, None, Convention::Standard);
                    write_linkage_par(linkage)
                }
                Described::Tree(tree) => {
                    let _ = tree.chain(None, None, Convention::Standard);
                    write_par(tree)
                }
                Described::Chain(_) => return,
            };
            if let Ok(file) = file
                && let Err(findings) = read_par(&file.text, Decimals::Meant)
            {
                panic!("{}\n{}", render(&findings, "written.par", &file.text), file.text);
            }
        }
    }
});
