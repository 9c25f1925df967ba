//! `denavit calibrate`: the geometry of an arm out of measurements.

use crate::arguments::{CalibrateArguments, MeasureName};
use crate::commands::check::recording::{bytes_of, column, ends_in, say_remarks, whole_table, write_whole};
use crate::commands::fk;
use crate::failure::{Failure, without_values};
use crate::load;
use crate::terminal::note;
use denavit::Description;
use denavit::description::{Decimals, Measure, Mechanism, read_urdf, write_urdf};
use denavit::geometry::{Transform, Vector};
use denavit_calibration::measured::{NoMeasurements, Prepared, What, prepare, slips};
use denavit_calibration::visible::supposed;
use denavit_calibration::{
    Bar, CalibrateOptions, Calibrated, Measurement, NoTable, Problem, Rows, Visible, calibrate, choose_poses,
    deviation_of_hand, table_seen, visible, words,
};
use denavit_recording::words::{Names, finding};
use denavit_recording::{Arm, Recipe, Recording, Roles, Slip};
use denavit_tables::Kind;
use denavit_wire::calibration as wire;
use std::io::Write;
use std::path::Path;

/// Noise that is counted with where nothing says it: of a good tracker, radians and metres.
const USUAL: [f64; 2] = [0.000_349_065_850_398_865_9, 0.1e-3];

/// Calibrates an arm, says what can be, or chooses poses.
///
/// # Errors
/// 1 if the rows do not show all that such measurements can, 3 if they cannot be read, have a slip or are not of the arm.
pub fn run(arguments: &CalibrateArguments) -> Result<(), Failure> {
    let description = load::robot(&arguments.robot)?;
    let robot = &arguments.robot.robot;
    let arm =
        Arm::new(robot, &description).map_err(|missing| without_values(&description, robot, &missing))?;
    if arm.joints() == 0 {
        return Err(Failure::Unsupported(format!("{robot} has no joints")));
    }
    let what = what(arguments)?;
    let of_noise = arguments.noise.as_ref().filter(|_| arguments.choose.is_none()).map(|_| "--noise");
    if let (None, Some(option)) = (&arguments.file, arguments.columns.given().or(of_noise)) {
        return Err(Failure::Usage(format!("{option} is for measurements: say in which file they stand")));
    }
    if let Some(output) = &arguments.output {
        match (&arguments.file, arguments.choose) {
            (Some(_), _) => ends_in(output, &["toml", "urdf"], "the calibrated arm")?,
            (None, Some(_)) => ends_in(output, &["csv"], "the list of configurations")?,
            (None, None) => return Err(Failure::Usage("-o needs measurements, or --choose".into())),
        }
    }
    match (&arguments.file, arguments.choose) {
        (Some(file), _) => measured(arguments, &description, &arm, what, file),
        (None, Some(count)) => chosen(arguments, &description, &arm, &what, count),
        (None, None) => seen(arguments, &description, &arm, &what),
    }
}

/// What is measured, but for its columns.
fn what(arguments: &CalibrateArguments) -> Result<What, Failure> {
    let has_distance = arguments.distance.is_some();
    let measurement = match arguments.measure {
        MeasureName::Pose => Measurement::Pose,
        MeasureName::Position => Measurement::Position,
        MeasureName::Orientation => Measurement::Orientation,
        MeasureName::Plane => Measurement::Plane,
        MeasureName::Distance => {
            Measurement::Distance(match (has_distance, arguments.offset, &arguments.bar) {
                (true, true, _) => Bar::Offset,
                (false, _, Some(_)) => Bar::Fixed,
                (false, _, None) if arguments.file.is_some() => Bar::FixedUnknown,
                _ => Bar::Measured,
            })
        }
    };
    for (is_given, option, is_for) in [
        (has_distance, "--distance", matches!(measurement, Measurement::Distance(_))),
        (arguments.bar.is_some(), "--bar", matches!(measurement, Measurement::Distance(_))),
        (arguments.group.is_some(), "--group", measurement.of_fixture() > 0),
        (arguments.point.is_some(), "--point", measurement.is_of_point()),
    ] {
        if is_given && !is_for {
            return Err(Failure::Usage(format!(
                "{option} is not for --measure {}",
                wire::measure(measurement)
            )));
        }
    }
    let length = |text: &str| value(text, Measure::Length);
    let point = match &arguments.point {
        None => Vector([0.0; 3]),
        Some(text) => {
            let parts = load::list(text);
            let [x, y, z] = parts[..] else {
                return Err(Failure::Usage(format!("--point {text}: three lengths, as in 20mm, 0, 110mm")));
            };
            Vector([length(x)?, length(y)?, length(z)?])
        }
    };
    Ok(What {
        measurement,
        point,
        gains: arguments.gains,
        distance: None,
        group: None,
        length: arguments.bar.as_deref().map(length).transpose()?,
        recipe: None,
        is_unchecked: arguments.unchecked,
        is_robust: arguments.robust,
    })
}

/// A number with its unit.
fn value(text: &str, measure: Measure) -> Result<f64, Failure> {
    let found = load::value_of(text, measure).and_then(fk::value);
    found.map_err(|why| {
        let what = if measure == Measure::Angle { "angle" } else { "length" };
        Failure::Usage(format!("`{text}` is no {what}: {why}"))
    })
}

/// The deviations that are told: of an angle, and of a length.
fn noise(text: &str) -> Result<[f64; 2], Failure> {
    let (mut angle, mut length) = (None, None);
    for part in load::list(text) {
        let is_angle = ["deg", "°", "rad"].iter().any(|u| part.ends_with(u));
        let x = value(part, if is_angle { Measure::Angle } else { Measure::Length })?;
        if x.is_nan() || x <= 0.0 {
            return Err(Failure::Usage(format!("--noise {part}: not above 0")));
        }
        *(if is_angle { &mut angle } else { &mut length }) = Some(x);
    }
    match (angle, length) {
        (None, None) => {
            Err(Failure::Usage("--noise: an angle, a length or both, as in 0.1mm, 0.02deg".into()))
        }
        // One alone: the other as it usually is beside it.
        (Some(a), None) => Ok([a, a * USUAL[1] / USUAL[0]]),
        (None, Some(l)) => Ok([l * USUAL[0] / USUAL[1], l]),
        (Some(a), Some(l)) => Ok([a, l]),
    }
}

/// What can be seen at all.
fn seen(
    arguments: &CalibrateArguments,
    description: &Description,
    arm: &Arm,
    what: &What,
) -> Result<(), Failure> {
    let (problem, seen) = structure(arm, what)?;
    let table = table_seen(description, &problem, &seen).map_err(|e| no_table(&e))?;
    let mut out = anstream::stdout();
    if arguments.json {
        let answer = wire::Seen::of(&description.name, &problem, &seen, &table);
        writeln!(out, "{}", denavit_wire::text(&answer))?;
        return Ok(());
    }
    writeln!(out, "{}", description.name)?;
    for line in words::seen_lines(&problem, &seen, &table, description) {
        writeln!(out, "{line}")?;
    }
    Ok(())
}

/// What is seen, planes and centres supposed where the arm reaches them.
fn structure(arm: &Arm, what: &What) -> Result<(Problem, Visible), Failure> {
    let fixtures = supposed(arm, what.measurement, what.point, 1);
    let mut problem = Problem::new(arm, what.measurement, what.point, what.gains, fixtures);
    if let (Some(length), Measurement::Distance(Bar::Fixed)) = (what.length, what.measurement) {
        problem.fixtures.iter_mut().for_each(|f| f.length = length);
    }
    if problem.samples(40, 1).len() < 20 {
        return Err(Failure::Unsupported(
            "no configurations were found at which the point is at that distance".into(),
        ));
    }
    let seen = visible(&problem);
    Ok((problem, seen))
}

/// The configurations to measure at.
fn chosen(
    arguments: &CalibrateArguments,
    description: &Description,
    arm: &Arm,
    what: &What,
    count: usize,
) -> Result<(), Failure> {
    if what.measurement.of_fixture() > 0 {
        return Err(Failure::Unsupported(
            "--choose for distances and planes: where they stand decides which configurations there are"
                .into(),
        ));
    }
    if count == 0 || arguments.candidates < count || arguments.candidates > 20_000 {
        return Err(Failure::Usage("--choose N of --candidates M: 1 ≤ N ≤ M ≤ 20000".into()));
    }
    let noise = arguments.noise.as_deref().map(noise).transpose()?.unwrap_or(USUAL);
    let (problem, seen) = structure(arm, what)?;
    let candidates = problem.samples(arguments.candidates, arguments.seed);
    let chosen = choose_poses(&problem, &seen, &candidates, count, noise, arguments.seed);
    let mut csv = String::new();
    let unit = |t: &bool| if *t { "rad" } else { "m" };
    let head: Vec<String> =
        arm.names.iter().zip(&arm.turns).map(|(n, t)| format!("{n} [{}]", unit(t))).collect();
    csv.push_str(&(head.join(",") + "\n"));
    for &c in &chosen.chosen {
        let row: Vec<String> = candidates[c].iter().map(|x| format!("{x:.6}")).collect();
        csv.push_str(&(row.join(",") + "\n"));
    }
    if let Some(file) = &arguments.output {
        write_whole(file, &csv)?;
    }
    let mut out = anstream::stdout();
    if arguments.json {
        let answer = wire::Poses::of(&description.name, what.measurement, &chosen, &candidates, noise);
        writeln!(out, "{}", denavit_wire::text(&answer))?;
        return Ok(());
    }
    write!(out, "{}: ", description.name)?;
    for line in words::chosen_lines(what.measurement, &chosen, candidates.len(), noise) {
        writeln!(out, "{line}")?;
    }
    if arguments.output.is_none() {
        write!(out, "{csv}")?;
    }
    Ok(())
}

/// Measurements of the arm.
fn measured(
    arguments: &CalibrateArguments,
    description: &Description,
    arm: &Arm,
    mut what: What,
    file: &Path,
) -> Result<(), Failure> {
    let name = file.to_string_lossy().into_owned();
    let failed = |e: &dyn std::fmt::Display| Failure::Input(format!("error: {name}: {e}"));
    let table = whole_table(file)?;
    say_remarks(&name, &table);
    let is_text = matches!(Kind::of(&name), Some(Kind::Csv));
    let (first_row, row) = (table.first_row, if is_text { "line" } else { "row" });
    let recording = Recording { columns: table.columns.into_iter().map(column).collect() };
    let needed = match what.measurement {
        Measurement::Pose => [true, true],
        Measurement::Position => [true, false],
        Measurement::Orientation => [false, true],
        _ => [false, false],
    };
    let roles =
        Roles::find_parts(&recording, arm, &arguments.columns.told(), needed).map_err(|e| failed(&e))?;
    let by_name = |wanted: &Option<String>| match wanted {
        None => Ok(None),
        Some(wanted) => match recording.columns.iter().position(|c| c.name == *wanted) {
            Some(at) => Ok(Some(at)),
            None => Err(failed(&format!("there is no column `{wanted}`"))),
        },
    };
    (what.distance, what.group) = (by_name(&arguments.distance)?, by_name(&arguments.group)?);
    if let Some(path) = &arguments.recipe {
        let shown = path.display();
        let bytes = bytes_of(&path.to_string_lossy())?;
        let text = String::from_utf8_lossy(&bytes);
        let recipe = Recipe::read(&text).map_err(|e| Failure::Input(format!("error: {shown}: {e}")))?;
        recipe.is_of(arm).map_err(|e| Failure::Input(format!("error: {shown}: {e}")))?;
        what.recipe = Some(recipe);
    }
    let of = |c: &usize| recording.columns[*c].name.as_str();
    let names = Names { arm, columns: roles.joints.iter().map(of).collect(), first_row, row };
    let prepared = prepare(arm, &recording, &roles, &what)
        .map_err(|e| no_measurements(&e, &arguments.robot.robot, &what, &name, &names))?;
    if let Some(held) = &prepared.held {
        held.findings.iter().for_each(|f| note(&format!("note: {name}: {}", finding(f, held, &names))));
    }
    let Prepared { problem, measured, rows, left, every, base, tool, .. } = &prepared;
    let seen = visible(problem);
    let options = CalibrateOptions {
        noise: arguments.noise.as_deref().map(noise).transpose()?,
        is_robust: arguments.robust,
        folds: arguments.folds,
    };
    let found = calibrate(problem, &seen, measured, &options).map_err(|e| failed(&e))?;
    let written = Written::new(description, &what, &prepared, &found).map_err(|e| no_table(&e))?;
    let hand = deviation_of_hand(problem, &seen, &found);
    if let Some(output) = &arguments.output {
        write_whole(output, &written.in_format(output)?)?;
    }
    let mut out = anstream::stdout();
    if arguments.json {
        let texts = [name.as_str(), description.name.as_str(), written.text.as_str()];
        let answer = wire::Found::of(texts, problem, &seen, &found, (rows, *every), hand);
        writeln!(out, "{}", denavit_wire::text(&answer))?;
    } else {
        writeln!(
            out,
            "{name}: {} rows of {}, against {}",
            rows.len(),
            words::measurement(what.measurement),
            description.name
        )?;
        if *left > 0 {
            writeln!(out, "  {left} rows are left out: a number is missing, or the pose jumps")?;
        }
        if *every > 1 {
            writeln!(out, "  of the rows that are whole one in {every} is used, evenly spread")?;
        }
        let frames = [
            ("the base stands elsewhere in what is measured", base),
            ("what is measured is not the tool but a frame in it", tool),
        ];
        for (text, frame) in frames {
            if *frame != Transform::identity() {
                let [x, y, z] = frame.translation.0.map(|x| 1e3 * x);
                writeln!(out, "  {text}: at ({x:.1}, {y:.1}, {z:.1}) mm; the calibrated arm has it so")?;
            }
        }
        for line in words::found_lines(problem, &seen, &found, hand) {
            writeln!(out, "{line}")?;
        }
        for &r in &found.aside {
            let off = found.residuals[r];
            writeln!(
                out,
                "  {row} {}: left aside, {} off",
                rows[r] + first_row,
                words::off(what.measurement, &off)
            )?;
        }
        for line in words::table_lines(&written.rows, &written.table, description.convention) {
            writeln!(out, "{line}")?;
        }
    }
    match found.unseen.len() {
        0 => Ok(()),
        1 => Err(Failure::No("1 combination is not seen in these rows".into())),
        n => Err(Failure::No(format!("{n} combinations are not seen in these rows"))),
    }
}

/// The calibrated arm, written and read back.
struct Written<'a> {
    rows: Rows<'a>,
    table: denavit_calibration::Table,
    text: String,
    back: Description,
}

impl<'a> Written<'a> {
    fn new(
        description: &'a Description,
        what: &What,
        prepared: &Prepared,
        found: &Calibrated,
    ) -> Result<Self, NoTable> {
        let problem = &prepared.problem;
        let mut constants = problem.constants_at(&found.state);
        // The point is no part of the tool.
        let last = problem.last();
        let [x, y, z] = what.point.0;
        constants[last] = constants[last] * Transform::translation(-x, -y, -z);
        let gains = what.gains.then(|| found.state.x[problem.of_links()..].to_vec());
        let rows = Rows::new(description)?;
        let table = rows.table(&constants);
        let how = words::measurement(what.measurement);
        let before = description.source.as_deref().map_or(String::new(), |s| format!("; before: {s}"));
        let source = format!("calibrated with {} rows of {how}{before}", prepared.rows.len());
        let text = rows.text(&table, gains.as_deref(), Some(source));
        let at: Vec<Vec<f64>> = prepared.measured.joints.iter().take(200).cloned().collect();
        let back = rows.read_back(&text, &constants, gains.as_deref(), &at)?;
        Ok(Written { rows, table, text, back })
    }

    /// The text for a file of this ending.
    fn in_format(&self, output: &Path) -> Result<String, Failure> {
        match output.extension().and_then(|e| e.to_str()) {
            Some("urdf") => {
                let bodies =
                    Mechanism::of(&self.back).map_err(|missing| no_table(&NoTable::Missing(missing)))?;
                let text = write_urdf(&bodies);
                let back = read_urdf(&text, Decimals::AsWritten).ok().and_then(|(m, _)| {
                    Some(m.chain(Some("base"), Some("tool"), self.back.convention).ok()?.description)
                });
                let far = |back: &Description| -> Option<f64> {
                    let (a, b) = (Arm::new("", &self.back).ok()?, Arm::new("", back).ok()?);
                    let q: Vec<f64> = a.limits.iter().map(|l| 0.4 * l[0] + 0.6 * l[1]).collect();
                    let (x, y) = (a.pose(&q).matrix().concat(), b.pose(&q).matrix().concat());
                    Some(x.iter().zip(&y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max))
                };
                match back.as_ref().and_then(far) {
                    Some(by) if by < 1e-9 => {
                        note(
                            "note: the URDF has the chain alone, with the calibrated axes; looks are those of a sketch",
                        );
                        Ok(text)
                    }
                    by => Err(no_table(&NoTable::NotBack(by.unwrap_or(f64::INFINITY)))),
                }
            }
            _ => Ok(self.text.clone()),
        }
    }
}

fn no_table(e: &NoTable) -> Failure {
    match e {
        NoTable::Screw(_) | NoTable::NoAxis => Failure::Unsupported(e.to_string()),
        _ => Failure::Input(format!("error: {e}")),
    }
}

/// Why columns are no measurements, with what to do.
fn no_measurements(e: &NoMeasurements, robot: &str, what: &What, name: &str, names: &Names) -> Failure {
    let check = format!("denavit check {robot} {name}");
    match e {
        NoMeasurements::Slips(held) => {
            let mut text = String::new();
            let all = slips(held, what);
            if !held.is_understood || all.is_empty() {
                text += &format!("error: {name}: the recording is not understood against {robot}");
                text += &format!(
                    "\n  = hint: `{check}` says more; --unchecked takes the columns as they are said"
                );
            } else {
                for f in &all {
                    text += &format!("error: {name}: {}\n", finding(f, held, names));
                }
                text += &if all.iter().all(|f| matches!(f.slip, Slip::Apart(..))) {
                    "  = hint: --robust lets such rows count for little; --unchecked takes all as they are said".into()
                } else {
                    format!(
                        "  = hint: a slip is no matter of calibration: run `{check} --fix clean.csv` first, and calibrate with clean.csv; --unchecked takes the columns as they are said"
                    )
                };
            }
            Failure::Input(text)
        }
        other => Failure::Input(format!("error: {name}: {other}")),
    }
}
