//! Timing: everything in turn, several rounds, as ratios to the unit measured in the same round.

use anyhow::{Context, Result, bail};
use cpu_time::ThreadTime;
use std::hint::black_box;
use std::time::Instant;

/// Rounds; a figure is the median of them.
const ROUNDS: usize = 25;
/// Configurations in the arrays that entries run over.
pub const COUNT: usize = 4096;
/// Angles for the unit. The branches of the library's routine go by the angle; with as few angles as these the
/// processor learns them, which makes the unit smaller (by a third on one machine) than with new angles every time.
const UNIT_ANGLES: usize = 6 * 256;

unsafe extern "C" {
    fn sincos(x: f64, s: *mut f64, c: *mut f64);
}

/// The unit U per six angles: direct calls of the C library's `sincos`, results stored.
#[inline(never)]
#[allow(unsafe_code)]
pub fn library_pairs(angles: &[f64], out: &mut [f64]) {
    for (x, pair) in angles.iter().zip(out.chunks_exact_mut(2)) {
        let [s, c] = pair else { continue };
        // SAFETY: both pointers are to numbers that live through the call.
        unsafe { sincos(*x, s, c) }
    }
}

const UNIT_REPEATS: usize = 16;

/// Something to time: what it is, and a run of it.
pub struct Entry<'a> {
    pub group: &'static str,
    pub name: String,
    /// Items that a run handles.
    pub items: usize,
    /// The most it may take, in U, where the project says so.
    pub limit: Option<f64>,
    pub run: Box<dyn FnMut() + 'a>,
}

/// Median and quartiles of the ratios to the unit.
pub struct Figure {
    pub group: &'static str,
    pub name: String,
    pub limit: Option<f64>,
    pub ratio: [f64; 3],
    pub nanoseconds: f64,
}

impl Figure {
    pub fn json(&self) -> serde_json::Value {
        serde_json::json!({
            "group": self.group, "name": self.name, "limit": self.limit, "ns": self.nanoseconds,
            "ratio": self.ratio[1], "quartiles": [self.ratio[0], self.ratio[2]],
        })
    }
}

/// U in ns: six angles by the C library.
pub fn library_unit(angles: &[f64]) -> impl FnMut() -> f64 {
    let angles = &angles[..UNIT_ANGLES];
    let mut pairs = vec![0.0; 2 * UNIT_ANGLES];
    let per_unit = (UNIT_REPEATS * UNIT_ANGLES) as f64 / 6.0;
    move || {
        nanoseconds(|| {
            (0..UNIT_REPEATS).for_each(|_| library_pairs(black_box(angles), black_box(&mut pairs)));
        }) / per_unit
    }
}

/// Times all entries in turn, round by round, as ratios to a unit (ns). Returns the median of the unit as well.
pub fn measure(entries: &mut [Entry], mut unit: impl FnMut() -> f64) -> (f64, Vec<Figure>) {
    let mut units = vec![];
    let mut times: Vec<Vec<(f64, f64)>> = entries.iter().map(|_| vec![]).collect();
    for _ in 0..ROUNDS {
        for (entry, times) in entries.iter_mut().zip(&mut times) {
            // The unit right before what is held against it: the clock of the processor may change.
            let unit = unit();
            units.push(unit);
            let time = nanoseconds(&mut entry.run) / entry.items as f64;
            times.push((time / unit, time));
        }
    }
    let figures = entries.iter().zip(times).map(|(entry, times)| {
        let mut ratios: Vec<f64> = times.iter().map(|t| t.0).collect();
        let mut plain: Vec<f64> = times.iter().map(|t| t.1).collect();
        ratios.sort_by(f64::total_cmp);
        plain.sort_by(f64::total_cmp);
        Figure {
            group: entry.group,
            name: entry.name.clone(),
            limit: entry.limit,
            ratio: [ROUNDS / 4, ROUNDS / 2, ROUNDS * 3 / 4].map(|k| ratios[k]),
            nanoseconds: plain[ROUNDS / 2],
        }
    });
    let figures = figures.collect();
    units.sort_by(f64::total_cmp);
    (units[units.len() / 2], figures)
}

/// Runs of which the least time counts.
const REPEATS: usize = 5;

/// The least time of a few runs, ns.
pub fn nanoseconds(mut run: impl FnMut()) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..REPEATS {
        let start = Instant::now();
        run();
        least = least.min(start.elapsed().as_secs_f64() * 1e9);
    }
    least
}

/// What each item takes, µs: the least of a few rounds over all items.
pub fn times(items: usize, mut run: impl FnMut(usize)) -> Vec<f64> {
    let mut times = vec![f64::INFINITY; items];
    for _ in 0..REPEATS {
        for (item, time) in times.iter_mut().enumerate() {
            let start = Instant::now();
            run(item);
            *time = time.min(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    times
}

/// Times of items, summed up.
pub struct Spread {
    pub mean: f64,
    pub median: f64,
    /// What 99 of 100 items take at most.
    pub p99: f64,
}

impl Spread {
    /// # Panics
    /// If there is no item.
    pub fn of(times: &[f64]) -> Self {
        let mut sorted = times.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at_most = |share: f64| sorted[(share * sorted.len() as f64).ceil() as usize - 1];
        let mean = sorted.iter().sum::<f64>() / sorted.len() as f64;
        Spread { mean, median: at_most(0.5), p99: at_most(0.99) }
    }
}

/// CPU times of some runs, ms.
pub struct Processor {
    pub median: f64,
    least: f64,
    largest: f64,
}

impl Processor {
    pub fn json(&self) -> serde_json::Value {
        serde_json::json!({"median": self.median, "least": self.least, "largest": self.largest})
    }
}

/// The stack of a thread that derives, bytes.
const STACK: usize = 64 << 20;

/// CPU times of `work`, each in a thread of its own; `None` if it is refused, which it says by `false`.
///
/// # Errors
/// If the work fails.
pub fn processor_times(
    name: &'static str,
    repeats: usize,
    work: fn(&str) -> Result<bool>,
) -> Result<Option<Processor>> {
    let mut milliseconds = vec![];
    for _ in 0..repeats {
        let measured = std::thread::Builder::new().stack_size(STACK).spawn(move || -> Result<_> {
            let start = ThreadTime::now();
            let done = work(name)?;
            Ok(done.then(|| start.elapsed().as_secs_f64() * 1e3))
        })?;
        let Ok(time) = measured.join() else { bail!("{name}: the derivation panicked") };
        match time.context(name)? {
            Some(time) => milliseconds.push(time),
            None => return Ok(None),
        }
    }
    milliseconds.sort_by(f64::total_cmp);
    Ok(Some(Processor {
        median: milliseconds[repeats / 2],
        least: milliseconds[0],
        largest: milliseconds[repeats - 1],
    }))
}
