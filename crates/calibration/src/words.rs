//! What is seen and what was found, in English.

use crate::cells::{Place, TableSeen, Tied};
use crate::estimate::{Calibrated, Off};
use crate::fit::LOOKED_AT;
use crate::measurement::{Bar, Measurement};
use crate::model::{Parameter, Problem};
use crate::poses::Chosen;
use crate::table::{CELLS, Cell, Rows, Table};
use crate::visible::{Cause, Visible, formula};
use denavit::description::{Convention, Description};
use denavit::geometry::Axis;

/// What is measured, as a phrase.
pub fn measurement(measurement: Measurement) -> &'static str {
    match measurement {
        Measurement::Pose => "full poses",
        Measurement::Position => "positions of a point",
        Measurement::Orientation => "orientations",
        Measurement::Distance(Bar::Measured) => "distances of a point to a fixed centre",
        Measurement::Distance(Bar::Offset) => "distances of a point to a fixed centre, all off by one number",
        Measurement::Distance(Bar::Fixed) => "a point at one known distance to a fixed centre",
        Measurement::Distance(Bar::FixedUnknown) => "a point at one unknown distance to a fixed centre",
        Measurement::Plane => "a point on a fixed plane",
    }
}

/// A parameter as a phrase.
pub fn parameter(parameter: Parameter, last: usize) -> String {
    let of = |k: usize| if k == last { "tool".into() } else { format!("axis {}", k + 1) };
    match parameter {
        Parameter::Turn(k, axis) => {
            let what = if k == last || axis == Axis::Z { "turn" } else { "tilt" };
            format!("{}: {what} about {axis}", of(k))
        }
        Parameter::Shift(k, axis) => format!("{}: shift along {axis}", of(k)),
        Parameter::Gain(j) => format!("q{}: gain", j + 1),
        Parameter::Fixture(f, k) => format!("plane or centre {}: number {}", f + 1, k + 1),
    }
}

/// Why a combination is not seen.
pub fn cause(cause: Cause, last: usize) -> String {
    match cause {
        Cause::Slide(k, turns, axis) => {
            let what = if turns { "turn about" } else { "shift along" };
            format!("a {what} {axis} of axis {} slides through it", k + 1)
        }
        Cause::Point(axis) => format!("a point has no turn about {axis}"),
        Cause::OnAxis(axis) => format!("the point stays on axis {last}, tilted about {axis}"),
        Cause::Length(k, axis) if k == last => format!("a shift of the tool along {axis} turns nothing"),
        Cause::Length(k, axis) => format!("a shift of axis {} along {axis} turns nothing", k + 1),
        Cause::Everything(turns, axis) => {
            let what = if turns { "turned about" } else { "shifted along" };
            format!("everything {what} {axis} of the base")
        }
        Cause::Scale => "all lengths scaled".into(),
        Cause::Gain(j) => format!("the gain of q{} moves nothing that is measured", j + 1),
        Cause::Found => "by the lengths and angles of this arm".into(),
    }
}

/// Whether joints move axes together, or by gears.
pub fn couplings(problem: &Problem) -> Option<&'static str> {
    let is_plain = |a: &denavit_recording::Moving| matches!(a.terms[..], [(_, by)] if by == 1.0);
    let text = "  joints are coupled: their couplings are taken to be exact, and errors of what couples them are not looked for";
    (!problem.arm.moving.iter().all(is_plain)).then_some(text)
}

/// What a measurement shows.
pub fn seen_lines(
    problem: &Problem,
    visible: &Visible,
    seen: &TableSeen,
    description: &Description,
) -> Vec<String> {
    let turns = problem.arm.moving.iter().filter(|a| a.turns).count();
    let slides = problem.arm.moving.len() - turns;
    let kept = visible.kept.len();
    let counted = formula(problem.measurement, turns, slides);
    let mut lines = vec![format!(
        "{}: {kept} numbers are seen, of {} that the geometry has{}",
        measurement(problem.measurement),
        problem.of_links(),
        match (problem.gains, problem.measurement.of_fixture()) {
            (true, 0) => format!(" and {} gains", problem.arm.joints()),
            (true, n) => format!(", {} gains, and {n} of what stands beside the arm", problem.arm.joints()),
            (false, 0) => String::new(),
            (false, n) => format!(" and {n} of what stands beside the arm"),
        }
    )];
    if !problem.gains && counted == kept {
        lines.push(format!(
            "  as many as {turns} turns and {slides} slides have: 4R + 2P + 6 for full poses, {counted} here; the rank in numbers is {}",
            visible.rank
        ));
    } else {
        lines.push(format!("  the rank in numbers is {}", visible.rank));
    }
    lines.extend(couplings(problem).map(String::from));
    lines.extend(causes(visible, problem.last()));
    lines.push(format!(
        "  of the table's {} cells {} are told apart",
        seen.cells,
        seen.cells - seen.tied.len()
    ));
    lines.extend(seen.tied.iter().map(|t| format!("    {}", tied(t, description))));
    let frames: Vec<&Tied> = seen.with_frames.iter().filter(|t| !seen.tied.contains(t)).collect();
    if !frames.is_empty() {
        lines.push("  where base and tool may be off as well:".into());
        lines.extend(frames.into_iter().map(|t| format!("    {}", tied(t, description))));
    }
    if seen.lacking > 0 {
        lines.push(format!(
            "  {} in no cell: tilts between axes that are parallel, for which a fixed row is added",
            if seen.lacking == 1 {
                "one number stands".into()
            } else {
                format!("{} numbers stand", seen.lacking)
            }
        ));
    }
    lines.push("  a minimal set:".into());
    lines.extend(minimal(problem, visible));
    lines
}

/// Why combinations are not seen.
fn causes(visible: &Visible, last: usize) -> Vec<String> {
    let count = |of: &dyn Fn(Cause) -> bool| visible.null.iter().filter(|n| of(n.cause)).count();
    let mut lines = vec![];
    let mut say = |n: usize, text: &str| {
        if n > 0 {
            lines.push(format!("    {n}: {text}"));
        }
    };
    say(
        count(&|c| matches!(c, Cause::Slide(..))),
        "turns about and shifts along an axis, which slide through it from the link before to the link behind",
    );
    say(count(&|c| matches!(c, Cause::Point(_))), "turns of the tool about its point");
    say(count(&|c| matches!(c, Cause::OnAxis(_))), &format!("tilts of axis {last}, on which the point lies"));
    say(count(&|c| matches!(c, Cause::Length(..))), "shifts, which turn nothing");
    say(
        count(&|c| matches!(c, Cause::Everything(..))),
        "motions of the whole arm with what stands beside it",
    );
    say(count(&|c| c == Cause::Scale), "the scale of all lengths");
    say(count(&|c| matches!(c, Cause::Gain(_))), "gains that move nothing that is measured");
    say(count(&|c| c == Cause::Found), "more, which come with the lengths and angles of this arm");
    if !lines.is_empty() {
        lines.insert(0, "  not seen by any configuration:".into());
    }
    lines
}

/// The minimal set, an axis a line.
fn minimal(problem: &Problem, visible: &Visible) -> Vec<String> {
    let last = problem.last();
    let mut lines: Vec<String> = vec![];
    for k in 0..=last {
        let names: Vec<String> = visible
            .kept
            .iter()
            .filter_map(|&p| match visible.parameters[p] {
                Parameter::Turn(l, a) if l == k => {
                    Some(format!("{} about {a}", if k == last || a == Axis::Z { "turn" } else { "tilt" }))
                }
                Parameter::Shift(l, a) if l == k => Some(format!("shift along {a}")),
                _ => None,
            })
            .collect();
        if !names.is_empty() {
            let of = if k == last { "tool".into() } else { format!("axis {}", k + 1) };
            lines.push(format!("    {of}: {}", names.join(", ")));
        }
    }
    let gains: Vec<String> = visible
        .kept
        .iter()
        .filter_map(|&p| {
            if let Parameter::Gain(j) = visible.parameters[p] { Some(format!("q{}", j + 1)) } else { None }
        })
        .collect();
    if !gains.is_empty() {
        lines.push(format!("    gains: {}", gains.join(", ")));
    }
    lines
}

/// A cell as it is called in its table.
fn place(place: Place, convention: Convention) -> String {
    let of =
        |turns: bool, axis: Axis| format!("{} {axis}", if turns { "turned about" } else { "shifted along" });
    match place {
        Place::Row(row, cell) => format!("{}{}", cell.name(convention), row + 1),
        Place::Base(turns, axis) => format!("the base {}", of(turns, axis)),
        Place::Tool(turns, axis) => format!("the tool {}", of(turns, axis)),
    }
}

/// Cells that are not told apart.
pub fn tied(tied: &Tied, description: &Description) -> String {
    let convention = description.convention;
    let names: Vec<String> = tied.cells.iter().map(|c| place(c.0, convention)).collect();
    let is_frame = |c: &(Place, f64)| !matches!(c.0, Place::Row(..));
    match (&tied.cells[..], &names[..]) {
        ([(one, _)], [name]) => match one {
            Place::Row(..) => format!("{name} moves nothing that is measured"),
            _ => format!("{name}: moves nothing that is measured"),
        },
        ([(_, x), (_, y)], [a, b]) if tied.are_parallel => {
            let what = if x * y < 0.0 { "sum" } else { "difference" };
            let rows: Vec<String> = tied
                .cells
                .iter()
                .filter_map(|c| if let Place::Row(r, _) = c.0 { Some((r + 1).to_string()) } else { None })
                .collect();
            let is_along_x = tied.cells.iter().all(|c| matches!(c.0, Place::Row(_, Cell::A | Cell::Alpha)));
            let axes = if is_along_x { "x axes" } else { "axes" };
            let rows = rows.join(" and ");
            format!("{a} and {b}: the {axes} of rows {rows} are parallel, only the {what} is seen")
        }
        (cells, [.., _]) if cells.iter().any(is_frame) => {
            let own: Vec<&String> =
                cells.iter().zip(&names).filter(|(c, _)| !is_frame(c)).map(|(_, n)| n).collect();
            let frames: Vec<&String> =
                cells.iter().zip(&names).filter(|(c, _)| is_frame(c)).map(|(_, n)| n).collect();
            let own: Vec<String> = own.into_iter().cloned().collect();
            let frames: Vec<String> = frames.into_iter().cloned().collect();
            format!("{} and {}: the same function", own.join(", "), frames.join(", "))
        }
        (_, [before @ .., last]) => format!("{} and {last}: only sums of them are seen", before.join(", ")),
        (_, []) => String::new(),
    }
}

/// What was found, but for the table.
pub fn found_lines(
    problem: &Problem,
    visible: &Visible,
    found: &Calibrated,
    hand: Option<[f64; 2]>,
) -> Vec<String> {
    let of = |o: &Off| off(problem.measurement, o);
    let noise = Off { turn: found.noise[0], shift: found.noise[1] };
    let mut lines = vec![
        format!(
            "  {} of {} numbers are found in these rows",
            visible.kept.len() - found.unseen.len(),
            visible.kept.len()
        ),
        format!(
            "  off before: {}; behind: {}, with a noise of {} in each coordinate",
            of(&found.before),
            of(&found.after),
            of(&noise)
        ),
    ];
    lines.extend(couplings(problem).map(String::from));
    if let Some([before, behind]) = &found.held_out {
        lines.push(format!(
            "  rows that were left out of the fit: {} before, {} behind",
            of(before),
            of(behind)
        ));
    }
    if found.is_computed {
        lines.push(
            "  what is left is rounding: what was measured was computed from these joints, so it is the table that computed it that is found, not the arm"
                .into(),
        );
    }
    if !found.unseen.is_empty() {
        lines.push("  not seen in these rows, and held as the table has it:".into());
        for members in &found.unseen {
            let mut sorted = members.clone();
            sorted.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
            let names: Vec<String> = sorted.iter().take(4).map(|m| parameter(m.0, problem.last())).collect();
            let more =
                if sorted.len() > 4 { format!(", and {} more", sorted.len() - 4) } else { String::new() };
            let with = if sorted.len() > 1 { "together: " } else { "" };
            lines.push(format!("    {with}{}{more}", names.join("; ")));
        }
    }
    if let Some((pivot, with)) = visible.scaled() {
        lines.push(format!(
            "  how long everything is, these measurements do not say: {} is held as the table has it, and {} lengths go with it in proportion, those beside the arm too",
            parameter(visible.parameters[pivot], problem.last()),
            with.len()
        ));
    }
    if let Some([mean, most]) = hand {
        lines.push(format!(
            "  the hand is known to {} (one deviation; the mean of {LOOKED_AT} configurations at random, {} at most in them)",
            millimetres(mean),
            millimetres(most)
        ));
    }
    for fixture in &found.state.fixtures {
        let [x, y, z] = fixture.frame.translation.0.map(|x| 1e3 * x);
        let text = match problem.measurement {
            Measurement::Plane => {
                let [a, b, c] = fixture.frame.rotation.z().0;
                format!("the plane goes through ({x:.2}, {y:.2}, {z:.2}) mm, across ({a:.5}, {b:.5}, {c:.5})")
            }
            Measurement::Distance(Bar::Measured) => format!("the centre is at ({x:.2}, {y:.2}, {z:.2}) mm"),
            Measurement::Distance(Bar::Offset) => format!(
                "the centre is at ({x:.2}, {y:.2}, {z:.2}) mm, and distances are too short by {:.3} mm",
                1e3 * fixture.length
            ),
            _ => format!(
                "the centre is at ({x:.2}, {y:.2}, {z:.2}) mm, at a distance of {:.3} mm",
                1e3 * fixture.length
            ),
        };
        lines.push(format!("  {text}"));
    }
    lines.push("  errors, one deviation each:".into());
    lines.extend(errors(found, problem.last()));
    lines
}

/// The errors, an axis a line.
fn errors(found: &Calibrated, last: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    let mut current = None;
    for e in &found.estimates {
        let name = parameter(e.parameter, last);
        let (of, what) = name.split_once(": ").unwrap_or(("", &name));
        let text = match (e.value, e.parameter) {
            (None, _) => "not seen by itself".into(),
            (Some([x, s]), Parameter::Turn(..)) => {
                format!("{:+.4}° ± {:.4}°", x.to_degrees(), s.to_degrees())
            }
            (Some([x, s]), Parameter::Gain(_)) => format!("{:+.4} % ± {:.4} %", 100.0 * x, 100.0 * s),
            (Some([x, s]), _) => format!("{:+.3} mm ± {:.3} mm", 1e3 * x, 1e3 * s),
        };
        match lines.last_mut() {
            Some(line) if current.as_deref() == Some(of) => *line += &format!(", {what} {text}"),
            _ => lines.push(format!("    {of}: {what} {text}")),
        }
        current = Some(of.to_string());
    }
    lines
}

/// The table, as it is and as it was.
pub fn table_lines(rows: &Rows, table: &Table, convention: Convention) -> Vec<String> {
    let mut lines = vec![
        "  the table, angles in degrees and lengths in millimetres, and by how much it is other:".into(),
    ];
    let shown = |angle: bool, x: f64| if angle { x.to_degrees() } else { 1e3 * x };
    for (k, (own, old)) in table.rows.iter().zip(rows.nominal()).enumerate() {
        let parts: Vec<String> = CELLS
            .iter()
            .enumerate()
            .filter(|(c, cell)| shown(cell.is_angle(), own.cells[*c]).abs() > 5e-5 || old.cells[*c] != 0.0)
            .map(|(c, cell)| {
                let (now, was) = (shown(cell.is_angle(), own.cells[c]), shown(cell.is_angle(), old.cells[c]));
                let by = now - was;
                // Not −0.0000.
                let rounded = |x: f64| (1e4 * x).round() / 1e4 + 0.0;
                let change =
                    if rounded(by) == 0.0 { String::new() } else { format!(" ({:+.4})", rounded(by)) };
                format!("{} {:.4}{change}", cell.name(convention), rounded(now))
            })
            .collect();
        lines.push(format!("    row {}: {}", rows.row_of(k) + 1, parts.join(", ")));
    }
    lines
}

/// How far off what is measured is: of what it has.
pub fn off(measurement: Measurement, o: &Off) -> String {
    match (measurement.has_turns(), measurement.has_shifts()) {
        (true, true) => format!("{} and {}", degrees(o.turn), millimetres(o.shift)),
        (true, false) => degrees(o.turn),
        _ => millimetres(o.shift),
    }
}

/// The poses to measure at.
pub fn chosen_lines(
    measurement: Measurement,
    chosen: &Chosen,
    candidates: usize,
    noise: [f64; 2],
) -> Vec<String> {
    let mut lines = vec![format!(
        "{} configurations chosen out of {candidates}, for a noise of {}",
        chosen.chosen.len(),
        off(measurement, &Off { turn: noise[0], shift: noise[1] })
    )];
    if let (Some([mean, most]), Some([other, other_most])) = (chosen.deviation, chosen.random) {
        lines.push(format!(
            "  the hand will be known to {} (one deviation; the mean of {LOOKED_AT} configurations at random, {} at most in them); measured at as many at random to {}, {} at most",
            millimetres(mean),
            millimetres(most),
            millimetres(other),
            millimetres(other_most)
        ));
    }
    if chosen.unseen > 0 {
        lines.push(format!("  too few to show everything: {} combinations will not be seen", chosen.unseen));
    }
    lines
}

fn digits(x: f64) -> usize {
    match x.abs() {
        x if x >= 100.0 => 0,
        x if x >= 10.0 => 1,
        x if x >= 0.1 || x == 0.0 => 2,
        x if x >= 0.001 => 4,
        _ => 6,
    }
}

/// An angle.
pub fn degrees(x: f64) -> String {
    let x = x.to_degrees();
    if x.abs() < 1e-6 && x != 0.0 { format!("{x:.0e}°") } else { format!("{x:.*}°", digits(x)) }
}

/// A length.
pub fn millimetres(x: f64) -> String {
    let x = 1e3 * x;
    if x.abs() < 1e-6 && x != 0.0 { format!("{x:.0e} mm") } else { format!("{x:.*} mm", digits(x)) }
}
