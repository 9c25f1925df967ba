//! The same rows in every format that is read and written.

use super::common::{fk, folder, job, mapping, numbers, read, run, write};
use arrow_array::cast::AsArray;
use arrow_array::{Array, RecordBatch};
use denavit_map::files::{Job, Summary, run as map};
use denavit_map::{Inverse, Keep, MapError, Request, Solutions};
use std::fs;
use std::path::Path;

fn mapped(input: &Path, output: &Path, request: &Request) -> Result<Summary, MapError> {
    map(&job(input, output), &mapping(request), &mut |_, _| {})
}

fn is_near(a: &RecordBatch, b: &RecordBatch, names: &[&str]) {
    for name in names {
        assert_eq!(numbers(a, name), numbers(b, name), "{name}");
    }
}

const ALL: [&str; 19] = [
    "time", "q1", "q2", "q3", "q4", "q5", "q6", "x", "y", "z", "r11", "r12", "r13", "r21", "r22", "r23",
    "r31", "r32", "r33",
];

/// From Parquet through each format and back: numbers keep their bits.
#[test]
fn every_format_keeps_numbers() {
    let at = folder("formats");
    let (input, wanted) = (at.join("in.parquet"), at.join("wanted.parquet"));
    let rows = 150_000;
    write(&input, &[run(rows, 12)], 60_000);
    mapped(&input, &wanted, &fk()).expect("mapped");
    let wanted = read(&wanted);
    for ending in ["csv", "tsv", "npz", "arrow", "parquet"] {
        let file = at.join(format!("between.{ending}"));
        mapped(&input, &file, &fk()).expect("mapped");
        // Once more of what was written, under other names.
        let out = at.join("out.parquet");
        let request = Request { prefix: "again_".into(), ..fk() };
        let summary = mapped(&file, &out, &request).expect("mapped");
        assert_eq!(summary.counts.rows, rows as u64, "{ending}");
        let out = read(&out);
        is_near(&out, &wanted, &ALL);
        assert_eq!(numbers(&out, "again_x"), numbers(&wanted, "x"), "{ending}");
    }
    let left: Vec<_> = fs::read_dir(&at).expect("a folder").map(|e| e.expect("a file").file_name()).collect();
    assert!(left.iter().all(|n| !n.to_string_lossy().contains("tmp")), "{left:?}");
}

/// Without lists solutions have places of their own.
#[test]
fn solutions_in_csv_and_npz() {
    let at = folder("solutions");
    let (joints, poses) = (at.join("in.parquet"), at.join("poses.csv"));
    write(&joints, &[run(30, 13)], 30);
    let no_joints = Request { keep: Keep::Some(vec!["time".into()]), ..fk() };
    mapped(&joints, &poses, &no_joints).expect("mapped");
    let wish = |solutions| Request {
        inverse: Some(Inverse { solutions, limits: false }),
        keep: Keep::Some(vec!["time".into()]),
        ..Request::default()
    };
    for ending in ["csv", "npz"] {
        let out = at.join(format!("solved.{ending}"));
        let why = mapped(&poses, &out, &wish(Solutions::Lists)).expect_err("refused").to_string();
        assert!(why.contains("`ik`") && why.contains("--slots"), "{why}");
        assert!(!out.exists());
        mapped(&poses, &out, &wish(Solutions::Slots(8))).expect("mapped");
        let again = at.join("again.parquet");
        // Of what was written the time alone goes on: texts are no numbers of NPZ's.
        if ending == "csv" {
            let names = denavit_map::Names { joints: Some("ik1_q1..ik1_q6".into()), ..Default::default() };
            mapped(&out, &again, &Request { names, ..fk() }).expect("mapped");
            let again = read(&again);
            let status = again.column_by_name("ik_status").expect("a status").as_string::<i32>();
            assert!((0..status.len()).all(|k| status.value(k) == "solved"));
            let first = at.join("first.parquet");
            mapped(&joints, &first, &fk()).expect("mapped");
            for (a, b) in numbers(&again, "x").into_iter().zip(numbers(&read(&first), "x")) {
                assert!((a.expect("a number") - b.expect("a number")).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn texts_that_are_no_tables() {
    let at = folder("texts");
    let (input, output) = (at.join("in.csv"), at.join("out.csv"));
    let refused = |text: &[u8], what: &str| {
        fs::write(&input, text).expect("written");
        let why = mapped(&input, &output, &fk()).expect_err("refused").to_string();
        assert!(why.contains(what) && why.contains("= hint: "), "{why}");
        assert!(!output.exists());
        assert_eq!(fs::read_dir(&at).expect("a folder").count(), 1);
    };
    refused(b"", "it is empty");
    refused(b"q1,q2,q3,q4,q5,q6\n1,2,3,4,5,6\n1,2,3\n", "line 3 has 3 values, and the head 6 names");
    refused(b"1,2,3,4,5,6\n1,2,3,4,5,6\n", "line 1 holds numbers, and no names");
    refused(b"q1,q2,q3,q4,q5,q5\n1,2,3,4,5,6\n", "two columns are called `q5`");
    refused(b"q1,q2,q3,q4,q5,q6\n1,2,x,4,5,6\n", "column `q3` holds Utf8, no numbers");
    refused(b"q1;q2;q3;q4;q5;q6\n1;2;3,5;4;5;6\n", "column `q3` holds Utf8, no numbers");
    refused(b"\xff\xfeq\x001\x00", "no text in UTF-8");
    let wide: String = (0..1_000_000).map(|k| format!("a long name of a column {k},")).collect();
    refused(&wide.as_bytes()[..1 << 20], "more than 4096 columns");
    refused(wide.as_bytes(), "line 1 does not end within 16 MB");
    // Nulls, numbers that are none, names with zeros in front, quotes.
    let text = "id,q1,q2,q3,q4,q5,q6,note\n007,1,2,3,4,5,6,\"a, b\"\n008,,2,3,4,5,6,c\n009,nan,2,3,4,5,6,d\n";
    fs::write(&input, text).expect("written");
    let counts = mapped(&input, &output, &fk()).expect("mapped").counts;
    assert_eq!((counts.rows, counts.nulls, counts.not_finite), (3, 1, 1));
    let out = fs::read_to_string(&output).expect("a text");
    let lines: Vec<&str> = out.lines().collect();
    assert!(lines[1].starts_with("007,1,2,3,4,5,6,\"a, b\","), "{}", lines[1]);
    assert!(lines[2].starts_with("008,,2,3,4,5,6,c,,,,"), "{}", lines[2]);
    assert!(lines[3].starts_with("009,NaN,2,3,4,5,6,d,,,,"), "{}", lines[3]);
}

#[test]
fn broken_archives_and_arrow_files() {
    let at = folder("archives");
    let joints = at.join("in.parquet");
    write(&joints, &[run(500, 14)], 500);
    for ending in ["npz", "arrow"] {
        let (input, output) = (at.join(format!("in.{ending}")), at.join("out.parquet"));
        mapped(&joints, &input, &fk()).expect("mapped");
        let request = Request { prefix: "again_".into(), ..fk() };
        let bytes = fs::read(&input).expect("a file");
        for length in [0, 1, 9, 10, 22, 100, bytes.len() / 2, bytes.len() - 30, bytes.len() - 1] {
            fs::write(&input, &bytes[..length]).expect("written");
            let why = mapped(&input, &output, &request).expect_err("refused").to_string();
            assert!(why.contains("= hint: "), "{ending} {length}: {why}");
        }
        for k in (0..bytes.len()).step_by(211).chain(bytes.len() - 300..bytes.len()) {
            let mut other = bytes.clone();
            other[k] ^= 0x5a;
            fs::write(&input, &other).expect("written");
            // A changed number is a number; nothing panics, and nothing is left behind.
            if mapped(&input, &output, &request).is_err() {
                assert!(!output.exists(), "{ending} {k}");
            } else {
                fs::remove_file(&output).expect("removed");
            }
        }
    }
    let job = Job { resume: Some("fk".into()), ..job(&at.join("in.npz"), &at.join("out.parquet")) };
    assert!(map(&job, &mapping(&fk()), &mut |_, _| {}).is_err());
}
