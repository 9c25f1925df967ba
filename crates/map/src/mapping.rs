//! A request compiled for a robot.

use crate::MapError;
use crate::arm::Arm;
use crate::inverse::Solver;
use crate::outputs::Output;
use crate::rates::Mobility;
use crate::request::{Frame, Orientation, Request, Solutions};
use crate::unit::Quantity;
use denavit::description::Description;
use denavit::dynamics::{DynamicFunction, DynamicPrograms, Masses};
use denavit::forward::{Reference, frames_program};
use denavit::geometry::Vector;
use denavit::velocity::{ROWS, Viewpoint, jacobian_program};
use denavit_program::{Arithmetic, Block, Function, Program};
use denavit_symbolic::{Expr, Rational};
use std::borrow::Cow;
use std::sync::Arc;

/// A request compiled for a robot. It can be sent to other threads, and lives without the description.
///
/// Functions round the same on every machine, whatever its vector instructions are.
#[derive(Clone)]
pub struct Mapping(pub(crate) Arc<Compiled>);

/// What a mapping is.
pub struct Compiled {
    pub arm: Arm,
    pub request: Request,
    /// The poses, sixteen results a frame.
    pub poses: Option<Function>,
    pub jacobian: Option<Function>,
    /// The tool's.
    pub mobility: Option<(Function, Mobility)>,
    pub torque: Option<Function>,
    pub solver: Option<Solver>,
}

/// Entries of a pose.
pub const POSE: usize = 16;
/// Columns of a position.
pub const POSITION: [&str; 3] = ["x", "y", "z"];

impl Mapping {
    /// Compiles a request.
    ///
    /// # Errors
    /// If nothing is asked for, a parameter has no value, or the robot has no such function.
    pub fn new(d: &Description, request: &Request) -> Result<Self, MapError> {
        let asks = !request.poses.is_empty()
            || request.jacobian.is_some()
            || request.manipulability
            || request.torque
            || request.inverse.is_some();
        if !asks {
            return Err(MapError::new(
                "nothing is to be computed",
                "ask for fk, jacobian, manipulability, torque, ik or nearest",
            ));
        }
        if d.variables().is_empty() {
            return Err(MapError::new(
                format!("{} has no joints", d.name),
                "its pose is always the same: `denavit fk`",
            ));
        }
        let poses: Vec<Reference> = request.poses.iter().map(|f| f.on).collect();
        let poses = (!poses.is_empty()).then(|| strict(d, &frames_program(d, &poses))).transpose()?;
        let jacobian = request.jacobian.as_ref();
        let jacobian = jacobian.map(|f| strict(d, &jacobian_program(d, &viewpoint(f)?))).transpose()?;
        let mobility = request
            .manipulability
            .then(|| Ok((strict(d, &jacobian_program(d, &Viewpoint::tool()))?, Mobility::of(d)?)));
        let torque = request.torque.then(|| torque(d)).transpose()?;
        let solver = request.inverse.map(|wish| Solver::of(d, wish)).transpose()?;
        let variables = d.variables();
        let named = d.joint_names();
        let name = |k: usize, own: String| {
            let other =
                named.as_ref().and_then(|n| n.get(k)).map_or_else(|| own.clone(), ToString::to_string);
            [own, other]
        };
        Ok(Mapping(Arc::new(Compiled {
            arm: Arm {
                name: d.name.clone(),
                joints: variables
                    .iter()
                    .enumerate()
                    .map(|(k, v)| name(k, v.symbol.name().to_string()))
                    .collect(),
                is_angle: variables
                    .iter()
                    .map(|v| v.kind == denavit::description::JointKind::Revolute)
                    .collect(),
            },
            request: request.clone(),
            poses,
            jacobian,
            mobility: mobility.transpose()?,
            torque,
            solver,
        })))
    }

    /// The names of the columns that are read where nothing else is said, a column each.
    pub fn inputs(&self) -> Vec<String> {
        let of = &self.0;
        let mut all: Vec<String> = vec![];
        let has_state =
            of.poses.is_some() || of.jacobian.is_some() || of.mobility.is_some() || of.torque.is_some();
        let is_near = of.solver.as_ref().is_some_and(|s| s.wish.solutions == Solutions::Nearest);
        if has_state || is_near {
            all.extend(of.arm.joints.iter().map(|[own, _]| own.clone()));
        }
        if of.torque.is_some() {
            let numbered =
                |front: &'static str| (1..=of.arm.joints.len()).map(move |k| format!("{front}{k}"));
            all.extend(numbered("qd").chain(numbered("qdd")));
        }
        if of.solver.is_some() {
            all.extend(pose_columns(of.request.orientation).into_iter().map(|c| c.name));
        }
        all
    }
}

impl Compiled {
    /// The columns of the poses, frame by frame.
    pub fn pose_columns(&self) -> Vec<Output> {
        let frames = &self.request.poses;
        let one = |frame: &Frame| {
            let label = if frames.len() > 1 { format!("{}_", frame.label) } else { String::new() };
            pose_columns(self.request.orientation)
                .into_iter()
                .map(move |c| Output::new(format!("{label}{}", c.name), c.quantity))
        };
        frames.iter().flat_map(one).collect()
    }

    /// The columns of the Jacobian, row by row.
    pub fn jacobian_columns(&self) -> Vec<Output> {
        let joints = || self.arm.joints.iter().zip(&self.arm.is_angle);
        let each = ROWS.iter().enumerate().flat_map(|(r, row)| {
            joints().map(move |([joint, _], &is_angle)| {
                // Metres a radian and radians a metre keep their units, whatever columns are written in.
                let quantity = match (r < 3, is_angle) {
                    (true, true) => Quantity::Named("m/rad"),
                    (false, false) => Quantity::Named("rad/m"),
                    (true, false) | (false, true) => Quantity::Plain,
                };
                Output::new(format!("{row}_{joint}"), quantity)
            })
        });
        each.collect()
    }

    /// The columns of torques.
    pub fn torque_columns(&self) -> Vec<Output> {
        let each = self.arm.joints.iter().zip(&self.arm.is_angle);
        each.map(|([joint, _], &is_angle)| {
            Output::new(format!("tau_{joint}"), if is_angle { Quantity::Torque } else { Quantity::Force })
        })
        .collect()
    }
}

/// The columns of a pose.
pub fn pose_columns(orientation: Orientation) -> Vec<Output> {
    let position = POSITION.iter().map(|&name| Output::new(name, Quantity::Length(0)));
    let turned = orientation.names().iter().enumerate().map(|(k, &name)| {
        Output::new(name, if orientation.is_angle(k) { Quantity::Angle(0) } else { Quantity::Plain })
    });
    position.chain(turned).collect()
}

fn viewpoint(frame: &Frame) -> Result<Viewpoint<Expr>, MapError> {
    let plain = Viewpoint::of(frame.on, Reference::Base);
    let Some(offset) = frame.offset else { return Ok(plain) };
    let exact = |x: f64| Rational::from_f64(x).map(Expr::from);
    match offset.translation.0.map(exact) {
        [Some(x), Some(y), Some(z)] => Ok(Viewpoint { offset: Vector([x, y, z]), ..plain }),
        _ => Err(MapError::new(
            format!("where {} stands is no number", frame.label),
            "give its lengths values",
        )),
    }
}

/// A program at the robot's own values, as one that rounds the same on every machine.
fn strict(d: &Description, program: &Program) -> Result<Function, MapError> {
    let function = program.compile_with(|s| d.value(s)).map_err(|missing| {
        MapError::new(format!("{}: {missing}", d.name), "give them values, as in --set D3=450mm")
    })?;
    Ok(function.on(function.target().0, Arithmetic::Strict))
}

fn torque(d: &Description) -> Result<Function, MapError> {
    let hint = "a URDF says masses, or mass, com and inertia in a robot file";
    if !d.has_masses() {
        return Err(MapError::new(format!("{} says nothing of masses", d.name), hint));
    }
    let programs =
        DynamicPrograms::new(d, Masses::Numbers).map_err(|why| MapError::new(why.to_string(), hint))?;
    let made =
        programs.program(DynamicFunction::Torque).map_err(|why| MapError::new(why.to_string(), hint))?;
    strict(d, &made.program)
}

/// Results of a function for columns of variables: those of these numbers, a column each.
pub fn evaluate(function: &Function, inputs: &[&Cow<'_, [f64]>], wanted: &[usize]) -> Vec<Vec<f64>> {
    let rows = inputs.first().map_or(0, |c| c.len());
    let mut block: Block<f64> = function.block();
    let lanes = block.lanes();
    let mut results: Vec<Vec<f64>> = wanted.iter().map(|_| Vec::with_capacity(rows)).collect();
    let mut first = 0;
    while first < rows {
        let count = lanes.min(rows - first);
        for (k, column) in inputs.iter().enumerate() {
            let own = block.variable(k);
            own[..count].copy_from_slice(&column[first..first + count]);
            // Lanes without a row repeat the last one.
            let last = own[count - 1];
            own[count..].fill(last);
        }
        block.run();
        for (into, &k) in results.iter_mut().zip(wanted) {
            into.extend_from_slice(&block.output(k)[..count]);
        }
        first += count;
    }
    results
}
