//! Parts that are there are not computed again, and what they become is what one run writes.

use super::common::{fk, folder, job, mapping, read, run, write};
use denavit_map::files::{Job, Summary, run as map};
use denavit_map::{Keep, MapError, Request};
use std::fs;

fn mapped(job: &Job, request: &Request) -> Result<Summary, MapError> {
    map(job, &mapping(request), &mut |_, _| {})
}

#[test]
fn parts_that_are_there_stay() {
    let at = folder("resume");
    let (input, once, output) = (at.join("in.parquet"), at.join("once.parquet"), at.join("out.parquet"));
    write(&input, &[run(500_000, 6)], 100_000);
    mapped(&job(&input, &once), &fk()).expect("mapped");
    let resuming = Job { resume: Some("fk".into()), ..job(&input, &output) };
    // Stopped in the middle: nothing takes the name of the result, and the parts are there.
    let mut parts = 0;
    let stopped = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        map(&resuming, &mapping(&fk()), &mut |_, _| {
            parts += 1;
            assert!(parts < 3, "stopped");
        })
    }));
    assert!(stopped.is_err());
    assert!(!output.exists());
    let folder = at.join("out.parquet.parts");
    let there = fs::read_dir(&folder)
        .expect("a folder")
        .filter(|e| e.as_ref().is_ok_and(|e| e.file_name().to_string_lossy().starts_with("part-")));
    let there = there.count();
    assert!(there >= 3);
    // A part that is cut off is computed again.
    let first = folder.join("part-000000.parquet");
    let bytes = fs::read(&first).expect("a part");
    fs::write(&first, &bytes[..bytes.len() / 2]).expect("written");
    let summary = mapped(&resuming, &fk()).expect("mapped");
    assert_eq!(summary.resumed, there - 1);
    assert_eq!(summary.counts.rows, 500_000);
    assert_eq!(read(&output), read(&once));
    assert!(!folder.exists());
}

#[test]
fn parts_of_something_else_are_refused() {
    let at = folder("other");
    let (input, output) = (at.join("in.parquet"), at.join("out.parquet"));
    write(&input, &[run(200_000, 6)], 100_000);
    let resuming = Job { resume: Some("fk".into()), ..job(&input, &output) };
    let stop = |job: &Job| {
        let stopped = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            map(job, &mapping(&fk()), &mut |_, _| panic!("stopped"))
        }));
        assert!(stopped.is_err());
    };
    stop(&resuming);
    let refused = |job: &Job, request: &Request, what: &str| {
        let why = mapped(job, request).expect_err("refused").to_string();
        assert!(why.contains(&format!("was begun with another {what}")) && why.contains("hint"), "{why}");
    };
    refused(&Job { resume: Some("other".into()), ..resuming.clone() }, &fk(), "request");
    refused(&resuming, &Request { keep: Keep::Some(vec![]), ..fk() }, "columns");
    write(&input, &[run(200_001, 6)], 100_000);
    refused(&resuming, &fk(), "input");
    // Formats that have no parts.
    let csv = Job { output: at.join("out.csv"), ..resuming.clone() };
    assert!(mapped(&csv, &fk()).expect_err("refused").to_string().contains("--resume writes Parquet alone"));
}
