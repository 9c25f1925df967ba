//! `denavit check ROBOT data.csv`: recorded motion, held against the robot.

use super::{lerobot, recording_plot};
use crate::arguments::CheckArguments;
use crate::failure::{Failure, without_values};
use crate::load;
use crate::terminal::note;
use denavit_recording::words::{self, Names};
use denavit_recording::{Arm, Column, Held, HoldOptions, Recording, Roles, Slip, Unseen, fixed, hold};
use denavit_tables::{Kind, Table};
use denavit_wire::recording as wire;
use std::fs;
use std::io::Write;
use std::path::Path;

/// The most bytes that a recording may have.
const MAX_BYTES: usize = 1 << 30;
/// Fewer rows of numbers than this are no recording: a table in a document.
const LEAST_ROWS: usize = 8;

/// The table of a recording; nothing where the file is a document.
///
/// # Errors
/// If the file can be nothing but a recording, and cannot be read.
pub fn table_of(file: &Path) -> Result<Option<Table>, Failure> {
    let name = file.to_string_lossy();
    let kind = Kind::of(&name);
    let may_be_one = kind.is_some() && (file.is_file() || name == "-");
    if !may_be_one && !lerobot::is_one(file) {
        return Ok(None);
    }
    match whole_table(file) {
        // A table of a document may be written in CSV, too.
        Ok(table) if kind == Some(Kind::Csv) && is_small(&table) => Ok(None),
        Err(NoTable { is_other: true, .. }) => Ok(None),
        Ok(table) => Ok(Some(table)),
        Err(e) => Err(e.into()),
    }
}

/// Why a file is no table.
pub struct NoTable {
    why: Failure,
    /// Whether it may be another kind of text.
    is_other: bool,
}

impl From<NoTable> for Failure {
    fn from(e: NoTable) -> Self {
        e.why
    }
}

impl From<Failure> for NoTable {
    fn from(why: Failure) -> Self {
        NoTable { why, is_other: false }
    }
}

/// The table of a file that is taken for a recording, or of the folder of a data set.
///
/// # Errors
/// If it is none, or cannot be read.
pub fn whole_table(file: &Path) -> Result<Table, NoTable> {
    if lerobot::is_one(file) {
        return Ok(lerobot::table(file)?);
    }
    let name = file.to_string_lossy();
    let failed = |e: &dyn std::fmt::Display| Failure::Input(format!("error: {name}: {e}"));
    let Some(kind) = Kind::of(&name) else {
        return Err(failed(
            &"what is this?\n  = hint: a recording is .csv, .tsv, .jsonl, .npy, .npz, .parquet or the folder of a data set of LeRobot",
        )
        .into());
    };
    denavit_tables::read(&bytes_of(&name)?, kind)
        .map_err(|e| NoTable { why: failed(&e), is_other: e.is_other })
}

/// Says what is worth saying of a table.
pub fn say_remarks(name: &str, table: &Table) {
    for remark in &table.remarks {
        note(&format!("note: {name}: {remark}"));
    }
}

/// The bytes of a file, bounded.
pub fn bytes_of(name: &str) -> Result<Vec<u8>, Failure> {
    let bytes =
        denavit_load::bytes(name, MAX_BYTES).map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
    if bytes.len() > MAX_BYTES {
        let hint = "take a part of the file";
        let most = MAX_BYTES >> 20;
        return Err(Failure::Input(format!("error: {name}: more than {most} MiB\n  = hint: {hint}")));
    }
    Ok(bytes)
}

fn is_small(table: &Table) -> bool {
    let numbers = |c: &&denavit_tables::Column| c.values.iter().any(|x| x.is_finite());
    table.columns.first().is_none_or(|c| c.values.len() < LEAST_ROWS)
        || table.columns.iter().filter(numbers).count() < 7
}

/// Holds a recording against the robot.
///
/// # Errors
/// 1 if something was found, 3 if it is not understood or cannot be read.
pub fn run(arguments: &CheckArguments, name: &str, table: Table) -> Result<(), Failure> {
    let description = load::robot(&arguments.robot)?;
    let robot = &arguments.robot.robot;
    let arm =
        Arm::new(robot, &description).map_err(|missing| without_values(&description, robot, &missing))?;
    let failed = |e: &dyn std::fmt::Display| Failure::Input(format!("error: {name}: {e}"));
    let is_text = matches!(Kind::of(name), Some(Kind::Csv));
    let (first_row, row) = (table.first_row, if is_text { "line" } else { "row" });
    say_remarks(name, &table);
    let recording = Recording { columns: table.columns.into_iter().map(column).collect() };
    let roles = Roles::find(&recording, &arm, &arguments.recording.columns.told()).map_err(|e| failed(&e))?;
    let held = hold(&arm, &recording, &roles, &HoldOptions::default()).map_err(|e| failed(&e))?;
    let of = |c: &usize| recording.columns[*c].name.as_str();
    let names = Names { arm: &arm, columns: roles.joints.iter().map(of).collect(), first_row, row };

    let mut out = anstream::stdout();
    if arguments.json {
        let roles = wire::Roles::of(&recording, &roles);
        writeln!(
            out,
            "{}",
            denavit_wire::text(&wire::Recorded::of(name, &description.name, &held, roles, &names))
        )?;
    } else {
        let dash = if arguments.markdown { "- " } else { "  " };
        writeln!(out, "{name} held against {}: {} rows", description.name, held.rows[0])?;
        writeln!(out, "{dash}{}", columns_said(&recording, &roles))?;
        for line in words::lines(&held, &names) {
            writeln!(out, "{dash}{line}")?;
        }
    }
    let is_told = held.is_understood && held.unseen != [Unseen::Everything];
    if let Some(file) = arguments.recording.recipe.as_ref().filter(|_| is_told) {
        write_whole(file, &held.recipe.to_string())?;
    }
    if let Some(file) = arguments.recording.fix.as_ref().filter(|_| is_told) {
        fix(file, &recording, &roles, &held, &arm)?;
    }
    if let Some(file) = arguments.recording.plot.as_ref().filter(|_| is_told) {
        let title = format!("{name} held against {}", description.name);
        write_whole(file, &recording_plot::picture(&title, &recording, &roles, &held, &arm))?;
    }
    let written = [&arguments.recording.recipe, &arguments.recording.fix, &arguments.recording.plot];
    verdict(&held, written.iter().any(|file| file.is_some()))
}

/// Writes the recording with all of it undone.
fn fix(file: &Path, recording: &Recording, roles: &Roles, held: &Held, arm: &Arm) -> Result<(), Failure> {
    let (fixed, left) = fixed(recording, roles, &held.recipe, arm);
    let column = |c: Column| denavit_tables::Column {
        name: c.name,
        unit: c.said.map(|s| s.symbol().to_string()),
        values: c.values,
    };
    let columns: Vec<_> = fixed.columns.into_iter().map(column).collect();
    write_whole(file, &denavit_tables::written(&columns))?;
    if !left.is_empty() {
        note(&format!("note: {} rows are left out of {}", left.len(), file.display()));
    }
    let lengths = held.findings.iter().any(|f| matches!(f.slip, Slip::Length(_) | Slip::OtherArm(_)));
    if lengths {
        note(&format!("note: {}: the arm itself is another one, which columns cannot undo", file.display()));
    }
    Ok(())
}

/// Whether a file has one of these endings.
///
/// # Errors
/// If it has another one; `what` is what would be written.
pub fn ends_in(file: &Path, endings: &[&str], what: &str) -> Result<(), Failure> {
    match file.extension().and_then(|e| e.to_str()) {
        Some(own) if endings.contains(&own) => Ok(()),
        _ => {
            let list = endings.iter().map(|e| format!(".{e}")).collect::<Vec<_>>().join(" or ");
            Err(Failure::Usage(format!("-o {}: {what} is written as {list}", file.display())))
        }
    }
}

/// Writes a file whole or not at all.
///
/// # Errors
/// If it cannot be written.
pub fn write_whole(file: &Path, text: &str) -> Result<(), Failure> {
    let failed = |e: std::io::Error| Failure::Input(format!("error: {}: {e}", file.display()));
    let mut beside = file.as_os_str().to_owned();
    beside.push(format!(".{}.part", std::process::id()));
    fs::write(&beside, text).map_err(failed)?;
    fs::rename(&beside, file).map_err(|e| {
        let _ = fs::remove_file(&beside);
        failed(e)
    })
}

/// A column with what its header says.
pub fn column(c: denavit_tables::Column) -> Column {
    Column::new(c.name, c.unit.as_deref(), c.values)
}

/// Which columns are taken for what.
fn columns_said(recording: &Recording, roles: &Roles) -> String {
    let name = |c: &usize| recording.columns[*c].name.clone();
    let list = |columns: &[usize]| {
        let runs = columns.windows(2).all(|w| w[1] == w[0] + 1);
        match columns {
            [first, .., last] if runs && columns.len() > 4 => format!("{} … {}", name(first), name(last)),
            _ => columns.iter().map(name).collect::<Vec<_>>().join(", "),
        }
    };
    let time = roles.time.map_or(String::new(), |c| format!("; time {}", name(&c)));
    format!(
        "joints {}; position {}; orientation {}{time}",
        list(&roles.joints),
        list(&roles.position),
        list(&roles.rotation)
    )
}

/// The exit code.
fn verdict(held: &Held, is_asked_for: bool) -> Result<(), Failure> {
    let nothing = if is_asked_for { ", and nothing is written" } else { "" };
    if !held.is_understood {
        return Err(Failure::Input(format!("the recording is not understood{nothing}")));
    }
    if held.unseen == [Unseen::Everything] {
        return Err(Failure::Input(format!("the recording does not move: nothing can be told{nothing}")));
    }
    match held.findings.len() {
        0 => Ok(()),
        1 => Err(Failure::No("1 finding".into())),
        n => Err(Failure::No(format!("{n} findings"))),
    }
}
