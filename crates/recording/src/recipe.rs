//! What was found, to be applied: from the columns of a recording to the joints and poses of the model, and as a text to edit.
//!
//! q = sign · gain · (unit · column) − zero, whole turns undone; then couplings; then what was fitted behind them. The pose is
//! decoded, turned round, scaled, seen from the robot's base and without the tool. What was fitted carries its deviation.

use crate::arm::{Arm, half_turn};
use crate::data::{Data, Direction};
use crate::decode::{Form, Format};
use crate::finding::{Finding, Off, Slip};
use crate::fit::Extra;
use crate::hypothesis::{Move, Unit};
use crate::recording::{Recording, Roles};
use crate::search::Reading;
use denavit::geometry::{Axis, Rotation, Transform, Vector};

/// In what a joint's column is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ColumnUnit {
    /// So many radians or metres.
    Times(f64),
    /// −100 to 100 for a range, radians or metres.
    Range([f64; 2]),
}

/// What a joint's column holds.
#[derive(Clone, PartialEq, Debug)]
pub struct JointColumn {
    /// The column's name.
    pub column: String,
    /// Its unit.
    pub unit: ColumnUnit,
    /// Whether its sign is reversed.
    pub is_reversed: bool,
    /// What the joint moves for one of the column.
    pub gain: f64,
    /// What the column is ahead, radians or metres.
    pub zero: f64,
    /// A turn of the column, where it jumps by whole ones.
    pub turn: Option<f64>,
    /// What is fitted behind the couplings: a gain and a zero.
    pub behind: [f64; 2],
}

/// Rows that are not to be used.
#[derive(Clone, PartialEq, Debug)]
pub struct Rows {
    /// The first, from 0.
    pub from: usize,
    /// Behind the last.
    pub to: usize,
    /// The column that is at fault; none for the pose.
    pub column: Option<String>,
    /// Why.
    pub cause: String,
}

/// A recipe.
#[derive(Clone, PartialEq, Debug)]
pub struct Recipe {
    /// The robot.
    pub robot: String,
    /// What its table is, in a number: a recipe is of one table.
    pub table: String,
    /// The joints' columns, in the order of the model.
    pub joints: Vec<JointColumn>,
    /// Joints from whose value a multiple of the one before is taken.
    pub couplings: Vec<(usize, f64)>,
    /// By how many rows the pose is behind, and seconds, where there is a time.
    pub delay: (f64, Option<f64>),
    /// The columns of the position.
    pub position: Vec<String>,
    /// How many of its unit are one of the model's.
    pub scale: f64,
    /// The axis that is mirrored.
    pub mirror: Option<Axis>,
    /// The columns of the orientation.
    pub rotation: Vec<String>,
    /// Its format.
    pub format: Format,
    /// How the pose is meant.
    pub direction: Direction,
    /// The robot's base in the recording.
    pub base: Transform<f64>,
    /// The recorded frame in the robot's tool.
    pub tool: Transform<f64>,
    /// Lengths of the arm that are other ones: the constant, its coordinate, and by how much, metres.
    pub lengths: Vec<(usize, usize, f64)>,
    /// Rows that are not to be used.
    pub rows: Vec<Rows>,
    /// How far the hand is off: radians, metres.
    pub left_over: Off,
}

/// A number of an arm's constants (FNV-1a of their bits to nine digits).
pub fn table_of(arm: &Arm) -> String {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for x in arm.constants.iter().flat_map(|c| c.matrix().concat()) {
        for byte in format!("{:.9}", x + 0.0).replace("-0.000000000", "0.000000000").bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
    format!("{hash:016x}")
}

impl Recipe {
    /// Of columns that are what they are said to be.
    pub fn plain(recording: &Recording, roles: &Roles, arm: &Arm) -> Self {
        let name = |&c: &usize| recording.columns[c].name.clone();
        let said = |&c: &usize| recording.columns[c].said.map_or(1.0, crate::recording::Said::si);
        let joints = roles.joints.iter().take(arm.joints()).map(|c| JointColumn {
            column: name(c),
            unit: ColumnUnit::Times(said(c)),
            is_reversed: false,
            gain: 1.0,
            zero: 0.0,
            turn: None,
            behind: [1.0, 0.0],
        });
        let form =
            Form::all().into_iter().find(|f| f.width() == roles.rotation.len()).unwrap_or(Form::Matrix);
        Recipe {
            robot: arm.name.clone(),
            table: table_of(arm),
            joints: joints.collect(),
            couplings: vec![],
            delay: (0.0, None),
            position: roles.position.iter().map(name).collect(),
            scale: roles.position.first().map_or(1.0, |c| 1.0 / said(c)),
            mirror: None,
            rotation: roles.rotation.iter().map(name).collect(),
            format: Format { form, degrees: false },
            direction: Direction::Direct,
            base: Transform::identity(),
            tool: Transform::identity(),
            lengths: vec![],
            rows: vec![],
            left_over: Off::default(),
        }
    }

    /// Of a reading.
    pub(crate) fn of(
        recording: &Recording,
        roles: &Roles,
        data: &Data,
        reading: &Reading,
        findings: &[Finding],
        left_over: Off,
    ) -> Self {
        let arm = reading.arm;
        let mut recipe = Recipe::plain(recording, roles, arm);
        let name = |k: usize| recording.columns[roles.joints[k]].name.clone();
        let said = |k: usize| recording.columns[roles.joints[k]].said.map_or(1.0, crate::recording::Said::si);
        let has_couplings = !reading.map.couplings.is_empty();
        recipe.joints = (0..arm.joints())
            .map(|i| {
                let k = reading.map.pick[i];
                let in_degrees = reading.hypothesis.moves.contains(&Move::Degrees(i));
                let unit = match reading.hypothesis.unit {
                    Unit::Hundred => ColumnUnit::Range(arm.limits[i]),
                    Unit::Degrees if arm.turns[i] => ColumnUnit::Times(said(k) * 1_f64.to_radians()),
                    Unit::Radians if arm.turns[i] => ColumnUnit::Times(said(k) / 1_f64.to_radians()),
                    _ if in_degrees => ColumnUnit::Times(said(k) * 1_f64.to_radians()),
                    _ => ColumnUnit::Times(said(k)),
                };
                let within = match unit {
                    ColumnUnit::Times(x) => x / said(k),
                    ColumnUnit::Range([low, high]) => (high - low) / 200.0,
                };
                let middle = match unit {
                    ColumnUnit::Times(_) => 0.0,
                    ColumnUnit::Range([low, high]) => 0.5 * (low + high),
                };
                // scale · c + shift = g (within · c + middle) − zero
                let mut g = reading.map.scale[i] / within;
                let mut zero = g * middle - reading.map.shift[i];
                let mut behind = [1.0, 0.0];
                for &(extra, value) in &reading.fit.extras {
                    let to = match extra {
                        Extra::Zero(j) if j == i => [1.0, value],
                        Extra::Gain(j) if j == i => [1.0 + value, 0.0],
                        _ => continue,
                    };
                    behind = [behind[0] * to[0], behind[1] * to[0] + to[1]];
                }
                if !has_couplings && !reading.fit.extras.iter().any(|e| matches!(e.0, Extra::Couple(_))) {
                    (g, zero) = (g * behind[0], zero * behind[0] + behind[1]);
                    behind = [1.0, 0.0];
                }
                JointColumn {
                    column: name(k),
                    unit,
                    is_reversed: g < 0.0,
                    gain: if (g.abs() - 1.0).abs() < 1e-12 { 1.0 } else { g.abs() },
                    zero: zero + 0.0,
                    turn: data.columns.jumps.iter().find(|j| j.column == k).map(|j| j.turn),
                    behind,
                }
            })
            .collect();
        recipe.couplings = reading.map.couplings.clone();
        let fitted = |e: &(Extra, f64)| if let Extra::Couple(i) = e.0 { Some((i, e.1)) } else { None };
        recipe.couplings.extend(reading.fit.extras.iter().filter_map(fitted));
        let lag =
            reading.fit.extras.iter().filter(|e| e.0 == Extra::Lag).map(|e| e.1).sum::<f64>() + reading.lag;
        recipe.delay = (lag, data.columns.step.map(|s| s * lag));
        let said_length = data.columns.said_length.map_or(1.0, crate::recording::Said::si);
        recipe.scale = reading.fit.frames.scale.abs() / said_length;
        recipe.mirror = reading.mirror;
        recipe.format = data.decoded[reading.format].format;
        recipe.format.degrees |= data.columns.rotation_degrees;
        recipe.direction = reading.direction;
        let (base, tool) = reading.plain_frames();
        (recipe.base, recipe.tool) = (base, tool);
        let length =
            |e: &(Extra, f64)| if let Extra::Length(k, axis) = e.0 { Some((k, axis, e.1)) } else { None };
        recipe.lengths = reading.fit.extras.iter().filter_map(length).collect();
        for finding in findings {
            match &finding.slip {
                Slip::Stuck(s) => recipe.rows.push(Rows {
                    from: s.from,
                    to: s.to,
                    column: Some(name(reading.map.pick[s.joint])),
                    cause: "stuck".into(),
                }),
                Slip::Spikes(rows) => recipe.rows.extend(rows.iter().map(|&r| Rows {
                    from: r,
                    to: r + 1,
                    column: None,
                    cause: "spike".into(),
                })),
                _ => {}
            }
        }
        recipe.left_over = left_over;
        recipe
    }

    /// The joints of the model out of their columns in a row, whole turns undone before.
    pub fn joints_of(&self, row: &[f64]) -> Vec<f64> {
        let one = |(j, x): (&JointColumn, &f64)| {
            let x = match j.unit {
                ColumnUnit::Times(k) => k * x,
                ColumnUnit::Range([low, high]) => 0.5 * (low + high) + x * (high - low) / 200.0,
            };
            (if j.is_reversed { -j.gain } else { j.gain }) * x - j.zero
        };
        let mut q: Vec<f64> = self.joints.iter().zip(row).map(one).collect();
        for &(i, k) in &self.couplings {
            q[i] -= k * q[i - 1];
        }
        for (q, j) in q.iter_mut().zip(&self.joints) {
            *q = j.behind[0] * *q - j.behind[1];
        }
        q
    }

    /// The pose of the model's tool out of what is recorded of it; nothing where the orientation is none.
    pub fn pose_of(&self, position: [f64; 3], rotation: &[f64]) -> Option<Transform<f64>> {
        let turn = self.format.read(rotation)?;
        let (turn, at) = self.direction.read((turn, Vector(position)));
        let mut seen = Transform::from_rotation_translation(turn, at.scale(1.0 / self.scale));
        if let Some(axis) = self.mirror {
            // S R S and S p for the mirror S = −M.
            let m = half_turn(axis);
            seen = Transform::from_rotation_translation(m * turn * m, -(m * seen.translation));
        }
        Some(self.base.inverse() * seen * self.tool.inverse())
    }

    /// What would be recorded of a pose of the model's tool: the opposite of [`Recipe::pose_of`].
    pub fn recorded(&self, pose: &Transform<f64>, before: Option<&[f64]>) -> ([f64; 3], Vec<f64>) {
        let mut seen = self.base * *pose * self.tool;
        if let Some(axis) = self.mirror {
            let m = half_turn(axis);
            seen = Transform::from_rotation_translation(m * seen.rotation * m, -(m * seen.translation));
        }
        let at = seen.translation.scale(self.scale);
        // Each direction undoes itself.
        let (turn, at): (Rotation<f64>, _) = self.direction.read((seen.rotation, at));
        (at.0, self.format.write(&turn, before))
    }

    /// True if a row is not to be used.
    pub fn leaves_out(&self, row: usize) -> bool {
        self.rows.iter().any(|r| (r.from..r.to).contains(&row))
    }
}
