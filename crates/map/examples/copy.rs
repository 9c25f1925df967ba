//! How fast a file is mapped, beside reading and writing the same columns alone.
//!
//! `cargo run --release -p denavit-map --example copy -- 10000000 [FOLDER]`: writes so many rows of a UR5's joints as Parquet; maps them
//! to poses; then reads and writes them once more with columns of results that were computed before, which is what the file costs by
//! itself. It prints millions of rows a second, the one by the other, and MB
//! of memory at most (Linux), writing the first file included.

use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use denavit_map::files::{Compression, Job, PART_ROWS, open, run, run_with};
use denavit_map::{Counts, Frame, Mapping, Request};
use parquet::arrow::ArrowWriter;
use std::error::Error;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let rows: usize = arguments.next().map_or(Ok(1_000_000), |n| n.parse())?;
    let folder = arguments.next().map_or_else(std::env::temp_dir, PathBuf::from);
    let (input, output) = (folder.join("denavit-in.parquet"), folder.join("denavit-out.parquet"));
    write(&input, rows)?;
    let description = denavit::catalogue::robot("ur5").ok_or("a robot of the catalogue")?;
    let request = Request { poses: vec![Frame::tool()], ..Request::default() };
    let mapping = Mapping::new(&description, &request)?;
    let threads = std::thread::available_parallelism()?.get();
    let job = Job {
        input: input.clone(),
        output: output.clone(),
        compression: Compression::Snappy,
        threads,
        ordered: None,
        strict: false,
        resume: None,
    };
    let mut best = [f64::INFINITY; 2];
    for _ in 0..3 {
        let began = Instant::now();
        let summary = run(&job, &mapping, &mut |_, _| {})?;
        best[0] = best[0].min(began.elapsed().as_secs_f64());
        assert_eq!(summary.counts.rows, rows as u64);
        best[1] = best[1].min(copy(&job, &mapping)?);
    }
    let rate = best.map(|seconds| rows as f64 / seconds / 1e6);
    // Linux says it in kB.
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let memory =
        status.lines().find_map(|l| l.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse::<f64>().ok());
    println!(
        "{{\"rows\": {rows}, \"threads\": {threads}, \"map\": {:.3}, \"copy\": {:.3}, \"share\": {:.3}, \"memory\": {:.0}}}",
        rate[0],
        rate[1],
        rate[0] / rate[1],
        memory.unwrap_or(f64::NAN) / 1024.0
    );
    std::fs::remove_file(&input)?;
    std::fs::remove_file(&output)?;
    Ok(())
}

/// Seconds to read the same columns and to write the same, results that were computed once.
fn copy(job: &Job, mapping: &Mapping) -> Result<f64, Box<dyn Error>> {
    let source = open(&job.input)?;
    let bound = mapping.bind(&source.schema())?;
    let (columns, schema) = (bound.needed(), bound.schema().clone());
    let known: Mutex<Option<RecordBatch>> = Mutex::default();
    let rows = (denavit_map::files::PART / (8 * schema.fields().len())).clamp(1, PART_ROWS);
    let own = schema.clone();
    let step = move |batch: &RecordBatch| {
        let counts = Counts { rows: batch.num_rows() as u64, ..Counts::default() };
        let computed = known.lock().ok().and_then(|k| k.clone());
        let computed = match computed.filter(|c| c.num_rows() >= batch.num_rows()) {
            Some(computed) => computed.slice(0, batch.num_rows()),
            None => {
                let made = bound.run(batch)?.0;
                if let Ok(mut known) = known.lock() {
                    *known = Some(made.clone());
                }
                made
            }
        };
        let results = computed.columns()[batch.num_columns()..].iter().cloned();
        let all: Vec<ArrayRef> = batch.columns().iter().cloned().chain(results).collect();
        let made = RecordBatch::try_new(own.clone(), all);
        Ok((
            made.map_err(|why| denavit_map::MapError { what: why.to_string(), hint: String::new() })?,
            counts,
        ))
    };
    let began = Instant::now();
    run_with(job, source, columns, rows, schema, Arc::new(step), None, &mut |_, _| {})?;
    Ok(began.elapsed().as_secs_f64())
}

/// Joints that look random, a million rows a row group.
fn write(path: &Path, rows: usize) -> Result<(), Box<dyn Error>> {
    let mut random = denavit::random::Random(1);
    let mut writer: Option<ArrowWriter<File>> = None;
    let mut left = rows;
    while left > 0 {
        let count = left.min(1 << 20);
        left -= count;
        let column = |k: usize| {
            let values: Vec<f64> = (0..count).map(|_| 6.0 * random.unit() - 3.0).collect();
            (format!("q{}", k + 1), Arc::new(Float64Array::from(values)) as ArrayRef)
        };
        let batch = RecordBatch::try_from_iter((0..6).map(column).collect::<Vec<_>>())?;
        if writer.is_none() {
            writer = Some(ArrowWriter::try_new(File::create(path)?, batch.schema(), None)?);
        }
        if let Some(writer) = &mut writer {
            writer.write(&batch)?;
            writer.flush()?;
        }
    }
    writer.ok_or("rows")?.close()?;
    Ok(())
}
