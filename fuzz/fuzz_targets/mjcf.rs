//! Any text as a model of MuJoCo's, alone: it is refused with a reason and a place, or its poses and its chain can be computed, and
//! it can be written and read again.

#![no_main]

use denavit::description::{
    Alone, Convention, Decimals, read_mjcf, read_toml, render, write_mjcf, write_toml,
};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let (reading, files) = read_mjcf("model.xml", text, &mut Alone, Decimals::Meant);
    match reading {
        Err(findings) => {
            assert!(!findings.is_empty(), "refused without a reason");
            findings.iter().for_each(|f| assert!(!files.render(f).is_empty()));
        }
        Ok((mechanism, findings)) => {
            findings.iter().for_each(|f| assert!(!files.render(f).is_empty()));
            mechanism.poses(&vec![0.3; mechanism.variables().len()]);
            if let Ok(chain) = mechanism.chain(None, None, Convention::Standard) {
                let written = write_toml(&chain.description);
                if let Err(findings) = read_toml(&written) {
                    panic!("{}\n{written}", render(&findings, "written.toml", &written));
                }
            }
            let written = write_mjcf(&mechanism);
            let (again, files) = read_mjcf("written.xml", &written, &mut Alone, Decimals::Meant);
            if let Err(findings) = again {
                let all: String = findings.iter().map(|f| files.render(f)).collect();
                panic!("{all}\n{written}");
            }
        }
    }
});
