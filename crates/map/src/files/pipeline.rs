//! From parts to parts, on several threads.

use super::broken::unreadable;
use super::order::{self, Span};
use super::{Job, Kind, Load, Source, Summary, arrow, csv_out, npz_out, parquet_out, parts};
use crate::{Counts, MapError};
use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

/// What becomes of a part.
pub type Step = dyn Fn(&RecordBatch) -> Result<(RecordBatch, Counts), MapError> + Send + Sync;

/// A part as it is written.
pub enum Encoded {
    /// Columns of a row group.
    RowGroup(Vec<parquet::arrow::arrow_writer::ArrowColumnChunk>),
    /// Bytes, a column each.
    Columns(Vec<Vec<u8>>),
    /// Lines.
    Text(Vec<u8>),
    /// As it is.
    Batch(RecordBatch),
    /// A file of its own.
    File,
}

/// Encodes the part of a number; on several threads.
pub type Encoder = dyn Fn(usize, &RecordBatch, &Counts) -> Result<Encoded, MapError> + Send + Sync;

/// A file that is written.
pub trait Sink {
    /// What encodes its parts.
    fn encoder(&self) -> Arc<Encoder>;
    /// Writes the next part.
    ///
    /// # Errors
    /// If it cannot be written.
    fn write(&mut self, part: Encoded) -> Result<(), MapError>;
    /// Writes what stands behind all parts, and gives the file its name.
    ///
    /// # Errors
    /// If it cannot be written.
    fn finish(self: Box<Self>) -> Result<(), MapError>;
}

/// A part that was worked on.
struct Done {
    encoded: Encoded,
    counts: Counts,
    span: Option<Span>,
}

/// Maps a file by any step: what is left of it is the time of reading and writing.
///
/// # Errors
/// If something cannot be read, computed or written.
#[allow(clippy::too_many_arguments)]
pub fn run_with(
    job: &Job,
    source: Box<dyn Source>,
    columns: Vec<usize>,
    rows: usize,
    schema: SchemaRef,
    step: Arc<Step>,
    ordered: Option<usize>,
    progress: &mut dyn FnMut(u64, Option<u64>),
) -> Result<Summary, MapError> {
    let known = source.rows();
    let kind = Kind::of(&job.output)?;
    let mut summary = Summary::default();
    let mut there: Vec<Option<Counts>> = vec![];
    let mut sink: Box<dyn Sink> = match (&job.resume, kind) {
        (Some(what), Kind::Parquet) => {
            if ordered.is_some() {
                let hint = "check the order without --resume first";
                return Err(MapError::new(
                    "--ordered goes through all parts, and --resume leaves some out",
                    hint,
                ));
            }
            let Some(total) = known.filter(|_| Kind::of(&job.input) == Ok(Kind::Parquet)) else {
                let what = "--resume reads parts of Parquet alone";
                return Err(MapError::new(what, "convert the file, or leave --resume away"));
            };
            let (sink, found) = parts::Parts::open(job, &schema, what, total, rows)?;
            there = found;
            Box::new(sink)
        }
        (Some(_), _) => {
            let hint = "write to .parquet, or leave --resume away";
            return Err(MapError::new("--resume writes Parquet alone", hint));
        }
        (None, Kind::Parquet) => Box::new(parquet_out::Writing::new(job, &schema)?),
        (None, Kind::Arrow) => Box::new(arrow::Writing::new(&job.output, &schema)?),
        (None, Kind::Csv) => Box::new(csv_out::Writing::new(&job.output, &schema)?),
        (None, Kind::Npz) => Box::new(npz_out::Writing::new(&job.output, &schema)?),
    };
    let is_there = |k: usize| there.get(k).is_some_and(Option::is_some);
    let encoder = sink.encoder();
    let loads = source.loads(columns, rows)?;
    let mut last: Option<Span> = None;
    thread::scope(|scope| {
        let (mut to_workers, mut from_workers) = (vec![], vec![]);
        for _ in 0..job.threads.max(1) {
            let (to, input) = sync_channel::<(usize, Result<Load, MapError>)>(1);
            let (output, from) = sync_channel::<Result<Done, MapError>>(1);
            let (step, encoder) = (step.clone(), encoder.clone());
            scope.spawn(move || work(&input, &output, &*step, &*encoder, ordered, &job.input));
            to_workers.push(to);
            from_workers.push(from);
        }
        // Which parts go to workers, in order; the others are there.
        let (tell, told) = sync_channel::<Option<usize>>(to_workers.len());
        let input = job.input.clone();
        let is_there = &is_there;
        scope.spawn(move || distribute(loads, &to_workers, &tell, is_there, &input));
        let mut workers = from_workers.iter().cycle();
        for next in told {
            let Some(_) = next else {
                let counts = there.get(summary.parts).copied().flatten().unwrap_or_default();
                strictly(job, &counts, summary.counts.rows)?;
                summary.counts.add(&counts);
                summary.parts += 1;
                summary.resumed += 1;
                continue;
            };
            let from = workers.next().ok_or_else(|| unreadable(&job.input, &"nobody works"))?;
            let done = from.recv().map_err(|_| unreadable(&job.input, &"a thread has stopped"))?;
            let done = done.map_err(|why| shifted(why, summary.counts.rows))?;
            if let (Some(before), Some(now), Some(name)) = (last, done.span, &job.ordered)
                && now.first < before.last
            {
                return Err(order::back(name, summary.counts.rows + 1));
            }
            last = done.span.or(last);
            strictly(job, &done.counts, summary.counts.rows)?;
            sink.write(done.encoded)?;
            summary.counts.add(&done.counts);
            summary.parts += 1;
            progress(summary.counts.rows, known);
        }
        Ok(())
    })?;
    sink.finish()?;
    Ok(summary)
}

/// A row of a part is one of the file.
fn shifted(why: MapError, before: u64) -> MapError {
    let number = why.what.strip_prefix("row ").and_then(|rest| rest.split_once(':'));
    match number.and_then(|(n, rest)| Some((n.parse::<u64>().ok()?, rest))) {
        Some((n, rest)) => MapError { what: format!("row {}:{rest}", n + before), ..why },
        None => why,
    }
}

/// Refuses a part with rows that have no result, where that is wished; so many rows are before it.
fn strictly(job: &Job, counts: &Counts, before: u64) -> Result<(), MapError> {
    let Some(row) = counts.first_fault.filter(|_| job.strict) else { return Ok(()) };
    let what = match counts {
        Counts { nulls: 0, not_finite: 0, .. } => "its pose is none",
        Counts { nulls: 0, no_pose: 0, .. } => "an input is not a finite number",
        Counts { not_finite: 0, no_pose: 0, .. } => "an input is null",
        _ => "an input is null, no finite number, or no pose",
    };
    Err(MapError::new(
        format!("row {}: {what}", before + row + 1),
        "leave --strict away, and such rows have nulls and are counted",
    ))
}

/// Hands part k to worker k modulo their number, and says so before.
fn distribute(
    loads: super::Loads,
    workers: &[SyncSender<(usize, Result<Load, MapError>)>],
    tell: &SyncSender<Option<usize>>,
    is_there: &(dyn Fn(usize) -> bool + Sync),
    input: &Path,
) {
    let mut next = workers.iter().cycle();
    let mut loads = loads.enumerate();
    loop {
        let found = catch_unwind(AssertUnwindSafe(|| loads.next()));
        let (k, load, ends) = match found {
            Ok(None) => return,
            Ok(Some((k, load))) => {
                let ends = load.is_err();
                (k, load, ends)
            }
            Err(_) => (usize::MAX, Err(super::broken::broken(input, &"it is broken")), true),
        };
        if is_there(k) && !ends {
            if tell.send(None).is_err() {
                return;
            }
            continue;
        }
        let Some(worker) = next.next() else { return };
        if tell.send(Some(k)).is_err() || worker.send((k, load)).is_err() || ends {
            return;
        }
    }
}

fn work(
    input: &Receiver<(usize, Result<Load, MapError>)>,
    output: &SyncSender<Result<Done, MapError>>,
    step: &Step,
    encoder: &Encoder,
    ordered: Option<usize>,
    path: &Path,
) {
    while let Ok((k, load)) = input.recv() {
        // Readers take what a file says of itself on trust here and there.
        let loaded = catch_unwind(AssertUnwindSafe(|| load?()))
            .unwrap_or_else(|_| Err(super::broken::broken(path, &"it is broken")));
        let one = || {
            let batch = loaded?;
            let span = ordered.map(|column| order::check(&batch, column, 0)).transpose()?.flatten();
            let (batch, counts) = step(&batch)?;
            Ok(Done { encoded: encoder(k, &batch, &counts)?, counts, span })
        };
        let done = catch_unwind(AssertUnwindSafe(one)).unwrap_or_else(|_| {
            let what = format!("{}: part {} could not be computed", path.display(), k + 1);
            Err(MapError::new(what, "the file is not at fault: please report it"))
        });
        let is_bad = done.is_err();
        if output.send(done).is_err() || is_bad {
            return;
        }
    }
}
