//! Any text as a table of a document, in each kind and each way to understand its numbers; what is read is written as
//! a robot file, which reads back.

#![no_main]

use denavit::Description;
use denavit::description::{Convention, Diagnostic, TableKind, TableOptions};
use denavit::description::{read_table, read_toml, render, write_toml};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (u8, &str)| {
    let (choice, text) = input;
    let bit = |n: u8| (choice >> n) & 1 == 1;
    let options = TableOptions {
        convention: Some(Convention::ALL[usize::from(choice) % 3]),
        angles_in_degrees: bit(2).then_some(bit(3)),
        lengths_in_millimetres: bit(4).then_some(bit(5)),
        table: bit(6).then_some(1),
        ..TableOptions::default()
    };
    for kind in [TableKind::Markdown, TableKind::Csv, TableKind::Latex] {
        check(text, read_table(text, kind, &options));
    }
    check(text, read_table(text, TableKind::Markdown, &TableOptions::default()));
});

fn check(text: &str, result: Result<(Description, Vec<Diagnostic>), Vec<Diagnostic>>) {
    match result {
        Err(findings) => {
            assert!(!findings.is_empty(), "refused without a reason");
            render(&findings, "table.md", text);
        }
        Ok((description, findings)) => {
            render(&findings, "table.md", text);
            let written = write_toml(&description);
            if let Err(findings) = read_toml(&written) {
                panic!("{}\n{written}", render(&findings, "written.toml", &written));
            }
        }
    }
}
