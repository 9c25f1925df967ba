//! A recording with what a recipe says done to it: the model's joints in radians and metres, the pose of its tool in its base.

use crate::arm::Arm;
use crate::columns::cubic;
use crate::recipe::{JointColumn, Recipe};
use crate::recording::{Column, Recording, Roles, Said};
use denavit::geometry::Transform;

/// A row with what a recipe says done to it.
#[derive(Clone, PartialEq, Debug)]
pub struct Row {
    /// Its number, from 0.
    pub row: usize,
    /// The model's joints.
    pub q: Vec<f64>,
    /// The pose of the model's tool in its base.
    pub pose: Transform<f64>,
}

/// The rows, and the numbers of those that are left out: those that the recipe leaves out, those in which a number is missing,
/// and those at an end for which a delay leaves no joints. Nothing where a column of the recipe is not there.
pub fn rows(recording: &Recording, roles: &Roles, recipe: &Recipe) -> Option<(Vec<Row>, Vec<usize>)> {
    let find = |name: &String| recording.columns.iter().position(|c| c.name == *name);
    let unwrapped_column = |j: &JointColumn| {
        find(&j.column).map(|c| unwrapped(&recording.columns[c].values, unit_of(recording, c, j.turn)))
    };
    let columns: Vec<Vec<f64>> = recipe.joints.iter().map(unwrapped_column).collect::<Option<_>>()?;
    let value = |c: usize, r: usize| recording.columns[c].values[r];
    let (mut kept, mut left) = (vec![], vec![]);
    for row in 0..recording.columns.first().map_or(0, |c| c.values.len()) {
        let rotation: Vec<f64> = roles.rotation.iter().map(|&c| value(c, row)).collect();
        let position = std::array::from_fn(|k| roles.position.get(k).map_or(f64::NAN, |&c| value(c, row)));
        let at: Option<Vec<f64>> = columns.iter().map(|c| at(c, row as f64 - recipe.delay.0)).collect();
        let is_whole = |x: &[f64]| x.iter().all(|x| x.is_finite());
        match (at, recipe.pose_of(position, &rotation)) {
            (Some(columns), Some(pose))
                if !recipe.leaves_out(row) && is_whole(&columns) && is_whole(&pose.translation.0) =>
            {
                kept.push(Row { row, q: recipe.joints_of(&columns), pose });
            }
            _ => left.push(row),
        }
    }
    Some((kept, left))
}

/// The recording, and the numbers of its rows that are left out: those that the recipe leaves out, those in which a number is
/// missing, and those at an end for which a delay leaves no joints.
pub fn fixed(recording: &Recording, roles: &Roles, recipe: &Recipe, arm: &Arm) -> (Recording, Vec<usize>) {
    let Some((rows, left)) = rows(recording, roles, recipe) else { return (Recording::default(), vec![]) };
    let column =
        |name: &str, said: Option<Said>, values: Vec<f64>| Column { name: name.into(), said, values };
    let as_it_stands = |c: usize| {
        let own = &recording.columns[c];
        column(&own.name, own.said, rows.iter().map(|r| own.values[r.row]).collect())
    };
    let mut out: Vec<Column> = roles.time.into_iter().chain(roles.episode).map(as_it_stands).collect();
    for (i, name) in arm.names.iter().enumerate() {
        let said = if arm.turns[i] { Said::Radians } else { Said::Metres };
        out.push(column(name, Some(said), rows.iter().map(|r| r.q[i]).collect()));
    }
    for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
        out.push(column(name, Some(Said::Metres), rows.iter().map(|r| r.pose.translation[k]).collect()));
    }
    // Quaternions: one format that every reader knows.
    let format = crate::decode::Format { form: crate::decode::Form::QuaternionXyzw, degrees: false };
    let mut turns: Vec<Vec<f64>> = vec![];
    for r in &rows {
        turns.push(format.write(&r.pose.rotation, turns.last().map(Vec::as_slice)));
    }
    for (k, name) in ["qx", "qy", "qz", "qw"].into_iter().enumerate() {
        out.push(column(name, None, turns.iter().map(|t| t[k]).collect()));
    }
    let used = |c: usize| {
        roles.time == Some(c)
            || roles.episode == Some(c)
            || [&roles.joints, &roles.position, &roles.rotation].iter().any(|l| l.contains(&c))
    };
    let is_named = |name: &str| out.iter().any(|c: &Column| c.name == name);
    let others: Vec<usize> =
        (0..recording.columns.len()).filter(|&c| !used(c) && !is_named(&recording.columns[c].name)).collect();
    out.extend(others.into_iter().map(as_it_stands));
    (Recording { columns: out }, left)
}

/// A turn of a column in its own numbers: a recipe has it in radians where a header says degrees.
fn unit_of(recording: &Recording, c: usize, turn: Option<f64>) -> Option<f64> {
    turn.map(|t| t / recording.columns[c].said.map_or(1.0, Said::si))
}

/// A column without jumps of whole turns.
fn unwrapped(values: &[f64], turn: Option<f64>) -> Vec<f64> {
    let Some(turn) = turn else { return values.to_vec() };
    let (mut turns, mut last) = (0.0, f64::NAN);
    let one = |&x: &f64| {
        if x.is_finite() && last.is_finite() {
            turns += ((x - last) / turn).round();
        }
        if x.is_finite() {
            last = x;
        }
        x - turn * turns
    };
    values.iter().map(one).collect()
}

/// The value of a column at a place between its rows.
fn at(column: &[f64], place: f64) -> Option<f64> {
    if place.fract() == 0.0 {
        return if place >= 0.0 { column.get(place as usize).copied() } else { None };
    }
    if place < 0.0 || place > (column.len() - 1) as f64 {
        return None;
    }
    let (i, f) = (place.floor() as usize, place.fract());
    if i >= 1 && i + 2 < column.len() {
        let w = cubic(f);
        return Some((0..4).map(|k| w[k] * column[i + k - 1]).sum());
    }
    Some(column[i] + f * (column[i + 1] - column[i]))
}
