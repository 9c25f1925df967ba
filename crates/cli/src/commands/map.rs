//! `denavit map`: a robot's functions over the columns of a file.

use crate::arguments::{Columns, CompressionName, MapArguments, Wanted};
use crate::commands::fk::{self, plural};
use crate::failure::Failure;
use crate::load::{self, Around};
use crate::terminal::note;
use denavit::description::{Description, write_toml};
use denavit::forward::Reference;
use denavit_map::files::{Compression, Job, Kind, Summary, THREADS, run as map};
use denavit_map::{Frame, Inverse, Keep, MapError, Mapping, Names, Request, Solutions};
use denavit_wire::Schema;
use denavit_wire::mapped::Mapped;
use indicatif::{HumanCount, ProgressBar, ProgressStyle};
use std::io::{self, IsTerminal, Write};
use std::num::NonZero;
use std::thread;
use std::time::Instant;

/// Places for solutions in formats that have no lists, where nobody says how many.
const SLOTS: usize = 8;

/// Maps a file.
///
/// # Errors
/// If the robot or the file cannot be read, something is not there, or the result cannot be written.
pub fn run(arguments: &MapArguments) -> Result<(), Failure> {
    let (description, around) = load::robot_and_around(&arguments.robot)?;
    let request = request(&description, &around, arguments)?;
    let mapping = Mapping::new(&description, &request).map_err(|why| usage(&why))?;
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let job = Job {
        input: arguments.input.clone(),
        output: arguments.output.clone(),
        compression: match arguments.files.compression {
            CompressionName::Snappy => Compression::Snappy,
            CompressionName::Gzip => Compression::Gzip,
            CompressionName::None => Compression::None,
        },
        threads: arguments.files.threads.map_or(cores.min(THREADS), usize::from),
        ordered: arguments.files.ordered.clone(),
        strict: arguments.files.strict,
        resume: arguments.files.resume.then(|| format!("{}\n{request:?}", write_toml(&description))),
    };
    let began = Instant::now();
    let bar = Bar::new();
    let summary = map(&job, &mapping, &mut |rows, of| bar.show(rows, of));
    bar.0.finish_and_clear();
    let summary = summary.map_err(|why| Failure::Input(format!("error: {why}")))?;
    said(&summary, began.elapsed().as_secs_f64());
    if arguments.json {
        let counts = summary.counts;
        let mut text = vec![];
        let mapped = Mapped {
            more_solutions: counts.more_solutions,
            no_pose: counts.no_pose,
            not_finite: counts.not_finite,
            nulls: counts.nulls,
            output: &arguments.output.to_string_lossy(),
            parts: summary.parts,
            resumed: summary.resumed,
            robot: &description.name,
            rows: counts.rows,
            schema: Schema,
        };
        denavit_wire::line(&mapped, &mut text);
        io::stdout().write_all(&text)?;
    }
    Ok(())
}

fn usage(why: &MapError) -> Failure {
    Failure::Usage(why.to_string())
}

/// What is asked for.
fn request(d: &Description, around: &Around, arguments: &MapArguments) -> Result<Request, Failure> {
    let Wanted { fk, jacobian, manipulability, torque, ik, nearest, slots, limits, frame, orientation } =
        &arguments.wanted;
    let Columns { joints, velocities, accelerations, position, rotation, near, units, keep, prefix } =
        &arguments.columns;
    let frames = match frame {
        None => vec![Frame::tool()],
        Some(text) => {
            frames(d, around, text).map_err(|why| Failure::Usage(format!("--frame {text}: {why}")))?
        }
    };
    if frame.is_some() && !fk && !jacobian {
        return Err(Failure::Usage("--frame is of --fk and --jacobian".into()));
    }
    if *jacobian && frames.len() > 1 {
        return Err(Failure::Usage("--jacobian is of one frame".into()));
    }
    if *limits && !ik && !nearest {
        return Err(Failure::Usage("--limits is of --ik and --nearest".into()));
    }
    let kind = Kind::of(&arguments.output).map_err(|why| usage(&why))?;
    let has_lists = matches!(kind, Kind::Parquet | Kind::Arrow);
    let solutions = match (slots, nearest) {
        (_, true) => Solutions::Nearest,
        (Some(n), _) => Solutions::Slots(usize::from(*n)),
        (None, _) if has_lists => Solutions::Lists,
        (None, _) => Solutions::Slots(SLOTS),
    };
    Ok(Request {
        poses: if *fk { frames.clone() } else { vec![] },
        jacobian: frames.into_iter().next().filter(|_| *jacobian),
        manipulability: *manipulability,
        torque: *torque,
        inverse: (*ik || *nearest).then_some(Inverse { solutions, limits: *limits }),
        orientation: orientation.parse().map_err(|why| Failure::Usage(format!("--orientation: {why}")))?,
        units: units.parse().map_err(|why| Failure::Usage(format!("--units: {why}")))?,
        names: Names {
            joints: joints.clone(),
            velocities: velocities.clone(),
            accelerations: accelerations.clone(),
            position: position.clone(),
            rotation: rotation.clone(),
            near: near.clone(),
        },
        prefix: prefix.clone(),
        keep: match keep.as_deref().map(str::trim) {
            None => Keep::All,
            Some("none") => Keep::Some(vec![]),
            Some(names) => Keep::Some(names.split(',').map(|n| n.trim().to_string()).collect()),
        },
    })
}

/// The frames that a list names.
fn frames(d: &Description, around: &Around, text: &str) -> Result<Vec<Frame>, String> {
    let one = |word: &str| {
        if word == "tool" {
            return Ok(Frame::tool());
        }
        let found = fk::Frame::find(d, &around.frames(), word)?;
        let label = if word.parse::<usize>().is_ok() { format!("f{word}") } else { word.to_string() };
        Ok(Frame { label, on: Reference::Frame(found.row()), offset: found.offset() })
    };
    // A name may hold commas.
    one(text.trim()).map(|f| vec![f]).or_else(|_| text.split(',').map(|w| one(w.trim())).collect())
}

/// Says what was done.
fn said(summary: &Summary, seconds: f64) {
    let counts = &summary.counts;
    let rows = |n: u64| plural_of(n, "row");
    let mut text = format!("{} in {seconds:.1} s", rows(counts.rows));
    if summary.resumed > 0 {
        text += &format!(", {} of {} parts were there", summary.resumed, summary.parts);
    }
    note(&format!("note: {text}"));
    if counts.faults() > 0 {
        let each = [
            (counts.nulls, "with a null among the inputs"),
            (counts.not_finite, "with what is no finite number"),
            (counts.no_pose, "whose pose is none"),
        ];
        let each = each.iter().filter(|e| e.0 > 0).map(|(n, what)| format!("{} {what}", HumanCount(*n)));
        let first = counts.first_fault.map_or(String::new(), |row| format!("; the first is row {}", row + 1));
        let each = each.collect::<Vec<_>>().join(", ");
        note(&format!("warning: {} without all results: {each}{first}", rows(counts.faults())));
    }
    if counts.more_solutions > 0 {
        note(&format!(
            "warning: {} with more solutions than places for them: `ik_count` says how many; --slots gives more",
            rows(counts.more_solutions)
        ));
    }
}

fn plural_of(n: u64, word: &str) -> String {
    let one = plural(usize::from(n != 1) + 1, word);
    format!("{} {}", HumanCount(n), one.split_once(' ').map_or(word, |x| x.1))
}

/// A bar on standard error, where that is a terminal.
struct Bar(ProgressBar);

impl Bar {
    fn new() -> Self {
        if !io::stderr().is_terminal() {
            return Bar(ProgressBar::hidden());
        }
        let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}  {eta} to go");
        Bar(ProgressBar::no_length().with_style(style.expect("a template of ours")))
    }

    fn show(&self, rows: u64, of: Option<u64>) {
        if !self.0.is_hidden() {
            if let Some(of) = of {
                self.0.set_length(of);
            }
            let rate = rows as f64 / self.0.elapsed().as_secs_f64().max(1e-3);
            self.0.set_message(format!("{} rows, {}/s", HumanCount(rows), HumanCount(rate as u64)));
            self.0.set_position(rows);
        }
    }
}
