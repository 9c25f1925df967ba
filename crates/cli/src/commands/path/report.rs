//! The path in words: what was met, what else is possible, how it was timed.

use crate::terminal::{Align, HEADING, decimals, styled, table, words};
use denavit::description::{Description, JointKind};
use denavit::motion::follow::{Alternative, Event};
use denavit::motion::plan::{Planned, Sampled};
use denavit::quantity::reading;

/// Rows of the table.
const ROWS: usize = 11;

/// Everything for reading.
pub fn text(d: &Description, planned: &Planned, sampled: &Sampled) -> String {
    let duration = planned.trajectory.duration();
    let mut text = format!(
        "{}: {}, {} s\n",
        styled(&d.name, HEADING),
        words().course(&planned.course),
        decimals(duration, 4)
    );
    text += &remarks(d, planned);
    let variables = d.variables();
    let mut header = vec!["t / s".to_string()];
    header.extend(variables.iter().map(|v| v.symbol.name().to_string()));
    header.extend(["x / m", "y / m", "z / m", "manipulability"].map(String::from));
    let last = sampled.samples.len() - 1;
    let count = ROWS.min(last + 1);
    let row = |k: usize| {
        let s = &sampled.samples[if count > 1 { k * last / (count - 1) } else { 0 }];
        let mut cells = vec![decimals(s.t, 4)];
        cells.extend(variables.iter().zip(&s.state.q).map(|(v, &x)| match v.kind {
            JointKind::Revolute => format!("{}°", decimals(x.to_degrees(), 2)),
            JointKind::Prismatic => decimals(x, 4),
        }));
        cells.extend(s.pose.translation.0.map(|x| decimals(x, 4)));
        cells.push(decimals(s.manipulability, 5));
        cells
    };
    let rows: Vec<Vec<String>> = (0..count).map(row).collect();
    let heads: Vec<&str> = header.iter().map(String::as_str).collect();
    text += "\n";
    text += &table(&heads, &vec![Align::Right; heads.len()], &rows);
    if last + 1 > count {
        let every = decimals(sampled.dt, 6);
        text += &format!("  {} samples, one every {every} s: --format csv, ndjson or json\n", last + 1);
    }
    text
}

/// Timing, events, alternatives.
pub fn remarks(d: &Description, planned: &Planned) -> String {
    let mut text = format!("  timing: {}\n", words().timing(&planned.timing, d));
    if let Some(held) = &planned.timing.held {
        text += &format!("  {}\n", words().shares_of_limits(held));
    }
    let Some(followed) = &planned.followed else { return text };
    for event in &followed.events {
        text += &format!("  {}\n", self::event(d, event));
    }
    if followed.events.is_empty() {
        text += "  no singular configuration and no joint limit is met\n";
    }
    text += &format!(
        "  the hand leaves its path by {} mm and {}° at most (measured at eight places between each two of {} samples)\n",
        decimals(1e3 * followed.deviation, 5),
        decimals(followed.turned.to_degrees(), 5),
        followed.joints.parameters().len()
    );
    if let Some(nearest) = &followed.clearance {
        text += &format!(
            "  nearest to a singular configuration at {} %: the smallest singular value is {} (lengths by the reach)\n",
            decimals(100.0 * nearest.s, 2),
            decimals(nearest.smallest, 5)
        );
    }
    text += match (followed.certified, followed.clearance.is_some()) {
        (true, true) => {
            "  nothing on the way is singular (the Jacobian's rate bounds what happens between the samples)\n"
        }
        (false, true) => "  a singular configuration on the way is not excluded where that value is small\n",
        (true, false) => {
            "  no other change of sign of a factor of det J between the samples (intervals over estimated boxes of joints)\n"
        }
        (false, false) => {
            "  between some samples a factor of det J comes so near to 0 that its sign is not certain\n"
        }
    };
    if !planned.alternatives.is_empty() {
        text += "  starts:\n";
        for a in &planned.alternatives {
            text += &format!("    {}\n", alternative(d, a));
        }
    }
    text
}

fn event(d: &Description, event: &Event) -> String {
    format!("at {} % {}", decimals(100.0 * event.s, 3), words().event(event, d))
}

fn alternative(d: &Description, a: &Alternative) -> String {
    let q: Vec<String> = d.variables().iter().zip(&a.start).map(|(v, &x)| reading(x, v.kind)).collect();
    let far = if a.reached >= 1.0 {
        "goes to the end".to_string()
    } else {
        format!("ends at {} %", decimals(100.0 * a.reached, 2))
    };
    let limits = if a.within_limits { "" } else { ", leaves the limits" };
    let singular = match a.singular {
        0 => String::new(),
        n => format!(", {}", crate::commands::fk::plural(n, "singular configuration")),
    };
    let branch =
        if a.branch.is_empty() { String::new() } else { format!("  ({})", words().branch(&a.branch)) };
    format!("{}{branch}: {far}{limits}{singular}", q.join(", "))
}
