//! Whole files: the same whatever the number of threads and row groups; refused where they are broken, with nothing left behind.

use super::common::{batch, fk, folder, job, mapping, numbers, read, run, write};
use arrow_array::{ArrayRef, BinaryArray, Float64Array, RecordBatch, StringArray, TimestampMicrosecondArray};
use denavit_map::files::{Compression, Job, Summary, run as map};
use denavit_map::{MapError, Request};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use std::path::Path;
use std::sync::Arc;

fn mapped(job: &Job, request: &Request) -> Result<Summary, MapError> {
    map(job, &mapping(request), &mut |_, _| {})
}

/// What stands in a folder besides these.
fn others(folder: &Path, known: &[&str]) -> Vec<String> {
    let all = std::fs::read_dir(folder).expect("a folder").map(|e| e.expect("a file").file_name());
    all.map(|n| n.to_string_lossy().into_owned()).filter(|n| !known.contains(&n.as_str())).collect()
}

#[test]
fn a_file_is_what_its_batch_is() {
    let at = folder("whole");
    let (input, output) = (at.join("in.parquet"), at.join("out.parquet"));
    let whole = run(120_000, 1);
    let wanted = mapping(&fk()).bind(&whole.schema()).expect("bound").run(&whole).expect("computed").0;
    let mut bytes: Vec<Vec<u8>> = vec![];
    // Row groups that are put together, and that are cut.
    for group in [1000, 50_000, 120_000] {
        write(&input, std::slice::from_ref(&whole), group);
        for threads in [1, 3] {
            let summary = mapped(&Job { threads, ..job(&input, &output) }, &fk()).expect("mapped");
            assert_eq!((summary.counts.rows, summary.counts.faults()), (120_000, 0));
            assert_eq!(read(&output).columns(), wanted.columns(), "{group} {threads}");
            bytes.push(std::fs::read(&output).expect("a file"));
        }
        let last = &bytes[bytes.len() - 2..];
        assert!(last.iter().all(|b| *b == last[0]), "the bytes are those of one thread");
    }
    for compression in [Compression::Gzip, Compression::None] {
        mapped(&Job { compression, ..job(&input, &output) }, &fk()).expect("mapped");
        assert_eq!(read(&output).columns(), wanted.columns());
    }
    assert!(others(&at, &["in.parquet", "out.parquet"]).is_empty());
}

/// Columns that are no numbers go through as they are, with what is said of them.
#[test]
fn what_goes_through() {
    let at = folder("through");
    let (input, output) = (at.join("in.parquet"), at.join("out.parquet"));
    let own = run(2000, 2);
    let mut columns: Vec<(String, ArrayRef)> =
        own.schema().fields().iter().zip(own.columns()).map(|(f, c)| (f.name().clone(), c.clone())).collect();
    let text = |k: usize| (!k.is_multiple_of(3)).then(|| format!("row {k}"));
    columns.push(("note".into(), Arc::new((0..2000).map(text).collect::<StringArray>())));
    let stamps = (0..2000).map(|k| 1_700_000_000_000_000 + k);
    columns.push((
        "stamp".into(),
        Arc::new(TimestampMicrosecondArray::from_iter_values(stamps).with_timezone("UTC")),
    ));
    // A kilobyte a row: parts become short.
    let image = vec![7_u8; 20_000];
    columns.push(("image".into(), Arc::new(BinaryArray::from_iter_values((0..2000).map(|_| &image)))));
    let whole = RecordBatch::try_from_iter(columns).expect("a batch");
    write(&input, std::slice::from_ref(&whole), 2000);
    let summary = mapped(&job(&input, &output), &fk()).expect("mapped");
    assert!(summary.parts >= 3, "{}", summary.parts);
    let out = read(&output);
    for (field, column) in whole.schema().fields().iter().zip(whole.columns()) {
        assert_eq!(out.column_by_name(field.name()), Some(column), "{}", field.name());
    }
    let file = std::fs::File::open(&output).expect("a file");
    let schema = ParquetRecordBatchReaderBuilder::try_new(file).expect("Parquet").schema().clone();
    assert_eq!(schema.metadata()["denavit.robot"], "Universal Robots UR5");
    assert_eq!(schema.metadata()["denavit.units"], "rad,m");
    assert_eq!(out.schema_ref().field_with_name("x").expect("a column").metadata()["unit"], "m");
}

#[test]
fn rows_without_numbers_are_counted_over_parts() {
    let at = folder("counted");
    let (input, output) = (at.join("in.parquet"), at.join("out.parquet"));
    let own = run(200_000, 3);
    let mut columns: Vec<ArrayRef> = own.columns().to_vec();
    let mut second: Vec<Option<f64>> = numbers(&own, "q1");
    second[150_000] = None;
    second[190_000] = Some(f64::NAN);
    columns[1] = Arc::new(Float64Array::from(second));
    let whole = RecordBatch::try_new(own.schema(), columns).expect("a batch");
    write(&input, &[whole], 50_000);
    let counts = mapped(&job(&input, &output), &fk()).expect("mapped").counts;
    assert_eq!((counts.nulls, counts.not_finite, counts.first_fault), (1, 1, Some(150_000)));
    let x = numbers(&read(&output), "x");
    assert_eq!(x.iter().filter(|x| x.is_none()).count(), 2);
    assert!(x[150_000].is_none() && x[190_000].is_none());
    std::fs::remove_file(&output).expect("removed");
    let why = mapped(&Job { strict: true, ..job(&input, &output) }, &fk()).expect_err("refused").to_string();
    assert!(why.contains("row 150001: an input is null"), "{why}");
    assert!(others(&at, &["in.parquet"]).is_empty());
}

#[test]
fn times_that_go_back() {
    let at = folder("ordered");
    let (input, output) = (at.join("in.parquet"), at.join("out.parquet"));
    let ordered = Job { ordered: Some("time".into()), ..job(&input, &output) };
    let own = run(200_000, 4);
    write(&input, std::slice::from_ref(&own), 50_000);
    mapped(&ordered, &fk()).expect("in order");
    // Its column need not go through.
    let request = Request { keep: denavit_map::Keep::Some(vec![]), ..fk() };
    mapped(&ordered, &request).expect("in order");
    for (row, said) in
        [(10, "row 11"), (50_000, "row 50001"), (150_000, "row 150001"), (199_999, "row 200000")]
    {
        let mut times = numbers(&own, "time");
        times[row] = Some(-1.0);
        let mut columns: Vec<ArrayRef> = own.columns().to_vec();
        columns[0] = Arc::new(Float64Array::from(times));
        write(&input, &[RecordBatch::try_new(own.schema(), columns).expect("a batch")], 50_000);
        let why = mapped(&ordered, &fk()).expect_err("refused").to_string();
        assert!(why.contains(said) && why.contains("`time` is less"), "{why}");
    }
    let why =
        mapped(&Job { ordered: Some("clock".into()), ..ordered }, &fk()).expect_err("refused").to_string();
    assert!(why.contains("there is no such column"), "{why}");
}

#[test]
fn broken_files_are_refused() {
    let at = folder("broken");
    let (input, output) = (at.join("in.parquet"), at.join("out.parquet"));
    write(&input, &[run(300, 5)], 100);
    std::fs::write(&output, "what stood there").expect("written");
    let bytes = std::fs::read(&input).expect("a file");
    let compiled = mapping(&fk());
    let check = |what: &str| {
        match map(&job(&input, &output), &compiled, &mut |_, _| {}) {
            Err(why) => {
                let why = why.to_string();
                assert!(why.contains("in.parquet") && why.contains("= hint: "), "{what}: {why}");
                assert_eq!(std::fs::read(&output).expect("a file"), b"what stood there", "{what}");
            }
            // A changed number is a number.
            Ok(_) => std::fs::write(&output, "what stood there").expect("written"),
        }
        assert!(others(&at, &["in.parquet", "out.parquet"]).is_empty(), "{what}");
    };
    for length in [0, 3, 4, 11, 12, 100, bytes.len() / 2, bytes.len() - 9, bytes.len() - 1] {
        std::fs::write(&input, &bytes[..length]).expect("written");
        assert!(mapped(&job(&input, &output), &fk()).is_err(), "{length}");
        check(&format!("{length} bytes"));
    }
    for k in (0..bytes.len()).step_by(97).chain((bytes.len() - 600..bytes.len()).step_by(3)) {
        let mut other = bytes.clone();
        other[k] ^= 0x5a;
        std::fs::write(&input, &other).expect("written");
        check(&format!("byte {k}"));
    }
}

#[test]
fn files_that_are_no_tables_of_rows() {
    let at = folder("wide");
    let (input, output) = (at.join("in.parquet"), at.join("out.parquet"));
    let names: Vec<String> = (0..5000).map(|k| format!("c{k}")).collect();
    write(&input, &[batch(&names.iter().map(|n| (n.as_str(), vec![1.0])).collect::<Vec<_>>())], 10);
    let why = mapped(&job(&input, &output), &fk()).expect_err("refused").to_string();
    assert!(why.contains("5000 columns") && why.contains("on its side"), "{why}");
    // A description that says it has so much is not read.
    let mut bytes = vec![b'x'; 100];
    bytes.extend(100_000_000_u32.to_le_bytes());
    bytes.extend(b"PAR1");
    std::fs::write(&input, &bytes).expect("written");
    let why = mapped(&job(&input, &output), &fk()).expect_err("refused").to_string();
    assert!(why.contains("its description has 95 MB"), "{why}");
    // No row is none in the result.
    write(&input, &[run(3, 1).slice(0, 0)], 10);
    assert_eq!(mapped(&job(&input, &output), &fk()).expect("mapped").counts.rows, 0);
    let reader = ParquetRecordBatchReaderBuilder::try_new(std::fs::File::open(&output).expect("a file"));
    assert_eq!(reader.expect("Parquet").schema().fields().len(), 19);
    std::fs::remove_file(&output).expect("removed");
    let missing = mapped(&job(&at.join("none.parquet"), &output), &fk()).expect_err("refused").to_string();
    assert!(missing.contains("none.parquet"), "{missing}");
    let other = mapped(&job(&at.join("in.xls"), &output), &fk()).expect_err("refused").to_string();
    assert!(other.contains("map reads and writes .parquet"), "{other}");
    write(&input, &[run(3, 1)], 10);
    let same = mapped(&job(&input, &input), &fk()).expect_err("refused").to_string();
    assert!(same.contains("what is read and what is to be written"), "{same}");
    assert!(others(&at, &["in.parquet"]).is_empty());
}

/// Identifiers stay what they are, and a quote that is never closed names its line and takes no more than a line may.
#[test]
fn texts_of_csv_keep_their_digits_and_lines_their_ends() {
    let at = folder("csv-lines");
    let (input, output) = (at.join("in.csv"), at.join("out.csv"));
    let head = "id,q1,q2,q3,q4,q5,q6\n";
    let ids = ["18446744073709551615", "18446744073709551614", "-9223372036854775809"];
    let rows: String = ids.iter().map(|id| format!("{id},0,1,0,1,0,1\n")).collect();
    std::fs::write(&input, format!("{head}{rows}")).expect("written");
    mapped(&job(&input, &output), &fk()).expect("mapped");
    let text = std::fs::read_to_string(&output).expect("a file");
    let first: Vec<&str> = text.lines().skip(1).filter_map(|l| l.split(',').next()).collect();
    assert_eq!(first, ids);
    // Long lines end a part, and are whole in it.
    let long = "x".repeat(9 << 20);
    let rows: String = (0..5).map(|k| format!("{k}{long},0,1,0,1,0,1\n")).collect();
    std::fs::write(&input, format!("{head}{rows}")).expect("written");
    let summary = mapped(&job(&input, &output), &fk()).expect("mapped");
    assert!(summary.counts.rows == 5 && summary.parts > 1, "{summary:?}");
    let rest = "1,0,1,0,1,0,1\n".repeat(2 << 20);
    std::fs::write(&input, format!("{head}7,0,1,0,1,0,1\n\"8,0,1,0,1,0,1\n{rest}")).expect("written");
    let why = mapped(&job(&input, &output), &fk()).expect_err("refused").to_string();
    assert!(why.contains("line 3 does not end within 16 MB") && why.contains("a quote"), "{why}");
}
