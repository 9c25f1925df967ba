//! `dynamics --simulate`: the motion under torques, as a table, CSV, JSON and a plot.

use super::{Arm, Given, without_mass};
use crate::arguments::DynamicsArguments;
use crate::commands::fk::plural;
use crate::failure::Failure;
use crate::load;
use crate::terminal::{Align, FAINT, HEADING, decimals, note, number, styled, table};
use denavit::description::JointKind;
use denavit::dynamics::{Acting, Method, Moment, NoMotion, Simulation, Torques, simulate};
use denavit::geometry::Vector;
use denavit::quantity::reading;
use denavit_report::figure::drawing::Label;
use denavit_report::figure::plot::{Curve, Panel, curves};
use denavit_report::figure::svg::{Palette, svg};
use denavit_report::figure::symbol;
use denavit_wire::dynamics::{Left, Motion};
use std::fmt::Write as _;
use std::io::Write as _;

/// The estimated error of a step where no step is given.
pub const TOLERANCE: f64 = 1e-10;
/// Samples where no time between them is given.
const USUAL: f64 = 200.0;
/// Rows of the table.
const ROWS: usize = 11;
/// From this line on colours come again, dashed.
const COLOURS: usize = 8;
/// The longest file of torques.
const MAX_BYTES: usize = 1 << 26;

/// What moves: its name, its joints and their limits.
pub struct Moving<'a> {
    /// What people call it.
    pub name: &'a str,
    /// The joints of a sample.
    pub joints: Vec<(String, JointKind)>,
    /// Their limits.
    pub limits: Vec<Option<[f64; 2]>>,
    /// Whether closures hold them together.
    pub is_closed: bool,
}

/// Follows the motion from a state, and prints it.
///
/// # Errors
/// If an option or a file cannot be read, the motion cannot be followed to its end, or nothing can be written.
pub fn run(
    moving: &Moving<'_>,
    arm: &Arm,
    arguments: &DynamicsArguments,
    duration: f64,
    q: &[f64],
    given: Given,
) -> Result<(), Failure> {
    if arguments.at.is_some() {
        return Err(Failure::Usage(
            "--at: --simulate has wrenches of the tool of a chain; leave it away".into(),
        ));
    }
    let wrench = given.wrench.map(|[a, b, c, k, m, n]| [Vector([a, b, c]), Vector([k, m, n])]);
    if wrench.is_some() && arm.is_whole {
        return Err(Failure::Unsupported("--simulate with --wrench for closed loops".into()));
    }
    let torques = acting(arguments, given.tau, arm.joints.len())?;
    let method = match arguments.step {
        Some(step) => Method::Symplectic { step },
        None => usual(),
    };
    let dt = between(arguments, duration);
    let found = simulate(&arm.dynamics, (q, &given.qd), &Acting { torques, wrench }, (duration, dt), method);
    told(moving, found, arguments, method, duration)
}

/// How a motion is integrated where no step is given.
pub fn usual() -> Method {
    Method::Adaptive { tolerance: TOLERANCE }
}

/// The torques over time: of a file, the same at all times, or none.
///
/// # Errors
/// If the file cannot be read.
pub fn acting(
    arguments: &DynamicsArguments,
    tau: Option<Vec<f64>>,
    joints: usize,
) -> Result<Torques, Failure> {
    match &arguments.tau_file {
        Some(file) => torques(file, joints),
        None => Ok(Torques::constant(tau.unwrap_or_else(|| vec![0.0; joints]))),
    }
}

/// The time between samples.
pub fn between(arguments: &DynamicsArguments, duration: f64) -> f64 {
    arguments.dt.unwrap_or(duration / USUAL)
}

/// Prints a motion.
///
/// # Errors
/// If it was not followed to its end, or nothing can be written.
pub fn told(
    moving: &Moving<'_>,
    found: Result<Simulation, (NoMotion, Simulation)>,
    arguments: &DynamicsArguments,
    method: Method,
    duration: f64,
) -> Result<(), Failure> {
    let (found, why, ends) = match found {
        Ok(found) => (found, None, None),
        Err((why, found)) => {
            let ends = why.to_string();
            (found, Some(failure(moving, why)?), Some(ends))
        }
    };
    let mut out = anstream::stdout();
    if arguments.json {
        let left = |(j, t): (usize, f64)| Left { joint: moving.joints[j].0.clone(), t };
        let leaves = found.leaves(&moving.limits).into_iter().map(left).collect();
        writeln!(out, "{}", denavit_wire::text(&Motion::of(moving.name, &found, ends, leaves)))?;
    } else if arguments.csv {
        write!(out, "{}", csv(moving, &found))?;
        note(&remarks(moving, &found, method, duration));
    } else {
        write!(out, "{}", text(moving, &found, method, duration))?;
    }
    if let Some(file) = &arguments.plot {
        std::fs::write(file, picture(moving, &found))
            .map_err(|e| Failure::Input(format!("error: --plot {}: {e}", file.display())))?;
    }
    why.map_or(Ok(()), Err)
}

/// What is said where there is no motion (the error), or none to the end (the value).
fn failure(moving: &Moving<'_>, why: NoMotion) -> Result<Failure, Failure> {
    let usage = |text: &str| Err(Failure::Usage(text.into()));
    match why {
        NoMotion::Singular { joint, .. } => {
            Err(Failure::Input(format!("error: {}", without_mass(&moving.joints[joint].0))))
        }
        NoMotion::Coulomb if moving.is_closed => Err(Failure::Unsupported(
            "--simulate of closed loops with Coulomb's friction (coulomb in the file)".into(),
        )),
        NoMotion::Coulomb => usage(
            "--step: Coulomb's friction has no derivative at rest, and steps of one length do not find where joints stick; leave \
             --step away",
        ),
        NoMotion::Samples => usage("--dt: too many samples"),
        NoMotion::NotPositive => usage("--simulate, --dt and --step are positive"),
        NoMotion::Steps { .. }
        | NoMotion::NotFinite { .. }
        | NoMotion::NotSolved { .. }
        | NoMotion::Meets { .. }
        | NoMotion::Massless { .. } => Ok(Failure::GaveUp(why.to_string())),
    }
}

/// A time and a torque a joint on each line of a file.
fn torques(file: &str, joints: usize) -> Result<Torques, Failure> {
    let wrong = |why: String| Failure::Input(format!("error: {file}: {why}"));
    let text = load::contents(file, MAX_BYTES).map_err(|e| wrong(e.to_string()))?;
    if text.len() > MAX_BYTES {
        return Err(wrong(format!("longer than {MAX_BYTES} bytes")));
    }
    let (mut times, mut rows) = (vec![], vec![]);
    for (k, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim();
        let cells: Vec<&str> =
            line.split([',', ';', ' ', '\t']).map(str::trim).filter(|cell| !cell.is_empty()).collect();
        let values: Vec<Option<f64>> =
            cells.iter().map(|c| c.parse().ok().filter(|x: &f64| x.is_finite())).collect();
        // The head of a table holds no numbers.
        if cells.is_empty() || times.is_empty() && values.iter().all(Option::is_none) {
            continue;
        }
        let place = format!("line {}", k + 1);
        let values: Option<Vec<f64>> = values.into_iter().collect();
        let values = values.ok_or_else(|| wrong(format!("{place}: not all of it are finite numbers")))?;
        if values.len() != joints + 1 {
            let there = plural(values.len(), "number");
            return Err(wrong(format!(
                "{place}: {there}; a time and {} are needed",
                plural(joints, "torque")
            )));
        }
        if times.last().is_some_and(|&t| t >= values[0]) {
            return Err(wrong(format!("{place}: times increase")));
        }
        times.push(values[0]);
        rows.push(values[1..].to_vec());
    }
    Torques::over(times, rows).ok_or_else(|| wrong("no torques in it".into()))
}

/// How it was followed, and how far the energy is out of balance.
fn remarks(moving: &Moving<'_>, found: &Simulation, method: Method, duration: f64) -> String {
    let steps = plural(found.steps, "step");
    let mut text = match method {
        Method::Adaptive { tolerance } => format!(
            "  {steps} of order 5 (Dormand and Prince), {} refused; estimated error of a step at most {tolerance:.0e}\n",
            found.refused
        ),
        Method::Symplectic { .. } => format!("  {steps} of order 4 (Gauss, symplectic)\n"),
    };
    if found.switched > 0 {
        let times = if found.switched == 1 { "once".into() } else { format!("{} times", found.switched) };
        text += &format!("  a joint began to stick or to slide {times}\n");
    }
    let (drift, size) = found.drift();
    let part =
        if size > 0.0 { format!(", {:.0e} of the largest energy", drift / size) } else { String::new() };
    text += &format!(
        "  energy: what is there less what came in and went out is {} J at most{part}\n",
        if drift == 0.0 { "0".into() } else { format!("{drift:.0e}") }
    );
    let reached = found.moments.last().map_or(0.0, |m| m.t);
    if reached < duration {
        text += &format!("  it ends at {} s of {}\n", decimals(reached, 4), decimals(duration, 4));
    }
    for (j, t) in found.leaves(&moving.limits) {
        let name = &moving.joints[j].0;
        text += &format!("  {name} leaves its limits (at {} s): nothing stops it\n", decimals(t, 4));
    }
    text
}

fn text(moving: &Moving<'_>, found: &Simulation, method: Method, duration: f64) -> String {
    let mut text = format!("{}: motion over {} s\n", styled(moving.name, HEADING), decimals(duration, 4));
    text += &remarks(moving, found, method, duration);
    let start = &found.moments[0];
    let mut header = vec!["t / s".to_string()];
    header.extend(moving.joints.iter().map(|j| j.0.clone()));
    header.extend(["kinetic", "potential", "supplied", "friction"].map(String::from));
    let has_wrench = found.moments.iter().any(|m| m.exerted != 0.0);
    header.extend(has_wrench.then(|| "tool".to_string()));
    header.push("imbalance / J".into());
    let last = found.moments.len() - 1;
    let count = ROWS.min(last + 1);
    let size = found.drift().1;
    let row = |k: usize| {
        let m = &found.moments[if count > 1 { k * last / (count - 1) } else { 0 }];
        let mut cells = vec![decimals(m.t, 4)];
        cells.extend(moving.joints.iter().zip(&m.q).map(|((_, kind), &x)| match kind {
            JointKind::Revolute => format!("{}°", decimals(x.to_degrees(), 2)),
            JointKind::Prismatic => reading(x, *kind),
        }));
        let energies = [m.kinetic, m.potential, m.supplied, m.dissipated];
        cells.extend(energies.map(|x| number(x, 1e-14 * size)));
        cells.extend(has_wrench.then(|| number(m.exerted, 1e-14 * size)));
        cells.push(format!("{:.0e}", m.imbalance(start)));
        cells
    };
    let rows: Vec<Vec<String>> = (0..count).map(row).collect();
    let heads: Vec<&str> = header.iter().map(String::as_str).collect();
    text += &format!("\n{}", table(&heads, &vec![Align::Right; heads.len()], &rows));
    let more = "energies in joules, those of torques, friction and tool since the start";
    text += &format!("  {}\n", styled(&format!("({more})"), FAINT));
    if last + 1 > count {
        text += &format!("  {} samples: --csv or --json\n", last + 1);
    }
    text
}

/// A header, and a line a sample.
fn csv(moving: &Moving<'_>, found: &Simulation) -> String {
    let mut header = vec!["t".to_string()];
    for suffix in ["", "_velocity", "_torque"] {
        header.extend(moving.joints.iter().map(|j| format!("{}{suffix}", j.0)));
    }
    header
        .extend(["kinetic", "potential", "supplied", "dissipated", "exerted", "imbalance"].map(String::from));
    let mut out = header.join(",") + "\n";
    let start = &found.moments[0];
    for m in &found.moments {
        let values = [m.t].into_iter().chain(m.q.iter().copied()).chain(m.qd.iter().copied());
        let values = values.chain(m.torques.iter().copied()).chain([
            m.kinetic,
            m.potential,
            m.supplied,
            m.dissipated,
            m.exerted,
            m.imbalance(start),
        ]);
        // The shortest decimals that read back as the same double.
        let line: Vec<String> = values.map(|x| denavit_wire::text(&(x + 0.0))).collect();
        // Writing to memory does not fail.
        let _ = writeln!(out, "{}", line.join(","));
    }
    out
}

/// Joints, velocities and energies over time, as SVG.
fn picture(moving: &Moving<'_>, found: &Simulation) -> String {
    let start = &found.moments[0];
    let of = |value: &dyn Fn(&Moment) -> f64| found.moments.iter().map(|m| [m.t, value(m)]).collect();
    let slides = moving.joints.iter().any(|j| j.1 == JointKind::Prismatic);
    let of_joints = |value: fn(&Moment) -> &[f64]| -> Vec<Curve> {
        let curve = |(j, (name, kind)): (usize, &(String, JointKind))| {
            let (unit, behind) = match kind {
                JointKind::Revolute => (180.0 / std::f64::consts::PI, Label::default()),
                JointKind::Prismatic => (100.0, Label::words(" (cm)")),
            };
            let name = symbol(name).and(behind);
            Curve { name, points: of(&|m| value(m)[j] * unit), is_dashed: j >= COLOURS }
        };
        moving.joints.iter().enumerate().map(curve).collect()
    };
    let label = |turns: &str, slide: &str| {
        Label::words(if slides { format!("{turns} ({slide})") } else { turns.into() })
    };
    let energy = |name: &str, value: &dyn Fn(&Moment) -> f64| Curve {
        name: Label::words(name),
        points: of(value),
        is_dashed: false,
    };
    let panels = [
        Panel { label: label("joints / °", "slides / cm"), curves: of_joints(|m| &m.q) },
        Panel {
            label: label("joint velocities / ° per second", "slides / cm per second"),
            curves: of_joints(|m| &m.qd),
        },
        Panel {
            label: Label::words("energies since the start / J"),
            curves: vec![
                energy("kinetic", &|m| m.kinetic - start.kinetic),
                energy("potential", &|m| m.potential - start.potential),
                energy("supplied by torques", &|m| m.supplied),
                energy("lost to friction", &|m| m.dissipated),
            ],
        },
    ];
    let across = Label::symbol("t", "").and(Label::words(" / s"));
    svg(&curves(&format!("{}: motion", moving.name), &across, &panels, &[]), Palette::File, "motion")
}
