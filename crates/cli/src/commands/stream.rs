//! `--input`: a line of JSON in, a line of JSON out, in order, in constant memory.
//!
//! A thread reads and cuts what has arrived into chunks of whole lines; the chunks go round the workers, which parse,
//! compute and format; this thread writes. A chunk is as large as what is there, up to [`LINES`], so that a line of a
//! slow pipe is answered at once, and a fast one is answered in bulk. Channels of one chunk bound what is under way.

use crate::commands::fk::plural;
use crate::failure::Failure;
use denavit_wire::Schema;
use denavit_wire::finding::BadLine;
use indicatif::{HumanCount, ProgressBar, ProgressStyle};
use serde_json::error::Category;
use std::fs::File;
use std::io::{self, IsTerminal, Read, Write};
use std::num::NonZero;
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

/// Lines of a chunk.
const LINES: usize = 1024;
/// Bytes that are read at once.
const READ: usize = 1 << 18;
/// Bytes of the longest line that is read.
const LONGEST: usize = 1 << 20;

/// Answers the lines of a chunk.
pub trait Worker: Send + 'static {
    /// Appends the answers, a line for each line that is not blank; how many could not be read.
    fn answer(&mut self, chunk: &Chunk, out: &mut Vec<u8>) -> usize;
}

/// Answers a line for each line, with as many workers as there are cores.
///
/// # Errors
/// If the file cannot be read or the answers not written; at the end, if there were lines that could not be read.
pub fn run<W: Worker>(worker: impl Fn() -> W, path: &Path) -> Result<(), Failure> {
    run_by(thread::available_parallelism().map_or(1, NonZero::get), worker, path)
}

/// The same by one worker, to which an answer can depend on the lines before.
///
/// # Errors
/// See [`run`].
pub fn run_in_line<W: Worker>(worker: impl Fn() -> W, path: &Path) -> Result<(), Failure> {
    run_by(1, worker, path)
}

fn run_by<W: Worker>(workers: usize, worker: impl Fn() -> W, path: &Path) -> Result<(), Failure> {
    let named = path.display();
    let unreadable = |e: io::Error| Failure::Input(format!("error: {named}: {e}"));
    let (source, bytes): (Box<dyn Read + Send>, Option<u64>) = if path.as_os_str() == "-" {
        (Box::new(io::stdin()), None)
    } else {
        let file = File::open(path).map_err(unreadable)?;
        let bytes = file.metadata().ok().filter(|m| m.is_file()).map(|m| m.len());
        (Box::new(file), bytes)
    };
    let (mut inputs, mut outputs, mut threads) = (vec![], vec![], vec![]);
    for _ in 0..workers {
        let (to_worker, input) = sync_channel::<Chunk>(1);
        let (output, from_worker) = sync_channel::<Answered>(1);
        let mut worker = worker();
        threads.push(thread::spawn(move || work(&mut worker, &input, &output)));
        inputs.push(to_worker);
        outputs.push(from_worker);
    }
    // Not waited for where writing fails: it may hang in a read for ever.
    let reader = thread::spawn(move || distribute(Chunks::new(source), &inputs));

    let mut out = io::stdout().lock();
    let progress = Progress::new(bytes);
    let (mut lines, mut bytes, mut bad) = (0, 0, 0);
    for answered in outputs.iter().cycle().map_while(|from_worker| from_worker.recv().ok()) {
        out.write_all(&answered.text)?;
        out.flush()?;
        lines += answered.lines;
        bytes += answered.bytes;
        bad += answered.bad;
        progress.show(lines, bytes);
    }
    progress.end();
    threads.into_iter().for_each(|worker| worker.join().expect("a worker ends when no chunk is left"));
    reader.join().expect("the reader returns errors").map_err(unreadable)?;
    match bad {
        0 => Ok(()),
        n => Err(Failure::Input(format!("error: {named}: {} could not be read", plural(n, "line")))),
    }
}

/// Whole lines of the input.
pub struct Chunk {
    text: Vec<u8>,
    lines: usize,
    /// The number of the first line, from 1.
    first: usize,
}

/// The answers to a chunk, and what it was.
struct Answered {
    text: Vec<u8>,
    lines: usize,
    bytes: usize,
    bad: usize,
}

/// Cuts what a reader gives into chunks.
struct Chunks<R> {
    source: R,
    /// Where bytes arrive.
    arriving: Box<[u8]>,
    /// What is read and not handed out: from `start` on.
    buffer: Vec<u8>,
    start: usize,
    next_line: usize,
    ended: bool,
}

impl Chunk {
    /// The lines that are not blank, with their numbers.
    pub fn lines(&self) -> impl Iterator<Item = (usize, &[u8])> {
        let all = self.text.split(|b| *b == b'\n').enumerate();
        all.filter(|(_, line)| !line.iter().all(u8::is_ascii_whitespace))
            .map(|(i, line)| (self.first + i, line))
    }
}

impl<R: Read> Chunks<R> {
    fn new(source: R) -> Self {
        Chunks {
            source,
            arriving: vec![0; READ].into(),
            buffer: vec![],
            start: 0,
            next_line: 1,
            ended: false,
        }
    }

    /// The next lines: those that are there already, or the first that come.
    fn next(&mut self) -> io::Result<Option<Chunk>> {
        loop {
            let there = &self.buffer[self.start..];
            let (lines, end) =
                memchr::memchr_iter(b'\n', there).take(LINES).fold((0, 0), |(n, _), at| (n + 1, at + 1));
            let (lines, end) = match (lines, self.ended) {
                (0, true) if there.is_empty() => return Ok(None),
                (0, true) => (1, there.len()),
                found => (found.0, end),
            };
            if lines > 0 {
                let chunk = Chunk { text: there[..end].to_vec(), lines, first: self.next_line };
                self.start += end;
                self.next_line += lines;
                return Ok(Some(chunk));
            }
            self.read()?;
        }
    }

    /// Reads what is there, or waits for it. Of a line that is too long the beginning is kept.
    fn read(&mut self) -> io::Result<()> {
        self.buffer.drain(..self.start);
        self.start = 0;
        let kept = self.buffer.len();
        let count = loop {
            match self.source.read(&mut self.arriving) {
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                Err(e) => return Err(e),
                Ok(count) => break count,
            }
        };
        self.buffer.extend_from_slice(&self.arriving[..count]);
        self.ended = count == 0;
        if kept > LONGEST {
            let end = memchr::memchr(b'\n', &self.buffer[kept..]).map_or(self.buffer.len(), |at| kept + at);
            self.buffer.drain(LONGEST + 1..end);
        }
        Ok(())
    }
}

/// Hands chunk k to worker k modulo their number.
fn distribute(mut chunks: Chunks<impl Read>, inputs: &[SyncSender<Chunk>]) -> io::Result<()> {
    for to_worker in inputs.iter().cycle() {
        let Some(chunk) = chunks.next()? else { break };
        if to_worker.send(chunk).is_err() {
            break;
        }
    }
    Ok(())
}

fn work(worker: &mut impl Worker, input: &Receiver<Chunk>, output: &SyncSender<Answered>) {
    let mut size = 0;
    while let Ok(chunk) = input.recv() {
        let mut text = Vec::with_capacity(size + size / 8);
        let bad = worker.answer(&chunk, &mut text);
        size = text.len();
        let answered = Answered { text, lines: chunk.lines, bytes: chunk.text.len(), bad };
        if output.send(answered).is_err() {
            break;
        }
    }
}

/// A line without the byte order mark that some editors put before the first one.
pub fn without_mark(line: &[u8]) -> &[u8] {
    line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line)
}

/// What is read from a line of JSON.
///
/// # Errors
/// A sentence that says what is wrong; `what` is what was expected.
pub fn parsed<T>(line: &[u8], what: &str, read: fn(&[u8]) -> serde_json::Result<T>) -> Result<T, String> {
    if line.len() > LONGEST {
        return Err(format!("longer than {LONGEST} bytes"));
    }
    read(without_mark(line)).map_err(|e| {
        let why = match e.classify() {
            Category::Data => "",
            Category::Io | Category::Syntax | Category::Eof => ": no JSON",
        };
        format!("not {what}{why} (column {})", e.column().max(1))
    })
}

/// The answer to a line that cannot be read.
pub fn complaint(line: usize, why: &str, out: &mut Vec<u8>) {
    denavit_wire::line(&BadLine { error: why, line, schema: Schema }, out);
}

/// A bar on standard error, where that is a terminal and the answers go elsewhere.
struct Progress(ProgressBar);

impl Progress {
    /// With the number of bytes to come, if that is known.
    fn new(bytes: Option<u64>) -> Self {
        if !io::stderr().is_terminal() || io::stdout().is_terminal() {
            return Progress(ProgressBar::hidden());
        }
        let (bar, template) = match bytes {
            Some(bytes) => (ProgressBar::new(bytes), "{bar:30} {percent:>3} %  {msg}  {eta} to go"),
            None => (ProgressBar::no_length(), "{spinner} {msg}"),
        };
        let style = ProgressStyle::with_template(template).expect("a template of ours");
        Progress(bar.with_style(style))
    }

    fn show(&self, lines: usize, bytes: usize) {
        if !self.0.is_hidden() {
            let rate = lines as f64 / self.0.elapsed().as_secs_f64().max(1e-3);
            self.0.set_message(format!("{} lines, {}/s", HumanCount(lines as u64), HumanCount(rate as u64)));
            self.0.set_position(bytes as u64);
        }
    }

    fn end(self) {
        self.0.finish_and_clear();
    }
}

/// Appends the joint variables of a line, one a joint.
///
/// # Errors
/// What is wrong with the line.
pub fn joints(line: &[u8], joints: usize, rows: &mut Vec<f64>) -> Result<(), String> {
    let q: Vec<f64> = parsed(line, "a JSON array of numbers", |l| serde_json::from_slice(l))?;
    if q.len() != joints {
        return Err(format!("{}, the robot has {}", plural(q.len(), "value"), plural(joints, "joint")));
    }
    rows.extend(q);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives a few bytes at a time, as a pipe does.
    struct Dribble<'a>(&'a [u8], usize);

    impl Read for Dribble<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let count = self.1.min(self.0.len()).min(buffer.len());
            buffer[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    fn chunks(text: &[u8], at_once: usize) -> Vec<Chunk> {
        let mut chunks = Chunks::new(Dribble(text, at_once));
        std::iter::from_fn(|| chunks.next().expect("nothing fails")).collect()
    }

    #[test]
    fn chunks_are_the_text_in_whole_lines() {
        for end in ["", "\n", "\n\n", "last"] {
            for count in [0, 1, LINES - 1, LINES, LINES + 1, 3 * LINES] {
                let text = (0..count).map(|i| format!("[{i}]\n")).collect::<String>() + end;
                for at_once in [1, 2, 7, 4096, READ] {
                    let cut = chunks(text.as_bytes(), at_once);
                    let mut next = 1;
                    for (k, chunk) in cut.iter().enumerate() {
                        assert_eq!(chunk.first, next);
                        assert!((1..=LINES).contains(&chunk.lines));
                        assert!(chunk.text.ends_with(b"\n") || k + 1 == cut.len());
                        next += chunk.lines;
                    }
                    assert_eq!(next - 1, text.split_inclusive('\n').count());
                    assert_eq!(cut.into_iter().flat_map(|c| c.text).collect::<Vec<u8>>(), text.as_bytes());
                }
            }
        }
    }

    /// A line is handed out before the next one comes.
    #[test]
    fn nothing_waits_for_more() {
        let lines: Vec<usize> = chunks(b"[1]\n[2]\n[3]\n[4", 4).iter().map(|c| c.lines).collect();
        assert_eq!(lines, [1, 1, 1, 1]);
    }

    #[test]
    fn of_a_line_without_end_the_beginning_is_kept() {
        let long = [b"[0]\n", &vec![b'7'; 3 * LONGEST][..], b"\n[1]\n"].concat();
        for at_once in [4096, READ, READ - 1] {
            let cut = chunks(&long, at_once);
            let text: Vec<u8> = cut.iter().flat_map(|c| c.text.clone()).collect();
            let lines: Vec<&[u8]> = text.split(|b| *b == b'\n').collect();
            assert_eq!(lines.len(), 4);
            assert!((LONGEST + 1..=LONGEST + 2 * READ).contains(&lines[1].len()), "{}", lines[1].len());
            assert_eq!(lines[2], b"[1]");
            assert!(
                parsed(lines[1], "numbers", |l| serde_json::from_slice::<Vec<f64>>(l))
                    .is_err_and(|e| e.starts_with("longer than"))
            );
        }
    }
}
