//! A mapping with its inputs found: batch in, batch out.

use crate::MapError;
use crate::columns::{Fault, Input, Read, Wanted, names_of};
use crate::inverse::Solver;
use crate::mapping::{Compiled, Mapping, POSE, POSITION, evaluate, pose_columns};
use crate::outputs::{Output, column};
use crate::rates::Mobility;
use crate::request::{Keep, Orientation, Solutions};
use crate::unit::{Angle, Length, Quantity, Scale};
use arrow_array::{ArrayRef, RecordBatch, RecordBatchOptions};
use arrow_buffer::NullBuffer;
use arrow_schema::{FieldRef, Schema, SchemaRef};
use denavit::geometry::orientation::{OrientationSet, extract};
use denavit::geometry::{Rotation, Transform, Vector};
use std::borrow::Cow;
use std::sync::Arc;

/// A mapping for batches of one schema.
#[derive(Clone)]
pub struct Bound {
    of: Arc<Compiled>,
    inputs: Inputs,
    /// Columns that go through.
    kept: Vec<usize>,
    schema: SchemaRef,
}

/// What is read; nothing where it is not needed.
#[derive(Clone, Default)]
struct Inputs {
    joints: Option<Input>,
    velocities: Option<Input>,
    accelerations: Option<Input>,
    pose: Option<Input>,
    near: Option<Input>,
}

/// Rows that were computed, and those in which something is the matter.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Counts {
    /// All rows.
    pub rows: u64,
    /// Rows with a null among their inputs.
    pub nulls: u64,
    /// Rows with what is no finite number.
    pub not_finite: u64,
    /// Rows whose pose is none: its matrix is no rotation, or its quaternion 0.
    pub no_pose: u64,
    /// Rows with more solutions than places for them.
    pub more_solutions: u64,
    /// The first row, from 0, with something the matter.
    pub first_fault: Option<u64>,
}

impl Counts {
    /// With those of the rows behind.
    pub fn add(&mut self, next: &Counts) {
        self.first_fault = self.first_fault.or(next.first_fault.map(|row| row + self.rows));
        self.rows += next.rows;
        self.nulls += next.nulls;
        self.not_finite += next.not_finite;
        self.no_pose += next.no_pose;
        self.more_solutions += next.more_solutions;
    }

    /// Rows with nulls in what was computed.
    pub fn faults(&self) -> u64 {
        self.nulls + self.not_finite + self.no_pose
    }
}

impl Mapping {
    /// Finds the inputs in a schema.
    ///
    /// # Errors
    /// If they are not there or are no numbers, or a column that would be written is there already.
    pub fn bind(&self, schema: &Schema) -> Result<Bound, MapError> {
        Bound::new(self.0.clone(), schema)
    }
}

impl Bound {
    fn new(of: Arc<Compiled>, schema: &Schema) -> Result<Self, MapError> {
        let inputs = Inputs::find(&of, schema)?;
        let kept: Vec<usize> = match &of.request.keep {
            Keep::All => (0..schema.fields().len()).collect(),
            Keep::Some(names) => {
                let find = |name: &String| {
                    schema.fields().iter().position(|f| f.name() == name).ok_or_else(|| {
                        let hint = format!("the columns are {}", names_of(schema));
                        MapError::new(format!("--keep {name}: there is no such column"), hint)
                    })
                };
                if let Some(name) =
                    names.iter().enumerate().find(|(k, n)| names[..*k].contains(n)).map(|x| x.1)
                {
                    return Err(MapError::new(format!("--keep {name}: it is told twice"), "name it once"));
                }
                names.iter().map(find).collect::<Result<_, _>>()?
            }
        };
        let mut fields: Vec<FieldRef> = kept.iter().map(|&k| schema.fields()[k].clone()).collect();
        for field in of.fields() {
            if fields.iter().any(|f| f.name() == field.name()) {
                let what =
                    format!("there are two columns `{}`, that of the input and a result", field.name());
                let what = if kept.iter().any(|&k| schema.field(k).name() == field.name()) {
                    what
                } else {
                    format!("two results are called `{}`", field.name())
                };
                return Err(MapError::new(
                    what,
                    "put something in front of those that are written with --prefix, or --keep fewer",
                ));
            }
            fields.push(field);
        }
        let mut metadata = schema.metadata().clone();
        // What other programs say of all columns is no longer true.
        metadata.retain(|key, _| key != "pandas" && !key.starts_with("org.apache.spark"));
        let units = of.request.units;
        let angle = if units.angle == Angle::Degree { "deg" } else { "rad" };
        let length = if units.length == Length::Millimetre { "mm" } else { "m" };
        metadata.insert("denavit.robot", of.arm.name.as_str());
        metadata.insert("denavit.version", env!("CARGO_PKG_VERSION"));
        metadata.insert("denavit.units", format!("{angle},{length}"));
        metadata.insert("denavit.joints", joined(of.arm.joints.iter().map(|[own, _]| own.as_str())));
        if !of.request.poses.is_empty() || of.solver.is_some() {
            metadata.insert("denavit.orientation", of.request.orientation.to_string());
        }
        let schema = Arc::new(Schema::new_with_metadata(fields, metadata));
        Ok(Bound { of, inputs, kept, schema })
    }

    /// The schema of results: columns that go through, and those that are computed, with units in their metadata.
    pub fn schema(&self) -> &SchemaRef {
        &self.schema
    }

    /// The columns of the input that are needed, in order.
    pub fn needed(&self) -> Vec<usize> {
        let Inputs { joints, velocities, accelerations, pose, near } = &self.inputs;
        let inputs = [joints, velocities, accelerations, pose, near].into_iter().flatten();
        let mut all: Vec<usize> =
            inputs.flat_map(|i| i.columns().to_vec()).chain(self.kept.clone()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The same for batches in which columns stand elsewhere.
    #[must_use]
    pub fn placed(&self, to: impl Fn(usize) -> usize) -> Self {
        let moved = |i: &Option<Input>| i.as_ref().map(|i| i.moved(&to));
        let Inputs { joints, velocities, accelerations, pose, near } = &self.inputs;
        let inputs = Inputs {
            joints: moved(joints),
            velocities: moved(velocities),
            accelerations: moved(accelerations),
            pose: moved(pose),
            near: moved(near),
        };
        let kept = self.kept.iter().map(|&k| to(k)).collect();
        Bound { inputs, kept, ..self.clone() }
    }

    /// How many columns go through.
    pub fn kept(&self) -> usize {
        self.kept.len()
    }

    /// How many numbers a column that is computed has in a row, about.
    pub fn fanout(&self) -> usize {
        let lists = self.of.request.inverse.is_some_and(|i| i.solutions == Solutions::Lists);
        if lists { 8 } else { 1 }
    }

    /// Computes a batch.
    ///
    /// # Errors
    /// If a list has another length than is needed, or the batch another schema.
    pub fn run(&self, batch: &RecordBatch) -> Result<(RecordBatch, Counts), MapError> {
        let rows = batch.num_rows();
        let of = &*self.of;
        let mut faults = vec![Fault::None; rows];
        let mut columns: Vec<ArrayRef> = self.kept.iter().map(|&k| batch.column(k).clone()).collect();
        let read = |input: &Option<Input>, faults: &mut [Fault]| -> Result<Read<'_>, MapError> {
            input.as_ref().map_or_else(|| Ok(Read { columns: vec![] }), |i| i.read(batch, faults))
        };
        let joints = read(&self.inputs.joints, &mut faults)?;
        let q: Vec<&Cow<'_, [f64]>> = joints.columns.iter().collect();
        let nulls = nulls_of(&faults);
        if let Some(function) = &of.poses {
            let all = poses(of, &q, function);
            for (values, output) in all.into_iter().zip(of.pose_columns()) {
                columns.push(column(values, output.quantity.scale(of.request.units), nulls.as_ref()));
            }
        }
        let entries: Vec<usize> = (0..6 * of.arm.joints.len()).collect();
        if let Some(function) = &of.jacobian {
            let all = evaluate(function, &q, &entries);
            columns.extend(all.into_iter().map(|values| column(values, Scale::One, nulls.as_ref())));
        }
        if let Some((function, mobility)) = &of.mobility {
            let found = mobility.measure(&evaluate(function, &q, &entries));
            columns.extend(found.map(|values| column(values, Scale::One, nulls.as_ref())));
        }
        if let Some(function) = &of.torque {
            // A row without velocities has a pose all the same.
            let mut own = faults.clone();
            let velocities = read(&self.inputs.velocities, &mut own)?;
            let accelerations = read(&self.inputs.accelerations, &mut own)?;
            let state: Vec<&Cow<'_, [f64]>> =
                q.iter().copied().chain(&velocities.columns).chain(&accelerations.columns).collect();
            let nulls = nulls_of(&own);
            let all = evaluate(function, &state, &(0..of.arm.joints.len()).collect::<Vec<_>>());
            columns.extend(all.into_iter().map(|values| column(values, Scale::One, nulls.as_ref())));
            merge(&mut faults, &own);
        }
        let mut more_solutions = 0;
        if let Some(solver) = &of.solver {
            let mut own = vec![Fault::None; rows];
            let pose = read(&self.inputs.pose, &mut own)?;
            let near = read(&self.inputs.near, &mut own)?;
            let near = self.inputs.near.is_some().then_some(&near.columns[..]);
            columns.extend(solver.columns(
                &of.arm,
                &of.request,
                &pose.columns,
                near,
                &mut own,
                &mut more_solutions,
            ));
            merge(&mut faults, &own);
        }
        let count = |fault: Fault| faults.iter().filter(|f| **f == fault).count() as u64;
        let counts = Counts {
            rows: rows as u64,
            nulls: count(Fault::Null),
            not_finite: count(Fault::NotFinite),
            no_pose: count(Fault::NoPose),
            more_solutions,
            first_fault: faults.iter().position(|f| *f != Fault::None).map(|row| row as u64),
        };
        let options = RecordBatchOptions::new().with_row_count(Some(rows));
        let made = RecordBatch::try_new_with_options(self.schema.clone(), columns, &options);
        let made =
            made.map_err(|why| MapError::new(why.to_string(), "batches have the schema that was bound"))?;
        Ok((made, counts))
    }
}

fn joined<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(",")
}

/// What is the matter with rows in one of two ways.
fn merge(faults: &mut [Fault], other: &[Fault]) {
    for (fault, other) in faults.iter_mut().zip(other) {
        if *fault == Fault::None {
            *fault = *other;
        }
    }
}

fn nulls_of(faults: &[Fault]) -> Option<NullBuffer> {
    let nulls = || faults.iter().map(|f| *f == Fault::None).collect::<NullBuffer>();
    faults.iter().any(|f| *f != Fault::None).then(nulls)
}

impl Compiled {
    /// The columns that are computed.
    fn fields(&self) -> Vec<FieldRef> {
        let mut outputs: Vec<Output> = vec![];
        if self.poses.is_some() {
            outputs.extend(self.pose_columns());
        }
        if self.jacobian.is_some() {
            outputs.extend(self.jacobian_columns());
        }
        if self.mobility.is_some() {
            outputs.extend(Mobility::columns());
        }
        if self.torque.is_some() {
            outputs.extend(self.torque_columns());
        }
        let Self { request, .. } = self;
        let numbers = outputs.iter().map(|o| Arc::new(o.field(&request.prefix, request.units)));
        numbers.chain(self.solver.iter().flat_map(|s: &Solver| s.fields(&self.arm, request))).collect()
    }
}

/// The columns of poses, in metres and radians.
fn poses(of: &Compiled, q: &[&Cow<'_, [f64]>], function: &denavit_program::Function) -> Vec<Vec<f64>> {
    // Rows of a matrix, and its translation.
    const TURNED: [usize; 9] = [0, 1, 2, 4, 5, 6, 8, 9, 10];
    const MOVED: [usize; 3] = [3, 7, 11];
    let orientation = of.request.orientation;
    let is_matrix = orientation == Orientation::Set(OrientationSet::Matrix);
    let frames = &of.request.poses;
    let wanted: Vec<usize> =
        (0..frames.len()).flat_map(|f| MOVED.iter().chain(&TURNED).map(move |k| f * POSE + k)).collect();
    let mut entries = evaluate(function, q, &wanted).into_iter();
    let mut all = vec![];
    for frame in frames {
        let mut own: Vec<Vec<f64>> = entries.by_ref().take(12).collect();
        if is_matrix && frame.offset.is_none() {
            all.append(&mut own);
            continue;
        }
        let rows = own[0].len();
        let mut columns: Vec<Vec<f64>> = vec![Vec::with_capacity(rows); 3 + orientation.names().len()];
        (0..rows).for_each(|row| {
            let x = |k: usize| own[k][row] + 0.0;
            let turned = Rotation::from_rows([3, 6, 9].map(|r| [x(r), x(r + 1), x(r + 2)]));
            let mut pose = Transform::from_rotation_translation(turned, Vector([x(0), x(1), x(2)]));
            if let Some(offset) = frame.offset {
                pose = pose * offset;
            }
            let values = match orientation {
                Orientation::Set(set) => extract(&pose.rotation, set).values,
                Orientation::Vector => {
                    let found = extract(&pose.rotation, OrientationSet::AxisAngle).values;
                    found[..3].iter().map(|x| x * found[3]).collect()
                }
            };
            for (column, x) in columns.iter_mut().zip(pose.translation.0.into_iter().chain(values)) {
                column.push(x);
            }
        });
        all.append(&mut columns);
    }
    all
}

impl Inputs {
    fn find(of: &Compiled, schema: &Schema) -> Result<Self, MapError> {
        let request = &of.request;
        let names = &request.names;
        let joints =
            |what: &str, seconds: u8, asked: &Option<String>, option: &str, bare: &str, rate: &str| {
                let quantities: Vec<Quantity> =
                    of.arm.is_angle.iter().map(|&is_angle| Quantity::of_joint(is_angle, seconds)).collect();
                let own = |k: usize| {
                    of.arm.joints.iter().map(|j| format!("{rate}{}", j[k])).collect::<Vec<String>>()
                };
                // q1 … of rates are qd1 …, as well.
                let numbered = (1..=of.arm.joints.len()).map(|k| format!("{bare}{k}")).collect();
                let indexed = (0..of.arm.joints.len()).map(|k| format!("{bare}[{k}]")).collect();
                let mut usual = vec![own(0), own(1), numbered, vec![bare.to_string()], indexed];
                if seconds == 0 {
                    let joint = (1..=of.arm.joints.len()).map(|k| format!("joint_{k}")).collect();
                    usual.push(joint);
                }
                let mut once: Vec<Vec<String>> = vec![];
                usual.into_iter().for_each(|names| {
                    if !once.contains(&names) {
                        once.push(names);
                    }
                });
                let wanted =
                    Wanted { what, quantities: &quantities, asked: asked.as_deref(), option, usual: once };
                Input::find(schema, &wanted, request.units)
            };
        let mut inputs = Inputs::default();
        if of.poses.is_some() || of.jacobian.is_some() || of.mobility.is_some() || of.torque.is_some() {
            inputs.joints = Some(joints("joint variables", 0, &names.joints, "--joints", "q", "")?);
        }
        if of.torque.is_some() {
            inputs.velocities =
                Some(joints("joint velocities", 1, &names.velocities, "--velocities", "qd", "qd_")?);
            inputs.accelerations = Some(joints(
                "joint accelerations",
                2,
                &names.accelerations,
                "--accelerations",
                "qdd",
                "qdd_",
            )?);
        }
        if let Some(solver) = &of.solver {
            inputs.pose = Some(pose(of, schema)?);
            if solver.wish.solutions == Solutions::Nearest {
                let asked = names.near.clone().or_else(|| names.joints.clone());
                inputs.near = Some(joints("joints to be near to", 0, &asked, "--near", "q", "")?);
            }
        }
        Ok(inputs)
    }
}

/// The columns of poses.
fn pose(of: &Compiled, schema: &Schema) -> Result<Input, MapError> {
    let request = &of.request;
    let quantities: Vec<Quantity> =
        pose_columns(request.orientation).into_iter().map(|c| c.quantity).collect();
    let names = &request.names;
    // One column of lists is a matrix of sixteen.
    let matrix: Vec<Quantity> =
        (0..POSE).map(|k| if k % 4 == 3 && k < 12 { Quantity::Length(0) } else { Quantity::Plain }).collect();
    let is_matrix = request.orientation == Orientation::Set(OrientationSet::Matrix);
    let asked = match (&names.position, &names.rotation) {
        (None, None) => None,
        (Some(position), None) => Some(position.clone()),
        (position, Some(rotation)) => Some(format!("{},{rotation}", position.as_deref().unwrap_or("x,y,z"))),
    };
    let own: Vec<String> =
        POSITION.iter().chain(request.orientation.names()).map(ToString::to_string).collect();
    let wanted = |quantities, usual| Wanted {
        what: "poses",
        quantities,
        asked: asked.as_deref(),
        option: "--position and --rotation",
        usual,
    };
    let split = || Input::find(schema, &wanted(&quantities, vec![own]), request.units);
    let whole = || Input::find(schema, &wanted(&matrix, vec![vec!["pose".to_string()]]), request.units);
    match (is_matrix, &asked) {
        (false, _) => split(),
        (true, None) => split().or_else(|why| whole().map_err(|_| why)),
        // A column of lists that is named is a matrix; how long lists of any length are no schema says.
        (true, Some(_)) => whole().or_else(|_| split()),
    }
}
