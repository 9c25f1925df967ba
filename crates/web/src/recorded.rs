//! Recorded motion held against the robot: what was found, and the motion to be played.

use crate::motion::{Path, manipulability};
use crate::refusal::Refusal;
use crate::subject::Subject;
use denavit_recording::words::{Names, lines};
use denavit_recording::{Arm, Column, Held, HoldOptions, Recipe, Recording, Roles, Told};
use denavit_recording::{deviations, fixed, hold, rows, seconds};
use denavit_tables::{Kind, Table};
use denavit_wire::pose::matrix;
use denavit_wire::recording as wire;
use serde::{Deserialize, Serialize};

/// A recording that is asked about: the bytes of a file, or the columns that something else has read out of one.
#[derive(Deserialize)]
pub struct Wish {
    name: String,
    /// A character a byte.
    latin1: Option<String>,
    #[serde(default)]
    columns: Vec<Given>,
}

/// A column; null where a number is missing.
#[derive(Deserialize)]
struct Given {
    name: String,
    values: Vec<Option<f64>>,
}

/// The most rows that are played, and how many of them are shown a second where no column tells the time.
const MOST: usize = 2_000;
const A_SECOND: f64 = 25.0;

/// What is told of a recording.
#[derive(Serialize)]
pub struct Answer {
    /// The recording with all of it undone, as CSV; nothing where it is not understood.
    fixed: Option<String>,
    /// What was found, line by line.
    lines: Vec<String>,
    /// As the command line tells it.
    recorded: wire::Recorded,
    /// What is worth saying of the file.
    remarks: Vec<String>,
    /// The motion: with all of it undone, and, where something was found, as the columns stand.
    views: Vec<View>,
}

/// The motion under a recipe.
#[derive(Serialize)]
struct View {
    /// By the joints, with the recorded poses of the hand.
    path: Path,
    /// How far the hand is off: the farthest row at each sample, metres.
    shift: Vec<f64>,
    /// The same in radians.
    turn: Vec<f64>,
}

/// Holds a recording against the robot.
///
/// # Errors
/// If the file is no table, or its columns cannot be what they are taken for.
pub fn recording(subject: &Subject, wish: Wish) -> Result<Answer, Refusal> {
    let name = wish.name.clone();
    let table = table(wish)?;
    let missing = |symbols: denavit::description::MissingValue| Refusal::new(symbols.to_string());
    let arm = Arm::new(&subject.description.name, &subject.valued).map_err(missing)?;
    let column = |c: denavit_tables::Column| Column::new(c.name, c.unit.as_deref(), c.values);
    let recording = Recording { columns: table.columns.into_iter().map(column).collect() };
    let refused = |why: &dyn std::fmt::Display| in_lines(&why.to_string());
    let roles = Roles::find(&recording, &arm, &Told::default()).map_err(|e| refused(&e))?;
    let held = hold(&arm, &recording, &roles, &HoldOptions::default()).map_err(|e| refused(&e))?;
    let of = |c: &usize| recording.columns[*c].name.as_str();
    let row = if Kind::of(&name) == Some(Kind::Csv) { "line" } else { "row" };
    let names =
        Names { arm: &arm, columns: roles.joints.iter().map(of).collect(), first_row: table.first_row, row };
    let mut views = vec![];
    views.extend(view(subject, &recording, &roles, &held.recipe, &arm, "with all of it undone"));
    if !held.findings.is_empty() {
        let stand = held.as_columns_stand(&recording, &roles, &arm);
        views.extend(view(subject, &recording, &roles, &stand, &arm, "as the columns stand"));
    }
    Ok(Answer {
        fixed: held.is_understood.then(|| written(&recording, &roles, &held, &arm)),
        lines: lines(&held, &names),
        recorded: wire::Recorded::of(
            &name,
            &subject.description.name,
            &held,
            wire::Roles::of(&recording, &roles),
            &names,
        ),
        remarks: table.remarks,
        views,
    })
}

fn table(wish: Wish) -> Result<Table, Refusal> {
    let Some(text) = wish.latin1 else {
        let column = |g: Given| denavit_tables::Column {
            name: g.name,
            unit: None,
            values: g.values.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect(),
        };
        let columns: Vec<_> = wish.columns.into_iter().map(column).collect();
        if columns.windows(2).any(|w| w[0].values.len() != w[1].values.len()) {
            return Err(Refusal::new("the columns are not of one length"));
        }
        let mut table = Table { columns, first_row: 1, remarks: vec![] };
        table.split_units();
        return Ok(table);
    };
    let bytes: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap_or(b'?')).collect();
    let kind = Kind::of(&wish.name).ok_or_else(|| Refusal {
        error: format!("{}: what is this?", wish.name),
        hint: Some("A recording is .csv, .tsv, .jsonl, .npy, .npz or .parquet.".into()),
    })?;
    denavit_tables::read(&bytes, kind).map_err(|e| Refusal { error: e.what, hint: Some(e.hint) })
}

/// A refusal whose hint stands in a line of its own.
fn in_lines(words: &str) -> Refusal {
    match words.split_once("\n  = hint: ") {
        Some((error, hint)) => Refusal { error: error.into(), hint: Some(hint.into()) },
        None => Refusal::new(words),
    }
}

fn written(recording: &Recording, roles: &Roles, held: &Held, arm: &Arm) -> String {
    let column = |c: Column| denavit_tables::Column {
        name: c.name,
        unit: c.said.map(|s| s.symbol().to_string()),
        values: c.values,
    };
    let (fixed, _) = fixed(recording, roles, &held.recipe, arm);
    denavit_tables::written(&fixed.columns.into_iter().map(column).collect::<Vec<_>>())
}

/// The motion under a recipe; nothing where no row has all of its numbers.
fn view(
    subject: &Subject,
    recording: &Recording,
    roles: &Roles,
    recipe: &Recipe,
    arm: &Arm,
    how: &str,
) -> Option<View> {
    let (kept, _) = rows(recording, roles, recipe)?;
    let off = deviations(recording, roles, recipe, arm);
    let times = seconds(recording, roles);
    let share = kept.len().div_ceil(MOST).max(1);
    let shown: Vec<_> = kept.chunks(share).collect();
    let time = |row: usize| times.as_ref().map_or(row as f64 / A_SECOND, |all| all[row]);
    let start = time(shown.first()?[0].row);
    let t: Vec<f64> = shown.iter().map(|rows| time(rows[0].row) - start).collect();
    let q: Vec<Vec<f64>> = shown.iter().map(|rows| rows[0].q.clone()).collect();
    if q[0].len() != subject.space.is_angle.len() {
        return None;
    }
    let farthest = |value: fn(&denavit_recording::Off) -> f64| -> Vec<f64> {
        let of = |rows: &&[denavit_recording::Row]| {
            rows.iter().filter_map(|r| off[r.row].as_ref()).map(value).fold(0.0, f64::max)
        };
        shown.iter().map(of).collect()
    };
    let timing = match times {
        Some(_) => format!("{} rows", recording.columns.first().map_or(0, |c| c.values.len())),
        None => format!("no column tells the time: {A_SECOND} rows a second"),
    };
    Some(View {
        shift: farthest(|o| o.shift),
        turn: farthest(|o| o.turn),
        path: Path {
            duration: t.last().copied().unwrap_or(0.0),
            energy: None,
            events: vec![],
            manipulability: q.iter().map(|q| manipulability(subject, q)).collect(),
            path: format!("recorded motion, {how}"),
            pose: shown.iter().map(|rows| matrix(&rows[0].pose)).collect(),
            velocity: rates(&t, &q),
            q,
            reached: 1.0,
            starts: vec![],
            t,
            timing,
            torque: None,
        },
    })
}

/// Velocities by differences of neighbours.
fn rates(t: &[f64], q: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let one = |k: usize| {
        let (a, b) = (k.saturating_sub(1), (k + 1).min(t.len() - 1));
        let span = t[b] - t[a];
        let rate = |(x, y): (&f64, &f64)| if span > 0.0 { (y - x) / span } else { 0.0 };
        q[a].iter().zip(&q[b]).map(rate).collect()
    };
    (0..t.len()).map(one).collect()
}
