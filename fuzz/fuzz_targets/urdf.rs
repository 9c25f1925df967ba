//! Any text as a URDF: it is refused with a reason, or its poses and its chain can be computed; findings are shown.

#![no_main]

use denavit::description::{Convention, Decimals, read_toml, read_urdf, render, write_toml};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    match read_urdf(text, Decimals::Meant) {
        Err(findings) => {
            assert!(!findings.is_empty(), "refused without a reason");
            render(&findings, "robot.urdf", text);
        }
        Ok((mechanism, findings)) => {
            render(&findings, "robot.urdf", text);
            mechanism.poses(&vec![0.3; mechanism.variables().len()]);
            if let Ok(chain) = mechanism.chain(None, None, Convention::Standard) {
                let written = write_toml(&chain.description);
                if let Err(findings) = read_toml(&written) {
                    panic!("{}\n{written}", render(&findings, "written.toml", &written));
                }
            }
        }
    }
});
