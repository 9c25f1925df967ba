//! Joints for poses, row by row.

use crate::MapError;
use crate::arm::Arm;
use crate::columns::Fault;
use crate::outputs::{column, numbers_field};
use crate::request::{Inverse, Orientation, Request, Solutions};
use crate::unit::{Quantity, Scale};
use arrow_array::builder::{Float64Builder, ListBuilder, StringBuilder};
use arrow_array::{ArrayRef, BooleanArray, Int32Array};
use arrow_buffer::NullBuffer;
use arrow_schema::{DataType, Field, FieldRef};
use denavit::description::Description;
use denavit::geometry::orientation::{OrientationSet, rotation};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::inverse::{InverseKinematics, InverseOptions};
use denavit_wire::inverse::status_within;
use std::borrow::Cow;
use std::sync::Arc;

/// A solver, and what is wanted of it.
#[derive(Clone)]
pub struct Solver {
    pub wish: Inverse,
    inverse: InverseKinematics,
}

/// A hint where a robot cannot be solved.
const HINT: &str = "`denavit ik ROBOT --explain` says what can be solved";

impl Solver {
    /// Prepares it.
    ///
    /// # Errors
    /// If there is none, or it needs values of joints beside the pose.
    pub fn of(d: &Description, wish: Inverse) -> Result<Self, MapError> {
        let inverse = InverseKinematics::new(d, &InverseOptions::default())
            .map_err(|why| MapError::new(format!("{}: {why}", d.name), HINT))?;
        if !inverse.given.is_empty() {
            let what = format!("{} has joints whose values are to be given beside a pose", d.name);
            return Err(MapError::new(what, HINT));
        }
        Ok(Solver { wish, inverse })
    }

    /// How its columns are declared.
    pub fn fields(&self, arm: &Arm, request: &Request) -> Vec<FieldRef> {
        let prefix = &request.prefix;
        let joints = |label: &str| -> Vec<Field> {
            let each = arm.joints.iter().zip(&arm.is_angle);
            each.map(|([joint, _], &is_angle)| {
                let unit = Quantity::of_joint(is_angle, 0).unit(request.units);
                numbers_field(format!("{prefix}{label}_{joint}"), DataType::Float64, unit)
            })
            .collect()
        };
        let plain = |name: &str, kind| numbers_field(format!("{prefix}ik_{name}"), kind, None);
        let mut fields = match self.wish.solutions {
            Solutions::Lists => {
                let kinds = arm.is_angle.iter().all(|&x| x).then(|| Quantity::Angle(0).unit(request.units));
                let kinds = kinds.flatten();
                vec![numbers_field(format!("{prefix}ik"), solutions_type(), kinds)]
            }
            Solutions::Slots(count) => (1..=count).flat_map(|k| joints(&format!("ik{k}"))).collect(),
            Solutions::Nearest => {
                let mut all = joints("ik");
                all.push(plain("distance", DataType::Float64));
                all.push(plain("within_limits", DataType::Boolean));
                all
            }
        };
        fields.push(plain("count", DataType::Int32));
        fields.push(plain("families", DataType::Int32));
        fields.push(plain("complete", DataType::Boolean));
        fields.push(plain("status", DataType::Utf8));
        fields.into_iter().map(Arc::new).collect()
    }

    /// The columns of poses; `faults` learns which rows hold none.
    pub fn columns(
        &self,
        arm: &Arm,
        request: &Request,
        pose: &[Cow<'_, [f64]>],
        near: Option<&[Cow<'_, [f64]>]>,
        faults: &mut [Fault],
        more: &mut u64,
    ) -> Vec<ArrayRef> {
        let (rows, n) = (faults.len(), arm.joints.len());
        let scales: Vec<Scale> =
            arm.is_angle.iter().map(|&a| Quantity::of_joint(a, 0).scale(request.units)).collect();
        let mut said = Said::default();
        let mut lists = ListBuilder::new(ListBuilder::new(Float64Builder::new()));
        let slots = match self.wish.solutions {
            Solutions::Lists => 0,
            Solutions::Slots(count) => count,
            Solutions::Nearest => 1,
        };
        let mut places = vec![vec![0.0; rows]; slots * n];
        let mut filled = vec![vec![false; rows]; slots];
        let (mut distance, mut within) = (vec![0.0; rows], vec![false; rows]);
        for row in 0..rows {
            if faults[row] == Fault::None && at(pose, row, request.orientation).is_none() {
                faults[row] = Fault::NoPose;
            }
            let target = (faults[row] == Fault::None).then(|| at(pose, row, request.orientation)).flatten();
            let Some(target) = target else {
                said.nothing();
                lists.append(false);
                continue;
            };
            let mut answer = self.inverse.solve(&target, &[]);
            // Before anything is left out: a family may have a member within the limits, and it is the nearest.
            let nearest = near.and_then(|near| {
                let to: Vec<f64> = near.iter().map(|c| c[row]).collect();
                self.inverse.nearest(&target, &answer, &to)
            });
            let nearest = nearest.filter(|found| found.within_limits || !self.wish.limits);
            let left_out = self.wish.limits.then(|| answer.leave_out(&self.inverse.space));
            said.count.push(i32::try_from(answer.solutions.len()).unwrap_or(i32::MAX));
            said.families.push(i32::try_from(answer.families.len()).unwrap_or(i32::MAX));
            said.complete.push(answer.is_complete());
            said.status.append_value(status_within(&answer, left_out));
            said.is_there.push(true);
            let mut put = |slot: usize, q: &[f64]| {
                filled[slot][row] = true;
                q.iter().enumerate().for_each(|(j, x)| places[slot * n + j][row] = *x);
            };
            match self.wish.solutions {
                Solutions::Lists => {
                    for s in &answer.solutions {
                        let each = s.q.iter().zip(&scales).map(|(x, scale)| Some(scale.undo(*x) + 0.0));
                        lists.values().append_value(each);
                    }
                    lists.append(true);
                }
                Solutions::Slots(count) => {
                    *more += u64::from(answer.solutions.len() > count);
                    answer.solutions.iter().take(count).enumerate().for_each(|(k, s)| put(k, &s.q));
                }
                Solutions::Nearest => {
                    if let Some(found) = nearest {
                        put(0, &found.q);
                        (distance[row], within[row]) = (found.distance, found.within_limits);
                    }
                }
            }
        }
        let mut columns: Vec<ArrayRef> = vec![];
        if self.wish.solutions == Solutions::Lists {
            columns.push(Arc::new(lists.finish()));
        }
        let nulls: Vec<NullBuffer> = filled.into_iter().map(NullBuffer::from).collect();
        for (k, values) in places.into_iter().enumerate() {
            columns.push(column(values, scales[k % n], nulls.get(k / n)));
        }
        if self.wish.solutions == Solutions::Nearest {
            columns.push(column(distance, Scale::One, nulls.first()));
            columns.push(Arc::new(BooleanArray::new(within.into(), nulls.first().cloned())));
        }
        columns.extend(said.finish());
        columns
    }
}

/// A list of solutions, each a list of joint variables.
fn solutions_type() -> DataType {
    let list = |of: DataType| DataType::List(Arc::new(Field::new("item", of, true)));
    list(list(DataType::Float64))
}

/// What is said of each pose.
#[derive(Default)]
struct Said {
    count: Vec<i32>,
    families: Vec<i32>,
    complete: Vec<bool>,
    status: StringBuilder,
    is_there: Vec<bool>,
}

impl Said {
    fn nothing(&mut self) {
        self.count.push(0);
        self.families.push(0);
        self.complete.push(false);
        self.status.append_null();
        self.is_there.push(false);
    }

    fn finish(mut self) -> [ArrayRef; 4] {
        let nulls = Some(NullBuffer::from(self.is_there)).filter(|n| n.null_count() > 0);
        [
            Arc::new(Int32Array::new(self.count.into(), nulls.clone())),
            Arc::new(Int32Array::new(self.families.into(), nulls.clone())),
            Arc::new(BooleanArray::new(self.complete.into(), nulls)),
            Arc::new(self.status.finish()),
        ]
    }
}

/// The pose of a row: a position and an orientation, or a matrix row by row.
fn at(columns: &[Cow<'_, [f64]>], row: usize, orientation: Orientation) -> Option<Transform<f64>> {
    let x = |k: usize| columns[k][row];
    if columns.len() == 16 {
        return Transform::from_matrix([0, 4, 8, 12].map(|r| [0, 1, 2, 3].map(|c| x(r + c)))).ok();
    }
    let turned: Vec<f64> = (3..columns.len()).map(x).collect();
    let turned = match orientation {
        Orientation::Set(set) => rotation(set, &turned).ok()?,
        Orientation::Vector => {
            let angle = turned.iter().fold(0.0, |length: f64, x| length.hypot(*x));
            if angle == 0.0 {
                Rotation::identity()
            } else {
                let axis = [turned[0] / angle, turned[1] / angle, turned[2] / angle, angle];
                rotation(OrientationSet::AxisAngle, &axis).ok()?
            }
        }
    };
    Some(Transform::from_rotation_translation(turned, Vector([x(0), x(1), x(2)])))
}
