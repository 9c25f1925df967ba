//! Which column is the time, which the number of the episode, and in what the time is counted.

use crate::recording::Said;
use crate::spelled::plain;

/// Names of the time, its unit left aside.
const TIMES: &[&str] =
    &["t", "time", "timestamp", "stamp", "seconds", "timesec", "elapsed", "headerstamp", "timestamps"];
/// Names of the time where no column has one of those.
const SELDOM: &[&str] = &["secs", "sec", "rostime", "frametime"];

/// The column of the time: the first of a name that is known for it, or of one that is said to be in a unit of time.
pub fn column_of_time(names: &[&str], is_said: impl Fn(usize) -> bool) -> Option<usize> {
    let is_time = |k: &usize| TIMES.contains(&plain(names[*k]).as_str()) || is_said(*k);
    (0..names.len()).find(is_time).or_else(|| named(names, SELDOM))
}

/// The column of the number of the episode.
pub fn column_of_episodes(names: &[&str]) -> Option<usize> {
    named(names, &["episodeindex", "episode"])
}

fn named(names: &[&str], known: &[&str]) -> Option<usize> {
    known.iter().find_map(|k| names.iter().position(|n| plain(n) == *k))
}

/// Seconds in what a header says that the time is in; none if that is no unit of time.
pub fn seconds_said(unit: &str) -> Option<f64> {
    match unit.trim().to_lowercase().as_str() {
        "min" => Some(60.0),
        other => Said::named(other).filter(|s| s.is_time()).map(Said::si),
    }
}

/// Seconds in what the time is in where no header says it, by the usual step and the largest time: recordings have 1 to 10,000
/// rows a second.
pub fn seconds_by_step(step: f64, times: &[f64]) -> f64 {
    match step {
        d if d >= 5e4 => 1e-9,
        d if d >= 50.0 && times.iter().any(|t| t.abs() > 1e9) => 1e-6,
        d if d >= 1.5 => 1e-3,
        _ => 1.0,
    }
}
