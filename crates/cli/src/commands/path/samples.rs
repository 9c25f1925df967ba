//! The motion at regular times, as it is printed.

use denavit::description::Description;
use denavit::motion::plan::{Sample, Sampled};
use denavit_wire::path as wire;
use std::fmt::Write;

/// A header, and a line a sample: time, joints, velocities, accelerations, position, rotation row by row,
/// manipulability.
pub fn csv(sampled: &Sampled, description: &Description) -> String {
    let names: Vec<String> = description.variables().iter().map(|v| v.symbol.name().to_string()).collect();
    let mut header = vec!["t".to_string()];
    for suffix in ["", "_velocity", "_acceleration"] {
        header.extend(names.iter().map(|n| format!("{n}{suffix}")));
    }
    header.extend(["x", "y", "z"].map(String::from));
    header.extend((0..9).map(|k| format!("r{}{}", k / 3 + 1, k % 3 + 1)));
    header.push("manipulability".into());
    let mut out = header.join(",") + "\n";
    for s in &sampled.samples {
        let rotation = s.pose.rotation.rows();
        let values = [s.t]
            .into_iter()
            .chain(s.state.q.iter().copied())
            .chain(s.state.qd.iter().copied())
            .chain(s.state.qdd.iter().copied())
            .chain(s.pose.translation.0)
            .chain(rotation.into_iter().flatten())
            .chain([s.manipulability]);
        // The shortest decimals that read back as the same double.
        let line: Vec<String> = values.map(|x| denavit_wire::text(&(x + 0.0))).collect();
        // Writing to memory does not fail.
        let _ = writeln!(out, "{}", line.join(","));
    }
    out
}

/// An object a line.
pub fn ndjson(sampled: &Sampled) -> String {
    sampled.samples.iter().map(|s| format!("{}\n", denavit_wire::text(&sample(s)))).collect()
}

/// As other programs read it.
pub fn samples(sampled: &Sampled) -> Vec<wire::Sample> {
    sampled.samples.iter().map(sample).collect()
}

fn sample(s: &Sample) -> wire::Sample {
    wire::Sample {
        acceleration: s.state.qdd.clone(),
        manipulability: s.manipulability,
        pose: s.pose.matrix(),
        q: s.state.q.clone(),
        t: s.t,
        velocity: s.state.qd.clone(),
    }
}
